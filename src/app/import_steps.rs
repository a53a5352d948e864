//! What can be done in the import sheet's table: choose rows, put files together or apart, name states, answer questions.

use super::import::{ImportFields, Row, StateWords};
use crate::texts::{Text, catalogue as text};

/// How a row is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choose {
    /// It alone.
    Only,
    /// It too, or no longer.
    Also,
    /// All from the one chosen last to it.
    UpTo,
}

/// A word about products that is typed once for all that are selected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Word {
    /// Maker.
    Manufacturer,
    /// Kind of system.
    Kind,
    /// Words to find it by.
    Tags,
    /// Who measured or computed.
    Author,
    /// On which terms the data may be passed on.
    License,
}

impl Word {
    /// All, in the order of the sheet.
    pub const ALL: [Self; 5] = [Self::Manufacturer, Self::Kind, Self::Tags, Self::Author, Self::License];

    /// What its field is called.
    pub const fn label(self) -> Text {
        match self {
            Self::Manufacturer => text::MANUFACTURER,
            Self::Kind => text::KIND,
            Self::Tags => text::TAGS,
            Self::Author => text::AUTHOR,
            Self::License => text::LICENSE,
        }
    }

    /// The text among the words of a product.
    pub const fn of(self, fields: &mut ImportFields) -> &mut String {
        match self {
            Self::Manufacturer => &mut fields.manufacturer,
            Self::Kind => &mut fields.kind,
            Self::Tags => &mut fields.tags,
            Self::Author => &mut fields.author,
            Self::License => &mut fields.license,
        }
    }
}

/// One thing to do with the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Step {
    /// Choose a state's row.
    Choose(Row, Choose),
    /// Choose all states of a product, or none any more.
    ChooseProduct(usize, Choose),
    /// Choose all rows; none where all are chosen.
    ChooseAll,
    /// Fold the states of a product away, or show them.
    Fold(usize),
    /// The files that are chosen are the states of one product.
    Together,
    /// Each file that is chosen is a product of its own.
    Apart,
    /// The files that are chosen are states of this product.
    StatesOf(usize),
    /// What a state is called.
    Name(Row, StateWords),
    /// A word about all products with a row that is chosen.
    Word(Word, String),
    /// The question about this product is answered: it is as proposed.
    Settle(usize),
    /// All questions are answered so.
    SettleAll,
}
