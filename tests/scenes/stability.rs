//! Stiff and extreme scenes: whatever the geometry, sky and data, results are finite, never negative, carry an error,
//! keep flux, and do not depend on the number of threads; what has no solution is refused in words.

use crate::rooms::*;
use cfs::compute::estimate::Silent;
use cfs::study::{RoomResult, Session, StudyError};
use glam::DVec3;

/// Finite, not negative, with a finite error; returns the illuminances.
fn sane(what: &str, result: &RoomResult) -> Vec<f64> {
    for row in &result.sensors {
        for (part, e) in [("direct", row.direct), ("interreflected", row.interreflected), ("total", row.total())] {
            assert!(e.value.is_finite() && e.value >= 0.0, "{what}: {part} {e:?} at {}", row.sensor.position);
            assert!(e.error.is_finite() && e.error >= 0.0, "{what}: {part} {e:?} at {}", row.sensor.position);
        }
    }
    assert!(result.flux.value.is_finite() && result.flux.value >= 0.0, "{what}: {:?}", result.flux);
    assert!(result.flux_gap.is_finite() && result.flux_gap >= 0.0, "{what}");
    totals(result)
}

const SYSTEMS: [&str; 3] = [TRANSPARENT, DIFFUSE, MADE];
const GREY: [f64; 3] = [0.2, 0.5, 0.7];

/// Every kind of emission for one room, with sun; returns the illuminances of each.
fn with_every_system(what: &str, text: &Text, aperture: impl Fn(&str) -> String) -> Vec<Vec<f64>> {
    SYSTEMS
        .map(|system| {
            let text = Text { apertures: vec![aperture(system)], ..text.clone() };
            sane(&format!("{what}, {system}"), &compute(&text.scene_with(klems(rough))))
        })
        .to_vec()
}

#[test]
fn sensors_beside_the_opening_get_nothing_from_it_and_no_nan() {
    // On the façade beside and below the window; facing in, along and out. Inside it only what faces in gets nothing.
    let beside = [[0.2, 0.0, 0.3], [2.0, 0.0, 0.9], [0.4999, 0.0, 1.6], [3.7, 0.0, 2.9]];
    let inside = [[2.0, 0.0, 1.6], [0.5, 0.0, 1.0], [2.0, 0.0, 1.0], [3.5, 0.0, 2.5]];
    for normal in [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]] {
        let inside = if normal[1] > 0.0 { &inside[..] } else { &[] };
        let list = [&beside[..], inside].concat();
        let text = Text { sky: clear(35.0, 190.0, 60_000.0), sensors: points(&list, normal), ..Text::default() };
        for values in with_every_system("in plane", &text, |s| facade([0.5, 1.0], [3.0, 1.5], s)) {
            assert!(values.iter().all(|e| *e == 0.0), "{normal:?}: {values:?}");
        }
    }
}

#[test]
fn a_sensor_close_before_the_window_sees_half_the_outside() {
    // Facing the glass at 1 mm: the window fills the hemisphere but for a rim of angle ~ 1 mm/0.7 m.
    let text = Text {
        sky: UNIFORM.into(),
        ground: 1.0,
        sensors: points(&[[2.0, 1e-3, 1.75], [2.0, 1e-6, 1.75], [2.0, 1e-9, 1.75]], [0.0, -1.0, 0.0]),
        ..Text::default()
    };
    for values in with_every_system("close", &text, |s| facade([0.5, 1.0], [3.0, 1.5], s)).iter().take(2) {
        for (e, slack) in values.iter().zip([1e-5, 1e-9, 1e-9]) {
            assert!((e / 10_000.0 - 1.0).abs() < slack, "{values:?}");
        }
    }
}

#[test]
fn sensors_a_millimetre_from_the_sill_follow_the_near_limit() {
    // Horizontal, at sill height in the middle of a window, distance → 0: the upper quarter of the uniform
    // outside, E = L ∫ over the quarter sphere = πL/2, but for the sky that the head and the jambs cut off.
    let list = [[2.0, 1e-3, 1.0], [2.0, 1e-5, 1.0], [2.0, 1e-3, 1.0 - 1e-3], [2.0, 1e-3, 1.0 + 1e-3]];
    let text = Text { sky: UNIFORM.into(), ground: 1.0, sensors: points(&list, [0.0, 0.0, 1.0]), ..Text::default() };
    for values in with_every_system("sill", &text, |s| facade([0.5, 1.0], [3.0, 1.5], s)).iter().take(2) {
        assert!((values[1] / 5_000.0 - 1.0).abs() < 2e-4, "{values:?}");
        assert!((values[0] / 5_000.0 - 1.0).abs() < 2e-2, "{values:?}");
        // Lower: less of the window above the plane; higher: more in front of it at grazing angles, still less than π/2.
        assert!(values[2] < values[0] && values[3] < 5_000.0, "{values:?}");
    }
}

#[test]
fn sensors_on_edges_and_corners_of_the_room() {
    let mut list = Vec::new();
    for x in [0.0, 2.0, 4.0] {
        for y in [0.0, 3.0, 6.0] {
            for z in [0.0, 1.5, 3.0] {
                list.push([x, y, z]);
            }
        }
    }
    for normal in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.6, -0.64, 0.48]] {
        let text = Text {
            reflectance: GREY,
            sky: clear(35.0, 190.0, 60_000.0),
            sensors: points(&list, normal),
            ..Text::default()
        };
        // Window up to the room's edges: corners of the room are corners of the opening.
        with_every_system("corners", &text, |s| facade([0.0, 0.0], [4.0, 3.0], s));
        with_every_system("corners", &text, |s| facade([0.5, 1.0], [3.0, 1.5], s));
        with_every_system("corners", &text, |s| roof([0.0, 0.0], [4.0, 6.0], s));
    }
}

#[test]
fn suns_at_the_borders_of_everything() {
    // (altitude, azimuth): horizon, façade plane, behind it, normal, zenith, vertices of the data's cells.
    let suns = [
        (0.2, 180.0),
        (-0.2, 180.0),
        (0.0, 180.0),
        (-0.27, 180.0),
        (30.0, 90.0),
        (30.0, 270.0),
        (30.0, 90.2),
        (30.0, 89.8),
        (30.0, 0.0),
        (0.0, 90.0),
        (90.0, 180.0),
        (89.9999, 0.0),
        (45.0, 180.0),
        (5.0, 180.0),
    ];
    for (altitude, azimuth) in suns {
        for sky in [clear(altitude, azimuth, 90_000.0), sun_alone(altitude, azimuth)] {
            let text = Text { reflectance: GREY, sky, ground: 0.2, ..Text::default() };
            let what = format!("sun at {altitude}°, {azimuth}°");
            with_every_system(&what, &text, |s| facade([0.5, 1.0], [3.0, 1.5], s));
            with_every_system(&what, &text, |s| roof([0.5, 1.0], [3.0, 1.5], s));
        }
    }
}

#[test]
fn the_disc_rises_and_turns_past_the_facade_without_a_jump() {
    // Flux of the sun alone through a façade, in steps of a 25th of the disc: each step is small, none is negative.
    for turn in [false, true] {
        let mut last = 0.0;
        for step in -30..=30 {
            let angle = f64::from(step) * 0.533 / 25.0;
            let (altitude, azimuth) = if turn { (20.0, 90.0 + angle) } else { (angle, 180.0) };
            let text = Text { sky: sun_alone(altitude, azimuth), ..Text::default() };
            let flux = text.result().flux.value;
            assert!(flux >= 0.0 && flux.is_finite());
            if turn {
                assert!(flux >= last - 1e-9, "{azimuth}°: {flux} after {last}");
                // The whole disc's cosine changes by less than 80 klx · 4.5 m² · 4e-4 a step.
                assert!(flux - last < 80_000.0 * 4.5 * 5e-4, "{azimuth}°: {flux} after {last}");
            } else {
                // Normal incidence: what grows is the visible share.
                assert!(
                    flux >= last - 1e-5 * flux && flux - last < 80_000.0 * 4.5 * 0.06,
                    "{altitude}°: {last} {flux}"
                );
            }
            last = flux;
        }
    }
}

#[test]
fn the_disc_half_risen_gives_half_its_light() {
    let whole = Text { sky: sun_alone(3.0, 180.0), ..Text::default() }.result().flux.value;
    let half = Text { sky: sun_alone(0.0, 180.0), ..Text::default() }.result().flux.value;
    let cosine = 3_f64.to_radians().cos();
    assert!((half / (whole / cosine) - 0.5).abs() < 1e-4, "{half} {whole}");
}

#[test]
fn rooms_of_every_size() {
    // The same scene in a ruler of another length: illuminances do not change, flux goes with the area.
    let reference = Text { reflectance: GREY, sky: clear(35.0, 190.0, 60_000.0), ..Text::default() };
    let expected: Vec<RoomResult> = SYSTEMS
        .map(|s| {
            let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], s)];
            compute(&Text { apertures, ..reference.clone() }.scene_with(klems(rough)))
        })
        .into();
    for scale in [0.025, 1e-2, 250.0, 2000.0] {
        for (system, expected) in SYSTEMS.iter().zip(&expected) {
            let text = Text {
                room: reference.room.map(|l| l * scale),
                apertures: vec![facade([0.5 * scale, scale], [3.0 * scale, 1.5 * scale], system)],
                sensors: format!("plane = {{ z = {:?}, nx = 4, ny = 6 }}", 0.85 * scale),
                ..reference.clone()
            };
            let result = compute(&text.scene_with(klems(rough)));
            for (e, want) in sane("scaled room", &result).iter().zip(totals(expected)) {
                assert!((e - want).abs() < 1e-5 * want + 1e-3, "× {scale}, {system}: {e} {want}");
            }
            let area = scale * scale * expected.flux.value;
            assert!((result.flux.value / area - 1.0).abs() < 1e-9, "× {scale}");
        }
    }
}

#[test]
fn rooms_a_thousand_times_as_long_as_wide() {
    for (room, window) in [
        ([1.0, 1000.0, 1.0], [[0.1, 0.2], [0.8, 0.6]]),
        ([1000.0, 1.0, 1.0], [[400.0, 0.2], [30.0, 0.6]]),
        ([1.0, 1.0, 1000.0], [[0.1, 100.0], [0.8, 300.0]]),
    ] {
        let sensors = format!("plane = {{ z = {:?}, nx = 3, ny = 5 }}", 0.4 * room[2]);
        let text =
            Text { room, reflectance: [0.8, 0.8, 0.8], sky: clear(35.0, 190.0, 60_000.0), sensors, ..Text::default() };
        with_every_system(&format!("{room:?}"), &text, |s| facade(window[0], window[1], s));
    }
}

#[test]
fn apertures_from_a_millimetre_to_the_whole_wall() {
    for (origin, size) in
        [([0.0, 0.0], [4.0, 3.0]), ([2.0, 1.5], [1e-3, 1e-3]), ([0.0, 1.5], [4.0, 1e-3]), ([3.999, 0.0], [1e-3, 3.0])]
    {
        let text = Text { reflectance: GREY, sky: clear(35.0, 190.0, 60_000.0), ground: 0.2, ..Text::default() };
        with_every_system(&format!("window of {size:?}"), &text, |s| facade(origin, size, s));
    }
    for (origin, size) in [([0.0, 0.0], [4.0, 6.0]), ([2.0, 3.0], [1e-3, 1e-3])] {
        let text = Text { reflectance: GREY, sky: clear(35.0, 190.0, 60_000.0), ..Text::default() };
        with_every_system(&format!("rooflight of {size:?}"), &text, |s| roof(origin, size, s));
    }
}

#[test]
fn a_small_window_is_a_point_source() {
    // E = L · A cosθ cosθ' / r² in the limit; horizontal sensor, uniform outside.
    let text = Text {
        apertures: vec![facade([2.0 - 5e-4, 2.0 - 5e-4], [1e-3, 1e-3], MADE)],
        sky: UNIFORM.into(),
        ground: 1.0,
        sensors: points(&[[1.2, 2.0, 0.85]], [0.0, 0.0, 1.0]),
        ..Text::default()
    };
    let to_window = DVec3::new(0.8, -2.0, 1.15);
    let r2 = to_window.length_squared();
    let want = 10_000.0 / std::f64::consts::PI * 1e-6 * (2.0 / r2.sqrt()) * (1.15 / r2.sqrt()) / r2;
    for values in SYSTEMS.map(|s| {
        let text = Text { apertures: vec![facade([2.0 - 5e-4, 2.0 - 5e-4], [1e-3, 1e-3], s)], ..text.clone() };
        totals(&compute(&text.scene_with(straight_cells())))
    }) {
        assert!((values[0] / want - 1.0).abs() < 1e-6, "{} {want}", values[0]);
    }
}

#[test]
fn reflectances_up_to_one() {
    for rho in [0.999, 0.9999, 1.0] {
        for system in SYSTEMS {
            let text = Text {
                reflectance: [rho; 3],
                apertures: vec![facade([0.5, 1.0], [3.0, 1.5], system)],
                ..Text::default()
            };
            // The opening absorbs, so there is a balance even at ρ = 1.
            let result = compute(&text.scene_with(klems(rough)));
            let values = sane(&format!("ρ = {rho}"), &result);
            // All that enters ends in the opening and in the surfaces: no illuminance can exceed what that allows
            // on average by orders of magnitude.
            let area = 2.0 * (24.0 + 12.0 + 18.0) - 4.5;
            let mean = result.flux.value / (4.5 + (1.0 - rho) * area);
            assert!(values.iter().all(|e| *e < 10.0 * mean && *e > 0.1 * mean), "{rho}, {system}: {mean} {values:?}");
        }
    }
    let sealed = Text {
        reflectance: [1.0; 3],
        apertures: vec![format!("{}\nreflectance = 1.0", facade([0.5, 1.0], [3.0, 1.5], DIFFUSE))],
        ..Text::default()
    };
    match Session::new().room(&sealed.scene(), &Silent) {
        Err(error @ StudyError::Room(_)) => assert!(error.to_string().contains("reflectance"), "{error}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn darkness_of_every_kind_is_zero() {
    let night = "model = \"uniform\"\ndiffuse_horizontal = 0.0".to_owned();
    let below = clear(-12.0, 180.0, 50_000.0).replace("12000.0", "0.0");
    for sky in [night, below] {
        let text = Text { reflectance: GREY, sky, ground: 0.3, ..Text::default() };
        for values in with_every_system("dark", &text, |s| facade([0.5, 1.0], [3.0, 1.5], s)) {
            assert!(values.iter().all(|e| *e == 0.0), "{values:?}");
        }
    }
    let shut =
        ["{ ideal = \"transparent\", transmittance = 0.0 }", "{ ideal = \"diffuse\", transmittance = 0.0 }", MADE];
    for system in shut {
        let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], system)];
        let text = Text { reflectance: GREY, sky: clear(35.0, 190.0, 60_000.0), apertures, ..Text::default() };
        let result = compute(&text.scene_with(klems(|_, _| 0.0)));
        assert!(sane("shut", &result).iter().all(|e| *e == 0.0), "{system}");
        assert_eq!(result.flux.value, 0.0);
    }
}

#[test]
fn only_one_surface_reflects() {
    for reflectance in [[0.99, 0.0, 0.0], [0.0, 0.99, 0.0], [0.0, 0.0, 0.99]] {
        let text = Text { reflectance, sky: clear(35.0, 190.0, 60_000.0), ..Text::default() };
        with_every_system(&format!("{reflectance:?}"), &text, |s| facade([0.5, 1.0], [3.0, 1.5], s));
    }
}

#[test]
fn many_apertures_are_one() {
    // A window cut into 24 touching parts lets in the same light as the whole.
    for system in SYSTEMS {
        let whole = Text {
            reflectance: GREY,
            sky: clear(35.0, 190.0, 60_000.0),
            ground: 0.2,
            apertures: vec![facade([0.5, 1.0], [3.0, 1.5], system)],
            ..Text::default()
        };
        let parts = (0..24).map(|k| {
            let (i, j) = (f64::from(k % 6), f64::from(k / 6));
            facade([0.5 + 0.5 * i, 1.0 + 0.375 * j], [0.5, 0.375], system)
        });
        let cut = Text { apertures: parts.collect(), ..whole.clone() };
        let (one, many) = (compute(&whole.scene_with(klems(rough))), compute(&cut.scene_with(klems(rough))));
        sane("24 apertures", &many);
        assert!((one.flux.value / many.flux.value - 1.0).abs() < 1e-9);
        for (a, b) in one.sensors.iter().zip(&many.sensors) {
            // On a border between two parts the disc is cut in two; the pieces' areas add up to 1e-4.
            let slack = 2e-4 * a.direct.value + 1e-3;
            assert!((a.direct.value - b.direct.value).abs() < slack, "{system}: {:?} {:?}", a.direct, b.direct);
            let (p, q) = (a.interreflected, b.interreflected);
            // Other meshes: within what both state.
            assert!((p.value - q.value).abs() < 3.0 * (p.error + q.error), "{system}: {p:?} {q:?}");
        }
    }
}

#[test]
fn more_apertures_than_can_be_balanced_are_refused_in_words() {
    // 50 × 50 small windows that line up nowhere: each border is a row of patches of its own.
    let mut text = Text { reflectance: GREY, room: [100.0, 100.0, 100.0], apertures: Vec::new(), ..Text::default() };
    for i in 0..50 {
        for j in 0..50 {
            let (i, j) = (f64::from(i), f64::from(j));
            text.apertures.push(facade([2.0 * i + 0.011 * j, 2.0 * j + 0.013 * i], [0.5, 0.5], DIFFUSE));
        }
    }
    match Session::new().room(&text.scene(), &Silent) {
        Err(error @ StudyError::Patches(_)) => assert!(error.to_string().contains("2500 apertures"), "{error}"),
        other => panic!("{:?}", other.map(|result| result.flux)),
    }
    text.compute = "interreflection = false".into();
    sane("2500 apertures", &text.result());
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    for system in SYSTEMS {
        let text = Text {
            reflectance: GREY,
            sky: clear(35.0, 190.0, 60_000.0),
            ground: 0.2,
            apertures: vec![facade([0.5, 1.0], [2.0, 1.5], system), roof([1.0, 3.0], [1.0, 1.0], system)],
            ..Text::default()
        };
        let scene = text.scene_with(klems(rough));
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Session::new().room(&scene, &Silent).unwrap())
        };
        let one = run(1);
        for threads in [2, 3, 16] {
            let other = run(threads);
            assert_eq!(one.sensors, other.sensors, "{system}, {threads} threads");
            assert_eq!((one.flux, one.flux_gap), (other.flux, other.flux_gap));
        }
    }
}

#[test]
fn a_withdrawn_question_ends() {
    struct Never;
    impl cfs::compute::estimate::Progress for Never {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let scene = Text { reflectance: GREY, ..Text::default() }.scene();
    assert!(matches!(Session::new().room(&scene, &Never), Err(StudyError::Cancelled(_))));
    assert!(matches!(Session::new().lid(&scene, 0, &Never), Err(StudyError::Cancelled(_))));
}

#[test]
fn skylines_up_to_the_zenith() {
    for altitude in [0.001, 30.0, 89.99] {
        let sky = format!("{OVERCAST}\nobstruction = {{ altitude = {altitude:?}, luminance = 700.0 }}");
        let text = Text { reflectance: GREY, sky, ground: 0.2, ..Text::default() };
        with_every_system(&format!("skyline at {altitude}°"), &text, |s| facade([0.5, 1.0], [3.0, 1.5], s));
        with_every_system(&format!("skyline at {altitude}°"), &text, |s| roof([0.5, 1.0], [3.0, 1.5], s));
    }
}

#[test]
fn a_diffuse_back_reflection_is_the_same_by_cells_and_without() {
    // A lattice that throws back 0.3 of the light evenly into all directions: what the diffuse way takes it for. What
    // differs is that light on the opening is taken as even over it.
    use cfs::compute::basis::{AzimuthMap, RingBasis};
    use cfs::compute::btdf::{Btdf, CellMatrix};
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_BACK);
    let even = vec![0.3 / std::f64::consts::PI; basis.len() * basis.len()];
    let matrix = CellMatrix::new(basis.clone(), basis, even).unwrap();
    let text = Text { reflectance: GREY, apertures: vec![facade([0.0, 0.0], [4.0, 3.0], MADE)], ..Text::default() };
    let mut scene = text.scene_with(klems(rough));
    let mut system = (*scene.apertures[0].system).clone();
    let mut dataset = (*system.dataset).clone();
    dataset.visible.reflection_back = Some(Btdf::from_cells(matrix));
    system.dataset = std::sync::Arc::new(dataset);
    scene.apertures[0].system = std::sync::Arc::new(system);
    scene.apertures[0].reflectance = 0.3;
    let mut values = [false, true].map(|directional| {
        scene.apertures[0].directional = directional;
        compute(&scene)
    });
    scene.apertures[0].directional = false;
    scene.apertures[0].reflectance = 0.0;
    let black = compute(&scene);
    let [diffuse, by_cells] = &mut values;
    for ((a, b), none) in diffuse.sensors.iter().zip(&by_cells.sensors).zip(&black.sensors) {
        let (a, b) = (a.interreflected, b.interreflected);
        let thrown_back = a.value - none.interreflected.value;
        assert!((a.value - b.value).abs() <= a.error + b.error, "{a:?} {b:?}");
        assert!((a.value - b.value).abs() <= 0.2 * thrown_back, "{a:?} {b:?} {thrown_back}");
        assert!(thrown_back > 0.02 * a.value);
    }
}
