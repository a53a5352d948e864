//! Work of one frame of the window: stores results of jobs, handles keys and dropped files, draws, executes commands.
//! It never waits.

use super::backend::{StudyEngine, open_shelf};
use super::command::Command;
use super::dialogs::NativeDialogs;
use super::jobs::Lane;
use super::offer::pressed;
use super::restoring::sessions_folder;
use super::settings::MEGABYTE;
use super::text_size::SMALLEST_WINDOW;
use super::window::{App, Services};
use super::window_place::{bring_on_screen, repair_saved};
use super::{fonts, language, panels, right_to_left, theme, title};
use crate::catalogue::SourceFile;
use crate::study::{Library, fault};
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl App {
    /// Prepares a frame before drawing: stores results of jobs, handles keys and dropped files, starts jobs. Never
    /// waits.
    pub fn logic(&mut self, ctx: &egui::Context) {
        let _speaking = self.speak();
        if !self.installed {
            self.installed = true;
            self.ctx = ctx.clone();
            theme::install(ctx);
            ctx.add_font_provider(self.missing_characters.clone());
            ctx.on_end_pass("right_to_left", Arc::new(right_to_left::reorder));
            self.state.settings.theme.apply(ctx);
            // The window's own keys do it, within bounds.
            ctx.options_mut(|options| options.zoom_with_keyboard = false);
            self.open_catalogue();
        }
        self.follow_text_size(ctx);
        let limit = self.state.settings.store_limit.saturating_mul(MEGABYTE);
        self.services.engine.store().into_iter().for_each(|store| store.set_limit(limit));
        self.poll();
        // Another window or the command line may have changed the catalogue meanwhile.
        if ctx.input(|input| input.events.contains(&egui::Event::WindowFocused(true))) {
            self.search();
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
        self.follow_tour();
        self.refresh();
        self.ask_due();
        self.ask_peaks();
        self.ask_data_looks();
        self.ask_weather();
        self.follow_ranking();
        self.ask_compared();
        self.ask_preview();
        self.ask_pictures();
        self.ask_findings();
        self.fill_catalogue();
        let dragging = ctx.input(|input| input.pointer.any_down());
        self.keep_session();
        // A product that is being stored is not yet a step by itself: its step also selects it.
        let storing = !self.adding.is_empty() && self.jobs.busy(Lane::Store);
        if !dragging && !storing {
            self.undoer.feed_state(ctx.input(|input| input.time), &self.state.document);
        }
    }

    /// Draws one frame and executes the commands that it returns.
    pub fn draw(&mut self, ui: &mut egui::Ui) {
        let _speaking = self.speak();
        if self.opened.take(&self.state, ui.ctx().cumulative_frame_nr()) {
            // However it was opened, who opens a sheet wants to type.
            self.state.wants_keyboard = self.state.sheet.is_some();
            self.state.focus_search &= self.state.sheet.is_none();
        }
        let commands = panels::show(ui, self);
        for command in commands {
            self.apply(command);
            ui.ctx().request_repaint();
        }
        self.ask_fonts();
        self.in_field = ui.ctx().memory(|memory| memory.focused().is_some());
        // Now, not with the next frame: a slow one would take its time from the second that may be lost.
        self.keep_session();
        let title = title::title(&self.state);
        if title != self.shown_title {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.shown_title = title;
        }
    }
}

/// Key under which earlier versions stored their settings.
const SETTINGS_KEY: &str = "cfs-settings";

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.logic(ctx);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.draw(ui);
    }

    fn on_exit(&mut self, _gl: Option<&eframe::glow::Context>) {
        self.close();
    }
}

/// Name by which the desktop identifies the window, and name of the folder with its stored state.
const APP_ID: &str = "cfs";

/// Icon of the window, for desktops without our desktop file.
const ICON: &[u8] = include_bytes!("../../assets/desktop/cfs-256.png");

/// Opens the window and returns when it is closed. `catalogue`: path of the catalogue, or `None` for the user's own;
/// `open`: files to read at once.
pub fn run(catalogue: Option<&Path>, open: Vec<PathBuf>) -> anyhow::Result<()> {
    let catalogue = catalogue.map(Path::to_path_buf);
    let sessions = sessions_folder();
    let icon =
        eframe::icon_data::from_png_bytes(ICON).map_err(|error| anyhow::anyhow!("the window's icon: {error}"))?;
    if let Some(folder) = eframe::storage_dir(APP_ID) {
        repair_saved(&folder.join("app.ron"));
    }
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_inner_size([1280.0, 720.0])
            .with_min_inner_size(SMALLEST_WINDOW)
            .with_title("cfs")
            .with_icon(icon)
            .with_app_id(APP_ID),
        ..Default::default()
    };
    eframe::run_native(
        "cfs",
        options,
        Box::new(move |cc| {
            bring_on_screen(cc);
            let settings = cc
                .storage
                .and_then(|storage| storage.get_string(SETTINGS_KEY))
                .and_then(|text| serde_json::from_str(&text).ok())
                .unwrap_or_default();
            let library = Arc::new(Library::with_catalogue(catalogue.as_deref()));
            let services = Services {
                open_catalogue: Arc::new(move || open_shelf(catalogue.as_deref())),
                read: SourceFile::read,
                dialogs: Arc::new(NativeDialogs::listening()),
                engine: Arc::new(StudyEngine::new(library.clone())),
            };
            let mut app = App::new(services, settings);
            app.library = library;
            app.desktop_language = language::of_desktop();
            app.find_fonts = fonts::system_fonts;
            app.report_faults(fault::folder().as_deref());
            app.begin_session(sessions.as_deref(), open.is_empty());
            app.logic(&cc.egui_ctx);
            app.apply(Command::OpenPaths(open));
            Ok(Box::new(app))
        }),
    )
    .map_err(|error| anyhow::anyhow!(no_window(&error.to_string())))
}

/// Returns the message that no window can be opened, with the reason, and with what works without a window.
fn no_window(error: &str) -> String {
    let placed = error.split_once("os error at ").and_then(|(_, rest)| rest.split_once(": "));
    let reason = placed.map_or(error, |(_, reason)| reason).trim_end_matches('.');
    format!("the window cannot be opened: {reason}; without a display use the commands that cfs --help lists")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_display_one_line_names_the_way_out() {
        let of_winit =
            "winit EventLoopError: os error at /src/linux/mod.rs:765: neither WAYLAND_DISPLAY nor DISPLAY is set.";
        assert_eq!(
            no_window(of_winit),
            "the window cannot be opened: neither WAYLAND_DISPLAY nor DISPLAY is set; without a display use the commands that \
             cfs --help lists"
        );
        assert!(no_window("no OpenGL: none").starts_with("the window cannot be opened: no OpenGL: none; "));
    }
}
