//! Obstructions in front of a façade or above a roof: boxes with vertical sides, the ground, and a skyline that changes
//! with the bearing.
//!
//! | file | contents |
//! | --- | --- |
//! | `solid` | box: intersection with a ray, edges, faces and outline as seen from a point |
//! | `skyline` | skyline: altitude by bearing |
//! | `face_light` | luminance of a face |
//! | `shading` | sunlit part of a rectangle behind boxes |
//!
//! All coordinates are in the world's axes (x east, y north, z up) relative to the room's origin, in metres. Boxes have
//! a position, so that they are seen differently from different points; a skyline has only directions.
//!
//! Faces and ground are lit by sky, sun and each other, and reflect diffusely with the luminance ρE/π. See
//! [`crate::compute::sky::faces`].

pub mod face_light;
pub mod shading;
pub mod skyline;
pub mod solid;

use face_light::{FaceLight, Limits};
use glam::DVec3;
use skyline::Skyline;
use solid::{Face, Solid};

/// Obstruction or ground that is visible in a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    /// Area below the skyline by bearing, of uniform luminance.
    Skyline,
    /// Face of a box.
    Face {
        /// Index of the box.
        solid: usize,
        /// Number of the face, 0 … 5, see [`Solid::face`].
        face: usize,
        /// Whether the visible point of the face is sunlit by the centre of the sun's disc.
        sunlit: bool,
    },
    /// The ground.
    Ground {
        /// Whether the visible point of the ground is sunlit by the centre of the sun's disc.
        sunlit: bool,
    },
}

/// Ground with its luminance, which boxes change near to them.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Plane of the ground with its coordinates.
    pub face: Face,
    /// Luminance of the ground within `limits`, where boxes change it.
    pub light: FaceLight,
    /// Limits of the area whose luminance boxes change, in the plane's coordinates. \[m\]
    pub limits: Limits,
    /// Luminance of the ground outside `limits`, without the part directly reflected from the sun. \[cd/m²\]
    pub open: f64,
}

/// Face or ground as seen from a point, prepared for luminances in several directions.
#[derive(Debug)]
pub struct Plane<'a> {
    normal: DVec3,
    /// Axes of the plane's coordinates.
    axes: [DVec3; 2],
    /// Distance of the plane from the point along the normal; `foot` holds the coordinates of the point in the plane.
    /// \[m\]
    height: f64,
    foot: [f64; 2],
    light: &'a FaceLight,
    /// Luminance by directly reflected sunlight. \[cd/m²\]
    sun: f64,
    /// Index of the part of `light` in which the previous direction was found.
    last: usize,
}

/// Surface of an obstruction as seen from a point, prepared for luminances in several directions.
#[derive(Debug)]
pub enum Shown<'a> {
    /// Uniform luminance, of a skyline for instance. \[cd/m²\]
    Even(f64),
    /// Face or ground with varying luminance; for the ground with its luminance outside the panels.
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
    /// Returns the luminance of the surface in a direction (unit vector, world's axes) that meets it, and its
    /// uncertainty. \[cd/m²\]
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
    /// Whether a point of the ground lies in the area whose luminance boxes change.
    fn holds(&self, [u, v]: [f64; 2]) -> bool {
        let [[a, b], [c, d]] = self.limits;
        (a..=b).contains(&u) && (c..=d).contains(&v)
    }
}

/// Obstructions with their luminances for one date and time: boxes, ground and skyline by bearing, in the world's axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Surroundings {
    /// Boxes in front of the façade.
    pub solids: Vec<Solid>,
    /// Building, or without one the box of the room: it blocks the sun from faces, and is not visible from inside.
    pub building: Solid,
    /// Whether the building blocks the sun from the ground, too.
    pub shades_ground: bool,
    /// Ground with its luminance; `None` if it is black.
    pub ground: Option<Ground>,
    /// Luminance of every face of every box.
    pub faces: Vec<[FaceLight; 6]>,
    /// Direction towards the sun, world's axes; `None` if no face is sunlit.
    pub sun: Option<DVec3>,
    /// Lines on faces, apart from edges of boxes, at which the luminance may be discontinuous: edges of shadows, and
    /// lines where faces of overlapping boxes meet.
    pub lines: Vec<Line>,
    /// Skyline of distant obstructions by bearing; `None` without one.
    pub skyline: Option<Skyline>,
}

/// Line on one face or on two at which the luminance may be discontinuous.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Ends of the line in the world's axes. \[m\]
    pub ends: [DVec3; 2],
    /// The two faces that the line lies on, equal for a line on one face.
    pub faces: [Face; 2],
}

/// Returns the nearest of some boxes that a ray enters: index of the box, distance \[m\] and number of the face
/// ([`Solid::face`]); `None` if it meets no box. `from`: start of the ray; `direction`: unit vector.
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

/// Whether one of some boxes hides the sun from a point.
fn hidden<'a>(mut solids: impl Iterator<Item = &'a Solid>, point: DVec3, sun: DVec3) -> bool {
    solids.any(|solid| solid.enter(point, sun).is_some())
}

impl Surroundings {
    /// Creates boxes and a skyline with luminance 0 of all faces and of the ground.
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

    /// Returns the obstruction or ground that is visible from the point `eye` \[m\] in a direction (unit vector), both
    /// in the world's axes; `None` for the sky or for ground without luminance data. Without `eye`, only the skyline
    /// counts.
    pub fn seen(&self, eye: Option<DVec3>, direction: DVec3) -> Option<Seen> {
        self.seen_among(0..self.solids.len(), eye, direction)
    }

    /// Returns the obstruction or ground that is visible in a direction like [`Self::seen`], considering only the boxes
    /// with the given indices; the caller ensures that no other box can be met.
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

    /// Returns the distance from a point to the ground in a direction \[m\], and the ground; `None` for directions that
    /// do not meet it.
    fn ground_along(&self, eye: DVec3, direction: DVec3) -> Option<(f64, &Ground)> {
        let ground = self.ground.as_ref().filter(|_| direction.z < 0.0)?;
        Some((((ground.face.origin.z - eye.z) / direction.z).max(0.0), ground))
    }

    /// Returns the luminance of the obstruction or ground `seen` from the point `eye` in a direction, and its
    /// uncertainty. \[cd/m²\]
    pub fn luminance(&self, seen: Seen, eye: Option<DVec3>, direction: DVec3) -> [f64; 2] {
        self.shown(seen, eye).luminance(direction)
    }

    /// Returns the surface `seen` from the point `eye`, prepared for luminances in neighbouring directions that meet
    /// the same surface.
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

    /// Whether a point of a face is sunlit by the centre of the sun's disc. `solid`: index of the box; `face`: number
    /// of its face.
    pub fn sunlit(&self, solid: usize, face: usize, point: DVec3) -> bool {
        let Some(sun) = self.sun.filter(|_| self.faces[solid][face].sun > 0.0) else { return false };
        let others = self.solids.iter().enumerate().filter(|(other, _)| *other != solid).map(|(_, other)| other);
        !hidden(others.chain([&self.building]), point, sun)
    }

    /// Whether a point of the ground is sunlit by the centre of the sun's disc.
    fn sun_on_ground(&self, point: DVec3) -> bool {
        let lit = self.ground.as_ref().is_some_and(|ground| ground.light.sun > 0.0);
        let Some(sun) = self.sun.filter(|_| lit) else { return false };
        let building = Some(&self.building).filter(|_| self.shades_ground);
        !hidden(self.solids.iter().chain(building), point, sun)
    }

    /// Returns the segments at which the luminance may be discontinuous as seen from the point `eye`: visible edges of
    /// boxes and lines on faces, their ends as vectors from the point. \[m\]
    pub fn edges_from(&self, eye: DVec3) -> Vec<[DVec3; 2]> {
        let edges = self.solids.iter().flat_map(|solid| solid.visible_edges(eye));
        let turned = |face: &Face| face.normal.dot(eye - face.origin) > 0.0;
        let lines = self.lines.iter().filter(|line| line.faces.iter().any(turned)).map(|line| line.ends);
        edges.chain(lines).map(|edge| edge.map(|p| p - eye)).collect()
    }

    /// Returns the obstructions with all luminances multiplied by a factor.
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
