//! Handing on: one sheet with a preview, whose files say what the window shows.

use crate::driven::{apply, coarsen, frames, select, settle};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::compare::view::Act;
use cfs::app::display::language::LanguageChoice;
use cfs::app::export::choices::{Choices, Preview, ReportKind, What};
use cfs::app::results::backend::{StudyEngine, memory_shelf};
use cfs::app::state::{PathUse, Sheet};
use cfs::app::tiles::TILES;
use cfs::drawing::ticks::si;
use cfs::formats::{eulumdat, package, read_dataset};
use cfs::report::TileKind;
use cfs::study::{SceneFile, luminaires};
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::path::Path;
use std::sync::Arc;

/// A window with a moving product and few sensors, its sheet open by the keyboard.
fn window() -> Harness<'static, App> {
    let app = App::with_shelf(Arc::new(StudyEngine::default()), memory_shelf);
    let mut harness = frames(app, [1280.0, 720.0]);
    coarsen(&mut harness, [3, 4]);
    settle(&mut harness);
    select(&mut harness, |entry| entry.key == "venetian-80-72");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::E);
    settle(&mut harness);
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Export));
    harness
}

fn choose(harness: &mut Harness<'_, App>, change: impl FnOnce(&mut Choices)) {
    let mut choices = harness.state().shell.state.settings.export.clone();
    change(&mut choices);
    apply(harness, Command::ExportChoices(Box::new(choices)));
}

/// Writes under the name that is offered, into a folder; the name.
fn write(harness: &mut Harness<'_, App>, folder: &Path) -> String {
    let name = Path::new(&harness.state().shell.state.path).file_name().unwrap().to_str().unwrap().to_owned();
    apply(harness, Command::EditPath(folder.join(&name).display().to_string()));
    harness.get_by_label("Write").click();
    settle(harness);
    name
}

fn preview<'a>(harness: &'a Harness<'_, App>) -> &'a Preview {
    match harness.state().export.preview().expect("a preview") {
        Ok(preview) => preview,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn every_kind_is_previewed_and_written_under_the_name_that_is_offered() {
    let mut harness = window();
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let state = harness.state().shell.state.shown_state.clone();

    choose(&mut harness, |choices| (choices.what, choices.vector) = (What::Picture, true));
    assert!(matches!(preview(&harness), Preview::Picture([w, h], pixels, said)
        if pixels.len() == 3 * w * h && *w == 900 && said.contains("1600x1200")));
    let name = write(&mut harness, folder);
    assert_eq!(name, format!("venetian-80-72_{state}_2026-03-21T1200_room.svg"));
    let svg = String::from_utf8(read(&name)).unwrap();
    // The picture has the window's own figures.
    let room = harness.state().shell.results.room.value.clone().unwrap();
    let mean = room.totals().map(|total| total.value).sum::<f64>() / room.totals().count() as f64;
    assert!(svg.contains(&format!("mean {} · min", si(mean, "lx"))), "{mean}");

    choose(&mut harness, |choices| choices.vector = false);
    let name = write(&mut harness, folder);
    let png = image::load_from_memory(&read(&name)).unwrap();
    assert!(name.ends_with("_room.png") && (png.width(), png.height()) == (1600, 1200));

    for kind in [ReportKind::Study, ReportKind::Sheet] {
        choose(&mut harness, |choices| (choices.what, choices.report) = (What::Report, kind));
        assert!(matches!(preview(&harness), Preview::Picture(_, _, said) if said.starts_with("page 1 of ")));
        assert!(read(&write(&mut harness, folder)).starts_with(b"%PDF-"));
    }

    choose(&mut harness, |choices| choices.what = What::Luminaire);
    assert!(matches!(preview(&harness), Preview::Text(text, size) if text.lines().count() == 40 && *size > 1000));
    let flux = harness.state().shell.results.lid.value.as_ref().unwrap().flux.value;
    let written = eulumdat::read(&read(&write(&mut harness, folder))).unwrap();
    assert!((written.flux() / flux - 1.0).abs() < 2e-3);

    // No year was computed, and nothing ranked.
    for tile in TileKind::ALL.into_iter().filter(|tile| !matches!(tile, TileKind::Year | TileKind::Choose)) {
        choose(&mut harness, |choices| (choices.what, choices.tile) = (What::Table, tile));
        let name = write(&mut harness, folder);
        assert!(String::from_utf8(read(&name)).unwrap().lines().count() > 5, "{name}");
    }

    choose(&mut harness, |choices| choices.what = What::Dataset);
    let name = write(&mut harness, folder);
    let data = read_dataset(&name, &read(&name)).unwrap();
    let shown = harness.state().shell.state.dataset.value.clone().unwrap();
    let tau = |one: &cfs::compute::btdf::Dataset| one.transmission().unwrap().tau_hemispherical();
    assert!((tau(&data[0]) - tau(&shown)).abs() < 2e-2, "{} {}", tau(&data[0]), tau(&shown));

    choose(&mut harness, |choices| choices.what = What::Scene);
    let name = write(&mut harness, folder);
    let scene = SceneFile::parse(std::str::from_utf8(&read(&name)).unwrap()).unwrap();
    assert_eq!(scene, harness.state().shell.state.document.scene);
    // Nothing half-written stays, and no other file came.
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), 2 + 2 + 1 + 6 + 1 + 1);
    assert_eq!(harness.state().shell.state.settings.folder.as_deref(), Some(folder));
}

#[test]
fn a_product_goes_out_as_a_package_with_its_states() {
    let mut harness = window();
    // Of one state: the others of a blind would have to be computed first.
    select(&mut harness, |entry| entry.key == "clear-single");
    let folder = tempfile::tempdir().unwrap();
    choose(&mut harness, |choices| choices.what = What::Package);
    assert!(
        matches!(preview(&harness), Preview::Files(files) if files.len() == 1 && files[0].1.starts_with("one state"))
    );
    let name = write(&mut harness, folder.path());
    let read = package::read(&std::fs::read(folder.path().join(&name)).unwrap()).unwrap();
    assert_eq!((name.as_str(), read.products.len()), ("clear-single.cfsp", 1));
}

#[test]
fn a_series_has_an_index_that_names_every_file() {
    let mut harness = window();
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    choose(&mut harness, |choices| {
        choices.what = What::Series;
        choices.series.months = std::array::from_fn(|month| month == 2 || month == 11);
        (choices.series.hours, choices.series.step) = ([11, 17], 3);
    });
    // In December the sun is down at 17 h.
    let Preview::Files(files) = preview(&harness) else { panic!("files") };
    let promised: Vec<String> = files.iter().map(|(name, _)| name.clone()).collect();
    assert_eq!(promised.len(), 1 + 3 + 2);
    let name = write(&mut harness, folder);
    let index = std::fs::read_to_string(folder.join(&name)).unwrap();
    let rows: Vec<Vec<&str>> = index.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 5);
    for row in &rows {
        assert!(promised.iter().any(|one| one == row[0]), "{row:?}");
        let file = eulumdat::read(&std::fs::read(folder.join(row[0])).unwrap()).unwrap();
        let flux: f64 = row[6].parse().unwrap();
        assert!((file.flux() / flux - 1.0).abs() < 5e-3, "{row:?} {}", file.flux());
    }
    assert!(rows[0][15] == "2026-03-21T11:00" && rows[0][0].ends_with("_03-21T1100.ldt"), "{:?}", rows[0]);
    // One file of the series that is there already is asked about as the index is.
    std::fs::remove_file(folder.join(&name)).unwrap();
    harness.get_by_label("Write").click();
    settle(&mut harness);
    harness.get_by_label("Files of these names already exist.");
    assert!(!folder.join(&name).exists());
    harness.get_by_label("Replace").click();
    settle(&mut harness);
    assert!(folder.join(&name).exists() && harness.state().shell.state.sheet == Some(Sheet::Export));
    // Nothing is left where not all of it can be written.
    let nowhere = folder.join("not-there/x_index.csv");
    apply(&mut harness, Command::Write(PathUse::Export, nowhere));
    assert!(!folder.join("not-there").exists());
    // Too many, and none.
    choose(&mut harness, |choices| {
        choices.series.months = [true; 12];
        (choices.series.hours, choices.series.step, choices.series.all_states) = ([0, 23], 1, true);
    });
    let error = harness.state().export.preview().unwrap().as_ref().err().unwrap().clone();
    assert!(error.contains("expected at most 600"), "{error}");
    choose(&mut harness, |choices| choices.series.months = [false; 12]);
    let error = harness.state().export.preview().unwrap().as_ref().err().unwrap().clone();
    assert!(error.contains("no file would be written"), "{error}");
}

#[test]
fn a_window_goes_out_in_tiles_that_are_one_aperture_again() {
    let mut harness = window();
    select(&mut harness, |entry| entry.key == "clear-single");
    let folder = tempfile::tempdir().unwrap();
    choose(&mut harness, |choices| {
        choices.what = What::Luminaire;
        (choices.tiles, choices.without_beam) = (true, true);
    });
    let Preview::Files(files) = preview(&harness) else { panic!("files") };
    let (names, words): (Vec<String>, Vec<String>) = files.iter().cloned().unzip();
    assert!(names[0].ends_with(".index.csv") && names[1].ends_with("_1.ldt"), "{names:?}");
    // Nothing is computed before it is asked for.
    assert!(words[0].contains("list of the luminaires") && words[1] == "the first luminaire", "{words:?}");
    write(&mut harness, folder.path());
    let own = folder.path().join(names[0].trim_end_matches(".index.csv"));
    let back = luminaires::read(&own.join(&names[0]), None).unwrap();
    let files = |folder: &Path| std::fs::read_dir(folder).unwrap().count();
    assert_eq!((files(folder.path()), files(&own)), (1, back.rows.len() + 1));
    assert!(back.rows.len() > 1 && own.join(&names[1]).exists());
    let size = harness.state().shell.state.document.scene.aperture[0].size;
    assert!((back.aperture.size[0] - size[0]).abs() < 1e-3 && (back.aperture.size[1] - size[1]).abs() < 1e-3);
    // The straight beam stands in the index, not in the files.
    assert!(back.rows.iter().all(|row| row.beam == 0.0 && row.separate_beam.is_some_and(|apart| apart.flux > 1.0)));
}

#[test]
fn what_exists_is_asked_about_and_an_own_name_is_kept() {
    let mut harness = window();
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("Büro Süd.png");
    std::fs::write(&own, "mine").unwrap();
    apply(&mut harness, Command::EditPath(own.display().to_string()));
    harness.get_by_label("Write").click();
    settle(&mut harness);
    harness.get_by_label("A file of this name already exists.");
    assert_eq!(std::fs::read(&own).unwrap(), b"mine");
    // Another form: the own name stays, with its ending.
    choose(&mut harness, |choices| choices.vector = true);
    assert!(harness.state().shell.state.path.ends_with("Büro Süd.svg"), "{}", harness.state().shell.state.path);
    harness.get_by_label("Write").click();
    settle(&mut harness);
    assert!(std::fs::read_to_string(folder.path().join("Büro Süd.svg")).unwrap().starts_with("<svg"));
    // A name that says something else is told, and nothing written.
    let wrong = folder.path().join("a.pdf");
    apply(&mut harness, Command::Write(PathUse::Export, wrong.clone()));
    assert!(!wrong.exists());
    assert!(harness.state().shell.toasts.all().any(|message| message.text.contains("end in .svg")));
    // A tender text with a wrong field is told where the preview stands.
    choose(&mut harness, |choices| {
        (choices.what, choices.report) = (What::Report, ReportKind::Sheet);
        choices.tender = "{colour}".to_owned();
    });
    let error = harness.state().export.preview().unwrap().as_ref().err().unwrap().clone();
    assert!(error.contains("line 1") && error.contains("{colour} is not a field"), "{error}");
}

#[test]
fn the_former_exports_lead_into_the_sheet() {
    let mut harness = window();
    apply(&mut harness, Command::Sheet(None));
    assert!(harness.state().export.preview().is_none(), "a closed sheet keeps no preview");
    apply(&mut harness, Command::ExportLid);
    let state = &harness.state().shell.state;
    assert!(state.settings.export.what == What::Luminaire && state.path.ends_with(".ldt"));
    let lid = TILES.iter().map(|entry| entry.tile).find(|tile| tile.title == "LID").unwrap();
    apply(&mut harness, Command::ExportTile(lid));
    let choices = &harness.state().shell.state.settings.export;
    assert_eq!((choices.what, choices.tile), (What::Picture, TileKind::Lid));
    // What is chosen goes with the scene: another hour, another picture.
    let before = harness.state().export.revision();
    apply(&mut harness, Command::Hour(1));
    assert!(harness.state().export.revision() > before);
}

/// Pages that the preview of a report speaks of.
fn pages(harness: &Harness<'_, App>) -> usize {
    let Preview::Picture(_, _, said) = preview(harness) else { panic!("a page") };
    said.split_whitespace().filter_map(|word| word.trim_matches(',').parse().ok()).max().unwrap()
}

#[test]
fn a_study_brings_the_tray_along_unless_it_is_left_out() {
    let mut harness = window();
    choose(&mut harness, |choices| (choices.what, choices.report) = (What::Report, ReportKind::Study));
    let alone = pages(&harness);
    for key in ["clear-double", "ideal-diffuser"] {
        apply(&mut harness, Command::Compare(Act::AddProduct(key.to_owned())));
    }
    let compared = pages(&harness);
    assert!(compared > alone, "{compared} {alone}");
    // Another tile is another preview.
    let before = harness.state().export.revision();
    apply(&mut harness, Command::Compare(Act::Tile("LID")));
    assert!(harness.state().export.revision() > before);
    choose(&mut harness, |choices| choices.comparison = false);
    assert_eq!(pages(&harness), alone);
}

#[test]
fn what_is_handed_on_speaks_the_language_of_the_window() {
    let mut harness = window();
    choose(&mut harness, |choices| (choices.what, choices.vector) = (What::Picture, true));
    apply(&mut harness, Command::Language(LanguageChoice::German));
    harness.get_by_label("Vorschau");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("raum.svg");
    // By its button: a job speaks what the window speaks as it starts it.
    apply(&mut harness, Command::EditPath(path.display().to_string()));
    harness.get_by_label("Schreiben").click();
    settle(&mut harness);
    let svg = std::fs::read_to_string(&path).unwrap();
    let room = harness.state().shell.results.room.value.clone().unwrap();
    let mean = room.totals().map(|total| total.value).sum::<f64>() / room.totals().count() as f64;
    let german = cfs::texts::speak(cfs::texts::Language::German);
    assert!(svg.contains(&format!("Mittel {} · Min.", si(mean, "lx"))), "{mean}");
    drop(german);
    assert!(svg.contains("21. März 12:00 Uhr") && !svg.contains(">mean "));
    // The scene is written as ever.
    choose(&mut harness, |choices| choices.what = What::Scene);
    let Preview::Text(text, _) = preview(&harness) else { panic!("no text") };
    assert!(text.contains("[room]") && text.contains("floor = 0.2"), "{text}");
}
