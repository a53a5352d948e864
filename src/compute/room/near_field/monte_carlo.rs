//! Illuminance of a sensor by Monte Carlo integration over the aperture with importance sampling. Points are drawn with
//! the density cosθ_F/r² on the area, which is uniform over its solid angle, so that the variance is finite for sensors
//! near the aperture or at grazing angles, too. The remaining variance is that of the luminance and of the sensor's
//! cosine.
//!
//! The error is the standard error of the mean: two of three results lie within it. A lobe that no point hits is
//! missing in the value and in the error.
//!
//! Reference: Ureña, Fajardo and King, An area-preserving parametrization for spherical rectangles (2013), below "Ureña
//! et al.".

use super::kernel::kernel;
use crate::compute::estimate::Estimate;
use crate::compute::polygon::clip;
use crate::compute::room::aperture::{Aperture, View};
use crate::compute::room::direct::Sensor;
use crate::compute::sequence::{Random, mixed};
use glam::DVec3;
use std::f64::consts::PI;

/// Solid angle of the aperture below which its closed form loses digits \[sr\]: a sum of angles that rounds to 2⁻⁵² ·
/// 2π ≈ 1e-15, 1e-8 of it. Points are then drawn uniformly over the area, which from such a distance is equivalent.
const SMALL: f64 = 1e-7;

/// Returns a seed of random numbers that depends on sensor and aperture only, so that results are the same on every run
/// and for any number of threads.
pub fn seed(sensor: &Sensor, aperture: &Aperture) -> u64 {
    let [p, n, c] = [sensor.position, sensor.normal, aperture.corner].map(|v: DVec3| v.to_array());
    mixed(0x5EED, p.into_iter().chain(n).chain(c).chain(aperture.size).map(f64::to_bits))
}

/// Computes the illuminance of a sensor by an aperture from `samples` random points, with the standard error of the
/// mean. \[lx\] `luminance`: returns the luminance of the aperture in the direction of a vector from the sensor, façade
/// frame, of any length \[cd/m²\].
pub fn illuminance(view: &View, samples: usize, seed: u64, luminance: impl Fn(DVec3) -> f64) -> Estimate {
    // Points behind the sensor's plane give nothing: only the bounding box of the part in front of it is sampled.
    let mut seen = Vec::with_capacity(6);
    clip(&view.corners(), view.normal, &mut seen);
    if seen.len() < 3 {
        return Estimate::default();
    }
    let range = |axis: usize| {
        seen.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p[axis]), high.max(p[axis])])
    };
    let (x, y) = (range(0), range(1));
    let sampler = SphericalRectangle::new(x, y, view.distance);
    let mut random = Random(seed);
    let (mut mean, mut squares) = (0.0, 0.0);
    for count in 1..=samples {
        let (u, v) = (random.unit(), random.unit());
        let (to, weight) = if sampler.solid_angle > SMALL {
            let to = sampler.point(u, v);
            (to, sampler.solid_angle * view.normal.dot(to).max(0.0) / to.length())
        } else {
            let to = DVec3::new(x[0] + (x[1] - x[0]) * u, y[0] + (y[1] - y[0]) * v, view.distance);
            (to, (x[1] - x[0]) * (y[1] - y[0]) * kernel(view, to))
        };
        let value = if weight > 0.0 { weight * luminance(to) } else { 0.0 };
        // Welford's recurrence: no digits lost to the difference of large sums.
        let step = value - mean;
        mean += step / count as f64;
        squares += step * (value - mean);
    }
    let count = samples as f64;
    Estimate::new(mean, (squares / (count * (count - 1.0).max(1.0))).sqrt())
}

/// Rectangle `x` × `y` in the plane z = `distance` \[m\], seen from the origin, with the parametrisation of Ureña et
/// al. by its solid angle. `b0`, `b1`, `k` and `solid_angle` are b₀, b₁, k and S of that paper: z components of the
/// normals of the first and third side plane, sum of angles that the solid angle is relative to, solid angle \[sr\].
struct SphericalRectangle {
    x: [f64; 2],
    y: [f64; 2],
    distance: f64,
    b0: f64,
    b1: f64,
    k: f64,
    solid_angle: f64,
}

impl SphericalRectangle {
    /// Creates the parametrisation of a rectangle with these limits in the plane z = `distance`. \[m\]
    fn new(x: [f64; 2], y: [f64; 2], distance: f64) -> Self {
        // In the frame of Ureña et al. the rectangle lies at z < 0. The normals are those of the planes through the
        // origin and each side.
        let corner = |x: f64, y: f64| DVec3::new(x, y, -distance);
        let (v00, v01, v10, v11) = (corner(x[0], y[0]), corner(x[0], y[1]), corner(x[1], y[0]), corner(x[1], y[1]));
        let normals = [v00.cross(v10), v10.cross(v11), v11.cross(v01), v01.cross(v00)].map(DVec3::normalize_or_zero);
        let angle = |i: usize, j: usize| (-normals[i].dot(normals[j])).clamp(-1.0, 1.0).acos();
        let k = 2.0 * PI - angle(2, 3) - angle(3, 0);
        let solid_angle = angle(0, 1) + angle(1, 2) - k;
        Self { x, y, distance, b0: normals[0].z, b1: normals[2].z, k, solid_angle }
    }

    /// Returns the point of the rectangle for two numbers in 0 … 1 (the mapping of Ureña et al.); uniform random
    /// numbers give directions that are uniform over the solid angle.
    fn point(&self, u: f64, v: f64) -> DVec3 {
        let (sin, cos) = (u * self.solid_angle + self.k).sin_cos();
        let f = (cos * self.b0 - self.b1) / sin;
        let cu = (f.signum() / f.hypot(self.b0)).clamp(-1.0, 1.0);
        let x = (cu * self.distance / (1.0 - cu * cu).max(0.0).sqrt()).max(self.x[0]).min(self.x[1]);
        let d = x.hypot(self.distance);
        let [h0, h1] = self.y.map(|y| y / d.hypot(y));
        let h = h0 + v * (h1 - h0);
        let y = (h * d / (1.0 - h * h).max(0.0).sqrt()).max(self.y[0]).min(self.y[1]);
        DVec3::new(x, y, self.distance)
    }
}
