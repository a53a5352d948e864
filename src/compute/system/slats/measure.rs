//! Patch-averaged BSDF data of slats, computed from the transport of light in their section.

use super::array::{SlatArray, Surface};
use super::balance::Balance;
use super::deposit::Intervals;
use super::direct::Direct;
use super::flows::{Lobe, Transport, index};
use super::outline::SlatSection;
use super::profile::SlatProfile;
use super::profile_weights::{ProfileGrid, ProfileWeights};
use super::rough::add_rough;
use crate::compute::basis::RingBasis;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::system::measure::{Measured, OneSide, Setting, Side};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, Par};
use rayon::prelude::*;

/// Numbers of coarse strips per slat: initial and maximum. Chosen: cost; they are doubled until a tenth of the allowed
/// error is met, and the error that remains is stated. At ρ = 0.95, before extrapolation, 20 strips leave 6e-4 in τ, 40
/// leave 1e-4.
const PARTS: [usize; 2] = [16, 128];
/// Minimum number of coarse strips where mirrors are curved: strips are chords, and light that passes a chord misses
/// the arc, by 1/32² ≈ 0.1 % of its rise. Chosen; held by
/// `tests/compute/goniophotometer_slats.rs::limits_of_shapes_meet` (2e-3).
const CURVED: usize = 32;
/// Number of coarse strips for light of one direction. Chosen; held by the test
/// `single_directions_keep_the_balance_of_profile_angles` of `model` (2e-3 for matt slats).
pub(super) const PARTS_BY_DIRECTION: usize = 32;

/// Returns the step of the profile angle that the array and the allowed error require. \[rad\]
fn step(array: &SlatArray, setting: &Setting<'_>) -> f64 {
    let finest = setting
        .emergent
        .rings()
        .iter()
        .chain(setting.incident.rings())
        .map(|ring| ring.theta_max - ring.theta_min)
        .fold(f64::INFINITY, f64::min);
    // Lobes wider than this are smooth enough.
    let sharp = |side: Surface| side.mirror > 0.0 && side.spread < 1_f64.to_radians();
    let wanted: f64 = if sharp(array.upper()) || sharp(array.lower()) { 0.25 } else { 0.5 };
    let wanted = wanted * (setting.error / 0.01).sqrt().clamp(0.25, 1.0);
    wanted.to_radians().min(0.5 * finest).max(0.1_f64.to_radians())
}

/// Returns the light on the faces for every cell as a matrix (faces × cells), averaged over each cell by projected
/// solid angle. `rows`: light on each face by node of the profile angle; `turned`: at the opposite profile angle, as
/// for reflected light.
fn incident_widths(cells: &ProfileWeights, basis: &RingBasis, rows: &[Vec<f64>], turned: bool) -> Mat<f64> {
    let faces = rows[0].len();
    let mut matrix = Mat::zeros(faces, cells.len());
    for (index, cell) in basis.cells().enumerate() {
        let (first, weights) = cells.cell(index);
        let scale = 1.0 / cell.projected_solid_angle();
        let column = matrix.col_as_slice_mut(index);
        for (k, weight) in weights.iter().enumerate() {
            let node = if turned { rows.len() - 1 - first - k } else { first + k };
            column.iter_mut().zip(&rows[node]).for_each(|(sum, x)| *sum += scale * weight * x);
        }
    }
    matrix
}

impl SlatArray {
    /// Computes transmission and reflection of the array of slats as means over the cells of `setting`.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    pub fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        measure(self, setting, progress)
    }
}

/// Computes the scattering with finer and finer strips, until a tenth of the allowed error is met; adds direct light,
/// matt faces and mirrors.
fn measure(array: &SlatArray, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
    /// Key of the stage in reports of progress.
    const STAGE: &str = "slats";
    progress.advance(STAGE, 0, 4);
    let grid = ProfileGrid::new(step(array, setting));
    let hat: Vec<f64> = (0..grid.len()).map(|node| grid.hat(node)).collect();
    let incident = ProfileWeights::new(setting.incident, grid);
    let same = setting.emergent == setting.incident;
    let emergent = if same { incident.clone() } else { ProfileWeights::new(setting.emergent, grid) };
    progress.advance(STAGE, 1, 4);

    let mirrors = [array.upper(), array.lower()].iter().any(|side| side.mirror > 0.0);
    let curved = mirrors && matches!(array.profile(), SlatProfile::Arc { .. });
    let mut parts = if curved { CURVED } else { PARTS[0] };
    let (transport, balance, from) = loop {
        let section = SlatSection::new(array, parts);
        let transport = Transport::new(&section, grid, setting.seed, progress)?;
        let balance = Balance::new(&section, &transport, &hat);
        let from =
            [0, 1].map(|side: usize| incident_widths(&incident, setting.incident, &transport.incident[side], false));
        let uncertainty = from.iter().flat_map(|from| uncertainties(&balance, from)).fold(0.0, f64::max);
        if uncertainty <= 0.1 * setting.error || parts >= PARTS[1] {
            break (transport, balance, from);
        }
        parts *= 2;
    };
    progress.advance(STAGE, 2, 4);
    if progress.cancelled() {
        return Err(Cancelled);
    }

    // Here, not on the threads of the pool: memory that another thread frees goes back late.
    let mut measured = Measured::dark(setting);
    let scattered = |side: Side, seen: &mut OneSide| {
        let (from, own) = (&from[index(side)], &transport.incident[index(side)]);
        let other = &transport.incident[1 - index(side)];
        let mut sent = Mat::zeros(from.nrows(), from.ncols());
        // q = h M g/π, h and g in widths over the projected solid angles of their cells.
        matmul(&mut sent, Accum::Replace, &balance.response, from, std::f64::consts::FRAC_1_PI, Par::Seq);
        let block = |q: &mut [f64], rows: &[Vec<f64>], turned| {
            let to = incident_widths(&emergent, setting.emergent, rows, turned);
            let sum = MatMut::from_column_major_slice_mut(q, to.ncols(), sent.ncols());
            matmul(sum, Accum::Replace, to.transpose(), &sent, 1.0, Par::Seq);
            // The extrapolation to endless strips may fall below 0 where nothing arrives.
            q.iter_mut().for_each(|q| *q = q.max(0.0));
        };
        let OneSide { transmitted, reflected, absorbed: taken, error } = seen;
        rayon::join(|| block(transmitted, other, false), || block(reflected, own, true));
        (*taken, *error) = (absorbed(&balance, from), uncertainties(&balance, from));
    };
    let Measured { front, back, .. } = &mut measured;
    // One after the other: each is parallel already, and needs memory besides.
    scattered(Side::Front, front);
    scattered(Side::Back, back);
    progress.advance(STAGE, 3, 4);
    add_direct(array, setting, &mut measured);
    if transport.mirrored.iter().flatten().any(|mirrored| !(mirrored.through.is_empty() && mirrored.back.is_empty())) {
        add_mirrored(setting, grid, &incident, &transport, &mut measured);
    }
    if let Some(rough) = &transport.rough {
        add_rough(setting, grid, rough, &mut measured);
    }
    for side in Side::BOTH {
        let (t, r) =
            (measured.shares(&measured.seen(side).transmitted), measured.shares(&measured.seen(side).reflected));
        let seen = measured.seen_mut(side);
        for (i, error) in seen.error.iter_mut().enumerate() {
            *error += (t[i] + r[i] + seen.absorbed[i] - 1.0).abs();
        }
    }
    progress.advance(STAGE, 4, 4);
    Ok(measured)
}

/// Returns the share of the light of every incident cell that the faces absorb.
fn absorbed(balance: &Balance, from: &Mat<f64>) -> Vec<f64> {
    let of = |cell: usize| from.col_as_slice(cell).iter().zip(&balance.absorbed).map(|(g, a)| g * a).sum();
    (0..from.ncols()).map(of).collect()
}

/// Returns the error of τ and ρ of every incident cell from the difference between the two divisions into strips.
fn uncertainties(balance: &Balance, from: &Mat<f64>) -> Vec<f64> {
    let of = |cell: usize| {
        let one = |uncertainty: &[f64]| {
            from.col_as_slice(cell).iter().zip(uncertainty).map(|(g, d)| g * d).sum::<f64>().abs()
        };
        one(&balance.uncertainty[0]).max(one(&balance.uncertainty[1]))
    };
    (0..from.ncols()).map(of).collect()
}

/// Adds the light that passes without touching a slat to the transmitted light of both sides.
fn add_direct(array: &SlatArray, setting: &Setting<'_>, measured: &mut Measured) {
    let cells = Direct::new(array).cells(setting.incident, setting.emergent);
    let m = setting.emergent.len();
    let incident = setting.incident.projected_solid_angles();
    let emergent = setting.emergent.projected_solid_angles();
    for (i, (_, parts)) in cells.iter().enumerate() {
        for &(o, flux) in parts {
            let q = flux / (incident[i] * emergent[o]);
            measured.front.transmitted[i * m + o] += q;
            measured.back.transmitted[i * m + o] += q;
        }
    }
}

/// Distributes beams and fans reflected by ideal mirrors over the nodes of the grid of profile angles: pairs of node
/// and width.
fn on_nodes(lobes: &[Lobe], grid: ProfileGrid) -> Vec<(usize, f64)> {
    let mut line = vec![0.0; grid.len()];
    for lobe in lobes.iter().filter(|lobe| lobe.variance <= 0.0) {
        let [from, to] = lobe.psi;
        let points = (2.0 * (to - from).abs() / grid.step()).ceil().max(1.0);
        for k in 0..points as usize {
            let (node, above) = grid.place(from + (to - from) * (k as f64 + 0.5) / points);
            line[node] += lobe.width * (1.0 - above) / points;
            line[node + 1] += lobe.width * above / points;
        }
    }
    line.into_iter().enumerate().filter(|&(_, width)| width > 0.0).collect()
}

/// Adds the light reflected by ideal mirrors out of the section to the values of the emergent cells.
fn add_mirrored(
    setting: &Setting<'_>,
    grid: ProfileGrid,
    incident: &ProfileWeights,
    transport: &Transport,
    measured: &mut Measured,
) {
    let lines = Intervals::new(setting.emergent, grid);
    let sources = Intervals::new(setting.incident, grid).by_cell(setting.incident.len());
    let weight = setting.emergent.projected_solid_angles();
    let m = weight.len();
    for side in Side::BOTH {
        for through in [true, false] {
            let nodes: Vec<Vec<(usize, f64)>> = transport.mirrored[index(side)]
                .iter()
                .map(|mirrored| on_nodes(if through { &mirrored.through } else { &mirrored.back }, grid))
                .collect();
            let seen = measured.seen_mut(side);
            let values = if through { &mut seen.transmitted } else { &mut seen.reflected };
            values.par_chunks_mut(m).zip(setting.incident.cells().collect::<Vec<_>>()).enumerate().for_each(
                |(i, (row, cell))| {
                    let (first, weights) = incident.cell(i);
                    let solid = cell.projected_solid_angle();
                    let total: f64 = weights
                        .iter()
                        .enumerate()
                        .map(|(k, w)| w * nodes[first + k].iter().map(|(_, width)| width).sum::<f64>())
                        .sum::<f64>()
                        / solid;
                    let mut put = vec![0.0; m];
                    // All light that the nodes of the cell send out, in any direction.
                    let mut sum = 0.0;
                    for &(node, from, to) in &sources[i] {
                        let lobes = &nodes[node];
                        let amount = (to - from) * grid.hat(node);
                        sum += amount * lobes.iter().map(|(_, width)| width).sum::<f64>();
                        for &(node, width) in lobes {
                            lines.divide(node, from, to, |cell, share| put[cell] += amount * width * share);
                        }
                    }
                    if sum > 0.0 {
                        for (o, flux) in put.iter().enumerate() {
                            row[o] += flux * total / (sum * weight[o]);
                        }
                    }
                },
            );
        }
    }
}
