//! Illuminance of the unobstructed horizontal plane by a relative luminance distribution, by which a sky is scaled.

use super::distribution::{Distribution, Model};
use super::gradated::Gradated;
use super::patches::tregenza_patches;
use crate::compute::estimate::Estimate;
use crate::compute::quadrature::{Tolerance, gauss_legendre, integrate};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

/// Method by which the integrals of a gradated sky are computed.
#[derive(Clone, Copy)]
enum Rule {
    /// Adaptive integration to this relative accuracy.
    Adaptive(f64),
    /// Fixed number of Gauss points between knots, [`POINTS`].
    Fixed,
}

/// Rules of the inner and the outer integral; their accuracy is far better than the 1e-8 to which mean luminances of
/// patches are integrated.
const EXACT: [Rule; 2] = [Rule::Adaptive(1e-11), Rule::Adaptive(1e-10)];
/// Rules of both integrals for annual simulations with thousands of skies.
const QUICK: [Rule; 2] = [Rule::Fixed, Rule::Fixed];
/// Number of Gauss points between knots. Chosen: cost; the error is [`QUICK_ERROR`].
const POINTS: usize = 14;
/// Maximum relative error of [`QUICK`] over Perez' skies: 1.4e-5 was measured over the hours of a year. Held by the
/// test `quick_is_within_its_error_for_every_hour_of_a_year`.
const QUICK_ERROR: f64 = 2e-5;
/// Angle from the sun, a further knot, within which the circumsolar part is steep. \[rad\] Chosen: e^{dχ} with d from
/// −8 to −2 has fallen to 1 … 30 % there; held by the test of [`QUICK_ERROR`].
const AROUND_SUN: f64 = 0.6;

impl Rule {
    /// Integrates a function between the first and the last of the knots (rising), at which it may have kinks.
    fn integrate(self, mut f: impl FnMut(f64) -> f64, knots: &[f64]) -> Estimate {
        static GAUSS: OnceLock<Vec<(f64, f64)>> = OnceLock::new();
        match self {
            Self::Adaptive(relative) => integrate(f, knots, Tolerance::relative(relative)),
            Self::Fixed => {
                let gauss = GAUSS.get_or_init(|| gauss_legendre(POINTS));
                let piece = |pair: &[f64]| {
                    let width = pair[1] - pair[0];
                    if width <= 0.0 {
                        return 0.0;
                    }
                    width * gauss.iter().map(|&(at, weight)| weight * f(pair[0] + width * at)).sum::<f64>()
                };
                let sum: f64 = knots.windows(2).map(piece).sum();
                Estimate::new(sum, QUICK_ERROR * sum.abs())
            }
        }
    }
}

/// Computes ∫ L cosZ dω over the upper hemisphere for the relative luminance L of a distribution, Z the zenith angle.
/// \[sr\]
pub(super) fn horizontal_illuminance(distribution: &Distribution) -> Estimate {
    within(distribution, EXACT)
}

/// Computes ∫ L cosZ dω over the upper hemisphere for the relative luminance L of a distribution from a fixed number of
/// directions, with a relative error of at most 2e-5. \[sr\]
pub(super) fn horizontal_illuminance_quickly(distribution: &Distribution) -> Estimate {
    within(distribution, QUICK)
}

/// Computes ∫ L cosZ dω of a relative luminance L with the rules of the inner and outer integral. \[sr\]
fn within(distribution: &Distribution, rules: [Rule; 2]) -> Estimate {
    match &distribution.model {
        Model::Uniform => Estimate::exact(PI),
        // π/3 + (2/3)·(2π/3)
        Model::Overcast => Estimate::exact(7.0 * PI / 9.0),
        Model::Gradated(sky, sun) => gradated(sky, sun.z.atan2(sun.truncate().length()), rules),
        Model::Scan(scan) => {
            let flux = tregenza_patches()
                .iter()
                .zip(scan.values())
                .map(|(patch, luminance)| {
                    let (low, high) = (patch.altitude_min, patch.altitude_max);
                    luminance * 0.5 * patch.width * (high - low).sin() * (high + low).sin()
                })
                .sum();
            Estimate::exact(flux)
        }
    }
}

/// Computes ∫ L cosZ dω of a gradated sky with the sun at an altitude \[rad\].
///
/// Without a circumsolar part it is 2π ∫ φ(z) z dz. With one, polar coordinates about the sun remove the kink at its
/// tip: ∫ f(χ) sinχ [∫ φ(z) z dψ] dχ with z = cosχ sin h + sinχ cos h cosψ. Knots are where a circle about the sun
/// touches the horizon or the circle on which the gradation becomes 0, and where the indicatrix becomes 0.
fn gradated(sky: &Gradated, altitude: f64, [inner_rule, outer_rule]: [Rule; 2]) -> Estimate {
    let zero = gradation_zero(sky);
    if sky.symmetric() {
        let mut knots = vec![0.0, 1.0];
        knots.extend(zero);
        knots.sort_by(f64::total_cmp);
        return outer_rule.integrate(|z| sky.gradation(z) * z, &knots) * (2.0 * PI * sky.base.max(0.0));
    }
    let (sin_h, cos_h) = altitude.sin_cos();
    let zenith_angle = FRAC_PI_2 - altitude;
    let mut knots = vec![0.0, PI];
    if let Rule::Fixed = outer_rule {
        knots.push(AROUND_SUN);
    }
    for z in [Some(0.0), zero].into_iter().flatten() {
        let radius: f64 = f64::acos(z);
        knots.extend([(zenith_angle - radius).abs(), zenith_angle + radius, 2.0 * PI - zenith_angle - radius]);
    }
    knots.extend(indicatrix_zeros(sky));
    knots.retain(|chi| (0.0..=PI).contains(chi));
    knots.sort_by(f64::total_cmp);

    let mut inner_error: f64 = 0.0;
    let outer = outer_rule.integrate(
        |chi| {
            let (sin_chi, cos_chi) = chi.sin_cos();
            let (level, swing) = (cos_chi * sin_h, sin_chi * cos_h);
            let end = circle_angle(level, swing, 0.0);
            let mut inner_knots = vec![0.0, end];
            inner_knots.extend(zero.map(|z| circle_angle(level, swing, z)).filter(|psi| *psi < end));
            inner_knots.sort_by(f64::total_cmp);
            let inner = inner_rule.integrate(
                |psi| {
                    let z = level + swing * psi.cos();
                    sky.gradation(z) * z.max(0.0)
                },
                &inner_knots,
            ) * 2.0;
            let weight = sky.indicatrix(chi) * sin_chi;
            inner_error = inner_error.max(inner.error * weight);
            inner.value * weight
        },
        &knots,
    );
    Estimate::new(outer.value, outer.error + PI * inner_error)
}

/// Returns the angle ψ, 0 … π, up to which `level` + `swing`·cosψ exceeds `z`. \[rad\]
fn circle_angle(level: f64, swing: f64, z: f64) -> f64 {
    if level - swing >= z {
        PI
    } else if level + swing <= z {
        0.0
    } else {
        ((z - level) / swing).clamp(-1.0, 1.0).acos()
    }
}

/// Returns the sine of the altitude at which 1 + a·e^{b/z} changes sign, if it does so above the horizon.
pub(super) fn gradation_zero(sky: &Gradated) -> Option<f64> {
    // e^{b/z} = −1/a
    let z = (sky.a < 0.0).then(|| sky.b / (-1.0 / sky.a).ln())?;
    (z > 0.0 && z < 1.0).then_some(z)
}

/// Returns the angles from the sun at which the indicatrix changes sign. \[rad\]
pub(super) fn indicatrix_zeros(sky: &Gradated) -> Vec<f64> {
    let raw = |chi: f64| sky.base + sky.c * (sky.d * chi).exp() + sky.e * chi.cos().powi(2);
    /// Number of intervals of the angle that are searched for a change of sign: one per degree. Zeros closer together
    /// enclose a part of the sky that is too small and too faint to count.
    const STEPS: usize = 180;
    let at = |i: usize| PI * i as f64 / STEPS as f64;
    let mut zeros = Vec::new();
    for i in 0..STEPS {
        let (mut low, mut high) = (at(i), at(i + 1));
        let sign = raw(low) > 0.0;
        if sign == (raw(high) > 0.0) {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (raw(middle) > 0.0) == sign { low = middle } else { high = middle }
        }
        zeros.push(0.5 * (low + high));
    }
    zeros
}

#[cfg(test)]
mod tests {
    use super::super::distribution::Distribution;
    use super::super::perez::{Air, PerezState};
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::Dir;

    #[test]
    fn quick_is_within_its_error_for_every_hour_of_a_year() {
        let mut worst: f64 = 0.0;
        for altitude in [0.3, 2.0, 7.0, 15.0, 30.0, 50.0, 70.0, 89.0_f64] {
            for normal in [0.0, 20.0, 100.0, 300.0, 600.0, 900.0, 1050.0] {
                for diffuse in [2.0, 15.0, 60.0, 120.0, 250.0, 500.0] {
                    let altitude = altitude.to_radians();
                    let state = PerezState::in_air(altitude, normal, diffuse, Air::UNKNOWN).unwrap();
                    let sky =
                        Distribution::perez(&state, Dir::from_altitude_bearing(altitude, Bearing::from_radians(1.0)));
                    let (exact, quick) = (horizontal_illuminance(&sky).value, horizontal_illuminance_quickly(&sky));
                    worst = worst.max((quick.value / exact - 1.0).abs());
                    assert!(
                        (quick.value - exact).abs() <= quick.error,
                        "{altitude} {normal} {diffuse}: {quick:?} {exact}"
                    );
                }
            }
        }
        assert!(worst > 0.0);
    }
}
