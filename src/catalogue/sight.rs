//! Which products are out of sight.

use super::CatalogueError;
use rusqlite::Connection;

/// Condition that a product `p` is in sight, for queries that have a WHERE or a join's ON.
pub(super) const IN_SIGHT: &str = " AND NOT EXISTS (SELECT 1 FROM deleted WHERE product_key = p.key)";

/// Is a product out of sight?
pub(super) fn is_deleted(db: &Connection, key: &str) -> Result<bool, CatalogueError> {
    let sql = "SELECT EXISTS (SELECT 1 FROM deleted WHERE product_key = ?)";
    Ok(db.prepare_cached(sql)?.query_row([key], |row| row.get(0))?)
}

/// Brings a product back into sight, if it was out of it.
pub(super) fn bring_back(db: &Connection, key: &str) -> Result<(), CatalogueError> {
    db.execute("DELETE FROM deleted WHERE product_key = ?", [key])?;
    Ok(())
}
