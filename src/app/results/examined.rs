//! Cache of the data check's findings, by the content of the datasets.

use crate::catalogue::content_of;
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{Diagnosis, examine};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Maximum number of datasets whose findings are cached.
const MOST: usize = 64;

/// Pairs of a dataset's content hash and its findings, newest at the end.
type Kept = VecDeque<(String, Arc<Vec<Diagnosis>>)>;

/// Cache of the findings of the latest checked datasets, by content hash; clones share it.
#[derive(Debug, Clone, Default)]
pub struct Examined(Arc<Mutex<Kept>>);

impl Examined {
    /// Returns the findings of the data check about a dataset; the check runs once per content and is slow.
    pub fn of(&self, dataset: &Dataset) -> Arc<Vec<Diagnosis>> {
        // What readers found counts too.
        let key = format!("{}{:?}", content_of(dataset), dataset.findings);
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = kept().iter().find(|(known, _)| *known == key) {
            return known.clone();
        }
        let found = Arc::new(examine(dataset));
        let mut kept = kept();
        kept.push_back((key, found.clone()));
        if kept.len() > MOST {
            kept.pop_front();
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::Btdf;

    #[test]
    fn equal_data_are_examined_once() {
        let examined = Examined::default();
        let dataset = |tau: f64| {
            let mut dataset = Dataset::default();
            dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(tau));
            dataset
        };
        let first = examined.of(&dataset(0.5));
        assert!(Arc::ptr_eq(&first, &examined.of(&dataset(0.5))));
        assert!(!Arc::ptr_eq(&first, &examined.of(&dataset(1.5))));
        assert_eq!(*examined.of(&dataset(1.5)), examine(&dataset(1.5)));
    }
}
