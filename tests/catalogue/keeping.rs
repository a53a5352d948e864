//! Products after they are stored: other words, out of sight and back, in every connection and after a restart.

use cfs::catalogue::{Catalogue, CatalogueError, Known, NewProduct, Provenance, Query, Words};
use cfs::compute::btdf::{Btdf, Dataset};
use std::path::Path;
use std::sync::Arc;

fn screen(name: &str, tau: f64) -> Dataset {
    let mut dataset = Dataset { name: name.into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(tau));
    dataset
}

fn found(catalogue: &Catalogue, text: &str) -> Vec<String> {
    let query = Query { text: text.to_owned(), ..Query::default() };
    catalogue.search(&query).unwrap().into_iter().map(|row| row.key).collect()
}

fn open(path: &Path) -> Catalogue {
    Catalogue::open(path).unwrap()
}

#[test]
fn other_words_are_found_and_the_key_stays() {
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let key = catalogue.import(&[screen("Unnamed", 0.4)], NewProduct::default()).unwrap().key;
    let words = Words {
        name: " Sonnensegel ".to_owned(),
        manufacturer: "Tuch AG".to_owned(),
        kind: "screen".to_owned(),
        tags: vec!["summer".to_owned(), " ".to_owned(), "summer".to_owned()],
        license: String::new(),
    };
    catalogue.describe(&key, &words).unwrap();
    let product = catalogue.product(&key).unwrap();
    assert_eq!((product.name.as_str(), product.manufacturer.as_str()), ("Sonnensegel", "Tuch AG"));
    assert_eq!((product.kind.as_str(), product.tags), ("screen", vec!["summer".to_owned()]));
    for text in ["sonnen", "tuch", "summer"] {
        assert_eq!(found(&catalogue, text), std::slice::from_ref(&key), "{text}");
    }
    // The key, which scenes name, still finds it.
    assert_eq!(found(&catalogue, "unnamed"), std::slice::from_ref(&key));
    let nameless = catalogue.describe(&key, &Words { name: "  ".to_owned(), ..words.clone() });
    assert!(matches!(nameless, Err(CatalogueError::NoName(_))));
    assert!(matches!(catalogue.describe("none", &words), Err(CatalogueError::NoProduct(_))));
}

#[test]
fn a_dataset_in_use_is_read_once_however_many_others_are_read() {
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let mut add = |number: u32| {
        let dataset = screen(&format!("Screen {number}"), f64::from(number) / 100.0);
        catalogue.import(&[dataset], NewProduct::default()).unwrap().key
    };
    let keys: Vec<String> = (1..=40).map(&mut add).collect();
    let first = catalogue.dataset(&keys[0], None).unwrap();
    for key in &keys {
        catalogue.dataset(key, None).unwrap();
    }
    assert!(Arc::ptr_eq(&first, &catalogue.dataset(&keys[0], None).unwrap()));
    // The last one is held although nobody uses it, until others have been read.
    let last = Arc::downgrade(&catalogue.dataset(&keys[39], None).unwrap());
    assert_eq!(last.strong_count(), 1);
    keys[..39].iter().for_each(|key| drop(catalogue.dataset(key, None).unwrap()));
    assert_eq!(last.strong_count(), 0);
}

#[test]
fn a_deleted_product_is_out_of_sight_after_a_restart_and_comes_back_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    let mut catalogue = open(&path);
    let before = catalogue.facets().unwrap();
    let key = catalogue
        .import(&[screen("Awning", 0.3)], NewProduct { tags: vec!["cloth".into()], ..NewProduct::default() })
        .unwrap()
        .key;
    catalogue.set_favourite(&key, true).unwrap();
    let whole = catalogue.product(&key).unwrap();
    catalogue.delete_product(&key).unwrap();
    drop(catalogue);
    let mut catalogue = open(&path);
    assert!(found(&catalogue, "").iter().all(|other| *other != key) && found(&catalogue, "awning").is_empty());
    assert_eq!(catalogue.facets().unwrap(), before, "chips and totals do not count it");
    let deleted = catalogue.deleted_products().unwrap();
    assert_eq!((deleted.len(), deleted[0].name.as_str(), deleted[0].builtin), (1, "Awning", false));
    assert!(deleted[0].at.starts_with("20") && deleted[0].at.ends_with('Z'), "{}", deleted[0].at);
    // A scene that names it goes on working.
    assert!(catalogue.dataset(&key, None).is_ok());
    assert!(matches!(catalogue.delete_product(&key), Err(CatalogueError::Deleted(_))));
    // Its key is not given to another product meanwhile.
    let other = catalogue.import(&[screen("Awning", 0.5)], NewProduct::default()).unwrap();
    assert_eq!(other.key, format!("{key}-2"));
    catalogue.restore_product(&key).unwrap();
    assert_eq!(catalogue.product(&key).unwrap(), whole);
    assert!(found(&catalogue, "awning").contains(&key));
    assert!(matches!(catalogue.restore_product(&key), Err(CatalogueError::NotDeleted(_))));
}

#[test]
fn a_built_in_product_is_deleted_but_keeps_its_words() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    let mut catalogue = open(&path);
    let total = catalogue.facets().unwrap().all;
    catalogue.delete_product("ideal-diffuser").unwrap();
    assert_eq!(catalogue.facets().unwrap().all, total - 1);
    drop(catalogue);
    let mut catalogue = open(&path);
    assert!(!found(&catalogue, "").contains(&"ideal-diffuser".to_owned()), "the next start does not bring it back");
    let words = Words { name: "Mine".to_owned(), ..Words::default() };
    let error = catalogue.describe("ideal-diffuser", &words).unwrap_err().to_string();
    assert!(error.contains("built in") && error.contains("import"), "{error}");
    catalogue.restore_product("ideal-diffuser").unwrap();
    assert_eq!(catalogue.facets().unwrap().all, total);
}

#[test]
fn content_that_is_there_already_is_found_by_its_files() {
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let hash = "a".repeat(64);
    let provenance = Provenance { source_hash: hash.clone(), ..Provenance::default() };
    let product = NewProduct { provenance, ..NewProduct::default() };
    let key = catalogue.import(&[screen("Screen", 0.4)], product).unwrap().key;
    // Products without a file are no copies of each other.
    catalogue.import(&[screen("Drawn", 0.2)], NewProduct::default()).unwrap();
    assert_eq!(catalogue.products_from(&hash).unwrap(), [Known { key: key.clone(), name: "Screen".to_owned() }]);
    assert!(catalogue.products_from("").unwrap().is_empty());
    catalogue.delete_product(&key).unwrap();
    assert!(catalogue.products_from(&hash).unwrap().is_empty(), "out of sight is not there");
    // The package brings it back instead of doubling it, and taking out for good leaves no mark.
    let package = catalogue.export_package(std::slice::from_ref(&key)).unwrap();
    assert_eq!(catalogue.import_package(&package).unwrap()[0].key, key);
    assert!(catalogue.deleted_products().unwrap().is_empty());
    catalogue.delete_product(&key).unwrap();
    catalogue.remove_product(&key).unwrap();
    assert!(catalogue.deleted_products().unwrap().is_empty());
}
