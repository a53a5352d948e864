//! Selection of product and state, and of the shading control that chooses the state, each as an undo step.

use crate::app::scene::first_choice::{choose_first, choose_first_listed};
use crate::app::scene::{Selection, fill, own_system, rule, selection_of, set_rule};
use crate::app::shell::Shell;
use crate::app::state::{Document, State};
use crate::app::title;
use crate::catalogue::Product;
use crate::study::control::year::CONTROLLED;
use crate::study::control::{Device, settings};
use crate::study::scene_file::{ControlKeys, ControlMode};
use crate::texts::shell;
use std::sync::Arc;

/// Maximum number of recently selected products that are remembered.
const RECENT: usize = 20;

/// Records the selected product as the most recent one.
pub fn note_shown(state: &mut State) {
    let key = &state.document.selection.product;
    let recent = &mut state.settings.recent;
    if key.is_empty() || recent.first() == Some(key) {
        return;
    }
    recent.retain(|other| other != key);
    recent.insert(0, key.clone());
    recent.truncate(RECENT);
}

/// Selects a product by its key; a product that is not in the list is read from the catalogue first.
pub fn select_product(shell: &mut Shell, product: String) {
    let state = &shell.state;
    // Chosen already, but the room is lit through something else: it is meant to come there.
    if state.document.selection.product == product && own_system(&state.document.scene).is_none() {
        return;
    }
    match state.found.entries.iter().find(|entry| entry.key == product).cloned() {
        Some(entry) => choose(shell, |document| choose_first_listed(document, &entry)),
        None => shell.look_up(product),
    }
}

/// Selects a product that was read from the catalogue.
pub fn choose_product(shell: &mut Shell, product: &Product) {
    choose(shell, |document| choose_first(document, product));
}

/// Selects a product as one undo step.
fn choose(shell: &mut Shell, select: impl FnOnce(&mut Document)) {
    shell.end_step();
    select(&mut shell.state.document);
    shell.state.control_of = None;
    shell.end_step();
}

/// Selects a state as one undo step.
fn select(shell: &mut Shell, selection: Selection) {
    if shell.state.document.selection != selection {
        shell.end_step();
        let document = &mut shell.state.document;
        document.selection = selection;
        fill(&mut document.scene, &document.selection);
        shell.end_step();
    }
}

/// Sets the mode of shading control: a control rule that chooses the state, or the current state as a fixed one.
pub fn set_mode(shell: &mut Shell, mode: ControlMode) {
    let product = shell.state.document.selection.product.clone();
    let of = shell.state.control_of;
    if mode == ControlMode::Fixed {
        match of {
            // The other apertures continue by their own rules.
            Some(_) if shell.state.document.selection.state == CONTROLLED => {
                let state = Some(shell.state.shown_state.clone()).filter(|key| !key.is_empty());
                set_control(shell, ControlKeys { state, ..ControlKeys::of(mode) });
            }
            _ if shell.state.document.selection.state == CONTROLLED => {
                select(shell, Selection { product, state: shell.state.shown_state.clone() });
            }
            _ => {}
        }
        return;
    }
    let scene = &shell.state.document.scene;
    let keys =
        rule(scene, shell.state.control_aperture()).map_or_else(|| ControlKeys::of(mode), |keys| keys.with_mode(mode));
    set_control(shell, keys);
}

/// Sets a control rule with its parameters, for the scene or for the aperture that is edited. Shows a message
/// instead if the product cannot follow the rule.
pub fn set_control(shell: &mut Shell, keys: ControlKeys) {
    if let Some(known) = shell.state.product.as_deref() {
        let problem = if known.states.len() < 2 {
            Some(shell::ONE_STATE_ONLY.into())
        } else {
            let device = Device::of(known);
            device.and_then(|device| settings(&keys, &device, &shell.state.base())).err().map(|e| e.to_string())
        };
        if let Some(problem) = problem {
            shell.toasts.info(problem);
            return;
        }
    }
    let document = &shell.state.document;
    let change = document.selection.state != CONTROLLED
        || rule(&document.scene, shell.state.control_of.unwrap_or(0)).map(|old| old.mode) != Some(keys.mode);
    // A change of rule is a step of its own; a curve that is dragged is one step when it comes to rest.
    if change {
        shell.end_step();
    }
    let document = &mut shell.state.document;
    if document.selection.state != CONTROLLED {
        document.selection.state = CONTROLLED.to_owned();
        // Where nothing moved, the scene needs a rule for the other apertures too.
        document.scene.control = Some(keys.clone());
    }
    set_rule(&mut document.scene, shell.state.control_of, Some(keys));
    let rules: Vec<_> = document.scene.aperture.iter().map(|aperture| aperture.control.clone()).collect();
    fill(&mut document.scene, &document.selection);
    for (aperture, rule) in document.scene.aperture.iter_mut().zip(rules) {
        aperture.control = rule;
    }
    if change {
        shell.end_step();
    }
}

/// Selects the state with this key: for the aperture whose control is edited, or for all.
pub fn select_state(shell: &mut Shell, key: String) {
    let product = shell.state.document.selection.product.clone();
    // With one aperture selected the click means that aperture: the others continue by their rules.
    if shell.state.control_of.is_some() && shell.state.document.selection.state == CONTROLLED {
        set_control(shell, ControlKeys { state: Some(key), ..ControlKeys::of(ControlMode::Fixed) });
    } else {
        select(shell, Selection { product, state: key });
    }
}

/// Moves by this number of rows in the product list, and selects the product there.
pub fn step_row(shell: &mut Shell, step: i32) {
    let state = &mut shell.state;
    let last = state.found.entries.len().saturating_sub(1);
    let here = state.found.entries.iter().position(|entry| entry.key == state.document.selection.product);
    // Where the list no longer holds the chosen product the keys start at its top.
    state.row = here.map_or(0, |row| row.saturating_add_signed(step as isize).min(last));
    if let Some(entry) = state.found.entries.get(state.row) {
        let product = entry.key.clone();
        select_product(shell, product);
    }
}

/// Selects the next (+1) or previous (−1) state of the product.
pub fn step_state(shell: &mut Shell, step: i32) {
    let selection = &shell.state.document.selection;
    let Some(known) = title::selected(&shell.state) else { return };
    // From where control has put it, if it does: stepping by hand takes over.
    let picked = selection.state == CONTROLLED || selection.state.is_empty();
    let from = if picked { &shell.state.shown_state } else { &selection.state };
    let here = known.states.iter().position(|state| state.key == *from).unwrap_or(0);
    let next = here.saturating_add_signed(step as isize).min(known.states.len().saturating_sub(1));
    if let Some(state) = known.states.get(next) {
        let (product, state) = (selection.product.clone(), state.key.clone());
        select(shell, Selection { product, state });
    }
}

/// Sets the selection to the product in the first aperture from the catalogue after a scene was opened. With a
/// scene without products of the catalogue the selection stays.
pub fn adopt_selection(shell: &mut Shell) {
    if let Some(selection) = selection_of(&shell.state.document.scene) {
        shell.state.document.selection = selection;
    } else if !shell.state.document.selection.product.is_empty() {
        report_own_system(shell, title::product(&shell.state));
    }
}

/// Shows a message if the scene's apertures contain another system than the product that the other tiles show.
fn report_own_system(shell: &mut Shell, product: String) {
    if let Some(system) = own_system(&shell.state.document.scene) {
        shell.toasts.info(shell::own_system(title::system(system), product));
    }
}

/// Selects a product at the first start: a light-guiding product if there is one, else the first. A scene with
/// other systems is not changed.
pub fn select_something(shell: &mut Shell) {
    let document = &shell.state.document;
    if !document.selection.product.is_empty() || shell.state.found.entries.is_empty() {
        return;
    }
    // Something that moves makes every tile alive; else something that guides light.
    const GUIDES: [&str; 3] = ["laser", "prism", "double"];
    let entries = &shell.state.found.entries;
    let moving = entries.iter().find(|entry| entry.moves());
    let guiding =
        || GUIDES.iter().find_map(|word| entries.iter().find(|entry| entry.name.to_lowercase().contains(word)));
    let chosen = Arc::clone(moving.or_else(guiding).unwrap_or(&entries[0]));
    if own_system(&shell.state.document.scene).is_some() {
        let state = if chosen.moves() { chosen.state().to_owned() } else { String::new() };
        shell.state.document.selection = Selection { product: chosen.key.clone(), state };
        report_own_system(shell, chosen.name.clone());
    } else {
        choose_first_listed(&mut shell.state.document, &chosen);
    }
    shell.begin_history();
}
