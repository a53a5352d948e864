//! Obstructions outside a scene's room, from the keys `[[outside]]`, `[building]` and `site.ground_height`.

use super::error::StudyError;
use super::scene_file::{BuildingKeys, ORDINARY_TARGET, OutsideKeys, SceneFile, USUAL_REFLECTANCE};
use crate::compute::direction::{Orientation, Surface};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::limits;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::mesh::BoxRoom;
use crate::compute::sky::faces::{Viewing, surroundings};
use crate::compute::sky::{Finish, GroundShade, Outside, Setting, Sun};
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::solid::Solid;
use crate::texts::words as texts;
use glam::DVec3;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Maximum number of boxes of a scene, since every ray is tested against all of them.
pub const MOST_BOXES: usize = limits::BOXES;
/// Maximum distance of a box from the room's origin. \[m\]
const FARTHEST: f64 = 1e6;
/// Minimum side of a box; a thinner one is a typing error, and rays could miss it. \[m\]
const THINNEST: f64 = 1e-6;
/// Height above the ground below which a box is left out. \[m\]
const LOWEST: f64 = 1e-6;
/// Ratio of a box's height to its distance from all apertures below which it may be left out, because it hides the sun
/// only for minutes at the horizon.
const LOW: f64 = 0.01;
/// Solid angle up to which such low boxes are left out together: a ten-thousandth of what a façade sees. \[sr\]
const UNSEEN: f64 = 3e-4;
/// Maximum number of stored lit obstructions: those of a scene, coarse and fine, and those before its last change.
const MOST_LIT: usize = 3;
/// Tolerance of lengths that should be equal, since typed decimals are not exactly. \[m\]
const TOUCHING: f64 = 1e-6;

/// Checks the boxes of a scene, and returns them in room axes, each with its reflectance or luminance.
pub fn boxes(file: &SceneFile, room: &BoxRoom) -> Result<Vec<(Solid, Finish)>, StudyError> {
    let keys = &file.outside;
    if keys.len() > MOST_BOXES {
        return Err(StudyError::key("outside", format!("{} boxes (allowed: up to {MOST_BOXES})", keys.len())));
    }
    let rises = |(solid, _): &(Solid, Finish)| solid.heights()[1] > file.site.ground_height + LOWEST;
    let all = keys.iter().enumerate().map(|(index, keys)| one_box(index, keys, room));
    // A box below the ground does not exist.
    all.filter(|one| one.as_ref().map_or(true, rises)).collect()
}

/// Checks the height of the ground, and returns it. \[m\]
fn ground_height(file: &SceneFile, apertures: &[Aperture]) -> Result<f64, StudyError> {
    let height = file.site.ground_height;
    let wrong = |message: String| Err(StudyError::key("site.ground_height", message));
    if height.is_nan() || height.abs() > FARTHEST {
        return wrong(format!("{height} m (allowed: within ±{FARTHEST} m)"));
    }
    let lowest = apertures.iter().flat_map(Aperture::corners).map(|corner| corner.z).fold(f64::INFINITY, f64::min);
    if height > lowest + TOUCHING {
        return wrong(format!("{height} m lies above the lowest edge of an aperture, at {lowest} m"));
    }
    Ok(height)
}

/// Checks the building, and returns its box in room axes with its reflectance. `ground`: height of the ground. \[m\]
fn building(
    keys: &BuildingKeys,
    room: &BoxRoom,
    apertures: &[Aperture],
    ground: f64,
) -> Result<(Solid, f64), StudyError> {
    let wrong = |key: &str, message: String| Err(StudyError::key(format!("building.{key}"), message));
    let size = room.size.to_array();
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let [from, to] = [keys.from[axis], keys.to[axis]];
        if !(from.abs() <= FARTHEST && to.abs() <= FARTHEST) {
            return wrong("from", format!("{name} from {from} m to {to} m (allowed: within ±{FARTHEST} m)"));
        }
        let message = |wanted: String| format!("{wanted}: the building has to hold the room's own box");
        if from > TOUCHING {
            return wrong("from", message(format!("{name} {from} m (allowed: 0 m and less)")));
        }
        if to < size[axis] - TOUCHING {
            return wrong("to", message(format!("{name} {to} m (allowed: {} m and more)", size[axis])));
        }
    }
    for aperture in apertures {
        match aperture.surface {
            Surface::Facade if keys.from[1] < -TOUCHING => {
                let message = format!("y {} m: the façade with its apertures lies at y = 0 m", keys.from[1]);
                return wrong("from", message);
            }
            Surface::Roof if keys.to[2] > size[2] + TOUCHING => {
                let message = format!("z {} m: the roof with its apertures lies at z = {} m", keys.to[2], size[2]);
                return wrong("to", message);
            }
            Surface::Facade | Surface::Roof => {}
        }
    }
    if keys.to[2] <= ground + LOWEST {
        return wrong("to", format!("z {} m does not rise above the ground, at {ground} m", keys.to[2]));
    }
    if !(0.0..=1.0).contains(&keys.reflectance) {
        return wrong("reflectance", format!("{} is out of range (allowed: 0 to 1)", keys.reflectance));
    }
    Ok((Solid::new(DVec3::from_array(keys.from), DVec3::from_array(keys.to), 0.0), keys.reflectance))
}

/// Checks one box, and returns it in room axes with its reflectance or luminance.
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

/// Removes boxes that are too low and too far away to matter, whatever light falls on them. `ground`: height of the
/// ground. \[m\]
fn leave_out_far(boxes: &mut Vec<(Solid, Finish)>, apertures: &[Aperture], ground: f64) {
    let far = |(solid, finish): &(Solid, Finish)| {
        let distance = apertures.iter().map(|one| solid.gap_to(&one.corners())).fold(f64::INFINITY, f64::min);
        let [width, height] = [2.0 * solid.outline_radius(), solid.heights()[1] - ground];
        let reflects = matches!(finish, Finish::Reflectance(_));
        (reflects && height <= LOW * distance).then(|| width * height / (distance * distance))
    };
    let mut left_out = 0.0;
    boxes.retain(|one| {
        let Some(angle) = far(one).filter(|angle| left_out + angle <= UNSEEN) else { return true };
        left_out += angle;
        false
    });
}

/// Input from which the light on obstructions is computed, everything in the world frame.
#[derive(PartialEq)]
struct Asked {
    /// Sky, ground and skyline.
    outside: Outside,
    sun: Option<Sun>,
    setting: Setting,
    /// Cosine and sine of the angle between the room's x axis and east.
    turn: [f64; 2],
    viewpoints: Vec<DVec3>,
    /// Relative error target of the light on the obstructions.
    target: f64,
}

impl Asked {
    fn lit(&self, progress: &dyn Progress) -> Result<Outside, Cancelled> {
        let skyline = self.outside.surroundings().and_then(|known| known.skyline.clone());
        let open = self.outside.open();
        let viewing = Viewing { viewpoints: &self.viewpoints, target: self.target };
        let around = surroundings(&open, self.sun.as_ref(), &self.setting, self.turn, skyline, &viewing, progress)?;
        Ok(open.behind(Arc::new(around)))
    }
}

/// Store of the obstructions for which light was computed last, for another product or another result of the same
/// scene.
#[derive(Default)]
pub struct LitObstructions(Mutex<VecDeque<(Asked, Outside)>>);

impl LitObstructions {
    /// Returns the obstructions with the light on them; simultaneous requests compute it only once.
    fn get(&self, asked: Asked, progress: &dyn Progress) -> Result<Outside, Cancelled> {
        if rayon::current_thread_index().is_some() {
            // A thread of a parallel computation that waited here could wait for itself.
            return asked.lit(progress);
        }
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = kept.iter().position(|(known, _)| *known == asked).and_then(|at| kept.remove(at));
        let lit = match known {
            Some((_, lit)) => lit,
            None => asked.lit(progress)?,
        };
        kept.truncate(MOST_LIT - 1);
        kept.push_front((asked, lit.clone()));
        Ok(lit)
    }
}

/// Obstructions in front of a scene's apertures, independent of the sky.
pub struct Before {
    /// Boxes and building in room axes, on the ground.
    setting: Setting,
    /// Points from which the obstructions are seen, in room axes; by default the corners of the apertures. \[m\]
    viewpoints: Vec<DVec3>,
    /// Relative error target of the light on the obstructions.
    target: f64,
    /// Notes for the user on assumptions, and on boxes that were left out.
    pub notes: Vec<String>,
}

impl Before {
    /// Creates the obstructions from the keys of a scene.
    ///
    /// # Errors
    /// Returns an error if boxes, building or height of the ground are not valid.
    pub fn of(file: &SceneFile, room: &BoxRoom, apertures: &[Aperture]) -> Result<Self, StudyError> {
        let mut boxes = boxes(file, room)?;
        let ground = ground_height(file, apertures)?;
        let rising = boxes.len();
        leave_out_far(&mut boxes, apertures, ground);
        let mut notes = Vec::new();
        if rising < file.outside.len() {
            notes.push(texts::boxes_below_ground(file.outside.len() - rising, ground));
        }
        if boxes.len() < rising {
            notes.push(texts::boxes_left_out(rising - boxes.len()));
        }
        if !boxes.is_empty() && file.building.is_none() {
            notes.push(texts::BUILDING_UNNAMED.into());
        }
        let building = file.building.as_ref().map(|keys| building(keys, room, apertures, ground)).transpose()?;
        Ok(Self {
            setting: Setting { boxes, room: own_box(room), building, ground },
            viewpoints: apertures.iter().flat_map(Aperture::corners).collect(),
            target: file.compute.error_target.unwrap_or(ORDINARY_TARGET),
            notes,
        })
    }

    /// Returns the obstructions as seen from one point. `eye`: the point in room axes. \[m\]
    pub fn seen_from(self, eye: DVec3) -> Self {
        Self { viewpoints: vec![eye], ..self }
    }

    /// Whether the scene has no obstructions.
    pub fn is_empty(&self) -> bool {
        self.setting.boxes.is_empty() && self.setting.building.is_none()
    }

    /// Returns the ground with the shadows of the obstructions on it, in room axes; `None` without obstructions above
    /// ground that lies at the level of the room's floor. `outside`: sky with its skyline.
    pub fn ground_shade(&self, outside: &Outside, sun: Option<&Sun>, orientation: Orientation) -> Option<GroundShade> {
        let any = !self.is_empty() || self.setting.ground != 0.0;
        any.then(|| GroundShade::new(&self.setting, outside, sun, orientation))
    }

    /// Computes the light on the obstructions, and returns the outside with them in front of the sky and its skyline;
    /// without obstructions the sky is returned unchanged. `kept`: store that is searched for the result first.
    ///
    /// # Errors
    /// Returns an error if cancelled.
    pub fn stand(
        &self,
        outside: Outside,
        sun: Option<&Sun>,
        orientation: Orientation,
        kept: Option<&LitObstructions>,
        progress: &dyn Progress,
    ) -> Result<Outside, Cancelled> {
        let Some((setting, viewpoints)) = self.turned(orientation) else { return Ok(outside) };
        let (sun, turn) = (sun.copied(), orientation.turn());
        let asked = Asked { outside, sun, setting, turn, viewpoints, target: self.target };
        match kept {
            Some(kept) => kept.get(asked, progress),
            None => asked.lit(progress),
        }
    }

    /// Returns the obstructions and the points from which they are seen in the world frame; `None` without
    /// obstructions.
    pub fn turned(&self, orientation: Orientation) -> Option<(Setting, Vec<DVec3>)> {
        if self.is_empty() {
            return None;
        }
        let setting = self.setting.turned(orientation.turn());
        Some((setting, self.viewpoints.iter().map(|p| orientation.to_world(*p)).collect()))
    }

    /// Returns the obstructions without light on them, with the skyline of `outside`; `None` without obstructions.
    pub fn dark(&self, outside: &Outside, orientation: Orientation) -> Option<Arc<Surroundings>> {
        let (setting, _) = self.turned(orientation)?;
        let skyline = outside.surroundings().and_then(|known| known.skyline.clone());
        let solids = setting.boxes.into_iter().map(|(solid, _)| solid).collect();
        Some(Arc::new(Surroundings::dark(solids, skyline)))
    }
}
