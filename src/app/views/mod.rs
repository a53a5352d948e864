//! The views of the tiles. Each view is a file with a [`State`](btdf::State) (display settings and caches between
//! frames), `Input` (borrowed data), `Action` (request of the user), `show` (drawing) and `csv` (numbers as a table).
//! Views change nothing except their `State`; pictures are made again only if the input's `revision` or a display
//! setting changes.

pub mod accuracy;
pub mod btdf;
pub mod calendar;
pub mod choose;
pub mod control;
pub mod difference;
pub mod lid;
pub mod room;
pub mod section;
pub mod sky;
pub mod states;
pub mod transmittance;
pub mod year;

use crate::drawing::hemisphere::{incident_cells, listed};

/// Cached value, which is computed again when its key changes.
#[derive(Debug, Clone)]
pub struct Cache<K, V>(Option<(K, V)>);

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self(None)
    }
}

impl<K: PartialEq, V> Cache<K, V> {
    /// Returns the cached value, whatever its key; `None` if there is none.
    pub fn last(&self) -> Option<&V> {
        self.0.as_ref().map(|(_, value)| value)
    }

    /// Returns the cached value for a key, computed by `make` if the key has changed.
    pub fn get(&mut self, key: K, make: impl FnOnce() -> V) -> &V {
        if self.0.as_ref().is_none_or(|(old, _)| *old != key) {
            self.0 = None;
        }
        &self.0.get_or_insert_with(|| (key, make())).1
    }
}
