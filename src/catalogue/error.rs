//! What can go wrong with the catalogue.

use super::told::{REMEDY, of_place, told};
use crate::formats::dataset_blob::BlobError;
use crate::formats::package::PackageError;
use std::path::PathBuf;

/// Why the catalogue could not do what it was asked.
#[derive(Debug, thiserror::Error)]
pub enum CatalogueError {
    /// The file cannot be opened or made.
    #[error("catalogue {}: {}", path.display(), told(cause))]
    Open {
        /// Which file.
        path: PathBuf,
        /// What SQLite says. Not a source: it is part of the sentence.
        cause: rusqlite::Error,
    },
    /// The folder of the file cannot be made.
    #[error("catalogue folder {} cannot be made ({cause}); check path and rights", path.display())]
    Folder {
        /// Which folder.
        path: PathBuf,
        /// What the system says.
        cause: std::io::Error,
    },
    /// A layout that no program writes.
    #[error(
        "the catalogue {path} is damaged: its layout has the number {found}, programs write 1 to {known}; {REMEDY}"
    )]
    Layout {
        /// Which file.
        path: String,
        /// Layout that the file names.
        found: i64,
        /// Newest layout this program knows.
        known: i64,
    },
    /// Written by an older program, where nothing can be written.
    #[error(
        "the catalogue {path} has the layout {found} of an older version of cfs and lies where it cannot be brought to layout \
         {known}; copy it to a place that can be written"
    )]
    Older {
        /// Which file.
        path: String,
        /// Layout of the file.
        found: i64,
        /// Layout that this program reads.
        known: i64,
    },
    /// Changes wait in a file beside it, which can be read only where something can be written.
    #[error(
        "the catalogue {} lies where nothing can be written, and its last changes in {}-wal cannot be read there; copy both to \
         another place",
        path.display(), path.display()
    )]
    Waiting {
        /// Which file.
        path: PathBuf,
    },
    /// What is stored is not what was stored.
    #[error("the catalogue is damaged: {0}; {REMEDY}")]
    Damaged(String),
    /// The system names no folder for a user's data.
    #[error("no folder for the catalogue is known; name a file with CFS_CATALOGUE or --catalogue")]
    NoHome,
    /// A database of something else.
    #[error("{0} is a database, but no catalogue")]
    NotACatalogue(String),
    /// Written by a newer program.
    #[error(
        "the catalogue {path} was written by a newer version of cfs (layout {found}; this program reads up to {known})"
    )]
    Newer {
        /// Which file.
        path: String,
        /// Layout of the file.
        found: i64,
        /// Newest layout this program knows.
        known: i64,
    },
    /// No product of this key.
    #[error("no product \"{0}\" in the catalogue")]
    NoProduct(String),
    /// The product has no state of this key, or several and none was named.
    #[error("product \"{product}\": {what}; its states are: {states}")]
    NoState {
        /// Key of the product.
        product: String,
        /// What is wrong with the request.
        what: String,
        /// The keys there are.
        states: String,
    },
    /// A state of a built-in product whose data nobody has asked for yet.
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
    /// Data that cannot be stored.
    #[error("cannot import: {0}")]
    Import(String),
    /// Built-in products stay.
    #[error(
        "product \"{0}\" is built in and cannot be removed for good; it can be deleted, which takes it out of sight"
    )]
    BuiltIn(String),
    /// Built-in products keep their names.
    #[error(
        "product \"{0}\" is built in and keeps its name, kind and tags; export and import it to have one of your own"
    )]
    BuiltInWords(String),
    /// Products of subscribed folders are not changed here.
    #[error(
        "product \"{product}\" comes from {folder}, which is subscribed to and only read; export and import it to have one of your own"
    )]
    Subscribed {
        /// Key of the product.
        product: String,
        /// The folder of packages.
        folder: String,
    },
    /// No such subscription.
    #[error("{0} is not subscribed to; `cfs catalogue subscriptions` lists the folders that are")]
    NotSubscribed(String),
    /// A product without a name.
    #[error("product \"{0}\" needs a name")]
    NoName(String),
    /// A collection without a name.
    #[error("a collection needs a name")]
    NoCollectionName,
    /// It is out of sight already.
    #[error("product \"{0}\" is deleted already")]
    Deleted(String),
    /// It is in sight.
    #[error("product \"{0}\" is not deleted")]
    NotDeleted(String),
    /// A stored or packed dataset cannot be read.
    #[error("dataset {hash}: {cause}")]
    Dataset {
        /// Its hash.
        hash: String,
        /// Why.
        cause: BlobError,
    },
    /// A package cannot be read or written.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// SQLite.
    #[error("catalogue: {}", told(.0))]
    Sql(rusqlite::Error),
}

// Not as a source: the sentence has it already, and a chain of causes would say it twice.
impl From<rusqlite::Error> for CatalogueError {
    fn from(error: rusqlite::Error) -> Self {
        Self::Sql(error)
    }
}

impl CatalogueError {
    /// Is it the place of the file that refuses to be written to?
    pub fn of_place(&self) -> bool {
        match self {
            Self::Open { cause, .. } | Self::Sql(cause) => of_place(cause),
            _ => false,
        }
    }
}
