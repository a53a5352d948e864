//! Recovery of a catalogue with broken database pages: the rows that can still be read are copied into a new one.

use super::builtin::is_builtin;
use super::messages::sqlite_message;
use super::sealing::seal_what_is_left;
use super::{Catalogue, CatalogueError};
use rusqlite::types::Value;
use rusqlite::{Connection, params_from_iter};
use std::collections::BTreeSet;

/// Tables of the database, in an order in which each follows those to which it refers.
const TABLES: [&str; 14] = [
    "meta",
    "product",
    "dataset",
    "state",
    "finding",
    "control_point",
    "tag",
    "favourite",
    "deleted",
    "history",
    "source",
    "subscription",
    "subscribed",
    "collection",
];

/// Result of the recovery of a catalogue.
pub(super) struct Saved {
    /// New catalogue with everything that could be read.
    pub(super) db: Connection,
    /// Sentences about what was lost.
    pub(super) lost: Vec<String>,
}

/// Reads every table of a damaged database from both ends, as far as its pages allow, into a new catalogue.
///
/// # Errors
/// Returns an error if the new catalogue cannot be created.
pub(super) fn salvage(damaged: &Connection) -> Result<Saved, CatalogueError> {
    let Catalogue { db, .. } = Catalogue::empty_in_memory()?;
    db.pragma_update(None, "foreign_keys", false)?;
    let mut lost = Vec::new();
    for table in TABLES {
        if let Err(error) = copied(damaged, &db, table) {
            lost.push(format!("rows of table {table} that lie on broken pages ({})", sqlite_message(&error)));
        }
    }
    // What is left of others' rows.
    db.execute_batch(
        "DELETE FROM state WHERE product NOT IN (SELECT id FROM product);
         DELETE FROM finding WHERE NOT EXISTS
           (SELECT 1 FROM state s WHERE s.product = finding.product AND s.position = finding.state);
         DELETE FROM control_point WHERE product NOT IN (SELECT id FROM product);
         DELETE FROM tag WHERE product NOT IN (SELECT id FROM product);",
    )?;
    // Those come with the program.
    db.execute_batch(
        "DELETE FROM state WHERE product IN (SELECT id FROM product WHERE builtin = 1);
         DELETE FROM finding WHERE product IN (SELECT id FROM product WHERE builtin = 1);
         DELETE FROM control_point WHERE product IN (SELECT id FROM product WHERE builtin = 1);
         DELETE FROM tag WHERE product IN (SELECT id FROM product WHERE builtin = 1);
         DELETE FROM product WHERE builtin = 1;
         DELETE FROM dataset WHERE hash NOT IN (SELECT dataset FROM state WHERE dataset IS NOT NULL);",
    )?;
    reset_builtins(&db)?;
    let incomplete = seal_what_is_left(&db)?.into_iter();
    lost.extend(incomplete.map(|key| format!("some words, findings or figures of product \"{key}\"")));
    let stateless: Vec<String> = {
        let mut ask = db.prepare("SELECT key FROM product WHERE id NOT IN (SELECT product FROM state) ORDER BY key")?;
        ask.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?
    };
    for key in stateless {
        db.execute("DELETE FROM product WHERE key = ?", [&key])?;
        lost.push(format!("states of product \"{key}\""));
    }
    let gone: BTreeSet<String> = {
        let mut ask = db.prepare(
            "SELECT product_key FROM (SELECT product_key FROM history UNION SELECT product_key FROM favourite
               UNION SELECT product_key FROM collection UNION SELECT product_key FROM source
               UNION SELECT product_key FROM subscribed)
             WHERE product_key NOT IN (SELECT key FROM product)",
        )?;
        ask.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?
    };
    let own = gone.into_iter().filter(|key| !is_builtin(key));
    lost.extend(own.map(|key| format!("product \"{key}\"")));
    let mut ask = db.prepare(
        "SELECT p.key, s.key FROM state s JOIN product p ON p.id = s.product
         WHERE s.dataset IS NOT NULL AND s.dataset NOT IN (SELECT hash FROM dataset) ORDER BY p.key, s.position",
    )?;
    let states: Vec<(String, String)> =
        ask.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?.collect::<Result<_, _>>()?;
    drop(ask);
    lost.extend(states.iter().map(|(product, state)| format!("data of \"{product}\", state \"{state}\"")));
    Ok(Saved { db, lost })
}

/// Causes all built-in products to be added again when the file is next opened.
///
/// # Errors
/// Returns an error if the database cannot be written.
fn reset_builtins(db: &Connection) -> Result<(), CatalogueError> {
    db.execute("DELETE FROM meta WHERE key = 'builtin_version'", [])?;
    Ok(())
}

/// Copies the readable rows of a table: from the first row until an unreadable one, then from the last row backwards.
fn copied(from: &Connection, to: &Connection, table: &str) -> rusqlite::Result<()> {
    let columns: Vec<String> = {
        // Those of both: a file of an older layout has fewer.
        let list = |db: &Connection| -> rusqlite::Result<Vec<String>> {
            let mut ask = db.prepare("SELECT name FROM pragma_table_info(?) ORDER BY cid")?;
            ask.query_map([table], |row| row.get(0))?.collect()
        };
        let known = list(from)?;
        list(to)?.into_iter().filter(|name| known.contains(name)).collect()
    };
    let names = columns.join(", ");
    let marks = vec!["?"; columns.len()].join(", ");
    let mut insert = to.prepare(&format!("INSERT OR IGNORE INTO {table} ({names}) VALUES ({marks})"))?;
    // The order in which the table lies: an index may be broken where the table is not.
    let ordered = |down: bool| -> rusqlite::Result<String> {
        let keys: Vec<String> = {
            let mut ask = to.prepare("SELECT name FROM pragma_table_info(?) WHERE pk > 0 ORDER BY pk")?;
            ask.query_map([table], |row| row.get(0))?.collect::<Result<_, _>>()?
        };
        let rowid = matches!(table, "product" | "dataset" | "history");
        let keys = if rowid { vec!["rowid".to_owned()] } else { keys };
        let way = if down { " DESC" } else { "" };
        let keys: Vec<String> = keys.iter().map(|key| format!("{key}{way}")).collect();
        Ok(format!("SELECT {names} FROM {table} NOT INDEXED ORDER BY {}", keys.join(", ")))
    };
    let mut broken = None;
    for down in [false, true] {
        let mut ask = from.prepare(&ordered(down)?)?;
        let mut rows = ask.query([])?;
        loop {
            match rows.next() {
                Ok(None) => break,
                Ok(Some(row)) => {
                    let values: rusqlite::Result<Vec<Value>> =
                        (0..columns.len()).map(|column| row.get(column)).collect();
                    match values {
                        // A row that breaks a rule of the table is none that was stored.
                        Ok(values) => drop(insert.execute(params_from_iter(values))),
                        Err(error) => broken = Some(error),
                    }
                }
                Err(error) => {
                    broken = Some(error);
                    break;
                }
            }
        }
        if broken.is_none() {
            return Ok(());
        }
    }
    broken.map_or(Ok(()), Err)
}
