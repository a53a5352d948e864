//! Single directions: beams against the shares that the reference kit's beam scenes state, their balance, and their means
//! against what the goniophotometer measures over cells.

use crate::common;
use cfs::compute::angle::Bearing;
use cfs::compute::basis::{AzimuthMap, RingBasis, sub_directions};
use cfs::compute::direction::{Dir, Facade, Orientation, Surface};
use cfs::compute::estimate::Silent;
use cfs::compute::system::SystemKind;
use cfs::compute::system::clear::Material;
use cfs::compute::system::clear::prism::Prisms;
use cfs::compute::system::measure::beams::{Beams, Effort, Shares};
use cfs::compute::system::measure::directions::at_directions;
use cfs::compute::system::measure::upright::Upright;
use cfs::compute::system::measure::{OpticalModel, Setting, Side};
use cfs::compute::system::stack::{Layer, LayerSource, Stack};
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

/// A system of the kit, the layers of a stack with it.
fn specimen(folder: &Path, file: &str, state: &str) -> Box<dyn OpticalModel> {
    let system = system_toml::read(&std::fs::read(folder.join(file)).unwrap()).unwrap().system;
    let SystemKind::Stack(layers) = &system.kind else { return system.optical_model(state).unwrap() };
    let one = |layer: &Layer| {
        let LayerSource::File(name) = &layer.source else { panic!("{file}: a layer of the catalogue") };
        specimen(folder, name, &layer.state)
    };
    Box::new(Stack::new(layers.iter().map(one).collect()))
}

/// Shares of the beams that keep the name and that have it turned upside down.
fn shares(specimen: &dyn OpticalModel, name: Dir<Facade>) -> [f64; 2] {
    let beams = specimen.beams(name, Side::Front);
    [1.0, -1.0].map(|sign| {
        let to = name.vector() * DVec3::new(1.0, sign, 1.0);
        let goes = |beam: &&cfs::compute::system::measure::Beam| {
            beam.transmitted && beam.directions.iter().all(|name| (name.vector() - to).length() < 1e-6)
        };
        beams.iter().filter(goes).map(|beam| beam.share).sum()
    })
}

/// Points of the sun's disc.
const DISC: usize = 61;

/// Directions that share the sun's disc evenly.
fn disc(sun: Dir<Facade>) -> impl Iterator<Item = Dir<Facade>> {
    let (across, up) = sun.vector().any_orthonormal_pair();
    let radius = 0.5 * 0.533_f64.to_radians();
    (0..DISC).map(move |k| {
        let out = radius * ((k as f64 + 0.5) / DISC as f64).sqrt();
        let (sin, cos) = (2.399_963 * k as f64).sin_cos();
        Dir::new(sun.vector() + out * (cos * across + sin * up)).unwrap()
    })
}

#[test]
fn shares_of_the_reference_kit() {
    let Some(folder) = common::data("reference/cases/beam") else { return };
    let mut wrong = vec![];
    let stacks = ["black50_pane", "pane_black50", "pane_flat50"];
    for system in ["lcp", "lcp6", "pane2", "expanded", "round", "square"].into_iter().chain(stacks) {
        let specimen = specimen(&folder, &format!("{system}.system.toml"), "");
        for case in cases(&folder, system) {
            // Of the light that falls on the sheet.
            let (mut mean, mut light) = ([0.0; 2], 0.0);
            for name in disc(case.sun) {
                let found = shares(specimen.as_ref(), name);
                light += name.vector().z;
                mean.iter_mut().zip(found).for_each(|(mean, share)| *mean += share * name.vector().z);
            }
            let [straight, turned] = mean.map(|sum| sum / light);
            let apart = (straight - case.straight).abs().max(case.turned.map_or(0.0, |share| (turned - share).abs()));
            eprintln!("{}: {apart:.6}", case.name);
            if apart > 1.5e-4 {
                wrong.push(format!(
                    "{}: {straight:.5} {turned:.5}, expected {:.5} {:?}",
                    case.name, case.straight, case.turned
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

fn prisms(angles: [f64; 2]) -> Prisms {
    let material = Material { index: 1.49, absorption: 0.0 };
    Prisms { material, angles: angles.map(f64::to_radians), pitch: 0.001, base: 0.001, flipped: false }
}

#[test]
fn prisms_keep_all_light_in_beams_that_a_closer_look_confirms() {
    for angles in [[42.0, 5.0], [45.0, 45.0], [40.0, 90.0]] {
        let section = prisms(angles).section().unwrap();
        let specimen = section.clone().optical_model();
        for k in 0..24 {
            let name = Dir::from_theta_phi(0.06 * f64::from(k), 2.4 * f64::from(k));
            for side in Side::BOTH {
                let beams = specimen.beams(name, side);
                let all: f64 = beams.iter().map(|beam| beam.share).sum();
                assert!((all - 1.0).abs() < 1e-5, "{angles:?} {k}: {all}");
                assert!(beams.iter().all(|beam| (beam.directions[0].vector().x - name.vector().x).abs() < 1e-12));
                let mut closer = Shares::default();
                section.beams(name, side, Effort { share: 4e-6, seed: 7, surfaces: 20_000 }, &mut closer);
                for beam in &beams {
                    let same = |other: &&cfs::compute::system::measure::beams::SharpBeam| {
                        other.transmitted == beam.transmitted && (other.y - beam.directions[0].vector().y).abs() < 1e-8
                    };
                    let share: f64 = closer.beams.iter().filter(same).map(|other| other.share).sum();
                    assert!((share - beam.share).abs() < 2e-4, "{angles:?} {k}: {share} {beam:?}");
                }
            }
        }
    }
}

/// Systems of every family that needs no other files, but slats.
const FAMILIES: [&str; 8] = [
    "kind = \"laser-cut-panel\"\n[laser-cut-panel]\nindex = 1.49\nspacing = 0.004\ndepth = 0.006\ncut_loss = 0.05",
    "kind = \"prismatic\"\n[prismatic]\nindex = 1.49\nangles = [42.0, 5.0]\npitch = 0.001\nbase = 0.001",
    "kind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\nabsorption = 8.0\npanes = 2",
    "kind = \"diffuser\"\n[diffuser]\nmodel = \"opal\"\nindex = 1.49\ntransmittance = 0.5\nreflectance = 0.35",
    "kind = \"diffuser\"\n[diffuser]\nmodel = \"spreading\"\nindex = 1.49\nregular = 0.1\nlobe = 0.6\nspread = 12.0\ntransmittance = 0.8\nabsorbed = 0.2",
    "kind = \"woven\"\n[woven]\nopenness = 0.05\nreflectance = 0.5\ntransmittance = 0.1",
    "kind = \"perforated\"\n[perforated]\nhole = \"round\"\nwidth = 0.006\npitch = [0.008, 0.008]\nthickness = 0.002\nreflectance = 0.5",
    "kind = \"perforated\"\n[perforated]\nhole = \"rhombus\"\nwidth = 0.052\nheight = 0.018\npitch = [0.062, 0.026]\nstaggered = true\nthickness = 0.008\nrise = 0.006\nreflectance = 0.0",
];

#[test]
fn means_over_single_directions_are_what_is_measured() {
    let cells = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let n = cells.len();
    let weight = cells.projected_solid_angles();
    let setting = Setting { incident: &cells, emergent: &cells, error: 0.01, seed: 1 };
    for text in FAMILIES {
        let text = format!("name = \"x\"\n{text}\n");
        let lying = system_toml::read(text.as_bytes()).unwrap().system.optical_model("").unwrap();
        let made: Box<dyn OpticalModel> = if text.contains("prismatic") { Box::new(Upright(lying)) } else { lying };
        let measured = made.measure(&setting, &Silent).unwrap();
        let mut worst: f64 = 0.0;
        // Beams of a few directions fall on either side of an emergent cell's edge where they are refracted.
        let (parts, allowed) = if text.contains("prismatic") { (24, 0.06) } else { (6, 0.02) };
        for side in Side::BOTH {
            let seen = measured.seen(side);
            for i in [0, 33, 60, 104, 121] {
                let names: Vec<_> = sub_directions(&cells.cell(i), parts).collect();
                let found = at_directions(made.as_ref(), side, &names, &cells, &Silent).unwrap();
                let mean = |rows: &[f64], o: usize| {
                    (0..names.len()).map(|k| rows[k * n + o]).sum::<f64>() / names.len() as f64
                };
                for (rows, row) in [(&found.transmitted, &seen.transmitted), (&found.reflected, &seen.reflected)] {
                    let flux = |of: &dyn Fn(usize) -> f64| (0..n).map(|o| of(o) * weight[o]).sum::<f64>();
                    let total = (flux(&|o| mean(rows, o)) - flux(&|o| row[i * n + o])).abs();
                    let apart = flux(&|o| (mean(rows, o) - row[i * n + o]).abs());
                    worst = worst.max(apart);
                    assert!(total < 0.012, "{text} {side:?} {i}: {total}");
                    assert!(apart < allowed, "{text} {side:?} {i}: {apart}");
                }
                for (k, error) in found.error.iter().enumerate() {
                    let row = |rows: &[f64]| (0..n).map(|o| rows[k * n + o] * weight[o]).sum::<f64>();
                    let all = row(&found.transmitted) + row(&found.reflected) + found.absorbed[k];
                    assert!((all - 1.0).abs() < error + 1e-5, "{text} {side:?} {i}: {all}");
                }
            }
        }
        eprintln!("{worst:.4} {}", text.replace('\n', " "));
    }
}
