//! The catalogue's panel: what a product is called, how it is first shown, its states, and how the list is narrowed.

use crate::driven::{apply, coarsen, frames, settle};
use cfs::app::App;
use cfs::app::catalogue::shelf::{Addition, Query};
use cfs::app::command::Command;
use cfs::app::results::backend::{StudyEngine, memory_shelf};
use cfs::app::state::{CatalogueState, State};
use cfs::app::tiles::TILES;
use cfs::app::title;
use cfs::catalogue::{Filter, NewProduct, Sort};
use cfs::compute::btdf::{Btdf, Dataset};
use cfs::study::control::year::CONTROLLED;
use cfs::study::scene_file::ControlMode;
use egui::accesskit::{Role, Toggled};
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use std::sync::Arc;

fn window() -> Harness<'static, App> {
    let app = App::with_shelf(Arc::new(StudyEngine::default()), memory_shelf);
    let mut harness = frames(app, [1400.0, 900.0]);
    coarsen(&mut harness, [1, 2]);
    settle(&mut harness);
    harness
}

fn find(harness: &mut Harness<'_, App>, text: &str) {
    apply(harness, Command::Find(Query { text: text.to_owned(), ..Query::default() }));
}

fn state<'a>(harness: &'a Harness<'_, App>) -> &'a State {
    &harness.state().shell.state
}

/// Stores a product whose datasets have a name of their own, as a maker's file has; the window does not know of it.
fn store(harness: &Harness<'_, App>, name: &str, states: &[(&str, f64)]) -> String {
    let dataset = |(key, tau): &(&str, f64)| {
        let mut dataset = Dataset { name: "Single Clear45".to_owned(), state: (*key).to_owned(), ..Dataset::default() };
        dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(*tau));
        Arc::new(dataset)
    };
    let product = NewProduct { name: name.to_owned(), kind: "venetian".to_owned(), ..NewProduct::default() };
    let datasets = states.iter().map(dataset).collect();
    state(harness).shelf().unwrap().add(&Addition { datasets, product }).unwrap()
}

/// Stores such a product and lists it.
fn add(harness: &mut Harness<'_, App>, name: &str, states: &[(&str, f64)]) -> String {
    let key = store(harness, name, states);
    find(harness, "");
    key
}

#[test]
fn a_list_that_was_changed_from_outside_is_renewed_when_the_window_is_used_again() {
    let mut h = window();
    store(&h, "My venetian 45", &[("", 0.4)]);
    settle(&mut h);
    let is_listed = |h: &Harness<'_, App>| state(h).found.entries.iter().any(|entry| entry.name == "My venetian 45");
    assert!(!is_listed(&h));
    h.event(egui::Event::WindowFocused(true));
    settle(&mut h);
    assert!(is_listed(&h));
}

#[test]
fn a_product_keeps_its_name_whatever_is_searched() {
    let mut h = window();
    let key = add(&mut h, "My venetian 45", &[("", 0.4)]);
    apply(&mut h, Command::Select(key));
    assert_eq!(title::selection(state(&h)), "My venetian 45");
    find(&mut h, "laser");
    assert!(state(&h).found.entries.iter().all(|entry| entry.name != "My venetian 45"));
    assert_eq!(title::selection(state(&h)), "My venetian 45");
    assert!(title::title(state(&h)).contains("My venetian 45") && h.query_by_label_contains("Clear45").is_none());
    // The luminaire is called like the product, too.
    let lid = h.state().shell.results.lid.value.clone().expect("a LID");
    assert!(format!("{:?}", lid.description).contains("My venetian 45"), "{:?}", lid.description);
}

#[test]
fn a_moving_product_starts_with_its_own_rule_in_one_step() {
    let mut h = window();
    let blind = |h: &Harness<'_, App>| {
        let state = state(h);
        (state.document.selection.product.clone(), state.document.selection.state.clone(), state.control_mode())
    };
    // At the first start, too.
    assert_eq!(blind(&h), ("venetian-80-72".to_owned(), CONTROLLED.to_owned(), ControlMode::Curve));
    assert_eq!(state(&h).document.scene.control.as_ref().map(|keys| keys.mode), Some(ControlMode::Curve));
    assert_eq!(state(&h).shown_state, "5", "noon of the equinox at 41°");
    apply(&mut h, Command::Select("clear-double".into()));
    assert_eq!(blind(&h), ("clear-double".to_owned(), String::new(), ControlMode::Fixed));
    assert!(state(&h).document.scene.control.is_none());
    let before = state(&h).document.clone();
    apply(&mut h, Command::Select("venetian-80-72".into()));
    assert_eq!(blind(&h).2, ControlMode::Curve);
    apply(&mut h, Command::Undo);
    assert_eq!(state(&h).document, before);
    // Without a curve and a description: the most open state, by hand.
    let key = add(&mut h, "Tinted", &[("-60", 0.1), ("-15", 0.5), ("15", 0.3)]);
    apply(&mut h, Command::Select(key.clone()));
    assert_eq!(blind(&h), (key.clone(), "-15".to_owned(), ControlMode::Fixed));
    assert_eq!(title::selection(state(&h)), "Tinted, -15°");
    let listed = state(&h).found.entries.iter().find(|entry| entry.key == key).unwrap();
    assert!((listed.tau_hemispherical.unwrap() - 0.5).abs() < 1e-6);
    // One that the list does not hold is looked up.
    apply(&mut h, Command::Select("clear-double".into()));
    find(&mut h, "laser");
    apply(&mut h, Command::Select(key.clone()));
    assert_eq!(blind(&h), (key, "-15".to_owned(), ControlMode::Fixed));
    apply(&mut h, Command::Undo);
    assert_eq!(blind(&h).0, "clear-double");
}

#[test]
fn all_states_are_in_reach_by_their_angles_also_by_keyboard() {
    let mut h = window();
    let product = state(&h).product.clone().unwrap();
    assert_eq!(product.states.len(), 16);
    for one in &product.states {
        assert!(h.query_by_label(&format!("State {}°", one.key)).is_some(), "{}", one.key);
    }
    let chosen =
        |h: &Harness<'_, App>, label: &str| h.get_by_label(label).accesskit_node().toggled() == Some(Toggled::True);
    assert!(chosen(&h, "State 5°"));
    h.get_by_label("State 45°").focus();
    h.run_steps(2);
    h.key_press(Key::Enter);
    settle(&mut h);
    assert_eq!(state(&h).shown_state, "45");
    assert!(chosen(&h, "State 45°") && !chosen(&h, "State 5°"));
    assert!(h.query_by_label_contains("State 45° of 16").is_some());
    // Also of a product that the search has put out of the list.
    find(&mut h, "laser");
    assert!(h.query_by_label("State 75°").is_some());
    // Out of the search field, where it would be text.
    h.key_press(Key::Escape);
    h.run_steps(2);
    h.key_press(Key::CloseBracket);
    settle(&mut h);
    assert_eq!(state(&h).shown_state, "50");
}

fn control_tile(h: &mut Harness<'_, App>) {
    let tile = TILES.iter().map(|entry| entry.tile).find(|tile| tile.title == "Control").unwrap();
    apply(h, Command::Maximise(Some(tile)));
}

#[test]
fn the_control_tile_says_why_nothing_moves() {
    let mut h = window();
    control_tile(&mut h);
    apply(&mut h, Command::Select("clear-double".into()));
    let fixed = "This pane has one state. Blinds, louvres and switchable glazing can be controlled here.";
    assert!(h.query_by_label(fixed).is_some());
    assert!(h.query_by_label_contains("manual").is_none(), "what does not move is not set by hand");
    // Without a product nothing is said of one.
    let known = std::mem::replace(&mut h.state_mut().shell.state.catalogue, CatalogueState::Opening);
    h.state_mut().shell.state.product = None;
    h.run_steps(2);
    assert!(h.query_all_by_label("Opening the catalogue…").count() > 0);
    h.state_mut().shell.state.catalogue = known;
    h.state_mut().shell.state.document.selection.product.clear();
    h.run_steps(2);
    const NONE: &str = "No product selected: select one in the catalogue.";
    assert!(h.query_all_by_label(NONE).count() > 0);
    // Nor does a command that asks for one do nothing without a word.
    for command in [Command::EditProduct(None), Command::Like(None)] {
        h.state_mut().shell.toasts.clear();
        apply(&mut h, command);
        assert_eq!(h.state().shell.toasts.all().map(|one| &one.text[..]).collect::<Vec<_>>(), [NONE]);
    }
    assert!(h.query_by_label_contains("has only one state").is_none());
}

#[test]
fn facets_fold_into_menus_and_what_is_chosen_goes_by_a_click() {
    let mut h = window();
    let all = state(&h).found.total;
    let moving = state(&h).found.facets.moving;
    assert!(moving[0] + moving[1] == all && moving[0] > 0);
    h.get_by_label("Filter by movable").click();
    h.run_steps(3);
    h.get_by_label(&format!("fixed  {}", moving[1])).click();
    settle(&mut h);
    assert_eq!((state(&h).query.moving, state(&h).found.entries.len()), (Some(false), moving[1]));
    // The menu is still open: a second choice takes the first back.
    h.get_by_label(&format!("movable  {}", moving[0])).click();
    settle(&mut h);
    assert_eq!(state(&h).query.moving, Some(true));
    h.key_press(Key::Escape);
    h.run_steps(3);
    h.get_by_label("Filter by kind").click();
    h.run_steps(3);
    let blinds = state(&h).found.facets.kinds.iter().find(|facet| facet.value == "venetian").unwrap().count;
    h.get_by_label(&format!("venetian  {blinds}")).click();
    settle(&mut h);
    h.key_press(Key::Escape);
    h.run_steps(3);
    assert_eq!(state(&h).found.entries.len(), blinds);
    h.get_by_label("Without movable").click();
    settle(&mut h);
    assert!(!state(&h).query.has(Filter::Moving) && state(&h).query.has(Filter::Kinds));
    h.get_by_label("Without venetian").click();
    settle(&mut h);
    assert_eq!(state(&h).found.entries.len(), all);
}

#[test]
fn where_nothing_is_found_a_click_relaxes_what_stands_in_the_way() {
    let mut h = window();
    let query = Query { text: "laser".into(), moving: Some(true), ..Query::default() };
    apply(&mut h, Command::Find(query));
    assert!(state(&h).found.entries.is_empty());
    let panels = state(&h).found.without.iter().find(|(filter, _)| *filter == Filter::Moving).unwrap().1;
    let products = if panels == 1 { "1 product".to_owned() } else { format!("{panels} products") };
    h.get_by_label(&format!("{products} without “movable”")).click();
    settle(&mut h);
    assert_eq!((state(&h).query.text.as_str(), state(&h).query.moving), ("laser", None));
    assert_eq!(state(&h).found.entries.len(), panels);
}

#[test]
fn typing_errors_are_forgiven_and_told() {
    let mut h = window();
    h.key_press_modifiers(Modifiers::COMMAND, Key::F);
    h.run_steps(3);
    h.get_by_role_and_label(Role::TextInput, "Search").type_text("venezian");
    settle(&mut h);
    assert!(h.query_by_role_and_label(Role::ListBoxOption, "Venetian blind 80/72, matt").is_some());
    assert!(h.query_by_label_contains("read as “venetian”").is_some());
}

#[test]
fn another_search_replaces_the_first() {
    let mut h = window();
    for words in ["opal", "prismatic", "laser"] {
        h.key_press_modifiers(Modifiers::COMMAND, Key::F);
        h.run_steps(2);
        // Letters come as fast as frames.
        for letter in words.chars() {
            h.event(egui::Event::Text(letter.into()));
            h.run_steps(1);
        }
        settle(&mut h);
        assert_eq!(state(&h).query.text, words);
    }
}

#[test]
fn the_list_is_ordered_by_what_is_chosen() {
    let mut h = window();
    h.get_by_label("Order").click();
    h.run_steps(3);
    h.get_by_label("τ normal").click();
    settle(&mut h);
    let values = |h: &Harness<'_, App>| -> Vec<f64> {
        state(h).found.entries.iter().filter_map(|entry| entry.tau_normal).collect()
    };
    assert!(matches!(state(&h).query.sort, Sort::By(_)));
    assert!(values(&h).len() > 3 && values(&h).is_sorted_by(|a, b| a >= b), "the greatest first");
    h.get_by_label("Descending").click();
    settle(&mut h);
    assert!(values(&h).is_sorted());
}

#[test]
fn the_panel_may_be_made_wide() {
    let mut h = window();
    let width = |h: &Harness<'_, App>| h.get_by_role_and_label(Role::TextInput, "Search").rect().width();
    let before = width(&h);
    assert!(before < 300.0, "{before}");
    let edge = egui::pos2(h.get_by_role_and_label(Role::TextInput, "Search").rect().right() + 10.0, 450.0);
    h.hover_at(edge);
    h.run_steps(2);
    h.drag_at(edge);
    h.run_steps(2);
    h.hover_at(edge + egui::vec2(320.0, 0.0));
    h.run_steps(2);
    h.drop_at(edge + egui::vec2(320.0, 0.0));
    settle(&mut h);
    assert!(width(&h) > before + 250.0, "{} {before}", width(&h));
}

#[test]
fn what_is_shown_after_a_product_is_deleted_is_shown_as_if_it_were_chosen() {
    let mut h = window();
    let entries = state(&h).found.entries.clone();
    let place = entries.windows(2).position(|pair| pair[1].moves()).expect("a moving product behind another");
    apply(&mut h, Command::Select(entries[place + 1].key.clone()));
    let chosen = state(&h).document.selection.clone();
    assert!(!chosen.state.is_empty());
    apply(&mut h, Command::Select(entries[place].key.clone()));
    apply(&mut h, Command::DeleteProduct(None));
    assert_eq!(state(&h).document.selection, chosen);
    assert!(title::selection(state(&h)).starts_with(&entries[place + 1].name));
}
