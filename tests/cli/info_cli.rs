//! `cfs info` of several files and of system descriptions.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

/// Runs `cfs info` in the package's folder with a catalogue of its own.
fn info(arguments: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    Command::new(env!("CARGO_BIN_EXE_cfs"))
        .arg("info")
        .args(arguments)
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")))
        .env("CFS_CATALOGUE", folder.path().join("catalogue.sqlite"))
        .output()
        .unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let output = info(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

const OPAL: &str = "examples/opal.btdf.txt";
const BLIND: &str = "assets/systems/venetian-80-72.system.toml";
const STACK: &str = "assets/systems/low-e-double-exterior-blind.system.toml";

#[test]
fn several_files_are_described_each_under_its_name() {
    let list = json(&[OPAL, "builtin:renton", BLIND, "--json"]);
    let files: Vec<&str> = list.as_array().unwrap().iter().map(|one| one["file"].as_str().unwrap()).collect();
    assert_eq!(files, [OPAL, "builtin:renton", BLIND]);
    // Apart from the name, each is described as it is alone.
    let mut alone = json(&[OPAL, "--json"]);
    assert!(alone.get("file").is_none());
    alone["file"] = OPAL.into();
    assert_eq!(list[0], alone);

    let one = |file: &str| String::from_utf8(info(&[file]).stdout).unwrap();
    let both = String::from_utf8(info(&[OPAL, BLIND]).stdout).unwrap();
    let label = |file: &str| format!("{:<22}{file}\n", "File");
    assert_eq!(both, format!("{}{}\n{}{}", label(OPAL), one(OPAL), label(BLIND), one(BLIND)));
}

#[test]
fn a_file_that_cannot_be_read_does_not_hide_the_others() {
    let output = info(&["none.xml", OPAL, "other.xml"]);
    assert_eq!(output.status.code(), Some(2));
    let errors = String::from_utf8(output.stderr).unwrap();
    let lines: Vec<&str> = errors.lines().collect();
    assert!(lines.len() == 2 && lines[0].contains("none.xml") && lines[1].contains("other.xml"), "{errors}");
    assert!(String::from_utf8(output.stdout).unwrap().contains("145 incident directions"));
    assert_eq!(info(&[]).status.code(), Some(2));
}

#[test]
fn a_description_is_described_with_its_states_and_layers() {
    let blind = json(&[BLIND, "--json"]);
    assert_eq!((blind["kind"].as_str(), blind["states"].as_array().map(Vec::len)), (Some("venetian"), Some(16)));
    assert_eq!(blind["structure_m"], 0.072);
    let stack = json(&[STACK, "--json"]);
    let layers: Vec<&str> =
        stack["layers"].as_array().unwrap().iter().map(|layer| layer["file"].as_str().unwrap()).collect();
    assert_eq!(layers.len(), 2, "{stack}");
    // A stack has the states of its moving layer.
    assert!(stack["states"].as_array().unwrap().len() > 1, "{stack}");

    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bad.system.toml");
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(BLIND)).unwrap();
    std::fs::write(&file, text.replace("kind = \"venetian\"", "kind = \"curtain\"")).unwrap();
    let output = info(&[file.to_str().unwrap()]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{error}");
    assert!(error.contains("bad.system.toml") && error.contains("curtain"), "{error}");
}
