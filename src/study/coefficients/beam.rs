//! Illuminance at the sensors of a prepared scene by the sun: scattered sunlight, and beams on the surfaces that they
//! meet.

use super::Coefficients;
use super::sun_way::SunLight;
use crate::compute::estimate::Estimate;
use crate::compute::lid::{BeamLight, Facing};
use crate::compute::room::beam::{Beam, merged};
use crate::compute::room::beams_past::beams_past;
use crate::compute::room::direct::beams_through;
use crate::compute::room::first_bounce::FirstLight;
use crate::compute::room::outline::Outline;
use crate::compute::room::sunlit_part::SunlitPart;
use crate::compute::sky::Sun;
use crate::study::session::beam_responses::BeamResponses;
use crate::study::session::interreflected::{DIFFERENCE_ALONE, UNEVEN};
use crate::study::session::responses::Responses;
use crate::study::session::unit_beams::{Together, UnitBeam};
use std::sync::{Arc, OnceLock};

/// Error of the share of scattered sunlight that comes from a part of an aperture, relative to the product of that
/// share and the remaining one.
const ALIKE: f64 = 0.1;

/// Returns the illuminance by the scattered sunlight of a part of an aperture. `all`: illuminance by the whole
/// aperture; `reflected`: its interreflected part; `shares`: shares of the part in the direct and in the interreflected
/// illuminance.
fn of_part(all: Estimate, reflected: f64, shares: Option<[f64; 2]>) -> Estimate {
    let Some([straight, by_room]) = shares else { return all };
    let value = (all.value - reflected) * straight + reflected * by_room;
    let error = ALIKE * ((all.value - reflected) * straight * (1.0 - straight) + reflected * by_room * (1.0 - by_room));
    Estimate::new(value, all.error * straight.max(by_room) + error.abs())
}

/// Maximum number of beams of one aperture whose lit areas are seen with sharp outlines, strongest first.
const OUTLINED: usize = 4;

impl Coefficients {
    /// Computes the illuminance at every sensor by the sun, scattered and as beams, including the solar disc seen by
    /// regular transmission. \[lx\]
    pub fn sun(&self, sun: &Sun) -> Vec<f64> {
        self.of_sun(None, sun, false).into_iter().map(|e| e.value).collect()
    }

    /// Computes the illuminance at every sensor by the sun, with its error. \[lx\]
    pub fn sun_estimate(&self, sun: &Sun) -> Vec<Estimate> {
        self.of_sun(None, sun, true)
    }

    /// Computes the illuminance at every sensor by the sun in one hour of the year given to [`Self::keep_year`], with
    /// its error. \[lx\] For many systems it is faster than [`Self::sun_estimate`].
    pub fn hour_sun_estimate(&self, hour: usize, sun: &Sun) -> Vec<Estimate> {
        self.of_sun(Some(hour), sun, true)
    }

    /// Computes the illuminance at every sensor by the sun; without `errors` the values only. \[lx\]
    fn of_sun(&self, hour: Option<usize>, sun: &Sun, errors: bool) -> Vec<Estimate> {
        let sensors = self.scene.sensors.len();
        let mut sums = vec![Estimate::default(); sensors];
        let mut first = FirstLight::dark(0);
        let mut units: Vec<(Arc<UnitBeam>, f64)> = Vec::new();
        // Number of pieces of a beam past boxes.
        let mut pieces = 1;
        for index in 0..self.parts.len() {
            let facing = Facing { sun: Some(sun), ..self.scene.facing(index) };
            if facing.sun_illuminance() <= 0.0 {
                continue;
            }
            let aperture = &self.scene.apertures[index].aperture;
            let fresh = OnceLock::new();
            let past = self.behind.as_ref().zip(self.parts[index].past()).map(|(behind, past)| {
                let place = self.parts[index].sunlit(hour).unwrap_or(&fresh);
                (behind, past, place.get_or_init(|| SunlitPart::new(aperture, &facing, &behind.around)))
            });
            if past.is_some_and(|(_, _, part)| part.is_dark()) {
                continue;
            }
            let found = self.parts[index].sun.light(&facing, self.suns, sensors);
            let past = past.filter(|(_, _, part)| !part.is_whole());
            let cells = found.as_ref().map_or(&[][..], |found| &found.cells);
            let shares = past.map(|(_, past, part)| past.shares(&facing, part, cells));
            let shares = shares.as_deref();
            let beams = match found {
                Some(found) => self.add_scattered(index, &facing, found, shares, &mut sums),
                None => self.add_data(index, &facing, errors, shares, &mut sums),
            };
            let rim = match past {
                Some((behind, _, part)) if beams.iter().any(|beam| !beam.straight) => {
                    part.rim(aperture, &facing, &behind.around)
                }
                _ => &[],
            };
            for (sum, sensor) in sums.iter_mut().zip(&self.scene.sensors) {
                let seen = match past {
                    Some((behind, _, part)) => {
                        beams_past(sensor, aperture, &part.pieces, rim, &beams, &facing, &behind.around)
                    }
                    None => beams_through(sensor, aperture, &beams, &facing),
                };
                *sum += seen.all + Estimate::new(0.0, seen.data_error);
            }
            let (Some(room), Some(unit_beams)) = (&self.room, &self.unit_beams) else { continue };
            pieces = pieces.max(past.map_or(1, |(_, _, part)| part.pieces.len()));
            for beam in &beams {
                if let Some((_, _, part)) = past {
                    first.add_beam_through(aperture, &part.pieces, beam, &facing);
                    continue;
                }
                // Other systems may need the suns of a year.
                let shared = || unit_beams.of(&self.scene, index, beam, &facing, &room.radiosity);
                match (self.suns > 0).then(shared).flatten() {
                    Some(unit) => units.push((unit, beam.exitance * aperture.area())),
                    None => first.add_beam(aperture, beam, &facing),
                }
            }
        }
        if let (Some(room), Some(unit_beams)) = (&self.room, &self.unit_beams) {
            self.add_interreflected(room, unit_beams.responses(), (&units, first.beams), OUTLINED * pieces, &mut sums);
        }
        let whole = |e: Estimate| Estimate::new(e.value.max(0.0), e.error + 1e-6 * e.value.abs());
        sums.into_iter().map(whole).collect()
    }

    /// Adds the interreflected light of beams to the illuminances at the sensors: of beams known per 1 lm, each with
    /// its flux \[lm\], and of other beams.
    fn add_interreflected(
        &self,
        room: &Responses,
        responses: &BeamResponses,
        (units, mut beams): (&[(Arc<UnitBeam>, f64)], Vec<Beam>),
        outlined: usize,
        sums: &mut [Estimate],
    ) {
        if units.is_empty() && beams.is_empty() {
            return;
        }
        let mesh = &room.radiosity.nested.fine;
        let mut all = Together::dark(&room.radiosity, responses);
        units.iter().for_each(|(unit, flux)| all.add(unit, *flux));
        // Uncertainty of the others' light at the sensors by their position within the patches.
        let mut placed = vec![0.0; sums.len()];
        if !beams.is_empty() {
            let direct = |beams: &[Beam]| {
                let mut direct = vec![0.0; mesh.patches.len()];
                merged(beams).iter().for_each(|beam| beam.add_to(mesh, &mut direct));
                direct
            };
            let on_patches = direct(&beams);
            let light = responses.of(&room.radiosity, &on_patches);
            all.add_others(&light, &on_patches);
            // The strongest are seen as sharp outlines; the difference to their light by patches estimates that of the
            // others.
            beams.sort_by(|a, b| b.flux.total_cmp(&a.flux));
            let few = &beams[..beams.len().min(outlined)];
            let outlines: Vec<Outline> = few.iter().flat_map(|beam| beam.outlines(mesh)).collect();
            let rest: f64 = beams[few.len()..].iter().map(|beam| beam.flux).sum();
            let share = rest / few.iter().map(|beam| beam.flux).sum::<f64>();
            let by_patch = if rest > 0.0 { responses.seen(&direct(few)) } else { light.seen.clone() };
            let mut sharp = vec![0.0; sums.len()];
            outlines.iter().for_each(|outline| outline.add_light(mesh, &self.scene.sensors, &mut sharp));
            for (s, sharp) in sharp.into_iter().enumerate() {
                all.sharp[s] += sharp + light.seen[s] - by_patch[s];
                placed[s] = if rest > 0.0 { share * (sharp - by_patch[s]).abs() } else { 0.0 };
            }
        }
        let later = room.of_beams(&all.light, &all.direct);
        for (((sum, sharp), reflected), placed) in sums.iter_mut().zip(all.sharp).zip(later).zip(placed) {
            let error = (DIFFERENCE_ALONE * reflected.difference).hypot(self.rest() * reflected.value).hypot(placed);
            *sum += Estimate::new(reflected.value + sharp, error + UNEVEN * reflected.room_side_reflection);
        }
    }

    /// Adds the illuminance by scattered sunlight that was computed for the actual sun position, and returns its beams.
    fn add_scattered(
        &self,
        index: usize,
        facing: &Facing<'_>,
        found: SunLight,
        shares: Option<&[[f64; 2]]>,
        sums: &mut [Estimate],
    ) -> Vec<BeamLight> {
        let part = &self.parts[index];
        let (clear, sensors) = (part.clear, sums.len());
        for (s, sum) in sums.iter_mut().enumerate() {
            let [value, reflected, uncertainty] = [0, 1, 2].map(|row| clear * found.light[row * sensors + s]);
            let error = uncertainty.hypot(self.rest() * reflected) + clear * found.errors[s];
            *sum += of_part(Estimate::new(value, error), reflected, shares.map(|shares| shares[s]));
        }
        let regular = part.regular.as_ref().filter(|_| part.sun.leaves_regular());
        found.beams.into_iter().chain(BeamLight::regular(regular, facing)).map(|beam| beam.scaled(clear)).collect()
    }

    /// Adds the illuminance by sunlight scattered according to the data's own cells or directions, and returns the
    /// beams of regular transmission.
    fn add_data(
        &self,
        index: usize,
        facing: &Facing<'_>,
        errors: bool,
        shares: Option<&[[f64; 2]]>,
        sums: &mut [Estimate],
    ) -> Vec<BeamLight> {
        let (part, sensors) = (&self.parts[index], sums.len());
        let illuminance = part.clear * facing.sun_illuminance();
        if let Some(direction) = facing.sun_entering() {
            let mut own = vec![0.0; sensors];
            part.transport.sun(direction, sensors, &mut own, illuminance);
            let column = (errors || shares.is_some()).then(|| part.transport.for_direction(direction, sensors));
            for (s, sum) in sums.iter_mut().enumerate() {
                let error = column.as_ref().map_or(0.0, |column| {
                    let reflected = column.light[sensors + s].abs() * illuminance;
                    let uncertainty = column.light[2 * sensors + s] * illuminance;
                    // Result of the data's own cells alone, with fluxes interpolated in straight lines.
                    let simpler =
                        column.difference.get(s).map_or(0.0, |d| (column.light[s] + d) * illuminance - own[s]);
                    uncertainty.hypot(self.rest() * reflected) + simpler.abs() + part.relative_error * own[s]
                });
                let reflected = column.as_ref().map_or(0.0, |column| column.light[sensors + s] * illuminance);
                *sum += of_part(Estimate::new(own[s], error), reflected, shares.map(|shares| shares[s]));
            }
        }
        BeamLight::regular(part.regular.as_ref(), facing).map(|beam| beam.scaled(part.clear)).into_iter().collect()
    }
}
