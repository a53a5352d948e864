//! Checks of the keys `[year]`: ranges, and consistency with the rest of the scene.

use crate::compute::room::direct::Sensor;
use crate::compute::year::lighting::{Control, Lamps, Zone};
use crate::study::error::StudyError;
use crate::study::scene_file::{ApertureKeys, SceneFile, SystemKeys};
use crate::study::year_keys::{LampControlKey, LightingKeys, YearKeys};
use glam::DVec3;

/// Settings of an annual simulation: checked keys of `[year]` with what follows from them.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Keys of `[year]` as in the scene file.
    pub keys: YearKeys,
    /// Area of the floor. \[m²\]
    pub floor: f64,
    /// Number of the scene's sensors, without observers.
    pub sensors: usize,
    /// Observers as sensors: position of the eye, with the view direction as normal.
    pub eyes: Vec<Sensor>,
    /// Electric lighting; `None` without `year.lighting`.
    pub lamps: Option<Lamps>,
    /// Whether the illuminances in unoccupied hours are needed; if not, those hours are left out.
    pub unoccupied: bool,
    /// Whether the illuminances by direct sun alone are needed at the sensors.
    pub direct_sun: bool,
}

fn within(key: &str, value: f64, min: f64, max: f64, unit: &str) -> Result<f64, StudyError> {
    if (min..=max).contains(&value) {
        Ok(value)
    } else {
        Err(StudyError::key(
            format!("year.{key}"),
            format!("{value}{unit} is out of range (allowed: {min} to {max}{unit})"),
        ))
    }
}

/// Checks the keys `[year]` of a scene, and returns the settings of its annual simulation.
///
/// # Errors
/// Returns an error if there is no `[year]`, or a key is out of range.
pub fn settings(file: &SceneFile) -> Result<Settings, StudyError> {
    let Some(keys) = &file.year else {
        return Err(StudyError::key("year", "missing: give [year] with weather = \"x.epw\""));
    };
    let files = |one: &ApertureKeys| matches!(one.system, SystemKeys::Luminaires { .. });
    if let Some(index) = file.aperture.iter().position(files) {
        let key = format!("aperture[{}].system.luminaires", index + 1);
        return Err(StudyError::key(
            key,
            "luminaire files hold the light of one sky; name the system itself for a year",
        ));
    }
    if ![1, 2, 4, 12].contains(&keys.steps_per_hour) {
        let message = format!("{} (allowed: 1, 2, 4 or 12)", keys.steps_per_hour);
        return Err(StudyError::key("year.steps_per_hour", message));
    }
    within("hours.from", keys.hours.from, 0.0, 24.0, " h")?;
    within("hours.to", keys.hours.to, 0.0, 24.0, " h")?;
    if keys.hours.from == keys.hours.to {
        let message =
            format!("from {0} h to {0} h is not a period; for all hours give from = 0.0, to = 24.0", keys.hours.from);
        return Err(StudyError::key("year.hours", message));
    }
    if !matches!(keys.ground.len(), 0 | 12) {
        let message = format!("{} reflectances; expected one for each of the 12 months", keys.ground.len());
        return Err(StudyError::key("year.ground", message));
    }
    for reflectance in &keys.ground {
        within("ground", *reflectance, 0.0, 1.0, "")?;
    }
    let plane = file.sensors.plane.map_or(0, |plane| plane.nx.saturating_mul(plane.ny));
    let sensors = plane.saturating_add(file.sensors.points.len());
    let size = DVec3::new(file.room.width, file.room.depth, file.room.height);
    let mut eyes = Vec::with_capacity(keys.eyes.len());
    for (number, eye) in keys.eyes.iter().enumerate() {
        let name = |key: &str| format!("year.eyes[{}].{key}", number + 1);
        let position = DVec3::from_array(eye.point);
        if !(position.is_finite() && position.cmpge(DVec3::ZERO).all() && position.cmple(size).all()) {
            let message = format!("{:?} lies outside the room, 0 to {:?} m", eye.point, size.to_array());
            return Err(StudyError::key(name("point"), message));
        }
        let normal = DVec3::from_array(eye.direction).try_normalize().ok_or_else(|| {
            let message = format!("{:?} has no direction; e.g. [0.0, -1.0, 0.0] looks at the façade", eye.direction);
            StudyError::key(name("direction"), message)
        })?;
        eyes.push(Sensor { position, normal });
    }
    let lamps = keys.lighting.as_ref().map(|lighting| lamps(lighting, sensors)).transpose()?;
    let floor = file.room.width * file.room.depth;
    Ok(Settings { keys: keys.clone(), floor, sensors, eyes, lamps, unoccupied: true, direct_sun: true })
}

/// Checks the keys of the electric lighting, and returns it with its zones. `sensors`: number of the scene's sensors.
fn lamps(keys: &LightingKeys, sensors: usize) -> Result<Lamps, StudyError> {
    let power = within("lighting.power", keys.power, 0.0, 1000.0, " W/m²")?;
    let target = within("lighting.target", keys.target, 1.0, 1e5, " lx")?;
    let standby = within("lighting.standby", keys.standby, 0.0, 1000.0, " W/m²")?;
    within("lighting.steps", f64::from(keys.steps), 1.0, 1000.0, "")?;
    within("lighting.min_light", keys.min_light, 0.0, 0.99, "")?;
    within("lighting.min_power", keys.min_power, 0.0, 1.0, "")?;
    let control = match keys.control {
        LampControlKey::None => Control::None,
        LampControlKey::OnOff => Control::OnOff,
        LampControlKey::Stepped => Control::Stepped(keys.steps),
        LampControlKey::Dimming => {
            Control::Dimming { min_light: keys.min_light, min_power: keys.min_power, off: keys.off }
        }
    };
    let mut zones = Vec::with_capacity(keys.zones.len().max(1));
    for (number, zone) in keys.zones.iter().enumerate() {
        let name = |key: &str| format!("year.lighting.zones[{}].{key}", number + 1);
        if zone.sensors.is_empty() {
            return Err(StudyError::key(name("sensors"), "none; expected indices of sensors, from 0"));
        }
        if let Some(index) = zone.sensors.iter().find(|index| **index >= sensors) {
            let message = format!("there is no sensor {index} (allowed: 0 to {})", sensors.saturating_sub(1));
            return Err(StudyError::key(name("sensors"), message));
        }
        if !(0.0..=1.0).contains(&zone.share) {
            return Err(StudyError::key(name("share"), format!("{} is out of range (allowed: 0 to 1)", zone.share)));
        }
        zones.push(Zone { places: zone.sensors.clone(), share: zone.share });
    }
    let sum: f64 = zones.iter().map(|zone| zone.share).sum();
    if zones.is_empty() {
        zones.push(Zone { places: (0..sensors).collect(), share: 1.0 });
    } else if sum > 1.0 + 1e-9 {
        let message = format!("the shares add up to {sum}; expected at most 1");
        return Err(StudyError::key("year.lighting.zones", message));
    }
    Ok(Lamps { power, target, control, standby, zones })
}
