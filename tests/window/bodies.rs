//! Light as bodies: what leaves a system for one incidence, and the window as a luminaire.

use crate::driven::{apply, settle, window};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::tiles::TILES;
use egui::vec2;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// One tile alone, with a toggle of its head clicked.
fn alone(title: &str, toggle: &str) -> Harness<'static, App> {
    let mut harness = window();
    let tile = TILES.iter().find(|entry| entry.tile.title == title).unwrap().tile;
    apply(&mut harness, Command::Maximise(Some(tile)));
    click(&mut harness, toggle);
    harness
}

/// Clicks a toggle; where the head has no room for all of them they are in its menu, the last of that name.
fn click(harness: &mut Harness<'_, App>, label: &str) {
    if harness.query_by_label(label).is_none() {
        harness.query_all_by_label("View").last().expect("the tile's menu").click();
        settle(harness);
    }
    harness.get_by_label(label).click();
    settle(harness);
}

fn value(harness: &Harness<'_, App>, name: &str) -> String {
    harness.get_by_label(name).value().unwrap_or_default()
}

/// Drags a picture and looks at what stands under its middle then.
fn turn_and_point(harness: &mut Harness<'_, App>, name: &str) {
    let centre = harness.get_by_label(name).rect().center();
    harness.hover_at(centre);
    harness.run_steps(2);
    harness.drag_at(centre);
    harness.run_steps(2);
    harness.hover_at(centre + vec2(60.0, 20.0));
    harness.run_steps(2);
    harness.drop_at(centre + vec2(60.0, 20.0));
    harness.run_steps(2);
    harness.hover_at(centre);
    harness.run_steps(3);
}

#[test]
fn what_leaves_is_a_body_or_cuts_or_a_disk() {
    let mut harness = alone("BTDF", "3D");
    assert!(value(&harness, "3D polar surface").starts_with("largest q "), "{}", value(&harness, "3D polar surface"));
    turn_and_point(&mut harness, "3D polar surface");
    // Every node of the body reaches the origin's neighbourhood or more: something is under its middle.
    assert!(harness.query_by_label_contains("to the normal").is_some());
    assert!(harness.query_by_label("Emergent hemisphere").is_none());
    click(&mut harness, "Curves");
    assert!(value(&harness, "Section curves").starts_with("largest "));
    assert!(harness.query_by_label("in the plane of incidence").is_some());
    click(&mut harness, "Disk");
    assert!(harness.query_by_label("Emergent hemisphere").is_some());
}

#[test]
fn the_lid_is_a_body_with_its_peak() {
    let mut harness = alone("LID", "3D");
    let told = value(&harness, "LID 3D polar surface");
    assert!(told.starts_with("peak ") && told.contains(" to C ") && told.contains("γ"), "{told}");
    turn_and_point(&mut harness, "LID 3D polar surface");
    assert!(harness.query_all_by_label_contains("cd").any(|node| node.value().is_some_and(|it| it.starts_with("C "))));
    click(&mut harness, "3D");
    assert!(harness.query_by_label("LID polar diagram").is_some());
}
