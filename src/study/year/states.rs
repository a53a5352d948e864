//! The state of every moving aperture in every step: the controls stepped through the year with the weather's sun and sky.

use super::steps::Steps;
use crate::compute::angle::Bearing;
use crate::compute::control::controller::{Controller, Inputs};
use crate::compute::direction::Orientation;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::lid::Facing;
use crate::formats::state_table::of_year;
use crate::study::control::table::begun;
use crate::study::control::year::{CONTROLLED, Moving, moving};
use crate::study::control::{inputs, settings};
use crate::study::error::StudyError;
use crate::study::scene_file::{SceneFile, SystemKeys};
use crate::study::system::SystemLibrary;
use std::path::Path;

/// Apertures, their states by step, and how often each moves.
pub(super) type States = (Vec<Moving>, Vec<Vec<usize>>, Vec<usize>);

/// Is any aperture left to a control?
fn moves(file: &SceneFile) -> bool {
    let controlled = |state: &Option<String>| state.as_deref() == Some(CONTROLLED);
    file.aperture.iter().any(|aperture| match &aperture.system {
        SystemKeys::Catalogue { state, .. } | SystemKeys::File { state, .. } | SystemKeys::Family { state, .. } => {
            controlled(state)
        }
        SystemKeys::Ideal { .. } | SystemKeys::Luminaires { .. } | SystemKeys::Ranked => false,
    })
}

/// Steps the controls through all steps of a year, dark ones included: hysteresis and dwell time act at their length.
///
/// # Errors
/// A control that cannot be; cancelled.
pub(super) fn states(
    file: &SceneFile,
    base: &Path,
    library: &dyn SystemLibrary,
    steps: &Steps,
    notes: &mut Vec<String>,
    progress: &dyn Progress,
) -> Result<States, StudyError> {
    if !moves(file) {
        return Ok((Vec::new(), vec![Vec::new(); steps.list.len()], Vec::new()));
    }
    let moving = moving(file, base, &|keys| library.device(keys, base))?;
    let mut controllers: Vec<Controller> = moving
        .iter()
        .map(|one| Ok(Controller::new(settings(&one.keys, &one.device, base)?)))
        .collect::<Result<_, StudyError>>()?;
    for one in &moving {
        let number = one.aperture;
        if one.keys.open_below.is_some() && one.keys.indoor.is_none() {
            notes.push(format!(
                "aperture {number}: open_below has no effect: no indoor illuminance is asked by the controls of a year"
            ));
        }
        if one.keys.dwell.is_some_and(|minutes| minutes > 0.0 && minutes < 60.0 * steps.length) {
            notes.push(format!(
                "aperture {number}: a dwell time below the steps of {} min has no effect",
                60.0 * steps.length
            ));
        }
    }
    if !file.outside.is_empty() {
        notes.push("boxes outside are not seen by the controls, which go by where the sun is".to_owned());
    }
    let measured = controllers.iter().any(|one| one.settings().close_above.is_some());
    let orientation = Orientation::new(Bearing::from_degrees(file.site.azimuth));
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
        let mut states = Vec::with_capacity(moving.len());
        for ((one, controller), moved) in moving.iter().zip(&mut controllers).zip(&mut movements) {
            let facing = Facing { outside: &outside, sun: sun.as_ref(), orientation, surface: one.surface };
            let global = controller.settings().close_above.is_some();
            let at = Some(of_year(step.time));
            if step.hour.is_lit() {
                begun(&controller.settings().rule, at)?;
            }
            let inputs = Inputs { of_year: at, ..inputs(&facing, step.clock, one.keys.indoor, global) };
            let decision = controller.step(3600.0 * steps.length * k as f64, &inputs);
            *moved += usize::from(decision.moved);
            states.push(decision.state);
        }
        list.push(states);
    }
    Ok((moving, list, movements))
}
