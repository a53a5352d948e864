//! Cuts through a luminous-intensity distribution, as polar diagrams draw them.

use crate::compute::direction::{Emergent, Surface};
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::{Aim, Peak, Peaks};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A cut through the distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LidPlane {
    /// The vertical plane C – C + 180°, C in whole degrees: 0 is into the room, 90 along the façade.
    Vertical(u16),
    /// The horizontal plane γ = 90°, C 0° at the bottom.
    Horizontal,
}

impl LidPlane {
    /// Where light goes for an angle from straight down (C 0° for [`LidPlane::Horizontal`]) towards the right of the
    /// drawing, with C and γ as the luminaire file of the aperture counts them.
    pub fn direction(self, aim: Aim, angle: f64) -> Emergent {
        match self {
            Self::Vertical(c) => aim.direction(f64::from(c).to_radians(), angle),
            Self::Horizontal => aim.direction(angle, FRAC_PI_2),
        }
    }

    /// Its name: both of its half-planes, the one to the right first.
    pub fn label(&self) -> String {
        match *self {
            Self::Vertical(c) => format!("C{c}–C{}", (c + 180) % 360),
            Self::Horizontal => "γ = 90°".to_owned(),
        }
    }
}

/// The vertical planes drawn: across the aperture, and that of the greatest scattered intensity; where that is the same,
/// and from a roof, also along the aperture. The greatest is never left out.
pub fn vertical_planes(surface: Surface, peaks: Option<&Peaks>) -> Vec<LidPlane> {
    let mut planes = vec![LidPlane::Vertical(0)];
    // At nadir and zenith all planes meet.
    let tilted = |peak: &Peak| peak.gamma.sin() > 0.01;
    let peak = peaks.and_then(|peaks| peaks.scattered).filter(tilted);
    if let Some(peak) = peak {
        let c = peak.c.to_degrees().round().rem_euclid(360.0) as u16;
        if !c.is_multiple_of(180) {
            planes.push(LidPlane::Vertical(c));
        }
    }
    let along = LidPlane::Vertical(90);
    if planes.len() == 1 || surface == Surface::Roof && !planes.iter().any(|plane| same_plane(*plane, along)) {
        planes.push(along);
    }
    planes
}

fn same_plane(a: LidPlane, b: LidPlane) -> bool {
    match (a, b) {
        (LidPlane::Vertical(a), LidPlane::Vertical(b)) => a % 180 == b % 180,
        (a, b) => a == b,
    }
}

/// Samples of a cut, even over a whole turn from straight down.
pub const SAMPLES: usize = 720;

/// Sampled cuts of a distribution. \[cd\]
#[derive(Debug, Clone)]
pub struct Curves {
    /// The vertical planes.
    pub vertical: Vec<(LidPlane, Vec<f64>)>,
    /// γ = 90°.
    pub horizontal: Vec<f64>,
    /// The largest of all of them.
    pub max: f64,
}

/// Intensity of scattered light in a direction. \[cd\]
pub fn intensity(lid: &Lid, d: Emergent) -> f64 {
    lid.intensity(d).max(0.0)
}

/// Samples the cuts.
pub fn sample(lid: &Lid, planes: &[LidPlane]) -> Curves {
    sample_at(lid, planes, SAMPLES)
}

/// The same with another number of samples.
pub fn sample_at(lid: &Lid, planes: &[LidPlane], count: usize) -> Curves {
    let aim = Aim::of(lid.surface);
    let cut = |section: LidPlane| -> Vec<f64> {
        (0..count).map(|k| intensity(lid, section.direction(aim, TAU * k as f64 / count as f64))).collect()
    };
    let vertical: Vec<_> = planes.iter().map(|plane| (*plane, cut(*plane))).collect();
    let horizontal = cut(LidPlane::Horizontal);
    let all = vertical.iter().flat_map(|(_, values)| values).chain(&horizontal).copied();
    let max = all.filter(|v| v.is_finite()).fold(0.0, f64::max);
    Curves { vertical, horizontal, max }
}

/// Intensity of an ideal diffuser of the same flux: Φ/π · cosθ about the aperture's normal. \[cd\]
pub fn diffuser(flux: f64, d: Emergent) -> f64 {
    flux / PI * (-d.0.vector().z).max(0.0)
}
