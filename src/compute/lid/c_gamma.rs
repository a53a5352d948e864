//! The luminous-intensity distribution as luminaire files hold it: C-planes and γ angles (photometry of type C).
//!
//! Two ways to aim, both with C counted counter-clockwise seen from above and γ from the nadir:
//!
//! ```text
//!  Mounted (façade as built): nadir = −y_F, C0 = −z_F (into the room), C90 = −x_F
//!  Down    (normal at nadir): nadir = −z_F, C0 = +x_F, C90 = +y_F.  A roof aperture really hangs so.
//! ```
//! Every value is the mean of the intensity over the solid angle nearest to its node, ∫I dω / Ω, never the intensity
//! at the node: point values of narrow lobes lose or gain flux, up to a factor of two and more for a lobe of half a
//! step. The table is then scaled so that the flux a reader finds by the usual zonal sum is the flux of the aperture.

use super::{EmergentLuminance, Lid};
use crate::compute::direction::{Dir, Emergent, Facade, Surface};
use crate::compute::estimate::Estimate;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// How the aperture's frame stands in the luminaire's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// As built into a façade: nadir down the façade, C0 into the room.
    Mounted,
    /// The outward normal turned up: the opening is horizontal and shines down.
    Down,
}

impl Aim {
    /// The real orientation of an aperture in this surface.
    pub fn of(surface: Surface) -> Self {
        match surface {
            Surface::Facade => Self::Mounted,
            Surface::Roof => Self::Down,
        }
    }

    /// Direction of propagation in the aperture's frame for C and γ. \[rad\]
    pub fn direction(self, c: f64, gamma: f64) -> Emergent {
        let (sin_c, cos_c) = c.sin_cos();
        let (sin_gamma, cos_gamma) = gamma.sin_cos();
        Emergent(Dir::<Facade>::from_unit(match self {
            Self::Mounted => DVec3::new(-sin_gamma * sin_c, -cos_gamma, -sin_gamma * cos_c),
            Self::Down => DVec3::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma),
        }))
    }

    /// C (0 ≤ C < 2π) and γ of a direction of propagation. \[rad\]
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
    /// What was asked for. \[°\]
    pub degrees: f64,
}

impl Step {
    /// 2.5°: 144 planes of 73 angles.
    pub const NORMAL: Self = Self { per_quarter: 36 };
    /// 1°: 360 planes of 181 angles, the most that readers of EULUMDAT take.
    pub const FINE: Self = Self { per_quarter: 90 };

    /// A step of 1° to 15° that divides 90°.
    pub fn from_degrees(degrees: f64) -> Result<Self, StepError> {
        let parts = 90.0 / degrees;
        let whole = parts.round();
        if !(1.0..=15.0).contains(&degrees) || (parts - whole).abs() > 1e-9 {
            return Err(StepError { degrees });
        }
        Ok(Self { per_quarter: whole as usize })
    }

    /// Chosen from the data: fine for a beam and for cells narrower than 5° (seen from the middle of their ring),
    /// normal otherwise.
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

    /// \[°\]
    pub fn degrees(self) -> f64 {
        90.0 / self.per_quarter as f64
    }

    fn radians(self) -> f64 {
        FRAC_PI_2 / self.per_quarter as f64
    }
}

/// Luminous intensities at C = 0, step, … < 360° and γ = 0, step, … 180°.
#[derive(Debug, Clone, PartialEq)]
pub struct CGammaTable {
    /// How the aperture stands in it.
    pub aim: Aim,
    /// Step in C and γ.
    pub step: Step,
    /// Plane by plane, γ rising. \[cd\]
    pub intensity: Vec<f64>,
    /// Flux of the aperture: exact for uniform light, cells and bands, integrated for functions. \[lm\]
    pub flux: Estimate,
    /// Factor by which the averages were multiplied to make the zonal sum of the table equal to `flux`: what the
    /// quadrature missed of a known flux, and the zonal sum's own constant (1/cos(step/2) for smooth light).
    pub scaled_by: f64,
    /// Flux of the unscattered beams, each spread over the four nodes round it. \[lm\]
    pub beam_flux: f64,
    /// The part of `intensity` that is unscattered beams; empty without any. \[cd\]
    pub beams: Vec<f64>,
}

/// The largest intensity of a table and where it goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Mean over the solid angle that belongs to the table's node. \[cd\]
    pub intensity: f64,
    /// The plane, 0 ≤ C < 2π. \[rad\]
    pub c: f64,
    /// From the nadir. \[rad\]
    pub gamma: f64,
}

/// How strong the light of an aperture is at most, as its luminaire file holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// Scattered light alone; `None` where there is none.
    pub scattered: Option<Peak>,
    /// The strongest beam with the scattered light at its place; `None` without beams.
    pub beam: Option<Peak>,
    /// Step of the table that they are of: a beam is as strong as this spreads it.
    pub step: Step,
}

impl Peaks {
    /// Of the table that a luminaire file of this aperture holds.
    pub fn of(lid: &Lid) -> Self {
        CGammaTable::new(lid, Aim::of(lid.surface), Step::for_lid(lid)).peaks()
    }
}

impl CGammaTable {
    /// Averages a distribution over the cells of the table.
    ///
    /// Functions are integrated by adaptive Gauss points, cells and bands by sub-sampling; both split at the façade's plane
    /// and at the horizon. Negative luminances count as they are.
    pub fn new(lid: &Lid, aim: Aim, step: Step) -> Self {
        let grid = Grid { aim, step };
        let area = lid.area();
        let mut node_flux = vec![0.0; grid.planes() * grid.angles()];
        let mut flux = Estimate::default();
        let (mut raw, mut closed) = (0.0, 0.0);
        for part in &lid.parts {
            // Shares of the flux in each node's cell, per area.
            let (shares, total) = match part {
                EmergentLuminance::Uniform(l) => (grid.collect(&|_| *l, Rule::Smooth), Some(PI * l)),
                EmergentLuminance::Cells { basis, luminance } => {
                    let exact = basis.projected_solid_angles().iter().zip(luminance).map(|(w, l)| w * l).sum();
                    let at = |d: Dir<Facade>| basis.index(d).map_or(0.0, |cell| luminance[cell]);
                    (grid.collect(&at, Rule::Piecewise), Some(exact))
                }
                EmergentLuminance::Bands(light) => {
                    (grid.collect(&|d| light.at(d), Rule::Piecewise), Some(light.share()))
                }
                EmergentLuminance::Function(f) => (grid.collect(&|d| f(d), Rule::Smooth), None),
            };
            let sum: f64 = shares.iter().map(|share| share.value).sum();
            let error: f64 = shares.iter().map(|share| share.error).sum();
            let (total, error) = total.map_or((sum, error), |exact| (exact, 0.0));
            // What the quadrature missed of a flux that is known is laid on all cells alike.
            let closing = if sum != 0.0 { total / sum } else { 1.0 };
            flux += Estimate::new(total * area, error * area);
            raw += sum;
            closed += sum * closing;
            for (node, share) in node_flux.iter_mut().zip(&shares) {
                *node += share.value * closing * area;
            }
        }
        let beam_flux = lid.beam_flux();
        let mut of_beams = vec![0.0; if beam_flux == 0.0 { 0 } else { node_flux.len() }];
        for beam in lid.beams.iter().filter(|beam| beam.flux != 0.0) {
            grid.lay(&mut node_flux, beam.direction, beam.flux);
            grid.lay(&mut of_beams, beam.direction, beam.flux);
        }
        flux += Estimate::exact(beam_flux);
        let beams = if of_beams.is_empty() { of_beams } else { grid.averages(&of_beams) };
        let intensity = grid.averages(&node_flux);
        let mut table = Self { aim, step, intensity, flux, scaled_by: 1.0, beam_flux, beams };
        let read = table.zonal_flux();
        if read != 0.0 && flux.value != 0.0 {
            let scale = flux.value / read;
            for value in table.intensity.iter_mut().chain(&mut table.beams) {
                *value *= scale;
            }
            table.scaled_by = if raw != 0.0 { scale * closed / raw } else { scale };
        }
        table
    }

    /// Number of C-planes, C = 360° not repeated.
    pub fn planes(&self) -> usize {
        4 * self.step.per_quarter
    }

    /// Number of γ angles.
    pub fn angles(&self) -> usize {
        2 * self.step.per_quarter + 1
    }

    /// Intensities of one plane, γ from 0 to 180°. \[cd\]
    pub fn plane(&self, plane: usize) -> &[f64] {
        &self.intensity[plane * self.angles()..][..self.angles()]
    }

    /// The strongest scattered light and the strongest beam.
    pub fn peaks(&self) -> Peaks {
        let beam = |node: usize| self.beams.get(node).copied().unwrap_or(0.0);
        let strongest = |value: &dyn Fn(usize) -> f64| {
            // Of equal ones the first: the plane that is named does not jump.
            let best = (0..self.intensity.len())
                .map(|node| (node, value(node)))
                .fold((0, 0.0), |best: (usize, f64), one| if one.1 > best.1 { one } else { best });
            let at = |part: usize| part as f64 * self.step.radians();
            let (c, gamma) = (at(best.0 / self.angles()), at(best.0 % self.angles()));
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

    /// The flux that a reader finds: each zone between two γ with the mean of its two intensities. \[lm\]
    pub fn zonal_flux(&self) -> f64 {
        let delta = self.step.radians();
        (0..self.planes())
            .map(|plane| {
                self.plane(plane)
                    .windows(2)
                    .enumerate()
                    .map(|(j, pair)| {
                        let zone = (j as f64 * delta).cos() - ((j + 1) as f64 * delta).cos();
                        0.5 * (pair[0] + pair[1]) * zone * delta
                    })
                    .sum::<f64>()
            })
            .sum()
    }
}

/// What the quadrature may assume inside a cell.
#[derive(Clone, Copy, PartialEq)]
enum Rule {
    /// Smooth nearly everywhere: Gauss points, refined where two orders disagree.
    Smooth,
    /// Steps at borders that run anywhere: many points of equal weight.
    Piecewise,
}

#[derive(Clone, Copy)]
struct Grid {
    aim: Aim,
    step: Step,
}

/// A rectangle in C and γ. \[rad\]
#[derive(Clone, Copy)]
struct Patch {
    c: [f64; 2],
    gamma: [f64; 2],
}

impl Patch {
    fn quarters(self) -> [Self; 4] {
        let (c, g) = (0.5 * (self.c[0] + self.c[1]), 0.5 * (self.gamma[0] + self.gamma[1]));
        let [low_c, high_c] = [[self.c[0], c], [c, self.c[1]]];
        let [low_g, high_g] = [[self.gamma[0], g], [g, self.gamma[1]]];
        [(low_c, low_g), (low_c, high_g), (high_c, low_g), (high_c, high_g)].map(|(c, gamma)| Self { c, gamma })
    }
}

impl Grid {
    fn planes(self) -> usize {
        4 * self.step.per_quarter
    }

    fn angles(self) -> usize {
        2 * self.step.per_quarter + 1
    }

    /// ∫ L cosθ dω over the cell of every node, plane by plane.
    fn collect(self, luminance: &(dyn Fn(Dir<Facade>) -> f64 + Sync), rule: Rule) -> Vec<Estimate> {
        let delta = self.step.radians();
        let angles = self.angles();
        // Flux per steradian at the direction, seen by through-name.
        let density = |c: f64, gamma: f64| {
            let twin = self.aim.direction(c, gamma).through_name();
            let cos_theta = twin.vector().z;
            if cos_theta > 0.0 { luminance(twin) * cos_theta * gamma.sin() } else { 0.0 }
        };
        (0..self.planes() * angles)
            .into_par_iter()
            .map(|node| {
                let (c, gamma) = ((node / angles) as f64 * delta, (node % angles) as f64 * delta);
                // The façade's plane and the horizon run through nodes: cells are cut there.
                let cuts = [[-0.5, 0.0], [0.0, 0.5]];
                let mut sum = Estimate::default();
                for [c0, c1] in cuts {
                    for [g0, g1] in cuts {
                        let patch = Patch {
                            c: [c + c0 * delta, c + c1 * delta],
                            gamma: [(gamma + g0 * delta).max(0.0), (gamma + g1 * delta).min(PI)],
                        };
                        if patch.gamma[1] <= patch.gamma[0] {
                            continue;
                        }
                        sum += match rule {
                            Rule::Smooth => adaptive(&density, patch, 4),
                            Rule::Piecewise => Estimate::exact(midpoints(&density, patch, 6)),
                        };
                    }
                }
                sum
            })
            .collect()
    }

    /// Spreads a beam over the four nodes round it so that its centre stays where it is in C and γ.
    fn lay(self, node_flux: &mut [f64], direction: Emergent, flux: f64) {
        let delta = self.step.radians();
        let (c, gamma) = self.aim.angles(direction);
        let (c, gamma) = (c / delta, gamma / delta);
        let (i, j) = (c.floor() as usize, (gamma.floor() as usize).min(self.angles() - 2));
        let (u, v) = (c - i as f64, gamma - j as f64);
        for (plane, share_c) in [(i, 1.0 - u), (i + 1, u)] {
            for (angle, share_gamma) in [(j, 1.0 - v), (j + 1, v)] {
                node_flux[(plane % self.planes()) * self.angles() + angle] += flux * share_c * share_gamma;
            }
        }
    }

    /// Mean intensities from the fluxes of the cells. The cells at nadir and zenith are one direction in all planes.
    fn averages(self, node_flux: &[f64]) -> Vec<f64> {
        let delta = self.step.radians();
        let (planes, angles) = (self.planes(), self.angles());
        let cap = |angle: usize| {
            let flux: f64 = (0..planes).map(|plane| node_flux[plane * angles + angle]).sum();
            flux / (2.0 * PI * 2.0 * (0.25 * delta).sin().powi(2))
        };
        let (nadir, zenith) = (cap(0), cap(angles - 1));
        (0..planes * angles)
            .map(|node| match node % angles {
                0 => nadir,
                j if j == angles - 1 => zenith,
                // Ω = ΔC (cos(γ − Δ/2) − cos(γ + Δ/2)) = 2 ΔC sinγ sin(Δ/2)
                j => node_flux[node] / (2.0 * delta * (j as f64 * delta).sin() * (0.5 * delta).sin()),
            })
            .collect()
    }
}

const GAUSS_2: [(f64, f64); 2] = [(-0.577_350_269_189_625_8, 0.5), (0.577_350_269_189_625_8, 0.5)];
const GAUSS_3: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 18.0), (0.0, 4.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 18.0)];

fn gauss(density: &impl Fn(f64, f64) -> f64, patch: Patch, rule: &[(f64, f64)]) -> f64 {
    let [c, gamma] = [patch.c, patch.gamma];
    let point = |range: [f64; 2], x: f64| 0.5 * (range[0] + range[1]) + 0.5 * (range[1] - range[0]) * x;
    let mut sum = 0.0;
    for &(x, weight_x) in rule {
        for &(y, weight_y) in rule {
            sum += weight_x * weight_y * density(point(c, x), point(gamma, y));
        }
    }
    sum * (c[1] - c[0]) * (gamma[1] - gamma[0])
}

/// Gauss points of third order, refined where the second order disagrees by more than 0.1 %.
fn adaptive(density: &impl Fn(f64, f64) -> f64, patch: Patch, depth: usize) -> Estimate {
    let fine = gauss(density, patch, &GAUSS_3);
    let error = (fine - gauss(density, patch, &GAUSS_2)).abs();
    if depth == 0 || error <= 1e-3 * fine.abs() {
        return Estimate::new(fine, error);
    }
    patch.quarters().into_iter().map(|quarter| adaptive(density, quarter, depth - 1)).sum()
}

fn midpoints(density: &impl Fn(f64, f64) -> f64, patch: Patch, n: usize) -> f64 {
    let at = |range: [f64; 2], k: usize| range[0] + (range[1] - range[0]) * (k as f64 + 0.5) / n as f64;
    let mut sum = 0.0;
    for i in 0..n {
        for j in 0..n {
            sum += density(at(patch.c, i), at(patch.gamma, j));
        }
    }
    sum * (patch.c[1] - patch.c[0]) * (patch.gamma[1] - patch.gamma[0]) / (n * n) as f64
}

#[cfg(test)]
mod tests;
