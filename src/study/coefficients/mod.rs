//! Daylight coefficients: a scene is prepared once, so that the illuminances under a new sky or sun are the product of
//! its luminances with the response of every sensor, E = V·T·D·s, interreflection included.
//!
//! | file | content |
//! | --- | --- |
//! | `views` | V: sensors by emergent cell |
//! | `transport` | V·T: sensors by incident direction |
//! | `described` | V·T of described systems |
//! | `columns` | V·T of all incident patches, and the table of sky, ground and skyline |
//! | `part` | V·T·D of an aperture: sky, ground and skyline |
//! | `behind`, `sent`, `by_node` | V·T·D behind boxes: columns by luminance |
//! | `straight` | the outside seen by regular transmission |
//! | `far` | distant skyline: its light, and the directions that it hides |
//! | `sun_way` | transmission of direct sunlight through a system |
//! | `beam` | light of the sun |
//!
//! Direct sunlight is computed for the actual sun position: by the description where there is one, with the beams that
//! are extracted from the data's cells, or, with `[compute] beam = "cells"`, by the data's own cells or directions.
//!
//! Prepared are the room, its apertures and sensors, the systems in their current states and the altitude of the
//! skyline. For a measured sky, which is constant over patches with jumps between them, and for a skyline of another
//! altitude no fixed directions are suitable: their light is integrated again, which takes milliseconds.

mod beam;
mod behind;
mod by_node;
mod columns;
mod described;
mod part;
mod sent;
mod straight;
mod sun_way;
mod transport;
mod views;

use super::cache::{Cache, Store};
use super::error::StudyError;
use super::scene::Scene;
use super::scene_file::ORDINARY_TARGET;
use super::session::Session;
use super::session::data_share::DataShare;
use super::session::far;
use super::session::interreflected::{PATCHES, REST};
use super::session::responses::Responses;
use super::session::unit_beams::UnitBeams;
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, World};
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::room::near_field::NearField;
use crate::compute::sky::perez::PerezState;
use crate::compute::sky::{Distribution, Outside, Prepared, Sun};
use behind::Behind;
pub(super) use behind::seen_by_points;
use faer::Mat;
pub(super) use part::TOGETHER;
use part::{AperturePart, Sums, Way};
pub(super) use sent::Sent;
use std::sync::Arc;
pub(super) use transport::{SPACING, patches as incident_patches};
use views::Opening;

/// Scene prepared for many skies and suns, by daylight coefficients.
pub struct Coefficients {
    scene: Scene,
    parts: Vec<AperturePart>,
    behind: Option<Behind>,
    room: Option<Responses>,
    /// Responses of the sensors to beams; `None` if no aperture sends beams.
    unit_beams: Option<Arc<UnitBeams>>,
    directions: f64,
    /// Uncertainty of the illuminances by the BSDF data, by aperture, as shares of its light.
    data: Vec<DataShare>,
    /// Expected number of sun positions; 0 if not known.
    suns: usize,
}

/// Relative error of the illuminances by preparing obstructions for many skies: the bound in the test of [`Prepared`],
/// and a third more.
const BEHIND: f64 = 4e-3;
/// Safety factor on the error of evaluating skies in fixed directions, which is determined for a few skies and stated
/// for all others.
const OTHER_SKIES: f64 = 2.0;

/// Altitude of the sun in the sky with the steepest gradients among the trial skies. \[rad\]
const STEEP: f64 = 0.5;

/// Returns the skies (without ground) for which the error of fixed directions is determined: two clear ones, and one
/// with steep gradients.
fn trial_skies(facade: Bearing) -> Vec<Outside> {
    let under = |of: &dyn Fn(Dir<World>) -> Option<Distribution>, altitude: f64, turn: f64| {
        let sun = Dir::from_altitude_bearing(altitude, Bearing::from_radians(facade.radians() + turn));
        Outside::new(of(sun)?, 1e4).ok()
    };
    // The steepest of those that weather brings: a strong sun and little light from the sky.
    let steep = |sun| Some(Distribution::perez(&PerezState::new(STEEP, 500.0, 60.0, 1.0)?, sun));
    let skies = [
        under(&|sun| Distribution::cie(12, sun), 0.5, 0.4),
        under(&|sun| Distribution::cie(2, sun), 0.9, -0.7),
        under(&steep, STEEP, 0.2),
    ];
    skies.into_iter().flatten().collect()
}

impl Coefficients {
    /// Prepares a scene. Its own sky and sun do not matter, except that the mesh of the room is refined until the
    /// illuminances under this sky meet the error target.
    ///
    /// # Errors
    /// Returns an error if the scene needs a near-field method other than the solid-angle method, has luminaire files
    /// or boxes, cannot be computed, or if cancelled.
    pub fn new(session: &Session, scene: &Scene, progress: &dyn Progress) -> Result<Self, StudyError> {
        Self::past(session, scene, None, progress)
    }

    /// Prepares a scene behind obstructions that are prepared already (`prepared`); the outside of `scene` must have
    /// none.
    ///
    /// # Errors
    /// Returns the errors of [`Self::new`].
    pub fn past(
        session: &Session,
        scene: &Scene,
        prepared: Option<&Arc<Prepared>>,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        if scene.near_field != NearField::SolidAngle {
            return Err(StudyError::key(
                "compute.near_field",
                "coefficients need the solid-angle method; remove the key",
            ));
        }
        if let Some(index) = scene.apertures.iter().position(|one| one.lamps.is_some()) {
            return Err(StudyError::key(
                format!("aperture[{}].system.luminaires", index + 1),
                "luminaire files hold the light of one sky; name the system itself here",
            ));
        }
        if scene.outside.surroundings().is_some_and(|around| !around.solids.is_empty()) {
            let message = "coefficients do not support boxes: remove the key, or compute single hours";
            return Err(StudyError::key("outside", message));
        }
        let reflects = scene.room.floor > 0.0
            || scene.room.walls > 0.0
            || scene.room.ceiling > 0.0
            || scene.apertures.iter().any(|a| a.reflectance > 0.0);
        // Direct light by aperture, shared by all meshes of the room.
        let direct = Cache::new(&Arc::new(Store::new(usize::MAX)), |_| 0);
        if !(scene.interreflection && reflects) {
            let mut coefficients = Self::with(session, scene, prepared, None, &direct, progress)?;
            coefficients.add_data_uncertainty(session, progress)?;
            return Ok(coefficients);
        }
        let target = scene.error_target.unwrap_or(ORDINARY_TARGET);
        let turns = if scene.error_target.is_some() { PATCHES.len() } else { 2 };
        let mut turn = 0;
        loop {
            progress.advance("coefficients", turn, turns);
            let room = session.responses(scene, PATCHES[turn], progress)?;
            let mut coefficients = Self::with(session, scene, prepared, Some(room), &direct, progress)?;
            turn += 1;
            let light = coefficients.sky_estimate(&scene.outside);
            let mean = light.iter().map(|e| e.value).sum::<f64>() / light.len().max(1) as f64;
            if turn == turns || light.iter().all(|e| e.error <= 0.9 * target * e.value.max(0.1 * mean)) {
                coefficients.add_data_uncertainty(session, progress)?;
                return Ok(coefficients);
            }
        }
    }

    /// Prepares a scene with the given responses of the room, `None` without interreflection.
    fn with(
        session: &Session,
        scene: &Scene,
        prepared: Option<&Arc<Prepared>>,
        room: Option<Responses>,
        direct: &Cache<Mat<f32>>,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let behind = prepared.map(|prepared| Behind::new(Arc::clone(prepared)));
        let parts = (0..scene.apertures.len())
            .map(|index| {
                let btdf = scene.apertures[index].transmission();
                let btdf = btdf.expect("a resolved scene has only systems with transmission data");
                let opening = Opening { session, scene, index, room: room.as_ref(), nodes: None, progress };
                AperturePart::new(&opening, btdf, behind.as_ref().map(|behind| (behind, direct)))
            })
            .collect::<Result<Vec<_>, _>>()?;
        let unit_beams = match &room {
            Some(room) if parts.iter().any(AperturePart::sends_beams) => Some(session.unit_beams(scene, room)?),
            _ => None,
        };
        let mut coefficients =
            Self { scene: scene.clone(), parts, behind, room, unit_beams, directions: 0.0, data: Vec::new(), suns: 0 };
        coefficients.directions = match &coefficients.behind {
            Some(_) => BEHIND,
            None => OTHER_SKIES * coefficients.gap_of_directions(session),
        };
        Ok(coefficients)
    }

    /// Adds the uncertainty by the BSDF data, which a finer mesh does not reduce.
    fn add_data_uncertainty(&mut self, session: &Session, progress: &dyn Progress) -> Result<(), StudyError> {
        let known = |index: usize| self.parts[index].transport.estimates_uncertainty();
        self.data = session.data_shares(&self.scene, known, progress)?;
        Ok(())
    }

    /// Returns the largest relative difference of an illuminance between evaluation in fixed directions and
    /// integration, under the scene's sky and the trial skies.
    fn gap_of_directions(&self, session: &Session) -> f64 {
        let around = self.scene.outside.surroundings().map(|around| Arc::new(around.clone()));
        let own = &self.scene.outside;
        let before = |open: &Outside| match &around {
            Some(around) => Some(open.clone().behind(Arc::clone(around))),
            None => open.clone().with_skyline(own.skyline_altitude(), own.skyline_luminance()).ok(),
        };
        let trial = session.trial_skies(self.scene.facade, || trial_skies(self.scene.facade));
        let skies = std::iter::once(Some(own.clone())).chain(trial.iter().map(before));
        let mut largest: f64 = 0.0;
        for outside in skies.flatten().filter(|outside| self.is_smooth(outside)) {
            let (fixed, exact) =
                (self.diffuse(&outside, Way::Fixed), self.diffuse(&outside, Way::Exact(Some(session))));
            let mean = exact.iter().sum::<f64>() / exact.len().max(1) as f64;
            if mean > 0.0 {
                let gap = fixed.iter().zip(&exact).map(|(a, b)| (a - b).abs() / b.max(0.05 * mean));
                largest = gap.fold(largest, f64::max);
            }
        }
        largest
    }

    /// Whether an outside can be evaluated in the fixed directions.
    fn is_smooth(&self, outside: &Outside) -> bool {
        self.behind.is_some() || !outside.is_piecewise_constant() && far::same(outside, &self.scene.outside)
    }

    /// Stores in `session`, for all systems, the light of each hour of a year on the patches of this scene. `year`: a
    /// number that no year of other skies has, and the number of its hours; `suns`: approximate number of sun positions.
    /// If they are many, scattered sunlight may be interpolated between directions, with the error of that. The hours
    /// are then computed by [`Self::hours_estimate`].
    pub fn keep_year(&mut self, session: &Session, year: (u64, usize), suns: usize) {
        self.suns = suns;
        let parts = self.parts.iter_mut().enumerate();
        parts.for_each(|(index, part)| part.keep_year(session, (&self.scene, index), year));
    }

    fn way(&self, outside: &Outside) -> Way<'static> {
        if self.is_smooth(outside) { Way::Fixed } else { Way::Exact(None) }
    }

    fn diffuse(&self, outside: &Outside, way: Way<'_>) -> Vec<f64> {
        let mut sums = vec![0.0; self.scene.sensors.len()];
        for (index, part) in self.parts.iter().enumerate() {
            part.add(&self.scene, index, outside, way, &mut sums);
        }
        sums.iter_mut().for_each(|e| *e = e.max(0.0));
        sums
    }

    /// Computes the diffuse illuminance at every sensor by sky, ground and skyline. \[lx\]
    pub fn sky(&self, outside: &Outside) -> Vec<f64> {
        self.diffuse(outside, self.way(outside))
    }

    /// Computes the diffuse illuminance at every sensor by sky, ground and skyline, with its error. \[lx\]
    pub fn sky_estimate(&self, outside: &Outside) -> Vec<Estimate> {
        self.estimated(&[(outside, self.way(outside))]).swap_remove(0)
    }

    /// Computes the diffuse illuminances with their errors for hours of the year given to [`Self::keep_year`]: index,
    /// outside and sun of each. \[lx\] The results are those of [`Self::sky_estimate`]; many hours together take less
    /// time.
    pub fn hours_estimate(&self, hours: &[(usize, &Outside, Option<&Sun>)]) -> Vec<Vec<Estimate>> {
        let way = |&(hour, outside, sun)| {
            (outside, if self.is_smooth(outside) { Way::Hour(hour, sun) } else { Way::Exact(None) })
        };
        self.estimated(&hours.iter().map(way).collect::<Vec<_>>())
    }

    /// Computes the diffuse illuminances of several skies with their errors, each by the given method. \[lx\]
    fn estimated(&self, skies: &[(&Outside, Way<'_>)]) -> Vec<Vec<Estimate>> {
        let sensors = self.scene.sensors.len();
        let mut estimates = vec![vec![Estimate::default(); sensors]; skies.len()];
        for (index, part) in self.parts.iter().enumerate() {
            let mut sums: Vec<Sums> = skies.iter().map(|_| Sums::dark(sensors)).collect();
            part.add_sums(&self.scene, index, skies, &mut sums);
            let rest = self.rest().hypot(0.5 * part.gap);
            for ((estimates, sums), (_, way)) in estimates.iter_mut().zip(sums).zip(skies) {
                let directions = if matches!(way, Way::Exact(_)) { 1e-5 } else { self.directions };
                let relative = part.relative_error + directions;
                for (s, sum) in estimates.iter_mut().enumerate() {
                    let (value, reflected) = (sums.total[s].max(0.0), sums.reflected[s].abs());
                    let squares = sums.reflected_uncertainty[s].powi(2) + (rest * reflected).powi(2);
                    let error = value * relative + squares.sqrt() + sums.interpolated[s].abs() + 1e-6 * value;
                    let data = self.data.get(index).map_or(0.0, |share| {
                        let straight = share.direct.get(s).map_or(0.0, |share| share * (value - reflected).max(0.0));
                        straight + share.reflected * reflected
                    });
                    *sum += Estimate::new(value, error + data);
                }
            }
        }
        estimates
    }

    /// Returns the relative error of an illuminance by evaluating skies in fixed directions, at the sensor where it is
    /// largest: twice the difference from integration, under the scene's sky and three trial skies. It is part of the
    /// errors of [`Self::sky_estimate`].
    pub fn error(&self) -> f64 {
        self.directions
    }

    /// Returns the number of directions in which the luminance of a new sky is evaluated.
    pub fn evaluations(&self) -> usize {
        self.parts.iter().map(AperturePart::evaluations).sum()
    }

    /// Returns the error of the mesh that both of its densities share, relative to the interreflected illuminance.
    fn rest(&self) -> f64 {
        self.room.as_ref().map_or(0.0, |room| REST / room.radiosity.nested.fine.patches.len() as f64)
    }
}
