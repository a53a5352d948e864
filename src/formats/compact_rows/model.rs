//! In which order the levels of an indicatrix are told, and what is taken as known when the next bit is guessed.
//!
//! Groups of cells are visited from coarse to fine. A group says first whether anything in it differs from zero; if
//! not, nothing below it is told. Chances depend on what the group around showed (large coefficients have large ones
//! below them), on the number of the wavelet in its group, and on how many before it were not zero.

use super::range_coder::{Chance, Decoder, Encoder};
use crate::compute::wavelet::Transform;

/// Takes bits one after the other: a writer, a reader, or a counter of frequencies.
pub trait Bits {
    /// A bit in a context; a writer writes `bit`, a reader does not look at it. What was written or read is returned.
    fn bit(&mut self, context: usize, bit: bool) -> bool;
    /// A bit without context.
    fn even(&mut self, bit: bool) -> bool;
}

const ACTIVITIES: usize = 4;
const LEVELS: usize = 16;
const WAVELETS: usize = 8;
const UNARY: usize = 12;
const GROUP: usize = 0;
const ZERO: usize = GROUP + LEVELS * ACTIVITIES * 3;
const MORE: usize = ZERO + 2 * WAVELETS * ACTIVITIES * 3;
const ROOT: usize = MORE + UNARY * ACTIVITIES;
/// Number of contexts.
pub const CONTEXTS: usize = ROOT + 9;
/// Most bits of a magnitude beyond the unary part.
const ESCAPE: u32 = 24;

/// Tells or asks all levels of one indicatrix. `levels` holds them, or zeros that are filled in.
/// `false`: a magnitude that no writer writes.
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
    for k in 1..transform.root_count() {
        let nonzero = bits.bit(ROOT + k.min(8), levels[k] != 0);
        levels[k] = if nonzero { magnitude(levels[k], 3, bits, &mut sound) } else { 0 };
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
                *place = magnitude(*place, around, bits, &mut sound);
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

/// Sign, then magnitude − 1: unary as far as contexts go, then with the number of its bits.
fn magnitude(level: i32, around: usize, bits: &mut impl Bits, sound: &mut bool) -> i32 {
    let negative = bits.even(level < 0);
    let told = level.unsigned_abs().saturating_sub(1);
    let mut found = 0_u32;
    while (found as usize) < UNARY && bits.bit(MORE + found as usize * ACTIVITIES + around, told > found) {
        found += 1;
    }
    if found as usize == UNARY {
        // Elias gamma of what is beyond.
        let beyond = told.saturating_sub(UNARY as u32) + 1;
        let length = 31 - beyond.leading_zeros().min(31);
        let mut asked = 0;
        while asked <= ESCAPE && bits.even(asked < length) {
            asked += 1;
        }
        if asked > ESCAPE {
            *sound = false;
            return 0;
        }
        let mut value = 1_u32;
        for k in (0..asked).rev() {
            value = value << 1 | u32::from(bits.even(beyond >> k & 1 == 1));
        }
        found += value - 1;
    }
    let magnitude = (found + 1) as i32;
    if negative { -magnitude } else { magnitude }
}

/// Counts how often which bit comes in which context.
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

/// Writes with chances that begin as a table says.
#[derive(Debug)]
pub struct Writer {
    coder: Encoder,
    chances: Vec<Chance>,
}

impl Writer {
    /// With one byte a context.
    pub fn new(table: &[u8]) -> Self {
        Self { coder: Encoder::default(), chances: table.iter().map(|byte| Chance::from_byte(*byte)).collect() }
    }

    /// The bytes.
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

/// Reads what [`Writer`] wrote.
#[derive(Debug)]
pub struct Reader<'a> {
    coder: Decoder<'a>,
    chances: Vec<Chance>,
}

impl<'a> Reader<'a> {
    /// With one byte a context, the same as the writer's.
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
