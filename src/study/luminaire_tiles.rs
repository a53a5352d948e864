//! Luminous intensity tables of the tiles of an aperture.

use crate::compute::direction::Surface;
use crate::compute::lid::c_gamma::{Averaged, CGammaTable, Panel};
use crate::compute::lid::tiling::{Tile, Tiling};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::Arc;

/// Position of an aperture in its room, and size of the room.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Surface of the room in which the aperture lies: façade or roof.
    pub surface: Surface,
    /// Lower left corner of the aperture in room axes. \[m\]
    pub corner: DVec3,
    /// Width and height of the aperture in its surface. \[m\]
    pub size: [f64; 2],
    /// Width, depth and height of the room. \[m\]
    pub room: DVec3,
}

/// Returns the tiles of an aperture with their intensity tables. `narrow`: whether each tile has its own table for
/// narrowly scattered light.
pub(super) fn tables(averaged: &Averaged, tiling: Tiling, place: Place, narrow: bool) -> Vec<(Tile, Arc<CGammaTable>)> {
    let tiles = tiling.tiles(place.surface, place.corner, place.size);
    let share = 1.0 / tiles.len() as f64;
    let of = |tile: &Tile| {
        let middle = place.surface.facade_from_room(tile.centre - place.corner);
        let rim = [0, 1].map(|axis| {
            let half = 0.501 * tile.size[axis];
            [middle[axis] < half, place.size[axis] - middle[axis] < half]
        });
        let panel = Panel { centre: tile.centre, size: tile.size, surface: place.surface, room: place.room, rim };
        Arc::new(averaged.tile(&panel, share, narrow))
    };
    if averaged.same_for_all(narrow) {
        let table = of(&tiles[0]);
        return tiles.into_iter().map(|tile| (tile, Arc::clone(&table))).collect();
    }
    tiles.into_par_iter().map(|tile| (tile, of(&tile))).collect()
}
