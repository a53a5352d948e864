//! Opening of the window on the desktop.

use super::command::Command;
use super::session::sessions_folder;
use super::shell::Services;
use super::window::App;
use crate::app::display::font_search::FontSearch;
use crate::app::display::fonts;
use crate::app::display::language;
use crate::app::display::text_size::SMALLEST_WINDOW;
use crate::app::display::window_place::{bring_on_screen, repair_saved};
use crate::app::results::backend::{StudyEngine, open_shelf};
use crate::app::shell::dialogs::NativeDialogs;
use crate::catalogue::SourceFile;
use crate::study::{Library, fault};
use std::path::{Path, PathBuf};
use std::sync::Arc;

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
            app.shell.library = library;
            app.shell.desktop_language = language::of_desktop();
            app.fonts = FontSearch::new(fonts::system_fonts);
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
