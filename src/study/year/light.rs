//! Illuminances in the steps of a year.
//!
//! Steps are grouped by the states of the moving apertures, and the daylight coefficients of the room are computed once
//! for each group.

use super::direct_sun::DirectSun;
use super::fixed::{put_ordinary, with_states};
use super::settings::Settings;
use super::steps::Steps;
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::sky::{Outside, Sun};
use crate::compute::year::StepTable;
use crate::study::coefficients::{Coefficients, TOGETHER};
use crate::study::control::settings;
use crate::study::control::year::Moving;
use crate::study::error::StudyError;
use crate::study::outside::Before;
use crate::study::scene::Scene;
use crate::study::scene_file::SceneFile;
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Illuminances in the chosen steps: rows of steps, columns of places, first the sensors, then the observers. \[lx\]
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Number of places: sensors and observers together.
    pub places: usize,
    /// Total illuminances, direct and interreflected. \[lx\]
    pub values: StepTable,
    /// Estimated absolute errors of `values`. \[lx\]
    pub errors: StepTable,
    /// Illuminances by sunlight that arrives unscattered and unreflected, which are part of `values`; `None` if nothing
    /// transmits it, or if not requested. \[lx\]
    pub sun: Option<StepTable>,
    /// Number of different combinations of states that occur in steps with light.
    pub sets: usize,
    /// Number of chosen steps that are not computed, because they are dark, or unoccupied if only occupied steps are
    /// requested.
    pub dark: usize,
}

impl Light {
    /// Creates illuminances of zero for `steps` chosen steps, `lit` of which are set later. `sets`: number of different
    /// combinations of states that occur in these.
    pub(crate) fn zeros(steps: usize, places: usize, lit: usize, sets: usize) -> Self {
        let zeros = || StepTable::zeros(steps, places, lit);
        Self { places, values: zeros(), errors: zeros(), sun: None, sets, dark: steps - lit }
    }

    /// Sets the illuminances in a chosen step (`row`: its index among them) with their errors. `sun`: those by direct
    /// sun alone; `None` if nothing transmits it, or if not requested.
    pub(super) fn put(&mut self, row: usize, values: &[f64], errors: &[f64], sun: Option<&[f64]>) {
        self.values.set(row, values);
        self.errors.set(row, errors);
        if let Some(sun) = sun {
            let (steps, places, lit) = (self.values.steps(), self.places, self.values.steps() - self.dark);
            self.sun.get_or_insert_with(|| StepTable::zeros(steps, places, lit)).set(row, sun);
        }
    }
}

/// Input for the illuminances of a year.
pub(super) struct Question<'a> {
    pub file: &'a SceneFile,
    pub base: &'a Path,
    pub library: &'a dyn SystemLibrary,
    pub session: &'a Session,
    pub settings: &'a Settings,
    pub steps: &'a Steps,
    pub moving: &'a [Moving],
}

/// Number of blocks into which few steps are divided among threads.
const PIECES: usize = 16;

/// Progress that counts the steps of all sets and blocks together.
pub(super) struct Counted<'a> {
    pub inner: &'a dyn Progress,
    /// Number of steps finished before.
    pub before: usize,
    /// Number of all steps.
    pub all: usize,
}

impl Progress for Counted<'_> {
    fn advance(&self, stage: &'static str, done: usize, total: usize) {
        match stage {
            "hours" => self.inner.advance(stage, self.before + done, self.all),
            _ => self.inner.advance(stage, done, total),
        }
    }

    fn cancelled(&self) -> bool {
        self.inner.cancelled()
    }
}

/// The computation that [`light`] has prepared last in a climate, in use until the next is prepared: thus the light of
/// the year that both need stays in the session's store, however small its limit is.
#[derive(Clone, Default)]
pub(super) struct Latest(Arc<Mutex<Option<Arc<Engine>>>>);

/// Computes the illuminances in the chosen steps. `states`: states of the moving apertures in all steps; `chosen`:
/// indices of the steps.
///
/// # Errors
/// Returns an error if the scene is wrong, or if cancelled.
pub(super) fn light(
    question: &Question<'_>,
    states: &[Vec<usize>],
    chosen: &[usize],
    latest: &Latest,
    progress: &dyn Progress,
) -> Result<Light, StudyError> {
    let places = question.settings.sensors + question.settings.eyes.len();
    let mut groups: BTreeMap<&[usize], Vec<usize>> = BTreeMap::new();
    for (row, &k) in chosen.iter().enumerate() {
        if question.settings.asks(&question.steps.list[k]) {
            groups.entry(&states[k]).or_default().push(row);
        }
    }
    let lit: usize = groups.values().map(Vec::len).sum();
    let mut light = Light::zeros(chosen.len(), places, lit, groups.len());
    let mut done = 0;
    for (set, rows) in groups {
        let engine = Arc::new(Engine::new(question, prepared(question, set)?, rows.len(), progress)?);
        let before = latest.0.lock().unwrap_or_else(PoisonError::into_inner).replace(Arc::clone(&engine));
        // Without holding the lock.
        drop(before);
        let steps: Vec<usize> = rows.iter().map(|&row| chosen[row]).collect();
        let put = |index: usize, found: Found| {
            let (values, errors): (Vec<f64>, Vec<f64>) = found.light.iter().map(|e| (e.value, e.error)).unzip();
            light.put(rows[index], &values, &errors, found.sun.as_deref());
        };
        engine.steps(question, &steps, put, &Counted { inner: progress, before: done, all: lit })?;
        done += rows.len();
    }
    Ok(light)
}

/// Computes the illuminance by direct sun alone at all places in all steps, with every moving aperture in the open
/// state of its control: rows of steps, columns of places. Returns `None` if nothing moves, nothing transmits direct
/// sun, or if not requested. \[lx\]
///
/// # Errors
/// Returns an error if the scene is wrong, or if cancelled.
pub(super) fn retracted_sun(question: &Question<'_>, progress: &dyn Progress) -> Result<Option<StepTable>, StudyError> {
    if question.moving.is_empty() || !question.settings.direct_sun {
        return Ok(None);
    }
    let open = |one: &Moving| Ok::<_, StudyError>(settings(&one.keys, &one.device, question.base)?.open);
    let set: Vec<usize> = question.moving.iter().map(open).collect::<Result<_, _>>()?;
    let all = DirectSun::new(Arc::new(prepared(question, &set)?), question.file)?;
    if !all.passes() {
        return Ok(None);
    }
    let list = &question.steps.list;
    // Only occupied steps are counted.
    let counts: Vec<usize> = (0..list.len()).filter(|&k| list[k].occupied && list[k].hour.is_lit()).collect();
    let table = Mutex::new(StepTable::zeros(list.len(), all.places(), counts.len()));
    counts.par_iter().try_for_each(|&k| {
        if progress.cancelled() {
            return Err(StudyError::from(Cancelled));
        }
        if let Some(sun) = question.steps.even_outside(k)?.1 {
            let found = all.at(&sun);
            table.lock().unwrap_or_else(PoisonError::into_inner).set(k, &found);
        }
        Ok(())
    })?;
    Ok(Some(table.into_inner().unwrap_or_else(PoisonError::into_inner)))
}

/// Returns the scene with the moving apertures in one combination of states, with the observers appended to its
/// sensors, under a sky that stands for those of the year.
pub(super) fn prepared(question: &Question<'_>, set: &[usize]) -> Result<Scene, StudyError> {
    let mut file = with_states(question.file, question.moving, set);
    put_ordinary(&mut file);
    // Boxes are lit by the sky of each step.
    let mut scene = Scene::resolve(&file.without_outside(), question.base, question.library)?;
    scene.sensors.extend(&question.settings.eyes);
    scene.grid = None;
    Ok(scene)
}

/// Illuminances in one step.
pub(super) struct Found {
    /// Total illuminances at the places, sensors first, then observers. \[lx\]
    pub light: Vec<Estimate>,
    /// Illuminance by direct sun alone, if it is requested and transmitted. \[lx\]
    pub sun: Option<Vec<f64>>,
}

/// Index of a step of the year, with its outside and sun.
type Hour = (usize, (Outside, Option<Sun>));

/// Computation of illuminances under any sky and sun, with the moving apertures in one combination of states.
pub(super) struct Engine {
    coefficients: Coefficients,
    /// Illuminances by direct sun alone; `None` if not requested, or if nothing transmits it.
    sun: Option<DirectSun>,
}

impl Engine {
    /// Creates the computation for a scene with fixed states. `steps`: expected number of steps, 0 if not known.
    pub fn new(
        question: &Question<'_>,
        scene: Scene,
        steps: usize,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let scene = Arc::new(scene);
        let sun = DirectSun::new(Arc::clone(&scene), question.file)?;
        let sun = Some(sun).filter(|sun| question.settings.direct_sun && sun.passes());
        let before = Before::of(
            question.file,
            &scene.room,
            &scene.apertures.iter().map(|one| one.aperture).collect::<Vec<_>>(),
        )?;
        let prepared = question.session.standing(&before, &scene.outside, scene.orientation, progress)?;
        if let Some(prepared) = &prepared {
            let mut grounds = BTreeSet::new();
            for step in 0..question.steps.list.len() {
                if grounds.insert(question.steps.ground(step).to_bits()) {
                    prepared.prepare_ground(&question.steps.outside(step)?.0);
                }
            }
        }
        let mut coefficients = Coefficients::past(question.session, &scene, prepared.as_ref(), progress)?;
        let year = (question.steps.number(), question.steps.list.len());
        coefficients.keep_year(question.session, year, steps);
        Ok(Self { coefficients, sun })
    }

    /// Computes the illuminances in one step of the year. `hour`: index of the step; `outside`: outside and sun.
    pub fn at(&self, hour: usize, outside: (Outside, Option<Sun>)) -> Found {
        self.all(&[(hour, outside)]).swap_remove(0)
    }

    /// Computes steps of the year in parallel. `put`: takes the index of a step in `steps` and its illuminances, as soon
    /// as they are found; those of all steps would take as much memory again as the tables that they end in.
    ///
    /// # Errors
    /// Returns an error if the weather of a step is wrong, or if cancelled.
    pub fn steps(
        &self,
        question: &Question<'_>,
        steps: &[usize],
        put: impl FnMut(usize, Found) + Send,
        progress: &dyn Progress,
    ) -> Result<(), StudyError> {
        let together = steps.len().div_ceil(PIECES).clamp(1, TOGETHER);
        let done = AtomicUsize::new(0);
        let put = Mutex::new(put);
        let block = |(number, block): (usize, &[usize])| {
            if progress.cancelled() {
                return Err(StudyError::from(Cancelled));
            }
            let hour = |&step: &usize| Ok((step, question.steps.outside(step)?));
            let found = self.all(&block.iter().map(hour).collect::<Result<Vec<_>, StudyError>>()?);
            let mut put = put.lock().unwrap_or_else(PoisonError::into_inner);
            found.into_iter().enumerate().for_each(|(k, found)| put(number * together + k, found));
            drop(put);
            progress.advance("hours", done.fetch_add(block.len(), Ordering::Relaxed) + block.len(), steps.len());
            Ok(())
        };
        steps.par_chunks(together).enumerate().try_for_each(block)
    }

    /// Computes the illuminances in several steps of the year together.
    fn all(&self, hours: &[Hour]) -> Vec<Found> {
        let direct = |sun: Option<&Sun>| {
            self.sun.as_ref().map(|all| sun.map_or_else(|| vec![0.0; all.places()], |sun| all.at(sun)))
        };
        let skies: Vec<_> = hours.iter().map(|(hour, (outside, sun))| (*hour, outside, sun.as_ref())).collect();
        let whole = |(mut light, (hour, (_, sun))): (Vec<Estimate>, &Hour)| {
            if let Some(sun) = sun {
                light.iter_mut().zip(self.coefficients.hour_sun_estimate(*hour, sun)).for_each(|(sum, e)| *sum += e);
            }
            Found { light, sun: direct(sun.as_ref()) }
        };
        self.coefficients.hours_estimate(&skies).into_iter().zip(hours).map(whole).collect()
    }
}
