//! Division of an aperture into tiles, each a luminaire: other programs light a room by point sources, and a beam of
//! the sun's width from one point would light a small spot, whereas the tile lights an area of its own outline.
//!
//! A host program divides a luminous area into parts of at most a quarter of their distance ([`parts`]) and takes each
//! as a point source with the intensity distribution of the tile. A beam is therefore widened to the angle that such a
//! part subtends at the lit surface ([`Panel`](super::c_gamma::Panel)): the areas lit by the points lie side by side
//! and add up to the tile's outline. Light of the sky and scattered light are wide enough and are not changed.

use crate::compute::direction::Surface;
use glam::DVec3;

/// Maximum size of the parts into which a host program (a lighting program that reads luminaire files) divides a
/// luminous area, as a fraction of their distance from the lit point. The default of Radiance's `rpict` (`-ds .25`); a
/// part is then within (1/4)²/6 = 1 % of a point.
pub const PART: f64 = 0.25;
/// Maximum number of parts along a side of a luminous area in host programs. Chosen: cost; reached at distances below a
/// tenth of the side.
const MOST_PARTS: f64 = 40.0;
/// Distance from an aperture below which results of host programs are not compared, because they differ from program to
/// program there. \[m\] Chosen: limit of the comparison by which tiles are chosen; the files' headers state it.
pub const NEAREST: f64 = 1.0;
/// Height of the work plane above the floor: reference plane of EN 17037. \[m\]
pub const WORK_PLANE: f64 = 0.85;

/// Division of an aperture into tiles of equal size: columns along x_F and rows along y_F of the façade frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tiling {
    /// Number of columns along x_F.
    pub columns: usize,
    /// Number of rows along y_F.
    pub rows: usize,
}

/// Position and size of one rectangular tile of an aperture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tile {
    /// Centre of the tile in the room's frame. \[m\]
    pub centre: DVec3,
    /// Size of the tile along x_F and along y_F of the façade frame. \[m\]
    pub size: [f64; 2],
}

impl Tiling {
    /// Tiling with the whole aperture as one tile.
    pub const WHOLE: Self = Self { columns: 1, rows: 1 };

    /// Returns the number of tiles.
    pub const fn count(self) -> usize {
        self.columns * self.rows
    }

    /// Returns the size of one tile along x_F and y_F, for an aperture of this size. \[m\]
    pub fn tile(self, size: [f64; 2]) -> [f64; 2] {
        [size[0] / self.columns as f64, size[1] / self.rows as f64]
    }

    /// Creates the coarsest tiling of an aperture of this size whose tiles are at most `longest` long along x_F and
    /// along y_F. \[m\]
    pub fn no_longer_than(size: [f64; 2], longest: f64) -> Self {
        let count = |length: f64| ((length / longest - 1e-9).ceil().max(1.0)) as usize;
        Self { columns: count(size[0]), rows: count(size[1]) }
    }

    /// Returns the tiles row by row from the lower left, seen from outside. `corner`: lower left corner of the aperture
    /// in the room's frame; `size`: size of the aperture. \[m\]
    pub fn tiles(self, surface: Surface, corner: DVec3, size: [f64; 2]) -> Vec<Tile> {
        let own = self.tile(size);
        let centre = |k: usize| {
            let [x, y] = [(k % self.columns) as f64 + 0.5, (k / self.columns) as f64 + 0.5];
            corner + surface.room_from_facade(DVec3::new(x * own[0], y * own[1], 0.0))
        };
        (0..self.count()).map(|k| Tile { centre: centre(k), size: own }).collect()
    }
}

/// Returns the number of parts along each side into which a host program divides a luminous area of this size for a
/// point at this distance. \[m\]
pub fn parts(size: [f64; 2], distance: f64) -> usize {
    (size[0].max(size[1]) / (PART * distance.max(0.05))).ceil().clamp(1.0, MOST_PARTS) as usize
}

/// Returns the distance \[m\] from a point of the room to the surface that light in `direction` meets, and the index of
/// the room axis perpendicular to that surface. For points above the work plane, the work plane replaces the floor.
/// `room`: width, depth and height of the room \[m\]; all vectors in the room's frame.
pub fn landing(room: DVec3, from: DVec3, direction: DVec3) -> (f64, usize) {
    let mut nearest = (f64::INFINITY, 0);
    for axis in 0..3 {
        let low = if axis == 2 && from.z > WORK_PLANE && room.z > WORK_PLANE { WORK_PLANE } else { 0.0 };
        let ahead = if direction[axis] > 0.0 { room[axis] - from[axis] } else { low - from[axis] };
        let distance = (ahead / direction[axis]).max(0.0);
        if direction[axis].abs() > 1e-9 && distance < nearest.0 {
            nearest = (distance, axis);
        }
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_fill_the_aperture_from_the_lower_left() {
        let tiling = Tiling { columns: 2, rows: 3 };
        let facade = tiling.tiles(Surface::Facade, DVec3::new(1.0, 0.0, 0.5), [2.0, 1.5]);
        assert_eq!(facade.len(), 6);
        assert_eq!(facade[1], Tile { centre: DVec3::new(2.5, 0.0, 0.75), size: [1.0, 0.5] });
        assert_eq!(facade[2].centre, DVec3::new(1.5, 0.0, 1.25));
        let roof = tiling.tiles(Surface::Roof, DVec3::new(1.0, 2.0, 3.0), [2.0, 1.5]);
        assert_eq!(roof[5].centre, DVec3::new(2.5, 3.25, 3.0));
        assert_eq!(Tiling::no_longer_than([2.8, 1.5], 0.35), Tiling { columns: 8, rows: 5 });
        assert_eq!(Tiling::no_longer_than([2.8, 1.5], f64::INFINITY), Tiling::WHOLE);
    }

    #[test]
    fn a_beam_ends_on_the_work_plane_or_on_a_wall() {
        let room = DVec3::new(4.0, 6.0, 3.0);
        let down = DVec3::new(0.0, 0.6, -0.8);
        let lands = |from: DVec3, direction: DVec3, distance: f64, across: usize| {
            let (found, axis) = landing(room, from, direction);
            assert!((found - distance).abs() < 1e-12 && axis == across, "{found} {axis}");
        };
        lands(DVec3::new(2.0, 0.0, 2.45), down, 2.0, 2);
        // From below it to the floor.
        lands(DVec3::new(2.0, 0.0, 0.8), down, 1.0, 2);
        lands(DVec3::new(2.0, 0.0, 2.0), DVec3::new(0.8, 0.6, 0.0), 2.5, 0);
        lands(DVec3::new(2.0, 0.0, 2.0), DVec3::Y, 6.0, 1);
    }
}
