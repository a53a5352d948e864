//! Connection to a catalogue's file, used by all other files of this folder.

use super::CatalogueError;
use super::index::Index;
use crate::compute::btdf::Dataset;
use rusqlite::{Connection, Transaction, TransactionBehavior};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::{Arc, Weak};

/// Connection to the database file of a catalogue. It can move between threads; several threads open one each.
#[derive(Debug)]
pub struct Catalogue {
    pub(super) db: Connection,
    /// Decoded datasets, each with its hash, as long as they are in use.
    pub(super) decoded: RefCell<Vec<(String, Weak<Dataset>)>>,
    /// Datasets used most recently, newest at the end.
    pub(super) recent: RefCell<VecDeque<Arc<Dataset>>>,
    /// Computed datasets that cannot be stored because the file is read-only, with the keys of product and state.
    pub(super) held: RefCell<Vec<([String; 2], Arc<Dataset>)>>,
    /// Search index, with the revision of the database from which it was made.
    pub(super) index: RefCell<Option<(Stamp, Arc<Index>)>>,
    /// Keys of the built-in products that were damaged, and that this connection has restored.
    pub(super) restored: RefCell<Vec<String>>,
}

/// Revision of the database as one connection sees it: counters of changes by others (`PRAGMA data_version`) and by
/// itself.
pub(super) type Stamp = (i64, u64);

impl Catalogue {
    /// Creates the catalogue connection for an open database, with empty caches.
    pub(super) fn of(db: Connection) -> Self {
        // Verifying one product takes more statements than are kept by default.
        db.set_prepared_statement_cache_capacity(64);
        Self {
            db,
            decoded: RefCell::default(),
            recent: RefCell::default(),
            held: RefCell::default(),
            index: RefCell::default(),
            restored: RefCell::default(),
        }
    }

    /// Begins a write transaction. It is immediate: it waits for another writer at its start, not in the middle.
    pub(super) fn change(&mut self) -> Result<Transaction<'_>, CatalogueError> {
        Ok(self.db.transaction_with_behavior(TransactionBehavior::Immediate)?)
    }
}
