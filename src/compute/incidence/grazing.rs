//! Extrapolation of the transmittance τ from the largest incidence angle θ of the data to grazing incidence.

use super::lattice::Lattice;
use std::f64::consts::FRAC_PI_2;

/// Extrapolation of the transmittance τ from an incident direction on the border of the data (their largest θ) to θ =
/// 90°. A τ that falls steeply towards the border goes to zero, according to Fresnel's equations for everything behind
/// a smooth surface; a constant τ continues (open slats).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grazing {
    /// Slope of τ over θ at the border of the data, relative to τ there and to the angle from there to 90°.
    slope: f64,
    /// Curvature of the parabola that falls to zero at 90°, in the units of `slope`.
    bend: f64,
    /// Weight of the linear extrapolation, 0 … 1: 0 fades to zero, 1 follows the slope.
    straight: f64,
}

/// Linearly extrapolated τ at θ = 90°, relative to τ at the border of the data, below which τ fades to zero. Chosen
/// between a smooth surface and open slats: 1 − (1 − cosθ)⁵ with rows at 72° and 84° extrapolates to 0.51, a constant
/// to 1.
const FADES_BELOW: f64 = 0.65;
/// Linearly extrapolated τ at θ = 90°, relative to τ at the border of the data, above which τ follows that line. Chosen
/// in the same way as [`FADES_BELOW`]; `examples/incidence_errors` prints the errors beyond the last row.
const CONTINUES_ABOVE: f64 = 0.8;

impl Grazing {
    /// Creates the extrapolation at an incident direction on the border of the data. `tau`: transmittance by incident
    /// direction. `None` if the direction is not on the border, if its τ is 0, or if no neighbour has a smaller θ.
    pub fn new(lattice: &Lattice, tau: &[f64], vertex: usize) -> Option<Self> {
        let theta = |v: usize| lattice.points()[v].z.clamp(-1.0, 1.0).acos();
        let own = theta(vertex);
        if !lattice.is_on_border(vertex) || tau[vertex] <= 0.0 || own > FRAC_PI_2 - 1e-3 {
            return None;
        }
        let inner: Vec<usize> = lattice.neighbours(vertex).iter().copied().filter(|&n| theta(n) < own - 1e-3).collect();
        let count = inner.len() as f64;
        if inner.is_empty() {
            return None;
        }
        let mean = |f: &dyn Fn(usize) -> f64| inner.iter().map(|&n| f(n)).sum::<f64>() / count;
        let way = FRAC_PI_2 - own;
        let back = (own - mean(&theta)) / way;
        let slope = (1.0 - mean(&|n| tau[n]) / tau[vertex]) / back;
        // Parabola through the two rows and zero at grazing.
        let bend = (-1.0 - slope) / (1.0 + back);
        let s = ((1.0 + slope - FADES_BELOW) / (CONTINUES_ABOVE - FADES_BELOW)).clamp(0.0, 1.0);
        Some(Self { slope, bend, straight: s * s * (3.0 - 2.0 * s) })
    }

    /// Returns τ relative to τ at the border of the data (their largest θ). `beyond`: position between the border (0)
    /// and θ = 90° (1), linear in θ.
    pub fn factor(self, beyond: f64) -> f64 {
        let on = (1.0 + self.slope * beyond).max(0.0);
        let fading = (1.0 - beyond + self.bend * beyond * (beyond - 1.0)).max(0.0);
        self.straight * on + (1.0 - self.straight) * fading
    }
}
