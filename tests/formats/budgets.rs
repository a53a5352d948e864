//! Budgets of packages and datasets: what is over one is refused before the work, by name; what is named twice is read
//! once.

use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Dataset, Scattered};
use cfs::compute::limits;
use cfs::formats::dataset_blob::{content_hash, decode, decode_within, encode};
use cfs::formats::package::{self, Package, PackageProduct, PackageState};
use cfs::formats::read_dataset;

fn sheet(q: f64) -> Dataset {
    let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let matrix = CellMatrix::new(basis.clone(), basis, vec![q; 145 * 145]).unwrap();
    let mut dataset = Dataset { name: "sheet".into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::from_cells(matrix));
    dataset
}

/// A package of one product whose states all name one dataset.
fn packed(keys: &[String], tags: usize) -> Vec<u8> {
    let blob = encode(&sheet(0.1));
    let hash = content_hash(&blob);
    let states = keys.iter().map(|key| PackageState { key: key.clone(), dataset: hash.clone(), ..Default::default() });
    let product = PackageProduct {
        key: "sheet".into(),
        name: "Sheet".into(),
        states: states.collect(),
        tags: (0..tags).map(|tag| format!("tag {tag}")).collect(),
        ..Default::default()
    };
    package::write(&Package { products: vec![product], datasets: [(hash, blob)].into() }).unwrap()
}

fn keys(count: usize) -> Vec<String> {
    (0..count).map(|key| key.to_string()).collect()
}

#[test]
fn states_and_tags_have_limits_that_are_told() {
    assert_eq!(package::read(&packed(&keys(400), 3)).unwrap().products[0].states.len(), 400);
    for (bytes, told) in [
        (packed(&keys(limits::STATES + 1), 0), "1001 states (at most 1000)"),
        (packed(&keys(2), limits::TAGS + 1), "1001 tags (at most 1000)"),
        (packed(&["30".to_owned(), "30".to_owned()], 0), "two states of the key \"30\""),
    ] {
        let error = package::read(&bytes).unwrap_err().to_string();
        assert!(error.contains("product \"sheet\"") && error.contains(told), "{error}");
    }
}

#[test]
fn a_dataset_that_many_states_name_is_held_once() {
    let datasets = read_dataset("x.cfsp", &packed(&keys(400), 0)).unwrap();
    assert_eq!(datasets.len(), 400);
    let row = |dataset: &Dataset| match dataset.transmission().and_then(|btdf| btdf.scattered.as_ref()) {
        Some(Scattered::Cells(matrix)) => matrix.row(7).as_ptr(),
        _ => panic!("no cells"),
    };
    assert!(datasets.iter().all(|dataset| row(dataset) == row(&datasets[0])), "copies of one dataset");
}

#[test]
fn what_datasets_hold_is_counted_before_it_is_decoded() {
    let blob = encode(&sheet(0.1));
    let each = 8 * 145 * 145;
    let mut left = 2 * each + 1;
    assert!(decode_within(&blob, &mut left).is_ok() && decode_within(&blob, &mut left).is_ok());
    let error = decode_within(&blob, &mut left).unwrap_err().to_string();
    assert!(left == 1 && error.contains("more than 2048 MB"), "{error}");
}

#[test]
fn values_beyond_all_measure_are_refused() {
    assert!(decode(&encode(&sheet(1e8))).is_ok());
    let error = decode(&encode(&sheet(1e30))).unwrap_err().to_string();
    assert!(error.contains("at most 1e9"), "{error}");
}
