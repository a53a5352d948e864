//! Sessions compute the light of scenes, and store what does not change between them, within a limit of memory:
//! factored rooms, and the responses of sensors and surfaces to each aperture. A new sky, time or product on the same
//! basis then costs only matrix products.

pub(super) mod beam_responses;
mod behind;
mod bytes;
mod creases;
pub(super) mod data_share;
mod emission;
pub(super) mod far;
pub mod glare;
pub(super) mod interreflected;
mod lights;
mod outside_seen;
mod part;
pub(super) mod responses;
mod results;
mod room_side_reflection;
pub(super) mod seen;
pub(super) mod seen_cells;
mod skies;
pub(super) mod sky_patches;
pub(super) mod sky_year;
mod split;
mod surfaces;
mod targets;
mod through_room;
pub(super) mod unit_beams;
mod weights;

use super::cache::{Cache, Key, Store, bits};
use super::error::StudyError;
use super::plan::Plan;
use super::scene::Scene;
use super::scene_file::Interpolation;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::Dataset;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::peaks::Peaks;
use crate::compute::lid::{BandLight, BeamSource, Emission, Interpolator, SkyThrough, SunThrough};
use crate::compute::quadrature::Tolerance;
use crate::compute::room::back_reflection::RoomSide;
use crate::compute::room::band_weights::BandWeights;
use crate::compute::room::direct::{self, DirectLight, Reception, Sensor};
use crate::compute::room::exchange::Exchange;
use crate::compute::room::gather::Reconstruction;
use crate::compute::room::grid::CellWeights;
use crate::compute::room::near_field::{Integrator, NearField};
use crate::compute::room::patch_weights::PatchWeights;
use crate::compute::room::radiosity::Radiosity;
use crate::compute::sky::{Counts, Outside, Prepared};
pub(crate) use emission::OfModel;
pub use outside_seen::OutsideSeen;
use rayon::prelude::*;
use results::all_numbers;
pub use results::{LidResult, RoomResult, SensorResult};
use seen::{Seen, SeenBands, bands_of, check, in_blocks, keeps, keeps_receptions, within_budget};
use seen_cells::SeenCells;
use sky_patches::SkyPatches;
use sky_year::{SkyYear, SunlitYear};
use std::borrow::Cow;
use std::sync::{Arc, Weak};
use std::time::Instant;
pub use surfaces::{PatchLight, SurfaceLight};
use targets::cubature;
use unit_beams::UnitBeams;
use weights::{ByCells, Response};

/// Name of the first stage of computing a room, in reports of progress.
const DIRECT_STAGE: &str = "direct light";

/// Number of stages that progress reports for a room: emission, direct light, two meshes.
const STEPS: usize = 4;

/// Maximum memory of the stored results of a program that runs for one task. \[bytes\] Chosen: cost only, no effect on
/// results.
const OF_ONE_TASK: usize = 1 << 30;

/// Maximum memory of the light of systems by position of the sun: all states of a blind and all eyes in one hour.
/// \[bytes\] Chosen: cost only, no effect on results.
const OF_SUNS: usize = 8 << 20;

/// Session: caches of intermediate results for computing the light of scenes. One session lasts as long as the program,
/// and is shared between threads.
pub struct Session {
    exchanges: Cache<Exchange>,
    rooms: Cache<Radiosity>,
    gather: Cache<Vec<[Reconstruction; 2]>>,
    reception: Cache<Vec<Reception>>,
    seen_cells: Cache<SeenCells>,
    patches: Cache<PatchWeights>,
    responses: Cache<Vec<Response>>,
    unit_beams: Cache<UnitBeams>,
    sky_patches: Cache<SkyPatches>,
    sky_years: Cache<SkyYear>,
    sunlit_years: Cache<SunlitYear>,
    exact_skies: Cache<Vec<f64>>,
    trial_skies: Cache<Vec<Outside>>,
    /// Obstructions that were prepared for many skies, such as the hours of a year.
    standing: Cache<Prepared>,
    /// Weights of outside luminances at points of apertures, by point and incident patch.
    seen_patches: Cache<Vec<Vec<Counts>>>,
    /// Weights with which sensors see emergent cells at points of an aperture.
    cells_at_points: Cache<Vec<CellWeights>>,
    by_cells: Cache<ByCells>,
    by_nodes: Cache<Vec<ByCells>>,
    sides: Cache<RoomSide>,
    falling: Cache<Vec<Vec<f64>>>,
    bands: Cache<Vec<BandWeights>>,
    interpolators: Cache<Interpolator>,
    /// Light of systems by position of the sun, in a store of its own, so that the hours of a year do not remove all
    /// else.
    suns: Cache<OfModel<SunThrough>>,
    skies: Cache<OfModel<SkyThrough>>,
    /// Peaks extracted from datasets, with references that keep their addresses from being used again.
    peaks: Cache<(Weak<Dataset>, Peaks)>,
    /// Whether light that an aperture reflects diffusely is taken as uniform over the aperture.
    reflects_uniformly: bool,
}

impl Default for Session {
    fn default() -> Self {
        Self::new()
    }
}

impl Session {
    /// Creates a session with a store of its own.
    pub fn new() -> Self {
        Self::storing(&Arc::new(Store::new(OF_ONE_TASK)))
    }

    /// Creates a session whose results are in `store`; they share its limit with those of other sessions there.
    pub fn storing(store: &Arc<Store>) -> Self {
        Self {
            exchanges: Cache::new(store, Exchange::bytes),
            rooms: Cache::new(store, Radiosity::bytes),
            gather: Cache::new(store, |all| all.iter().flatten().map(bytes::of_reconstruction).sum()),
            reception: Cache::new(store, |all| all.iter().map(bytes::of_reception).sum()),
            seen_cells: Cache::new(store, SeenCells::bytes),
            patches: Cache::new(store, PatchWeights::bytes),
            responses: Cache::new(store, |all| all.iter().map(Response::bytes).sum()),
            unit_beams: Cache::new(store, UnitBeams::bytes),
            sky_patches: Cache::new(store, SkyPatches::bytes),
            sky_years: Cache::new(store, SkyYear::bytes),
            sunlit_years: Cache::new(store, sky_year::of_sunlit),
            exact_skies: Cache::new(store, |values| size_of_val(&values[..])),
            trial_skies: Cache::new(store, |skies| size_of_val(&skies[..])),
            standing: Cache::new(store, Prepared::bytes),
            seen_patches: Cache::new(store, |points| points.iter().map(|point| bytes::of_rows(point)).sum()),
            cells_at_points: Cache::new(store, |all| all.iter().map(bytes::of_cells).sum()),
            by_cells: Cache::new(store, ByCells::bytes),
            by_nodes: Cache::new(store, |all| all.iter().map(ByCells::bytes).sum()),
            sides: Cache::new(store, RoomSide::bytes),
            falling: Cache::new(store, |rows| bytes::of_rows(rows)),
            bands: Cache::new(store, |all| all.iter().map(|one| size_of_val(one) + one.bytes()).sum()),
            interpolators: Cache::new(store, Interpolator::bytes),
            suns: Cache::new(&Arc::new(Store::new(OF_SUNS)), |(_, sun)| sun.bytes()),
            skies: Cache::new(store, |(_, sky)| sky.bytes()),
            peaks: Cache::new(store, |(_, peaks)| peaks.bytes()),
            reflects_uniformly: false,
        }
    }

    /// Returns the session for work that goes from product to product: the room is solved once for all products,
    /// because light that panes and diffusers reflect is taken as uniform over each aperture. The error of this is up to
    /// 0.5 % near a patch of sun for a pane, and 0.03 % over a year for a white diffuser; the stated errors include it.
    #[must_use]
    pub fn passing(self) -> Self {
        Self { reflects_uniformly: true, ..self }
    }

    /// Computes luminous flux and luminous intensity distribution of one aperture into the room (eq 5). `aperture`:
    /// index of the aperture from 0, which must exist.
    pub fn lid(&self, scene: &Scene, aperture: usize, progress: &dyn Progress) -> Result<LidResult, StudyError> {
        check(progress)?;
        let geometry = &scene.apertures[aperture].aperture;
        if scene.outside.surroundings().is_some() {
            return self.split(scene, aperture, progress)?.lid(scene, aperture).checked();
        }
        let facing = scene.facing(aperture);
        let emission = self.emission(scene, aperture);
        let result = LidResult {
            lid: emission.lid(&facing, geometry.size),
            flux: (emission.exitance(&facing) + Estimate::new(0.0, emission.exitance_uncertainty())) * geometry.area(),
            incident: (emission.incident_diffuse, emission.incident_sun),
        };
        result.checked()
    }

    /// Computes the illuminance at every sensor, direct and interreflected, with its error.
    pub fn room(&self, scene: &Scene, progress: &dyn Progress) -> Result<RoomResult, StudyError> {
        let mut plan = Plan::new(scene);
        let clock = Instant::now();
        let lights = self.lights(scene, progress)?;
        let (emissions, splits) = (&lights.emissions, &lights.splits);
        let flux = lights.flux(scene);
        let outside: Vec<OutsideSeen> = splits.iter().map(|split| split.seen).collect();
        for word in scene.outside_notes.iter().cloned().chain(outside.iter().flat_map(OutsideSeen::sentences)) {
            plan.note("outside", true, &word);
        }
        plan.spend("emission", clock.elapsed());
        for note in emissions.iter().flat_map(|emission| &emission.notes) {
            plan.note("interpolation", true, note);
        }
        check(progress)?;
        progress.advance(DIRECT_STAGE, 1, STEPS);

        let clock = Instant::now();
        let kept = emissions.iter().all(|one| bases(one).into_iter().all(|basis| keeps_receptions(scene, basis)));
        let reused = kept && self.holds_receptions(scene, emissions);
        let direct = if splits.is_empty() {
            self.direct(scene, emissions, progress)?
        } else {
            self.direct_behind(scene, splits, progress)?
        };
        plan.spend("direct", clock.elapsed());
        if splits.is_empty() && scene.near_field == NearField::SolidAngle {
            let reason = match (kept, reused) {
                (false, _) => "sensor by sensor: too many to keep",
                (true, true) => "reused: sensors, apertures and cells are the same",
                (true, false) => "not there yet",
            };
            plan.note("receptions", !reused, reason);
            if kept {
                self.note_unseen(scene, emissions, &mut plan, progress)?;
            }
        }
        progress.advance("interreflection", 2, STEPS);

        let clock = Instant::now();
        let (interreflected, flux_gap) = if plan.runs("interreflection") {
            let reused = self.holds_room(scene);
            let reason = if reused { "reused: room, apertures and reflectances are the same" } else { "not there yet" };
            plan.note("room factors", !reused, reason);
            self.interreflected(scene, &lights, &direct.iter().map(|one| one.all).collect::<Vec<_>>(), progress)?
        } else {
            (vec![Estimate::default(); scene.sensors.len()], 0.0)
        };
        plan.spend("interreflection", clock.elapsed());
        // The relative uncertainty of the incoming flux by the data also applies to the interreflected light.
        let flux_uncertainty: f64 =
            emissions.iter().zip(&scene.apertures).map(|(e, one)| e.exitance_uncertainty() * one.aperture.area()).sum();
        let open = if flux.value > 0.0 { flux_uncertainty / flux.value } else { 0.0 };
        let flux = flux + Estimate::new(0.0, flux_uncertainty);
        let sensors: Vec<SensorResult> = scene
            .sensors
            .iter()
            .zip(direct.into_iter().zip(interreflected))
            .map(|(&sensor, (direct, interreflected))| {
                let DirectLight { all, beam, data_error } = direct;
                let data_error = data_error + open * interreflected.value;
                SensorResult { sensor, direct: all, interreflected, beam, data_error }
            })
            .collect();
        all_numbers(&sensors, flux)?;
        let beams =
            emissions.iter().map(|emission| (emission.beam_source, sun_word(emission, scene.interpolation))).collect();
        Ok(RoomResult { sensors, flux, flux_gap, beams, outside, plan })
    }

    /// Whether the responses of all sensors to the luminances of the apertures are stored.
    fn holds_receptions(&self, scene: &Scene, emissions: &[Emission]) -> bool {
        emissions.iter().enumerate().all(|(index, emission)| {
            bases(emission).iter().all(|basis| self.reception.holds(&reception_key(scene, index, *basis)))
        })
    }

    /// Adds a note to the plan on emergent cells that no sensor sees: they need no weights, and without interreflection
    /// their light has no effect.
    fn note_unseen(
        &self,
        scene: &Scene,
        emissions: &[Emission],
        plan: &mut Plan,
        progress: &dyn Progress,
    ) -> Result<(), StudyError> {
        let (mut unseen, mut all) = (0, 0);
        for (index, emission) in emissions.iter().enumerate() {
            for light in &emission.cells {
                let receptions = self.receptions(scene, index, Some(&light.basis), progress)?;
                all += light.basis.len();
                let seen = |cell: usize| receptions.iter().any(|reception| reception.cells[cell] != 0.0);
                unseen += (0..light.basis.len()).filter(|&cell| !seen(cell)).count();
            }
        }
        if all > 0 {
            let rest = if plan.runs("interreflection") { "; they count for interreflection alone" } else { "" };
            plan.note("unseen cells", unseen == 0, &format!("{unseen} of {all} emergent cells reach no sensor{rest}"));
        }
        Ok(())
    }

    /// Returns the illuminance of every sensor per luminance of the cells of one aperture, computed or stored. \[sr\]
    /// `basis`: emergent basis; `None` for uniform luminance only.
    pub(super) fn receptions(
        &self,
        scene: &Scene,
        index: usize,
        basis: Option<&RingBasis>,
        progress: &dyn Progress,
    ) -> Result<Arc<Vec<Reception>>, StudyError> {
        let aperture = &scene.apertures[index].aperture;
        within_budget(scene, size_of::<Reception>() + basis.map_or(0, RingBasis::len) * size_of::<f64>())?;
        self.reception.get(reception_key(scene, index, basis), || {
            scene
                .sensors
                .par_iter()
                .map(|sensor| {
                    check(progress)?;
                    Ok(Reception::new(sensor, aperture, basis))
                })
                .collect()
        })
    }

    /// Returns the illuminances of all sensors per luminance of each emergent cell of one aperture. \[sr\]
    pub(super) fn seen_cells(
        &self,
        scene: &Scene,
        index: usize,
        basis: &RingBasis,
        progress: &dyn Progress,
    ) -> Result<Arc<SeenCells>, StudyError> {
        self.seen_cells.get(reception_key(scene, index, Some(basis)), || {
            let receptions = self.receptions(scene, index, Some(basis), progress)?;
            let by_cell = |reception: &Reception| reception.cells.clone().into_iter().enumerate();
            Ok(SeenCells::new(basis.len(), receptions.iter().map(by_cell)))
        })
    }

    /// Returns the response of the sensors to the luminances of an aperture on the cells of a basis: stored, or to be
    /// computed sensor by sensor.
    fn seen<'a>(
        &self,
        scene: &'a Scene,
        index: usize,
        basis: Option<&'a RingBasis>,
        progress: &dyn Progress,
    ) -> Result<Seen<'a>, StudyError> {
        if keeps_receptions(scene, basis) {
            return self.receptions(scene, index, basis, progress).map(Seen::Kept);
        }
        Ok(Seen::Recomputed(&scene.apertures[index].aperture, basis))
    }

    /// Returns the response of every sensor to the luminances of one aperture in bands of the profile angle.
    fn band_weights<'a>(
        &self,
        scene: &'a Scene,
        index: usize,
        bands: &BandLight,
        progress: &dyn Progress,
    ) -> Result<SeenBands<'a>, StudyError> {
        let aperture = &scene.apertures[index].aperture;
        let (upright, count) = (bands.light.upright, bands.light.q.len());
        if !keeps(scene, count) {
            return Ok(SeenBands::Recomputed(aperture, upright, count));
        }
        self.kept_bands(scene, index, (upright, count), progress).map(SeenBands::Kept)
    }

    /// Returns the responses of all sensors for a number of bands of the profile angle, computed or stored. `upright`:
    /// whether the profile angle is in the horizontal plane (vertical structures).
    pub(super) fn kept_bands(
        &self,
        scene: &Scene,
        index: usize,
        (upright, count): (bool, usize),
        progress: &dyn Progress,
    ) -> Result<Arc<Vec<BandWeights>>, StudyError> {
        let aperture = &scene.apertures[index].aperture;
        let mut key = reception_key(scene, index, None);
        key.extend([u64::from(upright), count as u64]);
        self.bands.get(key, || {
            let of = |sensor: &Sensor| {
                check(progress)?;
                Ok::<_, StudyError>(bands_of(sensor, aperture, upright, count))
            };
            scene.sensors.par_iter().map(of).collect()
        })
    }

    /// Computes the direct light at every sensor from all apertures, which have no obstructions in front of them.
    fn direct(
        &self,
        scene: &Scene,
        emissions: &[Emission],
        progress: &dyn Progress,
    ) -> Result<Vec<DirectLight>, StudyError> {
        let mut sums = vec![DirectLight::default(); scene.sensors.len()];
        let relative = cubature(scene.error_target);
        for (index, emission) in emissions.iter().enumerate() {
            check(progress)?;
            let aperture = &scene.apertures[index].aperture;
            let facing = scene.facing(index);
            if scene.near_field != NearField::SolidAngle {
                let method =
                    Integrator::new(scene.near_field, aperture, emission, &facing, Tolerance::relative(relative));
                let part = in_blocks(scene, DIRECT_STAGE, progress, |_, sensor| Ok(method.illuminance(sensor)))?;
                sums.iter_mut().zip(part).for_each(|(sum, e)| *sum += e);
                continue;
            }
            let receptions: Vec<Seen<'_>> = bases(emission)
                .into_iter()
                .map(|basis| self.seen(scene, index, basis, progress))
                .collect::<Result<_, StudyError>>()?;
            let bands = match emission.bands.first() {
                Some(bands) => Some(self.band_weights(scene, index, bands, progress)?),
                None => None,
            };
            // Below this a sensor is dark: the error is relative to the illuminance, also in dark corners, since the
            // error that the rules state there is thousands of times the actual one.
            let absolute = 1e-14 * facing.outside.diffuse_horizontal();
            let tolerance = Tolerance { absolute, relative, max_pieces: 4000 };
            let part = in_blocks(scene, DIRECT_STAGE, progress, |s, sensor| {
                let own: Vec<Cow<'_, Reception>> = receptions.iter().map(|all| all.of(s, sensor)).collect();
                let own: Vec<&Reception> = own.iter().map(|one| &**one).collect();
                let bands = bands.as_ref().map(|all| all.of(s, sensor));
                Ok(direct::illuminance(sensor, aperture, &own, bands.as_deref(), emission, &facing, tolerance))
            })?;
            for (sum, e) in sums.iter_mut().zip(part) {
                *sum += e;
            }
        }
        Ok(sums)
    }
}

/// Returns the note on how the beams of an aperture were computed.
fn sun_word(emission: &Emission, interpolation: Interpolation) -> String {
    let note = emission.notes.iter().rev().find_map(|note| note.strip_prefix("sun: "));
    match (note, emission.beam_source) {
        (Some(note), _) => note.to_owned(),
        (None, BeamSource::None) => "no sun, or no system that keeps its light together".to_owned(),
        (None, BeamSource::Described) => "a regular transmittance".to_owned(),
        (None, _) if interpolation == Interpolation::Patch => {
            "the data are used as given: constant on their cells".to_owned()
        }
        (None, _) => "the data's own cells".to_owned(),
    }
}

/// Returns the bases of the emergent cells on which an aperture emits light; one `None` if it emits none on cells.
fn bases(emission: &Emission) -> Vec<Option<&RingBasis>> {
    let own: Vec<_> = emission.cells.iter().map(|light| Some(&*light.basis)).collect();
    if own.is_empty() { vec![None] } else { own }
}

fn aperture_key(scene: &Scene, index: usize) -> Key {
    let aperture = &scene.apertures[index].aperture;
    let mut key = vec![aperture.surface as u64];
    key.extend(bits(aperture.corner.to_array()));
    key.extend(bits(aperture.size));
    key
}

fn reception_key(scene: &Scene, index: usize, basis: Option<&RingBasis>) -> Key {
    let mut key = aperture_key(scene, index);
    key.extend(sensor_key(scene));
    key.extend(basis_key(basis));
    key
}

fn sensor_key(scene: &Scene) -> impl Iterator<Item = u64> + '_ {
    scene.sensors.iter().flat_map(|s| bits(s.position.to_array()).chain(bits(s.normal.to_array())))
}

/// Returns the key of an emergent basis in the caches; empty for none.
pub(crate) fn basis_key(basis: Option<&RingBasis>) -> Key {
    let mut key = Vec::new();
    if let Some(basis) = basis {
        key.push(basis.len() as u64);
        key.extend(bits([basis.azimuth().sign, basis.azimuth().offset]));
        for ring in basis.rings() {
            key.extend(bits([ring.theta_min, ring.theta_max, ring.first_phi]));
            key.push(ring.sectors as u64);
        }
    }
    key
}
