//! What the window asks of a catalogue. A trait, so that tests can put a slow or failing one in its place.

use super::error::AppError;
use crate::catalogue::{Deleted, Imported, Known, NewProduct, Product, Words};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Progress;
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
    /// The dataset of a state, computed now where the catalogue does not hold it; without a key of the state that stands for
    /// the product.
    fn load(&self, product: &str, state: Option<&str>) -> Result<Arc<Dataset>, AppError>;
    /// Everything about a product but its datasets: states with their numbers, control curve.
    fn product(&self, product: &str) -> Result<Arc<Product>, AppError>;
    /// The state that a control picks for a product.
    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError>;
    /// Stores a product; its key.
    fn add(&self, addition: &Addition) -> Result<String, AppError>;
    /// Stores all products of a package.
    fn import_package(&self, bytes: &[u8]) -> Result<Vec<Imported>, AppError>;
    /// Takes a product out for good.
    fn remove(&self, product: &str) -> Result<(), AppError>;
    /// Other words about a product.
    fn describe(&self, product: &str, words: &Words) -> Result<(), AppError>;
    /// Takes a product out of sight.
    fn delete(&self, product: &str) -> Result<(), AppError>;
    /// Brings a product back into sight.
    fn restore(&self, product: &str) -> Result<(), AppError>;
    /// Products out of sight, the last one first.
    fn deleted(&self) -> Result<Vec<Deleted>, AppError>;
    /// Products in sight that were read from files of this hash.
    fn products_from(&self, source_hash: &str) -> Result<Vec<Known>, AppError>;
    /// Can the dataset of a state be given at once?
    fn is_ready(&self, _product: &str, _state: Option<&str>) -> Result<bool, AppError> {
        Ok(true)
    }
    /// Computes the dataset of a state and keeps it, where the catalogue does not hold it yet; who asks for one that is
    /// being computed waits for it. Without a key the state that stands for the product.
    fn provide(&self, _product: &str, _state: Option<&str>, _progress: &dyn Progress) -> Result<(), AppError> {
        Ok(())
    }
    /// Computes and keeps one state that nobody has asked for yet, of the first of these products that has one, else of any;
    /// how many are left, and how many there are in all.
    fn fill_one(&self, _order: &[String], _progress: &dyn Progress) -> Result<[usize; 2], AppError> {
        Ok([0; 2])
    }
    /// Sets or takes the star.
    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), AppError>;
}
