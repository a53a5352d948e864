//! What results are made of, as hashes: equal ones mean equal results, wherever files lie and whoever computes.

use super::error::StudyError;
use super::goniophotometer::{Described, LayerLibrary};
use super::inputs::inputs_of;
use super::scene_file::{SceneFile, SystemKeys};
use crate::catalogue::Product;
use crate::formats::system_toml::is_system_file;
use std::path::Path;

/// Number of the definitions that results follow. Raised whenever the same inputs come to give other numbers, so that nothing
/// that an earlier build has kept is continued.
const DEFINITIONS: &str = "5";

/// Of parts in their order. Half a hash is enough to tell millions apart.
pub fn digest(parts: &[&[u8]]) -> String {
    let mut hash = blake3::Hasher::new();
    for part in parts {
        hash.update(&(part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hash.finalize().to_hex()[..16].to_owned()
}

/// A scene as parts: the program's version and definitions, its keys, and what stands in the files that it names.
pub fn of_scene(scene: &SceneFile, base: &Path) -> Vec<Vec<u8>> {
    // What cannot be written is told apart by its debug form.
    let text = toml::to_string(scene).unwrap_or_else(|_| format!("{scene:?}"));
    let mut parts = vec![env!("CARGO_PKG_VERSION").into(), DEFINITIONS.into(), text.into_bytes()];
    // Where a file lies does not matter: what is in it does. One that cannot be read is told when it is needed.
    let files = inputs_of(scene, base);
    parts.extend(files.iter().map(|path| std::fs::read(path).unwrap_or_default()));
    parts
}

/// Of a product's data: its description where it is computed from one, since the data may still be waiting to be computed.
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

/// Of all that the results of a scene are made of, products of the catalogue and layers of descriptions included.
///
/// # Errors
/// A product or a description that is not there.
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
