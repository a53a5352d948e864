//! Iso-lines of values on a regular grid (such as illuminances on the work plane), by marching squares, joined to
//! polylines. Pure.

use super::colours::ColourScale;
use super::ticks::logarithmic;
use std::collections::HashMap;

/// Iso-line: line of constant value in a grid. Coordinates are in grid steps: x is the column and y the row of a node,
/// both from 0.
#[derive(Debug, Clone, PartialEq)]
pub struct IsoLine {
    /// Points (column, row) in order along the line \[grid steps\]; for a closed line the first is not repeated.
    pub points: Vec<[f64; 2]>,
    /// Whether the line returns to its first point.
    pub closed: bool,
}

/// Edge of the grid: from node (column, row) to the right (false) or upwards (true).
type Edge = (usize, usize, bool);

/// Returns all lines on which the gridded quantity has the value `level`. `values` holds `nx` · `ny` nodes, x running
/// fastest. Squares with a node that is not finite are left out; saddles are decided by the mean of their four nodes.
pub fn iso_lines(nx: usize, ny: usize, values: &[f64], level: f64) -> Vec<IsoLine> {
    if nx < 2 || ny < 2 || values.len() != nx * ny {
        return vec![];
    }
    let at = |i: usize, j: usize| values[j * nx + i];
    let mut links: HashMap<Edge, Vec<Edge>> = HashMap::new();
    for j in 0..ny - 1 {
        for i in 0..nx - 1 {
            let corner = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if corner.iter().any(|v| !v.is_finite()) {
                continue;
            }
            // Edge k lies between corner k and k + 1.
            let edges: [Edge; 4] = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
            let above = corner.map(|v| v >= level);
            let crossed: Vec<usize> = (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).collect();
            let mut link = |a: usize, b: usize| {
                links.entry(edges[a]).or_default().push(edges[b]);
                links.entry(edges[b]).or_default().push(edges[a]);
            };
            match crossed[..] {
                [a, b] => link(a, b),
                [_, _, _, _] => {
                    // Corners 0 and 2 are joined when the middle is on their side.
                    let middle = corner.iter().sum::<f64>() / 4.0 >= level;
                    if middle == above[0] {
                        link(0, 1);
                        link(2, 3);
                    } else {
                        link(3, 0);
                        link(1, 2);
                    }
                }
                _ => {}
            }
        }
    }
    let point = |(i, j, up): Edge| {
        let (a, b) = (at(i, j), if up { at(i, j + 1) } else { at(i + 1, j) });
        let t = if a == b { 0.5 } else { ((level - a) / (b - a)).clamp(0.0, 1.0) };
        if up { [i as f64, j as f64 + t] } else { [i as f64 + t, j as f64] }
    };
    trace(links)
        .into_iter()
        .map(|(edges, closed)| IsoLine { points: edges.into_iter().map(point).collect(), closed })
        .collect()
}

/// Joins links between edges of the grid to chains, and tells for each whether it is closed: open chains from their
/// ends first, then the remaining ones as loops.
fn trace(mut links: HashMap<Edge, Vec<Edge>>) -> Vec<(Vec<Edge>, bool)> {
    let mut starts: Vec<Edge> = links.keys().copied().collect();
    // A fixed order, so that labels do not jump; ends (one link) before inner points (two).
    starts.sort_unstable();
    starts.sort_by_key(|edge| links[edge].len());
    let mut chains = vec![];
    for start in starts {
        if links.get(&start).is_none_or(Vec::is_empty) {
            continue;
        }
        let mut chain = vec![start];
        let mut here = start;
        while let Some(next) = links.get_mut(&here).and_then(Vec::pop) {
            if let Some(back) = links.get_mut(&next)
                && let Some(k) = back.iter().position(|edge| *edge == here)
            {
                back.swap_remove(k);
            }
            if next == start {
                chains.push((std::mem::take(&mut chain), true));
                break;
            }
            chain.push(next);
            here = next;
        }
        if !chain.is_empty() {
            chains.push((chain, false));
        }
    }
    chains
}

/// Returns round illuminances for iso-lines, strictly between the smallest and the largest of `totals`, few enough to
/// be distinguished, and with the levels that standards demand. \[lx\]
pub fn iso_levels(scale: &ColourScale, totals: &[f64]) -> Vec<f64> {
    let (min, max) = totals.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), v| (a.min(*v), b.max(*v)));
    if min >= max || totals.is_empty() {
        return vec![];
    }
    // Illuminances fall off steeply with depth: 1-2-5 steps even on a linear scale, with 300 lx among them.
    let mut levels = logarithmic(min.max(scale.hi * 1e-3), max, 9);
    for level in ASKED_FOR {
        if min < level && max > level && !levels.contains(&level) {
            levels.push(level);
        }
    }
    levels.retain(|level| *level > min && *level < max);
    levels
}

/// Illuminances that standards demand at workplaces; iso-lines of these levels always have a label. \[lx\]
pub const ASKED_FOR: [f64; 2] = [300.0, 500.0];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colours::ColourMap;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn field(nx: usize, ny: usize, f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        (0..nx * ny).map(|k| f((k % nx) as f64, (k / nx) as f64)).collect()
    }

    #[test]
    fn a_cone_gives_one_circle() {
        let values = field(41, 41, |x, y| (x - 20.0).hypot(y - 20.0));
        let lines = iso_lines(41, 41, &values, 12.3);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].closed);
        let points = &lines[0].points;
        let length: f64 = (0..points.len())
            .map(|i| {
                let (a, b) = (points[i], points[(i + 1) % points.len()]);
                (a[0] - b[0]).hypot(a[1] - b[1])
            })
            .sum();
        assert!((length / (2.0 * PI * 12.3) - 1.0).abs() < 3e-3, "{length}");
    }

    #[test]
    fn a_saddle_and_a_hole() {
        // Two peaks at the left-lower and right-upper node: by the mean (0.5 ≥ 0.4) the ridge joins them.
        let lines = iso_lines(2, 2, &[1.0, 0.0, 0.0, 1.0], 0.4);
        assert_eq!(lines.len(), 2);
        assert!(lines.iter().all(|line| !line.closed && line.points.len() == 2));
        let mut values = field(5, 5, |x, _| x);
        values[12] = f64::NAN;
        let lines = iso_lines(5, 5, &values, 1.5);
        assert_eq!(lines.len(), 2);
        assert!(iso_lines(1, 5, &[0.0; 5], 0.0).is_empty());
    }

    #[test]
    fn levels_lie_inside_the_data() {
        let totals: Vec<f64> = (1..100).map(|k| 20.0 * f64::from(k)).collect();
        let scale = ColourScale::up_to(2000.0, false, 2, ColourMap::Sequential);
        let levels = iso_levels(&scale, &totals);
        assert!(levels.contains(&300.0) && levels.contains(&500.0));
        assert!(levels.iter().all(|l| *l > 20.0 && *l < 1980.0));
        assert!(iso_levels(&scale, &[5.0, 5.0]).is_empty());
    }

    proptest! {
        #[test]
        fn a_plane_is_met_exactly(a in -2.0..2.0_f64, b in 0.1..2.0_f64, level in -3.0..12.0_f64) {
            let values = field(9, 7, |x, y| a * x + b * y);
            for line in iso_lines(9, 7, &values, level) {
                prop_assert!(!line.closed);
                for [x, y] in &line.points {
                    prop_assert!((a * x + b * y - level).abs() < 1e-9);
                }
            }
        }
    }
}
