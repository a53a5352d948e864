//! Schemes of interpolation between incident directions, and their keys.

/// Scheme that interpolates the indicatrix (q over the emergent directions) of the sun's direction between the incident
/// directions of measured data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum SunScheme {
    /// Default: smooth bases are blended with barycentric weights, and every lobe is shifted by its response, the
    /// change of its centre with the incident direction.
    #[default]
    Responses,
    /// First scheme of the IEA SHC Task 31 report: the indicatrix of the nearest incident direction. Discontinuous half
    /// way between directions.
    Nearest,
    /// Second scheme of the IEA SHC Task 31 report: the indicatrix of the nearest incident direction, rotated as a
    /// whole to the interpolated flux centroid. Discontinuous half way between directions.
    DisplacedNearest,
    /// Third scheme of the IEA SHC Task 31 report: weighted sum of the three surrounding indicatrices, each rotated as
    /// a whole to the interpolated flux centroid.
    Superposed,
}

impl SunScheme {
    /// All schemes, in the order of lists in the window.
    pub const ALL: [Self; 4] = [Self::Responses, Self::Nearest, Self::DisplacedNearest, Self::Superposed];

    /// Second key of the default scheme in scene files, beside its key `responses`.
    pub const AUTO: &'static str = "auto";

    /// Returns the key of the scheme in scene files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Responses => "responses",
            Self::Nearest => "nearest",
            Self::DisplacedNearest => "displaced-nearest",
            Self::Superposed => "superposed",
        }
    }

    /// Returns the scheme with this key; `None` if there is none.
    pub fn from_key(key: &str) -> Option<Self> {
        if key == Self::AUTO {
            return Some(Self::default());
        }
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }

    /// Whether the interpolated indicatrix changes continuously with the sun's direction.
    pub fn is_continuous(self) -> bool {
        !matches!(self, Self::Nearest | Self::DisplacedNearest)
    }
}

/// Scheme that computes the transmission of diffuse light (sky, ground) from indicatrices measured at single incident
/// directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum DiffuseScheme {
    /// Automatic choice between the schemes by the program.
    #[default]
    Auto,
    /// Sub-patches finer than the spacing of the incident directions, each with its own interpolated indicatrix.
    Shift,
    /// Indicatrix of every incident direction, used as given for the whole patch that the direction represents.
    Patch,
    /// Mean filter by eq 13 of the IEA SHC Task 31 report with a circular kernel half as wide as the patches (6°).
    FilterNarrow,
    /// Mean filter by eq 13 of the IEA SHC Task 31 report with a circular kernel as wide as the patches (12°).
    FilterMatched,
    /// Mean filter by eq 13 of the IEA SHC Task 31 report with a circular kernel twice as wide as the patches (24°).
    FilterWide,
    /// Mean filter with the shape of each patch as its kernel, applied to the lobes of the indicatrices alone.
    FilterPatch,
}

impl DiffuseScheme {
    /// All schemes, in the order of lists in the window.
    pub const ALL: [Self; 7] = [
        Self::Auto,
        Self::Shift,
        Self::Patch,
        Self::FilterNarrow,
        Self::FilterMatched,
        Self::FilterWide,
        Self::FilterPatch,
    ];

    /// Returns the key of the scheme in scene files and on the command line.
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

    /// Returns the scheme with this key; `None` if there is none.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }
}
