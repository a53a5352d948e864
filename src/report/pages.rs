//! Pages of a report, filled from the top: headings, paragraphs, figures, tables and pictures on one grid, with a
//! running footer. Lengths are in points on A4 paper (1 pt = 1/72 inch).

use super::picture::{PROGRAM, rule};
use super::table::Table;
use crate::drawing::colours::Inks;
use crate::drawing::font::{LEADING, shortened, width, wrapped};
use crate::drawing::{Align, Drawing, Frame, Rgb, Shape};
use crate::texts::export as texts;

/// Size of an A4 page. \[pt\]
const PAPER: [f64; 2] = [595.28, 841.89];
/// Margins of a page: left, top, right, bottom. \[pt\]
const MARGINS: [f64; 4] = [56.0, 56.0, 56.0, 64.0];
/// Width of a page between its margins. \[pt\]
pub const WIDTH: f64 = PAPER[0] - MARGINS[0] - MARGINS[2];
/// Font size of body text. \[pt\]
pub const BODY: f64 = 8.8;
/// Font size of captions and of the footer. \[pt\]
const SMALL: f64 = 7.6;
/// Font size of headings. \[pt\]
const HEADING: f64 = 11.5;
/// Font size of the title. \[pt\]
const TITLE: f64 = 19.0;
/// Horizontal gap between columns. \[pt\]
const GAP: f64 = 14.0;

/// Picture of a report with its caption.
pub struct Figure {
    /// Drawing of the picture.
    pub drawing: Drawing,
    /// Caption under the picture; may be empty.
    pub caption: String,
}

/// Pages of a report while they are filled with content.
pub struct Pages {
    done: Vec<Drawing>,
    page: Drawing,
    /// Vertical position, from the top of the page, at which the next item begins. \[pt\]
    top: f64,
    /// Title in the running footer.
    title: String,
    inks: Inks,
}

impl Pages {
    /// Creates the first page of a report, with the kind of report (e.g. "Product sheet"), the title and a line of text
    /// under it; `inks`: colours for screen or print.
    pub fn new(kind: &str, title: &str, under: &str, inks: &Inks) -> Self {
        let page = Drawing::new(PAPER[0], PAPER[1]);
        let title_of = format!("{kind} · {title}");
        let mut pages = Self { done: Vec::new(), page, top: MARGINS[1], title: title_of, inks: *inks };
        pages.text(kind, SMALL, inks.weak);
        pages.top += 4.0;
        pages.text(title, TITLE, inks.ink);
        pages.top += 2.0;
        pages.text(under, BODY, inks.weak);
        pages.top += 6.0;
        pages
    }

    /// Returns the height that is still free on the current page. \[pt\]
    fn left(&self) -> f64 {
        PAPER[1] - MARGINS[3] - self.top
    }

    fn turn(&mut self) {
        let full = std::mem::replace(&mut self.page, Drawing::new(PAPER[0], PAPER[1]));
        self.done.push(full);
        self.top = MARGINS[1];
    }

    /// Begins a new page if less than `height` \[pt\] is free on the current one, unless that is still empty.
    pub fn need(&mut self, height: f64) {
        if self.left() < height && self.top > MARGINS[1] {
            self.turn();
        }
    }

    /// Adds vertical space of the given height. \[pt\]
    pub fn gap(&mut self, height: f64) {
        self.top += height;
    }

    fn line(&mut self, x: f64, text: &str, (size, colour, align): (f64, Rgb, Align)) {
        let at = [x, self.top + 0.5 * LEADING * size];
        self.page.add(Shape::words(at, text, colour, size, align));
    }

    fn text(&mut self, text: &str, size: f64, colour: Rgb) {
        for line in wrapped(text, size, WIDTH) {
            self.need(LEADING * size);
            self.line(MARGINS[0], &line, (size, colour, Align::Start));
            self.top += LEADING * size;
        }
    }

    /// Adds a heading, on the same page as the next item.
    pub fn heading(&mut self, text: &str) {
        self.need(104.0);
        if self.top > MARGINS[1] {
            self.top += 14.0;
            let frame = Frame::new(MARGINS[0], self.top, WIDTH, 0.0);
            self.page.add(rule(frame, &self.inks));
            self.top += 6.0;
        }
        self.text(text, HEADING, self.inks.ink);
        self.top += 4.0;
    }

    /// Adds a paragraph over the whole width between the margins.
    pub fn paragraph(&mut self, text: &str) {
        self.text(text, BODY, self.inks.ink);
        self.top += 3.0;
    }

    /// Adds a paragraph in smaller, grey letters.
    pub fn note(&mut self, text: &str) {
        self.text(text, SMALL, self.inks.weak);
        self.top += 2.0;
    }

    /// Adds pairs of name and value in two columns that are filled alternately; long texts take the whole width.
    pub fn figures(&mut self, list: &[(String, String)]) {
        const NAME: f64 = 118.0;
        let half = 0.5 * (WIDTH - GAP);
        let mut column = 0;
        let mut high = 0.0;
        for (name, value) in list {
            let wide = width(value, BODY) > half - NAME;
            if wide && column == 1 {
                self.top += high;
                (column, high) = (0, 0.0);
            }
            let x = MARGINS[0] + column as f64 * (half + GAP);
            let room = if wide { WIDTH - NAME } else { half - NAME };
            let (names, lines) = (wrapped(name, BODY, NAME - 8.0), wrapped(value, BODY, room));
            let count = names.len().max(lines.len());
            let needed = count as f64 * LEADING * BODY + 1.5;
            if column == 0 {
                self.need(needed);
            }
            let start = self.top;
            for k in 0..count {
                self.top = start + k as f64 * LEADING * BODY;
                if let Some(text) = names.get(k) {
                    self.line(x, text, (BODY, self.inks.weak, Align::Start));
                }
                if let Some(text) = lines.get(k) {
                    self.line(x + NAME, text, (BODY, self.inks.ink, Align::Start));
                }
            }
            self.top = start;
            high = f64::max(high, needed);
            column += 1;
            if wide || column == 2 {
                self.top += high;
                (column, high) = (0, 0.0);
            }
        }
        self.top += high + 2.0;
    }

    /// Adds a table, whose head is repeated on every page.
    pub fn table(&mut self, table: &Table) {
        let widths = table.widths(BODY, GAP, WIDTH);
        let head = table.head(BODY, &widths);
        let lines =
            |cells: &[Vec<String>]| cells.iter().map(Vec::len).max().unwrap_or(1).max(1) as f64 * LEADING * BODY;
        let below = |cells: &[Vec<String>]| lines(cells) + 5.0;
        let mut begun = false;
        for row in &table.rows {
            let cells = table.lines(row, BODY, &widths);
            let needed = below(&cells) + if begun { 0.0 } else { below(&head) };
            if self.left() < needed && self.top > MARGINS[1] {
                self.turn();
                begun = false;
            }
            if !begun {
                self.cells(table, &head, &widths, self.inks.weak);
                self.page.add(Shape::line(
                    [[MARGINS[0], self.top - 1.0], [MARGINS[0] + WIDTH, self.top - 1.0]],
                    self.inks.outline,
                    0.7,
                ));
                self.top += 2.0;
                begun = true;
            }
            self.cells(table, &cells, &widths, self.inks.ink);
            self.page.add(Shape::line(
                [[MARGINS[0], self.top - 1.5], [MARGINS[0] + WIDTH, self.top - 1.5]],
                self.inks.grid,
                0.4,
            ));
        }
        self.top += 4.0;
    }

    fn cells(&mut self, table: &Table, cells: &[Vec<String>], widths: &[f64], colour: Rgb) {
        let count = cells.iter().map(Vec::len).max().unwrap_or(1).max(1);
        let start = self.top;
        let mut x = MARGINS[0];
        for ((column, lines), wide) in table.columns.iter().zip(cells).zip(widths) {
            for (k, text) in lines.iter().enumerate() {
                self.top = start + k as f64 * LEADING * BODY;
                self.line(x + column.align.share() * wide, text, (BODY, colour, column.align));
            }
            x += wide + GAP;
        }
        self.top = start + count as f64 * LEADING * BODY + 3.0;
    }

    /// Adds pictures side by side, each with its caption under it and none higher than `most` \[pt\].
    pub fn pictures(&mut self, row: &[Figure], most: f64) {
        if row.is_empty() {
            return;
        }
        let count = row.len() as f64;
        let wide = (WIDTH - GAP * (count - 1.0)) / count;
        let high = |figure: &Figure| (wide * figure.drawing.height / figure.drawing.width).min(most);
        let height = row.iter().map(high).fold(0.0, f64::max);
        let captions: Vec<Vec<String>> = row.iter().map(|figure| wrapped(&figure.caption, SMALL, wide)).collect();
        let lines = captions.iter().map(Vec::len).max().unwrap_or(0) as f64;
        self.need(height + lines * LEADING * SMALL + 10.0);
        let start = self.top;
        for (k, (figure, caption)) in row.iter().zip(&captions).enumerate() {
            let left = MARGINS[0] + k as f64 * (wide + GAP);
            self.page.place(&figure.drawing, Frame::new(left, start, wide, height));
            for (line, text) in caption.iter().enumerate() {
                self.top = start + height + 4.0 + line as f64 * LEADING * SMALL;
                self.line(left, text, (SMALL, self.inks.weak, Align::Start));
            }
        }
        self.top = start + height + 8.0 + lines * LEADING * SMALL;
    }

    /// Returns the finished pages with their footers.
    pub fn finish(mut self) -> Vec<Drawing> {
        self.turn();
        let count = self.done.len();
        for (k, page) in self.done.iter_mut().enumerate() {
            let y = PAPER[1] - 36.0;
            page.add(rule(Frame::new(MARGINS[0], y - 12.0, WIDTH, 0.0), &self.inks));
            let number = texts::page_of(PROGRAM, k + 1, count);
            let room = WIDTH - width(&number, SMALL) - GAP;
            let title = shortened(&self.title, SMALL, room);
            page.add(Shape::words([MARGINS[0], y], title, self.inks.weak, SMALL, Align::Start));
            page.add(Shape::words([MARGINS[0] + WIDTH, y], number, self.inks.weak, SMALL, Align::End));
        }
        self.done
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(page: &Drawing) -> Vec<(String, f64)> {
        let text = |shape: &Shape| match shape {
            Shape::Text { text, at, .. } => Some((text.clone(), at[1])),
            _ => None,
        };
        page.shapes.iter().filter_map(text).collect()
    }

    #[test]
    fn long_tables_break_over_pages_and_repeat_their_head() {
        let mut pages = Pages::new("Product sheet", &"A long name of a product ".repeat(6), "maker", &Inks::LIGHT);
        pages.heading("States");
        let mut table = Table::of(["state", "τ normal"]);
        for k in 0..120 {
            table.row([format!("state {k}"), format!("0.{k:03}")]);
        }
        pages.table(&table);
        let done = pages.finish();
        assert!(done.len() >= 3);
        let mut seen = 0;
        for (k, page) in done.iter().enumerate() {
            let words = texts(page);
            assert!(words.iter().any(|(text, _)| text == "τ normal"), "page {k}");
            assert!(words.iter().any(|(text, _)| *text == format!("{PROGRAM} · page {} of {}", k + 1, done.len())));
            // Nothing runs into the foot, nothing beyond the paper.
            let rows: Vec<&(String, f64)> = words.iter().filter(|(text, _)| text.starts_with("state ")).collect();
            assert!(rows.iter().all(|(_, y)| *y < PAPER[1] - MARGINS[3]));
            seen += rows.len();
        }
        assert_eq!(seen, 120);
        for page in &done {
            for shape in &page.shapes {
                if let Shape::Text { at, text, size, align, .. } = shape {
                    let left = at[0] - align.share() * width(text, *size);
                    assert!(
                        left >= MARGINS[0] - 0.1 && left + width(text, *size) <= MARGINS[0] + WIDTH + 0.1,
                        "{text}"
                    );
                }
            }
        }
    }

    #[test]
    fn figures_fill_two_columns_and_long_ones_a_line() {
        let mut pages = Pages::new("Study", "x", "", &Inks::LIGHT);
        let long = "what goes on and on over the whole of the line, and further than that ".repeat(2);
        pages.figures(&[
            ("a".to_owned(), "1".to_owned()),
            ("b".to_owned(), "2".to_owned()),
            ("c".to_owned(), long),
            ("d".to_owned(), "4".to_owned()),
        ]);
        let words = texts(&pages.finish()[0]);
        let y = |name: &str| words.iter().find(|(text, _)| text == name).unwrap().1;
        assert!((y("1") - y("2")).abs() < 1e-9 && y("c") > y("a") && y("d") > y("c") + 2.0 * BODY);
    }
}
