//! The numerical goniophotometer: BTDF and BRDF of a described system, from both sides, as means over the incident
//! **and** the emergent cells.
//!
//! # Names of directions
//! Every direction is named by a vector on the outward half (z > 0 in the façade frame), so that light that goes
//! straight through keeps its name, and so does a mirror image:
//! * light from outside: lateral part of the name = −(x, y) of the direction in which light **travels**, before and
//!   after the system, transmitted or thrown back (an incident name is the direction towards the source);
//! * light from inside: lateral part = +(x, y) of the direction in which light travels.
//!
//! In these names reciprocity reads T_back(a → b) = T_front(b → a), and R(a → b) = R(b̄ → ā) on either side, the bar
//! turning a name by 180° about the normal.

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

/// The cells that computed systems are given on: LBNL/Klems Full, as light from outside names them.
pub fn front_basis() -> RingBasis {
    RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
}

/// The side that light comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// Outside.
    Front,
    /// The room.
    Back,
}

impl Side {
    /// Both, front first.
    pub const BOTH: [Self; 2] = [Self::Front, Self::Back];
}

/// What is asked of a measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting<'a> {
    /// Incident cells, in through-names.
    pub incident: &'a RingBasis,
    /// Emergent cells, in through-names.
    pub emergent: &'a RingBasis,
    /// Absolute error that is allowed in the directional-hemispherical transmittance and reflectance of any incident
    /// cell. The program chooses its effort by it.
    pub error: f64,
    /// Seed of whatever is drawn at random. The same seed gives the same values on any number of threads.
    pub seed: u64,
}

/// What light from one side does.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OneSide {
    /// q of transmitted light, `[i · emergent.len() + o]`. \[1/sr\]
    pub transmitted: Vec<f64>,
    /// q of light thrown back, the same order. \[1/sr\]
    pub reflected: Vec<f64>,
    /// Share that is absorbed, an incident cell. Counted on its own, not as the rest, wherever the method can.
    pub absorbed: Vec<f64>,
    /// Estimated absolute error of τ and ρ, an incident cell.
    pub error: Vec<f64>,
}

/// The four functions on cells, with what is known about their quality.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Incident cells.
    pub incident: RingBasis,
    /// Emergent cells.
    pub emergent: RingBasis,
    /// Light from outside.
    pub front: OneSide,
    /// Light from inside.
    pub back: OneSide,
}

/// Which way the structure runs that light of neighbouring directions meets or misses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Structure {
    /// There is none: neighbouring directions fare alike.
    Even,
    /// Endless along one axis: whether neighbours fare unlike is a matter of the profile angle alone. `upright`: along y.
    Along {
        /// Along y, not along x.
        upright: bool,
    },
    /// Any other.
    Any,
}

impl Structure {
    /// Of two layers together.
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Even, other) => other,
            (own, Self::Even) => own,
            (own, other) if own == other => own,
            _ => Self::Any,
        }
    }

    /// Turned by 90°.
    pub const fn turned(self) -> Self {
        match self {
            Self::Along { upright } => Self::Along { upright: !upright },
            same => same,
        }
    }
}

/// Names of directions nearer than this are the same. \[rad\]
const SAME_NAME: f64 = 1e-9;

/// Something whose scattering can be computed.
pub trait Specimen: Send + Sync {
    /// The four functions on the cells of `setting`, to its error.
    ///
    /// # Errors
    /// [`Cancelled`] when `progress` says so.
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled>;

    /// The four functions as the rest of the program holds them, and their quality. Light that goes straight on or is
    /// mirrored is kept apart where it depends on the polar angle alone; otherwise it is spread over its cells.
    ///
    /// # Errors
    /// [`Cancelled`] when `progress` says so.
    fn examine(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<(Band, Quality), Cancelled> {
        let measured = self.measure(setting, progress)?;
        Ok((measured.band(), measured.quality()))
    }

    /// The beams that parallel light of one name from a side becomes, exactly: straight on (the name kept), deflected,
    /// mirrored. What mirrors or edges spread is not among them.
    fn beams(&self, name: Dir<Facade>, side: Side) -> Vec<Beam>;

    /// Share of parallel light that goes straight on.
    fn straight(&self, name: Dir<Facade>, side: Side) -> f64 {
        let same = |other: &Dir<Facade>| other.vector().distance(name.vector()) < SAME_NAME;
        let on = |beam: &Beam| beam.transmitted && beam.names.iter().all(same);
        self.beams(name, side).iter().filter(|beam| on(beam)).map(|beam| beam.share).sum()
    }

    /// Is what becomes of light a matter of its profile angle alone, the direction cosine along the structure kept? `true`
    /// inside: of the angle to the right, for a structure along y.
    fn by_profile_alone(&self) -> Option<bool> {
        None
    }

    /// The same of a direction no farther than `within` \[rad\] from the name, so that neighbours may share an answer.
    fn beams_about(&self, name: Dir<Facade>, side: Side, _within: f64) -> Vec<Beam> {
        self.beams(name, side)
    }

    /// What light of neighbouring directions meets or misses.
    fn structure(&self) -> Structure {
        Structure::Any
    }

    /// Are single directions answered in microseconds to a millisecond, so that thousands may be asked?
    fn is_quick(&self) -> bool {
        true
    }

    /// Does [`Self::examine`] keep light apart that goes straight on?
    fn keeps_regular_apart(&self) -> bool {
        false
    }

    /// What is transmitted besides, where that depends on a profile angle alone; then [`Self::scattered`] gives the same
    /// by cells.
    fn profile_light(&self, _name: Dir<Facade>, _side: Side) -> Option<ProfileLight> {
        None
    }

    /// What else becomes of it, on emergent cells.
    fn scattered(&self, name: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight;

    /// The same for whoever asks for what is transmitted alone: what is thrown back may be left out.
    fn scattered_through(&self, name: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        self.scattered(name, side, emergent)
    }
}

/// Balance and reciprocity of a measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// Largest |τ + ρ + α − 1| over the incident cells of both sides.
    pub balance: f64,
    /// Σ |T_front(a→b) − T_back(b→a)| over the flux of both, weighted by projected solid angles; `None` where the
    /// incident cells are not the emergent ones, or nothing passes.
    pub reciprocity: Option<f64>,
    /// Largest estimated absolute error of τ and ρ.
    pub error: f64,
}

impl Quality {
    /// Of two bands together: the worse of each.
    pub fn worse(self, other: Self) -> Self {
        let reciprocity = match (self.reciprocity, other.reciprocity) {
            (Some(a), Some(b)) => Some(a.max(b)),
            (a, b) => a.or(b),
        };
        Self { balance: self.balance.max(other.balance), reciprocity, error: self.error.max(other.error) }
    }
}

/// Zeros for a matrix on fine cells, whose pages are there when they are written to and gone when it is dropped: the C
/// library of Linux keeps freed blocks below 32 MiB to itself once it has seen one of their size, and a window that
/// computes one stack after the other held twice what it used. What is reserved beyond `count` is never touched.
pub fn zeros(count: usize) -> Vec<f64> {
    const LARGE: usize = 1 << 18;
    const OWN_PAGES: usize = (32 << 20) / size_of::<f64>() + LARGE;
    let mut block = vec![0.0; if cfg!(target_os = "linux") && count >= LARGE { count.max(OWN_PAGES) } else { count }];
    block.truncate(count);
    block
}

impl Measured {
    /// Nothing yet on the cells of a setting: every value 0.
    pub fn dark(setting: &Setting<'_>) -> Self {
        let (n, m) = (setting.incident.len(), setting.emergent.len());
        let seen = || OneSide {
            transmitted: zeros(n * m),
            reflected: zeros(n * m),
            absorbed: vec![0.0; n],
            error: vec![0.0; n],
        };
        let [front, back] = [seen(), seen()];
        Self { incident: setting.incident.clone(), emergent: setting.emergent.clone(), front, back }
    }

    /// Light from one side.
    pub const fn seen(&self, side: Side) -> &OneSide {
        match side {
            Side::Front => &self.front,
            Side::Back => &self.back,
        }
    }

    /// Light from one side, to be filled in.
    pub const fn seen_mut(&mut self, side: Side) -> &mut OneSide {
        match side {
            Side::Front => &mut self.front,
            Side::Back => &mut self.back,
        }
    }

    /// Directional-hemispherical transmittance or reflectance of every incident cell.
    pub fn shares(&self, q: &[f64]) -> Vec<f64> {
        let weight = self.emergent.projected_solid_angles();
        q.chunks_exact(weight.len()).map(|row| row.iter().zip(&weight).map(|(q, w)| q * w).sum()).collect()
    }

    /// The four functions as the rest of the program holds them.
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

    /// Balance and reciprocity.
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

    fn reciprocity(&self) -> Option<f64> {
        let same = same_cells(&self.emergent, &self.incident)?;
        let weight = self.incident.projected_solid_angles();
        let n = weight.len();
        let (mut apart, mut flux) = (0.0, 0.0);
        for i in 0..n {
            for o in 0..n {
                let there = self.front.transmitted[i * n + same[o]];
                let back = self.back.transmitted[o * n + same[i]];
                apart += (there - back).abs() * weight[i] * weight[o];
                flux += 0.5 * (there + back) * weight[i] * weight[o];
            }
        }
        (flux > 0.0).then(|| apart / flux)
    }
}
