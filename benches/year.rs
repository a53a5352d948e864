//! Run time and error of an annual simulation: 96 sensors, a year of weather, one system in a session that knows the
//! room or in a new one; and run time of new weights for a ranking of a hundred products.
//!
//! `cargo bench --bench year`. Before the times, the deviations of hours from the default method at the same moments
//! are printed, with the stated uncertainty.

use cfs::compute::estimate::{Estimate, Silent};
use cfs::compute::rank::{Better, Objective};
use cfs::study::rank::{Found, List, Parts, Row, Shortlist};
use cfs::study::year::{Climate, climate, scene_at, year_in};
use cfs::study::{Coefficients, Library, Scene, SceneFile, Session};
use divan::Bencher;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

fn main() {
    errors();
    divan::main();
}

/// Name of each system, and its keys in the scene.
const SYSTEMS: [(&str, &str); 4] = [
    ("Lambert", "{ ideal = \"diffuse\", transmittance = 0.6 }"),
    ("clear glass", "{ catalogue = \"clear-double\" }"),
    ("slats", "{ catalogue = \"venetian-80-72\", state = \"30\" }"),
    ("laser-cut panel", "{ catalogue = \"laser-cut-panel\" }"),
];

fn text(system: &str) -> String {
    let keys = SYSTEMS.iter().find(|(name, _)| *name == system).expect("one of the list").1;
    format!(
        "[room]\nwidth = 4.0\ndepth = 6.0\nheight = 3.0\n\
         reflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]\nsystem = {keys}\n\
         [site]\nazimuth = 180.0\nlatitude = 40.78\nlongitude = -73.97\nutc_offset = -5.0\nground_reflectance = 0.2\n\
         [sky]\nmodel = \"cie\"\ntype = 16\ndiffuse_horizontal = 10000.0\n\
         [sensors]\nplane = {{ z = 0.85, nx = 8, ny = 12 }}\n\
         [year]\nweather = \"builtin:new-york\"\n"
    )
}

fn file(system: &str) -> SceneFile {
    SceneFile::parse(&text(system)).expect("the text above is a scene")
}

static LIBRARY: LazyLock<Library> = LazyLock::new(|| {
    let file = std::env::temp_dir().join(format!("cfs-bench-year-{}.cfsdb", std::process::id()));
    Library::with_catalogue(Some(&file))
});
static WEATHER: LazyLock<Climate> =
    LazyLock::new(|| climate(&file("Lambert"), Path::new(".")).expect("built-in weather can be read"));
static SESSION: LazyLock<Session> = LazyLock::new(Session::new);

/// Prints for every system the deviations of every 487th hour from the default method at the same moment.
fn errors() {
    for (system, _) in SYSTEMS {
        let file = file(system);
        let base = Path::new(".");
        let year = year_in(&WEATHER, &file, base, &*LIBRARY, &SESSION, &|_| true, &Silent).expect("a year");
        let (mut worst, mut stated, mut squares, mut count) = (0.0_f64, 0.0_f64, 0.0, 0.0);
        for row in (0..year.chosen.len()).step_by(487) {
            let step = &year.steps.list[year.chosen[row]];
            if !step.hour.is_lit() {
                continue;
            }
            let moment = scene_at(&file, base, &*LIBRARY, step.time, &Silent).expect("a moment of the year");
            let scene = Scene::resolve(&moment, base, &*LIBRARY).expect("the moment can be resolved");
            let room = SESSION.room(&scene, &Silent).expect("a room");
            let places = year.light.places;
            let [own, errors] = [&year.light.values, &year.light.errors].map(|table| table.row(row));
            let mean = own.iter().map(|&e| f64::from(e)).sum::<f64>() / places as f64;
            for (s, sensor) in room.sensors.iter().enumerate() {
                let scale = sensor.total().value.max(0.05 * mean).max(1e-9);
                let off = (f64::from(own[s]) - sensor.total().value) / scale;
                worst = worst.max(off.abs());
                stated = stated.max(f64::from(errors[s]) / scale);
                squares += off * off;
                count += 1.0;
            }
        }
        println!(
            "{system}: {:.2} % rms, {:.2} % at worst; stated up to {:.2} %",
            100.0 * f64::sqrt(squares / f64::max(count, 1.0)),
            100.0 * worst,
            100.0 * stated
        );
    }
}

/// Measures a year of a system in a room and a climate that the session already knows.
#[divan::bench(args = SYSTEMS.map(|(name, _)| name), sample_count = 5, sample_size = 1)]
fn warm(bencher: Bencher<'_, '_>, system: &str) {
    let file = file(system);
    bencher.bench(|| {
        year_in(&WEATHER, &file, Path::new("."), &*LIBRARY, &SESSION, &|_| true, &Silent).expect("a year").light.dark
    });
}

/// Measures a year of a system in a new session, including the reading of the weather file.
#[divan::bench(args = SYSTEMS.map(|(name, _)| name), sample_count = 3, sample_size = 1)]
fn cold(bencher: Bencher<'_, '_>, system: &str) {
    let file = file(system);
    bencher.bench(|| {
        let weather = climate(&file, Path::new(".")).expect("weather can be read");
        let session = Session::new();
        year_in(&weather, &file, Path::new("."), &*LIBRARY, &session, &|_| true, &Silent).expect("a year").light.dark
    });
}

/// Measures the hours alone, at 96 sensors with data on the Klems basis: scene and skies are known, the sun is computed
/// for every hour. This is what `dctimestep` does in a matrix method.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn hours(bencher: Bencher<'_, '_>) {
    let text = format!("{}[compute]\ninterpolation = \"patch\"\n", text("slats"));
    let file = SceneFile::parse(&text).expect("the text above is a scene");
    let scene = Scene::resolve(&file, Path::new("."), &*LIBRARY).expect("the scene can be resolved");
    let mut prepared = Coefficients::new(&SESSION, &scene, &Silent).expect("a scene without boxes");
    let steps = &WEATHER.steps;
    prepared.keep_year(&SESSION, (steps.number(), steps.list.len()), steps.list.len());
    let lit: Vec<_> = (0..steps.list.len()).filter(|&k| steps.list[k].hour.is_lit()).collect();
    let skies: Vec<_> = lit.iter().map(|&k| (k, steps.outside(k).expect("an hour of the weather"))).collect();
    bencher.bench(|| {
        let hours: Vec<_> = skies.iter().map(|(k, (outside, sun))| (*k, outside, sun.as_ref())).collect();
        let sky: f64 = prepared.hours_estimate(&hours).iter().flatten().map(|e| e.value).sum();
        let suns = skies.iter().flat_map(|(_, (_, sun))| sun).flat_map(|sun| prepared.sun_estimate(sun));
        sky + suns.map(|e| e.value).sum::<f64>()
    });
}

/// Measures new weights for a hundred products of three figures, up to the list that the window shows. No year is
/// computed.
#[divan::bench]
fn weights(bencher: Bencher<'_, '_>) {
    let objective = |worst, best| Objective { better: Better::More, worst, best, weight: 1.0 };
    let row = |k: usize| {
        let share = |step: f64| (step * k as f64).fract();
        let figures: Vec<f64> = [0.618_034, 0.754_878, 0.569_840].map(share).to_vec();
        let parts = |e: &f64| Parts { zones: vec!["front".to_owned(), "rear".to_owned()], values: vec![e / 16.0; 16] };
        let found = Found {
            parts: figures.iter().map(parts).collect(),
            figures: figures.into_iter().map(|e| Estimate::new(e, 0.005)).collect(),
            approximate: Vec::new(),
        };
        Row { product: format!("p{k:03}"), key: String::new(), outcome: Ok(found) }
    };
    let list = List {
        number: 0,
        scene: String::new(),
        climate: String::new(),
        azimuth: 180.0,
        figures: ["a", "b", "c"].map(str::to_owned).to_vec(),
        objectives: vec![objective(0.0, 1.0), objective(0.2, 0.8), objective(0.0, 0.5)],
        rows: (0..100).map(row).collect(),
    };
    bencher.bench(|| Shortlist::of(list.clone(), &BTreeMap::new(), &BTreeSet::new()).entries.len());
}
