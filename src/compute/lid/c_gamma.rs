//! Luminous-intensity distribution of an aperture as a table of C-planes and γ angles (photometry of type C), the form
//! of luminaire files.
//!
//! Two orientations, both with C counted counter-clockwise seen from above and γ from the nadir:
//!
//! ```text
//!  Mounted (façade as built): nadir = −y_F, C0 = −z_F (into the room), C90 = −x_F
//!  Down    (normal at nadir): nadir = −z_F, C0 = +x_F, C90 = +y_F.  A roof aperture really hangs so.
//! ```
//! Every value is the mean of the intensity over the solid angle nearest to its node, ∫I dω / Ω, never the intensity at
//! the node: point values of narrow lobes lose or gain flux, up to a factor of two and more for a lobe of half a step.
//! The table is then scaled so that the usual zonal sum of its values equals the luminous flux of the aperture.

mod averaged;
mod cells;
mod narrow;
mod panel;
mod spots;

pub use averaged::Averaged;
pub use panel::Panel;

use super::{EmergentLuminance, Intensities, Lid};
use crate::compute::direction::{Dir, Emergent, Facade, Surface};
use crate::compute::estimate::{Cancelled, Estimate, Progress, Silent};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Orientation of an aperture as a luminaire: how the C-γ system of its luminaire file (γ from the nadir) lies in the
/// façade frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// Luminaire in a façade as built: the nadir (γ = 0) points down the façade, C0 into the room.
    Mounted,
    /// Luminaire with the outward normal of the aperture up: the aperture is horizontal and emits downwards.
    Down,
}

impl Aim {
    /// Returns the orientation as built of an aperture in this surface: [`Self::Mounted`] in a façade, [`Self::Down`]
    /// in a roof.
    pub fn of(surface: Surface) -> Self {
        match surface {
            Surface::Facade => Self::Mounted,
            Surface::Roof => Self::Down,
        }
    }

    /// Returns the direction of propagation, in the façade frame, for the angles C and γ of this orientation. \[rad\]
    pub fn direction(self, c: f64, gamma: f64) -> Emergent {
        let (sin_c, cos_c) = c.sin_cos();
        let (sin_gamma, cos_gamma) = gamma.sin_cos();
        Emergent(Dir::<Facade>::from_unit(match self {
            Self::Mounted => DVec3::new(-sin_gamma * sin_c, -cos_gamma, -sin_gamma * cos_c),
            Self::Down => DVec3::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma),
        }))
    }

    /// Returns the angles C (0 ≤ C < 2π) and γ (0 … π) of a direction of propagation in this orientation. \[rad\]
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

/// Angular step of a C-γ table, the same in C and γ: 90° divided by a whole number, so that the façade's plane and the
/// horizon are lines of nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    per_quarter: usize,
}

/// Error of an angular step that a C-γ table cannot have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("step {degrees}° does not divide 90° or lies outside 1° to 15° (try 5, 2.5 or 1)")]
pub struct StepError {
    /// Requested step. \[°\]
    pub degrees: f64,
}

impl Step {
    /// Default step of 2.5°: 144 C-planes of 73 γ angles. Chosen; the mean over a cell flattens a cosine by less than
    /// Δ²/12 = 1.6e-4.
    pub const NORMAL: Self = Self { per_quarter: 36 };
    /// Finest accepted step of 1°: 360 C-planes of 181 γ angles, the limit of some readers of EULUMDAT.
    pub const FINE: Self = Self { per_quarter: 90 };

    /// Creates a step from degrees, 1° to 15°.
    ///
    /// # Errors
    /// Returns an error if `degrees` lies outside 1° to 15° or does not divide 90°.
    pub fn from_degrees(degrees: f64) -> Result<Self, StepError> {
        let parts = 90.0 / degrees;
        let whole = parts.round();
        if !(1.0..=15.0).contains(&degrees) || (parts - whole).abs() > 1e-9 {
            return Err(StepError { degrees });
        }
        Ok(Self { per_quarter: whole as usize })
    }

    /// Returns the step for the table of a distribution: [`Self::FINE`] if it has beams or emergent cells in rings
    /// narrower than 5°, otherwise [`Self::NORMAL`].
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

    /// Returns the angular step in degrees. \[°\]
    pub fn degrees(self) -> f64 {
        90.0 / self.per_quarter as f64
    }

    fn radians(self) -> f64 {
        FRAC_PI_2 / self.per_quarter as f64
    }
}

/// Table of luminous intensities of an aperture at C = 0, step, … < 360° and γ = 0, step, … 180°, with additional nodes
/// in the directions of narrow beams. Every value is the mean over the solid angle nearest to its node.
#[derive(Debug, Clone, PartialEq)]
pub struct CGammaTable {
    /// Orientation of the C-γ system in the aperture's frame.
    pub aim: Aim,
    /// Step in C and γ outside the directions of narrow beams.
    pub step: Step,
    /// Angles C of the planes, rising from 0; 2π is not repeated. \[rad\]
    pub c: Vec<f64>,
    /// Angles γ in every plane, rising from 0 (nadir) to π. \[rad\]
    pub gamma: Vec<f64>,
    /// Luminous intensities, `[plane · gamma.len() + angle]`, beams included. \[cd\]
    pub intensity: Vec<f64>,
    /// Luminous flux of the aperture, beams included: exact for components with uniform luminance, on cells and by
    /// profile angle, integrated numerically for functions. \[lm\]
    pub flux: Estimate,
    /// Factor by which the mean intensities were multiplied so that the zonal sum of the table equals `flux`. It
    /// corrects the quadrature where the flux is known exactly, and the systematic deviation of a zonal sum
    /// (1/cos(step/2) for smooth distributions).
    pub scaled_by: f64,
    /// Luminous flux of the unscattered beams in the table. \[lm\]
    pub beam_flux: f64,
    /// Share of the beams in `intensity`, in the same order; empty without beams. \[cd\]
    pub beams: Vec<f64>,
    /// Widening of the beams to the size of the lit area; `None` if every beam is spread over the four nodes around it.
    pub widened: Option<Widened>,
}

/// Widening of the beams in a table: each covers the directions from the tile's centre to the area that the tile
/// lights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Widened {
    /// Size of the beam's cross-section along x_F and y_F at the aperture, the largest of all beams. \[m\]
    pub size: [f64; 2],
    /// Distances from the tile's centre to the lit area for which the beams were widened, smallest and largest of all
    /// beams. \[m\]
    pub distance: [f64; 2],
    /// Smallest step of the additional nodes in C (as an arc on the unit sphere) and in γ. \[rad\]
    pub step: [f64; 2],
}

/// Largest luminous intensity of a C-γ table and its direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Largest luminous intensity, a mean over the solid angle nearest to the table's node. \[cd\]
    pub intensity: f64,
    /// Angle C of the direction of the largest intensity, 0 ≤ C < 2π. \[rad\]
    pub c: f64,
    /// Angle γ of the direction of the largest intensity, from the nadir. \[rad\]
    pub gamma: f64,
}

/// Largest luminous intensities of an aperture in the C-γ table of its luminaire file, for scattered light and for
/// beams.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// Largest intensity of the scattered light, without beams; `None` if there is none.
    pub scattered: Option<Peak>,
    /// Largest intensity of beam and scattered light together in the direction of the strongest beam; `None` without
    /// beams.
    pub beam: Option<Peak>,
    /// Angular step of the table; the intensity of a beam depends on it, because the table spreads the beam over
    /// neighbouring nodes.
    pub step: Step,
}

impl Peaks {
    /// Returns the largest intensities in the C-γ table that a luminaire file of this aperture contains.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    pub fn of(lid: &Lid, progress: &dyn Progress) -> Result<Self, Cancelled> {
        Ok(Averaged::new(lid, Aim::of(lid.surface), Step::for_lid(lid), progress)?.table().peaks())
    }
}

impl CGammaTable {
    /// Creates the table of a distribution from its means over the solid angles around the nodes; every beam is spread
    /// over the four nodes around it.
    pub fn new(lid: &Lid, aim: Aim, step: Step) -> Self {
        match Averaged::new(lid, aim, step, &Silent) {
            Ok(averaged) => averaged.table(),
            Err(Cancelled) => unreachable!("nobody can cancel it"),
        }
    }

    /// Returns the number of C-planes; C = 360° is not repeated.
    pub fn planes(&self) -> usize {
        self.c.len()
    }

    /// Returns the number of γ angles in every plane.
    pub fn angles(&self) -> usize {
        self.gamma.len()
    }

    /// Returns the luminous intensities of the C-plane with index `plane`, γ from 0 to 180°. \[cd\]
    pub fn plane(&self, plane: usize) -> &[f64] {
        &self.intensity[plane * self.angles()..][..self.angles()]
    }

    /// Returns the intensities for interpolation between the nodes, as programs that read luminaire files interpolate.
    pub fn intensities(&self) -> Intensities {
        Intensities { c: self.c.clone(), gamma: self.gamma.clone(), values: self.intensity.clone() }
    }

    /// Replaces the nodes by a superset of them; the linear interpolation between the nodes does not change.
    fn at_nodes(&mut self, c: Vec<f64>, gamma: Vec<f64>) {
        let known = Intensities {
            c: std::mem::take(&mut self.c),
            gamma: std::mem::take(&mut self.gamma),
            values: std::mem::take(&mut self.intensity),
        };
        self.intensity = c.iter().flat_map(|c| gamma.iter().map(|gamma| known.at(*c, *gamma))).collect();
        (self.c, self.gamma) = (c, gamma);
    }

    /// Scales the intensities so that the zonal sum equals the flux of the table again.
    fn close(&mut self) {
        let read = self.zonal_flux();
        if read != 0.0 && self.flux.value != 0.0 {
            self.intensity.iter_mut().for_each(|value| *value *= self.flux.value / read);
        }
    }

    /// Returns the largest intensity of the scattered light and that of the beams, with their directions.
    pub fn peaks(&self) -> Peaks {
        let beam = |node: usize| self.beams.get(node).copied().unwrap_or(0.0);
        let strongest = |value: &dyn Fn(usize) -> f64| {
            // Of equal intensities the first, so that the stated plane does not depend on rounding.
            let best = (0..self.intensity.len())
                .map(|node| (node, value(node)))
                .fold((0, 0.0), |best: (usize, f64), one| if one.1 > best.1 { one } else { best });
            let (c, gamma) = (self.c[best.0 / self.angles()], self.gamma[best.0 % self.angles()]);
            (best.1 > 0.0).then_some(Peak { intensity: best.1, c, gamma })
        };
        Peaks {
            // The difference of two sums can leave rounding instead of 0.
            scattered: strongest(&|node| {
                let rest = self.intensity[node] - beam(node);
                if rest > 1e-12 * self.intensity[node] { rest } else { 0.0 }
            }),
            beam: strongest(&|node| if beam(node) > 0.0 { self.intensity[node] } else { 0.0 }),
            step: self.step,
        }
    }

    /// Returns the luminous flux of the table by the usual zonal sum: each zone between two γ has the mean of its two
    /// intensities, each plane counts for half the distance to its neighbours. \[lm\]
    pub fn zonal_flux(&self) -> f64 {
        let (planes, zones) = weights(&self.c, &self.gamma);
        let of = |(plane, weight): (usize, &f64)| {
            weight * self.plane(plane).iter().zip(&zones).map(|(intensity, zone)| intensity * zone).sum::<f64>()
        };
        planes.iter().enumerate().map(of).sum()
    }
}

/// Returns the weights of C-planes \[rad\] and γ angles (differences of cosines) in a zonal sum.
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
