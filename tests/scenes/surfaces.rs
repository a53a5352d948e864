//! Light on the surfaces of the room, against sensors on them and against the flux that comes in.

use crate::rooms::{DIFFUSE, MADE, Text, clear, compute, facade, klems, roof, rough};
use cfs::compute::estimate::{Estimate, Silent};
use cfs::compute::quadrature::gauss_legendre;
use cfs::compute::room::direct::Sensor;
use cfs::study::{PatchLight, Scene, SensorResult, Session, SurfaceLight};
use std::sync::LazyLock;

fn surfaces(scene: &Scene) -> SurfaceLight {
    static SESSION: LazyLock<Session> = LazyLock::new(Session::new);
    SESSION.surfaces(scene, &Silent).unwrap()
}

/// Scenes with every kind of light: a system's cells and a sun in them, the sky straight through with its sharp sun, a
/// diffuser in the roof beside a window.
fn scenes() -> Vec<(&'static str, Scene)> {
    let light = Text { reflectance: [0.2, 0.5, 0.7], ground: 0.2, ..Text::default() };
    let reflecting = |body: String| format!("{body}\nreflectance = 0.3");
    let cells = Text {
        apertures: vec![reflecting(facade([0.5, 1.0], [3.0, 1.5], MADE))],
        sky: clear(35.0, 200.0, 60_000.0),
        ..light.clone()
    };
    let open = Text { sky: clear(35.0, 200.0, 60_000.0), ..light.clone() };
    let two = Text {
        apertures: vec![facade([0.4, 0.8], [2.0, 1.8], DIFFUSE), roof([1.0, 3.0], [1.5, 1.0], DIFFUSE)],
        reflectance: [0.0, 0.6, 0.8],
        ..light
    };
    vec![("cells", cells.scene_with(klems(rough))), ("open", open.scene()), ("two", two.scene())]
}

#[test]
fn what_comes_in_is_absorbed() {
    for (name, scene) in scenes() {
        let light = surfaces(&scene);
        let absorbed: f64 =
            light.patches.iter().map(|one| one.patch.area * (1.0 - one.patch.reflectance) * one.total().value).sum();
        // What black patches receive knows the first light only as means over coarse ones.
        let open = if light.patches.iter().all(|one| one.patch.reflectance > 0.0) { 1e-6 } else { 2e-3 };
        assert!((absorbed / light.flux.value - 1.0).abs() < open, "{name}: {absorbed} of {}", light.flux.value);
        let result = compute(&scene);
        assert!((light.flux.value / result.flux.value - 1.0).abs() < 1e-12, "{name}");
        let lit: f64 = light.patches.iter().map(|one| one.patch.area * one.beam).sum();
        let outlines: f64 =
            light.lit.iter().map(|one| one.illuminance * cfs::compute::polygon::area(&one.corners).abs()).sum();
        assert!((lit - outlines).abs() <= 1e-9 * lit, "{name}: {lit} {outlines}");
        assert_eq!(lit > 0.0, name == "open", "{name}: {lit}");
    }
}

/// Mean of sensors at Gauss points of a patch, with their mean error; `None` where a beam's edge crosses it.
fn by_sensors(scene: &Scene, light: &SurfaceLight, patches: &[&PatchLight]) -> Vec<Estimate> {
    let rule = gauss_legendre(3);
    let mut sensors = Vec::new();
    for one in patches {
        let wall = &light.walls[one.patch.wall];
        let [a, b] = one.patch.extent;
        for (s, _) in &rule {
            for (t, _) in &rule {
                let position = wall.point(a[0] + (a[1] - a[0]) * s, b[0] + (b[1] - b[0]) * t);
                sensors.push(Sensor { position, normal: wall.normal });
            }
        }
    }
    let result = compute(&Scene { sensors, grid: None, ..scene.clone() });
    let weights: Vec<f64> = rule.iter().flat_map(|(_, ws)| rule.iter().map(move |(_, wt)| ws * wt)).collect();
    let mean = |list: &[SensorResult]| -> Estimate {
        list.iter().zip(&weights).map(|(one, weight)| (one.total() + Estimate::new(-one.beam, 0.0)) * *weight).sum()
    };
    result.sensors.chunks(weights.len()).map(mean).collect()
}

#[test]
fn sensors_on_a_surface_get_what_its_patch_gets() {
    for (name, scene) in scenes() {
        let light = surfaces(&scene);
        // Every eleventh of the walls, floor and ceiling: those of apertures look at what no sensor may stand on.
        let bare = light.patches.iter().filter(|one| one.patch.aperture.is_none());
        let some: Vec<&PatchLight> = bare.step_by(11).collect();
        assert!(some.len() > 40);
        let mean = some.iter().map(|one| one.diffuse.value).sum::<f64>() / some.len() as f64;
        let mut within = 0;
        for (one, sensed) in some.iter().zip(by_sensors(&scene, &light, &some)) {
            let gap = (one.diffuse.value - sensed.value).abs();
            let stated = one.diffuse.error + sensed.error;
            within += usize::from(gap <= stated);
            // Never far off, whatever is stated.
            assert!(gap <= 0.08 * sensed.value.max(0.3 * mean), "{name}: {one:?} {sensed:?}");
            // What the cells' data leave open is theirs.
            let certain = one.diffuse.error < 0.2 * one.diffuse.value.max(0.3 * mean);
            assert!(certain || name == "cells", "{name}: {one:?}");
        }
        assert!(within * 100 >= 90 * some.len(), "{name}: {within} of {} within what is stated", some.len());
    }
}

#[test]
fn without_interreflection_only_first_light_falls() {
    let text = Text { compute: "interreflection = false".into(), reflectance: [0.2, 0.5, 0.7], ..Text::default() };
    let light = surfaces(&text.scene());
    let falling: f64 = light.patches.iter().map(|one| one.patch.area * one.total().value).sum();
    assert!((falling / light.flux.value - 1.0).abs() < 1e-6, "{falling}");
}
