//! Strange places: openings of a micrometre, a sun that is half up, sensors in the opening itself, very many sensors.

use crate::rooms::*;
use cfs::compute::estimate::Silent;
use cfs::compute::limits;
use cfs::study::{Session, StudyError};
use glam::DVec3;

const GREY: [f64; 3] = [0.2, 0.5, 0.7];

#[test]
fn small_openings_send_as_their_area_does() {
    for system in [TRANSPARENT, DIFFUSE, MADE] {
        for in_roof in [false, true] {
            let of = |size: f64| {
                // About one middle: half a millimetre is felt by a sensor that sees it at a grazing angle.
                let [x, y] =
                    [if in_roof { 1.3 } else { 1.0 }, if in_roof { 2.0 } else { 1.0 }].map(|at| at - 0.5 * size);
                let text = Text {
                    reflectance: GREY,
                    ground: 0.2,
                    sky: clear(30.0, 190.0, 50_000.0),
                    apertures: vec![if in_roof {
                        roof([x, y], [size, size], system)
                    } else {
                        facade([x, y], [size, size], system)
                    }],
                    sensors: "plane = { z = 0.85, nx = 3, ny = 4 }".into(),
                    ..Text::default()
                };
                compute(&text.scene_with(klems(rough)))
            };
            // A millimetre is small against all distances, and large enough for every way of computing it.
            let large = of(1e-3);
            for size in [1e-6, 1e-5, 1e-4] {
                let small = of(size);
                let scale = (size / 1e-3_f64).powi(2);
                assert!((small.flux.value / large.flux.value / scale - 1.0).abs() < 1e-9);
                for (a, b) in small.sensors.iter().zip(&large.sensors) {
                    let at = a.sensor.position;
                    let direct = [a.direct.value / scale, b.direct.value];
                    assert!((direct[0] - direct[1]).abs() < 2e-3 * direct[1], "{system} {size} at {at}: {direct:?}");
                    let [a, b] = [a.total() * (1.0 / scale), b.total()];
                    assert!((a.value - b.value).abs() <= a.error + b.error, "{system} {size} at {at}: {a:?} {b:?}");
                }
            }
        }
    }
}

#[test]
fn through_a_pinhole_the_sun_is_a_disc_of_its_luminance() {
    let size = 2e-6;
    let (altitude, direct_normal) = (30.0_f64, 80_000.0);
    let sun = DVec3::new(0.0, -altitude.to_radians().cos(), altitude.to_radians().sin());
    let hole = DVec3::new(2.0 + 0.5 * size, 0.0, 2.0 + 0.5 * size);
    for way in [0.5, 2.0] {
        let sensor = hole - way * sun;
        let text = Text {
            sky: sun_alone(altitude, 180.0),
            apertures: vec![facade([2.0, 2.0], [size, size], TRANSPARENT)],
            sensors: points(&[sensor.to_array()], [0.0, 0.0, 1.0]),
            ..Text::default()
        };
        let radius = 0.2665_f64.to_radians().tan();
        let luminance = direct_normal / (std::f64::consts::PI * radius * radius);
        let expected = luminance * size * size * -sun.y * sun.z / (way * way);
        let found = totals(&text.result())[0];
        assert!((found / expected - 1.0).abs() < 1e-3, "{way}: {found} {expected}");
    }
}

#[test]
fn openings_below_a_micrometre_are_refused_by_name() {
    let text = Text { apertures: vec![facade([1.0, 1.0], [1e-9, 1.0], DIFFUSE)], ..Text::default() };
    let Err(error) = text.resolve(&Made(None)) else { panic!("taken") };
    let told = error.to_string();
    assert!(told.contains("aperture[1].size") && told.contains("0.000001 m"), "{told}");
}

/// Light in a room by nothing but a sun at some altitude, its bearing as given; what comes in, and what the sensors get
/// after reflection.
fn by_low_sun(altitude: f64, bearing: f64, aperture: &str) -> (f64, f64, f64) {
    let text = Text {
        reflectance: GREY,
        sky: sun_alone(altitude, bearing),
        apertures: vec![aperture.to_owned()],
        ..Text::default()
    };
    let result = text.result();
    let mean = |part: &dyn Fn(&cfs::study::SensorResult) -> f64| {
        result.sensors.iter().map(part).sum::<f64>() / result.sensors.len() as f64
    };
    (result.flux.value, mean(&|one| one.interreflected.value), mean(&|one| one.interreflected.error))
}

#[test]
fn a_sun_that_is_half_up_reaches_the_room() {
    let skylight = roof([1.0, 2.0], [2.0, 2.0], TRANSPARENT);
    let window = facade([0.5, 1.0], [3.0, 1.5], TRANSPARENT);
    // Through the roof, and past the façade's own plane: the disc's middle behind the opening, on it, before it.
    let over_roof: Vec<_> = [-0.2, -0.1, 0.0, 0.1, 0.2, 0.3].map(|h| by_low_sun(h, 180.0, &skylight)).to_vec();
    let past_facade: Vec<_> = [270.2, 270.1, 270.0, 269.9, 269.7].map(|b| by_low_sun(20.0, b, &window)).to_vec();
    let rising: Vec<_> = [-0.2, -0.1, 0.0, 0.1, 0.2, 0.3].map(|h| by_low_sun(h, 180.0, &window)).to_vec();
    for list in [over_roof, past_facade, rising] {
        for pair in list.windows(2) {
            assert!(pair[1].0 > pair[0].0, "more of the disc, more light: {list:?}");
        }
        // What comes in is reflected in about the same share wherever the disc's middle stands.
        let shares: Vec<f64> = list.iter().map(|(flux, reflected, _)| reflected / flux).collect();
        let (least, most) = shares.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(*x), b.max(*x)));
        assert!(least > 0.7 * most, "{shares:?}");
    }
}

#[test]
fn a_sensor_in_the_opening_reads_what_one_just_behind_it_does() {
    let list = [0.0, 1e-12, 1e-9, 1e-6].map(|y| [2.0, y, 1.6]);
    let turned = DVec3::new(0.3, -0.5, 0.6).normalize().to_array();
    for normal in [[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], turned] {
        for system in [TRANSPARENT, DIFFUSE, MADE] {
            let text = Text {
                reflectance: GREY,
                ground: 0.2,
                sky: clear(30.0, 190.0, 50_000.0),
                apertures: vec![facade([0.5, 1.0], [3.0, 1.5], system)],
                sensors: points(&list, normal),
                ..Text::default()
            };
            let result = compute(&text.scene_with(klems(rough)));
            let first = result.sensors[0].total();
            assert!(first.value > 100.0, "{normal:?} {system}: {first:?}");
            for one in &result.sensors {
                let other = one.total();
                let apart = (first.value - other.value).abs();
                assert!(
                    apart <= first.error + other.error + 1e-5 * first.value,
                    "{normal:?} {system}: {first:?} {other:?}"
                );
            }
        }
    }
}

#[test]
fn many_sensors_get_what_each_would_alone() {
    // More than are kept at once: their geometry is made again for each.
    let (nx, ny) = (200, 200);
    const PATCHES: usize = 640;
    assert!(nx * ny * 2 * PATCHES * size_of::<f64>() > limits::KEPT_BYTES, "too few for this test");
    let sensors = format!("plane = {{ z = 0.85, nx = {nx}, ny = {ny} }}");
    let text = Text {
        reflectance: GREY,
        sky: clear(30.0, 190.0, 50_000.0),
        apertures: vec![facade([0.5, 1.0], [3.0, 1.5], DIFFUSE)],
        compute: "error_target = 0.5".into(),
        ..Text::default()
    };
    let all = Text { sensors, ..text.clone() }.scene();
    let told = std::sync::Mutex::new(0);
    struct Counting<'a>(&'a std::sync::Mutex<usize>);
    impl cfs::compute::estimate::Progress for Counting<'_> {
        fn advance(&self, _: &'static str, _: usize, _: usize) {
            *self.0.lock().unwrap() += 1;
        }
    }
    let many = Session::new().room(&all, &Counting(&told)).unwrap();
    assert!(*told.lock().unwrap() > 8, "no progress");
    let picked: Vec<usize> = (0..nx * ny).step_by(1997).collect();
    let list: Vec<[f64; 3]> = picked.iter().map(|&s| all.sensors[s].position.to_array()).collect();
    let few = Session::new().room(&Text { sensors: points(&list, [0.0, 0.0, 1.0]), ..text }.scene(), &Silent);
    for (one, &s) in few.unwrap().sensors.iter().zip(&picked) {
        assert_eq!(*one, many.sensors[s]);
    }
}

#[test]
fn points_and_cells_share_one_limit() {
    let sensors = format!("plane = {{ z = 0.85, nx = {}, ny = 1 }}\npoints = [[1.0, 1.0, 1.0]]", limits::SENSORS);
    let Err(StudyError::Key { key, message }) = Text { sensors, ..Text::default() }.resolve(&Made(None)) else {
        panic!("taken")
    };
    assert!(key.starts_with("sensors") && message.contains("1000000"), "{key}: {message}");
}

#[test]
fn light_beyond_all_measure_is_refused_by_name() {
    for (sky, key) in [
        ("model = \"uniform\"\ndiffuse_horizontal = 1e308", "sky.diffuse_horizontal"),
        ("model = \"uniform\"\ndiffuse_horizontal = nan", "sky.diffuse_horizontal"),
        (
            "model = \"uniform\"\ndiffuse_horizontal = 1.0\nsun = { altitude = 30.0, azimuth = 180.0, direct_normal = 1e308 }",
            "sky.sun.direct_normal",
        ),
        (
            "model = \"uniform\"\ndiffuse_horizontal = 1.0\nobstruction = { altitude = 5.0, luminance = 1e300 }",
            "sky.obstruction.luminance",
        ),
    ] {
        let Err(error) = (Text { sky: sky.into(), ..Text::default() }).resolve(&Made(None)) else { panic!("{sky}") };
        let told = error.to_string();
        assert!(told.starts_with(key) && told.contains("allowed: 0 to 1") && told.len() < 120, "{told}");
    }
}
