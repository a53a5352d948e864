//! Separation of beams in the rows of a matrix: flux of the cells that a beam through an incident cell can reach, above
//! what surrounds them.

use super::mean_field::{Point, points};
use crate::compute::basis::Neighbours;
use crate::compute::btdf::CellMatrix;
use crate::compute::direction::{Dir, Facade};
use glam::DVec3;
use std::f64::consts::PI;

/// Path of a beam, between through directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Path {
    /// Undeviated path.
    Straight,
    /// Reflection by mirrors with this normal: faces of slats, cuts of a panel.
    Mirrored(DVec3),
}

impl Path {
    /// Returns the through direction in which light from `from` leaves; `None` where it would not come through.
    pub(super) fn of(self, from: Dir<Facade>) -> Option<Dir<Facade>> {
        match self {
            Self::Straight => Some(from),
            Self::Mirrored(normal) => {
                let v = from.vector();
                let to = v - 2.0 * v.dot(normal) * normal;
                (to.z > 1e-6).then(|| Dir::from_unit(to))
            }
        }
    }
}

/// Step of the tilts of mirrors that are tried. \[rad\] Half a step, the largest error of a tilt, turns a reflected
/// beam by 2.5°, a quarter of a Klems ring.
const STEP: f64 = 2.5 * PI / 180.0;
/// Number of steps to both sides, up to 50°. Chosen: cost; light of steeper mirrors stays in its cells as uncertain.
const STEPS: i32 = 20;
/// Share of all the light that stands out beside the straight beam that mirrors must explain to be believed: curved
/// ones spread it over a fan. Chosen; held by
/// `tests/scenes/beams_in_cells::the_truth_of_strange_files_lies_within_what_is_stated`.
const EXPLAINED: f64 = 0.7;
/// Ratio of two explained shares above which they count as equal; the rounder tilt is then taken. Chosen; held as
/// [`EXPLAINED`].
const EQUAL: f64 = 0.98;

/// Number of directions per side of a cell by which the cells that a path reaches are found. Chosen: cost; every 1° to
/// 2° in Klems cells, so that a missed corner holds less than 1/64 of the cell.
const FINE: usize = 8;

/// Beams of one path through an incident cell.
#[derive(Debug, Clone)]
pub(super) struct Reached {
    /// Points of the incident cell with the emergent cell that each goes to.
    pub(super) points: Vec<(Point, usize)>,
    /// Emergent cells reached, each once.
    pub(super) cells: Vec<usize>,
}

/// Matrix with the cells, weights and points that the search for beams needs.
pub(super) struct Separation<'a> {
    pub(super) matrix: &'a CellMatrix,
    /// Emergent cells that touch each emergent cell.
    pub(super) around: Neighbours,
    pub(super) incident_weight: Vec<f64>,
    pub(super) weight: Vec<f64>,
    points: Vec<Vec<Point>>,
}

impl<'a> Separation<'a> {
    pub(super) fn new(matrix: &'a CellMatrix) -> Self {
        Self {
            matrix,
            around: Neighbours::new(matrix.emergent()),
            incident_weight: matrix.incident().projected_solid_angles(),
            weight: matrix.emergent().projected_solid_angles(),
            points: (0..matrix.incident().len()).map(|i| points(matrix.incident(), i)).collect(),
        }
    }

    /// Whether incident and emergent cells have the same borders. Otherwise a beam's cell does not hold all of it.
    pub(super) fn aligned(&self) -> bool {
        let emergent = self.matrix.emergent();
        self.points.iter().zip(&self.incident_weight).all(|(points, weight)| {
            let own = emergent.index(points[0].direction);
            own.is_some_and(|o| (self.weight[o] - weight).abs() < 1e-6 * weight)
                && points.iter().all(|p| emergent.index(p.direction) == own)
        })
    }

    /// Returns the emergent cells that a path leads to from an incident cell.
    pub(super) fn reached(&self, path: Path, incident: usize) -> Reached {
        let emergent = self.matrix.emergent();
        let to = |p: &Point| Some((*p, emergent.index(path.of(p.direction)?)?));
        let points: Vec<(Point, usize)> = self.points[incident].iter().filter_map(to).collect();
        let mut cells: Vec<usize> = points.iter().map(|p| p.1).collect();
        if path != Path::Straight {
            // Corners that no point stands for still hold light.
            let own = self.matrix.incident().cell(incident);
            let at = |k: usize| (k as f64 + 0.5) / FINE as f64;
            cells.extend((0..FINE * FINE).filter_map(|k| {
                let theta = own.theta_min + (own.theta_max - own.theta_min) * at(k / FINE);
                let phi = own.phi + (at(k % FINE) - 0.5) * own.width;
                emergent.index(path.of(Dir::from_theta_phi(theta, phi))?)
            }));
        }
        cells.sort_unstable();
        cells.dedup();
        Reached { points, cells }
    }

    /// Returns the luminance coefficient that surrounds emergent cells, `but` left out. \[1/sr\]
    pub(super) fn background(&self, row: &[f64], cells: &[usize], but: &[usize]) -> f64 {
        self.around.level(row, cells, but)
    }

    /// Returns the mirrors that best explain what stands out beside the straight beam, if any do.
    pub(super) fn mirrors(&self, straight: &[Reached]) -> Option<Path> {
        let n = straight.len();
        let mut excess: Vec<Vec<f64>> = Vec::with_capacity(n);
        let (mut total, mut all) = (0.0, 0.0);
        for (i, own) in straight.iter().enumerate() {
            let row = self.matrix.row(i);
            let stands_out = |o: usize| {
                let above = row[o] - 1.5 * self.background(&row, &[o], &own.cells);
                if own.cells.contains(&o) { 0.0 } else { above.max(0.0) * self.weight[o] }
            };
            let by_cell: Vec<f64> = (0..self.weight.len()).map(stands_out).collect();
            total += self.incident_weight[i] * by_cell.iter().sum::<f64>();
            all += self.incident_weight[i] * self.matrix.tau_by_cell()[i];
            excess.push(by_cell);
        }
        // Nothing that anyone would see.
        if total <= 0.01 * all {
            return None;
        }
        // Overlap of what stands out with where these mirrors would send as much light.
        let explained = |normal: DVec3| -> f64 {
            let one = |i: usize| {
                let reached = self.reached(Path::Mirrored(normal), i);
                let found: f64 = reached.cells.iter().map(|&o| excess[i][o]).sum();
                let share = |o: usize| reached.points.iter().filter(|p| p.1 == o).map(|p| p.0.weight()).sum::<f64>();
                reached.cells.iter().map(|&o| excess[i][o].min(2.0 * found * share(o))).sum::<f64>()
            };
            (0..n).map(|i| self.incident_weight[i] * one(i)).sum::<f64>() / total
        };
        let mut best = (0.0, DVec3::Y);
        // From upright outwards, so that of equals the rounder stays.
        for step in 0..=STEPS {
            for tilt in [step, -step].into_iter().take(if step == 0 { 1 } else { 2 }) {
                let (sin, cos) = (f64::from(tilt) * STEP).sin_cos();
                for normal in [DVec3::new(0.0, cos, sin), DVec3::new(cos, 0.0, sin)] {
                    let own = explained(normal);
                    if EQUAL * own > best.0 {
                        best = (own, normal);
                    }
                }
            }
        }
        (best.0 > EXPLAINED).then_some(Path::Mirrored(best.1))
    }
}
