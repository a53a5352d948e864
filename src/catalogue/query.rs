//! What is looked for in a catalogue: words, filters, order.

use super::Origin;
use crate::texts::{Text, catalogue as text, fixed, folded};

/// A figure of a product, of the state that stands for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Figure {
    /// Visible transmittance of light from outside at normal incidence.
    TauNormal,
    /// The same under uniform luminance.
    TauHemispherical,
    /// Share of the transmitted light that goes up, to the ceiling.
    ToCeiling,
    /// Share of direct sun that is kept out.
    SunBlocked,
    /// How much of the view to the outside is left.
    View,
}

impl Figure {
    /// All, in the order of lists.
    pub const ALL: [Self; 5] = [Self::TauNormal, Self::TauHemispherical, Self::ToCeiling, Self::SunBlocked, Self::View];
    /// Limits of the ranges that are counted, from below; what is above the last belongs to the last range.
    pub const LIMITS: [f64; 6] = [0.0, 0.05, 0.2, 0.4, 0.6, 0.8];

    /// In words, sentence case.
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

    /// The word on the command line and in JSON.
    pub const fn word(self) -> &'static str {
        match self {
            Self::TauNormal => "tau-normal",
            Self::TauHemispherical => "tau-hemispherical",
            Self::ToCeiling => "to-ceiling",
            Self::SunBlocked => "sun-blocked",
            Self::View => "view",
        }
    }

    /// The range that is counted under a place of [`Figure::LIMITS`].
    pub fn range(self, place: usize) -> Within {
        let high = Self::LIMITS.get(place + 1).copied().unwrap_or(f64::INFINITY);
        Within { figure: self, low: Self::LIMITS[place], high }
    }
}

/// A range of a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Within {
    /// Of what.
    pub figure: Figure,
    /// Least value that belongs to it.
    pub low: f64,
    /// Least value above that does not.
    pub high: f64,
}

impl Within {
    /// Does a value belong to it?
    pub fn holds(&self, value: f64) -> bool {
        value >= self.low && value < self.high
    }

    /// In words, without the figure's name: `0.20 to 0.40`.
    pub fn words(&self) -> String {
        match (self.low > 0.0, self.high.is_finite()) {
            (true, true) => text::between(fixed(self.low, 2), fixed(self.high, 2)),
            (true, false) => text::from(fixed(self.low, 2)),
            (false, true) => text::below(fixed(self.high, 2)),
            (false, false) => text::ANY.into(),
        }
    }
}

/// By what a list is ordered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Sort {
    /// Best match first; without words as the catalogue orders them, built-in products first.
    #[default]
    Match,
    /// By name.
    Name,
    /// By maker, then name.
    Maker,
    /// By kind, then name.
    Kind,
    /// By the number of states.
    States,
    /// By a figure.
    By(Figure),
}

impl Sort {
    /// All, in the order of menus.
    pub fn all() -> impl Iterator<Item = Self> {
        let words = [Self::Match, Self::Name, Self::Maker, Self::Kind, Self::States];
        words.into_iter().chain(Figure::ALL.into_iter().map(Self::By))
    }

    /// In words, sentence case.
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

    /// The word on the command line.
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

/// What is looked for. Everything that is set must hold; the default finds all products.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Query {
    /// Words, each of which must occur in name, maker, kind, tags, key or description, whole or in part; German words for
    /// kinds and tags count. A word that occurs nowhere is read as the nearest one that does. Any input is safe.
    pub text: String,
    /// One of these kinds; empty: any.
    pub kinds: Vec<String>,
    /// One of these makers; empty: any.
    pub manufacturers: Vec<String>,
    /// All of these tags.
    pub tags: Vec<String>,
    /// In one of these collections; empty: whatever it is in.
    pub collections: Vec<String>,
    /// Products of [`Query::shown`] alone.
    pub recent: bool,
    /// Keys of the products that were shown last, the last first: no filter, but what [`Query::recent`] and its count go by.
    pub shown: Vec<String>,
    /// Favourites alone, or all others.
    pub favourite: Option<bool>,
    /// Measured or computed.
    pub origin: Option<Origin>,
    /// Built-in products alone, or the user's.
    pub builtin: Option<bool>,
    /// Products of several states alone, or those of one.
    pub moving: Option<bool>,
    /// Ranges of figures: of one figure any, of different figures all must hold.
    pub ranges: Vec<Within>,
    /// By what the list is ordered.
    pub sort: Sort,
    /// In falling order; of [`Sort::Match`] the worst first.
    pub descending: bool,
    /// Key of a product that the others are to be like: they are found by what they do to light, nearest first where
    /// [`Sort::Match`] orders them.
    pub like: Option<String>,
}

/// One filter of a query.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Filter {
    /// All the words.
    Words,
    /// One of several words, by its place.
    Word(usize),
    /// Kinds.
    Kinds,
    /// Makers.
    Manufacturers,
    /// Tags.
    Tags,
    /// Collections.
    Collections,
    /// Shown last.
    Recent,
    /// Favourites.
    Favourite,
    /// Measured or computed.
    Origin,
    /// Built in or the user's.
    Builtin,
    /// Moving or fixed.
    Moving,
    /// Ranges of one figure.
    Range(Figure),
}

impl Filter {
    /// All but single words.
    pub fn all() -> impl Iterator<Item = Self> {
        use Filter::*;
        let plain = [Words, Kinds, Manufacturers, Tags, Collections, Recent, Favourite, Origin, Builtin, Moving];
        plain.into_iter().chain(Figure::ALL.into_iter().map(Range))
    }
}

/// What is typed between two spaces.
fn typed(text: &str) -> impl Iterator<Item = &str> {
    text.split_whitespace()
}

impl Query {
    /// Is a filter set?
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

    /// The same without a filter.
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

    /// The same with its words alone, in its order.
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

    /// Filters that are set, without the words.
    pub fn filters(&self) -> impl Iterator<Item = Filter> {
        Filter::all().filter(|filter| *filter != Filter::Words && self.has(*filter))
    }

    /// What a filter asks for, in words: `moving`, `venetian or woven`, `τ normal 0.20 to 0.40`.
    pub fn words_of(&self, filter: Filter) -> String {
        let either = |list: &[String]| {
            let words: Vec<&str> =
                list.iter().map(|word| if word.is_empty() { text::NOT_TOLD.get() } else { word.as_str() }).collect();
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

    /// Words as they are compared one by one, with the place of what was typed between spaces.
    pub(super) fn typed_words(&self) -> Vec<(usize, String)> {
        // Sixteen words tell products apart; more would only cost time.
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
            ["laser cut panel or woven", "moving", "τ normal below 0.05 or 0.20 to 0.40", "View from 0.80"]
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
