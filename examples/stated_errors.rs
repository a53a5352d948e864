//! Tests the stated numerical uncertainty of the default method against the reference data, and against much finer
//! runs of rooms made here.
//!
//! `cargo run --release --example stated_errors [FOLDER…]`
//!
//! FOLDER is a folder of reference cases, or `made`; the reference data are found through `CFS_TEST_DATA`. Look at
//! "held", the share of sensors whose error is within the stated uncertainty, and at "> 10×", the share whose stated
//! uncertainty is more than ten times the error.
//!
//! Only sensors count whose reference is accurate enough: its uncertainty is at most a tenth of the stated one, which
//! is above 0.1 % of the mean of the scene. All runs use the same data, so that only numerical errors are compared.
//!
//! This table is the source of `SEEN` of `study::session::targets`, of the tolerance of the cubature of direct light,
//! and of `DIFFERENCE`, `REST` and `NEAR` of `study::session::interreflected`.

use anyhow::Context as _;
use cfs::compute::estimate::{Estimate, Silent};
use cfs::study::{Library, RoomResult, Scene, SceneFile, Session, load_scene};
use std::path::{Path, PathBuf};

/// Folders of reference cases that use patch-averaged data as given.
const FOLDERS: [&str; 5] = ["direct", "sun", "inter", "systems", "extreme"];
/// Maximum uncertainty of the reference, relative to the stated uncertainty, at which it can judge a factor of ten.
const WELL_KNOWN: f64 = 0.1;
/// Share of the mean of the scene below which a stated uncertainty does not count.
const SMALL: f64 = 1e-3;
/// Ratio of stated uncertainty to error above which the uncertainty counts as far too large.
const PADDED: f64 = 10.0;

/// Stated uncertainty of one sensor, and its error compared with the reference. \[lx\]
struct Pair {
    stated: f64,
    real: f64,
    /// Uncertainty of the reference.
    open: f64,
}

/// Row of the table.
#[derive(Default)]
struct Row {
    scenes: usize,
    sensors: usize,
    counted: Vec<Pair>,
}

impl Row {
    /// Adds the sensors of a scene.
    fn add(&mut self, result: &RoomResult, truth: &[Estimate]) {
        let mean = truth.iter().map(|e| e.value).sum::<f64>() / truth.len().max(1) as f64;
        self.scenes += 1;
        self.sensors += truth.len();
        let pairs = result.sensors.iter().zip(truth).map(|(row, truth)| Pair {
            stated: row.numerical_error(),
            real: (row.total().value - truth.value).abs(),
            open: truth.error,
        });
        self.counted.extend(pairs.filter(|p| p.stated > SMALL * mean && p.open <= WELL_KNOWN * p.stated));
    }

    fn print(&self, name: &str) {
        let count = self.counted.len();
        let share = |test: &dyn Fn(&Pair) -> bool| {
            100.0 * self.counted.iter().filter(|pair| test(pair)).count() as f64 / count.max(1) as f64
        };
        let mut ratios: Vec<f64> = self.counted.iter().map(|p| p.stated / p.real.max(1e-12 * p.stated)).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        let head = format!("{name:<24} {:>6} {:>8} {count:>8}", self.scenes, self.sensors);
        match ratios.get(count / 2) {
            None => println!("{head}        -        -        -"),
            Some(median) => println!(
                "{head} {:>8.1} {:>8.1} {median:>8.1}",
                share(&|p| p.stated + p.open >= p.real),
                share(&|p| p.stated > PADDED * p.real)
            ),
        }
    }
}

fn main() -> anyhow::Result<()> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let asked = |name: &str| wanted.is_empty() || wanted.iter().any(|one| one == name);
    println!("folder                   scenes  sensors  counted   held %  > 10× %   median");
    let root = std::env::var_os("CFS_TEST_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared"), PathBuf::from);
    for folder in FOLDERS.into_iter().filter(|folder| asked(folder)) {
        let path = root.join("reference/cases").join(folder);
        if path.is_dir() {
            cases(&path)?.print(folder);
        } else {
            println!("{folder:<24} not found: {} (CFS_TEST_DATA)", path.display());
        }
    }
    if asked("made") {
        for reflects in [false, true] {
            for target in [None, Some(0.1), Some(0.03), Some(0.01), Some(0.003)] {
                let kind = if reflects { "all light" } else { "direct" };
                let name = target.map_or_else(|| "default".to_owned(), |target| format!("{} %", 100.0 * target));
                made(reflects, target)?.print(&format!("made, {kind}, {name}"));
            }
        }
    }
    println!("held: stated uncertainty ≥ error; median: of stated uncertainty / error");
    Ok(())
}

/// Compares every scene of a folder with its table.
fn cases(folder: &Path) -> anyhow::Result<Row> {
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(folder)?.map(|e| Ok(e?.path())).collect::<std::io::Result<_>>()?;
    scenes.retain(|path| path.extension().is_some_and(|e| e == "toml") && path.with_extension("csv").exists());
    scenes.sort_unstable();
    let mut row = Row::default();
    for path in scenes {
        let scene = load_scene(&path, &Library::default())?;
        row.add(&Session::new().room(&scene, &Silent)?, &expected(&path.with_extension("csv"))?);
    }
    Ok(row)
}

/// Reads the illuminances of a reference table.
fn expected(path: &Path) -> anyhow::Result<Vec<Estimate>> {
    let mut reader = csv::Reader::from_path(path)?;
    let header = reader.headers()?.clone();
    let column = |name: &str| header.iter().position(|cell| cell == name);
    let value = column("E_lx").with_context(|| format!("{}: no column E_lx", path.display()))?;
    let error = column("E_error_lx");
    let number = |row: &csv::StringRecord, column: usize| row.get(column).unwrap_or_default().parse::<f64>();
    reader
        .records()
        .map(|row| {
            let row = row?;
            Ok(Estimate::new(number(&row, value)?, error.map_or(Ok(0.0), |column| number(&row, column))?))
        })
        .collect()
}

/// Systems of the rooms made here.
const SYSTEMS: [&str; 3] = [
    "{ ideal = \"transparent\", transmittance = 0.8 }",
    "{ ideal = \"diffuse\", transmittance = 0.6 }",
    "{ file = \"assets/systems/low-e-double.system.toml\" }",
];

/// Skies of the rooms made here.
const SKIES: [&str; 4] = [
    "model = \"cie\"\ntype = 16\ndiffuse_horizontal = 10000.0",
    "model = \"cie\"\ntype = 12\ndiffuse_horizontal = 15000.0\n\
     sun = { altitude = 35.0, azimuth = 200.0, direct_normal = 60000.0 }",
    "model = \"cie\"\ntype = 13\ndiffuse_horizontal = 12000.0\n\
     sun = { altitude = 8.0, azimuth = 130.0, direct_normal = 20000.0 }",
    "model = \"cie\"\ntype = 12\ndiffuse_horizontal = 12000.0\n\
     sun = { altitude = 20.0, azimuth = 160.0, direct_normal = 60000.0 }\n\
     obstruction = { altitude = 25.0, luminance = 900.0 }",
];

/// Apertures of the rooms made here.
const OPENINGS: [&str; 3] = [
    "surface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]",
    "surface = \"facade\"\norigin = [1.7, 0.2]\nsize = [0.3, 2.6]",
    "surface = \"roof\"\norigin = [1.0, 2.0]\nsize = [1.5, 1.5]",
];

/// Compares rooms with an error target, or none, with much finer runs.
fn made(reflects: bool, target: Option<f64>) -> anyhow::Result<Row> {
    let mut row = Row::default();
    // Without interreflection the cubature reaches any error target; with it, 1e-5 is the finest mesh.
    let finest = if reflects { 1e-5 } else { 1e-8 };
    for (k, system) in SYSTEMS.into_iter().enumerate() {
        for (i, sky) in SKIES.into_iter().enumerate() {
            // With interreflection a room takes seconds: only a third of them, with each aperture equally often.
            for opening in OPENINGS.into_iter().enumerate().filter(|(j, _)| !reflects || (i + j + k) % 3 == 0) {
                let text = room(system, sky, opening.1, reflects);
                let file = SceneFile::parse(&text).with_context(|| text.clone())?;
                let scene = Scene::resolve(&file, Path::new(env!("CARGO_MANIFEST_DIR")), &Library::default())?;
                let session = Session::new();
                let result = session.room(&Scene { error_target: target, ..scene.clone() }, &Silent)?;
                let fine = session.room(&Scene { error_target: Some(finest), ..scene }, &Silent)?;
                let truth = fine.sensors.iter().map(|s| Estimate::new(s.total().value, s.numerical_error()));
                row.add(&result, &truth.collect::<Vec<_>>());
            }
        }
    }
    Ok(row)
}

fn room(system: &str, sky: &str, opening: &str, reflects: bool) -> String {
    let reflectance = if reflects { [0.2, 0.5, 0.7] } else { [0.0; 3] };
    let [floor, walls, ceiling] = reflectance;
    format!(
        "[room]\nwidth = 4.0\ndepth = 6.0\nheight = 3.0\n\
         reflectance = {{ floor = {floor:?}, walls = {walls:?}, ceiling = {ceiling:?} }}\n\
         [[aperture]]\n{opening}\nsystem = {system}\n\
         [site]\nazimuth = 170.0\nground_reflectance = 0.2\n[sky]\n{sky}\n\
         [sensors]\nplane = {{ z = 0.85, nx = 6, ny = 9 }}\n"
    )
}
