//! Scenes of the candidates of a comparison.

use crate::study::scene_file::{CompareKeys, SceneFile, SystemKeys};
use crate::study::scene_words;
use crate::texts::words as texts;

/// Returns the scene of a candidate: `scene` with the parts that `keys` name replaced. Its own list of candidates is
/// empty.
pub fn candidate(scene: &SceneFile, keys: &CompareKeys) -> SceneFile {
    let CompareKeys { name: _, system, control, sky, site, room, aperture, sensors } = keys;
    let mut scene = SceneFile { compare: Vec::new(), ..scene.clone() };
    if let Some(sky) = sky {
        scene.sky = sky.clone();
    }
    scene.site = site.unwrap_or(scene.site);
    scene.room = room.unwrap_or(scene.room);
    if let Some(sensors) = sensors {
        scene.sensors = sensors.clone();
    }
    if !aperture.is_empty() {
        scene.aperture.clone_from(aperture);
        scene.control.clone_from(control);
    }
    if let Some(system) = system {
        scene.control.clone_from(control);
        let from_catalogue = |one: &SystemKeys| matches!(one, SystemKeys::Catalogue { .. } | SystemKeys::Ranked);
        let any = scene.aperture.iter().any(|one| from_catalogue(&one.system));
        for (index, one) in scene.aperture.iter_mut().enumerate() {
            one.control = None;
            if from_catalogue(&one.system) || (!any && index == 0) {
                one.system = system.clone();
            }
        }
    }
    scene
}

/// Whether two scenes give the same illuminances: all keys agree except those of annual simulation, ranking and
/// comparison.
pub fn same_question(a: &SceneFile, b: &SceneFile) -> bool {
    let SceneFile {
        room,
        aperture,
        outside,
        building,
        site,
        sky,
        sensors,
        control,
        compute,
        year: _,
        rank: _,
        compare: _,
    } = a;
    (room, site, compute) == (&b.room, &b.site, &b.compute)
        && (aperture, outside, building, sky) == (&b.aperture, &b.outside, &b.building, &b.sky)
        && (sensors, control) == (&b.sensors, &b.control)
}

/// Returns the label of a candidate: its given name, else that of its system.
pub fn label(keys: &CompareKeys) -> String {
    if !keys.name.trim().is_empty() {
        return keys.name.trim().to_owned();
    }
    let system = keys.system.as_ref().or(keys.aperture.first().map(|aperture| &aperture.system));
    system.map_or_else(|| texts::AS_IN_SCENE.into(), scene_words::system)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::scene_file::{ControlKeys, ControlMode};

    const SCENE: &str = r#"
[room]
width = 4.0
depth = 6.0
height = 3.0
reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }
[[aperture]]
surface = "facade"
origin = [0.5, 0.9]
size = [1.0, 1.0]
system = { ideal = "diffuse", transmittance = 0.5 }
[[aperture]]
surface = "facade"
origin = [2.0, 0.9]
size = [1.0, 1.0]
system = { catalogue = "a", state = "controlled" }
control = { mode = "redirect" }
[sky]
model = "cie"
type = 16
diffuse_horizontal = 10000.0
[sensors]
points = [[2.0, 3.0, 0.85]]
normal = [0.0, 0.0, 1.0]
[[compare]]
name = " A "
system = { catalogue = "b", state = "45" }
[[compare]]
system = { catalogue = "c", state = "controlled" }
control = { mode = "cut-off" }
[compare.sky]
model = "cie"
type = 12
diffuse_horizontal = 20000.0
"#;

    #[test]
    fn a_candidate_says_what_differs_and_takes_the_rest_of_the_scene() {
        let scene = SceneFile::parse(SCENE).unwrap();
        // As written, so read.
        assert_eq!(SceneFile::parse(&toml::to_string(&scene).unwrap()).unwrap(), scene);
        assert_eq!(scene.compare.iter().map(label).collect::<Vec<_>>(), ["A", "c, controlled"]);
        let [first, second] = [0, 1].map(|place| candidate(&scene, &scene.compare[place]));
        let key = |state: &str, key: &str| SystemKeys::Catalogue { key: key.to_owned(), state: Some(state.to_owned()) };
        // What is not from the catalogue stays, and a state that is named needs no rule.
        assert_eq!(first.aperture[0], scene.aperture[0]);
        assert_eq!((&first.aperture[1].system, &first.aperture[1].control), (&key("45", "b"), &None));
        assert_eq!((&first.sky, first.compare.len()), (&scene.sky, 0));
        assert_eq!(second.aperture[1].system, key("controlled", "c"));
        assert_eq!(second.control, Some(ControlKeys::of(ControlMode::CutOff)));
        assert_eq!(second.sky.diffuse_horizontal, Some(20_000.0));
        assert!(same_question(&scene, &SceneFile { compare: Vec::new(), ..scene.clone() }));
        assert!(!same_question(&scene, &first));
    }

    #[test]
    fn the_first_aperture_is_filled_where_none_is_from_the_catalogue() {
        let mut scene = SceneFile::parse(SCENE).unwrap();
        scene.aperture.truncate(1);
        let filled = candidate(&scene, &scene.compare[0]);
        assert!(matches!(&filled.aperture[0].system, SystemKeys::Catalogue { key, .. } if key == "b"));
    }

    #[test]
    fn unknown_keys_of_a_candidate_are_refused_with_their_place() {
        let error = SceneFile::parse(&SCENE.replace("name = \" A \"", "product = \"b\"")).unwrap_err().to_string();
        assert!(error.contains("product"), "{error}");
    }
}
