//! The surfaces of a room divided into small pieces with the illuminance at their corners, finer along the edges of sun
//! patches.

use crate::compute::polygon::area;
use crate::compute::room::beam::Lit;
use crate::compute::room::mesh::Wall;
use crate::study::{PatchLight, SurfaceLight};
use glam::{DVec2, DVec3};

/// Maximum edge length of a piece. \[m\]
const LARGEST: f64 = 0.25;
/// Number of times that a piece is halved in both directions if the edge of a sun patch crosses it.
const HALVINGS: usize = 3;

/// Rectangular piece of a surface of the room.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Index of the surface in [`SurfaceLight`].
    pub wall: usize,
    /// Corners in room coordinates, in order round the piece. \[m\]
    pub corners: [DVec3; 4],
    /// Illuminance at each corner, in the order of `corners`. \[lx\]
    pub illuminance: [f64; 4],
    /// Diffuse reflectance of the surface.
    pub reflectance: f64,
}

/// Returns the patches of a surface, with their numbers along its first and second axis.
fn grid<'a>(light: &'a SurfaceLight, wall: &Wall) -> (&'a [PatchLight], usize, usize) {
    (&light.patches[wall.patches()], wall.lines[0].len() - 1, wall.lines[1].len() - 1)
}

/// Returns the index of the interval between ascending `lines` that contains a coordinate; the nearest interval if none
/// does.
fn cell(lines: &[f64], at: f64) -> usize {
    lines.partition_point(|line| *line <= at).clamp(1, lines.len() - 1) - 1
}

/// Returns the indices of the two intervals between whose middles a coordinate lies, and its relative distance from the
/// first middle, 0 … 1.
fn between(lines: &[f64], at: f64) -> (usize, usize, f64) {
    let middle = |k: usize| 0.5 * (lines[k] + lines[k + 1]);
    let own = cell(lines, at);
    let last = lines.len() - 2;
    let (a, b) = if at < middle(own) { (own.max(1) - 1, own) } else { (own, (own + 1).min(last)) };
    let share = if a == b { 0.0 } else { (at - middle(a)) / (middle(b) - middle(a)) };
    (a, b, share)
}

/// Returns the illuminance without the sun's beams at a point of a surface, interpolated between the mean values of its
/// patches \[lx\]. `at`: coordinates along the surface \[m\].
fn diffuse(light: &SurfaceLight, wall: &Wall, at: DVec2) -> f64 {
    let (patches, _, columns) = grid(light, wall);
    let (i0, i1, s) = between(&wall.lines[0], at.x);
    let (j0, j1, t) = between(&wall.lines[1], at.y);
    let value = |i: usize, j: usize| patches[i * columns + j].diffuse.value;
    let row = |i: usize| value(i, j0) + t * (value(i, j1) - value(i, j0));
    row(i0) + s * (row(i1) - row(i0))
}

fn holds(lit: &Lit, at: DVec2) -> bool {
    let sign = area(&lit.corners).signum();
    let edges = lit.corners.iter().zip(lit.corners.iter().cycle().skip(1));
    edges.into_iter().all(|(a, b)| sign * (*b - *a).perp_dot(at - *a) >= 0.0)
}

/// Returns the illuminance by the sun's beams at a point of a surface \[lx\]. `at`: coordinates along the surface
/// \[m\].
fn beams(light: &SurfaceLight, wall: usize, at: DVec2) -> f64 {
    light.lit.iter().filter(|lit| lit.wall == wall && holds(lit, at)).map(|lit| lit.illuminance).sum()
}

/// Returns the patch at a point of a surface, given in room coordinates \[m\], and the illuminances at this point
/// without the sun's beams and by them \[lx\]; `None` if there is no such surface.
pub fn at(light: &SurfaceLight, wall: usize, point: DVec3) -> Option<(PatchLight, f64, f64)> {
    let own = light.walls.get(wall)?;
    let place = DVec2::new(point[own.along[0]], point[own.along[1]]);
    let (patches, _, columns) = grid(light, own);
    let patch = patches[cell(&own.lines[0], place.x) * columns + cell(&own.lines[1], place.y)];
    Some((patch, diffuse(light, own, place), beams(light, wall, place)))
}

/// Whether the edge of a sun patch, the area lit by a beam, crosses a rectangle of its surface, given by its lowest and
/// highest corner \[m\].
fn crosses(lit: &Lit, low: DVec2, high: DVec2) -> bool {
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    if corners.iter().all(|corner| holds(lit, *corner)) {
        return false;
    }
    let sign = area(&lit.corners).signum();
    let beyond = |a: DVec2, b: DVec2| corners.iter().all(|at| sign * (b - a).perp_dot(*at - a) < 0.0);
    let mut edges = lit.corners.iter().zip(lit.corners.iter().cycle().skip(1));
    let aside = (0..2).any(|k| {
        let along = lit.corners.iter().map(|corner| corner[k]);
        along.clone().all(|v| v <= low[k]) || along.clone().all(|v| v >= high[k])
    });
    !aside && !edges.any(|(a, b)| beyond(*a, *b))
}

struct Cutter<'a> {
    light: &'a SurfaceLight,
    wall: usize,
    reflectance: f64,
    lit: Vec<&'a Lit>,
    pieces: Vec<Piece>,
}

impl Cutter<'_> {
    /// Adds a rectangle of the surface to the pieces, halved at most `halvings` times where edges of sun patches cross
    /// it.
    fn cut(&mut self, low: DVec2, high: DVec2, halvings: usize) {
        if halvings > 0 && self.lit.iter().any(|lit| crosses(lit, low, high)) {
            let middle = 0.5 * (low + high);
            for (x, y) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                let part = |k: usize, upper: i32| if upper == 1 { [middle[k], high[k]] } else { [low[k], middle[k]] };
                let ([x0, x1], [y0, y1]) = (part(0, x), part(1, y));
                self.cut(DVec2::new(x0, y0), DVec2::new(x1, y1), halvings - 1);
            }
            return;
        }
        let wall = &self.light.walls[self.wall];
        let places = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        // A piece is in a sun patch or not: its middle decides.
        let beams = beams(self.light, self.wall, 0.5 * (low + high));
        self.pieces.push(Piece {
            wall: self.wall,
            corners: places.map(|place| wall.point(place.x, place.y)),
            illuminance: places.map(|place| diffuse(self.light, wall, place) + beams),
            reflectance: self.reflectance,
        });
    }
}

/// Returns the pieces of all surfaces of the room without the apertures.
pub fn pieces(light: &SurfaceLight) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (number, wall) in light.walls.iter().enumerate() {
        let lit: Vec<&Lit> = light.lit.iter().filter(|lit| lit.wall == number).collect();
        for one in &light.patches[wall.patches()] {
            if one.patch.aperture.is_some() {
                continue;
            }
            let [a, b] = one.patch.extent;
            let mut cutter = Cutter {
                light,
                wall: number,
                reflectance: one.patch.reflectance,
                lit: lit.clone(),
                pieces: Vec::new(),
            };
            let count = |[low, high]: [f64; 2]| ((high - low) / LARGEST - 1e-9).ceil().max(1.0) as usize;
            let (n, m) = (count(a), count(b));
            let step = |[low, high]: [f64; 2], k: usize, n: usize| low + (high - low) * k as f64 / n as f64;
            for i in 0..n {
                for j in 0..m {
                    let low = DVec2::new(step(a, i, n), step(b, j, m));
                    cutter.cut(low, DVec2::new(step(a, i + 1, n), step(b, j + 1, m)), HALVINGS);
                }
            }
            pieces.append(&mut cutter.pieces);
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::estimate::Estimate;
    use crate::compute::room::aperture::Aperture;
    use crate::compute::room::mesh::{BoxRoom, Nested};

    /// Returns light that rises evenly along x and y, and a triangle of sun on the floor.
    fn light() -> SurfaceLight {
        let room = BoxRoom { size: DVec3::new(4.0, 6.0, 3.0), floor: 0.2, walls: 0.5, ceiling: 0.7 };
        let window = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [3.0, 1.8] };
        let mesh = Nested::with_about(&room, &[window], &[0.1], 300).unwrap().fine;
        let of = |patch: &crate::compute::room::mesh::Patch| {
            let [low, _, high, _] = patch.corners(&mesh.walls[patch.wall]);
            let middle = 0.5 * (low + high);
            PatchLight { patch: *patch, diffuse: Estimate::exact(100.0 + 10.0 * middle.x + 20.0 * middle.y), beam: 0.0 }
        };
        let patches = mesh.patches.iter().map(of).collect();
        let corners = vec![DVec2::new(1.0, 1.0), DVec2::new(3.0, 1.0), DVec2::new(2.0, 3.0)];
        let lit = vec![Lit { wall: 0, corners, illuminance: 5000.0 }];
        SurfaceLight { walls: mesh.walls, patches, lit, flux: Estimate::exact(1.0) }
    }

    fn size(piece: &Piece) -> f64 {
        (piece.corners[1] - piece.corners[0]).cross(piece.corners[3] - piece.corners[0]).length()
    }

    #[test]
    fn pieces_cover_all_surfaces_but_the_windows() {
        let pieces = pieces(&light());
        let all: f64 = pieces.iter().map(size).sum();
        assert!((all - (2.0 * (24.0 + 18.0 + 12.0) - 5.4)).abs() < 1e-9, "{all}");
        assert!(pieces.len() < 20_000, "{}", pieces.len());
    }

    #[test]
    fn light_between_patches_follows_them_and_sun_patches_have_their_area() {
        let light = light();
        let pieces = pieces(&light);
        let (mut sunny, mut far) = (0.0, 0.0_f64);
        for piece in pieces.iter().filter(|piece| piece.wall == 0) {
            let sun = if piece.illuminance[0] > 1000.0 { 5000.0 } else { 0.0 };
            sunny += if sun > 0.0 { size(piece) } else { 0.0 };
            for (corner, e) in piece.corners.iter().zip(piece.illuminance) {
                // Beyond the middles of the outermost patches it stays what it is there.
                if (0.6..3.4).contains(&corner.x) && (0.6..5.4).contains(&corner.y) {
                    far = far.max((e - sun - 100.0 - 10.0 * corner.x - 20.0 * corner.y).abs());
                }
            }
        }
        assert!(far < 1e-9, "{far}");
        // Its border is as fine as the smallest pieces.
        assert!((sunny - 2.0).abs() < 0.04, "{sunny}");
        let (patch, diffuse, beam) = at(&light, 0, DVec3::new(2.0, 1.5, 0.0)).unwrap();
        assert!(beam == 5000.0 && (diffuse - 150.0).abs() < 1e-9 && patch.patch.wall == 0);
        assert_eq!(at(&light, 0, DVec3::new(2.0, 3.5, 0.0)).unwrap().2, 0.0);
    }
}
