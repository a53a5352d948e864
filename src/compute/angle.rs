//! Angles as types: radians in all computations, degrees in input and output only; compass bearings are kept separate
//! from mathematical azimuths.

use std::f64::consts::PI;

/// Plane angle, created from and read in radians or degrees. Stored in radians.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Angle(f64);

impl Angle {
    /// Creates an angle from radians.
    pub const fn from_radians(radians: f64) -> Self {
        Self(radians)
    }

    /// Creates an angle from degrees.
    pub fn from_degrees(degrees: f64) -> Self {
        Self(degrees.to_radians())
    }

    /// Returns the angle in radians.
    pub const fn radians(self) -> f64 {
        self.0
    }

    /// Returns the angle in degrees.
    pub fn degrees(self) -> f64 {
        self.0.to_degrees()
    }
}

/// Compass bearing: angle clockwise from north, seen from above. A type of its own, since a bearing that is mistaken
/// for a mathematical azimuth (counter-clockwise from east) still gives plausible results.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Bearing(Angle);

impl Bearing {
    /// Creates a bearing from degrees clockwise from north (east = 90, south = 180).
    pub fn from_degrees(degrees: f64) -> Self {
        Self(Angle::from_degrees(degrees))
    }

    /// Creates a bearing from radians clockwise from north.
    pub const fn from_radians(radians: f64) -> Self {
        Self(Angle::from_radians(radians))
    }

    /// Returns the bearing in degrees clockwise from north, 0 ≤ bearing < 360.
    pub fn degrees(self) -> f64 {
        self.0.degrees().rem_euclid(360.0)
    }

    /// Returns the bearing in radians clockwise from north, not reduced to 0 … 2π.
    pub const fn radians(self) -> f64 {
        self.0.radians()
    }
}

/// Returns an azimuth reduced by full turns to 0 ≤ φ < 2π. \[rad\]
pub fn wrap_two_pi(phi: f64) -> f64 {
    let wrapped = phi.rem_euclid(2.0 * PI);
    // rem_euclid of a tiny negative number rounds up to 2π itself.
    if wrapped < 2.0 * PI { wrapped } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wraps_into_one_turn() {
        assert_eq!(wrap_two_pi(-1e-20), 0.0);
        assert!((wrap_two_pi(-0.5 * PI) - 1.5 * PI).abs() < 1e-15);
        assert!((Bearing::from_degrees(-90.0).degrees() - 270.0).abs() < 1e-12);
    }
}
