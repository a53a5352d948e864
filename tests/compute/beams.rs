//! Beams of single directions against the shares that the reference kit's beam scenes state.

use crate::common;
use cfs::compute::angle::Bearing;
use cfs::compute::direction::{Dir, Facade, Orientation, Surface};
use cfs::compute::system::measure::{Side, Specimen};
use cfs::formats::system_toml;
use glam::DVec3;
use std::path::Path;

/// What a scene says: the sun, and the shares of the straight and the turned beam.
struct Case {
    name: String,
    sun: Dir<Facade>,
    straight: f64,
    turned: Option<f64>,
}

/// The number behind a word.
fn number(text: &str, word: &str) -> Option<f64> {
    let rest = text.split(word).nth(1)?.trim_start_matches([' ', '=']);
    let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')).unwrap_or(rest.len());
    rest[..end].parse().ok()
}

/// All scenes of a system.
fn cases(folder: &Path, system: &str) -> Vec<Case> {
    let mut found = vec![];
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !(name.starts_with(&format!("{system}_sun")) && name.ends_with(".toml")) {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let first = text.lines().next().unwrap();
        let sun = text.lines().find(|line| line.starts_with("sun")).unwrap();
        let degrees = |word| number(sun, word).unwrap();
        let site = Bearing::from_degrees(number(text.split("[site]").nth(1).unwrap(), "azimuth").unwrap());
        let sky =
            Dir::from_altitude_bearing(degrees("altitude").to_radians(), Bearing::from_degrees(degrees("azimuth")));
        let sun = Surface::Facade.facade_dir(Orientation::new(site).room_from_world(sky));
        let theta = number(first, "theta").unwrap();
        assert!((sun.theta().to_degrees() - theta).abs() < 0.01, "{name}: {theta}");
        found.push(Case { name, sun, straight: number(first, "straight").unwrap(), turned: number(first, "turned") });
    }
    assert!(!found.is_empty(), "{system}");
    found
}

/// Shares of the beams that keep the name and that have it turned upside down.
fn shares(specimen: &dyn Specimen, name: Dir<Facade>) -> [f64; 2] {
    let beams = specimen.beams(name, Side::Front);
    [1.0, -1.0].map(|sign| {
        let to = name.vector() * DVec3::new(1.0, sign, 1.0);
        let goes = |beam: &&cfs::compute::system::measure::Beam| {
            beam.transmitted && beam.names.iter().all(|name| (name.vector() - to).length() < 1e-6)
        };
        beams.iter().filter(goes).map(|beam| beam.share).sum()
    })
}

#[test]
fn shares_of_the_reference_kit() {
    let Some(folder) = common::data("reference/cases/beam") else { return };
    let mut wrong = vec![];
    for system in ["lcp", "lcp6", "pane", "pane2", "expanded", "round", "square"] {
        let text = std::fs::read(folder.join(format!("{system}.system.toml"))).unwrap();
        let specimen = system_toml::read(&text).unwrap().system.specimen("").unwrap();
        for case in cases(&folder, system) {
            let [straight, turned] = shares(specimen.as_ref(), case.sun);
            let apart = (straight - case.straight).abs().max(case.turned.map_or(0.0, |share| (turned - share).abs()));
            eprintln!("{}: {apart:.6}", case.name);
            if apart > 1e-4 {
                wrong.push(format!(
                    "{}: {straight:.5} {turned:.5}, expected {:.5} {:?}",
                    case.name, case.straight, case.turned
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
