//! Which file takes names from which, and the circles among them.
//!
//! An arrow leads to the file that defines a name: re-exports (`pub use`) are followed and are no arrows themselves, nor
//! are `mod` declarations. What only tests use is left out. Methods and names made by macros are not seen.

use crate::scan::{UsedPath, module_paths, reexports, tests_blanked};
use std::collections::{BTreeMap, BTreeSet};

/// Files under `src` with the files that they take names from, and the line of the first.
pub type Arrows = BTreeMap<String, BTreeMap<String, usize>>;

/// Words of the module that a file is: `compute/room/mod.rs` → compute, room. The crate of a layer counts as a module.
fn module_of(file: &str) -> Vec<String> {
    let stem = file.trim_end_matches(".rs").trim_end_matches("/mod").trim_end_matches("/lib");
    if stem == "lib" { vec![] } else { stem.split('/').map(str::to_owned).collect() }
}

/// All modules, by their words.
struct House<'a> {
    files: BTreeMap<Vec<String>, &'a str>,
    /// Names that a module hands on, with the full path that they stand for.
    handed: BTreeMap<Vec<String>, Vec<(String, Vec<String>)>>,
}

impl House<'_> {
    /// The full path of one as written in a module; `None` for other crates' and for the prelude's.
    fn absolute(&self, module: &[String], words: &[String]) -> Option<Vec<String>> {
        let mut base = module.to_vec();
        let mut rest = words;
        match rest.first()?.as_str() {
            "crate" => {
                rest = &rest[1..];
                base.truncate(1);
                let is_crate = self.files.get(&base[..]).is_some_and(|file| file.ends_with("/lib.rs"));
                // Another layer, by the name that it has in all crates.
                let own = [&base[..], rest.get(..1).unwrap_or_default()].concat();
                let is_layer = rest.first().is_some_and(|name| self.files.contains_key(std::slice::from_ref(name)));
                if !is_crate || is_layer && !self.files.contains_key(&own) {
                    base.clear();
                }
            }
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|word| word == "super") {
                    base.pop()?;
                    rest = &rest[1..];
                }
            }
            layer if layer.starts_with("cfs_") => {
                base = vec![layer["cfs_".len()..].to_owned()];
                rest = &rest[1..];
            }
            child => {
                let path = [module, &[child.to_owned()]].concat();
                self.files.contains_key(&path).then_some(())?;
            }
        }
        Some([&base, rest].concat())
    }

    /// The file that defines what a full path names.
    fn defining(&self, path: &[String], depth: usize) -> Option<&str> {
        let length = (1..=path.len()).rev().find(|&length| self.files.contains_key(&path[..length]))?;
        let (module, rest) = path.split_at(length);
        if let (Some(name), Some(handed), true) = (rest.first(), self.handed.get(module), depth < 8)
            && let Some((_, target)) = handed.iter().find(|(own, _)| own == name)
        {
            return self.defining(&[target, &rest[1..]].concat(), depth + 1);
        }
        self.files.get(module).copied()
    }
}

/// The arrows between the files of a tree, given by paths under `src` with their texts.
pub fn arrows(sources: &[(String, String)]) -> Arrows {
    let texts: Vec<(&str, String)> = sources
        .iter()
        .filter(|(file, _)| !file.ends_with("/tests.rs") && file != "main.rs")
        .map(|(file, text)| (file.as_str(), tests_blanked(text)))
        .collect();
    let files = texts.iter().map(|(file, _)| (module_of(file), *file)).collect();
    let mut house = House { files, handed: BTreeMap::new() };
    for (file, text) in &texts {
        let module = module_of(file);
        let handed: Vec<_> = reexports(text)
            .into_iter()
            .filter_map(|(name, words)| Some((name, house.absolute(&module, &words)?)))
            .collect();
        house.handed.insert(module, handed);
    }
    let mut found = Arrows::new();
    for (file, text) in &texts {
        let module = module_of(file);
        let to = found.entry((*file).to_owned()).or_default();
        for UsedPath { line, words } in module_paths(text) {
            let target = house.absolute(&module, &words).and_then(|path| house.defining(&path, 0));
            if let Some(target) = target.filter(|target| target != file) {
                to.entry(target.to_owned()).or_insert(line);
            }
        }
    }
    found
}

/// Rooms of the window that are below its features (`paint`), or that compose and draw them.
const COMPOSED: [&str; 7] = ["apply", "desktop", "frame", "outcomes", "paint", "panels", "window"];

/// The same between rooms: the first `depth` words of their paths. The features of the window are one room: they name
/// each other's data, as the state does that they share. [`COMPOSED`] names the others.
pub fn between_rooms(arrows: &Arrows, depth: usize) -> Arrows {
    let room = |file: &str| {
        let words = module_of(file);
        let is_feature = words[0] == "app" && words.get(1).is_none_or(|word| !COMPOSED.contains(&word.as_str()));
        words.into_iter().take(if is_feature { 1 } else { depth }).collect::<Vec<_>>().join("/")
    };
    let mut rooms = Arrows::new();
    for (from, targets) in arrows {
        for (to, line) in targets {
            let (from, to) = (room(from), room(to));
            if from != to {
                rooms.entry(from).or_default().entry(to).or_insert(*line);
            }
        }
    }
    rooms
}

/// Files that take names from each other in a circle: each set once.
pub fn circles(arrows: &Arrows) -> Vec<Vec<String>> {
    let reach = |start: &String| {
        let (mut seen, mut next) = (BTreeSet::new(), vec![start]);
        while let Some(file) = next.pop() {
            for to in arrows.get(file).into_iter().flat_map(BTreeMap::keys) {
                if seen.insert(to) {
                    next.push(to);
                }
            }
        }
        seen
    };
    let reached: BTreeMap<&String, BTreeSet<&String>> = arrows.keys().map(|file| (file, reach(file))).collect();
    let mut sets = BTreeSet::new();
    for (file, to) in &reached {
        let together: Vec<String> = to
            .iter()
            .filter(|other| reached.get(*other).is_some_and(|back| back.contains(file)))
            .map(|s| (*s).clone())
            .collect();
        if together.len() > 1 {
            sets.insert(together);
        }
    }
    sets.into_iter().collect()
}
