//! Reading and writing of products in the tables of the database. Every change is one transaction.

use super::described::described_state;
use super::history::set_paths;
use super::record::Record;
use super::rows::list_of;
use super::verified::{blob_of, seal_of, seal_rows, sealed};
use super::{Catalogue, CatalogueError, CurvePoint, Origin, Product, ProductFinding, Provenance, State, check};
use crate::compute::btdf::{Dataset, DescribedState, LightFigures, Severity};
use crate::formats::dataset_blob::decode;
use rusqlite::{Connection, OptionalExtension, Row, Transaction, params};
use std::sync::Arc;

/// Maximum number of decoded datasets that a connection holds in memory though nobody else uses them. Chosen: cost only,
/// no effect on results; data of 145 × 145 cells take up to 1.4 MB, tensor trees more.
const MAX_RECENT: usize = 8;
/// Position in the order of the catalogue of products that users add, after the built-in ones.
pub(super) const USER_RANK: i64 = 1_000_000;

/// Returns the key `wanted` if no product has it, else the first free one of wanted-2, wanted-3, ….
pub(super) fn free_key(db: &Connection, wanted: &str) -> Result<String, CatalogueError> {
    let mut statement = db.prepare_cached("SELECT EXISTS (SELECT 1 FROM product WHERE key = ?)")?;
    let wanted: String = if wanted.is_empty() { "product".into() } else { wanted.chars().take(150).collect() };
    let mut key = wanted.clone();
    for number in 2_u64.. {
        if !statement.query_row([&key], |row| row.get::<_, bool>(0))? {
            break;
        }
        key = format!("{wanted}-{number}");
    }
    Ok(key)
}

/// Writes the bytes of a dataset under their hash, unless they are stored already; replaces bytes that are damaged.
pub(super) fn put_blob(tx: &Transaction, hash: &str, blob: &[u8]) -> Result<(), CatalogueError> {
    tx.prepare_cached(
        "INSERT INTO dataset (hash, blob) VALUES (?1, ?2)
         ON CONFLICT (hash) DO UPDATE SET blob = excluded.blob WHERE blob IS NOT excluded.blob",
    )?
    .execute(params![hash, blob])?;
    Ok(())
}

/// Writes a new product under its key. `rank`: position in the order of the catalogue.
pub(super) fn insert(tx: &Transaction, record: &Record, rank: i64) -> Result<(), CatalogueError> {
    let (p, from) = (&record.product, &record.product.provenance);
    tx.prepare_cached(
        "INSERT INTO product (key, name, manufacturer, kind, description, origin, author, method, date, source_file,
                              source_hash, inside_face, builtin, rank, system, license, seal)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17)",
    )?
    .execute(params![
        p.key,
        p.name,
        p.manufacturer,
        p.kind,
        p.description,
        from.origin.word(),
        from.author,
        from.method,
        from.date,
        from.source_file,
        from.source_hash,
        from.inside_face,
        p.builtin,
        rank,
        p.system,
        p.license,
        seal_of(p)
    ])?;
    let id = tx.last_insert_rowid();
    for (hash, blob) in &record.datasets {
        put_blob(tx, hash, blob)?;
    }
    for (position, s) in record.product.states.iter().enumerate() {
        let curve = serde_json::json!(s.tau_profile).to_string();
        tx.prepare_cached(
            "INSERT INTO state (product, position, key, label, value, dataset, tau_normal, tau_hemispherical, tau_profile,
                                to_ceiling, sun_blocked, view, content)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13)",
        )?
        .execute(params![
            id,
            position as i64,
            s.key,
            s.label,
            s.value,
            s.dataset,
            s.tau_normal,
            s.tau_hemispherical,
            curve,
            s.light.and_then(|light| light.to_ceiling),
            s.light.map(|light| light.sun_blocked),
            s.light.map(|light| light.view),
            record.contents.get(position).map_or("", String::as_str)
        ])?;
        insert_findings(tx, [id, position as i64], p.findings.iter().filter(|finding| finding.state == s.key))?;
    }
    for (position, point) in p.control_curve.iter().enumerate() {
        tx.prepare_cached("INSERT INTO control_point VALUES (?, ?, ?, ?)")?.execute(params![
            id,
            position as i64,
            point.profile_angle,
            point.value
        ])?;
    }
    for tag in &p.tags {
        tx.prepare_cached("INSERT INTO tag VALUES (?, ?)")?.execute(params![id, tag])?;
    }
    if p.favourite {
        tx.execute("INSERT OR IGNORE INTO favourite VALUES (?)", [&p.key])?;
    }
    seal_rows(tx, id)
}

/// Writes the findings of a state, which is identified by the id of its product and its position among the states.
pub(super) fn insert_findings<'a>(
    tx: &Transaction,
    [product, position]: [i64; 2],
    findings: impl Iterator<Item = &'a ProductFinding>,
) -> Result<(), CatalogueError> {
    let mut insert = tx.prepare_cached("INSERT INTO finding VALUES (?, ?, ?, ?, ?, ?)")?;
    for (number, f) in findings.enumerate() {
        insert.execute(params![product, position, number as i64, f.severity.word(), f.code, f.message])?;
    }
    Ok(())
}

/// Removes the datasets to which no state refers any more.
pub(super) fn sweep(tx: &Transaction) -> Result<(), CatalogueError> {
    tx.execute("DELETE FROM dataset WHERE NOT EXISTS (SELECT 1 FROM state WHERE state.dataset = dataset.hash)", [])?;
    Ok(())
}

/// Removes the rows of a product, and the datasets to which no state refers any more.
pub(super) fn delete(tx: &Transaction, key: &str) -> Result<(), CatalogueError> {
    tx.execute("DELETE FROM product WHERE key = ?", [key])?;
    sweep(tx)
}

/// Writes a product in place of the stored one with the same key.
pub(super) fn replace(tx: &Transaction, record: &Record) -> Result<(), CatalogueError> {
    let key = &record.product.key;
    let rank: i64 = tx.query_row("SELECT rank FROM product WHERE key = ?", [key], |row| row.get(0))?;
    // Without the sweep: data that stay would go and have to come again.
    tx.execute("DELETE FROM product WHERE key = ?", [key])?;
    insert(tx, record, rank)?;
    set_paths(tx, key, &record.paths)?;
    sweep(tx)
}

fn severity(word: &str) -> Severity {
    match word {
        "info" => Severity::Info,
        "warning" => Severity::Warning,
        _ => Severity::Error,
    }
}

/// Returns a product without its lists (states, tags, findings), from a row of [`read_product`].
fn product_of_row(key: &str, row: &Row<'_>) -> rusqlite::Result<Product> {
    let provenance = Provenance {
        origin: Origin::from_word(&row.get::<_, String>(5)?),
        author: row.get(6)?,
        method: row.get(7)?,
        date: row.get(8)?,
        source_file: row.get(9)?,
        source_hash: row.get(10)?,
        inside_face: row.get(11)?,
    };
    Ok(Product {
        key: key.to_owned(),
        name: row.get(1)?,
        manufacturer: row.get(2)?,
        kind: row.get(3)?,
        description: row.get(4)?,
        provenance,
        tags: Vec::new(),
        states: Vec::new(),
        control_curve: Vec::new(),
        findings: Vec::new(),
        builtin: row.get(12)?,
        favourite: row.get(13)?,
        system: row.get(14)?,
        license: row.get(15)?,
    })
}

/// Returns a state from a row of [`read_product`].
fn state_of_row(row: &Row<'_>) -> rusqlite::Result<State> {
    Ok(State {
        key: row.get(0)?,
        label: row.get(1)?,
        value: row.get(2)?,
        dataset: row.get(3)?,
        tau_normal: row.get(4)?,
        tau_hemispherical: row.get(5)?,
        tau_profile: list_of(&row.get::<_, String>(6)?),
        light: match row.get(8)? {
            Some(sun_blocked) => Some(LightFigures {
                to_ceiling: row.get(7)?,
                sun_blocked,
                view: row.get::<_, Option<f64>>(9)?.unwrap_or_default(),
            }),
            None => None,
        },
    })
}

/// Reads the product with a key from the tables.
pub(super) fn read_product(db: &Connection, key: &str) -> Result<Product, CatalogueError> {
    // A favourite is asked for by key: built-in products get new rows when they are renewed, and stay favourites.
    let found = db
        .prepare_cached(
            "SELECT id, name, manufacturer, kind, description, origin, author, method, date, source_file, source_hash,
                    inside_face, builtin, EXISTS (SELECT 1 FROM favourite WHERE product_key = key), system, license
             FROM product WHERE key = ?",
        )?
        .query_row([key], |row| Ok((row.get::<_, i64>(0)?, product_of_row(key, row)?)))
        .optional()?;
    let (id, mut product) = found.ok_or_else(|| CatalogueError::NoProduct(key.to_owned()))?;
    // A query for each list: joined into one, every list would repeat the rows of the others.
    product.states = db
        .prepare_cached(
            "SELECT key, label, value, dataset, tau_normal, tau_hemispherical, tau_profile, to_ceiling, sun_blocked, view
             FROM state WHERE product = ? ORDER BY position",
        )?
        .query_map([id], state_of_row)?
        .collect::<Result<_, _>>()?;
    product.tags = db
        .prepare_cached("SELECT tag FROM tag WHERE product = ? ORDER BY tag")?
        .query_map([id], |row| row.get(0))?
        .collect::<Result<_, _>>()?;
    product.control_curve = db
        .prepare_cached("SELECT profile_angle, value FROM control_point WHERE product = ? ORDER BY position")?
        .query_map([id], |row| Ok(CurvePoint { profile_angle: row.get(0)?, value: row.get(1)? }))?
        .collect::<Result<_, _>>()?;
    // A finding is stored under its state's position, and returned under its key.
    product.findings = db
        .prepare_cached(
            "SELECT s.key, f.severity, f.code, f.message
             FROM finding f JOIN state s ON s.product = f.product AND s.position = f.state
             WHERE f.product = ? ORDER BY f.state, f.position",
        )?
        .query_map([id], |row| {
            Ok(ProductFinding {
                state: row.get(0)?,
                severity: severity(&row.get::<_, String>(1)?),
                code: row.get(2)?,
                message: row.get(3)?,
            })
        })?
        .collect::<Result<_, _>>()?;
    Ok(product)
}

fn not_computed(product: &str, state: &str) -> CatalogueError {
    CatalogueError::NotComputed { product: product.to_owned(), state: state.to_owned() }
}

/// Reads a product with all its datasets. Returns an error if one of them is missing.
pub(super) fn read_record(db: &Connection, key: &str) -> Result<Record, CatalogueError> {
    let product = sealed(db, read_product(db, key)?)?;
    let mut datasets: Vec<(String, Vec<u8>)> = Vec::new();
    for state in &product.states {
        let Some(wanted) = &state.dataset else { return Err(not_computed(key, &state.key)) };
        if datasets.iter().all(|(hash, _)| hash != wanted) {
            datasets.push((wanted.clone(), blob_of(db, wanted)?));
        }
    }
    let mut ask = db.prepare_cached(
        "SELECT s.content FROM state s JOIN product p ON p.id = s.product WHERE p.key = ? ORDER BY s.position",
    )?;
    let contents = ask.query_map([key], |row| row.get(0))?.collect::<Result<_, _>>()?;
    Ok(Record { product, datasets, contents, paths: Vec::new() })
}

impl Catalogue {
    /// Returns the product with a key. Returns an error if its data are not those that were stored.
    pub fn product(&self, key: &str) -> Result<Product, CatalogueError> {
        // One snapshot for all the reads.
        let snapshot = self.db.unchecked_transaction()?;
        let product = read_product(&snapshot, key)?;
        sealed(&snapshot, product)
    }

    /// Returns the dataset of a state. `state`: key of the state; `None` for a product with one state only.
    ///
    /// # Errors
    /// Returns an error if there is no such product or state; [`CatalogueError::NotComputed`] for a state that
    /// [`Self::to_compute`] returns.
    pub fn dataset(&self, key: &str, state: Option<&str>) -> Result<Arc<Dataset>, CatalogueError> {
        let product = self.product(key)?;
        let wrong = |what: String| CatalogueError::NoState {
            product: key.to_owned(),
            what,
            states: product.states.iter().map(|s| format!("\"{}\"", s.key)).collect::<Vec<_>>().join(", "),
        };
        let found = match (state, product.states.as_slice()) {
            (None, [only]) => only,
            (None, _) => return Err(wrong("several states and none named".to_owned())),
            (Some(state), states) => {
                states.iter().find(|s| s.key == state).ok_or_else(|| wrong(format!("no state \"{state}\"")))?
            }
        };
        let Some(hash) = &found.dataset else {
            return self.held(key, &found.key).ok_or_else(|| not_computed(key, &found.key));
        };
        self.dataset_of_hash(hash, described_state(&product.system, &found.key))
    }

    /// Returns the dataset with a hash, with the description of its product: from memory if it is in use, or was used
    /// recently. Products with the same dataset may have different descriptions.
    fn dataset_of_hash(&self, hash: &str, described: Option<DescribedState>) -> Result<Arc<Dataset>, CatalogueError> {
        let mut decoded = self.decoded.borrow_mut();
        let mut of_hash = decoded.iter().filter(|(known, _)| known == hash).filter_map(|(_, one)| one.upgrade());
        let dataset = match of_hash.find(|dataset| dataset.described == described) {
            Some(dataset) => dataset,
            None => {
                let blob = blob_of(&self.db, hash)?;
                let cause = |cause| CatalogueError::Dataset { hash: hash.to_owned(), cause };
                let dataset = Arc::new(Dataset { described, ..decode(&blob).map_err(cause)? });
                decoded.retain(|(_, one)| one.strong_count() > 0);
                decoded.push((hash.to_owned(), Arc::downgrade(&dataset)));
                dataset
            }
        };
        let mut recent = self.recent.borrow_mut();
        recent.retain(|one| !Arc::ptr_eq(one, &dataset));
        recent.push_back(Arc::clone(&dataset));
        if recent.len() > MAX_RECENT {
            recent.pop_front();
        }
        Ok(dataset)
    }

    /// Removes a product of the user permanently; [`Catalogue::delete_product`] only hides a product.
    pub fn remove_product(&mut self, key: &str) -> Result<(), CatalogueError> {
        self.remove_products(&[key.to_owned()])
    }

    /// Marks a product as a favourite, or removes the mark.
    pub fn set_favourite(&mut self, key: &str, favourite: bool) -> Result<(), CatalogueError> {
        let tx = self.change()?;
        if !tx.query_row("SELECT EXISTS (SELECT 1 FROM product WHERE key = ?)", [key], |row| row.get::<_, bool>(0))? {
            return Err(CatalogueError::NoProduct(key.to_owned()));
        }
        if favourite {
            tx.execute("INSERT OR IGNORE INTO favourite VALUES (?)", [key])?;
        } else {
            tx.execute("DELETE FROM favourite WHERE product_key = ?", [key])?;
        }
        tx.commit()?;
        Ok(())
    }

    /// Checks every stored dataset of a product again: its bytes by their hash, its energy balance and reciprocity.
    /// Data that are not computed yet give a finding that says so.
    pub fn validate(&self, key: &str) -> Result<Vec<ProductFinding>, CatalogueError> {
        let snapshot = self.db.unchecked_transaction()?;
        let (mut findings, mut waiting) = (Vec::new(), 0);
        let states = read_product(&snapshot, key)?.states;
        for state in &states {
            let mut report = |severity, code: &str, message: String| {
                findings.push(ProductFinding { state: state.key.clone(), severity, code: code.to_owned(), message });
            };
            let Some(hash) = &state.dataset else {
                waiting += 1;
                continue;
            };
            let blob = match blob_of(&snapshot, hash) {
                Ok(blob) => blob,
                Err(CatalogueError::Damaged(how)) => {
                    report(Severity::Error, "hash-differs", how);
                    continue;
                }
                Err(other) => return Err(other),
            };
            match decode(&blob) {
                Err(error) => report(Severity::Error, "unreadable", error.to_string()),
                Ok(dataset) => {
                    let own = check(&dataset).into_iter().filter(|finding| !dataset.findings.contains(finding));
                    for finding in dataset.findings.iter().cloned().chain(own) {
                        report(finding.severity, finding.code, finding.message);
                    }
                }
            }
        }
        if waiting > 0 {
            let message =
                format!("{waiting} of {} states: data are computed when they are first asked for.", states.len());
            let (state, code) = (String::new(), "not-computed".to_owned());
            findings.push(ProductFinding { state, severity: Severity::Info, code, message });
        }
        Ok(findings)
    }
}
