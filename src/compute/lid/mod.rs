//! Luminous-intensity distribution of an aperture: the light that its room side emits into the room, described like
//! that of a luminaire.

mod beams;
pub mod c_gamma;
mod disc_beams;
mod emission;
mod facing;
mod intensities;
mod interpolated;
mod lamp;
mod leaf_uncertainty;
mod mixed;
mod patch_uncertainty;
pub mod peaks;
pub mod sky_columns;
mod sky_through;
mod structure;
mod sun_through;
pub mod tiling;

pub use beams::BeamLight;
pub use emission::{BandLight, BeamSource, CellLight, Emission};
pub use facing::Facing;
pub use intensities::Intensities;
pub use interpolated::Interpolator;
pub use lamp::{Lamp, Lamps};
pub use sky_through::SkyThrough;
pub use structure::{direction, structure_angles};
pub use sun_through::{SunThrough, scattered_of, sun_cells};

use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Emergent, Facade, Surface};
use crate::compute::system::measure::ProfileLight;
use std::fmt;
use std::sync::Arc;

/// Luminance of an aperture's room side as a function of the direction of undeviated light ω′ = −ω_a, the reversed
/// emergent direction ω_a (unit vector with z > 0, façade frame). \[cd/m²\]
pub type LuminanceFunction = Arc<dyn Fn(Dir<Facade>) -> f64 + Send + Sync>;

/// Component of the luminance of an aperture's room side, by emergent direction. The components of an aperture add up.
#[derive(Clone)]
pub enum EmergentLuminance {
    /// Luminance that is the same in all directions (Lambertian emission). \[cd/m²\]
    Uniform(f64),
    /// Luminance by emergent cell; a cell holds the reversed emergent directions ω′ = −ω_a. \[cd/m²\]
    Cells {
        /// Cells that divide the hemisphere of the reversed emergent directions.
        basis: Arc<RingBasis>,
        /// Luminance of the room side by index of emergent cell. \[cd/m²\]
        luminance: Vec<f64>,
    },
    /// Luminance by the profile angle of the reversed emergent direction ω′ = −ω_a; the field `q` holds luminances
    /// here. \[cd/m²\]
    Bands(ProfileLight),
    /// Luminance as a continuous function: the outside seen through a system that transmits light undeviated (eq 20).
    Function(LuminanceFunction),
}

impl fmt::Debug for EmergentLuminance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uniform(l) => write!(f, "Uniform({l} cd/m²)"),
            Self::Cells { basis, .. } => write!(f, "Cells({}, {} cells)", basis.name(), basis.len()),
            Self::Bands(light) => write!(f, "Bands({})", light.q.len()),
            Self::Function(_) => write!(f, "Function"),
        }
    }
}

impl EmergentLuminance {
    /// Returns the luminance of this component for light that leaves in an emergent direction; 0 for directions to the
    /// outside. \[cd/m²\]
    pub fn at(&self, emergent: Emergent) -> f64 {
        let undeviated = emergent.undeviated_incident();
        if undeviated.vector().z <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Uniform(luminance) => *luminance,
            Self::Cells { basis, luminance } => basis.index(undeviated).map_or(0.0, |cell| luminance[cell]),
            Self::Bands(light) => light.at(undeviated),
            Self::Function(luminance) => luminance(undeviated),
        }
    }
}

/// Beam of sunlight that an aperture transmits without scattering: parallel except for the sun's diameter of 0.53°;
/// undeviated, deflected or mirrored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SunBeam {
    /// Emergent direction of the beam, façade frame.
    pub direction: Emergent,
    /// Luminous flux of the beam through the whole aperture. \[lm\]
    pub flux: f64,
    /// Whether the beam is undeviated, so that the sun itself is visible along it.
    pub straight: bool,
}

/// Luminous-intensity distribution of one aperture (eq 5): I(ω_a) = L(ω_a) · A · cosθ_a with the luminance L of its
/// room side, its area A and the emergent direction ω_a; beams of direct sun are listed separately.
#[derive(Debug, Clone)]
pub struct Lid {
    /// Surface of the room that the aperture lies in; fixes the orientation of the façade frame in the room.
    pub surface: Surface,
    /// Size of the aperture along x_F and along y_F of the façade frame. \[m\]
    pub size: [f64; 2],
    /// Components of the luminance of the room side; they add up.
    pub parts: Vec<EmergentLuminance>,
    /// Beams of sunlight that is transmitted without scattering.
    pub beams: Vec<SunBeam>,
}

impl Lid {
    /// Returns the luminance of the room side for light that leaves in an emergent direction, without the beams.
    /// \[cd/m²\]
    pub fn luminance(&self, emergent: Emergent) -> f64 {
        self.parts.iter().map(|part| part.at(emergent)).sum()
    }

    /// Returns the luminous intensity of the aperture in an emergent direction, without the beams. \[cd\]
    pub fn intensity(&self, emergent: Emergent) -> f64 {
        self.luminance(emergent) * self.area() * (-emergent.0.vector().z).max(0.0)
    }

    /// Returns the luminous flux of all beams of the aperture together. \[lm\]
    pub fn beam_flux(&self) -> f64 {
        self.beams.iter().map(|beam| beam.flux).sum()
    }

    /// Returns the area of the aperture. \[m²\]
    pub fn area(&self) -> f64 {
        self.size[0] * self.size[1]
    }
}
