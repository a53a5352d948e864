//! Optical model of perforated sheets. For single directions, interreflection between the walls of the hole is solved
//! once and cached.

use super::hole::Perforated;
use super::walls::{Walls, measure_walls};
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use crate::compute::dot::add_scaled;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::system::measure::kept::{Kept, Once};
use crate::compute::system::measure::{Beam, Measured, OpticalModel, ScatteredLight, Setting, Side, front_basis};
use faer::Mat;
use std::f64::consts::PI;

/// Numbers of patches of the walls through the sheet's thickness, coarse and fine, for single directions; the
/// difference between the two gives the error. Chosen: cost; results change within their stated error. Held below 0.01
/// by the test `single_directions_have_the_mean_that_is_measured_and_lose_nothing`.
const DEPTH: [usize; 2] = [4, 8];

/// Optical model of a perforated sheet, with cached results for the walls of its holes.
pub(super) struct Holes {
    sheet: Perforated,
    walls: Once<[Solved; 2]>,
    seen: Kept<Seen>,
}

/// Walls of a hole with their solved interreflection.
struct Solved {
    walls: Walls,
    /// Flux that each patch (row) receives after all interreflections, per flux that each patch (column) receives
    /// first.
    response: Mat<f64>,
}

/// Light on the walls for light from each cell of a basis, computed when it is first needed.
#[derive(Default)]
struct Seen {
    /// Flux on every patch (column) for light of every cell (row), per flux on the sheet; indexed by division of the
    /// thickness (of [`DEPTH`]), then by kind of the leaving light (transmitted, reflected), then by side. In single
    /// precision, which takes half of the memory.
    ways: [[[Once<Mat<f32>>; 2]; 2]; 2],
}

/// Light that the sheet scatters: q of transmitted and reflected light by emergent cell \[1/sr\], and the absorbed
/// share.
struct Rest {
    transmitted: Vec<f64>,
    reflected: Vec<f64>,
    absorbed: f64,
}

impl Holes {
    /// Creates the optical model of a perforated sheet with empty caches.
    pub fn new(sheet: Perforated) -> Self {
        Self { sheet, walls: Once::default(), seen: Kept::default() }
    }

    fn solved(&self) -> &[Solved; 2] {
        self.walls.get(|| {
            let cells = front_basis();
            DEPTH.map(|depth| {
                let walls = Walls::new(&self.sheet, depth);
                let through = Side::BOTH.map(|side| walls.lit(&cells, side, false));
                let response = walls.response(&walls.escaping(&cells, &through));
                Solved { walls, response }
            })
        })
    }

    /// Computes the scattered light of one direction, by its reflections at the faces of the sheet and at the walls of
    /// the holes; `depth`: index in [`DEPTH`] of the walls' division.
    fn rest(&self, direction: Dir<Facade>, side: Side, depth: usize, cells: &RingBasis, seen: &Seen) -> Rest {
        let Solved { walls, response } = &self.solved()[depth];
        let n = walls.len();
        let mut first = vec![0.0; n];
        walls.light(direction, side, false, 1.0, &mut first);
        // Polygons stand for circles: what they let fall on the walls is made what the circle does.
        let (got, due) = (first.iter().sum::<f64>(), self.sheet.open() - self.sheet.straight(direction));
        let scale = if got > 1e-12 { due.max(0.0) / got } else { 0.0 };
        let wall = self.sheet.reflectance[2];
        first.iter_mut().for_each(|first| *first *= scale);
        let incident = product(response, &first);
        let exitance: Vec<f64> = incident.iter().zip(walls.areas()).map(|(l, area)| wall * l / (PI * area)).collect();
        let k = usize::from(side == Side::Back);
        let sent = |turned: bool, side: usize| {
            let way = &seen.ways[depth][usize::from(turned)][side];
            let lit = || {
                let lit = walls.lit(cells, Side::BOTH[side], turned).walls;
                Mat::from_fn(lit.nrows(), lit.ncols(), |cell, patch| lit[(cell, patch)] as f32)
            };
            product(way.get(lit), &exitance)
        };
        let face = self.sheet.reflectance[k];
        let solid = 1.0 - self.sheet.open();
        Rest {
            // Leaving light is named as what would light the walls from the other side.
            transmitted: sent(false, 1 - k),
            reflected: sent(true, k).into_iter().map(|q| face * solid / PI + q).collect(),
            absorbed: (1.0 - face) * solid + (1.0 - wall) * incident.iter().sum::<f64>(),
        }
    }
}

/// Returns the product of a matrix and a vector, summed column by column, since columns are contiguous in memory.
fn product<T: Copy + Into<f64>>(matrix: &Mat<T>, of: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; matrix.nrows()];
    for (j, factor) in of.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
        add_scaled(&mut sums, matrix.col_as_slice(j), *factor);
    }
    sums
}

impl OpticalModel for Holes {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        measure_walls(&self.sheet, setting, progress)
    }

    fn beams(&self, direction: Dir<Facade>, _: Side) -> Vec<Beam> {
        let share = self.sheet.straight(direction);
        if share > 0.0 { vec![Beam::through(direction, share)] } else { vec![] }
    }

    /// Computes the scattered light with the fine division of the walls; the error is its difference from the coarse
    /// one plus the missing energy.
    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        let face = self.sheet.reflectance[usize::from(side == Side::Back)] * (1.0 - self.sheet.open());
        if self.sheet.reflectance[2] == 0.0 {
            let reflected = if face > 0.0 { vec![face / PI; emergent.len()] } else { vec![] };
            return ScatteredLight { reflected, ..ScatteredLight::default() };
        }
        let seen = self.seen.get(emergent, Seen::default);
        let [coarse, fine] = [0, 1].map(|depth| self.rest(direction, side, depth, emergent, &seen));
        let weight = emergent.projected_solid_angles();
        let share = |q: &[f64]| q.iter().zip(&weight).map(|(q, w)| q * w).sum::<f64>();
        let [t, r] = [share(&fine.transmitted), share(&fine.reflected)];
        let difference = (t - share(&coarse.transmitted)).abs().max((r - share(&coarse.reflected)).abs());
        let missing = (1.0 - self.sheet.straight(direction) - t - r - fine.absorbed).abs();
        ScatteredLight { transmitted: fine.transmitted, reflected: fine.reflected, error: difference + missing }
    }

    fn bytes(&self) -> usize {
        let one = |matrix: &Mat<f32>| size_of::<f32>() * matrix.nrows() * matrix.ncols();
        let solved = |solved: &Solved| size_of::<f64>() * solved.response.nrows() * solved.response.ncols();
        self.walls.bytes(|walls| walls.iter().map(solved).sum())
            + self.seen.bytes(|seen| seen.ways.iter().flatten().flatten().map(|way| way.bytes(one)).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::sub_directions;
    use crate::compute::estimate::Silent;
    use crate::compute::system::sheets::Hole;

    #[test]
    fn single_directions_have_the_mean_that_is_measured_and_lose_nothing() {
        let cells = front_basis();
        let weight = cells.projected_solid_angles();
        let share = |q: &[f64]| q.iter().zip(&weight).map(|(q, w)| q * w).sum::<f64>();
        for (hole, rise) in
            [(Hole::Round { diameter: 0.007 }, 0.0), (Hole::Rhombus { width: 0.012, height: 0.007 }, 0.002)]
        {
            let holes =
                Holes::new(Perforated { hole, area: 1e-4, thickness: 0.003, rise, reflectance: [0.6, 0.4, 0.8] });
            let setting = Setting { incident: &cells, emergent: &cells, error: 0.005, seed: 1 };
            let made = holes.measure(&setting, &Silent).unwrap();
            for side in Side::BOTH {
                for i in [30, 95, 120] {
                    let (mut t, mut r, mut error, mut beam) = (0.0, 0.0, 0.0_f64, 0.0);
                    for direction in sub_directions(&cells.cell(i), 3) {
                        let found = holes.scattered(direction, side, &cells);
                        t += share(&found.transmitted) / 9.0;
                        r += share(&found.reflected) / 9.0;
                        error = error.max(found.error);
                        beam += holes.beams(direction, side).iter().map(|beam| beam.share).sum::<f64>() / 9.0;
                    }
                    let row = |q: &[f64]| share(&q[i * 145..(i + 1) * 145]);
                    let (t0, r0) = (row(&made.seen(side).transmitted), row(&made.seen(side).reflected));
                    assert!(error < 0.01, "{error}");
                    assert!((t + beam - t0).abs() < 0.006 && (r - r0).abs() < 0.006, "{i} {t} {beam} {t0} {r} {r0}");
                }
            }
        }
    }
}
