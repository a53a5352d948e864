//! Illuminance of façade and apertures from outside, and what obstructions do to it.

use super::error::StudyError;
use super::outside::Before;
use super::scene_file::{SceneFile, SurfaceKey};
use super::scene_places::{apertures, room};
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Orientation, Surface};
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::lid::Facing;
use crate::compute::quadrature::gauss_legendre;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::beams_past::lit;
use crate::compute::sky::{Outside, Sun, irradiance};
use crate::compute::surroundings::skyline::Skyline;
use glam::DVec3;

/// Illuminance of the façade from outside. \[lx\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacadeLight {
    /// By sky, ground, skyline and obstructions.
    pub diffuse: Estimate,
    /// By the sun.
    pub direct: f64,
    /// Whether it is a mean over apertures behind obstructions.
    pub behind: bool,
}

/// Finds the illuminance of the façade under sky and sun of a scene: without boxes and building it is the same all over; behind
/// them it is the mean over the façade's apertures by area, or over the whole façade if there are none.
///
/// # Errors
/// Keys of room, apertures and obstructions that are wrong; cancelled.
pub fn facade_light(
    file: &SceneFile,
    outside: &Outside,
    sun: Option<&Sun>,
    progress: &dyn Progress,
) -> Result<FacadeLight, StudyError> {
    // A building before the wall hides it where the wall has no aperture.
    let facade = file.aperture.iter().any(|one| one.surface == SurfaceKey::Facade);
    let inside = file.building.as_ref().is_some_and(|building| !facade && building.from[1] < 0.0);
    if inside || file.outside.is_empty() && file.building.is_none() {
        let normal = Dir::from_altitude_bearing(0.0, Bearing::from_degrees(file.site.azimuth));
        let share = |sun: &Sun| {
            let skyline = outside.surroundings().and_then(|around| around.skyline.as_ref());
            let own = |skyline: &Skyline| skyline.altitude(sun.direction.bearing().radians());
            sun.share_above(skyline.map_or(outside.skyline_altitude(), own))
        };
        let direct = sun.map_or(0.0, |sun| sun.direct_normal * sun.direction.dot(normal).max(0.0) * share(sun));
        return Ok(FacadeLight { diffuse: irradiance(outside, normal), direct, behind: false });
    }
    let room = room(&file.room)?;
    let mut all = if file.aperture.is_empty() { Vec::new() } else { apertures(&file.aperture, &room)? };
    let before = Before::of(file, &room, &all)?;
    all.retain(|one| one.surface == Surface::Facade);
    if all.is_empty() {
        // The façade as far as it stands free above the ground.
        let foot = file.site.ground_height.clamp(0.0, 0.99 * room.size.z);
        let size = [room.size.x, room.size.z - foot];
        all.push(Aperture { surface: Surface::Facade, corner: foot * DVec3::Z, size });
    }
    let (diffuse, direct) = behind_obstructions(file, before.seen_by(&all), &all, outside, sun, progress)?;
    Ok(FacadeLight { diffuse, direct, behind: true })
}

/// Finds for every box, then for the building if there is one, by how much the illuminance of the apertures from outside would
/// change without it, relative to that with all of them; `None` where they are dark.
///
/// # Errors
/// As [`facade_light`].
pub fn obstruction_effects(
    file: &SceneFile,
    outside: &Outside,
    sun: Option<&Sun>,
    progress: &dyn Progress,
) -> Result<Option<Vec<Estimate>>, StudyError> {
    let room = room(&file.room)?;
    let all = apertures(&file.aperture, &room)?;
    let light = |file: &SceneFile| {
        let before = Before::of(file, &room, &all)?;
        let (diffuse, direct) = behind_obstructions(file, before, &all, outside, sun, progress)?;
        Ok::<_, StudyError>(diffuse + Estimate::exact(direct))
    };
    let with = light(file)?;
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
    if with.value <= 0.0 {
        return Ok(None);
    }
    (0..count).map(without).collect::<Result<_, StudyError>>().map(Some)
}

/// Illuminance of apertures behind obstructions, means by area: diffuse and direct.
fn behind_obstructions(
    file: &SceneFile,
    before: Before,
    apertures: &[Aperture],
    outside: &Outside,
    sun: Option<&Sun>,
    progress: &dyn Progress,
) -> Result<(Estimate, f64), StudyError> {
    let orientation = Orientation::new(Bearing::from_degrees(file.site.azimuth));
    let outside = before.stand(outside.clone(), sun, orientation, progress)?;
    // By Gauss's points; fewer of them tell how far the mean may be off.
    let mean = |one: &Aperture, points: usize| -> Estimate {
        let rule = gauss_legendre(points);
        let normal = Dir::from_unit(orientation.to_world(one.surface.room_from_facade(DVec3::Z)));
        let place = |(x, wx): &(f64, f64), (y, wy): &(f64, f64)| {
            let along = DVec3::new(x * one.size[0], y * one.size[1], 0.0);
            let eye = orientation.to_world(one.corner + one.surface.room_from_facade(along));
            irradiance(&outside.seen_from(eye), normal) * (wx * wy)
        };
        rule.iter().flat_map(|x| rule.iter().map(move |y| (x, y))).map(|(x, y)| place(x, y)).sum()
    };
    let area: f64 = apertures.iter().map(Aperture::area).sum();
    let (mut diffuse, mut direct) = (Estimate::default(), 0.0);
    for one in apertures {
        if progress.cancelled() {
            return Err(Cancelled.into());
        }
        let facing = Facing { outside: &outside, sun, orientation, surface: one.surface };
        let share = outside.surroundings().map_or(1.0, |around| lit(one, &facing, around).1);
        let (found, fewer) = (mean(one, 3), mean(one, 2));
        let off = (found.value - fewer.value).abs();
        diffuse += Estimate::new(found.value, found.error + off) * (one.area() / area);
        direct += share * facing.sun_illuminance() * one.area() / area;
    }
    Ok((diffuse, direct))
}
