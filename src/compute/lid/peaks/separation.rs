//! Separation of beams in patch-averaged data: cells that beams from an incident cell can reach, and their flux above
//! the surrounding cells.

use super::mean_field::{Point, points};
use crate::compute::basis::Neighbours;
use crate::compute::btdf::CellMatrix;
use crate::compute::direction::{Dir, Facade};
use glam::DVec3;
use std::f64::consts::PI;

/// Path of a beam through a system, from the incident direction to the reversed emergent direction (direction of
/// undeviated light).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Path {
    /// Undeviated path.
    Straight,
    /// Reflection by mirrors with this normal (façade frame): faces of slats, cuts of a panel.
    Mirrored(DVec3),
}

impl Path {
    /// Returns the reversed emergent direction of light from the incident direction `from`; `None` if it does not reach
    /// the room side.
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

/// Step of the mirror tilts that are tried. \[rad\] Half a step, the largest error of a tilt, rotates a reflected beam
/// by 2.5°, a quarter of a Klems ring.
const STEP: f64 = 2.5 * PI / 180.0;
/// Number of steps of tilt to both sides, up to 50°. Chosen: cost; light of more tilted mirrors remains in its cells
/// and counts as uncertain.
const STEPS: i32 = 20;
/// Minimum share of the flux in peaks beside the undeviated beam that mirrors must explain to be accepted: curved
/// mirrors spread it over a fan. Chosen; held by
/// `tests/scenes/beams_in_cells::the_truth_of_strange_files_lies_within_what_is_stated`.
const EXPLAINED: f64 = 0.7;
/// Ratio of two explained shares above which they count as equal; the smaller tilt is then used. Chosen; held like
/// [`EXPLAINED`].
const EQUAL: f64 = 0.98;

/// Number of directions per side of an incident cell for the search of the emergent cells that a path reaches. Chosen:
/// cost; every 1° to 2° in Klems cells, so that a missed corner holds less than 1/64 of the cell.
const FINE: usize = 8;

/// Emergent cells that light of one path from an incident cell reaches.
#[derive(Debug, Clone)]
pub(super) struct Reached {
    /// Points of the incident cell with the index of the emergent cell that light from each reaches.
    pub(super) points: Vec<(Point, usize)>,
    /// Indices of the emergent cells reached, each once.
    pub(super) cells: Vec<usize>,
}

/// Patch-averaged data with the neighbours, weights \[sr\] and points of their cells, for the search for beams.
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

    /// Whether incident and emergent cells have the same borders. Otherwise an undeviated beam from one incident cell
    /// lies in several emergent cells.
    pub(super) fn aligned(&self) -> bool {
        let emergent = self.matrix.emergent();
        self.points.iter().zip(&self.incident_weight).all(|(points, weight)| {
            let own = emergent.index(points[0].direction);
            own.is_some_and(|o| (self.weight[o] - weight).abs() < 1e-6 * weight)
                && points.iter().all(|p| emergent.index(p.direction) == own)
        })
    }

    /// Returns the emergent cells that light of a path from an incident cell reaches.
    pub(super) fn reached(&self, path: Path, incident: usize) -> Reached {
        let emergent = self.matrix.emergent();
        let to = |p: &Point| Some((*p, emergent.index(path.of(p.direction)?)?));
        let points: Vec<(Point, usize)> = self.points[incident].iter().filter_map(to).collect();
        let mut cells: Vec<usize> = points.iter().map(|p| p.1).collect();
        if path != Path::Straight {
            // Corners of a cell that no sample point represents can still contain light.
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

    /// Returns the mean luminance coefficient of the cells around emergent cells, without the cells `but`. \[1/sr\]
    pub(super) fn background(&self, row: &[f64], cells: &[usize], but: &[usize]) -> f64 {
        self.around.level(row, cells, but)
    }

    /// Returns the path of mirrors that best explains the peaks beside the undeviated beam; `None` if there are none or
    /// no mirrors explain them.
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
        // Below 1 % of the flux, mirror directions are not searched for.
        if total <= 0.01 * all {
            return None;
        }
        // Overlap of the peaks with the light that mirrors with this normal would reflect.
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
        // By rising tilt, so that of about equally good normals the one with the smaller tilt is chosen.
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
