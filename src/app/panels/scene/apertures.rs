//! The apertures of the scene: position, size, and back reflectance.

use crate::app::panels::fields::{note, number};
use crate::study::scene_file::{ApertureKeys, ApertureReflectance, RoomKeys, SceneFile, SurfaceKey};
use crate::texts::{Text, fixed, scene as texts};
use egui::{Button, Ui};

/// Minimum width and height of an aperture. \[m\]
const LEAST: f64 = 0.05;

/// Returns the size \[m\] of a surface of the room, façade or roof, along the two axes of an aperture in it.
fn extent(room: &RoomKeys, surface: SurfaceKey) -> [f64; 2] {
    match surface {
        SurfaceKey::Facade => [room.width, room.height],
        SurfaceKey::Roof => [room.width, room.depth],
    }
}

/// Labels of the fields of an aperture's size.
const SIZES: [Text; 2] = [texts::WIDTH, texts::HEIGHT];

/// Returns the position \[m\] to which the lower edge of an aperture has to move so that its size \[m\] fits into the
/// extent \[m\] of the surface; `None` if it need not move.
fn pushed(origin: f64, size: f64, extent: f64) -> Option<f64> {
    // To the millimetre, so that what is shown is what is meant.
    let most = ((extent - size) * 1000.0).floor() / 1000.0;
    (origin > extent - size + 1e-9).then_some(most.max(0.0))
}

const fn word(surface: SurfaceKey) -> Text {
    match surface {
        SurfaceKey::Facade => texts::ON_FACADE,
        SurfaceKey::Roof => texts::ON_ROOF,
    }
}

fn overlap(a: &ApertureKeys, b: &ApertureKeys) -> bool {
    let axis = |k: usize| {
        let (low, high) = (a.origin[k].max(b.origin[k]), (a.origin[k] + a.size[k]).min(b.origin[k] + b.size[k]));
        high - low > 1e-6
    };
    a.surface == b.surface && axis(0) && axis(1)
}

/// Returns a message on the first aperture that extends beyond its surface of the room, with the size of that surface;
/// `None` if there is none.
pub fn beyond(scene: &SceneFile) -> Option<String> {
    scene.aperture.iter().enumerate().find_map(|(i, a)| {
        let extent = extent(&scene.room, a.surface);
        (0..2).any(|k| a.origin[k] < 0.0 || a.origin[k] + a.size[k] > extent[k] + 1e-6).then(|| {
            let [width, height] = extent.map(|length| fixed(length, 2));
            match a.surface {
                SurfaceKey::Facade => texts::beyond_facade(i + 1, width, height),
                SurfaceKey::Roof => texts::beyond_roof(i + 1, width, height),
            }
        })
    })
}

/// Returns a message on the first aperture that extends beyond its surface, or the first two that overlap; `None` if
/// there are none.
pub fn problem(scene: &SceneFile) -> Option<String> {
    if let Some(text) = beyond(scene) {
        return Some(text);
    }
    for (i, a) in scene.aperture.iter().enumerate() {
        if let Some(j) = scene.aperture.iter().skip(i + 1).position(|b| overlap(a, b)) {
            return Some(texts::overlap(i + 1, i + j + 2));
        }
    }
    None
}

/// Returns a new aperture with the system of the last one at the first free position in façade or roof, 1 m × 1 m or
/// less if the surface is smaller; `None` if there is no space.
fn addition(scene: &SceneFile) -> Option<ApertureKeys> {
    let last = scene.aperture.last()?;
    for surface in [SurfaceKey::Facade, SurfaceKey::Roof] {
        let extent = extent(&scene.room, surface);
        let size = extent.map(|length| length.min(1.0));
        let steps = |k: usize| ((extent[k] - size[k]) / 0.1 + 1e-6) as u32;
        for j in 0..=steps(1) {
            for i in 0..=steps(0) {
                let origin = [0.1 * f64::from(i), 0.1 * f64::from(j)];
                let new = ApertureKeys { surface, origin, size, ..last.clone() };
                if scene.aperture.iter().all(|old| !overlap(old, &new)) {
                    return Some(new);
                }
            }
        }
    }
    None
}

/// Draws the section of the apertures.
pub fn show(ui: &mut Ui, scene: &mut SceneFile) {
    let room = scene.room;
    let several = scene.aperture.len() > 1;
    let mut gone = None;
    for (index, aperture) in scene.aperture.iter_mut().enumerate() {
        ui.push_id(index, |ui| {
            let mut moved = false;
            ui.horizontal(|ui| {
                ui.label(texts::aperture_number(index + 1));
                for surface in [SurfaceKey::Facade, SurfaceKey::Roof] {
                    if ui.selectable_label(aperture.surface == surface, word(surface).get()).clicked() {
                        moved = move_to(aperture, surface, &room);
                    }
                }
                let remove = several.then(|| ui.small_button("×").accessible_name(texts::remove_aperture(index + 1)));
                if remove.is_some_and(|button| button.on_hover_text(texts::REMOVE_APERTURE).clicked()) {
                    gone = Some(index);
                }
            });
            if moved {
                note(ui, SIZES[1], texts::MADE_SMALLER.into());
            }
            one(ui, aperture, &room);
        });
    }
    if let Some(index) = gone {
        scene.aperture.remove(index);
    }
    let next = addition(scene);
    let add = ui.add_enabled(next.is_some(), Button::new(texts::ADD_APERTURE));
    if add.on_disabled_hover_text(texts::NO_FREE_PLACE).clicked() {
        scene.aperture.extend(next);
    }
}

/// Moves an aperture to another surface, and inside the edges of that surface. Returns `true` if it had to be made
/// smaller.
fn move_to(aperture: &mut ApertureKeys, surface: SurfaceKey, room: &RoomKeys) -> bool {
    aperture.surface = surface;
    let extent = extent(room, surface);
    let before = aperture.size;
    for ((size, origin), extent) in aperture.size.iter_mut().zip(&mut aperture.origin).zip(extent) {
        *size = size.min(extent);
        *origin = origin.min(extent - *size);
    }
    aperture.size != before
}

/// Draws the fields of one aperture: position, size, frame share, dirt factor and back reflectance.
fn one(ui: &mut Ui, aperture: &mut ApertureKeys, room: &RoomKeys) {
    let low = match aperture.surface {
        SurfaceKey::Facade => texts::SILL,
        SurfaceKey::Roof => texts::FROM_FACADE,
    };
    let extent = extent(room, aperture.surface);
    let origins = [texts::FROM_LEFT, low];
    for (k, label) in origins.into_iter().enumerate() {
        let most = (extent[k] - aperture.size[k]).max(0.0);
        number(ui, label, " m", &mut aperture.origin[k], 0.0..=most, 2);
    }
    for (k, label) in SIZES.into_iter().enumerate() {
        if number(ui, label, " m", &mut aperture.size[k], LEAST..=extent[k].max(LEAST), 2)
            && let Some(origin) = pushed(aperture.origin[k], aperture.size[k], extent[k])
        {
            aperture.origin[k] = origin;
            note(ui, label, texts::pushed(origins[k], fixed(origin, 2)));
        }
    }
    number(ui, texts::FRAME_SHARE, "", &mut aperture.frame, 0.0..=0.95, 2);
    number(ui, texts::DIRT, "", &mut aperture.dirt, 0.0..=1.0, 2);
    let mut own = aperture.reflectance == ApertureReflectance::Dataset;
    let tip = texts::AS_IN_DATASET_TIP;
    if ui.checkbox(&mut own, texts::AS_IN_DATASET).on_hover_text(tip).changed() {
        aperture.reflectance = if own { ApertureReflectance::Dataset } else { ApertureReflectance::Value(0.1) };
    }
    if let ApertureReflectance::Value(value) = &mut aperture.reflectance {
        number(ui, texts::ROOM_SIDE, "", value, 0.0..=0.99, 2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::first_scene;

    #[test]
    fn additions_find_free_places_until_there_are_none() {
        let mut scene = first_scene();
        assert_eq!(problem(&scene), None);
        let mut count = 0;
        while let Some(next) = addition(&scene) {
            scene.aperture.push(next);
            assert_eq!(problem(&scene), None);
            count += 1;
        }
        // The roof alone, 4 m × 6 m, takes 24 square metres.
        assert!(count >= 24, "{count}");
    }

    #[test]
    fn a_size_pushes_the_edge_only_where_it_must() {
        assert_eq!(pushed(1.2, 2.5, 3.0), Some(0.5));
        assert_eq!(pushed(0.9, 2.1, 3.0), None);
        assert_eq!(pushed(0.9, 3.0, 3.0), Some(0.0));
        assert_eq!(pushed(0.0, 3.0, 3.0), None);
    }

    #[test]
    fn overlap_and_overhang_are_told() {
        let mut scene = first_scene();
        scene.aperture.push(scene.aperture[0].clone());
        assert!(problem(&scene).is_some_and(|text| text.contains("1 and 2 overlap")));
        scene.aperture[1].surface = SurfaceKey::Roof;
        assert_eq!(problem(&scene), None);
        scene.room.width = 3.0;
        assert!(problem(&scene).is_some_and(|text| text.contains("beyond the façade")));
    }
}
