//! Products of folders that are subscribed to: listed among the others, changed by nobody here.

use super::exchange::{is_there, unpack};
use super::history::{forget, note};
use super::record::{Record, prepare};
use super::store::{USER_RANK, delete, free_key, insert};
use super::{Catalogue, CatalogueError};
use rusqlite::{Connection, OptionalExtension, Transaction};
use std::collections::BTreeMap;

/// A folder of packages that is subscribed to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Subscription {
    /// Its path.
    pub folder: String,
    /// How many products come from it.
    pub products: usize,
}

/// What reading a package of such a folder changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Synced {
    /// Products that are there now and were not, or not like this.
    pub taken: usize,
    /// Products that the package does not hold any more.
    pub gone: usize,
}

/// Refuses to change what comes from a folder of packages.
pub(super) fn refuse_subscribed(db: &Connection, key: &str) -> Result<(), CatalogueError> {
    match folder_of(db, key)? {
        Some(folder) => Err(CatalogueError::Subscribed { product: key.to_owned(), folder }),
        None => Ok(()),
    }
}

fn folder_of(db: &Connection, key: &str) -> Result<Option<String>, CatalogueError> {
    let mut ask = db.prepare_cached("SELECT folder FROM subscribed WHERE product_key = ?")?;
    Ok(ask.query_row([key], |row| row.get(0)).optional()?)
}

/// Takes out what came from a package; the keys of its products.
fn take_out(tx: &Transaction<'_>, folder: &str, package: &str) -> Result<Vec<String>, CatalogueError> {
    let mut ask = tx.prepare_cached("SELECT product_key FROM subscribed WHERE folder = ? AND package = ?")?;
    let keys: Vec<String> = ask.query_map([folder, package], |row| row.get(0))?.collect::<Result<_, _>>()?;
    drop(ask);
    for key in &keys {
        tx.execute("DELETE FROM subscribed WHERE product_key = ?", [key])?;
        delete(tx, key)?;
    }
    Ok(keys)
}

impl Catalogue {
    /// Subscribes to a folder of packages; its products come when it is read. Nothing where it is subscribed to already.
    ///
    /// # Errors
    /// Of SQLite.
    pub fn subscribe(&mut self, folder: &str) -> Result<(), CatalogueError> {
        self.db.execute("INSERT OR IGNORE INTO subscription VALUES (?)", [folder])?;
        Ok(())
    }

    /// Ends a subscription: its products go out of the catalogue.
    ///
    /// # Errors
    /// A folder that is not subscribed to.
    pub fn unsubscribe(&mut self, folder: &str) -> Result<usize, CatalogueError> {
        let tx = self.change()?;
        if tx.execute("DELETE FROM subscription WHERE folder = ?", [folder])? == 0 {
            return Err(CatalogueError::NotSubscribed(folder.to_owned()));
        }
        let mut gone = 0;
        for package in packages(&tx, folder)?.keys() {
            for key in take_out(&tx, folder, package)? {
                forget(&tx, &key)?;
                gone += 1;
            }
        }
        tx.commit()?;
        Ok(gone)
    }

    /// Folders that are subscribed to.
    ///
    /// # Errors
    /// Of SQLite.
    pub fn subscriptions(&self) -> Result<Vec<Subscription>, CatalogueError> {
        let mut ask = self.db.prepare_cached(
            "SELECT s.folder, (SELECT count(*) FROM subscribed p WHERE p.folder = s.folder) FROM subscription s ORDER BY 1",
        )?;
        let row = |row: &rusqlite::Row<'_>| {
            let products: i64 = row.get(1)?;
            Ok(Subscription { folder: row.get(0)?, products: usize::try_from(products).unwrap_or_default() })
        };
        Ok(ask.query_map([], row)?.collect::<Result<_, _>>()?)
    }

    /// The folder that a product comes from; `None` for others.
    ///
    /// # Errors
    /// Of SQLite.
    pub fn subscribed_folder(&self, key: &str) -> Result<Option<String>, CatalogueError> {
        folder_of(&self.db, key)
    }

    /// Packages of a folder as they were taken in last: file names with the hashes of their bytes.
    ///
    /// # Errors
    /// Of SQLite.
    pub fn packages_of(&self, folder: &str) -> Result<BTreeMap<String, String>, CatalogueError> {
        packages(&self.db, folder)
    }

    /// Takes in a package of a folder, in place of what came from the file of this name before; `hash`: of its bytes. A
    /// product that the user has, the same, is not taken twice.
    ///
    /// # Errors
    /// No package, or one whose datasets do not match their hashes: what was there before stays.
    pub fn take_package(
        &mut self,
        folder: &str,
        package: &str,
        hash: &str,
        bytes: &[u8],
    ) -> Result<Synced, CatalogueError> {
        let mut records: Vec<Record> = Vec::new();
        for (datasets, meta) in unpack(bytes)? {
            records.push(prepare(&datasets, meta)?);
        }
        let tx = self.change()?;
        let before = take_out(&tx, folder, package)?;
        let mut synced = Synced::default();
        let mut now = Vec::new();
        for mut record in records {
            if is_there(&tx, &record.product)? {
                continue;
            }
            record.product.key = free_key(&tx, &record.product.key)?;
            let key = record.product.key.clone();
            insert(&tx, &record, USER_RANK)?;
            tx.execute("INSERT INTO subscribed VALUES (?, ?, ?, ?)", [&key, folder, package, hash])?;
            let came = if before.contains(&key) { "renewed" } else { "came" };
            note(&tx, &key, &format!("{came} with {package} from {folder}"))?;
            synced.taken += 1;
            now.push(key);
        }
        for key in before.iter().filter(|key| !now.contains(key)) {
            forget(&tx, key)?;
            synced.gone += 1;
        }
        tx.commit()?;
        Ok(synced)
    }

    /// Takes out the products of a package that the folder does not hold any more; how many.
    ///
    /// # Errors
    /// Of SQLite.
    pub fn drop_package(&mut self, folder: &str, package: &str) -> Result<usize, CatalogueError> {
        let tx = self.change()?;
        let keys = take_out(&tx, folder, package)?;
        for key in &keys {
            forget(&tx, key)?;
        }
        tx.commit()?;
        Ok(keys.len())
    }
}

fn packages(db: &Connection, folder: &str) -> Result<BTreeMap<String, String>, CatalogueError> {
    let mut ask = db.prepare_cached("SELECT DISTINCT package, hash FROM subscribed WHERE folder = ?")?;
    Ok(ask.query_map([folder], |row| Ok((row.get(0)?, row.get(1)?)))?.collect::<Result<_, _>>()?)
}
