//! History of the changes of products, and the paths of the files that they were read from.

use super::{Catalogue, CatalogueError};
use rusqlite::{Connection, Transaction};

/// Event in the history of a product, such as its import or a change of its texts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Event {
    /// Time of the event as UTC text, `YYYY-MM-DDThh:mm:ssZ`.
    pub at: String,
    /// Description of the event, in a sentence.
    pub what: String,
}

/// Description of the event in which a damaged built-in product was restored.
pub(super) const RESTORED: &str = "was damaged in the file, and restored from what the program contains";

/// Adds an event to the history of a product, in the transaction of the change itself.
pub(super) fn note(tx: &Transaction<'_>, key: &str, what: &str) -> Result<(), CatalogueError> {
    tx.prepare_cached(
        "INSERT INTO history (product_key, at, what) VALUES (?, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'), ?)",
    )?
    .execute([key, what])?;
    Ok(())
}

/// Deletes the history of a product that was removed permanently, because another one may get its key.
pub(super) fn forget(tx: &Transaction<'_>, key: &str) -> Result<(), CatalogueError> {
    tx.execute("DELETE FROM history WHERE product_key = ?", [key])?;
    tx.execute("DELETE FROM source WHERE product_key = ?", [key])?;
    Ok(())
}

/// Stores the paths of the files that a product was read from.
pub(super) fn set_paths(tx: &Transaction<'_>, key: &str, paths: &[String]) -> Result<(), CatalogueError> {
    tx.execute("DELETE FROM source WHERE product_key = ?", [key])?;
    for (position, path) in paths.iter().enumerate() {
        tx.prepare_cached("INSERT INTO source VALUES (?, ?, ?)")?.execute((key, position as i64, path))?;
    }
    Ok(())
}

pub(super) fn paths_of(db: &Connection, key: &str) -> Result<Vec<String>, CatalogueError> {
    let mut ask = db.prepare_cached("SELECT path FROM source WHERE product_key = ? ORDER BY position")?;
    Ok(ask.query_map([key], |row| row.get(0))?.collect::<Result<_, _>>()?)
}

impl Catalogue {
    /// Returns the history of a product, newest event at the top.
    ///
    /// # Errors
    /// Returns an error if there is no such product.
    pub fn history(&self, key: &str) -> Result<Vec<Event>, CatalogueError> {
        self.product(key)?;
        let mut ask = self.db.prepare_cached("SELECT at, what FROM history WHERE product_key = ? ORDER BY id DESC")?;
        let row = |row: &rusqlite::Row<'_>| Ok(Event { at: row.get(0)?, what: row.get(1)? });
        Ok(ask.query_map([key], row)?.collect::<Result<_, _>>()?)
    }

    /// Returns the paths of the files that a product was read from; empty where they are not known.
    ///
    /// # Errors
    /// Returns an error if the database cannot be read.
    pub fn source_paths(&self, key: &str) -> Result<Vec<String>, CatalogueError> {
        paths_of(&self.db, key)
    }
}
