//! Words as parts of file names, in characters that every system accepts.

use crate::texts::ascii_letters;

/// Maximum length of a part of a name made from words. \[characters\]
const LONGEST: usize = 80;

/// Returns a word in ASCII letters, digits, point and hyphen; runs of other characters become one hyphen.
pub fn safe(word: &str) -> String {
    let mut text = String::new();
    for c in ascii_letters(word).chars() {
        if c.is_ascii_alphanumeric() || c == '.' || (c == '-' && text.is_empty()) {
            text.push(c);
        } else if !text.ends_with('-') && !text.is_empty() {
            text.push('-');
        }
    }
    text.truncate(LONGEST);
    text.trim_end_matches(['-', '.']).trim_start_matches('.').to_owned()
}
