//! The LID tile: luminous intensity distribution of the first aperture, regarded as a luminaire in the room.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::shell::jobs::Lane;
use crate::app::state::Tile;
use crate::app::views::lid;
use crate::texts::tiles as say;
use egui::Ui;

/// The LID tile.
pub const TILE: Tile = Tile { title: "LID", name: say::LID, help: say::LID_HELP };

/// Drawing of the LID tile, with its state between frames.
#[derive(Default)]
pub struct Drawing {
    view: lid::State,
}

impl Drawn for Drawing {
    fn lanes(&self) -> &'static [Lane] {
        &[Lane::Lid]
    }

    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.results.lid.value.is_some() || seen.results.lid.error.is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, _commands: &mut Vec<Command>) -> Option<String> {
        let shown = &seen.results.lid;
        let figures = shown.value.as_deref();
        let name = seen.caption();
        let input = lid::Input {
            lid: figures.map(|figures| &figures.lid),
            name: &name,
            peaks: seen.results.lid_peaks(),
            flux: figures.map(|figures| figures.flux.value - figures.lid.beam_flux()),
            max: seen.scale.map(|[_, max]| max),
            revision: shown.revision,
            status: seen.status_of(shown, Lane::Lid),
        };
        lid::show(ui, &input, &mut self.view);
        seen.numbers.then(|| lid::csv(&input))
    }
}
