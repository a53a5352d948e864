//! Errors in TOML files, located by line, column and name of the key.

use super::location::short;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Error in a TOML text with its position: line, column and key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TomlPlace {
    /// Line number, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Full name of the key, e.g. `aperture[1].size`; empty where the text is not valid TOML.
    pub key: String,
    /// Description of the problem, and of what was expected.
    pub message: String,
}

/// Returns the error of a TOML parser with its position and key. `first`: number of the first item of a list in
/// messages, 0 or 1; `unit` returns the unit of the number under a key, if it has one.
pub fn place(
    text: &str,
    error: &toml::de::Error,
    first: usize,
    unit: impl Fn(&str) -> Option<&'static str>,
) -> TomlPlace {
    let at = error.span().map_or(0, |span| span.start.min(text.len()));
    let before = text.get(..at).unwrap_or_default();
    let mut key = String::new();
    if let (Some(span), Ok(root)) = (error.span(), DeTable::parse(text)) {
        within(root.get_ref(), &span, first, &mut key);
    }
    // What is not known has no place of its own: it is named where it was expected.
    if error.message().starts_with("unknown field") {
        key.truncate(key.rfind('.').unwrap_or(0));
    }
    TomlPlace {
        line: before.matches('\n').count() + 1,
        column: before.chars().rev().take_while(|c| *c != '\n').count() + 1,
        message: short(reworded(error.message(), unit(&plain(&key)))),
        key: short(key),
    }
}

/// Returns a key without list indices, e.g. `aperture.size` from `aperture[1].size`.
fn plain(key: &str) -> String {
    let mut depth = 0_usize;
    let mut name = String::new();
    for c in key.chars() {
        match c {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            c if depth == 0 => name.push(c),
            _ => {}
        }
    }
    name
}

/// Returns the parser's message in words for users of the file.
fn reworded(message: &str, unit: Option<&str>) -> String {
    let number = unit.map_or_else(|| "a number".to_owned(), |unit| format!("a number in {unit}"));
    let mut text = message.replace('\n', "; ");
    for (word, meant) in [
        ("expected f64", format!("expected {number}")),
        ("expected usize", "expected a whole number".to_owned()),
        ("expected u32", "expected a whole number".to_owned()),
        ("expected u64", "expected a whole number".to_owned()),
        ("expected i64", "expected a whole number".to_owned()),
        ("expected a string", "expected text in quotes".to_owned()),
        ("expected a boolean", "expected true or false".to_owned()),
        ("expected a sequence", "expected a list in brackets".to_owned()),
    ] {
        text = text.replace(word, &meant);
    }
    if let Some(at) = text.find("data did not match any variant of untagged enum") {
        text.replace_range(at.., "a value of none of the forms that this key takes");
    }
    match (text.starts_with("invalid length"), unit) {
        (true, Some(unit)) => format!("{text}, in {unit}"),
        _ => text,
    }
}

/// Finds the innermost value of a table that contains a span of the text, and extends `key` by its path.
fn within(table: &DeTable<'_>, span: &std::ops::Range<usize>, first: usize, key: &mut String) {
    for (name, value) in table {
        if value.span().start <= span.start && span.end <= value.span().end || name.span() == *span {
            if !key.is_empty() {
                key.push('.');
            }
            key.push_str(name.get_ref());
            return inside(value, span, first, key);
        }
    }
    // A table that is written in several places: its span is that of its name.
    for (name, value) in table {
        let mut deeper = key.clone();
        if !deeper.is_empty() {
            deeper.push('.');
        }
        deeper.push_str(name.get_ref());
        let length = deeper.len();
        inside(value, span, first, &mut deeper);
        if deeper.len() > length {
            *key = deeper;
            return;
        }
    }
}

fn inside(value: &Spanned<DeValue<'_>>, span: &std::ops::Range<usize>, first: usize, key: &mut String) {
    match value.get_ref() {
        DeValue::Table(table) => within(table, span, first, key),
        DeValue::Array(list) => {
            for (place, one) in list.iter().enumerate() {
                let mut deeper = format!("{key}[{}]", place + first);
                let length = deeper.len();
                let holds = one.span().start <= span.start && span.end <= one.span().end;
                inside(one, span, first, &mut deeper);
                if holds || deeper.len() > length {
                    *key = deeper;
                    return;
                }
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "read by serde")]
    struct File {
        room: Room,
        #[serde(default)]
        aperture: Vec<Aperture>,
    }

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "read by serde")]
    struct Room {
        width: f64,
    }

    #[derive(Debug, serde::Deserialize)]
    #[allow(dead_code, reason = "read by serde")]
    struct Aperture {
        size: [f64; 2],
    }

    fn wrong(text: &str) -> (usize, String, String) {
        let error = toml::from_str::<File>(text).unwrap_err();
        let place = place(text, &error, 1, |key| (key == "room.width" || key == "aperture.size").then_some("m"));
        (place.line, place.key, place.message)
    }

    #[test]
    fn keys_and_units_are_named() {
        let (line, key, message) = wrong("[room]\nwidth = \"4 m\"\n");
        assert_eq!((line, &*key), (2, "room.width"));
        assert!(message.contains("string \"4 m\"") && message.ends_with("expected a number in m"), "{message}");
        let (line, key, message) =
            wrong("[room]\nwidth = 4\n[[aperture]]\nsize = [1, 2]\n[[aperture]]\nsize = [1, true]\n");
        assert_eq!((line, &*key), (6, "aperture[2].size[2]"));
        assert!(message.contains("in m"), "{message}");
        let (_, key, _) = wrong("[room]\nwidth = 4\nwidht = 3\n");
        assert_eq!(key, "room");
        assert_eq!(wrong("[room\n").1, "");
    }
}
