//! Annual metric: its key, label, unit and limit, and how its value is taken from the figures of a year. [`METRICS`] is
//! the table of all metrics, which programs, reports, rankings and accuracy series read.

use super::metrics::METRICS;
use super::{Figures, Year};
use crate::compute::estimate::Estimate;
use crate::compute::year::provision::LEVELS;
use crate::study::rank_keys::BetterKey;
use crate::study::year_keys::YearKeys;
use crate::texts::{Text, year as say};

/// Section of the table of annual figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Section {
    /// Daylight autonomy and useful daylight illuminance.
    Light,
    /// Direct sun on the sensors (annual sunlight exposure).
    Sun,
    /// Daylight provision of EN 17037.
    Provision,
    /// Glare at the observers.
    Glare,
    /// Energy and power of the electric lighting.
    Lighting,
    /// Operation of the shading devices.
    Control,
}

impl Section {
    /// Returns the translated label of the section.
    pub const fn words(self) -> Text {
        match self {
            Self::Light => say::SECTION_LIGHT,
            Self::Sun => say::SECTION_SUN,
            Self::Provision => say::SECTION_PROVISION,
            Self::Glare => say::SECTION_GLARE,
            Self::Lighting => say::SECTION_LIGHTING,
            Self::Control => say::SECTION_CONTROL,
        }
    }
}

/// Subject for which a metric is stated: the room, or each of several levels or observers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Subject {
    /// Room: one value, or one list.
    Room,
    /// Each level of daylight provision in EN 17037, by its name in [`LEVELS`].
    Level,
    /// Each observer, counted from 1.
    Observer,
}

impl Subject {
    fn count(self, figures: &Figures) -> usize {
        match self {
            Self::Room => 1,
            Self::Level => LEVELS.len(),
            Self::Observer => figures.glare.len(),
        }
    }

    /// Returns the word that replaces `#` in the key of a metric. `index`: index of the level or observer.
    fn word(self, index: usize) -> String {
        match self {
            Self::Room => String::new(),
            Self::Level => LEVELS[index].0.to_owned(),
            Self::Observer => (index + 1).to_string(),
        }
    }

    fn index(self, word: &str) -> Option<usize> {
        match self {
            Self::Room => None,
            Self::Level => LEVELS.iter().position(|level| level.0 == word),
            Self::Observer => word.parse::<usize>().ok()?.checked_sub(1),
        }
    }
}

/// Part of an annual simulation on which a metric depends, and which is left out unless a metric needs it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// Illuminances by direct sun alone, at sensors and observers.
    DirectSun,
    /// Illuminances in unoccupied hours.
    Unoccupied,
    /// Illuminances with blinds operated by the rule of IES LM-83-12.
    Lm83,
    /// Daylight glare probability (DGP), from the luminances of the apertures.
    Dgp,
    /// Solar energy transmitted through the apertures.
    Solar,
}

/// Value of an annual metric in its unit; shares are 0 … 1.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// Single number.
    Number(f64),
    /// List of numbers: one for each sensor, month, hour of the day or group of blinds.
    List(Vec<f64>),
    /// List of counts: one for each moving aperture.
    Counts(Vec<usize>),
    /// Whether a requirement is met.
    Met(bool),
    /// Name of a class, or of a source of data.
    Word(&'static str),
}

impl Quantity {
    /// Returns the value as a single number: the mean of a list, 1 or 0 for a requirement; `None` for words and empty
    /// lists.
    pub fn number(&self) -> Option<f64> {
        let mean = |sum: f64, count: usize| (count > 0).then(|| sum / count as f64);
        match self {
            Self::Number(value) => Some(*value),
            Self::List(list) => mean(list.iter().sum(), list.len()),
            Self::Counts(list) => mean(list.iter().map(|count| *count as f64).sum(), list.len()),
            Self::Met(met) => Some(f64::from(u8::from(*met))),
            Self::Word(_) => None,
        }
    }
}

/// Year and figures from which the value of a metric is taken: as computed, with less or with more light.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub year: &'a Year,
    pub figures: &'a Figures,
}

/// Default scale of a metric as an objective of a ranking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Whether smaller or larger values of the metric are better.
    pub better: BetterKey,
    /// Value of the metric that gives score 0.
    pub worst: f64,
    /// Value of the metric that gives score 1.
    pub best: f64,
    /// Whether every year has the metric at negligible cost, so that it is computed for every product.
    pub always: bool,
}

impl Scale {
    /// Creates the scale of a metric whose smaller values are better, available in every year.
    pub(super) fn less(worst: f64, best: f64) -> Self {
        Self { better: BetterKey::Less, worst, best, always: true }
    }

    /// Creates the scale of a metric whose larger values are better, available in every year.
    pub(super) fn more(worst: f64, best: f64) -> Self {
        Self { better: BetterKey::More, ..Self::less(worst, best) }
    }

    /// Returns the scale as that of a metric which is computed only on request.
    pub(super) fn on_request(self) -> Self {
        Self { always: false, ..self }
    }
}

/// Sum over hours and places by which a metric is computed, so that it can be split by season, sun and zone.
#[derive(Debug, Clone, Copy)]
pub enum SumOver {
    /// Mean of a function of the illuminance over sensors and steps.
    Sensors {
        /// Whether only occupied steps count.
        occupied: bool,
        /// Function of the illuminance at a sensor. \[lx\]
        of: fn(f64) -> f64,
    },
    /// Energy of the electric lighting over zones and steps, in kWh or in kWh per square metre of floor.
    Lighting {
        /// Whether the energy is that of the whole floor \[kWh\], not per floor area \[kWh/m²\].
        floor: bool,
    },
}

/// Label of an annual metric.
#[derive(Debug, Clone, Copy)]
enum Label {
    /// Key of the metric, if it has no label.
    Key,
    Fixed(Text),
    /// Function that returns the label for the index of the observer or level.
    Numbered(fn(usize) -> String),
}

/// Annual metric: definition of one figure of a year.
#[derive(Debug, Clone, Copy)]
pub struct Metric {
    /// Parts of the key, separated by `/`, in the order of their nesting in JSON; `#` stands for the observer or level.
    path: &'static str,
    subject: Subject,
    label: Label,
    /// Unit of the value; `%` for shares of 0 … 1.
    pub unit: &'static str,
    /// Section of the table of figures, and definition of the metric in one sentence with its source; `None` if the
    /// table leaves it out.
    pub row: Option<(Section, Text)>,
    /// Parts of the simulation that the metric needs.
    pub needs: &'static [Need],
    /// Whether the metric is compared in series that show its error against computing time.
    pub compared: bool,
    /// Sum over hours and places by which the metric is computed; `None` if it is not such a sum.
    pub sum: Option<SumOver>,
    value: fn(&Source<'_>, usize) -> Option<Quantity>,
    compliance: Option<fn([f64; 3]) -> String>,
    scale: Option<fn(&YearKeys) -> Option<Scale>>,
    zero: Option<fn(&Year) -> bool>,
}

impl Metric {
    /// Creates a metric of the room with only a key, a unit and its value; the methods below add the rest.
    pub(super) const fn new(
        path: &'static str,
        unit: &'static str,
        value: fn(&Source<'_>, usize) -> Option<Quantity>,
    ) -> Self {
        Self {
            path,
            subject: Subject::Room,
            label: Label::Key,
            unit,
            row: None,
            needs: &[],
            compared: false,
            sum: None,
            value,
            compliance: None,
            scale: None,
            zero: None,
        }
    }

    /// Makes the metric one that is stated for each level or observer.
    pub(super) const fn of_each(self, subject: Subject) -> Self {
        Self { subject, ..self }
    }

    /// Adds a translated label.
    pub(super) const fn label(self, label: Text) -> Self {
        Self { label: Label::Fixed(label), ..self }
    }

    /// Adds a label that depends on the index of the observer or level.
    pub(super) const fn numbered(self, label: fn(usize) -> String) -> Self {
        Self { label: Label::Numbered(label), ..self }
    }

    /// Adds the metric to a section of the table of figures. `tip`: definition in one sentence with its source.
    pub(super) const fn row(self, section: Section, tip: Text) -> Self {
        Self { row: Some((section, tip)), ..self }
    }

    /// Adds the parts of the simulation that the metric needs.
    pub(super) const fn needs(self, needs: &'static [Need]) -> Self {
        Self { needs, ..self }
    }

    /// Includes the metric in series that show its error against computing time.
    pub(super) const fn compared(self) -> Self {
        Self { compared: true, ..self }
    }

    /// Adds the sum over hours and places by which the metric is computed.
    pub(super) const fn sum(self, sum: SumOver) -> Self {
        Self { sum: Some(sum), ..self }
    }

    /// Adds a text on compliance with a limit. `words`: function that returns it from the value as computed, with less
    /// and with more light.
    pub(super) const fn compliance(self, words: fn([f64; 3]) -> String) -> Self {
        Self { compliance: Some(words), ..self }
    }

    /// Offers the metric as an objective of rankings. `scale`: function that returns its default scale for the keys of
    /// a year, `None` if it is not offered.
    pub(super) const fn objective(self, scale: fn(&YearKeys) -> Option<Scale>) -> Self {
        Self { scale: Some(scale), ..self }
    }

    /// Adds a function that says in which years the metric is exactly zero although the year does not state it.
    pub(super) const fn zero_where(self, zero: fn(&Year) -> bool) -> Self {
        Self { zero: Some(zero), ..self }
    }

    fn path(&self, index: usize) -> String {
        self.path.replace('#', &self.subject.word(index))
    }

    fn key(&self, index: usize) -> String {
        self.path(index).replace('/', ".")
    }

    /// Returns the label of the metric for an observer or level, by index; its key if it has no label.
    pub fn name(&self, index: usize) -> String {
        match self.label {
            Label::Key => self.key(index),
            Label::Fixed(text) => text.to_string(),
            Label::Numbered(label) => label(index),
        }
    }

    /// Whether the metric is exactly zero in a year that does not state it.
    pub fn is_zero(&self, year: &Year) -> bool {
        self.zero.is_some_and(|zero| zero(year))
    }

    fn index(&self, key: &str) -> Option<usize> {
        let path = self.path.replace('/', ".");
        match path.split_once('#') {
            None => (path == key).then_some(0),
            Some((before, after)) => self.subject.index(key.strip_prefix(before)?.strip_suffix(after)?),
        }
    }
}

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
                let found = metric(&key).map(|(found, index)| (found.path, index));
                assert_eq!(found, Some((one.path, index)), "{key}");
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
