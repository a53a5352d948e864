//! Light that mirrors throw on: a ray from reflection to reflection until it leaves the slats or has died.

use super::outline::{Point, Section, between, left_of};
use super::sweep::Met;
use std::f64::consts::PI;

/// Rays weaker than this share of their start are given up.
const FAINT: f64 = 1e-6;
/// Reflections after which a ray is given up: between perfect mirrors that nearly touch it may never leave.
const MOST: usize = 5000;
/// A ray has left a strip when it is farther from it. In pitches.
const OFF: f64 = 1e-10;

/// A ray that has just come to a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    /// Place, in the frame of the slat met.
    pub(super) point: Point,
    /// Unit direction of travel (outward, upward).
    pub(super) direction: Point,
    /// What it has come to.
    pub(super) met: Met,
}

/// A ray that leaves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Exit {
    /// Unit direction of travel.
    pub(super) direction: Point,
    /// What it carries.
    pub(super) weight: f64,
    /// Sum of the squared spreads of the mirrors met. \[rad²\]
    pub(super) variance: f64,
}

/// Equidistributed numbers with a start of their own for every bundle of rays.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sequence {
    at: [f64; 2],
}

impl Sequence {
    /// Number `stream` of a seed.
    pub(super) fn new(seed: u64, stream: u64) -> Self {
        // SplitMix64 of both, for a start that is unlike its neighbours'.
        let mix = |salt: u64| {
            let mut z = seed ^ stream.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ salt;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
        };
        Self { at: [mix(0x5851_F42D), mix(0x1405_7B7E)] }
    }

    /// A number of the standard normal distribution (Box and Muller on the R₂ sequence).
    fn normal(&mut self) -> f64 {
        self.at[0] = (self.at[0] + 0.754_877_666_246_692_7).fract();
        self.at[1] = (self.at[1] + 0.569_840_290_998_053_2).fract();
        (-2.0 * (1.0 - self.at[0]).ln()).sqrt() * (2.0 * PI * self.at[1]).cos()
    }
}

/// A ray comes to a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Landing {
    /// Straight run of strips.
    pub(super) facet: usize,
    /// Its second side?
    pub(super) right: bool,
    /// Share of the run at which the ray comes to it.
    pub(super) share: f64,
    /// What it still carries.
    pub(super) weight: f64,
}

/// What becomes of a ray after its first mirror, per unit of what came to it.
#[derive(Debug, Clone, Default)]
pub(super) struct Trace {
    /// What it comes to.
    pub(super) landed: Vec<Landing>,
    /// How it leaves.
    pub(super) exit: Option<Exit>,
    /// The slats and sides met, as a number: rays of a bundle with the same way have the same.
    pub(super) way: u64,
}

/// Weaker parts do not make a way another.
const TELLING: f64 = 1e-3;

impl Section {
    /// Follows the mirrored part of a ray of weight 1.
    pub(super) fn follow(&self, mut ray: Ray, sequence: &mut Sequence, trace: &mut Trace) {
        trace.landed.clear();
        (trace.exit, trace.way) = (None, 0);
        let (mut variance, mut weight) = (0.0, 1.0);
        for _ in 0..MOST {
            let surface = self.faces[ray.met.face].surface;
            weight *= surface.mirror;
            if weight <= FAINT {
                return;
            }
            variance += surface.spread * surface.spread;
            ray.direction = self.mirrored(&ray, surface.spread, sequence);
            let met = self.next(ray.point, ray.direction, ray.met.strip);
            let place = met.map_or(1 + u64::from(ray.direction[0] > 0.0), |(.., landing, copy)| {
                u64::from((copy + 128).unsigned_abs()) * 4 + 2 * u64::from(landing.right) + 7
            });
            if weight > TELLING {
                trace.way = trace.way.wrapping_mul(0x0100_0000_01B3).wrapping_add(place);
            }
            match met {
                None => {
                    trace.exit = Some(Exit { direction: ray.direction, weight, variance });
                    return;
                }
                Some((point, met, landing, _)) => {
                    trace.landed.push(Landing { weight, ..landing });
                    (ray.point, ray.met) = (point, met);
                }
            }
        }
    }

    /// Direction after the mirror that a ray has come to. A spread σ turns the mirror by σ/2 (standard deviation),
    /// which turns the ray by σ; what would go into the surface is mirrored out of it.
    fn mirrored(&self, ray: &Ray, spread: f64, sequence: &mut Sequence) -> Point {
        let strip = &self.strips[ray.met.strip];
        let d = ray.direction;
        let flat = left_of(strip.a, strip.b);
        // Looking against the ray.
        let side = if d[0] * flat[0] + d[1] * flat[1] > 0.0 { -1.0 } else { 1.0 };
        let flat = flat.map(|x| side * x);
        let (e, w) = (
            [strip.b[0] - strip.a[0], strip.b[1] - strip.a[1]],
            [ray.point[0] - strip.a[0], ray.point[1] - strip.a[1]],
        );
        let share = ((e[0] * w[0] + e[1] * w[1]) / (e[0] * e[0] + e[1] * e[1])).clamp(0.0, 1.0);
        let mut n = between(strip.normals[0], strip.normals[1], share).map(|x| side * x);
        let size = n[0].hypot(n[1]).max(f64::MIN_POSITIVE);
        n = n.map(|x| x / size);
        if spread > 0.0 {
            let (sin, cos) = (0.5 * spread * sequence.normal()).sin_cos();
            n = [n[0] * cos - n[1] * sin, n[0] * sin + n[1] * cos];
        }
        let turn = 2.0 * (d[0] * n[0] + d[1] * n[1]);
        let mut out = [d[0] - turn * n[0], d[1] - turn * n[1]];
        let off = out[0] * flat[0] + out[1] * flat[1];
        if off <= 0.0 {
            out = [out[0] - 2.0 * off * flat[0], out[1] - 2.0 * off * flat[1]];
        }
        let size = out[0].hypot(out[1]).max(f64::MIN_POSITIVE);
        out.map(|x| x / size)
    }

    /// The first strip that a ray from a point of the slat at the origin meets, where in the frame of the slat met,
    /// and which slat that is.
    fn next(&self, point: Point, d: Point, own: usize) -> Option<(Point, Met, Landing, i32)> {
        let mut best: (f64, Option<(usize, i32, f64, bool)>) = (f64::INFINITY, None);
        for step in -self.reach..=self.reach {
            // Of sheets that lie in one another the lower is the inner one, as in the sweep.
            let copy = if d[0] >= 0.0 { step } else { -step };
            let p = [point[0], point[1] - f64::from(copy)];
            for group in &self.groups {
                let to = [group.centre[0] - p[0], group.centre[1] - p[1]];
                let (ahead, beside) = (to[0] * d[0] + to[1] * d[1], to[0] * d[1] - to[1] * d[0]);
                if beside.abs() > group.radius || ahead < -group.radius || ahead - group.radius > best.0 {
                    continue;
                }
                for index in group.facets.clone() {
                    let facet = &self.facets[index];
                    if copy == 0 && (facet.first..facet.first + facet.ends.len()).contains(&own) {
                        continue;
                    }
                    let e = [facet.b[0] - facet.a[0], facet.b[1] - facet.a[1]];
                    let across = e[0] * d[1] - e[1] * d[0];
                    let w = [p[0] - facet.a[0], p[1] - facet.a[1]];
                    let share = w[0] * d[1] - w[1] * d[0];
                    // Along the facet, or past its ends.
                    if across == 0.0 || share * across < 0.0 || share.abs() > across.abs() {
                        continue;
                    }
                    let distance = (w[0] * e[1] - w[1] * e[0]) / across;
                    if distance > OFF && distance < best.0 - OFF {
                        // Left of the way lies [−e₁, e₀]; a ray that comes from there has d · left < 0.
                        let from_right = across > 0.0;
                        if self.strips[facet.first].faces[usize::from(from_right)].is_some() {
                            best = (distance, Some((index, copy, share / across, from_right)));
                        }
                    }
                }
            }
        }
        let (distance, Some((facet, copy, share, right))) = best else { return None };
        let strip = self.strip_at(facet, share);
        let face = self.strips[strip].faces[usize::from(right)]?;
        let at = [point[0] + distance * d[0], point[1] + distance * d[1] - f64::from(copy)];
        Some((at, Met { strip, copy: 0, face }, Landing { facet, right, share, weight: 1.0 }, copy))
    }

    fn strip_at(&self, facet: usize, share: f64) -> usize {
        let facet = &self.facets[facet];
        facet.first + facet.ends.partition_point(|end| *end < share).min(facet.ends.len() - 1)
    }

    /// Divides what comes to a side of a straight run between two shares of it evenly over its faces.
    pub(super) fn divide(&self, landing: &Landing, from: f64, to: f64, mut put: impl FnMut(usize, f64)) {
        let (low, high) = (from.min(to), from.max(to));
        let facet = &self.facets[landing.facet];
        let side = usize::from(landing.right);
        let first = self.strip_at(landing.facet, low) - facet.first;
        let mut start = low;
        for (k, &end) in facet.ends.iter().enumerate().skip(first) {
            let last = end >= high || k + 1 == facet.ends.len();
            let stop = if last { high } else { end };
            let part = if high > low { (stop - start) / (high - low) } else { 1.0 };
            if let Some(face) = self.strips[facet.first + k].faces[side] {
                put(face, part);
            }
            if last {
                break;
            }
            start = end;
        }
    }
}
