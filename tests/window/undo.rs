//! Every command that menus, palette and keys offer: what it changes in the study or the catalogue is taken back by
//! Ctrl+Z, to the same study and the same catalogue.

use crate::driven::{Idle, apply, frames, settle, step_until};
use crate::files_view::sheet;
use cfs::app::App;
use cfs::app::catalogue::shelf::{Entry, Query};
use cfs::app::command::Command;
use cfs::app::compare::view::Act;
use cfs::app::offer::offers;
use cfs::app::results::backend::memory_shelf;
use cfs::app::shell::jobs::Lane;
use cfs::app::state::{Document, PathUse};
use cfs::app::tour::step::TourAct;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use std::sync::Arc;

/// What undo has to bring back: all of the document but the numbers of what was done, and the catalogue's list.
#[derive(Debug, PartialEq)]
struct Kept {
    document: Document,
    products: Vec<(String, String, bool)>,
    deleted: usize,
}

fn kept(harness: &Harness<'_, App>) -> Kept {
    let state = &harness.state().shell.state;
    let row = |entry: &Arc<Entry>| (entry.key.clone(), entry.name.clone(), entry.favourite);
    // All of the catalogue, whatever the list was asked for.
    let all = state.shelf().unwrap().search(&Query::default()).unwrap();
    Kept {
        document: state.document.clone(),
        products: all.entries.iter().map(row).collect(),
        deleted: harness.state().products.deleted().len(),
    }
}

/// Long enough for the history to take a step by itself.
fn rest(harness: &mut Harness<'_, App>) {
    settle(harness);
    harness.run_steps(8);
    settle(harness);
}

/// Left out: they close the window, are undo itself, or take long and change nothing that is kept.
fn left_out(command: &Command) -> bool {
    matches!(command, Command::Quit | Command::Undo | Command::Redo | Command::MeasureAccuracy | Command::MeasureSystem)
}

#[test]
fn every_offered_command_that_changes_something_is_taken_back() {
    let mut harness = frames(App::with_shelf(Arc::new(Idle), memory_shelf), [1280.0, 720.0]);
    settle(&mut harness);
    // A product that moves, in a state in the middle; something in the tray; another scene than the first.
    let moving = harness.state().shell.state.found.entries.iter().find(|entry| entry.states.len() > 3).unwrap().clone();
    harness.state_mut().apply(Command::Select(moving.key.clone()));
    settle(&mut harness);
    harness.state_mut().apply(Command::SelectState(moving.states[1].clone()));
    harness.state_mut().apply(Command::Compare(Act::Add));
    harness.state_mut().shell.state.document.scene.site.azimuth = 200.0;
    rest(&mut harness);
    let mut changing = Vec::new();
    for offer in offers().iter().filter(|offer| !left_out(&offer.command)) {
        let before = kept(&harness);
        harness.state_mut().apply(offer.command.clone());
        rest(&mut harness);
        let changed = kept(&harness) != before;
        if changed {
            changing.push(offer.text.as_str());
            harness.state_mut().apply(Command::Undo);
            rest(&mut harness);
            assert_eq!(kept(&harness), before, "{}", offer.text);
            harness.state_mut().apply(Command::Redo);
            rest(&mut harness);
            assert_ne!(kept(&harness), before, "{} again", offer.text);
            harness.state_mut().apply(Command::Undo);
            rest(&mut harness);
            assert_eq!(kept(&harness), before, "{} once more", offer.text);
        }
        // What was opened is closed again; whatever it is, it is none of the history.
        let state = &mut harness.state_mut().shell.state;
        (state.sheet, state.palette, state.compare.open, state.compare.swapped) = (None, None, false, None);
        state.maximised = None;
        harness.state_mut().apply(Command::Tour(TourAct::Leave));
    }
    for expected in [
        "One hour later",
        "One day earlier",
        "Next state",
        "Reset scene",
        "Delete product",
        "Add to comparison with this date and time",
        "Clear comparison",
    ] {
        assert!(changing.contains(&expected), "{expected} changed nothing: {changing:?}");
    }
}

#[test]
fn steps_that_follow_on_each_other_at_once_are_taken_back_one_by_one() {
    let mut harness = frames(App::with_shelf(Arc::new(Idle), memory_shelf), [1280.0, 720.0]);
    settle(&mut harness);
    let mut seen = vec![kept(&harness).document];
    let commands = [
        Command::Compare(Act::Add),
        Command::Hour(2),
        Command::Compare(Act::AddMoment),
        Command::ResetScene,
        Command::Compare(Act::Clear),
    ];
    for command in commands {
        harness.state_mut().apply(command);
        harness.step();
        seen.push(kept(&harness).document);
    }
    for before in seen.iter().rev().skip(1) {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        settle(&mut harness);
        assert_eq!(kept(&harness).document, *before);
    }
}

#[test]
fn the_history_begins_with_the_scene_that_the_window_is_started_with() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("office.toml");
    let mut other = frames(App::with_shelf(Arc::new(Idle), memory_shelf), [1280.0, 720.0]);
    settle(&mut other);
    apply(&mut other, Command::Hour(2));
    apply(&mut other, Command::Write(PathUse::SaveScene, scene.clone()));
    let mut app = App::with_shelf(Arc::new(Idle), memory_shelf);
    app.apply(Command::OpenPaths(vec![scene]));
    let mut harness = frames(app, [1280.0, 720.0]);
    // The scene is read before the catalogue is listed, so that no product is selected yet.
    step_until(&mut harness, "the catalogue is open", |app| app.shell.state.shelf().is_some());
    harness.state_mut().apply(Command::Cancel(Lane::Catalogue));
    step_until(&mut harness, "the scene is read", |app| app.shell.state.scene_path.is_some());
    harness.state_mut().shell.search();
    rest(&mut harness);
    let started = kept(&harness);
    assert_eq!(started.document.scene, kept(&other).document.scene);
    apply(&mut harness, Command::Hour(1));
    assert_ne!(kept(&harness), started);
    for _ in 0..3 {
        apply(&mut harness, Command::Undo);
        assert_eq!(kept(&harness), started);
    }
}

#[test]
fn products_that_take_long_to_store_are_taken_back_in_one_step() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("screen.xml");
    std::fs::write(&file, sheet("Screen", 0.4)).unwrap();
    let mut harness = frames(App::with_shelf(Arc::new(Idle), memory_shelf), [1280.0, 720.0]);
    settle(&mut harness);
    apply(&mut harness, Command::OpenPaths(vec![file]));
    let key = harness.state().shell.state.found.entries[0].key.clone();
    // A frame makes one change of the catalogue: the product waits for longer than the history does for a step.
    for change in 0..20 {
        harness.state_mut().apply(Command::Favourite(key.clone(), change % 2 == 0));
    }
    let (before, count) = (harness.state().shell.state.document.clone(), kept(&harness).products.len());
    harness.state_mut().apply(Command::AddImport);
    rest(&mut harness);
    let added = kept(&harness);
    assert!(added.products.len() == count + 1 && added.document.selection != before.selection);
    let says = |app: &App| app.shell.toasts.shown().any(|message| message.text.ends_with("Ctrl+Z removes it"));
    apply(&mut harness, Command::Undo);
    assert_eq!((kept(&harness).document, kept(&harness).products.len()), (before, count));
    harness.state_mut().apply(Command::Redo);
    // At once: on a busy machine it may be read to its end before all jobs end.
    step_until(&mut harness, "the product is added again", says);
    settle(&mut harness);
    apply(&mut harness, Command::Undo);
    assert!(!says(harness.state()), "it is removed");
}

#[test]
fn nothing_is_redone_after_a_new_step() {
    let mut harness = frames(App::with_shelf(Arc::new(Idle), memory_shelf), [1280.0, 720.0]);
    settle(&mut harness);
    let star = |harness: &Harness<'_, App>| {
        let entry = harness.state().shell.state.found.entries.first().unwrap().clone();
        Command::Favourite(entry.key.clone(), !entry.favourite)
    };
    let command = star(&harness);
    apply(&mut harness, command);
    assert!(kept(&harness).products[0].2);
    apply(&mut harness, Command::Undo);
    apply(&mut harness, Command::Hour(2));
    let now = kept(&harness);
    assert!(!now.products[0].2);
    apply(&mut harness, Command::Redo);
    assert_eq!(kept(&harness), now);
}
