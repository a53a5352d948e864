//! Check and repair of a catalogue file: whether its content is what was stored, and what can be restored.

use super::builtin::{differs, is_row_of_builtin, is_version_lost, restore_damaged};
use super::history::RESTORED;
use super::messages::sqlite_message;
use super::open::{APPLICATION, READING, layout_of};
use super::salvage::salvage;
use super::store::{put_blob, read_product};
use super::verified::{blob_of, seal_rows, sealed};
use super::{Catalogue, CatalogueError};
use crate::formats::dataset_blob::{content_hash, decode};
use rusqlite::backup::Backup;
use rusqlite::{Connection, ErrorCode, OpenFlags, Transaction};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Maximum number of messages about broken pages that are listed.
const MAX_REPORTED: usize = 20;
/// Number of database pages that SQLite's backup copies in one step.
const PAGES: i32 = 1000;

/// Location of a damage in a catalogue file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// Numbers that identify the file as a catalogue and state the layout of its tables.
    Layout,
    /// Pages of the database.
    Pages,
    /// Rows of a product, without its datasets.
    Product {
        /// Key of the product.
        key: String,
        /// Whether the product comes with the program.
        builtin: bool,
    },
    /// Dataset of a state.
    Data {
        /// Key of the product.
        product: String,
        /// Key of the state.
        state: String,
        /// Hash of the dataset as it was stored.
        hash: String,
        /// Whether the product comes with the program.
        builtin: bool,
    },
}

/// Damage: content of the file that differs from what was stored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Damage {
    /// Location of the damage in the file: layout, pages, a product or a dataset.
    pub place: Place,
    /// Description of the damage, as a sentence.
    pub message: String,
}

/// Result of the check of a catalogue file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Health {
    /// Number of products that were checked.
    pub products: usize,
    /// Number of states with data that were checked.
    pub datasets: usize,
    /// All damages that were found.
    pub damages: Vec<Damage>,
    /// Keys of built-in products that were damaged and have been restored, each with the time of it as UTC text.
    pub restored: Vec<(String, String)>,
}

impl Health {
    fn report(&mut self, place: Place, message: impl Into<String>) {
        self.damages.push(Damage { place, message: message.into() });
    }
}

/// Checks a catalogue file without changing it: its layout numbers, its pages, every product by its hash ("seal"),
/// every dataset by its hash.
///
/// # Errors
/// Returns an error if the file does not exist, is not a database, or is one of another program or of a newer version.
pub fn check_file(path: &Path) -> Result<Health, CatalogueError> {
    let located = |cause| CatalogueError::Open { path: path.to_owned(), cause };
    let db = Connection::open_with_flags(path, READING).map_err(located)?;
    let health = check(&db, path);
    health.map_err(|error| match error {
        CatalogueError::Sql(cause) => located(cause),
        other => other,
    })
}

/// Checks an open database. `path`: name of the file for messages.
fn check(db: &Connection, path: &Path) -> Result<Health, CatalogueError> {
    let mut health = Health::default();
    let found: i64 = db.pragma_query_value(None, "user_version", |row| row.get(0))?;
    let application: i64 = db.pragma_query_value(None, "application_id", |row| row.get(0))?;
    let shown = || path.display().to_string();
    // Pages first: where they are broken, the layout may be unreadable.
    let pages = broken_pages(db)?;
    match layout_of(db) {
        Ok(Some(layout)) if layout != found || application != APPLICATION => {
            let message =
                format!("the layout is named {found} and is {layout}, or the file is not marked as a catalogue");
            health.report(Place::Layout, message);
        }
        Ok(Some(_)) => {}
        // Another version's, or nobody's.
        Ok(None) if application == APPLICATION && found > 0 => {
            let known = super::open::known_layout();
            if found > known {
                return Err(CatalogueError::Newer { path: shown(), found, known });
            }
            if pages.is_empty() {
                health.report(Place::Pages, "the tables are not those of a catalogue");
            }
        }
        Ok(None) if pages.is_empty() => return Err(CatalogueError::NotACatalogue(shown())),
        Ok(None) | Err(_) => {}
    }
    let broken = !pages.is_empty();
    for page in pages {
        health.report(Place::Pages, page);
    }
    let looked_at = products(db, &mut health).and_then(|()| {
        if is_version_lost(db)? {
            health.report(Place::Layout, "the version of the built-in products is not what was stored");
        }
        health.restored = restored(db)?;
        Ok(())
    });
    match looked_at {
        // The damage is listed already.
        Err(CatalogueError::Sql(_)) if broken || !health.damages.is_empty() => {}
        other => other?,
    }
    Ok(health)
}

/// Returns SQLite's messages about broken pages and references, at most [`MAX_REPORTED`].
fn broken_pages(db: &Connection) -> Result<Vec<String>, CatalogueError> {
    let mut messages = Vec::new();
    for pragma in [format!("PRAGMA integrity_check({MAX_REPORTED})"), "PRAGMA foreign_key_check".to_owned()] {
        let keys = pragma.contains("foreign");
        let mut ask = match db.prepare(&pragma) {
            Ok(ask) => ask,
            // Not even the list of tables can be read.
            Err(error) if error.sqlite_error_code() == Some(ErrorCode::DatabaseCorrupt) => {
                messages.push(sqlite_message(&error));
                break;
            }
            Err(error) => return Err(error.into()),
        };
        let mut rows = ask.query([])?;
        loop {
            match rows.next() {
                Ok(None) => break,
                Ok(Some(row)) => {
                    let text: String = row.get(0)?;
                    if keys {
                        messages.push(format!("table {text} names something that is not there"));
                    } else if text != "ok" {
                        messages.push(text.replace('\n', "; "));
                    }
                }
                // So broken that it cannot even be looked through.
                Err(error) => {
                    messages.push(sqlite_message(&error));
                    break;
                }
            }
        }
    }
    if messages.is_empty() {
        messages.extend(read_through(db).err().map(|error| sqlite_message(&error)));
    }
    messages.dedup();
    messages.truncate(MAX_REPORTED);
    Ok(messages)
}

/// Reads all rows of all tables and indices, because a page of another kind without any rows passes SQLite's own
/// checks.
fn read_through(db: &Connection) -> rusqlite::Result<()> {
    let mut ask = db.prepare(
        r#"SELECT format('SELECT * FROM "%w" NOT INDEXED', name) FROM sqlite_schema WHERE type = 'table'
           UNION ALL
           SELECT format('SELECT "%w" FROM "%w" INDEXED BY "%w"', column.name, tbl_name, list.name)
           FROM sqlite_schema list JOIN pragma_index_info(list.name) column ON seqno = 0 WHERE type = 'index'"#,
    )?;
    let queries: Vec<String> = ask.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?;
    for query in queries {
        let mut ask = db.prepare(&query)?;
        let mut rows = ask.query([])?;
        while rows.next()?.is_some() {}
    }
    Ok(())
}

/// Returns the built-in products that were restored when the file was opened, each with the time.
fn restored(db: &Connection) -> Result<Vec<(String, String)>, CatalogueError> {
    if !db.table_exists(None, "history")? {
        return Ok(Vec::new());
    }
    let mut ask = db.prepare("SELECT product_key, at FROM history WHERE what = ? ORDER BY id")?;
    Ok(ask.query_map([RESTORED], |row| Ok((row.get(0)?, row.get(1)?)))?.collect::<Result<_, _>>()?)
}

/// Checks every product with its data, and adds the damages to `health`.
fn products(db: &Connection, health: &mut Health) -> Result<(), CatalogueError> {
    let mut ask = db.prepare("SELECT id, CAST(key AS BLOB) FROM product ORDER BY rank, key")?;
    let keys: Vec<(i64, Vec<u8>)> =
        ask.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?.collect::<Result<_, _>>()?;
    for (id, key) in keys {
        health.products += 1;
        let builtin = is_row_of_builtin(db, id).unwrap_or(false);
        let key = String::from_utf8_lossy(&key).into_owned();
        let place = || Place::Product { key: key.clone(), builtin };
        let product = match read_product(db, &key).and_then(|product| sealed(db, product)) {
            Ok(product) => product,
            Err(CatalogueError::Damaged(how)) => {
                health.report(place(), how);
                continue;
            }
            Err(CatalogueError::Sql(error)) => {
                health.report(place(), format!("product \"{key}\" cannot be read: {}", sqlite_message(&error)));
                continue;
            }
            // A key that is not a text, or that its index does not have.
            Err(CatalogueError::NoProduct(key)) => {
                health.report(place(), format!("product \"{key}\" is not found by its key"));
                continue;
            }
            Err(other) => return Err(other),
        };
        if builtin && differs(&product) {
            health.report(place(), format!("product \"{key}\" is not what the program brings"));
        }
        for state in &product.states {
            let Some(hash) = &state.dataset else { continue };
            health.datasets += 1;
            let wrong = match blob_of(db, hash) {
                Ok(blob) => decode(&blob).err().map(|error| error.to_string()),
                Err(CatalogueError::Damaged(how)) => Some(how),
                Err(CatalogueError::Sql(error)) => Some(sqlite_message(&error)),
                Err(other) => return Err(other),
            };
            if let Some(how) = wrong {
                let named = if state.key.is_empty() { String::new() } else { format!(", state \"{}\"", state.key) };
                let (product, state, hash) = (key.clone(), state.key.clone(), hash.clone());
                let message = format!("data of \"{key}\"{named}: {how}");
                health.report(Place::Data { product, state, hash, builtin }, message);
            }
        }
    }
    Ok(())
}

/// Copies a catalogue file, together with the changes in its write-ahead log, to a free file name beside it. Returns
/// that name.
///
/// # Errors
/// Returns an error if the system cannot copy the files.
pub fn copy_aside(path: &Path) -> std::io::Result<PathBuf> {
    let with = |path: &Path, ending: &str| {
        let mut name = path.as_os_str().to_owned();
        name.push(ending);
        PathBuf::from(name)
    };
    let mut copy = with(path, ".damaged");
    for number in 2.. {
        if !copy.exists() {
            break;
        }
        copy = with(path, &format!(".damaged-{number}"));
    }
    std::fs::copy(path, &copy)?;
    if with(path, "-wal").exists() {
        std::fs::copy(with(path, "-wal"), with(&copy, "-wal"))?;
    }
    Ok(copy)
}

/// Repairs a catalogue file as far as the file itself and the program allow: layout numbers, indices, broken pages as
/// far as their rows can be read, built-in products and their data, which are computed at their next use. Returns
/// sentences about what was lost.
///
/// # Errors
/// Returns an error under the conditions of [`check_file`], or if something cannot be written.
pub fn repair_file(path: &Path, health: &Health) -> Result<Vec<String>, CatalogueError> {
    let located = |cause| CatalogueError::Open { path: path.to_owned(), cause };
    let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let mut db = Connection::open_with_flags(path, flags).map_err(located)?;
    db.busy_timeout(Duration::from_secs(10))?;
    let mut lost = Vec::new();
    let holds = |health: &Health, place: &Place| health.damages.iter().any(|damage| damage.place == *place);
    if holds(health, &Place::Pages) {
        // An index is made of its table, on pages that may be of another kind: those are known when all pages have been
        // rewritten.
        let is_repaired = db.execute_batch("REINDEX; VACUUM").is_ok()
            && broken_pages(&db).is_ok_and(|pages| pages.is_empty())
            && layout_of(&db)?.is_some();
        if !is_repaired {
            let saved = salvage(&db)?;
            lost = saved.lost;
            Backup::new(&saved.db, &mut db)?.run_to_completion(PAGES, Duration::ZERO, None)?;
        }
    } else if holds(health, &Place::Layout)
        && let Some(layout) = layout_of(&db)?
    {
        db.pragma_update(None, "user_version", layout)?;
        db.pragma_update(None, "application_id", APPLICATION)?;
    }
    // Pages that are whole again may hold less than the damages listed before suggest.
    let rest = check(&db, path)?;
    db.pragma_update(None, "foreign_keys", true)?;
    let tx = db.transaction()?;
    for damage in &rest.damages {
        match &damage.place {
            Place::Product { key, builtin: true } => reset_builtin(&tx, key)?,
            // Without a description its data are not computed: they come with the product.
            Place::Data { product, builtin: true, .. } if !is_described(&tx, product)? => reset_builtin(&tx, product)?,
            Place::Data { hash, builtin: true, .. } => {
                // Found in the data, and found in them again.
                tx.execute(
                    "DELETE FROM finding WHERE EXISTS (SELECT 1 FROM state s JOIN product p ON p.id = s.product
                       WHERE s.dataset = ?1 AND p.builtin = 1
                         AND s.product = finding.product AND s.position = finding.state)",
                    [hash],
                )?;
                let products: Vec<i64> = tx
                    .prepare(
                        "SELECT DISTINCT s.product FROM state s JOIN product p ON p.id = s.product
                              WHERE s.dataset = ?1 AND p.builtin = 1",
                    )?
                    .query_map([hash], |row| row.get(0))?
                    .collect::<Result<_, _>>()?;
                tx.execute(
                    "UPDATE state SET dataset = NULL WHERE dataset = ?1
                       AND product IN (SELECT id FROM product WHERE builtin = 1)",
                    [hash],
                )?;
                products.into_iter().try_for_each(|id| seal_rows(&tx, id))?;
                // The user's own products may hold the same data.
                tx.execute(
                    "DELETE FROM dataset WHERE hash = ?1 AND NOT EXISTS (SELECT 1 FROM state WHERE dataset = ?1)",
                    [hash],
                )?;
            }
            _ => {}
        }
    }
    tx.commit()?;
    drop(db);
    // Brings what is missing of the built-in products.
    restore_damaged(&Catalogue::open(path)?)?;
    Ok(lost)
}

fn is_described(db: &Connection, key: &str) -> Result<bool, CatalogueError> {
    Ok(db.query_row("SELECT system <> '' FROM product WHERE key = ?", [key], |row| row.get(0))?)
}

/// Removes a built-in product, so that it is added again when the file is opened.
fn reset_builtin(tx: &Transaction<'_>, key: &str) -> Result<(), CatalogueError> {
    tx.execute("DELETE FROM product WHERE key = ? AND builtin = 1", [key])?;
    Ok(())
}

impl Catalogue {
    /// Writes back the bytes of a dataset that a state refers to and that are damaged or missing. `hash`: hash of the
    /// dataset; `blob`: its bytes. Returns `false` if the bytes do not have this hash, or no state refers to it.
    ///
    /// # Errors
    /// Returns an error if the database cannot be read or written.
    pub fn put_bytes(&mut self, hash: &str, blob: &[u8]) -> Result<bool, CatalogueError> {
        if content_hash(blob) != hash {
            return Ok(false);
        }
        let tx = self.change()?;
        let named: bool =
            tx.query_row("SELECT EXISTS (SELECT 1 FROM state WHERE dataset = ?)", [hash], |row| row.get(0))?;
        if named {
            put_blob(&tx, hash, blob)?;
            tx.commit()?;
        }
        Ok(named)
    }

    /// Returns the hash under which a dataset is stored in the catalogue, and its bytes.
    pub fn bytes_of(dataset: &crate::compute::btdf::Dataset) -> (String, Vec<u8>) {
        let blob = crate::formats::dataset_blob::encode(dataset);
        (content_hash(&blob), blob)
    }
}
