//! The tiles where one wants them: docked, as tabs, by keys, from one start to the next; what is hidden computes nothing.

use crate::driven::{Idle, apply, frames, settle, window};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::results::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures};
use cfs::app::session::{Kept, Snapshot};
use cfs::app::shell::error::AppError;
use cfs::app::tiles::TILES;
use cfs::app::tiles::arrange::{Arrange, Preset, Way};
use cfs::compute::estimate::Progress;
use cfs::study::accuracy::Accuracy;
use egui::accesskit::Role;
use egui::{Key, Modifiers, OutputCommand, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn arrange(harness: &mut Harness<'_, App>, what: Arrange) {
    apply(harness, Command::Arrange(what));
}

/// Where a tile's head is, while it is in sight.
fn head(harness: &Harness<'_, App>, title: &str) -> Option<Rect> {
    harness.query_by_label(&format!("Tile {title}")).map(|node| node.rect())
}

fn in_sight(harness: &Harness<'_, App>) -> Vec<&'static str> {
    let shown = TILES.iter().map(|entry| entry.tile).filter(|tile| head(harness, tile.name.english()).is_some());
    shown.map(|tile| tile.title).collect()
}

fn idle() -> Harness<'static, App> {
    let mut harness = frames(App::for_test(Arc::new(Idle)), [1280.0, 720.0]);
    settle(&mut harness);
    harness
}

/// Counts what is asked of it.
#[derive(Default)]
struct Counting {
    rooms: AtomicUsize,
    lids: AtomicUsize,
    surfaces: AtomicUsize,
}

impl Counting {
    fn counts(&self) -> [usize; 3] {
        [&self.rooms, &self.lids, &self.surfaces].map(|count| count.load(Ordering::SeqCst))
    }
}

impl Engine for Counting {
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        self.rooms.fetch_add(1, Ordering::SeqCst);
        Idle.room(question, progress)
    }

    fn surfaces(&self, _question: &Question, _progress: &dyn Progress) -> Result<SurfaceFigures, AppError> {
        self.surfaces.fetch_add(1, Ordering::SeqCst);
        Err(AppError::NoAperture)
    }

    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError> {
        self.lids.fetch_add(1, Ordering::SeqCst);
        Idle.lid(question, progress)
    }

    fn accuracy(&self, _question: &Question, _progress: &dyn Progress) -> Result<Accuracy, AppError> {
        Err(AppError::NoAperture)
    }

    fn luminaire(&self, _lid: &LidFigures, _path: &Path) -> Result<Vec<u8>, AppError> {
        Err(AppError::NoLid)
    }
}

#[test]
fn presets_show_their_tiles_and_reset_shows_all() {
    let mut harness = idle();
    // The year stands behind the control.
    let all: Vec<_> =
        TILES.iter().map(|entry| entry.tile.title).filter(|title| !["Year", "Choose"].contains(title)).collect();
    assert_eq!(in_sight(&harness), all);
    arrange(&mut harness, Arrange::Preset(Preset::Designer));
    assert_eq!(in_sight(&harness), ["Transmittance", "Sky", "Room"]);
    let [room, sky] = ["Room", "Sky"].map(|title| head(&harness, title).unwrap());
    // Under the head of its tabs.
    assert!(room.left() < sky.left() && (room.top() - sky.top()).abs() < 30.0);
    // The others are tabs, by their names.
    harness.get_by_role_and_label(Role::Button, "BTDF").click();
    settle(&mut harness);
    assert_eq!(in_sight(&harness), ["BTDF", "Transmittance", "Sky"]);
    arrange(&mut harness, Arrange::Preset(Preset::All));
    assert_eq!(in_sight(&harness), all);
    assert_eq!(harness.state().shell.state.settings.layout, None);
}

#[test]
fn a_tile_is_dragged_by_its_head_into_another_and_becomes_its_tab() {
    let mut harness = idle();
    let [from, to] = ["Control", "Sky"].map(|title| head(&harness, title).unwrap());
    harness.drag_at(from.center());
    harness.run_steps(2);
    // The middle of the other tile.
    let middle = to.left_top() + vec2(110.0, 160.0);
    for share in [0.3, 0.7, 1.0] {
        harness.hover_at(from.center() + share * (middle - from.center()));
        harness.run_steps(2);
    }
    harness.drop_at(middle);
    settle(&mut harness);
    let seen = in_sight(&harness);
    let tabs = ["Control", "Sky"].iter().filter(|title| seen.contains(title)).count();
    // The year comes out from behind the control.
    assert!(tabs == 1 && seen.len() == 6 && seen.contains(&"Year"), "{seen:?}");
    assert!(harness.state().shell.state.settings.layout.is_some());
}

#[test]
fn keys_walk_the_tiles_move_them_and_turn_their_tabs() {
    let mut harness = idle();
    let places = |h: &Harness<'_, App>| ["BTDF", "Transmittance"].map(|title| head(h, title).unwrap().left());
    let focused = |h: &Harness<'_, App>, title: &str| h.get_by_label(&format!("Tile {title}")).is_focused();
    harness.key_press(Key::F6);
    harness.run_steps(3);
    assert!(focused(&harness, "Transmittance"));
    harness.key_press_modifiers(Modifiers::SHIFT, Key::F6);
    harness.run_steps(3);
    assert!(focused(&harness, "BTDF"));
    // Arrow keys at a head go to the neighbours and leave the clock alone.
    let title = cfs::app::title::title(&harness.state().shell.state);
    harness.key_press(Key::ArrowDown);
    harness.run_steps(3);
    assert!(focused(&harness, "LID"));
    harness.key_press(Key::ArrowUp);
    harness.run_steps(3);
    let before = places(&harness);
    assert!(before[0] < before[1]);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::ArrowRight);
    settle(&mut harness);
    let after = places(&harness);
    assert_eq!([after[1], after[0]], before);
    assert!(focused(&harness, "BTDF"), "the keyboard stays with the tile that moves");
    assert_eq!(cfs::app::title::title(&harness.state().shell.state), title);
    harness.key_press(Key::Enter);
    settle(&mut harness);
    assert_eq!(in_sight(&harness), ["BTDF"]);
    harness.key_press(Key::Enter);
    settle(&mut harness);
    arrange(&mut harness, Arrange::Join);
    assert_eq!(in_sight(&harness).len(), 5);
    let front = in_sight(&harness);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::PageDown);
    settle(&mut harness);
    assert_ne!(in_sight(&harness), front);
    arrange(&mut harness, Arrange::Split);
    assert_eq!(in_sight(&harness).len(), 6);
    let width = |h: &Harness<'_, App>| head(h, "Sky").unwrap().left();
    let before = width(&harness);
    arrange(&mut harness, Arrange::Width(true));
    assert!(width(&harness) != before);
    arrange(&mut harness, Arrange::Move(Way::Up));
}

#[test]
fn the_layout_is_kept_and_a_broken_one_falls_back_with_a_word() {
    let mut harness = idle();
    arrange(&mut harness, Arrange::Preset(Preset::Maker));
    let kept = serde_json::to_vec(&Snapshot::of(harness.state().content()).kept(String::new())).unwrap();
    let mut again = frames(App::for_test(Arc::new(Idle)), [1280.0, 720.0]);
    again.state_mut().restore(&Kept::read(&kept).unwrap()).unwrap();
    settle(&mut again);
    assert_eq!(in_sight(&again), in_sight(&harness));
    again.state_mut().shell.state.settings.layout = Some("{\"version\":1".to_owned());
    settle(&mut again);
    assert_eq!(in_sight(&again).len(), 6);
    assert!(again.query_all_by_label_contains("tile layout cannot be read").next().is_some());
}

#[test]
fn what_is_hidden_computes_nothing_until_it_is_shown() {
    let engine = Arc::new(Counting::default());
    let mut harness = frames(App::for_test(engine.clone()), [1280.0, 720.0]);
    settle(&mut harness);
    assert_eq!(engine.counts(), [1, 1, 0]);
    // The sky tile tells what falls on the façade, which comes with the LID.
    apply(&mut harness, Command::Maximise(Some(TILES[0].tile)));
    for hours in 1..4 {
        apply(&mut harness, Command::Hour(hours));
    }
    assert_eq!(engine.counts(), [1, 1, 0]);
    assert!(harness.state().shell.results.room.stale);
    apply(&mut harness, Command::Maximise(None));
    assert_eq!(engine.counts(), [2, 2, 0]);
    assert!(!harness.state().shell.results.room.stale);
    arrange(&mut harness, Arrange::Preset(Preset::Maker));
    apply(&mut harness, Command::Hour(-1));
    let before = engine.counts();
    let sky = TILES.iter().find(|entry| entry.tile.title == "Sky").unwrap().tile;
    apply(&mut harness, Command::CopyTile(sky));
    assert!(!in_sight(&harness).contains(&"Room"));
    apply(&mut harness, Command::Hour(-1));
    assert_eq!(engine.counts()[0], before[0], "the room is behind a tab");
    // A file may hold what no tile shows.
    apply(&mut harness, Command::Sheet(Some(cfs::app::state::Sheet::Path(cfs::app::state::PathUse::SaveScene))));
    assert_eq!(engine.counts()[0], before[0] + 1);
}

#[test]
fn a_hidden_tile_comes_up_to_be_copied() {
    let mut harness = window();
    arrange(&mut harness, Arrange::Preset(Preset::Designer));
    let tile = TILES.iter().find(|entry| entry.tile.title == "LID").unwrap().tile;
    assert!(head(&harness, "LID").is_none());
    apply(&mut harness, Command::CopyTile(tile));
    assert!(head(&harness, "LID").is_some());
}

#[test]
fn numbers_are_copied_without_what_is_hidden() {
    let mut harness = window();
    arrange(&mut harness, Arrange::Preset(Preset::Designer));
    assert!(head(&harness, "Control").is_none());
    // The states over the year are not computed while no tile shows them.
    apply(&mut harness, Command::Hour(2));
    let room = TILES.iter().find(|entry| entry.tile.title == "Room").unwrap().tile;
    harness.state_mut().apply(Command::CopyTile(room));
    let copied = (0..200).any(|_| {
        harness.step();
        let commands = &harness.output().platform_output.commands;
        commands.iter().any(|command| matches!(command, OutputCommand::CopyText(text) if text.contains("total_lx")))
    });
    assert!(copied, "the numbers wait for a hidden tile");
}
