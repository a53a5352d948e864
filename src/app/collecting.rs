//! Functions of the product list, except for searching: recent products, stars, collections, folders of packages. Undo
//! covers all changes that are stored.

use super::catalogue_command::CatalogueCommand;
use super::changes::Change;
use super::error::AppError;
use super::jobs::Lane;
use super::shelf::{Query, Sets};
use super::state::{PathUse, Sheet};
use super::window::{App, end_step};
use super::work::Outcome;
use crate::study::subscriptions::folder_of;
use crate::texts::catalogue as words;
use std::path::PathBuf;

/// Maximum number of recently selected products that are remembered.
const RECENT: usize = 20;

impl App {
    /// Executes a command about the product list.
    pub(super) fn apply_catalogue_command(&mut self, what: CatalogueCommand) {
        match what {
            CatalogueCommand::Gallery => self.state.settings.gallery ^= true,
            CatalogueCommand::First => {
                self.state.first_due = true;
                self.choose_first();
            }
            CatalogueCommand::Recent => {
                let query = Query { recent: !self.state.query.recent, ..self.state.query.clone() };
                self.state.settings.catalogue_open = true;
                self.state.query = query;
                self.search();
            }
            CatalogueCommand::Star => {
                let key = self.state.document.selection.product.clone();
                let starred = self.state.product.as_ref().filter(|product| product.key == key).map(|one| one.favourite);
                let listed = self.state.found.entries.iter().find(|entry| entry.key == key).map(|one| one.favourite);
                if let Some(starred) = listed.or(starred) {
                    self.star(key, !starred);
                }
            }
            CatalogueCommand::Collect { name, product, put } => {
                let name = name.trim().to_owned();
                let Some(key) = self.meant(product).filter(|_| !name.is_empty()) else { return };
                let collection = self.state.sets.collections.iter().find(|one| one.name == name);
                let inside = collection.is_some_and(|one| one.products.contains(&key));
                if put {
                    self.state.collection.clear();
                }
                // An unchanged collection makes no step.
                if inside != put {
                    self.mark(Change::Collected { name, products: vec![key], put });
                }
            }
            CatalogueCommand::Disband(name) => {
                if let Some(one) = self.state.sets.collections.iter().find(|one| one.name == name) {
                    let products = one.products.clone();
                    self.mark(Change::Collected { name, products, put: false });
                }
            }
            CatalogueCommand::EditName(text) => self.state.collection = text,
            CatalogueCommand::Subscribe => self.ask_subscription(),
            CatalogueCommand::SubscribeTo(path) => self.subscribe(path),
            CatalogueCommand::Unsubscribe(folder) => {
                self.toasts.info(words::unsubscribed(&folder));
                self.mark(Change::Subscribed { folder, on: false });
            }
        }
    }

    /// Selects the first product of the list as soon as the list shows the result of the typed search.
    pub(super) fn choose_first(&mut self) {
        if self.jobs.busy(Lane::Catalogue) || !std::mem::take(&mut self.state.first_due) {
            return;
        }
        match self.state.found.entries.first().map(|entry| entry.key.clone()) {
            Some(first) => {
                self.state.focus_list = true;
                self.select_product(first);
            }
            // The user continues typing.
            None => self.state.focus_search = true,
        }
    }

    /// Sets or removes the star of a product.
    pub(super) fn star(&mut self, key: String, on: bool) {
        self.mark(Change::Starred { key, on });
    }

    /// Makes a change that has no effect on figures (star, collection, subscription), as a separate undo step.
    fn mark(&mut self, change: Change) {
        let number = self.state.changes.len();
        self.state.changes.push(change);
        end_step(&mut self.undoer, &self.state.document);
        self.state.document.marks.push(number);
        end_step(&mut self.undoer, &self.state.document);
        self.make_change(number, true);
    }

    /// Records the selected product as the most recent one.
    pub(super) fn note_shown(&mut self) {
        let key = &self.state.document.selection.product;
        let recent = &mut self.state.settings.recent;
        if key.is_empty() || recent.first() == Some(key) {
            return;
        }
        recent.retain(|other| other != key);
        recent.insert(0, key.clone());
        recent.truncate(RECENT);
    }

    /// Asks for a folder to subscribe to, in the path field of the sheet and in a dialog of the desktop.
    fn ask_subscription(&mut self) {
        self.state.path.clear();
        self.state.sheet = Some(Sheet::Path(PathUse::Subscribe));
        let dialogs = self.services.dialogs.clone();
        self.start(Lane::Dialog, move |_| {
            Outcome::Target(
                PathUse::Subscribe,
                dialogs.open_folder(words::SUBSCRIBE_TITLE).map(|paths| paths.into_iter().next()),
            )
        });
    }

    /// Subscribes to a path after checking that it is a folder.
    fn subscribe(&mut self, path: PathBuf) {
        self.remember_folder(&path);
        self.queue(move |_| Outcome::Folder(folder_of(&path)));
    }

    pub(super) fn take_folder(&mut self, folder: Result<String, String>) {
        match folder {
            Ok(folder) if self.state.sets.subscriptions.iter().any(|one| one.folder == folder) => {
                self.toasts.info(words::subscribed_already(&folder));
                self.sync_subscribed();
            }
            Ok(folder) => {
                self.state.sheet = Some(Sheet::Subscriptions);
                self.toasts.info(words::subscribed_now(&folder));
                self.mark(Change::Subscribed { folder, on: true });
            }
            Err(problem) => self.toasts.error(problem),
        }
    }

    /// Reads collections and subscriptions from the catalogue.
    pub(super) fn look_up_sets(&mut self) {
        self.queue(|shelf| {
            let sets = || {
                let collections = shelf.collections()?;
                Ok::<_, AppError>(Sets { collections, subscriptions: shelf.subscriptions()? })
            };
            Outcome::Sets(sets())
        });
    }

    pub(super) fn take_sets(&mut self, sets: Result<Sets, AppError>) {
        match sets {
            Ok(sets) => self.state.sets = sets,
            Err(error) => self.report_error(&error),
        }
    }
}
