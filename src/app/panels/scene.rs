//! Where and when: sections that fold and then show their essence. What is wrong is said where it is typed.

mod apertures;

use super::fields::{number, optional};
use crate::app::command::Command;
use crate::app::moment;
use crate::app::state::State;
use crate::app::theme;
use crate::app::title::{self, CITIES};
use crate::study::scene_file::{ObstructionKeys, SceneFile, SkyModelKey};
use egui::{CollapsingHeader, ComboBox, DragValue, RichText, ScrollArea, Sense, Slider, Stroke, Ui, Vec2, vec2};

/// CIE general sky types in the standard's order. ISO 15469, table 1.
const CIE: [&str; 16] = [
    "1 overcast, steep, brighter to the sun",
    "2 overcast, steep, azimuthally even",
    "3 overcast, moderate, brighter to the sun",
    "4 overcast, moderate, azimuthally even",
    "5 uniform",
    "6 partly cloudy, no gradation, brighter to the sun",
    "7 partly cloudy, no gradation, brighter round the sun",
    "8 partly cloudy, no gradation, clear corona",
    "9 partly cloudy, sun obscured",
    "10 partly cloudy, brighter round the sun",
    "11 white-blue, clear corona",
    "12 clear, low turbidity",
    "13 clear, polluted air",
    "14 cloudless, turbid, broad corona",
    "15 white-blue, turbid, broad corona",
    "16 traditional overcast",
];

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.heading("Scene");
    // A copy is edited; the panel changes nothing itself, and a command is given only where something differs.
    let mut scene = state.document.scene.clone();
    let mut follows = state.document.daylight_follows;
    ScrollArea::vertical().id_salt("scene").auto_shrink([false, false]).show(ui, |ui| {
        sections(ui, state, &mut scene, &mut follows);
    });
    if follows != state.document.daylight_follows {
        commands.push(Command::DaylightFollows(follows));
    }
    if scene != state.document.scene {
        commands.push(Command::Scene(Box::new(scene)));
    }
}

/// The sections in the order in which a study is thought of: where, when, what sky, then the room.
fn sections(ui: &mut Ui, state: &State, scene: &mut SceneFile, follows: &mut bool) {
    let wrong = |title: &str| {
        let error = state.scene_error.as_ref().filter(|error| section_of(error.key) == title)?;
        Some(error.to_string())
    };
    section(ui, "Place", &title::place(scene), wrong("Place"), false, |ui| place(ui, scene));
    let facing = format!("{}, {:.0}°", moment::bearing_word(scene.site.azimuth), scene.site.azimuth);
    section(ui, "Façade", &facing, wrong("Façade"), true, |ui| facade(ui, scene));
    section(ui, "Date and time", &title::time(scene), wrong("Date and time"), true, |ui| {
        date_and_time(ui, scene);
    });
    section(ui, "Sky", &title::sky(scene), wrong("Sky"), true, |ui| sky(ui, scene, follows));
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
    section(ui, "Room", &room, wrong("Room"), false, |ui| room_ui(ui, scene));
    let plane = scene.sensors.plane.map_or_else(
        || format!("{} points", scene.sensors.points.len()),
        |plane| format!("{} × {} at {:.2} m", plane.nx, plane.ny, plane.z),
    );
    section(ui, "Sensors", &plane, wrong("Sensors"), false, |ui| sensors(ui, scene));
}

/// The section in which a key of the scene file is edited.
fn section_of(key: &str) -> &'static str {
    match key {
        "site.azimuth" => "Façade",
        "site.ground_reflectance" => "Ground and skyline",
        "sky.time" => "Date and time",
        _ if key.starts_with("site.") => "Place",
        _ if key.starts_with("sky.sun.a") => "Date and time",
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

fn place(ui: &mut Ui, scene: &mut SceneFile) {
    let shown = title::place(scene);
    let city =
        ComboBox::from_id_salt("city").selected_text(shown).width(ui.available_width() - 8.0).show_ui(ui, |ui| {
            for (name, latitude, longitude, offset) in CITIES {
                let here = scene.site.latitude == Some(latitude) && scene.site.longitude == Some(longitude);
                if ui.selectable_label(here, name).clicked() {
                    scene.site.latitude = Some(latitude);
                    scene.site.longitude = Some(longitude);
                    scene.site.utc_offset = Some(offset);
                }
            }
        });
    city.response.accessible_name("City");
    if scene.sky.time.is_none() && scene.site.latitude.is_none() {
        ui.weak("Not needed while the sun is given by angles.");
        return;
    }
    optional(ui, "Latitude", "° N", &mut scene.site.latitude, 48.78, -90.0..=90.0);
    optional(ui, "Longitude", "° E", &mut scene.site.longitude, 9.18, -180.0..=180.0);
    optional(ui, "Ahead of UTC", " h", &mut scene.site.utc_offset, 1.0, -14.0..=14.0);
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

fn date_and_time(ui: &mut Ui, scene: &mut SceneFile) {
    let Some(time) = moment::of(scene) else {
        ui.weak("The sun is given by angles.");
        let mut altitude = scene.sky.sun.altitude.unwrap_or(40.0);
        let mut azimuth = scene.sky.sun.azimuth.unwrap_or(180.0);
        number(ui, "Sun altitude", "°", &mut altitude, -10.0..=90.0, 1);
        number(ui, "Sun bearing", "°", &mut azimuth, 0.0..=360.0, 1);
        if scene.sky.sun.altitude.is_some_and(|old| old != altitude)
            || scene.sky.sun.azimuth.is_some_and(|old| old != azimuth)
        {
            scene.sky.sun.altitude = Some(altitude);
            scene.sky.sun.azimuth = Some(azimuth);
        }
        if ui.button("By date and time").clicked() {
            moment::set(scene, jiff::civil::date(2026, 3, 21).at(12, 0, 0, 0));
            scene.site.latitude.get_or_insert(48.78);
            scene.site.longitude.get_or_insert(9.18);
            scene.site.utc_offset.get_or_insert(1.0);
        }
        return;
    };
    let mut day = i32::from(time.day_of_year());
    let mut minutes = i32::from(time.hour()) * 60 + i32::from(time.minute());
    let before = (day, minutes);
    let days = i32::from(time.days_in_year());
    let width = ui.available_width() - 70.0;
    ui.spacing_mut().slider_width = width.max(80.0);
    let name = ui.label("Date");
    let date_text = time.strftime("%-d %b").to_string();
    ui.horizontal(|ui| {
        ui.add(Slider::new(&mut day, 1..=days).show_value(false)).labelled_by(name.id);
        ui.label(date_text);
    });
    let name = ui.label("Time");
    ui.horizontal(|ui| {
        let slider = Slider::new(&mut minutes, 0..=1435).step_by(5.0).show_value(false);
        let response = ui.add(slider).labelled_by(name.id);
        sun_marks(ui, scene, response.rect);
        ui.label(time.strftime("%H:%M").to_string());
    });
    if let Some(hours) = moment::sun_hours(scene) {
        let text = match (hours.rise, hours.set) {
            (Some(rise), Some(set)) => format!("Sun {}–{}", moment::clock(rise), moment::clock(set)),
            _ => "No sunrise or sunset".to_owned(),
        };
        // The bearing is on the dial above and in the sky's tile.
        let position = moment::sun(scene)
            .map_or_else(String::new, |(altitude, _)| format!(" · {:.0}° high", altitude.to_degrees()));
        ui.weak(format!("{text}{position}"));
    }
    if (day, minutes) != before {
        moment::step(scene, day - before.0, minutes - before.1);
    }
}

/// Sunrise and sunset as ticks under the time's slider.
fn sun_marks(ui: &Ui, scene: &SceneFile, rect: egui::Rect) {
    let Some(hours) = moment::sun_hours(scene) else { return };
    let colour = theme::palette(ui).sun;
    // The handle's radius is kept free at both ends of a slider.
    let margin = rect.height() / 2.5;
    for hour in [hours.rise, hours.set].into_iter().flatten() {
        let x = egui::lerp(rect.left() + margin..=rect.right() - margin, (hour / 24.0) as f32);
        ui.painter().vline(x, rect.bottom() - 4.0..=rect.bottom() + 2.0, Stroke::new(2.0, colour));
    }
}

fn sky(ui: &mut Ui, scene: &mut SceneFile, follows: &mut bool) {
    let sky = &mut scene.sky;
    let shown = sky.model.words()[0];
    let width = ui.available_width() - 8.0;
    let combo = ComboBox::from_id_salt("model").selected_text(shown).width(width).show_ui(ui, |ui| {
        for model in SkyModelKey::ALL {
            // Choosing the model that is there already must not reset its numbers.
            if ui.selectable_label(sky.model == model, model.words()[0]).clicked() && sky.model != model {
                choose_model(sky, model);
            }
        }
    });
    combo.response.accessible_name("Sky model");
    match sky.model {
        SkyModelKey::Cie => {
            // A scene without a type, or with one that no sky has, is refused; the list still needs an entry to show.
            let kind = usize::from(sky.cie_type.unwrap_or(16)).clamp(1, 16);
            let combo =
                ComboBox::from_id_salt("cie").selected_text(CIE[kind - 1]).width(width).truncate().show_ui(ui, |ui| {
                    for (i, word) in CIE.iter().enumerate() {
                        if ui.selectable_label(i + 1 == kind, *word).clicked() {
                            sky.cie_type = Some(i as u8 + 1);
                        }
                    }
                });
            combo.response.accessible_name("CIE sky type");
        }
        SkyModelKey::Perez => {
            optional(ui, "Direct horizontal", " W/m²", &mut sky.direct_horizontal_irradiance, 300.0, 0.0..=1100.0);
            optional(ui, "Diffuse horizontal", " W/m²", &mut sky.diffuse_horizontal_irradiance, 120.0, 0.0..=600.0);
        }
        SkyModelKey::Scan => {
            let mut path = sky.file.as_ref().map_or_else(String::new, |file| file.display().to_string());
            let name = ui.label("File of 145 luminances");
            let field = ui.add(egui::TextEdit::singleline(&mut path).desired_width(f32::INFINITY)).labelled_by(name.id);
            if field.changed() {
                sky.file = Some(path.into());
            }
        }
        _ => {}
    }
    // Perez's sky and a measured one bring their own illuminances.
    if sky.model.takes_illuminances() {
        ui.checkbox(follows, "Illuminances follow the sun")
            .on_hover_text("Typical values for the sun's altitude (IES RP-21, 1984); off: type your own");
        ui.add_enabled_ui(!*follows, |ui| {
            // Shown while they follow, so that what is computed with is never hidden.
            kilolux(ui, "Diffuse horizontal", &mut sky.diffuse_horizontal, 100.0);
            kilolux(ui, "Direct normal", &mut sky.sun.direct_normal, 130.0);
        });
    }
}

/// Keys that belong to one model alone are taken out with it.
fn choose_model(sky: &mut crate::study::scene_file::SkyKeys, model: SkyModelKey) {
    sky.model = model;
    sky.cie_type = (model == SkyModelKey::Cie).then_some(12);
    let perez = model == SkyModelKey::Perez;
    sky.direct_horizontal_irradiance = perez.then_some(300.0);
    sky.diffuse_horizontal_irradiance = perez.then_some(120.0);
    sky.file = None;
    match model {
        SkyModelKey::Perez => {
            sky.diffuse_horizontal = None;
            sky.sun.direct_normal = None;
        }
        SkyModelKey::Scan => sky.diffuse_horizontal = None,
        _ => {
            sky.diffuse_horizontal.get_or_insert(10_000.0);
        }
    }
}

fn kilolux(ui: &mut Ui, label: &str, value: &mut Option<f64>, most: f64) {
    let mut klx = value.unwrap_or(0.0) / 1000.0;
    let before = klx;
    number(ui, label, " klx", &mut klx, 0.0..=most, 2);
    if klx != before {
        *value = Some(klx * 1000.0);
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
