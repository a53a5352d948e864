//! Repairs of datasets: kind, bands and functions; their keys in files, and their inverses.

use crate::compute::btdf::Component;
use std::fmt;
use std::str::FromStr;

/// Kind of repair of a dataset's functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RepairKind {
    /// Exchange of up and down, for incident and emergent light.
    TurnUpsideDown,
    /// Exchange of left and right.
    MirrorLeftRight,
    /// Rotation by 180° about the normal.
    TurnHalfRound,
    /// Exchange of the functions of outside and inside.
    SwapSides,
    /// Exchange of incident and emergent directions.
    Transpose,
    /// Division of the values by 100: conversion from percent to fractions.
    DivideBy100,
    /// Multiplication of the values by 100; undoes [`Self::DivideBy100`].
    MultiplyBy100,
    /// Division of the values by the cosine of the emergent angle.
    RemoveCosine,
    /// Multiplication of the values by the cosine of the emergent angle.
    MultiplyCosine,
    /// Division of the values by the projected solid angle of the emergent cell.
    RemoveSolidAngle,
    /// Multiplication of the values by the projected solid angle of the emergent cell.
    MultiplySolidAngle,
    /// Removal of a function from the dataset.
    DropBlock,
    /// Derivation of a transmission from that of the other side by reciprocity.
    DeriveByReciprocity,
    /// Replacement of negative values by zero.
    ClampNegative,
}

impl RepairKind {
    /// All kinds of repair.
    pub const ALL: [Self; 14] = [
        Self::TurnUpsideDown,
        Self::MirrorLeftRight,
        Self::TurnHalfRound,
        Self::SwapSides,
        Self::Transpose,
        Self::DivideBy100,
        Self::MultiplyBy100,
        Self::RemoveCosine,
        Self::MultiplyCosine,
        Self::RemoveSolidAngle,
        Self::MultiplySolidAngle,
        Self::DropBlock,
        Self::DeriveByReciprocity,
        Self::ClampNegative,
    ];

    /// Returns the key of the kind in files and on the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::TurnUpsideDown => "turn-upside-down",
            Self::MirrorLeftRight => "mirror-left-right",
            Self::TurnHalfRound => "turn-half-round",
            Self::SwapSides => "swap-sides",
            Self::Transpose => "transpose",
            Self::DivideBy100 => "divide-by-100",
            Self::MultiplyBy100 => "multiply-by-100",
            Self::RemoveCosine => "remove-cosine",
            Self::MultiplyCosine => "multiply-cosine",
            Self::RemoveSolidAngle => "remove-solid-angle",
            Self::MultiplySolidAngle => "multiply-solid-angle",
            Self::DropBlock => "drop-block",
            Self::DeriveByReciprocity => "derive-by-reciprocity",
            Self::ClampNegative => "clamp-negative",
        }
    }

    /// Returns the label of a button for this kind.
    pub const fn label(self) -> &'static str {
        match self {
            Self::TurnUpsideDown => "Turn upside down",
            Self::MirrorLeftRight => "Mirror left and right",
            Self::TurnHalfRound => "Turn by 180°",
            Self::SwapSides => "Swap outside and inside",
            Self::Transpose => "Exchange incident and emergent",
            Self::DivideBy100 => "Divide by 100",
            Self::MultiplyBy100 => "Multiply by 100",
            Self::RemoveCosine => "Divide by the cosine",
            Self::MultiplyCosine => "Multiply by the cosine",
            Self::RemoveSolidAngle => "Divide by the solid angle",
            Self::MultiplySolidAngle => "Multiply by the solid angle",
            Self::DropBlock => "Leave the block out",
            Self::DeriveByReciprocity => "Derive by reciprocity",
            Self::ClampNegative => "Set negative values to 0",
        }
    }

    /// Returns the kind that undoes this one; `None` if values are lost.
    pub const fn inverse(self) -> Option<Self> {
        Some(match self {
            Self::TurnUpsideDown | Self::MirrorLeftRight | Self::TurnHalfRound | Self::SwapSides | Self::Transpose => {
                self
            }
            Self::DivideBy100 => Self::MultiplyBy100,
            Self::MultiplyBy100 => Self::DivideBy100,
            Self::RemoveCosine => Self::MultiplyCosine,
            Self::MultiplyCosine => Self::RemoveCosine,
            Self::RemoveSolidAngle => Self::MultiplySolidAngle,
            Self::MultiplySolidAngle => Self::RemoveSolidAngle,
            Self::DropBlock | Self::DeriveByReciprocity | Self::ClampNegative => return None,
        })
    }
}

/// Spectral bands that a repair covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BandScope {
    /// Visible band, and solar band if there is one.
    Both,
    /// Visible band only.
    Visible,
    /// Solar band only.
    Solar,
}

/// Functions (transmissions, reflections) of a band that a repair covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BlockScope {
    /// All functions of the band.
    All,
    /// Transmissions from both sides.
    Transmission,
    /// Reflections of both sides.
    Reflection,
    /// One function of one side.
    One(Component),
}

impl BlockScope {
    /// Whether the scope contains a function.
    pub fn holds(self, component: Component) -> bool {
        let transmission = component.is_transmission();
        match self {
            Self::All => true,
            Self::Transmission => transmission,
            Self::Reflection => !transmission,
            Self::One(one) => one == component,
        }
    }

    /// Returns the key of the functions in files and on the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Transmission => "transmission",
            Self::Reflection => "reflection",
            Self::One(component) => component.key(),
        }
    }
}

/// Repair of functions of a dataset. Its text form is `KIND`, `KIND:BLOCKS` or `KIND:BAND.BLOCKS`, e.g.
/// `transpose:visible.transmission_back`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Repair {
    /// Kind of the repair.
    pub kind: RepairKind,
    /// Spectral bands that are repaired.
    pub bands: BandScope,
    /// Functions that are repaired.
    pub blocks: BlockScope,
}

impl Repair {
    /// Creates a repair of all functions of both bands.
    pub const fn whole(kind: RepairKind) -> Self {
        Self { kind, bands: BandScope::Both, blocks: BlockScope::All }
    }

    /// Returns the repair that undoes this one; `None` if this one loses values, which only the source file still has.
    pub fn inverse(self) -> Option<Self> {
        Some(Self { kind: self.kind.inverse()?, ..self })
    }

    /// Returns the label of a button: the kind, and the functions unless all are covered.
    pub fn label(self) -> String {
        let blocks = match self.blocks {
            BlockScope::All => String::new(),
            blocks => format!(": {}", blocks.word().replace('_', " ")),
        };
        let band = match self.bands {
            BandScope::Solar => " (solar)",
            BandScope::Both | BandScope::Visible => "",
        };
        format!("{}{blocks}{band}", self.kind.label())
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let band = match self.bands {
            BandScope::Both => "",
            BandScope::Visible => "visible.",
            BandScope::Solar => "solar.",
        };
        match (self.bands, self.blocks) {
            (BandScope::Both, BlockScope::All) => f.write_str(self.kind.word()),
            (_, blocks) => write!(f, "{}:{band}{}", self.kind.word(), blocks.word()),
        }
    }
}

/// Error for a text that is not a valid repair.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no repair '{0}'; expected KIND[:[BAND.]BLOCKS], KIND one of {kinds}", kinds = kinds())]
pub struct NoRepair(String);

fn kinds() -> String {
    RepairKind::ALL.map(RepairKind::word).join(", ")
}

impl FromStr for Repair {
    type Err = NoRepair;

    /// Parses `KIND`, `KIND:BLOCKS` or `KIND:BAND.BLOCKS`.
    fn from_str(text: &str) -> Result<Self, NoRepair> {
        let unknown = || NoRepair(text.chars().take(80).collect());
        let (word, scope) = text.split_once(':').unwrap_or((text, "all"));
        let kind = RepairKind::ALL.into_iter().find(|kind| kind.word() == word).ok_or_else(unknown)?;
        let (band, blocks) = scope.split_once('.').map_or((None, scope), |(band, blocks)| (Some(band), blocks));
        let bands = match band {
            None => BandScope::Both,
            Some("visible") => BandScope::Visible,
            Some("solar") => BandScope::Solar,
            Some(_) => return Err(unknown()),
        };
        let mut scopes = vec![BlockScope::All, BlockScope::Transmission, BlockScope::Reflection];
        scopes.extend(Component::ALL.map(BlockScope::One));
        let blocks = scopes.into_iter().find(|scope| scope.word() == blocks).ok_or_else(unknown)?;
        Ok(Self { kind, bands, blocks })
    }
}

/// Marker that precedes the list of repairs in the text on a dataset's provenance.
const MARK: &str = "repaired: ";

/// Returns a text on a dataset's provenance with `repairs` added to those that it already records.
pub fn record(text: &str, repairs: &[Repair]) -> String {
    if repairs.is_empty() {
        return text.to_owned();
    }
    let (before, mut all) = recorded(text);
    all.extend(repairs);
    // Done and undone again leaves no trace, since nothing was changed.
    let mut k = 0;
    while k + 1 < all.len() {
        if all[k].inverse() == Some(all[k + 1]) {
            all.drain(k..k + 2);
            k = k.saturating_sub(1);
        } else {
            k += 1;
        }
    }
    if all.is_empty() {
        return before.to_owned();
    }
    let words = all.iter().map(Repair::to_string).collect::<Vec<_>>().join(", ");
    if before.is_empty() { format!("{MARK}{words}") } else { format!("{before}\n{MARK}{words}") }
}

/// Splits a text on a dataset's provenance into the text without the record of repairs, and the recorded repairs in the
/// order in which they were made.
pub fn recorded(text: &str) -> (&str, Vec<Repair>) {
    let Some(at) = text.rfind(MARK) else { return (text, Vec::new()) };
    let list: Option<Vec<Repair>> = text[at + MARK.len()..].split(", ").map(|word| word.trim().parse().ok()).collect();
    match list {
        Some(list) => (text[..at].trim_end(), list),
        None => (text, Vec::new()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_both_ways_and_inverses_undo() {
        for kind in RepairKind::ALL {
            for bands in [BandScope::Both, BandScope::Visible, BandScope::Solar] {
                for blocks in [BlockScope::All, BlockScope::Reflection, BlockScope::One(Component::ReflectionBack)] {
                    let repair = Repair { kind, bands, blocks };
                    assert_eq!(repair.to_string().parse(), Ok(repair));
                    if let Some(inverse) = repair.inverse() {
                        assert_eq!(inverse.inverse(), Some(repair));
                    }
                }
            }
        }
        assert!("turn".parse::<Repair>().is_err() && "transpose:infrared.all".parse::<Repair>().is_err());
    }

    #[test]
    fn records_are_read_back_and_cancel_out() {
        let turn = Repair::whole(RepairKind::TurnUpsideDown);
        let percent: Repair = "divide-by-100:solar.reflection".parse().unwrap();
        let text = record("goniophotometer", &[turn, percent]);
        assert_eq!(recorded(&text), ("goniophotometer", vec![turn, percent]));
        let text = record(&text, &[percent.inverse().unwrap()]);
        assert_eq!(recorded(&text).1, [turn]);
        assert_eq!(record(&text, &[turn]), "goniophotometer");
        assert_eq!(recorded("repaired: by hand"), ("repaired: by hand", vec![]));
    }
}
