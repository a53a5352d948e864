//! The window's services as they are in earnest: the catalogue's file, the study, luminaire files.

use super::engine::{Engine, LidFigures, Question, RoomFigures};
use super::shelf::{Addition, Entry, Found, Query, Shelf};
use crate::catalogue::{self, Catalogue, Imported, NewProduct, Product};
use crate::compute::btdf::{Btdf, Dataset};
use crate::compute::estimate::Progress;
use crate::formats::ies::IesEdition;
use crate::study::accuracy::{Accuracy, ladder};
use crate::study::compact::stored_by_default;
use crate::study::control::{ControlQuestion, Device, pick_state};
use crate::study::luminaire_file::{LidFormat, describe, encode};
use crate::study::scene_file::SystemKeys;
use crate::study::{Library, Scene, Session, StudyError, System, SystemLibrary};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// The catalogue's file, one request at a time.
struct CatalogueShelf {
    catalogue: Mutex<Catalogue>,
    /// Is it to be filled with the built-in products that take longer?
    fills: bool,
}

/// Opens a catalogue's file, or the user's own.
pub fn open_shelf(path: Option<&Path>) -> Result<Arc<dyn Shelf>, String> {
    let catalogue = path.map_or_else(Catalogue::open_default, Catalogue::open).map_err(|error| error.to_string())?;
    Ok(Arc::new(CatalogueShelf { catalogue: Mutex::new(catalogue), fills: true }))
}

/// A new catalogue in memory with the built-in products.
pub fn memory_shelf() -> Result<Arc<dyn Shelf>, String> {
    let catalogue = Catalogue::in_memory().map_err(|error| error.to_string())?;
    Ok(Arc::new(CatalogueShelf { catalogue: Mutex::new(catalogue), fills: false }))
}

/// A catalogue in memory with nothing but the two ideal systems that every comparison starts from.
pub fn ideals_shelf() -> Result<Arc<dyn Shelf>, String> {
    let catalogue = Catalogue::empty_in_memory().map_err(told)?;
    let shelf = CatalogueShelf { catalogue: Mutex::new(catalogue), fills: false };
    for (name, btdf) in [("Clear opening", Btdf::ideal_transparent(1.0)), ("Ideal diffuser", Btdf::ideal_diffuse(0.6))]
    {
        let mut dataset = Dataset { name: name.to_owned(), ..Dataset::default() };
        dataset.visible.transmission_front = Some(btdf);
        shelf.add(&Addition {
            datasets: vec![Arc::new(dataset)],
            product: NewProduct { name: name.to_owned(), kind: "ideal".to_owned(), ..NewProduct::default() },
        })?;
    }
    Ok(Arc::new(shelf))
}

impl CatalogueShelf {
    fn lock(&self) -> MutexGuard<'_, Catalogue> {
        // Every change is a transaction: what a panic left behind is whole.
        self.catalogue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn told(error: catalogue::CatalogueError) -> String {
    error.to_string()
}

impl Shelf for CatalogueShelf {
    fn search(&self, query: &Query) -> Result<Found, String> {
        let catalogue = self.lock();
        let words = catalogue::Query {
            text: query.text.clone(),
            favourite: query.favourites.then_some(true),
            ..catalogue::Query::default()
        };
        let mut found = Found { total: catalogue.facets().map_err(told)?.all, ..Found::default() };
        let mut kinds = std::collections::BTreeMap::new();
        for row in catalogue.search(&words).map_err(told)? {
            *kinds.entry(row.kind.clone()).or_insert(0) += 1;
            if !query.kinds.is_empty() && !query.kinds.contains(&row.kind) {
                continue;
            }
            found.entries.push(Entry {
                key: row.key,
                name: row.name,
                manufacturer: row.manufacturer,
                kind: row.kind,
                states: row.state_keys,
                tau_normal: row.tau_normal,
                tau_hemispherical: row.tau_hemispherical,
                profile: row.tau_profile.iter().map(|&tau| tau as f32).collect(),
                favourite: row.favourite,
            });
        }
        found.kinds = kinds.into_iter().collect();
        Ok(found)
    }

    fn load(&self, product: &str, state: Option<&str>) -> Result<Arc<Dataset>, String> {
        let catalogue = self.lock();
        match state {
            Some(state) => catalogue.dataset(product, Some(state)).map_err(told),
            None => {
                let first = catalogue.product(product).map_err(told)?.states.into_iter().next();
                let first = first.ok_or_else(|| format!("{product} has no state: import it again"))?;
                catalogue.dataset(product, Some(&first.key)).map_err(told)
            }
        }
    }

    fn product(&self, product: &str) -> Result<Arc<Product>, String> {
        self.lock().product(product).map(Arc::new).map_err(told)
    }

    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        let product = self.lock().product(product).map_err(|error| StudyError::Catalogue(error.to_string()))?;
        pick_state(&Device::of(&product)?, asked)
    }

    fn next_builtin(&self) -> Result<Option<(&'static str, usize)>, String> {
        if !self.fills {
            return Ok(None);
        }
        let missing = self.lock().missing_builtin().map_err(told)?;
        Ok(missing.first().map(|&name| (name, missing.len())))
    }

    fn put_builtin(&self, name: &str, product: NewProduct, datasets: &[Dataset]) -> Result<(), String> {
        self.lock().put_builtin(name, product, datasets).map_err(told)
    }

    fn add(&self, addition: &Addition) -> Result<String, String> {
        let datasets: Vec<Dataset> = addition.datasets.iter().map(|dataset| stored_by_default(dataset)).collect();
        self.lock().import(&datasets, addition.product.clone()).map(|imported| imported.key).map_err(told)
    }

    fn import_package(&self, bytes: &[u8]) -> Result<Vec<Imported>, String> {
        self.lock().import_package(bytes).map_err(told)
    }

    fn remove(&self, product: &str) -> Result<(), String> {
        self.lock().remove_product(product).map_err(told)
    }

    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), String> {
        self.lock().set_favourite(product, favourite).map_err(told)
    }
}

/// Files and closed forms from the study's library, products from the shelf.
struct WindowLibrary<'a> {
    files: &'a Library,
    shelf: &'a dyn Shelf,
}

impl SystemLibrary for WindowLibrary<'_> {
    fn load(&self, keys: &SystemKeys, base: &Path) -> Result<Arc<System>, StudyError> {
        let SystemKeys::Catalogue { key, state } = keys else { return self.files.load(keys, base) };
        let dataset = self.shelf.load(key, state.as_deref()).map_err(StudyError::Catalogue)?;
        Ok(Arc::new(System { label: dataset.name.clone(), state: state.clone().unwrap_or_default(), dataset }))
    }

    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        self.shelf.controlled_state(product, asked)
    }
}

/// The study with its caches.
#[derive(Default)]
pub struct StudyEngine {
    session: Session,
    files: Library,
}

impl StudyEngine {
    fn scene(&self, question: &Question) -> Result<Scene, String> {
        let library = WindowLibrary { files: &self.files, shelf: &*question.shelf };
        Scene::resolve(&question.scene, &question.base, &library).map_err(|error| error.to_string())
    }
}

impl Engine for StudyEngine {
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, String> {
        let start = Instant::now();
        let scene = self.scene(question)?;
        let result = self.session.room(&scene, progress).map_err(|error| error.to_string())?;
        Ok(RoomFigures {
            positions: result.sensors.iter().map(|sensor| sensor.sensor.position.to_array()).collect(),
            direct: result.sensors.iter().map(|sensor| sensor.direct).collect(),
            interreflected: result.sensors.iter().map(|sensor| sensor.interreflected).collect(),
            grid: scene.grid,
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, String> {
        let start = Instant::now();
        let scene = self.scene(question)?;
        if scene.apertures.is_empty() {
            return Err("the scene has no aperture: add one in the scene panel".to_owned());
        }
        let result = self.session.lid(&scene, 0, progress).map_err(|error| error.to_string())?;
        let name = scene.apertures[0].system.label.clone();
        Ok(LidFigures {
            lid: result.lid,
            flux: result.flux,
            incident: Some(result.incident.0.value + result.incident.1),
            description: describe(&name, &question.scene, 0, ""),
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, String> {
        ladder(&self.scene(question)?, progress).map_err(|error| error.to_string())
    }

    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, String> {
        let told = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let format = LidFormat::of(path, IesEdition::Lm63_2002).map_err(|error| told(&error))?;
        let file = encode(&lid.lid, lid.description.clone(), format, None, None).map_err(|error| told(&error))?;
        Ok(file.bytes)
    }
}
