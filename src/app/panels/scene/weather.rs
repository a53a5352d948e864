//! Section of weather and year: the choice of the weather data, their calendar from which an hour can be chosen, and
//! the settings of an annual simulation.

use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::panels::fields::{lines, number, typed};
use crate::app::shell::typed_path::typed_path;
use crate::app::state::Shown;
use crate::app::views::calendar;
use crate::app::year::input::{Calendar, YearAct, station_words, usual_eye, usual_lamps, weather_of};
use crate::compute::weather::Station;
use crate::study::moment;
use crate::study::places::{nearest, summer_time};
use crate::study::scene_file::{DstKey, SceneFile};
use crate::study::scene_words;
use crate::study::sky::{HIGHEST, LOWEST, is_elsewhere};
use crate::study::weather::{YEARS, short_name, warning_words, words};
use crate::study::year_keys::{DaysKey, LampControlKey, YearKeys};
use crate::texts::{Text, fixed, year as texts};
use egui::{ComboBox, Label, RichText, Ui};

/// Weather data of the scene as they were read, and the state of their calendar.
pub struct Weather<'a> {
    /// Calendar of the hours of the weather data.
    pub calendar: &'a Shown<Calendar>,
    /// Display state of the calendar between frames.
    pub view: &'a mut calendar::State,
}

/// Returns the summary of the section when folded: the short name of the weather data.
pub fn essence(scene: &SceneFile) -> String {
    weather_of(scene).map_or_else(|| texts::NO_WEATHER.into(), short_name)
}

/// Returns the error in reading the weather data of the annual simulation; `None` if there is none, or if the sky
/// itself uses the weather data, since the section of the sky then shows the error.
pub fn problem(scene: &SceneFile, weather: &Weather<'_>) -> Option<String> {
    weather.calendar.error.clone().filter(|_| scene.sky.weather.is_none() && scene.year.is_some())
}

/// Draws the section of weather and year.
pub fn show(ui: &mut Ui, scene: &mut SceneFile, weather: Weather<'_>, commands: &mut Vec<Command>) {
    choice(ui, scene, commands);
    if weather_of(scene).is_some() {
        calendar_ui(ui, scene, weather, commands);
    }
    if ui.button(texts::COMPUTE).on_hover_text(texts::COMPUTE_OFFER_TIP).clicked() {
        commands.push(Command::Year(YearAct::Compute));
    }
    if let Some(mut keys) = scene.year.take() {
        year(ui, scene, &mut keys);
        scene.year = Some(keys);
    }
}

/// Draws the choice of the weather data: a list of built-in data, and a field for the path of a file.
fn choice(ui: &mut Ui, scene: &SceneFile, commands: &mut Vec<Command>) {
    let chosen = weather_of(scene);
    let shown = chosen.map_or_else(|| texts::NO_WEATHER.into(), |name| name.display().to_string());
    let built_in = YEARS.iter().find(|year| chosen == Some(&*year.name()));
    let selected = built_in.map_or_else(|| shown.clone(), |year| words(year).to_owned());
    let width = ui.available_width() - 8.0;
    let combo = ComboBox::from_id_salt("weather of the scene").selected_text(selected).width(width).truncate();
    let combo = combo.show_ui(ui, |ui| {
        for year in &YEARS {
            let name = year.name();
            if ui.selectable_label(chosen == Some(&*name), words(year)).clicked() {
                commands.push(Command::Year(YearAct::Weather(name)));
            }
        }
        if ui.selectable_label(false, texts::WEATHER_FILE).clicked() {
            commands.push(Command::Open);
        }
    });
    combo.response.on_hover_text(texts::WEATHER_TIP).accessible_name(texts::WEATHER.get());
    let read = |text: &str| match text.trim() {
        "" => Err(texts::WEATHER_TIP.to_string()),
        name => Ok(typed_path(name)),
    };
    let path = if chosen.is_some() { shown } else { String::new() };
    if let Some(name) = typed(ui, texts::WEATHER, &path, texts::WEATHER_PATH_TIP, read) {
        commands.push(Command::Year(YearAct::Weather(name)));
    }
}

/// Draws the calendar of the weather data, with warnings; a click on an hour makes it the scene's date and time.
fn calendar_ui(ui: &mut Ui, scene: &mut SceneFile, weather: Weather<'_>, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let Weather { calendar: shown, view } = weather;
    let Some(calendar) = shown.value.as_deref().filter(|calendar| weather_of(scene) == Some(&*calendar.key.0)) else {
        match &shown.error {
            Some(error) => {
                ui.add(Label::new(RichText::new(error).color(palette.error)).wrap());
            }
            None => lines(ui, texts::READING_WEATHER.get(), palette.weak, 1),
        }
        return;
    };
    lines(ui, &station_words(&calendar.station), palette.weak, 2);
    if is_elsewhere(&calendar.station, &scene.site) {
        elsewhere(ui, scene, &calendar.station);
    }
    for code in &calendar.warnings {
        lines(ui, warning_words(code), palette.warning, 3);
    }
    if let Some(closure) = calendar.closure.filter(|closure| closure.is_off()) {
        lines(ui, &texts::clock_off(fixed(closure.best_offset, 0)), palette.warning, 2);
    }
    let moment = moment::of(scene).filter(|_| scene.sky.weather.as_deref() == Some(&*calendar.key.0)).map(|time| {
        let time = scene.site.dst.standard(time, calendar.station.utc_offset);
        let minute = 60 * u16::from(time.hour().unsigned_abs()) + u16::from(time.minute().unsigned_abs());
        (time.month().unsigned_abs(), time.day().unsigned_abs(), minute)
    });
    let input = calendar::Input { maps: &calendar.maps, moment, revision: shown.revision };
    if let Some((record, walking)) = calendar::show(ui, &input, view)
        && let Some(time) = calendar.starts.get(record)
    {
        let clock = scene.site.dst.clock(*time, calendar.station.utc_offset);
        commands.push(Command::Year(YearAct::Pick(clock, walking)));
    }
}

/// Draws a warning that the site of the scene differs from the station of the weather data, and a button that adopts
/// the station as the site.
fn elsewhere(ui: &mut Ui, scene: &mut SceneFile, station: &Station) {
    lines(ui, &texts::weather_elsewhere(scene_words::station(station)), theme::palette(ui).warning, 3);
    if ui.button(texts::TAKE_PLACE).on_hover_text(texts::TAKE_PLACE_TIP).clicked() {
        let site = &mut scene.site;
        site.latitude = Some(station.latitude);
        site.longitude = Some(station.longitude);
        site.utc_offset = Some(station.utc_offset);
        site.dst = nearest(station.latitude, station.longitude).map_or(DstKey::None, |(city, _)| summer_time(city));
        site.elevation = station.elevation.clamp(LOWEST, HIGHEST);
    }
}

/// Draws the settings of an annual simulation; observers and electric-lighting zones other than the default ones can be
/// edited in the scene file only.
fn year(ui: &mut Ui, scene: &SceneFile, keys: &mut YearKeys) {
    ui.separator();
    let before = keys.hours;
    number(ui, texts::OCCUPIED_FROM, " h", &mut keys.hours.from, 0.0..=24.0, 1);
    number(ui, texts::OCCUPIED_TO, " h", &mut keys.hours.to, 0.0..=24.0, 1);
    if keys.hours.from == keys.hours.to {
        keys.hours = before;
    }
    let mut weekdays = keys.hours.days == DaysKey::Weekdays;
    if ui.checkbox(&mut weekdays, texts::WEEKDAYS.get()).changed() {
        keys.hours.days = if weekdays { DaysKey::Weekdays } else { DaysKey::All };
    }
    let mut eye = !keys.eyes.is_empty();
    if ui.checkbox(&mut eye, texts::EYE.get()).on_hover_text(texts::EYE_TIP).changed() {
        keys.eyes = if eye { vec![usual_eye(scene)] } else { Vec::new() };
    }
    let mut lit = keys.lighting.is_some();
    if ui.checkbox(&mut lit, texts::LAMPS.get()).changed() {
        keys.lighting = lit.then(usual_lamps);
    }
    let Some(lamps) = &mut keys.lighting else { return };
    number(ui, texts::LAMP_POWER, " W/m²", &mut lamps.power, 0.0..=50.0, 1);
    number(ui, texts::LAMP_TARGET, " lx", &mut lamps.target, 50.0..=2000.0, 0);
    let word = |control: LampControlKey| -> Text {
        match control {
            LampControlKey::None => texts::LAMPS_ALWAYS,
            LampControlKey::OnOff => texts::LAMPS_ON_OFF,
            LampControlKey::Stepped => texts::LAMPS_STEPPED,
            LampControlKey::Dimming => texts::LAMPS_DIMMED,
        }
    };
    let name = ui.label(texts::LAMP_CONTROL);
    let combo = ComboBox::from_id_salt("lamps").selected_text(word(lamps.control)).width(ui.available_width() - 8.0);
    let combo = combo.show_ui(ui, |ui| {
        use LampControlKey::{Dimming, None, OnOff, Stepped};
        for control in [Dimming, Stepped, OnOff, None] {
            ui.selectable_value(&mut lamps.control, control, word(control));
        }
    });
    combo.response.labelled_by(name.id);
}
