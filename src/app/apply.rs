//! Execution of commands: each goes to the feature that it is about. What concerns several (undo, paths, stopping) stands
//! here.

use super::catalogue::command::CatalogueCommand;
use super::catalogue::find_like;
use super::command::Command;
use super::export::choices::What;
use super::export::{Export, copy_value, start_path, targets};
use super::results::{measure_accuracy, stop_computing, weigh_obstructions};
use super::scene::{fill, first_scene};
use super::session::copy_report;
use super::shell::Shell;
use super::state::{PathUse, Sheet};
use super::window::App;
use super::year;
use crate::app::display::text_sizing::change_text_size;
use crate::app::results::work::Outcome;
use crate::app::scene::moment;
use crate::app::scene::outside;
use crate::app::scene::selection::{select_product, select_state, set_control, set_mode, step_row, step_state};
use crate::app::shell::jobs::Lane;
use crate::app::shell::paths::{ask_folder, ask_paths, ask_target};
use crate::app::shell::typed_path::with_ending;
use crate::app::tiles::docking::arrange;
use crate::study::Store;
use crate::study::scene_file::SceneFile;
use crate::texts::{choose, export as texts, shell, year as of_year};
use std::path::PathBuf;

/// Resets the scene to that of the first start. The first scene names no product: the one that is chosen stays, with
/// its rule.
fn reset_scene(shell: &mut Shell) {
    let document = &mut shell.state.document;
    let scene = &mut document.scene;
    let of_aperture = || scene.aperture.iter_mut().find_map(|one| one.control.take());
    let control = scene.control.take().or_else(of_aperture);
    *scene = SceneFile { compare: std::mem::take(&mut scene.compare), control, ..first_scene() };
    fill(scene, &document.selection);
}

impl App {
    /// Executes a command. Its change of the document is a separate undo step; changes by dragging or by repeated keys
    /// are merged into one step once they have ended.
    pub fn apply(&mut self, command: Command) {
        self.session.note(&command);
        let step = command.is_step();
        // What is there already is not added twice: some commands do it themselves.
        if step {
            self.shell.end_step();
        }
        self.act_on(command);
        if step {
            self.shell.end_step();
        }
    }

    fn act_on(&mut self, command: Command) {
        let shell = &mut self.shell;
        let state = &mut shell.state;
        match command {
            Command::Open => ask_paths(shell),
            Command::OpenFolder => ask_folder(shell),
            Command::SaveScene => {
                let start = start_path(state, PathUse::SaveScene);
                ask_target(shell, PathUse::SaveScene, &start);
            }
            Command::ExportMeasured => {
                let start = start_path(state, PathUse::ExportMeasured).with_file_name(self.goniophotometer.file_name());
                ask_target(shell, PathUse::ExportMeasured, &start);
            }
            Command::ExportLid => self.export.open(shell, What::Luminaire, None),
            Command::ExportTile(tile) => self.export.open(shell, What::Picture, Some(tile)),
            Command::ExportChoices(choices) => self.export.set_choices(shell, *choices),
            Command::BrowseExport => Export::browse(shell),
            Command::CopyTile(tile) => self.export.copy_tile(shell, tile),
            Command::CopyPicture(tile) => self.export.copy_picture(shell, tile),
            Command::CopyValue => copy_value(shell),
            Command::Incidence(chosen) => state.incident = chosen,
            Command::DataForm(form) => self.forms.look(shell, |look| look.form = form),
            Command::SchemeMap => self.forms.look(shell, |look| look.schemes ^= true),
            Command::Control(mode) => set_mode(shell, mode),
            Command::ControlKeys(keys) => set_control(shell, *keys),
            Command::ControlOf(index) => {
                state.control_of = index;
                // What was asked last is known by the document, which does not hold this choice: ask again by hand.
                shell.ask_again();
            }
            Command::Quit => shell.ctx.send_viewport_cmd(egui::ViewportCommand::Close),
            Command::Undo => self.step_history(false),
            Command::Redo => self.step_history(true),
            Command::Search => {
                // The field to type in may be hidden with its panel.
                state.settings.catalogue_open = true;
                state.focus_search = true;
                state.wants_keyboard = false;
            }
            Command::KeyboardTaken => state.wants_keyboard = false,
            Command::Palette => self.palette.toggle(shell),
            Command::EditPalette(text) => self.palette.edit(shell, text),
            Command::PaletteRow(row) => self.palette.choose(row),
            Command::Maximise(tile) => state.maximised = tile,
            Command::Arrange(what) => arrange(shell, what),
            Command::RoomLook(look) => state.settings.room = look,
            Command::RoomView(view) => state.settings.room.view = view,
            Command::Hour(hours) => {
                // A sun that is given by angles has no clock: the key does nothing then.
                moment::step(&mut state.document.scene, 0, 60 * hours);
            }
            Command::Day(days) => {
                moment::step(&mut state.document.scene, days, 0);
            }
            Command::NextState(step) => step_state(shell, step),
            Command::ToggleCatalogue => state.settings.catalogue_open ^= true,
            Command::ToggleScene => state.settings.scene_open ^= true,
            Command::Theme(choice) => {
                state.settings.theme = choice;
                choice.apply(&shell.ctx);
            }
            Command::Language(choice) => state.settings.language = choice,
            Command::TextSize(change) => change_text_size(shell, change),
            Command::StoreLimit(megabytes) => state.settings.store_limit = megabytes,
            Command::ClearStore => shell.services.engine.store().into_iter().for_each(Store::clear),
            Command::Tour(act) => self.tour.act(shell, act),
            Command::ResetScene => reset_scene(shell),
            Command::Sheet(sheet) => {
                // The key that opens a sheet also closes it.
                state.sheet = if state.sheet == sheet { None } else { sheet };
                if state.sheet == Some(Sheet::Export) {
                    self.export.propose_path(shell);
                }
            }
            Command::Cancel(lane) => self.cancel(lane),
            Command::Select(product) => select_product(shell, product),
            Command::SelectState(key) => select_state(shell, key),
            Command::Row(step) => step_row(shell, step),
            Command::Scene(scene) => state.document.scene = *scene,
            Command::Year(act) => year::act(shell, act),
            Command::Choose(act) => self.ranking.act(shell, act),
            Command::Outside(act) => {
                if let Err(refused) = outside::act(&mut state.document.scene, act) {
                    shell.toasts.info(refused.words());
                }
            }
            Command::Find(query) => {
                state.query = query;
                shell.search();
            }
            Command::Favourite(key, favourite) => self.products.star(shell, key, favourite),
            Command::Catalogue(what) => self.products.act(shell, what),
            Command::OpenPaths(paths) => self.imports.read_paths(shell, paths),
            Command::Write(what, path) => self.write(what, path),
            Command::WriteNew(what, path) => self.write_new(what, path),
            Command::EditPath(text) => {
                state.path = text;
                // The question was about another path.
                state.replace = None;
            }
            Command::KeepFile => state.replace = None,
            Command::EditImport(number, fields) => self.imports.edit(number, *fields),
            Command::GroupImport(grouping) => self.imports.group(shell, grouping),
            Command::AddAnyway(number, anyway) => self.imports.add_anyway(number, anyway),
            Command::Repair(number, repair) => self.imports.repair(shell, number, |repairs| repairs.push(repair)),
            Command::UndoRepair(number) => {
                self.imports.repair(shell, number, |repairs| repairs.truncate(repairs.len().saturating_sub(1)));
            }
            Command::AddImport => {
                let additions = self.imports.take_ready(shell);
                self.products.add(shell, additions);
            }
            Command::DiscardImport => self.imports.discard(shell, None),
            Command::DiscardDraft(number) => self.imports.discard(shell, Some(number)),
            Command::OpenDraft(number) => self.imports.open_draft(shell, number),
            Command::KeepDraft => self.imports.keep_draft(shell),
            Command::Import(step) => self.imports.act(shell, step),
            Command::MeasureAccuracy => measure_accuracy(shell),
            Command::WeighObstructions => weigh_obstructions(shell),
            Command::SystemExample(number) => self.goniophotometer.open_example(shell, number),
            Command::EditSystem(text) => self.goniophotometer.set_text(text),
            Command::SystemSetup(setup) => self.goniophotometer.set_up(setup),
            Command::DrawState(number) => self.goniophotometer.draw(number),
            Command::MeasureSystem => self.goniophotometer.measure(shell),
            Command::AddMeasured => {
                if let Some(addition) = self.goniophotometer.addition(shell) {
                    shell.state.sheet = None;
                    self.products.add(shell, vec![addition]);
                }
            }
            Command::RetryCatalogue => shell.open_catalogue(),
            Command::EditProduct(key) => self.products.edit_product(shell, key),
            Command::EditWords(fields) => self.products.edit_words(*fields),
            Command::EditState(place, words) => self.products.edit_state(place, words),
            Command::SaveWords => self.products.save_words(shell),
            Command::ReplaceState(key) => self.products.ask_replacement(shell, key),
            Command::Reread => self.products.reread(shell),
            Command::TakeChanges => self.products.take_changes(shell),
            Command::SyncSubscribed => self.products.sync_subscribed(shell),
            Command::DeleteProduct(key) => self.products.delete_product(shell, key),
            Command::RestoreProduct(key) => self.products.restore_product(shell, key),
            Command::Dismiss(id) => shell.toasts.dismiss(id),
            Command::ForgetMessages => shell.toasts.clear(),
            Command::CopyReport(path) => copy_report(shell, &path),
            Command::Compare(act) => self.compare.act(shell, act),
            Command::Like(key) => find_like(shell, key),
        }
    }

    /// Cancels the job of a lane, at the request of the user.
    fn cancel(&mut self, lane: Lane) {
        let shell = &mut self.shell;
        let stopped = shell.jobs.cancel(lane);
        match lane {
            Lane::Repair => self.imports.stop_repairs(),
            Lane::Import => self.imports.not_read(),
            Lane::Arrange => self.imports.stop_arranging(),
            Lane::Rank => self.ranking.keep(shell),
            Lane::Compare => self.compare.stop(),
            // Asked for again when it is chosen again.
            Lane::DataForm => shell.results.form.error = Some(shell::stopped(lane.word())),
            Lane::Schemes => shell.results.schemes.error = Some(shell::stopped(lane.word())),
            Lane::Product => {
                // They wait for the same data, and would compute them themselves.
                for waiting in [Lane::Lid, Lane::Room, Lane::Surfaces] {
                    shell.jobs.cancel(waiting);
                }
                stop_computing(shell);
            }
            _ => {}
        }
        let message = match lane {
            Lane::Goniophotometer => shell::STOPPED_STATES.into(),
            Lane::Builtin => shell::STOPPED_BUILTIN.into(),
            Lane::Product => shell::STOPPED_PRODUCT.into(),
            Lane::Annual => of_year::STOPPED.into(),
            Lane::Rank => choose::STOPPED.into(),
            Lane::Lid if !shell.results.lid.stale => shell::STOPPED_PEAK.into(),
            Lane::Import | Lane::Arrange | Lane::Repair | Lane::Dialog | Lane::Export => shell::stopped(lane.word()),
            _ => shell::stopped_older(lane.word()),
        };
        // The job may have ended between the picture and the click: then nothing was lost, and nothing is said.
        if stopped {
            shell.toasts.info(message);
        }
    }

    /// Writes to a path if there is no file yet; otherwise the user is asked whether to replace it.
    fn write_new(&mut self, what: PathUse, path: PathBuf) {
        let state = &self.shell.state;
        let path = with_ending(state, what, path);
        // Whoever saves the scene to where it came from means that file.
        let same = what == PathUse::SaveScene && state.scene_path.as_ref() == Some(&path);
        if same || matches!(what, PathUse::Open | PathUse::ReplaceState | PathUse::Subscribe) {
            return self.write(what, path);
        }
        let targets = match what {
            PathUse::ExportMeasured => self.goniophotometer.targets(&path),
            PathUse::Export => targets(state, &path),
            _ => vec![path.clone()],
        };
        self.shell.start(Lane::Export, move |_| {
            let there = targets.iter().any(|target| target.exists());
            Outcome::There(what, path, there)
        });
    }

    /// Executes the purpose of a path that the user has given: opens, replaces, subscribes or starts writing.
    pub(super) fn write(&mut self, what: PathUse, path: PathBuf) {
        let shell = &mut self.shell;
        shell.state.sheet = None;
        shell.state.replace = None;
        match what {
            PathUse::Open => self.imports.read_paths(shell, vec![path]),
            PathUse::ReplaceState => self.products.replace_state(shell, path),
            PathUse::Subscribe => self.products.act(shell, CatalogueCommand::SubscribeTo(path)),
            PathUse::SaveScene => self.export.save_scene(shell, path),
            PathUse::ExportTile(tile) => self.export.ask_tile(shell, tile, path),
            PathUse::Export => self.export.start(shell, path),
            PathUse::ExportMeasured => {
                shell.state.sheet = Some(Sheet::Goniophotometer);
                match self.goniophotometer.write_job(path, shell.state.made_from()) {
                    Some(write) => self.export.start_writing(shell, move || Outcome::Written(what, write())),
                    None => shell.toasts.info(texts::COMPUTE_FIRST),
                }
            }
            PathUse::ExportLid => self.export.ask_lid(path),
        }
    }

    /// Redoes one step of the undo history if `forth`, else undoes one, with its changes of the catalogue.
    fn step_history(&mut self, forth: bool) {
        let shell = &mut self.shell;
        let document = &shell.state.document;
        let other = if forth { shell.undoer.redo(document) } else { shell.undoer.undo(document) };
        let Some(other) = other.cloned() else {
            shell.toasts.info(if forth { shell::NOTHING_TO_REDO } else { shell::NOTHING_TO_UNDO });
            return;
        };
        let before = std::mem::replace(&mut shell.state.document, other);
        self.products.step_additions(shell, &before.additions);
        self.imports.step_discarded(shell, &before.discarded);
        self.imports.step_arranged(shell, &before.arranged);
        self.products.step_changes(shell, &before);
    }
}
