//! Encodings of text files: UTF-8, UTF-16 and Windows-1252 with Latin-1 are read, with any line ends. Anything else,
//! and a web page saved instead of a file, is refused with the name of the encoding.

use crate::compute::btdf::Finding;
use crate::compute::limits;
use std::borrow::Cow;
use std::fmt;

/// Encoding of bytes that are not UTF-8.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// UTF-16, two bytes per character.
    Utf16,
    /// Text with one byte per character, read as Windows-1252.
    Latin1,
    /// Bytes that are not text in any known encoding.
    Binary,
    /// HTML page in any encoding.
    WebPage,
}

impl Encoding {
    /// Returns the name of the encoding for messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Utf16 => "UTF-16",
            Self::Latin1 => "Latin-1 (Windows-1252)",
            Self::Binary => "8-bit data",
            Self::WebPage => "an HTML page",
        }
    }
}

/// Error for bytes that are not text in the expected encoding: position and actual encoding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub struct NotText {
    /// Offset of the first byte that is not valid, from 0.
    pub byte: usize,
    /// Line of the first byte that is not valid, from 1.
    pub line: usize,
    /// Encoding that the bytes seem to have.
    pub encoding: Encoding,
}

impl NotText {
    /// Error for a web page that was saved instead of the file that it shows.
    pub(super) const WEB_PAGE: Self = Self { byte: 0, line: 1, encoding: Encoding::WebPage };
}

impl fmt::Display for NotText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, byte) = (self.encoding.name(), self.byte);
        match self.encoding {
            Encoding::WebPage => write!(f, "the file is {name}; expected {RAW_FILE}"),
            _ => write!(f, "the file is {name} from byte {byte} on, not UTF-8; expected text saved as UTF-8"),
        }
    }
}

/// Text for messages about a web page: the expected file, and how to get it.
pub(super) const RAW_FILE: &str = "the file that the page shows: download the raw file";

/// Error for a text file that is too large to be processed: its size. \[bytes\]
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a text of {0} bytes; expected at most {most} MB", most = limits::TEXT_BYTES >> 20)]
pub struct TooLong(pub usize);

/// Returns the text if it is not longer than the maximum for text files.
///
/// # Errors
/// Returns an error with the length of the text if it is longer.
pub fn not_too_long<T: AsRef<[u8]> + ?Sized>(text: &T) -> Result<&T, TooLong> {
    match text.as_ref().len() {
        length if length > limits::TEXT_BYTES => Err(TooLong(length)),
        _ => Ok(text),
    }
}

/// Number of bytes at the beginning of a file that are examined for its encoding.
const LOOK: usize = 4096;

/// Characters of the bytes 0x80 to 0x9F in Windows-1252, for which Latin-1 has control characters that no text holds.
/// Source: <https://encoding.spec.whatwg.org/index-windows-1252.txt>, according to which "Latin-1" means Windows-1252,
/// too.
const WINDOWS_1252: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}', //
    '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// Returns the character that a byte means in Windows-1252.
fn of_byte(byte: u8) -> char {
    match byte {
        0x80..=0x9f => WINDOWS_1252[usize::from(byte - 0x80)],
        _ => char::from(byte),
    }
}

/// Returns the bytes as UTF-8 text, without a byte-order mark.
///
/// # Errors
/// Returns an error with the encoding that the bytes seem to have instead.
pub fn utf8(bytes: &[u8]) -> Result<&str, NotText> {
    let wrong = |byte: usize, encoding| {
        let line = bytes[..byte].iter().filter(|b| **b == b'\n').count() + 1;
        NotText { byte, line, encoding }
    };
    // In UTF-16 every byte of Latin text may be valid UTF-8.
    if is_utf16(bytes) {
        return Err(wrong(0, Encoding::Utf16));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text.strip_prefix('\u{feff}').unwrap_or(text)),
        Err(error) => {
            let control = |byte: &u8| *byte < 0x20 && !matches!(byte, b'\t' | b'\n' | b'\r' | 0x0c | 0x1a | 0x1b);
            let binary = bytes[..bytes.len().min(LOOK)].iter().any(control);
            Err(wrong(error.valid_up_to(), if binary { Encoding::Binary } else { Encoding::Latin1 }))
        }
    }
}

/// Decodes text in UTF-8, UTF-16 or Windows-1252; the result has no byte-order mark, and its lines end with `
/// ` alone.
///
/// # Errors
/// Returns an error if the bytes are a web page or no text at all.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, NotText> {
    if is_web_page(bytes) {
        return Err(NotText::WEB_PAGE);
    }
    let text = match utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(error) if error.encoding == Encoding::Binary => return Err(error),
        Err(_) => Cow::Owned(any_text(bytes).0),
    };
    Ok(if text.contains('\r') { Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")) } else { text })
}

/// Returns a finding about a dataset file that should be UTF-8 but was read as Latin-1 (Windows-1252); `None` for
/// UTF-8.
pub(super) fn repaired(bytes: &[u8]) -> Option<Finding> {
    let NotText { byte, encoding, .. } = utf8(bytes).err()?;
    (encoding != Encoding::Utf16).then(|| {
        let name = Encoding::Latin1.name();
        let message = format!("The file is not valid UTF-8 from byte {byte}; it was read as {name}.");
        Finding::warning("encoding-repaired", message)
    })
}

/// Whether bytes are an HTML page, which browsers may save instead of the file that the page shows.
pub fn is_web_page(bytes: &[u8]) -> bool {
    // Where the head ends within a character it is taken for Latin-1, and its mark for letters.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let (head, _) = any_text(&bytes[..bytes.len().min(LOOK)]);
    let mut rest = head.trim_start();
    // An XML declaration and comments may stand before the first tag.
    while let Some(end) = [("<?", "?>"), ("<!--", "-->")].iter().find(|(begin, _)| rest.starts_with(begin)) {
        rest = rest.split_once(end.1).map_or("", |(_, rest)| rest.trim_start());
    }
    let Some(tag) = rest.strip_prefix('<') else { return false };
    let mut words = tag.split(|c: char| c.is_whitespace() || c == '>').map(str::to_ascii_lowercase);
    match words.next().as_deref() {
        Some("html" | "head" | "body") => true,
        Some("!doctype") => words.next().is_some_and(|root| root == "html"),
        _ => false,
    }
}

/// Decodes any bytes as text: as UTF-8 or UTF-16 if they are such, else with one byte per character. Returns the text
/// and its encoding, `None` for UTF-8.
pub fn any_text(bytes: &[u8]) -> (String, Option<Encoding>) {
    match utf8(bytes) {
        Ok(text) => (text.to_owned(), None),
        Err(NotText { encoding: Encoding::Utf16, .. }) => (from_utf16(bytes), Some(Encoding::Utf16)),
        Err(NotText { encoding, .. }) => (bytes.iter().map(|&byte| of_byte(byte)).collect(), Some(encoding)),
    }
}

/// Whether bytes are UTF-16: they begin with its byte-order mark, or every second byte is zero, as in Latin text.
fn is_utf16(bytes: &[u8]) -> bool {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return true;
    }
    let zeros = zeros(bytes);
    let pairs = bytes.len().min(LOOK) / 2;
    // Not every character is Latin, and no zero stands on the other side.
    pairs >= 4 && zeros.iter().any(|count| 10 * count > 7 * pairs) && zeros.contains(&0)
}

/// Returns the numbers of zero bytes at even and at odd offsets.
fn zeros(bytes: &[u8]) -> [usize; 2] {
    let head = &bytes[..bytes.len().min(LOOK) / 2 * 2];
    [0, 1].map(|side| head.iter().skip(side).step_by(2).filter(|byte| **byte == 0).count())
}

fn from_utf16(bytes: &[u8]) -> String {
    let [even, odd] = zeros(bytes);
    let big = bytes.starts_with(&[0xfe, 0xff]) || (!bytes.starts_with(&[0xff, 0xfe]) && even > odd);
    let one =
        |pair: &[u8]| if big { u16::from_be_bytes([pair[0], pair[1]]) } else { u16::from_le_bytes([pair[0], pair[1]]) };
    let units = bytes.chunks_exact(2).map(one);
    let text: String = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
    text.strip_prefix('\u{feff}').map_or_else(|| text.clone(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn utf16(text: &str, big: bool, mark: bool) -> Vec<u8> {
        let marked = if mark { format!("\u{feff}{text}") } else { text.to_owned() };
        let bytes = |unit: u16| if big { unit.to_be_bytes() } else { unit.to_le_bytes() };
        marked.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn encodings_have_names_and_are_read() {
        let text = "Müller Leuchten\r\n4\r\n0.5\r\n";
        for (big, mark) in [(false, true), (true, true), (false, false), (true, false)] {
            let bytes = utf16(text, big, mark);
            assert_eq!(utf8(&bytes).unwrap_err().encoding, Encoding::Utf16, "{big} {mark}");
            assert_eq!(any_text(&bytes), (text.to_owned(), Some(Encoding::Utf16)));
        }
        let latin = b"line\nM\xfcller\n";
        assert_eq!(utf8(latin), Err(NotText { byte: 6, line: 2, encoding: Encoding::Latin1 }));
        assert_eq!(any_text(latin).0, "line\nMüller\n");
        let windows = b"\x84M\xfcller\x93 \x96 5 \x80, Lamp\x92s \x85\x99 \x81";
        assert_eq!(decode(windows).unwrap(), "„Müller“ – 5 €, Lamp’s …™ \u{81}");
        assert_eq!(utf8(b"\x00\xff\x01\x80").unwrap_err().encoding, Encoding::Binary);
        assert_eq!(utf8("\u{feff}ä".as_bytes()), Ok("ä"));
        assert_eq!(utf8(b""), Ok(""));
    }

    #[test]
    fn text_is_the_same_however_it_travelled() {
        let text = "Müller\n0.5 1e-0003\n";
        let latin: Vec<u8> = text.chars().map(|c| u32::from(c) as u8).collect();
        let files = [
            text.replace('\n', "\r").into_bytes(),
            text.replace('\n', "\r\n").into_bytes(),
            format!("\u{feff}{text}").into_bytes(),
            utf16(text, true, true),
            utf16(&text.replace('\n', "\r"), false, false),
            latin,
        ];
        for file in files {
            assert_eq!(decode(&file).unwrap(), text, "{file:?}");
        }
        assert!(matches!(decode(text.as_bytes()), Ok(Cow::Borrowed(_))), "nothing is copied without need");
        assert_eq!(decode(b"\x00\xff\x01\x80").unwrap_err().encoding, Encoding::Binary);
        assert_eq!("1e-0003".parse(), Ok(0.001), "exponents of four digits");
    }

    #[test]
    fn a_web_page_is_known_by_its_first_tag() {
        let pages = [
            "<!DOCTYPE html>\n<html lang=\"en\">",
            "\n\n<!doctype HTML PUBLIC \"-//W3C//DTD XHTML 1.0 Strict//EN\">",
            "<?xml version=\"1.0\"?>\n<!-- saved -->\n<html xmlns=\"http://www.w3.org/1999/xhtml\">",
            "<HTML><body>",
        ];
        for page in pages {
            assert!(is_web_page(page.as_bytes()) && is_web_page(&utf16(page, false, true)), "{page}");
            let told = decode(page.as_bytes()).unwrap_err().to_string();
            assert!(told.contains("HTML page") && told.contains("download the raw file"), "{told}");
        }
        for file in ["<?xml version=\"1.0\"?>\n<WindowElement>", "<!DOCTYPE a [", "<header>", "<!-- html", "html", ""] {
            assert!(!is_web_page(file.as_bytes()), "{file}");
        }
    }
}
