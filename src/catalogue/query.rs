//! Query of a catalogue: search text, filters and order of the results.

use super::Origin;
use crate::texts::{Text, catalogue as text, fixed, folded};

/// Figure of a product by which lists are filtered and sorted, taken from the state that represents the product; always
/// a share of the incident flux, 0 … 1, or of the transmitted flux for [`Figure::ToCeiling`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Figure {
    /// Visible transmittance τ of light from outside at normal incidence.
    TauNormal,
    /// Visible hemispherical transmittance τ: of light from outside under uniform luminance.
    TauHemispherical,
    /// Share of the transmitted flux that leaves upwards, to the ceiling, under a sky of uniform luminance.
    ToCeiling,
    /// Share of direct sunlight that is not transmitted, 1 − τ, for the sun at 45° altitude, perpendicular to the
    /// façade in plan.
    SunBlocked,
    /// Normal–normal transmittance: share of the light at normal incidence that is transmitted undeviated.
    View,
}

impl Figure {
    /// All figures, in the order of lists.
    pub const ALL: [Self; 5] = [Self::TauNormal, Self::TauHemispherical, Self::ToCeiling, Self::SunBlocked, Self::View];
    /// Lower limits of the ranges in which values of a figure are counted, rising. The last range has no upper limit.
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

    /// Returns the stable key that is used on the command line and in JSON.
    pub const fn word(self) -> &'static str {
        match self {
            Self::TauNormal => "tau-normal",
            Self::TauHemispherical => "tau-hemispherical",
            Self::ToCeiling => "to-ceiling",
            Self::SunBlocked => "sun-blocked",
            Self::View => "view",
        }
    }

    /// Returns the range of values that begins at `LIMITS[place]`.
    pub fn range(self, place: usize) -> Within {
        let high = Self::LIMITS.get(place + 1).copied().unwrap_or(f64::INFINITY);
        Within { figure: self, low: Self::LIMITS[place], high }
    }
}

/// Range of values of a figure, as a filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Within {
    /// Figure whose values the range limits.
    pub figure: Figure,
    /// Lower limit, which belongs to the range.
    pub low: f64,
    /// Upper limit, which does not belong to the range.
    pub high: f64,
}

impl Within {
    /// Whether `value` is inside the range.
    pub fn holds(&self, value: f64) -> bool {
        value >= self.low && value < self.high
    }

    /// Returns the range as a translated text without the name of the figure, such as `0.20 to 0.40`.
    pub fn words(&self) -> String {
        match (self.low > 0.0, self.high.is_finite()) {
            (true, true) => text::between(fixed(self.low, 2), fixed(self.high, 2)),
            (true, false) => text::from(fixed(self.low, 2)),
            (false, true) => text::below(fixed(self.high, 2)),
            (false, false) => text::ANY.into(),
        }
    }
}

/// Criterion by which a list of products is sorted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Sort {
    /// Best match first. Without search words: the order of the catalogue, built-in products first.
    #[default]
    Match,
    /// Name of the product.
    Name,
    /// Maker, then name of the product.
    Maker,
    /// Kind, then name of the product.
    Kind,
    /// Number of states.
    States,
    /// Value of a figure, such as the transmittance at normal incidence.
    By(Figure),
}

impl Sort {
    /// Returns all criteria, in the order of menus.
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

    /// Returns the stable key that is used on the command line.
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

/// Query of the catalogue. A product must pass all filters that are set; the default finds all products.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Query {
    /// Search words, each of which must occur in name, maker, kind, tags, key or description, whole or in part; German
    /// words for kinds and tags count. In place of a word that occurs nowhere the most similar one is searched for. Any
    /// input is safe.
    pub text: String,
    /// Kinds, one of which the product must have. Empty: any kind.
    pub kinds: Vec<String>,
    /// Makers, one of which the product must have. Empty: any maker.
    pub manufacturers: Vec<String>,
    /// Tags, all of which the product must have.
    pub tags: Vec<String>,
    /// Names of collections, one of which must contain the product. Empty: no restriction.
    pub collections: Vec<String>,
    /// Whether only recently shown products are found, those of [`Query::shown`].
    pub recent: bool,
    /// Keys of the products shown most recently, newest first. It is not a filter: [`Query::recent`] and the count of
    /// recent products use it.
    pub shown: Vec<String>,
    /// Favourites only (`true`) or all others (`false`). `None`: both.
    pub favourite: Option<bool>,
    /// Origin that the data must have, measured or computed. `None`: any.
    pub origin: Option<Origin>,
    /// Built-in products only (`true`) or the user's only (`false`). `None`: both.
    pub builtin: Option<bool>,
    /// Only products with several states (`true`) or only those with one state (`false`). `None`: both.
    pub moving: Option<bool>,
    /// Ranges of figures that a product must be in. Of several ranges of one figure any may hold; for different figures
    /// all must hold.
    pub ranges: Vec<Within>,
    /// Criterion by which the results are sorted.
    pub sort: Sort,
    /// Whether the order is reversed: falling values, or the poorest match at the top with [`Sort::Match`].
    pub descending: bool,
    /// Key of a product; the results are then compared with it by their effect on light. With [`Sort::Match`] the most
    /// similar ones come at the top.
    pub like: Option<String>,
}

/// One of the filters that a query can set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Filter {
    /// All search words.
    Words,
    /// One search word, by its position in the text.
    Word(usize),
    /// Kind of product.
    Kinds,
    /// Maker of the product.
    Manufacturers,
    /// Tags of the product.
    Tags,
    /// Collections that contain the product.
    Collections,
    /// Whether the product was shown recently.
    Recent,
    /// Whether the product is a favourite.
    Favourite,
    /// Origin of the data, measured or computed.
    Origin,
    /// Whether the product is built in or the user's.
    Builtin,
    /// Whether the product has several states or one.
    Moving,
    /// Range of one figure.
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
    /// Whether the query restricts the results by this filter.
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

    /// Returns a copy of the query in which one filter is not set.
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

    /// Returns a copy of the query with only its search words and its order.
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

    /// Returns the filters that the query sets, except the search words.
    pub fn filters(&self) -> impl Iterator<Item = Filter> {
        Filter::all().filter(|filter| *filter != Filter::Words && self.has(*filter))
    }

    /// Returns the condition that the query sets for a filter, as a translated text such as `moving`, `venetian or
    /// woven`, `τ normal 0.20 to 0.40`.
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

    /// Returns the search words in the form in which they are compared with those of products, each with the index of
    /// the typed word (between spaces) from which it came.
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
