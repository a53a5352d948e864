//! What the window asks of a catalogue. A trait, so that tests can put a slow or failing one in its place.

use super::error::AppError;
use crate::catalogue::{Collection, Subscription};
use crate::catalogue::{Deleted, Event, Known, NewProduct, Product, Replacement, Snapshot, StateName, Stored, Words};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Progress;
use crate::study::StudyError;
use crate::study::control::ControlQuestion;
use crate::study::subscriptions::Report;
use std::sync::Arc;

/// A row of the list.
pub use crate::catalogue::ProductRow as Entry;
/// What is asked for, and what was found.
pub use crate::catalogue::{Found, Query};

/// A product of the catalogue that the words fit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hit {
    /// Its key.
    pub key: String,
    /// Its name.
    pub name: String,
    /// What else is said about it: maker and kind.
    pub about: String,
}

/// A product to be stored: its states, and what the user said about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Datasets, one a state.
    pub datasets: Vec<Arc<Dataset>>,
    /// Name, kind, where the data come from.
    pub product: NewProduct,
}

/// Collections and subscriptions of a catalogue.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sets {
    /// Collections by name.
    pub collections: Vec<Collection>,
    /// Folders that are subscribed to.
    pub subscriptions: Vec<Subscription>,
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
    /// Stores all of these products, or none.
    fn add_all(&self, additions: &[Addition]) -> Result<Vec<Stored>, AppError>;
    /// Takes all of these products out for good, or none.
    fn remove_all(&self, products: &[String]) -> Result<(), AppError>;
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
    /// Products in sight with a state of this content.
    fn products_holding(&self, content: &str) -> Result<Vec<Known>, AppError>;
    /// What happened to a product, the last first.
    fn history(&self, product: &str) -> Result<Vec<Event>, AppError>;
    /// Paths of the files that a product was read from.
    fn source_paths(&self, product: &str) -> Result<Vec<String>, AppError>;
    /// A product of the user's as it is now, data and all.
    fn snapshot(&self, product: &str) -> Result<Snapshot, AppError>;
    /// Makes a product what it was.
    fn put_back(&self, snapshot: &Snapshot) -> Result<(), AppError>;
    /// Other names and angles of a product's states, in their order.
    fn name_states(&self, product: &str, names: &[StateName]) -> Result<(), AppError>;
    /// Other data for some states of a product.
    fn replace_states(&self, product: &str, list: &[Replacement]) -> Result<(), AppError>;
    /// The folder of packages that a product comes from; `None` for others.
    fn subscribed_folder(&self, product: &str) -> Result<Option<String>, AppError>;
    /// Collections by name.
    fn collections(&self) -> Result<Vec<Collection>, AppError>;
    /// Puts products into a collection, or takes them out.
    fn collect(&self, name: &str, products: &[String], put: bool) -> Result<(), AppError>;
    /// Folders of packages that are subscribed to.
    fn subscriptions(&self) -> Result<Vec<Subscription>, AppError>;
    /// Subscribes to a folder of packages; its products come when it is read.
    fn subscribe(&self, folder: &str) -> Result<(), AppError>;
    /// Ends a subscription: its products go. How many went.
    fn unsubscribe(&self, folder: &str) -> Result<usize, AppError>;
    /// Reads the folders of packages that are subscribed to, where they have changed.
    fn sync(&self, _progress: &dyn Progress) -> Result<Report, AppError> {
        Ok(Report::default())
    }
    /// Can the dataset of a state be given at once?
    fn is_ready(&self, _product: &str, _state: Option<&str>) -> Result<bool, AppError> {
        Ok(true)
    }
    /// Computes the dataset of a state and keeps it, where the catalogue does not hold it yet; who asks for one that is
    /// being computed waits for it. Without a key the state that stands for the product.
    fn provide(&self, _product: &str, _state: Option<&str>, _progress: &dyn Progress) -> Result<(), AppError> {
        Ok(())
    }
    /// Computes and keeps one state that nobody has asked for yet: any of the first of these products, else one that may
    /// stand for its product, of the next of these that has one, else of any. How many such states are left, and how many
    /// there are with all that were computed before. The others are for who asks for them.
    fn fill_one(&self, _order: &[String], _progress: &dyn Progress) -> Result<[usize; 2], AppError> {
        Ok([0; 2])
    }
    /// Sets or takes the star.
    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), AppError>;
}
