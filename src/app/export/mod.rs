//! Export from the window: its dialog with a preview, files of tiles and luminaires, and the clipboard.

pub mod choices;
mod clipboard;
mod files;
mod name;
mod numbers;

pub use clipboard::{copy_value, take_copied};
use name::file_name;
pub use name::start_path;
pub use numbers::Numbers;

use super::rank::present_ranking;
use super::shell::Shell;
use super::state::{PathUse, Results, Sheet, State, Tile};
use super::tiles::TILES;
use crate::app::results::engine::Question;
use crate::app::results::work::Outcome;
use crate::app::shell::disk::write_whole;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::{Jobs, Lane};
use crate::report::TileKind;
use crate::study::luminaire_set::tile_name;
use crate::texts::{choose, export as texts, language, year as say};
use choices::{Choices, Key, Preview, What, moments};
use files::{Order, in_own_folder, index_of};
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

/// State of exports: the dialog, and what is being written.
#[derive(Default)]
pub struct Export {
    /// Key of the requested preview; `None` if none was requested.
    asked: Option<Key>,
    /// Last preview, or the reason why there is none.
    shown: Option<Result<Preview, String>>,
    /// Number of previews so far, by which the picture's texture is updated.
    revision: u64,
    /// Numbers of a tile as CSV, with the key of the preview that they belong to.
    table: Option<(Key, String)>,
    /// File name that the program proposed; any other name in the field was typed by the user.
    offered: String,
    /// Requests for numbers of tiles.
    requests: Numbers,
    /// Path to which the luminous intensity distribution (LID) is to be written as soon as it is up to date.
    lid_to: Option<PathBuf>,
    /// Whether a file is being written.
    writing: bool,
}

impl Export {
    /// Returns the last preview, or the reason why there is none; `None` before there is one.
    pub const fn preview(&self) -> Option<&Result<Preview, String>> {
        self.shown.as_ref()
    }

    /// Returns the number of previews so far, by which the picture's texture is updated.
    pub const fn revision(&self) -> u64 {
        self.revision
    }

    /// Returns the requests for numbers of tiles.
    pub const fn requests(&mut self) -> &mut Numbers {
        &mut self.requests
    }

    /// Whether a file is being written.
    pub const fn is_writing(&self) -> bool {
        self.writing
    }

    /// Whether the luminous intensity distribution (LID) is to be written as soon as it is up to date.
    pub const fn awaits_lid(&self) -> bool {
        self.lid_to.is_some()
    }

    /// Writes the luminous intensity distribution (LID) to a path as soon as it is up to date.
    pub fn ask_lid(&mut self, path: PathBuf) {
        self.lid_to = Some(path);
    }

    /// Notes whether the job that writes a file has ended.
    pub fn follow(&mut self, jobs: &Jobs<Outcome>) {
        self.writing &= jobs.busy(Lane::Export);
    }

    /// Takes over a preview, or the reason why there is none.
    pub fn take_preview(&mut self, preview: Result<Preview, String>) {
        self.revision += 1;
        self.shown = Some(preview);
    }

    /// Opens the export dialog with this kind of content and this tile.
    pub fn open(&mut self, shell: &mut Shell, what: What, tile: Option<Tile>) {
        let choices = &mut shell.state.settings.export;
        choices.what = what;
        if let Some(kind) = tile.and_then(|tile| TileKind::titled(tile.title)) {
            choices.tile = kind;
        }
        shell.state.sheet = Some(Sheet::Export);
        self.propose_path(shell);
    }

    /// Proposes folder and name of the exported file.
    pub fn propose_path(&mut self, shell: &mut Shell) {
        let start = start_path(&shell.state, PathUse::Export);
        shell.state.path = start.display().to_string();
        self.offered = file_name(&shell.state, PathUse::Export);
        shell.state.replace = None;
    }

    /// Sets new choices of the export dialog, and updates the proposed name; of a name that the user has typed only the
    /// extension is changed.
    pub fn set_choices(&mut self, shell: &mut Shell, choices: Choices) {
        let before = shell.state.settings.export.ending();
        shell.state.settings.export = choices;
        let ending = shell.state.settings.export.ending();
        if self.follow_name(shell) {
            return;
        }
        if let Some(stem) = shell.state.path.strip_suffix(before) {
            shell.state.path = format!("{stem}{ending}");
            shell.state.replace = None;
        }
    }

    /// Proposes the file name for the current state of the window, unless the user has typed one; returns whether the
    /// field contains the proposed name.
    fn follow_name(&mut self, shell: &mut Shell) -> bool {
        let next = file_name(&shell.state, PathUse::Export);
        let path = PathBuf::from(&shell.state.path);
        let offered = path.file_name().is_some_and(|name| name.to_string_lossy() == self.offered);
        if offered && self.offered != next {
            shell.state.path = path.with_file_name(&next).display().to_string();
            shell.state.replace = None;
        }
        self.offered = next;
        offered
    }

    /// Asks for folder and name in the desktop's dialog.
    pub fn browse(shell: &mut Shell) {
        let (dialogs, start) = (shell.services.dialogs.clone(), PathBuf::from(&shell.state.path));
        shell.start(Lane::Export, move |_| Outcome::Target(PathUse::Export, dialogs.save(PathUse::Export, &start)));
    }

    /// Returns the input of an export job; `None` until the catalogue is open and the product has been read.
    pub fn order(&self, shell: &Shell) -> Option<Order> {
        let state = &shell.state;
        let selected = &state.document.selection.product;
        let product = state.product.clone().filter(|product| product.key == *selected)?;
        let key = key_of(state, &shell.results);
        let numbers = self.table.as_ref().filter(|(of, _)| *of == key).map(|(_, text)| text.clone());
        Some(Order {
            choices: state.settings.export.clone(),
            question: Question { scene: state.document.scene.clone(), base: state.base(), shelf: state.shelf()? },
            incident: state.incident,
            product: Some(product),
            dataset: state.dataset.value.clone().filter(|_| !state.dataset.stale),
            compared: compared(state),
            scene_path: state.scene_path.clone(),
            year: shell.results.year_of(&state.document.scene).map(|annual| (annual, state.settings.year)),
            ranking: present_ranking(shell).map(|list| (list, state.settings.choose.clone())),
            numbers,
            engine: shell.services.engine.clone(),
        })
    }

    /// Starts writing the export.
    pub fn start(&mut self, shell: &mut Shell, path: PathBuf) {
        shell.state.sheet = Some(Sheet::Export);
        match self.order(shell) {
            Some(order) => {
                self.writing = true;
                shell.start(Lane::Export, move |progress| match order.write(&path, progress) {
                    Ok((path, warning)) => Outcome::Written(PathUse::Export, Ok(path)).with_warning(warning),
                    Err(error) => Outcome::Written(PathUse::Export, Err(error)),
                });
            }
            None => shell.report_error(&AppError::NoProduct),
        }
    }

    /// Starts a new preview if the dialog is open, its input has changed, and nothing is being dragged or computed.
    pub fn ask_preview(&mut self, shell: &mut Shell) {
        if shell.state.sheet != Some(Sheet::Export) {
            if self.asked.take().is_some() {
                shell.jobs.cancel(Lane::Preview);
                self.shown = None;
                self.table = None;
            }
            return;
        }
        self.follow_name(shell);
        let key = key_of(&shell.state, &shell.results);
        let lanes = [Lane::Catalogue, Lane::Scene, Lane::Product, Lane::Lid, Lane::Room, Lane::Year, Lane::Rank];
        let moving = shell.ctx.input(|input| input.pointer.any_down());
        let known = self.asked.as_ref() == Some(&key);
        if known || moving || lanes.into_iter().any(|lane| shell.jobs.busy(lane)) {
            return;
        }
        let Some(order) = self.order(shell) else { return };
        let of_tile = |tile| matches!(order.choices.what, What::Table | What::Picture) && order.choices.tile == tile;
        let lacks = match order.choices.tile {
            TileKind::Year if of_tile(TileKind::Year) && order.year.is_none() => Some(say::NO_YEAR),
            TileKind::Choose if of_tile(TileKind::Choose) && order.ranking.is_none() => Some(choose::NO_RANKING),
            _ => None,
        };
        if let Some(lacks) = lacks {
            // Its tile has nothing to give, however often it is asked.
            self.asked = Some(key);
            self.shown = Some(Err(lacks.into()));
            return;
        }
        if order.choices.what == What::Table && order.numbers.is_none() {
            // The next frame's drawing gives them.
            if let Some(tile) = tile_of(order.choices.tile) {
                self.requests.ask_for_dialog(tile);
                shell.bring_up(tile);
                shell.ctx.request_repaint();
            }
            return;
        }
        self.asked = Some(key);
        let path = PathBuf::from(&shell.state.path);
        shell.start(Lane::Preview, move |progress| Outcome::Preview(order.preview(&path, progress)));
    }

    /// Stores the numbers that a tile has supplied for the export dialog.
    fn take_numbers(&mut self, shell: &Shell) {
        if let Some(text) = self.requests.take_of_dialog() {
            self.table = Some((key_of(&shell.state, &shell.results), text));
        }
    }

    /// Starts a job that writes a file; a closing window waits until it is finished.
    pub fn start_writing(&mut self, shell: &mut Shell, work: impl FnOnce() -> Outcome + Send + 'static) {
        self.writing = true;
        shell.start(Lane::Export, move |_| work());
    }

    fn write_lid(&mut self, shell: &mut Shell, path: PathBuf) {
        let shown = &shell.results.lid;
        if shown.stale && shown.value.is_some() {
            let why = shown.error.as_deref().unwrap_or(texts::OF_BEFORE.get());
            shell.toasts.error(texts::lid_not_written(why));
            return;
        }
        let (engine, lid) = (shell.services.engine.clone(), shown.value.clone());
        let made_from = shell.state.made_from();
        self.start_writing(shell, move || {
            let bytes = lid.ok_or(AppError::NoLid).and_then(|lid| engine.luminaire(&lid, &path));
            Outcome::Written(PathUse::ExportLid, bytes.and_then(|bytes| write_whole(&path, &bytes, &made_from)))
        });
    }

    /// Starts writing the scene.
    pub fn save_scene(&mut self, shell: &mut Shell, path: PathBuf) {
        let text = toml::to_string_pretty(&shell.state.document.scene).map_err(AppError::from);
        let made_from = shell.state.files_of_scene();
        self.start_writing(shell, move || {
            let written = text.and_then(|text| write_whole(&path, text.as_bytes(), &made_from));
            Outcome::Written(PathUse::SaveScene, written)
        });
    }

    /// Requests the numbers of a tile for a file, and shows the tile.
    pub fn ask_tile(&mut self, shell: &mut Shell, tile: Tile, path: PathBuf) {
        match self.requests.ask(tile, path) {
            Ok(()) => shell.bring_up(tile),
            Err(error) => shell.report_error(&error),
        }
    }

    /// Requests the numbers of a tile for the clipboard, and shows the tile.
    pub fn copy_tile(&mut self, shell: &mut Shell, tile: Tile) {
        self.requests.ask_copy(tile);
        shell.bring_up(tile);
    }

    /// Takes over the numbers that tiles have returned, and starts writing what is due. `is_complete`: whether all
    /// visible results are.
    pub fn write_due(&mut self, shell: &mut Shell, is_complete: bool) {
        self.take_numbers(shell);
        if shell.jobs.busy(Lane::Export) {
            return;
        }
        // What is written is of what its name says: what is being computed is waited for.
        if self.lid_to.is_some()
            && is_complete
            && let Some(path) = self.lid_to.take()
        {
            return self.write_lid(shell, path);
        }
        if let Some((tile, path, text)) = self.requests.next_for_file() {
            let made_from = shell.state.made_from();
            self.start_writing(shell, move || {
                Outcome::Written(PathUse::ExportTile(tile), write_whole(&path, text.as_bytes(), &made_from))
            });
        }
    }
}
