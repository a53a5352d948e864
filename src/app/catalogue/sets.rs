//! Functions of the product list, except for searching: stars, collections, folders of packages. Undo
//! covers all changes that are stored.

use super::changes::Change;
use super::command::CatalogueCommand;
use super::shelf::{Query, Sets};
use super::{Products, meant};
use crate::app::results::work::Outcome;
use crate::app::scene::selection::select_product;
use crate::app::shell::Shell;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::app::state::{PathUse, Sheet};
use crate::study::subscriptions::folder_of;
use crate::texts::catalogue as words;
use std::path::PathBuf;

impl Products {
    /// Executes a command about the product list.
    pub fn act(&mut self, shell: &mut Shell, what: CatalogueCommand) {
        match what {
            CatalogueCommand::Gallery => shell.state.settings.gallery ^= true,
            CatalogueCommand::First => {
                self.first_due = true;
                self.choose_first(shell);
            }
            CatalogueCommand::Recent => {
                let query = Query { recent: !shell.state.query.recent, ..shell.state.query.clone() };
                shell.state.settings.catalogue_open = true;
                shell.state.query = query;
                shell.search();
            }
            CatalogueCommand::Star => {
                let key = shell.state.document.selection.product.clone();
                let starred =
                    shell.state.product.as_ref().filter(|product| product.key == key).map(|one| one.favourite);
                let listed = shell.state.found.entries.iter().find(|entry| entry.key == key).map(|one| one.favourite);
                if let Some(starred) = listed.or(starred) {
                    self.star(shell, key, !starred);
                }
            }
            CatalogueCommand::Collect { name, product, put } => {
                let name = name.trim().to_owned();
                if name.is_empty() {
                    return;
                }
                let Some(key) = meant(shell, product) else { return };
                let collection = shell.state.sets.collections.iter().find(|one| one.name == name);
                let inside = collection.is_some_and(|one| one.products.contains(&key));
                if put {
                    self.collection.clear();
                }
                // An unchanged collection makes no step.
                if inside != put {
                    self.mark(shell, Change::Collected { name, products: vec![key], put });
                }
            }
            CatalogueCommand::Disband(name) => {
                if let Some(one) = shell.state.sets.collections.iter().find(|one| one.name == name) {
                    let products = one.products.clone();
                    self.mark(shell, Change::Collected { name, products, put: false });
                }
            }
            CatalogueCommand::EditName(text) => self.collection = text,
            CatalogueCommand::Subscribe => self.ask_subscription(shell),
            CatalogueCommand::SubscribeTo(path) => self.subscribe(shell, path),
            CatalogueCommand::Unsubscribe(folder) => {
                shell.toasts.info(words::unsubscribed(&folder));
                self.mark(shell, Change::Subscribed { folder, on: false });
            }
        }
    }

    /// Selects the first product of the list as soon as the list shows the result of the typed search.
    pub fn choose_first(&mut self, shell: &mut Shell) {
        if shell.jobs.busy(Lane::Catalogue) || !std::mem::take(&mut self.first_due) {
            return;
        }
        match shell.state.found.entries.first().map(|entry| entry.key.clone()) {
            Some(first) => {
                shell.state.focus_list = true;
                select_product(shell, first);
            }
            // The user continues typing.
            None => shell.state.focus_search = true,
        }
    }

    /// Sets or removes the star of a product.
    pub fn star(&mut self, shell: &mut Shell, key: String, on: bool) {
        self.mark(shell, Change::Starred { key, on });
    }

    /// Makes a change that has no effect on figures (star, collection, subscription), as a separate undo step.
    fn mark(&mut self, shell: &mut Shell, change: Change) {
        let number = self.changes.len();
        self.changes.push(change);
        shell.end_step();
        shell.state.document.marks.push(number);
        shell.end_step();
        self.make_change(shell, number, true);
    }

    /// Asks for a folder to subscribe to, in the path field of the sheet and in a dialog of the desktop.
    fn ask_subscription(&self, shell: &mut Shell) {
        shell.state.path.clear();
        shell.state.sheet = Some(Sheet::Path(PathUse::Subscribe));
        let dialogs = shell.services.dialogs.clone();
        shell.start(Lane::Dialog, move |_| {
            Outcome::Target(
                PathUse::Subscribe,
                dialogs.open_folder(words::SUBSCRIBE_TITLE).map(|paths| paths.into_iter().next()),
            )
        });
    }

    /// Subscribes to a path after checking that it is a folder.
    fn subscribe(&self, shell: &mut Shell, path: PathBuf) {
        shell.remember_folder(&path);
        shell.queue(move |_| Outcome::Folder(folder_of(&path)));
    }

    /// Subscribes to a folder that was checked.
    pub fn take_folder(&mut self, shell: &mut Shell, folder: Result<String, String>) {
        match folder {
            Ok(folder) if shell.state.sets.subscriptions.iter().any(|one| one.folder == folder) => {
                shell.toasts.info(words::subscribed_already(&folder));
                self.sync_subscribed(shell);
            }
            Ok(folder) => {
                shell.state.sheet = Some(Sheet::Subscriptions);
                shell.toasts.info(words::subscribed_now(&folder));
                self.mark(shell, Change::Subscribed { folder, on: true });
            }
            Err(problem) => shell.toasts.error(problem),
        }
    }

    /// Reads collections and subscriptions from the catalogue.
    pub fn look_up_sets(&self, shell: &mut Shell) {
        shell.queue(|shelf| {
            let sets = || {
                let collections = shelf.collections()?;
                Ok::<_, AppError>(Sets { collections, subscriptions: shelf.subscriptions()? })
            };
            Outcome::Sets(sets())
        });
    }

    /// Takes over collections and subscriptions.
    pub fn take_sets(&self, shell: &mut Shell, sets: Result<Sets, AppError>) {
        match sets {
            Ok(sets) => shell.state.sets = sets,
            Err(error) => shell.report_error(&error),
        }
    }
}
