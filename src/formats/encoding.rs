//! How a file's text is encoded: what is not UTF-8 is called by its name.

use crate::compute::limits;

/// How text is encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Two bytes a character.
    Utf16,
    /// One byte a character.
    Latin1,
    /// Not at all.
    Binary,
}

impl Encoding {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Utf16 => "UTF-16",
            Self::Latin1 => "Latin-1 (Windows-1252)",
            Self::Binary => "8-bit data",
        }
    }
}

/// Bytes that are no text in UTF-8.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the file is {} from byte {byte} on, not UTF-8; expected text saved as UTF-8", .encoding.name())]
pub struct NotText {
    /// The first byte that is wrong.
    pub byte: usize,
    /// Line of that byte, from 1.
    pub line: usize,
    /// What the bytes seem to be.
    pub encoding: Encoding,
}

/// A text of more bytes than its kind of file ever has: its lines and words alone would fill memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a text of {0} bytes; expected at most {most} MB", most = limits::TEXT_BYTES >> 20)]
pub struct TooLong(pub usize);

/// The text if it is not longer than such files are.
///
/// # Errors
/// Its length.
pub fn not_too_long<T: AsRef<[u8]> + ?Sized>(text: &T) -> Result<&T, TooLong> {
    match text.as_ref().len() {
        length if length > limits::TEXT_BYTES => Err(TooLong(length)),
        _ => Ok(text),
    }
}

/// So much of a file is looked at for its encoding. \[bytes\]
const LOOK: usize = 4096;

/// Text in UTF-8, without a byte-order mark.
///
/// # Errors
/// What the bytes seem to be instead.
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

/// Text in UTF-8 or UTF-16, else one byte a character; which of them.
pub fn any_text(bytes: &[u8]) -> (String, Option<Encoding>) {
    match utf8(bytes) {
        Ok(text) => (text.to_owned(), None),
        Err(NotText { encoding: Encoding::Utf16, .. }) => (from_utf16(bytes), Some(Encoding::Utf16)),
        Err(NotText { encoding, .. }) => (bytes.iter().map(|&byte| char::from(byte)).collect(), Some(encoding)),
    }
}

/// Does text begin with the mark of UTF-16, or is every second byte of Latin text zero?
fn is_utf16(bytes: &[u8]) -> bool {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return true;
    }
    let zeros = zeros(bytes);
    let pairs = bytes.len().min(LOOK) / 2;
    // Not every character is Latin, and no zero stands on the other side.
    pairs >= 4 && zeros.iter().any(|count| 10 * count > 7 * pairs) && zeros.contains(&0)
}

/// Zeros at even and at odd places.
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
        assert_eq!(utf8(b"\x00\xff\x01\x80").unwrap_err().encoding, Encoding::Binary);
        assert_eq!(utf8("\u{feff}ä".as_bytes()), Ok("ä"));
        assert_eq!(utf8(b""), Ok(""));
    }
}
