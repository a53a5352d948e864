//! Interpolation of a scalar (the flux of a lobe or of a base) between incident directions: linear, with a curvature
//! from the slopes at the neighbours, and with a kink where slopes from both sides meet inside an edge.
//!
//! On an edge from a to b a cubic with given slopes differs from the straight line by −t(1 − t)·(A(1 − t) + Bt), where
//! A and B are what the slope at either end leaves unexplained at the other. A blind's direct share or a panel's
//! deflected share has kinks instead, which a 12° lattice does not resolve: there the slopes on both sides are followed
//! into the edge until they meet (subcell resolution, Harten 1989). Over a triangle the terms of the three edges add
//! up, each homogeneous of second degree in the barycentric weights, so that the interpolated scalar is continuous
//! across edges.

use super::lattice::{Lattice, tangent_step};
use super::response::gradient;
use glam::DVec2;

/// Cosine between two steps below which they count as opposite: within 37° of a straight line. Chosen, like the limits
/// of [`bump`]: `tests/compute/incidence_schemes` prints the share of flux misplaced with it; no table of other values
/// is kept.
const BEHIND: f64 = -0.8;

/// Term that an edge of the triangulated incident directions adds to the linear interpolation of a flux along it, with
/// t = 0 … 1 from its first to its second end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bump {
    /// Cubic term −t(1 − t)·(`[0]`(1 − t) + `[1]`t), in the unit of the flux.
    Cubic([f64; 2]),
    /// Kink: `[0]`·t from the first end or `[1]`·(1 − t) from the second, whichever has the smaller magnitude.
    Tent([f64; 2]),
}

impl Bump {
    /// Returns the term's contribution inside a triangle, for the barycentric weights `wa` and `wb` of the edge's two
    /// ends.
    pub fn at(self, wa: f64, wb: f64) -> f64 {
        match self {
            Self::Cubic([a, b]) => {
                let sum = wa + wb;
                if sum > 0.0 { -wa * wb * (a * wa + b * wb) / sum } else { 0.0 }
            }
            Self::Tent([p, q]) => {
                let (from_a, from_b) = (p * wb, q * wa);
                (wa + wb) * if from_a.abs() < from_b.abs() { from_a } else { from_b }
            }
        }
    }
}

/// Scalar at the incident directions that is followed lobe by lobe, such as the flux of a lobe: its value, and the
/// corresponding lobe at neighbouring directions.
pub trait Field {
    /// Returns the scalar for a lobe of an incident direction, both by index.
    fn value(&self, vertex: usize, lobe: usize) -> f64;
    /// Returns the index of the lobe that corresponds to `lobe` at a neighbouring incident direction; `None` if it has
    /// none. `neighbour` is the index in the list of the vertex's neighbours.
    fn partner(&self, vertex: usize, lobe: usize, neighbour: usize) -> Option<usize>;
    /// Returns the scalar extrapolated to θ = 90° from an incident direction on the border of the data; `None` at other
    /// directions.
    fn at_grazing(&self, vertex: usize, lobe: usize) -> Option<f64>;
}

/// Changes of a scalar that its slope at one incident direction predicts for the step to each neighbouring direction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Slopes {
    /// Change predicted by the gradient over all neighbours, per neighbour; `None` where neighbours lie on one side
    /// only.
    pub centred: Vec<Option<f64>>,
    /// Change predicted by the gradient over the neighbours on the other side of the direction, per neighbour; `None`
    /// where no neighbour lies opposite.
    pub one_sided: Vec<Option<f64>>,
}

/// Computes the changes that the slopes of `field` at one lobe of one incident direction predict towards every
/// neighbour.
pub fn slopes(lattice: &Lattice, field: &impl Field, vertex: usize, lobe: usize) -> Slopes {
    let here = lattice.points()[vertex];
    let neighbours = lattice.neighbours(vertex);
    let steps: Vec<DVec2> = neighbours.iter().map(|&n| tangent_step(here, lattice.points()[n])).collect();
    let value = field.value(vertex, lobe);
    let changes: Vec<Option<f64>> = (0..neighbours.len())
        .map(|k| field.partner(vertex, lobe, k).map(|other| field.value(neighbours[k], other) - value))
        .collect();
    let mut known: Vec<(DVec2, f64)> = steps.iter().zip(&changes).filter_map(|(s, c)| c.map(|c| (*s, c))).collect();
    if let (Some(grazing), Some(out)) = (field.at_grazing(vertex, lobe), here.truncate().try_normalize()) {
        known.push((tangent_step(here, out.extend(0.0)), grazing - value));
    }
    let centre = if surrounded(&known) { gradient(&known) } else { None };
    let one_sided = steps
        .iter()
        .map(|&ahead| {
            let behind: Vec<(DVec2, f64)> = known
                .iter()
                .copied()
                .filter(|(step, _)| step.dot(ahead) <= 0.26 * step.length() * ahead.length())
                .collect();
            let opposite = |(step, _): &(DVec2, f64)| step.dot(ahead) < BEHIND * step.length() * ahead.length();
            if lattice.is_on_border(vertex) || !behind.iter().any(opposite) {
                return None;
            }
            gradient(&behind).or_else(|| along_one_line(&behind)).map(|g| g.dot(ahead))
        })
        .collect();
    Slopes { centred: steps.iter().map(|step| centre.map(|g| g.dot(*step))).collect(), one_sided }
}

/// Returns the term that the edge between two incident directions adds to linear interpolation. `values`: the scalar at
/// its ends; `towards`: the slopes at each end with the index of the other end among its neighbours; `behind`: error at
/// each end of the slope one edge further back, which is as large there as on this edge if the scalar is smooth.
pub fn bump(values: [f64; 2], towards: [(&Slopes, usize); 2], behind: [Option<f64>; 2]) -> Bump {
    let difference = values[1] - values[0];
    let [(a, ab), (b, ba)] = towards;
    if let (Some(p), Some(q), Some(before), Some(after)) =
        (a.one_sided[ab].map(|g| difference - g), b.one_sided[ba].map(|g| -difference - g), behind[0], behind[1])
    {
        let jump = p.abs().max(q.abs());
        if p * q > 0.0 && jump > 0.02 * values[0].max(values[1]) && before.abs() + after.abs() < 0.5 * jump {
            return Bump::Tent([-p, -q]);
        }
    }
    let first = a.centred[ab].map(|g| difference - g);
    let second = b.centred[ba].map(|g| -difference - g);
    let limit = difference.abs();
    Bump::Cubic(match (first, second) {
        // Neither end may bend much more than the other: at a kink in a vertex one of them does not bend at all.
        (Some(p), Some(q)) if p * q > 0.0 => {
            let least = 2.5 * p.abs().min(q.abs());
            [p.clamp(-least, least), q.clamp(-least, least)].map(|c| c.clamp(-limit, limit))
        }
        // Curvature is known at one end only: the same is assumed at the other, within limits.
        (Some(p), None) | (None, Some(p)) => [p.clamp(-0.5 * limit, 0.5 * limit); 2],
        _ => [0.0; 2],
    })
}

/// Returns the difference between the scalar at an incident direction and its extrapolation from the neighbour that
/// lies opposite to the neighbour `ahead`; `None` if no neighbour lies opposite or has the lobe.
pub fn missed_behind(
    lattice: &Lattice,
    field: &impl Field,
    slopes: impl Fn(usize, usize) -> Slopes,
    (vertex, lobe): (usize, usize),
    ahead: usize,
) -> Option<f64> {
    let here = lattice.points()[vertex];
    let neighbours = lattice.neighbours(vertex);
    let direction = tangent_step(here, lattice.points()[neighbours[ahead]]).normalize_or_zero();
    let (k, cosine) = (0..neighbours.len())
        .map(|k| (k, tangent_step(here, lattice.points()[neighbours[k]]).normalize_or_zero().dot(direction)))
        .min_by(|x, y| x.1.total_cmp(&y.1))?;
    let back = neighbours[k];
    let other = field.partner(vertex, lobe, k).filter(|_| cosine < BEHIND)?;
    let towards = lattice.neighbours(back).binary_search(&vertex).ok()?;
    let followed = slopes(back, other).one_sided[towards]?;
    Some(field.value(vertex, lobe) - field.value(back, other) - followed)
}

/// Whether steps go to all sides: no wedge of 135° is empty.
fn surrounded(samples: &[(DVec2, f64)]) -> bool {
    let mut angles: Vec<f64> = samples.iter().map(|(step, _)| step.y.atan2(step.x)).collect();
    angles.sort_by(f64::total_cmp);
    let gap = |k: usize| {
        let next = if k + 1 == angles.len() { angles[0] + 2.0 * std::f64::consts::PI } else { angles[k + 1] };
        next - angles[k]
    };
    angles.len() >= 4 && (0..angles.len()).all(|k| gap(k) < 0.75 * std::f64::consts::PI)
}

/// Returns the gradient for samples that all lie along one line. `samples`: step from the vertex in the tangent plane
/// \[rad\] and change of the scalar over it.
pub fn along_one_line(samples: &[(DVec2, f64)]) -> Option<DVec2> {
    let weight: f64 = samples.iter().map(|(step, _)| step.length_squared()).sum();
    (weight > 0.0).then(|| samples.iter().map(|&(step, change)| step * change).sum::<DVec2>() / weight)
}
