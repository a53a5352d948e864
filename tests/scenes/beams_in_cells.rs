//! The sun through data on cells: beams taken out of them, and what is stated of what the data leave open.

use crate::common::data;
use crate::rooms::{MADE, Text, compute, facade, from_matrix, klems, points, straight_cells, sun_alone};
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{CellMatrix, Dataset};
use cfs::compute::lid::BeamSource;
use cfs::compute::system::slats::{SlatArray, SlatProfile, Surface};
use cfs::study::{Library, RoomResult, load_scene};

/// Sensors on the floor plane from the façade inwards, in the middle of the sun's patch and far beside it; the sun 30°
/// high and square on.
fn room(dataset: Dataset, compute_keys: &str) -> RoomResult {
    let text = Text {
        apertures: vec![facade([0.5, 1.0], [3.0, 1.6], MADE)],
        sky: sun_alone(30.0, 180.0),
        sensors: points(&[[2.0, 2.5, 0.0], [2.0, 5.9, 0.0]], [0.0, 0.0, 1.0]),
        compute: format!("interreflection = false\n{compute_keys}"),
        ..Text::default()
    };
    compute(&text.scene_with(dataset))
}

/// Illuminance of a horizontal plane by the whole sun. [lx]
const WHOLE: f64 = 40_000.0;

#[test]
fn a_pane_on_cells_gives_its_own_beam() {
    let result = room(straight_cells(), "");
    let [lit, dark] = [result.sensors[0], result.sensors[1]];
    assert_eq!(result.beams[0].0, BeamSource::Extracted);
    assert!((lit.total().value - WHOLE).abs() <= lit.data_error, "{lit:?}");
    assert!(lit.data_error < 0.05 * WHOLE, "{lit:?}");
    assert!(dark.total().value <= dark.data_error + 1e-3 && dark.data_error < 0.01 * WHOLE, "{dark:?}");
}

#[test]
fn a_diffuser_has_no_beam() {
    let result = room(klems(|_, _| 0.2), "");
    assert_eq!(result.beams[0].0, BeamSource::Cells, "{:?}", result.beams);
    for sensor in &result.sensors {
        assert_eq!(sensor.beam, 0.0);
        assert!(sensor.data_error < 0.1 * sensor.total().value, "{sensor:?}");
    }
}

#[test]
fn data_taken_at_their_word_have_no_data_error() {
    for made in [straight_cells(), klems(crate::rooms::rough)] {
        let result = room(made, "interpolation = \"patch\"");
        assert!(result.sensors.iter().all(|sensor| sensor.data_error == 0.0 && sensor.beam == 0.0));
        assert_eq!(result.beams[0].0, BeamSource::Cells);
    }
}

#[test]
fn a_beam_left_on_cells_is_doubted() {
    let result = room(straight_cells(), "beam = \"cells\"");
    let lit = result.sensors[0];
    assert_eq!(result.beams[0].0, BeamSource::Cells);
    assert!(lit.beam < 1.0 && lit.data_error > 0.5 * WHOLE, "{lit:?}");
    assert!((lit.total().value - WHOLE).abs() <= lit.data_error, "{lit:?}");
}

#[test]
fn slats_show_their_direct_share() {
    let profile = SlatProfile::Flat { width: 0.05 };
    let array = SlatArray::new(profile, 0.0, 0.042, 0.0, [Surface::matt(0.0); 2]).unwrap();
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let n = basis.len();
    let mut values = vec![0.0; n * n];
    for (k, cell) in basis.cells().enumerate() {
        // The mean over the cell, by many points of equal projected solid angle.
        let [low, high] = [cell.theta_min, cell.theta_max].map(|theta| theta.sin().powi(2));
        let (side, mut sum) = (40, 0.0);
        for p in 0..side * side {
            let at = |k: usize| (k as f64 + 0.5) / f64::from(side as u32);
            let theta = (low + (high - low) * at(p / side)).sqrt().asin();
            let phi = cell.phi + (at(p % side) - 0.5) * cell.width;
            sum += array.direct_share((theta.tan() * phi.sin()).atan());
        }
        values[k * n + k] = sum / (side * side) as f64 / cell.projected_solid_angle();
    }
    let result = room(from_matrix(CellMatrix::new(basis.clone(), basis, values).unwrap()), "");
    let (lit, want) = (result.sensors[0], WHOLE * array.direct_share(30_f64.to_radians()));
    assert!((lit.beam - want).abs() <= lit.data_error, "{lit:?} for {want}");
    assert!((lit.beam - want).abs() < 0.01 * WHOLE, "{lit:?} for {want}");
}

/// Blinds, panels, panes and sheets of which only a Klems file is given, against what they truly do: 95 % of the sensors
/// within what is stated, and that not more than six times what is wrong.
#[test]
fn the_truth_of_strange_files_lies_within_what_is_stated() {
    let Some(folder) = data("reference/cases/stranger") else { return };
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    paths.sort();
    let (mut held, mut all, mut stated, mut wrong) = (0, 0, 0.0, 0.0);
    for path in paths {
        let result = compute(&load_scene(&path, &Library::default()).unwrap());
        let rows: Vec<std::collections::HashMap<String, String>> = csv::Reader::from_path(path.with_extension("csv"))
            .unwrap()
            .deserialize()
            .collect::<Result<_, _>>()
            .unwrap();
        let of = |key: &str| rows.iter().map(|row| row[key].parse().unwrap()).collect::<Vec<f64>>();
        let (truth, unsure) = (of("E_lx"), of("E_error_lx"));
        let mean = truth.iter().sum::<f64>() / truth.len() as f64;
        for (sensor, (want, unsure)) in result.sensors.iter().zip(truth.iter().zip(&unsure)) {
            let total = sensor.total();
            let off = (total.value - want).abs();
            held += usize::from(off <= total.error + unsure + 1e-3);
            all += 1;
            stated += total.error / mean;
            wrong += (off + unsure) / mean;
        }
    }
    println!("{held} of {all} held, stated/true {:.2}", stated / wrong);
    assert!(held * 100 >= all * 95, "{held} of {all}");
    assert!(stated <= 6.0 * wrong, "{stated} for {wrong}");
}
