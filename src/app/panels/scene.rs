//! Where and when: sections that fold and then show their essence. What is wrong is said where it is typed.

mod apertures;
mod place;
mod sky;
mod when;

use super::fields::number;
use crate::app::command::Command;
use crate::app::moment;
use crate::app::state::State;
use crate::app::theme;
use crate::app::title;
use crate::study::scene_file::{ObstructionKeys, SceneFile, SkyModelKey};
use egui::{CollapsingHeader, DragValue, RichText, ScrollArea, Sense, Stroke, Ui, Vec2, vec2};

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.heading("Scene");
    // A copy is edited; the panel changes nothing itself, and a command is given only where something differs.
    let mut scene = state.document.scene.clone();
    ScrollArea::vertical().id_salt("scene").auto_shrink([false, false]).show(ui, |ui| {
        sections(ui, state, &mut scene);
    });
    if scene != state.document.scene {
        commands.push(Command::Scene(Box::new(scene)));
    }
}

/// The sections in the order in which a study is thought of: where, when, what sky, then the room.
fn sections(ui: &mut Ui, state: &State, scene: &mut SceneFile) {
    let perez = scene.sky.model == SkyModelKey::Perez;
    let wrong = |title: &str| {
        let error = state.scene_error.as_ref().filter(|error| section_of(error.key, perez) == title)?;
        Some(error.to_string())
    };
    section(ui, "Place", &title::place(scene), wrong("Place"), false, |ui| place::show(ui, scene));
    let facing = format!("{}, {:.0}°", moment::bearing_word(scene.site.azimuth), scene.site.azimuth);
    section(ui, "Façade", &facing, wrong("Façade"), true, |ui| facade(ui, scene));
    section(ui, "Date and time", &title::time(scene), wrong("Date and time"), true, |ui| {
        when::show(ui, scene);
    });
    // What is wrong because of where the sun stands is told on lines that are always there.
    let low_sun = sky::low_sun(scene);
    let wrong_sky = wrong("Sky").filter(|_| low_sun.is_none());
    section(ui, "Sky", &title::sky(scene), wrong_sky, true, |ui| sky::show(ui, scene, low_sun));
    let ground = format!("ρ {:.2}", scene.site.ground_reflectance);
    section(ui, "Ground and skyline", &ground, wrong("Ground and skyline"), false, |ui| {
        ground_and_skyline(ui, scene);
    });
    let count = scene.aperture.len();
    let essence = scene.aperture.first().map_or_else(
        || "none".to_owned(),
        |a| if count > 1 { format!("{count}") } else { format!("{:.1} × {:.1} m", a.size[0], a.size[1]) },
    );
    // The scene's error is that of sky and site; whether apertures fit their walls and lie apart is judged here.
    let clash = apertures::problem(scene);
    section(ui, "Apertures", &essence, clash, false, |ui| apertures::show(ui, scene));
    let room = format!("{:.1} × {:.1} × {:.1} m", scene.room.width, scene.room.depth, scene.room.height);
    let wrong_room = wrong("Room").or_else(|| apertures::beyond(scene));
    section(ui, "Room", &room, wrong_room, false, |ui| room_ui(ui, scene));
    let plane = scene.sensors.plane.map_or_else(
        || format!("{} points", scene.sensors.points.len()),
        |plane| format!("{} × {} at {:.2} m", plane.nx, plane.ny, plane.z),
    );
    let above = scene.sensors.plane.filter(|plane| plane.z > scene.room.height).map(|plane| {
        format!("The plane at {:.2} m lies above the ceiling, {:.2} m: lower it.", plane.z, scene.room.height)
    });
    section(ui, "Sensors", &plane, wrong("Sensors").or(above), false, |ui| sensors(ui, scene));
}

/// The section in which a key of the scene file is edited.
fn section_of(key: &str, perez: bool) -> &'static str {
    match key {
        "site.azimuth" => "Façade",
        "site.ground_reflectance" => "Ground and skyline",
        "sky.time" => "Date and time",
        _ if key.starts_with("site.") => "Place",
        // A Perez sky's figures are wrong for a low sun, not the sun.
        _ if key.starts_with("sky.sun.a") && !perez => "Date and time",
        _ if key.starts_with("sky.obstruction") => "Ground and skyline",
        _ if key.starts_with("room") => "Room",
        _ if key.starts_with("sensors") => "Sensors",
        _ => "Sky",
    }
}

/// A section that folds; folded it shows its essence. What is wrong in it is said in either case.
fn section(ui: &mut Ui, title: &str, essence: &str, wrong: Option<String>, open: bool, body: impl FnOnce(&mut Ui)) {
    let header = CollapsingHeader::new(RichText::new(title).strong()).id_salt(title).default_open(open).show(ui, body);
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

fn facade(ui: &mut Ui, scene: &mut SceneFile) {
    ui.horizontal(|ui| {
        dial(ui, scene);
        ui.vertical(|ui| {
            ui.label(format!("Faces {}", moment::bearing_word(scene.site.azimuth)));
            number(ui, "Bearing", "°", &mut scene.site.azimuth, 0.0..=360.0, 0);
        });
    });
}

/// A compass to drag; the needle is the façade's outward normal, the dot the sun.
fn dial(ui: &mut Ui, scene: &mut SceneFile) {
    let palette = theme::palette(ui);
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(76.0), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Slider, true, "Façade bearing dial"));
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
    for (bearing, letter) in [(0.0, "N"), (90.0, "E"), (180.0, "S"), (270.0, "W")] {
        let at = centre + towards(bearing) * (radius + 7.0);
        painter.text(at, egui::Align2::CENTER_CENTER, letter, egui::FontId::proportional(13.0), palette.weak);
    }
    let normal = towards(scene.site.azimuth);
    let across = vec2(normal.y, -normal.x);
    painter.line_segment([centre - across * 14.0, centre + across * 14.0], Stroke::new(3.0, palette.text));
    painter.arrow(centre, normal * (radius - 3.0), Stroke::new(2.0, palette.accent));
    if let Some((altitude, bearing)) = moment::sun(scene).filter(|sun| sun.0 > 0.0) {
        let reach = radius * (1.0 - altitude as f32 / std::f32::consts::FRAC_PI_2);
        painter.circle_filled(centre + towards(bearing) * reach, 4.0, palette.sun);
    }
}

fn ground_and_skyline(ui: &mut Ui, scene: &mut SceneFile) {
    number(ui, "Ground reflectance", "", &mut scene.site.ground_reflectance, 0.0..=1.0, 2);
    let mut skyline = scene.sky.obstruction.unwrap_or(ObstructionKeys { altitude: 0.0, luminance: 0.0 });
    let before = skyline;
    number(ui, "Skyline altitude", "°", &mut skyline.altitude, 0.0..=60.0, 1);
    number(ui, "Skyline luminance", " cd/m²", &mut skyline.luminance, 0.0..=20_000.0, 0);
    if skyline != before {
        scene.sky.obstruction = Some(skyline);
    }
}

fn room_ui(ui: &mut Ui, scene: &mut SceneFile) {
    let room = &mut scene.room;
    number(ui, "Width", " m", &mut room.width, 1.0..=30.0, 2);
    number(ui, "Depth", " m", &mut room.depth, 1.0..=30.0, 2);
    number(ui, "Height", " m", &mut room.height, 2.0..=12.0, 2);
    number(ui, "Floor reflectance", "", &mut room.reflectance.floor, 0.0..=0.99, 2);
    number(ui, "Wall reflectance", "", &mut room.reflectance.walls, 0.0..=0.99, 2);
    number(ui, "Ceiling reflectance", "", &mut room.reflectance.ceiling, 0.0..=0.99, 2);
    ui.checkbox(&mut scene.compute.interreflection, "Interreflection");
}

fn sensors(ui: &mut Ui, scene: &mut SceneFile) {
    let height = scene.room.height;
    let Some(plane) = &mut scene.sensors.plane else {
        ui.weak("Listed points of the scene file.");
        return;
    };
    number(ui, "Height of the plane", " m", &mut plane.z, 0.0..=height, 2);
    for (label, count) in [("Across", &mut plane.nx), ("Deep", &mut plane.ny)] {
        ui.horizontal(|ui| {
            let name = ui.label(label);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.add(DragValue::new(count).range(1..=100).suffix(" sensors")).labelled_by(name.id);
            });
        });
    }
}
