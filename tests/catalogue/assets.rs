//! The descriptions of the built-in catalogue: every one reads, tells what it is, and names what is there.

use crate::common::root;
use cfs::compute::system::SystemKind;
use cfs::compute::system::stack::LayerSource;
use cfs::formats::system_toml::{self, EACH_STATE, SystemFile};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// What products are in everyday words: the first tag of each.
const EVERYDAY: [&str; 31] = [
    "clear glazing",
    "tinted glass",
    "coated glazing",
    "electrochromic glazing",
    "diffusing glass",
    "opal sheet",
    "multiwall sheet",
    "translucent insulation",
    "membrane",
    "roller blind",
    "screen",
    "perforated metal",
    "expanded metal",
    "egg-crate grid",
    "exterior venetian blind",
    "interior venetian blind",
    "mirror venetian blind",
    "vertical blind",
    "louvres",
    "vertical louvres",
    "micro-louvre screen",
    "laser-cut panel",
    "prismatic panel",
    "prismatic film",
    "light-redirecting glass",
    "glazing with blind",
    "glazing with screen",
    "skylight",
    "shutter",
    "pleated blind",
    "curtain",
];

/// Rules that make control curves.
const CONTROLS: [&str; 4] = ["", "cut-off", "retro", "redirect"];

/// Names of makers and their products that must not slip in, in lower case.
const TRADEMARKS: [&str; 27] = [
    "warema",
    "hunter douglas",
    "luxaflex",
    "schüco",
    "schueco",
    "retrosolar",
    "retrolux",
    "köster",
    "okalux",
    "kapilux",
    "okasolar",
    "sageglass",
    "plexiglas",
    "perspex",
    "makrolon",
    "lumira",
    "nanogel",
    "kalwall",
    "teflon",
    "serraglaze",
    "lumitop",
    "inglas",
    "siteco",
    "3m ",
    "saint-gobain",
    "pilkington",
    "koolshade",
];

/// Built-in products that scenes may name.
const KEPT: [&str; 12] = [
    "clear-single",
    "clear-double",
    "clear-triple",
    "grey-single",
    "opal-light",
    "opal-dense",
    "acrylic-diffuser-clear",
    "acrylic-diffuser-haze",
    "satinated-glass",
    "laser-cut-panel",
    "venetian-80-72",
    "low-e-double",
];

fn folder() -> PathBuf {
    root().join("assets/systems")
}

/// All descriptions by the keys that their files' names give.
fn all() -> BTreeMap<String, SystemFile> {
    let mut list = BTreeMap::new();
    for entry in std::fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let Some(key) = name.strip_suffix(".system.toml") else {
            assert_eq!(name, "README.md", "neither a description nor the page that explains them");
            continue;
        };
        let file = system_toml::read(&std::fs::read(&path).unwrap()).unwrap_or_else(|e| panic!("{name}: {e}"));
        list.insert(key.to_owned(), file);
    }
    list
}

/// States of a description; those of the moving layer for a stack.
fn states(list: &BTreeMap<String, SystemFile>, key: &str) -> Vec<String> {
    let SystemKind::Stack(layers) = &list[key].system.kind else { return list[key].system.states() };
    match layers.iter().find(|layer| layer.state == EACH_STATE) {
        Some(layer) => states(list, &key_of(&layer.source)),
        None => vec![String::new()],
    }
}

/// Key of a layer; built-in stacks are made of files beside them.
fn key_of(source: &LayerSource) -> String {
    match source {
        LayerSource::File(name) => name.strip_suffix(".system.toml").expect("a system file").to_owned(),
        LayerSource::Catalogue(key) => {
            panic!("layer {key} by its key: the catalogue is not there yet when it is filled")
        }
        LayerSource::Text(text) => panic!("a layer of its own, which no product shows: {text}"),
    }
}

#[test]
fn keys_are_file_names_and_names_are_unique() {
    let list = all();
    let mut names = BTreeSet::new();
    for (key, file) in &list {
        assert_eq!(&file.key, key);
        assert!(names.insert(file.system.name.to_lowercase()), "{key}: the name {} is taken", file.system.name);
        assert!(CONTROLS.contains(&file.control.as_str()), "{key}: control {}", file.control);
        assert!(file.system.name.chars().count() <= 64, "{key}: a name too long for a list");
    }
    for key in KEPT {
        assert!(list.contains_key(key), "{key} is gone");
    }
}

#[test]
fn there_is_enough_to_browse() {
    let list = all();
    assert!(list.len() >= 44, "{} products", list.len());
    let mut kinds = BTreeSet::new();
    for (key, file) in &list {
        let kind = file.tags.first().unwrap_or_else(|| panic!("{key}: no tags"));
        assert!(EVERYDAY.contains(&kind.as_str()), "{key}: the first tag {kind} is no everyday kind");
        let unique: BTreeSet<_> = file.tags.iter().collect();
        assert_eq!(unique.len(), file.tags.len(), "{key}: a tag twice");
        kinds.insert(kind);
    }
    assert!(kinds.len() >= 12, "{kinds:?}");
}

#[test]
fn families_that_move_are_complete_and_tagged() {
    let list = all();
    let mut families = 0;
    for (key, file) in &list {
        let states = states(&list, key);
        let moving = states.len() > 1;
        assert_eq!(moving, file.tags.iter().any(|tag| tag == "moving"), "{key}: {} states", states.len());
        assert!(file.control.is_empty() || moving, "{key}: a control without states");
        if !moving {
            continue;
        }
        families += 1;
        let angles: Vec<f64> = states.iter().map(|state| state.parse().unwrap()).collect();
        let step = angles[1] - angles[0];
        assert!((1.0..=15.0).contains(&step), "{key}: steps of {step}°");
        assert!(angles.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 1e-9), "{key}: uneven steps");
        let range = angles[angles.len() - 1] - angles[0];
        assert!(range >= 75.0, "{key}: turns by {range}° only");
        if (range - 100.0).abs() < 1e-9 {
            assert_eq!(states.len(), 21, "{key}: 100° in steps of 5°");
        }
        if !file.system.upright {
            assert!(!file.control.is_empty(), "{key}: horizontal slats without a control");
        }
    }
    assert!(families >= 8, "{families} families");
}

#[test]
fn layers_are_there_with_their_states() {
    let list = all();
    for (key, file) in &list {
        let SystemKind::Stack(layers) = &file.system.kind else { continue };
        assert!(layers.len() > 1, "{key}: a stack of one layer");
        for layer in layers {
            let of = key_of(&layer.source);
            assert!(list.contains_key(&of), "{key}: no layer {of}");
            let has = states(&list, &of);
            assert!(
                layer.state == EACH_STATE || has.contains(&layer.state),
                "{key}: {of} has no state {}",
                layer.state
            );
        }
    }
}

#[test]
fn descriptions_tell_something_and_name_no_maker() {
    for (key, file) in all() {
        let text = &file.system.description;
        let length = text.chars().count();
        assert!((80..=700).contains(&length), "{key}: a description of {length} characters");
        assert!(text.ends_with('.') && !text.contains("  ") && !text.contains('\n'), "{key}: {text:?}");
        assert!(text.matches(". ").count() >= 1, "{key}: a single sentence");
        let all = format!("{} {text} {}", file.system.name, file.tags.join(" ")).to_lowercase();
        for mark in TRADEMARKS {
            assert!(!all.contains(mark), "{key}: {mark}");
        }
    }
}
