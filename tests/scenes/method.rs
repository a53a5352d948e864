//! Rooms behind analytic systems of which the program knows 145 incident directions only, against dense incidence.

use crate::common::{SELECTION, data};
use cfs::compute::estimate::Silent;
use cfs::study::{Library, Session, load_scene};
use std::collections::BTreeMap;
use std::path::Path;

/// Sensors' expected illuminances.
fn expected(path: &Path) -> Vec<f64> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.records().map(|record| record.unwrap()[6].parse().unwrap()).collect()
}

/// Systems, and for each the highest rms under a sky and share of Σ|ΔE| under a sun (median, worst).
const BARS: [(&str, f64, f64, f64); 7] = [
    ("clear", 0.007, 0.02, 0.08),
    ("scatter", 0.007, 0.02, 0.08),
    ("lcp", 0.007, 0.02, 0.125),
    ("lcpskew", 0.010, 0.02, 0.08),
    ("redirect", 0.007, 0.02, 0.08),
    ("slats", 0.010, 0.025, 0.08),
    ("diffuser", 0.007, 0.02, 0.08),
];

#[test]
fn rooms_behind_measured_systems_are_lit_as_behind_the_true_ones() {
    let Some(folder) = data("reference/cases/method") else { return };
    let library = Library::default();
    let session = Session::new();
    let mut skies: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut suns: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    names.retain(|path| path.extension().is_some_and(|ext| ext == "toml"));
    names.sort();
    let selected = folder.join(SELECTION).exists();
    assert!(names.len() > if selected { 40 } else { 100 });
    for path in names {
        let scene = load_scene(&path, &library).unwrap();
        let got: Vec<f64> =
            session.room(&scene, &Silent).unwrap().sensors.iter().map(|sensor| sensor.total().value).collect();
        let want = expected(&path.with_extension("csv"));
        assert!(got.iter().all(|e| e.is_finite() && *e >= 0.0), "{}", path.display());
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let system = name.split('_').next().unwrap().to_owned();
        let total: f64 = want.iter().sum();
        if name.contains("_sun") {
            let off = got.iter().zip(&want).map(|(g, w)| (g - w).abs()).sum::<f64>() / total;
            if name.contains("_sun7") {
                assert!(off < 0.3, "{name}, beyond the last row: {off}");
            } else {
                suns.entry(system).or_default().push(off);
            }
        } else {
            let mean = total / want.len() as f64;
            let square = |(g, w): (&f64, &f64)| ((g - w) / w.max(0.01 * mean)).powi(2);
            let rms = (got.iter().zip(&want).map(square).sum::<f64>() / want.len() as f64).sqrt();
            skies.entry(system).or_default().push(rms);
        }
    }
    let median = |list: &mut Vec<f64>| {
        list.sort_by(f64::total_cmp);
        list[list.len() / 2]
    };
    for (system, sky, sun, worst) in BARS {
        if selected && !skies.contains_key(system) {
            continue;
        }
        let (skies, suns) = (skies.get_mut(system).unwrap(), suns.get_mut(system).unwrap());
        assert!(median(skies) <= sky, "{system}: skies {skies:?}");
        assert!(median(suns) <= sun && suns.iter().all(|off| *off <= worst), "{system}: suns {suns:?}");
    }
}
