//! Integrals of the outside luminance over regions of the sphere.
//!
//! A region is a rectangle in polar angle θ and azimuth φ of some frame. Along a line of constant φ the part above an
//! altitude ≥ 0 is a single interval of θ in closed form, so horizon and skyline cut every region exactly; ground and
//! skyline are then closed forms in θ, and the sky is smooth between known knots of φ. The circumsolar tip, where
//! the luminance has a kink, becomes the corner of triangles that map it away (Duffy's transformation).

use super::Outside;
use super::scan_region;
use crate::compute::direction::{Dir, Orientation, Surface, World};
use crate::compute::estimate::Estimate;
use crate::compute::quadrature::{Rectangle, Tolerance, integrate, integrate_rectangles};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Axes of a plane in the world: φ runs from `x` towards `y`, θ from `z`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    pub(super) x: DVec3,
    pub(super) y: DVec3,
    pub(super) z: DVec3,
}

impl Frame {
    /// Of an aperture in a room.
    pub fn of_aperture(orientation: Orientation, surface: Surface) -> Self {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z]
            .map(|axis| orientation.world_from_room(Dir::from_unit(surface.room_from_facade(axis))).vector());
        Self { x, y, z }
    }

    /// Of a plane given by its normal alone; x is horizontal.
    pub fn facing(normal: Dir<World>) -> Self {
        let z = normal.vector();
        let x = DVec3::Z.cross(z).try_normalize().unwrap_or(DVec3::X);
        Self { x, y: z.cross(x), z }
    }

    /// Bearings and zenith angles: φ is the compass bearing, θ = 90° − altitude.
    pub(super) const DOME: Self = Self { x: DVec3::Y, y: DVec3::X, z: DVec3::Z };

    #[inline]
    pub(super) fn direction(&self, theta: f64, phi: f64) -> DVec3 {
        let (sin_theta, cos_theta) = theta.sin_cos();
        let (sin_phi, cos_phi) = phi.sin_cos();
        self.x * (sin_theta * cos_phi) + self.y * (sin_theta * sin_phi) + self.z * cos_theta
    }

    /// (θ, φ) of a world direction. \[rad\]
    pub(super) fn angles(&self, v: DVec3) -> (f64, f64) {
        let (x, y, z) = (self.x.dot(v), self.y.dot(v), self.z.dot(v));
        (x.hypot(y).atan2(z), y.atan2(x))
    }
}

/// What a direction counts for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Weight {
    /// cosθ dω
    Projected,
    /// dω
    Solid,
}

impl Weight {
    /// Weight per θ and φ.
    #[inline]
    fn density(self, theta: f64) -> f64 {
        match self {
            Self::Projected => theta.sin() * theta.cos(),
            Self::Solid => theta.sin(),
        }
    }

    /// ∫ of the density from a to b.
    #[inline]
    pub(super) fn between(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Projected => 0.5 * (b - a).sin() * (b + a).sin(),
            Self::Solid => 2.0 * (0.5 * (b + a)).sin() * (0.5 * (b - a)).sin(),
        }
    }
}

/// θ₀ … θ₁ × φ₀ … φ₁ of a frame. \[rad\]
#[derive(Debug, Clone, Copy)]
pub(super) struct Region {
    pub frame: Frame,
    pub theta: (f64, f64),
    pub phi: (f64, f64),
}

impl Region {
    /// Coefficients A, B of n·d = A sinθ + B cosθ along a line of constant φ.
    #[inline]
    pub fn along(&self, n: DVec3, phi: f64) -> (f64, f64) {
        let (sin, cos) = phi.sin_cos();
        (self.frame.x.dot(n) * cos + self.frame.y.dot(n) * sin, self.frame.z.dot(n))
    }

    /// Interval of θ within the region on which a line of constant φ is at or above the altitude of sine `level` ≥ 0.
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

    /// Azimuths within the region where the circle n·d = `level` crosses the polar angle θ.
    pub fn crossings(&self, n: DVec3, level: f64, theta: f64, out: &mut Vec<f64>) {
        let (sin, cos) = theta.sin_cos();
        if sin < 1e-12 {
            return;
        }
        self.azimuths(n, (level - self.frame.z.dot(n) * cos) / sin, out);
    }

    /// Azimuths within the region where the component A(φ) of n has a value.
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

    /// Adds an azimuth, turned into the region's range, if it lies in it.
    pub fn push_azimuth(&self, phi: f64, out: &mut Vec<f64>) {
        let turned = self.phi.0 + (phi - self.phi.0).rem_euclid(2.0 * PI);
        if turned < self.phi.1 {
            out.push(turned);
        }
    }

    /// Azimuths at which the cut at an altitude of sine `level` meets the region's border or begins.
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

    /// The same azimuths as a rising list from φ₀ to φ₁, slivers left out.
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

/// ∫ L · weight over a region: sky, skyline and ground.
pub(super) fn integrate_region(outside: &Outside, region: &Region, weight: Weight, tolerance: Tolerance) -> Estimate {
    let mut inner = Vec::new();
    region.cut_knots(0.0, &mut inner);
    if outside.skyline_sine > 0.0 {
        region.cut_knots(outside.skyline_sine, &mut inner);
    }
    let knots = region.sorted(inner);
    let sky = if outside.is_piecewise_constant() {
        scan_region::integrate_scan(outside, region, weight, &knots, tolerance)
    } else {
        knots.windows(2).map(|pair| sky_strip(outside, region, (pair[0], pair[1]), weight, tolerance)).sum()
    };
    sky + constant_parts(outside, region, weight, &knots, tolerance)
}

/// Ground and skyline, of constant luminance each: closed form in θ, 1-D in φ.
fn constant_parts(outside: &Outside, region: &Region, weight: Weight, knots: &[f64], tolerance: Tolerance) -> Estimate {
    let (ground, skyline) = (outside.ground_luminance, outside.skyline_luminance);
    let has_skyline = outside.skyline_sine > 0.0 && skyline > 0.0;
    if ground == 0.0 && !has_skyline {
        return Estimate::default();
    }
    let all = weight.between(region.theta.0, region.theta.1);
    let share = |phi: f64, level: f64| region.above(phi, level).map_or(0.0, |(low, high)| weight.between(low, high));
    integrate(
        |phi| {
            let upper = share(phi, 0.0);
            let between = if has_skyline { upper - share(phi, outside.skyline_sine) } else { 0.0 };
            ground * (all - upper) + skyline * between
        },
        knots,
        tolerance,
    )
}

/// The open sky over one strip of azimuths between knots.
fn sky_strip(
    outside: &Outside,
    region: &Region,
    (phi_min, phi_max): (f64, f64),
    weight: Weight,
    tolerance: Tolerance,
) -> Estimate {
    let limits = |phi: f64| region.above(phi, outside.skyline_sine);
    if outside.scale == 0.0 || limits(0.5 * (phi_min + phi_max)).is_none() {
        return Estimate::default();
    }
    let width = phi_max - phi_min;
    // The strip as the unit square: x along φ, y along θ between the limits.
    let at = |x: f64, y: f64| {
        let phi = phi_min + width * x;
        let Some((low, high)) = limits(phi) else { return 0.0 };
        let theta = low + (high - low) * y;
        let v = region.frame.direction(theta, phi);
        outside.sky_luminance(v) * weight.density(theta) * (high - low) * width
    };
    let Some((tip_x, tip_y)) = tip(outside, region, phi_min, width, &limits) else {
        return integrate_rectangles(at, &[Rectangle::UNIT], tolerance);
    };
    // Four triangles from the tip to the sides of the square: p = tip + r·(side(t) − tip), |Jacobian| = r·|cross|.
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    (0..4)
        .map(|side| {
            let (a, b) = (corners[side], corners[(side + 1) % 4]);
            let cross = ((a.0 - tip_x) * (b.1 - tip_y) - (a.1 - tip_y) * (b.0 - tip_x)).abs();
            if cross < 1e-13 {
                return Estimate::default();
            }
            let triangle = |r: f64, t: f64| {
                let x = tip_x + r * (a.0 + (b.0 - a.0) * t - tip_x);
                let y = tip_y + r * (a.1 + (b.1 - a.1) * t - tip_y);
                at(x, y) * r * cross
            };
            integrate_rectangles(triangle, &[Rectangle::UNIT], tolerance)
        })
        .sum()
}

/// Where the circumsolar tip lies in a strip's unit square, if it does.
fn tip(
    outside: &Outside,
    region: &Region,
    phi_min: f64,
    width: f64,
    limits: &impl Fn(f64) -> Option<(f64, f64)>,
) -> Option<(f64, f64)> {
    let (theta, phi) = region.frame.angles(outside.sun_direction()?.vector());
    // At the pole the tip is a whole side of the square and the integrand smooth in θ as it is.
    if theta < 1e-9 {
        return None;
    }
    const SLACK: f64 = 1e-9;
    let x = (phi - phi_min + SLACK).rem_euclid(2.0 * PI) - SLACK;
    if x > width + SLACK {
        return None;
    }
    let x = (x / width).clamp(0.0, 1.0);
    let (low, high) = limits(phi_min + width * x)?;
    (theta > low - SLACK && theta < high + SLACK).then(|| (x, ((theta - low) / (high - low)).clamp(0.0, 1.0)))
}

/// Illuminance of an unobstructed plane from sky, skyline and ground, without the beam. \[lx\]
pub fn irradiance(outside: &Outside, normal: Dir<World>) -> Estimate {
    let frame = Frame::facing(normal);
    // Quarters: shorter pieces, and the knots of a façade's horizon among them.
    (0..4)
        .map(|quarter| {
            let from = f64::from(quarter) * FRAC_PI_2;
            let region = Region { frame, theta: (0.0, FRAC_PI_2), phi: (from, from + FRAC_PI_2) };
            let tolerance = Tolerance { relative: 1e-7, ..Tolerance::absolute(1e-9 * outside.diffuse_horizontal) };
            integrate_region(outside, &region, Weight::Projected, tolerance)
        })
        .sum()
}
