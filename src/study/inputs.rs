//! Files that a scene names, and those named in these: input of the scene's results.

use super::files;
use super::luminaires::{self, INDEX};
use super::scene_file::SceneFile;
use super::weather::BUILTIN;
use crate::formats::encoding::decode;
use crate::formats::system_toml::{MOST_NESTED, is_system_file};
use std::path::{Path, PathBuf};

/// Returns the existing files that a scene names, by any key. `base`: folder from which relative paths start.
pub fn inputs_of(scene: &SceneFile, base: &Path) -> Vec<PathBuf> {
    let mut list = Vec::new();
    // A scene that cannot be written as TOML did not come from a file.
    if let Ok(value) = toml::Value::try_from(scene) {
        named_in(&value, base, 0, &mut list);
    }
    list
}

/// Returns the scene with absolute paths of the files that it names, so that it can be used in another folder. `base`:
/// folder from which relative paths start.
pub fn with_absolute_names(scene: &SceneFile, base: &Path) -> SceneFile {
    fn absolute(value: &mut toml::Value, base: &Path) {
        match value {
            toml::Value::String(word) if !word.is_empty() => {
                let path = base.join(&*word);
                if path.is_file() {
                    *word = files::absolute(&path).to_string_lossy().into_owned();
                }
            }
            toml::Value::Array(values) => values.iter_mut().for_each(|value| absolute(value, base)),
            toml::Value::Table(table) => table.iter_mut().for_each(|(_, value)| absolute(value, base)),
            _ => {}
        }
    }
    // A scene that cannot be written as TOML did not come from a file.
    let Ok(mut value) = toml::Value::try_from(scene) else { return scene.clone() };
    absolute(&mut value, base);
    value.try_into().unwrap_or_else(|_| scene.clone())
}

/// Whether a scene may name files by relative paths. It is decided by the texts of the scene alone; no file is looked
/// for.
pub fn names_files(scene: &SceneFile) -> bool {
    fn within(value: &toml::Value) -> bool {
        match value {
            toml::Value::String(word) => word.contains('.') && !word.starts_with(BUILTIN),
            toml::Value::Array(values) => values.iter().any(within),
            toml::Value::Table(table) => table.values().any(within),
            _ => false,
        }
    }
    toml::Value::try_from(scene).is_ok_and(|value| within(&value))
}

/// Adds the existing files that are named in a value of a scene or description to `list`, and those named in
/// description files. `depth`: level of nesting so far.
fn named_in(value: &toml::Value, base: &Path, depth: usize, list: &mut Vec<PathBuf>) {
    match value {
        toml::Value::String(word) if !word.is_empty() => {
            let path = base.join(word);
            if !path.is_file() || list.contains(&path) {
                return;
            }
            list.push(path.clone());
            if word.to_lowercase().ends_with(INDEX) {
                let files = luminaires::read_rows(&path).unwrap_or_default();
                list.extend(files.iter().map(|row| path.with_file_name(&row.file)));
            }
            // Layers of a stack are files beside it.
            if is_system_file(word)
                && depth < MOST_NESTED
                && let Ok(bytes) = std::fs::read(&path)
                && let Ok(text) = decode(&bytes)
                && let Ok(table) = text.parse::<toml::Table>()
            {
                let folder = path.parent().unwrap_or(base).to_owned();
                named_in(&toml::Value::Table(table), &folder, depth + 1, list);
            }
        }
        toml::Value::Array(values) => values.iter().for_each(|value| named_in(value, base, depth, list)),
        toml::Value::Table(table) => table.values().for_each(|value| named_in(value, base, depth, list)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_files_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::create_dir(path("data")).unwrap();
        std::fs::write(path("data/a.system.toml"), "[[layer]]\nfile = \"pane.xml\"\n").unwrap();
        std::fs::write(path("data/pane.xml"), "<x/>").unwrap();
        std::fs::write(path("sky.csv"), "").unwrap();
        let mut scene = crate::study::example::scene_of("opal-light", None);
        scene.aperture[0].system =
            super::super::scene_file::SystemKeys::File { path: "data/a.system.toml".into(), state: None };
        let mut found = inputs_of(&scene, folder.path());
        found.sort();
        assert_eq!(found, [path("data/a.system.toml"), path("data/pane.xml")]);
    }
}
