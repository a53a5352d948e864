//! The window and its files: what is taken in and how, what is kept, what is written, what is said.

use crate::driven::{Idle, apply, frames, settle};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::import::proposal::Import;
use cfs::app::state::{PathUse, Sheet};
use cfs::catalogue::Grouping;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A window that computes nothing.
pub fn opened(app: App) -> Harness<'static, App> {
    let mut harness = frames(app, [1280.0, 720.0]);
    settle(&mut harness);
    harness
}

pub fn window() -> Harness<'static, App> {
    opened(App::for_test(Arc::new(Idle)))
}

/// A window whose session lies in a folder.
pub fn window_in(folder: &Path) -> Harness<'static, App> {
    let mut app = App::for_test(Arc::new(Idle));
    app.begin_session(Some(folder), true);
    opened(app)
}

pub fn import<'a>(harness: &'a Harness<'_, App>) -> &'a Import {
    harness.state().imports.open().expect("an import sheet")
}

/// Products with the keys of their states.
pub fn proposed(harness: &Harness<'_, App>) -> Vec<(String, Vec<String>)> {
    let keys =
        |product: &cfs::app::import::proposal::Proposed| product.datasets.iter().map(|one| one.state.clone()).collect();
    import(harness).products.iter().map(|product| (product.fields.name.clone(), keys(product))).collect()
}

pub fn products(harness: &Harness<'_, App>) -> usize {
    harness.state().shell.state.found.total
}

pub fn said(harness: &Harness<'_, App>) -> Vec<String> {
    harness.state().shell.toasts.all().map(|message| message.text.clone()).collect()
}

/// A diffuse sheet of this name in BSDF XML.
pub fn sheet(name: &str, tau: f64) -> String {
    let values = vec![format!("{}", tau / std::f64::consts::PI); 9].join(" ");
    let ring = |low: u32, high: u32, n: u32| {
        format!(
            "<AngleBasisBlock><Theta>{}</Theta><nPhis>{n}</nPhis><ThetaBounds><LowerTheta>{low}</LowerTheta>\
             <UpperTheta>{high}</UpperTheta></ThetaBounds></AngleBasisBlock>",
            f64::from(low + high) / 2.0
        )
    };
    format!(
        "<?xml version=\"1.0\"?><WindowElement xmlns=\"http://windows.lbl.gov\"><Optical><Layer><Material>\
         <Name>{name}</Name><Manufacturer>Nobody</Manufacturer></Material><DataDefinition>\
         <IncidentDataStructure>Columns</IncidentDataStructure><AngleBasis><AngleBasisName>Coarse</AngleBasisName>{}{}\
         </AngleBasis></DataDefinition><WavelengthData><LayerNumber>System</LayerNumber>\
         <Wavelength unit=\"Integral\">Visible</Wavelength><WavelengthDataBlock>\
         <WavelengthDataDirection>Transmission Front</WavelengthDataDirection>\
         <ColumnAngleBasis>Coarse</ColumnAngleBasis><RowAngleBasis>Coarse</RowAngleBasis>\
         <ScatteringDataType>BTDF</ScatteringDataType><ScatteringData>{values}</ScatteringData></WavelengthDataBlock>\
         </WavelengthData></Layer></Optical></WindowElement>",
        ring(0, 40, 1),
        ring(40, 90, 2)
    )
}

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(&path, text).unwrap();
    path
}

/// A venetian in two positions, a fabric, a honeycomb.
fn four(folder: &Path) -> Vec<PathBuf> {
    [("ven45", "Venetian", 0.2), ("fabric", "Satine", 0.1), ("ven0", "Venetian", 0.5), ("comb", "Honeycomb", 0.4)]
        .map(|(file, name, tau)| write(folder, &format!("{file}.xml"), &sheet(name, tau)))
        .to_vec()
}

#[test]
fn unlike_files_become_products_of_their_own_and_can_be_taken_otherwise_before_they_are_added() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window();
    let before = products(&harness);
    apply(&mut harness, Command::OpenPaths(four(folder.path())));
    let states = |list: &[&str]| list.iter().map(|&state| state.to_owned()).collect::<Vec<_>>();
    let expected = [("Venetian", &["0", "45"][..]), ("Satine", &[""]), ("Honeycomb", &[""])];
    let mut found = proposed(&harness);
    assert_eq!(found, expected.map(|(name, keys)| (name.to_owned(), states(keys))));
    // The list in words, with the unit.
    for label in ["3 products of 4 states", "Venetian: 0°, 45°", "Satine", "Honeycomb"] {
        assert!(harness.query_all_by_label(label).next().is_some(), "{label}");
    }
    harness.get_by_label("One product per file").click();
    settle(&mut harness);
    assert_eq!(proposed(&harness).len(), 4);
    harness.get_by_label("All one product").click();
    settle(&mut harness);
    found = proposed(&harness);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].1.len(), 4, "{found:?}");
    // What was typed stays with the files that it was typed for.
    harness.get_by_label("By angle").click();
    settle(&mut harness);
    let fields = cfs::app::import::proposal::ImportFields {
        name: "My fabric".into(),
        ..import(&harness).products[1].fields.clone()
    };
    apply(&mut harness, Command::EditImport(1, Box::new(fields)));
    apply(&mut harness, Command::GroupImport(Grouping::Each));
    assert!(proposed(&harness).iter().any(|one| one.0 == "My fabric"));
    apply(&mut harness, Command::GroupImport(Grouping::Proposed));
    harness.get_by_label("Add 3 products to catalogue").click();
    settle(&mut harness);
    assert_eq!(products(&harness), before + 3);
    let shelf = harness.state().shell.state.shelf().unwrap();
    let venetian = shelf.product("venetian").unwrap();
    assert_eq!(venetian.states.iter().map(|state| state.value).collect::<Vec<_>>(), [Some(0.0), Some(45.0)]);
    assert_eq!(shelf.product("my-fabric").unwrap().states.len(), 1);
    // One step took them in, one takes them out.
    let mut steps = 0;
    while products(&harness) != before && steps < 3 {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        settle(&mut harness);
        assert!([before, before + 3].contains(&products(&harness)), "all or none");
        steps += 1;
    }
    assert_eq!(products(&harness), before);
}

#[test]
fn the_same_again_is_told_before_it_is_added() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "screen.xml", &sheet("Screen", 0.3));
    let mut harness = window();
    let before = products(&harness);
    apply(&mut harness, Command::OpenPaths(vec![path.clone()]));
    apply(&mut harness, Command::AddImport);
    assert_eq!(products(&harness), before + 1);
    let other = harness.state().shell.state.found.entries[0].key.clone();
    apply(&mut harness, Command::Select(other));
    apply(&mut harness, Command::OpenPaths(vec![path]));
    assert!(harness.query_by_label("Already in the catalogue as Screen").is_some());
    apply(&mut harness, Command::AddImport);
    assert_eq!(products(&harness), before + 1, "not without being asked for");
    harness.get_by_label("Show").click();
    settle(&mut harness);
    assert_eq!(harness.state().shell.state.document.selection.product, "screen");
    harness.get_by_label("Add anyway").click();
    settle(&mut harness);
    harness.get_by_label("Add to catalogue").click();
    settle(&mut harness);
    assert_eq!(products(&harness), before + 2);
}

#[test]
fn a_folder_is_read_and_what_is_no_dataset_is_listed_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    four(folder.path());
    write(folder.path(), "deeper/still/other.xml", &sheet("Other", 0.6));
    for (name, text) in
        [("notes.pdf", "%PDF"), ("office.toml", "x"), ("damaged.xml", "<WindowElement>"), (".hidden", "")]
    {
        write(folder.path(), name, text);
    }
    let mut harness = window();
    apply(&mut harness, Command::OpenPaths(vec![folder.path().to_owned()]));
    assert_eq!(import(&harness).products.len(), 4);
    assert_eq!(import(&harness).failures.len(), 1);
    assert!(import(&harness).failures[0].starts_with("damaged.xml: "), "{:?}", import(&harness).failures);
    assert_eq!(
        import(&harness).left_out,
        ["notes.pdf: not a dataset (.xml, .btdf.txt, .cfsd)", "office.toml: a scene; open it by itself"]
    );
    assert!(harness.query_by_label("Skipped: 2 files").is_some());
    let empty = tempfile::tempdir().unwrap();
    apply(&mut harness, Command::OpenPaths(vec![empty.path().to_owned()]));
    assert!(import(&harness).left_out[0].contains("a folder without files"));
}

#[test]
fn a_typed_folder_is_opened_by_the_keyboard_alone_and_added_from_the_palette() {
    let folder = tempfile::tempdir().unwrap();
    four(folder.path());
    let mut harness = window();
    let before = products(&harness);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::O);
    settle(&mut harness);
    harness.get_by_role_and_label(Role::TextInput, "Path").type_text(&folder.path().display().to_string());
    settle(&mut harness);
    harness.key_press(Key::Enter);
    settle(&mut harness);
    assert_eq!(import(&harness).products.len(), 3);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::TextInput, "Command").type_text("add import to catalogue");
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    settle(&mut harness);
    assert_eq!(products(&harness), before + 3);
}

#[test]
fn a_scene_among_datasets_is_opened_and_the_datasets_go_to_the_sheet() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = window();
    let scene = folder.path().join("office.toml");
    apply(&mut harness, Command::Write(PathUse::SaveScene, scene.clone()));
    harness.key_press(Key::ArrowRight);
    settle(&mut harness);
    let moved = harness.state().shell.state.document.scene.clone();
    let blind = write(folder.path(), "blind.xml", &sheet("Blind", 0.3));
    let second = write(folder.path(), "second.toml", "");
    apply(&mut harness, Command::OpenPaths(vec![blind, scene.clone(), second]));
    assert_ne!(harness.state().shell.state.document.scene, moved);
    assert_eq!(harness.state().shell.state.scene_path, Some(scene));
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Import));
    assert_eq!(import(&harness).products.len(), 1);
    assert_eq!(import(&harness).left_out, ["second.toml: a scene; one at a time is opened"]);
}

#[test]
fn products_are_renamed_and_deleted_and_undo_and_the_list_bring_them_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "screen.xml", &sheet("Screen", 0.3));
    let mut harness = window();
    apply(&mut harness, Command::OpenPaths(vec![path]));
    apply(&mut harness, Command::AddImport);
    let total = products(&harness);
    let names = |harness: &Harness<'_, App>| -> Vec<String> {
        harness.state().shell.state.found.entries.iter().map(|entry| entry.name.clone()).collect()
    };
    harness.key_press(Key::F2);
    settle(&mut harness);
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Product));
    let field = harness.get_by_role_and_label(Role::TextInput, "Name");
    field.focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(1);
    harness.get_by_role_and_label(Role::TextInput, "Name").type_text("Awning");
    settle(&mut harness);
    harness.get_by_label("Save").click();
    settle(&mut harness);
    assert!(names(&harness).contains(&"Awning".to_owned()), "{:?}", names(&harness));
    apply(&mut harness, Command::Undo);
    assert!(names(&harness).contains(&"Screen".to_owned()), "{:?}", names(&harness));
    apply(&mut harness, Command::Redo);
    assert!(names(&harness).contains(&"Awning".to_owned()));
    // A right click on the row.
    harness.get_by_role_and_label(Role::ListBoxOption, "Awning").click_secondary();
    harness.run_steps(3);
    harness.get_by_label("Delete").click();
    settle(&mut harness);
    assert_eq!(products(&harness), total - 1);
    assert_ne!(harness.state().shell.state.document.selection.product, "screen", "another one is shown");
    apply(&mut harness, Command::Undo);
    assert_eq!(products(&harness), total);
    apply(&mut harness, Command::Redo);
    assert_eq!(products(&harness), total - 1);
    apply(&mut harness, Command::Sheet(Some(Sheet::Deleted)));
    harness.get_by_label("Restore Awning").click();
    settle(&mut harness);
    assert_eq!(products(&harness), total);
    assert!(harness.query_by_label("No deleted products.").is_some());
}

#[test]
fn a_file_that_exists_is_not_written_over_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "there.toml", "mine");
    let mut harness = window();
    apply(&mut harness, Command::SaveScene);
    let offered = harness.state().shell.state.path.clone();
    assert!(offered.ends_with("_2026-03-21T1200.toml"), "{offered}");
    apply(&mut harness, Command::EditPath(path.display().to_string()));
    harness.get_by_label("Save").click();
    settle(&mut harness);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
    assert!(harness.query_by_label("A file of this name already exists.").is_some());
    harness.get_by_label("Change the name").click();
    settle(&mut harness);
    assert!(harness.query_by_label("Replace").is_none());
    let other = folder.path().join("other.toml");
    apply(&mut harness, Command::EditPath(other.display().to_string()));
    harness.get_by_label("Save").click();
    settle(&mut harness);
    assert!(other.exists() && harness.state().shell.state.sheet.is_none());
    // Asked again for the first, and meant.
    apply(&mut harness, Command::WriteNew(PathUse::SaveScene, path.clone()));
    harness.get_by_label("Replace").click();
    settle(&mut harness);
    assert!(std::fs::read_to_string(&path).unwrap().contains("[room]"));
    // The folder is remembered, and the scene's own file is saved to without a question.
    assert_eq!(harness.state().shell.state.settings.folder.as_deref(), Some(folder.path()));
    apply(&mut harness, Command::WriteNew(PathUse::SaveScene, path));
    assert!(harness.state().shell.state.replace.is_none());
    apply(&mut harness, Command::ExportLid);
    assert!(harness.state().shell.state.path.starts_with(&folder.path().display().to_string()));
    assert!(harness.state().shell.state.path.ends_with("_2026-03-21T1200.ldt"), "{}", harness.state().shell.state.path);
}

#[test]
fn messages_leave_by_themselves_or_by_a_click_never_cover_the_status_line_and_stay_in_the_list() {
    let mut harness = window();
    apply(&mut harness, Command::OpenPaths(vec![PathBuf::from("/nowhere/at all/office.toml")]));
    let text = said(&harness).pop().expect("it is told");
    assert!(text.contains("/nowhere/at all/office.toml") && text.contains("check path and rights"), "{text}");
    let button = format!("Dismiss: {text}");
    let shown = harness.get_by_label(&button).rect();
    let status = harness.get_by_label("1 message").rect();
    assert!(shown.bottom() <= status.top(), "{shown:?} {status:?}");
    assert!(shown.right() <= 1280.0 && shown.left() >= 0.0, "{shown:?}");
    harness.get_by_label(&button).click();
    harness.run_steps(3);
    assert!(harness.query_by_label(&button).is_none());
    // A second one leaves by itself, unless the pointer is on it.
    harness.remove_cursor();
    apply(&mut harness, Command::OpenPaths(vec![PathBuf::from("/nowhere/b.toml")]));
    let second = format!("Dismiss: {}", said(&harness).pop().unwrap());
    assert!(harness.query_by_label(&second).is_some());
    let mut frames = 0;
    while harness.query_by_label(&second).is_some() {
        harness.step();
        frames += 1;
        assert!(frames < 5000, "it stays for ever");
    }
    harness.get_by_label("2 messages").click();
    harness.run_steps(3);
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Messages));
    assert!(harness.query_by_label(&text).is_some());
    harness.get_by_label("Clear all").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("No messages yet.").is_some());
}

/// Waits until the session on disk says something.
pub fn wait_for(folder: &Path, word: &str) -> Duration {
    let start = Instant::now();
    let says = || {
        std::fs::read_dir(folder).into_iter().flatten().flatten().any(|entry| {
            entry.path().extension().is_some_and(|ending| ending == "json")
                && std::fs::read_to_string(entry.path()).is_ok_and(|text| text.contains(word))
        })
    };
    while !says() {
        assert!(start.elapsed() < Duration::from_secs(20), "{word} is not kept");
        std::thread::sleep(Duration::from_millis(5));
    }
    start.elapsed()
}

/// As `kill -9` leaves it: files as they are, no lock.
pub fn killed(folder: &Path) -> tempfile::TempDir {
    let copy = tempfile::tempdir().unwrap();
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        std::fs::copy(entry.path(), copy.path().join(entry.file_name())).unwrap();
    }
    copy
}

#[test]
fn what_was_open_is_restored_after_a_kill_and_told_once() {
    let folder = tempfile::tempdir().unwrap();
    let files = tempfile::tempdir().unwrap();
    let mut harness = window_in(folder.path());
    harness.get_by_label("Ideal diffuser").click();
    settle(&mut harness);
    apply(&mut harness, Command::Hour(2));
    apply(&mut harness, Command::EditSystem("name = \"half typed".to_owned()));
    apply(&mut harness, Command::OpenPaths(four(files.path())));
    apply(&mut harness, Command::GroupImport(Grouping::Each));
    let fields = cfs::app::import::proposal::ImportFields { name: "Half named".into(), ..Default::default() };
    apply(&mut harness, Command::EditImport(2, Box::new(fields)));
    wait_for(folder.path(), "Half named");
    let title = cfs::app::title::title(&harness.state().shell.state);
    let left = killed(folder.path());
    let restored = window_in(left.path());
    assert_eq!(cfs::app::title::title(&restored.state().shell.state), title);
    assert!(title.contains("Ideal diffuser") && title.contains("14:00"), "{title}");
    assert_eq!(restored.state().goniophotometer.text(), "name = \"half typed");
    assert_eq!((import(&restored).grouping, import(&restored).products.len()), (Grouping::Each, 4));
    assert_eq!(import(&restored).products[2].fields.name, "Half named");
    assert_eq!(said(&restored).iter().filter(|text| text.starts_with("Session of ")).count(), 1);
    // Closed in order, the next one starts there without a word.
    let mut restored = restored;
    restored.state_mut().close();
    drop(restored);
    let next = window_in(left.path());
    assert_eq!(cfs::app::title::title(&next.state().shell.state), title);
    assert!(said(&next).is_empty(), "{:?}", said(&next));
}

#[test]
fn an_import_that_is_being_stored_is_not_lost_and_a_closing_window_waits_for_it() {
    let folder = tempfile::tempdir().unwrap();
    let files = tempfile::tempdir().unwrap();
    let mut harness = window_in(folder.path());
    let before = products(&harness);
    apply(&mut harness, Command::OpenPaths(four(files.path())));
    harness.state_mut().apply(Command::AddImport);
    assert!(harness.state().imports.open().is_none() && harness.state().imports.under_way().is_some());
    let shelf = harness.state().shell.state.shelf().unwrap();
    harness.state_mut().close();
    let total = shelf.search(&cfs::app::catalogue::shelf::Query::default()).unwrap().total;
    assert_eq!(total, before + 3);
    assert!(harness.state().imports.under_way().is_none());
}
