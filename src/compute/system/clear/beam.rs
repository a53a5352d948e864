//! Parallel beams of finite width in the section.

use super::polarised::PolarisedLight;
use glam::{DVec2, DVec3};

/// Axes of a beam in the section (outward, upward): along it, and across it to its left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axes {
    pub along: DVec2,
    pub across: DVec2,
}

impl Axes {
    /// Creates the axes of a wave vector (x, y, z).
    pub fn new(k: DVec3) -> Self {
        let along = DVec2::new(k.z, k.y);
        // A wave along x alone has no section; it is never traced.
        let along = along.try_normalize().unwrap_or(DVec2::X);
        Self { along, across: DVec2::new(-along.y, along.x) }
    }

    /// Returns the place at c across and t along the beam.
    pub fn place(&self, [c, t]: [f64; 2]) -> DVec2 {
        c * self.across + t * self.along
    }

    /// Returns (c, t) of a place.
    pub fn coordinates(&self, place: DVec2) -> [f64; 2] {
        [place.dot(self.across), place.dot(self.along)]
    }
}

/// Front of a beam. Its ends are (c, t): t along the beam at c across it, linear between; c not falling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Front {
    pub ends: [[f64; 2]; 2],
}

impl Front {
    /// Creates the front through two places.
    pub fn new(axes: &Axes, places: [DVec2; 2]) -> Self {
        let [a, b] = places.map(|place| axes.coordinates(place));
        Self { ends: if a[0] <= b[0] { [a, b] } else { [b, a] } }
    }

    /// Returns the distance of the front along the beam at c.
    pub fn at(&self, c: f64) -> f64 {
        let [[c0, t0], [c1, t1]] = self.ends;
        if c1 > c0 { t0 + (t1 - t0) * ((c - c0) / (c1 - c0)) } else { t0 }
    }

    pub fn width(&self) -> f64 {
        self.ends[1][0] - self.ends[0][0]
    }
}

/// Beam of finite width that is being followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WideBeam {
    /// Index of the region that the beam is in.
    pub region: usize,
    /// Wave vector (x, y, z); its length is the refractive index.
    pub k: DVec3,
    /// Flux and polarisation.
    pub light: PolarisedLight,
    /// Front from which the beam starts.
    pub front: Front,
    /// Change of (k_z, k_y) with the incident direction cosines x and y.
    pub change: [DVec2; 2],
    /// Number of surfaces met so far.
    pub surfaces: u32,
}
