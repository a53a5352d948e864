//! Execution of commands about the import sheet: reads files, applies repairs, stores products, manages drafts.

use super::error::AppError;
use super::import::{Import, ImportFields, KeptImport, Proposed};
use super::import_arranging::repair_product;
use super::jobs::Lane;
use super::reading::{Asked, read_files};
use super::shelf::Addition;
use super::state::{Added, CatalogueState, Sheet};
use super::window::{App, end_step};
use crate::catalogue::Grouping;
use crate::compute::doctor::Repair;
use crate::texts::import as text;
use std::path::PathBuf;

impl App {
    /// Reads files, folders and archives into an import.
    pub(super) fn read_paths(&mut self, paths: Vec<PathBuf>) {
        self.read_again(paths, Grouping::Proposed, None);
    }

    /// Reads files into an import, and restores the texts and repairs that were stored for them.
    pub(super) fn read_again(&mut self, paths: Vec<PathBuf>, grouping: Grouping, kept: Option<KeptImport>) {
        if paths.is_empty() {
            return;
        }
        if kept.is_some() && self.state.import.is_none() {
            self.state.under_way.clone_from(&kept);
        }
        if matches!(self.state.catalogue, CatalogueState::Opening) {
            // Whether the same is there already is known when the catalogue is open.
            self.waiting_files.push((paths, grouping, kept));
            return;
        }
        self.state.sheet = None;
        let Some(first) = paths.first() else { return };
        if kept.is_none() {
            self.remember_folder(&first.clone());
        }
        let asked = Asked { paths, grouping, read: self.services.read, shelf: self.state.shelf(), kept };
        self.start(Lane::Import, move |job| read_files(&asked, job));
    }

    /// Starts reading the files that were opened before the catalogue was ready.
    pub(super) fn start_waiting_files(&mut self) {
        let (kept, new): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.waiting_files).into_iter().partition(|(.., kept)| kept.is_some());
        let new: Vec<PathBuf> = new.into_iter().flat_map(|(paths, ..)| paths).collect();
        for (paths, grouping, kept) in kept {
            if new.is_empty() {
                self.read_again(paths, grouping, kept);
            } else {
                // One is read at a time: what was open before waits.
                self.state.under_way = None;
                self.state.drafts.extend(kept);
            }
        }
        self.read_paths(new);
    }

    /// Shows an import that was read; a previous one of other files becomes a draft.
    pub(super) fn take_import(&mut self, import: Import) {
        self.state.under_way = None;
        self.keep_draft_of(|old| old.paths != import.paths);
        self.state.import = Some(import);
        self.state.sheet = Some(Sheet::Import);
        self.repair_next();
    }

    /// Moves the open import to the drafts if `which` returns `true` for it.
    fn keep_draft_of(&mut self, which: impl Fn(&Import) -> bool) {
        let Some(old) = self.state.import.take() else { return };
        if which(&old) && old.wanted().next().is_some() {
            self.state.drafts.retain(|draft| draft.paths != old.paths);
            self.state.drafts.push(KeptImport::of(&old));
        }
    }

    /// Opens a draft, given by its number from 0, again; the open import becomes a draft.
    pub(super) fn open_draft(&mut self, number: usize) {
        if number >= self.state.drafts.len() {
            return;
        }
        let draft = self.state.drafts.remove(number);
        self.keep_draft_of(|_| true);
        self.read_again(draft.paths.clone(), draft.grouping, Some(draft));
    }

    /// Stores the open import as a draft and closes its sheet.
    pub(super) fn keep_draft(&mut self) {
        self.keep_draft_of(|_| true);
        self.state.sheet = None;
        if let Some(draft) = self.state.drafts.last() {
            self.toasts.info(text::kept(&draft.name));
        }
    }

    /// Discards the open import, or a draft, as an undo step.
    pub(super) fn discard_import(&mut self, draft: Option<usize>) {
        let gone = match draft {
            Some(number) if number < self.state.drafts.len() => Some(self.state.drafts.remove(number)),
            Some(_) => None,
            None => {
                self.state.sheet = None;
                // What could be read nowhere is not worth a step.
                self.state.import.take().filter(|import| !import.products.is_empty()).map(|one| KeptImport::of(&one))
            }
        };
        let Some(gone) = gone else { return };
        self.toasts.info(text::discarded(&gone.name));
        end_step(&mut self.undoer, &self.state.document);
        self.state.document.discarded.push(self.state.discarded.len());
        self.state.discarded.push(gone);
        end_step(&mut self.undoer, &self.state.document);
    }

    /// Restores or discards drafts after undo or redo.
    pub(super) fn step_discarded(&mut self, before: &[usize]) {
        let after = self.state.document.discarded.clone();
        for &back in before.iter().filter(|number| !after.contains(number)) {
            let Some(draft) = self.state.discarded.get(back).cloned() else { continue };
            self.state.drafts.push(draft);
            self.open_draft(self.state.drafts.len() - 1);
        }
        for &gone in after.iter().filter(|number| !before.contains(number)) {
            let Some(draft) = self.state.discarded.get(gone).cloned() else { continue };
            self.state.drafts.retain(|other| other.paths != draft.paths);
            if self.state.import.as_ref().is_some_and(|import| import.paths == draft.paths) {
                self.state.import = None;
                self.state.sheet = None;
            }
        }
    }

    pub(super) fn edit_import(&mut self, number: usize, fields: ImportFields) {
        if let Some(product) = self.proposed(number) {
            product.fields = fields;
        }
    }

    pub(super) fn add_anyway(&mut self, number: usize, anyway: bool) {
        if let Some(product) = self.proposed(number) {
            product.add_anyway = anyway;
        }
    }

    fn proposed(&mut self, number: usize) -> Option<&mut Proposed> {
        self.state.import.as_mut()?.products.get_mut(number)
    }

    /// Changes the repairs of an imported product (number from 0). They are applied and checked in a job; until it has
    /// ended the product cannot be stored.
    pub(super) fn repair_import(&mut self, number: usize, change: impl FnOnce(&mut Vec<Repair>)) {
        if let Some(product) = self.proposed(number) {
            change(product.requested_repairs.get_or_insert_with(|| product.repairs.clone()));
            self.repair_next();
        }
    }

    /// Starts the repair job of the next product that waits for one.
    pub(super) fn repair_next(&mut self) {
        let import = self.state.import.as_ref().filter(|_| !self.jobs.busy(Lane::Repair));
        let Some(product) =
            import.and_then(|import| import.products.iter().find(|one| one.requested_repairs.is_some()))
        else {
            return;
        };
        let repairs = product.requested_repairs.clone().unwrap_or_default();
        let product = Proposed { repairs, ..product.clone() };
        self.start(Lane::Repair, move |_| repair_product(&product));
    }

    /// Replaces the data of an imported product, identified by its files, by the repaired ones; texts typed meanwhile
    /// are retained.
    pub(super) fn take_repaired(&mut self, files: &[String], repaired: Result<Box<Proposed>, AppError>) {
        let products = self.state.import.iter_mut().flat_map(|import| &mut import.products);
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
                    self.report_error(&error);
                }
            }
        }
        self.repair_next();
    }

    /// Stores all products of the import that are ready in the catalogue, as one undo step. The others stay in the
    /// sheet.
    pub(super) fn add_import(&mut self) {
        let Some(mut import) =
            self.state.import.take_if(|import| !import.arranging && import.products.iter().any(Proposed::ready))
        else {
            return;
        };
        // Until it is stored the session holds it: nothing is lost if the program ends in between.
        self.state.under_way = Some(KeptImport::of(&import));
        self.state.storing = Some(import.clone());
        let (ready, rest): (Vec<_>, Vec<_>) = import.products.into_iter().partition(Proposed::ready);
        let additions = ready.iter().map(Proposed::addition).collect();
        self.add_to_catalogue(additions);
        if rest.iter().any(Proposed::wanted) {
            let gone: Vec<&String> = ready.iter().flat_map(|one| &one.files).collect();
            import.sources.retain(|file| !gone.contains(&&super::import::file_id(file)));
            import.by_hand = Some(rest.iter().filter(|one| !one.packed).map(|one| one.files.clone()).collect());
            import.products = rest;
            import.selected.clear();
            import.folded.clear();
            import.shown = None;
            self.state.import = Some(import);
            self.state.sheet = Some(Sheet::Import);
        }
    }

    /// Stores products in the catalogue as a separate undo step, and closes their sheet.
    pub(super) fn add_to_catalogue(&mut self, additions: Vec<Addition>) {
        self.state.sheet = None;
        end_step(&mut self.undoer, &self.state.document);
        let mut numbered = Vec::new();
        for addition in additions {
            let number = self.state.additions.len();
            self.state.additions.push(Added { addition: addition.clone(), key: None });
            self.state.document.additions.push(number);
            numbered.push((number, addition));
        }
        self.store_additions(numbered);
    }

    /// Opens an import again if none of its products could be stored.
    pub(super) fn take_not_added(&mut self, numbers: &[usize], error: &AppError) {
        self.adding.retain(|number| !numbers.contains(number));
        self.state.document.additions.retain(|other| !numbers.contains(other));
        if let Some(import) = self.state.storing.take() {
            self.state.import = Some(import);
            self.state.sheet = Some(Sheet::Import);
        }
        self.toasts.error(text::nothing_added(error));
    }
}
