//! The status line: running jobs, statistical error of the results shown, findings on the dataset.

use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::shell::jobs::Lane;
use crate::app::state::{CatalogueState, Sheet};
use crate::app::views::room::error_words;
use crate::app::window::App;
use crate::compute::btdf::Severity;
use crate::texts::{Text, fixed, shell, stages};
use egui::{Color32, FontId, ProgressBar, RichText, Ui};

/// Returns a duration, given in seconds, as text in ms or s.
fn duration(seconds: f64) -> String {
    if seconds < 1.0 { format!("{} ms", fixed(1000.0 * seconds, 1)) } else { format!("{} s", fixed(seconds, 1)) }
}

/// Returns a relative error \[%\] as text; below 0.005 % as "< 0.01 %", since two decimals cannot show it.
fn percent(error: f64) -> String {
    if error < 0.005 { format!("< {} %", fixed(0.01, 2)) } else { format!("±{} %", fixed(error, 2)) }
}

/// Text about the error of a result, in a longer and a shorter wording, with tooltip.
struct Figure {
    words: [String; 2],
    tip: Text,
}

/// Returns the note on an outdated result, which says whether a newer one is being computed in its lane; empty for a
/// current result.
fn age<T>(app: &App, shown: &crate::app::state::Shown<T>, lane: Lane) -> &'static str {
    match (shown.stale, app.shell.jobs.busy(lane)) {
        (false, _) => "",
        (true, true) => shell::UPDATING.get(),
        (true, false) => shell::EARLIER_SCENE.get(),
    }
}

/// Returns texts on the errors of the room's illuminances and of the LID, if a visible tile shows these results.
fn figures(app: &App) -> Vec<Figure> {
    let mut list = Vec::new();
    let is_visible = |lane| app.shell.bench.shows(lane, app.shell.state.maximised);
    if let Some(room) = app.shell.results.room.value.as_ref().filter(|_| is_visible(Lane::Room)) {
        let age = age(app, &app.shell.results.room, Lane::Room);
        let error = error_words(room.totals());
        list.push(Figure {
            words: [
                shell::room_line(&error, format!(", {}{age}", duration(room.seconds))),
                shell::room_line(&error, age),
            ],
            tip: shell::ROOM_LINE_TIP,
        });
    }
    if let Some(lid) = app.shell.results.lid.value.as_ref().filter(|_| is_visible(Lane::Lid)) {
        let relative = if lid.flux.value > 0.0 { 100.0 * lid.flux.error / lid.flux.value } else { 0.0 };
        let age = age(app, &app.shell.results.lid, Lane::Lid);
        let error = percent(relative);
        list.push(Figure {
            words: [shell::lid_line(&error, format!(", {}{age}", duration(lid.seconds))), shell::lid_line(&error, age)],
            tip: shell::LID_LINE_TIP,
        });
    }
    list
}

/// Returns a summary of the data check of the dataset shown, its colour, and whether there are findings. The check is
/// that of the import, since it takes too long to be repeated in every frame.
fn checks(app: &App, palette: &theme::Palette) -> (String, Color32, bool) {
    // While data of another product or state are still to come, those that are shown are the last ones'.
    let awaited = app.shell.state.computing.is_some() || app.shell.state.dataset.error.is_some();
    let Some(dataset) = app.shell.state.dataset.value.as_ref().filter(|_| !awaited) else {
        let words = match (&app.shell.state.catalogue, app.busy()) {
            (CatalogueState::Opening, _) => shell::OPENING_CATALOGUE,
            (_, true) => shell::NO_DATASET_YET,
            (_, false) => shell::NO_DATASET,
        };
        return (words.into(), palette.weak, false);
    };
    let product = app.shell.state.product.as_ref().map_or(&[][..], |product| &product.findings);
    let findings = product.iter().filter(|finding| finding.state == dataset.state);
    let count = |severity| findings.clone().filter(|finding| finding.severity == severity).count();
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    match (errors, warnings) {
        (0, 0) => (shell::NO_WARNINGS.into(), palette.weak, true),
        (0, 1) => (shell::ONE_WARNING.into(), palette.warning, true),
        (0, n) => (shell::warnings(n), palette.warning, true),
        (1, _) => (shell::ONE_ERROR.into(), palette.error, true),
        (n, _) => (shell::errors(n), palette.error, true),
    }
}

/// Returns the width of a text in the status line. \[points\]
fn width(ui: &Ui, text: &str) -> f32 {
    let font = egui::TextStyle::Body.resolve(ui.style());
    ui.painter().layout_no_wrap(text.to_owned(), FontId { size: font.size, ..font }, Color32::PLACEHOLDER).size().x
}

/// Width of a separator in the status line. \[points\]
const GAP: f32 = 20.0;
/// Common width of a job's progress bar and its stop button. \[points\]
const BAR: f32 = 78.0;
const STOP: f32 = 30.0;

/// Draws the status line as far as its parts fit: first the texts on errors, then the jobs, then the number of further
/// jobs.
pub fn show(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        let (text, colour, known) = checks(app, palette);
        let words = RichText::new(text).color(colour);
        if !known {
            ui.label(words);
        } else if ui.button(words).on_hover_text(shell::CHECKS_TIP).clicked() {
            commands.push(Command::Sheet(Some(Sheet::Findings)));
        }
        if !app.shell.toasts.is_empty() {
            let text = match app.shell.toasts.len() {
                1 => shell::ONE_MESSAGE.into(),
                count => shell::messages(count),
            };
            if ui.button(text).on_hover_text(shell::MESSAGES_TIP).clicked() {
                commands.push(Command::Sheet(Some(Sheet::Messages)));
            }
        }
        ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| rest(ui, app, commands));
    });
    if app.busy() {
        // Progress bars move on. Not more often: without a graphics card every frame is taken from the work.
        ui.ctx().request_repaint_after(std::time::Duration::from_millis(250));
    }
}

/// Draws the texts on errors of results and the running jobs, each job with progress and stop button, in the remaining
/// width.
fn rest(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    let mut left = ui.available_width() - GAP;
    let figures = figures(app);
    let all = |k: usize| figures.iter().map(|figure| width(ui, &figure.words[k]) + GAP).sum::<f32>();
    let mut jobs = app.shell.jobs.views();
    // The job that the others wait for is shown first.
    jobs.sort_by_key(|job| job.lane != Lane::Product);
    // Durations are left out first, where something else wants the room.
    let short = usize::from(all(0) + if jobs.is_empty() { 0.0 } else { 200.0 } > left);
    let mut first = true;
    for figure in &figures {
        let text = &figure.words[short];
        let wide = width(ui, text) + GAP;
        if wide > left {
            break;
        }
        left -= wide;
        if !std::mem::take(&mut first) {
            ui.separator();
        }
        ui.label(text).on_hover_text(format!("{}: {}", figure.words[0], figure.tip));
    }
    let count = jobs.len();
    for (number, job) in jobs.into_iter().enumerate() {
        let (stage, word) = (stages::word(job.state.stage()), job.lane.word());
        let fraction = job.state.fraction();
        let more = count - number;
        let more = match (more, number) {
            (1, 0) => shell::ONE_JOB.into(),
            (more, 0) => shell::jobs(more),
            (1, _) => shell::ONE_JOB_MORE.into(),
            (more, _) => shell::jobs_more(more),
        };
        let bar = if fraction.is_some() { BAR } else { 0.0 } + STOP + GAP;
        // Room is kept for the count of those that have none.
        let kept = if number + 1 < count { width(ui, &shell::jobs_more(9)) + GAP } else { 0.0 };
        let dots = if fraction.is_some() { "" } else { "…" };
        let texts = [format!("{word}: {stage}{dots}"), format!("{word}{dots}")];
        let fitting = texts.iter().skip(usize::from(stage.is_empty()));
        let fitting = fitting.into_iter().find(|text| width(ui, text) + bar + kept <= left);
        if !first && (fitting.is_some() || width(ui, &more) + GAP <= left) {
            ui.separator();
        }
        first = false;
        let Some(text) = fitting else {
            if width(ui, &more) + GAP <= left {
                ui.label(more);
            }
            return;
        };
        left -= width(ui, text) + bar;
        ui.label(text);
        if let Some(fraction) = fraction {
            ui.add(ProgressBar::new(fraction).desired_width(70.0).desired_height(10.0));
        }
        // Known by its lane: what stands before it comes and goes while a finger is on it.
        let stop = ui.push_id(("stop", job.lane), |ui| {
            ui.small_button("×").accessible_name(shell::cancel(word)).on_hover_text(shell::cancel(word))
        });
        if stop.inner.clicked() {
            commands.push(Command::Cancel(job.lane));
        }
    }
}
