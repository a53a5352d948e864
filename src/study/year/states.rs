//! States of every moving aperture in every step of a year: the controls are stepped through it with sun and sky of the
//! weather file.

use super::indoor::{Indoor, Reader, sensors};
use super::light;
use super::settings::Settings;
use super::steps::Steps;
use crate::compute::angle::Bearing;
use crate::compute::control::controller::{Controller, Inputs};
use crate::compute::direction::Orientation;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::lid::Facing;
use crate::formats::state_table::of_year;
use crate::study::control::table::begun;
use crate::study::control::year::{CONTROLLED, Moving, moving};
use crate::study::control::{inputs, settings as control_settings};
use crate::study::error::StudyError;
use crate::study::outside::Before;
use crate::study::scene_file::{SceneFile, SystemKeys};
use crate::study::scene_places::{apertures, room};
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use std::path::Path;
use std::sync::Arc;

/// States that the controls have chosen over a year.
#[derive(Default)]
pub(super) struct States {
    /// Apertures whose state a control chooses.
    pub moving: Vec<Moving>,
    /// Indices of the states, by step and moving aperture.
    pub list: Vec<Vec<usize>>,
    /// Number of state changes of each moving aperture.
    pub movements: Vec<usize>,
    /// Summary of the readings of the room's sensors; `None` if no control reads them.
    pub indoor: Option<Indoor>,
}

/// Input for the controls of a year.
pub(super) struct Question<'a> {
    pub file: &'a SceneFile,
    pub base: &'a Path,
    pub library: &'a dyn SystemLibrary,
    pub session: &'a Session,
    pub settings: &'a Settings,
    pub steps: &'a Steps,
}

/// Whether any aperture of the scene leaves its state to a control.
fn moves(file: &SceneFile) -> bool {
    let controlled = |state: &Option<String>| state.as_deref() == Some(CONTROLLED);
    file.aperture.iter().any(|aperture| match &aperture.system {
        SystemKeys::Catalogue { state, .. } | SystemKeys::File { state, .. } | SystemKeys::Family { state, .. } => {
            controlled(state)
        }
        SystemKeys::Ideal { .. } | SystemKeys::Luminaires { .. } | SystemKeys::Ranked => false,
    })
}

/// Steps the controls through all steps of a year, including dark ones, so that hysteresis and dwell time have their
/// true length, and returns the states. Adds notes for the user to `notes`.
///
/// # Errors
/// Returns an error if a control is not valid, or if cancelled.
pub(super) fn states(
    question: &Question<'_>,
    notes: &mut Vec<String>,
    progress: &dyn Progress,
) -> Result<States, StudyError> {
    let Question { file, base, library, session, settings: all, steps } = *question;
    if !moves(file) {
        return Ok(States { list: vec![Vec::new(); steps.list.len()], ..States::default() });
    }
    let moving = moving(file, base, &|keys| library.device(keys, base))?;
    let mut controllers: Vec<Controller> = moving
        .iter()
        .map(|one| Ok(Controller::new(control_settings(&one.keys, &one.device, base)?)))
        .collect::<Result<_, StudyError>>()?;
    for one in &moving {
        let number = one.aperture;
        if one.keys.dwell.is_some_and(|minutes| minutes > 0.0 && minutes < 60.0 * steps.length) {
            notes.push(format!(
                "aperture {number}: a dwell time below the steps of {} min has no effect",
                60.0 * steps.length
            ));
        }
    }
    let measured = controllers.iter().any(|one| one.settings().close_above.is_some());
    let orientation = Orientation::new(Bearing::from_degrees(file.site.azimuth));
    let room = room(&file.room)?;
    let before = Before::of(file, &room, &apertures(&file.aperture, &room)?)?;
    let first = steps.even_outside(0)?.0;
    let dark = before.dark(&first, orientation);
    let lit = if measured { session.standing(&before, &first, orientation, progress)? } else { None };
    let settings = Settings { eyes: Vec::new(), ..all.clone() };
    let asked = light::Question { file, base, library, session, settings: &settings, steps, moving: &moving };
    let mut reader = Reader::new(asked, sensors(&moving, settings.sensors)?);
    let mut movements = vec![0; moving.len()];
    let mut list = Vec::with_capacity(steps.list.len());
    for (k, step) in steps.list.iter().enumerate() {
        if k % 1000 == 0 {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            progress.advance("states", k, steps.list.len());
        }
        let (outside, sun) = if measured { steps.outside(k)? } else { steps.even_outside(k)? };
        let outside = match (&lit, &dark) {
            (Some(lit), _) if step.hour.is_lit() => lit.under(&outside, sun.as_ref()),
            (_, Some(dark)) => outside.open().behind(Arc::clone(dark)),
            _ => outside,
        };
        let mut all = Vec::with_capacity(moving.len());
        for (one, controller) in moving.iter().zip(&controllers) {
            let facing = Facing { outside: &outside, sun: sun.as_ref(), orientation, surface: one.opening.surface };
            let global = controller.settings().close_above.is_some();
            let at = Some(of_year(step.time));
            if step.hour.is_lit() {
                begun(&controller.settings().rule, at)?;
            }
            all.push(Inputs {
                of_year: at,
                ..inputs(&facing, &one.opening, step.clock, one.keys.indoor, global, one.device.upright)
            });
        }
        let time = 3600.0 * steps.length * k as f64;
        let decisions = match &mut reader {
            // No sensor is read in dark steps.
            Some(reader) if step.hour.is_lit() => reader.step(k, time, &mut controllers, &all, progress)?,
            _ => controllers.iter_mut().zip(&all).map(|(controller, inputs)| controller.step(time, inputs)).collect(),
        };
        movements.iter_mut().zip(&decisions).for_each(|(count, one)| *count += usize::from(one.moved));
        list.push(decisions.iter().map(|one| one.state).collect());
    }
    let indoor = reader.map(|reader| reader.found);
    add_notes(indoor.as_ref(), notes);
    Ok(States { moving, list, movements, indoor })
}

/// Adds notes on steps at which the readings of the room's sensors do not determine the state.
fn add_notes(indoor: Option<&Indoor>, notes: &mut Vec<String>) {
    let Some(Indoor { read, hunting, unsure }) = indoor else { return };
    if !hunting.is_empty() {
        notes.push(format!(
            "open_below: at {} of {read} steps at which the room was read it is too dark closed and bright enough open: hunting, \
             taken as open",
            hunting.len()
        ));
    }
    if !unsure.is_empty() {
        notes.push(format!(
            "open_below: at {} of {read} steps at which the room was read the reading's error reaches another state",
            unsure.len()
        ));
    }
}
