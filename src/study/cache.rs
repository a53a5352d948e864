//! Keeps what a changed sky, time or product does not touch: a few most recently used results by exact key.

use std::convert::Infallible;
use std::sync::{Arc, Mutex, PoisonError};

/// The numbers that a result depends on, as bits.
pub type Key = Vec<u64>;

/// Most recently used values; shared between threads.
pub struct Cache<T> {
    entries: Mutex<Vec<(Key, Arc<T>)>>,
    capacity: usize,
}

impl<T> Cache<T> {
    /// Keeps at most `capacity` values.
    pub const fn new(capacity: usize) -> Self {
        Self { entries: Mutex::new(Vec::new()), capacity }
    }

    /// Is the value of a key there?
    pub fn holds(&self, key: &Key) -> bool {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner).iter().any(|(k, _)| k == key)
    }

    /// The value of a key, computed if it is not there. Two threads may compute the same value at once; both get that of
    /// the first.
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

    /// The value of a key, computed if it is not there, where nothing can go wrong; else as [`Self::get`].
    pub fn find(&self, key: Key, compute: impl FnOnce() -> T) -> Arc<T> {
        match self.get(key, || Ok::<_, Infallible>(compute())) {
            Ok(value) => value,
            Err(never) => match never {},
        }
    }
}

/// Bits of numbers, for keys.
pub fn bits(numbers: impl IntoIterator<Item = f64>) -> impl Iterator<Item = u64> {
    numbers.into_iter().map(f64::to_bits)
}
