//! Error against run time: a scene computed with rising effort by every method, each result beside a converged
//! reference. Says what the stated errors are worth, and what data at single directions lose between them.
//!
//! The ways to integrate an aperture's light (`compute.near_field`) differ in the direct component alone and are
//! compared by it. Where surfaces reflect, the whole illuminance is a series of its own. Times are those of one thread.

use super::error::StudyError;
use super::leaving_out::{LeavingOut, leaving_out};
use super::scene::Scene;
use super::session::{RoomResult, Session};
use crate::compute::angle::Bearing;
use crate::compute::direction::Dir;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::room::near_field::NearField;
use crate::compute::sky::Sun;
use std::time::Instant;

/// Error targets of the ordinary method.
const TARGETS: [f64; 5] = [0.1, 0.03, 0.01, 0.003, 0.001];
/// Point luminaires along each side.
const SIDES: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];
/// Random points a sensor.
const POINTS: [usize; 6] = [64, 256, 1024, 4096, 16_384, 65_536];
/// Cells along each profile angle.
const CELLS: [usize; 4] = [45, 90, 180, 360];
/// Targets of the reference and of the second finest, without and with interreflection.
const REFERENCE: [[f64; 2]; 2] = [[1e-7, 1e-6], [2e-4, 5e-4]];
/// Most sensors of a ladder; of more, an even selection.
const MOST_SENSORS: usize = 256;
/// Sensors darker than this share of the mean do not count.
const DARK: f64 = 0.01;
/// A time below this is taken three times, and the best counts. \[s\]
const SHORT: f64 = 0.3;

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Straight from the apertures.
    Direct,
    /// With interreflection.
    Total,
}

/// One computation of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Rung {
    /// The effort in words.
    pub setting: String,
    /// Relative error that was asked for, where the program chose its effort.
    pub target: Option<f64>,
    /// What a first sky costs more than a second. \[s\]
    pub setup: f64,
    /// A new sky in the same room. \[s\]
    pub sky: f64,
    /// A new position of the sun; `None` where it does not shine in. \[s\]
    pub sun: Option<f64>,
    /// Relative error of every sensor that counts: as stated, and against the reference.
    pub errors: Vec<Errors>,
}

/// Errors of one sensor, relative to the reference's illuminance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// What the program says.
    pub stated: f64,
    /// Distance from the reference.
    pub real: f64,
}

impl Rung {
    /// Root of the mean square of the true errors.
    pub fn rms(&self) -> f64 {
        (self.errors.iter().map(|e| e.real * e.real).sum::<f64>() / self.errors.len().max(1) as f64).sqrt()
    }

    /// Largest true error.
    pub fn max(&self) -> f64 {
        self.errors.iter().map(|e| e.real).fold(0.0, f64::max)
    }

    /// Largest stated error: what the program says that it reached.
    pub fn reached(&self) -> f64 {
        self.errors.iter().map(|e| e.stated).fold(0.0, f64::max)
    }

    /// Share of the sensors that keep to what is stated.
    pub fn coverage(&self) -> Coverage {
        Coverage::of(&self.errors)
    }
}

/// What stated errors are worth, as shares of all sensors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Sensors.
    pub count: usize,
    /// Stated ≥ true.
    pub kept: f64,
    /// Stated ≤ 10 × true.
    pub tight: f64,
    /// Stated ≤ 10 × true, or below 10⁻⁴ of the illuminance, where nobody asks.
    pub tight_or_small: f64,
}

impl Coverage {
    /// Counts. True errors below rounding (10⁻¹²) count as kept.
    pub fn of(errors: &[Errors]) -> Self {
        let share = |test: &dyn Fn(&Errors) -> bool| {
            errors.iter().filter(|e| test(e)).count() as f64 / errors.len().max(1) as f64
        };
        Self {
            count: errors.len(),
            kept: share(&|e| e.stated + 1e-12 >= e.real),
            tight: share(&|e| e.stated <= 10.0 * e.real),
            tight_or_small: share(&|e| e.stated <= (10.0 * e.real).max(1e-4)),
        }
    }
}

/// One method with rising effort.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// The method's word in scenes; `room` for the whole illuminance.
    pub method: &'static str,
    /// What is compared.
    pub quantity: Quantity,
    /// By rising effort.
    pub rungs: Vec<Rung>,
}

/// What all is measured against: the ordinary method with more effort than any rung.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// For which series.
    pub quantity: Quantity,
    /// Its error target.
    pub target: f64,
    /// The largest relative error that it states itself.
    pub stated: f64,
    /// Relative RMS distance from the second finest.
    pub rms: f64,
    /// Largest relative distance from the second finest.
    pub max: f64,
}

/// The whole comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// One for each quantity.
    pub references: Vec<Reference>,
    /// One for each method.
    pub series: Vec<Series>,
    /// Sensors that were computed, of how many.
    pub sensors: (usize, usize),
    /// Threads that the times are of.
    pub threads: usize,
    /// Beside the ladder, whose reference interpolates as well: what that is worth, by dataset at single directions.
    pub leaving_out: Vec<LeavingOut>,
}

impl Accuracy {
    /// Coverage of the ordinary method over all its rungs, direct and total.
    pub fn ordinary_coverage(&self) -> Coverage {
        let errors: Vec<Errors> = self
            .series
            .iter()
            .filter(|series| series.method == NearField::SolidAngle.word() || series.quantity == Quantity::Total)
            .flat_map(|series| series.rungs.iter().flat_map(|rung| rung.errors.iter().copied()))
            .collect();
        Coverage::of(&errors)
    }
}

/// Runs the ladder. Takes some seconds for a hundred sensors.
pub fn ladder(scene: &Scene, progress: &dyn Progress) -> Result<Accuracy, StudyError> {
    let run = || {
        let mut ladder = Ladder { scene: thinned(scene), progress, done: 0, steps: 0 };
        ladder.run(scene.sensors.len())
    };
    // Times of many threads say more about the machine than about the method.
    let mut accuracy = match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(run),
        Err(_) => run(),
    }?;
    accuracy.leaving_out = leaving_out(scene, progress)?;
    Ok(accuracy)
}

/// The scene with an even selection of its sensors.
fn thinned(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let count = scene.sensors.len();
    if count > MOST_SENSORS {
        scene.sensors = (0..MOST_SENSORS).map(|k| scene.sensors[k * count / MOST_SENSORS]).collect();
        scene.grid = None;
    }
    scene.near_field = NearField::SolidAngle;
    scene
}

struct Ladder<'a> {
    scene: Scene,
    progress: &'a dyn Progress,
    done: usize,
    steps: usize,
}

/// Hands on that the work is not wanted any more; its own steps are the ladder's.
struct Inner<'a>(&'a dyn Progress);

impl Progress for Inner<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

impl Ladder<'_> {
    fn run(&mut self, all: usize) -> Result<Accuracy, StudyError> {
        let direct = Scene { interreflection: false, ..self.scene.clone() };
        let reflects = self.session_plan_reflects();
        let mut methods: Vec<(&'static str, Vec<NearField>)> = vec![
            ("subdivision", SIDES.iter().map(|&n| NearField::Subdivision(Some([n, n]))).collect()),
            ("monte-carlo", POINTS.iter().map(|&n| NearField::MonteCarlo(n)).collect()),
            ("profile-table", CELLS.iter().map(|&n| NearField::ProfileTable(n)).collect()),
        ];
        if let Some((_, list)) = methods.first_mut() {
            list.push(NearField::Subdivision(None));
        }
        let rungs: usize = methods.iter().map(|(_, list)| list.len()).sum();
        self.steps = (2 + TARGETS.len()) * (1 + usize::from(reflects)) + rungs;

        let (reference, truth) = self.reference(&direct, Quantity::Direct)?;
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
            let (reference, truth) = self.reference(&whole, Quantity::Total)?;
            references.push(reference);
            series.push(self.by_target(&whole, Quantity::Total, &truth)?);
        }
        let sensors = (self.scene.sensors.len(), all);
        let threads = rayon::current_num_threads();
        Ok(Accuracy { references, series, sensors, threads, leaving_out: Vec::new() })
    }

    fn session_plan_reflects(&self) -> bool {
        super::plan::Plan::new(&self.scene).runs("interreflection")
    }

    fn step(&mut self) -> Result<(), StudyError> {
        if self.progress.cancelled() {
            return Err(Cancelled.into());
        }
        self.progress.advance("accuracy", self.done, self.steps);
        self.done += 1;
        Ok(())
    }

    fn reference(&mut self, scene: &Scene, quantity: Quantity) -> Result<(Reference, Vec<f64>), StudyError> {
        let [target, second] = REFERENCE[usize::from(quantity == Quantity::Total)];
        let mut at = |target| {
            self.step()?;
            Session::new().room(&Scene { error_target: Some(target), ..scene.clone() }, &Inner(self.progress))
        };
        let (finest, second) = (at(target)?, at(second)?);
        let truth: Vec<f64> = finest.sensors.iter().map(|row| row.total().value).collect();
        let between = Rung {
            setting: String::new(),
            target: None,
            setup: 0.0,
            sky: 0.0,
            sun: None,
            errors: errors(&second, &truth),
        };
        let stated = finest.reached();
        Ok((Reference { quantity, target, stated, rms: between.rms(), max: between.max() }, truth))
    }

    fn by_target(&mut self, scene: &Scene, quantity: Quantity, truth: &[f64]) -> Result<Series, StudyError> {
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

    fn rung(&mut self, setting: String, scene: &Scene, truth: &[f64]) -> Result<Rung, StudyError> {
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
            errors: errors(&result, truth),
        })
    }
}

/// Seconds of the fastest of three runs, or of a single long one.
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

/// Of the sensors that are not in the dark.
fn errors(result: &RoomResult, truth: &[f64]) -> Vec<Errors> {
    let mean = truth.iter().sum::<f64>() / truth.len().max(1) as f64;
    result
        .sensors
        .iter()
        .zip(truth)
        .filter(|(_, truth)| **truth > DARK * mean)
        .map(|(row, truth)| {
            let e = row.total();
            Errors { stated: e.error / truth, real: (e.value - truth).abs() / truth }
        })
        .collect()
}
