//! Ranges of ranks by an interval order.

use crate::compute::estimate::Estimate;

/// Range of the possible ranks of a candidate, both ends included, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Range {
    /// Best possible rank: 1 plus the number of candidates that are surely better.
    pub first: usize,
    /// Worst possible rank: the number of candidates minus those that are surely worse.
    pub last: usize,
}

/// Whether `a` is above `b` beyond their uncertainty: their difference exceeds the sum of their errors.
pub fn surely_above(a: Estimate, b: Estimate) -> bool {
    a.value - a.error > b.value + b.error
}

/// Returns the range of possible ranks of each of n candidates from their values; rank 1 has the greatest value. A
/// range reaches from 1 + (number of surely greater values) to n − (number of surely smaller values).
pub fn ranges(values: &[Estimate]) -> Vec<Range> {
    let sorted = |of: fn(&Estimate) -> f64| {
        let mut list: Vec<f64> = values.iter().map(of).collect();
        list.sort_by(f64::total_cmp);
        list
    };
    let (lows, highs) = (sorted(|one| one.value - one.error), sorted(|one| one.value + one.error));
    let n = values.len();
    let range = |one: &Estimate| {
        let (low, high) = (one.value - one.error, one.value + one.error);
        let better = n - lows.partition_point(|other| *other <= high);
        let worse = highs.partition_point(|other| *other < low);
        Range { first: 1 + better, last: n - worse }
    };
    values.iter().map(range).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_cannot_be_told_apart_shares_ranks() {
        let of = |list: &[(f64, f64)]| -> Vec<[usize; 2]> {
            let values: Vec<Estimate> = list.iter().map(|&(value, error)| Estimate::new(value, error)).collect();
            ranges(&values).iter().map(|range| [range.first, range.last]).collect()
        };
        assert_eq!(of(&[(0.9, 0.01), (0.5, 0.01), (0.1, 0.01)]), [[1, 1], [2, 2], [3, 3]]);
        // The middle one is within the uncertainty of both others, which differ surely from one another.
        assert_eq!(of(&[(0.6, 0.06), (0.5, 0.06), (0.4, 0.06)]), [[1, 2], [1, 3], [2, 3]]);
        assert_eq!(of(&[(0.5, 0.0), (0.5, 0.0)]), [[1, 2], [1, 2]]);
        assert!(of(&[]).is_empty());
    }

    fn estimates() -> impl Strategy<Value = Vec<Estimate>> {
        prop::collection::vec((0.0..1.0_f64, 0.0..0.3_f64).prop_map(|(value, error)| Estimate { value, error }), 0..20)
    }

    proptest! {
        #[test]
        fn ranges_count_those_that_are_surely_better_and_worse(values in estimates()) {
            let ranges = ranges(&values);
            let count = |which: &dyn Fn(&Estimate) -> bool| values.iter().filter(|one| which(one)).count();
            for (one, range) in values.iter().zip(&ranges) {
                prop_assert_eq!(range.first, 1 + count(&|other| surely_above(*other, *one)));
                prop_assert_eq!(range.last, values.len() - count(&|other| surely_above(*one, *other)));
                prop_assert!(range.first <= range.last);
            }
        }

        #[test]
        fn the_relation_is_an_interval_order(values in estimates()) {
            for a in &values {
                prop_assert!(!surely_above(*a, *a));
                for b in &values {
                    for c in &values {
                        prop_assert!(!(surely_above(*a, *b) && surely_above(*b, *c)) || surely_above(*a, *c));
                        // Of two pairs in order one first is above the other's second.
                        for d in &values {
                            let crossed = surely_above(*a, *d) || surely_above(*c, *b);
                            prop_assert!(!(surely_above(*a, *b) && surely_above(*c, *d)) || crossed);
                        }
                    }
                }
            }
        }

        #[test]
        fn every_order_that_the_intervals_allow_is_within_the_ranges(
            values in estimates(), at in prop::collection::vec(0.0..1.0_f64, 20)
        ) {
            // True values anywhere within the intervals: nobody's true rank lies outside of its range.
            let truth: Vec<f64> =
                values.iter().zip(&at).map(|(one, t)| one.value + (2.0 * t - 1.0) * one.error).collect();
            for (k, range) in ranges(&values).iter().enumerate() {
                let above = truth.iter().filter(|other| **other > truth[k]).count();
                prop_assert!((range.first..=range.last).contains(&(1 + above)));
            }
        }
    }
}
