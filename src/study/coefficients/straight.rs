//! Outside that the sensors see through an aperture by regular transmission.
//!
//! Directions are chosen for every sensor; their luminances are summed as moments over the cosine of the angle of
//! incidence. The moments depend on the aperture alone, so that those of one year serve every system in it.

use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, World};
use crate::compute::estimate::Estimate;
use crate::compute::lid::Facing;
use crate::compute::quadrature::Tolerance;
use crate::compute::room::direct::Sensor;
use crate::compute::room::through;
use crate::compute::sky::Outside;
use crate::study::scene::Scene;
use crate::study::session::far::{self, Constants};
use std::hash::{Hash, Hasher};

/// Minimum number of Gauss points along each side of a piece of the outside that a sensor sees by regular transmission.
const POINTS: usize = 4;

/// Maximum number of moments of a sensor. τ(θ) is approximated by a polynomial of cos θ of one degree less; the
/// remainder is orthogonal to all these polynomials, and the luminance of a sky is nearly one of them. The relative
/// error of the illuminance is 10⁻⁷ behind panes, and 10⁻⁵ for a table of ten angles.
const MOMENTS: usize = 8;

/// Share of the initial sum of squares below which a polynomial of the recurrence consists of rounding errors only.
const NOTHING_NEW: f64 = 1e-20;

/// Relative accuracy of the illuminances by ground and skyline.
const RELATIVE: f64 = 1e-7;

/// Outside as one sensor sees it through an aperture by regular transmission.
#[derive(Default)]
pub(super) struct StraightView {
    directions: Vec<Dir<World>>,
    /// Number of moments of the sensor, one for each polynomial.
    moments: usize,
    /// Values of the polynomials, direction by direction: orthonormal over the sensor's directions, times the weight of
    /// the direction without the system. \[sr^½\]
    functions: Vec<f64>,
    /// Factors by which the moments give the illuminance behind the system.
    shares: Vec<f64>,
    ground: f64,
    skyline: f64,
}

impl StraightView {
    /// Creates the view of a sensor through an aperture of the scene. `tau`: regular transmittance of its system.
    pub fn new(
        scene: &Scene,
        index: usize,
        sensor: &Sensor,
        tau: &AngularTransmittance,
        constants: &Constants,
    ) -> Self {
        let facing = scene.facing(index);
        let Some(view) = scene.apertures[index].aperture.view(sensor.position, sensor.normal) else {
            return Self::default();
        };
        let mut samples: Vec<Seen> = through::samples(&view, facing.surface, scene.outside.skyline_altitude(), POINTS)
            .into_iter()
            .map(|(d, weight)| Seen {
                direction: scene.orientation.world_from_room(d),
                cosine: facing.surface.facade_from_room(d.vector()).z.clamp(-1.0, 1.0),
                weight,
            })
            .collect();
        let exact = |outside: &Option<Outside>| {
            outside.as_ref().map_or(0.0, |o| seen_exactly(scene, index, sensor, tau, o, RELATIVE).value)
        };
        let passed = |seen: &Seen| seen.weight * tau.at(seen.cosine.acos());
        let mut factor = 1.0;
        if let Some(skyline) = far::shape(&scene.outside) {
            let open = exact(&constants.even);
            let free = |seen: &Seen| !skyline.covers(seen.direction.vector());
            // Of an aperture of which only a corner shows sky, between the directions, all directions represent it.
            if samples.iter().any(free) {
                samples.retain(free);
            }
            let kept: f64 = samples.iter().map(passed).sum();
            factor = if kept > 0.0 { open / kept } else { 0.0 };
        }
        let [ground, skyline] = [&constants.ground, &constants.skyline].map(exact);
        Self { ground, skyline, ..Self::of(&samples, |seen| factor * passed(seen)) }
    }

    /// Creates the view of the sky alone, without ground and skyline. `passed`: illuminance at the sensor per luminance
    /// in a direction \[sr\].
    fn of(samples: &[Seen], passed: impl Fn(&Seen) -> f64) -> Self {
        let polynomials = orthonormal(samples);
        let share = |p: &Vec<f64>| p.iter().zip(samples).map(|(p, seen)| p * passed(seen)).sum();
        let by_direction =
            |(k, seen): (usize, &Seen)| polynomials.iter().map(|p| p[k] * seen.weight).collect::<Vec<_>>();
        Self {
            directions: samples.iter().map(|seen| seen.direction).collect(),
            moments: polynomials.len(),
            functions: samples.iter().enumerate().flat_map(by_direction).collect(),
            shares: polynomials.iter().map(share).collect(),
            ..Self::default()
        }
    }

    /// Returns the number of directions in which the luminance of a new sky is evaluated.
    pub fn directions(&self) -> usize {
        self.directions.len()
    }

    /// Returns the number of moments of the sensor: sums of luminances weighted by polynomials, from which its
    /// illuminance follows.
    pub fn moments(&self) -> usize {
        self.moments
    }

    /// Feeds a hasher with the values that distinguish this aperture from others, independent of the system.
    pub fn hash(&self, hasher: &mut impl Hasher) {
        self.moments.hash(hasher);
        self.directions.iter().for_each(|d| d.vector().to_array().map(f64::to_bits).hash(hasher));
        self.functions.iter().for_each(|f| f.to_bits().hash(hasher));
    }

    /// Appends the sensor's moments of a sky to a list: sums of the luminances in its directions, weighted by each of
    /// its polynomials.
    pub fn gather(&self, outside: &Outside, list: &mut Vec<f64>) {
        let first = list.len();
        list.resize(first + self.moments, 0.0);
        let own = &mut list[first..];
        for (d, functions) in self.directions.iter().zip(self.functions.chunks_exact(self.moments.max(1))) {
            let luminance = outside.luminance(*d);
            own.iter_mut().zip(functions).for_each(|(sum, f)| *sum += f * luminance);
        }
    }

    /// Returns the illuminance at the sensor by the outside seen through the aperture \[lx\]. `moments`: moments of
    /// this sensor and all following ones, of which its own are consumed.
    pub fn light(&self, outside: &Outside, moments: &mut impl Iterator<Item = f64>) -> f64 {
        let sky: f64 = self.shares.iter().zip(moments).map(|(share, moment)| share * moment).sum();
        sky + self.ground * outside.ground_luminance() + self.skyline * far::luminance(outside)
    }
}

/// Direction in which a sensor sees the outside through an aperture.
struct Seen {
    direction: Dir<World>,
    /// Cosine of the angle of incidence on the aperture.
    cosine: f64,
    /// Solid angle that the direction represents, times the cosine at the sensor. \[sr\]
    weight: f64,
}

/// Returns polynomials of the cosine of incidence, as values by direction, that are orthonormal with the weights of the
/// directions (Stieltjes' recurrence, each made orthogonal to all before it).
fn orthonormal(samples: &[Seen]) -> Vec<Vec<f64>> {
    let inner =
        |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).zip(samples).map(|((a, b), s)| a * b * s.weight).sum() };
    let mut list: Vec<Vec<f64>> = Vec::with_capacity(MOMENTS);
    let mut next = vec![1.0; samples.len()];
    while list.len() < MOMENTS {
        let before = inner(&next, &next);
        // Twice: once leaves what rounding makes of nearly parallel ones.
        for p in list.iter().chain(&list) {
            let along = inner(&next, p);
            next.iter_mut().zip(p).for_each(|(n, p)| *n -= along * p);
        }
        let square = inner(&next, &next);
        if square <= NOTHING_NEW * before || square == 0.0 {
            break;
        }
        next.iter_mut().for_each(|n| *n /= square.sqrt());
        let following = next.iter().zip(samples).map(|(n, s)| n * s.cosine).collect();
        list.push(std::mem::replace(&mut next, following));
    }
    list
}

/// Computes the illuminance at one sensor by the outside seen through an aperture by regular transmission, as an
/// integral over its solid angle. `relative`: relative accuracy. \[lx\]
pub(super) fn seen_exactly(
    scene: &Scene,
    index: usize,
    sensor: &Sensor,
    tau: &AngularTransmittance,
    outside: &Outside,
    relative: f64,
) -> Estimate {
    let Some(view) = scene.apertures[index].aperture.view(sensor.position, sensor.normal) else {
        return Estimate::default();
    };
    let scale = outside.diffuse_horizontal().max(outside.ground_luminance()).max(outside.skyline_luminance());
    let tolerance = Tolerance { absolute: 1e-3 * relative * scale, relative, max_pieces: 4000 };
    through::illuminance(&view, &Facing { outside, ..scene.facing(index) }, tau, tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::Surface;
    use crate::compute::room::aperture::Aperture;
    use crate::compute::sky::Distribution;
    use glam::DVec3;

    fn samples(depth: f64) -> Vec<Seen> {
        let window = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [3.0, 1.8] };
        let view = window.view(DVec3::new(1.2, depth, 0.85), DVec3::Z).unwrap();
        through::samples(&view, Surface::Facade, 0.0, POINTS)
            .into_iter()
            .map(|(d, weight)| Seen { direction: Dir::from_unit(d.vector()), cosine: -d.vector().y, weight })
            .collect()
    }

    #[test]
    fn moments_hold_what_panes_let_through() {
        let glass = |power: f64| move |theta: f64| 0.8 * (1.0 - (1.0 - theta.cos()).powf(power));
        // The last as no pane is: it closes within twenty degrees.
        let systems = [
            (AngularTransmittance::Constant(0.7), 1e-12),
            (AngularTransmittance::sample(90, glass(5.0)), 1e-5),
            (AngularTransmittance::sample(9, glass(2.5)), 3e-5),
            (AngularTransmittance::sample(90, |theta| 1.0 / (1.0 + ((theta - 0.8) / 0.09).exp())), 2e-3),
        ];
        for (tau, allowed) in systems {
            let mut worst: f64 = 0.0;
            for depth in [0.2, 0.75, 2.0, 5.5] {
                let samples = samples(depth);
                let view = StraightView::of(&samples, |seen| seen.weight * tau.at(seen.cosine.acos()));
                for (kind, altitude, bearing) in [(12, 0.5, 2.9), (2, 0.9, 2.0), (13, 0.15, 3.3), (16, 0.5, 3.0)] {
                    let sun = Dir::from_altitude_bearing(altitude, Bearing::from_radians(bearing));
                    let outside = Outside::new(Distribution::cie(kind, sun).unwrap(), 1e4).unwrap();
                    let each =
                        |seen: &Seen| seen.weight * tau.at(seen.cosine.acos()) * outside.luminance(seen.direction);
                    let exact: f64 = samples.iter().map(each).sum();
                    let mut moments = Vec::new();
                    view.gather(&outside, &mut moments);
                    assert!(moments.len() <= MOMENTS);
                    let found = view.light(&outside, &mut moments.into_iter());
                    worst = worst.max((found / exact - 1.0).abs());
                }
            }
            assert!(worst < allowed, "{worst:.1e}");
        }
    }
}
