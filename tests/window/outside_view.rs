//! What stands outside: put there, dragged, typed and taken away; far boxes told, parts of an aperture explained, and a
//! control that says what it does not see.

use crate::driven::{Idle, apply, coarsen, frames, select, settle, step_until, window};
use crate::legible::can_be_read;
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::display::language::LanguageChoice;
use cfs::app::display::theme::ThemeChoice;
use cfs::app::scene::outside::{Act, Kind};
use cfs::app::scene::room_look::RoomView;
use cfs::app::state::Sheet;
use cfs::app::tiles::TILES;
use cfs::study::scene_file::{BoxKeys, DstKey, IlluminanceKey, SceneFile, SunKeys};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::cell::Cell;
use std::sync::Arc;

fn scene<'a>(harness: &'a Harness<'_, App>) -> &'a SceneFile {
    &harness.state().shell.state.document.scene
}

fn solid(harness: &Harness<'_, App>, number: usize) -> BoxKeys {
    scene(harness).outside[number].solid
}

fn tile(title: &str) -> cfs::app::state::Tile {
    TILES.iter().find(|entry| entry.tile.title == title).unwrap().tile
}

/// The room tile alone with an overhang over its window.
fn room(view: RoomView) -> Harness<'static, App> {
    let mut harness = frames(App::for_test(Arc::new(Idle)), [1280.0, 720.0]);
    settle(&mut harness);
    apply(&mut harness, Command::Maximise(Some(tile("Room"))));
    apply(&mut harness, Command::RoomView(view));
    apply(&mut harness, Command::Outside(Act::Add(Kind::Overhang)));
    harness
}

fn drag(harness: &mut Harness<'_, App>, from: Pos2, to: Pos2) {
    harness.hover_at(from);
    harness.run_steps(2);
    harness.drag_at(from);
    harness.run_steps(2);
    for share in [0.3, 0.6, 1.0] {
        harness.hover_at(from + share * (to - from));
        harness.run_steps(2);
    }
    harness.drop_at(to);
    settle(harness);
}

fn value(harness: &Harness<'_, App>, name: &str) -> String {
    harness.get_by_label(name).value().unwrap_or_default()
}

fn says(harness: &Harness<'_, App>, part: &str) -> bool {
    harness.query_all_by_label_contains(part).next().is_some()
}

fn undo(harness: &mut Harness<'_, App>) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(harness);
}

#[test]
fn behind_obstructions_a_preview_of_the_room_comes_first() {
    let mut harness = frames(App::for_test(Arc::new(Idle)), [1280.0, 720.0]);
    settle(&mut harness);
    apply(&mut harness, Command::Maximise(Some(tile("Room"))));
    let coarse = |app: &App| app.shell.results.room.value.as_ref().is_some_and(|room| room.coarse);
    harness.state_mut().apply(Command::Outside(Act::Add(Kind::Overhang)));
    step_until(&mut harness, "a preview", coarse);
    settle(&mut harness);
    assert!(!coarse(harness.state()) && !harness.state().shell.results.room.stale);
    // Without them the room is there at once.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    let previewed = Cell::new(false);
    harness.run_steps(1);
    step_until(&mut harness, "jobs end", |app| {
        previewed.set(previewed.get() || coarse(app));
        !app.busy()
    });
    assert!(!previewed.get() && scene(&harness).outside.is_empty());
}

#[test]
fn an_overhang_is_dragged_by_metres_in_the_section_and_one_undo_takes_it_back() {
    let mut harness = room(RoomView::Section);
    let before = solid(&harness, 0);
    assert_eq!((before.from[1], before.to[1]), (-1.0, 0.0));
    let scale = harness.get_by_label("Room section").rect().height() / 3.0;
    let place = harness.get_by_label("Move Overhang").rect();
    // Its outer half: on its middle the handles of its faces lie near.
    let from = place.center() - vec2(0.25 * scale, 0.0);
    drag(&mut harness, from, from - vec2(0.52 * scale, 0.31 * scale));
    let after = solid(&harness, 0);
    let way = [after.from[1] - before.from[1], after.to[1] - before.to[1], after.from[2] - before.from[2]];
    for (way, expected) in way.into_iter().zip([-0.5, -0.5, 0.3]) {
        assert!((way - expected).abs() < 1e-9, "{after:?}");
    }
    assert_eq!(after.from[0], before.from[0]);
    undo(&mut harness);
    assert_eq!(solid(&harness, 0), before);
    undo(&mut harness);
    assert!(scene(&harness).outside.is_empty(), "what was added is a step of its own");
}

#[test]
fn a_face_is_dragged_in_the_plan_while_the_picture_stands_still() {
    let mut harness = room(RoomView::Plan);
    let before = solid(&harness, 0);
    let plan = harness.get_by_label("Floor plan of the room").rect();
    let scale = plan.height() / 4.0;
    let outer = harness.get_by_label("Overhang, outer side").rect().center();
    harness.hover_at(outer);
    harness.run_steps(2);
    harness.drag_at(outer);
    harness.run_steps(2);
    for share in [0.5, 1.0] {
        harness.hover_at(outer - vec2(share * 0.42 * scale, 0.0));
        harness.run_steps(2);
    }
    assert_eq!(harness.get_by_label("Floor plan of the room").rect(), plan);
    assert_eq!(value(&harness, "Overhang, outer side"), "-1.40 to 0.00 m, 1.40 m");
    harness.drop_at(outer - vec2(0.42 * scale, 0.0));
    settle(&mut harness);
    let after = solid(&harness, 0);
    assert_eq!((after.from[1], after.to), (-1.4, before.to));
    // Then the picture makes room for it.
    assert!(harness.get_by_label("Floor plan of the room").rect().left() > plan.left());
    undo(&mut harness);
    assert_eq!(solid(&harness, 0), before);
}

#[test]
fn the_keyboard_moves_a_box_keeps_it_out_of_the_room_and_takes_it_away() {
    let mut harness = room(RoomView::Plan);
    let before = solid(&harness, 0);
    harness.get_by_label("Move Overhang").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowLeft);
    settle(&mut harness);
    assert_eq!(solid(&harness, 0).to[1], -0.05);
    for _ in 0..3 {
        harness.key_press(Key::ArrowRight);
        settle(&mut harness);
    }
    assert_eq!(solid(&harness, 0), before, "the façade stops it");
    harness.get_by_label("Overhang, right edge").focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::ArrowDown);
    settle(&mut harness);
    assert!((solid(&harness, 0).to[0] - before.to[0] - 0.01).abs() < 1e-9);
    harness.get_by_label("Move Overhang").focus();
    harness.run_steps(2);
    harness.key_press(Key::Delete);
    settle(&mut harness);
    assert!(scene(&harness).outside.is_empty());
    undo(&mut harness);
    assert_eq!(scene(&harness).outside.len(), 1);
}

#[test]
fn far_boxes_leave_the_room_large_and_are_told_with_their_distance() {
    let mut harness = room(RoomView::Plan);
    let before = harness.get_by_label("Floor plan of the room").rect();
    apply(&mut harness, Command::Outside(Act::Add(Kind::Neighbour)));
    let after = harness.get_by_label("Floor plan of the room").rect();
    assert!(after.width() > 0.9 * before.width(), "{before:?} {after:?}");
    assert!(value(&harness, "Obstructions beyond the picture").contains("Neighbour 15.0 m away"));
    assert!(harness.query_by_label("Move Neighbour").is_none());
    apply(&mut harness, Command::RoomView(RoomView::Section));
    assert!(value(&harness, "Obstructions beyond the picture").contains("Neighbour 15.0 m away"));
}

#[test]
fn the_section_shows_the_sun_s_shade_on_the_ground_while_something_stands_outside() {
    let mut harness = room(RoomView::Section);
    let mut lit = scene(&harness).clone();
    // 2 m high, 5 m away, with the sun at 45° behind it.
    lit.outside[0].solid = BoxKeys { from: [-50.0, -5.1, 0.0], to: [54.0, -5.0, 2.0], turn: 0.0 };
    (lit.site.azimuth, lit.sky.time) = (180.0, None);
    (lit.sky.cie_type, lit.sky.illuminance, lit.sky.diffuse_horizontal) =
        (Some(12), IlluminanceKey::Stated, Some(20_000.0));
    lit.sky.sun = SunKeys { altitude: Some(45.0), azimuth: Some(180.0), direct_normal: Some(50_000.0) };
    apply(&mut harness, Command::Scene(Box::new(lit.clone())));
    assert_eq!(value(&harness, "Ground outside"), "ground shaded 3.0 to 5.1 m in front of the façade");
    let mut overcast = lit.clone();
    overcast.sky.sun.direct_normal = Some(0.0);
    apply(&mut harness, Command::Scene(Box::new(overcast)));
    assert_eq!(value(&harness, "Ground outside"), "no direct sunlight on the ground");
    // Nine metres up the ground is below the picture.
    let mut high = lit;
    high.site.ground_height = -9.0;
    apply(&mut harness, Command::Scene(Box::new(high.clone())));
    assert!(harness.query_by_label("Ground outside").is_none());
    assert!(value(&harness, "Obstructions beyond the picture").contains("ground 9.0 m below the floor"));
    (high.site.ground_height, high.outside) = (0.0, Vec::new());
    apply(&mut harness, Command::Scene(Box::new(high)));
    assert!(harness.query_by_label("Ground outside").is_none());
    assert!(harness.query_by_label("Obstructions beyond the picture").is_none());
}

/// A tall window with the panel's section open.
fn panel() -> Harness<'static, App> {
    let mut harness = frames(App::for_test(Arc::new(Idle)), [1280.0, 1400.0]);
    settle(&mut harness);
    unfold(&mut harness, "Obstructions");
    harness
}

fn unfold(harness: &mut Harness<'_, App>, section: &str) {
    harness.get_by_role_and_label(Role::DisclosureTriangle, section).click();
    harness.run_steps(30);
}

/// Types into a number field.
fn enter(harness: &mut Harness<'_, App>, label: &str, text: &str) {
    harness.get_by_role_and_label(Role::SpinButton, label).focus();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::SpinButton, label).type_text(text);
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    settle(harness);
}

#[test]
fn boxes_are_added_typed_doubled_and_taken_away_in_the_panel() {
    let mut harness = panel();
    harness.get_by_label("Add…").click();
    harness.run_steps(4);
    harness.get_by_label("Fin").click();
    settle(&mut harness);
    let fin = solid(&harness, 0);
    assert!(fin.from[0] >= 3.5 && fin.to[1] == 0.0 && scene(&harness).outside[0].name == "Fin");
    unfold(&mut harness, "Fin");
    enter(&mut harness, "Extent along y", "0.9");
    let deep = solid(&harness, 0);
    assert_eq!((deep.from[1], deep.to[1]), (-0.9, 0.0), "it grows outwards");
    enter(&mut harness, "Distance to façade", "0.2");
    assert_eq!([solid(&harness, 0).from[1], solid(&harness, 0).to[1]], [-1.1, -0.2]);
    enter(&mut harness, "Rotation", "30");
    assert_eq!(solid(&harness, 0).turn, 30.0);
    enter(&mut harness, "Reflectance", "0.65");
    assert_eq!(scene(&harness).outside[0].reflectance, Some(0.65));
    harness.get_by_label("Fixed luminance").click();
    settle(&mut harness);
    let keys = &scene(&harness).outside[0];
    assert!(keys.reflectance.is_none() && keys.luminance.is_some_and(|luminance| luminance > 0.0));
    harness.get_by_label("Duplicate Fin").click();
    settle(&mut harness);
    assert_eq!(scene(&harness).outside.len(), 2);
    assert_ne!(solid(&harness, 0), solid(&harness, 1));
    harness.get_by_label("Remove Fin").click();
    settle(&mut harness);
    assert_eq!(scene(&harness).outside.len(), 1);
    undo(&mut harness);
    assert_eq!(scene(&harness).outside.len(), 2);
    // What reaches into the room is told where it is typed.
    harness.state_mut().shell.state.document.scene.outside[0].solid =
        BoxKeys { from: [1.0, -1.0, 0.0], to: [2.0, 1.0, 1.0], turn: 0.0 };
    harness.run_steps(3);
    assert!(says(&harness, "extends into the room"));
    // The same scene from a file.
    let text = toml::to_string(scene(&harness)).unwrap();
    assert!(text.contains("name = \"Fin\""), "{text}");
    assert_eq!(SceneFile::parse(&text).unwrap(), *scene(&harness));
}

#[test]
fn frame_dirt_skyline_and_summer_time_are_typed() {
    let mut harness = panel();
    unfold(&mut harness, "Obstructions");
    unfold(&mut harness, "Apertures");
    enter(&mut harness, "Frame fraction", "0.15");
    enter(&mut harness, "Dirt factor k₂", "0.9");
    let aperture = &scene(&harness).aperture[0];
    assert_eq!((aperture.frame, aperture.dirt), (0.15, 0.9));
    unfold(&mut harness, "Apertures");
    unfold(&mut harness, "Ground and skyline");
    enter(&mut harness, "Skyline elevation", "12");
    harness.get_by_label("Uniform skyline").click();
    settle(&mut harness);
    assert!(scene(&harness).sky.obstruction.is_none());
    enter(&mut harness, "Elevation of point 3", "25");
    enter(&mut harness, "Bearing of point 3", "170");
    harness.get_by_label("Add a point").click();
    settle(&mut harness);
    let skyline = scene(&harness).sky.skyline.clone().unwrap();
    assert_eq!(skyline.altitudes[..3], [[0.0, 12.0], [90.0, 12.0], [170.0, 25.0]]);
    assert_eq!(skyline.altitudes.len(), 5);
    assert!(harness.state().shell.state.scene_error.is_none());
    harness.get_by_label("Uniform skyline").click();
    settle(&mut harness);
    assert_eq!(scene(&harness).sky.obstruction.map(|flat| flat.altitude), Some(25.0));
    unfold(&mut harness, "Ground and skyline");
    unfold(&mut harness, "Place");
    harness.get_by_role_and_label(Role::ComboBox, "Summer time").click();
    harness.run_steps(4);
    harness.get_by_label("European Union").click();
    settle(&mut harness);
    assert_eq!(scene(&harness).site.dst, DstKey::Eu);
}

#[test]
fn every_kind_speaks_german() {
    let mut harness = panel();
    apply(&mut harness, Command::Language(LanguageChoice::German));
    for word in ["Vordach", "Seitenblende", "Laibung", "Balkon", "Nachbargebäude"] {
        harness.get_by_label("Hinzufügen…").click();
        harness.run_steps(4);
        harness.get_by_label(word).click();
        settle(&mut harness);
    }
    let names: Vec<&str> = scene(&harness).outside.iter().map(|one| one.name.as_str()).collect();
    for name in ["Vordach", "Seitenblende", "Laibung links", "Balkon", "Balkonbrüstung", "Nachbargebäude"] {
        assert!(names.contains(&name), "{names:?}");
        assert!(harness.query_by_role_and_label(Role::DisclosureTriangle, name).is_some(), "{name}");
    }
    unfold(&mut harness, "Balkon");
    assert!(harness.query_by_label("Balkon entfernen").is_some() && says(&harness, "Abstand zur Fassade"));
    apply(&mut harness, Command::RoomView(RoomView::Section));
    assert!(value(&harness, "Verbauungen außerhalb des Bildes").contains("Nachbargebäude 15,0 m entfernt"));
}

#[test]
fn a_control_sees_what_boxes_hide_and_says_why_there_is_no_year() {
    let mut harness = window();
    select(&mut harness, |entry| entry.states.len() > 3 && entry.moves());
    let sunny = |harness: &Harness<'_, App>| {
        let year = harness.state().shell.results.year.value.clone().unwrap();
        year.hours.iter().filter(|hour| hour.is_some()).count()
    };
    let free = sunny(&harness);
    apply(&mut harness, Command::Outside(Act::Add(Kind::Overhang)));
    assert!(!harness.state().shell.results.year.stale);
    let open = sunny(&harness);
    assert!(open > 0 && open < free, "{free} {open}");
    assert!(harness.query_by_label("Note on the year").is_none());
    // A skyline by bearing hides the sun all the same: high in the south it stays away from the façade for longer.
    let mut hidden = scene(&harness).clone();
    hidden.sky.obstruction = None;
    hidden.sky.skyline = toml::from_str("altitudes = [[0.0, 0.0], [180.0, 85.0]]").unwrap();
    apply(&mut harness, Command::Scene(Box::new(hidden)));
    assert!(sunny(&harness) < open / 2, "{} {open}", sunny(&harness));
    let mut angles = scene(&harness).clone();
    angles.sky.skyline = None;
    angles.sky.time = None;
    (angles.sky.sun.altitude, angles.sky.sun.azimuth) = (Some(40.0), Some(180.0));
    apply(&mut harness, Command::Scene(Box::new(angles)));
    assert!(value(&harness, "Note on the year").contains("By date and time"));
    apply(&mut harness, Command::Maximise(Some(tile("Control"))));
    assert!(!says(&harness, "updating"), "what there is none of is not awaited");
}

#[test]
fn the_accuracy_sheet_says_what_was_split_and_why() {
    let mut harness = window();
    coarsen(&mut harness, [2, 3]);
    let scene = &mut harness.state_mut().shell.state.document.scene;
    scene.aperture[0].system = toml::from_str("ideal = \"diffuse\"\ntransmittance = 0.6").unwrap();
    apply(&mut harness, Command::Outside(Act::Add(Kind::Overhang)));
    let room = harness.state().shell.results.room.value.clone().unwrap();
    assert_eq!((harness.state().shell.results.room.error.clone(), room.outside.len()), (None, 1));
    assert!(room.outside[0].parts.is_some_and(|parts| parts >= 1), "{:?}", room.outside);
    apply(&mut harness, Command::Sheet(Some(Sheet::Accuracy)));
    assert!(says(&harness, "its own view of the obstructions") && says(&harness, "sunlit"));
}

#[test]
fn boxes_in_all_views_can_be_read() {
    let mut harness = window();
    for kind in Kind::ALL {
        apply(&mut harness, Command::Outside(Act::Add(kind)));
    }
    for view in RoomView::ALL {
        apply(&mut harness, Command::RoomView(view));
        can_be_read(&mut harness, view.word().get());
    }
    apply(&mut harness, Command::RoomView(RoomView::Plan));
    for language in [LanguageChoice::German, LanguageChoice::English] {
        apply(&mut harness, Command::Language(language));
        for title in ["Room", "Control"] {
            apply(&mut harness, Command::Maximise(Some(tile(title))));
            can_be_read(&mut harness, title);
        }
        apply(&mut harness, Command::Maximise(None));
    }
    apply(&mut harness, Command::Theme(ThemeChoice::Light));
    let section = harness.get_by_role_and_label(Role::DisclosureTriangle, "Obstructions");
    section.click();
    harness.run_steps(30);
    can_be_read(&mut harness, "the section unfolded");
}
