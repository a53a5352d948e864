//! Files without a name: standard input and output and pipes for every kind of file, and tables for spreadsheets.

use crate::program::cfs;
use crate::rooms::*;
use cfs::compute::btdf::{Btdf, Dataset};
use cfs::formats::{Format, write_dataset};
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Runs the program with bytes as its standard input.
fn fed(folder: &Path, arguments: &[&str], input: &[u8]) -> Vec<u8> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_cfs"))
        .args(arguments)
        .current_dir(folder)
        .env("CFS_CATALOGUE", folder.join("catalogue.cfsdb"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", said(&output));
    output.stdout
}

fn done(folder: &Path, arguments: &[&str]) -> Vec<u8> {
    let output = cfs(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", said(&output));
    output.stdout
}

fn opal() -> Vec<u8> {
    let mut dataset = Dataset { name: "opal".into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(0.5));
    write_dataset(Format::BsdfXml, &[dataset]).unwrap().bytes
}

fn scene(folder: &Path) -> Vec<u8> {
    let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], "{ ideal = \"diffuse\", transmittance = 0.5 }")];
    std::fs::write(folder.join("a.toml"), Text { apertures, ..Text::default() }.toml()).unwrap();
    std::fs::read(folder.join("a.toml")).unwrap()
}

#[test]
fn one_file_may_go_to_standard_output_whatever_its_format() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let scene = scene(at);
    let xml = opal();
    let text = fed(at, &["convert", "-", "-", "--format", "btdf.txt"], &xml);
    assert_eq!(Format::sniff("", &text), Some(Format::BtdfText));
    for (format, start) in [("ies", "IES"), ("csv", "c_deg"), ("svg", "<"), ("png", "\u{89}PNG")] {
        let bytes = fed(at, &["lid", "-", "--out", "-", "--format", format, "--step", "15"], &scene);
        let head: String = bytes.iter().take(8).map(|byte| char::from(*byte)).collect();
        assert!(head.starts_with(start), "{format}: {head}");
    }
    assert!(fed(at, &["report", "-", "--out", "-"], &scene).starts_with(b"%PDF-"));
    assert!(
        fed(at, &["picture", "-", "--tile", "room", "--out", "-", "--format", "png"], &scene).starts_with(b"\x89PNG")
    );
    assert!(fed(at, &["compact", "-", "--out", "-"], &xml).starts_with(b"CFSD"));
    assert!(done(at, &["catalogue", "export", "clear-single", "--out", "-"]).starts_with(b"PK"));
    // What else is printed goes to standard error.
    let table = fed(at, &["room", "-", "--json", "--out", "-"], &scene);
    assert_eq!(table, done(at, &["room", "a.toml"]));
    assert!(!at.join("-").exists());
}

#[test]
fn several_files_and_an_unknown_format_are_refused_for_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    scene(at);
    std::fs::write(at.join("a.xml"), opal()).unwrap();
    for (arguments, words) in [
        (&["lid", "a.toml", "--out", "-"][..], "--format"),
        (&["lid", "a.toml", "--out", "-", "--format", "ldt", "--tiles", "2x1"], "several files"),
        (&["lid", "a.toml", "--out", "a.ldt", "--format", "ldt"], "for standard output"),
        (&["convert", "a.xml", "-", "--format", "pdf"], "BSDF XML"),
        (&["lid", "a.toml", "--out", "a.ldt", "--decimal-comma"], "CSV table"),
        (&["room", "a.toml", "--json", "--decimal-comma"], "no CSV table is written"),
    ] {
        let output = cfs(at, arguments);
        assert!(output.status.code() == Some(2) && said(&output).contains(words), "{arguments:?}: {}", said(&output));
        assert!(output.stdout.is_empty());
    }
}

#[cfg(unix)]
#[test]
fn input_from_a_pipe_is_recognised_by_its_content() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let scene = scene(at);
    std::fs::write(at.join("opal.xml"), opal()).unwrap();
    for name in ["a.ldt", "a.ies"] {
        done(at, &["lid", "a.toml", "--step", "15", "--out", name]);
        let bytes = std::fs::read(at.join(name)).unwrap();
        assert_eq!(fed(at, &["info", "-"], &bytes), done(at, &["info", name]));
        assert_eq!(fed(at, &["info", "/dev/stdin"], &bytes), done(at, &["info", name]));
    }
    done(at, &["lid", "a.toml", "--step", "15", "--tiles", "2x1", "--out", "t.ldt"]);
    let index = std::fs::read(at.join("t.index.csv")).unwrap();
    assert_eq!(fed(at, &["info", "-"], &index), done(at, &["info", "t.index.csv"]));
    assert_eq!(fed(at, &["info", "-"], &opal()), done(at, &["info", "opal.xml"]));
    assert_eq!(fed(at, &["compare", "-"], &scene).len(), done(at, &["compare", "a.toml"]).len());
    fed(at, &["catalogue", "validate", "-"], &opal());
    assert_eq!(fed(at, &["catalogue", "import", "-", "--name", "Opal"], &opal()), b"opal\n");
}

#[cfg(unix)]
#[test]
fn a_named_pipe_is_read_once_where_a_command_asks_twice() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let scene = scene(at);
    assert!(Command::new("mkfifo").arg(at.join("pipe")).status().unwrap().success());
    // An output that is there is compared with the inputs, which must not open the pipe.
    std::fs::write(at.join("a.csv"), "").unwrap();
    for arguments in [&["room", "pipe", "--out", "a.csv"][..], &["report", "pipe", "--out", "a.pdf"]] {
        let (path, scene) = (at.join("pipe"), scene.clone());
        let writer = std::thread::spawn(move || std::fs::write(path, scene).unwrap());
        done(at, arguments);
        writer.join().unwrap();
    }
    assert_eq!(std::fs::read(at.join("a.csv")).unwrap(), done(at, &["room", "a.toml"]));
}

#[test]
fn tables_with_decimal_commas_are_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    scene(at);
    let plain = String::from_utf8(done(at, &["room", "a.toml"])).unwrap();
    let comma = String::from_utf8(done(at, &["room", "a.toml", "--decimal-comma"])).unwrap();
    let (head, row) = (comma.lines().next().unwrap(), comma.lines().nth(1).unwrap());
    assert!(head.starts_with("\u{feff}x;y;z;") && row.contains("0,85;0;0;1;"), "{head} {row}");
    let back = comma.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace(',', ".").replace(';', ",");
    assert_eq!(back, plain);
    done(at, &["room", "a.toml", "--decimal-comma", "--out", "comma.csv"]);
    assert_eq!(std::fs::read_to_string(at.join("comma.csv")).unwrap(), comma);
    done(at, &["accuracy", "a.toml", "--reference", "comma.csv"]);
    // As a scan of the sky.
    done(at, &["sky", "a.toml", "--decimal-comma", "--out", "sky.csv"]);
    let text = std::fs::read_to_string(at.join("a.toml")).unwrap();
    let sky = text.split("[sky]").nth(1).unwrap().split("\n[").next().unwrap();
    std::fs::write(at.join("b.toml"), text.replace(sky, "\nmodel = \"scan\"\nfile = \"sky.csv\"\n")).unwrap();
    done(at, &["sky", "b.toml"]);
}
