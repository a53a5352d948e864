//! View of a candidate's difference from the reference: signed differences at the sensor points of a room, or over a
//! hemisphere of directions, with zero in the middle of the colour scale.

use super::Cache;
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _, LEGEND_HEIGHT};
use crate::app::paint::hemisphere::{Disk, Projection, Side};
use crate::app::paint::palette::Palette;
use crate::app::paint::tile::{self, Foot, Status, Words};
use crate::compute::estimate::Estimate;
use crate::drawing::ticks::number;
pub use crate::study::comparison::difference::{Picture, scale};
use crate::texts::tiles as say;
use egui::{Mesh, Rect, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};
use std::sync::Arc;

/// Input of the view in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Differences to draw (candidate minus reference); `None` while they are unknown.
    pub picture: Option<&'a Picture>,
    /// Text shown instead of a missing picture.
    pub missing: &'a str,
    /// Name of the candidate, as title of the view.
    pub title: &'a str,
    /// Name of the reference whose values are subtracted, as subtitle.
    pub less: &'a str,
    /// Colour scale common to all candidates, in the unit of the picture.
    pub scale: &'a ColourScale,
    /// Revision number of the picture, which changes whenever the picture does.
    pub revision: u64,
    /// Status of the results shown: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Cached picture of the view.
#[derive(Debug, Clone, Default)]
pub struct State {
    mesh: Cache<(u64, Rect, ColourScale), Arc<Mesh>>,
}

const PROJECTION: Projection = Projection::ProjectedSolidAngle;

/// Draws the view into all the space of `ui`.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) {
    let words = Words {
        title: input.title,
        subtitle: input.less,
        help: say::DIFFERENCE_ABOUT.get(),
        empty: input.picture.is_none().then_some(input.missing),
        controls_width: 0.0,
    };
    tile::show(
        ui,
        &words,
        &input.status,
        |_| {},
        |ui, rect| match input.picture {
            Some(picture) => draw(ui, rect, picture, input, state),
            None => Foot::default(),
        },
    );
}

fn signed(value: f64, unit: &str) -> String {
    let sign = if value < 0.0 { "−" } else { "+" };
    format!("{sign}{} {unit}", number(value.abs(), 3)).trim_end().to_owned()
}

/// Draws the differences as a floor plan or a disk, with legend. Returns the line under them: the difference under the
/// pointer, or a summary.
fn draw(ui: &mut Ui, rect: Rect, picture: &Picture, input: &Input<'_>, state: &mut State) -> Foot {
    let palette = Palette::of(ui.visuals());
    let scale = input.scale;
    let legend = Rect::from_min_max(pos2(rect.left() + 4.0, rect.bottom() - LEGEND_HEIGHT), rect.max);
    let body = Rect::from_min_max(rect.min, pos2(rect.right(), legend.top() - 4.0));
    let [name, unit] = picture.quantity();
    let (response, pointed) = match picture {
        Picture::Plan { room, count: [nx, ny], values } => {
            let [width, depth] = room.map(|size| size.max(1e-3) as f32);
            let points = (body.width() / depth).min(body.height() / width);
            let area = Rect::from_center_size(body.center(), vec2(depth, width) * points);
            let step = vec2(area.width() / *ny as f32, area.height() / *nx as f32);
            let mesh = state.mesh.get((input.revision, area, scale.clone()), || {
                let mut mesh = Mesh::default();
                for (k, one) in values.iter().enumerate() {
                    // As in the room's plan: the façade at the left, the depth to the right, x downwards.
                    let place = area.min + vec2((k / nx) as f32 * step.x, (k % nx) as f32 * step.y);
                    mesh.add_colored_rect(Rect::from_min_size(place, step), scale.colour(one.value));
                }
                Arc::new(mesh)
            });
            ui.painter().add(Shape::Mesh(mesh.clone()));
            ui.painter().rect_stroke(area, 0, Stroke::new(1.5, palette.outline), StrokeKind::Outside);
            let response = ui.interact(area, ui.scope_id().with("difference"), Sense::hover());
            let at = response.hover_pos().map(|at| {
                let cell = |at: f32, step: f32, count: usize| ((at / step).max(0.0) as usize).min(count - 1);
                values[cell(at.x - area.left(), step.x, *ny) * nx + cell(at.y - area.top(), step.y, *nx)]
            });
            (response, at)
        }
        Picture::Disk { side, cells } => {
            let disk = Disk::within(body);
            let area = Rect::from_center_size(disk.centre, vec2(2.0, 2.0) * disk.radius);
            let mesh = state.mesh.get((input.revision, area, scale.clone()), || {
                Arc::new(disk.cells(PROJECTION, *side, &cells.basis, |cell| scale.colour(cells.values[cell])))
            });
            ui.painter().add(Shape::Mesh(mesh.clone()));
            let caption = if *side == Side::Incident { say::OUTSIDE } else { say::INSIDE };
            disk.frame(ui.painter(), PROJECTION, caption.get(), &palette);
            let response = ui.interact(area, ui.scope_id().with("difference"), Sense::hover());
            let direction = response.hover_pos().and_then(|at| side.direction_at(PROJECTION, disk.disk(at)));
            let at = direction.and_then(|direction| cells.basis.index(direction));
            (response, at.map(|cell| Estimate::exact(cells.values[cell])))
        }
    };
    scale.paint_legend(
        ui.painter(),
        legend,
        format!("{name} {unit}").trim_end(),
        pointed.map(|one| one.value),
        &palette,
    );
    let summary = summary(picture);
    tile::name(ui, &response, say::difference_of(input.title), summary.full());
    match pointed {
        Some(one) if one.error > 0.0 => {
            let (value, error) = (signed(one.value, ""), number(one.error, 2));
            let within = one.value.abs() <= one.error;
            Foot::from([
                if within {
                    say::difference_within(name, value, error, unit)
                } else {
                    say::difference_value(name, value, error, unit)
                },
                format!("{name} {}", signed(one.value, unit)),
            ])
        }
        Some(one) => Foot::from(format!("{name} {}", signed(one.value, unit))),
        None => summary,
    }
}

/// Returns a summary of the differences as text: mean and number of distinct ones at the sensors, or the range over a
/// hemisphere.
fn summary(picture: &Picture) -> Foot {
    let [name, unit] = picture.quantity();
    match picture {
        Picture::Plan { values, .. } => {
            let mean = signed(values.iter().map(|one| one.value).sum::<f64>() / values.len().max(1) as f64, unit);
            let distinct = values.iter().filter(|one| one.value.abs() > one.error).count();
            let all = values.len();
            Foot::from([
                say::difference_mean(name, &mean, distinct, all),
                say::difference_mean_short(name, &mean, distinct, all),
                say::difference_mean_alone(name, mean),
            ])
        }
        Picture::Disk { cells, .. } => {
            let ends = cells.values.iter().fold([0.0_f64; 2], |[low, high], one| [low.min(*one), high.max(*one)]);
            let [low, high] = ends.map(|end| signed(end, unit));
            Foot::from([say::difference_range(name, &low, &high), say::range(low, high)])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_difference_is_the_lightest_colour_and_both_ways_are_told_apart() {
        let scale = scale(37.0);
        assert!(scale.hi >= 37.0 && scale.lo == -scale.hi);
        let light = |value: f64| {
            let c = scale.colour(value);
            u32::from(c.r()) + u32::from(c.g()) + u32::from(c.b())
        };
        assert!(light(0.0) > 700 && light(-30.0) < light(0.0) && light(30.0) < light(0.0));
        assert!(scale.colour(30.0).r() > scale.colour(30.0).b() && scale.colour(-30.0).b() > scale.colour(-30.0).r());
    }

    #[test]
    fn the_summary_counts_what_is_more_than_the_errors() {
        let values = vec![Estimate::new(10.0, 2.0), Estimate::new(-1.0, 2.0)];
        let picture = Picture::Plan { room: [1.0, 2.0], count: [1, 2], values };
        assert_eq!(picture.reach(), 10.0);
        assert_eq!(summary(&picture).full(), "mean ΔE +4.50 lx · above the uncertainty at 1 of 2 points");
    }
}
