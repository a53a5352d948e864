//! Complex fenestration systems: from a measured or computed BTDF to the light in a room.
//!
//! A complex fenestration system (blind, prismatic or laser-cut panel, diffuser, …) is described by its bidirectional
//! transmittance distribution function. This library stores such data, compares them, and computes their effect: under
//! a sky the system becomes a luminaire with a luminous intensity distribution, and that luminaire lights a room. The
//! binary `cfs` is a window and a command line over it. The method is that of the IEA SHC Task 31 report of 2005;
//! equation numbers in the documentation refer to it.
//!
//! This page describes the architecture. The guide for users is the module `guide`.
//!
//! # Bird's-eye view
//!
//! ```text
//!  dataset files ──► formats ──► Dataset ──► catalogue (SQLite)
//!                                   │             │
//!  scene file ──► study::scene_file ──► scene ◄───┘
//!                                         │
//!                                  plan (what this scene needs)
//!                                         │
//!                                      session ──► compute: sky ► system's BTDF ► LID ► room
//!                                         │
//!                              cli (CSV, JSON, .ldt, .ies)   app (window)
//! ```
//!
//! A study made in the window is a scene file; the command line computes the same numbers from it. A plot is data first
//! ([`drawing::plot`]): window and picture files draw the same series.
//!
//! # Layers
//!
//! Imports go one way: ([`texts`], [`compute`]) ← [`drawing`] ← [`formats`] ← [`catalogue`] ← [`study`] ← [`report`] ←
//! {[`cli`], [`app`]} ← `main`.
//! Each layer below [`cli`] and [`app`] is a crate, `cfs-NAME` in `src/NAME`, which is built without those above it; other
//! crates call it by the name of its folder. What the compiler does not see, `tests/tidy` enforces.
//!
//! | module | owns | must not touch |
//! | --- | --- | --- |
//! | [`texts`] | labels and messages in English and German | numbers, data |
//! | [`compute`] | physics and numerics: numbers in, numbers out | files, clocks, serde, SQL, egui, output |
//! | [`drawing`] | pictures without a window: plots as data, line drawings as SVG and PNG | files and paths, serde, egui |
//! | [`formats`] | every byte layout of data, as `&[u8]` ↔ values | files and paths, SQL, egui |
//! | [`catalogue`] | the SQLite file: schema, search, exchange of products | egui, scene files |
//! | [`study`] | scene → what is needed → result, with progress and cancelling | SQL, egui, terminal |
//! | [`report`] | exports: tiles as pictures, reports as PDF | files and paths, SQL, egui |
//! | [`cli`] | arguments, tables, JSON, exit codes | SQL, egui, the window |
//! | [`app`] | state, commands, drawing, file dialogs | SQL, byte layouts, the command line |
//!
//! # Invariants
//!
//! - The façade frame is x to the right seen from outside, y up, z outward. The type of a direction says where it
//!   points: [`Incident`](compute::direction::Incident) towards the source,
//!   [`Emergent`](compute::direction::Emergent) in which light leaves. Emergent directions are stored by their through
//!   direction ω′ = −ω_a, which makes reciprocity a transpose.
//! - Angles are in radians and all other quantities in SI units; degrees occur only in files, arguments and pictures.
//! - Integrated numbers carry their uncertainty ([`Estimate`](compute::estimate::Estimate)).
//! - Every derivation, repair and approximation is reported as a [`Finding`](compute::btdf::Finding).
//! - Invalid input is an error that says where it is, what was found and what was expected. A panic is a bug: open work
//!   is saved, and a report is written ([`study::fault`]). Files are written completely or not at all.
//! - Sums are computed in a fixed order: results do not depend on the number of threads.
//! - Released migrations are never edited.
//!
//! # Where do I change …
//!
//! | I want to … | edit |
//! | --- | --- |
//! | add a dataset format | a file in [`formats`], an arm of [`formats::Format`] and of its dispatch |
//! | add a luminaire format | a file in [`formats`] over [`formats::luminaire`], an arm of [`formats::LuminaireFormat`] and of its methods; the extensions that help and messages name |
//! | add a sky model | a file in [`compute::sky`], where `distribution` and `horizontal` have an arm for luminances of a new form; its key, labels and usual values in [`study::scene_file`], its arm in [`study::sky`]; fields for keys of its own in [`app::panels`] |
//! | add a weather format | a file in [`formats::weather`] that fills a [`compute::weather::Weather`], its arm in [`formats::weather::read`] |
//! | add a family of systems | a folder in [`compute::system`] that implements [`compute::system::Family`], its arm in [`compute::system::SystemKind`], its keys in [`formats::system_toml`], a description under `assets/systems` |
//! | add a built-in product | a description under `assets/systems`, whose README says how to compute the table of figures; [`catalogue::SYSTEMS`] lists all |
//! | add a check or a repair of data | [`compute::doctor`] |
//! | add an annual metric, which can be an objective of rankings | its value in [`compute::year`], its entry in the table of metrics of [`study::year`], its labels in [`texts::year`] |
//! | add a figure to comparisons | [`study::comparison`]: its entry in `FIGURES`, its input in `Facts` |
//! | add a shading control | [`compute::control`], its key in [`study::scene_file`] |
//! | change an angle convention | [`compute::direction`], nowhere else |
//! | add a scene key | [`study::scene_file`], then [`study::scene`]; describe it in `examples/office.toml` |
//! | skip work that a scene does not need | [`study::plan`] |
//! | add or change a label or message of the window | a line in [`texts`], in both languages |
//! | add a subcommand | a file in [`cli`] named like it |
//! | change the guide | the page in `assets/guide`; `tests/cli/documents.rs` says how its examples are tested |
//! | add a kind of obstruction to the window's commands | [`app::scene::outside`] |
//! | change the tour | [`app::tour`] |
//! | add a feature to the window | a folder in [`app`] with its state, its commands and what they do; its field in [`app::window::App`]; where it has jobs, their results in [`app::results::work::Outcome`] and a lane in [`app::shell::lane`] |
//! | add a command, a menu entry or a shortcut | [`app::command`], its entry in [`app::offer`], its effect in its feature, to which [`app::apply`] hands it |
//! | change which imported files belong to one product | [`catalogue::Grouping`] and its file |
//! | extend the report on an internal error | [`study::fault`]; the window's part in [`app::session`] |
//! | store more from one start to the next | [`app::session`], or [`app::state::Settings`] |
//! | add a picture | a file in [`app::views`], shared axes in [`app::paint`] |
//! | add a tile | a picture, a file in [`app::tiles`] that prepares its data, its entry in [`app::tiles::TILES`] |
//! | add a plot, in the window or in a file | its numbers as a [`drawing::plot::Plot`]; [`app::paint::plot`] and [`drawing::chart`] draw it |
//! | add a tile to the exports, or a kind of report | a file in [`report`] |
//! | store new data in the catalogue | the next `migrations/NNNN_*.sql`, then [`catalogue`] |

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

pub mod app;
pub mod cli;
// Without code: pages that change need no new build.
#[cfg(any(doc, doctest))]
pub mod guide;

pub use cfs_catalogue as catalogue;
pub use cfs_compute as compute;
pub use cfs_drawing as drawing;
pub use cfs_formats as formats;
pub use cfs_report as report;
pub use cfs_study as study;
pub use cfs_texts as texts;

/// README, whose example is a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
