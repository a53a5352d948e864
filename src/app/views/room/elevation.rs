//! The section of the room, as seen from the side: apertures, the sensor plane in the colours of a row of sensor
//! points, a scale.

use super::input::{Frame, Input};
use super::marks::scale_bar;
use super::plan::{outline, things};
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _};
use crate::app::paint::palette::Palette;
use egui::{Rect, Stroke, StrokeKind, Ui, vec2};

/// Height of the coloured strip that represents the sensor plane. \[points\]
const STRIP: f32 = 6.0;

/// Draws the section of the room. `row`: index, counted along x, of the row of sensor points shown.
pub(super) fn show(ui: &Ui, frame: &Frame, input: &Input<'_>, row: usize, scale: &ColourScale, palette: &Palette) {
    let painter = ui.painter();
    painter.rect_filled(frame.area, 0, palette.face);
    let mut there = things(frame, input);
    there.extend(
        input.plane_z.map(|z| {
            Rect::from_two_pos(frame.screen(0.0, z), frame.screen(input.room[1], z)).expand2(vec2(0.0, STRIP))
        }),
    );
    scale_bar(ui, frame.area, frame.scale, &[], &there);
    if let Some(z) = input.plane_z {
        let ends = [frame.screen(0.0, z), frame.screen(input.room[1], z)];
        let strip = Rect::from_two_pos(ends[0], ends[1]).expand2(vec2(0.0, 0.5 * STRIP));
        if input.complete() {
            let step = input.room[1] / input.ny as f64;
            for j in 0..input.ny {
                let [left, right] = [j, j + 1].map(|j| frame.screen(j as f64 * step, z).x);
                let cell = Rect::from_x_y_ranges(left..=right, strip.y_range());
                painter.rect_filled(cell, 0, scale.colour(input.cells[j * input.nx + row].total));
            }
        }
        painter.rect_stroke(strip, 0, Stroke::new(1.0, palette.ink), StrokeKind::Outside);
    }
    outline(ui, frame, input, palette);
}
