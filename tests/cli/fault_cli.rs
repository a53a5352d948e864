//! A fault of the program in a command, as scripts see it. No input is known that leads to one: this program starts itself
//! again and panics there.

use cfs::cli::{guarded, report_error, status};
use cfs::study::fault;
use cfs::study::files;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The folder in which the second run panics.
const FOLDER: &str = "CFS_TEST_FAULT_FOLDER";
const NAME: &str = "fault_cli::a_fault_in_a_command_is_one_sentence_with_a_report_and_a_status_of_its_own";

const SCENE: &str = "# a scene that somebody wrote\n[room]\nwidth = 4.0\n";

/// What the second run does: reads a scene, and panics in a pool.
fn panicking(folder: &Path) -> ! {
    fault::watch(false);
    let reports = folder.join("reports");
    let result = guarded(Some(&reports), || {
        files::read(&folder.join("scene.toml"))?;
        (0..64_u32).into_par_iter().for_each(|number| assert!(number != 41, "sensor {number}\nis at fault"));
        Ok(())
    });
    let error = result.expect_err("it panics");
    report_error(&error);
    std::process::exit(i32::from(status(&error)));
}

fn again(folder: &Path) -> Output {
    let own = std::env::current_exe().unwrap();
    Command::new(own).args(["--exact", NAME, "--nocapture"]).env(FOLDER, folder).output().unwrap()
}

fn reports(folder: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
}

#[test]
fn a_fault_in_a_command_is_one_sentence_with_a_report_and_a_status_of_its_own() {
    if let Some(folder) = std::env::var_os(FOLDER) {
        panicking(Path::new(&folder));
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let output = again(folder.path());
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), said.lines().count()), (Some(101), 1), "{said}");
    let [report] = &*reports(&folder.path().join("reports")) else { panic!("one report: {said}") };
    for part in ["cfs: internal error at ", "fault_cli.rs:", "sensor 41", &report.display().to_string()] {
        assert!(said.contains(part), "{part} is not in {said}");
    }
    let text = std::fs::read_to_string(report).unwrap();
    for part in [env!("CARGO_PKG_VERSION"), "--exact", "sensor 41\nis at fault", "fault_cli.rs:", "panicking", SCENE] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    assert!(!text.contains(&format!("{}/scene.toml", folder.path().display())), "{text}");
}

#[test]
fn a_fault_whose_report_cannot_be_written_is_told_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let taken = folder.path().join("taken");
    std::fs::write(&taken, "").unwrap();
    for (place, words) in [(Some(&*taken), "the report could not be written"), (None, "no report is written")] {
        let error = guarded(place, || panic!("eleven")).unwrap_err();
        let said = error.to_string();
        assert!(said.contains("eleven") && said.contains(words), "{said}");
        assert_eq!(status(&error), 101);
    }
}

#[test]
fn what_is_no_fault_passes() {
    assert!(guarded(None, || Ok(())).is_ok());
    let error = guarded(None, || Err(anyhow::anyhow!("no such file"))).unwrap_err();
    assert_eq!((error.to_string().as_str(), status(&error)), ("no such file", 2));
}
