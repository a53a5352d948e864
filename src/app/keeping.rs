//! Editing of stored products: changing texts, deleting and restoring. Undo covers all of it.

use super::changes::{Change, Editing, Looked};
use super::editing::look;
use super::error::AppError;
use super::first_choice::first_choice;
use super::jobs::Lane;
use super::state::Sheet;
use super::window::{App, end_step};
use super::work::Outcome;
use crate::catalogue::Deleted;
use crate::study::subscriptions::Report;
use crate::texts::catalogue as text;

impl App {
    /// Returns the given key, or that of the selected product.
    pub(super) fn meant(&self, key: Option<String>) -> Option<String> {
        key.or_else(|| Some(self.state.document.selection.product.clone()).filter(|key| !key.is_empty()))
    }

    /// Starts reading a product for the sheet in which it is edited.
    pub(super) fn edit_product(&mut self, key: Option<String>) {
        if let Some(key) = self.meant(key) {
            self.queue(move |shelf| Outcome::Editing(look(shelf, &key)));
        }
    }

    pub(super) fn take_editing(&mut self, looked: Result<Looked, AppError>) {
        match looked {
            Ok(looked) => {
                self.state.editing = Some(Editing::of(looked));
                self.state.sheet = Some(Sheet::Product);
            }
            Err(error) => self.report_error(&error),
        }
    }

    /// Stores the changes typed in the sheet of a product.
    pub(super) fn save_words(&mut self) {
        let Some(editing) = self.state.editing.take_if(|editing| editing.problem().is_none()) else { return };
        self.state.sheet = None;
        editing.changes().into_iter().for_each(|change| self.change(change));
    }

    /// Deletes a product, which can be restored; the next one of the list is selected instead.
    pub(super) fn delete_product(&mut self, key: Option<String>) {
        let Some(key) = self.meant(key) else { return };
        if self.state.deleted.iter().any(|one| one.key == key) {
            self.toasts.info(text::DELETED_ALREADY);
            return;
        }
        let entries = self.state.found.clone();
        let place = entries.entries.iter().position(|entry| entry.key == key);
        let name = place.map_or_else(|| key.clone(), |place| entries.entries[place].name.clone());
        end_step(&mut self.undoer, &self.state.document);
        if self.state.document.selection.product == key
            && let Some(place) = place
        {
            let neighbour =
                entries.entries.get(place + 1).or_else(|| place.checked_sub(1).map(|i| &entries.entries[i]));
            if let Some(neighbour) = neighbour {
                let state = Some(neighbour.state()).filter(|_| neighbour.moves());
                first_choice(&mut self.state.document, neighbour.key.clone(), neighbour.rule, state);
                self.state.control_of = None;
            }
        }
        self.toasts.info(text::deleted(&name));
        // With the neighbour that is shown instead: one step.
        self.note_change(Change::Deleted { key, name });
    }

    /// Makes a change of the catalogue, as a separate undo step.
    pub(super) fn change(&mut self, change: Change) {
        end_step(&mut self.undoer, &self.state.document);
        self.note_change(change);
    }

    /// Makes a change of the catalogue, as one undo step together with all changes of the document since the last step.
    fn note_change(&mut self, change: Change) {
        let number = self.state.changes.len();
        self.state.changes.push(change);
        self.state.document.changes.push(number);
        end_step(&mut self.undoer, &self.state.document);
        self.make_change(number, true);
    }

    /// Makes a recorded change of this session (given by its number) in the catalogue if `forth`, or reverts it.
    pub(super) fn make_change(&mut self, number: usize, forth: bool) {
        let Some(change) = self.state.changes.get(number).cloned() else { return };
        self.queue(move |shelf| Outcome::Changed(number, forth, change.make(shelf, forth)));
    }

    pub(super) fn take_changed(&mut self, number: usize, forth: bool, result: Result<(), AppError>) {
        if let Err(error) = result {
            if forth {
                self.state.document.changes.retain(|&other| other != number);
                self.state.document.marks.retain(|&other| other != number);
            }
            self.report_error(&error);
        }
        let change = self.state.changes.get(number);
        let mark = change.is_some_and(Change::is_mark);
        if matches!(change, Some(Change::Subscribed { .. })) {
            self.sync_subscribed();
        }
        self.look_up_sets();
        if mark {
            return self.search();
        }
        // What is shown, and the header of the LID, may be of before.
        self.asked = None;
        self.search();
        self.look_up_deleted();
    }

    /// Restores a deleted product. If this session deleted it, undo covers it.
    pub(super) fn restore_product(&mut self, key: String) {
        let of_this_session = |number: &usize| matches!(&self.state.changes[*number], Change::Deleted { key: other, .. } if *other == key);
        let number = self.state.document.changes.iter().copied().rfind(of_this_session);
        match number {
            Some(number) => {
                end_step(&mut self.undoer, &self.state.document);
                self.state.document.changes.retain(|&other| other != number);
                end_step(&mut self.undoer, &self.state.document);
                self.make_change(number, false);
            }
            None => self.queue(move |shelf| Outcome::Changed(usize::MAX, false, shelf.restore(&key))),
        }
    }

    /// Starts reading the subscribed folders of packages.
    pub(super) fn sync_subscribed(&mut self) {
        if let Some(shelf) = self.state.shelf() {
            self.start(Lane::Subscribed, move |job| Outcome::Synced(shelf.sync(job)));
        }
    }

    pub(super) fn take_synced(&mut self, result: Result<Report, AppError>) {
        match result {
            Ok(report) => {
                for problem in report.problems {
                    self.toasts.warning(problem);
                }
                if report.taken + report.gone > 0 {
                    let (taken, gone) = (report.taken, report.gone);
                    self.toasts.info(text::synced(taken, gone));
                    self.search();
                }
                self.look_up_sets();
            }
            Err(error) => self.report_error(&error),
        }
    }

    /// Starts reading the list of deleted products.
    pub(super) fn look_up_deleted(&mut self) {
        self.queue(|shelf| Outcome::Deleted(shelf.deleted()));
    }

    pub(super) fn take_deleted(&mut self, list: Result<Vec<Deleted>, AppError>) {
        match list {
            Ok(list) => self.state.deleted = list,
            Err(error) => self.report_error(&error),
        }
    }
}
