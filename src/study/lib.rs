//! Library from a scene to its results: what the window, the command line and other programs call.
//!
//! [`scene_file`] is the scene file as typed, [`scene`] the resolved scene, [`plan`] the stages that it needs,
//! [`session`] the computations.

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

// Layers have these names in all crates.
use crate as study;
use cfs_catalogue as catalogue;
use cfs_compute as compute;
use cfs_drawing as drawing;
use cfs_formats as formats;
use cfs_texts as texts;

pub mod accuracy;
pub mod accuracy_plot;
pub mod builtin;
pub mod by_description;
mod cache;
pub mod clock;
pub mod coefficients;
pub mod compact;
pub mod comparison;
pub mod control;
pub mod data_form;
mod error;
pub mod example;
pub mod facade;
pub mod facing;
pub mod fault;
pub mod files;
pub mod fingerprint;
pub mod goniophotometer;
pub mod health;
pub mod incidence;
pub mod incoming;
pub mod inputs;
pub mod intake;
pub mod leaving_out;
pub mod library;
pub mod luminaire_choice;
pub mod luminaire_file;
pub mod luminaire_series;
pub mod luminaire_set;
mod luminaire_tiles;
pub mod luminaires;
pub mod moment;
pub mod near_field;
mod optical_model;
pub mod outside;
mod part;
pub mod places;
pub mod plan;
pub mod product_control;
pub mod rank;
pub mod rank_keys;
mod recent;
pub mod scene;
pub mod scene_file;
pub mod scene_places;
pub mod scene_words;
mod scheme_words;
mod self_contained;
pub mod session;
pub mod sky;
pub mod skyline;
pub mod subject;
pub mod subscriptions;
pub mod sun_position;
pub mod system;
pub mod weather;
pub mod weather_keys;
pub mod year;
pub mod year_keys;

pub use cache::Store;
pub use coefficients::Coefficients;
pub use error::StudyError;
pub use library::Library;
pub use scene::Scene;
pub use scene_file::SceneFile;
pub use session::{LidResult, OutsideSeen, PatchLight, RoomResult, SensorResult, Session, SurfaceLight};
pub use system::{System, SystemLibrary};

use crate::formats::encoding::decode;
use std::path::Path;

/// Reads a scene file. Errors name the file.
pub fn read_scene_file(path: &Path) -> Result<SceneFile, StudyError> {
    let error = |message: String| StudyError::File { path: path.to_owned(), message };
    let bytes = files::read(path)?;
    let text = decode(&bytes).map_err(|e| error(e.to_string()))?;
    SceneFile::parse(&text).map_err(|e| error(e.to_string()))
}

/// Reads and resolves a scene file. Errors name the file.
pub fn load_scene(path: &Path, library: &dyn SystemLibrary) -> Result<Scene, StudyError> {
    let file = read_scene_file(path)?;
    let base = files::folder(path);
    Scene::resolve(&file, base, library).map_err(|e| match e {
        StudyError::File { .. } | StudyError::Cancelled(_) => e,
        other => StudyError::File { path: path.to_owned(), message: other.to_string() },
    })
}
