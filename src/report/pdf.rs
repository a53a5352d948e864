//! Conversion of pages (drawings) to a PDF: text as text in the embedded font, lines and areas as vectors. A unit of a
//! drawing is one point (1/72 inch).

use super::ReportError;
use super::picture::PROGRAM;
use crate::drawing::font::{DEJAVU, MIDDLE, width};
use crate::drawing::{Drawing, Point as Place, Rgb, Shape};
use crate::texts::{Language, Text, export as texts, language, visual_parts};
use krilla::Document;
use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Point, Transform};
use krilla::metadata::Metadata;
use krilla::num::NormalizedF32;
use krilla::page::PageSettings;
use krilla::paint::{Fill, LineJoin, Stroke, StrokeDash};
use krilla::surface::Surface;
use krilla::text::{Font, TextDirection};

/// Returns the pages as a PDF with the given title; the current language is stated as that of the document.
///
/// # Errors
/// Returns an error if the PDF encoder fails.
pub fn write(pages: &[Drawing], title: &str) -> Result<Vec<u8>, ReportError> {
    let wrong = |what: Text| ReportError::Pdf(what.into());
    let font = Font::new(DEJAVU.into(), 0).ok_or_else(|| wrong(texts::NO_FONT))?;
    let mut document = Document::new();
    let language = match language() {
        Language::English => "en",
        Language::German => "de",
    };
    let metadata = Metadata::new().title(title.to_owned()).creator(PROGRAM.to_owned()).language(language.to_owned());
    document.set_metadata(metadata);
    for drawing in pages {
        let size = PageSettings::from_wh(drawing.width as f32, drawing.height as f32);
        let mut page = document.start_page_with(size.ok_or_else(|| wrong(texts::NO_EXTENT))?);
        let mut surface = page.surface();
        for shape in &drawing.shapes {
            draw(&mut surface, shape, &font);
        }
        surface.finish();
        page.finish();
    }
    document.finish().map_err(|error| ReportError::Pdf(format!("{error:?}")))
}

fn fill([r, g, b]: Rgb, opacity: f64) -> Fill {
    let opacity = NormalizedF32::new(opacity.clamp(0.0, 1.0) as f32).unwrap_or(NormalizedF32::ONE);
    Fill { paint: rgb::Color::new(r, g, b).into(), opacity, ..Fill::default() }
}

fn stroke([r, g, b]: Rgb, width: f64, dash: Option<[f64; 2]>) -> Stroke {
    Stroke {
        paint: rgb::Color::new(r, g, b).into(),
        width: width as f32,
        line_join: LineJoin::Round,
        dash: dash.map(|dash| StrokeDash { array: dash.map(|length| length as f32).into(), offset: 0.0 }),
        ..Stroke::default()
    }
}

/// Returns the PDF path through points; `None` if it has no extent or a coordinate is not finite.
fn path(points: &[Place], closed: bool) -> Option<Path> {
    if !points.iter().flatten().all(|coordinate| coordinate.is_finite()) {
        return None;
    }
    let mut builder = PathBuilder::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let (x, y) = (*x as f32, *y as f32);
        if k == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
    }
    if closed {
        builder.close();
    }
    builder.finish()
}

fn draw(surface: &mut Surface<'_>, shape: &Shape, font: &Font) {
    match shape {
        Shape::Line { points, colour, width, dash } => {
            let Some(path) = path(points, false) else { return };
            surface.set_fill(None);
            surface.set_stroke(Some(stroke(*colour, *width, *dash)));
            surface.draw_path(&path);
        }
        Shape::Area { points, colour, opacity, edge } => {
            let Some(path) = path(points, true) else { return };
            surface.set_fill(Some(fill(*colour, *opacity)));
            surface.set_stroke((*edge > 0.0).then(|| stroke(*colour, *edge, None)));
            surface.draw_path(&path);
        }
        Shape::Text { at: [x, y], text, colour, size, align, turn } => {
            if text.trim().is_empty() {
                return;
            }
            surface.set_stroke(None);
            surface.set_fill(Some(fill(*colour, 1.0)));
            surface.push_transform(&Transform::from_rotate_at(*turn as f32, *x as f32, *y as f32));
            let mut start = x - align.share() * width(text, *size);
            // The encoder shapes in one direction, and so keeps the text that a reader copies.
            for (range, right_to_left) in visual_parts(text) {
                let direction = if right_to_left { TextDirection::RightToLeft } else { TextDirection::LeftToRight };
                let part = &text[range];
                let at = Point::from_xy(start as f32, (y + MIDDLE * size) as f32);
                surface.draw_text(at, font.clone(), *size as f32, part, false, direction);
                start += width(part, *size);
            }
            surface.pop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_become_a_pdf_with_the_font_in_it() {
        let mut page = Drawing::new(200.0, 100.0);
        page.add(Shape::text([100.0, 50.0], "Lamelle, geöffnet: τ = 0.41", [0; 3]));
        page.add(Shape::cell([[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]], [1, 2, 3]));
        page.add(Shape::line([[0.0, 0.0], [f64::NAN, 9.0]], [1, 2, 3], 1.0));
        let bytes = write(&[page.clone(), page], "Über τ").unwrap();
        assert!(bytes.starts_with(b"%PDF-"));
        let holds = |word: &[u8]| bytes.windows(word.len()).any(|part| part == word);
        assert!(holds(b"DejaVuSans") && holds(b"/Count 2") && holds(b"/FontFile"));
        // A subset: the whole font is 750 kB.
        assert!(bytes.len() < 60_000, "{}", bytes.len());
        assert!(write(&[Drawing::new(0.0, 0.0)], "").is_err());
    }
}
