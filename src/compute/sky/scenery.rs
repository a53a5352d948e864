//! Obstructions of a scene (boxes, a building and the ground) and their surfaces with reflectance, sunlight and
//! shadows.

use super::outside::Outside;
use super::sun::{SUN_HALF_ANGLE, Sun};
use crate::compute::surroundings::shading::shadow;
use crate::compute::surroundings::skyline::Skyline;
use crate::compute::surroundings::solid::{Face, Solid};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Cosine of incidence below which the sun does not light a face. At most a millionth of the sun's normal illuminance
/// is neglected.
const GRAZING: f64 = 1e-6;

/// Photometric property of the faces of a box in front of the façade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finish {
    /// Diffuse reflectance of all faces, 0 … 1.
    Reflectance(f64),
    /// Given luminance of all faces, independent of the light on them. \[cd/m²\]
    Luminance(f64),
}

/// Obstructions of a scene: boxes, room, building and ground, all in the same frame (room's or world's axes).
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Boxes in front of the façade that rise above the ground: overhangs, fins, neighbouring buildings.
    pub boxes: Vec<(Solid, Finish)>,
    /// Box of the room itself.
    pub room: Solid,
    /// Building that contains the room, and the diffuse reflectance of its faces; `None` without a building.
    pub building: Option<(Solid, f64)>,
    /// Height of the ground, z in the frame of the setting. \[m\]
    pub ground: f64,
}

impl Setting {
    /// Returns the obstructions rotated about the vertical through the origin; `turn`: cosine and sine of the angle,
    /// counter-clockwise seen from above.
    pub fn turned(&self, turn: [f64; 2]) -> Self {
        Self {
            boxes: self.boxes.iter().map(|(solid, finish)| (solid.turned(turn), *finish)).collect(),
            room: self.room.turned(turn),
            building: self.building.as_ref().map(|(solid, reflectance)| (solid.turned(turn), *reflectance)),
            ground: self.ground,
        }
    }

    /// Returns the parts of the bodies above the ground: the boxes; last the building, or the box of the room.
    fn bodies(&self) -> Vec<Solid> {
        let above = |solid: &Solid| solid.above(self.ground);
        let mut bodies: Vec<Solid> = self.boxes.iter().map(|(solid, _)| above(solid)).collect();
        // The space below a room above the ground counts as solid: it hides everything behind it from faces.
        bodies.push(self.building.as_ref().map_or(self.room.down_to(self.ground), |(solid, _)| above(solid)));
        bodies
    }

    /// Returns the number of bodies that hide or shade the ground: all, or without a building all but the last.
    fn before_ground(&self) -> usize {
        self.boxes.len() + usize::from(self.building.is_some())
    }

    /// Returns the outlines of the shadows on the ground as (x, y) in the frame of the setting; `sun`: direction
    /// towards the sun in that frame.
    pub(super) fn shadows_on_ground(&self, sun: DVec3) -> Vec<Vec<DVec2>> {
        let face = Surface::ground(self.ground, 0.0, [1.0, 0.0]).face;
        shadows(&face, self.bodies().iter().take(self.before_ground()), sun)
    }
}

/// Face of a body, or the ground, with reflectance, sunlight and shadows.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    /// Geometry of the face.
    pub face: Face,
    /// Diffuse reflectance.
    pub reflectance: f64,
    /// Given luminance of the whole surface, independent of the light on it \[cd/m²\]; `None` for surfaces that
    /// reflect.
    pub stated: Option<f64>,
    /// Luminance by directly reflected sunlight at points from which the whole disc is visible. \[cd/m²\]
    pub sun: f64,
    /// Outlines of the shadows on the surface: convex, counter-clockwise, in the surface's coordinates. \[m\]
    pub shadows: Vec<Vec<DVec2>>,
}

/// Obstructions on the ground with their surfaces, under one sky and sun.
pub(super) struct Scenery<'a> {
    /// Sky and ground without obstructions, with the uniform skyline.
    pub open: &'a Outside,
    /// Skyline by bearing.
    pub skyline: Option<&'a Skyline>,
    /// Boxes; last the building, or the box of the room.
    pub bodies: Vec<Solid>,
    /// Number of bodies that hide or shade the ground: all, or all but the last.
    pub from_ground: usize,
    /// Six surfaces of each body in the order of [`Solid::face`]; last the ground.
    pub surfaces: Vec<Surface>,
}

impl Surface {
    /// Whether the surface reflects light (no given luminance, reflectance above 0).
    pub fn reflects(&self) -> bool {
        self.reflectance > 0.0 && self.stated.is_none()
    }

    /// Creates the surface of the ground at a height \[m\]; last argument: cosine and sine of the rotation of its first
    /// coordinate axis.
    pub fn ground(height: f64, reflectance: f64, [cos, sin]: [f64; 2]) -> Self {
        let (u, v) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
        let face = Face { origin: height * DVec3::Z, normal: DVec3::Z, u, v, limits: [[-1e6, 1e6]; 2] };
        Self { face, reflectance, stated: None, sun: 0.0, shadows: Vec::new() }
    }
}

/// Returns the outlines of the shadows of bodies on a face, in the face's coordinates \[m\]; none if it does not face
/// the sun.
fn shadows<'a>(face: &Face, bodies: impl Iterator<Item = &'a Solid>, sun: DVec3) -> Vec<Vec<DVec2>> {
    if face.normal.dot(sun) <= GRAZING {
        return Vec::new();
    }
    bodies.map(|solid| shadow(solid, face, sun)).filter(|outline| outline.len() >= 3).collect()
}

/// Returns the share of the sun's disc above horizon and skyline, 0 … 1.
pub(super) fn share_above(outside: &Outside, skyline: Option<&Skyline>, sun: &Sun) -> f64 {
    match skyline {
        Some(skyline) => skyline.free_share(sun.direction.vector(), SUN_HALF_ANGLE),
        None => sun.share_above(outside.skyline_altitude()),
    }
}

impl Scenery<'_> {
    /// Returns the index of the ground among the surfaces.
    pub fn ground(&self) -> usize {
        self.surfaces.len() - 1
    }

    /// Returns the height of the ground, z in the world's axes. \[m\]
    pub fn ground_height(&self) -> f64 {
        self.surfaces[self.ground()].face.origin.z
    }

    /// Returns the bodies that may be in front of a surface, with their indices.
    pub fn others(&self, surface: usize) -> impl Iterator<Item = (usize, &Solid)> {
        let (own, count) =
            if surface == self.ground() { (usize::MAX, self.from_ground) } else { (surface / 6, self.bodies.len()) };
        self.bodies[..count].iter().enumerate().filter(move |(index, _)| *index != own)
    }

    /// Whether a point of a surface lies inside another body.
    pub fn is_covered(&self, surface: usize, point: DVec3) -> bool {
        let before = point + 1e-6 * self.surfaces[surface].face.normal;
        self.others(surface).any(|(_, solid)| solid.holds(before))
    }
}

/// Creates bodies and surfaces of obstructions with the sunlight on them. `direct_sun`: direction towards the sun, and
/// its normal illuminance \[lx\]; `turn`: cosine and sine of the rotation of the ground's first coordinate axis.
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
            // The underside of a body that stands on the ground is not visible.
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
