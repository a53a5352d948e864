//! Error against computing time: a scene computed with rising effort by every method, each result compared with a
//! reference. Evaluates also the reliability of the stated errors, and the error by interpolation of data between
//! single incident directions.
//!
//! Without an external reference, the reference is the finest run of the default method: the errors then show how far
//! the computation has converged, not what the method or the data leave out. With a file of illuminances they are true
//! errors.
//!
//! Methods of integrating the light of an aperture at a sensor (`compute.near_field`) differ in the direct component
//! alone and are compared by it. If surfaces reflect, the total illuminance (direct and interreflected) is a separate
//! series. Times are those of one thread.

pub mod annual;
mod ladder;
pub mod ranking;
mod truth;
pub mod words;

pub use ladder::{ladder, ladder_against};
pub use truth::Truth;

use super::leaving_out::LeavingOut;
use crate::compute::room::near_field::NearField;

/// Component of the illuminance at the sensors that is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Direct component: from the apertures without reflection in the room.
    Direct,
    /// Total illuminance: direct and interreflected.
    Total,
}

/// One computation of the scene, with a certain effort: its computing times and its errors.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rung {
    /// Description of the effort, such as the error target or the number of point luminaires.
    pub setting: String,
    /// Relative error target; `None` if the effort was set directly.
    pub target: Option<f64>,
    /// Computing time of the first sky in addition to that of a later one: preparation of the room. \[s\]
    pub setup: f64,
    /// Computing time of the illuminances under a new sky in the same room. \[s\]
    pub sky: f64,
    /// Computing time for the update after the sun has moved; `None` if the sun does not shine in. \[s\]
    pub sun: Option<f64>,
    /// Numerical error of the illuminances: sum of the sensors' errors, relative to the sum of their illuminances.
    pub numerical: f64,
    /// Uncertainty of the illuminances by the BSDF data: sum over the sensors, relative to the sum of their
    /// illuminances; independent of the effort.
    pub data: f64,
    /// Errors of every sensor that is not dark (above 1 % of the mean illuminance), stated and against the reference,
    /// relative to the reference's illuminance.
    pub errors: Vec<Errors>,
}

/// Stated and actual error of the illuminance at one sensor, relative to the illuminance of the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Error that the program states: of the computation; where the reference is an external file, also the uncertainty
    /// by the BSDF data.
    pub stated: f64,
    /// Actual error: absolute difference from the reference.
    pub real: f64,
    /// Uncertainty of the reference.
    pub open: f64,
}

/// Minimum ratio of the stated error to the reference's uncertainty at which an actual error can be determined if it is
/// large.
const CLEARLY_FINER: f64 = 3.0;
/// Minimum ratio of the stated error to the reference's uncertainty at which an actual error of any size can be
/// determined.
const FINE_ENOUGH: f64 = 5.0;
/// Ratio of the stated to the actual error above which a sensor's stated error counts as padded (needlessly large).
const PADDED: f64 = 10.0;
/// Relative error of an illuminance below which errors are not relevant.
const VISIBLE: f64 = 1e-4;

impl Rung {
    /// Returns the root mean square over the sensors of the relative differences from the reference.
    pub fn rms(&self) -> f64 {
        (self.errors.iter().map(|e| e.real * e.real).sum::<f64>() / self.errors.len().max(1) as f64).sqrt()
    }

    /// Returns the median over the sensors of the value that `of` selects. A reference may be uncertain at a few of
    /// them, such as those in a penumbra.
    fn median(&self, of: impl Fn(&Errors) -> f64) -> f64 {
        let mut all: Vec<f64> = self.errors.iter().map(of).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    }

    /// Returns the medians over the sensors of stated error, uncertainty of the reference, and difference from the
    /// reference; all relative.
    pub fn typical(&self) -> Errors {
        let [stated, open, real] = [self.median(|e| e.stated), self.median(|e| e.open), self.median(|e| e.real)];
        Errors { stated, real, open }
    }

    /// Returns the largest relative difference from the reference over the sensors.
    pub fn max(&self) -> f64 {
        self.errors.iter().map(|e| e.real).fold(0.0, f64::max)
    }

    /// Returns the largest relative error that is stated at any sensor.
    pub fn reached(&self) -> f64 {
        self.errors.iter().map(|e| e.stated).fold(0.0, f64::max)
    }

    /// Returns the reliability of the stated errors: shares of the sensors at which the actual error is within the
    /// stated one, or far below it.
    pub fn coverage(&self) -> Coverage {
        Coverage::of(&self.errors)
    }

    /// Whether the reference is good enough to determine the errors of this computation. If its uncertainty is hardly
    /// smaller than the stated errors, the difference from it means nothing: two coarse runs may share the same errors.
    /// If it is somewhat smaller and this computation is close to the reference, the difference may be the error of
    /// either.
    pub fn is_determined(&self) -> bool {
        let Errors { stated, real, open } = self.typical();
        let far = real >= stated / CLEARLY_FINER;
        open <= stated / FINE_ENOUGH || (open <= stated / CLEARLY_FINER && far)
    }

    /// Whether the uncertainty by the BSDF data exceeds the numerical error, so that more effort does not help.
    pub fn is_limited_by_data(&self) -> bool {
        self.data > self.numerical
    }
}

/// Reliability of stated errors, as shares of all sensors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Number of sensors that were compared.
    pub count: usize,
    /// Share of the sensors with an actual error within the stated error and the reference's uncertainty.
    pub kept: f64,
    /// Share of the sensors whose stated error is above 10 times the actual error and the reference's uncertainty
    /// together.
    pub padded: f64,
    /// Share of the sensors whose stated error is padded in this sense and above 10⁻⁴ of the illuminance; smaller ones
    /// are not relevant.
    pub padded_visibly: f64,
}

impl Coverage {
    /// Counts the sensors by their errors. The reference's uncertainty is added to the stated error; actual errors
    /// below rounding (10⁻¹²) count as within it.
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

/// Computations by one method with rising effort.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Key that a scene file uses for the method (`compute.near_field`); `room` for the series of the total
    /// illuminance.
    pub method: &'static str,
    /// Component of the illuminance that the series compares.
    pub quantity: Quantity,
    /// Computations of the series, by rising effort.
    pub rungs: Vec<Rung>,
}

impl Series {
    /// Whether the series was computed by the default method of integrating an aperture's light.
    pub fn is_ordinary(&self) -> bool {
        self.method == NearField::SolidAngle.word() || self.quantity == Quantity::Total
    }
}

/// Reference with which the illuminances of a series are compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Component of the illuminance that the reference gives.
    pub quantity: Quantity,
    /// Origin of the reference: a run of this program or an external file.
    pub origin: Origin,
    /// Largest relative error that the reference states for itself, over sensors that are not dark.
    pub stated: f64,
}

/// Origin of a reference.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// Finest run of the default method, with more effort than any computation of the series.
    FinestRun {
        /// Relative error target of the run.
        target: f64,
        /// Root mean square over the sensors of the relative difference from the second finest run.
        rms: f64,
        /// Largest relative difference from the second finest run at any sensor.
        max: f64,
    },
    /// External file of illuminances, by its name.
    Given(String),
}

/// Result of comparing all methods on one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// References, one for each component of the illuminance.
    pub references: Vec<Reference>,
    /// Series of computations, one for each method and component of the illuminance.
    pub series: Vec<Series>,
    /// Number of sensors that were computed, and of all sensors of the scene.
    pub sensors: (usize, usize),
    /// Number of threads with which the computing times were measured.
    pub threads: usize,
    /// Errors of interpolation between single incident directions, by dataset. They are not part of the errors in the
    /// series, because the reference interpolates too.
    pub leaving_out: Vec<LeavingOut>,
}

impl Accuracy {
    /// Returns the reliability of the errors stated by the default method, over all computations whose errors the
    /// reference can determine, direct and total.
    pub fn ordinary_coverage(&self) -> Coverage {
        let rungs = self.series.iter().filter(|series| series.is_ordinary()).flat_map(|series| &series.rungs);
        let errors: Vec<Errors> =
            rungs.filter(|rung| rung.is_determined()).flat_map(|rung| rung.errors.iter().copied()).collect();
        Coverage::of(&errors)
    }

    /// Returns the reference for a component of the illuminance; `None` if it was not compared.
    pub fn reference(&self, quantity: Quantity) -> Option<&Reference> {
        self.references.iter().find(|reference| reference.quantity == quantity)
    }

    /// Whether a component is compared with an external reference, so that the errors are true errors.
    pub fn is_true(&self, quantity: Quantity) -> bool {
        self.reference(quantity).is_some_and(|reference| matches!(reference.origin, Origin::Given(_)))
    }
}
