//! The tiles of the bench. Each is a file that feeds its view (in [`crate::app::views`]) from what the window knows and
//! turns what the view was asked for into commands; a new one is such a file and its entry in [`TILES`]. Keys, menus,
//! palette, layout and exports read that list.

mod btdf;
mod control;
mod drawn;
mod layout;
mod lid;
mod room;
mod sky;
mod transmittance;

pub use drawn::{Drawn, TileInput};
pub use layout::{Layout, Row};

use super::command::Command;
use super::paint::tile::waiting;
use super::state::Tile;
use egui::Ui;

/// A tile, and how its drawing begins.
pub struct Entry {
    /// The tile.
    pub tile: Tile,
    begin: fn() -> Box<dyn Drawn>,
}

const fn entry<D: Drawn + Default + 'static>(tile: Tile) -> Entry {
    Entry { tile, begin: || Box::<D>::default() }
}

/// All tiles, in the order of bench and keys.
pub const TILES: &[Entry] = &[
    entry::<btdf::Drawing>(btdf::TILE),
    entry::<transmittance::Drawing>(transmittance::TILE),
    entry::<sky::Drawing>(sky::TILE),
    entry::<lid::Drawing>(lid::TILE),
    entry::<room::Drawing>(room::TILE),
    entry::<control::Drawing>(control::TILE),
];

/// The tiles of one window, and where they stand.
pub struct Bench {
    /// Where they stand.
    pub layout: Layout,
    drawn: Vec<(Tile, Box<dyn Drawn>)>,
}

impl Default for Bench {
    fn default() -> Self {
        Self {
            layout: Layout::even(TILES.iter().map(|entry| entry.tile).collect()),
            drawn: TILES.iter().map(|entry| (entry.tile, (entry.begin)())).collect(),
        }
    }
}

impl Bench {
    /// Draws a tile; its numbers where they are asked for.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        tile: Tile,
        seen: &TileInput<'_>,
        commands: &mut Vec<Command>,
    ) -> Option<String> {
        let (_, drawn) = self.drawn.iter_mut().find(|(one, _)| *one == tile)?;
        if !drawn.ready(seen)
            && let Some((words, is_error)) = seen.awaited()
        {
            waiting(ui, tile.title, tile.help, &words, is_error);
            return None;
        }
        drawn.show(ui, seen, commands)
    }
}
