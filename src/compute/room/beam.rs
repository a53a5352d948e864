//! Unscattered beams of the sun on the surfaces of the room: parallel projection of the aperture, with exact areas.

use super::mesh::{Mesh, Wall};
use super::outline::Outline;
use crate::compute::polygon::{area, cut_by_all};
use glam::{DVec2, DVec3};

/// Parallel light that enters the room through an aperture in one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// Corners of the convex polygon that the beam crosses: an aperture, or the sunlit part of one, in the room's
    /// frame. \[m\]
    pub opening: Vec<DVec3>,
    /// Unit vector against the direction of propagation (towards the source), room's frame.
    pub from: DVec3,
    /// Luminous flux of the beam. \[lm\]
    pub flux: f64,
}

/// Convex piece of a room surface that a beam lights.
#[derive(Debug, Clone, PartialEq)]
pub struct Lit {
    /// Index of the room surface among the walls of the mesh.
    pub wall: usize,
    /// Corners of the piece in the coordinates of the wall, in order. \[m\]
    pub corners: Vec<DVec2>,
    /// Illuminance of the piece by the beam alone. \[lx\]
    pub illuminance: f64,
}

/// Maximum number of beams through all apertures together whose first reflection is computed separately; more are
/// merged. Chosen: cost; held by the test `a_fan_keeps_its_flux_and_its_reflection_when_it_is_merged` (2e-3).
pub const MOST_BEAMS: usize = 24;

impl Beam {
    /// Returns the pieces of the room surfaces that the beam lights, with illuminances scaled to its flux. The penumbra
    /// by the sun's diameter is neglected: its mean effect on a patch is zero except at the edges.
    pub fn lit(&self, mesh: &Mesh) -> Vec<Lit> {
        let mut lit = Vec::with_capacity(3);
        let mut incident = 0.0;
        for (number, wall) in mesh.walls.iter().enumerate() {
            let towards = wall.normal.dot(self.from);
            if towards <= 1e-9 {
                continue;
            }
            let project = |corner: DVec3| {
                let t = wall.normal.dot(corner - wall.point(0.0, 0.0)) / towards;
                let hit = corner - self.from * t;
                DVec2::new(hit[wall.along[0]], hit[wall.along[1]])
            };
            let whole = [0, 1].map(|side| [wall.lines[side][0], wall.lines[side][wall.lines[side].len() - 1]]);
            let projected: Vec<DVec2> = self.opening.iter().map(|corner| project(*corner)).collect();
            let corners = overlap(&projected, whole);
            if corners.len() >= 3 {
                incident += area(&corners).abs() * towards;
                lit.push(Lit { wall: number, corners, illuminance: towards });
            }
        }
        let scale = if incident > 0.0 { self.flux / incident } else { 0.0 };
        lit.iter_mut().for_each(|one| one.illuminance *= scale);
        lit
    }

    /// Returns outlines of the lit pieces with the exitance by the first reflection of the beam, exactly. The exitances
    /// of overlapping outlines add up.
    pub fn outlines(&self, mesh: &Mesh) -> Vec<Outline> {
        let mut outlines = Vec::with_capacity(4);
        for Lit { wall: number, corners, illuminance } in self.lit(mesh) {
            // The wall without apertures, then the differences in reflectance of the apertures in it.
            let wall = &mesh.walls[number];
            let bare = mesh.patches[wall.patches()].iter().find(|patch| patch.aperture.is_none());
            let rho = bare.map_or(0.0, |patch| patch.reflectance);
            for (extent, reflectance) in set_in(mesh, wall).into_iter().filter(|(_, own)| *own != rho) {
                let corners = overlap(&corners, extent);
                if corners.len() >= 3 {
                    outlines.push(Outline { wall: number, corners, exitance: (reflectance - rho) * illuminance });
                }
            }
            if rho > 0.0 {
                outlines.push(Outline { wall: number, corners, exitance: rho * illuminance });
            }
        }
        outlines
    }

    /// Adds the mean illuminance of every patch by the beam to `illuminance`. \[lx\]
    pub fn add_to(&self, mesh: &Mesh, illuminance: &mut [f64]) {
        let (mut strip, mut part, mut spare) = (Vec::new(), Vec::new(), Vec::new());
        for lit in self.lit(mesh) {
            let wall = &mesh.walls[lit.wall];
            let touched = |corners: &[DVec2], side: usize| {
                let ([low, high], lines) = (limits(corners, side), &wall.lines[side]);
                let from = lines.partition_point(|line| *line <= low).max(1) - 1;
                from..lines.partition_point(|line| *line < high).min(lines.len() - 1)
            };
            for i in touched(&lit.corners, 0) {
                let row = wall.first + i * (wall.lines[1].len() - 1);
                within(&lit.corners, 0, [wall.lines[0][i], wall.lines[0][i + 1]], &mut strip, &mut spare);
                for j in touched(&strip, 1) {
                    within(&strip, 1, [wall.lines[1][j], wall.lines[1][j + 1]], &mut part, &mut spare);
                    if part.len() >= 3 {
                        illuminance[row + j] += lit.illuminance * area(&part).abs() / mesh.patches[row + j].area;
                    }
                }
            }
        }
    }
}

/// Merges beams of about the same direction into fewer of the same total flux, for instance those of a fan by a curved
/// mirror, whose lit areas nearly coincide. Beams through different polygons are not merged.
pub fn merged(beams: &[Beam]) -> Vec<Beam> {
    if beams.len() <= MOST_BEAMS {
        return beams.to_vec();
    }
    let mut width: f64 = 0.005;
    loop {
        let mut groups: Vec<(Beam, DVec3)> = Vec::new();
        for beam in beams {
            let near = |(own, sum): &&mut (Beam, DVec3)| {
                own.opening == beam.opening && sum.normalize_or_zero().distance(beam.from) < width
            };
            match groups.iter_mut().find(near) {
                Some((own, sum)) => {
                    own.flux += beam.flux;
                    *sum += beam.flux * beam.from;
                }
                None => groups.push((beam.clone(), beam.flux * beam.from)),
            }
        }
        if groups.len() <= MOST_BEAMS || width > 0.2 {
            return groups.into_iter().map(|(own, sum)| Beam { from: sum.normalize_or_zero(), ..own }).collect();
        }
        width *= 1.5;
    }
}

/// Returns the apertures in a wall: their limits in the wall's coordinates \[m\], and the reflectances of their room
/// sides.
fn set_in(mesh: &Mesh, wall: &Wall) -> Vec<([[f64; 2]; 2], f64)> {
    let mut found: Vec<(usize, [[f64; 2]; 2], f64)> = Vec::new();
    for patch in &mesh.patches[wall.patches()] {
        let Some(number) = patch.aperture else { continue };
        match found.iter_mut().find(|(own, ..)| *own == number) {
            Some((_, extent, _)) => {
                for (own, new) in extent.iter_mut().zip(patch.extent) {
                    *own = [own[0].min(new[0]), own[1].max(new[1])];
                }
            }
            None => found.push((number, patch.extent, patch.reflectance)),
        }
    }
    found.into_iter().map(|(_, extent, reflectance)| (extent, reflectance)).collect()
}

/// Returns the lower and upper limit of a polygon along the axis `side`.
fn limits(corners: &[DVec2], side: usize) -> [f64; 2] {
    let along = corners.iter().map(|p| p[side]);
    [along.clone().fold(f64::INFINITY, f64::min), along.fold(f64::NEG_INFINITY, f64::max)]
}

/// Clips a convex polygon to the range between two limits of one coordinate. `spare` is a buffer.
fn within(polygon: &[DVec2], axis: usize, [low, high]: [f64; 2], kept: &mut Vec<DVec2>, spare: &mut Vec<DVec2>) {
    kept.clear();
    kept.extend_from_slice(polygon);
    let borders = [(low, 1.0), (high, -1.0)].map(|(limit, sign)| move |p: DVec2| sign * (p[axis] - limit));
    cut_by_all(kept, borders, spare);
}

/// Returns the part of a convex polygon inside a rectangle.
fn overlap(polygon: &[DVec2], extent: [[f64; 2]; 2]) -> Vec<DVec2> {
    let limits = extent.into_iter().enumerate().flat_map(|(axis, [low, high])| [(axis, low, 1.0), (axis, high, -1.0)]);
    let mut kept = polygon.to_vec();
    let borders = limits.map(|(axis, limit, sign)| move |p: DVec2| sign * (p[axis] - limit));
    cut_by_all(&mut kept, borders, &mut Vec::with_capacity(polygon.len() + 4));
    kept
}

#[cfg(test)]
mod tests {
    use super::super::aperture::Aperture;
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
                let beam = Beam { opening: aperture.corners().to_vec(), from: sun, flux: 100.0 };
                let mut illuminance = vec![0.0; mesh.patches.len()];
                beam.add_to(&mesh, &mut illuminance);
                let landed: f64 = illuminance.iter().zip(&mesh.patches).map(|(e, patch)| e * patch.area).sum();
                assert!((landed / 100.0 - 1.0).abs() < 1e-9, "{sun}: {landed}");
                // Unscaled it is the light that crosses the opening.
                let found: f64 = beam
                    .lit(&mesh)
                    .iter()
                    .map(|lit| area(&lit.corners).abs() * mesh.walls[lit.wall].normal.dot(sun))
                    .sum();
                let entered = aperture.area() * outward.dot(sun);
                assert!((found / entered - 1.0).abs() < 1e-9, "{sun}: {found} {entered}");
            }
        }
    }

    #[test]
    fn a_fan_keeps_its_flux_and_its_reflection_when_it_is_merged() {
        let room = BoxRoom { size: DVec3::new(4.0, 6.0, 3.0), floor: 0.2, walls: 0.5, ceiling: 0.7 };
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.7), size: [2.5, 1.9] };
        let mesh = Nested::with_about(&room, &[aperture], &[0.3], 600).unwrap().fine;
        let fan: Vec<Beam> = (0..150)
            .map(|k| {
                let rise = 0.1 + 0.006 * f64::from(k);
                Beam {
                    opening: aperture.corners().to_vec(),
                    from: DVec3::new(0.2, -rise.cos(), -rise.sin()).normalize(),
                    flux: 1.0 + f64::from(k % 7),
                }
            })
            .collect();
        let few = merged(&fan);
        assert!(few.len() <= MOST_BEAMS && few.len() > MOST_BEAMS / 3, "{}", few.len());
        let flux = |beams: &[Beam]| beams.iter().map(|beam| beam.flux).sum::<f64>();
        assert!((flux(&few) / flux(&fan) - 1.0).abs() < 1e-12);
        let reflected = |beams: &[Beam]| -> f64 {
            let outlines = beams.iter().flat_map(|beam| beam.outlines(&mesh));
            outlines.map(|outline| outline.exitance * area(&outline.corners).abs()).sum()
        };
        let (one, all) = (reflected(&few), reflected(&fan));
        assert!((one / all - 1.0).abs() < 2e-3, "{one} {all}");
    }

    #[test]
    fn apertures_in_a_lit_wall_reflect_their_own_share() {
        let room = BoxRoom { size: DVec3::new(4.0, 6.0, 3.0), floor: 0.2, walls: 0.5, ceiling: 0.7 };
        let facade = Aperture { surface: Surface::Facade, corner: DVec3::new(0.0, 0.0, 0.5), size: [4.0, 2.0] };
        let roof = Aperture { surface: Surface::Roof, corner: DVec3::new(0.5, 0.2, 3.0), size: [3.0, 3.0] };
        let mesh = Nested::with_about(&room, &[facade, roof], &[0.1, 0.4], 600).unwrap().fine;
        // Reflected up by a mirror: onto the ceiling and the light in it.
        let beam =
            Beam { opening: facade.corners().to_vec(), from: DVec3::new(0.1, -0.7, -0.8).normalize(), flux: 50.0 };
        let mut illuminance = vec![0.0; mesh.patches.len()];
        beam.add_to(&mesh, &mut illuminance);
        let by_patches: f64 = illuminance.iter().zip(&mesh.patches).map(|(e, p)| e * p.area * p.reflectance).sum();
        let by_outlines: f64 = beam.outlines(&mesh).iter().map(|o| o.exitance * area(&o.corners).abs()).sum();
        assert!((by_outlines / by_patches - 1.0).abs() < 1e-9, "{by_outlines} {by_patches}");
    }
}
