//! A tile as a picture to hand on: what it shows, under a head and over a foot that say what it is.

use super::tiles::{TileKind, draw};
use super::error::ReportError;
use super::size::Size;
use crate::catalogue;
use crate::drawing::colours::Inks;
use crate::drawing::font::{LEADING, shortened, wrapped};
use crate::drawing::{Align, Drawing, Frame, Shape, TEXT};
use crate::study::moment::bearing_word;
use crate::study::scene_file::SceneFile;
use crate::study::scene_words::{place, sky, time};
use crate::study::subject::Subject;

/// How a picture is to look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Its size.
    pub size: Size,
    /// For printers: black lines, told apart without colours.
    pub print: bool,
    /// With product, place, moment, errors and origin round it.
    pub caption: bool,
}

impl Look {
    /// Its inks.
    pub const fn inks(&self) -> &'static Inks {
        if self.print { &Inks::PRINT } else { &Inks::LIGHT }
    }
}

/// Margin round everything.
const MARGIN: f64 = 14.0;

/// "Stuttgart, south, 21 Mar 12:00, clear (CIE 12)".
pub fn situation(scene: &SceneFile) -> String {
    let words = [place(scene), bearing_word(scene.site.azimuth).to_owned(), time(scene), sky(scene)];
    words.join(", ")
}

/// Where data come from, in a line; the format where nothing else is known.
pub struct Origin;

impl Origin {
    /// "computed by ray tracing (A. Author, 2024)".
    pub fn words(subject: &Subject) -> String {
        let dataset = subject.dataset();
        let Some(product) = &subject.product else {
            let format = if dataset.format.is_empty() { "closed form" } else { &dataset.format };
            return format!("data: {format}");
        };
        let from = &product.provenance;
        let mut words = match from.origin {
            catalogue::Origin::Unknown => "data of unknown origin".to_owned(),
            origin => format!("data {}", origin.word()),
        };
        if !from.method.is_empty() {
            words.push_str(&format!(": {}", from.method));
        }
        let who: Vec<&str> =
            [&product.manufacturer, &from.author, &from.date].into_iter().map(|part| &**part).filter(|part| !part.is_empty()).collect();
        if who.is_empty() { words } else { format!("{words} ({})", who.join(", ")) }
    }
}

/// The program and its version.
pub const PROGRAM: &str = concat!("cfs ", env!("CARGO_PKG_VERSION"));

/// A tile as a drawing of the size that is asked for.
///
/// # Errors
/// The tile has nothing to show of this subject.
pub fn picture(subject: &Subject, tile: TileKind, look: &Look) -> Result<Drawing, ReportError> {
    let [width, height] = look.size.paper();
    let inks = look.inks();
    let mut drawing = Drawing::new(width, height);
    let whole = drawing.frame().inside([MARGIN; 4]);
    if !look.caption {
        draw(&mut drawing, whole, subject, tile, inks)?;
        return Ok(drawing);
    }
    let line = LEADING * TEXT;
    // The foot's words are known when the tile is drawn, its height is not to change: two lines of figures, two of origin.
    let origin = wrapped(&format!("{} · {PROGRAM}", Origin::words(subject)), TEXT, whole.width);
    let origin = &origin[..origin.len().min(2)];
    let head = 2.0 * line + 10.0;
    let foot = (2.0 + origin.len() as f64) * line + 6.0;
    let body = whole.inside([0.0, head, 0.0, foot]);
    let figures = draw(&mut drawing, body, subject, tile, inks)?;
    let mut write = |top: f64, text: &str, size: f64, colour| {
        let text = shortened(text, size, whole.width);
        drawing.add(Shape::words([whole.left, top], text, colour, size, Align::Start));
    };
    write(whole.top + 0.5 * line, &format!("{} – {}", tile.title(), subject.name), 15.0, inks.ink);
    write(whole.top + 1.6 * line, &situation(&subject.file), TEXT, inks.weak);
    let mut top = body.bottom() + 0.5 * line + 6.0;
    for text in wrapped(&figures, TEXT, whole.width).iter().take(2) {
        write(top, text, TEXT, inks.ink);
        top += line;
    }
    top = whole.bottom() - (origin.len() as f64 - 0.5) * line;
    for text in origin {
        write(top, text, TEXT, inks.weak);
        top += line;
    }
    drawing.shapes.push(rule(Frame::new(whole.left, body.bottom() + 3.0, whole.width, 0.0), inks));
    Ok(drawing)
}

/// A thin line across a frame's upper edge.
pub fn rule(frame: Frame, inks: &Inks) -> Shape {
    Shape::line([[frame.left, frame.top], [frame.right(), frame.top]], inks.grid, 0.8)
}
