//! Section of the sky: its luminance model, and the source of its illuminances (diffuse horizontal, direct normal),
//! which are shown whatever their source.

use crate::app::display::theme;
use crate::app::panels::fields::{figure, lines, number, optional};
use crate::app::scene::follow;
use crate::app::scene::moment;
use crate::app::shell::typed_path::typed_path;
use crate::compute::sky::availability::Cover;
use crate::study::scene_file::{IlluminanceKey, SceneFile, SkyKeys, SkyModelKey, USUAL_IRRADIANCES};
use crate::study::sky::{CLEANEST, HAZIEST, Illuminances, Source, TWILIGHT, illuminances};
use crate::texts::{Text, fixed, scene as texts};
use egui::{ComboBox, TextEdit, Ui};

/// Names of the CIE general sky types 1 … 15 in the order of ISO 15469, table 1, and of type 16, the traditional
/// overcast sky.
const CIE: [Text; 16] = [
    texts::CIE_1,
    texts::CIE_2,
    texts::CIE_3,
    texts::CIE_4,
    texts::CIE_5,
    texts::CIE_6,
    texts::CIE_7,
    texts::CIE_8,
    texts::CIE_9,
    texts::CIE_10,
    texts::CIE_11,
    texts::CIE_12,
    texts::CIE_13,
    texts::CIE_14,
    texts::CIE_15,
    texts::CIE_16,
];

/// Returns label and tooltip for a source of the sky's illuminances.
const fn words(by: IlluminanceKey) -> (Text, Text) {
    match by {
        IlluminanceKey::ClearSky => (texts::FOLLOW_TURBIDITY, texts::FOLLOW_TURBIDITY_TIP),
        IlluminanceKey::Rp21 => (texts::FOLLOW_RP21, texts::FOLLOW_RP21_TIP),
        IlluminanceKey::Stated => (texts::TYPED, texts::TYPED_TIP),
    }
}

/// Returns the reason why the illuminance or irradiances given for a sky are impossible at the sun's altitude, which is
/// low or negative; `None` if they are possible.
pub fn low_sun(scene: &SceneFile) -> Option<Text> {
    // Weather brings its own sun: what is typed here has none.
    let (altitude, _) = moment::sun_of_site(scene).filter(|_| scene.sky.weather.is_none())?;
    let sky = &scene.sky;
    match sky.model {
        SkyModelKey::Cie if sky.illuminance == IlluminanceKey::Stated => {
            (altitude < TWILIGHT && sky.diffuse_horizontal.is_some_and(|lux| lux > 0.0)).then_some(texts::TWILIGHT)
        }
        SkyModelKey::Perez => {
            let [direct, diffuse] =
                [sky.direct_horizontal_irradiance, sky.diffuse_horizontal_irradiance].map(|value| value.unwrap_or(0.0));
            if direct + diffuse == 0.0 {
                None
            } else if altitude <= 0.0 {
                Some(texts::BOTH_ZERO)
            } else if direct / altitude.sin() > 1500.0 {
                Some(texts::TOO_MUCH_DIRECT)
            } else {
                None
            }
        }
        _ => None,
    }
}

/// Draws the section of the sky. `low_sun`: result of the function [`low_sun`].
pub fn show(ui: &mut Ui, scene: &mut SceneFile, low_sun: Option<Text>) {
    let width = ui.available_width() - 8.0;
    model(ui, &mut scene.sky, width);
    let palette = theme::palette(ui);
    if !scene.sky.model.takes_illuminances() {
        if scene.sky.model == SkyModelKey::Perez {
            lines(ui, low_sun.map_or("", Text::get), palette.error, 2);
        }
        return;
    }
    let before = scene.sky.illuminance;
    let mut by = before;
    let name = ui.label(texts::ILLUMINANCES);
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
        number(ui, texts::TURBIDITY, "", &mut scene.sky.turbidity, CLEANEST..=HAZIEST, 1);
    }
    let light = illuminances(&scene.sky, &scene.site).ok().flatten();
    if by == IlluminanceKey::Stated {
        kilolux(ui, texts::DIFFUSE_HORIZONTAL, &mut scene.sky.diffuse_horizontal, 100.0);
        kilolux(ui, texts::DIRECT_NORMAL, &mut scene.sky.sun.direct_normal, 130.0);
    } else {
        let klx =
            |lux: Option<f64>| lux.map_or_else(|| "–".to_owned(), |lux| format!("{} klx", fixed(lux / 1000.0, 2)));
        figure(ui, texts::DIFFUSE_HORIZONTAL, &klx(light.map(|light| light.diffuse_horizontal)));
        figure(ui, texts::DIRECT_NORMAL, &klx(light.map(|light| light.direct_normal)));
    }
    match low_sun {
        Some(message) => lines(ui, message.get(), palette.error, 2),
        None => lines(ui, &light.map_or_else(String::new, |light| origin(&light)), palette.weak, 2),
    }
}

/// Whether the sky is of a clear CIE type, whose illuminances depend on turbidity.
fn clear(sky: &SkyKeys) -> bool {
    sky.model == SkyModelKey::Cie && Cover::of_cie_type(sky.cie_type.unwrap_or(16)) == Cover::Clear
}

/// Returns a sentence on the source of the sky's illuminances: typed, clear-sky model, typical values, or night.
fn origin(light: &Illuminances) -> String {
    if light.is_night() {
        return texts::NIGHT.into();
    }
    match light.source {
        Source::Stated if light.altitude.is_some_and(|altitude| altitude <= 0.0) => texts::TYPED_NIGHT.into(),
        Source::Stated => texts::TYPED_STAYS.into(),
        Source::ClearSky { elevation, .. } => texts::clear_sky_at(fixed(elevation, 0)),
        Source::Cover(Cover::Clear) => texts::TYPICAL_CLEAR.into(),
        Source::Cover(Cover::Partly) => texts::TYPICAL_PARTLY.into(),
        Source::Cover(Cover::Overcast) => texts::TYPICAL_OVERCAST.into(),
    }
}

/// Draws the choice of the sky model, and the fields of its parameters.
fn model(ui: &mut Ui, sky: &mut SkyKeys, width: f32) {
    let combo = ComboBox::from_id_salt("model").selected_text(sky.model.words()[0]).width(width).show_ui(ui, |ui| {
        for model in SkyModelKey::ALL {
            // Choosing the model that is there already must not reset its numbers.
            if ui.selectable_label(sky.model == model, model.words()[0]).clicked() && sky.model != model {
                sky.choose(model);
            }
        }
    });
    combo.response.accessible_name(texts::SKY_MODEL.get());
    match sky.model {
        SkyModelKey::Cie => {
            // A scene without a type, or with one that no sky has, is refused; the list still needs an entry to show.
            let kind = usize::from(sky.cie_type.unwrap_or(16)).clamp(1, 16);
            let combo =
                ComboBox::from_id_salt("cie").selected_text(CIE[kind - 1]).width(width).truncate().show_ui(ui, |ui| {
                    for (i, word) in CIE.iter().enumerate() {
                        if ui.selectable_label(i + 1 == kind, word.get()).clicked() {
                            sky.cie_type = Some(i as u8 + 1);
                        }
                    }
                });
            combo.response.accessible_name(texts::CIE_TYPE.get());
        }
        SkyModelKey::Perez => {
            let [direct, diffuse] = USUAL_IRRADIANCES;
            let (of_sun, of_sky) = (&mut sky.direct_horizontal_irradiance, &mut sky.diffuse_horizontal_irradiance);
            optional(ui, texts::DIRECT_HORIZONTAL, " W/m²", of_sun, direct, 0.0..=1100.0);
            optional(ui, texts::DIFFUSE_HORIZONTAL, " W/m²", of_sky, diffuse, 0.0..=600.0);
        }
        SkyModelKey::Scan => {
            let mut path = sky.file.as_ref().map_or_else(String::new, |file| file.display().to_string());
            let name = ui.label(texts::SCAN_FILE);
            let field = ui.add(TextEdit::singleline(&mut path).desired_width(f32::INFINITY)).labelled_by(name.id);
            if field.changed() {
                sky.file = Some(typed_path(&path));
            }
        }
        SkyModelKey::Uniform => {}
        SkyModelKey::Weather => {
            let file = sky.weather.as_ref().map_or_else(String::new, |file| file.display().to_string());
            ui.label(texts::weather_at(file));
        }
    }
}

fn kilolux(ui: &mut Ui, label: Text, value: &mut Option<f64>, most: f64) {
    let mut klx = value.unwrap_or(0.0) / 1000.0;
    if number(ui, label, " klx", &mut klx, 0.0..=most, 2) {
        *value = Some(klx * 1000.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::Dir;
    use crate::compute::sky::{Distribution, Outside, cie};
    use crate::texts::{Language, speak};

    #[test]
    fn names_of_cie_types_say_how_luminance_varies() {
        let toward = |altitude: f64| Dir::from_altitude_bearing(altitude.to_radians(), Bearing::from_degrees(180.0));
        for (language, words) in [
            (Language::English, ["uniform", "steep", "moderate", "no gradation"]),
            (Language::German, ["gleichförmig", "steil", "mäßig", "ohne Abstufung"]),
        ] {
            let _spoken = speak(language);
            for (name, sky_type) in CIE.iter().zip(1_u8..=15) {
                let sky = Outside::new(Distribution::cie(sky_type, toward(45.0)).unwrap(), 10_000.0).unwrap();
                // Both 45° from the sun: what is left is the gradation between zenith and horizon.
                let gradation = sky.luminance(toward(90.0)) / sky.luminance(toward(1e-6));
                let is = [
                    !cie::needs_sun(sky_type),
                    gradation > 2.0,
                    (1.2..2.0).contains(&gradation),
                    (gradation - 1.0).abs() < 1e-3 && cie::needs_sun(sky_type),
                ];
                assert_eq!(words.map(|word| name.get().contains(word)), is, "{}: {gradation}", name.get());
            }
        }
    }
}
