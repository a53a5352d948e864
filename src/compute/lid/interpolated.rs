//! Light that an aperture emits if the data of its system are indicatrices at single incident directions: light of sky
//! and ground from sub-patches finer than the spacing of these directions, and of the sun from its exact direction,
//! each with an interpolated indicatrix.

use super::{BeamLight, BeamSource, CellLight, Emission, Facing};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Btdf, Indicatrices};
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::Estimate;
use crate::compute::incidence::filter::{self, Filter, Kernel};
use crate::compute::incidence::grid::Grid;
use crate::compute::incidence::model::Model;
use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
use crate::compute::incidence::superpose::{self, CellLuminance, REST};
use crate::compute::sky::{Frame, incident_illuminances_within};
use std::f64::consts::PI;
use std::sync::Arc;

/// Minimum and maximum width of the sub-patches of sky and ground, which have the width of the lobes' standard
/// deviation (a lobe's diameter is 7 of them). Wider ones would be visible as rings behind narrow lobes. \[rad\]
/// Chosen: cost at the minimum, 13 000 sub-patches; at the maximum a uniform sky stays uniform within 3 % (the test
/// `incidence::tests::a_uniform_outside_through_a_clear_opening_stays_uniform`).
const SUB_PATCH: [f64; 2] = [1.25 * PI / 180.0, 2.5 * PI / 180.0];
/// Number of emergent cells across a lobe below which cells under the sun are divided, down to [`SUN_CELL`]: two per
/// standard deviation of a lobe whose diameter is 7 of them.
const ACROSS: f64 = 14.0;
/// Minimum width of divided emergent cells under the sun. \[rad\] Chosen: cost, 12 000 cells; what division changes is
/// stated as uncertainty.
const SUN_CELL: f64 = 1.3 * PI / 180.0;
/// Number of points per side of a cell at which a lobe is evaluated under the sun.
const SUN_POINTS: usize = 2;

/// Returns the emergent cells for scattered sunlight: those of the data, divided where they are wide compared with the
/// lobes.
fn sun_grid(model: &Model) -> Grid {
    let basis = model.grid().basis();
    let mean = (2.0 * PI / basis.len() as f64).sqrt();
    // Wide lobes need only a few cells across.
    let needed = (ACROSS * mean / model.narrowest_lobe()).min(mean / SUN_CELL);
    let parts = needed.ceil().clamp(1.0, 4.0) as usize;
    if parts == 1 { model.grid().clone() } else { Grid::new(&basis.refined(parts)) }
}

/// Interpolation model of one set of indicatrices with the emergent cells for scattered sunlight, independent of sky
/// and sun.
pub struct Interpolator {
    model: Model,
    sun_grid: Grid,
}

impl Interpolator {
    /// Creates the interpolation model of measured indicatrices.
    pub fn new(data: Arc<Indicatrices>) -> Self {
        let model = Model::new(data);
        Self { sun_grid: sun_grid(&model), model }
    }

    /// Returns the memory that its lobes take. \[bytes\]
    pub fn bytes(&self) -> usize {
        self.model.bytes()
    }

    /// Returns the emergent cells for scattered sunlight, which subdivide those of the data.
    pub fn sun_grid(&self) -> &Grid {
        &self.sun_grid
    }

    /// Returns the interpolation model of the indicatrices.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Computes the illuminance of the aperture by sky and ground, and the luminance of its room side by a scheme, with
    /// a note on the method.
    fn diffuse(&self, scheme: DiffuseScheme, facing: &Facing<'_>) -> (Estimate, CellLuminance, String) {
        let model = self.model();
        let frame = Frame::of_aperture(facing.orientation, facing.surface);
        let received = |cells: &RingBasis| {
            let received = incident_illuminances_within(facing.outside, cells, &frame, 1e-4);
            let values: Vec<f64> = received.iter().map(|e| e.value).collect();
            (received.into_iter().sum::<Estimate>(), values)
        };
        let kernel = match scheme {
            DiffuseScheme::Auto | DiffuseScheme::Shift => None,
            DiffuseScheme::Patch => Some(Kernel::None),
            DiffuseScheme::FilterNarrow => Some(Kernel::NARROW),
            DiffuseScheme::FilterMatched => Some(Kernel::MATCHED),
            DiffuseScheme::FilterWide => Some(Kernel::WIDE),
            DiffuseScheme::FilterPatch => Some(Kernel::Patch),
        };
        if let (Some(kernel), Some(lattice)) = (kernel, model.lattice_cells()) {
            let (total, values) = received(lattice);
            let filter = Filter { kernel, sharp_only: kernel == Kernel::Patch };
            if let Some(luminance) = filter::diffuse(model, filter, model.grid(), &values) {
                let light = CellLuminance { luminance, ..CellLuminance::dark(model.grid().basis().len()) };
                return (total, light, format!("{}, as asked for; what it costs is not estimated", scheme.key()));
            }
        }
        let step = (model.narrowest_lobe() / 5.6).clamp(SUB_PATCH[0], SUB_PATCH[1]);
        let patches = superpose::sub_patches(step);
        let (total, values) = received(&patches);
        if total.value <= 0.0 {
            return (total, CellLuminance::dark(model.grid().basis().len()), "no diffuse light".into());
        }
        let note = match kernel {
            None => format!("sub-patches of {:.1}°, each with its own indicatrix", step.to_degrees()),
            Some(_) => {
                format!("sub-patches: the data's directions do not form the lattice that {} is made for", scheme.key())
            }
        };
        (total, superpose::diffuse(model, &patches, &values), note)
    }

    /// Computes the luminance of the room side under the sun by a scheme, with a note on the method. `illuminance`: of
    /// the aperture by the sun \[lx\].
    fn sun(&self, scheme: SunScheme, direction: Dir<Facade>, illuminance: f64) -> (CellLuminance, String) {
        let model = self.model();
        let mut light = superpose::sun(model, direction, illuminance, &self.sun_grid, SUN_POINTS);
        if scheme != SunScheme::Responses {
            let q = scheme.coefficient(model, direction, &self.sun_grid, SUN_POINTS);
            let other: Vec<f64> = q.iter().map(|q| q * illuminance).collect();
            light.shifts.push(light.luminance.iter().zip(&other).map(|(a, b)| a - b).collect());
            light.luminance = other;
        }
        let text = "`cfs accuracy` reports what leaving out each direction costs";
        let note = match (scheme, model.lattice().locate(direction).triangle) {
            (SunScheme::Responses, Some(_)) => format!("responses (lobes moved by their own neighbours); {text}"),
            (SunScheme::Responses, None) => "beyond the last row of incident directions: as on its border".into(),
            _ => format!("{}, as asked for; {text}", scheme.key()),
        };
        (light, note)
    }
}

impl Emission {
    /// Computes the light that the room side of an aperture emits, with indicatrices interpolated between the incident
    /// directions of the data by a scheme for the sun and one for diffuse light.
    pub fn interpolated(
        btdf: &Btdf,
        interpolator: &Interpolator,
        (sun_scheme, diffuse_scheme): (SunScheme, DiffuseScheme),
        facing: &Facing<'_>,
    ) -> Self {
        let incident_sun = facing.sun_illuminance();
        let (incident_diffuse, diffuse, note) = interpolator.diffuse(diffuse_scheme, facing);
        let mut notes = vec![format!("diffuse light: {note}")];
        let own = interpolator.model().grid();
        let (grid, diffuse, sun) = match facing.sun_entering().filter(|_| incident_sun > 0.0) {
            Some(direction) => {
                let (light, note) = interpolator.sun(sun_scheme, direction, incident_sun);
                notes.push(format!("sun: {note}"));
                (&interpolator.sun_grid, diffuse.on(own, &interpolator.sun_grid), light)
            }
            None => (own, diffuse, CellLuminance::dark(own.basis().len())),
        };
        let relative = if incident_diffuse.value > 0.0 { incident_diffuse.error / incident_diffuse.value } else { 0.0 };
        let mut uncertainties = sun.shifts;
        uncertainties.push(diffuse.uncertainty.iter().zip(&sun.uncertainty).map(|(a, b)| a + b).collect());
        let cells = CellLight {
            basis: Arc::new(grid.basis().clone()),
            diffuse: diffuse.luminance,
            sun: sun.luminance,
            uncertainties,
            relative_error: relative + REST,
        };
        Self {
            uniform: Estimate::default(),
            cells: vec![cells],
            bands: Vec::new(),
            regular: btdf.regular.clone(),
            lamps: None,
            beams: BeamLight::regular(btdf.regular.as_ref(), facing).into_iter().collect(),
            incident_diffuse,
            incident_sun,
            beam_source: if incident_sun > 0.0 { BeamSource::Cells } else { BeamSource::None },
            notes,
        }
    }
}
