//! Faults of the program in the window: what is open is saved, a report is left, and it is told.

use crate::driven::{Idle, apply, frames, settle};
use crate::files_view::{killed, said};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::display::language::LanguageChoice;
use cfs::app::results::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures};
use cfs::app::shell::error::AppError;
use cfs::app::title::title;
use cfs::compute::estimate::Progress;
use cfs::study::accuracy::Accuracy;
use cfs::study::fault;
use cfs::study::scene_file::SceneFile;
use egui::OutputCommand;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// At fault, in a pool, where the room's floor reflects this; else idle.
struct Faulty;

const FAULT: f64 = 0.13;

impl Engine for Faulty {
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        if question.scene.room.reflectance.floor == FAULT {
            progress.advance("interreflection", 1, 3);
            (0..64_u32).into_par_iter().for_each(|patch| assert!(patch != 41, "patch {patch} is at fault on purpose"));
        }
        Idle.room(question, progress)
    }

    fn surfaces(&self, question: &Question, progress: &dyn Progress) -> Result<SurfaceFigures, AppError> {
        Idle.surfaces(question, progress)
    }

    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError> {
        Idle.lid(question, progress)
    }

    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, AppError> {
        Idle.accuracy(question, progress)
    }

    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, AppError> {
        Idle.luminaire(lid, path)
    }
}

/// A window that keeps its session and its reports in folders.
fn window_in(sessions: &Path, reports: &Path) -> Harness<'static, App> {
    fault::watch(true);
    let mut app = App::for_test(Arc::new(Faulty));
    app.report_faults(Some(reports));
    app.begin_session(Some(sessions), true);
    let mut harness = frames(app, [1280.0, 720.0]);
    settle(&mut harness);
    harness
}

fn texts(folder: &Path, ending: &str) -> Vec<(PathBuf, String)> {
    let paths = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut list: Vec<PathBuf> = paths.filter(|path| path.extension().is_some_and(|own| own == ending)).collect();
    list.sort();
    list.into_iter().map(|path| (path.clone(), std::fs::read_to_string(&path).unwrap())).collect()
}

/// The floor's reflectance in the session on disk.
fn kept_floor(sessions: &Path) -> f64 {
    let [(_, text)] = &*texts(sessions, "json") else { panic!("one session") };
    let kept: serde_json::Value = serde_json::from_str(text).unwrap();
    SceneFile::parse(kept["scene"].as_str().unwrap()).unwrap().room.reflectance.floor
}

#[test]
fn a_fault_in_a_job_saves_what_is_open_leaves_a_report_and_is_told_with_a_button() {
    let (sessions, reports) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let mut harness = window_in(sessions.path(), reports.path());
    apply(&mut harness, Command::Hour(2));
    harness.state_mut().shell.state.document.scene.room.reflectance.floor = FAULT;
    // Until the fault is told; then what is open is on disk already.
    crate::driven::step_until(&mut harness, "the fault", |app| app.shell.results.room.error.is_some());
    assert_eq!(kept_floor(sessions.path()), FAULT);
    let [(path, text)] = &*texts(reports.path(), "txt") else { panic!("one report") };
    let scene = toml::to_string(&harness.state().shell.state.document.scene).unwrap();
    for part in [
        env!("CARGO_PKG_VERSION"),
        std::env::consts::OS,
        "room, interreflection",
        "patch 41 is at fault on purpose",
        "faults.rs:",
        "Hour(2)",
        // Of the backtrace.
        "room::{closure",
        scene.trim(),
    ] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    let told: Vec<String> = said(&harness).into_iter().filter(|said| said.contains("at fault on purpose")).collect();
    assert!(told.len() == 1 && told[0].contains(&path.display().to_string()), "{told:?}");
    // The same again is no second report, and the window goes on.
    settle(&mut harness);
    harness.state_mut().shell.state.document.scene.room.reflectance.floor = 0.3;
    settle(&mut harness);
    assert!(harness.state().shell.results.room.error.is_none());
    harness.state_mut().shell.state.document.scene.room.reflectance.floor = FAULT;
    settle(&mut harness);
    assert_eq!(texts(reports.path(), "txt").len(), 1);
    harness.get_all_by_label("Copy report").last().expect("a button").click();
    harness.step();
    let copied = harness.output().platform_output.commands.iter().find_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    assert_eq!(copied.as_ref(), Some(text));
}

#[test]
fn a_fault_is_told_in_german() {
    let (sessions, reports) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let mut harness = window_in(sessions.path(), reports.path());
    apply(&mut harness, Command::Language(LanguageChoice::German));
    harness.state_mut().shell.state.document.scene.room.reflectance.floor = FAULT;
    settle(&mut harness);
    let told = said(&harness).pop().unwrap();
    assert!(told.contains("interner Fehler") && told.contains("ein Bericht zum Weitersenden steht in"), "{told}");
    assert!(harness.query_all_by_label("Bericht kopieren").count() > 0);
}

#[test]
fn a_report_that_cannot_be_written_is_told() {
    let (sessions, reports) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let taken = reports.path().join("taken");
    std::fs::write(&taken, "").unwrap();
    let mut harness = window_in(sessions.path(), &taken);
    harness.state_mut().shell.state.document.scene.room.reflectance.floor = FAULT;
    settle(&mut harness);
    let told = said(&harness).pop().unwrap();
    assert!(told.contains("at fault on purpose") && told.contains("the report could not be written"), "{told}");
}

/// A fault on the window's own thread: its message.
fn end(harness: Harness<'static, App>) -> fault::Fault {
    let panic = catch_unwind(AssertUnwindSafe(move || {
        let _window = harness;
        panic!("a fault while drawing");
    }));
    fault::caught(&*panic.unwrap_err())
}

#[test]
fn a_fault_of_the_window_itself_leaves_what_was_open_and_a_report_and_the_next_start_says_so() {
    let (sessions, reports) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let mut harness = window_in(sessions.path(), reports.path());
    apply(&mut harness, Command::Hour(2));
    apply(&mut harness, Command::EditSystem("name = \"half typed".to_owned()));
    let before = title(&harness.state().shell.state);
    let scene = toml::to_string(&harness.state().shell.state.document.scene).unwrap();
    let fault = end(harness);
    let [(path, text)] = &*texts(reports.path(), "txt") else { panic!("one report") };
    assert_eq!(fault.report.as_ref(), Some(path), "who catches it tells where it is");
    for part in ["a fault while drawing", "faults.rs:", "Hour(2)", "half typed", scene.trim()] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    let mut next = window_in(sessions.path(), reports.path());
    assert_eq!(title(&next.state().shell.state), before);
    assert_eq!(next.state().goniophotometer.text(), "name = \"half typed");
    let told = said(&next);
    assert!(told.len() == 1 && told[0].contains(&path.display().to_string()), "{told:?}");
    assert!(next.query_all_by_label("Copy report").count() > 0);
    // Closed in order, the next one says nothing.
    next.state_mut().close();
    drop(next);
    assert!(said(&window_in(sessions.path(), reports.path())).is_empty());
}

#[test]
fn a_session_that_ends_the_program_again_and_again_is_set_aside() {
    let (sessions, reports) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let mut harness = window_in(sessions.path(), reports.path());
    apply(&mut harness, Command::Hour(2));
    let own = title(&harness.state().shell.state);
    end(harness);
    let harness = window_in(sessions.path(), reports.path());
    assert_eq!(title(&harness.state().shell.state), own);
    end(harness);
    let third = window_in(sessions.path(), reports.path());
    assert_ne!(title(&third.state().shell.state), own);
    let told = said(&third);
    assert!(told.len() == 1 && told[0].contains("was moved to") && told[0].contains(".txt"), "{told:?}");
    let [(_, aside)] = &*texts(sessions.path(), "aside") else { panic!("it is there still") };
    assert!(aside.contains("14:00"), "{aside}");
    // Told once.
    let left = killed(sessions.path());
    drop(third);
    assert!(!said(&window_in(left.path(), reports.path())).iter().any(|text| text.contains("was moved to")));
}
