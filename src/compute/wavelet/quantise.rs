//! Quantisation of the wavelet coefficients of one indicatrix, with the coarsest step whose error is within a stated
//! one.

use super::transform::Transform;

/// Maximum error of a compressed indicatrix f̃ against the original f, with its measure; quantisation, clamping and
/// rescaling are included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Criterion {
    /// Share of the flux in wrong directions: ½∫|f̃ − f| cosθ dω / τ.
    Misplaced(f64),
    /// Relative rms error √(∫(f̃ − f)² cosθ dω / ∫f² cosθ dω).
    Rms(f64),
    /// Error energy relative to that of the indicatrix, ∫(f̃ − f)² cosθ dω / ∫f² cosθ dω: the square of [`Self::Rms`].
    Energy(f64),
}

impl Criterion {
    /// Criterion for archives: 0.5 % of the flux misplaced. Chosen: preserves the noise of measurements, too, see the
    /// head of [`crate::compute::wavelet`]; held by `tests/compute/compact.rs::a_blind_of_21_states_at_one_degree_fits`
    /// (8 MB).
    pub const ARCHIVE: Self = Self::Misplaced(0.005);
    /// Default criterion: 1.5 % of the flux misplaced. Chosen: noise of 2 % on a diffuser costs 1 kB here and 50 kB
    /// with [`Self::ARCHIVE`].
    pub const NORMAL: Self = Self::Misplaced(0.015);

    /// Returns the maximum error in the measure of the criterion.
    pub const fn threshold(self) -> f64 {
        match self {
            Self::Misplaced(e) | Self::Rms(e) | Self::Energy(e) => e,
        }
    }

    /// Whether the threshold is within the allowed range: from 1e-6 (for [`Self::Energy`] 1e-12) to below 1.
    pub fn is_valid(self) -> bool {
        let least = if matches!(self, Self::Energy(_)) { 1e-12 } else { 1e-6 };
        (least..1.0).contains(&self.threshold())
    }

    /// Returns the error of one restored indicatrix in the measure of the criterion; 0 if τ is 0. `weights`: projected
    /// solid angles of the cells \[sr\]; `given` and `back`: original and restored luminance coefficients \[1/sr\].
    pub fn error(self, weights: &[f64], given: &[f64], back: &[f64]) -> f64 {
        match self {
            Self::Misplaced(_) => {
                let tau: f64 = weights.iter().zip(given).map(|(w, f)| w * f).sum();
                let moved: f64 = weights.iter().zip(given.iter().zip(back)).map(|(w, (f, b))| w * (f - b).abs()).sum();
                if tau > 0.0 { 0.5 * moved / tau } else { 0.0 }
            }
            Self::Rms(_) | Self::Energy(_) => {
                let all: f64 = weights.iter().zip(given).map(|(w, f)| w * f * f).sum();
                let off: f64 =
                    weights.iter().zip(given.iter().zip(back)).map(|(w, (f, b))| w * (f - b) * (f - b)).sum();
                let energy = if all > 0.0 { off / all } else { 0.0 };
                if matches!(self, Self::Energy(_)) { energy } else { energy.sqrt() }
            }
        }
    }
}

/// Quantised wavelet coefficients of one indicatrix.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantisedRow {
    /// Transmittance τ = ∫f cosθ dω of the indicatrix, not quantised.
    pub tau: f64,
    /// Quantisation step in sixteenths of an octave: 16 · log₂ of the step.
    pub step: i16,
    /// Quantised level of each coefficient, in steps; the first, which represents τ, is 0.
    pub levels: Vec<i32>,
}

/// Number of quantisation steps per octave. Chosen: a step is at most 2^(1/16) = 1.04 times finer than needed. Part of
/// the file format.
const STEPS: f64 = 16.0;
/// Minimum magnitude of a coefficient that is not dropped, in steps. It is above one half because a coefficient just
/// above one half needs more bits than it saves error. Chosen: size only; the error is checked afterwards in any case.
const DEAD_ZONE: f64 = 0.62;
/// Maximum magnitude of a coefficient in steps: 2²⁴, the largest that the decoder accepts.
const LARGEST: f64 = 16_777_216.0;

/// Returns the quantisation step for a number of sixteenths of an octave.
pub(crate) fn step_of(number: i16) -> f64 {
    (f64::from(number) / STEPS).exp2()
}

/// Returns the factors (W/W_all)^−β of the quantisation steps of all coefficients, with the support W of a wavelet and
/// β = `exponent`. With β = 0 all coefficients have the same error, which is best for a square norm; misplaced flux
/// tolerates large errors on small areas.
pub(crate) fn step_factors(transform: &Transform, exponent: f64) -> Vec<f64> {
    let all = transform.weight();
    transform.supports().into_iter().map(|support| (support / all).powf(-exponent)).collect()
}

impl QuantisedRow {
    /// Creates the quantised row by rounding coefficients to whole steps.
    pub(crate) fn new(tau: f64, coefficients: &[f64], factors: &[f64], step: i16) -> Self {
        let unit = step_of(step);
        let level = |(c, factor): (&f64, &f64)| {
            let x = c / (unit * factor);
            let magnitude = if x.abs() < DEAD_ZONE { 0.0 } else { x.abs().round().clamp(1.0, LARGEST) };
            magnitude.copysign(x) as i32
        };
        let mut levels: Vec<i32> = coefficients.iter().zip(factors).map(level).collect();
        levels[0] = 0;
        Self { tau, step, levels }
    }

    /// Returns the number of stored numbers: levels that are not 0, and τ if it is not 0.
    pub fn count(&self) -> usize {
        usize::from(self.tau != 0.0) + self.levels.iter().filter(|level| **level != 0).count()
    }

    /// Returns the wavelet coefficients, rescaled from whole steps.
    pub(crate) fn coefficients(&self, transform: &Transform, factors: &[f64]) -> Vec<f64> {
        let unit = step_of(self.step);
        let mut out: Vec<f64> =
            self.levels.iter().zip(factors).map(|(&level, factor)| f64::from(level) * unit * factor).collect();
        out[0] = self.tau / transform.weight().sqrt();
        out
    }

    /// Returns the restored luminance coefficients, not negative and with τ to rounding \[1/sr\], and the share of
    /// cells that were negative before clamping to 0.
    pub(crate) fn restore(&self, transform: &Transform, factors: &[f64], weights: &[f64]) -> (Vec<f64>, f64) {
        if self.tau <= 0.0 {
            return (vec![0.0; transform.len()], 0.0);
        }
        let mut values = transform.inverse(&self.coefficients(transform, factors));
        let mut negative = 0;
        let mut flux = 0.0;
        for (value, weight) in values.iter_mut().zip(weights) {
            if *value < 0.0 {
                *value = 0.0;
                negative += 1;
            }
            flux += weight * *value;
        }
        let scale = self.tau / flux;
        if scale.is_finite() && scale > 0.0 {
            values.iter_mut().for_each(|value| *value *= scale);
        } else {
            // Only for damaged coefficients, so large that τ is lost in their rounding.
            values.fill(self.tau / transform.weight());
        }
        (values, f64::from(negative) / transform.len() as f64)
    }
}

/// Returns the coarsest quantisation of an indicatrix that meets the criterion; an indicatrix with τ = 0 has no
/// coefficients.
pub(crate) fn quantise(
    transform: &Transform,
    factors: &[f64],
    weights: &[f64],
    given: &[f64],
    criterion: Criterion,
) -> QuantisedRow {
    let tau: f64 = weights.iter().zip(given).map(|(w, f)| w * f).sum();
    let coefficients = transform.forward(given);
    let largest = coefficients[1..].iter().zip(&factors[1..]).map(|(c, f)| c.abs() / f).fold(0.0, f64::max);
    if tau <= 0.0 || largest <= 0.0 {
        return QuantisedRow { tau, step: 0, levels: vec![0; given.len()] };
    }
    let fits = |step: i16| {
        let row = QuantisedRow::new(tau, &coefficients, factors, step);
        let (back, _) = row.restore(transform, factors, weights);
        (criterion.error(weights, given, &back) <= criterion.threshold()).then_some(row)
    };
    // From the step that drops all coefficients to the finest step whose levels fit in 24 bits.
    let top = ((2.0 * largest).log2() * STEPS).ceil().clamp(-2800.0, 3200.0) as i16;
    let floor = top - 23 * STEPS as i16;
    let (mut low, mut high) = (floor, top);
    let mut best = None;
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        match fits(middle) {
            Some(row) => (low, best) = (middle, Some(row)),
            None => high = middle,
        }
    }
    best.unwrap_or_else(|| QuantisedRow::new(tau, &coefficients, factors, floor))
}
