//! Sequences of numbers that follow from a seed alone, whatever thread requests them.
//!
//! | item | use |
//! | --- | --- |
//! | [`Random`] | random numbers, one after the other |
//! | [`mixed`] | a seed for every part of a work |
//! | [`net`] | points that fill the unit square uniformly, any power of two of them |
//! | [`recurrence`] | uniformly spread numbers in many dimensions, in any number |
//!
//! Sources: G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014 (SplitMix64); I. M. Sobol', USSR Comput. Math. Math. Phys.
//! 7(4), 1967; A. B. Owen, in Monte Carlo and Quasi-Monte Carlo Methods in Scientific Computing, Springer 1995; the
//! scrambling by a hash: S. Laine, T. Karras, EGSR 2011, with the constants of N. Vegdahl.

/// SplitMix64 sequence of random numbers.
#[derive(Debug, Clone)]
pub struct Random(pub u64);

/// Increment of the state of SplitMix64: 2⁶⁴/φ, φ the golden ratio (Steele, Lea and Flood 2014).
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

impl Random {
    /// Returns 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        let bits = mix(self.0);
        self.0 = self.0.wrapping_add(STEP);
        bits
    }

    /// Returns a random number 0 ≤ x < 1.
    pub const fn unit(&mut self) -> f64 {
        unit(self.bits())
    }
}

/// Returns the first bits that [`Random`] gives with a seed: unlike those of neighbouring seeds.
pub const fn mix(seed: u64) -> u64 {
    let z = seed.wrapping_add(STEP);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Returns a seed made of another one and some numbers.
pub fn mixed(seed: u64, numbers: impl IntoIterator<Item = u64>) -> u64 {
    numbers.into_iter().fold(seed, |seed, number| mix(seed ^ number))
}

/// Returns a number 0 ≤ x < 1 from random bits.
pub const fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// Returns a number of the additive recurrence: the fraction of start + number · step. Uniformly spread in as many
/// dimensions as there are steps that have no sum of integer multiples in common with 1.
pub fn recurrence(start: f64, number: f64, step: f64) -> f64 {
    (start + number * step).fract()
}

/// Returns a point of Sobol's sequence with Owen's scrambling in the unit square: of 2^m points from a multiple of 2^m
/// on, exactly one lies in each box of 2^a × 2^(m − a) equal ones, for every a. Each single point is uniformly
/// distributed.
pub fn net(number: u32, seed: u64) -> [f64; 2] {
    let (mut other, mut digit, mut rest) = (0_u32, 1_u32 << 31, number);
    while rest > 0 {
        if rest & 1 == 1 {
            other ^= digit;
        }
        digit ^= digit >> 1;
        rest >>= 1;
    }
    let unit = |x: u32| (f64::from(x) + 0.5) / 2_f64.powi(32);
    let [a, b] = [1, 2].map(|k| mix(seed ^ k));
    [unit(scrambled(number.reverse_bits(), a)), unit(scrambled(other, b))]
}

/// Applies Owen's scrambling: every binary digit is flipped or not, depending on the digits before it.
fn scrambled(x: u32, seed: u64) -> u32 {
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed as u32);
    x = x.wrapping_mul((seed >> 32) as u32 | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_numbers_are_those_of_the_published_generator() {
        // The first outputs with the seed 1234567 (Vigna's splitmix64.c).
        let mut random = Random(1_234_567);
        let known = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!(known, [(); 3].map(|()| random.bits()));
        assert_eq!(mix(1_234_567), known[0]);
        assert!((0.0..1.0).contains(&unit(u64::MAX)));
    }

    #[test]
    fn every_elementary_box_has_one_point() {
        for (seed, m, start) in [(0, 6, 0), (7, 8, 0), (8, 8, 3), (9, 9, 1), (u64::MAX, 10, 5)] {
            for a in 0..=m {
                let parts = [1_usize << a, 1 << (m - a)];
                let mut boxes = vec![0; 1 << m];
                for number in 0..1_u32 << m {
                    let at = net((start << m) + number, seed);
                    let [i, j] = [0, 1].map(|k| (at[k] * parts[k] as f64) as usize);
                    boxes[i * parts[1] + j] += 1;
                }
                assert!(boxes.iter().all(|count| *count == 1), "seed {seed}, 2^{m} points, {parts:?}");
            }
        }
    }

    #[test]
    fn every_point_is_as_likely_anywhere_and_both_coordinates_are_independent() {
        for number in [0, 1, 5, 77] {
            let n = 20_000;
            let (mut mean, mut square, mut both) = ([0.0; 2], [0.0; 2], 0.0);
            for seed in 0..n {
                let [x, y] = net(number, mixed(seed, [3]));
                for (k, at) in [x, y].into_iter().enumerate() {
                    mean[k] += at / n as f64;
                    square[k] += at * at / n as f64;
                }
                both += x * y / n as f64;
            }
            // Standard errors: 0.0020 of the mean, 0.0021 of the square, 0.0019 of the product.
            assert!(mean.iter().all(|mean| (mean - 0.5).abs() < 0.009), "{number}: {mean:?}");
            assert!(square.iter().all(|square| (square - 1.0 / 3.0).abs() < 0.009), "{number}: {square:?}");
            assert!((both - 0.25).abs() < 0.009, "{number}: {both}");
        }
    }

    #[test]
    fn a_smooth_function_is_found_far_better_than_by_chance() {
        let n = 1024;
        let mean = |seed| (0..n).map(|k| net(k, seed)).map(|[x, y]| x * y.exp()).sum::<f64>() / f64::from(n);
        let exact = 0.5 * (1.0_f64.exp() - 1.0);
        let rms = ((0..50).map(|seed| (mean(seed) - exact).powi(2)).sum::<f64>() / 50.0).sqrt();
        // By chance it would be 0.018.
        assert!(rms < 4e-4, "{rms}");
    }
}
