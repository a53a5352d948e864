//! What the window asks of a catalogue. A trait, so that tests can put a slow or failing one in its place.

use super::error::AppError;
use crate::catalogue::{Deleted, Imported, Known, NewProduct, Product, Words};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Progress;
use crate::study::StudyError;
use crate::study::control::ControlQuestion;
use std::sync::Arc;

/// A row of the list.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Product key.
    pub key: String,
    /// Product name.
    pub name: String,
    /// Maker; may be empty.
    pub manufacturer: String,
    /// Kind of system in words, e.g. `venetian blind`; may be empty.
    pub kind: String,
    /// Keys of the states; one empty key for a product without states.
    pub states: Vec<String>,
    /// τ at normal incidence, of the first state.
    pub tau_normal: Option<f64>,
    /// τ under uniform luminance, of the first state.
    pub tau_hemispherical: Option<f64>,
    /// τ from below (−90°) over the normal to above (+90°) in the vertical plane, equal steps; the thumbnail.
    pub profile: Vec<f32>,
    /// Starred by the user.
    pub favourite: bool,
}

/// What is asked for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Query {
    /// Words that must occur.
    pub text: String,
    /// Kinds that are chosen; empty = all.
    pub kinds: Vec<String>,
    /// Starred ones alone.
    pub favourites: bool,
}

/// What was found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Found {
    /// Rows in order.
    pub entries: Vec<Entry>,
    /// Kinds with the number of products that the words alone would find.
    pub kinds: Vec<(String, usize)>,
    /// Products in the catalogue altogether.
    pub total: usize,
}

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
    /// The dataset of a state; without a key the first state's. Computed now where the catalogue does not hold it.
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
    /// being computed waits for it. Without a key the first state's.
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
