//! The built-in products that take too long to be computed when a catalogue is opened: computed one after the other,
//! stored as they are done, taken up again where an earlier run stopped.

use super::error::StudyError;
use super::goniophotometer::{Described, Request, Withdrawn};
use super::library::Library;
use crate::catalogue::{BUILTIN_ERROR, NewProduct};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::{Progress, Silent};
use crate::compute::system::measure::front_basis;

/// The product of a built-in description with its datasets.
///
/// # Errors
/// An unknown name; cancelled.
pub fn compute(name: &str, progress: &dyn Progress) -> Result<(NewProduct, Vec<Dataset>), StudyError> {
    let described =
        Described::builtin(name).ok_or_else(|| StudyError::Catalogue(format!("no built-in description {name}")))?;
    // Built-in stacks name built-in layers only.
    let library = Library::default();
    let cells = front_basis();
    let request = Request { incident: cells.clone(), emergent: cells, error: BUILTIN_ERROR, seed: 1 };
    let states = described.states(&library)?;
    let computed = described.measure_all(&states, &request, &library, None, &Withdrawn(progress))?;
    let datasets: Vec<Dataset> = computed.into_iter().map(|one| one.dataset).collect();
    Ok((described.product(&request, &datasets), datasets))
}

/// All that are missing in a catalogue's file, with progress by product. Returns how many were stored.
///
/// # Errors
/// A file that cannot be written; cancelled, when what is done stays.
pub fn complete(
    missing: &[&str],
    mut put: impl FnMut(&str, NewProduct, Vec<Dataset>) -> Result<(), StudyError>,
    progress: &dyn Progress,
) -> Result<usize, StudyError> {
    for (done, name) in missing.iter().enumerate() {
        progress.advance("built-in products", done, missing.len());
        let (product, datasets) = compute(name, progress)?;
        put(name, product, datasets)?;
    }
    progress.advance("built-in products", missing.len(), missing.len());
    Ok(missing.len())
}

/// The same without progress, for one name.
///
/// # Errors
/// An unknown name.
pub fn compute_quietly(name: &str) -> Result<(NewProduct, Vec<Dataset>), StudyError> {
    compute(name, &Silent)
}
