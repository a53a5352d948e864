//! The sun over a prepared scene: its scattered light as one column, its beam where it falls.

use super::Coefficients;
use crate::compute::estimate::Estimate;
use crate::compute::lid::{BeamLight, Facing};
use crate::compute::room::direct::beams_through;
use crate::compute::room::first_bounce::{BeamLanding, FirstLight};
use crate::compute::sky::Sun;
use crate::study::session::interreflected::{DIFFERENCE_ALONE, UNEVEN};
use crate::study::session::responses::Responses;

impl Coefficients {
    /// The sun's light at every sensor, its disc seen straight through included. \[lx\]
    pub fn sun(&self, sun: &Sun) -> Vec<f64> {
        let sensors = self.scene.sensors.len();
        let mut sums = vec![0.0; sensors];
        let mut first = dark(self);
        for (index, part) in self.parts.iter().enumerate() {
            let facing = Facing { sun: Some(sun), ..self.scene.facing(index) };
            let illuminance = part.clear * facing.sun_illuminance();
            let Some(direction) = facing.sun_direction().filter(|_| illuminance > 0.0) else { continue };
            part.transport.sun(direction, sensors, &mut sums, illuminance);
            add_beam(self, index, &facing, &mut first, &mut sums);
        }
        if let Some((room, landing)) = landing(self, first) {
            let (mesh, sensors) = (&room.radiosity.nested.fine, &self.scene.sensors);
            for (s, reflected) in room.of_beams(&landing, false).into_iter().enumerate() {
                sums[s] += reflected.value + landing.light_at(mesh, sensors[s].position, sensors[s].normal);
            }
        }
        sums.iter_mut().for_each(|e| *e = e.max(0.0));
        sums
    }

    /// The same with its error.
    pub fn sun_estimate(&self, light: &Sun) -> Vec<Estimate> {
        let sensors = self.scene.sensors.len();
        let mut estimates: Vec<Estimate> = self.sun(light).into_iter().map(Estimate::exact).collect();
        let mut first = dark(self);
        for (index, part) in self.parts.iter().enumerate() {
            let facing = Facing { sun: Some(light), ..self.scene.facing(index) };
            let illuminance = part.clear * facing.sun_illuminance();
            let Some(direction) = facing.sun_direction().filter(|_| illuminance > 0.0) else { continue };
            let column = part.transport.for_direction(direction, sensors);
            let mut own = vec![0.0; sensors];
            part.transport.sun(direction, sensors, &mut own, illuminance);
            for (s, sum) in estimates.iter_mut().enumerate() {
                let reflected = column.light[sensors + s].abs() * illuminance;
                let doubt = column.light[2 * sensors + s] * illuminance;
                // What the data's own cells alone would tell, with fluxes interpolated in straight lines.
                let simpler = column.doubt.get(s).map_or(0.0, |d| (column.light[s] + d) * illuminance - own[s]);
                sum.error +=
                    doubt.hypot(self.rest() * reflected) + simpler.abs() + part.transport.relative_error() * own[s];
            }
            add_beam(self, index, &facing, &mut first, &mut own);
        }
        if let Some((room, landing)) = landing(self, first) {
            let rest = self.rest().hypot(landing.gap);
            for (s, reflected) in room.of_beams(&landing, true).into_iter().enumerate() {
                // The outlines are seen in closed form.
                estimates[s].error += (DIFFERENCE_ALONE * reflected.difference).hypot(rest * reflected.value)
                    + UNEVEN * reflected.thrown_back;
            }
        }
        estimates.iter_mut().for_each(|e| e.error += 1e-6 * e.value);
        estimates
    }
}

fn dark(all: &Coefficients) -> Option<FirstLight> {
    all.room.as_ref().map(|room| FirstLight::dark(room.radiosity.nested.fine.patches.len()))
}

/// Where the beams land in a room that reflects them.
fn landing(all: &Coefficients, first: Option<FirstLight>) -> Option<(&Responses, BeamLanding)> {
    let room = all.room.as_ref()?;
    Some((room, first?.landing(&room.radiosity.nested.fine)?))
}

/// The unscattered sun through one aperture: at the sensors, and on the surfaces.
fn add_beam(all: &Coefficients, index: usize, facing: &Facing<'_>, first: &mut Option<FirstLight>, sums: &mut [f64]) {
    let Some(beam) = BeamLight::regular(all.parts[index].regular.as_ref(), facing) else { return };
    let beam = beam.scaled(all.parts[index].clear);
    let aperture = &all.scene.apertures[index].aperture;
    for (sum, sensor) in sums.iter_mut().zip(&all.scene.sensors) {
        *sum += beams_through(sensor, aperture, &[beam], facing).beam;
    }
    if let Some(first) = first {
        first.add_beam(aperture, &beam, facing);
    }
}
