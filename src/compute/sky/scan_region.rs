//! Integrals of the luminance of a measured sky, which is constant over each of Tregenza's patches of the dome.
//!
//! Along a line of constant azimuth of the aperture every border of a patch, altitude circle or meridian plane, is a
//! root in closed form, so that the integral over θ is exact; over φ it is smooth between the azimuths of the patches'
//! corners and of the crossings of their borders with the region's edges, all of them in closed form, too.

use super::distribution::Model;
use super::outside::Outside;
use super::patches::{ROW_HEIGHT, ROWS};
use super::region::{Region, Weight};
use crate::compute::estimate::Estimate;
use crate::compute::quadrature::{Tolerance, integrate};
use glam::DVec3;
use std::f64::consts::PI;

/// Returns the normals of the vertical planes that contain the borders between the patches of a row, each plane once.
fn meridian_planes() -> Vec<DVec3> {
    let mut bearings: Vec<f64> = ROWS[..7]
        .iter()
        .flat_map(|&count| (0..count / 2).map(move |k| (k as f64 + 0.5) * 2.0 * PI / count as f64))
        .collect();
    bearings.sort_by(f64::total_cmp);
    bearings.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    bearings.into_iter().map(|bearing| DVec3::new(bearing.cos(), -bearing.sin(), 0.0)).collect()
}

/// Returns the bearings of all borders between the patches of a row, for all rows. \[rad\]
pub(super) fn sector_bearings() -> Vec<f64> {
    let of = |&count: &usize| (0..count).map(move |k| (k as f64 + 0.5) * 2.0 * PI / count as f64);
    let mut bearings: Vec<f64> = ROWS[..7].iter().flat_map(of).collect();
    bearings.sort_by(f64::total_cmp);
    bearings.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    bearings
}

/// Returns the corners of the patches as unit vectors in the world's axes.
fn corners() -> Vec<DVec3> {
    let mut corners = Vec::new();
    for (row, &count) in ROWS[..7].iter().enumerate() {
        for k in 0..count {
            let (sin, cos) = ((k as f64 + 0.5) * 2.0 * PI / count as f64).sin_cos();
            for edge in [row, row + 1] {
                let (sin_altitude, cos_altitude) = (edge as f64 * ROW_HEIGHT).sin_cos();
                corners.push(DVec3::new(sin * cos_altitude, cos * cos_altitude, sin_altitude));
            }
        }
    }
    corners
}

/// Computes ∫ L · weight dω over the part of a region above the uniform skyline for the luminance L of a measured sky.
/// `cuts`: azimuths from φ₀ to φ₁ at which that part has knots.
pub(super) fn integrate_scan(
    outside: &Outside,
    region: &Region,
    weight: Weight,
    cuts: &[f64],
    tolerance: Tolerance,
) -> Estimate {
    let Model::Scan(scan) = &outside.distribution.model else { return Estimate::default() };
    let planes = meridian_planes();
    let levels: Vec<f64> = (1..=7).map(|row| (f64::from(row) * ROW_HEIGHT).sin()).collect();

    // Collect the azimuths at which the order of the borders changes.
    let mut inner = cuts.to_vec();
    for &level in &levels {
        region.cut_knots(level, &mut inner);
    }
    for &plane in &planes {
        for theta in [region.theta.0, region.theta.1] {
            region.crossings(plane, 0.0, theta, &mut inner);
        }
        // Crossings with the skyline, whose directions are known in closed form.
        if outside.skyline_sine > 0.0 {
            let along = DVec3::new(plane.y, -plane.x, 0.0) * outside.skyline_altitude.cos();
            for sign in [1.0, -1.0] {
                let (_, phi) = region.frame.angles(along * sign + DVec3::Z * outside.skyline_sine);
                region.push_azimuth(phi, &mut inner);
            }
        }
    }
    for corner in corners() {
        let (theta, phi) = region.frame.angles(corner);
        if theta >= region.theta.0 && theta <= region.theta.1 {
            region.push_azimuth(phi, &mut inner);
        }
    }
    let knots = region.sorted(inner);

    let mut borders: Vec<f64> = Vec::with_capacity(64);
    integrate(
        |phi| {
            let Some((low, high)) = region.above(phi, outside.skyline_sine) else { return 0.0 };
            borders.clear();
            borders.extend([low, high]);
            let (a, b) = region.along(DVec3::Z, phi);
            let (r, middle) = (a.hypot(b), a.atan2(b));
            for &level in &levels {
                if level < r {
                    let half = (level / r).acos();
                    borders.extend([middle - half, middle + half]);
                }
            }
            for &plane in &planes {
                // A sinθ + B cosθ = 0
                let (a, b) = region.along(plane, phi);
                borders.push((-b).atan2(a).rem_euclid(PI));
            }
            borders.retain(|theta| (low..=high).contains(theta));
            borders.sort_by(f64::total_cmp);
            let sum: f64 = borders
                .windows(2)
                .filter(|pair| pair[1] > pair[0])
                .map(|pair| {
                    let v = region.frame.direction(0.5 * (pair[0] + pair[1]), phi);
                    scan.value(v) * weight.between(pair[0], pair[1])
                })
                .sum();
            sum * outside.scale
        },
        &knots,
        tolerance,
    )
}
