//! The luminance of one face: smooth light from sky and ground in panels of polynomials, the sun's as a constant with
//! sharp shadows.

use std::f64::consts::PI;

/// Nodes along each side of a panel.
const NODES: usize = 3;
/// Of a panel, places at which its polynomial is tried, as shares of its sides: between its nodes, and beyond them on
/// every side.
const TRIES: [[f64; 2]; 5] = [[0.28, 0.73], [0.98, 0.33], [0.36, 0.02], [0.02, 0.62], [0.65, 0.98]];

/// Light of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceLight {
    /// A tree, its root first.
    parts: Vec<Part>,
    /// Luminance that the whole disc of the sun adds where nothing hides it. \[cd/m²\]
    pub sun: f64,
    /// How far the smooth light may be off, relative to its mean.
    pub error: f64,
}

/// A part of a face.
#[derive(Debug, Clone, PartialEq)]
enum Part {
    /// The same luminance all over. \[cd/m²\]
    Even(f64),
    /// Two parts on both sides of a line across an axis.
    Cut { axis: usize, at: f64, sides: [usize; 2] },
    /// A rectangle with its luminance at the nodes. \[cd/m²\]
    Panel { limits: [[f64; 2]; 2], values: [f64; NODES * NODES] },
}

/// A panel that is still to be judged.
struct Open {
    part: usize,
    limits: [[f64; 2]; 2],
    /// How far its polynomial is off between the nodes, times its area.
    off: f64,
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

/// Places within limits by shares of their sides.
fn place(limits: &[[f64; 2]; 2], shares: [f64; 2]) -> [f64; 2] {
    std::array::from_fn(|axis| limits[axis][0] + (limits[axis][1] - limits[axis][0]) * shares[axis])
}

fn area(limits: &[[f64; 2]; 2]) -> f64 {
    limits.iter().map(|[low, high]| high - low).product()
}

/// A panel's polynomial at a point.
fn polynomial(limits: &[[f64; 2]; 2], values: &[f64; NODES * NODES], point: [f64; 2]) -> f64 {
    let nodes = nodes();
    let [along, across] = std::array::from_fn(|axis| {
        let [low, high] = limits[axis];
        lagrange(&nodes, ((2.0 * point[axis] - low - high) / (high - low)).clamp(-1.0, 1.0))
    });
    let rows = values.chunks_exact(NODES).zip(along);
    rows.map(|(row, w)| w * row.iter().zip(across).map(|(value, w)| w * value).sum::<f64>()).sum::<f64>().max(0.0)
}

impl FaceLight {
    /// The same luminance all over. \[cd/m²\]
    pub fn even(luminance: f64) -> Self {
        Self { parts: vec![Part::Even(luminance)], sun: 0.0, error: 0.0 }
    }

    /// Smooth light, fitted to what `measure` finds at places \[cd/m²\]: panels between `lines` (along both axes, rising,
    /// with the face's limits), the worst of them halved until their polynomials are off by no more than `relative` of
    /// the mean, or there are `most`. Its error is what they are off by between their nodes.
    ///
    /// # Errors
    /// Those of `measure`.
    pub fn fitted<E>(
        lines: &[Vec<f64>; 2],
        relative: f64,
        most: usize,
        mut measure: impl FnMut(&[[f64; 2]]) -> Result<Vec<f64>, E>,
    ) -> Result<Self, E> {
        let whole = [0, 1].map(|axis| [lines[axis][0], lines[axis][lines[axis].len() - 1]]);
        let mut light = Self { parts: vec![Part::Even(0.0)], sun: 0.0, error: 0.0 };
        let mut fresh = Vec::new();
        light.cut_along(0, whole, lines, &mut fresh);
        let mut judged: Vec<Open> = Vec::new();
        loop {
            light.measure(&mut fresh, &mut measure)?;
            judged.append(&mut fresh);
            let off: f64 = judged.iter().map(|panel| panel.off).sum();
            let sum = light.integral();
            light.error = if sum > 0.0 { off / sum } else { 0.0 };
            if off <= relative * sum || judged.len() >= most {
                return Ok(light);
            }
            let worst = judged.iter().map(|panel| panel.off).fold(0.0, f64::max);
            let room = most - judged.len();
            let (mut bad, mut good): (Vec<Open>, Vec<Open>) =
                judged.into_iter().partition(|panel| panel.off >= 0.4 * worst);
            bad.sort_by(|a, b| b.off.total_cmp(&a.off));
            good.extend(bad.drain(room.min(bad.len())..));
            judged = good;
            for Open { part, limits, .. } in bad {
                let axis = light.bent(part);
                let at = 0.5 * (limits[axis][0] + limits[axis][1]);
                light.cut(part, limits, axis, at, &mut fresh);
            }
        }
    }

    /// Cuts a part along all lines that run through it.
    fn cut_along(&mut self, part: usize, limits: [[f64; 2]; 2], lines: &[Vec<f64>; 2], fresh: &mut Vec<Open>) {
        for axis in [0, 1] {
            let [low, high] = limits[axis];
            let inner: Vec<f64> = lines[axis].iter().copied().filter(|line| *line > low && *line < high).collect();
            if !inner.is_empty() {
                let mut halves = Vec::new();
                self.cut(part, limits, axis, inner[inner.len() / 2], &mut halves);
                for half in halves {
                    self.cut_along(half.part, half.limits, lines, fresh);
                }
                return;
            }
        }
        fresh.push(Open { part, limits, off: 0.0 });
    }

    fn cut(&mut self, part: usize, limits: [[f64; 2]; 2], axis: usize, at: f64, fresh: &mut Vec<Open>) {
        let first = self.parts.len();
        self.parts[part] = Part::Cut { axis, at, sides: [first, first + 1] };
        for side in [0, 1] {
            let mut limits = limits;
            limits[axis][1 - side] = at;
            self.parts.push(Part::Even(0.0));
            fresh.push(Open { part: first + side, limits, off: 0.0 });
        }
    }

    /// Values at the nodes of panels, and how far they are off between them.
    fn measure<E>(
        &mut self,
        panels: &mut [Open],
        measure: &mut impl FnMut(&[[f64; 2]]) -> Result<Vec<f64>, E>,
    ) -> Result<(), E> {
        let nodes = nodes();
        let mut places = Vec::with_capacity(panels.len() * (NODES * NODES + TRIES.len()));
        for Open { limits, .. } in &*panels {
            for (x, _) in nodes {
                places.extend(nodes.map(|(y, _)| place(limits, [0.5 + 0.5 * x, 0.5 + 0.5 * y])));
            }
            places.extend(TRIES.map(|shares| place(limits, shares)));
        }
        let found = measure(&places)?;
        for (panel, found) in panels.iter_mut().zip(found.chunks_exact(NODES * NODES + TRIES.len())) {
            let values: [f64; NODES * NODES] = std::array::from_fn(|k| found[k]);
            let tries = TRIES.iter().zip(&found[NODES * NODES..]);
            let misfit = tries.map(|(shares, value)| {
                (polynomial(&panel.limits, &values, place(&panel.limits, *shares)) - value).abs()
            });
            panel.off = misfit.sum::<f64>() / TRIES.len() as f64 * area(&panel.limits);
            self.parts[panel.part] = Part::Panel { limits: panel.limits, values };
        }
        Ok(())
    }

    /// The axis along which a panel is bent more.
    fn bent(&self, part: usize) -> usize {
        let Part::Panel { values, .. } = &self.parts[part] else { return 0 };
        let second = |a: usize, step: usize| (values[a] - 2.0 * values[a + step] + values[a + 2 * step]).abs();
        let along: f64 = (0..NODES).map(|k| second(k, NODES)).sum();
        let across: f64 = (0..NODES).map(|k| second(NODES * k, 1)).sum();
        usize::from(across > along)
    }

    /// ∫ of the panels' light over their areas.
    fn integral(&self) -> f64 {
        let of = |part: &Part| match part {
            Part::Panel { limits, values } => area(limits) * values.iter().sum::<f64>() / values.len() as f64,
            Part::Even(_) | Part::Cut { .. } => 0.0,
        };
        self.parts.iter().map(of).sum()
    }

    /// How many panels it has.
    pub fn panels(&self) -> usize {
        self.parts.iter().filter(|part| !matches!(part, Part::Cut { .. })).count()
    }

    /// Smooth light at a point by its coordinates on the face. \[cd/m²\]
    pub fn diffuse(&self, u: f64, v: f64) -> f64 {
        let mut at_part = 0;
        loop {
            match &self.parts[at_part] {
                Part::Even(luminance) => return *luminance,
                Part::Cut { axis, at, sides } => at_part = sides[usize::from([u, v][*axis] > *at)],
                Part::Panel { limits, values } => return polynomial(limits, values, [u, v]),
            }
        }
    }

    /// All light times a factor.
    pub fn scale(&mut self, factor: f64) {
        for part in &mut self.parts {
            match part {
                Part::Even(luminance) => *luminance *= factor,
                Part::Panel { values, .. } => values.iter_mut().for_each(|value| *value *= factor),
                Part::Cut { .. } => {}
            }
        }
        self.sun *= factor;
    }

    /// Is there any light?
    pub fn is_lit(&self) -> bool {
        let shines = |part: &Part| match part {
            Part::Even(luminance) => *luminance > 0.0,
            Part::Panel { values, .. } => values.iter().any(|value| *value > 0.0),
            Part::Cut { .. } => false,
        };
        self.sun > 0.0 || self.parts.iter().any(shines)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn fitted(lines: [Vec<f64>; 2], most: usize, f: impl Fn(f64, f64) -> f64) -> FaceLight {
        let measure = |places: &[[f64; 2]]| Ok::<_, Infallible>(places.iter().map(|[u, v]| f(*u, *v)).collect());
        FaceLight::fitted(&lines, 2e-3, most, measure).unwrap_or_else(|never| match never {})
    }

    #[test]
    fn parabolas_are_met_everywhere() {
        let f = |u: f64, v: f64| 3.0 + u - 0.2 * u * u + v * (1.0 + 0.1 * v) + 0.05 * u * v;
        let light = fitted([vec![0.0, 1.0, 4.0], vec![-1.0, 2.0]], 9, f);
        for (u, v) in [(0.0, -1.0), (0.3, 0.0), (1.0, 1.9), (2.5, 2.0), (4.0, 0.1)] {
            assert!((light.diffuse(u, v) - f(u, v)).abs() < 1e-12, "{u} {v}");
        }
        assert!(light.panels() == 2 && light.error < 1e-12);
        assert_eq!(FaceLight::even(7.0).diffuse(3.0, 3.0), 7.0);
    }

    #[test]
    fn panels_stand_close_where_the_light_is_steep_and_are_bounded() {
        // Falls off within 0.2 of the rim u = 0.
        let f = |u: f64, v: f64| 5.0 + v - 4.0 * (-u / 0.2).exp();
        let light = fitted([vec![0.0, 4.0], vec![0.0, 2.0]], 40, f);
        assert!(light.panels() > 3 && light.panels() < 12 && light.error <= 2e-3, "{} {}", light.panels(), light.error);
        let mean_off = (0..400).map(|k| (f64::from(k % 20), f64::from(k / 20))).map(|(i, j)| {
            let (u, v) = (0.2 * i + 0.1, 0.1 * j + 0.05);
            (light.diffuse(u, v) - f(u, v)).abs() / 2400.0
        });
        let mean_off: f64 = mean_off.sum();
        assert!(mean_off < 4e-3, "{mean_off}");
        // A jump that no panel can meet ends at the bound, and says what it costs.
        let light = fitted([vec![0.0, 1.0], vec![0.0, 1.0]], 10, |u, v| f64::from(u + v > 1.1));
        assert!(light.panels() == 10 && light.error > 0.01, "{} {}", light.panels(), light.error);
    }
}
