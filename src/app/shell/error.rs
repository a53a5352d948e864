//! Errors of the window. They are converted to sentences, in the user's language, only where they are shown.

use crate::catalogue::CatalogueError;
use crate::compute::doctor::RepairError;
use crate::formats::FormatError;
use crate::formats::control_curve::CurveError;
use crate::formats::encoding::{Encoding, NotText};
use crate::report::ReportError;
use crate::study::StudyError;
use crate::study::fault::Fault;
use crate::study::luminaire_file::LuminaireFileError;
use crate::study::luminaire_set::SetError;
use crate::texts::shell;
use std::fmt::Display;

/// Reason why a job ended without a result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JobError {
    /// Panic in the job, with its details.
    #[error("{}", shell::panicked(.0))]
    Panic(Box<Fault>),
    /// Thread for the job that could not be started: message of the operating system.
    #[error("{}", shell::no_thread(.0))]
    NoThread(String),
}

/// Returns the message that a file is not text; `what`: the expected kind of file.
fn not_text(error: &NotText, what: &str) -> String {
    match error.encoding {
        Encoding::WebPage => shell::web_page(what),
        encoding => shell::not_text(encoding.name(), error.byte, what),
    }
}

/// Error of an action in the window.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// Error of the study.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// Job that ended without a result.
    #[error(transparent)]
    Job(#[from] JobError),
    /// Error of the catalogue.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// Data that cannot be read or written in a format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// Invalid control curve.
    #[error("{}", shell::curve_error(.0))]
    Curve(#[from] CurveError),
    /// Error in making a luminaire file.
    #[error(transparent)]
    Luminaire(#[from] LuminaireFileError),
    /// Error in making a set of luminaire files.
    #[error(transparent)]
    Luminaires(#[from] SetError),
    /// Repair that does not fit the data.
    #[error(transparent)]
    Repair(#[from] RepairError),
    /// Threads that cannot be started.
    #[error(transparent)]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// Scene that cannot be written as text.
    #[error("{}", shell::scene_text(.0))]
    SceneText(#[from] toml::ser::Error),
    /// Error in making a report.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// Numbers requested of a tile that has not been drawn since.
    #[error("{}", shell::NO_NUMBERS)]
    NoNumbers,
    /// Action that needs a product, but none is selected.
    #[error("{}", shell::PRODUCT_NOT_THERE)]
    NoProduct,
    /// Series of luminaire files without any date and time with the sun above the horizon.
    #[error("{}", shell::NO_MOMENTS)]
    NoMoments,
    /// Series of too many files: their number, and the maximum.
    #[error("{}", shell::many_files(.0, .1))]
    ManyFiles(usize, usize),
    /// File name for an export with a wrong extension: the right one.
    #[error("{}", shell::wrong_ending(.0))]
    ExportEnding(&'static str),
    /// Picture of a tile that cannot be encoded.
    #[error("{}", shell::no_picture(.0))]
    Picture(#[from] png::EncodingError),
    /// Error with the name or path of the file that it concerns.
    #[error("{0}: {1}")]
    About(String, Box<Self>),
    /// File that is not text: the actual encoding, and the expected kind of file, e.g. `a scene`.
    #[error("{}", not_text(.0, .1))]
    NotText(NotText, &'static str),
    /// File name for a tile's numbers with a wrong extension: that extension.
    #[error("{}", shell::tile_ending(.0))]
    TileEnding(String),
    /// File name for computed data whose extension is not that of a known format.
    #[error("{}", shell::MEASURED_ENDING)]
    MeasuredEnding,
    /// File dialog of the desktop that could not be shown.
    #[error("{}", shell::NO_DIALOG)]
    NoDialog,
    /// Product without states: its name.
    #[error("{}", shell::no_state(.0))]
    NoState(String),
    /// Described system without states.
    #[error("{}", shell::NO_STATES)]
    NoStates,
    /// File that should contain one state but contains this number of states.
    #[error("{}", shell::not_one_state(.0))]
    NotOneState(usize),
    /// Product that does not have one file per state, so that its files cannot be read again.
    #[error("{}", shell::not_a_file_each(files, states))]
    NotAFileEach {
        /// Number of the product's files.
        files: usize,
        /// Number of the product's states.
        states: usize,
    },
    /// Shading control without sky and sun, on which it depends.
    #[error("{}", shell::NO_DAYLIGHT)]
    NoDaylight,
    /// Scene without an aperture.
    #[error("{}", shell::NO_APERTURE)]
    NoAperture,
    /// LID that is not computed yet.
    #[error("{}", shell::NO_LID)]
    NoLid,
}

impl AppError {
    /// Returns the error with the name or path of the file that it concerns.
    pub fn about(self, place: impl Display) -> Self {
        Self::About(place.to_string(), Box::new(self))
    }
}
