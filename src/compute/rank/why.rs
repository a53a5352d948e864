//! Reasons for a rank: the difference of two candidates in parts that add up to it, by objective and, where figures are
//! sums over hours, by groups of hours and places.

use super::objective::Objective;

/// Utilities, figures and parts of figures of one candidate, from which its difference from another is explained.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Utilities, 0 … 1, one per objective.
    pub utilities: Vec<f64>,
    /// Figures, one per objective, in the unit of the figure.
    pub figures: Vec<f64>,
    /// Parts of each figure by group (of hours or positions in the room), one list per objective; empty where the
    /// figure is not a sum.
    pub parts: Vec<Vec<f64>>,
}

/// Contribution of one objective to the difference in utility between two candidates.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// Weighted difference of the utilities; those of all objectives add up to the difference in utility of the two
    /// candidates.
    pub utility: f64,
    /// Difference of the two candidates' figures, in the unit of the figure.
    pub figure: f64,
    /// Difference of the figures by group of hours or positions; empty where the figure is not a sum.
    pub parts: Vec<f64>,
    /// Part of the figure's difference that is in none of the groups: all of it where the figure is not a sum.
    pub rest: f64,
}

/// Difference in utility between two candidates, as the sum of the contributions of all objectives.
#[derive(Debug, Clone, PartialEq)]
pub struct Why {
    /// Difference in utility: the sum of the contributions' `utility`.
    pub utility: f64,
    /// Contributions to the difference, one per objective.
    pub shares: Vec<Share>,
}

/// Computes the difference in utility `a` − `b` with the contribution of every objective. A figure's difference is
/// split into groups only where both have the same number of them.
pub fn difference(objectives: &[Objective], a: &Profile, b: &Profile) -> Why {
    let weights: f64 = objectives.iter().map(|one| one.weight).sum();
    let share = |(k, objective): (usize, &Objective)| {
        let figure = a.figures[k] - b.figures[k];
        let same = a.parts[k].len() == b.parts[k].len();
        let parts: Vec<f64> =
            if same { a.parts[k].iter().zip(&b.parts[k]).map(|(a, b)| a - b).collect() } else { Vec::new() };
        let rest = figure - parts.iter().sum::<f64>();
        Share { utility: objective.weight / weights * (a.utilities[k] - b.utilities[k]), figure, parts, rest }
    };
    let shares: Vec<Share> = objectives.iter().enumerate().map(share).collect();
    Why { utility: shares.iter().map(|share| share.utility).sum(), shares }
}

/// Computes the mean of the utilities, figures and parts of several candidates; a figure's parts only where all have
/// the same number of them. `None` without profiles.
pub fn mean(all: &[&Profile]) -> Option<Profile> {
    let first = all.first()?;
    let n = all.len() as f64;
    let over = |of: &dyn Fn(&Profile) -> f64| all.iter().map(|one| of(one)).sum::<f64>() / n;
    let objectives = 0..first.figures.len();
    let parts = |k: usize| {
        let count = first.parts[k].len();
        let same = all.iter().all(|one| one.parts[k].len() == count);
        (0..if same { count } else { 0 }).map(|group| over(&|one| one.parts[k][group])).collect()
    };
    Some(Profile {
        utilities: objectives.clone().map(|k| over(&|one| one.utilities[k])).collect(),
        figures: objectives.clone().map(|k| over(&|one| one.figures[k])).collect(),
        parts: objectives.map(parts).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::objective::{Better, utility};
    use super::*;
    use crate::compute::estimate::Estimate;
    use proptest::prelude::*;

    fn objectives() -> Vec<Objective> {
        vec![
            Objective { better: Better::Less, worst: 12.0, best: 2.0, weight: 2.0 },
            Objective { better: Better::More, worst: 0.2, best: 0.8, weight: 1.0 },
        ]
    }

    /// Returns a profile with a sum of six groups, and a figure that is not a sum.
    fn profile(parts: &[f64], other: f64) -> Profile {
        let figures = vec![parts.iter().sum(), other];
        let utilities = objectives().iter().zip(&figures).map(|(objective, f)| objective.utility(*f)).collect();
        Profile { utilities, figures, parts: vec![parts.to_vec(), Vec::new()] }
    }

    proptest! {
        #[test]
        fn parts_add_up_to_the_difference(
            list in prop::collection::vec((prop::collection::vec(0.0..4.0_f64, 6), 0.0..1.0_f64), 2..6)
        ) {
            let all: Vec<Profile> = list.iter().map(|(parts, other)| profile(parts, *other)).collect();
            let mean = mean(&all.iter().collect::<Vec<_>>()).unwrap();
            for against in all.iter().chain([&mean]) {
                let why = difference(&objectives(), &all[0], against);
                let weighted = |one: &Profile| (2.0 * one.utilities[0] + one.utilities[1]) / 3.0;
                prop_assert!((why.utility - (weighted(&all[0]) - weighted(against))).abs() < 1e-12);
                prop_assert!((why.shares.iter().map(|share| share.utility).sum::<f64>() - why.utility).abs() < 1e-12);
                for (k, share) in why.shares.iter().enumerate() {
                    let sum = share.parts.iter().sum::<f64>() + share.rest;
                    prop_assert!((sum - share.figure).abs() < 1e-12);
                    prop_assert!((share.figure - (all[0].figures[k] - against.figures[k])).abs() < 1e-12);
                }
                prop_assert!(why.shares[0].rest.abs() < 1e-12 && why.shares[0].parts.len() == 6);
                prop_assert!(why.shares[1].parts.is_empty());
            }
        }
    }

    #[test]
    fn weighted_utilities_are_those_of_the_ranking() {
        let (a, b) = (profile(&[1.0, 2.0, 1.0, 0.5, 0.0, 0.5], 0.5), profile(&[2.0; 6], 0.1));
        let whole = |one: &Profile| {
            let figures: Vec<Estimate> = one.figures.iter().map(|figure| Estimate::new(*figure, 0.0)).collect();
            utility(&objectives(), &figures).value
        };
        assert!((difference(&objectives(), &a, &b).utility - (whole(&a) - whole(&b))).abs() < 1e-15);
        assert!(mean(&[]).is_none());
    }
}
