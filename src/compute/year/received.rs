//! Illuminance (or irradiance) that an aperture receives from sky, ground and skyline through every cell of its outer
//! hemisphere, for many outside conditions one after the other: directions and weights are computed once.
//!
//! Outside conditions may be photometric (results in lx) or radiometric (results in W/m²).

use crate::compute::basis::{RingBasis, sub_directions};
use crate::compute::direction::{Dir, World};
use crate::compute::sky::{Distribution, Frame, Outside, SkySamples, incident_illuminances_within};
use glam::DVec3;
use std::f64::consts::PI;

/// Maximum angle between the directions in which a cell's sky is sampled. \[rad\] Chosen: cost; held by the test
/// `a_clear_sky_is_gathered_as_by_integration` (2e-3), and judged in every year.
const SPACING: f64 = 4.0 * PI / 180.0;
/// Number of sampling directions along each side of a cell if obstructions hide sky or ground. Chosen: cost; held by
/// the test `what_stands_before_it_takes_its_part` (1 %), and judged in every year.
const POINTS: usize = 6;
/// Relative accuracy of the light from ground and skyline, whose weights are the same for all hours. Chosen: negligible
/// beside [`JUDGED`].
const RELATIVE: f64 = 1e-6;

/// Cells of an aperture's outer hemisphere, with the weights by which they receive light from sky, ground and skyline.
#[derive(Debug, Clone)]
pub struct Received {
    cells: RingBasis,
    frame: Frame,
    samples: SkySamples,
    /// Illuminance through each cell by a ground of luminance 1, one entry per cell \[sr\]; `skyline` has the same by a
    /// skyline of luminance 1.
    ground: Vec<f64>,
    skyline: Vec<f64>,
    altitude: f64,
}

impl Received {
    /// Prepares the weights of `cells` for an aperture whose axes are given by `frame`, with a skyline of uniform
    /// `altitude` \[rad\], 0 without one.
    pub fn new(cells: RingBasis, frame: Frame, altitude: f64) -> Self {
        let black = || Outside::new(Distribution::uniform(), 0.0).ok();
        let of = |outside: Option<Outside>| match outside {
            Some(outside) => values(&outside, &cells, &frame, RELATIVE),
            None => vec![0.0; cells.len()],
        };
        let ground = of(black().and_then(|outside| outside.with_ground(1.0, PI).ok()));
        let skyline =
            of(black().filter(|_| altitude > 0.0).and_then(|outside| outside.with_skyline(altitude, 1.0).ok()));
        let samples = SkySamples::new(&cells, &frame, altitude, SPACING);
        Self { cells, frame, samples, ground, skyline, altitude }
    }

    /// Returns the cells of the aperture's hemisphere.
    pub const fn cells(&self) -> &RingBasis {
        &self.cells
    }

    /// Computes the illuminance on the aperture through every cell \[lx, or W/m² if `outside` is radiometric\]. `eyes`:
    /// points of the aperture, in the world's axes from the room's origin \[m\], over which obstructed sky and ground
    /// are averaged; empty for an outside that depends on directions alone.
    pub fn through(&self, outside: &Outside, eyes: &[DVec3]) -> Vec<f64> {
        let by_points = outside.surroundings().is_some()
            || outside.is_piecewise_constant()
            || outside.skyline_altitude() != self.altitude;
        if by_points {
            return match eyes {
                [] => self.by_points(outside),
                _ => self.over_eyes(outside, eyes),
            };
        }
        let mut open = Vec::with_capacity(self.samples.cells().len());
        self.samples.illuminances(outside, &mut open);
        let (ground, skyline) = (outside.ground_luminance(), outside.skyline_luminance());
        let even = self.ground.iter().zip(&self.skyline);
        let mut received: Vec<f64> = even.map(|(g, s)| ground * g + skyline * s).collect();
        self.samples.cells().iter().zip(open).for_each(|(&cell, e)| received[cell] += e);
        received
    }

    fn over_eyes(&self, outside: &Outside, eyes: &[DVec3]) -> Vec<f64> {
        let mut sum = vec![0.0; self.cells.len()];
        for eye in eyes {
            let seen = self.by_points(&outside.seen_from(*eye));
            sum.iter_mut().zip(seen).for_each(|(sum, e)| *sum += e / eyes.len() as f64);
        }
        sum
    }

    fn by_points(&self, outside: &Outside) -> Vec<f64> {
        let each = 1.0 / (POINTS * POINTS) as f64;
        let mean = |cell| {
            let of = |d: Dir<_>| outside.luminance(self.world(d.theta(), d.phi()));
            sub_directions(&cell, POINTS).map(of).sum::<f64>() * each * cell.projected_solid_angle()
        };
        self.cells.cells().map(mean).collect()
    }

    fn world(&self, theta: f64, phi: f64) -> Dir<World> {
        Dir::from_unit(self.frame.direction(theta, phi))
    }

    /// Returns cells of half the width, by which errors are estimated, and the illuminance through each of them by
    /// accurate integration \[lx, or W/m² if `outside` is radiometric\], at the point that `outside` is seen from, if
    /// it has one.
    pub fn judged(&self, outside: &Outside) -> (RingBasis, Vec<f64>) {
        let finer = self.cells.refined(2);
        let received = values(outside, &finer, &self.frame, JUDGED);
        (finer, received)
    }
}

/// Relative accuracy of the integration by which errors are estimated. Chosen: cost; smaller than the errors that it
/// serves to show.
const JUDGED: f64 = 1e-3;

fn values(outside: &Outside, cells: &RingBasis, frame: &Frame, relative: f64) -> Vec<f64> {
    incident_illuminances_within(outside, cells, frame, relative).into_iter().map(|e| e.value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::basis::AzimuthMap;
    use crate::compute::direction::{Orientation, Surface};
    use crate::compute::sky::Distribution;
    use crate::compute::surroundings::Surroundings;
    use crate::compute::surroundings::skyline::Skyline;
    use std::sync::Arc;

    fn received(surface: Surface, altitude: f64) -> Received {
        let frame = Frame::of_aperture(Orientation::new(Bearing::from_degrees(150.0)), surface);
        Received::new(RingBasis::klems_full(AzimuthMap::KLEMS_FRONT), frame, altitude)
    }

    fn sum(received: &Received, outside: &Outside, eyes: &[DVec3]) -> f64 {
        received.through(outside, eyes).iter().sum()
    }

    #[test]
    fn a_uniform_sky_gives_the_closed_forms() {
        // DHI 100, beam 300 on the horizontal plane, ρ = 0.2: a wall has half of sky and ground, a roof all sky.
        let outside = Outside::new(Distribution::uniform(), 100.0).unwrap().with_ground(0.2, 300.0).unwrap();
        let wall = sum(&received(Surface::Facade, 0.0), &outside, &[]);
        assert!((wall - 0.5 * (100.0 + 0.2 * 400.0)).abs() < 1e-4 * wall, "{wall}");
        let roof = sum(&received(Surface::Roof, 0.0), &outside, &[]);
        assert!((roof - 100.0).abs() < 1e-4 * roof, "{roof}");
        // Behind a dark skyline of altitude a: (1 − sin a)/2 … on a wall, ∫ sinθ cosθ over the rest of the azimuths.
        let altitude = 0.35_f64;
        let behind = outside.with_skyline(altitude, 0.0).unwrap();
        let wall = sum(&received(Surface::Facade, altitude), &behind, &[]);
        let sky = 100.0 / PI * (0.5 * PI - altitude - 0.5 * (2.0 * altitude).sin());
        assert!((wall - sky - 0.5 * 80.0).abs() < 1e-3 * wall, "{wall} {sky}");
    }

    #[test]
    fn a_clear_sky_is_gathered_as_by_integration() {
        for (altitude, turn) in [(0.3, 0.4), (1.0, -0.9), (0.7, 3.0)] {
            let sun = Dir::from_altitude_bearing(altitude, Bearing::from_radians(2.6 + turn));
            let outside =
                Outside::new(Distribution::cie(12, sun).unwrap(), 80.0).unwrap().with_ground(0.3, 200.0).unwrap();
            for surface in [Surface::Facade, Surface::Roof] {
                let received = received(surface, 0.0);
                let (own, judged) = (sum(&received, &outside, &[]), received.judged(&outside).1.iter().sum::<f64>());
                assert!((own / judged - 1.0).abs() < 2e-3, "{surface:?} {altitude}: {own} {judged}");
            }
        }
    }

    #[test]
    fn what_stands_before_it_takes_its_part() {
        let skyline = Skyline::new([[0.0, 0.2], [2.0, 0.5], [4.0, 0.1]], 20.0).unwrap();
        let around = Surroundings::dark(Vec::new(), Some(skyline));
        let outside = Outside::new(Distribution::uniform(), 100.0).unwrap().behind(Arc::new(around));
        let received = received(Surface::Facade, 0.0);
        let (own, judged) = (sum(&received, &outside, &[]), received.judged(&outside).1.iter().sum::<f64>());
        assert!((own / judged - 1.0).abs() < 0.01, "{own} {judged}");
    }
}
