//! Who opens something to type in can type at once: paths, the palette, the search field, names of what is handed on.

use crate::driven::{Idle, apply, frames, settle};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::display::text_size::TextSize;
use cfs::app::state::{PathUse, Sheet};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

fn unsettled() -> Harness<'static, App> {
    frames(App::for_test(Arc::new(Idle)), [1280.0, 720.0])
}

fn window() -> Harness<'static, App> {
    let mut harness = unsettled();
    settle(&mut harness);
    harness
}

fn open_path(harness: &mut Harness<'_, App>) {
    harness.state_mut().apply(Command::Sheet(Some(Sheet::Path(PathUse::Open))));
}

/// Types in the frame that follows, and in the one after it.
fn type_at_once(harness: &mut Harness<'_, App>) {
    for text in ["/ab", "cd"] {
        harness.event(Event::Text(text.to_owned()));
        harness.step();
    }
}

#[test]
fn a_path_can_be_typed_in_the_first_frames_of_a_window() {
    for frames_before in 0..4 {
        let mut harness = unsettled();
        harness.run_steps(frames_before);
        open_path(&mut harness);
        harness.step();
        type_at_once(&mut harness);
        assert_eq!(harness.state().shell.state.path, "/abcd", "after {frames_before} frames");
        settle(&mut harness);
        harness.event(Event::Text("/e".to_owned()));
        harness.run_steps(2);
        assert_eq!(harness.state().shell.state.path, "/abcd/e", "and when the jobs have ended");
    }
}

#[test]
fn a_path_can_be_typed_whatever_else_had_the_keyboard() {
    let mut harness = window();
    // A field of the scene, and the search field, which asks for it itself.
    harness.get_by_role_and_label(Role::TextInput, "Local time").focus();
    harness.run_steps(2);
    open_path(&mut harness);
    harness.step();
    type_at_once(&mut harness);
    assert_eq!(harness.state().shell.state.path, "/abcd");
    apply(&mut harness, Command::Sheet(None));
    harness.state_mut().shell.state.path.clear();
    harness.state_mut().apply(Command::Search);
    harness.step();
    open_path(&mut harness);
    harness.step();
    harness.step();
    type_at_once(&mut harness);
    assert_eq!(
        (harness.state().shell.state.path.as_str(), harness.state().shell.state.query.text.as_str()),
        ("/abcd", "")
    );
}

#[test]
fn escape_and_results_of_the_frame_that_opens_a_sheet_are_not_meant_for_it() {
    let mut harness = window();
    harness.key_press(Key::Escape);
    open_path(&mut harness);
    harness.step();
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Path(PathUse::Open)));
    type_at_once(&mut harness);
    assert_eq!(harness.state().shell.state.path, "/abcd");
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(harness.state().shell.state.sheet, None, "the next one is");
    // Another scene: its results come while the sheet opens.
    harness.state_mut().shell.state.path.clear();
    harness.state_mut().apply(Command::Hour(1));
    harness.step();
    open_path(&mut harness);
    for text in ["a", "b", "c"] {
        harness.step();
        std::thread::sleep(std::time::Duration::from_millis(5));
        harness.event(Event::Text(text.to_owned()));
    }
    harness.step();
    assert_eq!(harness.state().shell.state.path, "abc");
}

#[test]
fn what_is_handed_on_can_be_named_at_once_and_the_palette_goes_first() {
    let mut harness = window();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::E);
    harness.step();
    harness.run_steps(2);
    let before = harness.state().shell.state.path.clone();
    harness.event(Event::Text("x".to_owned()));
    harness.run_steps(2);
    let after = harness.state().shell.state.path.clone();
    assert_eq!(after.len(), before.len() + 1, "{before} {after}");
    apply(&mut harness, Command::Sheet(None));
    // Both at once: the palette lies over the sheet.
    harness.state_mut().shell.state.path.clear();
    open_path(&mut harness);
    harness.state_mut().apply(Command::Palette);
    harness.run_steps(2);
    type_at_once(&mut harness);
    assert_eq!(
        (harness.state().shell.state.palette.as_deref(), harness.state().shell.state.path.as_str()),
        (Some("/abcd"), "")
    );
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    let state = &harness.state().shell.state;
    assert_eq!((state.palette.clone(), state.sheet), (None, Some(Sheet::Path(PathUse::Open))));
    type_at_once(&mut harness);
    assert_eq!(harness.state().shell.state.path, "/abcd", "then it is the sheet's turn");
}

#[test]
fn the_palette_walks_its_rows_and_finds_products() {
    let mut harness = window();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    harness.run_steps(2);
    harness.event(Event::Text("diffus".to_owned()));
    settle(&mut harness);
    assert!(harness.query_by_label("Product: Ideal diffuser").is_some());
    // Rows of commands that have the word stand there too: walk down to the product.
    let rows = harness.state().palette.rows(&harness.state().shell.state, "diffus");
    let row = rows.iter().position(|row| row.text == "Product: Ideal diffuser").unwrap();
    for _ in 0..row {
        harness.key_press(Key::ArrowDown);
        harness.run_steps(2);
    }
    assert_eq!(harness.state().palette.row(), row);
    harness.key_press(Key::Enter);
    settle(&mut harness);
    assert!(cfs::app::title::title(&harness.state().shell.state).contains("Ideal diffuser"));
    assert_eq!(harness.state().shell.state.palette, None);
}

#[test]
fn letters_of_the_frame_that_opens_a_field_are_no_commands() {
    let mut harness = window();
    let scene = harness.state().shell.state.document.scene.clone();
    // A slow frame takes in the keys and what is typed after them.
    harness.input_mut().events.extend([Key::K, Key::C, Key::A].map(|key| Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: if key == Key::K { Modifiers::COMMAND } else { Modifiers::NONE },
    }));
    harness.run_steps(3);
    let state = &harness.state().shell.state;
    assert_eq!((state.palette.as_deref(), state.sheet), (Some(""), None));
    assert_eq!(state.document.scene, scene);
}

#[test]
fn text_grows_and_shrinks_by_keys_within_bounds() {
    let mut harness = window();
    let size = |harness: &Harness<'_, App>| harness.state().shell.state.settings.text_size;
    for (key, wanted) in
        [(Key::Plus, 1.1), (Key::Minus, 1.0), (Key::Minus, 0.9), (Key::Num0, 1.0), (Key::Equals, 1.1), (Key::Num0, 1.0)]
    {
        harness.key_press_modifiers(Modifiers::COMMAND, key);
        harness.run_steps(3);
        assert_eq!(size(&harness), wanted, "{key:?}");
        assert!((harness.ctx.zoom_factor() - wanted).abs() < 1e-3, "{key:?}: {}", harness.ctx.zoom_factor());
    }
    // The least window has no room: nothing changes, and it is said.
    let mut least = frames(App::for_test(Arc::new(Idle)), [960.0, 600.0]);
    settle(&mut least);
    apply(&mut least, Command::TextSize(TextSize::Larger));
    assert_eq!((size(&least), least.ctx.zoom_factor()), (1.0, 1.0));
    assert!(least.state().shell.toasts.all().any(|message| message.text.contains("no room for larger text")));
}
