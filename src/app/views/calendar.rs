//! A weather file as a calendar of the hours of its year: a map of direct normal or diffuse horizontal light, from
//! which an hour can be chosen.

use crate::app::paint::hour_map;
use crate::app::paint::palette::Palette;
use crate::drawing::hour_map::HourMap;
use crate::texts::year as say;
use egui::{Label, RichText, Sense, Ui, vec2};

/// Height of the map of hours with its legend. \[points\]
const HIGH: f32 = 168.0;

/// Input of the calendar in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Maps of direct normal and of diffuse horizontal illuminance \[lx\] or irradiance \[W/m²\], according to the
    /// file.
    pub maps: &'a [HourMap; 2],
    /// Hour of the scene in the standard time of the file: month, day and minute of the day; `None` if the sky of the
    /// scene is not from this file.
    pub moment: Option<(u8, u8, u16)>,
    /// Revision number of the maps, which changes whenever they do.
    pub revision: u64,
}

/// State of the calendar between frames.
#[derive(Debug, Clone, Default)]
pub struct State {
    map: hour_map::State,
    diffuse: bool,
}

/// Draws the calendar over the available width. Returns the index of the record of the file that the user chose in this
/// frame, and whether by arrow keys.
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
