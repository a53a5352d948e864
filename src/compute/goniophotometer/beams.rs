//! Systems that turn one direction into a few sharp beams: means over the incident cells, flux into emergent cells.
//!
//! An incident cell is cut into n × n parts of equal projected solid angle. The beams of each part's middle are found
//! once; where the rest of the part goes follows from how the beams turn with the incident direction, so that flux is
//! laid into the emergent cells at the fineness of those and not of the parts. The flux of every part is kept exactly.

use super::cells::CellFinder;
use super::{Measured, Seen, Setting, Side, Specimen};
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::dielectric::Effort;
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A sharp beam that a direction becomes. All systems here are endless along x, which keeps the x of the name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    /// Share of the incident flux.
    pub share: f64,
    /// Transmitted, or thrown back.
    pub transmitted: bool,
    /// The name's direction cosine along y.
    pub y: f64,
    /// Change of `y` with the incident name's direction cosines x and y.
    pub change: [f64; 2],
}

/// All that light of one direction becomes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Shares {
    /// The beams.
    pub beams: Vec<Beam>,
    /// Share that is absorbed, what was given up included.
    pub absorbed: f64,
    /// Share that was given up, as an error.
    pub lost: f64,
}

/// A system made of sharp beams, endless along x and the same from left and right.
pub trait Beams: Sync {
    /// The beams of light of the given name from a side, into `out`, which is to be emptied first. `effort` is for
    /// systems that follow very many beams.
    fn beams(&self, name: Dir<Facade>, side: Side, effort: Effort, out: &mut Shares);

    /// Fewest parts along either side of an incident cell.
    fn fewest_parts(&self) -> usize {
        8
    }
}

/// Most parts along either side of an incident cell.
const MOST_PARTS: usize = 64;
/// Incident cells that reach beyond this polar angle begin with twice as many parts along either side. \[rad\]
const STEEPEST: f64 = 1.45;
/// Places along either side of a square of the size of an emergent cell that a strong beam is laid to.
const PLACES: f64 = 96.0;
/// Most places along either side of a part.
const MOST_PLACES: usize = 24;
/// Share from which a beam is laid to all of the places of its part; weaker ones to fewer in proportion.
const STRONG: f64 = 0.2;

/// A specimen of sharp beams.
#[derive(Debug, Clone)]
pub struct SharpBeams<B>(pub B);

impl<B: Beams> Specimen for SharpBeams<B> {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        measure(&self.0, setting, progress)
    }
}

/// The four functions of a system of sharp beams.
///
/// # Errors
/// [`Cancelled`] when `progress` says so.
pub fn measure(system: &impl Beams, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
    let bench = Bench::new(system, setting);
    let n = setting.incident.len();
    let sideways = |phi: f64| PI - phi;
    let mirrored = mirror_images(setting.incident, sideways);
    let emergent = mirror_images(setting.emergent, sideways);
    // Left and right are alike: half of the cells are mirror images of the others.
    let own = |i: usize| mirrored.as_ref().zip(emergent.as_ref()).is_none_or(|(map, _)| map[i] >= i);
    let jobs: Vec<(Side, usize)> =
        Side::BOTH.into_iter().flat_map(|side| (0..n).filter(|&i| own(i)).map(move |i| (side, i))).collect();
    let done = AtomicUsize::new(0);
    let rows: Vec<Option<Row>> = jobs
        .par_iter()
        .map(|&(side, index)| {
            if progress.cancelled() {
                return None;
            }
            let row = bench.row(side, index);
            progress.advance("goniophotometer", done.fetch_add(1, Ordering::Relaxed) + 1, jobs.len());
            Some(row)
        })
        .collect();
    let mut measured = Measured::dark(setting);
    let m = setting.emergent.len();
    for (&(side, index), row) in jobs.iter().zip(rows) {
        let row = row.ok_or(Cancelled)?;
        let seen = measured.seen_mut(side);
        if let (Some(mirrored), Some(emergent)) = (&mirrored, &emergent)
            && mirrored[index] != index
        {
            let image = mirrored[index];
            for (o, &turned) in emergent.iter().enumerate() {
                seen.transmitted[image * m + turned] = row.transmitted[o];
                seen.reflected[image * m + turned] = row.reflected[o];
            }
            (seen.absorbed[image], seen.error[image]) = (row.absorbed, row.error);
        }
        row.store(seen, index);
    }
    Ok(measured)
}

/// Which cell is the mirror image of which, `turned` giving a direction's azimuth after the exchange of left and right
/// or of up and down; `None` where the cells do not mirror.
pub(super) fn mirror_images(basis: &RingBasis, turned: impl Fn(f64) -> f64) -> Option<Vec<usize>> {
    let image = |cell: Cell| {
        let other = basis.index(Dir::from_theta_phi(cell.theta(), turned(cell.phi)))?;
        let found = basis.cell(other);
        let turn = (found.phi - turned(cell.phi)).rem_euclid(2.0 * PI);
        let same = cell.width > 1.99 * PI || turn.min(2.0 * PI - turn) < 1e-9;
        (same && found.theta_min == cell.theta_min && found.width == cell.width).then_some(other)
    };
    basis.cells().map(image).collect()
}

/// What one incident cell becomes.
struct Row {
    transmitted: Vec<f64>,
    reflected: Vec<f64>,
    absorbed: f64,
    lost: f64,
    error: f64,
    /// τ and ρ of the four quarters of the parts, each of which lies all over the cell.
    quarters: [[f64; 2]; 4],
}

impl Row {
    fn new(m: usize) -> Self {
        Self {
            transmitted: vec![0.0; m],
            reflected: vec![0.0; m],
            absorbed: 0.0,
            lost: 0.0,
            error: 0.0,
            quarters: [[0.0; 2]; 4],
        }
    }

    /// Standard error of τ or ρ, the larger one, as if the quarters were drawn independently. They lie
    /// evenly among each other, so that the error is some four times smaller as a rule. Of 290 totals of
    /// a prism one was farther from a run of twenty times the effort than stated (0.0023 where 0.0019 was).
    fn doubt(&self) -> f64 {
        let one = |k: usize| {
            let mean = 0.25 * self.quarters.iter().map(|quarter| quarter[k]).sum::<f64>();
            (self.quarters.iter().map(|quarter| (quarter[k] - mean).powi(2)).sum::<f64>() / 12.0).sqrt()
        };
        // Every quarter holds its part of the flux alone.
        4.0 * one(0).max(one(1))
    }

    fn store(self, seen: &mut Seen, index: usize) {
        let m = self.transmitted.len();
        seen.transmitted[index * m..(index + 1) * m].copy_from_slice(&self.transmitted);
        seen.reflected[index * m..(index + 1) * m].copy_from_slice(&self.reflected);
        seen.absorbed[index] = self.absorbed;
        seen.error[index] = self.error;
    }
}

/// What all cells share.
struct Bench<'a, B> {
    system: &'a B,
    setting: &'a Setting<'a>,
    finder: CellFinder,
    weights: Vec<f64>,
    /// Typical width of an emergent cell as a direction cosine.
    fineness: f64,
    /// The incident cells are the emergent ones.
    same: bool,
    /// The mirror image of every cell, up and down exchanged, where the cells have them and `same` holds.
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

    /// Parts are doubled until the shares of the cell stand.
    fn row(&self, side: Side, index: usize) -> Row {
        let cell = self.setting.incident.cell(index);
        let mut parts = self.system.fewest_parts();
        if cell.theta_max > STEEPEST {
            // Everything falls off towards the horizon.
            parts *= 2;
        }
        loop {
            let mut row = self.with_parts(side, index, parts.min(MOST_PARTS));
            let doubt = row.doubt();
            row.error = doubt + row.lost;
            if doubt <= self.setting.error || parts >= MOST_PARTS {
                for (q, weight) in row.transmitted.iter_mut().zip(&self.weights) {
                    *q /= weight;
                }
                for (q, weight) in row.reflected.iter_mut().zip(&self.weights) {
                    *q /= weight;
                }
                return row;
            }
            parts *= 2;
        }
    }

    /// Flux into the emergent cells from n × n parts of a cell.
    fn with_parts(&self, side: Side, index: usize, n: usize) -> Row {
        let cell = self.setting.incident.cell(index);
        let mut row = Row::new(self.weights.len());
        let mut shares = Shares::default();
        let flux = 1.0 / (n * n) as f64;
        let size = (cell.projected_solid_angle() * flux).sqrt();
        let points = ((PLACES * size / self.fineness).ceil() as usize).clamp(1, MOST_PLACES);
        let places = points * points;
        // A step that visits all places in an order that spreads over the part.
        let golden = (0.618 * places as f64) as usize;
        let step = (golden.max(1)..).find(|&step| coprime(step, places)).unwrap_or(1);
        let places_of = Places::new(&cell, n * points);
        let spread = ((0.618 * n as f64) as usize..).find(|&k| coprime(k, n)).unwrap_or(1);
        for part in 0..n * n {
            let corner = [part / n, part % n];
            let at = |row: f64, column: f64| {
                point(&cell, (corner[0] as f64 + row) / n as f64, (corner[1] as f64 + column) / n as f64)
            };
            // Not the middle: all parts of a row at different θ, all parts of a column at different φ, so that what
            // depends on one of the two is seen at n² of its values.
            let turn = |k: usize| ((k * spread % n) as f64 + 0.5) / n as f64;
            let name = at(turn(part % n), turn(part / n));
            let (x, y) = (name.vector().x, name.vector().y);
            let seed = seed(self.setting.seed, side, index, n, part);
            // Fluxes below this are drawn at random, without bias; over the parts of a cell that averages out.
            let share = (0.4 * self.setting.error).clamp(1e-6, 1e-2);
            self.system.beams(name, side, Effort { share, seed }, &mut shares);
            let quarter = &mut row.quarters[2 * (corner[0] % 2) + corner[1] % 2];
            for beam in &shares.beams {
                quarter[usize::from(!beam.transmitted)] += beam.share * flux;
            }
            row.absorbed += shares.absorbed * flux;
            row.lost += shares.lost * flux;
            for (number, beam) in shares.beams.iter().enumerate() {
                let to = if beam.transmitted { &mut row.transmitted } else { &mut row.reflected };
                if self.same && beam.y == y {
                    // Light that keeps its name keeps its cell.
                    to[index] += beam.share * flux;
                    continue;
                }
                if let Some(below) = &self.below
                    && beam.y == -y
                    && beam.change == [0.0, -1.0]
                {
                    to[below[index]] += beam.share * flux;
                    continue;
                }
                let count = ((places as f64 * (beam.share / STRONG).min(1.0)).ceil() as usize).max(1);
                let each = beam.share * flux / count as f64;
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
        row
    }

    /// Where light goes that comes from a little beside the middle of its part.
    fn target(&self, [x, y]: [f64; 2], [dx, dy]: [f64; 2], beam: &Beam) -> Option<usize> {
        let x = x + dx;
        // The slope holds near the middle only: no farther than light can go.
        let most = (1.0 - x * x).max(0.0).sqrt();
        let turned = beam.change[0] * dx + beam.change[1] * dy;
        let turned = if beam.y == y && beam.change == [0.0, 1.0] { dy } else { turned.clamp(-0.3, 0.3) };
        self.finder.find(x, (beam.y + turned).clamp(-most, most))
    }
}

/// The middles of m × m parts of a cell.
struct Places {
    /// sinθ of the rows.
    radii: Vec<f64>,
    /// Cosine and sine of φ of the columns.
    turns: Vec<[f64; 2]>,
}

impl Places {
    fn new(cell: &Cell, m: usize) -> Self {
        let middle = |k: usize| (k as f64 + 0.5) / m as f64;
        let (low, high) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
        let turn = |k: usize| {
            let (sin, cos) = (cell.phi + cell.width * (middle(k) - 0.5)).sin_cos();
            [cos, sin]
        };
        Self {
            radii: (0..m).map(|k| (low + (high - low) * middle(k)).sqrt()).collect(),
            turns: (0..m).map(turn).collect(),
        }
    }

    /// Direction cosines (x, y).
    fn at(&self, [row, column]: [usize; 2]) -> [f64; 2] {
        self.turns[column].map(|turn| self.radii[row] * turn)
    }
}

/// A direction of a cell: both coordinates 0 … 1, rising in sin²θ and in φ.
fn point(cell: &Cell, row: f64, column: f64) -> Dir<Facade> {
    let (low, high) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
    let sin2 = low + (high - low) * row;
    Dir::from_theta_phi(sin2.sqrt().asin(), cell.phi + cell.width * (column - 0.5))
}

/// No common divisor but 1.
fn coprime(a: usize, b: usize) -> bool {
    let (mut a, mut b) = (a, b);
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a == 1
}

/// A seed for every part, whatever thread works on it.
fn seed(base: u64, side: Side, cell: usize, parts: usize, part: usize) -> u64 {
    let side = u64::from(side == Side::Back);
    let mut mixed = base;
    for word in [side, cell as u64, parts as u64, part as u64] {
        mixed = (mixed ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29);
    }
    mixed
}
