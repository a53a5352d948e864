//! Stacks beside closed forms, and their balance.

use super::super::DataLayer;
use super::*;
use crate::compute::btdf::{Band, Btdf};
use crate::compute::direction::Dir;
use crate::compute::estimate::Silent;
use crate::compute::system::measure::front_basis;
use crate::compute::system::panes::{Panes, coated, glazing};
use crate::compute::system::sheets::diffuser;
use crate::compute::system::slats::{SlatArray, SlatModel, SlatProfile, Surface};

/// Pane that absorbs a little, with the usual index and thickness of float glass; its closed form is compared.
const CLEAR: glazing::Pane = glazing::Pane { index: 1.52, thickness: 0.004, absorption: 10.0 };

/// A layer known by its data alone.
fn as_data(specimen: &dyn OpticalModel) -> Box<dyn OpticalModel> {
    let cells = front_basis();
    let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
    Box::new(DataLayer(specimen.examine(&setting, &Silent).unwrap().0))
}

fn pane() -> Box<dyn OpticalModel> {
    as_data(&Panes::equal(coated::Layer::Clear(CLEAR), 1))
}

fn blind(tilt: f64) -> Box<dyn OpticalModel> {
    let sides = [0.8, 0.3].map(Surface::matt);
    let flat = SlatProfile::Flat { width: 0.08 };
    as_data(&SlatModel::new(SlatArray::new(flat, 0.0, 0.072, tilt.to_radians(), sides).unwrap()))
}

fn measure(layers: Vec<Box<dyn OpticalModel>>, error: f64) -> Measured {
    let cells = front_basis();
    Stack::new(layers).measure(&Setting { incident: &cells, emergent: &cells, error, seed: 1 }, &Silent).unwrap()
}

#[test]
fn lambertian_layers_follow_the_geometric_series() {
    let sheet = |t, r| Box::new(DataLayer(diffuser::lambertian(t, r))) as Box<dyn OpticalModel>;
    let made = measure(vec![sheet(0.5, 0.3), sheet(0.4, 0.5)], 0.01);
    let tau = made.shares(&made.front.transmitted);
    let rho = made.shares(&made.back.reflected);
    for i in 0..tau.len() {
        assert!((tau[i] - 0.5 * 0.4 / (1.0 - 0.3 * 0.5)).abs() < 1e-12);
        assert!((rho[i] - (0.5 + 0.4 * 0.4 * 0.3 / (1.0 - 0.15))).abs() < 1e-12);
    }
    assert!(made.quality().balance < 1e-12);
}

#[test]
fn two_panes_as_layers_are_two_panes_of_unpolarised_light() {
    // Layers know nothing of polarisation: Stokes' formula for the means.
    let made = measure(vec![pane(), pane()], 1e-3);
    let cells = front_basis();
    let tau = made.shares(&made.front.transmitted);
    for (i, cell) in cells.cells().enumerate().filter(|(_, cell)| cell.theta() < 1.3) {
        let exact = crate::compute::basis::cell_mean(&cell, 40, |d| {
            let one = glazing::stack(&[CLEAR], d.theta());
            one.transmitted.powi(2) / (1.0 - one.reflected_front.powi(2))
        });
        assert!((tau[i] - exact).abs() < 1e-3, "{i}: {} {exact}", tau[i]);
    }
}

#[test]
fn a_pane_before_a_blind_keeps_the_balance_and_reciprocity() {
    for layers in [vec![pane(), blind(40.0)], vec![blind(40.0), pane()], vec![pane(), blind(-20.0), pane()]] {
        let quality = measure(layers, 0.01).quality();
        assert!(quality.balance < 2e-3 && quality.balance <= quality.error, "{quality:?}");
        assert!(quality.reciprocity.unwrap() < 0.01, "{quality:?}");
    }
}

#[test]
fn order_and_up_and_down_matter() {
    // A reflector that sends light from above up again would be seen in the wrong half if names were not turned:
    // white blind, lowered outside, before a mirror: light from above leaves towards above.
    let mirror = Box::new(DataLayer(Band {
        transmission_front: Some(Btdf::ideal_transparent(0.0)),
        transmission_back: Some(Btdf::ideal_transparent(0.0)),
        reflection_front: Some(Btdf::ideal_transparent(1.0)),
        reflection_back: Some(Btdf::ideal_transparent(1.0)),
    })) as Box<dyn OpticalModel>;
    let open = SlatArray::new(SlatProfile::Flat { width: 0.02 }, 0.0, 0.1, 0.0, [Surface::matt(0.0); 2]).unwrap();
    let made = measure(vec![as_data(&SlatModel::new(open)), mirror], 0.05);
    let cells = front_basis();
    let above = cells.index(Dir::from_theta_phi(0.7, PI / 2.0)).unwrap();
    let below = cells.index(Dir::from_theta_phi(0.7, -PI / 2.0)).unwrap();
    let q = |i: usize, o: usize| made.front.reflected[i * cells.len() + o];
    // A mirror keeps names.
    assert!(q(above, above) > 0.1 && q(above, below) < 1e-9);
    assert_eq!(made.shares(&made.front.transmitted).iter().copied().fold(0.0, f64::max), 0.0);
}

/// Panes that give their data by pairs of cells, as layers do that do not keep light in its cell.
struct ByPairs(Panes);

impl OpticalModel for ByPairs {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        self.0.measure(setting, progress)
    }

    fn beams(&self, direction: Dir<Facade>, side: Side) -> Vec<Beam> {
        self.0.beams(direction, side)
    }

    fn scattered(&self, direction: Dir<Facade>, side: Side, emergent: &RingBasis) -> ScatteredLight {
        self.0.scattered(direction, side, emergent)
    }
}

#[test]
fn one_coefficient_for_each_cell_gives_what_the_pairs_of_cells_give() {
    // Unlike on its two sides, so that they cannot be exchanged.
    let coated = coated::CoatedPane { transmittance: 0.5, front: 0.1, back: 0.35 };
    let panes = || Panes::equal(coated::Layer::Coated(coated), 1);
    let [by_cell, by_pairs]: [Box<dyn OpticalModel>; 2] = [Box::new(panes()), Box::new(ByPairs(panes()))];
    let cells = front_basis();
    let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
    assert!(
        by_cell.by_cell(&setting, &Silent).unwrap().is_some() && by_pairs.by_cell(&setting, &Silent).unwrap().is_none()
    );
    assert_eq!(measure(vec![by_cell, blind(40.0)], 1e-3), measure(vec![by_pairs, blind(40.0)], 1e-3));
}
