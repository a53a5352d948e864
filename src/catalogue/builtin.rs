//! The products that come with the program, computed from their descriptions under `assets/systems`.
//!
//! A file gets the quick ones when it is opened, a file that a window opens only [`FIRST`], which it shows at once. The
//! others are put in by whoever can wait: [`Catalogue::missing_builtin`] says which, [`Catalogue::put_builtin`] stores
//! them.

use super::described::{described_dataset, method, product_of};
use super::store::{self, Record};
use super::systems::{SYSTEMS, builtin_system};
use super::{Catalogue, CatalogueError, NewProduct, Origin, Provenance};
use crate::compute::btdf::{Band, Btdf, Dataset};
use crate::compute::estimate::Silent;
use crate::compute::system::SystemKind;
use crate::compute::system::measure::{Setting, front_basis};
use crate::compute::system::sheets::diffuser::lambertian;
use crate::formats::system_toml::SystemFile;
use rayon::prelude::*;
use rusqlite::{Connection, OptionalExtension, Transaction};
use std::collections::HashSet;

/// Raised whenever the built-in products change otherwise than by their descriptions; a file with a lower number gets
/// all of them anew.
pub const BUILTIN_VERSION: i64 = 4;
/// Error target of the built-in products, absolute in τ and ρ.
pub const BUILTIN_ERROR: f64 = 0.003;
/// Key of the product that a new window shows.
const FIRST: &str = "venetian-80-72";

/// Which descriptions are computed when a file is opened.
pub(super) type AtOnce = fn(&SystemFile) -> bool;

/// Those that take some tenths of a second together.
pub(super) fn quick(file: &SystemFile) -> bool {
    matches!(file.system.kind, SystemKind::Pane(_) | SystemKind::Diffuser(_))
        || [FIRST, "laser-cut-panel"].contains(&file.key.as_str())
}

/// The one that a new window shows.
pub(super) fn first(file: &SystemFile) -> bool {
    file.key == FIRST
}

/// Systems that are defined by a sentence.
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
            "open-aperture",
            "Open aperture",
            &["reference"],
            "Nothing in the opening: all light goes straight on. Reference for every comparison.",
            open,
        ),
        ideal(
            "ideal-diffuser",
            "Ideal diffuser",
            &["reference", "diffusing"],
            "Half of the light leaves with the same luminance in every direction, whatever its incidence; a third is \
             thrown back the same way.",
            lambertian(0.5, 1.0 / 3.0),
        ),
    ]
}

/// Rank of a built-in description, by its place in the list; the ideal systems come before all.
fn rank(name: &str) -> i64 {
    100 + SYSTEMS.iter().position(|(file, _)| *file == name).unwrap_or(SYSTEMS.len()) as i64
}

/// Stores a product in place of its older self and of another process's copy.
fn put(tx: &Transaction<'_>, mut record: Record, rank: i64) -> Result<(), CatalogueError> {
    tx.execute(
        "DELETE FROM product_text WHERE rowid IN (SELECT id FROM product WHERE builtin = 1 AND key = ?)",
        [&record.product.key],
    )?;
    tx.execute("DELETE FROM product WHERE builtin = 1 AND key = ?", [&record.product.key])?;
    record.product.builtin = true;
    record.product.key = store::free_key(tx, &record.product.key)?;
    store::insert(tx, &record, rank)?;
    tx.execute("DELETE FROM dataset WHERE hash NOT IN (SELECT dataset FROM state)", [])?;
    Ok(())
}

/// Computes those of the named descriptions that are wanted, ready to be stored.
fn computed(names: &[&'static str], wanted: AtOnce) -> Result<Vec<(&'static str, Record)>, CatalogueError> {
    let one = |&name: &&'static str| {
        let (file, text) = builtin_system(name).filter(|(file, _)| wanted(file))?;
        let cells = front_basis();
        let setting = Setting { incident: &cells, emergent: &cells, error: BUILTIN_ERROR, seed: 1 };
        let dataset = |state: String| {
            let specimen = file.system.specimen(&state).expect("built-in descriptions are computed by the tests");
            let (visible, quality) = specimen.examine(&setting, &Silent).expect("nobody cancels");
            described_dataset(&file, state, visible, &quality, BUILTIN_ERROR)
        };
        let datasets: Vec<Dataset> = file.system.states().into_par_iter().map(dataset).collect();
        let product = product_of(&file, text, builtin_method(&file), &datasets);
        Some(store::prepare_unasked(&datasets, product).map(|record| (name, record)))
    };
    names.par_iter().filter_map(one).collect()
}

/// How built-in products are computed.
pub fn builtin_method(file: &SystemFile) -> String {
    method(&file.system, BUILTIN_ERROR, [front_basis().len(); 2])
}

impl Catalogue {
    /// Names of the built-in descriptions whose products are not in the file as they are now.
    pub fn missing_builtin(&self) -> Result<Vec<&'static str>, CatalogueError> {
        missing(&self.db)
    }

    /// Stores the product of a built-in description in place of an older one. Favourites stay.
    pub fn put_builtin(&mut self, name: &str, product: NewProduct, datasets: &[Dataset]) -> Result<(), CatalogueError> {
        let record = store::prepare_unasked(datasets, product)?;
        let tx = self.change()?;
        put(&tx, record, rank(name))?;
        tx.commit()?;
        Ok(())
    }
}

fn missing(db: &Connection) -> Result<Vec<&'static str>, CatalogueError> {
    let mut ask = db.prepare_cached("SELECT source_hash FROM product WHERE builtin = 1")?;
    let there: HashSet<String> = ask.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?;
    let is_there = |text: &str| there.contains(blake3::hash(text.as_bytes()).to_hex().as_str());
    Ok(SYSTEMS.iter().filter(|(_, text)| !is_there(text)).map(|(name, _)| *name).collect())
}

/// Puts those of this program's built-in products that are wanted at once into a file that lacks them, in one
/// transaction; the products of an older program go. Rows of the user's and favourites stay. A file that a newer program
/// filled is left as it is.
pub(super) fn renew(catalogue: &mut Catalogue, wanted: AtOnce) -> Result<(), CatalogueError> {
    let found = version(&catalogue.db)?;
    if found > BUILTIN_VERSION {
        return Ok(());
    }
    let all = || SYSTEMS.iter().map(|(name, _)| *name).collect();
    let names = if found < BUILTIN_VERSION { all() } else { missing(&catalogue.db)? };
    // Computed before the lock is taken, so that other connections do not wait for it.
    let records = computed(&names, wanted)?;
    if records.is_empty() && found == BUILTIN_VERSION {
        return Ok(());
    }
    let tx = catalogue.change()?;
    // Another program may have been faster, even a newer one.
    let found = version(&tx)?;
    if found > BUILTIN_VERSION {
        return Ok(());
    }
    if found < BUILTIN_VERSION {
        tx.execute("DELETE FROM product_text WHERE rowid IN (SELECT id FROM product WHERE builtin = 1)", [])?;
        tx.execute("DELETE FROM product WHERE builtin = 1", [])?;
        for (rank, (product, datasets)) in (0..).zip(ideals()) {
            put(&tx, store::prepare_unasked(&datasets, product)?, rank)?;
        }
        tx.execute("INSERT OR REPLACE INTO meta VALUES ('builtin_version', ?)", [BUILTIN_VERSION.to_string()])?;
    }
    let missing = missing(&tx)?;
    for (name, record) in records.into_iter().filter(|(name, _)| missing.contains(name)) {
        put(&tx, record, rank(name))?;
    }
    tx.commit()?;
    Ok(())
}

/// Rank of the built-in product that a computed product is, by the hash of its description, where the file is still to
/// get it.
pub(super) fn rank_of(db: &Connection, product: &super::Product) -> Result<Option<i64>, CatalogueError> {
    let is_it = |text: &str| blake3::hash(text.as_bytes()).to_hex().as_str() == product.provenance.source_hash;
    let name = SYSTEMS.iter().find(|(_, text)| is_it(text)).map(|(name, _)| *name);
    let Some((name, (file, _))) = name.and_then(|name| Some((name, builtin_system(name)?))) else { return Ok(None) };
    let same = product.key == file.key && product.provenance.method == builtin_method(&file);
    let wanted = same && version(db)? > 0 && store::free_key(db, &product.key)? == product.key;
    Ok(wanted.then(|| rank(name)))
}

/// The key, or another one where it belongs to a built-in product that this file is still to get.
pub(super) fn unreserved(db: &Connection, key: &str) -> Result<String, CatalogueError> {
    let reserved = || SYSTEMS.iter().any(|(name, _)| builtin_system(name).is_some_and(|(file, _)| file.key == key));
    Ok(if version(db)? > 0 && reserved() { format!("{key}-2") } else { key.to_owned() })
}

/// Version of the built-in products in the file; 0 without any.
fn version(db: &Connection) -> Result<i64, CatalogueError> {
    let text: Option<String> =
        db.query_row("SELECT value FROM meta WHERE key = 'builtin_version'", [], |row| row.get(0)).optional()?;
    Ok(text.and_then(|text| text.parse().ok()).unwrap_or(0))
}
