//! Which real files are states of one product.

use crate::common::data;
use cfs::catalogue::{Gathered, Grouping, SourceFile, gather};
use std::path::{Path, PathBuf};

fn walk(folder: &Path, list: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            walk(&path, list);
        } else if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("xml")) {
            list.push(path);
        }
    }
}

/// All files that can be read; with the folders they lie in, or as if they lay in one.
fn all(root: &Path, folders: bool) -> Vec<SourceFile> {
    let mut paths = Vec::new();
    walk(root, &mut paths);
    let read = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let mut file = SourceFile::read(&name, &std::fs::read(path).unwrap()).ok()?;
        if folders {
            file.folder = path.parent().unwrap().display().to_string();
        }
        Some(file)
    };
    paths.iter().filter_map(read).collect()
}

fn keys(product: &Gathered) -> Vec<&str> {
    product.datasets.iter().map(|dataset| dataset.state.as_str()).collect()
}

#[test]
fn of_all_makers_files_the_slats_and_the_venetian_are_families_and_nothing_else() {
    let Some(root) = data("data/bsdf") else { return };
    for folders in [true, false] {
        let files = all(&root, folders);
        assert!(files.len() >= 28, "{}", files.len());
        let products = gather(files.clone(), Grouping::Proposed);
        let families: Vec<&Gathered> = products.iter().filter(|product| product.datasets.len() > 1).collect();
        let sources: Vec<Vec<String>> = families.iter().map(|product| product.sources.clone()).collect();
        assert_eq!(
            sources,
            [vec!["ven0.xml", "ven45.xml"], vec!["b00.xml", "b10.xml", "b30.xml", "b45.xml", "b60.xml"]],
            "folders {folders}"
        );
        assert_eq!(keys(families[0]), ["0", "45"]);
        assert_eq!(keys(families[1]), ["0", "10", "30", "45", "60"]);
        assert_eq!(families[0].meta.name, "Single Clear");
        assert_eq!(products.len(), files.len() - 5, "every other file is a product of its own");
        // The template's word is no name.
        assert!(products.iter().all(|product| product.meta.name != "Name"));
    }
}
