//! Obstructions in front of a façade or above a roof: boxes with vertical sides, and a skyline that changes with the
//! bearing.
//!
//! | file | contents |
//! | --- | --- |
//! | `solid` | a box: its intersection with a ray, its edges, faces and outline as seen from a point |
//! | `skyline` | altitude by bearing |
//! | `face_light` | the luminance of a face |
//! | `shading` | sunlit part of a rectangle past boxes |
//!
//! Everything is in the world's frame (x east, y north, z up) about the room's own origin, in metres: boxes near enough
//! to be seen differently from different points have a place, a skyline has only directions.
//!
//! Light on faces and on the ground comes from all that they see: sky, sun and each other. They reflect ρE/π alike in
//! all directions. See [`crate::compute::sky::faces`].

pub mod face_light;
pub mod shading;
pub mod skyline;
pub mod solid;

use face_light::{FaceLight, Limits};
use glam::DVec3;
use skyline::Skyline;
use solid::{Face, Solid};

/// Obstruction or ground that a direction meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    /// The area below the skyline, of uniform luminance.
    Skyline,
    /// A face of a box.
    Face {
        /// Index of the box.
        solid: usize,
        /// Number of the face, see [`Solid::face`].
        face: usize,
        /// Whether the middle of the sun's disc lights the point of the face.
        sunlit: bool,
    },
    /// The ground.
    Ground {
        /// Whether the middle of the sun's disc lights the point of the ground.
        sunlit: bool,
    },
}

/// The ground that boxes stand on or above.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Plane of the ground.
    pub face: Face,
    /// Light of the ground as far as boxes change it.
    pub light: FaceLight,
    /// Limits of the part that boxes change, in the plane's coordinates. \[m\]
    pub limits: Limits,
    /// Luminance beyond the limits, without the sun's own light. \[cd/m²\]
    pub open: f64,
}

/// Part of a plane as seen from a point.
#[derive(Debug)]
pub struct Plane<'a> {
    normal: DVec3,
    /// Axes of the plane's coordinates.
    axes: [DVec3; 2],
    /// Distance from the point along the normal; `foot` holds the coordinates of the point. \[m\]
    height: f64,
    foot: [f64; 2],
    light: &'a FaceLight,
    /// Luminance that the sun adds. \[cd/m²\]
    sun: f64,
    /// Part of the light in which the last direction was found.
    last: usize,
}

/// Surface that is met from a point, prepared for several directions.
#[derive(Debug)]
pub enum Shown<'a> {
    /// Luminance that does not depend on the direction. \[cd/m²\]
    Even(f64),
    /// A surface; for the ground with its light beyond the panels.
    Plane(Plane<'a>, Option<&'a Ground>),
}

impl<'a> Plane<'a> {
    fn new(face: &Face, eye: DVec3, light: &'a FaceLight, sunlit: bool) -> Self {
        Self {
            normal: face.normal,
            axes: [face.u, face.v],
            height: face.normal.dot(face.origin - eye),
            foot: face.coordinates(eye),
            light,
            sun: if sunlit { light.sun } else { 0.0 },
            last: 0,
        }
    }
}

impl Shown<'_> {
    /// Returns the luminance in a direction that meets the surface, and its uncertainty. \[cd/m²\]
    pub fn luminance(&mut self, direction: DVec3) -> [f64; 2] {
        let (plane, ground) = match self {
            Self::Even(luminance) => return [*luminance, 0.0],
            Self::Plane(plane, ground) => (plane, ground),
        };
        let distance = (plane.height / plane.normal.dot(direction)).max(0.0);
        let [u, v] = [0, 1].map(|axis| plane.foot[axis] + distance * plane.axes[axis].dot(direction));
        let [smooth, error] = match ground.filter(|ground| !ground.holds([u, v])) {
            Some(ground) => [ground.open, ground.light.error * ground.open],
            None => plane.light.near(&mut plane.last, [u, v]),
        };
        [smooth + plane.sun, error]
    }
}

impl Ground {
    /// Whether boxes change the ground's light at a place.
    fn holds(&self, [u, v]: [f64; 2]) -> bool {
        let [[a, b], [c, d]] = self.limits;
        (a..=b).contains(&u) && (c..=d).contains(&v)
    }
}

/// Boxes with the light on them, and a skyline.
#[derive(Debug, Clone, PartialEq)]
pub struct Surroundings {
    /// The boxes.
    pub solids: Vec<Solid>,
    /// The building, or without one the room's own box: it blocks the sun from faces, and is never seen from inside.
    pub building: Solid,
    /// Whether the building blocks the sun from the ground, too.
    pub shades_ground: bool,
    /// The ground; `None` where it is black.
    pub ground: Option<Ground>,
    /// Light of every face of every box.
    pub faces: Vec<[FaceLight; 6]>,
    /// Direction towards the sun that lights faces; `None` where it lights none.
    pub sun: Option<DVec3>,
    /// Lines on faces at which the luminance may jump, beside the boxes' own edges: of shadows, and where faces meet.
    pub lines: Vec<Line>,
    /// Skyline: altitude of distant obstructions by bearing.
    pub skyline: Option<Skyline>,
}

/// A line on one face or on two at which the luminance may jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Ends of the line. \[m\]
    pub ends: [DVec3; 2],
    /// The two faces that the line lies on, equal for a line on one face.
    pub faces: [Face; 2],
}

/// Returns the nearest of some boxes that a ray enters: its index, the distance and the face.
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

/// Whether one of some boxes stands between a point and the sun.
fn hidden<'a>(mut solids: impl Iterator<Item = &'a Solid>, point: DVec3, sun: DVec3) -> bool {
    solids.any(|solid| solid.enter(point, sun).is_some())
}

impl Surroundings {
    /// Creates dark boxes and a skyline, above dark ground.
    pub fn dark(solids: Vec<Solid>, skyline: Option<Skyline>) -> Self {
        Self {
            faces: solids.iter().map(|_| std::array::from_fn(|_| FaceLight::even(0.0))).collect(),
            solids,
            building: Solid::new(DVec3::ZERO, DVec3::ZERO, 0.0),
            shades_ground: false,
            ground: None,
            sun: None,
            lines: Vec::new(),
            skyline,
        }
    }

    /// Returns the obstruction or ground met in a direction; `None`: sky or ground of the open outside. Without a point
    /// to see from, boxes do not count.
    pub fn seen(&self, eye: Option<DVec3>, direction: DVec3) -> Option<Seen> {
        self.seen_among(0..self.solids.len(), eye, direction)
    }

    /// Returns [`Self::seen`] with only the given boxes, where no others can be met.
    pub fn seen_among(&self, boxes: impl Iterator<Item = usize>, eye: Option<DVec3>, direction: DVec3) -> Option<Seen> {
        if let Some(eye) = eye {
            let met = first_hit(boxes.map(|index| (index, &self.solids[index])), eye, direction);
            let to_ground = self.ground_along(eye, direction).map_or(f64::INFINITY, |(distance, _)| distance);
            match met.filter(|(_, distance, _)| *distance < to_ground) {
                Some((solid, distance, face)) => {
                    return Some(Seen::Face {
                        solid,
                        face,
                        sunlit: self.sunlit(solid, face, eye + distance * direction),
                    });
                }
                None if to_ground < f64::INFINITY => {
                    return Some(Seen::Ground { sunlit: self.sun_on_ground(eye + to_ground * direction) });
                }
                None => {}
            }
        }
        self.skyline.as_ref().filter(|skyline| skyline.covers(direction)).map(|_| Seen::Skyline)
    }

    /// Returns the distance of the ground in a direction, and the ground. \[m\]
    fn ground_along(&self, eye: DVec3, direction: DVec3) -> Option<(f64, &Ground)> {
        let ground = self.ground.as_ref().filter(|_| direction.z < 0.0)?;
        Some((((ground.face.origin.z - eye.z) / direction.z).max(0.0), ground))
    }

    /// Returns the luminance of an obstruction or of the ground as met, and its uncertainty. \[cd/m²\]
    pub fn luminance(&self, seen: Seen, eye: Option<DVec3>, direction: DVec3) -> [f64; 2] {
        self.shown(seen, eye).luminance(direction)
    }

    /// Returns the surface met from a point, for evaluation in directions that meet nothing else.
    pub fn shown(&self, seen: Seen, eye: Option<DVec3>) -> Shown<'_> {
        match (seen, eye) {
            (Seen::Skyline, _) => Shown::Even(self.skyline.as_ref().map_or(0.0, |skyline| skyline.luminance)),
            (Seen::Face { solid, face, sunlit }, Some(eye)) => {
                let plane = Plane::new(&self.solids[solid].face(face), eye, &self.faces[solid][face], sunlit);
                Shown::Plane(plane, None)
            }
            (Seen::Ground { sunlit }, Some(eye)) => match &self.ground {
                Some(ground) => Shown::Plane(Plane::new(&ground.face, eye, &ground.light, sunlit), Some(ground)),
                None => Shown::Even(0.0),
            },
            (Seen::Face { .. } | Seen::Ground { .. }, None) => Shown::Even(0.0),
        }
    }

    /// Whether the middle of the sun's disc lights a point of a face.
    pub fn sunlit(&self, solid: usize, face: usize, point: DVec3) -> bool {
        let Some(sun) = self.sun.filter(|_| self.faces[solid][face].sun > 0.0) else { return false };
        let others = self.solids.iter().enumerate().filter(|(other, _)| *other != solid).map(|(_, other)| other);
        !hidden(others.chain([&self.building]), point, sun)
    }

    /// Whether the middle of the sun's disc lights a point of the ground.
    fn sun_on_ground(&self, point: DVec3) -> bool {
        let lit = self.ground.as_ref().is_some_and(|ground| ground.light.sun > 0.0);
        let Some(sun) = self.sun.filter(|_| lit) else { return false };
        let building = Some(&self.building).filter(|_| self.shades_ground);
        !hidden(self.solids.iter().chain(building), point, sun)
    }

    /// Returns segments at which the luminance may jump, as vectors from a point.
    pub fn edges_from(&self, eye: DVec3) -> Vec<[DVec3; 2]> {
        let edges = self.solids.iter().flat_map(|solid| solid.visible_edges(eye));
        let turned = |face: &Face| face.normal.dot(eye - face.origin) > 0.0;
        let lines = self.lines.iter().filter(|line| line.faces.iter().any(turned)).map(|line| line.ends);
        edges.chain(lines).map(|edge| edge.map(|p| p - eye)).collect()
    }

    /// Returns the surroundings with all light multiplied by a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        scaled.faces.iter_mut().flatten().for_each(|light| light.scale(factor));
        if let Some(ground) = &mut scaled.ground {
            ground.light.scale(factor);
            ground.open *= factor;
        }
        if let Some(skyline) = &mut scaled.skyline {
            skyline.luminance *= factor;
        }
        scaled
    }

    /// Whether any face, the ground or the skyline has a luminance above 0.
    pub fn is_lit(&self) -> bool {
        self.faces.iter().flatten().any(FaceLight::is_lit)
            || self.ground.as_ref().is_some_and(|ground| ground.light.is_lit() || ground.open > 0.0)
            || self.skyline.as_ref().is_some_and(|skyline| skyline.luminance > 0.0)
    }
}
