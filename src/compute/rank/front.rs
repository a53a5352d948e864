//! The Pareto front of figures with errors.
//!
//! A dominates B when it is surely better in one objective and surely worse in none. The front consists of those that
//! no other dominates. Of them those are grey that another one equals or excels in every figure by its value: only the
//! errors keep them on the front.
//!
//! The relation is not an order: with large errors it may run in a circle, in which all are dominated. A candidate that
//! is dominated only by members of such circles, or by those that these dominate, is grey too: it is undecided which of
//! them are behind.

use super::objective::Objective;
use crate::compute::estimate::Estimate;

/// Position of a candidate relative to the Pareto front.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Candidate on the Pareto front: no other dominates it.
    Front,
    /// Candidate within the uncertainty of the Pareto front: whether another dominates it cannot be decided from
    /// figures with errors.
    Grey,
    /// Dominated candidate: another is surely better in one objective and surely worse in none.
    Behind,
}

impl Place {
    /// Returns the key of the position in CSV and JSON tables; empty for dominated candidates.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Grey => "grey",
            Self::Behind => "",
        }
    }
}

/// Whether `a` is surely better than `b` in one objective and surely worse in none.
fn dominates(objectives: &[Objective], a: &[Estimate], b: &[Estimate]) -> bool {
    let mut better = false;
    for ((objective, a), b) in objectives.iter().zip(a).zip(b) {
        if objective.surely_prefers(*b, *a) {
            return false;
        }
        better |= objective.surely_prefers(*a, *b);
    }
    better
}

/// Whether `a` is at least as good as `b` in all objectives and better in one, by the values alone, without their
/// errors.
fn excels(objectives: &[Objective], a: &[Estimate], b: &[Estimate]) -> bool {
    let mut better = false;
    for ((objective, a), b) in objectives.iter().zip(a).zip(b) {
        if objective.prefers(b.value, a.value) {
            return false;
        }
        better |= objective.prefers(a.value, b.value);
    }
    better
}

/// Returns the position of each candidate relative to the Pareto front. `all` has one row per candidate, with one
/// figure per objective in the order of `objectives`.
pub fn front(objectives: &[Objective], all: &[&[Estimate]]) -> Vec<Place> {
    let n = all.len();
    let below: Vec<Vec<usize>> =
        (0..n).map(|a| (0..n).filter(|&b| dominates(objectives, all[a], all[b])).collect()).collect();
    let mut dominated = vec![false; n];
    below.iter().flatten().for_each(|&b| dominated[b] = true);
    // Behind is what a chain from somebody undominated leads to.
    let mut behind = vec![false; n];
    let mut open: Vec<usize> = (0..n).filter(|&k| !dominated[k]).collect();
    while let Some(a) = open.pop() {
        for &b in &below[a] {
            if !std::mem::replace(&mut behind[b], true) {
                open.push(b);
            }
        }
    }
    (0..n)
        .map(|k| {
            if behind[k] {
                Place::Behind
            } else if dominated[k] || (0..n).any(|other| excels(objectives, all[other], all[k])) {
                Place::Grey
            } else {
                Place::Front
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::objective::Better;
    use super::*;
    use proptest::prelude::*;

    fn objectives() -> Vec<Objective> {
        let one = |better| Objective { better, worst: 0.0, best: 1.0, weight: 1.0 };
        vec![one(Better::More), Objective { worst: 1.0, best: 0.0, ..one(Better::Less) }, one(Better::More)]
    }

    fn places(all: &[Vec<Estimate>]) -> Vec<Place> {
        front(&objectives()[..all.first().map_or(0, Vec::len)], &all.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }

    fn rows(list: &[(f64, f64)], error: f64) -> Vec<Vec<Estimate>> {
        list.iter().map(|&(a, b)| vec![Estimate::new(a, error), Estimate::new(b, error)]).collect()
    }

    #[test]
    fn only_errors_keep_grey_ones_on_the_front() {
        // More of the first and less of the second is better.
        let list = [(0.9, 0.5), (0.5, 0.1), (0.88, 0.52), (0.4, 0.6)];
        assert_eq!(places(&rows(&list, 0.05)), [Place::Front, Place::Front, Place::Grey, Place::Behind]);
        assert_eq!(places(&rows(&list, 0.0)), [Place::Front, Place::Front, Place::Behind, Place::Behind]);
        // Equal ones are both on it.
        assert_eq!(places(&rows(&[(0.5, 0.5), (0.5, 0.5)], 0.0)), [Place::Front; 2]);
        assert!(places(&[]).is_empty());
    }

    #[test]
    fn a_circle_leaves_nobody_behind_that_it_cannot_tell() {
        // In every objective one is surely better than the next and within the uncertainty of the third.
        let row = |a: f64, b: f64, c: f64| vec![Estimate::new(a, 0.2), Estimate::new(b, 0.2), Estimate::new(c, 0.2)];
        let circle = vec![row(0.75, 0.5, 0.25), row(0.25, 0.25, 0.5), row(0.5, 0.75, 0.75)];
        assert_eq!(places(&circle), [Place::Grey; 3]);
    }

    proptest! {
        #[test]
        fn fronts_are_fronts(list in prop::collection::vec(prop::collection::vec((0.0..1.0_f64, 0.0..0.2_f64), 3), 1..16)) {
            let all: Vec<Vec<Estimate>> = list
                .iter()
                .map(|row| row.iter().map(|&(value, error)| Estimate { value, error }).collect())
                .collect();
            let (places, o) = (places(&all), objectives());
            prop_assert!(places.iter().any(|place| *place != Place::Behind));
            for (k, place) in places.iter().enumerate() {
                let dominated = all.iter().any(|other| dominates(&o, other, &all[k]));
                let excelled = all.iter().any(|other| excels(&o, other, &all[k]));
                match place {
                    Place::Front => prop_assert!(!dominated && !excelled),
                    Place::Behind => prop_assert!(dominated),
                    Place::Grey => prop_assert!(dominated || excelled),
                }
            }
            // Without errors it is the front as everybody knows it.
            let sharp: Vec<Vec<Estimate>> =
                all.iter().map(|row| row.iter().map(|one| Estimate { error: 0.0, ..*one }).collect()).collect();
            for (k, place) in self::places(&sharp).iter().enumerate() {
                let excelled = sharp.iter().any(|other| excels(&o, other, &sharp[k]));
                prop_assert_eq!(*place, if excelled { Place::Behind } else { Place::Front });
            }
        }
    }
}
