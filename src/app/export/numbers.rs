//! Export of tiles as numbers (.csv). The tile is drawn again for it, because only its drawing supplies the numbers.

use crate::app::shell::error::AppError;
use crate::app::state::Tile;
use std::path::PathBuf;

/// Destination of a tile's numbers: clipboard, export dialog or file.
enum Target {
    Clipboard,
    ExportDialog,
    File(PathBuf),
}

/// Requests for numbers of tiles, and their results.
#[derive(Default)]
pub struct Numbers {
    asked: Option<(Tile, Target)>,
    of_dialog: Option<String>,
    done: Vec<(Tile, PathBuf, String)>,
}

impl Numbers {
    /// Requests a tile's numbers for the clipboard.
    pub fn ask_copy(&mut self, tile: Tile) {
        self.asked = Some((tile, Target::Clipboard));
    }

    /// Requests a tile's numbers for the export dialog.
    pub fn ask_for_dialog(&mut self, tile: Tile) {
        self.asked = Some((tile, Target::ExportDialog));
    }

    /// Requests a tile's numbers for a file (.csv).
    pub fn ask(&mut self, tile: Tile, path: PathBuf) -> Result<(), AppError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        if ending != "csv" {
            return Err(AppError::TileEnding(ending).about(path.display()));
        }
        self.asked = Some((tile, Target::File(path)));
        Ok(())
    }

    /// Whether the numbers of this tile are requested.
    pub fn wants(&self, tile: Tile) -> bool {
        self.asked.as_ref().is_some_and(|(wanted, _)| *wanted == tile)
    }

    /// Drops the request for a tile that has no numbers.
    pub fn refuse(&mut self) {
        self.asked = None;
    }

    /// Stores the numbers of the requested tile.
    pub fn take(&mut self, ctx: &egui::Context, text: String) {
        match self.asked.take() {
            Some((_, Target::Clipboard)) => ctx.copy_text(text),
            Some((_, Target::ExportDialog)) => {
                self.of_dialog = Some(text);
                ctx.request_repaint();
            }
            Some((tile, Target::File(path))) => {
                self.done.push((tile, path, text));
                ctx.request_repaint();
            }
            None => {}
        }
    }

    /// Returns the next numbers that are to be written to a file.
    pub fn next_for_file(&mut self) -> Option<(Tile, PathBuf, String)> {
        self.done.pop()
    }

    /// Returns the numbers for the export dialog.
    pub fn take_of_dialog(&mut self) -> Option<String> {
        self.of_dialog.take()
    }
}
