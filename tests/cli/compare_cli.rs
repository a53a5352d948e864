//! `cfs compare` and `cfs catalogue like` as scripts see them.

use crate::program::cfs;
use std::path::Path;

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = cfs(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

const SCENE: &str = r#"
[room]
width = 4.0
depth = 6.0
height = 3.0
reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }
[[aperture]]
surface = "facade"
origin = [0.5, 0.9]
size = [3.0, 1.8]
system = { ideal = "transparent", transmittance = 0.8 }
[sky]
model = "cie"
type = 16
diffuse_horizontal = 10000.0
[sensors]
plane = { z = 0.85, nx = 2, ny = 3 }
"#;

const TRAY: &str = r#"
[[compare]]
name = "bright"
[[compare]]
name = "dim, diffuse"
system = { ideal = "diffuse", transmittance = 0.4 }
"#;

fn figure<'a>(table: &'a serde_json::Value, key: &str) -> &'a serde_json::Value {
    table["figures"].as_array().unwrap().iter().find(|row| row["figure"] == key).unwrap()
}

#[test]
fn the_tray_of_a_scene_is_compared_as_its_rooms_are_computed() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("tray.toml"), format!("{SCENE}{TRAY}")).unwrap();
    let table: serde_json::Value = serde_json::from_str(&done(at, &["compare", "tray.toml", "--json"])).unwrap();
    assert_eq!(table["candidates"], serde_json::json!(["bright", "dim, diffuse"]));
    let room: serde_json::Value = serde_json::from_str(&done(at, &["room", "tray.toml", "--json"])).unwrap();
    let values: Vec<f64> =
        room["sensors"].as_array().unwrap().iter().map(|one| one["E_lx"].as_f64().unwrap()).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let found = figure(&table, "mean");
    assert!((found["values"][0]["value"].as_f64().unwrap() / mean - 1.0).abs() < 1e-9);
    assert!(found["values"][0]["error"].as_f64().is_some_and(|error| error > 0.0 && error < 0.1 * mean));
    assert_eq!((&found["verdict"], &found["better_is"]), (&"aim".into(), &"a matter of aim".into()));
    // What goes straight on keeps the view; half of what is scattered goes up.
    assert_eq!(figure(&table, "view")["better"], serde_json::json!([0]));
    assert_eq!(figure(&table, "to_ceiling")["better"], serde_json::json!([1]));
    let csv = done(at, &["compare", "tray.toml", "--csv"]);
    assert!(csv.starts_with(
        "figure,unit,better_is,bright,error of bright,\"dim, diffuse\",\"error of dim, diffuse\",better\n"
    ));
    let plain = done(at, &["compare", "tray.toml"]);
    assert!(plain.contains(" 1  bright\n 2  dim, diffuse\n") && plain.contains("Mean illuminance / lx"), "{plain}");
    done(at, &["compare", "tray.toml", "--csv", "--out", "table.csv"]);
    assert_eq!(std::fs::read_to_string(at.join("table.csv")).unwrap(), csv);
}

#[test]
fn products_are_compared_by_their_data_or_in_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("scene.toml"), SCENE).unwrap();
    let products = ["compare", "open-aperture", "ideal-diffuser"];
    let table: serde_json::Value = serde_json::from_str(&done(at, &[&products[..], &["--json"]].concat())).unwrap();
    assert_eq!(figure(&table, "tau_normal")["values"][0], serde_json::json!({ "value": 1.0, "error": 0.0 }));
    assert!(table["figures"].as_array().unwrap().iter().all(|row| row["figure"] != "mean"));
    let within = [&products[..], &["--scene", "scene.toml", "--json"]].concat();
    let table: serde_json::Value = serde_json::from_str(&done(at, &within)).unwrap();
    let mean = |place: usize| figure(&table, "mean")["values"][place]["value"].as_f64().unwrap();
    assert!(mean(0) > mean(1) && mean(1) > 0.0);
    for (wrong, words) in [
        (vec!["compare", "no-such-product"], "no-such-product"),
        (vec!["compare", "venetian-80-72:nowhere"], "it has: "),
        (vec!["compare", "absent.toml"], "absent.toml"),
    ] {
        let output = cfs(at, &wrong);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!((output.status.code(), error.trim_end().lines().count()), (Some(2), 1), "{error}");
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn products_like_another_come_nearest_first() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let list: serde_json::Value =
        serde_json::from_str(&done(at, &["catalogue", "like", "clear-double", "--most", "5", "--json"])).unwrap();
    let distances: Vec<f64> = list.as_array().unwrap().iter().map(|one| one["distance"].as_f64().unwrap()).collect();
    assert!(distances.len() == 5 && distances.windows(2).all(|pair| pair[0] <= pair[1]) && distances[0] < 0.2);
    let plain = done(at, &["catalogue", "like", "clear-double"]);
    assert!(plain.starts_with("like clear-double (") && plain.contains(" apart: "), "{plain}");
    let output = cfs(at, &["catalogue", "like", "nothing"]);
    assert_eq!(output.status.code(), Some(2));
}
