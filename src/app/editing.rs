//! Editing of the states of stored products: names and angles, replacement of data, reading the files again. Undo
//! covers all of it.

use super::changes::{Change, Editing, Looked, Reread};
use super::disk::read_bytes;
use super::error::AppError;
use super::import::StateWords;
use super::jobs::Lane;
use super::shelf::Shelf;
use super::state::{PathUse, Sheet};
use super::window::App;
use super::work::{Outcome, ReadDataset};
use crate::catalogue::{Replacement, Snapshot, SourceFile, content_of};
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{recorded, repaired_all};
use crate::texts::{catalogue as text, fixed};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads the data of a product for its sheet from the catalogue.
pub(super) fn look(shelf: &dyn Shelf, key: &str) -> Result<Looked, AppError> {
    let product = shelf.product(key)?;
    let found = shelf.subscribed_folder(key)?;
    Ok(Looked { product, history: shelf.history(key)?, paths: shelf.source_paths(key)?, subscribed: found })
}

fn read(read: ReadDataset, path: &Path) -> Result<SourceFile, AppError> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let bytes = read_bytes(path)?;
    read(&name, &bytes).map_err(|error| AppError::from(error).about(path.display()))
}

/// Returns the replacement of a state's data by those of a file, with the repairs of the product applied.
fn replacement(product: &Snapshot, state: &str, file: &SourceFile, dataset: &Dataset) -> Result<Replacement, AppError> {
    let (_, repairs) = recorded(&product.product().provenance.method);
    Ok(Replacement {
        state: state.to_owned(),
        content: content_of(dataset),
        dataset: repaired_all(dataset, &repairs)?,
        file: file.name.clone(),
    })
}

/// Creates the change that replaces one state by the data of one file.
fn from_file(shelf: &dyn Shelf, key: &str, state: &str, path: &Path, reader: ReadDataset) -> Result<Change, AppError> {
    let file = read(reader, path)?;
    let [dataset] = file.datasets.as_slice() else {
        return Err(AppError::NotOneState(file.datasets.len()).about(path.display()));
    };
    let before = shelf.snapshot(key)?;
    let list = vec![replacement(&before, state, &file, dataset)?];
    Ok(Change::Replaced { key: key.to_owned(), before: Arc::new(before), list: Arc::new(list) })
}

/// Reads the files of a product again and returns the differences from the stored product.
fn reread(shelf: &dyn Shelf, key: &str, reader: ReadDataset) -> Result<Reread, AppError> {
    let before = shelf.snapshot(key)?;
    let paths = shelf.source_paths(key)?;
    let states = &before.product().states;
    if paths.len() != states.len() {
        return Err(AppError::NotAFileEach { files: paths.len(), states: states.len() });
    }
    let (mut list, mut differences) = (Vec::new(), Vec::new());
    for (place, path) in paths.iter().enumerate() {
        let file = read(reader, Path::new(path))?;
        let [dataset] = file.datasets.as_slice() else {
            return Err(AppError::NotOneState(file.datasets.len()).about(path));
        };
        let state = &states[place];
        if before.contents().get(place).is_some_and(|content| *content == content_of(dataset)) {
            continue;
        }
        let one = replacement(&before, &state.key, &file, dataset)?;
        let tau = one.dataset.transmission().map(|btdf| btdf.tau_hemispherical());
        let word = |tau: Option<f64>| tau.map_or_else(|| "–".to_owned(), |tau| fixed(tau, 3));
        differences.push(text::tau_becomes(&file.name, word(state.tau_hemispherical), word(tau)));
        list.push(one);
    }
    let change = (!list.is_empty()).then(|| Change::Replaced {
        key: key.to_owned(),
        before: Arc::new(before),
        list: Arc::new(list),
    });
    Ok(Reread { differences, change })
}

impl App {
    /// Sets the typed name and angle of a state (by its index) of the edited product.
    pub(super) fn edit_state(&mut self, place: usize, words: StateWords) {
        if let Some(state) = self.state.editing.as_mut().and_then(|editing| editing.states.get_mut(place)) {
            *state = words;
        }
    }

    /// Asks for the file that replaces the data of a state.
    pub(super) fn ask_replacement(&mut self, state: String) {
        let Some(editing) = &self.state.editing else { return };
        self.state.replacing = Some((editing.key.clone(), state));
        self.state.path.clear();
        self.state.sheet = Some(Sheet::Path(PathUse::ReplaceState));
        let dialogs = self.services.dialogs.clone();
        self.start(Lane::Export, move |_| {
            let chosen = dialogs.open().map(|paths| paths.into_iter().next());
            Outcome::Target(PathUse::ReplaceState, chosen)
        });
    }

    /// Reads the file that replaces the data of a state.
    pub(super) fn replace_state(&mut self, path: PathBuf) {
        let Some((key, state)) = self.state.replacing.take() else { return };
        let reader = self.services.read;
        self.queue(move |shelf| Outcome::ToReplace(from_file(shelf, &key, &state, &path, reader)));
    }

    pub(super) fn take_replacement(&mut self, change: Result<Change, AppError>) {
        match change {
            Ok(change) => {
                self.change(change);
                self.toasts.success(text::REPLACED);
            }
            Err(error) => self.report_error(&error),
        }
    }

    /// Starts reading the files of the edited product again; the sheet then shows the differences.
    pub(super) fn reread(&mut self) {
        let Some(editing) = &self.state.editing else { return };
        let (key, reader) = (editing.key.clone(), self.services.read);
        self.queue(move |shelf| Outcome::Reread(reread(shelf, &key, reader)));
    }

    pub(super) fn take_reread(&mut self, result: Result<Reread, AppError>) {
        match (result, &mut self.state.editing) {
            (Ok(reread), Some(editing)) => editing.reread = Some(reread),
            (Ok(_), None) => {}
            (Err(error), _) => self.report_error(&error),
        }
    }

    /// Applies the differences found by reading the files again to the catalogue.
    pub(super) fn take_changes(&mut self) {
        let editing: Option<&mut Editing> = self.state.editing.as_mut();
        if let Some(change) = editing.and_then(|editing| editing.reread.take()).and_then(|reread| reread.change) {
            self.state.editing = None;
            self.state.sheet = None;
            self.change(change);
            self.toasts.success(text::TAKEN);
        }
    }
}
