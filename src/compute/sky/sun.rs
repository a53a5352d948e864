//! The sun's disc.

use crate::compute::direction::{Dir, World};
use std::f64::consts::PI;

/// Mean angular radius of the sun's disc: 0.2665°. \[rad\] Arc sine of the sun's radius, 695 700 km, over the
/// astronomical unit, 149 597 871 km.
pub const SUN_HALF_ANGLE: f64 = 0.2665 * PI / 180.0;

/// The sun as a uniform disc of angular radius [`SUN_HALF_ANGLE`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sun {
    /// Direction towards the centre of the disc.
    pub direction: Dir<World>,
    /// Illuminance on a plane that faces the sun. \[lx\]
    pub direct_normal: f64,
}

impl Sun {
    /// Returns the illuminance on the open horizontal plane; 0 with the centre below the horizon. \[lx\]
    pub fn horizontal(&self) -> f64 {
        self.direct_normal * self.direction.vector().z.max(0.0)
    }

    /// Returns the share of the disc above a horizontal edge at an altitude \[rad\], 0 … 1. The edge is taken as a
    /// straight chord of the disc, good to the square of the disc's radius (2e-5).
    pub fn share_above(&self, altitude: f64) -> f64 {
        let t = ((self.direction.altitude() - altitude) / SUN_HALF_ANGLE).clamp(-1.0, 1.0);
        // Circular segment of the unit disc with its chord at distance t below the centre.
        0.5 + (t.asin() + t * (1.0 - t * t).sqrt()) / PI
    }
}
