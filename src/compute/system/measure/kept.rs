//! Caches of results that are computed once and reused for the next direction.
//!
//! The computation is parallel, and so may be the calls for it. A thread of the common pool that waits for its parts
//! takes up other work meanwhile: perhaps another direction, which would wait for the result that this thread is
//! computing, a deadlock. So the result is computed in a separate pool, while the calling thread sleeps.

use crate::compute::basis::RingBasis;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// Maximum number of bases whose results are cached; the oldest is dropped first. Chosen: memory only, no effect on
/// results.
const MOST: usize = 8;

/// Cell for a result that is computed once, by the first thread that needs it.
#[derive(Debug)]
pub struct Once<T>(OnceLock<T>);

impl<T> Default for Once<T> {
    fn default() -> Self {
        Self(OnceLock::new())
    }
}

impl<T: Send> Once<T> {
    /// Returns the result, which the first call computes by `make`; other threads wait for it.
    pub fn get(&self, make: impl FnOnce() -> T + Send) -> &T {
        self.0.get_or_init(|| run_in_new_pool(make))
    }
}

impl<T> Once<T> {
    /// Returns the memory of the result, which `of` counts; 0 before it is computed. \[bytes\]
    pub fn bytes(&self, of: impl FnOnce(&T) -> usize) -> usize {
        self.0.get().map_or(0, of)
    }
}

/// Cache of results that depend on a division of the hemisphere into cells (a basis), one result per basis.
pub struct Kept<T>(Mutex<Vec<(RingBasis, Arc<T>)>>);

impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> Kept<T> {
    /// Creates an empty cache.
    pub const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// Returns the memory of all results, each of which `of` counts. \[bytes\]
    pub fn bytes(&self, of: impl Fn(&T) -> usize) -> usize {
        self.lock().iter().map(|(_, result)| of(result)).sum()
    }

    /// Locks the results, which are complete even if another thread has failed while it held the lock.
    fn lock(&self) -> MutexGuard<'_, Vec<(RingBasis, Arc<T>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: Send> Kept<T> {
    /// Returns the result for the basis `cells`, which the first call computes by `make`; other threads wait for it.
    pub fn get(&self, cells: &RingBasis, make: impl FnOnce() -> T + Send) -> Arc<T> {
        let mut kept = self.lock();
        if let Some((_, found)) = kept.iter().find(|(known, _)| known == cells) {
            return found.clone();
        }
        let made = Arc::new(run_in_new_pool(make));
        if kept.len() == MOST {
            kept.remove(0);
        }
        kept.push((cells.clone(), made.clone()));
        made
    }
}

/// Computes a result in a separate thread pool, while the calling thread sleeps.
fn run_in_new_pool<T: Send>(make: impl FnOnce() -> T + Send) -> T {
    let threads = rayon::current_num_threads();
    let work = move || match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(make),
        // No more threads available: one has to do.
        Err(_) => make(),
    };
    let made = std::thread::scope(|scope| scope.spawn(work).join());
    made.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;

    #[test]
    fn parallel_work_may_ask_for_what_is_made_in_parallel() {
        let (once, kept) = (Once::default(), Kept::default());
        let cells = RingBasis::tregenza();
        let make = || (0..2000_u64).into_par_iter().map(|k| (0..500).fold(k, |a, b| a ^ (b * k))).sum::<u64>();
        let found: Vec<(u64, u64)> =
            (0..100).into_par_iter().map(|_| (*once.get(make), *kept.get(&cells, make))).collect();
        assert!(found.iter().all(|pair| *pair == (make(), make())));
    }
}
