//! Which layer may use what.

use crate::scan::{UsedPath, macros, paths};

/// A folder of `src`: the folders below it, and what else it must not name.
struct Layer {
    name: &'static str,
    below: &'static [&'static str],
    forbidden: &'static [&'static [&'static str]],
    silent: bool,
}

/// The machine.
const DISK: &[&str] = &["std::fs", "std::net", "std::env", "std::time", "std::path", "std::process"];
/// What draws.
const WINDOW: &[&str] = &["egui", "eframe", "egui_plot", "rfd"];
/// Written forms.
const TEXT: &[&str] = &["serde", "serde_json", "toml"];
/// The command line.
const SHELL: &[&str] = &["clap", "anyhow"];

const LAYERS: [Layer; 9] = [
    Layer { name: "texts", below: &[], forbidden: &[DISK, &["std::io", "serde", "egui"]], silent: true },
    Layer {
        name: "compute",
        below: &[],
        forbidden: &[DISK, WINDOW, TEXT, SHELL, &["std::io", "rusqlite", "image", "png", "csv", "zip", "jiff"]],
        silent: true,
    },
    Layer {
        name: "drawing",
        below: &["texts", "compute"],
        forbidden: &[DISK, WINDOW, TEXT, SHELL, &["rusqlite", "csv", "zip"]],
        silent: true,
    },
    Layer {
        name: "formats",
        below: &["texts", "compute", "drawing"],
        forbidden: &[DISK, WINDOW, SHELL, &["rusqlite"]],
        silent: true,
    },
    Layer {
        name: "catalogue",
        below: &["texts", "compute", "drawing", "formats"],
        forbidden: &[WINDOW, SHELL, &["std::net", "std::process", "toml", "roxmltree"]],
        silent: true,
    },
    Layer {
        name: "study",
        below: &["texts", "compute", "drawing", "formats", "catalogue"],
        forbidden: &[WINDOW, &["std::net", "std::process", "rusqlite", "clap", "roxmltree"]],
        silent: true,
    },
    Layer {
        name: "report",
        below: &["texts", "compute", "drawing", "formats", "catalogue", "study"],
        forbidden: &[
            WINDOW,
            &["std::fs", "std::net", "std::env", "std::path", "std::process", "rusqlite", "clap", "roxmltree"],
        ],
        silent: true,
    },
    Layer {
        name: "cli",
        below: &["texts", "compute", "drawing", "formats", "catalogue", "study", "report"],
        forbidden: &[WINDOW, &["rusqlite", "roxmltree", "quick_xml"]],
        silent: false,
    },
    Layer {
        name: "app",
        below: &["texts", "compute", "drawing", "formats", "catalogue", "study", "report"],
        forbidden: &[&["rusqlite", "clap", "roxmltree", "quick_xml", "csv", "zip", "zstd"]],
        silent: true,
    },
];

/// Names of forbidden crates that single files may use, with the reason.
const EXCEPT: [(&str, &str, &str); 1] =
    [("texts/widgets.rs", "egui", "conversions, which the crate of one of the two types alone may have")];

fn is_layer(name: &str) -> bool {
    LAYERS.iter().any(|layer| layer.name == name)
}

/// The layer that a path leads to, if it is seen to. `depth`: how many modules up the root of the file's crate is.
fn target(path: &UsedPath, depth: usize) -> Option<&str> {
    let word = |index: usize| path.words.get(index).map(String::as_str);
    let named = match word(0)? {
        "crate" | "cfs" => word(1),
        "self" | "super" => {
            let ups = path.words.iter().filter(|word| *word == "super").count();
            let rest = path.words.iter().find(|word| !matches!(word.as_str(), "self" | "super"))?;
            (ups >= depth).then_some(rest.as_str())
        }
        first => first.strip_prefix("cfs_"),
    };
    // Layers go by their names in all crates; what else is at a root is the crate's own.
    named.filter(|name| is_layer(name))
}

/// What is wrong with the arrows of one file, given by its path under `src`.
pub fn violations(file: &str, source: &str) -> Vec<String> {
    let Some(layer) = LAYERS.iter().find(|layer| file.starts_with(&format!("{}/", layer.name))) else {
        return vec![];
    };
    // The window and the command line are modules of a crate, the other layers are crates.
    let root = usize::from(matches!(layer.name, "app" | "cli"));
    let depth = file.trim_end_matches("/mod.rs").trim_end_matches("/lib.rs").matches('/').count() + root;
    let excused = |name: &str| EXCEPT.iter().any(|(one, own, _)| *one == file && *own == name);
    let mut wrong = vec![];
    for path in paths(source) {
        let text = path.words.join("::");
        if let Some(to) = target(&path, depth)
            && to != layer.name
            && !layer.below.contains(&to)
        {
            wrong.push(format!("src/{file}:{}: {} must not use {text}", path.line, layer.name));
        }
        let mut names = layer.forbidden.iter().copied().flatten().filter(|name| !excused(name));
        if names.any(|name| text == *name || text.starts_with(&format!("{name}::"))) {
            wrong.push(format!("src/{file}:{}: {} must not use {text}", path.line, layer.name));
        }
    }
    if layer.silent {
        let spoken = macros(source).into_iter().filter(|(_, name)| matches!(name.as_str(), "println" | "print"));
        wrong.extend(spoken.map(|(line, _)| format!("src/{file}:{line}: {} must not print results", layer.name)));
    }
    wrong
}

/// What is wrong with the dependencies of a package, given by its folder and its manifest. Those of tests are free.
pub fn wrong_dependencies(folder: &str, manifest: &toml::Table) -> Vec<String> {
    let Some(layer) = LAYERS.iter().find(|layer| folder == format!("src/{}", layer.name)) else { return vec![] };
    let forbidden = |name: &str| layer.forbidden.iter().copied().flatten().any(|one| *one == name.replace('-', "_"));
    let optional = |what: &toml::Value| what.get("optional").and_then(toml::Value::as_bool) == Some(true);
    let wrong = |name: &str, what: &toml::Value| match name.strip_prefix("cfs-") {
        Some(other) => !layer.below.contains(&other),
        None => forbidden(name) && !optional(what),
    };
    let list = manifest["dependencies"].as_table().into_iter().flatten().filter(|(name, what)| wrong(name, what));
    list.map(|(name, _)| format!("{folder}/Cargo.toml: {} must not depend on {name}", layer.name)).collect()
}
