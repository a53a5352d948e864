//! Undoable changes to products of the catalogue, and the data of the sheet (side panel) in which they are made.

use crate::app::catalogue::shelf::{Addition, Shelf};
use crate::app::import::proposal::{ImportFields, StateWords};
use crate::app::shell::error::AppError;
use crate::catalogue::{Event, Product, Replacement, Snapshot, StateName, Words};
use crate::texts::catalogue as text;
use std::sync::Arc;

/// Product added to the catalogue in this session, stored so that undo can remove it and redo can restore it.
pub(super) struct Added {
    /// Product that was added.
    pub(super) addition: Addition,
    /// Key of the product in the catalogue; `None` while it is not there.
    pub(super) key: Option<String>,
    /// Number of the message that says that it was added, if there was one.
    pub(super) message: Option<u64>,
}

/// Change of the catalogue, stored so that undo can revert it and redo make it again.
#[derive(Debug, Clone)]
pub enum Change {
    /// Deletion of a product, which can be restored.
    Deleted {
        /// Key of the product.
        key: String,
        /// Name of the product.
        name: String,
    },
    /// Star of a product that was set or removed.
    Starred {
        /// Key of the product.
        key: String,
        /// Whether the star was set.
        on: bool,
    },
    /// Addition of products to a collection, or their removal from it.
    Collected {
        /// Name of the collection.
        name: String,
        /// Keys of the products; none was in the collection before.
        products: Vec<String>,
        /// Whether the products were added.
        put: bool,
    },
    /// Start or end of the subscription to a folder of packages.
    Subscribed {
        /// Path of the folder.
        folder: String,
        /// Whether the subscription was started.
        on: bool,
    },
    /// Change of the descriptive texts of a product (name, maker, kind, …).
    Described {
        /// Key of the product.
        key: String,
        /// Texts before the change.
        before: Words,
        /// Texts after the change.
        after: Words,
    },
    /// Change of names and angles of a product's states.
    Named {
        /// Key of the product.
        key: String,
        /// Names before the change, in the order of the states.
        before: Vec<StateName>,
        /// Names after the change, in the order of the states.
        after: Vec<StateName>,
    },
    /// Replacement of the data of some states of a product.
    Replaced {
        /// Key of the product.
        key: String,
        /// Whole product before the change.
        before: Arc<Snapshot>,
        /// Replaced states with their new data.
        list: Arc<Vec<Replacement>>,
    },
}

impl Change {
    /// Whether the change has no effect on data and figures: stars, collections, subscriptions.
    pub const fn is_mark(&self) -> bool {
        matches!(self, Self::Starred { .. } | Self::Collected { .. } | Self::Subscribed { .. })
    }

    /// Makes the change in the catalogue if `forth`, else reverts it.
    ///
    /// # Errors
    /// Returns the errors of the catalogue.
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

/// Data of a product that its sheet shows: product, history, files.
#[derive(Debug, Clone)]
pub struct Looked {
    /// Product as stored in the catalogue.
    pub product: Arc<Product>,
    /// History of the product's changes, newest first.
    pub history: Vec<Event>,
    /// Paths of the files that the product was read from.
    pub paths: Vec<String>,
    /// Folder of packages that the product comes from; `None` for other products.
    pub subscribed: Option<String>,
}

impl Looked {
    /// Reads the data of a product (given by its key) from the catalogue.
    ///
    /// # Errors
    /// Returns the errors of the catalogue.
    pub fn read(shelf: &dyn Shelf, key: &str) -> Result<Self, AppError> {
        Ok(Self {
            product: shelf.product(key)?,
            subscribed: shelf.subscribed_folder(key)?,
            history: shelf.history(key)?,
            paths: shelf.source_paths(key)?,
        })
    }
}

/// Result of reading the files of a product again.
#[derive(Debug, Clone)]
pub struct Reread {
    /// Differences of the files from the stored product as text, one line per state.
    pub differences: Vec<String>,
    /// Change that applies the differences; `None` if there are none.
    pub change: Option<Change>,
}

/// State of the sheet (side panel) for editing a product.
#[derive(Debug, Clone)]
pub struct Editing {
    /// Key of the product.
    pub key: String,
    /// Stored product and its history.
    pub looked: Looked,
    /// Descriptive texts as stored in the catalogue.
    pub before: Words,
    /// Descriptive texts as the user has typed them.
    pub fields: ImportFields,
    /// Names and angles of the states as the user has typed them.
    pub states: Vec<StateWords>,
    /// Result of reading the product's files again.
    pub reread: Option<Reread>,
}

impl Editing {
    /// Creates the sheet for a product as it is stored.
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

    /// Whether the product cannot be changed here, because it is built in or comes from a subscribed folder.
    pub fn fixed(&self) -> bool {
        self.looked.product.builtin || self.looked.subscribed.is_some()
    }

    /// Returns the texts as typed, trimmed.
    pub fn words(&self) -> Words {
        Words {
            name: self.fields.name.trim().to_owned(),
            manufacturer: self.fields.manufacturer.trim().to_owned(),
            kind: self.fields.kind.trim().to_owned(),
            tags: self.fields.tag_list(),
            license: self.fields.license.trim().to_owned(),
        }
    }

    /// Returns the first error in the typed texts as a sentence; `None` if they are valid.
    pub fn problem(&self) -> Option<String> {
        if self.fields.name.trim().is_empty() {
            return Some(text::NEEDS_A_NAME.into());
        }
        let wrong = |words: &&StateWords| !words.angle.trim().is_empty() && words.number().is_none();
        let wrong = self.states.iter().find(wrong)?;
        Some(text::no_angle(wrong.angle.trim()))
    }

    /// Returns the changes that convert the stored product to the typed one.
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

/// Returns the names of the states of a product; a label that only repeats the key counts as empty.
fn names(product: &Product) -> Vec<StateName> {
    let label =
        |state: &crate::catalogue::State| if state.label == state.key { String::new() } else { state.label.clone() };
    product.states.iter().map(|state| StateName { label: label(state), value: state.value }).collect()
}
