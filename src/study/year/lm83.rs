//! Illuminances with blinds operated by the rule of IES LM-83-12 instead of the scene's controls, for the metric
//! `sDA300_50_LM83_12`.
//!
//! A group consists of apertures in the same surface with the same product under the same control. Its open state is
//! the one that the control chooses by day without direct sun, the most open unless `open_state` names another; its
//! closed state is that for DIN 5034, the most closed or `closed_state`. Where nothing moves, an ideally diffusing
//! shade with a transmittance of 5 % replaces the system while it is closed, which is what other programs assume by §
//! 2.2.7 for blinds that are not described. Its reflectance is `reflectance`, and zero if that is to come from the
//! dataset.
//!
//! Only those occupied lit steps are computed that the year does not already contain with exactly the same states.

use super::direct_sun::DirectSun;
use super::fixed::{put_ordinary, put_state};
use super::light::{self, Light};
use super::settings::Settings;
use super::steps::Steps;
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::sky::Sun;
use crate::compute::year::StepTable;
use crate::compute::year::blinds::{GroupSun, Worked, worked};
use crate::study::control::settings as control_settings;
use crate::study::control::year::Moving;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::scene_file::{IdealKind, SceneFile, SystemKeys};
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use crate::study::year_keys::{DaysKey, HoursKeys};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// Transmittance of the shade that closes in place of a system without movable parts, 0 … 1.
pub const SHADE: f64 = 0.05;

/// Group of apertures whose blinds are closed together.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Numbers of the apertures in the scene, from 1.
    pub apertures: Vec<usize>,
    /// Keys of the open and the closed state; `None` if nothing moves, so that the shade is used.
    pub states: Option<[String; 2]>,
    /// Index and key of the open and of the closed state of a controlled aperture, even if both are the same.
    controlled: Option<[(usize, String); 2]>,
}

/// Illuminances in the chosen steps with blinds operated by the rule of LM-83.
#[derive(Debug, Clone, PartialEq)]
pub struct Lm83 {
    /// Groups of apertures that close together.
    pub groups: Vec<Group>,
    /// Groups that are closed in each chosen step; all are open in unoccupied and in dark steps.
    pub worked: Vec<Worked>,
    /// Illuminances at the sensors (not the observers) in the chosen steps; 0 in unoccupied steps. \[lx\]
    pub values: StepTable,
    /// Estimated absolute errors of `values`. \[lx\]
    pub errors: StepTable,
}

/// Input for operating blinds by the rule of LM-83.
pub(super) struct Question<'a> {
    pub file: &'a SceneFile,
    pub base: &'a Path,
    pub library: &'a dyn SystemLibrary,
    pub session: &'a Session,
    pub settings: &'a Settings,
    pub steps: &'a Steps,
    pub moving: &'a [Moving],
    pub states: &'a [Vec<usize>],
    pub chosen: &'a [usize],
    /// Illuminances in the chosen steps with the states of the scene's controls.
    pub light: &'a Light,
}

/// Operates the blinds through the chosen steps by the rule of LM-83, and computes the illuminances with them.
///
/// # Errors
/// Returns an error if the scene is wrong, or if cancelled.
pub(super) fn lm83(
    question: &Question<'_>,
    notes: &mut Vec<String>,
    progress: &dyn Progress,
) -> Result<Lm83, StudyError> {
    let (settings, steps) = (question.settings, question.steps);
    let groups = groups(question)?;
    add_notes(question.file, settings, &groups, notes);
    let counts = |k: usize| steps.list[k].occupied && steps.list[k].hour.is_lit();
    let rows: Vec<usize> = (0..question.chosen.len()).filter(|&row| counts(question.chosen[row])).collect();
    let suns = Suns::new(question, &groups)?;
    let found: Vec<Worked> = rows
        .par_iter()
        .map(|&row| {
            if progress.cancelled() {
                return Err(StudyError::from(Cancelled));
            }
            let (_, sun) = steps.even_outside(question.chosen[row])?;
            Ok(sun.map_or_else(|| Worked::open(groups.len()), |sun| worked(&suns.at(&sun))))
        })
        .collect::<Result<_, _>>()?;
    let mut all = vec![Worked::open(groups.len()); question.chosen.len()];
    let mut sets: BTreeMap<Vec<bool>, Vec<usize>> = BTreeMap::new();
    for (&row, one) in rows.iter().zip(found) {
        sets.entry(one.closed.clone()).or_default().push(row);
        all[row] = one;
    }
    let sensors = settings.sensors;
    let [mut values, mut errors] = [(); 2].map(|()| StepTable::zeros(question.chosen.len(), sensors, rows.len()));
    let mut put = |row: usize, light: &Light, from: usize| {
        values.set(row, &light.values.row(from)[..sensors]);
        errors.set(row, &light.errors.row(from)[..sensors]);
    };
    // Observers are not needed here.
    let without_eyes = Settings { eyes: Vec::new(), ..settings.clone() };
    for (closed, rows) in sets {
        let (own, rest): (Vec<usize>, Vec<usize>) =
            rows.into_iter().partition(|&row| is_held(question, &groups, &closed, question.chosen[row]));
        own.iter().for_each(|&row| put(row, question.light, row));
        if rest.is_empty() {
            continue;
        }
        let file = with_groups(question.file, &groups, &closed);
        let asked = light::Question {
            file: &file,
            base: question.base,
            library: question.library,
            session: question.session,
            settings: &without_eyes,
            steps,
            moving: &[],
        };
        let chosen: Vec<usize> = rest.iter().map(|&row| question.chosen[row]).collect();
        let nothing = vec![Vec::new(); steps.list.len()];
        // Notes on how the light is computed are already in the year's.
        let light = light::light(&asked, &nothing, &chosen, &light::Latest::default(), progress)?;
        rest.iter().enumerate().for_each(|(from, &row)| put(row, &light, from));
    }
    Ok(Lm83 { groups, worked: all, values, errors })
}

/// Adds notes on assumptions of the standard that the scene does not meet.
fn add_notes(file: &SceneFile, settings: &Settings, groups: &[Group], notes: &mut Vec<String>) {
    if settings.keys.hours != (HoursKeys { from: 8.0, to: 18.0, days: DaysKey::All }) {
        notes.push("LM-83-12 counts 8 to 18 h of all days: here the hours of year.hours are counted".to_owned());
    }
    for group in groups.iter().filter(|group| group.states.is_none()) {
        notes.push(format!(
            "LM-83-12: nothing moves in aperture {}; while closed an even shade, τ = {SHADE}, stands in the system's place",
            numbers(&group.apertures)
        ));
    }
    if file.sensors.plane.is_none() {
        notes.push("LM-83-12 asks for a grid of analysis points: here the scene's single points are taken".to_owned());
    }
}

/// Formats numbers as a list: "1, 2".
fn numbers(list: &[usize]) -> String {
    list.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// Returns the groups of apertures that close together, with their open and closed states.
fn groups(question: &Question<'_>) -> Result<Vec<Group>, StudyError> {
    let mut list: Vec<Group> = Vec::new();
    for (index, aperture) in question.file.aperture.iter().enumerate() {
        let same = |group: &&mut Group| {
            let other = &question.file.aperture[group.apertures[0] - 1];
            (other.surface, &other.system, &other.control) == (aperture.surface, &aperture.system, &aperture.control)
        };
        if let Some(group) = list.iter_mut().find(same) {
            group.apertures.push(index + 1);
            continue;
        }
        let own = question.moving.iter().find(|one| one.aperture == index + 1);
        let controlled = own
            .map(|one| {
                let control = control_settings(&one.keys, &one.device, question.base)?;
                Ok::<_, StudyError>([control.open, control.closed].map(|state| (state, one.device.keys[state].clone())))
            })
            .transpose()?;
        let two = controlled.as_ref().filter(|[open, closed]| open.0 != closed.0);
        let states = two.map(|states| states.each_ref().map(|(_, key)| key.clone()));
        list.push(Group { apertures: vec![index + 1], states, controlled });
    }
    Ok(list)
}

/// Returns the scene with its groups open or closed, and without a year.
fn with_groups(file: &SceneFile, groups: &[Group], closed: &[bool]) -> SceneFile {
    let mut scene = SceneFile { year: None, rank: None, ..file.clone() };
    for (group, &closed) in groups.iter().zip(closed) {
        for &number in &group.apertures {
            let system = &mut scene.aperture[number - 1].system;
            if closed && group.states.is_none() {
                *system = SystemKeys::Ideal { kind: IdealKind::Diffuse, transmittance: SHADE };
            } else if let Some(states) = &group.controlled {
                put_state(system, &states[usize::from(closed)].1);
            }
        }
    }
    scene
}

/// Whether the year already contains a step with exactly these states.
fn is_held(question: &Question<'_>, groups: &[Group], closed: &[bool], step: usize) -> bool {
    groups.iter().zip(closed).all(|(group, &closed)| {
        if closed && group.states.is_none() {
            return false;
        }
        let Some(states) = &group.controlled else { return true };
        group.apertures.iter().all(|number| {
            let m = question.moving.iter().position(|one| one.aperture == *number);
            m.is_some_and(|m| question.states[step][m] == states[usize::from(closed)].0)
        })
    })
}

/// Scenes with all groups open and with all groups closed, for the direct sun at the sensors.
struct Suns<'a> {
    groups: &'a [Group],
    scenes: [DirectSun; 2],
}

impl<'a> Suns<'a> {
    fn new(question: &Question<'_>, groups: &'a [Group]) -> Result<Self, StudyError> {
        let scene = |closed: bool| {
            let mut file = with_groups(question.file, groups, &vec![closed; groups.len()]);
            put_ordinary(&mut file);
            let scene = Scene::resolve(&file.without_outside(), question.base, question.library)?;
            DirectSun::new(Arc::new(scene), question.file)
        };
        Ok(Self { groups, scenes: [scene(false)?, scene(true)?] })
    }

    /// Returns the illuminance by direct sun through every group at all sensors, open and closed. \[lx\]
    fn at(&self, sun: &Sun) -> Vec<GroupSun> {
        let [open, closed] = self.scenes.each_ref().map(|scene| scene.by_aperture(sun));
        let sum = |apertures: &[usize], list: &[Vec<Estimate>]| {
            let mut sums = vec![Estimate::default(); self.scenes[0].places()];
            for number in apertures {
                sums.iter_mut().zip(&list[number - 1]).for_each(|(sum, e)| *sum += *e);
            }
            sums
        };
        let of =
            |group: &Group| GroupSun { open: sum(&group.apertures, &open), closed: sum(&group.apertures, &closed) };
        self.groups.iter().map(of).collect()
    }
}
