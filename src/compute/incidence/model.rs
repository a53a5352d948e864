//! Indicatrix (q over the emergent directions) of any incident direction, interpolated from those of the data's
//! incident directions.

use super::flux::{Bump, Field, Slopes, along_one_line, bump, missed_behind, slopes};
use super::grazing::Grazing;
use super::grid::Grid;
use super::lattice::{Lattice, Place, tangent_step};
use super::lobes::{Lobe, Splitter};
use super::raster::Raster;
use super::response::{Responses, gradient, lift};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::Indicatrices;
use crate::compute::direction::{Dir, Facade};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::sync::Arc;

/// Lobe of an indicatrix of the data, shifted to another centre and scaled to another flux.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Copy {
    /// Index of the incident direction of the data that the lobe comes from.
    pub vertex: usize,
    /// Index of the lobe at that direction.
    pub lobe: usize,
    /// Unit vector to the centre of the shifted lobe, as a direction of undeviated light (reversed emergent direction,
    /// façade frame).
    pub centre: DVec3,
    /// Flux of the shifted lobe as a share of the incident flux; above 0.
    pub flux: f64,
    /// Flux of the lobe as a share of the incident flux, if it were interpolated linearly.
    pub linear: f64,
}

/// Smooth base of an indicatrix of the data, and its weight in an interpolated indicatrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Base {
    /// Index of the incident direction of the data that the base comes from.
    pub vertex: usize,
    /// Weight of the base when the flux of the bases is interpolated to second order.
    pub factor: f64,
    /// Weight of the base when the flux of the bases is interpolated linearly.
    pub linear: f64,
}

/// Interpolated indicatrix as a list of its components: weighted bases and shifted lobes of the data.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Recipe {
    /// Bases of the surrounding incident directions with their weights.
    pub bases: Vec<Base>,
    /// Shifted lobes of the surrounding incident directions.
    pub copies: Vec<Copy>,
}

/// Model for interpolation between incident directions: the indicatrices of the data, divided into bases and lobes, and
/// the change of each lobe with the incident direction.
pub struct Model {
    pub(super) data: Arc<Indicatrices>,
    pub(super) grid: Arc<Grid>,
    pub(super) lattice: Lattice,
    pub(super) lobes: Vec<Vec<Lobe>>,
    pub(super) responses: Responses,
    /// Samples of the lobes on square grids, by incident direction and lobe.
    pub(super) rasters: Vec<Vec<Raster>>,
    /// Flux of the base of every incident direction, as a share of the incident flux.
    pub(super) base_flux: Vec<f64>,
    /// Terms that the edges of the triangulation add to linear interpolation of the flux, for lobes that exist at both
    /// ends; by incident direction, lobe (the base after the last lobe) and neighbour.
    bumps: Vec<Vec<Vec<Option<Bump>>>>,
    /// Flux that a lobe's slope predicts at a neighbour without the lobe, at most 0; by incident direction, lobe and
    /// neighbour.
    followed: Vec<Vec<Vec<f64>>>,
    grazing: Vec<Option<Grazing>>,
}

/// Fluxes of the lobes at all incident directions, as a scalar to interpolate.
struct LobeFlux<'a>(&'a [Vec<Lobe>], &'a Responses, &'a [Option<Grazing>]);

impl Field for LobeFlux<'_> {
    fn value(&self, vertex: usize, lobe: usize) -> f64 {
        self.0[vertex][lobe].flux
    }
    fn partner(&self, vertex: usize, lobe: usize, neighbour: usize) -> Option<usize> {
        self.1.partner[vertex][neighbour][lobe]
    }
    fn at_grazing(&self, vertex: usize, lobe: usize) -> Option<f64> {
        self.2[vertex].map(|grazing| grazing.factor(1.0) * self.value(vertex, lobe))
    }
}

/// Fluxes of the bases at all incident directions, as a scalar to interpolate; every direction has one.
struct BaseFlux<'a>(&'a [f64], &'a [Option<Grazing>]);

impl Field for BaseFlux<'_> {
    fn value(&self, vertex: usize, _: usize) -> f64 {
        self.0[vertex]
    }
    fn partner(&self, _: usize, _: usize, _: usize) -> Option<usize> {
        Some(0)
    }
    fn at_grazing(&self, vertex: usize, lobe: usize) -> Option<f64> {
        self.1[vertex].map(|grazing| grazing.factor(1.0) * self.value(vertex, lobe))
    }
}

/// Returns the terms that all edges from an incident direction add to linear interpolation of a lobe's scalar; `None`
/// where the neighbour lacks the lobe.
fn bumps_of(lattice: &Lattice, field: &impl Field, vertex: usize, lobe: usize) -> Vec<Option<Bump>> {
    let own = slopes(lattice, field, vertex, lobe);
    let of = |v: usize, l: usize| slopes(lattice, field, v, l);
    (0..lattice.neighbours(vertex).len())
        .map(|k| {
            let other = field.partner(vertex, lobe, k)?;
            let there = lattice.neighbours(vertex)[k];
            let back = lattice.neighbours(there).binary_search(&vertex).ok()?;
            let values = [field.value(vertex, lobe), field.value(there, other)];
            let behind = [
                missed_behind(lattice, field, of, (vertex, lobe), k),
                missed_behind(lattice, field, of, (there, other), back),
            ];
            Some(bump(values, [(&own, k), (&of(there, other), back)], behind))
        })
        .collect()
}

/// Returns the flux of a lobe extrapolated to each neighbour by the slope from the neighbours on the other side; at
/// most 0, and 0 where the lobe exists again beyond the neighbour (a flux that only touches zero, like the share that a
/// panel deflects).
fn followed_of(
    lattice: &Lattice,
    field: &impl Field,
    returns: impl Fn(usize) -> bool,
    vertex: usize,
    lobe: usize,
) -> Vec<f64> {
    let Slopes { one_sided, .. } = slopes(lattice, field, vertex, lobe);
    let here = lattice.points()[vertex];
    let neighbours = lattice.neighbours(vertex);
    let value = field.value(vertex, lobe);
    let samples: Vec<(DVec2, f64)> = (0..neighbours.len())
        .filter_map(|k| {
            let change = field.value(neighbours[k], field.partner(vertex, lobe, k)?) - value;
            Some((tangent_step(here, lattice.points()[neighbours[k]]), change))
        })
        .collect();
    let all = gradient(&samples).or_else(|| along_one_line(&samples)).unwrap_or(DVec2::ZERO);
    (0..neighbours.len())
        .map(|k| {
            if returns(neighbours[k]) {
                return 0.0;
            }
            let step = one_sided[k].unwrap_or_else(|| all.dot(tangent_step(here, lattice.points()[neighbours[k]])));
            (value + step).min(0.0)
        })
        .collect()
}

impl Model {
    /// Returns the memory that the samples of its lobes take. \[bytes\]
    pub fn bytes(&self) -> usize {
        self.rasters.iter().flatten().map(Raster::bytes).sum()
    }

    /// Creates the model of measured indicatrices: divides each into base and lobes and follows the lobes to the
    /// neighbouring incident directions.
    pub fn new(data: Arc<Indicatrices>) -> Self {
        let grid = Grid::new(data.emergent());
        let lattice = Lattice::new(data.incident());
        let splitter = Splitter::new(&grid);
        let lobes: Vec<Vec<Lobe>> =
            (0..data.incident().len()).into_par_iter().map(|i| splitter.lobes(&grid, &data.row(i))).collect();
        let base_flux: Vec<f64> = (0..lobes.len())
            .map(|i| (data.tau_by_direction()[i] - lobes[i].iter().map(|lobe| lobe.flux).sum::<f64>()).max(0.0))
            .collect();
        let rasters = lobes.par_iter().map(|list| list.iter().map(|lobe| Raster::new(&grid, lobe)).collect()).collect();
        let fitted = Self::fitted(data, Arc::new(grid), lattice, (lobes, base_flux), |_| true);
        Self { rasters, ..fitted }
    }

    /// Creates a model from indicatrices already divided into lobes and bases. Fluxes between directions are computed
    /// only at incident directions that are `wanted`; recipes there are complete, but without rasters lobes cannot be
    /// evaluated on cells.
    pub(super) fn fitted(
        data: Arc<Indicatrices>,
        grid: Arc<Grid>,
        lattice: Lattice,
        (lobes, base_flux): (Vec<Vec<Lobe>>, Vec<f64>),
        wanted: impl Fn(usize) -> bool + Sync,
    ) -> Self {
        let responses = Responses::new(&lattice, &lobes);
        let grazing: Vec<Option<Grazing>> =
            (0..lobes.len()).map(|v| Grazing::new(&lattice, data.tau_by_direction(), v)).collect();
        let (lobe_flux, base) = (LobeFlux(&lobes, &responses, &grazing), BaseFlux(&base_flux, &grazing));
        let (bumps, followed) = (0..lobes.len())
            .into_par_iter()
            .map(|v| {
                if !wanted(v) {
                    return Default::default();
                }
                let mut bumps: Vec<_> = (0..lobes[v].len()).map(|l| bumps_of(&lattice, &lobe_flux, v, l)).collect();
                bumps.push(bumps_of(&lattice, &base, v, 0));
                let followed: Vec<_> = (0..lobes[v].len())
                    .map(|l| {
                        let returns = |n: usize| responses.returns(&lattice, &lobes, (v, l), n);
                        followed_of(&lattice, &lobe_flux, returns, v, l)
                    })
                    .collect();
                (bumps, followed)
            })
            .unzip();
        Self { data, grid, lattice, lobes, responses, rasters: Vec::new(), base_flux, bumps, followed, grazing }
    }

    /// Returns the emergent cells of the data.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Returns the basis whose patches the incident directions of the data represent; `None` if they are not the
    /// centres of such patches.
    pub fn lattice_cells(&self) -> Option<&RingBasis> {
        self.data.lattice()
    }

    /// Returns the triangulation of the incident directions of the data.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Returns the interpolated indicatrix for an incident direction as weighted bases and shifted lobes, each lobe
    /// shifted by its response.
    pub fn recipe(&self, incident: Dir<Facade>) -> Recipe {
        let place = self.lattice.locate(incident);
        let used: Vec<(usize, f64)> =
            (0..3).map(|k| (place.vertices[k], place.weights[k])).filter(|(_, w)| *w > 1e-12).collect();
        let mut recipe = Recipe { bases: self.bases(&used), copies: Vec::with_capacity(6) };
        for family in self.families(&used) {
            self.family(&used, &family, incident.vector(), &mut recipe.copies);
        }
        if place.beyond > 0.0 {
            self.fade(&place, &mut recipe);
        }
        self.limit(&used, &mut recipe);
        recipe
    }

    /// Scales a recipe so that its flux does not exceed the incident flux, unless τ of the data does.
    fn limit(&self, used: &[(usize, f64)], recipe: &mut Recipe) {
        let most = used.iter().map(|&(v, _)| self.data.tau_by_direction()[v]).fold(1.0, f64::max);
        let bases: f64 = recipe.bases.iter().map(|base| base.factor * self.base_flux[base.vertex]).sum();
        let total = bases + recipe.copies.iter().map(|copy| copy.flux).sum::<f64>();
        if total > most {
            let scale = most / total;
            recipe.bases.iter_mut().for_each(|base| base.factor *= scale);
            recipe.copies.iter_mut().for_each(|copy| copy.flux *= scale);
        }
    }

    /// Returns the bases with their barycentric weights, scaled so that their flux is interpolated to second order.
    fn bases(&self, used: &[(usize, f64)]) -> Vec<Base> {
        let linear: f64 = used.iter().map(|&(v, w)| w * self.base_flux[v]).sum();
        let mut flux = linear;
        for (k, &(a, wa)) in used.iter().enumerate() {
            for &(b, wb) in &used[k + 1..] {
                let k = self.neighbour(a, b);
                flux += k.and_then(|k| self.bumps[a][self.lobes[a].len()][k]).map_or(0.0, |bump| bump.at(wa, wb));
            }
        }
        let factor = if linear > 0.0 { (flux / linear).max(0.0) } else { 1.0 };
        used.iter().map(|&(vertex, w)| Base { vertex, factor: w * factor, linear: w }).collect()
    }

    /// Returns the index of the direction `to` among the neighbours of `from`.
    fn neighbour(&self, from: usize, to: usize) -> Option<usize> {
        self.lattice.neighbours(from).binary_search(&to).ok()
    }

    /// Returns the index of the lobe at the direction `to` that corresponds to a lobe at `from`.
    fn partner(&self, from: usize, lobe: usize, to: usize) -> Option<usize> {
        self.responses.partner[from][self.neighbour(from, to)?][lobe]
    }

    /// Returns the families of corresponding lobes at up to three incident directions: for each family the index of its
    /// lobe at each direction, or `None`.
    fn families(&self, used: &[(usize, f64)]) -> Vec<[Option<usize>; 3]> {
        let mut families: Vec<[Option<usize>; 3]> = Vec::with_capacity(4);
        for (k, &(v, _)) in used.iter().enumerate() {
            for lobe in 0..self.lobes[v].len() {
                let own = families.iter_mut().find(|family| {
                    family[k].is_none()
                        && (0..k).any(|j| {
                            family[j].is_some_and(|other| {
                                self.partner(used[j].0, other, v) == Some(lobe)
                                    || self.partner(v, lobe, used[j].0) == Some(other)
                            })
                        })
                });
                match own {
                    Some(family) => family[k] = Some(lobe),
                    None => {
                        let mut family = [None; 3];
                        family[k] = Some(lobe);
                        families.push(family);
                    }
                }
            }
        }
        families
    }

    /// Adds the shifted lobes of one family for the incident direction `d`. At directions without the lobe, its flux
    /// extrapolated from the others (at most 0) is used, so that the end of a lobe (a blind's cut-off) lies where its
    /// slope predicts it.
    fn family(&self, used: &[(usize, f64)], family: &[Option<usize>; 3], d: DVec3, copies: &mut Vec<Copy>) {
        let points = self.lattice.points();
        let present: Vec<(usize, f64, usize)> =
            used.iter().zip(family).filter_map(|(&(v, w), lobe)| lobe.map(|lobe| (v, w, lobe))).collect();
        let weight: f64 = present.iter().map(|(_, w, _)| w).sum();
        if weight <= 1e-12 {
            return;
        }
        let linear: f64 = present.iter().map(|&(v, w, l)| w * self.lobes[v][l].flux).sum();
        let mut flux = linear;
        for (&(absent, w), _) in used.iter().zip(family).filter(|(_, lobe)| lobe.is_none()) {
            let followed: f64 = present
                .iter()
                .map(|&(v, wv, l)| self.neighbour(v, absent).map_or(0.0, |k| wv * self.followed[v][l][k]))
                .sum();
            flux += w * followed / weight;
        }
        for (k, &(a, wa, la)) in present.iter().enumerate() {
            for &(b, wb, lb) in &present[k + 1..] {
                // Only lobes that correspond to each other have a correction; it is the same in both directions.
                let k = self.neighbour(a, b).filter(|&k| self.responses.partner[a][k][la] == Some(lb));
                flux += k.and_then(|k| self.bumps[a][la][k]).map_or(0.0, |bump| bump.at(wa, wb));
            }
        }
        if flux <= 0.0 {
            return;
        }
        for &(v, w, l) in &present {
            let lobe = &self.lobes[v][l];
            let step = (d - points[v]).truncate();
            let centre = lift(lobe.centre.truncate() + self.responses.jacobian[v][l] * step);
            let share = w * lobe.flux / linear;
            copies.push(Copy { vertex: v, lobe: l, centre, flux: flux * share, linear: linear * share });
        }
    }

    /// Scales a recipe beyond the border of the data by the extrapolation of τ to θ = 90°.
    fn fade(&self, place: &Place, recipe: &mut Recipe) {
        let factor: f64 = (0..3)
            .map(|k| place.weights[k] * self.grazing[place.vertices[k]].map_or(1.0, |g| g.factor(place.beyond)))
            .sum();
        recipe
            .bases
            .iter_mut()
            .for_each(|base| (base.factor, base.linear) = (base.factor * factor, base.linear * factor));
        recipe.copies.retain(|_| factor > 0.0);
        recipe.copies.iter_mut().for_each(|copy| (copy.flux, copy.linear) = (copy.flux * factor, copy.linear * factor));
    }

    /// Returns the angular diameter of the narrowest lobe of all indicatrices; infinite without lobes. \[rad\]
    pub fn narrowest_lobe(&self) -> f64 {
        self.lobes.iter().flatten().map(|lobe| 2.0 * lobe.radius).fold(f64::INFINITY, f64::min)
    }

    /// Computes q of a shifted lobe on the cells of `target` from `points`² directions per cell, with exactly the flux
    /// of `copy`. The lobe is rotated from its centre in the data to that of `copy`. `out` receives the indices of the
    /// cells and q \[1/sr\]; it is emptied first.
    pub fn moved(&self, copy: &Copy, target: &Grid, points: usize, out: &mut Vec<(u32, f64)>) {
        out.clear();
        let lobe = &self.lobes[copy.vertex][copy.lobe];
        let picture = self.rasters[copy.vertex][copy.lobe].turned(copy.centre);
        let mut flux = 0.0;
        target.within(copy.centre, lobe.radius + 0.04, |cell| {
            let q = target.cell_mean(cell, points, |d| picture.at(d));
            if q > 0.0 {
                flux += q * target.projected[cell];
                out.push((cell as u32, q));
            }
        });
        if flux > 0.0 {
            out.iter_mut().for_each(|(_, q)| *q *= copy.flux / flux);
        }
    }

    /// Returns q of the smooth base of one incident direction (by index) on the emergent cells of the data: the
    /// indicatrix without its lobes. \[1/sr\]
    pub fn base(&self, vertex: usize) -> Vec<f64> {
        let mut row = self.data.row(vertex).into_owned();
        for lobe in &self.lobes[vertex] {
            for (cell, q) in lobe.cells(&self.grid) {
                row[cell] -= q;
            }
        }
        row
    }
}
