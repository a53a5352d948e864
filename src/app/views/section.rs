//! View of a described system in section: three periods, with the outside at the left and the inside at the right, a
//! scale bar and a ray of the sun.

use super::Cache;
use crate::app::display::theme;
use crate::app::paint::polygon::fill;
use crate::compute::system::{SystemDescription, SystemKind};
use crate::texts::{Text, decimal, tiles as say};
use egui::{Align2, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, pos2, vec2};

/// Number of periods of the system that are drawn.
const PERIODS: usize = 3;
/// Free space at the left and right of the drawing, for text and ray. \[points\]
const SIDE: f32 = 62.0;
/// Free space above and below the drawing. \[points\]
const EDGE: f32 = 26.0;
/// Length of the drawn ray of the sun. \[points\]
const RAY: f32 = 52.0;

/// Cached polygons of the section between frames.
#[derive(Debug, Clone, Default)]
pub struct State {
    outlines: Cache<(u64, usize), Vec<Vec<[f64; 2]>>>,
}

/// Input of the section in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Described system; `None` without a valid description.
    pub system: Option<&'a SystemDescription>,
    /// Revision number of the description, which changes whenever it does.
    pub revision: u64,
    /// Index of the system's state that is drawn.
    pub state: usize,
    /// Angle of the sun's ray to the normal in the section, positive from above (from the right in a horizontal
    /// section); `None` if it is not drawn. \[rad\]
    pub sun: Option<f64>,
}

/// Returns the polygons of all periods drawn, with corners as (outward, upward) \[m\].
fn stacked(system: &SystemDescription, state: usize) -> Vec<Vec<[f64; 2]>> {
    let states = system.states();
    let one = states.get(state).map(|state| system.family().drawing(state)).unwrap_or_default();
    let Some(period) = system.family().drawing_period() else { return one };
    let lifted = |k: usize, polygon: &Vec<[f64; 2]>| {
        let lift = k as f64 * period;
        polygon.iter().map(|[z, y]| [*z, y + lift]).collect()
    };
    (0..PERIODS).flat_map(|k| one.iter().map(move |polygon| lifted(k, polygon))).collect()
}

/// Returns the length of the scale bar in millimetres: the longest of 1, 2, 5, 10 … mm that is at most `most` metres.
fn scale_bar(most: f64) -> f64 {
    let millimetres = 1000.0 * most;
    let decade = 10_f64.powf(millimetres.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|step| step * decade).find(|&length| length <= millimetres).unwrap_or(decade)
}

/// Returns the text shown instead of a missing drawing.
fn nothing_drawn(system: Option<&SystemDescription>) -> Text {
    match system.map(|system| &system.kind) {
        None => say::SECTION_EMPTY,
        Some(SystemKind::Stack(_)) => say::SECTION_STACK,
        Some(_) => say::SECTION_NONE,
    }
}

/// Draws the section into a new rectangle of a size \[points\].
pub fn show(ui: &mut Ui, input: &Input<'_>, size: Vec2, state: &mut State) {
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let palette = theme::palette(ui);
    let painter = ui.painter_at(rect);
    painter.rect(rect, 4.0, palette.ground, Stroke::new(1.0, palette.line), egui::StrokeKind::Inside);
    let outlines = match input.system {
        Some(system) => &**state.outlines.get((input.revision, input.state), || stacked(system, input.state)),
        None => &[],
    };
    let words = match (input.system, bounds(outlines)) {
        (Some(system), Some(bounds)) => draw(&painter, rect, palette, (system, outlines, bounds), input.sun),
        (system, _) => {
            let words = nothing_drawn(system);
            let wrapped = painter.layout(words.into(), FontId::proportional(13.5), palette.weak, rect.width() - 24.0);
            painter.galley(rect.center() - 0.5 * wrapped.size(), wrapped, palette.weak);
            words.into()
        }
    };
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::labeled(egui::accesskit::Role::Image, true, say::SECTION.get());
        info.current_text_value = Some(words.clone());
        info
    });
}

/// Returns the lowest and highest coordinates of all points, each as (outward, upward) \[m\]; `None` without points.
fn bounds(outlines: &[Vec<[f64; 2]>]) -> Option<[[f64; 2]; 2]> {
    outlines.iter().flatten().fold(None, |bounds: Option<[[f64; 2]; 2]>, point| {
        let [low, high] = bounds.unwrap_or([*point; 2]);
        Some([[low[0].min(point[0]), low[1].min(point[1])], [high[0].max(point[0]), high[1].max(point[1])]])
    })
}

/// Input of the drawing: the system, its polygons, and their lowest and highest coordinates, as (outward, upward)
/// \[m\].
type Drawn<'a> = (&'a SystemDescription, &'a [Vec<[f64; 2]>], [[f64; 2]; 2]);

/// Draws the polygons with labels, scale bar and ray of the sun (angle `sun` \[rad\], see [`Input::sun`]). Returns the
/// content of the drawing as text for screen readers.
fn draw(
    painter: &Painter,
    rect: Rect,
    palette: &theme::Palette,
    (system, outlines, [low, high]): Drawn<'_>,
    sun: Option<f64>,
) -> String {
    let room = vec2((rect.width() - 2.0 * SIDE).max(20.0), (rect.height() - 2.0 * EDGE).max(20.0));
    let (depth, height) = ((high[0] - low[0]).max(1e-9), (high[1] - low[1]).max(1e-9));
    let scale = (f64::from(room.x) / depth).min(f64::from(room.y) / height);
    let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
    // Outside is on the left: outward runs to the left.
    let place = |[z, y]: [f64; 2]| {
        let (right, down) = (scale * (middle[0] - z), scale * (middle[1] - y));
        pos2(rect.center().x + right as f32, rect.center().y + down as f32)
    };
    for polygon in outlines {
        let corners: Vec<Pos2> = polygon.iter().map(|point| place(*point)).collect();
        painter.add(Shape::mesh(fill(&corners, palette.chosen)));
        painter.add(Shape::closed_line(corners, Stroke::new(1.5, palette.text)));
    }
    let font = FontId::proportional(13.0);
    let write = |at: Pos2, align: Align2, text: &str| painter.text(at, align, text, font.clone(), palette.weak);
    write(rect.left_top() + vec2(7.0, 5.0), Align2::LEFT_TOP, say::OUTSIDE.get());
    write(rect.right_top() + vec2(-7.0, 5.0), Align2::RIGHT_TOP, say::INSIDE.get());
    let view = match (system.upright, system.family().is_schematic()) {
        (true, true) => say::SECTION_ABOVE_SCHEMATIC.get(),
        (true, false) => say::SECTION_ABOVE.get(),
        (false, true) => say::SECTION_SCHEMATIC.get(),
        (false, false) => "",
    };
    write(rect.right_bottom() + vec2(-7.0, -5.0), Align2::RIGHT_BOTTOM, view);
    let bar = scale_bar(f64::from(rect.width()) * 0.3 / scale);
    let start = rect.left_bottom() + vec2(8.0, -8.0);
    let end = start + vec2((1e-3 * bar * scale) as f32, 0.0);
    let stroke = Stroke::new(1.5, palette.weak);
    painter.line_segment([start, end], stroke);
    for tick in [start, end] {
        painter.line_segment([tick - vec2(0.0, 4.0), tick + vec2(0.0, 4.0)], stroke);
    }
    let length = format!("{} mm", decimal(((1e6 * bar).round() / 1e6).to_string()));
    write(end + vec2(6.0, 0.0), Align2::LEFT_CENTER, &length);
    let mut words = say::section_words(outlines.len(), &length);
    if !view.is_empty() {
        words.push_str(&format!(", {view}"));
    }
    if let Some(angle) = sun {
        let tip = place([high[0], middle[1]]) - vec2(6.0, 0.0);
        let back = RAY * vec2(-angle.cos() as f32, -angle.sin() as f32);
        painter.arrow(tip + back, -back, Stroke::new(2.0, palette.sun));
        words.push_str(&say::section_sun(format!("{:.0}", angle.to_degrees())));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_are_round_and_fit() {
        for (most, bar) in [(0.0123, 10.0), (0.05, 50.0), (0.0499, 20.0), (0.00031, 0.2), (1.7, 1000.0)] {
            assert!((scale_bar(most) - bar).abs() < 1e-9 * bar, "{most}: {}", scale_bar(most));
        }
    }

    #[test]
    fn three_periods_stand_one_above_the_other() {
        let text = crate::app::goniophotometer::examples::EXAMPLES[0].text;
        let system = crate::formats::system_toml::read(text.as_bytes()).unwrap().system;
        let outlines = stacked(&system, 2);
        assert_eq!(outlines.len(), 3);
        let lift = outlines[2][0][1] - outlines[0][0][1];
        assert!((lift - 2.0 * 0.072).abs() < 1e-12);
        assert!(stacked(&system, 99).is_empty());
    }
}
