//! Measured datasets as text, `.btdf.txt`: a TOML header between two lines `---`, then numbers, one record per line.
//!
//! Angles of the file are degrees in the façade frame on both sides (φ counter-clockwise seen from outside, 0 = right,
//! 90 = up; θ from the outward normal). The incident direction points towards the source, transmitted and reflected
//! ones point in the direction in which light leaves; `frame` converts them into the stored directions of
//! [`crate::compute::direction`].
//!
//! Read: both layouts (`rings`: means over cells; `points`: values at directions, resampled onto cells with a stated
//! error); incidences on Tregenza's or Klems' 145 directions or any list; means over incident cells
//! ([`Scattered::Cells`](crate::compute::btdf::Scattered::Cells)) and values at directions
//! ([`Scattered::Directions`](crate::compute::btdf::Scattered::Directions)); transmission and reflection from either
//! side. Missing incidences stay missing unless the header declares a symmetry. A file holds one function of one
//! state; [`crate::formats::merge_sides`] joins the files of one state.
//!
//! An extension of the header, for data that were computed from a description (`.system.toml`): `beams = "cfs-beams 1"`
//! with `system` (its text, in which stacks hold their layers themselves), `system_state` where the key of its state
//! differs from the file's `state`, and `fingerprint`. If the fingerprint fits the file, the description becomes the
//! dataset's [`described`](crate::compute::btdf::Dataset::described), so that beams are computed and not extracted from
//! cells. If not, the data were changed since: they are read, the description is ignored, and the finding
//! `beams-not-restored` reports it. A newer version of the extension is refused. Files written by hand omit all four
//! keys.
//!
//! Not read: other bands than the visible one, several headers in a file, records broken over lines.

mod beams;
mod frame;
mod header;
mod incidence;
mod points;
mod quote;
mod read;
mod records;
mod rings;
mod symmetry;
mod write;

use crate::compute::limits;
pub use header::CatalogueFields;
pub use read::{catalogue_fields, read};
pub use write::{write, write_component};

/// Value of the header's `format` key.
pub const FORMAT: &str = "cfs-btdf 1";
/// Beginning of [`Dataset::format`](crate::compute::btdf::Dataset::format) of datasets read from this format.
pub const FAMILY: &str = "cfs-btdf";

/// Maximum number of values of a file, the same as in the compact binary format.
const MOST_VALUES: usize = limits::VALUES;
/// Maximum number of incident directions of a file.
const MOST_INCIDENCES: usize = limits::INCIDENCES;
/// Maximum number of emergent cells of a file.
const MOST_CELLS: usize = limits::CELLS;
/// Angle below which directions count as equal (as in [`Indicatrices`](crate::compute::btdf::Indicatrices)). \[rad\]
const SAME_DIRECTION: f64 = 2e-3;
