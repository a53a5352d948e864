//! Line plots in the window, by egui_plot: a drag moves the view, the wheel zooms, a drag with the right button zooms
//! to a box, a double click shows all data again. Points near the pointer show their values.
//!
//! The legend stands above the plot instead of in it, since in a small tile it would cover the data; it works as
//! egui_plot's does: a click hides a series, the pointer on a name emphasises it.

use super::palette::Palette;
use crate::drawing::plot::{Axis, Form, Plot, Series, crosses};
use egui::{
    Align, Align2, Color32, FontId, Id, Layout, Pos2, Rangef, Rect, Response, RichText, Sense, Shape, Stroke,
    StrokeKind, Ui, UiBuilder, Vec2, pos2, vec2,
};
use egui_plot::{
    AxisHints, CoordinatesFormatter, Corner, FilledArea, GridInput, GridMark, HoverPosition, Line, LineStyle,
    MarkerShape, PlotMemory, PlotPoint, PlotTransform, PlotUi, Points,
};

/// Space for ticks and labels to the left of the plotting area. \[points\]
pub const LEFT: f32 = 44.0;
/// Space to the right of the plotting area, for half of the last tick label. \[points\]
pub const RIGHT: f32 = 10.0;
/// Space under the plotting area: for tick labels alone, and for tick labels with the title of the axis. \[points\]
const BELOW: [f32; 2] = [17.0, 36.0];
/// Font size of tick labels and series names. \[points\]
const TICKS: f32 = 13.0;

/// Height of a line of text above the plot. \[points\]
const LINE: f32 = 18.0;

/// Appearance of a plot, and its response to the pointer.
#[derive(Debug, Clone, Copy)]
pub struct Look<'a> {
    /// Unique id of the plot, under which the visible ranges of its axes are stored between frames.
    pub id: Id,
    /// Colours of the series, in their order.
    pub colours: &'a [Color32],
    /// Colour of the guides, i.e. of the lines of fixed values to compare the series with.
    pub guide: Color32,
    /// Space for the tick labels to the left of the plotting area. \[points\]
    pub left: f32,
    /// [`id`](Self::id) of another plot whose legend also hides series of this plot; `None` if the plot has a separate
    /// legend.
    pub legend_of: Option<Id>,
    /// Whether the plot is part of a scrolled page: the wheel scrolls the page, zooming requires Ctrl, and the values
    /// under the pointer are shown in a corner of the plot.
    pub on_page: bool,
    /// Whether the plot takes the keyboard focus when clicked.
    pub focusable: bool,
    /// Whether drags and the wheel leave the ranges of the axes unchanged, because the caller uses them for something
    /// under the pointer, such as a point of a curve.
    pub held: bool,
    /// Whether series are distinguished by dashes as well as by colour.
    pub dashed: bool,
}

impl<'a> Look<'a> {
    /// Creates the appearance of a plot that fills a tile.
    pub fn tile(id: Id, colours: &'a [Color32], guide: Color32) -> Self {
        Self {
            id,
            colours,
            guide,
            left: LEFT,
            legend_of: None,
            on_page: false,
            focusable: false,
            held: false,
            dashed: false,
        }
    }

    /// Returns the length of the dashes of a series by its index \[points\]; `None` for a solid line.
    fn dash(&self, series: usize) -> Option<f32> {
        const DASHES: [Option<f32>; 3] = [None, Some(10.0), Some(4.0)];
        DASHES[series % 3].filter(|_| self.dashed)
    }

    fn colour(&self, series: usize) -> Color32 {
        self.colours.get(series % self.colours.len().max(1)).copied().unwrap_or(self.guide)
    }
}

/// Plot as it was drawn in this frame.
#[derive(Debug, Clone)]
pub struct Shown {
    /// Response of the plotting area.
    pub response: Response,
    /// Transform between coordinates of the axes and screen positions.
    pub transform: PlotTransform,
    /// Names of the series that the user has hidden by the legend.
    pub hidden: Vec<String>,
}

impl Shown {
    /// Returns the transform between coordinates of the axes and screen positions that a plot, given by its id, had in
    /// the last frame; `None` if it was not drawn.
    pub fn transform_before(ui: &Ui, id: Id) -> Option<PlotTransform> {
        PlotMemory::load(ui.ctx(), id).map(|memory| memory.transform())
    }

    /// Returns the rectangle of the plotting area on the screen.
    pub fn area(&self) -> Rect {
        *self.transform.frame()
    }

    /// Returns the screen position of a point, given in coordinates (x, y) of the axes.
    pub fn screen(&self, point: [f64; 2]) -> Pos2 {
        screen(&self.transform, point)
    }

    /// Returns the coordinates (x, y) of the axes at a screen position.
    pub fn coordinates(&self, at: Pos2) -> [f64; 2] {
        let point = self.transform.value_from_position(at);
        [point.x, point.y]
    }

    /// Returns the coordinates (x, y) of the axes at which the plot was clicked in this frame; `None` without a click.
    pub fn clicked(&self) -> Option<[f64; 2]> {
        let at = self.response.interact_pointer_pos().filter(|_| self.response.clicked());
        at.map(|at| self.coordinates(at))
    }

    /// Returns the coordinates (x, y) of the axes under the pointer; `None` if the pointer is not on the plot.
    pub fn pointed(&self) -> Option<[f64; 2]> {
        self.response.hover_pos().map(|at| self.coordinates(at))
    }
}

/// Returns the screen position of a point, given in coordinates (x, y) of the axes.
pub fn screen(transform: &PlotTransform, [x, y]: [f64; 2]) -> Pos2 {
    transform.position_from_point(&PlotPoint::new(x, y))
}

/// Draws a plot into a rectangle, which also holds ticks, labels and legend; `under` draws what lies behind the series,
/// such as a picture.
pub fn show(ui: &mut Ui, rect: Rect, plot: &Plot, look: &Look<'_>, under: impl FnOnce(&mut PlotUi<'_>)) -> Shown {
    let palette = Palette::of(ui.visuals());
    let hidden_id = look.legend_of.unwrap_or(look.id).with("hidden");
    let mut hidden: Vec<String> = ui.data(|data| data.get_temp(hidden_id)).unwrap_or_default();
    let (head, lit) = head(ui, rect, plot, look, &palette, &mut hidden);
    ui.data_mut(|data| data.insert_temp(hidden_id, hidden.clone()));
    let top = (head + 2.0).min(rect.bottom() - 1.0);
    let body = Rect::from_min_max(pos2(rect.left(), top), pos2(rect.right() - RIGHT, rect.bottom()));
    let mut child = ui.new_child(UiBuilder::new().max_rect(body).id_salt(look.id));
    let ([left, right], [low, high]) = (plot.x.ends(), plot.y.ends());
    let first = PlotMemory::load(ui.ctx(), look.id).is_none();
    let words =
        |point: &PlotPoint| format!("{} · {}", plot.x.text(plot.x.value(point.x)), plot.y.text(plot.y.value(point.y)));
    let sense = if look.focusable { Sense::click_and_drag() } else { Sense::CLICK | Sense::DRAG };
    // A name that does not fit under the plot would run into its neighbours.
    let middle = 0.5 * (body.left() + look.left + body.right());
    let reach = (rect.right() - middle).min(middle - rect.left());
    let x_title = Some(plot.x.title()).filter(|title| {
        let galley = ui.painter().layout_no_wrap(title.clone(), FontId::proportional(TICKS), palette.weak);
        0.5 * galley.size().x <= reach
    });
    let x_title = x_title.unwrap_or_else(|| plot.x.short_title());
    let titled = !x_title.is_empty();
    let mut chart = egui_plot::Plot::new("plot")
        .id(look.id)
        .default_x_bounds(left, right)
        .default_y_bounds(low, high)
        .custom_x_axes(vec![
            hints(AxisHints::new_x(), &plot.x, &palette, BELOW[usize::from(titled)])
                .label(RichText::new(x_title).size(13.0).color(palette.weak)),
        ])
        .custom_y_axes(vec![hints(AxisHints::new_y(), &plot.y, &palette, look.left).formatter(|mark, range| {
            let text = plot.y.tick(mark.value, mark.step_size);
            let corner = mark.value < range.start() + 0.02 * (range.end() - range.start());
            // A long word in the corner would run into that of x.
            if corner && text.chars().count() > 2 { String::new() } else { text }
        })])
        .x_grid_spacer(|input| marks(&plot.x, &input, 48.0))
        .y_grid_spacer(|input| marks(&plot.y, &input, 26.0))
        .grid_color(palette.grid)
        .grid_fade(0.0)
        .label_formatter(|hover| match hover {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                Some(format!("{plot_name}\n{}", words(position)))
            }
            HoverPosition::Elsewhere { .. } => None,
        })
        .show_background(false)
        .sense(sense)
        .allow_scroll(false)
        .allow_drag(!look.held)
        .allow_double_click_reset(!look.held);
    if look.on_page {
        chart = chart.coordinates_formatter(Corner::LeftBottom, CoordinatesFormatter::new(|point, _| words(point)));
    }
    let gone = &hidden;
    let drawn = chart.show(&mut child, |plot_ui| {
        if first {
            // From the start as after a double click: the view follows the axes until it is moved.
            plot_ui.set_auto_bounds(true);
        }
        let wheel = plot_ui.ctx().input(|input| input.smooth_scroll_delta.y);
        if plot_ui.response().hovered() && !look.on_page && wheel != 0.0 {
            plot_ui.zoom_bounds_around_hovered(Vec2::splat((wheel / 200.0).exp()));
        }
        under(plot_ui);
        for guide in &plot.guides {
            let ends: Vec<[f64; 2]> = guide.ends.iter().filter_map(|end| plot.place(*end)).collect();
            let line = Line::new("", ends).color(look.guide).width(1.0).style(LineStyle::dashed_dense());
            plot_ui.line(line.allow_hover(false));
        }
        // The first is the most important: on top.
        for (k, series) in plot.series.iter().enumerate().rev() {
            if !gone.contains(&series.name) {
                add(plot_ui, plot, series, (look.colour(k), look.dash(k)), lit == Some(k));
            }
        }
    });
    let shown = Shown { response: drawn.response, transform: drawn.transform, hidden };
    ui.painter().rect_stroke(shown.area(), 0, Stroke::new(1.0, palette.outline), StrokeKind::Middle);
    name_guides(ui, plot, look, &shown);
    shown
}

/// Draws the title of the y axis and, for more than one series, the legend, in as many lines as the width requires.
/// Returns the screen position of their lower edge \[points\], and the index of the series whose name is under the
/// pointer.
fn head(
    ui: &mut Ui,
    rect: Rect,
    plot: &Plot,
    look: &Look<'_>,
    palette: &Palette,
    hidden: &mut Vec<String>,
) -> (f32, Option<usize>) {
    let own = look.legend_of.is_none() && plot.series.len() > 1;
    if !own && plot.y.title().is_empty() {
        return (rect.top() + 4.0, None);
    }
    let layout = Layout::left_to_right(Align::Center).with_main_wrap(true);
    let line = rect.with_max_y(rect.top() + LINE);
    let mut head = ui.new_child(UiBuilder::new().max_rect(line).layout(layout).id_salt(look.id.with("legend")));
    head.spacing_mut().item_spacing = vec2(9.0, 1.0);
    head.spacing_mut().interact_size.y = LINE;
    head.add_space(4.0);
    head.label(RichText::new(plot.y.title()).size(13.0).color(palette.weak));
    let mut lit = None;
    for (k, series) in plot.series.iter().enumerate().filter(|_| own) {
        let shown = !hidden.contains(&series.name);
        let colour = if shown { look.colour(k) } else { palette.grid };
        let response = entry(&mut head, &series.name, (colour, look.dash(k)), palette);
        response.widget_info(|| {
            egui::WidgetInfo::selected(egui::accesskit::Role::CheckBox, true, shown, series.name.as_str())
        });
        if response.clicked() && shown {
            hidden.push(series.name.clone());
        } else if response.clicked() {
            hidden.retain(|name| *name != series.name);
        }
        lit = response.hovered().then_some(k).or(lit);
    }
    (head.min_rect().bottom(), lit)
}

/// Draws the entry of a series in the legend: a line in its colour and with its dashes, and its name.
fn entry(ui: &mut Ui, name: &str, (colour, dash): (Color32, Option<f32>), palette: &Palette) -> Response {
    let swatch = if dash.is_some() { 28.0 } else { 16.0 };
    let galley = ui.painter().layout_no_wrap(name.to_owned(), FontId::proportional(TICKS), palette.ink);
    let (rect, response) = ui.allocate_exact_size(vec2(swatch + galley.size().x, LINE), Sense::click());
    let y = rect.center().y;
    let (ends, stroke) = ([pos2(rect.left(), y), pos2(rect.left() + swatch - 4.0, y)], Stroke::new(3.0, colour));
    match dash {
        Some(length) => ui.painter().extend(Shape::dashed_line(&ends, stroke, 0.8 * length, 0.5 * length)),
        None => {
            ui.painter().line_segment(ends, stroke);
        }
    }
    let ink = if response.hovered() || response.has_focus() { palette.first } else { palette.ink };
    ui.painter().galley_with_override_text_color(pos2(rect.left() + swatch, y - 0.5 * galley.size().y), galley, ink);
    response
}

/// Returns the hints of egui_plot for an axis, completed by its tick labels, its colour and the space it takes
/// \[points\].
fn hints<'a>(hints: AxisHints<'a>, axis: &'a Axis, palette: &Palette, room: f32) -> AxisHints<'a> {
    // The spacers thin the ticks already.
    hints
        .formatter(move |mark, _| axis.tick(mark.value, mark.step_size))
        .label_spacing(Rangef::new(8.0, 9.0))
        .min_thickness(room)
        .tick_label_color(palette.weak)
        .tick_label_font(FontId::proportional(TICKS))
}

/// Returns the ticks of an axis, at least about `distance` \[points\] apart.
fn marks(axis: &Axis, input: &GridInput, distance: f64) -> Vec<GridMark> {
    let (lo, hi) = input.bounds;
    // The base step is eight points.
    let count = ((hi - lo) / input.base_step_size * 8.0 / distance).clamp(1.0, 100.0);
    let places = axis.marks([lo, hi], count as usize);
    let step = places.windows(2).map(|pair| pair[1] - pair[0]).fold(hi - lo, f64::min);
    let inside = places.into_iter().filter(|value| (lo..=hi).contains(value));
    inside.map(|value| GridMark { value, step_size: step }).collect()
}

/// Adds a series to egui_plot as one line for every run of finite values, because egui_plot accepts no others. `lit`:
/// whether the series is emphasised.
fn add(plot_ui: &mut PlotUi<'_>, plot: &Plot, series: &Series, (colour, dash): (Color32, Option<f32>), lit: bool) {
    for band in plot.bands(series) {
        let column = |k: usize| -> Vec<f64> { band.iter().map(|point| point[k]).collect() };
        let area = FilledArea::new(&series.name, &column(0), &column(1), &column(2));
        plot_ui.add(area.fill_color(colour.gamma_multiply(0.18)).allow_hover(false));
    }
    for run in plot.runs(series) {
        let points = |radius: f32| Points::new(&series.name, run.clone()).color(colour).radius(radius).highlight(lit);
        match series.form {
            Form::Line => {}
            Form::Marked => plot_ui.points(points(3.5).shape(MarkerShape::Square)),
            Form::Dots => plot_ui.points(points(1.5)),
        }
        if series.form != Form::Dots {
            let style = dash.map_or(LineStyle::Solid, |length| LineStyle::Dashed { length });
            plot_ui.line(Line::new(&series.name, run).color(colour).width(2.0).style(style).highlight(lit));
        }
    }
}

/// Draws the names of the guides (lines of fixed values) near their right ends where no series passes, except names
/// that another guide would cross.
fn name_guides(ui: &Ui, plot: &Plot, look: &Look<'_>, shown: &Shown) {
    let area = shown.area();
    let ends = || plot.guides.iter().filter_map(|guide| Some((guide, shown.screen(plot.place(guide.ends[1])?))));
    let on_screen = |run: Vec<[f64; 2]>| -> Vec<[f64; 2]> {
        run.into_iter().map(|point| shown.screen(point)).map(|at| [f64::from(at.x), f64::from(at.y)]).collect()
    };
    let lines: Vec<_> = plot.series.iter().flat_map(|series| plot.runs(series)).map(on_screen).collect();
    let ends_of = |range: Rangef| [f64::from(range.min), f64::from(range.max)];
    let mut used: Vec<Rect> = vec![];
    for (guide, end) in ends().filter(|(guide, _)| !guide.name.is_empty()) {
        let galley = ui.painter().layout_no_wrap(guide.name.clone(), FontId::proportional(TICKS), look.guide);
        let at = pos2(end.x.min(area.right()) - 4.0, end.y.max(area.top() + galley.size().y));
        // Over its line at the right end; where another name or line is, further to the left.
        let step = if guide.is_level() { 8.0 } else { galley.size().x + 8.0 };
        let count = if guide.is_level() { (area.width() / step) as u32 } else { 4 };
        let places = (0..count).map(|k| at - vec2(step * k as f32, 0.0));
        let free: Vec<Rect> = places
            .filter_map(|at| {
                let place = Align2::RIGHT_BOTTOM.anchor_size(at, galley.size());
                let crossed = ends().any(|(_, other)| other.y != end.y && place.y_range().contains(other.y));
                let is_free = used.iter().all(|other| !other.intersects(place));
                (area.contains_rect(place) && !crossed && is_free).then_some(place)
            })
            .collect();
        let passed =
            |place: &&Rect| guide.is_level() && crosses(&lines, ends_of(place.x_range()), ends_of(place.y_range()));
        if let Some(place) = free.iter().find(|place| !passed(place)).or(free.first()) {
            ui.painter().galley(place.min, galley, look.guide);
            used.push(*place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::plot::Unit;

    #[test]
    fn ticks_lie_inside_and_apart_at_every_zoom() {
        let axes = [
            Axis::linear([0.0, 1.0], "", Unit::Named("m")),
            Axis::linear([0.0, 1.0], "", Unit::Degrees),
            Axis::log([0.1, 10.0], "", Unit::Share),
        ];
        for axis in &axes {
            for zoom in -12..5 {
                for from in [-3.3, 0.0, 0.123] {
                    let width = 10_f64.powi(zoom);
                    let bounds = (from, from + width);
                    let ticks = marks(axis, &GridInput { bounds, base_step_size: width / 300.0 * 8.0 }, 48.0);
                    assert!(ticks.len() < 14, "{axis:?} {bounds:?}: {}", ticks.len());
                    assert!(ticks.iter().all(|tick| (bounds.0..=bounds.1).contains(&tick.value)));
                }
            }
        }
    }
}
