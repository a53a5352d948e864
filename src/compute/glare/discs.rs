//! Beams of the sun at an eye: the image of each is a disc of the sun's size, or an ellipse where mirrors spread it.

use crate::compute::sky::SUN_HALF_ANGLE;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Angle between beams below which they belong together, as parts of one disc or pieces of one fan. \[rad\] Chosen:
/// longer than a piece of a fan (0.15°) with the distance in which pieces are merged (0.1°), shorter than the sun's
/// diameter (0.53°); held by the test `parts_of_a_disc_are_the_disc_and_a_fan_is_long`.
const TOUCHING: f64 = 0.3 * PI / 180.0;

/// Beam of direct or redirected sunlight that arrives at an eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Unit vector from the eye towards the direction that the beam comes from, in the room's axes.
    pub to: DVec3,
    /// Illuminance of the whole, unobstructed beam on a plane perpendicular to it. \[lx\]
    pub normal: f64,
    /// Share of the beam's cross-section that reaches the eye unobstructed, 0 … 1.
    pub share: f64,
}

/// Image of the sun as an eye sees it: a disc, or an ellipse where mirrors spread the beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Unit vector from the eye to the middle of the disc, in the room's axes.
    pub to: DVec3,
    /// Luminance of the disc. \[cd/m²\]
    pub luminance: f64,
    /// Solid angle of the visible part of the disc. \[sr\]
    pub solid_angle: f64,
}

/// Returns the images of the sun that the beams `rays` form at the eye. A single beam is as large as the sun. For beams
/// less than 0.3° from each other, the scatter of their directions gives the size of one common image: an ellipse of
/// the same second moments, nowhere narrower than the sun.
pub fn discs(rays: &[Ray]) -> Vec<Disc> {
    let seen: Vec<Ray> = rays.iter().copied().filter(|ray| ray.share > 0.0 && ray.normal > 0.0).collect();
    let mut open: Vec<usize> = (0..seen.len()).rev().collect();
    let mut found = Vec::new();
    while let Some(first) = open.pop() {
        let mut group = vec![first];
        let mut at = 0;
        while at < group.len() {
            let to = seen[group[at]].to;
            let (near, far): (Vec<usize>, Vec<usize>) =
                open.into_iter().partition(|&other| seen[other].to.distance(to) < TOUCHING);
            group.extend(near);
            open = far;
            at += 1;
        }
        let own: Vec<Ray> = group.into_iter().map(|k| seen[k]).collect();
        found.extend(image(&own));
    }
    found
}

/// Returns the common image of beams that belong together; `None` if their directions cancel.
fn image(rays: &[Ray]) -> Option<Disc> {
    let whole: f64 = rays.iter().map(|ray| ray.normal).sum();
    let seen: f64 = rays.iter().map(|ray| ray.normal * ray.share.min(1.0)).sum();
    let to = rays.iter().map(|ray| ray.normal * ray.to).sum::<DVec3>().try_normalize()?;
    let (u, v) = to.any_orthonormal_pair();
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for ray in rays {
        let DVec2 { x, y } = DVec2::new(ray.to.dot(u), ray.to.dot(v));
        let weight = ray.normal / whole;
        (xx, xy, yy) = (xx + weight * x * x, xy + weight * x * y, yy + weight * y * y);
    }
    // A disc has a quarter of its radius squared along each axis.
    let least = 0.25 * SUN_HALF_ANGLE * SUN_HALF_ANGLE;
    let (mean, spread) = (0.5 * (xx + yy), (0.25 * (xx - yy).powi(2) + xy * xy).sqrt());
    let axes = [mean + spread, mean - spread].map(|variance| variance.max(least).sqrt());
    let size = 4.0 * PI * axes[0] * axes[1];
    Some(Disc { to, luminance: whole / size, solid_angle: size * seen / whole })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sun() -> f64 {
        PI * SUN_HALF_ANGLE * SUN_HALF_ANGLE
    }

    #[test]
    fn a_beam_is_the_sun_and_half_of_it_half() {
        let one = discs(&[Ray { to: DVec3::Y, normal: 8e4, share: 0.5 }]);
        assert_eq!(one.len(), 1);
        assert!((one[0].luminance / (8e4 / sun()) - 1.0).abs() < 1e-12);
        assert!((one[0].solid_angle / (0.5 * sun()) - 1.0).abs() < 1e-12);
        assert!(discs(&[Ray { to: DVec3::Y, normal: 8e4, share: 0.0 }]).is_empty());
    }

    #[test]
    fn parts_of_a_disc_are_the_disc_and_a_fan_is_long() {
        // A sunflower over the disc, each part an equal share.
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        let parts: Vec<Ray> = (0..200)
            .map(|k| {
                let at = SUN_HALF_ANGLE * ((f64::from(k) + 0.5) / 200.0).sqrt();
                let (sin, cos) = (golden * f64::from(k)).sin_cos();
                let to = (DVec3::Y + at * (cos * DVec3::X + sin * DVec3::Z)).normalize_or_zero();
                Ray { to, normal: 400.0, share: 1.0 }
            })
            .collect();
        let whole = discs(&parts);
        assert_eq!(whole.len(), 1);
        assert!((whole[0].solid_angle / sun() - 1.0).abs() < 0.02, "{}", whole[0].solid_angle / sun());
        // A fan of 6° in pieces of 0.15°: as long as it is, as high as the sun.
        let fan: Vec<Ray> = (0..40)
            .map(|k| {
                let angle = (0.15 * f64::from(k)).to_radians();
                Ray { to: DVec3::new(angle.sin(), angle.cos(), 0.0), normal: 100.0, share: 1.0 }
            })
            .collect();
        let long = discs(&fan);
        assert_eq!(long.len(), 1);
        let ratio = long[0].solid_angle / (6.0_f64.to_radians() * 2.0 * SUN_HALF_ANGLE);
        assert!((0.8..1.0).contains(&ratio), "{ratio}");
        // Two suns apart stay two.
        assert_eq!(discs(&[parts[0], Ray { to: DVec3::X, normal: 1.0, share: 1.0 }]).len(), 2);
    }
}
