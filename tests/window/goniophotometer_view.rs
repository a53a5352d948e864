//! The window's goniophotometer: from an example or a file to a product of the catalogue, and out again.

use crate::driven::{Idle, frames_in, step_until};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::goniophotometer::run::{Emergence, Incidence, Setup};
use cfs::app::shell::jobs::Lane;
use cfs::app::state::{PathUse, Sheet};
use cfs::catalogue::{Catalogue, Origin};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Theme};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

fn window(theme: Theme) -> Harness<'static, App> {
    let mut harness = frames_in(theme, App::for_test(Arc::new(Idle)), [1280.0, 800.0]);
    wait(&mut harness, |app| !app.busy());
    harness
}

/// Steps until the window is as wanted, then a few frames more.
fn wait(harness: &mut Harness<'_, App>, wanted: impl Fn(&App) -> bool) {
    harness.run_steps(2);
    step_until(harness, "as wanted", wanted);
    harness.run_steps(3);
}

fn section(harness: &Harness<'_, App>) -> String {
    harness.get_by_role_and_label(Role::Image, "Section").value().unwrap()
}

#[test]
fn from_an_example_to_the_catalogue_and_out_again() {
    let mut harness = window(Theme::Dark);
    harness.key_press(Key::G);
    harness.run_steps(3);
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Goniophotometer));
    assert!(section(&harness).contains("Select an example"));
    let before = harness.state().shell.state.found.total;
    harness.get_by_label("Panes").click();
    harness.run_steps(3);
    assert!(section(&harness).starts_with("2 outlines"), "{}", section(&harness));
    assert!(section(&harness).contains("sun at"), "the scene's noon sun shines on it");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Enter);
    wait(&mut harness, |app| app.goniophotometer.run().is_some_and(|run| run.complete()));
    let run = harness.state().goniophotometer.run().cloned().unwrap();
    // A pane of 0.89 lets 0.89² / (1 − ρ²) through twice, with ρ between Fresnel's 0.08 and what is not let through.
    let tau = run.finished[0].tau_normal;
    let between = |rho: f64| 0.89 * 0.89 / (1.0 - rho * rho);
    assert!(tau > between(0.07) && tau < between(0.11), "{tau}");
    assert!(harness.query_by_label(&format!("{tau:.4}")).is_some());

    harness.get_by_label("Add to catalogue").click();
    wait(&mut harness, |app| !app.busy() && app.shell.state.found.total == before + 1);
    let state = &harness.state().shell.state;
    assert_eq!(state.sheet, None);
    let product = state.product.clone().unwrap();
    assert_eq!(product.key, state.document.selection.product);
    assert_eq!((product.name.as_str(), product.provenance.origin), ("Double glazing, clear", Origin::Computed));
    assert!(product.provenance.method.contains("Fresnel"));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    wait(&mut harness, |app| !app.busy() && app.shell.state.found.total == before);
    // What was computed is still in the sheet.
    harness.state_mut().apply(Command::Sheet(Some(Sheet::Goniophotometer)));
    harness.run_steps(3);
    assert!(harness.query_by_label("Add to catalogue").is_some());
}

#[test]
fn the_drawing_follows_the_text_and_its_states() {
    let mut harness = window(Theme::Light);
    harness.state_mut().apply(Command::SystemExample(0));
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("(venetian), 8 states").is_some());
    assert!(section(&harness).starts_with("3 outlines"));
    assert!(harness.query_by_label("-30°").is_some());
    harness.get_by_label("Next state").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("-15°").is_some());
    let wrong = harness.state().goniophotometer.text().replace("spacing = 0.072", "spacing = -1");
    harness.state_mut().apply(Command::EditSystem(wrong));
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("venetian.spacing: -1; expected metres").is_some());
    assert!(section(&harness).contains("Select an example"));
    harness.state_mut().apply(Command::MeasureSystem);
    assert!(!harness.state().busy());
    harness.state_mut().apply(Command::SystemExample(1));
    harness.run_steps(3);
    assert!(section(&harness).contains("seen from above"));
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(harness.state().shell.state.sheet, None);
}

#[test]
fn keys_typed_into_the_text_stay_in_the_text() {
    let mut harness = window(Theme::Light);
    harness.state_mut().apply(Command::SystemExample(5));
    harness.run_steps(3);
    let editor = harness.get_by_role(Role::MultilineTextInput);
    editor.focus();
    harness.run_steps(2);
    let before = harness.state().shell.state.document.clone();
    harness.get_by_role(Role::MultilineTextInput).type_text("#g1");
    harness.run_steps(3);
    assert!(harness.state().goniophotometer.text().contains("#g1"));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(harness.state().shell.state.document, before);
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Goniophotometer));
}

#[test]
fn a_stopped_run_goes_on_after_its_finished_states() {
    let mut harness = window(Theme::Dark);
    let text = "name = \"b\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\nangles = { from = 0, to = 75, step = 3 }\n\
                upper = { reflectance = 0.5 }\nlower = { reflectance = 0.5 }\n";
    harness.state_mut().apply(Command::EditSystem(text.to_owned()));
    harness.state_mut().apply(Command::MeasureSystem);
    wait(&mut harness, |app| app.goniophotometer.run().is_some_and(|run| !run.finished.is_empty()));
    harness.state_mut().apply(Command::Cancel(Lane::Goniophotometer));
    wait(&mut harness, |app| !app.busy());
    assert!(!harness.state().goniophotometer.run().unwrap().complete());
    let first = harness.state().goniophotometer.run().cloned().unwrap().finished[0].dataset.clone();
    harness.state_mut().apply(Command::MeasureSystem);
    wait(&mut harness, |app| app.goniophotometer.run().is_some_and(|run| run.complete()));
    let run = harness.state().goniophotometer.run().cloned().unwrap();
    assert!(Arc::ptr_eq(&run.finished[0].dataset, &first));
    let states: Vec<&str> = run.finished.iter().map(|one| one.dataset.state.as_str()).collect();
    assert_eq!((states.len(), states[0], states[10], states[25]), (26, "0", "30", "75"));
    // Flat slats at 0° hide nothing at normal incidence; at 30° they overlap by 0.08 sin 30° of 0.072.
    assert!((run.finished[0].tau_normal - 1.0).abs() < 0.1 && run.finished[10].tau_normal < 0.8);
    // Other cells: nothing of the old run is taken for the new one.
    let setup = Setup { incidence: Incidence::Tregenza, emergence: Emergence::Even(5), error: 0.02 };
    harness.state_mut().apply(Command::SystemSetup(setup));
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("have changed since").is_some());
}

#[test]
fn files_open_the_sheet_and_packages_come_out() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("screen.system.toml");
    std::fs::write(&file, cfs::app::goniophotometer::examples::EXAMPLES[8].text).unwrap();
    let mut harness = window(Theme::Dark);
    harness.state_mut().apply(Command::OpenPaths(vec![file]));
    wait(&mut harness, |app| app.shell.state.sheet == Some(Sheet::Goniophotometer));
    assert_eq!(harness.state().goniophotometer.base(), folder.path());
    assert!(section(&harness).contains("schematic"));
    // Its label holds the keys too, which are other ones on other systems.
    harness
        .get_by(|node| node.role() == Role::Button && node.label().is_some_and(|l| l.starts_with("Compute")))
        .click();
    wait(&mut harness, |app| app.goniophotometer.run().is_some_and(|run| run.complete()));
    let package = folder.path().join("screen.cfsp");
    harness.state_mut().apply(Command::Write(PathUse::ExportMeasured, package.clone()));
    wait(&mut harness, |app| !app.busy());
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let imported = catalogue.import_package(&std::fs::read(&package).unwrap()).unwrap();
    assert_eq!(imported.len(), 1);
    let product = catalogue.product(&imported[0].key).unwrap();
    assert_eq!((product.kind.as_str(), product.states.len()), ("woven", 1));
    let xml = folder.path().join("screen.xml");
    harness.state_mut().apply(Command::Write(PathUse::ExportMeasured, xml.clone()));
    wait(&mut harness, |app| !app.busy());
    let read = cfs::formats::read_dataset("screen.xml", &std::fs::read(&xml).unwrap()).unwrap();
    let (ours, theirs) = (harness.state().goniophotometer.run().cloned().unwrap(), &read[0]);
    let tau = theirs.transmission().unwrap().tau_normal();
    assert!((tau - ours.finished[0].tau_normal).abs() < 1e-3, "{tau}");
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Goniophotometer));
}

/// Written where asked for, to be looked at; nothing to compare.
#[test]
fn both_themes_draw_every_example() {
    for theme in [Theme::Light, Theme::Dark] {
        let mut harness = window(theme);
        for number in 0..cfs::app::goniophotometer::examples::EXAMPLES.len() {
            harness.state_mut().apply(Command::SystemExample(number));
            harness.run_steps(3);
            let rect = harness.get_by_role_and_label(Role::Image, "Section").rect();
            assert!(rect.width() > 250.0 && rect.height() > 200.0 && rect.right() < 1280.0, "{rect:?}");
            assert!(!section(&harness).contains("no section"), "{number}");
        }
    }
}
