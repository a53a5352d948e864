//! Compression ratio and errors of the wavelet compression of a dataset.

use super::compact::CompactRows;
use super::quantise::Criterion;

/// Compression ratio and errors of the wavelet compression of all indicatrices f of one BTDF or BRDF, restored as f̃.
/// Those with τ = 0 are restored exactly and are left out of means.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CompactReport {
    /// Number of indicatrices.
    pub rows: usize,
    /// Number of emergent cells of each indicatrix.
    pub cells: usize,
    /// Total number of stored numbers: wavelet coefficients that are not 0, and one τ per indicatrix.
    pub numbers: usize,
    /// Relative rms error √(∫(f̃ − f)² / ∫f²) over all indicatrices together.
    pub rms: f64,
    /// Relative rms error √(∫(f̃ − f)² / ∫f²) of the worst indicatrix.
    pub rms_worst: f64,
    /// Largest |f̃ − f| of any cell, relative to the largest f of its indicatrix.
    pub largest: f64,
    /// Share of the flux in wrong directions, ½∫|f̃ − f| cosθ dω / τ, mean over the indicatrices.
    pub misplaced: f64,
    /// Share of the flux in wrong directions, ½∫|f̃ − f| cosθ dω / τ, of the worst indicatrix.
    pub misplaced_worst: f64,
    /// Largest relative error |τ̃ − τ| / τ of the transmittance of any indicatrix.
    pub tau_error: f64,
    /// Share of cells that were negative before clamping to 0, mean over the indicatrices.
    pub negative: f64,
}

impl CompactReport {
    /// Compares compressed indicatrices with their originals. `row`: returns the luminance coefficients of an original
    /// by index \[1/sr\].
    pub fn new(compact: &CompactRows, row: impl Fn(usize) -> Vec<f64>) -> Self {
        let weights = compact.basis().projected_solid_angles();
        let mut report =
            Self { rows: compact.len(), cells: weights.len(), numbers: compact.numbers(), ..Self::default() };
        let (mut off, mut all, mut lit) = (0.0, 0.0, 0.0_f64);
        for index in 0..compact.len() {
            let given = row(index);
            let (back, negative) = compact.restored(index);
            let sum = |f: &dyn Fn(usize) -> f64| weights.iter().enumerate().map(|(k, w)| w * f(k)).sum::<f64>();
            let (tau, tau_back) = (sum(&|k| given[k]), sum(&|k| back[k]));
            // Dark rows are restored exactly and have no relative error.
            if tau <= 0.0 {
                continue;
            }
            lit += 1.0;
            // Squares are summed over all rows before the division, so that bright rows count more.
            off += sum(&|k| (back[k] - given[k]).powi(2));
            all += sum(&|k| given[k].powi(2));
            // Only the criterion's measure of error is used, not its threshold.
            let misplaced = Criterion::ARCHIVE.error(&weights, &given, &back);
            report.misplaced += misplaced;
            report.misplaced_worst = report.misplaced_worst.max(misplaced);
            report.rms_worst = report.rms_worst.max(Criterion::Rms(1e-2).error(&weights, &given, &back));
            let peak = given.iter().copied().fold(0.0, f64::max);
            let largest = given.iter().zip(&back).map(|(g, b)| (g - b).abs()).fold(0.0, f64::max);
            report.largest = report.largest.max(largest / peak);
            report.tau_error = report.tau_error.max((tau_back - tau).abs() / tau);
            report.negative += negative;
        }
        // Without any row with light, all errors are 0.
        report.rms = if all > 0.0 { (off / all).sqrt() } else { 0.0 };
        report.misplaced /= lit.max(1.0);
        report.negative /= lit.max(1.0);
        report
    }

    /// Returns the compression ratio: original values per stored number.
    pub fn ratio(&self) -> f64 {
        (self.rows * self.cells) as f64 / self.numbers.max(1) as f64
    }
}
