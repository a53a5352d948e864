//! Ranking of a list, computed from its figures in microseconds whenever weights or scale limits change.

use super::front::{Place, front};
use super::objective::{Objective, utility};
use super::order::{Range, ranges};
use super::why::{Profile, Why, difference, mean};
use crate::compute::estimate::Estimate;

/// Ranked candidate: utility, range of ranks, position relative to the Pareto front, and the reasons for its rank.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranked {
    /// Utility, 0 … 1, with the uncertainty that follows from the figures' errors.
    pub utility: Estimate,
    /// Range of the possible ranks.
    pub ranks: Range,
    /// Position relative to the Pareto front.
    pub place: Place,
    /// Index of the candidate with the highest utility (for that candidate itself, of the second best) and the
    /// difference in utility from it, split by objective. `None` if there is no other candidate.
    pub to_best: Option<(usize, Why)>,
    /// Difference in utility from the mean of all candidates, split by objective.
    pub to_mean: Why,
}

/// Ranking of a list of candidates.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// Candidates in the order of the input.
    pub list: Vec<Ranked>,
    /// Indices in `list` by falling utility; of equal utilities the earlier candidate comes first.
    pub order: Vec<usize>,
}

impl Ranking {
    /// Ranks candidates by `figures`: one row per candidate, with one figure per objective. `parts` has, for each of
    /// these figures, the parts that it is the sum of (e.g. by groups of hours), to explain differences; empty where it
    /// is not a sum.
    pub fn of(objectives: &[Objective], figures: &[&[Estimate]], parts: &[&[Vec<f64>]]) -> Self {
        let utilities: Vec<Estimate> = figures.iter().map(|own| utility(objectives, own)).collect();
        let profiles: Vec<Profile> = figures
            .iter()
            .zip(parts)
            .map(|(own, parts)| Profile {
                utilities: objectives.iter().zip(*own).map(|(one, figure)| one.utility(figure.value)).collect(),
                figures: own.iter().map(|figure| figure.value).collect(),
                parts: parts.to_vec(),
            })
            .collect();
        let mut order: Vec<usize> = (0..figures.len()).collect();
        order.sort_by(|&a, &b| utilities[b].value.total_cmp(&utilities[a].value));
        let Some(mean) = mean(&profiles.iter().collect::<Vec<_>>()) else {
            return Self { list: Vec::new(), order };
        };
        let rival = |k: usize| order.iter().copied().find(|&other| other != k);
        let places = front(objectives, figures);
        let list = ranges(&utilities)
            .into_iter()
            .zip(places)
            .enumerate()
            .map(|(k, (ranks, place))| Ranked {
                utility: utilities[k],
                ranks,
                place,
                to_best: rival(k).map(|other| (other, difference(objectives, &profiles[k], &profiles[other]))),
                to_mean: difference(objectives, &profiles[k], &mean),
            })
            .collect();
        Self { list, order }
    }
}

#[cfg(test)]
mod tests {
    use super::super::objective::Better;
    use super::*;

    #[test]
    fn a_list_is_put_in_order() {
        let objective = Objective { better: Better::Less, worst: 10.0, best: 0.0, weight: 1.0 };
        let figures = [[Estimate::new(6.0, 0.5)], [Estimate::new(2.0, 0.5)], [Estimate::new(2.6, 0.5)]];
        let parts = [[vec![4.0, 2.0]], [vec![1.0, 1.0]], [vec![1.3, 1.3]]];
        let ranking = Ranking::of(
            &[objective],
            &figures.iter().map(<[_; 1]>::as_slice).collect::<Vec<_>>(),
            &parts.iter().map(<[_; 1]>::as_slice).collect::<Vec<_>>(),
        );
        assert_eq!(ranking.order, [1, 2, 0]);
        let ranks: Vec<[usize; 2]> = ranking.list.iter().map(|one| [one.ranks.first, one.ranks.last]).collect();
        assert_eq!(ranks, [[3, 3], [1, 2], [1, 2]]);
        let places: Vec<Place> = ranking.list.iter().map(|one| one.place).collect();
        assert_eq!(places, [Place::Behind, Place::Front, Place::Grey]);
        let (against, why) = ranking.list[0].to_best.as_ref().unwrap();
        assert_eq!((*against, &*why.shares[0].parts), (1, &[3.0, 1.0][..]));
        assert_eq!(ranking.list[1].to_best.as_ref().map(|(against, _)| *against), Some(2));
        assert!(Ranking::of(&[objective], &[], &[]).list.is_empty());
    }
}
