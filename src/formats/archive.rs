//! A zip archive of files, as folders of data are sent around: its files by name, within limits that no archive gets past.

use crate::compute::limits;
use std::io::{Cursor, Read};
use zip::ZipArchive;

/// Most entries of an archive.
pub const MOST_ENTRIES: usize = limits::ARCHIVE_ENTRIES;
/// Largest file in an archive. \[bytes\]
pub const MOST_FILE: u64 = limits::ENTRY_BYTES;

/// Why an archive, or a file in it, cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ArchiveError {
    /// Not a zip file, or damaged.
    #[error("not a readable zip archive: {0}")]
    Zip(#[from] zip::result::ZipError),
    /// More files than any collection of data has.
    #[error("{0} entries; expected at most {MOST_ENTRIES}")]
    Entries(usize),
    /// A file that is larger than it may be.
    #[error("larger than {0} MB when unpacked")]
    Large(u64),
    /// Damaged inside.
    #[error("cannot be unpacked: {0}")]
    Unpack(std::io::Error),
}

/// Is this a zip archive? Packages are too; see [`holds_package`].
pub fn looks_like_archive(bytes: &[u8]) -> bool {
    super::package::looks_like_package(bytes)
}

fn opened(bytes: &[u8]) -> Result<ZipArchive<Cursor<&[u8]>>, ArchiveError> {
    let zip = ZipArchive::new(Cursor::new(bytes))?;
    if zip.len() > MOST_ENTRIES { Err(ArchiveError::Entries(zip.len())) } else { Ok(zip) }
}

/// Names of the files in an archive, with their folders, sorted; what systems put there for themselves is left out.
///
/// # Errors
/// No zip archive, or one of too many entries.
pub fn names(bytes: &[u8]) -> Result<Vec<String>, ArchiveError> {
    let zip = opened(bytes)?;
    let own = |name: &str| name.split('/').any(|part| part.starts_with('.') || part == "__MACOSX");
    let files: Vec<_> = zip.file_names().collect::<Result<_, _>>()?;
    let files = files.into_iter().map(|name| name.replace('\\', "/"));
    let mut list: Vec<String> = files.filter(|name| !name.ends_with('/') && !own(name)).collect();
    list.sort();
    Ok(list)
}

/// Do these names belong to an exchange package?
pub fn holds_package(names: &[String]) -> bool {
    names.iter().any(|name| name == "manifest.json")
}

/// The bytes of one file; never more than `most`, whatever the archive says of itself.
///
/// # Errors
/// No such file, a damaged one, or a larger one.
pub fn read(bytes: &[u8], name: &str, most: u64) -> Result<Vec<u8>, ArchiveError> {
    let mut zip = opened(bytes)?;
    let most = most.min(MOST_FILE);
    let own = |other: &String| other.replace('\\', "/") == name;
    let stored = zip.file_names().filter_map(|name| Some(name.ok()?.into_owned())).find(own);
    let stored = stored.unwrap_or_else(|| name.to_owned());
    let mut unpacked = Vec::new();
    zip.by_name(&stored)?.take(most + 1).read_to_end(&mut unpacked).map_err(ArchiveError::Unpack)?;
    if unpacked.len() as u64 > most { Err(ArchiveError::Large(most >> 20)) } else { Ok(unpacked) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write as _;
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    fn zip(files: &[(&str, &[u8])]) -> Vec<u8> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, bytes) in files {
            zip.start_file(*name, SimpleFileOptions::default()).unwrap();
            zip.write_all(bytes).unwrap();
        }
        zip.finish().unwrap().into_inner()
    }

    #[test]
    fn files_are_found_by_name_and_what_systems_add_is_not() {
        let bytes = zip(&[("b/two.xml", b"2"), ("one.xml", b"1"), ("__MACOSX/._one.xml", b"x"), (".DS_Store", b"x")]);
        let list = names(&bytes).unwrap();
        assert_eq!(list, ["b/two.xml", "one.xml"]);
        assert!(looks_like_archive(&bytes) && !holds_package(&list));
        assert_eq!(read(&bytes, "b/two.xml", 10).unwrap(), b"2");
        assert!(read(&bytes, "three.xml", 10).is_err() && names(b"PK\x03\x04 nothing").is_err());
    }

    #[test]
    fn a_file_that_unpacks_to_more_than_it_may_is_refused() {
        // A million zeros take a thousand bytes.
        let bytes = zip(&[("bomb.xml", &vec![0; 1_000_000])]);
        assert!(bytes.len() < 5_000);
        assert!(matches!(read(&bytes, "bomb.xml", 10_000), Err(ArchiveError::Large(_))));
        assert_eq!(read(&bytes, "bomb.xml", 1_000_000).unwrap().len(), 1_000_000);
    }
}
