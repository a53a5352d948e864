//! A connection to a catalogue's file, as every other file of this folder uses it.

use super::CatalogueError;
use crate::compute::btdf::Dataset;
use rusqlite::{Connection, Transaction, TransactionBehavior};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::Arc;

/// One connection to a catalogue. May move between threads; for use from several threads open one each.
#[derive(Debug)]
pub struct Catalogue {
    pub(super) db: Connection,
    /// The datasets used last, decoded, newest at the end.
    pub(super) recent: RefCell<VecDeque<(String, Arc<Dataset>)>>,
}

impl Catalogue {
    /// Begins a change. Immediate: it waits for another writer at the start, not in the middle.
    pub(super) fn change(&mut self) -> Result<Transaction<'_>, CatalogueError> {
        Ok(self.db.transaction_with_behavior(TransactionBehavior::Immediate)?)
    }
}
