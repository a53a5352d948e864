//! What a tile of the bench is to the bench: something that is drawn from what the window knows, and asks for commands.

use crate::app::command::Command;
use crate::app::jobs::Lane;
use crate::app::paint::tile::Status;
use crate::app::state::{CatalogueState, Results, Shown, State};
use crate::app::title;
use crate::texts::tiles as say;
use egui::Ui;

/// What a tile reads.
pub struct TileInput<'a> {
    /// What the window knows.
    pub state: &'a State,
    /// What was computed.
    pub results: &'a Results,
    /// Is something being computed in a lane?
    pub busy: &'a dyn Fn(Lane) -> bool,
    /// Share done of what is being computed in a lane; `None` before it says so.
    pub done: &'a dyn Fn(Lane) -> Option<f32>,
    /// Something is being dragged: scales stand still.
    pub held: bool,
    /// Are the tile's numbers asked for?
    pub numbers: bool,
    /// Lowest and highest value of the tile's scale where it is shared with others, in the tile's unit.
    pub scale: Option<[f64; 2]>,
}

impl<'a> TileInput<'a> {
    /// How far a picture is to be trusted that is made as it is drawn.
    pub fn status(&self, stale: bool, error: Option<&'a str>) -> Status<'a> {
        let doing = self.state.computing.as_deref();
        Status { coarse: false, stale, idle: false, hold_scale: self.held, doing, error }
    }

    /// The same of a result that a lane computes: an error counts when nothing newer is under way.
    pub fn status_of<T>(&self, shown: &'a Shown<T>, lane: Lane) -> Status<'a> {
        let busy = (self.busy)(lane);
        let error = shown.error.as_deref().filter(|_| shown.value.is_none() || !busy);
        Status { idle: !busy && self.state.computing.is_none(), ..self.status(shown.stale, error) }
    }

    /// What is waited for before a tile has anything to draw, and whether that is an error; `None` once the product is
    /// there.
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

    /// What lights the room and the moment, in words.
    pub fn caption(&self) -> String {
        format!("{} · {}", title::in_room(self.state), title::time(&self.state.document.scene))
    }
}

/// The drawing of a tile, with what it remembers from frame to frame.
pub trait Drawn {
    /// The lanes whose results it draws, beside that of the scene: they run only while it is in sight.
    fn lanes(&self) -> &'static [Lane] {
        &[]
    }
    /// Its choice of a logarithmic scale, where it has one.
    fn log(&mut self) -> Option<&mut bool> {
        None
    }
    /// Is there anything that the tile could draw? Until then the bench says what is waited for.
    fn ready(&self, seen: &TileInput<'_>) -> bool;
    /// Draws the tile over all the space there is; its numbers as CSV where they are asked for.
    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String>;
}
