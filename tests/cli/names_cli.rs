//! Names and streams: bytes that are not UTF-8, `-`, and nothing that stays behind after a refusal.

use crate::rooms::*;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn cfs(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cfs"));
    command.current_dir(folder).env("CFS_CATALOGUE", folder.join("catalogue.cfsdb"));
    command
}

fn scene(folder: &Path) {
    let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], "{ ideal = \"diffuse\", transmittance = 0.5 }")];
    std::fs::write(folder.join("a.toml"), Text { apertures, ..Text::default() }.toml()).unwrap();
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[cfg(unix)]
#[test]
fn a_name_that_is_not_utf_8_is_written_and_its_sibling_stays() {
    use std::{ffi::OsStr, os::unix::ffi::OsStrExt as _};
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    scene(at);
    // What the name would be with its byte replaced.
    std::fs::write(at.join("a\u{fffd}.ldt"), "mine").unwrap();
    let name = OsStr::from_bytes(b"a\xff.ldt");
    let output = cfs(at).args(["lid", "a.toml", "--out"]).arg(name).output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    assert!(std::fs::metadata(at.join(name)).unwrap().len() > 1000);
    assert_eq!(std::fs::read(at.join("a\u{fffd}.ldt")).unwrap(), b"mine");
    let tiles = cfs(at).args(["lid", "a.toml", "--tiles", "2x1", "--out"]).arg(name).output().unwrap();
    assert!(tiles.status.code() == Some(2) && said(&tiles).contains("not UTF-8"), "{}", said(&tiles));
}

#[test]
fn characters_that_stand_as_boxes_in_a_picture_or_report_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], "{ file = \"o.system.toml\" }")];
    std::fs::write(at.join("a.toml"), Text { apertures, ..Text::default() }.toml()).unwrap();
    let boxes = |name: &str, out: &str| {
        let opal =
            format!("name = {name:?}\nkind = \"diffuser\"\n[diffuser]\ntransmittance = 0.5\nreflectance = 0.4\n");
        std::fs::write(at.join("o.system.toml"), opal + "model = \"lambertian\"\n").unwrap();
        let what: &[&str] = if out.ends_with("pdf") { &["report"] } else { &["picture", "--tile", "transmittance"] };
        let output = cfs(at).args(what).args(["a.toml", "--language", "de", "--out", out]).output().unwrap();
        assert!(output.status.success(), "{}", said(&output));
        said(&output).lines().filter(|line| line.starts_with("warning: ")).map(str::to_owned).collect::<Vec<_>>()
    };
    for out in ["o.png", "o.pdf"] {
        let warnings = boxes("铝百叶窗 80", out);
        assert!(warnings.len() == 1 && warnings[0].contains("窗 (U+7A97)"), "{warnings:?}");
        assert_eq!(boxes("תריס ستارة Жалюзи", out), [""; 0], "{out}");
    }
    assert_eq!(boxes("铝百叶窗 80", "o.svg"), [""; 0], "text stays text");
}

#[test]
fn what_is_written_is_named_by_its_absolute_path() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path());
    for (command, name) in [
        (&["lid", "a.toml"][..], "a.ldt"),
        (&["room", "a.toml"], "a.csv"),
        (&["picture", "a.toml", "--tile", "room"], "a.svg"),
        (&["catalogue", "export", "clear-single"], "a.cfsp"),
    ] {
        let output = cfs(folder.path()).args(command).args(["--out", name]).output().unwrap();
        let told = format!("written: {}\n", folder.path().join(name).display());
        assert!(said(&output).ends_with(&told), "{told} is not in: {}", said(&output));
    }
    let output = cfs(folder.path()).args(["lid", "a.toml", "--tiles", "3x2", "--out", "b.ldt"]).output().unwrap();
    let told = format!("written: {} and 6 more files beside it\n", folder.path().join("b_1.ldt").display());
    assert!(said(&output).ends_with(&told), "{told} is not in: {}", said(&output));
}

#[test]
fn a_dash_is_standard_input_and_output() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    scene(at);
    let table = cfs(at).args(["room", "a.toml"]).output().unwrap().stdout;
    let mut child = cfs(at)
        .args(["room", "-", "--out", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(&std::fs::read(at.join("a.toml")).unwrap()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", said(&output));
    assert_eq!(output.stdout, table);
    assert!(!at.join("-").exists());
}

#[test]
fn a_state_that_is_refused_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let blind = "name = \"blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 1e-320\nangles = [0, 45]\n\
                 upper = { reflectance = 0.5 }\nlower = { reflectance = 0.3 }\n";
    std::fs::write(at.join("b.system.toml"), blind).unwrap();
    for out in ["o.cfsp", "o.xml"] {
        let output = cfs(at).args(["goniophotometer", "b.system.toml", "--out", out]).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", said(&output));
        let there: Vec<_> = std::fs::read_dir(at).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(there, ["b.system.toml"], "{out}");
    }
}
