//! Findings of the data check on datasets, with repairs to try, and a picture of the directions of the transmitted
//! light, which shows whether the orientation of the data is right.

use crate::app::display::theme;
use crate::app::import::proposal::number;
use crate::app::state::State;
use crate::compute::btdf::{Dataset, Severity};
use crate::compute::doctor::{Diagnosis, Repair, RepairKind, Ways};
use crate::texts::findings::words;
use crate::texts::{Text, fixed, import as text};
use egui::{Color32, Sense, Stroke, Ui, Vec2};
use std::sync::Arc;

/// Returns the number of findings of each severity as text, errors before warnings and infos: `1 error, 2 warnings`;
/// empty without findings.
pub(super) fn counts(list: &[Diagnosis]) -> String {
    let of = |severity: Severity| list.iter().filter(|one| one.finding.severity == severity).count();
    type Words = (Severity, Text, fn(usize) -> String);
    let words: [Words; 3] = [
        (Severity::Error, text::ONE_ERROR, text::errors),
        (Severity::Warning, text::ONE_WARNING, text::warnings),
        (Severity::Info, text::ONE_NOTE, text::notes),
    ];
    let words = words.into_iter().map(|(severity, one, more)| (of(severity), one, more));
    let words: Vec<String> =
        words.filter(|(count, ..)| *count > 0).map(|(count, one, more)| number(count, one, more)).collect();
    words.join(", ")
}

/// Returns the text of a repair for buttons; names of scattering functions are the same as in findings.
pub(super) fn repair_words(repair: Repair) -> String {
    use RepairKind::*;
    let kind = match repair.kind {
        TurnUpsideDown => text::TURN,
        MirrorLeftRight => text::MIRROR,
        TurnHalfRound => text::TURN_HALF,
        SwapSides => text::SWAP_SIDES,
        Transpose => text::TRANSPOSE,
        DivideBy100 => text::DIVIDE_100,
        MultiplyBy100 => text::MULTIPLY_100,
        RemoveCosine => text::DIVIDE_COSINE,
        MultiplyCosine => text::MULTIPLY_COSINE,
        RemoveSolidAngle => text::DIVIDE_ANGLE,
        MultiplySolidAngle => text::MULTIPLY_ANGLE,
        DropBlock => text::DROP_BLOCK,
        DeriveByReciprocity => text::DERIVE,
        ClampNegative => text::CLAMP,
    };
    repair.label().replacen(repair.kind.label(), kind.get(), 1)
}

/// Returns the highest severity of the findings; `None` without findings.
pub(super) fn worst(list: &[Diagnosis]) -> Option<Severity> {
    list.iter().map(|one| one.finding.severity).max()
}

/// Draws the findings of the data check on the selected dataset, if it has been checked.
pub fn of_selection(ui: &mut Ui, state: &State, dataset: &Arc<Dataset>) {
    match state.examined.as_ref().filter(|(of, _)| Arc::ptr_eq(of, dataset)) {
        Some((_, found)) => diagnoses(ui, found, &[], |_| {}),
        None => drop(ui.label(text::CHECKING)),
    }
}

/// Draws findings with title and meaning, and a button for every offered repair that is not in `made`, i.e. not yet
/// made; `ask` takes the repair that the user chooses.
pub(super) fn diagnoses(ui: &mut Ui, list: &[Diagnosis], made: &[Repair], mut ask: impl FnMut(Repair)) {
    let palette = theme::palette(ui);
    if list.is_empty() {
        ui.label(text::NOTHING_TO_SAY);
    }
    for severity in [Severity::Error, Severity::Warning, Severity::Info] {
        for Diagnosis { finding, repair, sure } in list.iter().filter(|one| one.finding.severity == severity) {
            let (colour, word) = match severity {
                Severity::Error => (palette.error, text::ERROR),
                Severity::Warning => (palette.warning, text::WARNING),
                Severity::Info => (palette.weak, text::INFO),
            };
            ui.add_space(4.0);
            let words = words(finding.code);
            ui.colored_label(colour, text::titled(word, words.map_or(finding.code, |words| words.title.get())));
            ui.add(egui::Label::new(&finding.message).wrap());
            let meaning = words.map_or("", |words| words.meaning.get());
            if severity != Severity::Info && !meaning.is_empty() {
                ui.add(egui::Label::new(egui::RichText::new(meaning).color(palette.weak)).wrap());
            }
            if let Some(repair) = repair.filter(|repair| !made.contains(repair)) {
                // The same repair may be offered by several findings.
                let button = ui.push_id((finding.code, repair), |ui| ui.button(repair_words(repair))).inner;
                let tip = if *sure { text::SURE } else { text::UNSURE };
                if button.on_hover_text(tip).clicked() {
                    ask(repair);
                }
            }
        }
    }
}

/// Figures of a dataset that the details show, computed once per dataset instead of once per frame.
pub(super) struct Seen {
    /// Luminous transmittance at normal incidence, and under uniform diffuse light.
    pub tau: [f64; 2],
    /// Distribution of the transmitted light over emergent directions with the sun at 45° altitude in the plane normal
    /// to the aperture; `None` if no light is transmitted.
    pub ways: Option<Ways>,
}

/// Returns the figures of a dataset that the details show; `None` for a dataset without transmission of light from
/// outside.
pub(super) fn seen(ui: &Ui, dataset: &Arc<Dataset>) -> Option<Arc<Seen>> {
    type Kept = (Arc<Dataset>, Arc<Seen>);
    let id = egui::Id::unique("import seen");
    let kept: Option<Kept> = ui.data(|data| data.get_temp(id));
    if let Some((_, seen)) = kept.filter(|(of, _)| Arc::ptr_eq(of, dataset)) {
        return Some(seen);
    }
    let btdf = dataset.transmission()?;
    let tau = [btdf.tau_normal(), btdf.tau_hemispherical()];
    let seen = Arc::new(Seen { tau, ways: Ways::from_above(btdf) });
    ui.data_mut(|data| data.insert_temp::<Kept>(id, (dataset.clone(), seen.clone())));
    Some(seen)
}

/// Draws a section through an aperture with the outside and the sun at 45° altitude on the left, and two arrows into
/// the room, upwards and downwards, with lengths proportional to their shares of the transmitted light; below it the
/// figures.
pub(super) fn picture(ui: &mut Ui, &Ways { tau, up, .. }: &Ways) {
    let (response, painter) = ui.allocate_painter(Vec2::new(120.0, 72.0), Sense::hover());
    let palette = theme::palette(ui);
    let line: Color32 = ui.visuals().text_color();
    let middle = response.rect.center();
    painter.line_segment([middle - Vec2::Y * 34.0, middle + Vec2::Y * 34.0], Stroke::new(3.0, palette.weak));
    painter.arrow(middle + Vec2::new(-30.0, -30.0), Vec2::new(27.0, 27.0), Stroke::new(2.0, line));
    for (share, y) in [(up, -1.0), (1.0 - up, 1.0)] {
        let length = 32.0 * share as f32;
        if length > 1.0 {
            painter.arrow(
                middle + Vec2::new(3.0, 0.0),
                Vec2::new(length, y * length),
                Stroke::new(2.0, palette.warning),
            );
        }
    }
    response.on_hover_text(text::PICTURE_TIP);
    let [up, down] = [up, 1.0 - up].map(|share| fixed(100.0 * share, 0));
    ui.add(egui::Label::new(text::sun_at_45(fixed(tau, 2), up, down)).wrap());
}
