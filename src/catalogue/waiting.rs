//! States of built-in products whose data are not computed yet: their list, and storing their data and figures.

use super::described::described_state;
use super::record::{Packed, Record, figured, light, named_state, packed};
use super::store::{insert_findings, put_blob, read_product};
use super::verified::{blob_of, seal_rows, sealed};
use super::{Catalogue, CatalogueError, Product, ProductFinding, State, StateName};
use crate::compute::btdf::{Dataset, LightFigures};
use crate::compute::estimate::Progress;
use crate::formats::dataset_blob::decode;
use rusqlite::{OptionalExtension, Transaction, params};
use std::sync::Arc;

/// Keys that identify a state of a product.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct StateKey {
    /// Key of the product.
    pub product: String,
    /// Key of the state; empty for a product with a single state without key.
    pub state: String,
}

impl Catalogue {
    /// Returns all states whose data are still to be computed, in the order of the catalogue.
    pub fn waiting(&self) -> Result<Vec<StateKey>, CatalogueError> {
        let mut ask = self.db.prepare_cached(
            "SELECT p.key, s.key FROM state s JOIN product p ON p.id = s.product
             WHERE s.dataset IS NULL ORDER BY p.rank, p.key, s.position",
        )?;
        let rows = ask.query_map([], |row| Ok(StateKey { product: row.get(0)?, state: row.get(1)? }))?;
        Ok(rows.collect::<Result<_, _>>()?)
    }

    /// Returns the number of states of built-in products.
    pub fn builtin_states(&self) -> Result<usize, CatalogueError> {
        let sql = "SELECT count(*) FROM state s JOIN product p ON p.id = s.product WHERE p.builtin = 1";
        Ok(self.db.query_row(sql, [], |row| row.get::<_, i64>(0))?.unsigned_abs() as usize)
    }

    /// Returns the key of the state whose data have to be computed before [`Self::dataset`] can return its result for
    /// the same arguments; `None` where the data are present, and where there is no such state.
    pub fn to_compute(&self, key: &str, state: Option<&str>) -> Result<Option<String>, CatalogueError> {
        let mut ask = self.db.prepare_cached(
            "SELECT s.key FROM state s JOIN product p ON p.id = s.product
             WHERE p.key = ?1 AND s.dataset IS NULL
               AND CASE WHEN ?2 IS NULL THEN (SELECT count(*) FROM state WHERE product = p.id) = 1 ELSE s.key = ?2 END",
        )?;
        let found: Option<String> = ask.query_row(params![key, state], |row| row.get(0)).optional()?;
        Ok(found.filter(|state| self.held(key, state).is_none()))
    }

    /// Returns the data of a state that were computed but could not be stored.
    pub(super) fn held(&self, key: &str, state: &str) -> Option<Arc<Dataset>> {
        let held = self.held.borrow();
        held.iter().find(|(one, _)| *one == [key, state]).map(|(_, dataset)| Arc::clone(dataset))
    }

    /// Stores the computed data of a built-in product's state as [`Self::put_state`] does. Where nothing can be stored
    /// – in a read-only folder, on a full disk – they are held in memory as long as the catalogue is open.
    pub fn keep_state(&mut self, product: &Product, dataset: &Dataset) -> Result<(), CatalogueError> {
        match self.put_state(product, dataset) {
            Err(error) if error.of_place() => {
                // The same numbers as where they are stored.
                let mut read = packed(dataset)?.dataset;
                read.described = described_state(&product.system, &dataset.state);
                let key = [product.key.clone(), dataset.state.clone()];
                self.held.borrow_mut().push((key, Arc::new(read)));
                Ok(())
            }
            other => other,
        }
    }

    /// Stores the computed data of a built-in product's state that lacked them. Changes nothing where another program
    /// has stored them already, or has replaced the product by a newer one. `product`: the product as it was when the
    /// data were computed from its description.
    pub fn put_state(&mut self, product: &Product, dataset: &Dataset) -> Result<(), CatalogueError> {
        // Packed before the lock is taken, so that other connections do not wait for it.
        let Packed { hash, blob, dataset: read, .. } = packed(dataset)?;
        let wanted = |what: &str| CatalogueError::Import(format!("dataset \"{}\" has no {what}", dataset.name));
        let transmission = read.transmission_of_either_side().ok_or_else(|| wanted("visible transmission"))?;
        let named = named_state(&dataset.state, StateName::default());
        let state = State { dataset: Some(hash), ..figured(named, transmission, dataset.described.as_ref()) };
        let findings: Vec<ProductFinding> = read
            .findings
            .iter()
            .map(|finding| ProductFinding {
                state: state.key.clone(),
                severity: finding.severity,
                code: finding.code.to_owned(),
                message: finding.message.clone(),
            })
            .collect();
        let tx = self.change()?;
        fill(&tx, product, &state, &blob, &findings)?;
        tx.commit()?;
        Ok(())
    }

    /// Computes the figures of the transmitted light for states that older programs stored without them. Stops when
    /// `progress` is cancelled. Returns the number of states that got their figures. Data that cannot be read are
    /// skipped; reading them later reports the error.
    pub fn fill_figures(&mut self, progress: &dyn Progress) -> Result<usize, CatalogueError> {
        let sql =
            "SELECT p.key, p.system, s.product, s.position, s.key, s.dataset FROM state s JOIN product p ON p.id = s.product
                   WHERE s.sun_blocked IS NULL AND s.dataset IS NOT NULL ORDER BY p.rank, p.key, s.position";
        let mut ask = self.db.prepare(sql)?;
        let rows = ask.query_map([], |row| {
            Ok(([row.get(0)?, row.get(1)?], [row.get(2)?, row.get(3)?], row.get(4)?, row.get(5)?))
        })?;
        let list: Vec<([String; 2], [i64; 2], String, String)> = rows.collect::<Result<_, _>>()?;
        drop(ask);
        let mut filled = 0;
        for (done, ([product, system], place, state, hash)) in list.iter().enumerate() {
            progress.advance("figures", done, list.len());
            if progress.cancelled() {
                break;
            }
            let Some(dataset) = blob_of(&self.db, hash).ok().and_then(|blob| decode(&blob).ok()) else { continue };
            let Some(transmission) = dataset.transmission_of_either_side() else { continue };
            let figures = light(transmission, described_state(system, state).as_ref());
            let tx = self.change()?;
            if read_product(&tx, product).and_then(|product| sealed(&tx, product)).is_err() {
                continue;
            }
            set_light(&tx, *place, &figures)?;
            tx.commit()?;
            filled += 1;
        }
        Ok(filled)
    }
}

/// Writes the figures of a state's transmitted light. The state is identified by the id of its product and its position
/// among the states.
pub(super) fn set_light(
    tx: &Transaction<'_>,
    [product, position]: [i64; 2],
    light: &LightFigures,
) -> Result<(), CatalogueError> {
    tx.prepare_cached("UPDATE state SET to_ceiling = ?, sun_blocked = ?, view = ? WHERE product = ? AND position = ?")?
        .execute(params![light.to_ceiling, light.sun_blocked, light.view, product, position])?;
    seal_rows(tx, product)
}

/// Adds dataset and figures to a state of a built-in product that lacks them; does nothing if it has them, or if the
/// product was made from another description. The seal of the product (hash of its rows) is checked before and renewed
/// after.
fn fill(
    tx: &Transaction<'_>,
    product: &Product,
    state: &State,
    blob: &[u8],
    findings: &[ProductFinding],
) -> Result<(), CatalogueError> {
    let place: Option<[i64; 2]> = tx
        .prepare_cached(
            "SELECT s.product, s.position FROM state s JOIN product p ON p.id = s.product
             WHERE p.builtin = 1 AND p.key = ? AND p.source_hash = ? AND s.key = ? AND s.dataset IS NULL",
        )?
        .query_row([&product.key, &product.provenance.source_hash, &state.key], |row| Ok([row.get(0)?, row.get(1)?]))
        .optional()?;
    let Some(place) = place else { return Ok(()) };
    sealed(tx, read_product(tx, &product.key)?)?;
    if let Some(hash) = &state.dataset {
        put_blob(tx, hash, blob)?;
    }
    tx.prepare_cached(
        "UPDATE state SET dataset = ?, tau_normal = ?, tau_hemispherical = ?, tau_profile = ?
         WHERE product = ? AND position = ?",
    )?
    .execute(params![
        state.dataset,
        state.tau_normal,
        state.tau_hemispherical,
        serde_json::json!(state.tau_profile).to_string(),
        place[0],
        place[1]
    ])?;
    if let Some(light) = &state.light {
        set_light(tx, place, light)?;
    }
    insert_findings(tx, place, findings.iter())?;
    seal_rows(tx, place[0])
}

/// Copies the data of a built-in product that another catalogue has computed, where this catalogue lacks some of them
/// and those that it has are the same. Returns `false` for another product, or if nothing was missing.
pub(super) fn adopt(tx: &Transaction<'_>, record: &Record) -> Result<bool, CatalogueError> {
    let given = &record.product;
    let held = match read_product(tx, &given.key) {
        Err(CatalogueError::NoProduct(_)) => return Ok(false),
        other => other?,
    };
    let same_source = held.builtin
        && held.provenance.source_hash == given.provenance.source_hash
        && held.provenance.method == given.provenance.method
        && held.states.len() == given.states.len();
    let fits = |(own, other): (&State, &State)| {
        own.key == other.key && (own.dataset.is_none() || own.dataset == other.dataset)
    };
    if !same_source || !held.states.iter().zip(&given.states).all(fits) {
        return Ok(false);
    }
    for (_, state) in held.states.iter().zip(&given.states).filter(|(own, _)| own.dataset.is_none()) {
        let Some((_, blob)) = record.datasets.iter().find(|(hash, _)| Some(hash) == state.dataset.as_ref()) else {
            continue;
        };
        let findings: Vec<ProductFinding> =
            given.findings.iter().filter(|finding| finding.state == state.key).cloned().collect();
        fill(tx, given, state, blob, &findings)?;
    }
    Ok(true)
}
