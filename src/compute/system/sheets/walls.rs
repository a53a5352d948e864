//! Opaque Lambertian sheets with holes: perforated and expanded metal, grids of webs.
//!
//! A hole is a convex polygon carried through the thickness of the sheet, perhaps obliquely. The undeviated share is
//! the overlap of its two ends as seen along the light. Light on the walls is computed by radiosity: a point of a wall
//! is lit if the line back to the source leaves through the hole's end, so that the light on a patch is the area of two
//! polygons' overlap, exactly; and a patch sends light towards a direction in proportion to the area that light from
//! that direction would reach. No light goes from one hole to another, because the faces are plane.

use super::hole::{Hole, Perforated};
use crate::compute::basis::{Cell, RingBasis, sub_directions};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::polygon::{area, cut_by_all};
use crate::compute::scaling::by_rounds;
use crate::compute::sequence::recurrence;
use crate::compute::system::measure::{Measured, Setting, Side};
use faer::Mat;
use faer::linalg::solvers::Solve;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Number of corners of the polygon that represents a round hole of the same area. Chosen: cost; from the circle its
/// border departs by 0.6 % of the radius, its undeviated share by 2e-4 of the hole's area.
const CIRCLE: usize = 24;
/// Minimum number of patches of the walls around a hole. Chosen; held by the test
/// `a_deep_hole_with_white_walls_is_a_pipe_that_loses_nothing`, which compares with Clausing's probability.
const AROUND: usize = 24;
/// Numbers of patches of the walls through the sheet's thickness: of the coarsest and of the finest division. Chosen:
/// cost; results change within their stated error, which is the change from the next coarser number.
const DEPTH: [usize; 2] = [3, 12];
/// Number of rays per patch by which the light exchange between patches is computed. Chosen: cost; independent rays
/// would leave 1/√2048 ≈ 2 % of a patch's exchange, a lattice less. Held by the tests of [`AROUND`] and
/// `balance_and_reciprocity_of_every_shape`.
const RAYS: usize = 2048;
/// Number of rounds of scaling that make the exchange between patches reciprocal. Each round halves the deficit: 2⁻⁵⁰ ≈
/// 1e-15 of it, the rounding of f64, is left.
const ROUNDS: usize = 50;

/// Computes patch-averaged data of a perforated sheet on the cells of `setting`, with finer and finer patches on the
/// walls until its allowed error is met.
///
/// # Errors
/// Returns [`Cancelled`] if `progress` is cancelled.
pub(super) fn measure_walls(
    sheet: &Perforated,
    setting: &Setting<'_>,
    progress: &dyn Progress,
) -> Result<Measured, Cancelled> {
    let mut coarse: Option<Measured> = None;
    let mut depth = DEPTH[0];
    loop {
        let mut made = Walls::new(sheet, depth).measure(setting, progress)?;
        let mut worst = f64::INFINITY;
        if let Some(last) = &coarse {
            worst = 0.0;
            for side in Side::BOTH {
                let (t, r) = (made.shares(&made.seen(side).transmitted), made.shares(&made.seen(side).reflected));
                let (t0, r0) = (last.shares(&last.seen(side).transmitted), last.shares(&last.seen(side).reflected));
                for (i, error) in made.seen_mut(side).error.iter_mut().enumerate() {
                    *error += (t[i] - t0[i]).abs().max((r[i] - r0[i]).abs());
                    worst = worst.max(*error);
                }
            }
        }
        if worst <= setting.error || depth >= DEPTH[1] {
            return Ok(made);
        }
        coarse = Some(made);
        depth *= 2;
    }
}

/// Hole with its walls divided into patches. Lengths are relative to the square root of the sheet's area per hole; z =
/// 0 is the outer face.
pub(super) struct Walls {
    outer: Vec<DVec2>,
    inner: Vec<DVec2>,
    thickness: f64,
    open: f64,
    patches: Vec<[DVec3; 4]>,
    areas: Vec<f64>,
    reflectance: [f64; 3],
}

/// Undeviated share and flux on the walls for light of each cell of a basis, from one side.
#[derive(Clone)]
pub(super) struct Lit {
    /// Share of the light on the sheet that passes undeviated, for each cell.
    straight: Vec<f64>,
    /// Flux on every patch (column) for light of every cell (row), per flux on the sheet.
    pub walls: Mat<f64>,
}

impl Walls {
    /// Creates the walls of a hole with `depth` patches through the thickness of the sheet.
    pub fn new(sheet: &Perforated, depth: usize) -> Self {
        let unit = sheet.area.sqrt();
        let corners: Vec<DVec2> = match sheet.hole {
            Hole::Round { diameter } => {
                let n = CIRCLE as f64;
                // The regular polygon of the circle's area.
                let radius = 0.5 * diameter * (2.0 * PI / (n * (2.0 * PI / n).sin())).sqrt();
                (0..CIRCLE).map(|k| radius * DVec2::from_angle(2.0 * PI * (k as f64 + 0.5) / n)).collect()
            }
            Hole::Rectangle { width, height } => {
                let (x, y) = (0.5 * width, 0.5 * height);
                vec![DVec2::new(x, -y), DVec2::new(x, y), DVec2::new(-x, y), DVec2::new(-x, -y)]
            }
            Hole::Rhombus { width, height } => {
                let (x, y) = (0.5 * width, 0.5 * height);
                vec![DVec2::new(x, 0.0), DVec2::new(0.0, y), DVec2::new(-x, 0.0), DVec2::new(0.0, -y)]
            }
        };
        let outer: Vec<DVec2> = corners.iter().map(|&c| c / unit).collect();
        let rise = DVec2::new(0.0, sheet.rise / unit);
        let inner: Vec<DVec2> = outer.iter().map(|&c| c + rise).collect();
        let thickness = sheet.thickness / unit;
        let parts = AROUND.div_ceil(outer.len());
        let mut patches = Vec::new();
        for k in 0..outer.len() {
            let (a, b) = (outer[k], outer[(k + 1) % outer.len()]);
            for part in 0..parts {
                let along = |j: usize| a.lerp(b, j as f64 / parts as f64);
                for d in 0..depth {
                    let at = |p: DVec2, d: usize| {
                        let s = d as f64 / depth as f64;
                        (p + rise * s).extend(-thickness * s)
                    };
                    let (p, q) = (along(part), along(part + 1));
                    patches.push([at(p, d), at(q, d), at(q, d + 1), at(p, d + 1)]);
                }
            }
        }
        let areas = patches.iter().map(|p| (p[1] - p[0]).cross(p[3] - p[0]).length()).collect();
        Self { open: area(&outer), outer, inner, thickness, patches, areas, reflectance: sheet.reflectance }
    }

    /// Returns the number of patches of the walls.
    pub const fn len(&self) -> usize {
        self.patches.len()
    }

    /// Returns the area of every patch, relative to the sheet's area per hole.
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// Returns the share of the light sent by each patch that leaves through the ends of the hole; by reciprocity it
    /// follows from `through`, the light that reaches the patch from all cells of both sides.
    pub fn escaping(&self, cells: &RingBasis, through: &[Lit; 2]) -> Vec<f64> {
        let weight = cells.projected_solid_angles();
        let flux = |lit: &Lit, j: usize| (0..weight.len()).map(|o| lit.walls[(o, j)] * weight[o]).sum::<f64>();
        self.areas
            .iter()
            .enumerate()
            .map(|(j, area)| (flux(&through[0], j) + flux(&through[1], j)) / (PI * area))
            .collect()
    }

    /// Computes the patch-averaged data of the sheet with this division of the walls.
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        let mut measured = Measured::dark(setting);
        let n = self.patches.len();
        let step = |k| {
            progress.advance("holes", k, 4);
            if progress.cancelled() { Err(Cancelled) } else { Ok(()) }
        };
        step(0)?;
        let arriving = Side::BOTH.map(|side| self.lit(setting.incident, side, false));
        step(1)?;
        // Leaving light has the through direction of light that would light the patch: from the other side for
        // transmitted, the rotated one for reflected light.
        let through = if setting.incident == setting.emergent {
            arriving.clone()
        } else {
            Side::BOTH.map(|side| self.lit(setting.emergent, side, false))
        };
        let back = Side::BOTH.map(|side| self.lit(setting.emergent, side, true));
        step(2)?;
        let weight = setting.emergent.projected_solid_angles();
        let response = self.response(&self.escaping(setting.emergent, &through));
        step(3)?;
        let wall = self.reflectance[2];
        for (k, side) in Side::BOTH.into_iter().enumerate() {
            let face = self.reflectance[k];
            let came = &arriving[k];
            // Light that falls on every patch in the end, a column per incident cell.
            let incident = &response * came.walls.transpose();
            let exitance =
                Mat::from_fn(n, setting.incident.len(), |j, i| wall * incident[(j, i)] / (PI * self.areas[j]));
            let forward = &through[1 - k].walls * &exitance;
            let returned = &back[k].walls * &exitance;
            let mut straight = vec![0.0; setting.incident.len() * weight.len()];
            straight_on(&mut straight, setting, &came.straight);
            let seen = measured.seen_mut(side);
            for i in 0..setting.incident.len() {
                for o in 0..weight.len() {
                    let at = i * weight.len() + o;
                    seen.transmitted[at] = straight[at] + forward[(o, i)];
                    seen.reflected[at] = face * (1.0 - self.open) / PI + returned[(o, i)];
                }
                let swallowed: f64 = (0..n).map(|j| (1.0 - wall) * incident[(j, i)]).sum();
                seen.absorbed[i] = (1.0 - face) * (1.0 - self.open) + swallowed;
            }
        }
        for side in Side::BOTH {
            let (t, r) =
                (measured.shares(&measured.seen(side).transmitted), measured.shares(&measured.seen(side).reflected));
            let seen = measured.seen_mut(side);
            for i in 0..t.len() {
                // Light that the averages lose or win.
                seen.error[i] = (t[i] + r[i] + seen.absorbed[i] - 1.0).abs();
            }
        }
        Ok(measured)
    }

    /// Computes the undeviated share and the flux on the walls for light of every cell from `side`; `turned`: with the
    /// directions of undeviated light rotated by 180° about the normal, as for reflected light.
    pub fn lit(&self, cells: &RingBasis, side: Side, turned: bool) -> Lit {
        let list: Vec<Cell> = cells.cells().collect();
        let rows: Vec<(f64, Vec<f64>)> = list
            .par_iter()
            .map(|cell| {
                // At most 4° between directions.
                let wide = (cell.theta_max - cell.theta_min).max(cell.width * cell.theta().sin());
                let sub = ((wide.to_degrees() / 4.0).ceil() as usize).clamp(1, 4);
                let share = 1.0 / (sub * sub) as f64;
                let mut walls = vec![0.0; self.patches.len()];
                let mut straight = 0.0;
                for d in sub_directions(cell, sub) {
                    straight += share * self.light(d, side, turned, share, &mut walls);
                }
                (straight, walls)
            })
            .collect();
        Lit {
            straight: rows.iter().map(|row| row.0).collect(),
            walls: Mat::from_fn(list.len(), self.patches.len(), |i, j| rows[i].1[j]),
        }
    }

    /// Adds the flux of light of one direction on every patch, times `share`, to `walls`, and returns the share that
    /// passes undeviated. `direction`: direction of undeviated light, rotated by 180° about the normal first if
    /// `turned`.
    pub fn light(&self, direction: Dir<Facade>, side: Side, turned: bool, share: f64, walls: &mut [f64]) -> f64 {
        let mut v = direction.vector();
        if turned {
            (v.x, v.y) = (-v.x, -v.y);
        }
        // The way light travels, where it enters and where it leaves.
        let ends = [(&self.outer, 0.0), (&self.inner, -self.thickness)];
        let (travel, (entry, level), (exit, far)) = match side {
            Side::Front => (-v, ends[0], ends[1]),
            Side::Back => (v, ends[1], ends[0]),
        };
        if travel.z.abs() < 1e-9 {
            return 0.0;
        }
        let carried = |p: DVec3| (p - travel * ((p.z - level) / travel.z)).truncate();
        let (mut lit, mut spare) = (0.0, Default::default());
        for (patch, wall) in self.patches.iter().zip(walls) {
            // Of a wall that light meets from behind, the shadow lies beside the entry: the hole is convex.
            let part = shared(&patch.map(carried), entry, &mut spare);
            *wall += share * part;
            lit += part;
        }
        let image: Vec<DVec2> = exit.iter().map(|&p| carried(p.extend(far))).collect();
        let straight = shared(&image, entry, &mut spare);
        debug_assert!((straight + lit - self.open).abs() < 1e-6 * self.open + 1e-9, "{straight} {lit} {}", self.open);
        straight
    }

    /// Returns the flux that patch j receives after all interreflections, per flux that patch i receives first: (1 − K
    /// ρ)⁻¹ with the exchange K and the reflectance ρ. `escaping`: the share that leaves each patch through the ends of
    /// the hole.
    pub fn response(&self, escaping: &[f64]) -> Mat<f64> {
        let n = self.patches.len();
        let rows: Vec<Vec<f64>> = (0..n).into_par_iter().map(|k| self.exchange(k)).collect();
        // Area × factor both ways alike, and what does not escape lands: rays count either only to their noise.
        let mutual = |i: usize, j: usize| 0.5 * (rows[i][j] * self.areas[i] + rows[j][i] * self.areas[j]);
        let sums = |scale: &[f64]| (0..n).map(|i| (0..n).map(|j| mutual(i, j) * scale[j]).sum()).collect();
        let wanted: Vec<_> =
            self.areas.iter().zip(escaping).map(|(area, gone)| Some(area * (1.0 - gone).max(0.0))).collect();
        let scale = by_rounds(sums, &wanted, ROUNDS, 0.0, f64::INFINITY);
        let factor = |i: usize, j: usize| scale[i] * mutual(i, j) * scale[j] / self.areas[i];
        let wall = self.reflectance[2];
        let system = Mat::from_fn(n, n, |j, i| f64::from(u8::from(i == j)) - wall * factor(i, j));
        system.partial_piv_lu().solve(Mat::<f64>::identity(n, n))
    }

    /// Returns the share of the light sent by patch `from` that reaches each patch, by rays of equal weight.
    fn exchange(&self, from: usize) -> Vec<f64> {
        let corners = &self.patches[from];
        let (u, w) = (corners[1] - corners[0], corners[3] - corners[0]);
        let mut normal = u.cross(w).normalize_or_zero();
        let middle = 0.5 * (corners[0] + corners[2]);
        let axis = {
            let centre: DVec2 = self.outer.iter().sum::<DVec2>() / self.outer.len() as f64;
            let down = -middle.z / self.thickness;
            (centre + (self.inner[0] - self.outer[0]) * down).extend(middle.z)
        };
        if normal.dot(axis - middle) < 0.0 {
            normal = -normal;
        }
        let tangent = u.normalize_or_zero();
        let side = normal.cross(tangent);
        let depth = self.patches.len() / (self.outer.len() * AROUND.div_ceil(self.outer.len()));
        let mut row = vec![0.0; self.patches.len()];
        for k in 0..RAYS {
            // A rank-1 lattice in four dimensions (powers of the plastic-like constant): even without being regular.
            let at = |alpha: f64| recurrence(0.5, k as f64 + 1.0, alpha);
            let (a, b) = (at(0.856_674_883_854_502_8), at(0.733_891_856_627_126));
            let (c, d) = (at(0.628_706_721_018_231_5), at(0.538_597_264_883_558_2));
            let origin = corners[0] + u * a + w * b;
            let (sine, cosine) = (c.sqrt(), (1.0 - c).sqrt());
            let (sin, cos) = (2.0 * PI * d).sin_cos();
            let ray = normal * cosine + (tangent * cos + side * sin) * sine;
            if let Some(patch) = self.hit(origin, ray, from / (depth * AROUND.div_ceil(self.outer.len())), depth) {
                row[patch] += 1.0 / RAYS as f64;
            }
        }
        row
    }

    /// Returns the index of the patch that a ray meets; `None` if it leaves through an end of the hole.
    fn hit(&self, origin: DVec3, ray: DVec3, own: usize, depth: usize) -> Option<usize> {
        let n = self.outer.len();
        let parts = AROUND.div_ceil(n);
        // In coordinates that follow the hole's axis the hole is upright.
        let lean = (self.inner[0] - self.outer[0]) / self.thickness;
        let upright = |p: DVec3| p.truncate() + lean * p.z;
        let (start, way) = (upright(origin), ray.truncate() + lean * ray.z);
        let mut best: Option<(f64, usize, f64)> = None;
        for k in (0..n).filter(|&k| k != own) {
            let (a, b) = (self.outer[k], self.outer[(k + 1) % n]);
            let edge = b - a;
            let across = way.perp_dot(edge);
            if across.abs() < 1e-14 {
                continue;
            }
            let t = (a - start).perp_dot(edge) / across;
            let s = (a - start).perp_dot(way) / across;
            if t > 1e-12 && (-1e-9..=1.0 + 1e-9).contains(&s) && best.is_none_or(|(other, ..)| t < other) {
                best = Some((t, k, s));
            }
        }
        let (t, k, s) = best?;
        let level = -(origin.z + t * ray.z) / self.thickness;
        if !(0.0..1.0).contains(&level) {
            return None;
        }
        let part = ((s.clamp(0.0, 1.0) * parts as f64) as usize).min(parts - 1);
        Some((k * parts + part) * depth + (level * depth as f64) as usize)
    }
}

/// Adds undeviated light, given as a share for every incident cell, to the values q of the emergent cells that it falls
/// into.
fn straight_on(values: &mut [f64], setting: &Setting<'_>, straight: &[f64]) {
    let shares = crate::compute::basis::Resampling::new(setting.incident, setting.emergent);
    let weight = setting.incident.projected_solid_angles();
    for o in 0..setting.emergent.len() {
        for &(i, share) in shares.shares(o) {
            values[i * setting.emergent.len() + o] += share * straight[i] / weight[i];
        }
    }
}

/// Returns the area of the part of a convex polygon that lies within another one (counter-clockwise). The last argument
/// is a pair of buffers.
fn shared(subject: &[DVec2], within: &[DVec2], [polygon, spare]: &mut [Vec<DVec2>; 2]) -> f64 {
    polygon.clear();
    polygon.extend(subject);
    let edges = within.iter().zip(within.iter().cycle().skip(1));
    cut_by_all(polygon, edges.map(|(&a, &b)| move |p: DVec2| (b - a).perp_dot(p - a)), spare);
    area(polygon).abs()
}

#[cfg(test)]
mod tests;
