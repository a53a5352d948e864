//! From a scene to its results.
pub mod scene_file;
pub mod sky;
pub mod sun_position;
