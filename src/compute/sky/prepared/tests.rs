//! Light on prepared surfaces against that of single moments.

use super::super::faces::{Viewing, surroundings};
use super::super::incident_illuminances_within;
use super::super::scenery::Finish;
use super::*;
use crate::compute::angle::Bearing;
use crate::compute::basis::AzimuthMap;
use crate::compute::direction::Dir;
use crate::compute::estimate::Silent;
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::solid::Solid;
use std::f64::consts::PI;

#[test]
fn boxes_are_lit_as_at_single_moments() {
    let solid = |from, to| Solid::new(DVec3::from_array(from), DVec3::from_array(to), 0.0);
    let setting = Setting {
        boxes: vec![
            (solid([0.0, -1.2, 2.75], [4.0, 0.0, 2.9]), Finish::Reflectance(0.5)),
            (solid([-8.0, -16.0, 0.0], [12.0, -10.0, 9.0]), Finish::Reflectance(0.4)),
            (solid([5.0, -4.0, 0.0], [6.0, -3.0, 5.0]), Finish::Luminance(900.0)),
        ],
        room: solid([0.0; 3], [4.0, 6.0, 3.0]),
        building: Some((solid([-5.0, 0.0, 0.0], [9.0, 12.0, 9.0]), 0.3)),
        ground: 0.0,
    };
    let turn = [1.0, 0.0];
    let eyes: Vec<DVec3> =
        [[0.5, 0.0, 0.9], [3.5, 0.0, 0.9], [3.5, 0.0, 2.7], [0.5, 0.0, 2.7]].map(DVec3::from_array).to_vec();
    let skyline = Skyline::new([[1.0, 0.2], [3.0, 0.3], [3.2, 0.1]], 900.0).unwrap();
    let under = |altitude: f64, bearing: f64, kind: u8, ground: f64| {
        let direction = Dir::from_altitude_bearing(altitude, Bearing::from_degrees(bearing));
        let sun = Sun { direction, direct_normal: if kind == 16 { 0.0 } else { 6e4 } };
        let sky = Outside::new(Distribution::cie(kind, direction).unwrap(), 1.2e4).unwrap();
        let sky = sky.with_ground(ground, sun.horizontal()).unwrap();
        (sky.behind(Arc::new(Surroundings::dark(Vec::new(), Some(skyline.clone())))), sun)
    };
    let (first, _) = under(0.5, 180.0, 16, 0.2);
    let prepared = Prepared::new(&first, setting.clone(), turn, eyes.clone(), 0, &Silent).unwrap();
    let eye = DVec3::new(2.0, 0.0, 1.8);
    let (frame, basis) = (Frame::facing(Dir::from_unit(DVec3::NEG_Y)), RingBasis::klems_full(AzimuthMap::FACADE));
    let rows = prepared.patches(eye, &frame, &basis);
    let (mut most, mut most_of_patches) = (0.0_f64, 0.0_f64);
    for (altitude, bearing, kind, ground) in [
        (0.3, 120.0, 12, 0.2),
        (0.7, 200.0, 12, 0.6),
        (1.0, 250.0, 8, 0.2),
        (0.5, 20.0, 12, 0.2),
        (0.5, 180.0, 16, 0.1),
    ] {
        let (outside, sun) = under(altitude, bearing, kind, ground);
        let found = prepared.under(&outside, Some(&sun));
        let viewing = Viewing { viewpoints: &eyes, target: 5e-3 };
        let exact = surroundings(&outside.open(), Some(&sun), &setting, turn, Some(skyline.clone()), &viewing, &Silent);
        let exact = outside.open().behind(Arc::new(exact.unwrap()));
        let (mut off, mut all) = (0.0, 0.0);
        for k in 0..4000 {
            let (u, v) = ((0.754_877 * f64::from(k)).fract(), (0.569_840 * f64::from(k)).fract());
            let (radius, phi) = (u.sqrt(), 2.0 * PI * v);
            let towards = DVec3::new(radius * phi.cos(), -(1.0 - u).sqrt(), radius * phi.sin());
            let [a, b] = [&found, &exact].map(|one| one.seen_from(eye).luminance(Dir::from_unit(towards)));
            off += (a - b).abs();
            all += b;
        }
        most = most.max(off / all);
        // What is seen from a point through single patches, against integrals between the edges of bodies and shadows.
        let luminances = prepared.luminances(&[(&outside, Some(&sun))]).concat();
        // The same to the bit with other moments, however many.
        for count in [2, 5, 40] {
            let found = prepared.luminances(&vec![(&outside, Some(&sun)); count]);
            assert!(found.iter().all(|found| *found == luminances));
        }
        let of = |row: &Counts| row.iter().map(|(k, counts)| f64::from(counts * luminances[*k as usize])).sum();
        let by_patch: Vec<f64> = rows.iter().map(of).collect();
        let exact = incident_illuminances_within(&exact.seen_from(eye), &basis, &frame, 1e-4);
        let [all, sum]: [f64; 2] = [exact.iter().map(|e| e.value).sum(), by_patch.iter().sum()];
        let off: f64 = exact.iter().zip(&by_patch).map(|(exact, e)| (exact.value - e).abs()).sum();
        most_of_patches = most_of_patches.max(off / all);
        assert!((sum / all - 1.0).abs() < 3e-3, "{altitude} {bearing}: {sum} {all}");
    }
    assert!(most < 6e-3 && most_of_patches < 1.6e-2, "{most:.2e} {most_of_patches:.2e}");
}
