//! Values that were used recently: found by their keys, within limits of number and memory.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Maximum number of stored values: the states of two moving products with 21 each. Chosen: cost only.
const MAX_VALUES: usize = 42;
/// Memory of the results that stored optical models have cached, above which the addition of a value removes those used
/// longest ago. \[bytes\] Chosen: cost only; one state of a blind with panes needs 2.8 MB, one of a perforated sheet more.
const MAX_CACHED_BYTES: usize = 48 << 20;

/// Stored values with their keys, the one used last at the end.
pub(super) struct Recent<K, V> {
    list: Mutex<VecDeque<(K, V)>>,
    /// Returns the memory of a value, which may grow after it is stored. \[bytes\]
    size: fn(&V) -> usize,
}

impl<K: PartialEq + Clone, V: Clone> Recent<K, V> {
    /// Creates an empty store. `size`: returns the memory of a value, which may grow after it is stored. \[bytes\]
    pub fn new(size: fn(&V) -> usize) -> Self {
        Self { list: Mutex::default(), size }
    }

    /// Returns the value of a key, which `make` creates if it is not stored. Two threads may create the same value at
    /// the same time; both then get that of the first.
    ///
    /// # Errors
    /// Returns the error of `make`; nothing is stored then.
    pub fn get<E>(&self, key: &K, make: impl FnOnce() -> Result<V, E>) -> Result<V, E> {
        if let Some(value) = find(&mut self.lock(), key) {
            return Ok(value);
        }
        let made = make()?;
        let mut list = self.lock();
        if let Some(value) = find(&mut list, key) {
            return Ok(value);
        }
        let bytes = |list: &VecDeque<(K, V)>| list.iter().map(|(_, value)| (self.size)(value)).sum::<usize>();
        while list.len() >= MAX_VALUES || bytes(&list) > MAX_CACHED_BYTES {
            list.pop_front();
        }
        list.push_back((key.clone(), made.clone()));
        Ok(made)
    }

    /// Locks the list, which is whole even if another thread has failed while it held the lock.
    fn lock(&self) -> MutexGuard<'_, VecDeque<(K, V)>> {
        self.list.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns the stored value of a key, which counts as used now; `None` if it is not stored.
fn find<K: PartialEq, V: Clone>(list: &mut VecDeque<(K, V)>, key: &K) -> Option<V> {
    let at = list.iter().position(|(known, _)| known == key)?;
    let entry = list.remove(at)?;
    let value = entry.1.clone();
    list.push_back(entry);
    Some(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Value whose memory is the number in it.
    type Value = Arc<AtomicUsize>;

    fn empty() -> Recent<usize, Value> {
        Recent::new(|value| value.load(Ordering::Relaxed))
    }

    /// Asks for the value of a key, and returns whether it had to be created.
    fn is_created(recent: &Recent<usize, Value>, key: usize, value: &Value) -> bool {
        let mut made = false;
        let Ok(_) = recent.get::<Infallible>(&key, || {
            made = true;
            Ok(Arc::clone(value))
        });
        made
    }

    #[test]
    fn values_that_have_become_too_large_go_in_the_order_of_their_last_use() {
        let (recent, own) = (empty(), [(); 4].map(|()| Value::default()));
        for (key, value) in own[..3].iter().enumerate() {
            assert!(is_created(&recent, key, value) && !is_created(&recent, key, value));
            // They grow after they have been stored.
            value.store(MAX_CACHED_BYTES / 3 + 1, Ordering::Relaxed);
        }
        assert!(!is_created(&recent, 0, &own[0]));
        // The three together are too large for a fourth: value 1 was used longest ago, and is enough.
        assert!(is_created(&recent, 3, &own[3]));
        assert_eq!(recent.lock().iter().map(|(key, _)| *key).collect::<Vec<_>>(), [2, 0, 3]);
    }

    #[test]
    fn no_more_values_are_stored_than_two_moving_products_have() {
        let (recent, small) = (empty(), Value::default());
        assert!((0..2 * MAX_VALUES).all(|key| is_created(&recent, key, &small)));
        assert_eq!(recent.lock().len(), MAX_VALUES);
        assert!(!is_created(&recent, MAX_VALUES, &small) && is_created(&recent, MAX_VALUES - 1, &small));
    }

    #[test]
    fn of_two_values_for_one_key_the_first_is_stored() {
        let (recent, [first, second]) = (empty(), [(); 2].map(|()| Value::default()));
        let Ok(found) = recent.get::<Infallible>(&1, || {
            // Another thread is quicker.
            assert!(is_created(&recent, 1, &first));
            Ok(second)
        });
        assert!(Arc::ptr_eq(&found, &first));
        assert_eq!(recent.lock().len(), 1);
    }

    #[test]
    fn what_fails_is_not_stored() {
        let (recent, value) = (empty(), Value::default());
        assert_eq!(recent.get(&1, || Err("no such layer")).err(), Some("no such layer"));
        assert!(is_created(&recent, 1, &value));
    }
}
