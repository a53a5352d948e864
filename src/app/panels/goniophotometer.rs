//! The side panel of the virtual goniophotometer: the description of the system as text and drawing, the settings of
//! the simulated measurement, its result.

use crate::app::command::{Command, SYSTEM_EDITOR};
use crate::app::display::theme;
use crate::app::goniophotometer::Goniophotometer;
use crate::app::goniophotometer::examples::EXAMPLES;
use crate::app::goniophotometer::run::{Emergence, Incidence, Run};
use crate::app::offer;
use crate::app::scene::facing::sun_incident;
use crate::app::shell::jobs::Lane;
use crate::app::shell::typing::read_number;
use crate::app::state::State;
use crate::app::views::section;
use crate::study::control::slat_angle;
use crate::texts::{decimal, fixed, goniophotometer as texts};
use egui::{Button, ComboBox, DragValue, Id, Label, ProgressBar, ScrollArea, Slider, TextEdit, TextStyle, Ui, vec2};

/// Minimum height of text editor and drawing. \[points\]
const LEAST_HEIGHT: f32 = 220.0;
/// Height of the parts of the panel above and below text editor and drawing. \[points\]
const REST: f32 = 250.0;

/// Draws the side panel of the virtual goniophotometer. `running`: progress of the current state, 0 … 1; `None` if
/// nothing is running.
pub(super) fn show(
    ui: &mut Ui,
    bench: &Goniophotometer,
    state: &State,
    view: &mut section::State,
    running: Option<f32>,
    commands: &mut Vec<Command>,
) {
    examples(ui, commands);
    let height = (ui.ctx().content_rect().height() - REST - 150.0).max(LEAST_HEIGHT);
    ui.columns(2, |columns| {
        editor(&mut columns[0], bench, height, commands);
        drawing(&mut columns[1], (bench, state), view, height, commands);
    });
    ui.separator();
    setup(ui, bench, running.is_some(), commands);
    measure(ui, bench, running, commands);
    if let Some(error) = bench.failure() {
        ui.add(Label::new(egui::RichText::new(error).color(theme::palette(ui).error)).wrap());
    }
    match bench.run() {
        Some(run) => results(ui, bench, run, commands),
        None => {
            ui.weak(texts::OFFER);
        }
    }
}

/// Draws the button that opens a system file, and the buttons that start from an example.
fn examples(ui: &mut Ui, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        let open = ui.button(texts::OPEN).on_hover_text(texts::OPEN_TIP);
        if open.clicked() {
            commands.push(Command::Open);
        }
        ui.weak(texts::OR_START_FROM);
        for (number, example) in EXAMPLES.iter().enumerate() {
            if ui.button(example.name).clicked() {
                commands.push(Command::SystemExample(number));
            }
        }
    });
}

/// Draws the text editor for the description of the system, of a height \[points\], and under it the error of the text
/// or a summary of the system.
fn editor(ui: &mut Ui, bench: &Goniophotometer, height: f32, commands: &mut Vec<Command>) {
    let name = ui.label(texts::GEOMETRY);
    let mut text = bench.text().to_owned();
    ScrollArea::both().id_salt("editor").max_height(height).min_scrolled_height(height).show(ui, |ui| {
        let rows = (height / ui.text_style_height(&TextStyle::Monospace)) as usize;
        let field = TextEdit::multiline(&mut text)
            .id(Id::unique(SYSTEM_EDITOR))
            .font(TextStyle::Monospace)
            .hint_text("name = \"…\"\nkind = \"venetian\"\n…")
            .desired_rows(rows.saturating_sub(1).max(4))
            .desired_width(f32::INFINITY);
        ui.add(field).labelled_by(name.id);
    });
    if text != bench.text() {
        commands.push(Command::EditSystem(text));
    }
    let palette = theme::palette(ui);
    match bench.described() {
        Some(Err(error)) => {
            ui.add(Label::new(egui::RichText::new(error.to_string()).color(palette.error)).wrap());
        }
        Some(Ok(described)) => {
            let system = &described.file.system;
            let states = match system.states().len() {
                1 => String::new(),
                many => texts::and_states(many),
            };
            ui.colored_label(palette.good, format!("{} ({}){states}", system.name, system.family().word()));
        }
        None => {
            ui.weak(texts::UNITS);
        }
    }
}

/// Draws the section through the described system, of a height \[points\], and the choice of the state drawn.
fn drawing(
    ui: &mut Ui,
    (bench, state): (&Goniophotometer, &State),
    view: &mut section::State,
    height: f32,
    commands: &mut Vec<Command>,
) {
    let system = bench.valid().map(|described| &described.file.system);
    let states = bench.states();
    let label =
        ui.label(if system.is_some_and(|system| system.upright) { texts::SECTION_ABOVE } else { texts::SECTION });
    let sun = sun_incident(&state.document.scene, &state.base());
    let upright = system.is_some_and(|system| system.upright);
    let input = section::Input {
        system,
        revision: bench.revision(),
        state: bench.drawn(),
        sun: sun.map(|sun| slat_angle(sun.0, upright)),
    };
    let size = vec2(ui.available_width(), height);
    section::show(ui, &input, size, view);
    if let Some(state) = states.get(bench.drawn()).filter(|_| states.len() > 1) {
        ui.horizontal(|ui| {
            let mut drawn = bench.drawn();
            let back = ui.add_enabled(drawn > 0, Button::new("◀")).accessible_name(texts::PREVIOUS_STATE);
            if back.on_hover_text(texts::PREVIOUS_STATE).clicked() {
                drawn -= 1;
            }
            let slider = Slider::new(&mut drawn, 0..=states.len() - 1).show_value(false);
            ui.add(slider).labelled_by(label.id);
            let forth = ui.add_enabled(drawn + 1 < states.len(), Button::new("▶")).accessible_name(texts::NEXT_STATE);
            if forth.on_hover_text(texts::NEXT_STATE).clicked() {
                drawn += 1;
            }
            ui.label(format!("{state}°"));
            if drawn != bench.drawn() {
                commands.push(Command::DrawState(drawn));
            }
        });
    }
}

/// Draws the settings of the measurement (incident directions, emergent cells, maximum error); they cannot be changed
/// while it is running.
fn setup(ui: &mut Ui, bench: &Goniophotometer, running: bool, commands: &mut Vec<Command>) {
    let mut setup = bench.setup();
    ui.horizontal_wrapped(|ui| {
        ui.add_enabled_ui(!running, |ui| {
            let label = ui.label(texts::INCIDENT);
            let combo = ComboBox::from_id_salt("incident cells").selected_text(setup.incidence.word());
            let combo = combo.show_ui(ui, |ui| {
                for one in Incidence::ALL {
                    ui.selectable_value(&mut setup.incidence, one, one.word());
                }
            });
            combo.response.labelled_by(label.id);
        });
        ui.add_enabled_ui(!running, |ui| {
            let label = ui.label(texts::EMERGENT);
            let combo = ComboBox::from_id_salt("emergent cells").selected_text(setup.emergence.word());
            let combo = combo.show_ui(ui, |ui| {
                for one in Emergence::ALL {
                    ui.selectable_value(&mut setup.emergence, one, one.word());
                }
            });
            combo.response.labelled_by(label.id);
        });
        ui.add_enabled_ui(!running, |ui| {
            let label = ui.label(texts::ERROR_AT_MOST);
            let field = DragValue::new(&mut setup.error).range(1e-5..=0.1).speed(1e-4).max_decimals(5);
            let field = field.custom_parser(|text| read_number(text, ""));
            ui.add(field).labelled_by(label.id).on_hover_text(texts::ERROR_TIP);
        });
    });
    if setup != bench.setup() {
        commands.push(Command::SystemSetup(setup));
    }
}

/// Draws the button that starts or stops the measurement. `running`: progress of the current state, 0 … 1; `None` if no
/// measurement is running.
fn measure(ui: &mut Ui, bench: &Goniophotometer, running: Option<f32>, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        if let Some(fraction) = running {
            if ui.button(texts::STOP).on_hover_text(texts::STOP_TIP).clicked() {
                commands.push(Command::Cancel(Lane::Goniophotometer));
            }
            let finished = bench.run().map_or(0, |run| run.finished.len());
            let states = bench.run().and_then(|run| run.states.as_ref()).map_or(0, Vec::len);
            let text = if states > 1 { texts::state_of(finished + 1, states) } else { String::new() };
            let share = if states > 0 { (finished as f32 + fraction) / states as f32 } else { fraction };
            ui.add(ProgressBar::new(share).desired_width(200.0).show_percentage());
            ui.label(text);
            return;
        }
        let compute = Command::MeasureSystem;
        let keys = offer::of(&compute).and_then(|offer| offer.keys);
        let keys = keys.as_ref().map(offer::key_words).unwrap_or_default();
        let button = ui.add_enabled(bench.valid().is_some(), Button::new(texts::COMPUTE).shortcut_text(keys));
        let button = button.on_disabled_hover_text(texts::DESCRIBE_FIRST);
        if button.on_hover_text(texts::COMPUTE_TIP).clicked() {
            commands.push(compute);
        }
        if let Some(run) = bench.run().filter(|run| bench.is_current(run) && !run.complete()) {
            ui.weak(texts::stopped_after(run.finished.len()));
        }
    });
}

/// Draws a table of the measured states (transmittance, quality figures, computing time), and the buttons that add them
/// to the catalogue or export them.
fn results(ui: &mut Ui, bench: &Goniophotometer, run: &Run, commands: &mut Vec<Command>) {
    if run.finished.is_empty() {
        return;
    }
    if !bench.is_current(run) {
        let name = &run.described.file.system.name;
        ui.weak(texts::changed_since(name));
    }
    ui.horizontal(|ui| {
        let add = ui.add_enabled(run.complete(), Button::new(texts::ADD));
        let add = add.on_disabled_hover_text(texts::WHEN_FINISHED);
        if add.on_hover_text(texts::ADD_TIP).clicked() {
            commands.push(Command::AddMeasured);
        }
        let export = ui.add_enabled(run.complete(), Button::new(texts::EXPORT));
        if export.on_hover_text(offer::of(&Command::ExportMeasured).map_or("", |offer| offer.tip)).clicked() {
            commands.push(Command::ExportMeasured);
        }
    });
    egui::Grid::new("measured").num_columns(6).striped(true).show(ui, |ui| {
        for (head, tip) in [
            (texts::STATE, texts::STATE_TIP),
            (texts::TAU_NORMAL, texts::TAU_NORMAL_TIP),
            (texts::BALANCE, texts::BALANCE_TIP),
            (texts::RECIPROCITY, texts::RECIPROCITY_TIP),
            (texts::ERROR, texts::ERRORS_TIP),
            (texts::TIME, texts::TIME_TIP),
        ] {
            ui.strong(head).on_hover_text(tip);
        }
        ui.end_row();
        for one in &run.finished {
            let state = &one.dataset.state;
            ui.label(if state.is_empty() { "–" } else { state });
            ui.label(fixed(one.tau_normal, 4));
            match one.quality {
                Some(quality) => {
                    ui.label(decimal(format!("{:.1e}", quality.balance)));
                    ui.label(
                        quality.reciprocity.map_or_else(|| "–".to_owned(), |e| format!("{} %", fixed(100.0 * e, 3))),
                    );
                    ui.label(decimal(format!("{:.1e}", quality.error)));
                }
                None => (0..3).for_each(|_| drop(ui.label("–"))),
            }
            ui.label(format!("{} s", fixed(one.seconds, 2)));
            ui.end_row();
        }
    });
}
