//! Query of a catalogue: search text, filters and order.

use super::Origin;
use crate::texts::{Text, catalogue as text, fixed, folded};

/// Figure of a product, taken from the state that represents it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Figure {
    /// Visible transmittance of light from outside at normal incidence.
    TauNormal,
    /// Visible transmittance of light from outside under uniform luminance.
    TauHemispherical,
    /// Share of the transmitted light that leaves upwards, to the ceiling.
    ToCeiling,
    /// Share of direct sun blocked, 1 − τ, at 45° solar altitude, perpendicular to the façade in plan.
    SunBlocked,
    /// Share of light at normal incidence that is transmitted undeviated (normal–normal transmittance).
    View,
}

impl Figure {
    /// All figures, in the order of lists.
    pub const ALL: [Self; 5] = [Self::TauNormal, Self::TauHemispherical, Self::ToCeiling, Self::SunBlocked, Self::View];
    /// Lower limits of the ranges that are counted, rising. The last range has no upper limit.
    pub const LIMITS: [f64; 6] = [0.0, 0.05, 0.2, 0.4, 0.6, 0.8];

    /// Returns the translated label, in sentence case.
    pub fn words(self) -> &'static str {
        let text = match self {
            Self::TauNormal => text::TAU_NORMAL,
            Self::TauHemispherical => text::TAU_HEMISPHERICAL,
            Self::ToCeiling => text::TO_CEILING,
            Self::SunBlocked => text::SUN_BLOCKED,
            Self::View => text::VIEW,
        };
        text.get()
    }

    /// Returns the key on the command line and in JSON.
    pub const fn word(self) -> &'static str {
        match self {
            Self::TauNormal => "tau-normal",
            Self::TauHemispherical => "tau-hemispherical",
            Self::ToCeiling => "to-ceiling",
            Self::SunBlocked => "sun-blocked",
            Self::View => "view",
        }
    }

    /// Returns the counted range that begins at `LIMITS[place]`.
    pub fn range(self, place: usize) -> Within {
        let high = Self::LIMITS.get(place + 1).copied().unwrap_or(f64::INFINITY);
        Within { figure: self, low: Self::LIMITS[place], high }
    }
}

/// Range of a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Within {
    /// Figure that the range limits.
    pub figure: Figure,
    /// Smallest value inside the range.
    pub low: f64,
    /// Smallest value above the range, which is outside it.
    pub high: f64,
}

impl Within {
    /// Whether `value` is inside the range.
    pub fn holds(&self, value: f64) -> bool {
        value >= self.low && value < self.high
    }

    /// Returns the range as a translated text without the figure's name: `0.20 to 0.40`.
    pub fn words(&self) -> String {
        match (self.low > 0.0, self.high.is_finite()) {
            (true, true) => text::between(fixed(self.low, 2), fixed(self.high, 2)),
            (true, false) => text::from(fixed(self.low, 2)),
            (false, true) => text::below(fixed(self.high, 2)),
            (false, false) => text::ANY.into(),
        }
    }
}

/// Order of a list of products.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Sort {
    /// Best match first. Without words: the order of the catalogue, built-in products first.
    #[default]
    Match,
    /// Name.
    Name,
    /// Maker, then name.
    Maker,
    /// Kind, then name.
    Kind,
    /// Number of states.
    States,
    /// Value of a figure.
    By(Figure),
}

impl Sort {
    /// Returns all orders, as menus list them.
    pub fn all() -> impl Iterator<Item = Self> {
        let words = [Self::Match, Self::Name, Self::Maker, Self::Kind, Self::States];
        words.into_iter().chain(Figure::ALL.into_iter().map(Self::By))
    }

    /// Returns the translated label, in sentence case.
    pub fn words(self) -> &'static str {
        let text = match self {
            Self::Match => text::BEST_MATCH,
            Self::Name => text::NAME,
            Self::Maker => text::MAKER,
            Self::Kind => text::KIND,
            Self::States => text::STATES,
            Self::By(figure) => return figure.words(),
        };
        text.get()
    }

    /// Returns the key on the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Match => "match",
            Self::Name => "name",
            Self::Maker => "maker",
            Self::Kind => "kind",
            Self::States => "states",
            Self::By(figure) => figure.word(),
        }
    }
}

/// Search for products. All filters that are set must hold; the default finds all products.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Query {
    /// Words, each of which must occur in name, maker, kind, tags, key or description, whole or in part; German words
    /// for kinds and tags count. A word that occurs nowhere is read as the nearest one that does. Any input is safe.
    pub text: String,
    /// Kinds, one of which the product must have. Empty: any kind.
    pub kinds: Vec<String>,
    /// Makers, one of which the product must have. Empty: any maker.
    pub manufacturers: Vec<String>,
    /// Tags, all of which the product must have.
    pub tags: Vec<String>,
    /// Collections, one of which must contain the product. Empty: no restriction.
    pub collections: Vec<String>,
    /// Whether only products of [`Query::shown`] are found.
    pub recent: bool,
    /// Keys of the products shown most recently, newest first. No filter: [`Query::recent`] and its count use it.
    pub shown: Vec<String>,
    /// Favourites only (`true`) or all others (`false`). `None`: both.
    pub favourite: Option<bool>,
    /// Origin that the data must have, measured or computed. `None`: any.
    pub origin: Option<Origin>,
    /// Built-in products only (`true`) or the user's only (`false`). `None`: both.
    pub builtin: Option<bool>,
    /// Products with several states only (`true`) or with one state (`false`). `None`: both.
    pub moving: Option<bool>,
    /// Ranges of figures. Of one figure any range may hold, of different figures all must hold.
    pub ranges: Vec<Within>,
    /// Order of the list.
    pub sort: Sort,
    /// Whether the order is reversed: falling values; with [`Sort::Match`] the poorest match comes at the top.
    pub descending: bool,
    /// Key of a product to which similar ones are found, by their effect on light. With [`Sort::Match`] the nearest
    /// come at the top.
    pub like: Option<String>,
}

/// Filter of a query.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Filter {
    /// All words of the text.
    Words,
    /// Word of the text, by its index.
    Word(usize),
    /// Kinds.
    Kinds,
    /// Makers.
    Manufacturers,
    /// Tags.
    Tags,
    /// Collections.
    Collections,
    /// Products shown most recently.
    Recent,
    /// Favourites.
    Favourite,
    /// Origin of the data, measured or computed.
    Origin,
    /// Built-in products or the user's.
    Builtin,
    /// Products with several states or with one.
    Moving,
    /// Ranges of one figure.
    Range(Figure),
}

impl Filter {
    /// Returns all filters except single words.
    pub fn all() -> impl Iterator<Item = Self> {
        use Filter::*;
        let plain = [Words, Kinds, Manufacturers, Tags, Collections, Recent, Favourite, Origin, Builtin, Moving];
        plain.into_iter().chain(Figure::ALL.into_iter().map(Range))
    }
}

/// Splits a text at white space.
fn typed(text: &str) -> impl Iterator<Item = &str> {
    text.split_whitespace()
}

impl Query {
    /// Whether `filter` is set.
    pub fn has(&self, filter: Filter) -> bool {
        match filter {
            Filter::Words => !self.text.trim().is_empty(),
            Filter::Word(place) => typed(&self.text).nth(place).is_some() && typed(&self.text).nth(1).is_some(),
            Filter::Kinds => !self.kinds.is_empty(),
            Filter::Manufacturers => !self.manufacturers.is_empty(),
            Filter::Tags => !self.tags.is_empty(),
            Filter::Collections => !self.collections.is_empty(),
            Filter::Recent => self.recent,
            Filter::Favourite => self.favourite.is_some(),
            Filter::Origin => self.origin.is_some(),
            Filter::Builtin => self.builtin.is_some(),
            Filter::Moving => self.moving.is_some(),
            Filter::Range(figure) => self.ranges.iter().any(|range| range.figure == figure),
        }
    }

    /// Returns a copy in which `filter` is not set.
    #[must_use]
    pub fn without(&self, filter: Filter) -> Self {
        let mut query = self.clone();
        match filter {
            Filter::Words => query.text.clear(),
            Filter::Word(place) => {
                let left = typed(&self.text).enumerate().filter(|(at, _)| *at != place).map(|(_, word)| word);
                query.text = left.collect::<Vec<_>>().join(" ");
            }
            Filter::Kinds => query.kinds.clear(),
            Filter::Manufacturers => query.manufacturers.clear(),
            Filter::Tags => query.tags.clear(),
            Filter::Collections => query.collections.clear(),
            Filter::Recent => query.recent = false,
            Filter::Favourite => query.favourite = None,
            Filter::Origin => query.origin = None,
            Filter::Builtin => query.builtin = None,
            Filter::Moving => query.moving = None,
            Filter::Range(figure) => query.ranges.retain(|range| range.figure != figure),
        }
        query
    }

    /// Returns a copy that keeps only the words and the order.
    #[must_use]
    pub fn words_alone(&self) -> Self {
        Self {
            text: self.text.clone(),
            sort: self.sort,
            descending: self.descending,
            like: self.like.clone(),
            ..Self::default()
        }
    }

    /// Returns the filters that are set, except the words.
    pub fn filters(&self) -> impl Iterator<Item = Filter> {
        Filter::all().filter(|filter| *filter != Filter::Words && self.has(*filter))
    }

    /// Returns the condition of a filter as a translated text: `moving`, `venetian or woven`, `τ normal 0.20 to 0.40`.
    pub fn words_of(&self, filter: Filter) -> String {
        let either = |list: &[String]| {
            let words: Vec<&str> = list
                .iter()
                .map(|word| if word.is_empty() { text::NOT_SPECIFIED.get() } else { word.as_str() })
                .collect();
            words.join(text::OR.get())
        };
        let one_of = |choice: Option<bool>, [yes, no]: [Text; 2]| match choice {
            Some(true) => yes.into(),
            Some(false) => no.into(),
            None => String::new(),
        };
        match filter {
            Filter::Words => self.text.trim().to_owned(),
            Filter::Word(place) => typed(&self.text).nth(place).unwrap_or_default().to_owned(),
            Filter::Kinds => either(&self.kinds).replace('-', " "),
            Filter::Manufacturers => either(&self.manufacturers),
            Filter::Tags => self.tags.join(text::AND.get()),
            Filter::Collections => either(&self.collections),
            Filter::Recent => text::RECENT_CHIP.into(),
            Filter::Favourite => one_of(self.favourite, [text::STARRED, text::NOT_STARRED]),
            Filter::Origin => self.origin.map(|origin| origin.words().into()).unwrap_or_default(),
            Filter::Builtin => one_of(self.builtin, [text::BUILT_IN, text::YOUR_OWN]),
            Filter::Moving => one_of(self.moving, [text::MOVING, text::FIXED]),
            Filter::Range(figure) => {
                let ranges = self.ranges.iter().filter(|range| range.figure == figure);
                let words: Vec<String> = ranges.map(Within::words).collect();
                format!("{} {}", figure.words(), words.join(text::OR.get()))
            }
        }
    }

    /// Returns the typed words in the form in which they are compared, each with the index of the text between spaces
    /// it came from.
    pub(super) fn typed_words(&self) -> Vec<(usize, String)> {
        // Sixteen words are enough to distinguish products; more would only cost time.
        const MOST: usize = 16;
        let of = |(place, text): (usize, &str)| {
            let folded = folded(text);
            let runs = super::words::runs(&folded);
            runs.map(|run| (place, run.chars().take(super::words::LONGEST).collect())).collect::<Vec<(usize, String)>>()
        };
        typed(&self.text).enumerate().flat_map(of).take(MOST).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_are_told_and_taken_out_one_by_one() {
        let query = Query {
            text: "blind  80/72".into(),
            kinds: vec!["laser-cut-panel".into(), "woven".into()],
            moving: Some(true),
            ranges: vec![Figure::TauNormal.range(0), Figure::TauNormal.range(2), Figure::View.range(5)],
            ..Query::default()
        };
        let words: Vec<String> = query.filters().map(|filter| query.words_of(filter)).collect();
        assert_eq!(
            words,
            ["laser cut panel or woven", "movable", "τ normal below 0.05 or 0.20 to 0.40", "View from 0.80"]
        );
        assert_eq!(query.without(Filter::Range(Figure::TauNormal)).ranges, [Figure::View.range(5)]);
        assert_eq!(query.without(Filter::Word(0)).text, "80/72");
        assert_eq!(query.typed_words(), [(0, "blind".to_owned()), (1, "80".to_owned()), (1, "72".to_owned())]);
        let bare = query.filters().fold(query.clone(), |left, filter| left.without(filter));
        assert_eq!(bare, query.words_alone());
    }

    #[test]
    fn every_value_belongs_to_one_range() {
        for value in [0.0, 0.049, 0.05, 0.2, 0.399, 0.4, 0.79, 0.8, 1.0, 1.2] {
            let holds = (0..Figure::LIMITS.len()).filter(|place| Figure::View.range(*place).holds(value)).count();
            assert_eq!(holds, 1, "{value}");
        }
    }
}
