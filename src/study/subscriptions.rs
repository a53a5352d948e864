//! Folders of packages to which a catalogue is subscribed; they are read again when they have changed.

use super::files;
use crate::catalogue::{Catalogue, CatalogueError};
use crate::compute::estimate::Progress;
use std::path::{Path, PathBuf};

/// Changes in the catalogue by reading all subscribed folders.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Report {
    /// Number of products that were added or changed.
    pub taken: usize,
    /// Number of products that were removed.
    pub gone: usize,
    /// Messages about missing folders and packages that were not used, one sentence each.
    pub problems: Vec<String>,
}

/// Returns the paths of the packages in a folder, sorted.
fn packages(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut list = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("cfsp")) && path.is_file() {
            list.push(path);
        }
    }
    list.sort();
    Ok(list)
}

/// Returns the absolute path by which the catalogue names a subscribed folder.
///
/// # Errors
/// Returns a message if there is no such folder.
pub fn folder_of(path: &Path) -> Result<String, String> {
    let wrong = |error: std::io::Error| format!("{}: {error}; expected a folder of packages (.cfsp)", path.display());
    let whole = std::fs::canonicalize(path).map_err(wrong)?;
    if !whole.is_dir() {
        return Err(format!("{}: not a folder; expected a folder of packages (.cfsp)", path.display()));
    }
    Ok(whole.display().to_string())
}

/// Reads all subscribed folders again. Products of a missing folder are not changed; a package that is damaged, or
/// whose data do not match their hashes, is reported and not used, and the products read from it before remain.
///
/// # Errors
/// Returns an error of the catalogue itself.
pub fn sync(catalogue: &mut Catalogue, progress: &dyn Progress) -> Result<Report, CatalogueError> {
    let mut report = Report::default();
    for subscription in catalogue.subscriptions()? {
        let folder = subscription.folder;
        let list = match packages(Path::new(&folder)) {
            Ok(list) => list,
            Err(error) => {
                report.problems.push(format!(
                    "{folder}: the subscribed folder is away ({error}); its {} products stay as they were read last",
                    subscription.products
                ));
                continue;
            }
        };
        let before = catalogue.packages_of(&folder)?;
        let mut there = Vec::new();
        for (number, path) in list.iter().enumerate() {
            progress.advance("packages", number, list.len());
            if progress.cancelled() {
                return Ok(report);
            }
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
            match files::read(path) {
                Ok(bytes) => {
                    let hash = blake3::hash(&bytes).to_hex().to_string();
                    if before.get(&name) != Some(&hash) {
                        match catalogue.take_package(&folder, &name, &hash, &bytes) {
                            Ok(synced) => {
                                report.taken += synced.taken;
                                report.gone += synced.gone;
                            }
                            Err(error @ CatalogueError::Sql(_)) => return Err(error),
                            Err(error) => report.problems.push(format!("{}: not used: {error}", path.display())),
                        }
                    }
                }
                Err(error) => report.problems.push(format!("not used: {error}")),
            }
            there.push(name);
        }
        for name in before.keys().filter(|name| !there.contains(name)) {
            report.gone += catalogue.drop_package(&folder, name)?;
        }
    }
    Ok(report)
}
