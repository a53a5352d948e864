//! Collections: sets of products that the user makes and names. A product may be in any number of them; a collection
//! exists as long as it contains a product.

use super::{Catalogue, CatalogueError};
use rusqlite::Connection;

/// Collection of products, made and named by the user.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Collection {
    /// Name of the collection.
    pub name: String,
    /// Keys of its products, sorted.
    pub products: Vec<String>,
}

/// Removes a product from all collections. It is called when the product is removed permanently, because another one
/// may get its key.
pub(super) fn leave_all(db: &Connection, key: &str) -> Result<(), CatalogueError> {
    db.execute("DELETE FROM collection WHERE product_key = ?", [key])?;
    Ok(())
}

impl Catalogue {
    /// Adds products to a collection (`put`), or removes them from it, all in one transaction. Products that are
    /// already in it, or not in it, are unchanged.
    ///
    /// # Errors
    /// Returns an error if a product does not exist, or the collection has no name; nothing changes then.
    pub fn collect(&mut self, name: &str, products: &[String], put: bool) -> Result<(), CatalogueError> {
        let name = name.trim();
        if name.is_empty() {
            return Err(CatalogueError::NoCollectionName);
        }
        let tx = self.change()?;
        for key in products {
            if !put {
                tx.execute("DELETE FROM collection WHERE name = ? AND product_key = ?", [name, key])?;
                continue;
            }
            let there = "SELECT EXISTS (SELECT 1 FROM product WHERE key = ?)";
            if !tx.query_row(there, [key], |row| row.get::<_, bool>(0))? {
                return Err(CatalogueError::NoProduct(key.clone()));
            }
            tx.execute("INSERT OR IGNORE INTO collection VALUES (?, ?)", [name, key])?;
        }
        tx.commit()?;
        Ok(())
    }

    /// Returns all collections by name, each with those of its products that are not hidden.
    ///
    /// # Errors
    /// Returns an error if the database cannot be read.
    pub fn collections(&self) -> Result<Vec<Collection>, CatalogueError> {
        let mut ask = self.db.prepare_cached(
            "SELECT name, product_key FROM collection
             WHERE product_key IN (SELECT key FROM product) AND product_key NOT IN (SELECT product_key FROM deleted)
             ORDER BY name COLLATE NOCASE, name, product_key",
        )?;
        let mut rows = ask.query([])?;
        let mut list: Vec<Collection> = Vec::new();
        while let Some(row) = rows.next()? {
            let (name, key): (String, String) = (row.get(0)?, row.get(1)?);
            match list.last_mut().filter(|last| last.name == name) {
                Some(last) => last.products.push(key),
                None => list.push(Collection { name, products: vec![key] }),
            }
        }
        Ok(list)
    }
}
