//! Luminous intensities at nodes of C and γ with linear interpolation between them, as in programs that read luminaire
//! files.

/// Luminous-intensity distribution as values at nodes of C and γ (photometry of type C), linear between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Intensities {
    /// Angles C of the planes, rising, 360° not repeated; a single plane holds for all C. \[rad\]
    pub c: Vec<f64>,
    /// Angles γ from the nadir in every plane, rising. \[rad\]
    pub gamma: Vec<f64>,
    /// Luminous intensities, `[plane · gamma.len() + angle]`. \[cd\]
    pub values: Vec<f64>,
}

impl Intensities {
    /// Returns the luminous intensity at the angles `c` and `gamma` \[rad\], linear between the nodes; 0 outside the
    /// first and the last γ. \[cd\]
    pub fn at(&self, c: f64, gamma: f64) -> f64 {
        let (Some(first), Some(last)) = (self.gamma.first(), self.gamma.last()) else { return 0.0 };
        /// Tolerance at the first and the last γ, so that rounding does not make the nadir dark. \[rad\]
        const SLACK: f64 = 1e-9;
        if !(gamma >= first - SLACK && gamma <= last + SLACK) {
            return 0.0;
        }
        let j = self.gamma.partition_point(|node| *node <= gamma).clamp(1, self.gamma.len().max(2) - 1);
        let in_plane = |plane: usize| {
            let row = &self.values[plane * self.gamma.len()..][..self.gamma.len()];
            let (Some(low), Some(high)) = (row.get(j - 1), row.get(j)) else {
                return row.first().copied().unwrap_or(0.0);
            };
            let [from, to] = [self.gamma[j - 1], self.gamma[j]];
            let share = ((gamma - from) / (to - from)).clamp(0.0, 1.0);
            low + share * (high - low)
        };
        let planes = self.c.len();
        if planes < 2 {
            return in_plane(0);
        }
        let turn = 2.0 * std::f64::consts::PI;
        let c = self.c[0] + (c - self.c[0]).rem_euclid(turn);
        let i = self.c.partition_point(|node| *node <= c).max(1) - 1;
        let next = self.c.get(i + 1).copied().unwrap_or(self.c[0] + turn);
        let share = ((c - self.c[i]) / (next - self.c[i])).clamp(0.0, 1.0);
        let (low, high) = (in_plane(i), in_plane((i + 1) % planes));
        low + share * (high - low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn between_nodes_it_is_linear_all_round_the_turn() {
        let table = Intensities {
            c: vec![0.0, FRAC_PI_2, PI, 1.5 * PI],
            gamma: vec![0.0, PI],
            values: vec![0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 5.0, 5.0],
        };
        assert!((table.at(0.5 * FRAC_PI_2, FRAC_PI_2) - 1.0).abs() < 1e-12);
        assert!((table.at(1.75 * PI, 1.0) - 2.5).abs() < 1e-12);
        assert!((table.at(-0.25 * PI, 1.0) - 2.5).abs() < 1e-12);
        let half = Intensities { c: vec![0.0], gamma: vec![0.0, FRAC_PI_2], values: vec![2.0, 4.0] };
        assert_eq!([half.at(1.0, 0.0), half.at(5.0, FRAC_PI_2), half.at(0.0, 3.0)], [2.0, 4.0, 0.0]);
    }
}
