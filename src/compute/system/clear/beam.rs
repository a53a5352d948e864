//! Parallel beams of finite width in the section.

use super::polarised::PolarisedLight;
use glam::{DVec2, DVec3};

/// Axes of a beam in the section: unit vectors (outward, upward) along the beam's travel, and across it to its left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axes {
    /// Unit vector in which the beam travels.
    pub along: DVec2,
    /// Unit vector across the beam, to the left of its travel.
    pub across: DVec2,
}

impl Axes {
    /// Creates the axes of the beam with wave vector `k` (x, y, z) in the façade frame.
    pub fn new(k: DVec3) -> Self {
        let along = DVec2::new(k.z, k.y);
        // A wave along x alone has no section; it is never traced.
        let along = along.try_normalize().unwrap_or(DVec2::X);
        Self { along, across: DVec2::new(-along.y, along.x) }
    }

    /// Returns the point of the section (outward, upward) \[periods\] that lies at `c` across and `t` along the beam.
    pub fn place(&self, [c, t]: [f64; 2]) -> DVec2 {
        c * self.across + t * self.along
    }

    /// Returns the coordinates (c, t) of a point of the section (outward, upward): c across, t along the beam.
    /// \[periods\]
    pub fn coordinates(&self, place: DVec2) -> [f64; 2] {
        [place.dot(self.across), place.dot(self.along)]
    }
}

/// Front of a beam of finite width: the line in the section from which the beam starts. Its two ends are (c, t), c
/// across and t along the beam \[periods\], with c not falling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Front {
    /// Ends of the front, (c, t) each: c across, t along the beam. \[periods\]
    pub ends: [[f64; 2]; 2],
}

impl Front {
    /// Creates the front between two points of the section (outward, upward). \[periods\]
    pub fn new(axes: &Axes, places: [DVec2; 2]) -> Self {
        let [a, b] = places.map(|place| axes.coordinates(place));
        Self { ends: if a[0] <= b[0] { [a, b] } else { [b, a] } }
    }

    /// Returns the coordinate t of the front along the beam at the coordinate `c` across it. \[periods\]
    pub fn at(&self, c: f64) -> f64 {
        let [[c0, t0], [c1, t1]] = self.ends;
        if c1 > c0 { t0 + (t1 - t0) * ((c - c0) / (c1 - c0)) } else { t0 }
    }

    /// Returns the width of the front across the beam. \[periods\]
    pub fn width(&self) -> f64 {
        self.ends[1][0] - self.ends[0][0]
    }
}

/// Parallel beam of finite width that is traced through the section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WideBeam {
    /// Index of the region that the beam is in.
    pub region: usize,
    /// Wave vector (x, y, z); its length is the refractive index.
    pub k: DVec3,
    /// Flux and polarisation.
    pub light: PolarisedLight,
    /// Front from which the beam starts in its region.
    pub front: Front,
    /// Derivatives of (k_z, k_y) with respect to the direction cosines x and y of the incident light.
    pub change: [DVec2; 2],
    /// Number of surfaces that the beam has met so far.
    pub surfaces: u32,
}
