//! Comparing in the window: the tray, what is computed of it, what is drawn side by side, and the other one by a key.

use crate::driven::{Idle, apply, coarsen, frames, harness, services, settle, step_until};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::compare::view::{Act, Look};
use cfs::app::display::language::LanguageChoice;
use cfs::app::results::backend::{ideals_shelf, memory_shelf};
use cfs::app::results::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures};
use cfs::app::scene::room_look::{RoomLook, RoomView};
use cfs::app::session::{Kept, Snapshot};
use cfs::app::shell::error::AppError;
use cfs::app::shell::jobs::Lane;
use cfs::app::tiles::{TILES, compared};
use cfs::compute::estimate::{Estimate, Progress};
use cfs::study::SceneFile;
use cfs::study::accuracy::Accuracy;
use cfs::study::comparison::label;
use cfs::study::scene_file::{CompareKeys, SystemKeys};
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

fn act(harness: &mut Harness<'_, App>, act: Act) {
    apply(harness, Command::Compare(act));
}

fn tray(harness: &Harness<'_, App>) -> Vec<String> {
    harness.state().shell.state.document.scene.compare.iter().map(label).collect()
}

/// A room twice as bright behind the clear opening; counts what it is asked.
#[derive(Default)]
struct Counting {
    rooms: AtomicUsize,
    lids: AtomicUsize,
    /// Held by a test that wants to see what is waited for.
    gate: Mutex<()>,
}

impl Engine for Counting {
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        drop(self.gate.lock());
        self.rooms.fetch_add(1, Ordering::SeqCst);
        let clear =
            matches!(&question.scene.aperture[0].system, SystemKeys::Catalogue { key, .. } if key == "clear-opening");
        let factor = if clear { 2.0 } else { 1.0 };
        let mut figures = Idle.room(question, progress)?;
        figures.direct = vec![Estimate::new(factor * 500.0, 2.0)];
        Ok(figures)
    }

    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError> {
        self.lids.fetch_add(1, Ordering::SeqCst);
        Idle.lid(question, progress)
    }

    fn surfaces(&self, question: &Question, progress: &dyn Progress) -> Result<SurfaceFigures, AppError> {
        Idle.surfaces(question, progress)
    }

    fn accuracy(&self, _question: &Question, _progress: &dyn Progress) -> Result<Accuracy, AppError> {
        Err(AppError::NoAperture)
    }

    fn luminaire(&self, _lid: &LidFigures, _path: &Path) -> Result<Vec<u8>, AppError> {
        Err(AppError::NoLid)
    }
}

/// A window on the two ideal systems, both in the tray, the diffuser shown.
fn two() -> (Harness<'static, App>, Arc<Counting>) {
    let engine = Arc::new(Counting::default());
    let mut harness = frames(App::with_shelf(engine.clone(), ideals_shelf), [1280.0, 720.0]);
    settle(&mut harness);
    for key in ["clear-opening", "ideal-diffuser"] {
        apply(&mut harness, Command::Select(key.to_owned()));
        harness.key_press(Key::C);
        settle(&mut harness);
    }
    assert_eq!(tray(&harness), ["Clear opening", "Ideal diffuser"]);
    (harness, engine)
}

#[test]
fn the_tray_is_filled_by_a_key_kept_with_scene_and_session_and_undone() {
    let (mut harness, _) = two();
    // The same again is told, not added; with its moment it is another one.
    harness.key_press(Key::C);
    settle(&mut harness);
    assert_eq!(tray(&harness).len(), 2);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::C);
    settle(&mut harness);
    assert_eq!(tray(&harness)[2], "Ideal diffuser · 21 Mar 12:00");
    act(&mut harness, Act::Move(2, -2));
    act(&mut harness, Act::Rename(1, " Nothing ".to_owned()));
    assert_eq!(tray(&harness), ["Ideal diffuser · 21 Mar 12:00", "Nothing", "Ideal diffuser"]);
    act(&mut harness, Act::Remove(0));
    assert_eq!(tray(&harness), ["Nothing", "Ideal diffuser"]);
    apply(&mut harness, Command::Undo);
    assert_eq!(tray(&harness).len(), 3);
    apply(&mut harness, Command::Redo);
    assert!(harness.query_by_label("Candidate 1 Nothing").is_some(), "the tray is in sight");
    // With the scene, and with the session.
    let state = &harness.state().shell.state;
    let text = toml::to_string(&state.document.scene).unwrap();
    assert!(text.contains("[[compare]]"));
    assert_eq!(SceneFile::parse(&text).unwrap(), state.document.scene);
    let kept = serde_json::to_vec(&Snapshot::of(harness.state().content()).kept(String::new())).unwrap();
    let mut other = App::for_test(Arc::new(Idle));
    other.restore(&Kept::read(&kept).unwrap()).unwrap();
    assert_eq!(other.shell.state.document.scene.compare, state.document.scene.compare);
    // A reset of the scene is none of the tray.
    apply(&mut harness, Command::ResetScene);
    assert_eq!(tray(&harness).len(), 2);
    act(&mut harness, Act::Clear);
    assert!(tray(&harness).is_empty() && harness.query_by_label_contains("Candidate ").is_none());
}

#[test]
fn a_row_of_the_catalogue_goes_in_and_out_by_its_sign_and_six_are_most() {
    let mut harness = harness(services(memory_shelf));
    coarsen(&mut harness, [1, 2]);
    settle(&mut harness);
    let entries = harness.state().shell.state.found.entries.clone();
    for entry in &entries[..6] {
        act(&mut harness, Act::AddProduct(entry.key.clone()));
    }
    assert_eq!(tray(&harness).len(), 6);
    act(&mut harness, Act::AddProduct(entries[7].key.clone()));
    assert_eq!(tray(&harness).len(), 6);
    // A moving product comes in by its rule.
    let moving = harness.state().shell.state.document.scene.compare.iter().find(|one| one.control.is_some());
    assert!(moving.is_some_and(|one| one.name.contains(", ")), "{:?}", tray(&harness));
    let first = entries[0].name.clone();
    harness.get_by_label(&format!("Remove from the comparison: {first}")).click();
    settle(&mut harness);
    assert!(tray(&harness).len() == 5 && !tray(&harness)[0].starts_with(&first));
    harness.get_by_label(&format!("Compare: {first}")).click();
    settle(&mut harness);
    assert!(tray(&harness)[5].starts_with(&first));
}

#[test]
fn nothing_is_computed_that_is_not_shown_and_what_is_known_is_not_computed_again() {
    let (mut harness, engine) = two();
    let counts = || [engine.rooms.load(Ordering::SeqCst), engine.lids.load(Ordering::SeqCst)];
    // One a product that was chosen; the tray asked for nothing.
    let before = counts();
    settle(&mut harness);
    assert_eq!(counts(), before);
    act(&mut harness, Act::Tile("Room"));
    // Both were shown before: their rooms are known.
    assert_eq!(counts(), before);
    let totals =
        |app: &App, place: usize| app.compare.candidates()[place].results.room.value.as_ref().unwrap().total(0).value;
    assert_eq!([totals(harness.state(), 0), totals(harness.state(), 1)], [1500.0, 1000.0]);
    // At another hour the window asks for its own, the comparison for the other one alone.
    apply(&mut harness, Command::Hour(1));
    assert_eq!(counts(), [before[0] + 2, before[1] + 1]);
    assert!(!harness.state().compare.candidates()[0].results.room.stale);
    // Back at the tiles nobody asks for the candidates.
    act(&mut harness, Act::Show);
    apply(&mut harness, Command::Hour(1));
    assert_eq!(counts(), [before[0] + 3, before[1] + 2]);
    assert!(harness.state().compare.candidates()[0].results.room.stale);
}

#[test]
fn a_comparison_under_way_is_told_and_stops_when_asked() {
    let (mut harness, engine) = two();
    apply(&mut harness, Command::Hour(1));
    let gate = engine.gate.lock().unwrap();
    harness.state_mut().apply(Command::Compare(Act::Tile("Room")));
    step_until(&mut harness, "it is under way", |app| app.works_in(Lane::Compare));
    harness.step();
    assert!(harness.query_all_by_label_contains("comparison").count() > 0, "the status line says so");
    harness.state_mut().apply(Command::Cancel(Lane::Compare));
    harness.run_steps(3);
    assert!(!harness.state().busy() && harness.state().compare.is_stopped());
    assert!(harness.state().compare.candidates()[0].results.room.stale);
    drop(gate);
    act(&mut harness, Act::Resume);
    assert!(!harness.state().compare.candidates()[0].results.room.stale);
}

#[test]
fn the_other_one_is_shown_by_a_key_and_the_scene_stays_what_it_is() {
    let (mut harness, engine) = two();
    let scene = harness.state().shell.state.document.clone();
    let rooms = engine.rooms.load(Ordering::SeqCst);
    let shown = |app: &App| {
        app.compare.shown(&app.shell.state, &app.shell.results).1.room.value.as_ref().unwrap().total(0).value
    };
    assert_eq!(shown(harness.state()), 1000.0);
    harness.key_press(Key::X);
    harness.run_steps(2);
    assert_eq!(shown(harness.state()), 1500.0);
    assert!(harness.query_by_label("1 Clear opening").is_some(), "which one is shown is said");
    settle(&mut harness);
    assert_eq!(engine.rooms.load(Ordering::SeqCst), rooms, "it was known");
    assert_eq!(harness.state().shell.state.document, scene);
    harness.key_press(Key::X);
    settle(&mut harness);
    assert_eq!(shown(harness.state()), 1000.0);
    // It can become the scene, and undo goes back.
    act(&mut harness, Act::Take(0));
    assert_eq!(harness.state().shell.state.document.selection.product, "clear-opening");
    apply(&mut harness, Command::Undo);
    assert_eq!(harness.state().shell.state.document.selection.product, "ideal-diffuser");
}

#[test]
fn all_looks_draw_all_tiles_and_the_table_marks_what_is_better_by_more_than_the_errors() {
    let mut harness = harness(services(memory_shelf));
    coarsen(&mut harness, [4, 6]);
    settle(&mut harness);
    for key in ["open-aperture", "ideal-diffuser", "venetian-80-72"] {
        act(&mut harness, Act::AddProduct(key.to_owned()));
    }
    for look in Look::ALL {
        act(&mut harness, Act::Look(look));
        for tile in compared().map(|tile| tile.title) {
            act(&mut harness, Act::Tile(tile));
            harness.run_steps(2);
            if look == Look::Difference && tile == "Room" {
                assert_eq!(harness.query_all_by_label_contains("Difference of ").count(), 2);
            }
        }
        let errors =
            harness.state().compare.candidates().iter().filter_map(|column| column.error()).collect::<Vec<_>>();
        assert!(errors.is_empty(), "{errors:?}");
    }
    // A clear opening sends nothing up, a diffuser half: the better one is marked.
    let rows = harness.state().compare.rows();
    let ceiling = rows.iter().find(|row| row.figure.key == "to_ceiling").unwrap();
    assert!(ceiling.values[0].unwrap().value < 1e-6 && (ceiling.values[1].unwrap().value - 0.5).abs() < 1e-6);
    assert!(ceiling.values[2].unwrap().error.is_some_and(|error| error > 0.0));
    assert!(rows.iter().all(|row| row.values.iter().all(Option::is_some) || row.figure.key == "peak_scattered"));
    assert!(harness.query_all_by_label_contains("▲ ").count() > 2);
    assert!(harness.query_by_label("Copy as CSV").is_some());
    // The scale of the rooms is one: that of the brightest.
    act(&mut harness, Act::Look(Look::Beside));
    act(&mut harness, Act::Tile("Room"));
    let state = harness.state();
    let greatest = |place: usize| {
        let room = state.compare.candidates()[place].results.room.value.as_ref().unwrap();
        room.totals().map(|one| one.value).fold(0.0, f64::max)
    };
    let brightest = (0..3).map(greatest).fold(0.0, f64::max);
    let [low, high] = state.compare.common_scale().unwrap();
    assert!(low == 0.0 && high >= brightest && high < 1.3 * brightest, "{high} {brightest}");
}

#[test]
fn products_like_the_shown_one_are_listed_with_their_distance() {
    let mut harness = harness(services(memory_shelf));
    coarsen(&mut harness, [1, 2]);
    settle(&mut harness);
    apply(&mut harness, Command::Select("clear-double".to_owned()));
    apply(&mut harness, Command::Like(None));
    let found = harness.state().shell.state.found.clone();
    let like = found.like.as_ref().unwrap();
    assert_eq!((like.key.as_str(), like.distances.len()), ("clear-double", found.entries.len()));
    assert!(found.entries.iter().all(|entry| entry.key != "clear-double"));
    assert!(like.distances.windows(2).all(|pair| pair[0].distance <= pair[1].distance));
    // Glass is like glass.
    assert!(["pane", "stack"].contains(&found.entries[0].kind.as_str()), "{:?}", found.entries[0].name);
    harness.get_by_label_contains("No longer similar to").click();
    settle(&mut harness);
    assert!(harness.state().shell.state.found.like.is_none());
    assert!(harness.query_all_by_label_contains("Compare: ").all(|node| !node.accesskit_node().is_disabled()));
}

/// A system that a file describes, without the catalogue.
fn of_file(name: &str) -> CompareKeys {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/systems/clear-double.system.toml");
    CompareKeys {
        name: name.to_owned(),
        system: Some(SystemKeys::File { path, state: None }),
        ..CompareKeys::default()
    }
}

#[test]
fn a_candidate_from_a_file_has_its_tiles_and_the_other_one_its_surfaces() {
    let mut harness = harness(services(memory_shelf));
    coarsen(&mut harness, [2, 3]);
    settle(&mut harness);
    act(&mut harness, Act::AddProduct("ideal-diffuser".to_owned()));
    harness.state_mut().shell.state.document.scene.compare.push(of_file("Of a file"));
    for tile in ["BTDF", "Transmittance", "Sky", "LID", "Room"] {
        act(&mut harness, Act::Tile(tile));
        harness.run_steps(2);
        let column = &harness.state().compare.candidates()[1];
        assert!(column.error().is_none() && column.state.dataset.value.is_some(), "{tile}: {:?}", column.error());
    }
    act(&mut harness, Act::Tile("BTDF"));
    assert_eq!(harness.query_all_by_label("Emergent hemisphere").count(), 2);
    // The same as the same system in the catalogue.
    act(&mut harness, Act::AddProduct("clear-double".to_owned()));
    act(&mut harness, Act::Look(Look::Figures));
    let rows = harness.state().compare.rows();
    let tau = &rows.iter().find(|row| row.figure.key == "tau_hemispherical").unwrap().values;
    let [file, product] = [tau[1].unwrap(), tau[2].unwrap()];
    assert!((file.value - product.value).abs() < 1e-3, "{file:?} {product:?}");
    // In perspective the other one shows its own surfaces.
    apply(&mut harness, Command::RoomLook(RoomLook { view: RoomView::Perspective, ..RoomLook::default() }));
    act(&mut harness, Act::SwapWith(1));
    let app = harness.state();
    let (state, results) = app.compare.shown(&app.shell.state, &app.shell.results);
    assert_eq!(state.settings.room.view, RoomView::Perspective);
    let flux = |results: &cfs::app::state::Results| results.surfaces.value.as_ref().map(|one| one.light.flux.value);
    let (other, own) = (flux(results).expect("surfaces of the other one"), flux(&app.shell.results).unwrap());
    assert!((other / own - 1.0).abs() > 1e-3, "{other} {own}");
}

#[test]
fn one_legend_stands_for_all_and_its_kind_is_chosen_for_all() {
    let (mut harness, _) = two();
    let tile = |title: &str| TILES.iter().map(|entry| entry.tile).find(|tile| tile.title == title).unwrap();
    let logs =
        |harness: &mut Harness<'_, App>, title: &str| -> Vec<bool> { harness.state_mut().compare.logs(tile(title)) };
    for (title, log) in [("Room", true), ("BTDF", false), ("Sky", false)] {
        act(&mut harness, Act::Tile(title));
        harness.run_steps(2);
        assert_eq!(harness.query_all_by_label("Scale of all tiles").count(), 1, "{title}");
        act(&mut harness, Act::Log(log));
        harness.run_steps(2);
        assert_eq!(logs(&mut harness, title), [log; 2], "{title}");
    }
    act(&mut harness, Act::Tile("Control"));
    harness.run_steps(2);
    assert_eq!(harness.query_all_by_label("Scale of all tiles").count(), 0);
}

#[test]
fn the_comparison_speaks_german() {
    let (mut harness, _) = two();
    act(&mut harness, Act::Look(Look::Figures));
    apply(&mut harness, Command::Language(LanguageChoice::German));
    for label in ["Nebeneinander", "Kennwerte", "Tauschen", "Schließen", "Als CSV kopieren", "Besser"] {
        assert!(harness.query_all_by_label(label).count() > 0, "{label}");
    }
    assert!(harness.query_all_by_label_contains("Kleinste Beleuchtungsstärke / lx").count() > 0);
    assert!(harness.query_by_label("Kandidat 1 Clear opening").is_some());
    for english in ["Side by side", "Figures", "Swap", "Copy as CSV", "Better"] {
        assert_eq!(harness.query_all_by_label(english).count(), 0, "{english}");
    }
    // What programs read stays English.
    let app = harness.state();
    let table = cfs::study::comparison::csv(&app.compare.rows(), &app.compare.names());
    assert!(table.contains("more is better") && !table.contains("besser"), "{table}");
}
