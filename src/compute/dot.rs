//! Sums of products, with registers as wide as the processor's. The order of the additions is the same on every
//! processor, and nothing is contracted: so are these sums. Products of matrices elsewhere may round differently on
//! another processor.

use pulp::Arch;

/// Number of running sums of [`dot`]: four registers of four. Chosen: cost; results change within their rounding.
const SUMS: usize = 16;

/// Runs work on many numbers, compiled for the processor's instruction set.
pub fn wide<R>(work: impl FnOnce() -> R) -> R {
    Arch::new().dispatch(work)
}

/// Returns Σ a·b.
pub fn dot<T: Copy + Into<f64>>(a: &[T], b: &[f64]) -> f64 {
    wide(|| {
        let mut sums = [0.0; SUMS];
        let (whole_a, whole_b) = (a.chunks_exact(SUMS), b.chunks_exact(SUMS));
        let rest: f64 = whole_a.remainder().iter().zip(whole_b.remainder()).map(|(a, b)| (*a).into() * b).sum();
        for (a, b) in whole_a.zip(whole_b) {
            for k in 0..SUMS {
                sums[k] += a[k].into() * b[k];
            }
        }
        let four: [f64; 4] = std::array::from_fn(|k| (sums[k] + sums[k + 4]) + (sums[k + 8] + sums[k + 12]));
        (four[0] + four[1]) + (four[2] + four[3]) + rest
    })
}

/// Adds a row times a factor to the sums.
pub fn add_scaled<T: Copy + Into<f64>>(sums: &mut [f64], row: &[T], factor: f64) {
    wide(|| sums.iter_mut().zip(row).for_each(|(sum, &e)| *sum += factor * e.into()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lengths_give_their_sums() {
        let numbers = |n: usize, step: f64| (0..n).map(|k| (step * k as f64).fract() - 0.4).collect::<Vec<f64>>();
        for n in (0..70).chain([1000, 1001]) {
            let (a, b) = (numbers(n, 0.618_034), numbers(n, 0.754_878));
            let plain: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
            assert!((dot(&a, &b) - plain).abs() < 1e-13 * (1.0 + n as f64), "{n}");
            let half: Vec<f32> = a.iter().map(|&a| a as f32).collect();
            let mut sums = b.clone();
            add_scaled(&mut sums, &half, 0.3);
            for ((sum, a), b) in sums.iter().zip(&half).zip(&b) {
                assert_eq!(*sum, b + 0.3 * f64::from(*a));
            }
        }
    }
}
