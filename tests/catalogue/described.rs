//! Descriptions in the catalogue: kept with the product, given with its datasets, in and out of packages.

use cfs::catalogue::{Catalogue, Grouping, NewProduct, SourceFile, builtin_system, gather};
use cfs::compute::btdf::{Btdf, Dataset, DescribedState};
use cfs::formats::{Format, package, read_dataset, system_toml, write_dataset};

const BLIND: &str = "name = \"Blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\nangles = [0, 45]\n\
                     upper = { reflectance = 0.5 }\nlower = { reflectance = 0.3 }\n";

/// A state with numbers that do not matter here.
fn state(key: &str, tau: f64, system: &str) -> Dataset {
    let described = Some(DescribedState { text: system.into(), state: key.into() });
    let mut dataset = Dataset { name: "Blind".into(), state: key.into(), described, ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(tau));
    dataset
}

fn two_states() -> [Dataset; 2] {
    [state("0", 0.5, BLIND), state("45", 0.3, BLIND)]
}

#[test]
fn a_product_keeps_the_description_of_its_data_and_gives_it_with_each_state() {
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let given = two_states();
    let key = catalogue.import(&given, NewProduct::default()).unwrap().key;
    assert_eq!(catalogue.product(&key).unwrap().system, BLIND);
    // Blobs are the content alone: the same numbers without a description are the same content.
    let bare = given.clone().map(|dataset| Dataset { described: None, ..dataset });
    let other = catalogue.import(&bare, NewProduct::default()).unwrap();
    assert_eq!(other.same_content_as, [key.as_str()]);
    for _ in 0..2 {
        for one in &given {
            assert_eq!(catalogue.dataset(&key, Some(&one.state)).unwrap().described, one.described);
            assert_eq!(catalogue.dataset(&other.key, Some(&one.state)).unwrap().described, None);
        }
    }
    let bytes = catalogue.export_package(std::slice::from_ref(&key)).unwrap();
    let read = read_dataset("x.cfsp", &bytes).unwrap();
    assert_eq!(
        read.iter().map(|one| one.described.clone()).collect::<Vec<_>>(),
        given.clone().map(|one| one.described)
    );
    let mut elsewhere = Catalogue::empty_in_memory().unwrap();
    let imported = elsewhere.import_package(&bytes).unwrap().remove(0).key;
    assert_eq!(elsewhere.dataset(&imported, Some("45")).unwrap().described, given[1].described);
}

#[test]
fn data_of_different_descriptions_are_no_described_product() {
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let other = BLIND.replace("0.072", "0.06");
    let mixed = [state("0", 0.5, BLIND), state("45", 0.3, &other)];
    let half = [state("0", 0.5, BLIND), Dataset { described: None, ..state("45", 0.2, BLIND) }];
    for datasets in [mixed, half] {
        let key = catalogue.import(&datasets, NewProduct::default()).unwrap().key;
        assert_eq!(catalogue.product(&key).unwrap().system, "");
        assert_eq!(catalogue.dataset(&key, Some("0")).unwrap().described, None);
    }
}

#[test]
fn files_make_a_described_product() {
    for (format, name) in [(Format::BsdfXml, "xml"), (Format::BtdfText, "btdf.txt")] {
        let files: Vec<SourceFile> = two_states()
            .iter()
            .map(|one| {
                let bytes = write_dataset(format, std::slice::from_ref(one)).unwrap().bytes;
                SourceFile::read(&format!("blind_{}.{name}", one.state), &bytes).unwrap()
            })
            .collect();
        let product = gather(files, Grouping::Proposed).remove(0);
        let mut catalogue = Catalogue::empty_in_memory().unwrap();
        let key = catalogue.import(&product.datasets, product.meta).unwrap().key;
        let product = catalogue.product(&key).unwrap();
        assert_eq!(product.states.iter().map(|one| one.key.as_str()).collect::<Vec<_>>(), ["0", "45"]);
        assert_eq!(product.system, BLIND);
        assert_eq!(catalogue.dataset(&key, Some("45")).unwrap().described, two_states()[1].described);
    }
}

#[test]
fn stacks_of_older_catalogues_find_their_built_in_layers() {
    let (_, text) = builtin_system("double-integral-micro-blind.system.toml").unwrap();
    let mut catalogue = Catalogue::empty_in_memory().unwrap();
    let add = |catalogue: &mut Catalogue, system: &str| {
        let datasets = [Dataset { described: None, ..state("45", 0.5, "") }];
        let meta = NewProduct { system: system.to_owned(), ..NewProduct::default() };
        let key = catalogue.import(&datasets, meta).unwrap().key;
        catalogue.dataset(&key, Some("45")).unwrap().described.clone()
    };
    let described = add(&mut catalogue, text).unwrap();
    assert!(system_toml::states(&described.text).unwrap().contains(&"45".to_owned()));
    // Layers that only their author has, states that are none: the data are all that is known.
    assert_eq!(add(&mut catalogue, &text.replace("clear-single", "my-own")), None);
    assert_eq!(add(&mut catalogue, &BLIND.replace("45", "50")), None);
    assert_eq!(add(&mut catalogue, "what nobody reads"), None);
}

#[test]
fn newer_packages_are_refused_by_their_version() {
    use std::io::Write;
    let made = |manifest: &str| {
        let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        zip.start_file("manifest.json", zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(manifest.as_bytes()).unwrap();
        package::read(&zip.finish().unwrap().into_inner()).unwrap_err().to_string()
    };
    let newer = made("{\"format\": \"cfs-package 3\", \"products\": [{\"rays\": 1}], \"more\": {}}");
    assert_eq!(newer, "the package was written by a newer version of cfs (cfs-package 3; this program reads up to 2)");
    assert!(made("{\"format\": \"other 1\", \"products\": []}").contains("format is \"other 1\""));
    assert!(made("{\"format\": \"cfs-package 0\", \"products\": []}").contains("format is"));
}

#[test]
fn a_newer_catalogue_is_refused_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("newer.sqlite");
    rusqlite::Connection::open(&path)
        .unwrap()
        .execute_batch("PRAGMA application_id = 1128682328; PRAGMA user_version = 10; CREATE TABLE meta (x)")
        .unwrap();
    let Err(error) = Catalogue::open(&path) else { panic!("refused") };
    let told = error.to_string();
    assert!(
        told.contains("newer.sqlite was written by a newer version of cfs (layout 10; this program reads up to 9)"),
        "{told}"
    );
}
