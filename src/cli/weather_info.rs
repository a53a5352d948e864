//! Weather on the command line: `cfs info` for weather files, and the weather hour of a scene's sky.

use super::output::Content;
use crate::compute::weather::{LightSource, Summary, Weather};
use crate::formats::weather::is_weather_file;
use crate::study::files;
use crate::study::sky::HourOfWeather;
use crate::study::weather::{BUILTIN, load};
use anyhow::anyhow;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// Describes a weather file or a built-in year; `None` for other names.
///
/// # Errors
/// Returns an error if the file cannot be read: one line with the file's name and the position in it.
pub(super) fn describe(path: &Path, as_json: bool) -> anyhow::Result<Option<Content>> {
    let name = files::name_with_extension(path)?;
    if !name.starts_with(BUILTIN) && !is_weather_file(&name) {
        return Ok(None);
    }
    let weather = load(path, Path::new(""))?;
    let summary = weather.examine().map_err(|error| anyhow!("{name}: {error}"))?;
    Ok(Some(Content::of(as_json, || to_json(&weather, &summary), || to_text(&weather, &summary))))
}

/// Returns the first and the last interval of a weather file as text.
fn period(weather: &Weather) -> [String; 2] {
    let words = |record: Option<&crate::compute::weather::Record>| {
        record.map_or(String::new(), |one| one.label(weather.interval))
    };
    [words(weather.records.first()), words(weather.records.last())]
}

fn to_json(weather: &Weather, summary: &Summary) -> Value {
    let station = &weather.station;
    let sums = &summary.sums;
    let [first, last] = period(weather);
    let findings = summary
        .findings
        .iter()
        .map(|finding| json!({"severity": finding.severity.word(), "code": finding.code, "message": finding.message}));
    json!({
        "format": weather.format,
        "name": station.name,
        "region": station.region,
        "country": station.country,
        "source": station.source,
        "latitude_deg": station.latitude,
        "longitude_deg": station.longitude,
        "utc_offset_h": station.utc_offset,
        "elevation_m": station.elevation,
        "quantity": weather.quantity.words(),
        "rows": weather.records.len(),
        "interval_min": weather.interval,
        "first": first,
        "last": last,
        "years": weather.years(),
        "missing_intervals": summary.missing,
        "clock": {
            "stated_offset_minutes": weather.clock,
            "closure_rms_W_m2": summary.closure.map(|one| one.rms),
            "best_offset_minutes": summary.closure.map(|one| one.best_offset),
            "best_rms_W_m2": summary.closure.map(|one| one.best_rms),
            "off": summary.closure.is_some_and(|one| one.is_off() && weather.tested.is_none()),
        },
        "sums": {
            "global_kWh_m2": sums.global,
            "direct_normal_kWh_m2": sums.direct_normal,
            "diffuse_kWh_m2": sums.diffuse,
            "global_klxh": sums.global_light,
            "direct_normal_klxh": sums.direct_light,
            "diffuse_klxh": sums.diffuse_light,
        },
        "lit_hours": summary.lit_hours,
        "sunshine_hours": summary.sunshine_hours,
        "findings": findings.collect::<Vec<_>>(),
    })
}

fn to_text(weather: &Weather, summary: &Summary) -> String {
    let station = &weather.station;
    let sums = &summary.sums;
    let mut text = String::new();
    let mut line = |label: &str, value: &str| {
        if !value.is_empty() {
            let _ = writeln!(text, "{label:<22}{value}");
        }
    };
    let parts = [&station.name, &station.region, &station.country];
    line(
        "Place",
        &parts.into_iter().filter(|part| !part.is_empty()).map(String::as_str).collect::<Vec<_>>().join(", "),
    );
    line("Source", &station.source);
    line("Format", weather.format);
    line("Latitude", &sided(station.latitude, "N", "S"));
    line("Longitude", &sided(station.longitude, "E", "W"));
    line("Clock", &format!("UTC{:+} h, standard time all the year", station.utc_offset));
    line("Elevation", &format!("{} m", station.elevation));
    line("Light", weather.quantity.words());
    let [first, last] = period(weather);
    line("Period", &format!("{first} to {last}"));
    line(
        "Rows",
        &format!("{} of {} min, {} missing between them", weather.records.len(), weather.interval, summary.missing),
    );
    line("Years", &years(&weather.years()));
    line("Closure", &closure(weather, summary));
    let irradiation = |value: f64| format!("{value:.1} kWh/m²");
    if sums.global > 0.0 {
        line("Global horizontal", &format!("{}, {:.0} klx·h", irradiation(sums.global), sums.global_light));
    } else {
        line("Global horizontal", &format!("{:.0} klx·h", sums.global_light));
    }
    line("Direct normal", &format!("{}, {:.0} klx·h", irradiation(sums.direct_normal), sums.direct_light));
    line("Diffuse horizontal", &format!("{}, {:.0} klx·h", irradiation(sums.diffuse), sums.diffuse_light));
    line("Lit", &format!("{:.0} h, sunshine {:.0} h", summary.lit_hours, summary.sunshine_hours));
    let _ = writeln!(text, "\nFindings");
    if summary.findings.is_empty() {
        let _ = writeln!(text, "  none");
    }
    for finding in &summary.findings {
        let _ = writeln!(text, "  {:<8} {:<22} {}", finding.severity.word(), finding.code, finding.message);
    }
    text
}

/// Formats a latitude or longitude \[°\] with a letter or word for the side (`positive`, `negative`) instead of a sign.
fn sided(degrees: f64, positive: &str, negative: &str) -> String {
    format!("{}° {}", degrees.abs(), if degrees < 0.0 { negative } else { positive })
}

/// Formats a list of calendar years: up to four one by one, more as a number and a range.
fn years(years: &[i16]) -> String {
    match years {
        [first, .., last] if years.len() > 4 => format!("{} of {first}–{last}", years.len()),
        _ => years.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
    }
}

/// Returns a text that states how well global = diffuse + direct · sin h holds in a weather file, and the clock offset
/// with which it holds best.
fn closure(weather: &Weather, summary: &Summary) -> String {
    let Some(one) = summary.closure else { return "not testable".to_owned() };
    if weather.tested.is_some() {
        return format!(
            "{:.1} W/m² with the table's clock of {:+} min, {:.1} W/m² without",
            one.best_rms, weather.clock, one.rms
        );
    }
    if !one.closes() {
        return format!("{:.1} W/m²; at no clock less than {:.1} W/m²", one.rms, one.best_rms);
    }
    if one.best_offset == 0.0 {
        return format!("{:.1} W/m²: the clock is right", one.rms);
    }
    format!("{:.1} W/m²; {:.1} W/m² with all intervals moved by {:+} min", one.rms, one.best_rms, one.best_offset)
}

/// Prints the weather hour of a scene's sky and its warnings on standard error; nothing without one.
pub fn weather_notes(hour: Option<&HourOfWeather>) {
    let Some(hour) = hour else { return };
    report!("note: {}", hour.note());
    for warning in &hour.warnings {
        report!("warning: {warning}");
    }
}

/// Returns the weather hour of a scene's sky as a JSON object.
pub fn hour_json(one: &HourOfWeather) -> Value {
    let hour = &one.hour;
    json!({
        "weather": one.name,
        "interval": one.interval,
        "offset_minutes": one.offset,
        "sun_altitude_deg": hour.sun.altitude().to_degrees(),
        "sun_azimuth_deg": hour.sun.bearing().degrees(),
        "lit_share": hour.lit,
        "direct_normal_W_m2": hour.direct_normal_irradiance,
        "diffuse_horizontal_W_m2": hour.diffuse_horizontal_irradiance,
        "direct_normal_lx": hour.direct_normal,
        "diffuse_horizontal_lx": hour.diffuse_horizontal,
        "light": match hour.light { LightSource::Efficacy => "efficacy", LightSource::File => "file" },
        "clearness": hour.state.map(|state| state.clearness),
        "brightness": hour.state.map(|state| state.brightness),
        "warnings": one.warnings,
    })
}
