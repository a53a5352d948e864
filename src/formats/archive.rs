//! Zip archives of data files: access to their files by name, within limits that apply to every archive.

use super::encoding::{NotText, is_web_page};
use crate::compute::limits;
use std::collections::{HashMap, HashSet};
use std::io::{Cursor, Read};
use zip::ZipArchive;

/// Maximum number of entries of an archive.
pub const MOST_ENTRIES: usize = limits::ARCHIVE_ENTRIES;
/// Maximum uncompressed size of a file in an archive. \[bytes\]
pub const MOST_FILE: u64 = limits::ENTRY_BYTES;

/// Error in reading a zip archive, or a file in it.
#[derive(Debug, thiserror::Error)]
pub enum ArchiveError {
    /// Web page that was saved instead of the archive that it offers.
    #[error(transparent)]
    WebPage(#[from] NotText),
    /// Bytes that are not a zip file, or are damaged.
    #[error("not a readable zip archive: {0}")]
    Zip(#[from] zip::result::ZipError),
    /// Archive with more files than allowed: their number.
    #[error("{0} entries; expected at most {MOST_ENTRIES}")]
    Entries(usize),
    /// File in the archive that is larger than allowed: the maximum size. \[MB\]
    #[error("larger than {0} MB when unpacked")]
    Large(u64),
    /// File in the archive that is damaged and cannot be decompressed.
    #[error("cannot be unpacked: {0}")]
    Unpack(std::io::Error),
}

/// Whether the bytes are a zip archive; exchange packages are zip archives, too, see [`holds_package`].
pub fn looks_like_archive(bytes: &[u8]) -> bool {
    super::package::looks_like_package(bytes)
}

/// File in an archive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Index of the file in the archive, for [`read`].
    pub index: usize,
    /// Name of the file with its folders, separated by `/`; as stored if another file's name differs from it only by
    /// `\\` instead of `/`.
    pub name: String,
}

/// Content of a zip archive: its files, and names that occur several times.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Contents {
    /// Files that can be read, in the order of their names.
    pub files: Vec<Entry>,
    /// Names that several files of the archive have in common, so that only the last of them can be read;
    /// [`with_distinct_names`] makes them distinct first.
    pub clashes: Vec<String>,
}

fn opened(bytes: &[u8]) -> Result<ZipArchive<Cursor<&[u8]>>, ArchiveError> {
    if is_web_page(bytes) {
        return Err(NotText::WEB_PAGE.into());
    }
    let zip = ZipArchive::new(Cursor::new(bytes))?;
    if zip.len() > MOST_ENTRIES { Err(ArchiveError::Entries(zip.len())) } else { Ok(zip) }
}

/// Lists the files in an archive, without entries that operating systems add (e.g. `__MACOSX`).
///
/// # Errors
/// Returns an error if the bytes are not a zip archive, or have too many entries.
pub fn contents(bytes: &[u8]) -> Result<Contents, ArchiveError> {
    let zip = opened(bytes)?;
    let own = |name: &str| name.split(['/', '\\']).any(|part| part.starts_with('.') || part == "__MACOSX");
    let repeated = repeated(bytes, &zip);
    let mut contents = Contents::default();
    for (index, (name, raw)) in zip.file_names().zip(zip.file_names_raw()).enumerate() {
        let name = name?.into_owned();
        if name.ends_with(['/', '\\']) || own(&name) {
            continue;
        }
        if repeated.contains(raw) {
            contents.clashes.push(name);
        } else {
            contents.files.push(Entry { index, name });
        }
    }
    let mut count: HashMap<String, usize> = HashMap::new();
    for file in &contents.files {
        *count.entry(with_slashes(&file.name)).or_default() += 1;
    }
    for file in &mut contents.files {
        let name = with_slashes(&file.name);
        if count[&name] == 1 {
            file.name = name;
        }
    }
    contents.files.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(contents)
}

/// Returns a file's name with its folders separated by `/` alone.
fn with_slashes(name: &str) -> String {
    name.replace('\\', "/")
}

/// Size of a file's header in the central directory of a zip archive, before its name: APPNOTE 4.3.12. \[bytes\]
const HEADER: usize = 46;

/// Header of a file in the central directory of a zip archive, and the name that it contains.
type Listed<'a> = (&'a [u8], &'a [u8]);

/// Returns the headers of the central directory at the end of an archive, and the bytes that follow it.
fn listed<'a>(bytes: &'a [u8], zip: &ZipArchive<Cursor<&[u8]>>) -> (Vec<Listed<'a>>, &'a [u8]) {
    let mut list = Vec::new();
    let mut rest =
        usize::try_from(zip.central_directory_start()).ok().and_then(|at| bytes.get(at..)).unwrap_or_default();
    // The lengths of three fields are at 28, 30 and 32; the first field is the name.
    while let Some(head) = rest.get(..HEADER).filter(|head| head.starts_with(b"PK\x01\x02")) {
        let [name, extra, comment] = [28, 30, 32].map(|at| usize::from(u16::from_le_bytes([head[at], head[at + 1]])));
        let Some((header, others)) = rest.split_at_checked(HEADER + name + extra + comment) else { break };
        list.push((header, &header[HEADER..HEADER + name]));
        rest = others;
    }
    (list, rest)
}

/// Returns the names that occur several times in the central directory of an archive; the zip reader finds only the
/// last file of each.
fn repeated<'a>(bytes: &'a [u8], zip: &ZipArchive<Cursor<&[u8]>>) -> HashSet<&'a [u8]> {
    if !zip.has_duplicate_names() {
        return HashSet::new();
    }
    let mut seen = HashSet::new();
    listed(bytes, zip).0.into_iter().map(|(_, name)| name).filter(|name| !seen.insert(*name)).collect()
}

/// Returns the archive with a number added to each file that has the name of an earlier one, as in `x (2).xml`, so that
/// all can be read. Archives in the format for more than 4 GB are returned unchanged, see [`Contents::clashes`].
pub fn with_distinct_names(mut bytes: Vec<u8>) -> Vec<u8> {
    if let Some((start, end)) =
        opened(&bytes).ok().filter(ZipArchive::has_duplicate_names).and_then(|zip| renamed(&bytes, &zip))
    {
        bytes.truncate(start);
        bytes.extend(end);
    }
    bytes
}

/// Returns the offset of an archive's central directory, and the bytes from there on with repeated names numbered;
/// `None` for archives in the format for more than 4 GB.
fn renamed(bytes: &[u8], zip: &ZipArchive<Cursor<&[u8]>>) -> Option<(usize, Vec<u8>)> {
    let start = usize::try_from(zip.central_directory_start()).ok()?;
    let (list, rest) = listed(bytes, zip);
    // APPNOTE 4.3.16: the record at the end has the length of the list at 12. Longer archives have another one before
    // it.
    if list.len() > MOST_ENTRIES || !rest.starts_with(b"PK\x05\x06") || rest.len() < 22 {
        return None;
    }
    let mut names: HashSet<Vec<u8>> = list.iter().map(|(_, name)| name.to_vec()).collect();
    let mut count: HashMap<&[u8], usize> = HashMap::new();
    let mut written = Vec::new();
    for (header, name) in list {
        let number = count.entry(name).or_default();
        let mut own = name.to_vec();
        *number += 1;
        while *number > 1
            && !names.insert({
                own = numbered(name, *number);
                own.clone()
            })
        {
            *number += 1;
        }
        written.extend_from_slice(&header[..28]);
        written.extend_from_slice(&u16::try_from(own.len()).ok()?.to_le_bytes());
        written.extend_from_slice(&header[30..HEADER]);
        written.extend_from_slice(&own);
        written.extend_from_slice(&header[HEADER + name.len()..]);
    }
    let length = u32::try_from(written.len()).ok()?;
    written.extend_from_slice(&rest[..12]);
    written.extend_from_slice(&length.to_le_bytes());
    written.extend_from_slice(&rest[16..]);
    Some((start, written))
}

/// Returns a numbered name: `a/x (2).xml` from `a/x.xml` and 2.
fn numbered(name: &[u8], number: usize) -> Vec<u8> {
    let file = name.iter().rposition(|byte| matches!(byte, b'/' | b'\\')).map_or(0, |at| at + 1);
    let stem = name[file..].iter().rposition(|byte| *byte == b'.').map_or(name.len(), |at| file + at);
    [&name[..stem], format!(" ({number})").as_bytes(), &name[stem..]].concat()
}

/// Whether the files of an archive are those of an exchange package.
pub fn holds_package(files: &[Entry]) -> bool {
    files.iter().any(|file| file.name == "manifest.json")
}

/// Returns the uncompressed bytes of the file at `index` of an archive; never more than `most`, whatever the archive's
/// headers state.
///
/// # Errors
/// Returns an error if there is no such file, or if it is damaged or larger than `most`.
pub fn read(bytes: &[u8], index: usize, most: u64) -> Result<Vec<u8>, ArchiveError> {
    let mut zip = opened(bytes)?;
    let most = most.min(MOST_FILE);
    let mut unpacked = Vec::new();
    zip.by_index(index)?.take(most + 1).read_to_end(&mut unpacked).map_err(ArchiveError::Unpack)?;
    if unpacked.len() as u64 > most { Err(ArchiveError::Large(most >> 20)) } else { Ok(unpacked) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write as _;
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    fn names(files: &[Entry]) -> Vec<&str> {
        files.iter().map(|file| file.name.as_str()).collect()
    }

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
        let list = contents(&bytes).unwrap().files;
        assert_eq!(names(&list), ["b/two.xml", "one.xml"]);
        assert!(looks_like_archive(&bytes) && !holds_package(&list));
        assert_eq!(read(&bytes, list[0].index, 10).unwrap(), b"2");
        assert!(read(&bytes, 4, 10).is_err() && contents(b"PK\x03\x04 nothing").is_err());
        let page = contents(b"<!DOCTYPE html>\n<html>").unwrap_err().to_string();
        assert!(page.contains("HTML page"), "{page}");
    }

    #[test]
    fn files_of_one_name_are_told_and_those_of_similar_names_are_read_apart() {
        let mut bytes = zip(&[("a/x.xml", b"1"), ("b/x.xml", b"2"), ("c\\y.xml", b"3"), ("c/y.xml", b"4")]);
        // Writers refuse a name that is there already.
        for at in 0..bytes.len() - 7 {
            if bytes[at..].starts_with(b"b/x.xml") {
                bytes[at] = b'a';
            }
        }
        let Contents { files, clashes } = contents(&bytes).unwrap();
        assert_eq!(clashes, ["a/x.xml"]);
        assert_eq!(names(&files), ["c/y.xml", "c\\y.xml"]);
        let held: Vec<_> = files.iter().map(|file| read(&bytes, file.index, 10).unwrap()).collect();
        assert_eq!(held, [b"4", b"3"]);
        // Numbered, both are read.
        let bytes = with_distinct_names(bytes);
        let Contents { files, clashes } = contents(&bytes).unwrap();
        assert_eq!((names(&files), clashes.len()), (vec!["a/x (2).xml", "a/x.xml", "c/y.xml", "c\\y.xml"], 0));
        let held: Vec<_> = files.iter().map(|file| read(&bytes, file.index, 10).unwrap()).collect();
        assert_eq!(held, [b"2", b"1", b"4", b"3"]);
        assert_eq!(with_distinct_names(bytes.clone()), bytes);
        assert_eq!(numbered(b"a.b/x", 3), b"a.b/x (3)");
    }

    #[test]
    fn a_file_that_unpacks_to_more_than_it_may_is_refused() {
        // A million zeros take a thousand bytes.
        let bytes = zip(&[("bomb.xml", &vec![0; 1_000_000])]);
        assert!(bytes.len() < 5_000);
        assert!(matches!(read(&bytes, 0, 10_000), Err(ArchiveError::Large(_))));
        assert_eq!(read(&bytes, 0, 1_000_000).unwrap().len(), 1_000_000);
    }
}
