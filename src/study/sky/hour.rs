//! Hour of a weather file as sky and sun of a scene.

use super::keys::{SkyKeyError, wrong};
use crate::compute::sky::{Distribution, Outside, SkyError};
use crate::compute::weather::{Closure, Hour, LightSource, Reading, Station, SunOffset, Weather};
use crate::study::scene_file::{IlluminanceKey, SiteKeys, SkyKeys, SkyModelKey};
use crate::study::sun_position::parse_local_time;
use crate::study::weather::kept;
use crate::study::weather_keys::reading;
use std::path::Path;

/// Maximum difference in latitude and in longitude between a scene and its weather station without a warning. \[°\]
const SAME_PLACE: f64 = 0.5;
/// Maximum difference between the UTC offsets of a scene and of its weather without a warning. \[h\]
const SAME_CLOCK: f64 = 0.5;

/// Hour of a weather file that the keys `sky.weather` and `sky.time` name.
#[derive(Debug, Clone, PartialEq)]
pub struct HourOfWeather {
    /// Position of the sun, irradiances and illuminances of the hour.
    pub hour: Hour,
    /// Day and interval of the row in the weather file, such as `1958-03-21 12:00–13:00`.
    pub interval: String,
    /// Name of the weather file or built-in year in the scene.
    pub name: String,
    /// Weather station, whose geographic location is used.
    pub station: Station,
    /// Time by which the interval was shifted from that in the file. \[min\]
    pub offset: f64,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

impl HourOfWeather {
    /// Returns a line of text with the hour, its irradiances and illuminances, the position of the sun, and the method
    /// by which the illuminances were found.
    pub fn note(&self) -> String {
        let hour = &self.hour;
        let light = match hour.light {
            LightSource::Efficacy => "by luminous efficacy",
            LightSource::File => "as the file states them",
        };
        let moved = if self.offset == 0.0 { String::new() } else { format!(" moved by {:+} min", self.offset) };
        format!(
            "weather {}, {}{moved}: direct normal {:.0} W/m², diffuse {:.0} W/m², sun at {:.2}°, bearing {:.2}°; \
             direct normal {:.0} lx, diffuse {:.0} lx {light}",
            self.name,
            self.interval,
            hour.direct_normal_irradiance,
            hour.diffuse_horizontal_irradiance,
            hour.sun.altitude().to_degrees(),
            hour.sun.bearing().degrees(),
            hour.direct_normal,
            hour.diffuse_horizontal,
        )
    }
}

/// Returns the weather hour of a scene's sky; `None` for skies of a model. `base`: folder to which paths are relative.
///
/// # Errors
/// Returns an error if keys do not go with `sky.weather`, a file cannot be read, or it does not hold the hour.
pub fn hour_of_weather(sky: &SkyKeys, site: &SiteKeys, base: &Path) -> Result<Option<HourOfWeather>, SkyKeyError> {
    check_keys(sky)?;
    let Some(name) = &sky.weather else { return Ok(None) };
    let Some(time) = &sky.time else {
        return Err(wrong("sky.time", "missing: sky.weather needs it, month, day and hour of the row"));
    };
    let time = parse_local_time(&time.text()).map_err(|error| wrong("sky.time", error.to_string()))?;
    let kept = kept(name, base).map_err(|error| wrong("sky.weather", error.to_string()))?;
    let (weather, closure) = (&kept.weather, kept.summary.closure.as_ref());
    let asked = reading(sky.light, sky.sun_offset_minutes);
    let reading = match (asked.offset, closure) {
        (SunOffset::Auto, Some(closure)) if weather.tested.is_none() => {
            Reading { offset: SunOffset::Minutes(closure.best_offset), ..asked }
        }
        _ => asked,
    };
    let failed =
        |error: crate::compute::weather::HourError| wrong("sky.weather", format!("{}: {error}", name.display()));
    let mut hours = weather.hours(reading).map_err(failed)?;
    // People read the hour off their clock; records are in the standard time of the weather's own place.
    let time = site.dst.standard(time, weather.station.utc_offset);
    let row = time.saturating_sub(jiff::Span::new().minutes(hours.moved_clock()));
    let second = 3600 * row.hour() as u32 + 60 * row.minute() as u32 + row.second() as u32;
    let index = weather.find(row.month() as u8, row.day() as u8, second).ok_or_else(|| {
        let found = format!("{} has no interval that holds {}", name.display(), time.strftime("%-d %B, %H:%M"));
        wrong("sky.time", format!("{found}; expected one of its {} rows", weather.records.len()))
    })?;
    let hour = hours.at(index).map_err(failed)?;
    let record = &weather.records[index];
    let mut warnings = site_warnings(&weather.station, site);
    warnings.extend(kept.warnings().map(|one| format!("{}: {}", name.display(), one.message)));
    warnings.extend(clock_warning(weather, name, asked, closure, "sun_offset_minutes"));
    Ok(Some(HourOfWeather {
        hour,
        interval: record.label(weather.interval),
        name: name.display().to_string(),
        station: weather.station.clone(),
        offset: hours.offset(),
        warnings,
    }))
}

/// Checks that no key of a sky model is given together with `sky.weather`, and no key of the weather without it.
fn check_keys(sky: &SkyKeys) -> Result<(), SkyKeyError> {
    let by_weather = sky.model == SkyModelKey::Weather;
    if sky.weather.is_none() {
        const ALONE: &str = "is only valid with sky.weather; remove it";
        if by_weather {
            let message = "missing: \"cie\", \"uniform\", \"perez\" or \"scan\"; or weather = a file, and time";
            return Err(wrong("sky.model", message));
        }
        if !sky.light.is_default() {
            return Err(wrong("sky.light", ALONE));
        }
        return if sky.sun_offset_minutes.is_default() { Ok(()) } else { Err(wrong("sky.sun_offset_minutes", ALONE)) };
    }
    let not_beside = |key: &'static str, given: bool| {
        if given {
            Err(wrong(key, "given together with sky.weather, which includes it; remove one of them"))
        } else {
            Ok(())
        }
    };
    not_beside("sky.model", !by_weather)?;
    not_beside("sky.illuminance", sky.illuminance != IlluminanceKey::Stated)?;
    not_beside("sky.type", sky.cie_type.is_some())?;
    not_beside("sky.file", sky.file.is_some())?;
    not_beside("sky.diffuse_horizontal", sky.diffuse_horizontal.is_some())?;
    not_beside("sky.direct_horizontal_irradiance", sky.direct_horizontal_irradiance.is_some())?;
    not_beside("sky.diffuse_horizontal_irradiance", sky.diffuse_horizontal_irradiance.is_some())?;
    let sun = &sky.sun;
    not_beside("sky.sun", sun.altitude.is_some() || sun.azimuth.is_some() || sun.direct_normal.is_some())
}

/// Returns a warning if the clock of a weather file contradicts its own irradiances and no key corrects it. `key`: name
/// of the key that would correct it.
pub fn clock_warning(
    weather: &Weather,
    name: &Path,
    reading: Reading,
    closure: Option<&Closure>,
    key: &str,
) -> Option<String> {
    let unmoved = reading.offset == SunOffset::Minutes(0.0) && weather.tested.is_none();
    closure.filter(|closure| unmoved && closure.is_off()).map(|closure| {
        format!(
            "the clock of {} disagrees with its irradiances, which close to {:.1} W/m², and to {:.1} W/m² with {key} = {}",
            name.display(),
            closure.rms,
            closure.best_rms,
            closure.best_offset
        )
    })
}

/// Whether a scene states another location or UTC offset than its weather station, whose location and clock are used.
pub fn is_elsewhere(station: &Station, site: &SiteKeys) -> bool {
    !site_warnings(station, site).is_empty()
}

/// Returns a warning for every key in which a scene states another location or UTC offset than its weather station,
/// whose location and clock are used.
pub fn site_warnings(station: &Station, site: &SiteKeys) -> Vec<String> {
    [
        ("site.latitude", site.latitude, station.latitude, SAME_PLACE, "°"),
        ("site.longitude", site.longitude, station.longitude, SAME_PLACE, "°"),
        ("site.utc_offset", site.utc_offset, station.utc_offset, SAME_CLOCK, " h"),
    ]
    .into_iter()
    .filter_map(|(key, given, own, most, unit)| {
        let given = given.filter(|given| (given - own).abs() > most)?;
        Some(format!("{key} = {given}{unit}, but the weather is that of {own}{unit}: its own place and clock count"))
    })
    .collect()
}

/// Creates the sky of a weather hour, scaled to its diffuse horizontal illuminance, over black ground. `by`: function
/// that scales it.
pub(super) fn sky_of(
    hour: &Hour,
    by: fn(Distribution, f64) -> Result<Outside, SkyError>,
) -> Result<Outside, SkyKeyError> {
    let (distribution, light) = match &hour.state {
        Some(state) if hour.diffuse_horizontal > 0.0 => {
            (Distribution::perez(state, hour.sky_sun()), hour.diffuse_horizontal)
        }
        _ => (Distribution::uniform(), 0.0),
    };
    by(distribution, light).map_err(|error| wrong("sky.weather", error.to_string()))
}
