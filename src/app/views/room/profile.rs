//! Plot of illuminance or daylight factor against the distance from the façade, in one row of sensor points.

use super::input::{CellValue, Input, Quantity};
use super::words::value_text;
use crate::app::paint::colour_scale::ColourScale;
use crate::app::paint::palette::Palette;
use crate::app::paint::plot::{self, Look};
use crate::app::paint::tile::{self, Foot};
use crate::drawing::plot::{Axis, Guide, Plot, Series, Unit};
use crate::drawing::ticks::number;
use crate::texts::{Text, tiles as say};
use egui::{Rect, Ui};

/// Draws the profile of a row of sensor points (index `row`, counted along x) and the range of all rows. `pointed`:
/// index along y of the point under the pointer in the picture above. Returns the line with the value under the
/// pointer.
pub(super) fn show(
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
        |name: Text, of: fn(CellValue) -> f64| Series::line(name, (0..ny).map(|j| [at_depth(j), of(value(row, j))]));
    let axis = if scale.log { Axis::log } else { Axis::linear };
    let plot = Plot {
        x: Axis::linear([0.0, depth], say::DISTANCE, Unit::Named("m")),
        y: axis(
            [scale.lo, scale.hi],
            say::in_row(input.quantity.sign(), row + 1, nx),
            Unit::Named(input.quantity.unit()),
        ),
        series: vec![
            Series { band: (0..ny).map(band).collect(), ..line(say::TOTAL, |v| v.total) },
            line(say::DIRECT, |v| v.direct),
        ],
        guides: match input.quantity {
            Quantity::Illuminance => [300.0, 500.0]
                .map(|level| Guide { name: format!("{level:.0} lx"), ends: [[0.0, level], [depth, level]] })
                .into(),
            Quantity::DaylightFactor => vec![],
        },
    };
    let colours = [palette.first, palette.weak];
    let look = Look::tile(ui.scope_id().with("section"), &colours, palette.second);
    let shown = plot::show(ui, rect, &plot, &look, |_| {});
    tile::name(ui, &shown.response, say::ROOM_PROFILE, say::ROOM_PROFILE_VALUE.get());
    let hovered = shown.pointed().map(|[y, _]| ((y / depth * ny as f64).max(0.0) as usize).min(ny - 1));
    let j = hovered.or(pointed)?;
    let v = value(row, j);
    let at = shown.screen(plot.place([at_depth(j), v.total])?);
    ui.painter().with_clip_rect(shown.area()).circle_filled(at, 4.0, palette.first);
    let words = value_text(&v, input.quantity).after(&say::metres_deep(number(at_depth(j), 3)));
    Some(words.or(&input.quantity.format(v.total)))
}
