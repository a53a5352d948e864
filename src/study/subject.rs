//! All results of a scene that pictures and reports show, computed together by the same calls that window and command
//! line use.

use super::control::device::is_upright;
use super::control::slat_angle;
use super::error::StudyError;
use super::facing::sun_incident;
use super::incidence::Incidence;
use super::product_control::{
    TodayPoint, Year, YearKey, ordered_states, quantity, rule_curve, state_words, today, year as year_of_control,
};
use super::rank::{Look as RankLook, Shortlist};
use super::scene::Scene;
use super::scene_file::{ControlKeys, ControlMode, SceneFile, SystemKeys};
use super::session::{LidResult, RoomResult, Session};
use super::system::SystemLibrary;
use super::year::{self, Annual, Look};
use crate::catalogue::Product;
use crate::compute::btdf::{Btdf, Dataset};
use crate::compute::direction::Incident;
use crate::compute::estimate::Progress;
use crate::compute::lid::c_gamma::Peaks;
use std::path::Path;
use std::sync::Arc;

/// Request for the results of a scene.
pub struct Asked<'a> {
    /// Scene file, as typed.
    pub file: &'a SceneFile,
    /// Folder from which relative paths start.
    pub base: &'a Path,
    /// Incident direction for pictures of the product; `None`: that of the sun.
    pub incident: Option<Incident>,
    /// Requested kinds of results.
    pub wanted: Wanted,
}

/// Kinds of results that are requested; sky and system are always included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wanted {
    /// Luminous intensity distribution of the first aperture, with its largest intensities.
    pub lid: bool,
    /// Illuminances in the room.
    pub room: bool,
    /// States of the shading control over the scene's day and a year.
    pub control: bool,
    /// Annual simulation, which takes longer than all other results.
    pub year: bool,
}

impl Wanted {
    /// All results except the annual simulation.
    pub const ALL: Self = Self { lid: true, room: true, control: true, year: false };
    /// Only sky and system.
    pub const NOTHING: Self = Self { lid: false, room: false, control: false, year: false };
}

/// Shading control of the product in the first aperture, with its states over a day and a year.
#[derive(Debug, Clone, PartialEq)]
pub struct Controlled {
    /// Rule of the control.
    pub mode: ControlMode,
    /// Keys and numbers of the states (such as slat angles \[°\]), in ascending order of the numbers.
    pub states: Vec<(String, f64)>,
    /// Name and unit of the states' numbers, such as `slat angle / °`.
    pub quantity: &'static str,
    /// Curve of the rule as points: profile angle of the sun \[°\], and number of the state such as the slat angle
    /// \[°\]; empty for rules without a curve.
    pub curve: Vec<[f64; 2]>,
    /// States at every half hour of the scene's day; empty without site and date.
    pub today: Vec<TodayPoint>,
    /// Profile angle of the sun at the scene's moment \[°\]; `None` while the sun is not in front of the aperture.
    pub profile_angle: Option<f64>,
    /// Index, in `states`, of the state at the scene's moment.
    pub current: usize,
    /// States over a year; `None` without site and date.
    pub year: Option<Year>,
}

/// Scene with the results that pictures and reports show.
pub struct Subject {
    /// Scene file, as typed.
    pub file: SceneFile,
    /// Resolved scene.
    pub scene: Scene,
    /// Product in the first aperture; `None` for files and ideal systems.
    pub product: Option<Product>,
    /// Name of the product or system in the first aperture, with its state, as text.
    pub name: String,
    /// Label of the state of the first aperture's system; empty for a system without states.
    pub state: String,
    /// Incident direction for which pictures of the product are drawn.
    pub incidence: Incidence,
    /// Incident direction of the sun on the first aperture; `None` if the sun is not in front of it.
    pub sun: Option<Incident>,
    /// Flux and luminous intensity distribution of the first aperture, and its largest intensities; `None` if not
    /// requested.
    pub lid: Option<(LidResult, Peaks)>,
    /// Illuminances in the room; `None` if not requested.
    pub room: Option<RoomResult>,
    /// Shading control; `None` if nothing moves, or if not requested.
    pub control: Option<Controlled>,
    /// Annual simulation, with the settings for displaying it; `None` if not requested.
    pub year: Option<(Arc<Annual>, Look)>,
    /// Ranking, with the settings for displaying it; never computed here.
    pub ranking: Option<(Arc<Shortlist>, RankLook)>,
}

impl Subject {
    /// Computes the requested results of a scene. `product`: function that returns a product of the catalogue by its
    /// key.
    ///
    /// # Errors
    /// Returns an error if the scene or its system is incomplete, or if cancelled.
    pub fn of(
        asked: &Asked<'_>,
        session: &Session,
        library: &dyn SystemLibrary,
        product: &dyn Fn(&str) -> Result<Product, StudyError>,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        const STEPS: usize = 4;
        let file = asked.file;
        progress.advance("scene", 0, STEPS);
        let scene = Scene::resolve_within(file, asked.base, library, progress)?;
        let Some(first) = scene.apertures.first() else {
            return Err(StudyError::key("aperture", "the scene has none; expected at least one [[aperture]]"));
        };
        let product = match &file.aperture[0].system {
            SystemKeys::Catalogue { key, .. } => Some(product(key)?),
            _ => None,
        };
        let state = product
            .as_ref()
            .and_then(|product| product.states.iter().find(|one| one.key == first.system.state))
            .map_or_else(|| first.system.state.clone(), state_words);
        let label = &first.system.label;
        // The label of a described system of a file contains its state already.
        let is_complete = state.is_empty() || (product.is_none() && label.ends_with(&format!(", {state}")));
        let name = if is_complete { label.clone() } else { format!("{label}, {state}") };
        progress.advance("luminous intensities", 1, STEPS);
        let lid = if asked.wanted.lid {
            let result = session.lid(&scene, 0, progress)?;
            let peaks = Peaks::of(&result.lid, progress)?;
            Some((result, peaks))
        } else {
            None
        };
        progress.advance("room", 2, STEPS);
        let room = if asked.wanted.room { Some(session.room(&scene, progress)?) } else { None };
        progress.advance("control", 3, STEPS);
        let control = match &product {
            Some(product) if asked.wanted.control && product.states.len() > 1 => {
                Some(controlled(file, asked.base, product, &first.system.state, progress)?)
            }
            _ => None,
        };
        let year = if asked.wanted.year {
            let year = year::year(file, asked.base, library, session, &|_| true, progress)?;
            Some((Arc::new(Annual::new(file, year)), Look::default()))
        } else {
            None
        };
        let (incidence, sun) = (Incidence::shown(asked.incident, file, asked.base), sun_incident(file, asked.base));
        Ok(Self {
            file: file.clone(),
            product,
            name,
            state,
            incidence,
            sun,
            lid,
            room,
            control,
            year,
            ranking: None,
            scene,
        })
    }

    /// Returns the BSDF data of the first aperture's system.
    pub fn dataset(&self) -> &Dataset {
        &self.scene.apertures[0].system.dataset
    }

    /// Returns the transmission of the first aperture's system for light from outside; `None` only if luminaires
    /// replace it.
    pub fn transmission(&self) -> Option<&Btdf> {
        self.dataset().transmission()
    }
}

/// Computes the states of a product's control over the scene's day and a year. `state`: key of the present state.
fn controlled(
    file: &SceneFile,
    base: &Path,
    product: &Product,
    state: &str,
    progress: &dyn Progress,
) -> Result<Controlled, StudyError> {
    use super::control::year::CONTROLLED;
    let aperture = &file.aperture[0];
    let moves = matches!(&aperture.system, SystemKeys::Catalogue { state: Some(word), .. } if word == CONTROLLED);
    let rule = aperture.control.as_ref().or(file.control.as_ref()).filter(|_| moves);
    let by_hand = || ControlKeys { state: Some(state.to_owned()), ..ControlKeys::of(ControlMode::Fixed) };
    let keys = rule.cloned().unwrap_or_else(by_hand);
    let states = ordered_states(product);
    let curve = if keys.mode == ControlMode::Fixed {
        // With control by hand, the product's own curve is shown for orientation.
        product.control_curve.iter().map(|point| [point.profile_angle, point.value]).collect()
    } else {
        rule_curve(product, &keys, base)?
    };
    let mode = keys.mode;
    let key = YearKey::new(file, &product.key, keys, 0, base.to_owned());
    let today = match &key {
        Some(key) => today(product, key, file)?,
        None => Vec::new(),
    };
    let year = key.map(|key| year_of_control(product, key, progress)).transpose()?;
    Ok(Controlled {
        mode,
        current: states.iter().position(|(key, _)| key == state).unwrap_or(0),
        states,
        quantity: quantity(product),
        curve,
        today,
        profile_angle: sun_incident(file, base).map(|sun| slat_angle(sun.0, is_upright(&product.system)).to_degrees()),
        year,
    })
}
