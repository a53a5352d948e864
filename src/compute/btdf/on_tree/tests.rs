//! Trees made of other functions against closed forms: constants, energy, axes, rotation, the stated error.

use super::*;
use crate::compute::basis::AzimuthMap;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::btdf::CellMatrix;
use crate::compute::direction::{Dir, Facade};

fn shape(rank: TreeRank, level: u32, tolerance: f64) -> TreeShape {
    TreeShape { rank, level, tolerance }
}

fn direction(theta_deg: f64, phi_deg: f64) -> Dir<Facade> {
    Dir::from_theta_phi(theta_deg.to_radians(), phi_deg.to_radians())
}

/// Returns a function without any symmetry, τ below 1.
fn uneven(map: AzimuthMap) -> Btdf {
    let basis = RingBasis::klems_quarter(map);
    let n = basis.len();
    let values = (0..n * n).map(|k| 0.02 * ((k * 7 + (k / n) * 13) % 11) as f64).collect();
    Btdf::from_cells(CellMatrix::new(basis.clone(), basis, values).unwrap())
}

#[test]
fn a_diffuser_is_one_leaf() {
    let half = Btdf { regular: None, scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(0.5))) };
    let four = tree_on(&half, TreeAxes::Front, shape(TreeRank::Four, 4, 0.0)).unwrap();
    assert_eq!(four.tree.leaves(), 1);
    assert!((four.tree.tau_hemispherical() - 0.5).abs() < 1e-10);
    // Rank 3 keeps its root, of whose children four lie in the unused half.
    let three = tree_on(&half, TreeAxes::Front, shape(TreeRank::Three, 4, 0.0)).unwrap();
    assert_eq!(three.tree.leaves(), 8);
    assert!((three.tree.tau_hemispherical() - 0.5).abs() < 1e-12 && three.turned < 1e-12);
}

#[test]
fn every_incident_cell_keeps_its_flux_and_cells_their_values() {
    for (axes, map) in [(TreeAxes::Front, AzimuthMap::KLEMS_FRONT), (TreeAxes::Back, AzimuthMap::KLEMS_BACK)] {
        let source = uneven(map);
        let made = tree_on(&source, axes, shape(TreeRank::Four, 5, 0.0)).unwrap();
        let grid = made.tree.incident_grid();
        assert_eq!(grid.resolution(), 32);
        for (cell, tau) in grid.cells().zip(made.tree.tau_by_cell()) {
            let mean = cell.samples(16).map(|d| source.tau(Incident(d))).sum::<f64>() / 256.0;
            assert!((tau - mean).abs() < 1e-9, "{axes:?} {tau} {mean}");
        }
        assert!((made.tree.tau_hemispherical() - source.tau_hemispherical()).abs() < 2e-4);
        // Far from all borders of cells the values are the source's, up to the scale that keeps the flux.
        let basis = RingBasis::klems_quarter(map);
        let mut inside = 0;
        for (i, o) in (0..basis.len()).flat_map(|i| (0..basis.len()).map(move |o| (i, o))) {
            let (from, out) = (basis.cell(i).centre(), basis.cell(o).centre());
            let alone = |d: Dir<Facade>, k: usize| {
                grid.cell(grid.index(d).unwrap()).samples(8).all(|d| basis.index(d) == Some(k))
            };
            if alone(from, i) && alone(out, o) {
                inside += 1;
                let (from, out) = (Incident(from), Emergent::from_undeviated(out));
                let (a, b) = (made.tree.q(from, out), source.q(from, out));
                assert!((a - b).abs() <= 0.01 * b, "{axes:?} {i} {o}: {a} {b}");
            }
        }
        assert!(inside > 400, "{inside}");
    }
}

#[test]
fn merging_misplaces_no_more_light_than_stated() {
    let source = uneven(AzimuthMap::KLEMS_FRONT);
    let full = tree_on(&source, TreeAxes::Front, shape(TreeRank::Four, 4, 0.0)).unwrap().tree;
    let mut leaves = full.leaves();
    for tolerance in [0.003, 0.03, 0.2] {
        let made = tree_on(&source, TreeAxes::Front, shape(TreeRank::Four, 4, tolerance)).unwrap();
        // Computed again from the values of both trees at the centres of all boxes.
        let grid = SquareGrid::new(4).unwrap();
        let (mut apart, mut all) = (0.0, 0.0);
        for (i, o) in grid.cells().flat_map(|i| grid.cells().map(move |o| (i, o))) {
            let (from, out) = (Incident(i.centre()), Emergent::from_undeviated(o.centre()));
            apart += (made.tree.q(from, out) - full.q(from, out)).abs();
            all += full.q(from, out);
        }
        assert!((apart / all - made.misplaced).abs() < 1e-9, "{} {}", apart / all, made.misplaced);
        assert!(made.misplaced <= tolerance && made.misplaced > 0.3 * tolerance, "{tolerance}: {}", made.misplaced);
        assert!((made.tree.tau_hemispherical() / full.tau_hemispherical() - 1.0).abs() < 1e-12);
        assert!(made.tree.leaves() < leaves);
        leaves = made.tree.leaves();
        let change = grid.cells().map(|cell| {
            let from = Incident(cell.centre());
            (made.tree.tau(from) - full.tau(from)).abs()
        });
        assert!((change.fold(0.0, f64::max) - made.tau_change).abs() < 1e-12);
    }
}

#[test]
fn straight_light_goes_straight_on() {
    let pane = Btdf { regular: Some(AngularTransmittance::Constant(0.8)), scattered: None };
    let sun = direction(37.0, 71.0);
    let near = Emergent::from_undeviated(sun);
    let four = tree_on(&pane, TreeAxes::Back, shape(TreeRank::Four, 4, 0.0)).unwrap().tree;
    assert!((four.tau(Incident(sun)) - 0.8).abs() < 1e-12);
    assert!((four.q(Incident(sun), near) * PI / 256.0 - 0.8).abs() < 1e-12);
    let three = tree_on(&pane, TreeAxes::Back, shape(TreeRank::Three, 4, 0.0)).unwrap().tree;
    assert!((three.tau(Incident(sun)) - 0.8).abs() < 1e-12);
    // Half in the cell on either side of the plane of incidence.
    for phi in [70.0, 72.0] {
        let out = Emergent::from_undeviated(direction(37.0, phi));
        assert!((three.q(Incident(sun), out) * PI / 256.0 - 0.4).abs() < 1e-12);
    }
}

#[test]
fn a_turning_tree_stays_one_through_rank_4_and_back() {
    // q that depends on θ alone on both sides is what every rank can say.
    let basis = RingBasis::equal_area(8);
    let n = basis.len();
    let ring = |k: usize| basis.cell(k).theta();
    let values: Vec<f64> = (0..n * n).map(|k| 0.1 + 0.1 * ring(k / n).cos() * ring(k % n).cos()).collect();
    let source = Btdf::from_cells(CellMatrix::new(basis.clone(), basis.clone(), values).unwrap());
    let three = tree_on(&source, TreeAxes::Front, shape(TreeRank::Three, 4, 0.0)).unwrap();
    assert!(three.turned < 1e-9, "{}", three.turned);
    let as_btdf = |tree: TensorTree| Btdf { regular: None, scattered: Some(Scattered::Tree(Box::new(tree))) };
    let four = tree_on(&as_btdf(three.tree.clone()), TreeAxes::Front, shape(TreeRank::Four, 4, 0.0)).unwrap();
    let again = tree_on(&as_btdf(four.tree.clone()), TreeAxes::Front, shape(TreeRank::Three, 4, 0.0)).unwrap();
    for (theta_in, theta_out, phi) in [(10.0, 20.0, 30.0), (50.0, 62.0, 210.0), (75.0, 5.0, 100.0)] {
        let (from, out) = (Incident(direction(theta_in, 77.0)), Emergent::from_undeviated(direction(theta_out, phi)));
        let want = source.q(from, out);
        for tree in [&three.tree, &four.tree, &again.tree] {
            assert!((tree.q(from, out) / want - 1.0).abs() < 1e-6, "{} {want}", tree.q(from, out));
        }
    }
    // For data that are not rotationally symmetric, `turned` states by how much.
    assert!(
        tree_on(&uneven(AzimuthMap::KLEMS_FRONT), TreeAxes::Front, shape(TreeRank::Three, 4, 0.0)).unwrap().turned
            > 0.1
    );
}

#[test]
fn other_axes_are_the_same_function_and_equal_shapes_are_kept() {
    let made = tree_on(&uneven(AzimuthMap::KLEMS_FRONT), TreeAxes::Front, shape(TreeRank::Four, 3, 0.0)).unwrap().tree;
    let other = made.with_axes(TreeAxes::Back);
    for (a, b) in [((20.0, 33.0), (40.0, 200.0)), ((63.0, 310.0), (8.0, 100.0))] {
        let (from, out) = (Incident(direction(a.0, a.1)), Emergent::from_undeviated(direction(b.0, b.1)));
        assert_eq!(made.q(from, out), other.q(from, out));
    }
    assert_eq!(other.with_axes(TreeAxes::Front), made);
    let btdf = Btdf { regular: None, scattered: Some(Scattered::Tree(Box::new(made.clone()))) };
    assert_eq!(tree_on(&btdf, TreeAxes::Front, shape(TreeRank::Four, 5, 0.0)).unwrap().tree, made);
    // On a coarser grid leaves become means: the flux stays.
    let coarse = tree_on(&btdf, TreeAxes::Front, shape(TreeRank::Four, 2, 0.0)).unwrap().tree;
    assert_eq!(coarse.incident_resolution(), 4);
    assert!((coarse.tau_hemispherical() / made.tau_hemispherical() - 1.0).abs() < 1e-12);
}

#[test]
fn what_cannot_be_is_refused() {
    let source = uneven(AzimuthMap::KLEMS_FRONT);
    let with =
        |level, tolerance| tree_on(&source, TreeAxes::Front, shape(TreeRank::Four, level, tolerance)).unwrap_err();
    assert!(with(0, 0.0).to_string().contains("1 … 6"));
    assert!(with(7, 0.0).to_string().contains("level 7"));
    assert!(with(3, f64::NAN).to_string().contains("tolerance"));
    assert!(with(3, -0.1).to_string().contains("tolerance"));
}
