//! Windows with the real study, operated by commands and looked at between frames.

use cfs::app::backend::{StudyEngine, memory_shelf};
use cfs::app::command::Command;
use cfs::app::dialogs::NoDialogs;
use cfs::app::error::AppError;
use cfs::app::shelf::{Addition, Query, Shelf};
use cfs::app::state::Settings;
use cfs::app::{App, Services};
use cfs::catalogue::{NewProduct, SourceFile};
use egui_kittest::Harness;
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(300);

pub fn harness(services: Services) -> Harness<'static, App> {
    Harness::builder().with_size([1280.0, 720.0]).with_max_steps(200).build_ui_state(
        |ui, app: &mut App| {
            let ctx = ui.ctx().clone();
            app.logic(&ctx);
            app.draw(ui);
        },
        App::new(services, Settings::default()),
    )
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

/// Steps until no job is left, then a few frames more.
pub fn settle(harness: &mut Harness<'_, App>) {
    let start = Instant::now();
    harness.run_steps(3);
    while harness.state().busy() {
        assert!(start.elapsed() < PATIENCE, "jobs end");
        std::thread::sleep(Duration::from_millis(2));
        harness.step();
    }
    harness.run_steps(3);
}

pub fn apply(harness: &mut Harness<'_, App>, command: Command) {
    harness.state_mut().apply(command);
}

/// Coarse: what is tested is how it looks.
pub fn coarsen(harness: &mut Harness<'_, App>) {
    let plane = harness.state_mut().state.document.scene.sensors.plane.as_mut().unwrap();
    (plane.nx, plane.ny) = (6, 10);
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
    coarsen(&mut harness);
    settle(&mut harness);
    harness
}

pub const LONG: &str =
    "Retroreflecting light-guiding venetian blind 80 mm, perforated, white outside and specular inside";

pub fn select(harness: &mut Harness<'_, App>, fits: impl Fn(&cfs::app::shelf::Entry) -> bool) {
    let key = harness.state().state.found.entries.iter().find(|entry| fits(entry)).expect("a product").key.clone();
    apply(harness, Command::Select(key));
    settle(harness);
}
