//! Interreflection between the faces of obstructions and the ground: luminances of panels as the solution of linear
//! equations, for any number of reflections.

use super::open_ground::OpenGround;
use super::scenery::{Scenery, Surface};
use super::vista::Vista;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::surroundings::face_light::FaceLight;
use faer::Mat;
use faer::linalg::solvers::Solve;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Number of reflecting surfaces above which each panel has one node only in the equations. Chosen: cost; the change by
/// finer panels is part of the stated error. No test has as many.
const MANY: usize = 100;
/// Maximum number of panels of a face of an obstruction in the equations. Chosen: cost; the change by finer panels is
/// part of the stated error, held by `tests/scenes/exchange.rs`.
const MOST_COARSE: usize = 4;
/// Maximum length of a panel of the ground, relative to the size or the distance of the nearest body, whichever is
/// larger. Chosen: cost, twice `FINE_GROUND` of `faces`; the change by finer panels is part of the stated error.
const COARSE_GROUND: f64 = 2.0;
/// Relative accuracy of the iterative solution. Chosen: 1/200 of the smallest stated error, `REST` of `faces`; held by
/// `tests/scenes/courts.rs::in_a_white_well_on_a_wide_roof_everything_is_as_bright_as_its_lid`, where nothing is
/// absorbed.
const SOLVED: f64 = 1e-6;
/// Number of right-hand sides (sets of illuminances) that are solved together. Chosen: cost; results change in their
/// last digits at most.
const TOGETHER: usize = 128;

/// Weights of luminances in the illuminance at a point, as (index of the luminance in a list, projected solid angle
/// \[sr\]); zeros are left out.
pub type Counts = Vec<(u32, f32)>;

/// Panels of all surfaces of the scenery, with their nodes numbered consecutively.
pub(super) struct Panels {
    /// Panels of every surface, with luminances at their nodes.
    pub lights: Vec<FaceLight>,
    /// Index of the first node of every surface.
    first: Vec<usize>,
    /// Index of the surface of every node, and the node's coordinates on that surface. \[m\]
    pub places: Vec<(usize, [f64; 2])>,
}

impl Panels {
    /// Creates the consecutive numbering of the nodes of all panels; `lights` holds the panels of every surface.
    pub fn new(lights: Vec<FaceLight>) -> Self {
        let (mut first, mut places) = (Vec::with_capacity(lights.len()), Vec::new());
        for (index, light) in lights.iter().enumerate() {
            first.push(places.len());
            places.extend(light.places().into_iter().map(|place| (index, place)));
        }
        Self { lights, first, places }
    }

    /// Creates a few panels of luminance 0 for every reflecting surface; surfaces of given luminance have it
    /// everywhere.
    pub fn coarse(scenery: &Scenery<'_>, ground: &OpenGround) -> Self {
        let many = scenery.surfaces.iter().filter(|surface| surface.reflects()).count() > MANY;
        let of = |(index, surface): (usize, &Surface)| match surface.stated {
            Some(luminance) => FaceLight::even(luminance),
            None if !surface.reflects() => FaceLight::even(0.0),
            None => ground.panels(scenery, index, if many { 1 } else { MOST_COARSE }, COARSE_GROUND, many),
        };
        Self::new(scenery.surfaces.iter().enumerate().map(of).collect())
    }

    /// Calls `add` with the indices of the nodes around a point of a surface and their interpolation weights.
    pub fn weigh(&self, surface: usize, at: [f64; 2], mut add: impl FnMut(usize, f64)) {
        self.lights[surface].weigh(at, |node, share| add(self.first[surface] + node, share));
    }

    /// Evaluates `of` with the view from every node, in parallel; `None` where a body covers the node.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    pub fn each<T: Send>(
        &self,
        scenery: &Scenery<'_>,
        progress: &dyn Progress,
        of: impl Fn(Vista<'_>) -> T + Sync,
    ) -> Result<Vec<Option<T>>, Cancelled> {
        let done = AtomicUsize::new(0);
        let one = |&(index, [u, v]): &(usize, [f64; 2])| {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            let point = scenery.surfaces[index].face.point(u, v);
            let found = (!scenery.is_covered(index, point)).then(|| of(Vista::new(scenery, index, point)));
            progress.advance("outside", done.fetch_add(1, Ordering::Relaxed) + 1, self.places.len());
            Ok(found)
        };
        self.places.par_iter().map(one).collect()
    }

    /// Returns for every node the index of the node whose luminance it is given: itself, or if a body covers it, the
    /// nearest uncovered one of its panel. Nodes of a wholly covered panel remain at 0.
    pub fn free(&self, is_free: impl Iterator<Item = bool>) -> Vec<usize> {
        let name = |(node, free): (usize, bool)| if free { (node + 1) as f64 } else { f64::NAN };
        let names: Vec<f64> = is_free.enumerate().map(name).collect();
        let named = self.with(&names);
        let own = |(node, name): (usize, &f64)| if *name > 0.0 { *name as usize - 1 } else { node };
        named.iter().flat_map(FaceLight::values).enumerate().map(own).collect()
    }

    /// Returns the panels of every surface with the luminances `values` of all nodes \[cd/m²\]; a `NaN`, for a node
    /// that a body covers, is replaced by the luminance of the nearest uncovered node of its panel.
    pub fn with(&self, values: &[f64]) -> Vec<FaceLight> {
        let mut lights = self.lights.clone();
        for (light, from) in lights.iter_mut().zip(&self.first) {
            let count = light.values().len();
            light.set(&values[*from..from + count]);
        }
        lights
    }
}

/// System of linear equations for the interreflection between the nodes of panels.
pub(super) struct Exchange {
    panels: Panels,
    /// Index of the node whose luminance each node is given: itself, or the nearest uncovered one.
    source: Vec<usize>,
    /// Weights of the other nodes in the illuminance of each node \[sr\]; `None` where a body covers the node.
    seen: Vec<Option<Counts>>,
}

impl Exchange {
    /// Creates the equations. `seen`: weights of the other nodes in the illuminance of every node \[sr\]; `None` where
    /// a body covers the node.
    pub fn new(panels: Panels, mut seen: Vec<Option<Counts>>) -> Self {
        let source = panels.free(seen.iter().map(Option::is_some));
        for (other, _) in seen.iter_mut().flatten().flatten() {
            *other = source[*other as usize] as u32;
        }
        Self { panels, source, seen }
    }

    /// Returns the panels of all surfaces.
    pub fn panels(&self) -> &Panels {
        &self.panels
    }

    /// Solves x = ρ/π (e + K x) for the luminance x of every node \[cd/m²\] by the Gauss–Seidel method, which converges
    /// because no surface reflects more than it receives. `falling`: illuminance e of every node by sky, sun and
    /// surfaces of given luminance \[lx\]; K: weights of the other nodes.
    pub fn solved(&self, scenery: &Scenery<'_>, falling: &[f64]) -> Vec<f64> {
        let albedo: Vec<f64> = scenery.surfaces.iter().map(|surface| surface.reflectance / PI).collect();
        let albedo = |node: usize| albedo[self.panels.places[node].0];
        let own = |node: usize| if self.seen[node].is_some() { albedo(node) * falling[node] } else { 0.0 };
        let mut light: Vec<f64> = (0..falling.len()).map(own).collect();
        for _ in 0..1000 {
            let (mut changed, mut largest) = (0.0_f64, 0.0_f64);
            for (node, seen) in self.seen.iter().enumerate() {
                let Some(seen) = seen else { continue };
                let others: f64 = seen.iter().map(|(other, counts)| f64::from(*counts) * light[*other as usize]).sum();
                let value = albedo(node) * (falling[node] + others);
                changed = changed.max((value - light[node]).abs());
                largest = largest.max(value.abs());
                light[node] = value;
            }
            if changed <= SOLVED * largest {
                break;
            }
        }
        self.source.iter().map(|node| light[*node]).collect()
    }

    /// Solves x = ρ/π (e + K x) for many sets of illuminances e of the nodes and returns the results of `of` for the
    /// luminances x. `falling`: a row for each node, a column for each set \[lx\]. `of`: called with the index of the
    /// first of some sets and their luminances, a row for each node \[cd/m²\].
    pub fn solved_together<T: Send>(
        &self,
        scenery: &Scenery<'_>,
        falling: &Mat<f32>,
        of: impl Fn(usize, Mat<f32>) -> T + Sync,
    ) -> Vec<T> {
        let count = falling.nrows();
        let albedo: Vec<f32> = self
            .panels
            .places
            .iter()
            .map(|(surface, _)| (scenery.surfaces[*surface].reflectance / PI) as f32)
            .collect();
        let mut system = Mat::<f32>::identity(count, count);
        for (node, seen) in self.seen.iter().enumerate() {
            for (other, counts) in seen.iter().flatten() {
                system[(node, *other as usize)] -= albedo[node] * counts;
            }
        }
        // One thread each, because the result must not depend on the number of threads.
        faer::set_global_parallelism(faer::Par::Seq);
        let factors = system.partial_piv_lu();
        let some = |first: usize| {
            let sets = TOGETHER.min(falling.ncols() - first);
            let right = Mat::from_fn(count, sets, |node, set| albedo[node] * falling[(node, first + set)]);
            let solved = factors.solve(&right);
            of(first, Mat::from_fn(count, sets, |node, set| solved[(self.source[node], set)]))
        };
        (0..falling.ncols()).into_par_iter().step_by(TOGETHER).map(some).collect()
    }
}

/// Computes the luminance of all surfaces on few panels with interreflection, without the part directly reflected from
/// the sun.
pub(super) fn coarse(
    scenery: &Scenery<'_>,
    ground: &OpenGround,
    progress: &dyn Progress,
) -> Result<Vec<FaceLight>, Cancelled> {
    let panels = Panels::coarse(scenery, ground);
    let rows = panels.each(scenery, progress, |vista| {
        let mut counts = vec![0.0; panels.places.len()];
        let mut beyond = 0.0;
        let rest = vista.gather(|surface, at, weight| {
            if surface == scenery.ground() && !ground.holds(at) {
                beyond += weight * ground.luminance;
            } else {
                panels.weigh(surface, at, |node, share| counts[node] += weight * share);
            }
        });
        (rest + beyond, sparse(&counts))
    })?;
    let falling: Vec<f64> = rows.iter().map(|row| row.as_ref().map_or(0.0, |row| row.0)).collect();
    let exchange = Exchange::new(panels, rows.into_iter().map(|row| Some(row?.1)).collect());
    Ok(exchange.panels().with(&exchange.solved(scenery, &falling)))
}

/// Sum of weights over a long list in which few weights differ from 0.
pub struct SparseSum {
    weights: Vec<f64>,
    /// Indices of the weights that are not 0; an index may occur twice.
    places: Vec<u32>,
}

impl SparseSum {
    /// Creates a sum over a list of `count` weights, all 0.
    pub fn new(count: usize) -> Self {
        Self { weights: vec![0.0; count], places: Vec::new() }
    }

    /// Adds a weight to that at an index of the list.
    pub fn add(&mut self, place: usize, weight: f64) {
        if self.weights[place] == 0.0 {
            self.places.push(place as u32);
        }
        self.weights[place] += weight;
    }

    /// Returns the weights that are not 0 with their indices, and resets all to 0.
    pub fn take(&mut self) -> Counts {
        let weights = &mut self.weights;
        let taken = self.places.drain(..).map(|place| (place, std::mem::take(&mut weights[place as usize]) as f32));
        taken.filter(|(_, weight)| *weight != 0.0).collect()
    }
}

/// Returns the weights that are not 0, with their indices.
pub(super) fn sparse(counts: &[f64]) -> Counts {
    let counting = counts.iter().enumerate().filter(|(_, counts)| **counts != 0.0);
    counting.map(|(node, counts)| (node as u32, *counts as f32)).collect()
}
