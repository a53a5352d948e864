//! The surfaces of the box, cut into rectangular patches that end at the apertures' borders.

use super::aperture::Aperture;
use crate::compute::direction::Surface;
use glam::DVec3;

/// A box room: 0 ≤ x ≤ width, 0 ≤ y ≤ depth, 0 ≤ z ≤ height, with diffuse reflectances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxRoom {
    /// Width, depth, height. \[m\]
    pub size: DVec3,
    /// Reflectance of the floor.
    pub floor: f64,
    /// Reflectance of the four walls, outside the apertures.
    pub walls: f64,
    /// Reflectance of the ceiling, outside the apertures.
    pub ceiling: f64,
}

/// One side of the box with its grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// 0, 1, 2: the wall lies in x, y or z = `position`.
    pub axis: usize,
    /// \[m\]
    pub position: f64,
    /// Points into the room.
    pub normal: DVec3,
    /// The two axes along the wall, rising.
    pub along: [usize; 2],
    /// Grid lines along both. \[m\]
    pub lines: [Vec<f64>; 2],
    /// Index of the wall's first patch.
    pub first: usize,
}

/// One patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Index of its wall.
    pub wall: usize,
    /// From and to along the wall's two axes. \[m\]
    pub extent: [[f64; 2]; 2],
    /// \[m²\]
    pub area: f64,
    /// Diffuse reflectance.
    pub reflectance: f64,
    /// The aperture that it is part of.
    pub aperture: Option<usize>,
}

/// All patches: floor, ceiling, x = 0, x = width, façade, back wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// The six sides.
    pub walls: Vec<Wall>,
    /// Wall by wall, first axis slowest.
    pub patches: Vec<Patch>,
}

/// Most patches of a room: two dense matrices of their number are kept, 0.6 GB at this limit.
pub const MOST_PATCHES: usize = 6000;

/// The borders of the apertures cut the walls into more patches than can be balanced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the borders of {apertures} apertures cut the room into {patches} patches (allowed: {MOST_PATCHES}); line the \
     apertures up, join neighbours, or leave interreflection out"
)]
pub struct TooManyPatches {
    /// Number of apertures.
    pub apertures: usize,
    /// Patches that their borders alone make.
    pub patches: usize,
}

impl Wall {
    /// A point of the wall from its two coordinates.
    pub fn point(&self, a: f64, b: f64) -> DVec3 {
        let mut point = DVec3::ZERO;
        point[self.axis] = self.position;
        point[self.along[0]] = a;
        point[self.along[1]] = b;
        point
    }
}

impl Patch {
    /// The corners in order round the patch.
    pub fn corners(&self, wall: &Wall) -> [DVec3; 4] {
        let [a, b] = self.extent;
        [wall.point(a[0], b[0]), wall.point(a[1], b[0]), wall.point(a[1], b[1]), wall.point(a[0], b[1])]
    }
}

impl Mesh {
    /// About `count` patches; `aperture_reflectance` of the room side of each aperture.
    ///
    /// The borders of apertures are lines on all walls that share the axis. Where they alone cut a long room into
    /// rows of many more patches than asked for, the step grows until there are at most 2.5 `count`.
    pub fn with_about(
        room: &BoxRoom,
        apertures: &[Aperture],
        aperture_reflectance: &[f64],
        count: usize,
    ) -> Result<Self, TooManyPatches> {
        let mut step = Self::step_for(room, count);
        let number = |step: f64| {
            let [x, y, z] = lines(room, apertures, step).map(|lines| lines.len() - 1);
            2 * (x * y + y * z + z * x)
        };
        let coarsest = number(f64::INFINITY);
        if coarsest > MOST_PATCHES {
            return Err(TooManyPatches { apertures: apertures.len(), patches: coarsest });
        }
        let allowed = (5 * count / 2).max(coarsest);
        while number(step) > allowed {
            step *= 1.1;
        }
        Ok(Self::new(room, apertures, aperture_reflectance, step))
    }

    /// Patches of about `step` \[m\] in both directions; `aperture_reflectance` of the room side of each aperture.
    pub fn new(room: &BoxRoom, apertures: &[Aperture], aperture_reflectance: &[f64], step: f64) -> Self {
        let lines = lines(room, apertures, step);
        let sides = [(2, false), (2, true), (0, false), (0, true), (1, false), (1, true)];
        let mut mesh = Self { walls: Vec::with_capacity(6), patches: Vec::new() };
        for (number, (axis, high)) in sides.into_iter().enumerate() {
            let along = [if axis == 0 { 1 } else { 0 }, if axis == 2 { 1 } else { 2 }];
            let mut normal = DVec3::ZERO;
            normal[axis] = if high { -1.0 } else { 1.0 };
            let wall = Wall {
                axis,
                position: if high { room.size[axis] } else { 0.0 },
                normal,
                along,
                lines: along.map(|a| lines[a].clone()),
                first: mesh.patches.len(),
            };
            let surface = match number {
                1 => Some(Surface::Roof),
                4 => Some(Surface::Facade),
                _ => None,
            };
            let bare = match number {
                0 => room.floor,
                1 => room.ceiling,
                _ => room.walls,
            };
            for a in wall.lines[0].windows(2) {
                for b in wall.lines[1].windows(2) {
                    let centre = wall.point(0.5 * (a[0] + a[1]), 0.5 * (b[0] + b[1]));
                    let aperture = apertures.iter().position(|aperture| {
                        let offset = aperture.surface.facade_from_room(centre - aperture.corner);
                        surface == Some(aperture.surface)
                            && (0.0..aperture.size[0]).contains(&offset.x)
                            && (0.0..aperture.size[1]).contains(&offset.y)
                    });
                    mesh.patches.push(Patch {
                        wall: number,
                        extent: [[a[0], a[1]], [b[0], b[1]]],
                        area: (a[1] - a[0]) * (b[1] - b[0]),
                        reflectance: aperture.map_or(bare, |index| aperture_reflectance[index]),
                        aperture,
                    });
                }
            }
            mesh.walls.push(wall);
        }
        mesh
    }

    /// The step that gives about `count` patches.
    pub fn step_for(room: &BoxRoom, count: usize) -> f64 {
        let s = room.size;
        (2.0 * (s.x * s.y + s.y * s.z + s.z * s.x) / count as f64).sqrt()
    }
}

/// Grid lines along x, y and z.
fn lines(room: &BoxRoom, apertures: &[Aperture], step: f64) -> [Vec<f64>; 3] {
    let mut cuts: [Vec<f64>; 3] = Default::default();
    for aperture in apertures {
        let corners = aperture.corners();
        for (axis, cuts) in cuts.iter_mut().enumerate() {
            if (corners[2][axis] - corners[0][axis]).abs() > 0.0 {
                cuts.extend([corners[0][axis], corners[2][axis]]);
            }
        }
    }
    [0, 1, 2].map(|axis| grid_lines(room.size[axis], step, &mut cuts[axis]))
}

fn grid_lines(length: f64, step: f64, cuts: &mut Vec<f64>) -> Vec<f64> {
    // Cuts closer than rounding to each other or to the ends are the same line.
    let slack = 1e-9 * length;
    cuts.retain(|c| *c > slack && *c < length - slack);
    cuts.push(0.0);
    cuts.push(length);
    cuts.sort_unstable_by(f64::total_cmp);
    cuts.dedup_by(|b, a| *b - *a < slack);
    let mut lines = vec![0.0];
    for pair in cuts.windows(2) {
        let parts = ((pair[1] - pair[0]) / step - 1e-9).ceil().max(1.0) as usize;
        lines.extend((1..=parts).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / parts as f64));
    }
    if let Some(last) = lines.last_mut() {
        *last = length;
    }
    lines
}
