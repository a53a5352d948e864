//! Transmittance beyond the most grazing row of incident directions.

use super::lattice::Lattice;
use std::f64::consts::FRAC_PI_2;

/// Continuation of τ from a direction on the border to θ = 90°. What falls steeply towards the border goes to zero, as
/// Fresnel's equations have it for everything behind a smooth surface; what is constant there continues (open slats).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grazing {
    /// Slope of τ at the border, in units of the border's τ and of the angle from there to 90°.
    slope: f64,
    /// Bend of the parabola that falls to zero at 90°, in the units of `slope`.
    bend: f64,
    /// Weight of the straight continuation: 0 fades to zero, 1 follows the slope.
    straight: f64,
}

/// τ at 90°, extrapolated in a straight line, as a share of the border's, below which it fades to zero. Chosen between
/// a smooth surface and open slats: 1 − (1 − cosθ)⁵ with rows at 72° and 84° extrapolates to 0.51, a constant to 1.
const FADES_BELOW: f64 = 0.65;
/// τ at 90°, extrapolated in a straight line, as a share of the border's, above which it follows that line. Chosen in
/// the same way as [`FADES_BELOW`]; `examples/incidence_errors` prints the errors beyond the last row.
const CONTINUES_ABOVE: f64 = 0.8;

impl Grazing {
    /// Creates the continuation at a vertex of the border; `None` elsewhere, and where nothing gets through or no row
    /// lies further in.
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

    /// Returns τ over the border's, `beyond` from 0 (the border) to 1 (θ = 90°).
    pub fn factor(self, beyond: f64) -> f64 {
        let on = (1.0 + self.slope * beyond).max(0.0);
        let fading = (1.0 - beyond + self.bend * beyond * (beyond - 1.0)).max(0.0);
        self.straight * on + (1.0 - self.straight) * fading
    }
}
