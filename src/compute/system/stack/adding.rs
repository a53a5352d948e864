//! Layers one behind the other, with all reflections between them: the adding method on matrices (Klems, ASHRAE
//! Transactions 100, 1994).
//!
//! A matrix does not preserve the direction of light within its cell. Layers that transmit light undeviated (a pane in
//! front of a blind) need it, since the light passes all of them at the same angle; so the layers are computed on finer
//! cells than the requested ones, and only the combined result is averaged. The remaining error is estimated from the
//! difference to the next coarser division.

use super::halves::{Halves, Part};
use super::single::Singles;
use crate::compute::basis::{AzimuthMap, Resampling, RingBasis, same_cells};
use crate::compute::btdf::{CellMatrix, resample_matrix};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::system::measure::beams::mirror_images;
use crate::compute::system::measure::{
    Beam, Measured, OneSide, OpticalModel, ScatteredLight, Setting, Side, Structure,
};
use std::f64::consts::PI;

/// Optical model of layers one behind the other, from outside to inside, with all reflections between them.
pub struct Stack {
    layers: Vec<Box<dyn OpticalModel>>,
    /// Cache of results for single directions.
    singles: Singles,
}

/// Maximum number of parts into which a cell is divided along either side: 9 parts of a Klems cell are 3.3° wide; 1300
/// cells are solved in a second. Chosen: cost; the difference to the next coarser division gives the stated error.
const MOST_PARTS: usize = 3;

impl OpticalModel for Stack {
    /// Computes the stack on finer and finer cells, until the change is within the allowed error.
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        if let [only] = self.layers.as_slice() {
            return only.measure(setting, progress);
        }
        // Cells that can be turned by 180° and are finer than or equal to those asked for.
        let base = if same_cells(setting.incident, setting.emergent).is_some() && turned(setting.incident).is_some() {
            setting.incident.clone()
        } else {
            RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
        };
        let mut before: Option<Measured> = None;
        let mut mirror = None;
        for parts in 1..=MOST_PARTS {
            let cells = if parts == 1 { base.clone() } else { base.refined(parts) };
            let mut whole = None;
            if parts == 1 {
                let weight = cells.projected_solid_angles();
                let layers = self.on_cells(&cells, setting, progress).collect::<Result<Vec<_>, _>>()?;
                mirror = MIRRORS.into_iter().find(|mirror| {
                    mirror_images(&cells, mirror)
                        .is_some_and(|map| layers.iter().all(|layer| layer.fits(&map, &weight)))
                });
                whole = sum(&cells, mirror, layers.into_iter().map(Ok), setting)?;
            } else if mirror.is_some() {
                whole = sum(&cells, mirror, self.on_cells(&cells, setting, progress), setting)?;
            }
            let mut made = match whole {
                Some(whole) => whole,
                None => {
                    // Finer cells have shown that the two sides of the mirror are not alike.
                    mirror = None;
                    sum(&cells, None, self.on_cells(&cells, setting, progress), setting)?
                        .expect("a stack has layers, and without a mirror they are not asked to look alike in it")
                }
            };
            let Some(last) = &before else {
                before = Some(made);
                continue;
            };
            // The neglected part falls with the square of the cells' size: of p and p − 1 parts, what is left of the
            // change is 1 in (p/(p−1))² − 1.
            let left = 1.0 / ((parts as f64 / (parts - 1) as f64).powi(2) - 1.0);
            let mut worst: f64 = 0.0;
            for side in Side::BOTH {
                let (t, r) = (made.shares(&made.seen(side).transmitted), made.shares(&made.seen(side).reflected));
                let (t0, r0) = (last.shares(&last.seen(side).transmitted), last.shares(&last.seen(side).reflected));
                let OneSide { absorbed, error, .. } = made.seen_mut(side);
                for (i, (error, absorbed)) in error.iter_mut().zip(absorbed).enumerate() {
                    *error +=
                        left * (t[i] - t0[i]).abs().max((r[i] - r0[i]).abs()) + (t[i] + r[i] + *absorbed - 1.0).abs();
                    worst = worst.max(*error);
                }
            }
            let enough = worst <= 0.3 * setting.error;
            before = Some(made);
            if enough {
                break;
            }
        }
        Ok(before.expect("at least one cut was made"))
    }

    fn is_quick(&self) -> bool {
        self.layers.iter().all(|layer| layer.is_quick())
    }

    fn structure(&self) -> Structure {
        self.layers.iter().map(|layer| layer.structure()).fold(Structure::Even, Structure::and)
    }

    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam> {
        match self.layers.as_slice() {
            [only] => only.beams(direction, side),
            layers => self.singles.beams(layers, direction, side, 0.0),
        }
    }

    fn beams_about(&self, direction: Dir<Facade>, side: Side, within: f64) -> Vec<Beam> {
        match self.layers.as_slice() {
            [only] => only.beams_about(direction, side, within),
            layers => self.singles.beams(layers, direction, side, within),
        }
    }

    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        match self.layers.as_slice() {
            [only] => only.scattered(direction, side, emergent),
            layers => self.singles.scattered(layers, direction, side, emergent),
        }
    }

    fn scattered_through(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        match self.layers.as_slice() {
            [only] => only.scattered_through(direction, side, emergent),
            layers => self.singles.scattered(layers, direction, side, emergent),
        }
    }

    fn bytes(&self) -> usize {
        self.singles.bytes() + self.layers.iter().map(|layer| layer.bytes()).sum::<usize>()
    }
}

impl Stack {
    /// Creates a stack of at least one layer, outermost first.
    pub fn new(layers: Vec<Box<dyn OpticalModel>>) -> Self {
        Self { layers, singles: Singles::default() }
    }

    /// Returns the data of all layers, outermost first, on the same incident and emergent cells; each is computed when
    /// the iterator reaches it.
    fn on_cells<'a>(
        &'a self,
        cells: &'a RingBasis,
        setting: &'a Setting<'_>,
        progress: &'a dyn Progress,
    ) -> impl Iterator<Item = Result<Data, Cancelled>> + 'a {
        let count = self.layers.len();
        let share = Setting {
            incident: cells,
            emergent: cells,
            error: setting.error / (2.0 * count as f64),
            seed: setting.seed,
        };
        self.layers.iter().enumerate().map(move |(k, layer)| {
            progress.advance("layers", k, count);
            if progress.cancelled() {
                return Err(Cancelled);
            }
            Ok(match layer.by_cell(&share, progress)? {
                Some(sides) => Data { sides, is_by_cell: true },
                None => {
                    let Measured { front, back, .. } = layer.measure(&share, progress)?;
                    Data { sides: [front, back], is_by_cell: false }
                }
            })
        })
    }
}

/// Data of a layer on the cells of a stack, for light from outside and from inside.
struct Data {
    sides: [OneSide; 2],
    /// Whether they have a coefficient for each cell ([`OpticalModel::by_cell`]) instead of one for each pair.
    is_by_cell: bool,
}

impl Data {
    /// Whether the layer is symmetric for the mirror images `image` of the cells, which have the same polar angles.
    /// `weight`: projected solid angles of the cells. \[sr\]
    fn fits(&self, image: &[usize], weight: &[f64]) -> bool {
        self.is_by_cell || Halves::fits(image, weight, &self.sides)
    }
}

/// Function from the azimuth of a direction to that of its mirror image. \[rad\]
type Mirror = fn(f64) -> f64;

/// Mirror symmetries of systems: exchange of left and right, which nearly all systems have, then of up and down.
const MIRRORS: [Mirror; 2] = [|phi| PI - phi, |phi| -phi];

/// Combines the layers, with all reflections between them, into means over the cells of `setting`; `None` if one of the
/// layers does not have the mirror symmetry `mirror`. On fine cells whole matrices need most of the memory: each is
/// freed as soon as it has been used, and the odd parts follow the even ones.
fn sum(
    cells: &RingBasis,
    mirror: Option<Mirror>,
    layers: impl Iterator<Item = Result<Data, Cancelled>>,
    setting: &Setting<'_>,
) -> Result<Option<Measured>, Cancelled> {
    let map = mirror.and_then(|mirror| mirror_images(cells, mirror));
    let halves = map.as_ref().map_or_else(|| Halves::none(cells.len()), |map| Halves::new(map));
    let turn = turned(cells).expect("chosen so that it can be turned");
    let weight = cells.projected_solid_angles();
    let mut sum: Option<Layered> = None;
    for data in layers {
        let data = data?;
        if map.as_ref().is_some_and(|map| !data.fits(map, &weight)) {
            return Ok(None);
        }
        let next = Layered::new(data, &weight, &turn, &halves);
        sum = Some(match sum {
            None => next,
            Some(outer) => outer.before(next),
        });
    }
    Ok(sum.map(|sum| sum.measured(cells, &turn, &halves, setting)))
}

/// Returns the index of the cell that each cell becomes by a rotation of 180° about the normal; `None` if there is no
/// such cell.
fn turned(basis: &RingBasis) -> Option<Vec<usize>> {
    mirror_images(basis, |phi| phi + PI)
}

/// Layer as flux matrices.
struct Layered {
    even: Matrices,
    odd: Matrices,
    absorbed: [Vec<f64>; 2],
    error: [Vec<f64>; 2],
}

/// Even or odd part of a layer's flux matrices: share of the light of cell i (column) that leaves through cell o (row).
/// Light from either side is indexed by its direction of travel as for light from outside, so that the matrices of
/// layers can be multiplied.
struct Matrices {
    t: [Part; 2],
    r: [Part; 2],
}

impl Layered {
    /// Creates the flux matrices of a layer from its data; `weight`: projected solid angles of the cells \[sr\]; `turn`:
    /// counterpart of each cell by a rotation of 180° about the normal.
    fn new(data: Data, weight: &[f64], turn: &[usize], halves: &Halves) -> Self {
        let n = turn.len();
        let Data { sides: [front, back], is_by_cell } = data;
        // `cell`: index in the data of each cell of the matrices.
        let folded = |seen: OneSide, cell: &[usize]| {
            let parts = |q: Vec<f64>| {
                if is_by_cell {
                    halves.diagonal(|k| q[cell[k]] * weight[k])
                } else {
                    halves.matrix(|o, i| q[cell[i] * n + cell[o]] * weight[o])
                }
            };
            let list = |list: &[f64]| halves.list(|k| list[cell[k]]);
            let (absorbed, error) = (list(&seen.absorbed), list(&seen.error));
            (parts(seen.transmitted), parts(seen.reflected), absorbed, error)
        };
        let ([t, t_odd], [r, r_odd], absorbed, error) = folded(front, &(0..n).collect::<Vec<_>>());
        let ([t_back, t_back_odd], [r_back, r_back_odd], absorbed_back, error_back) = folded(back, turn);
        Self {
            even: Matrices { t: [t, t_back], r: [r, r_back] },
            odd: Matrices { t: [t_odd, t_back_odd], r: [r_odd, r_back_odd] },
            absorbed: [absorbed, absorbed_back],
            error: [error, error_back],
        }
    }

    /// Returns the combination of this layer outside and the layer `inner` inside, with all reflections between them.
    fn before(self, inner: Self) -> Self {
        // Lists are the same in mirror-image cells: they have an even part alone.
        let [mut absorbed, mut error] = [[vec![], vec![]], [vec![], vec![]]];
        let even = self.even.before(inner.even, |side, inward, outward| {
            let in_gap = |outer: &[Vec<f64>; 2], within: &[Vec<f64>; 2]| -> Vec<f64> {
                let own = if side == 0 { &outer[0] } else { &within[1] };
                let gap = outward.weighted(&outer[1]).into_iter().zip(inward.weighted(&within[0]));
                own.iter().zip(gap).map(|(own, (a, b))| own + a + b).collect()
            };
            absorbed[side] = in_gap(&self.absorbed, &inner.absorbed);
            error[side] = in_gap(&self.error, &inner.error);
        });
        let odd = self.odd.before(inner.odd, |_, _, _| ());
        Self { even, odd, absorbed, error }
    }

    /// Returns the layer's transmission, reflection and absorption as means over the cells of `setting`.
    fn measured(&self, cells: &RingBasis, turn: &[usize], halves: &Halves, setting: &Setting<'_>) -> Measured {
        let n = turn.len();
        let weight = cells.projected_solid_angles();
        let mean = Resampling::new(cells, setting.incident);
        let averaged = |at: &dyn Fn(usize, usize) -> f64| {
            let mut q = vec![0.0; n * n];
            for (k, q) in q.iter_mut().enumerate() {
                *q = at(k % n, k / n).max(0.0) / weight[k % n];
            }
            let matrix =
                CellMatrix::new(cells.clone(), cells.clone(), q).expect("as many values as pairs of these cells");
            resample_matrix(&matrix, setting.incident, setting.emergent).values().into_owned()
        };
        let front = |m: [&Part; 2]| averaged(&|o, i| halves.entry(m, o, i));
        let back = |m: [&Part; 2]| averaged(&|o, i| halves.entry(m, turn[o], turn[i]));
        let own = |list: &[f64]| mean.apply(&halves.unfolded(list));
        let named = |list: &[f64]| {
            let list = halves.unfolded(list);
            mean.apply(&turn.iter().map(|&k| list[k]).collect::<Vec<_>>())
        };
        Measured {
            incident: setting.incident.clone(),
            emergent: setting.emergent.clone(),
            front: OneSide {
                transmitted: front([&self.even.t[0], &self.odd.t[0]]),
                reflected: front([&self.even.r[0], &self.odd.r[0]]),
                absorbed: own(&self.absorbed[0]),
                error: own(&self.error[0]),
            },
            back: OneSide {
                transmitted: back([&self.even.t[1], &self.odd.t[1]]),
                reflected: back([&self.even.r[1], &self.odd.r[1]]),
                absorbed: named(&self.absorbed[1]),
                error: named(&self.error[1]),
            },
        }
    }
}

impl Matrices {
    /// Returns the matrices of this layer outside and the layer `inner` inside, with all reflections between them.
    /// `gap`: takes the inward and the outward light in the gap between the layers, for light from outside (0), then
    /// from inside (1).
    fn before(self, inner: Self, mut gap: impl FnMut(usize, &Part, &Part)) -> Self {
        let ([t1, t1_back], [t2, t2_back]) = (self.t, inner.t);
        let ([r1, r1_back], [r2, r2_back]) = (self.r, inner.r);
        // The outward light of light from inside is what came through plus what the inner layer reflects.
        let series = r1_back.times(&r2).series();
        let inward = series.of(t1);
        let outward = r2.times(&inward);
        gap(0, &inward, &outward);
        let (r, t) = (r1.plus(t1_back.times(&outward)), t2.times(&inward));
        drop((inward, outward));
        let inward = series.of(r1_back.times(&t2_back));
        drop((series, r1_back));
        let outward = t2_back.plus(r2.times(&inward));
        drop(r2);
        gap(1, &inward, &outward);
        Self { t: [t, t1_back.times(&outward)], r: [r, r2_back.plus(t2.times(&inward))] }
    }
}

#[cfg(test)]
mod tests;
