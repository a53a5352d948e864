//! What stands before a façade or above a roof: upright boxes, and a skyline that rises and falls with the bearing.
//!
//! | file | what |
//! | --- | --- |
//! | `solid` | a box: where a ray enters it, its edges, faces and outline as seen from a point |
//! | `skyline` | altitude by bearing |
//! | `face_light` | the luminance of a face |
//! | `shading` | what of a rectangle the sun reaches past boxes |
//!
//! Everything is in the world's frame (x east, y north, z up) about the room's own origin, in metres: boxes near enough
//! to be seen differently from different points have a place, a skyline has only directions.
//!
//! Light on a face comes from sky, sun and ground as far as no other box and not the room hides them; of that the face
//! sends ρE/π evenly in all directions. Boxes do not light each other or the ground: one reflection. See
//! [`crate::compute::sky::faces`].

pub mod face_light;
pub mod shading;
pub mod skyline;
pub mod solid;

use face_light::FaceLight;
use glam::DVec3;
use skyline::Skyline;
use solid::{Face, Solid};

/// What a direction meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    /// The uniform luminance of what stands below the skyline.
    Skyline,
    /// A face of a box.
    Face {
        /// Index of the box.
        solid: usize,
        /// Number of the face, see [`Solid::face`].
        face: usize,
        /// Does the middle of the sun's disc light it there?
        sunlit: bool,
    },
}

/// Boxes with the light on them, and a skyline.
#[derive(Debug, Clone, PartialEq)]
pub struct Surroundings {
    /// The boxes.
    pub solids: Vec<Solid>,
    /// The room's own box: black, and it throws a shadow.
    pub room: Solid,
    /// Light of every face of every box.
    pub faces: Vec<[FaceLight; 6]>,
    /// Towards the sun that lights faces; `None` where it lights none.
    pub sun: Option<DVec3>,
    /// Lines on faces at which the luminance may jump, beside the boxes' own edges: of shadows, and where faces meet.
    pub lines: Vec<Line>,
    /// Altitude of what is far away, by bearing.
    pub skyline: Option<Skyline>,
}

/// A line on one face or on two at which the luminance may jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Its ends.
    pub ends: [DVec3; 2],
    /// The faces that it lies on; twice the same where it is one.
    pub faces: [Face; 2],
}

/// The nearest of some boxes that a ray enters: its index, the distance and the face.
pub fn first_hit<'a>(
    solids: impl Iterator<Item = (usize, &'a Solid)>,
    from: DVec3,
    direction: DVec3,
) -> Option<(usize, f64, usize)> {
    let mut nearest: Option<(usize, f64, usize)> = None;
    for (index, solid) in solids {
        if let Some((distance, face)) = solid.enter(from, direction)
            && nearest.is_none_or(|(_, other, _)| distance < other)
        {
            nearest = Some((index, distance, face));
        }
    }
    nearest
}

impl Surroundings {
    /// What is met in a direction; `None`: sky or ground. Without a point to see from, boxes do not count.
    pub fn seen(&self, eye: Option<DVec3>, direction: DVec3) -> Option<Seen> {
        self.seen_among(0..self.solids.len(), eye, direction)
    }

    /// The same where no other boxes than these can be met.
    pub fn seen_among(&self, boxes: impl Iterator<Item = usize>, eye: Option<DVec3>, direction: DVec3) -> Option<Seen> {
        if let Some(eye) = eye
            && let Some((solid, distance, face)) =
                first_hit(boxes.map(|index| (index, &self.solids[index])), eye, direction)
        {
            return Some(Seen::Face { solid, face, sunlit: self.sunlit(solid, face, eye + distance * direction) });
        }
        self.skyline.as_ref().filter(|skyline| skyline.covers(direction)).map(|_| Seen::Skyline)
    }

    /// Luminance of what is met. \[cd/m²\]
    pub fn luminance(&self, seen: Seen, eye: Option<DVec3>, direction: DVec3) -> f64 {
        match (seen, eye) {
            (Seen::Skyline, _) => self.skyline.as_ref().map_or(0.0, |skyline| skyline.luminance),
            (Seen::Face { solid, face, sunlit }, Some(eye)) => {
                let light = &self.faces[solid][face];
                let own = &self.solids[solid].face(face);
                let distance = own.normal.dot(own.origin - eye) / own.normal.dot(direction);
                let [u, v] = own.coordinates(eye + distance * direction);
                light.diffuse(u, v) + if sunlit { light.sun } else { 0.0 }
            }
            (Seen::Face { .. }, None) => 0.0,
        }
    }

    /// How far the luminance of what is met may be off, relative.
    pub fn doubt(&self, seen: Seen) -> f64 {
        match seen {
            Seen::Skyline => 0.0,
            Seen::Face { solid, face, .. } => self.faces[solid][face].error,
        }
    }

    /// Does the middle of the sun's disc light a point of a face?
    pub fn sunlit(&self, solid: usize, face: usize, point: DVec3) -> bool {
        let Some(sun) = self.sun.filter(|_| self.faces[solid][face].sun > 0.0) else { return false };
        let others = self.solids.iter().enumerate().filter(|(other, _)| *other != solid);
        let room = std::iter::once((usize::MAX, &self.room));
        first_hit(others.chain(room), point, sun).is_none()
    }

    /// Segments at which the luminance may jump, as vectors from a point.
    pub fn edges_from(&self, eye: DVec3) -> Vec<[DVec3; 2]> {
        let edges = self.solids.iter().flat_map(|solid| solid.visible_edges(eye));
        let turned = |face: &Face| face.normal.dot(eye - face.origin) > 0.0;
        let lines = self.lines.iter().filter(|line| line.faces.iter().any(turned)).map(|line| line.ends);
        edges.chain(lines).map(|edge| edge.map(|p| p - eye)).collect()
    }

    /// The same with all light times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        scaled.faces.iter_mut().flatten().for_each(|light| light.scale(factor));
        if let Some(skyline) = &mut scaled.skyline {
            skyline.luminance *= factor;
        }
        scaled
    }

    /// Does any face or the skyline shine?
    pub fn is_lit(&self) -> bool {
        self.faces.iter().flatten().any(FaceLight::is_lit)
            || self.skyline.as_ref().is_some_and(|skyline| skyline.luminance > 0.0)
    }
}
