//! A weather file as a calendar of hours: its station, its light as a map, and the choice of an hour.

use crate::app::paint::hour_map;
use crate::app::paint::palette::Palette;
use crate::drawing::hour_map::HourMap;
use crate::texts::year as say;
use egui::{Label, RichText, Sense, Ui, vec2};

/// Height of the map with its legend. \[points\]
const HIGH: f32 = 168.0;

/// Input of the calendar.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Maps of direct normal and of diffuse horizontal light.
    pub maps: &'a [HourMap; 2],
    /// The scene's hour: month, day and minute of the day.
    pub moment: Option<(u8, u8, u16)>,
    /// Number that changes with the maps.
    pub revision: u64,
}

/// State of the calendar between frames.
#[derive(Debug, Clone, Default)]
pub struct State {
    map: hour_map::State,
    diffuse: bool,
}

/// Draws the calendar over the available width. Returns the number of the record that was chosen, and whether by arrow
/// keys.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Option<(usize, bool)> {
    ui.horizontal(|ui| {
        for (diffuse, word) in [(false, say::DIRECT_NORMAL), (true, say::DIFFUSE_HORIZONTAL)] {
            ui.selectable_value(&mut state.diffuse, diffuse, word).on_hover_text(say::CALENDAR_TIP);
        }
    });
    let map = &input.maps[usize::from(state.diffuse)];
    let mark = input.moment.and_then(|(month, day, minute)| map.cell(month, day, minute));
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), HIGH), Sense::hover());
    let revision = 2 * input.revision + u64::from(state.diffuse);
    let drawn = hour_map::Input { map, revision, mark, on_page: true };
    let answer = ui.push_id("calendar", |ui| hour_map::show(ui, rect, &drawn, &mut state.map)).inner;
    let text = answer.pointed.or(mark).map_or_else(|| say::CALENDAR_TIP.into(), |cell| hour_map::spoken(map, cell));
    let colour = Palette::of(ui.visuals()).weak;
    ui.add(Label::new(RichText::new(text).size(13.0).color(colour)).truncate());
    let picked = answer.picked.map(|cell| (cell, false)).or(answer.walked.map(|cell| (cell, true)));
    picked.and_then(|(cell, walking)| Some((map.from[cell]? as usize, walking)))
}
