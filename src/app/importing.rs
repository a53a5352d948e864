//! The import sheet's part of the window: reads what was opened, tries repairs, stores what is wanted.

use super::disk::ends_in;
use super::import::{ImportFields, KeptImport, Proposed};
use super::jobs::Lane;
use super::reading::{Asked, mend, read_files};
use super::shelf::Addition;
use super::state::{Added, CatalogueState};
use super::window::App;
use crate::catalogue::Grouping;
use crate::compute::doctor::Repair;
use std::path::PathBuf;

impl App {
    /// Reads files and folders.
    pub(super) fn read_paths(&mut self, paths: Vec<PathBuf>) {
        self.read_again(paths, Grouping::Proposed, None);
    }

    /// Reads files, and gives what they make the words and repairs that were given to the same before.
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
        // A package is whole: it needs no questions, and goes where it came from.
        let (packages, paths): (Vec<_>, Vec<_>) = paths.into_iter().partition(|path| ends_in(path, "cfsp"));
        packages.into_iter().for_each(|path| self.import_package(path));
        let Some(first) = paths.first() else { return };
        if kept.is_none() {
            self.remember_folder(&first.clone());
        }
        let asked = Asked { paths, grouping, read: self.services.read, shelf: self.state.shelf(), kept };
        self.start(Lane::Import, move |job| read_files(&asked, job));
    }

    /// Reads what was asked for before the catalogue was open.
    pub(super) fn start_waiting_files(&mut self) {
        for (paths, grouping, kept) in std::mem::take(&mut self.waiting_files) {
            self.read_again(paths, grouping, kept);
        }
    }

    /// Takes the files for other products; words and repairs stay with those that remain the same.
    pub(super) fn group_import(&mut self, grouping: Grouping) {
        let Some(import) = &self.state.import else { return };
        if import.grouping != grouping {
            let kept = KeptImport::of(import);
            self.read_again(import.paths.clone(), grouping, Some(kept));
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

    /// What was read with other repairs, made and examined in the background.
    pub(super) fn repair_import(&mut self, number: usize, change: impl FnOnce(&mut Vec<Repair>)) {
        let Some(mut product) = self.proposed(number).cloned() else { return };
        change(&mut product.repairs);
        self.start(Lane::Import, move |_| mend(number, &product));
    }

    /// Takes the repaired data in; words that were typed meanwhile stay.
    pub(super) fn take_mended(&mut self, number: usize, mended: Proposed) {
        let same = |product: &&mut Proposed| product.provenance == mended.provenance;
        if let Some(product) = self.proposed(number).filter(same) {
            (product.datasets, product.diagnoses, product.repairs) =
                (mended.datasets, mended.diagnoses, mended.repairs);
        }
    }

    /// Stores all products that are wanted, as one step.
    pub(super) fn add_import(&mut self) {
        let Some(import) = &self.state.import else { return };
        if import.wanted().next().is_none() || import.wanted().any(|product| !product.named()) {
            return;
        }
        let additions = import.wanted();
        let additions =
            additions.map(|one| Addition { datasets: one.datasets.clone(), product: one.product() }).collect();
        // Until it is stored the session holds it: nothing is lost if the program ends in between.
        self.state.under_way = Some(KeptImport::of(import));
        self.state.import = None;
        self.add_to_catalogue(additions);
    }

    /// Stores products as a step of its own, and closes the sheet that they came from.
    pub(super) fn add_to_catalogue(&mut self, additions: Vec<Addition>) {
        self.state.sheet = None;
        self.undoer.add_undo(&self.state.document);
        let mut numbered = Vec::new();
        for addition in additions {
            let number = self.state.additions.len();
            self.state.additions.push(Added { addition: addition.clone(), key: None });
            self.state.document.additions.push(number);
            numbered.push((number, addition));
        }
        self.store_additions(numbered);
    }
}
