//! The luminance of one face: smooth light from sky and ground in panels of polynomials, the sun's as a constant with
//! sharp shadows.

use std::f64::consts::PI;

/// Nodes along each side of a panel.
pub const NODES: usize = 3;

/// Light of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceLight {
    /// Borders of the panels along both axes; empty where the luminance is the same all over. \[m\]
    lines: [Vec<f64>; 2],
    /// At the nodes of every panel, panel by panel; one value where it is the same all over. \[cd/m²\]
    values: Vec<f64>,
    /// Luminance that the whole disc of the sun adds where nothing hides it. \[cd/m²\]
    pub sun: f64,
    /// How far the smooth light may be off, relative.
    pub error: f64,
}

/// Chebyshev's nodes on −1 … 1 with their barycentric weights.
fn nodes() -> [(f64, f64); NODES] {
    std::array::from_fn(|k| {
        let angle = (2 * k + 1) as f64 * PI / (2 * NODES) as f64;
        (angle.cos(), if k % 2 == 0 { angle.sin() } else { -angle.sin() })
    })
}

/// Weights of the nodes' values at a place of −1 … 1.
fn lagrange(nodes: &[(f64, f64); NODES], x: f64) -> [f64; NODES] {
    if let Some(at) = nodes.iter().position(|(node, _)| (x - node).abs() < 1e-12) {
        return std::array::from_fn(|k| if k == at { 1.0 } else { 0.0 });
    }
    let terms: [f64; NODES] = std::array::from_fn(|k| nodes[k].1 / (x - nodes[k].0));
    let sum: f64 = terms.iter().sum();
    terms.map(|term| term / sum)
}

/// The panel that holds a coordinate, and where in it, −1 … 1.
fn place(lines: &[f64], x: f64) -> (usize, f64) {
    let panel = lines.partition_point(|line| *line <= x).clamp(1, lines.len() - 1) - 1;
    let (from, to) = (lines[panel], lines[panel + 1]);
    (panel, ((2.0 * x - from - to) / (to - from)).clamp(-1.0, 1.0))
}

impl FaceLight {
    /// The same luminance all over. \[cd/m²\]
    pub fn even(luminance: f64) -> Self {
        Self { lines: [Vec::new(), Vec::new()], values: vec![luminance], sun: 0.0, error: 0.0 }
    }

    /// The places at which [`Self::with_panels`] wants values, panel by panel.
    pub fn places(lines: &[Vec<f64>; 2]) -> Vec<[f64; 2]> {
        let nodes = nodes();
        let at = |pair: &[f64], x: f64| 0.5 * (pair[0] + pair[1]) + 0.5 * (pair[1] - pair[0]) * x;
        let mut places = Vec::new();
        for one in lines[0].windows(2) {
            for two in lines[1].windows(2) {
                for (x, _) in nodes {
                    places.extend(nodes.map(|(y, _)| [at(one, x), at(two, y)]));
                }
            }
        }
        places
    }

    /// Smooth light by its values at [`Self::places`].
    pub fn with_panels(lines: [Vec<f64>; 2], values: Vec<f64>, sun: f64, error: f64) -> Self {
        Self { lines, values, sun, error }
    }

    /// Smooth light at a point by its coordinates on the face. \[cd/m²\]
    pub fn diffuse(&self, u: f64, v: f64) -> f64 {
        if self.lines[0].is_empty() {
            return self.values[0];
        }
        let nodes = nodes();
        let ((i, x), (j, y)) = (place(&self.lines[0], u), place(&self.lines[1], v));
        let first = (i * (self.lines[1].len() - 1) + j) * NODES * NODES;
        let (along, across) = (lagrange(&nodes, x), lagrange(&nodes, y));
        let rows = self.values[first..first + NODES * NODES].chunks_exact(NODES);
        let sum: f64 =
            rows.zip(along).map(|(row, w)| w * row.iter().zip(across).map(|(value, w)| w * value).sum::<f64>()).sum();
        sum.max(0.0)
    }

    /// All light times a factor.
    pub fn scale(&mut self, factor: f64) {
        self.values.iter_mut().for_each(|value| *value *= factor);
        self.sun *= factor;
    }

    /// Is there any light?
    pub fn is_lit(&self) -> bool {
        self.sun > 0.0 || self.values.iter().any(|value| *value > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_are_met_everywhere() {
        let f = |u: f64, v: f64| 3.0 + u - 0.2 * u * u + v * (1.0 + 0.1 * v) + 0.05 * u * v;
        let lines = [vec![0.0, 1.0, 4.0], vec![-1.0, 2.0]];
        let values = FaceLight::places(&lines).into_iter().map(|[u, v]| f(u, v)).collect();
        let light = FaceLight::with_panels(lines, values, 0.0, 0.0);
        for (u, v) in [(0.0, -1.0), (0.3, 0.0), (1.0, 1.9), (2.5, 2.0), (4.0, 0.1)] {
            assert!((light.diffuse(u, v) - f(u, v)).abs() < 1e-12, "{u} {v}");
        }
        assert_eq!(FaceLight::even(7.0).diffuse(3.0, 3.0), 7.0);
    }
}
