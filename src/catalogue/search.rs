//! Finding products: full text, facets, and the rows that lists show.

use super::sight::IN_SIGHT;
use super::{Catalogue, CatalogueError, Origin};
use rusqlite::Row;
use rusqlite::types::Value;

/// What is looked for. Everything that is set must hold; the default finds all products.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Query {
    /// Words, each of which must begin a word of name, maker, kind, description or tags. Any input is safe.
    pub text: String,
    /// One of these kinds; empty: any.
    pub kinds: Vec<String>,
    /// One of these makers; empty: any.
    pub manufacturers: Vec<String>,
    /// All of these tags.
    pub tags: Vec<String>,
    /// Favourites alone, or all others.
    pub favourite: Option<bool>,
    /// Measured or computed.
    pub origin: Option<Origin>,
    /// Built-in products alone, or the user's.
    pub builtin: Option<bool>,
}

/// A product as lists show it. Transmittances are those of the first state.
#[derive(Debug, Clone, PartialEq)]
pub struct ProductRow {
    /// Key by which scenes name it.
    pub key: String,
    /// Name.
    pub name: String,
    /// Maker; may be empty.
    pub manufacturer: String,
    /// Kind.
    pub kind: String,
    /// Measured or computed.
    pub origin: Origin,
    /// Visible transmittance of light from outside at normal incidence.
    pub tau_normal: Option<f64>,
    /// The same under uniform luminance.
    pub tau_hemispherical: Option<f64>,
    /// The same at the profile angles [`super::PROFILE_ANGLES`]; empty when unknown.
    pub tau_profile: Vec<f64>,
    /// Keys of the states in order.
    pub state_keys: Vec<String>,
    /// Marked by the user.
    pub favourite: bool,
    /// Comes with the program.
    pub builtin: bool,
}

/// One value of a facet with the number of products that have it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Facet {
    /// The value.
    pub value: String,
    /// How many products.
    pub count: usize,
}

/// Values to filter by, most frequent first.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Facets {
    /// Kinds.
    pub kinds: Vec<Facet>,
    /// Makers, those without left out.
    pub manufacturers: Vec<Facet>,
    /// Tags.
    pub tags: Vec<Facet>,
    /// Measured, computed, unknown.
    pub origins: Vec<Facet>,
    /// Favourites.
    pub favourites: usize,
    /// Built-in products.
    pub builtin: usize,
    /// All products.
    pub all: usize,
}

/// A full-text expression that is safe for any input: every run of letters and digits becomes a quoted prefix, all
/// must occur. `None` without any.
fn match_expression(text: &str) -> Option<String> {
    // Sixteen words tell products apart; more would only cost time.
    let words: Vec<String> = text
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .take(16)
        .map(|word| format!("\"{}\"*", word.chars().take(64).collect::<String>()))
        .collect();
    (!words.is_empty()).then(|| words.join(" "))
}

/// A row of [`Catalogue::search`].
fn product_row(row: &Row<'_>) -> rusqlite::Result<ProductRow> {
    Ok(ProductRow {
        key: row.get(0)?,
        name: row.get(1)?,
        manufacturer: row.get(2)?,
        kind: row.get(3)?,
        origin: Origin::from_word(&row.get::<_, String>(4)?),
        tau_normal: row.get(5)?,
        tau_hemispherical: row.get(6)?,
        tau_profile: list(&row.get::<_, String>(7)?),
        state_keys: list(&row.get::<_, String>(8)?),
        favourite: row.get(9)?,
        builtin: row.get(10)?,
    })
}

impl Catalogue {
    /// Products that fit, best match first when words are given, else built-in products in their own order and then
    /// the user's by name.
    pub fn search(&self, query: &Query) -> Result<Vec<ProductRow>, CatalogueError> {
        // The first state stands for the product in lists. Keys are ordered in a query of their own, since an aggregate
        // takes rows as they come.
        let mut sql = String::from(
            "SELECT p.key, p.name, p.manufacturer, p.kind, p.origin, s.tau_normal, s.tau_hemispherical, s.tau_profile,
                    (SELECT json_group_array(key) FROM (SELECT key FROM state WHERE product = p.id ORDER BY position)),
                    EXISTS (SELECT 1 FROM favourite WHERE product_key = p.key), p.builtin
             FROM product p JOIN state s ON s.product = p.id AND s.position = 0",
        );
        let mut values: Vec<Value> = Vec::new();
        let expression = match_expression(&query.text);
        if let Some(expression) = &expression {
            sql.push_str(" JOIN product_text t ON t.rowid = p.id WHERE product_text MATCH ?");
            // Words of the user are bound here and below, never put into the SQL: any input is safe.
            values.push(expression.clone().into());
        } else {
            // So that every condition can begin with AND.
            sql.push_str(" WHERE 1");
        }
        sql.push_str(IN_SIGHT);
        for (column, list) in [("p.kind", &query.kinds), ("p.manufacturer", &query.manufacturers)] {
            if !list.is_empty() {
                sql.push_str(&format!(" AND {column} IN ({})", vec!["?"; list.len()].join(", ")));
                values.extend(list.iter().cloned().map(Value::from));
            }
        }
        for tag in &query.tags {
            sql.push_str(" AND EXISTS (SELECT 1 FROM tag WHERE product = p.id AND tag = ?)");
            values.push(tag.clone().into());
        }
        if let Some(favourite) = query.favourite {
            sql.push_str(" AND EXISTS (SELECT 1 FROM favourite WHERE product_key = p.key) = ?");
            values.push(favourite.into());
        }
        if let Some(origin) = query.origin {
            sql.push_str(" AND p.origin = ?");
            values.push(origin.word().to_owned().into());
        }
        if let Some(builtin) = query.builtin {
            sql.push_str(" AND p.builtin = ?");
            values.push(builtin.into());
        }
        // A word in the name tells most, one in the description least; bm25 falls as the match gets better.
        let by_match = "bm25(product_text, 10.0, 5.0, 5.0, 1.0, 3.0), ";
        let order = if expression.is_some() { by_match } else { "" };
        // Keys last: products of the same name keep their places from one search to the next.
        sql.push_str(&format!(" ORDER BY {order}p.builtin DESC, p.rank, p.name COLLATE NOCASE, p.key"));
        let mut statement = self.db.prepare_cached(&sql)?;
        let rows = statement.query_map(rusqlite::params_from_iter(values), product_row)?;
        Ok(rows.collect::<Result<_, _>>()?)
    }

    /// Values to filter by, with the number of products of each.
    pub fn facets(&self) -> Result<Facets, CatalogueError> {
        let list = |sql: &str| -> Result<Vec<Facet>, CatalogueError> {
            let mut statement = self.db.prepare_cached(sql)?;
            let rows = statement.query_map([], |row| {
                Ok(Facet { value: row.get(0)?, count: row.get::<_, i64>(1)?.unsigned_abs() as usize })
            })?;
            Ok(rows.collect::<Result<_, _>>()?)
        };
        let count = |sql: &str| -> Result<usize, CatalogueError> {
            Ok(self.db.query_row(sql, [], |row| row.get::<_, i64>(0))?.unsigned_abs() as usize)
        };
        let column = |name: &str| {
            list(&format!(
                "SELECT {name}, count(*) FROM product p WHERE {name} <> ''{IN_SIGHT} GROUP BY {name} ORDER BY count(*) DESC, {name}"
            ))
        };
        Ok(Facets {
            kinds: column("kind")?,
            manufacturers: column("manufacturer")?,
            tags: list(&format!(
                "SELECT tag, count(*) FROM tag t JOIN product p ON p.id = t.product{IN_SIGHT} GROUP BY tag ORDER BY count(*) DESC, tag"
            ))?,
            origins: column("origin")?,
            favourites: count(&format!(
                "SELECT count(*) FROM product p JOIN favourite ON product_key = key{IN_SIGHT}"
            ))?,
            builtin: count(&format!("SELECT count(*) FROM product p WHERE builtin = 1{IN_SIGHT}"))?,
            all: count(&format!("SELECT count(*) FROM product p WHERE 1{IN_SIGHT}"))?,
        })
    }
}

/// A stored list, e.g. of transmittances; empty when it is none.
pub(super) fn list<T: serde::de::DeserializeOwned>(text: &str) -> Vec<T> {
    serde_json::from_str(text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_become_quoted_prefixes() {
        assert_eq!(match_expression("ven* \"80/72\" NOT(").as_deref(), Some("\"ven\"* \"80\"* \"72\"* \"NOT\"*"));
        assert_eq!(match_expression("  *:-\0 "), None);
    }
}
