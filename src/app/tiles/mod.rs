//! The tiles of the tile area. Each is a file that passes state and results of the window to its view (in
//! [`crate::app::views`]) and converts the view's actions to commands; a new tile needs such a file and an entry in
//! [`TILES`]. Shortcuts, menus, command palette, layout and exports use that list.

pub mod arrange;
pub mod docking;

mod btdf;
mod choose;
mod control;
mod drawn;
mod layout;
mod lid;
mod presets;
mod room;
mod sky;
mod transmittance;
mod year;

pub use btdf::TILE as BTDF;
pub use choose::{TILE as CHOOSE, scene_name};
pub use drawn::{Drawn, TileInput};
pub use layout::Layout;
pub use lid::TILE as LID;
pub use presets::layout as preset;
pub use room::TILE as ROOM;
pub use sky::TILE as SKY;
pub use year::TILE as YEAR;

use super::command::Command;
use super::paint::tile::waiting;
use super::state::{Results, State, Tile};
use crate::app::shell::jobs::Lane;
use egui::{Rect, Response, Ui};
use egui_tiles::Tree;
use std::time::{Duration, Instant};

/// Entry of the list of tiles: a tile, and the function that creates its drawing.
pub struct Entry {
    /// Tile of this entry.
    pub tile: Tile,
    begin: fn() -> Box<dyn Drawn>,
}

const fn entry<D: Drawn + Default + 'static>(tile: Tile) -> Entry {
    Entry { tile, begin: || Box::<D>::default() }
}

/// All tiles, in the order of tile area and number keys.
pub const TILES: &[Entry] = &[
    entry::<btdf::Drawing>(btdf::TILE),
    entry::<transmittance::Drawing>(transmittance::TILE),
    entry::<sky::Drawing>(sky::TILE),
    entry::<lid::Drawing>(lid::TILE),
    entry::<room::Drawing>(room::TILE),
    entry::<control::Drawing>(control::TILE),
    entry::<year::Drawing>(year::TILE),
    entry::<choose::Drawing>(choose::TILE),
];

/// Tiles of one window or one candidate of the comparison, and their arrangement.
pub struct Bench {
    /// Arrangement of the tiles as it is drawn by egui_tiles.
    tree: Tree<Tile>,
    /// Stored text of the arrangement `tree`; `None` for the arrangement of a first start.
    text: Option<String>,
    /// Visible tiles and their rectangles in the last frame, in order.
    places: Vec<(Tile, Rect)>,
    /// Active tile: the one last under the pointer or last reached by keys.
    in_hand: Tile,
    /// Whether the active tile is to get the keyboard focus in the next frame.
    to_focus: bool,
    /// Time that drawing each visible tile took in the last frame.
    times: Vec<(Tile, Duration)>,
    drawn: Vec<(Tile, Box<dyn Drawn>)>,
}

/// Returns all tiles, in the order of tile area and number keys.
pub fn all() -> Vec<Tile> {
    TILES.iter().map(|entry| entry.tile).collect()
}

/// Returns the arrangement of a first start: six tiles in two rows, with the tiles of year and ranking as tabs behind
/// the control tile.
fn first() -> Layout {
    presets::layout(crate::app::tiles::arrange::Preset::All, &all())
}

/// Returns the tiles that can be drawn for the candidates of a comparison: all except those of year and ranking, which
/// are computed for the scene alone.
pub fn compared() -> impl Iterator<Item = Tile> + Clone {
    TILES.iter().map(|entry| entry.tile).filter(|tile| ![year::TILE, choose::TILE].contains(tile))
}

impl Default for Bench {
    fn default() -> Self {
        Self {
            tree: first().tree(),
            text: None,
            places: Vec::new(),
            in_hand: TILES[0].tile,
            to_focus: false,
            times: Vec::new(),
            drawn: TILES.iter().map(|entry| (entry.tile, (entry.begin)())).collect(),
        }
    }
}

impl Bench {
    /// Returns the current arrangement.
    pub fn layout(&self) -> Layout {
        Layout::of(&self.tree).unwrap_or_else(first)
    }

    /// Arranges the tiles by a stored text (`None`: as at a first start), if it differs from that of the current
    /// arrangement.
    ///
    /// # Errors
    /// Returns an error, in one clause, if the text cannot be read; the tiles are then arranged as at a first start.
    pub fn follow(&mut self, text: Option<&String>) -> Result<(), String> {
        if self.text.as_ref() == text {
            return Ok(());
        }
        self.text = text.cloned();
        let read = text.map_or_else(|| Ok(first()), |text| Layout::read(text, &all()));
        self.tree = read.as_ref().cloned().unwrap_or_else(|_| first()).tree();
        read.map(drop)
    }

    /// Begins a frame, in which no tile is placed yet. Returns a copy of the arrangement to be drawn, which
    /// [`Self::end_frame`] takes: what is visible can be asked for until then.
    pub fn begin_frame(&mut self) -> Tree<Tile> {
        self.times.clear();
        self.places.clear();
        self.tree.clone()
    }

    /// Ends a frame. `edited`: whether the user has changed the arrangement. Returns the text to be stored if so.
    pub fn end_frame(&mut self, tree: Tree<Tile>, edited: bool) -> Option<String> {
        self.tree = tree;
        let text = edited.then(|| self.layout().text())?;
        self.text = Some(text.clone());
        Some(text)
    }

    /// Records the rectangle of a tile that is visible in this frame.
    pub fn place(&mut self, tile: Tile, rect: Rect) {
        self.places.push((tile, rect));
    }

    /// Returns the rectangle of a tile; `None` if it is not visible.
    pub fn place_of(&self, tile: Tile) -> Option<Rect> {
        self.places.iter().find(|(one, _)| *one == tile).map(|(_, rect)| *rect)
    }

    /// Returns the time that drawing each visible tile took in the last frame.
    pub fn times(&self) -> &[(Tile, Duration)] {
        &self.times
    }

    /// Makes a tile the active one if its head is used, or gives its head the keyboard focus if it is to get it.
    pub fn follow_head(&mut self, tile: Tile, head: &Response) {
        // The head that has the keyboard is not asked while another one is about to get it.
        let focused = head.has_focus() && !self.to_focus;
        if head.clicked() || head.secondary_clicked() || head.drag_started() || focused {
            self.in_hand = tile;
        }
        if self.to_focus && self.in_hand == tile {
            self.to_focus = false;
            head.request_focus();
        }
    }

    /// Returns the visible tiles. `maximised`: tile that fills the tile area and hides the others.
    pub fn visible_tiles(&self, maximised: Option<Tile>) -> Vec<Tile> {
        maximised.map_or_else(|| self.layout().visible_tiles(), |tile| vec![tile])
    }

    /// Whether a visible tile draws results that are computed in a lane. `maximised`: as in [`Self::visible_tiles`].
    pub fn shows(&self, lane: Lane, maximised: Option<Tile>) -> bool {
        let visible = self.visible_tiles(maximised);
        self.drawn.iter().any(|(tile, drawn)| visible.contains(tile) && drawn.lanes().contains(&lane))
    }

    /// Whether the content of a tile is outdated, i.e. belongs to an earlier scene or selection.
    pub fn is_old(&self, tile: Tile, state: &State, results: &Results) -> bool {
        let lanes = self.drawn.iter().find(|(one, _)| *one == tile).map_or(&[][..], |(_, drawn)| drawn.lanes());
        let old = |lane: &Lane| match lane {
            Lane::Lid => results.lid.stale,
            Lane::Room => results.room.stale,
            Lane::Surfaces => results.surfaces.stale,
            // What does not move has none.
            Lane::Year => results.year.value.is_some() && results.year.stale,
            Lane::Annual => results.annual.value.as_ref().is_none_or(|annual| !annual.is_of(&state.document.scene)),
            Lane::Rank => results.rank.stale,
            _ => false,
        };
        state.dataset.stale || state.daylight.stale || lanes.iter().any(old)
    }

    /// Returns whether the scale of a tile is logarithmic, to be changed; `None` if the tile has no such choice.
    pub fn log(&mut self, tile: Tile) -> Option<&mut bool> {
        self.drawn.iter_mut().find(|(one, _)| *one == tile)?.1.log()
    }

    /// Draws a tile over the available space. Returns its numbers as CSV if `seen` requests them.
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
            waiting(ui, tile.name.get(), tile.help.get(), &words, is_error);
            return None;
        }
        let start = Instant::now();
        let numbers = drawn.show(ui, seen, commands);
        self.times.push((tile, start.elapsed()));
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::tiles::arrange::Preset;

    #[test]
    fn every_preset_has_every_tile_once() {
        for ready in Preset::ALL {
            let mut tiles = preset(ready, &all()).tiles();
            tiles.sort_by_key(|tile| all().iter().position(|one| one == tile));
            assert_eq!(tiles, all(), "{ready:?}");
        }
    }

    #[test]
    fn a_lane_is_asked_for_by_tiles_in_sight_alone() {
        let mut bench = Bench::default();
        assert!(bench.shows(Lane::Room, None) && bench.shows(Lane::Lid, None) && bench.shows(Lane::Year, None));
        assert!(!bench.shows(Lane::Room, Some(btdf::TILE)));
        let maker = preset(Preset::Maker, &all()).text();
        bench.follow(Some(&maker)).unwrap();
        assert!(bench.shows(Lane::Room, None) && !bench.shows(Lane::Year, None));
        assert!(bench.follow(Some(&"{".to_owned())).is_err());
        assert_eq!(bench.layout().visible_tiles(), compared().collect::<Vec<_>>());
        // Said once.
        assert!(bench.follow(Some(&"{".to_owned())).is_ok());
    }
}
