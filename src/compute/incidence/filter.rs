//! Filter for diffuse light by eq 13 of the IEA SHC Task 31 report (2005), corrected: every indicatrix (q over the
//! emergent directions for one incident direction) is spread over the solid angle of the patch that its incident
//! direction represents, so that the sum over patches becomes smooth.
//!
//! Three corrections. The kernel is normalised by flux for every lobe and base of every indicatrix, so that τ is
//! unchanged (eq 13's unit is q·sr; dividing by the solid angle shifts τ by up to 2 %). It has the shape of the patch
//! itself, shifted in direction cosines like light through plane layers, and rotated or mirrored according to the
//! lobe's response: patches tile, round kernels leave gaps and overlaps whatever their width. And it may be applied to
//! the lobes alone: the smooth base is wide enough without a filter. The round kernels of the report's Figure 8 and
//! light without filter are there for comparison.

use super::grid::Grid;
use super::model::Model;
use crate::compute::basis::{Cell, Resampling, RingBasis};
use glam::{DMat2, DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Kernel of the filter for diffuse light: the angular region over which the light of an indicatrix is spread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kernel {
    /// No filter: light stays in the directions of the data.
    None,
    /// Circular cone of constant luminance with this half-angle. \[rad\]
    Cone(f64),
    /// Shape of the patch of the incident hemisphere that the indicatrix's incident direction represents.
    Patch,
}

impl Kernel {
    /// Circular kernel of 6° diameter, half as wide as Tregenza's patches (IEA SHC Task 31 report, Figure 8).
    pub const NARROW: Self = Self::Cone(3.0 * PI / 180.0);
    /// Circular kernel of 12° diameter, as wide as Tregenza's patches (IEA SHC Task 31 report, Figure 8).
    pub const MATCHED: Self = Self::Cone(6.0 * PI / 180.0);
    /// Circular kernel of 24° diameter, twice as wide as Tregenza's patches (IEA SHC Task 31 report, Figure 8).
    pub const WIDE: Self = Self::Cone(12.0 * PI / 180.0);
}

/// Filter for diffuse light: a kernel, and whether it spreads whole indicatrices or their lobes alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filter {
    /// Angular region over which the filter spreads light.
    pub kernel: Kernel,
    /// Whether only the lobes of an indicatrix are filtered, which is more accurate; otherwise the whole indicatrix, by
    /// eq 13 of the IEA SHC Task 31 report.
    pub sharp_only: bool,
}

/// Computes the luminance of the room side on the emergent cells of `target`, from the filtered indicatrices. \[cd/m²\]
/// `illuminance`: illuminance of the aperture from each patch of the outer hemisphere \[lx\], in the order of the
/// incident directions. `None` if the incident directions of the data do not represent patches of a hemisphere.
pub fn diffuse(model: &Model, filter: Filter, target: &Grid, illuminance: &[f64]) -> Option<Vec<f64>> {
    let spreader = Spreader::new(model, filter, target)?;
    // In fixed portions, added in order: the result is identical for any number of threads.
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

/// Computation of the filtered indicatrices of one model on one set of emergent cells.
pub struct Spreader<'a> {
    model: &'a Model,
    filter: Filter,
    target: &'a Grid,
    patches: &'a RingBasis,
    /// Resampling from the emergent cells of the data to those of `target`.
    resampling: Resampling,
}

impl<'a> Spreader<'a> {
    /// Creates the computation for the emergent cells of `target`; `None` if the incident directions of the data do not
    /// represent patches of a hemisphere.
    pub fn new(model: &'a Model, filter: Filter, target: &'a Grid) -> Option<Self> {
        let patches = model.data.lattice()?;
        let resampling = Resampling::new(model.grid.basis(), target.basis());
        Some(Self { model, filter, target, patches, resampling })
    }

    /// Returns q of the filtered indicatrix of one incident direction (by index) on the cells of the target; its flux
    /// is τ of the data. \[1/sr\]
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

    /// Scales the values `q` of a lobe or base so that their flux is exactly `flux`. Light that lies outside the
    /// hemisphere altogether is assigned to the cell nearest to `place`.
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

    /// Returns the cell means of light that a kernel spreads round points of given flux. Few points make sharp edges,
    /// which need more directions per cell.
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
            // The slack covers the size of the cell: a footprint farther away does not touch it.
            if footprint.distance(self.target.centre[cell], centre) > reach + 2.0 * self.target.solid[cell].sqrt() {
                continue;
            }
            *q = self
                .target
                .cell_mean(cell, directions, |d| points.iter().map(|&(p, flux)| flux * footprint.at(d, p, back)).sum());
        }
        out
    }

    /// Returns the mean of copies of a base that are shifted over the kernel.
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

/// Region in which a kernel about a point of light is not zero.
struct Footprint {
    kernel: Kernel,
    cos_reach: f64,
    /// Largest distance over which the kernel spreads light: a chord of the unit sphere for [`Kernel::Cone`], a
    /// difference of direction cosines for [`Kernel::Patch`].
    reach: f64,
    /// Direction cosines x and y of the patch's centre.
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

    /// Returns the distance of two directions in the unit of `reach`: chord for a cone, difference of direction cosines
    /// for a patch.
    fn distance(&self, a: DVec3, b: DVec3) -> f64 {
        match self.kernel {
            Kernel::Patch => (a - b).truncate().length(),
            _ => a.distance(b),
        }
    }

    /// Returns the weight of the kernel about `p` in direction `d`: 1 inside, 0 outside.
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

/// Displacement of a base within the kernel.
enum Offset {
    Cosines(DVec2),
    Angle(DVec2),
}

/// Returns 16 displacements of equal weight that represent a kernel for smooth values.
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
