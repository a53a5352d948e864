//! A year in the window: asked for, computed, looked at, an hour of it picked, handed on; and the weather's calendar.

use crate::driven::{apply, coarsen, frames, settle, step_until};
use crate::legible::can_be_read;
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::export::choices::{Preview, What};
use cfs::app::results::backend::{StudyEngine, ideals_shelf};
use cfs::app::scene::moment;
use cfs::app::shell::jobs::Lane;
use cfs::app::tiles::YEAR;
use cfs::app::year::input::YearAct;
use cfs::report::TileKind;
use cfs::study::scene_file::SkyModelKey;
use cfs::study::weather::YEARS;
use cfs::study::year::{Look, Page, Shows};
use egui::{Key, Pos2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::path::PathBuf;
use std::sync::Arc;

const MAP: &str = "Hours of the year: Mean illuminance";

/// A window on the ideal diffuser with four sensors, the year filling the bench.
fn window() -> Harness<'static, App> {
    let app = App::with_shelf(Arc::new(StudyEngine::default()), ideals_shelf);
    let mut harness = frames(app, [1280.0, 720.0]);
    coarsen(&mut harness, [2, 2]);
    settle(&mut harness);
    let found = harness.state().shell.state.found.clone();
    let diffuser = found.entries.iter().find(|entry| entry.name == "Ideal diffuser").unwrap().key.clone();
    apply(&mut harness, Command::Select(diffuser));
    apply(&mut harness, Command::Maximise(Some(YEAR)));
    harness
}

fn computed() -> Harness<'static, App> {
    let mut harness = window();
    harness.get_by_label("Compute a year").click();
    step_until(&mut harness, "the year begins", |app| {
        app.works_in(Lane::Annual) || app.shell.results.annual.value.is_some()
    });
    settle(&mut harness);
    harness
}

/// Where an hour stands on a map of 365 days.
fn place(harness: &Harness<'_, App>, map: &str, day: f32, hour: f32) -> Pos2 {
    let area = harness.get_by_label(map).rect();
    pos2(area.left() + area.width() * (day + 0.5) / 365.0, area.bottom() - area.height() * (hour + 0.5) / 24.0)
}

fn click(harness: &mut Harness<'_, App>, at: Pos2) {
    harness.hover_at(at);
    harness.run_steps(1);
    harness.drag_at(at);
    harness.run_steps(1);
    harness.drop_at(at);
    harness.run_steps(1);
    settle(harness);
}

#[test]
fn a_scene_without_a_year_is_given_one_computed_and_asked_back() {
    let mut harness = computed();
    let app = harness.state();
    let keys = app.shell.state.document.scene.year.clone().expect("the scene has a year");
    // The nearest to Stuttgart of those that come with the program.
    assert_eq!(keys.weather, PathBuf::from("builtin:piedmont"));
    let annual =
        app.shell.results.annual.value.clone().unwrap_or_else(|| panic!("{:?}", app.shell.results.annual.error));
    assert_eq!((annual.year.steps.list.len(), annual.year.light.places), (8760, 4 + 1));
    assert!(harness.query_by_label(MAP).is_some() && harness.query_by_label("Compute a year").is_none());
    // Its figures, as the study has them.
    let da = annual.figures[0].autonomy.da_300.iter().sum::<f64>() / 4.0;
    apply(&mut harness, Command::Year(YearAct::Look(Look { page: Page::Figures, ..Look::default() })));
    assert!(harness.query_by_label("DA300").is_some());
    assert!(harness.query_all_by_label_contains(&format!("{:.1} ± ", 100.0 * da)).count() > 0, "{da}");
    // Another room: what is shown is said to be of before, until it is computed again.
    let mut scene = harness.state().shell.state.document.scene.clone();
    scene.room.reflectance.walls = 0.7;
    apply(&mut harness, Command::Scene(Box::new(scene)));
    assert!(harness.query_by_label("outdated").is_some());
    harness.get_by_label("Compute again").click();
    harness.run_steps(2);
    assert!(harness.state().works_in(Lane::Annual) || harness.query_by_label("outdated").is_none(), "it begins");
    settle(&mut harness);
    assert!(harness.query_by_label("outdated").is_none());
    // Two steps back: the scene has no year again.
    apply(&mut harness, Command::Undo);
    apply(&mut harness, Command::Undo);
    assert_eq!(harness.state().shell.state.document.scene.year, None);
}

#[test]
fn a_click_on_an_hour_shows_it_everywhere_and_keys_go_on_from_there() {
    let mut harness = computed();
    let before = harness.state().shell.state.document.scene.clone();
    // 21 June, 12 to 13 h of standard time, by the clock of Stuttgart an hour later.
    let at = place(&harness, MAP, 171.0, 12.0);
    click(&mut harness, at);
    let scene = harness.state().shell.state.document.scene.clone();
    assert_eq!((scene.sky.model, scene.sky.weather.clone()), (SkyModelKey::Weather, Some(YEARS[1].name())));
    assert_eq!(moment::words(moment::of(&scene).unwrap()), "21 Jun 13:30");
    assert_eq!(scene.year, before.year, "the year stays what it is");
    // The room of that moment is the year's row.
    apply(&mut harness, Command::Maximise(None));
    let app = harness.state();
    let annual = app.shell.results.annual.value.clone().unwrap();
    assert!(annual.is_of(&app.shell.state.document.scene));
    let step = annual.now(&scene).unwrap();
    let room = app.shell.results.room.value.clone().unwrap();
    assert!(!app.shell.results.room.stale, "{:?}", app.shell.results.room.error);
    let row = &annual.year.light.values.row(step)[..4];
    for (place, own) in row.iter().enumerate() {
        let (total, own) = (room.total(place).value, f64::from(*own));
        assert!((total / own - 1.0).abs() < 2e-3 && own > 100.0, "{place}: {total} {own}");
    }
    // The next day by the arrow key, the next hour by the other, while the map has the keyboard.
    apply(&mut harness, Command::Maximise(Some(YEAR)));
    harness.get_by_label(MAP).focus();
    harness.run_steps(2);
    for key in [Key::ArrowRight, Key::ArrowUp] {
        harness.key_press(key);
        harness.run_steps(2);
    }
    settle(&mut harness);
    let now = moment::of(&harness.state().shell.state.document.scene).unwrap();
    assert_eq!(moment::words(now), "22 Jun 14:30");
    // What keys walked over is no step each: back to where was clicked, and to before.
    apply(&mut harness, Command::Undo);
    assert_eq!(harness.state().shell.state.document.scene, scene);
    apply(&mut harness, Command::Undo);
    assert_eq!(harness.state().shell.state.document.scene, before);
}

#[test]
fn pages_are_looked_at_and_handed_on() {
    let mut harness = computed();
    let look = |page, shows| Look { page, shows, log: false, month: Some(6) };
    apply(&mut harness, Command::Year(YearAct::Look(look(Page::Lighting, Shows::Mean))));
    let day = harness.get_by_label("Lighting power over the day").value().unwrap_or_default();
    assert!(day.contains(" Jun, ") && day.contains("kWh/m² direct normal"), "{day}");
    assert!(harness.query_by_label("Lighting energy by month").is_some());
    apply(&mut harness, Command::Year(YearAct::Look(look(Page::Map, Shows::Dgps(0)))));
    assert!(harness.query_by_label("Hours of the year: DGPs, observer 1").is_some());
    let mut choices = harness.state().shell.state.settings.export.clone();
    (choices.what, choices.tile, choices.vector) = (What::Picture, TileKind::Year, true);
    apply(&mut harness, Command::ExportTile(YEAR));
    apply(&mut harness, Command::ExportChoices(Box::new(choices.clone())));
    let shown = |harness: &Harness<'_, App>| match harness.state().export.preview() {
        Some(Ok(Preview::Picture([width, height], ..))) => format!("{width} {height}"),
        Some(Ok(Preview::Text(text, _))) => text.clone(),
        other => panic!("{}", matches!(other, Some(Err(_)))),
    };
    assert_eq!(shown(&harness), "900 675");
    choices.what = What::Table;
    apply(&mut harness, Command::ExportChoices(Box::new(choices.clone())));
    let table = shown(&harness);
    assert!(table.starts_with("month,day,start,\"DGPs, eye 1 (DGPs)\"\n1,1,00:00,\n"), "{table}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("year.csv");
    apply(&mut harness, Command::EditPath(path.display().to_string()));
    harness.get_by_label("Write").click();
    settle(&mut harness);
    assert_eq!(std::fs::read_to_string(&path).unwrap().lines().count(), 8761);
}

#[test]
fn without_a_year_nothing_of_it_is_handed_on() {
    let mut harness = window();
    let mut choices = harness.state().shell.state.settings.export.clone();
    (choices.what, choices.tile) = (What::Table, TileKind::Year);
    apply(&mut harness, Command::ExportTile(YEAR));
    apply(&mut harness, Command::ExportChoices(Box::new(choices)));
    let Some(Err(told)) = &harness.state().export.preview() else { panic!("a year out of nothing") };
    assert!(told.contains("compute one in the Year tile"), "{told}");
}

#[test]
fn an_hour_is_picked_from_the_calendar_of_a_file_that_was_dropped() {
    let mut harness = window();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("coast.weather.txt");
    std::fs::write(&path, YEARS[2].table).unwrap();
    apply(&mut harness, Command::OpenPaths(vec![path.clone()]));
    let scene = harness.state().shell.state.document.scene.clone();
    assert_eq!(scene.sky.weather.as_deref(), Some(&*path));
    assert_eq!(moment::words(moment::of(&scene).unwrap()), "21 Mar 12:00", "the moment stays");
    harness.get_by_label("Weather and year").click();
    settle(&mut harness);
    let map = "Hours of the year: Direct normal";
    harness.get_by_label(map).scroll_to_me();
    harness.run_steps(4);
    let at = place(&harness, map, 180.0, 9.0);
    click(&mut harness, at);
    let scene = harness.state().shell.state.document.scene.clone();
    let time = moment::of(&scene).unwrap();
    // A day is half a point wide in the panel.
    assert!((178..=184).contains(&time.day_of_year()) && (8..=10).contains(&time.hour()), "{time}");
    assert!(harness.state().shell.state.scene_error.is_none(), "{:?}", harness.state().shell.state.scene_error);
    assert!(harness.state().shell.state.daylight.value.as_ref().unwrap().outside.diffuse_horizontal() > 100.0);
    apply(&mut harness, Command::Undo);
    apply(&mut harness, Command::Undo);
    assert_eq!(harness.state().shell.state.document.scene.sky.weather, None);
}

#[test]
fn a_year_is_stopped_and_a_wrong_weather_is_told() {
    let mut harness = window();
    apply(&mut harness, Command::Year(YearAct::WeatherOfYear(PathBuf::from("nowhere.epw"))));
    harness.get_by_label("Compute a year").click();
    step_until(&mut harness, "it is told", |app| app.shell.results.annual.error.is_some());
    settle(&mut harness);
    let error = harness.state().shell.results.annual.error.clone().unwrap();
    assert!(error.contains("nowhere.epw"), "{error}");
    assert!(harness.query_all_by_label_contains("nowhere.epw").count() > 0);
    apply(&mut harness, Command::Year(YearAct::WeatherOfYear(YEARS[0].name())));
    harness.state_mut().apply(Command::Year(YearAct::Compute));
    harness.run_steps(2);
    harness.state_mut().apply(Command::Cancel(Lane::Annual));
    settle(&mut harness);
    let app = harness.state();
    assert!(app.shell.results.annual.value.is_none() && !app.works_in(Lane::Annual));
    assert!(harness.query_by_label("Compute a year").is_some());
}

#[test]
fn a_year_can_be_read_on_all_its_pages() {
    let mut harness = computed();
    for (page, what) in [(Page::Map, "map"), (Page::Figures, "figures"), (Page::Lighting, "lamps")] {
        let look = Look { page, ..Look::default() };
        apply(&mut harness, Command::Year(YearAct::Look(look)));
        can_be_read(&mut harness, &format!("the year's {what}"));
    }
}
