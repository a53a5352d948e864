//! The list of products beside searching: gallery, recent ones, collections, folders that are subscribed to.

use crate::driven::{apply, coarsen, frames, settle};
use cfs::app::App;
use cfs::app::catalogue::command::CatalogueCommand;
use cfs::app::catalogue::shelf::{Addition, Query};
use cfs::app::command::Command;
use cfs::app::results::backend::{StudyEngine, memory_shelf};
use cfs::app::state::{PathUse, Sheet, State};
use cfs::catalogue::{Catalogue, NewProduct};
use cfs::compute::btdf::{Btdf, Dataset};
use egui::Key;
use egui::accesskit::{Role, Toggled};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use std::sync::Arc;

fn window() -> Harness<'static, App> {
    let app = App::with_shelf(Arc::new(StudyEngine::default()), memory_shelf);
    let mut harness = frames(app, [1280.0, 720.0]);
    coarsen(&mut harness, [1, 2]);
    settle(&mut harness);
    harness
}

fn state<'a>(harness: &'a Harness<'_, App>) -> &'a State {
    &harness.state().shell.state
}

fn selected(harness: &Harness<'_, App>) -> String {
    state(harness).document.selection.product.clone()
}

/// Stores products of one dataset each.
fn add(harness: &mut Harness<'_, App>, count: usize) {
    let one = |number: usize| {
        let mut dataset = Dataset { name: "x".to_owned(), ..Dataset::default() };
        dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(0.1 + 0.01 * (number % 7) as f64));
        let product = NewProduct { name: format!("Screen {number:03}"), ..NewProduct::default() };
        Addition { datasets: vec![Arc::new(dataset)], product }
    };
    let all: Vec<Addition> = (0..count).map(one).collect();
    state(harness).shelf().unwrap().add_all(&all).unwrap();
    let own = Query { text: "screen".to_owned(), builtin: Some(false), ..Query::default() };
    apply(harness, Command::Find(own));
}

fn focused(harness: &Harness<'_, App>, label: &str) -> bool {
    harness.get_by_role_and_label(Role::ListBoxOption, label).accesskit_node().is_focused()
}

#[test]
fn a_gallery_has_pictures_by_content_of_the_cards_in_sight_and_is_walked_by_keys() {
    let mut h = window();
    add(&mut h, 200);
    h.get_by_label("Gallery").click();
    settle(&mut h);
    assert!(state(&h).settings.gallery);
    let found = state(&h).found.clone();
    let cards = |h: &Harness<'_, App>| h.query_all_by_role(Role::ListBoxOption).count();
    assert!((2..60).contains(&cards(&h)), "only those in sight: {}", cards(&h));
    // Seven different data have seven pictures, whichever products are in sight.
    for entry in &found.entries[..4] {
        assert!(h.state().gallery.has(entry.dataset.as_ref().unwrap()), "{}", entry.name);
    }
    // By click, by arrow keys and back into sight when the keys go on.
    let columns = h.state().gallery.columns;
    assert!(columns > 1);
    h.get_by_role_and_label(Role::ListBoxOption, &found.entries[0].name).click();
    settle(&mut h);
    assert_eq!(selected(&h), found.entries[0].key);
    h.get_by_role_and_label(Role::ListBoxOption, &found.entries[0].name).focus();
    h.run_steps(2);
    let mut place = 0;
    for (key, step) in [(Key::ArrowRight, 1), (Key::ArrowDown, columns), (Key::ArrowDown, columns)] {
        h.key_press(key);
        settle(&mut h);
        place += step;
        assert_eq!(selected(&h), found.entries[place].key);
        assert!(focused(&h, &found.entries[place].name), "{place}");
    }
    for _ in 0..12 {
        h.key_press(Key::ArrowDown);
        settle(&mut h);
    }
    place += 12 * columns;
    assert_eq!(selected(&h), found.entries[place].key);
    assert!(focused(&h, &found.entries[place].name));
    let card = h.get_by_role_and_label(Role::ListBoxOption, &found.entries[place].name);
    assert_eq!(card.accesskit_node().toggled(), Some(Toggled::True));
}

#[test]
fn enter_in_the_search_field_chooses_the_best_match_and_gives_the_list_the_keyboard() {
    let mut h = window();
    apply(&mut h, Command::Select("clear-double".into()));
    h.state_mut().apply(Command::Search);
    h.run_steps(2);
    h.get_by_role_and_label(Role::TextInput, "Search").type_text("laser");
    h.key_press(Key::Enter);
    settle(&mut h);
    let found = state(&h).found.clone();
    assert!(found.entries.len() > 1 && selected(&h) == found.entries[0].key && selected(&h).contains("laser"));
    assert!(focused(&h, &found.entries[0].name));
    h.key_press(Key::ArrowDown);
    settle(&mut h);
    assert_eq!(selected(&h), found.entries[1].key);
    assert!(focused(&h, &found.entries[1].name));
    // Where nothing is found nothing is chosen, and one goes on typing.
    let before = selected(&h);
    h.state_mut().apply(Command::Search);
    h.run_steps(2);
    h.get_by_role_and_label(Role::TextInput, "Search").type_text("qqqqxxxxqqqq");
    h.key_press(Key::Enter);
    settle(&mut h);
    assert!(state(&h).found.entries.is_empty());
    assert_eq!(selected(&h), before);
    assert!(h.get_by_role_and_label(Role::TextInput, "Search").accesskit_node().is_focused());
}

#[test]
fn what_was_shown_last_is_a_facet() {
    let mut h = window();
    for key in ["clear-double", "laser-cut-panel"] {
        apply(&mut h, Command::Select(key.into()));
    }
    h.get_by_label("Recently shown products only, newest first").click();
    settle(&mut h);
    let keys: Vec<&str> = state(&h).found.entries.iter().map(|entry| entry.key.as_str()).collect();
    assert_eq!(keys, ["laser-cut-panel", "clear-double", "venetian-80-72"]);
    // More than twenty are not remembered.
    add(&mut h, 30);
    for place in 0..25 {
        let key = state(&h).found.entries[place].key.clone();
        h.state_mut().apply(Command::Select(key));
        h.run_steps(1);
    }
    settle(&mut h);
    assert_eq!(state(&h).settings.recent.len(), 20);
    assert_eq!(state(&h).settings.recent[0], selected(&h));
}

#[test]
fn products_are_collected_and_starred_and_undo_goes_over_both() {
    let mut h = window();
    apply(&mut h, Command::Select("clear-double".into()));
    apply(&mut h, Command::Sheet(Some(Sheet::Collections)));
    h.get_by_role_and_label(Role::TextInput, "New collection").focus();
    h.run_steps(1);
    h.get_by_role_and_label(Role::TextInput, "New collection").type_text("Atrium");
    h.run_steps(2);
    h.get_by_label("Add").click();
    settle(&mut h);
    let inside = |h: &Harness<'_, App>| {
        let list = state(h).shelf().unwrap().collections().unwrap();
        list.into_iter().map(|one| (one.name, one.products)).collect::<Vec<_>>()
    };
    assert_eq!(inside(&h), [("Atrium".to_owned(), vec!["clear-double".to_owned()])]);
    assert!(h.state().products.collection().is_empty());
    apply(&mut h, Command::Select("laser-cut-panel".into()));
    h.get_by_role_and_label(Role::CheckBox, "Atrium  1").click();
    settle(&mut h);
    assert_eq!(inside(&h)[0].1, ["clear-double", "laser-cut-panel"]);
    // The room's figures do not hang on it.
    assert!(!h.state().shell.results.room.stale);
    h.get_by_label("Show: Atrium").click();
    settle(&mut h);
    assert_eq!(state(&h).found.entries.len(), 2);
    h.get_by_label("Delete: Atrium").click();
    settle(&mut h);
    assert!(inside(&h).is_empty());
    apply(&mut h, Command::Undo);
    assert_eq!(inside(&h)[0].1, ["clear-double", "laser-cut-panel"]);
    apply(&mut h, Command::Undo);
    assert_eq!(inside(&h)[0].1, ["clear-double"]);
    apply(&mut h, Command::Redo);
    assert_eq!(inside(&h)[0].1.len(), 2);
    let starred = |h: &Harness<'_, App>| state(h).shelf().unwrap().product("laser-cut-panel").unwrap().favourite;
    apply(&mut h, Command::Catalogue(CatalogueCommand::Star));
    assert!(starred(&h));
    apply(&mut h, Command::Undo);
    assert!(!starred(&h));
    apply(&mut h, Command::Redo);
    assert!(starred(&h));
}

#[test]
fn a_folder_is_subscribed_to_by_its_path_and_the_subscription_ends_by_undo_or_a_click() {
    let folder = tempfile::tempdir().unwrap();
    let mut maker = Catalogue::empty_in_memory().unwrap();
    let mut dataset = Dataset { name: "Foil".to_owned(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(0.4));
    let key = maker.import(&[dataset], NewProduct::default()).unwrap().key;
    std::fs::write(folder.path().join("maker.cfsp"), maker.export_package(&[key]).unwrap()).unwrap();
    let mut h = window();
    apply(&mut h, Command::Catalogue(CatalogueCommand::Subscribe));
    assert_eq!(state(&h).sheet, Some(Sheet::Path(PathUse::Subscribe)));
    apply(&mut h, Command::Write(PathUse::Subscribe, folder.path().to_owned()));
    let there = |h: &Harness<'_, App>| state(h).found.entries.iter().any(|entry| entry.key == "foil");
    assert!(there(&h));
    assert_eq!(state(&h).sheet, Some(Sheet::Subscriptions));
    assert!(h.query_by_label("Products: 1").is_some());
    apply(&mut h, Command::Undo);
    assert!(!there(&h) && state(&h).sets.subscriptions.is_empty());
    apply(&mut h, Command::Redo);
    assert!(there(&h));
    h.get_by_label_contains("Unsubscribe: ").click();
    settle(&mut h);
    assert!(!there(&h) && h.query_by_label("No folder is subscribed to.").is_some());
    apply(&mut h, Command::Undo);
    assert!(there(&h));
    // What is no folder is told, and nothing is subscribed to.
    apply(&mut h, Command::Write(PathUse::Subscribe, folder.path().join("maker.cfsp")));
    assert!(h.query_all_by_label_contains("expected a folder of packages").count() > 0);
    assert_eq!(state(&h).sets.subscriptions.len(), 1);
}
