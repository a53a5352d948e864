//! Transmittance (or reflectance) that depends on the polar angle of incidence θ alone.

use std::f64::consts::PI;

/// Transmittance (or reflectance) τ as a function of the polar angle of incidence θ: a constant, or a table over equal
/// steps of θ from 0 to 90°.
#[derive(Debug, Clone, PartialEq)]
pub enum AngularTransmittance {
    /// Transmittance that is the same for every angle of incidence.
    Constant(f64),
    /// Transmittances at θ = 0 … 90° in equal steps, at least two; interpolated by a piecewise cubic that does not
    /// exceed the neighbouring values.
    Table(Vec<f64>),
    /// Transmittances estimated from other data, such as means over patches, with their uncertainties; all at θ = 0, 1
    /// … 90°.
    Estimated {
        /// Transmittances, interpolated like those of a table.
        tau: Vec<f64>,
        /// Uncertainty of each single transmittance.
        uncertainty: Vec<f64>,
        /// Independent signed deviations of all transmittances, whose effects on a sum over angles add up in
        /// quadrature: too large values at some angles are correlated with too small values at others.
        modes: Vec<Vec<f64>>,
    },
}

impl AngularTransmittance {
    /// Creates a table from a function of θ \[rad\], at `steps` + 1 angles from 0 to 90°. `steps` ≥ 1.
    pub fn sample(steps: usize, tau: impl Fn(f64) -> f64) -> Self {
        Self::Table((0..=steps).map(|i| tau(0.5 * PI * i as f64 / steps as f64)).collect())
    }

    /// Returns the function with all transmittances multiplied by `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        let all = |values: &[f64]| values.iter().map(|value| factor * value).collect();
        match self {
            Self::Constant(tau) => Self::Constant(factor * tau),
            Self::Table(values) => Self::Table(all(values)),
            Self::Estimated { tau, uncertainty, modes } => {
                let modes = modes.iter().map(|mode| all(mode)).collect();
                Self::Estimated { tau: all(tau), uncertainty: all(uncertainty), modes }
            }
        }
    }

    /// Returns the transmittance if it is the same for every angle of incidence; otherwise `None`.
    pub const fn constant(&self) -> Option<f64> {
        if let Self::Constant(tau) = self { Some(*tau) } else { None }
    }

    /// Returns the uncertainty of τ at the angle of incidence `theta` \[rad\]; 0 unless τ is estimated from other data.
    pub fn uncertainty(&self, theta: f64) -> f64 {
        if let Self::Estimated { uncertainty, .. } = self { table_at(uncertainty, theta) } else { 0.0 }
    }

    /// Returns the uncertainty of the sum of transmitted light (illuminance, flux) from the incident light in each
    /// degree of θ, in the unit of `incident`.
    pub fn uncertainty_of_light(&self, incident: &[f64; 90]) -> f64 {
        let Self::Estimated { modes, .. } = self else { return 0.0 };
        let of = |mode: &Vec<f64>| {
            let at = |degree: usize| 0.5 * (mode[degree] + mode[degree + 1]);
            incident.iter().enumerate().map(|(degree, e)| e * at(degree)).sum::<f64>()
        };
        modes.iter().map(|mode| of(mode).powi(2)).sum::<f64>().sqrt()
    }

    /// Whether the transmittances are estimated from other data and have uncertainties.
    pub const fn is_estimated(&self) -> bool {
        matches!(self, Self::Estimated { .. })
    }

    /// Whether τ is 0 for every angle of incidence.
    pub fn is_dark(&self) -> bool {
        match self {
            Self::Constant(tau) => *tau == 0.0,
            Self::Table(tau) | Self::Estimated { tau, .. } => tau.iter().all(|tau| *tau == 0.0),
        }
    }

    /// Returns τ at the angle of incidence `theta` \[rad\]; 0 beyond 90°.
    pub fn at(&self, theta: f64) -> f64 {
        match self {
            Self::Constant(tau) => {
                if theta <= 0.5 * PI {
                    *tau
                } else {
                    0.0
                }
            }
            Self::Table(tau) | Self::Estimated { tau, .. } => table_at(tau, theta),
        }
    }

    /// Returns the mean τ over the angles of incidence `from` … `to` \[rad\], weighted by projected solid angle.
    /// `rule`: nodes and weights on 0 … 1 for the quadrature over sin²θ.
    pub fn ring_mean(&self, from: f64, to: f64, rule: &[(f64, f64)]) -> f64 {
        let (a, b) = (from.sin().powi(2), to.sin().powi(2));
        rule.iter().map(|(x, weight)| weight * self.at((a + (b - a) * x).sqrt().min(1.0).asin())).sum()
    }

    /// Returns the hemispherical transmittance 2 ∫ τ(θ) sinθ cosθ dθ, for light from a hemisphere of uniform luminance.
    pub fn hemispherical(&self) -> f64 {
        match self {
            Self::Constant(tau) => *tau,
            Self::Table(_) | Self::Estimated { .. } => {
                // Midpoints in sin²θ: equal weights, second order, 4000 points for 1e-7.
                let n = 4000;
                (0..n).map(|i| self.at((((i as f64) + 0.5) / n as f64).sqrt().asin())).sum::<f64>() / n as f64
            }
        }
    }
}

/// Returns equally spaced values over 0 … 90° interpolated at `theta` \[rad\] by a monotone piecewise cubic (central
/// slopes, limited after Fritsch and Carlson).
fn table_at(values: &[f64], theta: f64) -> f64 {
    let last = values.len() - 1;
    let x = theta / (0.5 * PI) * last as f64;
    if x > last as f64 {
        return if x - (last as f64) < 1e-9 { values[last] } else { 0.0 };
    }
    let i = (x.max(0.0) as usize).min(last - 1);
    let t = x.max(0.0) - i as f64;
    let chord = |k: usize| values[k + 1] - values[k];
    let slope = |k: usize| -> f64 {
        // The function is even in θ, so the slope at normal incidence is zero; one-sided at the end.
        if k == 0 {
            return 0.0;
        }
        if k == last {
            return if last > 1 { 1.5 * chord(last - 1) - 0.5 * chord(last - 2) } else { chord(0) };
        }
        let (a, b) = (chord(k - 1), chord(k));
        if a * b <= 0.0 { 0.0 } else { (0.5 * (a + b)).abs().min(3.0 * a.abs().min(b.abs())).copysign(a) }
    };
    let (y0, y1, m0, m1) = (values[i], values[i + 1], slope(i), slope(i + 1));
    let (t2, t3) = (t * t, t * t * t);
    (2.0 * t3 - 3.0 * t2 + 1.0) * y0 + (t3 - 2.0 * t2 + t) * m0 + (3.0 * t2 - 2.0 * t3) * y1 + (t3 - t2) * m1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolates_a_smooth_function() {
        let f = |theta: f64| 0.9 * (1.0 - (1.0 - theta.cos()).powi(5));
        let table = AngularTransmittance::sample(90, f);
        for k in 0..900 {
            let theta = 0.5 * PI * k as f64 / 900.0;
            assert!((table.at(theta) - f(theta)).abs() < 2e-4, "{theta}");
        }
        assert_eq!(table.at(0.5 * PI), f(0.5 * PI));
        assert_eq!(table.at(1.6), 0.0);
    }

    #[test]
    fn hemispherical_of_a_cosine_is_two_thirds() {
        let table = AngularTransmittance::sample(180, f64::cos);
        assert!((table.hemispherical() - 2.0 / 3.0).abs() < 1e-5);
    }
}
