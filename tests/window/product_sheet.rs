//! The sheet of a product that is stored: its states, its files read again, what happened to it.

use crate::driven::{apply, settle};
use crate::files_view::{sheet, window};
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::state::Sheet;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::path::{Path, PathBuf};

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

/// The product's sheet, by F2.
fn edit(harness: &mut Harness<'_, App>, key: &str) {
    apply(harness, Command::EditProduct(Some(key.to_owned())));
    assert_eq!(harness.state().shell.state.sheet, Some(Sheet::Product));
}

#[test]
fn a_stored_product_is_edited_read_again_and_given_other_data_and_all_of_it_is_undone_and_written_down() {
    let folder = tempfile::tempdir().unwrap();
    for (file, tau) in [("ven0", 0.5), ("ven45", 0.2)] {
        write(folder.path(), &format!("{file}.xml"), &sheet("Venetian", tau));
    }
    let mut harness = window();
    apply(&mut harness, Command::OpenPaths(vec![folder.path().to_owned()]));
    apply(&mut harness, Command::AddImport);
    let shelf = harness.state().shell.state.shelf().unwrap();
    let tau = |place: usize| shelf.product("venetian").unwrap().states[place].tau_hemispherical.unwrap();
    let near = |value: f64, wanted: f64| assert!((value - wanted).abs() < 0.005, "{value} {wanted}");
    // Names and angles.
    edit(&mut harness, "venetian");
    harness.get_by_role_and_label(Role::TextInput, "Name of state 45").focus();
    harness.run_steps(1);
    harness.get_by_role_and_label(Role::TextInput, "Name of state 45").type_text("shut");
    harness.run_steps(2);
    harness.get_by_label("Save").click();
    settle(&mut harness);
    assert_eq!(shelf.product("venetian").unwrap().states[1].label, "shut");
    apply(&mut harness, Command::Undo);
    assert_eq!(shelf.product("venetian").unwrap().states[1].label, "45");
    apply(&mut harness, Command::Redo);
    // The same files, one of them written anew meanwhile: shown before it is taken.
    edit(&mut harness, "venetian");
    harness.get_by_label("Read its files again").click();
    settle(&mut harness);
    assert!(harness.query_by_label("The files have not changed since they were read.").is_some());
    write(folder.path(), "ven45.xml", &sheet("Venetian", 0.1));
    apply(&mut harness, Command::Sheet(None));
    edit(&mut harness, "venetian");
    harness.get_by_label("Read its files again").click();
    settle(&mut harness);
    near(tau(1), 0.2);
    let told = harness.state().products.editing().unwrap().reread.as_ref().unwrap().differences.clone();
    assert_eq!(told.len(), 1);
    assert!(told[0].starts_with("ven45.xml: τ changes from 0.2") && told[0].contains(" to 0.1"), "{told:?}");
    harness.get_by_label("Apply the changes").click();
    settle(&mut harness);
    near(tau(1), 0.1);
    apply(&mut harness, Command::Undo);
    near(tau(1), 0.2);
    // Another file in place of a state.
    let other = write(folder.path(), "measured.xml", &sheet("Measured", 0.44));
    edit(&mut harness, "venetian");
    harness.get_by_label("Replace state 0").click();
    settle(&mut harness);
    apply(&mut harness, Command::EditPath(other.display().to_string()));
    harness.get_by_label("Replace").click();
    settle(&mut harness);
    near(tau(0), 0.44);
    assert_eq!(shelf.product("venetian").unwrap().states[0].key, "0");
    apply(&mut harness, Command::Undo);
    near(tau(0), 0.5);
    // The sheet says what happened.
    edit(&mut harness, "venetian");
    for words in ["added from ven0.xml, ven45.xml", "data of state 0 replaced by measured.xml"] {
        let events = &harness.state().products.editing().unwrap().looked.history;
        assert!(events.iter().any(|event| event.what.contains(words)), "{words}: {events:?}");
    }
    assert!(harness.query_by_label("added from ven0.xml, ven45.xml").is_some());
}
