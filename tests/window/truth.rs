//! One truth in every place: figures that mean the same thing are the same, and nothing is said that is not so.

use crate::driven::{apply, harness, select, services, settle, window};
use crate::legible::inspect::words;
use cfs::app::App;
use cfs::app::command::Command;
use cfs::app::results::backend::ideals_shelf;
use cfs::app::state::{PathUse, Sheet};
use cfs::app::tiles::TILES;
use cfs::compute::direction::{Dir, Incident};
use cfs::drawing::ticks::si;
use cfs::formats::eulumdat;
use egui::Rect;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Mutex;
use std::sync::mpsc::channel;

fn value(harness: &Harness<'_, App>, name: &str) -> String {
    harness.get_by_label(name).value().unwrap_or_else(|| panic!("{name} has a value"))
}

fn says(harness: &Harness<'_, App>, part: &str) -> usize {
    words(harness).iter().filter(|text| text.contains(part)).count()
}

fn face(harness: &mut Harness<'_, App>, azimuth: f64) {
    let mut scene = harness.state().shell.state.document.scene.clone();
    scene.site.azimuth = azimuth;
    apply(harness, Command::Scene(Box::new(scene)));
}

fn maximise(harness: &mut Harness<'_, App>, title: &str) {
    let tile = TILES.iter().map(|entry| entry.tile).find(|tile| tile.title == title).expect("a tile");
    apply(harness, Command::Maximise(Some(tile)));
    harness.run_steps(3);
}

const OF_ONE_INCIDENCE: [&str; 4] = ["Incident hemisphere", "Emergent hemisphere", "Transmittance map", "Flux split"];

#[test]
fn all_that_speaks_of_an_incidence_speaks_of_the_same_one() {
    let mut harness = window();
    for name in OF_ONE_INCIDENCE {
        assert!(value(&harness, name).starts_with("sun at θ"), "{name}: {}", value(&harness, name));
    }
    let chosen = Incident(Dir::from_theta_phi(40_f64.to_radians(), 120_f64.to_radians()));
    apply(&mut harness, Command::Incidence(Some(chosen)));
    harness.run_steps(3);
    for name in OF_ONE_INCIDENCE {
        let text = value(&harness, name);
        assert!(text.starts_with("chosen direction at θ 40°, φ 120°, profile angle 36°"), "{name}: {text}");
    }
    // The share that the bar tells is the τ of that line.
    let dataset = harness.state().shell.state.dataset.value.clone().unwrap();
    let tau = dataset.transmission().unwrap().tau(chosen);
    assert!(value(&harness, "Flux split").contains(&format!("Of {:.0} % transmitted", 100.0 * tau)), "{tau}");
    // And in words on the screen: both lines and the bar.
    assert!(says(&harness, "θ 40°, φ 120°") >= 3, "{:?}", words(&harness));
    apply(&mut harness, Command::Incidence(None));
    apply(&mut harness, Command::Hour(11));
    for name in OF_ONE_INCIDENCE {
        let text = value(&harness, name);
        assert!(text.starts_with("normal incidence at θ 0°"), "{name}: {text}");
        assert!(text.contains("sun not in front of the façade"), "{name}: {text}");
    }
}

#[test]
fn status_line_and_room_tile_state_the_same_error() {
    let mut harness = window();
    harness.set_size([1920.0, 1080.0].into());
    harness.run_steps(3);
    let room = harness.state().shell.results.room.value.clone().unwrap();
    let greatest = room.totals().map(|total| total.error / total.value).fold(0.0, f64::max);
    assert!(greatest > 5e-5, "an error that can be told: {greatest}");
    let stated = value(&harness, "Floor plan of the room");
    let (_, stated) = stated.rsplit_once(" · ").unwrap();
    assert!(stated.starts_with("uncertainty ≤ ") && stated.ends_with(" % of each value"), "{stated}");
    let number: f64 = stated.split(' ').nth(2).unwrap().parse().unwrap();
    assert!((number / (100.0 * greatest) - 1.0).abs() < 0.06, "{stated} {greatest}");
    assert!(harness.query_by_label_contains(&format!("room: {stated}")).is_some(), "{:?}", words(&harness));
}

#[test]
fn the_peaks_told_are_those_of_the_luminaire_file() {
    let mut harness = window();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("window.ldt");
    // With a beam, and with scattered light alone.
    for (beam, name) in [(true, "Venetian"), (false, "Ideal diffuser")] {
        select(&mut harness, |entry| entry.name.starts_with(name));
        if beam {
            apply(&mut harness, Command::SelectState("0".to_owned()));
        }
        maximise(&mut harness, "LID");
        apply(&mut harness, Command::Write(PathUse::ExportLid, path.clone()));
        let file = eulumdat::read(&std::fs::read(&path).unwrap()).unwrap();
        let peaks = *harness.state().shell.results.lid_peaks().expect("peaks");
        let lid = harness.state().shell.results.lid.value.clone().unwrap();
        assert_eq!(!lid.lid.beams.is_empty(), beam, "{name}");
        let (scattered, sun) = (peaks.scattered.unwrap(), peaks.beam);
        let greatest = sun.map_or(scattered.intensity, |sun| sun.intensity.max(scattered.intensity));
        assert!((greatest / file.peak() - 1.0).abs() < 1e-3, "{peaks:?} {}", file.peak());
        // Said with its direction; the drawn plane is that of the peak.
        let told = value(&harness, "LID polar diagram");
        let (c, gamma) = (scattered.c.to_degrees().round(), scattered.gamma.to_degrees());
        let wanted = format!("peak of scattered light {} to C {c:.0}°, γ {gamma:.0}°", si(scattered.intensity, "cd"));
        assert!(told.starts_with(&wanted), "{told}, not {wanted}");
        if c % 180.0 != 0.0 {
            assert!(says(&harness, &format!("C{c:.0}–C{:.0}", (c + 180.0) % 360.0)) > 0, "{:?}", words(&harness));
        }
        match sun {
            Some(sun) => {
                let wanted = format!("direct sunlight {}", si(sun.intensity, "cd"));
                assert!(says(&harness, &wanted) > 0, "{wanted}: {:?}", words(&harness));
                assert!(sun.intensity > 10.0 * scattered.intensity);
            }
            None => assert!(says(&harness, "no direct sun transmitted") > 0),
        }
        // Per area of aperture it is called so.
        harness.get_by_label("per m²").click();
        harness.run_steps(3);
        assert!(says(&harness, "cd per m² of aperture") > 0 && says(&harness, "cd/m²") == 0);
        harness.get_by_label("per m²").click();
        harness.run_steps(3);
    }
}

#[test]
fn pictures_keep_their_places_when_the_sun_leaves_the_facade() {
    let mut harness = window();
    let places = |harness: &Harness<'_, App>| -> Vec<(&str, Rect)> {
        [&OF_ONE_INCIDENCE[..], &["Sky dome", "Sky section", "LID polar diagram", "Floor plan of the room"]]
            .concat()
            .into_iter()
            .filter_map(|name| Some((name, harness.query_by_label(name)?.rect())))
            .collect()
    };
    let at_all_sizes = |harness: &mut Harness<'_, App>| -> Vec<_> {
        let sizes = [[960.0, 600.0], [1280.0, 720.0], [1920.0, 1080.0]];
        let of_size = |size: [f32; 2]| {
            harness.set_size(size.into());
            harness.run_steps(3);
            places(harness)
        };
        sizes.map(of_size).into()
    };
    let noon = at_all_sizes(&mut harness);
    assert!(noon.iter().all(|places| places.len() >= 7), "{noon:?}");
    face(&mut harness, 0.0);
    assert_eq!(at_all_sizes(&mut harness), noon, "the sun stands behind the façade");
    face(&mut harness, 180.0);
    apply(&mut harness, Command::Hour(11));
    assert_eq!(at_all_sizes(&mut harness), noon, "night");
}

#[test]
fn before_anything_is_there_nothing_is_said_of_it() {
    let (release, wait) = channel::<()>();
    let wait = Mutex::new(wait);
    let mut harness = harness(services(move || {
        let _ = wait.lock().unwrap().recv();
        ideals_shelf()
    }));
    harness.run_steps(4);
    // Six tiles, the list, the status line.
    assert!(says(&harness, "pening the catalogue…") >= 8, "{:?}", words(&harness));
    for untrue in ["has only one state", "no warnings", "no sky", "No sky", "No illuminances", "no product"] {
        assert_eq!(says(&harness, untrue), 0, "{untrue}: {:?}", words(&harness));
    }
    release.send(()).unwrap();
    settle(&mut harness);
    assert_eq!(says(&harness, "pening the catalogue…"), 0);
    assert!(says(&harness, "no warnings") > 0);
}

#[test]
fn a_sun_under_the_horizon_is_said_to_be_there() {
    let mut harness = window();
    apply(&mut harness, Command::Hour(11));
    let told = value(&harness, "Sky dome");
    assert!(told.starts_with("sun ") && told.contains("° below the horizon, azimuth "), "{told}");
    assert!(!told.contains('-'), "{told}");
}

#[test]
fn a_sheet_leaves_the_pictures_a_size_that_can_be_read() {
    let mut harness = window();
    for (size, least) in [([1280.0, 720.0], 120.0), ([960.0, 600.0], 90.0)] {
        harness.set_size(size.into());
        for sheet in [Sheet::Keys, Sheet::Findings, Sheet::Accuracy, Sheet::Path(PathUse::Open)] {
            apply(&mut harness, Command::Sheet(Some(sheet)));
            harness.run_steps(3);
            for name in ["Transmittance map", "Sky dome", "LID polar diagram"] {
                let rect = harness.get_by_label(name).rect();
                assert!(rect.width().min(rect.height()) >= least, "{name} {sheet:?} at {size:?}: {rect:?}");
            }
            apply(&mut harness, Command::Sheet(None));
        }
    }
}

#[test]
fn what_is_old_and_not_renewed_says_so() {
    let mut harness = window();
    assert_eq!(says(&harness, "outdated"), 0);
    // As after a job that was stopped.
    harness.state_mut().shell.results.room.stale = true;
    harness.run_steps(2);
    assert!(says(&harness, "outdated") > 0 && says(&harness, ", outdated") > 0, "{:?}", words(&harness));
    assert_eq!(says(&harness, "updating"), 0);
}

#[test]
fn keys_are_called_as_they_are_written() {
    let mut harness = window();
    apply(&mut harness, Command::Sheet(Some(Sheet::Keys)));
    harness.run_steps(3);
    assert_eq!(says(&harness, "Bracket") + says(&harness, "Questionmark"), 0, "{:?}", words(&harness));
    // Far down in the list: all are there for who scrolls.
    for key in ["]", "[", "?", "Shift+←"] {
        assert!(harness.query_all_by_label(key).next().is_some(), "{key}");
    }
}
