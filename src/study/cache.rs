//! Cache of the most recently used results, found by exact keys; for results that do not depend on a changed sky, time
//! or product.

use std::convert::Infallible;
use std::sync::{Arc, Mutex, PoisonError};

/// Key of a result: the bits of all numbers on which it depends.
pub type Key = Vec<u64>;

/// Cache of the most recently used results, shared between threads.
pub struct Cache<T> {
    entries: Mutex<Vec<(Key, Arc<T>)>>,
    capacity: usize,
    size: fn(&T) -> usize,
}

impl<T> Cache<T> {
    /// Creates an empty cache of at most `capacity` results.
    pub const fn new(capacity: usize) -> Self {
        Self::sized(capacity, |_| 1)
    }

    /// Creates an empty cache of results whose sizes together are at most `capacity`, and of the last result whatever
    /// its size. `size`: returns the size of a result, which does not change.
    pub const fn sized(capacity: usize, size: fn(&T) -> usize) -> Self {
        Self { entries: Mutex::new(Vec::new()), capacity, size }
    }

    /// Whether the cache contains the result of a key.
    pub fn holds(&self, key: &Key) -> bool {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner).iter().any(|(k, _)| k == key)
    }

    /// Returns the result of a key; it is computed if it is not stored. Two threads may compute the same result at the
    /// same time; both then get that of the first.
    pub fn get<E>(&self, key: Key, compute: impl FnOnce() -> Result<T, E>) -> Result<Arc<T>, E> {
        let lock = || self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let known = |entries: &mut Vec<(Key, Arc<T>)>| {
            let at = entries.iter().position(|(k, _)| *k == key)?;
            let entry = entries.remove(at);
            let value = Arc::clone(&entry.1);
            entries.push(entry);
            Some(value)
        };
        if let Some(value) = known(&mut lock()) {
            return Ok(value);
        }
        let value = Arc::new(compute()?);
        let mut entries = lock();
        if let Some(value) = known(&mut entries) {
            return Ok(value);
        }
        entries.push((key, Arc::clone(&value)));
        let size = |(_, value): &(Key, Arc<T>)| (self.size)(value);
        while entries.len() > 1 && entries.iter().map(size).sum::<usize>() > self.capacity {
            entries.remove(0);
        }
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
    fn the_least_recently_used_results_go_when_all_are_too_large() {
        let cache = Cache::sized(10, |value: &usize| *value);
        for size in [4, 5, 1] {
            cache.find(vec![size as u64], || size);
        }
        let held = || (0..20).filter(|size| cache.holds(&vec![*size])).collect::<Vec<_>>();
        assert_eq!(held(), [1, 4, 5]);
        cache.find(vec![4], || unreachable!("it is held"));
        cache.find(vec![3], || 3);
        assert_eq!(held(), [1, 3, 4]);
        // One that is too large for the cache is held until the next.
        cache.find(vec![11], || 11);
        assert_eq!(held(), [11]);
        cache.find(vec![2], || 2);
        assert_eq!(held(), [2]);
    }
}
