//! Weights of the luminances of an aperture by band of the profile angle in the illuminance of a sensor: every band is
//! a strip of the aperture, and strips have closed forms.

use super::aperture::View;
use crate::compute::polygon::projected_solid_angle;
use crate::compute::system::measure::ProfileLight;

/// Projected solid angles of the bands of the profile angle that a sensor sees through an aperture. \[sr\]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BandWeights {
    first: usize,
    weights: Vec<f64>,
}

impl BandWeights {
    /// Computes the weights of `bands` bands for the view of an aperture from a sensor. `upright`: bands of the profile
    /// angle to the right instead of upwards.
    pub fn new(view: &View, upright: bool, bands: usize) -> Self {
        let limits = if upright { view.x } else { view.y };
        let strip = |[low, high]: [f64; 2]| {
            let part = if upright { View { x: [low, high], ..*view } } else { View { y: [low, high], ..*view } };
            projected_solid_angle(&part.corners(), view.normal)
        };
        let borders: Vec<f64> = ProfileLight::borders(bands)
            .map(|angle| (view.distance * angle.tan()).clamp(limits[0], limits[1]))
            .collect();
        let parts = borders.windows(2).map(|pair| if pair[1] > pair[0] { strip([pair[0], pair[1]]) } else { 0.0 });
        let weights: Vec<f64> = parts.collect();
        let first = weights.iter().position(|w| *w != 0.0).unwrap_or(0);
        let end = weights.iter().rposition(|w| *w != 0.0).map_or(first, |last| last + 1);
        Self { first, weights: weights[first..end].to_vec() }
    }

    /// Returns the memory that its weights take. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.weights[..])
    }

    /// Returns the indices of the visible bands with their weights. \[sr\]
    pub fn each(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.weights.iter().enumerate().map(|(k, weight)| (self.first + k, *weight))
    }

    /// Returns the sum of weight · value over the visible bands; with luminances as `values` it is the illuminance of
    /// the sensor. \[lx\]
    pub fn of(&self, values: &[f64]) -> f64 {
        self.weights.iter().zip(&values[self.first..]).map(|(w, v)| w * v).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn bands_make_the_whole_opening() {
        for (x, y, distance) in
            [([-1.0, 2.0], [0.3, 1.9], 2.0), ([0.1, 3.0], [-0.5, 1.1], 1e-3), ([0.0, 3.0], [-1.0, 1.0], 0.2)]
        {
            for normal in [DVec3::Y, DVec3::Z, DVec3::new(1.0, -0.3, 0.4).normalize()] {
                let view = View { x, y, distance, normal };
                let whole = projected_solid_angle(&view.corners(), normal);
                for upright in [false, true] {
                    let weights = BandWeights::new(&view, upright, 721);
                    let sum = weights.of(&vec![1.0; 721]);
                    assert!((sum - whole).abs() < 1e-9, "{view:?}: {sum} {whole}");
                }
            }
        }
    }
}
