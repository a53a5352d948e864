//! What a session answers: a room, a sensor, an aperture's light.

use super::outside_seen::OutsideSeen;
use crate::compute::estimate::{Estimate, largest_relative_error};
use crate::compute::lid::{BeamSource, Lid};
use crate::compute::room::direct::Sensor;
use crate::study::error::StudyError;
use crate::study::plan::Plan;

/// What one sensor gets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorResult {
    /// Where.
    pub sensor: Sensor,
    /// Straight from the apertures, sun included. \[lx\]
    pub direct: Estimate,
    /// After at least one reflection. \[lx\]
    pub interreflected: Estimate,
    /// The part of `direct` that is the sun's light come through as beams: straight on, deflected, mirrored. \[lx\]
    pub beam: f64,
    /// How far all may be off for what the data do not tell apart, beside what the computation may be. \[lx\]
    pub data_error: f64,
}

impl SensorResult {
    /// Direct and interreflected light together, with both kinds of error. \[lx\]
    pub fn total(&self) -> Estimate {
        self.direct + self.interreflected + Estimate::new(0.0, self.data_error)
    }

    /// Error of the computation alone, were the data exact. \[lx\]
    pub fn numerical_error(&self) -> f64 {
        (self.direct + self.interreflected).error
    }
}

/// Illuminances of a scene.
#[derive(Debug, Clone)]
pub struct RoomResult {
    /// In the order of the scene.
    pub sensors: Vec<SensorResult>,
    /// Flux that enters through all apertures. \[lm\]
    pub flux: Estimate,
    /// Largest relative gap between the flux that leaves an aperture and the flux found on the surfaces, before it
    /// was closed; 0 without interreflection.
    pub flux_gap: f64,
    /// How the sun's beams were found, aperture by aperture, and what is to be said of it.
    pub beams: Vec<(BeamSource, String)>,
    /// How the apertures saw what stands outside; empty where nothing does.
    pub outside: Vec<OutsideSeen>,
    /// What ran, what was left out, and how long it took.
    pub plan: Plan,
}

impl RoomResult {
    /// Share of all light at the sensors that the data leave open.
    pub fn data_share(&self) -> f64 {
        let all: f64 = self.sensors.iter().map(|s| s.total().value).sum();
        let open: f64 = self.sensors.iter().map(|s| s.data_error).sum();
        if all > 0.0 { open / all } else { 0.0 }
    }

    /// The largest relative error stated among the sensors that are not in the dark (1 % of the mean); 0 without light.
    pub fn reached(&self) -> f64 {
        largest_relative_error(self.sensors.iter().map(SensorResult::total))
    }
}

/// The light of one aperture.
#[derive(Debug, Clone)]
pub struct LidResult {
    /// Its luminous-intensity distribution.
    pub lid: Lid,
    /// Luminous flux into the room. \[lm\]
    pub flux: Estimate,
    /// Illuminance of the outside face: diffuse, and by the sun. \[lx\]
    pub incident: (Estimate, f64),
}

impl LidResult {
    /// The same if its light is numbers.
    pub(super) fn checked(self) -> Result<Self, StudyError> {
        all_numbers(&[], self.flux)?;
        Ok(self)
    }
}

/// Nothing leaves that is no number.
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
