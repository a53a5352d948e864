//! Sharp patches of sun on the walls: each shines as the polygon that it is, on points and on the patches of the room.
//!
//! A polygon that covers half a patch is not a patch of half the brightness: where the opening is small or the patches
//! are long, that would move light by half a patch. The exchange of an outline and a patch is the mean of a closed form,
//! that of the larger one of both seen from points of the smaller.

use super::gather::polygon_factor;
use super::mesh::{Mesh, Patch, Wall};
use crate::compute::polygon::{area, edge};
use crate::compute::quadrature::gauss_legendre;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// A convex piece of a wall that reflects a beam.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Index of the wall.
    pub wall: usize,
    /// In the wall's own coordinates, in order. \[m\]
    pub corners: Vec<DVec2>,
    /// What it reflects, less than 0 where another outline around it counts too much. \[lm/m²\]
    pub exitance: f64,
}

impl Outline {
    /// What a point receives from it. \[lx\]
    pub fn light_at(&self, mesh: &Mesh, position: DVec3, normal: DVec3) -> f64 {
        self.exitance * polygon_factor(&mesh.walls[self.wall], &self.corners, position, normal)
    }
}

/// Most points along each side of what is sampled.
const MOST_POINTS: usize = 6;

/// Points along each side of a piece of some size at some distance from what it sees.
fn points(size: f64, distance: f64) -> usize {
    // The slack keeps decisions the same for a room in another unit.
    match size / distance.max(1e-12 * size) - 1e-9 {
        r if r < 0.2 => 1,
        r if r < 0.6 => 2,
        r if r < 1.2 => 3,
        r if r < 2.5 => 4,
        _ => MOST_POINTS,
    }
}

/// Mean illuminance of every patch from all outlines, each scaled to the flux that it reflects; and the share of the
/// flux that the scaling added or took.
pub fn thrown_on_patches(mesh: &Mesh, outlines: &[Outline]) -> (Vec<f64>, f64) {
    let rules: Vec<_> = (0..=MOST_POINTS).map(gauss_legendre).collect();
    let mut sums = vec![0.0; mesh.patches.len()];
    let (mut gaps, mut fluxes) = (0.0, 0.0);
    for outline in outlines {
        let shining = Shining::new(mesh, outline, &rules);
        let factors: Vec<f64> = mesh
            .patches
            .par_iter()
            .with_min_len(128)
            .map(
                |patch| {
                    if patch.wall == outline.wall { 0.0 } else { shining.on(&mesh.walls[patch.wall], patch, &rules) }
                },
            )
            .collect();
        let received: f64 = factors.iter().zip(&mesh.patches).map(|(f, patch)| f * patch.area).sum();
        if received > 0.0 {
            let scale = shining.area / received;
            sums.iter_mut().zip(&factors).for_each(|(sum, f)| *sum += outline.exitance * scale * f);
            gaps += (scale - 1.0).abs() * (outline.exitance * shining.area).abs();
            fluxes += (outline.exitance * shining.area).abs();
        }
    }
    (sums, if fluxes > 0.0 { gaps / fluxes } else { 0.0 })
}

/// An outline with all that its exchange with patches needs.
struct Shining {
    corners: Vec<DVec3>,
    normal: DVec3,
    /// The smallest box around it.
    limits: [DVec3; 2],
    size: f64,
    area: f64,
    /// By number of points a side: points with their shares of the area.
    samples: Vec<Vec<(DVec3, f64)>>,
}

impl Shining {
    fn new(mesh: &Mesh, outline: &Outline, rules: &[Vec<(f64, f64)>]) -> Self {
        let wall = &mesh.walls[outline.wall];
        let corners: Vec<DVec3> = outline.corners.iter().map(|p| wall.point(p.x, p.y)).collect();
        let low = corners.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = corners.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let samples = rules.iter().map(|rule| samples(wall, &outline.corners, rule)).collect();
        let area = area(&outline.corners).abs();
        Self { corners, normal: wall.normal, limits: [low, high], size: (high - low).length(), area, samples }
    }

    /// The mean over a patch on another wall of the configuration factor.
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

/// Configuration factor of a polygon that has no part behind the point: both lie on walls of one box.
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

/// Points of a convex polygon with their shares of its area: its centroid, or a product rule on every triangle of a fan.
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
                // The square folded to a triangle: its width grows with the way from the apex.
                let point = apex + s * ((p - apex) + t * (q - p));
                samples.push((wall.point(point.x, point.y), share * 2.0 * s * ws * wt));
            }
        }
    }
    samples
}
