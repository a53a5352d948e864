//! Hashes ("seals") for products that were stored without one: those of older layouts, and those recovered from a file
//! with broken pages.

use super::CatalogueError;
use super::store::read_product;
use super::verified::{results_are_sealed, seal_of_rows, seal_rows};
use rusqlite::{Connection, Row};

/// Stores seals (hashes of the present rows) for products without one, where everything on which results depend is as
/// it was stored: products in a file of an older layout, which has no seals of rows, and products of which broken pages
/// lost some rows. Returns the keys of the latter.
///
/// # Errors
/// Returns an error if SQLite fails.
pub(super) fn seal_what_is_left(db: &Connection) -> Result<Vec<String>, CatalogueError> {
    let mut ask = db.prepare("SELECT id, key, shown_seal FROM product ORDER BY id")?;
    // A key or a seal that is not a text is one of a damaged product.
    let text = |row: &Row<'_>, column: usize| row.get(column).unwrap_or_default();
    let list: Vec<(i64, String, String)> =
        ask.query_map([], |row| Ok((row.get(0)?, text(row, 1), text(row, 2))))?.collect::<Result<_, _>>()?;
    let mut incomplete = Vec::new();
    for (id, key, seal) in list {
        let is_usable =
            || read_product(db, &key).is_ok_and(|product| results_are_sealed(db, &product).unwrap_or(false));
        if seal_of_rows(db, id)? != seal && is_usable() {
            seal_rows(db, id)?;
            if !seal.is_empty() {
                incomplete.push(key);
            }
        }
    }
    Ok(incomplete)
}
