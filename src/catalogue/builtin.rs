//! Built-in products: two ideal systems without a description, and those of the descriptions under `assets/systems`.
//!
//! A catalogue file gets all of them when it is opened, with the figures (such as τ) of a table that comes with the
//! program. Their data are computed at their first use, by layers above ([`Catalogue::to_compute`],
//! [`Catalogue::put_state`]).

use super::described::{METHODS, method, product_of, with_builtins};
use super::history::{RESTORED, note};
use super::record::{self, Record, named_state};
use super::store::{self, read_product};
use super::systems::{SYSTEMS, builtin_system};
use super::verified::{damaged_products, sealed};
use super::waiting::set_light;
use super::{Catalogue, CatalogueError, NewProduct, Origin, PROFILE_ANGLES, Product, Provenance, State, StateName};
use crate::compute::btdf::{Band, Btdf, Dataset, DescribedState, LightFigures};
use crate::compute::system::measure::front_basis;
use crate::compute::system::sheets::diffuser::lambertian;
use crate::formats::figures_table::{self, FigureRow};
use crate::formats::system_toml::{self, SystemFile};
use rusqlite::{Connection, OptionalExtension, Transaction, TransactionBehavior};
use std::collections::{HashMap, HashSet};
use std::sync::LazyLock;

/// Version of the built-in products, raised whenever they change otherwise than by their descriptions. In a catalogue
/// file with a lower number all of them are replaced.
pub const BUILTIN_VERSION: i64 = 4;
/// Error target when data of built-in products are computed: absolute error of transmittance τ and reflectance ρ.
pub const BUILTIN_ERROR: f64 = 0.003;
/// End of the names of description files.
const SYSTEM_SUFFIX: &str = ".system.toml";

/// Table of the figures (such as τ) of all states of built-in products, as CSV in the format of
/// [`crate::formats::figures_table`]. Written by `cfs catalogue build --table assets/builtin-figures.csv` on a new
/// catalogue; a test fails when that is due.
pub const TABLE: &str = include_str!("../../assets/builtin-figures.csv");

/// Keys of the ideal systems, which have no description.
const IDEALS: [&str; 2] = ["open-aperture", "ideal-diffuser"];

/// Returns the ideal systems with their datasets.
fn ideals() -> Vec<(NewProduct, Vec<Dataset>)> {
    let open = Band {
        transmission_front: Some(Btdf::ideal_transparent(1.0)),
        transmission_back: Some(Btdf::ideal_transparent(1.0)),
        reflection_front: Some(Btdf::ideal_diffuse(0.0)),
        reflection_back: Some(Btdf::ideal_diffuse(0.0)),
    };
    let ideal = |key: &str, name: &str, tags: &[&str], description: &str, visible: Band| {
        let dataset =
            Dataset { name: name.to_owned(), description: description.to_owned(), visible, ..Dataset::default() };
        let product = NewProduct {
            key: Some(key.to_owned()),
            name: name.to_owned(),
            kind: "ideal".to_owned(),
            description: description.to_owned(),
            provenance: Provenance {
                origin: Origin::Computed,
                author: "cfs".to_owned(),
                method: "Definition".to_owned(),
                inside_face: "either (symmetric)".to_owned(),
                ..Provenance::default()
            },
            tags: tags.iter().map(|&tag| tag.to_owned()).collect(),
            ..NewProduct::default()
        };
        (product, vec![dataset])
    };
    vec![
        ideal(
            IDEALS[0],
            "Open aperture",
            &["reference"],
            "Nothing in the aperture: all light passes undeviated. Reference for every comparison.",
            open,
        ),
        ideal(
            IDEALS[1],
            "Ideal diffuser",
            &["reference", "diffusing"],
            "Half of the light leaves with the same luminance in every direction, whatever its incidence; a third is \
             reflected the same way.",
            lambertian(0.5, 1.0 / 3.0),
        ),
    ]
}

/// Returns the position of a built-in description in the order of the catalogue; the ideal systems precede all.
fn rank(name: &str) -> i64 {
    100 + SYSTEMS.iter().position(|(file, _)| *file == name).unwrap_or(SYSTEMS.len()) as i64
}

/// Stores a built-in product in place of its older version, and of a copy that another process has stored meanwhile.
fn put(tx: &Transaction<'_>, mut record: Record, rank: i64) -> Result<(), CatalogueError> {
    tx.execute("DELETE FROM product WHERE builtin = 1 AND key = ?", [&record.product.key])?;
    record.product.builtin = true;
    record.product.key = store::free_key(tx, &record.product.key)?;
    store::insert(tx, &record, rank)
}

/// Returns a text on the method by which the data of a built-in product are computed, for its provenance.
pub fn builtin_method(file: &SystemFile) -> String {
    method(&file.system, BUILTIN_ERROR, [front_basis().len(); 2])
}

/// Returns the key of the product of a built-in description, from the name of its file.
pub fn key_of_builtin(name: &str) -> &str {
    name.strip_suffix(SYSTEM_SUFFIX).unwrap_or(name)
}

/// Returns a hash of everything on which the data of a built-in product depend: its description with the text of all
/// layers, the version of the methods, and the error target.
pub fn fingerprint(description: &str) -> String {
    let all = format!("{description}\0methods {METHODS}\0error {BUILTIN_ERROR}");
    blake3::hash(all.as_bytes()).to_hex()[..16].to_owned()
}

/// Built-in products with a description, by the names of their description files; with the figures of the table and
/// without data. A product whose description changed since the table was written has no figures.
///
/// # Panics
/// Never: the tests read the table and every description.
static PRODUCTS: LazyLock<Vec<(&str, Product)>> = LazyLock::new(|| {
    let rows = figures_table::read(TABLE, &PROFILE_ANGLES).expect("the table is read by the tests");
    let rows: HashMap<(&str, &str, &str), &FigureRow> =
        rows.iter().map(|row| ((row.product.as_str(), row.fingerprint.as_str(), row.state.as_str()), row)).collect();
    let product = |&(name, text): &(&'static str, &'static str)| {
        let (file, _) = builtin_system(name)?;
        let description = with_builtins(text, 0)?;
        let described = |state: String| Dataset {
            described: Some(DescribedState { text: description.clone(), state: state.clone() }),
            state,
            ..Dataset::default()
        };
        let datasets: Vec<Dataset> = system_toml::states(&description)?.into_iter().map(described).collect();
        let meta = product_of(&file, text, builtin_method(&file), &datasets);
        let fingerprint = fingerprint(&description);
        let state = |(dataset, named): (&Dataset, &StateName)| {
            let state = named_state(&dataset.state, named.clone());
            match rows.get(&(key_of_builtin(name), fingerprint.as_str(), dataset.state.as_str())) {
                Some(row) => with_figures(state, row),
                None => state,
            }
        };
        let states = datasets.iter().zip(&meta.states).map(state).collect();
        Some((name, record::product(meta, states, Vec::new()).ok()?))
    };
    SYSTEMS.iter().map(|system| product(system).expect("every built-in description is stored by the tests")).collect()
});

fn with_figures(state: State, row: &FigureRow) -> State {
    State {
        tau_normal: Some(row.tau_normal),
        tau_hemispherical: Some(row.tau_hemispherical),
        tau_profile: row.tau_profile.clone(),
        light: Some(LightFigures { to_ceiling: row.to_ceiling, sun_blocked: row.sun_blocked, view: row.view }),
        ..state
    }
}

/// Whether `key` is the key of a built-in product.
pub(super) fn is_builtin(key: &str) -> bool {
    IDEALS.contains(&key) || PRODUCTS.iter().any(|(_, product)| product.key == key)
}

/// Whether anything in a stored built-in product on which results depend differs from the version in this program.
/// `false` for a product whose description this program does not have.
pub(super) fn differs(product: &Product) -> bool {
    PRODUCTS.iter().map(|(_, own)| own).any(|own| {
        own.provenance.source_hash == product.provenance.source_hash
            && (own.system != product.system
                || own.control_curve != product.control_curve
                || !own
                    .states
                    .iter()
                    .map(|one| (&one.key, one.value))
                    .eq(product.states.iter().map(|one| (&one.key, one.value))))
    })
}

/// Whether a damaged row of the database belongs to a built-in product. The column that says so may itself be damaged.
pub(super) fn is_row_of_builtin(db: &Connection, id: i64) -> Result<bool, CatalogueError> {
    let (builtin, rank, key): (bool, i64, Vec<u8>) = db
        .prepare_cached("SELECT builtin, rank, CAST(key AS BLOB) FROM product WHERE id = ?")?
        .query_row([id], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))?;
    let ranked = rank < store::USER_RANK;
    Ok((builtin && ranked) || ((builtin || ranked) && str::from_utf8(&key).is_ok_and(is_builtin)))
}

/// Returns the file names of the built-in descriptions whose products are missing in the catalogue file, or were made
/// from another version of the description.
fn missing(db: &Connection) -> Result<Vec<&'static str>, CatalogueError> {
    let mut ask = db.prepare_cached("SELECT source_hash FROM product WHERE builtin = 1")?;
    let there: HashSet<String> = ask.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?;
    let is_there = |text: &str| there.contains(blake3::hash(text.as_bytes()).to_hex().as_str());
    Ok(SYSTEMS.iter().filter(|(_, text)| !is_there(text)).map(|(name, _)| *name).collect())
}

/// Whether a built-in product is in the file.
fn is_there(db: &Connection, key: &str) -> Result<bool, CatalogueError> {
    let there = "SELECT EXISTS (SELECT 1 FROM product WHERE builtin = 1 AND key = ?)";
    Ok(db.prepare_cached(there)?.query_row([key], |row| row.get(0))?)
}

/// Whether the file has built-in products without the version that every program writes with them.
pub(super) fn is_version_lost(db: &Connection) -> Result<bool, CatalogueError> {
    let any = "SELECT EXISTS (SELECT 1 FROM product WHERE builtin = 1)";
    Ok(version(db)? < 1 && db.query_row(any, [], |row| row.get(0))?)
}

/// Whether [`renew`] has anything to do.
fn is_due(db: &Connection) -> Result<bool, CatalogueError> {
    let found = version(db)?;
    // Older programs stored no figures of how light leaves.
    let bare = "SELECT EXISTS (SELECT 1 FROM state s JOIN product p ON p.id = s.product
                               WHERE p.builtin = 1 AND s.sun_blocked IS NULL)";
    Ok(found < BUILTIN_VERSION
        || (found == BUILTIN_VERSION
            && (!missing(db)?.is_empty()
                || IDEALS.iter().any(|key| !is_there(db, key).unwrap_or(true))
                || db.query_row(bare, [], |row| row.get(0))?)))
}

/// Adds the built-in products of this program that a catalogue file lacks, in one transaction: with their figures, and
/// without data, which are computed at their first use. Removes the products of an older program, and preserves the
/// user's products and favourites. Leaves a file that a newer program filled unchanged.
pub(super) fn renew(catalogue: &mut Catalogue) -> Result<(), CatalogueError> {
    if !is_due(&catalogue.db)? {
        return Ok(());
    }
    // Made before the lock is taken, so that other connections do not wait for it.
    let products = &*PRODUCTS;
    let ideals = ideal_records()?;
    let tx = catalogue.change()?;
    // Another program may have been faster, even a newer one.
    if !is_due(&tx)? {
        return Ok(());
    }
    let damaged = if is_version_lost(&tx)? {
        let mut ask = tx.prepare("SELECT id FROM product WHERE builtin = 1")?;
        ask.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?
    } else {
        // Where pages are broken the file has to be repaired first.
        damaged_rows(&tx).unwrap_or_default()
    };
    let restored = remove_damaged(&tx, &damaged)?;
    for product in products.iter().map(|(_, product)| product).chain(ideals.iter().map(|record| &record.product)) {
        light_up(&tx, product)?;
    }
    if version(&tx)? < BUILTIN_VERSION {
        tx.execute("DELETE FROM product WHERE builtin = 1", [])?;
        tx.execute("INSERT OR REPLACE INTO meta VALUES ('builtin_version', ?)", [BUILTIN_VERSION.to_string()])?;
    }
    put_missing(&tx, ideals)?;
    tx.commit()?;
    catalogue.restored.borrow_mut().extend(restored);
    Ok(())
}

/// Restores the built-in products whose rows are damaged from what this program contains; their data are computed at
/// their next use. Returns `false` where none is damaged, or where a newer program filled the file.
///
/// # Errors
/// Returns an error if nothing can be written.
pub(super) fn restore_damaged(catalogue: &Catalogue) -> Result<bool, CatalogueError> {
    let tx = Transaction::new_unchecked(&catalogue.db, TransactionBehavior::Immediate)?;
    let damaged = damaged_rows(&tx)?;
    if damaged.is_empty() || version(&tx)? != BUILTIN_VERSION {
        return Ok(false);
    }
    let restored = remove_damaged(&tx, &damaged)?;
    put_missing(&tx, ideal_records()?)?;
    tx.commit()?;
    catalogue.restored.borrow_mut().extend(restored);
    Ok(true)
}

/// Returns the ids of the damaged rows of built-in products.
fn damaged_rows(db: &Connection) -> Result<Vec<i64>, CatalogueError> {
    let damaged = damaged_products(db, &mut |_, _, _| {})?.into_iter();
    Ok(damaged.filter(|id| is_row_of_builtin(db, *id).unwrap_or(false)).collect())
}

/// Removes damaged rows of built-in products and records that in their histories. Returns their keys.
fn remove_damaged(tx: &Transaction<'_>, ids: &[i64]) -> Result<Vec<String>, CatalogueError> {
    let mut keys = Vec::new();
    for id in ids {
        let sql = "DELETE FROM product WHERE id = ? RETURNING CAST(key AS BLOB)";
        let key: Vec<u8> = tx.prepare_cached(sql)?.query_row([id], |row| row.get(0))?;
        let key = String::from_utf8_lossy(&key).into_owned();
        note(tx, &key, RESTORED)?;
        keys.push(key);
    }
    Ok(keys)
}

fn ideal_records() -> Result<Vec<Record>, CatalogueError> {
    ideals().into_iter().map(|(product, datasets)| record::prepare_unasked(&datasets, product)).collect()
}

/// Stores the built-in products that the file lacks.
fn put_missing(tx: &Transaction<'_>, ideals: Vec<Record>) -> Result<(), CatalogueError> {
    for (rank, ideal) in (0..).zip(ideals) {
        if !is_there(tx, &ideal.product.key)? {
            put(tx, ideal, rank)?;
        }
    }
    let missing = missing(tx)?;
    for (name, product) in PRODUCTS.iter().filter(|(name, _)| missing.contains(name)) {
        put(tx, Record::without_data(product.clone()), rank(name))?;
    }
    store::sweep(tx)
}

/// Adds missing figures of the transmitted light to the states of a built-in product that an older program stored from
/// the same description.
fn light_up(tx: &Transaction<'_>, product: &Product) -> Result<(), CatalogueError> {
    let mut ask = tx.prepare_cached(
        "SELECT s.product, s.position FROM state s JOIN product p ON p.id = s.product
         WHERE p.builtin = 1 AND p.key = ? AND p.source_hash = ? AND s.key = ? AND s.sun_blocked IS NULL",
    )?;
    for state in &product.states {
        let Some(light) = &state.light else { continue };
        let place = ask
            .query_row([&product.key, &product.provenance.source_hash, &state.key], |row| {
                Ok([row.get(0)?, row.get(1)?])
            })
            .optional()?;
        // What is damaged would be sealed with the figures.
        let is_sealed = || read_product(tx, &product.key).and_then(|held| sealed(tx, held)).is_ok();
        if let Some(place) = place.filter(|_| is_sealed()) {
            set_light(tx, place, light)?;
        }
    }
    Ok(())
}

/// Returns the version of the built-in products that is stored in the catalogue file; 0 if there is none.
fn version(db: &Connection) -> Result<i64, CatalogueError> {
    let text: Option<String> =
        db.query_row("SELECT value FROM meta WHERE key = 'builtin_version'", [], |row| row.get(0)).optional()?;
    Ok(text.and_then(|text| text.parse().ok()).unwrap_or(0))
}
