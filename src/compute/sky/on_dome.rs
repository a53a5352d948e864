//! Integrals of the luminance over a region of any frame, swept by the compass bearing.
//!
//! Along the meridian of a bearing a skyline is one altitude, the rows of a measured sky are fixed altitudes, and its
//! sectors begin and end at bearings: none of them can be missed, however steep or narrow. The borders of the region
//! (cones about its axis, and half planes through it) are met in closed form, too.

use super::prospect::{Near, Parts, Prospect, on_cone};
use super::region::{Frame, Region, Weight};
use super::scan_region::sector_bearings;
use crate::compute::sweep::sweep;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Maximum angular distance from a region at which the zenith counts as in it. \[rad\] Chosen: cost only; a region that
/// does not quite reach it is then swept over all bearings.
const AT_ZENITH: f64 = 1e-6;

/// Computes the integrals of the luminance of the surroundings, and of sky and ground behind them, over a region, with
/// the error of the cubature; `None` if there are no surroundings in the region. The sweep is by bearings where that is
/// simpler, otherwise by meridians of the region's frame.
pub(super) fn over(
    prospect: &Prospect<'_>,
    region: &Region,
    weight: Weight,
    relative: f64,
    absolute: f64,
) -> Option<(Parts, f64)> {
    if !prospect.is_of_the_dome() {
        return prospect.over(region, weight, relative, absolute);
    }
    let near = prospect.near(&region.cap())?;
    let (parts, error) = by_bearings(prospect, region, &near, weight, relative, absolute);
    (parts.behind > 0.0 || parts.before > 0.0).then_some((parts, error))
}

/// Computes the integrals of [`over`] over the hemisphere in front of a plane, weighted by the cosine to its normal: as
/// one part with meridians along most edges, or as four quarters where the meridians of the dome are needed.
pub(super) fn over_hemisphere(
    prospect: &Prospect<'_>,
    plane: &Frame,
    relative: f64,
    absolute: f64,
) -> Vec<Option<(Parts, f64)>> {
    if !prospect.is_of_the_dome() {
        let region = Region { frame: prospect.frame_along_edges(plane), theta: (0.0, PI), phi: (0.0, PI) };
        let density = |theta: f64, direction: DVec3| theta.sin() * direction.dot(plane.z).max(0.0);
        return vec![prospect.over_by(&region, &density, relative, absolute)];
    }
    let quarter = |k: u32| {
        let phi = (f64::from(k) * FRAC_PI_2, f64::from(k + 1) * FRAC_PI_2);
        let region = Region { frame: *plane, theta: (0.0, FRAC_PI_2), phi };
        over(prospect, &region, Weight::Projected, relative, 0.25 * absolute)
    };
    (0..4).map(quarter).collect()
}

/// Computes the integrals of [`over`] by a sweep over bearings.
fn by_bearings(
    prospect: &Prospect<'_>,
    region: &Region,
    near: &Near,
    weight: Weight,
    relative: f64,
    absolute: f64,
) -> (Parts, f64) {
    let sides = [region.phi.0, region.phi.1].map(|phi| side(region, phi));
    let (reference, knots) = bearings(prospect, region, near, &sides);
    let (mut breaks, mut rims) = (Vec::with_capacity(32), Vec::with_capacity(8));
    let line = |at: f64| {
        let bearing = reference + at;
        let along = Frame::DOME.direction(FRAC_PI_2, bearing);
        rims.clear();
        for theta in [region.theta.0, region.theta.1] {
            rims.extend(cone_at(region.frame.z, theta, along));
        }
        rims.extend(sides.iter().map(|n| (-n.z).atan2(n.dot(along)).rem_euclid(PI)));
        prospect.breaks_at_bearing(bearing, &near.edges, &rims, &mut breaks);
        let mut sum = [0.0; 5];
        let line = prospect.along(near, Frame::DOME.meridian(bearing));
        let density = |zenith: f64, d: DVec3| match weight {
            Weight::Projected => zenith.sin() * d.dot(region.frame.z).max(0.0),
            Weight::Solid => zenith.sin(),
        };
        for pair in breaks.windows(2).filter(|pair| pair[1] - pair[0] > 1e-12) {
            if region.holds(line.meridian.direction(0.5 * (pair[0] + pair[1])), 0.0) {
                prospect.add(&line, (pair[0], pair[1]), density, &mut sum);
            }
        }
        sum
    };
    let (sums, error) = sweep(line, &knots, relative, absolute);
    (Parts::of(sums), error)
}

/// Returns the normal of the half plane of an azimuth of the region's frame.
fn side(region: &Region, phi: f64) -> DVec3 {
    let (sin, cos) = phi.sin_cos();
    region.frame.y * cos - region.frame.x * sin
}

/// Returns the zenith angles at which the meridian along a bearing meets a cone about an axis with the half-angle
/// `theta`. \[rad\]
fn cone_at(axis: DVec3, theta: f64, along: DVec3) -> impl Iterator<Item = f64> {
    let (a, b) = (axis.dot(along), axis.z);
    let cosine = theta.cos() / a.hypot(b);
    let (middle, half) = (a.atan2(b), cosine.acos());
    // Beyond ±1 the arc cosine is not a number: there is no such angle.
    [middle - half, middle + half, middle + half - 2.0 * PI].into_iter().filter(|at| *at > 0.0 && *at < PI)
}

/// Returns a reference bearing, and relative to it the rising bearings between which the sweep's lines change smoothly.
fn bearings(prospect: &Prospect<'_>, region: &Region, near: &Near, sides: &[DVec3; 2]) -> (f64, Vec<f64>) {
    let frame = &region.frame;
    let (thetas, phis) = ([region.theta.0, region.theta.1], [region.phi.0, region.phi.1]);
    let middle = frame.direction(0.5 * (thetas[0] + thetas[1]), 0.5 * (phis[0] + phis[1]));
    let reference = middle.x.atan2(middle.y);
    let turned = |bearing: f64| {
        let from = bearing - reference;
        from - 2.0 * PI * (from / (2.0 * PI)).round()
    };
    let of = |v: DVec3| turned(v.x.atan2(v.y));
    // Candidates for the ends of the region's bearings: its corners, and points at which a limit in θ touches a
    // meridian.
    let mut ends: Vec<DVec3> = thetas.iter().flat_map(|t| phis.map(|p| frame.direction(*t, p))).collect();
    for theta in thetas {
        ends.extend(touching(frame.z, theta).into_iter().flatten().filter(|at| region.holds(*at, 1e-9)));
    }
    let mut knots: Vec<f64> = ends.into_iter().map(of).collect();
    let (mut low, mut high) = (-PI, PI);
    if !region.holds(DVec3::Z, AT_ZENITH) && !region.holds(DVec3::NEG_Z, AT_ZENITH) {
        (low, high) = (knots.iter().copied().fold(f64::INFINITY, f64::min), knots.iter().copied().fold(-PI, f64::max));
    } else {
        knots.extend([-0.5 * PI, 0.0, 0.5 * PI]);
    }
    for &[a, b] in &near.edges {
        knots.extend([of(a), of(b)]);
        for theta in thetas {
            knots.extend(on_cone(a, b, frame.z, theta).map(of));
        }
        for n in sides {
            let (p, q) = (n.dot(a), n.dot(b));
            if (p > 0.0) != (q > 0.0) {
                knots.push(of(a + (b - a) * (p / (p - q))));
            }
        }
    }
    knots.extend(
        prospect.surroundings.skyline.iter().flat_map(|skyline| skyline.corners()).chain(prospect.peak).map(of),
    );
    if prospect.open.is_piecewise_constant() {
        knots.extend(sector_bearings().into_iter().map(turned));
    }
    knots.retain(|at| *at > low + 1e-10 && *at < high - 1e-10);
    knots.extend([low, high]);
    knots.sort_unstable_by(f64::total_cmp);
    knots.dedup_by(|a, b| *a - *b < 1e-10);
    (reference, knots)
}

/// Returns the directions at which a cone about an axis touches meridians of the dome.
fn touching(axis: DVec3, theta: f64) -> [Option<DVec3>; 2] {
    // There the meridian's plane has the angle theta to the axis: |n·axis| = sin θ for its horizontal normal n.
    let level = axis.truncate().length();
    let sine = theta.sin() / level;
    if sine >= 1.0 || sine.is_nan() {
        return [None; 2];
    }
    let middle = axis.x.atan2(axis.y);
    [sine.asin(), -sine.asin()].map(|aside| {
        let along = Frame::DOME.direction(FRAC_PI_2, middle + aside);
        let (a, b) = (axis.dot(along), axis.z);
        let zenith = (a * theta.cos().signum()).atan2(b * theta.cos().signum());
        (zenith > 0.0).then(|| Frame::DOME.direction(zenith, middle + aside))
    })
}

#[cfg(test)]
mod tests {
    use super::super::{
        Distribution, Outside, Scan, incident_illuminances_within, irradiance, irradiance_through, mean_luminance,
        patches::tregenza_patches,
    };
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::basis::{AzimuthMap, RingBasis};
    use crate::compute::direction::{Dir, Orientation, Surface};
    use crate::compute::quadrature::Tolerance;
    use crate::compute::surroundings::Surroundings;
    use crate::compute::surroundings::skyline::Skyline;
    use crate::compute::surroundings::solid::Solid;
    use std::sync::Arc;

    fn behind(outside: Outside, solids: Vec<Solid>, skyline: Option<Skyline>) -> Outside {
        outside.behind(Arc::new(Surroundings::dark(solids, skyline)))
    }

    /// Returns the illuminance by the closed form and by cells.
    fn on_an_aperture(outside: &Outside, surface: Surface, azimuth: f64) -> [f64; 2] {
        let frame = Frame::of_aperture(Orientation::new(Bearing::from_degrees(azimuth)), surface);
        let cells = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let by_cells = incident_illuminances_within(outside, &cells, &frame, 1e-3).iter().map(|e| e.value).sum();
        [irradiance(outside, Dir::from_unit(frame.z)).value, by_cells]
    }

    #[test]
    fn narrow_and_steep_skylines_give_what_they_hold() {
        let tower = vec![[185.0, 0.0], [185.01, 70.0], [188.0, 70.0], [188.01, 0.0]];
        let tooth = vec![[170.0, 0.0], [172.0, 60.0], [174.0, 0.0]];
        for (knots, luminance) in [(tower, 1e5), (tooth, 5e4)] {
            let skyline = Skyline::new(knots.iter().map(|knot: &[f64; 2]| knot.map(f64::to_radians)), luminance);
            let skyline = skyline.unwrap();
            // The skyline takes the uniform sky's place: sums over bearings of the closed form in altitude.
            let count = 400_000;
            let step = 2.0 * PI / f64::from(count);
            let more = luminance - 1e4 / PI;
            let (mut wall, mut roof) = (5000.0, 1e4);
            for k in 0..count {
                let bearing = (f64::from(k) + 0.5) * step;
                let top = skyline.altitude(bearing);
                wall += more
                    * (bearing - 195_f64.to_radians()).cos().max(0.0)
                    * (0.5 * top + 0.25 * (2.0 * top).sin())
                    * step;
                roof += more * 0.5 * top.sin().powi(2) * step;
            }
            let outside = behind(Outside::new(Distribution::uniform(), 1e4).unwrap(), Vec::new(), Some(skyline));
            for (surface, exact) in [(Surface::Facade, wall), (Surface::Roof, roof)] {
                for found in on_an_aperture(&outside, surface, 195.0) {
                    assert!((found / exact - 1.0).abs() < 1e-3, "{surface:?} {luminance}: {found} {exact}");
                }
            }
        }
    }

    #[test]
    fn what_a_black_skyline_hides_is_dark_and_never_below() {
        let knots = [[0.0, 20.0], [90.0, 25.0], [180.0, 13.0], [270.0, 18.0]];
        let skyline = Skyline::new(knots.iter().map(|knot| knot.map(f64::to_radians)), 0.0).unwrap();
        let scan: Vec<f64> = (0..145).map(|k| 500.0 + 40.0 * f64::from((k * 37) % 145)).collect();
        let outside = behind(Outside::measured(Scan::new(&scan).unwrap()), Vec::new(), Some(skyline));
        // The lowest ring of patches ends at 12°.
        for patch in &tregenza_patches()[..30] {
            let mean = mean_luminance(&outside, patch);
            assert!(mean.value >= 0.0 && mean.value < 5.0 && mean.error >= 0.0, "{mean:?}");
        }
    }

    #[test]
    fn a_measured_sky_of_steps_past_a_box_agrees_with_directions() {
        let values: Vec<f64> = (0..145).map(|k| if (k * 7) % 3 == 0 { 20_000.0 } else { 200.0 }).collect();
        let sky = || Outside::measured(Scan::new(&values).unwrap());
        let solid = Solid::new(DVec3::new(-5.0, -30.0, 0.0), DVec3::new(2.0, -25.0, 15.0), 0.3);
        let past = behind(sky(), vec![solid], None).seen_from(DVec3::new(2.0, 0.0, 1.8));
        let n = 900;
        let ring = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
        let mut sum = 0.0;
        for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (a, b))) {
            let (out, phi) = (ring(a).sqrt(), 2.0 * PI * (ring(b) + 0.618 * f64::from(a)));
            let d = DVec3::new(out * phi.cos(), -(1.0 - ring(a)).sqrt(), out * phi.sin());
            sum += past.luminance(Dir::from_unit(d.normalize()));
        }
        let by_directions = PI * sum / f64::from(n * n);
        for found in on_an_aperture(&past, Surface::Facade, 180.0) {
            assert!((found / by_directions - 1.0).abs() < 2e-3, "{found} {by_directions}");
        }
        // Through an opening, by a grid on it.
        let corners = [[-1.5, -1.0, 0.1], [1.5, -1.0, 0.1], [1.5, -1.0, 1.9], [-1.5, -1.0, 1.9]].map(DVec3::from_array);
        let through = irradiance_through(&past, &corners, Dir::from_unit(DVec3::Z), |_| 1.0, Tolerance::relative(1e-3));
        let on_grid = (0..n).flat_map(|a| (0..n).map(move |b| (a, b))).map(|(a, b)| {
            let p = DVec3::new(3.0 * ring(a) - 1.5, -1.0, 0.1 + 1.8 * ring(b));
            let square = p.length_squared();
            let d = p / square.sqrt();
            past.luminance(Dir::from_unit(d)) * d.z * -d.y / square * 5.4 / f64::from(n * n)
        });
        let on_grid: f64 = on_grid.sum();
        assert!((through.value / on_grid - 1.0).abs() < 3e-3, "{} {on_grid}", through.value);
    }
}
