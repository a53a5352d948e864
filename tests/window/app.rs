//! The window without a display: driven by labels, keys and scripted services, checked by what it then knows and says.

use crate::driven::{frames, settle, step_until};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::display::theme::ThemeChoice;
use cfs::app::results::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures};
use cfs::app::shell::error::AppError;
use cfs::app::state::Sheet;
use cfs::app::tiles::compared;
use cfs::compute::estimate::{Cancelled, Estimate, Progress};
use cfs::study::accuracy::Accuracy;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Answers at once, or runs until withdrawn when the scene's floor reflectance is 0.13.
#[derive(Default)]
struct Scripted {
    started: AtomicUsize,
    withdrawn: AtomicUsize,
}

const SLOW: f64 = 0.13;

impl Engine for Scripted {
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        self.started.fetch_add(1, Ordering::SeqCst);
        if question.scene.room.reflectance.floor == SLOW {
            let start = Instant::now();
            while !progress.cancelled() && start.elapsed() < Duration::from_secs(20) {
                std::thread::sleep(Duration::from_millis(1));
            }
            self.withdrawn.fetch_add(1, Ordering::SeqCst);
            return Err(AppError::Study(Cancelled.into()));
        }
        if question.scene.room.reflectance.ceiling == SLOW {
            panic!("a fault on purpose");
        }
        let sensors = vec![[2.0, 3.0, 0.85]];
        let estimate = vec![Estimate::new(500.0, 2.0)];
        let grid = Some([1, 1]);
        Ok(RoomFigures {
            positions: sensors,
            direct: estimate.clone(),
            interreflected: estimate,
            grid,
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

fn window() -> (Harness<'static, App>, Arc<Scripted>) {
    let engine = Arc::new(Scripted::default());
    let mut harness = frames(App::for_test(engine.clone()), [1280.0, 720.0]);
    settle(&mut harness);
    (harness, engine)
}

/// Title of the tile that fills the bench.
fn maximised(harness: &Harness<'_, App>) -> Option<&'static str> {
    harness.state().shell.state.maximised.map(|tile| tile.title)
}

fn title(harness: &Harness<'_, App>) -> String {
    cfs::app::title::title(&harness.state().shell.state)
}

#[test]
fn a_first_start_shows_six_tiles_of_a_product_at_a_place_and_time() {
    let (harness, _) = window();
    for title in compared().map(|tile| tile.title) {
        assert!(harness.query_by_label(&format!("Tile {title}")).is_some(), "{title}");
    }
    let title = title(&harness);
    for word in ["Stuttgart", "south", "21 Mar 12:00", "clear"] {
        assert!(title.contains(word), "{title}");
    }
    let app = harness.state();
    assert!(app.shell.results.room.value.is_some() && !app.shell.results.room.stale);
    assert!(app.shell.state.daylight.value.is_some() && app.shell.state.dataset.value.is_some());
}

#[test]
fn typing_in_the_search_field_filters_the_list() {
    let (mut harness, _) = window();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::F);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::TextInput, "Search").type_text("diffus");
    settle(&mut harness);
    assert!(harness.query_by_role_and_label(Role::ListBoxOption, "Ideal diffuser").is_some());
    assert!(harness.query_by_role_and_label(Role::ListBoxOption, "Clear opening").is_none());
    // Digits typed there are text, not "maximise".
    harness.get_by_role_and_label(Role::TextInput, "Search").type_text("1");
    harness.key_press(Key::Num1);
    settle(&mut harness);
    assert_eq!(maximised(&harness), None);
    assert!(harness.query_by_label("No product contains all these words.").is_some());
}

#[test]
fn selecting_a_product_changes_title_dataset_and_aperture_and_undo_takes_it_back() {
    let (mut harness, _) = window();
    let before = harness.state().shell.state.document.clone();
    assert!(title(&harness).contains("Clear opening"));
    harness.get_by_label("Ideal diffuser").click();
    settle(&mut harness);
    assert!(title(&harness).contains("Ideal diffuser"), "{}", title(&harness));
    let dataset = harness.state().shell.state.dataset.value.clone().unwrap();
    assert!((dataset.transmission().unwrap().tau_normal() - 0.6).abs() < 1e-12);
    for redo in [(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z), (Modifiers::COMMAND, Key::Y)] {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        settle(&mut harness);
        assert_eq!(harness.state().shell.state.document, before);
        harness.key_press_modifiers(redo.0, redo.1);
        settle(&mut harness);
        assert!(title(&harness).contains("Ideal diffuser"), "{redo:?}");
    }
}

#[test]
fn keys_maximise_tiles_and_move_the_clock() {
    let (mut harness, _) = window();
    harness.key_press(Key::Num3);
    harness.run_steps(2);
    assert_eq!(maximised(&harness), Some("Sky"));
    assert!(harness.query_by_label("Tile Room").is_none());
    harness.key_press(Key::Num0);
    harness.key_press(Key::ArrowRight);
    harness.key_press(Key::ArrowUp);
    settle(&mut harness);
    assert_eq!(harness.state().shell.state.maximised, None);
    assert!(title(&harness).contains("22 Mar 13:00"), "{}", title(&harness));
    harness.key_press_modifiers(Modifiers::SHIFT, Key::ArrowLeft);
    settle(&mut harness);
    assert!(title(&harness).contains("22 Mar 10:00"), "{}", title(&harness));
}

#[test]
fn arrow_keys_belong_to_an_open_list() {
    let (mut harness, _) = window();
    let list = harness.query_all_by_role(egui::accesskit::Role::ComboBox).next().expect("the scene has lists");
    list.click();
    harness.run_steps(3);
    assert!(egui::Popup::is_any_open(&harness.ctx));
    let before = title(&harness);
    harness.key_press(Key::ArrowDown);
    harness.key_press(Key::ArrowUp);
    harness.key_press(Key::ArrowUp);
    settle(&mut harness);
    assert_eq!(title(&harness), before);
}

#[test]
fn a_later_hour_gives_another_sky_and_another_room_job() {
    let (mut harness, engine) = window();
    let before = engine.started.load(Ordering::SeqCst);
    let sky = harness.state().shell.state.daylight.value.clone().unwrap();
    harness.key_press(Key::ArrowRight);
    settle(&mut harness);
    assert!(engine.started.load(Ordering::SeqCst) > before);
    let later = harness.state().shell.state.daylight.value.clone().unwrap();
    assert!(later.outside.diffuse_horizontal() != sky.outside.diffuse_horizontal());
}

#[test]
fn a_slow_job_never_holds_a_frame_and_is_withdrawn_by_the_next_change() {
    let (mut harness, engine) = window();
    let before = engine.started.load(Ordering::SeqCst);
    harness.state_mut().shell.state.document.scene.room.reflectance.floor = SLOW;
    step_until(&mut harness, "the slow job runs", |_| engine.started.load(Ordering::SeqCst) > before);
    assert!(harness.state().busy() && harness.state().shell.results.room.stale);
    let start = Instant::now();
    let ctx = harness.ctx.clone();
    harness.state_mut().logic(&ctx);
    assert!(start.elapsed() < Duration::from_millis(100), "{:?}", start.elapsed());
    harness.state_mut().shell.state.document.scene.room.reflectance.floor = 0.3;
    settle(&mut harness);
    step_until(&mut harness, "the slow job ends", |_| engine.withdrawn.load(Ordering::SeqCst) == 1);
    assert!(!harness.state().shell.results.room.stale);
}

#[test]
fn a_fault_in_a_job_is_told_and_the_window_lives_on() {
    let (mut harness, _) = window();
    harness.state_mut().shell.state.document.scene.room.reflectance.ceiling = SLOW;
    settle(&mut harness);
    assert!(harness.state().shell.results.room.error.as_deref().unwrap().contains("a fault on purpose"));
    harness.state_mut().shell.state.document.scene.room.reflectance.ceiling = 0.8;
    settle(&mut harness);
    assert!(harness.state().shell.results.room.error.is_none() && !harness.state().shell.results.room.stale);
}

fn products(harness: &Harness<'_, App>) -> usize {
    harness.state().shell.state.found.total
}

fn open(harness: &mut Harness<'_, App>, path: &Path) {
    use cfs::app::command::Command;
    harness.state_mut().apply(Command::OpenPaths(vec![path.to_owned()]));
    settle(harness);
}

#[test]
fn a_damaged_file_is_told_and_leaves_the_catalogue_as_it_was() {
    let (mut harness, _) = window();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("damaged.xml");
    std::fs::write(&path, "<WindowElement><Optical>").unwrap();
    open(&mut harness, &path);
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Import));
    let failure = harness.state().imports.open().unwrap().failures[0].clone();
    assert!(failure.starts_with("damaged.xml: "), "{failure}");
    assert!(harness.query_by_label(&failure).is_some());
    assert!(harness.query_by_label("Add to catalogue").is_none());
    harness.get_by_label("Discard").click();
    settle(&mut harness);
    assert_eq!(products(&harness), 2);
    assert!(harness.state().imports.open().is_none());
}

/// A file with a basis of its own: three rings, and the same 0.15 1/sr from everywhere to everywhere.
fn small_dataset() -> String {
    let limits = [(0.0, 30.0, 1), (30.0, 60.0, 2), (60.0, 90.0, 2)];
    let mut rows = String::new();
    for (low, high, n) in limits {
        rows += &format!(
            "<AngleBasisBlock><Theta>{}</Theta><nPhis>{n}</nPhis><ThetaBounds><LowerTheta>{low}</LowerTheta>\
             <UpperTheta>{high}</UpperTheta></ThetaBounds></AngleBasisBlock>",
            0.5 * (low + high)
        );
    }
    let values = vec!["0.15"; 25].join(" ");
    format!(
        "<?xml version=\"1.0\"?><WindowElement xmlns=\"http://windows.lbl.gov\"><Optical><Layer><Material>\
         <Name>Test screen</Name><Manufacturer>Nobody</Manufacturer></Material><DataDefinition>\
         <IncidentDataStructure>Columns</IncidentDataStructure><AngleBasis><AngleBasisName>Coarse</AngleBasisName>{rows}\
         </AngleBasis></DataDefinition><WavelengthData><LayerNumber>System</LayerNumber>\
         <Wavelength unit=\"Integral\">Visible</Wavelength><WavelengthDataBlock>\
         <WavelengthDataDirection>Transmission Front</WavelengthDataDirection>\
         <ColumnAngleBasis>Coarse</ColumnAngleBasis><RowAngleBasis>Coarse</RowAngleBasis>\
         <ScatteringDataType>BTDF</ScatteringDataType><ScatteringData>{values}</ScatteringData></WavelengthDataBlock>\
         </WavelengthData></Layer></Optical></WindowElement>"
    )
}

#[test]
fn an_import_is_stored_on_request_alone_and_undo_takes_it_out_and_redo_puts_it_back() {
    let (mut harness, _) = window();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("screen.xml");
    std::fs::write(&path, small_dataset()).unwrap();
    open(&mut harness, &path);
    let import = harness.state().imports.open().unwrap();
    assert!(import.failures.is_empty(), "{:?}", import.failures);
    let fields = &import.products[0].fields;
    assert_eq!((fields.name.as_str(), fields.manufacturer.as_str()), ("Test screen", "Nobody"));
    assert_eq!(products(&harness), 2);
    harness.get_by_label("Add to catalogue").click();
    settle(&mut harness);
    assert_eq!(products(&harness), 3);
    assert!(title(&harness).contains("Test screen"), "{}", title(&harness));
    for _ in 0..3 {
        if products(&harness) == 3 {
            harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
            settle(&mut harness);
        }
    }
    assert_eq!(products(&harness), 2);
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    settle(&mut harness);
    assert_eq!(products(&harness), 3);
}

#[test]
fn a_scene_is_saved_and_read_back_as_it_was() {
    use cfs::app::command::Command;
    use cfs::app::state::PathUse;
    let (mut harness, _) = window();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    harness.state_mut().apply(Command::Write(PathUse::SaveScene, path.clone()));
    settle(&mut harness);
    let scene = harness.state().shell.state.document.scene.clone();
    harness.key_press(Key::ArrowRight);
    settle(&mut harness);
    assert_ne!(harness.state().shell.state.document.scene, scene);
    open(&mut harness, &path);
    assert_eq!(harness.state().shell.state.document.scene, scene);
}

#[test]
fn the_palette_finds_a_command_by_its_words() {
    let (mut harness, _) = window();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::TextInput, "Command").type_text("maximise lid");
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert_eq!(maximised(&harness), Some("LID"));
    assert!(harness.state().shell.state.palette.is_none());
}

/// Seven incidences of no lattice: with the light from the right brighter.
fn listed_dataset(state: &str) -> String {
    let mut text = format!(
        "---\nformat = \"cfs-btdf 1\"\nname = \"Sample\"\nkind = \"panel\"\nstate = \"{state}\"\nquantity = \"btdf\"\n\
         light_from = \"outside\"\nlayout = \"rings\"\nrings = [[90.0, 180.0, 4]]\nincidence = \"listed\"\n\
         incident_mean = false\n---\n"
    );
    for (theta, phi, q) in
        [(0, 0, 0.2), (35, 0, 0.3), (35, 90, 0.1), (35, 180, 0.1), (70, 45, 0.1), (70, 135, 0.1), (75, 270, 0.05)]
    {
        text += &format!("{theta} {phi} {q} {q} {q} {q}\n");
    }
    text
}

#[test]
fn measured_states_come_in_together_and_a_click_chooses_a_measured_incidence() {
    use cfs::app::command::Command;
    let (mut harness, _) = window();
    let folder = tempfile::tempdir().unwrap();
    let paths = ["a", "b"].map(|state| {
        let path = folder.path().join(format!("{state}.btdf.txt"));
        std::fs::write(&path, listed_dataset(state)).unwrap();
        path
    });
    harness.state_mut().apply(Command::OpenPaths(paths.to_vec()));
    settle(&mut harness);
    let import = harness.state().imports.open().unwrap();
    assert!(import.failures.is_empty(), "{:?}", import.failures);
    assert_eq!(import.products.len(), 1);
    assert_eq!((import.products[0].datasets.len(), import.products[0].fields.kind.as_str()), (2, "panel"));
    harness.get_by_label("Add to catalogue").click();
    settle(&mut harness);
    assert_eq!(harness.state().shell.state.product.as_ref().unwrap().states.len(), 2);
    // Somewhere between the directions: the nearest one is chosen, not the middle of a cell.
    let disk = harness.get_by_label("Incident hemisphere").rect();
    // Seen from inside the right of the façade is on the left.
    let at = disk.center() - egui::vec2(0.25 * disk.width(), 0.0);
    harness.hover_at(at);
    harness.run_steps(2);
    harness.drag_at(at);
    harness.run_steps(2);
    harness.drop_at(at);
    settle(&mut harness);
    let chosen = harness.get_by_label("Incident hemisphere").value().unwrap();
    // 0.3/sr into π of projected solid angle.
    assert!(chosen.contains("θ 35°, φ 0°") && chosen.contains("0.942"), "{chosen}");
}

#[test]
fn a_command_that_is_typed_and_entered_at_once_closes_the_palette() {
    let (mut harness, _) = window();
    harness.state_mut().apply(Command::Palette);
    harness.run_steps(3);
    // A slow frame takes in both.
    harness.event(egui::Event::Text("theme light".to_owned()));
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().shell.state.palette, None);
    assert_eq!(harness.state().shell.state.settings.theme, ThemeChoice::Light);
}
