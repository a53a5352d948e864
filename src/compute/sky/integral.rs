//! Integrals of the luminance of sky, skyline and ground over regions of the sphere.
//!
//! Ground and skyline are closed forms in θ, and the sky is smooth between known knots of φ. The circumsolar tip, where
//! the luminance has a kink, becomes the corner of triangles that map it away (Duffy's transformation).

use super::on_dome;
use super::outside::Outside;
use super::patches::Patch;
use super::prospect::{Parts, Prospect};
use super::region::{Frame, Region, Weight};
use super::scan_region;
use crate::compute::direction::{Dir, World};
use crate::compute::estimate::Estimate;
use crate::compute::quadrature::{Rectangle, Tolerance, integrate, integrate_rectangles};
use std::f64::consts::{FRAC_PI_2, PI};

/// Computes ∫ L · weight dω over a region for the luminance L of sky, skyline and ground, without obstructions.
pub(super) fn integrate_region(outside: &Outside, region: &Region, weight: Weight, tolerance: Tolerance) -> Estimate {
    let knots = knots(outside, region);
    let sky = if outside.is_piecewise_constant() {
        scan_region::integrate_scan(outside, region, weight, &knots, tolerance)
    } else {
        let of_ring = |ring: Region| {
            let knots = self::knots(outside, &ring);
            knots.windows(2).map(|pair| sky_strip(outside, &ring, (pair[0], pair[1]), weight, tolerance)).sum()
        };
        rings(outside, region).map(of_ring).sum()
    };
    sky + constant_parts(outside, region, weight, &knots, tolerance)
}

/// Returns the azimuths between which horizon and skyline begin, end or leave the region nowhere: a rising list from one
/// side of the region to the other. \[rad\]
fn knots(outside: &Outside, region: &Region) -> Vec<f64> {
    let mut inner = Vec::new();
    region.cut_knots(0.0, &mut inner);
    if outside.skyline_sine > 0.0 {
        region.cut_knots(outside.skyline_sine, &mut inner);
    }
    region.sorted(inner)
}

/// Computes the integral of ground and skyline, of constant luminance each: closed form in θ, 1-D in φ.
fn constant_parts(outside: &Outside, region: &Region, weight: Weight, knots: &[f64], tolerance: Tolerance) -> Estimate {
    let (ground, skyline) = (outside.ground_luminance, outside.skyline_luminance);
    let has_skyline = outside.skyline_sine > 0.0 && skyline > 0.0;
    if ground == 0.0 && !has_skyline {
        return Estimate::default();
    }
    let all = weight.between(region.theta.0, region.theta.1);
    let share = |phi: f64, level: f64| region.above(phi, level).map_or(0.0, |(low, high)| weight.between(low, high));
    integrate(
        |phi| {
            let upper = share(phi, 0.0);
            let between = if has_skyline { upper - share(phi, outside.skyline_sine) } else { 0.0 };
            ground * (all - upper) + skyline * between
        },
        knots,
        tolerance,
    )
}

/// Angular distance of the sun from the pole of the frame below which the circumsolar region is narrow in θ and yet
/// wide in φ. \[rad\] Chosen; held by `tests/compute/sky.rs::a_sun_near_the_zenith_is_not_missed`, with suns up to 4°
/// (0.07 rad) from the pole.
const NEAR_POLE: f64 = 0.1;

/// Divides a region around a pole near the sun: there the luminance changes within a small part of the region, which one
/// quadrature rule could miss. The rings grow with the distance from the pole.
fn rings(outside: &Outside, region: &Region) -> impl Iterator<Item = Region> {
    let sun = outside.sun_direction().map_or(PI, |sun| region.frame.angles(sun.vector()).0);
    let mut cuts = vec![region.theta.0];
    if (1e-9..NEAR_POLE).contains(&sun) {
        let grown = std::iter::successors(Some(3.0 * sun), |cut| Some(3.0 * cut));
        cuts.extend(grown.take_while(|cut| *cut < region.theta.1).filter(|cut| *cut > region.theta.0));
    }
    cuts.push(region.theta.1);
    let region = *region;
    (1..cuts.len()).map(move |k| Region { theta: (cuts[k - 1], cuts[k]), ..region })
}

/// Computes the integral of the sky's luminance over a strip of a region: its azimuths between two knots.
fn sky_strip(
    outside: &Outside,
    region: &Region,
    (phi_min, phi_max): (f64, f64),
    weight: Weight,
    tolerance: Tolerance,
) -> Estimate {
    let limits = |phi: f64| region.above(phi, outside.skyline_sine);
    if outside.scale == 0.0 || limits(0.5 * (phi_min + phi_max)).is_none() {
        return Estimate::default();
    }
    let width = phi_max - phi_min;
    // The strip as the unit square: x along φ, y along θ between the limits.
    let at = |x: f64, y: f64| {
        let phi = phi_min + width * x;
        let Some((low, high)) = limits(phi) else { return 0.0 };
        let theta = low + (high - low) * y;
        let v = region.frame.direction(theta, phi);
        outside.sky_luminance(v) * weight.density(theta) * (high - low) * width
    };
    let Some((tip_x, tip_y)) = tip(outside, region, phi_min, width, &limits) else {
        return integrate_rectangles(at, &[Rectangle::UNIT], tolerance);
    };
    // Four triangles from the tip to the sides of the square: p = tip + r·(side(t) − tip), |Jacobian| = r·|cross|.
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    (0..4)
        .map(|side| {
            let (a, b) = (corners[side], corners[(side + 1) % 4]);
            let cross = ((a.0 - tip_x) * (b.1 - tip_y) - (a.1 - tip_y) * (b.0 - tip_x)).abs();
            if cross < 1e-13 {
                return Estimate::default();
            }
            let triangle = |r: f64, t: f64| {
                let x = tip_x + r * (a.0 + (b.0 - a.0) * t - tip_x);
                let y = tip_y + r * (a.1 + (b.1 - a.1) * t - tip_y);
                at(x, y) * r * cross
            };
            integrate_rectangles(triangle, &[Rectangle::UNIT], tolerance)
        })
        .sum()
}

/// Returns the position of the circumsolar peak in a strip's unit square; `None` if it does not lie in the strip.
fn tip(
    outside: &Outside,
    region: &Region,
    phi_min: f64,
    width: f64,
    limits: &impl Fn(f64) -> Option<(f64, f64)>,
) -> Option<(f64, f64)> {
    let (theta, phi) = region.frame.angles(outside.sun_direction()?.vector());
    // If the tip is the pole, it is a whole side of the square, and the integrand is smooth in θ without the
    // transformation.
    if theta < 1e-9 {
        return None;
    }
    /// Angle by which the peak may lie outside a strip and still counts as on its border: rounding of angles is 1e-15.
    /// \[rad\]
    const SLACK: f64 = 1e-9;
    let x = (phi - phi_min + SLACK).rem_euclid(2.0 * PI) - SLACK;
    if x > width + SLACK {
        return None;
    }
    let x = (x / width).clamp(0.0, 1.0);
    let (low, high) = limits(phi_min + width * x)?;
    (theta > low - SLACK && theta < high + SLACK).then(|| (x, ((theta - low) / (high - low)).clamp(0.0, 1.0)))
}

/// Relative error of the change of an integral by the surroundings. Held by the test
/// `black_boxes_hide_the_projected_solid_angles_of_their_faces`, to twice as much.
const CHANGED: f64 = 1e-5;

/// Computes the difference that surroundings make to the integral of the luminance over a region.
fn changed(outside: &Outside, region: &Region, weight: Weight) -> Estimate {
    let Some((surroundings, eye)) = outside.foreground() else { return Estimate::default() };
    let open = outside.open();
    let found = on_dome::over(&Prospect::new(&open, surroundings, eye), region, weight, CHANGED, 0.0);
    found.map_or_else(Estimate::default, change)
}

/// Computes the difference that surroundings make to the illuminance of a plane. \[lx\]
fn changed_on(outside: &Outside, plane: &Frame) -> Estimate {
    let Some((surroundings, eye)) = outside.foreground() else { return Estimate::default() };
    let open = outside.open();
    let found = on_dome::over_hemisphere(&Prospect::new(&open, surroundings, eye), plane, CHANGED, 0.0);
    found.into_iter().flatten().map(change).sum()
}

/// Returns the difference between the light of the surroundings and the light that they hide.
fn change((parts, error): (Parts, f64)) -> Estimate {
    Estimate::new(parts.before - parts.behind, error + parts.uncertainty)
}

/// Computes the illuminance of a plane by sky, skyline, ground and surroundings, without direct sun. \[lx\] `normal`:
/// of the plane.
pub fn irradiance(outside: &Outside, normal: Dir<World>) -> Estimate {
    let frame = Frame::facing(normal);
    // In quarters of the azimuth, whose borders include the kinks at a façade's horizon.
    let open: Estimate = (0..4)
        .map(|quarter| {
            let from = f64::from(quarter) * FRAC_PI_2;
            let region = Region { frame, theta: (0.0, FRAC_PI_2), phi: (from, from + FRAC_PI_2) };
            let tolerance = Tolerance { relative: 1e-7, ..Tolerance::absolute(1e-9 * outside.diffuse_horizontal) };
            integrate_region(outside, &region, Weight::Projected, tolerance)
        })
        .sum();
    open + changed_on(outside, &frame)
}

/// Computes the mean luminance of a patch of the sky dome (eq 9) with the skyline and obstructions in it, weighted by
/// solid angle. \[cd/m²\]
pub fn mean_luminance(outside: &Outside, patch: &Patch) -> Estimate {
    let tolerance = Tolerance::relative(1e-8);
    // The cap around the zenith is divided into quarters, because the quadrature rules are made for smooth pieces.
    let pieces = if patch.width > PI { 4 } else { 1 };
    let step = patch.width / f64::from(pieces);
    let flux: Estimate = (0..pieces)
        .map(|piece| {
            let from = patch.bearing - 0.5 * patch.width + f64::from(piece) * step;
            let theta = (FRAC_PI_2 - patch.altitude_max, FRAC_PI_2 - patch.altitude_min);
            let region = Region { frame: Frame::DOME, theta, phi: (from, from + step) };
            integrate_region(outside, &region, Weight::Solid, tolerance) + changed(outside, &region, Weight::Solid)
        })
        .sum();
    let mean = flux * (1.0 / patch.solid_angle());
    // For a fully hidden patch, the sky is added and subtracted: a negative remainder is error.
    Estimate::new(mean.value.max(0.0), mean.error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::polygon::projected_solid_angle;
    use crate::compute::sky::Distribution;
    use crate::compute::surroundings::Surroundings;
    use crate::compute::surroundings::solid::Solid;
    use glam::DVec3;
    use std::sync::Arc;

    /// Black boxes hide from a wall and a roof what their faces cover of a uniform sky, wherever their edges run.
    #[test]
    fn black_boxes_hide_the_projected_solid_angles_of_their_faces() {
        let solid = |from: [f64; 3], to: [f64; 3], turn| Solid::new(from.into(), to.into(), turn);
        let slats = (0..12).map(|k| 0.5 + 0.25 * f64::from(k));
        let cases = [
            vec![solid([-2.0, -1.0, 2.0], [2.0, -0.1, 2.2], 0.0)],
            vec![solid([1.0, -1.5, 0.5], [1.1, -0.1, 3.0], 0.0)],
            vec![solid([-9.0, -20.0, 0.5], [1.0, -9.0, 14.0], 0.4)],
            // None covers another.
            slats.map(|z| solid([-0.9, -0.101, z], [0.9, -0.1, z + 0.1], 0.0)).collect(),
        ];
        let eye = DVec3::new(0.1, 0.0, 0.4);
        for solids in cases {
            let outside = Outside::new(Distribution::uniform(), 1e4).unwrap();
            let past = outside.clone().behind(Arc::new(Surroundings::dark(solids.clone(), None))).seen_from(eye);
            for normal in [DVec3::NEG_Y, DVec3::Z] {
                let faces = solids.iter().flat_map(|solid| (0..6).map(|number| solid.face(number)));
                let seen = faces.filter(|face| face.normal.dot(eye - face.origin) > 0.0);
                let covered =
                    seen.map(|face| projected_solid_angle(&face.corners().map(|corner| corner - eye), normal));
                let exact = -1e4 / PI * covered.map(f64::abs).sum::<f64>();
                let normal = Dir::from_unit(normal);
                let found = irradiance(&past, normal).value - irradiance(&outside, normal).value;
                assert!((found / exact - 1.0).abs() < 2.0 * CHANGED, "{normal:?}: {found} {exact}");
            }
        }
    }
}
