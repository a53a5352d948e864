//! Data of the built-in products: computed when first needed, one state at a time, and stored in the catalogue.

use super::error::StudyError;
use super::goniophotometer::{Base, Described, LayerLibrary, Request, Withdrawn};
use crate::catalogue::{
    BUILTIN_ERROR, Catalogue, CatalogueError, PROFILE_ANGLES, Product, SYSTEMS, StateKey, fingerprint, key_of_builtin,
};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::system::measure::front_basis;
use crate::formats::figures_table::{self, FigureRow};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Computes the BSDF data of a built-in product's state from the description that the catalogue stores with it.
///
/// # Errors
/// Returns an error if the product has no description, if this program cannot read it, if it does not have the state,
/// or if cancelled.
pub fn compute(
    product: &Product,
    state: &str,
    library: &dyn LayerLibrary,
    progress: &dyn Progress,
) -> Result<Dataset, StudyError> {
    let cannot_compute =
        |what: String| StudyError::Catalogue(format!("the data of \"{}\" cannot be computed: {what}", product.key));
    if product.system.is_empty() {
        return Err(cannot_compute("it has no description".to_owned()));
    }
    let described =
        Described::from_text(&product.system, Base::Builtin).map_err(|error| cannot_compute(error.to_string()))?;
    let cells = front_basis();
    let request = Request { incident: cells.clone(), emergent: cells, error: BUILTIN_ERROR, seed: 1 };
    Ok(described.measure(state, &request, library, None, progress)?.dataset)
}

/// Computes the BSDF data of all wanted states that lack them, and stores each as soon as it is finished, so that
/// stopping loses nothing. Returns the number of computed states.
///
/// # Errors
/// Returns an error if the catalogue cannot be read or written, or if cancelled.
pub fn complete(
    catalogue: &mut Catalogue,
    wanted: impl Fn(&StateKey) -> bool,
    library: &dyn LayerLibrary,
    progress: &dyn Progress,
) -> Result<usize, StudyError> {
    let catalogue_error = |error: CatalogueError| StudyError::Catalogue(error.to_string());
    let states: Vec<StateKey> = catalogue.waiting().map_err(catalogue_error)?.into_iter().filter(wanted).collect();
    let (catalogue, done) = (Mutex::new(catalogue), AtomicUsize::new(0));
    let withdrawn = Withdrawn(progress);
    progress.advance("states", 0, states.len());
    states.par_iter().try_for_each(|one| {
        if progress.cancelled() {
            return Err(StudyError::Cancelled(Cancelled));
        }
        // Every change is a transaction: after a panic the data are complete.
        let lock = || catalogue.lock().unwrap_or_else(PoisonError::into_inner);
        let product = lock().product(&one.product).map_err(catalogue_error)?;
        let dataset = compute(&product, &one.state, library, &withdrawn)?;
        lock().put_state(&product, &dataset).map_err(catalogue_error)?;
        progress.advance("states", done.fetch_add(1, Ordering::Relaxed) + 1, states.len());
        Ok(())
    })?;
    Ok(states.len())
}

/// Returns the CSV table of the figures of all built-in products with a description, from a catalogue that contains the
/// data of all of them; see [`crate::catalogue::TABLE`].
///
/// # Errors
/// Returns an error if the catalogue cannot be read, or a state has no data or figures.
pub fn table(catalogue: &Catalogue) -> Result<String, StudyError> {
    let mut rows = Vec::new();
    for (name, _) in SYSTEMS.iter() {
        let key = key_of_builtin(name);
        let product = catalogue.product(key).map_err(|error| StudyError::Catalogue(error.to_string()))?;
        for state in product.states {
            let (true, Some(tau_normal), Some(tau_hemispherical), Some(light)) =
                (state.dataset.is_some(), state.tau_normal, state.tau_hemispherical, state.light)
            else {
                return Err(StudyError::Catalogue(format!("{key}, state \"{}\", is not computed", state.key)));
            };
            rows.push(FigureRow {
                product: key.to_owned(),
                fingerprint: fingerprint(&product.system),
                state: state.key,
                tau_normal,
                tau_hemispherical,
                tau_profile: state.tau_profile,
                to_ceiling: light.to_ceiling,
                sun_blocked: light.sun_blocked,
                view: light.view,
            });
        }
    }
    Ok(figures_table::write(&rows, &PROFILE_ANGLES))
}
