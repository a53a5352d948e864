//! Coding order of the quantised wavelet coefficients (levels) of an indicatrix, and the contexts from which the next
//! bit is predicted.
//!
//! Groups of cells are visited from coarse to fine. A group begins with a bit: whether anything in it differs from
//! zero; if not, nothing below it is coded. Probabilities depend on the parent group (large coefficients have large
//! ones below them), on the number of the wavelet in its group, and on how many before it were not zero.

use super::range_coder::{Chance, Decoder, Encoder};
use crate::compute::wavelet::Transform;

/// Sequence of bits: a writer, a reader, or a counter of frequencies.
pub trait Bits {
    /// Codes a bit in a context, and returns it. A writer writes `bit`; a reader ignores `bit` and returns the bit that
    /// was read.
    fn bit(&mut self, context: usize, bit: bool) -> bool;
    /// Codes a bit that is equally often 0 and 1, without context, and returns it.
    fn even(&mut self, bit: bool) -> bool;
}

const ACTIVITIES: usize = 4;
const LEVELS: usize = 16;
const WAVELETS: usize = 8;
/// Number of binary digits of a coefficient's magnitude that have separate contexts.
const DIGITS: usize = 12;
/// Maximum number of binary digits of a coefficient's magnitude.
const MOST_DIGITS: usize = 25;
const GROUP: usize = 0;
const ZERO: usize = GROUP + LEVELS * ACTIVITIES * 3;
const MORE: usize = ZERO + 2 * WAVELETS * ACTIVITIES * 3;
const SECOND: usize = MORE + DIGITS * ACTIVITIES * LEVELS;
const ROOT: usize = SECOND + DIGITS;
/// Number of contexts from which bits are predicted.
pub const CONTEXTS: usize = ROOT + 9;

/// Writes or reads all quantised coefficients of one indicatrix: `levels` contains them for writing, or zeros that are
/// replaced in reading. Returns `false` for a magnitude that is too large to be valid.
pub fn visit(transform: &Transform, levels: &mut [i32], bits: &mut impl Bits) -> bool {
    let blocks = transform.blocks();
    let count = blocks.len();
    // Writers know what lies below; readers learn it.
    let mut some = vec![false; count];
    for (index, block) in blocks.iter().enumerate().rev() {
        let from = block.wavelets as usize;
        if levels[from..from + block.wavelet_count()].iter().any(|level| *level != 0) {
            some[index] = true;
        }
        if some[index] {
            some[block.parent as usize] = true;
        }
    }
    let mut activity = vec![0_u8; count];
    let mut sound = true;
    for (k, level) in levels.iter_mut().enumerate().take(transform.root_count()).skip(1) {
        let nonzero = bits.bit(ROOT + k.min(8), *level != 0);
        *level = if nonzero { magnitude(*level, 3, bits, &mut sound) } else { 0 };
    }
    for index in 0..count {
        let block = &blocks[index];
        let parent = block.parent as usize;
        if index > 0 && !some[parent] {
            some[index] = false;
            continue;
        }
        let around = if index == 0 { 3 } else { activity[parent] as usize };
        let sibling = match index {
            0 => 0,
            _ if blocks[parent].first_child as usize == index => 0,
            _ => 1 + usize::from(some[index - 1]),
        };
        let level = (block.level as usize).min(LEVELS - 1);
        some[index] = bits.bit(GROUP + (level * ACTIVITIES + around) * 3 + sibling, some[index]);
        if !some[index] {
            continue;
        }
        let from = block.wavelets as usize;
        let (mut before, mut largest) = (0_usize, 0);
        let leaf = usize::from(block.children == 0);
        for k in 0..block.wavelet_count() {
            let context = ((leaf * WAVELETS + k.min(WAVELETS - 1)) * ACTIVITIES + around) * 3 + before.min(2);
            let place = &mut levels[from + k];
            if bits.bit(ZERO + context, *place != 0) {
                *place = magnitude(*place, level * ACTIVITIES + around, bits, &mut sound);
                before += 1;
                largest = place.unsigned_abs().max(largest);
            } else {
                *place = 0;
            }
        }
        activity[index] = match largest {
            0 => 0,
            1 => 1,
            2 | 3 => 2,
            _ => 3,
        };
    }
    sound
}

/// Codes a coefficient: its sign, the number of its binary digits in unary, then the digits after the first, of which
/// the second has a context.
fn magnitude(value: i32, place: usize, bits: &mut impl Bits, sound: &mut bool) -> i32 {
    let negative = bits.even(value < 0);
    let absolute = value.unsigned_abs().max(1);
    let digits = absolute.ilog2() as usize;
    let mut found = 0;
    while bits.bit(MORE + found.min(DIGITS - 1) * ACTIVITIES * LEVELS + place, digits > found) {
        found += 1;
        if found > MOST_DIGITS {
            *sound = false;
            return 0;
        }
    }
    let mut magnitude = 1_u32;
    for k in (0..found).rev() {
        let digit = absolute >> k & 1 == 1;
        let digit = if k + 1 == found { bits.bit(SECOND + found.min(DIGITS - 1), digit) } else { bits.even(digit) };
        magnitude = magnitude << 1 | u32::from(digit);
    }
    if negative { -(magnitude as i32) } else { magnitude as i32 }
}

/// Counts of the bits 0 and 1 in each context.
#[derive(Debug)]
pub struct Counter(pub Vec<[u64; 2]>);

impl Default for Counter {
    fn default() -> Self {
        Self(vec![[0; 2]; CONTEXTS])
    }
}

impl Bits for Counter {
    fn bit(&mut self, context: usize, bit: bool) -> bool {
        self.0[context][usize::from(bit)] += 1;
        bit
    }

    fn even(&mut self, bit: bool) -> bool {
        bit
    }
}

/// Writer of bits by an arithmetic coder, with initial probabilities from a table.
#[derive(Debug)]
pub struct Writer {
    coder: Encoder,
    chances: Vec<Chance>,
}

impl Writer {
    /// Creates a writer; `table` contains the initial probability of each context as a byte, see [`Chance::from_byte`].
    pub fn new(table: &[u8]) -> Self {
        Self { coder: Encoder::default(), chances: table.iter().map(|byte| Chance::from_byte(*byte)).collect() }
    }

    /// Returns the bytes of all bits written.
    pub fn finish(self) -> Vec<u8> {
        self.coder.finish()
    }
}

impl Bits for Writer {
    fn bit(&mut self, context: usize, bit: bool) -> bool {
        self.coder.bit(&mut self.chances[context], bit);
        bit
    }

    fn even(&mut self, bit: bool) -> bool {
        self.coder.even_bit(bit);
        bit
    }
}

/// Reader of the bits that [`Writer`] wrote.
#[derive(Debug)]
pub struct Reader<'a> {
    coder: Decoder<'a>,
    chances: Vec<Chance>,
}

impl<'a> Reader<'a> {
    /// Creates a reader; `table` contains one byte per context and must be the table of the writer.
    pub fn new(table: &[u8], bytes: &'a [u8]) -> Self {
        Self { coder: Decoder::new(bytes), chances: table.iter().map(|byte| Chance::from_byte(*byte)).collect() }
    }
}

impl Bits for Reader<'_> {
    fn bit(&mut self, context: usize, _: bool) -> bool {
        self.coder.bit(&mut self.chances[context])
    }

    fn even(&mut self, _: bool) -> bool {
        self.coder.even_bit()
    }
}
