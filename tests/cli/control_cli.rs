//! `cfs control` and the keys of `[control]` as scripts meet them.

use crate::rooms::*;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.path().join(name)).unwrap()
    }

    fn cfs(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_cfs"))
            .args(arguments)
            .current_dir(self.0.path())
            .env("CFS_CATALOGUE", self.0.path().join("catalogue.cfsdb"))
            .env_remove("DISPLAY")
            .output()
            .unwrap()
    }
}

const BLIND: &str = "{ catalogue = \"venetian-80-72\", state = \"controlled\" }";

/// A scene of Stuttgart with one blind or two, and a control section.
fn scene(control: &str, apertures: Vec<String>) -> String {
    let text = Text { apertures, sky: clear(30.0, 180.0, 60_000.0), ..Text::default() }.toml();
    let place = "[site]\nlatitude = 48.8\nlongitude = 9.2\nutc_offset = 1.0\n";
    assert!(text.contains("[site]\n"));
    format!("{}\n{control}\n", text.replacen("[site]\n", place, 1))
}

fn one(control: &str) -> String {
    scene(control, vec![facade([0.5, 1.0], [3.0, 1.5], BLIND)])
}

/// Columns by name.
fn table(text: &str) -> Vec<std::collections::HashMap<String, String>> {
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            assert_eq!(fields.len(), head.len(), "{line}");
            head.iter().zip(fields).map(|(name, field)| ((*name).to_owned(), field.to_owned())).collect()
        })
        .collect()
}

fn words(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_year_of_cut_off_is_a_table_that_lets_no_sun_in() {
    let folder = Folder::new();
    folder.write("a.toml", &one("[control]\nmode = \"cut-off\""));
    let output = folder.cfs(&["control", "a.toml", "--out", "year.csv", "--json"]);
    assert!(output.status.success(), "{}", words(&output));
    let rows = table(&folder.read("year.csv"));
    assert_eq!(rows.len(), 8760);
    assert_eq!(rows[0]["time"], "2026-01-01T00:30:00");
    let number = |row: &std::collections::HashMap<String, String>, name: &str| row[name].parse::<f64>().ok();
    let (mut sunny, mut moves, mut before) = (0, 0, rows[0]["state_1"].clone());
    for row in &rows {
        assert_eq!(row["direct_sun_1"], "0");
        moves += usize::from(std::mem::replace(&mut before, row["state_1"].clone()) != row["state_1"]);
        let Some(psi) = number(row, "profile_angle_deg_1") else {
            assert_eq!(row["state_1"], "0");
            continue;
        };
        sunny += 1;
        // tan ψ = tan h / cos Δ, where the sun is well in front.
        let [h, az] = ["sun_altitude_deg", "sun_azimuth_deg"].map(|name| number(row, name).unwrap().to_radians());
        let front = (az - std::f64::consts::PI).cos();
        if front > 0.1 && h > 0.01 {
            assert!(((h.tan() / front).atan().to_degrees() - psi).abs() < 1e-3, "{row:?}");
        }
        let exact = ((0.9 * psi.to_radians().cos()).asin().to_degrees() - psi).max(0.0);
        let state: f64 = row["state_1"].parse().unwrap();
        assert!(state >= exact - 1e-9 && number(row, "demanded_1").unwrap() <= state + 1e-9, "{row:?}");
        assert_eq!(row["reason_1"], "sun");
    }
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let first = &json["apertures"][0];
    assert_eq!(first["movements"].as_u64(), Some(moves as u64));
    assert_eq!(first["sun_hours"].as_f64(), Some(f64::from(sunny)));
    assert_eq!(first["direct_sun_hours"].as_f64(), Some(0.0));
    assert!(sunny > 2500 && moves > 1000, "{sunny} {moves}");
}

#[test]
fn two_parts_of_a_window_follow_two_rules() {
    let folder = Folder::new();
    folder.write("retro.csv", "profile_angle_deg,value_deg\n0,75\n15,75\n90,0\n");
    let lower = format!(
        "{}\ncontrol = {{ mode = \"curve\", curve_file = \"retro.csv\" }}",
        facade([0.5, 0.5], [3.0, 1.0], BLIND)
    );
    let upper =
        format!("{}\ncontrol = {{ mode = \"redirect\", elevation = 50.0 }}", facade([0.5, 1.6], [3.0, 0.6], BLIND));
    folder.write("a.toml", &scene("[control]\nmode = \"fixed\"", vec![lower, upper]));
    let output = folder.cfs(&["control", "a.toml", "--step", "120"]);
    assert!(output.status.success(), "{}", words(&output));
    let rows = table(std::str::from_utf8(&output.stdout).unwrap());
    assert_eq!(rows.len(), 4380);
    let mut seen = 0;
    for row in &rows {
        let Ok(psi) = row["profile_angle_deg_1"].parse::<f64>() else { continue };
        // Not with the sun so far to the side that its disc covers degrees of the section.
        let side = row["sun_azimuth_deg"].parse::<f64>().unwrap() - 180.0;
        if !(20.0..80.0).contains(&psi) || side.abs() > 60.0 {
            continue;
        }
        seen += 1;
        let [lower, upper]: [f64; 2] = ["state_1", "state_2"].map(|name| row[name].parse().unwrap());
        // The line through (15, 75) and (90, 0), up to the next 5°; half of 50° − ψ, the nearest 5° from horizontal on.
        assert!(lower >= 90.0 - psi - 0.3 && lower < 90.0 - psi + 6.0, "{row:?}");
        assert!((upper - (0.5 * (50.0 - psi)).max(0.0)).abs() <= 2.5 + 1e-3, "{row:?}");
    }
    assert!(seen > 500);
    // The room of one moment takes both.
    let room = folder.cfs(&["room", "a.toml"]);
    assert!(room.status.success(), "{}", words(&room));
}

#[test]
fn rules_of_a_moment_pick_what_they_say() {
    let folder = Folder::new();
    let library = cfs::study::Library::with_catalogue(Some(&folder.0.path().join("catalogue.cfsdb")));
    let state = |control: &str| {
        let file = cfs::study::SceneFile::parse(&one(&format!("[control]\n{control}"))).unwrap();
        // What is written says the same.
        let again = cfs::study::SceneFile::parse(&toml::to_string(&file).unwrap()).unwrap();
        assert_eq!(again, file);
        cfs::study::Scene::resolve(&file, Path::new("."), &library).unwrap().apertures[0].system.state.clone()
    };
    // Sun straight ahead at 30°: cut-off 21.2°, with the disc 21.6°.
    assert_eq!(state("mode = \"cut-off\""), "25");
    assert_eq!(state("mode = \"cut-off\"\ntolerance = 4.0"), "30");
    // Narrower slats must turn further: asin(72/75 cos 30°) − 30° = 26.3°.
    assert_eq!(state("mode = \"cut-off\"\nslats = { width = 0.075, spacing = 0.072 }"), "30");
    // Deep arcs shade more than their chord: acos(1 − s/R cos ψ) − η − ψ = 16.5°.
    assert_eq!(state("mode = \"cut-off\"\nslats = { width = 0.08, spacing = 0.072, rise = 0.03 }"), "20");
    assert_eq!(state("mode = \"retro-reflect\""), "60");
    assert_eq!(state("mode = \"redirect\"\nelevation = 60.0"), "15");
    assert_eq!(state("mode = \"curve\"\ncurve = [[0.0, 50.0], [60.0, 10.0]]"), "35");
    assert_eq!(state("mode = \"curve\"\nrounding = \"nearest\"\ncurve = [[0.0, 52.0], [60.0, 12.0]]"), "30");
    assert_eq!(state("mode = \"din-5034\""), "75");
    assert_eq!(state("mode = \"din-5034\"\nthreshold = 80000.0"), "0");
    assert_eq!(state("mode = \"din-5034\"\nclosed_state = \"45\""), "45");
    assert_eq!(state("mode = \"din-5034\"\nopen_below = 300.0\nindoor = 100.0"), "0");
    assert_eq!(state("mode = \"cut-off\"\nclose_above = 40000.0"), "75");
    assert_eq!(state("mode = \"cut-off\"\nclose_above = 40000.0\nopen_below = 300.0\nindoor = 100.0"), "25");
    assert_eq!(state("mode = \"fixed\""), "0");
    assert_eq!(state("mode = \"fixed\"\nstate = \"40\""), "40");
    assert_eq!(state("mode = \"user\"\nstate = \"20\""), "20");
}

#[test]
fn wrong_keys_are_told_with_what_would_be_right() {
    let folder = Folder::new();
    folder.write("bad.csv", "profile_angle_deg,value_deg\n30,1\n20,2\n");
    for (control, expected) in [
        ("mode = \"cut-off\"\nelevation = 30.0", vec!["control.elevation", "redirect"]),
        ("mode = \"cut-off\"\nslats = { spacing = 0.07 }", vec!["control.slats", "width"]),
        ("mode = \"cut-off\"\nslats = { width = -1.0, spacing = 0.07 }", vec!["control.slats", "above 0"]),
        ("mode = \"cut-off\"\ntolerance = 90.0", vec!["control.tolerance", "45"]),
        ("mode = \"curve\"\ncurve = [[10.0, 1.0], [5.0, 2.0]]", vec!["control.curve", "rise"]),
        ("mode = \"curve\"\ncurve_file = \"bad.csv\"", vec!["control.curve_file", "bad.csv", "line 3"]),
        ("mode = \"curve\"\ncurve_file = \"none.csv\"", vec!["control.curve_file", "none.csv"]),
        ("mode = \"fixed\"\nstate = \"41\"", vec!["control.state", "41", "45"]),
        ("mode = \"user\"\nschedule = [{ from = \"8\", to = \"9:00\", state = \"0\" }]", vec!["schedule", "HH:MM"]),
        (
            "mode = \"user\"\nschedule = [{ from = \"22:00\", to = \"06:00\", state = \"0\" },\
             { from = \"05:30\", to = \"09:00\", state = \"45\" }]",
            vec!["control.schedule", "22:00 to 06:00", "05:30 to 09:00", "overlap"],
        ),
        ("mode = \"cut-off\"\ndwell = -1.0", vec!["control.dwell", "-1"]),
        ("mode = \"cut-off\"\nnight_state = \"shut\"", vec!["control.night_state", "shut"]),
    ] {
        folder.write("a.toml", &one(&format!("[control]\n{control}")));
        for command in [&["control", "a.toml"][..], &["room", "a.toml"]] {
            let output = folder.cfs(command);
            let error = words(&output);
            assert_eq!(output.status.code(), Some(2), "{control}: {error}");
            assert!(output.stdout.is_empty() && error.trim_end().lines().count() == 1, "{control}: {error}");
            for word in &expected {
                assert!(error.contains(word) && error.contains("a.toml"), "{control}: '{word}' is not in {error}");
            }
        }
    }
    folder.write("a.toml", &scene("[control]\nmode = \"cut-off\"", vec![facade([0.5, 1.0], [3.0, 1.5], TRANSPARENT)]));
    let still = folder.cfs(&["control", "a.toml"]);
    assert!(still.status.code() == Some(2) && words(&still).contains("controlled"), "{}", words(&still));
    folder.write("a.toml", &one("[control]\nmode = \"cut-off\"").replace("latitude = 48.8\n", ""));
    let nowhere = folder.cfs(&["control", "a.toml"]);
    assert!(nowhere.status.code() == Some(2) && words(&nowhere).contains("site.latitude"), "{}", words(&nowhere));
    folder.write("a.toml", &one("[control]\nmode = \"cut-off\""));
    let step = folder.cfs(&["control", "a.toml", "--step", "7"]);
    assert!(step.status.code() == Some(2) && words(&step).contains("divide"), "{}", words(&step));
}
