//! Methods for the direct illuminance of a sensor by an aperture (eq 17), for selection and comparison.
//!
//! The default method is [`NearField::SolidAngle`]: [`super::direct`] with the closed forms of [`super::cell_weights`]
//! and the error-controlled cubature of [`super::through`]. The others are common in other programs, included so that
//! their error and run time can be compared with it: point luminaires ([`subdivision`]), Monte Carlo ([`monte_carlo`])
//! and summed-area tables over two profile angles ([`profile_table`]). They integrate the diffuse light and the
//! scattered sun; direct sun has no luminance that could be sampled and is computed exactly in all of them.

pub mod homogeneity;
mod kernel;
pub mod monte_carlo;
pub mod profile_table;
pub mod subdivision;

use super::aperture::Aperture;
use super::band_weights::BandWeights;
use super::direct::{self, DirectLight, Reception, Sensor};
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Emergent};
use crate::compute::estimate::Estimate;
use crate::compute::lid::{Emission, Facing, Lid};
use crate::compute::quadrature::Tolerance;
use glam::DVec3;
use profile_table::ProfileTable;

/// Method for the direct illuminance of a sensor by an aperture (integral of eq 17).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NearField {
    /// Default: closed forms for luminances on emergent cells, error-controlled cubature for the outside seen through
    /// the aperture.
    #[default]
    SolidAngle,
    /// Division of the aperture into point luminaires: `Some([m, n])` of them along x_F and y_F; with `None` the
    /// aperture is divided until every part is at least five times its largest dimension (the photometric distance)
    /// away from the sensor.
    Subdivision(Option<[usize; 2]>),
    /// Monte Carlo integration with this number of random directions, uniform over the solid angle of the aperture.
    MonteCarlo(usize),
    /// Summed-area tables with this number of cells along each of two profile angles.
    ProfileTable(usize),
}

impl NearField {
    /// Returns the key of the method in scene files and results.
    pub const fn word(self) -> &'static str {
        match self {
            Self::SolidAngle => "solid-angle",
            Self::Subdivision(_) => "subdivision",
            Self::MonteCarlo(_) => "monte-carlo",
            Self::ProfileTable(_) => "profile-table",
        }
    }

    /// Returns a short English description of the method with its effort, for reports.
    pub fn effort(self) -> String {
        match self {
            Self::SolidAngle => "closed forms on cells, adaptive cubature where the outside is seen through".into(),
            Self::Subdivision(None) => "point luminaires, distance ≥ 5 × largest dimension".into(),
            Self::Subdivision(Some([m, n])) => format!("{m} × {n} point luminaires"),
            Self::MonteCarlo(samples) => format!("{samples} random points a sensor"),
            Self::ProfileTable(cells) => format!("tables of {cells} × {cells} cells"),
        }
    }
}

/// Computation of the direct illuminance by one aperture with a given emission, by one of the methods.
pub struct Integrator<'a> {
    method: NearField,
    aperture: &'a Aperture,
    emission: &'a Emission,
    facing: &'a Facing<'a>,
    lid: Lid,
    /// Relative error of the luminous exitance of the aperture.
    relative_error: f64,
    /// Tables of the full and of half the resolution, for [`NearField::ProfileTable`] alone.
    tables: Option<[ProfileTable; 2]>,
    tolerance: Tolerance,
}

impl<'a> Integrator<'a> {
    /// Prepares the quantities that a method computes once for all sensors. `tolerance` is used by
    /// [`NearField::SolidAngle`] alone.
    pub fn new(
        method: NearField,
        aperture: &'a Aperture,
        emission: &'a Emission,
        facing: &'a Facing<'a>,
        tolerance: Tolerance,
    ) -> Self {
        let lid = emission.lid(facing, aperture.size);
        let exitance = emission.exitance(facing);
        let relative_error = if exitance.value > 0.0 { exitance.error / exitance.value } else { 0.0 };
        let tables = if let NearField::ProfileTable(cells) = method {
            let luminance = |undeviated: Dir<_>| lid.luminance(Emergent::from_undeviated(undeviated));
            Some([cells, cells.div_ceil(2)].map(|n| ProfileTable::new(n, luminance)))
        } else {
            None
        };
        Self { method, aperture, emission, facing, lid, relative_error, tables, tolerance }
    }

    /// Computes the direct illuminance of a sensor by the aperture, sun included. \[lx\] The error is the estimate of
    /// the method, described in its module.
    pub fn illuminance(&self, sensor: &Sensor) -> DirectLight {
        if self.method == NearField::SolidAngle {
            let on = |basis: Option<&RingBasis>| Reception::new(sensor, self.aperture, basis);
            let mut receptions: Vec<Reception> =
                self.emission.cells.iter().map(|light| on(Some(&*light.basis))).collect();
            if receptions.is_empty() {
                receptions.push(on(None));
            }
            let receptions: Vec<&Reception> = receptions.iter().collect();
            let view = self.aperture.view(sensor.position, sensor.normal);
            let bands = self.emission.bands.first().zip(view);
            let bands = bands.map(|(bands, view)| BandWeights::new(&view, bands.light.upright, bands.light.q.len()));
            let (light, facing) = (self.emission, self.facing);
            return direct::illuminance(
                sensor,
                self.aperture,
                &receptions,
                bands.as_ref(),
                light,
                facing,
                self.tolerance,
            );
        }
        let Some(view) = self.aperture.view(sensor.position, sensor.normal) else {
            return DirectLight::default();
        };
        let luminance = |to: DVec3| {
            Dir::new(to).map_or(0.0, |undeviated| self.lid.luminance(Emergent::from_undeviated(undeviated)))
        };
        let diffuse = match (self.method, &self.tables) {
            (NearField::Subdivision(Some(parts)), _) => subdivision::fixed(&view, parts, luminance),
            (NearField::Subdivision(None), _) => subdivision::by_distance(&view, luminance),
            (NearField::MonteCarlo(samples), _) => {
                monte_carlo::illuminance(&view, samples, monte_carlo::seed(sensor, self.aperture), luminance)
            }
            (_, Some([fine, coarse])) => profile_table::illuminance(&view, fine, coarse),
            (_, None) => Estimate::default(),
        };
        let beams = direct::beams_through(sensor, self.aperture, &self.emission.beams, self.facing);
        let rounding = 1e-12 * (diffuse.value + beams.beam).abs();
        let error = self.relative_error * diffuse.value.abs() + rounding;
        DirectLight { all: diffuse + beams.all + Estimate::new(0.0, error), ..beams }
    }
}
