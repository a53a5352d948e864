//! Virtual goniophotometer: BTDF and BRDF of a described system, from both sides, as means over the incident **and**
//! the emergent cells.
//!
//! # Directions of undeviated light
//! Every direction, also a reflected one, is given by its *direction of undeviated light*, a unit vector on the outward
//! half (z > 0 in the façade frame) that is the same before and after the system for light that passes undeviated, and
//! also for its mirror image. In the code it is called `direction`:
//! * light from outside: lateral part = −(x, y) of the direction in which light **travels**, before and after the
//!   system, transmitted or reflected (for incident light it is the direction towards the source);
//! * light from inside: lateral part = +(x, y) of the direction in which light travels.
//!
//! By these directions reciprocity reads T_back(a → b) = T_front(b → a), and R(a → b) = R(b̄ → ā) on either side, where
//! the bar rotates a direction by 180° about the normal.

pub mod beams;
mod cells;
pub mod directions;
pub mod fan;
pub mod kept;
pub mod merged;
mod parallel;
mod profile_light;
mod reciprocal;
pub mod upright;

pub use parallel::{Beam, ScatteredLight};
pub use profile_light::ProfileLight;

use crate::compute::basis::{AzimuthMap, RingBasis, same_cells};
use crate::compute::btdf::{Band, Btdf, CellMatrix, Component};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};

/// Returns the basis of the data of computed systems: LBNL/Klems Full, numbered as for light from outside.
pub fn front_basis() -> RingBasis {
    RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
}

/// Side of a system that light comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// Light from outside.
    Front,
    /// Light from the room.
    Back,
}

impl Side {
    /// Both sides: outside, then room side.
    pub const BOTH: [Self; 2] = [Self::Front, Self::Back];
}

/// Settings of a computation of BSDF data: incident and emergent cells, allowed error, seed of random numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting<'a> {
    /// Incident cells, which contain directions of undeviated light (see [`self`]).
    pub incident: &'a RingBasis,
    /// Emergent cells, which contain directions of undeviated light (see [`self`]).
    pub emergent: &'a RingBasis,
    /// Allowed absolute error of the direct-hemispherical transmittance and reflectance of any incident cell. The
    /// effort of the computation follows from it.
    pub error: f64,
    /// Seed of random numbers. The same seed gives the same values on any number of threads.
    pub seed: u64,
}

/// Scattering of light from one side of a system, as means over incident and emergent cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OneSide {
    /// Mean luminance coefficient q of transmitted light from incident cell i into emergent cell o, at index
    /// `i · emergent.len() + o`. \[1/sr\]
    pub transmitted: Vec<f64>,
    /// Mean luminance coefficient q of reflected light from incident cell i into emergent cell o, at index
    /// `i · emergent.len() + o`. \[1/sr\]
    pub reflected: Vec<f64>,
    /// Absorptance for light of each incident cell. Computed independently of τ and ρ, not as 1 − τ − ρ, wherever the
    /// method allows it.
    pub absorbed: Vec<f64>,
    /// Estimated absolute error of the direct-hemispherical τ and ρ of each incident cell.
    pub error: Vec<f64>,
}

/// Computed transmission and reflection of a system from both sides as patch-averaged data, with absorption and errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Incident cells of the data.
    pub incident: RingBasis,
    /// Emergent cells of the data.
    pub emergent: RingBasis,
    /// Scattering of light from outside.
    pub front: OneSide,
    /// Scattering of light from inside.
    pub back: OneSide,
}

/// Symmetry of a system's structure (slats, prisms, holes), which decides how much the light of neighbouring directions
/// can differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Structure {
    /// No structure: scattering changes little between neighbouring directions.
    Even,
    /// Structure endless along one axis: scattering of neighbouring directions differs by their profile angle only.
    Along {
        /// Whether the structure runs along y (vertically); otherwise it runs along x.
        upright: bool,
    },
    /// Any other structure.
    Any,
}

impl Structure {
    /// Returns the structure of two layers, one behind the other.
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Even, other) => other,
            (own, Self::Even) => own,
            (own, other) if own == other => own,
            _ => Self::Any,
        }
    }

    /// Returns the structure of a system rotated by 90° about its normal.
    pub const fn turned(self) -> Self {
        match self {
            Self::Along { upright } => Self::Along { upright: !upright },
            same => same,
        }
    }
}

/// Angle below which two directions of undeviated light count as the same. \[rad\] Above all rounding of f64, and
/// 0.0002″.
const SAME_DIRECTION: f64 = 1e-9;

/// Optical model of a system: computes its scattering for any direction.
pub trait OpticalModel: Send + Sync {
    /// Computes transmission and reflection of both sides as means over the cells of `setting`, within its allowed
    /// error.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled>;

    /// Returns the data of [`Self::measure`] for both sides, for systems that keep light in its cell and act on all
    /// azimuths alike, with one coefficient for each cell instead of one for each pair of cells; `None` for other
    /// systems. The incident cells of `setting` are the emergent ones.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    fn by_cell(&self, _setting: &Setting<'_>, _progress: &dyn Progress) -> Result<Option<[OneSide; 2]>, Cancelled> {
        Ok(None)
    }

    /// Computes BSDF data of both sides on the cells of `setting`, as one band (visible or solar), and their quality.
    /// Regular transmission and reflection are stored separately where they depend on the polar angle only; otherwise
    /// they are spread over their cells.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    fn examine(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<(Band, Quality), Cancelled> {
        let measured = self.measure(setting, progress)?;
        Ok((measured.band(), measured.quality()))
    }

    /// Returns the exact beams that parallel light from `side` becomes: undeviated, redirected and mirrored ones.
    /// `direction` is the direction of undeviated light (see [`self`]), for light from outside the direction towards
    /// the source. Light that rough mirrors or edges spread is not among the beams.
    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam>;

    /// Returns the share of parallel light from `side` that is transmitted undeviated; `direction`: direction of
    /// undeviated light.
    fn straight(&self, direction: Dir<Facade>, side: Side) -> f64 {
        let same = |other: &Dir<Facade>| other.vector().distance(direction.vector()) < SAME_DIRECTION;
        let on = |beam: &Beam| beam.transmitted && beam.directions.iter().all(same);
        self.beams(direction, side).iter().filter(|beam| on(beam)).map(|beam| beam.share).sum()
    }

    /// Returns the axis of the structure if scattering depends on the profile angle only, while the direction cosine
    /// along the structure stays unchanged: `Some(true)` for a structure along y (profile angle to the right),
    /// `Some(false)` for one along x.
    fn by_profile_alone(&self) -> Option<bool> {
        None
    }

    /// Returns beams like [`Self::beams`], but for a direction at most `within` \[rad\] from `direction`, so that
    /// neighbouring directions can share one result.
    fn beams_about(&self, direction: Dir<Facade>, side: Side, _within: f64) -> Vec<Beam> {
        self.beams(direction, side)
    }

    /// Returns the symmetry of the system's structure, which decides how much the light of neighbouring directions can
    /// differ.
    fn structure(&self) -> Structure {
        Structure::Any
    }

    /// Whether the light of a single direction is computed within a millisecond, so that thousands of directions can
    /// be.
    fn is_quick(&self) -> bool {
        true
    }

    /// Whether [`Self::examine`] stores undeviated light separately, as regular transmission.
    fn separates_regular(&self) -> bool {
        false
    }

    /// Returns the scattered transmitted light as a function of the profile angle, if it depends on nothing else;
    /// [`Self::scattered`] then gives the same light by cells. `None` otherwise.
    fn profile_light(&self, _name: Dir<Facade>, _side: Side) -> Option<ProfileLight> {
        None
    }

    /// Returns the scattered light, all that is not in beams, as means over the emergent cells, for parallel light from
    /// `side` in the direction of undeviated light `direction`.
    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight;

    /// Returns scattered light like [`Self::scattered`], for callers that need the transmitted light only: the
    /// reflected part may be empty.
    fn scattered_through(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        self.scattered(direction, side, emergent)
    }

    /// Returns the memory of the results that are cached for further directions. \[bytes\]
    fn bytes(&self) -> usize {
        0
    }
}

/// Quality of computed data: energy balance, reciprocity and estimated error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// Energy balance: largest |τ + ρ + α − 1| over the incident cells of both sides.
    pub balance: f64,
    /// Deviation from reciprocity: Σ |T_front(a→b) − T_back(b→a)| over the mean flux of both, weighted by projected
    /// solid angles; `None` where the incident cells are not the emergent ones, or nothing is transmitted.
    pub reciprocity: Option<f64>,
    /// Largest estimated absolute error of τ and ρ over the incident cells of both sides.
    pub error: f64,
}

impl Quality {
    /// Returns the worse value of two qualities for each of the three figures.
    pub fn worse(self, other: Self) -> Self {
        let reciprocity = match (self.reciprocity, other.reciprocity) {
            (Some(a), Some(b)) => Some(a.max(b)),
            (a, b) => a.or(b),
        };
        Self { balance: self.balance.max(other.balance), reciprocity, error: self.error.max(other.error) }
    }
}

impl OneSide {
    /// Creates data with every value 0, for `n` incident cells and `count` coefficients of transmission, and as many of
    /// reflection.
    pub fn dark(n: usize, count: usize) -> Self {
        let [transmitted, reflected] = [vec![0.0; count], vec![0.0; count]];
        Self { transmitted, reflected, absorbed: vec![0.0; n], error: vec![0.0; n] }
    }
}

impl Measured {
    /// Creates data on the cells of a setting with every value 0.
    pub fn dark(setting: &Setting<'_>) -> Self {
        let (n, m) = (setting.incident.len(), setting.emergent.len());
        let [front, back] = [OneSide::dark(n, n * m), OneSide::dark(n, n * m)];
        Self { incident: setting.incident.clone(), emergent: setting.emergent.clone(), front, back }
    }

    /// Returns the scattering of light from `side`.
    pub const fn seen(&self, side: Side) -> &OneSide {
        match side {
            Side::Front => &self.front,
            Side::Back => &self.back,
        }
    }

    /// Returns the scattering of light from `side`, to be filled in.
    pub const fn seen_mut(&mut self, side: Side) -> &mut OneSide {
        match side {
            Side::Front => &mut self.front,
            Side::Back => &mut self.back,
        }
    }

    /// Returns the direct-hemispherical transmittance or reflectance of every incident cell from its coefficients `q`
    /// \[1/sr\] by emergent cell.
    pub fn shares(&self, q: &[f64]) -> Vec<f64> {
        let weight = self.emergent.projected_solid_angles();
        q.chunks_exact(weight.len()).map(|row| row.iter().zip(&weight).map(|(q, w)| q * w).sum()).collect()
    }

    /// Returns the data as one band (visible or solar) of patch-averaged BSDF data.
    pub fn band(&self) -> Band {
        let mut band = Band::default();
        let mut set = |component, values: &[f64]| {
            let matrix = CellMatrix::new(self.incident.clone(), self.emergent.clone(), values.to_vec());
            band.set(component, Btdf::from_cells(matrix.expect("values are counted by these cells")));
        };
        set(Component::TransmissionFront, &self.front.transmitted);
        set(Component::TransmissionBack, &self.back.transmitted);
        set(Component::ReflectionFront, &self.front.reflected);
        set(Component::ReflectionBack, &self.back.reflected);
        band
    }

    /// Returns the quality of the data: energy balance, reciprocity and estimated error.
    pub fn quality(&self) -> Quality {
        let mut balance: f64 = 0.0;
        let mut error: f64 = 0.0;
        for side in Side::BOTH {
            let seen = self.seen(side);
            let (t, r) = (self.shares(&seen.transmitted), self.shares(&seen.reflected));
            for ((t, r), a) in t.iter().zip(&r).zip(&seen.absorbed) {
                balance = balance.max((t + r + a - 1.0).abs());
            }
            error = seen.error.iter().copied().fold(error, f64::max);
        }
        Quality { balance, reciprocity: self.reciprocity(), error }
    }

    /// Returns the deviation from reciprocity of [`Quality::reciprocity`].
    fn reciprocity(&self) -> Option<f64> {
        let same = same_cells(&self.emergent, &self.incident)?;
        let weight = self.incident.projected_solid_angles();
        let n = weight.len();
        let (mut difference, mut flux) = (0.0, 0.0);
        for i in 0..n {
            for o in 0..n {
                let there = self.front.transmitted[i * n + same[o]];
                let back = self.back.transmitted[o * n + same[i]];
                difference += (there - back).abs() * weight[i] * weight[o];
                flux += 0.5 * (there + back) * weight[i] * weight[o];
            }
        }
        (flux > 0.0).then(|| difference / flux)
    }
}
