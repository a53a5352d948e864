//! Diffuse light from outside: luminances of the scaled sky, of the ground, of a skyline and of other obstructions.

use super::distribution::Distribution;
use super::horizontal;
use super::open_cells::OpenCells;
use super::scan::Scan;
use crate::compute::direction::{Dir, World};
use crate::compute::estimate::Estimate;
use crate::compute::surroundings::Surroundings;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Error of the creation of a sky.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SkyError {
    /// Illuminance that is negative or not finite. \[lx\]
    #[error("a diffuse horizontal illuminance of {0} lx (allowed: 0 and above)")]
    Illuminance(f64),
    /// Relative luminance distribution whose horizontal illuminance is 0 or not finite, so that it cannot be scaled.
    #[error("the sky's relative luminance gives the horizontal plane {0}, which cannot be scaled to an illuminance")]
    Unscalable(f64),
    /// Reflectance of the ground outside 0 … 1.
    #[error("a ground reflectance of {0} (allowed: 0 to 1)")]
    Reflectance(f64),
    /// Skyline with an altitude outside 0 … 90° or with a negative luminance.
    #[error("a skyline at {altitude}° with {luminance} cd/m² (allowed: 0 up to below 90°, 0 cd/m² and above)")]
    Skyline {
        /// Altitude of the skyline. \[°\]
        altitude: f64,
        /// Luminance of the skyline. \[cd/m²\]
        luminance: f64,
    },
}

/// Luminances outside the room: sky, ground, skyline and other obstructions, without the sun's disc.
#[derive(Debug, Clone, PartialEq)]
pub struct Outside {
    pub(super) distribution: Distribution,
    /// Luminance of the sky per unit of relative luminance. \[cd/m²\]
    pub(super) scale: f64,
    pub(super) diffuse_horizontal: f64,
    pub(super) ground_luminance: f64,
    ground_reflectance: f64,
    pub(super) skyline_altitude: f64,
    pub(super) skyline_sine: f64,
    pub(super) skyline_luminance: f64,
    pub(super) before: Option<Before>,
}

/// Obstructions in front of sky and ground, with the point from which they are seen.
#[derive(Debug, Clone)]
pub(super) struct Before {
    pub surroundings: Arc<Surroundings>,
    /// Point from which the obstructions are seen, world frame \[m\]; with `None` only the skyline counts, boxes do
    /// not.
    pub eye: Option<DVec3>,
    /// Cached illuminances from cells by the unobstructed sky, the same at all points.
    pub kept: Arc<OpenCells>,
}

impl PartialEq for Before {
    fn eq(&self, other: &Self) -> bool {
        self.surroundings == other.surroundings && self.eye == other.eye
    }
}

impl Outside {
    /// Creates a sky over black ground, scaled so that its illuminance on the unobstructed horizontal plane is exactly
    /// `diffuse_horizontal`. \[lx\] 0 lx gives a black sky.
    ///
    /// # Errors
    /// Returns an error if the illuminance is negative or not finite, or if the distribution cannot be scaled to it.
    pub fn new(distribution: Distribution, diffuse_horizontal: f64) -> Result<Self, SkyError> {
        Self::scaled_by(distribution, diffuse_horizontal, horizontal::horizontal_illuminance)
    }

    /// Creates a sky over black ground like [`Self::new`], but scaled only to a relative accuracy of 2e-5, for annual
    /// simulations with thousands of skies.
    ///
    /// # Errors
    /// Returns an error if the illuminance is negative or not finite, or if the distribution cannot be scaled to it.
    pub fn quickly(distribution: Distribution, diffuse_horizontal: f64) -> Result<Self, SkyError> {
        Self::scaled_by(distribution, diffuse_horizontal, horizontal::horizontal_illuminance_quickly)
    }

    /// Creates a sky over black ground whose relative luminance is scaled to a diffuse horizontal illuminance \[lx\];
    /// `illuminance` integrates the relative luminance.
    fn scaled_by(
        distribution: Distribution,
        diffuse_horizontal: f64,
        illuminance: fn(&Distribution) -> Estimate,
    ) -> Result<Self, SkyError> {
        if !(diffuse_horizontal >= 0.0 && diffuse_horizontal.is_finite()) {
            return Err(SkyError::Illuminance(diffuse_horizontal));
        }
        let scale = if diffuse_horizontal == 0.0 {
            0.0
        } else {
            let relative = illuminance(&distribution).value;
            let scale = diffuse_horizontal / relative;
            if !(relative > 0.0 && scale.is_finite() && scale > 0.0) {
                return Err(SkyError::Unscalable(relative));
            }
            scale
        };
        Ok(Self {
            distribution,
            scale,
            diffuse_horizontal,
            ground_luminance: 0.0,
            ground_reflectance: 0.0,
            skyline_altitude: 0.0,
            skyline_sine: 0.0,
            skyline_luminance: 0.0,
            before: None,
        })
    }

    /// Creates a measured sky over black ground, with the measured luminances unchanged.
    pub fn measured(scan: Scan) -> Self {
        let distribution = Distribution::scan(scan);
        let diffuse_horizontal = horizontal::horizontal_illuminance(&distribution).value;
        Self {
            distribution,
            scale: 1.0,
            diffuse_horizontal,
            ground_luminance: 0.0,
            ground_reflectance: 0.0,
            skyline_altitude: 0.0,
            skyline_sine: 0.0,
            skyline_luminance: 0.0,
            before: None,
        }
    }

    /// Returns the sky over endless, unobstructed ground of uniform luminance L = ρ·(E_dh + E_direct,h)/π.
    /// `reflectance`: ρ of the ground, 0 … 1; `direct_horizontal`: illuminance of the unobstructed horizontal plane by
    /// direct sun. \[lx\]
    ///
    /// # Errors
    /// Returns an error if the reflectance lies outside 0 … 1, or if the illuminance is negative or not finite.
    pub fn with_ground(mut self, reflectance: f64, direct_horizontal: f64) -> Result<Self, SkyError> {
        if !(0.0..=1.0).contains(&reflectance) {
            return Err(SkyError::Reflectance(reflectance));
        }
        if !(direct_horizontal >= 0.0 && direct_horizontal.is_finite()) {
            return Err(SkyError::Illuminance(direct_horizontal));
        }
        self.ground_reflectance = reflectance;
        let all = self.diffuse_horizontal + direct_horizontal;
        Ok(self.on_ground(all))
    }

    /// Sets the luminance of unobstructed ground from its illuminance. \[lx\]
    pub(super) fn on_ground(mut self, illuminance: f64) -> Self {
        self.ground_luminance = self.ground_reflectance * illuminance / PI;
        self
    }

    /// Returns the outside with a uniform skyline that covers all directions between the horizon and `altitude` \[rad\]
    /// with the luminance `luminance` \[cd/m²\]. The luminances of sky and ground do not change.
    ///
    /// # Errors
    /// Returns an error if the altitude lies outside 0 … π/2, or if the luminance is negative or not finite.
    pub fn with_skyline(mut self, altitude: f64, luminance: f64) -> Result<Self, SkyError> {
        if !((0.0..PI / 2.0).contains(&altitude) && luminance >= 0.0 && luminance.is_finite()) {
            return Err(SkyError::Skyline { altitude: altitude.to_degrees(), luminance });
        }
        (self.skyline_altitude, self.skyline_sine, self.skyline_luminance) = (altitude, altitude.sin(), luminance);
        Ok(self)
    }

    /// Returns the outside with all luminances multiplied by a factor: sky, ground, skyline and obstructions. Negative
    /// factors count as 0.
    pub fn scaled(&self, factor: f64) -> Self {
        let factor = factor.max(0.0);
        let mut outside = self.clone();
        for luminance in [
            &mut outside.scale,
            &mut outside.diffuse_horizontal,
            &mut outside.ground_luminance,
            &mut outside.skyline_luminance,
        ] {
            *luminance *= factor;
        }
        if let Some(before) = &self.before {
            let surroundings = Arc::new(before.surroundings.scaled(factor));
            outside.before = Some(Before { surroundings, eye: before.eye, kept: Arc::default() });
        }
        outside
    }

    /// Returns the diffuse reflectance of the ground, 0 … 1.
    pub fn ground_reflectance(&self) -> f64 {
        self.ground_reflectance
    }

    /// Returns the outside with obstructions (boxes, skyline) in front of sky and ground. Boxes count once
    /// [`Self::seen_from`] has set the point from which they are seen.
    pub fn behind(self, surroundings: Arc<Surroundings>) -> Self {
        Self { before: Some(Before { surroundings, eye: None, kept: Arc::default() }), ..self }
    }

    /// Returns the outside as seen from the point `eye`, in the world's axes relative to the room's origin. \[m\]
    pub fn seen_from(&self, eye: DVec3) -> Self {
        let before = self.before.as_ref().map(|before| Before { eye: Some(eye), ..before.clone() });
        Self { before, ..self.clone() }
    }

    /// Returns sky, ground and uniform skyline alone, without the other obstructions.
    pub fn open(&self) -> Self {
        Self { before: None, ..self.clone() }
    }

    /// Returns the obstructions in front of sky and ground, and the point from which they are seen; `None` without
    /// obstructions.
    pub(super) fn foreground(&self) -> Option<(&Surroundings, Option<DVec3>)> {
        self.before.as_ref().map(|before| (&*before.surroundings, before.eye))
    }

    /// Returns the obstructions (boxes, skyline by bearing) in front of sky and ground; `None` without any.
    pub fn surroundings(&self) -> Option<&Surroundings> {
        self.before.as_ref().map(|before| &*before.surroundings)
    }

    /// Returns the luminance in a direction, without the sun's disc: of the obstruction in that direction if there is
    /// one; otherwise of the ground below altitude 0, of the uniform skyline below its altitude, of the sky above.
    /// \[cd/m²\]
    #[inline]
    pub fn luminance(&self, d: Dir<World>) -> f64 {
        let v = d.vector();
        if let Some((surroundings, eye)) = self.foreground()
            && let Some(seen) = surroundings.seen(eye, v)
        {
            return surroundings.luminance(seen, eye, v)[0];
        }
        if v.z < 0.0 {
            self.ground_luminance
        } else if v.z < self.skyline_sine {
            self.skyline_luminance
        } else {
            self.sky_luminance(v)
        }
    }

    /// Returns the luminance of the sky without obstructions in the direction `v`, a unit vector of the world's axes
    /// with z ≥ 0. \[cd/m²\]
    #[inline]
    pub(super) fn sky_luminance(&self, v: DVec3) -> f64 {
        self.scale * self.distribution.relative(v)
    }

    /// Returns the diffuse illuminance of the unobstructed horizontal plane by the sky alone. \[lx\]
    pub fn diffuse_horizontal(&self) -> f64 {
        self.diffuse_horizontal
    }

    /// Whether any luminance of sky, ground or obstructions is above 0.
    pub fn is_lit(&self) -> bool {
        self.diffuse_horizontal > 0.0
            || self.ground_luminance > 0.0
            || (self.skyline_luminance > 0.0 && self.skyline_sine > 0.0)
            || self.surroundings().is_some_and(Surroundings::is_lit)
    }

    /// Returns the direction of the sun about which the sky model has its circumsolar brightening; `None` for skies
    /// without one.
    pub fn sun_direction(&self) -> Option<Dir<World>> {
        self.distribution.sun_direction()
    }

    /// Returns the altitude of the uniform skyline; 0 without one. \[rad\]
    pub fn skyline_altitude(&self) -> f64 {
        self.skyline_altitude
    }

    /// Returns the luminance of the uniform skyline, between the horizon and its altitude. \[cd/m²\]
    pub fn skyline_luminance(&self) -> f64 {
        self.skyline_luminance
    }

    /// Returns the luminance of the unobstructed ground. \[cd/m²\]
    pub fn ground_luminance(&self) -> f64 {
        self.ground_luminance
    }

    /// Whether the luminance is the same in all directions above the horizon, skyline included.
    pub fn is_uniform_above_horizon(&self) -> bool {
        (self.distribution.is_uniform() || self.scale == 0.0)
            && self.before.is_none()
            && (self.skyline_sine == 0.0 || self.skyline_luminance == self.sky_luminance(DVec3::Z))
    }

    /// Whether the sky's luminance is constant over each of Tregenza's 145 patches of the dome and discontinuous at
    /// their borders (measured skies).
    pub fn is_piecewise_constant(&self) -> bool {
        self.distribution.is_piecewise_constant()
    }
}
