//! Tregenza's 145 patches of the sky dome.

use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, World};
use std::f64::consts::{FRAC_PI_2, PI};

/// Numbers of patches in the rows of Tregenza's division of the sky dome, lowest row first. Source: Tregenza 1987.
pub const ROWS: [usize; 8] = [30, 30, 24, 24, 18, 12, 6, 1];
/// Height of a row of Tregenza's patches in altitude: 12°. \[rad\] Source: Tregenza 1987. There are seven rows of this
/// height, and a cap above 84°.
pub const ROW_HEIGHT: f64 = 12.0 * PI / 180.0;

/// Patch of the sky dome, bounded by two altitudes and two bearings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Altitude of the patch's lower edge above the horizon. \[rad\]
    pub altitude_min: f64,
    /// Altitude of the patch's upper edge above the horizon. \[rad\]
    pub altitude_max: f64,
    /// Altitude of the patch's centre; π/2 for the cap at the zenith. \[rad\]
    pub altitude: f64,
    /// Compass bearing of the patch's centre, clockwise from north. \[rad\]
    pub bearing: f64,
    /// Width of the patch in bearing; 2π for the cap at the zenith. \[rad\]
    pub width: f64,
}

impl Patch {
    /// Returns the solid angle of the patch. \[sr\]
    pub fn solid_angle(&self) -> f64 {
        self.width * (self.altitude_max.sin() - self.altitude_min.sin())
    }

    /// Returns the direction of the patch's centre, world frame.
    pub fn centre(&self) -> Dir<World> {
        Dir::from_altitude_bearing(self.altitude, Bearing::from_radians(self.bearing))
    }
}

/// Returns Tregenza's 145 patches of the sky dome: lowest row first, each row clockwise from north, its first patch
/// centred on north.
pub fn tregenza_patches() -> Vec<Patch> {
    let mut patches = Vec::with_capacity(145);
    for (row, &count) in ROWS.iter().enumerate() {
        let altitude_min = row as f64 * ROW_HEIGHT;
        let altitude_max = if count == 1 { FRAC_PI_2 } else { altitude_min + ROW_HEIGHT };
        let altitude = if count == 1 { FRAC_PI_2 } else { 0.5 * (altitude_min + altitude_max) };
        let width = 2.0 * PI / count as f64;
        for k in 0..count {
            patches.push(Patch { altitude_min, altitude_max, altitude, bearing: k as f64 * width, width });
        }
    }
    patches
}
