//! `cfs accuracy` beside a truth from outside: true errors against it, and one sentence where it is of another scene.

use crate::program::cfs;
use crate::rooms::*;
use serde_json::Value;
use std::path::Path;
use std::process::Output;

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// A scene of three sensors and what `cfs room` makes of it.
fn prepared() -> (tempfile::TempDir, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let sensors = points(&[[2.0, 2.0, 0.85], [2.0, 0.5, 0.85], [1.0, 4.0, 0.85]], [0.0, 0.0, 1.0]);
    let scene = Text { sensors, compute: "error_target = 1e-6".into(), ..Text::default() };
    std::fs::write(folder.path().join("a.toml"), scene.toml()).unwrap();
    let output = cfs(folder.path(), &["room", "a.toml", "--out", "true.csv"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let table = std::fs::read_to_string(folder.path().join("true.csv")).unwrap();
    (folder, table.lines().map(str::to_owned).collect())
}

fn against(folder: &Path, lines: &[String], arguments: &[&str]) -> Output {
    std::fs::write(folder.join("given.csv"), lines.join("\n") + "\n").unwrap();
    let all: Vec<&str> =
        ["accuracy", "a.toml", "--reference", "given.csv"].into_iter().chain(arguments.to_vec()).collect();
    cfs(folder, &all)
}

/// Status 2, nothing on standard output, one line that holds all the words.
fn refused(folder: &Path, lines: &[String], words: &[&str]) {
    let output = against(folder, lines, &[]);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(output.stdout.is_empty() && error.trim_end_matches('\n').lines().count() == 1, "{error}");
    for word in words.iter().chain(&["given.csv"]) {
        assert!(error.contains(word), "'{word}' is not in: {error}");
    }
}

#[test]
fn errors_against_a_file_are_true_ones() {
    let (folder, lines) = prepared();
    let output = against(folder.path(), &lines, &["--csv", "ladder.csv", "--plot", "a.svg"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for word in ["true error against given.csv", "true RMS", "with a stated uncertainty of"] {
        assert!(text(&output.stdout).contains(word), "{word}: {}", text(&output.stdout));
    }
    assert!(!text(&output.stdout).contains("finest run"), "{}", text(&output.stdout));
    assert!(std::fs::read_to_string(folder.path().join("a.svg")).unwrap().contains("true error (RMS)"));
    let mut reader = csv::Reader::from_path(folder.path().join("ladder.csv")).unwrap();
    assert!(reader.records().all(|row| &row.unwrap()[2] == "given.csv"));

    // A tenth more at every sensor, of which half is uncertain: nobody keeps to what is stated but by chance.
    let shifted: Vec<String> = lines
        .iter()
        .enumerate()
        .map(|(k, line)| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if k > 0 {
                let light: f64 = cells[6].parse().unwrap();
                (cells[6], cells[9]) = ((light / 0.9).to_string(), (0.05 * light / 0.9).to_string());
            }
            cells.join(",")
        })
        .collect();
    let output = against(folder.path(), &shifted, &["--json"]);
    let value: Value = serde_json::from_slice(&output.stdout).unwrap();
    let reference = &value["references"][0];
    assert_eq!((reference["against"].as_str(), &reference["error_target"]), (Some("given.csv"), &Value::Null));
    assert!((reference["stated"].as_f64().unwrap() - 0.05).abs() < 1e-6);
    let rung = &value["series"][0]["rungs"][4];
    // The file is too uncertain to tell what is stated at this effort, and says so.
    assert!(
        rung["error_rms"].is_null() && rung["remark"].as_str().unwrap().contains("given.csv itself is uncertain"),
        "{rung}"
    );
}

#[test]
fn a_truth_of_another_scene_is_refused_in_one_sentence() {
    let (folder, lines) = prepared();
    let folder = folder.path();
    refused(folder, &lines[..3], &["line 4", "after 2 sensors", "expected 3"]);
    let longer: Vec<String> = lines.iter().chain([&lines[1]]).cloned().collect();
    refused(folder, &longer, &["line 5", "one sensor too many", "3"]);
    let mut moved = lines.clone();
    moved.swap(2, 3);
    refused(folder, &moved, &["line 3", "position", "sensor 2"]);
    let mut turned = lines.clone();
    turned[1] = turned[1].replacen(",0,0,1,", ",0,1,0,", 1);
    refused(folder, &turned, &["line 2", "normal", "sensor 1"]);
    let mut without = lines.clone();
    without[0] = without[0].replace("E_lx", "lux");
    refused(folder, &without, &["line 1", "no column E_lx"]);
    let mut word = lines.clone();
    word[3] = word[3].replacen("1,4,", "1,far,", 1);
    refused(folder, &word, &["line 4", "'far'", "expected a number"]);
    let output = cfs(folder, &["accuracy", "a.toml", "--reference", "none.csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("none.csv"));
}
