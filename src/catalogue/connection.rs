//! Connection to a catalogue's file, used by all other files of this folder.

use super::CatalogueError;
use super::index::Index;
use crate::compute::btdf::Dataset;
use rusqlite::{Connection, Transaction, TransactionBehavior};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::Arc;

/// Connection to a catalogue. It can move between threads; for use from several threads open one each.
#[derive(Debug)]
pub struct Catalogue {
    pub(super) db: Connection,
    /// Datasets used most recently, decoded, newest at the end.
    pub(super) recent: RefCell<VecDeque<(String, Arc<Dataset>)>>,
    /// Computed states that cannot be kept where the file lies, by the keys of product and state.
    pub(super) held: RefCell<Vec<([String; 2], Arc<Dataset>)>>,
    /// Search index, with the state of the file that it was made from.
    pub(super) index: RefCell<Option<(Stamp, Arc<Index>)>>,
    /// Keys of the built-in products that were damaged, and that this connection has restored.
    pub(super) restored: RefCell<Vec<String>>,
}

/// State of a file as one connection sees it: changes of others (`PRAGMA data_version`), and its own.
pub(super) type Stamp = (i64, u64);

impl Catalogue {
    pub(super) fn of(db: Connection) -> Self {
        // Verifying one product takes more statements than are kept by default.
        db.set_prepared_statement_cache_capacity(64);
        Self {
            db,
            recent: RefCell::default(),
            held: RefCell::default(),
            index: RefCell::default(),
            restored: RefCell::default(),
        }
    }

    /// Begins a change. Immediate: it waits for another writer at the start, not in the middle.
    pub(super) fn change(&mut self) -> Result<Transaction<'_>, CatalogueError> {
        Ok(self.db.transaction_with_behavior(TransactionBehavior::Immediate)?)
    }
}
