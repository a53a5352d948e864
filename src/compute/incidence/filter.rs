//! The report's filter for diffuse light (eq 13), corrected: every indicatrix spread over the patch that its direction
//! stands for, so that the sum over patches becomes smooth.
//!
//! Three corrections. The kernel is normalised by flux for every part of every indicatrix, so that τ stays what it was
//! (eq 13's unit is q·sr; dividing by the solid angle shifts τ by up to 2 %). It has the shape of the patch itself,
//! shifted in direction cosines as plane layers do it, and turned or mirrored as the lobe moves: patches tile, round
//! kernels leave gaps and overlaps whatever their width. And it may leave the base alone: what is wide already needs no
//! filter. The round kernels of the report's Figure 8 and light without filter are there for comparison.

use super::grid::Grid;
use super::model::Model;
use crate::compute::basis::{Cell, Resampling, RingBasis};
use glam::{DMat2, DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Kernel that spreads the light of an indicatrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kernel {
    /// No spreading.
    None,
    /// Constant luminance within this angle. \[rad\]
    Cone(f64),
    /// The cell of the incident lattice that a direction stands for.
    Patch,
}

impl Kernel {
    /// Kernel of the report's Figure 8, half as wide as patches: 6° across.
    pub const NARROW: Self = Self::Cone(3.0 * PI / 180.0);
    /// Kernel of the report's Figure 8, as wide as patches: 12° across.
    pub const MATCHED: Self = Self::Cone(6.0 * PI / 180.0);
    /// Kernel of the report's Figure 8, twice as wide as patches: 24° across.
    pub const WIDE: Self = Self::Cone(12.0 * PI / 180.0);
}

/// Kernel and the part of an indicatrix that it is used on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filter {
    /// Kernel of the filter.
    pub kernel: Kernel,
    /// Whether lobes alone are filtered, which is better; otherwise the whole indicatrix, as in the report.
    pub sharp_only: bool,
}

/// Computes the luminance on the cells of `target` from the illuminance \[lx\] through the patches of the data's
/// lattice. \[cd/m²\] `None` if the data's directions are not a lattice of patches.
pub fn diffuse(model: &Model, filter: Filter, target: &Grid, illuminance: &[f64]) -> Option<Vec<f64>> {
    let spreader = Spreader::new(model, filter, target)?;
    // In fixed portions, added in order: the same bits for any number of threads.
    let parts: Vec<Vec<f64>> = (0..illuminance.len().min(model.lattice.points().len()))
        .collect::<Vec<usize>>()
        .par_chunks(8)
        .map(|list| {
            let mut sum = vec![0.0; target.centre.len()];
            for &i in list.iter().filter(|i| illuminance[**i] != 0.0) {
                spreader.indicatrix(i).iter().zip(&mut sum).for_each(|(q, sum)| *sum += q * illuminance[i]);
            }
            sum
        })
        .collect();
    let mut luminance = vec![0.0; target.centre.len()];
    for part in parts {
        luminance.iter_mut().zip(part).for_each(|(sum, l)| *sum += l);
    }
    Some(luminance)
}

/// Filter of the indicatrices of one model onto one set of cells.
pub struct Spreader<'a> {
    model: &'a Model,
    filter: Filter,
    target: &'a Grid,
    patches: &'a RingBasis,
    /// Resampling from the data's cells to the target's.
    resampling: Resampling,
}

impl<'a> Spreader<'a> {
    /// Creates the filter; `None` if the data's directions are not a lattice of patches.
    pub fn new(model: &'a Model, filter: Filter, target: &'a Grid) -> Option<Self> {
        let patches = model.data.lattice()?;
        let resampling = Resampling::new(model.grid.basis(), target.basis());
        Some(Self { model, filter, target, patches, resampling })
    }

    /// Returns the filtered indicatrix of one direction; its flux is τ. \[1/sr\]
    pub fn indicatrix(&self, incident: usize) -> Vec<f64> {
        let model = self.model;
        let mut sum = vec![0.0; self.target.centre.len()];
        let patch = self.patches.cell(incident);
        for (l, lobe) in model.lobes[incident].iter().enumerate() {
            let points: Vec<(DVec3, f64)> =
                lobe.cells(&model.grid).map(|(k, q)| (model.grid.centre[k], q * model.grid.projected[k])).collect();
            let turn = turn_of(model.responses.jacobian[incident][l]);
            let mut out = match self.filter.kernel {
                Kernel::None => {
                    let mut own = vec![0.0; model.grid.centre.len()];
                    lobe.cells(&model.grid).for_each(|(k, q)| own[k] = q);
                    self.resampling.apply(&own)
                }
                kernel => self.spread(kernel, &patch, &points, turn),
            };
            self.normalise(&mut out, lobe.flux, lobe.centre);
            sum.iter_mut().zip(out).for_each(|(sum, q)| *sum += q);
        }
        if model.base_flux[incident] <= 0.0 {
            return sum;
        }
        let base = model.base(incident);
        let mut out = match self.filter.kernel {
            kernel if !self.filter.sharp_only && kernel != Kernel::None => self.smoothed(kernel, &patch, &base),
            _ => self.resampling.apply(&base),
        };
        self.normalise(&mut out, model.base_flux[incident], DVec3::Z);
        sum.iter_mut().zip(out).for_each(|(sum, q)| *sum += q.max(0.0));
        sum
    }

    /// Gives a picture exactly its flux; one that fell off the hemisphere lands at its rim.
    fn normalise(&self, q: &mut [f64], flux: f64, place: DVec3) {
        let own: f64 = q.iter().zip(&self.target.projected).map(|(q, w)| q.max(0.0) * w).sum();
        if own > 0.0 {
            q.iter_mut().for_each(|q| *q = q.max(0.0) * (flux / own));
        } else if flux > 0.0 {
            let dot = |k: &usize| self.target.centre[*k].dot(place);
            if let Some(k) = (0..q.len()).max_by(|a, b| dot(a).total_cmp(&dot(b))) {
                q[k] = flux / self.target.projected[k];
            }
        }
    }

    /// Spreads points of light by a kernel, as cell means. Few points make sharp edges, which need more directions per
    /// cell.
    fn spread(&self, kernel: Kernel, patch: &Cell, points: &[(DVec3, f64)], turn: DMat2) -> Vec<f64> {
        let directions = match points.len() {
            0..=60 => 3,
            61..=250 => 2,
            _ => 1,
        };
        let footprint = Footprint::new(kernel, patch);
        let back = turn.transpose();
        let centre = points.iter().map(|(p, f)| *p * *f).sum::<DVec3>().normalize_or_zero();
        let reach = footprint.reach + points.iter().map(|(p, _)| footprint.distance(*p, centre)).fold(0.0, f64::max);
        let mut out = vec![0.0; self.target.centre.len()];
        for (cell, q) in out.iter_mut().enumerate() {
            // A cell's own size is within the slack: edges beyond it change no mean.
            if footprint.distance(self.target.centre[cell], centre) > reach + 2.0 * self.target.solid[cell].sqrt() {
                continue;
            }
            *q = self
                .target
                .cell_mean(cell, directions, |d| points.iter().map(|&(p, flux)| flux * footprint.at(d, p, back)).sum());
        }
        out
    }

    /// Returns a base moved over the kernel and averaged.
    fn smoothed(&self, kernel: Kernel, patch: &Cell, base: &[f64]) -> Vec<f64> {
        let grid = &self.model.grid;
        let offsets = offsets(kernel, patch);
        let value = |d: DVec3| -> f64 {
            let around = grid.around_rings(d);
            around.iter().map(|&(ring, k, _, w)| w * base[grid.basis().first_cell(ring) + k]).sum()
        };
        let mean = |d: &DVec3| {
            let moved = offsets.iter().map(|offset| match offset {
                Offset::Cosines(step) => {
                    let p = d.truncate() - *step;
                    let rest = 1.0 - p.length_squared();
                    if rest > 0.0 { value(p.extend(rest.sqrt())) } else { 0.0 }
                }
                Offset::Angle(step) => {
                    let (x, y) = d.any_orthonormal_pair();
                    let e = (*d + x * step.x + y * step.y).normalize_or(*d);
                    if e.z > 0.0 { value(e) } else { 0.0 }
                }
            });
            moved.sum::<f64>() / offsets.len() as f64
        };
        self.target.centre.iter().map(mean).collect()
    }
}

/// Returns the rotation or reflection nearest to a response, which shifts patches without changing their size.
fn turn_of(response: DMat2) -> DMat2 {
    let (a, b, c, d) = (response.x_axis.x, response.x_axis.y, response.y_axis.x, response.y_axis.y);
    if response.determinant() >= 0.0 {
        DMat2::from_angle((b - c).atan2(a + d))
    } else {
        let (sin, cos) = (b + c).atan2(a - d).sin_cos();
        DMat2::from_cols(DVec2::new(cos, sin), DVec2::new(sin, -cos))
    }
}

/// Kernel about a point of light: the region where it is not zero.
struct Footprint {
    kernel: Kernel,
    cos_reach: f64,
    /// Largest distance that the kernel spreads: as a chord when round, in direction cosines as a patch.
    reach: f64,
    /// Direction of the patch, as direction cosines.
    own: DVec2,
    /// Limits of the patch in sin²θ.
    limits: [f64; 2],
    /// Direction of the patch's middle in azimuth.
    axis: DVec2,
    /// Half the patch's width in azimuth. \[rad\]
    half: f64,
}

impl Footprint {
    fn new(kernel: Kernel, patch: &Cell) -> Self {
        let limits = [patch.theta_min.sin().powi(2), patch.theta_max.sin().powi(2)];
        let own = patch.centre().vector().truncate();
        let (inner, outer, half) = (limits[0].sqrt(), limits[1].sqrt(), 0.5 * patch.width);
        let corners = [inner, outer].map(|r| (own - r * DVec2::from_angle(patch.phi + half)).length());
        let chord = |angle: f64| 2.0 * (0.5 * angle.min(PI)).sin();
        let reach = match kernel {
            Kernel::Cone(angle) => chord(angle),
            _ if patch.is_cap() => outer,
            _ => corners[0].max(corners[1]).max((own.length() - inner).abs()).max((outer - own.length()).abs()),
        };
        let cos_reach = if let Kernel::Cone(angle) = kernel { angle.min(PI).cos() } else { -1.0 };
        Self { kernel, cos_reach, reach, own, limits, axis: DVec2::from_angle(patch.phi), half }
    }

    /// Returns the distance in the measure of `reach`.
    fn distance(&self, a: DVec3, b: DVec3) -> f64 {
        match self.kernel {
            Kernel::Patch => (a - b).truncate().length(),
            _ => a.distance(b),
        }
    }

    /// Returns the weight in direction `d` of light at `p`.
    #[inline]
    fn at(&self, d: DVec3, p: DVec3, back: DMat2) -> f64 {
        match self.kernel {
            Kernel::Cone(_) => f64::from(u8::from(d.dot(p) >= self.cos_reach)),
            Kernel::Patch | Kernel::None => {
                let moved = self.own + back * (d - p).truncate();
                let square = moved.length_squared();
                let ring = square >= self.limits[0] && square < self.limits[1];
                let sector = self.half >= PI || self.axis.dot(moved) >= square.sqrt() * self.half.cos();
                f64::from(u8::from(ring && sector))
            }
        }
    }
}

/// A step of the kernel.
enum Offset {
    Cosines(DVec2),
    Angle(DVec2),
}

/// Returns 16 steps of equal weight that represent a kernel where the picture is smooth.
fn offsets(kernel: Kernel, patch: &Cell) -> Vec<Offset> {
    let pairs = (0..16).map(|k| ((f64::from(k / 4) + 0.5) / 4.0, (f64::from(k % 4) + 0.5) / 4.0));
    let own = patch.centre().vector().truncate();
    pairs
        .map(|(s, t)| match kernel {
            Kernel::Patch | Kernel::None => {
                let (low, high) = (patch.theta_min.sin().powi(2), patch.theta_max.sin().powi(2));
                let phi = patch.phi + patch.width * (t - 0.5);
                Offset::Cosines((low + (high - low) * s).sqrt() * DVec2::from_angle(phi) - own)
            }
            Kernel::Cone(angle) => Offset::Angle(angle * s.sqrt() * DVec2::from_angle(2.0 * PI * (t + 0.3 * s))),
        })
        .collect()
}

#[cfg(test)]
mod tests;
