//! The room tile: windows and sensors moved by hand, daylight factors, the room in perspective.

use crate::driven::{Idle, apply, frames, settle, window};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::scene::room_look::{RoomLook, RoomView};
use cfs::app::tiles::TILES;
use cfs::study::scene_file::IlluminanceKey;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

/// The room tile alone, drawn from one side; every sensor gets 1000 lx.
fn room(view: RoomView) -> Harness<'static, App> {
    let mut harness = frames(App::for_test(Arc::new(Idle)), [1280.0, 720.0]);
    settle(&mut harness);
    let tile = TILES.iter().find(|entry| entry.tile.title == "Room").unwrap().tile;
    apply(&mut harness, Command::Maximise(Some(tile)));
    apply(&mut harness, Command::RoomView(view));
    harness
}

fn aperture(harness: &Harness<'_, App>) -> ([f64; 2], [f64; 2]) {
    let aperture = &harness.state().shell.state.document.scene.aperture[0];
    (aperture.origin, aperture.size)
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
}

fn value(harness: &Harness<'_, App>, name: &str) -> String {
    harness.get_by_label(name).value().unwrap_or_default()
}

#[test]
fn a_sill_is_dragged_in_steps_coarse_at_first_and_one_undo_takes_it_back() {
    let mut harness = room(RoomView::Section);
    let before = aperture(&harness);
    assert_eq!(before, ([0.5, 0.9], [3.0, 1.8]));
    let sill = harness.get_by_label("Aperture 1, sill").rect().center();
    // The scale follows from the room's height on the screen.
    let scale = harness.get_by_label("Room section").rect().height() / 3.0;
    let to = sill - vec2(0.0, 0.52 * scale);
    drag(&mut harness, sill, to);
    crate::driven::step_until(&mut harness, "a coarse room", |app| {
        app.shell.results.room.value.as_ref().is_some_and(|room| room.coarse)
    });
    let (origin, size) = aperture(&harness);
    assert!((origin[1] - 1.4).abs() < 1e-9 && (size[1] - 1.3).abs() < 1e-9, "{origin:?} {size:?}");
    assert_eq!(value(&harness, "Aperture 1, sill"), "1.40 to 2.70 m, 1.30 m");
    harness.drop_at(to);
    settle(&mut harness);
    assert!(
        !harness.state().shell.results.room.value.as_ref().unwrap().coarse && !harness.state().shell.results.room.stale
    );
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    settle(&mut harness);
    assert_eq!(aperture(&harness), before);
}

#[test]
fn the_keyboard_moves_windows_and_plane() {
    let mut harness = room(RoomView::Section);
    harness.get_by_label("Aperture 1, head").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowUp);
    settle(&mut harness);
    assert_eq!(aperture(&harness), ([0.5, 0.9], [3.0, 1.85]));
    harness.key_press_modifiers(Modifiers::SHIFT, Key::ArrowDown);
    settle(&mut harness);
    assert_eq!(aperture(&harness).1[1], 1.84);
    harness.get_by_role_and_label(egui::accesskit::Role::Image, "Work plane").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowDown);
    settle(&mut harness);
    let plane = harness.state().shell.state.document.scene.sensors.plane.unwrap();
    assert!((plane.z - 0.8).abs() < 1e-9, "{}", plane.z);
}

#[test]
fn a_window_moves_as_a_whole_in_the_plan() {
    let mut harness = room(RoomView::Plan);
    let middle = harness.get_by_label("Move aperture 1").rect().center();
    let scale = harness.get_by_label("Floor plan of the room").rect().height() / 4.0;
    let to = middle + vec2(3.0, 0.31 * scale);
    drag(&mut harness, middle + vec2(0.0, 30.0), to + vec2(0.0, 30.0));
    harness.drop_at(to + vec2(0.0, 30.0));
    settle(&mut harness);
    assert_eq!(aperture(&harness), ([0.8, 0.9], [3.0, 1.8]));
}

#[test]
fn listed_sensors_are_dots_that_move() {
    let mut harness = room(RoomView::Plan);
    let sensors = &mut harness.state_mut().shell.state.document.scene.sensors;
    sensors.plane = None;
    sensors.points = vec![[2.0, 3.0, 0.85]];
    sensors.normal = Some([0.0, 0.0, 1.0]);
    settle(&mut harness);
    harness.get_by_label("Point 1").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowRight);
    harness.key_press(Key::ArrowDown);
    settle(&mut harness);
    assert_eq!(harness.state().shell.state.document.scene.sensors.points, [[2.05, 3.05, 0.85]]);
}

#[test]
fn daylight_factors_are_told_of_overcast_skies_alone() {
    let mut harness = room(RoomView::Plan);
    let look = RoomLook { daylight_factor: true, ..RoomLook::default() };
    apply(&mut harness, Command::RoomLook(look));
    let clear = value(&harness, "Floor plan of the room");
    assert!(
        clear.contains("no daylight factor: it needs an overcast CIE sky") && clear.contains("mean 1000 lx"),
        "{clear}"
    );
    let sky = &mut harness.state_mut().shell.state.document.scene.sky;
    (sky.cie_type, sky.illuminance) = (Some(16), IlluminanceKey::Stated);
    (sky.diffuse_horizontal, sky.sun.direct_normal) = (Some(20_000.0), Some(0.0));
    settle(&mut harness);
    let overcast = value(&harness, "Floor plan of the room");
    // 1000 lx of 20 klx, ± 4 lx.
    assert!(overcast.contains("mean 5.00 %") && overcast.contains("U_o 1"), "{overcast}");
    harness.state_mut().shell.state.document.scene.sky.sun.direct_normal = Some(100.0);
    settle(&mut harness);
    assert!(value(&harness, "Floor plan of the room").contains("without sun"));
}

#[test]
fn the_perspective_asks_for_the_surfaces_and_turns() {
    let mut harness = window();
    // Nobody looks at the surfaces before.
    assert!(harness.state().shell.results.surfaces.value.is_none());
    apply(&mut harness, Command::RoomView(RoomView::Perspective));
    let figures = harness.state().shell.results.surfaces.value.clone().expect("surfaces");
    let absorbed: f64 = figures
        .light
        .patches
        .iter()
        .map(|one| one.patch.area * (1.0 - one.patch.reflectance) * one.total().value)
        .sum();
    // What the blind reflects back by direction is no absorption of the room's.
    assert!(absorbed > 0.7 * figures.light.flux.value && absorbed < 1.3 * figures.light.flux.value);
    assert!(value(&harness, "Room perspective").contains("entering "), "{}", value(&harness, "Room perspective"));
    let node = harness.get_by_label("Room perspective");
    let (centre, rect) = (node.rect().center(), node.rect());
    assert!(rect.width() > 100.0);
    harness.hover_at(centre);
    harness.run_steps(3);
    assert!(harness.query_by_label_contains(" lx").is_some());
    apply(&mut harness, Command::RoomView(RoomView::Plan));
    apply(&mut harness, Command::Hour(1));
    assert!(harness.state().shell.results.surfaces.stale, "out of sight they wait");
    apply(&mut harness, Command::RoomView(RoomView::Perspective));
    assert!(!harness.state().shell.results.surfaces.stale);
}
