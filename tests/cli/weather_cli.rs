//! Weather on the command line: what a file is, and its hours as skies of scenes.

use crate::common::data;
use crate::program::cfs;
use std::path::Path;

/// A scene whose sky is given.
fn scene(folder: &Path, sky: &str, site: &str) {
    let text = format!(
        "[room]\nwidth = 4.0\ndepth = 5.0\nheight = 3.0\n\
         reflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 1.0]\nsize = [3.0, 1.8]\n\
         system = {{ ideal = \"diffuse\", transmittance = 0.5 }}\n\
         [site]\nazimuth = 180.0\nground_reflectance = 0.2\n{site}\n[sky]\n{sky}\n\
         [sensors]\nplane = {{ z = 0.85, nx = 2, ny = 2 }}\n"
    );
    std::fs::write(folder.join("scene.toml"), text).unwrap();
}

fn words(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The scene's sky as `cfs sky --json` tells it, and what it says beside.
fn sky(folder: &Path) -> (serde_json::Value, String) {
    let output = cfs(folder, &["sky", "scene.toml", "--json"]);
    assert!(output.status.success(), "{}", words(&output.stderr));
    (serde_json::from_slice(&output.stdout).unwrap(), words(&output.stderr))
}

fn refused(folder: &Path, command: &[&str]) -> String {
    let output = cfs(folder, command);
    let error = words(&output.stderr);
    assert_eq!((output.status.code(), error.lines().count()), (Some(2), 1), "{error}");
    error
}

#[test]
fn info_says_place_period_clock_and_sums() {
    let folder = tempfile::tempdir().unwrap();
    let output = cfs(folder.path(), &["info", "builtin:new-york"]);
    let text = words(&output.stdout);
    assert!(output.status.success(), "{}", words(&output.stderr));
    for part in [
        "Place                 New York, Central Park, NY, USA",
        "Latitude              40.78° N",
        "Longitude             73.96° W",
        "UTC-5 h",
        "Rows                  8760 of 60 min, 0 missing between them",
        "1.5 W/m² with the table's clock of -30 min, 21.9 W/m² without",
        "Diffuse horizontal    586.7 kWh/m²",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let output = cfs(folder.path(), &["info", "builtin:new-york", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for (key, value) in [("utc_offset_h", -5.0), ("rows", 8760.0), ("missing_intervals", 0.0)] {
        assert_eq!(json[key].as_f64(), Some(value), "{key}");
    }
    assert!((json["sums"]["direct_normal_kWh_m2"].as_f64().unwrap() - 1095.7).abs() < 6.0, "{json}");

    let Some(path) = data("data/weather/PVGIS_45N_8E_2005_2023.epw") else { return };
    let output = cfs(folder.path(), &["info", &path.to_string_lossy()]);
    let text = words(&output.stdout);
    assert!(text.contains("Closure               38.") && text.contains("moved by +40 min"), "{text}");
    assert!(text.contains("warning  clock-off") && text.contains("sun_offset_minutes = 40"), "{text}");
    assert!(text.contains("illuminance-missing"), "{text}");
}

#[test]
fn damaged_weather_is_refused_in_one_line_or_told() {
    let folder = tempfile::tempdir().unwrap();
    let Some(malformed) = data("data/malformed") else { return };
    let path = |name: &str| malformed.join(name).to_string_lossy().into_owned();
    assert!(refused(folder.path(), &["info", &path("epw_latitude_95.epw")]).contains("latitude"));
    assert!(refused(folder.path(), &["info", &path("epw_header_missing.epw")]).contains("LOCATION"));
    assert!(refused(folder.path(), &["info", &path("wea_negative.wea")]).contains("line 47"));
    let output = cfs(folder.path(), &["info", &path("epw_missing_codes.epw")]);
    assert!(output.status.success() && words(&output.stdout).contains("light-missing"));
    // An hour that lacks its light is refused with its line, the next is not.
    std::fs::copy(path("epw_missing_codes.epw"), folder.path().join("x.epw")).unwrap();
    scene(folder.path(), "weather = \"x.epw\"\ntime = \"2026-03-21T09:15\"", "");
    let error = refused(folder.path(), &["room", "scene.toml"]);
    assert!(
        error.contains("scene.toml: sky.weather: x.epw: line 10: field 16") && error.contains("1990-03-21 09:00–10:00"),
        "{error}"
    );
    scene(folder.path(), "weather = \"x.epw\"\ntime = \"2026-03-21T08:15\"", "");
    assert!(cfs(folder.path(), &["room", "scene.toml"]).status.success());
}

#[test]
fn a_scene_takes_the_hour_of_a_weather_file() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), "weather = \"builtin:new-york\"\ntime = \"2026-01-01T12:30\"", "");
    let (json, said) = sky(folder.path());
    // A reference year states for this hour: sun at 26.214°, bearing 180.143°, 98.147 and 6454.9 lx.
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let hour = &json["weather"];
    assert!((number(&hour["sun_altitude_deg"]) - 26.214).abs() < 2e-3, "{hour}");
    assert!((number(&hour["sun_azimuth_deg"]) - 180.143).abs() < 2e-3, "{hour}");
    assert!((number(&json["sun"]["direct_normal_lx"]) - 98.147).abs() < 0.02, "{json}");
    assert!((number(&json["horizontal"]["diffuse_lx"]) - 6454.9).abs() < 1.0, "{}", json["horizontal"]);
    assert_eq!(hour["interval"], "1958-01-01 12:00–13:00");
    assert!(said.contains("note: weather builtin:new-york, 1958-01-01 12:00–13:00 moved by -30 min"), "{said}");
    // The same hour written as a Perez sky with its date and angles.
    let sine = number(&hour["sun_altitude_deg"]).to_radians().sin();
    let plain = format!(
        "model = \"perez\"\ntime = \"1958-01-01T12:30\"\ndirect_horizontal_irradiance = {}\n\
         diffuse_horizontal_irradiance = {}\ndiffuse_horizontal = {}\n\
         sun = {{ altitude = {}, azimuth = {}, direct_normal = {} }}",
        number(&hour["direct_normal_W_m2"]) * sine,
        hour["diffuse_horizontal_W_m2"],
        hour["diffuse_horizontal_lx"],
        hour["sun_altitude_deg"],
        hour["sun_azimuth_deg"],
        hour["direct_normal_lx"],
    );
    let light = |name: &str| {
        let output = cfs(folder.path(), &["room", "scene.toml"]);
        assert!(output.status.success(), "{name}: {}", words(&output.stderr));
        let rows = words(&output.stdout);
        rows.lines().skip(1).map(|row| row.split(',').nth(6).unwrap().parse().unwrap()).collect::<Vec<f64>>()
    };
    let by_weather = light("weather");
    scene(folder.path(), &plain, "");
    for (a, b) in by_weather.iter().zip(light("angles")) {
        assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
    }
    // Without the date the distance of the sun is not known, and its sky is another.
    scene(folder.path(), &plain.replace("time = \"1958-01-01T12:30\"\n", ""), "");
    assert!(light("no date").iter().zip(&by_weather).any(|(a, b)| (a / b - 1.0).abs() > 1e-4));
}

#[test]
fn keys_that_do_not_go_with_weather_are_named() {
    let folder = tempfile::tempdir().unwrap();
    const HOUR: &str = "weather = \"builtin:renton\"\ntime = \"2026-06-21T12:30\"";
    for (sky, said) in [
        (format!("model = \"perez\"\n{HOUR}"), "sky.model: given together with sky.weather"),
        (format!("type = 12\n{HOUR}"), "sky.type: given together"),
        (format!("sun = {{ altitude = 30.0, azimuth = 180.0 }}\n{HOUR}"), "sky.sun: given together"),
        (format!("diffuse_horizontal = 1e4\n{HOUR}"), "sky.diffuse_horizontal: given together"),
        ("weather = \"builtin:renton\"".to_owned(), "sky.time: missing"),
        ("weather = \"builtin:paris\"\ntime = \"2026-06-21T12:30\"".to_owned(), "expected builtin:new-york"),
        ("weather = \"none.epw\"\ntime = \"2026-06-21T12:30\"".to_owned(), "none.epw: cannot be read"),
        (
            "weather = \"builtin:renton\"\ntime = \"2028-02-29T12:30\"".to_owned(),
            "no interval that holds 29 February, 12:30",
        ),
        ("time = \"2026-06-21T12:30\"\ndiffuse_horizontal = 1e4".to_owned(), "sky.model: missing"),
        (
            "model = \"uniform\"\ndiffuse_horizontal = 1e4\nlight = \"file\"".to_owned(),
            "sky.light: is only valid with sky.weather",
        ),
        (
            "model = \"uniform\"\ndiffuse_horizontal = 1e4\nsun_offset_minutes = 30".to_owned(),
            "sky.sun_offset_minutes: is only valid with sky.weather",
        ),
        (format!("{HOUR}\nsun_offset_minutes = 300"), "minutes from −180 to 180 or the word \"auto\""),
        (format!("{HOUR}\nlight = \"sun\""), "efficacy"),
    ] {
        scene(folder.path(), &sky, "");
        let error = refused(folder.path(), &["sky", "scene.toml"]);
        assert!(error.contains(said), "{sky}: {error}");
    }
}

#[test]
fn a_scene_in_another_place_and_a_clock_that_is_off_are_told() {
    let folder = tempfile::tempdir().unwrap();
    const HOUR: &str = "weather = \"builtin:renton\"\ntime = \"2026-06-21T12:30\"";
    scene(folder.path(), HOUR, "latitude = 48.8\nlongitude = 9.2\nutc_offset = 1.0");
    let (_, said) = sky(folder.path());
    for key in
        ["warning: site.latitude = 48.8°, but the weather is that of 47.48°", "site.longitude", "site.utc_offset = 1 h"]
    {
        assert!(said.contains(key), "{said}");
    }
    scene(folder.path(), HOUR, "latitude = 47.5\nlongitude = -122.3\nutc_offset = -8.0");
    assert!(!sky(folder.path()).1.contains("warning"));
    let Some(path) = data("data/weather/USA_NY_New.York.City-Central.Park.TMY3.epw") else { return };
    let hour = |more: &str| format!("weather = '{}'\ntime = \"2026-06-21T12:30\"\n{more}", path.display());
    scene(folder.path(), &hour(""), "");
    let (unmoved, said) = sky(folder.path());
    assert!(said.contains("warning: the clock of") && said.contains("sun_offset_minutes = -30"), "{said}");
    scene(folder.path(), &hour("sun_offset_minutes = \"auto\""), "");
    let (auto, said) = sky(folder.path());
    assert!(!said.contains("the clock of"), "{said}");
    // The file itself is not without faults: what `cfs info` warns of stands beside the hour.
    assert!(said.contains("no diffuse light with the sun more than 10°"), "{said}");
    scene(folder.path(), &hour("sun_offset_minutes = -30"), "");
    let (moved, _) = sky(folder.path());
    assert_eq!(auto["weather"]["sun_azimuth_deg"], moved["weather"]["sun_azimuth_deg"]);
    let azimuth = |json: &serde_json::Value| json["weather"]["sun_azimuth_deg"].as_f64().unwrap();
    assert!(azimuth(&unmoved) - azimuth(&moved) > 5.0);
}
