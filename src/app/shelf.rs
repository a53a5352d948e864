//! What the window asks of a catalogue. A trait, so that tests can put a slow or failing one in its place.

use super::error::AppError;
use crate::catalogue::{Imported, NewProduct, Product};
use crate::compute::btdf::Dataset;
use crate::study::StudyError;
use crate::study::control::ControlQuestion;
use std::sync::Arc;

/// A row of the list.
pub use crate::catalogue::ProductRow as Entry;
/// What is asked for, and what was found.
pub use crate::catalogue::{Found, Query};

/// A product to be stored: its states, and what the user said about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Datasets, one a state.
    pub datasets: Vec<Arc<Dataset>>,
    /// Name, kind, where the data come from.
    pub product: NewProduct,
}

/// A catalogue as the window sees it.
pub trait Shelf: Send + Sync {
    /// Looks products up.
    fn search(&self, query: &Query) -> Result<Found, AppError>;
    /// The dataset of a state; without a key the state that stands for the product.
    fn load(&self, product: &str, state: Option<&str>) -> Result<Arc<Dataset>, AppError>;
    /// Everything about a product but its datasets: states with their numbers, control curve.
    fn product(&self, product: &str) -> Result<Arc<Product>, AppError>;
    /// The state that a control picks for a product.
    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError>;
    /// Stores a product; its key.
    fn add(&self, addition: &Addition) -> Result<String, AppError>;
    /// Stores all products of a package.
    fn import_package(&self, bytes: &[u8]) -> Result<Vec<Imported>, AppError>;
    /// Takes a product out.
    fn remove(&self, product: &str) -> Result<(), AppError>;
    /// A built-in description whose product is not stored yet, and how many there are.
    fn next_builtin(&self) -> Result<Option<(&'static str, usize)>, AppError> {
        Ok(None)
    }
    /// Stores the product of a built-in description.
    fn put_builtin(&self, _name: &str, _product: NewProduct, _datasets: &[Dataset]) -> Result<(), AppError> {
        Ok(())
    }
    /// Sets or takes the star.
    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), AppError>;
}
