//! Output of a drawing as SVG, with lines and areas as vectors and text as text.

use super::font::MIDDLE;
use super::shape::{Align, Point, Rgb, Shape};
use std::fmt::Write as _;

/// Font family of the SVG text: DejaVu Sans, and substitutes where it is not installed.
const FAMILY: &str = "'DejaVu Sans', Verdana, sans-serif";

fn path(points: &[Point]) -> String {
    points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}

fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Returns text with the reserved characters of XML escaped, and control characters replaced by spaces.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Returns a length as text with up to three decimals, without trailing zeros.
fn length(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns the SVG document of shapes on white paper. `[w, h]`: size of the paper in drawing units. `scale`, `unit`:
/// size of a drawing unit, such as 0.25 mm.
pub(super) fn write(shapes: &[Shape], [w, h]: [f64; 2], (scale, unit): (f64, &str)) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}{unit}\" height=\"{}{unit}\" \
         font-family=\"{FAMILY}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        length(w),
        length(h),
        length(w * scale),
        length(h * scale),
    );
    for shape in shapes {
        // Writing to a String cannot fail.
        let _ = match shape {
            Shape::Line { points, colour, width, dash } => {
                let dash = dash.map_or_else(String::new, |[on, off]| format!(" stroke-dasharray=\"{on:.2} {off:.2}\""));
                writeln!(
                    svg,
                    "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
                     stroke-linejoin=\"round\"{dash}/>",
                    path(points),
                    hex(*colour),
                    length(*width),
                )
            }
            Shape::Area { points, colour, opacity, edge } => {
                let colour = hex(*colour);
                let edge = if *edge > 0.0 {
                    format!(" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", length(*edge))
                } else {
                    String::new()
                };
                let opacity =
                    if *opacity < 1.0 { format!(" fill-opacity=\"{}\"", length(*opacity)) } else { String::new() };
                writeln!(svg, "<polygon points=\"{}\" fill=\"{colour}\"{opacity}{edge}/>", path(points))
            }
            Shape::Text { at: [x, y], text, colour, size, align, turn } => {
                let anchor = match align {
                    Align::Start => "start",
                    Align::Middle => "middle",
                    Align::End => "end",
                };
                let turned = if *turn == 0.0 {
                    String::new()
                } else {
                    format!(" transform=\"rotate({} {x:.2} {y:.2})\"", length(*turn))
                };
                writeln!(
                    svg,
                    "<text x=\"{x:.2}\" y=\"{:.2}\" fill=\"{}\" font-size=\"{}\" text-anchor=\"{anchor}\"{turned}>{}</text>",
                    y + MIDDLE * size,
                    hex(*colour),
                    length(*size),
                    escaped(text),
                )
            }
        };
    }
    svg.push_str("</svg>\n");
    svg
}
