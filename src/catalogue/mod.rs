//! The catalogue of products: one SQLite file with full-text search, in which datasets lie in compact binary form.
//!
//! ```no_run
//! use cfs::catalogue::{Catalogue, Query};
//! let catalogue = Catalogue::open_default()?;
//! for row in catalogue.search(&Query { text: "slat".into(), ..Query::default() })? {
//!     println!("{} {}", row.key, row.name);
//! }
//! # Ok::<(), cfs::catalogue::CatalogueError>(())
//! ```
//!
//! A [`Catalogue`] is one connection; several connections, threads and windows may work on one file at a time.
//! Every change is one transaction: it happens as a whole or not at all.

mod builtin;
mod compare;
mod connection;
mod described;
mod error;
mod exchange;
mod gather;
mod grouping;
mod keeping;
mod open;
mod product;
mod search;
mod sight;
mod source_file;
mod store;
mod systems;
mod validate;

pub use builtin::{BUILTIN_ERROR, BUILTIN_VERSION};
pub use compare::{Merged, PackageDiff, ProductDiff, StateDiff, diff_packages, merge_packages};
pub use connection::Catalogue;
pub use described::{control_curve, described_dataset, method, product_of};
pub use error::CatalogueError;
pub use gather::{Gathered, gather};
pub use grouping::Grouping;
pub use keeping::{Deleted, Known, Words};
pub use open::default_path;
pub use product::{
    CurvePoint, Imported, NewProduct, Origin, PROFILE_ANGLES, Product, ProductFinding, Provenance, State, StateName,
    profile_transmittances,
};
pub use search::{Facet, Facets, ProductRow, Query};
pub use source_file::SourceFile;
pub use systems::{SYSTEMS, blind_of, builtin_system};
pub use validate::check;
