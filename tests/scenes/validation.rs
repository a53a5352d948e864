//! Whole scenes against closed forms, conservation laws and symmetries. No external data.

use crate::rooms::*;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{CellMatrix, Dataset};
use cfs::compute::direction::{Dir, Facade};
use cfs::compute::estimate::Silent;
use cfs::compute::room::direct::Sensor;
use cfs::formats::{Format, read_dataset, write_dataset};
use cfs::study::{Library, Scene, SceneFile, Session};
use glam::DVec3;
use std::f64::consts::PI;
use std::path::Path;

/// The data as they are: light keeps to their cells.
const PATCH: &str = "interpolation = \"patch\"";

fn close(got: f64, want: f64, relative: f64, what: &str) {
    assert!((got - want).abs() <= relative * want.abs(), "{what}: {got} instead of {want}");
}

/// Total flux on all sides by midpoints, n² a side. [lm]
fn flux_on_all_sides(scene: &Scene, n: usize) -> f64 {
    let list = on_all_sides(scene.room.size, n);
    let mut scene = scene.clone();
    scene.sensors = list.iter().map(|(sensor, _)| *sensor).collect();
    scene.grid = None;
    totals(&compute(&scene)).iter().zip(&list).map(|(e, (_, area))| e * area).sum()
}

#[test]
fn overcast_sky_through_an_unglazed_window_follows_the_closed_form() {
    // Sky component at sill level on the perpendicular of the window's side, traditional overcast sky (Walsh; Hopkinson,
    // Petherbridge, Longmore, Daylighting, 1966).
    let closed = |w: f64, h: f64, d: f64| {
        let (k, p): (f64, f64) = (h / d, (w / d).atan());
        let c = (1.0 + k * k).sqrt();
        let uniform = 0.5 * (p - (p.tan() / c).atan() / c);
        let s = k * p.sin();
        let gradient = 2.0 / 3.0 * ((s / c).asin() - s / (c * c * (c * c - s * s).sqrt()));
        3.0 / (7.0 * PI) * (uniform + gradient)
    };
    for ([w, h, d], printed) in
        [([1.0, 1.0, 1.0], Some(0.045_251)), ([2.0, 1.5, 3.0], Some(0.011_472)), ([0.7, 2.1, 0.4], None)]
    {
        if let Some(printed) = printed {
            assert!((closed(w, h, d) - printed).abs() < 6e-7, "{}", closed(w, h, d));
        }
        let text = Text {
            apertures: vec![facade([1.0, 0.6], [w, h], TRANSPARENT)],
            sensors: points(&[[1.0, d, 0.6], [1.0 + w, d, 0.6]], [0.0, 0.0, 1.0]),
            compute: "error_target = 1e-5".into(),
            ..Text::default()
        };
        for e in totals(&text.result()) {
            close(e / 10_000.0, closed(w, h, d), 2e-6, "sky component");
        }
    }
    // Low at the foot of an endless wall of sky: a quarter and the gradient's share, both known.
    assert!((closed(1e3, 1e3, 0.1) - 0.25).abs() < 1e-3);
}

#[test]
fn lambert_rectangle_in_front_of_a_sensor() {
    // L = 1000 cd/m² on 1.2 m × 1.0 m, on the axis, facing.
    let text = Text {
        room: [4.0, 12.0, 3.0],
        apertures: vec![facade([1.0, 1.0], [1.2, 1.0], DIFFUSE)],
        sky: format!("model = \"uniform\"\ndiffuse_horizontal = {:?}", 2000.0 * PI),
        sensors: points(&[[1.6, 1.0, 1.5], [1.6, 10.0, 1.5], [1.6, 0.2, 1.5]], [0.0, -1.0, 0.0]),
        ..Text::default()
    };
    let facing = |d: f64| {
        let (x, y): (f64, f64) = (0.6 / d, 0.5 / d);
        let (a, b) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
        2000.0 * (x / a * (y / a).atan() + y / b * (x / b).atan())
    };
    for ((e, d), printed) in totals(&text.result()).into_iter().zip([1.0, 10.0, 0.2]).zip([857.324, 11.9514, 2827.90]) {
        close(e, facing(d), 1e-9, "facing");
        close(e, printed, 1e-6, "printed");
    }
}

#[test]
fn an_endless_uniform_outside_looks_the_same_through_every_colourless_system() {
    // Sky and ground of the same luminance: clear opening, diffuser and straight cells are one emitter.
    let list = [[1.0, 0.4, 0.85], [2.0, 3.0, 0.85], [3.9, 5.9, 0.1]];
    for aperture in [
        (|s: &str| facade([0.5, 1.0], [3.0, 1.5], s)) as fn(&str) -> String,
        (|s: &str| roof([0.5, 1.0], [3.0, 1.5], s)) as fn(&str) -> String,
    ] {
        let values = [TRANSPARENT, DIFFUSE, MADE].map(|system| {
            let text = Text {
                reflectance: [0.2, 0.5, 0.7],
                apertures: vec![aperture(system)],
                sky: UNIFORM.into(),
                ground: 1.0,
                sensors: points(&list, [0.0, 0.0, 1.0]),
                compute: PATCH.into(),
                ..Text::default()
            };
            compute(&text.scene_with(straight_cells()))
        });
        for other in &values[1..] {
            close(other.flux.value, 10_000.0 * 4.5, 1e-6, "flux");
            for (a, b) in values[0].sensors.iter().zip(&other.sensors) {
                close(b.direct.value, a.direct.value, 1e-6, "direct");
                // Closed form against points on the patches.
                close(b.interreflected.value, a.interreflected.value, 5e-3, "interreflected");
            }
        }
    }
}

#[test]
fn straight_cells_keep_the_flux_of_a_clear_opening() {
    for sky in [OVERCAST.to_owned(), clear(35.0, 200.0, 0.0), clear(35.0, 200.0, 70_000.0)] {
        let fluxes = [TRANSPARENT, MADE].map(|system| {
            let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], system)];
            let text = Text { apertures, sky: sky.clone(), ground: 0.2, compute: PATCH.into(), ..Text::default() };
            compute(&text.scene_with(straight_cells())).flux.value
        });
        close(fluxes[1], fluxes[0], 1e-5, &sky);
    }
}

#[test]
fn direct_light_on_all_surfaces_is_the_flux_of_the_aperture() {
    for (system, slack) in [(TRANSPARENT, 3e-3), (DIFFUSE, 3e-3), (MADE, 3e-3)] {
        for aperture in [facade([1.0, 1.0], [1.0, 0.8], system), roof([1.0, 0.9], [1.2, 1.0], system)] {
            let text = Text {
                room: [3.0, 2.8, 2.6],
                apertures: vec![aperture],
                sky: clear(35.0, 200.0, 0.0),
                ground: 0.2,
                ..Text::default()
            };
            let scene = text.scene_with(klems(rough));
            close(flux_on_all_sides(&scene, 36), compute(&scene).flux.value, slack, system);
        }
    }
}

#[test]
fn mean_illuminance_of_a_room_of_one_reflectance() {
    // Summed over all surfaces, opening included, the balance E = E₀ + FρE gives Ē = Φ/(S(1 − ρ)) whatever the shape.
    for rho in [0.3, 0.8, 0.95, 0.99] {
        for system in [DIFFUSE, TRANSPARENT, MADE] {
            let text = Text {
                room: [3.0, 2.8, 2.6],
                reflectance: [rho; 3],
                apertures: vec![format!("{}\nreflectance = {rho:?}", facade([1.0, 1.0], [1.0, 0.8], system))],
                sky: clear(35.0, 200.0, 0.0),
                ground: 0.2,
                ..Text::default()
            };
            let scene = text.scene_with(klems(rough));
            let received = flux_on_all_sides(&scene, 24);
            let want = compute(&scene).flux.value / (1.0 - rho);
            close(received, want, 6e-3, &format!("ρ = {rho}, {system}"));
        }
    }
}

#[test]
fn what_enters_is_absorbed() {
    // Different reflectances: the opening (black) and the surfaces take up exactly what came in.
    let rho = [0.3, 0.6, 0.8];
    let text = Text {
        room: [3.0, 2.8, 2.6],
        reflectance: rho,
        apertures: vec![facade([1.0, 1.0], [1.0, 0.8], MADE)],
        sky: OVERCAST.into(),
        ..Text::default()
    };
    let mut scene = text.scene_with(klems(rough));
    let flux = compute(&scene).flux.value;
    let list = on_all_sides(scene.room.size, 30);
    scene.sensors = list.iter().map(|(sensor, _)| *sensor).collect();
    let absorbed: f64 = totals(&compute(&scene))
        .iter()
        .zip(&list)
        .map(|(e, (sensor, area))| {
            let p = sensor.position;
            let opening = p.y == 0.0 && (1.0..2.0).contains(&p.x) && (1.0..1.8).contains(&p.z);
            let own = match sensor.normal.z {
                n if n > 0.5 => rho[0],
                n if n < -0.5 => rho[2],
                _ if opening => 0.0,
                _ => rho[1],
            };
            e * area * (1.0 - own)
        })
        .sum();
    close(absorbed, flux, 4e-3, "absorbed");
}

/// The left-right mirror of a dataset on the full Klems basis.
fn mirrored(q: impl Fn(Dir<Facade>, Dir<Facade>) -> f64) -> Dataset {
    let flip = |d: Dir<Facade>| {
        let v = d.vector();
        Dir::from_unit(DVec3::new(-v.x, v.y, v.z))
    };
    klems(move |i, o| q(flip(i), flip(o)))
}

#[test]
fn a_mirrored_scene_gives_mirrored_light() {
    let scene = |mirror: bool| {
        let place = |x: f64, w: f64| if mirror { 4.0 - x - w } else { x };
        let side = if mirror { -1.0 } else { 1.0 };
        let list = [[0.5, 1.0, 0.85], [1.7, 4.0, 0.85], [3.6, 0.3, 2.0]].map(|[x, y, z]| [place(x, 0.0), y, z]);
        let text = Text {
            reflectance: [0.2, 0.5, 0.7],
            apertures: vec![
                facade([place(0.3, 1.1), 0.9], [1.1, 1.4], MADE),
                roof([place(2.2, 0.9), 3.0], [0.9, 1.3], MADE),
                facade([place(2.5, 1.2), 1.0], [1.2, 1.0], TRANSPARENT),
            ],
            azimuth: 160.0,
            ground: 0.2,
            sky: clear(33.0, 160.0 + side * 40.0, 60_000.0),
            sensors: points(&list, [side * 0.36, -0.48, 0.8]),
            ..Text::default()
        };
        let dataset = if mirror { mirrored(rough) } else { klems(rough) };
        compute(&text.scene_with(dataset))
    };
    let (plain, mirror) = (scene(false), scene(true));
    for (a, b) in plain.sensors.iter().zip(&mirror.sensors) {
        close(b.direct.value, a.direct.value, 2e-5, "direct");
        close(b.interreflected.value, a.interreflected.value, 1e-4, "interreflected");
    }
    // Not because the data are symmetric themselves.
    let wrong = plain.sensors[0].direct.value;
    let text = Text { apertures: vec![facade([0.3, 0.9], [1.1, 1.4], MADE)], ..Text::default() };
    let [a, b] = [klems(rough), mirrored(rough)].map(|dataset| totals(&compute(&text.scene_with(dataset)))[0]);
    assert!((a / b - 1.0).abs() > 1e-2 && wrong > 0.0, "{a} {b}");
}

#[test]
fn light_from_above_right_into_below_left_lands_left_and_on_the_floor() {
    // Through-names: light that goes to the left and down comes, straight on, from the right and above.
    let probe = |i: Dir<Facade>, o: Dir<Facade>| {
        let (i, o) = (i.vector(), o.vector());
        if i.x > 0.1 && i.y > 0.1 && o.x > 0.1 && o.y > 0.1 { 1.0 / PI } else { 0.0 }
    };
    let lit = |sun_azimuth: f64, position: [f64; 3], normal: [f64; 3]| {
        let text = Text {
            room: [4.0, 4.0, 4.0],
            apertures: vec![facade([1.5, 1.5], [1.0, 1.0], MADE)],
            sky: sun_alone(35.0, sun_azimuth),
            sensors: points(&[position], normal),
            ..Text::default()
        };
        totals(&compute(&text.scene_with(klems(probe))))[0]
    };
    // The façade looks south: seen from outside, right (x) is east.
    let places = [
        ("left wall, low", [0.0, 1.5, 0.8], [1.0, 0.0, 0.0], true),
        ("floor, left", [1.0, 1.5, 0.0], [0.0, 0.0, 1.0], true),
        ("left wall, high", [0.0, 1.5, 3.4], [1.0, 0.0, 0.0], false),
        ("right wall, low", [4.0, 1.5, 0.8], [-1.0, 0.0, 0.0], false),
        ("ceiling, left", [1.0, 1.5, 4.0], [0.0, 0.0, -1.0], false),
        ("floor, right", [3.2, 1.5, 0.0], [0.0, 0.0, 1.0], false),
    ];
    for (what, position, normal, expected) in places {
        assert_eq!(lit(120.0, position, normal) > 1.0, expected, "{what}, sun in the south-east");
        assert_eq!(lit(240.0, position, normal), 0.0, "{what}, sun in the south-west");
    }
}

#[test]
fn a_front_block_derived_by_reciprocity_is_the_front_block() {
    let full = klems(rough);
    let front = full.visible.transmission_front.clone().unwrap();
    let Some(cfs::compute::btdf::Scattered::Cells(matrix)) = &front.scattered else { panic!() };
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_BACK);
    // The back block of a file counts both azimuths from inside: q_back(ω′, ω_e) = q_front(ω_e, ω′) direction by direction.
    let front_basis = matrix.incident();
    let mut values = vec![0.0; basis.len() * basis.len()];
    for (i, from) in basis.cells().enumerate() {
        for (o, to) in basis.cells().enumerate() {
            let (e, a) = (front_basis.index(to.centre()).unwrap(), front_basis.index(from.centre()).unwrap());
            values[i * basis.len() + o] = matrix.row(e)[a];
        }
    }
    let mut back_only = Dataset { name: "back".into(), ..Dataset::default() };
    back_only.visible.transmission_back =
        Some(cfs::compute::btdf::Btdf::from_cells(CellMatrix::new(basis.clone(), basis, values).unwrap()));
    let through_file = |dataset: &Dataset| {
        let written = write_dataset(Format::BsdfXml, std::slice::from_ref(dataset)).unwrap();
        read_dataset("made.xml", &written.bytes).unwrap().remove(0)
    };
    let text = Text {
        reflectance: [0.2, 0.5, 0.7],
        apertures: vec![facade([0.3, 0.9], [1.1, 1.4], MADE)],
        sky: clear(33.0, 200.0, 60_000.0),
        ground: 0.2,
        ..Text::default()
    };
    let [want, got] = [&full, &back_only].map(|dataset| totals(&compute(&text.scene_with(through_file(dataset)))));
    for (a, b) in want.iter().zip(&got) {
        close(*b, *a, 1e-5, "derived front");
    }
}

#[test]
fn a_roof_is_a_facade_lying_down() {
    // Façade (x, depth y, height z) ↔ roof (x, along z, depth from the ceiling y): the same data, the same relative sun.
    let (w, a, b) = (4.0, 3.0, 5.0);
    let opening = ([0.7, 0.6], [2.1, 1.5]);
    let list = [[0.5, 0.7, 0.4], [2.0, 2.5, 1.1], [3.5, 4.5, 2.9]];
    let normal = [0.36, -0.48, 0.8];
    let sun = DVec3::new(0.3, 0.5, 0.8).normalize();
    let angles = |room: DVec3| {
        let azimuth = 180.0 + (-room.x).atan2(-room.y).to_degrees();
        (room.z.asin().to_degrees(), azimuth)
    };
    let turn = |[x, y, z]: [f64; 3]| [x, z, b - y];
    let turned_normal = [normal[0], normal[2], -normal[1]];
    for (system, sunny) in [(MADE, false), (MADE, true), (TRANSPARENT, true), (DIFFUSE, true), (TRANSPARENT, false)] {
        let sky = |room: DVec3| {
            let (altitude, azimuth) = angles(room);
            if sunny { sun_alone(altitude, azimuth.rem_euclid(360.0)) } else { UNIFORM.into() }
        };
        let ground = if sunny { 0.0 } else { 1.0 };
        let upright = Text {
            room: [w, b, a],
            reflectance: [0.5; 3],
            apertures: vec![facade(opening.0, opening.1, system)],
            sky: sky(DVec3::new(sun.x, -sun.z, sun.y)),
            ground,
            sensors: points(&list, normal),
            ..Text::default()
        };
        let lying = Text {
            room: [w, a, b],
            apertures: vec![roof(opening.0, opening.1, system)],
            sky: sky(sun),
            sensors: points(&list.map(turn), turned_normal),
            ..upright.clone()
        };
        let [up, flat] = [upright, lying].map(|text| compute(&text.scene_with(klems(rough))));
        close(flat.flux.value, up.flux.value, 1e-6, "flux");
        assert!(up.flux.value > 100.0);
        for (p, q) in up.sensors.iter().zip(&flat.sensors) {
            close(q.direct.value, p.direct.value, 1e-6, system);
            close(q.interreflected.value, p.interreflected.value, 1e-6, system);
        }
    }
}

#[test]
fn a_sun_patch_is_where_geometry_puts_it() {
    // Sun square to the façade at 45°: the opening 1.0 … 2.0 m high is thrown on the floor 1.0 … 2.0 m deep.
    let text = Text {
        apertures: vec![facade([1.0, 1.0], [2.0, 1.0], "{ ideal = \"transparent\", transmittance = 0.8 }")],
        sky: sun_alone(45.0, 180.0),
        sensors: points(
            &[
                [2.0, 0.98, 0.0],
                [2.0, 1.02, 0.0],
                [2.0, 1.97, 0.0],
                [2.0, 2.04, 0.0],
                [0.99, 1.5, 0.0],
                [1.02, 1.5, 0.0],
            ],
            [0.0, 0.0, 1.0],
        ),
        ..Text::default()
    };
    let lit = 0.8 * 80_000.0 * 0.5_f64.sqrt();
    for (e, want) in totals(&text.result()).iter().zip([0.0, lit, lit, 0.0, 0.0, lit]) {
        assert!((e - want).abs() < 1e-6 * lit, "{e} instead of {want}");
    }
}

#[test]
fn a_controlled_blind_of_the_catalogue_keeps_the_sun_out() {
    let folder = tempfile::tempdir().unwrap();
    let library = Library::with_catalogue(Some(&folder.path().join("catalogue.cfsdb")));
    let scene = |altitude: f64, azimuth: f64, mode: &str| {
        let text = Text {
            apertures: vec![facade(
                [0.5, 1.0],
                [3.0, 1.5],
                "{ catalogue = \"venetian-80-72\", state = \"controlled\" }",
            )],
            sky: clear(altitude, azimuth, 60_000.0),
            ..Text::default()
        };
        let toml = format!("{}[control]\nmode = \"{mode}\"\n", text.toml());
        Scene::resolve(&SceneFile::parse(&toml).unwrap(), Path::new("."), &library).unwrap()
    };
    for (altitude, azimuth) in [(10.0, 180.0), (20.0, 200.0), (30.0, 150.0), (60.0, 180.0_f64)] {
        let scene = scene(altitude, azimuth, "cut-off");
        let tilt: f64 = scene.apertures[0].system.state.parse().unwrap();
        // β_c = asin(s/w · cosψ) − ψ, rounded up to the next 5°, never below horizontal; tan ψ = tan h / cos Δaz.
        let (altitude, turn) = (altitude.to_radians(), (azimuth - 180.0).to_radians());
        let psi = (altitude.tan() / turn.cos()).atan();
        let demanded = ((0.9 * psi.cos()).asin() - psi).to_degrees().max(0.0);
        assert!(tilt >= demanded - 0.3 && tilt < demanded + 5.3, "{tilt}° for {demanded}°");
        assert!(Session::new().room(&scene, &Silent).unwrap().flux.value > 0.0);
    }
    assert_eq!(scene(30.0, 180.0, "din-5034").apertures[0].system.state, "75");
    // The sun behind the façade: as open as can be.
    for mode in ["cut-off", "curve", "din-5034"] {
        assert_eq!(scene(30.0, 0.0, mode).apertures[0].system.state, "0", "{mode}");
    }
}

#[test]
fn a_sensor_counts_light_from_in_front_of_it_alone() {
    // Facing ±n in turn splits the vector integral: E(n) − E(−n) is linear in n for light without scattering.
    let text = Text { sky: OVERCAST.into(), ground: 0.2, ..Text::default() };
    let at = |normal: DVec3| {
        let mut scene = text.scene_with(klems(rough));
        scene.sensors = vec![Sensor { position: DVec3::new(1.3, 1.1, 1.6), normal }];
        totals(&compute(&scene))[0]
    };
    let net = |n: DVec3| at(n) - at(-n);
    let (x, y, z) = (net(DVec3::X), net(DVec3::Y), net(DVec3::Z));
    let n = DVec3::new(0.48, -0.6, 0.64);
    close(net(n), x * n.x + y * n.y + z * n.z, 1e-4, "net vector");
}

#[test]
fn a_tighter_error_target_is_kept() {
    for system in [TRANSPARENT, MADE] {
        let text = Text {
            reflectance: [0.2, 0.5, 0.7],
            apertures: vec![facade([0.5, 1.0], [3.0, 1.5], system)],
            sky: clear(35.0, 200.0, 0.0),
            ..Text::default()
        };
        let tight = Text { compute: "error_target = 0.002".into(), ..text.clone() };
        let [ordinary, tight] = [text, tight].map(|text| compute(&text.scene_with(klems(rough))));
        let sum = |f: fn(&cfs::study::SensorResult) -> f64, list: &[cfs::study::SensorResult]| -> f64 {
            list.iter().map(f).sum()
        };
        let stated = [&ordinary, &tight].map(|r| sum(|s| s.interreflected.error, &r.sensors));
        assert!(stated[1] < 0.7 * stated[0], "{stated:?}");
        for (a, b) in ordinary.sensors.iter().zip(&tight.sensors) {
            let (a, b) = (a.total(), b.total());
            assert!((a.value - b.value).abs() <= a.error + b.error, "{system}: {a:?} {b:?}");
            assert!(b.error > 0.0 && b.error < 0.02 * b.value, "{b:?}");
        }
    }
}
