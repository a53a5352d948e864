//! Plane sheets without a direction of their own: what they pass and throw back depends on θ_e, θ_a and the azimuth
//! between the two. Mirrored and straight light, diffuse light, and a lobe about the straight direction.
//!
//! Diffuse light is separable, q = τ(θ_e) τ(θ_a)/(π τ̄), the one reciprocal form whose total is τ(θ_e). The lobe is a
//! Gaussian in direction cosines k, q = d(θ_e) exp(−|k_e − k_a|²/2σ²) d(θ_a): every plane-parallel layer shifts
//! direction cosines, so that the kernel is symmetric in both directions; d is found such that the total is the τ(θ_e)
//! asked for (Sinkhorn's iteration in its symmetric form).

use crate::compute::basis::{Cell, RingBasis, sub_directions};
use crate::compute::btdf::{AngularTransmittance, Band, Btdf, CellMatrix, Scattered, matrix_on};
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::quadrature::midpoints;
use crate::compute::scaling::by_rounds;
use crate::compute::system::measure::{Measured, Quality, Setting, Side, Specimen};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Where the light of one incidence goes.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Straight on, or mirrored.
    pub regular: AngularTransmittance,
    /// Diffuse, separable.
    pub diffuse: AngularTransmittance,
    /// In a lobe about the regular direction, with its standard deviation along either direction cosine.
    pub lobe: Option<(AngularTransmittance, f64)>,
}

/// A sheet: transmission is the same from both sides, reflection may differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Transmission.
    pub transmission: Spread,
    /// Reflection of light from outside and from inside.
    pub reflection: [Spread; 2],
}

impl Spread {
    /// Diffuse light alone, the same share for every incidence.
    pub const fn lambertian(share: f64) -> Self {
        Self {
            regular: AngularTransmittance::Constant(0.0),
            diffuse: AngularTransmittance::Constant(share),
            lobe: None,
        }
    }
}

impl Specimen for Sheet {
    fn measure(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<Measured, Cancelled> {
        let mut measured = Measured::dark(setting);
        let (through, through_error) = self.transmission.on(setting, progress)?;
        for (side, reflection) in Side::BOTH.into_iter().zip(&self.reflection) {
            let (reflected, error) = reflection.on(setting, progress)?;
            let (t, r) = (measured.shares(&through), measured.shares(&reflected));
            let seen = measured.seen_mut(side);
            seen.absorbed = t.iter().zip(&r).map(|(t, r)| (1.0 - t - r).max(0.0)).collect();
            seen.error = error.iter().zip(&through_error).map(|(a, b)| a.max(*b)).collect();
            (seen.transmitted, seen.reflected) = (through.clone(), reflected);
        }
        Ok(measured)
    }

    fn examine(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<(Band, Quality), Cancelled> {
        let quality = self.measure(setting, progress)?.quality();
        let apart = |spread: &Spread| -> Result<Btdf, Cancelled> {
            let nothing = AngularTransmittance::Constant(0.0);
            let scattered = Spread { regular: nothing, ..spread.clone() };
            let matrix = if scattered.is_dark() {
                None
            } else {
                let values = scattered.on(setting, progress)?.0;
                let matrix = CellMatrix::new(setting.incident.clone(), setting.emergent.clone(), values);
                Some(Scattered::Cells(Box::new(matrix.expect("values are counted by these cells"))))
            };
            let regular = (spread.regular.hemispherical() > 0.0).then(|| spread.regular.clone());
            Ok(Btdf { regular, scattered: matrix })
        };
        let through = apart(&self.transmission)?;
        let band = Band {
            transmission_front: Some(through.clone()),
            transmission_back: Some(through),
            reflection_front: Some(apart(&self.reflection[0])?),
            reflection_back: Some(apart(&self.reflection[1])?),
        };
        Ok((band, quality))
    }
}

/// Angles across a ring over which functions of θ are averaged.
const RING: usize = 128;

/// Means over the cells of a function of θ.
fn ring_means(basis: &RingBasis, share: &AngularTransmittance) -> Vec<f64> {
    let rule = midpoints(RING);
    basis.cells().map(|cell| share.ring_mean(cell.theta_min, cell.theta_max, &rule)).collect()
}

impl Spread {
    /// Scatters nothing?
    fn is_dark(&self) -> bool {
        self.diffuse.hemispherical() == 0.0 && self.lobe.is_none()
    }

    /// Values on the cells, and the error of every incident cell's total.
    fn on(&self, setting: &Setting<'_>, progress: &dyn Progress) -> Result<(Vec<f64>, Vec<f64>), Cancelled> {
        let (incident, emergent) = (setting.incident, setting.emergent);
        let straight = Btdf { regular: Some(self.regular.clone()), scattered: None };
        let mut values = matrix_on(&straight, incident, emergent).values().into_owned();
        if self.diffuse.hemispherical() > 0.0 {
            let (from, to) = (ring_means(incident, &self.diffuse), ring_means(emergent, &self.diffuse));
            // The mean by these very cells, so that totals come out exactly.
            let mean = emergent.projected_solid_angles().iter().zip(&to).map(|(w, t)| w * t).sum::<f64>() / PI;
            for (row, from) in values.chunks_exact_mut(emergent.len()).zip(&from) {
                for (q, to) in row.iter_mut().zip(&to) {
                    *q += from * to / (PI * mean);
                }
            }
        }
        // What the averages over rings leave open.
        let mut error = vec![1e-6; incident.len()];
        if let Some((share, spread)) = &self.lobe {
            let lobe = Lobe::new(share, *spread);
            let weight = emergent.projected_solid_angles();
            let cells: Vec<Cell> = emergent.cells().collect();
            let totals = ring_means(incident, share);
            let rows: Vec<Vec<f64>> = incident
                .cells()
                .collect::<Vec<_>>()
                .par_iter()
                .map(|from| {
                    if progress.cancelled() {
                        return Err(Cancelled);
                    }
                    let from = lobe.points(from);
                    Ok(cells.iter().map(|to| lobe.mean(&from, to)).collect())
                })
                .collect::<Result<_, Cancelled>>()?;
            // Totals as asked. On the same cells by factors of both directions, which keep reciprocity.
            let same = incident == emergent;
            let scale = if same {
                let sums = |scale: &[f64]| -> Vec<f64> {
                    let factors: Vec<f64> = scale.iter().zip(&weight).map(|(s, w)| s * w).collect();
                    rows.iter().map(|row| row.iter().zip(&factors).map(|(q, f)| q * f).sum()).collect()
                };
                let wanted: Vec<_> = totals.iter().map(|total| Some(*total)).collect();
                let scale = by_rounds(sums, &wanted, 40, 0.0, f64::INFINITY);
                let found = sums(&scale).into_iter().zip(&scale).map(|(sum, d)| d * sum);
                error.iter_mut().zip(found).zip(&totals).for_each(|((error, f), total)| *error += (f - total).abs());
                scale
            } else {
                let flux = |row: &[f64]| row.iter().zip(&weight).map(|(q, w)| q * w).sum::<f64>();
                let ratio = |(row, total): (&Vec<f64>, &f64)| if flux(row) > 0.0 { total / flux(row) } else { 0.0 };
                rows.iter().zip(&totals).map(ratio).collect()
            };
            for (i, row) in rows.iter().enumerate() {
                for (o, lobe) in row.iter().enumerate() {
                    let factor = if same { scale[i] * scale[o] } else { scale[i] };
                    values[i * emergent.len() + o] += factor * lobe;
                }
            }
        }
        Ok((values, error))
    }
}

/// The balanced Gaussian kernel.
struct Lobe {
    spread: f64,
    /// d over equal steps of sinθ, at their middles.
    factor: Vec<f64>,
}

/// exp(−x) of this and above counts as nothing.
const MOST_EXPONENT: f64 = 30.0;

impl Lobe {
    fn new(share: &AngularTransmittance, spread: f64) -> Self {
        // Half a spread a step keeps the sums over the smooth kernel exact to 1e-8.
        let n = ((2.0 / spread).ceil() as usize).clamp(100, 1000);
        let sine = |i: usize| (i as f64 + 0.5) / n as f64;
        let kernel: Vec<f64> = (0..n * n)
            .into_par_iter()
            .map(|k| {
                let (a, b) = (sine(k / n), sine(k % n));
                let exponent = 0.5 * ((a - b) / spread).powi(2);
                let around = 2.0 * PI * (-exponent).exp() * scaled_bessel(a * b / (spread * spread));
                around * b / n as f64
            })
            .collect();
        let sums = |factor: &[f64]| -> Vec<f64> {
            kernel.chunks_exact(n).map(|row| row.iter().zip(factor).map(|(k, d)| k * d).sum()).collect()
        };
        let wanted: Vec<_> = (0..n).map(|i| Some(share.at(sine(i).asin()))).collect();
        Self { spread, factor: by_rounds(sums, &wanted, 400, 1e-9, f64::INFINITY) }
    }

    fn factor(&self, sine: f64) -> f64 {
        let x = (sine * self.factor.len() as f64 - 0.5).max(0.0);
        let k = (x as usize).min(self.factor.len() - 2);
        let t = x - k as f64;
        (self.factor[k] * (1.0 - t) + self.factor[k + 1] * t).max(0.0)
    }

    /// Direction cosines and d of points that share the cell evenly, close enough for the lobe.
    fn points(&self, cell: &Cell) -> Vec<([f64; 2], f64)> {
        let high = cell.theta_max.sin() - cell.theta_min.sin();
        let wide = cell.width * cell.theta_max.sin();
        let n = ((high.max(wide) / (0.8 * self.spread)).ceil() as usize).clamp(1, 24);
        sub_directions(cell, n)
            .map(|d| {
                let k = d.vector().truncate();
                ([k.x, k.y], self.factor(k.length()))
            })
            .collect()
    }

    /// Mean of the lobe over an emergent cell for light from the given points.
    fn mean(&self, from: &[([f64; 2], f64)], to: &Cell) -> f64 {
        let exponent = |a: [f64; 2], b: [f64; 2]| {
            0.5 * ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)) / (self.spread * self.spread)
        };
        let centre = to.centre().vector().truncate();
        let middle = from[from.len() / 2].0;
        // Far cells need no points: both are smaller than their distance allows.
        let reach = (to.width * to.theta_max.sin()).max(to.theta_max.sin() - to.theta_min.sin()) + 0.25;
        if (exponent([centre.x, centre.y], middle).sqrt() - reach / self.spread).max(0.0).powi(2) > MOST_EXPONENT {
            return 0.0;
        }
        let points = self.points(to);
        let sum: f64 = from
            .iter()
            .map(|(a, d)| {
                let inner: f64 = points
                    .iter()
                    .map(|(b, e)| {
                        let x = exponent(*a, *b);
                        if x < MOST_EXPONENT { e * (-x).exp() } else { 0.0 }
                    })
                    .sum();
                d * inner
            })
            .sum();
        sum / (from.len() * points.len()) as f64
    }
}

/// e⁻ˣ I₀(x), x ≥ 0, to 2e-7 (Abramowitz and Stegun 9.8.1 and 9.8.2).
fn scaled_bessel(x: f64) -> f64 {
    let polynomial = |c: &[f64], t: f64| c.iter().rev().fold(0.0, |sum, c| sum * t + c);
    if x < 3.75 {
        let t = (x / 3.75).powi(2);
        let c = [1.0, 3.515_622_9, 3.089_942_4, 1.206_749_2, 0.265_973_2, 0.036_076_8, 0.004_581_3];
        (-x).exp() * polynomial(&c, t)
    } else {
        let c = [
            0.398_942_28,
            0.013_285_92,
            0.002_253_19,
            -0.001_575_65,
            0.009_162_81,
            -0.020_577_06,
            0.026_355_37,
            -0.016_476_33,
            0.003_923_77,
        ];
        polynomial(&c, 3.75 / x) / x.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::{AzimuthMap, cell_mean};
    use crate::compute::estimate::Silent;
    use crate::compute::system::measure::front_basis;

    #[test]
    fn bessel_at_known_places() {
        // I₀(1) = 1.2660658777520084, I₀(5) = 27.239871823604442.
        assert!((scaled_bessel(1.0) * 1_f64.exp() - 1.266_065_877_752).abs() < 1e-6);
        assert!((scaled_bessel(5.0) * 5_f64.exp() - 27.239_871_823_6).abs() < 1e-5);
    }

    fn sheet(spread: f64) -> Sheet {
        let tau =
            |share: f64| AngularTransmittance::sample(90, move |theta| share * (1.0 - (1.0 - theta.cos()).powi(5)));
        let transmission = Spread { regular: tau(0.1), diffuse: tau(0.2), lobe: Some((tau(0.5), spread)) };
        Sheet { transmission, reflection: [Spread::lambertian(0.1), Spread::lambertian(0.15)] }
    }

    #[test]
    fn totals_and_reciprocity() {
        for (spread, emergent) in [(0.02, front_basis()), (0.15, front_basis()), (0.5, RingBasis::tregenza())] {
            let incident = front_basis();
            let setting = Setting { incident: &incident, emergent: &emergent, error: 0.01, seed: 1 };
            let made = sheet(spread).measure(&setting, &Silent).unwrap();
            let tau = made.shares(&made.front.transmitted);
            for (cell, tau) in incident.cells().zip(tau) {
                // The parts are tables of degrees: a few 1e-4 at grazing incidence.
                let exact = cell_mean(&cell, 60, |d| 0.8 * (1.0 - (1.0 - d.theta().cos()).powi(5)));
                assert!((tau - exact).abs() < 6e-4, "{spread}: {tau} {exact}");
            }
            let quality = made.quality();
            assert!(quality.balance < 1e-3 && quality.error < 2e-2, "{quality:?}");
            if let Some(error) = quality.reciprocity {
                assert!(error < 4e-3, "{spread}: {error}");
            }
        }
    }

    #[test]
    fn a_fine_emergent_lattice_shows_the_gaussian() {
        let incident = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT).refined(4);
        let emergent = incident.clone();
        let spread = 0.1;
        let setting = Setting { incident: &incident, emergent: &emergent, error: 0.01, seed: 1 };
        let made = Spread {
            regular: AngularTransmittance::Constant(0.0),
            diffuse: AngularTransmittance::Constant(0.0),
            lobe: Some((AngularTransmittance::Constant(1.0), spread)),
        };
        let (values, _) = made.on(&setting, &Silent).unwrap();
        // Near the normal, d² = 1/(2πσ²), and q falls as the Gaussian does.
        let i = 0;
        for (o, cell) in emergent.cells().enumerate().take(200) {
            let apart = (cell.centre().vector().truncate() - incident.cell(i).centre().vector().truncate()).length();
            let exact = (-0.5 * (apart / spread).powi(2)).exp() / (2.0 * PI * spread * spread);
            let found = values[i * emergent.len() + o];
            // Cells beside the normal are sectors: their means are not quite the values at their centres.
            assert!((found - exact).abs() < 0.04 * 16.0, "{o}: {found} {exact}");
        }
    }
}
