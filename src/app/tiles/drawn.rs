//! Interface of a tile to the tile area: a tile is drawn from what the window knows, and returns commands.

use crate::app::command::Command;
use crate::app::jobs::Lane;
use crate::app::paint::tile::Status;
use crate::app::state::{CatalogueState, Results, Shown, State};
use crate::app::title;
use crate::texts::tiles as say;
use egui::Ui;

/// Input of a tile.
pub struct TileInput<'a> {
    /// State of the window.
    pub state: &'a State,
    /// Results of the computations.
    pub results: &'a Results,
    /// Function that returns whether something is being computed in a lane.
    pub busy: &'a dyn Fn(Lane) -> bool,
    /// Function that returns the share done of what is being computed in a lane; `None` before it is known.
    pub done: &'a dyn Fn(Lane) -> Option<f32>,
    /// Whether something is being dragged: scales stay as they are.
    pub held: bool,
    /// Whether the tile's numbers are requested.
    pub numbers: bool,
    /// Lowest and highest value of the tile's scale where it is shared with others, in the tile's unit.
    pub scale: Option<[f64; 2]>,
}

impl<'a> TileInput<'a> {
    /// Returns the status of a picture that is made as it is drawn.
    pub fn status(&self, stale: bool, error: Option<&'a str>) -> Status<'a> {
        let doing = self.state.computing.as_deref();
        Status { coarse: false, stale, idle: false, hold_scale: self.held, doing, error }
    }

    /// Returns the status of a result that a lane computes: an error counts when nothing newer is being computed.
    pub fn status_of<T>(&self, shown: &'a Shown<T>, lane: Lane) -> Status<'a> {
        let busy = (self.busy)(lane);
        let error = shown.error.as_deref().filter(|_| shown.value.is_none() || !busy);
        Status { idle: !busy && self.state.computing.is_none(), ..self.status(shown.stale, error) }
    }

    /// Returns what the window waits for before a tile has anything to draw, and whether that is an error; `None` once
    /// the product is there.
    pub fn awaited(&self) -> Option<(String, bool)> {
        let state = self.state;
        match &state.catalogue {
            CatalogueState::Opening => return Some((say::OPENING_CATALOGUE.into(), false)),
            CatalogueState::Failed(error) => return Some((error.clone(), true)),
            CatalogueState::Ready(_) => {}
        }
        let busy = [Lane::Catalogue, Lane::Scene].into_iter().any(|lane| (self.busy)(lane));
        let product = &state.document.selection.product;
        match (&state.dataset.error, product.is_empty(), state.dataset.value.is_some()) {
            (_, false, true) => None,
            (Some(error), false, false) if !busy => Some((error.clone(), true)),
            (_, false, false) => Some((say::READING_PRODUCT.into(), false)),
            (_, true, _) if busy => Some((say::READING_CATALOGUE.into(), false)),
            (_, true, _) if (self.busy)(Lane::Builtin) => Some((say::LISTING_BUILTIN.into(), false)),
            (_, true, _) => Some((say::NO_PRODUCT.into(), false)),
        }
    }

    /// Returns the system that lights the room and the moment, as text.
    pub fn caption(&self) -> String {
        format!("{} · {}", title::in_room(self.state), title::time(&self.state.document.scene))
    }
}

/// Drawing of a tile, with its state between frames.
pub trait Drawn {
    /// Returns the lanes whose results it draws, beside that of the scene: they run only while the tile is visible.
    fn lanes(&self) -> &'static [Lane] {
        &[]
    }
    /// Returns the tile's choice of a logarithmic scale; `None` if it has none.
    fn log(&mut self) -> Option<&mut bool> {
        None
    }
    /// Whether there is anything that the tile could draw. Until then the tile area shows what it waits for.
    fn ready(&self, seen: &TileInput<'_>) -> bool;
    /// Draws the tile over the available space. Returns its numbers as CSV if they are requested.
    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String>;
}
