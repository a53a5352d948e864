//! Light that mirrors throw on: a ray from reflection to reflection until it leaves the slats or has died.

use super::outline::{Point, Section, between, left_of};
use super::sweep::Met;
use std::f64::consts::PI;

/// Rays weaker than this share of their start are given up.
const FAINT: f64 = 1e-7;
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
    /// What it carries.
    pub(super) weight: f64,
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

impl Section {
    /// Follows the mirrored part of a ray. `landed` gets every later face with what comes to it; the return value is
    /// what leaves.
    pub(super) fn follow(
        &self,
        mut ray: Ray,
        sequence: &mut Sequence,
        mut landed: impl FnMut(usize, f64),
    ) -> Option<Exit> {
        let faint = FAINT * ray.weight;
        let mut variance = 0.0;
        for _ in 0..MOST {
            let surface = self.faces[ray.met.face].surface;
            ray.weight *= surface.mirror;
            if ray.weight <= faint {
                return None;
            }
            variance += surface.spread * surface.spread;
            ray.direction = self.mirrored(&ray, surface.spread, sequence);
            match self.next(ray.point, ray.direction, ray.met.strip) {
                None => return Some(Exit { direction: ray.direction, weight: ray.weight, variance }),
                Some((point, met)) => {
                    landed(met.face, ray.weight);
                    (ray.point, ray.met) = (point, met);
                }
            }
        }
        None
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
        let (e, w) = ([strip.b[0] - strip.a[0], strip.b[1] - strip.a[1]], [
            ray.point[0] - strip.a[0],
            ray.point[1] - strip.a[1],
        ]);
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

    /// The first strip that a ray from a point of the slat at the origin meets, and where, in the frame of the slat
    /// met.
    fn next(&self, point: Point, d: Point, own: usize) -> Option<(Point, Met)> {
        let mut best = (f64::INFINITY, None);
        for step in -self.reach..=self.reach {
            // Of sheets that lie in one another the lower is the inner one, as in the sweep.
            let copy = if d[0] >= 0.0 { step } else { -step };
            let p = [point[0], point[1] - f64::from(copy)];
            for (index, strip) in self.strips.iter().enumerate() {
                if copy == 0 && index == own {
                    continue;
                }
                let e = [strip.b[0] - strip.a[0], strip.b[1] - strip.a[1]];
                let across = e[0] * d[1] - e[1] * d[0];
                let w = [p[0] - strip.a[0], p[1] - strip.a[1]];
                let share = w[0] * d[1] - w[1] * d[0];
                // Outside the strip, or along it.
                if across == 0.0 || share * across < 0.0 || share.abs() > across.abs() {
                    continue;
                }
                let distance = (w[0] * e[1] - w[1] * e[0]) / across;
                // Left of the way lies [-e₁, e₀]; a ray that comes from there has d · left < 0.
                let face = strip.faces[usize::from(across > 0.0)];
                if distance > OFF && distance < best.0 - OFF {
                    if let Some(face) = face {
                        best = (distance, Some(Met { strip: index, copy, face }));
                    }
                }
            }
        }
        let (distance, met) = best;
        met.map(|met| {
            let at = [point[0] + distance * d[0], point[1] + distance * d[1] - f64::from(met.copy)];
            (at, Met { copy: 0, ..met })
        })
    }
}
