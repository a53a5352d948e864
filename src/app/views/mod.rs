//! The tiles. Each view is a file with its own [`State`](btdf::State) (what only the tile knows), `Input` (borrowed
//! data), `Action` (what the user asked for), `show` and `csv`. Views change nothing but their own state; pictures are
//! rebuilt only when the input's `revision` or the tile's own settings change.

pub mod accuracy;
pub mod btdf;
pub mod control;
pub mod difference;
pub mod lid;
pub mod room;
pub mod section;
pub mod sky;
pub mod states;
pub mod transmittance;

use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Btdf, Indicatrices, Scattered};

/// The data, when they are of a list of incident directions that are no lattice's: these have no cells of their own.
fn listed(btdf: &Btdf) -> Option<&Indicatrices> {
    match &btdf.scattered {
        Some(Scattered::Directions(data)) if data.lattice().is_none() => Some(data),
        _ => None,
    }
}

/// Cells to draw incidence by: the data's own; for listed directions fine ones, each with its nearest direction.
fn incident_cells(btdf: &Btdf) -> RingBasis {
    if listed(btdf).is_some() { RingBasis::equal_area(20) } else { btdf.incident_basis() }
}

/// A value kept until its key changes.
#[derive(Debug, Clone)]
pub struct Cache<K, V>(Option<(K, V)>);

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self(None)
    }
}

impl<K: PartialEq, V> Cache<K, V> {
    /// What is kept, of whatever key.
    pub fn last(&self) -> Option<&V> {
        self.0.as_ref().map(|(_, value)| value)
    }

    /// The kept value, or a new one when the key is another.
    pub fn get(&mut self, key: K, make: impl FnOnce() -> V) -> &V {
        if self.0.as_ref().is_none_or(|(old, _)| *old != key) {
            self.0 = None;
        }
        &self.0.get_or_insert_with(|| (key, make())).1
    }
}
