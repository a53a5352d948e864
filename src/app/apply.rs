//! Execution of commands: the only module that changes the window's state by the user's actions.

use super::command::Command;
use super::export_choices::What;
use super::first_choice::first_choice;
use super::jobs::Lane;
use super::moment;
use super::outside;
use super::scene::{Selection, fill, first_scene, own_system, rule, set_rule};
use super::state::{PathUse, Sheet};
use super::title;
use super::window::{App, end_step};
use crate::catalogue::{FirstRule, Product};
use crate::study::Store;
use crate::study::control::year::CONTROLLED;
use crate::study::control::{Device, settings};
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use crate::texts::shell;

impl App {
    /// Executes a command. Its change of the document is a separate undo step; changes by dragging or by repeated keys
    /// are merged into one step once they have ended.
    pub fn apply(&mut self, command: Command) {
        self.steps.keep(&command);
        let step = command.is_step();
        // What is there already is not added twice: some commands do it themselves.
        if step {
            end_step(&mut self.undoer, &self.state.document);
        }
        self.act_on(command);
        if step {
            end_step(&mut self.undoer, &self.state.document);
        }
    }

    fn act_on(&mut self, command: Command) {
        let state = &mut self.state;
        match command {
            Command::Open => self.ask_paths(),
            Command::SaveScene => self.ask_target(PathUse::SaveScene),
            Command::ExportLid => self.open_export(What::Luminaire, None),
            Command::ExportTile(tile) => self.open_export(What::Picture, Some(tile)),
            Command::ExportChoices(choices) => self.set_export_choices(*choices),
            Command::BrowseExport => self.browse_export(),
            Command::CopyTile(tile) => self.copy_tile(tile),
            Command::CopyPicture(tile) => self.copy_picture(tile),
            Command::CopyValue => self.copy_value(),
            Command::Incidence(chosen) => state.incident = chosen,
            Command::DataForm(form) => self.look_at_data(|look| look.form = form),
            Command::SchemeMap => self.look_at_data(|look| look.schemes ^= true),
            Command::Control(mode) => self.control(mode),
            Command::ControlKeys(keys) => self.set_control(*keys),
            Command::ControlOf(index) => {
                state.control_of = index;
                // What was asked last is known by the document, which does not hold this choice: ask again by hand.
                self.asked = None;
            }
            Command::Quit => self.ctx.send_viewport_cmd(egui::ViewportCommand::Close),
            Command::Undo => self.step_history(false),
            Command::Redo => self.step_history(true),
            Command::Search => {
                // The field to type in may be hidden with its panel.
                state.settings.catalogue_open = true;
                state.focus_search = true;
                state.wants_keyboard = false;
            }
            Command::KeyboardTaken => state.wants_keyboard = false,
            Command::Palette => self.toggle_palette(),
            Command::EditPalette(text) => self.edit_palette(text),
            Command::PaletteRow(row) => state.palette_row = row,
            Command::Maximise(tile) => state.maximised = tile,
            Command::Arrange(what) => self.arrange(what),
            Command::RoomLook(look) => state.settings.room = look,
            Command::RoomView(view) => state.settings.room.view = view,
            Command::Hour(hours) => {
                // A sun that is given by angles has no clock: the key does nothing then.
                moment::step(&mut state.document.scene, 0, 60 * hours);
            }
            Command::Day(days) => {
                moment::step(&mut state.document.scene, days, 0);
            }
            Command::NextState(step) => self.step_state(step),
            Command::ToggleCatalogue => state.settings.catalogue_open ^= true,
            Command::ToggleScene => state.settings.scene_open ^= true,
            Command::Theme(choice) => {
                state.settings.theme = choice;
                choice.apply(&self.ctx);
            }
            Command::Language(choice) => state.settings.language = choice,
            Command::TextSize(change) => self.change_text_size(change),
            Command::StoreLimit(megabytes) => state.settings.store_limit = megabytes,
            Command::ClearStore => self.services.engine.store().into_iter().for_each(Store::clear),
            Command::Tour(act) => self.tour(act),
            Command::ResetScene => {
                // The first scene names no product: the one that is chosen stays, with its rule.
                let scene = &mut state.document.scene;
                let of_aperture = || scene.aperture.iter_mut().find_map(|one| one.control.take());
                let control = scene.control.take().or_else(of_aperture);
                *scene = SceneFile { compare: std::mem::take(&mut scene.compare), control, ..first_scene() };
                fill(&mut state.document.scene, &state.document.selection);
            }
            Command::Sheet(sheet) => {
                // The key that opens a sheet also closes it.
                state.sheet = if state.sheet == sheet { None } else { sheet };
                if state.sheet == Some(Sheet::Export) {
                    self.propose_export_path();
                }
            }
            Command::Cancel(lane) => {
                let stopped = self.jobs.cancel(lane);
                if lane == Lane::Repair {
                    for product in state.import.iter_mut().flat_map(|import| &mut import.products) {
                        product.requested_repairs = None;
                    }
                }
                if lane == Lane::Import {
                    state.under_way = None;
                }
                if lane == Lane::Arrange {
                    self.stop_arranging();
                }
                if lane == Lane::Rank {
                    self.keep_ranking();
                }
                if lane == Lane::Compare {
                    self.compare.stop();
                }
                // Asked for again when it is chosen again.
                if lane == Lane::DataForm {
                    self.results.form.error = Some(shell::stopped(lane.word()));
                }
                if lane == Lane::Schemes {
                    self.results.schemes.error = Some(shell::stopped(lane.word()));
                }
                if lane == Lane::Product {
                    // They wait for the same data, and would compute them themselves.
                    self.jobs.cancel(Lane::Lid);
                    self.jobs.cancel(Lane::Room);
                    self.jobs.cancel(Lane::Surfaces);
                    self.stop_computing();
                }
                let message = match lane {
                    Lane::Goniophotometer => shell::STOPPED_STATES.into(),
                    Lane::Builtin => shell::STOPPED_BUILTIN.into(),
                    Lane::Product => shell::STOPPED_PRODUCT.into(),
                    Lane::Annual => crate::texts::year::STOPPED.into(),
                    Lane::Rank => crate::texts::choose::STOPPED.into(),
                    Lane::Lid if !self.results.lid.stale => shell::STOPPED_PEAK.into(),
                    Lane::Import | Lane::Arrange | Lane::Repair | Lane::Dialog | Lane::Export => {
                        shell::stopped(lane.word())
                    }
                    _ => shell::stopped_older(lane.word()),
                };
                // The job may have ended between the picture and the click: then nothing was lost, and nothing is said.
                if stopped {
                    self.toasts.info(message);
                }
            }
            Command::Select(product) => self.select_product(product),
            Command::SelectState(key) => {
                let product = state.document.selection.product.clone();
                // With one aperture selected the click means that aperture: the others continue by their rules.
                if state.control_of.is_some() && state.document.selection.state == CONTROLLED {
                    self.set_control(ControlKeys { state: Some(key), ..ControlKeys::of(ControlMode::Fixed) });
                } else {
                    self.select(Selection { product, state: key });
                }
            }
            Command::Row(step) => {
                let last = state.found.entries.len().saturating_sub(1);
                let here = state.found.entries.iter().position(|entry| entry.key == state.document.selection.product);
                // Where the list no longer holds the chosen product the keys start at its top.
                state.row = match here {
                    Some(row) => row.saturating_add_signed(step as isize).min(last),
                    None => 0,
                };
                if let Some(entry) = state.found.entries.get(state.row) {
                    let product = entry.key.clone();
                    self.select_product(product);
                }
            }
            Command::Scene(scene) => state.document.scene = *scene,
            Command::Year(act) => self.year_act(act),
            Command::Choose(act) => self.choose_act(act),
            Command::Outside(act) => {
                if let Err(refused) = outside::act(&mut state.document.scene, act) {
                    self.toasts.info(refused.words());
                }
            }
            Command::Find(query) => {
                state.query = query;
                self.search();
            }
            Command::Favourite(key, favourite) => self.star(key, favourite),
            Command::Catalogue(what) => self.apply_catalogue_command(what),
            Command::OpenPaths(paths) => self.read_paths(paths),
            Command::Write(what, path) => self.write(what, path),
            Command::EditPath(text) => {
                state.path = text;
                // The question was about another path.
                state.replace = None;
            }
            Command::WriteNew(what, path) => self.write_new(what, path),
            Command::KeepFile => state.replace = None,
            Command::EditImport(number, fields) => self.edit_import(number, *fields),
            Command::GroupImport(grouping) => self.group_import(grouping),
            Command::AddAnyway(number, anyway) => self.add_anyway(number, anyway),
            Command::Repair(number, repair) => self.repair_import(number, |repairs| repairs.push(repair)),
            Command::UndoRepair(number) => {
                self.repair_import(number, |repairs| repairs.truncate(repairs.len().saturating_sub(1)));
            }
            Command::AddImport => self.add_import(),
            Command::DiscardImport => self.discard_import(None),
            Command::DiscardDraft(number) => self.discard_import(Some(number)),
            Command::OpenDraft(number) => self.open_draft(number),
            Command::KeepDraft => self.keep_draft(),
            Command::Import(step) => self.import_step(step),
            Command::MeasureAccuracy => self.measure_accuracy(),
            Command::WeighObstructions => self.weigh_obstructions(),
            Command::SystemExample(number) => self.open_example(number),
            Command::EditSystem(text) => state.goniophotometer.set_text(text),
            Command::SystemSetup(setup) => state.goniophotometer.setup = setup,
            Command::DrawState(number) => state.goniophotometer.drawn = number,
            Command::MeasureSystem => self.measure_system(),
            Command::AddMeasured => self.add_measured(),
            Command::ExportMeasured => self.ask_target(PathUse::ExportMeasured),
            Command::RetryCatalogue => self.open_catalogue(),
            Command::EditProduct(key) => self.edit_product(key),
            Command::EditWords(fields) => {
                if let Some(editing) = &mut state.editing {
                    editing.fields = *fields;
                }
            }
            Command::EditState(place, words) => self.edit_state(place, words),
            Command::SaveWords => self.save_words(),
            Command::ReplaceState(key) => self.ask_replacement(key),
            Command::Reread => self.reread(),
            Command::TakeChanges => self.take_changes(),
            Command::SyncSubscribed => self.sync_subscribed(),
            Command::OpenFolder => self.ask_folder(),
            Command::DeleteProduct(key) => self.delete_product(key),
            Command::RestoreProduct(key) => self.restore_product(key),
            Command::Dismiss(id) => self.toasts.dismiss(id),
            Command::ForgetMessages => self.toasts.clear(),
            Command::CopyReport(path) => self.copy_report(&path),
            Command::Compare(act) => self.act(act),
            Command::Like(key) => self.find_like(key),
        }
    }

    /// Selects a product by its key; a product that is not in the list is read from the catalogue first.
    pub(super) fn select_product(&mut self, product: String) {
        let state = &self.state;
        // Chosen already, but the room is lit through something else: it is meant to come there.
        if state.document.selection.product == product && own_system(&state.document.scene).is_none() {
            return;
        }
        match state.found.entries.iter().find(|entry| entry.key == product).cloned() {
            Some(entry) => self.choose(product, entry.rule, Some(entry.state()).filter(|_| entry.moves())),
            None => self.look_up(product),
        }
    }

    /// Selects a product that was read from the catalogue.
    pub(super) fn choose_product(&mut self, product: &Product) {
        let (rule, place) = product.representative();
        let state = product.states.get(place).filter(|_| product.states.len() > 1);
        self.choose(product.key.clone(), rule, state.map(|state| state.key.as_str()));
    }

    /// Selects a product, with the control rule that it defines or in its representative state, as one undo step.
    fn choose(&mut self, product: String, rule: FirstRule, state: Option<&str>) {
        end_step(&mut self.undoer, &self.state.document);
        first_choice(&mut self.state.document, product, rule, state);
        self.state.control_of = None;
        end_step(&mut self.undoer, &self.state.document);
    }

    fn select(&mut self, selection: Selection) {
        let document = &mut self.state.document;
        if document.selection != selection {
            end_step(&mut self.undoer, document);
            document.selection = selection;
            fill(&mut document.scene, &document.selection);
            end_step(&mut self.undoer, document);
        }
    }

    /// Sets the mode of shading control: a control rule that chooses the state, or the current state as a fixed one.
    fn control(&mut self, mode: ControlMode) {
        let product = self.state.document.selection.product.clone();
        let of = self.state.control_of;
        if mode == ControlMode::Fixed {
            match of {
                // The other apertures continue by their own rules.
                Some(_) if self.state.document.selection.state == CONTROLLED => {
                    let state = Some(self.state.shown_state.clone()).filter(|key| !key.is_empty());
                    self.set_control(ControlKeys { state, ..ControlKeys::of(mode) });
                }
                _ if self.state.document.selection.state == CONTROLLED => {
                    self.select(Selection { product, state: self.state.shown_state.clone() });
                }
                _ => {}
            }
            return;
        }
        let scene = &self.state.document.scene;
        let keys = rule(scene, self.state.control_aperture())
            .map_or_else(|| ControlKeys::of(mode), |keys| keys.with_mode(mode));
        self.set_control(keys);
    }

    /// Sets a control rule with its parameters, for the scene or for the aperture that is edited. Shows a message
    /// instead if the product cannot follow the rule.
    fn set_control(&mut self, keys: ControlKeys) {
        if let Some(known) = self.state.product.as_deref() {
            let problem = if known.states.len() < 2 {
                Some(shell::ONE_STATE_ONLY.into())
            } else {
                let device = Device::of(known);
                device.and_then(|device| settings(&keys, &device, &self.state.base())).err().map(|e| e.to_string())
            };
            if let Some(problem) = problem {
                self.toasts.info(problem);
                return;
            }
        }
        let document = &mut self.state.document;
        let change = document.selection.state != CONTROLLED
            || rule(&document.scene, self.state.control_of.unwrap_or(0)).map(|old| old.mode) != Some(keys.mode);
        // A change of rule is a step of its own; a curve that is dragged is one step when it comes to rest.
        if change {
            end_step(&mut self.undoer, document);
        }
        if document.selection.state != CONTROLLED {
            document.selection.state = CONTROLLED.to_owned();
            // Where nothing moved, the scene needs a rule for the other apertures too.
            document.scene.control = Some(keys.clone());
        }
        set_rule(&mut document.scene, self.state.control_of, Some(keys));
        let rules: Vec<_> = document.scene.aperture.iter().map(|aperture| aperture.control.clone()).collect();
        fill(&mut document.scene, &document.selection);
        for (aperture, rule) in document.scene.aperture.iter_mut().zip(rules) {
            aperture.control = rule;
        }
        if change {
            end_step(&mut self.undoer, document);
        }
    }

    fn step_state(&mut self, step: i32) {
        let selection = &self.state.document.selection;
        let Some(known) = title::selected(&self.state) else { return };
        // From where control has put it, if it does: stepping by hand takes over.
        let picked = selection.state == CONTROLLED || selection.state.is_empty();
        let from = if picked { &self.state.shown_state } else { &selection.state };
        let here = known.states.iter().position(|state| state.key == *from).unwrap_or(0);
        let next = here.saturating_add_signed(step as isize).min(known.states.len().saturating_sub(1));
        if let Some(state) = known.states.get(next) {
            let (product, state) = (selection.product.clone(), state.key.clone());
            self.select(Selection { product, state });
        }
    }

    /// Redoes one step of the undo history if `forth`, else undoes one, with its changes of the catalogue.
    fn step_history(&mut self, forth: bool) {
        let document = &self.state.document;
        let other = if forth { self.undoer.redo(document) } else { self.undoer.undo(document) };
        let Some(other) = other.cloned() else {
            self.toasts.info(if forth { shell::NOTHING_TO_REDO } else { shell::NOTHING_TO_UNDO });
            return;
        };
        let before = std::mem::replace(&mut self.state.document, other);
        let after = self.state.document.additions.clone();
        let gone = before.additions.iter().filter(|number| !after.contains(number));
        let gone: Vec<String> = gone.filter_map(|&number| self.state.additions[number].key.take()).collect();
        if !gone.is_empty() {
            self.store(move |shelf| shelf.remove_all(&gone));
        }
        self.step_discarded(&before.discarded);
        self.step_arranged(&before.arranged);
        // What is still being stored since it was added is there again as soon as it is there.
        let back = after.iter().filter(|number| !before.additions.contains(number) && !self.adding.contains(number));
        let back: Vec<_> = back.map(|&number| (number, self.state.additions[number].addition.clone())).collect();
        if !back.is_empty() {
            self.store_additions(back);
        }
        let document = &self.state.document;
        let sides = [(&before.changes, document.changes.clone()), (&before.marks, document.marks.clone())];
        for (before, after) in sides {
            // The last one first: each was made on what the one before it left.
            for &gone in before.iter().rev().filter(|number| !after.contains(number)) {
                self.make_change(gone, false);
            }
            for &back in after.iter().filter(|number| !before.contains(number)) {
                self.make_change(back, true);
            }
        }
    }
}
