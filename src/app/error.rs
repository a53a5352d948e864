//! Errors of the window. An error becomes a sentence only where it is shown.

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
    /// Panic of the job, with its details.
    #[error("{}", shell::panicked(.0))]
    Panic(Box<Fault>),
    /// Thread that could not be started, with the message of the system.
    #[error("{}", shell::no_thread(.0))]
    NoThread(String),
}

/// Returns the message why bytes are not the text of `what`.
fn not_text(error: &NotText, what: &str) -> String {
    match error.encoding {
        Encoding::WebPage => shell::web_page(what),
        encoding => shell::not_text(encoding.name(), error.byte, what),
    }
}

/// Error of an action of the window.
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
    /// Tile that has not been drawn since its numbers were requested.
    #[error("{}", shell::NO_NUMBERS)]
    NoNumbers,
    /// Missing product.
    #[error("{}", shell::PRODUCT_NOT_THERE)]
    NoProduct,
    /// Series without moments.
    #[error("{}", shell::NO_MOMENTS)]
    NoMoments,
    /// Series of too many files: their number, and the maximum.
    #[error("{}", shell::many_files(.0, .1))]
    ManyFiles(usize, usize),
    /// File name with a wrong extension, and the right one.
    #[error("{}", shell::wrong_ending(.0))]
    ExportEnding(&'static str),
    /// Picture of a tile that cannot be encoded.
    #[error("{}", shell::no_picture(.0))]
    Picture(#[from] png::EncodingError),
    /// Error about the file with this name or path.
    #[error("{0}: {1}")]
    About(String, Box<Self>),
    /// Bytes where text is expected: their encoding, and what is expected, e.g. `a scene`.
    #[error("{}", not_text(.0, .1))]
    NotText(NotText, &'static str),
    /// Wrong extension for a tile's numbers.
    #[error("{}", shell::tile_ending(.0))]
    TileEnding(String),
    /// Path for computed data whose extension names no format.
    #[error("{}", shell::MEASURED_ENDING)]
    MeasuredEnding,
    /// Missing file dialog of the desktop.
    #[error("{}", shell::NO_DIALOG)]
    NoDialog,
    /// Product without states.
    #[error("{}", shell::no_state(.0))]
    NoState(String),
    /// Described system without states.
    #[error("{}", shell::NO_STATES)]
    NoStates,
    /// File for one state that holds this number of states instead.
    #[error("{}", shell::not_one_state(.0))]
    NotOneState(usize),
    /// Product whose files cannot be read again one per state.
    #[error("{}", shell::not_a_file_each(files, states))]
    NotAFileEach {
        /// Number of files.
        files: usize,
        /// Number of states.
        states: usize,
    },
    /// Missing sky and sun for shading control.
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
