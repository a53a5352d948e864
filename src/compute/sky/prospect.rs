//! View from a point on sky and ground past obstructions, for integrals of the luminance.
//!
//! Directions are swept along the meridians of a frame (half planes through its pole, at whose edge the point lies). A
//! meridian meets every straight edge of a box at most once, at a polar angle in closed form. Between these angles and
//! the horizon a single surface, sky or ground is visible, so that one ray identifies it, and its luminance is smooth
//! there. A skyline, and the steps of a measured sky, have such angles only along the meridians of the dome: regions of
//! other frames are swept by the bearing then (`on_dome`).

use super::outside::Outside;
use super::patches::ROW_HEIGHT;
use super::region::{Cap, Frame, Meridian, Region, Weight};
use crate::compute::surroundings::solid::Solid;
use crate::compute::surroundings::{Shown, Surroundings};
use crate::compute::sweep::{rule, rule_over, sweep};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// View of sky, ground and obstructions from one point.
pub(super) struct Prospect<'a> {
    /// Sky, ground and uniform skyline, without obstructions.
    pub open: &'a Outside,
    pub surroundings: &'a Surroundings,
    /// Point from which the outside is seen, world frame \[m\]; with `None` only the skyline counts.
    eye: Option<DVec3>,
    edges: Vec<Edge>,
    /// Spherical cap of directions that contains each box.
    bounds: Vec<Cap>,
    /// Normals of planes through the point that bound each box as seen from there; empty where the box may lie in any
    /// direction.
    cones: Vec<Vec<DVec3>>,
    /// Direction of the peak of the sky's luminance (of the sun).
    pub peak: Option<DVec3>,
}

/// Straight edge of an obstruction, its ends as vectors from the viewpoint. \[m\]
struct Edge {
    ends: [DVec3; 2],
    bound: Cap,
}

/// Obstructions that may be visible in a part of the sphere.
#[derive(Default)]
pub(super) struct Near {
    /// Ends of the edges as vectors from the viewpoint. \[m\]
    pub edges: Vec<[DVec3; 2]>,
    /// Indices of the boxes.
    solids: Vec<usize>,
}

/// Meridian of a frame with the boxes that it crosses.
pub(super) struct Along {
    pub meridian: Meridian,
    /// Index of every box, and the cotangents of the polar angles between which it may be met.
    passed: Vec<(usize, [f64; 2])>,
}

/// Integrals of luminance times weight over a region, separately for obstructions and for what they hide.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Parts {
    /// Integral of the luminance of the obstructions.
    pub before: f64,
    /// Uncertainty of `before` by the luminances of the faces.
    pub uncertainty: f64,
    /// Integral of the luminance of sky and ground where obstructions hide them.
    pub behind: f64,
    /// Integral of the luminance of sky and ground over the whole region, from the same points.
    pub open: f64,
}

impl Parts {
    pub fn of([_, before, uncertainty, behind, open]: [f64; 5]) -> Self {
        Self { before, uncertainty, behind, open }
    }
}

impl<'a> Prospect<'a> {
    /// Creates the view from the point `eye` past obstructions with known luminances.
    pub fn new(open: &'a Outside, surroundings: &'a Surroundings, eye: Option<DVec3>) -> Self {
        let edges = eye.map_or_else(Vec::new, |eye| surroundings.edges_from(eye)).into_iter().map(|ends| {
            let [a, b] = ends.map(DVec3::normalize_or_zero);
            let middle = (a + b).normalize_or_zero();
            let reach = if middle == DVec3::ZERO { PI } else { 0.5 * a.angle_between(b) + 1e-6 };
            Edge { ends, bound: Cap { middle, reach } }
        });
        let bound = |eye: DVec3| surroundings.solids.iter().map(move |solid| bound(solid, eye)).collect();
        let (edges, bounds) = (edges.collect(), eye.map_or_else(Vec::new, bound));
        let cones = |eye: DVec3| surroundings.solids.iter().map(move |solid| solid.cone(eye)).collect();
        let cones = eye.map_or_else(Vec::new, cones);
        let peak = open.sun_direction().map(crate::compute::direction::Dir::vector);
        Self { open, surroundings, eye, edges, bounds, cones, peak }
    }

    /// Returns the obstructions that may be visible in a part of the sphere; `None` if there are none.
    pub fn near(&self, part: &Cap) -> Option<Near> {
        let rises = self.surroundings.skyline.as_ref().is_some_and(|skyline| {
            let altitude = part.middle.z.clamp(-1.0, 1.0).asin();
            altitude + part.reach > 0.0 && altitude - part.reach < skyline.highest()
        });
        let solids: Vec<usize> = (0..self.bounds.len()).filter(|index| self.bounds[*index].touches(part)).collect();
        let below = self.eye.is_some()
            && self.surroundings.ground.is_some()
            && part.middle.z.clamp(-1.0, 1.0).asin() - part.reach < 0.0;
        if solids.is_empty() && !rises && !below {
            return None;
        }
        let edges = self.edges.iter().filter(|edge| edge.bound.touches(part)).map(|edge| edge.ends).collect();
        Some(Near { edges, solids })
    }

    /// Returns a meridian with the boxes that it crosses.
    pub fn along(&self, near: &Near, meridian: Meridian) -> Along {
        let passed = near.solids.iter().filter_map(|&solid| {
            let mut between = [f64::NEG_INFINITY, f64::INFINITY];
            for normal in &self.cones[solid] {
                // In front of the plane: across sin θ + up cos θ > 0.
                let (across, up) = (normal.dot(meridian.along), normal.dot(meridian.pole));
                let at = -across / up;
                if up > 0.0 {
                    between[0] = between[0].max(at);
                } else if up < 0.0 {
                    between[1] = between[1].min(at);
                } else if across <= 0.0 {
                    return None;
                }
            }
            (between[0] < between[1]).then_some((solid, between))
        });
        Along { meridian, passed: passed.collect() }
    }

    /// Returns the surface of an obstruction that is visible in a direction of a meridian, for evaluation in
    /// neighbouring directions that meet the same surface; `None` for sky or unobstructed ground.
    pub fn met(&self, Along { meridian, passed }: &Along, direction: DVec3) -> Option<Shown<'_>> {
        let at = direction.dot(meridian.pole) / direction.dot(meridian.along);
        let solids = passed.iter().filter(|(_, [low, high])| at > *low && at < *high).map(|(solid, _)| *solid);
        let met = self.surroundings.seen_among(solids, self.eye, direction)?;
        Some(self.surroundings.shown(met, self.eye))
    }

    /// Returns the luminance of sky or ground in a direction, without obstructions. \[cd/m²\]
    pub fn open_luminance(&self, direction: DVec3) -> f64 {
        self.open.luminance(crate::compute::direction::Dir::from_unit(direction))
    }

    /// Writes the polar angles within a range at which a meridian meets an edge, the horizon or the uniform skyline
    /// into `out`; rising, with the ends of the range.
    fn breaks(&self, frame: &Frame, phi: f64, range: (f64, f64), edges: &[[DVec3; 2]], out: &mut Vec<f64>) {
        out.clear();
        out.push(range.0);
        let (sin, cos) = phi.sin_cos();
        let (along, across) = (frame.x * cos + frame.y * sin, frame.y * cos - frame.x * sin);
        let mut push = |theta: f64| {
            if theta > range.0 && theta < range.1 {
                out.push(theta);
            }
        };
        for [a, b] in edges {
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
        out.push(range.1);
        out.sort_unstable_by(f64::total_cmp);
    }

    /// Writes the zenith angles at which the meridian of a bearing meets edges, the horizon, skylines, the rows of a
    /// measured sky and the altitude of the sky's peak into `out`, with those of `more`; rising from 0 to π.
    pub fn breaks_at_bearing(&self, bearing: f64, edges: &[[DVec3; 2]], more: &[f64], out: &mut Vec<f64>) {
        self.breaks(&Frame::DOME, bearing, (0.0, PI), edges, out);
        out.extend(self.surroundings.skyline.iter().map(|skyline| FRAC_PI_2 - skyline.altitude(bearing)));
        if self.open.is_piecewise_constant() {
            out.extend((1..8).map(|row| FRAC_PI_2 - f64::from(row) * ROW_HEIGHT));
        }
        out.extend(self.peak.map(|peak| Frame::DOME.angles(peak).0));
        out.extend(more.iter().copied().filter(|theta| *theta > 0.0 && *theta < PI));
        out.sort_unstable_by(f64::total_cmp);
    }

    /// Returns a frame whose pole lies in the plane of `frame`: the axis of the plane about which edges in front of it
    /// span the smallest sum of angles. Its meridians run along most edges and cross few; those in front of the plane
    /// have φ from 0 to π.
    pub fn frame_along_edges(&self, frame: &Frame) -> Frame {
        let axes = [
            Frame { x: frame.y, y: frame.z, z: frame.x },
            // Left-handed, so that φ = 90° is the normal here, too.
            Frame { x: frame.x, y: frame.z, z: frame.y },
        ];
        let turns = axes.map(|axes| {
            let turn = |edge: &Edge| {
                let [a, b] = edge.ends.map(|end| axes.angles(end).1);
                if a > 0.0 || b > 0.0 { (a.clamp(0.0, PI) - b.clamp(0.0, PI)).abs() } else { 0.0 }
            };
            self.edges.iter().map(turn).sum::<f64>()
        });
        axes[usize::from(turns[1] < turns[0])]
    }

    /// Whether the view has borders that are simple only along bearings: a skyline by bearing, or a measured sky.
    pub fn is_of_the_dome(&self) -> bool {
        self.surroundings.skyline.is_some() || self.open.is_piecewise_constant()
    }

    /// Returns the integrals along one meridian of a region, per azimuth angle: first the change by the obstructions,
    /// which controls a sweep, then the four values of [`Parts`].
    fn line(
        &self,
        region: &Region,
        near: &Near,
        phi: f64,
        density: &impl Fn(f64, DVec3) -> f64,
        breaks: &mut Vec<f64>,
    ) -> [f64; 5] {
        self.breaks(&region.frame, phi, region.theta, &near.edges, breaks);
        if let Some(peak) = self.peak {
            let theta = region.frame.angles(peak).0;
            let at = breaks.partition_point(|other| *other < theta);
            if at > 0 && at < breaks.len() {
                breaks.insert(at, theta);
            }
        }
        let mut sum = [0.0; 5];
        let along = self.along(near, region.frame.meridian(phi));
        for pair in breaks.windows(2).filter(|pair| pair[1] - pair[0] > 1e-12) {
            self.add(&along, (pair[0], pair[1]), density, &mut sum);
        }
        sum
    }

    /// Adds the integrals between two angles along a meridian, between which a single surface, sky or ground is
    /// visible, to `sum`.
    pub fn add(&self, along: &Along, (from, to): (f64, f64), density: impl Fn(f64, DVec3) -> f64, sum: &mut [f64; 5]) {
        let width = to - from;
        let mut met = self.met(along, along.meridian.direction(from + 0.5 * width));
        let (mut before, mut uncertainty, mut open) = (0.0, 0.0, 0.0);
        for &(x, share) in rule_over(width) {
            let theta = from + width * x;
            let direction = along.meridian.direction(theta);
            let density = share * width * density(theta, direction);
            open += density * self.open_luminance(direction);
            if let Some(met) = &mut met {
                let [luminance, error] = met.luminance(direction);
                before += density * luminance;
                uncertainty += density * error;
            }
        }
        sum[4] += open;
        if met.is_some() {
            sum[1] += before;
            sum[2] += uncertainty;
            sum[3] += open;
            sum[0] += before - open;
        }
    }

    /// Returns the azimuths within a region at which obstructions begin or end.
    fn knots(&self, region: &Region, near: &Near) -> Vec<f64> {
        let mut inner = Vec::new();
        region.cut_knots(0.0, &mut inner);
        for end in near.edges.iter().flatten().copied().chain(self.peak) {
            let (theta, phi) = region.frame.angles(end);
            if theta > region.theta.0 && theta < region.theta.1 {
                region.push_azimuth(phi, &mut inner);
            }
        }
        // Azimuths at which an edge crosses the limits of the region in θ.
        for &[a, b] in &near.edges {
            for theta in [region.theta.0, region.theta.1] {
                for at in on_cone(a, b, region.frame.z, theta) {
                    region.push_azimuth(region.frame.angles(at).1, &mut inner);
                }
            }
        }
        region.sorted(inner)
    }

    /// Computes the integrals over a region by a sweep over meridians of its frame, with the error of the cubature;
    /// `None` if no obstruction hides sky or ground there.
    pub fn over(&self, region: &Region, weight: Weight, relative: f64, absolute: f64) -> Option<(Parts, f64)> {
        self.over_by(region, &|theta, _| weight.density(theta), relative, absolute)
    }

    /// Computes the integrals of [`Self::over`] for any weight `density`, a function of θ and direction, per θ and φ.
    pub fn over_by(
        &self,
        region: &Region,
        density: &impl Fn(f64, DVec3) -> f64,
        relative: f64,
        absolute: f64,
    ) -> Option<(Parts, f64)> {
        let near = self.near(&region.cap())?;
        let (theta, high, wide) =
            (0.5 * (region.theta.0 + region.theta.1), region.theta.1 - region.theta.0, region.phi.1 - region.phi.0);
        let knots = self.knots(region, &near);
        let mut breaks = Vec::with_capacity(16);
        if wide * theta.sin() > LARGE || high > LARGE {
            let (sums, error) =
                sweep(|phi| self.line(region, &near, phi, density, &mut breaks), &knots, relative, absolute);
            return Some((Parts::of(sums), error));
        }
        let mut sums = [0.0; 5];
        for pair in knots.windows(2) {
            let points = 3 + (2.0 * (pair[1] - pair[0]) * theta.sin() / LARGE) as usize;
            for &(x, share) in rule(points) {
                let line = self.line(region, &near, pair[0] + (pair[1] - pair[0]) * x, density, &mut breaks);
                sums.iter_mut().zip(line).for_each(|(sum, part)| *sum += share * (pair[1] - pair[0]) * part);
            }
        }
        let parts = Parts::of(sums);
        (parts.behind > 0.0 || parts.before > 0.0).then_some((parts, SMALL_ERROR * (parts.before - parts.behind).abs()))
    }
}

/// Angular width above which regions are integrated adaptively. \[rad\] Chosen: cost; of the patches of the full Klems
/// basis only those at grazing incidence are wider. Results change within [`SMALL_ERROR`].
const LARGE: f64 = 0.5;
/// Error by the fixed points in smaller regions, relative to the change by the obstructions. Chosen: twice the accuracy
/// of adaptive cells, `PAST` of `incident`; part of the errors that
/// `tests/scenes/year_moments.rs::light_behind_boxes_is_that_of_the_moment` compares.
const SMALL_ERROR: f64 = 1e-3;

/// Returns the spherical cap of directions that contains a box as seen from a point.
fn bound(solid: &Solid, eye: DVec3) -> Cap {
    let to = solid.middle() - eye;
    let (distance, radius) = (to.length(), solid.radius());
    if distance <= radius {
        return Cap { middle: DVec3::Z, reach: PI };
    }
    Cap { middle: to / distance, reach: (radius / distance).asin() }
}

/// Returns the points p of the segment from `a` to `b` whose angle to an axis z is `theta`: (p·z)² = cos²θ |p|².
pub(super) fn on_cone(a: DVec3, b: DVec3, axis: DVec3, theta: f64) -> impl Iterator<Item = DVec3> {
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
