//! Imports of the window: files that were read and are not stored yet, and drafts. Reads files, applies repairs, hands
//! over what is to be stored.

mod arranging;
pub mod proposal;
mod reading;
pub mod step;
mod table;

use super::shell::Shell;
use super::state::{CatalogueState, Sheet};
use crate::app::catalogue::shelf::Addition;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::catalogue::Grouping;
use crate::compute::doctor::Repair;
use crate::texts::import as text;
use arranging::repair_product;
use proposal::{Arranged, Import, ImportFields, KeptImport, Proposed, file_id};
use reading::{Asked, read_files};
use std::path::PathBuf;

/// Files to be read as soon as the catalogue is open: paths, grouping into products, and the stored import they belong
/// to.
type Waiting = (Vec<PathBuf>, Grouping, Option<KeptImport>);

/// Imports of the window: the open one, drafts, and what undo restores.
#[derive(Default)]
pub struct Imports {
    /// Open import.
    open: Option<Import>,
    /// Import that is being read from its files or written to the catalogue, as stored in the session.
    under_way: Option<KeptImport>,
    /// Import whose products are being stored; it is opened again if they cannot be.
    storing: Option<Import>,
    /// Drafts.
    drafts: Vec<KeptImport>,
    /// Imports and drafts that were discarded in this session.
    discarded: Vec<KeptImport>,
    /// Changes of an import's grouping in this session.
    arranged: Vec<Arranged>,
    /// Files that wait for the catalogue.
    waiting: Vec<Waiting>,
}

impl Imports {
    /// Returns the open import.
    pub const fn open(&self) -> Option<&Import> {
        self.open.as_ref()
    }

    /// Returns the drafts.
    pub fn drafts(&self) -> &[KeptImport] {
        &self.drafts
    }

    /// Returns the import that is being read or written, as stored in the session.
    pub const fn under_way(&self) -> Option<&KeptImport> {
        self.under_way.as_ref()
    }

    /// Sets the drafts, those of a restored session.
    pub fn take_up(&mut self, drafts: Vec<KeptImport>) {
        self.drafts = drafts;
    }

    /// Reads files, folders and archives into an import.
    pub fn read_paths(&mut self, shell: &mut Shell, paths: Vec<PathBuf>) {
        self.read_again(shell, paths, Grouping::Proposed, None);
    }

    /// Reads files into an import, and restores the texts and repairs that were stored for them.
    pub fn read_again(&mut self, shell: &mut Shell, paths: Vec<PathBuf>, grouping: Grouping, kept: Option<KeptImport>) {
        if paths.is_empty() {
            return;
        }
        if kept.is_some() && self.open.is_none() {
            self.under_way.clone_from(&kept);
        }
        if matches!(shell.state.catalogue, CatalogueState::Opening) {
            // Whether the same is there already is known when the catalogue is open.
            self.waiting.push((paths, grouping, kept));
            return;
        }
        shell.state.sheet = None;
        let Some(first) = paths.first() else { return };
        if kept.is_none() {
            shell.remember_folder(&first.clone());
        }
        let asked = Asked { paths, grouping, read: shell.services.read, shelf: shell.state.shelf(), kept };
        shell.start(Lane::Import, move |job| read_files(&asked, job));
    }

    /// Starts reading the files that were opened before the catalogue was ready.
    pub fn start_waiting_files(&mut self, shell: &mut Shell) {
        let (kept, new): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.waiting).into_iter().partition(|(.., kept)| kept.is_some());
        let new: Vec<PathBuf> = new.into_iter().flat_map(|(paths, ..)| paths).collect();
        for (paths, grouping, kept) in kept {
            if new.is_empty() {
                self.read_again(shell, paths, grouping, kept);
            } else {
                // One is read at a time: what was open before waits.
                self.under_way = None;
                self.drafts.extend(kept);
            }
        }
        self.read_paths(shell, new);
    }

    /// Shows an import that was read; a previous one of other files becomes a draft.
    pub fn take(&mut self, shell: &mut Shell, import: Import) {
        self.under_way = None;
        self.keep_draft_of(|old| old.paths != import.paths);
        self.open = Some(import);
        shell.state.sheet = Some(Sheet::Import);
        self.repair_next(shell);
    }

    /// Moves the open import to the drafts if `which` returns `true` for it.
    fn keep_draft_of(&mut self, which: impl Fn(&Import) -> bool) {
        let Some(old) = self.open.take() else { return };
        if which(&old) && old.wanted().next().is_some() {
            self.drafts.retain(|draft| draft.paths != old.paths);
            self.drafts.push(KeptImport::of(&old));
        }
    }

    /// Opens a draft, given by its number from 0, again; the open import becomes a draft.
    pub fn open_draft(&mut self, shell: &mut Shell, number: usize) {
        if number >= self.drafts.len() {
            return;
        }
        let draft = self.drafts.remove(number);
        self.keep_draft_of(|_| true);
        self.read_again(shell, draft.paths.clone(), draft.grouping, Some(draft));
    }

    /// Stores the open import as a draft and closes its sheet.
    pub fn keep_draft(&mut self, shell: &mut Shell) {
        self.keep_draft_of(|_| true);
        shell.state.sheet = None;
        if let Some(draft) = self.drafts.last() {
            shell.toasts.info(text::kept(&draft.name));
        }
    }

    /// Discards the open import, or a draft, as an undo step.
    pub fn discard(&mut self, shell: &mut Shell, draft: Option<usize>) {
        let gone = match draft {
            Some(number) if number < self.drafts.len() => Some(self.drafts.remove(number)),
            Some(_) => None,
            None => {
                shell.state.sheet = None;
                // What could be read nowhere is not worth a step.
                self.open.take().filter(|import| !import.products.is_empty()).map(|one| KeptImport::of(&one))
            }
        };
        let Some(gone) = gone else { return };
        shell.toasts.info(text::discarded(&gone.name));
        shell.end_step();
        shell.state.document.discarded.push(self.discarded.len());
        self.discarded.push(gone);
        shell.end_step();
    }

    /// Restores or discards drafts after undo or redo.
    pub fn step_discarded(&mut self, shell: &mut Shell, before: &[usize]) {
        let after = shell.state.document.discarded.clone();
        for &back in before.iter().filter(|number| !after.contains(number)) {
            let Some(draft) = self.discarded.get(back).cloned() else { continue };
            self.drafts.push(draft);
            self.open_draft(shell, self.drafts.len() - 1);
        }
        for &gone in after.iter().filter(|number| !before.contains(number)) {
            let Some(draft) = self.discarded.get(gone).cloned() else { continue };
            self.drafts.retain(|other| other.paths != draft.paths);
            if self.open.as_ref().is_some_and(|import| import.paths == draft.paths) {
                self.open = None;
                shell.state.sheet = None;
            }
        }
    }

    /// Sets the texts of an imported product (number from 0), as typed.
    pub fn edit(&mut self, number: usize, fields: ImportFields) {
        if let Some(product) = self.proposed(number) {
            product.fields = fields;
        }
    }

    /// Sets whether an imported product (number from 0) is stored although its data are in the catalogue already.
    pub fn add_anyway(&mut self, number: usize, anyway: bool) {
        if let Some(product) = self.proposed(number) {
            product.add_anyway = anyway;
        }
    }

    fn proposed(&mut self, number: usize) -> Option<&mut Proposed> {
        self.open.as_mut()?.products.get_mut(number)
    }

    /// Changes the repairs of an imported product (number from 0). They are applied and checked in a job; until it has
    /// ended the product cannot be stored.
    pub fn repair(&mut self, shell: &mut Shell, number: usize, change: impl FnOnce(&mut Vec<Repair>)) {
        if let Some(product) = self.proposed(number) {
            change(product.requested_repairs.get_or_insert_with(|| product.repairs.clone()));
            self.repair_next(shell);
        }
    }

    /// Starts the repair job of the next product that waits for one.
    fn repair_next(&self, shell: &mut Shell) {
        let import = self.open.as_ref().filter(|_| !shell.jobs.busy(Lane::Repair));
        let Some(product) =
            import.and_then(|import| import.products.iter().find(|one| one.requested_repairs.is_some()))
        else {
            return;
        };
        let repairs = product.requested_repairs.clone().unwrap_or_default();
        let product = Proposed { repairs, ..product.clone() };
        shell.start(Lane::Repair, move |_| repair_product(&product));
    }

    /// Replaces the data of an imported product, identified by its files, by the repaired ones; texts typed meanwhile
    /// are retained.
    pub fn take_repaired(&mut self, shell: &mut Shell, files: &[String], repaired: Result<Box<Proposed>, AppError>) {
        let products = self.open.iter_mut().flat_map(|import| &mut import.products);
        if let Some(product) = products.into_iter().find(|product| product.files == files) {
            match repaired {
                Ok(repaired) => {
                    // Another one may have been wished since: it is made next.
                    product.requested_repairs.take_if(|requested| *requested == repaired.repairs);
                    (product.datasets, product.taus) = (repaired.datasets, repaired.taus);
                    (product.diagnoses, product.repairs) = (repaired.diagnoses, repaired.repairs);
                }
                Err(error) => {
                    product.requested_repairs = None;
                    shell.report_error(&error);
                }
            }
        }
        self.repair_next(shell);
    }

    /// Returns all products of the import that are ready, to be stored in the catalogue, and closes the sheet; the others
    /// stay in it. Until [`Self::stored`] or [`Self::not_stored`] the session holds them.
    pub fn take_ready(&mut self, shell: &mut Shell) -> Vec<Addition> {
        let Some(mut import) =
            self.open.take_if(|import| !import.arranging && import.products.iter().any(Proposed::ready))
        else {
            return Vec::new();
        };
        // Until it is stored the session holds it: nothing is lost if the program ends in between.
        self.under_way = Some(KeptImport::of(&import));
        self.storing = Some(import.clone());
        let (ready, rest): (Vec<_>, Vec<_>) = import.products.into_iter().partition(Proposed::ready);
        let additions = ready.iter().map(Proposed::addition).collect();
        shell.state.sheet = None;
        if rest.iter().any(Proposed::wanted) {
            let gone: Vec<&String> = ready.iter().flat_map(|one| &one.files).collect();
            import.sources.retain(|file| !gone.contains(&&file_id(file)));
            import.by_hand = Some(rest.iter().filter(|one| !one.packed).map(|one| one.files.clone()).collect());
            import.products = rest;
            import.selected.clear();
            import.folded.clear();
            import.shown = None;
            self.open = Some(import);
            shell.state.sheet = Some(Sheet::Import);
        }
        additions
    }

    /// Forgets the products that were being stored, now that they are.
    pub fn stored(&mut self) {
        (self.under_way, self.storing) = (None, None);
    }

    /// Opens an import again of which no product could be stored.
    pub fn not_stored(&mut self, shell: &mut Shell) {
        self.under_way = None;
        if let Some(import) = self.storing.take() {
            self.open = Some(import);
            shell.state.sheet = Some(Sheet::Import);
        }
    }

    /// Drops what was to be read, after its job has ended without a result or was cancelled.
    pub fn not_read(&mut self) {
        self.under_way = None;
    }

    /// Drops the repairs that were to be made, after their job was cancelled.
    pub fn stop_repairs(&mut self) {
        for product in self.open.iter_mut().flat_map(|import| &mut import.products) {
            product.requested_repairs = None;
        }
    }
}
