//! A factor too much or too little in every value: the cosine of the emergent angle, or the projected solid angle of
//! the emergent cell. Instruments and programs give luminance, intensity or flux, and converting one into another is
//! where such factors come from.
//!
//! Witnesses: reciprocity (a factor of the emergent angle alone breaks it, and undoing the factor restores it), the
//! light left over (a loss that follows the cosine exactly), and panes (what passes straight falls with the angle
//! as Fresnel's equations say, not as the cosine).

use super::at::At;
use super::blocks::{Block, Blocks, Turn};
use super::diagnosis::{Confidence, Diagnosis};
use super::repair::{BlockScope, RepairKind};
use crate::compute::btdf::Component;

/// Transmissions that are copies of each other are explained by a factor only when hardly any error is left.
const EXPLAINED: f64 = 0.03;

/// A factor that is suspected in the values; undone by a repair.
#[derive(Clone, Copy, PartialEq)]
enum Suspect {
    CosineTooMuch,
    CosineTooLittle,
    SolidAngle,
}

impl Suspect {
    const ALL: [Self; 3] = [Self::CosineTooMuch, Self::CosineTooLittle, Self::SolidAngle];

    /// What undoes it, for one emergent cell.
    fn undo(self, blocks: &Blocks, cell: usize) -> f64 {
        match self {
            Self::CosineTooMuch => 1.0 / blocks.cosine[cell],
            Self::CosineTooLittle => blocks.cosine[cell],
            Self::SolidAngle => 1.0 / blocks.weight[cell],
        }
    }

    const fn repair(self) -> RepairKind {
        match self {
            Self::CosineTooMuch => RepairKind::RemoveCosine,
            Self::CosineTooLittle => RepairKind::MultiplyCosine,
            Self::SolidAngle => RepairKind::RemoveSolidAngle,
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Self::CosineTooMuch => "multiplied by the cosine of the emergent angle",
            Self::CosineTooLittle => "divided by the cosine of the emergent angle",
            Self::SolidAngle => "multiplied by the projected solid angle of the emergent cells",
        }
    }

    /// The factor of the other angle that reciprocity cannot tell from it: undoing either leaves a symmetric function.
    const fn twin(self) -> Option<&'static str> {
        match self {
            Self::CosineTooMuch => Some("divided by the cosine of the incident angle"),
            Self::CosineTooLittle => Some("multiplied by the cosine of the incident angle"),
            Self::SolidAngle => None,
        }
    }

    /// Smallest reciprocity error that is worth explaining, and the share of it that may be left when it is explained.
    /// Makers' fabrics lack light at grazing incidence, which looks like a cosine divided out of transmission.
    const fn limits(self, transmission: bool) -> (f64, f64) {
        match (self, transmission) {
            (Self::CosineTooMuch, _) => (0.05, 0.6),
            (Self::CosineTooLittle, false) => (0.08, 0.6),
            (Self::CosineTooLittle, true) => (0.12, 0.45),
            (Self::SolidAngle, _) => (0.03, 0.3),
        }
    }
}

struct Found {
    component: Component,
    suspect: Suspect,
    confidence: Confidence,
    evidence: String,
}

pub(super) fn check(at: &At, blocks: &Blocks) -> Vec<Diagnosis> {
    let mut found: Vec<Found> = Vec::new();
    found.extend(pair(blocks, super::copies::transmissions_alike(at.band)));
    for component in Component::ALL {
        if found.iter().any(|one| one.component == component) {
            continue;
        }
        let Some(block) = blocks.get(component) else { continue };
        let transmission = component.is_transmission();
        let alone =
            blocks.get(Component::TransmissionFront).is_none() || blocks.get(Component::TransmissionBack).is_none();
        if !transmission || alone {
            found.extend(own(blocks, component, block, transmission));
        }
        if !found.iter().any(|one| one.component == component) {
            found.extend(emission(blocks, component, block));
        }
        if !found.iter().any(|one| one.component == component) {
            found.extend(if transmission { pane(blocks, component, block) } else { mirror(blocks, component, block) });
        }
    }
    for (t, r) in [
        (Component::TransmissionFront, Component::ReflectionFront),
        (Component::TransmissionBack, Component::ReflectionBack),
    ] {
        if let Some(suspect) = losses(blocks, t, r) {
            for component in [t, r] {
                if !found.iter().any(|one| one.component == component)
                    && blocks.get(component).is_some_and(|b| blocks.hemispherical(b) > 0.0)
                {
                    let evidence = "what leaves in all directions together follows the cosine".to_owned();
                    found.push(Found { component, suspect, confidence: Confidence::Certain, evidence });
                }
            }
        }
    }
    if found.is_empty() {
        found.extend(fluxes(blocks));
    }
    told(at, blocks, &found)
}

/// One finding for all functions that have the same fault.
fn told(at: &At, blocks: &Blocks, found: &[Found]) -> Vec<Diagnosis> {
    let mut list = Vec::new();
    for suspect in Suspect::ALL {
        let these: Vec<&Found> = found.iter().filter(|one| one.suspect == suspect).collect();
        let Some(confidence) = these.iter().map(|one| one.confidence).max() else { continue };
        // Incident and emergent cosines look alike to every witness: whoever made the data must say which it was.
        let confidence = if suspect.twin().is_some() { confidence.min(Confidence::Likely) } else { confidence };
        let names = these.iter().map(|one| one.component.words()).collect::<Vec<_>>().join(", ");
        let lit = |c: &Component| blocks.get(*c).is_some_and(|block| blocks.hemispherical(block) > 0.0);
        let lit: Vec<Component> = Component::ALL.into_iter().filter(lit).collect();
        let all = lit.iter().all(|c| these.iter().any(|one| one.component == *c));
        let evidence = &these[0].evidence;
        let rest = if all { "" } else { " The other functions do not show it, or cannot." };
        let message = format!(
            "The values of {names} ({}) are {} {}: {evidence}.{rest}",
            at.name,
            confidence.word(),
            suspect.words()
        );
        let scopes =
            if all { vec![BlockScope::All] } else { these.iter().map(|one| BlockScope::One(one.component)).collect() };
        for scope in scopes {
            list.push(
                Diagnosis::suspicion(confidence, "cosine-factor", message.clone())
                    .with(at.repair(suspect.repair(), scope)),
            );
        }
    }
    list
}

fn evidence(suspect: Suspect, before: f64, after: f64) -> String {
    let (before, after) = (100.0 * before, 100.0 * after);
    let twin = suspect.twin().map_or_else(String::new, |twin| {
        format!("; as well possible: {twin}, which reciprocity cannot tell apart and the repair would make worse")
    });
    format!("undoing that brings the reciprocity error from {before:.0} % to {after:.0} %{twin}")
}

/// Both transmissions against each other, with the factor undone in both or in one. `copied`: they are the same
/// numbers, which is an explanation of its own.
fn pair(blocks: &Blocks, copied: bool) -> Vec<Found> {
    let (tf, tb) = (Component::TransmissionFront, Component::TransmissionBack);
    let (Some(front), Some(back)) = (blocks.get(tf), blocks.get(tb)) else { return Vec::new() };
    let n = blocks.weight.len();
    let error = |undo_front: Option<Suspect>, undo_back: Option<Suspect>| {
        let factor = |undo: Option<Suspect>, cell| undo.map_or(1.0, |suspect| suspect.undo(blocks, cell));
        blocks.difference(
            |i, o| front.q[i * n + o] * factor(undo_front, o),
            |i, o| back.q[o * n + i] * factor(undo_back, i),
        )
    };
    let before = error(None, None);
    let mut best: Option<(f64, Vec<Found>)> = None;
    for suspect in Suspect::ALL {
        let (least, share) = suspect.limits(true);
        if before < least || (suspect == Suspect::SolidAngle && !tiny(front) && !tiny(back)) {
            continue;
        }
        let some = Some(suspect);
        for (front, back, share) in [(some, some, share), (some, None, 0.35), (None, some, 0.35)] {
            let after = error(front, back);
            if after < share * before && best.as_ref().is_none_or(|(least, _)| after < 0.9 * least) {
                let confidence =
                    if after < 0.35 * before && before > 0.15 { Confidence::Certain } else { Confidence::Likely };
                let list = [(tf, front), (tb, back)].into_iter().filter(|(_, undo)| undo.is_some());
                let found = list.map(|(component, _)| Found {
                    component,
                    suspect,
                    confidence,
                    evidence: evidence(suspect, before, after),
                });
                best = Some((after, found.collect()));
            }
        }
    }
    best.filter(|(after, _)| !copied || *after < EXPLAINED).map(|(_, found)| found).unwrap_or_default()
}

/// Sums of values that were multiplied by solid angles of a few hundredths are a few hundredths.
fn tiny(block: &Block) -> bool {
    block.tau.iter().copied().fold(0.0, f64::max) < 0.06
}

/// A function against itself: exact for reflection; for a transmission only when nothing else can be asked.
fn own(blocks: &Blocks, component: Component, block: &Block, transmission: bool) -> Option<Found> {
    let before = blocks.own_reciprocity(block, |_| 1.0);
    let mut best: Option<(f64, Suspect)> = None;
    for suspect in Suspect::ALL {
        let (mut least, share) = suspect.limits(transmission);
        if transmission && suspect == Suspect::CosineTooLittle {
            least = 0.3;
        }
        if before < least || (suspect == Suspect::SolidAngle && !tiny(block)) {
            continue;
        }
        let after = blocks.own_reciprocity(block, |cell| suspect.undo(blocks, cell));
        if after < share * before && best.is_none_or(|(least, _)| after < least) {
            best = Some((after, suspect));
        }
    }
    let (after, suspect) = best?;
    let sure = after < 0.4 * before && before > 0.2 && !transmission;
    let confidence = if sure { Confidence::Certain } else { Confidence::Likely };
    Some(Found { component, suspect, confidence, evidence: evidence(suspect, before, after) })
}

/// Does the function not care about the azimuth?
fn isotropic(blocks: &Blocks, block: &Block) -> bool {
    [Turn::UpDown, Turn::LeftRight, Turn::QuarterRound].iter().all(|turn| blocks.asymmetry(block, *turn) < 0.05)
}

/// Cosine of a ring, and its mean over the value at the normal.
type RingShape = (f64, f64);

/// Values at the normal, and means of the rings nearest to 40° and to grazing with their cosines.
fn shape(blocks: &Blocks, block: &Block) -> Option<(f64, RingShape, RingShape)> {
    let rings = blocks.tau_by_ring(block);
    let first = rings.first().filter(|ring| ring.1 > 0.0)?.1;
    let middle = rings.iter().min_by(|a, b| (a.0 - 0.7).abs().total_cmp(&(b.0 - 0.7).abs()))?;
    let last = rings.last()?;
    Some((first, (middle.0.cos(), middle.1 / first), (last.0.cos(), last.1 / first)))
}

/// Light emitted exactly as the cosine of the emergent angle, or its inverse, whatever the incidence: an ideal diffuser
/// with the factor in its values.
fn emission(blocks: &Blocks, component: Component, block: &Block) -> Option<Found> {
    if blocks.straight_share(block) > 0.3 || !isotropic(blocks, block) {
        return None;
    }
    let rings = blocks.reversed_tau_by_ring(block);
    let spread = |f: fn(f64, f64) -> f64| {
        let values: Vec<f64> = rings.iter().map(|(theta, value)| f(*value, theta.cos())).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(*v), high.max(*v)));
        if mean > 0.0 { (high - low) / mean } else { 0.0 }
    };
    let suspect = match spread(|value, _| value) {
        ..0.3 => return None,
        _ if spread(|value, cosine| value / cosine) < 0.06 => Suspect::CosineTooMuch,
        _ if spread(|value, cosine| value * cosine) < 0.06 => Suspect::CosineTooLittle,
        _ => return None,
    };
    let evidence = "without it the emission is that of an ideal diffuser, with it that of none".to_owned();
    Some(Found { component, suspect, confidence: Confidence::Likely, evidence })
}

/// Values that sum up to what a system may transmit and reflect without being weighted, and to next to nothing when
/// they are: fluxes into cells rather than luminances.
fn fluxes(blocks: &Blocks) -> Vec<Found> {
    let n = blocks.weight.len();
    let given: Vec<Component> = Component::ALL.into_iter().filter(|c| blocks.get(*c).is_some()).collect();
    let (Some(t), Some(r)) = (blocks.get(Component::TransmissionFront), blocks.get(Component::ReflectionFront)) else {
        return Vec::new();
    };
    if n < 40 || !given.iter().all(|c| blocks.get(*c).is_some_and(tiny)) {
        return Vec::new();
    }
    let sum = |block: &Block, i: usize| block.q[i * n..(i + 1) * n].iter().sum::<f64>();
    let sums: Vec<f64> = (0..n).map(|i| sum(t, i) + sum(r, i)).collect();
    let mean = sums.iter().sum::<f64>() / n as f64;
    if mean < 0.3 || sums.iter().any(|sum| *sum > 1.02) {
        return Vec::new();
    }
    let evidence =
        format!("summed up without weights they give {:.0} % of the light, with them nearly none", 100.0 * mean);
    let found = |component| Found {
        component,
        suspect: Suspect::SolidAngle,
        confidence: Confidence::Possible,
        evidence: evidence.clone(),
    };
    given.into_iter().map(found).collect()
}

/// A clear pane keeps its transmittance to 40° within 10 %.
fn pane(blocks: &Blocks, component: Component, block: &Block) -> Option<Found> {
    if blocks.straight_share(block) < 0.95 || !isotropic(blocks, block) {
        return None;
    }
    let (_, (cosine, middle), _) = shape(blocks, block)?;
    let suspect = if middle < 0.87 && (0.9..1.04).contains(&(middle / cosine)) {
        Suspect::CosineTooMuch
    } else if middle > 1.15 && (0.9..1.04).contains(&(middle * cosine)) {
        Suspect::CosineTooLittle
    } else {
        return None;
    };
    let evidence = format!(
        "what passes straight changes to {middle:.2} of its value at about 40°, as the cosine does and no pane"
    );
    Some(Found { component, suspect, confidence: Confidence::Likely, evidence })
}

/// Every mirroring surface reflects far more at grazing incidence, or is a mirror at every angle.
fn mirror(blocks: &Blocks, component: Component, block: &Block) -> Option<Found> {
    if blocks.straight_share(block) < 0.9 || !isotropic(blocks, block) {
        return None;
    }
    let (first, _, (cosine, last)) = shape(blocks, block)?;
    if first < 0.02 {
        return None;
    }
    let suspect = if last < 1.3 && (0.9..1.02 / first).contains(&(last / cosine)) {
        Suspect::CosineTooMuch
    } else if first * last > 1.0 {
        Suspect::CosineTooLittle
    } else {
        return None;
    };
    let evidence = "mirroring reflection does not rise towards grazing incidence as it must".to_owned();
    Some(Found { component, suspect, confidence: Confidence::Likely, evidence })
}

/// Light that leaves, transmitted and reflected, in proportion to the cosine of incidence, or to its inverse: with the
/// factor undone nothing depends on the angle any more, which is no accident.
fn losses(blocks: &Blocks, transmission: Component, reflection: Component) -> Option<Suspect> {
    let (t, r) = (blocks.get(transmission)?, blocks.get(reflection)?);
    // Only light that keeps its angle carries the cosine of its incidence.
    if blocks.straight_share(t) < 0.5 && blocks.straight_share(r) < 0.5 {
        return None;
    }
    let sums: Vec<f64> = t.tau.iter().zip(&r.tau).map(|(t, r)| t + r).collect();
    let spread = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
        if mean > 0.0 { variance.sqrt() / mean } else { f64::INFINITY }
    };
    let with = |f: fn(f64, f64) -> f64| sums.iter().zip(&blocks.cosine).map(|(s, c)| f(*s, *c)).collect::<Vec<_>>();
    let (much, little) = (with(|s, c| s / c), with(|s, c| s * c));
    let plausible = |values: &[f64]| values.iter().copied().fold(0.0, f64::max) < 1.03;
    if spread(&sums) < 0.15 {
        None
    } else if spread(&much) < 0.04 && plausible(&much) {
        Some(Suspect::CosineTooMuch)
    } else if spread(&little) < 0.04 {
        Some(Suspect::CosineTooLittle)
    } else {
        None
    }
}
