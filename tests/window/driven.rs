//! Windows without a display, operated by commands and looked at between frames.

use cfs::app::catalogue::shelf::{Addition, Query, Shelf};
use cfs::app::command::Command;
use cfs::app::results::backend::{StudyEngine, memory_shelf};
use cfs::app::results::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures};
use cfs::app::shell::dialogs::NoDialogs;
use cfs::app::shell::error::AppError;
use cfs::app::state::Settings;
use cfs::app::{App, Services};
use cfs::catalogue::{NewProduct, SourceFile};
use cfs::compute::estimate::{Estimate, Progress};
use cfs::study::accuracy::Accuracy;
use egui::Theme;
use egui_kittest::Harness;
use std::path::Path;
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(300);

/// A window of an app, dark.
pub fn frames(app: App, size: [f32; 2]) -> Harness<'static, App> {
    frames_in(Theme::Dark, app, size)
}

/// A window of an app.
pub fn frames_in(theme: Theme, app: App, size: [f32; 2]) -> Harness<'static, App> {
    Harness::builder().with_size(size).with_theme(theme).with_max_steps(200).build_ui_state(
        |ui, app: &mut App| {
            let ctx = ui.ctx().clone();
            app.logic(&ctx);
            app.draw(ui);
        },
        app,
    )
}

/// A window of services, as at a first start.
pub fn harness(services: Services) -> Harness<'static, App> {
    frames(App::new(services, Settings::default()), [1280.0, 720.0])
}

/// Computes nothing: every room has one sensor, of the same illuminance.
pub struct Idle;

impl Engine for Idle {
    fn room(&self, _question: &Question, _progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        let estimate = vec![Estimate::new(500.0, 2.0)];
        Ok(RoomFigures {
            positions: vec![[2.0, 3.0, 0.85]],
            direct: estimate.clone(),
            interreflected: estimate,
            grid: Some([1, 1]),
            seconds: 0.001,
            ..RoomFigures::default()
        })
    }

    fn surfaces(&self, _question: &Question, _progress: &dyn Progress) -> Result<SurfaceFigures, AppError> {
        Err(AppError::NoAperture)
    }

    fn lid(&self, _question: &Question, _progress: &dyn Progress) -> Result<LidFigures, AppError> {
        Err(AppError::NoLid)
    }

    fn accuracy(&self, _question: &Question, _progress: &dyn Progress) -> Result<Accuracy, AppError> {
        Err(AppError::NoAperture)
    }

    fn luminaire(&self, _lid: &LidFigures, _path: &Path) -> Result<Vec<u8>, AppError> {
        Err(AppError::NoLid)
    }
}

/// What was computed for one window is known to the next.
static ENGINE: LazyLock<Arc<StudyEngine>> = LazyLock::new(Arc::default);

pub fn services(open: impl Fn() -> Result<Arc<dyn Shelf>, AppError> + Send + Sync + 'static) -> Services {
    Services {
        open_catalogue: Arc::new(open),
        read: SourceFile::read,
        dialogs: Arc::new(NoDialogs),
        engine: ENGINE.clone(),
    }
}

/// Steps until something holds.
pub fn step_until(harness: &mut Harness<'_, App>, what: &str, holds: impl Fn(&App) -> bool) {
    let start = Instant::now();
    while !holds(harness.state()) {
        assert!(start.elapsed() < PATIENCE, "{what}: {:?}", harness.state().shell.state.dataset.error);
        std::thread::sleep(Duration::from_millis(2));
        harness.step();
    }
}

/// Steps until no job is left, then a few frames more, in which nothing is asked again.
pub fn settle(harness: &mut Harness<'_, App>) {
    harness.run_steps(3);
    step_until(harness, "jobs end", |app| !app.busy());
    harness.run_steps(3);
    assert!(!harness.state().busy(), "nothing is asked again and again");
}

/// Does what a command says, and waits until it is done.
pub fn apply(harness: &mut Harness<'_, App>, command: Command) {
    harness.state_mut().apply(command);
    settle(harness);
}

/// Few sensors: what is tested is not how finely the room is computed.
pub fn coarsen(harness: &mut Harness<'_, App>, sensors: [usize; 2]) {
    let plane = harness.state_mut().shell.state.document.scene.sensors.plane.as_mut().unwrap();
    [plane.nx, plane.ny] = sensors;
}

/// A catalogue in memory, with a product whose names are as long as makers' names are.
fn shelf() -> Result<Arc<dyn Shelf>, AppError> {
    let shelf = memory_shelf()?;
    let found = shelf.search(&Query::default())?;
    let moving = found.entries.iter().find(|entry| entry.states.len() > 2).expect("a blind is built in");
    let datasets = moving.states[..3].iter().zip(["fully retracted, upper part 20°", "cut-off 35°", "closed"]);
    let datasets: Result<Vec<_>, AppError> = datasets
        .map(|(state, name)| {
            let mut dataset = (*shelf.load(&moving.key, Some(state))?).clone();
            dataset.state = name.to_owned();
            Ok(Arc::new(dataset))
        })
        .collect();
    shelf.add(&Addition {
        datasets: datasets?,
        product: NewProduct {
            name: LONG.to_owned(),
            manufacturer: "Gesellschaft für Tageslichttechnik und Sonnenschutz mbH & Co. KG".to_owned(),
            kind: "venetian blind between panes".to_owned(),
            ..NewProduct::default()
        },
    })?;
    Ok(shelf)
}

/// The window on that catalogue, which all tests of a program share: none of them changes it.
pub fn window() -> Harness<'static, App> {
    static SHELF: LazyLock<Arc<dyn Shelf>> = LazyLock::new(|| shelf().expect("a catalogue in memory"));
    let mut harness = harness(services(|| Ok(SHELF.clone())));
    coarsen(&mut harness, [6, 10]);
    settle(&mut harness);
    harness
}

pub const LONG: &str =
    "Retroreflecting light-guiding venetian blind 80 mm, perforated, white outside and specular inside";

pub fn select(harness: &mut Harness<'_, App>, fits: impl Fn(&cfs::app::catalogue::shelf::Entry) -> bool) {
    let key =
        harness.state().shell.state.found.entries.iter().find(|entry| fits(entry)).expect("a product").key.clone();
    apply(harness, Command::Select(key));
}
