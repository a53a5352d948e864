//! Direct component: what arrives at a sensor straight from an aperture (eq 17), each part of the emission by its own
//! exact or error-controlled way.

use super::aperture::Aperture;
use super::cell_weights::for_each_cell;
use super::through;
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Estimate;
use crate::compute::lid::{Emission, Facing};
use crate::compute::polygon::projected_solid_angle;
use crate::compute::quadrature::Tolerance;
use crate::compute::sky::sun_disc::{self, Edge};
use glam::DVec3;

/// A point that receives light from in front of its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Room frame. \[m\]
    pub position: DVec3,
    /// Unit vector.
    pub normal: DVec3,
}

/// What a sensor receives from one aperture per luminance, from geometry alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Reception {
    /// Projected solid angle of the whole opening. \[sr\]
    pub uniform: f64,
    /// The same by emergent cell; empty where no cells are asked for. \[sr\]
    pub cells: Vec<f64>,
}

impl Reception {
    /// For a sensor and an aperture whose light lies on the cells of `basis`.
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

/// Illuminance at a sensor from one aperture, sun included. \[lx\]
pub fn illuminance(
    sensor: &Sensor,
    aperture: &Aperture,
    reception: &Reception,
    emission: &Emission,
    facing: &Facing<'_>,
    tolerance: Tolerance,
) -> Estimate {
    let mut sum = emission.uniform * reception.uniform;
    if let Some(light) = &emission.cells {
        let e: f64 =
            reception.cells.iter().zip(light.diffuse.iter().zip(&light.sun)).map(|(w, (d, s))| w * (d + s)).sum();
        let at_sensor = |doubt: &Vec<f64>| reception.cells.iter().zip(doubt).map(|(w, l)| w * l).sum::<f64>();
        let doubt = light.doubts.iter().map(|doubt| at_sensor(doubt).powi(2)).sum::<f64>().sqrt();
        sum += Estimate::new(e, e * light.relative_error + doubt);
    }
    if let Some(tau) = &emission.regular {
        if let Some(view) = aperture.view(sensor.position, sensor.normal) {
            sum += through::illuminance(&view, facing, tau, tolerance);
        }
        sum += Estimate::exact(sun_through(sensor, aperture, emission, facing));
    }
    // Rounding of the closed forms and of the weights' sums.
    Estimate::new(sum.value.max(0.0), sum.error + 1e-9 * sum.value.abs())
}

/// Unscattered sun at a sensor: the share of the disc seen through the opening. \[lx\]
pub fn sun_through(sensor: &Sensor, aperture: &Aperture, emission: &Emission, facing: &Facing<'_>) -> f64 {
    let Some(sun) = facing.sun.filter(|_| emission.beam_tau > 0.0) else {
        return 0.0;
    };
    let direction = facing.orientation.room_from_world(sun.direction).vector();
    let corners = aperture.corners().map(|corner| corner - sensor.position);
    let outward = aperture.surface.room_from_facade(DVec3::Z);
    if outward.dot(corners[0]) <= 0.0 {
        return 0.0;
    }
    let mut edges = sun_disc::opening(&corners);
    edges.push(Edge::great_circle(outward));
    edges.push(Edge::great_circle(sensor.normal));
    edges.push(Edge { normal: DVec3::Z, offset: facing.outside.skyline_altitude().sin() });
    emission.beam_tau * sun.direct_normal * sun_disc::share(direction, sensor.normal, edges)
}
