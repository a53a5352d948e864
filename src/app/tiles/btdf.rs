//! The BTDF tile: one incidence of the selected dataset, the sun's or a chosen one.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::facing::sun_incident;
use crate::app::incidence::Incidence;
use crate::app::jobs::Lane;
use crate::app::state::Tile;
use crate::app::title;
use crate::app::views::btdf;
use egui::Ui;

/// The tile.
pub const TILE: Tile = Tile {
    title: "BTDF",
    help: "Where light from one direction leaves, as luminance per illuminance (q in 1/sr). IEA SHC Task 31, eq 2.",
};

/// Its drawing.
#[derive(Default)]
pub struct Drawing {
    view: btdf::State,
}

impl Drawn for Drawing {
    fn log(&mut self) -> Option<&mut bool> {
        Some(&mut self.view.log)
    }

    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.state.dataset.value.is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String> {
        let state = seen.state;
        let sun = sun_incident(&state.document.scene);
        let dataset = &state.dataset;
        let name = title::selection(state);
        let input = btdf::Input {
            btdf: dataset.value.as_deref().and_then(|dataset| dataset.transmission()),
            name: &name,
            incidence: Incidence::shown(state.incident, &state.document.scene),
            sun,
            range: seen.scale,
            revision: dataset.revision,
            status: seen.status_of(dataset, Lane::Scene),
        };
        for action in btdf::show(ui, &input, &mut self.view) {
            commands.push(Command::Incidence(match action {
                btdf::Action::ChooseIncidence(chosen) => Some(chosen),
                btdf::Action::FollowSun(true) => None,
                btdf::Action::FollowSun(false) => Some(input.incidence.direction),
            }));
        }
        seen.numbers.then(|| btdf::csv(&input))
    }
}
