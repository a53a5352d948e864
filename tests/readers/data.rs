//! Datasets: made from decisions, and what holds for each that a reader returns.

use super::choices::Choices;
use cfs::compute::basis::{AzimuthMap, Ring, RingBasis};
use cfs::compute::btdf::{
    AngularTransmittance, Btdf, CellMatrix, Component, Dataset, Finding, Indicatrices, Scattered, TensorTree,
    ThermalKey, TreeAxes, TreeNode, TreeRank, tau_max,
};
use cfs::compute::direction::{Dir, Incident};
use cfs::compute::limits;
use cfs::compute::wavelet::Criterion;
use std::f64::consts::PI;
use std::sync::Arc;

/// A few rings in whole degrees.
pub fn rings(choices: &mut Choices) -> Vec<Ring> {
    let count = 1 + choices.below(4);
    let mut limits: Vec<usize> = (1..count).map(|_| 1 + choices.below(89)).collect();
    limits.extend([0, 90]);
    limits.sort_unstable();
    limits.dedup();
    let ring = |pair: &[usize], sectors| Ring {
        theta_min: (pair[0] as f64).to_radians(),
        theta_max: (pair[1] as f64).to_radians(),
        sectors,
        first_phi: 0.0,
    };
    limits.windows(2).map(|pair| ring(pair, 1 + choices.below(6))).collect()
}

fn basis(choices: &mut Choices) -> RingBasis {
    match choices.below(6) {
        0 => RingBasis::hemisphere(),
        1 | 2 => RingBasis::new("own", rings(choices), AzimuthMap::FACADE).expect("rings that divide the hemisphere"),
        3 => RingBasis::klems_quarter(AzimuthMap::KLEMS_FRONT),
        4 => RingBasis::even(0.5),
        _ => RingBasis::equal_area(1 + choices.below(3)),
    }
}

/// Values that let pass at most all light.
fn values(choices: &mut Choices, count: usize) -> Vec<f64> {
    let (step, turn, scale) = (1 + choices.below(50), 2 + choices.below(40), choices.between(0.0, 1.0 / PI));
    let mut values: Vec<f64> = (0..count).map(|k| scale * ((k * step) % turn) as f64 / turn as f64).collect();
    for _ in 0..choices.below(4) {
        let at = choices.below(count);
        values[at] = choices.between(0.0, 1.0 / PI);
    }
    values
}

fn angular(choices: &mut Choices) -> AngularTransmittance {
    if choices.flag() {
        AngularTransmittance::Table((0..2 + choices.below(9)).map(|_| choices.between(0.0, 0.5)).collect())
    } else {
        AngularTransmittance::Constant(choices.between(0.0, 0.5))
    }
}

pub fn cells(choices: &mut Choices, incident: RingBasis, emergent: RingBasis) -> CellMatrix {
    let values = values(choices, incident.len() * emergent.len());
    CellMatrix::new(incident, emergent, values).expect("a value for every pair of cells")
}

fn directions(choices: &mut Choices) -> Indicatrices {
    let count = 1 + choices.below(6);
    let incident = (0..count).map(|k| {
        let (theta, phi) = (choices.between(0.0, 1.5), k as f64 + choices.between(0.1, 0.9));
        Incident(Dir::from_theta_phi(if k == 0 { theta } else { theta.max(0.1) }, phi))
    });
    let (incident, emergent) = (incident.collect::<Vec<_>>(), basis(choices));
    let values = values(choices, count * emergent.len());
    Indicatrices::new(incident, emergent, values).unwrap_or_else(|| {
        let (one, cell) = (vec![Incident(Dir::from_theta_phi(0.3, 1.0))], RingBasis::hemisphere());
        Indicatrices::new(one, cell, vec![0.1]).expect("one direction, one cell")
    })
}

pub fn tree(choices: &mut Choices, rank: TreeRank, axes: TreeAxes) -> TensorTree {
    fn grow(choices: &mut Choices, nodes: &mut Vec<TreeNode>, at: usize, children: usize, level: usize) {
        // Deep in few places, as peaks are.
        if level < 4 && choices.below(4 * level + 2) >= 4 * level + usize::from(level == 0) {
            let first = nodes.len();
            nodes[at] = TreeNode::Branch(first as u32);
            nodes.extend(std::iter::repeat_n(TreeNode::Leaf(0.0), children));
            (first..first + children).for_each(|child| grow(choices, nodes, child, children, level + 1));
        } else {
            nodes[at] = TreeNode::Leaf(choices.between(0.0, 1.0 / PI));
        }
    }
    let mut nodes = vec![TreeNode::Leaf(0.0)];
    grow(choices, &mut nodes, 0, rank.children(), 0);
    TensorTree::new(rank, axes, nodes).expect("every branch has its own children")
}

fn function(choices: &mut Choices, axes: TreeAxes) -> Btdf {
    let regular = choices.one_in(4).then(|| angular(choices));
    let scattered = match choices.below(9) {
        0 => None,
        1 => Some(Scattered::Lambert(angular(choices))),
        2 | 3 => {
            let (incident, emergent) = (basis(choices), basis(choices));
            Some(Scattered::Cells(Box::new(cells(choices, incident, emergent))))
        }
        4 => Some(Scattered::Directions(Arc::new(directions(choices)))),
        5 => {
            let (incident, emergent) = (basis(choices), basis(choices));
            let plain = cells(choices, incident, emergent);
            let compact = plain.compacted(Criterion::NORMAL).unwrap_or(plain);
            Some(Scattered::Cells(Box::new(compact)))
        }
        6 => {
            let plain = directions(choices);
            let compact = plain.compacted(Criterion::NORMAL).unwrap_or(plain);
            Some(Scattered::Directions(Arc::new(compact)))
        }
        7 => Some(Scattered::Tree(Box::new(tree(choices, TreeRank::Three, axes)))),
        _ => Some(Scattered::Tree(Box::new(tree(choices, TreeRank::Four, axes)))),
    };
    Btdf { regular, scattered }
}

/// Names and what else is known, without functions.
pub fn head(choices: &mut Choices) -> Dataset {
    let mut dataset = Dataset {
        name: choices.words(),
        manufacturer: choices.words(),
        description: choices.words(),
        state: choices.words(),
        thickness: choices.flag().then(|| choices.tidy(0.0, 0.2)),
        ..Dataset::default()
    };
    for key in ThermalKey::ALL {
        if choices.one_in(4) {
            dataset.thermal.set(key, choices.tidy(0.0, 1.0));
        }
    }
    if choices.one_in(4) {
        dataset.thermal.device = "Woven shade".to_owned();
    }
    dataset
}

/// Functions of one kind in each place that is chosen, transmission from outside always.
pub fn filled(choices: &mut Choices, mut function: impl FnMut(&mut Choices, Component) -> Btdf) -> Dataset {
    let mut dataset = head(choices);
    for component in Component::ALL {
        if component == Component::TransmissionFront || choices.one_in(4) {
            let btdf = function(choices, component);
            dataset.visible.set(component, btdf);
        }
    }
    if choices.one_in(4) {
        let mut solar = dataset.visible.clone();
        solar.reflection_back = None;
        dataset.solar = Some(solar);
    }
    dataset
}

/// Any dataset.
pub fn dataset(choices: &mut Choices) -> Dataset {
    let mut dataset = filled(choices, |choices, component| {
        function(choices, if component.is_front() { TreeAxes::Front } else { TreeAxes::Back })
    });
    dataset.structure = choices.one_in(3).then(|| choices.tidy(0.01, 0.2));
    if choices.one_in(3) {
        dataset.findings.push(Finding::warning("negative-values", choices.words()));
    }
    dataset
}

/// What holds for every dataset that was read: numbers that are some, no negative light where `light` is promised.
pub fn sound(dataset: &Dataset, light: bool) {
    for band in std::iter::once(&dataset.visible).chain(&dataset.solar) {
        for component in Component::ALL {
            if let Some(btdf) = band.get(component) {
                sound_function(btdf, light);
            }
        }
    }
    assert!(dataset.thickness.is_none_or(f64::is_finite), "thickness {:?}", dataset.thickness);
    assert!(dataset.structure.is_none_or(|period| period.is_finite() && period > 0.0), "{:?}", dataset.structure);
    assert!(dataset.room_side_reflectance().is_none_or(|share| (0.0..=1.0).contains(&share)));
    for finding in &dataset.findings {
        assert!(!finding.code.is_empty(), "a finding without a code");
    }
    if let Some(described) = &dataset.described {
        assert!(!described.text.is_empty(), "a description without text");
    }
}

fn sound_function(btdf: &Btdf, light: bool) {
    // 1e9/sr over the whole hemisphere and more than one part of it.
    let most = 16.0 * limits::COEFFICIENT;
    let fine = |what: &str, value: f64| {
        assert!(value.is_finite() && value.abs() <= most, "{what} {value:e}");
        assert!(!light || value >= 0.0, "{what} {value:e} of light");
    };
    fine("tau_max", tau_max(btdf));
    fine("tau_normal", btdf.tau_normal());
    fine("tau_hemispherical", btdf.tau_hemispherical());
    for (theta, phi) in [(0.0, 0.0), (0.3, 1.0), (0.8, PI), (1.2, 4.0), (1.57, 6.2)] {
        let incident = Incident(Dir::from_theta_phi(theta, phi));
        fine("tau", btdf.tau(incident));
        if let Some(indicatrix) = btdf.indicatrix(incident) {
            assert_eq!(indicatrix.basis.len(), indicatrix.q.len(), "an indicatrix that does not fit its cells");
            indicatrix.q.iter().for_each(|q| fine("q", *q));
        }
    }
}
