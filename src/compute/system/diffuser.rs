//! Diffusers: opal volumes behind smooth surfaces, and sheets that spread light in a lobe about its direction.
//!
//! Reciprocity forbids a Lambertian emission whose transmittance depends on incidence. An opal sheet with smooth
//! surfaces lets light in and out through the same kind of surface, so that
//! q = t F(θ_e) F(θ_a) / (π F̄), F the share that one surface lets through and F̄ its hemispherical mean.

use super::glazing::fresnel;
use super::{cell_mean, front_basis, sub_directions};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{AngularTransmittance, Band, Btdf, CellMatrix, Scattered};
use crate::compute::direction::{Dir, Facade};
use std::f64::consts::PI;

/// A scattering volume between two smooth surfaces. The same from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opal {
    /// Refractive index of the surfaces.
    pub index: f64,
    /// Directional-hemispherical transmittance at normal incidence.
    pub transmittance: f64,
    /// Diffuse reflectance at normal incidence, without the mirror image of the surface.
    pub reflectance: f64,
}

/// A sheet that keeps, spreads and diffuses shares of the light. The same from both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spreading {
    /// Refractive index of the sheet.
    pub index: f64,
    /// Share of the transmitted light that keeps its direction.
    pub regular: f64,
    /// Share that leaves in a lobe about the regular direction; the rest leaves diffusely.
    pub lobe: f64,
    /// Standard deviation of the lobe along either direction cosine (near the normal: the angle). \[rad\]
    pub spread: f64,
    /// Transmittance at normal incidence; τ(θ) follows the clear sheet of the index.
    pub transmittance: f64,
    /// Share of what is not transmitted that is absorbed; the rest is thrown back diffusely or mirrored.
    pub absorbed: f64,
}

/// Share of unpolarised light that one surface lets through.
fn surface_transmittance(index: f64, theta: f64) -> f64 {
    let ([s, p], _) = fresnel(index, theta);
    1.0 - 0.5 * (s + p)
}

/// Half-degree table of a function of θ.
fn table(f: impl Fn(f64) -> f64) -> AngularTransmittance {
    AngularTransmittance::sample(180, f)
}

/// The reciprocal matrix with q(i, o) ∝ kernel(i, o) whose rows carry exactly `tau`: q = d_i K_io d_o, the factors d
/// found by Sinkhorn's iteration in its symmetric form. `kernel` symmetric, not negative, its diagonal positive.
fn balanced(basis: &RingBasis, kernel: &[f64], tau: &[f64]) -> CellMatrix {
    let n = basis.len();
    let weight = basis.projected_solid_angles();
    let mut factor: Vec<f64> = vec![1.0; n];
    for _ in 0..500 {
        let mut worst: f64 = 0.0;
        let flux: Vec<f64> = kernel
            .chunks_exact(n)
            .zip(&factor)
            .map(|(row, d)| d * row.iter().zip(&factor).zip(&weight).map(|((k, e), w)| k * e * w).sum::<f64>())
            .collect();
        for ((d, flux), tau) in factor.iter_mut().zip(&flux).zip(tau) {
            worst = worst.max((flux - tau).abs());
            *d *= if *flux > 0.0 { (tau / flux).sqrt() } else { 0.0 };
        }
        if worst < 1e-13 {
            break;
        }
    }
    let values = (0..n * n).map(|k| factor[k / n] * kernel[k] * factor[k % n]).collect();
    CellMatrix::new(basis.clone(), basis.clone(), values).expect("n² values for n cells")
}

/// The separable diffuse matrix with rows of the given τ: q = τ_i τ_o / Σ τ PΩ, reciprocal by its form.
fn separable(basis: &RingBasis, tau: &[f64]) -> CellMatrix {
    let total: f64 = basis.projected_solid_angles().iter().zip(tau).map(|(w, t)| w * t).sum();
    let scale = if total > 0.0 { 1.0 / total } else { 0.0 };
    let n = basis.len();
    let values = (0..n * n).map(|k| tau[k / n] * tau[k % n] * scale).collect();
    CellMatrix::new(basis.clone(), basis.clone(), values).expect("n² values for n cells")
}

/// The same band from both sides: transmission turned round, reflection as it is.
fn both_sides(transmission: Btdf, reflection: Btdf) -> Band {
    Band {
        transmission_front: Some(transmission.clone()),
        transmission_back: Some(transmission),
        reflection_front: Some(reflection.clone()),
        reflection_back: Some(reflection),
    }
}

/// Means of a function of θ over the cells.
fn ring_means(basis: &RingBasis, f: impl Fn(f64) -> f64) -> Vec<f64> {
    basis.cells().map(|cell| cell_mean(&cell, 12, |d: Dir<Facade>| f(d.theta()))).collect()
}

impl Opal {
    /// Shares of the light that has entered: passed on, and thrown back by the volume. `None` when the parameters are not
    /// those of a passive sheet.
    pub fn shares(&self) -> Option<(f64, f64)> {
        let enters = surface_transmittance(self.index, 0.0);
        let (passed, returned) = (self.transmittance / enters, self.reflectance / enters);
        let sane = self.index >= 1.0 && passed >= 0.0 && returned >= 0.0 && passed + returned <= 1.0;
        sane.then_some((passed, returned))
    }

    /// The four functions, or `None` when the parameters are not those of a passive sheet.
    pub fn band(&self) -> Option<Band> {
        let (passed, returned) = self.shares()?;
        let basis = front_basis();
        let surface = ring_means(&basis, |theta| surface_transmittance(self.index, theta));
        let scaled = |share: f64| {
            let tau: Vec<f64> = surface.iter().map(|f| share * f).collect();
            Some(Scattered::Cells(Box::new(separable(&basis, &tau))))
        };
        let mirrored = table(|theta| 1.0 - surface_transmittance(self.index, theta));
        Some(both_sides(
            Btdf { regular: None, scattered: scaled(passed) },
            Btdf { regular: Some(mirrored), scattered: scaled(returned) },
        ))
    }
}

impl Spreading {
    /// Transmittance of the clear sheet of the index at a polar angle. \[rad\]
    pub fn clear(&self, theta: f64) -> f64 {
        let pane = super::glazing::Pane { index: self.index, thickness: 0.0, absorption: 0.0 };
        super::glazing::stack(&[pane], theta).transmitted
    }

    /// Transmittance over that of the clear sheet. `None` when the parameters are not those of a passive sheet.
    pub fn scale(&self) -> Option<f64> {
        let scale = self.transmittance / self.clear(0.0);
        let shares = [self.regular, self.lobe, 1.0 - self.regular - self.lobe, self.absorbed];
        let sane = shares.iter().all(|share| (-1e-12..=1.0).contains(share)) && (0.0..=1.0).contains(&scale);
        (sane && self.index >= 1.0 && self.spread > 0.01).then_some(scale)
    }

    /// The four functions, or `None` when the parameters are not those of a passive sheet.
    pub fn band(&self) -> Option<Band> {
        let haze = 1.0 - self.regular - self.lobe;
        let scale = self.scale()?;
        let clear = |theta: f64| self.clear(theta);
        let basis = front_basis();
        let tau = ring_means(&basis, |theta| scale * clear(theta));
        let lobe_tau: Vec<f64> = tau.iter().map(|t| self.lobe * t).collect();
        let haze_tau: Vec<f64> = tau.iter().map(|t| haze.max(0.0) * t).collect();
        let lobe = balanced(&basis, &gaussian_kernel(&basis, self.spread), &lobe_tau);
        let diffuse = separable(&basis, &haze_tau);
        let values = lobe.values().iter().zip(diffuse.values().iter()).map(|(a, b)| a + b).collect();
        let matrix = CellMatrix::new(basis.clone(), basis.clone(), values).expect("n² values for n cells");
        let regular = if self.regular > 0.0 { Some(table(|theta| self.regular * scale * clear(theta))) } else { None };
        // What a clear sheet mirrors stays mirrored; the rest of what does not pass is absorbed or thrown back.
        let mirrored = table(|theta| (1.0 - clear(theta)) * (1.0 - self.absorbed));
        let back = ring_means(&basis, |theta| (1.0 - scale) * clear(theta) * (1.0 - self.absorbed));
        Some(both_sides(
            Btdf { regular, scattered: Some(Scattered::Cells(Box::new(matrix))) },
            Btdf { regular: Some(mirrored), scattered: Some(Scattered::Cells(Box::new(separable(&basis, &back)))) },
        ))
    }
}

/// exp(−|k_i − k_o|²/2σ²) in direction cosines, averaged over both cells. Spread is a shift of direction cosines,
/// as at every plane-parallel layer, and therefore symmetric in the two directions.
fn gaussian_kernel(basis: &RingBasis, spread: f64) -> Vec<f64> {
    const SUB: usize = 3;
    let points: Vec<Vec<[f64; 2]>> =
        basis.cells().map(|cell| sub_directions(&cell, SUB).map(|d| [d.vector().x, d.vector().y]).collect()).collect();
    let n = basis.len();
    let exponent = -0.5 / (spread * spread);
    let mut kernel = vec![0.0; n * n];
    for i in 0..n {
        for o in i..n {
            let mut sum = 0.0;
            for a in &points[i] {
                for b in &points[o] {
                    let square = (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
                    // e⁻⁴⁰ of a lobe is below every other error.
                    let power = exponent * square;
                    if power > -40.0 {
                        sum += power.exp();
                    }
                }
            }
            let mean = sum / (SUB * SUB * SUB * SUB) as f64;
            kernel[i * n + o] = mean;
            kernel[o * n + i] = mean;
        }
    }
    kernel
}

/// Lambertian in transmission and reflection for every incidence: the ideal diffuser with a stated reflectance.
pub fn lambertian(transmittance: f64, reflectance: f64) -> Band {
    both_sides(Btdf::ideal_diffuse(transmittance), Btdf::ideal_diffuse(reflectance))
}

/// Hemispherical mean of F by the closed basis, for tests and descriptions: F̄ = 2∫F sinθ cosθ dθ.
pub fn surface_mean(index: f64) -> f64 {
    let basis = front_basis();
    let f = ring_means(&basis, |theta| surface_transmittance(index, theta));
    basis.projected_solid_angles().iter().zip(&f).map(|(w, f)| w * f).sum::<f64>() / PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::reciprocity_error;
    use crate::compute::direction::Incident;

    fn check(band: &Band) {
        let [t, r] = [&band.transmission_front, &band.reflection_front].map(|b| b.as_ref().unwrap());
        assert!(reciprocity_error(t, band.transmission_back.as_ref().unwrap()).unwrap() < 1e-12);
        assert!(reciprocity_error(r, r).unwrap() < 1e-12);
        for k in 0..90 {
            let light = Incident(Dir::from_theta_phi(f64::from(k).to_radians(), 0.3));
            // Regular parts are pointwise, cells are means: they meet within a cell's own variation.
            assert!(t.tau(light) + r.tau(light) <= 1.06 || k > 74, "{k}°");
        }
        assert!(t.tau_hemispherical() + r.tau_hemispherical() <= 1.0 + 1e-4);
    }

    #[test]
    fn internal_diffuse_reflection_of_a_surface_is_the_known_one() {
        // External diffuse reflectance of a surface, n = 1.5 (Duntley 1942; Judd 1942): 0.0919.
        assert!((1.0 - surface_mean(1.5) - 0.0919).abs() < 3e-3, "{}", 1.0 - surface_mean(1.5));
    }

    #[test]
    fn opal_keeps_energy_and_its_transmittance() {
        let band = Opal { index: 1.49, transmittance: 0.5, reflectance: 0.35 }.band().unwrap();
        check(&band);
        assert!((band.transmission_front.unwrap().tau_normal() - 0.5).abs() < 1e-4);
        assert!(Opal { index: 1.49, transmittance: 0.7, reflectance: 0.35 }.band().is_none());
    }

    #[test]
    fn spreading_sheet_keeps_its_transmittance_and_is_brightest_straight_on() {
        let sheet = Spreading {
            index: 1.49,
            regular: 0.1,
            lobe: 0.6,
            spread: 12_f64.to_radians(),
            transmittance: 0.8,
            absorbed: 0.2,
        };
        let band = sheet.band().unwrap();
        check(&band);
        let t = band.transmission_front.unwrap();
        assert!((t.tau_normal() - 0.8).abs() < 1e-4, "{}", t.tau_normal());
        let Some(Scattered::Cells(m)) = &t.scattered else { panic!() };
        // Rows carry 0.9 of the clear sheet's τ(θ), scaled.
        for (cell, tau) in m.incident().cells().zip(m.tau_by_cell()) {
            let clear = |d: Dir<Facade>| {
                let pane = super::super::glazing::Pane { index: 1.49, thickness: 0.0, absorption: 0.0 };
                super::super::glazing::stack(&[pane], d.theta()).transmitted
            };
            let expected = 0.9 * 0.8 * cell_mean(&cell, 40, clear) / clear(Dir::from_theta_phi(0.0, 0.0));
            assert!((tau - expected).abs() < 2e-3, "{tau} {expected}");
        }
        for (i, cell) in m.incident().cells().enumerate().filter(|(_, cell)| cell.theta() < 1.0) {
            let brightest = (0..m.emergent().len()).max_by(|&a, &b| m.row(i)[a].total_cmp(&m.row(i)[b])).unwrap();
            let to = m.emergent().cell(brightest).centre();
            assert!(to.dot(cell.centre()) > 20_f64.to_radians().cos(), "{i}");
        }
    }

    #[test]
    fn the_lobe_has_the_spread_asked_for() {
        let basis = front_basis();
        let sigma = 15_f64.to_radians();
        let m = balanced(&basis, &gaussian_kernel(&basis, sigma), &vec![1.0; basis.len()]);
        let (mut second, mut flux) = (0.0, 0.0);
        for (o, cell) in basis.cells().enumerate() {
            let share = m.row(0)[o] * cell.projected_solid_angle();
            second += share * cell_mean(&cell, 8, |d| d.vector().truncate().length_squared());
            flux += share;
        }
        assert!((flux - 1.0).abs() < 1e-12);
        // ⟨u² + v²⟩ = 2σ², widened by the cells and cut at the edge of the hemisphere.
        let found = (second / 2.0).sqrt();
        assert!((found / sigma - 1.0).abs() < 0.08, "{}", found.to_degrees());
    }
}
