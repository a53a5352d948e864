//! Full grid of rank 3: a function averaged over the azimuths of incidence, on an emergent square that rotates with
//! them.

use super::codes::{Codes, matrix_of, spread_leaves, to_flux};
use crate::compute::basis::{RingBasis, SquareGrid, disk_from_square};
use crate::compute::btdf::tensor_tree::{TreeAxes, TreeRank, rotate};
use crate::compute::btdf::{Btdf, Scattered};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Number of azimuths of incidence over which rank 3 averages. Chosen: cost; steps of 10° meet every Klems sector (15°
/// and more), and τ is computed from more directions. No test of its own.
const AZIMUTHS: usize = 36;

/// Returns the values of a function on the full grid of rank 3, and the share of its flux by which single azimuths of
/// incidence differ from the mean.
pub(super) fn three(btdf: &Btdf, axes: TreeAxes, grid: SquareGrid, codes: &Codes) -> (Vec<f64>, f64) {
    let (resolution, area) = (grid.resolution(), grid.projected_solid_angle());
    let mut values = vec![0.0; codes.values];
    let rings = resolution / 2;
    let outward: Vec<usize> = grid.cells().map(|cell| codes.of_square(1, cell.position())).collect();
    let (mut misplaced, mut all) = (0.0, 0.0);
    match &btdf.scattered {
        Some(Scattered::Tree(tree)) if tree.rank() == TreeRank::Three => {
            spread_leaves(tree, grid.level(), codes, &mut values);
        }
        None => {}
        Some(scattered) => {
            let sampler = Sampler::new(btdf, scattered);
            let rows: Vec<(Vec<f64>, f64, f64)> =
                (0..rings).into_par_iter().map(|at| ring_mean(btdf, &sampler, axes, grid, at)).collect();
            for (at, (row, differs, flux)) in rows.into_iter().enumerate() {
                misplaced += differs;
                all += flux;
                for (place, q) in outward.iter().zip(row) {
                    values[codes.of(0, at) | place] += q;
                }
            }
        }
    }
    if let Some(tau) = &btdf.regular {
        for at in 0..rings {
            let sines = (0..16).map(|k| 1.0 - 2.0 * (at as f64 + (k as f64 + 0.5) / 16.0) / resolution as f64);
            let (sum, weight) = sines.fold((0.0, 0.0), |(sum, weight), r| (sum + r * tau.at(r.asin()), weight + r));
            // Undeviated light lies on the border between cells at azimuth 0: half of it goes to either side.
            for iy in [rings - 1, rings] {
                let place = codes.of(0, at) | codes.of_square(1, [resolution - 1 - at, iy]);
                values[place] += 0.5 * sum / weight / area;
            }
        }
    }
    (values, if all > 0.0 { misplaced / all } else { 0.0 })
}

/// Evaluation of q of the scattered part, with quantities that are the same for all emergent directions computed once.
#[expect(clippy::large_enum_variant, reason = "one a block, never in a list")]
enum Sampler<'a> {
    Cells { incident: RingBasis, emergent: RingBasis, values: Vec<f64> },
    Other(&'a Btdf),
}

impl<'a> Sampler<'a> {
    fn new(btdf: &'a Btdf, scattered: &Scattered) -> Self {
        match matrix_of(scattered) {
            None => Self::Other(btdf),
            Some(matrix) => Self::Cells {
                incident: matrix.incident().clone(),
                emergent: matrix.emergent().clone(),
                values: matrix.values().into_owned(),
            },
        }
    }

    /// Returns q for the incident direction `from` as a function of the reversed emergent direction. \[1/sr\]
    fn from(&self, from: Dir<Facade>) -> impl Fn(Dir<Facade>) -> f64 {
        let start = match self {
            Self::Cells { incident, emergent, .. } => incident.index(from).map(|i| i * emergent.len()),
            Self::Other(_) => None,
        };
        move |out| match (self, start) {
            (Self::Cells { emergent, values, .. }, Some(start)) => {
                emergent.index(out).map_or(0.0, |o| values[start + o])
            }
            (Self::Cells { .. }, None) => 0.0,
            (Self::Other(btdf), _) => btdf.q(Incident(from), Emergent::from_undeviated(out)),
        }
    }
}

/// Computes the mean of q over the azimuths of one ring of incidence, on the emergent square that rotates with them;
/// also the sum by which single azimuths differ from it, and the flux, both weighted by the ring.
fn ring_mean(btdf: &Btdf, sampler: &Sampler<'_>, axes: TreeAxes, grid: SquareGrid, at: usize) -> (Vec<f64>, f64, f64) {
    // Number of polar angles across a ring of incidence. Chosen: cost; τ is set by more directions.
    const RADII: usize = 3;
    let direction = |disk: [f64; 2]| -> Dir<Facade> {
        let [x, y] = axes.turn(disk);
        Dir::from_unit(DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt()))
    };
    let sine = |u: f64| 1.0 - 2.0 * (at as f64 + u) / grid.resolution() as f64;
    let angle = |k: usize, of: usize| 2.0 * PI * (k as f64 + 0.5) / of as f64;
    let side = 1.0 / grid.resolution() as f64;
    // The map from square to disk keeps areas, so that four equal quarters of a cell weigh the same; all azimuths use
    // them, rotated.
    let disks: Vec<[[f64; 2]; 4]> = grid
        .cells()
        .map(|cell| {
            let ([x, y], _) = cell.bounds();
            [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]
                .map(|[u, v]| disk_from_square([x + u * side, y + v * side]))
        })
        .collect();
    let mut rows = vec![vec![0.0; grid.len()]; AZIMUTHS];
    // Projected solid angle in a ring is r dr dφ: radii weigh by r.
    let weights: f64 = (0..RADII).map(|k| sine((k as f64 + 0.5) / RADII as f64)).sum();
    for (k, row) in rows.iter_mut().enumerate() {
        let turn = angle(k, AZIMUTHS);
        for radius in 0..RADII {
            let r = sine((radius as f64 + 0.5) / RADII as f64);
            // Incident and emergent direction are rotated together: light that does not depend on the azimuth stays in
            // one cell.
            let of = sampler.from(direction(rotate([r, 0.0], turn)));
            for (value, cell) in row.iter_mut().zip(&disks) {
                let sum: f64 = cell.iter().map(|&disk| of(direction(rotate(disk, turn)))).sum();
                *value += 0.25 * sum * r / weights;
            }
        }
    }
    let mut mean = vec![0.0; grid.len()];
    for row in &rows {
        mean.iter_mut().zip(row).for_each(|(m, q)| *m += q / AZIMUTHS as f64);
    }
    // Deviations at single azimuths cannot be represented in rank 3. The ring's weight lets the caller add up rings.
    let ring = sine(0.5) * grid.projected_solid_angle();
    let misplaced: f64 = rows.iter().flat_map(|row| row.iter().zip(&mean).map(|(q, m)| (q - m).abs())).sum::<f64>();
    let flux: f64 = mean.iter().sum();
    // The emergent square is sampled too coarsely for an accurate flux: it is scaled to τ of the scattered part alone,
    // averaged over more incident directions; the caller adds the undeviated light.
    let scattered = Btdf { regular: None, scattered: btdf.scattered.clone() };
    let (mut tau, mut weight) = (0.0, 0.0);
    for k in 0..72 {
        for radius in 0..16 {
            let r = sine((f64::from(radius) + 0.5) / 16.0);
            tau += r * scattered.tau(Incident(direction(rotate([r, 0.0], angle(k, 72)))));
            weight += r;
        }
    }
    to_flux(&mut mean, tau / weight, grid.projected_solid_angle());
    (mean, ring * misplaced / AZIMUTHS as f64, ring * flux)
}
