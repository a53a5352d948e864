//! Error against run time: a scene computed with rising effort by every method, each result compared with a reference.
//! Evaluates the reliability of the stated errors, and the loss by data at single directions between these.
//!
//! Without an external reference, the reference is the finest run of the default method: the errors then show how far
//! the computation has converged, not what the method or the data leave out. With a file of illuminances they are true
//! errors.
//!
//! Methods of integrating an aperture's light (`compute.near_field`) differ in the direct component alone and are
//! compared by it. If surfaces reflect, the whole illuminance is a separate series. Times are those of one thread.

pub mod annual;
mod ladder;
pub mod ranking;
mod truth;
pub mod words;

pub use ladder::{ladder, ladder_against};
pub use truth::Truth;

use super::leaving_out::LeavingOut;
use crate::compute::room::near_field::NearField;

/// Illuminance that is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Direct component from the apertures.
    Direct,
    /// All light, with interreflection.
    Total,
}

/// One computation of the scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rung {
    /// Description of the effort.
    pub setting: String,
    /// Requested relative error; `None` if the effort was set directly.
    pub target: Option<f64>,
    /// Additional time of the first sky, compared with later ones. \[s\]
    pub setup: f64,
    /// Time of a new sky in the same room. \[s\]
    pub sky: f64,
    /// Time of a new sun position; `None` if the sun does not shine in. \[s\]
    pub sun: Option<f64>,
    /// Numerical error of all light at the sensors, relative to it.
    pub numerical: f64,
    /// Uncertainty by the data of all light at the sensors, relative to it; independent of the effort.
    pub data: f64,
    /// Errors of every sensor that counts, stated and against the reference, relative to its illuminance.
    pub errors: Vec<Errors>,
}

/// Errors of one sensor, relative to the reference's illuminance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Error that the program states: of the computation; compared with an external reference, of the data too.
    pub stated: f64,
    /// Distance from the reference.
    pub real: f64,
    /// Uncertainty of the reference itself.
    pub open: f64,
}

/// Minimum ratio of the stated error to the reference's uncertainty at which the reference determines a large error.
const CLEARLY_FINER: f64 = 3.0;
/// Minimum ratio of the stated error to the reference's uncertainty at which the reference determines an error of any
/// size.
const FINE_ENOUGH: f64 = 5.0;
/// Ratio of the stated to the true error above which a sensor's statement is padded.
const PADDED: f64 = 10.0;
/// Share of the illuminance below which errors are not relevant.
const VISIBLE: f64 = 1e-4;

impl Rung {
    /// Returns the root mean square of the distances from the reference.
    pub fn rms(&self) -> f64 {
        (self.errors.iter().map(|e| e.real * e.real).sum::<f64>() / self.errors.len().max(1) as f64).sqrt()
    }

    /// Returns the median over the sensors. A reference may be uncertain at a few of them, such as those in a penumbra.
    fn median(&self, of: impl Fn(&Errors) -> f64) -> f64 {
        let mut all: Vec<f64> = self.errors.iter().map(of).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    }

    /// Returns the medians over the sensors: stated error, uncertainty of the reference, and distance from it.
    pub fn typical(&self) -> Errors {
        let [stated, open, real] = [self.median(|e| e.stated), self.median(|e| e.open), self.median(|e| e.real)];
        Errors { stated, real, open }
    }

    /// Returns the largest distance from the reference.
    pub fn max(&self) -> f64 {
        self.errors.iter().map(|e| e.real).fold(0.0, f64::max)
    }

    /// Returns the largest stated error.
    pub fn reached(&self) -> f64 {
        self.errors.iter().map(|e| e.stated).fold(0.0, f64::max)
    }

    /// Returns the shares of the sensors that keep to the stated error, or state much more.
    pub fn coverage(&self) -> Coverage {
        Coverage::of(&self.errors)
    }

    /// Whether the reference is good enough to determine the errors of this computation. If it is hardly finer, the
    /// distance from it means nothing: two coarse runs may share the same errors. If it is somewhat finer and this
    /// computation is close to it, the distance may be the error of either.
    pub fn is_determined(&self) -> bool {
        let Errors { stated, real, open } = self.typical();
        let far = real >= stated / CLEARLY_FINER;
        open <= stated / FINE_ENOUGH || (open <= stated / CLEARLY_FINER && far)
    }

    /// Whether the data are less certain than the computation.
    pub fn is_limited_by_data(&self) -> bool {
        self.data > self.numerical
    }
}

/// Reliability of stated errors, as shares of all sensors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Number of sensors.
    pub count: usize,
    /// Share with a stated error not below the true one, within the reference's uncertainty.
    pub kept: f64,
    /// Share with a stated error above 10 times the true one, beyond the reference's uncertainty.
    pub padded: f64,
    /// Share that is padded with a stated error above 10⁻⁴ of the illuminance; smaller ones are not relevant.
    pub padded_visibly: f64,
}

impl Coverage {
    /// Counts the sensors. The reference's uncertainty is credited to the statement; true errors below rounding (10⁻¹²)
    /// are kept.
    pub fn of(errors: &[Errors]) -> Self {
        let share = |test: &dyn Fn(&Errors) -> bool| {
            errors.iter().filter(|e| test(e)).count() as f64 / errors.len().max(1) as f64
        };
        let padded = |e: &Errors| e.stated > PADDED * (e.real + e.open);
        Self {
            count: errors.len(),
            // Without sensors none is off.
            kept: 1.0 - share(&|e| e.stated + e.open + 1e-12 < e.real),
            padded: share(&padded),
            padded_visibly: share(&|e| padded(e) && e.stated > VISIBLE),
        }
    }
}

/// One method with rising effort.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Key of the method in scenes; `room` for the whole illuminance.
    pub method: &'static str,
    /// Illuminance that is compared.
    pub quantity: Quantity,
    /// Computations by rising effort.
    pub rungs: Vec<Rung>,
}

impl Series {
    /// Whether the series is of the default method.
    pub fn is_ordinary(&self) -> bool {
        self.method == NearField::SolidAngle.word() || self.quantity == Quantity::Total
    }
}

/// Reference that results are compared with.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Quantity of the reference.
    pub quantity: Quantity,
    /// Source of the reference.
    pub origin: Origin,
    /// Largest relative error that the reference states itself.
    pub stated: f64,
}

/// Source of a reference.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// Finest run of the default method, with more effort than any computation of the series.
    FinestRun {
        /// Error target of the run.
        target: f64,
        /// Relative RMS distance from the second finest run.
        rms: f64,
        /// Largest relative distance from the second finest run.
        max: f64,
    },
    /// External file of this name.
    Given(String),
}

/// Whole comparison of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// References, one for each quantity.
    pub references: Vec<Reference>,
    /// Series, one for each method and quantity.
    pub series: Vec<Series>,
    /// Number of computed sensors, and of all sensors.
    pub sensors: (usize, usize),
    /// Number of threads used for the times.
    pub threads: usize,
    /// Errors of interpolation between single directions, by dataset: not part of the series, whose reference
    /// interpolates too.
    pub leaving_out: Vec<LeavingOut>,
}

impl Accuracy {
    /// Returns the coverage of the default method over all computations whose errors the reference can determine,
    /// direct and total.
    pub fn ordinary_coverage(&self) -> Coverage {
        let rungs = self.series.iter().filter(|series| series.is_ordinary()).flat_map(|series| &series.rungs);
        let errors: Vec<Errors> =
            rungs.filter(|rung| rung.is_determined()).flat_map(|rung| rung.errors.iter().copied()).collect();
        Coverage::of(&errors)
    }

    /// Returns the reference of a series.
    pub fn reference(&self, quantity: Quantity) -> Option<&Reference> {
        self.references.iter().find(|reference| reference.quantity == quantity)
    }

    /// Whether a series is compared with an external reference.
    pub fn is_true(&self, quantity: Quantity) -> bool {
        self.reference(quantity).is_some_and(|reference| matches!(reference.origin, Origin::Given(_)))
    }
}
