//! Execution of commands about the export dialog: proposed name, preview, export job.

use super::engine::Question;
use super::error::AppError;
use super::export_choices::{Choices, Key, What, moments};
use super::export_files::{Order, in_own_folder, index_of};
use super::jobs::Lane;
use super::naming::file_name;
use super::naming::start_path;
use super::state::{PathUse, Results, Sheet, State, Tile};
use super::tiles::TILES;
use super::window::App;
use super::work::Outcome;
use crate::report::TileKind;
use crate::study::luminaire_set::tile_name;
use crate::texts::{choose, language, year as say};
use std::path::{Path, PathBuf};

/// Returns the key of the preview for the current state of the window.
fn key_of(state: &State, results: &Results) -> Key {
    let document = &state.document;
    let bits = |incident: crate::compute::direction::Incident| incident.0.vector().to_array().map(f64::to_bits);
    Key {
        choices: state.settings.export.clone(),
        scene: document.scene.clone(),
        selection: document.selection.clone(),
        incident: state.incident.map(bits),
        compared: compared(state),
        year: (results.annual.revision, state.settings.year),
        ranking: (results.rank.revision, state.settings.choose.clone()),
        language: language(),
    }
}

/// Returns the compared tile and the position of the reference candidate.
fn compared(state: &State) -> (TileKind, usize) {
    (TileKind::titled(state.compare.tile()).unwrap_or(TileKind::Room), state.compare.base)
}

/// Returns the paths of all files that an export to `path` writes.
pub fn targets(state: &State, path: &Path) -> Vec<PathBuf> {
    let choices = &state.settings.export;
    let mut list = vec![path.to_owned()];
    if choices.what == What::Luminaire && choices.tiles {
        // How many there will be is not known before; the index and the first stand for all.
        let path = in_own_folder(path);
        list = vec![index_of(&path), path.with_file_name(tile_name(&path, Some(0)))];
    }
    if choices.what == What::Series {
        let moments = moments(choices, &state.document.scene, &state.base(), state.product.as_deref(), path);
        list.extend(moments.into_iter().map(|moment| path.with_file_name(moment.name)));
    }
    list
}

fn tile_of(kind: TileKind) -> Option<Tile> {
    TILES.iter().map(|entry| entry.tile).find(|tile| tile.title == kind.title())
}

impl App {
    /// Opens the export dialog with this kind of content and this tile.
    pub(super) fn open_export(&mut self, what: What, tile: Option<Tile>) {
        let choices = &mut self.state.settings.export;
        choices.what = what;
        if let Some(kind) = tile.and_then(|tile| TileKind::titled(tile.title)) {
            choices.tile = kind;
        }
        self.state.sheet = Some(Sheet::Export);
        self.propose_export_path();
    }

    /// Proposes folder and name of the exported file.
    pub(super) fn propose_export_path(&mut self) {
        let start = start_path(&self.state, PathUse::Export);
        self.state.path = start.display().to_string();
        self.state.export.offered = file_name(&self.state, PathUse::Export);
        self.state.replace = None;
    }

    /// Sets new choices of the export dialog, and updates the proposed name; of a name that the user has typed only the
    /// extension is changed.
    pub(super) fn set_export_choices(&mut self, choices: Choices) {
        let before = self.state.settings.export.ending();
        self.state.settings.export = choices;
        let ending = self.state.settings.export.ending();
        if self.follow_name() {
            return;
        }
        if let Some(stem) = self.state.path.strip_suffix(before) {
            self.state.path = format!("{stem}{ending}");
            self.state.replace = None;
        }
    }

    /// Proposes the file name for the current state of the window, unless the user has typed one; returns whether the
    /// field contains the proposed name.
    fn follow_name(&mut self) -> bool {
        let next = file_name(&self.state, PathUse::Export);
        let path = PathBuf::from(&self.state.path);
        let offered = path.file_name().is_some_and(|name| name.to_string_lossy() == self.state.export.offered);
        if offered && self.state.export.offered != next {
            self.state.path = path.with_file_name(&next).display().to_string();
            self.state.replace = None;
        }
        self.state.export.offered = next;
        offered
    }

    /// Asks for folder and name in the desktop's dialog.
    pub(super) fn browse_export(&mut self) {
        let (dialogs, start) = (self.services.dialogs.clone(), PathBuf::from(&self.state.path));
        self.start(Lane::Export, move |_| Outcome::Target(PathUse::Export, dialogs.save(PathUse::Export, &start)));
    }

    /// Returns the input of an export job; `None` until the catalogue is open and the product has been read.
    pub(super) fn order(&self) -> Option<Order> {
        let state = &self.state;
        let selected = &state.document.selection.product;
        let product = state.product.clone().filter(|product| product.key == *selected)?;
        let key = key_of(state, &self.results);
        let numbers = state.export.numbers.as_ref().filter(|(of, _)| *of == key).map(|(_, text)| text.clone());
        Some(Order {
            choices: state.settings.export.clone(),
            question: Question { scene: state.document.scene.clone(), base: state.base(), shelf: state.shelf()? },
            incident: state.incident,
            product: Some(product),
            dataset: state.dataset.value.clone().filter(|_| !state.dataset.stale),
            compared: compared(state),
            scene_path: state.scene_path.clone(),
            year: self.present_year().map(|annual| (annual, state.settings.year)),
            ranking: self.present_ranking().map(|list| (list, state.settings.choose.clone())),
            numbers,
            engine: self.services.engine.clone(),
        })
    }

    /// Starts writing the export.
    pub(super) fn start_export(&mut self, path: PathBuf) {
        self.state.sheet = Some(Sheet::Export);
        match self.order() {
            Some(order) => {
                self.writing = true;
                self.start(Lane::Export, move |progress| match order.write(&path, progress) {
                    Ok((path, warning)) => Outcome::Written(PathUse::Export, Ok(path)).with_warning(warning),
                    Err(error) => Outcome::Written(PathUse::Export, Err(error)),
                });
            }
            None => self.report_error(&AppError::NoProduct),
        }
    }

    /// Starts a new preview if the dialog is open, its input has changed, and nothing is being dragged or computed.
    pub(super) fn ask_preview(&mut self) {
        if self.state.sheet != Some(Sheet::Export) {
            if self.state.export.asked.take().is_some() {
                self.jobs.cancel(Lane::Preview);
                self.state.export.shown = None;
                self.state.export.numbers = None;
            }
            return;
        }
        self.follow_name();
        let key = key_of(&self.state, &self.results);
        let lanes = [Lane::Catalogue, Lane::Scene, Lane::Product, Lane::Lid, Lane::Room, Lane::Year, Lane::Rank];
        let moving = self.ctx.input(|input| input.pointer.any_down());
        let known = self.state.export.asked.as_ref() == Some(&key);
        if known || moving || lanes.into_iter().any(|lane| self.jobs.busy(lane)) {
            return;
        }
        let Some(order) = self.order() else { return };
        let of_tile = |tile| matches!(order.choices.what, What::Table | What::Picture) && order.choices.tile == tile;
        let lacks = match order.choices.tile {
            TileKind::Year if of_tile(TileKind::Year) && order.year.is_none() => Some(say::NO_YEAR),
            TileKind::Choose if of_tile(TileKind::Choose) && order.ranking.is_none() => Some(choose::NO_RANKING),
            _ => None,
        };
        if let Some(lacks) = lacks {
            // Its tile has nothing to give, however often it is asked.
            self.state.export.asked = Some(key);
            self.state.export.shown = Some(Err(lacks.into()));
            return;
        }
        if order.choices.what == What::Table && order.numbers.is_none() {
            // The next frame's drawing gives them.
            if let Some(tile) = tile_of(order.choices.tile) {
                self.export.ask_for_dialog(tile);
                self.bring_up(tile);
                self.ctx.request_repaint();
            }
            return;
        }
        self.state.export.asked = Some(key);
        let path = PathBuf::from(&self.state.path);
        self.start(Lane::Preview, move |progress| Outcome::Preview(order.preview(&path, progress)));
    }

    /// Stores the numbers that a tile has supplied for the export dialog.
    pub(super) fn take_numbers(&mut self) {
        if let Some(text) = self.export.take_dialog_numbers() {
            self.state.export.numbers = Some((key_of(&self.state, &self.results), text));
        }
    }
}
