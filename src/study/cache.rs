//! Store of results for later computations: found by exact keys, within one limit of memory, the least recently used out
//! first. Results in use stay: without them in the store their memory would be the same, and the next computation would
//! compute them again.

use hashlink::LruCache;
use std::any::Any;
use std::convert::Infallible;
use std::marker::PhantomData;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
    /// Results by the number of their cache and by key, the least recently used first.
    results: LruCache<(usize, Key), Entry>,
}

/// Result in a store with its memory. \[bytes\]
struct Entry {
    value: Arc<dyn Any + Send + Sync>,
    bytes: usize,
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
        Self(Mutex::new(Stored { limit, bytes: 0, caches: 0, results: LruCache::new_unbounded() }))
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
        let removed = std::mem::replace(&mut stored.results, LruCache::new_unbounded());
        drop(stored);
        free(removed);
    }
}

/// Frees results on another thread, because that takes time, and who sets a limit does not wait.
fn free(removed: impl Send + 'static) {
    rayon::spawn(move || drop(removed));
}

impl Stored {
    /// Removes the least recently used of the results that are not in use, until all results are within the limit or
    /// those take at most a part of it ([`BESIDE`]); returns the removed ones.
    fn within_limit(&mut self) -> Vec<((usize, Key), Entry)> {
        let mut removed = Vec::new();
        if self.bytes <= self.limit {
            return removed;
        }
        let used: usize = self.results.iter().map(|(_, entry)| entry.bytes_in_use()).sum();
        let most = self.limit.max(used + self.limit / BESIDE);
        while self.bytes > most {
            let Some((place, entry)) = self.results.remove_lru() else { break };
            // Nobody can begin to use a result while the store is locked: there is one to remove.
            if entry.bytes_in_use() > 0 {
                self.results.insert(place, entry);
            } else {
                self.bytes -= entry.bytes;
                removed.push((place, entry));
            }
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
        self.store.lock().results.peek(&(self.number, key.clone())).is_some()
    }

    /// Returns the result of a key; it is computed if it is not stored. Two threads may compute the same result at the
    /// same time; both then get that of the first.
    pub fn get<E>(&self, key: Key, compute: impl FnOnce() -> Result<T, E>) -> Result<Arc<T>, E> {
        let place = (self.number, key);
        let known = |stored: &mut Stored| {
            let value = Arc::clone(&stored.results.get(&place)?.value);
            Some(value.downcast().expect("a cache has results of one type"))
        };
        if let Some(value) = known(&mut self.store.lock()) {
            return Ok(value);
        }
        let value = Arc::new(compute()?);
        let bytes = (self.size)(&value) + size_of::<T>() + size_of_val(&place.1[..]);
        let mut stored = self.store.lock();
        if let Some(value) = known(&mut stored) {
            return Ok(value);
        }
        let entry = Entry { value: Arc::clone(&value) as Arc<dyn Any + Send + Sync>, bytes };
        stored.results.insert(place, entry);
        stored.bytes += bytes;
        let removed = stored.within_limit();
        // Freed without holding the lock.
        drop(stored);
        drop(removed);
        Ok(value)
    }

    /// Returns the result of a key like [`Self::get`], for computations that cannot fail.
    pub fn find(&self, key: Key, compute: impl FnOnce() -> T) -> Arc<T> {
        match self.get(key, || Ok::<_, Infallible>(compute())) {
            Ok(value) => value,
            Err(never) => match never {},
        }
    }
}

/// Returns the bits of numbers, for keys.
pub fn bits(numbers: impl IntoIterator<Item = f64>) -> impl Iterator<Item = u64> {
    numbers.into_iter().map(f64::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_recently_used_results_of_all_kinds_go_when_all_are_too_large() {
        let fixed = size_of::<usize>() + size_of::<u64>();
        let store = Arc::new(Store::new(10_000));
        let (even, odd) = (Cache::new(&store, |value: &usize| *value), Cache::new(&store, |value: &usize| *value));
        let of = |size: usize| if size.is_multiple_of(2) { &even } else { &odd };
        let find = |size: usize| *of(size).find(vec![size as u64], || size);
        let held =
            |sizes: &[usize]| sizes.iter().copied().filter(|size| of(*size).holds(&vec![*size as u64])).collect();
        for size in [4000, 5001, 600] {
            find(size);
        }
        let all = [300, 600, 1200, 3001, 4000, 5001, 12_000];
        let holds = |expected: &[usize]| {
            let found: Vec<usize> = held(&all);
            assert_eq!(found, expected);
            assert_eq!(store.bytes(), expected.iter().map(|size| size + fixed).sum::<usize>());
        };
        holds(&[600, 4000, 5001]);
        even.find(vec![4000], || unreachable!("it is stored"));
        find(3001);
        holds(&[600, 3001, 4000]);
        // One that is too large for the store is there until the next.
        find(12_000);
        holds(&[12_000]);
        find(300);
        holds(&[300]);
        for size in [600, 1200] {
            find(size);
        }
        store.set_limit(2000);
        holds(&[600, 1200]);
        even.find(vec![600], || unreachable!("it is stored"));
        store.set_limit(700);
        holds(&[600]);
        store.clear();
        holds(&[]);
        assert_eq!(find(600), 600);
    }

    #[test]
    fn results_in_use_stay_and_small_ones_beside_them() {
        let store = Arc::new(Store::new(1000));
        let cache = Cache::new(&store, |value: &usize| *value);
        let find = |size: usize| cache.find(vec![size as u64], || size);
        let held = || [200, 400, 500, 800].map(|size| cache.holds(&vec![size]));
        let used = find(800);
        find(500);
        assert_eq!(held(), [false, false, true, true]);
        find(400);
        assert_eq!(held(), [false, true, false, true]);
        find(200);
        assert_eq!(held(), [true, false, false, true]);
        store.set_limit(900);
        assert_eq!(held(), [true, false, false, true]);
        drop(used);
        store.set_limit(300);
        assert_eq!(held(), [true, false, false, false]);
    }
}
