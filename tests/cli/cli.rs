//! The command line as scripts meet it: exit codes, one error line that says what would be right, nothing half-written,
//! tables and JSON as the contract has them.

use crate::rooms::*;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        std::fs::write(self.path(name), text).unwrap();
        self.path(name)
    }

    fn cfs(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_cfs"))
            .args(arguments)
            .current_dir(self.0.path())
            .env("CFS_CATALOGUE", self.path("catalogue.cfsdb"))
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .output()
            .unwrap()
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(self.0.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .filter(|name| !name.starts_with("catalogue.cfsdb"))
            .collect();
        names.sort();
        names
    }
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// Status 2, nothing on standard output, one line that holds all the words.
fn refused(what: &str, output: &Output, words: &[&str]) {
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{what}: {error}");
    assert!(output.stdout.is_empty(), "{what}: {}", text(&output.stdout));
    assert_eq!(error.trim_end_matches('\n').lines().count(), 1, "{what}: {error}");
    for word in words {
        assert!(error.contains(word), "{what}: '{word}' is not in: {error}");
    }
}

fn csv_rows(text: &str) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

#[test]
fn room_writes_the_table_of_the_contract() {
    let folder = Folder::new();
    folder.write("a.toml", &Text { reflectance: [0.2, 0.5, 0.7], ..Text::default() }.toml());
    let output = folder.cfs(&["room", "a.toml", "--out", "a.csv"]);
    assert!(output.status.success() && output.stdout.is_empty(), "{}", text(&output.stderr));
    let table = std::fs::read_to_string(folder.path("a.csv")).unwrap();
    let header = "x,y,z,nx,ny,nz,E_lx,E_direct_lx,E_interreflected_lx,E_error_lx,\
                  E_error_numerical_lx,E_error_data_lx,E_beam_lx";
    assert_eq!(table.lines().next().unwrap(), header);
    let rows = csv_rows(&table);
    assert_eq!(rows.len(), 24);
    // x runs fastest, cell centres.
    assert_eq!(rows[1][..6], [1.5, 0.5, 0.85, 0.0, 0.0, 1.0]);
    for row in &rows {
        assert!((row[6] - row[7] - row[8]).abs() < 1e-5 * row[6] && row[9] >= 0.0 && row[7] > 0.0);
        assert!((row[9] - row[10] - row[11]).abs() <= 1e-6 * row[9] && row[12] == 0.0);
    }
    assert_eq!(folder.names(), ["a.csv", "a.toml"]);
    // The same on standard output.
    assert_eq!(text(&folder.cfs(&["room", "a.toml"]).stdout), table);
}

#[test]
fn room_as_json_says_what_ran_and_why() {
    let folder = Folder::new();
    folder.write("a.toml", &Text { sky: OVERCAST.into(), ..Text::default() }.toml());
    let output = folder.cfs(&["room", "a.toml", "--json"]);
    let value: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(value["sensors"].as_array().unwrap().len(), 24);
    for key in ["position_m", "normal", "E_lx", "E_direct_lx", "E_interreflected_lx", "E_error_lx"] {
        assert!(!value["sensors"][0][key].is_null(), "{key}");
    }
    let stages = value["plan"].as_array().unwrap();
    let stage = |name: &str| stages.iter().find(|stage| stage["stage"] == name).unwrap();
    assert_eq!(stage("sun")["runs"], false);
    assert_eq!(stage("interreflection")["runs"], false);
    assert!(stages.iter().all(|stage| !stage["reason"].as_str().unwrap().is_empty() && stage["seconds"].is_number()));
    assert!(value["flux_lm"].as_f64().unwrap() > 0.0);
}

#[test]
fn sky_writes_the_table_of_the_contract() {
    let folder = Folder::new();
    folder.write("a.toml", &Text { sky: clear(30.0, 200.0, 50_000.0), ..Text::default() }.toml());
    let output = folder.cfs(&["sky", "a.toml", "--out", "sky.csv"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let error = text(&output.stderr);
    assert!(error.contains("horizontal") && error.contains("facade"), "{error}");
    let table = std::fs::read_to_string(folder.path("sky.csv")).unwrap();
    assert_eq!(table.lines().next().unwrap(), "patch,altitude_deg,azimuth_deg,omega_sr,L_centre_cdm2,L_mean_cdm2");
    let rows = csv_rows(&table);
    assert_eq!(rows.len(), 145);
    assert_eq!((rows[0][1], rows[0][2], rows[144][1]), (6.0, 0.0, 90.0));
    assert_eq!(rows[1][2], 12.0);
    let omega: f64 = rows.iter().map(|row| row[3]).sum();
    assert!((omega - 2.0 * std::f64::consts::PI).abs() < 1e-7, "{omega}");
    let json: Value = serde_json::from_slice(&folder.cfs(&["sky", "a.toml", "--json"]).stdout).unwrap();
    let global = json["horizontal"]["global_lx"].as_f64().unwrap();
    assert!((global - (12_000.0 + 50_000.0 * 0.5)).abs() < 1e-3, "{global}");
    assert_eq!(json["patches"].as_array().unwrap().len(), 145);
}

#[test]
fn info_as_json_has_the_keys_of_the_contract() {
    let folder = Folder::new();
    let xml = cfs::formats::write_dataset(cfs::formats::Format::BsdfXml, &[klems(rough)]).unwrap();
    std::fs::write(folder.path("made.xml"), xml.bytes).unwrap();
    let output = folder.cfs(&["info", "made.xml", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let value: Value = serde_json::from_slice(&output.stdout).unwrap();
    let keys = [
        "format",
        "name",
        "manufacturer",
        "incident_basis",
        "emergent_basis",
        "states",
        "components",
        "derived",
        "tau_normal_hemispherical",
        "tau_hemispherical_hemispherical",
        "tau_dir_hem",
        "reciprocity_error",
        "findings",
    ];
    for key in keys {
        assert!(value.get(key).is_some(), "{key} is missing");
    }
    assert!(value["components"].as_array().unwrap().iter().any(|c| c == "transmission_front"));
    let listed = value["tau_dir_hem"].as_array().unwrap();
    assert_eq!(listed.len(), 145);
    for key in ["theta_deg", "phi_deg", "tau"] {
        assert!(listed[7][key].is_number(), "{key}");
    }
    assert_eq!(listed[0]["tau"], value["tau_normal_hemispherical"]);
    for finding in value["findings"].as_array().unwrap() {
        assert!(["info", "warning", "error"].contains(&finding["severity"].as_str().unwrap()));
        assert!(finding["code"].is_string() && finding["message"].is_string());
    }
}

#[test]
fn lid_writes_a_luminaire_file() {
    let folder = Folder::new();
    folder.write("a.toml", &Text::default().toml());
    for name in ["a.ldt", "a.ies"] {
        let output = folder.cfs(&["lid", "a.toml", "--out", name]);
        assert!(output.status.success(), "{name}: {}", text(&output.stderr));
        assert!(std::fs::metadata(folder.path(name)).unwrap().len() > 1000, "{name}");
    }
    refused("lid", &folder.cfs(&["lid", "a.toml", "--out", "a.xyz"]), &["a.xyz"]);
    refused("lid", &folder.cfs(&["lid", "a.toml", "--aperture", "7", "--out", "b.ldt"]), &["a.toml", "aperture", "7"]);
    assert_eq!(folder.names(), ["a.ies", "a.ldt", "a.toml"]);
}

#[test]
fn a_wrong_key_is_named_with_what_would_be_right() {
    let good = Text { sky: clear(30.0, 200.0, 50_000.0), ..Text::default() }.toml();
    let overlap = "[[aperture]]\nsurface = \"facade\"\norigin = [1.0, 1.5]\nsize = [0.5, 0.5]\n\
                   system = { ideal = \"diffuse\", transmittance = 0.5 }\n[site]";
    // What is replaced, by what, and what the message must hold.
    let cases: &[(&str, &str, &str, &[&str])] = &[
        ("unknown key", "width = 4.0", "width = 4.0\nbreadth = 3.0", &["breadth", "line"]),
        ("unknown section", "[site]", "[sight]\nx = 1\n[site]", &["sight"]),
        ("missing key", "depth = 6.0\n", "", &["depth"]),
        ("no number", "width = 4.0", "width = \"wide\"", &["line 2"]),
        ("no TOML", "[sky]", "[sky", &["line"]),
        ("length", "width = 4.0", "width = -4.0", &["room.width", "-4"]),
        ("length not a number", "width = 4.0", "width = nan", &["room.width"]),
        ("length without end", "width = 4.0", "width = inf", &["room.width"]),
        ("reflectance", "floor = 0.0", "floor = 1.2", &["room.reflectance.floor", "1.2", "0 to 1"]),
        ("transmittance", "transmittance = 1.0", "transmittance = 1.5", &["aperture[1]", "transmittance", "1.5"]),
        ("ideal word", "\"transparent\"", "\"clear\"", &["clear", "transparent"]),
        ("surface word", "\"facade\"", "\"wall\"", &["wall", "facade"]),
        ("beyond the wall", "size = [3.0, 1.5]", "size = [3.0, 2.5]", &["aperture[1].size", "3"]),
        ("no area", "size = [3.0, 1.5]", "size = [0.0, 1.5]", &["aperture[1].size"]),
        ("overlap", "[site]", overlap, &["aperture[2].origin", "overlaps aperture 1"]),
        ("ground", "ground_reflectance = 0.0", "ground_reflectance = 7.0", &["site.ground_reflectance", "7"]),
        ("sky type", "type = 12", "type = 17", &["sky.type", "17", "16"]),
        ("sky type missing", "type = 12\n", "", &["sky.type"]),
        ("illuminance", "diffuse_horizontal = 12000.0", "diffuse_horizontal = -1.0", &["sky.diffuse_horizontal"]),
        ("turbidity", "type = 12", "type = 12\nturbidity = 0.0", &["sky.turbidity", "1 to 12"]),
        ("illuminance word", "type = 12", "type = 12\nilluminance = \"sunny\"", &["sunny", "clear-sky"]),
        ("elevation", "[site]", "[site]\nelevation = 99999.0", &["site.elevation", "9000"]),
        ("night", "altitude = 30.0", "altitude = -12.0", &["sky.diffuse_horizontal", "12.0° below the horizon"]),
        ("altitude", "altitude = 30.0", "altitude = 95.0", &["sky.sun.altitude", "95"]),
        ("azimuth missing", ", azimuth = 200.0", "", &["sky.sun.azimuth"]),
        ("plane", "z = 0.85", "z = 3.5", &["sensors.plane.z", "3.5"]),
        ("no cells", "nx = 4", "nx = 0", &["sensors.plane.nx"]),
        ("too many cells", "nx = 4", "nx = 4000000000", &["sensors.plane.nx"]),
        ("negative cells", "nx = 4", "nx = -4", &["line"]),
        ("error target", "[compute]", "[compute]\nerror_target = 2.0", &["compute.error_target", "2"]),
        ("interpolation", "[compute]", "[compute]\ninterpolation = \"wild\"", &["wild", "patch"]),
        (
            "word gone",
            "[compute]",
            "[compute]\nsun_interpolation = \"transport\"",
            &["sun_interpolation", "superposed"],
        ),
        ("control word", "[compute]", "[control]\nmode = \"open\"\n[compute]", &["open", "cut-off"]),
        ("missing file", TRANSPARENT, "{ file = \"none.xml\" }", &["aperture[1].system", "none.xml"]),
        ("missing product", TRANSPARENT, "{ catalogue = \"no-such\" }", &["aperture[1].system", "no-such"]),
        ("two systems", TRANSPARENT, "{ file = \"a.xml\", catalogue = \"b\" }", &["exactly one of"]),
    ];
    let folder = Folder::new();
    for (what, from, to, words) in cases {
        assert!(good.contains(from), "{what}");
        folder.write("bad.toml", &good.replacen(from, to, 1));
        let mut words = words.to_vec();
        words.push("bad.toml");
        refused(what, &folder.cfs(&["room", "bad.toml", "--out", "out.csv"]), &words);
        assert_eq!(folder.names(), ["bad.toml"], "{what}");
    }
}

#[test]
fn skies_that_follow_the_sun_say_with_what_they_are_computed_or_that_it_is_dark() {
    let folder = Folder::new();
    let at = |altitude: &str| {
        let sky = format!(
            "model = \"cie\"\ntype = 12\nilluminance = \"clear-sky\"\nturbidity = 3.0\ndiffuse_horizontal = 12900.0\n\
             sun = {{ altitude = {altitude}, azimuth = 180.0, direct_normal = 90400.0 }}"
        );
        folder.write("a.toml", &Text { sky, ..Text::default() }.toml());
        let room = folder.cfs(&["room", "a.toml", "--json"]);
        let sky = folder.cfs(&["sky", "a.toml", "--json"]);
        assert!(room.status.success() && sky.status.success(), "{}", text(&room.stderr));
        let told = text(&room.stderr).to_owned() + text(&sky.stderr);
        let read = |output: &Output| -> Value { serde_json::from_slice(&output.stdout).unwrap() };
        (read(&room), read(&sky), told)
    };
    let (room, sky, told) = at("20.0");
    // Ineichen and Perez 2002 at 20° and turbidity 3, sea level: between the figures for 15° and 25°.
    let diffuse = sky["horizontal"]["diffuse_lx"].as_f64().unwrap();
    assert!((8071.0..10_500.0).contains(&diffuse), "{diffuse}");
    assert_eq!(room["illuminance"]["diffuse_horizontal_lx"], sky["horizontal"]["diffuse_lx"]);
    assert_eq!(
        told.matches("note: clear sky, Linke turbidity 3, 0 m above the sea, sun 20.0° high").count(),
        2,
        "{told}"
    );
    let (room, sky, told) = at("-12.0");
    assert_eq!(sky["horizontal"]["global_lx"].as_f64(), Some(0.0));
    assert_eq!(told.matches("12.0° below the horizon: no daylight").count(), 2, "{told}");
    let sensors = room["sensors"].as_array().unwrap();
    assert!(!sensors.is_empty() && sensors.iter().all(|sensor| sensor["E_lx"].as_f64() == Some(0.0)));
    // A luminaire file's header tells what is computed with, not what is written and not read.
    drop(at("20.0"));
    let lid = folder.cfs(&["lid", "a.toml", "--out", "a.ies"]);
    assert!(lid.status.success() && text(&lid.stderr).contains("note: clear sky"), "{}", text(&lid.stderr));
    let header = std::fs::read_to_string(folder.path("a.ies")).unwrap().replace("\r\n[MORE]", "");
    assert!(header.contains(&format!("E_dh {diffuse:.0} lx")) && !header.contains("12900"), "{}", &header[..1500]);
}

#[test]
fn sensors_outside_the_room_are_named() {
    let folder = Folder::new();
    for point in [[5.0, 1.0, 1.0], [1.0, -0.1, 1.0], [1.0, 1.0, 3.1], [1.0, f64::NAN, 1.0]] {
        let list = [[1.0, 1.0, 1.0], point];
        folder.write(
            "a.toml",
            &Text { sensors: points(&list, [0.0, 0.0, 1.0]).replace("NaN", "nan"), ..Text::default() }.toml(),
        );
        refused("outside", &folder.cfs(&["room", "a.toml"]), &["a.toml", "sensors.points[2]", "room"]);
    }
    folder.write("a.toml", &Text { sensors: points(&[[1.0; 3]], [0.0; 3]), ..Text::default() }.toml());
    refused("normal", &folder.cfs(&["room", "a.toml"]), &["sensors.normal"]);
    folder.write("a.toml", &Text { sensors: String::new(), ..Text::default() }.toml());
    refused("none", &folder.cfs(&["room", "a.toml"]), &["sensors"]);
}

#[test]
fn files_that_are_not_there_or_not_what_they_should_be() {
    let folder = Folder::new();
    for command in [&["room", "none.toml"][..], &["sky", "none.toml"], &["lid", "none.toml", "--out", "a.ldt"]] {
        refused("missing", &folder.cfs(command), &["none.toml"]);
    }
    refused("missing", &folder.cfs(&["info", "none.xml"]), &["none.xml"]);
    refused("missing", &folder.cfs(&["convert", "none.xml", "copy.xml"]), &["none.xml"]);
    std::fs::write(folder.path("noise.bin"), [0xff, 0x00, 0xfe, 0x80]).unwrap();
    refused("noise", &folder.cfs(&["room", "noise.bin"]), &["noise.bin"]);
    refused("noise", &folder.cfs(&["info", "noise.bin"]), &["noise.bin"]);
    std::fs::create_dir(folder.path("folder")).unwrap();
    refused("folder", &folder.cfs(&["room", "folder"]), &["folder"]);
    folder.write("good.toml", &Text::default().toml());
    refused("target", &folder.cfs(&["room", "good.toml", "--out", "no/such/place.csv"]), &["place.csv"]);
    refused("target", &folder.cfs(&["room", "good.toml", "--out", "folder"]), &["folder"]);
    assert_eq!(folder.names(), ["folder", "good.toml", "noise.bin"]);
}

#[test]
fn an_old_result_survives_a_failed_run() {
    let folder = Folder::new();
    let table = "x,E_lx\n1,2\n";
    folder.write("a.csv", table);
    folder.write("bad.toml", "nonsense = 1");
    refused("bad", &folder.cfs(&["room", "bad.toml", "--out", "a.csv"]), &["nonsense"]);
    assert_eq!(std::fs::read_to_string(folder.path("a.csv")).unwrap(), table);
}

#[test]
fn a_room_that_absorbs_nothing_is_refused_with_the_file_and_the_key() {
    let folder = Folder::new();
    let aperture = format!("{}\nreflectance = 1.0", facade([0.5, 1.0], [3.0, 1.5], DIFFUSE));
    folder.write("a.toml", &Text { reflectance: [1.0; 3], apertures: vec![aperture], ..Text::default() }.toml());
    refused("sealed", &folder.cfs(&["room", "a.toml"]), &["a.toml", "room.reflectance"]);
}

#[test]
fn arguments_that_clap_refuses_end_with_two_as_well() {
    let folder = Folder::new();
    for arguments in [&["rooom"][..], &["room"], &["room", "a.toml", "--frobnicate"]] {
        let output = folder.cfs(arguments);
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    }
    let help = folder.cfs(&["--help"]);
    assert!(help.status.success() && text(&help.stdout).contains("Exit status:"));
    assert!(folder.cfs(&["--version"]).status.success());
}

#[test]
fn limits_are_printed_one_per_line() {
    let output = Folder::new().cfs(&["limits"]);
    let lines: Vec<&str> = text(&output.stdout).lines().collect();
    assert_eq!(lines.len(), cfs::compute::limits::TABLE.len());
    assert!(output.status.success() && lines.contains(&"sensors of a scene: at most 1000000"), "{lines:?}");
}

#[test]
fn json_of_many_sensors_is_one_object_set_like_any_other() {
    let folder = Folder::new();
    let sensors = "plane = { z = 0.85, nx = 70, ny = 60 }".to_owned();
    folder.write("many.toml", &Text { sensors, sky: UNIFORM.into(), ..Text::default() }.toml());
    let output = folder.cfs(&["room", "many.toml", "--json"]);
    let printed = text(&output.stdout);
    let value: Value = serde_json::from_str(printed).unwrap();
    assert_eq!(value["sensors"].as_array().map(Vec::len), Some(4200));
    // Numbers may be read to another last digit; everything else stands where the usual print has it.
    let plain = |text: &str| text.chars().filter(|c| !c.is_ascii_digit() && *c != '.').collect::<String>();
    assert_eq!(plain(printed), plain(&format!("{value:#}\n")));
}

#[test]
fn results_do_not_depend_on_where_the_program_is_run() {
    let folder = Folder::new();
    let xml = cfs::formats::write_dataset(cfs::formats::Format::BsdfXml, &[klems(rough)]).unwrap();
    std::fs::create_dir(folder.path("data")).unwrap();
    std::fs::write(folder.path("data/made.xml"), xml.bytes).unwrap();
    let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], "{ file = \"made.xml\" }")];
    folder.write("data/a.toml", &Text { apertures, ..Text::default() }.toml());
    let here = folder.cfs(&["room", "data/a.toml"]);
    assert!(here.status.success(), "{}", text(&here.stderr));
    let there = Command::new(env!("CARGO_BIN_EXE_cfs"))
        .args(["room".as_ref(), folder.path("data/a.toml").as_os_str()])
        .current_dir(Path::new("/"))
        .output()
        .unwrap();
    assert_eq!(here.stdout, there.stdout);
}

/// Six incidences of a listed dataset on two rings; those from above send their light up, all others down.
fn measured() -> String {
    let mut text = String::from(
        "---\nformat = \"cfs-btdf 1\"\nname = \"Sample\"\nquantity = \"btdf\"\nlight_from = \"outside\"\nlayout = \"rings\"\n\
         rings = [[90.0, 150.0, 4], [150.0, 180.0, 1]]\nincidence = \"listed\"\nincident_mean = false\n---\n",
    );
    for (theta, phi) in [(60, 90), (60, 270), (30, 45), (30, 225), (0, 0), (80, 180)] {
        let row = if phi == 90 { "0 0.3 0 0.01 0.02" } else { "0 0.01 0 0.2 0.02" };
        text += &format!("{theta} {phi} {row}\n");
    }
    text
}

#[test]
fn a_measured_dataset_is_described_converted_and_imported() {
    let folder = Folder::new();
    folder.write("a.btdf.txt", &measured());
    let output = folder.cfs(&["info", "a.btdf.txt", "--json"]);
    let info: Value = serde_json::from_slice(&output.stdout).unwrap();
    let listed = info["tau_dir_hem"].as_array().unwrap();
    let angles: Vec<[f64; 2]> =
        listed.iter().map(|row| ["theta_deg", "phi_deg"].map(|key| row[key].as_f64().unwrap())).collect();
    assert_eq!(angles, [[60.0, 90.0], [60.0, 270.0], [30.0, 45.0], [30.0, 225.0], [0.0, 0.0], [80.0, 180.0]]);
    // Sectors of a quarter between θ' 30° and 90°, and the cap: π/4 (1 − 1/4), π/4.
    let quarter = std::f64::consts::PI * 0.75 / 4.0;
    let expected = quarter * (0.3 + 0.01) + std::f64::consts::PI / 4.0 * 0.02;
    assert!((listed[0]["tau"].as_f64().unwrap() - expected).abs() < 1e-12);
    assert_eq!(info["incident_basis"], "listed");
    let text = folder.cfs(&["info", "a.btdf.txt"]);
    assert!(String::from_utf8_lossy(&text.stdout).contains("6 incident directions × 5 emergent cells"));
    // There and back is the identity; the other format averages and says so.
    assert!(folder.cfs(&["convert", "a.btdf.txt", "b.btdf.txt"]).status.success());
    assert!(folder.cfs(&["convert", "b.btdf.txt", "c.btdf.txt"]).status.success());
    assert_eq!(std::fs::read(folder.path("b.btdf.txt")).unwrap(), std::fs::read(folder.path("c.btdf.txt")).unwrap());
    let xml = folder.cfs(&["convert", "a.btdf.txt", "a.xml"]);
    assert!(xml.status.success() && String::from_utf8_lossy(&xml.stderr).contains("averaged"));
    refused(
        "component",
        &folder.cfs(&["convert", "a.btdf.txt", "d.btdf.txt", "--component", "reflection_back"]),
        &["reflection_back", "transmission_front"],
    );
    let second = measured().replace("layout", "state = \"open\"\nlayout");
    folder.write("b.btdf.txt", &second);
    let import = folder.cfs(&["catalogue", "import", "a.btdf.txt", "b.btdf.txt"]);
    assert_eq!(String::from_utf8_lossy(&import.stdout), "sample\n");
    let shown = folder.cfs(&["catalogue", "show", "sample", "--json"]);
    let shown: Value = serde_json::from_slice(&shown.stdout).unwrap();
    let keys: Vec<&str> = shown["states"].as_array().unwrap().iter().map(|s| s["key"].as_str().unwrap()).collect();
    assert_eq!(keys, ["a", "open"]);
    assert!(folder.cfs(&["catalogue", "validate", "a.btdf.txt"]).status.success());
    folder.write("bad.btdf.txt", &measured().replace("30 45 0 0.01", "30 45 0 -0.01"));
    refused("negative", &folder.cfs(&["info", "bad.btdf.txt"]), &["bad.btdf.txt", "line 13", "negative"]);
}

#[test]
fn a_luminaire_file_is_described() {
    let folder = Folder::new();
    // 100 cd in every direction of the lower hemisphere: 2π·100 lm. One plane for all, γ 0, 45, 90.
    let mut lines = vec!["IESNA:LM-63-2002", "[TEST] T1", "[MANUFAC] Maker", "[LUMINAIRE] Lamp", "TILT=NONE"];
    lines.extend(["1 -1 1 3 1 1 2 0.5 0.25 0.1", "1 1 40", "0 45 90", "0", "100 100 100"]);
    folder.write("lamp.ies", &(lines.join("\r\n") + "\r\n"));
    let output = folder.cfs(&["info", "lamp.ies", "--json"]);
    let info: Value = serde_json::from_slice(&output.stdout).unwrap();
    let flux = info["flux_lm"].as_f64().unwrap();
    assert!((flux - 200.0 * std::f64::consts::PI).abs() < 1e-9, "{flux}");
    assert_eq!((info["name"].as_str(), info["symmetry"].as_str()), (Some("Lamp"), Some("rotational")));
    assert_eq!((info["planes"].as_u64(), info["angles"].as_u64()), (Some(1), Some(3)));
    let text = folder.cfs(&["info", "lamp.ies"]);
    assert!(String::from_utf8_lossy(&text.stdout).contains("628.3 lm"));
    folder.write("bad.ldt", "nothing");
    refused("no luminaire", &folder.cfs(&["info", "bad.ldt"]), &["bad.ldt"]);
}

#[test]
fn accuracy_writes_table_csv_and_picture() {
    let folder = Folder::new();
    let sensors = points(&[[2.0, 2.0, 0.85], [2.0, 0.5, 0.85]], [0.0, 0.0, 1.0]);
    folder.write("a.toml", &Text { sensors, ..Text::default() }.toml());
    let output = folder.cfs(&["accuracy", "a.toml", "--csv", "a.csv", "--plot", "a.svg"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    for word in
        ["error target 1 %", "64 × 64 point luminaires", "numerical error against this method's finest run", "Reached"]
    {
        assert!(text(&output.stdout).contains(word), "{word}");
    }
    let mut reader = csv::Reader::from_path(folder.path("a.csv")).unwrap();
    assert_eq!(reader.headers().unwrap().len(), 15);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 5 + 8 + 6 + 4);
    assert!(rows.iter().all(|row| row[5].parse::<f64>().unwrap() > 0.0 && row[6].is_empty()));
    assert!(std::fs::read_to_string(folder.path("a.svg")).unwrap().contains("monte-carlo"));
    refused("plot", &folder.cfs(&["accuracy", "a.toml", "--plot", "a.pdf"]), &["a.pdf", ".svg or .png"]);
}
