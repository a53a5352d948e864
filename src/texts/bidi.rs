//! Visual order of the parts of a line with Hebrew, Arabic or another script from right to left.
//!
//! Letters are not turned or joined here: the code that draws a part passes it to a shaper with its direction.

use std::ops::Range;
use unicode_bidi::{BidiClass, Level, ParagraphBidiInfo, bidi_class};

/// Returns whether a text has letters that are written from right to left.
pub fn has_right_to_left(text: &str) -> bool {
    // Hebrew is the first such script in Unicode. Asked of every text of every frame.
    let of_such_script = |letter| letter >= '\u{590}' && matches!(bidi_class(letter), BidiClass::R | BidiClass::AL);
    !text.is_ascii() && text.chars().any(of_such_script)
}

/// Returns the parts of a line from left to right as they are seen, and whether each is written from right to left:
/// such words whole, in the order of their letters, and the text between them one by one.
///
/// The line itself runs from left to right, as the sentences of the program do, whatever name they begin with.
pub fn visual_parts(line: &str) -> Vec<(Range<usize>, bool)> {
    if !has_right_to_left(line) {
        return vec![(0..line.len(), false)];
    }
    let (levels, runs) = ParagraphBidiInfo::new(line, Some(Level::ltr())).visual_runs(0..line.len());
    let mut parts = Vec::new();
    for run in runs {
        if levels[run.start].is_ltr() {
            parts.push((run, false));
            continue;
        }
        let first = parts.len();
        let mut in_word = false;
        for (start, letter) in line[run.clone()].char_indices() {
            let letter_range = run.start + start..run.start + start + letter.len_utf8();
            // A mark belongs to its letter.
            let of_word = matches!(bidi_class(letter), BidiClass::R | BidiClass::AL | BidiClass::NSM);
            match parts.last_mut() {
                Some((word, _)) if in_word && of_word => word.end = letter_range.end,
                _ => parts.push((letter_range, true)),
            }
            in_word = of_word;
        }
        parts[first..].reverse();
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Letters from left to right.
    fn seen(line: &str) -> String {
        let part = |(range, right_to_left): (Range<usize>, bool)| -> String {
            if right_to_left { line[range].chars().rev().collect() } else { line[range].to_owned() }
        };
        visual_parts(line).into_iter().map(part).collect()
    }

    #[test]
    fn words_from_right_to_left_stand_in_the_order_of_reading() {
        for (line, left_to_right) in [
            ("Raffstore 80, τ = 0.3", "Raffstore 80, τ = 0.3"),
            ("תריס", "סירת"),
            ("תריס אלומיניום 80", "80 םוינימולא סירת"),
            ("Section – תריס לבן, open", "Section – ןבל סירת, open"),
            // A number belongs to the words before it.
            ("Section – תריס לבן, 45°", "Section – 45° ,ןבל סירת"),
            ("\"תריס Raffstore\" was added", "\"סירת Raffstore\" was added"),
            ("ستارة 80/72 بيضاء", "ءاضيب 80/72 ةراتس"),
            ("铝百叶窗", "铝百叶窗"),
            ("", ""),
        ] {
            assert_eq!(seen(line), left_to_right, "{line}");
        }
        // A word is one part, whose letters a shaper joins; the blank between two words is another.
        let line = "ستارة معدنية";
        assert_eq!(visual_parts(line), [(11..line.len(), true), (10..11, true), (0..10, true)]);
        // A vowel sign stays with its letter.
        assert_eq!(visual_parts("תּריס"), [(0.."תּריס".len(), true)]);
    }
}
