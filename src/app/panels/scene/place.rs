//! Section of the site: a city from the list, geographical coordinates, or latitude, longitude, UTC offset and
//! elevation as typed numbers.

use super::summer_time;
use crate::app::display::theme;
use crate::app::panels::fields::{number, optional, select_all};
use crate::app::shell::typing::read_coordinates;
use crate::app::title::{coordinates, site};
use crate::study::places::{City, city_at, nearest, search, summer_time as rule};
use crate::study::scene_file::{DstKey, SceneFile};
use crate::study::sky::{HIGHEST, LOWEST};
use crate::texts::{decimal, fixed, scene as texts};
use egui::accesskit::Role;
use egui::{Align, Button, Key, Label, Layout, Modifiers, RichText, TextEdit, Ui, WidgetInfo};

/// Maximum number of cities in the list.
const MOST: usize = 8;

/// Text of the search field, and the index of the marked row of the list.
#[derive(Debug, Clone, Default)]
struct Typed {
    text: String,
    row: usize,
}

/// Site that can be chosen from the list.
struct Choice {
    words: String,
    where_: String,
    tip: String,
    latitude: f64,
    longitude: f64,
    utc_offset: f64,
    dst: DstKey,
    elevation: Option<f64>,
}

/// Returns the UTC offset \[h\] as text: `UTC+5.75`.
fn clock_words(utc_offset: f64) -> String {
    if utc_offset == 0.0 { "UTC".to_owned() } else { decimal(format!("UTC{utc_offset:+}")) }
}

fn city_words(city: &City) -> String {
    let region = if city.region.is_empty() { String::new() } else { format!(", {}", city.region) };
    format!("{}{region}, {}", city.name, city.country)
}

/// Returns a city as a site that can be chosen.
fn of_city(city: &City) -> Choice {
    let height = city
        .elevation
        .map_or_else(|| texts::ELEVATION_UNKNOWN.into(), |height| texts::elevation_at(decimal(height.to_string())));
    Choice {
        words: city_words(city),
        where_: format!("{} {}", fixed(city.latitude, 1), fixed(city.longitude, 1)),
        tip: format!("{}, {height}, {}", coordinates(city.latitude, city.longitude), clock_words(city.utc_offset)),
        latitude: city.latitude,
        longitude: city.longitude,
        utc_offset: city.utc_offset,
        dst: rule(city),
        elevation: city.elevation,
    }
}

/// Returns the site at a latitude and longitude \[°\], with the UTC offset and summer time of the nearest city, and its
/// elevation if the coordinates lie within that city. `None` without a city.
fn of_coordinates((latitude, longitude): (f64, f64)) -> Option<Choice> {
    let (city, distance) = nearest(latitude, longitude)?;
    let elevation = city_at(latitude, longitude).and_then(|city| city.elevation);
    let height = elevation.map_or_else(
        || texts::ELEVATION_UNKNOWN_ZERO.into(),
        |height| texts::elevation_as_there(decimal(height.to_string())),
    );
    Some(Choice {
        words: coordinates(latitude, longitude),
        where_: clock_words(city.utc_offset),
        tip: texts::clock_of(&city.name, fixed(distance, 0), clock_words(city.utc_offset), height),
        latitude,
        longitude,
        utc_offset: city.utc_offset,
        dst: rule(city),
        elevation,
    })
}

/// Returns the first sites that match a text, the number of all matching sites, and an error message if the text
/// contains invalid coordinates.
fn choices(text: &str) -> (Vec<Choice>, usize, Option<String>) {
    match read_coordinates(text) {
        Some(Ok(place)) => {
            let list: Vec<_> = of_coordinates(place).into_iter().collect();
            (list, 1, None)
        }
        Some(Err(message)) => (Vec::new(), 0, Some(message)),
        None => {
            let (list, count) = search(text, MOST);
            let none = (count == 0).then(|| texts::NO_CITY.into());
            (list.into_iter().map(of_city).collect(), count, none)
        }
    }
}

/// Draws the section of the site.
pub fn show(ui: &mut Ui, scene: &mut SceneFile) {
    ui.label(site(scene));
    if let Some(choice) = find(ui) {
        scene.site.latitude = Some(choice.latitude);
        scene.site.longitude = Some(choice.longitude);
        scene.site.utc_offset = Some(choice.utc_offset);
        scene.site.dst = choice.dst;
        // The old place's elevation would be wrong without a sign of it.
        scene.site.elevation = choice.elevation.unwrap_or(0.0);
    }
    if scene.sky.time.is_none() && scene.site.latitude.is_none() {
        ui.weak(texts::NO_PLACE_NEEDED);
        return;
    }
    optional(ui, texts::LATITUDE, texts::DEGREES_NORTH, &mut scene.site.latitude, 48.78, -90.0..=90.0);
    optional(ui, texts::LONGITUDE, texts::DEGREES_EAST, &mut scene.site.longitude, 9.18, -180.0..=180.0);
    optional(ui, texts::AHEAD_OF_UTC, " h", &mut scene.site.utc_offset, 1.0, -14.0..=14.0);
    summer_time::show(ui, scene);
    number(ui, texts::ELEVATION, " m", &mut scene.site.elevation, LOWEST..=HIGHEST, 0);
}

/// Draws the search field with its list of sites. Returns the site that the user chose in this frame.
fn find(ui: &mut Ui) -> Option<Choice> {
    let key = ui.make_persistent_id("find a place");
    let id = key.with("field");
    let mut typed: Typed = ui.data(|data| data.get_temp(key)).unwrap_or_default();
    let focused = ui.memory(|memory| memory.has_focus(id));
    // Up and down belong to the list; the field would take them.
    let step = ui.input_mut(|input| {
        let mut count = |key| if focused { input.count_and_consume_key(Modifiers::NONE, key) as isize } else { 0 };
        count(Key::ArrowDown) - count(Key::ArrowUp)
    });
    let field = TextEdit::singleline(&mut typed.text).id(id).desired_width(f32::INFINITY);
    let response = ui.add(field.hint_text(texts::FIND_HINT));
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::TextInput, true, texts::FIND_A_PLACE.get());
        info.current_text_value = Some(typed.text.clone());
        info
    });
    let response = response.on_hover_text(texts::FIND_TIP);
    if response.gained_focus() {
        select_all(ui, id, &typed.text);
    }
    if response.changed() {
        typed.row = 0;
    }
    let (entered, escaped) = ui.input(|input| (input.key_pressed(Key::Enter), input.key_pressed(Key::Escape)));
    let mut chosen = None;
    if response.lost_focus() && escaped {
        typed = Typed::default();
    }
    if !typed.text.trim().is_empty() {
        let (mut list, count, wrong) = choices(&typed.text);
        typed.row = typed.row.saturating_add_signed(step).min(list.len().saturating_sub(1));
        if let Some(message) = wrong {
            ui.add(Label::new(RichText::new(message).color(theme::palette(ui).error)).wrap());
        }
        let mut picked = (response.lost_focus() && entered && !list.is_empty()).then_some(typed.row);
        for (row, choice) in list.iter().enumerate() {
            if choice_ui(ui, choice, row == typed.row) {
                picked = Some(row);
            }
        }
        if count > list.len() {
            ui.weak(texts::more_places(count - list.len()));
        }
        if let Some(row) = picked {
            chosen = Some(list.swap_remove(row));
            typed = Typed::default();
        }
    }
    ui.data_mut(|data| data.insert_temp(key, typed));
    chosen
}

/// Draws a row of the list of sites. Returns `true` if it was clicked.
fn choice_ui(ui: &mut Ui, choice: &Choice, marked: bool) -> bool {
    let height = ui.spacing().interact_size.y;
    let size = egui::vec2(ui.available_width(), height);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.weak(&choice.where_);
        let button = Button::selectable(marked, choice.words.as_str()).truncate();
        let button = ui.with_layout(Layout::left_to_right(Align::Center), |ui| ui.add(button)).inner;
        button.on_hover_text(&choice.tip).clicked()
    })
    .inner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_says_where_it_is_and_whose_clock_it_keeps() {
        let (list, count, wrong) = choices("stuttgart");
        assert!(count >= 1 && wrong.is_none());
        assert_eq!(list[0].words, "Stuttgart, Germany");
        assert_eq!(list[0].dst, DstKey::Eu);
        assert!(list[0].tip.contains("48.78°N 9.18°E") && list[0].tip.contains("UTC+1"), "{}", list[0].tip);
        let (list, _, _) = choices("48.5 9.1");
        assert_eq!((&*list[0].words, &*list[0].where_), ("48.50°N 9.10°E", "UTC+1"));
        assert!(list[0].tip.contains("Tübingen") && list[0].dst == DstKey::Eu, "{}", list[0].tip);
        assert_eq!(choices("sydney, au").0[0].dst, DstKey::Australia);
        // Far from every city the elevation is not known.
        let (list, _, _) = choices("-45 90");
        assert_eq!(list[0].elevation, None);
        assert!(choices("95 9").2.is_some_and(|told| told.contains("latitude")));
        assert!(choices("xyzxyz").2.is_some_and(|told| told.contains("coordinates")));
    }

    #[test]
    fn clocks_read_as_words() {
        assert_eq!([clock_words(0.0), clock_words(5.75), clock_words(-8.0)], ["UTC", "UTC+5.75", "UTC-8"]);
    }
}
