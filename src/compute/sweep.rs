//! Adaptive integration of several quantities along one variable at once.

use super::quadrature::gauss_legendre;
use std::sync::OnceLock;

/// Kronrod's seven points on −1 … 1 from the middle on, with their weights in his rule and in Gauss's of three of them. Piessens,
/// de Doncker-Kapenga, Überhuber and Kahaner, QUADPACK (1983).
const KRONROD: [[f64; 3]; 4] = [
    [0.0, 0.450_916_538_658_474_2, 8.0 / 9.0],
    [0.434_243_749_346_802_6, 0.401_397_414_775_962_2, 0.0],
    [0.774_596_669_241_483_4, 0.268_488_089_868_333_4, 5.0 / 9.0],
    [0.960_491_268_708_020_3, 0.104_656_226_026_467_3, 0.0],
];
/// Halvings of a piece at most.
const DEPTH: u32 = 12;
/// Most points of [`rule`].
const MOST: usize = 24;

/// Gauss–Legendre rules on 0 … 1 by number of points, made once; at most 24 points.
pub fn rule(points: usize) -> &'static [(f64, f64)] {
    static RULES: OnceLock<Vec<Vec<(f64, f64)>>> = OnceLock::new();
    &RULES.get_or_init(|| (0..=MOST).map(gauss_legendre).collect())[points.clamp(1, MOST)]
}

/// A piece of the range with its integrals by Kronrod's rule, and how far Gauss's is off in the first of them.
struct Piece<const N: usize> {
    ends: [f64; 2],
    sum: [f64; N],
    off: f64,
    depth: u32,
}

/// ∫ f over the range of `knots` (rising), and its error. Pieces are halved until what two rules say of the first quantity
/// differs by no more than `relative` of the whole, or `absolute`, taken together.
///
/// The error is what the two differ by: of a smooth integrand hundreds of times too much, of one with kinks about what it is.
pub fn sweep<const N: usize>(
    mut f: impl FnMut(f64) -> [f64; N],
    knots: &[f64],
    relative: f64,
    absolute: f64,
) -> ([f64; N], f64) {
    let mut measure = |from: f64, to: f64, depth: u32| {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (mut sum, mut simpler) = ([0.0; N], 0.0);
        for [x, weight, simple] in KRONROD {
            for x in [-x, x].into_iter().take(if x == 0.0 { 1 } else { 2 }) {
                let values = f(middle + half * x);
                simpler += half * simple * values[0];
                sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += half * weight * value);
            }
        }
        Piece { ends: [from, to], sum, off: (sum[0] - simpler).abs(), depth }
    };
    let pieces = knots.windows(2).filter(|pair| pair[1] - pair[0] > 1e-13);
    let mut open: Vec<Piece<N>> = pieces.map(|pair| measure(pair[0], pair[1], 0)).collect();
    let whole: f64 = open.iter().map(|piece| piece.sum[0].abs()).sum();
    let bound = (relative * whole).max(absolute);
    let count = open.len().max(1) as f64;
    let (mut total, mut error) = ([0.0; N], 0.0);
    while let Some(Piece { ends: [from, to], sum, off, depth }) = open.pop() {
        // What one piece may be off: its share of the pieces at the outset, less with every halving.
        let allowed = bound / count * 0.5_f64.powf(0.5 * f64::from(depth));
        if off <= allowed || depth >= DEPTH {
            error += off;
            total.iter_mut().zip(sum).for_each(|(total, sum)| *total += sum);
        } else {
            let middle = 0.5 * (from + to);
            open.extend([[from, middle], [middle, to]].map(|[from, to]| measure(from, to, depth + 1)));
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
