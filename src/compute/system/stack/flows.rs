//! Scattered light between the layers of a stack, on the cells of [`front_basis`]: where light that arises in the gaps
//! between layers leaves the stack.

use super::passage::Place;
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Silent;
use crate::compute::system::measure::beams::mirror_images;
use crate::compute::system::measure::{Measured, OpticalModel, Setting, Side, front_basis};
use faer::Mat;
use faer::linalg::solvers::Solve;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Allowed error of the layers: the default of `cfs goniophotometer --error`. Chosen: cost; the error that the layers
/// state is part of the stated error.
const ERROR: f64 = 0.01;

/// Flux matrices of the layers of a stack; light from either side is indexed by its direction of undeviated light.
pub(super) struct Flows {
    /// Incident and emergent cells, which contain directions of undeviated light for light from either side.
    pub cells: RingBasis,
    /// Projected solid angles of the cells. \[sr\]
    pub weight: Vec<f64>,
    /// Index of the cell that each cell becomes by a rotation of 180° about the normal.
    turn: Vec<usize>,
    layers: Vec<[OneWay; 2]>,
    /// Share of the light of one cell in a gap between layers that leaves the stack in another cell, inwards and
    /// outwards, `[from · n + to]`; one entry per gap and sense, numbered by [`between`]. Cells are those of light from
    /// outside.
    ends: Vec<[Vec<f64>; 2]>,
    /// Largest estimated error of τ and ρ of any layer.
    pub error: f64,
}

/// Flux matrices of a layer for light from one side.
struct OneWay {
    /// Share of the flux of one cell that is transmitted into another, `[from · n + to]`; `back` is that of reflected
    /// light.
    through: Vec<f64>,
    back: Vec<f64>,
    /// Share of the light of each cell that is transmitted undeviated.
    straight: Vec<f64>,
}

/// Flux, by cell, that arises in the gaps between the layers of a stack, e.g. by scattering of beams.
pub(super) struct Sources {
    /// Flux that travels inwards and that travels outwards, by gap, then by cell; as shares of the incident light.
    pub gaps: Vec<[Vec<f64>; 2]>,
}

impl Sources {
    /// Creates sources without light for a stack of `layers` layers and a basis of `cells` cells.
    pub fn dark(layers: usize, cells: usize) -> Self {
        Self { gaps: vec![[vec![0.0; cells], vec![0.0; cells]]; layers + 1] }
    }

    /// Returns the light, by cell, that arises in a gap and travels in the given sense.
    pub fn at(&mut self, (gap, inwards): Place) -> &mut Vec<f64> {
        &mut self.gaps[gap][usize::from(!inwards)]
    }
}

impl Flows {
    /// Computes the flux matrices of all layers, and solves the reflections between them.
    pub fn new(layers: &[Box<dyn OpticalModel>]) -> Self {
        let cells = front_basis();
        let weight = cells.projected_solid_angles();
        let turn = mirror_images(&cells, |phi| phi + PI).expect("Klems cells can be turned by 180°");
        let setting = Setting { incident: &cells, emergent: &cells, error: ERROR, seed: 1 };
        let measured: Vec<Measured> =
            layers.iter().map(|layer| layer.measure(&setting, &Silent).expect("never withdrawn")).collect();
        let error = measured.iter().map(|layer| layer.quality().error).fold(0.0, f64::max);
        let one_way = |layer: &dyn OpticalModel, measured: &Measured, side: Side| {
            let seen = measured.seen(side);
            let flux = |q: &[f64]| -> Vec<f64> { q.iter().zip(weight.iter().cycle()).map(|(q, w)| q * w).collect() };
            let through = flux(&seen.transmitted);
            let n = cells.len();
            let straight = (0..n).into_par_iter().map(|c| {
                // Not more than the cell's own mean, so that what is left of it is never negative.
                layer.straight(cells.cell(c).centre(), side).min(through[c * n + c])
            });
            let straight = straight.collect();
            OneWay { back: flux(&seen.reflected), straight, through }
        };
        let layers: Vec<[OneWay; 2]> = layers
            .iter()
            .zip(&measured)
            .map(|(layer, measured)| Side::BOTH.map(|side| one_way(layer.as_ref(), measured, side)))
            .collect();
        let ends = ends(&layers, &turn);
        Self { cells, weight, turn, layers, ends, error }
    }

    /// Returns the memory of the matrices. \[bytes\]
    pub fn bytes(&self) -> usize {
        let layers = self.layers.iter().flatten().flat_map(|way| [&way.through, &way.back]);
        layers.chain(self.ends.iter().flatten()).map(|matrix| size_of_val(&matrix[..])).sum()
    }

    /// Returns the share of the light of each cell in a gap, travelling in the given sense, that passes undeviated
    /// through all remaining layers; cells are those of light from the side `asked`.
    pub fn straight_out(&self, (gap, inwards): Place, asked: Side) -> Vec<f64> {
        let passed = if inwards { gap..self.layers.len() } else { 0..gap };
        let side = if inwards { Side::Front } else { Side::Back };
        let own = |c: usize| if side == asked { c } else { self.turn[c] };
        let share = |c: usize| passed.clone().map(|k| self.layers[k][usize::from(!inwards)].straight[own(c)]).product();
        (0..self.turn.len()).map(share).collect()
    }

    /// Returns the light of the sources that leaves the stack, inwards and outwards, by cell, after all reflections;
    /// cells are those of light from the side `asked`.
    pub fn leaving(&self, sources: &Sources, asked: Side) -> [Vec<f64>; 2] {
        let n = self.layers.len();
        // Through directions of light from the front, in and out.
        let named = |light: &[f64]| match asked {
            Side::Front => light.to_vec(),
            Side::Back => self.turn.iter().map(|&c| light[c]).collect(),
        };
        let mut gaps: Vec<[Vec<f64>; 2]> =
            sources.gaps.iter().map(|senses| [0, 1].map(|sense| named(&senses[sense]))).collect();
        // What comes from outside all layers meets the first of them.
        for (inwards, gap, layer, beyond) in [(true, 0, 0, 1), (false, n, n - 1, n - 1)] {
            let sense = usize::from(!inwards);
            let light = std::mem::take(&mut gaps[gap][sense]);
            let OneWay { through, back, .. } = &self.layers[layer][sense];
            let turn = (!inwards).then_some(self.turn.as_slice());
            add(&mut gaps[beyond][sense], through, &light, turn);
            add(&mut gaps[gap][1 - sense], back, &light, turn);
        }
        let mut leaving = [(n, 0), (0, 1)].map(|(gap, sense)| std::mem::take(&mut gaps[gap][sense]));
        for (ends, light) in self.ends.iter().zip(gaps[1..n].iter().flatten()) {
            for (leaving, ends) in leaving.iter_mut().zip(ends) {
                add(leaving, ends, light, None);
            }
        }
        leaving.map(|light| named(&light))
    }
}

/// Returns the number of a gap between two layers with the sense of travel in it; light outside all layers has none.
fn between((gap, inwards): Place) -> usize {
    2 * (gap - 1) + usize::from(!inwards)
}

/// Returns the share of the light between layers that leaves the stack after all reflections (see [`Flows::ends`]). It
/// solves a system of linear equations: all light in the gaps is the light that arises there plus the light that the
/// layers transmit and reflect into them.
fn ends(layers: &[[OneWay; 2]], turn: &[usize]) -> Vec<[Vec<f64>; 2]> {
    let (n, cells) = (layers.len(), turn.len());
    let places = 2 * (n - 1);
    // Rows: where light is. Columns: where it goes.
    let mut still = Mat::<f64>::identity(places * cells, places * cells);
    let mut last = Mat::<f64>::zeros(places * cells, 2 * cells);
    for (gap, inwards) in (1..n).flat_map(|gap| [(gap, true), (gap, false)]) {
        let OneWay { through, back, .. } = &layers[if inwards { gap } else { gap - 1 }][usize::from(!inwards)];
        let named = |c: usize| if inwards { c } else { turn[c] };
        let from = between((gap, inwards)) * cells;
        let beyond = if inwards { gap + 1 } else { gap - 1 };
        for (matrix, to) in [(through, (beyond, inwards)), (back, (gap, !inwards))] {
            for (i, o) in (0..cells).flat_map(|i| (0..cells).map(move |o| (i, o))) {
                let share = matrix[named(i) * cells + named(o)];
                if to.0 == 0 || to.0 == n {
                    last[(from + i, usize::from(!inwards) * cells + o)] += share;
                } else {
                    still[(from + i, between(to) * cells + o)] -= share;
                }
            }
        }
    }
    let solved = still.partial_piv_lu().solve(&last);
    let block = |place: usize, sense: usize| -> Vec<f64> {
        let entries = (0..cells).flat_map(|i| (0..cells).map(move |o| (i, o)));
        entries.map(|(i, o)| solved[(place * cells + i, sense * cells + o)]).collect()
    };
    (0..places).map(|place| [0, 1].map(|sense| block(place, sense))).collect()
}

/// Adds the product of a flux matrix and the light `light` by cell to `to`. With `turn`, the cells of incident and
/// resulting light are rotated by 180° about the normal, as for light from the other side.
fn add(to: &mut [f64], matrix: &[f64], light: &[f64], turn: Option<&[usize]>) {
    if let Some(turn) = turn {
        let mut turned = vec![0.0; turn.len()];
        let light: Vec<f64> = turn.iter().map(|&i| light[i]).collect();
        add(&mut turned, matrix, &light, None);
        to.iter_mut().zip(turn).for_each(|(to, &o)| *to += turned[o]);
        return;
    }
    for (&flux, row) in light.iter().zip(matrix.chunks_exact(light.len())).filter(|(flux, _)| **flux != 0.0) {
        to.iter_mut().zip(row).for_each(|(to, share)| *to += flux * share);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::system::Family;
    use crate::compute::system::sheets::{Hole, Perforated, diffuser};
    use crate::compute::system::stack::DataLayer;

    /// Grey holes whose walls rise inwards between two diffusers: nothing is alike upside down or from the other side.
    fn layers() -> Vec<Box<dyn OpticalModel>> {
        let holes = Perforated {
            hole: Hole::Rhombus { width: 0.052, height: 0.018 },
            area: 0.0008,
            thickness: 0.008,
            rise: 0.006,
            reflectance: [0.6, 0.3, 0.5],
        };
        let sheet = |t, r| -> Box<dyn OpticalModel> { Box::new(DataLayer(diffuser::lambertian(t, r))) };
        vec![sheet(0.4, 0.5), holes.optical_model("").unwrap(), sheet(0.3, 0.6)]
    }

    /// Light of one cell in every place in turn.
    fn sources(flows: &Flows) -> impl Iterator<Item = Sources> {
        let (n, cells) = (flows.layers.len(), flows.cells.len());
        let places = (0..=n).flat_map(|gap| [(gap, true), (gap, false)]);
        places.map(move |place| {
            let mut sources = Sources::dark(n, cells);
            sources.at(place)[17] = 0.7;
            sources.at(place)[80] = 0.3;
            sources
        })
    }

    #[test]
    fn what_leaves_is_what_goes_to_and_fro_without_end() {
        let flows = Flows::new(&layers());
        let n = flows.layers.len();
        for asked in Side::BOTH {
            let turn_of = |side: Side| (side != asked).then_some(flows.turn.as_slice());
            for sources in sources(&flows) {
                let mut light = Sources::dark(n, flows.cells.len());
                for _ in 0..60 {
                    let mut next = Sources { gaps: sources.gaps.clone() };
                    for (k, layer) in flows.layers.iter().enumerate() {
                        for (side, from, beyond) in [(Side::Front, k, k + 1), (Side::Back, k + 1, k)] {
                            let sense = usize::from(side == Side::Back);
                            let (own, turn) = (&light.gaps[from][sense], turn_of(side));
                            add(&mut next.gaps[beyond][sense], &layer[sense].through, own, turn);
                            add(&mut next.gaps[from][1 - sense], &layer[sense].back, own, turn);
                        }
                    }
                    light = next;
                }
                for (found, followed) in
                    flows.leaving(&sources, asked).iter().zip([&light.gaps[n][0], &light.gaps[0][1]])
                {
                    assert!(found.iter().zip(followed).all(|(a, b)| (a - b).abs() < 1e-9));
                }
            }
        }
    }

    #[test]
    fn what_nothing_absorbs_leaves() {
        let white: Vec<Box<dyn OpticalModel>> = [(0.3, 0.7), (0.6, 0.4), (0.1, 0.9)]
            .into_iter()
            .map(|(t, r)| -> Box<dyn OpticalModel> { Box::new(DataLayer(diffuser::lambertian(t, r))) })
            .collect();
        let flows = Flows::new(&white);
        for sources in sources(&flows) {
            let all: f64 = flows.leaving(&sources, Side::Front).iter().flatten().sum();
            assert!((all - 1.0).abs() < 1e-9, "{all}");
        }
    }
}
