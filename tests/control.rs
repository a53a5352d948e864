//! Controls over whole years: no direct sun passes a cut-off, and no state more open would do.
//!
//! Judged by rays of this file's own: from points of the sun's disc, before the section of the slats, piece by piece.

use cfs::compute::control::cut_off::Section;
use cfs::compute::direction::Surface;
use cfs::compute::estimate::Silent;
use cfs::compute::sky::SUN_HALF_ANGLE;
use cfs::compute::system::slat_profile::SlatProfile;
use cfs::study::control::keys::{ControlKeys, ControlMode};
use cfs::study::control::year::{ClearSky, Moment, Moving, Situation, year};
use cfs::study::control::Device;
use cfs::study::sun_position::Place;
use std::path::Path;

/// Slats of one tilt, and rays across them.
struct Blind {
    /// Corner points of one slat, (outward, upward).
    slat: Vec<[f64; 2]>,
    spacing: f64,
}

impl Blind {
    fn new(section: &Section, tilt: f64) -> Self {
        let (sin, cos) = tilt.sin_cos();
        // A tilt above 0 lowers the outer edge.
        let turned = |[u, v]: [f64; 2]| [u * cos + v * sin, v * cos - u * sin];
        Self { slat: section.profile.polyline(120).into_iter().map(turned).collect(), spacing: section.spacing }
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
        let coarse = (0..24).map(|k| self.spacing * (f64::from(k) + 0.37) / 24.0);
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
    let mut list = Vec::new();
    for ring in [0.0, 0.25, 0.5, 0.75, 1.0] {
        for k in 0..points {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(points)).sin_cos();
            let r = ring * SUN_HALF_ANGLE;
            let p: [f64; 3] =
                std::array::from_fn(|i| v[i] * r.cos() + (right[i] * cos + up[i] * sin) * r.sin());
            // Before the façade and above the horizon.
            if p[2] > 1e-9 && p[1] >= 0.0 {
                list.push(p[1] / p[2]);
            }
            if ring == 0.0 {
                break;
            }
        }
    }
    list
}

fn device(angles: impl IntoIterator<Item = i32>) -> Device {
    let angles: Vec<i32> = angles.into_iter().collect();
    Device {
        name: "blind".into(),
        keys: angles.iter().map(i32::to_string).collect(),
        values: Some(angles.iter().map(|angle| f64::from(*angle)).collect()),
        curve: Vec::new(),
        section: None,
    }
}

fn situation(latitude: f64, facade: f64) -> Situation {
    Situation {
        place: Place::new(latitude, 9.2, 1.0).unwrap(),
        year: 2026,
        facade: cfs::compute::angle::Bearing::from_degrees(facade),
        ground_reflectance: 0.2,
        skyline: 0.0,
    }
}

fn moving(section: &Section, device: &Device, keys: ControlKeys) -> Vec<Moving> {
    let device = Device { section: Some(section.clone()), ..device.clone() };
    vec![Moving { aperture: 1, surface: Surface::Facade, device, keys, section: Some(section.clone()) }]
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

fn judge(section: &Section, device: &Device, moments: &[Moment], facade: f64, count: &mut Count) {
    let values: Vec<f64> = device.values.as_ref().unwrap().iter().map(|value| value.to_radians()).collect();
    let blinds: Vec<Blind> = values.iter().map(|tilt| Blind::new(section, *tilt)).collect();
    for moment in moments {
        let setting = &moment.settings[0];
        let slopes = slopes(moment, facade, 24);
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
        // The next more open state, and every other of less tilt, lets some of the disc through. Points of its edge in
        // plenty, for the least of it may be what shows.
        let fine: Vec<f64> = self::slopes(moment, facade, 1440);
        let opener = (0..values.len()).filter(|&k| values[k].abs() < values[setting.state].abs() - 1e-9);
        for state in opener {
            let section_says = fine.iter().map(|slope| section.direct_share(values[state], slope.atan()));
            let rays_say = || fine.iter().any(|slope| blinds[state].open(*slope, GAP * (1.0 + slope)));
            // Less than a ten-thousandth of the sun's beam, at less than a thousandth of its disc, is below what these
            // points can tell.
            if !(leaks(state) || rays_say() || section_says.fold(0.0, f64::max) > 0.0) {
                count.could_be_more_open += 1;
            }
        }
    }
}

const LATITUDES: [f64; 5] = [0.0, 25.0, 48.8, 60.0, 70.0];
const FACADES: [f64; 5] = [180.0, 135.0, 90.0, 250.0, 0.0];

fn hourly(section: &Section, device: &Device, keys: &ControlKeys) -> Count {
    let mut count = Count::default();
    for latitude in LATITUDES {
        for facade in FACADES {
            let list = moving(section, device, keys.clone());
            let moments =
                year(&situation(latitude, facade), Path::new("."), &list, 60, &ClearSky, &Silent).unwrap();
            assert_eq!(moments.len(), 8760);
            judge(section, device, &moments, facade, &mut count);
        }
    }
    count
}

#[test]
fn flat_slats_keep_the_sun_out_at_every_hour_at_five_latitudes_and_no_more_open_state_does() {
    let section = Section::new(SlatProfile::Flat { width: 0.080 }, 0.072).unwrap();
    let count = hourly(&section, &device((0..=15).map(|k| 5 * k)), &ControlKeys::of(ControlMode::CutOff));
    println!("{count:?}");
    assert!(count.sunny > 40_000 && count.leaks == 0 && count.could_be_more_open == 0 && count.no_state_does == 0);
}

#[test]
fn curved_slats_that_turn_both_ways_do_as_well() {
    let section = Section::new(SlatProfile::Arc { width: 0.080, rise: 0.008 }, 0.072).unwrap();
    let count = hourly(&section, &device((-16..=16).map(|k| 5 * k)), &ControlKeys::of(ControlMode::CutOff));
    println!("{count:?}");
    assert!(count.sunny > 40_000 && count.leaks == 0 && count.could_be_more_open == 0 && count.no_state_does == 0);
}
