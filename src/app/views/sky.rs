//! View of the sky tile: the luminance of the sky dome as seen from below, the sun, which can be dragged, and the
//! resulting illuminances.

use super::Cache;
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _, LEGEND_HEIGHT};
use crate::app::paint::hemisphere::{Disk, on_halo};
use crate::app::paint::palette::{ColourMap, Palette};
use crate::app::paint::plot::{self, Look};
use crate::app::paint::tile::{self, Foot, Status, Words};
use crate::app::scene::moment::height_words;
use crate::compute::angle::wrap_two_pi;
use crate::drawing::hemisphere::{dome_point, side_without};
use crate::drawing::plot::{Axis, Guide, Plot, Series, Unit};
use crate::drawing::ticks::si;
use crate::texts::{Text, fixed, tiles as say};
use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt;
use std::sync::Arc;

/// Function that returns the luminance of the sky \[cd/m²\] at an altitude and a compass bearing \[rad\].
pub type Luminance<'a> = &'a dyn Fn(f64, f64) -> f64;

/// Position in the sky. \[rad\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Altitude above the horizon. \[rad\]
    pub altitude: f64,
    /// Compass bearing, clockwise from north. \[rad\]
    pub bearing: f64,
}

/// Input of the sky tile in one frame.
#[derive(Clone, Copy)]
pub struct Input<'a> {
    /// Luminance of the sky without the sun's disc; `None` before it is known.
    pub luminance: Option<Luminance<'a>>,
    /// Name of the sky model, e.g. "CIE type 12, clear".
    pub name: &'a str,
    /// Position of the sun, which may be below the horizon; `None` if it is unknown.
    pub sun: Option<Place>,
    /// Compass bearing of the façade's outward normal. \[rad\]
    pub facade_bearing: f64,
    /// Whether boxes of obstructions cover parts of the sky, so that it must be drawn with sharp edges.
    pub behind_boxes: bool,
    /// Altitude of a uniform skyline; 0 for none. \[rad\]
    pub skyline: f64,
    /// Diffuse horizontal illuminance outside. \[lx\]
    pub diffuse_horizontal: Option<f64>,
    /// Direct horizontal illuminance outside, from the sun. \[lx\]
    pub direct_horizontal: Option<f64>,
    /// Illuminance on the outside of the façade from sky, sun, ground and obstructions. \[lx\]
    pub facade_vertical: Option<f64>,
    /// Whether `facade_vertical` is outdated, i.e. belongs to an earlier scene.
    pub facade_stale: bool,
    /// Lowest and highest luminance of the colour scale, if the comparison sets it. \[cd/m²\]
    pub range: Option<[f64; 2]>,
    /// Revision number of the sky, which changes whenever its luminances do.
    pub revision: u64,
    /// Status of the results shown: preliminary, outdated or complete.
    pub status: Status<'a>,
}

impl fmt::Debug for Input<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(stringify!(Input)).field("name", &self.name).field("sun", &self.sun).finish_non_exhaustive()
    }
}

/// Request of the user of the sky tile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Drag of the sun to a position in the sky, which changes the time of day, with Shift also the date, or with Alt
    /// only the sun's angles.
    SunDragged {
        /// Position to which the sun was dragged.
        place: Place,
        /// Whether to change the angles of the sun independently of date and time (Alt).
        free: bool,
        /// Whether to change also the date (Shift).
        date: bool,
    },
    /// Release of the sun, so that scales may change again.
    SunReleased,
}

/// Key of the cached picture of the dome: revision number of the sky, disk, colour scale, bearing of the façade as
/// bits, and whether the theme is dark and the mesh fine.
type DomeKey = (u64, Disk, ColourScale, u64, (bool, bool));

/// Display settings and cached pictures of the sky tile.
#[derive(Debug, Clone)]
pub struct State {
    /// Whether the colour scale of luminances is logarithmic.
    pub log: bool,
    /// Whether the user has locked the colour scale.
    pub hold: bool,
    scale: Option<ColourScale>,
    extent: Cache<u64, [f64; 2]>,
    dome: Cache<DomeKey, Arc<Mesh>>,
    section: Cache<(u64, u64), Vec<[f64; 2]>>,
    dragging: bool,
}

impl Default for State {
    fn default() -> Self {
        Self {
            log: true,
            hold: false,
            scale: None,
            extent: Cache::default(),
            dome: Cache::default(),
            section: Cache::default(),
            dragging: false,
        }
    }
}

/// Minimum width at which the three illuminances are written in one line. \[points\]
const WIDE_FIGURES: f32 = 460.0;
/// Width below which each illuminance is written in a separate line. \[points\]
const NARROW_FIGURES: f32 = 190.0;
/// Height of a line of the illuminances. \[points\]
const FIGURE_LINE: f32 = 16.5;

/// Returns the number of lines that the illuminances take in a width \[points\].
fn figure_lines(width: f32) -> u8 {
    if width < NARROW_FIGURES {
        3
    } else if width < WIDE_FIGURES {
        2
    } else {
        1
    }
}

/// Returns the disk coordinates (right, up) of a position in the sky as seen from below: north at the top, east at the
/// left.
fn disk_point(place: Place) -> [f64; 2] {
    dome_point(place.altitude, place.bearing)
}

/// Returns the position in the sky of disk coordinates (right, up); on the horizon beyond the rim.
fn place_of([right, up]: [f64; 2]) -> Place {
    let r = right.hypot(up).min(1.0);
    Place { altitude: (1.0 - r) * FRAC_PI_2, bearing: wrap_two_pi((-right).atan2(up)) }
}

/// Draws the sky tile into all the space of `ui`. Returns the requests of the user.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = vec![];
    let words = Words {
        title: say::SKY.get(),
        subtitle: input.name,
        help: say::SKY_ABOUT.get(),
        empty: input.luminance.is_none().then(|| input.status.missing(say::SKY_EMPTY)),
        controls_width: 104.0,
    };
    let (mut log, mut hold) = (state.log, state.hold);
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.toggle_value(&mut log, say::LOG).on_hover_text(say::LOG_COLOURS);
            ui.toggle_value(&mut hold, say::HOLD).on_hover_text(say::HOLD_TIP);
        },
        |ui, rect| match input.luminance {
            Some(luminance) => picture(ui, rect, luminance, input, state, &mut actions),
            None => Foot::default(),
        },
    );
    (state.log, state.hold) = (log, hold);
    actions
}

/// Draws dome, illuminances and, if there is room, the section of luminances. Returns the line under them.
fn picture(
    ui: &mut Ui,
    rect: Rect,
    luminance: Luminance<'_>,
    input: &Input<'_>,
    state: &mut State,
    out: &mut Vec<Action>,
) -> Foot {
    let palette = Palette::of(ui.visuals());
    let lines = f32::from(figure_lines(rect.width()));
    let figures = Rect::from_min_max(rect.min, pos2(rect.right(), rect.top() + 4.0 + FIGURE_LINE * lines));
    figures_ui(ui, figures, input, &palette);
    let rest = Rect::from_min_max(pos2(rect.left(), figures.bottom()), rect.max);
    let beside = rest.width() > 1.05 * rest.height() && rest.width() > 380.0;
    let (map, section) = if beside {
        let (map, section) = rest.split_left_right_at_fraction(0.55);
        let height = section.height().min(240.0);
        (map, Some(Rect::from_center_size(section.center(), vec2(section.width(), height))))
    } else if rest.height() > 280.0 {
        let (map, section) = rest.split_top_bottom_at_y(rest.bottom() - 120.0_f32.max(0.3 * rest.height()));
        (map, Some(section))
    } else {
        (rest, None)
    };
    let moving = input.status.hold_scale || state.dragging;
    let log = state.log;
    let held = state.scale.clone().filter(|scale| (moving || state.hold) && scale.log == log);
    // Not looked for while the scale is held: every moment of a drag has another sky.
    let mut own = || match (log, *state.extent.get(input.revision, || extent(luminance))) {
        (true, [min, max]) => ColourScale::log_around(min.max(1e-3), max.max(1e-2), ColourMap::Sequential),
        (false, [_, max]) => ColourScale::up_to(max.max(1e-2), false, 3, ColourMap::Sequential),
    };
    let least = |lo: f64| if log { lo } else { 0.0 };
    let forced = input.range.map(|[lo, hi]| ColourScale { lo: least(lo), hi, log, map: ColourMap::Sequential });
    let scale = forced.or(held).unwrap_or_else(&mut own);
    state.scale = Some(scale.clone());
    let text = dome(ui, map, luminance, input, state, &scale, out);
    section.and_then(|place| section_ui(ui, place, luminance, input, state, &scale)).unwrap_or(text)
}

/// Returns the lowest and highest luminance of a sky above the horizon, without parts of luminance 0 \[cd/m²\]; the
/// lowest is infinite for a dark sky.
pub fn extent(luminance: Luminance<'_>) -> [f64; 2] {
    let mut range = [f64::INFINITY, 0.0_f64];
    for ring in 0..18 {
        for sector in 0..36 {
            let value = luminance((f64::from(ring) * 5.0 + 2.5).to_radians(), f64::from(sector) * 10_f64.to_radians());
            if value.is_finite() && value > 0.0 {
                range = [range[0].min(value), range[1].max(value)];
            }
        }
    }
    range
}

/// Draws the diffuse and direct horizontal illuminance and that on the façade, in klx.
fn figures_ui(ui: &Ui, rect: Rect, input: &Input<'_>, palette: &Palette) {
    let figures = [
        (say::E_DIFFUSE, input.diffuse_horizontal),
        (say::E_DIRECT, input.direct_horizontal),
        (say::E_FACADE, input.facade_vertical),
    ];
    // Name over value in three columns, or a line for each, where they do not fit side by side.
    let short = [say::DIFFUSE, say::DIRECT, say::FACADE];
    let lines = figure_lines(rect.width());
    let width = rect.width() / 3.0;
    let font = FontId::proportional(13.0);
    for (k, (label, value)) in figures.into_iter().enumerate() {
        let value = value.map_or_else(|| "–".to_owned(), |v| format!("{} klx", fixed(v / 1000.0, 1)));
        let at = rect.left_top() + vec2(2.0, 9.0);
        let at = at + if lines == 3 { vec2(0.0, FIGURE_LINE * k as f32) } else { vec2(k as f32 * width, 0.0) };
        let name = if lines == 2 { short[k] } else { label };
        let label = ui.painter().text(at, Align2::LEFT_CENTER, name, font.clone(), palette.weak);
        let place = if lines == 2 { at + vec2(0.0, 16.0) } else { pos2(label.right() + 5.0, at.y) };
        let ink = if k == 2 && input.facade_stale { palette.weak } else { palette.ink };
        ui.painter().text(place, Align2::LEFT_CENTER, value, font.clone(), ink);
    }
}

/// Draws the dome with legend, and executes drags of the sun. Returns the line for the point under the pointer.
fn dome(
    ui: &mut Ui,
    rect: Rect,
    luminance: Luminance<'_>,
    input: &Input<'_>,
    state: &mut State,
    scale: &ColourScale,
    out: &mut Vec<Action>,
) -> Foot {
    let palette = Palette::of(ui.visuals());
    // A scale that is shared stands above all tiles.
    let legend_height = if input.range.is_some() { 0.0 } else { LEGEND_HEIGHT };
    let legend = Rect::from_min_max(pos2(rect.left() + 4.0, rect.bottom() - legend_height), rect.max);
    let disk = Disk::within(Rect::from_min_max(rect.min, pos2(rect.right(), legend.top())));
    // Beyond the rim too, so that a sun on the horizon can be taken hold of.
    let area = Rect::from_center_size(disk.centre, vec2(2.0, 2.0) * (disk.radius + 8.0));
    let response = ui.interact(area, ui.scope_id().with("dome"), Sense::click_and_drag());
    let (facade, dark) = (input.facade_bearing, ui.visuals().dark_mode);
    // Not of the sky alone: the half behind the façade is faded, into what the theme has as ground.
    let fine = !(input.status.hold_scale || state.dragging);
    let key = (input.revision, disk, scale.clone(), facade.to_bits(), (dark, fine));
    // Edges want more corners than a sky does.
    let grid = match (fine, input.behind_boxes) {
        (true, false) => [30, 36],
        (false, false) => [15, 18],
        (true, true) => [120, 144],
        (false, true) => [45, 54],
    };
    let mesh = state.dome.get(key, || Arc::new(dome_mesh(&disk, luminance, scale, (facade, grid), &palette)));
    ui.painter().add(Shape::Mesh(mesh.clone()));
    compass(ui, &disk, input, &palette);
    // The disk ends at the horizon: a sun under it has no place there.
    let sun_at = input.sun.filter(|sun| sun.altitude >= 0.0).map(|sun| disk.screen(disk_point(sun)));
    let mut at_sun = false;
    if let Some(at) = sun_at {
        let near = state.dragging || response.hover_pos().is_some_and(|p| p.distance(at) < 14.0);
        ui.painter().circle(at, if near { 9.0 } else { 7.0 }, palette.sun, Stroke::new(1.5, Color32::BLACK));
        at_sun = near && !state.dragging;
        if near {
            ui.set_cursor_icon(if state.dragging { egui::CursorIcon::Grabbing } else { egui::CursorIcon::Grab });
        }
    }
    // Where the button went down counts: before egui calls it a drag, the pointer has moved off already.
    let grabbed = |p: Pos2| sun_at.is_some_and(|at| p.distance(at) < 16.0);
    if response.drag_started() && ui.input(|i| i.pointer.press_origin()).is_some_and(grabbed) {
        state.dragging = true;
    }
    if state.dragging
        && let Some(at) = response.interact_pointer_pos()
    {
        let (free, date) = ui.input(|i| (i.modifiers.alt, i.modifiers.shift));
        out.push(Action::SunDragged { place: place_of(disk.disk(at)), free, date });
    }
    // The end of a drag is not always reported, as when the tile is hidden: the scale would stay locked.
    if state.dragging && (response.drag_stopped() || !response.dragged() && !response.drag_started()) {
        state.dragging = false;
        out.push(Action::SunReleased);
    }
    let place = response.hover_pos().map(|at| disk.disk(at)).filter(|[x, y]| x.hypot(*y) <= 1.0).map(place_of);
    let value = place.map(|p| luminance(p.altitude, p.bearing));
    if input.range.is_none() {
        scale.paint_legend(ui.painter(), legend, "cd/m²", value, &palette);
    }
    let sun_text = match input.sun {
        Some(sun) => Foot::from(place_text(say::SUN, sun)),
        None => Foot::from(say::NO_SUN),
    };
    tile::name(ui, &response, say::SKY_DOME, sun_text.full());
    match (place, value) {
        _ if at_sun => Foot::from(say::DRAG_SUN),
        (Some(p), Some(v)) => {
            let luminance = si(v, "cd/m²");
            let [full, short, _] = place_text(say::SKY_PLACE, p);
            Foot::from([format!("{full} · {luminance}"), format!("{short} · {luminance}"), luminance])
        }
        _ => sun_text,
    }
}

/// Returns a position in the sky as text in three wordings from full to short: "sun at 41.0° altitude, azimuth 171°";
/// for negative altitudes "15.0° below the horizon". `what`: name of what is there.
fn place_text(what: Text, place: Place) -> [String; 3] {
    let degrees = place.altitude.to_degrees();
    let height = height_words(degrees, 1);
    // Just under a whole turn is north again.
    let bearing = place.bearing.to_degrees().round().rem_euclid(360.0);
    let short = if degrees < 0.0 { say::below_horizon(what) } else { format!("{what} {height}") };
    let place = format!("{what} {height}");
    [say::with_bearing(&place, format!("{bearing:.0}")), place, short]
}

/// Returns a mesh of the dome coloured by luminance. The halves in front of and behind the façade (bearing `facade`
/// \[rad\]) are each divided into `rings` by `sectors`.
fn dome_mesh(
    disk: &Disk,
    luminance: Luminance<'_>,
    scale: &ColourScale,
    (facade, [rings, sectors]): (f64, [u32; 2]),
    palette: &Palette,
) -> Mesh {
    // The border between the halves must be sharp: each half is its own fan, turned so that it starts on the border.
    let mut mesh = Mesh::default();
    for half in 0..2 {
        let first = mesh.vertices.len() as u32;
        for ring in 0..=rings {
            for sector in 0..=sectors {
                let turn = f64::from(sector) / f64::from(sectors) * 0.5 * TAU + f64::from(half) * 0.5 * TAU;
                let place = Place {
                    altitude: (1.0 - f64::from(ring) / f64::from(rings)) * FRAC_PI_2,
                    bearing: wrap_two_pi(facade - FRAC_PI_2 + turn),
                };
                let full = scale.colour(luminance(place.altitude, place.bearing));
                let colour = if half == 0 { full } else { mix(full, palette.face, 0.62) };
                mesh.colored_vertex(disk.screen(disk_point(place)), colour);
            }
        }
        let row = sectors + 1;
        for ring in 0..rings {
            for sector in 0..sectors {
                let v = first + ring * row + sector;
                mesh.add_triangle(v, v + 1, v + row);
                mesh.add_triangle(v + 1, v + row, v + row + 1);
            }
        }
    }
    mesh
}

fn mix(a: Color32, b: Color32, t: f32) -> Color32 {
    let m = |x: u8, y: u8| (f32::from(x) * (1.0 - t) + f32::from(y) * t) as u8;
    Color32::from_rgb(m(a.r(), b.r()), m(a.g(), b.g()), m(a.b(), b.b()))
}

/// Draws the frame of the dome: rings of altitude, compass points, plane of the façade, uniform skyline.
fn compass(ui: &Ui, disk: &Disk, input: &Input<'_>, palette: &Palette) {
    let painter = ui.painter();
    let thin = Stroke::new(1.0, palette.outline.gamma_multiply(0.45));
    let side = side_without(input.sun.map(|sun| (sun.altitude, sun.bearing))) as f32;
    for deg in [30.0_f32, 60.0] {
        painter.circle_stroke(disk.centre, disk.radius * (1.0 - deg / 90.0), thin);
        if disk.radius > 60.0 {
            let r = disk.radius * (1.0 - deg / 90.0) * std::f32::consts::FRAC_1_SQRT_2;
            on_halo(painter, disk.centre + vec2(side * r, r), &format!("{deg:.0}°"), palette);
        }
    }
    if input.skyline > 0.0 {
        let r = disk.radius * (1.0 - (input.skyline / FRAC_PI_2) as f32);
        painter.circle_stroke(disk.centre, r, Stroke::new(2.0, palette.ink));
    }
    painter.circle_stroke(disk.centre, disk.radius, Stroke::new(1.5, palette.outline));
    // The façade's plane, and a tick where its normal points.
    let along = [-1.0, 1.0]
        .map(|side| disk.screen(disk_point(Place { altitude: 0.0, bearing: input.facade_bearing + side * FRAC_PI_2 })));
    painter.line_segment(along, Stroke::new(2.0, palette.ink));
    for (word, deg) in [(say::NORTH, 0.0_f64), (say::EAST, 90.0), (say::SOUTH, 180.0), (say::WEST, 270.0)] {
        let [x, y] = disk_point(Place { altitude: 0.0, bearing: deg.to_radians() });
        let at = disk.centre + vec2(x as f32, -y as f32) * (disk.radius + 9.0);
        painter.text(at, Align2::CENTER_CENTER, word, FontId::proportional(13.0), palette.ink);
    }
}

/// Draws the plot of luminance over the zenith angle in the vertical plane of the sun or, without it, the façade's
/// normal.
fn section_ui(
    ui: &mut Ui,
    rect: Rect,
    luminance: Luminance<'_>,
    input: &Input<'_>,
    state: &mut State,
    scale: &ColourScale,
) -> Option<Foot> {
    let palette = Palette::of(ui.visuals());
    let bearing = input.sun.map_or(input.facade_bearing, |sun| sun.bearing);
    let points = state.section.get((input.revision, bearing.to_bits()), || {
        (-90..=90)
            .map(|deg: i32| {
                // Negative: the side away from the sun.
                let side = if deg < 0 { bearing + 0.5 * TAU } else { bearing };
                let altitude = FRAC_PI_2 - f64::from(deg.abs()).to_radians();
                [f64::from(deg), luminance(altitude, wrap_two_pi(side))]
            })
            .collect()
    });
    let sun = input.sun.filter(|sun| sun.altitude >= 0.0).map(|sun| 90.0 - sun.altitude.to_degrees());
    let plot = Plot {
        x: Axis::linear([-90.0, 90.0], say::ZENITH_ANGLE, Unit::Degrees),
        y: if scale.log { Axis::log } else { Axis::linear }([scale.lo, scale.hi], "L", Unit::Named("cd/m²")),
        series: vec![Series::line(say::SKY_PLACE, points.iter().copied())],
        guides: sun.iter().map(|&x| Guide { name: say::SUN.into(), ends: [[x, scale.lo], [x, scale.hi]] }).collect(),
    };
    let colours = [palette.first];
    let look = Look::tile(ui.scope_id().with("section"), &colours, palette.sun);
    let shown = plot::show(ui, rect.shrink2(vec2(12.0, 0.0)), &plot, &look, |_| {});
    tile::name(ui, &shown.response, say::SKY_SECTION, say::SKY_SECTION_VALUE.get());
    let [angle, _] = shown.pointed()?;
    let [x, value] = points[(angle.round() as i64 + 90).clamp(0, 180) as usize];
    ui.painter().circle_filled(shown.screen(plot.place([x, value])?), 3.5, palette.first);
    let luminance = si(value, "cd/m²");
    Some(Foot::from([say::from_zenith(format!("{x:.0}"), &luminance), luminance]))
}

/// Returns the luminance of the sky \[cd/m²\] every 5° of altitude and 10° of bearing as CSV.
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("altitude_deg,bearing_deg,luminance_cd_m2\n");
    let Some(luminance) = input.luminance else { return out };
    for altitude in (0..=90).step_by(5) {
        for bearing in (0..360).step_by(10) {
            let value = luminance(f64::from(altitude).to_radians(), f64::from(bearing).to_radians());
            let _ = writeln!(out, "{altitude},{bearing},{value:.6}");
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sun_under_the_horizon_is_said_to_be_there() {
        let text = |degrees: f64, bearing: f64| {
            let place = Place { altitude: degrees.to_radians(), bearing: bearing.to_radians() };
            place_text(say::SUN, place)[0].clone()
        };
        assert_eq!(text(-15.0, 290.0), "sun 15.0° below the horizon, azimuth 290°");
        assert_eq!(text(41.2, 359.8), "sun at 41.2°, azimuth 0°");
    }

    #[test]
    fn north_is_up_and_east_is_left() {
        let north = disk_point(Place { altitude: 0.0, bearing: 0.0 });
        let east = disk_point(Place { altitude: 0.0, bearing: FRAC_PI_2 });
        assert!((north[1] - 1.0).abs() < 1e-12 && (east[0] + 1.0).abs() < 1e-12);
        let place = Place { altitude: 0.6, bearing: 4.0 };
        let back = place_of(disk_point(place));
        assert!((back.altitude - 0.6).abs() < 1e-12 && (back.bearing - 4.0).abs() < 1e-12);
        assert_eq!(place_of([0.0, 3.0]).altitude, 0.0);
    }
}
