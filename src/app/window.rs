//! The window itself: its state, its results, and its services.

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

/// Function that opens the catalogue; runs in a job.
pub type OpenCatalogue = Arc<dyn Fn() -> Result<Arc<dyn Shelf>, AppError> + Send + Sync>;

/// Services that the window needs from outside; tests use their own.
pub struct Services {
    /// Function that opens the catalogue.
    pub open_catalogue: OpenCatalogue,
    /// Function that reads dataset files.
    pub read: ReadDataset,
    /// Dialogs that ask for paths.
    pub dialogs: Arc<dyn FileDialogs>,
    /// Engine for the computations.
    pub engine: Arc<dyn Engine>,
}

/// Change to the catalogue that waits for its turn.
pub(super) type Change = Box<dyn FnOnce(&dyn Shelf) -> Outcome + Send>;

/// Window of the program.
pub struct App {
    /// State of the window.
    pub state: State,
    /// Results of computations.
    pub results: Results,
    pub(super) services: Services,
    /// Library of files and products that system files name.
    pub(super) library: Arc<Library>,
    pub(super) jobs: Jobs<Outcome>,
    pub(super) pending_changes: VecDeque<Change>,
    /// Whether some built-in products wait for their data.
    pub(super) fill_due: bool,
    pub(super) fill_failures: usize,
    /// Path that the LID is to be written to as soon as it is that of the scene.
    pub(super) lid_to: Option<PathBuf>,
    /// Numbers of the additions that are being stored.
    pub(super) adding: BTreeSet<usize>,
    pub(super) undoer: Undoer<Document>,
    /// Whether something had the keyboard when the last frame ended.
    pub(super) in_field: bool,
    /// Document that was requested last, and its language.
    pub(super) asked: Option<(Document, Language)>,
    pub(super) asked_year: Option<YearKey>,
    pub(super) asked_weather: Option<CalendarKey>,
    pub(super) asked_form: Option<FormKey>,
    pub(super) asked_schemes: Option<SchemesKey>,
    pub(super) asked_peaks: Option<Arc<LidFigures>>,
    pub(super) choosing: Choosing,
    pub(super) due: Due,
    pub(super) export: Exports,
    /// Results of the candidates of the comparison.
    pub compare: Columns,
    /// Messages of the window.
    pub toasts: Messages,
    /// Files to be read once the catalogue is open.
    pub(super) waiting_files: Vec<(Vec<PathBuf>, Grouping, Option<KeptImport>)>,
    /// Whether a file is being written, not only asked about.
    pub(super) writing: bool,
    /// Writer of the session on disk, if the session is kept.
    pub(super) autosave: Option<Autosave>,
    /// Last steps, for reports on faults.
    pub(super) steps: Steps,
    pub(super) faults: Faults,
    pub(super) bench: Bench,
    pub(super) accuracy_view: accuracy::State,
    pub(super) section_view: section::State,
    pub(super) states_view: states::State,
    pub(super) weather_view: calendar::State,
    /// Cache of findings of the data check, by content.
    pub(super) examined: Examined,
    /// Pictures of products.
    pub gallery: Gallery,
    /// Function that searches fonts for characters that the built-in fonts lack.
    pub find_fonts: FindFonts,
    pub(super) missing_characters: Arc<MissingCharacters>,
    pub(super) ctx: egui::Context,
    pub(super) installed: bool,
    pub(super) shown_title: String,
    pub(super) opened: Opened,
    /// Language of the desktop.
    pub(super) desktop_language: Language,
}

/// Sheet and palette over the window, with the frame since which each is open: a key that was pressed before is not
/// meant for it.
#[derive(Default)]
pub(super) struct Opened {
    sheet: (Option<Sheet>, u64),
    palette: (bool, u64),
}

impl Opened {
    /// Records what is open in a frame; returns whether the sheet is another than before.
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

    /// Whether the sheet was there before this frame.
    pub(super) const fn sheet_before(&self, frame: u64) -> bool {
        self.sheet.1 < frame
    }

    /// Whether the palette was there before this frame.
    pub(super) const fn palette_before(&self, frame: u64) -> bool {
        self.palette.1 < frame
    }
}

/// Ends an undo step at the current document. What was undone before a new step must not be redone after it, which the
/// undoer notices only when it is fed.
pub(super) fn end_step(undoer: &mut Undoer<Document>, document: &Document) {
    undoer.feed_state(0.0, document);
    undoer.add_undo(document);
}

/// Returns an undo history that begins at this document.
pub(super) fn fresh_undoer(document: &Document) -> Undoer<Document> {
    let mut undoer = Undoer::default();
    undoer.add_undo(document);
    undoer
}

impl App {
    /// Creates a window that is not drawn yet.
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

    /// Creates a window with a catalogue in memory and no file dialogs; nothing on disk is touched.
    pub fn for_test(engine: Arc<dyn Engine>) -> Self {
        Self::with_shelf(engine, backend::ideals_shelf)
    }

    /// Creates a window with the catalogue that `open` returns, and no file dialogs.
    pub fn with_shelf(engine: Arc<dyn Engine>, open: fn() -> Result<Arc<dyn Shelf>, AppError>) -> Self {
        Self::new(
            Services { open_catalogue: Arc::new(open), read: SourceFile::read, dialogs: Arc::new(NoDialogs), engine },
            Settings::default(),
        )
    }

    /// Sets the window's language on this thread until the returned guard is dropped.
    pub(super) fn speak(&self) -> Speaking {
        speak(self.state.settings.language.language(self.desktop_language))
    }

    /// Starts a job that wakes the window when it ends.
    pub(super) fn start(&mut self, lane: Lane, work: impl FnOnce(&JobState) -> Outcome + Send + 'static) {
        let ctx = self.ctx.clone();
        self.jobs.start(lane, move || ctx.request_repaint(), work);
    }

    /// Shows an error as a message.
    pub(super) fn report_error(&mut self, error: &AppError) {
        self.toasts.error(error.to_string());
    }

    /// Whether a job is under way in a lane.
    pub fn works_in(&self, lane: Lane) -> bool {
        self.jobs.busy(lane)
    }

    /// Whether something is still being read or computed.
    pub fn busy(&self) -> bool {
        !self.jobs.views().is_empty() || !self.pending_changes.is_empty() || self.fill_due || self.lid_to.is_some()
    }
}
