//! Changes to products of the catalogue, as undo and redo know them.

use super::error::AppError;
use super::import::ImportFields;
use super::shelf::Shelf;
use crate::catalogue::{Product, Words};

/// A change to a product of the catalogue: kept so that undo can take it back and redo make it again.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// Out of sight.
    Deleted {
        /// Key of the product.
        key: String,
        /// Its name.
        name: String,
    },
    /// Other words.
    Described {
        /// Key of the product.
        key: String,
        /// Words before.
        before: Words,
        /// Words after.
        after: Words,
    },
}

impl Change {
    /// Makes the change, or takes it back.
    ///
    /// # Errors
    /// Of the catalogue.
    pub fn make(&self, shelf: &dyn Shelf, forth: bool) -> Result<(), AppError> {
        match (self, forth) {
            (Self::Deleted { key, .. }, true) => shelf.delete(key),
            (Self::Deleted { key, .. }, false) => shelf.restore(key),
            (Self::Described { key, after, .. }, true) => shelf.describe(key, after),
            (Self::Described { key, before, .. }, false) => shelf.describe(key, before),
        }
    }
}

/// The sheet for the words about a product.
#[derive(Debug, Clone, PartialEq)]
pub struct Editing {
    /// Key of the product.
    pub key: String,
    /// Built-in products keep their words.
    pub builtin: bool,
    /// As stored.
    pub before: Words,
    /// As typed.
    pub fields: ImportFields,
}

impl Editing {
    /// Of a product as it is stored.
    pub fn of(product: &Product) -> Self {
        let before = Words {
            name: product.name.clone(),
            manufacturer: product.manufacturer.clone(),
            kind: product.kind.clone(),
            tags: product.tags.clone(),
        };
        let fields = ImportFields {
            name: before.name.clone(),
            manufacturer: before.manufacturer.clone(),
            kind: before.kind.clone(),
            tags: before.tags.join(", "),
        };
        Self { key: product.key.clone(), builtin: product.builtin, before, fields }
    }

    /// The words as typed.
    pub fn words(&self) -> Words {
        Words {
            name: self.fields.name.trim().to_owned(),
            manufacturer: self.fields.manufacturer.trim().to_owned(),
            kind: self.fields.kind.trim().to_owned(),
            tags: self.fields.tag_list(),
        }
    }
}
