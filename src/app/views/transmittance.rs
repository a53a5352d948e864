//! View of the transmittance tile: directional-hemispherical transmittance τ over the incident hemisphere with sun
//! paths, and the flux split, i.e. the shares of the transmitted flux by zone of emergent directions.

use super::Cache;
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _, LEGEND_HEIGHT};
use crate::app::paint::frozen::{Grain, frozen, grain};
use crate::app::paint::hemisphere::{Disk, Projection, Side, incident_disk, on_halo};
use crate::app::paint::palette::{ColourMap, ColourMapExt as _, Palette};
use crate::app::paint::tile::{self, Foot, Status, Words};
use crate::app::scene::incidence::{Incidence, Source, direction_text};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Btdf, Scattered};
use crate::compute::direction::Incident;
pub use crate::drawing::flux_split::FluxSplit;
use crate::drawing::flux_split::percent;
use crate::drawing::ticks::number;
use crate::texts::{Language, language, tiles as say, words::MONTHS};
use egui::{Align2, Color32, FontId, Mesh, Rect, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};
use std::f64::consts::PI;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::Arc;

/// Input of the transmittance tile in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Bidirectional transmittance distribution function (BTDF) for light from outside; `None` while no product is
    /// selected.
    pub btdf: Option<&'a Btdf>,
    /// Names of product and state as text.
    pub name: &'a str,
    /// Path of the sun on the 21st of each month from January to December: points of hour of the day \[h\] and
    /// direction of the sun. Directions behind the façade may be included; the tile leaves them out.
    pub sun_paths: &'a [Vec<(f64, Incident)>],
    /// Direction of the sun at the scene's date and time; `None` if it is unknown.
    pub moment: Option<Incident>,
    /// Incident direction that the BTDF tile shows.
    pub incidence: Incidence,
    /// Flux split for the incident direction `incidence`; `None` without data.
    pub split: Option<FluxSplit>,
    /// Lowest and highest τ of the colour scale, if the comparison sets it.
    pub range: Option<[f64; 2]>,
    /// Revision number of `btdf`, which changes whenever the data do.
    pub revision: u64,
    /// Status of the data shown: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Request of the user of the transmittance tile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Choice of an incident direction, for which the BTDF tile then shows the scattered light.
    ChooseIncidence(Incident),
}

/// Display settings and cached pictures of the transmittance tile.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Whether sun paths are hidden.
    pub hide_paths: bool,
    /// Whether the colour scale of τ is logarithmic.
    pub log: bool,
    /// Whether the user has locked the colour scale.
    pub hold: bool,
    scale: Option<ColourScale>,
    /// Cells of incident directions by which the map is drawn, and their largest τ.
    cells: Cache<u64, (RingBasis, f64)>,
    paths: Cache<PathsKey, Paths>,
    mesh: Cache<(u64, Disk, ColourScale), Arc<Mesh>>,
}

const PROJECTION: Projection = Projection::ProjectedSolidAngle;

/// Draws the transmittance tile into all the space of `ui`. Returns the requests of the user.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = vec![];
    let words = Words {
        title: say::TRANSMITTANCE.get(),
        subtitle: input.name,
        help: say::TRANSMITTANCE_ABOUT.get(),
        empty: input.btdf.is_none().then_some(say::TRANSMITTANCE_EMPTY.get()),
        controls_width: 200.0,
    };
    let (mut paths, mut log, mut hold) = (!state.hide_paths, state.log, state.hold);
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.checkbox(&mut paths, say::SUN_PATHS);
            ui.toggle_value(&mut log, say::LOG).on_hover_text(say::LOG_COLOURS);
            ui.toggle_value(&mut hold, say::HOLD).on_hover_text(say::HOLD_TIP);
        },
        |ui, rect| match input.btdf {
            Some(btdf) => picture(ui, rect, btdf, input, state, &mut actions),
            None => Foot::default(),
        },
    );
    (state.hide_paths, state.log, state.hold) = (!paths, log, hold);
    actions
}

/// Draws the map of τ with sun paths and legend, and the flux split. Returns the line under them.
fn picture(ui: &mut Ui, rect: Rect, btdf: &Btdf, input: &Input<'_>, state: &mut State, out: &mut Vec<Action>) -> Foot {
    let palette = Palette::of(ui.visuals());
    let map = match (input.split, beside(rect)) {
        (Some(split), true) => {
            let (map, place) = rect.split_left_right_at_x(rect.right() - BAR_WIDTH);
            split_bar(ui, place, &split, &input.incidence, &palette);
            map.with_max_x(map.right() - 4.0)
        }
        (Some(split), false) => {
            let (map, place) = rect.split_top_bottom_at_y(rect.bottom() - strip_height(rect));
            split_strip(ui, place, &split, &input.incidence, &palette);
            map
        }
        (None, _) => rect,
    };
    // A scale that is shared stands above all tiles.
    let legend_height = if input.range.is_some() { 0.0 } else { LEGEND_HEIGHT };
    let legend = Rect::from_min_max(pos2(map.left() + 4.0, map.bottom() - legend_height), map.max);
    let disk = Disk::within(Rect::from_min_max(map.min, pos2(map.right(), legend.top())));
    let area = Rect::from_center_size(disk.centre, vec2(2.0, 2.0) * disk.radius);
    let response = ui.interact(area, ui.scope_id().with("map"), Sense::click());
    let (basis, max) = state.cells.get(input.revision, || {
        let basis = super::incident_cells(btdf);
        let max = basis.cells().map(|cell| btdf.tau(Incident(cell.centre()))).fold(0.0, f64::max);
        (basis, max)
    });
    let max = *max;
    // Up to the data's own maximum: dense products would be one dark blot on a scale up to 1. Opaque ones still
    // need an extent.
    let own = || ColourScale::up_to(max.max(1e-3), state.log, 2, ColourMap::Sequential);
    let log = state.log;
    let least = |lo: f64, hi: f64| if log { lo.max(1e-2 * hi) } else { lo };
    let forced = |[lo, hi]: [f64; 2]| ColourScale { lo: least(lo, hi), hi, log, map: ColourMap::Sequential };
    let held = state.scale.clone().filter(|scale| (input.status.hold_scale || state.hold) && scale.log == log);
    let scale = input.range.map(forced).or(held).unwrap_or_else(own);
    state.scale = Some(scale.clone());
    let mesh = state.mesh.get((input.revision, disk, scale.clone()), || Arc::new(map_mesh(&disk, btdf, basis, &scale)));
    ui.painter().add(Shape::Mesh(mesh.clone()));
    disk.frame(ui.painter(), PROJECTION, say::OUTSIDE.get(), &palette);
    if !state.hide_paths {
        let sun =
            input.moment.filter(|sun| sun.0.vector().z > 0.0).map(|sun| disk.screen(incident_disk(PROJECTION, sun)));
        let key = (fingerprint(input.sun_paths), disk, grain(ui), language());
        let paths = state.paths.get(key, || sun_paths(ui, &disk, input.sun_paths));
        ui.painter().add(Shape::Mesh(paths.lines.clone()));
        name_paths(ui, paths, sun, &palette);
    }
    // The chosen direction, as the flux split has it.
    if input.incidence.source == Source::Chosen {
        let at = disk.screen(incident_disk(PROJECTION, input.incidence.direction));
        ui.painter().circle_stroke(at, 6.0, Stroke::new(4.0, palette.face));
        ui.painter().circle_stroke(at, 6.0, Stroke::new(2.0, palette.first));
    }
    // After the paths, so that none crosses it.
    if let Some(sun) = input.moment.filter(|sun| sun.0.vector().z > 0.0) {
        let at = disk.screen(incident_disk(PROJECTION, sun));
        ui.painter().circle(at, 6.0, palette.sun, Stroke::new(1.5, Color32::BLACK));
    }
    let direction = |at| Side::Incident.direction_at(PROJECTION, disk.disk(at)).map(Incident);
    if response.clicked()
        && let Some(incident) = response.interact_pointer_pos().and_then(direction)
    {
        out.push(Action::ChooseIncidence(incident));
    }
    let pointed = response.hover_pos().and_then(direction);
    if input.range.is_none() {
        scale.paint_legend(ui.painter(), legend, "τ", pointed.map(|d| btdf.tau(d)), &palette);
    }
    let tau = |d: Incident| format!("τ {}", number(btdf.tau(d), 3));
    // The line under the picture is never empty: without a pointer it describes the direction of the flux split.
    let [full, middle, short] = input.incidence.texts();
    let own = tau(input.incidence.direction);
    let rest = Foot::from([
        format!("{full} · {own}"),
        format!("{middle} · {own}"),
        format!("{short} · {own}"),
        format!("{} {own}", short.replace(',', "")),
    ]);
    tile::name(ui, &response, say::TRANSMITTANCE_MAP, rest.full());
    pointed.map_or(rest, |d| {
        let (angles, tau) = (direction_text(d.0), tau(d));
        Foot::from([say::from_angles(&angles, &tau), format!("{angles} · {tau}"), tau])
    })
}

/// Width of the flux split beside the map. \[points\]
const BAR_WIDTH: f32 = 124.0;
/// Height of the flux split under the map: lines for its incident direction and its zones, and a bar. \[points\]
const STRIP_HEIGHT: f32 = 50.0;
/// Height of the flux split under the map without the line of its incident direction. \[points\]
const LOW_STRIP_HEIGHT: f32 = 34.0;
/// Height of a tile below which the incident direction of the flux split is named in the line under the picture only.
/// \[points\]
const LOW_TILE: f32 = 220.0;

fn strip_height(rect: Rect) -> f32 {
    if rect.height() < LOW_TILE { LOW_STRIP_HEIGHT } else { STRIP_HEIGHT }
}

/// Whether the flux split is drawn beside the map, i.e. whether the map is then at least as large as with the split
/// under it.
fn beside(rect: Rect) -> bool {
    rect.width() - BAR_WIDTH >= (rect.height() - strip_height(rect) - LEGEND_HEIGHT).min(rect.width())
}

/// Returns a mesh of τ in colours over the incident hemisphere. Data by cells are drawn in flat colours, so that the
/// picture does not suggest a resolution that they do not have.
fn map_mesh(disk: &Disk, btdf: &Btdf, basis: &RingBasis, scale: &ColourScale) -> Mesh {
    match &btdf.scattered {
        Some(Scattered::Cells(_) | Scattered::Directions(_) | Scattered::Tree(_)) => {
            disk.cells(PROJECTION, Side::Incident, basis, |i| scale.colour(btdf.tau(Incident(basis.cell(i).centre()))))
        }
        _ => disk.smooth(|p| {
            // Just inside the rim: rounding may put a point of the rim where there is no direction.
            let d = Side::Incident.direction_at(PROJECTION, [0.999_999 * p[0], 0.999_999 * p[1]]);
            scale.colour(d.map_or(0.0, |d| btdf.tau(Incident(d))))
        }),
    }
}

/// Sun paths as a mesh, and the labels beside them with their screen positions.
#[derive(Debug, Clone)]
struct Paths {
    lines: Arc<Mesh>,
    names: Vec<(egui::Pos2, String)>,
}

/// Key of the cached sun paths: fingerprint of the paths, disk, screen resolution and language.
type PathsKey = (u64, Disk, Grain, Language);

/// Returns a hash that distinguishes the sun paths of one site and façade from others, computed from the middle point
/// of each path.
fn fingerprint(paths: &[Vec<(f64, Incident)>]) -> u64 {
    let mut hasher = DefaultHasher::new();
    for path in paths {
        path.len().hash(&mut hasher);
        if let Some((hour, d)) = path.get(path.len() / 2) {
            hour.to_bits().hash(&mut hasher);
            d.0.vector().to_array().map(f64::to_bits).hash(&mut hasher);
        }
    }
    hasher.finish()
}

/// Draws the labels of the sun paths over all lines, except those that another label or the sun would cover.
fn name_paths(ui: &Ui, paths: &Paths, sun: Option<egui::Pos2>, palette: &Palette) {
    let mut used: Vec<Rect> = vec![];
    for (place, text) in &paths.names {
        let size = Rect::from_center_size(*place, vec2(8.0 + 7.5 * text.chars().count() as f32, 17.0));
        let free = sun.is_none_or(|at| size.distance_to_pos(at) > 8.0);
        if free && used.iter().all(|other| !other.intersects(size)) {
            used.push(size);
            on_halo(ui.painter(), *place, text, palette);
        }
    }
}

/// Returns the sun paths on a disk, with marks at full hours and labels.
fn sun_paths(ui: &Ui, disk: &Disk, paths: &[Vec<(f64, Incident)>]) -> Paths {
    let (mut shapes, mut names) = (vec![], vec![]);
    let mut name = |place: egui::Pos2, text: String| names.push((place, text));
    // On a small disk the solstices and March say it all.
    let small = disk.radius < 80.0;
    for (month, path) in paths.iter().enumerate() {
        if small && ![2, 5, 11].contains(&month) {
            continue;
        }
        // The second half of the year repeats the first: drawn once, thinner.
        let stroke = Stroke::new(if month <= 5 || month == 11 { 1.6 } else { 0.8 }, Color32::WHITE);
        let under = Stroke::new(stroke.width + 1.6, Color32::from_black_alpha(110));
        let mut run = vec![];
        let mut runs = vec![];
        for (_, incident) in path {
            if incident.0.vector().z > 0.0 {
                run.push(disk.screen(incident_disk(PROJECTION, *incident)));
            } else {
                runs.push(std::mem::take(&mut run));
            }
        }
        runs.push(run);
        for run in runs.iter().filter(|run| run.len() > 1) {
            shapes.push(Shape::line(run.clone(), under));
            shapes.push(Shape::line(run.clone(), stroke));
        }
        for (hour, incident) in path.iter().filter(|(hour, _)| (hour - hour.round()).abs() < 1e-6) {
            if small || incident.0.vector().z <= 0.0 {
                continue;
            }
            let at = disk.screen(incident_disk(PROJECTION, *incident));
            shapes.push(Shape::circle_filled(at, 1.8, Color32::WHITE));
            shapes.push(Shape::circle_stroke(at, 1.8, Stroke::new(0.6, Color32::BLACK)));
            // Where the paths are close together the winter's hours stand for all.
            let labelled = (month == 11 || month == 5 && disk.radius > 130.0) && (hour.round() as i64) % 3 == 0;
            let above = at + vec2(0.0, -9.0);
            // June's noon is near the rim, where 'up' stands: then under the path.
            let inside = above.distance(disk.centre) < disk.radius - 8.0;
            let place = if month == 5 && inside { above } else { at + vec2(0.0, 9.0) };
            if labelled {
                name(place, say::hour_mark(format!("{hour:.0}")));
            }
        }
        let middle = runs.iter().max_by_key(|run| run.len()).filter(|run| run.len() > 3);
        if let (Some(run), true) = (middle, [2, 5, 11].contains(&month) && disk.radius > 55.0) {
            name(run[run.len() / 4], MONTHS[month].into());
        }
    }
    Paths { lines: frozen(ui, shapes), names }
}

/// Returns the incident direction of the flux split as text, in a wording that is at most `width` \[points\] wide if
/// there is one.
fn split_title(ui: &Ui, incidence: &Incidence, width: f32) -> String {
    let [_, middle, short] = incidence.texts();
    let font = FontId::proportional(13.0);
    let fits =
        |text: &String| ui.painter().layout_no_wrap(text.clone(), font.clone(), Color32::WHITE).size().x <= width;
    [format!("{middle}:"), short].into_iter().find(fits).unwrap_or_else(|| incidence.name().to_owned())
}

/// Returns the colour of a zone of emergent directions, counted from top to bottom.
fn zone_colour(zone: usize) -> Color32 {
    ColourMap::Sequential.at(0.85 - 0.23 * zone as f32)
}

fn name_split(ui: &mut Ui, rect: Rect, split: &FluxSplit, incidence: &Incidence) {
    let response = ui.interact(rect, ui.scope_id().with("split"), Sense::hover()).on_hover_text(say::ZONES);
    let [full, ..] = incidence.texts();
    tile::name(ui, &response, say::FLUX_SPLIT, &format!("{full}: {}", split.sentence()));
}

/// Draws the flux split as a vertical bar beside the map, with the name and share of each zone.
fn split_bar(ui: &mut Ui, rect: Rect, split: &FluxSplit, incidence: &Incidence, palette: &Palette) {
    let total = split.total();
    name_split(ui, rect, split, incidence);
    let font = FontId::proportional(13.0);
    let sentence = ui.painter().layout(split.sentence(), font.clone(), palette.ink, rect.width() - 6.0);
    let column = Rect::from_min_max(
        pos2(rect.left() + 6.0, rect.top() + 36.0),
        pos2(rect.left() + 30.0, (rect.bottom() - sentence.size().y - 8.0).max(rect.top() + 48.0)),
    );
    ui.painter().galley(pos2(rect.left() + 4.0, column.bottom() + 6.0), sentence, palette.ink);
    let title = split_title(ui, incidence, rect.width() - 6.0);
    tile::caption(ui, pos2(rect.left() + 4.0, rect.top()), Align2::LEFT_TOP, &title);
    tile::caption(ui, pos2(rect.left() + 4.0, rect.top() + 16.0), Align2::LEFT_TOP, say::LEAVING_TO.get());
    ui.painter().rect_filled(column, 0, palette.face);
    let mut top = column.top();
    let mut text_floor = column.top();
    for (k, (zone, share)) in split.parts().into_iter().enumerate() {
        let part = if total > 0.0 { (share / total) as f32 } else { 0.0 };
        let bottom = top + part * column.height();
        let place = Rect::from_min_max(pos2(column.left(), top), pos2(column.right(), bottom));
        ui.painter().rect_filled(place, 0, zone_colour(k));
        // Labels keep a line's height between them and stay inside.
        let latest = column.bottom() - 15.0 * (3 - k) as f32 - 7.0;
        let y = (0.5 * (top + bottom)).max(text_floor + 7.0).min(latest.max(text_floor + 7.0));
        text_floor = y + 8.0;
        let label = format!("{zone} {}", percent(share));
        ui.painter().text(pos2(column.right() + 6.0, y), Align2::LEFT_CENTER, label, font.clone(), palette.ink);
        top = bottom;
    }
    ui.painter().rect_stroke(column, 0, Stroke::new(1.0, palette.outline), StrokeKind::Middle);
}

/// Draws the flux split as a horizontal bar under the map, with its incident direction and the zone with the largest
/// share.
fn split_strip(ui: &mut Ui, rect: Rect, split: &FluxSplit, incidence: &Incidence, palette: &Palette) {
    let total = split.total();
    name_split(ui, rect, split, incidence);
    let (left, width) = (rect.left() + 2.0, rect.width() - 4.0);
    if rect.height() >= STRIP_HEIGHT {
        tile::caption(ui, pos2(left, rect.top()), Align2::LEFT_TOP, &split_title(ui, incidence, width));
    }
    let bar = Rect::from_min_size(pos2(left, rect.bottom() - 32.0), vec2(width, 12.0));
    ui.painter().rect_filled(bar, 0, palette.face);
    let mut start = bar.left();
    for (k, (_, share)) in split.parts().into_iter().enumerate() {
        let part = if total > 0.0 { (share / total) as f32 * bar.width() } else { 0.0 };
        let place = Rect::from_min_max(pos2(start, bar.top()), pos2(start + part, bar.bottom()));
        ui.painter().rect_filled(place, 0, zone_colour(k));
        start += part;
    }
    ui.painter().rect_stroke(bar, 0, Stroke::new(1.0, palette.outline), StrokeKind::Middle);
    let font = FontId::proportional(13.0);
    let galley = |text: String| ui.painter().layout_no_wrap(text, font.clone(), palette.ink);
    let galleys = split.lines().map(galley);
    let fitting = galleys.iter().find(|galley| galley.size().x <= width).unwrap_or(&galleys[3]);
    ui.painter().galley(pos2(left, bar.bottom() + 3.0), fitting.clone(), palette.ink);
}

/// Returns the transmittance τ for the incident cells as CSV.
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("theta_deg,phi_deg,projected_solid_angle_sr,tau\n");
    let Some(btdf) = input.btdf else { return out };
    if let Some(data) = super::listed(btdf) {
        // Each direction with the part of the hemisphere that is nearest to it.
        for (d, share) in data.incident().iter().zip(data.shares()) {
            let (theta, phi) = (d.0.theta().to_degrees(), d.0.phi().to_degrees());
            let _ = writeln!(out, "{theta:.4},{phi:.4},{:.9},{:.9}", PI * share, btdf.tau(*d));
        }
        return out;
    }
    for cell in btdf.incident_basis().cells() {
        let d = cell.centre();
        let (theta, phi) = (d.theta().to_degrees(), d.phi().to_degrees());
        let _ = writeln!(out, "{theta:.4},{phi:.4},{:.9},{:.9}", cell.projected_solid_angle(), btdf.tau(Incident(d)));
    }
    out
}
