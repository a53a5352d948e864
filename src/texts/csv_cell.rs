//! Text in tables that spreadsheets open.

use std::borrow::Cow;

/// Returns a text that no spreadsheet takes for a formula: with an apostrophe before what begins like one and is not a number.
/// (OWASP, "CSV injection": =, +, −, @, tab, carriage return.)
pub fn inert_cell(text: &str) -> Cow<'_, str> {
    let begins_like_one = text.len() > 1 && text.starts_with(['=', '+', '-', '@', '\t', '\r']);
    if begins_like_one && text.parse::<f64>().is_err() { Cow::Owned(format!("'{text}")) } else { Cow::Borrowed(text) }
}

/// Returns a text as a field of a CSV table: see [`inert_cell`], in quotation marks where it needs them.
pub fn csv_cell(text: &str) -> String {
    let text = inert_cell(text);
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_begins_like_a_formula_starts_none() {
        for (text, cell) in [
            ("=HYPERLINK(\"http://x\",\"y\")", "\"'=HYPERLINK(\"\"http://x\"\",\"\"y\"\")\""),
            ("+49 711 1", "'+49 711 1"),
            ("-A1", "'-A1"),
            ("@sum", "'@sum"),
            ("\tx", "'\tx"),
            ("\r=x", "\"'\r=x\""),
            ("-12.5", "-12.5"),
            ("+1e3", "+1e3"),
            ("-", "-"),
            ("", ""),
            ("slats, 45°", "\"slats, 45°\""),
            ("a = b", "a = b"),
        ] {
            assert_eq!(csv_cell(text), cell);
        }
    }
}
