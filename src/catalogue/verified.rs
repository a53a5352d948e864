//! What is read from the file is what was stored: datasets by their hash, products by their seal.

use super::{CatalogueError, Product};
use crate::formats::dataset_blob::content_hash;
use rusqlite::{Connection, OptionalExtension as _};

/// The bytes of a dataset, if they are those that were stored.
///
/// # Errors
/// [`CatalogueError::Damaged`] where they are not, or are gone.
pub(super) fn blob_of(db: &Connection, hash: &str) -> Result<Vec<u8>, CatalogueError> {
    let damaged = |how: &str| CatalogueError::Damaged(format!("dataset {} {how}", short(hash)));
    let found: Option<Vec<u8>> =
        db.prepare_cached("SELECT blob FROM dataset WHERE hash = ?")?.query_row([hash], |row| row.get(0)).optional()?;
    let blob = found.ok_or_else(|| damaged("is gone"))?;
    if content_hash(&blob) == hash { Ok(blob) } else { Err(damaged("is not what was stored")) }
}

/// So much of a hash as a person compares.
pub(super) fn short(hash: &str) -> &str {
    hash.get(..12).unwrap_or(hash)
}

/// Stands for everything of a product that results hang on beside its datasets. Words about it may change without it.
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

/// Is a product what was stored, as far as its seal is known?
///
/// # Errors
/// [`CatalogueError::Damaged`] where it is not.
pub(super) fn sealed(db: &Connection, product: Product) -> Result<Product, CatalogueError> {
    let seal: String =
        db.prepare_cached("SELECT seal FROM product WHERE key = ?")?.query_row([&product.key], |row| row.get(0))?;
    if seal.is_empty() || seal == seal_of(&product) {
        return Ok(product);
    }
    Err(CatalogueError::Damaged(format!(
        "the description, states or control curve of product \"{}\" are not what was stored",
        product.key
    )))
}
