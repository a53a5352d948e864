//! Import of products into the catalogue, and import and export of packages.

use super::collections::leave_all;
use super::described::described_state;
use super::history::{note, set_paths};
use super::record::{Record, prepare};
use super::sight::bring_back;
use super::store::{USER_RANK, free_key, insert, put_blob, read_product, read_record, replace};
use super::verified::sealed;
use super::waiting::adopt;
use super::{Catalogue, CatalogueError, Imported, NewProduct, Origin, Product, Provenance, StateName};
use crate::compute::btdf::Dataset;
use crate::compute::limits;
use crate::formats::dataset_blob::decode_within;
use crate::formats::package::{self, Package, PackageCurvePoint, PackageProduct, PackageProvenance, PackageState};
use rusqlite::{Connection, Transaction};
use std::collections::HashMap;

impl Catalogue {
    /// Adds a product of the user, whose states are the given datasets in their order. Changes nothing on failure.
    pub fn import(&mut self, datasets: &[Dataset], meta: NewProduct) -> Result<Imported, CatalogueError> {
        let record = prepare(datasets, meta)?;
        let tx = self.change()?;
        let imported = add(&tx, record)?;
        tx.commit()?;
        Ok(imported)
    }

    /// Returns the bytes of a package with the given products.
    pub fn export_package(&self, keys: &[String]) -> Result<Vec<u8>, CatalogueError> {
        let snapshot = self.db.unchecked_transaction()?;
        let mut package = Package::default();
        for key in keys {
            let Record { product, datasets, .. } = read_record(&snapshot, key)?;
            package.products.push(packed(product)?);
            package.datasets.extend(datasets);
        }
        Ok(package::write(&package)?)
    }

    /// Adds all products of a package, or none on failure. Checks their datasets again. A product that the catalogue
    /// already contains, with the same key and the same datasets, is not changed.
    pub fn import_package(&mut self, bytes: &[u8]) -> Result<Vec<Imported>, CatalogueError> {
        Ok(self.import_all(unpack(bytes)?)?.into_iter().map(|one| one.imported).collect())
    }

    /// Adds all of the given products, or none on failure; each is given by its datasets and product data. A product
    /// whose requested key belongs to one with the same datasets is not changed.
    pub fn import_all(&mut self, products: Vec<(Vec<Dataset>, NewProduct)>) -> Result<Vec<Stored>, CatalogueError> {
        let mut records = Vec::new();
        for (datasets, meta) in products {
            let asked = meta.key.is_some();
            records.push((asked, prepare(&datasets, meta)?));
        }
        let tx = self.change()?;
        let mut list = Vec::new();
        for (asked, record) in records {
            let key = record.product.key.clone();
            list.push(if asked && is_there(&tx, &record.product)? {
                // Importing the same data again repairs what was damaged since.
                record.datasets.iter().try_for_each(|(hash, blob)| put_blob(&tx, hash, blob))?;
                let held = read_product(&tx, &key)?;
                if !held.builtin && matches!(sealed(&tx, held), Err(CatalogueError::Damaged(_))) {
                    replace(&tx, &record)?;
                }
                // An imported product is to be visible.
                bring_back(&tx, &key)?;
                Stored { imported: Imported { same_content_as: vec![key.clone()], key }, new: false }
            } else if asked && adopt(&tx, &record)? {
                bring_back(&tx, &key)?;
                // A built-in product that another file computed already.
                Stored { imported: Imported { key, same_content_as: Vec::new() }, new: false }
            } else {
                Stored { imported: add(&tx, record)?, new: true }
            });
        }
        tx.commit()?;
        Ok(list)
    }
}

/// Result of adding one product to the catalogue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stored {
    /// Key of the product in the catalogue, and the keys of products with the same data.
    pub imported: Imported,
    /// Whether the product was added. `false`: the catalogue already contained it, so undoing the import must not
    /// remove it.
    pub new: bool,
}

/// Returns the products of a package, each as its datasets and its product data, checked as by [`package::read`].
///
/// # Errors
/// Returns an error if the bytes are not a package, or something in it is invalid.
pub fn unpack(bytes: &[u8]) -> Result<Vec<(Vec<Dataset>, NewProduct)>, CatalogueError> {
    let package = package::read(bytes)?;
    let mut list = Vec::new();
    let mut left = limits::DECODED_BYTES;
    // What several products name is decoded once; their datasets share its values.
    let mut decoded: HashMap<String, Dataset> = HashMap::new();
    for product in package.products {
        let mut datasets = Vec::new();
        for state in &product.states {
            let hash = state.dataset.clone();
            let blob = package.datasets.get(&hash).map(Vec::as_slice).unwrap_or_default();
            let read = match decoded.remove(&hash) {
                Some(read) => Ok(read),
                None => decode_within(blob, &mut left),
            };
            let mut dataset = read.map_err(|cause| CatalogueError::Dataset { hash: hash.clone(), cause })?;
            decoded.insert(hash, dataset.clone());
            if dataset.state != state.key {
                return Err(CatalogueError::Import(format!(
                    "state \"{}\" of \"{}\" holds a dataset of state \"{}\"",
                    state.key, product.key, dataset.state
                )));
            }
            dataset.described = described_state(&product.system, &state.key);
            datasets.push(dataset);
        }
        list.push((datasets, unpacked(product)));
    }
    Ok(list)
}

/// Stores a checked product of the user under a free key. Returns this key and the keys of products with the same
/// content.
pub(super) fn add(tx: &Transaction, mut record: Record) -> Result<Imported, CatalogueError> {
    let mut same_content_as = Vec::new();
    for (hash, _) in &record.datasets {
        let mut statement = tx.prepare_cached(
            "SELECT DISTINCT p.key FROM product p JOIN state s ON s.product = p.id
             WHERE s.dataset = ? AND p.key NOT IN (SELECT product_key FROM deleted) ORDER BY p.key",
        )?;
        for key in statement.query_map([hash], |row| row.get::<_, String>(0))? {
            let key = key?;
            if !same_content_as.contains(&key) {
                same_content_as.push(key);
            }
        }
    }
    record.product.key = free_key(tx, &record.product.key)?;
    // What an ended subscription's product of this key has left behind is not this one's.
    leave_all(tx, &record.product.key)?;
    tx.execute("DELETE FROM favourite WHERE product_key = ?", [&record.product.key])?;
    insert(tx, &record, USER_RANK)?;
    let key = &record.product.key;
    set_paths(tx, key, &record.paths)?;
    let from = &record.product.provenance.source_file;
    note(tx, key, &if from.is_empty() { "added".to_owned() } else { format!("added from {from}") })?;
    Ok(Imported { key: record.product.key, same_content_as })
}

/// Whether the catalogue file contains this product: the same key with the same states and datasets.
pub(super) fn is_there(db: &Connection, product: &Product) -> Result<bool, CatalogueError> {
    let mut ask = db.prepare_cached(
        "SELECT s.key, s.dataset FROM state s JOIN product p ON s.product = p.id WHERE p.key = ? ORDER BY s.position",
    )?;
    let held: Vec<(String, Option<String>)> =
        ask.query_map([&product.key], |row| Ok((row.get(0)?, row.get(1)?)))?.collect::<Result<_, _>>()?;
    let own = product.states.iter().map(|state| (&state.key, &state.dataset));
    Ok(!held.is_empty() && held.iter().map(|(key, dataset)| (key, dataset)).eq(own))
}

/// Returns the product in the form of a package file.
fn packed(product: Product) -> Result<PackageProduct, CatalogueError> {
    let from = product.provenance;
    let states = product.states.into_iter().map(|state| {
        let missing = || CatalogueError::NotComputed { product: product.key.clone(), state: state.key.clone() };
        let dataset = state.dataset.clone().ok_or_else(missing)?;
        Ok(PackageState { key: state.key, label: state.label, value: state.value, dataset })
    });
    let states = states.collect::<Result<_, CatalogueError>>()?;
    Ok(PackageProduct {
        key: product.key,
        name: product.name,
        manufacturer: product.manufacturer,
        kind: product.kind,
        description: product.description,
        provenance: PackageProvenance {
            origin: from.origin.word().to_owned(),
            author: from.author,
            method: from.method,
            date: from.date,
            source_file: from.source_file,
            source_hash: from.source_hash,
            inside_face: from.inside_face,
        },
        license: product.license,
        tags: product.tags,
        states,
        control_curve: product
            .control_curve
            .into_iter()
            .map(|p| PackageCurvePoint { profile_angle: p.profile_angle, value: p.value })
            .collect(),
        system: product.system,
    })
}

/// Returns the product data of a product in a package, for import.
fn unpacked(product: PackageProduct) -> NewProduct {
    let from = product.provenance;
    NewProduct {
        // Keys from outside become as plain as our own.
        key: Some(super::product::slug(&product.key, &product.manufacturer)),
        name: product.name,
        manufacturer: product.manufacturer,
        kind: product.kind,
        description: product.description,
        provenance: Provenance {
            origin: Origin::from_word(&from.origin),
            author: from.author,
            method: from.method,
            date: from.date,
            source_file: from.source_file,
            source_hash: from.source_hash,
            inside_face: from.inside_face,
        },
        license: product.license,
        tags: product.tags,
        states: product.states.iter().map(|s| StateName { label: s.label.clone(), value: s.value }).collect(),
        control_curve: product
            .control_curve
            .iter()
            .map(|p| super::CurvePoint { profile_angle: p.profile_angle, value: p.value })
            .collect(),
        system: product.system,
        ..NewProduct::default()
    }
}
