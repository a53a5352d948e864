//! Changes of stored products: their descriptive texts, hiding and restoring them, and finding products by content.

use super::history::note;
use super::sight::{bring_back, is_deleted};
use super::store::read_product;
use super::subscribed::refuse_subscribed;
use super::verified::{seal_rows, sealed};
use super::{Catalogue, CatalogueError, Product};
use crate::texts::composed;
use rusqlite::Connection;

/// Descriptive texts of a product that the user can change.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Words {
    /// Name; not empty.
    pub name: String,
    /// Maker; may be empty.
    pub manufacturer: String,
    /// Kind, e.g. `venetian`; may be empty.
    pub kind: String,
    /// Tags to find the product by.
    pub tags: Vec<String>,
    /// Licence of the data; may be empty.
    pub license: String,
}

/// Hidden product, which the user deleted and can restore.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Deleted {
    /// Key by which the product is restored.
    pub key: String,
    /// Name of the product.
    pub name: String,
    /// Time at which it was hidden: UTC, `YYYY-MM-DDThh:mm:ssZ`.
    pub at: String,
    /// Whether the product comes with the program.
    pub builtin: bool,
}

/// Key and name of a product in the catalogue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Known {
    /// Key of the product.
    pub key: String,
    /// Name of the product.
    pub name: String,
}

/// Returns a sentence that names the descriptive texts that changed; empty where nothing changed.
fn words_changed(before: &Product, after: &Words) -> String {
    let [tags, new_tags] = [before.tags.join(", "), after.tags.join(", ")];
    let fields = [
        ("name", before.name.as_str(), after.name.as_str()),
        ("maker", &before.manufacturer, &after.manufacturer),
        ("kind", &before.kind, &after.kind),
        ("tags", &tags, &new_tags),
        ("license", &before.license, &after.license),
    ];
    let changed = fields.iter().filter(|(_, old, new)| old != new);
    let words: Vec<String> = changed.map(|(field, old, new)| format!("{field} “{old}” became “{new}”")).collect();
    words.join("; ")
}

/// Returns key and name of a product; for a damaged product the key also as its name.
fn named(db: &Connection, key: String) -> Known {
    let product = read_product(db, &key).and_then(|product| sealed(db, product));
    Known { name: product.map_or_else(|_| key.clone(), |product| product.name), key }
}

impl Catalogue {
    /// Changes the descriptive texts of a product of the user. Its key does not change, so that scenes still find it.
    ///
    /// # Errors
    /// Returns an error if there is no such product, if it is built in, or if the name is empty.
    pub fn describe(&mut self, key: &str, words: &Words) -> Result<(), CatalogueError> {
        let tx = self.change()?;
        let product = read_product(&tx, key)?;
        if product.builtin {
            return Err(CatalogueError::BuiltInWords(key.to_owned()));
        }
        refuse_subscribed(&tx, key)?;
        // The new seal would also cover damage elsewhere in the product.
        let product = sealed(&tx, product)?;
        let [name, manufacturer, kind, license] =
            [&words.name, &words.manufacturer, &words.kind, &words.license].map(|text| composed(text.trim()));
        if name.is_empty() {
            return Err(CatalogueError::NoName(key.to_owned()));
        }
        let mut tags: Vec<String> = words.tags.iter().map(|tag| composed(tag.trim())).collect();
        tags.retain(|tag| !tag.is_empty());
        tags.sort_unstable();
        tags.dedup();
        let id: i64 = tx.query_row("SELECT id FROM product WHERE key = ?", [key], |row| row.get(0))?;
        tx.execute(
            "UPDATE product SET name = ?1, manufacturer = ?2, kind = ?3, license = ?4 WHERE id = ?5",
            (&name, &manufacturer, &kind, &license, id),
        )?;
        tx.execute("DELETE FROM tag WHERE product = ?", [id])?;
        for tag in &tags {
            tx.execute("INSERT INTO tag VALUES (?, ?)", (id, tag))?;
        }
        seal_rows(&tx, id)?;
        let after = Words { name, manufacturer, kind, tags, license };
        let changed = words_changed(&product, &after);
        if !changed.is_empty() {
            note(&tx, key, &changed)?;
        }
        tx.commit()?;
        Ok(())
    }

    /// Hides a product from lists and searches. Scenes that name it still work; [`Catalogue::restore_product`] makes it
    /// visible again.
    ///
    /// # Errors
    /// Returns an error if there is no such product or it is hidden already.
    pub fn delete_product(&mut self, key: &str) -> Result<(), CatalogueError> {
        let tx = self.change()?;
        read_product(&tx, key)?;
        if is_deleted(&tx, key)? {
            return Err(CatalogueError::Deleted(key.to_owned()));
        }
        tx.execute("INSERT INTO deleted VALUES (?, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))", [key])?;
        note(&tx, key, "deleted (hidden)")?;
        tx.commit()?;
        Ok(())
    }

    /// Makes a hidden product visible again.
    ///
    /// # Errors
    /// Returns an error if there is no such product or it is not hidden.
    pub fn restore_product(&mut self, key: &str) -> Result<(), CatalogueError> {
        let tx = self.change()?;
        read_product(&tx, key)?;
        if !is_deleted(&tx, key)? {
            return Err(CatalogueError::NotDeleted(key.to_owned()));
        }
        bring_back(&tx, key)?;
        note(&tx, key, "restored")?;
        tx.commit()?;
        Ok(())
    }

    /// Returns the hidden products, the most recently hidden at the top.
    ///
    /// # Errors
    /// Returns an error if the database cannot be read.
    pub fn deleted_products(&self) -> Result<Vec<Deleted>, CatalogueError> {
        let mut statement = self.db.prepare_cached(
            "SELECT p.key, d.at, p.builtin FROM deleted d JOIN product p ON p.key = d.product_key
             ORDER BY d.at DESC, p.name",
        )?;
        let row = |row: &rusqlite::Row<'_>| {
            let Known { key, name } = named(&self.db, row.get(0)?);
            Ok(Deleted { key, name, at: row.get(1)?, builtin: row.get(2)? })
        };
        Ok(statement.query_map([], row)?.collect::<Result<_, _>>()?)
    }

    /// Returns the visible products that were read from files with the hash `source_hash`, see
    /// [`super::Provenance::source_hash`].
    ///
    /// # Errors
    /// Returns an error if the database cannot be read.
    pub fn products_from(&self, source_hash: &str) -> Result<Vec<Known>, CatalogueError> {
        let mut statement = self.db.prepare_cached(
            "SELECT key FROM product
             WHERE source_hash = ? AND source_hash <> '' AND key NOT IN (SELECT product_key FROM deleted) ORDER BY id",
        )?;
        let row = |row: &rusqlite::Row<'_>| Ok(named(&self.db, row.get(0)?));
        Ok(statement.query_map([source_hash], row)?.collect::<Result<_, _>>()?)
    }

    /// Returns the visible products with a state whose data have the content hash `content`, see [`super::content_of`].
    /// Products stored by older programs, which did not store these hashes, are not found.
    ///
    /// # Errors
    /// Returns an error if the database cannot be read.
    pub fn products_holding(&self, content: &str) -> Result<Vec<Known>, CatalogueError> {
        let mut statement = self.db.prepare_cached(
            "SELECT DISTINCT p.key FROM product p JOIN state s ON s.product = p.id
             WHERE s.content = ? AND s.content <> '' AND p.key NOT IN (SELECT product_key FROM deleted) ORDER BY p.id",
        )?;
        let row = |row: &rusqlite::Row<'_>| Ok(named(&self.db, row.get(0)?));
        Ok(statement.query_map([content], row)?.collect::<Result<_, _>>()?)
    }
}
