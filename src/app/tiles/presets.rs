//! Predefined arrangements of the tiles.

use super::layout::Layout;
use super::{btdf, choose, control, lid, room, sky, transmittance, year};
use crate::app::state::Tile;
use crate::app::tiles::arrange::Preset;

/// Returns a predefined arrangement of all tiles. `all`: all tiles, in their order.
pub fn layout(preset: Preset, all: &[Tile]) -> Layout {
    let one = |share: f32, tile: Tile| (share, Layout::Tile(tile));
    match preset {
        Preset::All => {
            let behind = [year::TILE, choose::TILE];
            let others: Vec<Tile> = all.iter().copied().filter(|tile| !behind.contains(tile)).collect();
            Layout::even(&others).behind(control::TILE, &behind)
        }
        Preset::Designer => Layout::Row(vec![
            (1.6, Layout::tabs(&[room::TILE, btdf::TILE, year::TILE, choose::TILE])),
            (
                1.0,
                Layout::Column(vec![
                    one(1.0, sky::TILE),
                    (1.0, Layout::tabs(&[transmittance::TILE, control::TILE, lid::TILE])),
                ]),
            ),
        ]),
        Preset::Maker => Layout::Column(vec![
            (1.2, Layout::Row(vec![one(1.3, btdf::TILE), one(1.0, transmittance::TILE)])),
            (
                1.0,
                Layout::Row(vec![
                    one(1.0, lid::TILE),
                    (1.3, Layout::tabs(&[room::TILE, sky::TILE, control::TILE, year::TILE, choose::TILE])),
                ]),
            ),
        ]),
        Preset::Science => Layout::Row(vec![
            (1.2, Layout::Column(vec![one(1.0, btdf::TILE), one(1.0, lid::TILE)])),
            (
                1.0,
                Layout::Column(vec![
                    (1.3, Layout::tabs(&[room::TILE, year::TILE, choose::TILE])),
                    (1.0, Layout::tabs(&[sky::TILE, transmittance::TILE, control::TILE])),
                ]),
            ),
        ]),
    }
}
