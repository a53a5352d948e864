//! Endless array of slats: dimensions and finishes, checked.

use super::profile::SlatProfile;
use crate::compute::limits::{self, SLAT_POINTS};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Finish of one side of a slat: diffuse and specular reflectance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Diffuse (Lambertian) reflectance, 0 … 1.
    pub diffuse: f64,
    /// Specular reflectance, 0 … 1; both reflectances together are at most 1.
    pub mirror: f64,
    /// Spread σ of a rough mirror: standard deviation of the reflected direction about the ideal one, along either axis
    /// for light near the normal; the lobe for all directions is described in [`super`]. \[rad\]
    pub spread: f64,
}

impl Surface {
    /// Creates a matt surface of the given diffuse reflectance.
    pub const fn matt(diffuse: f64) -> Self {
        Self { diffuse, mirror: 0.0, spread: 0.0 }
    }

    /// Creates an ideal mirror of the given specular reflectance.
    pub const fn mirror(mirror: f64) -> Self {
        Self { diffuse: 0.0, mirror, spread: 0.0 }
    }
}

/// Error for a value that no array of slats can have.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key} = {value}: {allowed}")]
pub struct SlatError {
    /// Key of the quantity in system files.
    pub key: &'static str,
    /// Value that was given, as text, in metres or degrees.
    pub value: String,
    /// Allowed values, as text.
    pub allowed: String,
}

/// Endless array of equal horizontal slats, one above the other: profile, thickness, pitch, tilt and finishes.
#[derive(Debug, Clone, PartialEq)]
pub struct SlatArray {
    profile: SlatProfile,
    thickness: f64,
    spacing: f64,
    tilt: f64,
    upper: Surface,
    lower: Surface,
}

fn check(key: &'static str, value: f64, right: bool, allowed: impl Into<String>) -> Result<(), SlatError> {
    if right { Ok(()) } else { Err(SlatError { key, value: format!("{value}"), allowed: allowed.into() }) }
}

fn check_surface(side: &Surface, keys: [&'static str; 3]) -> Result<(), SlatError> {
    let share = |x: f64| (0.0..=1.0).contains(&x);
    check(keys[0], side.diffuse, share(side.diffuse), "0 to 1")?;
    check(keys[1], side.mirror, share(side.mirror), "0 to 1")?;
    let sum = side.diffuse + side.mirror;
    check(keys[1], side.mirror, sum <= 1.0 + 1e-12, format!("at most {} beside this reflectance", 1.0 - side.diffuse))?;
    check(keys[2], side.spread.to_degrees(), (0.0..=FRAC_PI_4).contains(&side.spread), "0 to 45 degrees")
}

/// Checks the dimensions of a profile and returns its size \[m\]: the chord, or the larger side of the box around its
/// points.
fn check_profile(profile: &SlatProfile) -> Result<f64, SlatError> {
    match profile {
        SlatProfile::Flat { width } => {
            check("width", *width, width.is_finite() && *width > 0.0, "more than 0 m")?;
            Ok(*width)
        }
        SlatProfile::Arc { width, rise } => {
            check("width", *width, width.is_finite() && *width > 0.0, "more than 0 m")?;
            let right = rise.is_finite() && *rise != 0.0 && rise.abs() <= 0.5 * width;
            check("rise", *rise, right, "not 0 for an arc, at most half the width either way")?;
            Ok(*width)
        }
        SlatProfile::Polyline(points) => {
            let count = points.len();
            check("profile", count as f64, (2..=SLAT_POINTS).contains(&count), format!("2 to {SLAT_POINTS} points"))?;
            for pair in points.windows(2) {
                let length = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
                let right = length.is_finite() && length > 0.0;
                check("profile", length, right, "points in metres, no two alike in a row")?;
            }
            let ends = |axis: usize| points.iter().map(move |p| p[axis]);
            let size =
                |axis: usize| ends(axis).fold(f64::NEG_INFINITY, f64::max) - ends(axis).fold(f64::INFINITY, f64::min);
            Ok(size(0).max(size(1)))
        }
    }
}

impl SlatArray {
    /// Creates an array of slats of the given profile and thickness \[m\], one every `spacing` \[m\], rotated by `tilt`
    /// \[rad\] (> 0 = outer edge lowered) about the profile's origin. Thickness 0 is a sheet; edges of solid slats
    /// reflect diffusely, with the mean reflectance of both sides.
    ///
    /// # Errors
    /// Returns the first value that is out of range, with the allowed values.
    pub fn new(
        profile: SlatProfile,
        thickness: f64,
        spacing: f64,
        tilt: f64,
        [upper, lower]: [Surface; 2],
    ) -> Result<Self, SlatError> {
        let size = check_profile(&profile)?;
        check("spacing", spacing, spacing.is_finite() && spacing > 0.0, "more than 0 m")?;
        check("spacing", spacing, (0.02..=50.0).contains(&(spacing / size)), "0.02 to 50 times the slat's width")?;
        // The ways between mirrors multiply with every slat that another faces.
        let mirrors = upper.mirror > 0.0 || lower.mirror > 0.0;
        if mirrors && size > limits::MIRROR_PITCHES * spacing {
            let allowed = format!(
                "slats with mirrors that span at most {} pitches; these span {:.1}",
                limits::MIRROR_PITCHES,
                size / spacing
            );
            return Err(SlatError { key: "spacing", value: format!("{spacing}"), allowed });
        }
        let thick = (0.0..=0.25 * size.min(spacing)).contains(&thickness);
        check("thickness", thickness, thick, "0 m to a quarter of the slat's width and of the spacing")?;
        check("angle", tilt.to_degrees(), tilt.abs() <= FRAC_PI_2 + 1e-9, "-90 to 90 degrees")?;
        check_surface(&upper, ["upper.reflectance", "upper.specular", "upper.roughness"])?;
        check_surface(&lower, ["lower.reflectance", "lower.specular", "lower.roughness"])?;
        Ok(Self { profile, thickness, spacing, tilt, upper, lower })
    }

    /// Returns the profile of a slat's section at tilt 0.
    pub const fn profile(&self) -> &SlatProfile {
        &self.profile
    }

    /// Returns the thickness of a slat. \[m\]
    pub const fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Returns the vertical pitch of the slats. \[m\]
    pub const fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Returns the tilt of the slats, positive with the outer edge lowered. \[rad\]
    pub const fn tilt(&self) -> f64 {
        self.tilt
    }

    /// Returns the finish of the side of a slat that faces upwards at tilt 0.
    pub const fn upper(&self) -> Surface {
        self.upper
    }

    /// Returns the finish of the side of a slat that faces downwards at tilt 0.
    pub const fn lower(&self) -> Surface {
        self.lower
    }

    /// Returns the finish of the edges of solid slats.
    pub(super) fn edge(&self) -> Surface {
        let all = |side: Surface| side.diffuse + side.mirror;
        Surface::matt((0.5 * (all(self.upper) + all(self.lower))).min(1.0))
    }
}
