//! Tests of planes, diffusers and units of the LID picture.

use super::*;
use crate::compute::lid::EmergentLuminance;
use crate::compute::lid::c_gamma::{Peak, Step};
use crate::drawing::lid_curves::intensity;
use std::f64::consts::FRAC_PI_2;

fn lambert(surface: Surface) -> Lid {
    Lid { surface, size: [2.0, 1.5], parts: vec![EmergentLuminance::Uniform(1000.0)], beams: Vec::new() }
}

#[test]
fn planes_and_angles_agree() {
    let near = |plane: LidPlane, angle: f64, c: f64, gamma: f64| {
        for aim in [Aim::Mounted, Aim::Down] {
            let found = aim.angles(plane.direction(aim, angle));
            let turned = (found.0.to_degrees() - c + 180.0).rem_euclid(360.0) - 180.0;
            assert!(turned.abs() < 1e-9 && (found.1.to_degrees() - gamma).abs() < 1e-9, "{plane:?} {found:?}");
        }
    };
    near(LidPlane::Vertical(0), 30_f64.to_radians(), 0.0, 30.0);
    near(LidPlane::Vertical(0), -30_f64.to_radians(), 180.0, 30.0);
    near(LidPlane::Vertical(15), 80_f64.to_radians(), 15.0, 80.0);
    near(LidPlane::Horizontal, 10_f64.to_radians(), 10.0, 90.0);
}

#[test]
fn a_uniform_aperture_is_the_ideal_diffuser_of_its_flux() {
    for (surface, level) in [(Surface::Facade, FRAC_PI_2), (Surface::Roof, 0.0)] {
        let lid = lambert(surface);
        let aim = Aim::of(surface);
        let flux = PI * 1000.0 * lid.area();
        for section in [LidPlane::Vertical(0), LidPlane::Vertical(90), LidPlane::Horizontal] {
            for k in 0..24 {
                let d = section.direction(aim, f64::from(k) * TAU / 24.0 + 0.01);
                assert!((intensity(&lid, d) - diffuser(flux, d)).abs() < 1e-6);
            }
        }
        // A façade's largest intensity is level into the room, a roof's straight down: L·A.
        assert!((intensity(&lid, LidPlane::Vertical(0).direction(aim, level)) - 3000.0).abs() < 1e-9);
    }
}

#[test]
fn the_plane_of_the_peak_is_drawn() {
    let peaks = |c: f64, gamma: f64| Peaks {
        scattered: Some(Peak { intensity: 1.0, c: c.to_radians(), gamma: gamma.to_radians() }),
        beam: None,
        step: Step::NORMAL,
    };
    let names = |surface, peaks: &Peaks| -> Vec<String> {
        vertical_planes(surface, Some(peaks)).iter().map(LidPlane::label).collect()
    };
    assert_eq!(names(Surface::Facade, &peaks(345.0, 80.0)), ["C0–C180", "C345–C165"]);
    // Across the façade already, or straight down: the usual two.
    for usual in [peaks(180.0, 80.0), peaks(77.0, 0.0)] {
        assert_eq!(names(Surface::Facade, &usual), ["C0–C180", "C90–C270"]);
    }
    assert_eq!(names(Surface::Roof, &peaks(45.0, 30.0)), ["C0–C180", "C45–C225", "C90–C270"]);
    assert_eq!(names(Surface::Roof, &peaks(270.0, 30.0)), ["C0–C180", "C270–C90"]);
}

#[test]
fn intensities_of_a_square_metre_say_so() {
    let scaling = Scaling { factor: 0.5, per_area: true };
    assert_eq!(scaling.text(30_000.0), "15.0 kcd per m²");
    assert_eq!(scaling.unit(), "cd per m² of aperture");
    assert_eq!(Scaling { factor: 1.0, per_area: false }.text(30_000.0), "30.0 kcd");
}
