//! Division of the surfaces of a box room into rectangular patches with borders along the apertures, in three nested
//! densities.
//!
//! Patches are smaller near the surfaces with apertures, where the direct illuminance changes fastest. Because the
//! densities are nested, one table of exchange areas serves all three, and their differences show the error of the
//! finest.

use super::aperture::Aperture;
use crate::compute::direction::Surface;
use crate::compute::limits;
use glam::DVec3;

/// Box room 0 ≤ x ≤ width, 0 ≤ y ≤ depth, 0 ≤ z ≤ height in the room's frame, with diffuse reflectances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxRoom {
    /// Width, depth and height of the room. \[m\]
    pub size: DVec3,
    /// Diffuse reflectance of the floor, 0 … 1.
    pub floor: f64,
    /// Diffuse reflectance of the four walls outside the apertures, 0 … 1.
    pub walls: f64,
    /// Diffuse reflectance of the ceiling outside the apertures, 0 … 1.
    pub ceiling: f64,
}

/// One of the six surfaces of a box room (wall, floor or ceiling) with the grid lines of its patches.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// Index of the room axis perpendicular to the wall: the wall lies in the plane x (0), y (1) or z (2) = `position`.
    pub axis: usize,
    /// Coordinate of the wall's plane along `axis`. \[m\]
    pub position: f64,
    /// Unit normal that points into the room.
    pub normal: DVec3,
    /// Indices of the two room axes along the wall, rising.
    pub along: [usize; 2],
    /// Coordinates of the grid lines along the two axes of the wall, rising. \[m\]
    pub lines: [Vec<f64>; 2],
    /// Index of the wall's first patch among all patches.
    pub first: usize,
}

/// Rectangular patch of a wall, floor or ceiling, or of an aperture in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Index of the patch's wall.
    pub wall: usize,
    /// Lower and upper limit of the patch along each of the wall's two axes. \[m\]
    pub extent: [[f64; 2]; 2],
    /// Area of the patch. \[m²\]
    pub area: f64,
    /// Diffuse reflectance of the patch, 0 … 1.
    pub reflectance: f64,
    /// Index of the aperture that the patch belongs to; `None` for a patch of the wall itself.
    pub aperture: Option<usize>,
}

/// Patches of all six surfaces of a box room: floor, ceiling, x = 0, x = width, façade, back wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// The six surfaces: floor, ceiling, x = 0, x = width, façade (y = 0), back wall.
    pub walls: Vec<Wall>,
    /// Patches wall by wall; within a wall the index along its first axis varies slowest.
    pub patches: Vec<Patch>,
}

/// Maximum number of fine patches of a room. Exchange areas are stored between them and the patches of twice their
/// size: 0.1 GB at this limit.
pub const MOST_PATCHES: usize = limits::PATCHES;

/// Error of a room whose apertures' borders divide the surfaces into more patches than are allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the borders of {apertures} apertures cut the room into {patches} patches (allowed: {MOST_PATCHES}); line the \
     apertures up, join neighbours, or leave interreflection out"
)]
pub struct TooManyPatches {
    /// Number of apertures of the room.
    pub apertures: usize,
    /// Number of patches by the borders of the apertures alone.
    pub patches: usize,
}

impl Wall {
    /// Returns the point of the wall with the coordinates `a` and `b` along its two axes, in the room's frame. \[m\]
    pub fn point(&self, a: f64, b: f64) -> DVec3 {
        let mut point = DVec3::ZERO;
        point[self.axis] = self.position;
        point[self.along[0]] = a;
        point[self.along[1]] = b;
        point
    }

    /// Returns the range of the indices of the wall's patches among all patches of the mesh.
    pub fn patches(&self) -> std::ops::Range<usize> {
        self.first..self.first + (self.lines[0].len() - 1) * (self.lines[1].len() - 1)
    }
}

impl Patch {
    /// Returns the corners of the patch in order, in the room's frame. \[m\] `wall`: wall of the patch.
    pub fn corners(&self, wall: &Wall) -> [DVec3; 4] {
        let [a, b] = self.extent;
        [wall.point(a[0], b[0]), wall.point(a[1], b[0]), wall.point(a[1], b[1]), wall.point(a[0], b[1])]
    }
}

/// Meshes of one room in three nested densities; each patch lies in one patch of the next coarser mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Nested {
    /// Finest mesh, on which illuminances are given; a patch of the next density consists of up to 2 × 2 of its
    /// patches.
    pub fine: Mesh,
    /// Mesh between whose patches the interreflection is solved.
    pub coarse: Mesh,
    /// Mesh with patches of twice the size of those of `coarse`, from which the error of the interreflection is
    /// estimated.
    pub coarser: Mesh,
    /// Index of the coarse patch that contains each fine patch.
    pub coarse_of_fine: Vec<usize>,
    /// Index of the coarser patch that contains each coarse patch.
    pub coarser_of_coarse: Vec<usize>,
}

impl Nested {
    /// Creates the meshes of a room with about `count` fine patches. `aperture_reflectance`: reflectance of the room
    /// side of each aperture.
    ///
    /// The borders of apertures are grid lines on all walls along the same axis, up to 2.5 `count` patches. If that
    /// would leave too few lines along the other axes (many strips), they are grid lines only on the surface of the
    /// aperture.
    ///
    /// # Errors
    /// Returns an error if the borders of the apertures alone divide the room into more than [`MOST_PATCHES`] patches.
    pub fn with_about(
        room: &BoxRoom,
        apertures: &[Aperture],
        aperture_reflectance: &[f64],
        count: usize,
    ) -> Result<Self, TooManyPatches> {
        let s = room.size;
        let wanted = 0.8 * (2.0 * (s.x * s.y + s.y * s.z + s.z * s.x) / count as f64).sqrt();
        let mut segments = Segments::new(room, apertures, Cuts::Everywhere);
        let mut step = segments.step(wanted, (5 * count / 4).min(MOST_PATCHES));
        if step > COARSENED * wanted {
            // Patches added by the borders of apertures do not count towards `count`.
            segments = Segments::new(room, apertures, Cuts::OwnSurface);
            let bare = Segments::new(room, apertures, Cuts::None).step(wanted, (5 * count / 4).min(MOST_PATCHES));
            step = segments.step(bare, (4 * count).min(MOST_PATCHES));
        }
        let coarsest = segments.patches(f64::INFINITY);
        if coarsest > MOST_PATCHES {
            return Err(TooManyPatches { apertures: apertures.len(), patches: coarsest });
        }
        let [coarser, coarse, fine] =
            segments.lines(step).map(|lines| Mesh::from_lines(room, apertures, aperture_reflectance, lines));
        let (coarse_of_fine, coarser_of_coarse) = (coarse.holders(&fine), coarser.holders(&coarse));
        Ok(Self { fine, coarse, coarser, coarse_of_fine, coarser_of_coarse })
    }
}

/// Whether an aperture is too small for patches. Exchange areas are differences of numbers of the order of the room's
/// size squared, so that an aperture below a hundred-millionth of that would be lost in their rounding. The illuminance
/// by such an aperture is computed from its outline, and its reflectance is that of the wall around it.
pub fn too_small(room: &BoxRoom, aperture: &Aperture) -> bool {
    let length = room.size.max_element();
    aperture.area() < 1e-8 * length * length || aperture.size[0].min(aperture.size[1]) < 1e-7 * length
}

/// Maximum step of the grid lines, relative to the intended one, up to which the apertures' borders are grid lines on
/// all surfaces. Chosen: cost; results change within their stated error.
const COARSENED: f64 = 1.5;

/// The six surfaces in the order of [`Mesh`]: index of the perpendicular axis, and whether the surface lies at the far
/// end of that axis.
const SIDES: [(usize, bool); 6] = [(2, false), (2, true), (0, false), (0, true), (1, false), (1, true)];

/// Returns the two axes along a surface in rising order, the same for opposite walls; required by the exchange areas.
const fn along(axis: usize) -> [usize; 2] {
    [if axis == 0 { 1 } else { 0 }, if axis == 2 { 1 } else { 2 }]
}

/// Returns the surface for apertures in one of the six surfaces: ceiling (roof lights) and façade only; `None` for the
/// others.
fn surface_of(side: usize) -> Option<Surface> {
    match side {
        1 => Some(Surface::Roof),
        4 => Some(Surface::Facade),
        _ => None,
    }
}

impl Mesh {
    /// Creates the mesh from the coordinates of grid lines along both axes of each of the six surfaces, rising; the
    /// lines must include the apertures' borders. `aperture_reflectance`: reflectance of the room side of each
    /// aperture. \[m\]
    pub fn from_lines(
        room: &BoxRoom,
        apertures: &[Aperture],
        aperture_reflectance: &[f64],
        lines: [[Vec<f64>; 2]; 6],
    ) -> Self {
        let mut mesh = Self { walls: Vec::with_capacity(6), patches: Vec::new() };
        for (number, ((axis, high), lines)) in SIDES.into_iter().zip(lines).enumerate() {
            let mut normal = DVec3::ZERO;
            normal[axis] = if high { -1.0 } else { 1.0 };
            let wall = Wall {
                axis,
                position: if high { room.size[axis] } else { 0.0 },
                normal,
                along: along(axis),
                lines,
                first: mesh.patches.len(),
            };
            let surface = surface_of(number);
            let bare = match number {
                0 => room.floor,
                1 => room.ceiling,
                _ => room.walls,
            };
            for a in wall.lines[0].windows(2) {
                for b in wall.lines[1].windows(2) {
                    // The lines hold all borders of apertures, so that no patch lies across one: its centre decides for
                    // all of it.
                    let centre = wall.point(0.5 * (a[0] + a[1]), 0.5 * (b[0] + b[1]));
                    let aperture = apertures.iter().position(|aperture| {
                        let offset = aperture.surface.facade_from_room(centre - aperture.corner);
                        // Only the offset along the surface is compared, so that the surface must be checked, too.
                        surface == Some(aperture.surface)
                            && !too_small(room, aperture)
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

    /// Returns, for every patch of a finer mesh that has all grid lines of this one, the index of the patch that
    /// contains it.
    fn holders(&self, finer: &Self) -> Vec<usize> {
        let mut holders = Vec::with_capacity(finer.patches.len());
        for (wall, fine) in self.walls.iter().zip(&finer.walls) {
            let [a, b] = [0, 1].map(|side| holding_intervals(&wall.lines[side], &fine.lines[side]));
            let n1 = wall.lines[1].len() - 1;
            holders.extend(a.iter().flat_map(|i| b.iter().map(move |j| wall.first + i * n1 + j)));
        }
        holders
    }
}

/// Returns, for every interval of `fine`, the index of the interval of `coarse` that contains its middle.
fn holding_intervals(coarse: &[f64], fine: &[f64]) -> Vec<usize> {
    fine.windows(2).map(|pair| coarse.partition_point(|line| *line <= 0.5 * (pair[0] + pair[1])) - 1).collect()
}

/// Surfaces on which the borders of an aperture are grid lines.
#[derive(Clone, Copy, PartialEq)]
enum Cuts {
    Everywhere,
    OwnSurface,
    None,
}

/// Segments between the apertures' borders along both axes of every surface, for the choice of grid lines.
struct Segments {
    sides: [[Axis; 2]; 6],
}

/// One axis of a surface: the apertures' borders, and the increase of the step with the distance from the end that has
/// apertures.
struct Axis {
    cuts: Vec<f64>,
    length: f64,
    /// Distance from the end with apertures over which the step is small \[m\]; `None` for uniform steps.
    near: Option<f64>,
    /// Whether the apertures lie at the far end.
    reversed: bool,
}

impl Segments {
    fn new(room: &BoxRoom, apertures: &[Aperture], rule: Cuts) -> Self {
        // The direct illuminance decreases over a distance of about the aperture's width.
        let near = |surface: Surface, length: f64| {
            apertures
                .iter()
                .filter(|aperture| aperture.surface == surface)
                .map(|aperture| (0.7 * aperture.area().sqrt()).max(0.1 * length))
                .min_by(f64::total_cmp)
        };
        let axis = |side: usize, axis: usize| {
            let cuts = apertures
                .iter()
                .filter(|aperture| !too_small(room, aperture))
                .filter(|aperture| match rule {
                    Cuts::Everywhere => true,
                    Cuts::OwnSurface => surface_of(side) == Some(aperture.surface),
                    Cuts::None => false,
                })
                .map(|aperture| aperture.corners())
                .filter(|corners| (corners[2][axis] - corners[0][axis]).abs() > 0.0)
                .flat_map(|corners| [corners[0][axis], corners[2][axis]]);
            let length = room.size[axis];
            let (near, reversed) = match axis {
                1 => (near(Surface::Facade, length), false),
                2 => (near(Surface::Roof, length), true),
                _ => (None, false),
            };
            Axis { cuts: forced_lines(length, cuts.collect()), length, near, reversed }
        };
        Self { sides: std::array::from_fn(|side| along(SIDES[side].0).map(|a| axis(side, a))) }
    }

    /// Returns the number of fine patches with a step. \[m\]
    fn patches(&self, step: f64) -> usize {
        let on = |axis: &Axis| axis.parts(step).iter().sum::<usize>();
        self.sides.iter().map(|[a, b]| on(a) * on(b)).sum()
    }

    /// Returns the smallest step, `wanted` or larger, with at most `allowed` fine patches, or with as few as the
    /// borders alone require. \[m\]
    fn step(&self, wanted: f64, allowed: usize) -> f64 {
        let allowed = allowed.max(self.patches(f64::INFINITY));
        let mut step = wanted;
        while self.patches(step) > allowed {
            step *= 1.03;
        }
        step
    }

    /// Returns the grid lines of the three densities, coarsest first. \[m\]
    fn lines(&self, step: f64) -> [[[Vec<f64>; 2]; 6]; 3] {
        [4, 2, 1].map(|every| self.sides.each_ref().map(|side| side.each_ref().map(|axis| axis.lines(step, every))))
    }
}

impl Axis {
    /// Returns the transformed coordinate of a position along the axis, in which steps are uniform;
    /// [`Self::unstretched`] is the inverse.
    fn stretched(&self, x: f64) -> f64 {
        match self.near {
            None => x,
            Some(near) => {
                let depth = if self.reversed { self.length - x } else { x };
                let s = (near + 0.4 * self.length) * (depth / near).ln_1p();
                if self.reversed { -s } else { s }
            }
        }
    }

    fn unstretched(&self, s: f64) -> f64 {
        match self.near {
            None => s,
            Some(near) => {
                let s = if self.reversed { -s } else { s };
                let depth = near * (s / (near + 0.4 * self.length)).exp_m1();
                if self.reversed { self.length - depth } else { depth }
            }
        }
    }

    /// Returns the number of fine intervals in every segment: a multiple of four, or two or one for a short segment.
    fn parts(&self, step: f64) -> Vec<usize> {
        self.cuts
            .windows(2)
            .map(|pair| {
                // The slack keeps rounding from deciding, so that results do not depend on the unit of length.
                let wanted = (self.stretched(pair[1]) - self.stretched(pair[0])) / step - 1e-9;
                if wanted <= 0.75 {
                    1
                } else if wanted <= 2.4 {
                    2
                } else {
                    4 * (wanted / 4.0 - 0.15).ceil().max(1.0) as usize
                }
            })
            .collect()
    }

    /// Returns every `every`-th of the fine grid lines of each segment.
    fn lines(&self, step: f64, every: usize) -> Vec<f64> {
        let mut lines = vec![0.0];
        for (pair, parts) in self.cuts.windows(2).zip(self.parts(step)) {
            let (from, to) = (self.stretched(pair[0]), self.stretched(pair[1]));
            let kept = (parts / every).max(1);
            // One expression for a line in all densities, so that equal lines are equal to the last bit.
            lines.extend(
                (1..kept).map(|k| self.unstretched(from + (to - from) * ((k * parts / kept) as f64 / parts as f64))),
            );
            lines.push(pair[1]);
        }
        lines
    }
}

/// Returns 0, the apertures' borders and the length of the axis, rising. Borders that coincide with each other or with
/// an end to rounding are merged.
fn forced_lines(length: f64, mut cuts: Vec<f64>) -> Vec<f64> {
    let slack = 1e-9 * length;
    cuts.retain(|c| *c > slack && *c < length - slack);
    cuts.extend([0.0, length]);
    cuts.sort_unstable_by(f64::total_cmp);
    cuts.dedup_by(|b, a| *b - *a < slack);
    cuts
}
