//! Illuminance of façade and apertures from outside, and its change by each obstruction.

use super::error::StudyError;
use super::library::Library;
use super::scene::Scene;
use super::scene_file::{ApertureKeys, ApertureReflectance, IdealKind, SceneFile, SurfaceKey, SystemKeys};
use super::session::Session;
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Surface};
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::room::aperture::Aperture;
use crate::compute::sky::{Outside, Sun, irradiance};
use crate::compute::surroundings::skyline::Skyline;
use std::path::Path;

/// System in every aperture when its illuminance from outside is computed, which does not depend on the system.
const TRANSPARENT: SystemKeys = SystemKeys::Ideal { kind: IdealKind::Transparent, transmittance: 1.0 };

/// Illuminance of the façade (in its plane, from outside). \[lx\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacadeLight {
    /// Illuminance by sky, ground, skyline and obstructions. \[lx\]
    pub diffuse: Estimate,
    /// Illuminance by direct sun. \[lx\]
    pub direct: f64,
    /// Whether the illuminance is a mean over apertures behind obstructions.
    pub behind: bool,
}

/// Computes the illuminance of the façade under sky and sun of a scene. Without boxes and building it is the same
/// everywhere; behind them it is the mean over the façade's apertures by area, or over the whole façade if it has none.
/// `base`: folder of the scene file.
///
/// # Errors
/// Returns an error if a key of the scene is wrong, or if cancelled.
pub fn facade_light(
    file: &SceneFile,
    base: &Path,
    (outside, sun): (&Outside, Option<&Sun>),
    progress: &dyn Progress,
) -> Result<FacadeLight, StudyError> {
    let foot = file.site.ground_height.max(0.0);
    let any = file.aperture.iter().any(|one| one.surface == SurfaceKey::Facade);
    // A building in front of the wall, or ground as high as it, obstructs it where the wall has no aperture.
    let hidden = file.building.as_ref().is_some_and(|building| building.from[1] < 0.0) || foot >= file.room.height;
    if file.outside.is_empty() && file.building.is_none() || hidden && !any {
        let normal = Dir::from_altitude_bearing(0.0, Bearing::from_degrees(file.site.azimuth));
        let share = |sun: &Sun| {
            let skyline = outside.surroundings().and_then(|around| around.skyline.as_ref());
            let own = |skyline: &Skyline| skyline.altitude(sun.direction.bearing().radians());
            sun.share_above(skyline.map_or(outside.skyline_altitude(), own))
        };
        let direct = sun.map_or(0.0, |sun| sun.direct_normal * sun.direction.dot(normal).max(0.0) * share(sun));
        return Ok(FacadeLight { diffuse: irradiance(outside, normal), direct, behind: false });
    }
    let mut file = file.clone();
    if !any {
        file.aperture.push(ApertureKeys {
            surface: SurfaceKey::Facade,
            origin: [0.0, foot],
            size: [file.room.width, file.room.height - foot],
            system: TRANSPARENT,
            reflectance: ApertureReflectance::Value(0.0),
            structure: None,
            frame: 0.0,
            dirt: 1.0,
            control: None,
        });
    }
    let on_facade = |one: &Aperture| one.surface == Surface::Facade;
    let [diffuse, direct] = received(&file, base, &Session::new(), on_facade, progress)?;
    Ok(FacadeLight { diffuse, direct: direct.value, behind: true })
}

/// Computes for every box, then for the building if there is one, the relative change of the apertures' illuminance
/// from outside if this obstruction were removed; `None` where the apertures are dark. `base`: folder of the scene
/// file.
///
/// # Errors
/// Returns the errors of [`facade_light`].
pub fn obstruction_effects(
    file: &SceneFile,
    base: &Path,
    progress: &dyn Progress,
) -> Result<Option<Vec<Estimate>>, StudyError> {
    let session = Session::new();
    let light = |file: &SceneFile| {
        let [diffuse, direct] = received(file, base, &session, |_| true, progress)?;
        Ok::<_, StudyError>(diffuse + direct)
    };
    let with = light(file)?;
    if with.value <= 0.0 {
        return Ok(None);
    }
    let count = file.outside.len() + usize::from(file.building.is_some());
    let without = |number: usize| {
        progress.advance("obstructions", number, count);
        let mut rest = file.clone();
        if number < file.outside.len() {
            rest.outside.remove(number);
        } else {
            rest.building = None;
        }
        let light = light(&rest)?;
        let ratio = light.value / with.value;
        Ok(Estimate::new(ratio - 1.0, (light.error + ratio * with.error) / with.value))
    };
    (0..count).map(without).collect::<Result<_, StudyError>>().map(Some)
}

/// Returns the aperture with a system that transmits all light, and without control.
fn open(keys: &ApertureKeys) -> ApertureKeys {
    ApertureKeys {
        system: TRANSPARENT,
        reflectance: ApertureReflectance::Value(0.0),
        structure: None,
        control: None,
        ..*keys
    }
}

/// Returns the diffuse and the direct illuminance from outside of the apertures for which `wanted` is `true`, as means
/// by area. \[lx\]
fn received(
    file: &SceneFile,
    base: &Path,
    session: &Session,
    wanted: impl Fn(&Aperture) -> bool,
    progress: &dyn Progress,
) -> Result<[Estimate; 2], StudyError> {
    let file = SceneFile { aperture: file.aperture.iter().map(open).collect(), control: None, ..file.clone() };
    let scene = Scene::resolve_within(&file, base, &Library::default(), progress)?;
    let (mut sums, mut all) = ([Estimate::default(); 2], 0.0);
    for (index, one) in scene.apertures.iter().enumerate().filter(|(_, one)| wanted(&one.aperture)) {
        let (diffuse, direct) = session.lid(&scene, index, progress)?.incident;
        let area = one.aperture.area();
        sums = [sums[0] + diffuse * area, sums[1] + Estimate::exact(direct) * area];
        all += area;
    }
    Ok(sums.map(|sum| sum * (1.0 / all)))
}
