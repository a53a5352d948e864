//! Tilts at which slats let no direct light through.
//!
//! Shadows of neighbouring slats across a beam of profile angle ψ repeat every s cosψ; light passes between them unless
//! a slat's extent across the beam is that long: extent(β + ψ) ≥ s cosψ. The extent of flat slats and arcs depends on
//! the angle α = β + ψ between beam and chord alone and grows with it, so that the tilts to avoid are an open interval
//! about −ψ and its repetitions every 180°:
//!
//! * flat, chord w:                       extent = w sin|α|
//! * arc, radius R, half opening η:       extent = R (1 − cos(η + |α|)) for |α| ≤ η, by the point where the beam
//!   touches the arc, else w sin|α|
//!
//! Polylines and the outlines of thick slats are searched instead, with a bound on how fast extents change.

use crate::compute::system::slats::{SlatArray, SlatProfile, Venetian, arc};
use std::f64::consts::PI;

/// Vertical section of a row of equal slats, infinitely many and infinitely long.
#[derive(Debug, Clone, PartialEq)]
pub struct SlatRow {
    /// Profile of a slat at tilt 0.
    pub profile: SlatProfile,
    /// Vertical pitch of the slats. \[m\]
    pub spacing: f64,
    /// Maximum distance between two points of a slat: its extent across a beam is never larger. \[m\]
    reach: f64,
}

/// Tilts that let direct light through: those between two limits, repeated every half turn. \[rad\]
#[derive(Debug, Clone, Copy, PartialEq)]
enum Avoid {
    Nothing,
    Between(f64, f64),
    Everything,
}

/// Difference below which two angles count as equal. \[rad\] Above the rounding of sums of angles (a few 2⁻⁵² · π ≈
/// 7e-16); held by the test `spans_and_tolerances_are_kept_whole`, by which less than 1e-8 of direct light passes.
const SLACK: f64 = 1e-10;
/// Step of the search for the cut-off tilt of polyline slats: 0.25°. \[rad\] Chosen: cost; ranges of blocking tilts
/// narrower than a step may be missed, and a more closed tilt found instead.
const STEP: f64 = PI / 720.0;

impl SlatRow {
    /// Creates a row of slats from the profile of a slat and the vertical pitch `spacing` \[m\]. `None` if a length is
    /// not above 0 and finite, an arc is more than a semicircle, or a polyline has fewer than two different points.
    pub fn new(profile: SlatProfile, spacing: f64) -> Option<Self> {
        let length = |x: f64| x > 0.0 && x.is_finite();
        let sane = match &profile {
            SlatProfile::Flat { width } => length(*width),
            SlatProfile::Arc { width, rise } => length(*width) && length(rise.abs()) && rise.abs() <= 0.5 * width,
            SlatProfile::Polyline(points) => {
                points.len() >= 2
                    && points.iter().flatten().all(|x| x.is_finite())
                    && points.iter().any(|point| point != &points[0])
            }
        };
        let reach = if sane { diameter(&profile) } else { 0.0 };
        (sane && length(spacing)).then_some(Self { profile, spacing, reach })
    }

    /// Creates the row of slats of a described blind, their thickness included: a solid slat is represented by all
    /// corners of its outline, which block the same light. Returns `None` in the cases of [`new`](Self::new).
    pub fn of(blind: &Venetian) -> Option<Self> {
        let thick = (blind.thickness > 0.0)
            .then(|| {
                let sides = [blind.upper, blind.lower];
                SlatArray::new(blind.profile.clone(), blind.thickness, blind.spacing, 0.0, sides).ok()
            })
            .flatten();
        let solid = thick.and_then(|array| array.outline().into_iter().next()).map(SlatProfile::Polyline);
        Self::new(solid.unwrap_or_else(|| blind.profile.clone()), blind.spacing)
    }

    /// Returns the share, 0 … 1, of direct light with profile angle `psi` \[rad\] that passes between the slats at the
    /// given `tilt` \[rad\].
    pub fn direct_share(&self, tilt: f64, psi: f64) -> f64 {
        self.profile.open_share(tilt, self.spacing, psi)
    }

    /// Whether the slats block all direct light with profile angles between the two of `span`, at every tilt within
    /// `tolerance` of `tilt`. Angles are in \[rad\].
    pub fn blocks(&self, tilt: f64, tolerance: f64, span: [f64; 2]) -> bool {
        match self.avoid(span) {
            Some(Avoid::Nothing) => true,
            Some(Avoid::Everything) => false,
            Some(Avoid::Between(low, high)) => {
                let (low, high) = (low - tolerance, high + tolerance);
                // The half turn that brings the tilt next above the lower limit.
                let turned = low + (tilt - low).rem_euclid(PI);
                high - low < PI && (turned >= high - SLACK || turned <= low + SLACK)
            }
            None => self.blocks_by_search([tilt - tolerance, tilt + tolerance], span),
        }
    }

    /// Returns the cut-off tilt: the most open tilt within `range` (nearest to 0; of two equally open ones the
    /// positive) that blocks direct light with all profile angles between the two of `span`, even if the tilt deviates
    /// by `tolerance`. Angles are in \[rad\]. `None` if no tilt does.
    pub fn cut_off(&self, range: [f64; 2], tolerance: f64, span: [f64; 2]) -> Option<f64> {
        let start = 0.0_f64.clamp(range[0], range[1]);
        match self.avoid(span) {
            Some(Avoid::Nothing) => Some(start),
            Some(Avoid::Everything) => None,
            Some(Avoid::Between(low, high)) => {
                if self.blocks(start, tolerance, span) {
                    return Some(start);
                }
                let (low, high) = (low - tolerance, high + tolerance);
                let turns = (-3..=3).flat_map(|n| [low, high].map(|limit| limit + PI * f64::from(n)));
                turns
                    .filter(|tilt| (range[0] - SLACK..=range[1] + SLACK).contains(tilt))
                    .filter(|tilt| self.blocks(*tilt, tolerance, span))
                    .min_by(|a, b| a.abs().total_cmp(&b.abs()).then(b.total_cmp(a)))
            }
            None => self.cut_off_by_search(start, range, tolerance, span),
        }
    }

    /// Returns the tilts at which direct light of any profile angle between the two of `span` \[rad\] passes; `None`
    /// for polylines, which have no closed form.
    fn avoid(&self, span: [f64; 2]) -> Option<Avoid> {
        let s = self.spacing;
        // Least extent, the extent up to which the beam touches the arc, and the profile angle of a stationary limit.
        let (least, touched, stationary) = match self.profile {
            SlatProfile::Flat { .. } => (0.0, 0.0, None),
            SlatProfile::Arc { width, rise } => {
                let (radius, half) = arc(width, rise);
                // d/dψ (α_c + ψ) = 0 where s = 2R sin(½(η + α_c)).
                (rise.abs(), 2.0 * radius * half.sin().powi(2), Some(0.5 * s / radius))
            }
            SlatProfile::Polyline(_) => return None,
        };
        // Steeper beams meet slats that are never too narrow for them: nothing to avoid.
        let steep = (least / s).min(1.0).acos();
        let (low, high) = (span[0].max(-steep), span[1].min(steep));
        if low > high || least >= s {
            return Some(Avoid::Nothing);
        }
        let kinks = [Some(touched / s), stationary].into_iter().flatten().filter(|cosine| *cosine <= 1.0);
        let kinks = kinks.flat_map(|cosine| [-1.0, 1.0].map(|side| side * cosine.acos()));
        let at = [low, high].into_iter().chain(kinks.filter(|psi| (low..=high).contains(psi)));
        // Where slats are narrower than their pitch, the flattest beam of the span is the worst.
        let flattest = 0.0_f64.clamp(low, high);
        let mut limits = [f64::INFINITY, f64::NEG_INFINITY];
        for psi in at.chain([flattest]) {
            let Some(alpha) = self.critical(s * psi.cos()) else { return Some(Avoid::Everything) };
            limits = [limits[0].min(-alpha - psi), limits[1].max(alpha - psi)];
        }
        Some(if limits[1] - limits[0] >= PI { Avoid::Everything } else { Avoid::Between(limits[0], limits[1]) })
    }

    /// Returns the minimum angle between beam and chord \[rad\] at which a slat's extent across the beam reaches
    /// `needed` \[m\]; `None` if it never does.
    fn critical(&self, needed: f64) -> Option<f64> {
        let flat = |width: f64| (needed <= width * (1.0 + 1e-12)).then(|| (needed / width).min(1.0).asin());
        match self.profile {
            SlatProfile::Flat { width } => flat(width),
            SlatProfile::Arc { width, rise } => {
                let (radius, half) = arc(width, rise);
                if needed <= 2.0 * radius * half.sin().powi(2) {
                    Some(((1.0 - needed / radius).clamp(-1.0, 1.0).acos() - half).max(0.0))
                } else {
                    flat(width)
                }
            }
            SlatProfile::Polyline(_) => None,
        }
    }

    /// Whether the slats block direct light for all tilts between the two of `tilts` and all profile angles between the
    /// two of `span` \[rad\]. The extent of a slat and the pitch across the beam change no faster with the angles than
    /// `reach` and the pitch, so that one value bounds its neighbourhood.
    fn blocks_by_search(&self, tilts: [f64; 2], span: [f64; 2]) -> bool {
        let reach = self.reach;
        let surplus = |tilt: f64, psi: f64| self.profile.extent(tilt + psi) - self.spacing * psi.cos();
        let mut open = vec![(tilts, span)];
        while let Some(([t0, t1], [p0, p1])) = open.pop() {
            let value = surplus(0.5 * (t0 + t1), 0.5 * (p0 + p1));
            let (dt, dp) = (0.5 * (t1 - t0), 0.5 * (p1 - p0));
            let change = reach * (dt + dp) + self.spacing * dp;
            if value < -SLACK * (reach + self.spacing) {
                return false;
            }
            if value >= change || change <= SLACK * (reach + self.spacing) {
                continue;
            }
            if dt > dp {
                let middle = 0.5 * (t0 + t1);
                open.extend([([t0, middle], [p0, p1]), ([middle, t1], [p0, p1])]);
            } else {
                let middle = 0.5 * (p0 + p1);
                open.extend([([t0, t1], [p0, middle]), ([t0, t1], [middle, p1])]);
            }
        }
        true
    }

    /// Searches the cut-off tilt from the most open tilt `start` towards both ends of `range` \[rad\] in steps, then by
    /// bisection. Ranges of blocking tilts narrower than a step (0.25°) may be missed; the result is then more closed.
    fn cut_off_by_search(&self, start: f64, range: [f64; 2], tolerance: f64, span: [f64; 2]) -> Option<f64> {
        let blocks = |tilt: f64| self.blocks(tilt, tolerance, span);
        if blocks(start) {
            return Some(start);
        }
        let outwards = |end: f64| {
            let steps = ((end - start).abs() / STEP).ceil() as usize;
            let at = |k: usize| if k == steps { end } else { start + (end - start).signum() * STEP * k as f64 };
            let first = (1..=steps).find(|&k| blocks(at(k)))?;
            let (mut closed, mut open) = (at(first), at(first - 1));
            while (closed - open).abs() > SLACK {
                let middle = 0.5 * (closed + open);
                if blocks(middle) { closed = middle } else { open = middle }
            }
            Some(closed)
        };
        [outwards(range[1]), outwards(range[0])]
            .into_iter()
            .flatten()
            .min_by(|a, b| a.abs().total_cmp(&b.abs()).then(b.total_cmp(a)))
    }
}

/// Returns the maximum distance between two points of a polyline slat \[m\]; for other profiles the chord, which the
/// extent across a beam never exceeds.
fn diameter(profile: &SlatProfile) -> f64 {
    match profile {
        SlatProfile::Flat { width } | SlatProfile::Arc { width, .. } => *width,
        SlatProfile::Polyline(points) => {
            let pairs = points.iter().flat_map(|a| points.iter().map(move |b| (a[0] - b[0]).hypot(a[1] - b[1])));
            pairs.fold(0.0, f64::max)
        }
    }
}

#[cfg(test)]
#[path = "cut_off/tests.rs"]
mod tests;
