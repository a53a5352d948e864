//! Damage to files that were valid: of one sort for texts, of another for bytes.

use super::choices::Choices;

/// How many edits: half of the files stay as they are or are changed once.
fn count(choices: &mut Choices) -> usize {
    [0, 0, 0, 1, 1, 1, 2, 4][choices.below(8)]
}

/// The text, changed in some places.
pub fn text(choices: &mut Choices, text: String) -> Vec<u8> {
    let mut bytes = text.into_bytes();
    for _ in 0..count(choices) {
        if bytes.is_empty() {
            break;
        }
        match choices.below(16) {
            // Most of these leave a file that is read: a number becomes another one of its kind.
            0..=6 => near_number(choices, &mut bytes),
            7 | 8 => odd_number(choices, &mut bytes),
            9 => {
                let (from, to) = line(choices, &bytes);
                bytes.drain(from..to);
            }
            10 => {
                let (from, to) = line(choices, &bytes);
                let copy = bytes[from..to].repeat(1 + choices.below(3));
                bytes.splice(from..from, copy);
            }
            11 => {
                let (a, b) = (line(choices, &bytes), line(choices, &bytes));
                let (a, b) = (a.min(b), a.max(b));
                if a.1 <= b.0 {
                    let swapped = [&bytes[b.0..b.1], &bytes[a.1..b.0], &bytes[a.0..a.1]].concat();
                    bytes.splice(a.0..b.1, swapped);
                }
            }
            12 => {
                let at = choices.below(bytes.len());
                bytes.truncate(at);
            }
            13 => {
                const PIECES: [&str; 14] = [
                    "é",
                    "\u{feff}",
                    "\0",
                    "\"",
                    "{",
                    "}",
                    "[[",
                    "<",
                    ">",
                    ",",
                    "\n",
                    "=",
                    "\u{2028}",
                    "日本語日本語日本語",
                ];
                let at = choices.below(bytes.len());
                bytes.splice(at..at, choices.pick(&PIECES).bytes());
            }
            14 => {
                let at = choices.below(bytes.len());
                bytes[at] = choices.byte();
            }
            _ => {
                let (at, length) = (choices.below(bytes.len()), 1 + choices.below(40));
                let piece = bytes[at..(at + length).min(bytes.len())].repeat(1 + choices.below(50));
                bytes.splice(at..at, piece);
            }
        }
    }
    bytes
}

/// The bytes, changed in some places.
pub fn bytes(choices: &mut Choices, mut bytes: Vec<u8>) -> Vec<u8> {
    for _ in 0..count(choices) {
        if bytes.is_empty() {
            break;
        }
        let at = choices.below(bytes.len());
        match choices.below(8) {
            0 | 1 => bytes[at] ^= 1 << choices.below(8),
            2 => bytes[at] = choices.byte(),
            3 => {
                const COUNTS: [u32; 10] = [0, 1, 2, 7, 255, 8193, 1 << 18, 1 << 24, 1 << 31, u32::MAX];
                let count = COUNTS[choices.below(COUNTS.len())].to_le_bytes();
                let end = (at + 4).min(bytes.len());
                bytes.splice(at..end, count);
            }
            4 => {
                let number: f64 = choices.odd_number().parse().unwrap_or(f64::NAN);
                let end = (at + 8).min(bytes.len());
                bytes.splice(at..end, number.to_le_bytes());
            }
            5 => bytes.truncate(at),
            6 => {
                let end = (at + 1 + choices.below(40)).min(bytes.len());
                let copy = bytes[at..end].to_vec();
                bytes.splice(at..at, copy);
            }
            _ => {
                let end = (at + 1 + choices.below(40)).min(bytes.len());
                bytes.drain(at..end);
            }
        }
    }
    bytes
}

/// A line, from where it begins to behind its end.
fn line(choices: &mut Choices, bytes: &[u8]) -> (usize, usize) {
    let at = choices.below(bytes.len());
    let from = bytes[..at].iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let to = bytes[at..].iter().position(|byte| *byte == b'\n').map_or(bytes.len(), |end| at + end + 1);
    (from, to)
}

/// Where a number stands, searched from a place on.
fn number(choices: &mut Choices, bytes: &[u8]) -> Option<(usize, usize)> {
    let start = choices.below(bytes.len());
    let digit = |byte: &u8| byte.is_ascii_digit();
    let from = start + bytes[start..].iter().position(digit)?;
    let length = bytes[from..].iter().position(|byte| !(digit(byte) || b".eE".contains(byte)));
    Some((from, length.map_or(bytes.len(), |length| from + length)))
}

fn odd_number(choices: &mut Choices, bytes: &mut Vec<u8>) {
    if let Some((from, to)) = number(choices, bytes) {
        bytes.splice(from..to, choices.odd_number().bytes());
    }
}

/// A digit becomes another one.
fn near_number(choices: &mut Choices, bytes: &mut [u8]) {
    if let Some((from, to)) = number(choices, bytes) {
        let at = from + choices.below(to - from);
        if bytes[at].is_ascii_digit() {
            bytes[at] = b'0' + choices.below(10) as u8;
        }
    }
}
