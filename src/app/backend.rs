//! The window's services as they are in earnest: the catalogue's file, the study, luminaire files.

use super::engine::{Engine, LidFigures, Question, RoomFigures};
use super::error::AppError;
use super::shelf::{Addition, Found, Query, Shelf};
use crate::catalogue::{Catalogue, Imported, NewProduct, Product, default_path};
use crate::compute::btdf::{Btdf, Dataset};
use crate::compute::estimate::Progress;
use crate::formats::ies::IesEdition;
use crate::study::accuracy::{Accuracy, ladder};
use crate::study::compact::stored_by_default;
use crate::study::control::{ControlQuestion, Device, pick_state};
use crate::study::luminaire_file::{LidFormat, describe, encode};
use crate::study::scene_file::SystemKeys;
use crate::study::system::Need;
use crate::study::{Library, Scene, Session, StudyError, System, SystemLibrary};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// The catalogue's file, one request at a time.
struct CatalogueShelf {
    catalogue: Mutex<Catalogue>,
    /// A connection of its own for putting in missing built-in products, if that is to be done: packing and writing
    /// them keeps nobody from reading.
    filler: Option<Mutex<Catalogue>>,
}

/// Opens a catalogue's file, or the user's own.
pub fn open_shelf(path: Option<&Path>) -> Result<Arc<dyn Shelf>, AppError> {
    let path = path.map_or_else(default_path, |path| Ok(path.to_owned()))?;
    let open = || Catalogue::open_to_fill(&path).map(Mutex::new);
    Ok(Arc::new(CatalogueShelf { catalogue: open()?, filler: Some(open()?) }))
}

/// A new catalogue in memory with the built-in products.
pub fn memory_shelf() -> Result<Arc<dyn Shelf>, AppError> {
    let catalogue = Catalogue::in_memory()?;
    Ok(Arc::new(CatalogueShelf { catalogue: Mutex::new(catalogue), filler: None }))
}

/// A catalogue in memory with nothing but the two ideal systems that every comparison starts from.
pub fn ideals_shelf() -> Result<Arc<dyn Shelf>, AppError> {
    let catalogue = Catalogue::empty_in_memory()?;
    let shelf = CatalogueShelf { catalogue: Mutex::new(catalogue), filler: None };
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
        lock(&self.catalogue)
    }
}

fn lock(catalogue: &Mutex<Catalogue>) -> MutexGuard<'_, Catalogue> {
    // Every change is a transaction: what a panic left behind is whole.
    catalogue.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Shelf for CatalogueShelf {
    fn search(&self, query: &Query) -> Result<Found, AppError> {
        Ok(self.lock().find(query)?)
    }

    fn load(&self, product: &str, state: Option<&str>) -> Result<Arc<Dataset>, AppError> {
        let catalogue = self.lock();
        match state {
            Some(state) => Ok(catalogue.dataset(product, Some(state))?),
            None => {
                let known = catalogue.product(product)?;
                let state = known.states.get(known.representative().1);
                let state = state.ok_or_else(|| AppError::NoState(product.to_owned()))?;
                Ok(catalogue.dataset(product, Some(&state.key))?)
            }
        }
    }

    fn product(&self, product: &str) -> Result<Arc<Product>, AppError> {
        Ok(Arc::new(self.lock().product(product)?))
    }

    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        let product = self.lock().product(product).map_err(|error| StudyError::Catalogue(error.to_string()))?;
        pick_state(&Device::of(&product)?, asked)
    }

    fn next_builtin(&self) -> Result<Option<(&'static str, usize)>, AppError> {
        let Some(filler) = &self.filler else { return Ok(None) };
        let missing = lock(filler).missing_builtin()?;
        Ok(missing.first().map(|&name| (name, missing.len())))
    }

    fn put_builtin(&self, name: &str, product: NewProduct, datasets: &[Dataset]) -> Result<(), AppError> {
        Ok(lock(self.filler.as_ref().unwrap_or(&self.catalogue)).put_builtin(name, product, datasets)?)
    }

    fn add(&self, addition: &Addition) -> Result<String, AppError> {
        let datasets: Vec<Dataset> = addition.datasets.iter().map(|dataset| stored_by_default(dataset)).collect();
        Ok(self.lock().import(&datasets, addition.product.clone())?.key)
    }

    fn import_package(&self, bytes: &[u8]) -> Result<Vec<Imported>, AppError> {
        Ok(self.lock().import_package(bytes)?)
    }

    fn remove(&self, product: &str) -> Result<(), AppError> {
        Ok(self.lock().remove_product(product)?)
    }

    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), AppError> {
        Ok(self.lock().set_favourite(product, favourite)?)
    }
}

/// Files and closed forms from the study's library, products from the shelf.
struct WindowLibrary<'a> {
    files: &'a Library,
    shelf: &'a dyn Shelf,
}

impl SystemLibrary for WindowLibrary<'_> {
    fn load(&self, keys: &SystemKeys, base: &Path, need: Need) -> Result<Arc<System>, StudyError> {
        let SystemKeys::Catalogue { key, state } = keys else { return self.files.load(keys, base, need) };
        let dataset =
            self.shelf.load(key, state.as_deref()).map_err(|error| StudyError::Catalogue(error.to_string()))?;
        let very = self.files.very_of(&dataset);
        // The product's name: a dataset's own may be that of another product with the same data.
        let label = self.shelf.product(key).map_err(|error| StudyError::Catalogue(error.to_string()))?.name.clone();
        Ok(Arc::new(System { label, state: dataset.state.clone(), dataset, very }))
    }

    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        self.shelf.controlled_state(product, asked)
    }

    fn controlled_description(&self, path: &Path, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        self.files.controlled_description(path, asked)
    }
}

/// The study with its caches.
#[derive(Default)]
pub struct StudyEngine {
    session: Session,
    files: Library,
}

impl StudyEngine {
    fn scene(&self, question: &Question) -> Result<Scene, AppError> {
        let library = WindowLibrary { files: &self.files, shelf: &*question.shelf };
        Ok(Scene::resolve(&question.scene, &question.base, &library)?)
    }
}

impl Engine for StudyEngine {
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        let start = Instant::now();
        let scene = self.scene(question)?;
        let result = self.session.room(&scene, progress)?;
        Ok(RoomFigures {
            positions: result.sensors.iter().map(|sensor| sensor.sensor.position.to_array()).collect(),
            direct: result.sensors.iter().map(|sensor| sensor.direct).collect(),
            interreflected: result.sensors.iter().map(|sensor| sensor.interreflected).collect(),
            beam: result.sensors.iter().map(|sensor| sensor.beam).collect(),
            data_error: result.sensors.iter().map(|sensor| sensor.data_error).collect(),
            grid: scene.grid,
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError> {
        let start = Instant::now();
        let scene = self.scene(question)?;
        if scene.apertures.is_empty() {
            return Err(AppError::NoAperture);
        }
        let result = self.session.lid(&scene, 0, progress)?;
        let name = scene.apertures[0].system.label.clone();
        Ok(LidFigures {
            lid: result.lid,
            flux: result.flux,
            incident: Some(result.incident.0.value + result.incident.1),
            description: describe(&name, &question.scene, 0, ""),
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, AppError> {
        Ok(ladder(&self.scene(question)?, progress)?)
    }

    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, AppError> {
        let encoded = LidFormat::of(path, IesEdition::Lm63_2002)
            .and_then(|format| encode(&lid.lid, lid.description.clone(), format, None, None));
        Ok(encoded.map_err(|error| AppError::from(error).about(path.display()))?.bytes)
    }
}
