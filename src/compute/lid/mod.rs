//! Luminous-intensity distribution of an aperture: the light that its room side emits, as a luminaire would.

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

/// Luminance as a function of the through direction. \[cd/m²\]
pub type LuminanceFunction = Arc<dyn Fn(Dir<Facade>) -> f64 + Send + Sync>;

/// One part of the luminance of an aperture's room side. Parts add up.
#[derive(Clone)]
pub enum EmergentLuminance {
    /// Constant luminance in all directions. \[cd/m²\]
    Uniform(f64),
    /// Luminance per emergent cell, by through direction. \[cd/m²\]
    Cells {
        /// Emergent cells.
        basis: Arc<RingBasis>,
        /// Luminance of each cell. \[cd/m²\]
        luminance: Vec<f64>,
    },
    /// Luminance by the profile angle of the through direction; `q` holds luminances. \[cd/m²\]
    Bands(ProfileLight),
    /// Continuous function: the outside seen through a system that keeps directions (eq 20).
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
    /// Returns the luminance seen against an emergent direction. \[cd/m²\]
    pub fn at(&self, emergent: Emergent) -> f64 {
        let twin = emergent.through_name();
        if twin.vector().z <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Uniform(luminance) => *luminance,
            Self::Cells { basis, luminance } => basis.index(twin).map_or(0.0, |cell| luminance[cell]),
            Self::Bands(light) => light.at(twin),
            Self::Function(luminance) => luminance(twin),
        }
    }
}

/// Sunlight transmitted without scattering: a parallel beam (but for the disc's 0.53°), undeviated, deflected or
/// mirrored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SunBeam {
    /// Direction in which the beam leaves.
    pub direction: Emergent,
    /// Luminous flux of the whole aperture's beam. \[lm\]
    pub flux: f64,
    /// Whether the beam is undeviated: the sun itself is seen along it.
    pub straight: bool,
}

/// Luminous-intensity distribution of one aperture (eq 5): I(ω_a) = L(ω_a) · A · cosθ_a.
#[derive(Debug, Clone)]
pub struct Lid {
    /// Surface that the aperture lies in; fixes the orientation of the façade frame in the room.
    pub surface: Surface,
    /// Size along x_F and along y_F. \[m\]
    pub size: [f64; 2],
    /// Parts of the emergent luminance.
    pub parts: Vec<EmergentLuminance>,
    /// Beams of unscattered sunlight.
    pub beams: Vec<SunBeam>,
}

impl Lid {
    /// Returns the luminance of the room side against an emergent direction, beams left out. \[cd/m²\]
    pub fn luminance(&self, emergent: Emergent) -> f64 {
        self.parts.iter().map(|part| part.at(emergent)).sum()
    }

    /// Returns the luminous intensity in an emergent direction, beams left out. \[cd\]
    pub fn intensity(&self, emergent: Emergent) -> f64 {
        self.luminance(emergent) * self.area() * (-emergent.0.vector().z).max(0.0)
    }

    /// Returns the flux of all beams. \[lm\]
    pub fn beam_flux(&self) -> f64 {
        self.beams.iter().map(|beam| beam.flux).sum()
    }

    /// Returns the area of the aperture. \[m²\]
    pub fn area(&self) -> f64 {
        self.size[0] * self.size[1]
    }
}
