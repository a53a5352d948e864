//! The figures of a year for programs: keys are stable, shares 0 … 1.

use crate::compute::year::glare::LIMITS;
use crate::compute::year::provision::{LEVELS, Reached};
use crate::study::SceneFile;
use crate::study::session::glare::CAVEAT;
use crate::study::year::{Figures, NOT_JUDGED, Opening, Solar, SolarFigures, Year};
use serde_json::{Map, Value, json};

/// Figures, what the hours' errors leave open of them, weather, states, stages, and what was left out.
pub(super) fn to_json(year: &Year, figures: &[Figures; 3], file: &SceneFile, opening: &Opening) -> Value {
    let area = file.room.width * file.room.depth;
    let [mut own, less, more] = figures.each_ref().map(|one| metrics(year, one, area));
    let errors = between(&own, &less, &more).unwrap_or_default();
    // Beside the standard's other figures. No illuminance is in these: what they may be off stands with them.
    if let Some(standard) = own.get_mut("EN17037") {
        standard["sunlight"] = sunlight(opening);
        standard["view"] = view(opening);
    }
    let closure = year.steps.closure;
    let seconds: Map<String, Value> =
        year.spent.iter().map(|(stage, time)| ((*stage).to_owned(), json!(time.as_secs_f64()))).collect();
    json!({
        "metrics": own,
        "errors": errors,
        "weather": {
            "file": year.settings.keys.weather.display().to_string(),
            "name": year.steps.station.name,
            "closure_rms": closure.map(|one| one.rms),
            "best_offset_minutes": closure.map(|one| one.best_offset),
            "best_rms": closure.map(|one| one.best_rms),
            "offset_minutes": year.steps.offset,
            "step_hours": year.steps.length,
            "whole_year": year.steps.whole,
        },
        "control": year.moving.iter().enumerate().map(|(m, one)| control(year, m, one.aperture)).collect::<Vec<_>>(),
        "seconds": seconds,
        "left_out": left_out(year, &figures[0]),
        "notes": year.notes.iter().map(String::as_str).chain(year.dgp.as_ref().map(|_| CAVEAT)).collect::<Vec<_>>(),
    })
}

/// EN 17037, exposure to sunlight.
fn sunlight(opening: &Opening) -> Value {
    json!({
        "date": opening.day.to_string(),
        "min_altitude_deg": opening.least_altitude.to_degrees(),
        "hours": opening.any.hours(),
        "hours_error": opening.any.error(),
        "level": opening.any.level().unwrap_or("none"),
        "hours_by_aperture": opening.by_aperture.iter().map(|one| one.hours()).collect::<Vec<_>>(),
        "not_judged": [NOT_JUDGED[0], NOT_JUDGED[2]],
    })
}

/// EN 17037, view out, from three quarters of the sensors' places.
fn view(opening: &Opening) -> Value {
    let view = &opening.view;
    json!({
        "points": opening.points,
        "sight_angle_deg": view.sight_angle.to_degrees(),
        // Nothing in the way has no number.
        "distance_m": view.distance.filter(|distance| distance.is_finite()),
        "distance": match view.distance {
            Some(distance) if distance.is_finite() => "known",
            Some(_) => "nothing in the way",
            None => "not known",
        },
        "layers": {"sky": view.sky, "landscape": view.landscape, "ground": view.ground},
        "level": view.level().unwrap_or("none"),
        "not_judged": [NOT_JUDGED[0], NOT_JUDGED[1]],
    })
}

/// How long each state stood while there was light, of the steps that were asked for; movements of the whole year.
fn control(year: &Year, m: usize, aperture: usize) -> Value {
    let device = &year.moving[m].device;
    let hours: Map<String, Value> = device
        .keys
        .iter()
        .enumerate()
        .map(|(state, key)| {
            let count =
                year.chosen.iter().filter(|&&k| year.steps.list[k].hour.is_lit() && year.states[k][m] == state).count();
            (key.clone(), json!(count as f64 * year.steps.length))
        })
        .collect();
    json!({
        "aperture": aperture,
        "device": device.name,
        "mode": year.moving[m].keys.mode.word(),
        "movements": year.movements[m],
        "lit_hours_by_state": hours,
    })
}

/// What was not computed, and why.
fn left_out(year: &Year, figures: &Figures) -> Vec<String> {
    let mut list = vec![format!("{} steps without light", year.light.dark)];
    for (m, one) in year.moving.iter().enumerate() {
        let picked = |state: &usize| {
            year.chosen.iter().any(|&k| year.states[k][m] == *state && year.steps.list[k].hour.is_lit())
        };
        let never: Vec<&str> = (0..one.device.keys.len())
            .filter(|state| !picked(state))
            .map(|state| one.device.keys[state].as_str())
            .collect();
        if !never.is_empty() {
            list.push(format!("states of aperture {} that no lit step picks: {}", one.aperture, never.join(", ")));
        }
    }
    if year.solar.is_none() {
        list.push("solar energy: asked for by solar = true in [year]".to_owned());
    }
    if figures.provision.is_none() {
        let steps = year.chosen.len();
        list.push(format!(
            "figures of a whole year (EN 17037, ASE): {steps} steps of {} h are none",
            year.steps.length
        ));
    } else if figures.exposure.is_none() {
        let needs = "something that lets the sun through unscattered, nothing that a control moves, no boxes outside";
        list.push(format!("ASE1000,250: needs {needs}"));
    }
    list
}

fn metrics(year: &Year, figures: &Figures, area: f64) -> Value {
    let one = &figures.autonomy;
    let hours = |steps: usize| steps as f64 * year.steps.length;
    let mut all = json!({
        "hours": hours(figures.steps),
        "occupied_hours": hours(figures.occupied),
        "lit_hours": hours(figures.lit),
        "annual_mean_lx": one.mean,
        "DA300": one.da_300,
        "DA500": one.da_500,
        "cDA300": one.cda_300,
        "UDI_n": one.udi_n,
        "UDI_s": one.udi_s,
        "UDI_a": one.udi_a,
        "UDI_x": one.udi_x,
        "sDA300_50": one.sda_300_50,
    });
    if let Some(exposure) = &figures.exposure {
        all["sun_hours_1000"] = json!(exposure.hours_1000);
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

/// Solar energy straight through the apertures, by square metre of all of them where nothing else is said.
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

/// The larger distance of every number from those of the year with less and with more light; what is no number is left out.
fn between(own: &Value, less: &Value, more: &Value) -> Option<Value> {
    match own {
        Value::Number(_) => {
            let [own, less, more] = [own, less, more].map(|value| value.as_f64().unwrap_or_default());
            Some(json!((less - own).abs().max((more - own).abs())))
        }
        Value::Array(values) => {
            Some(values.iter().enumerate().filter_map(|(k, value)| between(value, &less[k], &more[k])).collect())
        }
        Value::Object(map) => {
            let of = |(key, value): (&String, &Value)| Some((key.clone(), between(value, &less[key], &more[key])?));
            Some(Value::Object(map.iter().filter_map(of).collect()))
        }
        _ => None,
    }
}
