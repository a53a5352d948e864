//! Illuminance on the sensor plane: plan in false colour with iso-lux lines, and a section along the depth.
//!
//! The plan is seen from above with the façade at the left, so that its depth axis is the section's.

mod marks;

use super::Cache;
use crate::app::paint::colour_scale::{ColourScale, LEGEND_HEIGHT};
use crate::app::paint::contour::{ASKED_FOR, IsoLine, iso_levels, iso_lines};
use crate::app::paint::palette::{ColourMap, Palette, contrast};
use crate::app::paint::plot::{self, LEFT, Look, RIGHT};
use crate::app::paint::tile::{self, Foot, Status, Words};
use crate::compute::direction::Surface;
use crate::compute::estimate::Estimate;
use crate::drawing::plot::{Axis, Guide, Plot, Series, Unit};
use crate::drawing::ticks::{number, si};
pub use crate::study::scene_words::error_words;
use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};
use marks::{label_line, scale_bar};
use std::sync::Arc;

/// Result at one sensor. \[lx\]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CellValue {
    /// Direct and interreflected together.
    pub total: f64,
    /// Estimated absolute error of `total`.
    pub error: f64,
    /// Straight from the apertures.
    pub direct: f64,
    /// By way of the room's surfaces.
    pub inter: f64,
    /// The part of `direct` that is the sun's beams.
    pub beam: f64,
    /// The part of `error` that the data leave open.
    pub data_error: f64,
}

/// An aperture as a rectangle of its surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opening {
    /// Façade or roof.
    pub surface: Surface,
    /// Lower-left corner: (x, z) on the façade, (x, y) on the roof. \[m\]
    pub origin: [f64; 2],
    /// Size in the same order. \[m\]
    pub size: [f64; 2],
}

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Width (x), depth (y), height (z). \[m\]
    pub room: [f64; 3],
    /// Windows and rooflights.
    pub apertures: &'a [Opening],
    /// Sensors along x.
    pub nx: usize,
    /// Sensors along y.
    pub ny: usize,
    /// Results at the centres of the cells, x running fastest; empty before the first result, and without a plane.
    pub cells: &'a [CellValue],
    /// The sensors are listed points instead of a plane.
    pub listed: bool,
    /// Height of the sensor plane. \[m\]
    pub plane_z: f64,
    /// Product and moment in words.
    pub name: &'a str,
    /// Scale forced from outside (comparison). \[lx\]
    pub range: Option<[f64; 2]>,
    /// Changes with the results.
    pub revision: u64,
    /// How far the content is to be trusted.
    pub status: Status<'a>,
}

/// What the user did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// The sensor plane should lie at this height. \[m\]
    PlaneMoved(f64),
}

/// An illuminance and its lines.
type IsoLevel = (f64, Vec<IsoLine>);

/// The tile's own settings and pictures.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Logarithmic colours and section.
    pub log: bool,
    /// Row of sensors in the section, counted along x; the middle one while `None`.
    pub row: Option<usize>,
    scale: Option<ColourScale>,
    lines: Cache<(u64, [usize; 2], ColourScale), Vec<IsoLevel>>,
    mesh: Cache<(u64, Rect, ColourScale), Arc<Mesh>>,
}

const HELP: &str = "Illuminance on the sensor plane from above, façade at the left, with iso-lux lines; under it a \
section along the depth through the row of the cursor (click to keep a row), with lines at 300 and 500 lx and the band \
between the darkest and the brightest row.\nSource: direct part IEA SHC Task 31 report (2005), eq 17; interreflection \
by radiosity; 300 and 500 lx as in EN 17037.";

/// Draws the tile into all the space of `ui`.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = vec![];
    let complete = input.nx > 0 && input.ny > 0 && input.cells.len() == input.nx * input.ny;
    let missing = match (input.listed, input.status.stale, input.status.idle) {
        (true, ..) => "The scene's sensors are listed points; a plan is drawn of a plane of sensors alone.",
        (false, true, false) => "Computing the illuminances…",
        _ => "No illuminances yet: choose a product and a plane of sensors.",
    };
    let words = Words {
        title: "Room",
        subtitle: input.name,
        help: HELP,
        empty: (!complete).then_some(missing),
        controls_width: 170.0,
    };
    let mut log = state.log;
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.toggle_value(&mut log, "log").on_hover_text("Logarithmic colours and section");
            let mut z = input.plane_z;
            let drag = egui::DragValue::new(&mut z).range(0.0..=input.room[2]).speed(0.01).suffix(" m").max_decimals(2);
            let label = ui.label("plane at");
            if ui.add(drag).labelled_by(label.id).changed() {
                actions.push(Action::PlaneMoved(z));
            }
        },
        |ui, rect| picture(ui, rect, input, state),
    );
    state.log = log;
    actions
}

/// The plan on the screen: depth to the right, x downwards (seen from above).
#[derive(Debug, Clone, Copy)]
struct Plan {
    area: Rect,
    scale: f32,
}

impl Plan {
    fn within(rect: Rect, room: [f64; 3]) -> Self {
        let [width, depth] = [room[0].max(1e-3) as f32, room[1].max(1e-3) as f32];
        let scale = (rect.width() / depth).min(rect.height() / width).max(1e-3);
        let size = vec2(depth, width) * scale;
        Self { area: Rect::from_min_size(pos2(rect.left(), rect.center().y - 0.5 * size.y), size), scale }
    }

    fn screen(&self, x: f64, y: f64) -> Pos2 {
        self.area.min + vec2(y as f32, x as f32) * self.scale
    }

    fn room(&self, at: Pos2) -> (f64, f64) {
        let d = (at - self.area.min) / self.scale;
        (f64::from(d.y), f64::from(d.x))
    }
}

fn picture(ui: &mut Ui, rect: Rect, input: &Input<'_>, state: &mut State) -> Foot {
    let palette = Palette::of(ui.visuals());
    // A dark room still needs a scale with an extent.
    let max = input.cells.iter().map(|c| c.total).filter(|v| v.is_finite()).fold(0.0, f64::max).max(1.0);
    let scale = match (input.range, &state.scale) {
        (Some([lo, hi]), _) => {
            // A logarithmic scale cannot begin at 0.
            let lo = if state.log { lo.max(hi * 1e-4) } else { lo };
            ColourScale { lo, hi, log: state.log, map: ColourMap::Sequential }
        }
        // While something is dragged equal colours stay equal illuminances.
        (None, Some(held)) if input.status.hold_scale && held.log == state.log => held.clone(),
        _ => ColourScale::up_to(max, state.log, 2, ColourMap::Sequential),
    };
    state.scale = Some(scale.clone());
    // In a low tile both would be too small to read: the plan goes first.
    let with_section = rect.height() > 230.0;
    let section_height = if with_section { (0.38 * rect.height()).clamp(110.0, 230.0) } else { 0.0 };
    let plan_rect = Rect::from_min_max(
        pos2(rect.left() + LEFT, rect.top() + 2.0),
        pos2(rect.right() - RIGHT, rect.bottom() - section_height - LEGEND_HEIGHT - 6.0),
    );
    let plan = Plan::within(plan_rect, input.room);
    let response = ui.interact(plan.area, ui.scope_id().with("plan"), Sense::click());
    let cell = response.hover_pos().map(|at| {
        let (x, y) = plan.room(at);
        // The far walls belong to the last cells.
        let index = |v: f64, size: f64, n: usize| ((v / size * n as f64) as usize).min(n - 1);
        (index(x, input.room[0], input.nx), index(y, input.room[1], input.ny))
    });
    if response.clicked() {
        // A second click lets the row go.
        state.row = cell.map(|(i, _)| i).filter(|i| state.row != Some(*i));
    }
    let value = cell.map(|(i, j)| input.cells[j * input.nx + i]);
    // A row that was kept on a finer grid may be beyond this one.
    let row = cell.map(|(i, _)| i).or(state.row).unwrap_or(input.nx / 2).min(input.nx - 1);
    plan_ui(ui, &plan, input, row, state, &scale, &palette);
    let legend = Rect::from_min_size(
        pos2(plan_rect.left() - 14.0, plan_rect.bottom() + 4.0),
        vec2((plan.area.width() + 30.0).max(160.0).min(plan_rect.width() + 10.0), LEGEND_HEIGHT),
    );
    scale.paint_legend(ui.painter(), legend, "lx", value.map(|v| v.total), &palette);
    let mut text = None;
    if with_section {
        // From the plan's left edge to its right: every depth stands under itself.
        let place = Rect::from_min_max(
            pos2(rect.left(), rect.bottom() - section_height),
            pos2(plan.area.right() + RIGHT, rect.bottom()),
        );
        text = section_ui(ui, place, input, row, &scale, cell.map(|(_, j)| j), &palette);
    }
    let summary = summary(input);
    tile::name(ui, &response, "Room plan", summary.full());
    value.map(|v| value_text(&v)).or(text).unwrap_or(summary)
}

fn value_text(v: &CellValue) -> Foot {
    let error = match (v.error, v.data_error) {
        (0.0, _) => String::new(),
        (all, 0.0) => format!(" ± {}", number(all, 2)),
        (all, data) => {
            format!(" ± {} ({} computed, {} data)", number(all, 2), number((all - data).max(0.0), 2), number(data, 2))
        }
    };
    let sun = if v.beam > 0.0 { format!(" (sun's beam {})", si(v.beam, "lx")) } else { String::new() };
    let (direct, inter) = (si(v.direct, "lx"), si(v.inter, "lx"));
    let total = number(v.total, 4);
    let short = if v.error > 0.0 { format!("{total} ± {} lx", number(v.error, 2)) } else { format!("{total} lx") };
    Foot::from([
        format!("{total}{error} lx · direct {direct}{sun} · interreflected {inter}"),
        format!("{total}{error} lx · direct {direct}"),
        short,
        format!("{total} lx"),
    ])
}

fn summary(input: &Input<'_>) -> Foot {
    let totals = || input.cells.iter().map(|c| c.total);
    let mean = si(totals().sum::<f64>() / input.cells.len().max(1) as f64, "lx");
    let (min, max) = (totals().fold(f64::INFINITY, f64::min), totals().fold(0.0, f64::max));
    let error = error_words(input.cells.iter().map(|c| Estimate::new(c.total, c.error)));
    Foot::from([
        format!("mean {mean} · min {} · max {} · {error}", si(min, "lx"), si(max, "lx")),
        format!("mean {mean} · {} to {}", number(min, 3), si(max, "lx")),
        format!("{} to {}", number(min, 3), si(max, "lx")),
        format!("mean {mean}"),
    ])
}

fn plan_ui(
    ui: &Ui,
    plan: &Plan,
    input: &Input<'_>,
    row: usize,
    state: &mut State,
    scale: &ColourScale,
    palette: &Palette,
) {
    let (nx, ny) = (input.nx, input.ny);
    let step = [input.room[0] / nx as f64, input.room[1] / ny as f64];
    let painter = ui.painter();
    let mesh = state.mesh.get((input.revision, plan.area, scale.clone()), || {
        let mut mesh = Mesh::default();
        for (k, cell) in input.cells.iter().enumerate() {
            let (i, j) = ((k % nx) as f64, (k / nx) as f64);
            let place = Rect::from_two_pos(
                plan.screen(i * step[0], j * step[1]),
                plan.screen((i + 1.0) * step[0], (j + 1.0) * step[1]),
            );
            mesh.add_colored_rect(place, scale.colour(cell.total));
        }
        Arc::new(mesh)
    });
    painter.add(Shape::Mesh(mesh.clone()));
    let lines = state.lines.get((input.revision, [nx, ny], scale.clone()), || {
        let totals: Vec<f64> = input.cells.iter().map(|c| c.total).collect();
        iso_levels(scale, &totals).into_iter().map(|level| (level, iso_lines(nx, ny, &totals, level))).collect()
    });
    // Nodes are cell centres.
    let node = |p: &[f64; 2]| plan.screen((p[0] + 0.5) * step[0], (p[1] + 0.5) * step[1]);
    // The row of the section; labels of the lines keep off it.
    let x = (row as f64 + 0.5) * step[0];
    let dashes = [plan.screen(x, 0.0), plan.screen(x, input.room[1])];
    painter.extend(Shape::dashed_line(&dashes, Stroke::new(1.2, Color32::WHITE), 4.0, 4.0));
    let mut used: Vec<Rect> = vec![Rect::from_two_pos(dashes[0], dashes[1]).expand(1.0)];
    used.push(scale_bar(ui, plan.area, plan.scale));
    let mut named: Vec<(f64, Vec<Vec<Pos2>>)> = vec![];
    for (level, lines) in lines {
        let colour = contrast(scale.colour(*level));
        let on_screen = lines.iter().map(|line| {
            let mut points: Vec<Pos2> = line.points.iter().map(node).collect();
            if line.closed {
                points.push(points[0]);
            }
            painter.add(Shape::line(points.clone(), Stroke::new(1.2, colour.gamma_multiply(0.85))));
            points
        });
        named.push((*level, on_screen.collect()));
    }
    // The names come over all lines, those of the levels that are asked for first.
    named.sort_by_key(|(level, _)| !ASKED_FOR.contains(level));
    for (level, lines) in &named {
        let asked_for = ASKED_FOR.contains(level);
        let mut done = false;
        for points in lines {
            done |= label_line(ui, points, *level, scale, plan.area, &mut used);
        }
        // Crossed by the row's dashes or by another name at worst, but never without its own.
        if asked_for && !done {
            let longest = lines.iter().max_by_key(|points| points.len());
            if let Some(points) = longest {
                label_line(ui, points, *level, scale, plan.area, &mut vec![]);
            }
        }
    }
    painter.rect_stroke(plan.area, 0, Stroke::new(1.5, palette.outline), StrokeKind::Outside);
    for aperture in input.apertures {
        let [o, s] = [aperture.origin, aperture.size];
        match aperture.surface {
            Surface::Facade => {
                let ends = [plan.screen(o[0], 0.0), plan.screen(o[0] + s[0], 0.0)].map(|p| p - vec2(4.0, 0.0));
                painter.line_segment(ends, Stroke::new(5.0, palette.first));
            }
            Surface::Roof => {
                let place = Rect::from_two_pos(plan.screen(o[0], o[1]), plan.screen(o[0] + s[0], o[1] + s[1]));
                painter.rect_stroke(place, 0, Stroke::new(2.0, palette.first), StrokeKind::Middle);
            }
        }
    }
    let galley = painter.layout_no_wrap("façade".to_owned(), FontId::proportional(13.0), palette.weak);
    let at = pos2(plan.area.left() - 18.0, plan.area.center().y) - 0.5 * galley.size();
    painter.add(
        egui::epaint::TextShape::new(at, galley, palette.weak)
            .with_angle_and_anchor(-std::f32::consts::FRAC_PI_2, Align2::CENTER_CENTER),
    );
}

fn section_ui(
    ui: &mut Ui,
    rect: Rect,
    input: &Input<'_>,
    row: usize,
    scale: &ColourScale,
    pointed: Option<usize>,
    palette: &Palette,
) -> Option<Foot> {
    let (nx, ny, depth) = (input.nx, input.ny, input.room[1]);
    let at_depth = |j: usize| (j as f64 + 0.5) / ny as f64 * depth;
    let value = |i: usize, j: usize| input.cells[j * nx + i];
    // Between the darkest and the brightest row.
    let band = |j: usize| {
        let of_rows = || (0..nx).map(|i| value(i, j).total);
        [of_rows().fold(f64::INFINITY, f64::min), of_rows().fold(0.0, f64::max)]
    };
    let line =
        |name: &str, of: fn(CellValue) -> f64| Series::line(name, (0..ny).map(|j| [at_depth(j), of(value(row, j))]));
    let axis = if scale.log { Axis::log } else { Axis::linear };
    let plot = Plot {
        x: Axis::linear([0.0, depth], "distance from the façade", Unit::Named("m")),
        y: axis([scale.lo, scale.hi], format!("E in row {} of {nx}", row + 1), Unit::Named("lx")),
        series: vec![
            Series { band: (0..ny).map(band).collect(), ..line("total", |v| v.total) },
            line("direct", |v| v.direct),
        ],
        guides: [300.0, 500.0]
            .map(|level| Guide { name: format!("{level:.0} lx"), ends: [[0.0, level], [depth, level]] })
            .into(),
    };
    let colours = [palette.first, palette.weak];
    let look = Look::tile(ui.scope_id().with("section"), &colours, palette.second);
    let shown = plot::show(ui, rect, &plot, &look, |_| {});
    tile::name(ui, &shown.response, "Room section", "illuminance against depth");
    let hovered = shown.pointed().map(|[y, _]| ((y / depth * ny as f64).max(0.0) as usize).min(ny - 1));
    let j = hovered.or(pointed)?;
    let v = value(row, j);
    let at = shown.screen(plot.place([at_depth(j), v.total])?);
    ui.painter().with_clip_rect(shown.area()).circle_filled(at, 4.0, palette.first);
    Some(value_text(&v).after(&format!("{} m deep · ", number(at_depth(j), 3))).or(&si(v.total, "lx")))
}

/// All sensors with position and parts.
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("x_m,y_m,z_m,total_lx,error_lx,direct_lx,interreflected_lx,error_data_lx,beam_lx\n");
    for (k, c) in input.cells.iter().enumerate() {
        let x = ((k % input.nx) as f64 + 0.5) / input.nx as f64 * input.room[0];
        let y = ((k / input.nx) as f64 + 0.5) / input.ny as f64 * input.room[1];
        let _ = writeln!(
            out,
            "{x:.4},{y:.4},{:.4},{:.4},{:.4},{:.4},{:.4},{:.4},{:.4}",
            input.plane_z, c.total, c.error, c.direct, c.inter, c.data_error, c.beam
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_and_room_are_inverse() {
        let plan = Plan::within(Rect::from_min_size(pos2(50.0, 10.0), vec2(300.0, 150.0)), [4.0, 6.0, 3.0]);
        let (x, y) = plan.room(plan.screen(1.25, 4.5));
        assert!((x - 1.25).abs() < 1e-4 && (y - 4.5).abs() < 1e-4);
        // Seen from above with the depth to the right, x runs down.
        assert!(plan.screen(1.0, 0.0).y > plan.screen(0.0, 0.0).y);
    }
}
