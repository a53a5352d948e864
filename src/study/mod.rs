//! From a scene to its results: what the window, the command line and other programs call.
//!
//! [`scene_file`] is the text as typed, [`scene`] what it means, [`plan`] what it needs, [`session`] the answers.

pub mod accuracy;
pub mod accuracy_plot;
pub mod builtin;
pub mod by_description;
mod cache;
pub mod coefficients;
pub mod compact;
pub mod control;
mod error;
pub mod files;
pub mod goniophotometer;
pub mod leaving_out;
pub mod library;
pub mod luminaire_file;
pub mod near_field;
pub mod places;
pub mod plan;
pub mod scene;
pub mod scene_file;
mod scheme_words;
mod self_contained;
pub mod session;
pub mod sky;
pub mod sun_position;
pub mod system;
pub mod weather;
pub mod weather_keys;

pub use coefficients::Coefficients;
pub use error::StudyError;
pub use library::Library;
pub use scene::Scene;
pub use scene_file::SceneFile;
pub use session::{LidResult, RoomResult, SensorResult, Session};
pub use system::{System, SystemLibrary};

use std::path::Path;

/// Reads a scene file. The error names the file.
pub fn read_scene_file(path: &Path) -> Result<SceneFile, StudyError> {
    let error = |message: String| StudyError::File { path: path.to_owned(), message };
    let text = std::fs::read_to_string(path).map_err(|e| error(format!("cannot be read: {e}")))?;
    SceneFile::parse(&text).map_err(|e| error(e.to_string()))
}

/// Reads and resolves a scene file. The error names the file.
pub fn load_scene(path: &Path, library: &dyn SystemLibrary) -> Result<Scene, StudyError> {
    let file = read_scene_file(path)?;
    let base = path.parent().unwrap_or(Path::new("."));
    Scene::resolve(&file, base, library).map_err(|e| match e {
        StudyError::File { .. } | StudyError::Cancelled(_) => e,
        other => StudyError::File { path: path.to_owned(), message: other.to_string() },
    })
}
