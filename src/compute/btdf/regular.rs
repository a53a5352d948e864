//! Separation of regular transmission from patch-averaged data and from data at single directions. A pane in such data
//! is a diagonal of patches, and their width blurs the view through it. For undeviated light the direction is known
//! exactly, and only τ(θ) has to be estimated, from means over patches or from values at single directions.
//!
//! Transmission is recognised as regular if it
//! - lies only in the emergent patches of undeviated light, and not in their neighbours, which every lobe with a width
//!   also lights;
//! - depends on the angle of incidence only, which holds for panes, perforated sheets and fabrics.
//!
//! τ(θ) is the smoothest function of cosθ with the means of the data (Gaussian process with a Matérn covariance of
//! order 5/2; Rasmussen & Williams 2006, ch. 2 and 4), with τ(90°) = 0 unless the data contradict it.

use super::{AngularTransmittance, Btdf, CellMatrix, Indicatrices, Scattered};
use crate::compute::basis::{Cell, Neighbours, RingBasis, sub_directions};
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::quadrature::gauss_legendre;
use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// Largest share of the regular flux in the neighbouring patches: a lobe of 1° in a patch of 10° leaves 15 % there.
/// Chosen between that and 0, which panes leave; held by `tests/scenes/sky_in_cells.rs`, where panes are recognised and
/// foils with lobes are not.
const LEAK: f64 = 0.02;
/// Smallest ratio of the regular flux to the scattered flux in the same patches. Chosen: below it most of the light in
/// the patches is scattered and its level decides the result. No test of its own.
const STANDS_OUT: f64 = 0.5;
/// Smallest share of the transmitted flux that is separated. Chosen: separating less would move at most 0.1 % of the
/// light.
const LEAST: f64 = 1e-3;
/// Largest difference of τ at the same angle of incidence, as a share of the largest τ; [`ROUGH`] allows more. Chosen:
/// above the digits of files ([`DIGITS`]) and the noise of computed panes, far below the differences of slats between
/// azimuths. No test of its own.
const EVEN: f64 = 0.01;
/// Additional difference of τ at the same angle of incidence, as a share of the scattered flux in the same patches,
/// which is known to this accuracy. Chosen: the level in the patches is the median of their neighbours'. No test of its
/// own.
const ROUGH: f64 = 0.3;
/// Inverse of the step to which equal angles of incidence are rounded. \[1/rad\] The step is 0.1°, far below the
/// distance between rings of patches.
const SAME_ANGLE: f64 = 1800.0 / PI;
/// Minimum number of angles of incidence, and minimum of the largest of them. \[rad\] Chosen: the coarsest basis, Klems
/// Quarter, has five rings, the last one at 78°; τ of panes falls beyond 60°.
const KNOWN: (usize, f64) = (4, 65.0 * PI / 180.0);
/// Number of directions along each side of an incident patch in the search for the emergent patches of undeviated
/// light. Chosen: misses overlaps of less than an eighth of a side.
const NAMES: usize = 8;
/// Distance in θ within which undeviated light of a single direction may be stored in a neighbouring patch. \[rad\]
/// Chosen: a few of the steps of 0.1° to which angles in files are rounded. No test of its own.
const BESIDE: f64 = 0.3 * PI / 180.0;
/// Share of a patch's width in φ within which undeviated light of a single direction may be stored beside it, if a row
/// was rotated about the normal: a whole patch, except for a margin for rounding.
const TURNED: f64 = 0.999;
/// Number of Gauss points for the mean over a patch: exact for polynomials of degree 15 in sin²θ.
const ACROSS: usize = 8;
/// Length of the covariance over cosθ: the whole range 0 … 1. Chosen; held by
/// `tests/scenes/sky_in_cells.rs::a_pane_in_data_is_a_pane`, which compares with exact panes.
const LENGTH: f64 = 1.0;
/// Relative accuracy of the digits in files. Rounding to four digits has a root mean square of 1.3e-4.
const DIGITS: f64 = 1e-4;
/// Number of standard errors of the extrapolated τ(90°) within which τ(90°) = 0 is assumed: computed for one to three
/// panes on Klems, half, quarter and Tregenza patches it is at most 3.6, for an opening at least 11.
const NO_SURPRISE: f64 = 4.0;
/// Standard error of τ(90°) = 0, relative to the largest τ. The value is exact by Fresnel's equations. Chosen: below
/// the accuracy of measured transmittances. No test of its own.
const AT_GRAZING: f64 = 1e-3;
/// Stated uncertainty in standard errors: computed errors of panes are up to three standard errors at single angles.
/// Held by `tests/scenes/sky_in_cells.rs::a_pane_in_data_is_a_pane`.
const STATED: f64 = 3.5;
/// Range of angles over which the largest uncertainty is used. \[°\] Chosen: with both sides it spans more than a Klems
/// ring (10°), so that a known angle does not hide the uncertainty beside it. No test of its own.
const WITHIN: usize = 8;
/// Smallest eigenvalue of the posterior covariance that is used, relative to the largest: 1e-2 of the deviation.
/// Chosen: cost; results change within their stated error.
const FAINT: f64 = 1e-4;

/// Incident patch or incident direction of the data, for the separation of regular transmission.
struct Row {
    /// Angle to the normal, by which rows are grouped. \[rad\]
    theta: f64,
    /// Cosines of incidence with weights that sum to 1.
    points: Vec<(f64, f64)>,
    /// Indices of the emergent cells that undeviated light from the row's incident directions reaches.
    names: Vec<usize>,
    /// Share of the projected hemisphere that the row represents.
    share: f64,
}

/// Regular transmittance at one angle of incidence, from all rows of this angle.
#[derive(Clone)]
struct Known {
    theta: f64,
    points: Vec<(f64, f64)>,
    tau: f64,
    /// Standard error of `tau`.
    noise: f64,
}

/// Returns the function with its regular transmission separated from the scattered light; `None` if none is recognised
/// in the data.
pub fn separate_regular(btdf: &Btdf) -> Option<Btdf> {
    if btdf.regular.is_some() {
        return None;
    }
    match btdf.scattered.as_ref()? {
        Scattered::Cells(matrix) => {
            let (incident, emergent) = (matrix.incident(), matrix.emergent());
            let rows: Vec<Row> = incident.cells().map(|cell| Row::of_cell(&cell, emergent)).collect();
            let (tau, rest) = separate_rows(&rows, emergent, |i| matrix.row(i).into_owned())?;
            let rest = rest.map(|rest| CellMatrix::new(incident.clone(), emergent.clone(), rest));
            Some(Btdf { regular: Some(tau), scattered: rest.flatten().map(|rest| Scattered::Cells(Box::new(rest))) })
        }
        Scattered::Directions(data) => {
            let of = |(d, share): (&Incident, &f64)| Row::of_direction(d.0, *share, data);
            let rows: Vec<Row> = data.incident().iter().zip(data.shares()).map(of).collect();
            let (tau, rest) = separate_rows(&rows, data.emergent(), |i| data.row(i).into_owned())?;
            let rest = rest.map(|rest| Indicatrices::new(data.incident().to_vec(), data.emergent().clone(), rest));
            let scattered = rest.flatten().map(|rest| Scattered::Directions(Arc::new(rest)));
            Some(Btdf { regular: Some(tau), scattered })
        }
        Scattered::Lambert(_) | Scattered::Tree(_) => None,
    }
}

fn held(emergent: &RingBasis, names: impl Iterator<Item = Dir<Facade>>) -> Vec<usize> {
    let mut cells: Vec<usize> = names.filter_map(|name| emergent.index(name)).collect();
    cells.sort_unstable();
    cells.dedup();
    cells
}

impl Row {
    fn of_cell(cell: &Cell, emergent: &RingBasis) -> Self {
        let [low, high] = [cell.theta_min, cell.theta_max].map(|theta| theta.sin().powi(2));
        let points = gauss_legendre(ACROSS).into_iter().map(|(at, w)| ((1.0 - low - (high - low) * at).sqrt(), w));
        Self {
            theta: cell.theta(),
            points: points.collect(),
            names: held(emergent, sub_directions(cell, NAMES)),
            share: cell.projected_solid_angle() / PI,
        }
    }

    fn of_direction(d: Dir<Facade>, share: f64, data: &Indicatrices) -> Self {
        let v = d.vector();
        let own = data.emergent().index(d).map_or(0.0, |cell| data.emergent().cell(cell).width);
        let turns = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|part| TURNED * part * own);
        let about = [-BESIDE, 0.0, BESIDE].into_iter().flat_map(|by| {
            turns.map(|turn| Dir::from_theta_phi((d.theta() + by).clamp(0.0, FRAC_PI_2), d.phi() + turn))
        });
        Self { theta: d.theta(), points: vec![(v.z, 1.0)], names: held(data.emergent(), about), share }
    }
}

/// Returns the regular transmittance and the remaining scattered light (q by row and emergent cell, or `None` if none
/// remains); `None` if no regular transmission is recognised.
fn separate_rows(
    rows: &[Row],
    emergent: &RingBasis,
    row: impl Fn(usize) -> Vec<f64>,
) -> Option<(AngularTransmittance, Option<Vec<f64>>)> {
    let weight = emergent.projected_solid_angles();
    let near = Neighbours::new(emergent);
    let flux = |q: &[f64], cells: &[usize]| cells.iter().map(|&cell| q[cell] * weight[cell]).sum::<f64>();
    let mut rest = Vec::with_capacity(rows.len() * weight.len());
    let (mut all, mut straight, mut even, mut leaked) = (0.0, 0.0, 0.0, 0.0);
    // Undeviated flux of every row, and the background flux in the same cells.
    let mut found: Vec<[f64; 2]> = Vec::with_capacity(rows.len());
    for (index, own) in rows.iter().enumerate() {
        let mut q = row(index);
        let level = near.level(&q, &own.names, &[]);
        let wide: f64 = own.names.iter().map(|&cell| weight[cell]).sum();
        let inside = flux(&q, &own.names);
        let background = (level * wide).min(inside);
        let about = near.about(&own.names, &[]);
        let outer = near.level(&q, &about, &own.names);
        // A lobe wider than the cells leaks to all sides: twice the sum over the lesser half of the neighbours.
        let mut leaks: Vec<f64> = about.iter().map(|&cell| (q[cell] - outer).max(0.0) * weight[cell]).collect();
        leaks.sort_unstable_by(f64::total_cmp);
        leaked += own.share * 2.0 * leaks[..leaks.len() / 2].iter().sum::<f64>();
        all += own.share * q.iter().zip(&weight).map(|(q, w)| q * w).sum::<f64>();
        straight += own.share * (inside - background);
        even += own.share * background;
        found.push([inside - background, background]);
        own.names.iter().for_each(|&cell| q[cell] = q[cell].min(level));
        rest.extend(q);
    }
    if straight <= LEAST * all || straight < STANDS_OUT * even || leaked > LEAK * straight {
        return None;
    }
    let tau = transmittance(&by_angle(rows, &found)?)?;
    let scattered = all - straight > 1e-6 * all;
    Some((tau, scattered.then_some(rest)))
}

/// Returns the regular transmittance at every angle of incidence; `None` if rows of the same angle contradict each
/// other, or if there are too few angles.
fn by_angle(rows: &[Row], found: &[[f64; 2]]) -> Option<Vec<Known>> {
    let key = |row: &Row| (row.theta * SAME_ANGLE).round() as i64;
    let mut groups = BTreeMap::<i64, Vec<usize>>::new();
    (0..rows.len()).for_each(|row| groups.entry(key(&rows[row])).or_default().push(row));
    let strongest = found.iter().map(|[tau, _]| *tau).fold(0.0, f64::max);
    let known: Option<Vec<Known>> = groups
        .into_values()
        .map(|list| {
            let mean = |of: usize| list.iter().map(|&row| found[row][of]).sum::<f64>() / list.len() as f64;
            let (tau, background) = (mean(0), mean(1));
            let deviation = list.iter().map(|&row| (found[row][0] - tau).abs()).fold(0.0, f64::max);
            let noise = (DIGITS * strongest).hypot(ROUGH * background).hypot(deviation);
            let row = &rows[list[0]];
            let agree = deviation <= EVEN * strongest + ROUGH * background;
            agree.then(|| Known { theta: row.theta, points: row.points.clone(), tau, noise })
        })
        .collect();
    let reach = |known: &Vec<Known>| known.iter().map(|one| one.theta).fold(0.0, f64::max) >= KNOWN.1;
    known.filter(|known| known.len() >= KNOWN.0 && reach(known))
}

/// Smooth function of cosθ fitted to the known transmittances (Gaussian process).
struct Smooth<'a> {
    known: &'a [Known],
    factor: Llt<f64>,
    solved: Mat<f64>,
    /// Prior variance of the function.
    variance: f64,
    /// Squared deviation of each known value from its prediction by all others, relative to the expected one.
    surprise: Vec<f64>,
}

impl Known {
    /// Returns the covariance of this transmittance with that at a cosine of incidence.
    fn covariance_with(&self, cosine: f64) -> f64 {
        self.points.iter().map(|p| p.1 * covariance(p.0, cosine)).sum()
    }
}

/// Returns the prior correlation of the transmittances at two cosines of incidence (Matérn, ν = 5/2).
fn covariance(a: f64, b: f64) -> f64 {
    let r = 5.0_f64.sqrt() * (a - b).abs() / LENGTH;
    (1.0 + r + r * r / 3.0) * (-r).exp()
}

impl<'a> Smooth<'a> {
    fn new(known: &'a [Known]) -> Option<Self> {
        let n = known.len();
        let strongest = known.iter().map(|one| one.tau).fold(0.0, f64::max);
        let between = |a: &Known, b: &Known| -> f64 {
            a.points.iter().flat_map(|p| b.points.iter().map(move |q| p.1 * q.1 * covariance(p.0, q.0))).sum()
        };
        let noise = |i: usize, j: usize| if i == j { (known[i].noise / strongest).powi(2) } else { 0.0 };
        let matrix = Mat::from_fn(n, n, |i, j| between(&known[i], &known[j]) + noise(i, j));
        let factor = matrix.llt(Side::Lower).ok()?;
        let values = Mat::from_fn(n, 1, |i, _| known[i].tau);
        let solved = factor.solve(&values);
        let variance = (0..n).map(|i| values[(i, 0)] * solved[(i, 0)]).sum::<f64>() / n as f64;
        // Leaving one out: its residual is [C⁻¹y]ᵢ/[C⁻¹]ᵢᵢ, its variance 1/[C⁻¹]ᵢᵢ.
        let inverse = factor.solve(&Mat::<f64>::identity(n, n));
        let surprise = (0..n).map(|i| solved[(i, 0)].powi(2) / (inverse[(i, i)] * variance)).collect();
        Some(Self { known, factor, solved, variance, surprise })
    }

    /// Returns the value and its standard error at a cosine of incidence, and the squared ratio of actual to expected
    /// deviations of the data about it.
    fn at(&self, cosine: f64) -> [f64; 3] {
        let n = self.known.len();
        let here = Mat::from_fn(n, 1, |i, _| self.known[i].covariance_with(cosine));
        let weights = self.factor.solve(&here);
        let sum = |of: &dyn Fn(usize) -> f64| (0..n).map(of).sum::<f64>();
        let value = sum(&|i| here[(i, 0)] * self.solved[(i, 0)]);
        let variance = self.variance * (1.0 - sum(&|i| here[(i, 0)] * weights[(i, 0)])).max(0.0);
        // The standard error is too large where the function is smoother than on average, and too small at its kinks.
        let squares = sum(&|i| weights[(i, 0)].powi(2));
        let surprise = sum(&|i| weights[(i, 0)].powi(2) * self.surprise[i]) / squares.max(1e-300);
        [value, variance.sqrt(), surprise]
    }

    /// Returns independent deviations of the transmittances at whole degrees, scaled degree by degree: the eigenvectors
    /// of the posterior covariance.
    fn modes(&self, scale: &[f64]) -> Option<Vec<Vec<f64>>> {
        let (n, count) = (self.known.len(), scale.len());
        let cosine = |degree: usize| (degree as f64).to_radians().cos();
        let here = Mat::from_fn(n, count, |i, degree| self.known[i].covariance_with(cosine(degree)));
        let weights = here.transpose() * self.factor.solve(&here);
        let left =
            Mat::from_fn(count, count, |i, j| self.variance * (covariance(cosine(i), cosine(j)) - weights[(i, j)]));
        let parts = left.self_adjoint_eigen(Side::Lower).ok()?;
        let (sizes, shapes) = (parts.S().column_vector(), parts.U());
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let kept = (0..count).filter(|&k| sizes[k] > FAINT * largest);
        Some(kept.map(|k| (0..count).map(|i| scale[i] * sizes[k].sqrt() * shapes[(i, k)]).collect()).collect())
    }
}

/// Fits the transmittance at whole degrees of incidence, with its uncertainties, to known values; `None` if they cannot
/// be fitted. A value of 0 at 90° is added unless the data contradict it.
fn transmittance(known: &[Known]) -> Option<AngularTransmittance> {
    let strongest = known.iter().map(|one| one.tau).fold(0.0, f64::max);
    let end = Known { theta: FRAC_PI_2, points: vec![(0.0, 1.0)], tau: 0.0, noise: AT_GRAZING * strongest };
    let with_end: Vec<Known> = known.iter().cloned().chain([end]).collect();
    let mut smooth = Smooth::new(known)?;
    let [value, error, _] = smooth.at(0.0);
    if value.abs() <= NO_SURPRISE * error {
        smooth = Smooth::new(&with_end)?;
    }
    let values: Vec<[f64; 3]> = (0..=90).map(|degree| smooth.at(f64::from(degree).to_radians().cos())).collect();
    let tau: Vec<f64> = values.iter().map(|[tau, ..]| tau.clamp(0.0, 1.0)).collect();
    let uncertainty = |degree: usize| {
        let about = &values[degree.saturating_sub(WITHIN)..=(degree + WITHIN).min(90)];
        let stated = about.iter().map(|[_, error, surprise]| error * surprise.sqrt()).fold(0.0, f64::max);
        (STATED * stated).min(tau[degree].max(1.0 - tau[degree]))
    };
    let uncertainty = (0..=90).map(uncertainty).collect();
    let scale: Vec<f64> = values.iter().map(|[.., surprise]| STATED * surprise.sqrt()).collect();
    Some(AngularTransmittance::Estimated { tau, uncertainty, modes: smooth.modes(&scale)? })
}
