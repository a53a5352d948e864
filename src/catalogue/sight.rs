//! Hidden products: those that the user deleted and can restore.

use super::CatalogueError;
use rusqlite::Connection;

/// SQL condition that a product `p` is not hidden, for queries that already have a WHERE or the ON of a join.
pub(super) const VISIBLE: &str = " AND NOT EXISTS (SELECT 1 FROM deleted WHERE product_key = p.key)";

/// Whether a product is hidden.
pub(super) fn is_deleted(db: &Connection, key: &str) -> Result<bool, CatalogueError> {
    let sql = "SELECT EXISTS (SELECT 1 FROM deleted WHERE product_key = ?)";
    Ok(db.prepare_cached(sql)?.query_row([key], |row| row.get(0))?)
}

/// Makes a product visible again, if it is hidden.
pub(super) fn bring_back(db: &Connection, key: &str) -> Result<(), CatalogueError> {
    db.execute("DELETE FROM deleted WHERE product_key = ?", [key])?;
    Ok(())
}
