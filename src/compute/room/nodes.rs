//! Interpolation of luminances that vary over the area of an aperture, by polynomials through nodes at Gauss points.

use super::aperture::{Aperture, View};
use super::grid::Grid;
use super::through;
use crate::compute::basis::RingBasis;
use crate::compute::direction::Dir;
use crate::compute::quadrature::gauss_legendre;
use glam::{DVec2, DVec3};

/// Number of directions from a patch of the room in which the points of an aperture are sampled: a power of two,
/// required by [`through::spread`]. Chosen: cost. No test of its own.
const DIRECTIONS: u32 = 256;

/// Nodes on an aperture, each with the polynomial over the aperture that is 1 at this node and 0 at the others.
#[derive(Debug, Clone)]
pub struct Nodes {
    aperture: Aperture,
    /// Gauss points and weights along both sides, relative to the side.
    sides: [Vec<(f64, f64)>; 2],
}

/// Returns the values of the polynomials of one side at a position, a share of the side.
fn values(side: &[(f64, f64)], at: f64) -> impl Iterator<Item = f64> + '_ {
    (0..side.len()).map(move |k| {
        let others = side.iter().enumerate().filter(|(other, _)| *other != k);
        others.map(|(_, (place, _))| (at - place) / (side[k].0 - place)).product()
    })
}

impl Nodes {
    /// Creates the nodes of an aperture: `long` of them along its longer side and `short` along the other.
    pub fn new(aperture: &Aperture, long: usize, short: usize) -> Self {
        let tall = aperture.size[1] > aperture.size[0];
        let counts = if tall { [short, long] } else { [long, short] };
        Self { aperture: *aperture, sides: counts.map(gauss_legendre) }
    }

    /// Returns the number of nodes of the aperture.
    pub fn count(&self) -> usize {
        self.sides[0].len() * self.sides[1].len()
    }

    /// Adds the values of all polynomials at a position, given as shares of the sides, times a factor to `sums`.
    fn add_values(&self, place: [f64; 2], factor: f64, sums: &mut [f64]) {
        let along: Vec<f64> = values(&self.sides[0], place[0]).collect();
        for (row, across) in sums.chunks_exact_mut(along.len()).zip(values(&self.sides[1], place[1])) {
            row.iter_mut().zip(&along).for_each(|(sum, along)| *sum += factor * across * along);
        }
    }

    /// Adds the illuminance at a point by the aperture, with each polynomial as its luminance distribution, to `sums`:
    /// by cell of the direction in `basis`, then by node, as a sum over directions. \[sr\]
    pub fn add_seen(&self, view: &View, basis: &RingBasis, sums: &mut [f64]) {
        let count = self.count();
        through::spread(view, DIRECTIONS, |towards, counts, place| {
            if let Some(cell) = basis.index(Dir::from_unit(towards)) {
                self.add_values(place, counts, &mut sums[cell * count..(cell + 1) * count]);
            }
        });
    }

    /// Returns the weights of the points of a grid on the same aperture in the luminance of each node: least-squares
    /// fit of the polynomials to the luminance that the grid interpolates.
    pub fn of_grid(&self, grid: &Grid) -> Vec<Vec<f64>> {
        let value = |side: usize, k: usize| move |at: f64| values(&self.sides[side], at).nth(k).unwrap_or_default();
        let of = |(node, part): (usize, f64)| {
            let (i, k) = (node % self.sides[0].len(), node / self.sides[0].len());
            grid.integrals(value(0, i), value(1, k)).into_iter().map(|sum| sum / part).collect()
        };
        self.parts().into_iter().enumerate().map(of).collect()
    }

    /// Returns the share of the aperture's area that each node represents.
    pub fn parts(&self) -> Vec<f64> {
        self.sides[1].iter().flat_map(|(_, b)| self.sides[0].iter().map(move |(_, a)| a * b)).collect()
    }

    /// Returns the values at the nodes that fit, by least squares, a luminance of 1 on convex pieces of the aperture
    /// and 0 elsewhere. `pieces`: corners of the pieces in the room's frame \[m\].
    pub fn lit(&self, pieces: &[Vec<DVec3>]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        // Exact for the polynomials' degrees together and one more.
        let rule = gauss_legendre(self.sides[0].len().max(self.sides[1].len()) + 1);
        for piece in pieces {
            let flat = |corner: &DVec3| {
                let to = self.aperture.surface.facade_from_room(*corner - self.aperture.corner);
                DVec2::new(to.x / self.aperture.size[0], to.y / self.aperture.size[1])
            };
            let corners: Vec<DVec2> = piece.iter().map(flat).collect();
            for pair in corners.get(1..).unwrap_or_default().windows(2) {
                let (a, b, c) = (corners[0], pair[0], pair[1]);
                let twice = (b - a).perp_dot(c - a).abs();
                for (s, t, weight) in rule.iter().flat_map(|(s, ws)| rule.iter().map(move |(t, wt)| (*s, *t, ws * wt)))
                {
                    let point = a + s * (b - a) + s * t * (c - b);
                    self.add_values(point.to_array(), twice * s * weight, &mut sums);
                }
            }
        }
        // The Lagrange polynomials of the Gauss points are orthogonal.
        sums.iter().zip(self.parts()).map(|(sum, part)| sum / part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;

    fn nodes(long: usize, short: usize) -> Nodes {
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [3.0, 1.8] };
        Nodes::new(&aperture, long, short)
    }

    /// Nodes in the room frame. \[m\]
    fn places(nodes: &Nodes) -> Vec<DVec3> {
        let [u, v] = [0, 1].map(|axis| {
            let along = if axis == 0 { DVec3::X } else { DVec3::Y };
            nodes.aperture.size[axis] * nodes.aperture.surface.room_from_facade(along)
        });
        let row = |(y, _): &(f64, f64)| {
            let y = *y;
            nodes.sides[0].iter().map(move |(x, _)| nodes.aperture.corner + *x * u + y * v)
        };
        nodes.sides[1].iter().flat_map(row).collect()
    }

    /// Value at a place of the light that the nodes stand for.
    fn at(nodes: &Nodes, light: &[f64], place: [f64; 2]) -> f64 {
        let mut values = vec![0.0; nodes.count()];
        nodes.add_values(place, 1.0, &mut values);
        values.iter().zip(light).map(|(value, light)| value * light).sum()
    }

    #[test]
    fn polynomials_are_what_they_are_between_the_nodes() {
        let nodes = nodes(4, 3);
        let light = |p: DVec3| 3.0 + p.x * p.x * p.x - 0.3 * p.z * p.z + 0.2 * p.x * p.x * p.z;
        let values: Vec<f64> = places(&nodes).into_iter().map(light).collect();
        for place in [[0.1, 0.2], [0.5, 0.9], [0.8, 0.0], [1.0, 1.0]] {
            let exact = light(DVec3::new(0.5 + 3.0 * place[0], 0.0, 0.9 + 1.8 * place[1]));
            assert!((at(&nodes, &values, place) - exact).abs() < 1e-9);
            assert!((at(&nodes, &vec![1.0; nodes.count()], place) - 1.0).abs() < 1e-12);
        }
        assert!((nodes.parts().iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn lit_pieces_keep_their_flux_and_moments() {
        for nodes in [nodes(6, 4), nodes(3, 3)] {
            let [a, b, c, d] = nodes.aperture.corners();
            for from_grid in nodes.of_grid(&Grid::of(&nodes.aperture)) {
                assert!((from_grid.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            }
            let whole = nodes.lit(&[vec![a, b, c, d]]);
            assert!(whole.iter().all(|light| (light - 1.0).abs() < 1e-12), "{whole:?}");
            // Below a diagonal.
            let light = nodes.lit(&[vec![a, b, c]]);
            let moment = |power: i32| {
                let count = 300;
                let mut sum = 0.0;
                for (i, k) in (0..count).flat_map(|i| (0..count).map(move |k| (i, k))) {
                    let place = [i, k].map(|k| (f64::from(k) + 0.5) / f64::from(count));
                    sum += at(&nodes, &light, place) * place[0].powi(power);
                }
                sum / f64::from(count * count)
            };
            for (power, exact) in [(0, 1.0 / 2.0), (1, 1.0 / 3.0), (2, 1.0 / 4.0)] {
                assert!((moment(power) - exact).abs() < 1e-4, "{power}: {}", moment(power));
            }
        }
    }
}
