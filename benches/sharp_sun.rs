//! Run time and error of a new sun alone for a room with a described system: 96 sensors, interreflection.
//!
//! `RAYON_NUM_THREADS=1 cargo bench --bench sharp_sun`. `kept`: the sun has been computed before, so that the
//! scattering of the system is stored; `first`: it has not. Everything else of the room is stored. Before the times,
//! the stated uncertainty and the deviation from a run with an error target of 0.1 % are printed.

use cfs::compute::angle::Bearing;
use cfs::compute::direction::Dir;
use cfs::compute::estimate::Silent;
use cfs::compute::sky::Sun;
use cfs::study::{Library, Scene, SceneFile, Session};
use divan::Bencher;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

const SYSTEMS: [&str; 4] = ["venetian-80-72", "laser-cut-panel", "low-e-double-interior-blind", "perforated-round-33"];

fn main() {
    errors();
    divan::main();
}

fn scene(system: &str) -> Scene {
    let state = if system.starts_with("venetian") { ", state = \"15\"" } else { "" };
    let text = format!(
        "[room]\nwidth = 4.0\ndepth = 6.0\nheight = 3.0\n\
         reflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]\n\
         system = {{ file = \"{system}.system.toml\"{state} }}\n\
         [site]\nazimuth = 170.0\n[sky]\nmodel = \"uniform\"\ndiffuse_horizontal = 0.0\n\
         [sensors]\nplane = {{ z = 0.85, nx = 8, ny = 12 }}\n"
    );
    let keys = SceneFile::parse(&text).expect("the text above is a scene");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/systems");
    let mut scene = Scene::resolve(&keys, &folder, &Library::default()).expect("the scene above can be resolved");
    scene.sun = Some(sun(0));
    scene
}

/// Returns the sun of number `k`, at a different position for every number.
fn sun(k: usize) -> Sun {
    let bearing = Bearing::from_degrees(140.0 + 0.37 * (k % 200) as f64);
    Sun { direction: Dir::from_altitude_bearing(0.3 + 0.0013 * (k % 400) as f64, bearing), direct_normal: 60_000.0 }
}

fn errors() {
    for system in SYSTEMS {
        let session = Session::new();
        let mut scene = scene(system);
        let run =
            |scene: &Scene| session.room(scene, &Silent).expect("nothing in these scenes is out of range").sensors;
        let ordinary = run(&scene);
        scene.error_target = Some(1e-3);
        let fine = run(&scene);
        let mean = fine.iter().map(|s| s.total().value).sum::<f64>() / fine.len() as f64;
        let off =
            ordinary.iter().zip(&fine).map(|(a, b)| (a.total().value - b.total().value).abs()).fold(0.0, f64::max);
        let stated = ordinary.iter().map(|s| s.total().error).fold(0.0, f64::max);
        println!(
            "{system:<17} off by at most {:.3} % of the mean from a run to a thousandth, stated {:.3} %",
            100.0 * off / mean,
            100.0 * stated / mean
        );
    }
}

#[divan::bench(args = SYSTEMS)]
fn kept(bencher: Bencher<'_, '_>, system: &str) {
    let (session, mut scene) = (Session::new(), scene(system));
    let mut k = 0;
    let mut run = || {
        k += 1;
        scene.sun = Some(sun(k % 8));
        session.room(&scene, &Silent).expect("nothing in these scenes is out of range")
    };
    (0..8).for_each(|_| drop(run()));
    bencher.bench_local(run);
}

#[divan::bench(args = SYSTEMS)]
fn first(bencher: Bencher<'_, '_>, system: &str) {
    static NEXT: AtomicUsize = AtomicUsize::new(1000);
    let (session, mut scene) = (Session::new(), scene(system));
    let mut run = || {
        // 200 bearings by 400 altitudes: none comes twice.
        scene.sun = Some(sun(NEXT.fetch_add(1, Ordering::Relaxed)));
        session.room(&scene, &Silent).expect("nothing in these scenes is out of range")
    };
    drop(run());
    bencher.bench_local(run);
}
