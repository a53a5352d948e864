//! Parts of file names from arbitrary text, in characters that every operating system accepts.

use crate::texts::ascii_letters;

/// Maximum length of a part of a file name made from text. \[characters\]
const LONGEST: usize = 80;

/// Returns text as part of a file name, with ASCII letters, digits, points and hyphens only; a run of other characters
/// becomes one hyphen.
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
