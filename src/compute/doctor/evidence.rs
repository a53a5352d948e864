//! Evidence for and against readings of a band's numbers: a few misfits, each 0 in data that agree with physics and
//! experience.
//!
//! All are computed from the same sums over rows and columns of the functions, which are computed once; only
//! reciprocity needs all pairs of directions, and its results are cached.

use super::blocks::{Block, Blocks, Turn};
use super::reading::{Factor, Part, Reading, after, as_it_is};
use crate::compute::btdf::Component;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::rc::Rc;

/// Question by which a reading of the numbers is rated; the answer is a misfit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Question {
    /// Reciprocity: difference between the transmissions of both sides, one of them with the light reversed. 0 for
    /// every system.
    Between,
    /// Difference between the only transmission and its own reverse. 0 for systems that are alike on both sides.
    Alone,
    /// Reciprocity: difference between a reflection and its own reverse. 0 for every system.
    Own,
    /// Asymmetry: difference of the sum of transmittance and reflectance between light from above and from below, and
    /// from right and left.
    Even,
    /// Correlation of how much transmission and reflection prefer light from above to light from below; 0 where they
    /// oppose each other, which is usual.
    Opposed,
    /// Variation of the sum of transmittance and reflectance with the angle of incidence.
    Rest,
    /// Excess of transmittance plus reflectance over 1.
    Won,
    /// Loss of nearly all light: transmittance plus reflectance near 0.
    Lost,
    /// Deviation of panes, mirrors and diffusers from the angular dependence of such materials.
    Shape,
}

/// Direct-hemispherical value τ or ρ below which an incident cell counts as dark. Far above the rounding of sums over
/// 700 cells (2⁻⁵² · 700 ≈ 2e-13).
const DARK: f64 = 1e-9;
/// Transmittance plus reflectance up to which an excess over 1 counts as a measurement error. Chosen; tested, as the
/// constants below, by the table of `examples/planted_faults.rs` and by `tests/formats/doctor.rs`.
const PLAUSIBLE: f64 = 1.01;
/// Share of unscattered light above which a function counts as that of a pane or mirror; symmetric functions below it
/// count as those of diffusers. Chosen: panes on their own cells have 1, Lambertian diffusers on Klems cells 0.007.
const STRAIGHT: f64 = 0.9;
/// Relative difference from its own images under rotations and reflections below which a function depends on the angle
/// of incidence only. Chosen: the value of `symmetry::NOISE`.
const ALIKE: f64 = 0.05;
/// Rms difference of τ or ρ between light from above and from below from which it counts as a preference. Chosen: above
/// the measurement error of [`PLAUSIBLE`].
const PREFERRED: f64 = 0.015;
/// Minimum rise of the reflectance of a mirror from the normal to grazing angles, as a share of 1 minus the reflectance
/// at the normal. Chosen: less than half of the 0.61 by which a pane of n = 1.5 rises to 82.5°, the middle of the
/// outermost Klems ring (Fresnel's equations).
const GRAZING: f64 = 0.25;
/// Mean direct-hemispherical value below which either the system is black or the values of its file are not luminance
/// coefficients. Chosen: above 0.024, the most that fluxes in place of luminance coefficients sum up to on Klems cells
/// (their largest projected solid angle).
const BLACK: f64 = 0.06;

/// Sums over one function: direct-hemispherical value `tau` of each incident cell, and relative luminance `emitted` of
/// each emergent cell under uniform incident light. Dimensionless.
#[derive(Debug, Clone)]
pub(super) struct Sums {
    tau: Vec<f64>,
    emitted: Vec<f64>,
}

/// Kind of scattering that a function describes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// Unscattered light that depends on the angle of incidence only.
    Straight,
    /// Scattering that does not depend on azimuths.
    Diffuse,
    /// Any other scattering, which depends on directions.
    Directed,
}

/// Key of a function's rearranged values: index of the function, rotation or reflection of directions, and whether
/// incident and emergent directions are exchanged.
type Rearranged = (usize, Option<Turn>, bool);

/// Evidence from the functions of a band, with caches of sums, rearranged values and differences.
pub(super) struct Evidence<'a> {
    /// Functions of the band on common cells.
    pub(super) blocks: &'a Blocks,
    kinds: [Option<Kind>; 4],
    sums: RefCell<BTreeMap<(usize, Option<Factor>), Sums>>,
    values: RefCell<BTreeMap<Rearranged, Rc<Vec<f64>>>>,
    compared: RefCell<BTreeMap<(Part, Part, bool), f64>>,
}

/// Misfits of a reading, each with its question, in a fixed order; questions that do not apply to a band are omitted
/// for all its readings.
pub(super) type Answers = Vec<(Question, f64)>;

impl<'a> Evidence<'a> {
    /// Creates the evidence from those functions for which `heard` returns `true`.
    pub(super) fn new(blocks: &'a Blocks, heard: impl Fn(Component) -> bool) -> Self {
        // A block of zeros does not count, nor does one measured from a few directions only.
        let lit = |block: &&Block| 2 * block.tau.iter().filter(|tau| **tau > DARK).count() > block.tau.len();
        let mut all = Self {
            blocks,
            kinds: [None; 4],
            sums: RefCell::default(),
            values: RefCell::default(),
            compared: RefCell::default(),
        };
        all.kinds =
            Component::ALL.map(|c| blocks.get(c).filter(lit).filter(|_| heard(c)).map(|block| all.kind(c, block)));
        all
    }

    fn kind(&self, component: Component, block: &Block) -> Kind {
        let part = Part::plain(component as usize);
        let image = |turn: Turn| Part { turn: Some(turn), ..part };
        let mut turns = [Turn::UpDown, Turn::LeftRight, Turn::QuarterRound].into_iter();
        let alike = turns.all(|turn| self.difference(part, image(turn), false) < ALIKE);
        match self.blocks.straight_share(block) {
            STRAIGHT.. if alike => Kind::Straight,
            ..=STRAIGHT if alike => Kind::Diffuse,
            _ => Kind::Directed,
        }
    }

    /// Whether the function with index `source` is not zero everywhere and is used as evidence.
    pub(super) fn lit(&self, source: usize) -> bool {
        self.kinds[source].is_some()
    }

    fn block(&self, source: usize) -> &'a Block {
        // A part is made of a block that is there.
        self.blocks.given[source].as_ref().expect("a reading names given blocks")
    }

    /// Returns the sums over the rows and columns of a function in the given reading.
    pub(super) fn sums(&self, part: Part) -> Sums {
        let key = (part.source, part.factor);
        let known = self.sums.borrow().get(&key).cloned();
        let Sums { tau, emitted } = known.unwrap_or_else(|| {
            let made = self.summed(part.source, part.factor);
            self.sums.borrow_mut().insert(key, made.clone());
            made
        });
        let (tau, emitted) = if part.transposed { (emitted, tau) } else { (tau, emitted) };
        match part.turn {
            None => Sums { tau, emitted },
            Some(turn) => {
                let turned = |list: Vec<f64>| (0..list.len()).map(|k| list[self.blocks.turned(turn, k)]).collect();
                Sums { tau: turned(tau), emitted: turned(emitted) }
            }
        }
    }

    /// Computes the sums over rows and columns of a function's values, with a suspected factor removed.
    fn summed(&self, source: usize, factor: Option<Factor>) -> Sums {
        let (block, weight) = (self.block(source), &self.blocks.weight);
        let n = weight.len();
        let Some(factor) = factor else {
            let mut emitted = vec![0.0; n];
            for (row, w) in block.q.chunks_exact(n).zip(weight) {
                emitted.iter_mut().zip(row).for_each(|(sum, q)| *sum += w * q);
            }
            return Sums { tau: block.tau.clone(), emitted };
        };
        // What an incident cell shares comes before its sum, what an emergent one shares before the other's.
        let (rows, columns) = factor.undone(self.blocks);
        let product = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a * b).collect() };
        let plain = self.sums(Part::plain(source));
        if factor.of_emergence() {
            let weight = product(weight, &columns);
            let sum = |row: &[f64]| row.iter().zip(&weight).map(|(q, w)| q * w).sum();
            Sums { tau: block.q.chunks_exact(n).map(sum).collect(), emitted: product(&plain.emitted, &columns) }
        } else {
            let weight = product(weight, &rows);
            let mut emitted = vec![0.0; n];
            for (row, w) in block.q.chunks_exact(n).zip(&weight) {
                emitted.iter_mut().zip(row).for_each(|(sum, q)| *sum += w * q);
            }
            Sums { tau: product(&plain.tau, &rows), emitted }
        }
    }

    /// Returns the relative difference of two functions in the given readings, from the cache if possible; `reversed`:
    /// whether the light of one of them is reversed.
    pub(super) fn cached_difference(&self, a: Part, b: Part, reversed: bool) -> f64 {
        let (a, b, reversed) = canonical(a, b, reversed);
        if a == b && !reversed {
            return 0.0;
        }
        if let Some(known) = self.compared.borrow().get(&(a, b, reversed)) {
            return *known;
        }
        let difference = self.difference(a, b, reversed);
        self.compared.borrow_mut().insert((a, b, reversed), difference);
        difference
    }

    /// Returns the values q of a function \[1/sr\] with its directions mapped by `turn`, row by row of incident cells,
    /// or of emergent ones if `exchanged`; cached.
    fn values(&self, source: usize, turn: Option<Turn>, exchanged: bool) -> Rc<Vec<f64>> {
        let made = || {
            let (q, n) = (&self.block(source).q, self.blocks.weight.len());
            let places: Vec<usize> = (0..n).map(|k| turn.map_or(k, |turn| self.blocks.turned(turn, k))).collect();
            let mut values = Vec::with_capacity(n * n);
            for &row in &places {
                if exchanged {
                    values.extend(places.iter().map(|column| q[column * n + row]));
                } else {
                    let row = &q[row * n..(row + 1) * n];
                    values.extend(places.iter().map(|column| row[*column]));
                }
            }
            Rc::new(values)
        };
        self.values.borrow_mut().entry((source, turn, exchanged)).or_insert_with(made).clone()
    }

    /// Computes the relative difference of two functions in the given readings like [`Blocks::difference`], row by row.
    fn difference(&self, a: Part, b: Part, reversed: bool) -> f64 {
        let weight = &self.blocks.weight;
        let n = weight.len();
        let (values_a, values_b) =
            (self.values(a.source, a.turn, a.transposed), self.values(b.source, b.turn, b.transposed ^ reversed));
        // Cells of one ring share their factors, so that a turn need not turn those.
        let factors = |part: Part| part.factor.map_or_else(|| (vec![1.0; n], vec![1.0; n]), |f| f.undone(self.blocks));
        let (rows_a, columns_a) = factors(a);
        let (rows_b, columns_b) = factors(b);
        let (rows_b, columns_b) = if reversed { (columns_b, rows_b) } else { (rows_b, columns_b) };
        let (mut difference, mut sum) = (0.0, 0.0);
        for (i, (row_a, row_b)) in values_a.chunks_exact(n).zip(values_b.chunks_exact(n)).enumerate() {
            let (mut off, mut all) = ([0.0; 4], [0.0; 4]);
            let columns = columns_a.iter().zip(&columns_b).zip(weight);
            for (k, ((a, b), ((in_a, in_b), w))) in row_a.iter().zip(row_b).zip(columns).enumerate() {
                let (a, b) = (a * rows_a[i] * in_a, b * rows_b[i] * in_b);
                off[k % 4] += w * (a - b).abs();
                all[k % 4] += 0.5 * w * (a + b).abs();
            }
            difference += weight[i] * off.iter().sum::<f64>();
            sum += weight[i] * all.iter().sum::<f64>();
        }
        if sum > 0.0 { difference / sum } else { 0.0 }
    }

    /// Whether two readings give the same functions, to within the relative difference `nothing`.
    pub(super) fn same(&self, a: &Reading, b: &Reading, nothing: f64) -> bool {
        a.iter().zip(b).all(|(a, b)| match (a, b) {
            (Some(a), Some(b)) => a == b || self.cached_difference(*a, *b, false) < nothing,
            (None, None) => true,
            _ => false,
        })
    }

    /// Returns the misfits of a reading of the band's numbers.
    pub(super) fn answers(&self, reading: &Reading) -> Answers {
        let lit = as_it_is(self.blocks).map(|part| part.filter(|part| self.lit(part.source)));
        let there = |slot: usize| lit[slot].and(reading[slot]);
        let mut list = Vec::new();
        match (there(0), there(1)) {
            (Some(front), Some(back)) => list.push((Question::Between, self.cached_difference(front, back, true))),
            (Some(one), None) | (None, Some(one)) => list.push((Question::Alone, self.own(one))),
            (None, None) => {}
        }
        list.extend([2, 3].into_iter().filter_map(there).map(|part| (Question::Own, self.own(part))));
        let sums = [0, 1, 2, 3].map(|slot| there(slot).map(|part| self.sums(part)));
        let held = |sums: &Sums| self.mean(sums.tau.iter().copied());
        let plain = lit.iter().flatten().map(|part| held(&self.sums(*part))).fold(0.0, f64::max);
        // What is black as it stands has nothing left over that could be compared.
        if plain < BLACK && sums[0].is_some() && sums[2].is_some() {
            let most = sums.iter().flatten().map(held).fold(0.0, f64::max);
            list.push((Question::Lost, (BLACK / most).ln().max(0.0)));
            return list;
        }
        for (through, back) in [(0, 2), (1, 3)] {
            let total: Option<Vec<f64>> = match (&sums[through], &sums[back]) {
                (Some(t), Some(r)) => Some(t.tau.iter().zip(&r.tau).map(|(t, r)| t + r).collect()),
                (Some(one), None) | (None, Some(one)) => Some(one.tau.clone()),
                (None, None) => None,
            };
            let Some(total) = total else { continue };
            if let (Some(t), Some(r)) = (&sums[through], &sums[back]) {
                list.push((Question::Opposed, self.together(&t.tau, &r.tau)));
                list.push((Question::Even, self.one_sided(&total)));
                list.push((Question::Rest, self.by_angle(&total)));
            }
            list.push((Question::Won, self.rms(total.iter().map(|sum| (sum - PLAUSIBLE).max(0.0)))));
        }
        for slot in 0..4 {
            if let (Some(part), Some(sums)) = (there(slot), &sums[slot])
                && let Some(misfit) = self.shape(part, sums, slot < 2)
            {
                list.push((Question::Shape, misfit));
            }
        }
        list
    }

    /// Returns the mean difference between the shapes of a function in two bands: of its sums over rows and columns,
    /// each relative to its own mean.
    pub(super) fn shape_difference(&self, part: Part, other: &Self, of_other: Part) -> f64 {
        let (a, b) = (self.sums(part), other.sums(of_other));
        let difference = |a: &[f64], b: &[f64]| {
            let (mean_a, mean_b) = (self.mean(a.iter().copied()), self.mean(b.iter().copied()));
            self.mean(a.iter().zip(b).map(|(a, b)| (a / mean_a - b / mean_b).abs()))
        };
        0.5 * (difference(&a.tau, &b.tau) + difference(&a.emitted, &b.emitted))
    }

    /// Returns the relative difference between a function and the same function with the light reversed.
    fn own(&self, part: Part) -> f64 {
        // Names of light that leaves on the side where it came from are turned by 180°.
        self.cached_difference(part, Part { turn: after(part.turn, Some(Turn::HalfRound)), ..part }, true)
    }

    /// Returns the mean of values given per cell, weighted by projected solid angle.
    fn mean(&self, values: impl Iterator<Item = f64>) -> f64 {
        values.zip(&self.blocks.weight).map(|(value, w)| w * value).sum::<f64>() / PI
    }

    fn rms(&self, values: impl Iterator<Item = f64>) -> f64 {
        self.mean(values.map(|value| value * value)).sqrt()
    }

    /// Returns the rms deviation of values given per cell from their mean.
    fn uneven(&self, values: &[f64]) -> f64 {
        let mean = self.mean(values.iter().copied());
        self.rms(values.iter().map(|value| value - mean))
    }

    /// Returns the rms difference between values given per cell and those of the mirror-image cells, above–below and
    /// left–right together.
    fn one_sided(&self, values: &[f64]) -> f64 {
        let asymmetry =
            |turn| self.rms(values.iter().enumerate().map(|(k, value)| value - values[self.blocks.turned(turn, k)]));
        asymmetry(Turn::UpDown).hypot(asymmetry(Turn::LeftRight))
    }

    /// Returns the correlation, 0 … 1, of how much the transmittances `t` and the reflectances `r` prefer light from
    /// above to light from below; 0 where they oppose each other, or where one of them has no preference.
    fn together(&self, t: &[f64], r: &[f64]) -> f64 {
        let preference = |values: &[f64]| -> Vec<f64> {
            (0..values.len()).map(|k| values[k] - values[self.blocks.turned(Turn::UpDown, k)]).collect()
        };
        let (t, r) = (preference(t), preference(r));
        let (through, back) = (self.rms(t.iter().copied()), self.rms(r.iter().copied()));
        if through.min(back) < PREFERRED {
            return 0.0;
        }
        (self.mean(t.iter().zip(&r).map(|(t, r)| t * r)) / (through * back)).max(0.0)
    }

    /// Returns the rms deviation of the means over rings of cells from the overall mean: the variation with the polar
    /// angle.
    fn by_angle(&self, values: &[f64]) -> f64 {
        let basis = &self.blocks.basis;
        let mean = |ring: usize| {
            let cells = basis.first_cell(ring)..basis.first_cell(ring) + basis.rings()[ring].sectors;
            let count = cells.len();
            std::iter::repeat_n(values[cells].iter().sum::<f64>() / count as f64, count)
        };
        let means: Vec<f64> = (0..basis.rings().len()).flat_map(mean).collect();
        self.uneven(&means)
    }

    /// Returns for each ring of cells, from the normal outwards, the cosine of its polar angle and the mean of the
    /// values over it.
    fn rings(&self, values: &[f64]) -> Vec<(f64, f64)> {
        self.blocks.by_ring(values).into_iter().map(|(theta, mean)| (theta.cos(), mean)).collect()
    }

    /// Returns how much a function deviates from the angular dependence usual for its kind of material: of a pane whose
    /// transmittance changes before 40°, of a mirror that does not reflect more towards grazing (both as logarithms of
    /// ratios), of a diffuser that emits less uniformly than it receives. `None` for other materials.
    fn shape(&self, part: Part, sums: &Sums, transmission: bool) -> Option<f64> {
        let rings = self.rings(&sums.tau);
        let (first, last) = (rings.first()?.1, rings.last()?.1);
        let middle = rings.iter().min_by(|a, b| (a.0 - MIDDLE).abs().total_cmp(&(b.0 - MIDDLE).abs()))?.1;
        match self.kinds[part.source]? {
            Kind::Straight if first <= DARK || middle <= DARK => None,
            Kind::Straight if transmission => Some((middle / first).ln().abs()),
            Kind::Straight => Some(((first + GRAZING * (1.0 - first).max(0.0)) / last.max(DARK)).ln().max(0.0)),
            Kind::Diffuse => {
                let spread = |values: &[f64]| self.uneven(values) / self.mean(values.iter().copied());
                let (taken, sent) = (spread(&sums.tau), spread(&sums.emitted));
                Some((sent - taken).max(0.0) * (ALIKE / (ALIKE + taken)))
            }
            Kind::Directed => None,
        }
    }
}

/// Cosine of the angle of incidence up to which the transmittance of panes is nearly constant: 40°, the middle of a
/// Klems ring. By Fresnel's equations a pane of n = 1.5 loses 1 % up to there.
const MIDDLE: f64 = 0.77;

/// Returns the comparison of two functions in a unique form, under which its result is cached: equivalent comparisons
/// have the same form.
fn canonical(a: Part, b: Part, reversed: bool) -> (Part, Part, bool) {
    if a.factor.is_some() || b.factor.is_some() {
        return (a, b, reversed);
    }
    // Turned and transposed together, both stay as far apart; only what is between them counts.
    let turn = after(a.turn, b.turn);
    let reversed = reversed ^ a.transposed ^ b.transposed;
    let (first, second) = (a.source.min(b.source), a.source.max(b.source));
    (Part::plain(first), Part { turn, ..Part::plain(second) }, reversed)
}
