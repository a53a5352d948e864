//! Conversion of values of q at emergent directions (points) into means over emergent cells.
//!
//! Where all incident directions have their points on the same rings with equal azimuth steps, every point becomes the
//! cell around it. Elsewhere a cell's mean is that of the points in it, if there are many; otherwise it is taken over 2
//! × 2 directions of equal projected weight, each interpolated from its four nearest points with weights 1/d²
//! (Shepard). The error is estimated by leaving points out one after the other and predicting them from their
//! neighbours, weighted by flux: it is the share of the light that remains uncertain between the points, not the error
//! of τ.

use super::frame::{Naming, tidy};
use super::records::{Incidence, Point};
use super::rings::FileRings;
use super::{MOST_CELLS, MOST_VALUES};
use crate::compute::basis::{AzimuthMap, Ring, RingBasis};
use crate::compute::btdf::Finding;
use crate::compute::direction::{Dir, Facade};
use crate::formats::location::{FormatError, Location};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Number of neighbouring points from which a value is interpolated.
const NEIGHBOURS: usize = 4;
/// Minimum number of points in a cell from which their mean is used as its value.
const MANY: usize = 6;
/// Maximum number of resampled values for all incident directions together; finer points are averaged.
const MOST_RESAMPLED: usize = 6_000_000;
/// Minimum width of a cell, unless the header defines cells. \[rad\]
const FINEST: f64 = PI / 180.0;

/// Result of resampling: emergent cells, q \[1/sr\] in one row per incident direction, and findings.
pub(super) struct Resampled {
    /// Emergent cells.
    pub basis: RingBasis,
    /// Mean q of each cell, in one row for each incident direction. \[1/sr\]
    pub rows: Vec<f64>,
    /// Findings about the resampling.
    pub findings: Vec<Finding>,
}

/// Converts points to means over cells for all incident directions of `list`. `rings`: cells that the header defines,
/// if any.
pub(super) fn resample(
    list: &[(Incidence, Vec<Point>)],
    rings: Option<FileRings>,
    naming: Naming,
) -> Result<Resampled, FormatError> {
    if let Some((incidence, points)) = list.iter().find(|(_, points)| points.len() < NEIGHBOURS) {
        return Err(FormatError::new(
            Location::line(incidence.line),
            format!("{} emergent directions for θ {}° φ {}°", points.len(), incidence.theta, incidence.phi),
            format!("at least {NEIGHBOURS} for every incidence"),
        ));
    }
    let Some((_, first)) = list.first() else {
        return Err(FormatError::new(Location::file(), "no records", "records behind the header"));
    };
    // Instruments that scan one raster give all incidences the same directions; names are compared to the last bit,
    // since they come from the same text.
    let same = list.iter().all(|(_, points)| {
        points.len() == first.len() && points.iter().zip(first).all(|(a, b)| a.name.vector() == b.name.vector())
    });
    // Points that are the centres of rings need no interpolation, unless the header asks for other cells.
    if rings.is_none()
        && same
        && let Some((basis, cells)) = own_rings(first)
    {
        return Ok(on_own_rings(list, basis, &cells, naming));
    }
    let basis = rings.map_or_else(|| cells_for(list), |rings| rings.basis);
    // Before anything is allocated: a header may ask for any number of cells.
    if basis.len().saturating_mul(list.len()) > MOST_VALUES {
        return Err(FormatError::new(
            Location::file(),
            format!("{} incidences on {} cells", list.len(), basis.len()),
            format!("at most {MOST_VALUES} values"),
        ));
    }
    let samples = samples(&basis);
    // Weights depend on the directions alone: the search for neighbours is made once where it can be.
    let shared = same.then(|| Stencils::new(&Cloud::new(first), &samples));
    let rows: Vec<(Vec<f64>, f64, f64)> = list
        .par_iter()
        .map(|(_, points)| match &shared {
            Some(stencils) => row_by(stencils, &basis, points),
            None => row_by(&Stencils::new(&Cloud::new(points), &samples), &basis, points),
        })
        .collect();
    // The worst incidence speaks: a mean over all would hide a gap that only grazing light has.
    let beyond = rows.iter().map(|row| row.1).fold(0.0, f64::max);
    let errors: Vec<f64> = rows.iter().map(|row| row.2).collect();
    let mut findings =
        vec![stated(&errors, format!("interpolated onto {} cells ({} rings)", basis.len(), basis.rings().len()))];
    if beyond > 0.02 {
        findings.push(Finding::warning(
            "points-gap",
            format!(
                "Up to {:.0} % of the projected hemisphere of an incidence lies farther than three spacings from any point; \
                 the values there are those of the nearest points.",
                100.0 * beyond
            ),
        ));
    }
    let rows = rows.into_iter().flat_map(|row| row.0).collect();
    Ok(Resampled { basis, rows, findings })
}

/// Returns, for one incident direction, the values of the cells, the share of samples far from all points, and the
/// error of predicting single points from their neighbours.
fn row_by(stencils: &Stencils, basis: &RingBasis, points: &[Point]) -> (Vec<f64>, f64, f64) {
    let value = |s: &Stencil| s.iter().map(|&(k, w)| w * points[k as usize].q).sum::<f64>();
    // The four samples of a cell have equal projected weight.
    let mut row: Vec<f64> =
        stencils.list.chunks_exact(4).map(|four| 0.25 * four.iter().map(value).sum::<f64>()).collect();
    means_of_many(basis, points, &mut row);
    (row, stencils.beyond, left_out(points))
}

/// Sets the value of each cell that contains many points to their mean.
fn means_of_many(basis: &RingBasis, points: &[Point], row: &mut [f64]) {
    let mut sums = vec![(0_u32, 0.0); basis.len()];
    for point in points {
        if let Some(cell) = basis.index(point.name) {
            sums[cell].0 += 1;
            sums[cell].1 += point.q;
        }
    }
    for ((count, sum), value) in sums.into_iter().zip(row) {
        if count as usize >= MANY {
            *value = sum / f64::from(count);
        }
    }
}

/// Returns the finding that states the error of the resampling.
fn stated(errors: &[f64], how: String) -> Finding {
    let mut sorted = errors.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (median, worst) = (sorted[sorted.len() / 2], sorted[sorted.len() - 1]);
    let message = format!(
        "Values at directions, {how}. Predicting every point from its neighbours misses {:.1} % of the light (median of \
         the incidences; worst {:.1} %): what lies between the points is uncertain by about as much.",
        100.0 * median,
        100.0 * worst
    );
    if median > 0.1 {
        Finding::warning("points-resampled", message)
    } else {
        Finding::info("points-resampled", message)
    }
}

/// Returns the rings of cells that have the points as their centres, and for every point the index of its cell; `None`
/// if there are no such rings.
fn own_rings(points: &[Point]) -> Option<(RingBasis, Vec<usize>)> {
    // θ′ and φ′ in degrees, sorted.
    let mut sorted: Vec<(f64, f64, usize)> = points
        .iter()
        .enumerate()
        .map(|(k, p)| {
            let [theta, phi] = Naming { inward: false, turned: false }.file_angles(p.name);
            (theta, phi, k)
        })
        .collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut groups: Vec<&[(f64, f64, usize)]> = Vec::new();
    groups.extend(sorted.chunk_by(|a, b| (a.0 - b.0).abs() < 1e-6));
    if groups.len() < 2 || groups.len() > 900 {
        return None;
    }
    for group in &groups {
        let step = 360.0 / group.len() as f64;
        let even = group.iter().enumerate().all(|(k, p)| (p.1 - group[0].1 - k as f64 * step).abs() < 2e-3);
        // A ring of one point is the normal; two or three points do not make a ring.
        if !even
            || group.len() > 7200
            || (group.len() < 4 && group[0].0 != 0.0)
            || (group.len() > 1 && group[0].0 == 0.0)
        {
            return None;
        }
    }
    let theta: Vec<f64> = groups.iter().map(|group| group[0].0).collect();
    let mut limits = vec![];
    let last = theta.len() - 1;
    // Towards the normal and the horizon a gap of up to one step belongs to the last ring.
    let inner = theta[1] - theta[0];
    limits.push(if theta[0] <= inner { 0.0 } else { theta[0] - 0.5 * inner });
    limits.extend(theta.windows(2).map(|w| 0.5 * (w[0] + w[1])));
    let outer = theta[last] - theta[last - 1];
    limits.push(if 90.0 - theta[last] <= outer { 90.0 } else { theta[last] + 0.5 * outer });
    let rings = groups
        .iter()
        .enumerate()
        .map(|(k, group)| Ring {
            theta_min: tidy(limits[k]).to_radians(),
            theta_max: tidy(limits[k + 1]).to_radians(),
            sectors: group.len(),
            first_phi: group[0].1.to_radians(),
        })
        .collect();
    let basis = RingBasis::new(format!("rings {}", points.len()), rings, AzimuthMap::FACADE).ok()?;
    let mut cells = vec![0; points.len()];
    for (cell, (_, _, k)) in groups.iter().flat_map(|group| group.iter()).enumerate() {
        cells[*k] = cell;
    }
    Some((basis, cells))
}

fn on_own_rings(list: &[(Incidence, Vec<Point>)], basis: RingBasis, cells: &[usize], naming: Naming) -> Resampled {
    let n = basis.len();
    let mut rows = vec![0.0; list.len() * n];
    for ((_, points), row) in list.iter().zip(rows.chunks_exact_mut(n)) {
        for (point, cell) in points.iter().zip(cells) {
            row[*cell] = point.q;
        }
    }
    let errors: Vec<f64> = list.par_iter().map(|(_, points)| left_out(points)).collect();
    let how = format!("each taken as the mean of the cell around it ({} rings, {n} cells)", basis.rings().len());
    let mut findings = vec![stated(&errors, how)];
    let covered: f64 = basis.projected_solid_angles().iter().sum::<f64>() / PI;
    if covered < 0.98 {
        let limits = [basis.rings()[0].theta_min, basis.rings()[basis.rings().len() - 1].theta_max];
        let [a, b] = limits.map(|theta| naming.theta(tidy(theta.to_degrees())));
        findings.push(Finding::warning(
            "points-gap",
            format!(
                "No points outside θ {a:.1}…{b:.1}°: {:.0} % of the projected hemisphere is zero.",
                100.0 * (1.0 - covered)
            ),
        ));
    }
    Resampled { basis, rows, findings }
}

/// Returns a division of the hemisphere into cells about as wide as the distance between close points.
fn cells_for(list: &[(Incidence, Vec<Point>)]) -> RingBasis {
    let (_, points) = list.iter().max_by_key(|(_, points)| points.len()).expect("there are incidences");
    let mut spacing = Cloud::new(points).spacings();
    spacing.sort_by(f64::total_cmp);
    let close = spacing.get(spacing.len() / 4).copied().unwrap_or(FRAC_PI_2);
    // Cells of a step as wide as high: 2π/step² on the hemisphere.
    let budget = (2.0 * PI * list.len() as f64 / MOST_RESAMPLED as f64).sqrt();
    let least = FINEST.max(budget).max((2.0 * PI / MOST_CELLS as f64).sqrt());
    even_rings(close.clamp(least, least.max(10_f64.to_radians())))
}

/// Returns a division of the hemisphere into rings of the width `step` \[rad\], with sectors about as wide.
pub(super) fn even_rings(step: f64) -> RingBasis {
    let count = (FRAC_PI_2 / step).round().max(1.0);
    let step = FRAC_PI_2 / count;
    let mut rings = Vec::new();
    for k in 0..count as usize {
        let (theta_min, theta_max) = (k as f64 * step, ((k + 1) as f64 * step).min(FRAC_PI_2));
        let around = 2.0 * PI * (0.5 * (theta_min + theta_max)).sin() / step;
        let sectors = if k == 0 { 1 } else { 2 * (0.5 * around).round().max(2.0) as usize };
        rings.push(Ring { theta_min, theta_max, sectors, first_phi: 0.0 });
    }
    let name = format!("rings of {}°", tidy(step.to_degrees()));
    RingBasis::new(name, rings, AzimuthMap::FACADE).expect("equal steps divide the hemisphere")
}

/// Returns four directions in every cell, which represent equal projected solid angles.
fn samples(basis: &RingBasis) -> Vec<DVec3> {
    let mut list = Vec::with_capacity(4 * basis.len());
    for cell in basis.cells() {
        let (a, b) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
        for u in [0.25, 0.75] {
            let theta = (a + (b - a) * u).sqrt().min(1.0).asin();
            for v in [-0.25, 0.25] {
                list.push(Dir::<Facade>::from_theta_phi(theta, cell.phi + v * cell.width).vector());
            }
        }
    }
    list
}

/// Returns the error, as a share of the light, of predicting every point from its neighbours alone.
fn left_out(points: &[Point]) -> f64 {
    const TESTED: usize = 1500;
    let cloud = Cloud::new(points);
    let step = points.len().div_ceil(TESTED).max(1);
    let (mut missed, mut all) = (0.0, 0.0);
    for k in (0..points.len()).step_by(step) {
        let v = points[k].name.vector();
        let stencil = cloud.stencil(v, Some(k));
        let predicted: f64 = stencil.iter().map(|&(j, w)| w * points[j as usize].q).sum();
        // The square of the distance to the neighbours stands for the area of the point.
        let nearest = cloud.neighbours(v, 1, Some(k)).first().map_or(0.0, |n| n.0);
        let weight = nearest * v.z.max(0.0);
        missed += weight * (predicted - points[k].q).abs();
        all += weight * points[k].q;
    }
    if all > 0.0 { missed / all } else { 0.0 }
}

type Stencil = [(u32, f64); NEIGHBOURS];

/// Interpolation weights of the points of one incident direction for the samples of all cells.
struct Stencils {
    list: Vec<Stencil>,
    /// Share of the samples that are far from all points.
    beyond: f64,
}

impl Stencils {
    fn new(cloud: &Cloud, samples: &[DVec3]) -> Self {
        let mut spacing = cloud.spacings();
        spacing.sort_by(f64::total_cmp);
        // Measured by the wide spacings: points may be closer in a peak.
        let far = 3.0 * spacing.get(9 * spacing.len() / 10).copied().unwrap_or(0.0);
        let list: Vec<Stencil> = samples.iter().map(|v| cloud.stencil(*v, None)).collect();
        let away = samples.iter().zip(&list).filter(|(v, s)| (cloud.points[s[0].0 as usize] - **v).length() > far);
        Self { beyond: away.count() as f64 / samples.len().max(1) as f64, list }
    }
}

/// Points sorted into a grid of squares of equal solid angle in Lambert's equal-area projection, for the search of
/// neighbours.
struct Cloud {
    points: Vec<DVec3>,
    side: usize,
    /// Index in `order` of the first entry of every square.
    start: Vec<u32>,
    order: Vec<u32>,
}

/// Returns Lambert's azimuthal equal-area projection of the hemisphere into [0, 1]².
fn lambert(v: DVec3) -> [f64; 2] {
    let scale = 0.5 / (1.0 + v.z.max(0.0)).sqrt();
    [0.5 + v.x * scale, 0.5 + v.y * scale]
}

impl Cloud {
    fn new(points: &[Point]) -> Self {
        let points: Vec<DVec3> = points.iter().map(|p| p.name.vector()).collect();
        let side = ((points.len() as f64 / 2.0).sqrt() as usize).clamp(1, 1024);
        let square = |v: &DVec3| {
            let [x, y] = lambert(*v).map(|t| ((t * side as f64) as usize).min(side - 1));
            y * side + x
        };
        let mut start = vec![0_u32; side * side + 1];
        for v in &points {
            start[square(v) + 1] += 1;
        }
        for k in 0..side * side {
            start[k + 1] += start[k];
        }
        let mut next = start.clone();
        let mut order = vec![0; points.len()];
        for (k, v) in points.iter().enumerate() {
            let place = &mut next[square(v)];
            order[*place as usize] = k as u32;
            *place += 1;
        }
        Self { points, side, start, order }
    }

    /// Returns the `count` points nearest to the direction `v`, each with the square of its chord to `v`, in rising
    /// order; `without`: point to leave out.
    fn neighbours(&self, v: DVec3, count: usize, without: Option<usize>) -> Vec<(f64, u32)> {
        let [cx, cy] = lambert(v).map(|t| ((t * self.side as f64) as usize).min(self.side - 1) as isize);
        let side = self.side as isize;
        let mut found: Vec<(f64, u32)> = Vec::with_capacity(count + 1);
        for ring in 0..side {
            // A chord is at least 1/√2 of the distance on the disc of radius √2, which [0, 1] shrinks by 2√2.
            let reached = 2.0 * (ring - 1).max(0) as f64 / self.side as f64;
            if found.len() == count && found[count - 1].0 < reached * reached {
                break;
            }
            for y in (cy - ring).max(0)..=(cy + ring).min(side - 1) {
                let edge = (y - cy).abs() == ring;
                let step = if edge || ring == 0 { 1 } else { 2 * ring };
                let mut x = cx - ring;
                while x <= cx + ring {
                    if (0..side).contains(&x) {
                        let square = (y * side + x) as usize;
                        for &k in &self.order[self.start[square] as usize..self.start[square + 1] as usize] {
                            if without == Some(k as usize) {
                                continue;
                            }
                            let d = (self.points[k as usize] - v).length_squared();
                            let place = found.partition_point(|other| other.0 <= d);
                            if place < count {
                                found.insert(place, (d, k));
                                found.truncate(count);
                            }
                        }
                    }
                    x += step;
                }
            }
        }
        found
    }

    /// Returns the nearest points of the direction `v` with their weights proportional to 1/d², of sum 1; `without`:
    /// point to leave out.
    fn stencil(&self, v: DVec3, without: Option<usize>) -> Stencil {
        let near = self.neighbours(v, NEIGHBOURS, without);
        let mut stencil = [(0, 0.0); NEIGHBOURS];
        let mut sum = 0.0;
        for (slot, (d, k)) in stencil.iter_mut().zip(&near) {
            let weight = 1.0 / d.max(1e-14);
            *slot = (*k, weight);
            sum += weight;
        }
        // Fewer neighbours than slots: the rest repeats the first with no weight.
        let first = stencil[0].0;
        for slot in &mut stencil {
            *slot = if slot.1 == 0.0 { (first, 0.0) } else { (slot.0, slot.1 / sum) };
        }
        stencil
    }

    /// Returns the distance of every point (of a sample, if there are many) to its nearest neighbour, as a chord of the
    /// unit sphere.
    fn spacings(&self) -> Vec<f64> {
        let step = self.points.len().div_ceil(4000).max(1);
        (0..self.points.len())
            .step_by(step)
            .filter_map(|k| Some(self.neighbours(self.points[k], 1, Some(k)).first()?.0.sqrt()))
            .collect()
    }
}
