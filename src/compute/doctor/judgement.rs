//! Choice of the hypothesis that explains a file best, and its lead over every other.
//!
//! Misfits are those of [`super::evidence`]. A misfit counts by the logarithm of its ratio to the size usual in genuine
//! files, so that all questions have comparable influence and no absurd value outweighs the others. A hypothesis is
//! reported when it reduces that sum enough; it is certain when no other explanation, including that nothing is wrong,
//! reduces the sum nearly as much. Both thresholds, and the sizes usual in genuine files, are documented with the table
//! of `examples/planted_faults.rs`.

use super::blocks::Blocks;
use super::copies::copied;
use super::evidence::{Answers, Evidence, Question};
use super::hypotheses::{Fault, Hypothesis, hypotheses};
use super::reading::{Factor, Reading, as_it_is};
use super::repair::BandScope;
use crate::compute::btdf::{Band, Component, Scattered, TreeRank};

/// Returns the size of the misfit of a question that genuine files show, and the question's weight: a misfit of that
/// size counts ln 2 times the weight. Questions whose answer is 0 for every system count twice as much as those for
/// which this is only usual.
const fn scale(question: Question) -> (f64, f64) {
    match question {
        Question::Between | Question::Own => (0.02, 1.0),
        Question::Won => (0.01, 1.0),
        Question::Even => (0.01, 1.0),
        Question::Rest => (0.05, 0.5),
        Question::Shape => (0.05, 1.0),
        Question::Opposed => (0.3, 1.0),
        Question::Alone => (0.3, 0.5),
        Question::Lost => (0.5, 1.0),
    }
}
/// Relative difference between the shapes of one function in both bands that genuine files show. Chosen with [`scale`]
/// by the table of `examples/planted_faults.rs`.
const BANDS: f64 = 0.1;

/// Reduction of the sum of misfits from which a hypothesis is reported. Chosen by the table of
/// `examples/planted_faults.rs`: no genuine file is reported with one of the hypotheses.
pub(super) const ASK: f64 = 0.9;
/// Lead over every other hypothesis from which a hypothesis is certain. Chosen by the table of
/// `examples/planted_faults.rs`: no automatic repair makes a file worse.
pub(super) const SURE: f64 = 1.6;
/// Cost, in the sum of misfits, of every further set of functions that a hypothesis assumes to be wrong, like the toss
/// of a coin: ln 2.
const FURTHER: f64 = std::f64::consts::LN_2;
/// Relative difference of functions below which two readings count as equal; also the step by which gains are compared.
/// Chosen with [`scale`] by the table of `examples/planted_faults.rs`.
const NOTHING: f64 = 0.05;

/// Spectral band with the evidence on the readings of its functions.
pub(super) struct Side<'a> {
    /// Band as repairs name it.
    pub(super) scope: BandScope,
    /// Evidence on the readings of the band's functions.
    pub(super) evidence: Evidence<'a>,
    copied: [bool; 2],
}

impl<'a> Side<'a> {
    /// Creates the evidence of a band.
    pub(super) fn new(scope: BandScope, band: &Band, blocks: &'a Blocks) -> Self {
        // Trees of rank 3 have no azimuth to be wrong about, and averaged azimuths do not go both ways alike.
        let averaged =
            |scattered: &Scattered| matches!(scattered, Scattered::Tree(tree) if tree.rank() == TreeRank::Three);
        let heard = |component: Component| {
            let scattered = band.get(component).and_then(|btdf| btdf.scattered.as_ref());
            !(component.is_transmission() && scattered.is_some_and(averaged))
        };
        Self { scope, evidence: Evidence::new(blocks, heard), copied: copied(band) }
    }
}

/// Hypothesis about one or both bands, with the reduction of misfits that it brings.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    /// Hypothesis that is rated.
    pub(super) hypothesis: Hypothesis,
    /// Bands that the hypothesis is about.
    pub(super) bands: BandScope,
    /// Reduction of the sum of weighted logarithms of misfits if the fault is undone.
    pub(super) gain: f64,
}

/// Best explanation of a dataset's misfits, with its rivals and evidence.
#[derive(Debug, Clone)]
pub(super) struct Verdict {
    /// Hypothesis with the largest gain of those that a repair undoes.
    pub(super) best: Candidate,
    /// Other explanations whose gain comes near that of the best, in the order of falling gain.
    pub(super) rivals: Vec<Candidate>,
    /// Lead: difference in gain from the best rival, and from the assumption that nothing is wrong; at most [`SURE`].
    pub(super) lead: f64,
    /// Questions with the misfits before and after the repair, of the first band that the explanation is about.
    pub(super) evidence: Vec<(Question, f64, f64)>,
}

impl Verdict {
    /// Whether the explanation is to be reported: its gain reaches [`ASK`].
    pub(super) fn asks(&self) -> bool {
        self.best.gain >= ASK
    }

    /// Whether the explanation is certain: its lead over every other one, and over nothing being wrong, reaches
    /// [`SURE`].
    pub(super) fn sure(&self) -> bool {
        self.lead >= SURE
    }
}

/// Returns the sum of the weighted logarithms of the misfits of a reading, relative to those of genuine files.
fn cost(answers: &Answers) -> f64 {
    let counts = |(question, misfit): &(Question, f64)| {
        let (noise, weight) = scale(*question);
        weight * (1.0 + misfit / noise).ln()
    };
    answers.iter().map(counts).sum()
}

/// Returns the cost, in the sum of misfits, of differences in shape between the functions of two bands, given by
/// evidence and reading; one product measured on one goniometer has no such differences.
fn between_bands(a: (&Evidence, &Reading), b: (&Evidence, &Reading)) -> f64 {
    let mut sum = 0.0;
    for slot in 0..4 {
        let (Some(one), Some(other)) = (a.1[slot], b.1[slot]) else { continue };
        if a.0.lit(one.source) && b.0.lit(other.source) && a.0.blocks.basis == b.0.blocks.basis {
            sum += (1.0 + a.0.shape_difference(one, b.0, other) / BANDS).ln();
        }
    }
    sum
}

/// Returns the best explanation of the misfits of one or both bands, however small its gain; `None` if there is nothing
/// to explain.
pub(super) fn judge(sides: &[Side]) -> Option<Verdict> {
    let plain: Vec<Reading> = sides.iter().map(|side| as_it_is(side.evidence.blocks)).collect();
    let own: Vec<f64> = sides.iter().zip(&plain).map(|(side, reading)| cost(&side.evidence.answers(reading))).collect();
    let all = |costs: &[f64], readings: [&Reading; 2]| {
        let mean = costs.iter().sum::<f64>() / costs.len() as f64;
        match sides {
            [a, b] => mean + between_bands((&a.evidence, readings[0]), (&b.evidence, readings[1])),
            _ => mean,
        }
    };
    let last = plain.len().checked_sub(1)?;
    let before = all(&own, [&plain[0], &plain[last]]);
    // No hypothesis takes off more than there is.
    if before < ASK {
        return None;
    }
    let lists: Vec<Vec<(Hypothesis, f64)>> = sides
        .iter()
        .map(|side| {
            let list = hypotheses(&side.evidence, side.copied).into_iter();
            list.map(|one| (cost(&side.evidence.answers(&one.reading)), one)).map(|(cost, one)| (one, cost)).collect()
        })
        .collect();
    let mut rated: Vec<(Candidate, Vec<Reading>)> = Vec::new();
    let mut put = |hypothesis: &Hypothesis, bands: BandScope, costs: &[f64], readings: Vec<Reading>| {
        // Black systems are as rare as fluxes in the place of luminances.
        let black = hypothesis.fault == Fault::Factor(Factor::SolidAngle);
        let further = FURTHER * (hypothesis.scopes.len() - 1 + usize::from(black)) as f64;
        let gain = before - all(costs, [&readings[0], &readings[last]]) - further;
        rated.push((Candidate { hypothesis: hypothesis.clone(), bands, gain }, readings));
    };
    for (k, list) in lists.iter().enumerate() {
        for (one, cost) in list {
            let (mut costs, mut readings) = (own.clone(), plain.clone());
            (costs[k], readings[k]) = (*cost, one.reading);
            put(one, sides[k].scope, &costs, readings.clone());
            let twin = lists
                .iter()
                .skip(k + 1)
                .flatten()
                .find(|(twin, _)| (twin.fault, &twin.scopes) == (one.fault, &one.scopes));
            if let Some((twin, cost)) = twin {
                (costs[last], readings[last]) = (*cost, twin.reading);
                put(one, BandScope::Both, &costs, readings);
            }
        }
    }
    // Stable: of hypotheses that are as good the one named first.
    let rank = |one: &Candidate| (one.gain / NOTHING).round();
    rated.sort_by(|a, b| rank(&b.0).total_cmp(&rank(&a.0)));
    let (best, readings) = rated.iter().find(|(one, _)| one.hypothesis.fault.repair().is_some())?.clone();
    let same = |other: &[Reading]| {
        sides.iter().zip(&readings).zip(other).all(|((side, a), b)| side.evidence.same(a, b, NOTHING))
    };
    // That one of two equal blocks is a copy is known by their equality; which, only the other blocks can say.
    let copy = |one: &Candidate| {
        one.hypothesis.fault == Fault::Copied && one.bands == best.bands && one.gain > best.gain - 0.5 * ASK
    };
    if best.hypothesis.fault == Fault::Copied && rated.iter().any(|(one, other)| copy(one) && !same(other)) {
        return None;
    }
    let near = rated.iter().filter(|(one, _)| one.gain > best.gain - SURE);
    let rivals: Vec<Candidate> = near.filter(|(_, other)| !same(other)).map(|(one, _)| one.clone()).collect();
    let lead = rivals.first().map_or(SURE, |rival| best.gain - rival.gain).min(best.gain);
    let about = sides.iter().position(|side| best.bands == side.scope || best.bands == BandScope::Both)?;
    let band_evidence = &sides[about].evidence;
    let (then, now) = (band_evidence.answers(&plain[about]), band_evidence.answers(&readings[about]));
    let evidence = then.iter().zip(&now).map(|(then, now)| (then.0, then.1, now.1)).collect();
    Some(Verdict { best, rivals, lead, evidence })
}
