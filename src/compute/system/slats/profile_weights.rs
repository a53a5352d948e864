//! Distribution of the directions of a cell over the profile angle ψ.
//!
//! With direction cosines (x, y, z), tanψ = y/z, projected solid angle is dx dy; on a line of constant ψ y = √(1 − x²)
//! sinψ, so that dx dy = √(1 − x²) dx · cosψ dψ. A part of width t (perpendicular to it) of a parallel beam of profile
//! angle ψ carries the share t/(s cosψ) of the light on one pitch s: cosψ cancels, and a cell's mean of such a share is
//! (1/s PΩ) ∫ t(ψ) D(ψ) dψ with D(ψ) = ∫ √(1 − x²) dx over the cell's part of the line. D has a closed form.

use crate::compute::basis::{Cell, RingBasis};
use crate::compute::quadrature::gauss_legendre;
use std::f64::consts::{FRAC_PI_2, PI};

/// Grid of profile angles (nodes) from −90° to 90° in equal steps, both ends included; functions are linear between
/// nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ProfileGrid {
    steps: usize,
}

impl ProfileGrid {
    /// Creates a grid with at most the given step. \[rad\]
    pub(super) fn new(step: f64) -> Self {
        // Even, so that ψ = 0 is a node.
        Self { steps: 2 * (FRAC_PI_2 / step - 1e-9).ceil().max(1.0) as usize }
    }

    /// Returns the number of nodes.
    pub(super) const fn len(self) -> usize {
        self.steps + 1
    }

    /// Returns the step between two nodes. \[rad\]
    pub(super) fn step(self) -> f64 {
        PI / self.steps as f64
    }

    /// Returns the profile angle of a node. \[rad\]
    pub(super) fn psi(self, node: usize) -> f64 {
        // From the middle, so that opposite nodes are opposite to the last bit.
        (node as f64 - 0.5 * self.steps as f64) * self.step()
    }

    /// Returns the integral over ψ of a node's hat function (1 at the node, 0 at its neighbours). \[rad\]
    pub(super) fn hat(self, node: usize) -> f64 {
        if node == 0 || node == self.steps { 0.5 * self.step() } else { self.step() }
    }

    /// Returns the index of the node below a profile angle \[rad\], and the weight of the node above in linear
    /// interpolation.
    pub(super) fn place(self, psi: f64) -> (usize, f64) {
        let at = (psi / self.step() + 0.5 * self.steps as f64).clamp(0.0, self.steps as f64);
        let node = (at as usize).min(self.steps - 1);
        (node, at - node as f64)
    }
}

/// Returns ∫₀ˣ √(1 − x²) dx.
pub(super) fn primitive(x: f64) -> f64 {
    0.5 * (x * (1.0 - x * x).max(0.0).sqrt() + x.asin())
}

/// Part of a cell inside one quadrant of the direction cosines (x, y), stored as its mirror image in the first
/// quadrant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    theta: [f64; 2],
    phi: [f64; 2],
    /// Sign of x in the part's quadrant.
    pub(super) right: f64,
    /// Sign of y, and thus of ψ, in the part's quadrant.
    pub(super) up: f64,
}

impl Piece {
    /// Returns the parts, one per quadrant, of the region between two polar angles `theta` whose azimuths lie within
    /// half of `width` about `phi` (façade frame). \[rad\]
    fn split(theta: [f64; 2], phi: f64, width: f64) -> Vec<Self> {
        let (from, to) = (phi - 0.5 * width, phi + 0.5 * width);
        let first = (from / FRAC_PI_2 + 1e-9).floor() as i64;
        let last = (to / FRAC_PI_2 - 1e-9).floor() as i64;
        (first..=last)
            .map(|quadrant| {
                let start = quadrant as f64 * FRAC_PI_2;
                let (low, high) = ((from - start).clamp(0.0, FRAC_PI_2), (to - start).clamp(0.0, FRAC_PI_2));
                let (phi, right, up) = match quadrant.rem_euclid(4) {
                    0 => ([low, high], 1.0, 1.0),
                    1 => ([FRAC_PI_2 - high, FRAC_PI_2 - low], -1.0, 1.0),
                    2 => ([low, high], -1.0, -1.0),
                    _ => ([FRAC_PI_2 - high, FRAC_PI_2 - low], 1.0, -1.0),
                };
                Self { theta, phi, right, up }
            })
            .collect()
    }

    /// Returns the parts of a cell, one per quadrant that it reaches into.
    pub(super) fn of(cell: &Cell) -> Vec<Self> {
        Self::split([cell.theta_min, cell.theta_max.min(FRAC_PI_2)], cell.phi, cell.width)
    }

    /// Returns the parts, one per quadrant, of the overlap of two cells.
    pub(super) fn shared(a: &Cell, b: &Cell) -> Vec<Self> {
        let theta = [a.theta_min.max(b.theta_min), a.theta_max.min(b.theta_max).min(FRAC_PI_2)];
        if theta[1] - theta[0] < 1e-12 {
            return vec![];
        }
        let mut list = vec![];
        let separation = (b.phi - a.phi + PI).rem_euclid(2.0 * PI) - PI;
        // A sector of more than half a turn may be met from both sides.
        for turn in [-2.0 * PI, 0.0, 2.0 * PI] {
            let low = (-0.5 * a.width).max(separation + turn - 0.5 * b.width);
            let high = (0.5 * a.width).min(separation + turn + 0.5 * b.width);
            if high - low > 1e-12 {
                list.extend(Self::split(theta, a.phi + 0.5 * (low + high), high - low));
            }
        }
        list
    }

    /// Returns the interval of |x| that the part covers on the line of constant |ψ| = `psi` \[rad\]; `None` where the
    /// line misses the part.
    pub(super) fn across(&self, psi: f64) -> Option<[f64; 2]> {
        let (sine, cosine) = psi.sin_cos();
        let ring = |theta: f64| {
            let square = (theta - psi).sin() * (theta + psi).sin();
            if cosine > 0.0 { square.max(0.0).sqrt() / cosine } else { 1.0 }
        };
        let wedge = |phi: f64| if sine > 0.0 { sine / sine.hypot(phi.tan()) } else { f64::from(phi <= 0.0) };
        if psi > self.theta[1] {
            return None;
        }
        let low = ring(self.theta[0]).max(if self.phi[1] >= FRAC_PI_2 - 1e-12 { 0.0 } else { wedge(self.phi[1]) });
        let high = ring(self.theta[1]).min(wedge(self.phi[0])).min(1.0);
        (high > low).then_some([low, high])
    }

    /// Returns the values of |ψ| \[rad\] between which D(ψ) of the module head is smooth, rising; the first and the
    /// last are the limits of the part.
    pub(super) fn knots(&self) -> Vec<f64> {
        let at = |theta: f64, phi: f64| (theta.sin() * phi.sin()).atan2(theta.cos());
        let mut knots = vec![];
        for theta in self.theta {
            for phi in self.phi {
                knots.push(at(theta, phi));
            }
        }
        knots.sort_by(f64::total_cmp);
        knots.dedup_by(|a, b| (*a - *b).abs() < 1e-13);
        knots
    }

    /// Calls `f(ψ, D dψ)` at the points of a quadrature over the part, for functions that are smooth between its knots
    /// and the further knots `more` (signed ψ \[rad\], in any order); square-root behaviour at the ends of the part is
    /// accounted for.
    pub(super) fn integrate(&self, rule: &[(f64, f64)], more: &[f64], mut f: impl FnMut(f64, f64)) {
        let own = self.knots();
        let (Some(&first), Some(&last)) = (own.first(), own.last()) else { return };
        let mut knots = own;
        knots.extend(more.iter().map(|psi| psi * self.up).filter(|psi| *psi > first && *psi < last));
        knots.sort_by(f64::total_cmp);
        for pair in knots.windows(2) {
            let width = pair[1] - pair[0];
            if width < 1e-14 {
                continue;
            }
            for &(u, weight) in rule {
                // ψ = a + (b − a) sin²(πu/2) smooths square roots at the ends.
                let (sine, cosine) = (FRAC_PI_2 * u).sin_cos();
                let psi = pair[0] + width * sine * sine;
                if let Some([low, high]) = self.across(psi) {
                    let density = primitive(high) - primitive(low);
                    f(self.up * psi, weight * PI * sine * cosine * width * density);
                }
            }
        }
    }
}

/// Weights ∫ hat(ψ) D(ψ) dψ of the nodes of the profile angle for every cell of a basis; only a few nodes per cell have
/// one.
#[derive(Debug, Clone)]
pub(super) struct ProfileWeights {
    /// First node and the weights from it on, by cell. \[sr\], since ∫ D cosψ dψ is the projected solid angle.
    rows: Vec<(usize, Vec<f64>)>,
}

impl ProfileWeights {
    /// Computes the weights of all cells of a basis on a grid of profile angles.
    pub(super) fn new(basis: &RingBasis, grid: ProfileGrid) -> Self {
        let rule = gauss_legendre(6);
        let rows = basis.cells().map(|cell| Self::row(&cell, grid, &rule)).collect();
        Self { rows }
    }

    /// Computes the first node with a weight and all weights of one cell; `rule`: nodes and weights of the quadrature.
    fn row(cell: &Cell, grid: ProfileGrid, rule: &[(f64, f64)]) -> (usize, Vec<f64>) {
        let pieces = Piece::of(cell);
        let range = |piece: &Piece| {
            let knots = piece.knots();
            let (low, high) = (piece.up * knots[0], piece.up * knots[knots.len() - 1]);
            (low.min(high), low.max(high))
        };
        let low = pieces.iter().map(|p| range(p).0).fold(FRAC_PI_2, f64::min);
        let high = pieces.iter().map(|p| range(p).1).fold(-FRAC_PI_2, f64::max);
        let (first, last) = (grid.place(low).0, grid.place(high).0 + 1);
        let mut row = vec![0.0; last - first + 1];
        let nodes: Vec<f64> = (first..=last).map(|node| grid.psi(node)).collect();
        for piece in pieces {
            piece.integrate(rule, &nodes, |psi, weight| {
                let (node, above) = grid.place(psi);
                let at = node.clamp(first, last - 1) - first;
                row[at] += weight * (1.0 - above);
                row[at + 1] += weight * above;
            });
        }
        (first, row)
    }

    /// Returns the first node that has a weight for the cell `index`, and its weights from there on. \[sr\]
    pub(super) fn cell(&self, index: usize) -> (usize, &[f64]) {
        let (first, row) = &self.rows[index];
        (*first, row)
    }

    /// Returns the number of cells of the basis.
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;

    #[test]
    fn weights_hold_the_projected_solid_angle() {
        for basis in [RingBasis::klems_full(AzimuthMap::KLEMS_FRONT), RingBasis::tregenza(), RingBasis::hemisphere()] {
            for cell in basis.cells() {
                let mut sum = 0.0;
                for piece in Piece::of(&cell) {
                    piece.integrate(&gauss_legendre(12), &[], |psi, weight| sum += weight * psi.cos());
                }
                assert!((sum - cell.projected_solid_angle()).abs() < 1e-8, "{cell:?}: {sum}");
            }
        }
    }

    #[test]
    fn weights_of_all_cells_make_the_hemisphere() {
        let grid = ProfileGrid::new(0.5_f64.to_radians());
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let weights = ProfileWeights::new(&basis, grid);
        let mut sum = vec![0.0; grid.len()];
        for cell in 0..basis.len() {
            let (first, row) = weights.cell(cell);
            for (k, w) in row.iter().enumerate() {
                sum[first + k] += w;
            }
        }
        for (node, sum) in sum.iter().enumerate() {
            // The whole line has D = π/2.
            assert!((sum - FRAC_PI_2 * grid.hat(node)).abs() < 1e-6, "{node}: {sum}");
        }
    }

    #[test]
    fn shared_parts_add_up_to_the_cell() {
        let (a, b) = (RingBasis::tregenza(), RingBasis::klems_full(AzimuthMap::KLEMS_FRONT));
        for cell in a.cells() {
            let mut sum = 0.0;
            for other in b.cells() {
                for piece in Piece::shared(&cell, &other) {
                    piece.integrate(&gauss_legendre(12), &[], |psi, weight| sum += weight * psi.cos());
                }
            }
            assert!((sum - cell.projected_solid_angle()).abs() < 1e-8, "{cell:?}: {sum}");
        }
    }
}
