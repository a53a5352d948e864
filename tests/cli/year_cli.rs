//! A year on the command line: hours that are those of the room, states by controls, figures, refusals.

use crate::common::data;
use crate::program::cfs;
use std::collections::HashMap;
use std::path::Path;

const ROOM: &str = "[room]\nwidth = 4.0\ndepth = 5.0\nheight = 3.0\n\
                    reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }\n";
const SITE: &str = "[site]\nazimuth = 200.0\nlatitude = 47.48\nlongitude = -122.22\nutc_offset = -8.0\n\
                    ground_reflectance = 0.2\n[sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 1.0\n\
                    [sensors]\nplane = { z = 0.85, nx = 2, ny = 2 }\n";

/// A scene with a year of Renton.
fn scene(folder: &Path, system: &str, rest: &str) {
    let text = format!(
        "{ROOM}[[aperture]]\nsurface = \"facade\"\norigin = [0.5, 1.0]\nsize = [3.0, 1.8]\nreflectance = 0.0\n\
         system = {system}\n{SITE}{rest}"
    );
    std::fs::write(folder.join("scene.toml"), text).unwrap();
}

fn done(folder: &Path, command: &[&str]) -> String {
    let output = cfs(folder, command);
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Rows by the names of their columns.
fn table(text: &str) -> Vec<HashMap<String, String>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields.len(), names.len(), "{line}");
        names.iter().zip(fields).map(|(name, field)| ((*name).to_owned(), field.to_owned())).collect()
    };
    lines.map(row).collect()
}

fn number(row: &HashMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name}: {}", row[name]))
}

/// Hours of a table are those of `cfs room` for the same hours as scenes.
fn hours_are_those_of_rooms(folder: &Path, rows: &[HashMap<String, String>], times: &[&str]) {
    for time in times {
        let row = rows.iter().find(|row| row["time"].contains(time)).unwrap();
        assert!(number(row, "E_1") > 0.0, "{time}");
        done(folder, &["year", "scene.toml", "--scene-at", &row["time"], "--out", "hour.toml", "--force"]);
        let room = table(&done(folder, &["room", "hour.toml"]));
        for (i, sensor) in room.iter().enumerate() {
            let (year, moment) = (number(row, &format!("E_{}", i + 1)), number(sensor, "E_lx"));
            let allowed = 0.002 * moment + number(sensor, "E_error_numerical_lx");
            assert!((year - moment).abs() <= allowed, "{time}, sensor {}: {year} of {moment} lx", i + 1);
        }
    }
}

#[test]
fn a_day_of_an_opening_is_that_of_the_room_hour_by_hour() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    scene(
        folder,
        "{ ideal = \"transparent\", transmittance = 0.8 }",
        "[year]\nweather = \"builtin:renton\"\neyes = [{ point = [2.0, 1.5, 1.2], direction = [0.0, -1.0, 0.0] }]\n\
         [year.lighting]\npower = 10.0\ntarget = 500.0\ncontrol = \"on-off\"\nstandby = 0.5\n",
    );
    let rows = table(&done(folder, &["year", "scene.toml", "--day", "06-21"]));
    assert_eq!(rows.len(), 24);
    let night = &rows[0];
    assert!(number(night, "sun_altitude_deg") < 0.0);
    assert_eq!(
        ["E_1", "Ev_1", "E_error_1", "S_1", "lighting_W_m2"].map(|name| number(night, name)),
        [0.0, 0.0, 0.0, 0.0, 0.5]
    );
    hours_are_those_of_rooms(folder, &rows, &["T06:30", "T12:30", "T17:30"]);
    // On while the mean of the sensors is below the target, from 8 to 18 o'clock.
    for row in &rows {
        let hour: f64 = row["time"][11..13].parse().unwrap();
        let mean = (1..=4).map(|i| number(row, &format!("E_{i}"))).sum::<f64>() / 4.0;
        let on = (8.0..18.0).contains(&hour) && mean < 500.0;
        assert_eq!(number(row, "lighting_W_m2"), if on { 10.0 } else { 0.5 }, "{}", row["time"]);
    }
    let json: serde_json::Value =
        serde_json::from_str(&done(folder, &["year", "scene.toml", "--day", "06-21", "--out", "day.csv", "--json"]))
            .unwrap();
    let metrics = &json["metrics"];
    assert_eq!((metrics["hours"].as_f64(), metrics["occupied_hours"].as_f64()), (Some(24.0), Some(10.0)));
    let noon = rows.iter().filter(|row| (8..18).contains(&row["time"][11..13].parse::<u32>().unwrap()));
    let share = noon.filter(|row| number(row, "E_3") >= 300.0).count() as f64 / 10.0;
    assert!((metrics["DA300"][2].as_f64().unwrap() - share).abs() < 1e-12);
    assert!(json["errors"]["annual_mean_lx"][0].as_f64().unwrap() > 0.0, "{json}");
    assert!(metrics.get("EN17037").is_none() && json["left_out"].to_string().contains("whole year"), "{json}");
    let by_hand: f64 = rows.iter().map(|row| number(row, "lighting_W_m2") / 1000.0).sum();
    assert!((metrics["lighting"]["kWh_m2"].as_f64().unwrap() - by_hand).abs() < 1e-9);
}

#[test]
fn a_night_shift_has_the_hours_on_both_sides_of_midnight() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let year = "[year]\nweather = \"builtin:renton\"\nhours = { from = 22.0, to = 6.0 }\n\
                [year.lighting]\npower = 10.0\ntarget = 500.0\ncontrol = \"on-off\"\nstandby = 0.5\n";
    scene(folder, "{ ideal = \"transparent\", transmittance = 0.8 }", year);
    let rows = table(&done(folder, &["year", "scene.toml", "--day", "12-21"]));
    let on: Vec<u32> = rows
        .iter()
        .filter(|row| number(row, "lighting_W_m2") == 10.0)
        .map(|row| row["time"][11..13].parse().unwrap())
        .collect();
    assert_eq!(on, [0, 1, 2, 3, 4, 5, 22, 23]);
    let json = done(folder, &["year", "scene.toml", "--day", "12-21", "--out", "day.csv", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["metrics"]["occupied_hours"].as_f64(), Some(8.0));
}

#[test]
fn steps_within_an_hour_move_the_sun_and_share_its_light() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    scene(
        folder,
        "{ ideal = \"diffuse\", transmittance = 0.5 }",
        "[year]\nweather = \"builtin:renton\"\nsteps_per_hour = 4\nground = [0.7, 0.7, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.7]\n",
    );
    let rows = table(&done(folder, &["year", "scene.toml", "--day", "12-21"]));
    assert_eq!(rows.len(), 96);
    let quarter = |time: &str| rows.iter().find(|row| row["time"].contains(time)).unwrap();
    let (first, last) = (quarter("T11:07:30"), quarter("T11:52:30"));
    assert!(number(last, "sun_azimuth_deg") - number(first, "sun_azimuth_deg") > 8.0);
    hours_are_those_of_rooms(folder, &rows, &["T11:52:30"]);
    let scene = std::fs::read_to_string(folder.join("hour.toml")).unwrap();
    assert!(scene.contains("ground_reflectance = 0.7"), "{scene}");
}

#[test]
fn a_family_of_files_follows_its_curve() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let Some(annual) = data("reference/cases/annual") else { return };
    let file = |angle: u32| annual.join(format!("slats_{angle}.xml")).to_string_lossy().into_owned();
    let state = |angle| format!("{{ state = \"{angle}\", value = {angle}.0, file = \"{}\" }}", file(angle));
    let states: Vec<String> = [0, 45, 75].map(state).to_vec();
    scene(
        folder,
        &format!("{{ state = \"controlled\", states = [{}] }}", states.join(", ")),
        "[control]\nmode = \"curve\"\ncurve = [[0, 75], [45, 0], [90, 0]]\n[compute]\ninterpolation = \"patch\"\n\
         [year]\nweather = \"builtin:new-york\"\n",
    );
    let rows = table(&done(folder, &["year", "scene.toml", "--day", "01-02"]));
    let states: Vec<&str> = rows.iter().map(|row| &*row["state_1"]).collect();
    assert!(states.contains(&"") && states.iter().any(|state| ["45", "75"].contains(state)), "{states:?}");
    let lit: Vec<&str> = rows.iter().filter(|row| !row["state_1"].is_empty()).map(|row| &row["time"][10..]).collect();
    hours_are_those_of_rooms(folder, &rows, &[lit[1], lit[lit.len() / 2]]);
    let error = cfs(folder, &["room", "scene.toml"]);
    assert!(error.status.success(), "{}", String::from_utf8_lossy(&error.stderr));
}

#[test]
fn wrong_years_are_refused_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let refused = |rest: &str, command: &[&str], part: &str| {
        scene(folder, "{ ideal = \"diffuse\", transmittance = 0.5 }", rest);
        let output = cfs(folder, command);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!((output.status.code(), error.lines().count()), (Some(2), 1), "{error}");
        assert!(error.contains(part), "{part}: {error}");
    };
    let year = ["year", "scene.toml"];
    let keys = |more: &str| format!("[year]\nweather = \"builtin:renton\"\n{more}");
    refused("", &year, "scene.toml: year: missing");
    refused("[year]\nweather = \"none.epw\"\n", &year, "year.weather");
    refused(&keys("ground = [0.2, 0.3]\n"), &year, "year.ground: 2 reflectances");
    refused(&keys("steps_per_hour = 3\n"), &year, "year.steps_per_hour: 3 (allowed: 1, 2, 4 or 12)");
    refused(&keys("hours = { from = 8.0, to = 8.0 }\n"), &year, "year.hours");
    refused(&keys("eyes = [{ point = [9.0, 1.0, 1.2], direction = [0, -1, 0] }]\n"), &year, "year.eyes[1].point");
    let zones = "[year.lighting]\npower = 8\ntarget = 500\nzones = [{ sensors = [4], share = 1.0 }]\n";
    refused(&keys(zones), &year, "year.lighting.zones[1].sensors: there is no sensor 4 (allowed: 0 to 3)");
    refused(&keys(""), &["year", "scene.toml", "--day", "30.2."], "--day 30.2.: no day");
    let at = ["year", "scene.toml", "--scene-at", "noon", "--out", "hour.toml"];
    refused(&keys(""), &at, "--scene-at noon");
    assert!(!folder.join("hour.toml").exists());
}

#[test]
fn glare_stands_behind_the_light_and_openings_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let system = "{ ideal = \"transparent\", transmittance = 0.8 }";
    let year =
        "[year]\nweather = \"builtin:renton\"\neyes = [{ point = [2.0, 1.5, 1.2], direction = [0.0, -1.0, 0.0] }]\n";
    scene(folder, system, year);
    let text = done(folder, &["year", "scene.toml", "--day", "03-21", "--json", "--out", "hours.csv"]);
    let rows = table(&std::fs::read_to_string(folder.join("hours.csv")).unwrap());
    let mut values: Vec<f64> = Vec::new();
    for row in &rows {
        let hour: f64 = row["time"][11..13].parse().unwrap();
        let there = (8.0..18.0).contains(&hour);
        assert_eq!(row["DGP_1"].is_empty(), !(there && number(row, "diffuse_horizontal_lx") > 0.0), "{}", row["time"]);
        assert_eq!(row["DGP_1"].is_empty(), row["DGP_error_1"].is_empty());
        if there {
            let value = if row["DGP_1"].is_empty() { 0.0 } else { number(row, "DGP_1") };
            assert!((0.0..=1.0).contains(&value), "{value}");
            values.push(value);
        }
    }
    // Of ten hours none may exceed it.
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let eye = &json["metrics"]["glare"]["Ev_1"];
    let largest = values.iter().copied().fold(0.0, f64::max);
    assert!((eye["DGP_5pct"].as_f64().unwrap() - largest).abs() < 1e-5);
    let above = values.iter().filter(|value| **value > 0.40).count() as f64 / values.len() as f64;
    assert_eq!(eye["DGP_share_above_0.40"].as_f64().unwrap(), above);
    let limits = [(0.35, "high"), (0.40, "medium"), (0.45, "minimum"), (2.0, "none")];
    assert_eq!(eye["DGP_class"], limits.iter().find(|(limit, _)| largest <= *limit).unwrap().1);
    assert!(eye["DGPs_5pct"].as_f64().unwrap() > 0.18);
    // Left out where it is not asked for, and days that are none are refused.
    scene(folder, system, &format!("{year}dgp = false\n"));
    assert!(!table(&done(folder, &["year", "scene.toml", "--day", "03-21"]))[0].contains_key("DGP_1"));
    scene(folder, system, &format!("{year}sunlight = {{ date = \"05-01\" }}\n"));
    let refused = cfs(folder, &["year", "scene.toml", "--day", "03-21", "--json"]);
    let told = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(!refused.status.success() && told.contains("year.sunlight.date"), "{told}");
}

#[test]
fn openings_stand_beside_a_whole_year() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let rest = "[compute]\ninterreflection = false\n[year]\nweather = \"builtin:renton\"\n";
    scene(folder, "{ ideal = \"diffuse\", transmittance = 0.5 }", rest);
    let json: serde_json::Value = serde_json::from_str(&done(folder, &["year", "scene.toml", "--json"])).unwrap();
    let standard = &json["metrics"]["EN17037"];
    assert!(standard["median_diffuse_lx"].as_f64().unwrap() > 1000.0);
    // The façade looks 20° west of south: at equinox at 47.48° N the sun is 10° high for so long on a free plane,
    // of which mornings are lost before it comes round.
    let cosine = 10_f64.to_radians().sin() / 47.48_f64.to_radians().cos();
    let expected = 2.0 * cosine.acos().to_degrees() / 15.0;
    let hours = standard["sunlight"]["hours"].as_f64().unwrap();
    assert!(standard["sunlight"]["level"] == "high" && hours < expected + 0.1, "{hours} {expected}");
    assert!(hours > 0.5 * expected + 3.0, "{hours} {expected}");
    assert_eq!((&standard["view"]["layers"]["ground"], &standard["view"]["points"]), (&true.into(), &4.into()));
    assert_eq!(standard["view"]["distance"], "nothing in the way");
}

#[test]
fn ground_before_a_sunken_box_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // It begins far below the ground: what it has there hides nothing.
    let rest = "[[outside]]\nbox = { from = [-500.0, -300.0, -50.0], to = [500.0, -30.0, 0.1] }\n\
                [compute]\ninterreflection = false\n[year]\nweather = \"builtin:renton\"\n";
    scene(folder, "{ ideal = \"diffuse\", transmittance = 0.5 }", rest);
    let json: serde_json::Value = serde_json::from_str(&done(folder, &["year", "scene.toml", "--json"])).unwrap();
    assert_eq!(json["metrics"]["EN17037"]["view"]["layers"]["ground"], true);
}

/// The figures of a whole year of sun through a window.
fn sun_of_a_year(folder: &Path, system: &str, rest: &str) -> serde_json::Value {
    scene(
        folder,
        system,
        &format!("{rest}[compute]\ninterreflection = false\n[year]\nweather = \"builtin:renton\"\ndgp = false\n"),
    );
    let json: serde_json::Value = serde_json::from_str(&done(folder, &["year", "scene.toml", "--json"])).unwrap();
    json["metrics"].clone()
}

#[test]
fn sunlight_exposure_has_shading_retracted_and_boxes_in_the_way() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (name, absorption) in [("clear", 8.0), ("dark", 2000.0)] {
        let text = format!(
            "name = \"{name}\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\nabsorption = {absorption:?}\n"
        );
        std::fs::write(folder.join(format!("{name}.system.toml")), text).unwrap();
    }
    let clear = sun_of_a_year(folder, "{ file = \"clear.system.toml\" }", "");
    let hours = |metrics: &serde_json::Value, key: &str| -> Vec<f64> {
        metrics[key].as_array().unwrap().iter().map(|hours| hours.as_f64().unwrap()).collect()
    };
    let open = hours(&clear, "sun_hours_1000");
    assert_eq!(hours(&clear, "ASE_hours_1000"), open);
    assert!(open.iter().any(|hours| *hours > 250.0) && clear["ASE1000_250"].as_f64().unwrap() > 0.0, "{open:?}");
    // A control darkens the glass while the sun shines on it: in use no point has 1000 lx, retracted all have what they had.
    let family = "{ state = \"controlled\", states = [{ state = \"clear\", value = 0.0, file = \"clear.system.toml\" }, \
                  { state = \"dark\", value = 1.0, file = \"dark.system.toml\" }] }";
    let moved = sun_of_a_year(folder, family, "[control]\nmode = \"din-5034\"\n");
    assert_eq!((hours(&moved, "ASE_hours_1000"), &moved["ASE1000_250"]), (open.clone(), &clear["ASE1000_250"]));
    assert!(hours(&moved, "sun_hours_1000").iter().all(|hours| *hours == 0.0));
    // An overhang hides the sun before it comes round to the side and sinks, and hides nothing of it later.
    let sun_of = |rest: &str| -> [f64; 2] {
        let year = "[year]\nweather = \"builtin:renton\"\ndgp = false\n";
        scene(folder, "{ file = \"clear.system.toml\" }", &format!("{rest}{year}"));
        let rows = table(&done(folder, &["year", "scene.toml", "--day", "02-15"]));
        ["11:30", "13:30"].map(|time| {
            let row = rows.iter().find(|row| row["time"].contains(time)).unwrap();
            (1..=4).map(|i| number(row, &format!("S_{i}"))).sum()
        })
    };
    let [noon, later] = sun_of("");
    assert!(noon > 1000.0 && later > 1000.0, "{noon} {later}");
    let overhang = "[[outside]]\nbox = { from = [-3.0, -2.0, 3.0], to = [7.0, 0.0, 3.1] }\nreflectance = 0.0\n";
    let [hidden, seen] = sun_of(overhang);
    assert!(hidden == 0.0 && (seen / later - 1.0).abs() < 1e-6, "{hidden} {seen} {later}");
}
