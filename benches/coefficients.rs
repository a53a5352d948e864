//! Run time and error of a new sky and a new sun for a prepared scene: 96 sensors with interreflection.
//!
//! `RAYON_NUM_THREADS=1 cargo bench --bench coefficients`. Before the times, stated uncertainty and deviation
//! from the default method are printed for every system.

use cfs::compute::angle::Bearing;
use cfs::compute::basis::RingBasis;
use cfs::compute::btdf::{Btdf, Dataset, Indicatrices, Scattered};
use cfs::compute::direction::{Dir, Incident};
use cfs::compute::estimate::Silent;
use cfs::compute::incidence::superpose::sub_patches;
use cfs::compute::sky::{Distribution, Outside, Sun};
use cfs::study::{Coefficients, Library, Scene, SceneFile, Session, System};
use divan::Bencher;
use std::path::Path;
use std::sync::Arc;

fn main() {
    errors();
    divan::main();
}

const SYSTEMS: [&str; 4] = ["Lambert", "Klems blind", "indicatrices", "clear glass"];

/// Creates a dataset with a narrow lobe about the through direction and a haze: 145 incident directions, cells of 2°.
fn clear_lobe() -> Dataset {
    let incident: Vec<_> = RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect();
    let emergent = sub_patches(2_f64.to_radians());
    let mut values = Vec::with_capacity(incident.len() * emergent.len());
    for i in &incident {
        let lobe = |d: Dir<_>| (-0.5 * (i.0.vector().distance(d.vector()) / 0.05).powi(2)).exp();
        let towards: Vec<f64> = emergent.cells().map(|o| lobe(o.centre())).collect();
        let flux: f64 = emergent.cells().zip(&towards).map(|(o, l)| o.projected_solid_angle() * l).sum();
        values.extend(towards.iter().map(|l| 0.5 * l / flux + 0.05));
    }
    let data = Indicatrices::new(incident, emergent, values).expect("the directions differ");
    let mut dataset = Dataset { name: "clear lobe".into(), ..Dataset::default() };
    dataset.visible.transmission_front =
        Some(Btdf { regular: None, scattered: Some(Scattered::Directions(Arc::new(data))) });
    dataset
}

fn scene(system: &str) -> Scene {
    let keys = match system {
        "Klems blind" => "{ catalogue = \"venetian-80-72\", state = \"30\" }",
        "clear glass" => "{ ideal = \"transparent\", transmittance = 0.8 }",
        _ => "{ ideal = \"diffuse\", transmittance = 0.6 }",
    };
    let text = format!(
        "[room]\nwidth = 4.0\ndepth = 6.0\nheight = 3.0\n\
         reflectance = {{ floor = 0.2, walls = 0.5, ceiling = 0.7 }}\n\
         [[aperture]]\nsurface = \"facade\"\norigin = [0.5, 0.9]\nsize = [3.0, 1.8]\nsystem = {keys}\n\
         [site]\nazimuth = 170.0\nground_reflectance = 0.2\n\
         [sky]\nmodel = \"cie\"\ntype = 16\ndiffuse_horizontal = 10000.0\n\
         [sensors]\nplane = {{ z = 0.85, nx = 8, ny = 12 }}\n"
    );
    let file = std::env::temp_dir().join(format!("cfs-bench-coefficients-{}.cfsdb", std::process::id()));
    let library = Library::with_catalogue(Some(&file));
    let keys = SceneFile::parse(&text).expect("the text above is a scene");
    let mut scene = Scene::resolve(&keys, Path::new("."), &library).expect("the scene above can be resolved");
    drop(library);
    for ending in ["", "-wal", "-shm"] {
        std::fs::remove_file(format!("{}{ending}", file.display())).ok();
    }
    if system == "indicatrices" {
        let dataset = Arc::new(clear_lobe());
        scene.apertures[0].system =
            Arc::new(System { label: "clear lobe".into(), state: String::new(), dataset, model: None });
    }
    scene
}

fn sun(k: usize) -> Sun {
    let bearing = Bearing::from_degrees(140.0 + 5.0 * (k % 12) as f64);
    Sun { direction: Dir::from_altitude_bearing(0.6, bearing), direct_normal: 60_000.0 }
}

/// Returns a clear sky for the sun of number `k`.
fn outside(k: usize) -> Outside {
    let sky = Distribution::cie(12, sun(k).direction).expect("there is a type 12");
    let outside = Outside::new(sky, 15_000.0).and_then(|outside| outside.with_ground(0.2, 40_000.0));
    outside.expect("the numbers above are in range")
}

fn prepare(session: &Session, scene: &Scene) -> Coefficients {
    Coefficients::new(session, scene, &Silent).expect("nothing in these scenes is out of range")
}

fn errors() {
    for system in SYSTEMS {
        let session = Session::new();
        let mut scene = scene(system);
        let coefficients = prepare(&session, &scene);
        for (what, with_sun) in [("sky", false), ("sky and sun", true)] {
            scene.outside = outside(7);
            scene.sun = with_sun.then(|| sun(7));
            let mut quick = coefficients.sky_estimate(&scene.outside);
            if with_sun {
                quick.iter_mut().zip(coefficients.sun_estimate(&sun(7))).for_each(|(a, b)| *a += b);
            }
            let ordinary = session.room(&scene, &Silent).expect("nothing in these scenes is out of range");
            let mean = quick.iter().map(|e| e.value).sum::<f64>() / quick.len() as f64;
            let off = quick.iter().zip(&ordinary.sensors).map(|(a, b)| (a.value - b.total().value).abs());
            println!(
                "{system:<13} {what:<12} off by at most {:.3} % of the mean from the ordinary way, stated {:.3} %; {} luminances",
                100.0 * off.fold(0.0, f64::max) / mean,
                100.0 * quick.iter().map(|e| e.error).fold(0.0, f64::max) / mean,
                coefficients.evaluations(),
            );
        }
    }
}

/// Measures a new sky for a prepared room, without its uncertainty.
#[divan::bench(args = SYSTEMS)]
fn new_sky(bencher: Bencher<'_, '_>, system: &str) {
    let coefficients = prepare(&Session::new(), &scene(system));
    let skies: Vec<Outside> = (0..12).map(outside).collect();
    let mut turn = 0;
    bencher.bench_local(|| {
        turn += 1;
        coefficients.sky(&skies[turn % 12])
    });
}

/// Measures a new sky for a prepared room, with its uncertainty.
#[divan::bench(args = SYSTEMS)]
fn new_sky_with_error(bencher: Bencher<'_, '_>, system: &str) {
    let coefficients = prepare(&Session::new(), &scene(system));
    let skies: Vec<Outside> = (0..12).map(outside).collect();
    let mut turn = 0;
    bencher.bench_local(|| {
        turn += 1;
        coefficients.sky_estimate(&skies[turn % 12])
    });
}

/// Measures a new position of the sun for a prepared room.
#[divan::bench(args = SYSTEMS)]
fn new_sun(bencher: Bencher<'_, '_>, system: &str) {
    let coefficients = prepare(&Session::new(), &scene(system));
    let mut turn = 0;
    bencher.bench_local(|| {
        turn += 1;
        coefficients.sun(&sun(turn))
    });
}

/// Measures the preparation of a scene in a new session.
#[divan::bench(args = SYSTEMS, sample_count = 3, sample_size = 1)]
fn preparation(bencher: Bencher<'_, '_>, system: &str) {
    let scene = scene(system);
    bencher.bench_local(|| prepare(&Session::new(), &scene));
}
