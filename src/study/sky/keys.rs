//! Checks of the keys of `[sky]` and `[site]`, each and in combination, and the position of the sun that they give.

use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, World};
use crate::compute::limits;
use crate::compute::weather::Day;
use crate::study::scene_file::{SiteKeys, SkyKeys, SkyModelKey};
use crate::study::sun_position::{Place, parse_local_time, sun_position};

/// Minimum elevation of a site above sea level: the lowest inhabited places with some margin. \[m\]
pub const LOWEST: f64 = -500.0;
/// Maximum elevation of a site above sea level: the highest inhabited places with some margin. \[m\]
pub const HIGHEST: f64 = 9000.0;
/// Minimum Linke turbidity: that of clean dry air.
pub const CLEANEST: f64 = 1.0;
/// Maximum Linke turbidity: beyond it the sky is not a clear one.
pub const HAZIEST: f64 = 12.0;

/// Error of a key of the scene's sky or site, with what was expected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key}: {message}")]
pub struct SkyKeyError {
    /// Full name of the key, such as `sky.type`.
    pub key: &'static str,
    /// Message that says what is wrong and what was expected.
    pub message: String,
}

/// Creates the error about a wrong key.
pub(super) fn wrong(key: &'static str, message: impl Into<String>) -> SkyKeyError {
    SkyKeyError { key, message: message.into() }
}

/// Checks the ranges of keys that apply to all sky models.
///
/// # Errors
/// Returns an error that names the first key out of range.
pub(super) fn check_ranges(sky: &SkyKeys, site: &SiteKeys) -> Result<(), SkyKeyError> {
    let within = |key, value: Option<f64>, min: f64, max: f64, unit: &str| match value {
        Some(value) if !(min..=max).contains(&value) => {
            // Very large numbers are written without hundreds of digits.
            let short = |x: f64| if x.abs() < 1e7 { format!("{x}") } else { format!("{x:e}") };
            let (value, min, max) = (short(value), short(min), short(max));
            let allowed = format!("{min} to {max}");
            let value = format!("{value} {unit}");
            Err(wrong(key, format!("{} is out of range (allowed: {allowed})", value.trim_end())))
        }
        _ => Ok(()),
    };
    within("site.ground_reflectance", Some(site.ground_reflectance), 0.0, 1.0, "")?;
    within("site.azimuth", Some(site.azimuth), -360.0, 360.0, "°")?;
    within("site.elevation", Some(site.elevation), LOWEST, HIGHEST, "m")?;
    within("sky.turbidity", Some(sky.turbidity), CLEANEST, HAZIEST, "")?;
    within("sky.sun.altitude", sky.sun.altitude, -90.0, 90.0, "°")?;
    within("sky.sun.azimuth", sky.sun.azimuth, -360.0, 360.0, "°")?;
    within("sky.sun.direct_normal", sky.sun.direct_normal, 0.0, limits::ILLUMINANCE, "lx")?;
    within("sky.diffuse_horizontal", sky.diffuse_horizontal, 0.0, limits::ILLUMINANCE, "lx")?;
    within("sky.direct_horizontal_irradiance", sky.direct_horizontal_irradiance, 0.0, 1500.0, "W/m²")?;
    within("sky.diffuse_horizontal_irradiance", sky.diffuse_horizontal_irradiance, 0.0, 1500.0, "W/m²")?;
    if let Some(obstruction) = sky.obstruction {
        within("sky.obstruction.altitude", Some(obstruction.altitude), 0.0, 89.999, "°")?;
        within("sky.obstruction.luminance", Some(obstruction.luminance), 0.0, limits::LUMINANCE, "cd/m²")?;
    }
    Ok(())
}

/// Checks that no key of one sky model is given for another.
pub(super) fn check_model_keys(sky: &SkyKeys) -> Result<(), SkyKeyError> {
    let only = |key, given: bool, model: SkyModelKey, name: &str| {
        if given && sky.model != model {
            Err(wrong(key, format!("is only valid with model = \"{name}\"; remove it")))
        } else {
            Ok(())
        }
    };
    only("sky.type", sky.cie_type.is_some(), SkyModelKey::Cie, "cie")?;
    only("sky.file", sky.file.is_some(), SkyModelKey::Scan, "scan")?;
    let (direct, diffuse) = (sky.direct_horizontal_irradiance, sky.diffuse_horizontal_irradiance);
    only("sky.direct_horizontal_irradiance", direct.is_some(), SkyModelKey::Perez, "perez")?;
    only("sky.diffuse_horizontal_irradiance", diffuse.is_some(), SkyModelKey::Perez, "perez")
}

/// Returns the day of the year for the date of `sky.time`, 1 to 365; `None` without a date.
pub(super) fn day_of_year(sky: &SkyKeys) -> Result<Option<u16>, SkyKeyError> {
    let Some(time) = &sky.time else { return Ok(None) };
    let time = parse_local_time(&time.text()).map_err(|error| wrong("sky.time", error.to_string()))?;
    let day = Day::new(time.year(), time.month().unsigned_abs(), time.day().unsigned_abs());
    Ok(day.map(Day::of_common_year))
}

/// Returns the direction of the sun in the world frame, from angles or else from time; `None` if the scene gives
/// neither.
pub(super) fn sun_direction(sky: &SkyKeys, site: &SiteKeys) -> Result<Option<Dir<World>>, SkyKeyError> {
    let angles = sky.sun.altitude.is_some() || sky.sun.azimuth.is_some();
    let Some(time) = sky.time.as_ref().filter(|_| !angles) else {
        return match (sky.sun.altitude, sky.sun.azimuth) {
            (Some(altitude), Some(azimuth)) => {
                Ok(Some(Dir::from_altitude_bearing(altitude.to_radians(), Bearing::from_degrees(azimuth))))
            }
            // At the zenith every bearing is the same.
            (Some(90.0), None) => Ok(Some(Dir::from_unit(glam::DVec3::Z))),
            (None, None) => Ok(None),
            (Some(_), None) => Err(wrong("sky.sun.azimuth", "missing: sun.altitude needs a compass bearing beside it")),
            (None, Some(_)) => Err(wrong("sky.sun.altitude", "missing: sun.azimuth needs an altitude beside it")),
        };
    };
    let need = |key, value: Option<f64>| value.ok_or_else(|| wrong(key, "missing: sky.time needs it"));
    let latitude = need("site.latitude", site.latitude)?;
    let longitude = need("site.longitude", site.longitude)?;
    let utc_offset = need("site.utc_offset", site.utc_offset)?;
    let place = Place::new(latitude, longitude, utc_offset).map_err(|error| wrong("site", error.to_string()))?;
    let time = parse_local_time(&time.text()).map_err(|error| wrong("sky.time", error.to_string()))?;
    let standard = site.dst.standard(time, utc_offset);
    let (altitude, bearing) = sun_position(&place, standard).map_err(|error| wrong("sky.time", error.to_string()))?;
    Ok(Some(Dir::from_altitude_bearing(altitude, bearing)))
}
