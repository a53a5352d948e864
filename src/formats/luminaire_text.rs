//! Text of luminaire files: decoding of common encodings and line ends, parsing of numbers, conversion to ASCII for
//! writing.

use super::encoding::{Encoding, NotText, any_text, is_web_page, not_too_long};
use super::{FormatError, Location};
use crate::compute::btdf::Finding;
use crate::texts::{ascii_words, composed};

/// Length from which a text without any line break is assumed to have lost its line breaks. Chosen: no first line alone
/// is as long, and the headers alone are longer. \[characters\]
const LOST_BREAKS: usize = 200;

/// Decodes a luminaire file in UTF-8, Windows-1252 or UTF-16, with a finding on unusual encodings; the result has no
/// byte-order mark, and its lines end with a line feed.
///
/// # Errors
/// Returns an error if the text is too long, is a web page, or is one long line.
pub(super) fn decode(bytes: &[u8]) -> Result<(String, Vec<Finding>), FormatError> {
    let bytes = not_too_long(bytes)?;
    if is_web_page(bytes) {
        return Err(NotText::WEB_PAGE.into());
    }
    let (text, encoding) = any_text(bytes);
    let text = with_line_feeds(&text);
    let length = text.trim().chars().count();
    if length > LOST_BREAKS && !text.trim().contains('\n') {
        return Err(at_line(
            1,
            format!("{length} characters without a line break"),
            "several lines: line breaks were lost on the way",
        ));
    }
    let finding = (encoding == Some(Encoding::Utf16)).then(|| {
        let message =
            "The text is UTF-16, which other programs do not expect in a luminaire file; it was read as such.";
        Finding::warning("encoding", message)
    });
    Ok((text, finding.into_iter().collect()))
}

/// Returns the text with every line end (CR LF, or the lone CR of old Macs) replaced by a line feed.
fn with_line_feeds(text: &str) -> String {
    if !text.contains('\n') {
        return text.replace('\r', "\n");
    }
    let line = |line: &str| line.trim_matches('\r').replace('\r', "\n");
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

/// Parses a finite number, with an exponent after E or D (Fortran); `None` for other text.
pub(super) fn parse_number(text: &str) -> Option<f64> {
    let value = text.parse::<f64>().ok().or_else(|| {
        // Only digits stand around the D: "nand" is no number.
        let (mantissa, exponent) = text.split_once(['d', 'D'])?;
        format!("{}e{}", mantissa, exponent.parse::<i32>().ok()?).parse().ok()
    });
    value.filter(|value: &f64| value.is_finite())
}

/// Returns a text in printable ASCII, which every reader accepts: umlauts as two letters, other letters without
/// accents, line breaks as blanks.
pub(super) fn ascii(text: &str) -> String {
    let mut spelt = String::with_capacity(text.len());
    for letter in composed(text).chars() {
        match letter {
            'ä' => spelt.push_str("ae"),
            'ö' => spelt.push_str("oe"),
            'ü' => spelt.push_str("ue"),
            'Ä' => spelt.push_str("Ae"),
            'Ö' => spelt.push_str("Oe"),
            'Ü' => spelt.push_str("Ue"),
            '°' => spelt.push_str(" deg"),
            '×' => spelt.push('x'),
            letter if letter.is_control() => spelt.push(' '),
            letter => spelt.push(letter),
        }
    }
    ascii_words(&spelt)
}

/// Creates the error of a reader at a line, counted from 1.
pub(super) fn at_line(line: usize, found: impl Into<String>, expected: impl Into<String>) -> FormatError {
    FormatError::new(Location::line(line), found, expected)
}

/// Returns a number as text with up to `decimals` decimals, without trailing zeros or "-0".
pub(super) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_ends_of_all_systems_are_line_feeds() {
        for text in ["a\nb\n\nc", "a\r\nb\r\n\r\nc", "a\rb\r\rc", "a\r\r\nb\r\r\n\r\r\nc", "a\rb\n\nc"] {
            assert_eq!(decode(text.as_bytes()).unwrap().0, "a\nb\n\nc", "{text:?}");
        }
    }

    #[test]
    fn exponents_of_fortran_and_of_four_digits_are_read() {
        for text in ["1500", "1.5E+0003", "1.5D+03", "15d2", "1.5D3", "+1.5e3"] {
            assert_eq!(parse_number(text), Some(1500.0), "{text}");
        }
        for text in ["", "D", "1D", "D3", "nan", "inf", "1.5D999", "1D2D3", "road", "0x10"] {
            assert_eq!(parse_number(text), None, "{text}");
        }
    }

    #[test]
    fn pages_and_texts_without_line_breaks_are_named() {
        let page = "\u{feff}\n<!DOCTYPE html>\n<html lang=\"en\"><head><title>lamp.ies</title></head></html>";
        assert_eq!(decode(page.as_bytes()).unwrap_err().found, "an HTML page");
        let long = "1 ".repeat(400);
        assert_eq!(decode(long.as_bytes()).unwrap_err().found, "799 characters without a line break");
    }

    #[test]
    fn marks_of_decomposed_letters_are_spelt_like_those_of_composed_ones() {
        assert_eq!(ascii("Gro\u{308}ße, U\u{308}ber, Cafe\u{301} 5 m²"), "Groesse, Ueber, Cafe 5 m2");
        assert_eq!(ascii("Größe, Über, Café 5 m²"), "Groesse, Ueber, Cafe 5 m2");
        assert_eq!(ascii("Ø 80 mm – 45° ×2\n5 €"), "O 80 mm - 45 deg x2 5 EUR");
        assert_eq!(ascii("Жалюзи 铝百叶窗 Περσίδες"), "Zhalyuzi Lu Bai Ye Chuang Persides");
    }
}
