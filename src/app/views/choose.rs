//! View of the ranking tile: products ranked for this room by annual figures, with objectives and scores, as a table
//! with bars and as a plot of two objectives against each other; objectives and weights; the explanation of a rank as a
//! sum of parts.
//!
//! The view draws a ranking that is computed elsewhere.

mod empty;
mod input;
mod objectives;
mod plot;
mod table;
mod why;
mod words;

pub use input::{Action, Due, Input, Offer, Running, rank_words};

use crate::app::paint::tile::{self, Status, Words};
use crate::study::rank::{Look, Page, Shortlist, figure_words};
use crate::texts::choose as say;
use egui::{Checkbox, ComboBox, Rect, RichText, TextEdit, Ui, UiBuilder};

/// Minimum width of a tile that shows products and objectives side by side. \[points\]
const BOTH: f32 = 980.0;
/// Width of the list of objectives beside the products. \[points\]
const SIDE: f32 = 360.0;
/// Height of the explanation of the selected product's rank; less in a low tile. \[points\]
const WHY: f32 = 132.0;

/// Width of the choice of a plot's axis. \[points\]
const AXIS: f32 = 190.0;

/// Draws the ranking tile into all the space of `ui`. Returns the requests of the user.
pub fn show(ui: &mut Ui, input: &Input<'_>) -> Vec<Action> {
    let mut actions = Vec::new();
    let mut asked = Vec::new();
    let words = Words {
        title: say::CHOOSE.get(),
        subtitle: input.name,
        help: say::CHOOSE_ABOUT.get(),
        empty: None,
        controls_width: match (input.list.is_some(), input.look.page) {
            (false, _) => 0.0,
            (true, Page::Objectives) => 340.0,
            (true, Page::Plot) => 250.0 + 2.0 * AXIS,
            (true, Page::Table) => 515.0,
        },
    };
    let status = Status { error: None, ..input.status };
    tile::show(
        ui,
        &words,
        &status,
        |ui| {
            if let Some(list) = input.list {
                controls(ui, input, list, &mut asked);
            }
        },
        |ui, rect| match input.list {
            Some(list) => body(ui, rect, input, list, &mut actions),
            None => {
                empty::show(ui, rect, input, &mut actions);
                String::new()
            }
        },
    );
    actions.extend(asked);
    actions
}

/// Draws the controls in the tile's head: page, filter or axes, and the button that computes what is missing.
fn controls(ui: &mut Ui, input: &Input<'_>, list: &Shortlist, out: &mut Vec<Action>) {
    let mut look = Look::clone(input.look);
    for (page, word, tip) in [
        (Page::Table, say::TABLE, say::TABLE_TIP),
        (Page::Plot, say::PLOT, say::PLOT_TIP),
        (Page::Objectives, say::OBJECTIVES, say::OBJECTIVES_TIP),
    ] {
        ui.selectable_value(&mut look.page, page, word).on_hover_text(tip);
    }
    match look.page {
        Page::Table => {
            let field = TextEdit::singleline(&mut look.words).hint_text(say::FILTER.get()).desired_width(80.0);
            ui.add(field).on_hover_text(say::FILTER_TIP).accessible_name(say::FILTER_TIP.get());
            ui.add(Checkbox::new(&mut look.front_only, say::FRONT_ONLY.get())).on_hover_text(say::FRONT_TIP);
            let left_out = list.entries.iter().filter(|entry| entry.excluded.is_some()).count();
            if left_out > 0 || look.excluded {
                let words = say::excluded_too(left_out);
                ui.add(Checkbox::new(&mut look.excluded, words)).on_hover_text(say::EXCLUDED_TIP);
            }
        }
        Page::Plot => {
            let axes = list.axes(&look);
            for (k, name) in [say::ACROSS, say::UP].into_iter().enumerate() {
                axis(ui, list, name, (axes[k], &mut look.axes[k]));
            }
        }
        Page::Objectives => {}
    }
    if let Some((word, tip)) = words::due(input.due).filter(|_| input.running.is_none())
        && ui.button(word).on_hover_text(tip).clicked()
    {
        out.push(Action::Rank);
    }
    if look != *input.look {
        out.push(Action::Look(Box::new(look)));
    }
}

fn axis(ui: &mut Ui, list: &Shortlist, name: crate::texts::Text, (own, key): (usize, &mut String)) {
    let text = list.list.figures.get(own).map_or_else(String::new, |key| figure_words(key).0);
    let combo = ComboBox::from_id_salt(name.english()).width(AXIS).truncate().selected_text(text);
    let combo = combo.show_ui(ui, |ui| {
        for figure in &list.list.figures {
            ui.selectable_value(key, figure.clone(), figure_words(figure).0);
        }
    });
    combo.response.on_hover_text(name).accessible_name(name.get());
}

/// Draws the chosen page (table, plot or objectives) with the explanation of the selected product's rank. Returns the
/// line under it.
fn body(ui: &mut Ui, rect: Rect, input: &Input<'_>, list: &Shortlist, out: &mut Vec<Action>) -> String {
    let rect = below_progress(ui, rect, input, out);
    let rect = below_error(ui, rect, input);
    let page = input.look.page;
    let mut left = rect;
    if page != Page::Objectives && rect.width() >= BOTH && rect.height() >= 240.0 {
        let (own, right) = rect.split_left_right_at_x(rect.right() - SIDE);
        objectives::show(ui, right.with_min_x(right.left() + 12.0), input, out);
        left = own;
    }
    if page == Page::Objectives {
        objectives::show(ui, rect, input, out);
        return summary(input, list);
    }
    let why = if left.height() > 2.2 * WHY { WHY } else { (0.4 * left.height()).max(30.0) };
    // A short table leaves its room to the reasons.
    let needed = if page == Page::Table { table::height(list.shown(input.look).len()) } else { f32::INFINITY };
    let why = why.max(left.height() - needed);
    let (upper, lower) = left.split_top_bottom_at_y(left.bottom() - why);
    let text = if page == Page::Plot {
        plot::show(ui, upper, input, list, out)
    } else {
        table::show(ui, upper, input, list, out);
        summary(input, list)
    };
    why::show(ui, lower.with_min_y(lower.top() + 4.0), input, list, out);
    text
}

/// Returns the numbers of shown and of all products, and the weather data, as text.
fn summary(input: &Input<'_>, list: &Shortlist) -> String {
    let shown = list.shown(input.look).len();
    format!("{} · {}", say::shown(shown, list.entries.len()), input.weather.display())
}

/// Draws the progress bar at the upper edge while products are computed. Returns the area below it.
fn below_progress(ui: &mut Ui, rect: Rect, input: &Input<'_>, out: &mut Vec<Action>) -> Rect {
    if input.running.is_none() {
        return rect;
    }
    let (above, below) = rect.split_top_bottom_at_y(rect.top() + 28.0);
    ui.scope_builder(UiBuilder::new().max_rect(above).id_salt("progress"), |ui| empty::progress(ui, input, out));
    below
}

/// Draws the error that prevented a newer ranking, if there is one. Returns the area below it.
fn below_error(ui: &mut Ui, rect: Rect, input: &Input<'_>) -> Rect {
    let Some(error) = input.error else { return rect };
    let (above, below) = rect.split_top_bottom_at_y(rect.top() + 20.0);
    let colour = ui.visuals().error_fg_color;
    ui.scope_builder(UiBuilder::new().max_rect(above).id_salt("error"), |ui| {
        let text = RichText::new(error).size(13.0).color(colour);
        ui.add(egui::Label::new(text).truncate()).on_hover_text(error);
    });
    below
}
