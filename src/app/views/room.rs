//! View of the room tile: illuminances or daylight factors at the sensor points as a floor plan in false colours with
//! iso-lux lines, or in a section; or the light on the room's surfaces in perspective.
//!
//! Floor plan and section have the façade at the left, so that they share their horizontal axis, the depth of the room,
//! with the profile of illuminances under them.

mod boxes;
mod elevation;
mod ground;
mod handles;
mod input;
mod lit;
mod marks;
mod outside;
mod perspective;
mod plan;
mod profile;
mod steps;
mod words;

pub use input::{Action, CellValue, Input, Opening, Quantity};
pub use words::{csv, error_words};

use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _, LEGEND_HEIGHT};
use crate::app::paint::palette::{ColourMap, Palette};
use crate::app::paint::plot::{LEFT, RIGHT};
use crate::app::paint::tile::{self, Foot, Words};
use crate::app::scene::room_look::{RoomLook, RoomView};
use crate::texts::tiles as say;
use egui::{Rect, Sense, Ui, pos2, vec2};
use input::{Frame, Span};
use words::{summary, value_text};

/// Display settings and cached pictures of the room tile.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Whether the scales of colours and of the profile are logarithmic.
    pub log: bool,
    /// Whether the user has locked the scale.
    pub hold: bool,
    /// Index, counted along x, of the row of sensor points that section and profile show; `None`: the middle row.
    pub row: Option<usize>,
    scale: Option<(Quantity, ColourScale)>,
    pictures: plan::Pictures,
    held: Option<handles::Held>,
    shown: Option<Shown>,
    perspective: perspective::State,
}

/// Extent of the surroundings that a picture shows.
#[derive(Debug, Clone, Copy)]
struct Shown {
    side: bool,
    span: Span,
    /// Whether obstructions or ground lie beyond the picture, which a line of text then states.
    has_beyond: bool,
}

/// Draws the room tile into all the space of `ui`. Returns the requests of the user.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let (mut asked, mut moved) = (vec![], vec![]);
    let solid = input.look.view == RoomView::Perspective;
    let there = solid || input.complete() || !input.points.is_empty();
    let words = Words {
        title: say::ROOM.get(),
        subtitle: input.name,
        help: say::ROOM_ABOUT.get(),
        empty: (!there).then(|| input.status.missing(say::ROOM_EMPTY)),
        controls_width: 495.0,
    };
    let (mut log, mut hold, mut look) = (state.log, state.hold, input.look);
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            controls(ui, input, (&mut log, &mut look), &mut asked);
            ui.toggle_value(&mut hold, say::HOLD).on_hover_text(say::HOLD_TIP);
        },
        |ui, rect| match solid {
            true => perspective::show(ui, rect, input, (state.log, state.hold), &mut state.perspective),
            false => picture(ui, rect, input, state, &mut moved),
        },
    );
    (state.log, state.hold) = (log, hold);
    if look != input.look {
        asked.push(Action::Look(look));
    }
    asked.append(&mut moved);
    asked
}

/// Draws the controls in the tile's head: view, scale, daylight factor, height of the sensor plane.
fn controls(ui: &mut Ui, input: &Input<'_>, (log, look): (&mut bool, &mut RoomLook), actions: &mut Vec<Action>) {
    for view in RoomView::ALL {
        if ui.selectable_label(look.view == view, view.word()).on_hover_text(view.tip()).clicked() {
            look.view = view;
        }
    }
    ui.separator();
    if look.view == RoomView::Perspective {
        let seen = ui.toggle_value(&mut look.as_seen, say::AS_SEEN);
        seen.on_hover_text(say::AS_SEEN_TIP);
        ui.add_enabled_ui(!look.as_seen, |ui| {
            ui.toggle_value(log, say::LOG).on_hover_text(say::LOG_COLOURS);
        });
        return;
    }
    ui.toggle_value(log, say::LOG).on_hover_text(say::LOG_SECTION);
    let factor = ui.add_enabled_ui(input.no_factor.is_none() || look.daylight_factor, |ui| {
        ui.toggle_value(&mut look.daylight_factor, say::DAYLIGHT_FACTOR)
    });
    let tip = input.no_factor.unwrap_or(say::DAYLIGHT_FACTOR_TIP);
    factor.inner.on_hover_text(tip).on_disabled_hover_text(tip);
    if let Some(mut z) = input.plane_z {
        let drag = egui::DragValue::new(&mut z).range(0.0..=input.room[2]).speed(0.01).suffix(" m").max_decimals(2);
        let drag = drag.custom_parser(|text| crate::app::shell::typing::read_number(text, " m"));
        let label = ui.label(say::PLANE_AT);
        if ui.add(drag).labelled_by(label.id).changed() {
            actions.push(Action::PlaneMoved(z));
        }
    }
}

/// Returns the colour scale of this frame, in the unit of the results, which does not change while the user drags
/// something or has locked it.
fn scale_of(input: &Input<'_>, state: &State) -> ColourScale {
    // A dark room still needs a scale with an extent.
    let least = if input.quantity == Quantity::Illuminance { 1.0 } else { 0.01 };
    let max = input.cells.iter().map(|c| c.total).filter(|v| v.is_finite()).fold(0.0, f64::max).max(least);
    match (input.range, &state.scale) {
        (Some([lo, hi]), _) => {
            // A logarithmic scale cannot begin at 0.
            let lo = if state.log { lo.max(hi * 1e-4) } else { lo };
            ColourScale { lo, hi, log: state.log, map: ColourMap::Sequential }
        }
        (None, Some((of, held)))
            if (input.status.hold_scale || state.hold) && held.log == state.log && *of == input.quantity =>
        {
            held.clone()
        }
        _ => ColourScale::up_to(max, state.log, 2, ColourMap::Sequential),
    }
}

/// Draws floor plan or section, with legend and profile of illuminances. Returns the line under the picture.
fn picture(ui: &mut Ui, rect: Rect, input: &Input<'_>, state: &mut State, actions: &mut Vec<Action>) -> Foot {
    let palette = Palette::of(ui.visuals());
    let scale = scale_of(input, state);
    state.scale = Some((input.quantity, scale.clone()));
    let side = input.look.view == RoomView::Section;
    // In a low tile both would be too small to read: the plan goes first.
    let with_profile = rect.height() > 230.0 && input.complete();
    let profile_height = if with_profile { (0.38 * rect.height()).clamp(110.0, 230.0) } else { 0.0 };
    // A scale that is shared stands above all tiles.
    let shared = input.range.is_some() && !input.look.daylight_factor;
    let legend_height = if shared { 0.0 } else { LEGEND_HEIGHT };
    // While something is dragged the picture stands still; what was dragged may have been removed during the drag.
    if !ui.input(|input| input.pointer.any_down()) {
        state.held = None;
    }
    let kept = state.shown.filter(|shown| state.held.is_some() && shown.side == side);
    let Shown { span, has_beyond, .. } = *state.shown.insert(kept.unwrap_or_else(|| {
        let span = outside::span(input, side);
        Shown { side, span, has_beyond: outside::has_beyond(input, side, span) }
    }));
    let beyond_height = if has_beyond { outside::BEYOND_HEIGHT } else { 0.0 };
    let frame_rect = Rect::from_min_max(
        pos2(rect.left() + LEFT, rect.top() + beyond_height + if side { 6.0 } else { 2.0 }),
        pos2(rect.right() - RIGHT, rect.bottom() - profile_height - legend_height - 6.0),
    );
    let frame = Frame::around(frame_rect, span, input.room, side);
    let beyond_rect = Rect::from_min_size(pos2(frame_rect.left(), rect.top()), vec2(frame_rect.width(), beyond_height));
    if beyond_rect.is_positive() {
        outside::show_beyond(ui, beyond_rect, &frame, input, &palette);
    }
    outside::show(ui, &frame, input, &palette);
    let name = if side { say::ROOM_SECTION } else { say::ROOM_PLAN };
    let response = ui.interact(frame.area, ui.scope_id().with(name.english()), Sense::click());
    let cell = response.hover_pos().filter(|_| input.complete()).map(|at| {
        let (y, across) = frame.room(at);
        // The far walls belong to the last cells.
        let index = |v: f64, size: f64, n: usize| ((v / size * n as f64) as usize).min(n - 1);
        // From the side all rows stand behind each other: the kept one is meant.
        let kept = state.row.unwrap_or(input.nx / 2).min(input.nx - 1);
        (if side { kept } else { index(across, input.room[0], input.nx) }, index(y, input.room[1], input.ny))
    });
    if response.clicked() && !side {
        // A second click lets the row go.
        state.row = cell.map(|(i, _)| i).filter(|i| state.row != Some(*i));
    }
    let value = cell.map(|(i, j)| input.cells[j * input.nx + i]);
    // A row that was kept on a finer grid may be beyond this one.
    let row = cell.map(|(i, _)| i).or(state.row).unwrap_or(input.nx / 2).min(input.nx.max(1) - 1);
    match (side, input.complete()) {
        (true, _) => {
            ground::section(ui, &frame, input, row, &palette);
            elevation::show(ui, &frame, input, row, &scale, &palette);
        }
        (false, true) => plan::show(ui, &frame, input, row, &mut state.pictures, &scale, &palette),
        (false, false) => plan::outline(ui, &frame, input, &palette),
    }
    outside::over(ui, &frame, input, &palette);
    plan::points(ui, &frame, input, &scale, &palette);
    handles::show(ui, input, &frame, &mut state.held, actions);
    let legend = Rect::from_min_size(
        pos2(frame_rect.left() - 14.0, frame_rect.bottom() + 4.0),
        vec2((frame.view.width() + 30.0).max(160.0).min(frame_rect.width() + 10.0), LEGEND_HEIGHT),
    );
    let unit = input.quantity.unit();
    if !shared {
        scale.paint_legend(ui.painter(), legend, unit, value.map(|v| v.total), &palette);
    }
    let mut text = None;
    if with_profile {
        // From the plan's left edge to its right: every depth stands under itself.
        let place = Rect::from_min_max(
            pos2(frame.area.left() - LEFT, rect.bottom() - profile_height),
            pos2(frame.area.right() + RIGHT, rect.bottom()),
        );
        text = profile::show(ui, place, input, row, &scale, cell.map(|(_, j)| j), &palette);
    }
    let summary = summary(input);
    tile::name(ui, &response, name, summary.full());
    value.map(|v| value_text(&v, input.quantity)).or(text).unwrap_or(summary)
}
