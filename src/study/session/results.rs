//! Results of a session: a room, a sensor, an aperture's light.

use super::outside_seen::OutsideSeen;
use crate::compute::estimate::{Estimate, largest_relative_error};
use crate::compute::lid::{BeamSource, Lid};
use crate::compute::room::direct::Sensor;
use crate::study::error::StudyError;
use crate::study::plan::Plan;

/// Illuminance at one sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorResult {
    /// Position and normal of the sensor.
    pub sensor: Sensor,
    /// Direct component: from the apertures without reflection in the room, direct sun included. \[lx\]
    pub direct: Estimate,
    /// Interreflected component: after at least one reflection in the room. \[lx\]
    pub interreflected: Estimate,
    /// Part of `direct` that is the sun's light as beams: undeviated, deflected or mirrored. \[lx\]
    pub beam: f64,
    /// Data part of the uncertainty of the total: from details that the data do not distinguish. The numerical part is
    /// in the errors of `direct` and `interreflected`. \[lx\]
    pub data_error: f64,
}

impl SensorResult {
    /// Returns direct and interreflected light together, with both parts of the uncertainty. \[lx\]
    pub fn total(&self) -> Estimate {
        self.direct + self.interreflected + Estimate::new(0.0, self.data_error)
    }

    /// Returns the numerical part of the uncertainty, with the data taken as exact. \[lx\]
    pub fn numerical_error(&self) -> f64 {
        (self.direct + self.interreflected).error
    }
}

/// Illuminances of a scene at all sensors.
#[derive(Debug, Clone)]
pub struct RoomResult {
    /// Results of the sensors, in the order of the scene.
    pub sensors: Vec<SensorResult>,
    /// Flux that enters through all apertures. \[lm\]
    pub flux: Estimate,
    /// Largest relative gap between the flux that leaves an aperture and the flux found on the surfaces, before it
    /// was closed; 0 without interreflection.
    pub flux_gap: f64,
    /// Source of the sun's beams with a note on it, aperture by aperture.
    pub beams: Vec<(BeamSource, String)>,
    /// Treatment of the apertures with obstructions; empty without any.
    pub outside: Vec<OutsideSeen>,
    /// Plan of the computation: stages that ran, stages that were skipped, and their times.
    pub plan: Plan,
}

impl RoomResult {
    /// Returns the data part of the uncertainty as a share of all light at the sensors.
    pub fn data_share(&self) -> f64 {
        let all: f64 = self.sensors.iter().map(|s| s.total().value).sum();
        let open: f64 = self.sensors.iter().map(|s| s.data_error).sum();
        if all > 0.0 { open / all } else { 0.0 }
    }

    /// Returns the largest relative error stated among the sensors that are not dark (1 % of the mean); 0 without
    /// light.
    pub fn reached(&self) -> f64 {
        largest_relative_error(self.sensors.iter().map(SensorResult::total))
    }
}

/// Light of one aperture into the room.
#[derive(Debug, Clone)]
pub struct LidResult {
    /// Luminous intensity distribution of the aperture.
    pub lid: Lid,
    /// Luminous flux into the room. \[lm\]
    pub flux: Estimate,
    /// Illuminance of the outside face: diffuse, then by the sun. \[lx\]
    pub incident: (Estimate, f64),
}

impl LidResult {
    /// Returns the result if its flux is a finite number.
    ///
    /// # Errors
    /// Returns an error if the flux is not a finite number.
    pub(super) fn checked(self) -> Result<Self, StudyError> {
        all_numbers(&[], self.flux)?;
        Ok(self)
    }
}

/// Checks that all results are finite numbers.
///
/// # Errors
/// Returns an error that names the apertures or the first sensor with a value that is not a finite number.
pub(super) fn all_numbers(sensors: &[SensorResult], flux: Estimate) -> Result<(), StudyError> {
    let number = |one: Estimate| one.value.is_finite() && one.error.is_finite();
    if !number(flux) {
        return Err(StudyError::NoNumber("the apertures".to_owned()));
    }
    match sensors.iter().position(|one| !(number(one.total()) && one.beam.is_finite())) {
        Some(at) => Err(StudyError::NoNumber(format!("sensor {}", at + 1))),
        None => Ok(()),
    }
}
