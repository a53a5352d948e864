//! What can be done with the list of products beside searching it: how it is shown, collections, subscriptions.

use std::path::PathBuf;

/// One thing to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Shelving {
    /// Show the products as a gallery of pictures, or as a list.
    Gallery,
    /// Choose the first product of the list, and give it the keyboard.
    First,
    /// Products that were shown last alone, or all.
    Recent,
    /// Set or take the star of the selected product.
    Star,
    /// Put a product (the selected one where it is `None`) into a collection, or take it out.
    Collect {
        /// Name of the collection.
        name: String,
        /// Key of the product.
        product: Option<String>,
        /// In, not out.
        put: bool,
    },
    /// Take all products out of a collection.
    Disband(String),
    /// Type the name of a new collection.
    EditName(String),
    /// Ask for a folder of packages to subscribe to.
    Subscribe,
    /// Subscribe to a folder.
    SubscribeTo(PathBuf),
    /// End the subscription to a folder.
    Unsubscribe(String),
}
