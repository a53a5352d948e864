//! Hypotheses about what is wrong with a dataset; each is about all transmission and reflection functions of a band
//! together.

use super::blocks::{Blocks, Turn};
use super::evidence::Evidence;
use super::reading::{Factor, Part, Reading, as_it_is};
use super::repair::{BlockScope, RepairKind};
use crate::compute::btdf::Component;

/// Fault that functions of a dataset may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fault {
    /// Directions rotated or mirrored.
    Turned(Turn),
    /// Incident and emergent directions exchanged, e.g. because rows were labelled columns.
    Transposed,
    /// Functions of outside and inside exchanged.
    Swapped,
    /// Values multiplied or divided by a factor, e.g. a cosine.
    Factor(Factor),
    /// Copy: one transmission repeats that of the other side.
    Copied,
}

impl Fault {
    /// Returns the code of the finding that reports the fault.
    pub(super) const fn code(self) -> &'static str {
        match self {
            Self::Turned(Turn::LeftRight) => "mirrored-block",
            Self::Turned(_) => "upside-down-block",
            Self::Transposed => "transposed-block",
            Self::Swapped => "sides-swapped",
            Self::Factor(_) => "cosine-factor",
            Self::Copied => "copied-block",
        }
    }

    /// Returns the kind of repair that undoes the fault; `None` for a fault that is listed only as an alternative.
    pub(super) const fn repair(self) -> Option<RepairKind> {
        Some(match self {
            Self::Turned(Turn::LeftRight) => RepairKind::MirrorLeftRight,
            Self::Turned(Turn::HalfRound) => RepairKind::TurnHalfRound,
            Self::Turned(_) => RepairKind::TurnUpsideDown,
            Self::Transposed => RepairKind::Transpose,
            Self::Swapped => RepairKind::SwapSides,
            Self::Factor(Factor::CosineTooMuch) => RepairKind::RemoveCosine,
            Self::Factor(Factor::CosineTooLittle) => RepairKind::MultiplyCosine,
            Self::Factor(Factor::SolidAngle) => RepairKind::RemoveSolidAngle,
            Self::Factor(Factor::IncidentTooLittle | Factor::IncidentTooMuch) => return None,
            Self::Copied => RepairKind::DeriveByReciprocity,
        })
    }

    /// Returns the text that describes functions with this fault in messages.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Turned(Turn::LeftRight) => "mirrored left to right",
            Self::Turned(Turn::HalfRound) => "turned by 180° in azimuth (upside down)",
            Self::Turned(_) => "flipped upside down",
            Self::Transposed => "transposed (incident and emergent directions exchanged)",
            Self::Swapped => "swapped between outside and inside",
            Self::Factor(Factor::CosineTooMuch) => "multiplied by the cosine of the emergent angle",
            Self::Factor(Factor::CosineTooLittle) => "divided by the cosine of the emergent angle",
            Self::Factor(Factor::IncidentTooLittle) => "divided by the cosine of the incident angle",
            Self::Factor(Factor::IncidentTooMuch) => "multiplied by the cosine of the incident angle",
            Self::Factor(Factor::SolidAngle) => "multiplied by the projected solid angle of the emergent cells",
            Self::Copied => "a copy of the other side's",
        }
    }

    /// Returns the reading of one function's numbers with the fault undone.
    fn undone(self, part: Part) -> Part {
        match self {
            Self::Turned(turn) => Part { turn: Some(turn), ..part },
            Self::Transposed => Part { transposed: true, ..part },
            Self::Factor(factor) => Part { factor: Some(factor), ..part },
            // From the other side, whose names are turned by 180°.
            Self::Swapped => Part { source: other(part.source), turn: Some(Turn::HalfRound), ..part },
            Self::Copied => Part { source: other(part.source), transposed: true, ..part },
        }
    }
}

/// Returns the index of the same function (transmission or reflection) of the other side.
fn other(source: usize) -> usize {
    Component::ALL[source].other_side() as usize
}

/// Hypothesis: one fault of some functions of a band, as an explanation of all its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Hypothesis {
    /// Fault that is assumed.
    pub(super) fault: Fault,
    /// Functions that have the fault, as repairs name them.
    pub(super) scopes: Vec<BlockScope>,
    /// Reading of the numbers with the fault undone.
    pub(super) reading: Reading,
}

/// Returns the hypotheses about the functions of a band, with one fault each. `copied`: whether the transmissions, and
/// the reflections, of both sides have the same values, which neither a rotation nor a transposition produces.
pub(super) fn hypotheses(evidence: &Evidence, copied: [bool; 2]) -> Vec<Hypothesis> {
    let blocks = evidence.blocks;
    let lit: Vec<Component> = Component::ALL.into_iter().filter(|c| evidence.lit(*c as usize)).collect();
    let [through, back] = PAIRS.map(|pair| pair.iter().all(|component| lit.contains(component)));
    let copied = [copied[0] && through, copied[1] && back];
    let mut list = Vec::new();
    let mut put = |fault: Fault, meant: &[Component]| {
        list.extend(hypothesis(blocks, &lit, fault, meant));
    };
    let sets = sets(&lit);
    for set in &sets {
        // Of two equal blocks one alone did not move.
        let parted = |pair: usize| copied[pair] && PAIRS[pair].iter().filter(|c| set.contains(c)).count() == 1;
        if !parted(0) && !parted(1) {
            for turn in [Turn::UpDown, Turn::LeftRight, Turn::HalfRound] {
                put(Fault::Turned(turn), set);
            }
            put(Fault::Transposed, set);
        }
        for factor in
            [Factor::CosineTooMuch, Factor::CosineTooLittle, Factor::IncidentTooLittle, Factor::IncidentTooMuch]
        {
            put(Fault::Factor(factor), set);
        }
    }
    // Fluxes instead of luminances come out of a program, for all blocks alike.
    put(Fault::Factor(Factor::SolidAngle), &lit);
    for (pair, copied) in PAIRS.iter().zip(copied) {
        if pair.iter().all(|component| lit.contains(component)) && !copied {
            put(Fault::Swapped, pair);
        }
    }
    if copied[0] {
        PAIRS[0].iter().for_each(|component| put(Fault::Copied, &[*component]));
    }
    list
}

/// Pairs of the same function on both sides.
const PAIRS: [[Component; 2]; 2] = [
    [Component::TransmissionFront, Component::TransmissionBack],
    [Component::ReflectionFront, Component::ReflectionBack],
];

/// Returns the sets of functions that may have a fault in common: each function by itself, both transmissions, both
/// reflections, both of one side, all but one, all.
fn sets(lit: &[Component]) -> Vec<Vec<Component>> {
    let meant = |test: &dyn Fn(&Component) -> bool| lit.iter().copied().filter(|c| test(c)).collect::<Vec<_>>();
    let mut list: Vec<Vec<Component>> = Vec::new();
    let mut add = |set: Vec<Component>| {
        if !set.is_empty() && !list.contains(&set) {
            list.push(set);
        }
    };
    lit.iter().for_each(|one| add(vec![*one]));
    add(lit.to_vec());
    add(meant(&|c| c.is_transmission()));
    add(meant(&|c| !c.is_transmission()));
    add(meant(&|c| c.is_front()));
    add(meant(&|c| !c.is_front()));
    lit.iter().for_each(|one| add(meant(&|c| c != one)));
    list
}

/// Creates the hypothesis that the functions `meant` have the fault; `None` for a rotation of all or nearly all
/// functions, which the data cannot show.
fn hypothesis(blocks: &Blocks, lit: &[Component], fault: Fault, meant: &[Component]) -> Option<Hypothesis> {
    // Turned as a whole, a file agrees with itself as well as before: that is asked of who knows the product.
    // Turned but for one block, it does so as well as with that one turned alone, which is the simpler explanation.
    let whole = if lit.len() == 4 { 3 } else { lit.len() };
    if matches!(fault, Fault::Turned(_)) && meant.len() >= whole {
        return None;
    }
    let mut reading = as_it_is(blocks);
    for component in meant {
        let slot = *component as usize;
        reading[slot] = reading[slot].map(|part| fault.undone(part));
    }
    let all = |test: &dyn Fn(&Component) -> bool| {
        lit.iter().filter(|c| test(c)).count() == meant.len() && meant.iter().all(test) && meant.len() > 1
    };
    let scopes = if all(&|_| true) {
        vec![BlockScope::All]
    } else if all(&|c| c.is_transmission()) {
        vec![BlockScope::Transmission]
    } else if all(&|c| !c.is_transmission()) {
        vec![BlockScope::Reflection]
    } else {
        meant.iter().map(|component| BlockScope::One(*component)).collect()
    };
    Some(Hypothesis { fault, scopes, reading })
}
