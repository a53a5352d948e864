//! Changes to products of the catalogue, as undo and redo know them, and the sheet in which they are made.

use super::error::AppError;
use super::import::{ImportFields, StateWords};
use super::shelf::Shelf;
use crate::catalogue::{Event, Product, Replacement, Snapshot, StateName, Words};
use crate::texts::catalogue as text;
use std::sync::Arc;

/// A change to a product of the catalogue: kept so that undo can take it back and redo make it again.
#[derive(Debug, Clone)]
pub enum Change {
    /// Out of sight.
    Deleted {
        /// Key of the product.
        key: String,
        /// Its name.
        name: String,
    },
    /// Its star was set or taken.
    Starred {
        /// Key of the product.
        key: String,
        /// Set, not taken.
        on: bool,
    },
    /// Products were put into a collection, or taken out.
    Collected {
        /// Name of the collection.
        name: String,
        /// Keys of the products, none of which was there before.
        products: Vec<String>,
        /// In, not out.
        put: bool,
    },
    /// A folder of packages is subscribed to, or no more.
    Subscribed {
        /// The folder.
        folder: String,
        /// Subscribed, not ended.
        on: bool,
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
    /// Other names and angles of its states.
    Named {
        /// Key of the product.
        key: String,
        /// Before, in the order of the states.
        before: Vec<StateName>,
        /// After.
        after: Vec<StateName>,
    },
    /// Other data of some states.
    Replaced {
        /// Key of the product.
        key: String,
        /// All of it before.
        before: Arc<Snapshot>,
        /// What takes whose place.
        list: Arc<Vec<Replacement>>,
    },
}

impl Change {
    /// Does any figure hang on it?
    pub const fn is_mark(&self) -> bool {
        matches!(self, Self::Starred { .. } | Self::Collected { .. } | Self::Subscribed { .. })
    }

    /// Makes the change, or takes it back.
    ///
    /// # Errors
    /// Of the catalogue.
    pub fn make(&self, shelf: &dyn Shelf, forth: bool) -> Result<(), AppError> {
        match (self, forth) {
            (Self::Deleted { key, .. }, true) => shelf.delete(key),
            (Self::Deleted { key, .. }, false) => shelf.restore(key),
            (Self::Starred { key, on }, _) => shelf.set_favourite(key, *on == forth),
            (Self::Collected { name, products, put }, _) => shelf.collect(name, products, *put == forth),
            (Self::Subscribed { folder, on }, _) if *on == forth => shelf.subscribe(folder),
            (Self::Subscribed { folder, .. }, _) => shelf.unsubscribe(folder).map(|_| ()),
            (Self::Described { key, after, .. }, true) => shelf.describe(key, after),
            (Self::Described { key, before, .. }, false) => shelf.describe(key, before),
            (Self::Named { key, after, .. }, true) => shelf.name_states(key, after),
            (Self::Named { key, before, .. }, false) => shelf.name_states(key, before),
            (Self::Replaced { key, list, .. }, true) => shelf.replace_states(key, list),
            (Self::Replaced { before, .. }, false) => shelf.put_back(before),
        }
    }
}

/// Everything that the sheet of a product shows.
#[derive(Debug, Clone)]
pub struct Looked {
    /// The product.
    pub product: Arc<Product>,
    /// What happened to it, the last first.
    pub history: Vec<Event>,
    /// Paths of the files that it was read from.
    pub paths: Vec<String>,
    /// The folder of packages that it comes from; `None` for others.
    pub subscribed: Option<String>,
}

/// What reading the files of a product again gave.
#[derive(Debug, Clone)]
pub struct Reread {
    /// What is not as it was, a line a state.
    pub told: Vec<String>,
    /// The change that takes it; `None` where all is as it was.
    pub change: Option<Change>,
}

/// The sheet for a product.
#[derive(Debug, Clone)]
pub struct Editing {
    /// Key of the product.
    pub key: String,
    /// What is known about it.
    pub looked: Looked,
    /// As stored.
    pub before: Words,
    /// As typed.
    pub fields: ImportFields,
    /// Its states as typed.
    pub states: Vec<StateWords>,
    /// What reading its files again gave.
    pub reread: Option<Reread>,
}

impl Editing {
    /// Of a product as it is stored.
    pub fn of(looked: Looked) -> Self {
        let product = &looked.product;
        let before = Words {
            name: product.name.clone(),
            manufacturer: product.manufacturer.clone(),
            kind: product.kind.clone(),
            tags: product.tags.clone(),
            license: product.license.clone(),
        };
        let fields = ImportFields {
            name: before.name.clone(),
            manufacturer: before.manufacturer.clone(),
            kind: before.kind.clone(),
            tags: before.tags.join(", "),
            license: before.license.clone(),
            author: product.provenance.author.clone(),
        };
        let words = |name: &StateName| StateWords {
            angle: name.value.map(|value| value.to_string()).unwrap_or_default(),
            name: name.label.clone(),
        };
        let states = names(product).iter().map(words).collect();
        Self { key: product.key.clone(), before, fields, states, reread: None, looked }
    }

    /// Does nobody change it here: built in, or of a folder that is subscribed to?
    pub fn fixed(&self) -> bool {
        self.looked.product.builtin || self.looked.subscribed.is_some()
    }

    /// The words as typed.
    pub fn words(&self) -> Words {
        Words {
            name: self.fields.name.trim().to_owned(),
            manufacturer: self.fields.manufacturer.trim().to_owned(),
            kind: self.fields.kind.trim().to_owned(),
            tags: self.fields.tag_list(),
            license: self.fields.license.trim().to_owned(),
        }
    }

    /// What is wrong with what was typed, in a sentence.
    pub fn problem(&self) -> Option<String> {
        if self.fields.name.trim().is_empty() {
            return Some(text::NEEDS_A_NAME.into());
        }
        let wrong = |words: &&StateWords| !words.angle.trim().is_empty() && words.number().is_none();
        let wrong = self.states.iter().find(wrong)?;
        Some(text::no_angle(wrong.angle.trim()))
    }

    /// The changes that what was typed asks for.
    pub fn changes(&self) -> Vec<Change> {
        let mut list = Vec::new();
        let (key, after) = (self.key.clone(), self.words());
        if after != self.before {
            list.push(Change::Described { key: key.clone(), before: self.before.clone(), after });
        }
        let before = names(&self.looked.product);
        let name = |words: &StateWords| StateName { label: words.name.trim().to_owned(), value: words.number() };
        let after: Vec<StateName> = self.states.iter().map(name).collect();
        if after != before {
            list.push(Change::Named { key, before, after });
        }
        list
    }
}

/// What the states of a product are called; a label that only says the key is none.
fn names(product: &Product) -> Vec<StateName> {
    let label =
        |state: &crate::catalogue::State| if state.label == state.key { String::new() } else { state.label.clone() };
    product.states.iter().map(|state| StateName { label: label(state), value: state.value }).collect()
}
