//! The window's view of error against run time: reached by key and menu, run and stopped, drawn from a made-up ladder.

use crate::common::compares_pictures;
use crate::driven::Idle;
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::display::language::LanguageChoice;
use cfs::app::results::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures};
use cfs::app::shell::error::AppError;
use cfs::app::shell::jobs::Lane;
use cfs::app::state::Sheet;
use cfs::app::views::accuracy as view;
use cfs::compute::estimate::{Cancelled, Progress};
use cfs::study::accuracy::{Accuracy, Errors, Origin, Quantity, Reference, Rung, Series};
use egui::{Key, Theme};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, SnapshotResults};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Errors that fall with the square root of the time (and faster for the first), seconds that rise fourfold.
fn made_up() -> Accuracy {
    let names = [
        ("solid-angle", Quantity::Direct, 2.0),
        ("subdivision", Quantity::Direct, 1.0),
        ("monte-carlo", Quantity::Direct, 0.5),
        ("profile-table", Quantity::Direct, 0.8),
        ("room", Quantity::Total, 1.2),
    ];
    let series = names.into_iter().enumerate().map(|(k, (method, quantity, order))| {
        let rungs = (0..5).map(|effort| {
            let sky = 1e-4 * 4_f64.powi(effort) * (1.0 + k as f64);
            let scale = 0.05 * (sky / 1e-4).powf(-order);
            let errors = (0..20).map(|i| {
                let real = scale * (0.2 + 0.08 * f64::from(i));
                Errors { stated: real * (0.7 + 0.3 * f64::from((7 * i + effort) % 11)), real, open: 0.0 }
            });
            Rung { setting: format!("effort {effort}"), setup: 1e-3, sky, errors: errors.collect(), ..Rung::default() }
        });
        Series { method, quantity, rungs: rungs.collect() }
    });
    let origin = Origin::FinestRun { target: 1e-7, rms: 2e-9, max: 4e-9 };
    let reference = Reference { quantity: Quantity::Direct, origin, stated: 1e-7 };
    let series = series.collect();
    Accuracy { references: vec![reference], series, sensors: (20, 20), threads: 1, leaving_out: Vec::new() }
}

/// Gives the made-up ladder, at once or when withdrawn.
#[derive(Default)]
struct Scripted {
    slow: AtomicBool,
    withdrawn: AtomicBool,
}

impl Engine for Scripted {
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        Idle.room(question, progress)
    }

    fn surfaces(&self, question: &Question, progress: &dyn Progress) -> Result<SurfaceFigures, AppError> {
        Idle.surfaces(question, progress)
    }

    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError> {
        Idle.lid(question, progress)
    }

    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, AppError> {
        assert_eq!(question.scene.aperture.len(), 1);
        progress.advance("accuracy", 3, 12);
        let start = Instant::now();
        while self.slow.load(Ordering::Relaxed) && start.elapsed() < Duration::from_secs(20) {
            if progress.cancelled() {
                self.withdrawn.store(true, Ordering::Relaxed);
                return Err(AppError::Study(Cancelled.into()));
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(made_up())
    }

    fn luminaire(&self, _lid: &LidFigures, _path: &Path) -> Result<Vec<u8>, AppError> {
        Err(AppError::NoLid)
    }
}

fn window() -> (Harness<'static, App>, Arc<Scripted>) {
    let engine = Arc::new(Scripted::default());
    let app = App::for_test(engine.clone());
    let mut harness =
        Harness::builder().with_size([1280.0, 720.0]).with_theme(Theme::Dark).with_max_steps(200).build_ui_state(
            |ui, app: &mut App| {
                let ctx = ui.ctx().clone();
                app.logic(&ctx);
                app.draw(ui);
            },
            app,
        );
    wait(&mut harness, |app| !app.busy());
    (harness, engine)
}

/// Steps until the window is as wanted, then a few frames more.
fn wait(harness: &mut Harness<'_, App>, wanted: impl Fn(&App) -> bool) {
    let start = Instant::now();
    harness.run_steps(2);
    while !wanted(harness.state()) && start.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(2));
        harness.step();
    }
    assert!(wanted(harness.state()));
    harness.run_steps(3);
}

#[test]
fn a_key_opens_the_sheet_and_a_button_measures() {
    let (mut harness, _) = window();
    harness.key_press(Key::A);
    harness.run_steps(3);
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Accuracy));
    assert!(harness.query_by_label_contains("Error of each method against").is_some());
    harness.get_by_label("Compute series").click();
    wait(&mut harness, |app| app.shell.results.accuracy.value.is_some());
    let picture = harness.get_by_label("Error against run time");
    assert!(picture.value().unwrap().contains("keeps its stated uncertainty at"));
    assert_eq!(harness.query_all_by_label("outdated").count(), 0);
    // It holds in any language.
    for language in [LanguageChoice::German, LanguageChoice::English] {
        harness.state_mut().apply(Command::Language(language));
        wait(&mut harness, |app| !app.busy());
        assert!(!harness.state().shell.results.accuracy.stale);
    }
    // Another scene: the picture stays, and says whose it is.
    harness.state_mut().apply(Command::Hour(1));
    wait(&mut harness, |app| !app.busy());
    assert!(harness.query_all_by_label("outdated").count() > 0);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(harness.state().shell.state.sheet, None);
}

#[test]
fn a_ladder_can_be_stopped() {
    let (mut harness, engine) = window();
    engine.slow.store(true, Ordering::Relaxed);
    harness.state_mut().apply(Command::MeasureAccuracy);
    wait(&mut harness, |app| app.busy());
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Accuracy));
    harness.get_by_label("Stop").click();
    wait(&mut harness, |app| !app.busy());
    let start = Instant::now();
    while !engine.withdrawn.load(Ordering::Relaxed) && start.elapsed() < Duration::from_secs(10) {
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(engine.withdrawn.load(Ordering::Relaxed) && harness.state().shell.results.accuracy.value.is_none());
    assert!(!Lane::Accuracy.word().english().is_empty());
}

fn drawn(size: [f32; 2], theme: Theme) -> Harness<'static, view::State> {
    let accuracy = made_up();
    Harness::builder().with_size(size).with_theme(theme).build_ui_state(
        move |ui, state: &mut view::State| {
            ui.painter().rect_filled(ui.max_rect(), 0, ui.visuals().panel_fill);
            let input = view::Input {
                accuracy: Some(&accuracy),
                revision: 1,
                stale: false,
                error: None,
                running: Some(0.25),
                outside: &[],
            };
            view::show(ui, &input, state);
        },
        view::State::default(),
    )
}

#[test]
fn the_picture_fits_narrow_and_wide() {
    for width in [300.0, 440.0, 800.0] {
        let mut harness = drawn([width, 2.2 * width], Theme::Light);
        harness.run_steps(3);
        let rect = harness.get_by_label("Error against run time").rect();
        assert!(rect.width() > 0.8 * width && rect.right() <= width, "{width}: {rect:?}");
    }
}

/// Compared where a software Vulkan driver was asked for: other drivers draw other pixels.
#[test]
fn pictures_of_the_ladder() {
    if !compares_pictures() {
        return;
    }
    let mut results = SnapshotResults::new();
    for (theme, name) in [(Theme::Light, "accuracy_light"), (Theme::Dark, "accuracy_dark")] {
        let mut harness = drawn([440.0, 830.0], theme);
        harness.run_steps(3);
        results.add(harness.try_snapshot(name));
    }
    results.unwrap();
}
