//! Solar energy transmitted through the apertures, step by step: irradiances of sky, ground and sun by direction, times
//! the solar transmittance of the system in each aperture in its state.
//!
//! The sky has the same relative distribution as for light, scaled to the diffuse irradiance of the hour; the sun has
//! its direct normal irradiance. The ground reflects as for light (`site.ground_reflectance`, `year.ground`), skyline
//! and boxes obstruct solar radiation as they do light. Where a system has no solar properties its visible ones are
//! used, and the result says so. Radiation that is absorbed and given off to the room as heat is left out.

use super::fixed::put_state;
use super::steps::Steps;
use super::through::{DirectSolar, Passage, ready};
use crate::compute::angle::Bearing;
use crate::compute::btdf::SolarSource;
use crate::compute::direction::{Orientation, Surface};
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::lid::Facing;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::mesh::BoxRoom;
use crate::compute::sky::{Frame, Outside, Prepared, Sun};
use crate::compute::surroundings::Seen;
use crate::compute::year::received::Received;
use crate::compute::year::transmittance::Between;
use crate::study::control::year::Moving;
use crate::study::error::StudyError;
use crate::study::outside::Before;
use crate::study::scene_file::{Interpolation, OutsideKeys, SceneFile};
use crate::study::scene_places::{apertures, clear, room};
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use glam::DVec3;
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;

/// Number of steps that are computed in parallel before their sums are taken.
const AT_ONCE: usize = 512;
/// Number of points per side of an aperture from which boxes outside are seen.
const EYES: usize = 2;
/// Number of points per side of an aperture from which it is tested whether boxes shade the sun.
const RAYS: usize = 16;
/// Number of steps whose sky is also integrated exactly, to determine the error.
const JUDGED: usize = 3;
/// Safety factor on the error found in [`JUDGED`] steps, because it is stated for all other steps.
const OTHER_SKIES: f64 = 2.0;

/// Solar energy transmitted through one aperture over the chosen steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThroughAperture {
    /// Number of the aperture in the scene, from 1.
    pub number: usize,
    /// Area of the aperture. \[m²\]
    pub area: f64,
    /// Source of the system's solar properties; if it has several states, the least reliable of them.
    pub source: SolarSource,
    /// Solar energy transmitted. \[kWh\]
    pub energy: Estimate,
}

/// Solar power and energy transmitted through the apertures over the chosen steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Solar {
    /// Power through all apertures together, by chosen step. \[W\]
    pub watts: Vec<f64>,
    /// Estimated absolute errors of `watts`. \[W\]
    pub errors: Vec<f64>,
    /// Energies through each aperture, in the scene's order.
    pub apertures: Vec<ThroughAperture>,
    /// Area of the floor. \[m²\]
    pub floor: f64,
}

impl Solar {
    /// Returns the area of all apertures together. \[m²\]
    pub fn area(&self) -> f64 {
        self.apertures.iter().map(|one| one.area).sum()
    }

    /// Returns the source of the solar properties that all apertures have in common, or that they differ.
    pub fn source(&self) -> SolarSource {
        let mut sources = self.apertures.iter().map(|one| one.source);
        let first = sources.next().unwrap_or(SolarSource::Visible);
        if sources.all(|other| other == first) { first } else { SolarSource::Partly }
    }
}

/// Input for the solar energy of a year.
pub(super) struct Question<'a> {
    pub file: &'a SceneFile,
    pub base: &'a Path,
    pub library: &'a dyn SystemLibrary,
    pub session: &'a Session,
    pub steps: &'a Steps,
    pub moving: &'a [Moving],
    pub states: &'a [Vec<usize>],
    pub chosen: &'a [usize],
}

impl Question<'_> {
    fn is_lit(&self, step: usize) -> bool {
        let hour = &self.steps.list[step].hour;
        hour.direct_normal_irradiance > 0.0 || hour.diffuse_horizontal_irradiance > 0.0
    }
}

/// Apertures that receive the same irradiance and have the same solar transmittances.
struct Group {
    surface: Surface,
    /// Indices of the solar transmittances by state of the moving aperture, `None` for states that do not occur; a
    /// single one if nothing moves.
    passages: Vec<Option<usize>>,
    moving: Option<usize>,
    /// Indices of the apertures, each with its area times the transmission factor of frame and dirt. \[m²\]
    members: Vec<(usize, f64)>,
    /// Position and size of the first aperture; it is the only one if there are boxes outside.
    aperture: Aperture,
}

/// Computation of the transmitted solar power in any step.
struct Engine<'a> {
    question: &'a Question<'a>,
    orientation: Orientation,
    /// Obstructions outside, prepared for many skies; `None` if there are none.
    prepared: Option<Arc<Prepared>>,
    per_lux: f64,
    groups: Vec<Group>,
    passages: Vec<Passage>,
    /// Received irradiances through incident cells, by surface and basis.
    received: Vec<(Surface, Received)>,
    between: Between,
}

/// Computes the solar power and energy transmitted through the apertures in the chosen steps, and adds a note on it to
/// `notes`.
///
/// # Errors
/// Returns an error if the scene or a system is wrong, or if cancelled.
pub(super) fn solar(
    question: &Question<'_>,
    notes: &mut Vec<String>,
    progress: &dyn Progress,
) -> Result<Solar, StudyError> {
    let Question { file, chosen, .. } = question;
    let room = room(&file.room)?;
    let geometry = apertures(&file.aperture, &room)?;
    let mut engine = Engine::new(question, &room, &geometry, progress)?;
    engine.judge()?;
    let mut sums = vec![Estimate::default(); engine.groups.len()];
    let (mut watts, mut errors) = (vec![0.0; chosen.len()], vec![0.0; chosen.len()]);
    let lit: Vec<usize> = (0..chosen.len()).filter(|row| question.is_lit(chosen[*row])).collect();
    for (done, rows) in lit.chunks(AT_ONCE).enumerate() {
        if progress.cancelled() {
            return Err(Cancelled.into());
        }
        progress.advance("solar", done * AT_ONCE, lit.len());
        let found: Vec<Vec<Estimate>> =
            rows.par_iter().map(|row| engine.at(chosen[*row])).collect::<Result<_, StudyError>>()?;
        for (row, by_group) in rows.iter().zip(found) {
            for ((group, flux), sum) in engine.groups.iter().zip(by_group).zip(&mut sums) {
                let clear: f64 = group.members.iter().map(|(_, clear)| clear).sum();
                watts[*row] += flux.value * clear;
                errors[*row] += flux.error * clear;
                *sum += flux;
            }
        }
    }
    let hours = question.steps.length / 1000.0;
    let mut list: Vec<ThroughAperture> = geometry
        .iter()
        .zip(1..)
        .map(|(one, number)| ThroughAperture {
            number,
            area: one.area(),
            source: SolarSource::Own,
            energy: Estimate::default(),
        })
        .collect();
    for (group, sum) in engine.groups.iter().zip(sums) {
        let source = group.passages.iter().flatten().map(|index| engine.passages[*index].source).max();
        for (index, clear) in &group.members {
            list[*index].energy = sum * (clear * hours);
            list[*index].source = source.unwrap_or(SolarSource::Visible);
        }
    }
    notes.push(note(&list));
    Ok(Solar { watts, errors, apertures: list, floor: file.room.width * file.room.depth })
}

/// Returns the note on what the solar energy contains, and for which apertures visible properties are used instead of
/// solar ones.
fn note(list: &[ThroughAperture]) -> String {
    let of = |source: SolarSource| -> Vec<String> {
        list.iter().filter(|one| one.source == source).map(|one| one.number.to_string()).collect()
    };
    let mut text =
        "solar energy is directly transmitted, secondary heat left out; the ground reflects as for light".to_owned();
    for source in [SolarSource::Partly, SolarSource::Visible] {
        let numbers = of(source);
        if numbers.len() == list.len() {
            text += &format!("; {}", source.words());
        } else if !numbers.is_empty() {
            text += &format!("; aperture {}: {}", numbers.join(", "), source.words());
        }
    }
    text
}

impl<'a> Engine<'a> {
    /// Groups the apertures, and prepares their solar transmittances and the obstructions.
    fn new(
        question: &'a Question<'a>,
        room: &BoxRoom,
        geometry: &[Aperture],
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let Question { file, steps, moving, states, chosen, .. } = question;
        let lit = || chosen.iter().filter(|step| question.is_lit(**step));
        // Fixed luminances are converted by the efficacy of all diffuse light together.
        let (watts, lux) = lit().map(|step| &steps.list[*step].hour).fold((0.0, 0.0), |(watts, lux), hour| {
            (watts + hour.diffuse_horizontal_irradiance, lux + hour.diffuse_horizontal)
        });
        let per_lux = if lux > 0.0 { watts / lux } else { 0.0 };
        let in_watts =
            |keys: &OutsideKeys| OutsideKeys { luminance: keys.luminance.map(|l| l * per_lux), ..keys.clone() };
        let outside: Vec<OutsideKeys> = file.outside.iter().map(in_watts).collect();
        let before = Before::of(&SceneFile { outside, ..(*file).clone() }, room, geometry)?;
        let orientation = Orientation::new(Bearing::from_degrees(file.site.azimuth));
        let prepared = question.session.standing(&before, &steps.even_outside(0)?.0, orientation, progress)?;
        let between = match file.compute.interpolation {
            Interpolation::Auto => Between::Linear,
            Interpolation::Patch => Between::Constant,
        };
        let mut known = DirectSolar::new(question.library, question.base);
        let mut groups: Vec<Group> = Vec::new();
        for (index, (keys, aperture)) in file.aperture.iter().zip(geometry).enumerate() {
            let in_scene = |error| in_aperture(index, error);
            let clear = clear(keys, index)? * aperture.area();
            let moves = moving.iter().position(|one| one.aperture == index + 1);
            let passages = match moves {
                None => vec![Some(known.of(&keys.system).map_err(in_scene)?)],
                Some(m) => {
                    let count = moving[m].device.keys.len();
                    let mut occurs = vec![false; count];
                    lit().for_each(|step| occurs[states[*step][m]] = true);
                    let mut of = |state: usize| {
                        let mut system = keys.system.clone();
                        put_state(&mut system, &moving[m].device.keys[state]);
                        known.of(&system)
                    };
                    let passage = |state: usize| occurs[state].then(|| of(state)).transpose();
                    (0..count).map(passage).collect::<Result<_, _>>().map_err(in_scene)?
                }
            };
            let same = |group: &&mut Group| {
                prepared.is_none()
                    && moves.is_none()
                    && group.moving.is_none()
                    && group.surface == aperture.surface
                    && group.passages == passages
            };
            match groups.iter_mut().find(same) {
                Some(group) => group.members.push((index, clear)),
                None => groups.push(Group {
                    surface: aperture.surface,
                    passages,
                    moving: moves,
                    members: vec![(index, clear)],
                    aperture: *aperture,
                }),
            }
        }
        let passages = ready(known.found(), between);
        let altitude = file.sky.obstruction.map_or(0.0, |keys| keys.altitude.to_radians());
        let mut received: Vec<(Surface, Received)> = Vec::new();
        for group in &groups {
            for passage in group.passages.iter().flatten() {
                let cells = &passages[*passage].cells;
                if !received.iter().any(|(surface, known)| *surface == group.surface && known.cells() == cells) {
                    let frame = Frame::of_aperture(orientation, group.surface);
                    received.push((group.surface, Received::new(cells.clone(), frame, altitude)));
                }
            }
        }
        Ok(Self { question, orientation, prepared, per_lux, groups, passages, received, between })
    }

    /// Returns the index in `received` of the irradiances for a solar transmittance in a surface.
    fn received(&self, surface: Surface, passage: &Passage) -> usize {
        let same = |(own, known): &(Surface, Received)| *own == surface && *known.cells() == passage.cells;
        self.received.iter().position(same).expect("made for every passage of every group")
    }

    /// Returns outside and sun of a step in radiometric units, sky, ground and obstructions with radiances. \[W/m²\]
    fn outside(&self, step: usize) -> Result<(Outside, Option<Sun>), StudyError> {
        let (outside, sun) = self.question.steps.outside_in_watts(step, self.per_lux)?;
        match &self.prepared {
            Some(prepared) => Ok((prepared.under(&outside, sun.as_ref()), sun)),
            None => Ok((outside, sun)),
        }
    }

    /// Returns points on a regular grid over an aperture, `a_side` along each side, in world axes from the room's
    /// origin \[m\]; none without obstructions.
    fn points(&self, aperture: &Aperture, a_side: usize) -> Vec<DVec3> {
        if self.prepared.is_none() {
            return Vec::new();
        }
        let [low, right, _, up] = aperture.corners();
        let share = |k: usize| (k as f64 + 0.5) / a_side as f64;
        (0..a_side * a_side)
            .map(|k| {
                self.orientation.to_world(low + (right - low) * share(k % a_side) + (up - low) * share(k / a_side))
            })
            .collect()
    }

    /// Computes the transmitted solar power per area for every group, in one step. \[W/m²\]
    fn at(&self, step: usize) -> Result<Vec<Estimate>, StudyError> {
        let (outside, sun) = self.outside(step)?;
        // With boxes every aperture has a different outside.
        let alone = self.prepared.is_some();
        let mut known: Vec<Option<Vec<f64>>> = vec![None; self.received.len()];
        let mut list = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            let state = group.moving.map_or(0, |m| self.question.states[step][m]);
            let passage = &self.passages[group.passages[state].expect("states of lit steps have their passages")];
            let index = self.received(group.surface, passage);
            let received = match &mut known[index] {
                Some(received) if !alone => received,
                place => place.insert(self.received[index].1.through(&outside, &self.points(&group.aperture, EYES))),
            };
            let diffuse: f64 = received.iter().zip(&passage.by_cell).map(|(e, tau)| e * tau).sum();
            let judged = passage.judged[usize::from(group.surface == Surface::Roof)];
            let error = judged * diffuse + passage.tau.error() * received.iter().sum::<f64>();
            list.push(Estimate::new(diffuse, error) + self.beam(group, passage, &outside, sun.as_ref()));
        }
        Ok(list)
    }

    /// Computes the transmitted power of direct sunlight per area of a group. \[W/m²\]
    fn beam(&self, group: &Group, passage: &Passage, outside: &Outside, sun: Option<&Sun>) -> Estimate {
        let facing = Facing { outside, sun, orientation: self.orientation, surface: group.surface };
        let Some(d) = facing.sun_entering() else { return Estimate::default() };
        let (share, uncertainty) = self.sunlit(group, outside, sun);
        let received = facing.sun_illuminance();
        let [tau, constant] = [self.between, Between::Constant].map(|between| passage.tau.at(d, between));
        let error = share * (0.5 * (tau - constant).abs() + passage.tau.error()) + uncertainty * tau;
        Estimate::new(received * share * tau, received * error)
    }

    /// Returns the share of an aperture that no box shades from the sun, and the uncertainty of the share.
    fn sunlit(&self, group: &Group, outside: &Outside, sun: Option<&Sun>) -> (f64, f64) {
        let (Some(around), Some(sun)) = (outside.surroundings(), sun) else { return (1.0, 0.0) };
        let points = self.points(&group.aperture, RAYS);
        if points.is_empty() {
            return (1.0, 0.0);
        }
        let direction = sun.direction.vector();
        let hidden = |point: &&DVec3| matches!(around.seen(Some(**point), direction), Some(Seen::Face { .. }));
        let share = 1.0 - points.iter().filter(hidden).count() as f64 / points.len() as f64;
        // A shadow's edge crosses a row of fields.
        (share, if share > 0.0 && share < 1.0 { 0.5 / RAYS as f64 } else { 0.0 })
    }

    /// Determines the error of integrating diffuse radiation by cells, in steps spread over the requested ones.
    fn judge(&mut self) -> Result<(), StudyError> {
        let question = self.question;
        let bright = |step: &usize| question.steps.list[*step].hour.diffuse_horizontal_irradiance > 0.0;
        let bright: Vec<usize> = question.chosen.iter().copied().filter(bright).collect();
        let count = JUDGED.min(bright.len());
        for k in 0..count {
            let (outside, _) = self.outside(bright[(2 * k + 1) * bright.len() / (2 * count)])?;
            for g in 0..self.groups.len() {
                let group = &self.groups[g];
                let middle = self.points(&group.aperture, 1);
                let from_middle = middle.first().map(|eye| outside.seen_from(*eye));
                let eyes = self.points(&group.aperture, EYES);
                let place = usize::from(group.surface == Surface::Roof);
                for p in group.passages.iter().flatten().copied().collect::<Vec<_>>() {
                    let passage = &self.passages[p];
                    let received = &self.received[self.received(group.surface, passage)].1;
                    let (cells, exact) = received.judged(from_middle.as_ref().unwrap_or(&outside));
                    let through = |e: &[f64], tau: &[f64]| e.iter().zip(tau).map(|(e, tau)| e * tau).sum::<f64>();
                    let exact = through(&exact, &passage.tau.on(&cells, self.between));
                    let own = through(&received.through(&outside, &middle), &passage.by_cell);
                    // From the middle alone against the mean over the aperture.
                    let aside = if eyes.is_empty() {
                        0.0
                    } else {
                        (through(&received.through(&outside, &eyes), &passage.by_cell) - own).abs() / 3.0
                    };
                    if own > 0.0 {
                        let gap = OTHER_SKIES * ((own - exact).abs() + aside) / own;
                        let worst = &mut self.passages[p].judged[place];
                        *worst = worst.max(gap);
                    }
                }
            }
        }
        Ok(())
    }
}

/// Returns an error with the number of the aperture in which it occurred added to the key.
fn in_aperture(index: usize, error: StudyError) -> StudyError {
    match error {
        StudyError::Key { key, message } => StudyError::Key { key: format!("aperture[{}].{key}", index + 1), message },
        other => other,
    }
}
