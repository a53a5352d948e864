//! Catalogue of products: one SQLite file with full-text search, in which datasets lie in compact binary form.
//!
//! ```no_run
//! use cfs_catalogue::{Catalogue, Query};
//! let catalogue = Catalogue::open_default()?;
//! for row in catalogue.search(&Query { text: "slat".into(), ..Query::default() })? {
//!     println!("{} {}", row.key, row.name);
//! }
//! # Ok::<(), cfs_catalogue::CatalogueError>(())
//! ```
//!
//! A [`Catalogue`] is one connection; several connections, threads and windows may work on one file at a time.
//! Every change is one transaction: it happens as a whole or not at all.

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

// Layers have these names in all crates.
use cfs_compute as compute;
use cfs_formats as formats;
use cfs_texts as texts;

mod ambiguity;
mod builtin;
mod collections;
mod compare;
mod connection;
mod content;
mod described;
mod editing;
mod error;
mod exchange;
mod gather;
mod grouping;
mod health;
mod history;
mod index;
mod index_words;
mod keeping;
mod like;
mod messages;
mod numbered;
mod open;
mod product;
mod query;
mod query_facets;
mod record;
mod representative;
mod rows;
mod salvage;
mod sealing;
mod search;
mod sight;
mod source_file;
mod store;
mod subscribed;
mod systems;
mod validate;
mod verified;
mod waiting;
mod words;

pub use ambiguity::Ambiguity;
pub use builtin::{BUILTIN_ERROR, BUILTIN_VERSION, TABLE, builtin_method, fingerprint, key_of_builtin};
pub use collections::Collection;
pub use compare::{Merged, PackageDiff, ProductDiff, StateDiff, diff_packages, merge_packages};
pub use connection::Catalogue;
pub use content::content_of;
pub use described::{METHODS, control_curve, described_dataset, method, product_of, stated_error};
pub use editing::{Replacement, Snapshot};
pub use error::CatalogueError;
pub use exchange::{Stored, unpack};
pub use gather::{Gathered, gather, gathered, key_of_angle};
pub use grouping::{Grouping, Proposal, propose};
pub use health::{Damage, Health, Place, check_file, copy_aside, repair_file};
pub use history::Event;
pub use index::{Found, Index};
pub use keeping::{Deleted, Known, Words};
pub use like::{Likeness, ProductDistance};
pub use open::default_path;
pub use product::{
    CurvePoint, Imported, NewProduct, Origin, PROFILE_ANGLES, Product, ProductFinding, Provenance, State, StateName,
    profile_transmittances,
};
pub use query::{Figure, Filter, Query, Sort, Within};
pub use query_facets::{Facet, Facets};
pub use record::light;
pub use representative::{FirstRule, Numbers, TYPICAL_SUN, representative};
pub use rows::{ProductRow, Sought};
pub use source_file::SourceFile;
pub use subscribed::{Subscription, Synced};
pub use systems::{SYSTEMS, blind_of, builtin_system, moving_part, slats_of};
pub use validate::check;
pub use waiting::StateKey;
