//! Correspondence of the lobes of neighbouring incident directions: which lobes belong together, and how their centres
//! change with the incident direction.
//!
//! The response of a lobe is the 2 × 2 matrix of the changes of its centre's direction cosines with those of the
//! incident direction: the unit matrix for undeviated light, diag(1, −1) for light mirrored in the vertical, anything
//! else for rolled panels and prisms. Plane layers and gratings shift direction cosines, so that for them the matrix is
//! constant and the predicted centre exact.

use super::lattice::{Lattice, tangent_step};
use super::lobes::Lobe;
use glam::{DMat2, DVec2, DVec3};

/// Distance between a lobe's predicted centre and a lobe at the neighbour above which the two are different lobes.
/// \[chord\] The share of flux misplaced with this and [`FLUX_COST`] is printed by `tests/compute/incidence_schemes`;
/// no table of other values is kept.
const GATE: f64 = 0.12;
/// Distance added for different fluxes f and f′ of two lobes, as a chord per unit of |ln(f/f′)|.
const FLUX_COST: f64 = 0.035;

/// Changes of the lobes with the incident direction: for every lobe the derivative of its centre, and the corresponding
/// lobes at the neighbouring incident directions.
#[derive(Debug, Clone)]
pub struct Responses {
    /// Derivative of the direction cosines (x, y) of a lobe's centre with respect to those of the incident direction;
    /// by index of incident direction and lobe.
    pub jacobian: Vec<Vec<DMat2>>,
    /// Index of the corresponding lobe at a neighbouring incident direction; by incident direction, neighbour (in the
    /// order of the triangulation's list) and lobe. `None` if the neighbour lacks the lobe.
    pub partner: Vec<Vec<Vec<Option<usize>>>>,
}

/// Returns the unit vector (z ≥ 0) with the direction cosines `p` along x and y; points outside the unit disk give the
/// nearest direction at z = 0.
pub fn lift(p: DVec2) -> DVec3 {
    let r = p.length();
    if r < 1.0 { p.extend((1.0 - r * r).sqrt()) } else { (p / r).extend(0.0) }
}

impl Responses {
    /// Fits the responses of all lobes, and finds the corresponding lobes at neighbouring incident directions. `lobes`:
    /// lobes by incident direction.
    pub fn new(lattice: &Lattice, lobes: &[Vec<Lobe>]) -> Self {
        let alone: Vec<Vec<DMat2>> = (0..lobes.len())
            .map(|v| lobes[v].iter().map(|lobe| jacobian(lattice, lobes, v, lobe, &[])).collect())
            .collect();
        // A response that neighbouring directions have, too, is more likely than a different one.
        let jacobians: Vec<Vec<DMat2>> = (0..lobes.len())
            .map(|v| {
                let shared: Vec<DMat2> = lattice.neighbours(v).iter().flat_map(|&n| alone[n].iter().copied()).collect();
                lobes[v].iter().map(|lobe| jacobian(lattice, lobes, v, lobe, &shared)).collect()
            })
            .collect();
        let partner: Vec<Vec<Vec<Option<usize>>>> = (0..lobes.len())
            .map(|v| lattice.neighbours(v).iter().map(|&n| partners(lattice, lobes, &jacobians, v, n)).collect())
            .collect();
        Self { jacobian: jacobians, partner }
    }
}

impl Responses {
    /// Whether a lobe that is absent at a neighbouring direction exists again at a direction beyond that neighbour.
    pub fn returns(&self, lattice: &Lattice, lobes: &[Vec<Lobe>], (v, l): (usize, usize), neighbour: usize) -> bool {
        let points = lattice.points();
        let ahead = tangent_step(points[v], points[neighbour]).length();
        let lobe = &lobes[v][l];
        lattice.neighbours(neighbour).iter().any(|&far| {
            let direction = tangent_step(points[v], points[far]).length();
            let target = lift(lobe.centre.truncate() + self.jacobian[v][l] * (points[far] - points[v]).truncate());
            direction > 1.6 * ahead && lobes[far].iter().any(|other| (other.centre - target).length() < GATE)
        })
    }
}

/// Returns for each lobe of direction `v` the corresponding lobe at its neighbour `n`: the pairs in which each is the
/// best match of the other.
fn partners(
    lattice: &Lattice,
    lobes: &[Vec<Lobe>],
    jacobians: &[Vec<DMat2>],
    v: usize,
    n: usize,
) -> Vec<Option<usize>> {
    let best = |from: usize, to: usize, l: usize| {
        let step = (lattice.points()[to] - lattice.points()[from]).truncate();
        let lobe = &lobes[from][l];
        let target = lift(lobe.centre.truncate() + jacobians[from][l] * step);
        (0..lobes[to].len())
            .map(|m| (cost(target, lobe.flux, &lobes[to][m]), m))
            .filter(|(cost, _)| *cost < GATE)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, m)| m)
    };
    (0..lobes[v].len())
        .map(|l| {
            let there = best(v, n, l)?;
            let back = best(n, v, there);
            // A counterpart is accepted if it leads back to the lobe, or if it leads to none and is the neighbour's
            // only lobe.
            (back == Some(l) || (back.is_none() && lobes[n].len() == 1)).then_some(there)
        })
        .collect()
}

/// Returns the disagreement of a lobe with a predicted centre and flux, as a chord.
fn cost(target: DVec3, flux: f64, lobe: &Lobe) -> f64 {
    (target - lobe.centre).length() + FLUX_COST * (flux / lobe.flux).ln().abs()
}

/// Returns the response of a lobe that agrees best with the lobes at the neighbouring directions; simple responses and
/// those `shared` by neighbours are preferred.
fn jacobian(lattice: &Lattice, lobes: &[Vec<Lobe>], v: usize, lobe: &Lobe, shared: &[DMat2]) -> DMat2 {
    let centre = lobe.centre.truncate();
    let around: Vec<(usize, DVec2)> = lattice
        .neighbours(v)
        .iter()
        .filter(|&&n| !lobes[n].is_empty())
        .map(|&n| (n, (lattice.points()[n] - lattice.points()[v]).truncate()))
        .collect();
    let nearest = |jacobian: DMat2, n: usize, step: DVec2| {
        let target = lift(centre + jacobian * step);
        lobes[n]
            .iter()
            .map(|other| (cost(target, lobe.flux, other), other.centre.truncate()))
            .min_by(|a, b| a.0.total_cmp(&b.0))
    };
    // Disagreement with every neighbour, each limited to the gate, plus a penalty for responses unlike a rotation.
    let score = |jacobian: DMat2| {
        let disagreement: f64 = around
            .iter()
            .map(|&(n, step)| nearest(jacobian, n, step).map_or(GATE, |(cost, _)| cost.min(GATE)).powi(2))
            .sum();
        disagreement + 2e-3 * unlike_a_turn(jacobian)
    };
    let straight = lattice.points()[v];
    let side = |j: DMat2| (lift(j * straight.truncate()) - lobe.centre).length();
    let simple =
        [DMat2::IDENTITY, DMat2::from_diagonal(DVec2::new(1.0, -1.0)), DMat2::from_diagonal(DVec2::new(-1.0, 1.0))];
    // Ties go to the response that also explains where the lobe is.
    let mut best = (f64::INFINITY, DMat2::IDENTITY);
    for j in simple {
        let score = score(j) + 1e-3 * side(j);
        if score < best.0 {
            best = (score, j);
        }
    }
    for &j in shared {
        let score = score(j) + 1e-3 * side(j);
        if score < best.0 {
            best = (score, j);
        }
    }
    for (i, &(n, a)) in around.iter().enumerate() {
        for &(m, b) in &around[i + 1..] {
            let steps = DMat2::from_cols(a, b);
            if steps.determinant().abs() < 0.3 * a.length() * b.length() {
                continue;
            }
            let inverse = steps.inverse();
            for p in &lobes[n] {
                for q in &lobes[m] {
                    let moves = DMat2::from_cols(p.centre.truncate() - centre, q.centre.truncate() - centre);
                    let candidate = moves * inverse;
                    let score = score(candidate) + 4e-3;
                    if score < best.0 {
                        best = (score, candidate);
                    }
                }
            }
        }
    }
    refined(best.1, &around, &nearest, centre).unwrap_or(best.1)
}

/// Returns the squared deviation of a matrix from a rotation or reflection.
fn unlike_a_turn(j: DMat2) -> f64 {
    let excess = j.transpose() * j - DMat2::IDENTITY;
    excess.x_axis.length_squared() + excess.y_axis.length_squared()
}

/// Refines a response by least squares over the neighbours that agree.
fn refined(
    start: DMat2,
    around: &[(usize, DVec2)],
    nearest: &impl Fn(DMat2, usize, DVec2) -> Option<(f64, DVec2)>,
    centre: DVec2,
) -> Option<DMat2> {
    let agreeing: Vec<(DVec2, DVec2)> = around
        .iter()
        .filter_map(|&(n, step)| {
            nearest(start, n, step).filter(|(cost, _)| *cost < 0.5 * GATE).map(|(_, c)| (step, c - centre))
        })
        .collect();
    let (mut square, mut mixed) = (DMat2::ZERO, DMat2::ZERO);
    let outer = |a: DVec2, b: DVec2| DMat2::from_cols(a * b.x, a * b.y);
    for &(step, change) in &agreeing {
        square += outer(step, step);
        mixed += outer(change, step);
    }
    if agreeing.len() < 3 {
        return None;
    }
    // The initial response has the weight of a step of 0.04 in direction cosines: towards grazing incidence these
    // hardly change, and errors of the centres would decide.
    let keep = agreeing.len() as f64 * 0.04 * 0.04;
    square += DMat2::from_diagonal(DVec2::splat(keep));
    mixed += start * keep;
    Some(mixed * square.inverse())
}

/// Returns the least-squares gradient of differences over steps; `None` when they lie on one line. Weights fall with
/// the cube of the step, so that two steps of unequal length to either side give the slope of the parabola through
/// them.
pub fn gradient(samples: &[(DVec2, f64)]) -> Option<DVec2> {
    let (mut square, mut mixed) = (DMat2::ZERO, DVec2::ZERO);
    for &(step, change) in samples {
        let weight = step.length().powi(-3);
        square += DMat2::from_cols(step * step.x, step * step.y) * weight;
        mixed += step * (change * weight);
    }
    let trace = square.x_axis.x + square.y_axis.y;
    (square.determinant() > 0.02 * trace * trace).then(|| square.inverse() * mixed)
}
