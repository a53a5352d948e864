//! `cfs catalogue` as a script would use it, through the library's own entry.

use crate::common::data;
use cfs::cli::Over;
use cfs::cli::catalogue::{Action, CatalogueArgs, ExportArgs, Group, ImportArgs, ListArgs, ShowArgs, run};
use cfs::cli::validate::ValidateArgs;
use std::path::{Path, PathBuf};

fn import(files: &[PathBuf]) -> CatalogueArgs {
    let args = ImportArgs {
        files: files.to_vec(),
        name: "Imported".into(),
        manufacturer: String::new(),
        kind: "test".into(),
        tags: vec!["t".into()],
        compact: None,
        group: Group::default(),
    };
    CatalogueArgs { action: Action::Import(args) }
}

fn xml_files(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() && !path.ends_with("malformed") {
            xml_files(&path, out);
        } else if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("xml")) {
            out.push(path);
        }
    }
}

#[test]
fn products_go_out_and_in_again() {
    let folder = tempfile::tempdir().unwrap();
    let (file, other) = (folder.path().join("a.sqlite"), folder.path().join("b.sqlite"));
    let package = folder.path().join("x.cfsp");
    let keys = vec!["laser-cut-panel".to_owned(), "venetian-80-72".to_owned()];
    run(
        &CatalogueArgs { action: Action::Export(ExportArgs { keys, out: package.clone(), over: Over::default() }) },
        Some(&file),
    )
    .unwrap();
    run(&import(std::slice::from_ref(&package)), Some(&other)).unwrap();
    for json in [false, true] {
        // What is there already comes in once.
        let show = ShowArgs { key: "laser-cut-panel".into(), json };
        run(&CatalogueArgs { action: Action::Show(show) }, Some(&other)).unwrap();
        let list = ListArgs { search: "laser".into(), json, ..ListArgs::default() };
        run(&CatalogueArgs { action: Action::List(list) }, Some(&other)).unwrap();
        let all = ValidateArgs { items: vec![], json };
        run(&CatalogueArgs { action: Action::Validate(all) }, Some(&other)).unwrap();
    }
    let twice = ShowArgs { key: "laser-cut-panel-2".into(), json: false };
    assert!(run(&CatalogueArgs { action: Action::Show(twice) }, Some(&other)).is_err());
    let missing = ShowArgs { key: "none".into(), json: false };
    let error = run(&CatalogueArgs { action: Action::Show(missing) }, Some(&other)).unwrap_err().to_string();
    assert!(error.contains("\"none\"") && !error.contains('\n'));
    std::fs::write(&package, b"PK\x03\x04 nothing").unwrap();
    assert!(run(&import(&[package]), Some(&other)).is_err());
    assert!(run(&import(&[folder.path().join("absent.xml")]), Some(&other)).is_err());
    let absent = ValidateArgs { items: vec!["absent".into()], json: false };
    assert!(run(&CatalogueArgs { action: Action::Validate(absent) }, Some(&other)).is_err());
}

#[test]
fn a_reflector_among_others_does_not_stop_their_import() {
    use cfs::catalogue::{Catalogue, Query};
    let folder = tempfile::tempdir().unwrap();
    let blind = std::fs::read_to_string("tests/reference/cases/stranger/sample_1.xml").unwrap();
    let mut functions = blind.split_inclusive("<WavelengthData>");
    let head = functions.next().unwrap().to_owned();
    let reflector = head + &functions.filter(|function| !function.contains("Transmission")).collect::<String>();
    let (blinds, alone) = (folder.path().join("given"), folder.path().join("given/reflector.xml"));
    std::fs::create_dir(&blinds).unwrap();
    std::fs::write(blinds.join("blind.xml"), blind).unwrap();
    std::fs::write(&alone, reflector).unwrap();
    let file = folder.path().join("catalogue.sqlite");
    let each = |path: &Path| {
        let CatalogueArgs { action: Action::Import(args) } = import(&[path.to_owned()]) else { unreachable!() };
        let args = ImportArgs { name: String::new(), group: Group::Each, ..args };
        run(&CatalogueArgs { action: Action::Import(args) }, Some(&file))
    };
    let products = || Catalogue::open(&file).unwrap().search(&Query::default()).unwrap().len();
    let error = each(&alone).unwrap_err().to_string();
    assert!(error.contains("reflector.xml: no visible transmission; expected"), "{error}");
    let before = products();
    each(&blinds).unwrap();
    assert_eq!(products(), before + 1);
    // Every line names its product, and a state without a key leaves no gap.
    let (keys, said) = cfs(&folder.path().join("other.sqlite"), &["catalogue", "import", blinds.to_str().unwrap()]);
    assert!(said.contains("warning: not imported: ") && said.contains(&format!("{}: info: ", keys.trim())), "{said}");
    // As a state of one product it takes the others with it, and that is said.
    let said = run(&import(&[blinds.join("blind.xml"), alone]), Some(&file)).unwrap_err().to_string();
    assert!(said.contains("other states of the product are not imported either: 1"), "{said}");
    assert_eq!(products(), before + 1);
}

/// The program on a catalogue of its own: what it says on standard output and on standard error.
fn cfs(file: &Path, arguments: &[&str]) -> (String, String) {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_cfs"))
        .args(arguments)
        .env("CFS_CATALOGUE", file)
        .env_remove("DISPLAY")
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    (text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_product_nobody_has_used_is_listed_with_figures_and_computed_when_a_room_asks_for_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("c.sqlite");
    let (list, notes) = cfs(&file, &["catalogue", "list", "--search", "prismatic", "--json"]);
    let rows: Vec<serde_json::Value> = serde_json::from_str(&list).unwrap();
    assert!(rows.len() >= 6 && notes.is_empty(), "{notes}");
    assert!(rows.iter().all(|row| row["tau_normal_hemispherical"].is_f64()), "{list}");
    let shown = |key: &str| -> serde_json::Value {
        serde_json::from_str(&cfs(&file, &["catalogue", "show", key, "--json"]).0).unwrap()
    };
    let before = shown("exterior-80-72-white");
    assert!(before["states"][3]["dataset"].is_null() && before["states"][3]["to_ceiling"].is_f64(), "{before}");
    assert!(cfs(&file, &["catalogue", "show", "exterior-80-72-white"]).0.contains("not computed yet"));
    let key = before["states"][3]["key"].as_str().unwrap();
    let scene = folder.path().join("scene.toml");
    let system = format!("{{ catalogue = \"exterior-80-72-white\", state = \"{key}\" }}");
    std::fs::write(&scene, scene_with(&system)).unwrap();
    let lux = cfs(&file, &["room", scene.to_str().unwrap()]).0;
    assert!(lux.lines().count() > 1, "{lux}");
    let after = shown("exterior-80-72-white");
    let computed: Vec<bool> = after["states"].as_array().unwrap().iter().map(|s| s["dataset"].is_string()).collect();
    assert_eq!(computed.iter().filter(|one| **one).count(), 1, "what the room needs, and nothing else");
    assert!(computed[3]);
    // Kept: the second time gives the same.
    assert_eq!(cfs(&file, &["room", scene.to_str().unwrap()]).0, lux);
    // Validation says what there is; a package needs the data, and computes them.
    assert!(cfs(&file, &["catalogue", "validate", "opal-light"]).0.contains("ok"));
    let package = folder.path().join("opal.cfsp");
    let (_, told) = cfs(&file, &["catalogue", "export", "opal-light", "--out", package.to_str().unwrap()]);
    assert!(told.contains("computing 1 state"), "{told}");
    assert!(package.exists() && shown("opal-light")["states"][0]["dataset"].is_string());
}

fn scene_with(system: &str) -> String {
    use crate::rooms::{Text, clear, facade};
    let apertures = vec![facade([0.5, 1.0], [3.0, 1.5], system)];
    Text { apertures, sky: clear(30.0, 180.0, 60_000.0), ..Text::default() }.toml()
}

#[cfg(unix)]
#[test]
fn a_build_that_is_interrupted_keeps_what_is_finished() {
    use cfs::catalogue::Catalogue;
    use std::time::{Duration, Instant};
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("c.sqlite");
    let waiting = || Catalogue::open(&file).unwrap().waiting().unwrap().len();
    let all = waiting();
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_cfs"))
        .args(["catalogue", "build", "--json"])
        .env("CFS_CATALOGUE", &file)
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while waiting() > all - 3 && start.elapsed() < Duration::from_secs(120) {
        std::thread::sleep(Duration::from_millis(20));
    }
    // `kill` of the shell: the program of that name is in a package of its own. Not INT, which what a shell starts in the
    // background ignores.
    let terminate = format!("kill -TERM {}", child.id());
    let interrupt = std::process::Command::new("sh").args(["-c", &terminate]).status().unwrap();
    assert!(interrupt.success() && !child.wait().unwrap().success());
    let left = waiting();
    assert!(left <= all - 3 && left > 0, "{left} of {all}");
    let catalogue = Catalogue::open(&file).unwrap();
    for row in catalogue.search(&cfs::catalogue::Query::default()).unwrap() {
        let findings = catalogue.validate(&row.key).unwrap();
        assert!(findings.iter().all(|f| f.severity < cfs::compute::btdf::Severity::Error), "{}: {findings:?}", row.key);
    }
}

#[test]
fn real_files_survive_the_catalogue() {
    use cfs::catalogue::{Catalogue, NewProduct};
    let Some(data) = data("data") else { return };
    let mut files = Vec::new();
    xml_files(&data, &mut files);
    let mut catalogue = Catalogue::in_memory().unwrap();
    let mut taken = 0;
    for path in files {
        let bytes = std::fs::read(&path).unwrap();
        let Ok(read) = cfs::formats::read_dataset(&path.to_string_lossy(), &bytes) else { continue };
        let meta = NewProduct { name: path.display().to_string(), ..NewProduct::default() };
        let key = match catalogue.import(&read, meta) {
            Ok(imported) => imported.key,
            // Files that hold reflection alone are no systems.
            Err(error) if error.to_string().contains("no visible transmission") => continue,
            Err(error) => panic!("{}: {error}", path.display()),
        };
        let stored = catalogue.dataset(&key, Some(&read[0].state)).unwrap();
        for component in read[0].visible.components() {
            let (a, b) = (read[0].visible.get(component).unwrap(), stored.visible.get(component).unwrap());
            // f32 keeps seven digits of every value, hence of their sums.
            let (a, b) = (a.tau_hemispherical(), b.tau_hemispherical());
            assert!((a - b).abs() <= 2e-7 * a.max(1e-9), "{} {component:?}: {a} {b}", path.display());
        }
        taken += 1;
    }
    println!("{taken} files");
    assert!(taken >= 20, "only {taken} files could be imported");
}
