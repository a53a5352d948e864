//! The schemes by name.

/// How to find the indicatrix of a direction between the data's directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum SunScheme {
    /// At every vertex the scheme that predicts it and those around best without it; see [`choice`](crate::compute::incidence::choice).
    #[default]
    Auto,
    /// That of the nearest direction. Jumps half way.
    Nearest,
    /// The nearest, moved as a whole to the interpolated centroid. Jumps half way.
    DisplacedNearest,
    /// Three, each moved as a whole to the interpolated centroid.
    Superposed,
    /// Bases blended, lobes paired and moved to their mean.
    MatchedLobes,
    /// Bases blended, lobes moved by their own responses.
    Responses,
    /// Bases blended, the rest moved by optimal transport.
    Transport,
}

impl SunScheme {
    /// All, in the order that lists show.
    pub const ALL: [Self; 7] = [
        Self::Auto,
        Self::Nearest,
        Self::DisplacedNearest,
        Self::Superposed,
        Self::MatchedLobes,
        Self::Responses,
        Self::Transport,
    ];

    /// All but the automatic one.
    pub const PLAIN: [Self; 6] =
        [Self::Nearest, Self::DisplacedNearest, Self::Superposed, Self::MatchedLobes, Self::Responses, Self::Transport];

    /// The word for it in scenes and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Nearest => "nearest",
            Self::DisplacedNearest => "displaced-nearest",
            Self::Superposed => "superposed",
            Self::MatchedLobes => "matched-lobes",
            Self::Responses => "responses",
            Self::Transport => "transport",
        }
    }

    /// The scheme of a word.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }

    /// Whether its result moves smoothly with the sun: a condition for being chosen automatically.
    pub fn is_continuous(self) -> bool {
        !matches!(self, Self::Nearest | Self::DisplacedNearest)
    }
}

/// How diffuse light goes through indicatrices known at single directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum DiffuseScheme {
    /// The program chooses.
    #[default]
    Auto,
    /// Sub-patches finer than the lattice, each with its own interpolated indicatrix.
    Shift,
    /// Every direction stands for its patch as it is.
    Patch,
    /// The report's mean filter (eq 13), half as wide as patches.
    FilterNarrow,
    /// The same, as wide as patches.
    FilterMatched,
    /// The same, twice as wide.
    FilterWide,
    /// The filter with the shape of every patch itself, on the sharp part alone.
    FilterPatch,
}

impl DiffuseScheme {
    /// All, in the order that lists show.
    pub const ALL: [Self; 7] = [
        Self::Auto,
        Self::Shift,
        Self::Patch,
        Self::FilterNarrow,
        Self::FilterMatched,
        Self::FilterWide,
        Self::FilterPatch,
    ];

    /// The word for it in scenes and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Shift => "shift",
            Self::Patch => "patch",
            Self::FilterNarrow => "filter-narrow",
            Self::FilterMatched => "filter-matched",
            Self::FilterWide => "filter-wide",
            Self::FilterPatch => "filter-patch",
        }
    }

    /// The scheme of a word.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }
}
