//! Folders of packages that a catalogue is subscribed to, read when they have changed.

use super::files;
use crate::catalogue::{Catalogue, CatalogueError};
use crate::compute::estimate::Progress;
use std::path::{Path, PathBuf};

/// What reading all subscribed folders changed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Report {
    /// Products that came or changed.
    pub taken: usize,
    /// Products that went.
    pub gone: usize,
    /// Folders that are away and packages that are not used, in a sentence each.
    pub problems: Vec<String>,
}

/// Packages that lie in a folder, sorted.
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

/// The path under which a folder is subscribed to: whole, and as it is.
///
/// # Errors
/// One sentence: no such folder.
pub fn folder_of(path: &Path) -> Result<String, String> {
    let wrong = |error: std::io::Error| format!("{}: {error}; expected a folder of packages (.cfsp)", path.display());
    let whole = std::fs::canonicalize(path).map_err(wrong)?;
    if !whole.is_dir() {
        return Err(format!("{}: not a folder; expected a folder of packages (.cfsp)", path.display()));
    }
    Ok(whole.display().to_string())
}

/// Reads all subscribed folders anew. A folder that is away keeps its products; a package that is damaged, or whose data do
/// not match their hashes, is told and not used; what came from it before stays.
///
/// # Errors
/// Of the catalogue itself.
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
