//! Input fields and buttons shared by the panels. Invalid input is reported under its field and changes nothing.

use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::offer::{Offer, key_words};
use crate::app::shell::typing::read_number;
use crate::app::state::State;
use crate::texts::{decimal, fixed, shell};
use egui::accesskit::Role;
use egui::text::{CCursor, CCursorRange, LayoutJob, TextWrapping};
use egui::text_edit::TextEditState;
use egui::{
    Align, Button, Color32, DragValue, Key, Label, Layout, Response, RichText, Sense, TextEdit, TextStyle, Ui,
    WidgetInfo, vec2,
};
use std::cell::RefCell;
use std::ops::RangeInclusive;

/// Text under an input field until the field is used again.
#[derive(Debug, Clone, PartialEq)]
enum FieldMessage {
    /// Reason why the input was refused.
    Refused(String),
    /// Note that another value was changed together with the field's.
    Note(String),
}

fn key(ui: &Ui, label: &str) -> egui::Id {
    ui.make_persistent_id((label, "note"))
}

/// Sets a note under a field, given by its label, about other values that its last change also changed; it is shown
/// until the field changes again.
pub fn note(ui: &Ui, label: impl Into<&'static str>, text: String) {
    let key = key(ui, label.into());
    ui.data_mut(|data| data.insert_temp(key, FieldMessage::Note(text)));
}

fn show_message(ui: &mut Ui, label: &str) {
    let key = key(ui, label);
    let palette = theme::palette(ui);
    let (text, colour) = match ui.data(|data| data.get_temp::<FieldMessage>(key)) {
        Some(FieldMessage::Refused(text)) => (text, palette.error),
        Some(FieldMessage::Note(text)) => (text, palette.warning),
        None => return,
    };
    ui.add(Label::new(RichText::new(text).color(colour)).wrap());
}

/// Draws a line with a label on the left and its field on the right. Returns the response of the field.
pub fn row(ui: &mut Ui, label: &str, field: impl FnOnce(&mut Ui) -> Response) -> Response {
    ui.horizontal(|ui| {
        let name = ui.label(label);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| field(ui).labelled_by(name.id)).inner
    })
    .inner
}

/// Draws an input field for a number, with label, unit and range. Returns `true` if the number changed. A typed number
/// outside the range is reported and not taken over; a value outside the range that is there already is not changed.
pub fn number(
    ui: &mut Ui,
    label: impl Into<&'static str>,
    unit: impl Into<&'static str>,
    value: &mut f64,
    range: RangeInclusive<f64>,
    decimals: usize,
) -> bool {
    let speed = ((range.end() - range.start()) / 400.0).max(0.1_f64.powi(decimals as i32));
    number_by(ui, (label.into(), unit.into()), value, range, decimals, speed)
}

/// Draws an input field for a number like [`number`], with a chosen change `speed`
/// \[unit of the number per point of a drag\], for wide ranges.
pub fn number_by(
    ui: &mut Ui,
    (label, unit): (&str, &str),
    value: &mut f64,
    range: RangeInclusive<f64>,
    decimals: usize,
    speed: f64,
) -> bool {
    let (low, high) = (*range.start(), *range.end());
    let shown = fixed(*value, decimals);
    let (least, most) = (fixed(low, decimals), format!("{}{unit}", fixed(high, decimals)));
    let refused = RefCell::new(None);
    let read = |text: &str| {
        // Looked at and left: not even rounded.
        if text.trim() == shown {
            return None;
        }
        match read_number(text, unit) {
            Some(number) if range.contains(&number) => return Some(number),
            Some(number) => {
                let value = format!("{}{unit}", decimal(number.to_string()));
                *refused.borrow_mut() = Some(shell::not_possible(value, &least, &most));
            }
            None => {
                *refused.borrow_mut() = Some(shell::no_number(text.trim(), &least, &most));
            }
        }
        None
    };
    let before = *value;
    let response = row(ui, label, |ui| {
        let drag = DragValue::new(value)
            .range(range.clone())
            .clamp_existing_to_range(false)
            .update_while_editing(false)
            .custom_parser(read)
            .speed(speed)
            .fixed_decimals(decimals)
            .suffix(unit);
        ui.add(drag)
            .on_hover_text(shell::number_tip(decimal(low.to_string()), format!("{}{unit}", decimal(high.to_string()))))
    });
    // Arrow keys step on beyond the range.
    if *value != before && !range.contains(value) && range.contains(&before) {
        *value = value.clamp(low, high);
    }
    let key = key(ui, label);
    if let Some(text) = refused.into_inner() {
        ui.data_mut(|data| data.insert_temp(key, FieldMessage::Refused(text)));
    } else if *value != before || response.gained_focus() {
        ui.data_mut(|data| data.remove::<FieldMessage>(key));
    }
    show_message(ui, label);
    *value != before
}

/// Draws an input field for a number that may be absent in the scene: in this case a button, which sets it to `start`.
pub fn optional(
    ui: &mut Ui,
    label: impl Into<&'static str>,
    unit: impl Into<&'static str>,
    value: &mut Option<f64>,
    start: f64,
    range: RangeInclusive<f64>,
) {
    let (label, unit) = (label.into(), unit.into());
    match value {
        Some(number_value) => {
            number(ui, label, unit, number_value, range, 2);
        }
        None => {
            let text = shell::missing(format!("{}{unit}", decimal(start.to_string())));
            if row(ui, label, |ui| ui.button(text)).clicked() {
                *value = Some(start);
            }
        }
    }
}

/// Draws a labelled figure that is shown only and cannot be edited.
pub fn figure(ui: &mut Ui, label: impl Into<&'static str>, text: &str) {
    row(ui, label.into(), |ui| ui.label(text));
}

/// Text of a field that is being typed, or was invalid.
#[derive(Debug, Clone)]
struct Draft {
    text: String,
    /// Text that the field showed before the user typed.
    of: String,
    wrong: Option<String>,
}

/// Draws a labelled text field whose text is parsed by `read` when the field loses the keyboard focus; text that cannot
/// be parsed is reported under the field and changes nothing. Returns the parsed value in the frame in which it is
/// entered.
pub fn typed<T>(
    ui: &mut Ui,
    label: impl Into<&'static str>,
    shown: &str,
    tip: impl Into<&'static str>,
    read: impl FnOnce(&str) -> Result<T, String>,
) -> Option<T> {
    let label = label.into();
    let key = ui.make_persistent_id((label, "draft"));
    let id = key.with("field");
    let focused = ui.memory(|memory| memory.has_focus(id));
    // Once the scene has moved on by other means, what was refused is no longer of interest.
    let draft: Option<Draft> = ui.data(|data| data.get_temp(key)).filter(|draft: &Draft| focused || draft.of == shown);
    let (mut text, mut wrong) = draft.map_or_else(|| (shown.to_owned(), None), |draft| (draft.text, draft.wrong));
    let response = row(ui, label, |ui| ui.add(TextEdit::singleline(&mut text).id(id).desired_width(112.0)));
    let response = response.on_hover_text(tip.into());
    if response.gained_focus() {
        select_all(ui, id, &text);
    }
    if response.changed() {
        wrong = None;
    }
    let mut taken = None;
    if response.lost_focus() {
        if ui.input(|input| input.key_pressed(Key::Escape)) || text.trim() == shown {
            (text, wrong) = (shown.to_owned(), None);
        } else {
            match read(&text) {
                Ok(value) => {
                    (taken, wrong) = (Some(value), None);
                    text = shown.to_owned();
                }
                Err(message) => wrong = Some(message),
            }
        }
    }
    if let Some(message) = &wrong {
        ui.add(Label::new(RichText::new(message).color(theme::palette(ui).error)).wrap());
    }
    // Asked for before: the memory is locked while it is written.
    let typing = response.has_focus();
    ui.data_mut(|data| {
        if typing || wrong.is_some() {
            data.insert_temp(key, Draft { text, of: shown.to_owned(), wrong });
        } else {
            data.remove::<Draft>(key);
        }
    });
    taken
}

/// Gives the keyboard focus to the field for which the side panel was opened. The focus is requested in every frame
/// until the field has it, because another widget, or a key of the same frame, may remove it again. The command palette
/// has priority while it is open.
pub fn take_keyboard(field: &Response, state: &State, commands: &mut Vec<Command>) {
    if !state.wants_keyboard || state.palette.is_some() {
    } else if field.has_focus() {
        commands.push(Command::KeyboardTaken);
    } else {
        field.request_focus();
    }
}

/// Selects the whole text of a text field, given by its id, so that typing replaces it.
pub fn select_all(ui: &Ui, id: egui::Id, text: &str) {
    let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::two(CCursor::default(), CCursor::new(text.chars().count()))));
    state.store(ui.ctx(), id);
}

/// Draws text in a constant height of `rows` lines whatever its length, so that nothing below it moves; a tooltip shows
/// the full text.
pub fn lines(ui: &mut Ui, text: &str, colour: Color32, rows: usize) {
    let font = TextStyle::Body.resolve(ui.style());
    let width = ui.available_width();
    let height = rows as f32 * ui.text_style_height(&TextStyle::Body);
    let mut job = LayoutJob::simple(text.to_owned(), font, colour, width);
    job.wrap = TextWrapping { max_width: width, max_rows: rows, ..TextWrapping::default() };
    let galley = ui.painter().layout_job(job);
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    let elided = galley.elided;
    ui.painter().galley(rect.min, galley, colour);
    if elided {
        response.on_hover_text(text);
    }
}

/// Returns a button with the text and the keyboard shortcut of a command.
pub fn button(offer: &Offer) -> Button<'_> {
    let button = Button::new(&offer.text);
    match &offer.keys {
        Some(keys) => button.shortcut_text(key_words(keys)),
        None => button,
    }
}
