//! The scene panel: sections that can be folded and then show a summary. Errors are shown at the field of the invalid
//! value.

mod apertures;
mod outside;
mod place;
mod sky;
mod skyline;
mod summer_time;
mod weather;
mod when;

pub use weather::Weather;

use super::fields::number;
use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::scene::moment;
use crate::app::scene::outside::ObstructionEffects;
use crate::app::state::{Shown, State};
use crate::app::title;
use crate::study::scene_file::{SceneFile, SkyModelKey};
use crate::texts::{Text, fixed, scene as texts, year as year_texts};
use egui::{CollapsingHeader, DragValue, RichText, ScrollArea, Sense, Stroke, Ui, Vec2, vec2};
use std::path::Path;

/// Draws the scene panel.
pub fn show(
    ui: &mut Ui,
    state: &State,
    weather: Weather<'_>,
    effects: &Shown<ObstructionEffects>,
    commands: &mut Vec<Command>,
) {
    ui.heading(texts::SCENE);
    // A copy is edited; the panel changes nothing itself, and a command is given only where something differs.
    let mut scene = state.document.scene.clone();
    ScrollArea::vertical().id_salt("scene").auto_shrink([false, false]).show(ui, |ui| {
        sections(ui, state, &mut scene, weather, effects, commands);
    });
    if scene != state.document.scene {
        commands.push(Command::Scene(Box::new(scene)));
    }
}

/// Draws the sections in the order in which a study is planned: site, façade, date and time, sky, weather, ground,
/// obstructions, apertures, room, sensors.
fn sections(
    ui: &mut Ui,
    state: &State,
    scene: &mut SceneFile,
    calendar: Weather<'_>,
    effects: &Shown<ObstructionEffects>,
    commands: &mut Vec<Command>,
) {
    let perez = scene.sky.model == SkyModelKey::Perez;
    let wrong = |title: Text| {
        let error = state.scene_error.as_ref().filter(|error| section_of(error.key, perez) == title)?;
        Some(error.to_string())
    };
    section(ui, texts::PLACE, &title::site(scene), wrong(texts::PLACE), false, |ui| place::show(ui, scene));
    let facing = format!("{}, {:.0}°", moment::bearing_word(scene.site.azimuth), scene.site.azimuth);
    section(ui, texts::FACADE, &facing, wrong(texts::FACADE), true, |ui| facade(ui, scene, &state.base()));
    section(ui, texts::DATE_AND_TIME, &title::time(scene), wrong(texts::DATE_AND_TIME), true, |ui| {
        when::show(ui, scene, &state.base());
    });
    // Errors that depend on the sun's position are shown on lines that are always there.
    let low_sun = sky::low_sun(scene);
    let wrong_sky = wrong(texts::SKY).filter(|_| low_sun.is_none());
    section(ui, texts::SKY, &title::sky(scene), wrong_sky, true, |ui| sky::show(ui, scene, low_sun));
    let essence = weather::essence(scene);
    section(ui, year_texts::WEATHER_AND_YEAR, &essence, weather::problem(scene, &calendar), false, |ui| {
        weather::show(ui, scene, calendar, commands);
    });
    let ground = format!("ρ {}", fixed(scene.site.ground_reflectance, 2));
    section(ui, texts::GROUND_AND_SKYLINE, &ground, wrong(texts::GROUND_AND_SKYLINE), false, |ui| {
        number(ui, texts::GROUND_REFLECTANCE, "", &mut scene.site.ground_reflectance, 0.0..=1.0, 2);
        let height = &mut scene.site.ground_height;
        number(ui, texts::GROUND_HEIGHT, " m", height, -1000.0..=1000.0, 2);
        skyline::show(ui, scene);
    });
    section(ui, texts::OUTSIDE, &outside::essence(scene), outside::problem(scene), false, |ui| {
        outside::show(ui, scene, effects, commands);
    });
    let count = scene.aperture.len();
    let essence = scene.aperture.first().map_or_else(
        || texts::NONE.into(),
        |a| {
            if count > 1 { format!("{count}") } else { format!("{} × {} m", fixed(a.size[0], 1), fixed(a.size[1], 1)) }
        },
    );
    // The scene's error is that of sky and site; whether apertures fit their walls and lie apart is judged here.
    let clash = apertures::problem(scene);
    section(ui, texts::APERTURES, &essence, clash, false, |ui| apertures::show(ui, scene));
    let sizes = [scene.room.width, scene.room.depth, scene.room.height];
    let room = format!("{} m", sizes.map(|size| fixed(size, 1)).join(" × "));
    let wrong_room = wrong(texts::ROOM).or_else(|| apertures::beyond(scene));
    section(ui, texts::ROOM, &room, wrong_room, false, |ui| room_ui(ui, scene));
    let plane = scene.sensors.plane.map_or_else(
        || texts::points(scene.sensors.points.len()),
        |plane| texts::plane(plane.nx, plane.ny, fixed(plane.z, 2)),
    );
    let above = scene
        .sensors
        .plane
        .filter(|plane| plane.z > scene.room.height)
        .map(|plane| texts::plane_too_high(fixed(plane.z, 2), fixed(scene.room.height, 2)));
    section(ui, texts::SENSORS, &plane, wrong(texts::SENSORS).or(above), false, |ui| sensors(ui, scene));
}

/// Returns the title of the section in which a key of the scene file is edited.
fn section_of(key: &str, perez: bool) -> Text {
    match key {
        "site.azimuth" => texts::FACADE,
        "site.ground_reflectance" | "site.ground_height" => texts::GROUND_AND_SKYLINE,
        "sky.time" => texts::DATE_AND_TIME,
        _ if key.starts_with("site.") => texts::PLACE,
        // A Perez sky's figures are wrong for a low sun, not the sun.
        _ if key.starts_with("sky.sun.a") && !perez => texts::DATE_AND_TIME,
        _ if key.starts_with("sky.obstruction") || key.starts_with("sky.skyline") => texts::GROUND_AND_SKYLINE,
        _ if key.starts_with("room") => texts::ROOM,
        _ if key.starts_with("sensors") => texts::SENSORS,
        _ => texts::SKY,
    }
}

/// Draws a section with a title that folds it; when folded it shows the summary `essence`. The error `wrong` is always
/// shown.
fn section(ui: &mut Ui, title: Text, essence: &str, wrong: Option<String>, open: bool, body: impl FnOnce(&mut Ui)) {
    let header = CollapsingHeader::new(RichText::new(title.get()).strong())
        .id_salt(title.english())
        .default_open(open)
        .show(ui, body);
    if let Some(text) = wrong {
        ui.add(egui::Label::new(RichText::new(text).color(theme::palette(ui).error)).wrap());
    }
    if header.fully_closed() {
        let at = header.header_response.rect.right_center() + vec2(8.0, 0.0);
        let colour = theme::palette(ui).weak;
        let right = ui.max_rect().right();
        let font = egui::FontId::proportional(13.0);
        let galley = theme::one_line(ui.painter(), essence, font, colour, right - at.x);
        ui.painter().galley(at - vec2(0.0, 0.5 * galley.size().y), galley, colour);
    }
}

fn facade(ui: &mut Ui, scene: &mut SceneFile, base: &Path) {
    ui.horizontal(|ui| {
        dial(ui, scene, base);
        ui.vertical(|ui| {
            ui.label(texts::faces(moment::bearing_word(scene.site.azimuth)));
            number(ui, texts::BEARING, "°", &mut scene.site.azimuth, 0.0..=360.0, 0);
        });
    });
}

/// Draws a compass whose needle, the outward normal of the façade, can be dragged; a dot shows the azimuth of the sun.
fn dial(ui: &mut Ui, scene: &mut SceneFile, base: &Path) {
    let palette = theme::palette(ui);
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(76.0), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Slider, true, texts::DIAL.get()));
    let (centre, radius) = (rect.center(), 27.0);
    if let Some(pointer) = response.interact_pointer_pos() {
        let arm = pointer - centre;
        if arm.length() > 3.0 {
            let degrees = f64::from(arm.x).atan2(f64::from(-arm.y)).to_degrees().rem_euclid(360.0);
            scene.site.azimuth = (degrees / 5.0).round() * 5.0 % 360.0;
        }
    }
    let painter = ui.painter();
    painter.circle(centre, radius, palette.raised, Stroke::new(1.0, palette.line));
    let towards = |bearing: f64| {
        let (sin, cos) = bearing.to_radians().sin_cos();
        vec2(sin as f32, -cos as f32)
    };
    for (bearing, letter) in [(0.0, texts::NORTH), (90.0, texts::EAST), (180.0, texts::SOUTH), (270.0, texts::WEST)] {
        let at = centre + towards(bearing) * (radius + 7.0);
        painter.text(at, egui::Align2::CENTER_CENTER, letter.get(), egui::FontId::proportional(13.0), palette.weak);
    }
    let normal = towards(scene.site.azimuth);
    let across = vec2(normal.y, -normal.x);
    painter.line_segment([centre - across * 14.0, centre + across * 14.0], Stroke::new(3.0, palette.text));
    painter.arrow(centre, normal * (radius - 3.0), Stroke::new(2.0, palette.accent));
    if let Some((altitude, bearing)) = moment::sun(scene, base).filter(|sun| sun.0 > 0.0) {
        let reach = radius * (1.0 - altitude as f32 / std::f32::consts::FRAC_PI_2);
        painter.circle_filled(centre + towards(bearing) * reach, 4.0, palette.sun);
    }
}

fn room_ui(ui: &mut Ui, scene: &mut SceneFile) {
    let room = &mut scene.room;
    number(ui, texts::WIDTH, " m", &mut room.width, 1.0..=30.0, 2);
    number(ui, texts::DEPTH, " m", &mut room.depth, 1.0..=30.0, 2);
    number(ui, texts::HEIGHT, " m", &mut room.height, 2.0..=12.0, 2);
    number(ui, texts::FLOOR_REFLECTANCE, "", &mut room.reflectance.floor, 0.0..=0.99, 2);
    number(ui, texts::WALL_REFLECTANCE, "", &mut room.reflectance.walls, 0.0..=0.99, 2);
    number(ui, texts::CEILING_REFLECTANCE, "", &mut room.reflectance.ceiling, 0.0..=0.99, 2);
    ui.checkbox(&mut scene.compute.interreflection, texts::INTERREFLECTION);
}

/// Draws the fields of the sensor grid: its height above the floor, and the numbers of sensors across the width and the
/// depth of the room.
fn sensors(ui: &mut Ui, scene: &mut SceneFile) {
    let height = scene.room.height;
    let Some(plane) = &mut scene.sensors.plane else {
        ui.weak(texts::LISTED_POINTS);
        return;
    };
    number(ui, texts::PLANE_HEIGHT, " m", &mut plane.z, 0.0..=height, 2);
    for (label, count) in [(texts::ACROSS, &mut plane.nx), (texts::DEEP, &mut plane.ny)] {
        ui.horizontal(|ui| {
            let name = ui.label(label);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.add(DragValue::new(count).range(1..=100).suffix(texts::SENSORS_SUFFIX.get())).labelled_by(name.id);
            });
        });
    }
}
