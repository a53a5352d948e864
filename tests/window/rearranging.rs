//! Files of an import taken apart and together: undone, one after the other without waiting, while words are typed; and
//! the findings of the dataset that is shown.

use crate::driven::{apply, settle};
use crate::files_view::{import, sheet, window};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::import::proposal::ImportFields;
use cfs::app::import::step::{Choose, Step};
use cfs::app::shell::jobs::Lane;
use cfs::app::state::Sheet;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// Files of every product.
fn products(harness: &Harness<'_, App>) -> Vec<Vec<String>> {
    import(harness).products.iter().map(|one| one.sources.clone()).collect()
}

/// Two blinds of three states each, opened.
fn blinds() -> (tempfile::TempDir, Harness<'static, App>) {
    let folder = tempfile::tempdir().unwrap();
    for (name, scale) in [("raff", 1.0), ("ven", 0.9)] {
        for (angle, tau) in [("0", 0.5), ("30", 0.4), ("60", 0.2)] {
            let text = sheet(&format!("{name} blind"), scale * tau);
            std::fs::write(folder.path().join(format!("{name}{angle}.xml")), text).unwrap();
        }
    }
    let mut harness = window();
    apply(&mut harness, Command::OpenPaths(vec![folder.path().to_owned()]));
    assert_eq!(import(&harness).products.len(), 2);
    (folder, harness)
}

fn apart(product: usize) -> [Command; 2] {
    [Command::Import(Step::ChooseProduct(product, Choose::Only)), Command::Import(Step::Separate)]
}

#[test]
fn what_was_taken_apart_is_together_again_after_undo() {
    let (_folder, mut h) = blinds();
    let before = products(&h);
    apart(0).into_iter().for_each(|command| apply(&mut h, command));
    assert_eq!(import(&h).products.len(), 4);
    assert!(import(&h).by_hand.is_some());
    apply(&mut h, Command::Undo);
    assert_eq!((products(&h), import(&h).by_hand.as_ref()), (before.clone(), None));
    apply(&mut h, Command::Redo);
    assert_eq!(import(&h).products.len(), 4);
    apply(&mut h, Command::Undo);
    assert_eq!(products(&h), before);
    // Nothing was stored, and what comes next is a step of its own.
    apply(&mut h, Command::AddImport);
    assert_eq!(h.state().shell.state.shelf().unwrap().product("raff-blind").unwrap().states.len(), 3);
}

#[test]
fn two_steps_without_waiting_are_both_done() {
    let (_folder, mut h) = blinds();
    for command in apart(0).into_iter().chain(apart(1)) {
        h.state_mut().apply(command);
    }
    assert!(h.state().works_in(Lane::Arrange));
    settle(&mut h);
    assert_eq!(import(&h).products.len(), 6, "{:?}", products(&h));
    // A step back is the last one alone.
    apply(&mut h, Command::Undo);
    assert_eq!(import(&h).products.len(), 4);
}

#[test]
fn nothing_is_stored_that_is_still_being_arranged() {
    let (_folder, mut h) = blinds();
    let stored = h.state().shell.state.found.total;
    for command in apart(0) {
        h.state_mut().apply(command);
    }
    h.state_mut().apply(Command::AddImport);
    settle(&mut h);
    assert_eq!(import(&h).products.len(), 4);
    assert_eq!(h.state().shell.state.found.total, stored);
}

#[test]
fn files_under_way_still_come_when_an_arrangement_is_undone() {
    let (folder, mut h) = blinds();
    apart(0).into_iter().for_each(|command| apply(&mut h, command));
    let more = folder.path().join("more.xml");
    std::fs::write(&more, sheet("more", 0.3)).unwrap();
    h.state_mut().apply(Command::OpenPaths(vec![more]));
    assert!(h.state().works_in(Lane::Import));
    h.state_mut().apply(Command::Undo);
    settle(&mut h);
    let sources: Vec<String> = products(&h).concat();
    assert!(sources.iter().any(|source| source.ends_with("more.xml")), "{sources:?}");
}

#[test]
fn words_that_are_typed_while_files_are_arranged_stay() {
    let (_folder, mut h) = blinds();
    for command in apart(0) {
        h.state_mut().apply(command);
    }
    assert!(import(&h).arranging);
    // About the product that stays, and about the one that is taken apart.
    let typed = |h: &Harness<'_, App>, product: usize| ImportFields {
        name: format!("Typed {product}"),
        license: "CC BY 4.0".to_owned(),
        ..import(h).products[product].fields.clone()
    };
    for product in [0, 1] {
        let fields = Box::new(typed(&h, product));
        h.state_mut().apply(Command::EditImport(product, fields));
    }
    settle(&mut h);
    let found = import(&h);
    assert!(!found.arranging && found.products.len() == 4);
    let names: Vec<&str> = found.products.iter().map(|one| one.fields.name.as_str()).collect();
    assert_eq!(names.iter().filter(|name| **name == "Typed 0").count(), 3, "{names:?}");
    assert!(names.contains(&"Typed 1"));
    assert!(found.products.iter().all(|one| one.fields.license == "CC BY 4.0"));
    // One that is thrown away meanwhile stays away.
    for command in apart(0) {
        h.state_mut().apply(command);
    }
    h.state_mut().apply(Command::DiscardImport);
    settle(&mut h);
    assert!(h.state().imports.open().is_none());
}

#[test]
fn findings_of_the_dataset_come_from_a_job_and_are_kept_by_content() {
    let mut h = window();
    h.state_mut().apply(Command::Sheet(Some(Sheet::Findings)));
    h.run_steps(1);
    assert!(h.state().works_in(Lane::Findings) || h.state().shell.state.examined.is_some());
    settle(&mut h);
    let of = |h: &Harness<'_, App>| h.state().shell.state.examined.clone().expect("examined");
    let (dataset, found) = of(&h);
    assert_eq!(*found, cfs::compute::doctor::examine(&dataset));
    assert!(h.query_by_label("Checking the data…").is_none());
    let first = h.state().shell.state.document.selection.product.clone();
    let other =
        h.state().shell.state.found.entries.iter().map(|one| one.key.clone()).find(|key| *key != first).unwrap();
    apply(&mut h, Command::Select(other));
    assert!(!std::sync::Arc::ptr_eq(&of(&h).1, &found));
    apply(&mut h, Command::Select(first));
    assert!(std::sync::Arc::ptr_eq(&of(&h).1, &found), "known by its content");
}
