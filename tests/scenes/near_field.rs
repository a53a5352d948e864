//! Ways to integrate an aperture's light at a sensor: the ordinary one against closed forms in stiff places, the others
//! against it, parts of an aperture against the whole, and the notes on structure.

use crate::rooms::*;
use cfs::compute::direction::Surface;
use cfs::compute::lid::Emission;
use cfs::compute::quadrature::Tolerance;
use cfs::compute::room::aperture::Aperture;
use cfs::compute::room::direct::Sensor;
use cfs::compute::room::near_field::{Integrator, NearField};
use cfs::study::Scene;
use glam::DVec3;

const TOLERANCE: Tolerance = Tolerance::relative(1e-9);

fn emission(scene: &Scene) -> Emission {
    Emission::new(scene.apertures[0].system.dataset.transmission().unwrap(), &scene.facing(0))
}

/// Illuminances by one method for the first aperture of a scene, the aperture's geometry replaced.
fn by(method: NearField, scene: &Scene, aperture: &Aperture, sensors: &[Sensor]) -> Vec<f64> {
    let (emission, facing) = (emission(scene), scene.facing(0));
    let integrator = Integrator::new(method, aperture, &emission, &facing, TOLERANCE);
    sensors.iter().map(|sensor| integrator.illuminance(sensor).all.value).collect()
}

fn window() -> Aperture {
    Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 1.0), size: [3.0, 1.5] }
}

fn scenes() -> Vec<(&'static str, Scene)> {
    let sky = clear(35.0, 190.0, 60_000.0);
    [TRANSPARENT, DIFFUSE, MADE]
        .map(|system| {
            let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], system)];
            (system, Text { apertures, sky: sky.clone(), ground: 0.2, ..Text::default() }.scene_with(klems(rough)))
        })
        .into()
}

fn sensors(positions: &[[f64; 3]]) -> Vec<Sensor> {
    let normals = [DVec3::Z, DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z, DVec3::new(0.3, -0.6, 0.5).normalize()];
    positions.iter().flat_map(|p| normals.map(|normal| Sensor { position: DVec3::from_array(*p), normal })).collect()
}

/// Sky component of the overcast sky through an unglazed window for a horizontal sensor at sill height beside the
/// window's lower corner, as a share of E_h (closed form after Hopkinson; w, h, d in m).
fn sky_component(w: f64, h: f64, d: f64) -> f64 {
    let k = h / d;
    let c = (1.0 + k * k).sqrt();
    let p = (w / d).atan();
    let first = 0.5 * (p - (p.tan() / c).atan() / c);
    let second = (k * p.sin() / c).asin() - k * p.sin() / (c * c * (c * c - (k * p.sin()).powi(2)).sqrt());
    3.0 / (7.0 * std::f64::consts::PI) * (first + 2.0 / 3.0 * second)
}

#[test]
fn overcast_sky_through_a_window_has_a_closed_form() {
    assert!((sky_component(1.0, 1.0, 1.0) - 0.045_251).abs() < 1e-6);
    for (w, h, d) in [(1.0, 1.0, 1.0), (2.0, 1.5, 3.0), (3.0, 1.5, 1e-3), (3.0, 1.5, 0.02), (3.0, 1.5, 100.0)] {
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(1.0, 0.0, 1.0), size: [w, h] };
        let sensor = Sensor { position: DVec3::new(1.0, d, 1.0), normal: DVec3::Z };
        let e = by(NearField::SolidAngle, &Text::default().scene(), &aperture, &[sensor])[0];
        let exact = 10_000.0 * sky_component(w, h, d);
        assert!((e / exact - 1.0).abs() < 1e-6, "{w} × {h} at {d}: {e} {exact}");
    }
}

#[test]
fn diffuse_window_facing_and_grazing() {
    // L = 1000 facing 1.2 × 1.0 m on its axis; the closed forms of the corner function.
    let text = Text {
        apertures: vec![facade([0.5, 1.0], [3.0, 1.5], DIFFUSE)],
        sky: UNIFORM.into(),
        ground: 1.0,
        ..Text::default()
    };
    let scene = text.scene();
    let luminance = emission(&scene).uniform.value;
    let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(1.4, 0.0, 1.0), size: [1.2, 1.0] };
    for (d, expected) in [(1.0, 857.324), (10.0, 11.9514), (0.2, 2827.90)] {
        let sensor = Sensor { position: DVec3::new(2.0, d, 1.5), normal: DVec3::NEG_Y };
        let e = by(NearField::SolidAngle, &scene, &aperture, &[sensor])[0] / luminance * 1000.0;
        assert!((e / expected - 1.0).abs() < 1e-5, "{d}: {e}");
    }
    // Far away it is a point: 100 m and 10 km, facing and horizontal.
    for d in [100.0, 10_000.0] {
        for normal in [DVec3::NEG_Y, DVec3::Z] {
            let below = if normal == DVec3::Z { 0.3 * d } else { 0.0 };
            let sensor = Sensor { position: DVec3::new(2.0, d, 1.5 - below), normal };
            let r2 = d * d + below * below;
            let cosine = if normal == DVec3::Z { below } else { d } / r2.sqrt();
            let point = luminance * 1.2 * (d / r2.sqrt()) * cosine / r2;
            let e = by(NearField::SolidAngle, &scene, &aperture, &[sensor])[0];
            assert!((e / point - 1.0).abs() < 3e-4 * (100.0 / d).powi(2) + 1e-9, "{d} {normal}: {e} {point}");
        }
    }
    // A horizontal sensor d below the sill of a wide, high window and d before it: the window from 45° up to the
    // zenith, E = L (π/2) sin 45°.
    let wide = Aperture { surface: Surface::Facade, corner: DVec3::new(-1e4, 0.0, 1.0), size: [2e4, 1e4] };
    for d in [1e-6, 1e-3, 0.1] {
        let sensor = Sensor { position: DVec3::new(2.0, d, 1.0 - d), normal: DVec3::Z };
        let e = by(NearField::SolidAngle, &scene, &wide, &[sensor])[0];
        let exact = luminance * std::f64::consts::FRAC_PI_2 * 0.5_f64.sqrt();
        assert!((e / exact - 1.0).abs() < 1e-4 * (1.0 + d), "{d}: {e} {exact}");
    }
}

#[test]
fn beside_the_opening_in_its_plane_and_behind_it_there_is_nothing_by_any_method() {
    let behind = sensors(&[[2.0, 0.0, 0.5], [2.0, -0.5, 1.5], [0.4, 0.0, 1.0]]);
    for (_, scene) in scenes() {
        for method in methods(64) {
            assert!(by(method, &scene, &window(), &behind).iter().all(|e| *e == 0.0), "{method:?}");
        }
    }
}

fn methods(n: usize) -> [NearField; 5] {
    [
        NearField::SolidAngle,
        NearField::Subdivision(Some([n, n])),
        NearField::Subdivision(None),
        NearField::MonteCarlo(n * n),
        NearField::ProfileTable(4 * n),
    ]
}

#[test]
fn the_other_methods_converge_to_the_ordinary_one() {
    let list = sensors(&[[2.0, 2.0, 0.85], [0.2, 1.0, 0.1], [2.0, 0.5, 1.7]]);
    for (name, scene) in scenes() {
        let exact = by(NearField::SolidAngle, &scene, &window(), &list);
        let mean = exact.iter().sum::<f64>() / exact.len() as f64;
        let rms = |method| {
            let e = by(method, &scene, &window(), &list);
            (e.iter().zip(&exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / exact.len() as f64).sqrt() / mean
        };
        for (coarse, fine, bar) in [(methods(4), methods(64), [0.0, 2e-3, 4e-2, 2e-2, 2e-3])] {
            for ((coarse, fine), bar) in coarse.into_iter().zip(fine).zip(bar).skip(1) {
                let (before, after) = (rms(coarse), rms(fine));
                assert!(after < bar, "{name}, {fine:?}: {after}");
                assert!(
                    after < 0.5 * before || after < 1e-12 || fine == NearField::Subdivision(None),
                    "{name}, {fine:?}: {before} {after}"
                );
            }
        }
    }
}

#[test]
fn monte_carlo_knows_its_standard_error() {
    let list: Vec<Sensor> = (0..200)
        .map(|i| Sensor {
            position: DVec3::new(0.2 + 0.018 * f64::from(i), 0.4 + 0.02 * f64::from(i), 0.85),
            normal: DVec3::Z,
        })
        .collect();
    for (name, scene) in scenes() {
        let exact = by(NearField::SolidAngle, &scene, &window(), &list);
        let (emission, facing) = (emission(&scene), scene.facing(0));
        let aperture = window();
        let method = Integrator::new(NearField::MonteCarlo(400), &aperture, &emission, &facing, TOLERANCE);
        let within = |factor: f64| {
            list.iter()
                .zip(&exact)
                .filter(|(sensor, exact)| {
                    let e = method.illuminance(sensor).all;
                    (e.value - **exact).abs() <= factor * e.error
                })
                .count()
        };
        // 68 % and 95.4 % of 200, each with four standard deviations of the count.
        assert!((110..=163).contains(&within(1.0)), "{name}: {}", within(1.0));
        assert!(within(2.0) >= 178, "{name}: {}", within(2.0));
    }
}

/// `m` × `n` equal parts of an aperture, along x_F first.
fn split(whole: &Aperture, m: usize, n: usize) -> Vec<Aperture> {
    let size = [whole.size[0] / m as f64, whole.size[1] / n as f64];
    let (u, v) = (whole.surface.room_from_facade(DVec3::X), whole.surface.room_from_facade(DVec3::Y));
    (0..m * n)
        .map(|k| whole.corner + u * ((k % m) as f64 * size[0]) + v * ((k / m) as f64 * size[1]))
        .map(|corner| Aperture { corner, size, ..*whole })
        .collect()
}

#[test]
fn parts_of_an_aperture_add_up_to_the_whole() {
    let list = sensors(&[[2.0, 2.0, 0.85], [0.2, 1.0, 0.1], [2.0, 0.5, 1.7], [2.0, 1e-3, 0.999], [3.9, 5.9, 2.9]]);
    // Without the disc: at a border between two parts its pieces' areas add up to 1e-4 only.
    let sky = "model = \"cie\"\ntype = 12\ndiffuse_horizontal = 12000.0\nsun = { altitude = 35.0, azimuth = 190.0 }";
    for system in [TRANSPARENT, DIFFUSE, MADE] {
        let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], system)];
        let scene = Text { apertures, sky: sky.into(), ground: 0.2, ..Text::default() }.scene_with(klems(rough));
        let whole = by(NearField::SolidAngle, &scene, &window(), &list);
        let mut sum = vec![0.0; list.len()];
        let parts = split(&window(), 3, 4);
        assert_eq!(parts.len(), 12);
        assert!((parts.iter().map(Aperture::area).sum::<f64>() - 4.5).abs() < 1e-12);
        for part in &parts {
            for (sum, e) in sum.iter_mut().zip(by(NearField::SolidAngle, &scene, part, &list)) {
                *sum += e;
            }
        }
        for ((a, b), sensor) in whole.iter().zip(&sum).zip(&list) {
            let slack = if system == TRANSPARENT { 4e-9 } else { 1e-9 };
            assert!((a - b).abs() <= slack * a + 1e-12, "{system}: {a} {b} at {sensor:?}");
        }
    }
}

#[test]
fn distance_to_an_aperture() {
    let window = window();
    for (point, expected) in [
        ([2.0, 0.7, 1.2], 0.7),
        ([0.5, 0.0, 1.0], 0.0),
        ([0.2, 0.4, 1.0], 0.5),
        ([3.8, 0.0, 0.6], 0.5),
        ([3.8, 1.2, 2.9], 1.3),
    ] {
        assert!((window.distance(DVec3::from_array(point)) - expected).abs() < 1e-12, "{point:?}");
    }
}

#[test]
fn structure_comes_from_the_dataset_or_the_scene() {
    let mut dataset = klems(rough);
    let scene_of = |dataset, extra: &str| {
        let aperture = format!("{}\n{extra}", facade([0.5, 1.0], [3.0, 1.5], MADE));
        let sensors = points(&[[2.0, 0.1, 1.5], [2.0, 0.5, 0.85], [2.0, 0.3, 1.5]], [0.0, 0.0, 1.0]);
        Text { apertures: vec![aperture], sensors, ..Text::default() }.scene_with(dataset)
    };
    assert_eq!(scene_of(dataset.clone(), "").apertures[0].homogeneity_distance(), None);
    dataset.structure = Some(0.072);
    let scene = scene_of(dataset.clone(), "");
    assert!((scene.apertures[0].homogeneity_distance().unwrap() - 0.216).abs() < 1e-12);
    assert_eq!(scene.too_near(), [1]);
    assert_eq!(scene_of(dataset.clone(), "structure = 0.12").too_near(), [2]);
    let text = Text {
        apertures: vec![format!("{}\nstructure = -1.0", facade([0.5, 1.0], [3.0, 1.5], MADE))],
        ..Text::default()
    };
    let error = text.resolve(&Made(Some(dataset))).unwrap_err().to_string();
    assert!(error.starts_with("aperture[1].structure"), "{error}");
}

#[test]
fn scenes_choose_a_method_and_the_plan_says_which() {
    let with = |compute: &str| Text { compute: compute.into(), ..Text::default() };
    let ordinary = totals(&with("").result());
    let result = with("near_field = \"subdivision\"\nnear_field_samples = 4096").result();
    let stage = result.plan.stages.iter().find(|stage| stage.name == "near field").unwrap();
    assert!(stage.reason.contains("64 × 64 point luminaires"), "{}", stage.reason);
    for (a, b) in totals(&result).iter().zip(&ordinary) {
        assert!((a / b - 1.0).abs() < 1e-2 && a != b, "{a} {b}");
    }
    for (compute, word) in [
        ("near_field = \"guess\"", "compute.near_field"),
        ("near_field_samples = 10", "compute.near_field_samples"),
        ("near_field = \"monte-carlo\"\nnear_field_samples = 0", "compute.near_field_samples"),
    ] {
        let error = with(compute).resolve(&Made(None)).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
    }
}
