//! State and services that the features of the window share: document with undo history, results, jobs, messages, and
//! the queue of the catalogue. A feature owns its own state and takes this one as an argument.

pub mod clock;
pub mod dialogs;
pub mod disk;
pub mod error;
pub mod jobs;
pub mod lane;
pub mod messages;
pub mod paths;
pub mod safe_name;
pub mod settings;
pub mod typed_path;
pub mod typing;

use crate::app::catalogue::shelf::{Query, Shelf};
use crate::app::results::engine::Engine;
use crate::app::results::work::{Outcome, ReadDataset};
use crate::app::shell::dialogs::FileDialogs;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::{JobState, Jobs, Lane};
use crate::app::shell::messages::Messages;
use crate::app::state::{CatalogueState, Document, Results, State, Tile};
use crate::app::tiles::{Bench, Layout};
use crate::study::Library;
use crate::texts::{Language, Speaking, speak};
use egui::util::undoer::Undoer;
use std::collections::VecDeque;
use std::path::Path;
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
type CatalogueChange = Box<dyn FnOnce(&dyn Shelf) -> Outcome + Send>;

/// State and services that all features of the window share.
pub struct Shell {
    /// State of the window: document, settings, and display states.
    pub state: State,
    /// Latest results of the computations.
    pub results: Results,
    /// Services that the window uses.
    pub(in crate::app) services: Services,
    /// Library of the files and products that system files name.
    pub(in crate::app) library: Arc<Library>,
    /// Running jobs.
    pub(in crate::app) jobs: Jobs<Outcome>,
    /// Changes of the catalogue that wait until earlier ones are complete, in their order.
    pending_changes: VecDeque<CatalogueChange>,
    /// Undo history of the document.
    pub(in crate::app) undoer: Undoer<Document>,
    /// Document for which results were last requested, and the language of their texts; `None` to request them again.
    pub(in crate::app) asked: Option<(Document, Language)>,
    /// Messages to the user.
    pub toasts: Messages,
    /// Tiles of the tile area.
    pub(in crate::app) bench: Bench,
    /// Context of egui, by which jobs wake the window.
    pub(in crate::app) ctx: egui::Context,
    /// Language of the desktop, for the setting that the window uses it.
    pub(in crate::app) desktop_language: Language,
}

/// Returns an undo history that starts with this document.
fn fresh_undoer(document: &Document) -> Undoer<Document> {
    let mut undoer = Undoer::default();
    undoer.add_undo(document);
    undoer
}

impl Shell {
    /// Creates the shell of a window with this state, before anything has been read.
    pub fn new(services: Services, state: State) -> Self {
        Self {
            undoer: fresh_undoer(&state.document),
            state,
            results: Results::default(),
            services,
            library: Arc::default(),
            jobs: Jobs::default(),
            pending_changes: VecDeque::new(),
            asked: None,
            toasts: Messages::default(),
            bench: Bench::default(),
            ctx: egui::Context::default(),
            desktop_language: Language::default(),
        }
    }

    /// Sets the language of texts on this thread to that of the window, until the returned guard is dropped.
    pub fn speak(&self) -> Speaking {
        speak(self.state.settings.language.language(self.desktop_language))
    }

    /// Starts a job in a lane; the window is woken when it ends.
    pub fn start(&mut self, lane: Lane, work: impl FnOnce(&JobState) -> Outcome + Send + 'static) {
        let ctx = self.ctx.clone();
        self.jobs.start(lane, move || ctx.request_repaint(), work);
    }

    /// Shows an error as a message.
    pub fn report_error(&mut self, error: &AppError) {
        self.toasts.error(error.to_string());
    }

    /// Ends an undo step at the current document. The undo history sees the document first, so that steps undone before
    /// cannot be redone after the new one.
    pub fn end_step(&mut self) {
        self.undoer.feed_state(0.0, &self.state.document);
        self.undoer.add_undo(&self.state.document);
    }

    /// Begins a new undo history with the current document.
    pub fn begin_history(&mut self) {
        self.undoer = fresh_undoer(&self.state.document);
    }

    /// Opens the catalogue in a job.
    pub fn open_catalogue(&mut self) {
        self.state.catalogue = CatalogueState::Opening;
        let open = self.services.open_catalogue.clone();
        self.start(Lane::Catalogue, move |_| Outcome::Opened(open()));
    }

    /// Starts a new search of the catalogue for the product list.
    pub fn search(&mut self) {
        if let Some(shelf) = self.state.shelf() {
            let query = Query { shown: self.state.settings.recent.clone(), ..self.state.query.clone() };
            self.start(Lane::Catalogue, move |_| Outcome::Found(shelf.search(&query)));
        }
    }

    /// Searches again if the product list shows pictures: what was computed has one now.
    pub fn show_new_pictures(&mut self) {
        if self.state.settings.gallery {
            self.search();
        }
    }

    /// Queues a change of the catalogue; changes are made one after the other.
    pub fn store(&mut self, change: impl FnOnce(&dyn Shelf) -> Result<(), AppError> + Send + 'static) {
        self.queue(move |shelf| Outcome::Stored(change(shelf)));
    }

    /// Queues the reading of a product that is to be selected, after all pending changes, one of which may store it.
    pub fn look_up(&mut self, product: String) {
        self.queue(move |shelf| Outcome::Choice(shelf.product(&product)));
    }

    /// Queues a query or change of the catalogue after everything that was queued before.
    pub fn queue(&mut self, change: impl FnOnce(&dyn Shelf) -> Outcome + Send + 'static) {
        self.pending_changes.push_back(Box::new(change));
        self.start_pending_change();
    }

    /// Lets all results be requested again, since something changed that the document does not hold.
    pub fn ask_again(&mut self) {
        self.asked = None;
    }

    /// Whether changes of the catalogue wait for earlier ones.
    pub fn has_pending_changes(&self) -> bool {
        !self.pending_changes.is_empty()
    }

    /// Starts the next queued change of the catalogue, if none is running: changes wait for each other, since none may
    /// be replaced by a later one.
    pub fn start_pending_change(&mut self) {
        if self.jobs.busy(Lane::Store) {
            return;
        }
        let Some(shelf) = self.state.shelf() else { return };
        if let Some(change) = self.pending_changes.pop_front() {
            self.start(Lane::Store, move |_| change(&*shelf));
        }
    }

    /// Returns the language in which results of the current document were last requested; `None` if those of another
    /// document were, or none.
    pub fn asked_last(&self) -> Option<Language> {
        let (asked, language) = self.asked.as_ref()?;
        asked.asks_the_same(&self.state.document).then_some(*language)
    }

    /// Stores the folder of a file that was read or written, so that the next dialog starts there.
    pub fn remember_folder(&mut self, path: &Path) {
        if let Some(folder) = path.parent().filter(|folder| folder.is_absolute()) {
            self.state.settings.folder = Some(folder.to_owned());
        }
    }

    /// Stores the arrangement of the tiles; the tile area follows in the next frame.
    pub fn keep_layout(&mut self, layout: &Layout) {
        self.state.settings.layout = Some(layout.text());
    }

    /// Whether a tile is visible.
    pub fn sees(&self, tile: Tile) -> bool {
        self.bench.visible_tiles(self.state.maximised).contains(&tile)
    }

    /// Makes a tile visible, since a hidden tile is not drawn and has no numbers to export.
    pub fn bring_up(&mut self, tile: Tile) {
        if self.state.maximised.is_some_and(|shown| shown != tile) {
            self.state.maximised = Some(tile);
        }
        let mut layout = self.bench.layout();
        if self.state.maximised.is_none() && layout.reveal(tile) {
            self.keep_layout(&layout);
        }
    }
}
