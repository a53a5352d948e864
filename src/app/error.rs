//! Why the window could not do what it was asked. Only where an error is shown does it become the sentence that it
//! stands for.

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

/// Why a job ended without a result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JobError {
    /// It panicked; what is known of it.
    #[error("{}", shell::panicked(.0))]
    Panic(Box<Fault>),
    /// It was never started; what the system says.
    #[error("{}", shell::no_thread(.0))]
    NoThread(String),
}

/// Says why bytes are not the text of `what`.
fn not_text(error: &NotText, what: &str) -> String {
    match error.encoding {
        Encoding::WebPage => shell::web_page(what),
        encoding => shell::not_text(encoding.name(), error.byte, what),
    }
}

/// Why the window could not do what it was asked.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The study cannot be made.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A job came to nothing.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The catalogue refuses.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// Data that cannot be read or written in a format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// No control curve.
    #[error("{}", shell::curve_error(.0))]
    Curve(#[from] CurveError),
    /// No luminaire file can be made.
    #[error(transparent)]
    Luminaire(#[from] LuminaireFileError),
    /// No luminaire files can be made.
    #[error(transparent)]
    Luminaires(#[from] SetError),
    /// A repair that does not fit the data.
    #[error(transparent)]
    Repair(#[from] RepairError),
    /// Threads that cannot be started.
    #[error(transparent)]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The scene has no text.
    #[error("{}", shell::scene_text(.0))]
    SceneText(#[from] toml::ser::Error),
    /// Nothing can be handed on.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A tile has not been drawn since it was asked for its numbers.
    #[error("{}", shell::NO_NUMBERS)]
    NoNumbers,
    /// Something is asked of a product that is not there.
    #[error("{}", shell::PRODUCT_NOT_THERE)]
    NoProduct,
    /// A series without moments.
    #[error("{}", shell::NO_MOMENTS)]
    NoMoments,
    /// A series of too many files: how many, and how many at most.
    #[error("{}", shell::many_files(.0, .1))]
    ManyFiles(usize, usize),
    /// A name with another ending than what it is.
    #[error("{}", shell::wrong_ending(.0))]
    HandOnEnding(&'static str),
    /// A tile's picture has no file.
    #[error("{}", shell::no_picture(.0))]
    Picture(#[from] png::EncodingError),
    /// An error that is about a file of this name or path.
    #[error("{0}: {1}")]
    About(String, Box<Self>),
    /// Bytes where text is expected: what they are, and what is expected, e.g. `a scene`.
    #[error("{}", not_text(.0, .1))]
    NotText(NotText, &'static str),
    /// An ending other than that of a tile's numbers.
    #[error("{}", shell::tile_ending(.0))]
    TileEnding(String),
    /// A path for computed data whose ending names no format.
    #[error("{}", shell::MEASURED_ENDING)]
    MeasuredEnding,
    /// No file dialog can be shown here.
    #[error("{}", shell::NO_DIALOG)]
    NoDialog,
    /// A product without states.
    #[error("{}", shell::no_state(.0))]
    NoState(String),
    /// A described system without states.
    #[error("{}", shell::NO_STATES)]
    NoStates,
    /// A file for one state that holds another number of them.
    #[error("{}", shell::not_one_state(.0))]
    NotOneState(usize),
    /// A product whose files cannot be read again one by one.
    #[error("{}", shell::not_a_file_each(files, states))]
    NotAFileEach {
        /// Files.
        files: usize,
        /// States.
        states: usize,
    },
    /// Control has no sky and sun to go by.
    #[error("{}", shell::NO_DAYLIGHT)]
    NoDaylight,
    /// A scene without an aperture.
    #[error("{}", shell::NO_APERTURE)]
    NoAperture,
    /// The LID is asked for before it is there.
    #[error("{}", shell::NO_LID)]
    NoLid,
}

impl AppError {
    /// The same, about a file.
    pub fn about(self, place: impl Display) -> Self {
        Self::About(place.to_string(), Box::new(self))
    }
}
