//! Eye of an observer, its picture of the room, and the position index of places in that picture.
//!
//! The picture is an equiangular fisheye: a direction σ off the line of sight lies at a distance σ from the middle.

use crate::compute::room::direct::Sensor;
use glam::{DVec2, DVec3};

/// Maximum position index, as in `evalglare`. Returned wherever the formulas exceed it, since no data exist there.
const LARGEST: f64 = 16.0;

/// Eye of an observer and its line of sight, in the room's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaze {
    /// Position of the eye. \[m\]
    pub position: DVec3,
    /// Line of sight, a unit vector.
    pub forward: DVec3,
    right: DVec3,
    up: DVec3,
}

impl Gaze {
    /// Creates the eye of a sensor point: it looks along the normal, upright. One that looks up or down vertically has
    /// its head towards +y.
    pub fn new(sensor: &Sensor) -> Self {
        let forward = sensor.normal.normalize_or_zero();
        let upright = |axis: DVec3| {
            (axis - axis.dot(forward) * forward).try_normalize().filter(|_| axis.dot(forward).abs() < 1.0 - 1e-9)
        };
        let up = upright(DVec3::Z).or_else(|| upright(DVec3::Y)).unwrap_or(DVec3::Z);
        Self { position: sensor.position, forward, right: forward.cross(up), up }
    }

    /// Returns the position of a unit direction, given in the room's axes, in the eye's equiangular picture: x to the
    /// right, y up; its distance from the middle is the angle off the line of sight. \[rad\]
    pub fn place(&self, to: DVec3) -> DVec2 {
        let aside = DVec2::new(to.dot(self.right), to.dot(self.up));
        let off = aside.length().atan2(to.dot(self.forward));
        aside.normalize_or_zero() * off
    }

    /// Returns the unit direction, in the room's axes, at a position of the eye's equiangular picture (x to the right,
    /// y up). \[rad\]
    pub fn direction(&self, place: DVec2) -> DVec3 {
        let off = place.length();
        let aside = place.normalize_or_zero();
        off.cos() * self.forward + off.sin() * (aside.x * self.right + aside.y * self.up)
    }
}

/// Returns the position index P of a glare source at a position of the eye's equiangular picture (x to the right, y up)
/// \[rad\]: the factor by which its luminance has to be higher to disturb as much as a source on the line of sight.
///
/// Above the line of sight after Guth (IES Lighting Handbook; Wienold & Christoffersen 2006, eq 2), with σ the angle
/// off the line of sight and τ that around it from the vertical, in degrees: P = exp((35.2 − 0.31889 τ − 1.22
/// e^(−2τ/9)) 10⁻³ σ + (21 + 0.26667 τ − 0.002963 τ²) 10⁻⁵ σ²). Below it after Iwata (Iwata & Tokura 1997; CIE
/// 190:2010) in the form of `evalglare` 3.02 and later: P = exp(6.49·10⁻³ β + 21·10⁻⁵ β²), tan β = tan σ √(1 + 0.3225
/// cos² τ). Both meet on the horizontal; the maximum is 16.
pub fn position_index(place: DVec2) -> f64 {
    let sigma = place.length();
    if sigma <= 0.0 {
        return 1.0;
    }
    let cosine = (place.y / sigma).clamp(-1.0, 1.0);
    let exponent = if cosine < 0.0 {
        let stretch = (1.0 + 0.3225 * cosine * cosine).sqrt();
        // By components, so that 90° needs no special case.
        let beta = (sigma.sin() * stretch).atan2(sigma.cos()).to_degrees();
        6.49e-3 * beta + 21e-5 * beta * beta
    } else {
        let (sigma, tau) = (sigma.to_degrees(), cosine.acos().to_degrees());
        (35.2 - 0.31889 * tau - 1.22 * (-2.0 * tau / 9.0).exp()) * 1e-3 * sigma
            + (21.0 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma
    };
    exponent.exp().min(LARGEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(sigma: f64, tau: f64) -> f64 {
        let (sin, cos) = tau.to_radians().sin_cos();
        position_index(sigma.to_radians() * DVec2::new(sin, cos))
    }

    #[test]
    fn the_index_is_that_of_the_published_formulas() {
        // By hand: exp(0.03398·10 + 21e-5·100); exp(…) of τ = 45°: 35.2 − 14.35005 − 0.0000554 = 20.84989,
        // 21 + 12.00015 − 6.000075 = 27.000075; below: β of tan 30° √1.3225 = 0.663953: 33.5831°.
        for (sigma, tau, expected) in [
            (0.0, 0.0, 1.0),
            (10.0, 0.0, (0.33980_f64 + 0.021).exp()),
            (20.0, 45.0, (0.416_997_9_f64 + 0.108_000_3).exp()),
            (30.0, 90.0, (0.195_f64 + 0.189).exp()),
            (30.0, 180.0, (0.217_954_f64 + 0.236_843).exp()),
            (80.0, 0.0, 16.0),
        ] {
            assert!((at(sigma, tau) / expected - 1.0).abs() < 2e-4, "{sigma} {tau}: {} {expected}", at(sigma, tau));
        }
    }

    #[test]
    fn above_and_below_meet_on_the_horizontal_and_sides_are_alike() {
        for sigma in [5.0, 20.0, 45.0, 70.0, 89.0] {
            assert!((at(sigma, 90.0 - 1e-6) / at(sigma, 90.0 + 1e-6) - 1.0).abs() < 2e-3, "{sigma}");
            assert!((at(sigma, 60.0) - at(sigma, -60.0)).abs() < 1e-12);
            assert!((at(sigma, 120.0) - at(sigma, -120.0)).abs() < 1e-12);
        }
    }

    #[test]
    fn places_and_directions_are_each_others_inverse() {
        let sensor = Sensor { position: DVec3::ONE, normal: DVec3::new(0.6, -0.8, 0.0) };
        let gaze = Gaze::new(&sensor);
        for to in [DVec3::new(0.6, -0.8, 0.0), DVec3::new(0.48, -0.64, 0.6), DVec3::new(0.0, -0.8, -0.6)] {
            assert!((gaze.direction(gaze.place(to)) - to).length() < 1e-12);
        }
        assert!(gaze.place(DVec3::new(0.0, -0.6, 0.8)).y > 0.0);
        // Looking at the façade, +x of the room is on the left hand.
        let facing = Gaze::new(&Sensor { position: DVec3::ONE, normal: DVec3::NEG_Y });
        assert!(facing.place(DVec3::new(0.6, -0.8, 0.0)).x < 0.0);
        // Straight up is a direction, too.
        let up = Gaze::new(&Sensor { position: DVec3::ONE, normal: DVec3::Z });
        assert!((up.place(DVec3::Y).length() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }
}
