//! Table of the ranked products: rank, name, score as a bar with its error, and the figure of every objective with a
//! bar of its utility.

use super::input::{Action, Input, rank_words};
use super::words;
use crate::app::paint::palette::Palette;
use crate::compute::rank::Place;
use crate::study::rank::{Entry, Look, Shortlist, Sort, figure_words};
use crate::texts::choose as say;
use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align2, Color32, EventFilter, FontId, Galley, Id, Key, Modifiers, Rect, Response, ScrollArea, Sense, Stroke, Ui,
    UiBuilder, WidgetInfo, accesskit::Role, pos2, vec2,
};
use std::sync::Arc;

/// Height of a row of the table. \[points\]
const ROW: f32 = 24.0;
/// Width of the column of ranks. \[points\]
const RANK: f32 = 48.0;
/// Width of the column of scores. \[points\]
const SCORE: f32 = 96.0;
/// Minimum width of the column of an objective. \[points\]
const FIGURE: f32 = 112.0;
/// Minimum width of the column of names. \[points\]
const NAME: f32 = 130.0;
/// Space between two columns. \[points\]
const GAP: f32 = 8.0;

/// Returns the height of a table of `rows` products, including its head. \[points\]
pub(super) fn height(rows: usize) -> f32 {
    70.0 + rows as f32 * ROW
}

/// Horizontal positions (left and right edge) of the columns on the screen, with as many objectives as there is room
/// for. \[points\]
struct Columns {
    rank: f32,
    name: [f32; 2],
    score: [f32; 2],
    figures: Vec<[f32; 2]>,
}

impl Columns {
    fn of(ui: &Ui, rect: Rect, objectives: &[String]) -> Self {
        let headings: String = objectives.iter().map(|key| words::heading(key) + " ").collect();
        // No word of a heading is broken; with the space after it, so that this does not begin the next line.
        let words = headings.split_inclusive(' ');
        let widths = words.map(|word| text(ui, word, Color32::BLACK, f32::INFINITY, 1).size().x);
        let wide = widths.fold(FIGURE, f32::max).ceil();
        let right = rect.right() - 12.0;
        let room = right - rect.left() - RANK - SCORE - NAME - 2.0 * GAP;
        let count = ((room / (wide + GAP)).floor().max(0.0) as usize).min(objectives.len());
        let first = right - count as f32 * (wide + GAP);
        let figure = |k: usize| {
            let left = first + GAP + k as f32 * (wide + GAP);
            [left, left + wide]
        };
        let score = [first - SCORE, first];
        let rank = rect.left() + 2.0;
        Self { rank, name: [rank + RANK, score[0] - GAP], score, figures: (0..count).map(figure).collect() }
    }
}

/// Returns text laid out in at most `rows` lines of a width \[points\]; longer text is cut with "…".
fn text(ui: &Ui, words: &str, colour: Color32, width: f32, rows: usize) -> Arc<Galley> {
    let mut job = LayoutJob::simple(words.to_owned(), FontId::proportional(13.0), colour, width);
    job.wrap = TextWrapping { max_width: width.max(1.0), max_rows: rows, ..TextWrapping::default() };
    ui.painter().layout_job(job)
}

/// Draws the table of the products that pass the filters of the display settings.
pub(super) fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, list: &Shortlist, out: &mut Vec<Action>) {
    let shown = list.shown(input.look);
    let columns = Columns::of(ui, rect, &list.list.figures);
    let below = head(ui, rect, &columns, input, list, out);
    // Whole rows: none is cut before it is scrolled.
    let high = ((rect.bottom() - below) / ROW).floor().max(1.0) * ROW;
    let body = Rect::from_min_max(pos2(rect.left(), below), pos2(rect.right(), below + high));
    let id = ui.scope_id().with("ranked products");
    let focus = ui.interact(body, id, Sense::click());
    focus.widget_info(|| WidgetInfo::labeled(Role::ListBox, true, say::LIST_NAME.get()));
    let chosen = shown.iter().position(|entry| Some(&entry.product) == input.look.product.as_ref());
    let walked = keys(ui, &focus, &shown, chosen, out);
    let choose = |entry: &Entry, against: bool, out: &mut Vec<Action>| {
        let look = if against {
            Look { against: Some(entry.product.clone()), ..input.look.clone() }
        } else {
            let against = input.look.against.clone().filter(|other| *other != entry.product);
            Look { product: Some(entry.product.clone()), against, ..input.look.clone() }
        };
        out.push(Action::Look(Box::new(look)));
    };
    if let Some(entry) = walked.and_then(|k| shown.get(k)) {
        choose(entry, false, out);
    }
    ui.scope_builder(UiBuilder::new().max_rect(body).id_salt("rows"), |ui| {
        ScrollArea::vertical().id_salt("rows").auto_shrink([false, false]).show_viewport(ui, |ui, seen| {
            ui.set_height(shown.len() as f32 * ROW);
            let origin = ui.max_rect().left_top();
            let place = |k: usize| {
                let top = origin.y + k as f32 * ROW;
                Rect::from_min_max(pos2(body.left(), top), pos2(body.right() - 8.0, top + ROW))
            };
            if let Some(k) = walked {
                ui.scroll_to_rect(place(k), None);
            }
            let first = (seen.top() / ROW).floor().max(0.0) as usize;
            let last = ((seen.bottom() / ROW).ceil().max(0.0) as usize).min(shown.len());
            for (k, entry) in shown.iter().enumerate().take(last).skip(first) {
                let response = row(ui, id, (k, place(k)), &columns, entry, input, list);
                if response.clicked() {
                    focus.request_focus();
                    choose(entry, ui.input(|i| i.modifiers.shift), out);
                }
                if response.double_clicked() && entry.excluded.is_none() {
                    out.push(Action::IntoRoom(entry.product.clone()));
                }
            }
        });
    });
    if focus.has_focus() {
        let stroke = Stroke::new(1.5, Palette::of(ui.visuals()).first);
        ui.painter().rect_stroke(body, 2, stroke, egui::StrokeKind::Inside);
    }
}

/// Draws the names of the columns; a click on a name sorts the rows by the column. Returns the vertical screen position
/// of the lower edge of the names \[points\].
fn head(ui: &mut Ui, rect: Rect, columns: &Columns, input: &Input<'_>, list: &Shortlist, out: &mut Vec<Action>) -> f32 {
    let palette = Palette::of(ui.visuals());
    let mut heads = vec![
        (columns.rank, RANK - GAP, say::RANK.get().to_owned(), Some(Sort::Score), say::RANK_TIP_HEAD.get().to_owned()),
        (
            columns.name[0],
            columns.name[1] - columns.name[0],
            say::PRODUCT.get().to_owned(),
            Some(Sort::Name),
            say::MARKS_TIP.get().to_owned(),
        ),
        (columns.score[0], SCORE, say::SCORE.get().to_owned(), Some(Sort::Score), say::SCORE_TIP.get().to_owned()),
    ];
    for (place, key) in columns.figures.iter().zip(&list.list.figures) {
        let less = list.list.objectives.get(heads.len() - 3).is_some_and(|one| one.best < one.worst);
        let better = if less { say::LESS_IS_BETTER } else { say::MORE_IS_BETTER };
        heads.push((
            place[0],
            place[1] - place[0],
            words::heading(key),
            Some(Sort::Figure(key.clone())),
            format!("{key}: {better}"),
        ));
    }
    let galleys: Vec<Arc<Galley>> = heads
        .iter()
        .map(|(_, width, name, sort, _)| {
            let own = sort.as_ref() == Some(&input.look.sort);
            text(ui, name, if own { palette.ink } else { palette.weak }, *width, 3)
        })
        .collect();
    let height = galleys.iter().map(|galley| galley.size().y).fold(0.0, f32::max) + 4.0;
    for ((left, width, name, sort, tip), galley) in heads.into_iter().zip(galleys) {
        let cell = Rect::from_min_size(pos2(left, rect.top()), vec2(width, height));
        // Rank and score sort alike: one of them takes the click.
        let id = ui.scope_id().with(("head", left as i32));
        let response = ui.interact(cell, id, Sense::click()).on_hover_text(tip);
        response.widget_info(|| WidgetInfo::labeled(Role::ColumnHeader, true, say::order_by(&name)));
        let at = pos2(left, cell.bottom() - 2.0 - galley.size().y);
        ui.painter().galley(at, galley, palette.weak);
        if let Some(sort) = sort.filter(|_| response.clicked()) {
            out.push(Action::Look(Box::new(Look { sort, ..input.look.clone() })));
        }
    }
    let below = rect.top() + height;
    ui.painter().hline(rect.x_range(), below, Stroke::new(1.0, palette.outline));
    below + 2.0
}

/// Executes the keys of this frame: arrow keys select a product, Enter puts it into the room. Returns the index of the
/// row to scroll to.
fn keys(ui: &Ui, focus: &Response, shown: &[&Entry], chosen: Option<usize>, out: &mut Vec<Action>) -> Option<usize> {
    if !focus.has_focus() || shown.is_empty() {
        return None;
    }
    let arrows = EventFilter { vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(focus.id, arrows));
    let [step, enter] = ui.input_mut(|input| {
        let mut step = 0;
        for (key, by) in [(Key::ArrowDown, 1), (Key::ArrowUp, -1), (Key::PageDown, 10), (Key::PageUp, -10)] {
            step += by * input.count_and_consume_key(Modifiers::NONE, key) as i32;
        }
        [step, i32::from(input.consume_key(Modifiers::NONE, Key::Enter))]
    });
    if let Some(entry) = chosen.and_then(|k| shown.get(k)).filter(|entry| enter > 0 && entry.excluded.is_none()) {
        out.push(Action::IntoRoom(entry.product.clone()));
    }
    (step != 0).then(|| match chosen {
        Some(k) => k.saturating_add_signed(step as isize).min(shown.len() - 1),
        None => 0,
    })
}

/// Returns the signs before a product's name: ◆ on the Pareto front, ≈ approximate, ⌂ in the apertures of the scene.
fn marks(entry: &Entry, in_room: &str) -> String {
    let list = [
        (entry.place == Some(Place::Front), "◆ "),
        (!entry.approximate.is_empty(), "≈ "),
        (entry.product == in_room, "⌂ "),
    ];
    list.into_iter().filter(|(is, _)| *is).map(|(_, mark)| mark).collect()
}

/// Returns a row of the table as text for screen readers.
fn spoken(entry: &Entry) -> String {
    match &entry.excluded {
        Some(reason) => format!("{}: {}", entry.name, say::excluded_because(reason)),
        None => format!("{} {}: {}", rank_words(entry.ranks), entry.name, words::score(entry)),
    }
}

/// Draws the row (index `k`) of one product: rank, name, score and the figures of the objectives.
fn row(
    ui: &mut Ui,
    id: Id,
    (k, rect): (usize, Rect),
    columns: &Columns,
    entry: &Entry,
    input: &Input<'_>,
    list: &Shortlist,
) -> Response {
    let palette = Palette::of(ui.visuals());
    let response = ui.interact(rect, id.with(&entry.product), Sense::CLICK);
    let chosen = Some(&entry.product) == input.look.product.as_ref();
    let spoken = spoken(entry);
    response.widget_info(|| WidgetInfo::selected(Role::ListBoxOption, true, chosen, &spoken));
    let painter = ui.painter();
    if chosen {
        painter.rect_filled(rect, 2, ui.visuals().selection.bg_fill);
    } else if response.hovered() {
        painter.rect_filled(rect, 2, ui.visuals().widgets.hovered.weak_bg_fill);
    } else if k % 2 == 1 {
        painter.rect_filled(rect, 0, ui.visuals().faint_bg_color);
    }
    if Some(&entry.product) == input.look.against.as_ref() {
        painter.rect_stroke(rect.shrink(1.0), 2, Stroke::new(1.0, palette.second), egui::StrokeKind::Inside);
    }
    // What is coarse so far is paler.
    let pale = entry.coarse || entry.excluded.is_some();
    let colour = match (chosen, pale) {
        (true, _) => ui.visuals().selection.stroke.color,
        (_, true) => palette.weak,
        _ => palette.ink,
    };
    let middle = rect.center().y;
    let rank = if entry.excluded.is_some() { "–".to_owned() } else { rank_words(entry.ranks) };
    painter.text(pos2(columns.rank, middle), Align2::LEFT_CENTER, rank, FontId::proportional(13.0), colour);
    let name = format!("{}{}", marks(entry, input.in_room), entry.name);
    let name = text(ui, &name, colour, columns.name[1] - columns.name[0], 1);
    painter.galley(pos2(columns.name[0], middle - 0.5 * name.size().y), name, colour);
    let mut tip = spoken.clone();
    if let Some(reason) = &entry.excluded {
        let reason = text(ui, reason, palette.weak, rect.right() - columns.score[0] - 4.0, 1);
        painter.galley(pos2(columns.score[0], middle - 0.5 * reason.size().y), reason, palette.weak);
    } else {
        bar(ui, rect, columns.score, entry, pale, &palette);
        for (k, (place, figure)) in columns.figures.iter().zip(&entry.figures).enumerate() {
            let score = list.list.objectives.get(k).map_or(0.0, |one| one.utility(figure.value));
            let x = place[0]..=place[1];
            let under = Rect::from_x_y_ranges(x, rect.bottom() - 4.0..=rect.bottom() - 2.0);
            ui.painter().rect_filled(under, 0, palette.grid);
            let full = under.with_max_x(egui::lerp(under.x_range(), score as f32));
            ui.painter().rect_filled(full, 0, palette.first.gamma_multiply(if pale { 0.4 } else { 0.8 }));
            let words = words::value(figure_words(&list.list.figures[k]).1, *figure);
            let words = text(ui, &words, colour, place[1] - place[0], 1);
            ui.painter().galley(pos2(place[0], middle - 2.0 - 0.5 * words.size().y), words, colour);
        }
        for (k, key) in list.list.figures.iter().enumerate().skip(columns.figures.len()) {
            let (name, unit) = figure_words(key);
            tip.push_str(&format!("\n{name}: {}", words::value(unit, entry.figures[k])));
        }
        if entry.coarse {
            tip.push_str(&format!("\n{}", say::COARSE_TIP));
        }
        if !entry.approximate.is_empty() {
            tip.push_str(&format!("\n{}", say::approximate_since(entry.approximate.join("; "))));
        }
    }
    response.on_hover_text(tip)
}

/// Draws the score of a product, 0 … 1, as a bar between two horizontal positions, and its error as a whisker. `pale`:
/// whether the product is excluded or preliminary.
fn bar(ui: &Ui, rect: Rect, [left, right]: [f32; 2], entry: &Entry, pale: bool, palette: &Palette) {
    let x = |share: f64| left + (right - left - 6.0) * share.clamp(0.0, 1.0) as f32;
    let place = Rect::from_x_y_ranges(left..=x(1.0), rect.top() + 6.0..=rect.bottom() - 6.0);
    let (score, error) = (entry.score.value, entry.score.error);
    let painter = ui.painter();
    painter.rect_filled(place, 2, palette.grid.gamma_multiply(0.6));
    painter.rect_filled(place.with_max_x(x(score)), 2, palette.first.gamma_multiply(if pale { 0.4 } else { 0.8 }));
    let y = rect.center().y;
    let ends = [x(score - error), x(score + error)];
    painter.line_segment(ends.map(|x| pos2(x, y)), Stroke::new(1.5, palette.ink));
    for x in ends {
        painter.line_segment([pos2(x, y - 3.0), pos2(x, y + 3.0)], Stroke::new(1.5, palette.ink));
    }
}
