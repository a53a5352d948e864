//! Section of the obstructions: boxes with name, position and size in metres, and reflectance or luminance.

use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::panels::fields::{number, number_by, row};
use crate::app::scene::outside::{Act, Kind, ObstructionEffects, building, exact, name};
use crate::app::state::Shown;
use crate::compute::estimate::Estimate;
use crate::compute::surroundings::solid::Solid;
use crate::study::scene_file::{OutsideKeys, SceneFile, USUAL_REFLECTANCE};
use crate::texts::{Text, fixed, scene as texts};
use egui::{CollapsingHeader, Label, RichText, TextEdit, Ui};
use glam::DVec3;

/// Maximum coordinate and size of a box that can be typed. \[m\]
const FAR: f64 = 1000.0;
/// Minimum size of a box along each axis. \[m\]
const LEAST: f64 = 0.01;
/// Change of a coordinate or size per point of a drag. \[m/point\]
const SPEED: f64 = 0.05;
/// Luminance that a box gets when the user changes it from a reflectance to a luminance. \[cd/m²\]
const FIRST_LUMINANCE: f64 = 1000.0;

/// Maximum length of the names of obstructions in the summary of the folded section. \[characters\]
const LONGEST: usize = 26;

/// Returns the summary of the obstructions, shown when the section is folded.
pub fn essence(scene: &SceneFile) -> String {
    let boxes: Vec<String> = scene.outside.iter().enumerate().map(|(number, keys)| name(number, keys)).collect();
    let count = boxes.len();
    let building = || scene.building.iter().map(|_| String::from(texts::BUILDING_SHORT));
    let words = boxes.into_iter().chain(building()).collect::<Vec<_>>().join(", ");
    match words.chars().count() {
        0 => texts::NONE.into(),
        length if length > LONGEST && count > 0 => {
            std::iter::once(texts::boxes_outside(count)).chain(building()).collect::<Vec<_>>().join(", ")
        }
        _ => words,
    }
}

/// Returns a message on the first box that reaches into the room, else on the first that does not rise above the
/// ground, with the valid values; `None` without one.
pub fn problem(scene: &SceneFile) -> Option<String> {
    let size = [scene.room.width, scene.room.depth, scene.room.height];
    let room = Solid::new(DVec3::ZERO, DVec3::from_array(size), 0.0);
    let inside = scene.outside.iter().enumerate().find_map(|(number, keys)| {
        let [from, to] = [keys.solid.from, keys.solid.to].map(DVec3::from_array);
        let within = Solid::new(from, to, keys.solid.turn.to_radians()).overlaps(&room, 1e-6);
        let [width, depth, height] = size.map(|length| fixed(length, 2));
        within.then(|| texts::into_room(name(number, keys), width, depth, height))
    });
    let ground = scene.site.ground_height;
    let below = |(number, keys): (usize, &OutsideKeys)| {
        (keys.solid.to[2] <= ground).then(|| texts::below_ground(name(number, keys), fixed(ground, 2)))
    };
    inside.or_else(|| scene.outside.iter().enumerate().find_map(below))
}

/// Returns the effect of each obstruction as text: the relative change \[%\] of the apertures' illuminance if the
/// obstruction were not there, with its error.
fn words(effects: &[Estimate]) -> Vec<String> {
    let words = |effect: &Estimate| {
        let sign = if effect.value > 0.0 { "+" } else { "" };
        texts::without_it(format!("{sign}{}", fixed(100.0 * effect.value, 1)), fixed(100.0 * effect.error, 1))
    };
    effects.iter().map(words).collect()
}

/// Draws the section of the obstructions.
pub fn show(ui: &mut Ui, scene: &mut SceneFile, effects: &Shown<ObstructionEffects>, commands: &mut Vec<Command>) {
    let mut effect = Vec::new();
    if !scene.outside.is_empty() || scene.building.is_some() {
        if ui.button(texts::EFFECTS).on_hover_text(texts::EFFECTS_TIP).clicked() {
            commands.push(Command::WeighObstructions);
        }
        let error = |ui: &mut Ui, text: &str| {
            ui.add(Label::new(RichText::new(text).color(theme::palette(ui).error)).wrap());
        };
        if let Some(text) = &effects.error {
            error(ui, text);
        }
        match effects.value.as_deref().filter(|(of, _)| of == scene) {
            Some((_, Ok(Some(found)))) => effect = words(found),
            Some((_, Ok(None))) => _ = ui.weak(texts::EFFECTS_DARK),
            Some((_, Err(text))) => error(ui, text),
            None => {}
        }
    }
    let show_effect = |ui: &mut Ui, number: usize| {
        if let Some(words) = effect.get(number) {
            ui.weak(words);
        }
    };
    let boxes = scene.outside.len();
    for (number, keys) in scene.outside.iter_mut().enumerate() {
        let name = name(number, keys);
        CollapsingHeader::new(&name).id_salt(number).show(ui, |ui| {
            one(ui, keys);
            ui.horizontal(|ui| {
                let copy = ui.button(texts::DUPLICATE).accessible_name(texts::duplicate_box(&name));
                if copy.on_hover_text(texts::DUPLICATE_TIP).clicked() {
                    commands.push(Command::Outside(Act::Duplicate(Some(number))));
                }
                let remove = ui.button(texts::REMOVE).accessible_name(texts::remove_box(&name));
                if remove.on_hover_text(texts::REMOVE_TIP).clicked() {
                    commands.push(Command::Outside(Act::Remove(Some(number))));
                }
            });
        });
        show_effect(ui, number);
    }
    let add = ui.menu_button(texts::ADD_OUTSIDE, |ui| {
        for kind in Kind::ALL {
            if ui.button(kind.word()).clicked() {
                commands.push(Command::Outside(Act::Add(kind)));
                ui.close();
            }
        }
    });
    add.response.on_hover_text(texts::ADD_OUTSIDE_TIP);
    let mut named = scene.building.is_some();
    if ui.checkbox(&mut named, texts::BUILDING).on_hover_text(texts::BUILDING_TIP).changed() {
        scene.building = named.then(|| building(scene));
    }
    if let Some(building) = &mut scene.building {
        let ([left, _, low], [right, back, high]) = (&mut building.from, &mut building.to);
        let sides = [
            (texts::BOX_LEFT, left),
            (texts::TO_X, right),
            (texts::TO_Y, back),
            (texts::BOX_UP, low),
            (texts::TO_Z, high),
        ];
        for (label, side) in sides {
            number_by(ui, (label.get(), " m"), side, -FAR..=FAR, 2, SPEED);
        }
        number(ui, texts::REFLECTANCE, "", &mut building.reflectance, 0.0..=1.0, 2);
        show_effect(ui, boxes);
    }
}

/// Draws an input field for the size of a box along an axis, from its coordinate `low` to `high` \[m\]. A change moves
/// `high`, or `low` if `keeps_high`.
fn length(ui: &mut Ui, label: Text, low: &mut f64, high: &mut f64, keeps_high: bool) {
    let mut size = *high - *low;
    if number_by(ui, (label.get(), " m"), &mut size, LEAST..=FAR, 2, SPEED) {
        if keeps_high {
            *low = exact(*high - size);
        } else {
            *high = exact(*low + size);
        }
    }
}

/// Draws the fields of one box: name, position, size, rotation, and reflectance or luminance.
fn one(ui: &mut Ui, keys: &mut OutsideKeys) {
    let called = row(ui, texts::BOX_NAME.get(), |ui| ui.add(TextEdit::singleline(&mut keys.name).desired_width(130.0)));
    called.on_hover_text(texts::BOX_NAME_TIP);
    let solid = &mut keys.solid;
    for (axis, label) in [(0, texts::BOX_LEFT), (2, texts::BOX_UP)] {
        let mut from = solid.from[axis];
        if number_by(ui, (label.get(), " m"), &mut from, -FAR..=FAR, 2, SPEED) {
            solid.to[axis] = exact(solid.to[axis] + from - solid.from[axis]);
            solid.from[axis] = from;
        }
    }
    // 0 as it is typed: there is no −0 m.
    let mut gap = 0.0 - solid.to[1];
    if number_by(ui, (texts::BOX_GAP.get(), " m"), &mut gap, -FAR..=FAR, 2, SPEED) {
        solid.from[1] = exact(solid.from[1] - gap - solid.to[1]);
        solid.to[1] = 0.0 - gap;
    }
    let ([x, y, z], [to_x, to_y, to_z]) = (&mut solid.from, &mut solid.to);
    length(ui, texts::WIDTH, x, to_x, false);
    // A deeper overhang reaches farther out.
    length(ui, texts::BOX_DEPTH, y, to_y, true);
    length(ui, texts::HEIGHT, z, to_z, false);
    number(ui, texts::BOX_TURN, "°", &mut solid.turn, -360.0..=360.0, 1);
    let mut stated = keys.luminance.is_some();
    let choice = ui.checkbox(&mut stated, texts::SELF_LUMINOUS).on_hover_text(texts::SELF_LUMINOUS_TIP);
    if choice.changed() {
        (keys.luminance, keys.reflectance) =
            if stated { (Some(FIRST_LUMINANCE), None) } else { (None, Some(USUAL_REFLECTANCE)) };
    }
    if let Some(luminance) = &mut keys.luminance {
        number(ui, texts::LUMINANCE, " cd/m²", luminance, 0.0..=20_000.0, 0);
    } else {
        let mut reflectance = keys.reflectance.unwrap_or(USUAL_REFLECTANCE);
        if number(ui, texts::REFLECTANCE, "", &mut reflectance, 0.0..=1.0, 2) {
            keys.reflectance = Some(reflectance);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::outside::act;
    use crate::study::example::first_scene;

    #[test]
    fn what_stands_outside_is_named_and_what_reaches_in_is_told() {
        let mut scene = first_scene();
        assert_eq!((essence(&scene).as_str(), problem(&scene)), ("none", None));
        act(&mut scene, Act::Add(Kind::Overhang)).unwrap();
        scene.outside.push(OutsideKeys { name: String::new(), ..scene.outside[0].clone() });
        assert_eq!((essence(&scene).as_str(), problem(&scene)), ("Overhang, Box 2", None));
        scene.outside[1].solid.to[1] = 0.3;
        assert!(problem(&scene).is_some_and(|said| said.starts_with("Box 2 extends into the room")));
        scene.outside.truncate(1);
        act(&mut scene, Act::Add(Kind::Balcony)).unwrap();
        let said = problem(&scene).unwrap();
        assert!(said.starts_with("Balcony is below the ground at 0.00 m"), "{said}");
        scene.site.ground_height = -3.0;
        assert_eq!(problem(&scene), None);
    }
}
