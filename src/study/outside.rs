//! From `[[outside]]` to what stands before sky and ground.

use super::error::StudyError;
use super::scene_file::{OutsideKeys, USUAL_REFLECTANCE};
use crate::compute::direction::Orientation;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::limits;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::mesh::BoxRoom;
use crate::compute::sky::faces::{Finish, surroundings};
use crate::compute::sky::{Outside, Sun};
use crate::compute::surroundings::solid::Solid;
use glam::DVec3;
use std::sync::Arc;

/// Most boxes that one scene may have: every ray asks all of them.
pub const MOST_BOXES: usize = limits::BOXES;
/// Longest way of a box from the room's origin. \[m\]
const FARTHEST: f64 = 1e6;
/// Shortest side of a box: what is thinner is typed by mistake, and rays could pass it unseen. \[m\]
const THINNEST: f64 = 1e-6;

/// Judges the boxes; in room axes.
pub fn boxes(keys: &[OutsideKeys], room: &BoxRoom) -> Result<Vec<(Solid, Finish)>, StudyError> {
    if keys.len() > MOST_BOXES {
        return Err(StudyError::key("outside", format!("{} boxes (allowed: up to {MOST_BOXES})", keys.len())));
    }
    keys.iter().enumerate().map(|(index, keys)| one_box(index, keys, room)).collect()
}

fn one_box(index: usize, keys: &OutsideKeys, room: &BoxRoom) -> Result<(Solid, Finish), StudyError> {
    let wrong = |key: &str, message: String| Err(StudyError::key(format!("outside[{}].{key}", index + 1), message));
    for (axis, (from, to)) in ["x", "y", "z"].into_iter().zip(keys.solid.from.into_iter().zip(keys.solid.to)) {
        if !(from.abs() <= FARTHEST && to.abs() <= FARTHEST) {
            return wrong("box", format!("{axis} from {from} m to {to} m (allowed: within ±{FARTHEST} m)"));
        }
        if from >= to {
            return wrong("box", format!("{axis} from {from} m to {to} m: \"to\" has to be greater than \"from\""));
        }
        if to - from < THINNEST {
            let message =
                format!("{axis} from {from} m to {to} m is too thin (allowed: sides of {THINNEST} m and more)");
            return wrong("box", message);
        }
    }
    let turn = keys.solid.turn;
    if !(-360.0..=360.0).contains(&turn) {
        return wrong("box.turn", format!("{turn}° is out of range (allowed: -360 to 360°)"));
    }
    let finish = match (keys.reflectance, keys.luminance) {
        (Some(_), Some(_)) => {
            return wrong("luminance", "given together with reflectance: give one of them".to_owned());
        }
        (None, Some(luminance)) if !(0.0..=limits::LUMINANCE).contains(&luminance) => {
            let most = limits::LUMINANCE;
            return wrong("luminance", format!("{luminance:e} cd/m² is out of range (allowed: 0 to {most:e})"));
        }
        (None, Some(luminance)) => Finish::Luminance(luminance),
        (reflectance, None) => {
            let rho = reflectance.unwrap_or(USUAL_REFLECTANCE);
            if !(0.0..=1.0).contains(&rho) {
                return wrong("reflectance", format!("{rho} is out of range (allowed: 0 to 1)"));
            }
            Finish::Reflectance(rho)
        }
    };
    let solid = Solid::new(DVec3::from_array(keys.solid.from), DVec3::from_array(keys.solid.to), turn.to_radians());
    // Lengths typed as decimals do not add up exactly, and a box may stand on the wall.
    if solid.overlaps(&own_box(room), 1e-9 * room.size.max_element()) {
        let [width, depth, height] = room.size.to_array();
        let message = format!(
            "reaches into the room, 0 to {width} m in x, 0 to {depth} m in y, 0 to {height} m in z; it has to stand \
             wholly outside and may touch it"
        );
        return wrong("box", message);
    }
    Ok((solid, finish))
}

fn own_box(room: &BoxRoom) -> Solid {
    Solid::new(DVec3::ZERO, room.size, 0.0)
}

/// The outside behind boxes, lit; its skyline stays. Without boxes as it was. `viewpoints`: corners of the apertures, or
/// what else it is seen from, in room axes.
///
/// # Errors
/// [`Cancelled`] when `progress` says so.
pub fn behind_boxes(
    outside: Outside,
    sun: Option<&Sun>,
    boxes: &[(Solid, Finish)],
    room: &BoxRoom,
    orientation: Orientation,
    viewpoints: &[DVec3],
    progress: &dyn Progress,
) -> Result<Outside, Cancelled> {
    if boxes.is_empty() {
        return Ok(outside);
    }
    let turned: Vec<(Solid, Finish)> =
        boxes.iter().map(|(solid, finish)| (solid.turned(orientation.turn()), *finish)).collect();
    let viewpoints: Vec<DVec3> = viewpoints.iter().map(|p| orientation.to_world(*p)).collect();
    let skyline = outside.surroundings().and_then(|known| known.skyline.clone());
    let open = outside.open();
    let room = own_box(room).turned(orientation.turn());
    let around = surroundings(&open, sun, &turned, room, skyline, &viewpoints, progress)?;
    Ok(open.behind(Arc::new(around)))
}
/// The boxes of a scene, for many skies.
pub struct Before {
    boxes: Vec<(Solid, Finish)>,
    corners: Vec<DVec3>,
}

impl Before {
    /// Before some apertures.
    ///
    /// # Errors
    /// Boxes that cannot be.
    pub fn of(keys: &[OutsideKeys], room: &BoxRoom, apertures: &[Aperture]) -> Result<Self, StudyError> {
        Ok(Self { boxes: boxes(keys, room)?, corners: apertures.iter().flat_map(Aperture::corners).collect() })
    }

    /// Are there none?
    pub fn is_empty(&self) -> bool {
        self.boxes.is_empty()
    }

    /// A sky behind them.
    ///
    /// # Errors
    /// Cancelled.
    pub fn stand(
        &self,
        outside: Outside,
        sun: Option<&Sun>,
        room: &BoxRoom,
        orientation: Orientation,
        progress: &dyn Progress,
    ) -> Result<Outside, Cancelled> {
        behind_boxes(outside, sun, &self.boxes, room, orientation, &self.corners, progress)
    }
}
