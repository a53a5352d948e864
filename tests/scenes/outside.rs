//! What stands outside: which keys are refused, and what must hold without any reference.

use crate::common::root;
use cfs::compute::basis::RingBasis;
use cfs::compute::direction::{Dir, Emergent};
use cfs::compute::estimate::{Progress, Silent};
use cfs::compute::quadrature::Tolerance;
use cfs::compute::sky::faces::{Viewing, surroundings};
use cfs::compute::sky::{Distribution, Finish, Outside, Setting, Sun, irradiance, irradiance_through};
use cfs::compute::surroundings::face_light::FaceLight;
use cfs::compute::surroundings::solid::Solid;
use cfs::study::scene_file::SceneFile;
use cfs::study::{Library, RoomResult, Scene, Session};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

pub(crate) const DIFFUSE: &str = "system = { ideal = \"diffuse\", transmittance = 0.5 }";
pub(crate) const CLEAR: &str = "system = { ideal = \"transparent\", transmittance = 0.8 }";
pub(crate) const OVERCAST: &str = "model = \"cie\"\ntype = 16\ndiffuse_horizontal = 10000.0";
const BLACK: &str = "model = \"uniform\"\ndiffuse_horizontal = 0.0";

pub(crate) fn text(aperture: &str, sky: &str, outside: &str) -> String {
    format!(
        "[room]\nwidth = 4.0\ndepth = 6.0\nheight = 3.0\nreflectance = {{ floor = 0.0, walls = 0.0, ceiling = 0.0 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]\n{aperture}\n{outside}\n\
         [site]\nazimuth = 180.0\nground_reflectance = 0.2\n[sky]\n{sky}\n\
         [sensors]\npoints = [[0.9, 0.6, 0.85], [2.6, 1.7, 0.85], [2.0, 4.0, 0.85]]\nnormal = [0.0, 0.0, 1.0]\n\
         [compute]\ninterreflection = false\n"
    )
}

pub(crate) fn a_box(from: [f64; 3], to: [f64; 3], more: &str) -> String {
    format!("[[outside]]\nbox = {{ from = {from:?}, to = {to:?} }}\n{more}\n")
}

pub(crate) fn resolve(text: &str) -> Result<Scene, String> {
    let file = SceneFile::parse(text).map_err(|error| error.to_string())?;
    Scene::resolve(&file, root(), &Library::default()).map_err(|error| error.to_string())
}

fn room(text: &str) -> RoomResult {
    Session::new().room(&resolve(text).unwrap(), &Silent).unwrap()
}

pub(crate) fn totals(text: &str) -> Vec<f64> {
    room(text).sensors.iter().map(|sensor| sensor.total().value).collect()
}

fn words(text: &str) -> String {
    let stages = room(text).plan.stages;
    stages.iter().filter(|stage| stage.name == "outside").map(|stage| stage.reason.clone()).collect()
}

fn building(from: &str, to: &str) -> String {
    format!("[building]\nfrom = [{from}]\nto = [{to}]\n")
}

#[test]
fn wrong_keys_name_their_place() {
    let skyline = |keys: &str| format!("{OVERCAST}\nskyline = {{ {keys} }}");
    let inside = a_box([1.0, -1.0, 0.0], [2.0, 0.5, 1.0], "");
    for (aperture, sky, outside, place) in [
        (CLEAR.to_owned(), OVERCAST.to_owned(), inside, "outside[1].box"),
        (CLEAR.to_owned(), OVERCAST.to_owned(), a_box([1.0, -1.0, 0.0], [2.0, -2.0, 1.0], ""), "outside[1].box"),
        (
            CLEAR.to_owned(),
            OVERCAST.to_owned(),
            a_box([1.0, -2.0, 0.0], [2.0, -1.0, 1.0], "reflectance = 1.2"),
            "outside[1].reflectance",
        ),
        (
            CLEAR.to_owned(),
            OVERCAST.to_owned(),
            a_box([1.0, -2.0, 0.0], [2.0, -1.0, 1.0], "reflectance = 0.2\nluminance = 3.0"),
            "outside[1].luminance",
        ),
        (
            CLEAR.to_owned(),
            OVERCAST.to_owned(),
            a_box([1.0, -2.0, 0.0], [2.0, -2.0 + 1e-9, 1.0], "luminance = 0.0"),
            "outside[1].box",
        ),
        (format!("{CLEAR}\nframe = 0.97"), OVERCAST.to_owned(), String::new(), "aperture[1].frame"),
        (format!("{CLEAR}\ndirt = -0.1"), OVERCAST.to_owned(), String::new(), "aperture[1].dirt"),
        (CLEAR.to_owned(), skyline("altitudes = []"), String::new(), "sky.skyline.altitudes"),
        (CLEAR.to_owned(), skyline("altitudes = [[0.0, 95.0]]"), String::new(), "sky.skyline.altitudes"),
        (
            CLEAR.to_owned(),
            skyline("altitudes = [[0.0, 5.0]], luminance = -1.0"),
            String::new(),
            "sky.skyline.luminance",
        ),
        (CLEAR.to_owned(), OVERCAST.to_owned(), building("-1.0, 0.5, -3.0", "9.0, 9.0, 9.0"), "building.from"),
        (CLEAR.to_owned(), OVERCAST.to_owned(), building("-1.0, -0.5, -3.0", "9.0, 9.0, 9.0"), "building.from"),
        (CLEAR.to_owned(), OVERCAST.to_owned(), building("-1.0, 0.0, -3.0", "9.0, 9.0, 2.0"), "building.to"),
        (
            CLEAR.to_owned(),
            OVERCAST.to_owned(),
            building("-1.0, 0.0, -3.0", "9.0, 9.0, 9.0") + "reflectance = 1.5\n",
            "building.reflectance",
        ),
    ] {
        let error = resolve(&text(&aperture, &sky, &outside)).unwrap_err();
        assert!(error.contains(place), "{place}: {error}");
    }
    let high = text(CLEAR, OVERCAST, "").replace("[site]", "[site]\nground_height = 0.95");
    assert!(resolve(&high).unwrap_err().contains("site.ground_height"));
}

#[test]
fn frame_and_dirt_leave_their_share() {
    let whole = totals(&text(CLEAR, OVERCAST, ""));
    let less = totals(&text(&format!("{CLEAR}\nframe = 0.2\ndirt = 0.9"), OVERCAST, ""));
    for (a, b) in whole.iter().zip(&less) {
        assert!((b / a - 0.72).abs() < 1e-9, "{a} {b}");
    }
}

#[test]
fn a_wall_on_the_window_takes_all_light_and_one_that_shines_gives_its_own() {
    let wall = |luminance: f64| a_box([-50.0, -2.0, -50.0], [54.0, -0.01, 50.0], &format!("luminance = {luminance:?}"));
    for system in [CLEAR, DIFFUSE] {
        let open = totals(&text(system, OVERCAST, ""));
        let dark = totals(&text(system, OVERCAST, &wall(0.0)));
        assert!(open.iter().zip(&dark).all(|(a, b)| *a > 10.0 && *b < 1e-3 * a), "{open:?} {dark:?}");
        let [one, two] = [100.0, 200.0].map(|l| totals(&text(system, BLACK, &wall(l))));
        assert!(one.iter().zip(&two).all(|(a, b)| *a > 0.1 && (b / a - 2.0).abs() < 1e-6), "{one:?} {two:?}");
    }
}

#[test]
fn a_flat_skyline_by_bearings_is_the_horizontal_one() {
    let flat = format!("{OVERCAST}\nobstruction = {{ altitude = 20.0, luminance = 300.0 }}");
    let bearings = format!("{OVERCAST}\nskyline = {{ altitudes = [[10.0, 20.0], [200.0, 20.0]], luminance = 300.0 }}");
    for system in [CLEAR, DIFFUSE] {
        let [a, b] = [&flat, &bearings].map(|sky| totals(&text(system, sky, "")));
        assert!(a.iter().zip(&b).all(|(a, b)| (b / a - 1.0).abs() < 2e-3), "{a:?} {b:?}");
    }
}

#[test]
fn the_plan_says_what_was_split() {
    let far = words(&text(DIFFUSE, OVERCAST, &a_box([-9e3, -9e3, 0.0], [9e3, -8e3, 2e3], "")));
    assert!(far.contains("aperture 1: not subdivided"), "{far}");
    let fin = words(&text(DIFFUSE, OVERCAST, &a_box([0.3, -0.9, 0.0], [0.5, 0.0, 3.0], "")));
    assert!(fin.contains("aperture 1: subdivided into"), "{fin}");
    let through = words(&text(CLEAR, OVERCAST, &a_box([0.3, -0.9, 0.0], [0.5, 0.0, 3.0], "")));
    assert!(through.contains("all calculation points see the sky through it"), "{through}");
    assert!(words(&text(DIFFUSE, OVERCAST, "")).is_empty());
}

/// Boxes above the ground, with a room that hides next to nothing.
pub(crate) fn setting(boxes: Vec<(Solid, Finish)>, ground: f64) -> Setting {
    let room = Solid::new(DVec3::new(-1e-3, 1e-3, -1e-3), DVec3::new(1e-3, 2e-3, 1e-3), 0.0);
    Setting { boxes, room, building: None, ground }
}

/// An outside behind boxes, as it is seen from a point; axes as the room's.
pub(crate) fn seen(outside: &Outside, sun: Option<&Sun>, setting: Setting, eye: DVec3) -> Outside {
    let viewing = Viewing { viewpoints: &[eye], target: 5e-3 };
    let around = surroundings(outside, sun, &setting, [1.0, 0.0], None, &viewing, &Silent).unwrap();
    outside.clone().behind(Arc::new(around)).seen_from(eye)
}

/// Illuminance of a wall that looks to −y from a point at the origin, past one black box. \[lx\]
fn past(solid: Solid, outside: Outside) -> f64 {
    let seen = seen(&outside, None, setting(vec![(solid, Finish::Luminance(0.0))], -1.0), DVec3::ZERO);
    irradiance(&seen, Dir::from_unit(DVec3::NEG_Y)).value
}

#[test]
fn endless_overhangs_and_fins_hide_what_their_profile_angle_says() {
    let sky = || Outside::new(Distribution::uniform(), 10_000.0).unwrap();
    for (depth, away) in [(1.2_f64, 0.3_f64), (0.5, 0.5), (0.2, 1.5)] {
        let sine = away / away.hypot(depth);
        // A uniform sky gives a wall half of what it gives the ground, times the sine of the profile angle where it ends.
        let overhang = Solid::new(DVec3::new(-5e3, -depth, away), DVec3::new(5e3, 0.0, away + 0.1), 0.0);
        let found = past(overhang, sky());
        assert!((found / (5000.0 * sine) - 1.0).abs() < 1e-3, "overhang {depth} {away}: {found}");
        // Above black ground one half is whole, the other ends at the fin.
        let fin = Solid::new(DVec3::new(away, -depth, -5e3), DVec3::new(away + 0.1, 0.0, 5e3), 0.0);
        let found = past(fin, sky());
        assert!((found / (2500.0 * (1.0 + sine)) - 1.0).abs() < 1e-3, "fin {depth} {away}: {found}");
    }
}

#[test]
fn what_enters_under_an_endless_overhang_is_its_mean() {
    let uniform = "model = \"uniform\"\ndiffuse_horizontal = 10000.0";
    let overhang = a_box([-5e3, -1.2, 2.7], [5e3, 0.0, 2.8], "luminance = 0.0");
    let black = text(DIFFUSE, uniform, &overhang).replace("ground_reflectance = 0.2", "ground_reflectance = 0.0");
    let found = room(&black).flux.value;
    // Mean of h / √(h² + d²) over the height of the window.
    let mean = (1.8_f64.hypot(1.2) - 1.2) / 1.8;
    let exact = 0.5 * 3.0 * 1.8 * 5000.0 * mean;
    assert!((found / exact - 1.0).abs() < 3e-3, "{found} {exact}");
}

/// The same scene with its opening cut into abutting ones, along the borders `x` and `z`.
fn cut(own: &str, x: &[f64], z: &[f64]) -> String {
    let start = own.find("[[aperture]]").unwrap();
    let end = own[start + 1..].find("\n[[").unwrap() + start + 2;
    let one = &own[start..end];
    let mut parts = String::new();
    for along in x.windows(2) {
        for up in z.windows(2) {
            let part = one.replace("[0.5, 0.9]", &format!("[{:?}, {:?}]", along[0], up[0]));
            parts += &part.replace("[3.0, 1.8]", &format!("[{:?}, {:?}]", along[1] - along[0], up[1] - up[0]));
        }
    }
    format!("{}{parts}{}", &own[..start], &own[end..])
}

/// Borders of equal parts.
fn equal(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|k| from + (to - from) * f64::from(k) / f64::from(count)).collect()
}

/// In a room that reflects.
fn reflecting(own: &str) -> String {
    own.replace("floor = 0.0, walls = 0.0, ceiling = 0.0", "floor = 0.3, walls = 0.6, ceiling = 0.8")
        .replace("interreflection = false", "interreflection = true")
}

#[test]
fn what_stands_on_the_glass_leaves_the_opening_beside_it() {
    // Black, 5 cm thick, on 60 % of the width; the opening that is left beside it, and a dark one behind it.
    let on_it = a_box([0.5, -0.05, 0.5], [2.3, 0.0, 2.9], "luminance = 0.0");
    for system in [CLEAR, DIFFUSE] {
        let system = format!("{system}\nreflectance = 0.0");
        let own = reflecting(&text(&system, "model = \"uniform\"\ndiffuse_horizontal = 10000.0", &on_it));
        let (found, left) = (room(&own), room(&cut(&own, &[0.5, 2.3, 3.5], &[0.9, 2.7])));
        assert!((found.flux.value / left.flux.value - 1.0).abs() < 3e-3, "{:?} {:?}", found.flux, left.flux);
        for (a, b) in found.sensors.iter().zip(&left.sensors) {
            let (all, other) = (a.total(), b.total());
            assert!((all.value / other.value - 1.0).abs() < 0.01, "{system}: {all:?} {other:?}");
            assert!((all.value - other.value).abs() <= all.error + other.error, "{system}: {all:?} {other:?}");
            assert!(all.error < 0.03 * all.value, "{system}: {all:?}");
            let [reflected, other] = [a, b].map(|sensor| sensor.interreflected.value);
            assert!((reflected / other - 1.0).abs() < 0.02, "{system}: {reflected} {other}");
        }
        // As a luminaire it is not black though its middle is covered.
        let lit = Session::new().lid(&resolve(&own).unwrap(), 0, &Silent).unwrap();
        let basis = RingBasis::equal_area(40);
        let by_direction: f64 = basis
            .cells()
            .map(|cell| cell.projected_solid_angle() * lit.lid.luminance(Emergent::from_undeviated(cell.centre())))
            .sum::<f64>()
            * lit.lid.area();
        assert!((by_direction / left.flux.value - 1.0).abs() < 0.01, "{system}: {by_direction} {:?}", left.flux);
    }
}

#[test]
fn a_thin_fin_before_a_diffusing_pane_takes_what_its_parts_say() {
    // 4 cm wide and 30 cm deep, between what nine points of the pane see.
    let fin = a_box([1.0, -0.3, 0.0], [1.04, 0.0, 3.0], "luminance = 0.0");
    let own = text(DIFFUSE, OVERCAST, &fin);
    let mut borders = equal(0.5, 1.0, 4);
    borders.extend(equal(1.04, 3.5, 8));
    let (found, parts) = (room(&own), room(&cut(&own, &borders, &equal(0.9, 2.7, 2))));
    for (a, b) in found.sensors.iter().zip(&parts.sensors) {
        let (a, b) = (a.total(), b.total());
        assert!((a.value / b.value - 1.0).abs() < 3e-3, "{a:?} {b:?}");
        assert!((a.value - b.value).abs() <= a.error + b.error, "{a:?} {b:?}");
        assert!(a.error < 0.01 * a.value, "{a:?}");
    }
}

#[test]
fn a_roof_light_beside_a_wall_gets_what_the_wall_leaves_though_both_its_ends_are_alike() {
    // A black wall 2 m high and 4 m long, its middle before the middle of the pane: light falls along the pane and rises
    // again. What a point of the roof does not get is the wall's configuration factor.
    let wall = a_box([0.0, 0.0, 3.0], [4.0, 0.5, 5.0], "luminance = 0.0");
    let own = text(DIFFUSE, "model = \"uniform\"\ndiffuse_horizontal = 10000.0", &wall)
        .replace("\"facade\"", "\"roof\"")
        .replace("[0.5, 0.9]", "[1.0, 1.0]")
        .replace("[3.0, 1.8]", "[2.0, 2.0]");
    let factor = |half: f64, away: f64| {
        let slant = away.hypot(2.0);
        ((half / away).atan() - away / slant * (half / slant).atan()) / (2.0 * std::f64::consts::PI)
    };
    let n = 100;
    let place = |k: i32| 1.0 + 2.0 * (f64::from(k % n) + 0.5) / f64::from(n);
    let hidden = (0..n * n).map(|k| {
        let (x, away) = (place(k), place(k / n) - 0.5);
        factor(x, away) + factor(4.0 - x, away)
    });
    let exact = 0.5 * 4.0 * 10_000.0 * (1.0 - hidden.sum::<f64>() / f64::from(n * n));
    let found = room(&own).flux;
    assert!((found.value / exact - 1.0).abs() < 3e-4, "{found:?} {exact}");
    assert!((found.value - exact).abs() <= found.error, "{found:?} {exact}");
}

#[test]
fn scattered_sun_below_an_overhang_comes_from_what_the_sun_reaches() {
    // The shadow ends so far below the overhang's lower front edge: cut there, one part is in the sun, one in the shade.
    let sun = format!("{BLACK}\nsun = {{ altitude = 48.0, azimuth = 190.0, direct_normal = 50000.0 }}");
    let overhang = a_box([-9.0, -1.2, 2.75], [13.0, 0.0, 2.9], "luminance = 0.0");
    let own = text("system = { file = \"assets/systems/acrylic-diffuser-haze.system.toml\" }", &sun, &overhang);
    let edge = 2.75 - 1.2 * 48_f64.to_radians().tan() / 10_f64.to_radians().cos();
    let (found, parts) = (totals(&own), totals(&cut(&own, &[0.5, 3.5], &[0.9, edge, 2.7])));
    for (a, b) in found.iter().zip(&parts) {
        assert!(*a > 10.0 && (a / b - 1.0).abs() < 1e-3, "{found:?} {parts:?}");
    }
}

#[test]
fn the_room_reflects_the_light_of_an_uneven_pane_from_where_it_comes() {
    let overhang = a_box([0.0, -2.0, 2.75], [4.0, 0.0, 2.9], "luminance = 0.0");
    let own = reflecting(&text(DIFFUSE, OVERCAST, &overhang)).replace("[0.9, 0.6, 0.85]", "[2.0, 0.3, 1.5]");
    let (found, parts) = (room(&own), room(&cut(&own, &equal(0.5, 3.5, 3), &equal(0.9, 2.7, 6))));
    for (a, b) in found.sensors.iter().zip(&parts.sensors) {
        let [reflected, other] = [a, b].map(|sensor| sensor.interreflected.value);
        assert!((reflected / other - 1.0).abs() < 8e-3, "{reflected} {other}");
    }
}

#[test]
fn an_overhang_ends_the_sun_on_the_floor_where_geometry_says() {
    let sun = format!("{BLACK}\nsun = {{ altitude = 35.0, azimuth = 180.0, direct_normal = 50000.0 }}");
    let overhang = a_box([-9.0, -0.8, 2.7], [13.0, 0.0, 2.8], "luminance = 0.0");
    // From the plane 0.85 m up to the overhang's lower front edge, 0.8 m before the façade.
    let edge = (2.7 - 0.85) / 35_f64.to_radians().tan() - 0.8;
    let beams = |outside: &str| {
        let own = text(CLEAR, &sun, outside);
        let points = [-0.05, 0.0, 0.05].map(|by| format!("[2.0, {:.6}, 0.85]", edge + by)).join(", ");
        let own = own.replace("[0.9, 0.6, 0.85], [2.6, 1.7, 0.85], [2.0, 4.0, 0.85]", &points);
        room(&own).sensors.iter().map(|sensor| sensor.beam).collect::<Vec<_>>()
    };
    let whole = 0.8 * 50_000.0 * 35_f64.to_radians().sin();
    let open = beams("");
    assert!(open.iter().all(|beam| (beam / whole - 1.0).abs() < 1e-3), "{open:?} {whole}");
    let [before, at, behind] = beams(&overhang).try_into().unwrap();
    assert!((before / whole - 1.0).abs() < 1e-3 && behind == 0.0, "{before} {behind} {whole}");
    // The disc's middle is on the edge: half of it is seen.
    assert!((at / whole - 0.5).abs() < 0.02, "{at} {whole}");
}

#[test]
fn summer_time_is_an_hour_behind() {
    let place = "[site]\nlatitude = 48.8\nlongitude = 9.2\nutc_offset = 1.0\n";
    let at = |time: &str, dst: &str| {
        let sky = format!("model = \"cie\"\ntype = 12\ndiffuse_horizontal = 9e3\ntime = \"{time}\"");
        let own = text(CLEAR, &sky, "").replace("[site]\n", &format!("{place}{dst}\n"));
        resolve(&own).unwrap().outside.sun_direction().unwrap().altitude()
    };
    assert_eq!(at("2026-07-01T13:00", "dst = \"eu\""), at("2026-07-01T12:00", ""));
    assert_eq!(at("2026-12-01T13:00", "dst = \"eu\""), at("2026-12-01T13:00", ""));
    assert!(at("2026-07-01T13:00", "dst = \"eu\"") > at("2026-07-01T13:00", ""));
}

/// Boxes that reach through each other: the line where their faces meet is no edge of either.
#[test]
fn boxes_that_cross_are_seen_as_rays_see_them() {
    let sky = || Outside::new(Distribution::uniform(), 10_000.0).unwrap();
    let solid = |from, to, turn: f64| Solid::new(DVec3::from_array(from), DVec3::from_array(to), turn.to_radians());
    let boxes = [
        (solid([-0.5, -5.0, 0.0], [1.0, -4.0, 9.0], 20.0), Finish::Luminance(100.0)),
        (solid([-4.0, -4.8, 2.0], [5.0, -4.1, 3.5], 0.0), Finish::Luminance(20_000.0)),
    ];
    let eye = DVec3::new(0.3, 0.0, 1.0);
    let seen = seen(&sky(), None, setting(boxes.to_vec(), 0.0), eye);
    assert!(!seen.surroundings().unwrap().lines.is_empty());
    let n = 1000;
    let at = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0;
    // Through an opening 1 m before the eye, by a grid on it.
    let corners = [[-1.0, -1.0, 0.05], [1.0, -1.0, 0.05], [1.0, -1.0, 1.05], [-1.0, -1.0, 1.05]].map(DVec3::from_array);
    let up = Dir::from_unit(DVec3::Z);
    let found = irradiance_through(&seen, &corners, up, |_| 1.0, Tolerance::relative(1e-4)).value;
    let mut on_grid = 0.0;
    for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (at(a), at(b)))) {
        let p = DVec3::new(a, -1.0, 0.55 + 0.5 * b);
        let d = p.normalize();
        on_grid += seen.luminance(Dir::from_unit(d)) * d.z / p.length_squared() * -d.y * 2.0 / f64::from(n * n);
    }
    assert!((found / on_grid - 1.0).abs() < 2e-3, "{found} {on_grid}");
}

#[test]
fn light_on_many_boxes_ends_when_it_is_not_wanted() {
    struct Withdrawn;
    impl Progress for Withdrawn {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let sky = Outside::new(Distribution::uniform(), 10_000.0).unwrap();
    let one = |k: u32| {
        let x = f64::from(k) - 10.0;
        (Solid::new(DVec3::new(x, -9.0, 0.0), DVec3::new(x + 0.8, -8.0, 4.0), 0.0), Finish::Reflectance(0.3))
    };
    let boxes: Vec<_> = (6..14).map(one).collect();
    let setting = setting(boxes, 0.0);
    let viewing = Viewing { viewpoints: &[DVec3::Z], target: 0.01 };
    let lit = |progress: &dyn Progress| surroundings(&sky, None, &setting, [1.0, 0.0], None, &viewing, progress);
    assert!(lit(&Withdrawn).is_err());
    let panels = |boxes: &[[FaceLight; 6]]| boxes.iter().flatten().map(FaceLight::panels).sum::<usize>();
    let around = lit(&Silent).unwrap();
    assert!(around.is_lit() && panels(&around.faces) < 1000, "{}", panels(&around.faces));
}

#[test]
fn a_post_on_the_glass_hides_what_is_behind_it_whatever_the_system() {
    // On the glass nothing comes in under it; a millimetre off hardly more does.
    let panel = root().join("assets/systems/laser-cut-panel.system.toml");
    let described = format!("system = {{ file = {panel:?} }}");
    let post = |gap: f64| a_box([3.3, -1.0, 0.0], [3.5, -gap, 3.0], "reflectance = 0.0");
    let low = |gap: f64| a_box([0.0, -0.5, 0.8], [4.0, -gap, 1.94], "reflectance = 0.0");
    for outside in [&post as &dyn Fn(f64) -> String, &low] {
        let [on, off] = [0.0, 0.001].map(|gap| totals(&text(&described, OVERCAST, &outside(gap))));
        for (on, off) in on.iter().zip(&off) {
            assert!(*on > 1.0 && (on / off - 1.0).abs() < 0.01, "{on} {off}");
        }
    }
}

#[test]
fn another_product_before_the_same_obstructions_finds_them_lit() {
    let overhang = a_box([0.0, -1.0, 2.8], [4.0, 0.0, 3.0], "");
    let library = Library::default();
    let of = |system: &str, sky: &str| {
        let file = SceneFile::parse(&text(system, sky, &overhang)).unwrap();
        Scene::resolve(&file, Path::new("."), &library).unwrap()
    };
    let at = |scene: &Scene| std::ptr::from_ref(scene.outside.surroundings().unwrap());
    let first = of("system = { ideal = \"diffuse\", transmittance = 0.5 }", OVERCAST);
    let other = of("system = { ideal = \"transparent\", transmittance = 0.8 }", OVERCAST);
    assert_eq!(at(&first), at(&other));
    let darker = of("system = { ideal = \"diffuse\", transmittance = 0.5 }", BLACK);
    assert!(at(&darker) != at(&first) && !darker.outside.is_lit());
    // What is kept is what would be computed anew.
    assert_eq!(
        first.outside,
        resolve(&text("system = { ideal = \"diffuse\", transmittance = 0.5 }", OVERCAST, &overhang)).unwrap().outside
    );
}
