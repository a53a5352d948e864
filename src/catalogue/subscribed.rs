//! Products from subscribed folders of packages: listed among the others, and not changeable in this catalogue.

use super::exchange::{is_there, unpack};
use super::history::{forget, note};
use super::record::{Record, prepare};
use super::store::{USER_RANK, delete, free_key, insert};
use super::{Catalogue, CatalogueError};
use rusqlite::{Connection, OptionalExtension, Transaction};
use std::collections::BTreeMap;

/// Folder of packages to which the catalogue is subscribed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Subscription {
    /// Path of the folder.
    pub folder: String,
    /// Number of products that come from the folder.
    pub products: usize,
}

/// Number of changes made by reading a package of a subscribed folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Synced {
    /// Number of products that were added or replaced.
    pub taken: usize,
    /// Number of products that were removed because the package no longer contains them.
    pub gone: usize,
}

/// Returns an error if a product comes from a subscribed folder, so that it cannot be changed here.
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

/// Removes the products that were read from a package file of a subscribed folder, and returns their keys.
fn remove_package(tx: &Transaction<'_>, folder: &str, package: &str) -> Result<Vec<String>, CatalogueError> {
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
    /// Subscribes to a folder of packages. Its products are added when the folder is next read. Does nothing if the
    /// catalogue is subscribed to it already.
    ///
    /// # Errors
    /// Returns an error if the database cannot be written.
    pub fn subscribe(&mut self, folder: &str) -> Result<(), CatalogueError> {
        self.db.execute("INSERT OR IGNORE INTO subscription VALUES (?)", [folder])?;
        Ok(())
    }

    /// Ends the subscription to a folder, and removes its products from the catalogue. Returns their number.
    ///
    /// # Errors
    /// Returns an error if the folder is not subscribed.
    pub fn unsubscribe(&mut self, folder: &str) -> Result<usize, CatalogueError> {
        let tx = self.change()?;
        if tx.execute("DELETE FROM subscription WHERE folder = ?", [folder])? == 0 {
            return Err(CatalogueError::NotSubscribed(folder.to_owned()));
        }
        let mut gone = 0;
        for package in packages(&tx, folder)?.keys() {
            for key in remove_package(&tx, folder, package)? {
                forget(&tx, &key)?;
                gone += 1;
            }
        }
        tx.commit()?;
        Ok(gone)
    }

    /// Returns the subscribed folders, each with the number of its products.
    ///
    /// # Errors
    /// Returns an error if the database cannot be read.
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

    /// Returns the subscribed folder that a product comes from; `None` for products from other sources.
    ///
    /// # Errors
    /// Returns an error if the database cannot be read.
    pub fn subscribed_folder(&self, key: &str) -> Result<Option<String>, CatalogueError> {
        folder_of(&self.db, key)
    }

    /// Returns the packages of a subscribed folder as they were last read: file names with the hashes of their bytes.
    ///
    /// # Errors
    /// Returns an error if the database cannot be read.
    pub fn packages_of(&self, folder: &str) -> Result<BTreeMap<String, String>, CatalogueError> {
        packages(&self.db, folder)
    }

    /// Adds the products of a package file of a subscribed folder, in place of those that were read from a file of this
    /// name before. `package`: file name; `hash`: hash of the file's bytes. A product that the user already has with
    /// the same content is not added again.
    ///
    /// # Errors
    /// Returns an error if the bytes are not a package, or its datasets do not match their hashes; nothing changes
    /// then.
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
        let before = remove_package(&tx, folder, package)?;
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

    /// Removes the products of a package file that the subscribed folder no longer contains. Returns their number.
    ///
    /// # Errors
    /// Returns an error if the database cannot be written.
    pub fn drop_package(&mut self, folder: &str, package: &str) -> Result<usize, CatalogueError> {
        let tx = self.change()?;
        let keys = remove_package(&tx, folder, package)?;
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
