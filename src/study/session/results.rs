//! Results of a session: illuminances in a room and at a sensor, light of an aperture.

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
    /// Share of the direct component that is sunlight in beams: undeviated, deflected or mirrored; part of `direct`.
    /// \[lx\]
    pub beam: f64,
    /// Uncertainty of the total illuminance by details that the BSDF data do not resolve. The numerical errors are
    /// those of `direct` and `interreflected`. \[lx\]
    pub data_error: f64,
}

impl SensorResult {
    /// Returns the total illuminance, direct and interreflected, with both kinds of uncertainty. \[lx\]
    pub fn total(&self) -> Estimate {
        self.direct + self.interreflected + Estimate::new(0.0, self.data_error)
    }

    /// Returns the numerical error of the total illuminance, with the BSDF data taken as exact. \[lx\]
    pub fn numerical_error(&self) -> f64 {
        (self.direct + self.interreflected).error
    }
}

/// Illuminances of a scene at all its sensors.
#[derive(Debug, Clone)]
pub struct RoomResult {
    /// Results of the sensors, in the order of the scene.
    pub sensors: Vec<SensorResult>,
    /// Luminous flux that enters the room through all apertures. \[lm\]
    pub flux: Estimate,
    /// Largest relative gap between the flux that leaves an aperture and the flux found on the surfaces of the room,
    /// before it was closed; 0 without interreflection.
    pub flux_gap: f64,
    /// Method by which sunlight was computed as beams, with a note on it, for each aperture.
    pub beams: Vec<(BeamSource, String)>,
    /// Notes on how apertures with obstructions were computed; empty without any.
    pub outside: Vec<OutsideSeen>,
    /// Plan of the computation: stages that ran, stages that were skipped, and their times.
    pub plan: Plan,
}

impl RoomResult {
    /// Returns the uncertainty by the BSDF data as a share of all illuminances: its sum over the sensors, relative to
    /// the sum of their illuminances.
    pub fn data_share(&self) -> f64 {
        let all: f64 = self.sensors.iter().map(|s| s.total().value).sum();
        let open: f64 = self.sensors.iter().map(|s| s.data_error).sum();
        if all > 0.0 { open / all } else { 0.0 }
    }

    /// Returns the largest relative error of the total illuminance over all sensors that are not dark (above 1 % of the
    /// mean); 0 without light.
    pub fn reached(&self) -> f64 {
        largest_relative_error(self.sensors.iter().map(SensorResult::total))
    }
}

/// Light of one aperture into the room: flux and luminous intensity distribution.
#[derive(Debug, Clone)]
pub struct LidResult {
    /// Luminous intensity distribution of the aperture.
    pub lid: Lid,
    /// Luminous flux of the aperture into the room. \[lm\]
    pub flux: Estimate,
    /// Illuminance of the aperture from outside: diffuse, then by the sun. \[lx\]
    pub incident: (Estimate, f64),
}

impl LidResult {
    /// Returns this result if its flux is a finite number.
    ///
    /// # Errors
    /// Returns an error if the flux is not a finite number.
    pub(super) fn checked(self) -> Result<Self, StudyError> {
        all_numbers(&[], self.flux)?;
        Ok(self)
    }
}

/// Checks that all illuminances and the flux are finite numbers.
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
