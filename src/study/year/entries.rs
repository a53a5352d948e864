//! Annual metrics found by key, and with their values in one year.

use super::metric::{Metric, Quantity, Scale, Source, Subject};
use super::metrics::METRICS;
use super::{Figures, Year};
use crate::compute::estimate::Estimate;
use crate::study::year_keys::YearKeys;

/// Returns the metric with a key, and the index of the observer or level in the key; `None` if there is no such metric.
pub fn metric(key: &str) -> Option<(&'static Metric, usize)> {
    METRICS.iter().find_map(|metric| Some((metric, metric.index(key)?)))
}

/// Returns the keys and default scales of the metrics that may be objectives in a scene with these keys of a year.
pub fn scales(year: &YearKeys) -> Vec<(String, Scale)> {
    let of = |metric: &'static Metric| {
        let scale = metric.scale.and_then(|scale| scale(year));
        let count = if metric.subject == Subject::Observer { year.eyes.len() } else { 1 };
        scale.into_iter().flat_map(move |scale| (0..count).map(move |index| (metric.key(index), scale)))
    };
    METRICS.iter().flat_map(of).collect()
}

/// Annual metric with its values in one year.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Definition of the metric.
    pub metric: &'static Metric,
    /// Index of the observer or level; 0 for metrics of the room.
    pub index: usize,
    /// Values as computed, with all light lower by its error, and with all light higher.
    pub values: [Quantity; 3],
}

impl Entry {
    /// Returns the parts of the key in the order of their nesting in JSON, the outermost first.
    pub fn path(&self) -> Vec<String> {
        self.metric.path(self.index).split('/').map(str::to_owned).collect()
    }

    /// Returns the key: its parts separated by dots.
    pub fn key(&self) -> String {
        self.metric.key(self.index)
    }

    /// Returns the values of the metric as numbers: as computed, with less and with more light; `None` for words and
    /// empty lists.
    pub fn numbers(&self) -> Option<[f64; 3]> {
        let [own, less, more] = self.values.each_ref().map(Quantity::number);
        Some([own?, less?, more?])
    }

    /// Returns the value with its error, which is the larger difference from the values with less and with more light;
    /// `None` for words and empty lists.
    pub fn estimate(&self) -> Option<Estimate> {
        self.numbers().map(estimate)
    }

    /// Returns the text on compliance with limits; empty if the metric has no limit.
    pub fn compliance(&self) -> String {
        self.metric.compliance.zip(self.numbers()).map_or_else(String::new, |(words, numbers)| words(numbers))
    }
}

/// Returns the first of three values, with the larger difference from the two others as its error.
pub fn estimate([own, less, more]: [f64; 3]) -> Estimate {
    Estimate { value: own, error: (less - own).abs().max((more - own).abs()) }
}

/// Returns all metrics of a year, in the order of the table of figures, one observer or level after the other. `figures`:
/// figures of the year as computed, with less and with more light.
pub fn metrics(year: &Year, figures: &[Figures; 3]) -> Vec<Entry> {
    let entry = |metric: &'static Metric, index: usize| {
        let [own, less, more] = figures.each_ref().map(|figures| (metric.value)(&Source { year, figures }, index));
        Some(Entry { metric, index, values: [own?, less?, more?] })
    };
    let mut list = Vec::new();
    for group in METRICS.chunk_by(|a, b| a.subject == b.subject) {
        for index in 0..group[0].subject.count(&figures[0]) {
            list.extend(group.iter().filter_map(|metric| entry(metric, index)));
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_metric_is_found_by_its_key() {
        let mut seen = BTreeSet::new();
        for one in METRICS {
            for index in if one.subject == Subject::Room { 0..1 } else { 0..3 } {
                let key = one.key(index);
                let found = metric(&key).map(|(found, index)| (found.path(0), index));
                assert_eq!(found, Some((one.path(0), index)), "{key}");
                assert!(seen.insert(key));
            }
        }
        for wrong in ["", "DA", "DA3000", "DA300.", "glare", "glare.Ev_1", "glare.Ev_0.DGP_5pct", "glare.Ev_x.DGP_5pct"]
        {
            assert!(metric(wrong).is_none(), "{wrong}");
        }
        assert_eq!(metric("glare.Ev_12.share_above_0.40").unwrap().1, 11);
        assert_eq!(metric("EN17037.high.met_by_point").unwrap().1, 2);
    }

    #[test]
    fn numbers_of_lists_are_their_means() {
        assert_eq!(Quantity::List(vec![0.5, 1.0]).number(), Some(0.75));
        assert_eq!(Quantity::Counts(vec![3, 4]).number(), Some(3.5));
        assert_eq!(Quantity::Met(true).number(), Some(1.0));
        assert_eq!((Quantity::Word("x").number(), Quantity::List(Vec::new()).number()), (None, None));
        assert_eq!(estimate([2.0, 1.5, 2.25]), Estimate { value: 2.0, error: 0.5 });
    }
}
