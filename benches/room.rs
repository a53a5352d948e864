//! Run time and error of a room: 96 sensors in a room with three reflectances, behind a blind of the built-in products
//! and other systems, as the window computes it when the sky, the sun or the room changes.
//!
//! `cargo bench --bench room`. Before the times, the deviations of the results from a finer computation are
//! printed.

use cfs::compute::estimate::Silent;
use cfs::study::{Library, RoomResult, Scene, SceneFile, Session};
use divan::Bencher;
use std::path::Path;

fn main() {
    errors();
    divan::main();
}

const BLIND: &str = "{ catalogue = \"venetian-80-72\", state = \"30\" }";
const OPEN: &str = "{ ideal = \"transparent\", transmittance = 0.8 }";
const DIFFUSE: &str = "{ ideal = \"diffuse\", transmittance = 0.6 }";

fn text(system: &str, sky: &str, compute: &str) -> String {
    format!(
        "[room]\nwidth = 4.0\ndepth = 6.0\nheight = 3.0\n\
         reflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]\nsystem = {system}\n\
         [site]\nazimuth = 170.0\nground_reflectance = 0.2\n[sky]\n{sky}\n\
         [sensors]\nplane = {{ z = 0.85, nx = 8, ny = 12 }}\n[compute]\n{compute}\n"
    )
}

/// Returns the keys of a clear sky with the sun at a bearing. \[°\]
fn sunny(bearing: f64) -> String {
    format!(
        "model = \"cie\"\ntype = 12\ndiffuse_horizontal = 15000.0\n\
         sun = {{ altitude = 35.0, azimuth = {bearing:?}, direct_normal = 60000.0 }}"
    )
}

fn overcast(illuminance: f64) -> String {
    format!("model = \"cie\"\ntype = 16\ndiffuse_horizontal = {illuminance:?}")
}

/// Library whose catalogue exists as long as a bench, and its folder.
struct Bench {
    library: Library,
    _folder: Folder,
}

/// Temporary folder, removed at the end.
struct Folder(std::path::PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).ok();
    }
}

impl Bench {
    fn new() -> Self {
        let folder =
            std::env::temp_dir().join(format!("cfs-bench-{}-{:?}", std::process::id(), std::thread::current().id()));
        std::fs::create_dir_all(&folder).expect("the system has a folder for temporary files");
        Self { library: Library::with_catalogue(Some(&folder.join("catalogue.cfsdb"))), _folder: Folder(folder) }
    }

    fn scene(&self, system: &str, sky: &str, compute: &str) -> Scene {
        let file = SceneFile::parse(&text(system, sky, compute)).expect("the text above is a scene");
        Scene::resolve(&file, Path::new("."), &self.library).expect("the scene above can be resolved")
    }
}

fn room(session: &Session, scene: &Scene) -> RoomResult {
    session.room(scene, &Silent).expect("nothing in these scenes is out of range")
}

/// Prints the largest deviation of the default method from a run with an error target of 1e-5 (up to ten times the
/// patches), relative to the mean, and how well the stated uncertainty covers it.
fn errors() {
    let bench = Bench::new();
    for (name, system, sky) in [
        ("diffuse, overcast", DIFFUSE, overcast(10_000.0)),
        ("blind, overcast", BLIND, overcast(10_000.0)),
        ("blind, sun", BLIND, sunny(200.0)),
        ("open, overcast", OPEN, overcast(10_000.0)),
        ("open, sun", OPEN, sunny(200.0)),
    ] {
        let ordinary = room(&Session::new(), &bench.scene(system, &sky, ""));
        let fine = room(&Session::new(), &bench.scene(system, &sky, "error_target = 1e-5"));
        let count = fine.sensors.len() as f64;
        let mean = fine.sensors.iter().map(|s| s.total().value).sum::<f64>() / count;
        let (mut worst, mut stated, mut covered, mut tight) = (0.0_f64, 0.0_f64, 0_u32, 0_u32);
        for (a, b) in ordinary.sensors.iter().zip(&fine.sensors) {
            let (a, b) = (a.total(), b.total());
            let deviation = (a.value - b.value).abs();
            worst = worst.max(deviation / mean);
            stated = stated.max(a.error / mean);
            covered += u32::from(deviation <= a.error);
            tight += u32::from(a.error <= 10.0 * deviation);
        }
        println!(
            "{name:<18} mean {mean:8.1} lx   true error at most {:.3} % of the mean, stated {:.3} %; stated ≥ true at \
             {:.0} % of the sensors, ≤ 10 × true at {:.0} %",
            100.0 * worst,
            100.0 * stated,
            100.0 * f64::from(covered) / count,
            100.0 * f64::from(tight) / count,
        );
    }
}

/// Measures a new sky for a room that the session already knows.
#[divan::bench(args = [DIFFUSE, BLIND, OPEN])]
fn sky_change(bencher: Bencher<'_, '_>, system: &str) {
    let bench = Bench::new();
    let session = Session::new();
    let scenes: Vec<Scene> = [10_000.0, 12_000.0].map(|e| bench.scene(system, &overcast(e), "")).into_iter().collect();
    room(&session, &scenes[0]);
    let mut turn = 0;
    bencher.bench_local(|| {
        turn += 1;
        room(&session, &scenes[turn % 2])
    });
}

/// Measures a new position of the sun for a room that the session already knows.
#[divan::bench(args = [BLIND, OPEN])]
fn sun_change(bencher: Bencher<'_, '_>, system: &str) {
    let bench = Bench::new();
    let session = Session::new();
    let scenes: Vec<Scene> = (0..12).map(|k| bench.scene(system, &sunny(150.0 + 5.0 * f64::from(k)), "")).collect();
    room(&session, &scenes[0]);
    let mut turn = 0;
    bencher.bench_local(|| {
        turn += 1;
        room(&session, &scenes[turn % 12])
    });
}

/// Measures the first result for a room under an overcast sky.
#[divan::bench(args = [DIFFUSE, BLIND, OPEN], sample_count = 10)]
fn cold_overcast(bencher: Bencher<'_, '_>, system: &str) {
    let bench = Bench::new();
    let scene = bench.scene(system, &overcast(10_000.0), "");
    bencher.bench_local(|| room(&Session::new(), &scene));
}

/// Measures the first result for a room: meshing, exchange, factorisation, near field of all sensors and patches.
#[divan::bench(args = [BLIND, OPEN], sample_count = 10)]
fn cold(bencher: Bencher<'_, '_>, system: &str) {
    let bench = Bench::new();
    let scene = bench.scene(system, &sunny(200.0), "");
    bencher.bench_local(|| room(&Session::new(), &scene));
}

/// Measures the light of the aperture alone: sky integrals over the incident cells and the matrix.
#[divan::bench(args = [BLIND, OPEN])]
fn emission(bencher: Bencher<'_, '_>, system: &str) {
    let bench = Bench::new();
    let scene = bench.scene(system, &sunny(200.0), "");
    let session = Session::new();
    bencher.bench_local(|| session.lid(&scene, 0, &Silent).expect("the scene has an aperture"));
}
