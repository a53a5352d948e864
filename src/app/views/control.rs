//! Control: which state for which profile angle, today's way of the sun over that curve, and the year.

mod edit;

use super::Cache;
use crate::app::paint::chart::{Axis, Chart, LEFT};
use crate::app::paint::hemisphere::on_halo;
use crate::app::paint::palette::{ColourMap, Palette};
use crate::app::paint::ticks::{number, tick};
use crate::app::paint::tile::{self, Status, Words};
use egui::{Align2, Color32, FontId, Mesh, Rect, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};
use std::sync::Arc;

/// A state of a moving product.
#[derive(Debug, Clone, PartialEq)]
pub struct StatePoint {
    /// Key in the dataset.
    pub key: String,
    /// What is set, e.g. a slat angle in degrees.
    pub value: f64,
}

/// The sun and the control at one time of today.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracePoint {
    /// Hour of the day.
    pub hour: f64,
    /// Profile angle on the façade \[°\]; `None` while the sun is not before it.
    pub profile_angle: Option<f64>,
    /// Index of the state that control chose.
    pub state: usize,
}

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The product's states, by rising value; fewer than two: nothing moves.
    pub states: &'a [StatePoint],
    /// What a state sets, with unit, e.g. "slat angle / °".
    pub quantity: &'a str,
    /// The rule: value [unit of the states] over profile angle \[°\], rising angle.
    pub curve: &'a [[f64; 2]],
    /// May its points be moved?
    pub editable: bool,
    /// Product and rule in words.
    pub name: &'a str,
    /// Today.
    pub today: &'a [TracePoint],
    /// The profile angle now. \[°\]
    pub profile_angle: Option<f64>,
    /// The state now, index into `states`.
    pub current: usize,
    /// State of every hour of the year (365 × 24, day by day), `None` at night; empty while not computed.
    pub year: &'a [Option<u16>],
    /// Day of the year now, from 0, and hour, for the mark on the map.
    pub moment: Option<(usize, f64)>,
    /// Changes with states, curve, trace and year.
    pub revision: u64,
    /// How far the content is to be trusted.
    pub status: Status<'a>,
}

/// What the user did.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// A state was clicked: set it.
    ChooseState(usize),
    /// The curve was changed.
    EditCurve(Vec<[f64; 2]>),
    /// An hour of the year was clicked: day from 0, hour.
    ChooseMoment {
        /// Day of the year, from 0.
        day: usize,
        /// Hour of the day.
        hour: f64,
    },
}

/// The tile's own settings and pictures.
#[derive(Debug, Clone, Default)]
pub struct State {
    year: Cache<(u64, Rect, bool), Arc<Mesh>>,
    editing: edit::Editing,
}

const HELP: &str = "Which state the control takes at which profile angle (the sun's angle in the vertical section \
across the façade): the rule as a curve, the product's states as dots, today's way of the sun as a trace; under it the \
state of every hour of the year. Click a state to set it, an hour to go there. With the rule “Curve” its points can be \
dragged; a double click adds one, a right click takes one out; keys: , and . choose a point, arrows move it, + adds one, \
Delete takes it out.\nSource: IEA SHC Task 31 report (2005); \
profile angle tan ψ = tan h / cos Δaz.";
const DAYS: usize = 365;
/// First days of the months, from 0, in a year of 365 days.
const FIRST: [usize; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];

/// Draws the tile into all the space of `ui`.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = vec![];
    let words = Words {
        title: "Control",
        subtitle: input.name,
        help: HELP,
        empty: (input.states.len() < 2)
            .then_some("This product does not move: it has one state, whatever the sun does."),
        controls_width: 0.0,
    };
    tile::show(ui, &words, &input.status, |_| {}, |ui, rect| picture(ui, rect, input, state, &mut actions));
    actions
}

fn picture(ui: &mut Ui, rect: Rect, input: &Input<'_>, state: &mut State, out: &mut Vec<Action>) -> String {
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
            .map_or("the sun is not before the façade".to_owned(), |psi| format!("profile angle {psi:.0}°"));
        format!("{now} · {}", state_text(input, input.current))
    })
}

fn state_text(input: &Input<'_>, index: usize) -> String {
    input.states.get(index).map_or_else(
        || "no state".to_owned(),
        |s| {
            let (quantity, unit) = input.quantity.split_once(" / ").unwrap_or((input.quantity, ""));
            format!("state {} ({quantity} {}{unit})", s.key, tick(s.value))
        },
    )
}

/// Lowest and highest value of the states and the curve.
fn extent(input: &Input<'_>) -> (f64, f64) {
    let values = input.states.iter().map(|s| s.value).chain(input.curve.iter().map(|p| p[1]));
    let (lo, hi) =
        values.filter(|v| v.is_finite()).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let margin = 0.08 * (hi - lo).max(1.0);
    (lo - margin, hi + margin)
}

fn state_colour(input: &Input<'_>, index: usize) -> Color32 {
    ColourMap::Sequential.at(index as f32 / (input.states.len().max(2) - 1) as f32)
}

/// Ticks at the states, thinned to what the height holds.
fn state_marks(input: &Input<'_>, height: f32) -> Vec<(f64, String)> {
    let room = ((height - 60.0) / 16.0).max(2.0) as usize;
    let stride = input.states.len().div_ceil(room).max(1);
    input.states.iter().step_by(stride).map(|s| (s.value, tick(s.value))).collect()
}

fn curve_ui(
    ui: &mut Ui,
    rect: Rect,
    input: &Input<'_>,
    editing: &mut edit::Editing,
    out: &mut Vec<Action>,
) -> Option<String> {
    let palette = Palette::of(ui.visuals());
    let (lo, hi) = extent(input);
    let x = Axis::linear(0.0, 90.0, "profile angle / °")
        .with_marks((0..=6).map(|k| (15.0 * f64::from(k), format!("{}", 15 * k))).collect());
    let y = Axis::linear(lo, hi, input.quantity).with_marks(state_marks(input, rect.height()));
    let chart = Chart::within(rect, x, y);
    let response = ui.interact(chart.area, ui.scope_id().with("curve"), Sense::click_and_drag());
    let (edited, taken) =
        if input.editable { edit::edit(ui, &response, &chart, input, editing) } else { (None, false) };
    let curve = edited.as_deref().unwrap_or(input.curve);
    let painter = ui.painter();
    chart.paint(painter, &palette);
    for (k, s) in input.states.iter().enumerate() {
        let y = chart.screen(0.0, s.value).y;
        let stroke = if k == input.current { Stroke::new(1.5, palette.ink) } else { Stroke::new(0.5, palette.outline) };
        painter.hline(chart.area.x_range(), y, stroke);
    }
    chart.line(painter, curve.iter().map(|p| (p[0], p[1])), Stroke::new(2.2, palette.first));
    for (k, p) in curve.iter().enumerate().filter(|_| input.editable) {
        let at = chart.screen(p[0], p[1]);
        let chosen = editing.chosen == Some(k);
        let radius = if chosen { 5.5 } else { 3.5 };
        let edge = if chosen { palette.ink } else { palette.first };
        painter.circle(at, radius, palette.face, Stroke::new(2.0, edge));
    }
    let value = |index: usize| input.states.get(index).map_or(f64::NAN, |s| s.value);
    let trace = input.today.iter().map(|p| (p.profile_angle.unwrap_or(f64::NAN), value(p.state)));
    chart.line(painter, trace, Stroke::new(1.4, palette.sun));
    let mut used: Vec<Rect> = vec![];
    for p in input.today.iter().filter(|p| (p.hour - p.hour.round()).abs() < 1e-6) {
        let Some(psi) = p.profile_angle.filter(|psi| (0.0..=90.0).contains(psi)) else { continue };
        let at = chart.screen(psi, value(p.state));
        if !at.any_nan() {
            painter.circle(at, 3.0, palette.sun, Stroke::new(1.0, palette.ink));
            let place = Rect::from_center_size(at - vec2(0.0, 12.0), vec2(26.0, 13.0));
            if used.iter().all(|r| !r.intersects(place)) && chart.area.contains_rect(place) {
                used.push(on_halo(painter, place.center(), &format!("{:.0}h", p.hour), &palette));
            }
        }
    }
    for (k, s) in input.states.iter().enumerate() {
        // The states as dots on the far axis, where no numbers stand; the current one larger.
        let at = chart.screen(90.0, s.value);
        let spacing = chart.area.height() / input.states.len() as f32;
        let radius = if k == input.current { 6.0 } else { (0.45 * spacing).clamp(1.5, 4.0) };
        painter.circle(at, radius, state_colour(input, k), Stroke::new(1.5, palette.ink));
    }
    if let Some(psi) = input.profile_angle.filter(|psi| (0.0..=90.0).contains(psi)) {
        let at = chart.screen(psi, value(input.current));
        painter.vline(at.x, chart.area.y_range(), Stroke::new(1.5, palette.sun));
        if !at.any_nan() {
            painter.circle(at, 6.0, palette.sun, Stroke::new(1.5, Color32::BLACK));
        }
    }
    tile::name(ui, &response, "Control curve", &state_text(input, input.current));
    let nearest = |at| {
        let (_, v) = chart.value(at)?;
        let distance = |k: &usize| (input.states[*k].value - v).abs();
        (0..input.states.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    if response.clicked()
        && !taken
        && let Some(index) = response.interact_pointer_pos().and_then(nearest)
    {
        out.push(Action::ChooseState(index));
    }
    if let Some(k) = editing.chosen.filter(|_| response.has_focus() && input.editable)
        && let Some([angle, value]) = curve.get(k)
    {
        let text = format!("point {} of {}: {angle:.0}°, rule {}", k + 1, curve.len(), number(*value, 3));
        out.extend(edited.map(Action::EditCurve));
        return Some(text);
    }
    out.extend(edited.map(Action::EditCurve));
    let at = response.hover_pos()?;
    let (psi, _) = chart.value(at)?;
    let rule = curve_at(input.curve, psi).map_or_else(String::new, |v| format!(" · rule {}", number(v, 3)));
    Some(format!("profile angle {psi:.0}°{rule} · nearest {}", state_text(input, nearest(at)?)))
}

/// The rule at a profile angle, piecewise linear; held beyond its ends.
fn curve_at(curve: &[[f64; 2]], psi: f64) -> Option<f64> {
    let (first, last) = (curve.first()?, curve.last()?);
    if psi <= first[0] {
        return Some(first[1]);
    }
    let next = curve.iter().position(|p| p[0] >= psi);
    Some(next.map_or(last[1], |k| {
        let (a, b) = (curve[k - 1], curve[k]);
        if b[0] > a[0] { a[1] + (b[1] - a[1]) * (psi - a[0]) / (b[0] - a[0]) } else { b[1] }
    }))
}

fn year_ui(ui: &mut Ui, rect: Rect, input: &Input<'_>, state: &mut State, out: &mut Vec<Action>) -> Option<String> {
    let palette = Palette::of(ui.visuals());
    let legend = Rect::from_min_max(pos2(rect.left() + LEFT, rect.bottom() - 18.0), rect.max);
    let area = Rect::from_min_max(
        pos2(rect.left() + LEFT, rect.top() + 6.0),
        pos2(rect.right() - 10.0, (legend.top() - 18.0).max(rect.top() + 20.0)),
    );
    let days = input.year.len().div_ceil(24).max(DAYS);
    let response = ui.interact(area, ui.scope_id().with("year"), Sense::click());
    let size = vec2(area.width() / days as f32, area.height() / 24.0);
    let mesh = state.year.get((input.revision, area, ui.visuals().dark_mode), || {
        let mut mesh = Mesh::default();
        // Equal hours of neighbouring days are one rectangle: a year has a few hundred, not 8760.
        for hour in 0..24 {
            let at = |day: usize| input.year.get(day * 24 + hour).copied().flatten();
            let mut day = 0;
            while day < days {
                let (from, here) = (day, at(day));
                while day < days && at(day) == here {
                    day += 1;
                }
                if let Some(index) = here {
                    let min = pos2(area.left() + from as f32 * size.x, area.bottom() - (hour + 1) as f32 * size.y);
                    let place = Rect::from_min_size(min, vec2((day - from) as f32 * size.x, size.y));
                    mesh.add_colored_rect(place, state_colour(input, usize::from(index)));
                }
            }
        }
        Arc::new(mesh)
    });
    let painter = ui.painter();
    painter.rect_filled(area, 0, palette.face);
    painter.add(Shape::Mesh(mesh.clone()));
    painter.rect_stroke(area, 0, Stroke::new(1.0, palette.outline), StrokeKind::Outside);
    let small = FontId::proportional(11.0);
    let wide = area.width() > 300.0;
    for (month, day) in FIRST.iter().enumerate() {
        let x = area.left() + *day as f32 * size.x;
        painter.vline(x, area.bottom()..=area.bottom() + 3.0, Stroke::new(1.0, palette.weak));
        if wide || month % 3 == 0 {
            let name = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"][month];
            painter.text(pos2(x + 1.0, area.bottom() + 2.0), Align2::LEFT_TOP, name, small.clone(), palette.weak);
        }
    }
    for hour in [0, 6, 12, 18, 24] {
        let y = area.bottom() - hour as f32 * size.y;
        painter.text(
            pos2(area.left() - 5.0, y),
            Align2::RIGHT_CENTER,
            format!("{hour} h"),
            small.clone(),
            palette.weak,
        );
    }
    if let Some((day, hour)) = input.moment {
        let at = pos2(area.left() + (day as f32 + 0.5) * size.x, area.bottom() - hour as f32 * size.y);
        painter.circle(at, 4.5, palette.sun, Stroke::new(1.5, Color32::BLACK));
    }
    states_legend(ui, legend, input, &palette);
    tile::name(ui, &response, "Year map of states", "hour against day");
    let moment = |at: egui::Pos2| {
        let day = (((at.x - area.left()) / size.x).max(0.0) as usize).min(days - 1);
        (day, f64::from(((area.bottom() - at.y) / size.y).clamp(0.0, 23.99)))
    };
    if response.clicked()
        && let Some((day, hour)) = response.interact_pointer_pos().map(moment)
    {
        out.push(Action::ChooseMoment { day, hour: hour.floor() });
    }
    let (day, hour) = response.hover_pos().map(moment)?;
    let what = match input.year.get(day * 24 + hour as usize).copied().flatten() {
        Some(index) => state_text(input, usize::from(index)),
        None => "night".to_owned(),
    };
    Some(format!("day {} of {days}, {:.0} h · {what}", day + 1, hour.floor()))
}

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

/// The states of every hour of the year.
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("day,hour,state,value\n");
    for (k, index) in input.year.iter().enumerate() {
        let state = index.and_then(|i| input.states.get(usize::from(i)));
        let (key, value) =
            state.map_or((String::new(), String::new()), |s| (tile::csv_field(&s.key), s.value.to_string()));
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
