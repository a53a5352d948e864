//! The command line under fire: outputs that name inputs, catalogues with flipped bits, text that commands a terminal.

use crate::rooms::*;
use cfs::catalogue::{Catalogue, NewProduct};
use cfs::compute::btdf::{Btdf, Dataset};
use cfs::formats::{Format, write_dataset};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn cfs(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_cfs"))
        .args(arguments)
        .current_dir(folder)
        .env("CFS_CATALOGUE", folder.join("catalogue.cfsdb"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = cfs(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", said(&output));
    String::from_utf8(output.stdout).unwrap()
}

/// Status 2 and one line that holds the words; nothing that commands a terminal.
fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let output = cfs(folder, arguments);
    let error = said(&output);
    assert_eq!((output.status.code(), error.trim_end().lines().count()), (Some(2), 1), "{arguments:?}: {error}");
    for word in words {
        assert!(error.contains(word), "{arguments:?}: '{word}' is not in: {error}");
    }
    assert!(!error.contains('\u{1b}'), "{error:?}");
}

fn opal(name: &str, tau: f64) -> Dataset {
    let mut dataset = Dataset { name: name.into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(tau));
    dataset
}

fn scene(folder: &Path, system: &str) -> PathBuf {
    let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], system)];
    let path = folder.join("a.toml");
    std::fs::write(&path, Text { apertures, ..Text::default() }.toml()).unwrap();
    path
}

#[test]
fn no_output_takes_the_place_of_its_input() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let xml = write_dataset(Format::BsdfXml, &[klems(rough)]).unwrap().bytes;
    std::fs::write(at.join("a.xml"), &xml).unwrap();
    let scene = std::fs::read(scene(at, "{ file = \"a.xml\" }")).unwrap();
    std::fs::hard_link(at.join("a.toml"), at.join("other.csv")).unwrap();
    std::fs::hard_link(at.join("a.xml"), at.join("data.csv")).unwrap();
    std::fs::create_dir(at.join("sub")).unwrap();
    let around = "sub/../a.xml";
    let cases: [&[&str]; 8] = [
        &["convert", "a.xml", "a.xml"],
        &["convert", "a.xml", around],
        &["repair", "a.xml", "--repair", "auto", "--out", "a.xml"],
        &["room", "a.toml", "--out", "a.toml"],
        // Under another name, and what the scene names.
        &["room", "a.toml", "--out", "other.csv"],
        &["room", "a.toml", "--out", "data.csv"],
        &["sky", "a.toml", "--out", "a.toml"],
        &["compare", "a.toml", "--csv", "--out", "a.toml"],
    ];
    for case in cases {
        for force in [&[][..], &["--force"]] {
            refused(at, &[case, force].concat(), &["is not written"]);
        }
        assert_eq!(
            (std::fs::read(at.join("a.toml")).unwrap(), std::fs::read(at.join("a.xml")).unwrap()),
            (scene.clone(), xml.clone())
        );
    }
    assert_eq!(
        std::fs::read_dir(at)
            .unwrap()
            .filter(|one| one.as_ref().unwrap().file_name().to_string_lossy().contains(".part"))
            .count(),
        0
    );
}

#[test]
fn packages_do_not_take_the_place_of_packages_they_come_from_nor_of_the_catalogue() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for name in ["clear-single", "opal-light"] {
        done(at, &["catalogue", "export", name, "--out", &format!("{name}.cfsp")]);
    }
    let before = std::fs::read(at.join("opal-light.cfsp")).unwrap();
    let merge = ["catalogue", "merge", "clear-single.cfsp", "opal-light.cfsp", "--out"];
    refused(at, &[&merge[..], &["opal-light.cfsp", "--force"]].concat(), &["opal-light.cfsp", "made from"]);
    assert_eq!(std::fs::read(at.join("opal-light.cfsp")).unwrap(), before);
    done(at, &[&merge[..], &["both.cfsp"]].concat());
    // A package in place of a package is what is meant.
    done(at, &[&merge[..], &["both.cfsp"]].concat());
    refused(at, &["catalogue", "export", "opal-light", "--out", "catalogue.cfsdb", "--force"], &["made from"]);
    std::fs::write(at.join("notes.cfsp"), "my notes").unwrap();
    refused(at, &["catalogue", "export", "opal-light", "--out", "notes.cfsp"], &["not a package", "--force"]);
    done(at, &["catalogue", "export", "opal-light", "--out", "notes.cfsp", "--force"]);
}

#[test]
fn what_dead_programs_leave_goes_and_an_empty_file_may_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    scene(at, "{ ideal = \"diffuse\", transmittance = 0.5 }");
    std::fs::write(at.join("a.csv.0123456789abcdef.part"), "x,y").unwrap();
    std::fs::write(at.join("a.csv"), "").unwrap();
    done(at, &["room", "a.toml", "--out", "a.csv"]);
    assert!(!at.join("a.csv.0123456789abcdef.part").exists());
    assert!(std::fs::read_to_string(at.join("a.csv")).unwrap().starts_with("x,y,z,"));
}

#[test]
fn flipped_bits_are_told_and_mended_from_the_file_they_came_from() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("opal.xml"), write_dataset(Format::BsdfXml, &[klems(rough)]).unwrap().bytes).unwrap();
    let key = done(at, &["catalogue", "import", "opal.xml", "--name", "Mine"]).trim().to_owned();
    assert!(done(at, &["catalogue", "check"]).contains("whole"));
    let db = rusqlite::Connection::open(at.join("catalogue.cfsdb")).unwrap();
    let hash: String = db
        .query_row("SELECT dataset FROM state s JOIN product p ON p.id = s.product WHERE p.key = ?", [&key], |row| {
            row.get(0)
        })
        .unwrap();
    let mut blob: Vec<u8> = db.query_row("SELECT blob FROM dataset WHERE hash = ?", [&hash], |row| row.get(0)).unwrap();
    let middle = blob.len() / 2;
    blob[middle] ^= 4;
    db.execute("UPDATE dataset SET blob = ?1 WHERE hash = ?2", (&blob, &hash)).unwrap();
    drop(db);
    scene(at, &format!("{{ catalogue = \"{key}\" }}"));
    refused(at, &["room", "a.toml"], &["damaged", "not what was stored", "cfs catalogue check --repair"]);
    refused(at, &["catalogue", "export", &key, "--out", "x.cfsp"], &["damaged"]);
    assert!(!at.join("x.cfsp").exists());
    let check = cfs(at, &["catalogue", "check"]);
    assert_eq!(check.status.code(), Some(1), "{}", said(&check));
    assert!(String::from_utf8(check.stdout).unwrap().contains("data of \"mine\""));
    let mended = done(at, &["catalogue", "check", "--repair"]);
    assert!(mended.contains("repaired: data of \"mine\"") && mended.contains(".damaged"), "{mended}");
    done(at, &["room", "a.toml"]);
    // Without its file it is lost, and said so.
    let db = rusqlite::Connection::open(at.join("catalogue.cfsdb")).unwrap();
    db.execute("UPDATE dataset SET blob = ?1 WHERE hash = ?2", (&blob, &hash)).unwrap();
    drop(db);
    std::fs::remove_file(at.join("opal.xml")).unwrap();
    let lost = cfs(at, &["catalogue", "check", "--repair"]);
    assert_eq!(lost.status.code(), Some(1), "{}", said(&lost));
    assert!(String::from_utf8(lost.stdout).unwrap().contains("lost: data of \"mine\""));
}

#[test]
fn a_list_says_what_was_restored_and_what_it_leaves_out() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("opal.xml"), write_dataset(Format::BsdfXml, &[klems(rough)]).unwrap().bytes).unwrap();
    done(at, &["catalogue", "import", "opal.xml", "--name", "Mine"]);
    let before = done(at, &["catalogue", "list"]);
    let db = rusqlite::Connection::open(at.join("catalogue.cfsdb")).unwrap();
    db.execute_batch("UPDATE product SET name = name || 'x' WHERE key IN ('clear-single', 'mine')").unwrap();
    drop(db);
    let list = cfs(at, &["catalogue", "list"]);
    let warnings = said(&list);
    assert!(warnings.contains("restored from the data built into the program: clear-single."), "{warnings}");
    assert!(warnings.contains("Not listed, because damaged in the catalogue: mine."), "{warnings}");
    let after = String::from_utf8(list.stdout).unwrap();
    assert_eq!(before.lines().count(), after.lines().count() + 1);
    assert!(after.lines().all(|line| before.contains(line)), "{after}");
    let check = cfs(at, &["catalogue", "check"]);
    let report = String::from_utf8(check.stdout).unwrap();
    assert!(check.status.code() == Some(1) && report.contains("\"clear-single\" was damaged and restored"), "{report}");
}

#[test]
fn layouts_that_are_none_are_told_in_one_line_and_mended() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    done(at, &["catalogue", "list"]);
    for number in [-1, 0, 3] {
        let db = rusqlite::Connection::open(at.join("catalogue.cfsdb")).unwrap();
        db.pragma_update(None, "user_version", number).unwrap();
        drop(db);
        let told = cfs(at, &["catalogue", "list"]);
        assert_eq!(told.status.code(), Some(2), "{number}");
        let error = said(&told);
        assert!(error.contains("check --repair") && !error.contains("CREATE") && error.lines().count() == 1, "{error}");
        assert!(done(at, &["catalogue", "check", "--repair"]).contains("repaired"), "{number}");
        done(at, &["catalogue", "list"]);
    }
}

#[test]
fn names_and_messages_command_no_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let name = "Red \u{1b}[31m\u{1b}]0;owned\u{7} \u{202e}dlrow\nfake-key  venetian";
    let mut source = Catalogue::empty_in_memory().unwrap();
    let meta = NewProduct { name: name.into(), kind: "x\u{9b}2J".into(), ..NewProduct::default() };
    let key = source.import(&[opal(name, 0.5)], meta).unwrap().key;
    std::fs::write(at.join("a.cfsp"), source.export_package(&[key]).unwrap()).unwrap();
    let key = done(at, &["catalogue", "import", "a.cfsp"]).trim().to_owned();
    for arguments in [
        &["catalogue", "list"][..],
        &["catalogue", "list", "--json"],
        &["catalogue", "show", &key],
        &["catalogue", "history", &key],
        &["info", "a.cfsp"],
        &["info", "a.cfsp", "--json"],
    ] {
        let shown = done(at, arguments);
        assert!(!shown.contains(['\u{1b}', '\u{7}', '\u{9b}', '\u{202e}']), "{arguments:?}: {shown:?}");
        assert!(!shown.lines().any(|line| line.starts_with("fake-key")), "{arguments:?}: {shown}");
        if arguments.contains(&"--json") {
            serde_json::from_str::<serde_json::Value>(&shown).unwrap();
        }
    }
    assert!(done(at, &["catalogue", "list"]).contains("Red \\u001b[31m"));
    refused(at, &["room", "no\u{1b}[31m.toml"], &["no\\u001b[31m.toml"]);
    std::fs::write(at.join("a.ldt"), "maker\n1\n\u{1b}[31m\u{1b}]0;x\u{7}\n").unwrap();
    refused(at, &["info", "a.ldt"], &["line"]);
}

#[test]
fn encodings_keys_and_units_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let utf16 = |text: &str| -> Vec<u8> { text.encode_utf16().flat_map(u16::to_le_bytes).collect() };
    let toml = std::fs::read_to_string(scene(at, "{ ideal = \"diffuse\", transmittance = 0.5 }")).unwrap();
    done(at, &["lid", "a.toml", "--out", "a.ldt"]);
    let luminaire = std::fs::read_to_string(at.join("a.ldt")).unwrap();
    std::fs::write(at.join("b.ldt"), [&[0xff, 0xfe][..], &utf16(&luminaire)].concat()).unwrap();
    let told = done(at, &["info", "b.ldt"]);
    assert!(told.contains("UTF-16"), "{told}");
    let flux = |text: &str| text.lines().find(|line| line.starts_with("Flux")).unwrap().to_owned();
    assert_eq!(flux(&told), flux(&done(at, &["info", "a.ldt"])));
    let room = done(at, &["room", "a.toml"]);
    for other in [utf16(&toml), [b"# B\xfcro\n", toml.as_bytes()].concat(), toml.replace('\n', "\r").into_bytes()] {
        std::fs::write(at.join("b.toml"), other).unwrap();
        assert_eq!(done(at, &["room", "b.toml"]), room);
    }
    std::fs::write(at.join("b.toml"), [&[0, 0xff][..], toml.as_bytes()].concat()).unwrap();
    refused(at, &["room", "b.toml"], &["b.toml", "8-bit data", "UTF-8"]);
    for name in ["b.toml", "b.xml", "b.btdf.txt", "b.system.toml", "b"] {
        std::fs::write(at.join(name), "<!DOCTYPE html>\n<html></html>").unwrap();
        let command = if name == "b.toml" { "room" } else { "info" };
        refused(at, &[command, name], &[name, "HTML page", "download the raw file"]);
    }
    std::fs::write(at.join("b.toml"), toml.replacen("width = ", "width = \"wide\" # ", 1)).unwrap();
    refused(at, &["room", "b.toml"], &["room.width", "string \"wide\"", "a number in m"]);
}
