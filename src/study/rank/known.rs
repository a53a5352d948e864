//! Stored figures of ranked products, found by the key of their row. They do not depend on objectives, weights and
//! other products.

use super::figures::{Found, Outcome, Stage};
use super::list::{List, Row};
use crate::compute::rank::Objective;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Stored figures of a product.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// Key of the product in the catalogue.
    pub product: String,
    /// Key of the row in the ranking: a hash of all input of the figures.
    pub key: String,
    /// Stage in which the figures were computed.
    pub stage: Stage,
    /// Keys of the stored figures.
    pub figures: Arc<[String]>,
    /// Figures in the order of their keys, or the reason why the product is excluded.
    pub outcome: Outcome,
}

impl Known {
    /// Whether all of these figures are stored, or the product is excluded.
    pub fn has(&self, figures: &[String]) -> bool {
        self.outcome.is_err() || figures.iter().all(|figure| self.figures.contains(figure))
    }

    /// Returns the row of a list with these figures; `None` if one is not stored.
    fn row(&self, figures: &[String]) -> Option<Row> {
        let outcome = match &self.outcome {
            Ok(found) => {
                let places: Option<Vec<usize>> =
                    figures.iter().map(|figure| self.figures.iter().position(|own| own == figure)).collect();
                let places = places?;
                Ok(Found {
                    figures: places.iter().map(|&k| found.figures[k]).collect(),
                    parts: places.iter().map(|&k| found.parts[k].clone()).collect(),
                    approximate: found.approximate.clone(),
                })
            }
            Err(reason) => Err(reason.clone()),
        };
        Some(Row { product: self.product.clone(), key: self.key.clone(), outcome })
    }
}

/// Returns a list of products with stored figures for the given objectives, sorted by product key. Products that lack a
/// figure are left out, because they have to be computed. `head`: list whose scene, climate and azimuth it has.
pub fn list_of(head: &List, known: &[Arc<Known>], figures: &[String], objectives: &[Objective]) -> List {
    let mut list = List {
        figures: figures.to_vec(),
        objectives: objectives.to_vec(),
        rows: known.iter().filter_map(|one| one.row(figures)).collect(),
        ..head.clone()
    };
    list.sort();
    list
}

/// Store of figures from the full stage, by the key of the row; shared by threads.
#[derive(Debug, Default)]
pub struct Store(Mutex<BTreeMap<String, Arc<Known>>>);

/// Maximum number of products whose figures are stored: a hundred products in a hundred rooms, about a kilobyte each.
const MOST: usize = 10_000;

impl Store {
    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Arc<Known>>> {
        // Stored entries are always complete.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the stored figures for the key of a row, if all of the given figures are among them.
    pub fn find(&self, key: &str, figures: &[String]) -> Option<Arc<Known>> {
        self.lock().get(key).filter(|one| one.has(figures)).cloned()
    }

    /// Stores the figures of a product, in place of those with the same key.
    pub fn keep(&self, known: Arc<Known>) {
        let mut all = self.lock();
        if all.len() >= MOST {
            all.clear();
        }
        all.insert(known.key.clone(), known);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::estimate::Estimate;
    use crate::compute::rank::Better;
    use crate::study::rank::Parts;

    fn known(product: &str, values: Option<[f64; 2]>) -> Arc<Known> {
        let figures: Arc<[String]> = ["a", "b"].map(str::to_owned).into();
        let outcome = values.ok_or_else(|| "no data".to_owned()).map(|values| Found {
            figures: values.map(|value| Estimate::new(value, 0.01)).to_vec(),
            parts: vec![Parts::default(); 2],
            approximate: Vec::new(),
        });
        Arc::new(Known { product: product.to_owned(), key: product.to_owned(), stage: Stage::Full, figures, outcome })
    }

    fn head() -> List {
        List {
            number: 0,
            scene: String::new(),
            climate: String::new(),
            azimuth: 180.0,
            figures: Vec::new(),
            objectives: Vec::new(),
            rows: Vec::new(),
        }
    }

    #[test]
    fn any_of_the_figures_that_are_kept_makes_a_list() {
        let all = [known("z", Some([0.9, 0.1])), known("broken", None), known("a", Some([0.2, 0.7]))];
        let objective = Objective { better: Better::More, worst: 0.0, best: 1.0, weight: 1.0 };
        let of = |figure: &str| list_of(&head(), &all, &[figure.to_owned()], &[objective]);
        let best = |list: &List| {
            let ranking = list.ranking(&list.objectives);
            list.ranked()[ranking.order[0]].0.product.clone()
        };
        assert_eq!((best(&of("a")).as_str(), best(&of("b")).as_str()), ("z", "a"));
        let keys: Vec<String> = of("a").rows.iter().map(|row| row.product.clone()).collect();
        assert_eq!(keys, ["a", "broken", "z"]);
        // What nobody has is not made up.
        assert_eq!(of("c").rows.len(), 1, "the one that is left out");
    }

    #[test]
    fn a_store_gives_what_has_all_that_is_asked() {
        let store = Store::default();
        store.keep(known("x", Some([1.0, 2.0])));
        let [a, c] = ["a", "c"].map(str::to_owned);
        assert!(store.find("x", std::slice::from_ref(&a)).is_some() && store.find("y", &[]).is_none());
        assert!(store.find("x", &[a, c]).is_none());
    }
}
