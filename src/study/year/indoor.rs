//! Readings of the room's illuminance sensors in an annual simulation, for controls that depend on the illuminance in
//! the room (`open_below`): the room in the step, with the states that the control would choose.
//!
//! Sensors are read for two combinations of states only: that which the rule demands if the room is bright enough, and
//! that which it demands if not. If both are the same nothing is read, and the control's memory of the reading is
//! reset. The reading in the first combination decides; if it demands the second, that one is read as well. If the room
//! is then bright enough, the control would oscillate: the step is counted as hunting, and has the second combination.

use super::light::{self, Engine, prepared};
use crate::compute::control::controller::{Controller, Decision, Inputs};
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::study::control::year::Moving;
use crate::study::error::StudyError;
use std::collections::BTreeMap;

/// Summary of the sensor readings by the controls of a year. Steps are given by their indices.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Indoor {
    /// Number of steps at which sensors were read.
    pub read: usize,
    /// Steps at which the control would oscillate between two states.
    pub hunting: Vec<usize>,
    /// Steps at which another state would follow within the error of the reading.
    pub unsure: Vec<usize>,
}

/// Returns, for every moving aperture whose control reads the room, the indices of its sensors; `None` for the others.
/// `count`: number of the scene's sensors.
///
/// # Errors
/// Returns an error if a sensor does not exist in the scene.
pub(super) fn sensors(moving: &[Moving], count: usize) -> Result<Vec<Option<Vec<usize>>>, StudyError> {
    moving
        .iter()
        .map(|one| {
            let keys = &one.keys;
            if let Some(index) = keys.indoor_sensors.iter().find(|index| **index >= count) {
                let message = format!("there is no sensor {index} (allowed: 0 to {})", count.saturating_sub(1));
                return Err(StudyError::key("control.indoor_sensors", message));
            }
            if keys.open_below.is_none() || keys.indoor.is_some() {
                return Ok(None);
            }
            let all = || (0..count).collect();
            Ok(Some(if keys.indoor_sensors.is_empty() { all() } else { keys.indoor_sensors.clone() }))
        })
        .collect()
}

/// Reader of the room's sensors for given states of the moving apertures.
pub(super) struct Reader<'a> {
    question: light::Question<'a>,
    sensors: Vec<Option<Vec<usize>>>,
    /// Indices of all sensors that any control reads, ascending.
    asked: Vec<usize>,
    engines: BTreeMap<Vec<usize>, Engine>,
    /// Summary of the readings so far.
    pub found: Indoor,
}

impl<'a> Reader<'a> {
    /// Creates a reader; `None` if no control reads the room. `question`: input of the annual simulation, without
    /// observers; `sensors`: indices of the sensors of each moving aperture.
    pub fn new(question: light::Question<'a>, sensors: Vec<Option<Vec<usize>>>) -> Option<Self> {
        let mut asked: Vec<usize> = sensors.iter().flatten().flatten().copied().collect();
        asked.sort_unstable();
        asked.dedup();
        let found = Indoor::default();
        (!asked.is_empty()).then(|| Self { question, sensors, asked, engines: BTreeMap::new(), found })
    }

    /// Steps the controllers through the step `k`, which has light, with readings of the room's sensors, and returns
    /// their decisions. `time`: time for hysteresis and dwell time. \[s\]
    ///
    /// # Errors
    /// Returns an error if the room with the states is wrong, or if cancelled.
    pub fn step(
        &mut self,
        k: usize,
        time: f64,
        controllers: &mut [Controller],
        inputs: &[Inputs],
        progress: &dyn Progress,
    ) -> Result<Vec<Decision>, StudyError> {
        let before = controllers.to_vec();
        let sensors = self.sensors.clone();
        let with = |reading: &dyn Fn(usize) -> f64| -> (Vec<Controller>, Vec<Decision>) {
            let mut all = before.clone();
            let step = |(m, controller): (usize, &mut Controller)| {
                let own = sensors[m].as_ref().map(|_| reading(m)).or(inputs[m].indoor);
                controller.step(time, &Inputs { indoor: own, ..inputs[m] })
            };
            let decisions = all.iter_mut().enumerate().map(step).collect();
            (all, decisions)
        };
        let states = |decisions: &[Decision]| decisions.iter().map(|one| one.state).collect::<Vec<usize>>();
        let mut taken = with(&|_| f64::INFINITY);
        let bright = states(&taken.1);
        if states(&with(&|_| 0.0).1) != bright {
            let first = self.read(&bright, k, progress)?;
            self.found.read += 1;
            taken = with(&|m| first[m].value);
            let decided = states(&taken.1);
            let off = |readings: &[Estimate], decided: &[usize]| {
                [-1.0, 1.0].iter().any(|sign| {
                    states(&with(&|m| (readings[m].value + sign * readings[m].error).max(0.0)).1) != decided
                })
            };
            let mut unsure = off(&first, &decided);
            if decided != bright {
                let second = self.read(&decided, k, progress)?;
                let again = states(&with(&|m| second[m].value).1);
                unsure |= off(&second, &again);
                if again != decided {
                    self.found.hunting.push(k);
                }
            }
            if unsure {
                self.found.unsure.push(k);
            }
        }
        controllers.clone_from_slice(&taken.0);
        Ok(taken.1)
    }

    /// Returns the mean illuminance of every moving aperture's sensors with the states `set` in the step `k`; 0 for
    /// apertures whose control reads none. \[lx\]
    fn read(&mut self, set: &[usize], k: usize, progress: &dyn Progress) -> Result<Vec<Estimate>, StudyError> {
        if progress.cancelled() {
            return Err(Cancelled.into());
        }
        if !self.engines.contains_key(set) {
            let mut scene = prepared(&self.question, set)?;
            scene.sensors = self.asked.iter().map(|&index| scene.sensors[index]).collect();
            self.engines.insert(set.to_vec(), Engine::new(&self.question, scene, 0, progress)?);
        }
        let engine = &self.engines[set];
        let light = engine.at(k, self.question.steps.outside(k)?).light;
        let at = |index: &usize| self.asked.binary_search(index).map_or(Estimate::default(), |place| light[place]);
        let mean = |list: &Vec<usize>| list.iter().map(at).sum::<Estimate>() * (1.0 / list.len().max(1) as f64);
        Ok(self.sensors.iter().map(|one| one.as_ref().map_or(Estimate::default(), mean)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::room::aperture::Aperture;
    use crate::study::control::Device;
    use crate::study::control::keys::{ControlKeys, ControlMode};
    use glam::DVec3;

    fn moving(change: impl Fn(&mut ControlKeys)) -> Moving {
        let mut keys = ControlKeys::of(ControlMode::Din5034);
        change(&mut keys);
        let device = Device {
            name: "d".to_owned(),
            keys: vec!["0".to_owned(), "75".to_owned()],
            values: Some(vec![0.0, 75.0]),
            curve: Vec::new(),
            section: None,
            upright: false,
        };
        let opening = Aperture { surface: Surface::Facade, corner: DVec3::ZERO, size: [1.0; 2] };
        Moving { aperture: 1, opening, device, keys, section: None }
    }

    #[test]
    fn sensors_are_those_that_are_named_or_all() {
        let of = |change: &dyn Fn(&mut ControlKeys)| sensors(&[moving(change)], 4).map(|list| list[0].clone());
        assert_eq!(of(&|_| ()), Ok(None));
        assert_eq!(of(&|keys| keys.open_below = Some(300.0)), Ok(Some(vec![0, 1, 2, 3])));
        let named = |keys: &mut ControlKeys| {
            (keys.open_below, keys.indoor_sensors) = (Some(300.0), vec![2]);
        };
        assert_eq!(of(&named), Ok(Some(vec![2])));
        // What is said to be read is read.
        assert_eq!(of(&|keys| (keys.open_below, keys.indoor) = (Some(300.0), Some(200.0))), Ok(None));
        let wrong = of(&|keys| keys.indoor_sensors = vec![4]).unwrap_err().to_string();
        assert!(wrong.contains("control.indoor_sensors") && wrong.contains("no sensor 4 (allowed: 0 to 3)"), "{wrong}");
    }
}
