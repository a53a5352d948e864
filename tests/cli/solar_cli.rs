//! Solar energy straight through systems: against closed forms of sun, sky and glass, and what is said of where it is from.

use crate::common::data;
use crate::program::cfs;
use serde_json::Value;
use std::collections::HashMap;
use std::path::Path;

const ROOM: &str = "[room]\nwidth = 4.0\ndepth = 5.0\nheight = 3.0\n\
                    reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }\n\
                    [sensors]\npoints = [[2.0, 2.0, 0.8]]\n[compute]\ninterreflection = false\n";
/// Sun alone in two seasons, then a bright sky with a sun, then an overcast one. No row is a whole day.
const WEATHER: &str = "place Test\nlatitude 40\nlongitude 0\ntime_zone 0\nsite_elevation 0\nweather_data_file_units 1\n\
                       1 15 12.5 800 0\n1 15 14.5 500 0\n7 15 9.5 700 0\n7 15 12.5 800 100\n10 2 10.5 300 200\n10 2 23.5 0 0\n12 1 11.5 0 80\n";
const AREAS: [f64; 2] = [2.0 * 1.5, 1.2 * 1.0];

fn scene(folder: &Path, ground: f64, [facade, roof]: [&str; 2], rest: &str) {
    let text = format!(
        "{ROOM}[site]\nazimuth = 200.0\nlatitude = 40.0\nlongitude = 0.0\nutc_offset = 0.0\nground_reflectance = {ground}\n\
         [sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 1.0\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [1.0, 1.0]\nsize = [2.0, 1.5]\nreflectance = 0.0\nsystem = {facade}\n\
         [[aperture]]\nsurface = \"roof\"\norigin = [1.0, 1.0]\nsize = [1.2, 1.0]\nreflectance = 0.0\nsystem = {roof}\n\
         [year]\nweather = \"w.wea\"\nsolar = true\n{rest}"
    );
    std::fs::write(folder.join("scene.toml"), text).unwrap();
    std::fs::write(folder.join("w.wea"), WEATHER).unwrap();
}

fn done(folder: &Path, command: &[&str]) -> (String, String) {
    let output = cfs(folder, command);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{command:?}: {told}");
    (String::from_utf8(output.stdout).unwrap(), told)
}

/// Hours as rows by the names of their columns, and the figures.
fn year(folder: &Path) -> (Vec<HashMap<String, f64>>, Value) {
    let (json, told) = done(folder, &["year", "scene.toml", "--out", "hours.csv", "--force", "--json"]);
    assert!(told.contains("directly transmitted, secondary heat left out"), "{told}");
    let text = std::fs::read_to_string(folder.join("hours.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let fields = line.split(',').map(|field| field.parse().unwrap_or(f64::NAN));
        names.iter().map(|name| (*name).to_owned()).zip(fields).collect()
    };
    (lines.map(row).collect(), serde_json::from_str(&json).unwrap())
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path}: {value}"))
}

/// sin of the sun's altitude, and cosine of its incidence on the façade, which looks to 200°.
fn angles(row: &HashMap<String, f64>) -> [f64; 2] {
    let (altitude, azimuth) = (row["sun_altitude_deg"].to_radians(), row["sun_azimuth_deg"].to_radians());
    [altitude.sin(), altitude.cos() * (azimuth - 200_f64.to_radians()).cos()]
}

#[test]
fn an_open_hole_lets_through_what_its_plane_receives() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let open = "{ ideal = \"transparent\", transmittance = 1.0 }";
    scene(folder, 0.2, [open, open], "");
    let (rows, json) = year(folder);
    let beams = [(800.0, 0.0), (500.0, 0.0), (700.0, 0.0), (800.0, 100.0), (300.0, 200.0), (0.0, 0.0), (0.0, 80.0)];
    for (row, (direct, diffuse)) in rows.iter().zip(beams) {
        let [sine, cosine] = angles(row);
        let horizontal = direct * sine.max(0.0);
        let roof = AREAS[1] * (diffuse + horizontal);
        let wall = row["solar_W"] - roof;
        if diffuse == 0.0 {
            let exact = AREAS[0] * (direct * cosine.max(0.0) + 0.5 * 0.2 * horizontal);
            assert!((wall - exact).abs() <= 1e-3 * exact, "{wall} {exact}");
        } else {
            // What the ground sends is a closed form; of the sky a wall sees less than all and more than nothing.
            let least = AREAS[0] * (direct * cosine.max(0.0) + 0.5 * 0.2 * (diffuse + horizontal));
            assert!(wall > least && wall < least + AREAS[0] * diffuse, "{wall} {least}");
        }
        let (error, whole) = (row["solar_error_W"], row["solar_W"]);
        assert!(error >= 0.0 && error <= 0.01 * whole, "{error} of {whole}");
    }
    let solar = &json["metrics"]["solar"];
    let kilowatt_hours = rows.iter().map(|row| row["solar_W"]).sum::<f64>() / 1000.0;
    let area = AREAS[0] + AREAS[1];
    assert!((number(solar, "/kWh") - kilowatt_hours).abs() < 1e-4 * kilowatt_hours);
    assert!((number(solar, "/kWh_m2") * area / number(solar, "/kWh") - 1.0).abs() < 1e-12);
    assert!((number(solar, "/kWh_m2_floor") * 20.0 / number(solar, "/kWh") - 1.0).abs() < 1e-12);
    let sum = |key: &str| solar[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).sum::<f64>();
    for other in [
        sum("month_kWh_m2"),
        sum("hour_kWh_m2"),
        number(solar, "/summer_kWh_m2") + number(solar, "/winter_kWh_m2"),
        (number(solar, "/apertures/0/kWh") + number(solar, "/apertures/1/kWh")) / area,
    ] {
        assert!((other / number(solar, "/kWh_m2") - 1.0).abs() < 1e-9, "{other}");
    }
    assert!(number(solar, "/month_kWh_m2/6") > 0.0 && number(solar, "/month_kWh_m2/4") == 0.0);
    assert!(number(solar, "/hour_kWh_m2/12") > 0.0 && number(solar, "/hour_kWh_m2/23") == 0.0);
    assert_eq!(solar["source"], "visible taken as solar");
    assert!(number(&json, "/errors/solar/kWh_m2") > 0.0 && number(&json, "/errors/solar/apertures/0/kWh") > 0.0);
}

/// Transmittance of a pane for unpolarised light, Fresnel and Bouguer-Lambert, all reflections inside.
fn pane(index: f64, absorbed: f64, cosine: f64) -> f64 {
    let inside = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let passed = (-absorbed / inside).exp();
    let face = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
    let one = |r: f64| (1.0 - r).powi(2) * passed / (1.0 - (r * passed).powi(2));
    0.5 * (one(face(cosine, index * inside)) + one(face(inside, index * cosine)))
}

#[test]
fn glass_lets_the_sun_through_by_its_solar_absorption() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = "name = \"p\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.006\nabsorption = 5.0\n\
                solar = { absorption = 45.0, index = 1.51 }\n";
    std::fs::write(folder.join("p.system.toml"), text).unwrap();
    let glass = "{ file = \"p.system.toml\" }";
    scene(folder, 0.0, [glass, glass], "");
    let (rows, json) = year(folder);
    for (row, direct) in rows.iter().zip([800.0, 500.0, 700.0]) {
        let [roof, wall] = angles(row);
        let through = |cosine: f64| direct * cosine.max(0.0) * pane(1.51, 0.27, cosine.max(1e-9));
        let exact = AREAS[0] * through(wall) + AREAS[1] * through(roof);
        assert!((row["solar_W"] / exact - 1.0).abs() < 2e-3, "{} {exact}", row["solar_W"]);
    }
    assert_eq!(json["metrics"]["solar"]["source"], "solar data");
    assert_eq!(json["metrics"]["solar"]["apertures"][1]["source"], "solar data");
}

const BLIND: &str = "name = \"b\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\nangles = [30.0]\n\
                     upper = { reflectance = 0.3, specular = 0.2 }\nlower = { reflectance = 0.4 }\n";

#[test]
fn slats_that_are_the_same_in_both_bands_let_the_same_through() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let put = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    put("light.system.toml", BLIND);
    put("same.system.toml", &BLIND.replace(" }", ", solar = {} }"));
    put("part.system.toml", &BLIND.replace("0.4 }", "0.4, solar = { reflectance = 0.6 } }"));
    let energy = |name: &str| {
        let system = format!("{{ file = \"{name}\" }}");
        scene(folder, 0.2, [&system, "{ ideal = \"diffuse\", transmittance = 0.0 }"], "");
        let (rows, json) = year(folder);
        let watts: Vec<f64> = rows.iter().map(|row| row["solar_W"]).collect();
        let own = &json["metrics"]["solar"]["apertures"][0];
        (watts, own["source"].as_str().unwrap().to_owned(), number(own, "/kWh"))
    };
    let (light, same, part) = (energy("light.system.toml"), energy("same.system.toml"), energy("part.system.toml"));
    assert_eq!((light.1.as_str(), same.1.as_str()), ("visible taken as solar", "solar data"));
    assert_eq!(light.0, same.0);
    assert_eq!(part.1, "solar data, partly visible taken as solar");
    assert!(part.2 > 1.02 * light.2, "{} {}", part.2, light.2);
    // The goniophotometer's data say the same as the description, by their own way.
    done(folder, &["goniophotometer", "part.system.toml", "--out", "part.xml"]);
    let by_data = energy("part.xml");
    assert_eq!(by_data.1, part.1);
    assert!((by_data.2 / part.2 - 1.0).abs() < 0.02, "{} {}", by_data.2, part.2);
}

#[test]
fn computed_solar_bands_go_into_files_with_their_mark() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let put = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    put(
        "sheet.system.toml",
        "name = \"d\"\nkind = \"diffuser\"\n[diffuser]\nmodel = \"lambertian\"\ntransmittance = 0.4\nreflectance = 0.4\nsolar = { transmittance = 0.55 }\n",
    );
    let pane = "name = \"p\"\nkind = \"pane\"\n[pane]\nindex = 1.5\nabsorption = 0.0\n";
    put("pane.system.toml", pane);
    put("both.system.toml", &format!("{pane}solar = {{}}\n"));
    let layers = ["both", "sheet", "pane"].map(|name| format!("{{ file = \"{name}.system.toml\" }}")).join(", ");
    put("stack.system.toml", &format!("name = \"s\"\nkind = \"stack\"\n[stack]\nlayers = [{layers}]\n"));
    let (told, _) = done(folder, &["goniophotometer", "stack.system.toml", "--out", "stack.xml", "--json"]);
    let told: Value = serde_json::from_str(&told).unwrap();
    let partly = "solar data, partly visible taken as solar";
    assert_eq!(told["states"][0]["solar"]["source"], partly);
    let (info, _) = done(folder, &["info", "stack.xml", "--json"]);
    let info: Value = serde_json::from_str(&info).unwrap();
    assert_eq!(info["solar_source"], partly);
    let (visible, solar) =
        (number(&info, "/tau_normal_hemispherical"), number(&info, "/solar_tau_normal_hemispherical"));
    assert!(solar > visible + 0.01 && solar < 1.0, "{solar} {visible}");
    assert!((solar - number(&told, "/states/0/solar/tau_normal_hemispherical")).abs() < 1e-6);
    assert!(info["findings"].to_string().contains("visible taken as solar for 1 of 3 materials"), "{info}");
    // In a package too.
    done(folder, &["goniophotometer", "stack.system.toml", "--out", "stack.cfsp"]);
    let (again, _) = done(folder, &["info", "stack.cfsp", "--json"]);
    let again: Value = serde_json::from_str(&again).unwrap();
    assert_eq!(again["solar_source"], partly);
    assert!((number(&again, "/solar_tau_normal_hemispherical") - solar).abs() < 1e-6);
}

#[test]
fn what_a_box_hides_does_not_come_through() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (open, closed) =
        ("{ ideal = \"transparent\", transmittance = 1.0 }", "{ ideal = \"diffuse\", transmittance = 0.0 }");
    scene(folder, 0.0, [open, closed], "");
    let free = year(folder).0;
    // A black wall right before all of the façade, twice as high.
    let wall = "[[outside]]\nbox = { from = [-20.0, -1.01, 0.0], to = [24.0, -1.0, 6.0] }\nreflectance = 0.0\n";
    scene(folder, 0.0, [open, closed], wall);
    let behind = year(folder).0;
    for (row, (free, behind)) in free.iter().zip(&behind).enumerate() {
        let slope = (angles(free)[0] / angles(free)[1].max(1e-9)).max(0.0);
        // The lower edge of the opening is 5 m below the wall's top, the upper one 3.5 m.
        if slope < 3.4 && row < 3 {
            assert!(behind["solar_W"] <= 1e-9, "row {row}: {}", behind["solar_W"]);
        }
        assert!(behind["solar_W"] <= free["solar_W"] * 1.001);
    }
    // The overcast hour is left with the sky above the wall.
    assert!(behind[6]["solar_W"] > 0.0 && behind[6]["solar_W"] < 0.5 * free[6]["solar_W"]);
}

#[test]
fn solar_blocks_of_others_are_read_and_used() {
    let Some(folder) = data("data/bsdf") else { return };
    let here = tempfile::tempdir().unwrap();
    // Sums of the blocks at normal incidence, counted by another program.
    for (name, visible, solar) in [
        ("clear_and_venetian_w7/clear.xml", 0.89741, 0.83125),
        ("clear_and_venetian_w7/ven45.xml", 0.19968, 0.18342),
        ("diffuse_glass_w7/DiffuseGlass.xml", 0.67328, 0.58688),
        ("fabric_satine/2011-SA1.xml", 0.09587, 0.11791),
        ("roman_shade/roman_shade.xml", 0.27906, 0.27585),
    ] {
        let path = folder.join(name).display().to_string();
        let (info, _) = done(here.path(), &["info", &path, "--json"]);
        let info: Value = serde_json::from_str(&info).unwrap();
        assert_eq!(info["solar_source"], "solar data", "{name}");
        for (key, known) in [("/tau_normal_hemispherical", visible), ("/solar_tau_normal_hemispherical", solar)] {
            assert!((number(&info, key) - known).abs() < 2e-5, "{name}{key}: {}", number(&info, key));
        }
    }
    let clear = folder.join("clear_and_venetian_w7/clear.xml").display().to_string();
    let system = format!("{{ file = \"{clear}\" }}");
    scene(here.path(), 0.0, [&system, "{ ideal = \"diffuse\", transmittance = 0.0 }"], "");
    let (rows, json) = year(here.path());
    assert_eq!(json["metrics"]["solar"]["apertures"][0]["source"], "solar data");
    // The sun at 12.5 h in January, at about 30° off the normal: 0.83 there as well.
    let cosine = angles(&rows[0])[1];
    let tau = rows[0]["solar_W"] / (AREAS[0] * 800.0 * cosine);
    assert!((tau - 0.82).abs() < 0.015, "{tau} at {cosine}");
}
