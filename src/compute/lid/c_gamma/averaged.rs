//! Averages of a luminous-intensity distribution over the solid angles around the nodes of a C-γ table of constant
//! step.

use super::spots::{self, Spot};
use super::{Aim, CGammaTable, Panel, Step, narrow};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::lid::{EmergentLuminance, Lid, SunBeam};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Luminous-intensity distribution of an aperture, averaged over the solid angles around the nodes of a C-γ table. It
/// is common to all tiles of the aperture.
#[derive(Debug, Clone)]
pub struct Averaged {
    grid: Grid,
    /// Luminous flux of the whole aperture into the solid angle around every node, without beams. \[lm\]
    node_flux: Vec<f64>,
    /// Luminous flux of the whole aperture without its beams. \[lm\]
    pub flux: Estimate,
    /// Luminous exitance by quadrature, and corrected to the exactly known values. \[lm/m²\]
    found: [f64; 2],
    /// Distribution that is averaged.
    lid: Lid,
    /// Table without beams.
    scattered: OnceLock<CGammaTable>,
    /// Indices of the nodes of `scattered` around which the intensity changes steeply.
    steep: OnceLock<Vec<usize>>,
}

impl Averaged {
    /// Computes the averages of a distribution without its beams.
    ///
    /// Components that are functions are integrated by adaptive Gauss points, those on cells and by profile angle by
    /// sub-sampling; both are split at the façade's plane and at the horizon. Negative luminances count as negative.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    pub fn new(lid: &Lid, aim: Aim, step: Step, progress: &dyn Progress) -> Result<Self, Cancelled> {
        let grid = Grid { aim, step };
        let area = lid.area();
        let mut node_flux = vec![0.0; grid.planes() * grid.angles()];
        let mut flux = Estimate::default();
        let (mut raw, mut closed) = (0.0, 0.0);
        for part in &lid.parts {
            // Flux per area of the aperture \[lm/m²\] into the cell of each node.
            let (shares, total) = match part {
                EmergentLuminance::Uniform(l) => (grid.collect(&|_| *l, Rule::Smooth, progress)?, Some(PI * l)),
                EmergentLuminance::Cells { basis, luminance } => {
                    let exact = basis.projected_solid_angles().iter().zip(luminance).map(|(w, l)| w * l).sum();
                    let at = |d: Dir<Facade>| basis.index(d).map_or(0.0, |cell| luminance[cell]);
                    (grid.collect(&at, Rule::Piecewise, progress)?, Some(exact))
                }
                EmergentLuminance::Bands(light) => {
                    (grid.collect(&|d| light.at(d), Rule::Piecewise, progress)?, Some(light.share()))
                }
                EmergentLuminance::Function(f) => (grid.collect(&|d| f(d), Rule::Smooth, progress)?, None),
            };
            let sum: f64 = shares.iter().map(|share| share.value).sum();
            let error: f64 = shares.iter().map(|share| share.error).sum();
            let (total, error) = total.map_or((sum, error), |exact| (exact, 0.0));
            // If the flux is known exactly, the error of the quadrature is distributed over all cells proportionally.
            let closing = if sum != 0.0 { total / sum } else { 1.0 };
            flux += Estimate::new(total * area, error * area);
            raw += sum;
            closed += sum * closing;
            for (node, share) in node_flux.iter_mut().zip(&shares) {
                *node += share.value * closing * area;
            }
        }
        Ok(Self {
            grid,
            node_flux,
            flux,
            found: [raw, closed],
            lid: lid.clone(),
            scattered: OnceLock::new(),
            steep: OnceLock::new(),
        })
    }

    /// Returns the C-γ table of the whole aperture, with every beam spread over the four nodes around it.
    pub fn table(&self) -> CGammaTable {
        self.with(&self.lid.beams)
    }

    /// Returns the C-γ table of the aperture with only these beams, each spread over the four nodes around it.
    fn with(&self, beams: &[SunBeam]) -> CGammaTable {
        let grid = self.grid;
        let mut node_flux = self.node_flux.clone();
        let lit = || beams.iter().filter(|beam| beam.flux != 0.0);
        let mut of_beams = vec![0.0; if lit().next().is_none() { 0 } else { node_flux.len() }];
        for beam in lit() {
            grid.lay(&mut node_flux, beam);
            grid.lay(&mut of_beams, beam);
        }
        // The sum of nothing is −0.
        let beam_flux = beams.iter().map(|beam| beam.flux).sum::<f64>() + 0.0;
        let flux = self.flux + Estimate::exact(beam_flux);
        let intensity = grid.averages(&node_flux);
        let beams = if of_beams.is_empty() { of_beams } else { grid.averages(&of_beams) };
        let mut table = CGammaTable {
            aim: grid.aim,
            step: grid.step,
            c: grid.c(),
            gamma: grid.gamma(),
            intensity,
            flux,
            scaled_by: 1.0,
            beam_flux,
            beams,
            widened: None,
        };
        let read = table.zonal_flux();
        if read != 0.0 && flux.value != 0.0 {
            let scale = flux.value / read;
            for value in table.intensity.iter_mut().chain(&mut table.beams) {
                *value *= scale;
            }
            let [raw, closed] = self.found;
            table.scaled_by = if raw != 0.0 { scale * closed / raw } else { scale };
        }
        table
    }

    /// Returns the C-γ table of one tile, to be used as a point luminaire at the tile's centre. `panel`: the tile;
    /// `share`: its share of the aperture's area; `narrow`: whether scattered lobes narrower than the tile's angular
    /// size are widened, too. Beams are widened to the directions from the centre to the area that the tile lights;
    /// additional nodes lie close together there, and scattered light at them is interpolated linearly.
    pub fn tile(&self, panel: &Panel, share: f64, narrow: bool) -> CGammaTable {
        let scattered = self.scattered.get_or_init(|| self.with(&[]));
        let mut table = scattered.clone();
        if narrow {
            let steep = self.steep.get_or_init(|| narrow::nodes(scattered));
            narrow::widen(&mut table, steep, &self.lid, panel, share);
        }
        table.intensity.iter_mut().for_each(|value| *value *= share);
        table.flux = table.flux * share;
        let spot = |beam: &SunBeam| {
            let beam = SunBeam { flux: share * beam.flux, ..*beam };
            Spot { beam, panel: panel.part(panel.distance(&beam)).under(&beam) }
        };
        let lit = self.lid.beams.iter().filter(|beam| beam.flux != 0.0);
        spots::lay(&mut table, &lit.map(spot).collect::<Vec<_>>());
        table
    }

    /// Whether the tables of all tiles of one size are the same, so that one luminaire file is enough. `narrow`:
    /// whether narrow scattered lobes are widened.
    pub fn same_for_all(&self, narrow: bool) -> bool {
        let steep = || narrow::nodes(self.scattered.get_or_init(|| self.with(&[])));
        self.lid.beams.iter().all(|beam| beam.flux == 0.0) && (!narrow || self.steep.get_or_init(steep).is_empty())
    }
}

/// Assumption of the quadrature on the luminance inside the solid angle of a node.
#[derive(Clone, Copy, PartialEq)]
enum Rule {
    /// Luminance smooth nearly everywhere: Gauss points, refined where two orders disagree.
    Smooth,
    /// Luminance with steps along arbitrary lines: many points of equal weight.
    Piecewise,
}

#[derive(Debug, Clone, Copy)]
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

    fn c(self) -> Vec<f64> {
        (0..self.planes()).map(|plane| plane as f64 * self.step.radians()).collect()
    }

    fn gamma(self) -> Vec<f64> {
        (0..self.angles()).map(|angle| angle as f64 * self.step.radians()).collect()
    }

    /// Integrates L cosθ dω over the cell of every node, plane by plane.
    fn collect(
        self,
        luminance: &(dyn Fn(Dir<Facade>) -> f64 + Sync),
        rule: Rule,
        progress: &dyn Progress,
    ) -> Result<Vec<Estimate>, Cancelled> {
        let delta = self.step.radians();
        let angles = self.angles();
        // Flux per area of the aperture and per dC dγ.
        let density = |c: f64, gamma: f64| {
            let undeviated = self.aim.direction(c, gamma).undeviated_incident();
            let cos_theta = undeviated.vector().z;
            if cos_theta > 0.0 { luminance(undeviated) * cos_theta * gamma.sin() } else { 0.0 }
        };
        (0..self.planes() * angles)
            .into_par_iter()
            .map(|node| {
                // The luminance behind obstructions takes seconds for all nodes.
                if progress.cancelled() {
                    return Err(Cancelled);
                }
                let (c, gamma) = ((node / angles) as f64 * delta, (node % angles) as f64 * delta);
                // Nodes lie in the façade's plane and on the horizon: their cells are divided there.
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
                Ok(sum)
            })
            .collect()
    }

    /// Spreads a beam over the four nodes around it so that its mean direction in C and γ is unchanged.
    fn lay(self, node_flux: &mut [f64], beam: &SunBeam) {
        let delta = self.step.radians();
        let (c, gamma) = self.aim.angles(beam.direction);
        let (c, gamma) = (c / delta, gamma / delta);
        let (i, j) = (c.floor() as i64, (gamma.floor() as usize).min(self.angles() - 2));
        let (u, v) = (c - i as f64, gamma - j as f64);
        for (plane, share_c) in [(i, 1.0 - u), (i + 1, u)] {
            let plane = plane.rem_euclid(self.planes() as i64) as usize;
            for (angle, share_gamma) in [(j, 1.0 - v), (j + 1, v)] {
                node_flux[plane * self.angles() + angle] += beam.flux * share_c * share_gamma;
            }
        }
    }

    /// Computes mean intensities from the fluxes of the cells. The cells at nadir and zenith are one direction in all
    /// planes.
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

/// Gauss–Legendre points on −1 … 1 and weights of sum 1: ±1/√3, exact for polynomials up to degree 3.
const GAUSS_2: [(f64, f64); 2] = [(-0.577_350_269_189_625_8, 0.5), (0.577_350_269_189_625_8, 0.5)];
/// Gauss–Legendre points on −1 … 1 and weights of sum 1: 0 and ±√(3/5), exact for polynomials up to degree 5.
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

/// Integrates by Gauss points of third order, refined where the second order disagrees by more than 0.1 %.
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
