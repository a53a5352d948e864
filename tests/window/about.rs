//! Memory of the stored results: shown, limited and freed, without any effect on a result.

use crate::driven::{apply, coarsen, harness, services, settle};
use cfs::app::Services;
use cfs::app::command::Command;
use cfs::app::results::backend::{StudyEngine, ideals_shelf};
use cfs::app::results::engine::Engine;
use cfs::app::shell::settings::MEGABYTE;
use cfs::app::state::Sheet;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

/// The least limit that the sheet offers. [MB]
const LEAST: usize = 16;

#[test]
fn stored_results_are_shown_limited_and_removed() {
    let engine = Arc::new(StudyEngine::default());
    let mut harness = harness(Services { engine: engine.clone(), ..services(ideals_shelf) });
    settle(&mut harness);
    let bytes = || engine.store().unwrap().bytes();
    let first = harness.state().shell.results.room.value.as_ref().unwrap().direct.clone();
    let all = bytes();
    apply(&mut harness, Command::Sheet(Some(Sheet::About)));
    assert!(all > LEAST * MEGABYTE, "the room of the first start needs more than the least limit: {all}");
    assert!(harness.query_by_label(&format!("{} MB", all.div_ceil(MEGABYTE))).is_some());
    harness.get_by_label("Remove stored results").click();
    settle(&mut harness);
    assert_eq!(bytes(), 0);
    assert!(harness.query_by_label("0 MB").is_some());
    // Another room and the first one again, within a limit that is too small for it.
    apply(&mut harness, Command::StoreLimit(LEAST));
    let sensors = harness.state().shell.state.document.scene.sensors.clone();
    coarsen(&mut harness, [5, 4]);
    settle(&mut harness);
    harness.state_mut().shell.state.document.scene.sensors = sensors;
    settle(&mut harness);
    assert!((1..=LEAST * MEGABYTE).contains(&bytes()), "{}", bytes());
    assert_eq!(harness.state().shell.results.room.value.as_ref().unwrap().direct, first);
}
