//! The compact form against a tensor tree of the same data, both quantised and entropy-coded, at equal error of the
//! illuminance in the standard room.

#[path = "compact/analytic.rs"]
mod analytic;
#[path = "compact/tree.rs"]
mod tree;

use cfs::compute::btdf::Indicatrices;
use cfs::compute::wavelet::Criterion;
use cfs::formats::compact_rows;
use cfs::study::compact::{StandardRoom, standard_outsides};

/// Mean over overcast sky and three suns of Σ|ΔE| / ΣE. Suns that the system shuts out have no say.
fn illuminance_error(
    room: &StandardRoom,
    data: &Indicatrices,
    before: impl Fn(usize) -> Vec<f64>,
    after: impl Fn(usize) -> Vec<f64>,
) -> f64 {
    let cells = data.lattice().unwrap();
    let rows: Vec<Option<usize>> = (0..cells.len()).map(Some).collect();
    let luminance = |row: &dyn Fn(usize) -> Vec<f64>, light: &[(usize, f64)]| {
        let mut sum: Vec<f64> = vec![];
        for &(i, e) in light {
            let row = row(i);
            sum.resize(row.len(), 0.0);
            sum.iter_mut().zip(row).for_each(|(l, q)| *l += q * e);
        }
        sum
    };
    let effects: Vec<f64> = standard_outsides(cells, &rows, |d| data.standing_for(d))
        .iter()
        .map(|(name, light)| {
            room.effect(name.clone(), &luminance(&before, light), &luminance(&after, light)).illuminance
        })
        .filter(|change| *change > 0.0)
        .collect();
    effects.iter().sum::<f64>() / effects.len().max(1) as f64
}

/// (error, bytes) pairs along a ladder of thresholds → bytes at an error, log-log between neighbours.
fn bytes_at(ladder: &[(f64, f64)], error: f64) -> Option<f64> {
    let mut sorted = ladder.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let pair = sorted.windows(2).find(|pair| pair[0].0 <= error && error <= pair[1].0)?;
    let t = (error / pair[0].0).ln() / (pair[1].0 / pair[0].0).ln().max(1e-12);
    Some((pair[0].1.ln() * (1.0 - t) + pair[1].1.ln() * t).exp())
}

#[test]
fn smaller_than_a_tensor_tree_at_equal_illuminance_error() {
    println!("{:<12}{:>10}{:>14}{:>14}{:>8}", "system", "error", "tree bytes", "compact bytes", "ratio");
    for (name, noise) in analytic::NAMES.iter().map(|n| (*n, 0.0)).chain([("redirect", 0.02), ("diffuser", 0.02)]) {
        let data = analytic::system(name, 2.5, noise);
        let room = StandardRoom::new(data.emergent());
        let ours: Vec<(f64, f64)> = [0.0005, 0.001, 0.002, 0.004, 0.008, 0.015, 0.03, 0.06, 0.12]
            .iter()
            .map(|threshold| {
                let made = data.compacted(Criterion::Misplaced(*threshold)).unwrap();
                let bytes = compact_rows::write(made.compact_rows().unwrap()).len();
                let row = |i| data.row(i).into_owned();
                (illuminance_error(&room, &data, row, |i| made.row(i).into_owned()), bytes as f64)
            })
            .collect();
        let grid = tree::Grid::of(&data);
        let tree_room = StandardRoom::new(&grid.rings());
        let full = |i: usize| grid.row_on_rings(&grid.values, i);
        let trees: Vec<(f64, f64)> = grid
            .ladder()
            .into_iter()
            .map(|(values, bytes)| {
                (illuminance_error(&tree_room, &data, full, |i| grid.row_on_rings(&values, i)), bytes as f64)
            })
            .collect();
        println!("  {name} {noise} ours {ours:?}\n  trees {trees:?}");
        for error in [0.0003, 0.001, 0.003, 0.01] {
            if let (Some(a), Some(b)) = (tree::best_at(&trees, error), bytes_at(&ours, error)) {
                println!("{:<12}{:>9.2}%{a:>14.0}{b:>14.0}{:>8.2}", name, 100.0 * error, a / b);
            }
        }
    }
}
