//! Relative luminance of the sky above the horizon, for all sky models.

use super::cie;
use super::gradated::Gradated;
use super::perez::PerezState;
use super::scan::Scan;
use crate::compute::direction::{Dir, World};
use glam::DVec3;

/// Sky model of a [`Distribution`].
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Model {
    Uniform,
    /// Traditional overcast sky, (1 + 2 sin γ)/3.
    Overcast,
    Gradated(Gradated, DVec3),
    Scan(Box<Scan>),
}

/// Relative luminance distribution of a sky (uniform, CIE, Perez or measured), not yet scaled to an illuminance.
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    pub(super) model: Model,
}

impl Distribution {
    /// Creates a uniform sky: the same luminance in all directions.
    pub const fn uniform() -> Self {
        Self { model: Model::Uniform }
    }

    /// Creates a CIE general sky of type 1 … 15 (ISO 15469) for a direction of the sun, or of type 16, the traditional
    /// overcast sky (1 + 2 sin γ)/3, which does not depend on the sun. `None` for another number.
    pub fn cie(sky_type: u8, sun: Dir<World>) -> Option<Self> {
        if sky_type == 16 {
            return Some(Self { model: Model::Overcast });
        }
        cie::gradated(sky_type).map(|sky| Self { model: Model::Gradated(sky, sun.vector()) })
    }

    /// Creates the Perez all-weather sky (1993) of a state (clearness, brightness) for a direction of the sun.
    pub fn perez(state: &PerezState, sun: Dir<World>) -> Self {
        let [a, b, c, d, e] = state.coefficients;
        Self { model: Model::Gradated(Gradated { a, b, base: 1.0, c, d, e }, sun.vector()) }
    }

    /// Creates a sky of 145 measured luminances, each constant over its patch of Tregenza's division of the sky dome.
    pub fn scan(scan: Scan) -> Self {
        Self { model: Model::Scan(Box::new(scan)) }
    }

    /// Returns the relative luminance of the sky in a direction above the horizon (unit vector, world frame, z ≥ 0).
    #[inline]
    pub(super) fn relative(&self, v: DVec3) -> f64 {
        match &self.model {
            Model::Uniform => 1.0,
            Model::Overcast => (1.0 + 2.0 * v.z) / 3.0,
            Model::Gradated(sky, sun) => {
                let gradation = sky.gradation(v.z);
                if sky.symmetric() {
                    return gradation * sky.base.max(0.0);
                }
                // From half the chord: exact near the sun, where acos of the cosine has lost half its digits.
                let chi = 2.0 * (0.5 * (v - *sun).length()).min(1.0).asin();
                gradation * sky.indicatrix_with_cosine(chi, v.dot(*sun))
            }
            Model::Scan(scan) => scan.value(v),
        }
    }

    /// Returns the direction of the sun about which the sky has its circumsolar brightening; `None` for skies without
    /// one.
    pub(super) fn sun_direction(&self) -> Option<Dir<World>> {
        match &self.model {
            Model::Gradated(sky, sun) => (!sky.symmetric()).then(|| Dir::from_unit(*sun)),
            Model::Uniform | Model::Overcast | Model::Scan(_) => None,
        }
    }

    /// Whether the luminance is the same in all directions above the horizon.
    pub(super) fn is_uniform(&self) -> bool {
        match &self.model {
            Model::Uniform => true,
            Model::Gradated(sky, _) => sky.symmetric() && sky.a == 0.0,
            Model::Overcast | Model::Scan(_) => false,
        }
    }

    /// Whether the luminance is constant over each of Tregenza's 145 patches of the dome.
    pub(super) const fn is_piecewise_constant(&self) -> bool {
        matches!(self.model, Model::Scan(_))
    }
}
