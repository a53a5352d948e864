//! Profile of a slat's section at tilt 0: u outward along the chord, v upward; the middle of the chord is the origin,
//! about which the slat rotates.
//!
//! In the axes of the rotated slat, light of profile angle ψ comes from (cos α, sin α), α = β + ψ, where the tilt β > 0
//! lowers the outer edge. A slat blocks its extent across a parallel beam, so that every connected profile lets the
//! share max(0, 1 − extent/(s cosψ)) pass between slats of pitch s.

use std::f64::consts::{FRAC_PI_2, PI};

/// Shape of a slat's section at tilt 0, without its thickness. Lengths are in metres.
#[derive(Debug, Clone, PartialEq)]
pub enum SlatProfile {
    /// Flat slat: straight line.
    Flat {
        /// Width of the slat. \[m\]
        width: f64,
    },
    /// Curved slat: circular arc.
    Arc {
        /// Width of the slat along the chord. \[m\]
        width: f64,
        /// Height of the crown over the chord, > 0 = convex side up; at most half the chord. \[m\]
        rise: f64,
    },
    /// Bent slat: polyline of (outward, upward) points from one edge to the other. \[m\]
    Polyline(Vec<[f64; 2]>),
}

impl SlatProfile {
    /// Creates an arc of the given chord `width` and `rise` \[m\], or a flat profile if the rise is 0.
    pub fn curved(width: f64, rise: f64) -> Self {
        if rise == 0.0 { Self::Flat { width } } else { Self::Arc { width, rise } }
    }

    /// Returns the extent of the slat perpendicular to a parallel beam that makes the angle `alpha` \[rad\] with the
    /// chord. \[m\]
    pub fn extent(&self, alpha: f64) -> f64 {
        let across = |[u, v]: [f64; 2]| v * alpha.cos() - u * alpha.sin();
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut meet = |point| {
            let at = across(point);
            (low, high) = (low.min(at), high.max(at));
        };
        match self {
            Self::Flat { width } => return width * alpha.sin().abs(),
            Self::Arc { width, rise } => {
                meet([0.5 * width, 0.0]);
                meet([-0.5 * width, 0.0]);
                let (radius, half) = arc(*width, *rise);
                // Where the beam touches the arc: its normal there is the beam's, up or down.
                let tangent = (alpha + FRAC_PI_2).rem_euclid(PI) - FRAC_PI_2;
                if tangent.abs() <= half {
                    let up = rise.signum();
                    meet([-radius * tangent.sin() * up, up * (radius * tangent.cos() - radius * half.cos())]);
                }
            }
            Self::Polyline(points) => points.iter().for_each(|&point| meet(point)),
        }
        if high > low { high - low } else { 0.0 }
    }

    /// Returns the share of light with profile angle `psi` (−π/2 … π/2) that passes between slats with the given `tilt`
    /// and `pitch` without touching them; negative values give the overlap of the slats. Angles in \[rad\], pitch in
    /// \[m\].
    pub fn clearance(&self, tilt: f64, pitch: f64, psi: f64) -> f64 {
        1.0 - self.extent(tilt + psi) / (pitch * psi.cos())
    }

    /// Returns the share, 0 … 1, of light with profile angle `psi` that passes between slats with the given `tilt` and
    /// `pitch` without touching them. Angles in \[rad\], pitch in \[m\].
    pub fn open_share(&self, tilt: f64, pitch: f64, psi: f64) -> f64 {
        if psi.abs() < FRAC_PI_2 { self.clearance(tilt, pitch, psi).max(0.0) } else { 0.0 }
    }

    /// Returns the profile as points (outward, upward) of a polyline: an arc in `parts` straight pieces of equal
    /// length, other profiles unchanged. \[m\]
    pub fn polyline(&self, parts: usize) -> Vec<[f64; 2]> {
        match self {
            Self::Flat { width } => vec![[-0.5 * width, 0.0], [0.5 * width, 0.0]],
            Self::Arc { width, rise } => {
                let (radius, half) = arc(*width, *rise);
                (0..=parts)
                    .map(|k| {
                        let a = half * (2.0 * k as f64 / parts as f64 - 1.0);
                        [radius * a.sin(), rise.signum() * radius * (a.cos() - half.cos())]
                    })
                    .collect()
            }
            Self::Polyline(points) => points.clone(),
        }
    }
}

/// Returns the radius \[m\] and half the opening angle \[rad\] of an arc with the given chord `width` and `rise` \[m\].
pub fn arc(width: f64, rise: f64) -> (f64, f64) {
    let rise = rise.abs();
    ((0.25 * width * width + rise * rise) / (2.0 * rise), 2.0 * (2.0 * rise).atan2(width))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extents_are_those_of_many_points() {
        let profiles = [
            SlatProfile::Flat { width: 0.08 },
            SlatProfile::Arc { width: 0.08, rise: 0.008 },
            SlatProfile::Arc { width: 0.08, rise: -0.02 },
        ];
        for profile in profiles {
            let points = profile.polyline(20_000);
            for k in -36..=36 {
                let alpha = f64::to_radians(5.0 * f64::from(k));
                let many = SlatProfile::Polyline(points.clone()).extent(alpha);
                assert!((profile.extent(alpha) - many).abs() < 1e-8, "{profile:?} {alpha}");
            }
        }
    }

    #[test]
    fn an_arc_keeps_its_chord_and_its_crown() {
        let points = SlatProfile::Arc { width: 0.08, rise: -0.01 }.polyline(8);
        assert!((points[0][0] + 0.04).abs() < 1e-15 && points[8][1].abs() < 1e-15);
        assert!((points[4][1] + 0.01).abs() < 1e-15);
    }
}
