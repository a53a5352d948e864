//! Import of files: folders, zip archives, packages and single files, each by its kind.

use super::files;
use crate::catalogue::{NewProduct, SourceFile, unpack};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Progress;
use crate::compute::limits;
use crate::formats::archive::{self, Contents, Entry};
use crate::formats::system_toml::is_system_file;
use crate::formats::weather::is_weather_file;
use crate::formats::{Format, FormatError, LuminaireFormat};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// Maximum number of files that are read from a folder.
const MOST_FILES: usize = limits::IMPORTED_FILES;
/// Maximum depth to which folders within folders are searched.
const DEPTH: usize = 6;
/// Maximum depth to which archives within archives are unpacked.
const ARCHIVES: usize = 2;
/// Maximum size of all unpacked archives together. \[bytes\]
const MOST_UNPACKED: u64 = limits::UNPACKED_BYTES;

/// Function that reads the datasets of a file from its name and its bytes.
pub type ReadDataset = fn(&str, &[u8]) -> Result<SourceFile, FormatError>;

/// Kind of a file that is not a dataset, and that is opened separately instead of imported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Single {
    /// Description of a system, `.system.toml`.
    System,
    /// Scene file.
    Scene,
    /// Control curve, as CSV.
    Curve,
    /// Weather file.
    Weather,
}

impl Single {
    /// Returns the name of the kind with its article, in English, for messages.
    pub const fn words(self) -> &'static str {
        match self {
            Self::System => "a system",
            Self::Scene => "a scene",
            Self::Curve => "a control curve",
            Self::Weather => "a weather file",
        }
    }
}

/// Product that was found in a package.
#[derive(Debug, Clone, PartialEq)]
pub struct Packed {
    /// Name of the package, for messages.
    pub package: String,
    /// Datasets of the product, one per state.
    pub datasets: Vec<Dataset>,
    /// Product data in the package: name, maker, provenance, states.
    pub meta: NewProduct,
}

/// Result of an import: what was found in the files, and what could not be read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Taken {
    /// Dataset files that were read, in the order in which they were found.
    pub sources: Vec<SourceFile>,
    /// Products that were found in packages.
    pub packed: Vec<Packed>,
    /// Files that the user selected and that are opened separately instead of imported: the first of each kind.
    pub singles: Vec<(Single, PathBuf)>,
    /// Messages on files that could not be read: file, location in it, error, and what is expected.
    pub failures: Vec<String>,
    /// Names of files that are not datasets, each with the reason why it was not imported.
    pub left_out: Vec<String>,
    /// Whether the import was stopped before all files were read.
    pub stopped: bool,
}

/// Kind of a file according to its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Dataset,
    Package,
    Archive,
    Single(Single),
    Luminaire,
    Other,
}

impl Kind {
    /// Returns the kind of a file according to the end of its name.
    fn of(name: &str) -> Self {
        let lower = name.to_ascii_lowercase();
        let ends = |ending: &str| lower.ends_with(ending);
        // A system's name ends like a scene's, so it is tested first.
        if is_system_file(name) {
            Self::Single(Single::System)
        } else if ends(".toml") {
            Self::Single(Single::Scene)
        } else if ends(".csv") {
            Self::Single(Single::Curve)
        } else if is_weather_file(name) {
            Self::Single(Single::Weather)
        } else if ends(".cfsp") {
            Self::Package
        } else if ends(".zip") {
            Self::Archive
        } else if LuminaireFormat::from_name(name).is_some()
            || [".gldf", ".uld", ".rolf"].iter().any(|ending| ends(ending))
        {
            Self::Luminaire
        } else if Format::from_name(name).is_some() || ends(".cfsd") {
            Self::Dataset
        } else {
            Self::Other
        }
    }
}

/// File to be imported, with its origin.
struct Given {
    /// Path on disk; for a file in an archive, the path of the archive.
    path: PathBuf,
    /// Archive that contains the file; `None` for a file on disk.
    within: Option<Within>,
    /// Name of the file in messages.
    name: String,
    /// Whether the user selected the file itself, so that it was not found in a folder or archive.
    named: bool,
}

/// Position of a file within an archive.
#[derive(Clone)]
struct Within {
    archive: Arc<Vec<u8>>,
    index: usize,
    /// Path of the file if archives were folders.
    place: PathBuf,
}

impl Given {
    /// Returns the name of the file without folders.
    fn file_name(&self) -> &str {
        self.name.rsplit(['/', '\\']).next().unwrap_or(&self.name)
    }

    /// Returns the folder of the file, because only files in the same folder may be states of one product.
    fn folder(&self) -> String {
        let place = self.within.as_ref().map_or(&self.path, |within| &within.place);
        place.parent().map(|folder| folder.display().to_string()).unwrap_or_default()
    }

    fn bytes(&self, left: &AtomicU64) -> Result<Vec<u8>, String> {
        let Some(Within { archive, index, .. }) = &self.within else {
            return files::read(&self.path).map_err(|error| error.to_string());
        };
        let message = |error: archive::ArchiveError| format!("{}: {error}", self.name);
        let bytes = archive::read(archive, *index, left.load(Ordering::Relaxed)).map_err(message)?;
        let taken = |left: u64| left.checked_sub(bytes.len() as u64);
        match left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, taken) {
            Ok(_) => Ok(bytes),
            Err(_) => Err(format!("{}: the archives unpack to more than {} MB", self.name, MOST_UNPACKED >> 20)),
        }
    }
}

/// Result of reading one file of an import.
enum Read {
    Source(Box<SourceFile>),
    Packed(Vec<Packed>),
    Failure(String),
    LeftOut(String),
    Stopped,
}

/// List of all files to be imported, including those in folders and archives; skipped ones are listed with the reason.
struct Listing {
    files: Vec<Given>,
    left_out: Vec<String>,
    failures: Vec<String>,
    full: bool,
    /// Remaining size to which all archives together may be unpacked. \[bytes\]
    left: AtomicU64,
}

impl Listing {
    /// Lists the files in the paths that the user selected.
    fn of(paths: &[PathBuf], progress: &dyn Progress) -> Self {
        let (files, left_out, failures) = (Vec::new(), Vec::new(), Vec::new());
        let mut list = Self { files, left_out, failures, full: false, left: AtomicU64::new(MOST_UNPACKED) };
        for path in paths {
            if path.is_dir() {
                let before = list.files.len() + list.left_out.len() + list.failures.len();
                list.walk(path, path, DEPTH, progress);
                if list.files.len() + list.left_out.len() + list.failures.len() == before {
                    list.left_out.push(format!("{}: a folder without files", path.display()));
                }
            } else {
                let name = match files::name_with_extension(path) {
                    Ok(name) => name.rsplit(std::path::is_separator).next().unwrap_or_default().to_owned(),
                    Err(error) => {
                        list.failures.push(error.to_string());
                        continue;
                    }
                };
                list.add(Given { path: path.clone(), within: None, name, named: true });
            }
        }
        if list.full {
            list.left_out.push(format!("more than {MOST_FILES} files; the rest was not read"));
        }
        list
    }

    /// Adds the files of a folder and of the folders in it. `root`: folder that the user selected, for relative names;
    /// `depth`: number of further levels that are searched.
    fn walk(&mut self, root: &Path, folder: &Path, depth: usize, progress: &dyn Progress) {
        let relative = |path: &Path| path.strip_prefix(root).unwrap_or(path).display().to_string();
        let entries = match std::fs::read_dir(folder) {
            Ok(entries) => entries,
            Err(error) => return self.left_out.push(format!("{}: cannot be read ({error})", folder.display())),
        };
        let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        paths.sort();
        for path in paths {
            let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
            if hidden || self.full || progress.cancelled() {
                continue;
            }
            // A link may lead back to a folder that contains it.
            let linked = std::fs::symlink_metadata(&path).is_ok_and(|meta| meta.is_symlink());
            if !path.is_dir() {
                self.add(Given { name: relative(&path), path, within: None, named: false });
            } else if linked {
                self.left_out.push(format!("{}: a link to a folder", relative(&path)));
            } else if depth == 0 {
                self.left_out.push(format!("{}: a folder more than {DEPTH} levels down", relative(&path)));
            } else {
                self.walk(root, &path, depth - 1, progress);
            }
        }
    }

    fn add(&mut self, file: Given) {
        if self.files.len() >= MOST_FILES {
            self.full = true;
        } else if Kind::of(&file.name) == Kind::Archive {
            self.unpack(&file, ARCHIVES);
        } else {
            self.files.push(file);
        }
    }

    /// Adds the files of an archive, or the archive itself if it is a package under another name. `depth`: number of
    /// further levels of archives that are unpacked.
    fn unpack(&mut self, file: &Given, depth: usize) {
        let bytes = match file.bytes(&self.left) {
            Ok(bytes) => Arc::new(archive::with_distinct_names(bytes)),
            Err(error) => return self.failures.push(error),
        };
        let Contents { files, clashes } = match archive::contents(&bytes) {
            Ok(contents) => contents,
            Err(error) => return self.failures.push(format!("{}: {error}", file.name)),
        };
        let (path, within) = (file.path.clone(), file.within.clone());
        if archive::holds_package(&files) {
            return self.files.push(Given { path, within, name: format!("{}.cfsp", file.name), named: file.named });
        }
        if files.is_empty() && clashes.is_empty() {
            self.left_out.push(format!("{}: an archive without files", file.name));
        }
        let reason = "several files of this name in the archive; unpack it and give each a name of its own";
        self.failures.extend(clashes.iter().map(|clash| format!("{}/{clash}: {reason}", file.name)));
        let place = within.map_or(path, |within| within.place);
        for Entry { index, name: entry } in files {
            let name = format!("{}/{entry}", file.name);
            let within = Some(Within { archive: bytes.clone(), index, place: place.join(entry.replace('\\', "/")) });
            let inner = Given { path: file.path.clone(), within, name, named: false };
            if self.files.len() >= MOST_FILES {
                self.full = true;
            } else if Kind::of(&inner.name) != Kind::Archive {
                self.files.push(inner);
            } else if depth == 0 {
                let reason = format!("an archive more than {ARCHIVES} levels down; unpack it first");
                self.left_out.push(format!("{}: {reason}", inner.name));
            } else {
                self.unpack(&inner, depth - 1);
            }
        }
    }
}

/// Describes the content of a luminaire file in one sentence, for the reason why it is not imported.
fn luminaire(name: &str, bytes: &[u8]) -> String {
    let (format, who) = match LuminaireFormat::from_name(name).map(|format| (format, format.read(bytes))) {
        Some((format, Ok(luminaire))) => {
            let text = &luminaire.text;
            let words: Vec<&str> =
                [text.name.trim(), text.manufacturer.trim()].into_iter().filter(|word| !word.is_empty()).collect();
            let who = if words.is_empty() { String::new() } else { format!(": {}", words.join(", ")) };
            (format.name().to_owned(), who)
        }
        Some((format, Err(_))) => (format.name().to_owned(), String::new()),
        None => (name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase(), String::new()),
    };
    format!("a luminaire ({format}){who}; not a façade system")
}

/// Whether a file is XML whose root element says that it describes a luminaire.
fn is_luminaire_xml(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(2048)];
    head.windows(8).any(|window| window == b"<IESTM33")
}

/// Reads one file by its kind. `left`: remaining size to which archives may be unpacked \[bytes\]; `read`: reads the
/// datasets of a file.
fn read_one(file: &Given, left: &AtomicU64, read: ReadDataset) -> Read {
    let name = &file.name;
    let kind = Kind::of(name);
    match kind {
        Kind::Single(single) => return Read::LeftOut(format!("{name}: {}; open it by itself", single.words())),
        Kind::Other if !file.named => {
            return Read::LeftOut(format!("{name}: not a dataset (.xml, .btdf.txt, .cfsd)"));
        }
        _ => {}
    }
    let bytes = match file.bytes(left) {
        Ok(bytes) => bytes,
        Err(error) => return Read::Failure(error),
    };
    if kind == Kind::Luminaire {
        return Read::LeftOut(format!("{name}: {}", luminaire(name, &bytes)));
    }
    if is_luminaire_xml(&bytes) {
        return Read::LeftOut(format!("{name}: a luminaire (TM-33); not a façade system"));
    }
    if kind == Kind::Package {
        let package = file.name.trim_end_matches(".zip.cfsp").to_owned();
        return match unpack(&bytes) {
            Ok(list) => {
                let packed = |(datasets, meta)| Packed { package: package.clone(), datasets, meta };
                Read::Packed(list.into_iter().map(packed).collect())
            }
            Err(error) => Read::Failure(format!("{name}: {error}")),
        };
    }
    match read(file.file_name(), &bytes) {
        Ok(source) => Read::Source(Box::new(SourceFile { folder: file.folder(), ..source })),
        Err(error) => Read::Failure(format!("{name}: {error}")),
    }
}

/// Imports all files of the paths. Files that the user named may also be scenes, systems and control curves; of files
/// found in folders and archives only datasets and packages are imported, and others are listed.
pub fn import_files(paths: &[PathBuf], read: ReadDataset, progress: &dyn Progress) -> Taken {
    let Listing { files, left_out, failures, left, .. } = Listing::of(paths, progress);
    let mut taken = Taken { left_out, failures, ..Taken::default() };
    let mut rest = Vec::new();
    for file in files {
        match Kind::of(&file.name) {
            Kind::Single(single) if file.named => {
                if taken.singles.iter().any(|(other, _)| *other == single) {
                    taken.left_out.push(format!("{}: {}; one at a time is opened", file.name, single.words()));
                } else {
                    taken.singles.push((single, file.path));
                }
            }
            _ => rest.push(file),
        }
    }
    let done = AtomicUsize::new(0);
    let count = rest.len();
    progress.advance("files", 0, count);
    let each = |file: &Given| {
        if progress.cancelled() {
            return Read::Stopped;
        }
        let one = read_one(file, &left, read);
        progress.advance("files", done.fetch_add(1, Ordering::Relaxed) + 1, count);
        one
    };
    for one in rest.par_iter().map(each).collect::<Vec<Read>>() {
        match one {
            Read::Source(source) => taken.sources.push(*source),
            Read::Packed(list) => taken.packed.extend(list),
            // One bad file among many does not stop the others.
            Read::Failure(text) => taken.failures.push(text),
            Read::LeftOut(text) => taken.left_out.push(text),
            Read::Stopped => taken.stopped = true,
        }
    }
    taken
}
