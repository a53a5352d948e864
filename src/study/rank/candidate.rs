//! Scene with a product in the apertures that a ranking fills.

use crate::catalogue::Product;
use crate::study::control::year::CONTROLLED;
use crate::study::error::StudyError;
use crate::study::product_control::first_keys;
use crate::study::scene_file::{RankControlKey, SceneFile, SystemKeys};

/// Returns the scene with a product in its ranked apertures. A moving product follows its own control rule if it has
/// one and `by` allows it, else the `[control]` of the aperture or the scene; if there is none it is fixed in its
/// representative state.
///
/// # Errors
/// Returns an error for `rank.control = "scene"` without a `[control]`.
pub fn with_product(file: &SceneFile, product: &Product, by: RankControlKey) -> Result<SceneFile, StudyError> {
    let mut scene = SceneFile { rank: None, compare: Vec::new(), ..file.clone() };
    let (own, stands) = product.representative();
    let moves = product.states.len() > 1;
    for aperture in scene.aperture.iter_mut().filter(|aperture| aperture.system == SystemKeys::Ranked) {
        let specified = aperture.control.as_ref().or(file.control.as_ref()).cloned();
        let rule =
            match by {
                _ if !moves => None,
                RankControlKey::Product => first_keys(own).or(specified),
                RankControlKey::Scene => Some(specified.ok_or_else(|| {
                    StudyError::key("rank.control", "\"scene\" needs a [control] section with a mode")
                })?),
            };
        let fixed = || product.states.get(stands).map(|state| state.key.clone()).filter(|key| !key.is_empty());
        let state = if rule.is_some() { Some(CONTROLLED.to_owned()) } else { fixed() };
        aperture.system = SystemKeys::Catalogue { key: product.key.clone(), state };
        aperture.control = rule;
    }
    Ok(scene)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{Catalogue, NewProduct};
    use crate::compute::btdf::{Btdf, Dataset};
    use crate::study::example::first_scene;
    use crate::study::scene_file::{ControlKeys, ControlMode};

    /// A product of states with these transmittances.
    fn product(key: &str, states: &[(&str, f64)], curve: bool) -> Product {
        let dataset = |(state, tau): &(&str, f64)| {
            let mut dataset = Dataset { name: key.to_owned(), state: (*state).to_owned(), ..Dataset::default() };
            dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(*tau));
            dataset
        };
        let names = states
            .iter()
            .map(|(state, _)| crate::catalogue::StateName { label: (*state).to_owned(), value: state.parse().ok() });
        let new = NewProduct {
            key: Some(key.to_owned()),
            name: key.to_owned(),
            states: names.collect(),
            control_curve: if curve {
                vec![crate::catalogue::CurvePoint { profile_angle: 0.0, value: 45.0 }]
            } else {
                Vec::new()
            },
            ..NewProduct::default()
        };
        let mut catalogue = Catalogue::empty_in_memory().unwrap();
        let datasets: Vec<Dataset> = states.iter().map(dataset).collect();
        let imported = catalogue.import(&datasets, new).unwrap();
        catalogue.product(&imported.key).unwrap()
    }

    #[test]
    fn products_move_by_their_own_rule_or_by_the_scenes() {
        let mut scene = first_scene();
        scene.aperture[0].system = SystemKeys::Ranked;
        let blind = product("blind", &[("0", 0.5), ("45", 0.2)], true);
        let glass = product("glass", &[("clear", 0.5), ("dark", 0.1)], false);
        let pane = product("pane", &[("", 0.8)], false);
        let filled = |scene: &SceneFile, product: &Product, by| {
            let scene = with_product(scene, product, by)?;
            let SystemKeys::Catalogue { state, .. } = &scene.aperture[0].system else { unreachable!("it is filled") };
            Ok::<_, StudyError>((state.clone(), scene.aperture[0].control.clone().map(|keys| keys.mode)))
        };
        let own = |product| filled(&scene, product, RankControlKey::Product).unwrap();
        assert_eq!(own(&blind), (Some(CONTROLLED.to_owned()), Some(ControlMode::Curve)));
        // Nobody says how glass is switched: its most open state.
        assert_eq!(own(&glass), (Some("clear".to_owned()), None));
        assert_eq!(own(&pane), (None, None));
        let error = filled(&scene, &blind, RankControlKey::Scene).unwrap_err().to_string();
        assert!(error.starts_with("rank.control: "), "{error}");
        assert_eq!(filled(&scene, &pane, RankControlKey::Scene).unwrap(), (None, None));
        scene.control = Some(ControlKeys::of(ControlMode::Din5034));
        for (product, by, mode) in [
            (&blind, RankControlKey::Product, ControlMode::Curve),
            (&blind, RankControlKey::Scene, ControlMode::Din5034),
            (&glass, RankControlKey::Product, ControlMode::Din5034),
        ] {
            assert_eq!(filled(&scene, product, by).unwrap(), (Some(CONTROLLED.to_owned()), Some(mode)));
        }
    }
}
