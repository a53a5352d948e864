//! What black bodies and a skyline take from a plane at a point: for the light on faces.
//!
//! Along a line of constant bearing a convex body is one interval of the altitude's tangent, in closed form by the
//! planes that hold it, and so are horizon, skyline and the rows of a measured sky; what upright edges begin and end are
//! bearings. Many bodies cost little more than those that stand at one bearing.

use super::outside::Outside;
use super::patches::ROW_HEIGHT;
use super::scan_region::sector_bearings;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::Solid;
use crate::compute::sweep::{rule, sweep};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// What stands before the sky as it is seen from a point.
pub(super) struct Hidden<'a> {
    /// Sky, ground and flat skyline.
    open: &'a Outside,
    skyline: Option<&'a Skyline>,
    normal: DVec3,
    bodies: Vec<Body>,
}

/// A convex body from the point.
struct Body {
    /// Directions d with n·d > 0 for all of these meet it.
    planes: Vec<DVec3>,
    /// Bearings between which it is seen: the middle, and how far to both sides. \[rad\]
    bearing: f64,
    reach: [f64; 2],
    /// Bearings of its corners where it is worth a knot of the sweep.
    corners: Vec<f64>,
}

/// Bodies that take together less than this share of the open light are left out.
const LEFT_OUT: f64 = 3e-4;
/// So many bodies at most, those that take most, have knots of the sweep at their corners.
const WITH_KNOTS: usize = 10;
/// Only bodies of smaller radius are left out: their middle stands for all of them. \[rad\]
const SMALL: f64 = 0.06;

/// An angle turned into −π … π.
fn turned(angle: f64) -> f64 {
    angle - 2.0 * PI * (angle / (2.0 * PI)).round()
}

fn bearing(v: DVec3) -> f64 {
    v.x.atan2(v.y)
}

impl Body {
    fn new(solid: &Solid, planes: Vec<DVec3>, point: DVec3, with_knots: bool) -> Self {
        let above = |pole: DVec3| planes.iter().all(|n| n.dot(pole) > -1e-9);
        let corners = solid.corners().map(|corner| corner - point);
        if above(DVec3::Z) || above(DVec3::NEG_Z) {
            let knots = if with_knots { corners.map(bearing).to_vec() } else { Vec::new() };
            return Self { planes, bearing: 0.0, reach: [-4.0, 4.0], corners: knots };
        }
        let middle = bearing(solid.middle() - point);
        let offsets = corners.map(|corner| turned(bearing(corner) - middle));
        let reach = [offsets.iter().copied().fold(0.0, f64::min), offsets.iter().copied().fold(0.0, f64::max)];
        let knots = if with_knots { offsets.map(|offset| middle + offset).to_vec() } else { Vec::new() };
        Self { planes, bearing: middle, reach: [reach[0] - 1e-9, reach[1] + 1e-9], corners: knots }
    }
}

/// Tangents of altitude at which A + B·t > 0 holds for all planes, along a bearing.
fn span<'a>(planes: impl Iterator<Item = &'a DVec3>, along: DVec3) -> Option<(f64, f64)> {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for plane in planes {
        let (a, b) = (plane.dot(along), plane.z);
        if b > 0.0 {
            low = low.max(-a / b);
        } else if b < 0.0 {
            high = high.min(-a / b);
        } else if a <= 0.0 {
            return None;
        }
    }
    (low < high).then_some((low, high))
}

impl<'a> Hidden<'a> {
    /// Before a plane through `point`; `None` where a body takes everything. `free`: the open light on the plane. \[lx\]
    pub fn new(
        open: &'a Outside,
        skyline: Option<&'a Skyline>,
        solids: &[&Solid],
        (point, normal): (DVec3, DVec3),
        free: f64,
    ) -> Option<Self> {
        // What every body may take at most, the least first.
        let mut known = Vec::with_capacity(solids.len());
        for solid in solids {
            if solid.corners().iter().all(|corner| normal.dot(*corner - point) < 1e-9) {
                continue;
            }
            let planes = solid.cone(point);
            if planes.is_empty() {
                if solid.enter(point, normal).is_some() {
                    return None;
                }
                continue;
            }
            let to = solid.middle() - point;
            let sine = solid.radius() / to.length();
            let bright = open.luminance(crate::compute::direction::Dir::from_unit(to.normalize_or_zero()));
            let large = sine >= SMALL || free <= 0.0;
            let share = if large { sine } else { (PI * sine * sine * bright / free).max(1e-12) };
            known.push((large, share, *solid, planes));
        }
        known.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut left_out = 0.0;
        let first = known.iter().position(|(large, share, ..)| {
            left_out += share;
            *large || left_out > LEFT_OUT
        });
        known.drain(..first.unwrap_or(known.len()));
        let known = known.into_iter().rev().enumerate();
        let bodies = known.map(|(rank, (_, _, solid, planes))| Body::new(solid, planes, point, rank < WITH_KNOTS));
        let bodies = bodies.collect();
        Some(Self { open, skyline, normal, bodies })
    }

    /// Light that the plane gets more than from the open outside: less than 0 but where a skyline is brighter than the
    /// sky. \[lx\]
    pub fn change(&self, absolute: f64) -> f64 {
        if self.bodies.is_empty() && self.skyline.is_none() {
            return 0.0;
        }
        // Faces are upright or level: a wall sees half of all bearings.
        let upright = self.normal.z.abs() < 1e-9;
        let (middle, half) = if upright { (bearing(self.normal), FRAC_PI_2) } else { (0.0, PI) };
        let mut knots: Vec<f64> = (0..=4).map(|k| (0.5 * f64::from(k) - 1.0) * half).collect();
        let sectors = if self.open.is_piecewise_constant() { sector_bearings() } else { Vec::new() };
        let others = self.skyline.iter().flat_map(|skyline| skyline.corners()).chain(self.peak()).map(bearing);
        let corners = self.bodies.iter().flat_map(|body| body.corners.iter().copied());
        knots.extend(corners.chain(others).chain(sectors).map(|at| turned(at - middle)).filter(|at| at.abs() < half));
        knots.sort_unstable_by(f64::total_cmp);
        knots.dedup_by(|a, b| *a - *b < 1e-9);
        let mut spans = Vec::with_capacity(self.bodies.len() + 1);
        sweep(|at| [self.line(middle + at, &mut spans)], &knots, 1e-3, absolute).0[0]
    }

    fn peak(&self) -> Option<DVec3> {
        self.open.sun_direction().map(crate::compute::direction::Dir::vector)
    }

    /// Along one bearing: what is taken, per angle of bearing.
    fn line(&self, bearing: f64, spans: &mut Vec<(f64, f64)>) -> f64 {
        let (sin, cos) = bearing.sin_cos();
        let along = DVec3::new(sin, cos, 0.0);
        spans.clear();
        for body in &self.bodies {
            let offset = turned(bearing - body.bearing);
            if offset > body.reach[0] && offset < body.reach[1] {
                spans.extend(span(body.planes.iter().chain([&self.normal]), along));
            }
        }
        spans.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let top = self.skyline.map_or(f64::NEG_INFINITY, |skyline| skyline.altitude(bearing).tan());
        let Some((low, high)) = span([&self.normal].into_iter(), along) else { return 0.0 };
        let mut sum = 0.0;
        // From the lowest altitude of the plane's view upwards: what no body hides lies below the skyline or is open.
        let mut done = low;
        let skyline = |from: f64, to: f64| {
            let (from, to) = (from.max(0.0), to.min(top));
            if from >= to {
                return 0.0;
            }
            let luminance = self.skyline.map_or(0.0, |skyline| skyline.luminance);
            let of = |altitude: f64| self.weight(along, altitude);
            luminance * (of(to.atan()) - of(from.atan())) - self.open_light(along, from, to)
        };
        for &(from, to) in &*spans {
            if from > done {
                sum += skyline(done, from);
            }
            if to > done {
                sum -= self.open_light(along, from.max(done), to);
                done = to;
            }
        }
        sum + skyline(done, high)
    }

    /// ∫ cos α (n·d) dα up to an altitude.
    fn weight(&self, along: DVec3, altitude: f64) -> f64 {
        let (sin, cos) = altitude.sin_cos();
        0.5 * (self.normal.dot(along) * (altitude + sin * cos) + self.normal.z * sin * sin)
    }

    /// Light of sky, ground and flat skyline between two tangents of altitude.
    fn open_light(&self, along: DVec3, from: f64, to: f64) -> f64 {
        let (from, to) = (from.atan(), to.atan());
        let of = |from: f64, to: f64| self.weight(along, to) - self.weight(along, from);
        let level = self.open.skyline_altitude();
        let mut sum = 0.0;
        if from < 0.0 {
            sum += self.open.ground_luminance() * of(from, to.min(0.0));
        }
        if from < level && to > 0.0 {
            sum += self.open.skyline_luminance() * of(from.max(0.0), to.min(level));
        }
        let (mut low, high) = (from.max(level), to);
        if low >= high {
            return sum;
        }
        let steps = self.open.is_piecewise_constant();
        let peak = self.peak().map(|peak| peak.z.clamp(-1.0, 1.0).asin());
        while low < high {
            // To the next row of a measured sky, or the altitude of the sun.
            let row = if steps { ((low / ROW_HEIGHT + 1e-9).floor() + 1.0) * ROW_HEIGHT } else { high };
            let next = peak.filter(|peak| *peak > low + 1e-9).map_or(row, |peak| row.min(peak)).min(high);
            let at = |altitude: f64| {
                let (sin, cos) = altitude.sin_cos();
                self.open.sky_luminance(along * cos + DVec3::Z * sin)
            };
            if steps {
                sum += at(0.5 * (low + next)) * of(low, next);
            } else {
                for &(x, share) in rule(3 + ((next - low) / 0.2) as usize) {
                    let altitude = low + (next - low) * x;
                    let (sin, cos) = altitude.sin_cos();
                    let cosine = self.normal.dot(along) * cos + self.normal.z * sin;
                    sum += share * (next - low) * cos * cosine * at(altitude);
                }
            }
            low = next;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Distribution, irradiance};
    use super::*;
    use crate::compute::direction::Dir;

    /// Share of the open light that is left, by rays.
    fn by_rays(open: &Outside, skyline: Option<&Skyline>, solids: &[Solid], point: DVec3, normal: DVec3) -> f64 {
        let (x, y) = normal.any_orthonormal_pair();
        let n = 500;
        let mut sum = 0.0;
        for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (f64::from(a) + 0.5, f64::from(b) + 0.5))) {
            let (ring, phi) = (a / f64::from(n), 2.0 * PI * (b / f64::from(n) + 0.618 * a));
            let d = ring.sqrt() * (x * phi.cos() + y * phi.sin()) + (1.0 - ring).sqrt() * normal;
            if solids.iter().all(|solid| solid.enter(point, d).is_none()) {
                let seen = skyline.filter(|skyline| skyline.covers(d)).map(|skyline| skyline.luminance);
                sum += seen.unwrap_or_else(|| open.luminance(Dir::from_unit(d.normalize())));
            }
        }
        PI * sum / f64::from(n * n)
    }

    #[test]
    fn what_is_left_agrees_with_rays() {
        let sun = Dir::from_altitude_bearing(0.6, crate::compute::angle::Bearing::from_degrees(170.0));
        let skyline = Skyline::new([[1.0, 0.2], [3.0, 0.5], [3.2, 0.1]], 900.0).unwrap();
        let solids = [
            Solid::new(DVec3::new(-3.0, -8.0, 0.0), DVec3::new(-1.0, -5.0, 6.0), 0.4),
            Solid::new(DVec3::new(1.0, -2.0, 3.0), DVec3::new(4.0, 0.0, 3.2), 0.0),
            Solid::new(DVec3::new(-40.0, -30.0, 0.0), DVec3::new(-39.0, -29.0, 2.0), 0.0),
            Solid::new(DVec3::new(2.0, -9.0, 0.0), DVec3::new(9.0, -8.0, 5.0), -0.2),
        ];
        for distribution in [Distribution::uniform(), Distribution::cie(12, sun).unwrap()] {
            let open = Outside::new(distribution, 1e4).unwrap().with_ground(0.2, 0.0).unwrap();
            for normal in [DVec3::NEG_Y, DVec3::Z, DVec3::X] {
                let free = irradiance(&open, Dir::from_unit(normal)).value;
                for (skyline, point) in
                    [(None, DVec3::new(0.0, -1.0, 1.5)), (Some(&skyline), DVec3::new(2.0, -4.0, 1.0))]
                {
                    let list: Vec<&Solid> = solids.iter().collect();
                    let hidden = Hidden::new(&open, skyline, &list, (point, normal), free).unwrap();
                    let found = free + hidden.change(1e-3 * free);
                    let rays = by_rays(&open, skyline, &solids, point, normal);
                    assert!((found - rays).abs() < 4e-3 * free, "{normal} {point}: {found} {rays} of {free}");
                }
            }
        }
        // Within a body nothing is left.
        let open = Outside::new(Distribution::uniform(), 1e4).unwrap();
        let inside = (DVec3::new(-2.0, -6.0, 2.0), DVec3::Z);
        assert!(Hidden::new(&open, None, &solids.iter().collect::<Vec<_>>(), inside, 1e4).is_none());
    }
}
