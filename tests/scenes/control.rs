//! Controls over whole years: no direct sun passes a cut-off, and no state more open would do.
//!
//! Judged by rays of this file's own: from points of the sun's disc, before the section of the slats, piece by piece.

use cfs::compute::angle::Bearing;
use cfs::compute::control::cut_off::SlatRow;
use cfs::compute::direction::{Dir, Orientation, Surface};
use cfs::compute::estimate::Silent;
use cfs::compute::lid::Facing;
use cfs::compute::room::aperture::Aperture;
use cfs::compute::sky::{Distribution, Outside, SUN_HALF_ANGLE, Sun};
use cfs::compute::surroundings::Surroundings;
use cfs::compute::surroundings::solid::Solid;
use cfs::compute::system::slats::SlatProfile;
use cfs::study::control::keys::{ControlKeys, ControlMode};
use cfs::study::control::year::{ClearSky, Moment, Moving, Situation, Weather, day, year};
use cfs::study::control::{ControlQuestion, Device, inputs, pick_state, sun_at};
use cfs::study::scene_file::SceneFile;
use cfs::study::sky::illuminances;
use cfs::study::sun_position::Place;
use glam::DVec3;
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;

/// Slats of one tilt, and rays across them.
struct Blind {
    /// Corner points of one slat, (outward, upward).
    slat: Vec<[f64; 2]>,
    spacing: f64,
}

impl Blind {
    fn new(section: &SlatRow, tilt: f64) -> Self {
        let (sin, cos) = tilt.sin_cos();
        // A tilt above 0 lowers the outer edge.
        let turned = |[u, v]: [f64; 2]| [u * cos + v * sin, v * cos - u * sin];
        Self { slat: section.profile.polyline(80).into_iter().map(turned).collect(), spacing: section.spacing }
    }

    /// Does the ray through height `at` of the plane of the slats' middles meet none of them? It rises outwards by
    /// `slope`.
    fn passes(&self, slope: f64, at: f64) -> bool {
        let over: Vec<f64> = self.slat.iter().map(|[u, v]| at + slope * u - v).collect();
        let (low, high) = over.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), h| (a.min(*h), b.max(*h)));
        // The slats whose corners lie on both sides of the ray, one by one, piece by piece.
        let first = (low / self.spacing).floor() as i64;
        let last = (high / self.spacing).ceil() as i64;
        !(first..=last).any(|slat| {
            let lift = slat as f64 * self.spacing;
            over.windows(2).any(|ends| (ends[0] - lift) * (ends[1] - lift) <= 0.0)
        })
    }

    /// Does any ray of a direction pass by more than `width` \[m\]? Gaps begin where a shadow ends.
    fn open(&self, slope: f64, width: f64) -> bool {
        let shadows = self.slat.iter().map(|[u, v]| v - slope * u);
        let top = shadows.fold(f64::NEG_INFINITY, f64::max);
        let coarse = (0..5).map(|k| self.spacing * (f64::from(k) + 0.37) / 5.0);
        self.passes(slope, top + width) || coarse.into_iter().any(|at| self.passes(slope, at))
    }
}

/// Directions of the sun's visible disc in the façade's frame: tangents of their profile angles.
fn slopes(moment: &Moment, facade: f64, points: u32) -> Vec<f64> {
    let (height, turn) = (moment.altitude, moment.bearing.degrees().to_radians() - facade.to_radians());
    // x right seen from outside, y up, z outward.
    let v = [-turn.sin() * height.cos(), height.sin(), turn.cos() * height.cos()];
    let right = [-turn.cos(), 0.0, -turn.sin()];
    let up = [turn.sin() * height.sin(), height.cos(), -turn.cos() * height.sin()];
    let at = |ring: f64, turn: f64| -> [f64; 3] {
        let ((sin, cos), r) = (turn.sin_cos(), ring * SUN_HALF_ANGLE);
        std::array::from_fn(|i| v[i] * r.cos() + (right[i] * cos + up[i] * sin) * r.sin())
    };
    let step = std::f64::consts::TAU / f64::from(points);
    let edge = (0..points).map(|k| at(1.0, step * f64::from(k)));
    let inside = (0..points).step_by(4).flat_map(|k| [0.0, 0.6].map(|ring| at(ring, step * f64::from(k))));
    let mut list: Vec<[f64; 3]> = edge.chain(inside).collect();
    // Where the horizon cuts the disc's edge: from outside the cut to just above it.
    for k in 0..points {
        let (mut below, mut above) = (step * f64::from(k), step * f64::from(k + 1));
        if at(1.0, below)[1] * at(1.0, above)[1] < 0.0 {
            if at(1.0, below)[1] > 0.0 {
                std::mem::swap(&mut below, &mut above);
            }
            for _ in 0..60 {
                let middle = 0.5 * (below + above);
                if at(1.0, middle)[1] < 0.0 { below = middle } else { above = middle }
            }
            list.push(at(1.0, above));
        }
    }
    // Before the façade and above the horizon.
    list.into_iter().filter(|p| p[2] > 1e-9 && p[1] >= 0.0).map(|p| p[1] / p[2]).collect()
}

fn device(angles: impl IntoIterator<Item = i32>) -> Device {
    let angles: Vec<i32> = angles.into_iter().collect();
    Device {
        name: "blind".into(),
        keys: angles.iter().map(i32::to_string).collect(),
        values: Some(angles.iter().map(|angle| f64::from(*angle)).collect()),
        curve: Vec::new(),
        section: None,
        upright: false,
    }
}

/// A usual one at sea level.
const SKY: ClearSky = ClearSky::Air { turbidity: 3.0, elevation: 0.0 };

fn opening() -> Aperture {
    Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [3.0, 1.8] }
}

/// A façade that faces south.
fn southward<'a>(outside: &'a Outside, sun: &'a Sun) -> Facing<'a> {
    let orientation = Orientation::new(Bearing::from_degrees(180.0));
    Facing { outside, sun: Some(sun), orientation, surface: Surface::Facade }
}

/// The state that a rule picks for the opening, without a clock.
fn picked(device: &Device, keys: &ControlKeys, facing: Facing<'_>) -> String {
    let base = Path::new("");
    let asked = ControlQuestion { keys, base, hour: None, of_year: None, facing, aperture: opening() };
    pick_state(device, &asked).unwrap()
}

fn situation(latitude: f64, facade: f64) -> Situation {
    Situation {
        place: Place::new(latitude, 9.2, 1.0).unwrap(),
        utc_offset: 1.0,
        dst: cfs::study::scene_file::DstKey::None,
        year: 2026,
        facade: cfs::compute::angle::Bearing::from_degrees(facade),
        ground_reflectance: 0.2,
        skyline: 0.0,
        skyline_by_bearing: None,
        boxes: Vec::new(),
        sky: SKY,
    }
}

fn moving(section: &SlatRow, device: &Device, keys: ControlKeys) -> Vec<Moving> {
    let device = Device { section: Some(section.clone()), ..device.clone() };
    vec![Moving { aperture: 1, opening: opening(), device, keys, section: Some(section.clone()) }]
}

/// What a year of cut-off came to.
#[derive(Debug, Default)]
struct Count {
    sunny: usize,
    leaks: usize,
    could_be_more_open: usize,
    no_state_does: usize,
}

/// Rays pass where there is more than this to pass through. \[m\]
const GAP: f64 = 1e-8;

fn judge(section: &SlatRow, device: &Device, moments: &[Moment], facade: f64, count: &mut Count) {
    let values: Vec<f64> = device.values.as_ref().unwrap().iter().map(|value| value.to_radians()).collect();
    let blinds: Vec<Blind> = values.iter().map(|tilt| Blind::new(section, *tilt)).collect();
    for moment in moments {
        let setting = &moment.settings[0];
        let slopes = slopes(moment, facade, 32);
        if slopes.is_empty() {
            continue;
        }
        count.sunny += 1;
        // Beams along the façade are so steep in the section that rounding eats the gap.
        let beams: Vec<f64> = slopes.into_iter().filter(|slope| *slope < 1e5).collect();
        let leaks = |state: usize| beams.iter().any(|slope| blinds[state].open(*slope, GAP * (1.0 + slope)));
        if leaks(setting.state) {
            // Only where the program says so itself, and no state keeps the sun out.
            if setting.passes == Some(true) && (0..values.len()).all(leaks) {
                count.no_state_does += 1;
            } else {
                count.leaks += 1;
            }
            continue;
        }
        // Every state of less tilt lets some of the disc through; where that is little, it takes many points to see it.
        let fine =
            |state: usize| self::slopes(moment, facade, 1440).iter().any(|s| blinds[state].open(*s, GAP * (1.0 + s)));
        let opener = (0..values.len()).filter(|&k| values[k].abs() < values[setting.state].abs() - 1e-9);
        count.could_be_more_open += opener.filter(|&state| !(leaks(state) || fine(state))).count();
    }
}

const LATITUDES: [f64; 5] = [0.0, 25.0, 48.8, 60.0, 70.0];
const FACADES: [f64; 5] = [180.0, 135.0, 90.0, 250.0, 0.0];

/// All latitudes and façades, each a year of hours.
fn hourly(section: &SlatRow, device: &Device, facades: &[f64]) -> Count {
    let keys = ControlKeys::of(ControlMode::CutOff);
    let places: Vec<(f64, f64)> = LATITUDES.into_iter().flat_map(|l| facades.iter().map(move |f| (l, *f))).collect();
    let counts: Vec<Count> = places
        .into_par_iter()
        .map(|(latitude, facade)| {
            let list = moving(section, device, keys.clone());
            let moments = year(&situation(latitude, facade), Path::new("."), &list, 60, &SKY, &Silent).unwrap();
            assert_eq!(moments.len(), 8760);
            let mut count = Count::default();
            judge(section, device, &moments, facade, &mut count);
            count
        })
        .collect();
    counts.into_iter().fold(Count::default(), |a, b| Count {
        sunny: a.sunny + b.sunny,
        leaks: a.leaks + b.leaks,
        could_be_more_open: a.could_be_more_open + b.could_be_more_open,
        no_state_does: a.no_state_does + b.no_state_does,
    })
}

#[test]
fn flat_slats_keep_the_sun_out_at_every_hour_at_five_latitudes_and_no_more_open_state_does() {
    let section = SlatRow::new(SlatProfile::Flat { width: 0.080 }, 0.072).unwrap();
    let count = hourly(&section, &device((0..=15).map(|k| 5 * k)), &FACADES);
    println!("{count:?}");
    assert!(count.sunny > 50_000);
    assert_eq!((count.leaks, count.could_be_more_open, count.no_state_does), (0, 0, 0));
}

#[test]
fn curved_slats_that_turn_both_ways_do_as_well() {
    let section = SlatRow::new(SlatProfile::Arc { width: 0.080, rise: 0.008 }, 0.072).unwrap();
    let count = hourly(&section, &device((-16..=16).map(|k| 5 * k)), &[180.0, 290.0]);
    println!("{count:?}");
    assert!(count.sunny > 20_000);
    assert_eq!((count.leaks, count.could_be_more_open, count.no_state_does), (0, 0, 0));
}

#[test]
fn every_five_minutes_of_the_year_s_corner_days_no_sun_passes_even_with_hysteresis_and_dwell_time() {
    let section = SlatRow::new(SlatProfile::Arc { width: 0.080, rise: -0.006 }, 0.070).unwrap();
    let device = device((0..=16).map(|k| 5 * k));
    let keys = ControlKeys { hysteresis: Some(3.0), dwell: Some(20.0), ..ControlKeys::of(ControlMode::CutOff) };
    let mut moves = [0, 0];
    for latitude in LATITUDES {
        for facade in [180.0, 100.0] {
            let here = situation(latitude, facade);
            for (month, date) in [(3, 21), (6, 21), (9, 1), (12, 21)] {
                let date = jiff::civil::date(2026, month, date);
                let run = |keys: &ControlKeys| {
                    let list = moving(&section, &device, keys.clone());
                    day(&here, Path::new("."), &list, date, 5, &SKY).unwrap()
                };
                let calm = run(&keys);
                let mut count = Count::default();
                for moment in &calm {
                    let blind = Blind::new(&section, f64::from(5 * moment.settings[0].state as i32).to_radians());
                    let seen = slopes(moment, facade, 64);
                    count.sunny += usize::from(!seen.is_empty());
                    let leaks = seen.iter().any(|slope| *slope < 1e5 && blind.open(*slope, GAP * (1.0 + slope)));
                    count.leaks += usize::from(leaks);
                }
                assert_eq!(count.leaks, 0, "{latitude}° {facade}° {date}");
                for (sum, day) in moves.iter_mut().zip([calm, run(&ControlKeys::of(ControlMode::CutOff))]) {
                    *sum += day.iter().filter(|moment| moment.settings[0].moved).count();
                }
            }
        }
    }
    // What they are for: fewer movements.
    println!("movements with and without: {moves:?}");
    assert!(moves[0] > 0 && moves[0] < moves[1], "{moves:?}");
}

/// The judge itself: rules that do let the sun in are caught.
#[test]
fn rays_catch_a_cut_off_for_a_sun_without_extent_and_a_lazy_one() {
    let section = SlatRow::new(SlatProfile::Flat { width: 0.080 }, 0.072).unwrap();
    let device = device(0..=80);
    let exact: Vec<[f64; 2]> = (0..=90)
        .map(|k| {
            let psi = f64::from(k).to_radians();
            [f64::from(k), ((0.9 * psi.cos()).asin() - psi).to_degrees().max(0.0)]
        })
        .collect();
    let judged = |shift: f64| {
        let curve = exact.iter().map(|[psi, tilt]| [*psi, (tilt + shift).max(0.0)]).collect();
        let keys = ControlKeys { curve, ..ControlKeys::of(ControlMode::Curve) };
        let here = situation(48.8, 135.0);
        let moments = year(&here, Path::new("."), &moving(&section, &device, keys), 60, &SKY, &Silent).unwrap();
        let mut count = Count::default();
        judge(&section, &device, &moments, 135.0, &mut count);
        // The program's own word for it agrees with the rays.
        let says = moments.iter().filter(|moment| moment.settings[0].passes == Some(true)).count();
        (count, says)
    };
    let (open, says) = judged(-1.0);
    assert!(open.leaks > 500 && open.leaks.abs_diff(says) <= 2, "{open:?} {says}");
    let (closed, says) = judged(4.0);
    assert!(closed.leaks == 0 && says == 0 && closed.could_be_more_open > 500, "{closed:?}");
}

#[test]
fn slats_too_narrow_for_it_say_that_the_sun_passes() {
    let section = SlatRow::new(SlatProfile::Flat { width: 0.050 }, 0.060).unwrap();
    let device = device((0..=16).map(|k| 5 * k));
    let keys = ControlKeys::of(ControlMode::CutOff);
    let here = situation(48.8, 180.0);
    let moments = year(&here, Path::new("."), &moving(&section, &device, keys), 60, &SKY, &Silent).unwrap();
    let mut count = Count::default();
    judge(&section, &device, &moments, 180.0, &mut count);
    assert!(count.leaks == 0 && count.no_state_does > 100, "{count:?}");
    assert_eq!(count.could_be_more_open, 0);
}

#[test]
fn a_year_s_clear_sky_is_as_bright_as_the_scene_s() {
    for (word, key) in [("clear-sky", "turbidity = 5.0"), ("clear-sky", "turbidity = 2.0"), ("rp-21", "")] {
        let stated = "diffuse_horizontal = 15000.0\nsun = { direct_normal = 70000.0 }";
        let scene = include_str!("../../examples/blind.toml");
        assert!(scene.contains(stated));
        let sky = format!("illuminance = \"{word}\"\n{key}");
        let file = SceneFile::parse(&scene.replace(stated, &sky)).unwrap();
        let seen = illuminances(&file.sky, &file.site).unwrap().unwrap();
        let time = jiff::civil::date(2026, 3, 21).at(12, 0, 0, 0);
        let year = Situation::of(&file).unwrap().sky.illuminances(time, seen.altitude.unwrap()).unwrap();
        assert_eq!(year, (seen.direct_normal, seen.diffuse_horizontal), "{word} {key}");
    }
}

#[test]
fn upright_slats_follow_the_angle_in_the_horizontal_plane() {
    let (width, spacing) = (0.127_f64, 0.11_f64);
    let section = SlatRow::new(SlatProfile::Flat { width }, spacing).unwrap();
    let device = Device { section: Some(section), upright: true, ..device((-75..=75).step_by(5)) };
    let outside = Outside::new(Distribution::uniform(), 0.0).unwrap();
    let keys = ControlKeys::of(ControlMode::CutOff);
    for altitude in [5.0_f64, 40.0, 65.0] {
        for aside in (-70..=70).step_by(5).map(|degrees| f64::from(degrees).to_radians()) {
            let bearing = Bearing::from_radians(std::f64::consts::PI + aside);
            let direction = Dir::from_altitude_bearing(altitude.to_radians(), bearing);
            let sun = Sun { direction, direct_normal: 5e4 };
            let facing = southward(&outside, &sun);
            // However high it stands.
            let at = sun_at(&facing, true).unwrap();
            assert!((at.centre.abs() - aside.abs()).abs() < 1e-9, "{altitude} {aside}: {at:?}");
            let state: f64 = picked(&device, &keys, facing).parse().unwrap();
            let dark =
                |tilt: f64| at.span.iter().all(|psi| width * (tilt + psi).sin().abs() >= spacing * psi.cos() - 1e-9);
            assert!(dark(state.to_radians()), "{altitude} {aside}: {state}");
            // None that is more open would do.
            let open = (0..state.abs() as i32).step_by(5).flat_map(|angle| [-angle, angle]);
            for other in open {
                assert!(!dark(f64::from(other).to_radians()), "{altitude} {aside}: {state} {other}");
            }
        }
    }
}

#[test]
fn sun_that_boxes_keep_out_moves_nothing() {
    // 1.2 m deep, its underside flush with the opening's head: the shadow reaches 1.2 tan(profile angle) down.
    let overhang = Solid::new(DVec3::new(-90.0, -1.2, 2.7), DVec3::new(90.0, 0.0, 2.8), 0.0);
    let outside = Outside::new(Distribution::uniform(), 0.0).unwrap();
    let outside = outside.behind(Arc::new(Surroundings::dark(vec![overhang], None)));
    let device = device((0..=75).step_by(5));
    let keys = ControlKeys::of(ControlMode::Din5034);
    for (tangent, share) in [(0.5, 1.0 - 0.6 / 1.8), (1.0, 1.0 - 1.2 / 1.8), (1.6, 0.0)] {
        let direction = Dir::from_unit(DVec3::new(0.4, -1.0, tangent).normalize());
        let sun = Sun { direction, direct_normal: 5e4 };
        let facing = southward(&outside, &sun);
        let seen = inputs(&facing, &opening(), 12.0, None, false, false);
        assert!((seen.facade_direct - share * facing.sun_illuminance()).abs() < 1e-6, "{tangent}: {seen:?}");
        assert_eq!(picked(&device, &keys, facing) == "0", share == 0.0, "{tangent}");
    }
    // Through a year: behind a wall from the ground to the sky there is never any sun, behind the overhang less of it.
    let section = SlatRow::new(SlatProfile::Flat { width: 0.08 }, 0.072).unwrap();
    let hours = |boxes: Vec<Solid>| {
        let situation = Situation { boxes, ..situation(48.7, 180.0) };
        let moving = moving(&section, &device, keys.clone());
        let moments = year(&situation, Path::new(""), &moving, 60, &SKY, &Silent).unwrap();
        moments.iter().filter(|moment| moment.settings[0].profile_angle.is_some()).count()
    };
    let wall = Solid::new(DVec3::new(-9e5, -2.0, 0.0), DVec3::new(9e5, -1.0, 900.0), 0.0);
    let [free, under, behind] = [Vec::new(), vec![overhang], vec![wall]].map(hours);
    assert!(behind == 0 && under > 0 && under < free, "{free} {under} {behind}");
}
