//! What a year is asked beside its hours on the command line: LM-83's blinds, hours kept over an end, its accuracy.

use crate::program::cfs;
use cfs::compute::estimate::Progress;
use cfs::study::fingerprint::of_results;
use cfs::study::year::{Kept, year_kept};
use cfs::study::{Library, Session, read_scene_file};
use serde_json::Value;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A room without reflections before Renton's weather.
fn scene(folder: &Path, system: &str, year: &str) {
    let text = format!(
        "[room]\nwidth = 4.0\ndepth = 5.0\nheight = 3.0\nreflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 1.0]\nsize = [3.0, 1.8]\nreflectance = 0.0\nsystem = {system}\n\
         [site]\nazimuth = 200.0\nlatitude = 47.48\nlongitude = -122.22\nutc_offset = -8.0\nground_reflectance = 0.2\n\
         [sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 1.0\n[sensors]\nplane = {{ z = 0.85, nx = 2, ny = 2 }}\n\
         [compute]\ninterreflection = false\n[year]\nweather = \"builtin:renton\"\n{year}"
    );
    std::fs::write(folder.join("scene.toml"), text).unwrap();
}

const EVEN: &str = "{ ideal = \"diffuse\", transmittance = 0.5 }";

fn done(folder: &Path, command: &[&str]) -> (String, String) {
    let output = cfs(folder, command);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{command:?}: {told}");
    (String::from_utf8(output.stdout).unwrap(), told)
}

fn json(folder: &Path, command: &[&str]) -> Value {
    serde_json::from_str(&done(folder, command).0).unwrap()
}

#[test]
fn blinds_by_lm_83_are_told_where_they_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let command = ["year", "scene.toml", "--month", "9", "--out", "hours.csv", "--json"];
    scene(folder, EVEN, "");
    let without = json(folder, &command);
    assert!(without["metrics"].get("sDA300_50_LM83_12").is_none() && without["lm83"].is_null());
    assert!(without["left_out"].to_string().contains("lm83 = true"), "{without}");
    // Nothing comes straight through: nothing closes, and the figure is the other one.
    scene(folder, EVEN, "lm83 = true\n");
    let even = json(folder, &command);
    assert_eq!(even["metrics"]["sDA300_50_LM83_12"], even["metrics"]["sDA300_50"]);
    assert_eq!(even["metrics"]["blinds_closed_hours"], serde_json::json!([0.0]));
    assert_eq!(even["errors"]["blinds_closed_hours"], serde_json::json!([0.0]));
    // A shade of 5 % before an open hole in the sun.
    scene(folder, "{ ideal = \"transparent\", transmittance = 1.0 }", "lm83 = true\n");
    let open = json(folder, &command);
    let hours = open["metrics"]["blinds_closed_hours"][0].as_f64().unwrap();
    assert!((10.0..=300.0).contains(&hours), "{hours}");
    let group = &open["lm83"]["groups"][0];
    assert_eq!((&group["apertures"], &group["closed_hours"]), (&serde_json::json!([1]), &hours.into()));
    assert!(group["closed"].as_str().unwrap().contains("0.05"), "{group}");
    assert!(open["notes"].to_string().contains("nothing moves in aperture 1"), "{open}");
    let figure = |key: &str| open["metrics"][key].as_f64().unwrap();
    assert!(figure("sDA300_50_LM83_12") <= figure("sDA300_50"));
}

/// Ends the work after the first block of hours.
struct Ended(AtomicBool);

impl Progress for Ended {
    fn advance(&self, stage: &'static str, done: usize, _: usize) {
        if stage == "hours" && done > 64 {
            self.0.store(true, Ordering::Relaxed);
        }
    }

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

#[test]
fn a_year_that_was_ended_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    scene(folder, "{ ideal = \"transparent\", transmittance = 0.8 }", "");
    let command = ["year", "scene.toml", "--month", "3", "--out", "hours.csv", "--json"];
    let mut whole = json(folder, &command);
    let table = std::fs::read(folder.join("hours.csv")).unwrap();
    std::fs::remove_file(folder.join("hours.csv")).unwrap();
    let begin = || {
        let file = read_scene_file(&folder.join("scene.toml")).unwrap();
        let library = Library::default();
        let fingerprint = of_results(&file, folder, &library).unwrap();
        let mut kept = Kept::beside(&folder.join("hours.csv"), fingerprint, Duration::ZERO, false).unwrap();
        let wanted = |step: &cfs::study::year::Step| step.month == 3;
        let ended = Ended(AtomicBool::new(false));
        year_kept(&file, folder, &library, &Session::new(), &wanted, &mut kept, &ended).unwrap_err();
        kept.count()
    };
    let part = folder.join("hours.csv.part");
    let count = begin();
    assert!(count >= 64 && part.exists());
    // Torn in the middle of a line.
    let text = std::fs::read(&part).unwrap();
    std::fs::write(&part, &text[..text.len() - 5]).unwrap();
    let (text, told) = done(folder, &command);
    assert!(told.contains(&format!("hours.csv.part: resumes after {} hours", count - 1)), "{told}");
    assert_eq!(std::fs::read(folder.join("hours.csv")).unwrap(), table);
    let mut again: Value = serde_json::from_str(&text).unwrap();
    for one in [&mut whole, &mut again] {
        one["seconds"] = Value::Null;
    }
    assert_eq!(again, whole);
    assert!(!part.exists());
    // Of another scene.
    begin();
    scene(folder, "{ ideal = \"transparent\", transmittance = 0.7 }", "");
    let output = cfs(folder, &command);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!((output.status.code(), told.lines().count()), (Some(2), 1), "{told}");
    assert!(told.contains("hours.csv.part") && told.contains("another scene") && told.contains("--force"), "{told}");
    assert_eq!(std::fs::read(folder.join("hours.csv")).unwrap(), table);
    done(folder, &[&command[..], &["--force"]].concat());
    assert!(!part.exists() && std::fs::read(folder.join("hours.csv")).unwrap() != table);
}

#[test]
fn the_accuracy_of_a_year_is_told_by_effort() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    scene(folder, EVEN, "[year.lighting]\npower = 8.0\ntarget = 500.0\n");
    let weather = "place Test\nlatitude 47.48\nlongitude 122.22\ntime_zone 120\nsite_elevation 0\nweather_data_file_units 1\n\
                   3 21 10.5 300 120\n6 21 12.5 700 110\n6 21 23.5 0 0\n11 2 11.5 0 90\n";
    std::fs::write(folder.join("w.wea"), weather).unwrap();
    let text = std::fs::read_to_string(folder.join("scene.toml")).unwrap().replace("builtin:renton", "w.wea");
    std::fs::write(folder.join("scene.toml"), text).unwrap();
    let found = json(folder, &["accuracy", "scene.toml", "--year", "--csv", "years.csv", "--json"]);
    let years = found["years"].as_array().unwrap();
    assert_eq!(
        (found["steps"].as_u64(), found["lit_steps"].as_u64(), found["places"].as_u64()),
        (Some(4), Some(3), Some(4))
    );
    assert_eq!(years.len(), 5);
    let (finest, others) = years.split_last().unwrap();
    assert!(finest["error_target"] == 0.003 && finest["error_rms"].is_null() && finest["coverage"].is_null());
    for year in others {
        assert!(year["seconds"].as_f64().unwrap() > 0.0 && year["stated_mean"].as_f64().unwrap() > 0.0, "{year}");
        let rms = year["error_rms"].as_f64().unwrap();
        assert!(rms <= year["error_max"].as_f64().unwrap(), "{year}");
        assert_eq!((&year["coverage"]["values"], &year["coverage"]["held"]), (&12.into(), &1.0.into()), "{year}");
        let figures = year["figures"].as_array().unwrap();
        assert!(figures.iter().any(|one| one["key"] == "lighting.kWh_m2"), "{year}");
        for one in figures {
            assert!(one["off"].as_f64().unwrap() <= one["stated"].as_f64().unwrap() + 1e-9, "{one}");
        }
    }
    let table = std::fs::read_to_string(folder.join("years.csv")).unwrap();
    assert_eq!(table.lines().count(), 6);
    assert!(table.starts_with("setting,seconds,stated_mean,error_rms,error_max,values,share_held,"), "{table}");
}
