//! Error of the results of the current scene against computing time: starts the refinement series on demand, and shows
//! its plot and how reliable the stated errors are.

use super::Cache;
use crate::app::paint::palette::Palette;
use crate::app::paint::plot::{self, Look};
use crate::app::paint::tile;
use crate::drawing::plot::Plot;
use crate::study::OutsideSeen;
use crate::study::accuracy::{Accuracy, words};
use crate::study::accuracy_plot::{name, plots};
use crate::texts::{Language, fixed, language, tiles as say};
use egui::{Button, Label, ProgressBar, Sense, Ui, vec2};

/// State of this view between frames.
#[derive(Debug, Clone, Default)]
pub struct State {
    plots: Cache<(u64, Language), [Plot; 2]>,
}

/// Input of the view.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Result of the last refinement series.
    pub accuracy: Option<&'a Accuracy>,
    /// Number of refinement series run so far.
    pub revision: u64,
    /// Whether the scene has changed since that refinement series.
    pub stale: bool,
    /// Error that prevented a result, as text.
    pub error: Option<&'a str>,
    /// Progress of a running refinement series, 0 … 1; `None` if none is running.
    pub running: Option<f32>,
    /// Summaries of the outside as seen from the apertures, in the room results shown.
    pub outside: &'a [OutsideSeen],
}

/// Action of the user.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Request to run the refinement series on the current scene.
    Run,
    /// Request to stop the refinement series.
    Cancel,
}

/// Draws the view over the available width, with its two plots one above the other. Returns the requests of the user.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = Vec::new();
    ui.horizontal(|ui| {
        if let Some(fraction) = input.running {
            let stop = ui.button(say::STOP).on_hover_text(say::STOP_TIP);
            if stop.clicked() {
                actions.push(Action::Cancel);
            }
            ui.add(ProgressBar::new(fraction).desired_width(150.0).show_percentage());
        } else {
            let run = ui.add(Button::new(say::MEASURE)).on_hover_text(say::MEASURE_TIP);
            if run.clicked() {
                actions.push(Action::Run);
            }
            if input.accuracy.is_some() && input.stale {
                ui.weak(say::EARLIER_SCENE.get());
            }
        }
    });
    if !input.outside.is_empty() {
        ui.strong(say::SPLIT_OUTSIDE);
        for words in input.outside.iter().flat_map(OutsideSeen::sentences) {
            ui.add(Label::new(words).wrap());
        }
    }
    if let Some(error) = input.error {
        ui.add(Label::new(error).wrap());
    }
    let Some(accuracy) = input.accuracy else {
        if input.error.is_none() {
            ui.add(Label::new(say::ACCURACY_EMPTY).wrap());
        }
        return actions;
    };
    let width = ui.available_width().min(900.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, 1.5 * width), Sense::hover());
    let sentence = sentence(accuracy);
    tile::name(ui, &response, say::ACCURACY_PLOTS, &sentence);
    let palette = Palette::of(ui.visuals());
    let id = ui.scope_id();
    // Zooming in one leaves the other, of other errors, alone; the series are the same.
    let first = Look { left: 60.0, on_page: true, ..Look::tile(id.with("front"), &palette.series, palette.weak) };
    let second = Look { id: id.with("honesty"), legend_of: Some(first.id), ..first };
    let tips = [say::ACCURACY_FRONT_TIP, say::ACCURACY_HONESTY_TIP];
    // Half of "100 %" stands beyond the last tick.
    let (above, below) = rect.with_max_x(rect.right() - 8.0).split_top_bottom_at_fraction(0.53);
    for (((place, plot), look), tip) in [above, below]
        .into_iter()
        .zip(state.plots.get((input.revision, language()), || plots(accuracy)))
        .zip([first, second])
        .zip(tips)
    {
        let shown = plot::show(ui, place, plot, &look, |_| {});
        tile::name(ui, &shown.response, say::against(&plot.y.name, &plot.x.name), tip.get());
    }
    ui.add(Label::new(sentence).wrap());
    for one in &accuracy.leaving_out {
        ui.add(Label::new(one.sentences()).wrap());
    }
    actions
}

/// Returns a summary of the results of a refinement series in sentences.
pub fn sentence(accuracy: &Accuracy) -> String {
    let coverage = accuracy.ordinary_coverage();
    let mut sentences =
        vec![say::accuracy_kept(fixed(100.0 * coverage.kept, 1), coverage.count, fixed(100.0 * coverage.padded, 1))];
    sentences.extend(accuracy.references.iter().map(words::reference));
    for series in accuracy.series.iter().filter(|series| series.is_ordinary()) {
        let unreported = series.rungs.iter().filter(|rung| !rung.is_determined()).count();
        if unreported > 0 {
            sentences.push(say::accuracy_left_out(unreported, series.rungs.len(), name(series)));
        }
        if let Some(limit) = words::data_limit(series) {
            sentences.push(format!("{}: {limit}.", name(series)));
        }
    }
    sentences.join(" ")
}
