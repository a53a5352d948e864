//! Interface from the window to the catalogue of products. A trait, so that tests can use a slow or failing
//! implementation.

use crate::app::shell::error::AppError;
use crate::catalogue::{Collection, Subscription};
use crate::catalogue::{Deleted, Event, Known, NewProduct, Product, Replacement, Snapshot, StateName, Stored, Words};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Progress;
use crate::study::StudyError;
use crate::study::control::ControlQuestion;
use crate::study::subscriptions::Report;
use std::sync::Arc;

/// Row of the list of products: name, figures and tags of one product.
pub use crate::catalogue::ProductRow as Entry;
/// Search of the catalogue, and its result.
pub use crate::catalogue::{Found, Query};

/// Product of the catalogue that matches the text of the command palette.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hit {
    /// Key of the product.
    pub key: String,
    /// Name of the product.
    pub name: String,
    /// Further information about the product: manufacturer and kind.
    pub about: String,
}

/// Product to be stored in the catalogue: the datasets of its states, and the user's texts about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Datasets of the product, one for each state.
    pub datasets: Vec<Arc<Dataset>>,
    /// Texts about the product: name, kind, source of the data.
    pub product: NewProduct,
}

/// Collections and subscriptions of a catalogue.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Sets {
    /// Collections, sorted by name.
    pub collections: Vec<Collection>,
    /// Subscribed folders of packages.
    pub subscriptions: Vec<Subscription>,
}

/// Catalogue of products as the window uses it.
pub trait Shelf: Send + Sync {
    /// Returns the products that a search finds.
    fn search(&self, query: &Query) -> Result<Found, AppError>;
    /// Returns the dataset of a state of a product, computed now if the catalogue does not hold it. Products and states
    /// are given by their keys; `None`: the representative state.
    fn load(&self, product: &str, state: Option<&str>) -> Result<Arc<Dataset>, AppError>;
    /// Returns all information about a product except its datasets: states with their figures, control curve, texts.
    fn product(&self, product: &str) -> Result<Arc<Product>, AppError>;
    /// Returns the key of the state that a control rule chooses for a product.
    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError>;
    /// Stores a product, and returns its new key.
    fn add(&self, addition: &Addition) -> Result<String, AppError>;
    /// Stores all of these products, or none if one cannot be stored.
    fn add_all(&self, additions: &[Addition]) -> Result<Vec<Stored>, AppError>;
    /// Removes all of these products permanently, or none if one cannot be removed.
    fn remove_all(&self, products: &[String]) -> Result<(), AppError>;
    /// Changes the texts of a product.
    fn describe(&self, product: &str, words: &Words) -> Result<(), AppError>;
    /// Deletes a product, which can be restored.
    fn delete(&self, product: &str) -> Result<(), AppError>;
    /// Restores a deleted product.
    fn restore(&self, product: &str) -> Result<(), AppError>;
    /// Returns the deleted products, newest first.
    fn deleted(&self) -> Result<Vec<Deleted>, AppError>;
    /// Returns the products that were read from source files with this hash, without deleted ones.
    fn products_from(&self, source_hash: &str) -> Result<Vec<Known>, AppError>;
    /// Returns the products with a state whose data have this content hash, without deleted ones.
    fn products_holding(&self, content: &str) -> Result<Vec<Known>, AppError>;
    /// Returns the history of a product as a list of changes, newest first.
    fn history(&self, product: &str) -> Result<Vec<Event>, AppError>;
    /// Returns the paths of the source files of a product.
    fn source_paths(&self, product: &str) -> Result<Vec<String>, AppError>;
    /// Returns a copy of the current content of a product, including its data; only for products that the user added.
    fn snapshot(&self, product: &str) -> Result<Snapshot, AppError>;
    /// Restores the content of a product from a snapshot.
    fn put_back(&self, snapshot: &Snapshot) -> Result<(), AppError>;
    /// Changes names and angles of all states of a product, given in the order of the states.
    fn name_states(&self, product: &str, names: &[StateName]) -> Result<(), AppError>;
    /// Replaces the data of some states of a product.
    fn replace_states(&self, product: &str, list: &[Replacement]) -> Result<(), AppError>;
    /// Returns the subscribed folder that a product comes from; `None` for other products.
    fn subscribed_folder(&self, product: &str) -> Result<Option<String>, AppError>;
    /// Returns the collections, sorted by name.
    fn collections(&self) -> Result<Vec<Collection>, AppError>;
    /// Adds products to a collection, given by its name, if `put`; otherwise removes them from it.
    fn collect(&self, name: &str, products: &[String], put: bool) -> Result<(), AppError>;
    /// Returns the subscribed folders of packages.
    fn subscriptions(&self) -> Result<Vec<Subscription>, AppError>;
    /// Subscribes to a folder of packages; its products appear when it is read, see [`Self::sync`].
    fn subscribe(&self, folder: &str) -> Result<(), AppError>;
    /// Ends the subscription to a folder, which removes its products, and returns the number of these.
    fn unsubscribe(&self, folder: &str) -> Result<usize, AppError>;
    /// Reads the packages in subscribed folders that have changed.
    fn sync(&self, _progress: &dyn Progress) -> Result<Report, AppError> {
        Ok(Report::default())
    }
    /// Whether the dataset of a state can be loaded without being computed; `None`: that of the representative state.
    fn is_ready(&self, _product: &str, _state: Option<&str>) -> Result<bool, AppError> {
        Ok(true)
    }
    /// Computes and stores the dataset of a state, if the catalogue does not hold it yet; waits if it is already being
    /// computed. `None`: that of the representative state.
    fn provide(&self, _product: &str, _state: Option<&str>, _progress: &dyn Progress) -> Result<(), AppError> {
        Ok(())
    }
    /// Computes and stores the dataset of one state that is still missing: any state of the first product of `order`;
    /// otherwise a state that may be the representative one of its product, of the next product in `order` that has
    /// one, or else of any product. Other states are computed on request only. Returns the number of such states that
    /// are still missing, and the number of all such states.
    fn fill_one(&self, _order: &[String], _progress: &dyn Progress) -> Result<[usize; 2], AppError> {
        Ok([0; 2])
    }
    /// Adds a product to the favourites (`favourite`), or removes it.
    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), AppError>;
}
