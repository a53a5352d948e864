//! `cfs catalogue` as a script would use it, through the library's own entry.

use crate::common::data;
use cfs::cli::catalogue::{Action, CatalogueArgs, ExportArgs, ImportArgs, ListArgs, ShowArgs, run};
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
    run(&CatalogueArgs { action: Action::Export(ExportArgs { keys, out: package.clone() }) }, Some(&file)).unwrap();
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
