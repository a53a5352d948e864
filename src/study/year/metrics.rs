//! Figures of a year by the keys that programs, tables and objectives use. Keys are stable, shares are 0 … 1.

use super::{Figures, Solar, SolarFigures, Year};
use crate::compute::year::glare::LIMITS;
use crate::compute::year::provision::{LEVELS, Reached};
use serde_json::{Value, json};

/// Returns all figures of a year, or of the year with less or more light, by their keys. `area`: area of the floor.
/// \[m²\]
pub fn metrics(year: &Year, figures: &Figures, area: f64) -> Value {
    let one = &figures.autonomy;
    let hours = |steps: usize| steps as f64 * year.steps.length;
    let mut all = json!({
        "hours": hours(figures.steps),
        "occupied_hours": hours(figures.occupied),
        "lit_hours": hours(figures.lit),
        "DA300": one.da_300,
        "DA500": one.da_500,
        "cDA300": one.cda_300,
        "UDI_n": one.udi_n,
        "UDI_s": one.udi_s,
        "UDI_a": one.udi_a,
        "UDI_x": one.udi_x,
        "sDA300_50": one.sda_300_50,
    });
    if year.settings.unoccupied {
        all["annual_mean_lx"] = json!(one.mean);
    }
    if let Some(blinds) = &figures.blinds {
        all["sDA300_50_LM83_12"] = json!(blinds.sda_300_50);
        all["blinds_closed_hours"] = json!(blinds.closed_hours);
    }
    if let Some(exposure) = &figures.exposure {
        all["sun_hours_1000"] = json!(exposure.hours_1000);
        all["ASE_hours_1000"] = json!(exposure.ase_hours_1000);
        all["ASE1000_250"] = json!(exposure.ase_1000_250);
    }
    if let Some(provision) = &figures.provision {
        let reached = |one: &Reached| json!({"area_by_point": one.area_by_point, "time_by_hour": one.time_by_hour});
        let mut levels = json!({"median_diffuse_lx": provision.median_diffuse});
        for ((name, ..), level) in LEVELS.iter().zip(&provision.levels) {
            levels[*name] = json!({
                "target": reached(&level.target),
                "minimum": reached(&level.minimum),
                "met_by_point": level.met_by_point(),
                "met_by_hour": level.met_by_hour(),
            });
        }
        all["EN17037"] = levels;
    }
    if !figures.glare.is_empty() {
        let eyes = figures.glare.iter().enumerate().map(|(i, glare)| {
            let mut eye = json!({"sun_at_eye_hours": hours(glare.sun_at_eye), "DGPs_5pct": glare.dgps_5_percent});
            for (limit, above) in LIMITS.iter().zip(glare.above) {
                eye[format!("share_above_{limit:.2}")] = json!(above);
            }
            if let Some(probability) = figures.probability.get(i) {
                eye["DGP_5pct"] = json!(probability.dgp_5_percent);
                eye["DGP_class"] = json!(probability.class().unwrap_or("none"));
                for (limit, above) in LIMITS.iter().zip(probability.above) {
                    eye[format!("DGP_share_above_{limit:.2}")] = json!(above);
                }
            }
            (format!("Ev_{}", i + 1), eye)
        });
        all["glare"] = Value::Object(eyes.collect());
    }
    if !year.moving.is_empty() {
        all["movements"] = json!(year.movements);
    }
    if let Some(energy) = &figures.lighting {
        let total = energy.total();
        let mut lighting = json!({
            "kWh": total * area,
            "full_kWh_m2": energy.full,
            "month_kWh_m2": energy.months,
        });
        // The unit is that of a year.
        let key = if year.steps.whole && year.chosen.len() == year.steps.list.len() { "LENI_kWh_m2" } else { "kWh_m2" };
        lighting[key] = json!(total);
        all["lighting"] = lighting;
    }
    if let (Some(solar), Some(figures)) = (&year.solar, &figures.solar) {
        all["solar"] = solar_json(solar, figures);
    }
    all
}

/// Whether a figure counts direct sun.
pub fn counts_direct_sun(key: &str) -> bool {
    ["sun_hours_1000", "ASE", "glare"].iter().any(|start| key.starts_with(start))
}

/// Whether a figure depends on the light in unoccupied hours. All others count occupied hours, or do not depend on the
/// light at places.
pub fn counts_unoccupied(key: &str) -> bool {
    key == "annual_mean_lx" || key.starts_with("EN17037")
}

/// Returns the solar energy transmitted, per square metre of all apertures unless the key says otherwise.
fn solar_json(solar: &Solar, figures: &SolarFigures) -> Value {
    let total = figures.energy.total();
    let by_area = figures.energy.scaled(1.0 / solar.area());
    let apertures = solar.apertures.iter().zip(&figures.apertures);
    json!({
        "kWh": total,
        "kWh_m2": by_area.total(),
        "kWh_m2_floor": total / solar.floor,
        "month_kWh_m2": by_area.months,
        "hour_kWh_m2": by_area.hours,
        "summer_kWh_m2": by_area.summer(),
        "winter_kWh_m2": by_area.winter(),
        "source": solar.source().words(),
        "meaning": "directly transmitted, secondary heat left out",
        "apertures": apertures
            .map(|(one, kilowatt_hours)| json!({
                "aperture": one.number,
                "area_m2": one.area,
                "kWh": kilowatt_hours,
                "kWh_m2": kilowatt_hours / one.area,
                "source": one.source.words(),
            }))
            .collect::<Vec<_>>(),
    })
}

/// Returns the larger difference of every number from those of the year with less and with more light; other values are
/// left out.
pub fn errors(own: &Value, less: &Value, more: &Value) -> Option<Value> {
    match own {
        Value::Number(_) => {
            let [own, less, more] = [own, less, more].map(|value| value.as_f64().unwrap_or_default());
            Some(json!((less - own).abs().max((more - own).abs())))
        }
        Value::Array(values) => {
            Some(values.iter().enumerate().filter_map(|(k, value)| errors(value, &less[k], &more[k])).collect())
        }
        Value::Object(map) => {
            let of = |(key, value): (&String, &Value)| Some((key.clone(), errors(value, &less[key], &more[key])?));
            Some(Value::Object(map.iter().filter_map(of).collect()))
        }
        _ => None,
    }
}

/// Returns the number under a key, steps separated by dots (`lighting.LENI_kWh_m2`, `glare.Ev_1.share_above_0.40`): of
/// a list its mean, of a Boolean 1 or 0. `None` if there is none.
pub fn number(metrics: &Value, key: &str) -> Option<f64> {
    if key.is_empty() {
        return match metrics {
            Value::Number(number) => number.as_f64(),
            Value::Bool(yes) => Some(f64::from(u8::from(*yes))),
            Value::Array(list) if !list.is_empty() => {
                let sum: Option<f64> = list.iter().map(|one| number(one, "")).sum();
                Some(sum? / list.len() as f64)
            }
            _ => None,
        };
    }
    // Names hold dots too.
    let rest = |name: &str| {
        let rest = key.strip_prefix(name)?;
        if rest.is_empty() { Some(rest) } else { rest.strip_prefix('.').filter(|rest| !rest.is_empty()) }
    };
    metrics.as_object()?.iter().find_map(|(name, value)| number(value, rest(name)?))
}

/// Returns all keys under which [`number`] finds one, in their order.
pub fn keys(metrics: &Value) -> Vec<String> {
    let Some(map) = metrics.as_object() else { return Vec::new() };
    let below = |(name, value): (&String, &Value)| match value {
        Value::Object(_) => keys(value).iter().map(|key| format!("{name}.{key}")).collect(),
        _ if number(value, "").is_some() => vec![name.clone()],
        _ => Vec::new(),
    };
    map.iter().flat_map(below).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_is_found_by_its_key() {
        let metrics = json!({
            "DA300": [0.5, 1.0],
            "glare": {"Ev_1": {"share_above_0.35": 0.25, "share_above_0.40": 0.125}},
            "EN17037": {"minimum": {"met_by_point": true}},
            "name": "x",
            "none": [],
        });
        let at = |key| number(&metrics, key);
        assert_eq!((at("DA300"), at("glare.Ev_1.share_above_0.40")), (Some(0.75), Some(0.125)));
        assert_eq!(at("EN17037.minimum.met_by_point"), Some(1.0));
        for wrong in
            ["", "DA", "DA3000", "DA300.", "glare", "glare.Ev_1", "glare.Ev_1.share_above_0", "name", "none", "."]
        {
            assert_eq!(at(wrong), None, "{wrong}");
        }
        let keys = keys(&metrics);
        assert_eq!(keys.len(), 4);
        assert!(keys.iter().all(|key| at(key).is_some()), "{keys:?}");
    }

    #[test]
    fn errors_are_the_larger_distance() {
        let found = errors(
            &json!({"a": 2.0, "b": [1.0], "c": true}),
            &json!({"a": 1.5, "b": [1.5]}),
            &json!({"a": 2.25, "b": [1.0]}),
        );
        assert_eq!(found, Some(json!({"a": 0.5, "b": [0.5]})));
    }
}
