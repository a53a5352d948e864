//! Optical models of descriptions, stored with the results that they have cached for further directions.

use super::system::SystemModel;
use crate::compute::btdf::DescribedState;
use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Maximum number of stored models: two moving products with 21 states each. Chosen: cost only.
const MOST: usize = 42;
/// Memory of the results that the stored models have cached, above which those used longest ago are removed. \[bytes\]
/// Chosen: cost only; the models of a blind with panes need 2 MB for each state, those of perforated sheets more.
const MOST_CACHED: usize = 48 << 20;

/// Optical models of descriptions, the one used last at the end; `None` for descriptions without a model.
type List = VecDeque<(DescribedState, Option<SystemModel>)>;

/// Stored optical models.
#[derive(Default)]
pub(super) struct Models(Mutex<List>);

impl Models {
    /// Returns the model of a description, which `make` creates if it is not stored. Two threads may create the same
    /// model at the same time; both then get that of the first.
    pub fn get(&self, described: &DescribedState, make: impl FnOnce() -> Option<SystemModel>) -> Option<SystemModel> {
        if let Some(model) = find(&mut self.lock(), described) {
            return model;
        }
        let made = make();
        let mut list = self.lock();
        if let Some(model) = find(&mut list, described) {
            return model;
        }
        let cached = |(_, model): &(_, Option<SystemModel>)| model.as_ref().map_or(0, SystemModel::bytes);
        while list.len() >= MOST || list.iter().map(cached).sum::<usize>() > MOST_CACHED {
            list.pop_front();
        }
        list.push_back((described.clone(), made.clone()));
        made
    }

    // What is stored is whole even if another thread has failed while it held the lock.
    fn lock(&self) -> MutexGuard<'_, List> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns the stored model of a description, which counts as used now; `None` if it is not stored.
fn find(list: &mut List, described: &DescribedState) -> Option<Option<SystemModel>> {
    let at = list.iter().position(|(known, _)| known == described)?;
    let entry = list.remove(at)?;
    let model = entry.1.clone();
    list.push_back(entry);
    Some(model)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::RingBasis;
    use crate::compute::direction::{Dir, Facade};
    use crate::compute::estimate::{Cancelled, Progress};
    use crate::compute::system::measure::{Beam, Measured, OpticalModel, ScatteredLight, Setting, Side};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Clear opening that counts the memory that the test sets as cached.
    #[derive(Default)]
    struct Caching(AtomicUsize);

    impl OpticalModel for Caching {
        fn measure(&self, setting: &Setting<'_>, _: &dyn Progress) -> Result<Measured, Cancelled> {
            Ok(Measured::dark(setting))
        }

        fn beams(&self, direction: Dir<Facade>, _: Side) -> Vec<Beam> {
            vec![Beam::through(direction, 1.0)]
        }

        fn scattered(&self, _: Dir<Facade>, _: Side, _: &RingBasis) -> ScatteredLight {
            ScatteredLight::default()
        }

        fn bytes(&self) -> usize {
            self.0.load(Ordering::Relaxed)
        }
    }

    /// Description of the product `number`.
    fn described(number: usize) -> DescribedState {
        DescribedState { text: number.to_string(), state: String::new() }
    }

    /// Asks for the product `number`, and returns whether its model had to be created.
    fn created(models: &Models, number: usize, model: &Arc<Caching>) -> bool {
        let mut made = false;
        models.get(&described(number), || {
            made = true;
            Some(SystemModel(Arc::clone(model) as _, None))
        });
        made
    }

    #[test]
    fn models_that_have_cached_too_much_go_in_the_order_of_their_last_use() {
        let (models, own) = (Models::default(), [(); 4].map(|()| Arc::new(Caching::default())));
        for (number, model) in own[..3].iter().enumerate() {
            assert!(created(&models, number, model) && !created(&models, number, model));
            // They grow after they have been stored.
            model.0.store(MOST_CACHED / 3 + 1, Ordering::Relaxed);
        }
        assert!(!created(&models, 0, &own[0]));
        // The three together are too large for a fourth: product 1 was used longest ago, and is enough.
        assert!(created(&models, 3, &own[3]));
        let stored = models.lock().iter().map(|(described, _)| described.text.clone()).collect::<Vec<_>>();
        assert_eq!(stored, ["2", "0", "3"]);
    }

    #[test]
    fn no_more_models_are_stored_than_two_moving_products_have() {
        let (models, small) = (Models::default(), Arc::new(Caching::default()));
        assert!((0..2 * MOST).all(|number| created(&models, number, &small)));
        assert_eq!(models.lock().len(), MOST);
        assert!(!created(&models, MOST, &small) && created(&models, MOST - 1, &small));
    }
}
