//! Direct component: illuminance of a sensor by an aperture without reflection in the room (eq 17), each component of
//! the aperture's emission by an exact or error-controlled method.

use super::aperture::{Aperture, View};
use super::band_weights::BandWeights;
use super::cell_weights::for_each_cell;
use super::through;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::estimate::Estimate;
use crate::compute::lid::{BeamLight, Emission, Facing};
use crate::compute::polygon::projected_solid_angle;
use crate::compute::quadrature::Tolerance;
use crate::compute::sky::SUN_HALF_ANGLE;
use crate::compute::sky::sun_disc::{self, Edge};
use glam::DVec3;

/// Sensor point: position and normal of a plane whose illuminance is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Position of the sensor in the room's frame. \[m\]
    pub position: DVec3,
    /// Unit normal of the sensor in the room's frame.
    pub normal: DVec3,
}

/// Projected solid angles of one aperture as seen from a sensor: its illuminance per luminance of the aperture, from
/// geometry alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Reception {
    /// Projected solid angle of the whole aperture. \[sr\]
    pub uniform: f64,
    /// Projected solid angle of the aperture by emergent cell; empty without a basis. \[sr\]
    pub cells: Vec<f64>,
}

impl Reception {
    /// Computes the projected solid angles of an aperture whose luminance is given on the cells of `basis`, seen from a
    /// sensor.
    pub fn new(sensor: &Sensor, aperture: &Aperture, basis: Option<&RingBasis>) -> Self {
        let mut cells = vec![0.0; basis.map_or(0, RingBasis::len)];
        let mut uniform = 0.0;
        if let Some(view) = aperture.view(sensor.position, sensor.normal) {
            uniform = projected_solid_angle(&view.corners(), view.normal);
            if let Some(basis) = basis {
                for_each_cell(&view, basis, |cell, weight| cells[cell] += weight);
            }
        }
        Self { uniform, cells }
    }
}

/// Direct component of the illuminance of a sensor by one aperture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DirectLight {
    /// Illuminance by all light from the aperture, with the error of the computation. \[lx\]
    pub all: Estimate,
    /// Part of the illuminance by beams of direct sun. \[lx\]
    pub beam: f64,
    /// Uncertainty of the illuminance by the data of the system. \[lx\]
    pub data_error: f64,
}

impl std::ops::AddAssign for DirectLight {
    fn add_assign(&mut self, other: Self) {
        self.all += other.all;
        self.beam += other.beam;
        self.data_error += other.data_error;
    }
}

/// Relative error of the illuminance by the width of the bands of the profile angle; found for matt slats by comparison
/// with exact integrals along them. No test of its own.
const BAND_ERROR: f64 = 1e-3;

/// Computes the direct illuminance of a sensor by one aperture, sun included. \[lx\] `receptions`: projected solid
/// angles for every component of the emission on cells, the first of them also for the Lambertian component; `weights`:
/// projected solid angles of the bands of the profile angle.
pub fn illuminance(
    sensor: &Sensor,
    aperture: &Aperture,
    receptions: &[&Reception],
    weights: Option<&BandWeights>,
    emission: &Emission,
    facing: &Facing<'_>,
    tolerance: Tolerance,
) -> DirectLight {
    let mut sum = emission.uniform * receptions.first().map_or(0.0, |reception| reception.uniform);
    let mut data_error = 0.0;
    for (light, reception) in emission.cells.iter().zip(receptions) {
        let e: f64 =
            reception.cells.iter().zip(light.diffuse.iter().zip(&light.sun)).map(|(w, (d, s))| w * (d + s)).sum();
        let at_sensor =
            |uncertainty: &Vec<f64>| reception.cells.iter().zip(uncertainty).map(|(w, l)| w * l).sum::<f64>();
        data_error += light.uncertainties.iter().map(|uncertainty| at_sensor(uncertainty).powi(2)).sum::<f64>().sqrt();
        sum += Estimate::new(e, e * light.relative_error);
    }
    for (bands, weights) in emission.bands.iter().zip(weights.into_iter().cycle()) {
        let part = weights.of(&bands.light.q) * bands.illuminance;
        let share = bands.light.share();
        let relative = if share > 0.0 { bands.light.error / share } else { 0.0 };
        sum += Estimate::new(part, part * (relative + BAND_ERROR));
    }
    if let (Some(tau), Some(view)) = (&emission.regular, aperture.view(sensor.position, sensor.normal)) {
        let seen = seen_through(&view, facing, tau, tolerance);
        sum += seen.all;
        data_error += seen.data_error;
    }
    if let Some(lamps) = &emission.lamps {
        // No error for the division into parts: the result of the host program's method is asked for.
        sum += Estimate::exact(lamps.illuminance(sensor.position, sensor.normal));
    }
    let beams = beams_through(sensor, aperture, &emission.beams, facing);
    sum += beams.all;
    // Rounding of the closed forms and of the weights' sums.
    let rounding = aperture.rounding(sensor.position).max(1e-9);
    let all = Estimate::new(sum.value.max(0.0), sum.error + rounding * sum.value.abs());
    DirectLight { all, beam: beams.beam, data_error: data_error + beams.data_error }
}

/// Computes the illuminance of a sensor by sky, ground and obstructions seen through an aperture by regular
/// transmission, without direct sun. \[lx\]
pub fn seen_through(view: &View, facing: &Facing<'_>, tau: &AngularTransmittance, tolerance: Tolerance) -> DirectLight {
    let data_error =
        if tau.is_estimated() { tau.uncertainty_of_light(&through::by_degrees(view, facing)) } else { 0.0 };
    DirectLight { all: through::illuminance(view, facing, tau, tolerance), beam: 0.0, data_error }
}

/// Computes the illuminance of a sensor by beams of direct sun through an aperture, with the penumbra by the sun's
/// diameter. \[lx\]
pub fn beams_through(sensor: &Sensor, aperture: &Aperture, beams: &[BeamLight], facing: &Facing<'_>) -> DirectLight {
    let Some(view) = aperture.view(sensor.position, sensor.normal).filter(|_| !beams.is_empty()) else {
        return DirectLight::default();
    };
    let corners = view.corners();
    let mut opening: Option<Vec<Edge>> = None;
    let (mut sum, mut data_error) = (Estimate::default(), 0.0);
    for beam in beams {
        let e = match clearly_seen(&view, beam.to.vector()) {
            Some(false) => continue,
            Some(true) if !beam.straight => view.normal.dot(beam.to.vector()),
            _ => {
                let edges = opening.get_or_insert_with(|| {
                    let mut edges = sun_disc::opening(&corners);
                    edges.push(Edge::great_circle(DVec3::Z));
                    edges.push(Edge::great_circle(view.normal));
                    edges
                });
                let outside = if beam.straight { Some(facing.sun_edges()[0]) } else { None };
                sun_disc::share(beam.to.vector(), view.normal, edges.iter().copied().chain(outside))
            }
        };
        let e = beam.normal * e;
        sum += Estimate::new(e, e * beam.error);
        data_error += e * beam.uncertainty;
    }
    DirectLight { all: sum, beam: sum.value, data_error }
}

/// Whether the sensor sees the whole disc of a beam through the aperture (`true`) or nothing of it; `None` if an edge
/// may cut the disc.
fn clearly_seen(view: &View, to: DVec3) -> Option<bool> {
    // Half angle of the sun's disc and 5 % for higher orders, which is enough up to 88.8° from the opening's normal. On
    // the opening's plane the disc's ellipse reaches no farther than this from its middle.
    const REACH: f64 = 1.05 * SUN_HALF_ANGLE;
    let facing = view.normal.dot(to);
    if to.z <= 2.0 * REACH || facing.abs() <= REACH {
        return None;
    }
    if facing < 0.0 {
        return Some(false);
    }
    let [x, y] = [to.x, to.y].map(|c| c / to.z * view.distance);
    let reach = view.distance * REACH / (to.z * to.z) * (1.0 + REACH / to.z);
    let inside = |at: f64, [low, high]: [f64; 2]| at > low + reach && at < high - reach;
    let outside = |at: f64, [low, high]: [f64; 2]| at < low - reach || at > high + reach;
    if outside(x, view.x) || outside(y, view.y) {
        Some(false)
    } else if inside(x, view.x) && inside(y, view.y) {
        Some(true)
    } else {
        None
    }
}
