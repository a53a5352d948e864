//! From a scene to its results.
pub mod luminaire_file;
pub mod scene_file;
pub mod sky;
pub mod sun_position;
