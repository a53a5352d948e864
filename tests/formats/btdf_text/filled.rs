//! What is not in the file: incidences that a symmetry adds, cells between points.

use super::{File, codes, function, uneven, vector};
use cfs::compute::btdf::{Component, Dataset, Indicatrices, Scattered, Severity};
use cfs::compute::direction::{Dir, Emergent, Incident};
use cfs::formats::btdf_text::{read, write};
use glam::DVec3;
use std::f64::consts::PI;
use std::fmt::Write as _;

/// Left-right symmetric, not up-down.
fn left_right(e: DVec3, a: DVec3) -> f64 {
    0.04 * (0.4 * e.x * a.x + 0.5 * e.y - 0.7 * a.y).exp()
}

#[test]
fn only_declared_symmetry_fills_what_is_missing() {
    let full = File::new(Component::TransmissionFront);
    let mut half = full.clone();
    half.directions.retain(|[_, phi]| *phi <= 90.0 || *phi >= 270.0);
    half.more = "symmetry = \"left-right\"\n".into();
    let (all, filled) = (full.read(left_right), half.read(left_right));
    let rows = |dataset: &Dataset| match &function(dataset, Component::TransmissionFront).scattered {
        Some(Scattered::Directions(data)) => Indicatrices::clone(data),
        _ => panic!("directions"),
    };
    let (a, b) = (rows(&all), rows(&filled));
    assert!(b.lattice().is_some() && codes(&filled) == ["symmetry-filled"]);
    for k in 0..145 {
        for (x, y) in a.row(k).iter().zip(b.row(k).iter()) {
            assert!((x - y).abs() < 1e-12, "{k}");
        }
    }
    // Not declared: a warning, and a list of what is there instead of zeros.
    let missing = File { more: String::new(), ..half.clone() }.read(left_right);
    assert!(codes(&missing).contains(&"incomplete-incidence"));
    let warning = &missing.findings.iter().find(|f| f.code == "incomplete-incidence").unwrap();
    assert!(warning.severity == Severity::Warning && warning.message.contains("69 of the 145"), "{}", warning.message);
    let list = rows(&missing);
    assert!(list.lattice().is_none() && list.incident().len() == half.directions.len());
    assert!(list.tau_by_direction().iter().all(|tau| *tau > 0.0));
    assert!(list.tau(Incident(Dir::from_unit(vector(60.0, 180.0)))) > 0.0);
    // Declared but not so.
    let lie = full.clone();
    let lie = File { more: "symmetry = \"up-down\"\n".into(), ..lie }.read(|e, a| 0.04 * (3.0 * e.y * a.x).exp());
    assert!(codes(&lie).contains(&"symmetry-broken"));
    // Listed directions get their images as well.
    let listed = File { incidence: "listed", directions: vec![[40.0, 30.0], [0.0, 0.0]], ..half.clone() };
    let images = rows(&listed.read(left_right));
    assert_eq!(images.incident().len(), 3);
    let mirrored = Incident(Dir::from_unit(vector(40.0, 150.0)));
    let out = Emergent(Dir::from_unit(vector(135.0, 225.0)));
    let expected = left_right(vector(40.0, 150.0), vector(135.0, 225.0));
    assert!((images.q(mirrored, out) - expected).abs() < 1e-12);
}

#[test]
fn both_and_rotational_symmetry() {
    let turned = |e: DVec3, a: DVec3| {
        // Depends on θ_e, θ_a and the angle between: rotational.
        0.03 * (1.0 + e.z) * (1.5 * e.dot(-a)).exp()
    };
    let full = File::new(Component::TransmissionFront).read(turned);
    for (symmetry, keep) in [
        ("both", Box::new(|[_, phi]: &[f64; 2]| *phi <= 90.0) as Box<dyn Fn(&[f64; 2]) -> bool>),
        ("rotational", Box::new(|[_, phi]: &[f64; 2]| *phi == 0.0)),
    ] {
        let mut file = File::new(Component::TransmissionFront);
        file.directions.retain(|d| keep(d));
        file.more = format!("symmetry = \"{symmetry}\"\n");
        let dataset = file.read(turned);
        let [a, b] = [&full, &dataset].map(|d| match &function(d, Component::TransmissionFront).scattered {
            Some(Scattered::Directions(data)) => data.clone(),
            _ => panic!(),
        });
        assert!(b.lattice().is_some(), "{symmetry}: {:?}", dataset.findings);
        for k in 0..145 {
            // Turning keeps τ to rounding; q only to the curvature within a cell when sectors do not fit.
            assert!((a.tau_by_direction()[k] - b.tau_by_direction()[k]).abs() < 2e-4, "{symmetry} {k}");
            for (x, y) in a.row(k).iter().zip(b.row(k).iter()) {
                assert!((x - y).abs() < if symmetry == "both" { 1e-12 } else { 0.05 * x }, "{symmetry} {k}: {x} {y}");
            }
        }
    }
}

#[test]
fn points_on_rings_become_the_cells_around_them() {
    let file = File::new(Component::TransmissionFront);
    // 5° rings with 15° steps, the normal once.
    let mut emergent = vec![[180.0, 0.0]];
    for theta in (1..18).map(|k| 180.0 - 5.0 * f64::from(k)) {
        emergent.extend((0..24).map(|k| [theta, 15.0 * f64::from(k)]));
    }
    let dataset = read(file.points(&emergent, uneven).as_bytes()).unwrap();
    let btdf = function(&dataset, Component::TransmissionFront);
    let (e, a) = (vector(48.0, 105.0), vector(140.0, 255.0));
    assert_eq!(btdf.q(Incident(Dir::from_unit(e)), Emergent(Dir::from_unit(a))), uneven(e, a));
    let finding = dataset.findings.iter().find(|f| f.code == "points-resampled").unwrap();
    assert!(finding.message.contains("18 rings, 409 cells"), "{}", finding.message);
    // τ against dense integration of the formula.
    let tau = integral(|a| uneven(e, a));
    assert!((btdf.tau(Incident(Dir::from_unit(e))) - tau).abs() < 2e-3 * tau);
    let again = read(&write(&dataset).unwrap().bytes).unwrap();
    assert!(
        (function(&again, Component::TransmissionFront).tau_hemispherical() - btdf.tau_hemispherical()).abs() < 1e-12
    );
}

/// ∫ q cosθ dω over the inner hemisphere.
fn integral(q: impl Fn(DVec3) -> f64) -> f64 {
    let (rings, sectors) = (200, 400);
    let mut sum = 0.0;
    for i in 0..rings {
        let theta = ((f64::from(i) + 0.5) / f64::from(rings)).sqrt().asin().to_degrees();
        for j in 0..sectors {
            sum += q(vector(180.0 - theta, (f64::from(j) + 0.5) * 360.0 / f64::from(sectors)));
        }
    }
    PI * sum / f64::from(rings * sectors)
}

#[test]
fn scattered_points_keep_their_flux_within_the_stated_error() {
    // A lobe of 15° on haze, 2500 points in a golden spiral that is turned from incidence to incidence.
    let lobe = |e: DVec3, a: DVec3| 0.05 + 2.0 * (((-e).dot(a) - 1.0) / 0.07).exp();
    let mut file = File::new(Component::TransmissionFront);
    file.incidence = "listed";
    file.directions = vec![[0.0, 0.0], [30.0, 90.0], [60.0, 200.0]];
    let mut text = file.header("points");
    for (k, [t, p]) in file.directions.iter().enumerate() {
        for i in 0..2500 {
            let theta = (1.0 - (f64::from(i) + 0.5) / 2500.0).acos().to_degrees();
            let phi = (f64::from(i) * 137.507_764 + 31.0 * k as f64) % 360.0;
            let _ =
                writeln!(text, "{t} {p} {} {phi} {}", 180.0 - theta, lobe(vector(*t, *p), vector(180.0 - theta, phi)));
        }
    }
    let dataset = read(text.as_bytes()).unwrap();
    let btdf = function(&dataset, Component::TransmissionFront);
    let finding = dataset.findings.iter().find(|f| f.code == "points-resampled").unwrap();
    let stated: f64 = finding.message.split("misses ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!(stated > 0.0 && stated < 10.0, "{}", finding.message);
    for [t, p] in &file.directions {
        let e = vector(*t, *p);
        let tau = integral(|a| lobe(e, a));
        let got = btdf.tau(Incident(Dir::from_unit(e)));
        assert!((got / tau - 1.0).abs() < 0.01 * stated, "{t} {p}: {got} {tau} {stated}");
        // The lobe's middle goes straight on.
        let peak = btdf.q(Incident(Dir::from_unit(e)), Emergent(Dir::from_unit(-e)));
        assert!((peak / 2.05 - 1.0).abs() < 0.1, "{peak}");
    }
}
