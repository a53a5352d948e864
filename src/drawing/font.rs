//! Font of all drawings: DejaVu Sans as it is shipped, read as far as widths and outlines of letters need (TrueType:
//! `cmap`, `hmtx`, `loca`, `glyf`). Letters that it does not have are drawn as its empty box. Words that are written
//! from right to left are shaped by a library, which joins Arabic letters.

use super::shape::Point;
use crate::texts::visual_parts;
use rustybuzz::{Direction, Face, UnicodeBuffer, shape};
use std::sync::LazyLock;

/// Content of the font file DejaVu Sans (TrueType), which documents embed.
pub static DEJAVU: &[u8] = include_bytes!("../../assets/fonts/DejaVuSans.ttf");

/// Height of the middle of capital letters above the baseline, as a fraction of the font size.
pub const MIDDLE: f64 = 0.36;
/// Distance between the baselines of two lines of text, as a multiple of the font size.
pub const LEADING: f64 = 1.4;

/// Tables of the font file, each by the offset of its first byte in the file.
struct Font {
    glyf: usize,
    loca: usize,
    hmtx: usize,
    /// Glyphs of the characters: first character, last character, glyph of the first.
    groups: Vec<[u32; 3]>,
    metrics: u16,
    units: f64,
    long: bool,
}

/// Returns a byte of the font file; 0 beyond its end, which a whole file never needs.
fn byte(at: usize) -> u8 {
    DEJAVU.get(at).copied().unwrap_or(0)
}

fn u16_at(at: usize) -> u16 {
    u16::from_be_bytes([byte(at), byte(at + 1)])
}

fn i16_at(at: usize) -> i16 {
    i16::from_be_bytes([byte(at), byte(at + 1)])
}

fn u32_at(at: usize) -> u32 {
    u32::from_be_bytes([byte(at), byte(at + 1), byte(at + 2), byte(at + 3)])
}

fn table(tag: &[u8; 4]) -> usize {
    let count = usize::from(u16_at(4));
    let record = (0..count).map(|k| 12 + 16 * k).find(|at| DEJAVU.get(*at..*at + 4) == Some(tag));
    record.map_or(DEJAVU.len(), |at| u32_at(at + 8) as usize)
}

/// Returns the groups of the character map in format 12, which covers all planes of Unicode: first and last character,
/// and glyph of the first.
fn groups(cmap: usize) -> Vec<[u32; 3]> {
    let count = usize::from(u16_at(cmap + 2));
    let starts = (0..count).map(|k| cmap + u32_at(cmap + 4 + 8 * k + 4) as usize);
    let Some(start) = starts.into_iter().find(|start| u16_at(*start) == 12) else { return Vec::new() };
    let groups = u32_at(start + 12) as usize;
    (0..groups).map(|k| [0, 4, 8].map(|part| u32_at(start + 16 + 12 * k + part))).collect()
}

static FONT: LazyLock<Font> = LazyLock::new(|| {
    let head = table(b"head");
    Font {
        glyf: table(b"glyf"),
        loca: table(b"loca"),
        hmtx: table(b"hmtx"),
        groups: groups(table(b"cmap")),
        metrics: u16_at(table(b"hhea") + 34),
        units: f64::from(u16_at(head + 18)),
        long: i16_at(head + 50) != 0,
    }
});

impl Font {
    fn glyph(&self, c: char) -> u16 {
        let code = u32::from(c);
        let group = self.groups.iter().find(|[first, last, _]| (*first..=*last).contains(&code));
        group.map_or(0, |[first, _, glyph]| u16::try_from(glyph + code - first).unwrap_or(0))
    }

    fn advance(&self, glyph: u16) -> f64 {
        let row = glyph.min(self.metrics.saturating_sub(1));
        f64::from(u16_at(self.hmtx + 4 * usize::from(row))) / self.units
    }

    /// Returns the offset of a glyph's outline in the font file; `None` for a glyph without ink.
    fn place(&self, glyph: u16) -> Option<usize> {
        let index = usize::from(glyph);
        let [from, to] = [index, index + 1].map(|k| {
            if self.long { u32_at(self.loca + 4 * k) as usize } else { 2 * usize::from(u16_at(self.loca + 2 * k)) }
        });
        (to > from).then_some(self.glyf + from)
    }

    /// Adds the contours of a glyph in units of the font, x to the right and y up from the start of its baseline.
    /// `depth` limits the nesting of composite glyphs.
    fn contours(&self, glyph: u16, depth: usize, out: &mut Vec<Vec<Point>>) {
        let Some(start) = self.place(glyph) else { return };
        let count = i16_at(start);
        if count >= 0 {
            simple(start + 10, usize::from(count.unsigned_abs()), out);
        } else if depth > 0 {
            self.composite(start + 10, depth, out);
        }
    }

    /// Adds the contours of a composite glyph: those of its parts, each transformed by the matrix and offset that stand
    /// at `at` in the font file.
    fn composite(&self, mut at: usize, depth: usize, out: &mut Vec<Vec<Point>>) {
        loop {
            let (flags, glyph) = (u16_at(at), u16_at(at + 2));
            at += 4;
            let [dx, dy] = if flags & 1 != 0 {
                at += 4;
                [i16_at(at - 4), i16_at(at - 2)].map(f64::from)
            } else {
                at += 2;
                [byte(at - 2), byte(at - 1)].map(|part| f64::from(part.cast_signed()))
            };
            let fixed = |at: usize| f64::from(i16_at(at)) / 16384.0;
            let [a, b, c, d] = if flags & 0x08 != 0 {
                at += 2;
                [fixed(at - 2), 0.0, 0.0, fixed(at - 2)]
            } else if flags & 0x40 != 0 {
                at += 4;
                [fixed(at - 4), 0.0, 0.0, fixed(at - 2)]
            } else if flags & 0x80 != 0 {
                at += 8;
                [fixed(at - 8), fixed(at - 6), fixed(at - 4), fixed(at - 2)]
            } else {
                [1.0, 0.0, 0.0, 1.0]
            };
            let mut part = Vec::new();
            self.contours(glyph, depth - 1, &mut part);
            let place = |[x, y]: Point| [a * x + c * y + dx, b * x + d * y + dy];
            out.extend(part.into_iter().map(|contour| contour.into_iter().map(place).collect()));
            if flags & 0x20 == 0 {
                return;
            }
        }
    }
}

/// Number of line pieces per curve.
const STEPS: usize = 5;

/// Adds the contours of a simple glyph, read from its table in the font file: end points, instructions, flags, x, y.
fn simple(start: usize, count: usize, out: &mut Vec<Vec<Point>>) {
    if count == 0 {
        return;
    }
    let ends: Vec<usize> = (0..count).map(|k| usize::from(u16_at(start + 2 * k))).collect();
    let points = ends[count - 1] + 1;
    let mut at = start + 2 * count;
    at += 2 + usize::from(u16_at(at));
    let mut flags = Vec::with_capacity(points);
    while flags.len() < points {
        let flag = byte(at);
        at += 1;
        let again = if flag & 8 != 0 {
            at += 1;
            usize::from(byte(at - 1))
        } else {
            0
        };
        flags.extend(std::iter::repeat_n(flag, again + 1));
    }
    let mut axis = |short: u8, same: u8| -> Vec<f64> {
        let mut value = 0.0;
        flags[..points]
            .iter()
            .map(|flag| {
                if flag & short != 0 {
                    at += 1;
                    value += if flag & same != 0 { 1.0 } else { -1.0 } * f64::from(byte(at - 1));
                } else if flag & same == 0 {
                    at += 2;
                    value += f64::from(i16_at(at - 2));
                }
                value
            })
            .collect()
    };
    let (x, y) = (axis(0x02, 0x10), axis(0x04, 0x20));
    let mut first = 0;
    for end in ends {
        let contour: Vec<(Point, bool)> = (first..=end).map(|k| ([x[k], y[k]], flags[k] & 1 != 0)).collect();
        first = end + 1;
        out.push(flattened(&contour));
    }
}

fn middle(a: Point, b: Point) -> Point {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// Returns a contour of quadratic curves as a polygon of short lines. Points are on the curve (`true`) or control
/// points; midway between two control points lies a point of the curve.
fn flattened(contour: &[(Point, bool)]) -> Vec<Point> {
    let n = contour.len();
    let mut out = Vec::new();
    for k in 0..n {
        let (here, on) = contour[k];
        if on {
            out.push(here);
            continue;
        }
        let ((before, before_on), (after, after_on)) = (contour[(k + n - 1) % n], contour[(k + 1) % n]);
        let from = if before_on { before } else { middle(before, here) };
        let to = if after_on { after } else { middle(here, after) };
        for step in 1..=STEPS {
            let t = step as f64 / STEPS as f64;
            let u = 1.0 - t;
            out.push([0, 1].map(|i| u * u * from[i] + 2.0 * u * t * here[i] + t * t * to[i]));
        }
    }
    out
}

/// Font as the shaper reads it.
static FACE: LazyLock<Option<Face<'static>>> = LazyLock::new(|| Face::from_slice(DEJAVU, 0));

/// Glyph of a line of text, with its width. Lengths are multiples of the font size.
struct Placed {
    glyph: u16,
    advance: f64,
    /// Shift of the glyph's outline, to the right and up: for vowel signs.
    shift: Point,
}

/// Returns the glyphs of a line of text in the order in which they are drawn, from left to right.
fn placed(text: &str) -> Vec<Placed> {
    let font = &*FONT;
    let mut placed = Vec::with_capacity(text.len());
    for (range, right_to_left) in visual_parts(text) {
        let part = &text[range];
        let Some(face) = FACE.as_ref().filter(|_| right_to_left) else {
            let glyphs = part.chars().map(|c| font.glyph(c));
            placed.extend(glyphs.map(|glyph| Placed { glyph, advance: font.advance(glyph), shift: [0.0; 2] }));
            continue;
        };
        let mut buffer = UnicodeBuffer::new();
        buffer.push_str(part);
        buffer.set_direction(Direction::RightToLeft);
        buffer.guess_segment_properties();
        let shaped = shape(face, &[], buffer);
        placed.extend(shaped.glyph_infos().iter().zip(shaped.glyph_positions()).map(|(info, position)| Placed {
            glyph: u16::try_from(info.glyph_id).unwrap_or(0),
            advance: f64::from(position.x_advance) / font.units,
            shift: [position.x_offset, position.y_offset].map(|length| f64::from(length) / font.units),
        }));
    }
    placed
}

/// Returns the characters of a text that the font does not have.
pub fn missing_characters(text: &str) -> impl Iterator<Item = char> {
    text.chars().filter(|c| !c.is_control() && FONT.glyph(*c) == 0)
}

/// Returns the width of one line of text in the drawings' font, DejaVu Sans. `size` and width: \[drawing units\].
pub fn width(text: &str, size: f64) -> f64 {
    size * placed(text).iter().map(|one| one.advance).sum::<f64>()
}

/// Returns the outlines of a line of text: one list per letter, each with its contours as closed polygons. Points are
/// in the unit of `size`, x to the right from the start of the text, y down from its baseline.
pub fn outlines(text: &str, size: f64) -> Vec<Vec<Vec<Point>>> {
    let font = &*FONT;
    let scale = size / font.units;
    let mut x = 0.0;
    placed(text)
        .into_iter()
        .map(|Placed { glyph, advance, shift: [right, up] }| {
            let mut contours = Vec::new();
            font.contours(glyph, 4, &mut contours);
            let start = [x + size * right, -size * up];
            x += size * advance;
            contours
                .into_iter()
                .map(|one| one.into_iter().map(|[u, v]| [start[0] + scale * u, start[1] - scale * v]).collect())
                .collect()
        })
        .collect()
}

/// Splits a text into lines that are at most `most` wide, between words, and within a word that is wider than a line.
/// `size`, `most`: font size and width in drawing units.
pub fn wrapped(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
            if width(&longer, size) <= most {
                line = longer;
                continue;
            }
            if !line.is_empty() {
                lines.push(std::mem::take(&mut line));
            }
            for c in word.chars() {
                if !line.is_empty() && width(&line, size) + width(c.encode_utf8(&mut [0; 4]), size) > most {
                    lines.push(std::mem::take(&mut line));
                }
                line.push(c);
            }
        }
        lines.push(line);
    }
    lines
}

/// Returns a text that is at most `most` wide, its end replaced by "…" where it would be wider. `size`, `most`: font
/// size and width in drawing units.
pub fn shortened(text: &str, size: f64, most: f64) -> String {
    if width(text, size) <= most {
        return text.to_owned();
    }
    let mut kept: Vec<char> = text.chars().collect();
    loop {
        kept.pop();
        let short: String = kept.iter().collect::<String>().trim_end().to_owned() + "…";
        if kept.is_empty() || width(&short, size) <= most {
            return short;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_the_fonts_own() {
        // Advance widths of DejaVu Sans 2.37 in 1/2048 em: M 1767, i 569, space 651, ä as a.
        assert!((width("M", 2048.0) - 1767.0).abs() < 1e-9);
        assert!((width("i ", 2048.0) - 569.0 - 651.0).abs() < 1e-9);
        assert!((width("ä", 10.0) - width("a", 10.0)).abs() < 1e-9);
        for c in "äöüßÄτθφαβωΩ°·²³µ±≤≥…–−→".chars() {
            assert_ne!(FONT.glyph(c), 0, "{c}");
        }
    }

    fn area(contours: &[Vec<Point>]) -> f64 {
        let one = |points: &Vec<Point>| -> f64 {
            let next = points.iter().cycle().skip(1);
            0.5 * points.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
        };
        contours.iter().map(one).sum::<f64>().abs()
    }

    #[test]
    fn letters_have_ink_and_holes() {
        let of = |text: &str| outlines(text, 100.0);
        assert!(of(" ")[0].is_empty());
        let (o, ring) = (&of("O")[0], &of("o")[0]);
        assert_eq!((o.len(), ring.len()), (2, 2));
        // The hole counts against the outside, so ink is much less than the box.
        assert!(area(o) < 0.55 * 70.0 * 75.0 && area(o) > 500.0, "{}", area(o));
        // ä is a letter with two dots, a composite.
        assert_eq!(of("ä")[0].len(), of("a")[0].len() + 2);
        // The second letter begins where the first ends.
        let left = of("MI")[1][0].iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
        assert!(left > width("M", 100.0));
    }

    #[test]
    fn words_from_right_to_left_are_turned_and_joined() {
        let of = |text: &str| outlines(text, 100.0);
        // The last letter stands left, also of a word among others.
        assert_eq!((of("שלום").len(), &of("שלום")[0]), (4, &of("ם")[0]));
        assert_eq!(of("M שלום")[2].len(), of("ם")[0].len());
        // The first letter is joined with the second: its initial form, which Unicode also has by itself.
        let ink = |text: &str| area(of(text).last().unwrap());
        assert!((ink("ستارة") - ink("\u{feb3}")).abs() < 1e-6 && (ink("ستارة") - ink("س")).abs() > 1.0);
        let together = width("ستارة", 10.0) + width(" 80", 10.0);
        assert!((width("ستارة 80", 10.0) - together).abs() < 1e-9);
    }

    #[test]
    fn characters_that_the_font_lacks_are_known() {
        assert_eq!(missing_characters("Жалюзи 铝窗, תריס, ستارة, Περσίδα\n").collect::<String>(), "铝窗");
    }

    #[test]
    fn lines_break_at_words_and_within_what_is_too_long() {
        let lines = wrapped("a venetian blind Donaudampfschifffahrtsgesellschaft end", 10.0, 90.0);
        assert!(lines.iter().all(|line| width(line, 10.0) <= 90.0), "{lines:?}");
        assert_eq!(lines.concat().replace(' ', ""), "avenetianblindDonaudampfschifffahrtsgesellschaftend");
        assert_eq!(lines[0], "a venetian blind");
        let short = shortened("a venetian blind", 10.0, 60.0);
        assert!(short.ends_with('…') && width(&short, 10.0) <= 60.0);
    }
}
