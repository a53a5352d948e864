//! The sun's unscattered beam on the surfaces of the room: parallel projection of the opening, exact areas.

use super::aperture::Aperture;
use super::mesh::Mesh;
use crate::compute::polygon::{area, cut_by_all};
use glam::{DVec2, DVec3};

/// Where a beam lands.
pub struct Landing {
    /// Share of every patch's area that lies in the beam.
    pub shares: Vec<f64>,
    /// What of the beam is reflected at once, exactly: wall, lit outline in the wall's own coordinates, reflectance. The
    /// reflectances of outlines that lie in each other add up.
    pub outlines: Vec<(usize, Vec<DVec2>, f64)>,
}

/// The beam through an aperture, direction given by the unit vector towards the sun (room frame). The disc's penumbra
/// is left out: its mean over a patch is nil but at the edges.
pub fn landing(mesh: &Mesh, aperture: &Aperture, sun: DVec3) -> Landing {
    let mut landing = Landing { shares: vec![0.0; mesh.patches.len()], outlines: Vec::new() };
    for (number, wall) in mesh.walls.iter().enumerate() {
        let towards = wall.normal.dot(sun);
        if towards <= 1e-9 {
            continue;
        }
        let outline: Vec<DVec2> = aperture
            .corners()
            .iter()
            .map(|&corner| {
                let t = wall.normal.dot(corner - wall.point(0.0, 0.0)) / towards;
                let hit = corner - sun * t;
                DVec2::new(hit[wall.along[0]], hit[wall.along[1]])
            })
            .collect();
        let patches = wall.first..wall.first + (wall.lines[0].len() - 1) * (wall.lines[1].len() - 1);
        // The bare wall as a whole, then what apertures in it reflect more or less.
        let bare = mesh.patches[patches.clone()].iter().find(|patch| patch.aperture.is_none());
        let rho = bare.map_or(0.0, |patch| patch.reflectance);
        let whole = [0, 1].map(|side| [wall.lines[side][0], wall.lines[side][wall.lines[side].len() - 1]]);
        let lit = overlap(&outline, whole);
        if lit.len() >= 3 && rho > 0.0 {
            landing.outlines.push((number, lit, rho));
        }
        for i in patches {
            let patch = &mesh.patches[i];
            let lit = overlap(&outline, patch.extent);
            if lit.len() >= 3 {
                landing.shares[i] = area(&lit).abs() / patch.area;
                if patch.reflectance != rho {
                    landing.outlines.push((number, lit, patch.reflectance - rho));
                }
            }
        }
    }
    landing
}

/// A convex polygon inside a rectangle.
fn overlap(polygon: &[DVec2], extent: [[f64; 2]; 2]) -> Vec<DVec2> {
    let limits = extent.into_iter().enumerate().flat_map(|(axis, [low, high])| [(axis, low, 1.0), (axis, high, -1.0)]);
    let mut kept = polygon.to_vec();
    let borders = limits.map(|(axis, limit, sign)| move |p: DVec2| sign * (p[axis] - limit));
    cut_by_all(&mut kept, borders, &mut Vec::with_capacity(polygon.len() + 4));
    kept
}

#[cfg(test)]
mod tests {
    use super::super::mesh::{BoxRoom, Nested};
    use super::*;
    use crate::compute::direction::Surface;

    #[test]
    fn all_of_the_beam_lands_in_the_room() {
        let room = BoxRoom { size: DVec3::new(4.0, 6.0, 3.0), floor: 0.2, walls: 0.5, ceiling: 0.7 };
        let cases = [
            (Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.7), size: [2.5, 1.9] }, DVec3::NEG_Y),
            (Aperture { surface: Surface::Roof, corner: DVec3::new(0.5, 1.0, 3.0), size: [2.0, 1.0] }, DVec3::Z),
        ];
        for (aperture, outward) in cases {
            let mesh = Nested::with_about(&room, &[aperture], &[0.0], 600).unwrap().fine;
            for sun in [DVec3::new(0.1, -0.8, 0.5), DVec3::new(-0.9, -0.2, 0.3), DVec3::new(0.7, -0.7, 0.05)] {
                let sun = sun.normalize();
                let landed: f64 = landing(&mesh, &aperture, sun)
                    .shares
                    .iter()
                    .zip(&mesh.patches)
                    .map(|(share, patch)| share * patch.area * mesh.walls[patch.wall].normal.dot(sun).max(0.0))
                    .sum();
                let entered = aperture.area() * outward.dot(sun);
                assert!((landed / entered - 1.0).abs() < 1e-9, "{sun}: {landed} {entered}");
            }
        }
    }
}
