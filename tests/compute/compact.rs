//! The compact form from values to bytes and back: τ, thresholds, ratios, sizes, hostile bytes, real files, storage.

pub mod analytic;

use crate::common::{data, left_out};
use analytic::{Noise, glass, rings, system};
use cfs::catalogue::{Catalogue, NewProduct};
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Dataset, Indicatrices, Scattered};
use cfs::compute::wavelet::{CompactReport, CompactRows, Criterion};
use cfs::formats::compact_rows::{RowFile, write};
use cfs::formats::dataset_blob::{content_hash, decode, encode};
use cfs::study::compact::{LOSSLESS_BELOW, Storage, compact, stored_as, stored_by_default};
use proptest::prelude::*;
use std::sync::OnceLock;

fn rows_of(basis: &RingBasis, values: &[f64], criterion: Criterion) -> CompactRows {
    let n = basis.len();
    CompactRows::compress(basis, values.len() / n, |i| values[i * n..(i + 1) * n].to_vec(), criterion).unwrap()
}

fn tau(basis: &RingBasis, row: &[f64]) -> f64 {
    basis.projected_solid_angles().iter().zip(row).map(|(w, q)| w * q).sum()
}

fn dataset(data: Indicatrices) -> Dataset {
    let mut dataset = Dataset { name: "Sample".into(), ..Dataset::default() };
    let scattered = Some(Scattered::Directions(std::sync::Arc::new(data)));
    dataset.visible.transmission_front = Some(Btdf { regular: None, scattered });
    dataset
}

fn directions(dataset: &Dataset) -> &Indicatrices {
    match &dataset.transmission().unwrap().scattered {
        Some(Scattered::Directions(data)) => data,
        other => panic!("{other:?}"),
    }
}

fn criterion() -> impl Strategy<Value = Criterion> {
    let threshold = (-14.0..-0.2_f64).prop_map(f64::exp2);
    (0..3, threshold).prop_map(|(kind, e)| match kind {
        0 => Criterion::Misplaced(e),
        1 => Criterion::Rms(e),
        _ => Criterion::Energy(e),
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Random data of any roughness, zeros and peaks among them.
    #[test]
    fn tau_is_exact_and_the_threshold_kept(
        values in proptest::collection::vec(prop_oneof![Just(0.0), 0.0..1.0_f64, 0.0..1e5_f64], 2 * 145),
        criterion in criterion(),
        tregenza in any::<bool>(),
    ) {
        let basis = if tregenza { RingBasis::tregenza() } else { RingBasis::klems_full(AzimuthMap::KLEMS_FRONT) };
        let weights = basis.projected_solid_angles();
        let rows = rows_of(&basis, &values, criterion);
        for (i, given) in values.chunks(145).enumerate() {
            let back = rows.row(i);
            let (before, after) = (tau(&basis, given), tau(&basis, &back));
            prop_assert!((after - before).abs() <= 1e-12 * before, "{before} {after}");
            prop_assert!(back.iter().all(|q| *q >= 0.0));
            let error = criterion.error(&weights, given, &back);
            prop_assert!(error <= criterion.threshold(), "{criterion:?}: {error}");
        }
        // What the bytes give back is what was there before them, row by row and all together.
        let bytes = write(&rows);
        let file = RowFile::open(basis.clone(), 2, &bytes).unwrap();
        prop_assert_eq!(file.row(1).unwrap(), rows.row(1));
        prop_assert_eq!(&file.into_rows().unwrap(), &rows);
    }

    #[test]
    fn hostile_bytes_are_errors_or_data(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        cut in proptest::option::of(any::<prop::sample::Index>()),
    ) {
        static MADE: OnceLock<(Indicatrices, Vec<u8>)> = OnceLock::new();
        let (compacted, blob) = MADE.get_or_init(|| {
            let stored = stored_as(&dataset(system("slats", 12.0, 0.02)), Storage::Compact(Criterion::ARCHIVE)).unwrap();
            (directions(&stored).clone(), encode(&stored))
        });
        let rows = compacted.compact_rows().unwrap();
        let mut bytes = write(rows);
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok(rows) = RowFile::open(rows.basis().clone(), 145, &bytes).and_then(RowFile::into_rows) {
            prop_assert!(rows.row(7).iter().all(|q| q.is_finite() && *q >= 0.0));
        }
        let mut blob = blob.clone();
        let at = blob.len() - 1 - (bytes.len() + usize::from(bytes.last().copied().unwrap_or_default())) % blob.len();
        blob[at] ^= 0x55;
        decode(&blob).ok();
    }
}

#[test]
fn a_tighter_threshold_never_keeps_less() {
    let basis = rings(3.0);
    let values = glass(true, &basis);
    let weights = basis.projected_solid_angles();
    let mut last = (0.0, usize::MAX);
    for threshold in [1e-5, 1e-4, 0.001, 0.005, 0.015, 0.05, 0.2, 0.6] {
        let rows = rows_of(&basis, &values, Criterion::Misplaced(threshold));
        let error = Criterion::ARCHIVE.error(&weights, &values, &rows.row(0));
        assert!(error >= last.0 && rows.numbers() <= last.1, "{threshold}: {error}, {} after {last:?}", rows.numbers());
        last = (error, rows.numbers());
    }
    // A thousandth of a percent is as good as all of it.
    let exact = rows_of(&basis, &values, Criterion::Rms(1e-6)).row(0);
    assert!(values.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-5));
}

#[test]
fn energy_is_the_square_of_rms() {
    let basis = rings(4.0);
    let values = glass(false, &basis);
    let [a, b] = [Criterion::Energy(1e-4), Criterion::Rms(1e-2)].map(|criterion| rows_of(&basis, &values, criterion));
    assert_eq!(a.row(0), b.row(0));
}

#[test]
fn ratios_of_the_two_glasses_at_one_percent_rms() {
    for (redirecting, least) in [(true, 10.0), (false, 6.5)] {
        for step in [1.0, 2.0] {
            let basis = rings(step);
            let values = glass(redirecting, &basis);
            let rows = rows_of(&basis, &values, Criterion::Rms(0.01));
            let report = CompactReport::new(&rows, |_| values.clone());
            println!(
                "redirecting {redirecting}, {step}°: {:.1} values a number, rms {:.4}",
                report.ratio(),
                report.rms
            );
            assert!(report.ratio() > least && report.rms <= 0.01);
        }
    }
}

#[test]
fn what_cannot_be_compact_says_so() {
    let basis = rings(12.0);
    let n = basis.len();
    let refuse = |value: f64| CompactRows::compress(&basis, 1, |_| vec![value; n], Criterion::ARCHIVE).unwrap_err();
    assert!(refuse(-1.0).to_string().contains("-1"));
    assert!(refuse(f64::NAN).to_string().contains("NaN"));
    let wild = CompactRows::compress(&basis, 1, |_| vec![1.0; n], Criterion::Misplaced(0.0)).unwrap_err();
    assert!(wild.to_string().contains("allowed"));
    // By default such data are kept as they are, and it is said.
    let incident = system("clear", 12.0, 0.0).incident().to_vec();
    let mut values = vec![1.0; 145 * rings(1.0).len()];
    let mut noise = Noise(5);
    values.iter_mut().for_each(|v| *v += 0.3 * noise.next());
    values[77] = -0.25;
    let kept = stored_by_default(&dataset(Indicatrices::new(incident, rings(1.0), values).unwrap()));
    assert!(directions(&kept).compact_rows().is_none());
    assert!(kept.findings.iter().any(|f| f.code == "lossless-storage" && f.message.contains("-0.25")));
}

#[test]
fn a_blind_of_21_states_at_one_degree_fits() {
    // Every seventh state stands for its neighbours.
    let (mut disk, mut memory) = (0, 0);
    for name in ["slats", "redirect", "laser-cut"] {
        let data = system(name, 1.0, 0.0).compacted(Criterion::ARCHIVE).unwrap();
        let rows = data.compact_rows().unwrap();
        let bytes = write(rows).len();
        println!("{name}: {} kB on disk, {} kB in memory", bytes / 1000, rows.bytes_in_use() / 1000);
        disk += 7 * bytes;
        memory += 7 * rows.bytes_in_use();
    }
    assert!(disk <= 8_000_000 && memory <= 40_000_000, "{disk} {memory}");
}

#[test]
fn stored_data_keep_their_hash_and_their_rows() {
    let given = dataset(system("redirect", 2.0, 0.0));
    let stored = stored_as(&given, Storage::Compact(Criterion::NORMAL)).unwrap();
    let blob = encode(&stored);
    assert!(8 * blob.len() < encode(&given).len());
    let back = decode(&blob).unwrap();
    assert_eq!(back, stored);
    assert_eq!(content_hash(&encode(&back)), content_hash(&blob));
    let (before, after) = (directions(&given), directions(&back));
    assert!(after.compact_rows().is_some());
    for (i, tau) in before.tau_by_direction().iter().enumerate() {
        assert!((after.tau_by_direction()[i] - tau).abs() <= 1e-12);
        assert!((after.rows_tau(i) - tau).abs() <= 1e-12);
    }
    let message = &stored.findings.iter().find(|f| f.code == "compact-storage").unwrap().message;
    assert!(message.contains("1.5 % of the flux") && message.contains("standard room"), "{message}");
    // Values at single points come from the same rows.
    let (d, e) = (before.incident()[40], before.incident()[41]);
    let emergent = cfs::compute::direction::Emergent::from_undeviated(e.0);
    let cell = after.emergent().index(e.0).unwrap();
    assert_eq!(after.q(d, emergent), after.row(40)[cell]);
}

trait RowsTau {
    fn rows_tau(&self, row: usize) -> f64;
}

impl RowsTau for Indicatrices {
    /// τ from the values themselves.
    fn rows_tau(&self, row: usize) -> f64 {
        tau(self.emergent(), &self.row(row))
    }
}

#[test]
fn the_catalogue_takes_large_data_in_compact_form() {
    let given = dataset(system("slats", 2.0, 0.02));
    assert!(encode(&given).len() > LOSSLESS_BELOW);
    let small = dataset(system("diffuser", 10.0, 0.0));
    assert_eq!(stored_by_default(&small), small);
    let mut catalogue = Catalogue::in_memory().unwrap();
    let stored = stored_by_default(&given);
    let key = catalogue.import(&[stored], NewProduct { name: "Slats".into(), ..NewProduct::default() }).unwrap().key;
    let kept = catalogue.dataset(&key, None).unwrap();
    assert!(directions(&kept).compact_rows().is_some());
    assert!(catalogue.product(&key).unwrap().findings.iter().any(|f| f.code == "compact-storage"));
    let again = Catalogue::in_memory().unwrap().import_package(&catalogue.export_package(&[key]).unwrap()).unwrap();
    assert_eq!(again.len(), 1);
}

#[test]
fn matrices_of_cells_stay_compact_too() {
    let data = system("redirect", 4.0, 0.0);
    let values = (0..145).flat_map(|i| data.row(i).into_owned()).collect();
    let matrix = CellMatrix::new(RingBasis::tregenza(), data.emergent().clone(), values).unwrap();
    let mut given = Dataset { name: "Means".into(), ..Dataset::default() };
    given.visible.transmission_front = Some(Btdf::from_cells(matrix.clone()));
    let made = compact(&given, Criterion::ARCHIVE).unwrap();
    let back = decode(&encode(&made.dataset)).unwrap();
    assert_eq!(back, made.dataset);
    let Some(Scattered::Cells(kept)) = &back.transmission().unwrap().scattered else { panic!() };
    assert!(kept.compact_rows().is_some() && (kept.tau_hemispherical() - matrix.tau_hemispherical()).abs() < 1e-12);
    let uniform = vec![1.0; 145];
    let (a, b) = (matrix.luminance(&uniform), kept.luminance(&uniform));
    let off: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum::<f64>() / a.iter().sum::<f64>();
    assert!(off < 0.01, "{off}");
    // The room hardly notices.
    assert!(made.functions[0].effects.len() == 4);
    assert!(
        made.functions[0].effects.iter().all(|effect| effect.illuminance < 0.01),
        "{:?}",
        made.functions[0].effects
    );
}

#[test]
fn files_of_the_reference_kit() {
    let Some(systems) = data("reference/systems") else { return };
    for name in ["clear", "diffuser", "lcp", "lcpskew", "redirect", "scatter", "slats"] {
        let path = systems.join(format!("ana_{name}.btdf.txt"));
        if left_out(&path) {
            continue;
        }
        let text = std::fs::read_to_string(path).unwrap();
        let given = dataset(analytic::read_text(&text));
        let made = compact(&given, Criterion::ARCHIVE).unwrap();
        let f = &made.functions[0];
        let room = f.effects.iter().map(|e| e.illuminance).fold(0.0, f64::max);
        println!(
            "{name:<9} {:6.1} values {:6.1} bytes ({} B, lossless {} B, file {} B), misplaced {:.3} %, room {:.3} %",
            f.report.ratio(),
            f.byte_ratio(),
            f.bytes,
            f.bytes_lossless,
            text.len(),
            100.0 * f.report.misplaced,
            100.0 * room
        );
        assert!(f.report.misplaced_worst <= 0.005 && f.report.tau_error <= 1e-12);
        // Slats throw most of their light upwards: little of it, and so a larger share of it, is moved at the plane.
        assert!(f.bytes < f.bytes_lossless && room < 0.02);
    }
    // Klems matrices are compressed, trees are compact already.
    let Some(makers) = data("data/bsdf") else { return };
    let read = |path: &str| {
        let bytes = std::fs::read(makers.join(path)).unwrap();
        cfs::formats::read_dataset("a.xml", &bytes).unwrap().remove(0)
    };
    let klems = compact(&read("genbsdf_blinds_pair/blinds_klems.xml"), Criterion::ARCHIVE).unwrap();
    assert!(klems.functions.iter().all(|f| f.report.tau_error <= 1e-12 && f.report.misplaced_worst <= 0.005));
    assert!(!klems.functions.is_empty());
    let tree = read("genbsdf_blinds_pair/blinds_tt3.xml");
    assert_eq!(compact(&tree, Criterion::ARCHIVE).unwrap().dataset, tree);
}
