//! The built-in products that take too long to be computed when a catalogue is opened.

use super::error::StudyError;
use super::goniophotometer::{Described, LayerLibrary, Request, Withdrawn};
use crate::catalogue::{BUILTIN_ERROR, NewProduct};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Progress;
use crate::compute::system::measure::front_basis;

/// The product of a built-in description with its datasets. Built-in stacks name built-in layers only: `library` is not
/// asked for any.
///
/// # Errors
/// An unknown name; cancelled.
pub fn compute(
    name: &str,
    library: &dyn LayerLibrary,
    progress: &dyn Progress,
) -> Result<(NewProduct, Vec<Dataset>), StudyError> {
    let described =
        Described::builtin(name).ok_or_else(|| StudyError::Catalogue(format!("no built-in description {name}")))?;
    let cells = front_basis();
    let request = Request { incident: cells.clone(), emergent: cells, error: BUILTIN_ERROR, seed: 1 };
    let states = described.states(library)?;
    let computed = described.measure_all(&states, &request, library, None, &Withdrawn(progress))?;
    let datasets: Vec<Dataset> = computed.into_iter().map(|one| one.dataset).collect();
    Ok((described.product(&request, &datasets), datasets))
}
