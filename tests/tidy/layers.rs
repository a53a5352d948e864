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
const WINDOW: &[&str] = &["egui", "eframe", "egui_plot"];
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
        forbidden: &[WINDOW, &["rusqlite", "rfd", "roxmltree", "quick_xml"]],
        silent: false,
    },
    Layer {
        name: "app",
        below: &["texts", "compute", "drawing", "formats", "catalogue", "study", "report"],
        forbidden: &[&["rusqlite", "clap", "roxmltree", "quick_xml", "csv", "zip", "zstd"]],
        silent: true,
    },
];

/// The crate's folder that a path leads to, if it is seen to. `depth`: 1 for `src/x.rs` and `src/x/mod.rs`, and so on.
fn target(path: &UsedPath, depth: usize) -> Option<&str> {
    let word = |index: usize| path.words.get(index).map(String::as_str);
    match word(0)? {
        "crate" | "cfs" => word(1),
        "self" | "super" => {
            let ups = path.words.iter().filter(|word| *word == "super").count();
            let rest = path.words.iter().find(|word| !matches!(word.as_str(), "self" | "super"))?;
            (ups >= depth && LAYERS.iter().any(|layer| layer.name == rest)).then_some(rest.as_str())
        }
        _ => None,
    }
}

/// What is wrong with the arrows of one file, given by its path under `src`.
pub fn violations(file: &str, source: &str) -> Vec<String> {
    let Some(layer) = LAYERS.iter().find(|layer| file.starts_with(&format!("{}/", layer.name))) else {
        return vec![];
    };
    let depth = file.trim_end_matches("/mod.rs").matches('/').count() + 1;
    let mut wrong = vec![];
    for path in paths(source) {
        let text = path.words.join("::");
        if let Some(to) = target(&path, depth)
            && to != layer.name
            && !layer.below.contains(&to)
        {
            wrong.push(format!("src/{file}:{}: {} must not use {text}", path.line, layer.name));
        }
        if layer.forbidden.iter().copied().flatten().any(|name| text == *name || text.starts_with(&format!("{name}::")))
        {
            wrong.push(format!("src/{file}:{}: {} must not use {text}", path.line, layer.name));
        }
    }
    if layer.silent {
        let spoken = macros(source).into_iter().filter(|(_, name)| matches!(name.as_str(), "println" | "print"));
        wrong.extend(spoken.map(|(line, _)| format!("src/{file}:{line}: {} must not print results", layer.name)));
    }
    wrong
}
