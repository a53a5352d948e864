//! The control tile: the control diagram, and under it the control mode with its settings.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::scene::control as rules;
use crate::app::scene::facing::sun_incident;
use crate::app::scene::moment;
use crate::app::shell::jobs::Lane;
use crate::app::shell::typing::read_number;
use crate::app::state::{State, Tile};
use crate::app::title;
use crate::app::views::{Cache, control};
use crate::study::control::device::is_upright;
use crate::study::control::{DEFAULT_ELEVATION, slat_angle};
use crate::study::scene_file::{ControlKeys, ControlMode};
use crate::texts::{Text, tiles as say};
use egui::{ComboBox, DragValue, Ui, UiBuilder};
use std::path::PathBuf;

/// The control tile.
pub const TILE: Tile = Tile { title: "Control", name: say::CONTROL, help: say::CONTROL_HELP };

/// Height of the line of control modes under the tile. \[points\]
const RULES_HEIGHT: f32 = 26.0;

/// Returns, for each half hour of the scene's day, the profile angle of the sun relative to the façade and the state
/// that the control rule chooses; empty without a product.
fn trace(state: &State, key: &rules::YearKey) -> Vec<control::TracePoint> {
    let Some(product) = state.product.as_ref() else { return Vec::new() };
    // A rule that cannot be followed is reported where the state is picked; here its trace is missing.
    let points = rules::today(product, key, &state.document.scene).unwrap_or_default();
    let mut last = 0;
    points
        .into_iter()
        .map(|(hour, point)| {
            last = point.map_or(last, |(_, state)| usize::from(state));
            control::TracePoint { hour, profile_angle: point.map(|(angle, _)| angle), state: last }
        })
        .collect()
}

/// Returns the reason why there is nothing to control: the product has a single state, or is not loaded yet.
fn still(product: Option<&crate::catalogue::Product>) -> Text {
    let Some(product) = product else { return say::PRODUCT_COMING };
    match product.kind.as_str() {
        "pane" => say::STILL_PANE,
        "stack" => say::STILL_STACK,
        "venetian" => say::STILL_SLATS,
        "woven" => say::STILL_SCREEN,
        "diffuser" => say::STILL_DIFFUSER,
        "laser-cut-panel" | "prismatic" => say::STILL_PANEL,
        "perforated" => say::STILL_SHEET,
        _ => say::STILL_PRODUCT,
    }
}

/// Draws an input field for a number from 0 to `most` with its unit; 0 if the scene does not specify it.
fn setting(ui: &mut Ui, name: Text, tip: Text, unit: &str, value: &mut Option<f64>, most: f64) {
    let mut number = value.unwrap_or(0.0);
    let drag = DragValue::new(&mut number).range(0.0..=most).speed(most / 400.0).max_decimals(1).suffix(unit);
    let drag = drag.custom_parser(|text| read_number(text, unit));
    let label = ui.label(name);
    if ui.add(drag).labelled_by(label.id).on_hover_text(tip).changed() {
        *value = (number > 0.0).then_some(number);
    }
}

/// Draws the choice of the control mode, i.e. of how the state is chosen, under the tile.
fn rules_strip(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let mode = state.control_mode();
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        ui.add_space(6.0);
        let apertures = state.document.scene.aperture.len();
        if apertures > 1 {
            let name =
                |of: Option<usize>| of.map_or_else(|| say::ALL_APERTURES.into(), |index| say::aperture(index + 1));
            let chosen = state.control_of.filter(|index| *index < apertures);
            let combo = ComboBox::from_id_salt("control of").width(70.0).selected_text(name(chosen));
            let combo = combo.show_ui(ui, |ui| {
                for of in std::iter::once(None).chain((0..apertures).map(Some)) {
                    if ui.selectable_label(chosen == of, name(of)).clicked() {
                        commands.push(Command::ControlOf(of));
                    }
                }
            });
            combo.response.on_hover_text(say::SEPARATE_RULES);
        }
        let combo =
            ComboBox::from_id_salt("rule").width(92.0).selected_text(rules::words(mode).short).show_ui(ui, |ui| {
                for rule in ControlMode::ALL {
                    let words = rules::words(rule);
                    let label = ui.selectable_label(rule == mode, words.short).on_hover_text(words.tip);
                    if label.clicked() && rule != mode {
                        commands.push(Command::Control(rule));
                    }
                }
            });
        combo.response.on_hover_text(say::RULE_TIP);
        if mode == ControlMode::Fixed {
            return;
        }
        let before = state.control_keys();
        let mut keys = before.clone();
        details(ui, &mut keys, commands);
        if keys != before {
            commands.push(Command::ControlKeys(Box::new(keys)));
        }
    });
}

/// Draws the settings of the control mode, side by side if there is room, otherwise in a menu.
fn details(ui: &mut Ui, keys: &mut ControlKeys, commands: &mut Vec<Command>) {
    let fields = |ui: &mut Ui, keys: &mut ControlKeys| {
        if keys.mode == ControlMode::Redirect {
            let mut elevation = keys.elevation.unwrap_or(DEFAULT_ELEVATION);
            let label = ui.label(say::REDIRECT_TO);
            let drag = DragValue::new(&mut elevation).range(-90.0..=90.0).speed(0.5).max_decimals(1).suffix("°");
            let drag = drag.custom_parser(|text| read_number(text, "°"));
            let drag = ui.add(drag).labelled_by(label.id);
            if drag.on_hover_text(say::REDIRECT_TIP).changed() {
                keys.elevation = Some(elevation);
            }
        }
        setting(ui, say::HYSTERESIS, say::HYSTERESIS_TIP, "°", &mut keys.hysteresis, 45.0);
        setting(ui, say::DWELL, say::DWELL_TIP, " min", &mut keys.dwell, 240.0);
    };
    let more = |ui: &mut Ui, keys: &mut ControlKeys, commands: &mut Vec<Command>| {
        setting(ui, say::SUN_ABOVE, say::SUN_ABOVE_TIP, " lx", &mut keys.threshold, 100_000.0);
        setting(ui, say::CLOSE_ABOVE, say::CLOSE_ABOVE_TIP, " lx", &mut keys.close_above, 150_000.0);
        ui.separator();
        let own = !keys.curve.is_empty() || keys.curve_file.is_some();
        if keys.mode == ControlMode::Curve && ui.add_enabled(own, egui::Button::new(say::OWN_CURVE)).clicked() {
            keys.curve.clear();
            keys.curve_file = None;
            ui.close();
        }
        for (text, command) in [(say::LOAD_CURVE, Command::Open), (say::EXPORT_YEAR, Command::ExportTile(TILE))] {
            if ui.button(text).clicked() {
                commands.push(command);
                ui.close();
            }
        }
    };
    if ui.available_width() > 290.0 {
        fields(ui, keys);
        ui.menu_button("…", |ui| more(ui, keys, commands)).response.on_hover_text(say::MORE_CONTROL);
    } else {
        ui.menu_button("…", |ui| {
            fields(ui, keys);
            more(ui, keys, commands);
        });
    }
}

/// Key of a cached control curve: product, control rule, and base folder of the scene.
type CurveKey = (Option<String>, ControlKeys, PathBuf);

/// Drawing of the control tile, with its caches between frames.
#[derive(Default)]
pub struct Drawing {
    view: control::State,
    today: Cache<Option<(rules::YearKey, i16)>, Vec<control::TracePoint>>,
    curve: Cache<CurveKey, Vec<[f64; 2]>>,
    /// Cache, by the text of a system file, of whether its slats are vertical.
    upright: Cache<String, bool>,
}

impl Drawn for Drawing {
    fn lanes(&self) -> &'static [Lane] {
        &[Lane::Year]
    }

    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.state.product.is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String> {
        let state = seen.state;
        let scene = &state.document.scene;
        let product = state.product.clone();
        let states: Vec<control::StatePoint> = product.as_deref().map_or_else(Vec::new, |product| {
            let list = rules::ordered_states(product);
            list.into_iter().map(|(key, value)| control::StatePoint { key, value }).collect()
        });
        let current = states.iter().position(|point| point.key == state.shown_state).unwrap_or(0);
        let mode = state.control_mode();
        let day = moment::of(scene).map_or(0, |time| time.day_of_year());
        let key = state.year_key(&state.document.selection.product);
        let key = key.filter(|key| product.as_deref().is_some_and(|product| product.key == key.product));
        let today = self.today.get(key.clone().map(|key| (key, day)), || match &key {
            Some(key) => trace(state, key),
            None => Vec::new(),
        });
        let drawn = product.as_deref().filter(|product| product.key == state.document.selection.product);
        let keys = state.control_keys();
        let curve_key = (drawn.map(|product| product.key.clone()), keys.clone(), state.base());
        let curve = self.curve.get(curve_key, || match drawn {
            // By hand, the product's own curve is shown for orientation.
            Some(product) if mode == ControlMode::Fixed => {
                product.control_curve.iter().map(|point| [point.profile_angle, point.value]).collect()
            }
            Some(product) => rules::rule_curve(product, &keys, &state.base()).unwrap_or_default(),
            None => Vec::new(),
        });
        let shown = &seen.results.year;
        // A map of another product's states would be drawn with this one's: rather none.
        let year = shown.value.as_ref().filter(|year| {
            year.states.iter().eq(states.iter().map(|point| &point.key))
                && key.as_ref().is_some_and(|key| key.product == year.key.product)
        });
        let mut name = title::selection(state);
        // What does not move does not do so by hand either.
        if states.len() > 1 {
            name.push_str(&format!(" · {}", rules::words(mode).does));
        }
        if let Some(year) = year.filter(|_| mode != ControlMode::Fixed) {
            name.push_str(&format!(" · {}", say::movements(year.movements)));
        }
        let moving = states.len() > 1;
        let sun = sun_incident(scene, &state.base());
        let system = product.as_deref().map_or("", |product| &product.system);
        let upright = *self.upright.get(system.to_owned(), || is_upright(system));
        let still = still(title::selected(state));
        let remark = match (&key, moving) {
            (None, true) => rules::YearKey::missing(scene).unwrap_or_default(),
            _ => String::new(),
        };
        let input = control::Input {
            states: &states,
            still: still.get(),
            quantity: product.as_deref().map_or(say::STATE_WORD.get(), rules::quantity),
            curve,
            editable: mode == ControlMode::Curve,
            name: &name,
            today,
            profile_angle: sun.map(|sun| slat_angle(sun.0, upright).to_degrees()),
            current,
            year: year.map_or(&[], |year| year.hours.as_slice()),
            moment: moment::of(scene).map(|time| {
                (
                    usize::try_from(time.day_of_year() - 1).unwrap_or(0),
                    f64::from(time.hour()) + f64::from(time.minute()) / 60.0,
                )
            }),
            remark: &remark,
            revision: year.map_or(0, |_| shown.revision),
            status: seen.status(
                // What there is none of is not awaited.
                moving && (key.is_some() && shown.stale || state.dataset.stale),
                shown.error.as_deref().or(state.dataset.error.as_deref()).filter(|_| moving && year.is_none()),
            ),
        };
        let (upper, strip) = {
            let whole = ui.available_rect_before_wrap();
            whole.split_top_bottom_at_y(whole.bottom() - if moving { RULES_HEIGHT } else { 0.0 })
        };
        if moving {
            ui.scope_builder(UiBuilder::new().max_rect(strip).id_salt("rules"), |ui| rules_strip(ui, state, commands));
        }
        let builder = UiBuilder::new().max_rect(upper).id_salt("control");
        let actions = ui.scope_builder(builder, |ui| control::show(ui, &input, &mut self.view)).inner;
        for action in actions {
            match action {
                control::Action::ChooseState(index) => {
                    if let Some(point) = states.get(index) {
                        commands.push(Command::SelectState(point.key.clone()));
                    }
                }
                control::Action::EditCurve(curve) => {
                    let keys = ControlKeys { curve, curve_file: None, ..state.control_keys() };
                    commands.push(Command::ControlKeys(Box::new(keys)));
                }
                control::Action::ChooseMoment { day, hour } => {
                    let mut scene = scene.clone();
                    if let Some(time) = moment::of(&scene) {
                        let days = day as i32 + 1 - i32::from(time.day_of_year());
                        let minutes = (hour * 60.0) as i32 - 60 * i32::from(time.hour()) - i32::from(time.minute());
                        moment::step(&mut scene, days, minutes);
                        commands.push(Command::Scene(Box::new(scene)));
                    }
                }
            }
        }
        seen.numbers.then(|| control::csv(&input))
    }
}
