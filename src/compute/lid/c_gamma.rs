//! The luminous-intensity distribution as luminaire files hold it: C-planes and γ angles (photometry of type C).
//!
//! Two orientations, both with C counted counter-clockwise seen from above and γ from the nadir:
//!
//! ```text
//!  Mounted (façade as built): nadir = −y_F, C0 = −z_F (into the room), C90 = −x_F
//!  Down    (normal at nadir): nadir = −z_F, C0 = +x_F, C90 = +y_F.  A roof aperture really hangs so.
//! ```
//! Every value is the mean of the intensity over the solid angle nearest to its node, ∫I dω / Ω, never the intensity
//! at the node: point values of narrow lobes lose or gain flux, up to a factor of two and more for a lobe of half a
//! step. The table is then scaled so that the flux a reader finds by the usual zonal sum is the flux of the aperture.

mod averaged;
mod cells;
mod narrow;
mod panel;
mod spots;

pub use averaged::Averaged;
pub use panel::Panel;

use super::{EmergentLuminance, Intensities, Lid};
use crate::compute::direction::{Dir, Emergent, Facade, Surface};
use crate::compute::estimate::Estimate;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Orientation of the aperture's frame in the luminaire's frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// Orientation as built into a façade: nadir down the façade, C0 into the room.
    Mounted,
    /// Orientation with the outward normal up: the opening is horizontal and emits downwards.
    Down,
}

impl Aim {
    /// Returns the real orientation of an aperture in this surface.
    pub fn of(surface: Surface) -> Self {
        match surface {
            Surface::Facade => Self::Mounted,
            Surface::Roof => Self::Down,
        }
    }

    /// Returns the direction of propagation in the aperture's frame for C and γ. \[rad\]
    pub fn direction(self, c: f64, gamma: f64) -> Emergent {
        let (sin_c, cos_c) = c.sin_cos();
        let (sin_gamma, cos_gamma) = gamma.sin_cos();
        Emergent(Dir::<Facade>::from_unit(match self {
            Self::Mounted => DVec3::new(-sin_gamma * sin_c, -cos_gamma, -sin_gamma * cos_c),
            Self::Down => DVec3::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma),
        }))
    }

    /// Returns C (0 ≤ C < 2π) and γ of a direction of propagation. \[rad\]
    pub fn angles(self, emergent: Emergent) -> (f64, f64) {
        let v = emergent.0.vector();
        // Components along C0, along C90 and along the nadir.
        let [along, across, nadir] = match self {
            Self::Mounted => [-v.z, -v.x, -v.y],
            Self::Down => [v.x, v.y, -v.z],
        };
        (crate::compute::angle::wrap_two_pi(across.atan2(along)), along.hypot(across).atan2(nadir))
    }
}

/// Distance of neighbouring nodes, the same in C and γ: a whole fraction of 90°, so that the façade's plane and the
/// horizon are lines of nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    per_quarter: usize,
}

/// A step that no file can hold.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("step {degrees}° does not divide 90° or lies outside 1° to 15° (try 5, 2.5 or 1)")]
pub struct StepError {
    /// Requested step. \[°\]
    pub degrees: f64,
}

impl Step {
    /// Step of 2.5°: 144 planes of 73 angles. Chosen; the mean over a cell flattens a cosine by less than Δ²/12 =
    /// 1.6e-4.
    pub const NORMAL: Self = Self { per_quarter: 36 };
    /// Step of 1°, the finest that is accepted: 360 planes of 181 angles, the limit of some readers of EULUMDAT.
    pub const FINE: Self = Self { per_quarter: 90 };

    /// Creates a step of 1° to 15° that divides 90°.
    pub fn from_degrees(degrees: f64) -> Result<Self, StepError> {
        let parts = 90.0 / degrees;
        let whole = parts.round();
        if !(1.0..=15.0).contains(&degrees) || (parts - whole).abs() > 1e-9 {
            return Err(StepError { degrees });
        }
        Ok(Self { per_quarter: whole as usize })
    }

    /// Chooses the step from the data: fine for a beam and for cells narrower than 5° (seen from the middle of their
    /// ring), normal otherwise.
    pub fn for_lid(lid: &Lid) -> Self {
        let narrow = lid.parts.iter().any(|part| match part {
            EmergentLuminance::Cells { basis, .. } => basis
                .rings()
                .iter()
                .any(|ring| ring.theta_min > 0.0 && ring.theta_max - ring.theta_min < 5_f64.to_radians() - 1e-9),
            EmergentLuminance::Uniform(_) | EmergentLuminance::Bands(_) | EmergentLuminance::Function(_) => false,
        });
        if narrow || lid.beam_flux() > 0.0 { Self::FINE } else { Self::NORMAL }
    }

    /// Returns the step. \[°\]
    pub fn degrees(self) -> f64 {
        90.0 / self.per_quarter as f64
    }

    fn radians(self) -> f64 {
        FRAC_PI_2 / self.per_quarter as f64
    }
}

/// Luminous intensities at C = 0, step, … < 360° and γ = 0, step, … 180°, and at more of them where narrow beams go.
#[derive(Debug, Clone, PartialEq)]
pub struct CGammaTable {
    /// Orientation of the aperture in the table.
    pub aim: Aim,
    /// Step in C and γ, away from beams.
    pub step: Step,
    /// C of the planes, from 0, 2π not repeated. \[rad\]
    pub c: Vec<f64>,
    /// Angles γ in a plane, from 0 to π. \[rad\]
    pub gamma: Vec<f64>,
    /// Luminous intensities, plane by plane, γ rising. \[cd\]
    pub intensity: Vec<f64>,
    /// Flux of the aperture: exact for uniform light, cells and bands, integrated for functions. \[lm\]
    pub flux: Estimate,
    /// Factor by which the averages were multiplied to make the zonal sum of the table equal to `flux`: what the
    /// quadrature missed of a known flux, and the zonal sum's own constant (1/cos(step/2) for smooth light).
    pub scaled_by: f64,
    /// Flux of the unscattered beams in the table. \[lm\]
    pub beam_flux: f64,
    /// The part of `intensity` that is unscattered beams; empty without any. \[cd\]
    pub beams: Vec<f64>,
    /// Widening of these beams; `None`: every beam is spread over the four nodes round it.
    pub widened: Option<Widened>,
}

/// Beams that are as wide as what they light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Widened {
    /// Size of the lit area, largest of all beams. \[m\]
    pub size: [f64; 2],
    /// Distance at which that size holds, from the nearest to the farthest. \[m\]
    pub distance: [f64; 2],
    /// Finest distance of the nodes in C, on the sphere, and in γ. \[rad\]
    pub step: [f64; 2],
}

/// Largest intensity of a table and its direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Mean over the solid angle that belongs to the table's node. \[cd\]
    pub intensity: f64,
    /// Angle C of the plane, 0 ≤ C < 2π. \[rad\]
    pub c: f64,
    /// Angle γ from the nadir. \[rad\]
    pub gamma: f64,
}

/// Largest intensities of an aperture, as its luminaire file holds them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// Scattered light alone; `None` where there is none.
    pub scattered: Option<Peak>,
    /// The strongest beam with the scattered light at its place; `None` without beams.
    pub beam: Option<Peak>,
    /// Step of the table of these intensities; that of a beam depends on it, because the table spreads the beam.
    pub step: Step,
}

impl Peaks {
    /// Returns the largest intensities in the table that a luminaire file of this aperture holds.
    pub fn of(lid: &Lid) -> Self {
        CGammaTable::new(lid, Aim::of(lid.surface), Step::for_lid(lid)).peaks()
    }
}

impl CGammaTable {
    /// Averages a distribution over the cells of the table; every beam is spread over the four nodes round it.
    pub fn new(lid: &Lid, aim: Aim, step: Step) -> Self {
        Averaged::new(lid, aim, step).table()
    }

    /// Number of C-planes, C = 360° not repeated.
    pub fn planes(&self) -> usize {
        self.c.len()
    }

    /// Number of γ angles.
    pub fn angles(&self) -> usize {
        self.gamma.len()
    }

    /// Intensities of one plane, γ from 0 to 180°. \[cd\]
    pub fn plane(&self, plane: usize) -> &[f64] {
        &self.intensity[plane * self.angles()..][..self.angles()]
    }

    /// Returns the intensities as a reader of luminaire files takes them.
    pub fn intensities(&self) -> Intensities {
        Intensities { c: self.c.clone(), gamma: self.gamma.clone(), values: self.intensity.clone() }
    }

    /// Replaces the nodes by others, the old ones among them; what a reader interpolates does not change.
    fn at_nodes(&mut self, c: Vec<f64>, gamma: Vec<f64>) {
        let known = Intensities {
            c: std::mem::take(&mut self.c),
            gamma: std::mem::take(&mut self.gamma),
            values: std::mem::take(&mut self.intensity),
        };
        self.intensity = c.iter().flat_map(|c| gamma.iter().map(|gamma| known.at(*c, *gamma))).collect();
        (self.c, self.gamma) = (c, gamma);
    }

    /// Scales the intensities so that the zonal sum is the table's flux again.
    fn close(&mut self) {
        let read = self.zonal_flux();
        if read != 0.0 && self.flux.value != 0.0 {
            self.intensity.iter_mut().for_each(|value| *value *= self.flux.value / read);
        }
    }

    /// Returns the strongest scattered light and the strongest beam.
    pub fn peaks(&self) -> Peaks {
        let beam = |node: usize| self.beams.get(node).copied().unwrap_or(0.0);
        let strongest = |value: &dyn Fn(usize) -> f64| {
            // Of equal ones the first: the plane that is named does not jump.
            let best = (0..self.intensity.len())
                .map(|node| (node, value(node)))
                .fold((0, 0.0), |best: (usize, f64), one| if one.1 > best.1 { one } else { best });
            let (c, gamma) = (self.c[best.0 / self.angles()], self.gamma[best.0 % self.angles()]);
            (best.1 > 0.0).then_some(Peak { intensity: best.1, c, gamma })
        };
        Peaks {
            // A difference of sums leaves rounding behind.
            scattered: strongest(&|node| {
                let rest = self.intensity[node] - beam(node);
                if rest > 1e-12 * self.intensity[node] { rest } else { 0.0 }
            }),
            beam: strongest(&|node| if beam(node) > 0.0 { self.intensity[node] } else { 0.0 }),
            step: self.step,
        }
    }

    /// Returns the flux that a reader finds: each zone between two γ with the mean of its two intensities, each plane
    /// for half the distance to its neighbours. \[lm\]
    pub fn zonal_flux(&self) -> f64 {
        let (planes, zones) = weights(&self.c, &self.gamma);
        let of = |(plane, weight): (usize, &f64)| {
            weight * self.plane(plane).iter().zip(&zones).map(|(intensity, zone)| intensity * zone).sum::<f64>()
        };
        planes.iter().enumerate().map(of).sum()
    }
}

/// Returns the weights of planes and angles in a zonal sum.
fn weights(c: &[f64], gamma: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let planes = c.len();
    let turn = 2.0 * PI;
    let gap = |k: usize| if k + 1 < planes { c[k + 1] - c[k] } else { c[0] + turn - c[k] };
    let of_planes = (0..planes).map(|k| 0.5 * (gap(k) + gap((k + planes - 1) % planes))).collect();
    let zone = |k: usize| if k + 1 < gamma.len() { gamma[k].cos() - gamma[k + 1].cos() } else { 0.0 };
    let of_angles = (0..gamma.len()).map(|k| 0.5 * (zone(k) + if k > 0 { zone(k - 1) } else { 0.0 })).collect();
    (of_planes, of_angles)
}

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tile_tests;
