//! Displacement interpolation (McCann 1997; Bonneel et al. 2011) of the sharp parts: each cut into clusters of equal
//! flux, clusters of neighbouring directions paired by optimal transport, and each moved to the weighted mean of its
//! partners. Bases are blended.
//!
//! Robust where lobes have no names, but it moves flux between lobes whose shares change. Pairs are made between two
//! directions at a time and are the same from either side, so that triangles agree on their edges.

use super::between::Between;
use super::blend::{Blend, Shape};
use crate::compute::incidence::model::Model;
use glam::{DQuat, DVec3};

/// Cuts in two; 2⁶ = 64 clusters an indicatrix. An exact plan between two of them takes some tenths of a millisecond.
const CUTS: usize = 6;

/// A part of an indicatrix that carries 1/64 of its sharp flux.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cluster {
    centre: DVec3,
    /// Standard deviation of the spot that stands for it. \[rad\]
    spread: f64,
}

/// The scheme.
pub(super) fn blend(model: &Model, clusters: &[Vec<Cluster>], between: &Between) -> Blend {
    let mut blend = Blend::default();
    for &(v, w) in &between.used {
        blend.push(Shape::Base(v), DQuat::IDENTITY, w * model.base_flux[v]);
    }
    let sharp: Vec<(usize, f64)> = between.used.iter().copied().filter(|&(v, _)| !clusters[v].is_empty()).collect();
    // plans[i][j]: partner at j of every cluster at i.
    let mut plans = vec![vec![Vec::new(); sharp.len()]; sharp.len()];
    for i in 0..sharp.len() {
        for j in i + 1..sharp.len() {
            let (first, second) = if sharp[i].0 < sharp[j].0 { (i, j) } else { (j, i) };
            let plan = plan(&clusters[sharp[first].0], &clusters[sharp[second].0]);
            let mut back = vec![0; plan.len()];
            plan.iter().enumerate().for_each(|(p, &q)| back[q] = p);
            plans[first][second] = plan;
            plans[second][first] = back;
        }
    }
    for (i, &(v, w)) in sharp.iter().enumerate() {
        let flux: f64 = model.lobes[v].iter().map(|lobe| lobe.flux).sum();
        let share = w * flux / clusters[v].len() as f64;
        for (p, cluster) in clusters[v].iter().enumerate() {
            let mut to = cluster.centre * w;
            for (j, &(n, wn)) in sharp.iter().enumerate().filter(|(j, _)| *j != i) {
                to += clusters[n][plans[i][j][p]].centre * wn;
            }
            let to = if to.length() > 1e-9 { to.normalize_or(cluster.centre) } else { cluster.centre };
            blend.push(Shape::Spot(cluster.spread), DQuat::from_rotation_arc(DVec3::Z, to), share);
        }
    }
    blend
}

/// Clusters of the lobes of one direction; none without lobes.
pub(super) fn clusters(model: &Model, vertex: usize) -> Vec<Cluster> {
    let grid = &*model.grid;
    let points: Vec<Point> = model.lobes[vertex]
        .iter()
        .flat_map(|lobe| lobe.cells(grid))
        .map(|(cell, q)| Point { at: grid.centre[cell], flux: q * grid.projected[cell], cell: grid.solid[cell] })
        .collect();
    let mut out = Vec::new();
    if !points.is_empty() {
        cut(points, CUTS, &mut out);
    }
    out
}

#[derive(Debug, Clone, Copy)]
struct Point {
    at: DVec3,
    flux: f64,
    cell: f64,
}

/// Halves the flux across its widest axis, again and again; a cell on the cut belongs to both sides in part.
fn cut(mut points: Vec<Point>, cuts: usize, out: &mut Vec<Cluster>) {
    let flux: f64 = points.iter().map(|p| p.flux).sum();
    let mean = points.iter().map(|p| p.at * p.flux).sum::<DVec3>() / flux;
    let variance = points.iter().map(|p| (p.at - mean).powf(2.0) * p.flux).sum::<DVec3>() / flux;
    if cuts == 0 {
        let cell = points.iter().map(|p| p.cell * p.flux).sum::<f64>() / flux;
        // A box of width w has w/√12; half the width makes neighbouring spots flow together.
        let spread = (2.25 * 0.5 * variance.element_sum() + 0.09 * cell).sqrt();
        out.push(Cluster { centre: mean.normalize_or(DVec3::Z), spread });
        return;
    }
    let axis = (0..3).max_by(|&a, &b| variance[a].total_cmp(&variance[b])).unwrap_or(0);
    points.sort_by(|a, b| a.at[axis].total_cmp(&b.at[axis]));
    let mut reached = 0.0;
    let mut split = points.len() - 1;
    for (k, p) in points.iter().enumerate() {
        if reached + p.flux >= 0.5 * flux {
            split = k;
            break;
        }
        reached += p.flux;
    }
    let inside = (0.5 * flux - reached).clamp(0.0, points[split].flux);
    let mut second = points.split_off(split);
    let both = second[0];
    points.push(Point { flux: inside, ..both });
    second[0].flux = both.flux - inside;
    points.retain(|p| p.flux > 0.0);
    second.retain(|p| p.flux > 0.0);
    // Rounding may leave one side empty when a single cell holds all: then both are that cell.
    for side in [points, second] {
        cut(if side.is_empty() { vec![Point { flux: 0.5 * flux, ..both }] } else { side }, cuts - 1, out);
    }
}

/// The cheapest one-to-one plan by squared distance.
fn plan(from: &[Cluster], to: &[Cluster]) -> Vec<usize> {
    let n = from.len();
    let cost: Vec<f64> =
        from.iter().flat_map(|a| to.iter().map(move |b| a.centre.distance_squared(b.centre))).collect();
    assignment(&cost, n)
}

/// Column of every row in the cheapest assignment (shortest augmenting paths with potentials, Kuhn–Munkres; n³).
fn assignment(cost: &[f64], n: usize) -> Vec<usize> {
    const FREE: usize = usize::MAX;
    let (mut row_price, mut column_price) = (vec![0.0; n], vec![0.0; n + 1]);
    // Column n is a start that holds the row to be placed.
    let mut row_of = vec![FREE; n + 1];
    let mut before = vec![n; n + 1];
    for row in 0..n {
        row_of[n] = row;
        let mut column = n;
        let mut least = vec![f64::INFINITY; n];
        let mut done = vec![false; n + 1];
        while row_of[column] != FREE {
            done[column] = true;
            let own = row_of[column];
            let (mut step, mut next) = (f64::INFINITY, n);
            for j in 0..n {
                if done[j] {
                    continue;
                }
                let reduced = cost[own * n + j] - row_price[own] - column_price[j];
                if reduced < least[j] {
                    least[j] = reduced;
                    before[j] = column;
                }
                if least[j] < step {
                    step = least[j];
                    next = j;
                }
            }
            for j in 0..=n {
                if done[j] {
                    row_price[row_of[j]] += step;
                    column_price[j] -= step;
                } else if j < n {
                    least[j] -= step;
                }
            }
            column = next;
        }
        while column != n {
            let previous = before[column];
            row_of[column] = row_of[previous];
            column = previous;
        }
    }
    let mut out = vec![0; n];
    for (column, &row) in row_of[..n].iter().enumerate() {
        out[row] = column;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_assignment_is_the_cheapest_of_all() {
        // Against all 720 orders of six, for costs without pattern.
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        fn orders(n: usize) -> Vec<Vec<usize>> {
            if n == 0 {
                return vec![vec![]];
            }
            orders(n - 1).into_iter().flat_map(|o| (0..n).map(move |k| [&o[..k], &[n - 1], &o[k..]].concat())).collect()
        }
        for _ in 0..20 {
            let cost: Vec<f64> = (0..36).map(|_| random()).collect();
            let total = |o: &[usize]| o.iter().enumerate().map(|(i, &j)| cost[i * 6 + j]).sum::<f64>();
            let best = orders(6).iter().map(|o| total(o)).fold(f64::INFINITY, f64::min);
            let found = assignment(&cost, 6);
            assert!((total(&found) - best).abs() < 1e-12);
        }
    }

    #[test]
    fn clusters_carry_equal_flux_and_keep_the_centroid() {
        let points: Vec<Point> = (0..50)
            .map(|k| Point {
                at: DVec3::new(0.01 * f64::from(k), 0.003 * f64::from(k * k % 7), 1.0).normalize(),
                flux: 1.0 + f64::from(k % 5),
                cell: 1e-4,
            })
            .collect();
        let flux: f64 = points.iter().map(|p| p.flux).sum();
        let mean = points.iter().map(|p| p.at * p.flux).sum::<DVec3>() / flux;
        let mut out = Vec::new();
        cut(points, CUTS, &mut out);
        assert_eq!(out.len(), 64);
        let own = out.iter().map(|c| c.centre).sum::<DVec3>() / 64.0;
        assert!((own - mean).length() < 1e-3);
    }
}
