//! Illuminance at a point by each patch of the room: configuration factors from shared corner values.
//!
//! The vector ∫ω dω over a rectangle is a second difference of one corner function of its plane, so that every crossing
//! of grid lines of a wall is evaluated once. Patches that the plane of the receiving point cuts are clipped.
//! Reference: Lambert's edge sum for a rectangle parallel to two axes.

use super::mesh::{Mesh, Patch, Wall};
use crate::compute::polygon::{clip, projected_solid_angle, vector_solid_angle};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Returns the configuration factors w of all patches at a point: its illuminance is E = Σ w_j B_j with the exitances
/// B_j of the patches. `position` and `normal`: of the receiving plane, room's frame.
pub fn configuration_factors(mesh: &Mesh, position: DVec3, normal: DVec3) -> Vec<f64> {
    let mut weights = vec![0.0; mesh.patches.len()];
    for wall in &mesh.walls {
        let plane = Plane::new(wall, position, normal);
        if plane.distance <= 0.0 {
            continue;
        }
        let columns = wall.lines[1].len() - 1;
        plane.cells(wall, [&wall.lines[0], &wall.lines[1]], |i, j, factor| {
            weights[wall.first + i * columns + j] = factor.max(0.0);
        });
    }
    weights
}

/// Weights of the patches' exitances in the illuminance at a point, for an exitance that varies within the patches:
/// patches near the point have slopes from the differences to their neighbours, and their mean is unchanged.
///
/// A patch close to the point covers much of its hemisphere, and a constant exitance causes an error of first order in
/// the size of the patch.
#[derive(Debug, Clone)]
pub struct Reconstruction {
    /// Weights w with the illuminance E = Σ w_j B_j from the mean exitances B_j of the patches.
    pub weights: Vec<f64>,
    /// Part of `weights` by the slopes, with the indices of the patches that have one; with the exitances it shows how
    /// much patches near the point matter.
    pub slopes: Vec<(usize, f64)>,
}

/// Computes the weights of the patches' exitances at a point, with slopes within near patches. `position` and `normal`:
/// of the receiving plane, room's frame.
pub fn reconstruct(mesh: &Mesh, position: DVec3, normal: DVec3) -> Reconstruction {
    let mut weights = configuration_factors(mesh, position, normal);
    let mut slopes = vec![0.0; weights.len()];
    for wall in &mesh.walls {
        let distance = wall.normal.dot(position - wall.point(0.0, 0.0));
        if distance <= 0.0 {
            continue;
        }
        let counts = [wall.lines[0].len() - 1, wall.lines[1].len() - 1];
        let index = |cell: [usize; 2]| wall.first + cell[0] * counts[1] + cell[1];
        for i in 0..counts[0] {
            for j in 0..counts[1] {
                let at = index([i, j]);
                let patch = &mesh.patches[at];
                let size = [patch.extent[0][1] - patch.extent[0][0], patch.extent[1][1] - patch.extent[1][0]];
                let gap = [0, 1].map(|side| {
                    let x = position[wall.along[side]];
                    x - x.clamp(patch.extent[side][0], patch.extent[side][1])
                });
                let away = DVec3::new(gap[0], gap[1], distance).length();
                // The slack keeps rounding from deciding, so that results do not depend on the unit of length.
                let ratio = size[0].max(size[1]) / away - 1e-9;
                if ratio < NEAR || weights[at] == 0.0 {
                    continue;
                }
                let moments =
                    moments(wall, patch, position, normal, ((4.0 * ratio).ceil() as usize).clamp(2, MOST_PARTS));
                for side in 0..2 {
                    // Slope between the centres of the neighbouring patches, if these belong to the same surface.
                    let neighbour = |step: isize| {
                        let mut cell = [i, j];
                        cell[side] = cell[side].checked_add_signed(step).filter(|k| *k < counts[side])?;
                        let other = &mesh.patches[index(cell)];
                        (other.aperture == patch.aperture)
                            .then(|| (index(cell), 0.5 * (other.extent[side][0] + other.extent[side][1])))
                    };
                    let own = (at, 0.5 * (patch.extent[side][0] + patch.extent[side][1]));
                    let (low, high) = (neighbour(-1).unwrap_or(own), neighbour(1).unwrap_or(own));
                    if high.1 > low.1 {
                        let slope = moments[side] / (high.1 - low.1);
                        slopes[high.0] += slope;
                        slopes[low.0] -= slope;
                    }
                }
            }
        }
    }
    weights.iter_mut().zip(&slopes).for_each(|(weight, slope)| *weight += slope);
    Reconstruction { weights, slopes: slopes.into_iter().enumerate().filter(|(_, slope)| *slope != 0.0).collect() }
}

/// Ratio of a patch's size to its distance from the point above which its slopes count. Chosen: cost; the error that
/// remains with the slopes is stated. No test of its own.
const NEAR: f64 = 0.5;

/// Returns ∫ (x − x̄) dF over a patch along both its sides, with F the configuration factor, from `parts`² parts of the
/// patch. \[m\]
fn moments(wall: &Wall, patch: &Patch, position: DVec3, normal: DVec3, parts: usize) -> [f64; 2] {
    let line = |side: usize, k: usize| {
        let [from, to] = patch.extent[side];
        from + (to - from) * k as f64 / parts as f64
    };
    // Contribution of each part to the sums.
    let mut sums = [0.0; 2];
    let add = |i: usize, j: usize, factor: f64| {
        for (side, k) in [i, j].into_iter().enumerate() {
            let size = patch.extent[side][1] - patch.extent[side][0];
            sums[side] += factor * size * ((k as f64 + 0.5) / parts as f64 - 0.5);
        }
    };
    let lines = [0, 1].map(|side| (0..=parts).map(|k| line(side, k)).collect::<Vec<f64>>());
    Plane::new(wall, position, normal).cells(wall, [&lines[0], &lines[1]], add);
    sums
}

/// Maximum number of parts along each side of a near patch. Chosen: cost; results change within their stated error.
const MOST_PARTS: usize = 12;

/// Receiving point and its normal in the coordinates of a wall.
struct Plane {
    position: DVec3,
    /// Normal in the room's frame.
    room_normal: DVec3,
    origin: [f64; 2],
    distance: f64,
    normal: DVec3,
}

impl Plane {
    fn new(wall: &Wall, position: DVec3, normal: DVec3) -> Self {
        Self {
            position,
            room_normal: normal,
            origin: [position[wall.along[0]], position[wall.along[1]]],
            distance: wall.normal.dot(position - wall.point(0.0, 0.0)),
            normal: DVec3::new(normal[wall.along[0]], normal[wall.along[1]], -normal.dot(wall.normal)),
        }
    }

    /// Returns a grid line of the wall at a coordinate along one of its axes. A receiving plane parallel to the lines
    /// cuts cells like an additional line: lines behind it are replaced by it.
    fn line(&self, axis: usize, at: f64) -> Line {
        let behind = self.is_parallel(axis) && self.normal[axis] * (at - self.origin[axis]) < 0.0;
        let from = if behind { 0.0 } else { at - self.origin[axis] };
        let inverse = (from * from + self.distance * self.distance).sqrt().recip();
        Line { from, inverse, weight: inverse * (from * self.normal.z - self.distance * self.normal[axis]) }
    }

    /// Whether the receiving plane is parallel to the grid lines of one coordinate.
    fn is_parallel(&self, axis: usize) -> bool {
        self.normal.z == 0.0 && self.normal[1 - axis] == 0.0
    }

    /// Returns n·∫ω dω over the quadrant of the wall that ends in the corner of two lines, except for parts that cancel
    /// in second differences.
    fn corner(a: &Line, b: &Line) -> f64 {
        // For a receiving plane perpendicular to the wall, the weight of one of the two lines may be 0.
        let edge =
            |of: &Line, to: &Line| if of.weight == 0.0 { 0.0 } else { of.weight * (to.from * of.inverse).atan() };
        0.5 * (edge(a, b) + edge(b, a))
    }

    /// Calls `take` with the two indices of every cell between grid lines on the wall, and with its configuration
    /// factor.
    fn cells(&self, wall: &Wall, at: [&[f64]; 2], mut take: impl FnMut(usize, usize, f64)) {
        let lines = [0, 1].map(|axis| at[axis].iter().map(|&at| self.line(axis, at)).collect::<Vec<Line>>());
        let is_cut_by_lines = self.is_parallel(0) || self.is_parallel(1);
        // For other planes, corners behind the plane are not evaluated.
        let corner = |a: &Line, b: &Line| {
            let seen = is_cut_by_lines || self.normal.dot(DVec3::new(a.from, b.from, self.distance)) > 0.0;
            (if seen { Self::corner(a, b) } else { 0.0 }, seen)
        };
        let row_at = |a: &Line, row: &mut Vec<(f64, bool)>| {
            row.clear();
            for (j, b) in lines[1].iter().enumerate() {
                let same = j > 0 && lines[1][j - 1].from == b.from;
                row.push(if same { row[j - 1] } else { corner(a, b) });
            }
        };
        let (mut row, mut next, mut kept) = (Vec::new(), Vec::new(), Vec::new());
        row_at(&lines[0][0], &mut row);
        for (i, pair) in lines[0].windows(2).enumerate() {
            if pair[0].from == pair[1].from {
                next.clone_from(&row);
            } else {
                row_at(&pair[1], &mut next);
            }
            for j in 0..lines[1].len() - 1 {
                let corners = [row[j], row[j + 1], next[j], next[j + 1]];
                let seen = match corners.iter().filter(|corner| corner.1).count() {
                    4 => corners[0].0 - corners[1].0 - corners[2].0 + corners[3].0,
                    0 => 0.0,
                    _ => {
                        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                        let corners = corners.map(|(i, j)| wall.point(at[0][i], at[1][j]) - self.position);
                        clip(&corners, self.room_normal, &mut kept);
                        vector_solid_angle(&kept).dot(self.room_normal).abs()
                    }
                };
                take(i, j, seen / PI);
            }
            std::mem::swap(&mut row, &mut next);
        }
    }
}

/// Grid line of a wall, relative to the receiving point.
struct Line {
    /// Signed distance of the line from the point's foot along the wall. \[m\]
    from: f64,
    /// Reciprocal of the line's distance from the point. \[1/m\]
    inverse: f64,
    /// Weight of the angle along the line in the corner function.
    weight: f64,
}

/// Returns the configuration factor at a point of a convex polygon on a wall, given by its corners in the coordinates
/// of the wall. `position` and `normal`: of the receiving plane, room's frame.
pub fn polygon_factor(wall: &Wall, polygon: &[DVec2], position: DVec3, normal: DVec3) -> f64 {
    let corners: Vec<DVec3> = polygon.iter().map(|p| wall.point(p.x, p.y)).collect();
    corners_factor(wall, &corners, position, normal)
}

/// Returns the configuration factor at a point of a convex polygon on a wall, given by its corners in the room's frame.
/// `position` and `normal`: of the receiving plane, room's frame.
pub fn corners_factor(wall: &Wall, corners: &[DVec3], position: DVec3, normal: DVec3) -> f64 {
    if wall.normal.dot(position - wall.point(0.0, 0.0)) <= 0.0 {
        return 0.0;
    }
    // Quick test: most patches of the floor lie behind a sensor on the work plane.
    let height = normal.dot(position);
    if corners.iter().all(|corner| normal.dot(*corner) <= height) {
        return 0.0;
    }
    // A parallelogram that a rectangle has cut has eight corners at most.
    let mut few = [DVec3::ZERO; 8];
    let from_here = corners.iter().map(|corner| *corner - position);
    let seen = if corners.len() <= few.len() {
        few.iter_mut().zip(from_here).for_each(|(to, corner)| *to = corner);
        projected_solid_angle(&few[..corners.len()], normal)
    } else {
        projected_solid_angle(&from_here.collect::<Vec<_>>(), normal)
    };
    seen / PI
}

#[cfg(test)]
mod tests {
    use super::super::aperture::Aperture;
    use super::super::mesh::{BoxRoom, Nested};
    use super::*;
    use crate::compute::direction::Surface;

    #[test]
    fn corner_sums_agree_with_lamberts_edge_sum_and_close() {
        let room = BoxRoom { size: DVec3::new(4.0, 6.0, 3.0), floor: 0.2, walls: 0.5, ceiling: 0.7 };
        let window = Aperture { surface: Surface::Facade, corner: DVec3::new(0.3, 0.0, 0.8), size: [2.5, 1.7] };
        let mesh = Nested::with_about(&room, &[window], &[0.0], 500).unwrap().fine;
        for normal in [DVec3::Z, DVec3::NEG_X, DVec3::new(0.3, 0.5, -0.4).normalize()] {
            for position in [DVec3::new(1.1, 2.3, 0.85), DVec3::new(0.01, 0.02, 2.99)] {
                let weights = configuration_factors(&mesh, position, normal);
                let sum: f64 = weights.iter().sum();
                assert!((sum - 1.0).abs() < 1e-12, "{normal}: {sum}");
                for (patch, w) in mesh.patches.iter().zip(&weights) {
                    let corners = patch.corners(&mesh.walls[patch.wall]).map(|c| c - position);
                    let exact = projected_solid_angle(&corners, normal) / PI;
                    assert!((w - exact).abs() < 1e-13 + 1e-9 * exact, "{normal} {position}: {w} {exact}");
                }
            }
        }
    }

    #[test]
    fn a_point_on_a_wall_sees_nothing_of_it() {
        let room = BoxRoom { size: DVec3::splat(2.0), floor: 0.5, walls: 0.5, ceiling: 0.5 };
        let mesh = Nested::with_about(&room, &[], &[], 300).unwrap().fine;
        let weights = configuration_factors(&mesh, DVec3::new(0.7, 0.9, 0.0), DVec3::Z);
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let floor = mesh.patches.iter().zip(&weights).filter(|(patch, _)| patch.wall == 0);
        assert!(floor.map(|(_, w)| *w).sum::<f64>() == 0.0);
    }
}
