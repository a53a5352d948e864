//! Implementations of the window's interfaces by the real program: catalogue file, computations of the study, luminaire
//! files.

use crate::app::catalogue::library::WindowLibrary;
use crate::app::catalogue::shelf::{Addition, Found, Query, Shelf};
use crate::app::catalogue::state_queue::StateQueue;
use crate::app::results::engine::{Engine, LidFigures, Question, RoomFigures, SurfaceFigures, subject};
use crate::app::shell::error::AppError;
use crate::catalogue::{
    Catalogue, Collection, Deleted, Event, Known, NewProduct, Product, Replacement, Snapshot, StateKey, StateName,
    Stored, Subscription, Words, default_path,
};
use crate::compute::btdf::{Btdf, Dataset, Indicatrices};
use crate::compute::direction::Incident;
use crate::compute::estimate::{Progress, Silent};
use crate::compute::lid::Interpolator;
use crate::study::accuracy::{Accuracy, ladder};
use crate::study::builtin;
use crate::study::compact::stored_by_default;
use crate::study::control::{ControlQuestion, Device, pick_state};
use crate::study::goniophotometer::Withdrawn;
use crate::study::luminaire_file::{LidFormat, describe, encode};
use crate::study::luminaire_set::{LuminaireOptions, LuminaireSet, make, tile_name};
use crate::study::rank::{Answer, Group, Item, Stage, run as rank};
use crate::study::subject::{Subject, Wanted};
use crate::study::subscriptions::{Report, sync};
use crate::study::year::{Annual, year};
use crate::study::{Library, Scene, Session, Store, StudyError};
use crate::texts::shell;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Catalogue file, accessed by one request at a time.
struct CatalogueShelf {
    catalogue: Mutex<Catalogue>,
    /// Separate connection for data that are computed in the background, so that compressing and writing them does not
    /// block readers; `None` without such computations.
    filler: Option<Mutex<Catalogue>>,
    /// Queue of the requests for states that have to be computed first.
    queue: StateQueue,
    /// States whose computation has failed; each is tried only once.
    failing: Mutex<Vec<StateKey>>,
}

impl CatalogueShelf {
    fn new(catalogue: Mutex<Catalogue>, filler: Option<Mutex<Catalogue>>) -> Self {
        Self { catalogue, filler, queue: StateQueue::default(), failing: Mutex::default() }
    }
}

/// Opens a catalogue file, or the user's default catalogue if `path` is `None`.
pub fn open_shelf(path: Option<&Path>) -> Result<Arc<dyn Shelf>, AppError> {
    let path = path.map_or_else(default_path, |path| Ok(path.to_owned()))?;
    let open = || Catalogue::open(&path).map(Mutex::new);
    Ok(Arc::new(CatalogueShelf::new(open()?, Some(open()?))))
}

/// Creates a catalogue in memory with the built-in products.
pub fn memory_shelf() -> Result<Arc<dyn Shelf>, AppError> {
    Ok(Arc::new(CatalogueShelf::new(Mutex::new(Catalogue::in_memory()?), None)))
}

/// Creates a catalogue in memory with only the two ideal systems (clear and Lambertian), the references of comparisons.
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

    /// Returns the given state, or the representative state of the product if none is given.
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
        let state = self.state_or_own(product, state)?;
        let is_there = || Ok(self.lock().to_compute(product, Some(&state))?.is_none());
        let compute = || {
            let product = self.lock().product(product)?;
            let dataset = builtin::compute(&product, &state, &Library::default(), progress)?;
            Ok(self.lock().keep_state(&product, &dataset)?)
        };
        self.queue.once(progress, is_there, compute)
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
        let (waiting, all) = {
            let mut filler = lock(filler);
            // Of what older programs stored it may not be known where light goes; found out once, it is nothing to do.
            filler.fill_figures(progress)?;
            let (mut waiting, all) = (filler.waiting()?, filler.builtin_states()?);
            let before = waiting.len();
            waiting.retain(|one| !self.failing.lock().unwrap_or_else(PoisonError::into_inner).contains(one));
            let mut products = BTreeMap::new();
            for one in &waiting {
                if !products.contains_key(&one.product) {
                    products.insert(one.product.clone(), filler.product(&one.product)?);
                }
            }
            waiting
                .retain(|one| order.first() == Some(&one.product) || products[&one.product].may_represent(&one.state));
            let all = all - (before - waiting.len());
            (waiting, all)
        };
        let place = |one: &StateKey| order.iter().position(|key| *key == one.product).unwrap_or(order.len());
        // The first of equals stays first, as the catalogue has them.
        let Some(one) = waiting.iter().min_by_key(|one| place(one)) else { return Ok([0, all]) };
        progress.advance("computing", all.saturating_sub(waiting.len()), all);
        // Not through the queue: who waits in it would wait for a computation that pauses while somebody waits.
        let withdrawn = Withdrawn(progress);
        let product = lock(filler).product(&one.product)?;
        let dataset = builtin::compute(&product, &one.state, &Library::default(), &withdrawn).map_err(|error| {
            if !progress.cancelled() {
                self.failing.lock().unwrap_or_else(PoisonError::into_inner).push(one.clone());
            }
            AppError::from(error).about(shell::product_in_state(&one.product, &one.state))
        })?;
        lock(filler).put_state(&product, &dataset)?;
        Ok([waiting.len() - 1, all])
    }

    fn add(&self, addition: &Addition) -> Result<String, AppError> {
        let datasets: Vec<Dataset> = addition.datasets.iter().map(|dataset| stored_by_default(dataset)).collect();
        Ok(self.lock().import(&datasets, addition.product.clone())?.key)
    }

    fn add_all(&self, additions: &[Addition]) -> Result<Vec<Stored>, AppError> {
        // What takes time is done before the catalogue is locked.
        let products = additions.iter().map(|one| {
            let datasets: Vec<Dataset> = one.datasets.par_iter().map(|dataset| stored_by_default(dataset)).collect();
            (datasets, one.product.clone())
        });
        let products = products.collect();
        Ok(self.lock().import_all(products)?)
    }

    fn remove_all(&self, products: &[String]) -> Result<(), AppError> {
        Ok(self.lock().remove_products(products)?)
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

    fn products_holding(&self, content: &str) -> Result<Vec<Known>, AppError> {
        Ok(self.lock().products_holding(content)?)
    }

    fn history(&self, product: &str) -> Result<Vec<Event>, AppError> {
        Ok(self.lock().history(product)?)
    }

    fn source_paths(&self, product: &str) -> Result<Vec<String>, AppError> {
        Ok(self.lock().source_paths(product)?)
    }

    fn snapshot(&self, product: &str) -> Result<Snapshot, AppError> {
        Ok(self.lock().snapshot(product)?)
    }

    fn put_back(&self, snapshot: &Snapshot) -> Result<(), AppError> {
        Ok(self.lock().put_back(snapshot)?)
    }

    fn name_states(&self, product: &str, names: &[StateName]) -> Result<(), AppError> {
        Ok(self.lock().name_states(product, names)?)
    }

    fn replace_states(&self, product: &str, list: &[Replacement]) -> Result<(), AppError> {
        let kept = |one: &Replacement| Replacement { dataset: stored_by_default(&one.dataset), ..one.clone() };
        let list: Vec<Replacement> = list.iter().map(kept).collect();
        Ok(self.lock().replace_states(product, &list)?)
    }

    fn subscribed_folder(&self, product: &str) -> Result<Option<String>, AppError> {
        Ok(self.lock().subscribed_folder(product)?)
    }

    fn collections(&self) -> Result<Vec<Collection>, AppError> {
        Ok(self.lock().collections()?)
    }

    fn collect(&self, name: &str, products: &[String], put: bool) -> Result<(), AppError> {
        Ok(self.lock().collect(name, products, put)?)
    }

    fn subscriptions(&self) -> Result<Vec<Subscription>, AppError> {
        Ok(self.lock().subscriptions()?)
    }

    fn subscribe(&self, folder: &str) -> Result<(), AppError> {
        Ok(self.lock().subscribe(folder)?)
    }

    fn unsubscribe(&self, folder: &str) -> Result<usize, AppError> {
        Ok(self.lock().unsubscribe(folder)?)
    }

    fn sync(&self, progress: &dyn Progress) -> Result<Report, AppError> {
        // A folder on a slow share keeps nobody from reading the catalogue.
        Ok(sync(&mut lock(self.filler.as_ref().unwrap_or(&self.catalogue)), progress)?)
    }

    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), AppError> {
        Ok(self.lock().set_favourite(product, favourite)?)
    }
}

/// Engine of the window that computes by the study, with one store for the results of its sessions.
pub struct StudyEngine {
    store: Arc<Store>,
    session: Session,
    /// Session for rankings, which solve a room once for all products.
    ranking: Session,
    files: Arc<Library>,
}

impl Default for StudyEngine {
    fn default() -> Self {
        Self::new(Arc::default())
    }
}

impl StudyEngine {
    /// Creates an engine that reads dataset files, and catalogue products used as layers, from the library `files`.
    pub fn new(files: Arc<Library>) -> Self {
        let store = Arc::new(Store::new(usize::MAX));
        let session = || Session::storing(&store);
        Self { session: session(), ranking: session().passing(), store, files }
    }

    fn scene(&self, question: &Question, progress: &dyn Progress) -> Result<Scene, AppError> {
        let library = WindowLibrary { files: &self.files, shelf: &*question.shelf, progress };
        Ok(Scene::resolve_within(&question.scene, &question.base, &library, progress)?)
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
            outside: result.outside,
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
            description: describe(&name, &question.scene, &question.base, 0, ""),
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    fn subject(
        &self,
        question: &Question,
        incident: Option<Incident>,
        wanted: Wanted,
        progress: &dyn Progress,
    ) -> Result<Subject, AppError> {
        subject(question, incident, wanted, (&self.session, &*self.files), progress)
    }

    fn year(&self, question: &Question, progress: &dyn Progress) -> Result<Annual, AppError> {
        let library = WindowLibrary { files: &self.files, shelf: &*question.shelf, progress };
        let year = year(&question.scene, &question.base, &library, &self.session, &|_| true, progress)?;
        Ok(Annual::new(&question.scene, year))
    }

    fn rank(
        &self,
        groups: &[Group],
        items: &[Item],
        shelf: &dyn Shelf,
        report: &(dyn Fn(Answer<'_>) + Sync),
        progress: &dyn Progress,
    ) -> Result<(), AppError> {
        let library = WindowLibrary { files: &self.files, shelf, progress };
        rank(groups, items, &library, &self.ranking, &[Stage::Coarse, Stage::Full], report, progress)?;
        Ok(())
    }

    fn store(&self) -> Option<&Store> {
        Some(&self.store)
    }

    fn interpolator(&self, data: &Arc<Indicatrices>) -> Arc<Interpolator> {
        self.session.interpolator(data)
    }

    fn accuracy(&self, question: &Question, progress: &dyn Progress) -> Result<Accuracy, AppError> {
        Ok(ladder(&self.scene(question, progress)?, progress)?)
    }

    fn luminaire(&self, lid: &LidFigures, path: &Path) -> Result<Vec<u8>, AppError> {
        let encoded =
            LidFormat::of(path).and_then(|format| encode(&lid.lid, lid.description.clone(), format, None, None));
        Ok(encoded.map_err(|error| AppError::from(error).about(path.display()))?.bytes)
    }

    fn luminaires(
        &self,
        question: &Question,
        options: &LuminaireOptions,
        path: &Path,
        progress: &dyn Progress,
    ) -> Result<LuminaireSet, AppError> {
        let scene = self.scene(question, progress)?;
        let first = scene.apertures.first().ok_or(AppError::NoAperture)?;
        let text = describe(&first.system.label, &question.scene, &question.base, 0, "");
        Ok(make(&self.session, &scene, 0, &text, options, |tile| tile_name(path, tile), progress)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    #[test]
    fn a_panic_that_holds_the_catalogue_does_it_no_harm() {
        let shelf = CatalogueShelf::new(Mutex::new(Catalogue::in_memory().unwrap()), None);
        let before = shelf.search(&Query::default()).unwrap().total;
        let panic = catch_unwind(AssertUnwindSafe(|| {
            let _held = shelf.lock();
            panic!("while it is held");
        }));
        assert!(panic.is_err() && shelf.catalogue.is_poisoned());
        assert_eq!(shelf.search(&Query::default()).unwrap().total, before);
        let key = shelf.search(&Query::default()).unwrap().entries[0].key.clone();
        shelf.set_favourite(&key, true).unwrap();
    }
}
