//! Whole scenes against the reference cases: every scene of every kit, sensor by sensor, and whether the stated error
//! covers the true one.

use crate::common::data;
use crate::rooms::compute;
use cfs::study::{Library, Session, load_scene};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// How a value is judged: |v − E| ≤ relative·E + the reference's own uncertainty + absolute.
#[derive(Clone, Copy)]
struct Bar {
    relative: f64,
    /// lx
    absolute: f64,
}

/// One comparison of a scene.
struct Outcome {
    name: String,
    sensors: usize,
    /// Sensors beyond the bar, and the worst of them.
    off: usize,
    worst: (f64, String),
    /// Sensors whose true error is more than three times the stated one.
    understated: usize,
    sums: [f64; 2],
    /// Uncertainty of the reference's sum. [lx]
    sum_error: f64,
}

/// Scenes of a kit that have a table beside them.
#[track_caller]
pub fn scenes(kit: &str) -> Option<Vec<PathBuf>> {
    let mut list: Vec<PathBuf> = std::fs::read_dir(data(&format!("reference/cases/{kit}"))?)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml") && path.with_extension("csv").exists())
        .collect();
    list.sort();
    assert!(!list.is_empty(), "{kit} holds no scenes");
    Some(list)
}

pub fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row.get(column).filter(|text| !text.is_empty()).map_or(0.0, |text| text.parse().unwrap())
}

fn compare(path: &Path, bar: Bar) -> Outcome {
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    let scene = load_scene(path, &Library::default()).unwrap();
    let result = compute(&scene);
    let rows: Vec<HashMap<String, String>> =
        csv::Reader::from_path(path.with_extension("csv")).unwrap().deserialize().collect::<Result<_, _>>().unwrap();
    assert_eq!(rows.len(), result.sensors.len(), "{name}");
    let mut outcome = Outcome {
        name,
        sensors: rows.len(),
        off: 0,
        worst: (0.0, String::new()),
        understated: 0,
        sums: [0.0; 2],
        sum_error: 0.0,
    };
    for (row, sensor) in rows.iter().zip(&result.sensors) {
        let p = sensor.sensor.position;
        for (own, theirs) in [(p.x, "x"), (p.y, "y"), (p.z, "z")] {
            assert!((own - number(row, theirs)).abs() < 1e-5, "{}: another sensor at {p}", outcome.name);
        }
        let u = number(row, "E_error_lx");
        let columns =
            [("E_lx", sensor.total()), ("E_direct_lx", sensor.direct), ("E_interreflected_lx", sensor.interreflected)];
        for (column, got) in columns {
            let want = number(row, column);
            assert!(got.value.is_finite() && got.value >= 0.0 && got.error >= 0.0, "{}: {got:?}", outcome.name);
            // The total's uncertainty bounds that of its parts.
            let allowed = (bar.relative * want).max(bar.absolute) + u + 1e-3;
            let miss = (got.value - want).abs();
            if miss > allowed {
                outcome.off += usize::from(column == "E_lx");
                let share = miss / want.max(0.01);
                if share > outcome.worst.0 {
                    outcome.worst = (share, format!("{column} at {p}: {} instead of {want} ± {u}", got.value));
                }
            }
        }
        let (want, got) = (number(row, "E_lx"), sensor.total());
        outcome.understated += usize::from((got.value - want).abs() > 3.0 * got.error + u + 1e-3);
        outcome.sums[0] += got.value;
        outcome.sums[1] += want;
        outcome.sum_error = outcome.sum_error.hypot(u);
    }
    outcome
}

/// Every scene of a folder whose name passes, each sensor against the bar that its name asks for.
fn every_sensor(folder: &str, bar: impl Fn(&str) -> Option<Bar> + Sync) {
    let Some(scenes) = scenes(folder) else { return };
    let outcomes: Vec<Outcome> =
        scenes.par_iter().filter_map(|path| Some(compare(path, bar(&path.file_stem()?.to_string_lossy())?))).collect();
    report(folder, &outcomes, |outcome| outcome.worst.0 > 0.0);
    errors_are_stated(folder, &outcomes);
}

fn report(folder: &str, outcomes: &[Outcome], fails: impl Fn(&Outcome) -> bool) {
    let mut list: Vec<&Outcome> = outcomes.iter().filter(|outcome| fails(outcome)).collect();
    list.sort_by(|a, b| b.worst.0.total_cmp(&a.worst.0));
    for outcome in &list {
        let [got, want] = outcome.sums;
        println!(
            "{folder}/{}: {} of {} sensors off, sum {:+.3} %; worst {:.3} %: {}",
            outcome.name,
            outcome.off,
            outcome.sensors,
            100.0 * (got / want - 1.0),
            100.0 * outcome.worst.0,
            outcome.worst.1
        );
    }
    println!("{folder}: {} of {} scenes pass", outcomes.len() - list.len(), outcomes.len());
    assert!(list.is_empty(), "{} scenes of {folder} fail", list.len());
}

/// At most one sensor in a hundred may be further off than three times what was stated.
fn errors_are_stated(folder: &str, outcomes: &[Outcome]) {
    let (mut understated, mut sensors) = (0, 0);
    for outcome in outcomes {
        understated += outcome.understated;
        sensors += outcome.sensors;
        if outcome.understated > 0 {
            println!("{folder}/{}: error understated at {} sensors", outcome.name, outcome.understated);
        }
    }
    println!("{folder}: error understated at {understated} of {sensors} sensors");
    assert!(understated * 100 <= sensors, "{folder}: {understated} of {sensors}");
}

#[test]
fn direct_light_of_ideal_systems() {
    every_sensor("direct", |name| {
        let hard = name.starts_with("hard") || name.starts_with("slit");
        Some(Bar { relative: if hard { 0.01 } else { 0.001 }, absolute: 0.01 })
    });
}

#[test]
fn sun_through_the_opening() {
    every_sensor("sun", |_| Some(Bar { relative: 0.001, absolute: 0.01 }));
}

#[test]
fn interreflection() {
    every_sensor("inter", |_| Some(Bar { relative: 0.01, absolute: 0.01 }));
}

/// Openings that are tiny beside their room, many strips: the light there is is small, so that only shares of it count.
#[test]
fn extreme_openings() {
    every_sensor("extreme", |_| Some(Bar { relative: 5e-3, absolute: 0.0 }));
}

/// Boxes before façade and roof, a skyline by bearing, frame and dirt.
#[test]
fn what_stands_outside() {
    every_sensor("obstructions", |_| Some(Bar { relative: 5e-3, absolute: 0.05 }));
}

#[test]
fn matrices_of_makers() {
    every_sensor("systems", |name| {
        let relative = if name.ends_with("_inter") { 0.01 } else { 0.005 };
        Some(Bar { relative, absolute: 0.01 })
    });
}

#[test]
fn tensor_trees() {
    let Some(scenes) = scenes("tensor") else { return };
    let bar = Bar { relative: 1.0, absolute: f64::INFINITY };
    let outcomes: Vec<Outcome> = scenes.par_iter().map(|path| compare(path, bar)).collect();
    for outcome in &outcomes {
        let [got, want] = outcome.sums;
        println!("tensor/{}: sum {:+.3} %", outcome.name, 100.0 * (got / want - 1.0));
    }
    report("tensor", &outcomes, |outcome| {
        let [got, want] = outcome.sums;
        let relative = if outcome.name.ends_with("_sun") { 0.10 } else { 0.03 };
        (got - want).abs() > relative * want + outcome.sum_error
    });
}

#[test]
fn sky_patches() {
    use cfs::compute::sky::mean_luminance;
    use cfs::compute::sky::patches::tregenza_patches;
    let Some(scenes) = scenes("sky") else { return };
    let (mut off, mut compared) = (Vec::new(), 0);
    for path in scenes {
        let scene = load_scene(&path, &Library::default()).unwrap();
        let rows: Vec<HashMap<String, String>> = csv::Reader::from_path(path.with_extension("csv"))
            .unwrap()
            .deserialize()
            .collect::<Result<_, _>>()
            .unwrap();
        assert_eq!(rows.len(), 145);
        let sun = scene.outside.sun_direction();
        for (number_of, (row, patch)) in rows.iter().zip(tregenza_patches()).enumerate() {
            let centre = scene.outside.luminance(patch.centre());
            let mean = mean_luminance(&scene.outside, &patch).value;
            // The patch around the sun: the cubature of the reference itself is good to a percent there.
            let near = sun.is_some_and(|sun| sun.dot(patch.centre()) > 12_f64.to_radians().cos());
            for (got, column, bar) in
                [(centre, "L_centre_cdm2", 1e-4), (mean, "L_mean_cdm2", if near { 1e-2 } else { 2e-3 })]
            {
                let want = number(row, column);
                compared += 1;
                if (got - want).abs() > bar * want.abs() + 1e-6 {
                    off.push(format!("{} patch {number_of} {column}: {got} instead of {want}", path.display()));
                }
            }
        }
    }
    println!("sky: {} of {compared} values off", off.len());
    assert!(off.is_empty(), "{:#?}", &off[..off.len().min(20)]);
}

#[test]
fn a_session_that_has_seen_other_scenes_gives_the_same() {
    // Caches are keyed by geometry: results must not depend on what was asked before.
    let session = Session::new();
    let library = Library::default();
    for kit in ["inter", "systems"] {
        for path in scenes(kit).iter().flatten().step_by(3) {
            let scene = load_scene(path, &library).unwrap();
            let warm = session.room(&scene, &cfs::compute::estimate::Silent).unwrap();
            let cold = Session::new().room(&scene, &cfs::compute::estimate::Silent).unwrap();
            assert_eq!(warm.sensors, cold.sensors, "{}", path.display());
        }
    }
}
