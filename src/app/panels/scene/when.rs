//! Section of date and time: typed, set by sliders, or replaced by the angles of the sun. Every line has a fixed
//! position, whatever the sun's.

use crate::app::display::theme;
use crate::app::panels::fields::{lines, number, typed};
use crate::app::scene::moment;
use crate::app::shell::clock;
use crate::app::shell::typing::{read_clock, read_date};
use crate::study::scene_file::{DstKey, SceneFile};
use crate::study::sun_position::RiseSet;
use crate::texts::scene as texts;
use egui::cache::{ComputerMut, FrameCache};
use egui::{Slider, Stroke, Ui, WidgetInfo};
use std::cmp::Ordering;
use std::hash::{Hash, Hasher};
use std::path::Path;

/// Step of the slider of the time of day. \[min\]
const STEP: i32 = 5;

/// Draws the section of date and time.
pub fn show(ui: &mut Ui, scene: &mut SceneFile, base: &Path) {
    let Some(time) = moment::of(scene) else { return angles(ui, scene, base) };
    let shown = clock::date(time.date());
    let date = typed(ui, texts::DATE, &shown, texts::DATE_TIP, |text| read_date(text, time.year()));
    if let Some(date) = date {
        moment::set_date(scene, date);
    }
    ui.spacing_mut().slider_width = ui.available_width() - 8.0;
    let before = i32::from(time.day_of_year());
    let mut day = before;
    let slider = ui.add(Slider::new(&mut day, 1..=i32::from(time.days_in_year())).show_value(false));
    slider.widget_info(|| WidgetInfo::slider(true, f64::from(day), texts::DAY_OF_YEAR.get()));
    if day != before {
        moment::step(scene, day - before, 0);
    }
    let label = if scene.site.dst == DstKey::None { texts::STANDARD_TIME } else { texts::TIME };
    let clock = typed(ui, label, &time.strftime("%H:%M").to_string(), texts::TIME_TIP, read_clock);
    if let Some((hour, minute)) = clock {
        moment::set_clock(scene, hour, minute);
    }
    let before = i32::from(time.hour()) * 60 + i32::from(time.minute());
    let mut minutes = before;
    let slider = ui.add(Slider::new(&mut minutes, 0..=1440 - STEP).show_value(false).smart_aim(false));
    slider.widget_info(|| WidgetInfo::slider(true, f64::from(minutes) / 60.0, texts::TIME_OF_DAY.get()));
    sun_marks(ui, scene, base, slider.rect);
    // A time that was typed to the minute stays until the slider is moved. The slider ends before midnight does.
    if minutes != before && before <= 1440 - STEP || slider.dragged() {
        let pointed = slider.is_pointer_button_down_on() || slider.dragged() || slider.clicked();
        let steps = f64::from(minutes) / f64::from(STEP);
        // Keys and screen readers move it by a minute: on to the next step.
        let steps = match minutes.cmp(&before) {
            _ if pointed => steps.round(),
            Ordering::Less => steps.floor(),
            _ => steps.ceil(),
        };
        let stepped = steps as i32 * STEP;
        moment::step(scene, 0, stepped - before);
    }
    sun(ui, scene, base);
}

/// Scene and its base folder, hashed by site and day alone, as a key for sunrise and sunset.
#[derive(Clone, Copy)]
struct Day<'a>(&'a SceneFile, &'a Path);

impl Hash for Day<'_> {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        let site = &self.0.site;
        [site.latitude, site.longitude, site.utc_offset].map(|number| number.map(f64::to_bits)).hash(hasher);
        (&self.0.sky.weather, self.1).hash(hasher);
        moment::of(self.0).map(|time| time.date()).hash(hasher);
    }
}

/// Computation of sunrise and sunset for egui's cache: once per site and day, because it takes longer than drawing the
/// panel.
#[derive(Default)]
struct SunHours;

impl ComputerMut<Day<'_>, Option<RiseSet>> for SunHours {
    fn compute(&mut self, day: Day<'_>) -> Option<RiseSet> {
        moment::sun_hours(day.0, day.1)
    }
}

fn sun_hours(ui: &Ui, scene: &SceneFile, base: &Path) -> Option<RiseSet> {
    ui.memory_mut(|memory| *memory.caches.cache::<FrameCache<Option<RiseSet>, SunHours>>().get(Day(scene, base)))
}

/// Draws the times of sunrise and sunset, and the position of the sun, as text.
fn sun(ui: &mut Ui, scene: &SceneFile, base: &Path) {
    let day = match sun_hours(ui, scene, base).map(|hours| (hours.rise, hours.set)) {
        Some((Some(rise), Some(set))) => texts::rise_and_set(moment::clock(rise), moment::clock(set)),
        Some((Some(rise), None)) => texts::no_set(moment::clock(rise)),
        Some((None, Some(set))) => texts::no_rise(moment::clock(set)),
        Some((None, None)) => texts::NO_RISE_OR_SET.into(),
        None => texts::NO_PLACE_NO_SUN.into(),
    };
    let weak = theme::palette(ui).weak;
    lines(ui, &day, weak, 1);
    lines(ui, &position(scene, base), weak, 1);
}

/// Returns the altitude of the sun as text, and whether the sun is in front of or behind the façade; empty if it is
/// unknown.
fn position(scene: &SceneFile, base: &Path) -> String {
    let Some((altitude, bearing)) = moment::sun(scene, base) else { return String::new() };
    let words = moment::height_words(altitude.to_degrees(), 0);
    if altitude <= 0.0 {
        texts::sun_at(words)
    } else if moment::before_facade((altitude, bearing), scene.site.azimuth) {
        texts::sun_before(words)
    } else {
        texts::sun_behind(words)
    }
}

/// Draws the fields for altitude and azimuth of the sun, in place of date and time.
fn angles(ui: &mut Ui, scene: &mut SceneFile, base: &Path) {
    ui.weak(texts::BY_ANGLES);
    let sun = &mut scene.sky.sun;
    let mut altitude = sun.altitude.unwrap_or(40.0);
    let mut azimuth = sun.azimuth.unwrap_or(180.0);
    let changed = number(ui, texts::SUN_ALTITUDE, "°", &mut altitude, -90.0..=90.0, 1)
        | number(ui, texts::SUN_BEARING, "°", &mut azimuth, 0.0..=360.0, 1);
    if changed {
        sun.altitude = Some(altitude);
        sun.azimuth = Some(azimuth);
    }
    let weak = theme::palette(ui).weak;
    lines(ui, &position(scene, base), weak, 1);
    if ui.button(texts::BY_DATE).clicked() {
        moment::set(scene, jiff::civil::date(2026, 3, 21).at(12, 0, 0, 0));
        scene.site.latitude.get_or_insert(48.78);
        scene.site.longitude.get_or_insert(9.18);
        scene.site.utc_offset.get_or_insert(1.0);
    }
}

/// Draws ticks for sunrise and sunset under the slider of the time of day.
fn sun_marks(ui: &Ui, scene: &SceneFile, base: &Path, rect: egui::Rect) {
    let Some(hours) = sun_hours(ui, scene, base) else { return };
    let colour = theme::palette(ui).sun;
    // The handle's radius is kept free at both ends of a slider.
    let margin = rect.height() / 2.5;
    for hour in [hours.rise, hours.set].into_iter().flatten() {
        let x = egui::lerp(rect.left() + margin..=rect.right() - margin, (hour / 24.0) as f32);
        ui.painter().vline(x, rect.bottom() - 4.0..=rect.bottom() + 2.0, Stroke::new(2.0, colour));
    }
}
