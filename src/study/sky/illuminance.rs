//! Illuminances to which a sky and its sun are scaled: given in the scene, or by the sun's altitude.

use super::keys::{SkyKeyError, check_ranges, day_of_year, sun_direction, wrong};
use crate::compute::direction::{Dir, World};
use crate::compute::sky::availability::{Cover, typical_illuminances};
use crate::compute::sky::clear_sky::clear_sky_illuminances;
use crate::study::scene_file::{IlluminanceKey, SiteKeys, SkyKeys, SkyModelKey};

/// Solar altitude at which civil twilight ends; below it no CIE sky applies, and light on the ground does not come from
/// the sun. \[rad\]
pub const TWILIGHT: f64 = -6.0 * std::f64::consts::PI / 180.0;

/// Source of the illuminances to which sky and sun are scaled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// Values given in the scene.
    Stated,
    /// Clear sky by Linke turbidity and elevation, after Ineichen and Perez 2002.
    ClearSky {
        /// Linke turbidity of the atmosphere.
        turbidity: f64,
        /// Elevation above sea level. \[m\]
        elevation: f64,
    },
    /// Typical values for a cloud cover, of IES RP-21, 1984.
    Cover(Cover),
}

/// Illuminances to which a sky and its sun are scaled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Illuminances {
    /// Diffuse horizontal illuminance by the sky. \[lx\]
    pub diffuse_horizontal: f64,
    /// Direct normal illuminance by the sun. \[lx\]
    pub direct_normal: f64,
    /// Source of the illuminances: given in the scene, clear-sky model, or cloud cover.
    pub source: Source,
    /// True altitude of the sun; `None` if the scene does not give the sun. \[rad\]
    pub altitude: Option<f64>,
}

impl Illuminances {
    /// Whether the illuminances follow the sun's altitude and the sun has set, so that it is dark.
    pub fn is_night(&self) -> bool {
        self.source != Source::Stated && self.altitude.is_some_and(|altitude| altitude <= 0.0)
    }

    /// Returns the source as a translated text, such as `clear sky, Linke turbidity 3, 245 m above the sea`.
    pub fn origin(&self) -> String {
        match self.source {
            Source::Stated => "as written in the scene".to_owned(),
            Source::ClearSky { turbidity, elevation } => {
                format!("clear sky, Linke turbidity {turbidity}, {elevation} m above the sea")
            }
            Source::Cover(cover) => format!("{} sky of IES RP-21", cover.word()),
        }
    }

    /// Returns a sentence with the illuminances that are used, or that it is dark; `None` if the scene gives them.
    pub fn note(&self) -> Option<String> {
        let altitude = self.altitude.filter(|_| self.source != Source::Stated)?.to_degrees();
        Some(if self.is_night() {
            format!("the sun is {:.1}° below the horizon: no daylight (sky.illuminance follows the sun)", -altitude)
        } else {
            format!(
                "{}, sun {altitude:.1}° high: diffuse horizontal {:.0} lx, direct normal {:.0} lx",
                self.origin(),
                self.diffuse_horizontal,
                self.direct_normal
            )
        })
    }
}

/// Returns the illuminances to which a scene's sky is scaled; `None` for sky models with absolute values (Perez sky,
/// measured sky).
///
/// # Errors
/// Returns an error that names the key that is wrong or missing.
pub fn illuminances(sky: &SkyKeys, site: &SiteKeys) -> Result<Option<Illuminances>, SkyKeyError> {
    check_ranges(sky, site)?;
    if !sky.model.takes_illuminances() {
        return Ok(None);
    }
    of_sun(sky, site, sun_direction(sky, site)?).map(Some)
}

/// Returns the illuminances for a sky model that is scaled, from a known position of the sun and keys in their ranges.
pub(super) fn of_sun(sky: &SkyKeys, site: &SiteKeys, sun: Option<Dir<World>>) -> Result<Illuminances, SkyKeyError> {
    let altitude = sun.map(Dir::altitude);
    if sky.illuminance == IlluminanceKey::Stated {
        return stated(sky, altitude);
    }
    let Some(height) = altitude else {
        let message = format!("illuminance = \"{}\" needs altitude and azimuth, or sky.time", sky.illuminance.word());
        return Err(wrong("sky.sun", message));
    };
    // A uniform sky is that of thick cloud.
    let cover = match sky.model {
        SkyModelKey::Cie => Cover::of_cie_type(sky.cie_type.unwrap_or(16)),
        _ => Cover::Overcast,
    };
    let (source, (direct_normal, diffuse_horizontal)) =
        if sky.illuminance == IlluminanceKey::ClearSky && cover == Cover::Clear {
            let (turbidity, elevation) = (sky.turbidity, site.elevation);
            (Source::ClearSky { turbidity, elevation }, clear_sky_illuminances(height, turbidity, elevation))
        } else {
            (Source::Cover(cover), typical_illuminances(cover, height, day_of_year(sky)?))
        };
    Ok(Illuminances { diffuse_horizontal, direct_normal, source, altitude })
}

/// Returns the illuminances that the scene gives. `altitude`: altitude of the sun. \[rad\]
fn stated(sky: &SkyKeys, altitude: Option<f64>) -> Result<Illuminances, SkyKeyError> {
    let diffuse_horizontal = sky.diffuse_horizontal.ok_or_else(|| {
        let message = "missing: this model needs it, in lx; or illuminance = \"clear-sky\" or \"rp-21\"";
        wrong("sky.diffuse_horizontal", message)
    })?;
    if let Some(altitude) = altitude.filter(|altitude| *altitude < TWILIGHT)
        && sky.model == SkyModelKey::Cie
        && diffuse_horizontal > 0.0
    {
        let message = format!(
            "{diffuse_horizontal} lx with the sun {:.1}° below the horizon: a CIE sky ends with twilight, 6° below; \
             give 0, another time, or illuminance = \"clear-sky\", which is dark then",
            -altitude.to_degrees()
        );
        return Err(wrong("sky.diffuse_horizontal", message));
    }
    let direct_normal = sky.sun.direct_normal.unwrap_or(0.0);
    Ok(Illuminances { diffuse_horizontal, direct_normal, source: Source::Stated, altitude })
}
