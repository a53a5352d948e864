//! Annual figures as JSON: keys are stable, shares are 0 to 1.

use crate::compute::estimate::Estimate;
use crate::study::session::glare::CAVEAT;
use crate::study::year::{
    Entry, Figures, Group, Lm83, NOT_JUDGED, Opening, Quantity, SHADE, ThroughAperture, Year, estimate, metrics,
};
use serde_json::{Map, Value, json};

/// Returns the result of an annual simulation as JSON: annual figures, their uncertainties (from those of the hourly
/// illuminances), weather, states, stages of the computation, and results that were not computed. `figures`: with the
/// illuminances as computed, and with those reduced and increased by their uncertainty.
pub(super) fn to_json(year: &Year, figures: &[Figures; 3], opening: &Opening) -> Value {
    let entries = metrics(year, figures);
    let mut own = nested(&entries, |entry| Some(plain(&entry.values[0])));
    let mut errors = nested(&entries, error);
    if let Some(all) = own.get_mut("solar") {
        (all["apertures"], errors["solar"]["apertures"]) = apertures(year, figures);
    }
    // Added to the standard's other figures. They do not depend on illuminances; their uncertainties stand with them.
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
        "lm83": year.lm83.as_ref().map(|lm83| lm83_groups(lm83, &figures[0])),
        "control": year.moving.iter().enumerate().map(|(m, one)| control(year, m, one.aperture)).collect::<Vec<_>>(),
        "indoor": year.indoor.as_ref().map(|indoor| json!({
            "read_steps": indoor.read,
            "hunting_steps": indoor.hunting.len(),
            "unsure_steps": indoor.unsure.len(),
        })),
        "seconds": seconds,
        "left_out": left_out(year, &figures[0]),
        "notes": year.notes.iter().map(String::as_str).chain(year.dgp.as_ref().map(|_| CAVEAT)).collect::<Vec<_>>(),
    })
}

/// Returns `value` of all metrics as nested JSON objects, by the parts of their keys.
fn nested(entries: &[Entry], value: impl Fn(&Entry) -> Option<Value>) -> Value {
    let mut all = json!({});
    for entry in entries {
        if let Some(value) = value(entry) {
            *entry.path().into_iter().fold(&mut all, |inner, step| &mut inner[step]) = value;
        }
    }
    all
}

fn plain(quantity: &Quantity) -> Value {
    match quantity {
        Quantity::Number(value) => json!(value),
        Quantity::List(list) => json!(list),
        Quantity::Counts(list) => json!(list),
        Quantity::Met(met) => json!(met),
        Quantity::Word(word) => json!(word),
    }
}

/// Returns the uncertainty of a metric that is a number, or of each number of a list, as JSON; `None` for other
/// metrics.
fn error(entry: &Entry) -> Option<Value> {
    match &entry.values {
        [Quantity::Number(_), ..] => Some(json!(entry.estimate()?.error)),
        [Quantity::List(own), Quantity::List(less), Quantity::List(more)] => {
            let error = |k: usize| estimate([own[k], less[k], more[k]]).error;
            Some(json!((0..own.len()).map(error).collect::<Vec<_>>()))
        }
        [Quantity::Counts(list), ..] => Some(json!(vec![0.0; list.len()])),
        _ => None,
    }
}

/// Returns the solar energy transmitted directly through each aperture \[kWh\], and its uncertainties, as JSON.
fn apertures(year: &Year, figures: &[Figures; 3]) -> (Value, Value) {
    let all = year.solar.iter().flat_map(|solar| solar.apertures.iter().enumerate());
    let of = |(k, one): (usize, &ThroughAperture)| {
        let energy = figures.each_ref().map(|one| one.solar.as_ref().map_or(0.0, |solar| solar.apertures[k]));
        let Estimate { value, error } = estimate(energy);
        let own = json!({
            "aperture": one.number,
            "area_m2": one.area,
            "kWh": value,
            "kWh_m2": value / one.area,
            "source": one.source.words(),
        });
        (own, json!({"aperture": 0.0, "area_m2": 0.0, "kWh": error, "kWh_m2": error / one.area}))
    };
    let (own, errors): (Vec<Value>, Vec<Value>) = all.map(of).unzip();
    (json!(own), json!(errors))
}

/// Returns the exposure to sunlight by EN 17037 as JSON.
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

/// Returns the view out by EN 17037 as JSON: the criteria that are reached at three quarters of the sensor points.
fn view(opening: &Opening) -> Value {
    let view = &opening.view;
    json!({
        "points": opening.points,
        "sight_angle_deg": view.sight_angle.to_degrees(),
        // An unobstructed view has no distance.
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

/// Returns the shading operation of an aperture as JSON: daylight hours per state in the requested steps, and state
/// changes in the whole year.
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

/// Returns the groups of apertures that the rule of IES LM-83-12 closes together, and their closed hours, as JSON.
fn lm83_groups(lm83: &Lm83, figures: &Figures) -> Value {
    let hours = |group: usize| figures.blinds.as_ref().and_then(|blinds| blinds.closed_hours.get(group).copied());
    let shade = || format!("even shade, transmittance {SHADE}, in the system's place (default: nothing moves)");
    let of = |(number, group): (usize, &Group)| {
        let [open, closed] = match &group.states {
            Some(states) => states.clone(),
            None => ["as it is".to_owned(), shade()],
        };
        json!({"apertures": group.apertures, "open": open, "closed": closed, "closed_hours": hours(number)})
    };
    json!({
        "edition": "IES LM-83-12",
        "groups": lm83.groups.iter().enumerate().map(of).collect::<Vec<_>>(),
        "unsure_steps": lm83.worked.iter().filter(|one| one.unsure).count(),
    })
}

/// Returns a sentence for each result that was not computed, with its reason.
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
    if year.lm83.is_none() {
        list.push("sDA300_50_LM83_12: asked for by lm83 = true in [year]".to_owned());
    }
    if figures.provision.is_none() {
        let steps = year.chosen.len();
        list.push(format!(
            "figures of a whole year (EN 17037, ASE): {steps} steps of {} h are none",
            year.steps.length
        ));
    } else if figures.exposure.is_none() {
        list.push("ASE1000,250: needs something that lets the sun through unscattered".to_owned());
    }
    list
}
