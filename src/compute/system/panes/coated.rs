//! Coated panes, described by the values of a data sheet at normal incidence.
//!
//! The angle dependence is that of the program WINDOW 4 (Finlayson, Arasteh, Huizenga, Rubin, Reilly: WINDOW 4.0:
//! Documentation of Calculation Procedures, LBL-33943, 1993; the same fits serve in EnergyPlus and in Radiance's
//! `glazing.cal`): panes with τ(0) > 0.645 follow an uncoated clear pane, the others an uncoated bronze one,
//!
//! τ(θ) = τ(0) τ̂(cosθ),  ρ(θ) = ρ(0) (1 − ρ̂(cosθ)) + ρ̂(cosθ),  ρ̂ = s(cosθ) − τ̂(cosθ),
//!
//! τ̂ and s are polynomials of fourth degree. As printed they miss 1 at normal incidence by up to 0.5 %; here each is
//! divided by its value there, so that the values of the data sheet are met exactly. Data sheets do not state the
//! polarisation: both polarisations are assumed to have the same values and to be preserved.

use super::glazing::{Pane, Share, behind};

/// Coated pane, described by the values of its data sheet at normal incidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoatedPane {
    /// Transmittance at normal incidence, 0 … 1.
    pub transmittance: f64,
    /// Reflectance at normal incidence for light from outside, 0 … 1.
    pub front: f64,
    /// Reflectance at normal incidence for light from inside, 0 … 1.
    pub back: f64,
}

/// Pane of a glazing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Layer {
    /// Uncoated pane described by its material and thickness.
    Clear(Pane),
    /// Coated pane described by its data sheet.
    Coated(CoatedPane),
}

/// Coefficients of cos⁰θ … cos⁴θ for clear panes: of the normalised transmittance τ̂, and of s, the sum of normalised
/// transmittance and reflectance. Source: LBNL report LBL-33943 (WINDOW 4).
const CLEAR: [[f64; 5]; 2] = [[-0.0015, 3.355, -3.840, 1.460, 0.0288], [0.999, -0.563, 2.043, -2.532, 1.054]];
/// Coefficients of cos⁰θ … cos⁴θ for bronze panes, in the order of [`CLEAR`]. Source: report LBL-33943 (WINDOW 4).
const BRONZE: [[f64; 5]; 2] = [[-0.002, 2.813, -2.341, -0.05725, 0.599], [0.997, -1.868, 6.513, -7.862, 3.225]];
/// Transmittance at normal incidence up to which a pane has the angle dependence of the bronze one. Source: report
/// LBL-33943 (WINDOW 4).
const BRONZE_UP_TO: f64 = 0.645;

/// Returns the polynomial of the given coefficients at `x` (the cosine of the angle), divided by its value at 1 and
/// limited to 0 … 1.
fn normalised(coefficients: &[f64; 5], x: f64) -> f64 {
    let at = |x: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
    (at(x) / at(1.0)).clamp(0.0, 1.0)
}

impl CoatedPane {
    /// Returns transmittance and reflectances of the pane at a polar angle of incidence. \[rad\]
    pub fn shares(&self, theta: f64) -> Share {
        let cos = theta.cos().clamp(0.0, 1.0);
        let [transmittance, sum] = if self.transmittance > BRONZE_UP_TO { &CLEAR } else { &BRONZE };
        let through = normalised(transmittance, cos);
        let returned = normalised(sum, cos) - through;
        let reflected = |normal: f64| (normal * (1.0 - returned) + returned).max(0.0);
        Share {
            transmitted: self.transmittance * through,
            reflected_front: reflected(self.front),
            reflected_back: reflected(self.back),
        }
    }
}

/// Returns transmittance and reflectances of panes one behind the other (outside first) with air between, for
/// unpolarised light at a polar angle of incidence \[rad\]. Each polarisation is followed through all panes separately.
pub fn stack(layers: &[Layer], theta: f64) -> Share {
    let open = Share { transmitted: 1.0, reflected_front: 0.0, reflected_back: 0.0 };
    let one = |polarisation: usize| {
        layers.iter().fold(open, |outer, layer| {
            let inner = match layer {
                Layer::Clear(pane) => pane.polarised(theta)[polarisation],
                Layer::Coated(pane) => pane.shares(theta),
            };
            behind(outer, inner)
        })
    };
    let (s, p) = (one(0), one(1));
    Share {
        transmitted: 0.5 * (s.transmitted + p.transmitted),
        reflected_front: 0.5 * (s.reflected_front + p.reflected_front),
        reflected_back: 0.5 * (s.reflected_back + p.reflected_back),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::system::panes::glazing::stack as clear_stack;

    fn coated(transmittance: f64, front: f64, back: f64) -> CoatedPane {
        CoatedPane { transmittance, front, back }
    }

    #[test]
    fn the_data_sheet_at_normal_incidence() {
        for (t, f, b) in [(0.78, 0.12, 0.13), (0.30, 0.45, 0.10), (0.0, 0.9, 0.2), (0.645, 0.355, 0.0)] {
            let shares = coated(t, f, b).shares(0.0);
            assert!((shares.transmitted - t).abs() < 1e-15, "{shares:?}");
            assert!((shares.reflected_front - f).abs() < 1e-15 && (shares.reflected_back - b).abs() < 1e-15);
        }
    }

    #[test]
    fn no_angle_gains_light() {
        for k in 0..=900 {
            let theta = (0.1 * f64::from(k)).to_radians();
            for t in [0.0, 0.2, 0.5, 0.645, 0.7, 1.0] {
                let s = coated(t, 1.0 - t, 0.0).shares(theta);
                for r in [s.reflected_front, s.reflected_back] {
                    assert!(s.transmitted >= 0.0 && r >= 0.0 && s.transmitted + r <= 1.0 + 1e-12, "{theta} {t} {s:?}");
                }
            }
        }
    }

    #[test]
    fn printed_values_of_the_fits() {
        // The polynomials by hand at 60°: cos = ½.
        let clear: f64 = -0.0015 + 3.355 / 2.0 - 3.840 / 4.0 + 1.460 / 8.0 + 0.0288 / 16.0;
        let found = coated(0.8, 0.1, 0.1).shares(60_f64.to_radians());
        assert!((found.transmitted - 0.8 * clear / 1.0023).abs() < 1e-12);
        let bronze: f64 = -0.002 + 2.813 / 2.0 - 2.341 / 4.0 - 0.05725 / 8.0 + 0.599 / 16.0;
        let found = coated(0.4, 0.1, 0.1).shares(60_f64.to_radians());
        assert!((found.transmitted - 0.4 * bronze / 1.01175).abs() < 1e-12);
    }

    #[test]
    fn the_clear_fit_is_near_fresnel() {
        // The fit is of real clear glass, which absorbs a little.
        let pane = Pane { index: 1.52, thickness: 0.003, absorption: 10.0 };
        let normal = clear_stack(&[pane], 0.0);
        let coating = coated(normal.transmitted, normal.reflected_front, normal.reflected_back);
        for degrees in 0..=85 {
            let theta = f64::from(degrees).to_radians();
            let (fit, exact) = (coating.shares(theta), clear_stack(&[pane], theta));
            assert!((fit.transmitted - exact.transmitted).abs() < 0.025, "{degrees}° {fit:?} {exact:?}");
            assert!((fit.reflected_front - exact.reflected_front).abs() < 0.03, "{degrees}° {fit:?} {exact:?}");
        }
    }

    #[test]
    fn stacks_of_clear_panes_are_those_of_the_closed_form() {
        let pane = Pane { index: 1.52, thickness: 0.004, absorption: 10.0 };
        for theta in [0.0, 0.5, 1.0, 1.4] {
            let (a, b) = (stack(&[Layer::Clear(pane); 2], theta), clear_stack(&[pane; 2], theta));
            assert!(
                (a.transmitted - b.transmitted).abs() < 1e-15 && (a.reflected_front - b.reflected_front).abs() < 1e-15
            );
        }
        // A coating on the inner pane, seen from both sides: turned round, the reflectances change places.
        let (coating, turned) = (coated(0.6, 0.3, 0.2), coated(0.6, 0.2, 0.3));
        let there = stack(&[Layer::Clear(pane), Layer::Coated(coating)], 0.8);
        let back = stack(&[Layer::Coated(turned), Layer::Clear(pane)], 0.8);
        assert!((there.transmitted - back.transmitted).abs() < 1e-15);
        assert!((there.reflected_front - back.reflected_back).abs() < 1e-15);
    }
}
