//! Geometry of a scene's room, apertures and sensors in room axes, from their checked keys.

use super::error::StudyError;
use super::scene_file::{ApertureKeys, RoomKeys, SceneFile, SensorKeys, SurfaceKey};
use crate::compute::direction::Surface;
use crate::compute::limits;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::direct::Sensor;
use crate::compute::room::mesh::BoxRoom;
use glam::DVec3;

/// Maximum number of sensors of a scene.
const MOST_SENSORS: usize = limits::SENSORS;

/// Checks that a value lies between two limits, and returns it. `key`: name for the message; `unit`: unit for the
/// message.
pub(super) fn within(key: &str, value: f64, min: f64, max: f64, unit: &str) -> Result<f64, StudyError> {
    if (min..=max).contains(&value) {
        Ok(value)
    } else {
        Err(StudyError::key(key, format!("{value}{unit} is out of range (allowed: {min} to {max}{unit})")))
    }
}

/// Checks the keys of the room, and creates it.
pub(super) fn room(keys: &RoomKeys) -> Result<BoxRoom, StudyError> {
    let length = |key: &str, value| within(key, value, 1e-3, 1e5, " m");
    let share = |key: &str, value| within(key, value, 0.0, 1.0, "");
    Ok(BoxRoom {
        size: DVec3::new(
            length("room.width", keys.width)?,
            length("room.depth", keys.depth)?,
            length("room.height", keys.height)?,
        ),
        floor: share("room.reflectance.floor", keys.reflectance.floor)?,
        walls: share("room.reflectance.walls", keys.reflectance.walls)?,
        ceiling: share("room.reflectance.ceiling", keys.reflectance.ceiling)?,
    })
}

/// Returns position and size of an aperture of the scene, counted from 0; `None` if there are fewer apertures.
///
/// # Errors
/// Returns an error if a key of room or apertures is wrong.
pub fn opening(scene: &SceneFile, aperture: usize) -> Result<Option<Aperture>, StudyError> {
    Ok(apertures(&scene.aperture, &room(&scene.room)?)?.get(aperture).copied())
}

/// Checks the keys of the apertures, and returns their positions and sizes. Each must lie in its surface, without
/// overlapping another.
pub(super) fn apertures(keys: &[ApertureKeys], room: &BoxRoom) -> Result<Vec<Aperture>, StudyError> {
    if keys.is_empty() {
        return Err(StudyError::key("aperture", "the scene needs at least one [[aperture]]"));
    }
    if keys.len() > limits::APERTURES {
        let message = format!("{} apertures (allowed: up to {})", keys.len(), limits::APERTURES);
        return Err(StudyError::key("aperture", message));
    }
    let mut list: Vec<Aperture> = Vec::with_capacity(keys.len());
    for (index, keys) in keys.iter().enumerate() {
        let name = |key: &str| format!("aperture[{}].{key}", index + 1);
        let (surface, wall, limits) = match keys.surface {
            SurfaceKey::Facade => (Surface::Facade, "façade", [room.size.x, room.size.z]),
            SurfaceKey::Roof => (Surface::Roof, "roof", [room.size.x, room.size.y]),
        };
        for ((from, size), limit) in keys.origin.into_iter().zip(keys.size).zip(limits) {
            // Written so that NaN fails too.
            if !(size > 0.0 && size.is_finite()) {
                return Err(StudyError::key(name("size"), format!("{size} m is not a length above 0")));
            }
            if size < limits::OPENING {
                let least = limits::OPENING;
                let message = format!("{size:e} m (allowed: {least} m, a micrometre, and above)");
                return Err(StudyError::key(name("size"), message));
            }
            // Lengths typed as decimals do not add up exactly, and an aperture may fill its wall.
            let slack = 1e-9 * limit;
            if !(from >= -slack && from + size <= limit + slack) {
                return Err(StudyError::key(
                    // The key to be changed: with a valid origin the size is too large.
                    name(if from >= -slack && from <= limit { "size" } else { "origin" }),
                    format!("{from} m to {} m lies beyond the {wall}, 0 to {} m", from + size, limit),
                ));
            }
        }
        let [u, v] = keys.origin;
        let corner = match surface {
            Surface::Facade => DVec3::new(u, 0.0, v),
            Surface::Roof => DVec3::new(u, v, room.size.z),
        };
        let overlapping = list.iter().zip(1..).find(|(other, _)| {
            let offset = surface.facade_from_room(corner - other.corner);
            other.surface == surface
                && (0..2).all(|axis| {
                    // Apertures may touch, as panes in a frame do.
                    let slack = 1e-9 * limits[axis];
                    offset[axis] + keys.size[axis] > slack && offset[axis] < other.size[axis] - slack
                })
        });
        if let Some((_, number)) = overlapping {
            return Err(StudyError::key(
                name("origin"),
                format!("overlaps aperture {number}; apertures must lie apart"),
            ));
        }
        list.push(Aperture { surface, corner, size: keys.size });
    }
    Ok(list)
}

/// Returns the transmission factor of an aperture's frame and dirt together, 0 … 1. `index`: index of the aperture,
/// from 0.
pub(super) fn clear(keys: &ApertureKeys, index: usize) -> Result<f64, StudyError> {
    let name = |key: &str| format!("aperture[{}].{key}", index + 1);
    let frame = within(&name("frame"), keys.frame, 0.0, 0.95, "")?;
    Ok((1.0 - frame) * within(&name("dirt"), keys.dirt, 0.0, 1.0, "")?)
}

/// Returns the sensor points, and their numbers along x and y if they are a plane.
pub(super) fn sensors(keys: &SensorKeys, room: &BoxRoom) -> Result<(Vec<Sensor>, Option<[usize; 2]>), StudyError> {
    let mut list = Vec::new();
    let mut grid = None;
    let unit = |key: &str, normal: [f64; 3]| {
        DVec3::from_array(normal)
            .try_normalize()
            .ok_or_else(|| StudyError::key(key, format!("{normal:?} has no direction; e.g. [0.0, 0.0, 1.0] faces up")))
    };
    if let Some(plane) = &keys.plane {
        within("sensors.plane.z", plane.z, 0.0, room.size.z, " m")?;
        let normal = unit("sensors.plane.normal", plane.normal)?;
        for (key, n) in [("sensors.plane.nx", plane.nx), ("sensors.plane.ny", plane.ny)] {
            // Checked before the list is made: a typing error must not fill the memory.
            if n == 0 || n > MOST_SENSORS {
                return Err(StudyError::key(key, format!("{n} cells (allowed: 1 to {MOST_SENSORS})")));
            }
        }
        if plane.nx.saturating_mul(plane.ny) > MOST_SENSORS {
            return Err(StudyError::key("sensors.plane", format!("more than {MOST_SENSORS} sensors")));
        }
        for j in 0..plane.ny {
            for i in 0..plane.nx {
                // At the centres of equal cells, so that the mean of the sensors is that of the plane.
                let position = DVec3::new(
                    (i as f64 + 0.5) * room.size.x / plane.nx as f64,
                    (j as f64 + 0.5) * room.size.y / plane.ny as f64,
                    plane.z,
                );
                list.push(Sensor { position, normal });
            }
        }
        // With additional points the results are not a grid that could be drawn as a plan.
        if keys.points.is_empty() {
            grid = Some([plane.nx, plane.ny]);
        }
    }
    if list.len().saturating_add(keys.points.len()) > MOST_SENSORS {
        return Err(StudyError::key("sensors.points", format!("more than {MOST_SENSORS} sensors")));
    }
    if !keys.points.is_empty() {
        // Points have no plane that defines their normal: upwards, as for a desk, is assumed.
        let normal = unit("sensors.normal", keys.normal.unwrap_or([0.0, 0.0, 1.0]))?;
        for (number, point) in keys.points.iter().enumerate() {
            let position = DVec3::from_array(*point);
            if !(position.is_finite() && position.cmpge(DVec3::ZERO).all() && position.cmple(room.size).all()) {
                return Err(StudyError::key(
                    format!("sensors.points[{}]", number + 1),
                    format!("{point:?} lies outside the room, 0 to {:?} m", room.size.to_array()),
                ));
            }
            list.push(Sensor { position, normal });
        }
    }
    if list.is_empty() {
        return Err(StudyError::key("sensors", "needs a plane or points"));
    }
    Ok((list, grid))
}
