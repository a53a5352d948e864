//! A list in order: found anew from its figures in microseconds whenever weights or anchors change.

use super::front::{Place, front};
use super::objective::{Objective, utility};
use super::order::{Range, ranges};
use super::why::{Profile, Why, difference, mean};
use crate::compute::estimate::Estimate;

/// One of the list.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranked {
    /// 0 … 1, with what the figures' errors leave open.
    pub utility: Estimate,
    /// Ranks that it may have.
    pub ranks: Range,
    /// Against the front.
    pub place: Place,
    /// Against the one of the highest utility; the best itself against the second. `None` where there is no other.
    pub to_best: Option<(usize, Why)>,
    /// Against the mean of all.
    pub to_mean: Why,
}

/// A list, ranked.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// In the order of what was given.
    pub list: Vec<Ranked>,
    /// Indices by falling utility; of equal ones the earlier first.
    pub order: Vec<usize>,
}

impl Ranking {
    /// Of figures, and of the parts that they are sums of, each in the order of the objectives.
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
