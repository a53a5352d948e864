//! Objectives of a ranking: a figure, its better direction, scale limits and weight.

use crate::compute::estimate::Estimate;

/// Direction in which a figure is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// Smaller values are better.
    Less,
    /// Larger values are better.
    More,
}

/// Objective of a ranking: better direction, scale limits and weight of one figure. Scale limits are in the unit of the
/// figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Objective {
    /// Direction in which the figure is better.
    pub better: Better,
    /// Worst value of the scale, whose utility is 0.
    pub worst: f64,
    /// Best value of the scale, whose utility is 1; on the better side of `worst`, and not equal to it.
    pub best: f64,
    /// Weight of the objective, above 0, relative to the sum of all weights.
    pub weight: f64,
}

impl Objective {
    /// Returns the utility of a value of the figure: linear between the scale limits, limited to 0 … 1.
    pub fn utility(&self, value: f64) -> f64 {
        ((value - self.worst) / (self.best - self.worst)).clamp(0.0, 1.0)
    }

    /// Returns the utility of a figure with an error. The utility's error is the larger difference from the utilities
    /// at the two ends of the figure's interval.
    pub fn utility_of(&self, figure: Estimate) -> Estimate {
        let own = self.utility(figure.value);
        let at = |value: f64| (self.utility(value) - own).abs();
        Estimate { value: own, error: at(figure.value - figure.error).max(at(figure.value + figure.error)) }
    }

    /// Whether `a` is a better value of the figure than `b`, without regard to errors.
    pub fn prefers(&self, a: f64, b: f64) -> bool {
        match self.better {
            Better::Less => a < b,
            Better::More => a > b,
        }
    }

    /// Whether figure `a` is better than figure `b` beyond their uncertainty: the interval of their difference excludes
    /// 0.
    pub fn surely_prefers(&self, a: Estimate, b: Estimate) -> bool {
        self.prefers(a.value, b.value) && (a.value - b.value).abs() > a.error + b.error
    }
}

/// Computes the utility of a candidate, 0 … 1: the weighted mean of the utilities of its figures, which are in the
/// order of `objectives`. Its error is the weighted sum of their errors, as if all had the same sign.
pub fn utility(objectives: &[Objective], figures: &[Estimate]) -> Estimate {
    let weights: f64 = objectives.iter().map(|one| one.weight).sum();
    let mut sum = Estimate { value: 0.0, error: 0.0 };
    for (objective, figure) in objectives.iter().zip(figures) {
        let own = objective.utility_of(*figure);
        sum.value += objective.weight / weights * own.value;
        sum.error += objective.weight / weights * own.error;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utilities_are_linear_between_the_anchors_and_clipped() {
        let energy = Objective { better: Better::Less, worst: 12.0, best: 2.0, weight: 2.0 };
        assert_eq!([14.0, 12.0, 7.0, 2.0, 1.0].map(|value| energy.utility(value)), [0.0, 0.0, 0.5, 1.0, 1.0]);
        let at = |value, error| energy.utility_of(Estimate { value, error });
        assert!((at(7.0, 1.0).error - 0.1).abs() < 1e-15);
        // Beyond an anchor only what reaches back counts.
        assert_eq!((at(14.0, 1.0).error, at(13.0, 2.0).error), (0.0, 0.1));
        let light = Objective { better: Better::More, worst: 0.2, best: 0.8, weight: 1.0 };
        let both = utility(&[energy, light], &[Estimate::new(7.0, 1.0), Estimate::new(0.5, 0.06)]);
        assert!((both.value - 0.5).abs() < 1e-15 && (both.error - (0.2 + 0.1) / 3.0).abs() < 1e-15);
    }

    #[test]
    fn one_is_surely_better_where_the_interval_of_the_difference_excludes_nought() {
        let less = Objective { better: Better::Less, worst: 1.0, best: 0.0, weight: 1.0 };
        let sure = |a: (f64, f64), b: (f64, f64)| less.surely_prefers(Estimate::new(a.0, a.1), Estimate::new(b.0, b.1));
        assert!(sure((0.25, 0.125), (0.75, 0.25)) && !sure((0.75, 0.25), (0.25, 0.125)));
        assert!(!sure((0.25, 0.25), (0.75, 0.25)), "touching intervals hold 0");
        assert!(!sure((0.5, 0.0), (0.5, 0.0)));
    }
}
