//! The sun's unscattered beam on the surfaces of the room: parallel projection of the opening, exact areas.

use super::aperture::Aperture;
use super::mesh::Mesh;
use glam::{DVec2, DVec3};

/// Share of every patch's area that lies in the beam through an aperture, beam direction given by the unit vector
/// towards the sun (room frame). The disc's penumbra is left out: its mean over a patch is nil but at the edges.
pub fn lit_shares(mesh: &Mesh, aperture: &Aperture, sun: DVec3) -> Vec<f64> {
    let mut shares = vec![0.0; mesh.patches.len()];
    let outlines: Vec<Option<Vec<DVec2>>> = mesh
        .walls
        .iter()
        .map(|wall| {
            let towards = wall.normal.dot(sun);
            (towards > 1e-9).then(|| {
                aperture
                    .corners()
                    .iter()
                    .map(|&corner| {
                        let t = wall.normal.dot(corner - wall.point(0.0, 0.0)) / towards;
                        let hit = corner - sun * t;
                        DVec2::new(hit[wall.along[0]], hit[wall.along[1]])
                    })
                    .collect()
            })
        })
        .collect();
    for (share, patch) in shares.iter_mut().zip(&mesh.patches) {
        if let Some(outline) = &outlines[patch.wall] {
            *share = overlap(outline, patch.extent) / patch.area;
        }
    }
    shares
}

/// Area of a convex polygon inside a rectangle.
fn overlap(polygon: &[DVec2], extent: [[f64; 2]; 2]) -> f64 {
    let mut current = polygon.to_vec();
    for (axis, limits) in extent.into_iter().enumerate() {
        for (limit, sign) in [(limits[0], 1.0), (limits[1], -1.0)] {
            let inside = |p: DVec2| sign * (p[axis] - limit);
            let mut kept = Vec::with_capacity(current.len() + 1);
            for (i, &p) in current.iter().enumerate() {
                let q = current[(i + 1) % current.len()];
                let (fp, fq) = (inside(p), inside(q));
                if fp >= 0.0 {
                    kept.push(p);
                }
                if (fp > 0.0 && fq < 0.0) || (fp < 0.0 && fq > 0.0) {
                    kept.push(p + (q - p) * (fp / (fp - fq)));
                }
            }
            current = kept;
            if current.len() < 3 {
                return 0.0;
            }
        }
    }
    (0..current.len()).map(|i| current[i].perp_dot(current[(i + 1) % current.len()])).sum::<f64>().abs() * 0.5
}

#[cfg(test)]
mod tests {
    use super::super::mesh::BoxRoom;
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
            let mesh = Mesh::new(&room, &[aperture], &[0.0], 0.43);
            for sun in [DVec3::new(0.1, -0.8, 0.5), DVec3::new(-0.9, -0.2, 0.3), DVec3::new(0.7, -0.7, 0.05)] {
                let sun = sun.normalize();
                let landed: f64 = lit_shares(&mesh, &aperture, sun)
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
