//! Systems that do not scatter, but divide light of one direction into sharp beams: patch-averaged BSDF data from their
//! beams, averaged over incident cells and distributed over emergent cells.
//!
//! An incident cell is divided into parts of equal projected solid angle. The beams of one direction of each part are
//! computed; those of the rest of the part follow from the change of the beams with the incident direction, so that
//! flux is distributed at the resolution of the emergent cells and not of the parts. The flux of every part is kept
//! exactly. The directions are a scrambled net: every power of two of them has one direction in every part. Their
//! number is doubled, earlier results being reused, until the totals are within the allowed error.

use super::cells::CellFinder;
use super::merged::{merged, without_faint};
use super::{Beam, Measured, OneSide, OpticalModel, ScatteredLight, Setting, Side, Structure};
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::sequence::{mixed, net};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Sharp beam that leaves a system. All systems here are endless along x, so that the direction of undeviated light of
/// a beam has the same x as that of the incident light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SharpBeam {
    /// Share of the incident flux that the beam carries.
    pub share: f64,
    /// Whether the beam is transmitted; otherwise it is reflected.
    pub transmitted: bool,
    /// Direction cosine along y of the beam's direction of undeviated light (façade frame).
    pub y: f64,
    /// Derivatives of `y` with respect to the direction cosines x and y of the incident direction of undeviated light.
    pub change: [f64; 2],
}

/// Beams that light of one incident direction becomes, with its absorbed share and the share that was not traced to the
/// end.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shares {
    /// Beams that leave the system.
    pub beams: Vec<SharpBeam>,
    /// Share of the incident flux that is absorbed, including `lost`.
    pub absorbed: f64,
    /// Share of the incident flux that was not traced to the end; it counts as an error.
    pub lost: f64,
    /// Number of surfaces that the light was traced to, a measure of the cost; 0 for closed forms.
    pub surfaces: u32,
}

/// Effort with which light is traced from surface to surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Beams with less than this share of the incident flux are no longer divided: one part, chosen at random in
    /// proportion to its flux, represents all parts.
    pub share: f64,
    /// Seed of the random choice of parts.
    pub seed: u64,
    /// Number of surfaces, counted over all beams together, up to which `share` applies. Beyond it the share grows with
    /// the number of surfaces, and after ten times as many one of the remaining beams, chosen at random in proportion
    /// to its flux, represents all of them. This bounds the work for one direction without bias.
    pub surfaces: u32,
}

impl Effort {
    /// Number of surfaces ([`Self::surfaces`]) that suffices for common sections. Chosen: cost; beyond it light is
    /// divided less, without bias, so that results change within their stated error.
    pub const SURFACES: u32 = 1000;

    /// Returns the minimum share of the incident flux that a beam must have to be divided after `surfaces` surfaces.
    pub fn share_after(&self, surfaces: u32) -> f64 {
        if surfaces > self.surfaces {
            self.share * f64::from(surfaces) / f64::from(self.surfaces.max(1))
        } else {
            self.share
        }
    }
}

/// System that does not scatter, but divides light into sharp beams; endless along x and symmetric left to right.
pub trait Beams: Send + Sync {
    /// Computes the beams that parallel light from `side` becomes and stores them in `out`, which is emptied first.
    /// `direction` is the direction of undeviated light (façade frame, z > 0; see [`super`]); `effort` matters for
    /// systems that trace very many beams.
    fn beams(&self, direction: Dir<Facade>, side: Side, effort: Effort, out: &mut Shares);

    /// Whether the beams of a direction are computed in microseconds; `false` where light is traced from surface to
    /// surface.
    fn is_quick(&self) -> bool {
        true
    }

    /// Returns half of the minimum number of parts along either side of an incident cell; a power of two.
    fn fewest_parts(&self) -> usize {
        8
    }
}

/// Maximum number of directions of an incident cell, as a power of two. Chosen: cost; a cell that reaches 2²⁰ ≈ 10⁶
/// directions states the error that remains.
const MOST_DOUBLINGS: u32 = 20;
/// Number of groups of directions from which the error is estimated; a power of two. Chosen: cost; eight give the
/// standard error to 1/√(2·7) ≈ 27 %.
const GROUPS: usize = 8;
/// Factor from the standard error to the stated error: 98 % of the true errors are smaller, by Student's distribution
/// with the seven degrees of freedom of [`GROUPS`] (99.7 % by the normal distribution).
const SURE: f64 = 3.0;
/// Share of the allowed error at which no more directions are added. Below 1 because directions stop where the estimate
/// happens to be small, while the largest error among hundreds of cells is to be within the allowed one. Chosen; held
/// by `tests/compute/goniophotometer_glass.rs::stated_errors_hold`.
const AIM: f64 = 0.5;
/// Maximum number of surfaces for one incident cell at an allowed error of 0.01 and above; beyond it the cell gets no
/// more directions. Chosen: cost; such a cell states the error that remains.
const MOST_SURFACES: f64 = 3e5;
/// Number of directions from which the mean number of surfaces that a ray meets is found. Chosen: cost; the mean
/// decides how far light is divided, which is without bias.
const PILOTS: u32 = 32;
/// Factor of the minimum share of the incident flux that a beam must have to be divided. That share is proportional to
/// the root of the allowed error and to the square of the mean number of surfaces that a ray meets: where they are
/// many, following more directions reduces the error more than dividing the light of each. Chosen by trial: cost;
/// results change within their stated error, held by
/// `tests/compute/goniophotometer_glass.rs::less_effort_means_more_noise_but_no_bias`.
const DIVIDED: f64 = 5.5e-3;
/// Number of points along either side of a square of the size of an emergent cell over which a strong beam is
/// distributed, so that a beam is split at the edge of a cell to 1 % of the cell's width. Chosen; held by
/// `tests/compute/goniophotometer_glass.rs::cases_of_the_reference_kit`, at most 3 % of the light in other cells.
const PLACES: f64 = 96.0;
/// Maximum number of points along either side of a part of an incident cell. Chosen: cost; enough for [`PLACES`] on
/// emergent cells four times as fine as the incident ones, which have at least 16 parts along a side (24 = 4 · 96/16).
const MOST_PLACES: usize = 24;
/// Share of the incident flux from which a beam is distributed over all points of its part; weaker beams over fewer in
/// proportion, so that no point carries more flux. Chosen: cost; held by the same test as [`PLACES`].
const STRONG: f64 = 0.2;
/// Effort for a single direction: finds the shares of strong beams to 1e-4 in a few milliseconds. Chosen; held to 2e-4
/// by `tests/compute/beams.rs::prisms_keep_all_light_in_beams_that_a_closer_look_confirms`.
const FINE: Effort = Effort { share: 1e-5, seed: 1, surfaces: 10_000 };
/// Effort where neighbouring directions share a result, e.g. for the parts of the sun's disc: finds the shares of
/// strong beams to 1e-3. Chosen: cost; ten times the share of [`FINE`], a fifth of its surfaces.
const COARSE: Effort = Effort { share: 1e-4, seed: 1, surfaces: 2000 };
/// Share of the incident flux that may be dropped from the beams of a single direction, for [`FINE`] and [`COARSE`]: a
/// tenth of their share, below which single beams are random.
const FAINT: [f64; 2] = [1e-6, 1e-5];

/// Optical model of a system that does not scatter, but divides light into sharp beams.
#[derive(Debug, Clone)]
pub struct SharpBeams<B>(pub B);

impl<B: Beams> OpticalModel for SharpBeams<B> {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        Ok(measure(&self.0, setting, progress)?.made_reciprocal())
    }

    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam> {
        beams_of(&self.0, direction, side, FINE, FAINT[0])
    }

    fn beams_about(&self, direction: Dir<Facade>, side: Side, _: f64) -> Vec<Beam> {
        beams_of(&self.0, direction, side, COARSE, FAINT[1])
    }

    fn structure(&self) -> Structure {
        Structure::Along { upright: false }
    }

    fn is_quick(&self) -> bool {
        self.0.is_quick()
    }

    /// Returns no scattered light, since all light stays in beams.
    fn scattered(&self, _: Dir<Facade>, _: Side, _: &RingBasis) -> ScatteredLight {
        ScatteredLight::default()
    }
}

fn beams_of(system: &impl Beams, direction: Dir<Facade>, side: Side, effort: Effort, faint: f64) -> Vec<Beam> {
    let mut shares = Shares::default();
    system.beams(direction, side, effort, &mut shares);
    let v = direction.vector();
    let beams = shares.beams.iter().map(|beam| {
        let z2 = (1.0 - v.x * v.x - beam.y * beam.y).max(0.0);
        let to = if beam.y == v.y { direction } else { Dir::from_unit(DVec3::new(v.x, beam.y, z2.sqrt())) };
        Beam { directions: [to, to], share: beam.share, transmitted: beam.transmitted }
    });
    without_faint(merged(beams), faint)
}

/// Computes transmission and reflection of both sides of a system that divides light into sharp beams, as
/// patch-averaged data.
///
/// # Errors
/// Returns [`Cancelled`] if `progress` is cancelled.
pub fn measure(system: &impl Beams, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
    let bench = Bench::new(system, setting);
    let sideways = |phi: f64| PI - phi;
    let mirrored = mirror_images(setting.incident, sideways);
    let emergent = mirror_images(setting.emergent, sideways);
    // Left and right are alike: half of the cells are mirror images of the others.
    let images = mirrored.zip(emergent);
    let own = |i: usize| images.as_ref().is_none_or(|(mirrored, _)| mirrored[i] >= i);
    let mut measured = Measured::dark(setting);
    let m = setting.emergent.len();
    let Measured { front, back, .. } = &mut measured;
    let rows: Vec<Row<'_>> = [(Side::Front, front), (Side::Back, back)]
        .into_iter()
        .flat_map(|(side, seen)| Row::all(side, seen, m))
        .filter(|row| own(row.index))
        .collect();
    let (done, all) = (AtomicUsize::new(0), rows.len());
    rows.into_par_iter().try_for_each(|mut row| {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        bench.fill(&mut row);
        progress.advance("goniophotometer", done.fetch_add(1, Ordering::Relaxed) + 1, all);
        Ok(())
    })?;
    let Some((mirrored, emergent)) = images else { return Ok(measured) };
    for seen in [&mut measured.front, &mut measured.back] {
        for (i, &image) in mirrored.iter().enumerate().filter(|&(i, &image)| image > i) {
            for values in [&mut seen.transmitted, &mut seen.reflected] {
                for (o, &turned) in emergent.iter().enumerate() {
                    values[image * m + turned] = values[i * m + o];
                }
            }
            (seen.absorbed[image], seen.error[image]) = (seen.absorbed[i], seen.error[i]);
        }
    }
    Ok(measured)
}

/// Returns the index of the symmetric counterpart of every cell of a basis; `None` if the cells are not symmetric.
/// `turned` maps an azimuth \[rad\] to that of the counterpart, e.g. with left and right exchanged.
pub fn mirror_images(basis: &RingBasis, turned: impl Fn(f64) -> f64) -> Option<Vec<usize>> {
    let image = |cell: Cell| {
        let other = basis.index(Dir::from_theta_phi(cell.theta(), turned(cell.phi)))?;
        let found = basis.cell(other);
        let turn = (found.phi - turned(cell.phi)).rem_euclid(2.0 * PI);
        let same = cell.width > 1.99 * PI || turn.min(2.0 * PI - turn) < 1e-9;
        (same && found.theta_min == cell.theta_min && found.width == cell.width).then_some(other)
    };
    basis.cells().map(image).collect()
}

/// Scattering of one incident cell, in its place among the data of all cells: summed over the directions computed so
/// far, means over the cell after [`Self::finish`].
struct Row<'a> {
    /// Side of the incident light.
    side: Side,
    /// Index of the incident cell.
    index: usize,
    /// Flux into the emergent cells, for directions of unit incident flux; then mean q. \[1/sr\]
    transmitted: &'a mut [f64],
    reflected: &'a mut [f64],
    absorbed: &'a mut f64,
    error: &'a mut f64,
    lost: f64,
    /// τ and ρ of all directions, in the order in which they were computed.
    totals: Vec<[f64; 2]>,
    /// Number of surfaces that the light was traced to.
    surfaces: f64,
}

impl<'a> Row<'a> {
    /// Returns the rows of all incident cells for light from `side`; `m`: number of emergent cells.
    fn all(side: Side, seen: &'a mut OneSide, m: usize) -> impl Iterator<Item = Self> {
        let flux = seen.transmitted.chunks_exact_mut(m).zip(seen.reflected.chunks_exact_mut(m));
        let sums = seen.absorbed.iter_mut().zip(&mut seen.error);
        flux.zip(sums).enumerate().map(move |(index, ((transmitted, reflected), (absorbed, error)))| Self {
            side,
            index,
            transmitted,
            reflected,
            absorbed,
            error,
            lost: 0.0,
            totals: vec![],
            surfaces: 0.0,
        })
    }

    /// Returns the estimated error of τ or of ρ, the larger one: [`SURE`] standard errors, as if the groups of
    /// directions, each of them a net all over the cell, were drawn independently. Together they are distributed more
    /// uniformly still.
    fn uncertainty(&self) -> f64 {
        let groups = GROUPS as f64;
        let size = (self.totals.len() / GROUPS).max(1);
        let one = |k: usize| {
            let mean = |part: &[[f64; 2]]| part.iter().map(|total| total[k]).sum::<f64>() / part.len() as f64;
            let all = mean(&self.totals);
            let squares: f64 = self.totals.chunks_exact(size).map(|group| (mean(group) - all).powi(2)).sum();
            (squares / (groups * (groups - 1.0))).sqrt()
        };
        SURE * one(0).max(one(1))
    }

    /// Converts the sums over directions to means over the cell; `weights`: projected solid angles of the emergent
    /// cells \[sr\].
    fn finish(&mut self, weights: &[f64]) {
        let each = 1.0 / self.totals.len() as f64;
        for values in [&mut self.transmitted, &mut self.reflected] {
            for (q, weight) in values.iter_mut().zip(weights) {
                *q *= each / weight;
            }
        }
        *self.absorbed *= each;
        *self.error = self.uncertainty() + self.lost * each;
    }
}

/// Data for the computation of all incident cells: system, settings and tables of the cells.
struct Bench<'a, B> {
    system: &'a B,
    setting: &'a Setting<'a>,
    finder: CellFinder,
    weights: Vec<f64>,
    /// Typical width of an emergent cell as a direction cosine.
    fineness: f64,
    /// Whether the incident and the emergent cells are the same.
    same: bool,
    /// Index of the mirror image of every cell with up and down exchanged; `None` if the cells are not symmetric or
    /// `same` is `false`.
    below: Option<Vec<usize>>,
}

impl<'a, B: Beams> Bench<'a, B> {
    fn new(system: &'a B, setting: &'a Setting<'a>) -> Self {
        let weights = setting.emergent.projected_solid_angles();
        let fineness = (PI / weights.len().max(1) as f64).sqrt();
        let same = setting.emergent == setting.incident;
        let below = if same { mirror_images(setting.incident, |phi| -phi) } else { None };
        Self { system, setting, finder: CellFinder::new(setting.emergent), weights, fineness, same, below }
    }

    /// Computes the scattering of one incident cell: the number of directions is doubled until the allowed error is
    /// met, or until the light has met too many surfaces.
    fn fill(&self, row: &mut Row<'_>) {
        let fewest = (2 * self.system.fewest_parts()).next_power_of_two().ilog2();
        let most = MOST_SURFACES * (0.01 / self.setting.error).max(1.0).powf(1.5);
        let mut doublings = (2 * fewest).min(MOST_DOUBLINGS);
        let share = self.share(row.side, row.index);
        self.add_net(row, share, 0..1 << doublings);
        while row.uncertainty() > AIM * self.setting.error && doublings < MOST_DOUBLINGS && row.surfaces < most {
            self.add_net(row, share, 1 << doublings..2 << doublings);
            doublings += 1;
        }
        row.finish(&self.weights);
    }

    /// Returns the seed for direction `number` of the incident cell `index`, the same on any thread; number 0 is the
    /// seed of the sequence of directions.
    fn seed(&self, side: Side, index: usize, number: u64) -> u64 {
        mixed(self.setting.seed, [u64::from(side == Side::Back), index as u64, number])
    }

    /// Returns the minimum share of the incident flux that a beam must have to be divided, for light of the incident
    /// cell `index`.
    fn share(&self, side: Side, index: usize) -> f64 {
        let cell = self.setting.incident.cell(index);
        let base = self.seed(side, index, 0);
        let mut shares = Shares::default();
        let mut surfaces = 0.0;
        for number in 0..PILOTS {
            let [row, column] = net(number, base);
            let effort = Effort { share: f64::INFINITY, seed: mixed(base, [u64::from(number)]), surfaces: u32::MAX };
            self.system.beams(point(&cell, row, column), side, effort, &mut shares);
            surfaces += f64::from(shares.surfaces) / f64::from(PILOTS);
        }
        (DIVIDED * self.setting.error.sqrt() * surfaces * surfaces).clamp(1e-6, 1.0)
    }

    /// Adds the scattering of the directions `numbers` of the cell's sequence to `row`; their count is a power of two,
    /// and the first a multiple of it.
    fn add_net(&self, row: &mut Row<'_>, share: f64, numbers: Range<u32>) {
        let (side, index) = (row.side, row.index);
        let doublings = numbers.len().ilog2();
        let cell = self.setting.incident.cell(index);
        let mut shares = Shares::default();
        let parts = [1 << doublings.div_ceil(2), 1 << (doublings / 2)];
        let size = (cell.projected_solid_angle() / f64::from(1_u32 << doublings)).sqrt();
        let points = ((PLACES * size / self.fineness).ceil() as usize).clamp(1, MOST_PLACES);
        let places = points * points;
        // A step that visits all places in an order that spreads over the part.
        let golden = (0.618 * places as f64) as usize;
        let step = (golden.max(1)..).find(|&step| coprime(step, places)).unwrap_or(1);
        let places_of = Places::new(&cell, parts.map(|n| n * points));
        let base = self.seed(side, index, 0);
        for number in numbers {
            let at = net(number, base);
            let corner = [0, 1].map(|k| (at[k] * parts[k] as f64) as usize);
            let direction = point(&cell, at[0], at[1]);
            let (x, y) = (direction.vector().x, direction.vector().y);
            let seed = self.seed(side, index, u64::from(number) + 1);
            self.system.beams(direction, side, Effort { share, seed, surfaces: Effort::SURFACES }, &mut shares);
            let mut total = [0.0; 2];
            for beam in &shares.beams {
                total[usize::from(!beam.transmitted)] += beam.share;
            }
            row.totals.push(total);
            row.surfaces += f64::from(shares.surfaces);
            *row.absorbed += shares.absorbed;
            row.lost += shares.lost;
            for (number, beam) in shares.beams.iter().enumerate() {
                let to = if beam.transmitted { &mut *row.transmitted } else { &mut *row.reflected };
                if self.same && beam.y == y {
                    // Light that keeps its through direction keeps its cell.
                    to[index] += beam.share;
                    continue;
                }
                if let Some(below) = &self.below
                    && beam.y == -y
                    && beam.change == [0.0, -1.0]
                {
                    to[below[index]] += beam.share;
                    continue;
                }
                let count = ((places as f64 * (beam.share / STRONG).min(1.0)).ceil() as usize).max(1);
                let each = beam.share / count as f64;
                let first = (seed as usize % places) + number;
                for k in 0..count {
                    let place = (first + k * step) % places;
                    let [px, py] =
                        places_of.at([corner[0] * points + place / points, corner[1] * points + place % points]);
                    if let Some(cell) = self.target([x, y], [px - x, py - y], beam) {
                        to[cell] += each;
                    }
                }
            }
        }
    }

    /// Returns the emergent cell of a beam for incident light whose direction cosines differ by (`dx`, `dy`) from those
    /// (`x`, `y`) that the beam was computed for.
    fn target(&self, [x, y]: [f64; 2], [dx, dy]: [f64; 2], beam: &SharpBeam) -> Option<usize> {
        let x = x + dx;
        // The slope holds near the middle only: no farther than light can go.
        let most = (1.0 - x * x).max(0.0).sqrt();
        let turned = beam.change[0] * dx + beam.change[1] * dy;
        let turned = if beam.y == y && beam.change == [0.0, 1.0] { dy } else { turned.clamp(-0.3, 0.3) };
        self.finder.find(x, (beam.y + turned).clamp(-most, most))
    }
}

/// Directions at the centres of a regular division of a cell into rows (in sin²θ) and columns (in φ).
struct Places {
    /// sinθ of the rows.
    radii: Vec<f64>,
    /// Cosine and sine of φ of the columns.
    turns: Vec<[f64; 2]>,
}

impl Places {
    fn new(cell: &Cell, [rows, columns]: [usize; 2]) -> Self {
        let middle = |k: usize, m: usize| (k as f64 + 0.5) / m as f64;
        let (low, high) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
        let turn = |k: usize| {
            let (sin, cos) = (cell.phi + cell.width * (middle(k, columns) - 0.5)).sin_cos();
            [cos, sin]
        };
        Self {
            radii: (0..rows).map(|k| (low + (high - low) * middle(k, rows)).sqrt()).collect(),
            turns: (0..columns).map(turn).collect(),
        }
    }

    /// Returns the direction cosines (x, y) of the direction in the given row and column.
    fn at(&self, [row, column]: [usize; 2]) -> [f64; 2] {
        self.turns[column].map(|turn| self.radii[row] * turn)
    }
}

/// Returns the direction of a cell at the coordinates `row` and `column` (0 … 1), which are linear in sin²θ and in φ.
fn point(cell: &Cell, row: f64, column: f64) -> Dir<Facade> {
    let (low, high) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
    let sin2 = low + (high - low) * row;
    Dir::from_theta_phi(sin2.sqrt().asin(), cell.phi + cell.width * (column - 0.5))
}

/// Whether two numbers have no common divisor but 1.
fn coprime(a: usize, b: usize) -> bool {
    let (mut a, mut b) = (a, b);
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a == 1
}
