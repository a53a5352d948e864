//! Strip of the states of a product: for each state a small picture of its section (or of its slat angle or
//! transmittance) over its name.

use super::Cache;
use crate::app::display::theme;
use crate::app::paint::polygon::fill;
use crate::compute::system::SystemDescription;
use crate::texts::{fixed, tiles as say};
use egui::{FontId, Painter, Pos2, Rect, ScrollArea, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, pos2, vec2};

/// Number of periods of a system in the picture of a state: a single slat does not show how slats overlap.
const PERIODS: usize = 2;
/// Width and height of a state in the strip, with its name. \[points\]
const CELL: Vec2 = vec2(48.0, 54.0);
/// Height of the picture of a state. \[points\]
const PICTURE: f32 = 34.0;
/// Gap between two neighbouring states. \[points\]
const GAP: f32 = 3.0;
/// Maximum number of visible rows of states; others are reached by scrolling.
const MOST_ROWS: usize = 2;

/// State of a product in the strip.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Key of the state in the product.
    pub key: String,
    /// Name of the state for users, e.g. `-35°`.
    pub words: String,
    /// Slat angle of the state \[°\]; `None` if it is unknown.
    pub angle: Option<f64>,
    /// Luminous transmittance of the state under uniform diffuse light; `None` if it is unknown.
    pub tau: Option<f64>,
}

/// Input of the strip in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Key of the product, and text of the system description it was computed from; pictures are made again when one of
    /// them changes.
    pub product: [&'a str; 2],
    /// Function that parses the text of the description; `None` if it is not one.
    pub describe: fn(&str) -> Option<SystemDescription>,
    /// States of the product in their order.
    pub marks: &'a [Mark],
    /// Index of the state that is set; `None` if none is.
    pub shown: Option<usize>,
}

/// Picture of a state in the strip.
#[derive(Debug, Clone, PartialEq)]
enum Picture {
    /// Section: polygons with corners as (outward, upward), within a square of side 1 centred at 0.
    Section(Vec<Vec<[f64; 2]>>),
    /// Slats, by their angle \[rad\].
    Slats(f64),
    /// Pane, by its luminous transmittance.
    Pane(f64),
    /// No picture, because neither section nor angle nor transmittance is known.
    Nothing,
}

/// Cached pictures and scroll position of the strip between frames.
#[derive(Debug, Clone, Default)]
pub struct State {
    pictures: Cache<[String; 2], Vec<Picture>>,
    /// Key of the product and index of the state that the strip was last scrolled to.
    seen: Option<(String, Option<usize>)>,
}

/// Returns the sections of all states at a common scale, so that they can be compared; `None` if a state has no
/// section.
fn sections(system: &SystemDescription, marks: &[Mark]) -> Option<Vec<Picture>> {
    let family = system.family();
    let period = family.drawing_period().unwrap_or(0.0);
    let count = if period > 0.0 { PERIODS } else { 1 };
    let stacked = |mark: &Mark| -> Vec<Vec<[f64; 2]>> {
        let one = family.drawing(&mark.key);
        let lifted = |k: usize| {
            one.iter()
                .map(move |polygon| polygon.iter().map(|[z, y]| [*z, y + k as f64 * period]).collect::<Vec<[f64; 2]>>())
        };
        (0..count).flat_map(lifted).collect()
    };
    let all: Vec<Vec<Vec<[f64; 2]>>> = marks.iter().map(stacked).collect();
    if all.iter().any(Vec::is_empty) {
        return None;
    }
    let points = || all.iter().flatten().flatten();
    let range = |axis: usize| {
        points().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], point| [a.min(point[axis]), b.max(point[axis])])
    };
    let [z, y] = [range(0), range(1)];
    let size = (z[1] - z[0]).max(y[1] - y[0]);
    if !(size.is_finite() && size > 0.0) {
        return None;
    }
    let middle = [0.5 * (z[0] + z[1]), 0.5 * (y[0] + y[1])];
    let scaled = |[z, y]: [f64; 2]| [(z - middle[0]) / size, (y - middle[1]) / size];
    let picture = |polygons: Vec<Vec<[f64; 2]>>| {
        Picture::Section(polygons.into_iter().map(|polygon| polygon.into_iter().map(scaled).collect()).collect())
    };
    Some(all.into_iter().map(picture).collect())
}

fn pictures(input: &Input<'_>) -> Vec<Picture> {
    let described = (input.describe)(input.product[1]).and_then(|system| sections(&system, input.marks));
    described.unwrap_or_else(|| {
        let glyph = |mark: &Mark| match (mark.angle, mark.tau) {
            (Some(angle), _) => Picture::Slats(angle.to_radians()),
            (None, Some(tau)) => Picture::Pane(tau),
            (None, None) => Picture::Nothing,
        };
        input.marks.iter().map(glyph).collect()
    })
}

fn in_a_row(width: f32) -> usize {
    (((width + GAP) / (CELL.x + GAP)).floor() as usize).max(1)
}

/// Returns the height of a strip of `states` states in a panel of a width. \[points\]
pub fn height(width: f32, states: usize) -> f32 {
    let rows = states.div_ceil(in_a_row(width)).clamp(1, MOST_ROWS);
    rows as f32 * (CELL.y + GAP)
}

/// Draws the strip. Returns the index of the state that was clicked in this frame.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Option<usize> {
    let pictures = state.pictures.get(input.product.map(str::to_owned), || pictures(input));
    let seen = Some((input.product[0].to_owned(), input.shown));
    let bring = state.seen != seen;
    state.seen = seen;
    let mut clicked = None;
    let area = ScrollArea::vertical().id_salt("states").max_height(height(ui.available_width(), input.marks.len()));
    area.auto_shrink([false, true]).show(ui, |ui| {
        ui.spacing_mut().item_spacing = Vec2::splat(GAP);
        ui.horizontal_wrapped(|ui| {
            for (place, (mark, picture)) in input.marks.iter().zip(pictures).enumerate() {
                let chosen = input.shown == Some(place);
                let response = cell(ui, mark, picture, chosen);
                if response.clicked() {
                    clicked = Some(place);
                }
                if (bring && chosen) || response.gained_focus() {
                    response.scroll_to_me(None);
                }
            }
        });
    });
    clicked
}

/// Draws one state: its picture over its name.
fn cell(ui: &mut Ui, mark: &Mark, picture: &Picture, chosen: bool) -> egui::Response {
    let palette = theme::palette(ui);
    let (rect, response) = ui.allocate_exact_size(CELL, Sense::click());
    let tip = match mark.tau {
        Some(tau) => say::state_tau(&mark.words, fixed(tau, 2)),
        None => say::state_named(&mark.words),
    };
    let response = response.on_hover_text(tip);
    response.widget_info(|| {
        let label = say::state_named(&mark.words);
        egui::WidgetInfo::selected(egui::accesskit::Role::RadioButton, true, chosen, label)
    });
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let painter = ui.painter_at(rect);
    let fill = if chosen { palette.chosen } else { palette.raised };
    let edge = match (response.has_focus(), chosen || response.hovered()) {
        (true, _) => Stroke::new(2.0, palette.accent),
        (false, true) => Stroke::new(1.0, palette.accent),
        (false, false) => Stroke::NONE,
    };
    painter.rect(rect, 4, fill, edge, StrokeKind::Inside);
    let place = Rect::from_min_size(rect.min + vec2(4.0, 3.0), vec2(CELL.x - 8.0, PICTURE));
    draw(&painter, place, picture, palette, fill);
    let galley = theme::one_line(&painter, &mark.words, FontId::proportional(13.0), palette.text, CELL.x - 4.0);
    let at = pos2(rect.center().x - 0.5 * galley.size().x, rect.bottom() - 1.0 - galley.size().y);
    painter.galley(at, galley, palette.text);
    response
}

/// Draws the picture of a state into a rectangle.
fn draw(painter: &Painter, rect: Rect, picture: &Picture, palette: &theme::Palette, ground: egui::Color32) {
    let line = Stroke::new(1.2, palette.text);
    let (middle, size) = (rect.center(), rect.width().min(rect.height()));
    match picture {
        Picture::Section(polygons) => {
            // Outside is on the left: outward runs to the left.
            let place = |[z, y]: &[f64; 2]| middle - size * vec2(*z as f32, *y as f32);
            for polygon in polygons {
                let corners: Vec<Pos2> = polygon.iter().map(place).collect();
                painter.add(Shape::mesh(fill(&corners, palette.weak)));
                painter.add(Shape::closed_line(corners, line));
            }
        }
        Picture::Slats(angle) => {
            // An angle above 0 lowers the outer edge, on the left.
            let half = 0.28 * size * vec2(angle.cos() as f32, -angle.sin() as f32);
            for k in [-1.0, 0.0, 1.0] {
                let at = middle + vec2(0.0, 0.34 * size * k);
                painter.line_segment([at - half, at + half], Stroke::new(2.0, palette.text));
            }
        }
        Picture::Pane(tau) => {
            let pane = Rect::from_center_size(middle, vec2(0.5, 0.85) * size);
            let dark = palette.text.lerp_to_gamma(ground, tau.clamp(0.0, 1.0) as f32);
            painter.rect(pane, 2, dark, line, StrokeKind::Inside);
        }
        Picture::Nothing => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{builtin_system, moving_part};

    fn marks(keys: &[&str]) -> Vec<Mark> {
        let mark = |key: &&str| Mark {
            key: (*key).to_owned(),
            words: format!("{key}°"),
            angle: key.parse().ok(),
            tau: Some(0.5),
        };
        keys.iter().map(mark).collect()
    }

    fn of(name: &str, keys: &[&str]) -> Vec<Picture> {
        let text = builtin_system(name).map_or("", |(_, text)| text);
        let marks = marks(keys);
        pictures(&Input { product: ["x", text], describe: moving_part, marks: &marks, shown: None })
    }

    #[test]
    fn slats_are_drawn_in_one_scale_also_within_a_glazing() {
        for name in ["venetian-80-72.system.toml", "low-e-double-interior-blind.system.toml"] {
            let pictures = of(name, &["0", "45", "75"]);
            let size = |picture: &Picture| match picture {
                Picture::Section(polygons) => {
                    assert_eq!(polygons.len(), PERIODS, "{name}");
                    let z = polygons.iter().flatten().map(|point| point[0]);
                    assert!(polygons.iter().flatten().flatten().all(|x| x.abs() <= 0.5 + 1e-9));
                    z.clone().fold(f64::MIN, f64::max) - z.fold(f64::MAX, f64::min)
                }
                other => panic!("{name}: {other:?}"),
            };
            // A slat is less deep the more it is turned.
            assert!(size(&pictures[0]) > size(&pictures[1]) && size(&pictures[1]) > size(&pictures[2]), "{name}");
        }
    }

    #[test]
    fn without_a_description_the_angle_is_drawn_and_without_one_how_clear_a_pane_is() {
        assert_eq!(of("none", &["-35"]), [Picture::Slats((-35_f64).to_radians())]);
        assert_eq!(of("none", &["clear"]), [Picture::Pane(0.5)]);
    }

    #[test]
    fn the_strip_is_no_higher_than_two_rows() {
        assert_eq!(height(260.0, 3), CELL.y + GAP);
        assert_eq!(height(260.0, 21), 2.0 * (CELL.y + GAP));
        assert_eq!(height(1200.0, 21), CELL.y + GAP);
    }
}
