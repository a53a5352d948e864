//! Complex fenestration systems: from a measured or computed BTDF to the light in a room.
//!
//! A complex fenestration system (blind, prismatic or laser-cut panel, diffuser, …) is described by its bidirectional
//! transmittance distribution function. This library keeps such data, lets them be compared, and computes what they
//! do: under a sky the system becomes a luminaire with a luminous-intensity distribution, and that luminaire lights a
//! room. The binary `cfs` is a window and a command line over it. The method is that of the IEA SHC Task 31 report of
//! 2005; equation numbers in the documentation are its own.
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
//! A study made in the window is a scene file; the command line runs the same file to the same numbers.
//! An ordinary plot is data first ([`drawing::plot`]): window and picture files draw the same series.
//!
//! # Layers
//!
//! Imports go one way: ([`texts`], [`compute`]) ← [`drawing`] ← [`formats`] ← [`catalogue`] ← [`study`] ← [`report`] ←
//! {[`cli`], [`app`]} ← `main`.
//! `tests/tidy` enforces it.
//!
//! | module | owns | must not touch |
//! | --- | --- | --- |
//! | [`texts`] | words in English and German | figures, data |
//! | [`compute`] | physics and numerics: numbers in, numbers out | files, clocks, serde, SQL, egui, output |
//! | [`drawing`] | pictures without a window: plots as data, line drawings as SVG and PNG | files and paths, serde, egui |
//! | [`formats`] | every byte layout of data, as `&[u8]` ↔ values | files and paths, SQL, egui |
//! | [`catalogue`] | the SQLite file: schema, search, exchange of products | egui, scene files |
//! | [`study`] | scene → what is needed → result, with progress and cancelling | SQL, egui, terminal |
//! | [`report`] | what is handed on: tiles as pictures, reports as PDF | files and paths, SQL, egui |
//! | [`cli`] | arguments, tables, JSON, exit codes | SQL, egui, the window |
//! | [`app`] | state, commands, drawing, file dialogs | SQL, byte layouts, the command line |
//!
//! # Invariants
//!
//! - The façade frame is x to the right seen from outside, y up, z outward. Where a direction points is in its type:
//!   [`Incident`](compute::direction::Incident) towards the source, [`Emergent`](compute::direction::Emergent) where
//!   light goes. Emergent directions are stored by their through-name ω′ = −ω_a, which makes reciprocity a transpose.
//! - Angles are radians and everything else is SI inside; degrees live at the borders (files, arguments, pictures).
//! - Integrated numbers carry an estimate of their error ([`Estimate`](compute::estimate::Estimate)).
//! - What was derived, repaired or approximated is told as a [`Finding`](compute::btdf::Finding); nothing is mended
//!   in silence.
//! - Bad input is an error that says what, where and what would be right; a panic is a bug: what is open is
//!   saved, and a report is left ([`study::fault`]). Nothing half-written stays behind.
//! - Sums run in a fixed order: results do not depend on the number of threads.
//! - Released migrations are never edited.
//!
//! # Where do I change …
//!
//! | I want to … | edit |
//! | --- | --- |
//! | add a dataset format | a file in [`formats`], an arm of [`formats::Format`] and of its dispatch |
//! | add a luminaire format | a file in [`formats`] over [`formats::luminaire`], its extension in [`study::luminaire_file`] and [`study::luminaires`] |
//! | add a sky model | a file in [`compute::sky`], its key and words in [`study::scene_file`], its arm in [`study::sky`] |
//! | add a weather format | a file in [`formats::weather`] that fills a [`compute::weather::Weather`], its arm in [`formats::weather::read`] |
//! | add a family of systems | a room in [`compute::system`] that answers [`compute::system::Family`], its arm in [`compute::system::SystemKind`], its keys in [`formats::system_toml`], a description under `assets/systems` |
//! | add a built-in product | a description under `assets/systems`, whose README says how the table of figures follows: all are [`catalogue::SYSTEMS`] |
//! | add a check or a repair of data | [`compute::doctor`] |
//! | add a figure by which things are compared | [`study::comparison`]: its entry in `FIGURES`, what it reads in `Facts` |
//! | add a control rule | [`compute::control`], its key in [`study::scene_file`] |
//! | change an angle convention | [`compute::direction`], nowhere else |
//! | add a scene key | [`study::scene_file`], then [`study::scene`]; describe it in `examples/office.toml` |
//! | skip work that a scene does not need | [`study::plan`] |
//! | say something in the window, or say it better | a line in [`texts`], in both languages |
//! | add a subcommand | a file in [`cli`] named like it |
//! | put another kind of thing outside by a command | [`app::outside`] |
//! | change the tour | [`app::tour`] |
//! | add a command, a menu entry or a shortcut | [`app::command`], its entry in [`app::offer`], its effect in [`app::apply`] |
//! | change what belongs to a product when files come in | [`catalogue::Grouping`] and its file |
//! | say more in the report on a fault of the program | [`study::fault`]; the window's part in [`app::faults`] |
//! | keep something more from one start to the next | [`app::session`], or [`app::state::Settings`] |
//! | add a picture | a file in [`app::views`], shared axes in [`app::paint`] |
//! | add a tile to the bench | a picture, a file in [`app::tiles`] that feeds it, its entry in [`app::tiles::TILES`] |
//! | add a plot, in the window or in a file | its numbers as a [`drawing::plot::Plot`]; [`app::paint::plot`] and [`drawing::chart`] draw it |
//! | add a tile to what is handed on, or a kind of report | a file in [`report`] |
//! | store something new | the next `migrations/NNNN_*.sql`, then [`catalogue`] |

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

pub mod app;
pub mod catalogue;
pub mod cli;
pub mod compute;
pub mod drawing;
pub mod formats;
pub mod report;
pub mod study;
pub mod texts;
