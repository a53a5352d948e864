//! From the scene's `[sky]` and `[site]` to sky and sun: which keys belong together, and what they may be.

use super::files;
use super::scene_file::{SiteKeys, SkyKeys, SkyModelKey};
use super::sun_position::{Place, parse_local_time, sun_position};
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, World};
use crate::compute::sky::perez::PerezState;
use crate::compute::sky::{Distribution, Outside, SUN_HALF_ANGLE, Scan, Sun, cie};
use crate::formats::scan::read_scan;
use std::path::Path;

/// A key of the scene that is wrong, and what would be right.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key}: {message}")]
pub struct SkyKeyError {
    /// Full name of the key, e.g. `sky.type`.
    pub key: &'static str,
    /// What is wrong and what would be right.
    pub message: String,
}

fn wrong(key: &'static str, message: impl Into<String>) -> SkyKeyError {
    SkyKeyError { key, message: message.into() }
}

/// Sky, ground and skyline, and the sun where there is a beam and any of its disc is above the horizon.
/// `base_dir`: the scene file's directory, which `sky.file` is relative to.
pub fn outside_from_keys(
    sky: &SkyKeys,
    site: &SiteKeys,
    base_dir: &Path,
) -> Result<(Outside, Option<Sun>), SkyKeyError> {
    check_ranges(sky, site)?;
    check_model_keys(sky)?;
    let sun = sun_direction(sky, site)?;
    let mut direct_normal = sky.sun.direct_normal.unwrap_or(0.0);
    if direct_normal > 0.0 && sun.is_none() {
        return Err(wrong("sky.sun", "direct_normal needs altitude and azimuth, or sky.time"));
    }
    let outside = match sky.model {
        SkyModelKey::Uniform => scaled(Distribution::uniform(), required_illuminance(sky)?)?,
        SkyModelKey::Cie => scaled(cie_distribution(sky, sun)?, required_illuminance(sky)?)?,
        SkyModelKey::Scan => measured(sky, base_dir)?,
        SkyModelKey::Perez => {
            let sun = sun.ok_or_else(|| wrong("sky.sun", "model \"perez\" needs altitude and azimuth, or sky.time"))?;
            let (outside, beam) = perez(sky, sun)?;
            direct_normal = beam;
            outside
        }
    };
    let beam = sun
        .filter(|sun| direct_normal > 0.0 && sun.altitude() > -SUN_HALF_ANGLE)
        .map(|direction| Sun { direction, direct_normal });
    let obstruction = sky.obstruction.map_or((0.0, 0.0), |keys| (keys.altitude.to_radians(), keys.luminance));
    let outside = outside
        .with_ground(site.ground_reflectance, beam.map_or(0.0, |sun| sun.horizontal()))
        .map_err(|error| wrong("site.ground_reflectance", error.to_string()))?
        .with_skyline(obstruction.0, obstruction.1)
        .map_err(|error| wrong("sky.obstruction", error.to_string()))?;
    Ok((outside, beam))
}

/// Ranges that hold whatever the model.
fn check_ranges(sky: &SkyKeys, site: &SiteKeys) -> Result<(), SkyKeyError> {
    let within = |key, value: Option<f64>, min: f64, max: f64, unit: &str| match value {
        Some(value) if !(min..=max).contains(&value) => {
            let allowed = if max == f64::MAX { format!("{min} and above") } else { format!("{min} to {max}") };
            Err(wrong(key, format!("{value} {unit} is out of range (allowed: {allowed})")))
        }
        _ => Ok(()),
    };
    const NO_LIMIT: f64 = f64::MAX;
    within("site.ground_reflectance", Some(site.ground_reflectance), 0.0, 1.0, "")?;
    within("site.azimuth", Some(site.azimuth), -360.0, 360.0, "°")?;
    within("sky.sun.altitude", sky.sun.altitude, -90.0, 90.0, "°")?;
    within("sky.sun.azimuth", sky.sun.azimuth, -360.0, 360.0, "°")?;
    within("sky.sun.direct_normal", sky.sun.direct_normal, 0.0, NO_LIMIT, "lx")?;
    within("sky.diffuse_horizontal", sky.diffuse_horizontal, 0.0, NO_LIMIT, "lx")?;
    within("sky.direct_horizontal_irradiance", sky.direct_horizontal_irradiance, 0.0, 1500.0, "W/m²")?;
    within("sky.diffuse_horizontal_irradiance", sky.diffuse_horizontal_irradiance, 0.0, 1500.0, "W/m²")?;
    if let Some(obstruction) = sky.obstruction {
        within("sky.obstruction.altitude", Some(obstruction.altitude), 0.0, 89.999, "°")?;
        within("sky.obstruction.luminance", Some(obstruction.luminance), 0.0, NO_LIMIT, "cd/m²")?;
    }
    Ok(())
}

/// Keys that only one model takes, and the other way round.
fn check_model_keys(sky: &SkyKeys) -> Result<(), SkyKeyError> {
    let only = |key, given: bool, model: SkyModelKey, name: &str| {
        if given && sky.model != model {
            Err(wrong(key, format!("belongs to model = \"{name}\" alone: leave it out")))
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

/// From angles or from time; `None` with neither.
fn sun_direction(sky: &SkyKeys, site: &SiteKeys) -> Result<Option<Dir<World>>, SkyKeyError> {
    let Some(time) = &sky.time else {
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
    if sky.sun.altitude.is_some() || sky.sun.azimuth.is_some() {
        return Err(wrong("sky.time", "given together with sun angles: give either the time or altitude and azimuth"));
    }
    let need = |key, value: Option<f64>| value.ok_or_else(|| wrong(key, "missing: sky.time needs it"));
    let latitude = need("site.latitude", site.latitude)?;
    let longitude = need("site.longitude", site.longitude)?;
    let utc_offset = need("site.utc_offset", site.utc_offset)?;
    let place = Place::new(latitude, longitude, utc_offset).map_err(|error| wrong("site", error.to_string()))?;
    let time = parse_local_time(&time.text()).map_err(|error| wrong("sky.time", error.to_string()))?;
    let (altitude, bearing) = sun_position(&place, time).map_err(|error| wrong("sky.time", error.to_string()))?;
    Ok(Some(Dir::from_altitude_bearing(altitude, bearing)))
}

fn required_illuminance(sky: &SkyKeys) -> Result<f64, SkyKeyError> {
    sky.diffuse_horizontal.ok_or_else(|| wrong("sky.diffuse_horizontal", "missing: this model needs it, in lx"))
}

fn scaled(distribution: Distribution, diffuse_horizontal: f64) -> Result<Outside, SkyKeyError> {
    Outside::new(distribution, diffuse_horizontal).map_err(|error| wrong("sky.diffuse_horizontal", error.to_string()))
}

fn cie_distribution(sky: &SkyKeys, sun: Option<Dir<World>>) -> Result<Distribution, SkyKeyError> {
    const RIGHT: &str = "1 to 15 (ISO 15469), or 16 for the traditional overcast sky";
    let sky_type = sky.cie_type.ok_or_else(|| wrong("sky.type", format!("missing: give {RIGHT}")))?;
    if sun.is_none() && cie::needs_sun(sky_type) {
        let message = format!("type {sky_type} has a circumsolar part: give altitude and azimuth, or sky.time");
        return Err(wrong("sky.sun", message));
    }
    // The other types take no notice of the direction.
    let sun = sun.unwrap_or(Dir::from_unit(glam::DVec3::Z));
    Distribution::cie(sky_type, sun).ok_or_else(|| wrong("sky.type", format!("{sky_type} is no type: give {RIGHT}")))
}

fn measured(sky: &SkyKeys, base_dir: &Path) -> Result<Outside, SkyKeyError> {
    let Some(file) = &sky.file else {
        return Err(wrong("sky.file", "missing: model \"scan\" needs a file of 145 luminances"));
    };
    let path = base_dir.join(file);
    let bytes = files::read(&path).map_err(|error| wrong("sky.file", error.to_string()))?;
    let scan: Scan = read_scan(&bytes).map_err(|error| wrong("sky.file", format!("{}: {error}", path.display())))?;
    match sky.diffuse_horizontal {
        Some(illuminance) => scaled(Distribution::scan(scan), illuminance),
        None => Ok(Outside::measured(scan)),
    }
}

/// The sky, and the beam on a plane that faces the sun \[lx\]: as given, else by luminous efficacy.
fn perez(sky: &SkyKeys, sun: Dir<World>) -> Result<(Outside, f64), SkyKeyError> {
    let need = |key, value: Option<f64>| {
        value.ok_or_else(|| wrong(key, "missing: model \"perez\" needs it, in W/m² on the horizontal plane"))
    };
    let direct = need("sky.direct_horizontal_irradiance", sky.direct_horizontal_irradiance)?;
    let diffuse = need("sky.diffuse_horizontal_irradiance", sky.diffuse_horizontal_irradiance)?;
    let altitude = sun.altitude();
    let dark = diffuse == 0.0;
    if dark && direct == 0.0 {
        // Night: nothing to distribute, wherever the sun is.
        let illuminance = sky.diffuse_horizontal.unwrap_or(0.0);
        if illuminance > 0.0 {
            let message = "0 W/m², but diffuse_horizontal is above 0 lx: give the irradiance that belongs to it";
            return Err(wrong("sky.diffuse_horizontal_irradiance", message));
        }
        return Ok((scaled(Distribution::uniform(), 0.0)?, sky.sun.direct_normal.unwrap_or(0.0)));
    }
    if altitude <= 0.0 {
        let message = format!(
            "the sun is at {:.2}°: model \"perez\" with irradiances above 0 needs it above the horizon",
            altitude.to_degrees()
        );
        return Err(wrong("sky.sun.altitude", message));
    }
    // Near the horizon a beam on the horizontal plane is more than the sun sends: the solar constant bounds it.
    let direct_normal = direct / altitude.sin();
    if direct_normal > 1500.0 {
        let message = format!(
            "{direct} W/m² at a solar altitude of {:.2}° is {direct_normal:.0} W/m² towards the sun (allowed: up to 1500)",
            altitude.to_degrees()
        );
        return Err(wrong("sky.direct_horizontal_irradiance", message));
    }
    if dark {
        // No diffuse light: the clearness is infinite, there is no sky but the sun.
        if sky.diffuse_horizontal.unwrap_or(0.0) > 0.0 {
            let message = "0 W/m², but diffuse_horizontal is above 0 lx: give the irradiance that belongs to it";
            return Err(wrong("sky.diffuse_horizontal_irradiance", message));
        }
        let beam = sky.sun.direct_normal.ok_or_else(|| {
            wrong("sky.sun.direct_normal", "missing: without diffuse light there is no luminous efficacy for the beam")
        })?;
        return Ok((scaled(Distribution::uniform(), 0.0)?, beam));
    }
    let state = PerezState::new(altitude, direct_normal, diffuse)
        .ok_or_else(|| wrong("sky.diffuse_horizontal_irradiance", "these irradiances give no state of the sky"))?;
    let illuminance = sky.diffuse_horizontal.unwrap_or(diffuse * state.diffuse_efficacy());
    let beam = sky.sun.direct_normal.unwrap_or(direct_normal * state.direct_efficacy());
    Ok((scaled(Distribution::perez(&state, sun), illuminance)?, beam))
}
