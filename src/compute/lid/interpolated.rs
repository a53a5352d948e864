//! What an aperture emits when the data are known at single incident directions only: sky and ground in sub-patches
//! finer than these directions, the sun exactly where it is, each through an interpolated indicatrix.

use super::{CellLight, Emission, Facing};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::Btdf;
use crate::compute::estimate::Estimate;
use crate::compute::incidence::grid::Grid;
use crate::compute::incidence::model::Model;
use crate::compute::incidence::superpose;
use crate::compute::sky::{Frame, incident_illuminances_within};
use std::f64::consts::PI;
use std::sync::Arc;

/// Width of the sub-patches of sky and ground. \[rad\]
const SUB_PATCH: f64 = 2.5 * PI / 180.0;
/// Emergent cells under the sun are cut where a lobe has fewer than this across ...
const ACROSS: f64 = 14.0;
/// ... but not below this width. \[rad\]
const SUN_CELL: f64 = 1.3 * PI / 180.0;
/// Points a side of a cell at which a lobe of the sun is taken.
const SUN_POINTS: usize = 2;
/// What interpolation between the incident directions leaves after its own doubts, relative; seen on analytic systems.
const REST: f64 = 4e-3;

/// The emergent cells that the sun's light is put on: the data's own, cut where they are wide.
pub fn sun_grid(model: &Model) -> Grid {
    let basis = model.grid().basis();
    let mean = (2.0 * PI / basis.len() as f64).sqrt();
    // Wide lobes need no more than some cells across.
    let needed = (ACROSS * mean / model.narrowest_lobe()).min(mean / SUN_CELL);
    let parts = needed.ceil().clamp(1.0, 4.0) as usize;
    if parts == 1 { model.grid().clone() } else { Grid::new(&basis.refined(parts)) }
}

impl Emission {
    /// What the room side of a system emits, interpolated between its incident directions.
    /// `sun_grid` is [`sun_grid`] of the model.
    pub fn interpolated(btdf: &Btdf, model: &Model, sun_grid: &Grid, facing: &Facing<'_>) -> Self {
        let frame = Frame::of_aperture(facing.orientation, facing.surface);
        let incident_sun = facing.sun_illuminance();
        let sun = facing.sun_direction().filter(|_| incident_sun > 0.0);
        let patches = superpose::sub_patches(SUB_PATCH);
        let illuminance = incident_illuminances_within(facing.outside, &patches, &frame, 1e-4);
        let incident_diffuse: Estimate = illuminance.iter().copied().sum();
        let values: Vec<f64> = illuminance.iter().map(|e| e.value).collect();
        let diffuse = if incident_diffuse.value > 0.0 {
            superpose::diffuse(model, &patches, &values)
        } else {
            superpose::Light::dark(model.grid().basis().len())
        };
        let mut emission = Self {
            uniform: Estimate::default(),
            cells: None,
            regular: btdf.regular.clone(),
            beam_tau: 0.0,
            incident_diffuse,
            incident_sun,
        };
        let basis: Arc<RingBasis>;
        let (light, sunlight) = match sun {
            Some(direction) => {
                if let Some(tau) = &btdf.regular {
                    emission.beam_tau = tau.at(direction.theta().min(0.5 * PI));
                }
                basis = Arc::new(sun_grid.basis().clone());
                let light = superpose::sun(model, direction, incident_sun, sun_grid, SUN_POINTS);
                (diffuse.on(model.grid(), sun_grid), light)
            }
            None => {
                basis = Arc::new(model.grid().basis().clone());
                let dark = superpose::Light::dark(basis.len());
                (diffuse, dark)
            }
        };
        let relative = if incident_diffuse.value > 0.0 { incident_diffuse.error / incident_diffuse.value } else { 0.0 };
        emission.cells = Some(CellLight {
            basis,
            doubtful: light.doubt.iter().zip(&sunlight.doubt).map(|(a, b)| a + b).collect(),
            diffuse: light.luminance,
            sun: sunlight.luminance,
            relative_error: relative + REST,
        });
        emission
    }
}
