//! Work of the window: created from its features, one frame after the other, closed. Only closing waits.

use super::command::Command;
use super::display::font_search::FontSearch;
use super::display::fonts::no_fonts;
use super::display::text_sizing::follow_text_size;
use super::display::{right_to_left, theme};
use super::offer::pressed;
use super::results::backend;
use super::results::engine::Engine;
use super::session::{Content, ContentMut, Kept, Session, say_restored};
use super::shell::dialogs::NoDialogs;
use super::shell::error::AppError;
use super::shell::jobs::Lane;
use super::shell::messages::Messages;
use super::shell::settings::MEGABYTE;
use super::shell::{Services, Shell};
use super::state::{Settings, State, Tile};
use super::window::App;
use super::{panels, title};
use crate::app::catalogue::shelf::Shelf;
use crate::catalogue::SourceFile;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Maximum time that a closing window waits for data that are still being stored.
const CLOSE_TIMEOUT: Duration = Duration::from_secs(60);
/// Time without computations after which fewer results stay stored. Chosen: longer than one thinks about a picture.
const REST: Duration = Duration::from_secs(30);
/// Divisor of the limit of stored results after [`REST`], when a quarter holds what one scene needs again, and while jobs
/// run that need much memory themselves ([`LARGE`]).
const PART: usize = 4;
/// Lanes of jobs that need much memory: a ranking of all built-in products takes no longer with 64 MB than with 1 GB of
/// stored results, an annual simulation has tables of its own, and data that are computed from an optical model take up to
/// 100 MB for some seconds.
const LARGE: [Lane; 5] = [Lane::Rank, Lane::Annual, Lane::Product, Lane::Builtin, Lane::Goniophotometer];

impl App {
    /// Creates a window, without drawing it.
    pub fn new(services: Services, settings: Settings) -> Self {
        Self {
            shell: Shell::new(services, State::new(settings)),
            products: Default::default(),
            built_in: Default::default(),
            gallery: Default::default(),
            imports: Default::default(),
            goniophotometer: Default::default(),
            computations: Default::default(),
            forms: Default::default(),
            examined: Default::default(),
            year: Default::default(),
            ranking: Default::default(),
            compare: Default::default(),
            export: Default::default(),
            session: Default::default(),
            palette: Default::default(),
            tour: Default::default(),
            fonts: FontSearch::new(no_fonts),
            accuracy_view: Default::default(),
            section_view: Default::default(),
            states_view: Default::default(),
            weather_view: Default::default(),
            in_field: false,
            installed: false,
            shown_title: String::new(),
            opened: Default::default(),
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

    /// Whether a job is running in a lane.
    pub fn works_in(&self, lane: Lane) -> bool {
        self.shell.jobs.busy(lane)
    }

    /// Whether anything is still being read or computed.
    pub fn busy(&self) -> bool {
        let waits = self.shell.has_pending_changes() || self.built_in.is_due() || self.export.awaits_lid();
        waits || !self.shell.jobs.views().is_empty()
    }

    /// Whether all visible results are complete: no computation for them is running or still to be started.
    pub(super) fn is_complete(&self) -> bool {
        self.computations.is_complete(&self.shell, self.export.awaits_lid())
    }

    /// Returns the time that each visible tile took to be drawn in the last frame, for performance measurements.
    pub fn tile_times(&self) -> &[(Tile, Duration)] {
        self.shell.bench.times()
    }

    /// Returns the session, the messages, and what the session stores of the window.
    pub(super) const fn session_with_content(&mut self) -> (&mut Session, &mut Messages, Content<'_>) {
        let Self { session, shell, imports, goniophotometer, .. } = self;
        (session, &mut shell.toasts, Content { state: &shell.state, imports, goniophotometer })
    }

    /// Returns what a session stores of the window.
    pub const fn content(&self) -> Content<'_> {
        Content { state: &self.shell.state, imports: &self.imports, goniophotometer: &self.goniophotometer }
    }

    /// Sets the folder to which reports on internal errors are written.
    pub fn report_faults(&mut self, folder: Option<&Path>) {
        self.session.report_faults(folder);
    }

    /// Restores a session in the window, but for the import, whose files have to be read again.
    ///
    /// # Errors
    /// Returns a message if the scene cannot be read; everything else is restored nevertheless.
    pub fn restore(&mut self, kept: &Kept) -> Result<(), String> {
        let Self { shell, imports, goniophotometer, .. } = self;
        kept.put_into(ContentMut { state: &mut shell.state, imports, goniophotometer })
    }

    /// Starts storing the session in a folder, and restores the session found there. `take_up`: whether to restore also
    /// the session of a window that was not closed properly, with a message. `folder`: `None` if the user has no such
    /// folder; then a warning is shown.
    pub fn begin_session(&mut self, folder: Option<&Path>, take_up: bool) {
        let Some((found, folder)) = self.session.begin(&mut self.shell, folder, take_up).zip(folder) else { return };
        let put = found.kept.as_ref().map(|kept| self.restore(kept));
        // In the language that was kept.
        let _speaking = self.shell.speak();
        for problem in &found.problems {
            self.shell.toasts.warning(problem.to_string());
        }
        match put {
            Some(put) => {
                self.shell.begin_history();
                say_restored(&mut self.shell.toasts, &found, &put, folder);
                if let Some(import) = found.kept.and_then(|kept| kept.import) {
                    self.imports.read_again(&mut self.shell, import.paths.clone(), import.grouping, Some(import));
                }
            }
            // Whoever has never had a window open is offered the tour, once.
            None if found.problems.is_empty() => self.tour.offer(),
            None => {}
        }
    }

    /// Passes the current session to the thread that stores it, if it has changed. Never waits.
    fn keep_session(&mut self) {
        let (session, toasts, content) = self.session_with_content();
        session.keep(content, toasts);
    }

    /// Ends the window: waits until data being stored or written are complete, and leaves the session for the next
    /// start.
    pub fn close(&mut self) {
        let start = Instant::now();
        let storing =
            |app: &Self| app.shell.jobs.busy(Lane::Store) || app.shell.has_pending_changes() || app.export.is_writing();
        while storing(self) && self.shell.state.shelf().is_some() && start.elapsed() < CLOSE_TIMEOUT {
            self.poll();
            self.write_exports();
            std::thread::sleep(Duration::from_millis(5));
        }
        let (session, _, content) = self.session_with_content();
        session.close(content);
    }

    fn write_exports(&mut self) {
        let is_complete = self.export.awaits_lid() && self.is_complete();
        self.export.write_due(&mut self.shell, is_complete);
    }

    /// Prepares a frame before drawing: stores results of jobs, handles keys and dropped files, starts jobs. Never
    /// waits.
    pub fn logic(&mut self, ctx: &egui::Context) {
        let _speaking = self.shell.speak();
        if !self.installed {
            self.installed = true;
            self.shell.ctx = ctx.clone();
            theme::install(ctx);
            self.fonts.install(ctx);
            ctx.on_end_pass("right_to_left", Arc::new(right_to_left::reorder));
            self.shell.state.settings.theme.apply(ctx);
            // The window's own keys do it, within bounds.
            ctx.options_mut(|options| options.zoom_with_keyboard = false);
            self.shell.open_catalogue();
        }
        follow_text_size(&self.shell, ctx);
        self.poll();
        self.limit_store(ctx);
        // Another window or the command line may have changed the catalogue meanwhile.
        if ctx.input(|input| input.events.contains(&egui::Event::WindowFocused(true))) {
            self.shell.search();
        }
        self.write_exports();
        for command in pressed(ctx) {
            self.apply(command);
        }
        let dropped: Vec<PathBuf> =
            ctx.input(|input| input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect());
        if !dropped.is_empty() {
            self.apply(Command::OpenPaths(dropped));
        }
        self.ask();
        let dragging = ctx.input(|input| input.pointer.any_down());
        self.keep_session();
        // A product that is being stored is not yet a step by itself: its step also selects it.
        let storing = self.products.is_adding() && self.shell.jobs.busy(Lane::Store);
        if !dragging && !storing {
            self.shell.undoer.feed_state(ctx.input(|input| input.time), &self.shell.state.document);
        }
    }

    /// Limits the memory of stored results ([`store_limit`]).
    fn limit_store(&self, ctx: &egui::Context) {
        let Some(store) = self.shell.services.engine.store() else { return };
        store.set_limit(store_limit(&self.shell));
        if let Some(left) = REST.checked_sub(self.shell.jobs.idle()) {
            ctx.request_repaint_after(left);
        }
    }

    /// Starts the jobs whose results are needed now.
    fn ask(&mut self) {
        let shell = &mut self.shell;
        self.tour.follow(shell);
        self.computations.refresh(shell, &mut self.built_in);
        self.computations.ask_due(shell, self.export.awaits_lid());
        self.computations.ask_peaks(shell);
        self.forms.ask(shell);
        self.year.ask_weather(shell);
        self.ranking.follow(shell);
        self.compare.ask(shell);
        self.export.ask_preview(shell);
        self.gallery.ask(shell);
        self.examined.ask(shell);
        self.built_in.fill(shell);
    }

    /// Draws one frame and executes the commands that it returns.
    pub fn draw(&mut self, ui: &mut egui::Ui) {
        let _speaking = self.shell.speak();
        let state = &mut self.shell.state;
        if self.opened.take(state, ui.ctx().cumulative_frame_nr()) {
            // However it was opened, who opens a sheet wants to type.
            state.wants_keyboard = state.sheet.is_some();
            state.focus_search &= state.sheet.is_none();
        }
        let commands = panels::show(ui, self);
        for command in commands {
            self.apply(command);
            ui.ctx().request_repaint();
        }
        self.fonts.ask(&mut self.shell);
        self.in_field = ui.ctx().memory(|memory| memory.focused().is_some());
        // Now, not with the next frame: a slow one would take its time from the second that may be lost.
        self.keep_session();
        let title = title::title(&self.shell.state);
        if title != self.shown_title {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.shown_title = title;
        }
    }
}

/// Returns the limit of stored results: that of the settings, or a part of it while nothing is computed, or much memory is
/// needed. \[bytes\]
fn store_limit(shell: &Shell) -> usize {
    let limit = shell.state.settings.store_limit.saturating_mul(MEGABYTE);
    let part = shell.jobs.idle() > REST || LARGE.iter().any(|lane| shell.jobs.busy(*lane));
    if part { limit / PART } else { limit }
}

impl Drop for App {
    fn drop(&mut self) {
        if std::thread::panicking() {
            // A second fault here would end the program before it has said anything.
            drop(catch_unwind(AssertUnwindSafe(|| {
                let jobs = self.shell.jobs.views();
                let (session, _, content) = self.session_with_content();
                session.end_at_fault(&jobs, content);
            })));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::results::backend::StudyEngine;
    use crate::app::results::work::Outcome;
    use std::sync::mpsc::channel;

    #[test]
    fn jobs_that_need_much_memory_leave_a_quarter_for_stored_results() {
        let mut app = App::for_test(Arc::new(StudyEngine::default()));
        let shell = &mut app.shell;
        shell.state.settings.store_limit = 400;
        let large = LARGE.map(|lane| (lane, 100));
        for (lane, megabytes) in large.into_iter().chain([(Lane::Room, 400)]) {
            let (end, gate) = channel::<()>();
            shell.start(lane, move |_| {
                _ = gate.recv();
                Outcome::Builtin(Ok(0))
            });
            assert_eq!(store_limit(shell), megabytes * MEGABYTE, "{lane:?}");
            drop(end);
            shell.jobs.cancel(lane);
        }
    }
}
