//! Processed data (filtered or compressed) in the BTDF tile: their choice in the tile's head, and the notes on them.

use super::input::{Action, FormInput, Input};
use crate::app::paint::tile::Foot;
use crate::drawing::ticks::number;
use crate::study::data_form::{DataForm, Formed, How, NoForm};
use crate::texts::{Text, fixed, tiles as say};
use egui::Ui;

/// Returns label and tooltip of a kind of processing: original, filtered or compressed data.
pub const fn words(form: DataForm) -> [Text; 2] {
    match form {
        DataForm::Measured => [say::MEASURED, say::MEASURED_TIP],
        DataForm::Filtered => [say::FILTERED, say::FILTERED_TIP],
        DataForm::Compact => [say::COMPACT, say::COMPACT_TIP],
    }
}

/// Draws the choice of the processing of the data, and of the map of interpolation schemes, in the tile's head.
pub(super) fn choice(ui: &mut Ui, input: &Input<'_>, actions: &mut Vec<Action>) {
    let now = input.form.map_or(DataForm::Measured, |form| form.form);
    let menu = ui.menu_button(say::DATA, |ui| {
        for form in DataForm::ALL {
            let [word, tip] = words(form);
            if ui.selectable_label(form == now, word).on_hover_text(tip).clicked() && form != now {
                actions.push(Action::Form(form));
            }
        }
        ui.separator();
        let mut schemes = input.schemes.is_some();
        if ui.toggle_value(&mut schemes, say::SCHEMES).on_hover_text(say::SCHEMES_TIP).changed() {
            actions.push(Action::Schemes);
        }
    });
    menu.response.on_hover_text(say::FORM_TIP);
}

impl<'a> FormInput<'a> {
    /// Returns the processed data; `None` until they are computed, or if they cannot be.
    pub(super) fn made(&self) -> Option<&'a Formed> {
        self.result?.made.as_ref().ok()
    }

    /// Returns the key of the processing in tables (CSV).
    pub(super) const fn key(&self) -> &'static str {
        match self.form {
            DataForm::Measured => "measured",
            DataForm::Filtered => "filtered",
            DataForm::Compact => "compact",
        }
    }

    /// Returns the reason why there are no processed data to show, as text.
    pub(super) fn missing(&self) -> String {
        if let Some(error) = self.error {
            return error.to_owned();
        }
        match self.result.map(|result| &result.made) {
            Some(Err(NoForm::NoValues)) => say::NO_FORM_VALUES.into(),
            Some(Err(NoForm::Means)) => say::NO_FORM_MEANS.into(),
            Some(Err(NoForm::Tree)) => say::NO_FORM_TREE.into(),
            Some(Err(NoForm::NoLattice)) => say::NO_FORM_LATTICE.into(),
            Some(Err(NoForm::Values(why))) => say::no_form_values(why),
            _ => say::FORM_COMING.into(),
        }
    }

    /// Returns the line under the picture: the processing of the data, and the difference of the processed data from
    /// the original ones; the reason if there are none.
    pub(super) fn foot(&self) -> Option<Foot> {
        let Some(made) = self.made() else { return Some(Foot::from(self.missing())) };
        let percent = |share: f64| fixed(100.0 * share, 1);
        let far = made.difference.map(|difference| (number(difference.largest, 3), percent(difference.misplaced)));
        Some(match (made.how, far) {
            (How::Filter { scheme, in_force }, Some((largest, moved))) => {
                let why = if in_force { say::FILTER_IN_FORCE } else { say::FILTER_NOT_IN_FORCE };
                Foot::from([
                    say::foot_filtered(scheme.key(), why, &largest, &moved),
                    say::foot_filtered_short(largest, moved),
                    say::FILTERED.into(),
                ])
            }
            (How::Wavelets { kept, cells, allowed, .. }, Some((largest, moved))) => Foot::from([
                say::foot_compact(kept, cells, &largest, &moved, percent(allowed)),
                say::foot_compact_middle(kept, cells, largest, moved, percent(allowed)),
                say::foot_compact_short(kept, cells),
                say::foot_compact_shortest(kept),
            ]),
            (How::Wavelets { kept, cells, allowed, .. }, None) => Foot::from([
                say::foot_kept_compact(kept, cells, percent(allowed)),
                say::foot_compact_short(kept, cells),
                say::foot_compact_shortest(kept),
            ]),
            (How::Filter { .. }, None) => return None,
        })
    }
}
