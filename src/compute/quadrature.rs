//! Numerical integration with error estimates: Gauss–Legendre rules of any order, adaptive Gauss–Kronrod in one
//! dimension, and adaptive products of Gauss–Kronrod rules over rectangles.
//!
//! Adaptive rules keep a list of pieces and always halve the one with the largest error, so the work goes where the
//! integrand is difficult. Effort is bounded; a tolerance that is not reached shows in the error of the returned
//! [`Estimate`]. Knots known beforehand (kinks, jumps) belong into the list of pieces, not into the adaptivity.
//!
//! References: Piessens et al., QUADPACK (1983); Golub and Welsch (1969) for the meaning of the rules.

use super::estimate::Estimate;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::PI;

/// Tolerance of an integral and maximum effort.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Absolute error to reach, in the unit of the integral.
    pub absolute: f64,
    /// Error to reach relative to the integral; the larger of both counts.
    pub relative: f64,
    /// Maximum number of evaluations of the rule.
    pub max_pieces: usize,
}

impl Tolerance {
    /// Creates a tolerance of a relative error only.
    pub const fn relative(relative: f64) -> Self {
        Self { absolute: 0.0, relative, max_pieces: 2000 }
    }

    /// Creates a tolerance of an absolute error only.
    pub const fn absolute(absolute: f64) -> Self {
        Self { absolute, relative: 0.0, max_pieces: 2000 }
    }

    fn reached(&self, value: f64, error: f64) -> bool {
        // Below a few units of rounding no halving helps.
        error <= self.absolute.max(value.abs() * self.relative.max(1e-15))
    }
}

/// Returns nodes and weights of the Gauss–Legendre rule of `order` points on 0 … 1, exact for polynomials of degree
/// 2·order − 1. Newton's method on the Legendre recurrence.
pub fn gauss_legendre(order: usize) -> Vec<(f64, f64)> {
    let n = order as f64;
    let mut rule = vec![(0.0, 0.0); order];
    for i in 0..order.div_ceil(2) {
        let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (mut previous, mut value) = (0.0, 1.0);
            for k in 1..=order {
                let k = k as f64;
                (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
            }
            slope = n * (x * value - previous) / (x * x - 1.0);
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        let weight = 1.0 / ((1.0 - x * x) * slope * slope);
        rule[i] = (0.5 * (1.0 - x), weight);
        rule[order - 1 - i] = (0.5 * (1.0 + x), weight);
    }
    rule
}

/// Returns nodes and weights of `count` midpoints on 0 … 1: for integrands that are not smooth.
pub fn midpoints(count: usize) -> Vec<(f64, f64)> {
    (0..count).map(|k| ((k as f64 + 0.5) / count as f64, 1.0 / count as f64)).collect()
}

/// Kronrod's 15 points on −1 … 1 (the half with x ≥ 0): node, Kronrod weight, weight in the 7-point Gauss rule. Source:
/// routine QK15 of QUADPACK; held by the test `kronrod_rules_are_exact_for_their_degree`.
const KRONROD_15: [(f64, f64, f64); 8] = [
    (0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
];

/// Kronrod's 7 points on −1 … 1: node, Kronrod weight, weight in the 3-point Gauss rule. Defined by being exact up to
/// degree 11; held by the test `kronrod_rules_are_exact_for_their_degree`.
const KRONROD_7: [(f64, f64, f64); 7] = [
    (-0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
    (-0.774_596_669_241_483_4, 0.268_488_089_868_333_45, 0.555_555_555_555_555_6),
    (-0.434_243_749_346_802_56, 0.401_397_414_775_962_24, 0.0),
    (0.0, 0.450_916_538_658_474_14, 0.888_888_888_888_888_8),
    (0.434_243_749_346_802_56, 0.401_397_414_775_962_24, 0.0),
    (0.774_596_669_241_483_4, 0.268_488_089_868_333_45, 0.555_555_555_555_555_6),
    (0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
];

/// Returns the error by QUADPACK's scaling of |Kronrod − Gauss|: the difference is the error of the weaker rule, and
/// the better rule gains faster than it, the more so the smaller the difference is against the variation of the
/// integrand. Its factor 200 makes the result two to three digits too large; 20 still leaves the difference itself
/// where an integrand is rough (above 1/8000 of the variation), where the better rule gains only a constant factor.
fn scaled_error(difference: f64, variation: f64, magnitude: f64) -> f64 {
    let error = if variation > 0.0 && difference > 0.0 {
        (variation * (20.0 * difference / variation).powf(1.5)).min(difference)
    } else {
        difference
    };
    // Rounding.
    error.max(2.0 * f64::EPSILON * magnitude)
}

/// Returns the error like [`scaled_error`] for pieces that are known to be smooth: of that function's reserve, which
/// costs ten times the work, one digit is left. Pieces that are not smooth after all are detected when they are halved,
/// see [`adapt`].
fn smooth_error(difference: f64, variation: f64, magnitude: f64) -> f64 {
    let error = if variation > 0.0 && difference > 0.0 {
        variation * (10.0 * difference / variation).powf(1.5).min(1.0)
    } else {
        difference
    };
    error.max(2.0 * f64::EPSILON * magnitude)
}

/// Applies the 7–15 rule once.
fn kronrod_15(f: &mut impl FnMut(f64) -> f64, a: f64, b: f64) -> Estimate {
    let (centre, half) = (0.5 * (a + b), 0.5 * (b - a));
    let mut values = [0.0; 15];
    values[0] = f(centre);
    let (mut kronrod, mut gauss) = (KRONROD_15[0].1 * values[0], KRONROD_15[0].2 * values[0]);
    let mut magnitude = KRONROD_15[0].1 * values[0].abs();
    for (i, &(x, weight, gauss_weight)) in KRONROD_15.iter().enumerate().skip(1) {
        let (low, high) = (f(centre - half * x), f(centre + half * x));
        (values[2 * i - 1], values[2 * i]) = (low, high);
        kronrod += weight * (low + high);
        gauss += gauss_weight * (low + high);
        magnitude += weight * (low.abs() + high.abs());
    }
    let mean = 0.5 * kronrod;
    let variation: f64 = (0..15_usize).map(|i| KRONROD_15[i.div_ceil(2)].1 * (values[i] - mean).abs()).sum();
    let half_abs = half.abs();
    let error = scaled_error((kronrod - gauss).abs() * half_abs, variation * half_abs, magnitude * half_abs);
    Estimate::new(kronrod * half, error)
}

/// Piece of the domain in the queue, ordered by error.
struct Piece<D> {
    domain: D,
    estimate: Estimate,
    /// Error by the rule alone, before it is raised by a comparison with the halves.
    claimed: f64,
    /// Whether to cut along the second axis next time (rectangles only).
    second_axis: bool,
}

impl<D> PartialEq for Piece<D> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl<D> Eq for Piece<D> {}
impl<D> PartialOrd for Piece<D> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<D> Ord for Piece<D> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.estimate.error.total_cmp(&other.estimate.error)
    }
}

/// Halves the worst piece until the tolerance is reached or the effort spent. `measure` gives the estimate of a domain
/// and the axis to cut it along; `halve` cuts.
///
/// Halves check the error estimated for their whole: where the value changes by more than that, the errors of the
/// halves are raised in proportion, six times for safety. This detects kinks inside a piece, for which the rules'
/// errors are too small.
fn adapt<D: Copy>(
    start: impl Iterator<Item = D>,
    tolerance: Tolerance,
    mut measure: impl FnMut(D) -> (Estimate, bool),
    halve: impl Fn(D, bool) -> Option<[D; 2]>,
) -> Estimate {
    let mut pieces = BinaryHeap::new();
    // Pieces too small to halve leave the queue but keep their share.
    let mut settled = Estimate::default();
    let mut total = Estimate::default();
    for domain in start {
        let (estimate, second_axis) = measure(domain);
        total += estimate;
        pieces.push(Piece { domain, estimate, claimed: estimate.error, second_axis });
    }
    let mut spent = pieces.len();
    while spent < tolerance.max_pieces && !tolerance.reached(total.value, total.error) {
        let Some(worst) = pieces.pop() else { break };
        let Some(halves) = halve(worst.domain, worst.second_axis) else {
            settled += worst.estimate;
            continue;
        };
        total = Estimate::new(total.value - worst.estimate.value, (total.error - worst.estimate.error).max(0.0));
        let parts = halves.map(|domain| (domain, measure(domain)));
        let change = (parts.iter().map(|(_, (part, _))| part.value).sum::<f64>() - worst.estimate.value).abs();
        let factor = if worst.claimed > 0.0 { (6.0 * change / worst.claimed).max(1.0) } else { 1.0 };
        for (domain, (part, second_axis)) in parts {
            let estimate = Estimate::new(part.value, (part.error * factor).min(part.error.max(change)));
            total += estimate;
            pieces.push(Piece { domain, estimate, claimed: part.error, second_axis });
        }
        spent += 2;
    }
    // Summed afresh: the running total has lost digits to subtraction.
    settled + pieces.into_iter().map(|piece| piece.estimate).sum()
}

/// Integrates f over the range of `knots` (rising), cut at every inner knot; adaptive 7–15 Gauss–Kronrod. Fewer than
/// two different knots give 0.
pub fn integrate(mut f: impl FnMut(f64) -> f64, knots: &[f64], tolerance: Tolerance) -> Estimate {
    let start = knots.windows(2).map(|pair| (pair[0], pair[1])).filter(|(a, b)| b > a);
    adapt(
        start,
        tolerance,
        |(a, b)| (kronrod_15(&mut f, a, b), false),
        |(a, b), _| {
            let middle = 0.5 * (a + b);
            (middle > a && middle < b).then_some([(a, middle), (middle, b)])
        },
    )
}

/// Rectangle x₀ … x₁ × y₀ … y₁.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    /// Begin and end along the first axis.
    pub x: (f64, f64),
    /// Begin and end along the second axis.
    pub y: (f64, f64),
}

impl Rectangle {
    /// Unit square 0 … 1 × 0 … 1.
    pub const UNIT: Self = Self { x: (0.0, 1.0), y: (0.0, 1.0) };

    fn halves(self, second_axis: bool) -> Option<[Self; 2]> {
        let (from, to) = if second_axis { self.y } else { self.x };
        let middle = 0.5 * (from + to);
        if !(middle > from && middle < to) {
            return None;
        }
        Some(if second_axis {
            [Self { y: (from, middle), ..self }, Self { y: (middle, to), ..self }]
        } else {
            [Self { x: (from, middle), ..self }, Self { x: (middle, to), ..self }]
        })
    }
}

/// Applies the product of two 3–7 rules; the flag says whether the second axis has the larger error.
fn kronrod_7_squared(
    f: &mut impl FnMut(f64, f64) -> f64,
    domain: Rectangle,
    claim: fn(f64, f64, f64) -> f64,
) -> (Estimate, bool) {
    let (cx, hx) = (0.5 * (domain.x.0 + domain.x.1), 0.5 * (domain.x.1 - domain.x.0));
    let (cy, hy) = (0.5 * (domain.y.0 + domain.y.1), 0.5 * (domain.y.1 - domain.y.0));
    let (mut best, mut coarse_x, mut coarse_y, mut magnitude, mut squares) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for &(x, kronrod_x, gauss_x) in &KRONROD_7 {
        let (mut along, mut along_coarse) = (0.0, 0.0);
        for &(y, kronrod_y, gauss_y) in &KRONROD_7 {
            let value = f(cx + hx * x, cy + hy * y);
            along += kronrod_y * value;
            along_coarse += gauss_y * value;
            magnitude += kronrod_x * kronrod_y * value.abs();
            squares += kronrod_x * kronrod_y * value * value;
        }
        best += kronrod_x * along;
        coarse_x += gauss_x * along;
        coarse_y += kronrod_x * along_coarse;
    }
    let area = hx * hy;
    let (difference_x, difference_y) = ((best - coarse_x).abs(), (best - coarse_y).abs());
    // Standard deviation over the rectangle, times its measure 4: the variation.
    let variation = 4.0 * (0.25 * squares - (0.25 * best).powi(2)).max(0.0).sqrt();
    let error = claim((difference_x + difference_y) * area, variation * area, magnitude * area);
    (Estimate::new(best * area, error), difference_y > difference_x)
}

/// Integrates f(x, y) over a list of rectangles; adaptive products of 3–7 Gauss–Kronrod rules, halving across the axis
/// with the larger error.
pub fn integrate_rectangles(
    f: impl FnMut(f64, f64) -> f64,
    rectangles: &[Rectangle],
    tolerance: Tolerance,
) -> Estimate {
    over_rectangles(f, rectangles, tolerance, scaled_error)
}

/// Integrates like [`integrate_rectangles`] an integrand that is smooth on each of the rectangles, kinks and jumps
/// being on their borders: the same accuracy for a tenth of the evaluations, by an error estimate with less in reserve.
pub fn integrate_smooth_rectangles(
    f: impl FnMut(f64, f64) -> f64,
    rectangles: &[Rectangle],
    tolerance: Tolerance,
) -> Estimate {
    over_rectangles(f, rectangles, tolerance, smooth_error)
}

fn over_rectangles(
    mut f: impl FnMut(f64, f64) -> f64,
    rectangles: &[Rectangle],
    tolerance: Tolerance,
    claim: fn(f64, f64, f64) -> f64,
) -> Estimate {
    adapt(
        rectangles.iter().copied(),
        tolerance,
        |domain| kronrod_7_squared(&mut f, domain, claim),
        |domain, second_axis| domain.halves(second_axis),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_legendre_is_exact_for_its_degree() {
        for order in [1, 2, 5, 12, 40] {
            let rule = gauss_legendre(order);
            for degree in [0, 1, 2 * order - 1] {
                let sum: f64 = rule.iter().map(|(x, weight)| weight * x.powi(degree as i32)).sum();
                assert!((sum * (degree + 1) as f64 - 1.0).abs() < 1e-13, "order {order}, degree {degree}: {sum}");
            }
        }
    }

    #[test]
    fn kronrod_rules_are_exact_for_their_degree() {
        // 15 points: degree 22; 7 points: degree 11, in each axis.
        let line = kronrod_15(&mut |x: f64| 23.0 * x.powi(22), 0.0, 1.0);
        assert!((line.value - 1.0).abs() < 1e-14);
        let (square, _) =
            kronrod_7_squared(&mut |x: f64, y: f64| 144.0 * (x * y).powi(11), Rectangle::UNIT, scaled_error);
        assert!((square.value - 1.0).abs() < 1e-14);
    }

    #[test]
    fn errors_bound_the_truth_for_smooth_and_rough() {
        type Case = (fn(f64) -> f64, f64);
        let cases: [Case; 4] = [
            (|x| x.exp(), 1_f64.exp() - 1.0),
            (|x| x.sqrt(), 2.0 / 3.0),
            (|x| (x - 0.3).abs(), 0.5 * (0.09 + 0.49)),
            (|x| 1.0 / (1e-4 + (x - 0.7).powi(2)), 100.0 * ((30_f64).atan() + (70_f64).atan())),
        ];
        for (index, (f, truth)) in cases.into_iter().enumerate() {
            let got = integrate(f, &[0.0, 1.0], Tolerance::relative(1e-9));
            assert!((got.value - truth).abs() <= got.error.max(1e-14 * truth), "{index}: {got:?} {truth}");
            assert!(got.error <= 1.1e-9 * truth, "{index}: {got:?}");
        }
    }

    #[test]
    fn rectangles_adapt_to_a_cone() {
        // ∬ √(x² + y²) over the unit square = (√2 + asinh 1)/3
        let truth = (2_f64.sqrt() + 1_f64.asinh()) / 3.0;
        let got = integrate_rectangles(f64::hypot, &[Rectangle::UNIT], Tolerance::relative(1e-8));
        assert!((got.value - truth).abs() <= got.error && got.error < 1.1e-8, "{got:?}");
        let got = integrate_smooth_rectangles(f64::hypot, &[Rectangle::UNIT], Tolerance::relative(1e-8));
        assert!((got.value - truth).abs() <= got.error && got.error < 1.1e-8, "{got:?}");
    }

    #[test]
    fn a_kink_inside_is_found_out() {
        // ∬ |x − y/2 − 0.3| over the unit square: no rectangle ever has the kink on its border.
        let truth: f64 = gauss_legendre(40)
            .into_iter()
            .map(|(y, weight)| {
                let at = 0.5 * y + 0.3;
                weight * 0.5 * (at * at + (1.0 - at) * (1.0 - at))
            })
            .sum();
        for relative in [1e-3, 1e-5, 1e-7] {
            let tolerance = Tolerance { max_pieces: 100_000, ..Tolerance::relative(relative) };
            let got = integrate_smooth_rectangles(|x, y| (x - 0.5 * y - 0.3).abs(), &[Rectangle::UNIT], tolerance);
            assert!((got.value - truth).abs() <= got.error && got.error <= 1.01 * relative * truth, "{got:?} {truth}");
        }
    }

    #[test]
    fn effort_is_bounded_and_told() {
        let tolerance = Tolerance { max_pieces: 10, ..Tolerance::relative(1e-12) };
        let got = integrate(|x: f64| (1e4 * x).sin().signum(), &[0.0, 1.0], tolerance);
        assert!(got.error > 1e-3);
    }
}
