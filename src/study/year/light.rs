//! Illuminances of the steps of a year.
//!
//! Steps are grouped by the states of the moving apertures, and what the room makes of light is found once for each group.
//! Where all that comes through is known by cells or in closed form, that is coefficients for sky and sun; else every
//! step is a room of its own, with geometry and room kept by the session.

use super::direct_sun::DirectSun;
use super::fixed::{put_ordinary, with_states};
use super::settings::Settings;
use super::steps::{Step, Steps};
use crate::compute::estimate::{Cancelled, Estimate, Progress, Silent};
use crate::compute::sky::{Outside, Prepared, Sun};
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
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How the light of the steps was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Products with coefficients, prepared once for each set of states.
    Coefficients,
    /// Every step as a room.
    Rooms,
}

/// Illuminances of the chosen steps: rows of steps, columns of places, sensors first, then eyes. \[lx\]
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Sensors and eyes.
    pub places: usize,
    /// All light.
    pub values: Vec<f64>,
    /// How far that may be off.
    pub errors: Vec<f64>,
    /// Of it the sun that comes through unscattered and unreflected; `None` where nothing lets it, or nobody asks.
    pub sun: Option<Vec<f64>>,
    /// How it was found.
    pub way: Way,
    /// Sets of states that occur with light.
    pub sets: usize,
    /// Steps without light, or without people where nobody asks for these: not computed.
    pub dark: usize,
}

/// What is asked.
pub(super) struct Question<'a> {
    pub file: &'a SceneFile,
    pub base: &'a Path,
    pub library: &'a dyn SystemLibrary,
    pub session: &'a Session,
    pub settings: &'a Settings,
    pub steps: &'a Steps,
    pub moving: &'a [Moving],
}

/// Few steps are shared among threads in so many pieces.
const PIECES: usize = 16;

/// Of the chosen steps, with the states of all steps.
///
/// # Errors
/// Of the scene; cancelled.
pub(super) fn light(
    question: &Question<'_>,
    states: &[Vec<usize>],
    chosen: &[usize],
    notes: &mut Vec<String>,
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
    let mut light = Light {
        places,
        values: vec![0.0; places * chosen.len()],
        errors: vec![0.0; places * chosen.len()],
        sun: None,
        way: Way::Coefficients,
        sets: groups.len(),
        dark: chosen.len() - lit,
    };
    let done = AtomicUsize::new(0);
    for (set, rows) in groups {
        let scene = prepared(question, set)?;
        let engine = Engine::new(question, scene, rows.len(), progress)?;
        if let All::Rooms(..) = engine.all {
            light.way = Way::Rooms;
        }
        let block = |rows: &[usize]| {
            if progress.cancelled() {
                return Err(StudyError::from(Cancelled));
            }
            let hour = |&row: &usize| Ok((chosen[row], question.steps.outside(chosen[row])?));
            let found =
                engine.all(question.session, &rows.iter().map(hour).collect::<Result<Vec<_>, StudyError>>()?)?;
            progress.advance("hours", done.fetch_add(rows.len(), Ordering::Relaxed) + rows.len(), lit);
            Ok(rows.iter().copied().zip(found).collect::<Vec<_>>())
        };
        // A room takes long enough to be told, and ended, by itself.
        let together = match engine.all {
            All::Coefficients(..) => rows.len().div_ceil(PIECES).min(TOGETHER),
            All::Rooms(..) => 1,
        };
        let found: Vec<Vec<(usize, Found)>> =
            rows.par_chunks(together).map(block).collect::<Result<_, StudyError>>()?;
        for (row, found) in found.into_iter().flatten() {
            let at = row * places;
            for (place, e) in found.light.into_iter().enumerate() {
                light.values[at + place] = e.value;
                light.errors[at + place] = e.error;
            }
            if let Some(sun) = found.sun {
                let all = light.sun.get_or_insert_with(|| vec![0.0; places * chosen.len()]);
                all[at..at + places].copy_from_slice(&sun);
            }
        }
    }
    tell(&light, notes);
    Ok(light)
}

/// How the light was found, where that is out of the ordinary.
pub(super) fn tell(light: &Light, notes: &mut Vec<String>) {
    if light.way == Way::Rooms {
        notes.push("every hour was computed as a room: boxes outside are not known by coefficients".to_owned());
    }
}

/// The sun alone straight at the places in all steps, with every moving aperture in the open state of its control: rows of
/// steps, columns of places. `None` where nothing moves, nothing lets it through, or nobody asks. \[lx\]
///
/// # Errors
/// Of the scene; cancelled.
pub(super) fn retracted_sun(question: &Question<'_>, progress: &dyn Progress) -> Result<Option<Vec<f64>>, StudyError> {
    if question.moving.is_empty() || !question.settings.direct_sun {
        return Ok(None);
    }
    let open = |one: &Moving| Ok::<_, StudyError>(settings(&one.keys, &one.device, question.base)?.open);
    let set: Vec<usize> = question.moving.iter().map(open).collect::<Result<_, _>>()?;
    let all = DirectSun::new(Arc::new(prepared(question, &set)?), question.file)?;
    if !all.passes() {
        return Ok(None);
    }
    let row = |(k, step): (usize, &Step)| {
        if progress.cancelled() {
            return Err(StudyError::from(Cancelled));
        }
        // Only occupied steps are counted.
        let sun = if step.occupied && step.hour.is_lit() { question.steps.even_outside(k)?.1 } else { None };
        Ok(sun.map_or_else(|| vec![0.0; all.places()], |sun| all.at(&sun)))
    };
    let rows: Vec<Vec<f64>> = question.steps.list.par_iter().enumerate().map(row).collect::<Result<_, _>>()?;
    Ok(Some(rows.concat()))
}

/// The scene with the states of a set, eyes behind its sensors, under a sky that only says that there is light.
pub(super) fn prepared(question: &Question<'_>, set: &[usize]) -> Result<Scene, StudyError> {
    let mut file = with_states(question.file, question.moving, set);
    put_ordinary(&mut file);
    // Boxes are lit by the sky of each step.
    let mut scene = Scene::resolve(&file.without_outside(), question.base, question.library)?;
    scene.sensors.extend(&question.settings.eyes);
    scene.grid = None;
    Ok(scene)
}

/// What a step comes to.
pub(super) struct Found {
    /// At the places.
    pub light: Vec<Estimate>,
    sun: Option<Vec<f64>>,
}

/// An hour of the year, and what is outside in it.
type Hour = (usize, (Outside, Option<Sun>));

/// Ready for any sky and sun.
pub(super) struct Engine {
    all: All,
    /// Beside it the sun alone, where that is asked for and comes through.
    sun: Option<DirectSun>,
}

/// How all light is found.
enum All {
    Coefficients(Box<Coefficients>),
    Rooms(Arc<Scene>, Arc<Prepared>),
}

impl Engine {
    /// `steps`: how many will be asked for, as far as is known.
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
        if let Some(prepared) = question.session.standing(&before, &scene.outside, scene.orientation, progress)? {
            return Ok(Self { all: All::Rooms(scene, prepared), sun });
        }
        let mut coefficients = Coefficients::new(question.session, &scene, progress)?;
        let year = (question.steps.number(), question.steps.list.len());
        coefficients.keep_year(question.session, year, steps);
        Ok(Self { all: All::Coefficients(Box::new(coefficients)), sun })
    }

    /// Of one hour of the year.
    pub fn at(&self, session: &Session, hour: usize, outside: (Outside, Option<Sun>)) -> Result<Found, StudyError> {
        Ok(self.all(session, &[(hour, outside)])?.swap_remove(0))
    }

    /// Of many.
    fn all(&self, session: &Session, hours: &[Hour]) -> Result<Vec<Found>, StudyError> {
        let direct = |sun: Option<&Sun>| {
            self.sun.as_ref().map(|all| sun.map_or_else(|| vec![0.0; all.places()], |sun| all.at(sun)))
        };
        match &self.all {
            All::Coefficients(coefficients) => {
                let skies: Vec<_> = hours.iter().map(|(hour, (outside, _))| (*hour, outside)).collect();
                let whole = |(mut light, (_, (_, sun))): (Vec<Estimate>, &Hour)| {
                    if let Some(sun) = sun {
                        light.iter_mut().zip(coefficients.sun_estimate(sun)).for_each(|(sum, e)| *sum += e);
                    }
                    Found { light, sun: direct(sun.as_ref()) }
                };
                Ok(coefficients.hours_estimate(&skies).into_iter().zip(hours).map(whole).collect())
            }
            All::Rooms(scene, prepared) => {
                let hour = |(_, (outside, sun)): &Hour| {
                    let outside = prepared.under(outside, sun.as_ref());
                    let scene = Scene { outside, sun: *sun, ..Scene::clone(scene) };
                    let result = session.room(&scene, &Silent)?;
                    let light = result.sensors.iter().map(|one| one.total()).collect();
                    Ok(Found { light, sun: direct(sun.as_ref()) })
                };
                hours.iter().map(hour).collect()
            }
        }
    }
}
