//! Errors of the catalogue.

use super::messages::{REMEDY, of_place, user_message};
use crate::formats::dataset_blob::BlobError;
use crate::formats::package::PackageError;
use std::path::PathBuf;

/// Error of an operation on the catalogue.
#[derive(Debug, thiserror::Error)]
pub enum CatalogueError {
    /// File that cannot be opened or created.
    #[error("catalogue {}: {}", path.display(), user_message(cause))]
    Open {
        /// Path of the file.
        path: PathBuf,
        /// SQLite's error. Not a `source`: it is part of the sentence.
        cause: rusqlite::Error,
    },
    /// Folder of the file that cannot be created.
    #[error("catalogue folder {} cannot be made ({cause}); check path and rights", path.display())]
    Folder {
        /// Path of the folder.
        path: PathBuf,
        /// Error of the operating system.
        cause: std::io::Error,
    },
    /// Number of a database layout that no version of the program writes.
    #[error(
        "the catalogue {path} is damaged: its layout has the number {found}, programs write 1 to {known}; {REMEDY}"
    )]
    Layout {
        /// Path of the file.
        path: String,
        /// Layout number in the file.
        found: i64,
        /// Newest layout that this program knows.
        known: i64,
    },
    /// File with the layout of an older program, in a folder where nothing can be written, so that it cannot be
    /// converted.
    #[error(
        "the catalogue {path} has the layout {found} of an older version of cfs and lies where it cannot be brought to layout \
         {known}; copy it to a place that can be written"
    )]
    Older {
        /// Path of the file.
        path: String,
        /// Layout number in the file.
        found: i64,
        /// Layout that this program reads.
        known: i64,
    },
    /// Recent changes in the write-ahead log beside the catalogue file, which can be read only where something can be
    /// written.
    #[error(
        "the catalogue {} lies where nothing can be written, and its last changes in {}-wal cannot be read there; copy both to \
         another place",
        path.display(), path.display()
    )]
    Waiting {
        /// Path of the file.
        path: PathBuf,
    },
    /// Stored data that differ from what was stored.
    #[error("the catalogue is damaged: {0}; {REMEDY}")]
    Damaged(String),
    /// Missing folder for user data: the operating system does not name one.
    #[error("no folder for the catalogue is known; name a file with CFS_CATALOGUE or --catalogue")]
    NoHome,
    /// Database of another program.
    #[error("{0} is a database, but not a catalogue")]
    NotACatalogue(String),
    /// File written by a newer program.
    #[error(
        "the catalogue {path} was written by a newer version of cfs (layout {found}; this program reads up to {known})"
    )]
    Newer {
        /// Path of the file.
        path: String,
        /// Layout number in the file.
        found: i64,
        /// Newest layout that this program knows.
        known: i64,
    },
    /// Key without a product.
    #[error("no product \"{0}\" in the catalogue")]
    NoProduct(String),
    /// Missing state: the product has none with this key, or it has several and none was named.
    #[error("product \"{product}\": {what}; its states are: {states}")]
    NoState {
        /// Key of the product.
        product: String,
        /// Reason why the request cannot be met.
        what: String,
        /// Keys of the product's states.
        states: String,
    },
    /// State of a built-in product whose data are not computed yet.
    #[error(
        "the data of \"{product}\"{} are not computed yet; `cfs catalogue build` computes those of all products",
        if state.is_empty() { String::new() } else { format!(", state \"{state}\",") }
    )]
    NotComputed {
        /// Key of the product.
        product: String,
        /// Key of the state.
        state: String,
    },
    /// Dataset or product that does not meet the conditions for import.
    #[error("cannot import: {0}")]
    Import(String),
    /// Attempt to remove a built-in product.
    #[error("product \"{0}\" is built in and cannot be removed permanently; it can be deleted, which hides it")]
    BuiltIn(String),
    /// Attempt to change the descriptive texts of a built-in product.
    #[error(
        "product \"{0}\" is built in and keeps its name, kind and tags; export and import it to have one of your own"
    )]
    BuiltInWords(String),
    /// Attempt to change a product of a subscribed folder.
    #[error(
        "product \"{product}\" comes from {folder}, which is subscribed to and only read; export and import it to have one of your own"
    )]
    Subscribed {
        /// Key of the product.
        product: String,
        /// Path of the folder of packages.
        folder: String,
    },
    /// Folder that is not subscribed to.
    #[error("{0} is not subscribed to; `cfs catalogue subscriptions` lists the folders that are")]
    NotSubscribed(String),
    /// Attempt to give a product an empty name.
    #[error("product \"{0}\" needs a name")]
    NoName(String),
    /// Empty name of a collection.
    #[error("a collection needs a name")]
    NoCollectionName,
    /// Product that is hidden already.
    #[error("product \"{0}\" is already deleted")]
    Deleted(String),
    /// Product that is not hidden.
    #[error("product \"{0}\" is not deleted")]
    NotDeleted(String),
    /// Stored or packed dataset that cannot be read.
    #[error("dataset {hash}: {cause}")]
    Dataset {
        /// Hash of the dataset.
        hash: String,
        /// Error of the dataset reader.
        cause: BlobError,
    },
    /// Package that cannot be read or written.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// Database error.
    #[error("catalogue: {}", user_message(.0))]
    Sql(rusqlite::Error),
}

// Not as a `source`: the sentence contains it already, and a chain of causes would repeat it.
impl From<rusqlite::Error> for CatalogueError {
    fn from(error: rusqlite::Error) -> Self {
        Self::Sql(error)
    }
}

impl CatalogueError {
    /// Whether the error is caused by the file's location, such as a read-only folder, rather than by its content.
    pub fn of_place(&self) -> bool {
        match self {
            Self::Open { cause, .. } | Self::Sql(cause) => of_place(cause),
            _ => false,
        }
    }
}
