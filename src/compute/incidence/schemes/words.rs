//! The schemes by name.

/// How to find the indicatrix of a direction between the data's directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum SunScheme {
    /// Bases blended, lobes moved by their own responses: what the program does unless asked.
    #[default]
    Responses,
    /// The report's first: that of the nearest direction. Jumps half way.
    Nearest,
    /// Its second: the nearest, moved as a whole to the interpolated centroid. Jumps half way.
    DisplacedNearest,
    /// Its third: three, each moved as a whole to the interpolated centroid.
    Superposed,
}

impl SunScheme {
    /// All, in the order that lists show.
    pub const ALL: [Self; 4] = [Self::Responses, Self::Nearest, Self::DisplacedNearest, Self::Superposed];

    /// What scenes say for the default, beside its own word.
    pub const AUTO: &'static str = "auto";

    /// The word for it in scenes.
    pub fn key(self) -> &'static str {
        match self {
            Self::Responses => "responses",
            Self::Nearest => "nearest",
            Self::DisplacedNearest => "displaced-nearest",
            Self::Superposed => "superposed",
        }
    }

    /// The scheme of a word.
    pub fn from_key(key: &str) -> Option<Self> {
        if key == Self::AUTO {
            return Some(Self::default());
        }
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }

    /// Whether its result moves smoothly with the sun.
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
