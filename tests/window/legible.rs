//! Can everything be read, and does nothing stand in the way of something else, at all sizes that the window takes?
//!
//! Frames are run without a renderer and their shapes are looked through; see [`inspect`].

mod inspect;

use cfs::app::backend::{StudyEngine, ideals_shelf, memory_shelf};
use cfs::app::command::Command;
use cfs::app::dialogs::NoDialogs;
use cfs::app::error::AppError;
use cfs::app::shelf::{Addition, Shelf};
use cfs::app::state::{PathUse, Settings, Sheet};
use cfs::app::theme::ThemeChoice;
use cfs::app::tiles::TILES;
use cfs::app::{App, Services};
use cfs::catalogue::{NewProduct, SourceFile};
use egui_kittest::Harness;
use std::collections::BTreeMap;
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Sizes of the window \[points\] and pixels a point: the least, the first and a large one, and two fine screens.
const SIZES: [([f32; 2], f32); 5] = [
    ([960.0, 600.0], 1.0),
    ([1280.0, 720.0], 1.0),
    ([1920.0, 1080.0], 1.0),
    ([960.0, 600.0], 2.0),
    ([1280.0, 720.0], 2.0),
];

const PATIENCE: Duration = Duration::from_secs(120);

fn harness(services: Services) -> Harness<'static, App> {
    Harness::builder().with_size([1280.0, 720.0]).with_max_steps(200).build_ui_state(
        |ui, app: &mut App| {
            let ctx = ui.ctx().clone();
            app.logic(&ctx);
            app.draw(ui);
        },
        App::new(services, Settings::default()),
    )
}

fn services(open: impl Fn() -> Result<Arc<dyn Shelf>, AppError> + Send + Sync + 'static) -> Services {
    Services {
        open_catalogue: Arc::new(open),
        read: SourceFile::read,
        dialogs: Arc::new(NoDialogs),
        engine: Arc::new(StudyEngine::default()),
    }
}

/// Steps until no job is left, then a few frames more.
fn settle(harness: &mut Harness<'_, App>) {
    let start = Instant::now();
    harness.run_steps(3);
    while harness.state().busy() {
        assert!(start.elapsed() < PATIENCE, "jobs end");
        std::thread::sleep(Duration::from_millis(2));
        harness.step();
    }
    harness.run_steps(3);
}

fn apply(harness: &mut Harness<'_, App>, command: Command) {
    harness.state_mut().apply(command);
}

/// Coarse: what is tested is how it looks.
fn coarsen(harness: &mut Harness<'_, App>) {
    let plane = harness.state_mut().state.document.scene.sensors.plane.as_mut().unwrap();
    (plane.nx, plane.ny) = (6, 10);
}

/// Texts that may be cut, since all of them is in a tip: names of products and of what belongs to them in lists, the
/// second titles of tiles, and the selection in the menu bar.
const MAY_BE_CUT: [&str; 0] = [];

/// What is wrong, and where it was first seen.
#[derive(Default)]
struct Problems(BTreeMap<String, String>);

impl Problems {
    /// Looks at the window at one size.
    fn look(&mut self, harness: &mut Harness<'_, App>, what: &str, (size, scale): ([f32; 2], f32)) {
        harness.set_size(size.into());
        harness.set_pixels_per_point(scale);
        harness.run_steps(3);
        for problem in inspect::problems(harness) {
            if MAY_BE_CUT.iter().any(|text| problem.starts_with("cut with …") && problem.contains(text)) {
                continue;
            }
            let place = format!("{what} at {} × {}, scale {scale}", size[0], size[1]);
            self.0.entry(problem).or_insert(place);
        }
    }

    /// All tiles together.
    fn bench(&mut self, harness: &mut Harness<'_, App>, what: &str) {
        for size in SIZES {
            self.look(harness, what, size);
        }
    }

    /// Each tile alone.
    fn each_tile(&mut self, harness: &mut Harness<'_, App>, what: &str) {
        for entry in TILES {
            apply(harness, Command::Maximise(Some(entry.tile)));
            for size in [SIZES[0], SIZES[2]] {
                self.look(harness, &format!("{what}, {} alone", entry.tile.title), size);
            }
        }
        apply(harness, Command::Maximise(None));
    }

    fn none_left(self) {
        let lines: Vec<String> = self.0.iter().map(|(problem, place)| format!("{problem}\n      {place}")).collect();
        assert!(lines.is_empty(), "{} problems\n{}", lines.len(), lines.join("\n"));
    }
}

/// The real study on a catalogue in memory, with a product whose names are as long as makers' names are.
fn window() -> Harness<'static, App> {
    let mut harness = harness(services(|| {
        let shelf = memory_shelf()?;
        let found = shelf.search(&Default::default())?;
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
    }));
    coarsen(&mut harness);
    settle(&mut harness);
    harness
}

const LONG: &str = "Retroreflecting light-guiding venetian blind 80 mm, perforated, white outside and specular inside";

fn select(harness: &mut Harness<'_, App>, fits: impl Fn(&cfs::app::shelf::Entry) -> bool) {
    let key = harness.state().state.found.entries.iter().find(|entry| fits(entry)).expect("a product").key.clone();
    apply(harness, Command::Select(key));
    settle(harness);
}

#[test]
fn a_window_that_opens_says_so_everywhere_and_can_be_read() {
    let (release, wait) = channel::<()>();
    let wait = Mutex::new(wait);
    let mut harness = harness(services(move || {
        // Waits until the test has looked; a test that failed hangs up.
        let _ = wait.lock().unwrap().recv();
        ideals_shelf()
    }));
    let mut problems = Problems::default();
    problems.bench(&mut harness, "opening");
    problems.each_tile(&mut harness, "opening");
    problems.none_left();
    drop(release);
}

#[test]
fn a_blind_at_noon_can_be_read_at_all_sizes_in_all_tiles_and_sheets() {
    let mut harness = window();
    let mut problems = Problems::default();
    problems.bench(&mut harness, "noon");
    problems.each_tile(&mut harness, "noon");
    for folded in [Command::ToggleCatalogue, Command::ToggleScene] {
        apply(&mut harness, folded);
        problems.bench(&mut harness, "panels folded");
    }
    for folded in [Command::ToggleCatalogue, Command::ToggleScene] {
        apply(&mut harness, folded);
    }
    let sheets = [
        Sheet::Import,
        Sheet::Findings,
        Sheet::Keys,
        Sheet::Accuracy,
        Sheet::Goniophotometer,
        Sheet::Path(PathUse::Open),
        Sheet::Path(PathUse::ExportLid),
        Sheet::Path(PathUse::ExportTile(TILES[0].tile)),
    ];
    for sheet in sheets {
        apply(&mut harness, Command::Sheet(Some(sheet)));
        for size in [SIZES[0], SIZES[1]] {
            problems.look(&mut harness, &format!("{sheet:?}"), size);
        }
        apply(&mut harness, Command::Sheet(None));
    }
    apply(&mut harness, Command::Palette);
    problems.look(&mut harness, "palette", SIZES[0]);
    apply(&mut harness, Command::Palette);
    apply(&mut harness, Command::Theme(ThemeChoice::Light));
    problems.bench(&mut harness, "noon, light");
    problems.none_left();
}

#[test]
fn a_night_a_sun_behind_the_facade_and_other_products_can_be_read() {
    let mut harness = window();
    let mut problems = Problems::default();
    apply(&mut harness, Command::Hour(11));
    settle(&mut harness);
    problems.bench(&mut harness, "night");
    problems.each_tile(&mut harness, "night");
    apply(&mut harness, Command::Hour(-11));
    let mut scene = harness.state().state.document.scene.clone();
    scene.site.azimuth = 0.0;
    apply(&mut harness, Command::Scene(Box::new(scene.clone())));
    settle(&mut harness);
    problems.bench(&mut harness, "sun behind the façade");
    scene.site.azimuth = 180.0;
    apply(&mut harness, Command::Scene(Box::new(scene)));
    select(&mut harness, |entry| entry.states.len() == 1);
    problems.bench(&mut harness, "a product that does not move");
    problems.each_tile(&mut harness, "a product that does not move");
    select(&mut harness, |entry| entry.name == LONG);
    problems.bench(&mut harness, "long names");
    problems.none_left();
}

#[test]
fn errors_can_be_read() {
    let mut problems = Problems::default();
    let mut harness = window();
    let mut scene = harness.state().state.document.scene.clone();
    scene.aperture[0].size = [40.0, 1.5];
    apply(&mut harness, Command::Scene(Box::new(scene)));
    settle(&mut harness);
    let told = harness.state().results.room.error.clone().expect("a window wider than its wall");
    assert!(!told.is_empty());
    problems.bench(&mut harness, "a window wider than its wall");
    let mut failed = self::harness(services(|| Err(AppError::NotText(7, "a catalogue").about("catalogue.sqlite"))));
    settle(&mut failed);
    problems.bench(&mut failed, "no catalogue");
    problems.none_left();
}
