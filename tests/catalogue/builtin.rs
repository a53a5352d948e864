//! Built-in products: all there with their figures when a file is opened, their data when they are asked for.

use cfs::catalogue::{
    Catalogue, CatalogueError, Figure, NewProduct, PROFILE_ANGLES, Product, ProductRow, Query, SYSTEMS, StateKey,
    TABLE, fingerprint, key_of_builtin,
};
use cfs::compute::btdf::{Btdf, Dataset, LightFigures, Severity};
use cfs::compute::estimate::{Progress, Silent};
use cfs::formats::figures_table::{FigureRow, read};
use cfs::study::Library;
use cfs::study::builtin::{complete, compute};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Computes the data of states, `None` of all states of a product.
fn provide(catalogue: &mut Catalogue, wanted: &[(&str, Option<&str>)]) -> usize {
    let is_wanted = |one: &StateKey| {
        wanted.iter().any(|(key, state)| *key == one.product && state.is_none_or(|state| state == one.state))
    };
    complete(catalogue, is_wanted, &Library::default(), &Silent).unwrap()
}

fn table() -> Vec<FigureRow> {
    read(TABLE, &PROFILE_ANGLES).unwrap()
}

#[test]
fn a_new_file_finds_every_product_with_its_figures_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let catalogue = Catalogue::open(&folder.path().join("c.sqlite")).unwrap();
    let rows = catalogue.search(&Query::default()).unwrap();
    assert_eq!(rows.len(), SYSTEMS.len() + 2);
    for row in &rows {
        assert!(row.builtin && row.tau_normal.is_some() && row.tau_hemispherical.is_some(), "{}", row.key);
        assert_eq!(row.tau_profile.len(), PROFILE_ANGLES.len(), "{}", row.key);
        let product = catalogue.product(&row.key).unwrap();
        assert!(!product.tags.is_empty() && !product.kind.is_empty() && !product.description.is_empty(), "{}", row.key);
        for state in &product.states {
            assert!(state.light.is_some() && state.tau_hemispherical.is_some(), "{} {}", row.key, state.key);
        }
    }
    // What belongs to a moving product is there without its data.
    let blind = catalogue.product("venetian-80-72").unwrap();
    assert!(blind.states.len() > 10 && !blind.control_curve.is_empty() && blind.tags.contains(&"moving".to_owned()));
    assert!(blind.states.iter().all(|state| state.dataset.is_none() && state.value.is_some()));
    assert!(catalogue.waiting().unwrap().len() + 2 == catalogue.builtin_states().unwrap());
    let found = |text: &str| -> Vec<String> {
        let query = Query { text: text.into(), ..Query::default() };
        catalogue.search(&query).unwrap().into_iter().map(|row| row.key).collect()
    };
    for (name, _) in SYSTEMS.iter().filter(|(name, _)| name.starts_with("prismatic")) {
        assert!(found("prismatic").contains(&key_of_builtin(name).to_owned()), "{name}");
    }
    let kinds = |kind: &str| catalogue.facets().unwrap().kinds.iter().find(|f| f.value == kind).map(|f| f.count);
    assert!(kinds("prismatic") >= Some(6) && kinds("stack") >= Some(8) && kinds("venetian") >= Some(10));
}

#[test]
fn the_table_is_of_these_descriptions_and_small() {
    let how = "write it anew: cfs --catalogue NEW.sqlite catalogue build --table assets/builtin-figures.csv";
    assert!(TABLE.len() < 1 << 20, "{} bytes", TABLE.len());
    let catalogue = Catalogue::in_memory().unwrap();
    let rows = table();
    let mut rest: Vec<&FigureRow> = rows.iter().collect();
    for (name, _) in SYSTEMS.iter() {
        let product = catalogue.product(key_of_builtin(name)).unwrap();
        let fingerprint = fingerprint(&product.system);
        for state in &product.states {
            let at = rest.iter().position(|row| row.product == product.key && row.state == state.key);
            let row =
                rest.remove(at.unwrap_or_else(|| panic!("{} {} is not in the table; {how}", product.key, state.key)));
            assert_eq!(
                row.fingerprint, fingerprint,
                "{} {} was computed from something else; {how}",
                row.product, row.state
            );
        }
    }
    assert!(rest.is_empty(), "{rest:?} are no states any more; {how}");
}

#[test]
fn a_fingerprint_changes_with_any_layer() {
    let catalogue = Catalogue::in_memory().unwrap();
    let stack = catalogue.product("double-integral-micro-blind").unwrap().system;
    assert!(!stack.contains("file ="), "layers are within: {stack}");
    let other = stack.replacen("reflectance = 0.", "reflectance = 0.1", 1);
    assert_ne!(other, stack);
    assert_ne!(fingerprint(&other), fingerprint(&stack));
}

/// What is quick, of every kind: with all their figures, anew.
const SAMPLE: [(&str, &str); 12] = [
    ("clear-double", ""),
    ("low-e-triple", ""),
    ("opal-light", ""),
    ("satinated-glass", ""),
    ("screen-grey-5", ""),
    ("perforated-square-44", ""),
    ("laser-cut-panel", ""),
    ("venetian-80-72", "0"),
    ("venetian-80-72", "45"),
    ("exterior-80-72-white", "30"),
    ("fixed-louvre-150-45", "45"),
    ("low-e-double-interior-screen", ""),
];

#[test]
fn figures_computed_anew_are_those_of_the_table() {
    let mut catalogue = Catalogue::in_memory().unwrap();
    let wanted: Vec<(&str, Option<&str>)> = SAMPLE.iter().map(|(key, state)| (*key, Some(*state))).collect();
    assert_eq!(provide(&mut catalogue, &wanted), SAMPLE.len());
    let rows = table();
    for (key, name) in SAMPLE {
        let row = rows.iter().find(|row| row.product == key && row.state == name).unwrap();
        let product = catalogue.product(key).unwrap();
        let state = product.states.iter().find(|state| state.key == name).unwrap();
        let light = state.light.unwrap();
        let near = |what: &str, own: f64, other: f64| {
            assert!((own - other).abs() < 2e-5, "{key} {name}, {what}: {own}; table: {other}");
        };
        near("normal", state.tau_normal.unwrap(), row.tau_normal);
        near("hemispherical", state.tau_hemispherical.unwrap(), row.tau_hemispherical);
        near("ceiling", light.to_ceiling.unwrap(), row.to_ceiling.unwrap());
        near("sun", light.sun_blocked, row.sun_blocked);
        near("view", light.view, row.view);
        for ((angle, own), other) in PROFILE_ANGLES.iter().zip(&state.tau_profile).zip(&row.tau_profile) {
            near(&format!("{angle}°"), *own, *other);
        }
        // The sun of the figure is one of the profile angles.
        let at = PROFILE_ANGLES.iter().position(|angle| *angle == 45.0).unwrap();
        assert!((1.0 - state.tau_profile[at] - light.sun_blocked).abs() < 1e-12);
    }
}

#[test]
fn figures_of_light_say_what_designers_know_of_the_products() {
    let catalogue = Catalogue::in_memory().unwrap();
    let light = |key: &str, state: &str| {
        let product = catalogue.product(key).unwrap();
        product.states.iter().find(|one| one.key == state).unwrap().light.unwrap()
    };
    // Clear glass: all light goes down, the view is the transmittance.
    let glass = light("clear-double", "");
    let tau = catalogue.product("clear-double").unwrap().states[0].tau_normal.unwrap();
    assert!(glass.to_ceiling.unwrap() < 0.02 && (glass.view - tau).abs() < 1e-3, "{glass:?}");
    // Opal: half of the light goes up, nothing is seen.
    let opal = light("opal-dense", "");
    assert!((opal.to_ceiling.unwrap() - 0.5).abs() < 0.02 && opal.view < 0.01, "{opal:?}");
    // Without a description the data themselves are asked: an even diffuser is no window.
    let even = light("ideal-diffuser", "");
    assert!((even.to_ceiling.unwrap() - 0.5).abs() < 1e-6 && even.view < 1e-9, "{even:?}");
    assert_eq!(light("open-aperture", "").view, 1.0);
    // A screen of 5 % openness is seen through by about 5 %.
    let screen = light("screen-grey-5", "");
    assert!((0.03..0.07).contains(&screen.view), "{screen:?}");
    // Cuts that turn light round send a good part up, most of all of the light from above.
    assert!(light("laser-cut-panel", "").to_ceiling.unwrap() > 0.2);
    // Slats: open ones are seen through, closed ones keep the sun out.
    let (open, closed) = (light("venetian-80-72", "0"), light("venetian-80-72", "75"));
    assert!(open.view > 0.9 && closed.view < 0.05 && closed.sun_blocked > 0.95, "{open:?} {closed:?}");
}

#[test]
fn data_come_when_they_are_asked_for_and_only_those() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    let mut catalogue = Catalogue::open(&path).unwrap();
    let before = catalogue.product("venetian-80-72").unwrap();
    let all = catalogue.waiting().unwrap().len();
    let error = catalogue.dataset("venetian-80-72", Some("45")).unwrap_err();
    assert!(
        matches!(&error, CatalogueError::NotComputed { product, state } if product == "venetian-80-72" && state == "45")
    );
    assert!(error.to_string().contains("\"venetian-80-72\", state \"45\", are not computed yet"), "{error}");
    let error = catalogue.export_package(&["clear-double".to_owned()]).unwrap_err().to_string();
    assert!(error.starts_with("the data of \"clear-double\" are not computed yet"), "{error}");
    // A single state needs no name; one of several does; what is not there is not computed.
    let to_compute = |catalogue: &Catalogue, key: &str, state: Option<&str>| catalogue.to_compute(key, state).unwrap();
    assert_eq!(to_compute(&catalogue, "clear-double", None).as_deref(), Some(""));
    assert_eq!(to_compute(&catalogue, "venetian-80-72", Some("45")).as_deref(), Some("45"));
    for (key, state) in
        [("venetian-80-72", None), ("venetian-80-72", Some("44")), ("none", None), ("open-aperture", None)]
    {
        assert_eq!(to_compute(&catalogue, key, state), None, "{key} {state:?}");
    }
    let told = catalogue.validate("clear-double").unwrap();
    assert!(matches!(told.as_slice(), [only] if only.code == "not-computed" && only.severity == Severity::Info));

    assert_eq!(provide(&mut catalogue, &[("venetian-80-72", Some("45"))]), 1);
    assert_eq!(catalogue.waiting().unwrap().len(), all - 1);
    let dataset = catalogue.dataset("venetian-80-72", Some("45")).unwrap();
    assert_eq!(dataset.described.as_ref().unwrap().text, before.system);
    // Kept: another connection has it, and the figures stay what they were to the digits of the table.
    let other = Catalogue::open(&path).unwrap();
    assert_eq!(*other.dataset("venetian-80-72", Some("45")).unwrap(), *dataset);
    let after = other.product("venetian-80-72").unwrap();
    assert!(after.findings.iter().all(|finding| finding.state == "45") && !after.findings.is_empty());
    for (old, new) in before.states.iter().zip(&after.states) {
        assert_eq!(new.dataset.is_some(), new.key == "45");
        assert!((old.tau_normal.unwrap() - new.tau_normal.unwrap()).abs() < 1e-4, "{}", new.key);
    }
    assert_eq!(provide(&mut catalogue, &[("venetian-80-72", Some("45"))]), 0, "computed once");
}

#[test]
fn two_programs_that_compute_the_same_state_leave_it_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.sqlite");
    let mut first = Catalogue::open(&path).unwrap();
    let mut second = Catalogue::open(&path).unwrap();
    let product = first.product("opal-light").unwrap();
    let dataset = compute(&product, "", &Library::default(), &Silent).unwrap();
    first.put_state(&product, &dataset).unwrap();
    let after = first.product("opal-light").unwrap();
    second.put_state(&product, &dataset).unwrap();
    assert_eq!(second.product("opal-light").unwrap(), after);
    // Data of another description do not come under this one's name.
    let waiting = first.product("opal-dense").unwrap();
    let mut older = waiting.clone();
    older.provenance.source_hash = "0".repeat(64);
    first.put_state(&older, &dataset).unwrap();
    assert_eq!(first.product("opal-dense").unwrap(), waiting);
    // Taking out what nobody refers to leaves alone what others use, though some states refer to nothing.
    let mine = NewProduct { name: "Mine".into(), ..NewProduct::default() };
    let key = second.import(&[Dataset::clone(&dataset)], mine).unwrap().key;
    second.remove_product(&key).unwrap();
    assert!(first.dataset("opal-light", None).is_ok());
    let db = rusqlite::Connection::open(&path).unwrap();
    let unused = "SELECT count(*) FROM dataset WHERE hash NOT IN (SELECT dataset FROM state WHERE dataset IS NOT NULL)";
    assert_eq!(db.query_row(unused, [], |row| row.get::<_, i64>(0)).unwrap(), 0);
}

/// Wanted until some are finished.
struct UntilDone(AtomicUsize, usize);

impl Progress for UntilDone {
    fn advance(&self, _: &'static str, done: usize, _: usize) {
        self.0.fetch_max(done, Ordering::SeqCst);
    }
    fn cancelled(&self) -> bool {
        self.0.load(Ordering::SeqCst) >= self.1
    }
}

#[test]
fn what_is_finished_stays_when_the_rest_is_stopped() {
    let mut catalogue = Catalogue::in_memory().unwrap();
    let panes = |catalogue: &Catalogue| -> Vec<StateKey> {
        let all = catalogue.waiting().unwrap().into_iter();
        all.filter(|one| one.product.starts_with("electrochromic") || one.product.ends_with("-single")).collect()
    };
    let wanted = panes(&catalogue);
    assert!(wanted.len() > 8);
    let stop = UntilDone(AtomicUsize::new(0), 3);
    let some = wanted.clone();
    assert!(complete(&mut catalogue, move |one| some.contains(one), &Library::default(), &stop).is_err());
    let left = panes(&catalogue).len();
    assert!(left <= wanted.len() - 3 && left > 0, "{left} of {}", wanted.len());
    let rest = panes(&catalogue);
    assert_eq!(complete(&mut catalogue, move |one| rest.contains(one), &Library::default(), &Silent).unwrap(), left);
    assert_eq!(panes(&catalogue), []);
}

/// A file as the program before this layout left it: some products computed, the rest not there at all.
fn older_file(path: &Path, new: &Path) {
    let db = rusqlite::Connection::open(path).unwrap();
    db.execute_batch(include_str!("../../migrations/0001_products.sql")).unwrap();
    db.execute_batch(include_str!("../../migrations/0002_system.sql")).unwrap();
    db.execute("ATTACH ? AS new", [new.to_str().unwrap()]).unwrap();
    let columns = "SELECT group_concat(name) FROM pragma_table_info('product', 'main')";
    let columns: String = db.query_row(columns, [], |row| row.get(0)).unwrap();
    db.execute_batch(&format!(
        "INSERT INTO product SELECT {columns} FROM new.product p
           WHERE NOT EXISTS (SELECT 1 FROM new.state s WHERE s.product = p.id AND s.dataset IS NULL);
         INSERT INTO dataset SELECT * FROM new.dataset;
         INSERT INTO state SELECT product, position, key, label, value, dataset, tau_normal, tau_hemispherical, tau_profile
           FROM new.state WHERE product IN (SELECT id FROM main.product);
         INSERT INTO finding SELECT * FROM new.finding;
         INSERT INTO favourite SELECT * FROM new.favourite;
         INSERT INTO meta SELECT * FROM new.meta;
         INSERT INTO product_text (rowid, name, manufacturer, kind, description, tags)
           SELECT id, name, manufacturer, kind, description, '' FROM main.product;
         PRAGMA user_version = 2;"
    ))
    .unwrap();
}

#[test]
fn an_older_catalogue_gets_all_products_and_figures_and_keeps_what_it_has() {
    let folder = tempfile::tempdir().unwrap();
    let (new, old) = (folder.path().join("new.sqlite"), folder.path().join("old.sqlite"));
    let mut catalogue = Catalogue::open(&new).unwrap();
    provide(&mut catalogue, &[("clear-double", None), ("opal-light", None)]);
    catalogue.set_favourite("clear-double", true).unwrap();
    catalogue.set_favourite("prismatic-42-5", true).unwrap();
    let mut mine = Dataset { name: "Mine".into(), ..Dataset::default() };
    mine.visible.transmission_front = Some(Btdf::ideal_diffuse(0.4));
    catalogue.import(&[mine], NewProduct::default()).unwrap();
    drop(catalogue);
    older_file(&old, &new);

    let (expected, mut opened) = (Catalogue::open(&new).unwrap(), Catalogue::open(&old).unwrap());
    let rows = opened.search(&Query::default()).unwrap();
    // Figures of how light leaves are the table's in the one, and have its five decimals.
    let same = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() < 1e-5,
        (a, b) => a == b,
    };
    let others = expected.search(&Query::default()).unwrap();
    assert_eq!(rows.len(), others.len());
    // The user's are computed behind everything else.
    for (row, other) in rows.iter().zip(&others).filter(|(row, _)| row.builtin) {
        for figure in [Figure::ToCeiling, Figure::SunBlocked, Figure::View] {
            assert!(same(row.figure(figure), other.figure(figure)), "{}: {figure:?}", row.key);
        }
        let light = (other.to_ceiling, other.sun_blocked, other.view);
        let row = ProductRow { to_ceiling: light.0, sun_blocked: light.1, view: light.2, ..row.clone() };
        assert_eq!(row, *other);
    }
    assert_eq!(rows.iter().filter(|row| row.favourite).count(), 2);
    let of = |catalogue: &Catalogue, key: &str| -> Product { catalogue.product(key).unwrap() };
    for key in ["clear-double", "opal-light", "open-aperture", "prismatic-42-5"] {
        let (own, other) = (of(&opened, key), of(&expected, key));
        assert_eq!(own.findings, other.findings, "{key}");
        for (a, b) in own.states.iter().zip(&other.states) {
            assert_eq!((&a.dataset, a.tau_normal), (&b.dataset, b.tau_normal), "{key}");
            let (a, b) = (a.light.unwrap(), b.light.unwrap());
            let near = |x: f64, y: f64| (x - y).abs() < 2e-5;
            assert!(near(a.sun_blocked, b.sun_blocked) && near(a.view, b.view), "{key}: {a:?} {b:?}");
            assert!(near(a.to_ceiling.unwrap(), b.to_ceiling.unwrap()), "{key}: {a:?} {b:?}");
        }
    }
    assert!(opened.dataset("clear-double", None).is_ok());
    // Of the user's own product nothing more is known yet; then it is, and then there is nothing more to do.
    assert_eq!(of(&opened, "mine").states[0].light, None);
    assert_eq!(opened.fill_figures(&Silent).unwrap(), 1);
    assert_eq!(of(&opened, "mine").states[0].light, Some(LightFigures::of(&Btdf::ideal_diffuse(0.4))));
    assert_eq!(opened.fill_figures(&Silent).unwrap(), 0);
}
