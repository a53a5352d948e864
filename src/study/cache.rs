//! Store of results for later computations: found by exact keys, within one limit of memory. What takes the least time to
//! compute again for its memory, and was not used for the longest time, goes first (GreedyDual-Size: Cao and Irani,
//! Cost-aware WWW proxy caching algorithms, USENIX Symposium on Internet Technologies and Systems 1997). Results in use
//! stay: without them in the store their memory would be the same, and the next computation would compute them again.

use std::any::Any;
use std::collections::HashMap;
use std::convert::Infallible;
use std::marker::PhantomData;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Divisor of a store's limit: results that are not in use may take this part of it, however large those in use are,
/// because small ones are needed beside a large one. Chosen: cost only, no effect on results.
const BESIDE: usize = 4;

/// Key of a result: the bits of all numbers on which it depends.
pub type Key = Vec<u64>;

/// Store of results of several kinds, shared between threads. Removing a result changes no later result: it is computed
/// again.
pub struct Store(Mutex<Stored>);

/// Results of a store with their memory.
struct Stored {
    /// Maximum memory of all results, as long as computations do not use more. \[bytes\]
    limit: usize,
    /// Memory of all results. \[bytes\]
    bytes: usize,
    /// Number of caches.
    caches: usize,
    /// Results by the number of their cache and by key.
    results: HashMap<(usize, Key), Entry>,
    /// Greatest score of the removed results; what is used from then on has a higher one. \[s/byte\]
    removed_score: f64,
}

/// Result in a store.
struct Entry {
    value: Arc<dyn Any + Send + Sync>,
    /// Memory. \[bytes\]
    bytes: usize,
    /// Time of its computation per memory, including that of results that it needed and that were not stored.
    /// \[s/byte\]
    cost: f64,
    /// Sum of the cost and of the score of what had been removed when it was last used. \[s/byte\]
    score: f64,
}

impl Entry {
    /// Returns the memory of a result that a computation, or another result, is using; 0 for others. \[bytes\]
    fn bytes_in_use(&self) -> usize {
        if Arc::strong_count(&self.value) > 1 { self.bytes } else { 0 }
    }
}

impl Store {
    /// Creates an empty store whose results take at most `limit` bytes, or more while computations use large ones.
    pub fn new(limit: usize) -> Self {
        Self(Mutex::new(Stored { limit, bytes: 0, caches: 0, results: HashMap::new(), removed_score: 0.0 }))
    }

    // What is stored is whole even if another thread has failed while it held the lock.
    fn lock(&self) -> MutexGuard<'_, Stored> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the memory of all results. \[bytes\]
    pub fn bytes(&self) -> usize {
        self.lock().bytes
    }

    /// Sets the maximum memory of all results \[bytes\], and removes results that are not in use until it is kept.
    pub fn set_limit(&self, limit: usize) {
        let mut stored = self.lock();
        stored.limit = limit;
        let removed = stored.within_limit();
        drop(stored);
        if !removed.is_empty() {
            free(removed);
        }
    }

    /// Removes all results.
    pub fn clear(&self) {
        let mut stored = self.lock();
        stored.bytes = 0;
        let removed = std::mem::take(&mut stored.results);
        drop(stored);
        free(removed);
    }
}

/// Frees results on another thread, because that takes time, and who sets a limit does not wait.
fn free(removed: impl Send + 'static) {
    rayon::spawn(move || drop(removed));
}

impl Stored {
    /// Returns a stored result, which is used from now on.
    fn find(&mut self, place: &(usize, Key)) -> Option<Arc<dyn Any + Send + Sync>> {
        let entry = self.results.get_mut(place)?;
        entry.score = self.removed_score + entry.cost;
        Some(Arc::clone(&entry.value))
    }

    /// Removes those of the results not in use that have the lowest scores, until all results are within the limit or
    /// those take at most a part of it ([`BESIDE`]); returns the removed ones.
    fn within_limit(&mut self) -> Vec<Entry> {
        let mut removed = Vec::new();
        if self.bytes <= self.limit {
            return removed;
        }
        let used: usize = self.results.values().map(Entry::bytes_in_use).sum();
        let most = self.limit.max(used + self.limit / BESIDE);
        while self.bytes > most {
            // Nobody can begin to use a result while the store is locked.
            let unused = self.results.iter().filter(|(_, entry)| entry.bytes_in_use() == 0);
            let least = unused.min_by(|(_, a), (_, b)| a.score.total_cmp(&b.score));
            let Some(place) = least.map(|(place, _)| place.clone()) else { break };
            let Some(entry) = self.results.remove(&place) else { break };
            self.removed_score = self.removed_score.max(entry.score);
            self.bytes -= entry.bytes;
            removed.push(entry);
        }
        removed
    }
}

/// Results of one kind in a store.
pub struct Cache<T> {
    store: Arc<Store>,
    number: usize,
    size: fn(&T) -> usize,
    kind: PhantomData<fn() -> T>,
}

impl<T: Send + Sync + 'static> Cache<T> {
    /// Creates the results of a new kind in `store`. `size`: returns the memory of a result, one that grows as large as it
    /// usually becomes. \[bytes\]
    pub fn new(store: &Arc<Store>, size: fn(&T) -> usize) -> Self {
        let mut stored = store.lock();
        stored.caches += 1;
        Self { store: Arc::clone(store), number: stored.caches, size, kind: PhantomData }
    }

    /// Whether the result of a key is stored.
    pub fn holds(&self, key: &Key) -> bool {
        self.store.lock().results.contains_key(&(self.number, key.clone()))
    }

    /// Returns the result of a key; it is computed if it is not stored. Two threads may compute the same result at the
    /// same time; both then get that of the first.
    pub fn get<E>(&self, key: Key, compute: impl FnOnce() -> Result<T, E>) -> Result<Arc<T>, E> {
        let place = (self.number, key);
        if let Some(value) = self.store.lock().find(&place) {
            return Ok(of_kind(value));
        }
        let clock = Instant::now();
        let value = compute()?;
        Ok(self.keep(place, value, clock.elapsed()))
    }

    /// Stores a result whose computation took some time, and returns it, or that of another thread that was faster.
    fn keep(&self, place: (usize, Key), value: T, time: Duration) -> Arc<T> {
        let value = Arc::new(value);
        let bytes = (self.size)(&value) + size_of::<T>() + size_of_val(&place.1[..]);
        let cost = time.as_secs_f64() / bytes as f64;
        let mut stored = self.store.lock();
        if let Some(value) = stored.find(&place) {
            return of_kind(value);
        }
        let score = stored.removed_score + cost;
        stored.results.insert(place, Entry { value: Arc::clone(&value) as _, bytes, cost, score });
        stored.bytes += bytes;
        let removed = stored.within_limit();
        // Freed without holding the lock.
        drop(stored);
        drop(removed);
        value
    }

    /// Returns the result of a key like [`Self::get`], for computations that cannot fail.
    pub fn find(&self, key: Key, compute: impl FnOnce() -> T) -> Arc<T> {
        match self.get(key, || Ok::<_, Infallible>(compute())) {
            Ok(value) => value,
            Err(never) => match never {},
        }
    }
}

/// Returns a stored result as one of its kind.
fn of_kind<T: Send + Sync + 'static>(value: Arc<dyn Any + Send + Sync>) -> Arc<T> {
    value.downcast().expect("a cache has results of one type")
}

/// Returns the bits of numbers, for keys.
pub fn bits(numbers: impl IntoIterator<Item = f64>) -> impl Iterator<Item = u64> {
    numbers.into_iter().map(f64::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Memory that a stored number takes beside that which the tests give to it. \[bytes\]
    const FIXED: usize = size_of::<usize>() + size_of::<u64>();

    /// Memories, beside the fixed part, of those results that are stored of two kinds, even and odd. \[bytes\]
    fn held(store: &Store, kinds: [&Cache<usize>; 2], of: &[usize]) -> Vec<usize> {
        let held: Vec<usize> = of.iter().copied().filter(|&size| kinds[size % 2].holds(&vec![size as u64])).collect();
        assert_eq!(store.bytes(), held.iter().map(|size| size + FIXED).sum::<usize>());
        held
    }

    /// Stores a number whose memory, beside the fixed part, is as large as it is, with the time that its computation took
    /// per memory. \[s/byte\]
    fn keep(cache: &Cache<usize>, size: usize, cost: f64) {
        let time = Duration::from_secs_f64(cost * (size + FIXED) as f64);
        cache.keep((cache.number, vec![size as u64]), size, time);
    }

    #[test]
    fn of_all_kinds_the_results_that_cost_least_for_their_memory_go_when_all_are_too_large() {
        let store = Arc::new(Store::new(10_000));
        let [even, odd] = [(); 2].map(|()| Cache::new(&store, |value: &usize| *value));
        let holds = |expected: &[usize]| {
            assert_eq!(held(&store, [&even, &odd], &[300, 600, 1200, 3001, 4000, 5001, 12_000]), expected);
        };
        keep(&even, 4000, 2.0);
        keep(&odd, 5001, 1.0);
        keep(&even, 600, 3.0);
        holds(&[600, 4000, 5001]);
        keep(&odd, 3001, 0.5);
        holds(&[600, 3001, 4000]);
        // One that is too large for the store is there until the next.
        keep(&even, 12_000, 0.1);
        holds(&[600, 12_000]);
        keep(&even, 300, 1.0);
        holds(&[300, 600]);
        even.find(vec![600], || unreachable!("it is stored"));
        keep(&even, 1200, 2.0);
        store.set_limit(2000);
        holds(&[600, 1200]);
        store.set_limit(700);
        holds(&[600]);
        store.clear();
        holds(&[]);
        assert_eq!(*even.find(vec![600], || 600), 600);
        holds(&[600]);
    }

    #[test]
    fn a_result_that_cost_more_stays_longer_and_as_long_as_it_is_used() {
        for used in [false, true] {
            let store = Arc::new(Store::new(1000));
            let [even, odd] = [(); 2].map(|()| Cache::new(&store, |value: &usize| *value));
            keep(&even, 400, 2.5);
            // Scores are one above that of what was removed before: 1, 1, 2, 2, 3, 3, …
            let stays = [501, 503, 505, 507, 509, 511, 513, 515].map(|size| {
                keep(&odd, size, 1.0);
                if used {
                    even.find(vec![400], || unreachable!("it is stored"));
                }
                held(&store, [&even, &odd], &[400, 501, 503, 505, 507, 509, 511, 513, 515]).contains(&400)
            });
            let expected = if used { 8 } else { 5 };
            assert_eq!(stays.iter().filter(|stays| **stays).count(), expected, "{used}");
        }
    }

    #[test]
    fn results_in_use_stay_and_small_ones_beside_them() {
        let store = Arc::new(Store::new(1000));
        let cache = Cache::new(&store, |value: &usize| *value);
        let held = || held(&store, [&cache; 2], &[200, 400, 500, 800]);
        let used = cache.find(vec![800], || 800);
        keep(&cache, 500, 1.0);
        assert_eq!(held(), [500, 800]);
        keep(&cache, 400, 1.0);
        assert_eq!(held(), [400, 800]);
        keep(&cache, 200, 1.0);
        assert_eq!(held(), [200, 800]);
        store.set_limit(900);
        assert_eq!(held(), [200, 800]);
        drop(used);
        store.set_limit(300);
        assert_eq!(held(), [200]);
    }
}
