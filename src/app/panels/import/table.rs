//! The table of an import: a line for each product, its states under it, and every open question at the product it
//! concerns.

use super::findings::{counts, worst};
use crate::app::command::Command;
use crate::app::display::theme::{self, Palette};
use crate::app::import::proposal::{Import, Proposed, Row, StateWords, number};
use crate::app::import::step::{Choose, Step};
use crate::catalogue::Ambiguity;
use crate::compute::btdf::Severity;
use crate::texts::{Text, fixed, import as text};
use egui::{Align, FontId, Layout, Rect, Response, RichText, Sense, TextEdit, Ui, UiBuilder, pos2, vec2};

/// Height of a line of the table. \[points\]
const LINE: f32 = 28.0;
/// Widths of the columns after the file name: angle, name of the state, transmittance τ, findings. \[points\]
const COLUMNS: [f32; 4] = [64.0, 120.0, 52.0, 130.0];

/// Draws the table of products and states of an import.
pub(super) fn show(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 20.0), Sense::hover());
    let palette = theme::palette(ui);
    let cells = cells(rect);
    for (cell, word) in
        cells.iter().zip([text::FILE.get(), text::ANGLE_DEGREES.get(), text::STATE.get(), "τ", text::FINDINGS.get()])
    {
        let look = FontId::proportional(13.0);
        let word = theme::one_line(ui.painter(), word, look, palette.weak, cell.width());
        ui.painter().galley(pos2(cell.left(), cell.top()), word, palette.weak);
    }
    for (place, product) in import.products.iter().enumerate() {
        ui.push_id(place, |ui| one(ui, import, place, product, commands));
    }
    for (title, list) in [(text::NOT_READ, &import.failures), (text::LEFT_OUT, &import.left_out)] {
        if list.is_empty() {
            continue;
        }
        ui.add_space(8.0);
        ui.strong(text::about(title, number(list.len(), text::ONE_FILE, text::files)));
        for line in list {
            ui.add(egui::Label::new(line).wrap());
        }
    }
}

/// Returns the rectangles of a line's cells: the file name, then those of [`COLUMNS`].
fn cells(line: Rect) -> [Rect; 5] {
    let mut right = line.right();
    let mut cells = [line; 5];
    for (place, width) in COLUMNS.iter().enumerate().rev() {
        cells[place + 1] = Rect::from_min_max(pos2(right - width, line.top()), pos2(right - 6.0, line.bottom()));
        right -= width;
    }
    cells[0] = Rect::from_min_max(line.min, pos2(right - 6.0, line.bottom()));
    cells
}

/// Draws the lines of a product (index `number` of the import): its title, its question, a note on equal data, its
/// problem, and its states.
fn one(ui: &mut Ui, import: &Import, number: usize, product: &Proposed, commands: &mut Vec<Command>) {
    head(ui, import, number, product, commands);
    if let Some(ambiguity) = product.ambiguity.as_ref().filter(|_| product.wanted()) {
        question(ui, import, number, ambiguity, commands);
    }
    there_already(ui, number, product, commands);
    if product.wanted()
        && let Some(problem) = product.problem()
    {
        let palette = theme::palette(ui);
        indented(ui, |ui| {
            ui.add(egui::Label::new(RichText::new(problem).color(palette.error)).truncate());
        });
    }
    if !import.folded.contains(&number) {
        for state in 0..product.datasets.len() {
            ui.push_id(state, |ui| state_line(ui, import, (number, state), product, commands));
        }
    }
}

/// Draws a line of the table that is indented to start under its product's name.
fn indented(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), LINE), Sense::hover());
    if ui.is_rect_visible(rect) {
        let inner = Rect::from_min_max(pos2(rect.left() + 24.0, rect.top()), rect.max);
        let layout = Layout::left_to_right(Align::Center);
        add(&mut ui.new_child(UiBuilder::new().max_rect(inner).layout(layout)));
    }
}

/// Returns the key of a state as text, with "°" if it is an angle.
fn words_of(words: &StateWords) -> String {
    match (words.number(), words.name.trim()) {
        (Some(_), "") => format!("{}°", words.key()),
        (Some(_), name) => format!("{name} {}°", words.key()),
        (None, name) => name.to_owned(),
    }
}

/// Returns a product as one line of text: its name and its states.
fn title(product: &Proposed) -> String {
    let name = if product.named() { product.fields.name.trim() } else { text::NO_NAME.get() };
    let states: Vec<String> = product.states.iter().map(words_of).collect();
    match states.as_slice() {
        [one] if one.is_empty() => name.to_owned(),
        _ => format!("{name}: {}", states.join(", ")),
    }
}

/// Returns the kind of selection that a click on a row means: up to this row with Shift held, this row in addition with
/// Ctrl held or by Space, otherwise this row alone.
fn meant(ui: &Ui, response: &Response) -> Choose {
    let modifiers = ui.input(|input| input.modifiers);
    if modifiers.shift {
        Choose::UpTo
    } else if modifiers.command || !response.clicked_by(egui::PointerButton::Primary) {
        Choose::Also
    } else {
        Choose::Only
    }
}

/// Draws a line that can be selected, with its shown text and its accessible label. `left`: horizontal screen position
/// of the text \[points\].
fn option(ui: &Ui, rect: Rect, chosen: bool, words: (&str, &str), palette: &Palette, left: f32) -> Response {
    let (shown, label) = words;
    let response = ui.interact(rect, ui.scope_id().with("row"), Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(egui::accesskit::Role::ListBoxOption, true, chosen, label));
    let fill = palette.behind(chosen, &response);
    ui.painter().rect_filled(rect.shrink2(vec2(0.0, 1.0)), 3, fill);
    let width = rect.right() - left - 4.0;
    let text = theme::one_line(ui.painter(), shown, FontId::proportional(13.5), palette.text, width);
    let cut = text.size().x > width - 2.0;
    ui.painter().galley(pos2(left, rect.center().y - 0.5 * text.size().y), text, palette.text);
    if cut { response.on_hover_text(shown) } else { response }
}

/// Draws the first line of a product (index `number`): its name and the names of its states, with an arrow that folds
/// them.
fn head(ui: &mut Ui, import: &Import, number: usize, product: &Proposed, commands: &mut Vec<Command>) {
    let (line, _) = ui.allocate_exact_size(vec2(ui.available_width(), LINE), Sense::hover());
    if !ui.is_rect_visible(line) {
        return;
    }
    let palette = theme::palette(ui);
    let arrow = Rect::from_min_size(line.min, vec2(22.0, LINE));
    let folded = import.folded.contains(&number);
    let fold = ui.interact(arrow, ui.scope_id().with("fold"), Sense::click());
    let label = if folded { text::show_states(&product.fields.name) } else { text::fold_states(&product.fields.name) };
    fold.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &label));
    let glyph = if folded { "⏵" } else { "⏷" };
    let colour = if fold.hovered() || fold.has_focus() { palette.text } else { palette.weak };
    ui.painter().text(arrow.center(), egui::Align2::CENTER_CENTER, glyph, FontId::proportional(13.0), colour);
    if fold.clicked() {
        commands.push(Command::Import(Step::Fold(number)));
    }
    let rest = Rect::from_min_max(pos2(arrow.right(), line.top()), line.max);
    let chosen = (0..product.datasets.len()).all(|state| import.selected.contains(&(number, state)));
    let title = title(product);
    let response = option(ui, rest, chosen, (&title, &title), palette, rest.left() + 4.0);
    if response.clicked() {
        let how = match meant(ui, &response) {
            Choose::UpTo => Choose::Also,
            how => how,
        };
        commands.push(Command::Import(Step::ChooseProduct(number, how)));
    }
}

/// Draws an open question about the grouping of a product's files, with a button for each answer.
fn question(ui: &mut Ui, import: &Import, number: usize, ambiguity: &Ambiguity, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let name = import.products[number].fields.name.clone();
    indented(ui, |ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let mut offer = |what: Text, tip: Text| {
                let button = ui.button(what).on_hover_text(tip);
                let label = text::about(what, &name);
                button.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &label));
                button.clicked()
            };
            match ambiguity {
                Ambiguity::NumbersAlone => {
                    if offer(text::SEPARATE, text::SEPARATE_FILES_TIP) {
                        commands.push(Command::Import(Step::ChooseProduct(number, Choose::Only)));
                        commands.push(Command::Import(Step::Separate));
                    }
                    if offer(text::AS_STATES, text::AS_STATES_TIP) {
                        commands.push(Command::Import(Step::Settle(number)));
                    }
                }
                Ambiguity::PerhapsStates(others) => {
                    if offer(text::SEPARATE, text::SEPARATE_TIP) {
                        commands.push(Command::Import(Step::Settle(number)));
                    }
                    if offer(text::ONE_WITH, text::ONE_WITH_TIP) {
                        together(import, number, others, commands);
                    }
                }
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let question = RichText::new(ambiguity.question()).color(palette.warning);
                ui.add(egui::Label::new(question).truncate());
            });
        });
    });
}

/// Adds the commands that combine a product (index `number`) with the products of the files `others`.
fn together(import: &Import, number: usize, others: &[String], commands: &mut Vec<Command>) {
    let asked = |row: &Row| {
        let source = import.products[row.0].sources.get(row.1);
        row.0 != number && source.is_some_and(|source| others.contains(source))
    };
    let rows: Vec<Row> = import.rows().filter(asked).collect();
    commands.push(Command::Import(Step::ChooseProduct(number, Choose::Only)));
    let whole = rows.first().map(|row| row.0).filter(|first| rows.len() > 1 && rows.iter().all(|row| row.0 == *first));
    match whole {
        Some(family) => commands.push(Command::Import(Step::StatesOf(family))),
        None => {
            commands.extend(rows.into_iter().map(|row| Command::Import(Step::Choose(row, Choose::Also))));
            commands.push(Command::Import(Step::Together));
        }
    }
}

/// Draws a note if the data of a product (index `number`) exist already, in the catalogue or in another file.
fn there_already(ui: &mut Ui, number: usize, product: &Proposed, commands: &mut Vec<Command>) {
    let known = product.known.first();
    let line = match (known, &product.same_as) {
        (Some(known), _) => text::already_as(&known.name),
        (None, Some(file)) => text::same_data(file),
        (None, None) => return,
    };
    let palette = theme::palette(ui);
    indented(ui, |ui| {
        ui.colored_label(palette.warning, line);
        if let Some(known) = known
            && ui.button(text::SHOW_IT).on_hover_text(text::SHOW_IT_TIP).clicked()
        {
            commands.push(Command::Select(known.key.clone()));
        }
        let mut anyway = product.add_anyway;
        if ui.checkbox(&mut anyway, text::ADD_ANYWAY).changed() {
            commands.push(Command::AddAnyway(number, anyway));
        }
    });
}

/// Draws the line of a state: file name, angle, name, transmittance τ, findings.
fn state_line(ui: &mut Ui, import: &Import, row: Row, product: &Proposed, commands: &mut Vec<Command>) {
    let (line, _) = ui.allocate_exact_size(vec2(ui.available_width(), LINE), Sense::hover());
    if !ui.is_rect_visible(line) {
        return;
    }
    let palette = theme::palette(ui);
    let words = &product.states[row.1];
    let cells = cells(line);
    let source = product.sources.get(row.1).map_or("", String::as_str);
    let parts = product.parts.get(row.1).map_or(0, Vec::len);
    let joined = text::joined_files(parts);
    let file = if source.is_empty() { joined.as_str() } else { source };
    let left = Rect::from_min_max(pos2(line.left() + 24.0, line.top()), cells[0].max);
    let state = words_of(words);
    let label = if state.is_empty() { file.to_owned() } else { format!("{file}, {state}") };
    let response = option(ui, left, import.selected.contains(&row), (file, &label), palette, left.left() + 14.0);
    if response.clicked() {
        commands.push(Command::Import(Step::Choose(row, meant(ui, &response))));
    }
    // A place of its own, so that fields do not move the lines below.
    let mut inside = ui.new_child(UiBuilder::new().max_rect(line));
    let mut typed = words.clone();
    let number_wrong = !words.angle.trim().is_empty() && words.number().is_none();
    for (cell, field, what) in
        [(cells[1], &mut typed.angle, text::ANGLE), (cells[2], &mut typed.name, text::STATE_NAME)]
    {
        let colour = if what == text::ANGLE && number_wrong { palette.error } else { palette.text };
        let edit =
            TextEdit::singleline(field).id_salt(what.english()).text_color(colour).desired_width(cell.width() - 8.0);
        let edit = inside.put(cell.shrink2(vec2(0.0, 2.0)), edit);
        let label = text::of_file(what, file);
        let value = if what == text::ANGLE { &words.angle } else { &words.name };
        edit.widget_info(|| {
            let mut info = egui::WidgetInfo::text_edit(true, value, value, "");
            info.label = Some(label.clone());
            info
        });
    }
    if typed != *words {
        commands.push(Command::Import(Step::Name(row, typed)));
    }
    let tau = product.taus.get(row.1).copied().flatten();
    let tau = tau.map_or_else(|| "–".to_owned(), |tau| fixed(tau, 2));
    let found = product.diagnoses.get(row.1).map_or(&[][..], Vec::as_slice);
    let colour = match worst(found) {
        Some(Severity::Error) => palette.error,
        Some(Severity::Warning) => palette.warning,
        _ => palette.weak,
    };
    for (cell, words, colour) in [(cells[3], tau, palette.text), (cells[4], counts(found), colour)] {
        let galley = theme::one_line(ui.painter(), &words, FontId::proportional(13.0), colour, cell.width());
        if galley.elided {
            ui.interact(cell, ui.scope_id().with((row, "findings")), Sense::hover()).on_hover_text(&words);
        }
        ui.painter().galley(pos2(cell.left(), cell.center().y - 0.5 * galley.size().y), galley, colour);
    }
}
