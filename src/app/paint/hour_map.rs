//! A map of the hours of a year in the window (day of year by hour of day): a picture between axes, its legend under
//! it, and a marked hour that pointer and arrow keys choose.

use super::colour_scale::{ColourScaleExt as _, LEGEND_HEIGHT};
use super::palette::Palette;
use super::plot::{self, LEFT, Look};
use super::tile;
use crate::drawing::Rgb;
use crate::drawing::hour_map::{Colours, HourMap, name_colour};
use crate::texts::year as say;
use egui::{
    Align2, Color32, ColorImage, EventFilter, FontId, Id, Key, Modifiers, Rect, Response, Stroke, StrokeKind,
    TextureHandle, TextureOptions, Ui, pos2, vec2,
};
use egui_plot::{PlotImage, PlotPoint};

/// Texture of the map's picture, freed with this value.
#[derive(Clone)]
struct Picture(TextureHandle);

impl std::fmt::Debug for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple(stringify!(Picture)).field(&self.0.size()).finish()
    }
}

/// State of an hour map between frames.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Picture of the map, with the revision of the map it shows and whether the theme was dark.
    picture: Option<((u64, bool), Picture)>,
}

/// Input of an hour map in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Map to draw, with a value or state for every cell.
    pub map: &'a HourMap,
    /// Revision number of the map, which changes whenever the map does; the picture is then made again.
    pub revision: u64,
    /// Index of the marked cell, if one is marked.
    pub mark: Option<usize>,
    /// Whether the map is part of a scrolled page, so that the wheel scrolls the page instead of zooming the map.
    pub on_page: bool,
}

/// Cells that the user clicked, reached or pointed at in one frame.
#[derive(Debug, Clone, Copy, Default)]
pub struct Answer {
    /// Index of the cell that was clicked.
    pub picked: Option<usize>,
    /// Index of the cell that arrow keys moved to.
    pub walked: Option<usize>,
    /// Index of the cell under the pointer.
    pub pointed: Option<usize>,
}

const fn colour([r, g, b]: Rgb) -> Color32 {
    Color32::from_rgb(r, g, b)
}

fn picture(ui: &Ui, map: &HourMap, empty: Color32) -> Picture {
    let cells = (0..map.rows).rev().flat_map(|row| (0..map.days).map(move |day| day * map.rows + row));
    let pixels = cells.map(|cell| map.colour(cell).map_or(empty, colour)).collect();
    let image = ColorImage::new([map.days, map.rows], pixels);
    Picture(ui.ctx().load_texture("map-of-hours", image, TextureOptions::NEAREST))
}

/// Draws an hour map and its legend into a rectangle.
pub fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, state: &mut State) -> Answer {
    let palette = Palette::of(ui.visuals());
    let map = input.map;
    let (above, below) = rect.split_top_bottom_at_y(rect.bottom() - LEGEND_HEIGHT);
    let key = (input.revision, ui.visuals().dark_mode);
    if state.picture.as_ref().is_none_or(|(old, _)| *old != key) {
        state.picture = Some((key, picture(ui, map, palette.face)));
    }
    let texture = state.picture.as_ref().map(|(_, picture)| picture.0.id());
    let plot = map.plot();
    let id = ui.scope_id().with("hours");
    let look = Look { on_page: input.on_page, focusable: true, ..Look::tile(id, &[], palette.sun) };
    let (middle, size) = (PlotPoint::new(0.5 * map.days as f64, 12.0), [map.days as f32, 24.0]);
    let shown = plot::show(ui, above, &plot, &look, |plot_ui| {
        if let Some(texture) = texture {
            plot_ui.image(PlotImage::new("", texture, middle, size).allow_hover(false));
        }
    });
    if let Some(cell) = input.mark {
        let at = shown.screen(map.middle(cell));
        let painter = ui.painter().with_clip_rect(shown.area().expand(6.0).intersect(ui.clip_rect()));
        painter.circle_stroke(at, 5.0, Stroke::new(2.5, palette.sun));
        painter.circle_stroke(at, 6.5, Stroke::new(1.0, Color32::BLACK));
    }
    if shown.response.has_focus() {
        let stroke = Stroke::new(2.0, palette.first);
        ui.painter().rect_stroke(shown.area(), 0, stroke, StrokeKind::Outside);
    }
    let text = input.mark.map_or_else(|| say::NO_MARK.into(), |cell| spoken(map, cell));
    tile::name(ui, &shown.response, say::map_of(&map.name), &text);
    let of = |[day, hour]: [f64; 2]| map.at(day, hour);
    let clicked = shown.clicked().map(of);
    if clicked.is_some() {
        shown.response.request_focus();
    }
    let walked = keys(ui, &shown.response, input, id);
    let pointed = shown.pointed().map(of);
    let value = pointed.map(|cell| map.values[cell]).filter(|value| value.is_finite());
    let legend = below.with_min_x(rect.left() + LEFT - 14.0);
    match &map.colours {
        Colours::Scale(scale, unit) => scale.paint_legend(ui.painter(), legend, unit, value, &palette),
        Colours::Names(names) => names_legend(ui, legend.with_min_x(rect.left() + LEFT), names, &palette),
    }
    Answer { picked: clicked, walked, pointed }
}

/// Returns date, hours and value of a cell as text: `21 Jun, 12:00–13:00: 512 lx`.
pub fn spoken(map: &HourMap, cell: usize) -> String {
    say::cell_is(map.when(cell), map.words(cell))
}

/// Returns the cell to which arrow keys move the mark: by an hour (up, down) or a day (left, right), with Shift by
/// three hours or thirty days. `None` without a key.
fn keys(ui: &Ui, response: &Response, input: &Input<'_>, id: Id) -> Option<usize> {
    if !response.has_focus() {
        return None;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let map = input.map;
    let hour = (map.rows / 24).max(1) as i32;
    // Right is later by days as the map has it, up is later by hours.
    let ways = [
        (Key::ArrowRight, [1, 0], [30, 0]),
        (Key::ArrowLeft, [-1, 0], [-30, 0]),
        (Key::ArrowUp, [0, hour], [0, 3 * hour]),
        (Key::ArrowDown, [0, -hour], [0, -3 * hour]),
    ];
    let step = ui.input_mut(|i| {
        ways.into_iter().find_map(|(key, step, more)| {
            if i.consume_key(Modifiers::SHIFT, key) {
                Some(more)
            } else {
                i.consume_key(Modifiers::NONE, key).then_some(step)
            }
        })
    });
    let [days, rows] = step?;
    // Without a mark the first key begins in the middle of the year; the next ones continue from there.
    let kept = id.with("walked");
    let from = input.mark.or_else(|| ui.data(|data| data.get_temp(kept)));
    let next = match from {
        Some(cell) => map.beside(cell, days, rows)?,
        None => map.at(0.5 * map.days as f64, 12.0),
    };
    ui.data_mut(|data| data.insert_temp(kept, next));
    Some(next)
}

/// Draws the legend of a map of states: a coloured square and the name of each state; if not all names fit, every n-th
/// of them.
fn names_legend(ui: &Ui, rect: Rect, names: &[String], palette: &Palette) {
    let font = FontId::proportional(13.0);
    let width = |text: &str| ui.painter().layout_no_wrap(text.to_owned(), font.clone(), palette.ink).size().x;
    let widest = names.iter().map(|name| width(name)).fold(0.0, f32::max) + 26.0;
    let room = (rect.width() / widest).max(1.0) as usize;
    for (place, k) in (0..names.len()).step_by(names.len().div_ceil(room).max(1)).enumerate() {
        let at = pos2(rect.left() + place as f32 * widest, rect.top() + 10.0);
        let swatch = Rect::from_min_size(at - vec2(0.0, 5.0), vec2(10.0, 10.0));
        let fill = colour(name_colour(names.len(), k));
        ui.painter().rect(swatch, 1, fill, Stroke::new(1.0, palette.outline), StrokeKind::Middle);
        ui.painter().text(at + vec2(15.0, 0.0), Align2::LEFT_CENTER, &names[k], font.clone(), palette.ink);
    }
}
