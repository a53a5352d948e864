//! The window's services as they are in earnest: the catalogue's file, the study, luminaire files.

use super::at_work::AtWork;
use super::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures};
use super::error::AppError;
use super::shelf::{Addition, Found, Query, Shelf};
use crate::catalogue::{Catalogue, Deleted, Imported, Known, NewProduct, Product, StateKey, Words, default_path};
use crate::compute::btdf::{Btdf, Dataset};
use crate::compute::estimate::{Progress, Silent};
use crate::formats::ies::IesEdition;
use crate::study::accuracy::{Accuracy, ladder};
use crate::study::builtin;
use crate::study::compact::stored_by_default;
use crate::study::control::{ControlQuestion, Device, pick_state};
use crate::study::goniophotometer::Withdrawn;
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
    /// A connection of its own for what is filled in behind everything else, if that is to be done: packing and writing it
    /// keeps nobody from reading.
    filler: Option<Mutex<Catalogue>>,
    /// States that are being computed because somebody waits for them.
    at_work: AtWork,
    /// States that cannot be computed: tried once.
    failing: Mutex<Vec<StateKey>>,
}

impl CatalogueShelf {
    fn new(catalogue: Mutex<Catalogue>, filler: Option<Mutex<Catalogue>>) -> Self {
        Self { catalogue, filler, at_work: AtWork::default(), failing: Mutex::default() }
    }
}

/// Opens a catalogue's file, or the user's own.
pub fn open_shelf(path: Option<&Path>) -> Result<Arc<dyn Shelf>, AppError> {
    let path = path.map_or_else(default_path, |path| Ok(path.to_owned()))?;
    let open = || Catalogue::open(&path).map(Mutex::new);
    Ok(Arc::new(CatalogueShelf::new(open()?, Some(open()?))))
}

/// A new catalogue in memory with the built-in products.
pub fn memory_shelf() -> Result<Arc<dyn Shelf>, AppError> {
    Ok(Arc::new(CatalogueShelf::new(Mutex::new(Catalogue::in_memory()?), None)))
}

/// A catalogue in memory with nothing but the two ideal systems that every comparison starts from.
pub fn ideals_shelf() -> Result<Arc<dyn Shelf>, AppError> {
    let shelf = CatalogueShelf::new(Mutex::new(Catalogue::empty_in_memory()?), None);
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

    /// The state that is meant where none is named: the one that stands for the product.
    fn state_or_own(&self, product: &str, state: Option<&str>) -> Result<String, AppError> {
        if let Some(state) = state {
            return Ok(state.to_owned());
        }
        let known = self.lock().product(product)?;
        let own = known.states.get(known.representative().1);
        Ok(own.ok_or_else(|| AppError::NoState(product.to_owned()))?.key.clone())
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
        let state = self.state_or_own(product, state)?;
        self.provide(product, Some(&state), &Silent)?;
        Ok(self.lock().dataset(product, Some(&state))?)
    }

    fn is_ready(&self, product: &str, state: Option<&str>) -> Result<bool, AppError> {
        let state = self.state_or_own(product, state)?;
        Ok(self.lock().to_compute(product, Some(&state))?.is_none())
    }

    fn provide(&self, product: &str, state: Option<&str>, progress: &dyn Progress) -> Result<(), AppError> {
        let one = StateKey { product: product.to_owned(), state: self.state_or_own(product, state)? };
        let is_there = || Ok(self.lock().to_compute(product, Some(&one.state))?.is_none());
        let compute = || {
            let product = self.lock().product(product)?;
            let dataset = builtin::compute(&product, &one.state, &Library::default(), progress)?;
            Ok(self.lock().put_state(&product, &dataset)?)
        };
        self.at_work.once(&one, progress, is_there, compute)
    }

    fn product(&self, product: &str) -> Result<Arc<Product>, AppError> {
        Ok(Arc::new(self.lock().product(product)?))
    }

    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        let product = self.lock().product(product).map_err(|error| StudyError::Catalogue(error.to_string()))?;
        pick_state(&Device::of(&product)?, asked)
    }

    fn fill_one(&self, order: &[String], progress: &dyn Progress) -> Result<[usize; 2], AppError> {
        let Some(filler) = &self.filler else { return Ok([0; 2]) };
        let (mut waiting, all) = {
            let mut filler = lock(filler);
            // Of what older programs stored it may not be known where light goes; found out once, it is nothing to do.
            filler.fill_figures(progress)?;
            (filler.waiting()?, filler.builtin_states()?)
        };
        waiting.retain(|one| !self.failing.lock().unwrap_or_else(PoisonError::into_inner).contains(one));
        let place = |one: &StateKey| order.iter().position(|key| *key == one.product).unwrap_or(order.len());
        // The first of equals stays first, as the catalogue has them.
        let Some(one) = waiting.iter().min_by_key(|one| place(one)) else { return Ok([0, all]) };
        progress.advance("computing", all.saturating_sub(waiting.len()), all);
        // Not by way of `at_work`: who waits for this state would wait for one who rests while somebody waits.
        let withdrawn = Withdrawn(progress);
        let product = lock(filler).product(&one.product)?;
        let dataset = builtin::compute(&product, &one.state, &Library::default(), &withdrawn).map_err(|error| {
            if !progress.cancelled() {
                self.failing.lock().unwrap_or_else(PoisonError::into_inner).push(one.clone());
            }
            AppError::from(error).about(format_args!("{}, state {}", one.product, one.state))
        })?;
        lock(filler).put_state(&product, &dataset)?;
        Ok([waiting.len() - 1, all])
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

    fn describe(&self, product: &str, words: &Words) -> Result<(), AppError> {
        Ok(self.lock().describe(product, words)?)
    }

    fn delete(&self, product: &str) -> Result<(), AppError> {
        Ok(self.lock().delete_product(product)?)
    }

    fn restore(&self, product: &str) -> Result<(), AppError> {
        Ok(self.lock().restore_product(product)?)
    }

    fn deleted(&self) -> Result<Vec<Deleted>, AppError> {
        Ok(self.lock().deleted_products()?)
    }

    fn products_from(&self, source_hash: &str) -> Result<Vec<Known>, AppError> {
        Ok(self.lock().products_from(source_hash)?)
    }

    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), AppError> {
        Ok(self.lock().set_favourite(product, favourite)?)
    }
}

/// Files and closed forms from the study's library, products from the shelf.
struct WindowLibrary<'a> {
    files: &'a Library,
    shelf: &'a dyn Shelf,
    progress: &'a dyn Progress,
}

impl SystemLibrary for WindowLibrary<'_> {
    fn load(&self, keys: &SystemKeys, base: &Path, need: Need) -> Result<Arc<System>, StudyError> {
        let SystemKeys::Catalogue { key, state } = keys else { return self.files.load(keys, base, need) };
        let told = |error: AppError| match error {
            AppError::Study(error) => error,
            other => StudyError::Catalogue(other.to_string()),
        };
        self.shelf.provide(key, state.as_deref(), self.progress).map_err(told)?;
        let dataset = self.shelf.load(key, state.as_deref()).map_err(told)?;
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
    files: Arc<Library>,
}

impl StudyEngine {
    /// Files that systems name, and the catalogue that their layers name, are of this library.
    pub fn new(files: Arc<Library>) -> Self {
        Self { session: Session::default(), files }
    }

    fn scene(&self, question: &Question, progress: &dyn Progress) -> Result<Scene, AppError> {
        let library = WindowLibrary { files: &self.files, shelf: &*question.shelf, progress };
        Ok(Scene::resolve(&question.scene, &question.base, &library)?)
    }
}

impl Engine for StudyEngine {
    fn room(&self, question: &Question, progress: &dyn Progress) -> Result<RoomFigures, AppError> {
        let start = Instant::now();
        let scene = self.scene(question, progress)?;
        let result = self.session.room(&scene, progress)?;
        Ok(RoomFigures {
            positions: result.sensors.iter().map(|sensor| sensor.sensor.position.to_array()).collect(),
            direct: result.sensors.iter().map(|sensor| sensor.direct).collect(),
            interreflected: result.sensors.iter().map(|sensor| sensor.interreflected).collect(),
            beam: result.sensors.iter().map(|sensor| sensor.beam).collect(),
            data_error: result.sensors.iter().map(|sensor| sensor.data_error).collect(),
            grid: scene.grid,
            coarse: false,
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    fn surfaces(&self, question: &Question, progress: &dyn Progress) -> Result<SurfaceFigures, AppError> {
        let start = Instant::now();
        let light = self.session.surfaces(&self.scene(question, progress)?, progress)?;
        Ok(SurfaceFigures { light, seconds: start.elapsed().as_secs_f64() })
    }

    fn lid(&self, question: &Question, progress: &dyn Progress) -> Result<LidFigures, AppError> {
        let start = Instant::now();
        let scene = self.scene(question, progress)?;
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
        Ok(ladder(&self.scene(question, progress)?, progress)?)
    }

    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, AppError> {
        let encoded = LidFormat::of(path, IesEdition::Lm63_2002)
            .and_then(|format| encode(&lid.lid, lid.description.clone(), format, None, None));
        Ok(encoded.map_err(|error| AppError::from(error).about(path.display()))?.bytes)
    }
}
