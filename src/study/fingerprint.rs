//! Hashes of the input of results: equal hashes mean equal results, independent of file locations and computers.

use super::error::StudyError;
use super::goniophotometer::{Described, LayerLibrary};
use super::inputs::inputs_of;
use super::scene_file::{SceneFile, SystemKeys};
use crate::catalogue::Product;
use crate::formats::system_toml::is_system_file;
use std::path::Path;

/// Number of the definitions by which results are computed. It is increased whenever the same input gives other
/// numbers, so that no run continues with values stored by an earlier build.
const DEFINITIONS: &str = "6";

/// Returns the hash of several parts in their order. Half of the hash's digits are enough to distinguish millions of
/// inputs.
pub fn digest(parts: &[&[u8]]) -> String {
    let mut hash = blake3::Hasher::new();
    for part in parts {
        hash.update(&(part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hash.finalize().to_hex()[..16].to_owned()
}

/// Returns the input of a scene's results as parts for hashing: version and definitions of the program, keys of the
/// scene, and contents of the files that it names. `base`: folder of the scene.
pub fn of_scene(scene: &SceneFile, base: &Path) -> Vec<Vec<u8>> {
    // A scene that cannot be written is represented by its debug form.
    let text = toml::to_string(scene).unwrap_or_else(|_| format!("{scene:?}"));
    let mut parts = vec![env!("CARGO_PKG_VERSION").into(), DEFINITIONS.into(), text.into_bytes()];
    // The location of a file does not matter, only its content. A file that cannot be read is reported when it is
    // needed.
    let files = inputs_of(scene, base);
    parts.extend(files.iter().map(|path| std::fs::read(path).unwrap_or_default()));
    parts
}

/// Returns the hash of a product's data; if they are computed from a description, that of the description, because the
/// data may not exist yet.
pub fn of_product(product: &Product) -> String {
    let mut text = product.system.clone();
    for state in &product.states {
        let data = if product.system.is_empty() { state.dataset.as_deref().unwrap_or_default() } else { "" };
        text.push_str(&format!("\n{}\t{:?}\t{data}", state.key, state.value));
    }
    for point in &product.control_curve {
        text.push_str(&format!("\n{} {}", point.profile_angle, point.value));
    }
    text
}

/// Returns the hash of all input of a scene's results, including products of the catalogue and layers of descriptions.
/// `base`: folder of the scene.
///
/// # Errors
/// Returns an error if a product or a description does not exist.
pub fn of_results(scene: &SceneFile, base: &Path, library: &dyn LayerLibrary) -> Result<String, StudyError> {
    let mut parts = of_scene(scene, base);
    for aperture in &scene.aperture {
        match &aperture.system {
            SystemKeys::Catalogue { key, .. } => parts.push(of_product(&library.product(key)?).into_bytes()),
            SystemKeys::File { path, .. } if is_system_file(&path.to_string_lossy()) => {
                parts.push(Described::read(&base.join(path))?.fingerprint(library)?.into_bytes());
            }
            _ => {}
        }
    }
    Ok(digest(&parts.iter().map(Vec::as_slice).collect::<Vec<_>>()))
}
