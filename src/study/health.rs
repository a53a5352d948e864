//! Repair of a catalogue: from the file itself, from the program, and from the files from which its products were
//! imported.

use super::files;
use crate::catalogue::{
    Catalogue, CatalogueError, Damage, Grouping, Health, Place, SourceFile, check_file, copy_aside, gather, repair_file,
};
use crate::compute::btdf::Dataset;
use crate::formats::package;
use std::path::{Path, PathBuf};

/// Result of repairing a catalogue file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RepairResult {
    /// Path of the copy of the unrepaired file.
    pub copy: PathBuf,
    /// Sentences about what was repaired.
    pub repaired: Vec<String>,
    /// Sentences about what was lost.
    pub lost: Vec<String>,
    /// Result of checking the file after the repair.
    pub after: Health,
}

/// Repairs the damage that `health` reports of a catalogue file, as far as it can be restored; a copy of the unrepaired
/// file is made beside it.
///
/// # Errors
/// Returns an error if a file cannot be read or written.
pub fn repair(path: &Path, health: &Health) -> Result<RepairResult, CatalogueError> {
    let copy = copy_aside(path).map_err(|cause| CatalogueError::Folder { path: path.to_owned(), cause })?;
    let mut lost = repair_file(path, health)?;
    let mut catalogue = Catalogue::open(path)?;
    for damage in check_file(path)?.damages {
        if let Place::Data { product, state, hash, .. } = &damage.place {
            regain(&mut catalogue, product, state, hash)?;
        }
    }
    drop(catalogue);
    let after = check_file(path)?;
    // Damage of data may be reported differently now: malformed before, missing after.
    let same = |one: &Damage, other: &Damage| {
        one.message == other.message || (matches!(one.place, Place::Data { .. }) && one.place == other.place)
    };
    let still = |damage: &&Damage| after.damages.iter().any(|other| same(damage, other));
    let repaired = health.damages.iter().filter(|damage| !still(damage)).map(|damage| damage.message.clone()).collect();
    lost.extend(after.damages.iter().map(|damage| damage.message.clone()));
    lost.sort();
    lost.dedup();
    Ok(RepairResult { copy, repaired, lost, after })
}

/// Restores the dataset of a state from the files from which its product was imported, if these still contain exactly
/// the same data. `hash`: hash of the dataset.
fn regain(catalogue: &mut Catalogue, product: &str, state: &str, hash: &str) -> Result<(), CatalogueError> {
    let mut sources = Vec::new();
    let mut paths: Vec<PathBuf> = catalogue.source_paths(product)?.into_iter().map(PathBuf::from).collect();
    if let Some(folder) = catalogue.subscribed_folder(product)? {
        let packages = catalogue.packages_of(&folder)?;
        paths.extend(packages.keys().map(|name| Path::new(&folder).join(name)));
    }
    for path in paths {
        // A file that is missing or was changed restores nothing.
        let Ok(bytes) = files::read(&path) else { continue };
        if package::looks_like_package(&bytes) {
            let packed = package::read(&bytes).ok().and_then(|mut package| package.datasets.remove(hash));
            if let Some(blob) = packed {
                catalogue.put_bytes(hash, &blob)?;
                return Ok(());
            }
            continue;
        }
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if let Ok(file) = SourceFile::read(&name, &bytes) {
            sources.push(file);
        }
    }
    let read: Vec<Dataset> = sources.iter().flat_map(|file| file.datasets.clone()).collect();
    let joined = [Grouping::One, Grouping::Proposed].into_iter().filter(|_| !sources.is_empty());
    let joined = joined.flat_map(|grouping| gather(sources.clone(), grouping)).flat_map(|one| one.datasets);
    for dataset in read.into_iter().chain(joined) {
        let (own, blob) = Catalogue::bytes_of(&Dataset { state: state.to_owned(), ..dataset });
        if own == hash {
            catalogue.put_bytes(hash, &blob)?;
            return Ok(());
        }
    }
    Ok(())
}
