//! Search for products, with an index in memory that is renewed when the catalogue file has changed.

use super::builtin::restore_damaged;
use super::index::{Found, Index};
use super::query_facets::Facets;
use super::{Catalogue, CatalogueError, ProductRow, Query, rows};
use std::sync::Arc;

impl Catalogue {
    /// Returns the products that match a query, in the requested order, with the values by which the search can be
    /// narrowed. Default order: best match at the top; without search words built-in products in their own order, then
    /// the user's by name.
    pub fn find(&self, query: &Query) -> Result<Found, CatalogueError> {
        Ok(self.index()?.find(query))
    }

    /// Returns only the list of products that match a query.
    pub fn search(&self, query: &Query) -> Result<Vec<ProductRow>, CatalogueError> {
        Ok(self.find(query)?.entries.into_iter().map(Arc::unwrap_or_clone).collect())
    }

    /// Returns the values by which products can be filtered, with the number of products of each in the whole
    /// catalogue.
    pub fn facets(&self) -> Result<Facets, CatalogueError> {
        Ok(self.find(&Query::default())?.facets)
    }

    /// Returns the search index of the catalogue file in its present revision.
    fn index(&self) -> Result<Arc<Index>, CatalogueError> {
        // One snapshot: what is read belongs together, and to the stamp.
        let snapshot = self.db.unchecked_transaction()?;
        // The first read is what fixes the snapshot.
        snapshot.query_row("SELECT count(*) FROM meta", [], |_| Ok(()))?;
        let version: i64 = snapshot.pragma_query_value(None, "data_version", |row| row.get(0))?;
        let stamp = (version, snapshot.total_changes());
        if let Some((known, index)) = &*self.index.borrow()
            && *known == stamp
        {
            return Ok(Arc::clone(index));
        }
        let (products, damaged) = rows::read(&snapshot)?;
        snapshot.finish()?;
        // Where nothing can be written they stay damaged, and are left out.
        if !damaged.is_empty() && restore_damaged(self).unwrap_or(false) {
            return self.index();
        }
        let mut index = Index::new(products);
        (index.damaged, index.restored) = (damaged, self.restored.borrow().clone());
        let index = Arc::new(index);
        self.index.replace(Some((stamp, Arc::clone(&index))));
        Ok(index)
    }
}
