//! Error against run time: a scene computed with rising effort by every method, each result beside a reference. Says what
//! the stated errors are worth, and what data at single directions lose between them.
//!
//! Without a truth from outside the reference is the ordinary method's own finest run: what is measured then is how far
//! the computation has converged, not what the method or the data leave out. A file of illuminances makes it a true error.
//!
//! The ways to integrate an aperture's light (`compute.near_field`) differ in the direct component alone and are
//! compared by it. Where surfaces reflect, the whole illuminance is a series of its own. Times are those of one thread.

pub mod annual;
mod ladder;
pub mod ranking;
mod truth;
pub mod words;

pub use ladder::{ladder, ladder_against};
pub use truth::Truth;

use super::leaving_out::LeavingOut;
use crate::compute::room::near_field::NearField;

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Straight from the apertures.
    Direct,
    /// With interreflection.
    Total,
}

/// One computation of the scene.
#[derive(Debug, Clone, Default, PartialEq)]
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
    /// Share of all light at the sensors that the computation may be off.
    pub numerical: f64,
    /// Share of all light at the sensors that the data leave open, whatever the effort.
    pub data: f64,
    /// Relative error of every sensor that counts: as stated, and against the reference.
    pub errors: Vec<Errors>,
}

/// Errors of one sensor, relative to the reference's illuminance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// What the program says: of the computation; beside a truth from outside of the data, too.
    pub stated: f64,
    /// Distance from the reference.
    pub real: f64,
    /// How far the reference itself may be off.
    pub open: f64,
}

/// A reference tells true errors where it is better than the statement that it judges by this factor ...
const CLEARLY_FINER: f64 = 3.0;
/// ... and by this one, where the distance from it is a small share of the statement, too.
const FINE_ENOUGH: f64 = 5.0;
/// A sensor that states more than so many times its true error is padded.
const PADDED: f64 = 10.0;
/// Nobody asks about errors below this share of the illuminance.
const VISIBLE: f64 = 1e-4;

impl Rung {
    /// Root of the mean square of the distances from the reference.
    pub fn rms(&self) -> f64 {
        (self.errors.iter().map(|e| e.real * e.real).sum::<f64>() / self.errors.len().max(1) as f64).sqrt()
    }

    /// At the middle one of the sensors. A reference may know nothing of a few, as those in a penumbra.
    fn median(&self, of: impl Fn(&Errors) -> f64) -> f64 {
        let mut all: Vec<f64> = self.errors.iter().map(of).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    }

    /// Medians over the sensors: what is stated, how far the reference may be off, and the distance from it.
    pub fn typical(&self) -> Errors {
        let [stated, open, real] = [self.median(|e| e.stated), self.median(|e| e.open), self.median(|e| e.real)];
        Errors { stated, real, open }
    }

    /// Largest distance from the reference.
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

    /// Is the reference good enough to tell the errors of this computation? Where it is hardly finer, the distance
    /// from it says nothing: two coarse runs may share what is wrong with both. Where it is somewhat finer and this
    /// computation lies near to it, the distance may be of either.
    pub fn is_told(&self) -> bool {
        let Errors { stated, real, open } = self.typical();
        let far = real >= stated / CLEARLY_FINER;
        open <= stated / FINE_ENOUGH || (open <= stated / CLEARLY_FINER && far)
    }

    /// More is left open by the data than by the computation.
    pub fn is_limited_by_data(&self) -> bool {
        self.data > self.numerical
    }
}

/// What stated errors are worth, as shares of all sensors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Sensors.
    pub count: usize,
    /// Stated ≥ true, as far as the reference can tell.
    pub kept: f64,
    /// Stated > 10 × true, and certainly so.
    pub padded: f64,
    /// Of these, stated above 10⁻⁴ of the illuminance; below nobody asks.
    pub padded_visibly: f64,
}

impl Coverage {
    /// Counts. The reference's own uncertainty speaks for the statement; true errors below rounding (10⁻¹²) are kept.
    pub fn of(errors: &[Errors]) -> Self {
        let share = |test: &dyn Fn(&Errors) -> bool| {
            errors.iter().filter(|e| test(e)).count() as f64 / errors.len().max(1) as f64
        };
        let padded = |e: &Errors| e.stated > PADDED * (e.real + e.open);
        Self {
            count: errors.len(),
            // Of no sensors none is off.
            kept: 1.0 - share(&|e| e.stated + e.open + 1e-12 < e.real),
            padded: share(&padded),
            padded_visibly: share(&|e| padded(e) && e.stated > VISIBLE),
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

impl Series {
    /// Of the method that a scene gets that asks for no other.
    pub fn is_ordinary(&self) -> bool {
        self.method == NearField::SolidAngle.word() || self.quantity == Quantity::Total
    }
}

/// What all is measured against.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// For which series.
    pub quantity: Quantity,
    /// Where it is from.
    pub origin: Origin,
    /// The largest relative error that it states itself.
    pub stated: f64,
}

/// Where a reference is from.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// The ordinary method with more effort than any rung.
    FinestRun {
        /// Its error target.
        target: f64,
        /// Relative RMS distance from the second finest.
        rms: f64,
        /// Largest relative distance from the second finest.
        max: f64,
    },
    /// From outside: a file of this name.
    Given(String),
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
    /// Coverage of the ordinary method over all its rungs that the reference can tell of, direct and total.
    pub fn ordinary_coverage(&self) -> Coverage {
        let rungs = self.series.iter().filter(|series| series.is_ordinary()).flat_map(|series| &series.rungs);
        let errors: Vec<Errors> =
            rungs.filter(|rung| rung.is_told()).flat_map(|rung| rung.errors.iter().copied()).collect();
        Coverage::of(&errors)
    }

    /// What a series is measured against.
    pub fn reference(&self, quantity: Quantity) -> Option<&Reference> {
        self.references.iter().find(|reference| reference.quantity == quantity)
    }

    /// Is a series measured against a truth from outside?
    pub fn is_true(&self, quantity: Quantity) -> bool {
        self.reference(quantity).is_some_and(|reference| matches!(reference.origin, Origin::Given(_)))
    }
}
