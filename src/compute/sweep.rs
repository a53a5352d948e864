//! Adaptive integration of several quantities along one variable at once.

use super::quadrature::gauss_legendre;
use std::sync::OnceLock;

/// Points of the rule on a piece and on each of its halves.
const POINTS: usize = 4;
/// Halvings of a piece at most.
const DEPTH: u32 = 12;
/// Most points of [`rule`].
const MOST: usize = 24;

/// Gauss–Legendre rules on 0 … 1 by number of points, made once; at most 24 points.
pub fn rule(points: usize) -> &'static [(f64, f64)] {
    static RULES: OnceLock<Vec<Vec<(f64, f64)>>> = OnceLock::new();
    &RULES.get_or_init(|| (0..=MOST).map(gauss_legendre).collect())[points.clamp(1, MOST)]
}

/// ∫ f over the range of `knots` (rising), and its error. Pieces are halved until the first quantity of a piece and of
/// its halves differ by no more than `relative` of the whole, or `absolute`, taken together.
///
/// The error is what pieces and halves differ by: of a smooth integrand hundreds of times too much, of one with kinks
/// about what it is.
pub fn sweep<const N: usize>(
    mut f: impl FnMut(f64) -> [f64; N],
    knots: &[f64],
    relative: f64,
    absolute: f64,
) -> ([f64; N], f64) {
    let rule = rule(POINTS);
    let mut measure = |from: f64, to: f64| {
        let mut sum = [0.0; N];
        for &(x, weight) in rule {
            let values = f(from + (to - from) * x);
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * (to - from) * value);
        }
        sum
    };
    let pieces = knots.windows(2).filter(|pair| pair[1] - pair[0] > 1e-13);
    let mut open: Vec<(f64, f64, [f64; N], u32)> =
        pieces.map(|pair| (pair[0], pair[1], measure(pair[0], pair[1]), 0)).collect();
    let whole: f64 = open.iter().map(|piece| piece.2[0].abs()).sum();
    let bound = (relative * whole).max(absolute);
    let count = open.len().max(1) as f64;
    let (mut total, mut error) = ([0.0; N], 0.0);
    while let Some((from, to, value, depth)) = open.pop() {
        let middle = 0.5 * (from + to);
        let halves = [measure(from, middle), measure(middle, to)];
        let change = (halves[0][0] + halves[1][0] - value[0]).abs();
        // What one piece may be off: its share of the pieces at the outset, less with every halving.
        let allowed = bound / count * 0.5_f64.powf(0.5 * f64::from(depth));
        if change <= allowed || depth >= DEPTH {
            error += change;
            for half in halves {
                total.iter_mut().zip(half).for_each(|(sum, value)| *sum += value);
            }
        } else {
            open.push((from, middle, halves[0], depth + 1));
            open.push((middle, to, halves[1], depth + 1));
        }
    }
    (total, error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_and_kinked_integrands_hold_their_errors() {
        let ([sine, one], error) = sweep(|x| [x.sin(), 1.0], &[0.0, 1.0, std::f64::consts::PI], 1e-6, 0.0);
        assert!((sine - 2.0).abs() <= error && error < 1e-4, "{sine} {error}");
        assert!((one - std::f64::consts::PI).abs() < 1e-12);
        let ([kink], error) = sweep(|x| [(x - 0.37_f64).abs()], &[0.0, 1.0], 1e-5, 0.0);
        let exact = 0.5 * (0.37 * 0.37 + 0.63 * 0.63);
        assert!((kink - exact).abs() <= error && error < 1e-4, "{kink} {exact} {error}");
        let ([jump], error) = sweep(|x| [f64::from(x > 0.3)], &[0.0, 1.0], 1e-3, 0.0);
        assert!((jump - 0.7).abs() <= error.max(1e-4) && error < 5e-3, "{jump} {error}");
    }
}
