//! What the plan leaves out changes no result beyond what is stated: every rule against the same scene with the rule
//! defeated.

use crate::rooms::*;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{AngularTransmittance, Scattered};
use cfs::compute::estimate::Silent;
use cfs::compute::room::direct::Sensor;
use cfs::study::control::ControlQuestion;
use cfs::study::scene_file::SystemKeys;
use cfs::study::system::Need;
use cfs::study::{RoomResult, Scene, Session, Store, StudyError, System, SystemLibrary};
use glam::DVec3;
use std::sync::{Arc, Mutex};

fn fresh(scene: &Scene) -> RoomResult {
    Session::new().room(scene, &Silent).unwrap()
}

fn stage(result: &RoomResult, name: &str) -> (bool, String) {
    let stage = result.plan.stages.iter().find(|stage| stage.name == name);
    stage.map(|stage| (stage.runs, stage.reason.clone())).unwrap_or_else(|| panic!("no stage {name}"))
}

fn left_out(result: &RoomResult, name: &str) -> bool {
    !stage(result, name).0
}

/// Sensor by sensor within a relative bound, the mean being the least that counts.
fn same(a: &RoomResult, b: &RoomResult, relative: f64) {
    let (a, b) = (totals(a), totals(b));
    let mean = a.iter().sum::<f64>() / a.len() as f64;
    assert!(mean > 0.0);
    for (x, y) in a.iter().zip(&b) {
        assert!((x - y).abs() <= relative * x.max(0.1 * mean), "{x} {y}");
    }
}

fn reflecting(system: &str, sky: &str) -> Text {
    Text {
        reflectance: [0.2, 0.5, 0.7],
        apertures: vec![facade([0.5, 1.0], [3.0, 1.5], system)],
        ground: 0.2,
        sky: sky.into(),
        ..Text::default()
    }
}

#[test]
fn a_sun_that_reaches_no_aperture_is_left_out() {
    // The façade faces south. The sky of a type without circumsolar light is the same for every sun.
    let sky = |sun: &str| format!("model = \"cie\"\ntype = 1\ndiffuse_horizontal = 10000.0\n{sun}");
    let sun = |altitude: f64, azimuth: f64| {
        sky(&format!("sun = {{ altitude = {altitude:?}, azimuth = {azimuth:?}, direct_normal = 60000.0 }}"))
    };
    let make = |sky: &str, system: &str| Text { ground: 0.0, ..reflecting(system, sky) }.scene_with(klems(rough));
    for system in [TRANSPARENT, MADE] {
        let without = fresh(&make(&sky(""), system));
        assert!(left_out(&without, "sun"));
        for hidden in [
            sun(30.0, 10.0),
            sun(-5.0, 180.0),
            // Obstructed, by a skyline that is as bright as nothing else.
            format!("{}\nobstruction = {{ altitude = 20.0, luminance = 500.0 }}", sun(12.0, 180.0)),
        ] {
            let result = fresh(&make(&hidden, system));
            assert!(left_out(&result, "sun"), "{hidden}");
            if !hidden.contains("obstruction") {
                same(&without, &result, 1e-12);
            }
        }
        // The rule defeated: an edge of the disc looks over the skyline, over the horizon, or around the façade.
        for (hidden, edge) in [(sun(30.0, 89.5), sun(30.0, 89.76)), (sun(-0.27, 180.0), sun(-0.266, 180.0))] {
            let (a, b) = (fresh(&make(&hidden, system)), fresh(&make(&edge, system)));
            assert!(left_out(&a, "sun") && !left_out(&b, "sun"), "{hidden} {edge}");
            same(&a, &b, 1e-2);
        }
    }
}

#[test]
fn a_black_ground_is_left_out() {
    for system in [TRANSPARENT, DIFFUSE, MADE] {
        let make = |ground: f64| fresh(&Text { ground, ..reflecting(system, OVERCAST) }.scene_with(klems(rough)));
        let (black, nearly) = (make(0.0), make(1e-12));
        assert!(left_out(&black, "ground") && !left_out(&nearly, "ground"));
        same(&black, &nearly, 1e-6);
    }
}

#[test]
fn a_lambertian_system_needs_no_cells() {
    let lambert = fresh(&reflecting(DIFFUSE, &clear(35.0, 170.0, 50_000.0)).scene());
    assert!(left_out(&lambert, "cells") && left_out(&lambert, "sky at sensors"));
    // The same as cells, all of one value.
    let even = klems(|_, _| std::f64::consts::FRAC_1_PI);
    let cells = fresh(&reflecting(MADE, &clear(35.0, 170.0, 50_000.0)).scene_with(even));
    assert!(!left_out(&cells, "cells"));
    for (a, b) in lambert.sensors.iter().zip(&cells.sensors) {
        assert!((a.direct.value / b.direct.value - 1.0).abs() < 1e-5, "{a:?} {b:?}");
        assert!((a.total().value - b.total().value).abs() <= a.total().error + b.total().error, "{a:?} {b:?}");
    }
}

#[test]
fn a_transparent_system_needs_no_btdf() {
    let sky = clear(35.0, 170.0, 50_000.0);
    let clear = fresh(&reflecting(TRANSPARENT, &sky).scene());
    assert!(left_out(&clear, "cells") && !left_out(&clear, "seen through"));
    // With next to nothing scattered beside it.
    let mut hazy = klems(|_, _| 1e-12);
    if let Some(btdf) = hazy.visible.transmission_front.as_mut() {
        btdf.regular = Some(AngularTransmittance::Constant(1.0));
        assert!(matches!(btdf.scattered, Some(Scattered::Cells(_))));
    }
    let with_cells = fresh(&reflecting(MADE, &sky).scene_with(hazy));
    assert!(!left_out(&with_cells, "cells"));
    same(&clear, &with_cells, 1e-6);
}

#[test]
fn an_even_sky_seen_through_has_a_closed_form() {
    let uniform = fresh(&Text { ground: 0.0, ..reflecting(TRANSPARENT, UNIFORM) }.scene());
    assert!(left_out(&uniform, "sky at sensors"));
    // A skyline that is hardly brighter and hardly above the horizon.
    let nearly = format!("{UNIFORM}\nobstruction = {{ altitude = 1e-6, luminance = 3184.0 }}");
    let integrated = fresh(&Text { ground: 0.0, ..reflecting(TRANSPARENT, &nearly) }.scene());
    assert!(!left_out(&integrated, "sky at sensors"));
    for (a, b) in uniform.sensors.iter().zip(&integrated.sensors) {
        assert!((a.total().value - b.total().value).abs() <= a.total().error + b.total().error, "{a:?} {b:?}");
        assert!((a.direct.value / b.direct.value - 1.0).abs() < 1e-3, "{a:?} {b:?}");
    }
}

#[test]
fn without_reflection_there_is_no_balance() {
    let make = |rho: f64, compute: &str| {
        let text = Text { reflectance: [rho; 3], compute: compute.into(), ..reflecting(DIFFUSE, OVERCAST) };
        let mut text = text;
        text.apertures[0] += "\nreflectance = 0.0";
        fresh(&text.scene())
    };
    let (black, nearly) = (make(0.0, ""), make(1e-12, ""));
    assert!(left_out(&black, "interreflection") && !left_out(&nearly, "interreflection"));
    assert!(black.plan.stages.iter().all(|stage| stage.name != "room factors"), "{:?}", black.plan);
    same(&black, &nearly, 1e-9);
    let direct_alone = make(0.5, "interreflection = false");
    assert!(left_out(&direct_alone, "interreflection"));
    for (a, b) in direct_alone.sensors.iter().zip(&make(0.5, "").sensors) {
        assert_eq!(a.direct, b.direct);
        assert_eq!(a.interreflected.value, 0.0);
    }
}

#[test]
fn cells_that_no_sensor_sees_do_not_matter() {
    let scene = |q: fn(f64) -> f64| {
        let text = Text { reflectance: [0.0; 3], ..reflecting(MADE, OVERCAST) };
        text.scene_with(klems(move |i, o| rough(i, o) + q(o.vector().y)))
    };
    let plain = fresh(&scene(|_| 0.0));
    let (runs, reason) = stage(&plain, "unseen cells");
    assert!(!runs && reason.contains(" of 145 "), "{reason}");
    // What goes up (named by where it would have come from: below) is seen by no sensor that looks up.
    let more = fresh(&scene(|y| if y < -0.15 { 0.4 } else { 0.0 }));
    same(&plain, &more, 0.0);
    assert!(more.flux.value > 1.1 * plain.flux.value);
    // A sensor that looks down sees them, and changes nothing for the others.
    let mut with_another = scene(|_| 0.0);
    with_another.sensors.push(Sensor { position: DVec3::new(2.0, 1.0, 2.9), normal: DVec3::NEG_Z });
    let down = fresh(&with_another);
    assert_eq!(totals(&down)[..24], totals(&plain)[..]);
    assert!(totals(&down)[24] > 0.0 && stage(&down, "unseen cells").1 != reason);
}

/// Counts what is loaded.
struct States(Mutex<Vec<String>>);

impl SystemLibrary for States {
    fn load(&self, keys: &SystemKeys, _: &std::path::Path, _: Need) -> Result<Arc<System>, StudyError> {
        let SystemKeys::Catalogue { state: Some(state), .. } = keys else { panic!("{keys:?}") };
        self.0.lock().unwrap().push(state.clone());
        let level: f64 = state.parse().unwrap();
        let dataset = Arc::new(klems(move |i, o| level * rough(i, o)));
        Ok(Arc::new(System { label: "states".into(), state: state.clone(), dataset, model: None }))
    }
    fn controlled_state(&self, _: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        Ok(if asked.facing.sun_illuminance() > 0.0 { "0.3".into() } else { "1.0".into() })
    }
}

#[test]
fn states_that_the_control_does_not_pick_are_not_loaded() {
    let make = |state: &str, control: &str, library: &States| {
        let system = format!("{{ catalogue = \"made\", state = \"{state}\" }}");
        let sky = clear(35.0, 170.0, 50_000.0);
        let text = Text { compute: control.into(), ..reflecting(&system, &sky) };
        fresh(&text.resolve(library).unwrap())
    };
    let library = States(Mutex::default());
    let controlled = make("controlled", "[control]\nmode = \"cut-off\"", &library);
    assert_eq!(*library.0.lock().unwrap(), ["0.3"]);
    let (runs, reason) = stage(&controlled, "other states");
    assert!(!runs && reason.contains("0.3"), "{reason}");
    let named = make("0.3", "", &library);
    assert!(named.plan.stages.iter().all(|stage| stage.name != "other states"));
    same(&controlled, &named, 0.0);
    assert!(totals(&make("1.0", "", &library))[0] > 2.0 * totals(&named)[0]);
}

#[test]
fn a_new_sky_reuses_the_room_and_gives_the_same_as_from_nothing() {
    let make = |sky: &str| reflecting(MADE, sky).scene_with(klems(rough));
    let session = Session::new();
    let first = session.room(&make(OVERCAST), &Silent).unwrap();
    let other = make(&clear(35.0, 170.0, 50_000.0));
    let second = session.room(&other, &Silent).unwrap();
    for name in ["receptions", "room factors"] {
        assert!(!left_out(&first, name), "{name}");
        assert!(left_out(&second, name) && stage(&second, name).1.contains("reused"), "{name}");
    }
    same(&second, &fresh(&other), 0.0);
    // Another basis needs its own receptions, not its own room.
    let basis = RingBasis::klems_half(AzimuthMap::KLEMS_FRONT);
    let values = vec![0.15; basis.len() * basis.len()];
    let half = cfs::compute::btdf::CellMatrix::new(basis.clone(), basis, values).unwrap();
    let third = session.room(&reflecting(MADE, OVERCAST).scene_with(from_matrix(half)), &Silent).unwrap();
    assert!(!left_out(&third, "receptions") && left_out(&third, "room factors"));
}

#[test]
fn rooms_of_one_shape_share_their_exchange_areas() {
    let of = |walls: f64| Text { reflectance: [0.2, walls, 0.7], ..Text::default() }.scene();
    let store = Arc::new(Store::new(1 << 30));
    let session = Session::storing(&store);
    session.room(&of(0.5), &Silent).unwrap();
    let one = store.bytes();
    let found = session.room(&of(0.6), &Silent).unwrap();
    let more = store.bytes() - one;
    // A balance between the coarse patches, a quarter of their exchange areas with the fine ones.
    assert!(more < one / 3, "{one} {more}");
    assert_eq!(totals(&found), totals(&fresh(&of(0.6))));
}
