//! Products after they are stored: what happened to them, other data for their states, folders of packages.

use cfs::catalogue::{Catalogue, CatalogueError, NewProduct, Query, Replacement, StateName, Words, content_of};
use cfs::compute::btdf::{Btdf, Dataset};
use cfs::compute::estimate::Silent;
use cfs::study::subscriptions::{folder_of, sync};
use std::path::Path;

fn state(key: &str, tau: f64) -> Dataset {
    let mut dataset = Dataset { name: "Blind".into(), state: key.into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(tau));
    dataset
}

fn blind() -> (Catalogue, String) {
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let meta = NewProduct { paths: vec!["/a/b0.xml".into(), "/a/b45.xml".into()], ..NewProduct::default() };
    let key = catalogue.import(&[state("0", 0.5), state("45", 0.2)], meta).unwrap().key;
    (catalogue, key)
}

fn told(catalogue: &Catalogue, key: &str) -> Vec<String> {
    catalogue.history(key).unwrap().into_iter().map(|event| event.what).collect()
}

#[test]
fn everything_that_happens_to_a_product_is_written_down_with_its_time() {
    let (mut catalogue, key) = blind();
    let words = Words { name: "Louvre".into(), kind: "louvre".into(), ..Words::default() };
    catalogue.describe(&key, &words).unwrap();
    catalogue.describe(&key, &words).unwrap();
    catalogue.delete_product(&key).unwrap();
    catalogue.restore_product(&key).unwrap();
    let names = [("open", Some(0.0)), ("shut", Some(40.0))];
    let names = names.map(|(label, value)| StateName { label: label.into(), value });
    catalogue.name_states(&key, &names).unwrap();
    assert_eq!(
        told(&catalogue, &key),
        [
            "state 0: “0” became “open”; state 45: “45” became “shut”; state 45: 45° became 40°",
            "restored",
            "deleted (hidden)",
            "name “Blind” became “Louvre”; kind “” became “louvre”",
            "added",
        ]
    );
    let product = catalogue.product(&key).unwrap();
    assert_eq!((product.states[1].key.as_str(), product.states[1].value), ("45", Some(40.0)), "scenes still find it");
    assert!(catalogue.history(&key).unwrap().iter().all(|event| event.at.len() == 20 && event.at.ends_with('Z')));
    assert_eq!(catalogue.source_paths(&key).unwrap(), ["/a/b0.xml", "/a/b45.xml"]);
    // Another product under the key of one that is gone for good begins anew.
    catalogue.remove_product(&key).unwrap();
    assert!(matches!(catalogue.history(&key), Err(CatalogueError::NoProduct(_))));
    let again = catalogue.import(&[state("0", 0.3)], NewProduct::default()).unwrap().key;
    assert_eq!((again == key, told(&catalogue, &again)), (true, vec!["added".to_owned()]));
    assert!(catalogue.source_paths(&again).unwrap().is_empty());
}

#[test]
fn a_state_gets_other_data_and_the_product_can_be_made_what_it_was() {
    let (mut catalogue, key) = blind();
    catalogue.set_favourite(&key, true).unwrap();
    let (whole, before) = (catalogue.product(&key).unwrap(), catalogue.snapshot(&key).unwrap());
    let new = |state_key: &str, tau: f64| {
        let dataset = state("as the file calls it", tau);
        Replacement { state: state_key.into(), content: content_of(&dataset), dataset, file: "new.xml".into() }
    };
    catalogue.replace_states(&key, &[new("45", 0.1)]).unwrap();
    let product = catalogue.product(&key).unwrap();
    let tau = |place: usize| product.states[place].tau_hemispherical.unwrap();
    assert!((tau(0) - 0.5).abs() < 1e-6 && (tau(1) - 0.1).abs() < 1e-6);
    assert_eq!(catalogue.dataset(&key, Some("45")).unwrap().state, "45");
    assert_eq!(told(&catalogue, &key)[0], "data of state 45 replaced by new.xml: τ 0.200 became 0.100");
    assert!(product.favourite);
    // It is found by what it holds now.
    assert_eq!(catalogue.products_holding(&content_of(&state("x", 0.1))).unwrap().len(), 1);
    assert!(catalogue.products_holding(&content_of(&state("x", 0.2))).unwrap().is_empty());
    // All or nothing.
    let refused = catalogue.replace_states(&key, &[new("0", 0.3), new("30", 0.3)]);
    assert!(matches!(refused, Err(CatalogueError::NoState { .. })));
    assert_eq!(catalogue.product(&key).unwrap(), product);
    catalogue.put_back(&before).unwrap();
    assert_eq!(catalogue.product(&key).unwrap(), whole);
    let data = catalogue.dataset(&key, Some("45")).unwrap();
    assert!((data.transmission().unwrap().tau_hemispherical() - 0.2).abs() < 1e-6);
    assert_eq!(told(&catalogue, &key)[0], "The last change was taken back");
}

#[test]
fn products_are_stored_all_or_none_and_taken_out_so() {
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let good = (vec![state("", 0.5)], NewProduct::default());
    // A product of two states of one name is none.
    let bad = (vec![state("0", 0.5), state("0", 0.4)], NewProduct::default());
    assert!(catalogue.import_all(vec![good.clone(), bad]).is_err());
    let count = |catalogue: &Catalogue| catalogue.search(&Query::default()).unwrap().len();
    assert_eq!(count(&catalogue), 0);
    let stored = catalogue.import_all(vec![good.clone(), good]).unwrap();
    let mut keys: Vec<String> = stored.into_iter().map(|one| one.imported.key).collect();
    keys.push("none".into());
    assert!(catalogue.remove_products(&keys).is_err());
    assert_eq!(count(&catalogue), 2);
    keys.pop();
    catalogue.remove_products(&keys).unwrap();
    assert_eq!(count(&catalogue), 0);
}

/// A package with one product of this name.
fn package(folder: &Path, file: &str, name: &str, tau: f64) {
    let mut maker = Catalogue::empty_in_memory().unwrap();
    let mut dataset = state("", tau);
    dataset.name = name.to_owned();
    let key = maker.import(&[dataset], NewProduct::default()).unwrap().key;
    std::fs::write(folder.join(file), maker.export_package(&[key]).unwrap()).unwrap();
}

#[test]
fn a_subscribed_folder_is_listed_read_only_and_read_again_when_it_changes() {
    let folder = tempfile::tempdir().unwrap();
    package(folder.path(), "one.cfsp", "Shared one", 0.3);
    package(folder.path(), "two.cfsp", "Shared two", 0.4);
    std::fs::write(folder.path().join("notes.txt"), "x").unwrap();
    let place = folder_of(folder.path()).unwrap();
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    catalogue.subscribe(&place).unwrap();
    let report = sync(&mut catalogue, &Silent).unwrap();
    assert_eq!((report.taken, report.gone, report.problems.len()), (2, 0, 0), "{report:?}");
    let rows = |catalogue: &Catalogue| catalogue.search(&Query::default()).unwrap();
    assert!(rows(&catalogue).iter().all(|row| row.subscribed == place && row.name.starts_with("Shared")));
    // Nobody changes it here.
    let words = Words { name: "Mine".into(), ..Words::default() };
    for refused in [
        catalogue.describe("shared-one", &words),
        catalogue.remove_product("shared-one"),
        catalogue.replace_states("shared-one", &[]),
        catalogue.name_states("shared-one", &[StateName::default()]),
    ] {
        assert!(matches!(refused, Err(CatalogueError::Subscribed { .. })), "{refused:?}");
    }
    // Nothing changed: nothing is done.
    assert_eq!(sync(&mut catalogue, &Silent).unwrap(), Default::default());
    // One is renewed, under its key; one goes.
    package(folder.path(), "one.cfsp", "Shared one", 0.35);
    std::fs::remove_file(folder.path().join("two.cfsp")).unwrap();
    let report = sync(&mut catalogue, &Silent).unwrap();
    assert_eq!((report.taken, report.gone), (1, 1), "{report:?}");
    let tau = |catalogue: &Catalogue| catalogue.product("shared-one").unwrap().states[0].tau_hemispherical.unwrap();
    assert!((tau(&catalogue) - 0.35).abs() < 1e-6);
    assert!(told(&catalogue, "shared-one")[0].contains("renewed with one.cfsp"));
    // Data that do not match their hash are told and not used; what was there stays.
    let path = folder.path().join("one.cfsp");
    let mut bytes = std::fs::read(&path).unwrap();
    let at = bytes.windows(9).position(|window| window == b"datasets/").unwrap() + 100;
    bytes[at] ^= 1;
    std::fs::write(&path, &bytes).unwrap();
    let report = sync(&mut catalogue, &Silent).unwrap();
    assert_eq!((report.taken, report.problems.len()), (0, 1));
    assert!(report.problems[0].contains("one.cfsp: not used: "), "{:?}", report.problems);
    assert!((tau(&catalogue) - 0.35).abs() < 1e-6);
    // A folder that is away is said, and nothing else breaks.
    drop(folder);
    let report = sync(&mut catalogue, &Silent).unwrap();
    assert!(report.problems[0].contains("is away"), "{:?}", report.problems);
    assert_eq!(rows(&catalogue).len(), 1);
    assert_eq!(catalogue.unsubscribe(&place).unwrap(), 1);
    assert!(rows(&catalogue).is_empty());
    assert!(matches!(catalogue.unsubscribe(&place), Err(CatalogueError::NotSubscribed(_))));
}

#[test]
fn what_was_put_to_a_product_of_an_ended_subscription_is_not_inherited() {
    let folder = tempfile::tempdir().unwrap();
    package(folder.path(), "one.cfsp", "Shared one", 0.3);
    let place = folder_of(folder.path()).unwrap();
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    catalogue.subscribe(&place).unwrap();
    sync(&mut catalogue, &Silent).unwrap();
    let key = "shared-one".to_owned();
    catalogue.set_favourite(&key, true).unwrap();
    catalogue.collect("Atrium", std::slice::from_ref(&key), true).unwrap();
    catalogue.unsubscribe(&place).unwrap();
    let mut own = state("", 0.4);
    own.name = "Shared one".to_owned();
    assert_eq!(catalogue.import(&[own], NewProduct::default()).unwrap().key, key);
    assert!(!catalogue.search(&Query::default()).unwrap()[0].favourite);
    assert!(catalogue.collections().unwrap().iter().all(|one| one.products.is_empty()));
}
