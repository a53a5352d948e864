//! Commands of the table in the import sheet: select rows, group or separate files, name states, resolve ambiguities.

use super::proposal::{ImportFields, Row, StateWords};
use crate::texts::{Text, catalogue as text};

/// Selection mode of a click on a row of the import table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choose {
    /// Select this row only.
    Only,
    /// Add this row to the selection, or remove it.
    Also,
    /// Select all rows from the one selected last to this one.
    UpTo,
}

/// Descriptive text that the user can type once for all selected products.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Word {
    /// Name of the maker.
    Manufacturer,
    /// Kind of system.
    Kind,
    /// Tags by which the products are found.
    Tags,
    /// Person or body that measured or computed the data.
    Author,
    /// Licence of the data.
    License,
}

impl Word {
    /// All these texts, in the order of the import sheet.
    pub const ALL: [Self; 5] = [Self::Manufacturer, Self::Kind, Self::Tags, Self::Author, Self::License];

    /// Returns the label of the text's field.
    pub const fn label(self) -> Text {
        match self {
            Self::Manufacturer => text::MANUFACTURER,
            Self::Kind => text::KIND,
            Self::Tags => text::TAGS,
            Self::Author => text::AUTHOR,
            Self::License => text::LICENSE,
        }
    }

    /// Returns this text among the descriptive texts of a product, to be changed.
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

/// Command about the table of the import sheet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Step {
    /// Select the row of a state.
    Choose(Row, Choose),
    /// Select all states of a product, or deselect them.
    ChooseProduct(usize, Choose),
    /// Select all rows; none if all are selected.
    ChooseAll,
    /// Collapse or expand the states of a product.
    Fold(usize),
    /// Make the selected files the states of one product.
    Together,
    /// Make each selected file a separate product.
    Separate,
    /// Make the selected files states of the product with this index.
    StatesOf(usize),
    /// Set name and angle of a state.
    Name(Row, StateWords),
    /// Set a descriptive text of all products with a selected row.
    Word(Word, String),
    /// Accept the proposed grouping of the files of the product with this index.
    Settle(usize),
    /// Accept the proposed grouping of the files of all products.
    SettleAll,
}
