//! Error against run time: stated errors hold what they promise, more effort brings less error, targets are reached,
//! and no result depends on the number of threads.

use crate::rooms::*;
use cfs::compute::estimate::{Progress, Silent};
use cfs::drawing::{Shape, chart};
use cfs::study::accuracy::{Accuracy, Errors, Origin, Quantity, Reference, Rung, Series, ladder, words};
use cfs::study::accuracy_plot::plots;
use cfs::study::{Scene, Session, StudyError};
use std::sync::atomic::{AtomicUsize, Ordering};

const SKYLINE: &str = "model = \"cie\"\ntype = 12\ndiffuse_horizontal = 12000.0\n\
    sun = { altitude = 20.0, azimuth = 160.0, direct_normal = 60000.0 }\n\
    obstruction = { altitude = 25.0, luminance = 900.0 }";

fn text(system: &str, sky: &str, sensors: &str) -> Text {
    Text {
        apertures: vec![facade([0.5, 1.0], [3.0, 1.5], system)],
        sky: sky.into(),
        ground: 0.2,
        sensors: sensors.into(),
        ..Text::default()
    }
}

const GRID: &str = "plane = { z = 0.85, nx = 4, ny = 5 }";

fn series<'a>(accuracy: &'a Accuracy, method: &str) -> &'a Series {
    accuracy.series.iter().find(|series| series.method == method).unwrap()
}

#[test]
fn a_ladder_rises() {
    let accuracy = ladder(&text(TRANSPARENT, &clear(35.0, 190.0, 60_000.0), GRID).scene(), &Silent).unwrap();
    assert_eq!((accuracy.sensors, accuracy.threads, accuracy.references.len()), ((20, 20), 1, 1));
    let reference = &accuracy.references[0];
    let converged = matches!(reference.origin, Origin::FinestRun { max, .. } if max < 1e-6);
    assert!(reference.quantity == Quantity::Direct && converged, "{reference:?}");
    for (method, bar) in [("solid-angle", 2e-4), ("subdivision", 1e-3), ("monte-carlo", 1e-2), ("profile-table", 1e-4)]
    {
        let rungs = &series(&accuracy, method).rungs;
        let errors: Vec<f64> = rungs.iter().map(|rung| rung.rms()).collect();
        // The last of the point luminaires is the distance rule.
        let finest = if method == "subdivision" { errors[errors.len() - 2] } else { errors[errors.len() - 1] };
        assert!(finest <= bar && (finest < errors[0] || finest < 1e-5), "{method}: {errors:?}");
        for rung in rungs {
            assert!(rung.sky > 0.0 && rung.sky < 60.0 && rung.setup >= 0.0 && rung.sun.is_some(), "{method}");
            assert!(rung.max() >= rung.rms() && !rung.errors.is_empty());
        }
    }
    // Monte Carlo: half the error for four times the points, over 5 quadruplings and 20 sensors.
    let rungs = &series(&accuracy, "monte-carlo").rungs;
    let gain = rungs[0].rms() / rungs[5].rms();
    assert!((12.0..90.0).contains(&gain), "{gain}");
}

#[test]
fn the_ordinary_method_keeps_to_what_it_states() {
    let near = points(
        &[[2.0, 0.001, 0.999], [2.0, 0.02, 1.1], [0.1, 0.3, 0.2], [3.9, 5.9, 0.1], [2.0, 0.2, 1.7], [2.0, 3.0, 0.85]],
        [0.0, 0.3, 1.0],
    );
    for sky in [OVERCAST, UNIFORM, SKYLINE, &clear(5.0, 250.0, 10_000.0), &clear(60.0, 180.0, 80_000.0)] {
        for sensors in [GRID, &near] {
            let accuracy = ladder(&text(TRANSPARENT, sky, sensors).scene(), &Silent).unwrap();
            let coverage = accuracy.ordinary_coverage();
            assert!(coverage.kept >= 0.99, "{sky}: {coverage:?}");
        }
    }
}

#[test]
fn targets_are_reached_and_cost_no_more_than_needed() {
    for target in [0.1, 0.01, 1e-3, 1e-5] {
        for sky in [OVERCAST, SKYLINE] {
            let text = Text { compute: format!("error_target = {target:?}"), ..text(TRANSPARENT, sky, GRID) };
            let reached = text.result().reached();
            assert!(reached > 0.0 && reached <= target, "{target}: {reached}");
        }
    }
    let pieces = |target: f64| {
        let text = Text { compute: format!("error_target = {target:?}"), ..text(TRANSPARENT, SKYLINE, GRID) };
        text.result().reached()
    };
    // Stops early: a loose target leaves a larger stated error than a strict one.
    assert!(pieces(0.1) > pieces(1e-5));
}

/// A computation whose sensors state, lie from the reference, and leave it open, relative.
fn rung(stated: f64, real: f64, open: f64) -> Rung {
    let errors = [0.5, 1.0, 1.5].map(|k| Errors { stated: k * stated, real: k * real, open: k * open });
    Rung { setting: "error target 1 %".into(), numerical: stated, errors: errors.to_vec(), ..Rung::default() }
}

#[test]
fn a_run_that_the_reference_hardly_refines_has_no_error() {
    let origin = Origin::FinestRun { target: 2e-4, rms: 1e-4, max: 2e-4 };
    let finest = Reference { quantity: Quantity::Total, origin, stated: 1e-3 };
    // Two runs of the same mesh agree in what is wrong with both.
    let same = words::undetermined_reason(&rung(1e-3, 0.0, 1e-3), &finest).unwrap();
    assert!(same.contains("hardly refines") && same.contains("0.10 %"), "{same}");
    // Somewhat finer: told where they differ by more than a small share of what is stated.
    assert!(words::undetermined_reason(&rung(4e-3, 1e-3, 1e-3), &finest).is_some());
    assert_eq!(words::undetermined_reason(&rung(5e-3, 4e-3, 1e-3), &finest), None);
    // Clearly finer: a small difference is a small error, and the statement padded.
    let padded = rung(5e-2, 1e-4, 1e-4);
    assert!(words::undetermined_reason(&padded, &finest).is_none() && padded.coverage().padded == 1.0);
    let given = Reference { origin: Origin::Given("lux.csv".into()), ..finest };
    assert!(
        words::undetermined_reason(&rung(1e-3, 0.0, 1e-3), &given).unwrap().contains("lux.csv itself is uncertain")
    );
    // It counts for no coverage.
    let rungs = vec![padded, rung(1e-3, 0.0, 1e-3)];
    let series = vec![Series { method: "room", quantity: Quantity::Total, rungs }];
    let accuracy = Accuracy { references: vec![given], series, sensors: (3, 3), threads: 1, leaving_out: Vec::new() };
    assert_eq!(accuracy.ordinary_coverage().count, 3);
}

#[test]
fn effort_that_does_not_help_is_told() {
    let limited = |data: f64| Series {
        method: "room",
        quantity: Quantity::Total,
        rungs: vec![rung(0.1, 0.0, 0.0), Rung { data, ..rung(0.01, 0.0, 0.0) }],
    };
    assert_eq!(words::data_limit(&limited(0.001)), None);
    let said = words::data_limit(&limited(0.07)).unwrap();
    assert!(said.contains("does not help: uncertainty of the data ± 7.0 %, of the computation ± 1.0 %"), "{said}");
    // Measured data between whose directions the sun stands: the data leave more open than their cells.
    let scene = text(MADE, &clear(35.0, 190.0, 60_000.0), GRID).scene_with(klems(rough));
    let accuracy = ladder(&scene, &Silent).unwrap();
    let direct = series(&accuracy, "solid-angle");
    for rung in &direct.rungs {
        assert_eq!(rung.is_limited_by_data(), rung.data > rung.numerical);
        assert!(rung.errors.iter().all(|e| e.stated.is_finite() && e.open >= 0.0));
    }
}

/// Wants nothing more after some steps.
struct Impatient(AtomicUsize);

impl Progress for Impatient {
    fn advance(&self, stage: &'static str, done: usize, total: usize) {
        assert!(stage == "accuracy" && done < total, "{stage} {done}/{total}");
        self.0.fetch_add(1, Ordering::Relaxed);
    }
    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) >= 4
    }
}

#[test]
fn a_ladder_can_be_left() {
    let progress = Impatient(AtomicUsize::new(0));
    let result = ladder(&text(TRANSPARENT, OVERCAST, GRID).scene(), &progress);
    assert!(matches!(result, Err(StudyError::Cancelled(_))));
    assert_eq!(progress.0.load(Ordering::Relaxed), 4);
}

#[test]
fn the_picture_holds_every_series() {
    let sensors = points(&[[2.0, 2.0, 0.85], [2.0, 1.0, 0.85]], [0.0, 0.0, 1.0]);
    let scene = Text { reflectance: [0.2, 0.5, 0.7], ..text(DIFFUSE, OVERCAST, &sensors) }.scene();
    let accuracy = ladder(&scene, &Silent).unwrap();
    assert_eq!(accuracy.series.len(), 5);
    assert!(accuracy.series.iter().any(|series| series.quantity == Quantity::Total));
    let drawing = chart::draw(&plots(&accuracy), [1000.0, 500.0]);
    for name in ["solid-angle", "subdivision", "monte-carlo", "profile-table", "with interreflection"] {
        assert!(drawing.shapes.iter().any(|shape| matches!(shape, Shape::Text { text, .. } if text == name)), "{name}");
    }
    for shape in &drawing.shapes {
        let points = match shape {
            Shape::Line { points, .. } | Shape::Area { points, .. } => points.clone(),
            Shape::Text { at, .. } => vec![*at],
        };
        assert!(points.iter().all(|[x, y]| (0.0..=1000.0).contains(x) && (0.0..=500.0).contains(y)), "{shape:?}");
    }
    assert!(drawing.to_png().is_ok());
}

#[test]
fn results_are_the_same_to_the_bit_for_any_number_of_threads() {
    let grey = [0.2, 0.5, 0.7];
    let mut scenes: Vec<(String, Scene)> = Vec::new();
    for method in ["solid-angle", "subdivision", "monte-carlo", "profile-table"] {
        for (system, sky) in
            [(TRANSPARENT, SKYLINE), (MADE, &clear(35.0, 190.0, 60_000.0) as &str), (DIFFUSE, OVERCAST)]
        {
            // The reflections once: they are the same for all ways.
            let reflectance = if method == "solid-angle" { grey } else { [0.0; 3] };
            let compute = format!("near_field = \"{method}\"");
            let text = Text { reflectance, compute, ..text(system, sky, GRID) };
            scenes.push((format!("{method}, {system}"), text.scene_with(klems(rough))));
        }
    }
    let roofed =
        Text { apertures: vec![roof([1.0, 2.0], [2.0, 1.0], TRANSPARENT)], ..text(TRANSPARENT, SKYLINE, GRID) };
    scenes.push(("roof".into(), roofed.scene()));
    for (name, scene) in &scenes {
        let bits = |threads: usize| -> Vec<u64> {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let result = pool.install(|| Session::new().room(scene, &Silent)).unwrap();
            let rows = result.sensors.iter().flat_map(|row| [row.direct, row.interreflected]);
            rows.chain([result.flux]).flat_map(|e| [e.value.to_bits(), e.error.to_bits()]).collect()
        };
        let one = bits(1);
        for threads in [2, 3, 7] {
            assert!(bits(threads) == one, "{name}: {threads} threads");
        }
    }
}
