//! Which hypothesis explains a file best, and how far it stands ahead of every other.
//!
//! Every misfit counts by the logarithm of how many times it exceeds what genuine files show, so that all questions have
//! one voice each, whatever their unit, and none can outvote all others by being absurd. A hypothesis is asked about
//! when it takes enough off that sum; it is acted upon when besides no other explanation, nothing being wrong included,
//! comes near it. Both thresholds, and what genuine files show, stand beside the table of `examples/planted_faults.rs`.

use super::blocks::Blocks;
use super::copies::copied;
use super::hypotheses::{Fault, Hypothesis, hypotheses};
use super::reading::{Factor, Reading, as_it_is};
use super::repair::BandScope;
use super::witnesses::{Answers, Question, Witnesses};
use crate::compute::btdf::{Band, Component, Scattered, TreeRank};

/// What genuine files show, and how much an answer counts: a misfit of the first size counts ln 2 times the second. What
/// holds for every system counts twice as much as what holds for most.
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
/// The same for the shapes of one function in both bands.
const BANDS: f64 = 0.1;

/// A hypothesis that takes so much off the sum of misfits is asked about.
pub(super) const ASK: f64 = 0.9;
/// One that takes so much more off than any other is beyond doubt.
pub(super) const SURE: f64 = 1.6;
/// Every further set of blocks that must have gone wrong counts against a hypothesis like the toss of a coin.
const FURTHER: f64 = std::f64::consts::LN_2;
/// Readings that differ by less are one; weighted share.
const NOTHING: f64 = 0.05;

/// A band ready to be judged.
pub(super) struct Side<'a> {
    pub(super) scope: BandScope,
    pub(super) witnesses: Witnesses<'a>,
    copied: [bool; 2],
}

impl<'a> Side<'a> {
    pub(super) fn new(scope: BandScope, band: &Band, blocks: &'a Blocks) -> Self {
        // Trees of rank 3 have no azimuth to be wrong about, and averaged azimuths do not go both ways alike.
        let averaged =
            |scattered: &Scattered| matches!(scattered, Scattered::Tree(tree) if tree.rank() == TreeRank::Three);
        let heard = |component: Component| {
            let scattered = band.get(component).and_then(|btdf| btdf.scattered.as_ref());
            !(component.is_transmission() && scattered.is_some_and(averaged))
        };
        Self { scope, witnesses: Witnesses::new(blocks, heard), copied: copied(band) }
    }
}

/// A hypothesis about some bands.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub(super) hypothesis: Hypothesis,
    pub(super) bands: BandScope,
    /// How much it takes off the sum of misfits.
    pub(super) gain: f64,
}

/// What explains a file best.
#[derive(Debug, Clone)]
pub(super) struct Verdict {
    pub(super) best: Candidate,
    /// Others that come near it, the nearest first.
    pub(super) rivals: Vec<Candidate>,
    /// How far it is ahead of all of them and of nothing being wrong; no more than [`SURE`].
    pub(super) lead: f64,
    /// Misfits before and after, of the first band that it is about.
    pub(super) evidence: Vec<(Question, f64, f64)>,
}

impl Verdict {
    /// Is it worth a question?
    pub(super) fn asks(&self) -> bool {
        self.best.gain >= ASK
    }

    /// Is it far ahead of every other, and of nothing being wrong?
    pub(super) fn sure(&self) -> bool {
        self.lead >= SURE
    }
}

/// Sum of what misfits count.
fn cost(answers: &Answers) -> f64 {
    let counts = |(question, misfit): &(Question, f64)| {
        let (noise, weight) = scale(*question);
        weight * (1.0 + misfit / noise).ln()
    };
    answers.iter().map(counts).sum()
}

/// What the same functions of two bands count when their shapes differ: one device, one goniometer.
fn between_bands(a: (&Witnesses, &Reading), b: (&Witnesses, &Reading)) -> f64 {
    let mut sum = 0.0;
    for slot in 0..4 {
        let (Some(one), Some(other)) = (a.1[slot], b.1[slot]) else { continue };
        if a.0.lit(one.source) && b.0.lit(other.source) && a.0.blocks.basis == b.0.blocks.basis {
            sum += (1.0 + a.0.shapes_apart(one, b.0, other) / BANDS).ln();
        }
    }
    sum
}

/// The best explanation of what does not fit, however little it explains; `None` where nothing could be asked about.
pub(super) fn judge(sides: &[Side]) -> Option<Verdict> {
    let plain: Vec<Reading> = sides.iter().map(|side| as_it_is(side.witnesses.blocks)).collect();
    let own: Vec<f64> =
        sides.iter().zip(&plain).map(|(side, reading)| cost(&side.witnesses.answers(reading))).collect();
    let all = |costs: &[f64], readings: [&Reading; 2]| {
        let mean = costs.iter().sum::<f64>() / costs.len() as f64;
        match sides {
            [a, b] => mean + between_bands((&a.witnesses, readings[0]), (&b.witnesses, readings[1])),
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
            let list = hypotheses(&side.witnesses, side.copied).into_iter();
            list.map(|one| (cost(&side.witnesses.answers(&one.reading)), one)).map(|(cost, one)| (one, cost)).collect()
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
        sides.iter().zip(&readings).zip(other).all(|((side, a), b)| side.witnesses.same(a, b, NOTHING))
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
    let witnesses = &sides[about].witnesses;
    let (then, now) = (witnesses.answers(&plain[about]), witnesses.answers(&readings[about]));
    let evidence = then.iter().zip(&now).map(|(then, now)| (then.0, then.1, now.1)).collect();
    Some(Verdict { best, rivals, lead, evidence })
}
