//! From a scene to its results.
pub mod scene_file;
