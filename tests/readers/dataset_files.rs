//! Readers of datasets: BSDF XML, BTDF text, compact datasets, packages.

use super::choices::Choices;
use super::{again, data, edits, told};
use cfs::catalogue;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, Component, Dataset, DescribedState, Scattered, TreeAxes, TreeRank};
use cfs::formats::package::{self, Package, PackageCurvePoint, PackageProduct, PackageProvenance, PackageState};
use cfs::formats::{Format, bsdf_xml, btdf_text, catalogue_fields, dataset_blob, read_dataset};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Values that are made again to be compared; larger matrices are only read.
const SMALL: usize = 40_000;
/// Decoded values that one compact dataset may ask for here. \[bytes\]
const BUDGET: u64 = 256 << 20;

/// A description whose state may go with the data.
fn described(choices: &mut Choices) -> Option<DescribedState> {
    const PANE: &str = "name = \"Pane\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\nabsorption = 10.0\n";
    choices.one_in(5).then(|| DescribedState { text: PANE.to_owned(), state: String::new() })
}

fn written(bytes: Result<cfs::formats::Written, cfs::formats::FormatError>) -> String {
    String::from_utf8(bytes.expect("a dataset with a function").bytes).expect("a text format")
}

pub fn make_matrix(choices: &mut Choices) -> Vec<u8> {
    let basis = match choices.below(8) {
        0 => RingBasis::klems_quarter(AzimuthMap::KLEMS_FRONT),
        _ => RingBasis::new("own", data::rings(choices), AzimuthMap::KLEMS_FRONT)
            .expect("rings that divide the hemisphere"),
    };
    let mut dataset = data::filled(choices, |choices, component| {
        let map = if component.is_front() { AzimuthMap::KLEMS_FRONT } else { AzimuthMap::KLEMS_BACK };
        let basis = basis.clone().with_azimuth(map);
        Btdf::from_cells(data::cells(choices, basis.clone(), basis))
    });
    dataset.described = described(choices);
    edits::text(choices, written(bsdf_xml::write(&dataset)))
}

pub fn make_tree(choices: &mut Choices) -> Vec<u8> {
    let rank = if choices.flag() { TreeRank::Four } else { TreeRank::Three };
    let mut dataset = data::filled(choices, |choices, component| {
        let axes = if component.is_front() { TreeAxes::Front } else { TreeAxes::Back };
        Btdf { regular: None, scattered: Some(Scattered::Tree(Box::new(data::tree(choices, rank, axes)))) }
    });
    dataset.described = described(choices);
    edits::text(choices, written(bsdf_xml::write(&dataset)))
}

fn is_small(dataset: &Dataset) -> bool {
    let size = |btdf: &Btdf| match &btdf.scattered {
        Some(Scattered::Cells(matrix)) => matrix.incident().len() * matrix.emergent().len(),
        Some(Scattered::Directions(data)) => data.incident().len() * data.emergent().len(),
        Some(Scattered::Tree(tree)) => tree.nodes().len(),
        Some(Scattered::Lambert(_)) | None => 0,
    };
    let bands = std::iter::once(&dataset.visible).chain(&dataset.solar);
    bands
        .flat_map(|band| Component::ALL.into_iter().filter_map(|component| band.get(component)))
        .map(size)
        .sum::<usize>()
        <= SMALL
}

/// The same functions to f32, which the compact form keeps?
fn is_kept(dataset: &Dataset) {
    let blob = dataset_blob::encode(dataset);
    let kept = again("a dataset", dataset_blob::decode(&blob));
    assert!(dataset_blob::encode(&kept) == blob, "a dataset changes when its compact form is read and written again");
}

pub fn read_xml(bytes: &[u8]) -> bool {
    let dataset = match bsdf_xml::read(bytes) {
        Ok(dataset) => dataset,
        Err(error) => return told(&error),
    };
    data::sound(&dataset, true);
    if dataset.visible.components().is_empty() || !is_small(&dataset) {
        return true;
    }
    is_kept(&dataset);
    let first = bsdf_xml::write(&dataset).expect("a dataset with a function").bytes;
    let twin = again("BSDF XML", bsdf_xml::read(&first));
    // What is not of the format is left out the first time.
    let second = bsdf_xml::write(&twin).expect("a dataset with a function").bytes;
    let third = bsdf_xml::write(&again("BSDF XML", bsdf_xml::read(&second))).expect("a dataset with a function").bytes;
    same_text("BSDF XML", &second, &third);
    true
}

fn same_text(what: &str, a: &[u8], b: &[u8]) {
    if a != b {
        let (a, b) = (String::from_utf8_lossy(a), String::from_utf8_lossy(b));
        let other = a.lines().zip(b.lines()).find(|(a, b)| a != b);
        panic!("{what} changes when it is read and written again: {other:?}");
    }
}

/// Points as an instrument lists them: five numbers a line.
fn points(choices: &mut Choices) -> String {
    let mut text =
        "---\nformat = \"cfs-btdf 1\"\nquantity = \"btdf\"\nlight_from = \"outside\"\nlayout = \"points\"\n".to_owned();
    if choices.one_in(3) {
        text.push_str("rings = [[90, 120, 4], [120, 170, 6], [170, 180, 1]]\n");
    }
    text.push_str("incidence = \"listed\"\nincident_mean = false\n");
    if choices.one_in(3) {
        let _ = writeln!(text, "symmetry = \"{}\"", choices.pick(&["rotational", "left-right", "up-down", "both"]));
    }
    text.push_str("---\n");
    let (even, steps) = (choices.flag(), 4 + 2 * choices.below(4));
    for k in 0..1 + choices.below(3) {
        let theta = 20 * k;
        for ring in 0..2 + choices.below(3) {
            for step in 0..steps {
                let (theta_a, phi) = if even {
                    (175.0 - 20.0 * ring as f64, step as f64 * 360.0 / steps as f64)
                } else {
                    (choices.tidy(91.0, 180.0), choices.tidy(0.0, 360.0))
                };
                let _ = writeln!(text, "{theta} 30 {theta_a} {phi} {}", choices.tidy(0.0, 0.3));
            }
        }
    }
    text
}

pub fn make_text(choices: &mut Choices) -> Vec<u8> {
    if choices.one_in(3) {
        let text = points(choices);
        return edits::text(choices, text);
    }
    let mut dataset = data::head(choices);
    let component = Component::ALL[choices.below(4)];
    let basis =
        RingBasis::new("own", data::rings(choices), AzimuthMap::FACADE).expect("rings that divide the hemisphere");
    let incident = if choices.one_in(6) {
        RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
    } else {
        RingBasis::new("own", data::rings(choices), AzimuthMap::FACADE).expect("rings that divide the hemisphere")
    };
    dataset.visible.set(component, Btdf::from_cells(data::cells(choices, incident, basis)));
    dataset.described = described(choices);
    let mut text = written(btdf_text::write(&dataset));
    if choices.one_in(4) {
        let symmetry = choices.pick(&["rotational", "left-right", "up-down", "both"]);
        text = text.replacen("incidence =", &format!("symmetry = \"{symmetry}\"\nincidence ="), 1);
    }
    edits::text(choices, text)
}

pub fn read_text(bytes: &[u8]) -> bool {
    let fields = catalogue_fields("x.btdf.txt", bytes);
    let dataset = match btdf_text::read(bytes) {
        Ok(dataset) => dataset,
        Err(error) => return told(&error),
    };
    assert!(
        fields.is_ok() || Format::sniff("x.btdf.txt", bytes) != Some(Format::BtdfText),
        "a header read once and not twice"
    );
    data::sound(&dataset, true);
    if is_small(&dataset) {
        is_kept(&dataset);
        let first = btdf_text::write(&dataset).expect("a dataset with a function").bytes;
        let twin = again("BTDF text", btdf_text::read(&first));
        let second = btdf_text::write(&twin).expect("a dataset with a function").bytes;
        same_text("BTDF text", &first, &second);
    }
    true
}

pub fn make_blob(choices: &mut Choices) -> Vec<u8> {
    let dataset = data::dataset(choices);
    edits::bytes(choices, dataset_blob::encode(&dataset))
}

pub fn read_blob(bytes: &[u8]) -> bool {
    let dataset = match dataset_blob::decode_within(bytes, &mut { BUDGET }) {
        Ok(dataset) => dataset,
        Err(error) => return told(&error),
    };
    data::sound(&dataset, false);
    if is_small(&dataset) {
        is_kept(&dataset);
    }
    true
}

pub fn make_package(choices: &mut Choices) -> Vec<u8> {
    let mut datasets = BTreeMap::new();
    let product = |choices: &mut Choices, datasets: &mut BTreeMap<String, Vec<u8>>, number: usize| {
        let states = (0..1 + choices.below(3)).map(|k| {
            let mut dataset = data::dataset(choices);
            dataset.state = format!("{k}");
            let mut blob = dataset_blob::encode(&dataset);
            if choices.one_in(6) {
                blob = edits::bytes(choices, blob);
            }
            let hash = dataset_blob::content_hash(&blob);
            datasets.insert(hash.clone(), blob);
            PackageState {
                key: dataset.state,
                label: choices.words(),
                value: choices.flag().then_some(k as f64),
                dataset: hash,
            }
        });
        let states = states.collect();
        PackageProduct {
            key: format!("product-{number}"),
            name: choices.words(),
            manufacturer: choices.words(),
            kind: choices.words(),
            description: choices.words(),
            provenance: PackageProvenance {
                origin: choices.words(),
                source_file: choices.words(),
                ..Default::default()
            },
            license: choices.words(),
            tags: (0..choices.below(4)).map(|_| choices.words()).collect(),
            states,
            control_curve: (0..choices.below(3))
                .map(|k| PackageCurvePoint { profile_angle: k as f64, value: 45.0 })
                .collect(),
            system: described(choices).map(|described| described.text).unwrap_or_default(),
        }
    };
    let products = (0..1 + choices.below(2)).map(|number| product(choices, &mut datasets, number)).collect();
    let bytes = package::write(&Package { products, datasets }).expect("a package in memory");
    if choices.one_in(3) { edits::bytes(choices, bytes) } else { damaged_manifest(choices, bytes) }
}

/// The archive with its manifest changed.
fn damaged_manifest(choices: &mut Choices, bytes: Vec<u8>) -> Vec<u8> {
    use std::io::{Cursor, Read as _, Write as _};
    let mut old = zip::ZipArchive::new(Cursor::new(&bytes)).expect("the package that was just written");
    let mut new = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for index in 0..old.len() {
        let mut entry = old.by_index(index).expect("an entry that was just written");
        let name = entry.name().expect("a name that was just written").into_owned();
        let mut content = Vec::new();
        entry.read_to_end(&mut content).expect("an entry that was just written");
        if name == "manifest.json" {
            content = edits::text(choices, String::from_utf8(content).expect("JSON is text"));
        }
        new.start_file(name, zip::write::SimpleFileOptions::default()).expect("an archive in memory");
        new.write_all(&content).expect("an archive in memory");
    }
    new.finish().expect("an archive in memory").into_inner()
}

pub fn read_package(bytes: &[u8]) -> bool {
    let package = match package::read(bytes) {
        Ok(package) => package,
        Err(error) => return told(&error),
    };
    let twin = again("a package", package::write(&package).and_then(|bytes| package::read(&bytes)));
    assert!(twin == package, "a package changes when it is read and written again");
    if let Err(error) = read_dataset("x.cfsp", bytes) {
        told(&error);
    }
    match catalogue::unpack(bytes) {
        Ok(products) => {
            assert_eq!(products.len(), package.products.len(), "products that got lost");
            products.iter().flat_map(|(datasets, _)| datasets).for_each(|dataset| data::sound(dataset, false));
            true
        }
        Err(error) => told(&error),
    }
}
