//! Illuminance of the façade from outside.

use super::error::StudyError;
use super::outside::Before;
use super::scene_file::SceneFile;
use super::scene_places::{apertures, room};
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Orientation, Surface};
use crate::compute::estimate::{Estimate, Progress};
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
    let orientation = Orientation::new(Bearing::from_degrees(file.site.azimuth));
    let normal = Dir::from_altitude_bearing(0.0, Bearing::from_degrees(file.site.azimuth));
    if file.outside.is_empty() && file.building.is_none() {
        let share = |sun: &Sun| {
            let skyline = outside.surroundings().and_then(|around| around.skyline.as_ref());
            let own = |skyline: &Skyline| skyline.altitude(sun.direction.bearing().radians());
            sun.share_above(skyline.map_or(outside.skyline_altitude(), own))
        };
        let direct = sun.map_or(0.0, |sun| sun.direct_normal * sun.direction.dot(normal).max(0.0) * share(sun));
        return Ok(FacadeLight { diffuse: irradiance(outside, normal), direct, behind: false });
    }
    let room = room(&file.room)?;
    let mut all = apertures(&file.aperture, &room)?;
    all.retain(|one| one.surface == Surface::Facade);
    if all.is_empty() {
        let size = [room.size.x, room.size.z];
        all.push(Aperture { surface: Surface::Facade, corner: DVec3::ZERO, size });
    }
    let before = Before::of(file, &room, &all)?;
    let outside = before.stand(outside.clone(), sun, orientation, progress)?;
    let facing = Facing { outside: &outside, sun, orientation, surface: Surface::Facade };
    let share = |one: &Aperture| outside.surroundings().map_or(1.0, |around| lit(one, &facing, around).1);
    // By Gauss's points; fewer of them tell how far the mean may be off.
    let mean = |one: &Aperture, points: usize| -> Estimate {
        let rule = gauss_legendre(points);
        let place = |(x, wx): &(f64, f64), (z, wz): &(f64, f64)| {
            let eye = one.corner + DVec3::new(x * one.size[0], 0.0, z * one.size[1]);
            irradiance(&outside.seen_from(orientation.to_world(eye)), normal) * (wx * wz)
        };
        rule.iter().flat_map(|x| rule.iter().map(move |z| (x, z))).map(|(x, z)| place(x, z)).sum()
    };
    let area: f64 = all.iter().map(Aperture::area).sum();
    let (mut diffuse, mut direct) = (Estimate::default(), 0.0);
    for one in &all {
        let (found, fewer) = (mean(one, 3), mean(one, 2));
        let off = (found.value - fewer.value).abs();
        diffuse += Estimate::new(found.value, found.error + off) * (one.area() / area);
        direct += share(one) * facing.sun_illuminance() * one.area() / area;
    }
    Ok(FacadeLight { diffuse, direct, behind: true })
}
