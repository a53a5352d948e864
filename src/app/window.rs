//! The window of the program: its state, its results, and its services.

use super::autosave::Autosave;
use super::backend;
use super::compare_columns::Columns;
use super::control::YearKey;
use super::data_looks::{FormKey, SchemesKey};
use super::dialogs::{FileDialogs, NoDialogs};
use super::due::Due;
use super::engine::{Engine, LidFigures};
use super::error::AppError;
use super::examining::Examined;
use super::export::Exports;
use super::fonts::{FindFonts, MissingCharacters, no_fonts};
use super::gallery::Gallery;
use super::import::KeptImport;
use super::jobs::{JobState, Jobs, Lane};
use super::messages::Messages;
use super::rankings::Choosing;
use super::shelf::Shelf;
use super::state::{Document, Results, Settings, Sheet, State};
use super::steps::{Faults, Steps};
use super::tiles::Bench;
use super::views::{accuracy, calendar, section, states};
use super::work::{Outcome, ReadDataset};
use super::year::CalendarKey;
use crate::catalogue::{Grouping, SourceFile};
use crate::study::Library;
use crate::texts::{Language, Speaking, speak};
use egui::util::undoer::Undoer;
use std::collections::{BTreeSet, VecDeque};
use std::path::PathBuf;
use std::sync::Arc;

/// Function that opens the catalogue of products; it is executed in a job.
pub type OpenCatalogue = Arc<dyn Fn() -> Result<Arc<dyn Shelf>, AppError> + Send + Sync>;

/// Services that the window needs from outside; tests use other ones than the program.
pub struct Services {
    /// Function that opens the catalogue.
    pub open_catalogue: OpenCatalogue,
    /// Function that reads dataset files.
    pub read: ReadDataset,
    /// Dialogs of the desktop for paths.
    pub dialogs: Arc<dyn FileDialogs>,
    /// Engine that executes the photometric computations.
    pub engine: Arc<dyn Engine>,
}

/// Change of the catalogue that waits until earlier ones are complete.
pub(super) type Change = Box<dyn FnOnce(&dyn Shelf) -> Outcome + Send>;

/// Window of the program.
pub struct App {
    /// State of the window: document, settings, and display states.
    pub state: State,
    /// Latest results of the computations.
    pub results: Results,
    /// Services that the window uses.
    pub(super) services: Services,
    /// Library of the files and products that system files name.
    pub(super) library: Arc<Library>,
    /// Running jobs.
    pub(super) jobs: Jobs<Outcome>,
    /// Changes of the catalogue that wait until earlier ones are complete, in their order.
    pub(super) pending_changes: VecDeque<Change>,
    /// Whether data of built-in products are still to be computed.
    pub(super) fill_due: bool,
    /// Number of consecutive failures in computing data of built-in products.
    pub(super) fill_failures: usize,
    /// Path to which the luminous intensity distribution (LID) is to be written as soon as it is up to date.
    pub(super) lid_to: Option<PathBuf>,
    /// Indices of the additions of this session that are being stored.
    pub(super) adding: BTreeSet<usize>,
    /// Undo history of the document.
    pub(super) undoer: Undoer<Document>,
    /// Whether a widget had the keyboard focus at the end of the last frame.
    pub(super) in_field: bool,
    /// Document for which results were last requested, and the language of their texts.
    pub(super) asked: Option<(Document, Language)>,
    /// Key of the control over a year that was last requested.
    pub(super) asked_year: Option<YearKey>,
    /// Key of the calendar of weather data that was last requested.
    pub(super) asked_weather: Option<CalendarKey>,
    /// Key of the processed data that were last requested.
    pub(super) asked_form: Option<FormKey>,
    /// Key of the map of interpolation schemes that was last requested.
    pub(super) asked_schemes: Option<SchemesKey>,
    /// LID whose largest intensities were last requested.
    pub(super) asked_peaks: Option<Arc<LidFigures>>,
    /// State of the rankings, except the results shown.
    pub(super) choosing: Choosing,
    /// Computations that are due, i.e. still to be started.
    pub(super) due: Due,
    /// Exports of tiles' numbers in progress.
    pub(super) export: Exports,
    /// Candidates of the comparison, with their results.
    pub compare: Columns,
    /// Messages to the user.
    pub toasts: Messages,
    /// Files to be read as soon as the catalogue is open: paths, grouping into products, and the stored import they
    /// belong to.
    pub(super) waiting_files: Vec<(Vec<PathBuf>, Grouping, Option<KeptImport>)>,
    /// Whether a file is being written.
    pub(super) writing: bool,
    /// Writer of the session on disk; `None` if the session is not stored.
    pub(super) autosave: Option<Autosave>,
    /// History of the last commands, for reports on internal errors.
    pub(super) steps: Steps,
    /// Internal errors that were reported.
    pub(super) faults: Faults,
    /// Tiles of the tile area.
    pub(super) bench: Bench,
    /// State of the plot of error against computing time.
    pub(super) accuracy_view: accuracy::State,
    /// State of the section through a described system.
    pub(super) section_view: section::State,
    /// State of the strip of a product's states.
    pub(super) states_view: states::State,
    /// State of the calendar of weather data.
    pub(super) weather_view: calendar::State,
    /// Cache of findings of the data check, by content of the dataset.
    pub(super) examined: Examined,
    /// Pictures of products for the gallery.
    pub gallery: Gallery,
    /// Function that searches the system's fonts for characters missing in the built-in fonts.
    pub find_fonts: FindFonts,
    /// Characters missing in the built-in fonts.
    pub(super) missing_characters: Arc<MissingCharacters>,
    /// Context of egui, by which jobs wake the window.
    pub(super) ctx: egui::Context,
    /// Whether fonts and themes have been set in egui.
    pub(super) installed: bool,
    /// Title that the window currently has.
    pub(super) shown_title: String,
    /// Side panel and command palette that are open, with their first frames.
    pub(super) opened: Opened,
    /// Language of the desktop, for the setting that the window uses it.
    pub(super) desktop_language: Language,
}

/// Side panel and command palette, with the number of the frame in which each was opened or closed: keys of that frame
/// must not be executed by it.
#[derive(Default)]
pub(super) struct Opened {
    sheet: (Option<Sheet>, u64),
    palette: (bool, u64),
}

impl Opened {
    /// Records the state of a frame, given by its number. Returns whether the side panel has changed.
    pub(super) fn take(&mut self, state: &State, frame: u64) -> bool {
        let palette = state.palette.is_some();
        if self.palette.0 != palette {
            self.palette = (palette, frame);
        }
        let another = self.sheet.0 != state.sheet;
        if another {
            self.sheet = (state.sheet, frame);
        }
        another
    }

    /// Whether the side panel has not changed in this frame.
    pub(super) const fn sheet_before(&self, frame: u64) -> bool {
        self.sheet.1 < frame
    }

    /// Whether the command palette has not changed in this frame.
    pub(super) const fn palette_before(&self, frame: u64) -> bool {
        self.palette.1 < frame
    }
}

/// Ends an undo step at the current document. The undo history must see the document first, so that steps undone before
/// cannot be redone after the new one.
pub(super) fn end_step(undoer: &mut Undoer<Document>, document: &Document) {
    undoer.feed_state(0.0, document);
    undoer.add_undo(document);
}

/// Returns an undo history that starts with this document.
pub(super) fn fresh_undoer(document: &Document) -> Undoer<Document> {
    let mut undoer = Undoer::default();
    undoer.add_undo(document);
    undoer
}

impl App {
    /// Creates a window, without drawing it.
    pub fn new(services: Services, settings: Settings) -> Self {
        let state = State::new(settings);
        Self {
            undoer: fresh_undoer(&state.document),
            in_field: false,
            state,
            results: Results::default(),
            services,
            library: Arc::default(),
            jobs: Jobs::default(),
            pending_changes: VecDeque::new(),
            fill_due: false,
            fill_failures: 0,
            lid_to: None,
            adding: BTreeSet::new(),
            asked: None,
            asked_year: None,
            asked_weather: None,
            asked_form: None,
            asked_schemes: None,
            asked_peaks: None,
            choosing: Choosing::default(),
            due: Due::default(),
            export: Exports::default(),
            compare: Columns::default(),
            toasts: Messages::default(),
            waiting_files: Vec::new(),
            writing: false,
            autosave: None,
            steps: Steps::default(),
            faults: Faults::default(),
            bench: Bench::default(),
            accuracy_view: accuracy::State::default(),
            section_view: section::State::default(),
            states_view: states::State::default(),
            weather_view: calendar::State::default(),
            examined: Examined::default(),
            gallery: Gallery::default(),
            find_fonts: no_fonts,
            missing_characters: Arc::default(),
            ctx: egui::Context::default(),
            installed: false,
            shown_title: String::new(),
            opened: Opened::default(),
            desktop_language: Language::default(),
        }
    }

    /// Creates a window for tests, with a catalogue in memory and without file dialogs; nothing on disk is read or
    /// written.
    pub fn for_test(engine: Arc<dyn Engine>) -> Self {
        Self::with_shelf(engine, backend::ideals_shelf)
    }

    /// Creates a window for tests, with the catalogue that `open` returns and without file dialogs.
    pub fn with_shelf(engine: Arc<dyn Engine>, open: fn() -> Result<Arc<dyn Shelf>, AppError>) -> Self {
        Self::new(
            Services { open_catalogue: Arc::new(open), read: SourceFile::read, dialogs: Arc::new(NoDialogs), engine },
            Settings::default(),
        )
    }

    /// Sets the language of texts on this thread to that of the window, until the returned guard is dropped.
    pub(super) fn speak(&self) -> Speaking {
        speak(self.state.settings.language.language(self.desktop_language))
    }

    /// Starts a job in a lane; the window is woken when it ends.
    pub(super) fn start(&mut self, lane: Lane, work: impl FnOnce(&JobState) -> Outcome + Send + 'static) {
        let ctx = self.ctx.clone();
        self.jobs.start(lane, move || ctx.request_repaint(), work);
    }

    /// Shows an error as a message.
    pub(super) fn report_error(&mut self, error: &AppError) {
        self.toasts.error(error.to_string());
    }

    /// Whether a job is running in a lane.
    pub fn works_in(&self, lane: Lane) -> bool {
        self.jobs.busy(lane)
    }

    /// Whether anything is still being read or computed.
    pub fn busy(&self) -> bool {
        !self.jobs.views().is_empty() || !self.pending_changes.is_empty() || self.fill_due || self.lid_to.is_some()
    }
}
