//! Luminance of one face: a smooth part as polynomials on panels, and a constant part by directly reflected sunlight
//! with sharp shadows.

use std::ops::Range;

/// Number of nodes along each side of a panel. Chosen: polynomials of degree 2 ([`lagrange`]); panels are halved where
/// these do not suffice.
const NODES: usize = 3;
/// Points at which a panel's polynomial is checked, as shares of its sides: between its nodes, and outside them on
/// every side. Chosen; nodes are at 0.07, 0.5 and 0.93. Held by the test
/// `panels_stand_close_where_the_light_is_steep_and_are_bounded`.
const TRIES: [[f64; 2]; 5] = [[0.28, 0.73], [0.98, 0.33], [0.36, 0.02], [0.02, 0.62], [0.65, 0.98]];

/// Share of the mean misfit at these points that remains in sums over many points, where positive and negative misfits
/// cancel. Chosen; stated errors with it are held by `tests/scenes/exchange.rs` and the kit of obstructions.
const TRIED_SHARE: f64 = 0.3;

/// Rectangle on a face: lower and upper limit along both axes of its coordinates. \[m\]
pub type Limits = [[f64; 2]; 2];

/// Luminance of a face (of a box, or of the ground) by position: a smooth part on panels, and a part by directly
/// reflected sunlight.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceLight {
    /// Tree of the parts of the face, its root first.
    parts: Vec<Part>,
    /// Luminances at the nodes of all panels. \[cd/m²\]
    values: Vec<f64>,
    /// Luminance by directly reflected sunlight at points from which the whole disc of the sun is visible. \[cd/m²\]
    pub sun: f64,
    /// Relative error of the smooth luminance, in addition to the misfit of panels between their nodes.
    pub error: f64,
}

/// Part of a face in the tree of its panels.
#[derive(Debug, Clone, PartialEq)]
enum Part {
    /// Part of uniform luminance. \[cd/m²\]
    Even(f64),
    /// Part divided by a line across an axis; `sides` are the indices of the two halves.
    Cut { axis: usize, at: f64, sides: [usize; 2] },
    /// Panel: rectangle with `nodes` nodes along each side; `first` is the index of the first of their values, `off`
    /// the mean misfit of its polynomial between them. \[cd/m²\]
    Panel { limits: Limits, nodes: usize, first: usize, off: f64 },
}

/// Part of a face in the tree of its panels, with the range of the values of all panels in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Limits of the part in the coordinates of the face. \[m\]
    pub limits: Limits,
    /// Indices of the two halves of the part in the tree; `None` for a panel.
    pub halves: Option<[usize; 2]>,
    /// Range of the values of the part's panels among those of the face.
    pub values: Range<usize>,
}

/// Panel whose misfit is still to be compared.
struct Open {
    part: usize,
    limits: Limits,
    /// Misfit of the panel's polynomial between the nodes, times its area and weight.
    off: f64,
}

/// Chebyshev's nodes on −1 … 1: √3/2, 0 and −√3/2, the zeros of T₃.
const NODE: f64 = 0.866_025_403_784_438_6;

/// Returns the weights of the values at the three nodes at a position from −1/[`NODE`] to 1/[`NODE`].
fn lagrange(t: f64) -> [f64; NODES] {
    [0.5 * t * (t + 1.0), 1.0 - t * t, 0.5 * t * (t - 1.0)]
}

/// Returns the point within limits at the given shares of their sides.
fn place(limits: &Limits, shares: [f64; 2]) -> [f64; 2] {
    std::array::from_fn(|axis| limits[axis][0] + (limits[axis][1] - limits[axis][0]) * shares[axis])
}

fn area(limits: &Limits) -> f64 {
    limits.iter().map(|[low, high]| high - low).product()
}

/// Returns the interpolation weights of a panel's nodes at a point, separately along both axes.
fn both(limits: &Limits, point: [f64; 2]) -> [[f64; NODES]; 2] {
    std::array::from_fn(|axis| {
        let [low, high] = limits[axis];
        lagrange(((2.0 * point[axis] - low - high) / (NODE * (high - low))).clamp(-1.0 / NODE, 1.0 / NODE))
    })
}

/// Returns the interpolation weights of all nodes of a panel at a point.
fn weights(limits: &Limits, point: [f64; 2]) -> [f64; NODES * NODES] {
    let [along, across] = both(limits, point);
    std::array::from_fn(|k| along[k / NODES] * across[k % NODES])
}

impl FaceLight {
    /// Creates a uniform luminance of the whole face. \[cd/m²\]
    pub fn even(luminance: f64) -> Self {
        Self { parts: vec![Part::Even(luminance)], values: Vec::new(), sun: 0.0, error: 0.0 }
    }

    /// Creates panels with luminance 0 on a face with these limits. `cut`: returns the axis across which and the
    /// coordinate at which a rectangle is divided in two, `None` for a panel; `single`: whether each panel has one
    /// value instead of a polynomial.
    pub fn panelled(limits: Limits, single: bool, cut: &dyn Fn(&Limits) -> Option<(usize, f64)>) -> Self {
        let mut light = Self::even(0.0);
        let mut open = vec![(0, limits)];
        while let Some((part, limits)) = open.pop() {
            match cut(&limits) {
                Some((axis, at)) => open.extend(light.cut(part, limits, axis, at).map(|half| (half.part, half.limits))),
                None => light.make_panel(part, limits, if single { 1 } else { NODES }),
            }
        }
        light
    }

    /// Returns the smooth luminance fitted to that of `measure`, which returns the luminances at points of the face
    /// \[cd/m²\], `NaN` at points that a body covers. The panels with the largest misfit are halved until the total
    /// misfit is at most `relative` times the integral of the luminance, or until there are `most` panels. `weight`:
    /// weight of a point of the face.
    ///
    /// # Errors
    /// Returns the error of `measure`.
    pub fn fitted<E>(
        mut self,
        relative: f64,
        most: usize,
        weight: &dyn Fn([f64; 2]) -> f64,
        mut measure: impl FnMut(&[[f64; 2]]) -> Result<Vec<f64>, E>,
    ) -> Result<Self, E> {
        let panel = |(part, of): (usize, &Part)| match of {
            Part::Panel { limits, .. } => Some(Open { part, limits: *limits, off: 0.0 }),
            Part::Even(_) | Part::Cut { .. } => None,
        };
        let mut fresh: Vec<Open> = self.parts.iter().enumerate().filter_map(panel).collect();
        let mut judged: Vec<Open> = Vec::new();
        loop {
            self.measure(&mut fresh, weight, &mut measure)?;
            judged.append(&mut fresh);
            let off: f64 = judged.iter().map(|panel| panel.off).sum();
            let sum = self.integral(weight);
            if off <= relative * sum || judged.len() >= most {
                return Ok(self.without_former_values());
            }
            let worst = judged.iter().map(|panel| panel.off).fold(0.0, f64::max);
            let room = most - judged.len();
            let (mut bad, mut good): (Vec<Open>, Vec<Open>) =
                judged.into_iter().partition(|panel| panel.off >= 0.4 * worst);
            bad.sort_by(|a, b| b.off.total_cmp(&a.off));
            good.extend(bad.drain(room.min(bad.len())..));
            judged = good;
            for Open { part, limits, .. } in bad {
                let axis = self.bent(part);
                let at = 0.5 * (limits[axis][0] + limits[axis][1]);
                for half in self.cut(part, limits, axis, at) {
                    self.make_panel(half.part, half.limits, NODES);
                    fresh.push(half);
                }
            }
        }
    }

    /// Removes the values of panels that were divided.
    fn without_former_values(mut self) -> Self {
        let all = std::mem::take(&mut self.values);
        for part in &mut self.parts {
            if let Part::Panel { nodes, first, .. } = part {
                let own = *first..*first + *nodes * *nodes;
                *first = self.values.len();
                self.values.extend_from_slice(&all[own]);
            }
        }
        self
    }

    fn make_panel(&mut self, part: usize, limits: Limits, nodes: usize) {
        self.parts[part] = Part::Panel { limits, nodes, first: self.values.len(), off: 0.0 };
        self.values.resize(self.values.len() + nodes * nodes, 0.0);
    }

    fn cut(&mut self, part: usize, limits: Limits, axis: usize, at: f64) -> [Open; 2] {
        let first = self.parts.len();
        self.parts[part] = Part::Cut { axis, at, sides: [first, first + 1] };
        [0, 1].map(|side| {
            let mut limits = limits;
            limits[axis][1 - side] = at;
            self.parts.push(Part::Even(0.0));
            Open { part: first + side, limits, off: 0.0 }
        })
    }

    /// Computes the luminances at the nodes of panels, and the misfit of their polynomials between the nodes.
    fn measure<E>(
        &mut self,
        panels: &mut [Open],
        weight: &dyn Fn([f64; 2]) -> f64,
        measure: &mut impl FnMut(&[[f64; 2]]) -> Result<Vec<f64>, E>,
    ) -> Result<(), E> {
        let mut places = Vec::with_capacity(panels.len() * (NODES * NODES + TRIES.len()));
        for Open { limits, .. } in &*panels {
            places.extend(places_of(limits, NODES));
            places.extend(TRIES.map(|shares| place(limits, shares)));
        }
        let found = measure(&places)?;
        let each = NODES * NODES + TRIES.len();
        for ((panel, found), places) in panels.iter_mut().zip(found.chunks_exact(each)).zip(places.chunks_exact(each)) {
            let (of_nodes, of_tries) = found.split_at(NODES * NODES);
            let values = filled(of_nodes, places);
            let misfit = places[NODES * NODES..].iter().zip(of_tries).filter(|(_, value)| !value.is_nan());
            let misfit = misfit.map(|(point, value)| {
                let own = weights(&panel.limits, *point);
                let own: f64 = own.iter().zip(&values).map(|(w, value)| w * value).sum();
                (own.max(0.0) - value).abs()
            });
            let (sum, free) = misfit.fold((0.0, 0), |(sum, free), misfit| (sum + misfit, free + 1));
            // What bodies cover of a panel emits nothing: it counts in the area, not in the misfit of the rest.
            panel.off = sum / TRIES.len() as f64 * area(&panel.limits) * weight(place(&panel.limits, [0.5; 2]));
            if let Part::Panel { first, off, .. } = &mut self.parts[panel.part] {
                *off = TRIED_SHARE * sum / free.max(1) as f64;
                self.values[*first..*first + NODES * NODES].copy_from_slice(&values);
            }
        }
        Ok(())
    }

    /// Returns the axis along which the luminance of a panel has the larger curvature.
    fn bent(&self, part: usize) -> usize {
        let Part::Panel { first, .. } = self.parts[part] else { return 0 };
        let values = &self.values[first..];
        let second = |a: usize, step: usize| (values[a] - 2.0 * values[a + step] + values[a + 2 * step]).abs();
        let along: f64 = (0..NODES).map(|k| second(k, NODES)).sum();
        let across: f64 = (0..NODES).map(|k| second(NODES * k, 1)).sum();
        usize::from(across > along)
    }

    /// Returns the weighted integral of the panels' luminance over their areas.
    fn integral(&self, weight: &dyn Fn([f64; 2]) -> f64) -> f64 {
        let of = |part: &Part| match part {
            Part::Panel { limits, nodes, first, .. } => {
                let own = &self.values[*first..first + nodes * nodes];
                weight(place(limits, [0.5; 2])) * area(limits) * own.iter().sum::<f64>() / own.len() as f64
            }
            Part::Even(_) | Part::Cut { .. } => 0.0,
        };
        self.parts.iter().map(of).sum()
    }

    /// Returns the mean smooth luminance of the panels, weighted by `weight`, a function of the point on the face.
    /// \[cd/m²\]
    pub fn mean(&self, weight: &dyn Fn([f64; 2]) -> f64) -> f64 {
        let of = |part: &Part| match part {
            Part::Panel { limits, .. } => area(limits) * weight(place(limits, [0.5; 2])),
            Part::Even(_) | Part::Cut { .. } => 0.0,
        };
        let area: f64 = self.parts.iter().map(of).sum();
        if area > 0.0 { self.integral(weight) / area } else { 0.0 }
    }

    /// Returns the number of panels of the face.
    pub fn panels(&self) -> usize {
        self.parts.iter().filter(|part| !matches!(part, Part::Cut { .. })).count()
    }

    /// Returns the positions of the nodes of all panels in the coordinates of the face. \[m\]
    pub fn places(&self) -> Vec<[f64; 2]> {
        let mut places = vec![[0.0; 2]; self.values.len()];
        for part in &self.parts {
            if let Part::Panel { limits, nodes, first, .. } = part {
                places[*first..first + nodes * nodes].copy_from_slice(&places_of(limits, *nodes));
            }
        }
        places
    }

    /// Returns the tree of the panels of a face with these limits: the whole face first, every part before its halves.
    pub fn branches(&self, limits: Limits) -> Vec<Branch> {
        let mut tree: Vec<Branch> = self.parts.iter().map(|_| Branch { limits, halves: None, values: 0..0 }).collect();
        for (index, part) in self.parts.iter().enumerate() {
            match part {
                Part::Even(_) => {}
                Part::Cut { axis, at, sides } => {
                    tree[index].halves = Some(*sides);
                    for (side, half) in sides.iter().enumerate() {
                        tree[*half].limits = tree[index].limits;
                        tree[*half].limits[*axis][1 - side] = *at;
                    }
                }
                Part::Panel { nodes, first, .. } => tree[index].values = *first..first + nodes * nodes,
            }
        }
        // The halves were filled one after the other, so that their values are adjacent.
        for index in (0..tree.len()).rev() {
            if let Some([a, b]) = tree[index].halves {
                let (a, b) = (tree[a].values.clone(), tree[b].values.clone());
                tree[index].values = a.start.min(b.start)..a.end.max(b.end);
            }
        }
        tree
    }

    /// Returns the smooth luminances at the nodes of all panels. \[cd/m²\]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Sets the smooth luminances at the nodes of all panels \[cd/m²\]; a `NaN` is replaced by the value of the nearest
    /// node of its panel that has one, otherwise by 0. The misfit of a panel changes in proportion to its luminance.
    pub fn set(&mut self, values: &[f64]) {
        let places = self.places();
        for part in &mut self.parts {
            if let Part::Panel { nodes, first, off, .. } = part {
                let own = *first..*first + *nodes * *nodes;
                let whole = filled(&values[own.clone()], &places[own.clone()]);
                let before: f64 = self.values[own.clone()].iter().sum();
                *off *= if before > 0.0 { whole.iter().sum::<f64>() / before } else { 1.0 };
                self.values[own].copy_from_slice(&whole);
            }
        }
    }

    /// Returns the part of the tree that contains a point.
    fn part(&self, at: [f64; 2]) -> &Part {
        &self.parts[self.index(at)]
    }

    fn index(&self, at: [f64; 2]) -> usize {
        let mut index = 0;
        while let Part::Cut { axis, at: line, sides } = &self.parts[index] {
            index = sides[usize::from(at[*axis] > *line)];
        }
        index
    }

    /// Calls `visit` with the indices and interpolation weights of the node values that determine the smooth luminance
    /// at a point of the face; not at all outside panels.
    pub fn weigh(&self, at: [f64; 2], mut visit: impl FnMut(usize, f64)) {
        if let Part::Panel { limits, nodes, first, .. } = self.part(at) {
            if *nodes == 1 {
                visit(*first, 1.0);
            } else {
                weights(limits, at).into_iter().enumerate().for_each(|(k, weight)| visit(first + k, weight));
            }
        }
    }

    /// Returns the smooth luminance at a point of the face, given by its coordinates \[m\], and its uncertainty.
    /// \[cd/m²\]
    pub fn at(&self, u: f64, v: f64) -> [f64; 2] {
        self.near(&mut 0, [u, v])
    }

    /// Returns the smooth luminance at a point of the face, given by its coordinates \[m\], and its uncertainty.
    /// \[cd/m²\] `last`: index of the part in which the previous point was found, 0 for the first; it speeds up the
    /// search for points near each other.
    pub fn near(&self, last: &mut usize, at: [f64; 2]) -> [f64; 2] {
        let inside = |limits: &Limits| (0..2).all(|axis| at[axis] > limits[axis][0] && at[axis] < limits[axis][1]);
        if !matches!(&self.parts[*last], Part::Panel { limits, .. } if inside(limits)) {
            *last = self.index(at);
        }
        let (light, off) = match &self.parts[*last] {
            Part::Even(luminance) => (*luminance, 0.0),
            Part::Panel { nodes: 1, first, off, .. } => (self.values[*first], *off),
            Part::Panel { limits, first, off, .. } => {
                let [along, across] = both(limits, at);
                let rows = self.values[*first..].chunks_exact(NODES).zip(along);
                let row = |row: &[f64]| across[0] * row[0] + across[1] * row[1] + across[2] * row[2];
                let light: f64 = rows.map(|(values, weight)| weight * row(values)).sum();
                (light.max(0.0), *off)
            }
            Part::Cut { .. } => (0.0, 0.0),
        };
        [light, off + self.error * light]
    }

    /// Returns the smooth luminance at a point of the face, given by its coordinates \[m\], without its uncertainty.
    /// \[cd/m²\]
    pub fn diffuse(&self, u: f64, v: f64) -> f64 {
        self.at(u, v)[0]
    }

    /// Multiplies all luminances of the face by a factor.
    pub fn scale(&mut self, factor: f64) {
        for part in &mut self.parts {
            match part {
                Part::Even(luminance) | Part::Panel { off: luminance, .. } => *luminance *= factor,
                Part::Cut { .. } => {}
            }
        }
        self.values.iter_mut().for_each(|value| *value *= factor);
        self.sun *= factor;
    }

    /// Whether any luminance of the face is above 0.
    pub fn is_lit(&self) -> bool {
        let shines = |part: &Part| matches!(part, Part::Even(luminance) if *luminance > 0.0);
        self.sun > 0.0 || self.values.iter().any(|value| *value > 0.0) || self.parts.iter().any(shines)
    }
}

/// Returns the positions of the nodes of a rectangle, `count` along each side. \[m\]
fn places_of(limits: &Limits, count: usize) -> Vec<[f64; 2]> {
    if count == 1 {
        return vec![place(limits, [0.5; 2])];
    }
    let along = [NODE, 0.0, -NODE];
    let both = along.iter().flat_map(|x| along.iter().map(move |y| [0.5 + 0.5 * x, 0.5 + 0.5 * y]));
    both.map(|shares| place(limits, shares)).collect()
}

/// Returns the values at some points, with each `NaN` replaced by the value of the nearest point that has one.
fn filled(values: &[f64], places: &[[f64; 2]]) -> Vec<f64> {
    let square = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
    let known = || (0..values.len()).filter(|k| !values[*k].is_nan());
    let nearest =
        |k: usize| known().min_by(|a, b| square(places[*a], places[k]).total_cmp(&square(places[*b], places[k])));
    (0..values.len())
        .map(|k| if values[k].is_nan() { nearest(k).map_or(0.0, |near| values[near]) } else { values[k] })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn fitted(lines: [Vec<f64>; 2], most: usize, f: impl Fn(f64, f64) -> f64) -> FaceLight {
        let measure = |places: &[[f64; 2]]| Ok::<_, Infallible>(places.iter().map(|[u, v]| f(*u, *v)).collect());
        let limits = lines.each_ref().map(|lines| [lines[0], lines[lines.len() - 1]]);
        let cut = |panel: &Limits| {
            let inside = |axis: usize, line: &&f64| **line > panel[axis][0] && **line < panel[axis][1];
            (0..2).find_map(|axis| lines[axis].iter().find(|line| inside(axis, line)).map(|line| (axis, *line)))
        };
        let start = FaceLight::panelled(limits, false, &cut);
        start.fitted(2e-3, most, &|_| 1.0, measure).unwrap_or_else(|never| match never {})
    }

    #[test]
    fn parabolas_are_met_everywhere() {
        let f = |u: f64, v: f64| 3.0 + u - 0.2 * u * u + v * (1.0 + 0.1 * v) + 0.05 * u * v;
        let light = fitted([vec![0.0, 1.0, 4.0], vec![-1.0, 2.0]], 9, f);
        for (u, v) in [(0.0, -1.0), (0.3, 0.0), (1.0, 1.9), (2.5, 2.0), (4.0, 0.1)] {
            assert!((light.diffuse(u, v) - f(u, v)).abs() < 1e-12, "{u} {v}");
        }
        assert!(light.panels() == 2 && light.at(0.3, 0.0)[1] < 1e-12);
        assert_eq!(FaceLight::even(7.0).diffuse(3.0, 3.0), 7.0);
    }

    #[test]
    fn panels_stand_close_where_the_light_is_steep_and_are_bounded() {
        // Falls off within 0.2 of the rim u = 0.
        let f = |u: f64, v: f64| 5.0 + v - 4.0 * (-u / 0.2).exp();
        let light = fitted([vec![0.0, 4.0], vec![0.0, 2.0]], 40, f);
        assert!(light.panels() > 3 && light.panels() < 12, "{}", light.panels());
        assert_eq!(light.places().len(), NODES * NODES * light.panels(), "values of panels that are no more");
        let mean_off = (0..400).map(|k| (f64::from(k % 20), f64::from(k / 20))).map(|(i, j)| {
            let (u, v) = (0.2 * i + 0.1, 0.1 * j + 0.05);
            (light.diffuse(u, v) - f(u, v)).abs() / 2400.0
        });
        let mean_off: f64 = mean_off.sum();
        assert!(mean_off < 4e-3, "{mean_off}");
        // A jump that no panel can meet ends at the bound, and says what it costs.
        let light = fitted([vec![0.0, 1.0], vec![0.0, 1.0]], 10, |u, v| f64::from(u + v > 1.1));
        let [_, error] = light.at(0.55, 0.55);
        assert!(light.panels() == 10 && error > 0.01, "{} {error}", light.panels());
    }

    #[test]
    fn what_is_covered_takes_nothing_from_the_misfit_of_the_rest() {
        // Visible above v = 0.9 alone, where one of the points between the nodes lies, and is off by 1.
        let f = |_: f64, v: f64| if v < 0.9 { f64::NAN } else { 1.0 + f64::from(v > 0.95) };
        let [light, error] = fitted([vec![0.0, 1.0], vec![0.0, 1.0]], 1, f).at(0.5, 0.92);
        assert!((light - 1.0).abs() < 1e-12 && (error - TRIED_SHARE).abs() < 1e-12, "{light} {error}");
    }
}
