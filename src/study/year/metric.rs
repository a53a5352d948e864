//! Annual metric: its key, label, unit and limit, and how its value is taken from the figures of a year.

use super::{Figures, Year};
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
    pub(super) fn count(self, figures: &Figures) -> usize {
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
    pub(super) subject: Subject,
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
    pub(super) value: fn(&Source<'_>, usize) -> Option<Quantity>,
    pub(super) compliance: Option<fn([f64; 3]) -> String>,
    pub(super) scale: Option<fn(&YearKeys) -> Option<Scale>>,
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

    pub(super) fn path(&self, index: usize) -> String {
        self.path.replace('#', &self.subject.word(index))
    }

    pub(super) fn key(&self, index: usize) -> String {
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

    pub(super) fn index(&self, key: &str) -> Option<usize> {
        let path = self.path.replace('/', ".");
        match path.split_once('#') {
            None => (path == key).then_some(0),
            Some((before, after)) => self.subject.index(key.strip_prefix(before)?.strip_suffix(after)?),
        }
    }
}
