//! Packages: out of one catalogue, into another, compared, merged, and hostile ones.

use cfs::catalogue::{Catalogue, NewProduct, Origin, Query};
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Dataset};
use cfs::compute::estimate::Silent;
use cfs::formats::package;
use cfs::study::Library;
use cfs::study::builtin::complete;

fn sample(name: &str, state: &str, tau: f64) -> Dataset {
    let basis = RingBasis::klems_quarter(AzimuthMap::KLEMS_FRONT);
    let n = basis.len();
    let values = vec![tau / std::f64::consts::PI; n * n];
    let matrix = CellMatrix::new(basis.clone(), basis, values).unwrap();
    let mut dataset = Dataset { name: name.into(), state: state.into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::from_cells(matrix));
    dataset
}

/// A catalogue that holds the data of a built-in product.
fn with_data_of(key: &str) -> Catalogue {
    let mut catalogue = Catalogue::in_memory().unwrap();
    complete(&mut catalogue, |one| one.product == key, &Library::default(), &Silent).unwrap();
    catalogue
}

fn named(name: &str) -> NewProduct {
    NewProduct { name: name.into(), ..NewProduct::default() }
}

#[test]
fn packages_carry_products_over_unchanged() {
    let mut from = with_data_of("laser-cut-panel");
    let key = from.import(&[sample("Foil", "a", 0.5), sample("Foil", "b", 0.25)], named("")).unwrap().key;
    let keys = ["laser-cut-panel".to_owned(), key.clone()];
    let bytes = from.export_package(&keys).unwrap();
    assert_eq!(bytes, from.export_package(&keys).unwrap());
    let mut to = with_data_of("laser-cut-panel");
    let imported = to.import_package(&bytes).unwrap();
    // What is there already, stays as it is.
    assert_eq!(imported[0].key, "laser-cut-panel");
    assert_eq!(imported[0].same_content_as, ["laser-cut-panel"]);
    assert_eq!(imported[1].key, key);
    let (a, b) = (from.product(&key).unwrap(), to.product(&key).unwrap());
    assert_eq!(a, b);
    // A dataset that was changed on the way is refused, whichever byte.
    let mut content = package::read(&bytes).unwrap();
    let blob = content.datasets.values_mut().next().unwrap();
    let middle = blob.len() / 2;
    blob[middle] ^= 1;
    let forged = package::write(&content).unwrap();
    assert!(to.import_package(&forged).unwrap_err().to_string().contains("hash"));
    for cut in [0, 1, 10, bytes.len() / 2, bytes.len() - 1] {
        assert!(to.import_package(&bytes[..cut]).is_err());
    }
}

#[test]
fn an_empty_catalogue_gives_the_package_back_byte_for_byte() {
    use cfs::catalogue::{CurvePoint, Provenance, StateName};
    let mut from = Catalogue::in_memory().unwrap();
    let meta = NewProduct {
        name: "Foil".into(),
        kind: "film".into(),
        tags: vec!["b".into(), "a".into()],
        provenance: Provenance {
            origin: Origin::Measured,
            author: "Laboratory".into(),
            method: "goniophotometer".into(),
            date: "2026-11-21".into(),
            source_file: "foil.xml".into(),
            source_hash: "0".repeat(64),
            inside_face: "matt".into(),
        },
        states: vec![
            StateName { label: "open".into(), value: Some(0.0) },
            StateName { label: "closed".into(), value: Some(75.5) },
        ],
        control_curve: vec![
            CurvePoint { profile_angle: 10.0, value: 75.5 },
            CurvePoint { profile_angle: 60.0, value: 0.0 },
        ],
        ..NewProduct::default()
    };
    let key = from.import(&[sample("Foil", "a", 0.5), sample("Foil", "b", 0.25)], meta).unwrap().key;
    let bytes = from.export_package(std::slice::from_ref(&key)).unwrap();
    let mut to = Catalogue::in_memory().unwrap();
    assert_eq!(to.import_package(&bytes).unwrap()[0].key, key);
    assert_eq!(to.product(&key).unwrap(), from.product(&key).unwrap());
    // States by their hashes, curve, provenance and tags: all that a package says.
    assert_eq!(to.export_package(&[key]).unwrap(), bytes);
}

#[test]
fn packages_are_compared_and_merged() {
    use cfs::catalogue::{diff_packages, merge_packages};
    let of = |products: &[(&str, f64)]| {
        let mut catalogue = Catalogue::in_memory().unwrap();
        let import = |(name, tau): &(&str, f64)| {
            catalogue.import(&[sample(name, "a", *tau), sample(name, "b", 0.25)], named("")).unwrap().key
        };
        let keys: Vec<String> = products.iter().map(import).collect();
        package::read(&catalogue.export_package(&keys).unwrap()).unwrap()
    };
    let (first, second) = (of(&[("Foil", 0.5), ("Mesh", 0.3)]), of(&[("Mesh", 0.3), ("Foil", 0.75), ("Pane", 0.8)]));
    assert!(diff_packages(&first, &of(&[("Mesh", 0.3), ("Foil", 0.5)])).unwrap().is_same());
    let diff = diff_packages(&first, &second).unwrap();
    assert_eq!((diff.only_first.len(), diff.only_second.as_slice()), (0, ["pane".to_owned()].as_slice()));
    assert_eq!((diff.changed.len(), diff.changed[0].key.as_str()), (1, "foil"));
    let [state] = diff.changed[0].states.as_slice() else { panic!("one state differs") };
    assert_eq!(state.key, "a");
    assert!((state.tau_change.unwrap() - 0.25).abs() < 1e-6, "{:?}", state.tau_change);
    assert!(diff.changed[0].fields.is_empty());
    let mut renamed = first.clone();
    renamed.products[1].name = "Net".into();
    let fields = &diff_packages(&first, &renamed).unwrap().changed[0].fields;
    assert_eq!(fields.as_slice(), [("name".to_owned(), "Mesh".to_owned(), "Net".to_owned())]);

    let merged = merge_packages(&first, &second).unwrap();
    let keys: Vec<&str> = merged.package.products.iter().map(|product| product.key.as_str()).collect();
    assert_eq!(keys, ["foil", "foil-2", "mesh", "pane"]);
    assert_eq!(merged.same, ["mesh"]);
    assert_eq!(merged.renamed, [("foil".to_owned(), "foil-2".to_owned())]);
    let bytes = package::write(&merged.package).unwrap();
    assert_eq!(package::read(&bytes).unwrap(), merged.package);
    // Merging once more adds nothing, and the same content is the same file.
    let again = merge_packages(&merged.package, &second).unwrap();
    assert_eq!(package::write(&again.package).unwrap(), bytes);
    let mut doubled = first.clone();
    doubled.products.push(first.products[0].clone());
    assert!(diff_packages(&doubled, &first).is_err() && merge_packages(&first, &doubled).is_err());
}

#[test]
fn a_package_bomb_is_refused() {
    use std::io::Write;
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    zip.start_file("manifest.json", zip::write::SimpleFileOptions::default()).unwrap();
    let blank = vec![b' '; 1 << 20];
    for _ in 0..64 {
        zip.write_all(&blank).unwrap();
    }
    let bytes = zip.finish().unwrap().into_inner();
    assert!(bytes.len() < 1 << 20);
    let error = package::read(&bytes).unwrap_err().to_string();
    assert!(error.contains("larger than"), "{error}");
}

#[test]
fn a_package_of_what_is_there_changes_nothing_and_data_of_built_in_ones_find_their_place() {
    let from = with_data_of("screen-grey-5");
    let package = from.export_package(&["screen-grey-5".to_owned()]).unwrap();
    // Another file has computed a built-in product whose data this one is still to get.
    let mut to = Catalogue::in_memory().unwrap();
    let before = to.search(&Query::default()).unwrap().len();
    let import = |to: &mut Catalogue| to.import_package(&package).unwrap().remove(0);
    let imported = import(&mut to);
    assert_eq!((imported.key.as_str(), imported.same_content_as.len()), ("screen-grey-5", 0));
    let (own, other) = (to.product("screen-grey-5").unwrap(), from.product("screen-grey-5").unwrap());
    assert_eq!((own.states, own.builtin, own.system), (other.states, true, other.system));
    assert!(own.findings.iter().any(|finding| finding.code == "computed"));
    assert_eq!(*to.dataset("screen-grey-5", None).unwrap(), *from.dataset("screen-grey-5", None).unwrap());
    assert_eq!(import(&mut to).same_content_as, ["screen-grey-5"]);
    assert_eq!(to.search(&Query::default()).unwrap().len(), before);
    // Other data under its key are another product, whether its own are there or not.
    let dataset = from.dataset("screen-grey-5", None).unwrap();
    for mut other in [to, Catalogue::in_memory().unwrap()] {
        let own = NewProduct { key: Some("screen-grey-5".into()), ..named("Mine") };
        assert_eq!(other.import(&[cfs::compute::btdf::Dataset::clone(&dataset)], own).unwrap().key, "screen-grey-5-2");
        let mut changed = package::read(&package).unwrap();
        changed.products[0].provenance.source_hash = "0".repeat(64);
        changed.products[0].name = "Another".into();
        let twice = with_other_data(changed);
        assert_eq!(other.import_package(&twice).unwrap()[0].key, "screen-grey-5-3");
    }
}

/// The package with data of its own, so that it is not the same as any.
fn with_other_data(mut package: package::Package) -> Vec<u8> {
    let blob = cfs::formats::dataset_blob::encode(&sample("Another", "", 0.123));
    let hash = cfs::formats::dataset_blob::content_hash(&blob);
    package.products[0].states[0].dataset.clone_from(&hash);
    package.datasets = std::iter::once((hash, blob)).collect();
    package::write(&package).unwrap()
}
