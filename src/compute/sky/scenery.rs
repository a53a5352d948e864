//! Obstructions: boxes, a building and the ground, with the surfaces that they have.

use super::outside::Outside;
use super::sun::{SUN_HALF_ANGLE, Sun};
use crate::compute::surroundings::shading::shadow;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::{Face, Solid};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Cosine of incidence below which the sun does not light a face. It leaves out a millionth of the sun's normal
/// illuminance at most.
const GRAZING: f64 = 1e-6;

/// Surface property of a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finish {
    /// Diffuse reflectance, 0 … 1.
    Reflectance(f64),
    /// Luminance of all faces, whatever light falls on them. \[cd/m²\]
    Luminance(f64),
}

/// Obstructions of a scene in one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Overhangs, fins and neighbours: boxes that rise above the ground.
    pub boxes: Vec<(Solid, Finish)>,
    /// The room's own box.
    pub room: Solid,
    /// The building that holds the room, and its reflectance.
    pub building: Option<(Solid, f64)>,
    /// Height of the ground. \[m\]
    pub ground: f64,
}

impl Setting {
    /// Returns the setting rotated about the vertical through the origin; `turn`: cosine and sine of the angle.
    pub fn turned(&self, turn: [f64; 2]) -> Self {
        Self {
            boxes: self.boxes.iter().map(|(solid, finish)| (solid.turned(turn), *finish)).collect(),
            room: self.room.turned(turn),
            building: self.building.as_ref().map(|(solid, reflectance)| (solid.turned(turn), *reflectance)),
            ground: self.ground,
        }
    }

    /// Returns the bodies as far as they rise above the ground: the boxes; last the building, or the room's own box.
    fn bodies(&self) -> Vec<Solid> {
        let above = |solid: &Solid| solid.above(self.ground);
        let mut bodies: Vec<Solid> = self.boxes.iter().map(|(solid, _)| above(solid)).collect();
        // The base below a room above the ground hides from faces whatever lies behind it.
        bodies.push(self.building.as_ref().map_or(self.room.down_to(self.ground), |(solid, _)| above(solid)));
        bodies
    }

    /// Returns the number of bodies in front of the ground: all, or without a building all but the last.
    fn before_ground(&self) -> usize {
        self.boxes.len() + usize::from(self.building.is_some())
    }

    /// Returns the shadows on the ground as (x, y) in the setting's own frame; `sun`: towards the sun in that frame.
    pub(super) fn shadows_on_ground(&self, sun: DVec3) -> Vec<Vec<DVec2>> {
        let face = Surface::ground(self.ground, 0.0, [1.0, 0.0]).face;
        shadows(&face, self.bodies().iter().take(self.before_ground()), sun)
    }
}

/// Surface of a body, or the ground.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    /// Geometry of the face.
    pub face: Face,
    /// Diffuse reflectance.
    pub reflectance: f64,
    /// Luminance of the whole surface where it is given, independent of incident light. \[cd/m²\]
    pub stated: Option<f64>,
    /// Luminance that the whole disc of the sun adds where nothing hides it. \[cd/m²\]
    pub sun: f64,
    /// Shadows on the surface: convex, counter-clockwise, in its own coordinates.
    pub shadows: Vec<Vec<DVec2>>,
}

/// Bodies on the ground, with their surfaces.
pub(super) struct Scenery<'a> {
    /// Sky and flat skyline.
    pub open: &'a Outside,
    /// A skyline by bearing.
    pub skyline: Option<&'a Skyline>,
    /// The boxes; last the building, or the room's own box.
    pub bodies: Vec<Solid>,
    /// Number of bodies in front of the ground: all, or all but the last.
    pub from_ground: usize,
    /// Six surfaces of each body, as [`Solid::face`] counts them; last the ground.
    pub surfaces: Vec<Surface>,
}

impl Surface {
    /// Whether the surface reflects light.
    pub fn reflects(&self) -> bool {
        self.reflectance > 0.0 && self.stated.is_none()
    }

    /// Returns ground at a height \[m\]; cosine and sine of the rotation of its first axis.
    pub fn ground(height: f64, reflectance: f64, [cos, sin]: [f64; 2]) -> Self {
        let (u, v) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
        let face = Face { origin: height * DVec3::Z, normal: DVec3::Z, u, v, limits: [[-1e6, 1e6]; 2] };
        Self { face, reflectance, stated: None, sun: 0.0, shadows: Vec::new() }
    }
}

/// Returns the shadows of bodies on a face, in the face's coordinates; none where it does not face the sun.
fn shadows<'a>(face: &Face, bodies: impl Iterator<Item = &'a Solid>, sun: DVec3) -> Vec<Vec<DVec2>> {
    if face.normal.dot(sun) <= GRAZING {
        return Vec::new();
    }
    bodies.map(|solid| shadow(solid, face, sun)).filter(|outline| outline.len() >= 3).collect()
}

/// Returns the share of the sun's disc above horizon and skyline.
pub(super) fn share_above(outside: &Outside, skyline: Option<&Skyline>, sun: &Sun) -> f64 {
    match skyline {
        Some(skyline) => skyline.free_share(sun.direction.vector(), SUN_HALF_ANGLE),
        None => sun.share_above(outside.skyline_altitude()),
    }
}

impl Scenery<'_> {
    /// Returns the ground's index among the surfaces.
    pub fn ground(&self) -> usize {
        self.surfaces.len() - 1
    }

    /// Returns the height of the ground. \[m\]
    pub fn ground_height(&self) -> f64 {
        self.surfaces[self.ground()].face.origin.z
    }

    /// Returns the bodies in front of a surface, with their indices.
    pub fn others(&self, surface: usize) -> impl Iterator<Item = (usize, &Solid)> {
        let (own, count) =
            if surface == self.ground() { (usize::MAX, self.from_ground) } else { (surface / 6, self.bodies.len()) };
        self.bodies[..count].iter().enumerate().filter(move |(index, _)| *index != own)
    }

    /// Whether a point of a surface lies in another body.
    pub fn is_covered(&self, surface: usize, point: DVec3) -> bool {
        let before = point + 1e-6 * self.surfaces[surface].face.normal;
        self.others(surface).any(|(_, solid)| solid.holds(before))
    }
}

/// Returns bodies and surfaces of a setting. `direct_sun`: direction to the sun and its normal illuminance. \[lx\]
pub(super) fn scenery<'a>(
    outside: &'a Outside,
    skyline: Option<&'a Skyline>,
    direct_sun: Option<(DVec3, f64)>,
    setting: &Setting,
    turn: [f64; 2],
) -> Scenery<'a> {
    let height = setting.ground;
    let bodies = setting.bodies();
    let finishes = setting.boxes.iter().map(|(_, finish)| *finish);
    let last = setting.building.as_ref().map_or(0.0, |(_, reflectance)| *reflectance);
    let mut surfaces = Vec::with_capacity(6 * bodies.len() + 1);
    for (solid, finish) in bodies.iter().zip(finishes.chain([Finish::Reflectance(last)])) {
        for number in 0..6 {
            // The underside of a body on the ground is hidden.
            let hidden = number == 4 && solid.heights()[0] <= height + 1e-9;
            let (reflectance, stated) = match finish {
                Finish::Reflectance(rho) => (if hidden { 0.0 } else { rho }, None),
                Finish::Luminance(luminance) => (0.0, Some(luminance)),
            };
            surfaces.push(Surface { face: solid.face(number), reflectance, stated, sun: 0.0, shadows: Vec::new() });
        }
    }
    surfaces.push(Surface::ground(height, outside.ground_reflectance(), turn));
    let from_ground = setting.before_ground();
    let mut scenery = Scenery { open: outside, skyline, bodies, from_ground, surfaces };
    if let Some((sun, normal)) = direct_sun {
        for index in 0..scenery.surfaces.len() {
            let Surface { face, reflectance, stated, .. } = &scenery.surfaces[index];
            let towards = face.normal.dot(sun);
            if stated.is_some() || *reflectance <= 0.0 || towards <= GRAZING {
                continue;
            }
            let light = reflectance * normal * towards / PI;
            let shadows = shadows(face, scenery.others(index).map(|(_, solid)| solid), sun);
            (scenery.surfaces[index].sun, scenery.surfaces[index].shadows) = (light, shadows);
        }
    }
    scenery
}
