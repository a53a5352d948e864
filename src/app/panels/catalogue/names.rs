//! Product names in a list: on two lines if necessary; names too long for two lines are cut in the middle, so that the
//! part that distinguishes them from their neighbours remains.

use egui::epaint::text::{LayoutJob, TextWrapping};
use egui::{Color32, FontId, Galley, Painter};
use std::sync::Arc;

/// Maximum number of lines of a product's name.
const LINES: usize = 2;

/// Returns the number of characters at the beginning that two names have in common.
fn common(a: &str, b: &str) -> usize {
    a.chars().zip(b.chars()).take_while(|(a, b)| a == b).count()
}

/// Returns a name shortened to at most `most` characters: its beginning, and the part from the first character that
/// differs from the names before and after it in the list.
fn shortened(name: &str, beside: [Option<&str>; 2], most: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= most || most < 8 {
        return letters.into_iter().take(most).collect();
    }
    let head = most / 3;
    let tail = most - head - 1;
    let end = letters.len() - tail;
    let differs = beside.into_iter().flatten().map(|other| common(name, other)).max().unwrap_or(0);
    // From the space before the word, where a line may end; where the difference is visible anyway the end of the name
    // says more, from a space, too, if one is near.
    let word = letters[..differs.min(letters.len())].iter().rposition(|c| c.is_whitespace()).unwrap_or(0);
    let near = letters[end..end + tail / 2].iter().position(|c| c.is_whitespace()).unwrap_or(0);
    let start = if differs >= head && word < end { word.max(head) } else { end + near };
    let cut = if start + tail < letters.len() { "…" } else { "" };
    let tail: String = letters[start..].iter().take(tail - cut.chars().count()).collect();
    format!("{}…{tail}{cut}", letters[..head].iter().collect::<String>())
}

/// Returns a name laid out in a width \[points\], shortened if necessary. `beside`: names before and after it in the
/// list.
pub(super) fn layout(
    painter: &Painter,
    name: &str,
    beside: [Option<&str>; 2],
    (font, colour): (FontId, Color32),
    width: f32,
) -> Arc<Galley> {
    let laid_out = |text: String| {
        let mut job = LayoutJob::simple(text, font.clone(), colour, width.max(0.0));
        job.wrap = TextWrapping { max_rows: LINES, max_width: width.max(0.0), ..TextWrapping::default() };
        painter.layout_job(job)
    };
    let whole = laid_out(name.to_owned());
    let mut most = name.chars().count();
    let mut galley = whole;
    while galley.elided && most > 16 {
        most -= (most / 12).max(1);
        galley = laid_out(shortened(name, beside, most));
    }
    galley
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_tells_names_apart_is_kept() {
        let name = "Sunshade series nine hundred, coated, alpha, with guide rails and end caps";
        let other = name.replace("alpha", "omega");
        let cut = shortened(name, [Some(&other), None], 40);
        assert!(cut.starts_with("Sunshade") && cut.contains("… alpha") && cut.chars().count() <= 40, "{cut}");
        // With nothing like it beside it, beginning and end.
        let alone = shortened(name, [None, Some("Other")], 40);
        assert!(alone.starts_with("Sunshade") && alone.ends_with("… guide rails and end caps"), "{alone}");
        assert_eq!(shortened("short", [None, None], 40), "short");
        // Differing at the very end.
        let (a, b) = ("A maker's very long name of a product 45", "A maker's very long name of a product 46");
        assert!(shortened(a, [None, Some(b)], 24).ends_with("45"));
    }
}
