//! Illuminance of a sensor by the outside seen undeviated through an aperture (eq 20 in eq 17): the luminance of sky
//! and ground, integrated over the solid angle in which the sensor sees them through the aperture.
//!
//! In azimuth and altitude about the zenith a plane aperture, the horizon, a uniform skyline and the sun's altitude are
//! all simple limits of the altitude, for façades and roofs. The region is divided along them, and each piece is
//! integrated adaptively with an error estimate.

use super::aperture::View;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Room, Surface};
use crate::compute::estimate::Estimate;
use crate::compute::lid::Facing;
use crate::compute::polygon::{clip, projected_solid_angle};
use crate::compute::quadrature::{Rectangle, Tolerance, gauss_legendre, integrate_smooth_rectangles};
use crate::compute::sequence::net;
use crate::compute::sky::irradiance_through;
use glam::DVec3;
use std::f64::consts::PI;

/// Computes the illuminance of a sensor by sky, ground and obstructions seen through an aperture, each direction
/// weighted by the regular transmittance τ(θ) of its system. \[lx\] `view`: aperture as seen from the sensor; `facing`:
/// outside in front of the aperture, with obstructions as seen from the sensor. If τ does not depend on θ, parts of
/// constant luminance have a closed form.
pub fn illuminance(view: &View, facing: &Facing<'_>, tau: &AngularTransmittance, tolerance: Tolerance) -> Estimate {
    let to_room = |v: DVec3| facing.surface.room_from_facade(v);
    let uniform_tau = tau.constant();
    let normal = to_room(view.normal);
    let mut polygon = Vec::with_capacity(6);
    clip(&view.corners().map(to_room), normal, &mut polygon);
    if polygon.len() < 3 {
        return Estimate::default();
    }
    let outside = facing.outside;
    if outside.surroundings().is_some() {
        let world = |v: DVec3| facing.orientation.to_world(v);
        let corners: Vec<DVec3> = polygon.iter().map(|corner| world(*corner)).collect();
        let weight = |d: DVec3| {
            uniform_tau.unwrap_or_else(|| {
                tau.at(facing.surface.facade_from_room(facing.orientation.to_room(d)).z.clamp(-1.0, 1.0).acos())
            })
        };
        return irradiance_through(outside, &corners, Dir::from_unit(world(normal)), weight, tolerance);
    }
    let mut sum = Estimate::default();
    let mut above = polygon.clone();
    if let Some(tau) = uniform_tau {
        let mut below = Vec::with_capacity(7);
        clip(&polygon, DVec3::NEG_Z, &mut below);
        if below.len() >= 3 {
            sum += Estimate::exact(tau * outside.ground_luminance() * projected_solid_angle(&below, normal));
        }
        clip(&polygon, DVec3::Z, &mut above);
        if above.len() < 3 {
            return sum;
        }
        if outside.is_uniform_above_horizon() {
            let luminance = facing.luminance(facing.surface.facade_dir(Dir::from_unit(DVec3::Z)));
            return sum + Estimate::exact(tau * luminance * projected_solid_angle(&above, normal));
        }
    }
    let sun = outside.sun_direction().map(|sun| facing.orientation.room_from_world(sun).vector());
    let region = Region::new(&above, facing.surface, sun, outside.skyline_altitude());
    let integrand = |(sin_a, cos_a): (f64, f64), altitude: f64| {
        let (sin_h, cos_h) = altitude.sin_cos();
        let d = DVec3::new(cos_h * cos_a, cos_h * sin_a, sin_h);
        let luminance = outside.luminance(facing.orientation.world_from_room(Dir::from_unit(d)));
        let tau = uniform_tau.unwrap_or_else(|| {
            let cosine = facing.surface.facade_from_room(d).z;
            tau.at(cosine.clamp(-1.0, 1.0).acos())
        });
        luminance * tau * normal.dot(d).max(0.0) * cos_h
    };
    sum + region.integrate(integrand, tolerance)
}

/// Returns fixed directions in which a sensor sees the sky through an aperture, in the room's frame, with weights that
/// include the sensor's cosine. \[sr\] `skyline`: altitude of a uniform skyline \[rad\], 0 for the horizon; `parts`:
/// minimum number of Gauss points along each side of every piece of the visible region.
pub fn samples(view: &View, surface: Surface, skyline: f64, parts: usize) -> Vec<(Dir<Room>, f64)> {
    let to_room = |v: DVec3| surface.room_from_facade(v);
    let normal = to_room(view.normal);
    let (mut polygon, mut above) = (Vec::with_capacity(6), Vec::with_capacity(7));
    clip(&view.corners().map(to_room), normal, &mut polygon);
    if polygon.len() >= 3 {
        clip(&polygon, DVec3::Z, &mut above);
    }
    if above.len() < 3 {
        return Vec::new();
    }
    let region = Region::new(&above, surface, None, skyline);
    let mut list = Vec::new();
    region.nodes(skyline, parts, |azimuth, altitude, area| {
        let (sin_h, cos_h) = altitude.sin_cos();
        let (sin_a, cos_a) = azimuth.sin_cos();
        let d = DVec3::new(cos_h * cos_a, cos_h * sin_a, sin_h);
        let weight = normal.dot(d).max(0.0) * cos_h * area;
        if weight > 0.0 {
            list.push((Dir::from_unit(d), weight));
        }
    });
    list
}

/// Calls `visit` with directions of the façade frame from the sensor through a horizontal strip of the aperture, and
/// the solid angle that each represents times the sensor's cosine \[sr\]. `y`: limits of the strip relative to the
/// sensor \[m\]. The directions are Gauss points in the two profile angles, in which the integrand is smooth near the
/// aperture, too. `rules`: Gauss rules by number of points, from 0.
pub fn nodes(view: &View, y: [f64; 2], rules: &[Vec<(f64, f64)>], mut visit: impl FnMut(DVec3, f64)) {
    let angle = |x: f64| (x / view.distance).atan();
    let ([a0, a1], [b0, b1]) = (view.x.map(angle), y.map(angle));
    if b1 - b0 < 1e-12 {
        return;
    }
    let order = |width: f64| ((2.0 + 4.0 * width - 1e-9).ceil() as usize).min(rules.len() - 1);
    let area = (a1 - a0) * (b1 - b0);
    for &(s, ws) in &rules[order(a1 - a0)] {
        let x = (a0 + (a1 - a0) * s).tan();
        for &(t, wt) in &rules[order(b1 - b0)] {
            let y = (b0 + (b1 - b0) * t).tan();
            let square = 1.0 + x * x + y * y;
            let d = DVec3::new(x, y, 1.0) / square.sqrt();
            // dω = dx dy / r³ with dx = (1 + x²) da.
            let solid = (1.0 + x * x) * (1.0 + y * y) / (square * square.sqrt());
            visit(d, area * ws * wt * solid * view.normal.dot(d).max(0.0));
        }
    }
}

/// Calls `visit` with directions of the façade frame from the sensor that are distributed over the aperture, the solid
/// angle that each represents times the sensor's cosine \[sr\], and the point where it crosses the aperture, as shares
/// of the sides. `count`: number of directions, a power of two.
pub fn spread(view: &View, count: u32, mut visit: impl FnMut(DVec3, f64, [f64; 2])) {
    let range = |limits: [f64; 2]| limits.map(|x| (x / view.distance).atan());
    let ([a0, a1], [b0, b1]) = (range(view.x), range(view.y));
    let share = |at: f64, [low, high]: [f64; 2]| ((at * view.distance - low) / (high - low)).clamp(0.0, 1.0);
    for number in 0..count {
        let [s, t] = net(number, 0);
        let [x, y] = [a0 + (a1 - a0) * s, b0 + (b1 - b0) * t].map(f64::tan);
        let square = 1.0 + x * x + y * y;
        let d = DVec3::new(x, y, 1.0) / square.sqrt();
        let solid = (1.0 + x * x) * (1.0 + y * y) / (square * square.sqrt());
        let counts = (a1 - a0) * (b1 - b0) / f64::from(count) * solid * view.normal.dot(d).max(0.0);
        visit(d, counts, [share(x, view.x), share(y, view.y)]);
    }
}

/// Computes the approximate illuminance of a sensor by the outside through an aperture without any glazing, by degrees
/// of the angle of incidence θ. \[lx\]
pub fn by_degrees(view: &View, facing: &Facing<'_>) -> [f64; 90] {
    let rules = vec![gauss_legendre(NODES); 3];
    let mut light = [0.0; 90];
    let [low, high] = view.y;
    let level = if facing.surface == Surface::Facade { 0.0_f64.clamp(low, high) } else { high };
    for band in [[low, level], [level, high]] {
        nodes(view, band, &rules, |d, weight| {
            let degree = (d.z.min(1.0).acos().to_degrees() as usize).min(89);
            light[degree] += weight * facing.luminance(Dir::from_unit(d));
        });
    }
    light
}

/// Number of nodes of [`by_degrees`] along a side of an aperture, or of its part above or below the horizon. Chosen:
/// cost; affects the uncertainty due to data only.
const NODES: usize = 12;

/// Region in azimuth and altitude that a convex plane polygon covers as seen from the origin.
struct Region<'a> {
    polygon: &'a [DVec3],
    surface: Surface,
    /// Azimuths at which the limits of the altitude have kinks. \[rad\]
    azimuths: Vec<f64>,
    /// Altitudes at which the luminance is not smooth or discontinuous, with the ends. \[rad\]
    altitudes: Vec<f64>,
}

impl<'a> Region<'a> {
    /// Creates the region with the azimuths and altitudes at which integration is divided. `polygon`: corners as
    /// vectors from the sensor; `skyline`: altitude of a uniform skyline. \[rad\]
    fn new(polygon: &'a [DVec3], surface: Surface, sun: Option<DVec3>, skyline: f64) -> Self {
        let azimuth = |v: DVec3| v.y.atan2(v.x);
        let mut altitudes = vec![-0.5 * PI, 0.0, 0.5 * PI];
        if skyline > 0.0 {
            altitudes.push(skyline);
        }
        let mut inner: Vec<f64> =
            polygon.iter().filter(|v| v.truncate() != glam::DVec2::ZERO).map(|&v| azimuth(v)).collect();
        let contains_zenith = surface == Surface::Roof && {
            let inside = |i: usize| {
                let (p, q) = (polygon[i].truncate(), polygon[(i + 1) % polygon.len()].truncate());
                (q - p).perp_dot(-p)
            };
            (0..polygon.len()).all(|i| inside(i) < 0.0) || (0..polygon.len()).all(|i| inside(i) > 0.0)
        };
        // Count azimuths from a direction that the region does not straddle.
        let (mut low, mut high) = (-PI, PI);
        if !contains_zenith {
            let centre = polygon.iter().sum::<DVec3>();
            let reference = azimuth(centre);
            for a in &mut inner {
                *a = near(*a, reference);
            }
            low = inner.iter().copied().fold(f64::INFINITY, f64::min);
            high = inner.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        }
        let middle = 0.5 * (low + high);
        if let Some(sun) = sun {
            altitudes.push(sun.z.clamp(-1.0, 1.0).asin());
            inner.push(near(azimuth(sun), middle));
        }
        // For a sensor close to a façade the altitude of an edge drops from the zenith to the horizon within a small
        // range of azimuth near the façade's plane: tan h = z cos(turn)/d. Knots on both sides of that drop keep the
        // pieces smooth.
        if surface == Surface::Facade {
            let outward = azimuth(DVec3::NEG_Y);
            for vertex in polygon {
                for factor in [0.4, 1.5] {
                    let cosine = factor * (vertex.y / vertex.z).abs();
                    if cosine < 0.7 {
                        inner.extend([1.0, -1.0].map(|side| near(outward + side * cosine.acos(), middle)));
                    }
                }
            }
        }
        // Azimuths at which edges of constant height cross the skyline or the sun's altitude: the limits change there.
        for i in 0..polygon.len() {
            let (p, q) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            if (p.z < 0.0) != (q.z < 0.0) {
                inner.push(near(azimuth(p + (q - p) * (p.z / (p.z - q.z))), middle));
            }
            for &altitude in altitudes.iter().filter(|h| h.abs() < 1.5 && **h != 0.0) {
                for t in crossings(p, q, altitude.tan()) {
                    inner.push(near(azimuth(p + (q - p) * t), middle));
                }
            }
        }
        inner.retain(|a| *a > low && *a < high);
        inner.extend([low, high]);
        if contains_zenith {
            inner.extend([-0.5 * PI, 0.0, 0.5 * PI]);
        }
        inner.sort_unstable_by(f64::total_cmp);
        altitudes.sort_unstable_by(f64::total_cmp);
        Self { polygon, surface, azimuths: inner, altitudes }
    }

    /// Returns the lowest and highest altitude of the polygon in a vertical half plane. \[rad\]
    fn limits(&self, azimuth: f64) -> Option<(f64, f64)> {
        let (sin, cos) = azimuth.sin_cos();
        // Signed distance from the vertical plane; the half plane is where `along` is positive.
        let across = |v: DVec3| v.y * cos - v.x * sin;
        let along = |v: DVec3| v.x * cos + v.y * sin;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut seen = 0;
        for i in 0..self.polygon.len() {
            let (p, q) = (self.polygon[i], self.polygon[(i + 1) % self.polygon.len()]);
            let (a, b) = (across(p), across(q));
            if (a <= 0.0) == (b <= 0.0) {
                continue;
            }
            let point = p + (q - p) * (a / (a - b));
            let r = along(point);
            let altitude = point.z.atan2(r);
            if r >= 0.0 {
                low = low.min(altitude);
                high = high.max(altitude);
                seen += 1;
            }
        }
        // An opening in a roof that contains the zenith has one limit: the region lies between its border and the
        // zenith.
        if seen == 1 && self.surface == Surface::Roof {
            high = 0.5 * PI;
        }
        (seen > 0 && high > low).then_some((low, high))
    }

    /// Calls `visit` with the azimuth \[rad\], the altitude \[rad\] and the weight \[rad²\] of the Gauss points of
    /// every piece above an altitude.
    fn nodes(&self, from: f64, parts: usize, mut visit: impl FnMut(f64, f64, f64)) {
        let rules: Vec<_> = (0..=parts + 7).map(gauss_legendre).collect();
        let rule = |width: f64| &rules[parts + ((width / 0.25) as usize).min(7)];
        for pair in self.azimuths.windows(2).filter(|pair| pair[1] - pair[0] > 1e-14) {
            for &(s, ws) in rule(pair[1] - pair[0]) {
                let azimuth = pair[0] + (pair[1] - pair[0]) * s;
                let Some((low, high)) = self.limits(azimuth) else { continue };
                for band in self.altitudes.windows(2).filter(|band| band[0] >= from - 1e-12 && band[0] >= -1e-12) {
                    let (a, b) = (low.clamp(band[0], band[1]), high.clamp(band[0], band[1]));
                    if b - a < 1e-14 {
                        continue;
                    }
                    for &(t, wt) in rule(b - a) {
                        visit(azimuth, a + (b - a) * t, ws * wt * (pair[1] - pair[0]) * (b - a));
                    }
                }
            }
        }
    }

    /// Computes the integral over the region of `integrand`, a function of (sine, cosine) of the azimuth and of the
    /// altitude \[rad\].
    fn integrate(&self, integrand: impl Fn((f64, f64), f64) -> f64, tolerance: Tolerance) -> Estimate {
        // Pieces lie on a strip: x runs through the azimuth intervals one after the other, y through the bands of
        // altitude; the band's own limits are clamped to the polygon's.
        let bands = self.altitudes.len() - 1;
        let intervals = self.azimuths.len() - 1;
        let mut pieces = Vec::with_capacity(bands * intervals);
        for i in 0..intervals {
            let (a, b) = (self.azimuths[i], self.azimuths[i + 1]);
            if b - a < 1e-14 {
                continue;
            }
            for k in 0..bands {
                let (from, to) = (self.altitudes[k], self.altitudes[k + 1]);
                if to - from < 1e-14 {
                    continue;
                }
                let touched = [0.02, 0.5, 0.98]
                    .iter()
                    .any(|t| self.limits(a + (b - a) * t).is_some_and(|(low, high)| high > from && low < to));
                if touched {
                    pieces.push(Rectangle { x: (i as f64, (i + 1) as f64), y: (k as f64, (k + 1) as f64) });
                }
            }
        }
        // The rules ask for several altitudes in each azimuth: quantities of the azimuth are kept from one to the next.
        let mut meridian = Meridian { x: f64::NAN, limits: None, sin_cos: (0.0, 1.0), width: 0.0 };
        integrate_smooth_rectangles(
            |x, y| {
                if x != meridian.x {
                    let i = (x as usize).min(intervals - 1);
                    let (a, b) = (self.azimuths[i], self.azimuths[i + 1]);
                    let azimuth = a + (b - a) * (x - i as f64);
                    let (limits, sin_cos) = (self.limits(azimuth), azimuth.sin_cos());
                    meridian = Meridian { x, limits, sin_cos, width: b - a };
                }
                let Some((low, high)) = meridian.limits else {
                    return 0.0;
                };
                let k = (y as usize).min(bands - 1);
                let from = low.clamp(self.altitudes[k], self.altitudes[k + 1]);
                let to = high.clamp(self.altitudes[k], self.altitudes[k + 1]);
                let altitude = from + (to - from) * (y - k as f64);
                if to <= from { 0.0 } else { integrand(meridian.sin_cos, altitude) * (to - from) * meridian.width }
            },
            &pieces,
            tolerance,
        )
    }
}

/// Quantities that all altitudes of one azimuth share.
struct Meridian {
    /// Coordinate of the azimuth on the strip of pieces.
    x: f64,
    /// Lowest and highest altitude of the region. \[rad\]
    limits: Option<(f64, f64)>,
    /// Sine and cosine of the azimuth.
    sin_cos: (f64, f64),
    /// Width of the interval of azimuths. \[rad\]
    width: f64,
}

/// Returns an azimuth shifted by full turns to be nearest to the reference. \[rad\]
fn near(azimuth: f64, reference: f64) -> f64 {
    azimuth - 2.0 * PI * ((azimuth - reference) / (2.0 * PI)).round()
}

/// Returns the parameters 0 < t < 1 at which the segment p…q crosses the cone z = slope · horizontal distance.
fn crossings(p: DVec3, q: DVec3, slope: f64) -> impl Iterator<Item = f64> {
    let d = q - p;
    let s2 = slope * slope;
    let a = d.z * d.z - s2 * (d.x * d.x + d.y * d.y);
    let b = 2.0 * (p.z * d.z - s2 * (p.x * d.x + p.y * d.y));
    let c = p.z * p.z - s2 * (p.x * p.x + p.y * p.y);
    let discriminant = b * b - 4.0 * a * c;
    let root = discriminant.max(0.0).sqrt();
    let roots =
        if discriminant < 0.0 || a == 0.0 { [f64::NAN; 2] } else { [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)] };
    roots.into_iter().filter(|t| *t > 0.0 && *t < 1.0)
}
