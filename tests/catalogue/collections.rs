//! Collections, recent products, licenses: what users add to products, and how it is found and handed on.

use cfs::catalogue::{Catalogue, CatalogueError, Filter, NewProduct, Query, Words};
use cfs::compute::btdf::{Btdf, Dataset};
use cfs::formats::package;

fn product(catalogue: &mut Catalogue, name: &str, license: &str) -> String {
    let mut dataset = Dataset { name: name.into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(0.4));
    let meta = NewProduct { name: name.into(), license: license.into(), ..NewProduct::default() };
    catalogue.import(&[dataset], meta).unwrap().key
}

fn keys(catalogue: &Catalogue, query: &Query) -> Vec<String> {
    catalogue.search(query).unwrap().into_iter().map(|row| row.key).collect()
}

#[test]
fn a_collection_holds_what_was_put_into_it_and_is_a_facet() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    let mut catalogue = Catalogue::open(&path).unwrap();
    let own = product(&mut catalogue, "Awning", "");
    let both = ["clear-double".to_owned(), own.clone()];
    catalogue.collect(" Atrium ", &both, true).unwrap();
    catalogue.collect("School", std::slice::from_ref(&own), true).unwrap();
    // Twice is once.
    catalogue.collect("School", std::slice::from_ref(&own), true).unwrap();
    drop(catalogue);
    let mut catalogue = Catalogue::open(&path).unwrap();
    let named = |name: &str| Query { collections: vec![name.to_owned()], ..Query::default() };
    assert_eq!(keys(&catalogue, &named("Atrium")), both);
    assert_eq!(keys(&catalogue, &named("School")), std::slice::from_ref(&own));
    let facets = catalogue.facets().unwrap().collections;
    let facets: Vec<(&str, usize)> = facets.iter().map(|one| (one.value.as_str(), one.count)).collect();
    assert_eq!(facets, [("Atrium", 2), ("School", 1)]);
    // Nothing changes where one of the products is not there, and a collection has a name.
    let wrong = catalogue.collect("School", &["clear-double".to_owned(), "none".to_owned()], true);
    assert!(matches!(wrong, Err(CatalogueError::NoProduct(_))));
    assert!(matches!(catalogue.collect(" ", &[], true), Err(CatalogueError::NoCollectionName)));
    assert_eq!(keys(&catalogue, &named("School")), std::slice::from_ref(&own));
    catalogue.collect("School", std::slice::from_ref(&own), false).unwrap();
    assert_eq!(catalogue.collections().unwrap().len(), 1);
    // Out of sight is out of the count; gone for good it leaves, whoever gets its key.
    catalogue.delete_product(&own).unwrap();
    assert_eq!(catalogue.collections().unwrap()[0].products, ["clear-double"]);
    catalogue.restore_product(&own).unwrap();
    assert_eq!(catalogue.collections().unwrap()[0].products, ["awning", "clear-double"]);
    catalogue.remove_product(&own).unwrap();
    assert_eq!(product(&mut catalogue, "Awning", ""), own);
    assert_eq!(catalogue.collections().unwrap()[0].products, ["clear-double"]);
}

#[test]
fn recent_products_come_the_last_first_and_are_counted() {
    let catalogue = Catalogue::in_memory().unwrap();
    let shown = ["laser-cut-panel", "gone", "clear-double"].map(str::to_owned).to_vec();
    let query = Query { shown: shown.clone(), ..Query::default() };
    let all = catalogue.find(&query).unwrap();
    assert_eq!(all.facets.recent, 2);
    assert!(all.entries.len() > 2);
    let query = Query { recent: true, ..query };
    assert_eq!(keys(&catalogue, &query), ["laser-cut-panel", "clear-double"]);
    assert!(query.has(Filter::Recent) && !query.without(Filter::Recent).recent);
    let query = Query { text: "clear".to_owned(), ..query };
    assert_eq!(keys(&catalogue, &query), ["clear-double"]);
}

#[test]
fn a_license_is_stored_changed_and_handed_on_and_only_then_is_the_package_of_the_newer_form() {
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let free = product(&mut catalogue, "Foil", " CC BY 4.0 ");
    let plain = product(&mut catalogue, "Film", "");
    assert_eq!(catalogue.product(&free).unwrap().license, "CC BY 4.0");
    let format = |bytes: &[u8]| {
        let mut zip = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
        std::io::read_to_string(zip.by_name("manifest.json").unwrap()).unwrap()
    };
    let with = catalogue.export_package(std::slice::from_ref(&free)).unwrap();
    let without = catalogue.export_package(std::slice::from_ref(&plain)).unwrap();
    assert!(format(&with).contains("\"cfs-package 2\"") && format(&with).contains("CC BY 4.0"));
    assert!(format(&without).contains("\"cfs-package 1\"") && !format(&without).contains("license"));
    assert_eq!(package::read(&with).unwrap().products[0].license, "CC BY 4.0");
    let mut other = Catalogue::empty_in_memory().unwrap();
    other.import_package(&with).unwrap();
    assert_eq!(other.product(&free).unwrap().license, "CC BY 4.0");
    let words = Words { name: "Foil".into(), license: "on request".into(), ..Words::default() };
    other.describe(&free, &words).unwrap();
    assert_eq!(other.product(&free).unwrap().license, "on request");
    assert!(other.history(&free).unwrap()[0].what.contains("license “CC BY 4.0” became “on request”"));
}
