//! Schemes of interpolation and their keys.

/// Scheme that finds the indicatrix of a direction between the data's directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum SunScheme {
    /// Bases blended, lobes moved by their own responses: the default.
    #[default]
    Responses,
    /// First scheme of the report: the indicatrix of the nearest direction. Jumps half way.
    Nearest,
    /// Second scheme of the report: the nearest indicatrix, moved as a whole to the interpolated centroid. Jumps half
    /// way.
    DisplacedNearest,
    /// Third scheme of the report: three indicatrices, each moved as a whole to the interpolated centroid.
    Superposed,
}

impl SunScheme {
    /// All schemes, in the order that lists show.
    pub const ALL: [Self; 4] = [Self::Responses, Self::Nearest, Self::DisplacedNearest, Self::Superposed];

    /// Key of the default in scenes, beside the default's own key.
    pub const AUTO: &'static str = "auto";

    /// Returns the key in scenes.
    pub fn key(self) -> &'static str {
        match self {
            Self::Responses => "responses",
            Self::Nearest => "nearest",
            Self::DisplacedNearest => "displaced-nearest",
            Self::Superposed => "superposed",
        }
    }

    /// Returns the scheme of a key.
    pub fn from_key(key: &str) -> Option<Self> {
        if key == Self::AUTO {
            return Some(Self::default());
        }
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }

    /// Whether the result moves smoothly with the sun.
    pub fn is_continuous(self) -> bool {
        !matches!(self, Self::Nearest | Self::DisplacedNearest)
    }
}

/// Scheme by which diffuse light passes through indicatrices known at single directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum DiffuseScheme {
    /// Choice by the program.
    #[default]
    Auto,
    /// Sub-patches finer than the lattice, each with its own interpolated indicatrix.
    Shift,
    /// Indicatrix of every direction, used as given for its patch.
    Patch,
    /// The report's mean filter (eq 13), half as wide as patches.
    FilterNarrow,
    /// The report's mean filter (eq 13), as wide as patches.
    FilterMatched,
    /// The report's mean filter (eq 13), twice as wide as patches.
    FilterWide,
    /// Filter with the shape of every patch itself, on the sharp part alone.
    FilterPatch,
}

impl DiffuseScheme {
    /// All schemes, in the order that lists show.
    pub const ALL: [Self; 7] = [
        Self::Auto,
        Self::Shift,
        Self::Patch,
        Self::FilterNarrow,
        Self::FilterMatched,
        Self::FilterWide,
        Self::FilterPatch,
    ];

    /// Returns the key in scenes and on the command line.
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

    /// Returns the scheme of a key.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }
}
