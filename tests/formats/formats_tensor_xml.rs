//! Tensor trees as BSDF XML: trees that are read and written again, and functions of other forms made into trees.

use crate::common::data;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{
    AngularTransmittance, Band, Btdf, CellMatrix, Component, Dataset, Scattered, TensorTree, TreeNode, TreeRank,
};
use cfs::compute::direction::{Dir, Incident};
use cfs::formats::bsdf_xml::{TreeForm, rank_of, read, write, write_tree};
use std::path::PathBuf;

fn tree(btdf: &Btdf) -> &TensorTree {
    let (None, Some(Scattered::Tree(tree))) = (&btdf.regular, &btdf.scattered) else { panic!("a tree") };
    tree
}

/// Every function that is no derived one: same branches, leaves within the tolerance of round trips.
fn same_trees(before: &Dataset, after: &Dataset) -> usize {
    let mut leaves = 0;
    for (a, b) in [(Some(&before.visible), Some(&after.visible)), (before.solar.as_ref(), after.solar.as_ref())] {
        let (Some(a), Some(b)) = (a, b) else {
            assert!(a.is_none() && b.is_none());
            continue;
        };
        assert_eq!(a.components(), b.components());
        for component in a.components().into_iter().filter(|component| !before.derived.contains(component)) {
            let (a, b) = (tree(a.get(component).unwrap()), tree(b.get(component).unwrap()));
            assert_eq!((a.rank(), a.axes(), a.nodes().len()), (b.rank(), b.axes(), b.nodes().len()));
            for (x, y) in a.nodes().iter().zip(b.nodes()) {
                match (x, y) {
                    (TreeNode::Leaf(x), TreeNode::Leaf(y)) => assert!((x - y).abs() <= 1e-9 * x, "{x} {y}"),
                    (x, y) => assert_eq!(x, y),
                }
            }
            leaves += a.leaves();
        }
    }
    assert_eq!(before.derived, after.derived);
    leaves
}

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

/// A tree of uneven depth, its values with all digits.
fn grown(rank: TreeRank, axes: cfs::compute::btdf::TreeAxes, mut seed: u64) -> TensorTree {
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
    let mut nodes = vec![TreeNode::Leaf(0.0)];
    grow(rank, 0, 0, &mut nodes, &mut seed);
    TensorTree::new(rank, axes, nodes).unwrap()
}

fn btdf(tree: TensorTree) -> Btdf {
    Btdf { regular: None, scattered: Some(Scattered::Tree(Box::new(tree))) }
}

/// All four functions and both bands.
fn family(rank: TreeRank) -> Dataset {
    use cfs::compute::btdf::TreeAxes::{Back, Front};
    let band = |seed| Band {
        transmission_front: Some(btdf(grown(rank, Front, seed))),
        transmission_back: Some(btdf(grown(rank, Back, seed + 1))),
        reflection_front: Some(btdf(grown(rank, Front, seed + 2))),
        reflection_back: Some(btdf(grown(rank, Back, seed + 3))),
    };
    Dataset {
        name: "A < B & C".into(),
        manufacturer: "Maker".into(),
        thickness: Some(0.0125),
        visible: band(1),
        solar: Some(band(10)),
        ..Dataset::default()
    }
}

#[test]
fn trees_stay_trees_leaf_by_leaf() {
    for rank in [TreeRank::Three, TreeRank::Four] {
        let source = family(rank);
        assert_eq!(rank_of(&source), Some(rank));
        let written = write(&source).unwrap();
        assert_eq!(written.findings.iter().filter(|finding| finding.code == "tree-kept").count(), 8);
        let again = read(&written.bytes).unwrap();
        assert!(same_trees(&source, &again) > 100);
        assert_eq!(
            (&again.name, &again.manufacturer, again.thickness),
            (&source.name, &source.manufacturer, Some(0.0125))
        );
        // Written a second time, nothing moves any more.
        assert!(write(&again).unwrap().bytes == written.bytes);
    }
}

#[test]
fn a_derived_function_is_left_out_and_derived_again() {
    let full = family(TreeRank::Four);
    let visible = Band { transmission_back: full.visible.transmission_back, ..Band::default() };
    let bytes = write(&Dataset { visible, ..Dataset::default() }).unwrap().bytes;
    let read_once = read(&bytes).unwrap();
    assert_eq!(read_once.derived, [Component::TransmissionFront]);
    let written = write(&read_once).unwrap();
    assert!(written.findings.iter().any(|finding| finding.code == "derived-left-out"));
    let again = read(&written.bytes).unwrap();
    same_trees(&read_once, &again);
    assert_eq!(again.visible, read_once.visible);
    // Who asks for a tree wants all of it, for programs that derive nothing.
    let form = TreeForm { derived: true, ..TreeForm::of_rank(TreeRank::Four) };
    let whole = read(&write_tree(&read_once, form).unwrap().bytes).unwrap();
    assert!(whole.derived.is_empty());
    assert_eq!(whole.visible.components(), [Component::TransmissionFront, Component::TransmissionBack]);
}

/// Real tensor trees, where there are any.
fn real() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let Some(folders) = data("data/bsdf") else { return found };
    for folder in std::fs::read_dir(folders).unwrap().flatten() {
        for file in std::fs::read_dir(folder.path()).unwrap().flatten() {
            let text = std::fs::read(file.path()).unwrap();
            if text.windows(10).any(|word| word == b"TensorTree") {
                found.push(file.path());
            }
        }
    }
    assert!(found.len() >= 6, "only {} files", found.len());
    found.sort();
    found
}

#[test]
fn real_trees_read_back_as_they_were() {
    for path in real() {
        let before = read(&std::fs::read(&path).unwrap()).unwrap();
        let written = write(&before).unwrap();
        let after = read(&written.bytes).unwrap();
        let leaves = same_trees(&before, &after);
        println!("{}: {leaves} leaves", path.display());
        // And pruned by a thousandth: smaller, and as said.
        let rank = rank_of(&before).unwrap();
        let form = TreeForm { tolerance: Some(1e-3), ..TreeForm::of_rank(rank) };
        let pruned = read(&write_tree(&before, form).unwrap().bytes).unwrap();
        for component in before.visible.components().into_iter().filter(|one| !before.derived.contains(one)) {
            let (a, b) = (before.visible.get(component).unwrap(), pruned.visible.get(component).unwrap());
            assert!((a.tau_hemispherical() - b.tau_hemispherical()).abs() < 1e-6, "{} {component:?}", path.display());
            assert!(tree(b).leaves() <= tree(a).leaves());
        }
    }
}

#[test]
fn matrices_and_closed_forms_become_trees_with_a_stated_error() {
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let n = basis.len();
    // A lobe around the direction of straight light, τ about 0.5.
    let values: Vec<f64> = (0..n * n)
        .map(|k| {
            let (a, b) = (basis.cell(k / n).centre(), basis.cell(k % n).centre());
            0.05 + 2.0 * ((a.dot(b) - 1.0) / 0.03).exp()
        })
        .collect();
    let matrix = Btdf::from_cells(CellMatrix::new(basis.clone(), basis.clone(), values).unwrap());
    let pane = Btdf {
        regular: Some(AngularTransmittance::Constant(0.3)),
        scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(0.2))),
    };
    let visible = Band { transmission_front: Some(matrix), reflection_back: Some(pane), ..Band::default() };
    let source = Dataset { name: "Lobe".into(), visible, ..Dataset::default() };
    assert_eq!(rank_of(&source), None);
    for rank in [TreeRank::Three, TreeRank::Four] {
        let written =
            write_tree(&source, TreeForm { level: Some(4), tolerance: Some(0.02), ..TreeForm::of_rank(rank) }).unwrap();
        let codes: Vec<&str> = written.findings.iter().map(|finding| finding.code).collect();
        assert_eq!(codes.iter().filter(|code| **code == "tree-made").count(), 2, "{codes:?}");
        assert!(codes.contains(&"regular-in-cells"));
        let made = read(&written.bytes).unwrap();
        assert_eq!(rank_of(&made), Some(rank));
        for component in source.visible.components() {
            let (a, b) = (source.visible.get(component).unwrap(), made.visible.get(component).unwrap());
            let (a, b) = (a.tau_hemispherical(), b.tau_hemispherical());
            assert!((a - b).abs() < 1e-3, "{rank:?} {component:?}: {a} {b}");
        }
        let mirror = made.visible.reflection_back.as_ref().unwrap();
        let from = Incident(Dir::from_theta_phi(0.7, 0.4));
        assert!((mirror.tau(from) - 0.5).abs() < 0.02, "{}", mirror.tau(from));
    }
    let wrong = write_tree(&source, TreeForm { level: Some(9), ..TreeForm::of_rank(TreeRank::Four) }).unwrap_err();
    assert!(wrong.to_string().contains("level 9; expected 1 … 6"), "{wrong}");
}
