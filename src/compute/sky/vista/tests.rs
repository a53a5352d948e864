//! Light gathered at a point against sums over directions.

use super::*;
use crate::compute::angle::Bearing;
use crate::compute::direction::Dir;
use crate::compute::sky::{Distribution, irradiance};
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::Face;
use std::sync::Arc;

/// Boxes of one reflectance above the ground, the first of them with the viewpoint.
fn scenery<'a>(open: &'a Outside, skyline: Option<&'a Skyline>, bodies: &[Solid], reflectance: f64) -> Scenery<'a> {
    let surface = |face: Face| Surface { face, reflectance, stated: None, sun: 0.0, shadows: Vec::new() };
    let faces = bodies.iter().flat_map(|solid| (0..6).map(|number| solid.face(number)));
    let surfaces = faces.map(surface).chain([Surface::ground(0.0, reflectance, [1.0, 0.0])]).collect();
    Scenery { open, skyline, bodies: bodies.to_vec(), from_ground: bodies.len(), surfaces }
}

/// Returns sums over directions in front of a plane, uniform by projected solid angle.
fn by_rays(normal: DVec3, of: impl Fn(DVec3) -> f64) -> f64 {
    let (x, y) = normal.any_orthonormal_pair();
    let n = 500;
    let mut sum = 0.0;
    for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (f64::from(a) + 0.5, f64::from(b) + 0.5))) {
        let (ring, phi) = (a / f64::from(n), 2.0 * PI * (b / f64::from(n) + 0.618 * a));
        sum += of(ring.sqrt() * (x * phi.cos() + y * phi.sin()) + (1.0 - ring).sqrt() * normal);
    }
    PI * sum / f64::from(n * n)
}

fn bodies() -> [Solid; 5] {
    let solid = |from: [f64; 3], to: [f64; 3], turn| Solid::new(DVec3::from_array(from), DVec3::from_array(to), turn);
    [
        solid([-6.0, -1.0, 0.0], [6.0, 1.0, 2.5], 0.0),
        solid([-3.0, -8.0, 0.0], [-1.0, -5.0, 6.0], 0.4),
        solid([1.0, -3.0, 3.0], [4.0, -1.0, 3.2], 0.0),
        solid([-40.0, -30.0, 0.0], [-39.0, -29.0, 2.0], 0.0),
        solid([2.0, -9.0, 0.0], [9.0, -8.0, 5.0], -0.2),
    ]
}

#[test]
fn sky_and_skyline_past_boxes_agree_with_rays() {
    let sun = Dir::from_altitude_bearing(0.6, Bearing::from_degrees(170.0));
    let skyline = Skyline::new([[1.0, 0.2], [3.0, 0.5], [3.2, 0.1]], 900.0).unwrap();
    let bodies = bodies();
    for distribution in [Distribution::uniform(), Distribution::cie(12, sun).unwrap()] {
        let open = Outside::new(distribution, 1e4).unwrap();
        // The front of the first box, its top, and the ground.
        for (surface, eye) in [(2, [0.5, -1.0, 1.5]), (5, [2.0, 0.0, 2.5]), (30, [1.0, -4.0, 0.0])] {
            let eye = DVec3::from_array(eye);
            for skyline in [None, Some(&skyline)] {
                let scenery = scenery(&open, skyline, &bodies, 0.0);
                let found = Vista::new(&scenery, surface, eye).gather(|_, _, _| {});
                let normal = scenery.surfaces[surface].face.normal;
                let rays = by_rays(normal, |d| {
                    let mut others = scenery.others(surface);
                    if d.z < 0.0 || others.any(|(_, solid)| solid.enter(eye, d).is_some()) {
                        return 0.0;
                    }
                    let seen = skyline.filter(|skyline| skyline.covers(d)).map(|skyline| skyline.luminance);
                    seen.unwrap_or_else(|| open.luminance(Dir::from_unit(d.normalize())))
                });
                assert!((found - rays).abs() < 4e-3 * rays, "{surface} {eye}: {found} {rays}");
            }
        }
    }
}

#[test]
fn places_are_those_that_rays_meet() {
    let open = Outside::new(Distribution::uniform(), 0.0).unwrap();
    let bodies = bodies();
    let scenery = scenery(&open, None, &bodies, 0.5);
    let eye = DVec3::new(0.5, -1.0, 1.5);
    // A light of each surface that rises over its coordinates.
    let light = |surface: usize, [u, v]: [f64; 2]| 1.0 + surface as f64 + 1.0 / (1.0 + 0.1 * u.hypot(v));
    let mut found = 0.0;
    Vista::new(&scenery, 2, eye).gather(|surface, at, counts| found += counts * light(surface, at));
    let rays = by_rays(DVec3::NEG_Y, |d| {
        let met = scenery.others(2).filter_map(|(index, solid)| solid.enter(eye, d).map(|hit| (hit.0, hit.1, index)));
        let nearest = met.min_by(|a, b| a.0.total_cmp(&b.0));
        let to_ground = if d.z < 0.0 { -eye.z / d.z } else { f64::INFINITY };
        let (distance, surface) = match nearest.filter(|hit| hit.0 < to_ground) {
            Some((distance, face, index)) => (distance, 6 * index + face),
            None => (to_ground, scenery.ground()),
        };
        if distance.is_infinite() {
            return 0.0;
        }
        light(surface, scenery.surfaces[surface].face.coordinates(eye + distance * d))
    });
    assert!((found / rays - 1.0).abs() < 4e-3, "{found} {rays}");
}

#[test]
fn what_lies_in_the_sun_counts_as_far_as_shadows_leave_it() {
    let open = Outside::new(Distribution::uniform(), 0.0).unwrap();
    let mut scenery = scenery(&open, None, &bodies()[..1], 0.5);
    let ground = scenery.ground();
    scenery.surfaces[ground].sun = 700.0;
    scenery.surfaces[ground].shadows = vec![
        [[-2.0, -4.0], [1.0, -4.0], [1.0, -2.0], [-2.0, -2.0]].map(DVec2::from_array).to_vec(),
        [[0.0, -6.0], [3.0, -5.0], [2.0, -1.0]].map(DVec2::from_array).to_vec(),
    ];
    let eye = DVec3::new(0.5, -1.0, 1.5);
    let found = Vista::new(&scenery, 2, eye).gather(|_, _, _| {});
    let shadows = &scenery.surfaces[ground].shadows;
    let inside = |p: DVec2, shadow: &[DVec2]| {
        (0..shadow.len()).all(|k| (shadow[(k + 1) % shadow.len()] - shadow[k]).perp_dot(p - shadow[k]) > 0.0)
    };
    let rays = by_rays(DVec3::NEG_Y, |d| {
        let at = (eye - eye.z / d.z * d).truncate();
        let dark = d.z >= 0.0 || shadows.iter().any(|shadow| inside(at, shadow));
        if dark { 0.0 } else { 700.0 }
    });
    assert!((found / rays - 1.0).abs() < 5e-3, "{found} {rays}");
}

#[test]
fn ground_below_a_skyline_gets_what_cubature_finds() {
    let skylines = [
        Skyline::new([[0.0, 0.3]], 400.0).unwrap(),
        Skyline::new([[1.0, 0.2], [3.0, 0.7], [3.2, 0.1], [5.0, 0.4]], 900.0).unwrap(),
    ];
    // The sun above the skyline, near it, and behind it.
    for altitude in [0.9, 0.35, 0.15] {
        let sun = Dir::from_altitude_bearing(altitude, Bearing::from_degrees(170.0));
        for sky_type in [5, 12, 14] {
            let open = Outside::new(Distribution::cie(sky_type, sun).unwrap(), 1e4).unwrap();
            for skyline in &skylines {
                let around = Surroundings::dark(Vec::new(), Some(skyline.clone()));
                let outside = open.clone().with_ground(1.0, 0.0).unwrap().behind(Arc::new(around));
                let exact = irradiance(&outside, Dir::from_unit(DVec3::Z)).value;
                let found = PI * with_ground_behind_skyline(outside, None).ground_luminance();
                assert!((found / exact - 1.0).abs() < 2e-4, "{altitude} {sky_type}: {found} {exact}");
            }
        }
    }
}
