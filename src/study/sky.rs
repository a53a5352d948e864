//! Sky and sun of a scene from the keys `[sky]` and `[site]`: which keys may be given together, and their ranges.

mod hour;
mod illuminance;
mod keys;

pub use self::hour::{HourOfWeather, clock_warning, hour_of_weather, is_elsewhere, site_warnings};
pub use self::illuminance::{Illuminances, Source, TWILIGHT, illuminances};
pub use self::keys::{CLEANEST, HAZIEST, HIGHEST, LOWEST, SkyKeyError};

use self::illuminance::of_sun;
use self::keys::{check_model_keys, check_ranges, day_of_year, sun_direction, wrong};
use super::files;
use super::scene_file::{SiteKeys, SkyKeys, SkyModelKey};
use super::skyline::{behind_skyline, skyline};
use crate::compute::direction::{Dir, World};
use crate::compute::sky::perez::{Air, PerezState, eccentricity};
use crate::compute::sky::{Distribution, Outside, SUN_HALF_ANGLE, Scan, Sun, cie, with_ground_behind_skyline};
use crate::compute::weather::Hour;
use crate::formats::scan::read_scan;
use std::path::Path;

/// Returns sky, ground and skyline, and the sun if it has a direct illuminance and any part of its disc is above the
/// horizon. `base_dir`: folder of the scene file, to which `sky.file` is relative.
pub fn outside_from_keys(
    sky: &SkyKeys,
    site: &SiteKeys,
    base_dir: &Path,
) -> Result<(Outside, Option<Sun>), SkyKeyError> {
    check_ranges(sky, site)?;
    if let Some(one) = hour_of_weather(sky, site, base_dir)? {
        let hour = &one.hour;
        return finished(hour::sky_of(hour, Outside::new)?, Some(hour.sun), hour.direct_normal, sky, site);
    }
    check_model_keys(sky)?;
    let sun = sun_direction(sky, site)?;
    let (outside, direct_normal) = match sky.model {
        SkyModelKey::Uniform => {
            let light = of_sun(sky, site, sun)?;
            (scaled(Distribution::uniform(), light.diffuse_horizontal)?, light.direct_normal)
        }
        SkyModelKey::Cie => {
            // A wrong type is reported first: whether the sun is needed depends on it.
            let distribution = cie_distribution(sky, sun)?;
            let light = of_sun(sky, site, sun)?;
            (scaled(distribution, light.diffuse_horizontal)?, light.direct_normal)
        }
        // Checked above: a model of this name belongs to weather, which was not given.
        SkyModelKey::Weather => return Err(wrong("sky.weather", "missing: the name of a weather file")),
        SkyModelKey::Scan => (measured(sky, base_dir)?, sky.sun.direct_normal.unwrap_or(0.0)),
        SkyModelKey::Perez => {
            let sun = sun.ok_or_else(|| wrong("sky.sun", "model \"perez\" needs altitude and azimuth, or sky.time"))?;
            perez(sky, sun, day_of_year(sky)?.map_or(1.0, eccentricity))?
        }
    };
    if direct_normal > 0.0 && sun.is_none() {
        return Err(wrong("sky.sun", "direct_normal needs altitude and azimuth, or sky.time"));
    }
    finished(outside, sun, direct_normal, sky, site)
}

/// Returns sky and sun of one weather hour, with the ground of `site` and the skyline of `sky`, whose model and values
/// are not used. The illuminance to which the sky is scaled is accurate to 2e-5.
///
/// # Errors
/// Returns an error if ground or skyline are out of range.
pub fn outside_of_hour(hour: &Hour, sky: &SkyKeys, site: &SiteKeys) -> Result<(Outside, Option<Sun>), SkyKeyError> {
    finished(hour::sky_of(hour, Outside::quickly)?, Some(hour.sun), hour.direct_normal, sky, site)
}

/// Returns outside and sun of a weather hour under a uniform sky, for uses that need only the position of the sun, and
/// whether there is light.
///
/// # Errors
/// Returns the errors of [`outside_of_hour`].
pub fn even_outside_of_hour(
    hour: &Hour,
    sky: &SkyKeys,
    site: &SiteKeys,
) -> Result<(Outside, Option<Sun>), SkyKeyError> {
    let even = scaled(Distribution::uniform(), hour.diffuse_horizontal)?;
    finished(even, Some(hour.sun), hour.direct_normal, sky, site)
}

/// Adds sun, ground and skyline to a sky. `direct_normal`: direct normal illuminance. \[lx\]
fn finished(
    outside: Outside,
    sun: Option<Dir<World>>,
    direct_normal: f64,
    sky: &SkyKeys,
    site: &SiteKeys,
) -> Result<(Outside, Option<Sun>), SkyKeyError> {
    let beam = sun
        .filter(|sun| direct_normal > 0.0 && sun.altitude() > -SUN_HALF_ANGLE)
        .map(|direction| Sun { direction, direct_normal });
    let obstruction = sky.obstruction.map_or((0.0, 0.0), |keys| (keys.altitude.to_radians(), keys.luminance));
    let outside = outside
        .with_ground(site.ground_reflectance, beam.map_or(0.0, |sun| sun.horizontal()))
        .map_err(|error| wrong("site.ground_reflectance", error.to_string()))?
        .with_skyline(obstruction.0, obstruction.1)
        .map_err(|error| wrong("sky.obstruction", error.to_string()))?;
    let outside = match &sky.skyline {
        Some(_) if sky.obstruction.is_some() => {
            return Err(wrong("sky.skyline", "given together with sky.obstruction: give one of them"));
        }
        Some(keys) => behind_skyline(outside, skyline(keys).map_err(|(key, message)| wrong(key, message))?),
        None => outside,
    };
    let outside = with_ground_behind_skyline(outside, beam.as_ref());
    Ok((outside, beam))
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
    // The other types do not depend on the direction.
    let sun = sun.unwrap_or(Dir::from_unit(glam::DVec3::Z));
    Distribution::cie(sky_type, sun).ok_or_else(|| wrong("sky.type", format!("{sky_type} is not a type: give {RIGHT}")))
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

/// Returns the Perez sky, and the direct normal illuminance \[lx\]: that of the scene, else from the irradiance by
/// luminous efficacy. `eccentricity`: correction of the solar constant for the day.
fn perez(sky: &SkyKeys, sun: Dir<World>, eccentricity: f64) -> Result<(Outside, f64), SkyKeyError> {
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
    // With its centre on or below the horizon the sun is dark, and what light there is is twilight: the sky of a sun on
    // the horizon.
    let up = altitude > 0.0;
    let (direct, sun, altitude) =
        if up { (direct, sun, altitude) } else { (0.0, Dir::from_altitude_bearing(0.0, sun.bearing()), 0.0) };
    // Near the horizon a horizontal beam may mean more than the sun emits: the solar constant limits it.
    let direct_normal = if up { direct / altitude.sin() } else { 0.0 };
    if direct_normal > 1500.0 {
        let message = format!(
            "{direct} W/m² at a solar altitude of {:.2}° is {direct_normal:.0} W/m² towards the sun (allowed: up to 1500)",
            altitude.to_degrees()
        );
        return Err(wrong("sky.direct_horizontal_irradiance", message));
    }
    if dark {
        // Without diffuse light the clearness is infinite, and there is no sky but the sun.
        if sky.diffuse_horizontal.unwrap_or(0.0) > 0.0 {
            let message = "0 W/m², but diffuse_horizontal is above 0 lx: give the irradiance that belongs to it";
            return Err(wrong("sky.diffuse_horizontal_irradiance", message));
        }
    }
    let state = PerezState::in_air(altitude, direct_normal, diffuse, Air { eccentricity, ..Air::UNKNOWN });
    let beam = match (up, &state) {
        (false, _) | (_, None) => 0.0,
        (true, Some(state)) => sky.sun.direct_normal.unwrap_or(direct_normal * state.direct_efficacy()),
    };
    let Some(state) = state.filter(|_| !dark) else { return Ok((scaled(Distribution::uniform(), 0.0)?, beam)) };
    let illuminance = sky.diffuse_horizontal.unwrap_or(diffuse * state.diffuse_efficacy());
    Ok((scaled(Distribution::perez(&state, sun), illuminance)?, beam))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::example::first_scene;

    #[test]
    fn a_chosen_model_has_all_keys_that_it_needs_and_no_others() {
        for first in SkyModelKey::ALL {
            for next in SkyModelKey::ALL {
                let mut scene = first_scene();
                scene.sky.choose(first);
                scene.sky.choose(next);
                let error = outside_from_keys(&scene.sky, &scene.site, Path::new("")).err().map(|error| error.key);
                let missing = (next == SkyModelKey::Scan).then_some("sky.file");
                assert_eq!(error, missing, "{first:?}, then {next:?}");
            }
        }
    }
}
