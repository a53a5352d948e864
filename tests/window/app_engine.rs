//! The window with the real study and a catalogue in memory, without a display: what is selected and set is what is
//! computed, and what is written can be read.

use crate::common::data;
use crate::driven::{apply, coarsen, frames, settle, step_until};
use cfs::app::catalogue::shelf::Query;
use cfs::app::command::Command;
use cfs::app::results::backend::{StudyEngine, memory_shelf, open_shelf};
use cfs::app::scene::{Selection, fill, first_scene};
use cfs::app::shell::dialogs::NoDialogs;
use cfs::app::shell::jobs::Lane;
use cfs::app::state::{PathUse, Settings};
use cfs::app::tiles::{TILES, compared};
use cfs::app::{App, Services};
use cfs::catalogue::{Catalogue, SYSTEMS, SourceFile};
use cfs::compute::estimate::Silent;
use cfs::formats::{Format, eulumdat, ies, write_dataset};
use cfs::study::control::year::CONTROLLED;
use cfs::study::scene_file::ControlMode;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn window() -> Harness<'static, App> {
    let app = App::with_shelf(Arc::new(StudyEngine::default()), memory_shelf);
    let mut harness = frames(app, [1280.0, 720.0]);
    coarsen(&mut harness, [2, 4]);
    settle(&mut harness);
    harness
}

/// A window on a catalogue's file, with the real study.
fn window_on(path: &Path, settings: Settings) -> Harness<'static, App> {
    let path = path.to_owned();
    let services = Services {
        open_catalogue: Arc::new(move || open_shelf(Some(&path))),
        read: SourceFile::read,
        dialogs: Arc::new(NoDialogs),
        engine: Arc::new(StudyEngine::default()),
    };
    frames(App::new(services, settings), [1280.0, 720.0])
}

#[test]
fn a_first_start_shows_six_tiles_before_the_catalogue_is_filled() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("catalogue.sqlite");
    let mut harness = window_on(&path, Settings::default());
    step_until(&mut harness, "six tiles", |app| {
        let results = &app.shell.results;
        let shown = app.shell.state.dataset.value.is_some() && app.shell.state.daylight.value.is_some();
        shown && results.lid.value.is_some() && results.room.value.is_some() && results.year.value.is_some()
    });
    assert_eq!(harness.state().shell.state.document.selection.product, "venetian-80-72");
    // All of them are in the list, with figures, while hardly any data are there.
    let entries = harness.state().shell.state.found.entries.clone();
    assert_eq!(entries.len(), SYSTEMS.len() + 2);
    assert!(entries.iter().all(|entry| entry.tau_normal.is_some() && entry.tau_profile.len() > 10));
    let waiting = || Catalogue::open(&path).unwrap().waiting().unwrap().len();
    let left = waiting();
    assert!(left > entries.len(), "nothing that is not in sight came before: {left} states are left");
    harness.state_mut().apply(Command::Find(Query { text: "prismatic".to_owned(), ..Query::default() }));
    step_until(&mut harness, "prismatic", |app| app.shell.state.found.entries.len() == 6);
    step_until(&mut harness, "more data come behind all else", |_| waiting() < left);
    // What was done stays for the next start.
    drop(harness);
    assert!(waiting() < left);
}

#[test]
fn the_first_data_filled_in_are_those_of_the_chosen_product_then_of_the_list() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("catalogue.sqlite");
    let shelf = open_shelf(Some(&path)).unwrap();
    let waiting = |key: &str| {
        let all = Catalogue::open(&path).unwrap().waiting().unwrap();
        all.iter().filter(|one| one.product == key).count()
    };
    let order = ["opal-light", "clear-double"].map(str::to_owned);
    assert_eq!((waiting("opal-light"), waiting("clear-double")), (1, 1));
    let [left, all] = shelf.fill_one(&order, &Silent).unwrap();
    assert_eq!((waiting("opal-light"), waiting("clear-double"), left), (0, 1, all - 3));
    shelf.fill_one(&order, &Silent).unwrap();
    assert_eq!(waiting("clear-double"), 0);
    // Nothing of the order left: the others in the catalogue's own, of each the state that stands for it.
    let before = waiting("venetian-80-72");
    let [left, _] = shelf.fill_one(&order, &Silent).unwrap();
    assert_eq!(waiting("venetian-80-72"), before - 1);
    assert!(shelf.is_ready("venetian-80-72", None).unwrap());
    let [less, _] = shelf.fill_one(&order, &Silent).unwrap();
    assert_eq!((waiting("venetian-80-72"), less), (before - 1, left - 1));
    // All of them for who has chosen it.
    let order = ["venetian-80-72".to_owned()];
    let [left, _] = shelf.fill_one(&order, &Silent).unwrap();
    assert_eq!((waiting("venetian-80-72"), left), (before - 2, less + before - 2));
}

#[test]
fn a_state_that_is_to_be_computed_is_told_and_everything_else_is_shown_meanwhile() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window_on(&folder.path().join("catalogue.sqlite"), Settings::default());
    step_until(&mut harness, "the first product", |app| {
        app.shell.state.dataset.value.is_some() && !app.shell.state.dataset.stale
    });
    let key = "double-integral-micro-blind";
    harness.state_mut().apply(Command::Select(key.to_owned()));
    step_until(&mut harness, "it is told", |app| app.shell.state.computing.is_some());
    harness.step();
    let state = &harness.state().shell.state;
    assert!(state.product.as_ref().is_some_and(|product| product.key == key && product.states.len() > 5));
    assert!(state.daylight.value.is_some() && !state.daylight.stale && state.dataset.stale);
    // The state that stands for the product, not its first one.
    let product = state.product.as_ref().unwrap();
    let label = product.states[product.representative().1].label.clone();
    assert_ne!(label, product.states[0].label);
    assert_eq!(state.computing.as_deref(), Some(format!("computing {label}…").as_str()));
    assert!(harness.query_all_by_label(&format!("computing {label}…")).count() >= 2, "the tiles say so");
    assert!(harness.query_all_by_label_contains("product data").count() > 0, "and so does the line below");
    // Stopped, nothing goes on computing it; another product comes as ever.
    harness.state_mut().apply(Command::Cancel(Lane::Product));
    harness.run_steps(2);
    assert!(harness.state().shell.state.computing.is_none() && harness.state().shell.state.dataset.stale);
    harness.state_mut().apply(Command::Select("clear-double".to_owned()));
    let shown = |app: &App| app.shell.state.product.as_ref().is_some_and(|product| product.key == "clear-double");
    step_until(&mut harness, "clear-double", |app| {
        shown(app) && !app.shell.state.dataset.stale && !app.shell.results.room.stale
    });
    assert!(harness.state().shell.state.computing.is_none());
    assert_eq!(harness.state().shell.state.dataset.value.as_ref().unwrap().name, "Clear glass, double");
}

#[test]
fn a_scene_whose_product_is_not_computed_yet_is_shown_when_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = first_scene();
    fill(&mut scene, &Selection { product: "clear-double".to_owned(), state: String::new() });
    let settings = Settings { last_scene: toml::to_string(&scene).ok(), ..Settings::default() };
    let mut harness = window_on(&folder.path().join("catalogue.sqlite"), settings);
    let shown = |app: &App| app.shell.state.product.as_ref().is_some_and(|product| product.key == "clear-double");
    step_until(&mut harness, "clear-double", |app| shown(app) && app.shell.results.room.value.is_some());
}

/// Mean illuminance over the sensors: total and direct. [lx]
fn means(harness: &Harness<'_, App>) -> (f64, f64) {
    let results = &harness.state().shell.results.room;
    assert!(!results.stale && results.error.is_none(), "{:?}", results.error);
    let room = results.value.as_ref().unwrap();
    let count = room.positions.len() as f64;
    let sum = |f: &dyn Fn(usize) -> f64| (0..room.positions.len()).map(f).sum::<f64>() / count;
    (sum(&|i| room.total(i).value), sum(&|i| room.direct[i].value))
}

/// A product that moves and has a control curve.
fn select_blind(harness: &mut Harness<'_, App>) -> Arc<cfs::catalogue::Product> {
    let shelf = harness.state().shell.state.shelf().unwrap();
    let entries = shelf.search(&Query::default()).unwrap().entries;
    let blind = entries
        .iter()
        .find(|entry| entry.states.len() > 2 && !shelf.product(&entry.key).unwrap().control_curve.is_empty())
        .expect("a built-in blind with a control curve");
    apply(harness, Command::Select(blind.key.clone()));
    harness.state().shell.state.product.clone().unwrap()
}

#[test]
fn a_product_lights_the_room_and_a_later_hour_lights_it_otherwise() {
    let mut harness = window();
    select_blind(&mut harness);
    let (total, direct) = means(&harness);
    assert!(total > direct && direct > 0.0, "{total} {direct}");
    apply(&mut harness, Command::Hour(4));
    let (later, _) = means(&harness);
    assert!((later - total).abs() > 0.02 * total, "{later} {total}");
}

#[test]
fn control_closes_the_blind_against_the_sun_and_the_room_follows() {
    let mut harness = window();
    let product = select_blind(&mut harness);
    let values = |key: &str| product.states.iter().find(|state| state.key == key).unwrap().value.unwrap();
    let most_open = product.states.iter().min_by(|a, b| a.value.unwrap().abs().total_cmp(&b.value.unwrap().abs()));
    apply(&mut harness, Command::SelectState(most_open.unwrap().key.clone()));
    let open = means(&harness).0;
    apply(&mut harness, Command::Control(ControlMode::Din5034));
    let closed = harness.state().shell.state.shown_state.clone();
    let greatest = product.states.iter().map(|state| state.value.unwrap()).fold(f64::MIN, f64::max);
    assert_eq!(values(&closed), greatest, "the noon sun stands before a south façade");
    assert!(means(&harness).0 < 0.7 * open, "{} {open}", means(&harness).0);
    assert!(cfs::app::title::title(&harness.state().shell.state).contains(&format!(", {closed}° ·")));
    // The dataset shown is that of the picked state.
    let shelf = harness.state().shell.state.shelf().unwrap();
    let dataset = harness.state().shell.state.dataset.value.clone().unwrap();
    assert_eq!(*dataset, *shelf.load(&product.key, Some(&closed)).unwrap());
    // The scene that is saved says so itself.
    let scene = &harness.state().shell.state.document.scene;
    assert_eq!(scene.control.as_ref().unwrap().mode, ControlMode::Din5034);
    assert_eq!(harness.state().shell.state.document.selection.state, CONTROLLED);

    // The curve of a cut-off blind asks for less than closing it.
    apply(&mut harness, Command::Control(ControlMode::Curve));
    let picked = harness.state().shell.state.shown_state.clone();
    assert!(values(&picked) < greatest, "{picked}");
    // By night it opens.
    apply(&mut harness, Command::Hour(11));
    assert_eq!(harness.state().shell.state.shown_state, most_open.unwrap().key);
    // A key takes over by hand, from where control stood.
    harness.key_press(Key::CloseBracket);
    settle(&mut harness);
    assert_eq!(harness.state().shell.state.control_mode(), ControlMode::Fixed);
    assert!(harness.state().shell.state.document.scene.control.is_none());
    assert_ne!(harness.state().shell.state.document.selection.state, CONTROLLED);
}

#[test]
fn the_year_of_control_knows_nights_and_the_suns_half_of_the_day() {
    let mut harness = window();
    let product = select_blind(&mut harness);
    apply(&mut harness, Command::Control(ControlMode::Curve));
    let year = harness.state().shell.results.year.value.clone().expect("a year");
    assert_eq!(year.hours.len(), 365 * 24);
    assert_eq!(year.states.len(), product.states.len());
    // Midnight never has sun, noon of a south façade always.
    assert!((0..365).all(|day| year.hours[24 * day].is_none() && year.hours[24 * day + 12].is_some()));
    // The high noon sun of June is cut off by an opener blind than the low one of December.
    let noon = |day: usize| year.hours[24 * day + 12].unwrap();
    assert!(noon(171) < noon(354), "{} {}", noon(171), noon(354));
    // A north façade has no sun in December at all, but early and late in June.
    let mut scene = harness.state().shell.state.document.scene.clone();
    scene.site.azimuth = 0.0;
    apply(&mut harness, Command::Scene(Box::new(scene)));
    let north = harness.state().shell.results.year.value.clone().unwrap();
    assert!(north.hours[24 * 354..24 * 355].iter().all(Option::is_none));
    assert!(north.hours[24 * 171 + 6].is_some() && north.hours[24 * 171 + 12].is_none());
}

#[test]
fn a_product_without_states_cannot_be_controlled_and_says_so() {
    let mut harness = window();
    let found = harness.state().shell.state.found.clone();
    let still = found.entries.iter().find(|entry| entry.states.len() == 1).unwrap();
    apply(&mut harness, Command::Select(still.key.clone()));
    apply(&mut harness, Command::Control(ControlMode::Din5034));
    assert_eq!(harness.state().shell.state.control_mode(), ControlMode::Fixed);
    assert!(harness.state().shell.results.year.value.is_none());
}

#[test]
fn the_lid_is_written_as_luminaire_files_that_hold_its_flux() {
    let mut harness = window();
    select_blind(&mut harness);
    let lid = harness.state().shell.results.lid.value.clone().expect("a LID");
    let flux = lid.flux.value;
    assert!(flux > 0.0);
    let folder = tempfile::tempdir().unwrap();
    let write = |harness: &mut Harness<'_, App>, name: &str| {
        let path = folder.path().join(name);
        apply(harness, Command::Write(PathUse::ExportLid, path.clone()));
        std::fs::read(path).unwrap()
    };
    let ldt = eulumdat::read(&write(&mut harness, "window.ldt")).unwrap();
    let lm63 = ies::read(&write(&mut harness, "window.ies")).unwrap();
    for read in [ldt, lm63] {
        assert!((read.flux() / flux - 1.0).abs() < 2e-3, "{} {flux}", read.flux());
    }
    assert!(write(&mut harness, "window.png").starts_with(b"\x89PNG"));
    assert!(String::from_utf8(write(&mut harness, "window.svg")).unwrap().contains("<svg"));
    assert!(String::from_utf8(write(&mut harness, "window.csv")).unwrap().lines().count() > 100);
    // A format that is none leaves nothing behind.
    let wrong = folder.path().join("window.doc");
    apply(&mut harness, Command::Write(PathUse::ExportLid, wrong.clone()));
    assert!(!wrong.exists());
}

#[test]
fn what_is_written_waits_for_what_is_being_computed() {
    let mut harness = window();
    apply(&mut harness, Command::Select("clear-double".into()));
    let before = harness.state().shell.results.lid.value.as_ref().expect("a LID").flux.value;
    let folder = tempfile::tempdir().unwrap();
    let (lid, table) = (folder.path().join("opal.ldt"), folder.path().join("opal.csv"));
    let room = TILES.iter().find(|entry| entry.tile.title == "Room").unwrap().tile;
    // All in one frame: nothing of the other product is there yet.
    harness.state_mut().apply(Command::Select("opal-light".into()));
    harness.state_mut().apply(Command::Write(PathUse::ExportLid, lid.clone()));
    harness.state_mut().apply(Command::Write(PathUse::ExportTile(room), table.clone()));
    settle(&mut harness);
    let flux = harness.state().shell.results.lid.value.as_ref().unwrap().flux.value;
    assert!((flux / before - 1.0).abs() > 0.1, "{flux} {before}");
    let written = eulumdat::read(&std::fs::read(lid).unwrap()).unwrap();
    assert!((written.flux() / flux - 1.0).abs() < 2e-3, "{} {flux} {before}", written.flux());
    let total = harness.state().shell.results.room.value.as_ref().unwrap().total(0).value;
    let text = std::fs::read_to_string(table).unwrap();
    let first: f64 = text.lines().nth(1).unwrap().split(',').nth(3).unwrap().parse().unwrap();
    assert!((first / total - 1.0).abs() < 1e-3, "{first} {total}");
}

#[test]
fn every_tile_is_written_as_numbers() {
    let mut harness = window();
    select_blind(&mut harness);
    let folder = tempfile::tempdir().unwrap();
    // A year is computed when it is asked for.
    for tile in compared() {
        let path = folder.path().join(format!("{}.csv", tile.title));
        apply(&mut harness, Command::Write(PathUse::ExportTile(tile), path.clone()));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{tile:?}: {error}"));
        let rows: Vec<&str> = text.lines().collect();
        assert!(rows.len() > 5, "{tile:?}: {text}");
        assert!(rows[0].contains(','), "{tile:?}: {}", rows[0]);
    }
    let room = std::fs::read_to_string(folder.path().join("Room.csv")).unwrap();
    assert_eq!(room.lines().count(), 1 + 8, "one row a sensor");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), compared().count(), "no part files stay");
}

fn import(harness: &mut Harness<'_, App>, path: PathBuf) {
    apply(harness, Command::OpenPaths(vec![path]));
    let import = harness.state().imports.open().expect("an import sheet");
    assert!(import.failures.is_empty(), "{:?}", import.failures);
    apply(harness, Command::AddImport);
}

#[test]
fn a_klems_file_of_our_own_comes_in_is_found_and_goes_out_again() {
    let mut harness = window();
    let product = select_blind(&mut harness);
    let shelf = harness.state().shell.state.shelf().unwrap();
    let mut dataset = (*shelf.load(&product.key, Some(&product.states[0].key)).unwrap()).clone();
    dataset.name = "Quux lamella".to_owned();
    dataset.state = String::new();
    let tau = dataset.transmission().unwrap().tau_hemispherical();
    let bytes = write_dataset(Format::BsdfXml, &[dataset]).unwrap().bytes;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("quux.xml");
    std::fs::write(&path, bytes).unwrap();
    let before = harness.state().shell.state.found.total;
    import(&mut harness, path);
    assert_eq!(harness.state().shell.state.found.total, before + 1);
    apply(&mut harness, Command::Find(Query { text: "quux".to_owned(), ..Query::default() }));
    let found = harness.state().shell.state.found.clone();
    assert_eq!(found.entries.len(), 1);
    assert!((found.entries[0].tau_hemispherical.unwrap() - tau).abs() < 0.01, "{tau}");
    assert!(means(&harness).0 > 0.0);
    for _ in 0..3 {
        if harness.state().shell.state.found.total > before {
            harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
            settle(&mut harness);
        }
    }
    assert_eq!(harness.state().shell.state.found.total, before);
    assert!(shelf.search(&Query { text: "quux".to_owned(), ..Query::default() }).unwrap().entries.is_empty());
}

#[test]
fn a_makers_file_lights_the_room() {
    let Some(folder) = data("data/bsdf/clear_and_venetian_w7") else { return };
    let file = walk(&folder).into_iter().next().unwrap();
    let mut harness = window();
    let before = harness.state().shell.state.found.total;
    import(&mut harness, file);
    assert_eq!(harness.state().shell.state.found.total, before + 1);
    let dataset = harness.state().shell.state.dataset.value.clone().unwrap();
    let tau = dataset.transmission().unwrap().tau_hemispherical();
    assert!(tau > 0.0 && tau < 1.0, "{tau}");
    let (total, direct) = means(&harness);
    assert!(total > direct && direct > 0.0, "{total} {direct}");
}

fn walk(folder: &Path) -> Vec<PathBuf> {
    let mut list: Vec<PathBuf> = std::fs::read_dir(folder)
        .map(|entries| entries.flatten().map(|entry| entry.path()).collect())
        .unwrap_or_default();
    list.retain(|path| path.extension().is_some_and(|extension| extension == "xml"));
    list.sort();
    list
}
