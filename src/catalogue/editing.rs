//! Editing of stored products: new names and angles of states, new data, and undo by snapshots.

use super::history::{forget, note, paths_of};
use super::record::{Record, prepare};
use super::store::{delete, read_product, read_record, replace};
use super::{Catalogue, CatalogueError, NewProduct, Product, StateName};
use crate::compute::btdf::Dataset;
use rusqlite::Transaction;

/// Product of the user with its data at one point in time, for undo; [`Catalogue::put_back`] restores it.
#[derive(Debug, Clone)]
pub struct Snapshot(Record);

impl Snapshot {
    /// Returns the product.
    pub const fn product(&self) -> &Product {
        &self.0.product
    }

    /// Returns the content hashes of its states as they were read from files, in their order, see
    /// [`super::content_of`]; empty where they are not known.
    pub fn contents(&self) -> &[String] {
        &self.0.contents
    }
}

/// New data for one state of a product.
#[derive(Debug, Clone, PartialEq)]
pub struct Replacement {
    /// Key of the state whose data are replaced.
    pub state: String,
    /// New dataset of the state, in the version to be stored (possibly compressed).
    pub dataset: Dataset,
    /// Content hash of the dataset as it was read from the file, see [`super::content_of`].
    pub content: String,
    /// Name of the file that the data were read from.
    pub file: String,
}

/// Returns the product with a key. Returns an error if it is built in or comes from a subscribed folder, so that the
/// user cannot change it.
fn own(tx: &Transaction<'_>, key: &str) -> Result<Record, CatalogueError> {
    super::subscribed::refuse_subscribed(tx, key)?;
    if read_product(tx, key)?.builtin {
        return Err(CatalogueError::BuiltInWords(key.to_owned()));
    }
    let mut record = read_record(tx, key)?;
    record.paths = paths_of(tx, key)?;
    Ok(record)
}

fn tau(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.3}"))
}

impl Catalogue {
    /// Returns a snapshot of a product of the user as it is now stored.
    ///
    /// # Errors
    /// Returns an error if there is no such product, or it is not the user's own.
    pub fn snapshot(&mut self, key: &str) -> Result<Snapshot, CatalogueError> {
        let tx = self.change()?;
        Ok(Snapshot(own(&tx, key)?))
    }

    /// Restores a product, including its data, to a snapshot.
    ///
    /// # Errors
    /// Returns an error if the product no longer exists.
    pub fn put_back(&mut self, snapshot: &Snapshot) -> Result<(), CatalogueError> {
        let key = &snapshot.0.product.key;
        let tx = self.change()?;
        own(&tx, key)?;
        replace(&tx, &snapshot.0)?;
        note(&tx, key, "The last change was taken back")?;
        tx.commit()?;
        Ok(())
    }

    /// Changes the labels and numbers (such as slat angles) of a product's states, in their order. The keys of the
    /// states do not change, so that scenes still find them.
    ///
    /// # Errors
    /// Returns an error if the product is not the user's own, or if the number of states differs.
    pub fn name_states(&mut self, key: &str, names: &[StateName]) -> Result<(), CatalogueError> {
        let tx = self.change()?;
        let mut record = own(&tx, key)?;
        let states = &mut record.product.states;
        if names.len() != states.len() {
            return Err(CatalogueError::Import(format!(
                "{} names for {} states of \"{key}\"",
                names.len(),
                states.len()
            )));
        }
        let mut notes = Vec::new();
        for (state, name) in states.iter_mut().zip(names) {
            let label = if name.label.trim().is_empty() { state.key.as_str() } else { name.label.trim() };
            let angle = |value: Option<f64>| value.map_or_else(|| "no angle".to_owned(), |value| format!("{value}°"));
            if state.label != label {
                notes.push(format!("state {}: “{}” became “{label}”", state.key, state.label));
            }
            if state.value != name.value {
                notes.push(format!("state {}: {} became {}", state.key, angle(state.value), angle(name.value)));
            }
            (state.label, state.value) = (label.to_owned(), name.value);
        }
        if !notes.is_empty() {
            replace(&tx, &record)?;
            note(&tx, key, &notes.join("; "))?;
        }
        tx.commit()?;
        Ok(())
    }

    /// Replaces the data of some states of a product, all in one transaction. Labels and numbers of the states do not
    /// change.
    ///
    /// # Errors
    /// Returns an error if the product is not the user's own, has no such state, or if the data cannot be stored;
    /// nothing changes then.
    pub fn replace_states(&mut self, key: &str, list: &[Replacement]) -> Result<(), CatalogueError> {
        let mut fresh = Vec::new();
        for one in list {
            let dataset = Dataset { state: one.state.clone(), ..one.dataset.clone() };
            let meta =
                NewProduct { name: key.to_owned(), contents: vec![one.content.clone()], ..NewProduct::default() };
            fresh.push(prepare(&[dataset], meta)?);
        }
        let tx = self.change()?;
        let mut record = own(&tx, key)?;
        let mut notes = Vec::new();
        for (one, new) in list.iter().zip(fresh) {
            let product = &mut record.product;
            let Some(place) = product.states.iter().position(|state| state.key == one.state) else {
                return Err(CatalogueError::NoState {
                    product: key.to_owned(),
                    what: format!("no state \"{}\"", one.state),
                    states: product.states.iter().map(|s| format!("\"{}\"", s.key)).collect::<Vec<_>>().join(", "),
                });
            };
            let old = &product.states[place];
            let Some(new_state) = new.product.states.into_iter().next() else { continue };
            let named = if one.state.is_empty() { String::new() } else { format!(" of state {}", one.state) };
            notes.push(format!(
                "data{named} replaced by {}: τ {} became {}",
                one.file,
                tau(old.tau_hemispherical),
                tau(new_state.tau_hemispherical)
            ));
            let state = super::State { label: old.label.clone(), value: old.value, ..new_state };
            product.states[place] = state;
            product.findings.retain(|finding| finding.state != one.state);
            product.findings.extend(new.product.findings);
            // What was computed from a description is so no longer.
            product.system.clear();
            // Not those files' any more: found by its content alone from now on.
            product.provenance.source_hash.clear();
            if let Some(content) = record.contents.get_mut(place) {
                content.clone_from(&one.content);
            }
            record.datasets.extend(new.datasets);
        }
        replace(&tx, &record)?;
        note(&tx, key, &notes.join("; "))?;
        tx.commit()?;
        Ok(())
    }

    /// Removes products of the user permanently, all in one transaction.
    ///
    /// # Errors
    /// Returns an error if one does not exist or is not the user's own; then all stay.
    pub fn remove_products(&mut self, keys: &[String]) -> Result<(), CatalogueError> {
        let tx = self.change()?;
        for key in keys {
            if read_product(&tx, key)?.builtin {
                return Err(CatalogueError::BuiltIn(key.clone()));
            }
            super::subscribed::refuse_subscribed(&tx, key)?;
            tx.execute("DELETE FROM favourite WHERE product_key = ?", [key])?;
            super::sight::bring_back(&tx, key)?;
            super::collections::leave_all(&tx, key)?;
            forget(&tx, key)?;
            delete(&tx, key)?;
        }
        tx.commit()?;
        Ok(())
    }
}
