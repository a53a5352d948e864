//! Trees against closed forms: constants, single leaves, energy, reciprocity, rotation.

use super::super::tensor_reversal::build_isotropic;
use super::*;
use crate::compute::basis::disk_from_square;

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 40) as f64 / (1u64 << 24) as f64
}

/// A random tree of uneven depth.
fn tree(rank: TreeRank, axes: TreeAxes, seed: u64) -> TensorTree {
    fn grow(rank: TreeRank, place: usize, level: u32, nodes: &mut Vec<TreeNode>, seed: &mut u64) {
        if level == 4 || (level > 0 && random(seed) < 0.6) {
            nodes[place] = TreeNode::Leaf(0.3 * random(seed));
            return;
        }
        let start = nodes.len();
        nodes[place] = TreeNode::Branch(start as u32);
        nodes.extend(vec![TreeNode::Leaf(0.0); rank.children()]);
        for child in 0..rank.children() {
            grow(rank, start + child, level + 1, nodes, seed);
        }
    }
    let (mut nodes, mut seed) = (vec![TreeNode::Leaf(0.0)], seed);
    grow(rank, 0, 0, &mut nodes, &mut seed);
    TensorTree::new(rank, axes, nodes).unwrap()
}

fn all() -> Vec<TensorTree> {
    let mut list = Vec::new();
    for rank in [TreeRank::Three, TreeRank::Four] {
        for axes in [TreeAxes::Front, TreeAxes::Back] {
            list.push(tree(rank, axes, 7));
        }
    }
    list
}

fn direction(theta_deg: f64, phi_deg: f64) -> Dir<Facade> {
    Dir::from_theta_phi(theta_deg.to_radians(), phi_deg.to_radians())
}

#[test]
fn a_constant_tree_is_a_diffuser() {
    for rank in [TreeRank::Three, TreeRank::Four] {
        let tree = TensorTree::new(rank, TreeAxes::Front, vec![TreeNode::Leaf(0.5 / PI)]).unwrap();
        assert!((tree.tau_hemispherical() - 0.5).abs() < 1e-14);
        assert!((tree.tau(Incident(direction(40.0, 10.0))) - 0.5).abs() < 1e-14);
        let (basis, l) = tree.luminance(&vec![250.0; tree.incident_grid().len()]);
        assert_eq!(basis.len(), l.len());
        assert!(l.iter().all(|l| (l - 1000.0 * 0.5 / PI).abs() < 1e-9));
    }
}

#[test]
fn tau_is_the_integral_of_q() {
    for tree in all() {
        let emergent = SquareGrid::new(6).unwrap();
        for (theta, phi) in [(3.0, 20.0), (37.0, 200.0), (71.0, 303.0)] {
            let incident = Incident(direction(theta, phi));
            let sum: f64 =
                emergent.cells().map(|cell| tree.q(incident, Emergent::from_undeviated(cell.centre()))).sum();
            let sum = sum * emergent.projected_solid_angle();
            // Rank 3 squares are turned against the sampling grid, so their borders are cut by it.
            let tolerance = if tree.rank() == TreeRank::Four { 1e-12 } else { 5e-3 };
            assert!((sum - tree.tau(incident)).abs() < tolerance, "{:?} {sum}", tree.rank());
            let shown = tree.indicatrix(incident);
            let tau: f64 = shown.basis.projected_solid_angles().iter().zip(&shown.q).map(|(w, q)| w * q).sum();
            assert!((tau - tree.tau(incident)).abs() < 1e-12);
        }
    }
}

#[test]
fn luminances_carry_the_flux_that_tau_says() {
    for tree in all() {
        let mut seed = 3;
        let e: Vec<f64> = (0..tree.incident_grid().len()).map(|_| 100.0 * random(&mut seed)).collect();
        let (basis, l) = tree.luminance(&e);
        let flux: f64 = basis.projected_solid_angles().iter().zip(&l).map(|(w, l)| w * l).sum();
        let expected: f64 = tree.tau_by_cell().iter().zip(&e).map(|(tau, e)| tau * e).sum();
        // Rings share cells on a rank 3 tree's frame exactly, so both must close to rounding.
        assert!((flux / expected - 1.0).abs() < 1e-12, "{flux} {expected}");
        let mean = tree.tau_by_cell().iter().sum::<f64>() / e.len() as f64;
        assert!((mean - tree.tau_hemispherical()).abs() < 1e-12);
    }
}

#[test]
fn light_of_one_cell_goes_where_q_says() {
    for tree in all() {
        let grid = tree.incident_grid();
        let source = grid.cell(grid.len() / 2 + grid.resolution() / 2 + 5);
        let mut e = vec![0.0; grid.len()];
        e[source.position()[1] * grid.resolution() + source.position()[0]] = 100.0;
        let (basis, l) = tree.luminance(&e);
        // Compare the flux into quarters of the hemisphere (edges of the quarters are cell edges of every ring).
        for quarter in 0..4 {
            let in_quarter = |phi: f64| (phi / (0.5 * PI)) as usize == quarter;
            let flux: f64 = basis
                .cells()
                .zip(&l)
                .filter(|(cell, _)| in_quarter(cell.phi))
                .map(|(cell, l)| l * cell.projected_solid_angle())
                .sum();
            let fine = SquareGrid::new(7).unwrap();
            let mut expected = 0.0;
            for incident in source.samples(6) {
                for cell in fine.cells().filter(|cell| in_quarter(cell.centre().phi())) {
                    let q = tree.q(Incident(incident), Emergent::from_undeviated(cell.centre()));
                    expected += q * 100.0 / 36.0 * fine.projected_solid_angle();
                }
            }
            let total = 100.0 * tree.tau(Incident(source.centre()));
            // Straightened borders move little: 1/16 of a quarter's flux at the innermost ring.
            assert!((flux - expected).abs() < 0.04 * total, "{:?} {quarter}: {flux} {expected}", tree.rank());
        }
    }
}

#[test]
fn reversing_a_rank_4_tree_exchanges_the_directions() {
    for axes in [TreeAxes::Front, TreeAxes::Back] {
        let tree = tree(TreeRank::Four, axes, 11);
        let back = tree.reversed();
        let (a, b) = (direction(33.0, 77.0), direction(61.0, 250.0));
        let q = tree.q(Incident(a), Emergent::from_undeviated(b));
        assert_eq!(back.q(Incident(b), Emergent::from_undeviated(a)), q);
        assert!((back.tau_hemispherical() - tree.tau_hemispherical()).abs() < 1e-12);
        assert!(back.reversed().relative_difference(&tree).unwrap() < 1e-15);
        assert!(back.relative_difference(&tree).unwrap() > 0.01);
    }
}

#[test]
fn reversing_a_rank_3_tree_keeps_smooth_functions() {
    // q depends on both sines and on the relative azimuth: its transpose is known in closed form.
    let q =
        |r_in: f64, r_out: f64, turn: f64| 0.2 * (1.0 + r_in * r_in) * (1.0 + r_out) * (1.0 + 0.5 * r_out * turn.cos());
    let side = 1.0 / 32.0;
    let mean = |corner: [usize; 3]| {
        let at = |d: usize| (corner[d] as f64 + 0.5) * side;
        let [x, y] = disk_from_square([at(1), at(2)]);
        q(1.0 - 2.0 * at(0), x.hypot(y), y.atan2(x))
    };
    let mut nodes = vec![TreeNode::Leaf(0.0)];
    build_isotropic(5, [0; 3], 0, 16, &mean, &mut nodes);
    let tree = TensorTree::new(TreeRank::Three, TreeAxes::Back, nodes).unwrap();
    let front = tree.reversed();
    assert!((front.tau_hemispherical() - tree.tau_hemispherical()).abs() < 1e-12);
    for (a, b) in [(direction(20.0, 30.0), direction(50.0, 100.0)), (direction(65.0, 300.0), direction(35.0, 10.0))] {
        // The tree's azimuths run against the façade's.
        let turn = -(b.phi() - a.phi());
        let got = tree.q(Incident(a), Emergent::from_undeviated(b));
        let expected = q(a.theta().sin(), b.theta().sin(), turn);
        assert!((got / expected - 1.0).abs() < 0.1, "{got} {expected}");
        let got = front.q(Incident(b), Emergent::from_undeviated(a));
        assert!((got / expected - 1.0).abs() < 0.1, "{got} {expected}");
    }
}

#[test]
fn a_rank_3_tree_turns_with_the_light() {
    let tree = tree(TreeRank::Three, TreeAxes::Front, 5);
    for turn in [10.0, 123.0, 290.0] {
        let q = |by: f64| {
            tree.q(Incident(direction(40.0, 15.0 + by)), Emergent::from_undeviated(direction(52.0, 222.0 + by)))
        };
        assert_eq!(q(turn), q(0.0));
    }
}

#[test]
fn bad_lists_are_refused() {
    let new = |nodes| TensorTree::new(TreeRank::Three, TreeAxes::Front, nodes);
    assert_eq!(new(vec![]), Err(TreeError::Empty));
    assert_eq!(new(vec![TreeNode::Branch(0)]), Err(TreeError::Children(0)));
    assert_eq!(new(vec![TreeNode::Branch(1)]), Err(TreeError::Children(0)));
    assert_eq!(new(vec![TreeNode::Leaf(f64::NAN)]), Err(TreeError::Value(0)));
    // Every branch stands first among its siblings.
    let mut nodes = vec![TreeNode::Branch(1)];
    for level in 0..12_u32 {
        nodes.push(if level < 11 { TreeNode::Branch((level + 1) * 8 + 1) } else { TreeNode::Leaf(0.0) });
        nodes.extend([TreeNode::Leaf(0.0); 7]);
    }
    assert_eq!(new(nodes), Err(TreeError::Depth));
}
