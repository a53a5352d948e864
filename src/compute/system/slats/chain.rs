//! Chains of mirror reflections: a ray is traced from reflection to reflection until it leaves the slats or becomes too
//! weak.

use super::arc::Point;
use super::outline::{Facet, SlatSection};
use super::sweep::Met;
use crate::compute::sequence::{mix, recurrence, unit};
use std::f64::consts::PI;

/// Share of its initial weight below which a ray is no longer traced. Chosen: cost; the light that is lost by this
/// shows in the energy balance, which is part of the stated error over cells.
const FAINT: f64 = 1e-6;
/// Number of reflections after which a ray is no longer traced: between perfect mirrors that nearly touch it may never
/// leave. Chosen: cost; only mirrors above 0.997 reach it before [`FAINT`] (0.997⁵⁰⁰⁰ ≈ 3e-7).
const MOST: usize = 5000;
/// Distance from a strip beyond which a ray has left it. \[pitches\] Above the rounding of f64 at eight pitches, the
/// most that mirror slats may span: 8 · 2⁻⁵² ≈ 2e-15 per operation.
const OFF: f64 = 1e-10;

/// Ray in the section of slats that has just reached a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    /// Point that the ray has reached (outward, upward), relative to the origin of the slat that it has met.
    /// \[pitches\]
    pub(super) point: Point,
    /// Unit vector of the ray's travel in the section (outward, upward).
    pub(super) direction: Point,
    /// Strip, slat and face that the ray has reached.
    pub(super) met: Met,
}

/// Ray that leaves the slats after its reflections.
#[derive(Debug, Clone, Copy)]
pub(super) struct Exit {
    /// Unit vector of the ray's travel in the section (outward, upward).
    pub(super) direction: Point,
    /// Weight of the ray: product of the specular reflectances that it has met.
    pub(super) weight: f64,
    /// Sum of the squared spreads σ² of the mirrors that the ray has met. \[rad²\]
    pub(super) variance: f64,
}

/// Sequence of equidistributed numbers for the random steps of rays, with a separate start for every bundle of rays.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sequence {
    /// Number of rays drawn so far.
    ray: u64,
    /// Number of reflections of the current ray so far.
    depth: usize,
    start: u64,
}

/// Primes whose square roots, a pair for every reflection, make the rays' numbers equidistributed: the roots of
/// different primes are linearly independent over the rational numbers, as [`recurrence`] needs. Chosen: the first
/// sixteen, for eight reflections; later ones use hashed numbers.
const PRIMES: [u32; 16] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];

impl Sequence {
    /// Creates the sequence of a seed, started at ray number `stream`: the numbers of a node continue those of its
    /// neighbour, so that sums over nodes are equidistributed, too.
    pub(super) fn new(seed: u64, stream: u64) -> Self {
        Self { ray: stream * 1000, depth: 0, start: mix(seed) }
    }

    /// Begins the next ray.
    pub(super) fn next_ray(&mut self) {
        (self.ray, self.depth) = (self.ray + 1, 0);
    }

    /// Returns two equidistributed numbers between 0 and 1 for the next reflection of the current ray.
    fn pair(&mut self) -> [f64; 2] {
        let first = 2 * self.depth;
        self.depth += 1;
        [first, first + 1].map(|k| {
            let shift = mix(self.start ^ (k as u64).wrapping_mul(0xBF58_476D_1CE4_E5B9));
            match PRIMES.get(k) {
                Some(prime) => recurrence(unit(shift), self.ray as f64, f64::from(*prime).sqrt()),
                // After that many reflections any number will do.
                None => unit(mix(shift ^ self.ray)),
            }
        })
    }
}

/// Arrival of a ray at a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Landing {
    /// Index of the facet (straight run or arc of strips) that the ray reaches.
    pub(super) facet: usize,
    /// Whether the ray arrives from the right side of the facet.
    pub(super) right: bool,
    /// Position along the facet at which the ray arrives, as a share of its length.
    pub(super) share: f64,
    /// Weight of the ray when it arrives.
    pub(super) weight: f64,
}

/// Path of a ray after its first reflection by a mirror, with weights relative to the light of the ray on that mirror.
#[derive(Debug, Clone, Default)]
pub(super) struct Trace {
    /// Arrivals at faces, in the order in which the ray meets them.
    pub(super) hits: Vec<Landing>,
    /// Exit of the ray, if it leaves the slats.
    pub(super) exit: Option<Exit>,
    /// Hash of the slats and sides that the ray has met: rays of a bundle that take the same path have the same hash.
    pub(super) way: u64,
}

/// Weight of a ray down to which its reflections count in the hash of its path. Chosen: cost; at most this share of a
/// bundle is not cut where paths differ.
const MIN_HASHED_WEIGHT: f64 = 1e-3;

impl SlatSection {
    /// Traces the specularly reflected part of a ray of weight 1 and stores its path in `trace`.
    pub(super) fn follow(&self, mut ray: Ray, sequence: &mut Sequence, trace: &mut Trace) {
        sequence.next_ray();
        trace.hits.clear();
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
            if weight > MIN_HASHED_WEIGHT {
                trace.way = trace.way.wrapping_mul(0x0100_0000_01B3).wrapping_add(place);
            }
            match met {
                None => {
                    trace.exit = Some(Exit { direction: ray.direction, weight, variance });
                    return;
                }
                Some((point, met, landing, _)) => {
                    trace.hits.push(Landing { weight, ..landing });
                    (ray.point, ray.met) = (point, met);
                }
            }
        }
    }

    /// Returns the direction of a ray after reflection by the mirror that it has reached (outward, upward). For a rough
    /// mirror with spread σ, the sine u of the ideal direction's angle to the normal is changed by a random step on the
    /// unit sphere on which u is the height (see the parent module's head).
    fn mirrored(&self, ray: &Ray, spread: f64, sequence: &mut Sequence) -> Point {
        let strip = &self.strips[ray.met.strip];
        let d = ray.direction;
        let facet = &self.facets[self.facet_of[ray.met.strip]];
        let left = facet.circle.as_ref().map_or(facet.left, |circle| circle.normal(ray.point));
        // Towards the ray.
        let side = if strip.faces[0] == Some(ray.met.face) { 1.0 } else { -1.0 };
        let n = left.map(|x| side * x);
        let across = d[0] * n[0] + d[1] * n[1];
        // A chord's ray may pass the arc: it then continues along it.
        let mut out = if across < 0.0 { [d[0] - 2.0 * across * n[0], d[1] - 2.0 * across * n[1]] } else { d };
        if spread > 0.0 {
            let along = [-n[1], n[0]];
            let u = (out[0] * along[0] + out[1] * along[1]).clamp(-1.0, 1.0);
            let [r, s] = sequence.pair();
            let (sin, cos) = (spread * (-2.0 * (1.0 - r).ln()).sqrt()).sin_cos();
            let u = (u * cos + (1.0 - u * u).sqrt() * sin * (2.0 * PI * s).cos()).clamp(-1.0, 1.0);
            let off = (1.0 - u * u).sqrt();
            out = [u * along[0] + off * n[0], u * along[1] + off * n[1]];
        }
        let size = (out[0] * out[0] + out[1] * out[1]).sqrt().max(f64::MIN_POSITIVE);
        out.map(|x| x / size)
    }

    /// Returns the first strip that the ray from `point` of the slat at the origin in direction `d` meets: the point
    /// relative to the slat that is met, the strip, the arrival, and the number of that slat (in pitches above the
    /// origin).
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
                    let itself = copy == 0 && (facet.first..facet.first + facet.ends.len()).contains(&own);
                    facet.hits(p, d, itself, |distance, share, right| {
                        let seen = distance > OFF && distance < best.0 - OFF;
                        if seen && self.strips[facet.first].faces[usize::from(right)].is_some() {
                            best = (distance, Some((index, copy, share, right)));
                        }
                    });
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

    /// Distributes light that is uniform between two positions along a facet (`from`, `to`, as shares of its length)
    /// over the facet's faces: calls `put(face, share of the light)`.
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

impl Facet {
    /// Calls `hit(distance along the ray, position as a share of the facet's length, whether from the right)` wherever
    /// the ray from `p` in direction `d` meets the facet. `itself`: the ray starts on this facet.
    fn hits(&self, p: Point, d: Point, itself: bool, mut hit: impl FnMut(f64, f64, bool)) {
        if let Some(circle) = &self.circle {
            for distance in circle.meets(p, d).into_iter().flatten() {
                // Where the ray comes from is one of the two.
                if distance <= 0.0 || (itself && distance < 1e-9) {
                    continue;
                }
                let n = circle.normal([p[0] + distance * d[0], p[1] + distance * d[1]]);
                let share = circle.share(n);
                if (0.0..=1.0).contains(&share) {
                    hit(distance, share, d[0] * n[0] + d[1] * n[1] > 0.0);
                }
            }
            return;
        }
        let e = [self.b[0] - self.a[0], self.b[1] - self.a[1]];
        let across = e[0] * d[1] - e[1] * d[0];
        let w = [p[0] - self.a[0], p[1] - self.a[1]];
        let share = w[0] * d[1] - w[1] * d[0];
        // From it, along it, or past its ends.
        if itself || across == 0.0 || share * across < 0.0 || share.abs() > across.abs() {
            return;
        }
        // Left of the way lies [−e₁, e₀]; a ray that comes from there has d · left < 0.
        hit((w[0] * e[1] - w[1] * e[0]) / across, share / across, across > 0.0);
    }
}
