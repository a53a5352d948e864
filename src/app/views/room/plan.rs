//! The floor plan of the room: results at the sensor points in false colours with iso-lux lines, the row of the
//! section, a scale bar.

use super::input::{Frame, Input};
use super::marks::{label_line, scale_bar};
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _};
use crate::app::paint::contour::{ASKED_FOR, IsoLine, iso_levels, iso_lines};
use crate::app::paint::palette::{Palette, contrast};
use crate::app::views::Cache;
use crate::compute::direction::Surface;
use crate::drawing::ticks::tick;
use crate::texts::tiles as say;
use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Shape, Stroke, StrokeKind, Ui, pos2, vec2};
use std::sync::Arc;

/// Iso-lux level: value in the unit of the results, and its lines.
type IsoLevel = (f64, Vec<IsoLine>);

/// Cached mesh and iso-lux lines of the floor plan.
#[derive(Debug, Clone, Default)]
pub struct Pictures {
    lines: Cache<(u64, [usize; 2], ColourScale), Vec<IsoLevel>>,
    mesh: Cache<(u64, Rect, ColourScale), Arc<Mesh>>,
}

/// Draws the floor plan. `row`: index, counted along x, of the row of sensor points that the section shows.
pub(super) fn show(
    ui: &Ui,
    plan: &Frame,
    input: &Input<'_>,
    row: usize,
    pictures: &mut Pictures,
    scale: &ColourScale,
    palette: &Palette,
) {
    let (nx, ny) = (input.nx, input.ny);
    let step = [input.room[0] / nx as f64, input.room[1] / ny as f64];
    let painter = ui.painter();
    let mesh = pictures.mesh.get((input.revision, plan.area, scale.clone()), || {
        let mut mesh = Mesh::default();
        for (k, cell) in input.cells.iter().enumerate() {
            let (i, j) = ((k % nx) as f64, (k / nx) as f64);
            let place = Rect::from_two_pos(
                plan.screen(j * step[1], i * step[0]),
                plan.screen((j + 1.0) * step[1], (i + 1.0) * step[0]),
            );
            mesh.add_colored_rect(place, scale.colour(cell.total));
        }
        Arc::new(mesh)
    });
    painter.add(Shape::Mesh(mesh.clone()));
    let lines = pictures.lines.get((input.revision, [nx, ny], scale.clone()), || {
        let totals: Vec<f64> = input.cells.iter().map(|c| c.total).collect();
        iso_levels(scale, &totals).into_iter().map(|level| (level, iso_lines(nx, ny, &totals, level))).collect()
    });
    // Nodes are cell centres.
    let node = |p: &[f64; 2]| plan.screen((p[1] + 0.5) * step[1], (p[0] + 0.5) * step[0]);
    // The row of the section; labels of the lines keep off it.
    let x = (row as f64 + 0.5) * step[0];
    let dashes = [plan.screen(0.0, x), plan.screen(input.room[1], x)];
    painter.extend(Shape::dashed_line(&dashes, Stroke::new(1.2, Color32::WHITE), 4.0, 4.0));
    let mut used: Vec<Rect> = vec![Rect::from_two_pos(dashes[0], dashes[1]).expand(1.0)];
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
    let mut on_plan: Vec<Vec<Pos2>> = named.iter().flat_map(|(_, lines)| lines.iter().cloned()).collect();
    on_plan.push(dashes.to_vec());
    let bar = scale_bar(ui, plan.area, plan.scale, &on_plan, &things(plan, input));
    used.push(bar);
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
                let beside = label_line(ui, points, *level, scale, plan.area, &mut vec![bar]);
                if !beside {
                    label_line(ui, points, *level, scale, plan.area, &mut vec![]);
                }
            }
        }
    }
    outline(ui, plan, input, palette);
}

/// Returns the rectangles of other things in the picture, which labels must not cover: listed sensor points with their
/// values, apertures.
pub(super) fn things(frame: &Frame, input: &Input<'_>) -> Vec<Rect> {
    let sensor = |point: &[f64; 3]| {
        let at = frame.screen(point[1], if frame.side { point[2] } else { point[0] });
        Rect::from_min_max(at - vec2(7.0, 9.0), at + vec2(50.0, 9.0))
    };
    let openings = input.apertures.iter().map(|one| frame.opening(one, input.room).expand(4.0));
    input.points.iter().map(sensor).chain(openings).collect()
}

/// Draws the outline of the room with its apertures in plan.
pub(super) fn outline(ui: &Ui, frame: &Frame, input: &Input<'_>, palette: &Palette) {
    let painter = ui.painter();
    painter.rect_stroke(frame.area, 0, Stroke::new(1.5, palette.outline), StrokeKind::Outside);
    for aperture in input.apertures {
        let place = frame.opening(aperture, input.room);
        match (aperture.surface, frame.side) {
            (Surface::Facade, _) => {
                let ends = [place.left_top(), place.left_bottom()].map(|p| p - vec2(4.0, 0.0));
                painter.line_segment(ends, Stroke::new(5.0, palette.first));
            }
            (Surface::Roof, true) => {
                let ends = [place.left_top(), place.right_top()].map(|p| p - vec2(0.0, 4.0));
                painter.line_segment(ends, Stroke::new(5.0, palette.first));
            }
            (Surface::Roof, false) => {
                painter.rect_stroke(place, 0, Stroke::new(2.0, palette.first), StrokeKind::Middle);
            }
        }
    }
    let galley = painter.layout_no_wrap(say::FACADE.into(), FontId::proportional(13.0), palette.weak);
    let at = pos2(frame.view.left() - 18.0, frame.area.center().y) - 0.5 * galley.size();
    painter.add(
        egui::epaint::TextShape::new(at, galley, palette.weak)
            .with_angle_and_anchor(-std::f32::consts::FRAC_PI_2, Align2::CENTER_CENTER),
    );
}

/// Draws listed sensor points with their values, in plan or section.
pub(super) fn points(ui: &Ui, frame: &Frame, input: &Input<'_>, scale: &ColourScale, palette: &Palette) {
    for (number, point) in input.points.iter().enumerate() {
        let at = frame.screen(point[1], if frame.side { point[2] } else { point[0] });
        let value = input.cells.get(number).map(|cell| cell.total);
        let colour = value.map_or(palette.face, |value| scale.colour(value));
        ui.painter().circle(at, 5.0, colour, Stroke::new(1.5, palette.ink));
        if let Some(value) = value {
            let (text, font) = (tick(value), FontId::proportional(13.0));
            ui.painter().text(at + vec2(8.0, 0.0), Align2::LEFT_CENTER, text, font, palette.ink);
        }
    }
}
