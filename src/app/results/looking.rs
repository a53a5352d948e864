//! Computations of the data that the BTDF tile shows (filtered, compressed, map of schemes).

use super::data_looks::{DataLook, FormKey, FormResult, NoSchemes, SchemesKey, SchemesResult};
use crate::app::results::work::Outcome;
use crate::app::scene::incidence::Incidence;
use crate::app::shell::Shell;
use crate::app::shell::jobs::Lane;
use crate::app::state::Tile;
use crate::app::tiles;
use crate::compute::btdf::Scattered;
use crate::compute::incidence::left_out::LeftOut;
use crate::compute::incidence::ways::triangles;
use crate::study::data_form::{DataForm, NoForm, compressed, filtered};
use crate::study::scene_file::Interpolation;

/// Tile that shows these data.
const TILE: Tile = tiles::BTDF;

/// Requests for the data that the BTDF tile shows.
#[derive(Default)]
pub struct DataForms {
    /// Key of the processed data that were last requested.
    asked_form: Option<FormKey>,
    /// Key of the map of interpolation schemes that was last requested.
    asked_schemes: Option<SchemesKey>,
}

impl DataForms {
    /// Changes the choice of the data that the BTDF tile shows, and makes the tile visible.
    pub fn look(&mut self, shell: &mut Shell, change: impl FnOnce(&mut DataLook)) {
        change(&mut shell.state.data_look);
        // What was stopped is asked for again.
        if shell.results.form.error.is_some() {
            self.asked_form = None;
        }
        if shell.results.schemes.error.is_some() {
            self.asked_schemes = None;
        }
        shell.bring_up(TILE);
    }

    /// Starts the computation of missing data for the BTDF tile, if it is visible.
    pub fn ask(&mut self, shell: &mut Shell) {
        let state = &shell.state;
        let look = state.data_look;
        let Some(dataset) = state.dataset.value.clone().filter(|_| look != DataLook::default()) else { return };
        if !shell.sees(TILE) {
            return;
        }
        let Some(btdf) = dataset.transmission() else { return };
        let compute = state.document.scene.compute;
        let incident = Incidence::shown(state.incident, &state.document.scene, &state.base()).direction;
        let key = FormKey::of(btdf, state.dataset.revision, incident, (look.form, compute.diffuse_interpolation));
        let engine = shell.services.engine.clone();
        if look.form != DataForm::Measured && self.asked_form != Some(key) {
            self.asked_form = Some(key);
            shell.results.form.error = None;
            let (dataset, engine) = (dataset.clone(), engine.clone());
            shell.start(Lane::DataForm, move |_| {
                let made = dataset.transmission().map_or(Err(NoForm::NoValues), |btdf| match key.form {
                    DataForm::Filtered => filtered(btdf, incident, key.diffuse, || match &btdf.scattered {
                        Some(Scattered::Directions(data)) => Some(engine.interpolator(data)),
                        _ => None,
                    }),
                    _ => compressed(btdf, incident),
                });
                Outcome::DataForm(FormResult { key, made })
            });
        }
        let key = (shell.state.dataset.revision, compute.sun_interpolation, compute.interpolation);
        if look.schemes && self.asked_schemes != Some(key) {
            self.asked_schemes = Some(key);
            shell.results.schemes.error = None;
            shell.start(Lane::Schemes, move |_| {
                let made = match dataset.transmission().and_then(|btdf| btdf.scattered.as_ref()) {
                    Some(Scattered::Directions(_)) if key.2 == Interpolation::Patch => Err(NoSchemes::Patches),
                    Some(Scattered::Directions(data)) => {
                        let interpolator = engine.interpolator(data);
                        let model = interpolator.model();
                        let list = triangles(model, &LeftOut::new(model));
                        if list.is_empty() { Err(NoSchemes::NoTriangles) } else { Ok(list) }
                    }
                    Some(Scattered::Cells(_) | Scattered::Tree(_)) => Err(NoSchemes::NoDirections),
                    Some(Scattered::Lambert(_)) | None => Err(NoSchemes::ClosedForm),
                };
                Outcome::Schemes(SchemesResult { key, made })
            });
        }
    }
}
