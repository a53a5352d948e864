//! Interface of a tile to the tile area: a tile is drawn from state and results of the window, and returns commands.

use crate::app::command::Command;
use crate::app::paint::tile::Status;
use crate::app::shell::jobs::Lane;
use crate::app::state::{CatalogueState, Results, Shown, State};
use crate::app::title;
use crate::texts::{catalogue, tiles as say};
use egui::Ui;

/// Input of a tile in one frame.
pub struct TileInput<'a> {
    /// State of the window.
    pub state: &'a State,
    /// Results of the computations of the window.
    pub results: &'a Results,
    /// Function that returns whether a job is running in a lane.
    pub busy: &'a dyn Fn(Lane) -> bool,
    /// Function that returns the progress of the job in a lane, 0 … 1; `None` before it is known.
    pub done: &'a dyn Fn(Lane) -> Option<f32>,
    /// Whether the user is dragging something, during which colour scales and axes must not change.
    pub held: bool,
    /// Whether the numbers of the tile are requested as a table (CSV).
    pub numbers: bool,
    /// Lowest and highest value of the tile's scale, in the tile's unit, if the comparison sets a common scale;
    /// otherwise `None`.
    pub scale: Option<[f64; 2]>,
}

impl<'a> TileInput<'a> {
    /// Returns the status of a picture that is computed while it is drawn, without a job.
    pub fn status(&self, stale: bool, error: Option<&'a str>) -> Status<'a> {
        let doing = self.state.computing.as_deref();
        Status { coarse: false, stale, idle: false, hold_scale: self.held, doing, error }
    }

    /// Returns the status of a result that is computed in a lane; its error is part of the status unless an older
    /// result is shown and a newer one is being computed.
    pub fn status_of<T>(&self, shown: &'a Shown<T>, lane: Lane) -> Status<'a> {
        let busy = (self.busy)(lane);
        let error = shown.error.as_deref().filter(|_| shown.value.is_none() || !busy);
        Status { idle: !busy && self.state.computing.is_none(), ..self.status(shown.stale, error) }
    }

    /// Returns the text shown before a tile has anything to draw, and whether it is an error; `None` once the product
    /// is loaded.
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
            (_, true, _) => Some((catalogue::NONE_SELECTED.into(), false)),
        }
    }

    /// Returns the system in the apertures, and date and time of the scene, as text.
    pub fn caption(&self) -> String {
        format!("{} · {}", title::in_room(self.state), title::time(&self.state.document.scene))
    }
}

/// Drawing of a tile, with its state between frames.
pub trait Drawn {
    /// Returns the lanes whose results the tile draws, in addition to the lane of the scene; their jobs run only while
    /// the tile is visible.
    fn lanes(&self) -> &'static [Lane] {
        &[]
    }
    /// Returns whether the tile's scale is logarithmic, to be changed; `None` if the tile has no such choice.
    fn log(&mut self) -> Option<&mut bool> {
        None
    }
    /// Whether the tile has a result or data to draw. Until then the tile area shows what is awaited.
    fn ready(&self, seen: &TileInput<'_>) -> bool;
    /// Draws the tile over the available space. Returns its numbers as CSV if `seen` requests them.
    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String>;
}
