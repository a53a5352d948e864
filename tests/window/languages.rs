//! Both languages everywhere: no part of the window without a name for screen readers, and no English word left while it
//! speaks German.

use crate::driven::{Idle, apply, frames, settle};
use crate::legible::inspect::words;
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::compare::view::Act;
use cfs::app::display::language::LanguageChoice;
use cfs::app::export::choices::{Choices, What};
use cfs::app::offer::MENUS;
use cfs::app::results::backend::memory_shelf;
use cfs::app::state::{PathUse, Sheet};
use cfs::app::tiles::TILES;
use cfs::app::tour::step::TourAct;
use cfs::texts::pairs;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// What somebody can act on.
const ACTIVE: [Role; 12] = [
    Role::Button,
    Role::CheckBox,
    Role::RadioButton,
    Role::ComboBox,
    Role::Slider,
    Role::SpinButton,
    Role::TextInput,
    Role::MultilineTextInput,
    Role::ListBoxOption,
    Role::MenuItem,
    Role::DisclosureTriangle,
    Role::Link,
];

/// English texts that other parts of the window still say as they are. Empty when all of them speak both languages.
const OPEN: [&str; 53] = [
    "A file of this name already exists.",
    "Accuracy",
    "Add to catalogue",
    "Apr",
    "Aug",
    "Catalogue",
    "Close",
    "Compare",
    "Compute the system first",
    "Dec",
    "Delete",
    "Delete product",
    "E",
    "Feb",
    "File",
    "Height",
    "Jan",
    "Jul",
    "Jun",
    "Keeps the file and asks for another name",
    "LID",
    "Mar",
    "May",
    "No product selected: select one in the catalogue.",
    "Nov",
    "Oct",
    "Opening the catalogue…",
    "Change the name",
    "Overwrite",
    "Replace",
    "Room",
    "Save",
    "Scene",
    "Section",
    "Sep",
    "Sky",
    "State",
    "Stop",
    "View",
    "Width",
    "Write",
    "control",
    "direct",
    "error",
    "façade",
    "none",
    "note",
    "roof",
    "room",
    "states",
    "sun",
    "warning",
    "τ normal",
];

fn window(language: LanguageChoice) -> Harness<'static, App> {
    let mut harness = frames(App::with_shelf(Arc::new(Idle), memory_shelf), [1280.0, 720.0]);
    settle(&mut harness);
    apply(&mut harness, Command::Language(language));
    let moving =
        harness.state().shell.state.found.entries.iter().find(|entry| entry.states.len() > 3).unwrap().key.clone();
    apply(&mut harness, Command::Select(moving));
    harness
}

/// Shows all parts of the window one after the other, and has each looked at.
fn walk(harness: &mut Harness<'static, App>, look: &mut dyn FnMut(&Harness<'static, App>, &str)) {
    look(harness, "bench");
    for entry in TILES {
        apply(harness, Command::Maximise(Some(entry.tile)));
        look(harness, entry.tile.title);
    }
    apply(harness, Command::Maximise(None));
    let triangles = harness.query_all_by_role(Role::DisclosureTriangle);
    let sections: Vec<String> = triangles.filter_map(|node| node.accesskit_node().label()).collect();
    assert!(sections.len() >= 8, "{sections:?}");
    for section in sections {
        harness.get_by_role_and_label(Role::DisclosureTriangle, &section).click_accesskit();
        harness.run_steps(3);
    }
    look(harness, "scene unfolded");
    apply(harness, Command::SystemExample(0));
    look(harness, "goniophotometer");
    let paths = [
        PathUse::Open,
        PathUse::SaveScene,
        PathUse::ExportLid,
        PathUse::ExportMeasured,
        PathUse::ReplaceState,
        PathUse::ExportTile(TILES[0].tile),
    ];
    let sheets = [Sheet::Import, Sheet::Findings, Sheet::Keys, Sheet::About, Sheet::Accuracy, Sheet::Deleted];
    for sheet in sheets.into_iter().chain([Sheet::Messages]).chain(paths.map(Sheet::Path)) {
        apply(harness, Command::Sheet(None));
        apply(harness, Command::Sheet(Some(sheet)));
        look(harness, &format!("{sheet:?}"));
    }
    apply(harness, Command::EditProduct(None));
    look(harness, "product");
    apply(harness, Command::Sheet(None));
    apply(harness, Command::Sheet(Some(Sheet::Export)));
    for what in What::ALL {
        apply(harness, Command::ExportChoices(Box::new(Choices { what, ..Choices::default() })));
        look(harness, &format!("hand on {what:?}"));
    }
    apply(harness, Command::Sheet(None));
    apply(harness, Command::Palette);
    look(harness, "palette");
    apply(harness, Command::Palette);
    apply(harness, Command::Tour(TourAct::Start));
    look(harness, "tour");
    apply(harness, Command::Tour(TourAct::Leave));
    apply(harness, Command::Compare(Act::Add));
    apply(harness, Command::Hour(1));
    apply(harness, Command::Compare(Act::AddMoment));
    look(harness, "tray");
    apply(harness, Command::Compare(Act::Show));
    look(harness, "comparison");
    apply(harness, Command::Compare(Act::Show));
    apply(harness, Command::Compare(Act::Clear));
    // The menus last: the pointer stays over them.
    let bar: Vec<egui::Rect> = MENUS
        .iter()
        .map(|menu| {
            let word = if harness.state().shell.state.settings.language == LanguageChoice::German {
                german(menu.english())
            } else {
                menu.english()
            };
            harness.get_all_by_label(word).map(|node| node.rect()).min_by(|a, b| a.top().total_cmp(&b.top())).unwrap()
        })
        .collect();
    for (menu, rect) in MENUS.iter().zip(bar) {
        click(harness, rect.center());
        look(harness, menu.english());
        harness.key_press(egui::Key::Escape);
        harness.run_steps(3);
    }
}

fn click(harness: &mut Harness<'static, App>, at: egui::Pos2) {
    harness.hover_at(at);
    harness.step();
    harness.drag_at(at);
    harness.step();
    harness.drop_at(at);
    harness.run_steps(4);
}

/// The German of a command's English.
fn german(english: &str) -> &'static str {
    pairs().find(|(file, one, _)| *file == "commands" && *one == english).map(|(_, _, german)| german).unwrap()
}

/// What can be used and has no name.
fn nameless(harness: &Harness<'static, App>, place: &str, list: &mut BTreeSet<String>) {
    for node in harness.root().children_recursive() {
        let node = node.accesskit_node();
        let named = node.label().is_some_and(|label| label.chars().any(|c| !c.is_whitespace()));
        if ACTIVE.contains(&node.role()) && !named {
            list.insert(format!("{place}: {:?} {:?}", node.role(), node.value()));
        }
    }
}

#[test]
fn everything_that_can_be_used_has_a_name() {
    let mut list = BTreeSet::new();
    walk(&mut window(LanguageChoice::English), &mut |harness, place| nameless(harness, place, &mut list));
    assert!(list.is_empty(), "{list:#?}");
}

#[test]
fn no_english_is_left_where_the_window_speaks_german_and_names_are_not_forgotten() {
    let same: BTreeSet<&str> =
        pairs().filter(|(_, english, german)| english == german).map(|(_, one, _)| one).collect();
    let german: BTreeSet<&str> = pairs().map(|(_, _, german)| german).collect();
    let english: BTreeMap<&str, &str> = pairs()
        .filter(|(_, english, german)| english != german && !english.contains('{') && !OPEN.contains(english))
        .map(|(file, english, _)| (english, file))
        // Words of which one thing is called the same in both languages, and those that are a German word too.
        .filter(|(english, _)| !same.contains(english) && !german.contains(english))
        .collect();
    let (mut left, mut list) = (BTreeMap::new(), BTreeSet::new());
    walk(&mut window(LanguageChoice::German), &mut |harness, place| {
        nameless(harness, place, &mut list);
        let nodes = harness.root().children_recursive();
        let names = nodes.filter_map(|node| node.accesskit_node().label()).chain(words(harness));
        for name in names {
            if let Some(file) = english.get(name.trim()) {
                left.entry(name).or_insert_with(|| format!("{file}, seen in {place}"));
            }
        }
    });
    assert!(left.is_empty() && list.is_empty(), "{left:#?}\n{list:#?}");
}
