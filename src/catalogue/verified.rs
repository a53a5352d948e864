//! Verification that what is read from the file is what was stored: datasets by their hash, products by two hashes
//! ("seals"), one of everything on which results depend, and one of everything that is shown.

use super::{CatalogueError, Product};
use crate::formats::dataset_blob::content_hash;
use rayon::prelude::*;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension as _, Row, params_from_iter};
use std::collections::{BTreeMap, BTreeSet};

/// Returns the bytes of the dataset with a hash, if they are those that were stored.
///
/// # Errors
/// [`CatalogueError::Damaged`] where they are not, or are missing.
pub(super) fn blob_of(db: &Connection, hash: &str) -> Result<Vec<u8>, CatalogueError> {
    let damaged = |how: &str| CatalogueError::Damaged(format!("dataset {} {how}", short(hash)));
    let found: Option<Vec<u8>> =
        db.prepare_cached("SELECT blob FROM dataset WHERE hash = ?")?.query_row([hash], |row| row.get(0)).optional()?;
    let blob = found.ok_or_else(|| damaged("is gone"))?;
    if content_hash(&blob) == hash { Ok(blob) } else { Err(damaged("is not what was stored")) }
}

/// Returns the first 12 digits of a hash, for messages.
pub(super) fn short(hash: &str) -> &str {
    hash.get(..12).unwrap_or(hash)
}

/// Returns the seal of a product: a hash of everything on which results depend, except its datasets. It does not depend
/// on the descriptive texts.
pub(super) fn seal_of(product: &Product) -> String {
    let mut hash = blake3::Hasher::new();
    let mut text = |text: &str| {
        hash.update(&(text.len() as u64).to_le_bytes()).update(text.as_bytes());
    };
    text(&product.key);
    text(&product.system);
    for state in &product.states {
        text(&state.key);
        text(&state.value.map_or_else(String::new, |value| format!("{:x}", value.to_bits())));
    }
    for point in &product.control_curve {
        text(&format!("{:x} {:x}", point.profile_angle.to_bits(), point.value.to_bits()));
    }
    hash.finalize().to_hex().to_string()
}

/// Tables with the rows of a product: name of the table, key columns, other columns.
const ROWS: [[&str; 3]; 5] = [
    [
        "product",
        "id",
        "key, name, manufacturer, kind, description, origin, author, method, date, source_file, source_hash, inside_face,
         builtin, rank, system, license",
    ],
    [
        "state",
        "product, position",
        "key, label, value, dataset, tau_normal, tau_hemispherical, tau_profile, to_ceiling, sun_blocked, view, content",
    ],
    ["finding", "product, state, position", "severity, code, message"],
    ["control_point", "product, position", "profile_angle, value"],
    ["tag", "product, tag", "tag"],
];

/// Callback for each row that is verified: name of its table, id of its product, and the columns in the order of
/// [`ROWS`], key first.
pub(super) type Visit<'a> = &'a mut dyn FnMut(&str, i64, &Row<'_>);

/// Returns the stored values of every product by its id, or only those of the product `id`, as bytes for hashing. Each
/// row is passed to `visit`.
fn stored_values(db: &Connection, id: Option<i64>, visit: Visit<'_>) -> rusqlite::Result<BTreeMap<i64, Vec<u8>>> {
    let mut products: BTreeMap<i64, Vec<u8>> = BTreeMap::new();
    for [table, key, columns] in ROWS {
        let product = key.split(',').next().unwrap_or(key);
        let filter = if id.is_some() { format!("WHERE {product} = ?") } else { String::new() };
        let mut ask = db.prepare_cached(&format!("SELECT {key}, {columns} FROM {table} {filter} ORDER BY {key}"))?;
        let count = ask.column_count();
        let mut rows = ask.query(params_from_iter(id))?;
        while let Some(row) = rows.next()? {
            let product = row.get(0)?;
            let values = products.entry(product).or_default();
            values.extend_from_slice(table.as_bytes());
            for column in 1..count {
                append(values, row.get_ref(column)?);
            }
            visit(table, product, row);
        }
    }
    Ok(products)
}

/// Returns the seal of a product's rows: a hash of everything that is shown of it.
pub(super) fn seal_of_rows(db: &Connection, id: i64) -> Result<String, CatalogueError> {
    let values = stored_values(db, Some(id), &mut |_, _, _| {})?;
    Ok(shown_seal(values.get(&id).map_or(&[], Vec::as_slice)))
}

/// Appends a value with its type and length, so that no two lists of values give the same bytes.
fn append(values: &mut Vec<u8>, value: ValueRef<'_>) {
    match value {
        ValueRef::Null => values.push(0),
        ValueRef::Integer(number) => {
            values.push(1);
            values.extend_from_slice(&number.to_le_bytes());
        }
        ValueRef::Real(number) => {
            values.push(2);
            values.extend_from_slice(&number.to_bits().to_le_bytes());
        }
        ValueRef::Text(bytes) | ValueRef::Blob(bytes) => {
            values.push(3);
            values.extend_from_slice(&(bytes.len() as u64).to_le_bytes());
            values.extend_from_slice(bytes);
        }
    }
}

fn shown_seal(values: &[u8]) -> String {
    blake3::hash(values).to_hex().to_string()
}

/// Stores the seal of a product's present rows. Every change of rows ends with this call, and begins with verifying
/// them.
///
/// # Errors
/// Returns an error if SQLite fails.
pub(super) fn seal_rows(db: &Connection, id: i64) -> Result<(), CatalogueError> {
    let seal = seal_of_rows(db, id)?;
    db.prepare_cached("UPDATE product SET shown_seal = ? WHERE id = ?")?.execute((seal, id))?;
    Ok(())
}

/// Returns the ids of the products whose rows differ from what was stored. Each row is passed to `visit`, so that lists
/// are read in the same pass.
///
/// # Errors
/// Returns an error if a page is broken, or SQLite fails otherwise.
pub(super) fn damaged_products(db: &Connection, visit: Visit<'_>) -> Result<BTreeSet<i64>, CatalogueError> {
    let mut seals: BTreeMap<i64, Vec<u8>> = BTreeMap::new();
    let mut ask = db.prepare_cached("SELECT id, shown_seal FROM product ORDER BY id")?;
    let mut rows = ask.query([])?;
    while let Some(row) = rows.next()? {
        seals.insert(row.get(0)?, row.get_ref(1)?.as_bytes().unwrap_or_default().to_vec());
    }
    let values = stored_values(db, None, visit)?;
    let is_damaged = |(id, seal): &(i64, Vec<u8>)| values.get(id).is_none_or(|own| shown_seal(own).as_bytes() != seal);
    Ok(seals.into_par_iter().filter(is_damaged).map(|(id, _)| id).collect())
}

/// Whether everything in a product on which results depend is what was stored, as far as its seal is known.
///
/// # Errors
/// Returns an error if SQLite fails.
pub(super) fn results_are_sealed(db: &Connection, product: &Product) -> Result<bool, CatalogueError> {
    let seal: String =
        db.prepare_cached("SELECT seal FROM product WHERE key = ?")?.query_row([&product.key], |row| row.get(0))?;
    Ok(seal.is_empty() || seal == seal_of(product))
}

/// Returns the product if it is what was stored.
///
/// # Errors
/// [`CatalogueError::Damaged`] where it is not.
pub(super) fn sealed(db: &Connection, product: Product) -> Result<Product, CatalogueError> {
    let damaged = |what: &str| {
        Err(CatalogueError::Damaged(format!("{what} of product \"{}\" are not what was stored", product.key)))
    };
    if !results_are_sealed(db, &product)? {
        return damaged("the description, states or control curve");
    }
    // A file of an older layout that is only looked at.
    if !db.column_exists(None, "product", "shown_seal")? {
        return Ok(product);
    }
    let (id, seal): (i64, String) = db
        .prepare_cached("SELECT id, shown_seal FROM product WHERE key = ?")?
        .query_row([&product.key], |row| Ok((row.get(0)?, row.get(1)?)))?;
    if seal_of_rows(db, id)? != seal {
        return damaged("the name, other words or figures");
    }
    Ok(product)
}
