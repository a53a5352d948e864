//! Stacks for single directions beside closed forms, means over cells and reciprocity.

use crate::compute::basis::{RingBasis, sub_directions};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::Silent;
use crate::compute::system::Family;
use crate::compute::system::laser_cut::{CutPanel, LaserCutPanel};
use crate::compute::system::measure::beams::SharpBeams;
use crate::compute::system::measure::directions::at_directions;
use crate::compute::system::measure::upright::Upright;
use crate::compute::system::measure::{Beam, OpticalModel, Setting, Side, front_basis};
use crate::compute::system::panes::Panes;
use crate::compute::system::panes::coated::Layer;
use crate::compute::system::panes::glazing::{Pane, stack};
use crate::compute::system::sheets::{Hole, Perforated, diffuser};
use crate::compute::system::slats::{SlatArray, SlatModel, SlatProfile, Surface};
use crate::compute::system::stack::{DataLayer, Stack};

/// Clear pane with the usual index and thickness of float glass; its closed form is compared.
const CLEAR: Pane = Pane { index: 1.52, thickness: 0.004, absorption: 0.0 };
/// Pane like [`CLEAR`] that absorbs 11 % of the light in one passage.
const GREY: Pane = Pane { index: 1.52, thickness: 0.004, absorption: 30.0 };

fn pane(pane: Pane) -> Box<dyn OpticalModel> {
    Box::new(Panes::equal(Layer::Clear(pane), 1))
}

fn panel() -> Box<dyn OpticalModel> {
    let sheet = Pane { index: 1.49, thickness: 0.006, absorption: 0.0 };
    Box::new(SharpBeams(CutPanel { panel: LaserCutPanel { sheet, spacing: 0.005 }, cut_loss: 0.0 }))
}

/// Holes whose walls rise inwards, so that up and down differ: the built-in expanded metal of medium mesh, with black
/// strands.
const STRANDS: Perforated = Perforated {
    hole: Hole::Rhombus { width: 0.052, height: 0.018 },
    area: 0.0008,
    thickness: 0.008,
    rise: 0.006,
    reflectance: [0.0; 3],
};

fn lambertian(t: f64, r: f64) -> Box<dyn OpticalModel> {
    Box::new(DataLayer(diffuser::lambertian(t, r)))
}

fn directions() -> impl Iterator<Item = Dir<Facade>> {
    (0..40).map(|k| Dir::from_theta_phi(0.038 * f64::from(k), 2.4 * f64::from(k)))
}

fn sum(beams: &[Beam], transmitted: bool) -> f64 {
    beams.iter().filter(|beam| beam.transmitted == transmitted).map(|beam| beam.share).sum()
}

fn flux(cells: &RingBasis, q: &[f64]) -> f64 {
    cells.projected_solid_angles().iter().zip(q).map(|(w, q)| w * q).sum()
}

#[test]
fn a_pane_and_black_holes_are_a_product() {
    for outside in [true, false] {
        let holes = STRANDS.optical_model("").unwrap();
        let made = Stack::new(if outside { vec![pane(GREY), holes] } else { vec![holes, pane(GREY)] });
        for direction in directions() {
            let glass = stack(&[GREY], direction.theta());
            let open = STRANDS.straight(direction);
            for side in Side::BOTH {
                let beams = made.beams(direction, side);
                assert!((sum(&beams, true) - glass.transmitted * open).abs() < 1e-7);
                // What reaches the pane first is mirrored; from behind the holes, what passes them twice.
                let seen_first = outside == (side == Side::Front);
                let back = Dir::from_unit(direction.vector() * glam::DVec3::new(-1.0, -1.0, 1.0));
                let returned = if seen_first { 1.0 } else { open * STRANDS.straight(back) };
                assert!((sum(&beams, false) - glass.reflected_front * returned).abs() < 1e-7, "{outside} {side:?}");
                assert!(beams.iter().all(|beam| beam.directions.iter().all(|to| to.dot(direction) > 1.0 - 1e-12)));
                assert!(made.scattered(direction, side, &front_basis()).transmitted.is_empty());
            }
        }
    }
}

#[test]
fn panes_as_layers_follow_their_geometric_series() {
    let two = Stack::new(vec![pane(GREY), pane(CLEAR)]);
    for direction in directions() {
        let [a, b] = [GREY, CLEAR].map(|pane| stack(&[pane], direction.theta()));
        let between = 1.0 - a.reflected_front * b.reflected_front;
        for side in Side::BOTH {
            let beams = two.beams(direction, side);
            let (first, last) = if side == Side::Front { (a, b) } else { (b, a) };
            let back = first.reflected_front + first.transmitted.powi(2) * last.reflected_front / between;
            assert!((sum(&beams, true) - a.transmitted * b.transmitted / between).abs() < 2e-7);
            assert!((sum(&beams, false) - back).abs() < 2e-7 && beams.len() == 2);
        }
    }
    // Without polarisation, at normal incidence, they are what two panes in one layer are.
    let normal = Dir::from_theta_phi(0.0, 0.0);
    let exact = stack(&[GREY, CLEAR], 0.0);
    assert!((sum(&two.beams(normal, Side::Front), true) - exact.transmitted).abs() < 2e-7);
}

#[test]
fn scattering_layers_follow_their_geometric_series() {
    let made = Stack::new(vec![lambertian(0.5, 0.3), lambertian(0.4, 0.5)]);
    for cells in [front_basis(), RingBasis::even(0.2)] {
        let found = made.scattered(Dir::from_theta_phi(0.6, 0.2), Side::Front, &cells);
        assert!((flux(&cells, &found.transmitted) - 0.5 * 0.4 / 0.85).abs() < 1e-8);
        assert!((flux(&cells, &found.reflected) - 0.3 - 0.5 * 0.5 * 0.5 / 0.85).abs() < 1e-8);
        let found = made.scattered(Dir::from_theta_phi(1.2, 4.0), Side::Back, &cells);
        assert!((flux(&cells, &found.reflected) - 0.5 - 0.4 * 0.4 * 0.3 / 0.85).abs() < 1e-8);
    }
}

#[test]
fn nothing_is_lost_where_nothing_absorbs() {
    let cells = RingBasis::even(0.15);
    for layers in [
        vec![panel(), pane(CLEAR)],
        vec![pane(CLEAR), lambertian(0.4, 0.6)],
        vec![lambertian(0.4, 0.6), panel(), pane(CLEAR)],
    ] {
        let made = Stack::new(layers);
        for direction in directions().step_by(4) {
            for side in Side::BOTH {
                let beams = made.beams(direction, side);
                let found = made.scattered(direction, side, &cells);
                let all = sum(&beams, true)
                    + sum(&beams, false)
                    + flux(&cells, &found.transmitted)
                    + flux(&cells, &found.reflected);
                assert!((all - 1.0).abs() < found.error + 5e-6, "{all} {}", found.error);
            }
        }
    }
}

#[test]
fn beams_go_back_the_way_they_came() {
    // Light of a to b from outside is light of b to a from inside; a half turn for what is thrown back.
    let made = Stack::new(vec![panel(), STRANDS.optical_model("").unwrap(), pane(GREY), panel()]);
    let turned = |direction: Dir<Facade>| super::super::passage::half_turn(direction);
    for direction in directions().skip(1) {
        for side in Side::BOTH {
            for beam in made.beams(direction, side) {
                let to = beam.directions[0];
                let (other, from, back) = match (beam.transmitted, side) {
                    (true, Side::Front) => (Side::Back, to, direction),
                    (true, Side::Back) => (Side::Front, to, direction),
                    (false, side) => (side, turned(to), turned(direction)),
                };
                let beams = made.beams(from, other);
                let found = beams.iter().find(|twin| {
                    twin.transmitted == beam.transmitted
                        && (twin.directions[0].vector() - back.vector()).length() < 1e-7
                });
                let share = found.map_or(0.0, |twin| twin.share);
                assert!((share - beam.share).abs() < 3e-6, "{side:?} {beam:?} {share}");
            }
        }
    }
}

#[test]
fn the_mean_of_single_directions_is_what_is_measured() {
    let cells = front_basis();
    let n = cells.len();
    let weight = cells.projected_solid_angles();
    let setting = Setting { incident: &cells, emergent: &cells, error: 0.003, seed: 1 };
    // Upside down and outside in are told apart by the strands, which let rising light in.
    let strands = Perforated { reflectance: [0.5, 0.3, 0.0], ..STRANDS };
    for layers in [
        vec![panel(), strands.optical_model("").unwrap()],
        vec![strands.optical_model("").unwrap(), pane(GREY), lambertian(0.3, 0.5)],
    ] {
        let made = Stack::new(layers);
        let measured = made.measure(&setting, &Silent).unwrap();
        for side in Side::BOTH {
            let seen = measured.seen(side);
            for i in [0, 33, 47, 70, 88, 105] {
                let directions: Vec<_> = sub_directions(&cells.cell(i), 4).collect();
                let found = at_directions(&made, side, &directions, &cells, &Silent).unwrap();
                for (rows, row) in [(&found.transmitted, &seen.transmitted), (&found.reflected, &seen.reflected)] {
                    let mut apart = 0.0;
                    for (o, weight) in weight.iter().enumerate() {
                        let mean =
                            (0..directions.len()).map(|k| rows[k * n + o]).sum::<f64>() / directions.len() as f64;
                        apart += (mean - row[i * n + o]).abs() * weight;
                    }
                    assert!(apart < 0.03, "{side:?} {i}: {apart}");
                }
            }
        }
    }
}

#[test]
fn a_pane_before_a_blind_has_the_measured_totals() {
    let cells = front_basis();
    let n = cells.len();
    let blind = || {
        let sides = [0.8, 0.3].map(Surface::matt);
        let profile = SlatProfile::Flat { width: 0.08 };
        let array = SlatArray::new(profile, 0.0, 0.072, 40_f64.to_radians(), sides).unwrap();
        Box::new(SlatModel::new(array)) as Box<dyn OpticalModel>
    };
    let setting = Setting { incident: &cells, emergent: &cells, error: 0.05, seed: 1 };
    for layers in [vec![pane(GREY), blind()], vec![blind(), pane(GREY)]] {
        let made = Stack::new(layers);
        let measured = made.measure(&setting, &Silent).unwrap();
        for side in Side::BOTH {
            let seen = measured.seen(side);
            for i in [0, 33, 47, 88] {
                let directions: Vec<_> = sub_directions(&cells.cell(i), 4).collect();
                let found = at_directions(&made, side, &directions, &cells, &Silent).unwrap();
                for (rows, row) in [(&found.transmitted, &seen.transmitted), (&found.reflected, &seen.reflected)] {
                    let mean = rows.chunks_exact(n).map(|row| flux(&cells, row)).sum::<f64>() / directions.len() as f64;
                    let due = flux(&cells, &row[i * n..(i + 1) * n]);
                    assert!((mean - due).abs() < 0.01, "{side:?} {i}: {mean} {due}");
                }
            }
        }
    }
}

#[test]
fn what_is_cached_in_a_stack_and_its_layers_is_counted() {
    let cells = front_basis();
    let n = cells.len();
    let strands = Perforated { reflectance: [0.5; 3], ..STRANDS };
    let stack = Upright(Box::new(Stack::new(vec![pane(CLEAR), strands.optical_model("").unwrap()])));
    assert_eq!(stack.bytes(), 0);
    for _ in 0..2 {
        stack.scattered(Dir::from_theta_phi(0.6, 1.0), Side::Front, &cells);
        // Of two layers for light from two sides, transmitted and reflected; of the one gap, for light that travels in
        // two senses and leaves in two.
        let flows = (2 * 2 * 2 + 2 * 2) * n * n * size_of::<f64>();
        // Walls of 24 patches around and 4, then 8, through the sheet: their interreflection, and their light by cell,
        // for light that leaves the holes to either side.
        let patches = [24 * 4, 24 * 8];
        let walls: usize = patches.map(|p| p * p * size_of::<f64>() + 2 * p * n * size_of::<f32>()).iter().sum();
        assert_eq!(stack.bytes(), flows + walls);
    }
}
