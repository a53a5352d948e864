//! Which way round is every function? Blocks upside down, mirrored, transposed, or under the name of the other side.
//!
//! Two witnesses. *Reciprocity*: the transmissions of both sides belong together in exactly one way. *The light left
//! over*: what a system does not let through it throws back in good part, so that a blind that lets light from below
//! in throws light from above back; where transmission and reflection favour the same directions, one of them is
//! turned.

use super::at::At;
use super::blocks::{Block, Blocks, Turn};
use super::diagnosis::{Confidence, Diagnosis};
use super::repair::{BlockScope, RepairKind};
use crate::compute::btdf::{Component, Scattered, TreeRank};

/// A way in which a block can be wrong.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    Turned(Turn),
    Transposed,
}

impl Fault {
    const fn repair(self) -> RepairKind {
        match self {
            Self::Turned(Turn::LeftRight) => RepairKind::MirrorLeftRight,
            Self::Turned(Turn::HalfRound) => RepairKind::TurnHalfRound,
            Self::Turned(_) => RepairKind::TurnUpsideDown,
            Self::Transposed => RepairKind::Transpose,
        }
    }

    const fn code(self) -> &'static str {
        match self {
            Self::Turned(Turn::LeftRight) => "mirrored-block",
            Self::Turned(_) => "upside-down-block",
            Self::Transposed => "transposed-block",
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::Turned(Turn::LeftRight) => "mirrored left to right",
            Self::Turned(Turn::HalfRound) => "turned by 180° in azimuth (upside down)",
            Self::Turned(_) => "flipped upside down",
            Self::Transposed => "transposed (incident and emergent directions exchanged)",
        }
    }
}

/// The four functions, each as it is or put right.
type Four = [Option<Block>; 4];

pub(super) fn check(at: &At, blocks: &Blocks) -> Vec<Diagnosis> {
    let mut four = blocks.given.clone();
    let mut list: Vec<Diagnosis> = Vec::new();
    list.extend(flat(at, blocks));
    if let Some((diagnosis, mended)) = pair(at, blocks, &four) {
        list.push(diagnosis);
        four = mended;
    }
    list.extend(contradiction(at, blocks, &four));
    list
}

fn rank_three(scattered: &Scattered) -> bool {
    matches!(scattered, Scattered::Tree(tree) if tree.rank() == TreeRank::Three)
}

fn turned(blocks: &Blocks, block: &Block, turn: Turn) -> Block {
    let n = blocks.weight.len();
    let at = |k| blocks.turned(turn, k);
    let q = (0..n).flat_map(|i| (0..n).map(move |o| (i, o))).map(|(i, o)| block.q[at(i) * n + at(o)]).collect();
    Block { q, tau: (0..n).map(|i| block.tau[at(i)]).collect() }
}

pub(super) fn transposed(blocks: &Blocks, block: &Block) -> Block {
    let n = blocks.weight.len();
    let q: Vec<f64> = (0..n).flat_map(|i| (0..n).map(move |o| (i, o))).map(|(i, o)| block.q[o * n + i]).collect();
    let tau = q.chunks_exact(n).map(|row| row.iter().zip(&blocks.weight).map(|(q, w)| q * w).sum()).collect();
    Block { q, tau }
}

fn mended(blocks: &Blocks, block: &Block, fault: Fault) -> Block {
    match fault {
        Fault::Turned(turn) => turned(blocks, block, turn),
        Fault::Transposed => transposed(blocks, block),
    }
}

fn isotropic(blocks: &Blocks, block: &Block) -> bool {
    [Turn::UpDown, Turn::LeftRight, Turn::QuarterRound].iter().all(|turn| blocks.asymmetry(block, *turn) < 0.05)
}

/// (largest − smallest) / mean over the rings.
fn spread(rings: &[(f64, f64)]) -> f64 {
    let mean = rings.iter().map(|ring| ring.1).sum::<f64>() / rings.len() as f64;
    let largest = rings.iter().map(|ring| ring.1).fold(f64::MIN, f64::max);
    let smallest = rings.iter().map(|ring| ring.1).fold(f64::MAX, f64::min);
    if mean > 0.0 { (largest - smallest) / mean } else { 0.0 }
}

/// Scattered in the same way whatever the incidence, only more or less of it: as makers' programs model fabrics.
fn modelled(blocks: &Blocks, block: &Block) -> bool {
    spread(&blocks.reversed_tau_by_ring(block)) < 0.04 && spread(&blocks.tau_by_ring(block)) > 0.1
}

/// The transmissions of both sides, one of them put right in every way: is there one that fits far better?
fn pair(at: &At, blocks: &Blocks, four: &Four) -> Option<(Diagnosis, Four)> {
    let (front, back) = (four[0].as_ref()?, four[1].as_ref()?);
    // Trees of rank 3 have no azimuth to be wrong about, and averaged azimuths are not reciprocal.
    if at.band.transmission_front.as_ref().and_then(|btdf| btdf.scattered.as_ref()).is_some_and(rank_three) {
        return None;
    }
    let n = blocks.weight.len();
    let error = |fault: Option<Fault>| {
        blocks.difference(
            |i, o| front.q[i * n + o],
            |i, o| match fault {
                None => back.q[o * n + i],
                Some(Fault::Turned(turn)) => back.q[blocks.turned(turn, o) * n + blocks.turned(turn, i)],
                Some(Fault::Transposed) => back.q[i * n + o],
            },
        )
    };
    let before = error(None);
    if before < 0.02 {
        return None;
    }
    let faults = [
        Fault::Turned(Turn::UpDown),
        Fault::Turned(Turn::LeftRight),
        Fault::Turned(Turn::HalfRound),
        Fault::Transposed,
    ];
    let mut best: Option<(Fault, f64)> = None;
    for fault in faults {
        let after = error(Some(fault));
        if best.is_none_or(|(_, least)| after < 0.85 * least - 0.003) {
            best = Some((fault, after));
        }
    }
    let (fault, after) = best?;
    let explained = after < 0.25 * before || (before > 0.15 && after < 0.4 * before);
    if !explained {
        return None;
    }
    let unevenness = |block: &Block| {
        let turns = [Turn::UpDown, Turn::LeftRight, Turn::QuarterRound];
        turns.iter().map(|turn| blocks.asymmetry(block, *turn)).fold(0.0, f64::max)
    };
    let uneven = unevenness(front).min(unevenness(back));
    // A maker's fabric measured, or modelled, alike on both sides is not reciprocal but not transposed either.
    if fault == Fault::Transposed && uneven < 0.1 && (modelled(blocks, front) || modelled(blocks, back)) {
        return None;
    }
    let confidence = match before {
        _ if fault == Fault::Transposed && uneven < 0.2 => Confidence::Possible,
        0.2.. if after < 0.25 * before => Confidence::Certain,
        0.05.. => Confidence::Likely,
        _ => Confidence::Possible,
    };
    let with = |index: usize| {
        let mut four = four.clone();
        four[index] = four[index].as_ref().map(|block| mended(blocks, block, fault));
        let score = disagreement(blocks, &four);
        (four, score)
    };
    let ((as_front, score_front), (as_back, score_back)) = (with(0), with(1));
    let known = (score_front - score_back).abs() > 0.02 + 0.05 * score_front.max(score_back);
    let (component, four) = if known && score_front < score_back {
        (Component::TransmissionFront, as_front)
    } else {
        (Component::TransmissionBack, as_back)
    };
    let (name, other) = if known {
        (component.words(), "")
    } else {
        ("One transmission", " Which of the two is the wrong one, the data do not tell; look at the pictures.")
    };
    let message = format!(
        "{} ({}) is {} {}: put right, it agrees with the other transmission within {:.1} %, as it is they differ by {:.0} %.{other}",
        name,
        at.name,
        confidence.word(),
        fault.words(),
        100.0 * after,
        100.0 * before
    );
    let repair = at.repair(fault.repair(), BlockScope::One(component));
    let diagnosis = Diagnosis::suspicion(confidence, fault.code(), message);
    Some((if known { diagnosis.with(repair) } else { diagnosis.asking(repair) }, four))
}

/// How unevenly the light left over lies between above and below, and how much light is won: rms over the cells of both
/// sides. What a system does not let through it throws back in good part, so that of several readings of the same
/// numbers the right one has the evenest rest.
fn disagreement(blocks: &Blocks, four: &Four) -> f64 {
    let mut sum = 0.0;
    for (t, r) in [(0, 2), (1, 3)] {
        let (Some(t), Some(r)) = (&four[t], &four[r]) else { continue };
        for (k, w) in blocks.weight.iter().enumerate() {
            let total = |k: usize| t.tau[k] + r.tau[k];
            let uneven = total(k) - total(blocks.turned(Turn::UpDown, k));
            let won = (total(k) - 1.01).max(0.0);
            sum += w * (uneven * uneven + 25.0 * won * won);
        }
    }
    (sum / std::f64::consts::PI).sqrt()
}

/// Of two transmissions that are the same numbers the one that the light left over speaks against; `None` where it does
/// not say.
pub(super) fn false_copy(blocks: &Blocks) -> Option<Component> {
    let [Some(front), Some(back), rf, rb] = &blocks.given else { return None };
    if rf.is_none() && rb.is_none() {
        return None;
    }
    let score = |front: Block, back: Block| disagreement(blocks, &[Some(front), Some(back), rf.clone(), rb.clone()]);
    let front_false = score(transposed(blocks, back), back.clone());
    let back_false = score(front.clone(), transposed(blocks, front));
    let known = (front_false - back_false).abs() > 0.02 + 0.05 * front_false.max(back_false);
    let component = if front_false < back_false { Component::TransmissionFront } else { Component::TransmissionBack };
    known.then_some(component)
}

/// Correlation of what transmission and reflection of one side prefer (above or below), and how strongly each does.
fn preference(blocks: &Blocks, t: &Block, r: &Block) -> (f64, f64, f64) {
    let (mut tt, mut rr, mut tr) = (0.0, 0.0, 0.0);
    for (k, w) in blocks.weight.iter().enumerate() {
        let down = blocks.turned(Turn::UpDown, k);
        let (a, b) = (t.tau[k] - t.tau[down], r.tau[k] - r.tau[down]);
        tt += w * a * a;
        rr += w * b * b;
        tr += w * a * b;
    }
    let correlation = if tt > 0.0 && rr > 0.0 { tr / (tt * rr).sqrt() } else { 0.0 };
    (correlation, (tt / std::f64::consts::PI).sqrt(), (rr / std::f64::consts::PI).sqrt())
}

/// Transmissions of both sides that differ by less agree, as far as measurements do.
const AGREED: f64 = 0.1;

/// Transmission and reflection that favour the same directions.
fn contradiction(at: &At, blocks: &Blocks, four: &Four) -> Option<Diagnosis> {
    let odd = [(0, 2), (1, 3)].map(|(t, r)| {
        let (Some(t), Some(r)) = (&four[t], &four[r]) else { return None };
        let (correlation, through, back) = preference(blocks, t, r);
        (through > 0.03 && back > 0.015).then_some(correlation)
    });
    let worst = odd.iter().flatten().copied().fold(-1.0, f64::max);
    let before = disagreement(blocks, four);
    let won = [(0, 2), (1, 3)].iter().any(|(t, r)| {
        let (Some(t), Some(r)) = (&four[*t], &four[*r]) else { return false };
        t.tau.iter().zip(&r.tau).any(|(t, r)| t + r > 1.05)
    });
    if worst < 0.5 && !won {
        return None;
    }
    let turn = |block: &Option<Block>| block.as_ref().map(|block| turned(blocks, block, Turn::UpDown));
    let half = |block: &Option<Block>| block.as_ref().map(|block| turned(blocks, block, Turn::HalfRound));
    let flip = |block: &Option<Block>| block.as_ref().map(|block| transposed(blocks, block));
    let [tf, tb, rf, rb] = four;
    let both = rf.is_some() && rb.is_some();
    let upside = "upside-down-block";
    type Reading<'a> = (&'a str, &'static str, RepairKind, BlockScope, Four);
    let mut readings: Vec<Reading> = Vec::new();
    if both {
        // Everything transposed: transmissions change sides, reflections turn round.
        if tf.is_some() && tb.is_some() {
            let all = [flip(tf), flip(tb), flip(rf), flip(rb)];
            readings.push((
                "the whole file is transposed",
                "transposed-block",
                RepairKind::Transpose,
                BlockScope::All,
                all,
            ));
        }
        let turned = [tf.clone(), tb.clone(), turn(rf), turn(rb)];
        readings.push((
            "the reflections are upside down",
            upside,
            RepairKind::TurnUpsideDown,
            BlockScope::Reflection,
            turned,
        ));
        let swapped = [tf.clone(), tb.clone(), half(rb), half(rf)];
        readings.push((
            "the reflections of outside and inside are swapped",
            "sides-swapped",
            RepairKind::SwapSides,
            BlockScope::Reflection,
            swapped,
        ));
        if tf.is_some() && tb.is_some() {
            let swapped = [half(tb), half(tf), rf.clone(), rb.clone()];
            readings.push((
                "the transmissions of outside and inside are swapped",
                "sides-swapped",
                RepairKind::SwapSides,
                BlockScope::Transmission,
                swapped,
            ));
        }
    }
    // As good as both reflections, or the only one, turned: which of them it is, no light left over can say.
    let through = [turn(tf), turn(tb), rf.clone(), rb.clone()];
    readings.push((
        "the transmissions are upside down",
        upside,
        RepairKind::TurnUpsideDown,
        BlockScope::Transmission,
        through,
    ));
    if rf.is_some() && tf.is_some() {
        let one = [tf.clone(), tb.clone(), turn(rf), rb.clone()];
        let scope = BlockScope::One(Component::ReflectionFront);
        readings.push(("Reflection Front is upside down", upside, RepairKind::TurnUpsideDown, scope, one));
    }
    if rb.is_some() && tb.is_some() {
        let one = [tf.clone(), tb.clone(), rf.clone(), turn(rb)];
        let scope = BlockScope::One(Component::ReflectionBack);
        readings.push(("Reflection Back is upside down", upside, RepairKind::TurnUpsideDown, scope, one));
    }
    let mut rated: Vec<(f64, Reading)> = readings.into_iter().map(|one| (disagreement(blocks, &one.4), one)).collect();
    // Stable: of readings that are as good the one named first.
    rated.sort_by(|a, b| a.0.total_cmp(&b.0));
    let least = rated.first()?.0;
    if least > 0.75 * before {
        return None;
    }
    let close: Vec<&Reading> =
        rated.iter().filter(|(score, _)| *score < 1.05 * least + 0.005).map(|(_, one)| one).collect();
    let best = close.first()?;
    // A transmission that does not agree with that of the other side may be what is wrong instead.
    let n = blocks.weight.len();
    let agreed = match (tf, tb) {
        (Some(f), Some(b)) => blocks.difference(|i, o| f.q[i * n + o], |i, o| b.q[o * n + i]) < AGREED,
        _ => true,
    };
    // Only light out of nothing is beyond doubt, and only one reading of it.
    let sure = least < 0.55 * before && won && agreed && close.len() == 1;
    let confidence = if sure { Confidence::Certain } else { Confidence::Likely };
    let others: Vec<String> =
        close.iter().skip(1).map(|one| format!("{} ({})", one.0, at.repair(one.2, one.3))).collect();
    let others = if others.is_empty() { String::new() } else { format!(" As well possible: {}.", others.join("; ")) };
    let message = format!(
        "Transmission and reflection ({}) contradict each other: both favour the same incident directions, \
         though what passes is not reflected; {} {}.{others}",
        at.name,
        confidence.word(),
        best.0
    );
    Some(Diagnosis::suspicion(confidence, best.1, message).with(at.repair(best.2, best.3)))
}

/// As much light from every incidence, but emitted unevenly: for scattering materials the other way round is the rule.
fn flat(at: &At, blocks: &Blocks) -> Vec<Diagnosis> {
    let odd: Vec<Component> = Component::ALL
        .into_iter()
        .filter(|component| {
            blocks.get(*component).is_some_and(|block| {
                blocks.straight_share(block) < 0.3
                    && isotropic(blocks, block)
                    && spread(&blocks.tau_by_ring(block)) < 0.04
                    && spread(&blocks.reversed_tau_by_ring(block)) > 0.1
            })
        })
        .collect();
    if odd.is_empty() {
        return Vec::new();
    }
    let names = odd.iter().map(|component| component.words()).collect::<Vec<_>>().join(", ");
    let message = format!(
        "{names} ({}): as much light leaves for every angle of incidence, but unevenly over the angles of emergence; \
         for scattering materials it is the other way round: probably transposed.",
        at.name
    );
    let given = Component::ALL.into_iter().filter(|component| blocks.get(*component).is_some());
    let whole = given.clone().count() > 1 && given.filter(|c| !c.is_transmission()).all(|c| odd.contains(&c));
    let scopes = if whole { vec![BlockScope::All] } else { odd.into_iter().map(BlockScope::One).collect::<Vec<_>>() };
    scopes
        .into_iter()
        .map(|scope| {
            Diagnosis::suspicion(Confidence::Likely, "transposed-block", message.clone())
                .with(at.repair(RepairKind::Transpose, scope))
        })
        .collect()
}
