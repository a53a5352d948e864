//! Notation of texts as TOML strings.

use std::fmt::Write as _;

/// Returns a text as a TOML basic string on one line.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// Returns a text as a TOML string over several lines with its characters unchanged, if that can be read back;
/// otherwise on one line.
pub(super) fn lines(text: &str) -> String {
    let plain = !text.contains("'''")
        && !text.ends_with('\'')
        && text.chars().all(|c| c == '\n' || c == '\t' || !c.is_control())
        // Such a line would end the header.
        && text.lines().all(|line| line.trim_end() != "---");
    if plain { format!("'''\n{text}'''") } else { quoted(text) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_is_read_back() {
        for text in ["name = \"a\"\n", "a = '''x'''\n", "a\n---\nb", "\r\n\u{1}\"", "x'", "", "\nfirst"] {
            let toml: toml::Table = toml::from_str(&format!("system = {}\n", lines(text))).unwrap();
            assert_eq!(toml["system"].as_str(), Some(text), "{text:?}");
        }
    }
}
