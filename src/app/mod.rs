//! The window: catalogue on the left, bench in the middle, scene on the right; everything linked, nothing modal.
//!
//! Drawing ([`panels`], [`views`]) reads [`state::State`] and returns [`command::Command`]s; [`apply`] acts on them;
//! [`work`] asks for whatever a change affects and takes in results. Nothing here waits.

pub mod apply;
pub mod backend;
pub mod command;
pub mod control;
pub mod daylight;
pub mod dialogs;
pub mod engine;
pub mod examples;
pub mod export;
pub mod goniophotometer;
pub mod jobs;
pub mod moment;
pub mod outcomes;
pub mod paint;
pub mod panels;
pub mod shelf;
pub mod split;
pub mod state;
pub mod theme;
pub mod title;
pub mod views;
pub mod work;

use crate::study::Library;
use crate::study::accuracy::Accuracy;
use command::Command;
use dialogs::{FileDialogs, NativeDialogs, NoDialogs};
use egui::util::undoer::Undoer;
use engine::{Engine, LidFigures, RoomFigures};
use jobs::Jobs;
use shelf::Shelf;
use state::{Document, Settings, Shown, State};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use work::{Outcome, ReadDataset};

/// Opens the catalogue; runs in a job.
pub type OpenCatalogue = Arc<dyn Fn() -> Result<Arc<dyn Shelf>, String> + Send + Sync>;

/// What the window needs from outside; tests put their own in.
pub struct Services {
    /// Opens the catalogue.
    pub open_catalogue: OpenCatalogue,
    /// Reads dataset files.
    pub read: ReadDataset,
    /// Asks for paths.
    pub dialogs: Arc<dyn FileDialogs>,
    /// Computes.
    pub engine: Arc<dyn Engine>,
}

/// What was computed last.
#[derive(Default)]
pub struct Results {
    /// The first aperture as a luminaire.
    pub lid: Shown<LidFigures>,
    /// The room.
    pub room: Shown<RoomFigures>,
    /// What control does over the year.
    pub year: Shown<control::Year>,
    /// Error against run time, of the scene that it was asked for.
    pub accuracy: Shown<Accuracy>,
    /// Counts the ladders that came in.
    pub accuracy_revision: u64,
    /// Counts what the pictures depend on.
    pub revision: u64,
}

/// A change to the catalogue that waits for its turn.
type Change = Box<dyn FnOnce(&dyn Shelf) -> Outcome + Send>;

/// The window.
pub struct App {
    /// What it knows.
    pub state: State,
    /// What was computed.
    pub results: Results,
    services: Services,
    /// Files and products that system files name.
    library: Arc<Library>,
    jobs: Jobs<Outcome>,
    pending_changes: VecDeque<Change>,
    undoer: Undoer<Document>,
    asked: Option<Document>,
    asked_year: Option<control::YearKey>,
    export: export::Exports,
    toasts: egui_notify::Toasts,
    bench: panels::bench::BenchState,
    accuracy_view: views::accuracy::State,
    section_view: views::section::State,
    ctx: egui::Context,
    installed: bool,
    shown_title: String,
}

fn fresh_undoer(document: &Document) -> Undoer<Document> {
    let mut undoer = Undoer::default();
    undoer.add_undo(document);
    undoer
}

impl App {
    /// A window that is not drawn yet.
    pub fn new(services: Services, settings: Settings) -> Self {
        let state = State::new(settings);
        Self {
            undoer: fresh_undoer(&state.document),
            state,
            results: Results::default(),
            services,
            library: Arc::default(),
            jobs: Jobs::default(),
            pending_changes: VecDeque::new(),
            asked: None,
            asked_year: None,
            export: export::Exports::default(),
            toasts: egui_notify::Toasts::default().with_anchor(egui_notify::Anchor::BottomRight),
            bench: panels::bench::BenchState::default(),
            accuracy_view: views::accuracy::State::default(),
            section_view: views::section::State::default(),
            ctx: egui::Context::default(),
            installed: false,
            shown_title: String::new(),
        }
    }

    /// With a catalogue in memory and no file dialogs; nothing on disk is touched.
    pub fn for_test(engine: Arc<dyn Engine>) -> Self {
        Self::with_shelf(engine, backend::ideals_shelf)
    }

    /// With a catalogue that `open` gives, and no file dialogs.
    pub fn with_shelf(engine: Arc<dyn Engine>, open: fn() -> Result<Arc<dyn Shelf>, String>) -> Self {
        Self::new(
            Services { open_catalogue: Arc::new(open), read: read_dataset, dialogs: Arc::new(NoDialogs), engine },
            Settings::default(),
        )
    }

    /// Everything before drawing: results, keys, dropped files, requests. Never waits.
    pub fn logic(&mut self, ctx: &egui::Context) {
        if !self.installed {
            self.installed = true;
            self.ctx = ctx.clone();
            theme::install(ctx);
            self.state.settings.theme.apply(ctx);
            self.open_catalogue();
        }
        self.poll();
        self.write_exports();
        for command in command::pressed(ctx) {
            self.apply(command);
        }
        let dropped: Vec<PathBuf> =
            ctx.input(|input| input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect());
        if !dropped.is_empty() {
            self.apply(Command::OpenPaths(dropped));
        }
        self.refresh();
        let dragging = ctx.input(|input| input.pointer.any_down());
        if !dragging {
            self.undoer.feed_state(ctx.input(|input| input.time), &self.state.document);
        }
    }

    /// Draws one frame and does what was asked in it.
    pub fn draw(&mut self, ui: &mut egui::Ui) {
        let commands = panels::show(ui, self);
        for command in commands {
            self.apply(command);
            ui.ctx().request_repaint();
        }
        self.toasts.show(ui.ctx());
        let title = title::title(&self.state);
        if title != self.shown_title {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.shown_title = title;
        }
    }

    /// Is something still being read or computed?
    pub fn busy(&self) -> bool {
        !self.jobs.views().is_empty() || !self.pending_changes.is_empty()
    }
}

const SETTINGS_KEY: &str = "cfs-settings";

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.logic(ctx);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.draw(ui);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        let mut settings = self.state.settings.clone();
        settings.last_scene = toml::to_string(&self.state.document.scene).ok();
        if let Ok(text) = serde_json::to_string(&settings) {
            storage.set_string(SETTINGS_KEY, text);
        }
    }
}

/// Reads a dataset file; the error is the reader's sentence.
fn read_dataset(name: &str, bytes: &[u8]) -> Result<crate::catalogue::SourceFile, String> {
    crate::catalogue::SourceFile::read(name, bytes).map_err(|error| error.to_string())
}

/// Opens the window and returns when it is closed. `catalogue`: its file, else the user's own; `open`: files to read
/// at once.
pub fn run(catalogue: Option<&Path>, open: Vec<PathBuf>) -> anyhow::Result<()> {
    let catalogue = catalogue.map(Path::to_path_buf);
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_inner_size([1280.0, 720.0])
            .with_min_inner_size([960.0, 600.0])
            .with_title("cfs")
            .with_app_id("cfs"),
        ..Default::default()
    };
    eframe::run_native(
        "cfs",
        options,
        Box::new(move |cc| {
            let settings = cc
                .storage
                .and_then(|storage| storage.get_string(SETTINGS_KEY))
                .and_then(|text| serde_json::from_str(&text).ok())
                .unwrap_or_default();
            let library = Arc::new(Library::with_catalogue(catalogue.as_deref()));
            let services = Services {
                open_catalogue: Arc::new(move || backend::open_shelf(catalogue.as_deref())),
                read: read_dataset,
                dialogs: Arc::new(NativeDialogs),
                engine: Arc::new(backend::StudyEngine::default()),
            };
            let mut app = App::new(services, settings);
            app.library = library;
            app.logic(&cc.egui_ctx);
            app.apply(Command::OpenPaths(open));
            Ok(Box::new(app))
        }),
    )
    .map_err(|error| anyhow::anyhow!("the window cannot be opened: {error}"))
}
