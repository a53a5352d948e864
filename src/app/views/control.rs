//! View of the control tile: the control diagram, i.e. the state (e.g. slat angle) over the profile angle of the sun,
//! with the scene's day as a curve; and a map of the states over the year.

mod edit;
mod input;

pub use input::{Input, StatePoint, TracePoint};

use super::Cache;
use crate::app::paint::hemisphere::on_halo;
use crate::app::paint::palette::{ColourMap, ColourMapExt as _, Palette};
use crate::app::paint::plot::{self, LEFT, Look, Shown};
use crate::app::paint::tile::{self, Words};
use crate::drawing::plot::{Axis, Guide, Plot, Series, Unit};
use crate::drawing::ticks::{number, tick};
use crate::texts::{csv_cell, tiles as say};
use egui::{
    Align2, Color32, ColorImage, FontId, Rect, Stroke, StrokeKind, TextureHandle, TextureOptions, Ui, pos2, vec2,
};
use egui_plot::{HLine, PlotImage, PlotPoint};
use input::{curve_at, extent};

/// Request of the user of the control tile.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Choice of a state, by its index in [`Input::states`].
    ChooseState(usize),
    /// New points of the control curve: profile angle \[°\], and value of the state in its unit.
    EditCurve(Vec<[f64; 2]>),
    /// Choice of an hour of the year as the scene's date and time.
    ChooseMoment {
        /// Day of the year, counted from 0.
        day: usize,
        /// Hour of the day, 0 … 23, in standard time.
        hour: f64,
    },
}

/// Texture of the picture of a year, freed with this value.
#[derive(Clone)]
struct Picture(TextureHandle);

impl std::fmt::Debug for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple(stringify!(Picture)).field(&self.0.size()).finish()
    }
}

/// State of the editing, and cached picture of the control tile between frames.
#[derive(Debug, Clone, Default)]
pub struct State {
    year: Cache<(u64, bool), Picture>,
    editing: edit::Editing,
}

/// Minimum number of days of the map of a year.
const DAYS: usize = 365;
/// Minimum height of the control diagram with its axes. \[points\]
const LEAST_CURVE: f32 = 120.0;

/// Draws the control tile into all the space of `ui`. Returns the requests of the user.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = vec![];
    let words = Words {
        title: say::CONTROL.get(),
        subtitle: input.name,
        help: say::CONTROL_ABOUT.get(),
        empty: (input.states.len() < 2).then_some(input.still),
        controls_width: 0.0,
    };
    tile::show(ui, &words, &input.status, |_| {}, |ui, rect| picture(ui, rect, input, state, &mut actions));
    actions
}

/// Draws the control diagram and, if there is room, the map of the states over the year. Returns the line under them.
fn picture(ui: &mut Ui, rect: Rect, input: &Input<'_>, state: &mut State, out: &mut Vec<Action>) -> String {
    let rect = remark(ui, rect, input);
    let with_year = !input.year.is_empty() && rect.height() > 220.0;
    let (top, bottom) = if with_year {
        let (top, bottom) = rect.split_top_bottom_at_fraction(0.5);
        (top, Some(bottom))
    } else {
        (rect, None)
    };
    let text = curve_ui(ui, top, input, &mut state.editing, out);
    let year = bottom.and_then(|place| year_ui(ui, place, input, state, out));
    year.or(text).unwrap_or_else(|| {
        let now = input
            .profile_angle
            .map_or_else(|| say::SUN_NOT_BEFORE.into(), |psi| say::profile_angle(format!("{psi:.0}")));
        format!("{now} · {}", state_text(input, input.current))
    })
}

/// Draws the remark on the year at the lower edge, or in a small tile a hint with the remark as tooltip. Returns the
/// area above it.
fn remark(ui: &mut Ui, rect: Rect, input: &Input<'_>) -> Rect {
    if input.remark.is_empty() {
        return rect;
    }
    let colour = Palette::of(ui.visuals()).weak;
    let font = FontId::proportional(13.0);
    let mut galley = ui.painter().layout(input.remark.to_owned(), font.clone(), colour, rect.width() - 8.0);
    let short = rect.height() - galley.size().y < LEAST_CURVE;
    if short {
        galley = ui.painter().layout_no_wrap(say::YEAR_REMARK.get().to_owned(), font, colour);
    }
    let (above, below) = rect.split_top_bottom_at_y((rect.bottom() - galley.size().y - 4.0).max(rect.top()));
    let response = ui.interact(below, ui.scope_id().with("remark"), egui::Sense::hover());
    let response = if short { response.on_hover_text(input.remark) } else { response };
    tile::name(ui, &response, say::YEAR_REMARK, input.remark);
    ui.painter().galley(below.min + vec2(4.0, 2.0), galley, colour);
    above
}

fn state_text(input: &Input<'_>, index: usize) -> String {
    input.states.get(index).map_or_else(
        || say::NO_STATE.into(),
        |s| {
            let (quantity, unit) = input.quantity.split_once(" / ").unwrap_or((input.quantity, ""));
            say::state_of(&s.key, quantity, format!("{}{unit}", tick(s.value)))
        },
    )
}

fn state_colour(input: &Input<'_>, index: usize) -> Color32 {
    ColourMap::Sequential.at(index as f32 / (input.states.len().max(2) - 1) as f32)
}

/// Draws the control diagram, and executes pointer and keys that edit the control curve or choose a state. Returns the
/// line for the point that is edited or under the pointer.
fn curve_ui(
    ui: &mut Ui,
    rect: Rect,
    input: &Input<'_>,
    editing: &mut edit::Editing,
    out: &mut Vec<Action>,
) -> Option<String> {
    let palette = Palette::of(ui.visuals());
    let (lo, hi) = extent(input);
    let (name, unit) = input.quantity.split_once(" / ").unwrap_or((input.quantity, ""));
    let unit = if unit == "°" { Unit::Degrees } else { Unit::Named("") };
    let value = |index: usize| input.states.get(index).map_or(f64::NAN, |s| s.value);
    let today = input.today.iter().map(|p| [p.profile_angle.unwrap_or(f64::NAN), value(p.state)]);
    let mut series = vec![Series::line(say::RULE, input.curve.iter().copied())];
    if !input.today.is_empty() {
        series.push(Series::line(say::TODAY, today));
    }
    let now = input.profile_angle.filter(|psi| (0.0..=90.0).contains(psi));
    let plot = Plot {
        x: Axis::linear([0.0, 90.0], say::PROFILE_ANGLE, Unit::Degrees),
        y: Axis::linear([lo, hi], name, unit),
        series,
        guides: now.map(|psi| Guide { name: String::new(), ends: [[psi, lo], [psi, hi]] }).into_iter().collect(),
    };
    let id = ui.scope_id().with("curve");
    let held = edit::held(ui, id, input, editing);
    let colours = [palette.first, palette.sun];
    let look = Look { held, focusable: true, ..Look::tile(id, &colours, palette.sun) };
    let shown = plot::show(ui, rect, &plot, &look, |plot_ui| {
        for (k, s) in input.states.iter().enumerate() {
            let now = k == input.current;
            let stroke = if now { Stroke::new(1.5, palette.ink) } else { Stroke::new(0.5, palette.outline) };
            plot_ui.hline(HLine::new("", s.value).stroke(stroke).allow_hover(false));
        }
    });
    let (edited, taken) = if input.editable { edit::edit(ui, &shown, input, editing) } else { (None, false) };
    marks_ui(ui, &shown, input, now, editing, &palette);
    tile::name(ui, &shown.response, say::CONTROL_CURVE, &state_text(input, input.current));
    let nearest = |v: f64| {
        let distance = |k: &usize| (input.states[*k].value - v).abs();
        (0..input.states.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    // A click on the ground beside the states is the view's.
    let on_state = |[psi, v]: [f64; 2]| {
        let index = nearest(v)?;
        let aside = shown.screen([psi, v]).y - shown.screen([psi, value(index)]).y;
        (aside.abs() <= 8.0).then_some(index)
    };
    let chosen = shown.clicked().filter(|_| !taken).and_then(on_state);
    out.extend(chosen.map(Action::ChooseState));
    out.extend(edited.map(Action::EditCurve));
    if let Some(k) = editing.chosen.filter(|_| shown.response.has_focus() && input.editable)
        && let Some([angle, value]) = input.curve.get(k)
    {
        return Some(say::point_of(k + 1, input.curve.len(), format!("{angle:.0}"), number(*value, 3)));
    }
    let [psi, v] = shown.pointed()?;
    let rule = curve_at(input.curve, psi).map_or_else(String::new, |v| say::rule_part(number(v, 3)));
    Some(say::nearest_state(format!("{psi:.0}"), rule, state_text(input, nearest(v)?)))
}

/// Draws the marks of the control diagram: points of the control curve, full hours of the scene's day, states, and the
/// sun at the profile angle `now` \[°\].
fn marks_ui(ui: &Ui, shown: &Shown, input: &Input<'_>, now: Option<f64>, editing: &edit::Editing, palette: &Palette) {
    let area = shown.area();
    let painter = &ui.painter().with_clip_rect(area.expand(7.0).intersect(ui.clip_rect()));
    // Whatever the view was moved to: marks outside it are left out.
    let place = |point: [f64; 2]| Some(shown.screen(point)).filter(|at| area.expand(0.5).contains(*at));
    let value = |index: usize| input.states.get(index).map_or(f64::NAN, |s| s.value);
    for (k, p) in input.curve.iter().enumerate().filter(|_| input.editable) {
        let Some(at) = place(*p) else { continue };
        let chosen = editing.chosen == Some(k);
        let radius = if chosen { 5.5 } else { 3.5 };
        let edge = if chosen { palette.ink } else { palette.first };
        painter.circle(at, radius, palette.face, Stroke::new(2.0, edge));
    }
    let mut used: Vec<Rect> = vec![];
    let today = !shown.hidden.iter().any(|name| name == say::TODAY.get());
    for p in input.today.iter().filter(|p| today && (p.hour - p.hour.round()).abs() < 1e-6) {
        let Some(at) = p.profile_angle.and_then(|psi| place([psi, value(p.state)])) else { continue };
        painter.circle(at, 3.0, palette.sun, Stroke::new(1.0, palette.ink));
        let text = Rect::from_center_size(at - vec2(0.0, 12.0), vec2(26.0, 13.0));
        if used.iter().all(|r| !r.intersects(text)) && area.contains_rect(text) {
            used.push(on_halo(painter, text.center(), &say::hour_mark(format!("{:.0}", p.hour)), palette));
        }
    }
    let spacing = area.height() / input.states.len().max(1) as f32;
    for (k, s) in input.states.iter().enumerate() {
        // The states as dots on the far side, where no numbers stand; the current one larger.
        let at = pos2(area.right(), shown.screen([0.0, s.value]).y);
        if area.y_range().contains(at.y) {
            let radius = if k == input.current { 6.0 } else { (0.45 * spacing).clamp(1.5, 4.0) };
            painter.circle(at, radius, state_colour(input, k), Stroke::new(1.5, palette.ink));
        }
    }
    if let Some(at) = now.and_then(|psi| place([psi, value(input.current)])) {
        painter.circle(at, 6.0, palette.sun, Stroke::new(1.5, Color32::BLACK));
    }
}

/// Returns the picture of the states over a year: a column for each of `days` days, a row for each hour with noon in
/// the middle, a colour for each state and `night` for hours without one.
fn year_picture(ui: &Ui, input: &Input<'_>, days: usize, night: Color32) -> Picture {
    let hours = (0..24).rev().flat_map(|hour| (0..days).map(move |day| day * 24 + hour));
    let state = |k: usize| input.year.get(k).copied().flatten();
    let pixels = hours.map(|k| state(k).map_or(night, |index| state_colour(input, usize::from(index))));
    let image = ColorImage::new([days, 24], pixels.collect());
    Picture(ui.ctx().load_texture("year-of-states", image, TextureOptions::NEAREST))
}

/// Draws the map of the states over the year; a click chooses an hour. Returns the line for the hour under the pointer.
fn year_ui(ui: &mut Ui, rect: Rect, input: &Input<'_>, state: &mut State, out: &mut Vec<Action>) -> Option<String> {
    let palette = Palette::of(ui.visuals());
    let (above, legend) = rect.split_top_bottom_at_y(rect.bottom() - 18.0);
    states_legend(ui, legend.with_min_x(rect.left() + LEFT), input, &palette);
    let days = input.year.len().div_ceil(24).max(DAYS);
    let picture =
        state.year.get((input.revision, ui.visuals().dark_mode), || year_picture(ui, input, days, palette.face));
    let plot = Plot {
        x: Axis::linear([0.0, days as f64], "", Unit::Days),
        y: Axis::linear([0.0, 24.0], "", Unit::Hours),
        series: vec![],
        guides: vec![],
    };
    let look = Look::tile(ui.scope_id().with("year"), &[], palette.sun);
    let (middle, size) = (PlotPoint::new(0.5 * days as f64, 12.0), [days as f32, 24.0]);
    let shown = plot::show(ui, above, &plot, &look, |plot_ui| {
        plot_ui.image(PlotImage::new("", picture.0.id(), middle, size).allow_hover(false));
    });
    if let Some((day, hour)) = input.moment {
        let at = shown.screen([day as f64 + 0.5, hour]);
        let painter = ui.painter().with_clip_rect(shown.area().expand(5.0));
        painter.circle(at, 4.5, palette.sun, Stroke::new(1.5, Color32::BLACK));
    }
    tile::name(ui, &shown.response, say::YEAR_MAP, say::YEAR_MAP_VALUE.get());
    let moment = |[day, hour]: [f64; 2]| ((day.max(0.0) as usize).min(days - 1), hour.clamp(0.0, 23.99).floor());
    if let Some((day, hour)) = shown.clicked().map(moment) {
        out.push(Action::ChooseMoment { day, hour });
    }
    let (day, hour) = shown.pointed().map(moment)?;
    let what = match input.year.get(day * 24 + hour as usize).copied().flatten() {
        Some(index) => state_text(input, usize::from(index)),
        None => say::NIGHT.into(),
    };
    Some(say::day_hour(day + 1, days, format!("{hour:.0}"), what))
}

/// Draws the legend of the states and their colours; if not all fit, every n-th of them.
fn states_legend(ui: &Ui, rect: Rect, input: &Input<'_>, palette: &Palette) {
    let n = input.states.len();
    let room = ((rect.width() - 110.0) / 44.0).max(2.0) as usize;
    let stride = n.div_ceil(room).max(1);
    let mut x = rect.left();
    for k in (0..n).step_by(stride) {
        let swatch = Rect::from_min_size(pos2(x, rect.center().y - 5.0), vec2(10.0, 10.0));
        ui.painter().rect(swatch, 1, state_colour(input, k), Stroke::new(1.0, palette.outline), StrokeKind::Middle);
        let text = tick(input.states[k].value);
        let at = pos2(x + 14.0, rect.center().y);
        let label = ui.painter().text(at, Align2::LEFT_CENTER, text, FontId::proportional(11.0), palette.ink);
        x = label.right() + 9.0;
    }
    let at = pos2(x + 2.0, rect.center().y);
    if at.x + 90.0 < rect.right() {
        ui.painter().text(at, Align2::LEFT_CENTER, input.quantity, FontId::proportional(13.0), palette.weak);
    }
}

/// Returns the state and its value for every hour of the year as CSV.
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("day,hour,state,value\n");
    for (k, index) in input.year.iter().enumerate() {
        let state = index.and_then(|i| input.states.get(usize::from(i)));
        let (key, value) = state.map_or((String::new(), String::new()), |s| (csv_cell(&s.key), s.value.to_string()));
        let _ = writeln!(out, "{},{},{key},{value}", k / 24 + 1, k % 24);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_is_linear_between_its_points_and_held_beyond() {
        let curve = [[10.0, 60.0], [30.0, 20.0], [50.0, 0.0]];
        assert_eq!(curve_at(&curve, 0.0), Some(60.0));
        assert_eq!(curve_at(&curve, 20.0), Some(40.0));
        assert_eq!(curve_at(&curve, 90.0), Some(0.0));
        assert_eq!(curve_at(&[], 5.0), None);
    }
}
