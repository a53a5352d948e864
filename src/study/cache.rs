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
}

impl<T> Cache<T> {
    /// Creates an empty cache of at most `capacity` results.
    pub const fn new(capacity: usize) -> Self {
        Self { entries: Mutex::new(Vec::new()), capacity }
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
        if entries.len() >= self.capacity {
            entries.remove(0);
        }
        entries.push((key, Arc::clone(&value)));
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
