//! The line with the candidates of the comparison, always visible while there are any, and the comparison itself, which
//! replaces the tile area.

use super::columns::Columns;
use super::places::{short, tile_words};
use super::{beside, curves, difference, figures};
use crate::app::command::Command;
use crate::app::compare::view::{Act, Look};
use crate::app::display::theme;
use crate::app::state::State;
use crate::app::tiles;
use crate::study::comparison::label;
use crate::texts::{Text, compare as texts};
use egui::{Align, Key, Layout, RichText, TextEdit, Ui, UiBuilder, vec2};

/// Mean width of a letter in the chip of a candidate. \[points\]
const LETTER: f32 = 7.2;
/// Height of the line with the candidates. \[points\]
const LINE: f32 = 28.0;
/// Font size of the name of a candidate that is shown alone. \[points\]
const LARGE: f32 = 18.0;

/// Draws the line with the candidates of the comparison.
pub fn comparison_line(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let comparison = &state.document.scene.compare;
    let view = &state.compare;
    let mut act = |act: Act| commands.push(Command::Compare(act));
    ui.horizontal(|ui| {
        ui.set_height(LINE);
        ui.spacing_mut().item_spacing.x = 6.0;
        let own = ui.available_width() * 0.26;
        ui.allocate_ui_with_layout(vec2(own, LINE), Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(own);
            let (text, colour) = match view.swapped.and_then(|place| Some((place, comparison.get(place)?))) {
                Some((place, keys)) => (format!("{} {}", place + 1, label(keys)), theme::palette(ui).accent),
                None if view.open => (texts::comparing(comparison.len()), theme::palette(ui).text),
                None => (texts::SCENES_OWN.into(), theme::palette(ui).text),
            };
            let tip = texts::shown(&text);
            let shown = RichText::new(short(&text, (own / 10.5) as usize)).size(LARGE).strong().color(colour);
            ui.label(shown).on_hover_text(tip);
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let button = ui.selectable_label(view.open, texts::COMPARE);
            if button.on_hover_text(texts::COMPARE_TIP).clicked() {
                act(Act::Show);
            }
            let swap = ui.selectable_label(view.swapped.is_some(), texts::SWAP);
            if swap.on_hover_text(texts::SWAP_TIP).clicked() {
                act(Act::Swap);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let width = (ui.available_width() - 6.0 * comparison.len() as f32) / comparison.len().max(1) as f32;
                for place in 0..comparison.len() {
                    chip(ui, state, place, width.min(230.0), &mut act);
                }
            });
        });
    });
}

/// Draws the chip of a candidate (given by its index): a menu of its commands, or a text field while the user types its
/// name. `act` takes the commands that the user gives.
fn chip(ui: &mut Ui, state: &State, place: usize, width: f32, act: &mut impl FnMut(Act)) {
    let comparison = &state.document.scene.compare;
    let name = label(&comparison[place]);
    if let Some((named, typed)) = state.compare.naming.as_ref().filter(|(named, _)| *named == place) {
        let mut text = typed.clone();
        let field = ui.add(TextEdit::singleline(&mut text).desired_width(width - 10.0));
        field.widget_info(|| {
            egui::WidgetInfo::labeled(egui::accesskit::Role::TextInput, true, texts::NAME_IN_COMPARISON.get())
        });
        if ui.input(|input| input.key_pressed(Key::Escape)) {
            act(Act::EditName(None));
        } else if field.lost_focus() {
            act(Act::Rename(*named, text));
        } else {
            field.request_focus();
            if text != *typed {
                act(Act::EditName(Some((place, text))));
            }
        }
        return;
    }
    let full = format!("{} {name}", place + 1);
    let text = short(&full, ((width - 14.0) / LETTER) as usize);
    let shown = state.compare.swapped == Some(place);
    let text = if shown { RichText::new(text).color(theme::palette(ui).accent) } else { RichText::new(text) };
    let menu = ui.menu_button(text, |ui| {
        let last = comparison.len() - 1;
        let entries: [(Text, Text, bool, Act); 7] = [
            (texts::SHOW_IN_TILES, texts::SHOW_IN_TILES_TIP, true, Act::SwapWith(place)),
            (texts::TAKE, texts::TAKE_TIP, true, Act::Take(place)),
            (texts::BASE, texts::BASE_TIP, comparison.len() > 1, Act::Base(place)),
            (texts::RENAME, texts::RENAME_TIP, true, Act::EditName(Some((place, name.clone())))),
            (texts::MOVE_LEFT, texts::MOVE_LEFT_TIP, place > 0, Act::Move(place, -1)),
            (texts::MOVE_RIGHT, texts::MOVE_RIGHT_TIP, place < last, Act::Move(place, 1)),
            (texts::REMOVE, texts::REMOVE_TIP, true, Act::Remove(place)),
        ];
        for (text, tip, enabled, what) in entries {
            if ui.add_enabled(enabled, egui::Button::new(text.get())).on_hover_text(tip).clicked() {
                if matches!(what, Act::Base(_)) {
                    act(Act::Look(Look::Difference));
                }
                act(what);
                ui.close();
            }
        }
    });
    menu.response.on_hover_text(&full).accessible_name(texts::candidate(&full));
}

/// Draws the comparison in the space of the tile area.
pub fn show(ui: &mut Ui, state: &State, columns: &mut Columns, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let whole = ui.available_rect_before_wrap();
    ui.painter().rect(whole, 6, palette.surface, egui::Stroke::new(1.0, palette.line), egui::StrokeKind::Inside);
    let builder = UiBuilder::new().max_rect(whole.shrink2(vec2(8.0, 6.0))).id_salt("comparison");
    ui.scope_builder(builder, |ui| {
        ui.horizontal_wrapped(|ui| choices(ui, state, columns, commands));
        match state.compare.look {
            Look::Beside => beside::show(ui, state, columns, commands),
            Look::Difference => difference::show(ui, state, columns),
            Look::Curves => curves::show(ui, state, columns),
            Look::Figures => figures::show(ui, columns, commands),
        }
    });
}

/// Draws the choices of the kind of comparison (tiles side by side, curves, difference, figures) and of the tile that
/// is compared.
fn choices(ui: &mut Ui, state: &State, columns: &Columns, commands: &mut Vec<Command>) {
    let view = &state.compare;
    let mut act = |act: Act| commands.push(Command::Compare(act));
    for look in Look::ALL {
        if ui.selectable_label(view.look == look, look.words()).on_hover_text(look.tip()).clicked() {
            act(Act::Look(look));
        }
    }
    if view.look != Look::Figures {
        let combo = egui::ComboBox::from_id_salt("compared tile").width(110.0).selected_text(tile_words(view.tile()));
        let combo = combo.show_ui(ui, |ui| {
            for tile in tiles::compared().map(|tile| tile.title) {
                if ui.selectable_label(view.tile() == tile, tile_words(tile)).clicked() {
                    act(Act::Tile(tile));
                }
            }
        });
        combo.response.on_hover_text(texts::TILE_TIP).accessible_name(texts::TILE.get());
    }
    if view.look == Look::Difference {
        ui.label(texts::LESS);
        let names = columns.names();
        let base = names.get(view.base).map_or("", String::as_str);
        let combo = egui::ComboBox::from_id_salt("base").width(130.0).selected_text(short(base, 18));
        let combo = combo.show_ui(ui, |ui| {
            for (place, name) in names.iter().enumerate() {
                if ui.selectable_label(view.base == place, name).clicked() {
                    act(Act::Base(place));
                }
            }
        });
        combo.response.on_hover_text(texts::BASE_CHOICE_TIP).accessible_name(texts::BASE_CHOICE.get());
    }
    if columns.stopped && ui.button(texts::CONTINUE).on_hover_text(texts::CONTINUE_TIP).clicked() {
        act(Act::Resume);
    }
    if ui.button(texts::CLOSE).on_hover_text(texts::CLOSE_TIP).clicked() {
        act(Act::Show);
    }
}
