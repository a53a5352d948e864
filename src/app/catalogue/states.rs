//! Editing of the states of stored products: names and angles, replacement of data, reading the files again. Undo
//! covers all of it.

use super::Products;
use super::changes::{Change, Editing, Reread};
use super::shelf::Shelf;
use crate::app::import::proposal::StateWords;
use crate::app::results::work::{Outcome, ReadDataset};
use crate::app::shell::Shell;
use crate::app::shell::disk::read_bytes;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::app::state::{PathUse, Sheet};
use crate::catalogue::{Replacement, Snapshot, SourceFile, content_of};
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{recorded, repaired_all};
use crate::texts::{catalogue as text, fixed};
use std::path::{Path, PathBuf};
use std::sync::Arc;

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

impl Products {
    /// Sets the typed name and angle of a state (by its index) of the edited product.
    pub fn edit_state(&mut self, place: usize, words: StateWords) {
        if let Some(state) = self.editing.as_mut().and_then(|editing| editing.states.get_mut(place)) {
            *state = words;
        }
    }

    /// Asks for the file that replaces the data of a state.
    pub fn ask_replacement(&mut self, shell: &mut Shell, state: String) {
        let Some(editing) = &self.editing else { return };
        self.replacing = Some((editing.key.clone(), state));
        shell.state.path.clear();
        shell.state.sheet = Some(Sheet::Path(PathUse::ReplaceState));
        let dialogs = shell.services.dialogs.clone();
        shell.start(Lane::Export, move |_| {
            let chosen = dialogs.open().map(|paths| paths.into_iter().next());
            Outcome::Target(PathUse::ReplaceState, chosen)
        });
    }

    /// Reads the file that replaces the data of a state.
    pub fn replace_state(&mut self, shell: &mut Shell, path: PathBuf) {
        let Some((key, state)) = self.replacing.take() else { return };
        let reader = shell.services.read;
        shell.queue(move |shelf| Outcome::ToReplace(from_file(shelf, &key, &state, &path, reader)));
    }

    /// Makes the replacement of a state by a file that was read.
    pub fn take_replacement(&mut self, shell: &mut Shell, change: Result<Change, AppError>) {
        match change {
            Ok(change) => {
                self.change(shell, change);
                shell.toasts.success(text::REPLACED);
            }
            Err(error) => shell.report_error(&error),
        }
    }

    /// Starts reading the files of the edited product again; the sheet then shows the differences.
    pub fn reread(&self, shell: &mut Shell) {
        let Some(editing) = &self.editing else { return };
        let (key, reader) = (editing.key.clone(), shell.services.read);
        shell.queue(move |shelf| Outcome::Reread(reread(shelf, &key, reader)));
    }

    /// Takes over the differences found by reading the files again.
    pub fn take_reread(&mut self, shell: &mut Shell, result: Result<Reread, AppError>) {
        match (result, &mut self.editing) {
            (Ok(reread), Some(editing)) => editing.reread = Some(reread),
            (Ok(_), None) => {}
            (Err(error), _) => shell.report_error(&error),
        }
    }

    /// Applies the differences found by reading the files again to the catalogue.
    pub fn take_changes(&mut self, shell: &mut Shell) {
        let editing: Option<&mut Editing> = self.editing.as_mut();
        if let Some(change) = editing.and_then(|editing| editing.reread.take()).and_then(|reread| reread.change) {
            self.editing = None;
            shell.state.sheet = None;
            self.change(shell, change);
            shell.toasts.success(text::TAKEN);
        }
    }
}
