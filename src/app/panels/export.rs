//! The side panel of an export: its content, format, preview, and target folder and name.

use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::export::choices::{Choices, MOST_FILES, Preview, ReportKind, What};
use crate::app::shell::jobs::Lane;
use crate::app::shell::typed_path::typed_path;
use crate::app::state::PathUse;
use crate::app::window::App;
use crate::formats::LuminaireFormat;
use crate::report::size::Unit;
use crate::report::tender::spoken;
use crate::report::{Size, TileKind};
use crate::texts::words::MONTHS;
use crate::texts::{Text, export as texts, stages};
use egui::{Button, ComboBox, DragValue, Label, RichText, ScrollArea, TextEdit, TextureOptions, Ui, vec2};

/// Height of the fields for longer texts. \[lines\]
const ROWS: usize = 5;

/// Draws the side panel of an export.
pub fn show(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    let before = app.shell.state.settings.export.clone();
    let mut choices = before.clone();
    let name = ui.label(texts::WHAT);
    let combo = ComboBox::from_id_salt("what").width(ui.available_width().min(240.0));
    let combo = combo.selected_text(choices.what.words()[0].get()).show_ui(ui, |ui| {
        for what in What::ALL {
            let [text, tip] = what.words();
            ui.selectable_value(&mut choices.what, what, text).on_hover_text(tip);
        }
    });
    combo.response.labelled_by(name.id);
    ui.add(Label::new(RichText::new(choices.what.words()[1]).weak()).wrap());
    ui.add_space(4.0);
    options(ui, &mut choices, app.shell.state.document.scene.compare.len());
    ui.add_space(6.0);
    target(ui, app, commands);
    ui.separator();
    preview(ui, app);
    if choices != before {
        commands.push(Command::ExportChoices(Box::new(choices)));
    }
}

/// Draws the choices of content and format, and the options of the chosen format. `candidates`: number of candidates in
/// the comparison.
fn options(ui: &mut Ui, choices: &mut Choices, candidates: usize) {
    match choices.what {
        What::Picture => {
            tiles(ui, choices);
            ui.horizontal_wrapped(|ui| {
                ui.selectable_value(&mut choices.vector, false, ".png").on_hover_text(texts::PIXELS_TIP);
                ui.selectable_value(&mut choices.vector, true, ".svg").on_hover_text(texts::VECTORS_TIP);
            });
            size(ui, &mut choices.size);
            ui.horizontal_wrapped(|ui| {
                ui.checkbox(&mut choices.caption, texts::CAPTION.get()).on_hover_text(texts::CAPTION_TIP);
                print(ui, &mut choices.print);
            });
        }
        What::Report => {
            ui.horizontal_wrapped(|ui| {
                let study = ui.selectable_value(&mut choices.report, ReportKind::Study, texts::STUDY_KIND.get());
                study.on_hover_text(texts::STUDY_TIP);
                let sheet = ui.selectable_value(&mut choices.report, ReportKind::Sheet, texts::PRODUCT_SHEET.get());
                sheet.on_hover_text(texts::SHEET_TIP);
            });
            print(ui, &mut choices.print);
            match choices.report {
                ReportKind::Study => {
                    text(ui, texts::TITLE, &mut choices.title, 1);
                    text(ui, texts::QUESTION, &mut choices.question, 2);
                    ui.add_enabled_ui(candidates > 0, |ui| {
                        let tip = texts::WITH_COMPARISON_TIP;
                        let text = texts::WITH_COMPARISON.get();
                        ui.checkbox(&mut choices.comparison, text).on_hover_text(tip).on_disabled_hover_text(tip);
                    });
                }
                ReportKind::Sheet => {
                    // A shipped template goes with the language.
                    let mut shown = spoken(&choices.tender).to_owned();
                    text(ui, texts::TENDER_TEXT, &mut shown, ROWS);
                    if shown != spoken(&choices.tender) {
                        choices.tender = shown;
                    }
                }
            }
        }
        What::Luminaire => luminaire(ui, choices),
        What::Series => {
            luminaire(ui, choices);
            series(ui, choices);
        }
        What::Table => {
            tiles(ui, choices);
            ui.checkbox(&mut choices.decimal_comma, texts::DECIMAL_COMMA.get()).on_hover_text(texts::DECIMAL_COMMA_TIP);
        }
        What::Dataset => {
            ui.horizontal_wrapped(|ui| {
                ui.selectable_value(&mut choices.text, false, ".xml").on_hover_text(texts::XML_TIP);
                ui.selectable_value(&mut choices.text, true, ".btdf.txt").on_hover_text(texts::TEXT_TIP);
            });
        }
        What::Package | What::Scene => {}
    }
}

fn print(ui: &mut Ui, print: &mut bool) {
    ui.checkbox(print, texts::FOR_PRINTERS.get()).on_hover_text(texts::FOR_PRINTERS_TIP);
}

fn tiles(ui: &mut Ui, choices: &mut Choices) {
    ui.horizontal(|ui| {
        let name = ui.label(texts::TILE);
        let combo = ComboBox::from_id_salt("tile").selected_text(choices.tile.words().get()).show_ui(ui, |ui| {
            for tile in TileKind::ALL {
                ui.selectable_value(&mut choices.tile, tile, tile.words().get());
            }
        });
        combo.response.labelled_by(name.id);
    });
}

fn luminaire(ui: &mut Ui, choices: &mut Choices) {
    ui.horizontal_wrapped(|ui| {
        for format in LuminaireFormat::ALL {
            ui.selectable_value(&mut choices.luminaire, format, format.extension()).on_hover_text(format.name());
        }
    });
    ui.checkbox(&mut choices.tiles, texts::IN_TILES.get()).on_hover_text(texts::IN_TILES_TIP);
    ui.checkbox(&mut choices.without_beam, texts::WITHOUT_BEAM.get()).on_hover_text(texts::WITHOUT_BEAM_TIP);
}

fn size(ui: &mut Ui, size: &mut Size) {
    ui.horizontal_wrapped(|ui| {
        let (unit, range) = match size.unit {
            Unit::Pixels => ("px", 240.0..=8000.0),
            Unit::Millimetres => ("mm", 21.0..=677.0),
        };
        let name = ui.label(texts::WIDTH);
        let drag = |value| DragValue::new(value).range(range.clone()).suffix(format!(" {unit}")).max_decimals(0);
        ui.add(drag(&mut size.width)).labelled_by(name.id);
        let name = ui.label(texts::HEIGHT);
        ui.add(drag(&mut size.height)).labelled_by(name.id);
        let before = size.unit;
        ui.selectable_value(&mut size.unit, Unit::Pixels, "px").on_hover_text(texts::SCREENS_TIP);
        ui.selectable_value(&mut size.unit, Unit::Millimetres, "mm").on_hover_text(texts::PAPER_TIP);
        if before != size.unit {
            // Usual sizes of the other unit, in the same proportion.
            let width = if size.unit == Unit::Pixels { 1600.0 } else { 160.0 };
            (size.width, size.height) = (width, (width * size.height / size.width).round());
        }
    });
}

fn text(ui: &mut Ui, label: Text, text: &mut String, rows: usize) {
    let name = ui.label(label);
    let field = if rows == 1 { TextEdit::singleline(text) } else { TextEdit::multiline(text).desired_rows(rows) };
    if rows < ROWS {
        ui.add(field.desired_width(f32::INFINITY)).labelled_by(name.id);
    } else {
        ScrollArea::vertical().id_salt(label.english()).max_height(110.0).show(ui, |ui| {
            ui.add(field.desired_width(f32::INFINITY)).labelled_by(name.id);
        });
    }
}

/// Draws the options of a series of luminaire files: months and hours (on the 21st of each month), and whether to write
/// all states.
fn series(ui: &mut Ui, choices: &mut Choices) {
    let series = &mut choices.series;
    ui.label(texts::ON_THE_21ST);
    ui.horizontal_wrapped(|ui| {
        for (wanted, name) in series.months.iter_mut().zip(MONTHS) {
            ui.toggle_value(wanted, name.get());
        }
    });
    ui.horizontal_wrapped(|ui| {
        let [first, last] = &mut series.hours;
        let name = ui.label(texts::FROM);
        ui.add(DragValue::new(first).range(0..=23).suffix(" h")).labelled_by(name.id);
        let name = ui.label(texts::TO);
        ui.add(DragValue::new(last).range(0..=23).suffix(" h")).labelled_by(name.id);
        let name = ui.label(texts::EVERY);
        ui.add(DragValue::new(&mut series.step).range(1..=12).suffix(" h")).labelled_by(name.id);
    });
    ui.checkbox(&mut series.all_states, texts::ALL_STATES.get()).on_hover_text(texts::all_states_tip(MOST_FILES));
}

/// Draws the fields of folder and file name, and the buttons that write or copy.
fn target(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    let state = &app.shell.state;
    let mut text = state.path.clone();
    let name = ui.label(texts::WRITE_TO);
    // On as many lines as the name needs: its end, which says what it is, stays visible.
    let field = TextEdit::multiline(&mut text)
        .id(egui::Id::unique("export path"))
        .desired_rows(1)
        .return_key(None::<egui::KeyboardShortcut>)
        .desired_width(f32::INFINITY);
    let field = ui.add(field).labelled_by(name.id);
    super::fields::take_keyboard(&field, state, commands);
    if text != state.path {
        commands.push(Command::EditPath(text.clone()));
    }
    let path = typed_path(&text);
    let ready = !text.trim().is_empty();
    if state.replace.as_ref() == Some(&path) {
        let words = if state.settings.export.what == What::Series { texts::THESE_EXIST } else { texts::THIS_EXISTS };
        ui.colored_label(theme::palette(ui).warning, words.get());
        ui.horizontal(|ui| {
            if ui.button(texts::REPLACE).on_hover_text(texts::REPLACE_TIP).clicked() {
                commands.push(Command::Write(PathUse::Export, path.clone()));
            }
            if ui.button(texts::CHANGE_NAME).on_hover_text(texts::CHANGE_NAME_TIP).clicked() {
                commands.push(Command::KeepFile);
                field.request_focus();
            }
        });
        return;
    }
    if let Some(job) = app.shell.jobs.state(Lane::Export).filter(|_| app.export.is_writing()) {
        ui.horizontal(|ui| {
            if ui.button(texts::STOP).on_hover_text(texts::STOP_TIP).clicked() {
                commands.push(Command::Cancel(Lane::Export));
            }
            let share = job.fraction().unwrap_or(0.0);
            let stage = stages::word(job.stage());
            let words = job.left().map(|left| texts::stage_left(stage, left.as_secs().max(1)));
            let words = words.unwrap_or_else(|| stage.to_owned());
            ui.add(egui::ProgressBar::new(share).desired_width(240.0).text(words));
        });
        return;
    }
    ui.horizontal(|ui| {
        let entered = field.has_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        let write = ui.add_enabled(ready, Button::new(texts::WRITE.get())).on_hover_text(texts::WRITE_TIP);
        if ready && (write.clicked() || entered) {
            commands.push(Command::WriteNew(PathUse::Export, path));
        }
        if ui.button(texts::BROWSE).on_hover_text(texts::BROWSE_TIP).clicked() {
            commands.push(Command::BrowseExport);
        }
    });
}

/// Returns a file size, given in bytes, as text with a suitable unit.
fn bytes(count: usize) -> String {
    match count {
        0..10_000 => texts::bytes(count),
        10_000..10_000_000 => format!("{} kB", count / 1000),
        _ => format!("{} MB", count / 1_000_000),
    }
}

/// Draws the preview of the export: picture, beginning of the text, or list of files.
fn preview(ui: &mut Ui, app: &App) {
    let export = &app.export;
    let busy = app.shell.jobs.busy(Lane::Preview);
    ui.horizontal(|ui| {
        ui.strong(texts::PREVIEW.get());
        if busy {
            ui.spinner();
        }
    });
    match export.preview() {
        None if busy => {}
        None => {
            ui.weak(texts::NOT_YET.get());
        }
        Some(Err(error)) => {
            ui.add(Label::new(RichText::new(error).color(theme::palette(ui).error)).wrap());
        }
        Some(Ok(Preview::Picture([width, height], pixels, note))) => {
            ui.weak(note);
            let id = ui.scope_id().with("picture");
            let known: Option<(u64, egui::TextureHandle)> = ui.data(|data| data.get_temp(id));
            let texture = match known.filter(|(revision, _)| *revision == export.revision()) {
                Some((_, texture)) => texture,
                None => {
                    let image = egui::ColorImage::from_rgb([*width, *height], pixels);
                    let texture = ui.ctx().load_texture("preview", image, TextureOptions::LINEAR);
                    ui.data_mut(|data| data.insert_temp(id, (export.revision(), texture.clone())));
                    texture
                }
            };
            let wide = ui.available_width().min(*width as f32);
            let size = vec2(wide, wide * *height as f32 / (*width).max(1) as f32);
            let image = egui::Image::new((texture.id(), size)).alt_text(texts::PREVIEW_ALT.get());
            let response = ui.add(image);
            ui.painter().rect_stroke(
                response.rect,
                0,
                egui::Stroke::new(1.0, theme::palette(ui).line),
                egui::StrokeKind::Inside,
            );
        }
        Some(Ok(Preview::Text(text, length))) => {
            ui.weak(bytes(*length));
            let shown = RichText::new(text).monospace().size(13.0);
            ui.add(Label::new(shown).wrap());
        }
        Some(Ok(Preview::Files(files))) => {
            let count = files.len();
            ui.weak(if count == 1 { texts::ONE_FILE.into() } else { texts::files_are(count) });
            for (name, words) in files {
                ui.add(Label::new(name).wrap());
                ui.add(Label::new(RichText::new(words).weak()).wrap());
            }
        }
    }
}
