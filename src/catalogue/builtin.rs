//! The products that come with the program, computed from their descriptions under `assets/systems`.
//!
//! A file gets the quick ones when it is opened ([`builtin_products`], some tenths of a second); the others take longer
//! and are put in by whoever can wait: [`Catalogue::missing_builtin`] says which, [`Catalogue::put_builtin`] stores them.

use super::described::{described_dataset, method, product_of};
use super::systems::{SYSTEMS, builtin_system};
use super::{Catalogue, CatalogueError, NewProduct, Origin, Provenance, store};
use crate::compute::btdf::{Band, Btdf, Dataset};
use crate::compute::estimate::Silent;
use crate::compute::goniophotometer::Setting;
use crate::compute::goniophotometer::specimen::specimen;
use crate::compute::system::description::SystemKind;
use crate::compute::system::{diffuser::lambertian, front_basis};
use crate::formats::system_toml::SystemFile;
use rayon::prelude::*;
use rusqlite::OptionalExtension;

/// Raised whenever the built-in products change otherwise than by their descriptions; a file with a lower number gets
/// all of them anew.
pub const BUILTIN_VERSION: i64 = 4;
/// Error target of the built-in products, absolute in τ and ρ.
pub const BUILTIN_ERROR: f64 = 0.003;
/// Others that are there at once, among them the one that a new window shows.
const QUICK: [&str; 2] = ["venetian-80-72", "laser-cut-panel"];

/// Computed fast enough to be there at once?
fn is_quick(file: &SystemFile) -> bool {
    matches!(file.system.kind, SystemKind::Pane(_) | SystemKind::Diffuser(_)) || QUICK.contains(&file.key.as_str())
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

/// Rank of a built-in description; the ideal systems come before all.
fn rank(position: usize) -> i64 {
    100 + position as i64
}

/// The built-in products that are there at once, with their datasets and their ranks.
pub fn builtin_products() -> Vec<(i64, NewProduct, Vec<Dataset>)> {
    let mut list: Vec<_> = (0..).zip(ideals()).map(|(rank, (product, datasets))| (rank, product, datasets)).collect();
    let quick: Vec<_> = SYSTEMS
        .par_iter()
        .enumerate()
        .filter_map(|(position, (name, _))| {
            let (file, text) = builtin_system(name)?;
            is_quick(&file).then(|| {
                let cells = front_basis();
                let setting = Setting { incident: &cells, emergent: &cells, error: BUILTIN_ERROR, seed: 1 };
                let dataset = |state: String| {
                    let specimen =
                        specimen(&file.system, &state).expect("built-in descriptions are computed by the tests");
                    let (visible, quality) = specimen.examine(&setting, &Silent).expect("nobody cancels");
                    described_dataset(&file, state, visible, &quality, BUILTIN_ERROR)
                };
                let datasets: Vec<Dataset> = file.system.states().into_par_iter().map(dataset).collect();
                (rank(position), product_of(&file, text, builtin_method(&file), &datasets), datasets)
            })
        })
        .collect();
    list.extend(quick);
    list
}

/// How built-in products are computed.
pub fn builtin_method(file: &SystemFile) -> String {
    method(&file.system, BUILTIN_ERROR, [front_basis().len(); 2])
}

impl Catalogue {
    /// Names of the built-in descriptions whose products are not in the file as they are now.
    pub fn missing_builtin(&self) -> Result<Vec<&'static str>, CatalogueError> {
        let mut ask = self.db.prepare_cached("SELECT 1 FROM product WHERE builtin = 1 AND source_hash = ?")?;
        let mut missing = Vec::new();
        for (name, text) in SYSTEMS {
            if !ask.exists([blake3::hash(text.as_bytes()).to_hex().as_str()])? {
                missing.push(*name);
            }
        }
        Ok(missing)
    }

    /// Stores the product of a built-in description in place of an older one. Favourites stay.
    pub fn put_builtin(&mut self, name: &str, product: NewProduct, datasets: &[Dataset]) -> Result<(), CatalogueError> {
        let position = SYSTEMS.iter().position(|(file, _)| *file == name).unwrap_or(SYSTEMS.len());
        let mut record = store::prepare_unasked(datasets, product)?;
        let tx = self.change()?;
        // Its older self and another process's copy.
        tx.execute(
            "DELETE FROM product_text WHERE rowid IN (SELECT id FROM product WHERE builtin = 1 AND key = ?)",
            [&record.product.key],
        )?;
        tx.execute("DELETE FROM product WHERE builtin = 1 AND key = ?", [&record.product.key])?;
        record.product.builtin = true;
        record.product.key = store::free_key(&tx, &record.product.key)?;
        store::insert(&tx, &record, rank(position))?;
        tx.execute("DELETE FROM dataset WHERE hash NOT IN (SELECT dataset FROM state)", [])?;
        tx.commit()?;
        Ok(())
    }
}

/// Puts this program's quick built-in products into a file that has none or older ones, in one transaction. Rows of
/// the user's and favourites stay. A file that a newer program filled is left as it is.
pub(super) fn renew(catalogue: &mut Catalogue) -> Result<(), CatalogueError> {
    if version(&catalogue.db)? >= BUILTIN_VERSION {
        return Ok(());
    }
    // Computed before the lock is taken, so that other connections do not wait for it.
    let records = builtin_products()
        .into_par_iter()
        .map(|(rank, meta, datasets)| Ok((rank, store::prepare_unasked(&datasets, meta)?)))
        .collect::<Result<Vec<_>, CatalogueError>>()?;
    let tx = catalogue.change()?;
    if version(&tx)? >= BUILTIN_VERSION {
        return Ok(());
    }
    tx.execute("DELETE FROM product_text WHERE rowid IN (SELECT id FROM product WHERE builtin = 1)", [])?;
    tx.execute("DELETE FROM product WHERE builtin = 1", [])?;
    for (rank, mut record) in records {
        record.product.builtin = true;
        record.product.key = store::free_key(&tx, &record.product.key)?;
        store::insert(&tx, &record, rank)?;
    }
    tx.execute("DELETE FROM dataset WHERE hash NOT IN (SELECT dataset FROM state)", [])?;
    tx.execute("INSERT OR REPLACE INTO meta VALUES ('builtin_version', ?)", [BUILTIN_VERSION.to_string()])?;
    tx.commit()?;
    Ok(())
}

/// Rank of the built-in product that a computed product is, by its description's text, where the file is still to get
/// it.
pub(super) fn rank_of(db: &rusqlite::Connection, product: &super::Product) -> Result<Option<i64>, CatalogueError> {
    let position = SYSTEMS.iter().position(|(_, text)| *text == product.system);
    let Some((position, (file, _))) = position.and_then(|at| Some((at, builtin_system(SYSTEMS[at].0)?))) else {
        return Ok(None);
    };
    let same = product.key == file.key && product.provenance.method == builtin_method(&file);
    let wanted = same && version(db)? > 0 && store::free_key(db, &product.key)? == product.key;
    Ok(wanted.then(|| rank(position)))
}

/// The key, or another one where it belongs to a built-in product that this file is still to get.
pub(super) fn unreserved(db: &rusqlite::Connection, key: &str) -> Result<String, CatalogueError> {
    let reserved = || SYSTEMS.iter().any(|(name, _)| builtin_system(name).is_some_and(|(file, _)| file.key == key));
    Ok(if version(db)? > 0 && reserved() { format!("{key}-2") } else { key.to_owned() })
}

/// Version of the built-in products in the file; 0 without any.
fn version(db: &rusqlite::Connection) -> Result<i64, CatalogueError> {
    let text: Option<String> =
        db.query_row("SELECT value FROM meta WHERE key = 'builtin_version'", [], |row| row.get(0)).optional()?;
    Ok(text.and_then(|text| text.parse().ok()).unwrap_or(0))
}
