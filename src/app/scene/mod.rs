//! Scene of the window: the first one, its systems and control rules, the selection, its moment, its obstructions.

pub mod control;
pub mod facing;
pub mod first_choice;
pub mod incidence;
pub mod moment;
pub mod outside;
pub mod room_look;
pub mod selection;

use crate::study::control::year::CONTROLLED;
pub use crate::study::example::first_scene;
use crate::study::scene_file::{ControlKeys, IlluminanceKey, SceneFile, SystemKeys};
use crate::study::sky::illuminances;

/// Product and state that are selected in the window.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Selection {
    /// Key of the selected product in the catalogue.
    pub product: String,
    /// Key of the selected state; empty for the representative state; `controlled` if the control rule of the scene
    /// chooses it.
    pub state: String,
}

/// Returns the scene stored by the last session, given as its text; `None` if the text is not a scene.
///
/// Program versions without the key `sky.illuminance` computed the illuminances from the sun's position in every
/// session, whatever the scene said; later versions always write the key. A scene without it is therefore from such a
/// version, and its illuminances are still computed from the sun's position, if this is known.
pub fn kept_scene(text: &str) -> Option<SceneFile> {
    let mut scene = SceneFile::parse(text).ok()?;
    let table: toml::Table = text.parse().ok()?;
    let says = table.get("sky").and_then(|sky| sky.get("illuminance")).is_some();
    if !says && moment::sun_of_site(&scene).is_some() {
        follow(&mut scene, IlluminanceKey::ClearSky);
    }
    Some(scene)
}

/// Sets the source of the sky's illuminances: computed from the position of the sun, or stated, starting from their
/// current values.
pub fn follow(scene: &mut SceneFile, by: IlluminanceKey) {
    let now = illuminances(&scene.sky, &scene.site).ok().flatten();
    let sky = &mut scene.sky;
    if by == IlluminanceKey::Stated {
        sky.diffuse_horizontal = Some(now.map_or(10_000.0, |light| light.diffuse_horizontal.round()));
        sky.sun.direct_normal = Some(now.map_or(0.0, |light| light.direct_normal.round()));
    } else if sky.model.takes_illuminances() {
        // They would not be read, and a file should not hold figures that are not so.
        sky.diffuse_horizontal = None;
        sky.sun.direct_normal = None;
    }
    sky.illuminance = by;
}

/// Returns product and state of the first aperture of a scene with a product of the catalogue; `None` if there is none.
pub fn selection_of(scene: &SceneFile) -> Option<Selection> {
    scene.aperture.iter().find_map(|aperture| match &aperture.system {
        SystemKeys::Catalogue { key, state } if !key.is_empty() => {
            Some(Selection { product: key.clone(), state: state.clone().unwrap_or_default() })
        }
        _ => None,
    })
}

/// Returns the system of the first aperture (an ideal system or a file) if no aperture has a product of the catalogue;
/// otherwise `None`.
pub fn own_system(scene: &SceneFile) -> Option<&SystemKeys> {
    let from_catalogue = |system: &SystemKeys| matches!(system, SystemKeys::Catalogue { .. });
    let first = scene.aperture.first().map(|aperture| &aperture.system);
    first.filter(|_| !scene.aperture.iter().any(|aperture| from_catalogue(&aperture.system)))
}

/// Puts a product into every aperture that has a product of the catalogue, or into the first one if none has. Control
/// rules are removed unless the state is controlled.
pub fn fill(scene: &mut SceneFile, selection: &Selection) {
    let state = (!selection.state.is_empty()).then(|| selection.state.clone());
    if selection.state != CONTROLLED {
        scene.control = None;
        scene.aperture.iter_mut().for_each(|aperture| aperture.control = None);
    }
    let keys = SystemKeys::Catalogue { key: selection.product.clone(), state };
    if own_system(scene).is_some() {
        scene.aperture[0].system = keys;
        return;
    }
    for aperture in &mut scene.aperture {
        if matches!(aperture.system, SystemKeys::Catalogue { .. }) {
            aperture.system = keys.clone();
        }
    }
}

/// Sets the control rule of one aperture, by its index; for `None` that of the whole scene, and removes those of its
/// apertures.
pub fn set_rule(scene: &mut SceneFile, aperture: Option<usize>, keys: Option<ControlKeys>) {
    match aperture.and_then(|index| scene.aperture.get_mut(index)) {
        Some(aperture) => aperture.control = keys,
        None => {
            scene.aperture.iter_mut().for_each(|aperture| aperture.control = None);
            scene.control = keys;
        }
    }
}

/// Returns the control rule that applies to an aperture, by its index: the one set for the aperture, else that of the
/// scene.
pub fn rule(scene: &SceneFile, aperture: usize) -> Option<&ControlKeys> {
    scene.aperture.get(aperture).and_then(|aperture| aperture.control.as_ref()).or(scene.control.as_ref())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_kept_by_an_older_version_goes_on_following_the_sun() {
        // What such a version wrote: figures of the moment, and no word of where they came from.
        let mut old = first_scene();
        old.sky.illuminance = IlluminanceKey::Stated;
        old.sky.diffuse_horizontal = Some(12_900.0);
        old.sky.sun.direct_normal = Some(90_400.0);
        let text = toml::to_string(&old).unwrap();
        let without: String =
            text.lines().filter(|line| !line.starts_with("illuminance")).collect::<Vec<_>>().join("\n");
        assert_ne!(text.len(), without.len() + 1);
        assert_eq!(kept_scene(&without).unwrap().sky.illuminance, IlluminanceKey::ClearSky);
        assert_eq!(kept_scene(&without).unwrap().sky.diffuse_horizontal, None);
        // The same figures typed in this version stay.
        assert_eq!(kept_scene(&text).unwrap(), old);
        // Without a sun there was nothing to follow.
        let sunless = without
            .replace("type = 12", "type = 16")
            .lines()
            .filter(|line| !line.starts_with("time"))
            .collect::<Vec<_>>()
            .join("\n");
        let kept = kept_scene(&sunless).unwrap();
        assert_eq!((kept.sky.illuminance, kept.sky.diffuse_horizontal), (IlluminanceKey::Stated, Some(12_900.0)));
        assert_eq!(kept_scene("no scene"), None);
    }

    #[test]
    fn typed_figures_start_from_what_was_followed() {
        let mut scene = first_scene();
        let before = illuminances(&scene.sky, &scene.site).unwrap().unwrap();
        follow(&mut scene, IlluminanceKey::Stated);
        let typed = illuminances(&scene.sky, &scene.site).unwrap().unwrap();
        assert!((typed.diffuse_horizontal - before.diffuse_horizontal).abs() <= 0.5);
        assert!((typed.direct_normal - before.direct_normal).abs() <= 0.5 && typed.direct_normal > 50_000.0);
        follow(&mut scene, IlluminanceKey::ClearSky);
        assert_eq!(scene, first_scene());
    }
}
