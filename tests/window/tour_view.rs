//! The tour: five steps that are done by doing them, and left by Escape.

use crate::driven::{Idle, apply, frames, settle};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::state::Sheet;
use cfs::app::tour::step::{Stop, TourAct};
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

fn window() -> Harness<'static, App> {
    let mut harness = frames(App::for_test(Arc::new(Idle)), [1280.0, 720.0]);
    settle(&mut harness);
    harness
}

fn stop(harness: &Harness<'_, App>) -> Option<Stop> {
    harness.state().tour.stop()
}

#[test]
fn each_step_is_done_by_what_it_asks_for_and_by_nothing_else() {
    let mut harness = window();
    assert_eq!(stop(&harness), None);
    apply(&mut harness, Command::Tour(TourAct::Start));
    assert!(harness.query_by_label("Step 1 of 5").is_some());
    // The sun is another step.
    harness.key_press(Key::ArrowRight);
    settle(&mut harness);
    assert_eq!(stop(&harness), Some(Stop::Product));
    harness.get_by_label("Ideal diffuser").click();
    settle(&mut harness);
    assert_eq!(stop(&harness), Some(Stop::Sun));
    harness.key_press(Key::ArrowRight);
    settle(&mut harness);
    assert_eq!(stop(&harness), Some(Stop::Light));
    // The sky is no place to see the light in the room.
    harness.key_press(Key::Num3);
    settle(&mut harness);
    assert_eq!(stop(&harness), Some(Stop::Light));
    harness.key_press(Key::Num5);
    settle(&mut harness);
    assert_eq!(stop(&harness), Some(Stop::Compare));
    harness.key_press(Key::C);
    settle(&mut harness);
    assert_eq!(stop(&harness), Some(Stop::Export));
    assert!(harness.query_by_label("Step 5 of 5").is_some());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::E);
    settle(&mut harness);
    assert_eq!((stop(&harness), harness.state().shell.state.sheet), (None, Some(Sheet::Export)));
    assert_eq!(harness.state().shell.state.settings.tour, 5);
    assert!(harness.state().shell.toasts.all().any(|message| message.text.starts_with("The tour is finished")));
}

#[test]
fn escape_leaves_it_and_it_goes_on_where_it_was_left() {
    let mut harness = window();
    apply(&mut harness, Command::Tour(TourAct::Start));
    harness.get_by_label("Ideal diffuser").click();
    settle(&mut harness);
    // A sheet takes the key first.
    apply(&mut harness, Command::Sheet(Some(Sheet::Keys)));
    harness.key_press(Key::Escape);
    settle(&mut harness);
    assert_eq!((stop(&harness), harness.state().shell.state.sheet), (Some(Stop::Sun), None));
    harness.key_press(Key::Escape);
    settle(&mut harness);
    assert_eq!(stop(&harness), None);
    assert!(harness.query_by_label("End the tour").is_none());
    apply(&mut harness, Command::Tour(TourAct::Start));
    assert_eq!(stop(&harness), Some(Stop::Sun));
}

#[test]
fn escape_in_a_field_leaves_the_field_and_not_the_tour() {
    let mut harness = window();
    apply(&mut harness, Command::Tour(TourAct::Start));
    apply(&mut harness, Command::Search);
    assert!(harness.ctx.memory(|memory| memory.focused().is_some()));
    harness.key_press(Key::Escape);
    settle(&mut harness);
    assert_eq!(stop(&harness), Some(Stop::Product));
    assert!(harness.ctx.memory(|memory| memory.focused().is_none()));
    harness.key_press(Key::Escape);
    settle(&mut harness);
    assert_eq!(stop(&harness), None);
}

#[test]
fn it_is_offered_at_the_first_start_alone_and_may_be_declined() {
    let folder = tempfile::tempdir().unwrap();
    let begin = || {
        let mut app = App::for_test(Arc::new(Idle));
        app.begin_session(Some(folder.path()), true);
        let mut harness = frames(app, [960.0, 600.0]);
        settle(&mut harness);
        harness
    };
    let mut first = begin();
    assert!(first.query_by_label("Start the tour").is_some());
    first.get_by_label("Not now").click();
    settle(&mut first);
    assert!(first.query_by_label("Start the tour").is_none() && stop(&first).is_none());
    first.state_mut().close();
    drop(first);
    let second = begin();
    assert!(second.query_by_label("Start the tour").is_none());
}
