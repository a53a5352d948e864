//! Acting on the export dialog: its name, its preview, its job.

use super::engine::Question;
use super::error::AppError;
use super::hand_on::{Choices, Key, What, moments};
use super::hand_on_files::{Order, in_own_folder, index_of};
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

/// Returns the key of the preview for the window as it is.
fn key_of(state: &State, results: &Results) -> Key {
    let document = &state.document;
    let bits = |incident: crate::compute::direction::Incident| incident.0.vector().to_array().map(f64::to_bits);
    Key {
        choices: state.settings.hand_on.clone(),
        scene: document.scene.clone(),
        selection: document.selection.clone(),
        incident: state.incident.map(bits),
        compared: compared(state),
        year: (results.annual.revision, state.settings.year),
        ranking: (results.rank.revision, state.settings.choose.clone()),
        language: language(),
    }
}

/// Returns the compared tile and the place of the reference.
fn compared(state: &State) -> (TileKind, usize) {
    (TileKind::titled(state.compare.tile()).unwrap_or(TileKind::Room), state.compare.base)
}

/// Returns the files that are written for a path.
pub fn targets(state: &State, path: &Path) -> Vec<PathBuf> {
    let choices = &state.settings.hand_on;
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
    /// Opens the dialog with this content.
    pub(super) fn hand_on(&mut self, what: What, tile: Option<Tile>) {
        let choices = &mut self.state.settings.hand_on;
        choices.what = what;
        if let Some(kind) = tile.and_then(|tile| TileKind::titled(tile.title)) {
            choices.tile = kind;
        }
        self.state.sheet = Some(Sheet::HandOn);
        self.offer_hand_on();
    }

    /// Proposes folder and name.
    pub(super) fn offer_hand_on(&mut self) {
        let start = start_path(&self.state, PathUse::HandOn);
        self.state.path = start.display().to_string();
        self.state.hand_on.offered = file_name(&self.state, PathUse::HandOn);
        self.state.replace = None;
    }

    /// Sets other choices. The proposed name follows them; of a name that the user typed only the extension does.
    pub(super) fn choose_hand_on(&mut self, choices: Choices) {
        let before = self.state.settings.hand_on.ending();
        self.state.settings.hand_on = choices;
        let ending = self.state.settings.hand_on.ending();
        if self.follow_name() {
            return;
        }
        if let Some(stem) = self.state.path.strip_suffix(before) {
            self.state.path = format!("{stem}{ending}");
            self.state.replace = None;
        }
    }

    /// Proposes the name for what the window shows now, unless the user has typed one; returns whether the field holds
    /// the proposed name.
    fn follow_name(&mut self) -> bool {
        let next = file_name(&self.state, PathUse::HandOn);
        let path = PathBuf::from(&self.state.path);
        let offered = path.file_name().is_some_and(|name| name.to_string_lossy() == self.state.hand_on.offered);
        if offered && self.state.hand_on.offered != next {
            self.state.path = path.with_file_name(&next).display().to_string();
            self.state.replace = None;
        }
        self.state.hand_on.offered = next;
        offered
    }

    /// Asks for folder and name in the desktop's dialog.
    pub(super) fn browse_hand_on(&mut self) {
        let (dialogs, start) = (self.services.dialogs.clone(), PathBuf::from(&self.state.path));
        self.start(Lane::Export, move |_| Outcome::Target(PathUse::HandOn, dialogs.save(PathUse::HandOn, &start)));
    }

    /// Returns the input of an export job; `None` before the catalogue is open and the product is read.
    pub(super) fn order(&self) -> Option<Order> {
        let state = &self.state;
        let selected = &state.document.selection.product;
        let product = state.product.clone().filter(|product| product.key == *selected)?;
        let key = key_of(state, &self.results);
        let numbers = state.hand_on.numbers.as_ref().filter(|(of, _)| *of == key).map(|(_, text)| text.clone());
        Some(Order {
            choices: state.settings.hand_on.clone(),
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
    pub(super) fn write_hand_on(&mut self, path: PathBuf) {
        self.state.sheet = Some(Sheet::HandOn);
        match self.order() {
            Some(order) => {
                self.writing = true;
                self.start(Lane::Export, move |progress| match order.write(&path, progress) {
                    Ok((path, warning)) => Outcome::Written(PathUse::HandOn, Ok(path)).with_warning(warning),
                    Err(error) => Outcome::Written(PathUse::HandOn, Err(error)),
                });
            }
            None => self.tell(&AppError::NoProduct),
        }
    }

    /// Updates the preview while the dialog is open and nothing is being dragged or computed.
    pub(super) fn ask_preview(&mut self) {
        if self.state.sheet != Some(Sheet::HandOn) {
            if self.state.hand_on.asked.take().is_some() {
                self.jobs.cancel(Lane::Preview);
                self.state.hand_on.shown = None;
                self.state.hand_on.numbers = None;
            }
            return;
        }
        self.follow_name();
        let key = key_of(&self.state, &self.results);
        let lanes = [Lane::Catalogue, Lane::Scene, Lane::Product, Lane::Lid, Lane::Room, Lane::Year, Lane::Rank];
        let moving = self.ctx.input(|input| input.pointer.any_down());
        let known = self.state.hand_on.asked.as_ref() == Some(&key);
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
            self.state.hand_on.asked = Some(key);
            self.state.hand_on.shown = Some(Err(lacks.into()));
            return;
        }
        if order.choices.what == What::Table && order.numbers.is_none() {
            // The next frame's drawing gives them.
            if let Some(tile) = tile_of(order.choices.tile) {
                self.export.ask_hand_on(tile);
                self.bring_up(tile);
                self.ctx.request_repaint();
            }
            return;
        }
        self.state.hand_on.asked = Some(key);
        let path = PathBuf::from(&self.state.path);
        self.start(Lane::Preview, move |progress| Outcome::Preview(order.preview(&path, progress)));
    }

    /// Stores the numbers that a tile gave for the dialog.
    pub(super) fn take_numbers(&mut self) {
        if let Some(text) = self.export.handed_on() {
            self.state.hand_on.numbers = Some((key_of(&self.state, &self.results), text));
        }
    }
}
