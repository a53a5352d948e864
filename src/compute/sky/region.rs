//! Regions of the sphere: rectangles in polar angle θ and azimuth φ of some frame.
//!
//! Along a line of constant φ the part above an altitude ≥ 0 is a single interval of θ in closed form, so that regions
//! are divided exactly at the horizon and a uniform skyline.

use crate::compute::direction::{Dir, Orientation, Surface, World};
use glam::DVec3;
use std::f64::consts::PI;

/// Axes of a plane (an aperture, a receiver) as unit vectors in the world's axes: x and y in the plane, z its normal.
/// The azimuth φ runs from x towards y, the polar angle θ from z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    pub(super) x: DVec3,
    pub(super) y: DVec3,
    pub(super) z: DVec3,
}

impl Frame {
    /// Creates the axes of an aperture from the orientation of its room and the surface that it lies in: x to the right
    /// seen from outside, y up, z outward normal.
    pub fn of_aperture(orientation: Orientation, surface: Surface) -> Self {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z]
            .map(|axis| orientation.world_from_room(Dir::from_unit(surface.room_from_facade(axis))).vector());
        Self { x, y, z }
    }

    /// Creates the axes of a plane with this normal; x is horizontal.
    pub fn facing(normal: Dir<World>) -> Self {
        let z = normal.vector();
        let x = DVec3::Z.cross(z).try_normalize().unwrap_or(DVec3::X);
        Self { x, y: z.cross(x), z }
    }

    /// Frame of compass bearings and zenith angles: φ is the bearing, θ = 90° − altitude.
    pub(super) const DOME: Self = Self { x: DVec3::Y, y: DVec3::X, z: DVec3::Z };

    /// Returns the direction with the polar angle `theta` from the normal and the azimuth `phi` \[rad\], as a unit
    /// vector in the world's axes.
    #[inline]
    pub fn direction(&self, theta: f64, phi: f64) -> DVec3 {
        let (sin_theta, cos_theta) = theta.sin_cos();
        let (sin_phi, cos_phi) = phi.sin_cos();
        self.x * (sin_theta * cos_phi) + self.y * (sin_theta * sin_phi) + self.z * cos_theta
    }

    /// Returns the meridian (half plane through the pole) of an azimuth `phi`. \[rad\]
    pub(super) fn meridian(&self, phi: f64) -> Meridian {
        let (sin, cos) = phi.sin_cos();
        Meridian { along: self.x * cos + self.y * sin, pole: self.z }
    }

    /// Returns (θ, φ) in this frame of a direction in the world's axes. \[rad\]
    pub(super) fn angles(&self, v: DVec3) -> (f64, f64) {
        let (x, y, z) = (self.x.dot(v), self.y.dot(v), self.z.dot(v));
        (x.hypot(y).atan2(z), y.atan2(x))
    }
}

/// Meridian of a frame: all directions of one azimuth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meridian {
    /// Direction at a polar angle of 90°; `pole` is that at 0.
    pub along: DVec3,
    pub pole: DVec3,
}

impl Meridian {
    /// Returns the direction of the meridian with the polar angle `theta` \[rad\], as a unit vector in the world's
    /// axes; cheaper than [`Frame::direction`].
    #[inline]
    pub fn direction(&self, theta: f64) -> DVec3 {
        let (sin, cos) = theta.sin_cos();
        self.along * sin + self.pole * cos
    }
}

/// Weight of a direction in an integral of the luminance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Weight {
    /// Projected solid angle, cosθ dω.
    Projected,
    /// Solid angle, dω.
    Solid,
}

impl Weight {
    /// Returns the weight per θ and φ at the polar angle `theta`.
    #[inline]
    pub(super) fn density(self, theta: f64) -> f64 {
        match self {
            Self::Projected => theta.sin() * theta.cos(),
            Self::Solid => theta.sin(),
        }
    }

    /// Returns the integral of the density over θ from `a` to `b`. \[rad\]
    #[inline]
    pub(super) fn between(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Projected => 0.5 * (b - a).sin() * (b + a).sin(),
            Self::Solid => 2.0 * (0.5 * (b + a)).sin() * (0.5 * (b - a)).sin(),
        }
    }
}

/// Spherical cap: unit vector to its middle, and its angular radius. \[rad\]
#[derive(Clone, Copy)]
pub(super) struct Cap {
    pub middle: DVec3,
    pub reach: f64,
}

impl Cap {
    /// Whether both caps may have a direction in common.
    pub fn touches(&self, other: &Self) -> bool {
        let reach = self.reach + other.reach;
        reach >= PI || self.middle.dot(other.middle) > reach.cos()
    }
}

/// Region of the sphere θ₀ … θ₁ × φ₀ … φ₁ in the angles of a frame. \[rad\]
#[derive(Debug, Clone, Copy)]
pub(super) struct Region {
    pub frame: Frame,
    pub theta: (f64, f64),
    pub phi: (f64, f64),
}

impl Region {
    /// Returns a spherical cap that contains the region.
    pub fn cap(&self) -> Cap {
        let (theta, phi) = (0.5 * (self.theta.0 + self.theta.1), 0.5 * (self.phi.0 + self.phi.1));
        let (high, wide) = (self.theta.1 - self.theta.0, self.phi.1 - self.phi.0);
        let reach = 0.5 * (high + wide * self.theta.1.sin().max(0.0)) + 1e-6;
        Cap { middle: self.frame.direction(theta, phi), reach }
    }

    /// Whether the region contains a direction, with a tolerance of `slack`. \[rad\]
    pub fn holds(&self, direction: DVec3, slack: f64) -> bool {
        let (theta, phi) = self.frame.angles(direction);
        let past = (phi - self.phi.0 + slack).rem_euclid(2.0 * PI);
        theta >= self.theta.0 - slack && theta <= self.theta.1 + slack && past <= self.phi.1 - self.phi.0 + 2.0 * slack
    }

    /// Returns the coefficients A, B of n·d = A sinθ + B cosθ along a line of constant φ.
    #[inline]
    pub fn along(&self, n: DVec3, phi: f64) -> (f64, f64) {
        let (sin, cos) = phi.sin_cos();
        (self.frame.x.dot(n) * cos + self.frame.y.dot(n) * sin, self.frame.z.dot(n))
    }

    /// Returns the interval of θ within the region on which a line of constant φ is at or above an altitude whose sine
    /// is `level` ≥ 0; `None` if it is empty.
    #[inline]
    pub fn above(&self, phi: f64, level: f64) -> Option<(f64, f64)> {
        let (a, b) = self.along(DVec3::Z, phi);
        // A sinθ + B cosθ = R cos(θ − θ₀) ≥ level
        let r = a.hypot(b);
        // A line on the horizon itself counts as above or below by rounding; neither has an area.
        if r <= level || r < 1e-15 {
            return None;
        }
        let (middle, half) = (a.atan2(b), (level / r).acos());
        let (low, high) = ((middle - half).max(self.theta.0), (middle + half).min(self.theta.1));
        (high > low).then_some((low, high))
    }

    /// Adds the azimuths within the region at which the circle n·d = `level` crosses the polar angle θ to `out`.
    pub fn crossings(&self, n: DVec3, level: f64, theta: f64, out: &mut Vec<f64>) {
        let (sin, cos) = theta.sin_cos();
        if sin < 1e-12 {
            return;
        }
        self.azimuths(n, (level - self.frame.z.dot(n) * cos) / sin, out);
    }

    /// Adds the azimuths within the region at which the component A(φ) of n has the value `value` to `out`.
    fn azimuths(&self, n: DVec3, value: f64, out: &mut Vec<f64>) {
        let (x, y) = (self.frame.x.dot(n), self.frame.y.dot(n));
        let rho = x.hypot(y);
        if rho < 1e-12 || value.abs() > rho {
            return;
        }
        let (middle, half) = (y.atan2(x), (value / rho).acos());
        for phi in [middle - half, middle + half] {
            self.push_azimuth(phi, out);
        }
    }

    /// Adds an azimuth, shifted by full turns into the region's range, to `out` if it lies in the region.
    pub fn push_azimuth(&self, phi: f64, out: &mut Vec<f64>) {
        let turned = self.phi.0 + (phi - self.phi.0).rem_euclid(2.0 * PI);
        if turned < self.phi.1 {
            out.push(turned);
        }
    }

    /// Adds the azimuths at which the circle of an altitude of sine `level` begins or meets the region's border to
    /// `out`.
    pub fn cut_knots(&self, level: f64, out: &mut Vec<f64>) {
        for theta in [self.theta.0, self.theta.1] {
            self.crossings(DVec3::Z, level, theta, out);
        }
        let b = self.frame.z.z;
        if level * level >= b * b {
            let value = (level * level - b * b).sqrt();
            self.azimuths(DVec3::Z, value, out);
            self.azimuths(DVec3::Z, -value, out);
        }
    }

    /// Returns azimuths as a rising list from φ₀ to φ₁, without intervals below 1e-12.
    pub fn sorted(&self, mut inner: Vec<f64>) -> Vec<f64> {
        inner.sort_by(f64::total_cmp);
        let mut knots = vec![self.phi.0];
        for phi in inner {
            if phi - knots[knots.len() - 1] > 1e-12 && self.phi.1 - phi > 1e-12 {
                knots.push(phi);
            }
        }
        knots.push(self.phi.1);
        knots
    }
}
