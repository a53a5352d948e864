//! The views of the tiles. Each view is a file with its own [`State`](btdf::State) (what only the tile knows), `Input`
//! (borrowed data), `Action` (request of the user), `show` and `csv`. Views change nothing but their own state;
//! pictures are rebuilt only when the input's `revision` or the tile's own settings change.

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

/// Cached value that is kept until its key changes.
#[derive(Debug, Clone)]
pub struct Cache<K, V>(Option<(K, V)>);

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self(None)
    }
}

impl<K: PartialEq, V> Cache<K, V> {
    /// Returns the cached value, whatever its key.
    pub fn last(&self) -> Option<&V> {
        self.0.as_ref().map(|(_, value)| value)
    }

    /// Returns the cached value, or makes it if the key has changed.
    pub fn get(&mut self, key: K, make: impl FnOnce() -> V) -> &V {
        if self.0.as_ref().is_none_or(|(old, _)| *old != key) {
            self.0 = None;
        }
        &self.0.get_or_insert_with(|| (key, make())).1
    }
}
