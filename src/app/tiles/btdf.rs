//! The BTDF tile: scattering data of the selected dataset for one incident direction, that of the sun or a chosen one.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::paint::tile::Status;
use crate::app::results::data_looks::FormKey;
use crate::app::scene::facing::sun_incident;
use crate::app::scene::incidence::Incidence;
use crate::app::shell::jobs::Lane;
use crate::app::state::Tile;
use crate::app::title;
use crate::app::views::btdf::{self, FormInput, SchemesInput};
use crate::study::data_form::DataForm;
use crate::texts::tiles as say;
use egui::Ui;

/// The BTDF tile.
pub const TILE: Tile = Tile { title: "BTDF", name: say::BTDF, help: say::BTDF_HELP };

/// Drawing of the BTDF tile, with its state between frames.
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
        let sun = sun_incident(&state.document.scene, &state.base());
        let dataset = &state.dataset;
        let name = title::selection(state);
        let btdf = dataset.value.as_deref().and_then(|dataset| dataset.transmission());
        let incidence = Incidence::shown(state.incident, &state.document.scene, &state.base());
        let status = seen.status_of(dataset, Lane::Scene);
        // Until data of this incidence are there in the form that is looked at, those of the last one stay.
        let (look, shown) = (state.data_look, &seen.results.form);
        let result = shown.value.as_deref().filter(|made| made.key.form == look.form);
        let form = (look.form != DataForm::Measured).then_some(FormInput {
            form: look.form,
            result,
            error: shown.error.as_deref(),
            revision: shown.revision,
        });
        let old = btdf.zip(result).filter(|_| form.is_some()).is_some_and(|(btdf, made)| {
            let diffuse = state.document.scene.compute.diffuse_interpolation;
            made.key != FormKey::of(btdf, dataset.revision, incidence.direction, (look.form, diffuse))
        });
        let input = btdf::Input {
            btdf,
            name: &name,
            incidence,
            sun,
            range: seen.scale,
            revision: dataset.revision,
            form,
            schemes: state.data_look.schemes.then(|| {
                let shown = &seen.results.schemes;
                let result = shown.value.as_deref().filter(|made| made.key.0 == dataset.revision);
                SchemesInput { result, error: shown.error.as_deref(), revision: shown.revision }
            }),
            status: Status { stale: status.stale || old, ..status },
        };
        for action in btdf::show(ui, &input, &mut self.view) {
            commands.push(match action {
                btdf::Action::ChooseIncidence(chosen) => Command::Incidence(Some(chosen)),
                btdf::Action::FollowSun(true) => Command::Incidence(None),
                btdf::Action::FollowSun(false) => Command::Incidence(Some(input.incidence.direction)),
                btdf::Action::Form(form) => Command::DataForm(form),
                btdf::Action::Schemes => Command::SchemeMap,
            });
        }
        seen.numbers.then(|| btdf::csv(&input))
    }
}
