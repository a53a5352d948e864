//! First reflection of sharp sun patches on the walls: each is a polygon that emits to points and to the patches of the
//! room.
//!
//! A polygon that covers half a patch is not replaced by a patch of half the exitance: with a small aperture or long
//! patches, light would be displaced by half a patch. The exchange between an outline and a patch is the mean of a
//! closed form over points of the smaller one of both, that of the larger one seen from these points.

use super::aperture::Aperture;
use super::direct::Sensor;
use super::gather::{corners_factor, polygon_factor};
use super::mesh::{Mesh, Patch, Wall};
use crate::compute::polygon::{area, edge};
use crate::compute::quadrature::gauss_legendre;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Convex piece of a wall that reflects diffusely with a uniform exitance, for instance where a beam of sun lights it.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Index of the wall in the mesh.
    pub wall: usize,
    /// Corners of the piece in the coordinates of the wall, in order. \[m\]
    pub corners: Vec<DVec2>,
    /// Luminous exitance of the piece; negative if it corrects the exitance of another outline around it. \[lm/m²\]
    pub exitance: f64,
}

impl Outline {
    /// Creates the outline of a whole aperture with a uniform exitance. \[lm/m²\]
    pub fn of_aperture(mesh: &Mesh, aperture: &Aperture, exitance: f64) -> Self {
        let inward = -aperture.surface.room_from_facade(DVec3::Z);
        // One of the six sides looks into the room from the aperture's plane.
        let wall = mesh.walls.iter().position(|wall| wall.normal.dot(inward) > 0.5).unwrap_or_default();
        let along = mesh.walls[wall].along;
        let corners = aperture.corners().map(|corner| DVec2::new(corner[along[0]], corner[along[1]]));
        Self { wall, corners: corners.to_vec(), exitance }
    }

    /// Returns the illuminance at a point by the outline. \[lx\] `position` and `normal`: of the receiving plane,
    /// room's frame.
    pub fn light_at(&self, mesh: &Mesh, position: DVec3, normal: DVec3) -> f64 {
        self.exitance * polygon_factor(&mesh.walls[self.wall], &self.corners, position, normal)
    }

    /// Adds the illuminance by the outline at each of many sensors to `sums`. \[lx\]
    pub fn add_light(&self, mesh: &Mesh, sensors: &[Sensor], sums: &mut [f64]) {
        let wall = &mesh.walls[self.wall];
        let corners: Vec<DVec3> = self.corners.iter().map(|p| wall.point(p.x, p.y)).collect();
        for (sum, sensor) in sums.iter_mut().zip(sensors) {
            *sum += self.exitance * corners_factor(wall, &corners, sensor.position, sensor.normal);
        }
    }
}

/// Maximum number of sampling points along each side of a piece. Chosen: cost; fluxes are scaled to be exact; held by
/// the tests below, which allow 8e-3 for halves of an outline.
const MOST_POINTS: usize = 6;

/// Returns the number of sampling points along each side of a piece of `size` \[m\] at `distance` \[m\] from the
/// receiver.
fn points(size: f64, distance: f64) -> usize {
    // The slack keeps rounding from deciding, so that results do not depend on the unit of length.
    match size / distance.max(1e-12 * size) - 1e-9 {
        r if r < 0.14 => 1,
        r if r < 0.5 => 2,
        r if r < 1.0 => 3,
        r if r < 2.0 => 4,
        _ => MOST_POINTS,
    }
}

/// Computes the mean illuminance of every patch by all outlines \[lx\], the contribution of each scaled to its
/// reflected flux, and the share of the flux that the scaling adds or removes.
pub fn patch_illuminances(mesh: &Mesh, outlines: &[Outline]) -> (Vec<f64>, f64) {
    let rules: Vec<_> = (0..=MOST_POINTS).map(gauss_legendre).collect();
    let mut sums = vec![0.0; mesh.patches.len()];
    let (mut gaps, mut fluxes) = (0.0, 0.0);
    for outline in outlines {
        let emitter = Emitter::new(mesh, outline, &rules);
        let factors: Vec<f64> = mesh
            .patches
            .par_iter()
            .with_min_len(128)
            .map(
                |patch| {
                    if patch.wall == outline.wall { 0.0 } else { emitter.on(&mesh.walls[patch.wall], patch, &rules) }
                },
            )
            .collect();
        let received: f64 = factors.iter().zip(&mesh.patches).map(|(f, patch)| f * patch.area).sum();
        if received > 0.0 {
            let scale = emitter.area / received;
            sums.iter_mut().zip(&factors).for_each(|(sum, f)| *sum += outline.exitance * scale * f);
            gaps += (scale - 1.0).abs() * (outline.exitance * emitter.area).abs();
            fluxes += (outline.exitance * emitter.area).abs();
        }
    }
    (sums, if fluxes > 0.0 { gaps / fluxes } else { 0.0 })
}

/// Outline with the quantities for its exchange with patches.
struct Emitter {
    corners: Vec<DVec3>,
    normal: DVec3,
    /// Corners of the smallest box around the outline.
    limits: [DVec3; 2],
    size: f64,
    area: f64,
    /// Points with their shares of the area, by number of points per side.
    samples: Vec<Vec<(DVec3, f64)>>,
}

impl Emitter {
    fn new(mesh: &Mesh, outline: &Outline, rules: &[Vec<(f64, f64)>]) -> Self {
        let wall = &mesh.walls[outline.wall];
        let corners: Vec<DVec3> = outline.corners.iter().map(|p| wall.point(p.x, p.y)).collect();
        let low = corners.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = corners.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let samples = rules.iter().map(|rule| samples(wall, &outline.corners, rule)).collect();
        let area = area(&outline.corners).abs();
        Self { corners, normal: wall.normal, limits: [low, high], size: (high - low).length(), area, samples }
    }

    /// Returns the mean of the outline's configuration factor over a patch on another wall.
    fn on(&self, wall: &Wall, patch: &Patch, rules: &[Vec<(f64, f64)>]) -> f64 {
        let corners = patch.corners(wall);
        let [low, high] = [corners[0], corners[2]];
        let gap = (low - self.limits[1]).max(self.limits[0] - high).max(DVec3::ZERO).length();
        let size = (high - low).length();
        if size <= self.size {
            let rule = &rules[points(size, gap)];
            let [a, b] = patch.extent;
            let across = |s: f64| rule.iter().map(move |&(t, wt)| (s, t, wt));
            rule.iter()
                .flat_map(|&(s, ws)| across(s).map(move |(s, t, wt)| (s, t, ws * wt)))
                .map(|(s, t, share)| {
                    let position = wall.point(a[0] + (a[1] - a[0]) * s, b[0] + (b[1] - b[0]) * t);
                    share * factor(&self.corners, position, wall.normal)
                })
                .sum()
        } else {
            let seen: f64 = self.samples[points(self.size, gap)]
                .iter()
                .map(|&(position, share)| share * factor(&corners, position, self.normal))
                .sum();
            seen * self.area / patch.area
        }
    }
}

/// Returns the configuration factor at a point of a polygon that lies wholly in front of it, because both lie on walls
/// of one box.
fn factor(corners: &[DVec3], position: DVec3, normal: DVec3) -> f64 {
    let Some(&last) = corners.last() else { return 0.0 };
    let mut sum = DVec3::ZERO;
    let mut from = last - position;
    for &corner in corners {
        let to = corner - position;
        sum += edge(from, to);
        from = to;
    }
    sum.dot(normal).abs() / (2.0 * PI)
}

/// Returns points of a convex polygon with their shares of its area: its centroid, or a product rule on every triangle
/// of a fan from its first corner.
fn samples(wall: &Wall, corners: &[DVec2], rule: &[(f64, f64)]) -> Vec<(DVec3, f64)> {
    let whole = area(corners);
    let Some((&apex, rest)) = corners.split_first() else { return Vec::new() };
    let triangles = rest.windows(2).map(|pair| (pair[0], pair[1], area(&[apex, pair[0], pair[1]]) / whole));
    if let [_] = rule {
        let centroid: DVec2 = triangles.map(|(p, q, share)| share * (apex + p + q) / 3.0).sum();
        return vec![(wall.point(centroid.x, centroid.y), 1.0)];
    }
    let mut samples = Vec::with_capacity(rest.len() * rule.len() * rule.len());
    for (p, q, share) in triangles {
        for &(s, ws) in rule {
            for &(t, wt) in rule {
                // The unit square is mapped to a triangle whose width grows with the distance from the apex.
                let point = apex + s * ((p - apex) + t * (q - p));
                samples.push((wall.point(point.x, point.y), share * 2.0 * s * ws * wt));
            }
        }
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::super::mesh::{BoxRoom, Nested};
    use super::super::radiosity::Radiosity;
    use super::*;

    fn room(scale: f64) -> BoxRoom {
        BoxRoom { size: scale * DVec3::new(4.0, 6.0, 3.0), floor: 0.2, walls: 0.5, ceiling: 0.7 }
    }

    fn mesh(scale: f64) -> Mesh {
        Nested::with_about(&room(scale), &[], &[], 640).unwrap().fine
    }

    /// A rectangle on the floor, turned a little unless it is to fill it.
    fn on_floor(corners: [[f64; 2]; 4]) -> Outline {
        Outline { wall: 0, corners: corners.map(DVec2::from_array).to_vec(), exitance: 100.0 }
    }

    fn largest_gap(a: &[f64], b: &[f64]) -> f64 {
        let mean = b.iter().sum::<f64>() / b.len() as f64;
        a.iter().zip(b).map(|(a, b)| (a - b).abs() / b.max(0.1 * mean)).fold(0.0, f64::max)
    }

    #[test]
    fn an_outline_that_fills_a_wall_is_that_wall() {
        let nested = Nested::with_about(&room(1.0), &[], &[], 640).unwrap();
        let (incident, gap) =
            patch_illuminances(&nested.fine, &[on_floor([[0.0, 0.0], [4.0, 0.0], [4.0, 6.0], [0.0, 6.0]])]);
        // Seen from the middle of a patch in closed form: near enough away from the edges of the floor.
        for (patch, e) in nested.fine.patches.iter().zip(&incident).filter(|(patch, _)| patch.wall == 1) {
            let wall = &nested.fine.walls[1];
            let [low, _, high, _] = patch.corners(wall);
            let floor = [DVec2::ZERO, DVec2::new(4.0, 0.0), DVec2::new(4.0, 6.0), DVec2::new(0.0, 6.0)];
            let exact = 100.0 * polygon_factor(&nested.fine.walls[0], &floor, 0.5 * (low + high), wall.normal);
            assert!((e / exact - 1.0).abs() < 0.01, "{e} {exact}");
        }
        assert!(gap < 3e-3, "{gap}");
    }

    #[test]
    fn halves_make_the_whole() {
        let mesh = mesh(1.0);
        for size in [0.01, 0.3, 2.0] {
            let corner = |x: f64, y: f64| [1.0 + size * (x + 0.2 * y), 2.0 + size * (y - 0.1 * x)];
            let part =
                |from: f64, to: f64| on_floor([corner(from, 0.0), corner(to, 0.0), corner(to, 1.0), corner(from, 1.0)]);
            let (whole, _) = patch_illuminances(&mesh, &[part(0.0, 1.0)]);
            let (halves, _) = patch_illuminances(&mesh, &[part(0.0, 0.5), part(0.5, 1.0)]);
            assert!(largest_gap(&halves, &whole) < 8e-3, "{size}: {}", largest_gap(&halves, &whole));
        }
    }

    #[test]
    fn whatever_an_outline_throws_arrives() {
        let mesh = mesh(1.0);
        // Small and in the open, a sliver along the wall, one in a corner.
        for corners in [
            [[2.0, 3.0], [2.05, 3.0], [2.05, 3.05], [2.0, 3.05]],
            [[0.0, 1.0], [0.02, 1.0], [0.02, 5.0], [0.0, 5.0]],
            [[3.5, 5.3], [4.0, 5.3], [4.0, 6.0], [3.5, 6.0]],
        ] {
            let outline = on_floor(corners);
            let (incident, gap) = patch_illuminances(&mesh, std::slice::from_ref(&outline));
            let arrived: f64 = incident.iter().zip(&mesh.patches).map(|(e, patch)| e * patch.area).sum();
            let left = outline.exitance * area(&outline.corners);
            assert!((arrived / left - 1.0).abs() < 1e-12, "{arrived} {left}");
            assert!(gap < 0.03, "{corners:?}: {gap}");
            assert!(mesh.patches.iter().zip(&incident).all(|(patch, e)| if patch.wall == 0 {
                *e == 0.0
            } else {
                *e >= 0.0
            }));
        }
    }

    #[test]
    fn the_unit_of_length_does_not_matter() {
        let corners = [[1.0, 2.0], [1.4, 2.1], [1.4, 3.0], [1.0, 3.2]];
        let (small, _) = patch_illuminances(&mesh(1.0), &[on_floor(corners)]);
        let (large, _) = patch_illuminances(&mesh(1024.0), &[on_floor(corners.map(|p| p.map(|x| 1024.0 * x)))]);
        assert!(largest_gap(&large, &small) < 1e-11);
    }

    #[test]
    fn what_an_outline_reflects_is_absorbed_in_the_end() {
        let nested = Nested::with_about(&room(1.0), &[], &[], 640).unwrap();
        let radiosity = Radiosity::alone(nested).unwrap();
        let patches = &radiosity.nested.fine.patches;
        let outline = on_floor([[1.0, 2.0], [1.07, 2.0], [1.07, 2.4], [1.0, 2.4]]);
        let (incident, _) = patch_illuminances(&radiosity.nested.fine, std::slice::from_ref(&outline));
        let exitance = radiosity.exitance(&incident);
        let absorbed: f64 = patches
            .iter()
            .zip(&exitance.fine)
            .map(|(patch, b)| patch.area * b * (1.0 - patch.reflectance) / patch.reflectance)
            .sum();
        let reflected = outline.exitance * area(&outline.corners);
        assert!((absorbed / reflected - 1.0).abs() < 1e-9, "{absorbed} {reflected}");
    }
}
