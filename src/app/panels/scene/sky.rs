//! The sky: its model, and where its illuminances come from. They are shown whoever gives them.

use crate::app::moment;
use crate::app::panels::fields::{figure, lines, number, optional};
use crate::app::scene::follow;
use crate::app::theme;
use crate::compute::sky::availability::Cover;
use crate::study::scene_file::{IlluminanceKey, LightKey, OffsetKey, SceneFile, SkyKeys, SkyModelKey};
use crate::study::sky::{CLEANEST, HAZIEST, Illuminances, Source, TWILIGHT, illuminances};
use egui::{ComboBox, TextEdit, Ui};

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

/// What an entry of the list is called, and what it means.
const fn words(by: IlluminanceKey) -> (&'static str, &'static str) {
    match by {
        IlluminanceKey::ClearSky => (
            "Follow the sun, clear sky by turbidity",
            "Clear skies by turbidity and elevation (Ineichen and Perez 2002), others typical ones (IES RP-21, 1984)",
        ),
        IlluminanceKey::Rp21 => {
            ("Follow the sun, IES RP-21", "Typical values of clear, partly cloudy or overcast skies (IES RP-21, 1984)")
        }
        IlluminanceKey::Stated => ("Typed", "The figures below, wherever the sun is"),
    }
}

/// Why the figures of a sky cannot be with a sun that stands as low as it does; `None` where they can.
pub fn low_sun(scene: &SceneFile) -> Option<&'static str> {
    let (altitude, _) = moment::sun(scene)?;
    let sky = &scene.sky;
    match sky.model {
        SkyModelKey::Cie if sky.illuminance == IlluminanceKey::Stated => (altitude < TWILIGHT
            && sky.diffuse_horizontal.is_some_and(|lux| lux > 0.0))
        .then_some("No such sky with the sun below −6°: type 0 klx, or follow the sun."),
        SkyModelKey::Perez => {
            let [direct, diffuse] =
                [sky.direct_horizontal_irradiance, sky.diffuse_horizontal_irradiance].map(|value| value.unwrap_or(0.0));
            if direct + diffuse == 0.0 {
                None
            } else if altitude <= 0.0 {
                Some("The sun is below the horizon: both have to be 0 W/m² then.")
            } else if direct / altitude.sin() > 1500.0 {
                Some("So low a sun cannot send as much direct light: type less.")
            } else {
                None
            }
        }
        _ => None,
    }
}

/// Draws the section. `low_sun`: what [`low_sun`] says.
pub fn show(ui: &mut Ui, scene: &mut SceneFile, low_sun: Option<&str>) {
    let width = ui.available_width() - 8.0;
    model(ui, &mut scene.sky, width);
    let palette = theme::palette(ui);
    if !scene.sky.model.takes_illuminances() {
        if scene.sky.model == SkyModelKey::Perez {
            lines(ui, low_sun.unwrap_or_default(), palette.error, 2);
        }
        return;
    }
    let before = scene.sky.illuminance;
    let mut by = before;
    let name = ui.label("Illuminances");
    let combo = ComboBox::from_id_salt("illuminance").selected_text(words(by).0).width(width).truncate();
    let combo = combo.show_ui(ui, |ui| {
        for key in IlluminanceKey::ALL {
            let (text, tip) = words(key);
            ui.selectable_value(&mut by, key, text).on_hover_text(tip);
        }
    });
    combo.response.labelled_by(name.id).on_hover_text(words(before).1);
    if by != before {
        follow(scene, by);
    }
    if by == IlluminanceKey::ClearSky && clear(&scene.sky) {
        number(ui, "Turbidity (Linke)", "", &mut scene.sky.turbidity, CLEANEST..=HAZIEST, 1);
    }
    let light = illuminances(&scene.sky, &scene.site).ok().flatten();
    if by == IlluminanceKey::Stated {
        kilolux(ui, "Diffuse horizontal", &mut scene.sky.diffuse_horizontal, 100.0);
        kilolux(ui, "Direct normal", &mut scene.sky.sun.direct_normal, 130.0);
    } else {
        let klx = |lux: Option<f64>| lux.map_or_else(|| "–".to_owned(), |lux| format!("{:.2} klx", lux / 1000.0));
        figure(ui, "Diffuse horizontal", &klx(light.map(|light| light.diffuse_horizontal)));
        figure(ui, "Direct normal", &klx(light.map(|light| light.direct_normal)));
    }
    match low_sun {
        Some(told) => lines(ui, told, palette.error, 2),
        None => lines(ui, &light.map_or_else(String::new, |light| origin(&light)), palette.weak, 2),
    }
}

/// Is it a sky whose illuminances turbidity changes?
fn clear(sky: &SkyKeys) -> bool {
    sky.model == SkyModelKey::Cie && Cover::of_cie_type(sky.cie_type.unwrap_or(16)) == Cover::Clear
}

/// Where the figures come from, in words.
fn origin(light: &Illuminances) -> String {
    if light.is_night() {
        return "No daylight: the sun is below the horizon.".to_owned();
    }
    match light.source {
        Source::Stated if light.altitude.is_some_and(|altitude| altitude <= 0.0) => {
            "As typed; no direct light while the sun is below the horizon.".to_owned()
        }
        Source::Stated => "They stay as typed, wherever the sun is.".to_owned(),
        Source::ClearSky { elevation, .. } => format!("Clear sky at {elevation:.0} m (Ineichen, Perez 2002)"),
        Source::Cover(cover) => format!("Typical of a sky that is {} (IES RP-21)", cover.word()),
    }
}

fn model(ui: &mut Ui, sky: &mut SkyKeys, width: f32) {
    let shown = sky.model.words()[0];
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
            let field = ui.add(TextEdit::singleline(&mut path).desired_width(f32::INFINITY)).labelled_by(name.id);
            if field.changed() {
                sky.file = Some(path.into());
            }
        }
        SkyModelKey::Uniform => {}
        SkyModelKey::Weather => {
            let file = sky.weather.as_ref().map_or_else(String::new, |file| file.display().to_string());
            ui.label(format!("{file}, at the date and time above"));
        }
    }
}

/// Keys that belong to one model alone are taken out with it.
fn choose_model(sky: &mut SkyKeys, model: SkyModelKey) {
    sky.model = model;
    sky.cie_type = (model == SkyModelKey::Cie).then_some(12);
    let perez = model == SkyModelKey::Perez;
    sky.direct_horizontal_irradiance = perez.then_some(300.0);
    sky.diffuse_horizontal_irradiance = perez.then_some(120.0);
    sky.file = None;
    sky.weather = None;
    sky.light = LightKey::default();
    sky.sun_offset_minutes = OffsetKey::default();
    match model {
        SkyModelKey::Perez => {
            sky.diffuse_horizontal = None;
            sky.sun.direct_normal = None;
        }
        SkyModelKey::Scan => sky.diffuse_horizontal = None,
        // What follows the sun needs no figures.
        _ if sky.illuminance == IlluminanceKey::Stated => {
            sky.diffuse_horizontal.get_or_insert(10_000.0);
        }
        _ => {}
    }
}

fn kilolux(ui: &mut Ui, label: &str, value: &mut Option<f64>, most: f64) {
    let mut klx = value.unwrap_or(0.0) / 1000.0;
    if number(ui, label, " klx", &mut klx, 0.0..=most, 2) {
        *value = Some(klx * 1000.0);
    }
}
