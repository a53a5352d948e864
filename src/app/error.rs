//! Why the window could not do what it was asked. Only where an error is shown does it become the sentence that it
//! stands for.

use crate::catalogue::CatalogueError;
use crate::compute::doctor::RepairError;
use crate::formats::FormatError;
use crate::formats::control_curve::CurveError;
use crate::report::ReportError;
use crate::study::StudyError;
use crate::study::luminaire_file::LuminaireFileError;
use std::fmt::Display;

/// Why a job ended without a result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JobError {
    /// It panicked; what it said.
    #[error("the computation stopped at a fault of the program ({0}); what is shown is the last good result")]
    Panic(String),
    /// It was never started; what the system says.
    #[error("no thread for this job could be started ({0}); close other programs and try again")]
    NoThread(String),
}

/// Why the window could not do what it was asked.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The study cannot be made.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The catalogue refuses.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// Data that cannot be read or written in a format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// No control curve.
    #[error("as a control curve: {0}")]
    Curve(#[from] CurveError),
    /// No luminaire file can be made.
    #[error(transparent)]
    Luminaire(#[from] LuminaireFileError),
    /// A repair that does not fit the data.
    #[error(transparent)]
    Repair(#[from] RepairError),
    /// Threads that cannot be started.
    #[error(transparent)]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The scene has no text.
    #[error("the scene cannot be written as text: {0}")]
    SceneText(#[from] toml::ser::Error),
    /// Nothing can be handed on.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A tile has not been drawn since it was asked for its numbers.
    #[error("the tile has not given its numbers yet: wait for the preview, then write again")]
    NoNumbers,
    /// Something is asked of a product that is not there.
    #[error("the product and its data are not there yet: choose a product and wait for its tiles, then write again")]
    NoProduct,
    /// A series without moments.
    #[error(
        "no file would be written: choose months and hours with the sun above the horizon, for a scene with place and date"
    )]
    NoMoments,
    /// A series of too many files: how many, and how many at most.
    #[error("{0} files would be written; expected at most {1}: choose fewer months, hours or states")]
    ManyFiles(usize, usize),
    /// A name with another ending than what it is.
    #[error("what is handed on ends in {0}; give the name that ending, or choose another form")]
    HandOnEnding(&'static str),
    /// A tile's picture has no file.
    #[error("the picture cannot be encoded: {0}")]
    Picture(#[from] image::ImageError),
    /// An error that is about a file of this name or path.
    #[error("{0}: {1}")]
    About(String, Box<Self>),
    /// Bytes where text is expected: the first that is wrong, and what is expected, e.g. `a scene`.
    #[error("byte {0} is not UTF-8; {1} is a text file")]
    NotText(usize, &'static str),
    /// An ending other than that of a tile's numbers.
    #[error(
        "the ending \"{0}\" is none that a tile's numbers are written as: use .csv; pictures are handed on by Ctrl+E"
    )]
    TileEnding(String),
    /// A path for computed data whose ending names no format.
    #[error("an ending that nothing is written in; expected .cfsp (all states), .xml or .btdf.txt")]
    MeasuredEnding,
    /// No file dialog can be shown here.
    #[error("no file dialog here")]
    NoDialog,
    /// A product without states.
    #[error("{0} has no state: import it again")]
    NoState(String),
    /// A described system without states.
    #[error("the system has no states: give it at least one angle")]
    NoStates,
    /// A file for one state that holds another number of them.
    #[error("{0} states; expected a file of one")]
    NotOneState(usize),
    /// A product whose files cannot be read again one by one.
    #[error(
        "{files} files are known for {states} states: only where each state has a file of its own can they be read again; import them anew"
    )]
    NotAFileEach {
        /// Files.
        files: usize,
        /// States.
        states: usize,
    },
    /// Control has no sky and sun to go by.
    #[error("no state is picked until sky and sun are right")]
    NoDaylight,
    /// A scene without an aperture.
    #[error("the scene has no aperture: add one in the scene panel")]
    NoAperture,
    /// The LID is asked for before it is there.
    #[error("the LID is not computed yet: wait for its tile, then export again")]
    NoLid,
}

impl AppError {
    /// The same, about a file.
    pub fn about(self, place: impl Display) -> Self {
        Self::About(place.to_string(), Box::new(self))
    }
}
