//! Can everything be read, and does nothing stand in the way of something else, at all sizes that the window takes?
//!
//! Frames are run without a renderer and their shapes are looked through; see [`inspect`].

pub mod inspect;

use crate::driven::{LONG, apply, harness, select, services, settle, window};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::compare::view::{Act, Look};
use cfs::app::display::language::LanguageChoice;
use cfs::app::display::theme::ThemeChoice;
use cfs::app::export::choices::{Choices, What};
use cfs::app::results::backend::ideals_shelf;
use cfs::app::scene::room_look::RoomView;
use cfs::app::shell::error::AppError;
use cfs::app::state::{PathUse, Sheet};
use cfs::app::tiles::TILES;
use cfs::app::tiles::arrange::{Arrange, Preset};
use cfs::app::tour::step::TourAct;
use cfs::formats::encoding::utf8;
use egui_kittest::Harness;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::mpsc::channel;

/// Sizes of the window \[points\] and pixels a point: the least, the first and a large one, and two fine screens.
const SIZES: [([f32; 2], f32); 5] = [
    ([960.0, 600.0], 1.0),
    ([1280.0, 720.0], 1.0),
    ([1920.0, 1080.0], 1.0),
    ([960.0, 600.0], 2.0),
    ([1280.0, 720.0], 2.0),
];

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

    /// Each tile alone. A window that is still opening has jobs that wait for the test.
    fn each_tile(&mut self, harness: &mut Harness<'_, App>, what: &str) {
        for entry in TILES {
            harness.state_mut().apply(Command::Maximise(Some(entry.tile)));
            for size in [SIZES[0], SIZES[2]] {
                self.look(harness, &format!("{what}, {} alone", entry.tile.title), size);
            }
        }
        harness.state_mut().apply(Command::Maximise(None));
    }

    /// Each sheet, and the palette.
    fn sheets(&mut self, harness: &mut Harness<'_, App>) {
        let sheets = [
            Sheet::Import,
            Sheet::Findings,
            Sheet::Keys,
            Sheet::About,
            Sheet::Accuracy,
            Sheet::Goniophotometer,
            Sheet::Path(PathUse::Open),
            Sheet::Path(PathUse::ExportLid),
            Sheet::Path(PathUse::ExportTile(TILES[0].tile)),
        ];
        for sheet in sheets {
            apply(harness, Command::Sheet(Some(sheet)));
            for size in [SIZES[0], SIZES[1]] {
                self.look(harness, &format!("{sheet:?}"), size);
            }
            apply(harness, Command::Sheet(None));
        }
        apply(harness, Command::Sheet(Some(Sheet::Export)));
        for what in What::ALL {
            apply(harness, Command::ExportChoices(Box::new(Choices { what, ..Choices::default() })));
            for size in [SIZES[0], SIZES[1]] {
                self.look(harness, &format!("hand on, {what:?}"), size);
            }
        }
        apply(harness, Command::Sheet(None));
        apply(harness, Command::Palette);
        self.look(harness, "palette", SIZES[0]);
        apply(harness, Command::Palette);
    }

    fn none_left(self) {
        let lines: Vec<String> = self.0.iter().map(|(problem, place)| format!("{problem}\n      {place}")).collect();
        assert!(lines.is_empty(), "{} problems\n{}", lines.len(), lines.join("\n"));
    }
}

/// Can the window as it is be read at all sizes?
pub fn can_be_read(harness: &mut Harness<'_, App>, what: &str) {
    let mut problems = Problems::default();
    problems.bench(harness, what);
    problems.none_left();
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
fn layouts_and_the_room_from_all_sides_can_be_read() {
    let mut harness = window();
    let mut problems = Problems::default();
    for ready in Preset::ALL {
        apply(&mut harness, Command::Arrange(Arrange::Preset(ready)));
        problems.bench(&mut harness, ready.word().get());
    }
    apply(&mut harness, Command::Arrange(Arrange::Preset(Preset::All)));
    let room = TILES.iter().find(|entry| entry.tile.title == "Room").unwrap().tile;
    for view in RoomView::ALL {
        apply(&mut harness, Command::RoomView(view));
        problems.bench(&mut harness, view.word().get());
        apply(&mut harness, Command::Maximise(Some(room)));
        problems.look(&mut harness, view.word().get(), SIZES[0]);
        apply(&mut harness, Command::Maximise(None));
    }
    problems.none_left();
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
        problems.look(&mut harness, "panels folded", SIZES[0]);
    }
    for folded in [Command::ToggleCatalogue, Command::ToggleScene] {
        apply(&mut harness, folded);
    }
    problems.sheets(&mut harness);
    apply(&mut harness, Command::Theme(ThemeChoice::Light));
    problems.bench(&mut harness, "noon, light");
    problems.none_left();
}

#[test]
fn the_window_can_be_read_in_german() {
    let mut harness = window();
    let mut problems = Problems::default();
    apply(&mut harness, Command::Language(LanguageChoice::German));
    problems.bench(&mut harness, "German");
    problems.each_tile(&mut harness, "German");
    problems.sheets(&mut harness);
    apply(&mut harness, Command::Tour(TourAct::Start));
    problems.look(&mut harness, "German, tour", SIZES[0]);
    problems.none_left();
}

#[test]
fn a_night_a_sun_behind_the_facade_and_other_products_can_be_read() {
    let mut harness = window();
    let mut problems = Problems::default();
    apply(&mut harness, Command::Hour(11));
    problems.bench(&mut harness, "night");
    problems.each_tile(&mut harness, "night");
    apply(&mut harness, Command::Hour(-11));
    let mut scene = harness.state().shell.state.document.scene.clone();
    scene.site.azimuth = 0.0;
    apply(&mut harness, Command::Scene(Box::new(scene.clone())));
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
fn a_comparison_can_be_read_in_all_its_looks() {
    let mut harness = window();
    let mut problems = Problems::default();
    apply(&mut harness, Command::Compare(Act::Add));
    select(&mut harness, |entry| entry.name == LONG);
    for act in [Act::Add, Act::AddMoment] {
        apply(&mut harness, Command::Compare(act));
    }
    problems.bench(&mut harness, "a tray");
    for look in Look::ALL {
        apply(&mut harness, Command::Compare(Act::Look(look)));
        for tile in TILES {
            apply(&mut harness, Command::Compare(Act::Tile(tile.tile.title)));
            for size in [SIZES[0], SIZES[2]] {
                problems.look(&mut harness, &format!("{}: {}", look.words(), tile.tile.title), size);
            }
        }
    }
    apply(&mut harness, Command::Compare(Act::Swap));
    problems.look(&mut harness, "swapped", SIZES[0]);
    problems.none_left();
}

#[test]
fn errors_can_be_read() {
    let mut problems = Problems::default();
    let mut harness = window();
    let mut scene = harness.state().shell.state.document.scene.clone();
    scene.aperture[0].size = [40.0, 1.5];
    apply(&mut harness, Command::Scene(Box::new(scene)));
    let told = harness.state().shell.results.room.error.clone().expect("a window wider than its wall");
    assert!(!told.is_empty());
    problems.bench(&mut harness, "a window wider than its wall");
    let mut failed = crate::driven::harness(services(|| {
        Err(AppError::NotText(utf8(b"text \xfc").unwrap_err(), "a catalogue").about("catalogue.sqlite"))
    }));
    settle(&mut failed);
    problems.bench(&mut failed, "no catalogue");
    problems.none_left();
}
