//! Pictures of tiles for export: the tile between a header and a footer that identify scene and data.

use super::error::ReportError;
use super::size::Size;
use super::tiles::{TileKind, draw};
use crate::catalogue;
use crate::drawing::colours::Inks;
use crate::drawing::font::{LEADING, shortened, width, wrapped};
use crate::drawing::{Align, Drawing, Frame, Rgb, Shape, TEXT};
use crate::study::moment::bearing_word;
use crate::study::scene_file::SceneFile;
use crate::study::scene_words::{place, sky, time};
use crate::study::subject::Subject;
use crate::texts::export as texts;

/// Appearance of an exported picture: size, colours, caption.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Size of the picture, in pixels or millimetres.
    pub size: Size,
    /// Whether the picture is for black-and-white print, with lines that can be distinguished without colours.
    pub print: bool,
    /// Whether the picture has header and footer: product, location, date and time, uncertainty, origin of the data.
    pub caption: bool,
}

impl Look {
    /// Returns the colours of the picture, for screen or print.
    pub const fn inks(&self) -> &'static Inks {
        if self.print { &Inks::PRINT } else { &Inks::LIGHT }
    }
}

/// Margin on all sides of a picture. \[drawing units\]
const MARGIN: f64 = 14.0;

/// Returns location, orientation, time and sky of a scene as text, e.g. "Stuttgart, south, 21 Mar 12:00, clear (CIE
/// 12)".
pub fn situation(scene: &SceneFile) -> String {
    let words = [place(scene), bearing_word(scene.site.azimuth).to_owned(), time(scene), sky(scene)];
    words.join(", ")
}

/// Function for the origin of a system's data as one line of text; the file format where nothing else is known.
pub struct Origin;

impl Origin {
    /// Returns the origin of the data of the subject's system as text, e.g. "computed by ray tracing (A. Author,
    /// 2024)".
    pub fn words(subject: &Subject) -> String {
        let dataset = subject.dataset();
        let Some(product) = &subject.product else {
            let format = if dataset.format.is_empty() { texts::CLOSED_FORM.get() } else { &dataset.format };
            return texts::data(format);
        };
        let from = &product.provenance;
        let mut words = match from.origin {
            catalogue::Origin::Unknown => texts::DATA_UNKNOWN,
            catalogue::Origin::Measured => texts::DATA_MEASURED,
            catalogue::Origin::Computed => texts::DATA_COMPUTED,
        }
        .to_string();
        if !from.method.is_empty() {
            words.push_str(&format!(": {}", from.method));
        }
        let who: Vec<&str> = [&product.manufacturer, &from.author, &from.date]
            .into_iter()
            .map(|part| &**part)
            .filter(|part| !part.is_empty())
            .collect();
        if who.is_empty() { words } else { format!("{words} ({})", who.join(", ")) }
    }
}

/// Name and version of the program.
pub const PROGRAM: &str = concat!("cfs ", env!("CARGO_PKG_VERSION"));

/// Returns a tile, with the results of `subject`, as a drawing with the requested size and appearance.
///
/// # Errors
/// Returns an error if the tile has nothing to show for this subject.
pub fn picture(subject: &Subject, tile: TileKind, look: &Look) -> Result<Drawing, ReportError> {
    let paper = look.size.paper();
    let inks = look.inks();
    let mut drawing = Drawing::new(paper[0], paper[1]);
    let whole = drawing.frame().inside([MARGIN; 4]);
    if !look.caption {
        draw(&mut drawing, whole, subject, tile, inks)?;
        return Ok(drawing);
    }
    let line = LEADING * TEXT;
    // The figures are known when the tile is drawn, and the tile's height must not depend on them: two lines are
    // reserved.
    const LINES: usize = 2;
    let from = first_lines(&Origin::words(subject), LINES, whole.width);
    let (head, foot) = (2.0 * line + 10.0, (LINES + from.len()) as f64 * line + 6.0);
    let body = whole.inside([0.0, head, 0.0, foot]);
    let figures = draw(&mut drawing, body, subject, tile, inks)?;
    let mut write = |y: f64, text: &str, (size, colour, align): (f64, Rgb, Align)| {
        let at = [whole.left + align.share() * whole.width, y];
        drawing.add(Shape::words(at, text, colour, size, align));
    };
    let title = shortened(&format!("{} – {}", tile.words(), subject.name), 15.0, whole.width);
    write(whole.top + 0.5 * line, &title, (15.0, inks.ink, Align::Start));
    let room = whole.width - width(PROGRAM, TEXT) - 12.0;
    let under = shortened(&situation(&subject.file), TEXT, room);
    write(whole.top + 1.6 * line, &under, (TEXT, inks.weak, Align::Start));
    write(whole.top + 1.6 * line, PROGRAM, (TEXT, inks.weak, Align::End));
    let mut y = body.bottom() + 0.5 * line + 6.0;
    for text in first_lines(&figures, LINES, whole.width) {
        write(y, &text, (TEXT, inks.ink, Align::Start));
        y += line;
    }
    y = whole.bottom() - (from.len() as f64 - 0.5) * line;
    for text in from {
        write(y, &text, (TEXT, inks.weak, Align::Start));
        y += line;
    }
    drawing.shapes.push(rule(Frame::new(whole.left, body.bottom() + 3.0, whole.width, 0.0), inks));
    Ok(drawing)
}

/// Returns the first `most` lines of a text wrapped to the width `room`; the last one ends with "…" if more would
/// follow.
fn first_lines(text: &str, most: usize, room: f64) -> Vec<String> {
    let mut lines = wrapped(text, TEXT, room);
    if lines.len() > most {
        let rest = lines.split_off(most - 1).join(" ");
        lines.push(shortened(&rest, TEXT, room));
    }
    lines
}

/// Returns a thin line along the upper edge of a frame.
pub fn rule(frame: Frame, inks: &Inks) -> Shape {
    Shape::line([[frame.left, frame.top], [frame.right(), frame.top]], inks.grid, 0.8)
}
