//! Interface from the window to a catalogue. A trait, so that tests can use a slow or failing implementation.

use super::error::AppError;
use crate::catalogue::{Collection, Subscription};
use crate::catalogue::{Deleted, Event, Known, NewProduct, Product, Replacement, Snapshot, StateName, Stored, Words};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Progress;
use crate::study::StudyError;
use crate::study::control::ControlQuestion;
use crate::study::subscriptions::Report;
use std::sync::Arc;

/// Row of the product list.
pub use crate::catalogue::ProductRow as Entry;
/// Search and its result.
pub use crate::catalogue::{Found, Query};

/// Product of the catalogue that matches the palette's text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hit {
    /// Key of the product.
    pub key: String,
    /// Name of the product.
    pub name: String,
    /// Further information: maker and kind.
    pub about: String,
}

/// Product to be stored: its states, and the user's texts about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Datasets, one per state.
    pub datasets: Vec<Arc<Dataset>>,
    /// Name, kind, source of the data.
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

/// Catalogue as the window uses it.
pub trait Shelf: Send + Sync {
    /// Searches products.
    fn search(&self, query: &Query) -> Result<Found, AppError>;
    /// Returns the dataset of a state, computed now if the catalogue does not hold it; without a key, of the
    /// representative state.
    fn load(&self, product: &str, state: Option<&str>) -> Result<Arc<Dataset>, AppError>;
    /// Returns everything about a product except its datasets: states with their figures, control curve.
    fn product(&self, product: &str) -> Result<Arc<Product>, AppError>;
    /// Returns the state that a control picks for a product.
    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError>;
    /// Stores a product and returns its key.
    fn add(&self, addition: &Addition) -> Result<String, AppError>;
    /// Stores all of these products, or none.
    fn add_all(&self, additions: &[Addition]) -> Result<Vec<Stored>, AppError>;
    /// Removes all of these products permanently, or none.
    fn remove_all(&self, products: &[String]) -> Result<(), AppError>;
    /// Changes the texts of a product.
    fn describe(&self, product: &str, words: &Words) -> Result<(), AppError>;
    /// Deletes a product, restorable.
    fn delete(&self, product: &str) -> Result<(), AppError>;
    /// Restores a deleted product.
    fn restore(&self, product: &str) -> Result<(), AppError>;
    /// Returns the deleted products, newest first.
    fn deleted(&self) -> Result<Vec<Deleted>, AppError>;
    /// Returns the products, not deleted, that were read from files with this hash.
    fn products_from(&self, source_hash: &str) -> Result<Vec<Known>, AppError>;
    /// Returns the products, not deleted, that have a state with this content.
    fn products_holding(&self, content: &str) -> Result<Vec<Known>, AppError>;
    /// Returns the events of a product, newest first.
    fn history(&self, product: &str) -> Result<Vec<Event>, AppError>;
    /// Returns the paths of the files that a product was read from.
    fn source_paths(&self, product: &str) -> Result<Vec<String>, AppError>;
    /// Returns one of the user's products as it is now, including its data.
    fn snapshot(&self, product: &str) -> Result<Snapshot, AppError>;
    /// Restores a product to a snapshot.
    fn put_back(&self, snapshot: &Snapshot) -> Result<(), AppError>;
    /// Changes names and angles of a product's states, in their order.
    fn name_states(&self, product: &str, names: &[StateName]) -> Result<(), AppError>;
    /// Replaces the data of some states of a product.
    fn replace_states(&self, product: &str, list: &[Replacement]) -> Result<(), AppError>;
    /// Returns the folder of packages that a product comes from; `None` for other products.
    fn subscribed_folder(&self, product: &str) -> Result<Option<String>, AppError>;
    /// Returns the collections by name.
    fn collections(&self) -> Result<Vec<Collection>, AppError>;
    /// Adds products to a collection, or removes them.
    fn collect(&self, name: &str, products: &[String], put: bool) -> Result<(), AppError>;
    /// Returns the folders of packages that are subscribed to.
    fn subscriptions(&self) -> Result<Vec<Subscription>, AppError>;
    /// Subscribes to a folder of packages; its products come when it is read.
    fn subscribe(&self, folder: &str) -> Result<(), AppError>;
    /// Ends a subscription, which removes its products, and returns their number.
    fn unsubscribe(&self, folder: &str) -> Result<usize, AppError>;
    /// Reads the folders of packages that are subscribed to, where they have changed.
    fn sync(&self, _progress: &dyn Progress) -> Result<Report, AppError> {
        Ok(Report::default())
    }
    /// Whether the dataset of a state can be loaded without computing it.
    fn is_ready(&self, _product: &str, _state: Option<&str>) -> Result<bool, AppError> {
        Ok(true)
    }
    /// Computes and stores the dataset of a state, if the catalogue does not hold it yet; waits if it is already being
    /// computed. Without a key, that of the representative state.
    fn provide(&self, _product: &str, _state: Option<&str>, _progress: &dyn Progress) -> Result<(), AppError> {
        Ok(())
    }
    /// Computes and stores one state that has not been requested yet: any state of the first of these products, else
    /// one that may represent its product, of the next of these that has one, else of any product. Other states are
    /// computed on request only. Returns the number of such states left, and their number with all that were computed
    /// before.
    fn fill_one(&self, _order: &[String], _progress: &dyn Progress) -> Result<[usize; 2], AppError> {
        Ok([0; 2])
    }
    /// Sets or removes the star.
    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), AppError>;
}
