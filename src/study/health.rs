//! Mending a catalogue: what the file itself and the program know, and what the files know that its products came from.

use super::files;
use crate::catalogue::{
    Catalogue, CatalogueError, Damage, Grouping, Health, Place, SourceFile, check_file, copy_aside, gather, repair_file,
};
use crate::compute::btdf::Dataset;
use crate::formats::package;
use std::path::{Path, PathBuf};

/// What mending did.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mended {
    /// The file as it was.
    pub copy: PathBuf,
    /// What was mended, in sentences.
    pub mended: Vec<String>,
    /// What is lost, in sentences.
    pub lost: Vec<String>,
    /// The file as it is now.
    pub after: Health,
}

/// Mends what `health` tells of a catalogue's file, as far as it can be made anew; the file as it was is kept beside it.
///
/// # Errors
/// What cannot be read or written.
pub fn mend(path: &Path, health: &Health) -> Result<Mended, CatalogueError> {
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
    // What is wrong with data may read otherwise now: malformed before, gone after.
    let same = |one: &Damage, other: &Damage| {
        one.message == other.message || (matches!(one.place, Place::Data { .. }) && one.place == other.place)
    };
    let still = |damage: &&Damage| after.damages.iter().any(|other| same(damage, other));
    let mended = health.damages.iter().filter(|damage| !still(damage)).map(|damage| damage.message.clone()).collect();
    lost.extend(after.damages.iter().map(|damage| damage.message.clone()));
    lost.sort();
    lost.dedup();
    Ok(Mended { copy, mended, lost, after })
}

/// Puts the data of a state back from the files that its product was read from, where these still hold the very same.
fn regain(catalogue: &mut Catalogue, product: &str, state: &str, hash: &str) -> Result<(), CatalogueError> {
    let mut sources = Vec::new();
    let mut paths: Vec<PathBuf> = catalogue.source_paths(product)?.into_iter().map(PathBuf::from).collect();
    if let Some(folder) = catalogue.subscribed_folder(product)? {
        let packages = catalogue.packages_of(&folder)?;
        paths.extend(packages.keys().map(|name| Path::new(&folder).join(name)));
    }
    for path in paths {
        // A file that is gone or was changed regains nothing.
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
