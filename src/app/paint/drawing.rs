//! Puts a [`Drawing`], made for files, on the window.

use crate::formats::drawing::{Drawing, Rgb, Shape};
use egui::{Align2, Color32, FontId, Painter, Pos2, Stroke, pos2};

/// Draws with the upper left corner of the paper at `origin`, a pixel of the drawing as a point of the window.
pub fn paint(painter: &Painter, origin: Pos2, drawing: &Drawing) {
    let place = |[x, y]: [f64; 2]| pos2(origin.x + x as f32, origin.y + y as f32);
    let ink = |[r, g, b]: Rgb| Color32::from_rgb(r, g, b);
    for shape in &drawing.shapes {
        match shape {
            Shape::Line { points, colour, width } => {
                let points = points.iter().map(|point| place(*point)).collect();
                painter.line(points, Stroke::new(*width as f32, ink(*colour)));
            }
            Shape::Text { at, text, colour } => {
                painter.text(place(*at), Align2::CENTER_CENTER, text, FontId::proportional(11.5), ink(*colour));
            }
        }
    }
}
