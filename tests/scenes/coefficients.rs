//! Prepared scenes against the ordinary computation, and against conservation of what is linear.

use crate::rooms::*;
use cfs::compute::angle::Bearing;
use cfs::compute::basis::RingBasis;
use cfs::compute::btdf::{Btdf, Dataset, Indicatrices, Scattered};
use cfs::compute::direction::{Dir, Incident};
use cfs::compute::estimate::{Estimate, Silent};
use cfs::compute::incidence::superpose::sub_patches;
use cfs::compute::sky::{Distribution, Outside, Scan};
use cfs::study::{Coefficients, Scene, Session};
use std::sync::Arc;

/// What patches send to sensors is kept in single precision: sums of such numbers are off by so much, relative.
const HALF_THE_DIGITS: f64 = 5e-6;

/// A room that reflects, under a skyline, before a ground.
fn text(apertures: Vec<String>, skyline: f64, sky: &str) -> Text {
    let obstruction = format!("\nobstruction = {{ altitude = {skyline:?}, luminance = 900.0 }}");
    Text {
        reflectance: [0.2, 0.5, 0.7],
        apertures,
        azimuth: 160.0,
        ground: 0.2,
        sky: format!("{sky}{}", if skyline > 0.0 { obstruction } else { String::new() }),
        ..Text::default()
    }
}

/// A lobe about the direct direction and a haze, at 145 directions.
fn hazy_lobe() -> Dataset {
    let incident: Vec<_> = RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect();
    let emergent = sub_patches(3_f64.to_radians());
    let mut values = Vec::with_capacity(incident.len() * emergent.len());
    for i in &incident {
        let towards: Vec<f64> = emergent
            .cells()
            .map(|o| (-0.5 * (i.0.vector().distance(o.centre().vector()) / 0.1).powi(2)).exp())
            .collect();
        let flux: f64 = emergent.cells().zip(&towards).map(|(o, l)| o.projected_solid_angle() * l).sum();
        values.extend(towards.iter().map(|l| 0.5 * l / flux + 0.05));
    }
    let data = Indicatrices::new(incident, emergent, values).unwrap();
    let mut dataset = klems(|_, _| 0.1);
    dataset.visible.transmission_front =
        Some(Btdf { regular: None, scattered: Some(Scattered::Directions(Arc::new(data))) });
    dataset
}

/// The prepared scene gives what the ordinary way gives, within what both state and within `bound` of the value.
fn agree(name: &str, prepared: &Scene, others: &[Scene], bound: f64) {
    let session = Session::new();
    // The sun by the data's cells: what is taken out of them is in doubt by more than the bounds here.
    let prepared = &Scene { beams: false, ..prepared.clone() };
    let coefficients = Coefficients::new(&session, prepared, &Silent).unwrap();
    for scene in others {
        let scene = &Scene { beams: false, ..scene.clone() };
        let ordinary: Vec<Estimate> = session.room(scene, &Silent).unwrap().sensors.iter().map(|s| s.total()).collect();
        let mut quick = coefficients.sky_estimate(&scene.outside);
        let mut bare = coefficients.sky(&scene.outside);
        if let Some(sun) = &scene.sun {
            quick.iter_mut().zip(coefficients.sun_estimate(sun)).for_each(|(a, b)| *a += b);
            bare.iter_mut().zip(coefficients.sun(sun)).for_each(|(a, b)| *a += b);
        }
        let mean = ordinary.iter().map(|e| e.value).sum::<f64>() / ordinary.len() as f64;
        assert!(mean > 1.0, "{name}: {mean}");
        let worst = ordinary
            .iter()
            .zip(&quick)
            .map(|(a, b)| (a.value - b.value).abs() / a.value.max(0.05 * mean))
            .fold(0.0, f64::max);
        let stated = ordinary.iter().zip(&quick).map(|(a, b)| b.error / a.value.max(0.05 * mean)).fold(0.0, f64::max);
        let session_stated = ordinary.iter().map(|a| a.error / a.value.max(0.05 * mean)).fold(0.0, f64::max);
        println!(
            "{name}: {worst:.2e} off, stated {stated:.2e} (ordinary {session_stated:.2e}), directions {:.1e}",
            coefficients.error()
        );
        for ((a, b), bare) in ordinary.iter().zip(&quick).zip(&bare) {
            assert!((a.value - b.value).abs() <= a.error + b.error, "{name}: {a:?} {b:?}");
            assert!((b.value / bare - 1.0).abs() < HALF_THE_DIGITS, "{name}: {b:?} {bare}");
        }
        assert!(worst < bound, "{name}: {worst}");
        assert!(stated < 0.05, "{name}: {stated}");
    }
}

fn skies(skyline: f64, apertures: &[String], make: &dyn Fn(&Text) -> Scene) -> Vec<Scene> {
    [clear(41.0, 190.0, 0.0), clear(30.0, 120.0, 60_000.0), OVERCAST.into(), UNIFORM.into()]
        .iter()
        .map(|sky| make(&text(apertures.to_vec(), skyline, sky)))
        .collect()
}

#[test]
fn cells_lambert_and_straight_light_agree_with_the_ordinary_way() {
    let one = |system: &str| vec![facade([0.5, 1.0], [3.0, 1.5], system)];
    for (name, apertures, skyline) in [
        ("Lambert", one(DIFFUSE), 0.0),
        ("Klems", one(MADE), 12.0),
        ("transparent", one(TRANSPARENT), 0.0),
        ("Klems in the roof", vec![roof([0.5, 1.0], [2.0, 1.5], MADE)], 0.0),
        (
            "façade and roof",
            vec![
                facade([0.5, 1.0], [1.0, 1.5], DIFFUSE),
                facade([2.0, 1.0], [1.5, 1.5], TRANSPARENT),
                roof([0.5, 2.0], [2.0, 1.0], MADE),
            ],
            8.0,
        ),
    ] {
        // Light that goes straight on meets the surfaces by patches of 7.5°.
        let bound = if apertures.iter().any(|body| body.contains("transparent")) { 1.2e-2 } else { 6e-3 };
        let make = |text: &Text| text.scene_with(klems(rough));
        let others = skies(skyline, &apertures, &make);
        agree(name, &make(&text(apertures.clone(), skyline, OVERCAST)), &others, bound);
    }
}

#[test]
fn indicatrices_agree_with_the_ordinary_way() {
    let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], MADE)];
    let dataset = hazy_lobe();
    let make = |text: &Text| text.scene_with(dataset.clone());
    let others = skies(0.0, &apertures, &make);
    agree("lobes", &make(&text(apertures.clone(), 0.0, OVERCAST)), &others[..3], 1e-2);
    let by_patch =
        |text: &Text| Text { compute: "interpolation = \"patch\"".into(), ..text.clone() }.scene_with(dataset.clone());
    let others = skies(0.0, &apertures, &by_patch);
    agree("nearest", &by_patch(&text(apertures.clone(), 0.0, OVERCAST)), &others[..2], 6e-3);
}

#[test]
fn a_measured_sky_and_another_skyline_go_the_long_way_and_agree() {
    let apertures = vec![facade([0.5, 1.0], [1.2, 1.5], MADE), facade([2.0, 1.0], [1.5, 1.5], TRANSPARENT)];
    let prepared = text(apertures.clone(), 0.0, OVERCAST).scene_with(klems(rough));
    let mut scanned = prepared.clone();
    let values: Vec<f64> = (0..145).map(|i| 2000.0 + 150.0 * f64::from(i % 37)).collect();
    scanned.outside = Outside::measured(Scan::new(&values).unwrap()).with_ground(0.2, 0.0).unwrap();
    let obstructed = text(apertures, 25.0, OVERCAST).scene_with(klems(rough));
    agree("long way", &prepared, &[scanned, obstructed], 6e-3);
}

#[test]
fn hours_asked_together_are_those_asked_alone_to_the_last_bit() {
    let apertures = vec![facade([0.5, 1.0], [1.2, 1.5], MADE), facade([2.0, 1.0], [1.5, 1.5], TRANSPARENT)];
    let scene = text(apertures, 12.0, OVERCAST).scene_with(klems(rough));
    let session = Session::new();
    let mut prepared = Coefficients::new(&session, &scene, &Silent).unwrap();
    prepared.keep_year(&session, (1, 71), 71);
    let sky = |k: usize| {
        let sun = Dir::from_altitude_bearing(0.02 * k as f64, Bearing::from_degrees(90.0 + 2.0 * k as f64));
        let ground = Outside::new(Distribution::cie(12, sun).unwrap(), 5e3 + 200.0 * k as f64).unwrap();
        ground.with_ground(0.2, 0.0).unwrap().with_skyline(scene.outside.skyline_altitude(), 900.0).unwrap()
    };
    let skies: Vec<Outside> = (0..71).map(sky).collect();
    let hours: Vec<_> = skies.iter().enumerate().map(|(k, sky)| (k, sky, None)).collect();
    let all = prepared.hours_estimate(&hours);
    assert!(all.len() == 71 && all[0] != all[1]);
    for part in [1, 3, 32, 50] {
        let again: Vec<Vec<Estimate>> = hours.chunks(part).flat_map(|part| prepared.hours_estimate(part)).collect();
        assert_eq!(again, all, "in parts of {part}");
    }
}

#[test]
fn apertures_that_reflect_by_direction_are_part_of_it() {
    let mut dataset = klems(rough);
    let mirror = klems(|i, o| if i.vector().distance(o.vector()) < 0.3 { 4.0 } else { 0.2 });
    dataset.visible.reflection_back = mirror.visible.transmission_front;
    let make = |sky: &str| {
        let apertures = vec![facade([0.3, 0.5], [3.4, 2.2], MADE)];
        Text { compute: "back_reflection = \"directional\"".into(), ..text(apertures, 0.0, sky) }
            .scene_with(dataset.clone())
    };
    let scene = make(OVERCAST);
    assert!(scene.apertures[0].back_reflection().is_some());
    agree("mirroring", &scene, &[make(&clear(41.0, 190.0, 50_000.0))], 6e-3);
}

#[test]
fn beams_reach_apertures_that_reflect_by_direction() {
    let mut dataset = klems(rough);
    let mirror = klems(|i, o| if i.vector().distance(o.vector()) < 0.3 { 4.0 } else { 0.2 });
    dataset.visible.reflection_back = mirror.visible.transmission_front;
    let make = |sky: &str| {
        let apertures = vec![facade([0.3, 0.5], [1.6, 2.2], MADE), facade([2.2, 0.5], [1.5, 2.0], TRANSPARENT)];
        text(apertures, 0.0, sky).scene_with(dataset.clone())
    };
    let scene = make(OVERCAST);
    assert!(scene.apertures[0].back_reflection().is_some(), "by cells wherever there are any");
    agree("sun before mirrors", &scene, &[make(&clear(41.0, 190.0, 50_000.0))], 6e-3);
}

/// Where products follow each other, light is thrown back evenly over an aperture that is a Lambertian mirror of the room:
/// an approximation beside a patch of sun, which the errors hold.
#[test]
fn what_is_thrown_back_evenly_stays_within_the_errors() {
    let white = format!("{TRANSPARENT}\nreflectance = 0.4");
    let scene = text(vec![facade([0.5, 1.0], [3.0, 1.5], &white)], 0.0, &clear(41.0, 190.0, 50_000.0)).scene();
    let light = |session: &Session| -> Vec<Estimate> {
        let coefficients = Coefficients::new(session, &scene, &Silent).unwrap();
        let sun = coefficients.sun_estimate(&scene.sun.unwrap());
        coefficients.sky_estimate(&scene.outside).into_iter().zip(sun).map(|(sky, sun)| sky + sun).collect()
    };
    let (own, evenly) = (light(&Session::new()), light(&Session::new().passing()));
    for (a, b) in own.iter().zip(&evenly) {
        assert!(
            (a.value - b.value).abs() <= a.error + b.error && (b.value / a.value - 1.0).abs() < 0.02,
            "{a:?} {b:?}"
        );
    }
    assert!(own.iter().zip(&evenly).any(|(a, b)| (b.value / a.value - 1.0).abs() > 1e-5));
}

#[test]
fn another_state_in_a_session_is_what_it_is_by_itself() {
    let state = |strength: f64| {
        let mut dataset = klems(rough);
        let mirror = klems(|i, o| if i.vector().distance(o.vector()) < 0.3 { strength } else { 0.1 });
        dataset.visible.reflection_back = mirror.visible.transmission_front;
        text(vec![facade([0.3, 0.5], [3.4, 2.2], MADE)], 0.0, OVERCAST).scene_with(dataset)
    };
    let session = Session::new();
    let light =
        |session: &Session, scene: &Scene| Coefficients::new(session, scene, &Silent).unwrap().sky(&scene.outside);
    let (first, second) = (state(4.0), state(1.0));
    let before = light(&session, &first);
    let after = light(&session, &second);
    assert_eq!(after, light(&Session::new(), &second));
    assert!(before.iter().zip(&after).all(|(a, b)| a > b), "more is thrown back by the first");
}

#[test]
fn light_adds_up_and_scales() {
    let prepared = text(vec![facade([0.5, 1.0], [3.0, 1.5], MADE)], 0.0, OVERCAST).scene_with(klems(rough));
    let coefficients = Coefficients::new(&Session::new(), &prepared, &Silent).unwrap();
    let sun = Dir::from_altitude_bearing(0.7, Bearing::from_degrees(170.0));
    let outside = |e: f64, ground: f64| {
        Outside::new(Distribution::cie(12, sun).unwrap(), e).unwrap().with_ground(ground, 0.0).unwrap()
    };
    let (sky, both) = (coefficients.sky(&outside(9000.0, 0.0)), coefficients.sky(&outside(9000.0, 0.4)));
    let ground_alone =
        coefficients.sky(&Outside::new(Distribution::uniform(), 0.0).unwrap().with_ground(0.4, 9000.0).unwrap());
    let twice = coefficients.sky(&outside(18_000.0, 0.0));
    for (((a, b), c), d) in sky.iter().zip(&both).zip(&ground_alone).zip(&twice) {
        assert!(
            ((a + c) / b - 1.0).abs() < HALF_THE_DIGITS && (d / a - 2.0).abs() < HALF_THE_DIGITS,
            "{a} {b} {c} {d}"
        );
        assert!(*c > 0.0);
    }
}

#[test]
fn methods_for_comparison_are_refused() {
    let text = Text {
        compute: "near_field = \"monte-carlo\"".into(),
        ..text(vec![facade([0.5, 1.0], [3.0, 1.5], DIFFUSE)], 0.0, OVERCAST)
    };
    let refused = Coefficients::new(&Session::new(), &text.scene(), &Silent).err().unwrap().to_string();
    assert!(refused.contains("compute.near_field"), "{refused}");
}
