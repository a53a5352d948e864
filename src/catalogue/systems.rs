//! System descriptions that come with the program: files under `assets/systems`.

use crate::compute::system::slats::Venetian;
use crate::compute::system::stack::LayerSource;
use crate::compute::system::{SystemDescription, SystemKind};
use crate::formats::system_toml::{self, EACH_STATE, SystemFile, is_system_file};
use include_dir::{Dir, File, include_dir};
use std::sync::LazyLock;

/// Content of the folder of descriptions; a new file is included when this source file is compiled again.
static FOLDER: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/systems");
/// Kinds of product in the order of the catalogue; other kinds follow, stacks come last.
const ORDER: [&str; 7] = ["pane", "diffuser", "woven", "laser-cut-panel", "venetian", "prismatic", "perforated"];
/// Description file of the product that a new window shows; it precedes all others.
const FIRST: &str = "venetian-80-72.system.toml";

/// File name and text of every built-in description, in the order of the catalogue.
///
/// # Panics
/// Never: the tests read every built-in description.
pub static SYSTEMS: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| {
    let text = |file: &'static File<'_>| Some((file.path().to_str()?, file.contents_utf8()?));
    let mut list: Vec<(&str, &str)> =
        FOLDER.files().filter_map(text).filter(|(name, _)| is_system_file(name)).collect();
    list.sort_by_cached_key(|(name, text)| {
        let read = system_toml::read(text.as_bytes()).expect("built-in descriptions are read by the tests");
        let word = read.system.family().word();
        let place = ORDER.iter().position(|kind| *kind == word).unwrap_or(ORDER.len() + usize::from(word == "stack"));
        (*name != FIRST, place, *name)
    });
    list
});

/// Returns the built-in description in the file with this name, parsed and as text; `None` if there is no such file.
///
/// # Panics
/// Never: the tests read every built-in description.
pub fn builtin_system(name: &str) -> Option<(SystemFile, &'static str)> {
    let (_, text) = SYSTEMS.iter().find(|(file, _)| *file == name)?;
    Some((system_toml::read(text.as_bytes()).expect("built-in descriptions are read by the tests"), text))
}

/// Returns the horizontal slats of a system description, also of the moving layer of a stack. `None` for vertical
/// slats, whose shadows do not depend on the profile angle that control curves use, and for systems without slats.
/// `system`: text of the description.
pub fn blind_of(system: &str) -> Option<Venetian> {
    slats_of(system).filter(|(_, upright)| !upright).map(|(blind, _)| blind)
}

/// Returns the slats of a system description, and whether they are vertical; `None` for systems without slats.
/// `system`: text of the description.
pub fn slats_of(system: &str) -> Option<(Venetian, bool)> {
    let moving = moving_part(system)?;
    match moving.kind {
        SystemKind::Venetian(blind) => Some((blind, moving.upright)),
        _ => None,
    }
}

/// Returns the system to which the states of a description belong: of a stack its moving layer, rotated like the stack;
/// of anything else the system itself. `None` for a stack without a moving layer or whose moving layer is not
/// available, and for a text that cannot be read. `system`: text of the description.
pub fn moving_part(system: &str) -> Option<SystemDescription> {
    let system = system_toml::read(system.as_bytes()).ok()?.system;
    let SystemKind::Stack(layers) = system.kind else { return Some(system) };
    let moving = match layers.into_iter().find(|layer| layer.state == EACH_STATE)?.source {
        LayerSource::File(name) => moving_part(builtin_system(&name)?.1),
        LayerSource::Text(text) => moving_part(&text),
        LayerSource::Catalogue(_) => None,
    }?;
    Some(SystemDescription { upright: moving.upright != system.upright, ..moving })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_files_of_the_folder_are_known_and_in_order() {
        let folder = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/systems")).unwrap();
        let mut there: Vec<String> = folder.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        there.retain(|name| is_system_file(name));
        there.sort();
        let mut known: Vec<&str> = SYSTEMS.iter().map(|(name, _)| *name).collect();
        assert_eq!((known[0], known.last().copied()), (FIRST, Some("solar-control-double.system.toml")));
        known.sort_unstable();
        assert_eq!(known, there, "a file came or went since src/catalogue/systems.rs was compiled: touch it");
    }
}
