//! Run time of reading and writing datasets: a maker's file if the test data are available (`CFS_TEST_DATA`), else one
//! made here.
//!
//! `cargo bench --bench formats`. The error printed first is that of τ after writing and reading.

use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Dataset};
use cfs::formats::dataset_blob::{decode, encode};
use cfs::formats::{Format, read_dataset, write_dataset};
use divan::Bencher;
use divan::counter::BytesCount;
use std::path::{Path, PathBuf};

fn main() {
    let before = made();
    let file = written(&before);
    let after = read_dataset("made.xml", &file).expect("what is written can be read").remove(0);
    let tau = |dataset: &Dataset| dataset.transmission().map_or(0.0, Btdf::tau_hemispherical);
    println!(
        "XML of {} kB: relative error of τ after writing and reading {:.1e}",
        file.len() / 1000,
        (tau(&after) / tau(&before) - 1.0).abs()
    );
    let again = decode(&encode(&before)).expect("what is encoded can be decoded");
    println!("catalogue form of {} kB: {:.1e}", encode(&before).len() / 1000, (tau(&again) / tau(&before) - 1.0).abs());
    divan::main();
}

/// Creates a dataset with a full Klems matrix without zeros.
fn made() -> Dataset {
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let n = basis.len();
    let values = (0..n * n).map(|k| 0.16 * (1.0 + 0.9 * (0.37 * k as f64).sin())).collect();
    let matrix = CellMatrix::new(basis.clone(), basis, values).expect("n² values for n × n cells");
    let mut dataset = Dataset { name: "made".into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::from_cells(matrix));
    dataset
}

fn written(dataset: &Dataset) -> Vec<u8> {
    write_dataset(Format::BsdfXml, std::slice::from_ref(dataset)).expect("a Klems matrix can be written").bytes
}

/// Returns name and bytes of the largest XML file of the test data that is read without error.
fn makers() -> Option<(String, Vec<u8>)> {
    let root = std::env::var_os("CFS_TEST_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared"), PathBuf::from)
        .join("data/bsdf");
    let mut files: Vec<PathBuf> = std::fs::read_dir(root)
        .ok()?
        .filter_map(|folder| std::fs::read_dir(folder.ok()?.path()).ok())
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|e| e.eq_ignore_ascii_case("xml")))
        .collect();
    files.sort_by_key(|path| std::cmp::Reverse(path.metadata().map_or(0, |meta| meta.len())));
    files.into_iter().find_map(|path| {
        let bytes = std::fs::read(&path).ok()?;
        let name = path.file_name()?.to_string_lossy().into_owned();
        read_dataset(&name, &bytes).ok()?;
        Some((name, bytes))
    })
}

#[divan::bench]
fn read_xml(bencher: Bencher<'_, '_>) {
    let (name, bytes) = makers().unwrap_or_else(|| ("made.xml".into(), written(&made())));
    bencher.counter(BytesCount::of_slice(&bytes)).bench_local(|| read_dataset(&name, &bytes));
}

#[divan::bench]
fn write_xml(bencher: Bencher<'_, '_>) {
    let dataset = made();
    bencher.bench_local(|| written(&dataset));
}

#[divan::bench]
fn catalogue_form(bencher: Bencher<'_, '_>) {
    let bytes = encode(&made());
    bencher.counter(BytesCount::of_slice(&bytes)).bench_local(|| decode(&bytes));
}
