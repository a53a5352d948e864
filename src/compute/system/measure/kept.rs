//! What is made once for a division of the hemisphere and kept for the next direction.

use crate::compute::basis::RingBasis;
use std::sync::{Arc, Mutex, PoisonError};

/// Divisions that are kept; the oldest goes first.
const MOST: usize = 4;

/// Things made for some cells, each with its cells.
pub struct Kept<T>(Mutex<Vec<(RingBasis, Arc<T>)>>);

impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T> Kept<T> {
    /// What belongs to these cells. Others wait while it is made.
    pub fn get(&self, cells: &RingBasis, make: impl FnOnce() -> T) -> Arc<T> {
        // What is kept is whole even if another thread has failed while it held the lock.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, found)) = kept.iter().find(|(known, _)| known == cells) {
            return found.clone();
        }
        let made = Arc::new(make());
        if kept.len() == MOST {
            kept.remove(0);
        }
        kept.push((cells.clone(), made.clone()));
        made
    }
}
