//! Walls of holes beside closed forms, and their balance.

use super::*;
use crate::compute::estimate::Silent;
use crate::compute::system::measure::front_basis;

fn sheet(hole: Hole, thickness: f64, rise: f64, wall: f64) -> Perforated {
    Perforated { hole, area: 1e-4, thickness, rise, reflectance: [0.6, 0.4, wall] }
}

fn measure(sheet: &Perforated) -> Measured {
    let cells = front_basis();
    measure_walls(sheet, &Setting { incident: &cells, emergent: &cells, error: 0.005, seed: 1 }, &Silent).unwrap()
}

#[test]
fn balance_and_reciprocity_of_every_shape() {
    let side = 0.007;
    for (hole, rise) in [
        (Hole::Round { diameter: side }, 0.0),
        (Hole::Rectangle { width: side, height: 0.5 * side }, 0.0),
        (Hole::Rhombus { width: 0.012, height: side }, 0.002),
    ] {
        for wall in [0.0, 0.9] {
            let quality = measure(&sheet(hole, 0.004, rise, wall)).quality();
            assert!(quality.balance < 1e-3, "{hole:?} {wall}: {quality:?}");
            assert!(quality.reciprocity.unwrap() < 0.01, "{hole:?} {wall}: {quality:?}");
            assert!(quality.error < 0.005, "{hole:?} {wall}: {quality:?}");
        }
    }
}

#[test]
fn straight_share_of_a_square_hole_is_a_product() {
    // Open (a − t|x|/z)(a − t|y|/z) of the unit area.
    let (a, t) = (0.8, 0.3);
    let hole = Hole::Rectangle { width: 0.008, height: 0.008 };
    let walls = Walls::new(&sheet(hole, 0.003, 0.0, 0.0), 3);
    let mut dump = vec![0.0; walls.patches.len()];
    for (theta, phi) in [(0.2, 0.3), (0.7, 1.2), (1.1, 4.0), (1.4, 5.5)] {
        let d = Dir::from_theta_phi(theta, phi);
        let v = d.vector();
        let exact = (a - t * (v.x / v.z).abs()).max(0.0) * (a - t * (v.y / v.z).abs()).max(0.0);
        for side in Side::BOTH {
            let found = walls.light(d, side, false, 1.0, &mut dump);
            assert!((found - exact).abs() < 1e-12, "{theta} {phi}: {found} {exact}");
        }
    }
}

#[test]
fn a_deep_hole_with_white_walls_is_a_pipe_that_loses_nothing() {
    let made = measure(&sheet(Hole::Round { diameter: 0.008 }, 0.004, 0.0, 1.0));
    let (t, r) = (made.shares(&made.front.transmitted), made.shares(&made.front.reflected));
    let open = 0.25 * PI * 0.64;
    for (t, r) in t.iter().zip(&r) {
        assert!((t + r - open - 0.6 * (1.0 - open)).abs() < 1e-3, "{t} {r}");
    }
    // Clausing's probability of a tube as long as its radius: 0.6720 (Clausing 1932; exact 0.67198).
    let cells = front_basis();
    let uniform: f64 = cells.projected_solid_angles().iter().zip(&t).map(|(w, t)| w * t).sum::<f64>() / PI;
    assert!((uniform / open - 0.6720).abs() < 0.01, "{}", uniform / open);
}

#[test]
fn walls_that_rise_inwards_let_low_light_through() {
    let made = measure(&sheet(Hole::Rhombus { width: 0.018, height: 0.008 }, 0.004, 0.003, 0.0));
    let cells = front_basis();
    let at = |phi: f64| cells.index(Dir::from_theta_phi(0.6, phi)).unwrap();
    let tau = made.shares(&made.front.transmitted);
    // Light from below travels upwards and inwards.
    assert!(tau[at(-PI / 2.0)] > 2.0 * tau[at(PI / 2.0)], "{} {}", tau[at(-PI / 2.0)], tau[at(PI / 2.0)]);
}
