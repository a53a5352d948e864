//! Resolved scene: its keys checked together, its systems loaded, and everything in the units and frames of `compute`.

use super::control::table::of_scene;
use super::control::year::CONTROLLED;
use super::control::{ControlQuestion, Device, pick_state};
use super::error::StudyError;
use super::luminaires;
use super::near_field::near_field;
use super::outside::Before;
use super::scene_file::units::unit_of;
use super::scene_file::{
    ApertureKeys, ApertureReflectance, BackReflectionMode, BeamMode, Interpolation, SceneFile, SystemKeys,
};
use super::scene_places::{apertures, clear, room, sensors, within};
use super::sky::{HourOfWeather, Illuminances, hour_of_weather, illuminances, outside_from_keys};
use super::sun_position::parse_local_time;
use super::system::{Need, System, SystemLibrary, separate_regular};
use crate::compute::angle::Bearing;
use crate::compute::btdf::{Btdf, CellMatrix};
use crate::compute::direction::Orientation;
use crate::compute::estimate::{Progress, Silent};
use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
use crate::compute::lid::{Facing, Lamps};
use crate::compute::room::aperture::Aperture;
use crate::compute::room::back_reflection::reflecting_cells;
use crate::compute::room::direct::Sensor;
use crate::compute::room::mesh::BoxRoom;
use crate::compute::room::near_field::{NearField, homogeneity};
use crate::compute::sky::{GroundShade, Outside, Sun};
use crate::formats::encoding::{TooLong, not_too_long};
use crate::formats::system_toml::is_system_file;
use crate::formats::toml_place::{TomlPlace, place};
use std::path::Path;
use std::sync::Arc;

/// Aperture of a resolved scene, with its system.
#[derive(Debug, Clone)]
pub struct SceneAperture {
    /// Position and size of the aperture.
    pub aperture: Aperture,
    /// System of the aperture.
    pub system: Arc<System>,
    /// Transmission of the system with regular transmission separated from scattered light; `None` if regular
    /// transmission is not recognised in patch-averaged data.
    pub separated: Option<Arc<Btdf>>,
    /// Diffuse reflectance of the room side of the system, 0 … 1.
    pub reflectance: f64,
    /// Period of the structure that is visible to the eye (pitch of slats or cuts); `None` if it is not known. \[m\]
    pub structure: Option<f64>,
    /// Whether the room side reflects by direction, with the back reflection of the dataset, instead of diffusely.
    pub directional: bool,
    /// Transmission factor of frame and dirt together, 0 … 1.
    pub clear: f64,
    /// Key of the state that a control has chosen; `None` if the scene names the state.
    pub controlled: Option<String>,
    /// Luminaires that light the room in place of the system; `None` if light enters from outside through the system.
    pub lamps: Option<Arc<Lamps>>,
}

impl SceneAperture {
    /// Returns the transmission for light from outside, with regular transmission separated unless the scene uses the
    /// data as given; `None` if luminaires replace the system.
    pub fn transmission(&self) -> Option<&Btdf> {
        self.separated.as_deref().or_else(|| self.system.dataset.transmission())
    }

    /// Returns the distance below which sensors could distinguish the structure of the system (such as single slats),
    /// which the data do not contain; `None` if it is not known. \[m\]
    pub fn homogeneity_distance(&self) -> Option<f64> {
        self.structure.map(homogeneity::distance)
    }

    /// Returns the diffuse reflectance of the room side, 0 … 1; 0 if it reflects by direction.
    pub fn diffuse_reflectance(&self) -> f64 {
        if self.directional { 0.0 } else { self.reflectance }
    }

    /// Returns the back reflection of the dataset by patches; `None` if the room side reflects diffusely.
    pub fn back_reflection(&self) -> Option<&CellMatrix> {
        reflecting_cells(self.system.dataset.visible.reflection_back.as_ref()?.scattered.as_ref())
            .filter(|_| self.directional)
    }
}

/// Resolved scene, ready for computation.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Room as a box, with its reflectances.
    pub room: BoxRoom,
    /// Apertures, at least one.
    pub apertures: Vec<SceneAperture>,
    /// Orientation of the room: its axes relative to north.
    pub orientation: Orientation,
    /// Bearing of the façade's outward normal, clockwise from north.
    pub facade: Bearing,
    /// Sky, ground and skyline, with boxes outside.
    pub outside: Outside,
    /// Sun; `None` if it is down or has no direct illuminance.
    pub sun: Option<Sun>,
    /// Illuminances to which sky and sun were scaled; `None` for skies with absolute values.
    pub illuminances: Option<Illuminances>,
    /// Sensor points of the room, with their normals.
    pub sensors: Vec<Sensor>,
    /// Numbers of sensors along x and y if the sensors are those of `sensors.plane`; else `None`.
    pub grid: Option<[usize; 2]>,
    /// Whether interreflection is computed.
    pub interreflection: bool,
    /// Relative error target of the illuminances; `None` if the scene does not give one.
    pub error_target: Option<f64>,
    /// Treatment of BSDF data between and within their directions: interpolated, or constant on their patches.
    pub interpolation: Interpolation,
    /// Whether sunlight is transmitted as sharp beams where systems do not scatter it.
    pub beams: bool,
    /// Scheme of interpolation between the incident directions of a dataset, for the sun.
    pub sun_interpolation: SunScheme,
    /// Scheme of interpolation between the incident directions of a dataset, for sky and ground.
    pub diffuse_interpolation: DiffuseScheme,
    /// Method of integrating the light of an aperture at a sensor.
    pub near_field: NearField,
    /// Notes for the user on boxes outside that were left out, and on assumptions.
    pub outside_notes: Vec<String>,
    /// Weather hour from which sky and sun were taken; `None` for sky models.
    pub weather: Option<HourOfWeather>,
}

impl SceneFile {
    /// Reads a scene file from its TOML text.
    pub fn parse(text: &str) -> Result<Self, StudyError> {
        let wrong = |error: TooLong| StudyError::Syntax { line: 1, column: 1, message: error.to_string() };
        toml::from_str(not_too_long(text).map_err(wrong)?).map_err(|error| {
            let TomlPlace { line, column, key, message } = place(text, &error, 1, unit_of);
            let message = if key.is_empty() { message } else { format!("{key}: {message}") };
            StudyError::Syntax { line, column, message }
        })
    }
}

impl Scene {
    /// Resolves a scene like [`Self::resolve_within`], without reporting progress. `base`: folder from which relative
    /// paths start.
    ///
    /// # Errors
    /// Returns an error if a key is wrong or a file cannot be read.
    pub fn resolve(file: &SceneFile, base: &Path, library: &dyn SystemLibrary) -> Result<Self, StudyError> {
        Self::resolve_within(file, base, library, &Silent)
    }

    /// Resolves a scene: checks the keys together, loads the systems, and computes the light on obstructions outside.
    /// `base`: folder from which relative paths start.
    ///
    /// # Errors
    /// Returns an error if a key is wrong or a file cannot be read, or if cancelled.
    pub fn resolve_within(
        file: &SceneFile,
        base: &Path,
        library: &dyn SystemLibrary,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let room = room(&file.room)?;
        let (outside, sun) =
            outside_from_keys(&file.sky, &file.site, base).map_err(|e| StudyError::key(e.key, e.message))?;
        let illuminances = illuminances(&file.sky, &file.site).map_err(|e| StudyError::key(e.key, e.message))?;
        let weather = hour_of_weather(&file.sky, &file.site, base).map_err(|e| StudyError::key(e.key, e.message))?;
        let facade = Bearing::from_degrees(file.site.azimuth);
        let orientation = Orientation::new(facade);
        let geometry = apertures(&file.aperture, &room)?;
        let before = Before::of(file, &room, &geometry)?;
        let outside = before.stand(outside, sun.as_ref(), orientation, library.lit_obstructions(), progress)?;
        let (sensors, grid) = sensors(&file.sensors, &room)?;
        let (hour, of_year) = (hour(file)?, of_scene(file));
        let mut list = Vec::with_capacity(geometry.len());
        let beams = file.compute.beam == BeamMode::Auto && file.compute.interpolation == Interpolation::Auto;
        for (index, (keys, aperture)) in file.aperture.iter().zip(geometry).enumerate() {
            let facing = Facing { outside: &outside, sun: sun.as_ref(), orientation, surface: aperture.surface };
            let rule = keys.control.as_ref().or(file.control.as_ref());
            let asked = rule.map(|keys| ControlQuestion { keys, base, hour, of_year, facing, aperture });
            let wanted = controlled_state(keys, asked.as_ref(), library).map_err(|error| match &error {
                // The scene's own section has its place in the file already.
                StudyError::Key { key, .. } if key.starts_with("control.") && keys.control.is_none() => error,
                _ => in_aperture(index, error),
            })?;
            let picked = if wanted == keys.system { None } else { wanted_state(&wanted) };
            // Without diffuse light, and without back reflection, a description need not be converted to data.
            let back = file.compute.interreflection && reflects(file);
            let need = if back || !beams { Need::Everything } else { Need::Light { lit: facing.outside.is_lit() } };
            let lamps = match &wanted {
                SystemKeys::Luminaires { index: name, set } => {
                    let read = luminaires::in_place_of(&aperture, &base.join(name), set.as_deref());
                    Some(read.map_err(|error| in_aperture(index, error))?)
                }
                _ => None,
            };
            let system = match &wanted {
                SystemKeys::Luminaires { index: name, .. } => luminaires::as_system(name),
                _ => library.load(&wanted, base, need).map_err(|error| in_aperture(index, error))?,
            };
            if lamps.is_none() && system.dataset.transmission().is_none() {
                return Err(StudyError::key(
                    format!("aperture[{}].system", index + 1),
                    format!(
                        "'{}' has no transmission data, only {:?}",
                        system.label,
                        system.dataset.visible.components()
                    ),
                ));
            }
            let reflectance = match keys.reflectance {
                ApertureReflectance::Value(value) => {
                    within(&format!("aperture[{}].reflectance", index + 1), value, 0.0, 1.0, "")?
                }
                ApertureReflectance::Dataset => system.dataset.room_side_reflectance().unwrap_or(0.0),
            };
            let structure = match keys.structure {
                Some(period) => Some(within(&format!("aperture[{}].structure", index + 1), period, 1e-9, 100.0, " m")?),
                None => system.dataset.structure,
            };
            let by_dataset = matches!(keys.reflectance, ApertureReflectance::Dataset);
            // A state costs little more by its cells than as diffuse: the room is black to it and shared by all states.
            let directional = by_dataset
                && file.compute.interreflection
                && reflects_by_cells(&system)
                && match file.compute.back_reflection {
                    BackReflectionMode::Diffuse => false,
                    BackReflectionMode::Directional => true,
                    // What falls on an aperture straight from another is known as an illuminance, not by cells.
                    BackReflectionMode::Auto => file.aperture.iter().all(|other| other.surface == keys.surface),
                };
            let clear = clear(keys, index)?;
            let controlled = picked;
            let separated = if beams { separate_regular(&system.dataset) } else { None };
            list.push(SceneAperture {
                aperture,
                system,
                separated,
                reflectance,
                structure,
                directional,
                clear,
                controlled,
                lamps,
            });
        }
        if let Some(target) = file.compute.error_target {
            within("compute.error_target", target, 1e-8, 1.0, "")?;
        }
        Ok(Self {
            room,
            apertures: list,
            orientation,
            facade,
            outside,
            sun,
            illuminances,
            sensors,
            grid,
            interreflection: file.compute.interreflection,
            error_target: file.compute.error_target,
            interpolation: file.compute.interpolation,
            beams,
            sun_interpolation: file.compute.sun_interpolation,
            diffuse_interpolation: file.compute.diffuse_interpolation,
            outside_notes: before.notes,
            near_field: near_field(file.compute.near_field, file.compute.near_field_samples)?,
            weather,
        })
    }

    /// Returns, for each aperture, the number of sensors nearer to it than its homogeneity distance.
    pub fn too_near(&self) -> Vec<usize> {
        let nearer = |one: &SceneAperture| {
            one.homogeneity_distance().map_or(0, |limit| {
                self.sensors.iter().filter(|sensor| one.aperture.distance(sensor.position) < limit).count()
            })
        };
        self.apertures.iter().map(nearer).collect()
    }

    /// Returns outside and sun in relation to one aperture. `aperture`: its index.
    pub fn facing(&self, aperture: usize) -> Facing<'_> {
        Facing {
            outside: &self.outside,
            sun: self.sun.as_ref(),
            orientation: self.orientation,
            surface: self.apertures[aperture].aperture.surface,
        }
    }
}

/// Returns sky and ground with the obstructions outside, as seen from the centre of the first aperture; `None` without
/// obstructions.
///
/// # Errors
/// Returns an error if a key of room, apertures or boxes is wrong, or if cancelled.
pub fn seen_by_first_aperture(
    file: &SceneFile,
    outside: &Outside,
    sun: Option<&Sun>,
    progress: &dyn Progress,
) -> Result<Option<Outside>, StudyError> {
    if !file.has_outside() && outside.surroundings().is_none() {
        return Ok(None);
    }
    let room = room(&file.room)?;
    let geometry = apertures(&file.aperture, &room)?;
    let orientation = Orientation::new(Bearing::from_degrees(file.site.azimuth));
    let Some([low, _, high, _]) = geometry.first().map(Aperture::corners) else { return Ok(None) };
    // Seen from that point alone: faces that are visible only from elsewhere stay dark.
    let eye = 0.5 * (low + high);
    let before = Before::of(file, &room, &geometry)?.seen_from(eye);
    let behind = before.stand(outside.clone(), sun, orientation, None, progress)?;
    Ok(Some(behind.seen_from(orientation.to_world(eye))))
}

/// Computes the ground with the shadows of the obstructions on it, in room axes; `None` without obstructions above
/// ground that lies at the level of the room's floor. `outside`: sky with its skyline.
///
/// # Errors
/// Returns an error if a key of room, apertures or boxes is wrong.
pub fn ground_shade(file: &SceneFile, outside: &Outside, sun: Option<&Sun>) -> Result<Option<GroundShade>, StudyError> {
    let room = room(&file.room)?;
    let before = Before::of(file, &room, &apertures(&file.aperture, &room)?)?;
    Ok(before.ground_shade(outside, sun, Orientation::new(Bearing::from_degrees(file.site.azimuth))))
}

/// Returns the area of all six sides of the room. \[m²\]
pub(super) fn surface(room: &BoxRoom) -> f64 {
    let s = room.size;
    2.0 * (s.x * s.y + s.y * s.z + s.z * s.x)
}

/// Whether the dataset of a system has a back reflection that can be computed by direction. This excludes regular
/// reflection, such as that of a pane.
fn reflects_by_cells(system: &System) -> bool {
    system
        .dataset
        .visible
        .reflection_back
        .as_ref()
        .is_some_and(|btdf| btdf.regular.is_none() && reflecting_cells(btdf.scattered.as_ref()).is_some())
}

/// Returns an error with the number of the aperture in which it occurred added to the key.
fn in_aperture(index: usize, error: StudyError) -> StudyError {
    let place = |key: &str| format!("aperture[{}].{key}", index + 1);
    match error {
        StudyError::Key { key, message } => StudyError::Key { key: place(&key), message },
        StudyError::File { path, message } => {
            StudyError::Key { key: place("system.file"), message: format!("{}: {message}", path.display()) }
        }
        StudyError::Catalogue(message) => StudyError::Key { key: place("system.catalogue"), message },
        other => other,
    }
}

/// Returns the keys of an aperture's system with the state that the control chooses, if the aperture leaves the state
/// to it; else unchanged. `asked`: input of the control.
fn controlled_state(
    keys: &ApertureKeys,
    asked: Option<&ControlQuestion<'_>>,
    library: &dyn SystemLibrary,
) -> Result<SystemKeys, StudyError> {
    let without = || StudyError::key("system.state", "\"controlled\" needs a [control] section with a mode");
    match &keys.system {
        SystemKeys::Catalogue { key, state: Some(word) } if word == CONTROLLED => {
            let asked = asked.ok_or_else(without)?;
            let state = library.controlled_state(key, asked)?;
            Ok(SystemKeys::Catalogue { key: key.clone(), state: Some(state) })
        }
        SystemKeys::File { path, state: Some(word) }
            if word == CONTROLLED && is_system_file(&path.to_string_lossy()) =>
        {
            let asked = asked.ok_or_else(without)?;
            let state = library.controlled_description(&asked.base.join(path), asked)?;
            Ok(SystemKeys::File { path: path.clone(), state: Some(state) })
        }
        SystemKeys::Family { states, state: Some(word) } if word == CONTROLLED => {
            let asked = asked.ok_or_else(without)?;
            let state = pick_state(&Device::of_family(states), asked)?;
            Ok(SystemKeys::Family { states: states.clone(), state: Some(state) })
        }
        other => Ok(other.clone()),
    }
}

/// Whether light may reach an aperture from the room: from reflecting surfaces, or from another aperture.
fn reflects(file: &SceneFile) -> bool {
    let rho = &file.room.reflectance;
    rho.floor > 0.0 || rho.walls > 0.0 || rho.ceiling > 0.0 || file.aperture.len() > 1
}

/// Returns the local time of the scene in hours from midnight; `None` if the sun is given by angles.
fn hour(file: &SceneFile) -> Result<Option<f64>, StudyError> {
    let Some(time) = &file.sky.time else { return Ok(None) };
    let time = parse_local_time(&time.text()).map_err(|error| StudyError::key("sky.time", error.to_string()))?;
    Ok(Some(f64::from(time.hour()) + f64::from(time.minute()) / 60.0))
}

/// Returns the key of the state that a system's keys name; `None` if they name none.
fn wanted_state(keys: &SystemKeys) -> Option<String> {
    match keys {
        SystemKeys::Catalogue { state, .. } | SystemKeys::File { state, .. } | SystemKeys::Family { state, .. } => {
            state.clone()
        }
        SystemKeys::Ideal { .. } | SystemKeys::Luminaires { .. } | SystemKeys::Ranked => None,
    }
}
