//! The sun's disc.

use crate::compute::direction::{Dir, World};
use std::f64::consts::PI;

/// Mean angular radius of the sun's disc: 0.2665°. \[rad\] Source: arc sine of the sun's radius, 695 700 km, over the
/// astronomical unit, 149 597 871 km.
pub const SUN_HALF_ANGLE: f64 = 0.2665 * PI / 180.0;

/// Direct sun as a disc of uniform luminance with the angular radius [`SUN_HALF_ANGLE`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sun {
    /// Direction towards the centre of the disc, world frame.
    pub direction: Dir<World>,
    /// Direct normal illuminance: on a plane perpendicular to the sun's direction. \[lx\]
    pub direct_normal: f64,
}

impl Sun {
    /// Returns the illuminance of the unobstructed horizontal plane by direct sun; 0 with the centre of the sun below
    /// the horizon. \[lx\]
    pub fn horizontal(&self) -> f64 {
        self.direct_normal * self.direction.vector().z.max(0.0)
    }

    /// Returns the share of the disc above a horizontal edge at an altitude \[rad\], 0 … 1. The edge is approximated by
    /// a straight chord of the disc; the error is of the order of the square of the disc's radius (2e-5).
    pub fn share_above(&self, altitude: f64) -> f64 {
        let t = ((self.direction.altitude() - altitude) / SUN_HALF_ANGLE).clamp(-1.0, 1.0);
        // Circular segment of the unit disc with its chord at distance t below the centre.
        0.5 + (t.asin() + t * (1.0 - t * t).sqrt()) / PI
    }
}
