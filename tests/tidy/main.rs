//! The shape of the source: layers, heads, sizes, leftovers, dependencies. The rules themselves are tested on small
//! bad examples further down.

mod arrows;
mod findings;
mod glossary;
mod layers;
mod licences;
mod scan;
mod scripts;
mod stages;
mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Files past this size have a second idea in them.
const MOST_LINES: usize = 500;

/// Files that may be longer, with the reason.
const LONGER: [(&str, &str); 1] = [("tests/window/views.rs", "one check a picture; each stands alone")];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Files under the given folders of the package, as (path with slashes, path), sorted.
fn files(folders: &[&str]) -> Vec<(String, PathBuf)> {
    fn walk(folder: &Path, list: &mut Vec<PathBuf>) {
        let Ok(entries) = std::fs::read_dir(folder) else { return };
        for entry in entries.flatten() {
            let path = entry.path();
            if path.is_dir() { walk(&path, list) } else { list.push(path) }
        }
    }
    let mut list = vec![];
    for folder in folders {
        walk(&root().join(folder), &mut list);
    }
    list.sort();
    let name = |path: &Path| path.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/");
    list.into_iter().map(|path| (name(&path), path)).collect()
}

/// Rust files with their text.
fn sources(folders: &[&str]) -> Vec<(String, String)> {
    let rust = files(folders).into_iter().filter(|(name, _)| name.ends_with(".rs"));
    let list: Vec<(String, String)> = rust.map(|(name, path)| (name, std::fs::read_to_string(path).unwrap())).collect();
    assert!(list.len() > 5, "no sources found in {folders:?}");
    list
}

fn none(wrong: &[String]) {
    assert!(wrong.is_empty(), "\n{}\n", wrong.join("\n"));
}

#[test]
fn imports_go_one_way() {
    let wrong: Vec<String> = sources(&["src"])
        .iter()
        .flat_map(|(name, text)| layers::violations(name.trim_start_matches("src/"), text))
        .collect();
    none(&wrong);
}

/// Files under `src` by their paths there, with their texts.
fn tree() -> Vec<(String, String)> {
    sources(&["src"]).into_iter().map(|(name, text)| (name.trim_start_matches("src/").to_owned(), text)).collect()
}

/// The rooms of `compute` in the order that its head gives: foundations first.
fn rooms(head: &str) -> Vec<&str> {
    let list = head.lines().filter_map(|line| line.strip_prefix("//! - `")?.split_once("`:"));
    list.map(|(name, _)| name).collect()
}

/// Arrows between rooms of `compute` that lead to a room that is not before the first one's own.
fn upward(arrows: &arrows::Arrows, order: &[&str]) -> Vec<String> {
    let place = |room: &str| order.iter().position(|name| room.strip_prefix("compute/") == Some(name));
    let mut wrong = vec![];
    for (from, targets) in arrows::between_rooms(arrows, 2) {
        for (to, line) in
            targets.into_iter().filter(|(to, _)| from.starts_with("compute/") && to.starts_with("compute/"))
        {
            match (place(&from), place(&to)) {
                (Some(own), Some(other)) if other < own => {}
                (Some(_), Some(_)) => wrong.push(format!("src/{from} must not use src/{to} (line {line} of a file)")),
                _ => wrong.push(format!("{from} or {to} is not in the list of src/compute/lib.rs")),
            }
        }
    }
    wrong
}

#[test]
fn rooms_of_compute_use_only_those_before_them() {
    let tree = tree();
    let (_, head) = tree.iter().find(|(file, _)| file == "compute/lib.rs").unwrap();
    let order = rooms(head);
    assert!(order.len() > 10, "{order:?}");
    none(&upward(&arrows::arrows(&tree), &order));
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    let arrows = arrows::arrows(&tree());
    assert!(arrows.values().map(std::collections::BTreeMap::len).sum::<usize>() > 500, "arrows are seen");
    let told = |circle: Vec<String>| format!("a circle: {}", circle.join(", "));
    let mut wrong: Vec<String> = arrows::circles(&arrows).into_iter().map(told).collect();
    wrong.extend(arrows::circles(&arrows::between_rooms(&arrows, 2)).into_iter().map(told));
    none(&wrong);
}

#[test]
fn modules_open_with_what_they_are_for() {
    let headless = |text: &str| !text.starts_with("//! ");
    assert!(headless("use std::fmt;\n//! too late"));
    let wrong: Vec<String> = sources(&["src", "tests", "examples", "benches"])
        .into_iter()
        .filter(|(_, text)| headless(text))
        .map(|(name, _)| format!("{name}: does not open with `//! `"))
        .collect();
    none(&wrong);
}

#[test]
fn files_hold_one_idea() {
    let mut wrong = vec![];
    for (name, text) in sources(&["src", "tests", "examples", "benches"]) {
        let lines = text.lines().count();
        let excused = LONGER.iter().any(|(longer, _)| *longer == name);
        if lines > MOST_LINES && !excused {
            wrong.push(format!("{name}: {lines} lines, more than {MOST_LINES}: which half has its own name?"));
        }
    }
    none(&wrong);
}

/// Leftovers of unfinished work in one file.
fn leftovers(name: &str, text: &str) -> Vec<String> {
    let macros = scan::macros(text).into_iter().filter(|(_, m)| matches!(m.as_str(), "todo" | "unimplemented" | "dbg"));
    let ignored = scan::attributes(text).into_iter().filter(|(_, attribute)| attribute == "ignore");
    let mut wrong: Vec<String> = macros.chain(ignored).map(|(line, word)| format!("{name}:{line}: {word}")).collect();
    for (line, text) in text.lines().enumerate() {
        if text.trim_start().starts_with("//") && text.contains("```ignore") {
            wrong.push(format!("{name}:{}: an example that is not compiled", line + 1));
        }
    }
    wrong
}

#[test]
fn nothing_is_left_unfinished_or_ignored() {
    let wrong: Vec<String> = sources(&["src", "tests", "examples", "benches"])
        .iter()
        .flat_map(|(name, text)| leftovers(name, text))
        .collect();
    none(&wrong);
}

/// What is written past the one place that keeps inputs, or said past the one that keeps terminals: calls with the files
/// that may make them.
const ONE_PLACE: [(&str, &[&str]); 5] = [
    ("fs::write(", &[]),
    ("File::create(", &[]),
    ("fs::rename(", &["study/part.rs", "app/session/autosave.rs"]),
    ("println!(", &[]),
    ("eprint!(", &[]),
];

/// Such calls of one file, outside of its tests.
fn past_the_one_place(name: &str, text: &str) -> Vec<String> {
    let own = text.split("#[cfg(test)]").next().unwrap_or(text);
    let lines = own.lines().enumerate().filter(|(_, line)| !line.trim_start().starts_with("//"));
    let found = |line: &str| {
        ONE_PLACE.iter().find(|(call, files)| line.contains(call) && !files.contains(&name)).map(|(call, _)| *call)
    };
    lines.filter_map(|(at, line)| Some(format!("src/{name}:{}: {}", at + 1, found(line)?))).collect()
}

#[test]
fn files_are_written_and_messages_said_in_one_place() {
    assert_eq!(past_the_one_place("cli/a.rs", "std::fs::write(path, b)?;\neprintln!(\"x\");\n// fs::write(").len(), 2);
    assert_eq!(past_the_one_place("study/part.rs", "fs::rename(a, b)\n#[cfg(test)]\nfs::write(a, b)").len(), 0);
    none(&tree().iter().flat_map(|(name, text)| past_the_one_place(name, text)).collect::<Vec<_>>());
}

/// Paths that exist on somebody's machine only.
fn machine_path(text: &str) -> Option<&'static str> {
    // Split, or this file would name them.
    const FOLDERS: [(&str, &str); 4] = [("/ho", "me/"), ("/ro", "ot/"), ("/Us", "ers/"), ("/wo", "rk/")];
    FOLDERS.iter().find(|(a, b)| text.contains(&format!("{a}{b}"))).map(|(a, _)| *a)
}

#[test]
fn no_file_names_a_machine() {
    let mut all = files(&["src", "tests", "examples", "benches", "migrations", ".ci", "assets"]);
    for name in ["README.md", "CHANGELOG.md", "Cargo.toml", "deny.toml", "clippy.toml"] {
        all.push((name.to_owned(), root().join(name)));
    }
    let wrong: Vec<String> = all
        .iter()
        .filter_map(|(name, path)| {
            // Fonts and pictures are no text.
            let text = String::from_utf8(std::fs::read(path).unwrap()).ok()?;
            machine_path(&text).map(|found| format!("{name}: a path on somebody's machine, {found}…"))
        })
        .collect();
    none(&wrong);
}

/// Manifests of all packages by their folders, the root's first.
fn packages() -> Vec<(String, toml::Table)> {
    let below = files(&["src", "tests"]).into_iter();
    let below = below.filter_map(|(name, _)| Some(name.strip_suffix("/Cargo.toml")?.to_owned()));
    let read = |folder: &str| std::fs::read_to_string(root().join(folder).join("Cargo.toml")).unwrap();
    std::iter::once(".".to_owned())
        .chain(below)
        .map(|folder| (folder.clone(), read(&folder).parse().unwrap()))
        .collect()
}

#[test]
fn every_package_is_built_tested_and_linted_unasked() {
    let packages = packages();
    let folders: BTreeSet<&str> = packages.iter().map(|(folder, _)| folder.as_str()).collect();
    assert!(folders.len() > 7, "{folders:?}");
    for list in ["members", "default-members"] {
        let named = packages[0].1["workspace"][list].as_array().unwrap().iter().map(|one| one.as_str().unwrap());
        assert_eq!(named.collect::<BTreeSet<_>>(), folders, "{list} of Cargo.toml");
    }
    let lints = "#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]";
    for (folder, manifest) in &packages {
        assert_eq!(manifest["lints"]["workspace"].as_bool(), Some(true), "lints of {folder}/Cargo.toml");
        let Some(library) = manifest.get("lib") else { continue };
        let text = std::fs::read_to_string(root().join(folder).join(library["path"].as_str().unwrap())).unwrap();
        assert!(text.contains(lints), "the library of {folder} lacks `{lints}`");
    }
}

#[test]
fn packages_depend_on_those_below() {
    let wrong = |manifest: &str| layers::wrong_dependencies("src/compute", &manifest.parse().unwrap()).len();
    assert_eq!(wrong("[dependencies]\ncfs-study = {}\nserde = \"1\"\nglam = \"0\"\nrfd = { optional = true }"), 2);
    none(&packages().iter().flat_map(|(folder, one)| layers::wrong_dependencies(folder, one)).collect::<Vec<_>>());
}

/// Names in a lock file with the number of versions of each.
fn versions(lock: &str) -> BTreeMap<String, usize> {
    let lock: toml::Table = lock.parse().unwrap();
    let mut count = BTreeMap::new();
    for package in lock["package"].as_array().unwrap() {
        *count.entry(package["name"].as_str().unwrap().to_owned()).or_default() += 1;
    }
    count
}

#[test]
fn what_must_be_one_is_one() {
    let count = versions(&std::fs::read_to_string(root().join("Cargo.lock")).unwrap());
    for name in ["libsqlite3-sys", "rusqlite", "egui", "glam"] {
        assert_eq!(count.get(name), Some(&1), "versions of {name}");
    }
}

#[test]
fn dependencies_have_accepted_licences() {
    let cargo = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO")).args(arguments).current_dir(root()).output().unwrap();
        assert!(output.status.success(), "cargo {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    // Only what this platform builds is sure to be on this machine.
    let version = cargo(&["-vV"]);
    let host = version.lines().find_map(|line| line.strip_prefix("host: ")).unwrap();
    let text = cargo(&["metadata", "--format-version", "1", "--locked", "--offline", "--filter-platform", host]);
    let metadata: serde_json::Value = serde_json::from_str(&text).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    assert!(packages.len() > 100, "{} packages only", packages.len());

    let mut wrong = vec![];
    for package in packages {
        let (name, version) = (package["name"].as_str().unwrap(), package["version"].as_str().unwrap());
        match package["license"].as_str().map(|expression| (expression, licences::accepted(name, expression))) {
            Some((_, Ok(true))) => {}
            Some((expression, Ok(false))) => wrong.push(format!("{name} {version}: {expression}")),
            Some((_, Err(error))) => wrong.push(format!("{name} {version}: {error}")),
            None => wrong.push(format!("{name} {version}: names no licence")),
        }
    }
    none(&wrong);

    for (name, _) in licences::EXCEPTIONS {
        assert!(packages.iter().any(|package| package["name"] == name), "the exception for {name} is not needed");
        let deny = std::fs::read_to_string(root().join("deny.toml")).unwrap();
        assert!(deny.contains(&format!("\"{name}\"")), "deny.toml lacks the exception for {name}");
    }
}

#[test]
fn the_build_machine_runs_what_the_readme_says() {
    let read = |name: &str| std::fs::read_to_string(root().join(name)).unwrap();
    let command = ".ci/setup tests && .ci/check";
    assert!(read("README.md").contains(command), "README.md lacks `{command}`");
    assert!(read(".ci/run").lines().any(|line| line == command), ".ci/run lacks `{command}`");
}

#[test]
fn wrong_arrows_are_seen() {
    let wrong = |file: &str, source: &str| layers::violations(file, source).len();
    assert_eq!(wrong("compute/a.rs", "use crate::formats::Format;"), 1);
    assert_eq!(wrong("compute/a.rs", "use crate::{compute::b, study::{scene, plan}};"), 2);
    assert_eq!(wrong("compute/a.rs", "use cfs_formats::Format;"), 1);
    assert_eq!(wrong("compute/lib.rs", "use cfs_study as study;"), 1);
    assert_eq!(wrong("compute/a/b.rs", "fn f() { let x = super::super::app::run(); }"), 1);
    assert_eq!(wrong("compute/a.rs", "use super::app;"), 1);
    assert_eq!(wrong("cli/a/b.rs", "fn f() { let x = super::super::super::app::run(); }"), 1);
    assert_eq!(wrong("compute/a.rs", "use std::{fmt, fs};"), 1);
    assert_eq!(wrong("compute/a.rs", "fn f() { ::std::fs::read(\"x\"); println!(\"y\") }"), 2);
    assert_eq!(wrong("compute/a.rs", "use serde::Serialize;"), 1);
    assert_eq!(wrong("formats/a.rs", "#[derive(serde::Serialize)] struct A; use rusqlite::Connection;"), 1);
    assert_eq!(wrong("formats/a.rs", "use cfs::catalogue::Catalogue;"), 1);
    assert_eq!(wrong("catalogue/a.rs", "use crate::study::Scene;"), 1);
    assert_eq!(wrong("study/lib.rs", "use crate::cli;"), 1);
    assert_eq!(wrong("texts/a.rs", "use super::Text; impl From<Text> for egui::RichText {}"), 1);
    assert_eq!(wrong("cli/a.rs", "use crate::app::App;"), 1);
    assert_eq!(wrong("app/a.rs", "use crate::cli::run; use rusqlite;"), 2);
}

#[test]
fn right_arrows_pass() {
    let right = |file: &str, source: &str| assert_eq!(layers::violations(file, source), Vec::<String>::new());
    right(
        "compute/a.rs",
        "//! Not like [`crate::app`].\nuse super::angle; /* use std::fs; */ let s = \"crate::app::x\";",
    );
    right("compute/a/b.rs", "let c = '\"'; let r = r#\"crate::app::x \"\"#; mod tests { use super::super::c::x; }");
    right("compute/a.rs", "use crate::angle; use crate::compute::btdf; use super::angle;");
    right("drawing/lib.rs", "use cfs_compute as compute; use crate as drawing;");
    right("texts/widgets.rs", "impl From<Text> for egui::RichText {}");
    right("compute/a.rs", "fn f<'a>(image: &'a [u8]) { image.len(); self.app::<u8>(); }");
    right("app/a.rs", "use crate::study::Session; use egui::Ui;");
    right("cli/a.rs", "println!(\"{}\", crate::formats::image::size());");
    right("main.rs", "cfs::app::run(); cfs::cli::run();");
}

#[test]
fn leftovers_are_seen() {
    let seen = |text: &str| leftovers("x.rs", text).len();
    assert_eq!(seen("fn f() { todo!() }\nfn g() { dbg!(1); unimplemented!(\"x\") }"), 3);
    assert_eq!(seen("#[test]\n#[ignore]\nfn f() {}\n#[ignore = \"slow\"]"), 2);
    assert_eq!(seen("/// ```ignore\n/// x\n/// ```"), 1);
    assert_eq!(seen("// todo!() later; \"#[ignore]\"\nlet a = b != c; let s = \"dbg!(1)\";"), 0);
    let home = ["/ho", "me/me/x"].concat();
    assert!(machine_path(&home).is_some() && machine_path("src/home.rs, https://example.org/root").is_none());
}

#[test]
fn licence_expressions_are_weighed() {
    let accepted = |expression: &str| licences::accepted("some-crate", expression);
    for good in ["MIT", "MIT/Apache-2.0", "Apache-2.0 OR GPL-2.0-only", "(MIT OR GPL-3.0) AND Unicode-3.0"] {
        assert_eq!(accepted(good), Ok(true), "{good}");
    }
    for bad in ["GPL-3.0", "AGPL-3.0-only", "MIT AND MPL-2.0", "(MIT OR ISC) AND LGPL-3.0", "Apache-2.0 WITH Other"] {
        assert_eq!(accepted(bad), Ok(false), "{bad}");
    }
    for broken in ["", "MIT OR", "(MIT", "MIT ISC", "Apache-2.0 WITH"] {
        assert!(accepted(broken).is_err(), "{broken}");
    }
    assert_eq!(licences::accepted("option-ext", "MPL-2.0"), Ok(true));
}

/// A small tree of files with their texts.
fn made(files: &[(&str, &str)]) -> Vec<(String, String)> {
    files.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())).collect()
}

#[test]
fn arrows_lead_to_who_defines_a_name() {
    let arrows = arrows::arrows(&made(&[
        ("lib.rs", "pub mod compute;"),
        ("compute/lib.rs", "pub mod room; pub mod sky;"),
        ("compute/sky/mod.rs", "mod sun; pub use sun::Sun;"),
        ("compute/sky/sun.rs", "pub struct Sun; #[cfg(test)] mod tests { use crate::compute::room::Room; }"),
        ("compute/room.rs", "use crate::compute::sky::Sun; pub struct Room(Sun);"),
        ("study/lib.rs", "use cfs_compute as compute; pub mod room;"),
        ("study/room.rs", "use crate::compute::sky::Sun; use crate::facade::Facade;"),
        ("study/facade.rs", "use cfs_compute::room::Room; pub struct Facade;"),
    ]));
    let to: Vec<&String> = arrows["compute/room.rs"].keys().collect();
    assert_eq!(to, ["compute/sky/sun.rs"], "re-exports are followed");
    let to: Vec<&String> = arrows["study/room.rs"].keys().collect();
    assert_eq!(to, ["compute/sky/sun.rs", "study/facade.rs"], "crates have modules and layers");
    assert!(arrows["study/facade.rs"].contains_key("compute/room.rs"), "{arrows:?}");
    assert!(arrows["compute/sky/sun.rs"].is_empty() && arrows["compute/sky/mod.rs"].is_empty(), "{arrows:?}");
    assert_eq!(arrows::circles(&arrows), Vec::<Vec<String>>::new());
    assert_eq!(upward(&arrows, &["sky", "room"]), Vec::<String>::new());
    assert_eq!(upward(&arrows, &["room", "sky"]).len(), 1);
    assert_eq!(upward(&arrows, &["sky"]).len(), 1, "a room without a place in the order");
}

#[test]
fn circles_are_seen() {
    let parent = made(&[
        ("app/mod.rs", "mod a; pub struct App; fn f() { a::draw(); }"),
        ("app/a.rs", "use super::App; pub fn draw() {}"),
    ]);
    assert_eq!(arrows::circles(&arrows::arrows(&parent)), [["app/a.rs", "app/mod.rs"]]);
    let rooms = made(&[
        ("study/x/one.rs", "use crate::study::y::two::Two; pub struct One;"),
        ("study/y/two.rs", "pub struct Two;"),
        ("study/y/three.rs", "use crate::study::x::one::One;"),
    ]);
    let arrows = arrows::arrows(&rooms);
    assert!(arrows::circles(&arrows).is_empty());
    assert_eq!(arrows::circles(&arrows::between_rooms(&arrows, 2)), [["study/x", "study/y"]]);
}

#[test]
fn data_of_others_are_named_with_their_licence() {
    let read = |name: &str| std::fs::read_to_string(root().join(name)).unwrap();
    for name in ["README.md", "assets/places/README.md"] {
        let text = read(name);
        assert!(text.contains("GeoNames") && text.contains("creativecommons.org/licenses/by/4.0"), "{name}");
    }
    let size = std::fs::metadata(root().join("assets/places/places.tsv.zst")).unwrap().len();
    assert!(size < 400_000, "{size} bytes of places");
}

/// Files of the window and its reports whose literals may have words, with the reason.
const NO_WORDS: [(&str, &str); 18] = [
    ("src/app/catalogue/state_queue.rs", "a stage, which `texts::stages` translates"),
    ("src/app/command.rs", "the name of a field"),
    ("src/app/desktop.rs", "said on the terminal, where no window is"),
    ("src/app/display/language.rs", "languages by their own names"),
    ("src/app/goniophotometer/examples.rs", "system files, a format of its own"),
    ("src/app/compare/curves.rs", "the name of a plot"),
    ("src/app/panels/goniophotometer.rs", "the beginning of a system file"),
    ("src/app/panels/import.rs", "the name of an area"),
    ("src/app/results/backend.rs", "products of tests' catalogues"),
    ("src/app/session/autosave.rs", "the name of a thread"),
    ("src/drawing/svg.rs", "markup"),
    ("src/report/error.rs", "errors are in English, as those of the layers below"),
    ("src/report/pdf.rs", "errors"),
    ("src/report/size.rs", "errors"),
    ("src/report/study_report.rs", "a reason that is looked for"),
    ("src/report/tender.rs", "errors"),
    ("src/report/words.rs", "keys of stages"),
    ("src/report/tiles/mod.rs", "tiles by their names in files, and an error"),
];

#[test]
fn what_people_read_stands_in_the_texts() {
    let excused = |name: &str| NO_WORDS.iter().any(|(file, _)| *file == name) || name.ends_with("/tests.rs");
    let mut wrong = vec![];
    for (name, text) in
        sources(&["src/app", "src/report", "src/drawing"]).into_iter().filter(|(name, _)| !excused(name))
    {
        for literal in words::said(&text) {
            wrong
                .push(format!("{name}:{}: {:?} belongs into src/texts, in both languages", literal.line, literal.text));
        }
    }
    none(&wrong);
}
