//! Tiles as files: the numbers a tile shows (.csv). The tile has to be drawn once more: its numbers are known to its drawing
//! alone.

use super::error::AppError;
use super::state::Tile;
use std::path::PathBuf;

/// Where a tile's numbers go.
enum Target {
    Clipboard,
    HandOn,
    File(PathBuf),
}

/// What is asked of tiles, and what they gave.
#[derive(Default)]
pub struct Exports {
    numbers: Option<(Tile, Target)>,
    handed_on: Option<String>,
    done: Vec<(Tile, PathBuf, String)>,
}

impl Exports {
    /// Asks a tile for its numbers, for the clipboard.
    pub fn ask_copy(&mut self, tile: Tile) {
        self.numbers = Some((tile, Target::Clipboard));
    }

    /// Asks a tile for its numbers, to be handed on.
    pub fn ask_hand_on(&mut self, tile: Tile) {
        self.numbers = Some((tile, Target::HandOn));
    }

    /// Asks a tile for its numbers (.csv).
    pub fn ask(&mut self, tile: Tile, path: PathBuf) -> Result<(), AppError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        if ending != "csv" {
            return Err(AppError::TileEnding(ending).about(path.display()));
        }
        self.numbers = Some((tile, Target::File(path)));
        Ok(())
    }

    /// True when this tile's numbers are asked for.
    pub fn wants_numbers(&self, tile: Tile) -> bool {
        self.numbers.as_ref().is_some_and(|(wanted, _)| *wanted == tile)
    }

    /// The tile that was asked has none.
    pub fn refuse(&mut self) {
        self.numbers = None;
    }

    /// Takes the numbers of the tile that was asked.
    pub fn numbers(&mut self, ctx: &egui::Context, text: String) {
        match self.numbers.take() {
            Some((_, Target::Clipboard)) => ctx.copy_text(text),
            Some((_, Target::HandOn)) => {
                self.handed_on = Some(text);
                ctx.request_repaint();
            }
            Some((tile, Target::File(path))) => {
                self.done.push((tile, path, text));
                ctx.request_repaint();
            }
            None => {}
        }
    }

    /// Numbers that are to be written.
    pub fn next_numbers(&mut self) -> Option<(Tile, PathBuf, String)> {
        self.done.pop()
    }

    /// Numbers that are to be handed on.
    pub fn handed_on(&mut self) -> Option<String> {
        self.handed_on.take()
    }
}
