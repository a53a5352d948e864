//! What is seen from a point past what stands around it.
//!
//! Along a meridian of any frame (a half plane through its pole) every straight edge is met at most once, at a polar
//! angle in closed form. Between the edges, the horizon and the skyline one thing alone is seen, so that one ray tells
//! what it is, and its light is smooth there.

use super::outside::Outside;
use super::region::{Frame, Region, Weight};
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::Solid;
use crate::compute::surroundings::{Seen, Surroundings, first_hit};
use crate::compute::sweep::{rule, sweep};
use glam::DVec3;
use std::f64::consts::PI;

/// What stands before sky and ground, and how bright it is.
enum Foreground<'a> {
    /// Boxes with their light, from a point; without one the skyline alone.
    Lit(&'a Surroundings, Option<DVec3>),
    /// Black boxes: for light on faces.
    Black(Vec<&'a Solid>, DVec3),
}

/// What a direction meets before sky and ground.
#[derive(Clone, Copy)]
pub(super) enum Met {
    Black,
    Seen(Seen),
}

/// The outside from one point.
pub(super) struct Prospect<'a> {
    /// Sky, ground and flat skyline, without what stands before them.
    open: &'a Outside,
    foreground: Foreground<'a>,
    skyline: Option<&'a Skyline>,
    /// Edges as vectors from the point.
    edges: Vec<[DVec3; 2]>,
    /// Middle and radius of what may be seen of every box. \[rad\]
    bounds: Vec<(DVec3, f64)>,
    /// Where the sky's luminance has its peak.
    peak: Option<DVec3>,
}

/// ∫ of luminance times weight over parts of a region.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Parts {
    /// What stands before sky and ground.
    pub before: f64,
    /// How far that may be off for the light on faces.
    pub doubt: f64,
    /// Sky and ground where something stands before them.
    pub behind: f64,
    /// Sky and ground of the whole region, by the same points.
    pub open: f64,
}

impl Parts {
    fn of([_, before, doubt, behind, open]: [f64; 5]) -> Self {
        Self { before, doubt, behind, open }
    }
}

/// A step along the skyline between tries whether it was crossed. \[rad\]
const SKYLINE_STEP: f64 = 6.0 * PI / 180.0;

impl<'a> Prospect<'a> {
    /// Past lit boxes.
    pub fn lit(open: &'a Outside, surroundings: &'a Surroundings, eye: Option<DVec3>) -> Self {
        let edges = eye.map_or_else(Vec::new, |eye| surroundings.edges_from(eye));
        let bounds = eye.map_or_else(Vec::new, |eye| bounds(surroundings.solids.iter(), eye));
        let skyline = surroundings.skyline.as_ref();
        Self { open, foreground: Foreground::Lit(surroundings, eye), skyline, edges, bounds, peak: peak(open) }
    }

    /// Past black boxes.
    pub fn black(open: &'a Outside, solids: Vec<&'a Solid>, skyline: Option<&'a Skyline>, eye: DVec3) -> Self {
        let edges = solids.iter().flat_map(|solid| solid.visible_edges(eye)).map(|edge| edge.map(|p| p - eye));
        let (edges, bounds) = (edges.collect(), bounds(solids.iter().copied(), eye));
        Self { open, foreground: Foreground::Black(solids, eye), skyline, edges, bounds, peak: peak(open) }
    }

    /// What a direction meets before sky and ground.
    pub fn met(&self, direction: DVec3) -> Option<Met> {
        match &self.foreground {
            Foreground::Lit(surroundings, eye) => surroundings.seen(*eye, direction).map(Met::Seen),
            Foreground::Black(solids, eye) => {
                if first_hit(solids.iter().map(|solid| (0, *solid)), *eye, direction).is_some() {
                    return Some(Met::Black);
                }
                self.skyline.filter(|skyline| skyline.covers(direction)).map(|_| Met::Seen(Seen::Skyline))
            }
        }
    }

    /// Luminance of what is met. \[cd/m²\]
    pub fn luminance(&self, met: Met, direction: DVec3) -> f64 {
        match (met, &self.foreground) {
            (Met::Black, _) => 0.0,
            (Met::Seen(seen), Foreground::Lit(surroundings, eye)) => surroundings.luminance(seen, *eye, direction),
            (Met::Seen(_), Foreground::Black(..)) => self.skyline.map_or(0.0, |skyline| skyline.luminance),
        }
    }

    /// How far that may be off, relative.
    pub fn doubt(&self, met: Met) -> f64 {
        match (met, &self.foreground) {
            (Met::Seen(seen), Foreground::Lit(surroundings, _)) => surroundings.doubt(seen),
            _ => 0.0,
        }
    }

    /// Luminance of sky and ground. \[cd/m²\]
    pub fn open_luminance(&self, direction: DVec3) -> f64 {
        self.open.luminance(crate::compute::direction::Dir::from_unit(direction))
    }

    /// May anything stand before sky and ground within an angle of a direction?
    fn may_meet(&self, direction: DVec3, radius: f64) -> bool {
        let near = |(middle, reach): &(DVec3, f64)| direction.dot(*middle) > (reach + radius).min(PI).cos();
        let rises = |skyline: &Skyline| {
            let altitude = direction.z.clamp(-1.0, 1.0).asin();
            altitude + radius > 0.0 && altitude - radius < skyline.highest()
        };
        self.bounds.iter().any(near) || self.skyline.is_some_and(rises)
    }

    /// Polar angles within a range at which a meridian meets an edge, the horizon or the skyline; rising, with the ends.
    pub fn breaks(&self, frame: &Frame, phi: f64, range: (f64, f64), more: &[[DVec3; 2]], out: &mut Vec<f64>) {
        out.clear();
        out.push(range.0);
        let (sin, cos) = phi.sin_cos();
        let (along, across) = (frame.x * cos + frame.y * sin, frame.y * cos - frame.x * sin);
        let mut push = |theta: f64| {
            if theta > range.0 && theta < range.1 {
                out.push(theta);
            }
        };
        for [a, b] in self.edges.iter().chain(more) {
            let (p, q) = (across.dot(*a), across.dot(*b));
            if (p > 0.0) != (q > 0.0) {
                let at = *a + (*b - *a) * (p / (p - q));
                let forward = along.dot(at);
                if forward > 0.0 {
                    push(forward.atan2(frame.z.dot(at)));
                }
            }
        }
        let horizon = (-frame.z.z).atan2(along.z);
        push(if horizon < 0.0 { horizon + PI } else { horizon });
        let level = self.open.skyline_sine;
        if level > 0.0 {
            let reach = along.z.hypot(frame.z.z);
            if reach > level {
                let (middle, half) = (along.z.atan2(frame.z.z), (level / reach).acos());
                push(middle - half);
                push(middle + half);
            }
        }
        if let Some(skyline) = self.skyline {
            let above = |theta: f64| {
                let (sin, cos) = theta.sin_cos();
                skyline.above(along * sin + frame.z * cos)
            };
            let count = ((range.1 - range.0) / SKYLINE_STEP).ceil().max(3.0) as usize;
            let step = (range.1 - range.0) / count as f64;
            let mut before = above(range.0);
            for k in 1..=count {
                let (low, high) = (range.0 + (k - 1) as f64 * step, range.0 + k as f64 * step);
                let after = above(high);
                if (before > 0.0) != (after > 0.0) {
                    push(root(&above, (low, before), (high, after)));
                }
                before = after;
            }
        }
        out.push(range.1);
        out.sort_unstable_by(f64::total_cmp);
    }

    /// Along one meridian: what a region holds, all as densities of azimuth; the first number is what steers a sweep.
    fn line(&self, region: &Region, phi: f64, weight: Weight, breaks: &mut Vec<f64>) -> [f64; 5] {
        self.breaks(&region.frame, phi, region.theta, &[], breaks);
        if let Some(peak) = self.peak {
            let theta = region.frame.angles(peak).0;
            let at = breaks.partition_point(|other| *other < theta);
            if at > 0 && at < breaks.len() {
                breaks.insert(at, theta);
            }
        }
        let mut sum = [0.0; 5];
        for pair in breaks.windows(2).filter(|pair| pair[1] - pair[0] > 1e-12) {
            let (from, width) = (pair[0], pair[1] - pair[0]);
            let met = self.met(region.frame.direction(from + 0.5 * width, phi));
            let (mut before, mut open) = (0.0, 0.0);
            for &(x, share) in rule(3 + (width / 0.15) as usize) {
                let theta = from + width * x;
                let direction = region.frame.direction(theta, phi);
                let density = share * width * weight.density(theta);
                open += density * self.open_luminance(direction);
                if let Some(met) = met {
                    before += density * self.luminance(met, direction);
                }
            }
            sum[4] += open;
            if let Some(met) = met {
                sum[1] += before;
                sum[2] += self.doubt(met) * before;
                sum[3] += open;
                sum[0] += before - open;
            }
        }
        sum
    }

    /// Azimuths within a region at which what stands before sky and ground begins or ends.
    fn knots(&self, region: &Region) -> Vec<f64> {
        let mut inner = Vec::new();
        region.cut_knots(0.0, &mut inner);
        let corners = self.skyline.into_iter().flat_map(Skyline::corners);
        for end in self.edges.iter().flatten().copied().chain(corners).chain(self.peak) {
            let (theta, phi) = region.frame.angles(end);
            if theta > region.theta.0 && theta < region.theta.1 {
                region.push_azimuth(phi, &mut inner);
            }
        }
        // Where an edge leaves the region over its inner or outer rim.
        for &[a, b] in &self.edges {
            for theta in [region.theta.0, region.theta.1] {
                for at in on_cone(a, b, region.frame.z, theta) {
                    region.push_azimuth(region.frame.angles(at).1, &mut inner);
                }
            }
        }
        region.sorted(inner)
    }

    /// What a region holds; `None` where nothing stands before sky and ground there. And the error of the cubature.
    pub fn over(&self, region: &Region, weight: Weight, relative: f64, absolute: f64) -> Option<(Parts, f64)> {
        let (theta, phi) = (0.5 * (region.theta.0 + region.theta.1), 0.5 * (region.phi.0 + region.phi.1));
        let (high, wide) = (region.theta.1 - region.theta.0, region.phi.1 - region.phi.0);
        if !self
            .may_meet(region.frame.direction(theta, phi), 0.5 * (high + wide * region.theta.1.sin().max(0.0)) + 1e-6)
        {
            return None;
        }
        let knots = self.knots(region);
        let mut breaks = Vec::with_capacity(16);
        if wide * theta.sin() > LARGE || high > LARGE {
            let (sums, error) = sweep(|phi| self.line(region, phi, weight, &mut breaks), &knots, relative, absolute);
            return Some((Parts::of(sums), error));
        }
        let mut sums = [0.0; 5];
        for pair in knots.windows(2) {
            let points = 3 + (2.0 * (pair[1] - pair[0]) * theta.sin() / LARGE) as usize;
            for &(x, share) in rule(points) {
                let line = self.line(region, pair[0] + (pair[1] - pair[0]) * x, weight, &mut breaks);
                sums.iter_mut().zip(line).for_each(|(sum, part)| *sum += share * (pair[1] - pair[0]) * part);
            }
        }
        let parts = Parts::of(sums);
        (parts.behind > 0.0 || parts.before > 0.0).then_some((parts, SMALL_ERROR * (parts.before - parts.behind).abs()))
    }
}

/// Regions wider than this are integrated adaptively. \[rad\]
const LARGE: f64 = 0.5;
/// What fixed points cost in smaller ones, relative to what is changed.
const SMALL_ERROR: f64 = 1e-3;

/// Where the sky's luminance has its peak.
fn peak(open: &Outside) -> Option<DVec3> {
    open.sun_direction().map(crate::compute::direction::Dir::vector)
}

/// Middle and radius of boxes from a point.
fn bounds<'a>(solids: impl Iterator<Item = &'a Solid>, eye: DVec3) -> Vec<(DVec3, f64)> {
    let of = |solid: &Solid| {
        let to = solid.middle() - eye;
        let (distance, radius) = (to.length(), solid.radius());
        if distance <= radius { (DVec3::Z, PI) } else { (to / distance, (radius / distance).asin()) }
    };
    solids.map(of).collect()
}

/// Where a function is zero between two places of unlike signs (regula falsi after Illinois).
fn root(f: &impl Fn(f64) -> f64, (mut a, mut fa): (f64, f64), (mut b, mut fb): (f64, f64)) -> f64 {
    for _ in 0..30 {
        let x = (a * fb - b * fa) / (fb - fa);
        let y = f(x);
        if y.abs() < 1e-12 || (b - a).abs() < 1e-12 {
            return x;
        }
        if (y > 0.0) == (fb > 0.0) {
            fa *= 0.5;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (x, y);
    }
    b
}

/// Points of a segment at which the angle to an axis has a value: (p·z)² = cos²θ |p|².
fn on_cone(a: DVec3, b: DVec3, axis: DVec3, theta: f64) -> impl Iterator<Item = DVec3> {
    let (d, cosine) = (b - a, theta.cos());
    let square = cosine * cosine;
    let (p, q) = (axis.dot(a), axis.dot(d));
    let (x, y, z) = (q * q - square * d.dot(d), p * q - square * a.dot(d), p * p - square * a.dot(a));
    let root = (y * y - x * z).max(0.0).sqrt();
    let found = if x.abs() < 1e-300 || y * y < x * z { [f64::NAN; 2] } else { [(-y - root) / x, (-y + root) / x] };
    let at = move |t: f64| a + t * d;
    let inside = move |t: &f64| *t > 0.0 && *t < 1.0 && axis.dot(at(*t)) * cosine >= 0.0;
    found.into_iter().filter(inside).map(at)
}
