//! The catalogue as its users meet it: files, searches, undo, packages, several connections, hostile input.

use crate::datasets::dataset;
use cfs::catalogue::{Catalogue, CatalogueError, NewProduct, Origin, ProductRow, Query, check};
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::{Btdf, CellMatrix, Component, Dataset, Finding, Severity, reciprocity_error};
use cfs::compute::direction::{Dir, Incident};
use cfs::compute::estimate::Silent;
use cfs::formats::dataset_blob::{content_hash, decode, encode};
use cfs::formats::package;
use cfs::study::Library;
use cfs::study::builtin::complete;
use proptest::prelude::*;
use std::path::Path;

/// All rows of all tables in a fixed order: equal texts are equal catalogues.
fn dump(path: &Path) -> String {
    let db = rusqlite::Connection::open(path).unwrap();
    let mut out = String::new();
    for table in ["meta", "product", "dataset", "state", "finding", "control_point", "tag", "favourite"] {
        let mut statement = db
            .prepare(&format!("SELECT * FROM {table} ORDER BY 1, 2"))
            .unwrap_or_else(|_| db.prepare(&format!("SELECT * FROM {table} ORDER BY 1")).unwrap());
        let columns = statement.column_count();
        let mut rows = statement.query([]).unwrap();
        while let Some(row) = rows.next().unwrap() {
            for column in 0..columns {
                out += &format!("{:?}|", row.get_ref(column).unwrap());
            }
            out.push('\n');
        }
    }
    out
}

fn sample(name: &str, state: &str, tau: f64) -> Dataset {
    let basis = RingBasis::klems_quarter(AzimuthMap::KLEMS_FRONT);
    let n = basis.len();
    let values = vec![tau / std::f64::consts::PI; n * n];
    let matrix = CellMatrix::new(basis.clone(), basis, values).unwrap();
    let mut dataset = Dataset { name: name.into(), state: state.into(), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::from_cells(matrix));
    dataset
}

fn named(name: &str) -> NewProduct {
    NewProduct { name: name.into(), ..NewProduct::default() }
}

#[test]
fn built_in_products_keep_energy_and_are_reciprocal() {
    let mut catalogue = Catalogue::in_memory().unwrap();
    let quick = |row: &ProductRow| {
        ["ideal", "pane", "diffuser"].contains(&row.kind.as_str())
            || ["venetian-80-72", "laser-cut-panel"].contains(&row.key.as_str())
    };
    let rows: Vec<ProductRow> = catalogue.search(&Query::default()).unwrap().into_iter().filter(quick).collect();
    assert!(rows.len() >= 13);
    let wanted: Vec<String> = rows.iter().map(|row| row.key.clone()).collect();
    complete(&mut catalogue, |one| wanted.contains(&one.product), &Library::default(), &Silent).unwrap();
    for row in rows {
        let product = catalogue.product(&row.key).unwrap();
        assert_eq!(product.provenance.origin, Origin::Computed);
        assert!(!product.provenance.method.is_empty() && product.builtin);
        for state in &product.states {
            let dataset = catalogue.dataset(&row.key, Some(&state.key)).unwrap();
            let wrong: Vec<_> = check(&dataset).into_iter().filter(|f| f.severity > Severity::Info).collect();
            assert!(wrong.is_empty(), "{} {}: {wrong:?}", row.key, state.key);
            assert_eq!(dataset.visible.components(), Component::ALL);
            let [front, back] =
                [Component::TransmissionFront, Component::TransmissionBack].map(|c| dataset.visible.get(c).unwrap());
            if let Some(error) = reciprocity_error(front, back) {
                assert!(error < 1e-6, "{} {}: {error}", row.key, state.key);
            }
            // No light is won nor, where nothing absorbs, lost.
            let reflected = dataset.visible.reflection_front.as_ref().unwrap().tau_hemispherical();
            let total = front.tau_hemispherical() + reflected;
            assert!(total <= 1.0 + 1e-4, "{}: {total}", row.key);
            if ["open-aperture", "laser-cut-panel"].contains(&row.key.as_str()) {
                assert!(total > 1.0 - 1e-3, "{}: {total}", row.key);
            }
            assert!((state.tau_normal.unwrap() - front.tau_normal()).abs() < 1e-6);
        }
        assert!(catalogue.validate(&row.key).unwrap().iter().all(|f| f.severity == Severity::Info), "{}", row.key);
    }
}

#[test]
fn the_moving_blind_blocks_high_sun_where_its_curve_says() {
    let mut catalogue = Catalogue::in_memory().unwrap();
    complete(&mut catalogue, |one| one.product == "venetian-80-72", &Library::default(), &Silent).unwrap();
    let product = catalogue.product("venetian-80-72").unwrap();
    let at = |psi: f64| product.control_curve.iter().find(|p| p.profile_angle == psi).unwrap().value;
    // asin(0.9 cosψ) − ψ, for the sun's lower edge.
    let cut_off = |psi: f64| {
        let edge = (psi - 0.2665).to_radians();
        ((0.9 * edge.cos()).asin() - edge).to_degrees()
    };
    assert!((at(30.0) - cut_off(30.0)).abs() < 0.05 && (at(20.0) - cut_off(20.0)).abs() < 0.05 && at(60.0) == 0.0);
    let tau = |state: &str, theta: f64, up: f64| {
        let dataset = catalogue.dataset("venetian-80-72", Some(state)).unwrap();
        dataset.transmission().unwrap().tau(Incident(Dir::from_theta_phi(theta.to_radians(), up.to_radians())))
    };
    assert!(tau("45", 40.0, 90.0) < 0.5 * tau("45", 40.0, 270.0));
    assert!(tau("75", 40.0, 90.0) < tau("30", 40.0, 90.0));
}

#[test]
fn a_file_is_made_once_and_opened_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deep/er/catalogue.sqlite");
    drop(Catalogue::open(&path).unwrap());
    let before = dump(&path);
    let again = Catalogue::open(&path).unwrap();
    assert_eq!(dump(&path), before);
    assert!(!again.search(&Query::default()).unwrap().is_empty());
}

#[test]
fn newer_foreign_and_broken_files_are_refused_untouched() {
    let folder = tempfile::tempdir().unwrap();
    let newer = folder.path().join("newer.sqlite");
    drop(Catalogue::open(&newer).unwrap());
    rusqlite::Connection::open(&newer).unwrap().pragma_update(None, "user_version", 999).unwrap();
    assert!(matches!(Catalogue::open(&newer), Err(CatalogueError::Newer { found: 999, .. })));

    let foreign = folder.path().join("foreign.sqlite");
    rusqlite::Connection::open(&foreign)
        .unwrap()
        .execute_batch("CREATE TABLE notes (x); PRAGMA user_version = 1")
        .unwrap();
    let bytes = std::fs::read(&foreign).unwrap();
    assert!(matches!(Catalogue::open(&foreign), Err(CatalogueError::NotACatalogue(_))));
    assert_eq!(std::fs::read(&foreign).unwrap(), bytes);

    let text = folder.path().join("text.sqlite");
    std::fs::write(&text, "this is no database, however long it may be. ".repeat(100)).unwrap();
    assert!(Catalogue::open(&text).is_err());
    assert!(Catalogue::open(folder.path()).is_err());
}

#[test]
fn a_failing_import_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    let mut catalogue = Catalogue::open(&path).unwrap();
    catalogue.import(&[sample("Kept", "", 0.4)], named("")).unwrap();
    let mut other = Catalogue::in_memory().unwrap();
    let curve = vec![cfs::catalogue::CurvePoint { profile_angle: 0.0, value: 1.0 }];
    let curved = NewProduct { control_curve: curve, ..NewProduct::default() };
    let keys = [
        other.import(&[sample("Plain", "", 0.3)], named("")).unwrap().key,
        other.import(&[sample("Led", "", 0.2)], curved).unwrap().key,
    ];
    let package = other.export_package(&keys).unwrap();
    // Each trigger breaks the import at another table, after others were written.
    for table in ["state", "dataset", "finding", "tag", "control_point"] {
        let other = rusqlite::Connection::open(&path).unwrap();
        other
            .execute_batch(&format!(
                "CREATE TRIGGER fault BEFORE INSERT ON {table} BEGIN SELECT raise(ABORT, 'injected'); END"
            ))
            .unwrap();
        let before = dump(&path);
        let mut bad = sample("New", "1", 0.123);
        bad.findings.push(Finding::info("note", "x"));
        let meta = NewProduct {
            tags: vec!["t".into()],
            control_curve: vec![cfs::catalogue::CurvePoint { profile_angle: 0.0, value: 1.0 }],
            ..NewProduct::default()
        };
        let error = catalogue.import(&[bad, sample("New", "2", 0.5)], meta).unwrap_err();
        assert!(error.to_string().contains("injected"), "{table}: {error}");
        // Of a package with two products the first would fit, but not the second.
        if table == "control_point" {
            assert!(catalogue.import_package(&package).is_err());
        }
        assert_eq!(dump(&path), before, "{table}");
        other.execute_batch("DROP TRIGGER fault").unwrap();
    }
    let before = dump(&path);
    assert!(catalogue.import(&[], named("x")).is_err());
    assert!(catalogue.import(&[sample("", "", 0.1)], named("  ")).is_err());
    assert!(catalogue.import(&[sample("A", "1", 0.1), sample("A", "1", 0.2)], named("")).is_err());
    assert!(catalogue.import(&[Dataset { name: "empty".into(), ..Dataset::default() }], named("")).is_err());
    assert!(catalogue.import(&[sample("A", "", f64::NAN)], named("")).is_err());
    assert!(catalogue.import(&[sample("A", "", 1e300)], named("")).is_err());
    assert_eq!(dump(&path), before);
}

#[test]
fn what_is_removed_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    let mut catalogue = Catalogue::open(&path).unwrap();
    let empty = dump(&path);
    let family = [sample("Foil", "0", 0.5), sample("Foil", "30", 0.3)];
    let key = catalogue.import(&family, NewProduct { tags: vec!["b".into(), "a".into()], ..named("") }).unwrap().key;
    catalogue.set_favourite(&key, true).unwrap();
    let product = catalogue.product(&key).unwrap();
    assert_eq!((product.states[1].value, product.favourite), (Some(30.0), true));
    catalogue.remove_product(&key).unwrap();
    assert_eq!(dump(&path), empty);
    assert!(matches!(catalogue.remove_product("clear-single"), Err(CatalogueError::BuiltIn(_))));
    assert!(matches!(catalogue.remove_product("nothing"), Err(CatalogueError::NoProduct(_))));
    assert_eq!(dump(&path), empty);
}

#[test]
fn equal_content_is_told_and_keys_stay_unique() {
    let mut catalogue = Catalogue::in_memory().unwrap();
    let first = catalogue.import(&[sample("Café Écran", "", 0.5)], named("")).unwrap();
    let second = catalogue.import(&[sample("Café Écran", "", 0.5)], named("")).unwrap();
    assert_eq!((first.key.as_str(), second.key.as_str()), ("cafe-ecran", "cafe-ecran-2"));
    assert!(first.same_content_as.is_empty());
    assert_eq!(second.same_content_as, [first.key]);
    // Both share one dataset; removing one must not take it from the other.
    catalogue.remove_product("cafe-ecran").unwrap();
    assert!(catalogue.dataset("cafe-ecran-2", None).is_ok());
}

#[test]
fn renewing_built_in_products_leaves_the_users_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    let mut catalogue = Catalogue::open(&path).unwrap();
    catalogue.set_favourite("clear-double", true).unwrap();
    let mine = catalogue.import(&[sample("Mine", "", 0.2)], named("")).unwrap().key;
    let before = catalogue.product(&mine).unwrap();
    drop(catalogue);
    let db = rusqlite::Connection::open(&path).unwrap();
    db.execute_batch(
        "UPDATE meta SET value = '0' WHERE key = 'builtin_version';
         UPDATE product SET name = 'Outdated' WHERE key = 'clear-double';
         UPDATE product SET key = 'no-longer-built-in' WHERE key = 'clear-triple';",
    )
    .unwrap();
    let catalogue = Catalogue::open(&path).unwrap();
    let renewed = catalogue.product("clear-double").unwrap();
    assert!(renewed.name == "Clear glass, double" && renewed.favourite);
    assert!(catalogue.product("clear-triple").is_ok() && catalogue.product("no-longer-built-in").is_err());
    assert_eq!(catalogue.product(&mine).unwrap(), before);
    assert_eq!(catalogue.search(&Query { text: "outdated".into(), ..Query::default() }).unwrap(), []);
}

#[test]
fn searching_finds_prefixes_without_marks_and_filters() {
    let mut catalogue = Catalogue::in_memory().unwrap();
    let meta = NewProduct {
        manufacturer: "Müller & Søn".into(),
        kind: "woven".into(),
        tags: vec!["screen".into(), "grey".into()],
        ..named("Écran tissé 5 %")
    };
    let key = catalogue.import(&[sample("x", "", 0.05)], meta).unwrap().key;
    catalogue.set_favourite(&key, true).unwrap();
    let keys =
        |query: &Query| -> Vec<String> { catalogue.search(query).unwrap().into_iter().map(|row| row.key).collect() };
    for text in ["ecran", "ÉCR", "tisse ecr", "mul", "scre gre", "5"] {
        assert!(keys(&Query { text: text.into(), ..Query::default() }).contains(&key), "{text}");
    }
    assert_eq!(keys(&Query { text: "ecran venetian".into(), ..Query::default() }), Vec::<String>::new());
    let sized = keys(&Query { text: "80/72".into(), ..Query::default() });
    assert!(sized.contains(&"venetian-80-72".to_owned()) && !sized.contains(&key), "{sized:?}");
    assert_eq!(keys(&Query { favourite: Some(true), ..Query::default() }), std::slice::from_ref(&key));
    assert_eq!(keys(&Query { builtin: Some(false), ..Query::default() }), std::slice::from_ref(&key));
    let woven = keys(&Query { kinds: vec!["woven".into()], ..Query::default() });
    assert!(woven.contains(&key) && !woven.contains(&"venetian-80-72".to_owned()), "{woven:?}");
    let grey = keys(&Query { tags: vec!["grey".into(), "screen".into()], ..Query::default() });
    assert!(grey.contains(&key) && grey.len() < woven.len(), "{grey:?}");
    assert_eq!(keys(&Query { manufacturers: vec!["Müller & Søn".into()], ..Query::default() }), [key]);
    assert!(keys(&Query { origin: Some(Origin::Measured), ..Query::default() }).is_empty());
    let facets = catalogue.facets().unwrap();
    assert_eq!(facets.kinds.iter().map(|f| f.count).sum::<usize>(), facets.all);
    assert_eq!((facets.favourites, facets.builtin), (1, facets.all - 1));
    let diffusers = facets.kinds.iter().find(|f| f.value == "diffuser").unwrap();
    assert_eq!(keys(&Query { kinds: vec!["diffuser".into()], ..Query::default() }).len(), diffusers.count);
}

#[test]
fn a_blob_bomb_is_refused() {
    let mut bytes = encode(&sample("x", "", 0.5));
    let good = decode(&bytes).unwrap();
    assert_eq!(good.name, "x");
    // zstd of 200 MB of zeros in place of 41 · 41 values.
    let start = bytes.windows(4).rposition(|w| w == [0x28, 0xB5, 0x2F, 0xFD]).unwrap();
    let bomb = zstd::bulk::compress(&vec![0; 200 << 20], 1).unwrap();
    bytes.truncate(start - 4);
    bytes.extend((bomb.len() as u32).to_le_bytes());
    bytes.extend(&bomb);
    bytes.extend([0, 0, 0, 0, 0, 0]);
    assert!(decode(&bytes).is_err());
}

#[test]
fn two_connections_work_on_one_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    // Both make the file at the same time; then both write.
    std::thread::scope(|scope| {
        for worker in 0..2 {
            let path = &path;
            scope.spawn(move || {
                let mut catalogue = Catalogue::open(path).unwrap();
                for k in 0..15 {
                    let name = format!("worker {worker}");
                    catalogue.import(&[sample(&name, "", f64::from(k) / 40.0)], named("")).unwrap();
                    assert!(!catalogue.search(&Query::default()).unwrap().is_empty());
                }
            });
        }
    });
    let catalogue = Catalogue::open(&path).unwrap();
    let facets = catalogue.facets().unwrap();
    assert_eq!(facets.all, facets.builtin + 30);
    assert_eq!(catalogue.search(&Query { text: "worker".into(), ..Query::default() }).unwrap().len(), 30);
}

#[test]
fn a_catalogue_may_move_to_another_thread() {
    fn send<T: Send>(_: &T) {}
    send(&Catalogue::in_memory().unwrap());
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(48) })]

    #[test]
    fn blobs_are_read_as_written(dataset in dataset()) {
        let blob = encode(&dataset);
        prop_assert_eq!(&decode(&blob).unwrap(), &dataset);
        prop_assert_eq!(content_hash(&blob), content_hash(&encode(&dataset)));
    }

    #[test]
    fn damaged_blobs_give_an_error_or_a_dataset(dataset in dataset(), at in any::<prop::sample::Index>(), to in any::<u8>()) {
        let mut blob = encode(&dataset);
        let at = at.index(blob.len());
        match decode(&blob[..at]) {
            Err(_) => {}
            // Its last number was added later and may be absent: blobs without it keep the bytes they always had.
            Ok(read) => {
                prop_assert_eq!(at + size_of::<f64>(), blob.len());
                prop_assert_eq!(read, Dataset { structure: None, ..dataset });
            }
        }
        blob[at] = to;
        let _ = decode(&blob);
    }

    #[test]
    fn noise_is_no_blob(mut noise in prop::collection::vec(any::<u8>(), 0..300)) {
        prop_assert!(decode(&noise).is_err());
        noise.splice(0..0, *b"CFSD\x01");
        let _ = decode(&noise);
        let _ = package::read(&noise);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1) })]

    #[test]
    fn any_text_may_be_searched_for(texts in prop::collection::vec(prop_oneof![
        any::<String>(),
        "[\"*:^()+\\-{}a-z ]{0,30}",
        "(AND|OR|NOT|NEAR|name:|\"|\\*| ){0,12}",
    ], 400)) {
        let catalogue = Catalogue::in_memory().unwrap();
        for text in texts {
            let found = catalogue.search(&Query { text: text.clone(), kinds: vec![text.clone()], ..Query::default() });
            prop_assert!(found.is_ok(), "{:?}: {:?}", text, found);
            let found = catalogue.search(&Query { text: text.clone(), ..Query::default() });
            prop_assert!(found.is_ok(), "{:?}: {:?}", text, found);
        }
    }
}
