//! Products of the catalogue as the window changes them: additions, changes of texts and data, deleted products,
//! collections, subscriptions (undo covers all of it); and what shows and fills it.

mod additions;
pub mod built_in;
pub mod changes;
pub mod command;
pub mod gallery;
pub mod library;
mod pictures;
mod sets;
pub mod shelf;
pub mod state_queue;
mod states;

use super::import::proposal::ImportFields;
use super::shell::Shell;
use super::state::{Document, Sheet};
use crate::app::results::work::Outcome;
use crate::app::scene::first_choice::choose_first_listed;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::catalogue::Deleted;
use crate::study::subscriptions::Report;
use crate::texts::catalogue as text;
use changes::{Added, Change, Editing, Looked};
use std::collections::BTreeSet;

/// Products as this session has changed them, and what the window knows about sets of them.
#[derive(Default)]
pub struct Products {
    /// Products added to the catalogue in this session.
    additions: Vec<Added>,
    /// Indices of the additions that are being stored.
    adding: BTreeSet<usize>,
    /// Changes of this session to products of the catalogue.
    changes: Vec<Change>,
    /// Product that is being edited in its sheet.
    editing: Option<Editing>,
    /// Keys of the product and the state whose data are to be replaced.
    replacing: Option<(String, String)>,
    /// Deleted products, found by the last look-up.
    deleted: Vec<Deleted>,
    /// Name of a new collection, as typed.
    collection: String,
    /// Whether the first product is to be selected as soon as the typed search has been executed.
    first_due: bool,
}

/// Returns the given key, or that of the selected product; a message if no product is selected.
fn meant(shell: &mut Shell, key: Option<String>) -> Option<String> {
    let key = key.or_else(|| Some(shell.state.document.selection.product.clone()).filter(|key| !key.is_empty()));
    if key.is_none() {
        shell.toasts.info(text::NONE_SELECTED);
    }
    key
}

/// Lists products that are optically similar to a given one, or to the selected one.
pub fn find_like(shell: &mut Shell, key: Option<String>) {
    let Some(key) = meant(shell, key) else { return };
    shell.state.settings.catalogue_open = true;
    shell.state.query.like = Some(key);
    shell.search();
}

impl Products {
    /// Returns the product that is being edited in its sheet.
    pub const fn editing(&self) -> Option<&Editing> {
        self.editing.as_ref()
    }

    /// Returns the deleted products.
    pub fn deleted(&self) -> &[Deleted] {
        &self.deleted
    }

    /// Returns the name of a new collection, as typed.
    pub fn collection(&self) -> &str {
        &self.collection
    }

    /// Sets the texts of the edited product, as typed.
    pub fn edit_words(&mut self, fields: ImportFields) {
        if let Some(editing) = &mut self.editing {
            editing.fields = fields;
        }
    }

    /// Makes and reverts changes of the catalogue after undo or redo. `before`: document before it.
    pub fn step_changes(&self, shell: &mut Shell, before: &Document) {
        let document = &shell.state.document;
        let sides = [(&before.changes, document.changes.clone()), (&before.marks, document.marks.clone())];
        for (before, after) in sides {
            // The last one first: each was made on what the one before it left.
            for &gone in before.iter().rev().filter(|number| !after.contains(number)) {
                self.make_change(shell, gone, false);
            }
            for &back in after.iter().filter(|number| !before.contains(number)) {
                self.make_change(shell, back, true);
            }
        }
    }

    /// Starts reading a product for the sheet in which it is edited.
    pub fn edit_product(&self, shell: &mut Shell, key: Option<String>) {
        if let Some(key) = meant(shell, key) {
            shell.queue(move |shelf| Outcome::Editing(Looked::read(shelf, &key)));
        }
    }

    /// Opens the sheet in which a product is edited, once it has been read.
    pub fn take_editing(&mut self, shell: &mut Shell, looked: Result<Looked, AppError>) {
        match looked {
            Ok(looked) => {
                self.editing = Some(Editing::of(looked));
                shell.state.sheet = Some(Sheet::Product);
            }
            Err(error) => shell.report_error(&error),
        }
    }

    /// Stores the changes typed in the sheet of a product.
    pub fn save_words(&mut self, shell: &mut Shell) {
        let Some(editing) = self.editing.take_if(|editing| editing.problem().is_none()) else { return };
        shell.state.sheet = None;
        editing.changes().into_iter().for_each(|change| self.change(shell, change));
    }

    /// Deletes a product, which can be restored; the next one of the list is selected instead.
    pub fn delete_product(&mut self, shell: &mut Shell, key: Option<String>) {
        let Some(key) = meant(shell, key) else { return };
        if self.deleted.iter().any(|one| one.key == key) {
            shell.toasts.info(text::DELETED_ALREADY);
            return;
        }
        let entries = shell.state.found.clone();
        let place = entries.entries.iter().position(|entry| entry.key == key);
        let name = place.map_or_else(|| key.clone(), |place| entries.entries[place].name.clone());
        shell.end_step();
        if shell.state.document.selection.product == key
            && let Some(place) = place
        {
            let neighbour =
                entries.entries.get(place + 1).or_else(|| place.checked_sub(1).map(|i| &entries.entries[i]));
            if let Some(neighbour) = neighbour {
                choose_first_listed(&mut shell.state.document, neighbour);
                shell.state.control_of = None;
            }
        }
        shell.toasts.info(text::deleted(&name));
        // With the neighbour that is shown instead: one step.
        self.note_change(shell, Change::Deleted { key, name });
    }

    /// Makes a change of the catalogue, as a separate undo step.
    pub fn change(&mut self, shell: &mut Shell, change: Change) {
        shell.end_step();
        self.note_change(shell, change);
    }

    /// Makes a change of the catalogue, as one undo step together with all changes of the document since the last step.
    fn note_change(&mut self, shell: &mut Shell, change: Change) {
        let number = self.changes.len();
        self.changes.push(change);
        shell.state.document.changes.push(number);
        shell.end_step();
        self.make_change(shell, number, true);
    }

    /// Makes a recorded change of this session (given by its number) in the catalogue if `forth`, or reverts it.
    fn make_change(&self, shell: &mut Shell, number: usize, forth: bool) {
        let Some(change) = self.changes.get(number).cloned() else { return };
        shell.queue(move |shelf| Outcome::Changed(number, forth, change.make(shelf, forth)));
    }

    /// Takes over the end of a change: it is forgotten if it failed, and what it affects is read again.
    pub fn take_changed(&self, shell: &mut Shell, number: usize, forth: bool, result: Result<(), AppError>) {
        if let Err(error) = result {
            if forth {
                shell.state.document.changes.retain(|&other| other != number);
                shell.state.document.marks.retain(|&other| other != number);
            }
            shell.report_error(&error);
        }
        let change = self.changes.get(number);
        let mark = change.is_some_and(Change::is_mark);
        if matches!(change, Some(Change::Subscribed { .. })) {
            self.sync_subscribed(shell);
        }
        self.look_up_sets(shell);
        if mark {
            return shell.search();
        }
        // What is shown, and the header of the LID, may be of before.
        shell.ask_again();
        shell.search();
        self.look_up_deleted(shell);
    }

    /// Restores a deleted product. If this session deleted it, undo covers it.
    pub fn restore_product(&self, shell: &mut Shell, key: String) {
        let of_this_session =
            |number: &usize| matches!(&self.changes[*number], Change::Deleted { key: other, .. } if *other == key);
        let number = shell.state.document.changes.iter().copied().rfind(of_this_session);
        match number {
            Some(number) => {
                shell.end_step();
                shell.state.document.changes.retain(|&other| other != number);
                shell.end_step();
                self.make_change(shell, number, false);
            }
            None => shell.queue(move |shelf| Outcome::Changed(usize::MAX, false, shelf.restore(&key))),
        }
    }

    /// Starts reading the subscribed folders of packages.
    pub fn sync_subscribed(&self, shell: &mut Shell) {
        if let Some(shelf) = shell.state.shelf() {
            shell.start(Lane::Subscribed, move |job| Outcome::Synced(shelf.sync(job)));
        }
    }

    /// Takes over the report on reading the subscribed folders.
    pub fn take_synced(&self, shell: &mut Shell, result: Result<Report, AppError>) {
        match result {
            Ok(report) => {
                for problem in report.problems {
                    shell.toasts.warning(problem);
                }
                if report.taken + report.gone > 0 {
                    let (taken, gone) = (report.taken, report.gone);
                    shell.toasts.info(text::synced(taken, gone));
                    shell.search();
                }
                self.look_up_sets(shell);
            }
            Err(error) => shell.report_error(&error),
        }
    }

    /// Starts reading the list of deleted products.
    pub fn look_up_deleted(&self, shell: &mut Shell) {
        shell.queue(|shelf| Outcome::Deleted(shelf.deleted()));
    }

    /// Takes over the list of deleted products.
    pub fn take_deleted(&mut self, shell: &mut Shell, list: Result<Vec<Deleted>, AppError>) {
        match list {
            Ok(list) => self.deleted = list,
            Err(error) => shell.report_error(&error),
        }
    }
}
