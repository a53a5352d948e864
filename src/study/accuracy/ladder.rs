//! Runs of the comparison of methods: first the reference, then every method with rising effort.

use super::{Accuracy, Errors, Origin, Quantity, Reference, Rung, Series, Truth};
use crate::compute::angle::Bearing;
use crate::compute::direction::Dir;
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::room::near_field::NearField;
use crate::compute::sky::Sun;
use crate::study::error::StudyError;
use crate::study::leaving_out::leaving_out;
use crate::study::plan::Plan;
use crate::study::scene::Scene;
use crate::study::session::{RoomResult, SensorResult, Session};
use std::time::Instant;

/// Relative error targets with which the default method is run.
const TARGETS: [f64; 5] = [0.1, 0.03, 0.01, 0.003, 0.001];
/// Numbers of point luminaires along each side of the aperture, with which the subdivision method is run.
const SIDES: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];
/// Numbers of random points per sensor, with which the Monte Carlo method is run.
const POINTS: [usize; 6] = [64, 256, 1024, 4096, 16_384, 65_536];
/// Numbers of cells along each profile angle, with which the profile-table method is run.
const CELLS: [usize; 4] = [45, 90, 180, 360];
/// Relative error targets of the reference and of the second finest run: without and with interreflection.
const REFERENCE: [[f64; 2]; 2] = [[1e-7, 1e-6], [2e-4, 5e-4]];
/// Maximum number of sensors that are compared; of more, an even selection is computed.
const MOST_SENSORS: usize = 256;
/// Share of the mean illuminance below which a sensor is left out of the comparison.
const DARK: f64 = 0.01;
/// Duration below which a run is timed three times, and the shortest time counts. \[s\]
const SHORT: f64 = 0.3;

/// Computes a scene with rising effort by every method, and compares the results with the finest run of the default
/// method. Takes some seconds for a hundred sensors.
pub fn ladder(scene: &Scene, progress: &dyn Progress) -> Result<Accuracy, StudyError> {
    ladder_against(scene, None, progress)
}

/// Computes a scene with rising effort by every method, and compares the results with an external reference (`truth`)
/// if there is one, else with the finest run of the default method.
pub fn ladder_against(scene: &Scene, truth: Option<&Truth>, progress: &dyn Progress) -> Result<Accuracy, StudyError> {
    let run = || {
        let chosen = selection(scene.sensors.len());
        let truth = truth.map(|truth| truth.only(&chosen));
        let mut ladder = Ladder { scene: thinned(scene, &chosen), truth, progress, done: 0, steps: 0 };
        ladder.run(scene.sensors.len())
    };
    // Times of many threads describe the machine rather than the method.
    let mut accuracy = match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(run),
        Err(_) => run(),
    }?;
    accuracy.leaving_out = leaving_out(scene, progress)?;
    Ok(accuracy)
}

/// Returns the indices of the sensors that are computed: all of `count`, or an even selection of [`MOST_SENSORS`].
fn selection(count: usize) -> Vec<usize> {
    let most = count.min(MOST_SENSORS);
    (0..most).map(|k| k * count / most).collect()
}

/// Returns the scene with only the chosen sensors, and with the default method of integration.
fn thinned(scene: &Scene, chosen: &[usize]) -> Scene {
    let mut scene = scene.clone();
    if chosen.len() < scene.sensors.len() {
        scene.sensors = chosen.iter().map(|&k| scene.sensors[k]).collect();
        scene.grid = None;
    }
    scene.near_field = NearField::SolidAngle;
    scene
}

struct Ladder<'a> {
    scene: Scene,
    truth: Option<Truth>,
    progress: &'a dyn Progress,
    done: usize,
    steps: usize,
}

/// Reference for one component of the illuminance: values with their uncertainty, and whether it is an external one,
/// whose values do not depend on the BSDF data, so that stated errors must cover the uncertainty of these too.
struct Judge {
    values: Vec<Estimate>,
    outside: bool,
}

/// Progress of a single run, which only passes on cancellation; the steps are reported by the series of runs.
struct Inner<'a>(&'a dyn Progress);

impl Progress for Inner<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

impl Ladder<'_> {
    /// Runs the reference and all methods. `all`: number of sensors of the scene before the selection.
    fn run(&mut self, all: usize) -> Result<Accuracy, StudyError> {
        let direct = Scene { interreflection: false, ..self.scene.clone() };
        let reflects = Plan::new(&self.scene).runs("interreflection");
        let mut methods: Vec<(&'static str, Vec<NearField>)> = vec![
            ("subdivision", SIDES.iter().map(|&n| NearField::Subdivision(Some([n, n]))).collect()),
            ("monte-carlo", POINTS.iter().map(|&n| NearField::MonteCarlo(n)).collect()),
            ("profile-table", CELLS.iter().map(|&n| NearField::ProfileTable(n)).collect()),
        ];
        if let Some((_, list)) = methods.first_mut() {
            list.push(NearField::Subdivision(None));
        }
        let rungs: usize = methods.iter().map(|(_, list)| list.len()).sum();
        // If nothing reflects, all light is direct.
        let given = self.truth.as_ref().and_then(|truth| if reflects { truth.direct() } else { Some(truth.total()) });
        let runs = 2 * (usize::from(given.is_none()) + usize::from(reflects && self.truth.is_none()));
        self.steps = runs + TARGETS.len() * (1 + usize::from(reflects)) + rungs;

        let (reference, truth) = self.reference(&direct, Quantity::Direct, given)?;
        let mut references = vec![reference];
        let mut series = vec![self.by_target(&direct, Quantity::Direct, &truth)?];
        for (method, list) in methods {
            let rungs = list
                .into_iter()
                .map(|near_field| {
                    let scene = Scene { near_field, error_target: None, ..direct.clone() };
                    self.rung(near_field.effort(), &scene, &truth)
                })
                .collect::<Result<_, _>>()?;
            series.push(Series { method, quantity: Quantity::Direct, rungs });
        }
        if reflects {
            let whole = self.scene.clone();
            let given = self.truth.as_ref().map(Truth::total);
            let (reference, truth) = self.reference(&whole, Quantity::Total, given)?;
            references.push(reference);
            series.push(self.by_target(&whole, Quantity::Total, &truth)?);
        }
        let sensors = (self.scene.sensors.len(), all);
        let threads = rayon::current_num_threads();
        Ok(Accuracy { references, series, sensors, threads, leaving_out: Vec::new() })
    }

    fn step(&mut self) -> Result<(), StudyError> {
        if self.progress.cancelled() {
            return Err(Cancelled.into());
        }
        self.progress.advance("accuracy", self.done, self.steps);
        self.done += 1;
        Ok(())
    }

    /// Returns the reference for a component of the illuminance: the given external one, or else the finest run.
    fn reference(
        &mut self,
        scene: &Scene,
        quantity: Quantity,
        given: Option<Vec<Estimate>>,
    ) -> Result<(Reference, Judge), StudyError> {
        if let (Some(values), Some(truth)) = (given, &self.truth) {
            let reference = Reference { quantity, origin: Origin::Given(truth.name().to_owned()), stated: 0.0 };
            let judge = Judge { values, outside: true };
            return Ok((Reference { stated: judge.stated(), ..reference }, judge));
        }
        let [target, second] = REFERENCE[usize::from(quantity == Quantity::Total)];
        let mut at = |target| {
            self.step()?;
            Session::new().room(&Scene { error_target: Some(target), ..scene.clone() }, &Inner(self.progress))
        };
        let (finest, second) = (at(target)?, at(second)?);
        let values = finest.sensors.iter().map(|row| Estimate::new(row.total().value, row.numerical_error())).collect();
        let judge = Judge { values, outside: false };
        let difference = Rung { errors: judge.errors(&second), ..Rung::default() };
        let origin = Origin::FinestRun { target, rms: difference.rms(), max: difference.max() };
        Ok((Reference { quantity, origin, stated: judge.stated() }, judge))
    }

    fn by_target(&mut self, scene: &Scene, quantity: Quantity, truth: &Judge) -> Result<Series, StudyError> {
        let rungs = TARGETS
            .into_iter()
            .map(|target| {
                let scene = Scene { error_target: Some(target), ..scene.clone() };
                self.rung(format!("error target {} %", 100.0 * target), &scene, truth)
            })
            .collect::<Result<_, _>>()?;
        let method = if quantity == Quantity::Total { "room" } else { NearField::SolidAngle.word() };
        Ok(Series { method, quantity, rungs })
    }

    /// Computes the scene with one effort, described by `setting`: its times for first sky, new sky and new sun
    /// position, and its errors against the reference.
    fn rung(&mut self, setting: String, scene: &Scene, truth: &Judge) -> Result<Rung, StudyError> {
        self.step()?;
        let progress = Inner(self.progress);
        let session = Session::new();
        let clock = Instant::now();
        let result = session.room(scene, &progress)?;
        let cold = clock.elapsed().as_secs_f64();
        // Another sky of the same kind, so that it is as hard: every luminance is a new one.
        let sky = best(|repeat| {
            let outside = scene.outside.scaled(1.0 - 0.01 * (repeat + 1) as f64);
            session.room(&Scene { outside, ..scene.clone() }, &progress)
        })?;
        let shines = result.plan.runs("sun");
        let sun = match scene.sun.filter(|_| shines) {
            None => None,
            Some(sun) => Some(best(|repeat| {
                let turned = Bearing::from_radians(sun.direction.bearing().radians() + 0.01 * (repeat + 1) as f64);
                let direction = Dir::from_altitude_bearing(sun.direction.altitude(), turned);
                session.room(&Scene { sun: Some(Sun { direction, ..sun }), ..scene.clone() }, &progress)
            })?),
        };
        Ok(Rung {
            setting,
            target: scene.error_target,
            setup: (cold - sky).max(0.0),
            sky,
            sun,
            numerical: share(&result, SensorResult::numerical_error),
            data: result.data_share(),
            errors: truth.errors(&result),
        })
    }
}

/// Returns the duration of the fastest of three runs, or of a single long one. \[s\]
fn best(mut run: impl FnMut(usize) -> Result<RoomResult, StudyError>) -> Result<f64, StudyError> {
    let mut least = f64::INFINITY;
    for repeat in 0..3 {
        let clock = Instant::now();
        run(repeat)?;
        least = least.min(clock.elapsed().as_secs_f64());
        if least > SHORT {
            break;
        }
    }
    Ok(least)
}

/// Returns the sum of the sensors' errors, relative to the sum of their illuminances.
fn share(result: &RoomResult, error: impl Fn(&SensorResult) -> f64) -> f64 {
    let all: f64 = result.sensors.iter().map(|row| row.total().value).sum();
    if all > 0.0 { result.sensors.iter().map(error).sum::<f64>() / all } else { 0.0 }
}

impl Judge {
    /// Returns the errors of the illuminances at all sensors that are not dark.
    fn errors(&self, result: &RoomResult) -> Vec<Errors> {
        let of = |(row, truth): (&SensorResult, &Estimate)| {
            let stated = if self.outside { row.total().error } else { row.numerical_error() };
            Errors {
                stated: stated / truth.value,
                real: (row.total().value - truth.value).abs() / truth.value,
                open: truth.error / truth.value,
            }
        };
        let lit = self.least();
        result.sensors.iter().zip(&self.values).filter(|(_, truth)| truth.value > lit).map(of).collect()
    }

    /// Returns the largest relative error of the reference itself, over sensors that are not dark.
    fn stated(&self) -> f64 {
        let lit = self.least();
        self.values.iter().filter(|e| e.value > lit).map(|e| e.error / e.value).fold(0.0, f64::max)
    }

    /// Returns the illuminance above which a sensor is not dark and is compared. \[lx\]
    fn least(&self) -> f64 {
        DARK * self.values.iter().map(|e| e.value).sum::<f64>() / self.values.len().max(1) as f64
    }
}
