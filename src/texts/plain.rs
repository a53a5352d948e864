//! Text from files in a form that can be shown: characters that control a terminal or reverse a line are made visible,
//! and numbers of very many digits are shortened.

use super::import;
use std::borrow::Cow;
use std::fmt::Write as _;

/// Number of digits above which a number is shortened.
const MOST_DIGITS: usize = 24;
/// Maximum number of characters that a message names. Chosen: a line.
const MAX_NAMED: usize = 8;

/// Whether a character has an invisible effect on a terminal or on the order of writing. Line breaks and tabs do not
/// count.
fn acts(c: char) -> bool {
    (c.is_control() && !matches!(c, '\n' | '\t'))
        // Marks that turn the direction of writing, breaks of lines and paragraphs, a mark of the byte order.
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

/// Returns a text in which characters with an invisible effect are written as `\u001b`, which JSON reads as the same
/// characters. A carriage return before a line break stays.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.chars().any(acts) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        if !acts(c) || (c == '\r' && rest.peek() == Some(&'\n')) {
            shown.push(c);
        } else {
            // Writing to a String cannot fail.
            let _ = write!(shown, "\\u{:04x}", u32::from(c));
        }
    }
    Cow::Owned(shown)
}

/// Returns a name or a message on one line: as [`visible`], with line breaks and tabs as blanks.
pub fn one_line(text: &str) -> Cow<'_, str> {
    if !text.contains(['\n', '\r', '\t']) {
        return visible(text);
    }
    let words: Vec<&str> = text.split(['\n', '\r', '\t']).map(str::trim).filter(|part| !part.is_empty()).collect();
    Cow::Owned(visible(&words.join(" ")).into_owned())
}

/// Returns a text in which numbers of very many digits are written as powers of ten.
pub fn short_numbers(text: &str) -> Cow<'_, str> {
    let of_number = |c: char| c.is_ascii_digit() || c == '.';
    let long = |word: &str| word.bytes().filter(u8::is_ascii_digit).count() > MOST_DIGITS;
    if !text.split(|c| !of_number(c)).any(long) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(of_number) {
        let end = rest[start..].find(|c| !of_number(c)).map_or(rest.len(), |length| start + length);
        let word = rest[start..end].trim_end_matches('.');
        let stop = start + word.len();
        // A hash has letters among its digits, and a number stands alone.
        let alone = !rest[..start].ends_with(char::is_alphanumeric) && !rest[stop..].starts_with(char::is_alphanumeric);
        shown.push_str(&rest[..start]);
        match word.parse::<f64>() {
            Ok(number) if alone && long(word) && number.is_finite() => {
                // Writing to a String cannot fail.
                let _ = write!(shown, "{number:e}");
            }
            _ => shown.push_str(word),
        }
        rest = if word.is_empty() {
            shown.push_str(&rest[start..end]);
            &rest[end..]
        } else {
            &rest[stop..]
        };
    }
    shown.push_str(rest);
    Cow::Owned(shown)
}

/// Returns a message in the form in which it is shown: on one line, nothing hidden, no very long numbers.
pub fn message(text: &str) -> String {
    short_numbers(&one_line(text)).into_owned()
}

/// Returns characters with their numbers in Unicode: "铝 (U+94DD), 百 (U+767E)"; only the first `MAX_NAMED` of them.
pub fn character_names(characters: &[char]) -> String {
    let name = |c: &char| format!("{c} (U+{:04X})", u32::from(*c));
    let names: Vec<String> = characters.iter().take(MAX_NAMED).map(name).collect();
    match characters.len() - names.len() {
        0 => names.join(", "),
        more => import::and_more(names.join(", "), more),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_named_by_their_numbers() {
        assert_eq!(character_names(&['铝', '\u{e9}']), "铝 (U+94DD), é (U+00E9)");
        assert!(character_names(&['窗'; 11]).ends_with("窗 (U+7A97) and 3 more"));
    }

    #[test]
    fn what_commands_a_terminal_is_seen() {
        assert_eq!(visible("Blind\u{1b}[31m\u{7}"), "Blind\\u001b[31m\\u0007");
        assert_eq!(visible("a\u{202e}b\u{9b}2J\u{7f}"), "a\\u202eb\\u009b2J\\u007f");
        for same in ["Raffstore 80 mm, τ = 0,3 – Büro", "a\tb\nc\r\n", "日よけ"] {
            assert!(matches!(visible(same), Cow::Borrowed(_)) || visible(same) == same);
        }
        assert_eq!(visible("over\rwritten"), "over\\u000dwritten");
        assert_eq!(one_line("a\n  fake line\r\nb"), "a fake line b");
        let json = serde_json::json!("C1 \u{9b} and \u{7f}").to_string();
        assert_eq!(serde_json::from_str::<String>(&visible(&json)).unwrap(), "C1 \u{9b} and \u{7f}");
    }

    #[test]
    fn long_numbers_are_short_and_hashes_whole() {
        assert_eq!(short_numbers(&format!("flux {} lm", 1e300)), "flux 1e300 lm");
        assert_eq!(short_numbers(&format!("-{:.1}, {}.", 1e30, 1.5e-40)), "-1e30, 1.5e-40.");
        let hash = format!("dataset {}a1, 0.30000000000000004...", "1".repeat(30));
        assert_eq!(short_numbers(&hash), hash);
        let text = format!("..{}..7", "9".repeat(25));
        assert!(short_numbers(&text).ends_with("..7"), "{}", short_numbers(&text));
    }
}
