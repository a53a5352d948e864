//! Binary arithmetic coder: bits with estimated probabilities become a string of bytes of almost their entropy.
//!
//! It is the carry-propagating range coder of LZMA (Martin 1979, Pavlov), with 16-bit probabilities that adapt to the
//! bits coded before.

/// Probability that a bit is 0, in 65536ths; adapts to the bits that were coded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chance(u16);

/// Adaptation rate: each bit changes the probability by 1/2^RATE of its difference from that bit.
const RATE: u16 = 6;

impl Chance {
    /// Creates a probability from a byte: 0 means that the bit is almost never 0, 255 that it almost always is.
    pub const fn from_byte(byte: u8) -> Self {
        Self(((byte as u16) << 8) | 128)
    }

    /// Returns the byte, as for [`Self::from_byte`], of the probability estimated from the observed numbers of zeros
    /// and ones; near 1/2 for few bits.
    pub fn byte_for(zeros: u64, ones: u64) -> u8 {
        ((zeros as f64 + 0.4) / (zeros as f64 + ones as f64 + 0.8) * 256.0) as u8
    }

    fn follow(&mut self, bit: bool) {
        if bit {
            self.0 -= self.0 >> RATE;
        } else {
            self.0 += (u16::MAX - self.0) >> RATE;
        }
        self.0 = self.0.clamp(32, u16::MAX - 32);
    }
}

/// Minimum range of the coder; a smaller one is extended by a byte.
const LEAST_RANGE: u32 = 1 << 24;

/// Arithmetic encoder of bits.
#[derive(Debug)]
pub struct Encoder {
    low: u64,
    range: u32,
    cache: u8,
    pending: u64,
    out: Vec<u8>,
}

impl Default for Encoder {
    /// Creates an encoder that has written nothing yet.
    fn default() -> Self {
        Self { low: 0, range: u32::MAX, cache: 0, pending: 0, out: Vec::new() }
    }
}

impl Encoder {
    /// Writes a bit with its probability, and adapts the latter.
    pub fn bit(&mut self, chance: &mut Chance, bit: bool) {
        let bound = (self.range >> 16) * u32::from(chance.0);
        if bit {
            self.low += u64::from(bound);
            self.range -= bound;
        } else {
            self.range = bound;
        }
        chance.follow(bit);
        self.widen();
    }

    /// Writes a bit that is equally often 0 and 1.
    pub fn even_bit(&mut self, bit: bool) {
        self.range >>= 1;
        if bit {
            self.low += u64::from(self.range);
        }
        self.widen();
    }

    fn widen(&mut self) {
        while self.range < LEAST_RANGE {
            self.range <<= 8;
            self.shift();
        }
    }

    fn shift(&mut self) {
        if self.low < 0xFF00_0000 || self.low > u64::from(u32::MAX) {
            let carry = (self.low >> 32) as u8;
            // The first byte is the coder's own empty cache.
            self.out.push(self.cache.wrapping_add(carry));
            for _ in 0..self.pending {
                self.out.push(0xFF_u8.wrapping_add(carry));
            }
            self.pending = 0;
            self.cache = (self.low >> 24) as u8;
        } else {
            self.pending += 1;
        }
        self.low = (self.low & 0x00FF_FFFF) << 8;
    }

    /// Returns the bytes of all bits written, without zeros at the end, where [`Decoder`] reads zeros anyway.
    pub fn finish(mut self) -> Vec<u8> {
        // The roundest number within the range.
        let top = self.low + u64::from(self.range) - 1;
        for bits in (0..32).rev() {
            let round = top >> bits << bits;
            if round >= self.low {
                self.low = round;
                break;
            }
        }
        for _ in 0..5 {
            self.shift();
        }
        self.out.remove(0);
        while self.out.last() == Some(&0) {
            self.out.pop();
        }
        self.out
    }
}

/// Arithmetic decoder of the bytes that [`Encoder`] wrote. From other bytes it reads some bits without end.
#[derive(Debug)]
pub struct Decoder<'a> {
    bytes: &'a [u8],
    range: u32,
    code: u32,
}

impl<'a> Decoder<'a> {
    /// Creates a decoder at the beginning of the bytes.
    pub fn new(bytes: &'a [u8]) -> Self {
        let mut decoder = Self { bytes, range: u32::MAX, code: 0 };
        for _ in 0..4 {
            decoder.next_byte();
        }
        decoder
    }

    fn next_byte(&mut self) {
        let byte = match self.bytes.split_first() {
            Some((first, rest)) => {
                self.bytes = rest;
                *first
            }
            None => 0,
        };
        self.code = self.code << 8 | u32::from(byte);
    }

    /// Reads a bit with its probability, and adapts the latter.
    pub fn bit(&mut self, chance: &mut Chance) -> bool {
        let bound = (self.range >> 16) * u32::from(chance.0);
        let bit = self.code >= bound;
        if bit {
            self.code -= bound;
            self.range -= bound;
        } else {
            self.range = bound;
        }
        chance.follow(bit);
        self.widen();
        bit
    }

    /// Reads a bit that is equally often 0 and 1.
    pub fn even_bit(&mut self) -> bool {
        self.range >>= 1;
        let bit = self.code >= self.range;
        if bit {
            self.code -= self.range;
        }
        self.widen();
        bit
    }

    fn widen(&mut self) {
        while self.range < LEAST_RANGE {
            self.range <<= 8;
            self.next_byte();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn bits_come_back(bits in proptest::collection::vec((0_usize..3, any::<bool>()), 0..4000)) {
            let start = [Chance::from_byte(0), Chance::from_byte(128), Chance::from_byte(255)];
            let (mut encoder, mut chances) = (Encoder::default(), start);
            for &(k, bit) in &bits {
                encoder.bit(&mut chances[k], bit);
                encoder.even_bit(!bit);
            }
            let bytes = encoder.finish();
            let (mut decoder, mut chances) = (Decoder::new(&bytes), start);
            for &(k, bit) in &bits {
                prop_assert_eq!(decoder.bit(&mut chances[k]), bit);
                prop_assert_eq!(decoder.even_bit(), !bit);
            }
        }
    }

    #[test]
    fn rare_bits_cost_little() {
        let mut encoder = Encoder::default();
        let mut chance = Chance::from_byte(Chance::byte_for(990, 10));
        (0..10_000).for_each(|k| encoder.bit(&mut chance, k % 100 == 50));
        // Entropy of 1 in 100: 0.0808 bit.
        let bits = 8 * encoder.finish().len();
        assert!((808..1000).contains(&bits), "{bits}");
    }
}
