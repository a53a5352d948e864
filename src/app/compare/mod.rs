//! The comparison: its list, the computation of candidates, commands from the tiles of a candidate, and its drawing.

mod beside;
pub mod columns;
mod curves;
mod difference;
mod figures;
pub mod panel;
mod places;
pub mod view;

use crate::app::catalogue::library::WindowLibrary;
use crate::app::command::Command;
use crate::app::results::engine::Question;
use crate::app::results::work::{Compared, LoadedSelection, Outcome, daylight, take_from_shelf};
use crate::app::scene::control;
use crate::app::scene::first_choice::choose_first_listed;
use crate::app::scene::{own_system, rule, selection_of};
use crate::app::shell::Shell;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::app::state::{Document, State};
use crate::app::tiles;
use crate::app::title;
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Progress;
use crate::compute::lid::c_gamma::Peaks;
use crate::report::TileKind;
use crate::study::comparison::{DataFacts, FIGURES, Facts, MOST, Row, candidate, compare, csv};
use crate::study::control::year::CONTROLLED;
use crate::study::scene_file::{CompareKeys, ControlMode, SceneFile, SystemKeys};
use crate::study::system::Need;
use crate::study::{Library, Scene, SystemLibrary as _};
use crate::texts::{Language, compare as texts, language};
use columns::{Column, Columns};
use std::sync::Arc;
use view::{Act, Look, Part, View};

/// Returns the entry of a candidate that shows the same as a document, with the given name.
fn keys_of(document: &Document, name: String) -> CompareKeys {
    let selection = &document.selection;
    let controlled = selection.state == CONTROLLED;
    let own = own_system(&document.scene);
    let system = if own.is_some() || selection.product.is_empty() {
        document.scene.aperture.first().map(|aperture| aperture.system.clone())
    } else {
        let state = Some(selection.state.clone()).filter(|state| !state.is_empty());
        Some(SystemKeys::Catalogue { key: selection.product.clone(), state })
    };
    let control = rule(&document.scene, 0).filter(|_| controlled || own.is_some()).cloned();
    CompareKeys { name, system, control, ..CompareKeys::default() }
}

/// Returns the name of a control rule as part of a longer name.
fn rule_words(mode: ControlMode) -> String {
    let short = control::words(mode).short;
    // German nouns keep their capital.
    if language() == Language::English { short.to_lowercase() } else { short.to_owned() }
}

/// Returns the name of the current product and state, with the control rule instead of the state that it currently
/// chooses.
fn shown_words(state: &State) -> String {
    if state.document.selection.state == CONTROLLED && own_system(&state.document.scene).is_none() {
        return format!("{}, {}", title::product(state), rule_words(state.control_mode()));
    }
    title::in_room(state)
}

/// Returns the kinds of results that a tile needs in the given display of the comparison.
fn parts(look: Look, tile: Option<TileKind>) -> &'static [Part] {
    use TileKind::{Btdf, Choose, Control, Lid, Room, Sky, Transmittance, Year};
    match (look, tile) {
        (Look::Figures, _) => &[Part::Shelf, Part::Data, Part::Room, Part::Lid, Part::Peaks],
        (_, Some(Btdf | Transmittance)) => &[Part::Shelf],
        (Look::Beside, Some(Sky)) => &[Part::Shelf, Part::Lid],
        (Look::Beside, Some(Lid)) => &[Part::Shelf, Part::Lid, Part::Peaks],
        (_, Some(Sky)) => &[Part::Shelf],
        (_, Some(Lid)) => &[Part::Shelf, Part::Lid],
        (_, Some(Room)) => &[Part::Shelf, Part::Room],
        (Look::Beside, Some(Control)) => &[Part::Shelf, Part::Year],
        (_, Some(Control)) => &[Part::Shelf],
        (_, None | Some(Year | Choose)) => &[Part::Shelf, Part::Room, Part::Lid, Part::Peaks],
    }
}

/// All kinds of results that tiles draw.
const ALL: &[Part] = &[Part::Shelf, Part::Room, Part::Surfaces, Part::Lid, Part::Peaks, Part::Year];

/// Replaces the scene by a candidate, given by its position, as one undo step.
fn take_candidate(shell: &mut Shell, place: usize) {
    shell.end_step();
    let document = &mut shell.state.document;
    let own = candidate(&document.scene, &document.scene.compare[place]);
    let compare = std::mem::take(&mut document.scene.compare);
    document.scene = SceneFile { compare, ..own };
    if let Some(selection) = selection_of(&document.scene) {
        document.selection = selection;
    }
    shell.end_step();
    (shell.state.compare.open, shell.state.compare.swapped) = (false, None);
}

/// Says that the comparison is empty.
fn say_empty(shell: &mut Shell) {
    shell.toasts.info(texts::COMPARISON_EMPTY);
}

/// Changes the display of the comparison, and shows it.
fn look_at(shell: &mut Shell, change: impl FnOnce(&mut View)) {
    if shell.state.document.scene.compare.is_empty() {
        return say_empty(shell);
    }
    change(&mut shell.state.compare);
    shell.state.compare.open = true;
    shell.state.compare.swapped = None;
}

/// Changes the list of candidates, as one undo step.
fn edit_comparison(shell: &mut Shell, change: impl FnOnce(&mut Vec<CompareKeys>)) {
    shell.end_step();
    change(&mut shell.state.document.scene.compare);
    shell.end_step();
    let left = shell.state.document.scene.compare.len();
    let view = &mut shell.state.compare;
    (view.open, view.naming, view.swapped, view.other) = (view.open && left > 0, None, None, None);
    view.base = view.base.min(left.saturating_sub(1));
}

/// Adds a candidate, or says why not.
fn add_candidate(shell: &mut Shell, keys: CompareKeys) {
    let comparison = &shell.state.document.scene.compare;
    let known = |other: &CompareKeys| CompareKeys { name: keys.name.clone(), ..other.clone() } == keys;
    if comparison.len() >= MOST {
        shell.toasts.info(texts::comparison_full(MOST));
    } else if keys.system.is_none() && keys.aperture.is_empty() {
        shell.toasts.info(texts::NOTHING_SHOWN);
    } else if comparison.iter().any(known) {
        shell.toasts.info(texts::ALREADY_IN_COMPARISON);
    } else {
        edit_comparison(shell, |comparison| comparison.push(keys));
    }
}

/// Adds a listed product as a candidate.
fn add_product(shell: &mut Shell, key: String) {
    let Some(entry) = shell.state.found.entries.iter().find(|entry| entry.key == key).cloned() else {
        shell.toasts.info(texts::NOT_LISTED);
        return;
    };
    let mut document = shell.state.document.clone();
    choose_first_listed(&mut document, &entry);
    let how = match (control::first_keys(entry.rule), entry.moves()) {
        (Some(keys), _) => format!(", {}", rule_words(keys.mode)),
        (None, true) => format!(", {}", entry.state()),
        (None, false) => String::new(),
    };
    add_candidate(shell, keys_of(&document, format!("{}{how}", entry.name)));
}

impl Columns {
    /// Executes a command about the comparison.
    pub fn act(&mut self, shell: &mut Shell, act: Act) {
        self.stopped = false;
        let count = shell.state.document.scene.compare.len();
        match act {
            Act::Add => add_candidate(shell, keys_of(&shell.state.document, shown_words(&shell.state))),
            Act::AddMoment => {
                let name = format!("{} · {}", shown_words(&shell.state), title::time(&shell.state.document.scene));
                let sky = Some(shell.state.document.scene.sky.clone());
                add_candidate(shell, CompareKeys { sky, ..keys_of(&shell.state.document, name) });
            }
            Act::AddScene => {
                let scene = shell.state.document.scene.clone();
                let name = format!("{} · {}", shown_words(&shell.state), title::place(&scene));
                add_candidate(
                    shell,
                    CompareKeys {
                        name,
                        system: None,
                        control: scene.control,
                        sky: Some(scene.sky),
                        site: Some(scene.site),
                        room: Some(scene.room),
                        aperture: scene.aperture,
                        sensors: Some(scene.sensors),
                    },
                );
            }
            Act::AddProduct(key) => add_product(shell, key),
            Act::Take(place) if place < count => take_candidate(shell, place),
            Act::Remove(place) if place < count => edit_comparison(shell, |comparison| drop(comparison.remove(place))),
            Act::Move(place, step) if place < count => {
                let to = place.saturating_add_signed(step).min(count - 1);
                edit_comparison(shell, |comparison| {
                    let one = comparison.remove(place);
                    comparison.insert(to, one);
                });
            }
            Act::EditName(naming) => shell.state.compare.naming = naming,
            Act::Rename(place, name) if place < count => {
                shell.state.compare.naming = None;
                edit_comparison(shell, |comparison| comparison[place].name = name.trim().to_owned());
            }
            Act::Clear => edit_comparison(shell, Vec::clear),
            Act::Show if count == 0 && !shell.state.compare.open => say_empty(shell),
            Act::Show => {
                shell.state.compare.open ^= true;
                shell.state.compare.swapped = None;
            }
            Act::Look(look) => look_at(shell, |view| view.look = look),
            Act::Tile(tile) => look_at(shell, |view| view.tile = tile),
            Act::Log(log) => shell.state.compare.log = Some(log),
            Act::Base(place) => look_at(shell, |view| view.base = place),
            Act::Swap => self.swap(shell),
            Act::SwapWith(place) => {
                shell.state.compare.open = false;
                shell.state.compare.swapped = (place < count).then_some(place);
                shell.state.compare.other = shell.state.compare.swapped;
            }
            Act::Copy => {
                let names = self.names();
                shell.ctx.copy_text(csv(&self.rows(), &names));
                shell.toasts.info(texts::COPIED);
            }
            Act::Resume | Act::Take(_) | Act::Remove(_) | Act::Move(..) | Act::Rename(..) => {}
        }
    }

    /// Shows another candidate in the tiles, or the scene again.
    fn swap(&self, shell: &mut Shell) {
        let view = &mut shell.state.compare;
        if view.swapped.take().is_some() {
            return;
        }
        let own = &shell.state.document;
        let list = &self.list;
        let chosen = view.other.filter(|place| list.get(*place).is_some_and(|column| !column.shows(own)));
        match chosen.or_else(|| list.iter().position(|column| !column.shows(own))) {
            Some(other) => (view.swapped, view.open) = (Some(other), false),
            None => {
                shell.toasts.info(texts::NOTHING_TO_SWAP);
            }
        }
    }

    /// Starts the computation of the next missing results of the visible candidates.
    pub fn ask(&mut self, shell: &mut Shell) {
        // The list may have changed by undo, or by a scene that was opened.
        let count = shell.state.document.scene.compare.len();
        let view = &mut shell.state.compare;
        view.swapped = view.swapped.filter(|place| *place < count);
        view.open &= count > 0;
        if self.follow(&shell.state, &shell.results) {
            shell.jobs.cancel(Lane::Compare);
        }
        let view = &shell.state.compare;
        let own = [Lane::Scene, Lane::Product, Lane::Lid, Lane::Room].into_iter().any(|lane| shell.jobs.busy(lane));
        if self.stopped || shell.jobs.busy(Lane::Compare) || own && !view.open {
            return;
        }
        let (columns, parts) = match (view.open, view.swapped) {
            (true, _) => (0..count, parts(view.look, TileKind::titled(view.tile()))),
            (false, Some(place)) => (place..place + 1, ALL),
            (false, None) => return,
        };
        let Some(shelf) = shell.state.shelf() else { return };
        // What the window computes for itself anyway is taken over from there.
        let document = &shell.state.document;
        let elsewhere = |place: &usize| own && self.list.get(*place).is_some_and(|one| one.shows(document));
        let Some((column, part)) = self.next(columns.filter(|place| !elsewhere(place)), parts) else { return };
        let question = Question { scene: column.scene().clone(), base: shell.state.base(), shelf };
        let (id, engine, files) = (column.id, shell.services.engine.clone(), shell.library.clone());
        let lid = column.results.lid.value.clone();
        let dataset = column.state.dataset.value.clone();
        let year = column.year_key().zip(column.state.product.clone());
        self.running = Some((id, part));
        shell.start(Lane::Compare, move |job| {
            let missing = || Compared::Failed(part, texts::NOT_THERE.into());
            let done = match part {
                Part::Shelf => shelf_part(&question, &files, job),
                Part::Lid => Compared::Lid(engine.lid(&question, job)),
                Part::Room => Compared::Room(engine.room(&question, job)),
                Part::Surfaces => Compared::Surfaces(engine.surfaces(&question, job)),
                Part::Peaks => lid.map_or_else(missing, |lid| {
                    Peaks::of(&lid.lid, job).map_or_else(|_| missing(), |peaks| Compared::Peaks(lid, peaks))
                }),
                Part::Year => {
                    year.map_or_else(missing, |(key, product)| Compared::Year(control::year(&product, key, job)))
                }
                Part::Data => Compared::Data(dataset.and_then(|dataset| DataFacts::of(&dataset))),
            };
            Outcome::Compared(id, Box::new(done))
        });
    }

    /// Returns the table of figures of the candidates.
    pub fn rows(&self) -> Vec<Row> {
        let facts: Vec<Facts> = self.list.iter().map(Column::facts).collect();
        compare(FIGURES, &facts.iter().collect::<Vec<_>>())
    }

    /// Redirects commands from the tiles of a candidate to the scene, if they change something that the candidate takes
    /// from the scene. `place`: position of the candidate; `document`: document of the window; `from`: index of the
    /// first of these commands in the list.
    pub fn retarget(&self, place: usize, document: &Document, from: usize, commands: &mut Vec<Command>) {
        let Some(column) = self.list.get(place) else { return };
        let own = commands.split_off(from);
        commands.extend(own.into_iter().filter_map(|command| match command {
            Command::Scene(changed) => {
                let scene = shared(&document.scene, &column.keys, *changed);
                (scene != document.scene).then(|| Command::Scene(Box::new(scene)))
            }
            Command::Incidence(_)
            | Command::RoomLook(_)
            | Command::ExportTile(_)
            | Command::CopyTile(_)
            | Command::CopyValue
            | Command::Maximise(_) => Some(command),
            _ => None,
        }));
    }
}

impl View {
    /// Returns the key of the compared tile.
    pub fn tile(&self) -> &'static str {
        let known = tiles::compared().map(|tile| tile.title);
        known.clone().find(|title| *title == self.tile).unwrap_or(TileKind::Room.title())
    }
}

/// Returns the scene with the changes made in a candidate's scene, except for what the candidate fixes itself.
fn shared(scene: &SceneFile, keys: &CompareKeys, changed: SceneFile) -> SceneFile {
    let mut scene = scene.clone();
    if keys.sky.is_none() {
        scene.sky = changed.sky;
    }
    if keys.sensors.is_none() {
        scene.sensors = changed.sensors;
    }
    if keys.room.is_none() {
        scene.room = changed.room;
    }
    if keys.site.is_none() {
        scene.site = changed.site;
    }
    scene
}

/// Returns state and dataset of a scene whose first aperture contains a dataset file or an ideal system, not a product.
fn own_part(question: &Question, files: &Library, progress: &dyn Progress) -> Result<(String, Arc<Dataset>), AppError> {
    let Question { scene, base, shelf } = question;
    let library = WindowLibrary { files, shelf: &**shelf, progress };
    // Resolved first: the control may pick the state.
    let resolved = Scene::resolve_within(scene, base, &library, progress)?;
    let state = resolved.apertures.first().ok_or(AppError::NoAperture)?.system.state.clone();
    let keys = match &scene.aperture[0].system {
        SystemKeys::File { path, .. } if !state.is_empty() => {
            SystemKeys::File { path: path.clone(), state: Some(state.clone()) }
        }
        keys => keys.clone(),
    };
    Ok((state, library.load(&keys, base, Need::Everything)?.dataset.clone()))
}

/// Reads product, state and dataset of a candidate (computed, if the catalogue does not contain it yet), and computes
/// its sky and sun.
fn shelf_part(question: &Question, files: &Library, progress: &dyn Progress) -> Compared {
    let Question { scene, base, shelf } = question;
    let daylight = daylight(scene, base, progress);
    let Some(selection) = selection_of(scene) else {
        return Compared::Own(own_part(question, files, progress), daylight);
    };
    let found = take_from_shelf(&**shelf, &selection, scene, daylight.as_ref().ok(), (0, base)).and_then(|found| {
        if found.dataset.is_some() {
            return Ok(found);
        }
        shelf.provide(&selection.product, Some(&found.state), progress)?;
        let dataset = Some(shelf.load(&selection.product, Some(&found.state))?);
        Ok(LoadedSelection { dataset, ..found })
    });
    Compared::Shelf(found, daylight)
}
