//! Repairs by name: what is done, to which functions of which band; their words in files, and how they are undone.

use crate::compute::btdf::Component;
use std::fmt;
use std::str::FromStr;

/// What is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RepairKind {
    /// Up and down exchanged, for incident and emergent light.
    TurnUpsideDown,
    /// Left and right exchanged.
    MirrorLeftRight,
    /// Turned by 180° about the normal.
    TurnHalfRound,
    /// The blocks named for outside and inside exchanged.
    SwapSides,
    /// Incident and emergent directions exchanged.
    Transpose,
    /// Percent made fractions.
    DivideBy100,
    /// Fractions made percent; undoes [`Self::DivideBy100`].
    MultiplyBy100,
    /// Values divided by the cosine of the emergent angle.
    RemoveCosine,
    /// Values multiplied by the cosine of the emergent angle.
    MultiplyCosine,
    /// Values divided by the projected solid angle of the emergent cell.
    RemoveSolidAngle,
    /// Values multiplied by the projected solid angle of the emergent cell.
    MultiplySolidAngle,
    /// The block left out.
    DropBlock,
    /// The block made from its counterpart by reciprocity.
    DeriveByReciprocity,
    /// Values below zero set to zero.
    ClampNegative,
}

impl RepairKind {
    /// All kinds.
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

    /// The word in files and on the command line.
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

    /// What a button says.
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

    /// The kind that undoes this one; `None` where values are lost.
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

/// Which bands a repair is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BandScope {
    /// Visible, and solar where there is one.
    Both,
    /// The visible band.
    Visible,
    /// The solar band.
    Solar,
}

/// Which functions a repair is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BlockScope {
    /// All that are there.
    All,
    /// Both transmissions.
    Transmission,
    /// Both reflections.
    Reflection,
    /// One function.
    One(Component),
}

impl BlockScope {
    /// Is a function meant?
    pub fn holds(self, component: Component) -> bool {
        let transmission = component.is_transmission();
        match self {
            Self::All => true,
            Self::Transmission => transmission,
            Self::Reflection => !transmission,
            Self::One(one) => one == component,
        }
    }

    /// The word in files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Transmission => "transmission",
            Self::Reflection => "reflection",
            Self::One(component) => component.key(),
        }
    }
}

/// One repair. Its text is `KIND`, `KIND:BLOCKS` or `KIND:BAND.BLOCKS`, e.g. `transpose:visible.transmission_back`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Repair {
    /// What is done.
    pub kind: RepairKind,
    /// To which bands.
    pub bands: BandScope,
    /// To which functions.
    pub blocks: BlockScope,
}

impl Repair {
    /// A repair of all functions of both bands.
    pub const fn whole(kind: RepairKind) -> Self {
        Self { kind, bands: BandScope::Both, blocks: BlockScope::All }
    }

    /// The repair that undoes this one; `None` where values are lost and only the source has them.
    pub fn inverse(self) -> Option<Self> {
        Some(Self { kind: self.kind.inverse()?, ..self })
    }

    /// What a button says: the kind, and the functions where not all are meant.
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

/// Not the name of a repair.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no repair '{0}'; expected KIND[:[BAND.]BLOCKS], KIND one of {kinds}", kinds = kinds())]
pub struct NoRepair(String);

fn kinds() -> String {
    RepairKind::ALL.map(RepairKind::word).join(", ")
}

impl FromStr for Repair {
    type Err = NoRepair;

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

/// The word before the list of repairs in a text on provenance.
const MARK: &str = "repaired: ";

/// A text on provenance with repairs added to those that it already records.
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

/// The text without its record, and the repairs recorded, in the order in which they were made.
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
