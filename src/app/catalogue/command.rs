//! Commands of the product list, except for searching: display, collections, subscriptions.

use std::path::PathBuf;

/// Command about the product list, except for searching.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CatalogueCommand {
    /// Show the products as a gallery of pictures, or as a list.
    Gallery,
    /// Select the first product of the list, and give it the keyboard.
    First,
    /// Show only recently selected products, or all.
    Recent,
    /// Set or remove the star of the selected product.
    Star,
    /// Add a product (the selected one if `None`) to a collection, or remove it.
    Collect {
        /// Name of the collection.
        name: String,
        /// Key of the product.
        product: Option<String>,
        /// Whether the product is added.
        put: bool,
    },
    /// Remove all products from a collection.
    Disband(String),
    /// Set the name of a new collection in its text field.
    EditName(String),
    /// Ask for a folder of packages to subscribe to.
    Subscribe,
    /// Subscribe to a folder.
    SubscribeTo(PathBuf),
    /// End the subscription to a folder.
    Unsubscribe(String),
}
