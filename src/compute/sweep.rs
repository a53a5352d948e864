//! Adaptive integration of several quantities along one variable at once.

use super::quadrature::gauss_legendre;
use std::collections::BinaryHeap;
use std::sync::OnceLock;

/// Points on −1 … 1, and their weights in the rules of one and three points of Gauss and of seven of Kronrod, each of
/// which contains the points of the one before. Piessens, de Doncker-Kapenga, Überhuber and Kahaner, QUADPACK (1983).
const POINTS: [(f64, [f64; 3]); 7] = [
    (0.0, [2.0, 8.0 / 9.0, 0.450_916_538_658_474_2]),
    (-0.774_596_669_241_483_4, [0.0, 5.0 / 9.0, 0.268_488_089_868_333_4]),
    (0.774_596_669_241_483_4, [0.0, 5.0 / 9.0, 0.268_488_089_868_333_4]),
    (-0.434_243_749_346_802_6, [0.0, 0.0, 0.401_397_414_775_962_2]),
    (0.434_243_749_346_802_6, [0.0, 0.0, 0.401_397_414_775_962_2]),
    (-0.960_491_268_708_020_3, [0.0, 0.0, 0.104_656_226_026_467_3]),
    (0.960_491_268_708_020_3, [0.0, 0.0, 0.104_656_226_026_467_3]),
];
/// Number of points of each rule in [`POINTS`].
const COUNTS: [usize; 3] = [1, 3, 7];
/// Length up to which three points show whether a piece is smooth: in a longer one they miss a kink near its ends.
/// \[rad\] Chosen; held by the test `smooth_and_kinked_integrands_hold_their_errors`.
const SHORT: f64 = 0.1;
/// Maximum number of halvings of a piece. Chosen: cost; the error of a piece that is not halved further is stated.
const DEPTH: u32 = 12;
/// Maximum number of points of [`rule`]: enough for [`rule_over`] an angle of π, 3 + π/[`WIDE`] = 23.
const MOST: usize = 24;
/// Width below which a smooth integrand has one point. \[rad\] The midpoint's relative error is width²/24 = 4e-6, for a
/// second derivative as large as the integrand.
const NARROWEST: f64 = 0.01;
/// Width below which a smooth integrand has two points. \[rad\] Their relative error is width⁴/4320 = 1e-8, for a
/// fourth derivative as large as the integrand.
const NARROW: f64 = 0.08;
/// Width that adds one to the three points of a wider integrand. \[rad\] Three points have a relative error of
/// width⁶/2016000 = 6e-12 here, for a sixth derivative as large as the integrand.
const WIDE: f64 = 0.15;

/// Returns the Gauss–Legendre rule on 0 … 1 by number of points, computed once; at most 24 points.
pub fn rule(points: usize) -> &'static [(f64, f64)] {
    static RULES: OnceLock<Vec<Vec<(f64, f64)>>> = OnceLock::new();
    &RULES.get_or_init(|| (0..=MOST).map(gauss_legendre).collect())[points.clamp(1, MOST)]
}

/// Returns the Gauss–Legendre rule on 0 … 1 for a smooth integrand over an angle `width`: few points where it is
/// narrow. \[rad\]
pub fn rule_over(width: f64) -> &'static [(f64, f64)] {
    rule(match width {
        ..NARROWEST => 1,
        ..NARROW => 2,
        _ => 3 + (width / WIDE) as usize,
    })
}

/// Piece of the range, with the values at the points of the rules up to one of them.
struct Piece<const N: usize> {
    ends: [f64; 2],
    depth: u32,
    rule: usize,
    values: [[f64; N]; 7],
}

impl<const N: usize> Piece<N> {
    fn new(f: &mut impl FnMut(f64) -> [f64; N], ends: [f64; 2], depth: u32) -> Self {
        let mut piece = Self { ends, depth, rule: 0, values: [[0.0; N]; 7] };
        piece.values[0] = f(0.5 * (ends[0] + ends[1]));
        piece.improve(f);
        if ends[1] - ends[0] > SHORT {
            piece.improve(f);
        }
        piece
    }

    /// Adds the points of the next rule.
    fn improve(&mut self, f: &mut impl FnMut(f64) -> [f64; N]) {
        let (middle, half) = (0.5 * (self.ends[0] + self.ends[1]), 0.5 * (self.ends[1] - self.ends[0]));
        let fresh = COUNTS[self.rule]..COUNTS[self.rule + 1];
        for ((x, _), values) in POINTS[fresh.clone()].iter().zip(&mut self.values[fresh]) {
            *values = f(middle + half * x);
        }
        self.rule += 1;
    }

    /// Returns the integral of a quantity by a rule.
    fn integral(&self, rule: usize, quantity: usize) -> f64 {
        let half = 0.5 * (self.ends[1] - self.ends[0]);
        let points = POINTS.iter().zip(&self.values).take(COUNTS[rule]);
        half * points.map(|((_, weights), values)| weights[rule] * values[quantity]).sum::<f64>()
    }

    /// Returns the error of the last rule in the first quantity: half of its difference from the rule before. Compared
    /// with that, the mean error at steps anywhere in a piece is 0.42 and 0.49 for three and seven points, at kinks
    /// 0.11 and 0.24, of smooth integrands less than a hundredth.
    fn off(&self) -> f64 {
        0.5 * (self.integral(self.rule, 0) - self.integral(self.rule - 1, 0)).abs()
    }
}

/// Integrates f over the range of `knots` (rising), and returns the error. The piece with the largest error gets more
/// points, and is halved then, until the errors of the first quantity sum up to no more than `relative` of the whole,
/// or `absolute`, see `Piece::off`.
pub fn sweep<const N: usize>(
    mut f: impl FnMut(f64) -> [f64; N],
    knots: &[f64],
    relative: f64,
    absolute: f64,
) -> ([f64; N], f64) {
    let ends = knots.windows(2).filter(|pair| pair[1] - pair[0] > 1e-13);
    let mut pieces: Vec<Piece<N>> = ends.map(|pair| Piece::new(&mut f, [pair[0], pair[1]], 0)).collect();
    let whole: f64 = pieces.iter().map(|piece| piece.integral(piece.rule, 0).abs()).sum();
    let bound = (relative * whole).max(absolute);
    // The bits of numbers that are not negative are ordered as the numbers.
    let by_error = |place: usize, piece: &Piece<N>| (piece.off().to_bits(), place);
    let mut open: BinaryHeap<_> = pieces.iter().enumerate().map(|(place, piece)| by_error(place, piece)).collect();
    let mut error: f64 = pieces.iter().map(Piece::off).sum();
    while error > bound
        && let Some((_, place)) = open.pop()
    {
        let piece = &mut pieces[place];
        error -= piece.off();
        if piece.rule == 1 {
            piece.improve(&mut f);
        } else if piece.depth < DEPTH {
            let ([from, to], depth) = (piece.ends, piece.depth + 1);
            let middle = 0.5 * (from + to);
            *piece = Piece::new(&mut f, [from, middle], depth);
            let other = Piece::new(&mut f, [middle, to], depth);
            error += other.off();
            open.push(by_error(pieces.len(), &other));
            pieces.push(other);
        } else {
            error += piece.off();
            continue;
        }
        error += pieces[place].off();
        open.push(by_error(place, &pieces[place]));
    }
    let mut total = [0.0; N];
    for piece in &pieces {
        total.iter_mut().enumerate().for_each(|(quantity, total)| *total += piece.integral(piece.rule, quantity));
    }
    (total, pieces.iter().map(Piece::off).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_and_kinked_integrands_hold_their_errors() {
        let ([sine, one], error) = sweep(|x| [x.sin(), 1.0], &[0.0, 1.0, std::f64::consts::PI], 1e-6, 0.0);
        assert!((sine - 2.0).abs() <= error && error < 1e-4, "{sine} {error}");
        assert!((one - std::f64::consts::PI).abs() < 1e-12);
        // Kinks at places that no rule knows.
        let places = || (0..20).map(|k| (0.37 + 0.618_034 * f64::from(k)).fract());
        let ([kinks], error) = sweep(|x| [places().map(|at| (x - at).abs()).sum()], &[0.0, 1.0], 1e-5, 0.0);
        let exact: f64 = places().map(|at| 0.5 * (at * at + (1.0 - at) * (1.0 - at))).sum();
        assert!((kinks - exact).abs() <= error && error <= 1e-5 * exact * (1.0 + 1e-9), "{kinks} {exact} {error}");
        let ([jump], error) = sweep(|x| [f64::from(x > 0.3)], &[0.0, 1.0], 1e-3, 0.0);
        assert!((jump - 0.7).abs() <= error.max(1e-4) && error < 5e-3, "{jump} {error}");
    }

    /// Mean error of a rule over its mean difference from the rule before, for integrands on −1 … 1 that change at a
    /// place anywhere.
    fn share_of_difference(f: impl Fn(f64, f64) -> f64, exact: impl Fn(f64) -> f64, rule: usize) -> f64 {
        let (mut error, mut difference) = (0.0, 0.0);
        for place in 0..20_000 {
            let at = (f64::from(place) + 0.5) / 10_000.0 - 1.0;
            let piece = Piece::new(&mut |x| [f(x, at)], [-1.0, 1.0], 0);
            error += (piece.integral(rule, 0) - exact(at)).abs();
            difference += (piece.integral(rule, 0) - piece.integral(rule - 1, 0)).abs();
        }
        error / difference
    }

    #[test]
    fn errors_are_at_most_half_of_what_rules_differ_by() {
        for (rule, of_step, of_kink) in [(1, 0.415, 0.112), (2, 0.492, 0.236)] {
            let step = share_of_difference(|x, at| f64::from(x > at), |at| 1.0 - at, rule);
            let kink = share_of_difference(|x, at| (x - at).abs(), |at| 1.0 + at * at, rule);
            assert!((step - of_step).abs() < 1e-3 && (kink - of_kink).abs() < 1e-3, "{rule}: {step} {kink}");
        }
    }
}
