//! The ground and what stands on it: shade, and light that goes to and fro, against closed forms.

use crate::outside::{CLEAR, DIFFUSE, OVERCAST, a_box, resolve, seen, setting, text, totals};
use crate::rooms;
use cfs::compute::direction::Dir;
use cfs::compute::estimate::Silent;
use cfs::compute::sky::{Distribution, Outside, Sun};
use cfs::compute::sky::{Finish, Setting};
use cfs::compute::surroundings::solid::Solid;
use cfs::study::SceneFile;
use cfs::study::facade::{facade_light, obstruction_effects};
use cfs::study::sky::outside_from_keys;
use glam::DVec3;
use std::f64::consts::PI;
use std::path::Path;

#[test]
fn the_ground_under_an_endless_overhang_sees_what_it_leaves_of_the_sky() {
    // Black, 3 m above the ground, 2 m deep: of the sky over an endless strip of ground between two angles from the
    // zenith (sin θ₂ − sin θ₁)/2 is missing.
    let slab = Solid::new(DVec3::new(-1e3, -2.0, 3.0), DVec3::new(1e3, 0.0, 3.2), 0.0);
    let sky = Outside::new(Distribution::uniform(), 10_000.0).unwrap().with_ground(0.4, 0.0).unwrap();
    let eye = DVec3::new(0.0, 0.0, 1.5);
    let seen = seen(&sky, None, setting(vec![(slab, Finish::Reflectance(0.0))], 0.0), eye);
    for away in [0.3, 0.9, 1.7, 2.4, 4.0, 9.0, 40.0] {
        // From before it, its front hides up to its upper edge.
        let sine = |edge: f64, height: f64| (away - edge) / f64::hypot(away - edge, height);
        let front = sine(2.0, if away > 2.0 { 3.2 } else { 3.0 });
        let exact = 0.4 * 10_000.0 / PI * (1.0 - 0.5 * (sine(0.0, 3.0) - front));
        let found = seen.luminance(Dir::from_unit((DVec3::new(0.0, -away, 0.0) - eye).normalize()));
        assert!((found / exact - 1.0).abs() < 5e-3, "{away}: {found} {exact}");
    }
}

#[test]
fn in_a_white_court_everything_is_as_bright_as_its_lid() {
    // What reflects all light and is closed by a lid of one luminance has that luminance: any number of reflections.
    let wall = |from: [f64; 2], to: [f64; 2]| {
        let solid = Solid::new(DVec3::new(from[0], from[1], 0.0), DVec3::new(to[0], to[1], 4.0), 0.0);
        (solid, Finish::Reflectance(1.0))
    };
    let lid = Solid::new(DVec3::new(-5.0, -9.0, 4.0), DVec3::new(5.0, 1.0, 4.5), 0.0);
    let boxes = vec![
        wall([-4.0, -8.0], [-3.0, 0.2]),
        wall([3.0, -8.0], [4.0, 0.2]),
        wall([-3.0, -8.0], [3.0, -7.0]),
        wall([-3.0, 0.1], [3.0, 0.2]),
        (lid, Finish::Luminance(1000.0)),
    ];
    let dark = Outside::new(Distribution::uniform(), 0.0).unwrap().with_ground(1.0, 0.0).unwrap();
    let seen = seen(&dark, None, setting(boxes, 0.0), DVec3::new(0.4, 0.0, 1.2));
    for (x, z) in [(0.0, 0.0), (0.7, -0.2), (-0.9, 0.1), (0.2, -0.6), (-0.3, 0.5), (0.0, -2.0), (-2.0, -0.4)] {
        let found = seen.luminance(Dir::from_unit(DVec3::new(x, -1.0, z).normalize()));
        assert!((found / 1000.0 - 1.0).abs() < 0.01, "{x} {z}: {found}");
    }
}

#[test]
fn a_closed_black_hall_is_dark_inside() {
    let sun = "model = \"cie\"\ntype = 12\ndiffuse_horizontal = 12000.0\n\
               sun = { altitude = 40.0, azimuth = 180.0, direct_normal = 80000.0 }";
    let wall = |from: [f64; 3], to: [f64; 3]| a_box(from, to, "reflectance = 0.0");
    let hall = [
        wall([-20.0, -20.5, 0.0], [24.0, -20.0, 10.0]),
        wall([-20.5, -20.5, 0.0], [-20.0, 20.5, 10.0]),
        wall([24.0, -20.5, 0.0], [24.5, 20.5, 10.0]),
        wall([-20.0, 20.0, 0.0], [24.0, 20.5, 10.0]),
        wall([-20.5, -20.5, 10.0], [24.5, 20.5, 10.5]),
    ];
    for system in [CLEAR, DIFFUSE] {
        assert!(totals(&text(system, sun, &hall.concat())).iter().all(|e| *e < 0.01));
    }
}

#[test]
fn the_ground_before_a_north_facade_lies_in_the_buildings_shade() {
    // No sky but the sun, from behind: the shadow of 9 m above the ground reaches 9 m / tan 30°.
    let sun = Sun { direction: Dir::from_unit(DVec3::new(0.0, 0.75_f64.sqrt(), 0.5)), direct_normal: 60_000.0 };
    let sky = Outside::new(Distribution::uniform(), 0.0).unwrap().with_ground(0.3, 30_000.0).unwrap();
    let building = Solid::new(DVec3::new(-500.0, 0.0, -6.0), DVec3::new(500.0, 10.0, 3.0), 0.0);
    let setting = Setting { building: Some((building, 0.0)), ..setting(Vec::new(), -6.0) };
    let eye = DVec3::new(0.0, -1e-6, 0.0);
    let seen = seen(&sky, Some(&sun), setting, eye);
    let edge = 9.0 * 3_f64.sqrt();
    for (away, lit) in [(0.98 * edge, 0.0), (1.02 * edge, 0.3 * 30_000.0 / PI)] {
        let found = seen.luminance(Dir::from_unit((DVec3::new(0.0, -away, -6.0) - eye).normalize()));
        assert!((found - lit).abs() < 1e-6 * 3000.0, "{away}: {found} {lit}");
    }
}

#[test]
fn a_skyline_darkens_the_ground_too() {
    // Uniform sky above 30°, a skyline of 500 cd/m² below, and a sun that it hides or not.
    let lit = |altitude: f64| {
        let sky = format!(
            "model = \"uniform\"\ndiffuse_horizontal = 10000.0\nobstruction = {{ altitude = 30.0, luminance = 500.0 }}\n\
             sun = {{ altitude = {altitude:?}, azimuth = 180.0, direct_normal = 40000.0 }}"
        );
        resolve(&text(CLEAR, &sky, "")).unwrap().outside.ground_luminance()
    };
    let diffuse = 10_000.0 * 0.75 + PI * 500.0 * 0.25;
    assert!((lit(20.0) / (0.2 * diffuse / PI) - 1.0).abs() < 1e-6);
    let sun = 40_000.0 * 50_f64.to_radians().sin();
    assert!((lit(50.0) / (0.2 * (diffuse + sun) / PI) - 1.0).abs() < 1e-6);
}

#[test]
fn a_low_far_box_is_left_out_unless_it_shines() {
    let shed = |finish: &str| text(DIFFUSE, OVERCAST, &a_box([1.0, -301.0, 0.0], [3.0, -300.0, 2.0], finish));
    let open = totals(&text(DIFFUSE, OVERCAST, ""));
    assert_eq!(totals(&shed("reflectance = 0.5")), open);
    let notes = resolve(&shed("reflectance = 0.5")).unwrap().outside_notes;
    assert!(notes.len() == 1 && notes[0].contains("left out"), "{notes:?}");
    // Four square metres straight ahead light the pane by L · 4 / 300², which the sky does by about half of 10 klx.
    let more = 4e6 * 4.0 / 90_000.0;
    for (shining, open) in totals(&shed("luminance = 4e6")).iter().zip(&open) {
        let sky = more / (shining / open - 1.0);
        assert!(sky > 3500.0 && sky < 6500.0, "{sky}");
    }
}

#[test]
fn the_facade_gets_what_boxes_leave() {
    // A long black wall up to 30° above the middle of a small aperture, before black ground.
    let top = 1.5 + 10.0 * 30_f64.to_radians().tan();
    let wall = a_box([-5e3, -11.0, 0.0], [5e3, -10.0, top], "reflectance = 0.0");
    let file = |sun: &str| {
        let sky = format!("{}\n{sun}", rooms::UNIFORM);
        let apertures = vec![rooms::facade([1.99, 1.49], [0.02, 0.02], rooms::DIFFUSE)];
        SceneFile::parse(&(rooms::Text { sky, apertures, ..rooms::Text::default() }.toml() + &wall)).unwrap()
    };
    let of = |altitude: f64| {
        let file = file(&format!("sun = {{ altitude = {altitude:?}, azimuth = 180.0, direct_normal = 5e4 }}"));
        let (outside, sun) = outside_from_keys(&file.sky, &file.site, Path::new(".")).unwrap();
        facade_light(&file, Path::new("."), (&outside, sun.as_ref()), &Silent).unwrap()
    };
    // Of the sky ½ (1 − sin 30°) of the horizontal illuminance is left.
    let light = of(25.0);
    assert!(
        (light.diffuse.value - 2500.0).abs() <= light.diffuse.error + 0.5 && light.diffuse.error < 5.0,
        "{light:?}"
    );
    assert!(light.behind && light.direct == 0.0, "{light:?}");
    let light = of(40.0);
    assert!((light.direct / (5e4 * 40_f64.to_radians().cos()) - 1.0).abs() < 1e-4, "{light:?}");
    // Without the wall it would be twice that of the sky.
    let file = file("");
    let effects = obstruction_effects(&file, Path::new("."), &Silent).unwrap().unwrap();
    assert!(effects.len() == 1 && (effects[0].value - 1.0).abs() <= effects[0].error + 1e-3, "{effects:?}");
    assert!(effects[0].error < 5e-3, "{effects:?}");
}

#[test]
fn a_facade_without_apertures_has_its_light_too() {
    let apertures = vec![rooms::roof([1.0, 2.0], [1.0, 1.0], rooms::DIFFUSE)];
    let wall = a_box([-5e3, -11.0, 0.0], [5e3, -10.0, 20.0], "reflectance = 0.0");
    let text = rooms::Text { sky: rooms::UNIFORM.to_owned(), apertures, ..rooms::Text::default() }.toml() + &wall;
    let light = |text: &str| {
        let mut file = SceneFile::parse(text).unwrap();
        file.site.ground_height = 0.5;
        let (outside, sun) = outside_from_keys(&file.sky, &file.site, Path::new(".")).unwrap();
        facade_light(&file, Path::new("."), (&outside, sun.as_ref()), &Silent).unwrap()
    };
    let behind = light(&text);
    assert!(behind.behind && behind.diffuse.value < 2500.0, "{behind:?}");
    // A building that reaches before it hides it: its plane in the open is told.
    let hidden = light(&(text + "[building]\nfrom = [-1.0, -3.0, 0.0]\nto = [5.0, 8.0, 3.0]\n"));
    assert!(!hidden.behind && (hidden.diffuse.value - 5000.0).abs() < 1.0, "{hidden:?}");
}
