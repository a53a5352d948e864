//! View of the year tile: an annual simulation of the room as a map of hours, a table of figures, and the electric
//! lighting over a day and by month; before there is a result, its settings and the button that computes it.

mod empty;
mod figures;
mod input;
mod lighting;
mod parts;

pub use input::{Action, Input, Shown};

use crate::app::paint::hour_map;
use crate::app::paint::tile::{self, Status, Words};
use crate::study::scene_words;
use crate::study::year::{Page, Shows, Year, choices, csv_column, error, title};
use crate::texts::{fixed, words::MONTHS, year as say};
use egui::{ComboBox, Rect, Ui, UiBuilder};
use parts::progress;

/// Cached picture of the year tile.
#[derive(Debug, Clone, Default)]
pub struct State {
    map: hour_map::State,
}

/// Minimum width of a tile that shows map and figures side by side. \[points\]
const BOTH: f32 = 1000.0;

/// Draws the year tile into all the space of `ui`. Returns the requests of the user.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = Vec::new();
    let mut asked = Vec::new();
    let words = Words {
        title: say::YEAR.get(),
        subtitle: input.name,
        help: say::YEAR_ABOUT.get(),
        empty: None,
        controls_width: if input.shown.is_some() { 440.0 } else { 0.0 },
    };
    let status = Status { error: None, ..input.status };
    tile::show(
        ui,
        &words,
        &status,
        |ui| {
            if let Some(shown) = &input.shown {
                controls(ui, input, shown, &mut asked);
            }
        },
        |ui, rect| match &input.shown {
            Some(shown) => body(ui, rect, input, shown, state, &mut actions),
            None => {
                empty::show(ui, rect, input, &mut actions);
                String::new()
            }
        },
    );
    actions.extend(asked);
    actions
}

/// Draws the controls in the tile's head: page, quantity and scale of the map or month of the lighting, and the button
/// that computes again.
fn controls(ui: &mut Ui, input: &Input<'_>, shown: &Shown<'_>, out: &mut Vec<Action>) {
    let mut look = input.look;
    for (page, word, tip) in [
        (Page::Map, say::PAGE_MAP, say::PAGE_MAP_TIP),
        (Page::Figures, say::PAGE_FIGURES, say::PAGE_FIGURES_TIP),
        (Page::Lighting, say::PAGE_LIGHTING, say::PAGE_LIGHTING_TIP),
    ] {
        ui.selectable_value(&mut look.page, page, word).on_hover_text(tip);
    }
    match look.page {
        Page::Map => {
            quantity(ui, &mut look.shows, shown.year);
            let scaled =
                matches!(look.shows, Shows::Mean | Shows::Sensor(_) | Shows::DirectNormal | Shows::DiffuseHorizontal);
            if scaled {
                ui.toggle_value(&mut look.log, say::LOG).on_hover_text(say::LOG_TIP);
            }
        }
        Page::Lighting => month(ui, &mut look.month, input.month),
        Page::Figures => {}
    }
    if input.status.stale && input.running.is_none() && ui.button(say::AGAIN).on_hover_text(say::AGAIN_TIP).clicked() {
        out.push(Action::Compute);
    }
    if look != input.look {
        out.push(Action::Look(look));
    }
}

fn quantity(ui: &mut Ui, shows: &mut Shows, year: &Year) {
    let combo = ComboBox::from_id_salt("quantity").width(110.0).truncate().selected_text(title(*shows));
    let combo = combo.show_ui(ui, |ui| {
        for one in choices(year) {
            ui.selectable_value(shows, one, title(one));
        }
    });
    combo.response.on_hover_text(say::QUANTITY_TIP).accessible_name(say::QUANTITY.get());
}

fn month(ui: &mut Ui, month: &mut Option<u8>, of_scene: u8) {
    let word = |month: u8| MONTHS[usize::from(month.clamp(1, 12)) - 1].get();
    let shown = month.map_or_else(|| say::scene_month(word(of_scene)), |month| word(month).to_owned());
    let combo = ComboBox::from_id_salt("month").width(110.0).selected_text(shown).show_ui(ui, |ui| {
        ui.selectable_value(month, None, say::scene_month(word(of_scene)));
        for one in 1..=12 {
            ui.selectable_value(month, Some(one), word(one));
        }
    });
    combo.response.on_hover_text(say::MONTH_TIP).accessible_name(say::MONTH.get());
}

/// Draws the chosen page: map, figures or electric lighting. Returns the line under it.
fn body(
    ui: &mut Ui,
    rect: Rect,
    input: &Input<'_>,
    shown: &Shown<'_>,
    state: &mut State,
    out: &mut Vec<Action>,
) -> String {
    let rect = above_progress(ui, rect, input, out);
    let rect = above_error(ui, rect, input);
    match input.look.page {
        Page::Map if rect.width() >= BOTH && rect.height() >= 240.0 => {
            let (left, right) = rect.split_left_right_at_fraction(0.5);
            let text = map(ui, left, input, shown, state, out);
            figures::show(ui, right.with_min_x(right.left() + 8.0), shown.rows);
            text
        }
        Page::Map => map(ui, rect, input, shown, state, out),
        Page::Figures => {
            figures::show(ui, rect, shown.rows);
            summary(shown)
        }
        Page::Lighting => lighting::show(ui, rect, shown),
    }
}

/// Draws the progress bar at the lower edge while a newer annual simulation is computed. Returns the area above it.
fn above_progress(ui: &mut Ui, rect: Rect, input: &Input<'_>, out: &mut Vec<Action>) -> Rect {
    let Some(share) = input.running else { return rect };
    let (above, below) = rect.split_top_bottom_at_y(rect.bottom() - 26.0);
    ui.scope_builder(UiBuilder::new().max_rect(below).id_salt("progress"), |ui| progress(ui, share, out));
    above
}

/// Draws the error that prevented a newer annual simulation, if there is one. Returns the area below it.
fn above_error(ui: &mut Ui, rect: Rect, input: &Input<'_>) -> Rect {
    let Some(error) = input.error else { return rect };
    let (above, below) = rect.split_top_bottom_at_y(rect.top() + 20.0);
    let colour = ui.visuals().error_fg_color;
    ui.scope_builder(UiBuilder::new().max_rect(above).id_salt("error"), |ui| {
        let text = egui::RichText::new(error).size(13.0).color(colour);
        ui.add(egui::Label::new(text).truncate()).on_hover_text(error);
    });
    below
}

/// Draws the map of hours; a click or arrow keys choose a step. Returns the line for the step under the pointer or
/// marked.
fn map(
    ui: &mut Ui,
    rect: Rect,
    input: &Input<'_>,
    shown: &Shown<'_>,
    state: &mut State,
    out: &mut Vec<Action>,
) -> String {
    let map = shown.map;
    let cell_of = |step: usize| {
        let step = &shown.year.steps.list[step];
        let minute = 60 * u16::from(step.time.hour().unsigned_abs()) + u16::from(step.time.minute().unsigned_abs());
        map.cell(step.month, step.time.day().unsigned_abs(), minute)
    };
    let mark = shown.now.and_then(cell_of);
    let drawn = hour_map::Input { map, revision: input.revision, mark, on_page: false };
    let answer = hour_map::show(ui, rect, &drawn, &mut state.map);
    for (cell, walking) in [(answer.picked, false), (answer.walked, true)] {
        let step = cell.and_then(|cell| map.from[cell]);
        out.extend(step.map(|step| Action::Show(step as usize, walking)));
    }
    let cell_text = |cell: usize| {
        let step = map.from[cell].map(|step| step as usize);
        let error =
            step.and_then(|step| error(shown.year, input.look.shows, step)).filter(|_| map.values[cell].is_finite());
        let error = error.map_or_else(String::new, |error| format!(" ± {}", crate::drawing::ticks::number(error, 2)));
        format!("{}{error}", hour_map::spoken(map, cell))
    };
    match (answer.pointed, mark) {
        (Some(cell), _) => cell_text(cell),
        (None, Some(cell)) if !shown.remark.is_empty() => format!("{} · {}", shown.remark, cell_text(cell)),
        (None, Some(cell)) => cell_text(cell),
        (None, None) => summary(shown),
    }
}

/// Returns weather station, number of steps with light, and computing time as text.
fn summary(shown: &Shown<'_>) -> String {
    let year = shown.year;
    let lit = year.chosen.len() - year.light.dark;
    let seconds: f64 = year.spent.iter().map(|(_, time)| time.as_secs_f64()).sum();
    say::summary(scene_words::station(&year.steps.station), lit, year.light.sets, fixed(seconds, 1))
}

/// Returns the numbers of the page shown as CSV.
pub fn csv(input: &Input<'_>) -> String {
    let Some(shown) = &input.shown else { return String::new() };
    match input.look.page {
        Page::Map => shown.map.csv(&csv_column(input.look.shows)),
        Page::Figures => figures::csv(shown.rows),
        Page::Lighting => lighting::csv(shown),
    }
}
