//! The scene panel: what is typed is taken or told, nothing else changes, and the illuminances are those of the moment.

use crate::driven::{Idle, apply, coarsen, frames, services, settle};
use cfs::app::command::Command;
use cfs::app::compare::view::Act;
use cfs::app::results::backend::{StudyEngine, memory_shelf};
use cfs::app::shell::messages::Message;
use cfs::app::state::{PathUse, Settings, State};
use cfs::app::title::title;
use cfs::app::{App, Services};
use cfs::study::scene_file::{IdealKind, IlluminanceKey, SceneFile, SystemKeys};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

/// A tall window with the real study, few sensors, and a catalogue of ideal systems.
fn window() -> Harness<'static, App> {
    let mut harness = frames(App::for_test(Arc::new(StudyEngine::default())), [1280.0, 1400.0]);
    coarsen(&mut harness, [2, 3]);
    settle(&mut harness);
    harness
}

fn scene<'a>(harness: &'a Harness<'_, App>) -> &'a SceneFile {
    &harness.state().shell.state.document.scene
}

fn words(harness: &Harness<'_, App>) -> String {
    title(&harness.state().shell.state)
}

/// Types into a field and leaves it by Enter.
fn enter(harness: &mut Harness<'_, App>, role: Role, label: &str, text: &str) {
    harness.get_by_role_and_label(role, label).focus();
    harness.run_steps(2);
    // A number is a text field as long as it has the keyboard.
    harness.get_by_role_and_label(role, label).type_text(text);
    // A digit's own key comes with its text.
    harness.key_press(Key::Num3);
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    settle(harness);
}

fn unfold(harness: &mut Harness<'_, App>, section: &str) {
    harness.get_by_role_and_label(Role::DisclosureTriangle, section).click();
    // Sections open in a moment.
    harness.run_steps(30);
}

/// Is a label there that holds these words?
fn says(harness: &Harness<'_, App>, part: &str) -> bool {
    harness.query_all_by_label_contains(part).next().is_some()
}

/// Mean of the room's illuminances. \[lx\]
fn room_mean(harness: &Harness<'_, App>) -> f64 {
    let room = harness.state().shell.results.room.value.clone().unwrap();
    assert!(!harness.state().shell.results.room.stale);
    let sum: f64 = room.direct.iter().chain(&room.interreflected).map(|estimate| estimate.value).sum();
    sum / room.direct.len() as f64
}

#[test]
fn a_saved_scene_goes_on_following_the_sun_and_is_dark_at_night() {
    let mut harness = window();
    let noon = room_mean(&harness);
    assert!(noon > 300.0, "{noon}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    harness.state_mut().apply(Command::Write(PathUse::SaveScene, path.clone()));
    settle(&mut harness);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("illuminance = \"clear-sky\"") && !text.contains("diffuse_horizontal"), "{text}");
    harness.state_mut().apply(Command::ResetScene);
    harness.state_mut().apply(Command::OpenPaths(vec![path]));
    settle(&mut harness);
    assert_eq!(scene(&harness).sky.illuminance, IlluminanceKey::ClearSky);
    assert!((room_mean(&harness) / noon - 1.0).abs() < 1e-9);
    // Eleven hours later the sun is far below the horizon.
    harness.state_mut().apply(Command::Hour(11));
    settle(&mut harness);
    assert!(words(&harness).contains("21 Mar 23:00"));
    let daylight = harness.state().shell.state.daylight.value.clone().unwrap();
    assert!(daylight.outside.diffuse_horizontal() == 0.0 && daylight.sun.is_none());
    assert_eq!(room_mean(&harness), 0.0);
    assert!(says(&harness, "No daylight") && says(&harness, "below the horizon"));
    // And light again by day.
    harness.state_mut().apply(Command::Hour(-11));
    settle(&mut harness);
    assert!((room_mean(&harness) / noon - 1.0).abs() < 1e-9);
}

#[test]
fn a_session_of_an_older_version_does_not_freeze() {
    let text = toml::to_string(&cfs::app::scene::first_scene()).unwrap();
    let old = text.replace("illuminance = \"clear-sky\"", "diffuse_horizontal = 12900.0");
    assert_ne!(text, old);
    let state = State::new(Settings { last_scene: Some(old), ..Settings::default() });
    assert_eq!(state.document.scene.sky.illuminance, IlluminanceKey::ClearSky);
    let kept = State::new(Settings { last_scene: Some(text.replace("clear-sky", "rp-21")), ..Settings::default() });
    assert_eq!(kept.document.scene.sky.illuminance, IlluminanceKey::Rp21);
}

#[test]
fn a_scene_of_its_own_system_keeps_it_until_a_product_is_chosen_for_the_room() {
    let mut own = cfs::app::scene::first_scene();
    own.aperture[0].system = SystemKeys::Ideal { kind: IdealKind::Diffuse, transmittance: 0.5 };
    let settings = Settings { last_scene: toml::to_string(&own).ok(), ..Settings::default() };
    let services = services(memory_shelf);
    let mut harness = frames(App::new(Services { engine: Arc::new(Idle), ..services }, settings), [1280.0, 720.0]);
    settle(&mut harness);
    let state = &harness.state().shell.state;
    assert_eq!(state.document.scene, own);
    // The product's tiles are alive, the title says what lights the room.
    let shown = state.document.selection.clone();
    assert!(!shown.product.is_empty() && state.product.as_ref().is_some_and(|product| product.key == shown.product));
    assert!(words(&harness).starts_with("cfs – ideal diffuser · "), "{}", words(&harness));
    let told = |harness: &Harness<'_, App>| {
        let said = |message: &Message| message.text.contains("system of the scene (ideal diffuser)");
        harness.state().shell.toasts.all().filter(|message| said(message)).count()
    };
    assert_eq!(told(&harness), 1);
    // Put beside others, it is the scene's own.
    harness.state_mut().apply(Command::Compare(Act::Add));
    assert_eq!(scene(&harness).compare[0].system.as_ref(), Some(&own.aperture[0].system));
    harness.state_mut().apply(Command::Undo);
    // Opened again from a file it says so again; chosen, a product goes into the room.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    std::fs::write(&path, toml::to_string(&own).unwrap()).unwrap();
    harness.state_mut().apply(Command::OpenPaths(vec![path]));
    settle(&mut harness);
    assert_eq!((told(&harness), scene(&harness)), (2, &own));
    let other =
        harness.state().shell.state.found.entries.iter().find(|one| one.key != shown.product).unwrap().key.clone();
    // So does the one that is chosen already.
    for wanted in [other, shown.product] {
        apply(&mut harness, Command::Select(wanted.clone()));
        assert!(matches!(&scene(&harness).aperture[0].system, SystemKeys::Catalogue { key, .. } if *key == wanted));
        harness.state_mut().apply(Command::Undo);
        assert_eq!(scene(&harness), &own);
    }
}

#[test]
fn the_panel_shows_the_illuminances_that_are_used_and_lets_them_be_typed() {
    let mut harness = window();
    let klx = |harness: &Harness<'_, App>| {
        let diffuse = harness.state().shell.state.daylight.value.clone().unwrap().outside.diffuse_horizontal();
        format!("{:.2} klx", diffuse / 1000.0)
    };
    let before = klx(&harness);
    assert!(harness.query_by_label(&before).is_some(), "{before}");
    enter(&mut harness, Role::SpinButton, "Linke turbidity", "6.3");
    assert_eq!(scene(&harness).sky.turbidity, 6.3);
    let hazy = klx(&harness);
    assert!(hazy != before && harness.query_by_label(&hazy).is_some(), "{before} {hazy}");
    // Typed figures start from those and then stay.
    harness.get_by_role_and_label(Role::ComboBox, "Illuminances").click();
    harness.run_steps(3);
    harness.get_by_label("Manual").click();
    settle(&mut harness);
    assert_eq!(scene(&harness).sky.illuminance, IlluminanceKey::Stated);
    assert_eq!(klx(&harness), hazy);
    harness.key_press(Key::ArrowRight);
    settle(&mut harness);
    assert_eq!(klx(&harness), hazy);
    // At night no such sky is: told, and without it darkness.
    harness.state_mut().apply(Command::Hour(10));
    settle(&mut harness);
    assert!(says(&harness, "below −6°") && harness.state().shell.state.scene_error.is_some());
}

#[test]
fn dates_and_times_are_typed_and_what_is_wrong_changes_nothing() {
    let mut harness = window();
    enter(&mut harness, Role::TextInput, "Date", "1.12.2023");
    assert!(words(&harness).contains("1 Dec 12:00"), "{}", words(&harness));
    assert!(scene(&harness).sky.time.as_ref().unwrap().text().starts_with("2023-12-01"));
    assert_eq!(harness.state().shell.state.maximised, None, "digits are text");
    enter(&mut harness, Role::TextInput, "Local time", "12:33");
    assert!(words(&harness).contains("1 Dec 12:33"), "{}", words(&harness));
    // To the minute, whatever steps the slider has.
    harness.run_steps(5);
    assert!(words(&harness).contains("1 Dec 12:33"), "{}", words(&harness));
    let before = scene(&harness).clone();
    for (field, text, told) in [
        ("Date", "32.1.2023", "does not exist"),
        ("Local time", "25:33", "not a time of day"),
        ("Local time", "12.13", "colon"),
    ] {
        enter(&mut harness, Role::TextInput, field, text);
        assert_eq!(*scene(&harness), before, "{text}");
        assert!(says(&harness, told), "{text}");
    }
    // The next good one is taken, and nothing is told any more.
    enter(&mut harness, Role::TextInput, "Local time", "9.3");
    assert!(words(&harness).contains("1 Dec 09:18"), "{}", words(&harness));
    assert!(!says(&harness, "not a time of day") && !says(&harness, "colon"));
}

#[test]
fn places_are_found_by_name_and_by_coordinates_from_the_keyboard() {
    let mut harness = window();
    unfold(&mut harness, "Place");
    let find = |harness: &mut Harness<'_, App>, text: &str, down: usize| {
        harness.get_by_role_and_label(Role::TextInput, "Find a place").focus();
        harness.run_steps(2);
        harness.get_by_role_and_label(Role::TextInput, "Find a place").type_text(text);
        harness.run_steps(2);
        for _ in 0..down {
            harness.key_press(Key::ArrowDown);
            harness.run_steps(2);
        }
        harness.key_press(Key::Enter);
        settle(harness);
    };
    find(&mut harness, "singapo", 0);
    let site = scene(&harness).site;
    assert!(words(&harness).contains("Singapore"), "{}", words(&harness));
    assert_eq!(site.utc_offset, Some(8.0));
    assert!((site.latitude.unwrap() - 1.3).abs() < 0.1 && (site.longitude.unwrap() - 103.8).abs() < 0.1);
    // Mexico City lies high.
    find(&mut harness, "Mexico City", 0);
    assert!((2200.0..2300.0).contains(&scene(&harness).site.elevation), "{}", scene(&harness).site.elevation);
    // The second of the list.
    find(&mut harness, "Valencia", 1);
    let second = scene(&harness).site;
    find(&mut harness, "Valencia", 0);
    assert_ne!(scene(&harness).site, second);
    assert!(words(&harness).contains("Valencia"));
    find(&mut harness, "48.78 9.18", 0);
    let site = scene(&harness).site;
    assert_eq!((site.latitude, site.longitude, site.utc_offset), (Some(48.78), Some(9.18), Some(1.0)));
    assert!(words(&harness).contains("Stuttgart"));
    // What is not found is told and changes nothing.
    find(&mut harness, "Atlantis of Plato", 0);
    assert_eq!(scene(&harness).site, site);
    assert!(says(&harness, "No city of this name"));
}

#[test]
fn sizes_push_the_sill_and_say_so_and_what_cannot_be_is_refused() {
    let mut harness = window();
    unfold(&mut harness, "Apertures");
    let before = scene(&harness).aperture[0].clone();
    assert_eq!((before.origin[1], before.size[1]), (0.9, 1.8));
    enter(&mut harness, Role::SpinButton, "Height", "2.3");
    let after = &scene(&harness).aperture[0];
    assert_eq!((after.origin[1], after.size[1]), (0.7, 2.3));
    assert!(says(&harness, "“Sill” was set to 0.70 m"));
    // Higher than the room: refused, not cut.
    enter(&mut harness, Role::SpinButton, "Height", "4.3");
    let after = &scene(&harness).aperture[0];
    assert_eq!((after.origin[1], after.size[1]), (0.7, 2.3));
    assert!(says(&harness, "4.3 m is out of range"));
    // A sill that leaves no room for the height.
    enter(&mut harness, Role::SpinButton, "Sill", "1.3");
    assert_eq!(scene(&harness).aperture[0].origin[1], 0.7);
    assert!(says(&harness, "1.3 m is out of range"));
    // A field that is only looked at rounds nothing.
    harness.state_mut().shell.state.document.scene.aperture[0].origin[0] = 0.123_456;
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::SpinButton, "Distance from left").focus();
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    settle(&mut harness);
    assert_eq!(scene(&harness).aperture[0].origin[0], 0.123_456);
    // A room that is lower than its window: both stay as typed, and it is told.
    unfold(&mut harness, "Apertures");
    unfold(&mut harness, "Room");
    enter(&mut harness, Role::SpinButton, "Height", "2.3");
    assert_eq!(scene(&harness).room.height, 2.3);
    assert_eq!(scene(&harness).aperture[0].size[1], 2.3);
    assert!(says(&harness, "extends beyond the façade"));
}

/// Tops of the sections' headers.
fn layout(harness: &Harness<'_, App>) -> Vec<f32> {
    ["Place", "Façade", "Date and time", "Sky", "Ground and skyline", "Apertures", "Room", "Work plane"]
        .map(|section| harness.get_by_role_and_label(Role::DisclosureTriangle, section).rect().top())
        .to_vec()
}

#[test]
fn nothing_in_the_panel_moves_when_the_sun_rises_sets_or_leaves_the_facade() {
    let mut harness = window();
    let by_day = layout(&harness);
    for stated in [false, true] {
        if stated {
            // With typed figures the night is told too.
            cfs::app::scene::follow(&mut harness.state_mut().shell.state.document.scene, IlluminanceKey::Stated);
            harness.state_mut().shell.state.document.scene.sky.diffuse_horizontal = Some(9000.0);
            settle(&mut harness);
        }
        let at_first = layout(&harness);
        if !stated {
            assert_eq!(at_first, by_day);
        }
        for _ in 0..12 {
            harness.state_mut().apply(Command::Hour(2));
            settle(&mut harness);
            // A typed sky has no turbidity: its own lines count.
            assert_eq!(layout(&harness), at_first, "{} {stated}", words(&harness));
        }
    }
}

#[test]
fn undo_takes_a_typed_time_back() {
    let mut harness = window();
    harness.run_steps(3);
    enter(&mut harness, Role::TextInput, "Local time", "8:33");
    assert!(words(&harness).contains("08:33"));
    // The history takes a step when things have been at rest for a moment.
    harness.run_steps(120);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut harness);
    assert!(words(&harness).contains("12:00"), "{}", words(&harness));
}

#[test]
fn the_keys_move_the_time_by_a_step_both_ways() {
    let mut harness = window();
    harness.get_by_role_and_label(Role::Slider, "Time of day").focus();
    harness.run_steps(2);
    for (key, clock) in
        [(Key::ArrowRight, "12:05"), (Key::ArrowRight, "12:10"), (Key::ArrowLeft, "12:05"), (Key::ArrowLeft, "12:00")]
    {
        harness.key_press(key);
        settle(&mut harness);
        assert!(words(&harness).contains(clock), "{clock}: {}", words(&harness));
    }
}
