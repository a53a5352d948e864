//! Direct sun through a described system, whose transmission is computed for single directions: beams and scattered
//! light.

use super::disc_beams::{FEW, cosine, disc, sun_beams};
use super::{BandLight, BeamLight, BeamSource, CellLight, Emission, Facing};
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use crate::compute::incidence::superpose::sub_patches;
use crate::compute::sky::SUN_HALF_ANGLE;
use crate::compute::system::measure::{OpticalModel, ProfileLight, ScatteredLight, Side};
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Width of the cells for scattered sunlight. \[rad\] Chosen: cost, 2300 cells; the error is [`CELL_ERROR`].
const CELL: f64 = 3.0 * PI / 180.0;
/// Relative error of illuminances on planes across the room by the size of these cells of 3°. Found for matt slats
/// against strips in closed form: 0.1 % there, up to 0.8 % for sensors that see the aperture at grazing angles.
const CELL_ERROR: f64 = 3e-3;
/// Cosine of incidence below which scattering differs over the profile angles that the sun's disc covers. At it the
/// disc of 0.53° covers 0.53°/0.3 = 1.8° at most, two of the bands of 1°.
const GRAZING: f64 = 0.3;
/// Relative error of the mean of scattered light over [`FEW`] pairs of directions, times the square of the cosine of
/// incidence over the disc's radius. Found for panes before slats, opal and woven sheets against 48 pairs: 0.15 … 0.39
/// between 74° and 88.5°; held by the test `few_directions_stand_for_the_disc_within_their_error`.
const FEW_ERROR: f64 = 0.4;

/// Returns the emergent cells of 3° for the light of described systems. They are the same for all systems, so that the
/// weights of sensors for them are computed once.
pub fn sun_cells() -> &'static Arc<RingBasis> {
    static CELLS: OnceLock<Arc<RingBasis>> = OnceLock::new();
    CELLS.get_or_init(|| Arc::new(sub_patches(CELL)))
}

/// Returns the directions of the sun's disc over which scattered light is averaged: several at grazing incidence,
/// otherwise its centre.
fn standing_for(facing: &Facing<'_>, sun: Dir<Facade>) -> Vec<Dir<Facade>> {
    if sun.vector().z < GRAZING { disc(facing, sun, FEW) } else { vec![sun] }
}

/// Returns the relative error of scattered light by its mean over [`standing_for`], for the middle of the sun's disc.
fn averaging_error(sun: Dir<Facade>) -> f64 {
    if sun.vector().z < GRAZING { (FEW_ERROR * (SUN_HALF_ANGLE / cosine(sun)).powi(2)).min(1.0) } else { 0.0 }
}

/// Computes the sunlight that a system scatters into the room, by emergent profile angle; `None` if it does not depend
/// on a profile angle alone.
fn by_profile(model: &dyn OpticalModel, facing: &Facing<'_>) -> Option<BandLight> {
    let illuminance = facing.sun_illuminance();
    let sun = facing.sun_direction().filter(|_| illuminance > 0.0)?;
    let directions = standing_for(facing, sun);
    let cosines: f64 = directions.iter().map(|direction| direction.vector().z.max(0.0)).sum();
    let mut mean: Option<ProfileLight> = None;
    for direction in &directions {
        let weight = direction.vector().z.max(0.0) / cosines;
        let own = model.profile_light(*direction, Side::Front)?;
        let sum = mean.get_or_insert_with(|| ProfileLight { q: vec![0.0; own.q.len()], error: 0.0, ..own });
        sum.q.iter_mut().zip(&own.q).for_each(|(sum, q)| *sum += weight * q);
        sum.error += weight * own.error;
    }
    let mut light = mean?;
    if directions.len() > 1 {
        // Near grazing incidence the disc covers several degrees of profile angle: a few directions represent it.
        let middle = model.profile_light(sun, Side::Front)?;
        light.error += middle.difference(&light);
    }
    Some(BandLight { light, illuminance })
}

/// Returns q \[1/sr\] on [`sun_cells`] of the light that a described system scatters into the room from the incident
/// direction `direction`, and its relative error.
pub fn scattered_of(model: &dyn OpticalModel, direction: Dir<Facade>) -> (Vec<f64>, f64) {
    let light = model.scattered_through(direction, Side::Front, sun_cells());
    let share: f64 = light.transmitted.iter().zip(sun_cells().projected_solid_angles()).map(|(q, w)| q * w).sum();
    let relative = if share > 0.0 { light.error / share } else { 0.0 };
    (light.transmitted, relative + CELL_ERROR)
}

/// Computes the luminance on [`sun_cells`] by sunlight that a system scatters into the room; `None` if it scatters
/// nothing.
fn scattered(model: &dyn OpticalModel, facing: &Facing<'_>) -> Option<CellLight> {
    let incident = facing.sun_illuminance();
    let sun = facing.sun_direction().filter(|_| incident > 0.0)?;
    let cells = sun_cells();
    let directions = standing_for(facing, sun);
    let lights: Vec<(ScatteredLight, f64)> = directions
        .iter()
        .map(|direction| (model.scattered_through(*direction, Side::Front, cells), cosine(*direction)))
        .collect();
    let cosines: f64 = lights.iter().map(|(_, cosine)| cosine).sum();
    let mut luminance = vec![0.0; cells.len()];
    let mut error = 0.0;
    for (light, cosine) in &lights {
        let weight = incident * cosine / cosines;
        error += light.error * weight;
        luminance.iter_mut().zip(&light.transmitted).for_each(|(sum, q)| *sum += q * weight);
    }
    let total: f64 = luminance.iter().zip(cells.projected_solid_angles()).map(|(l, w)| l * w).sum();
    (total > 0.0).then(|| CellLight {
        basis: Arc::clone(cells),
        diffuse: vec![0.0; cells.len()],
        sun: luminance,
        uncertainties: Vec::new(),
        relative_error: error / total + CELL_ERROR + averaging_error(sun),
    })
}

/// Sunlight behind a described system for one position of the sun: beams and scattered light. It can be reused until
/// the sun moves.
pub struct SunThrough {
    illuminance: f64,
    beams: Vec<BeamLight>,
    bands: Option<BandLight>,
    cells: Option<CellLight>,
}

impl SunThrough {
    /// Computes the beams and the scattered light behind a described system for the sun in `facing`.
    pub fn new(model: &dyn OpticalModel, facing: &Facing<'_>) -> Self {
        let bands = by_profile(model, facing);
        let cells = if bands.is_none() { scattered(model, facing) } else { None };
        Self { illuminance: facing.sun_illuminance(), beams: sun_beams(model, facing), bands, cells }
    }

    /// Returns the memory that its luminances take. \[bytes\]
    pub fn bytes(&self) -> usize {
        let cells = self.cells.iter();
        let cells = cells.flat_map(|light| [&light.diffuse, &light.sun].into_iter().chain(&light.uncertainties));
        let bands = self.bands.iter().map(|bands| &bands.light.q);
        size_of_val(&self.beams[..]) + cells.chain(bands).map(|values| size_of_val(&values[..])).sum::<usize>()
    }

    /// Computes the beams behind a described system without its scattered light.
    pub fn beams_alone(model: &dyn OpticalModel, facing: &Facing<'_>) -> Self {
        let beams = sun_beams(model, facing);
        Self { illuminance: facing.sun_illuminance(), beams, bands: None, cells: None }
    }

    /// Returns the directions of the sun's disc over which scattered light is averaged (façade frame, towards the sun),
    /// with their shares of the illuminance by the sun.
    pub fn standing_for(facing: &Facing<'_>) -> Vec<(Dir<Facade>, f64)> {
        let Some(sun) = facing.sun_direction() else { return Vec::new() };
        let directions = standing_for(facing, sun);
        let cosines: f64 = directions.iter().map(|direction| cosine(*direction)).sum();
        directions
            .into_iter()
            .map(|direction| (direction, cosine(direction) / cosines.max(f64::MIN_POSITIVE)))
            .collect()
    }

    /// Returns the relative error of scattered light by its mean over these directions.
    pub fn averaging_error(facing: &Facing<'_>) -> f64 {
        facing.sun_direction().map_or(0.0, averaging_error)
    }

    /// Returns the beams of direct sun behind the system.
    pub fn beams(&self) -> &[BeamLight] {
        &self.beams
    }

    /// Returns the scattered sunlight by profile angle; `None` if it does not depend on a profile angle alone.
    pub fn bands(&self) -> Option<&BandLight> {
        self.bands.as_ref()
    }

    /// Returns the scattered sunlight on [`sun_cells`]; `None` if it depends on a profile angle alone or is 0.
    pub fn cells(&self) -> Option<&CellLight> {
        self.cells.as_ref()
    }
}

impl Emission {
    /// Adds the sunlight behind a described system to this emission, which holds the light from sky and ground alone.
    pub fn add_sun_through(&mut self, through: &SunThrough) {
        self.incident_sun = through.illuminance;
        self.beams.clone_from(&through.beams);
        self.bands.extend(through.bands.clone());
        self.cells.extend(through.cells.clone());
        if self.incident_sun > 0.0 {
            self.beam_source = BeamSource::Described;
            let of = |straight: bool| {
                let beams = self.beams.iter().filter(|beam| beam.straight == straight);
                // The sum of nothing is −0.
                100.0 * beams.map(|beam| beam.exitance).sum::<f64>() / self.incident_sun + 0.0
            };
            self.notes.push(format!(
                "sun: by the description for its exact direction; {:.2} % undeviated, {:.2} % as redirected beams",
                of(true),
                of(false)
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::{Orientation, Surface as Face};
    use crate::compute::sky::{Distribution, Outside, Sun};
    use crate::compute::system::measure::upright::Upright;
    use crate::compute::system::panes::Panes;
    use crate::compute::system::panes::coated::Layer;
    use crate::compute::system::panes::glazing::Pane;
    use crate::compute::system::sheets::diffuser;
    use crate::compute::system::slats::{SlatArray, SlatModel, SlatProfile, Surface};
    use crate::compute::system::stack::{DataLayer, Stack};

    #[test]
    fn few_directions_stand_for_the_disc_within_their_error() {
        let clear = Pane { index: 1.52, thickness: 0.004, absorption: 10.0 };
        let flat = SlatProfile::Flat { width: 0.08 };
        let slats = SlatArray::new(flat, 0.0, 0.072, 0.8, [Surface::matt(0.7); 2]).unwrap();
        let layers: [Box<dyn OpticalModel>; 2] =
            [Box::new(Upright(Box::new(SlatModel::new(slats)))), Box::new(DataLayer(diffuser::lambertian(0.5, 0.3)))];
        let outside = Outside::new(Distribution::uniform(), 0.0).unwrap();
        let south = Bearing::from_degrees(180.0);
        for layer in layers {
            let model = Stack::new(vec![Box::new(Panes::equal(Layer::Clear(clear), 2)), layer]);
            for (altitude, bearing) in [(74.0_f64, 180.0), (85.0, 180.0), (88.5, 180.0), (20.0, 95.0), (40.0, 100.0)] {
                let direction = Dir::from_altitude_bearing(altitude.to_radians(), Bearing::from_degrees(bearing));
                let sun = Sun { direction, direct_normal: 1e5 };
                let orientation = Orientation::new(south);
                let facing = Facing { outside: &outside, sun: Some(&sun), orientation, surface: Face::Facade };
                let found = scattered(&model, &facing).unwrap();
                let directions = disc(&facing, facing.sun_direction().unwrap(), 48);
                let cosines: f64 = directions.iter().map(|direction| cosine(*direction)).sum();
                let flux = |values: &[f64]| -> f64 {
                    values.iter().zip(sun_cells().projected_solid_angles()).map(|(value, w)| value * w).sum()
                };
                let each = directions.iter().map(|direction| {
                    let light = model.scattered_through(*direction, Side::Front, sun_cells());
                    cosine(*direction) / cosines * flux(&light.transmitted)
                });
                let mean = facing.sun_illuminance() * each.sum::<f64>();
                let off = (flux(&found.sun) / mean - 1.0).abs();
                assert!(
                    off <= found.relative_error - CELL_ERROR,
                    "{altitude} {bearing}: {off} {}",
                    found.relative_error
                );
            }
        }
    }
}
