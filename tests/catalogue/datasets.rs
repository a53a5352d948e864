//! Strategies for any dataset that can be.

use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{
    AngularTransmittance, Btdf, CellMatrix, Component, Dataset, Finding, Indicatrices, Scattered, TensorTree, Thermal,
    ThermalKey, TreeAxes, TreeNode, TreeRank,
};
use cfs::compute::direction::Incident;
use proptest::prelude::*;
use std::sync::Arc;

fn angular() -> impl Strategy<Value = AngularTransmittance> {
    prop_oneof![
        (0.0..1.0_f64).prop_map(AngularTransmittance::Constant),
        prop::collection::vec(0.0..1.0_f64, 2..40).prop_map(AngularTransmittance::Table),
    ]
}

/// Nothing, a word alone, or every second number.
fn thermal(device: &str, share: Option<f64>) -> Thermal {
    let mut thermal = Thermal::default();
    thermal.device = device.to_owned();
    for key in ThermalKey::ALL.into_iter().step_by(2).filter(|_| share.is_some()) {
        thermal.set(key, share.unwrap_or_default().abs().min(1.0));
    }
    thermal
}

fn basis() -> impl Strategy<Value = RingBasis> {
    prop_oneof![
        Just(RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)),
        Just(RingBasis::klems_quarter(AzimuthMap::KLEMS_BACK)),
        Just(RingBasis::tregenza()),
        (1..5_usize).prop_map(RingBasis::equal_area),
    ]
}

/// Values that f32 holds exactly, so that the round trip must be the identity.
fn cells() -> impl Strategy<Value = Scattered> {
    (basis(), basis(), any::<u32>()).prop_map(|(incident, emergent, seed)| {
        let mut state = seed;
        let values = (0..incident.len() * emergent.len())
            .map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f64::from(state as f32 / u32::MAX as f32)
            })
            .collect();
        Scattered::Cells(Box::new(CellMatrix::new(incident, emergent, values).unwrap()))
    })
}

/// Any list of directions no two of which are close, and the lattices in their own order.
fn directions() -> impl Strategy<Value = Scattered> {
    let lattices = prop_oneof![
        Just(RingBasis::tregenza()),
        Just(RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)),
        (1..6_usize).prop_map(RingBasis::equal_area),
    ];
    (lattices, basis(), any::<u32>(), 1..150_usize).prop_map(|(lattice, emergent, seed, most)| {
        let incident: Vec<Incident> = lattice.cells().take(most).map(|cell| Incident(cell.centre())).collect();
        let value = |k: usize| f64::from((k as u32).wrapping_mul(seed) as f32 / u32::MAX as f32);
        let values = (0..incident.len() * emergent.len()).map(value).collect();
        Scattered::Directions(Arc::new(Indicatrices::new(incident, emergent, values).unwrap()))
    })
}

/// Trees of two levels at most: the root, its children, and those of one child.
fn tree() -> impl Strategy<Value = Scattered> {
    (any::<bool>(), any::<bool>(), any::<bool>(), prop::collection::vec(0.0..1.0_f32, 32)).prop_map(
        |(four, back, deep, values)| {
            let rank = if four { TreeRank::Four } else { TreeRank::Three };
            let axes = if back { TreeAxes::Back } else { TreeAxes::Front };
            let children = rank.children();
            let mut nodes = vec![TreeNode::Branch(1)];
            nodes.extend(values[..children].iter().map(|q| TreeNode::Leaf(f64::from(*q))));
            if deep {
                nodes[2] = TreeNode::Branch(children as u32 + 1);
                nodes.extend(values[..children].iter().map(|q| TreeNode::Leaf(f64::from(1.0 - *q))));
            }
            Scattered::Tree(Box::new(TensorTree::new(rank, axes, nodes).unwrap()))
        },
    )
}

fn btdf() -> impl Strategy<Value = Btdf> {
    let scattered = prop_oneof![angular().prop_map(Scattered::Lambert), cells(), directions(), tree()];
    (prop::option::of(angular()), prop::option::of(scattered))
        .prop_map(|(regular, scattered)| Btdf { regular, scattered })
}

/// Any dataset that the blob keeps exactly.
pub fn dataset() -> impl Strategy<Value = Dataset> {
    let texts = prop::collection::vec(".{0,20}", 7);
    let functions = prop::collection::vec(prop::option::of(btdf()), 8);
    (texts, functions, any::<bool>(), prop::option::of(0.0..1.0_f64), any::<bool>()).prop_map(
        |(t, functions, solar, thickness, turned)| {
            let mut bands = [cfs::compute::btdf::Band::default(), cfs::compute::btdf::Band::default()];
            for (k, function) in functions.into_iter().enumerate() {
                if let Some(function) = function {
                    bands[k / 4].set(Component::ALL[k % 4], function);
                }
            }
            let [mut visible, infrared] = bands;
            if let (true, Some(Btdf { regular, scattered: Some(Scattered::Cells(m)) })) =
                (turned, visible.transmission_front.clone())
            {
                let scattered = Some(Scattered::Cells(Box::new(m.reversed())));
                visible.transmission_back = Some(Btdf { regular, scattered });
            }
            Dataset {
                name: t[0].clone(),
                manufacturer: t[1].clone(),
                description: t[2].clone(),
                state: t[3].clone(),
                format: t[4].clone(),
                incident_basis: t[5].clone(),
                emergent_basis: t[6].clone(),
                thickness,
                structure: thickness.map(|thickness| 0.01 + thickness.abs()),
                thermal: thermal(&t[3], thickness),
                visible,
                solar: solar.then_some(infrared),
                derived: if turned { vec![Component::TransmissionBack] } else { vec![] },
                findings: vec![Finding::warning("not-reciprocal", t[0].clone())],
                // The blob does not hold it: products do.
                described: None,
            }
        },
    )
}
