//! A catalogue that doubts itself: damages of every kind are told, what can be made anew is mended, the rest named.

use cfs::catalogue::{Catalogue, CatalogueError, CurvePoint, NewProduct, Place, Query, check_file, repair_file};
use cfs::compute::btdf::{Btdf, Dataset};
use cfs::compute::estimate::Silent;
use cfs::study::Library;
use cfs::study::builtin::complete;
use cfs::study::health::repair;
use rusqlite::Connection;
use std::path::{Path, PathBuf};

fn opal(tau: f64) -> Dataset {
    let mut dataset = Dataset { name: format!("Opal {tau}"), ..Dataset::default() };
    dataset.visible.transmission_front = Some(Btdf::ideal_diffuse(tau));
    dataset
}

/// A catalogue with products of the user's and a computed one of its own; its path.
fn filled(folder: &Path, own: usize) -> PathBuf {
    let path = folder.join("c.sqlite");
    let mut catalogue = Catalogue::open(&path).unwrap();
    for number in 0..own {
        let control_curve = vec![CurvePoint { profile_angle: 10.0, value: 20.0 }];
        let meta = NewProduct {
            name: format!("Mine {number}"),
            description: "told ".repeat(200),
            control_curve,
            ..NewProduct::default()
        };
        catalogue.import(&[opal(0.1 + 0.5 * number as f64 / own as f64)], meta).unwrap();
    }
    complete(&mut catalogue, |one| one.product == "clear-single", &Library::default(), &Silent).unwrap();
    path
}

#[test]
fn built_in_data_that_are_damaged_are_computed_anew() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 1);
    assert!(check_file(&path).unwrap().damages.is_empty());
    let whole = Catalogue::open(&path).unwrap().dataset("clear-single", None).unwrap();
    let db = Connection::open(&path).unwrap();
    db.execute_batch(
        "UPDATE dataset SET blob = zeroblob(length(blob)) WHERE hash =
           (SELECT dataset FROM state s JOIN product p ON p.id = s.product WHERE p.key = 'clear-single')",
    )
    .unwrap();
    drop(db);
    let told = Catalogue::open(&path).unwrap().dataset("clear-single", None).unwrap_err();
    assert!(matches!(told, CatalogueError::Damaged(_)), "{told}");
    let health = check_file(&path).unwrap();
    assert!(matches!(&*health.damages, [one] if matches!(&one.place, Place::Data { builtin: true, .. })), "{health:?}");
    let mended = repair(&path, &health).unwrap();
    assert!(mended.lost.is_empty() && mended.repaired.len() == 1, "{mended:?}");
    let mut catalogue = Catalogue::open(&path).unwrap();
    assert_eq!(catalogue.to_compute("clear-single", None).unwrap().as_deref(), Some(""));
    complete(&mut catalogue, |one| one.product == "clear-single", &Library::default(), &Silent).unwrap();
    assert_eq!(*catalogue.dataset("clear-single", None).unwrap(), *whole);
}

#[test]
fn an_ideal_system_comes_again_and_importing_again_mends() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 1);
    let spoil = |key: &str| {
        let db = Connection::open(&path).unwrap();
        let sql = "UPDATE dataset SET blob = zeroblob(9) WHERE hash =
                     (SELECT dataset FROM state s JOIN product p ON p.id = s.product WHERE p.key = ?)";
        assert_eq!(db.execute(sql, [key]).unwrap(), 1);
    };
    spoil("ideal-diffuser");
    let mended = repair(&path, &check_file(&path).unwrap()).unwrap();
    assert!(mended.lost.is_empty(), "{mended:?}");
    let mut catalogue = Catalogue::open(&path).unwrap();
    let tau = catalogue.dataset("ideal-diffuser", None).unwrap().transmission().unwrap().tau_hemispherical();
    assert!((tau - 0.5).abs() < 1e-9 && catalogue.product("mine-0").is_ok());
    spoil("mine-0");
    assert!(catalogue.dataset("mine-0", None).is_err());
    catalogue.import(&[opal(0.1)], NewProduct::default()).unwrap();
    assert!(catalogue.dataset("mine-0", None).is_ok());
    drop(catalogue);
    assert!(check_file(&path).unwrap().damages.is_empty());
}

#[test]
fn what_results_hang_on_beside_the_data_is_sealed() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 1);
    for (damage, key, builtin) in [
        (
            "UPDATE control_point SET value = value + 0.5 WHERE product = (SELECT id FROM product WHERE key = 'mine-0')",
            "mine-0",
            false,
        ),
        ("UPDATE product SET system = replace(system, '0', '1') WHERE key = 'venetian-80-72'", "venetian-80-72", true),
        (
            "UPDATE state SET value = value + 1 WHERE product = (SELECT id FROM product WHERE key = 'venetian-80-72')",
            "venetian-80-72",
            true,
        ),
    ] {
        let db = Connection::open(&path).unwrap();
        assert!(db.execute(damage, []).unwrap() > 0, "{damage}");
        drop(db);
        let told = Catalogue::open(&path).unwrap().product(key).unwrap_err().to_string();
        assert!(told.contains(key) && told.contains("check --repair"), "{told}");
        let health = check_file(&path).unwrap();
        assert!(
            health.damages.iter().any(|one| one.place == Place::Product { key: key.into(), builtin }),
            "{health:?}"
        );
        let lost = repair(&path, &health).unwrap().lost;
        assert_eq!(lost.is_empty(), builtin, "{lost:?}");
        let mut catalogue = Catalogue::open(&path).unwrap();
        assert_eq!(catalogue.product(key).is_ok(), builtin);
        if !builtin {
            // What is lost may go, and come again.
            catalogue.remove_product(key).unwrap();
        }
    }
    // Words about a product are the user's to change.
    let mut catalogue = Catalogue::open(&path).unwrap();
    let key = catalogue.import(&[opal(0.7)], NewProduct::default()).unwrap().key;
    let words = cfs::catalogue::Words { name: "Another".into(), ..cfs::catalogue::Words::default() };
    catalogue.describe(&key, &words).unwrap();
    assert_eq!(catalogue.product(&key).unwrap().name, "Another");
    drop(catalogue);
    assert!(check_file(&path).unwrap().damages.is_empty());
}

/// Changes a file behind the program's back.
fn changed(path: &Path, sql: &str) {
    let db = Connection::open(path).unwrap();
    db.execute_batch(sql).unwrap();
    assert!(db.total_changes() > 0, "{sql}");
}

#[test]
fn damaged_built_in_products_are_restored_and_reported() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 1);
    let whole = Catalogue::open(&path).unwrap().search(&Query::default()).unwrap();
    let blind = "WHERE product = (SELECT id FROM product WHERE key = 'venetian-80-72')";
    for (damage, key) in [
        ("UPDATE product SET name = 'Klear glass' WHERE key = 'clear-double'".to_owned(), "clear-double"),
        ("UPDATE product SET kind = 'x' WHERE key = 'open-aperture'".to_owned(), "open-aperture"),
        ("UPDATE product SET source_hash = 'x' WHERE key = 'opal-light'".to_owned(), "opal-light"),
        ("UPDATE product SET name = CAST(x'ff41' AS TEXT) WHERE key = 'opal-light'".to_owned(), "opal-light"),
        ("UPDATE product SET builtin = 0 WHERE key = 'clear-double'".to_owned(), "clear-double"),
        ("UPDATE product SET key = 'cleer-double' WHERE key = 'clear-double'".to_owned(), "cleer-double"),
        ("UPDATE product SET shown_seal = 'x' WHERE key = 'clear-double'".to_owned(), "clear-double"),
        (format!("UPDATE state SET tau_normal = 0.88 {blind}"), "venetian-80-72"),
        (format!("UPDATE state SET label = label || '1' {blind}"), "venetian-80-72"),
        (format!("UPDATE tag SET tag = tag || 'x' {blind}"), "venetian-80-72"),
    ] {
        changed(&path, &damage);
        let health = check_file(&path).unwrap();
        let place = Place::Product { key: key.into(), builtin: true };
        assert!(health.damages.iter().any(|one| one.place == place), "{damage}: {health:?}");
        let catalogue = Catalogue::open(&path).unwrap();
        assert_eq!(catalogue.find(&Query::default()).unwrap().restored, [key], "{damage}");
        assert_eq!(catalogue.search(&Query::default()).unwrap(), whole, "{damage}");
        drop(catalogue);
        let after = check_file(&path).unwrap();
        assert!(after.damages.is_empty(), "{damage}: {after:?}");
        assert_eq!(after.restored.last().map(|(key, _)| key.as_str()), Some(key));
        assert!(Catalogue::open(&path).unwrap().find(&Query::default()).unwrap().restored.is_empty());
    }
    // Without their version nobody knows which they are.
    changed(&path, "UPDATE meta SET value = '$' WHERE key = 'builtin_version'");
    assert_eq!(check_file(&path).unwrap().damages.len(), 1);
    let restored = Catalogue::open(&path).unwrap().find(&Query::default()).unwrap().restored;
    assert_eq!(restored.len() + 1, whole.len());
    assert!(check_file(&path).unwrap().damages.is_empty());
}

#[test]
fn damaged_products_of_the_users_are_not_listed_until_they_are_imported_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 2);
    let catalogue = Catalogue::open(&path).unwrap();
    let package = catalogue.export_package(&["mine-0".to_owned()]).unwrap();
    let whole = catalogue.search(&Query::default()).unwrap();
    let of = |table: &str, set: &str| {
        let product = if table == "product" { "id" } else { "product" };
        format!("UPDATE {table} SET {set} WHERE {product} = (SELECT id FROM product WHERE key = 'mine-0')")
    };
    for damage in [
        of("product", "name = 'Nine 0'"),
        of("product", "builtin = 1"),
        of("product", "author = 'x'"),
        of("state", "tau_hemispherical = 0.88"),
        of("state", "view = NULL"),
    ] {
        changed(&path, &damage);
        let mut catalogue = Catalogue::open(&path).unwrap();
        let found = catalogue.find(&Query::default()).unwrap();
        assert!(found.restored.is_empty(), "{damage}");
        assert_eq!((found.damaged, found.total + 1), (vec!["mine-0".to_owned()], whole.len()), "{damage}");
        assert!(found.entries.iter().all(|row| row.key != "mine-0"));
        assert!(matches!(catalogue.product("mine-0"), Err(CatalogueError::Damaged(_))), "{damage}");
        // Other words do not seal what is damaged.
        let words = cfs::catalogue::Words { name: "Another".into(), ..cfs::catalogue::Words::default() };
        assert!(catalogue.describe("mine-0", &words).is_err(), "{damage}");
        let health = check_file(&path).unwrap();
        let place = Place::Product { key: "mine-0".into(), builtin: false };
        assert!(matches!(&*health.damages, [one] if one.place == place), "{damage}: {health:?}");
        if damage.contains("builtin") {
            let lost = repair(&path, &health).unwrap().lost;
            assert!(matches!(&*lost, [one] if one.contains("\"mine-0\"")), "{lost:?}");
            changed(&path, &of("product", "builtin = 0"));
        } else {
            catalogue.import_package(&package).unwrap();
        }
        assert_eq!(catalogue.search(&Query::default()).unwrap(), whole, "{damage}");
    }
}

#[test]
fn products_of_an_older_layout_are_sealed_unless_they_are_damaged() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 2);
    let whole = Catalogue::open(&path).unwrap().search(&Query::default()).unwrap();
    changed(
        &path,
        "UPDATE control_point SET value = value + 0.5 WHERE product = (SELECT id FROM product WHERE key = 'mine-0');
         ALTER TABLE product DROP COLUMN shown_seal;
         PRAGMA user_version = 8",
    );
    assert_eq!(check_file(&path).unwrap().damages.len(), 1);
    let catalogue = Catalogue::open(&path).unwrap();
    let found = catalogue.find(&Query::default()).unwrap();
    assert_eq!(found.damaged, ["mine-0"]);
    assert!(found.restored.is_empty() && found.total + 1 == whole.len());
    assert_eq!(check_file(&path).unwrap().damages.len(), 1);
    changed(&path, "UPDATE product SET name = 'Nine 1' WHERE key = 'mine-1'");
    assert_eq!(check_file(&path).unwrap().damages.len(), 2);
}

#[test]
fn layout_numbers_that_are_none_are_refused_and_found_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 1);
    for number in [-1_i64, 0, i64::from(i32::MIN)] {
        Connection::open(&path).unwrap().pragma_update(None, "user_version", number).unwrap();
        let told = Catalogue::open(&path).unwrap_err();
        assert!(matches!(told, CatalogueError::Layout { found, .. } if found == number), "{told}");
        let health = check_file(&path).unwrap();
        assert_eq!(health.damages.iter().map(|one| &one.place).collect::<Vec<_>>(), [&Place::Layout]);
        assert_eq!(repair_file(&path, &health).unwrap(), [""; 0]);
        assert!(Catalogue::open(&path).unwrap().product("mine-0").is_ok());
    }
}

#[test]
fn of_broken_pages_what_can_be_read_is_saved_and_the_rest_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 60);
    Connection::open(&path).unwrap().execute_batch("PRAGMA wal_checkpoint(TRUNCATE)").unwrap();
    let whole = std::fs::read(&path).unwrap();
    let page = 4096;
    let pages = whole.len() / page;
    let mut told = 0;
    // Every page but the first, one at a time, a few of them spread over the file.
    for number in (1..pages).step_by((pages / 12).max(1)) {
        let mut bytes = whole.clone();
        bytes[number * page..(number + 1) * page].fill(0xa5);
        let copy = folder.path().join(format!("{number}.sqlite"));
        std::fs::write(&copy, &bytes).unwrap();
        let health = check_file(&copy).unwrap();
        if health.damages.is_empty() {
            // A page that holds nothing.
            continue;
        }
        told += 1;
        let mended = repair(&copy, &health).unwrap();
        assert_eq!(std::fs::read(&mended.copy).unwrap(), bytes, "the file as it was is kept");
        for one in &health.damages {
            // However it reads now: malformed before, gone after.
            let still = matches!(one.place, Place::Data { .. })
                && mended.after.damages.iter().any(|after| after.place == one.place);
            assert!(!still || !mended.repaired.contains(&one.message), "page {number}: {} is not mended", one.message);
        }
        let db = Connection::open(&copy).unwrap();
        let ok: String = db.query_row("PRAGMA integrity_check", [], |row| row.get(0)).unwrap();
        assert_eq!(ok, "ok", "page {number}");
        drop(db);
        // All that is there is as it was stored, all that is not is named.
        let catalogue = Catalogue::open(&copy).unwrap();
        let there: Vec<String> = catalogue.search(&Query::default()).unwrap().into_iter().map(|row| row.key).collect();
        for key in (0..60).map(|number| format!("mine-{number}")) {
            let held = there.contains(&key) && catalogue.dataset(&key, None).is_ok();
            let lost =
                mended.lost.iter().any(|one| one.contains(&format!("\"{key}\"")) || one.contains("rows of table"));
            assert!(held || lost, "page {number}: {key} is gone without a word: {:?}", mended.lost);
        }
        assert!(there.iter().any(|key| key == "venetian-80-72"), "page {number}: built-in products are back");
    }
    assert!(told > 5, "{told} of {pages} pages");
}

#[test]
fn other_files_are_not_mended_into_catalogues() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.sqlite");
    Connection::open(&path).unwrap().execute_batch("CREATE TABLE notes (x); INSERT INTO notes VALUES (1)").unwrap();
    assert!(matches!(check_file(&path), Err(CatalogueError::NotACatalogue(_))));
    assert!(check_file(&folder.path().join("none.sqlite")).is_err());
    std::fs::write(&path, "text ".repeat(1000)).unwrap();
    let told = check_file(&path).unwrap_err().to_string();
    assert!(told.contains("not a catalogue"), "{told}");
}

#[test]
fn pages_of_another_kind_are_found_and_written_anew() {
    let folder = tempfile::tempdir().unwrap();
    let path = filled(folder.path(), 1);
    // Data of built-in products are computed when they are asked for: which products there are does not change.
    let keys = || -> Vec<String> {
        Catalogue::open(&path).unwrap().search(&Query::default()).unwrap().iter().map(|row| row.key.clone()).collect()
    };
    let whole = keys();
    let db = Connection::open(&path).unwrap();
    db.execute_batch("PRAGMA wal_checkpoint(TRUNCATE)").unwrap();
    let root: i64 = db
        .query_row("SELECT rootpage FROM sqlite_schema WHERE name = 'collection_product'", [], |row| row.get(0))
        .unwrap();
    drop(db);
    let mut bytes = std::fs::read(&path).unwrap();
    let root = usize::try_from(root).unwrap();
    let page = &mut bytes[4096 * (root - 1)..4096 * root];
    // An index without entries becomes a table without rows: SQLite's own checks count both alike.
    page[0] = 0x0d;
    std::fs::write(&path, &bytes).unwrap();
    let health = check_file(&path).unwrap();
    assert_eq!(health.damages.iter().map(|one| &one.place).collect::<Vec<_>>(), [&Place::Pages]);
    assert!(repair(&path, &health).unwrap().after.damages.is_empty());
    assert_eq!(keys(), whole);
}
