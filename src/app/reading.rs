//! Reads what was opened or dropped: files and folders, each taken for what it is.

use super::disk::{ends_in, read_bytes};
use super::error::AppError;
use super::import::{Import, ImportFields, KeptImport, KeptProduct, Proposed};
use super::shelf::Shelf;
use super::work::{Outcome, ReadDataset};
use crate::catalogue::{Gathered, Grouping, gather};
use crate::compute::doctor::{examine, repaired_all};
use crate::compute::estimate::Progress;
use crate::formats::Format;
use crate::formats::control_curve::read_control_curve;
use crate::formats::system_toml::is_system_file;
use crate::study::scene_file::SceneFile;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Most files that are read of a folder.
const MOST_FILES: usize = 500;
/// Folders within folders that are looked into.
const DEPTH: usize = 4;

/// What is asked of files.
pub struct Asked {
    /// Files and folders.
    pub paths: Vec<PathBuf>,
    /// How datasets are taken.
    pub grouping: Grouping,
    /// Reads a dataset file.
    pub read: ReadDataset,
    /// Where the same content may be already; `None` before the catalogue is open.
    pub shelf: Option<Arc<dyn Shelf>>,
    /// What was typed and tried on the same files before.
    pub kept: Option<KeptImport>,
}

/// A file and whether it was named or found in a folder.
struct Given {
    path: PathBuf,
    /// What it is called in messages.
    name: String,
    /// The folder that it was found in; `None`: named by the user.
    found_in: Option<PathBuf>,
}

/// Files of the paths, folders looked into; what was left out is told.
fn files(paths: &[PathBuf], left_out: &mut Vec<String>) -> Vec<Given> {
    let mut list = Vec::new();
    for path in paths {
        if path.is_dir() {
            let before = list.len();
            walk(path, path, DEPTH, &mut list, left_out);
            if list.len() >= MOST_FILES {
                left_out.push(format!("{}: more than {MOST_FILES} files; the rest was not read", path.display()));
            } else if list.len() == before {
                left_out.push(format!("{}: a folder without files", path.display()));
            }
        } else {
            let name =
                path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into());
            list.push(Given { path: path.clone(), name, found_in: None });
        }
    }
    list
}

fn walk(root: &Path, folder: &Path, depth: usize, list: &mut Vec<Given>, left_out: &mut Vec<String>) {
    let relative = |path: &Path| path.strip_prefix(root).unwrap_or(path).display().to_string();
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => return left_out.push(format!("{}: cannot be read ({error})", folder.display())),
    };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if hidden || list.len() >= MOST_FILES {
            continue;
        }
        // A link may lead back to where it lies.
        let linked = std::fs::symlink_metadata(&path).is_ok_and(|meta| meta.is_symlink());
        if !path.is_dir() {
            list.push(Given { name: relative(&path), path, found_in: Some(folder.to_owned()) });
        } else if linked {
            left_out.push(format!("{}: a link to a folder", relative(&path)));
        } else if depth == 0 {
            left_out.push(format!("{}: a folder more than {DEPTH} levels down", relative(&path)));
        } else {
            walk(root, &path, depth - 1, list, left_out);
        }
    }
}

fn text_of(path: &Path, what: &'static str) -> Result<String, AppError> {
    let wrong = |byte| AppError::NotText(byte, what).about(path.display());
    String::from_utf8(read_bytes(path)?).map_err(|error| wrong(error.utf8_error().valid_up_to()))
}

/// What a file is by its name, other than a dataset.
enum Single {
    System,
    Scene,
    Curve,
}

impl Single {
    fn of(path: &Path) -> Option<Self> {
        // A system's name ends like a scene's, so it is asked about first.
        if is_system_file(&path.to_string_lossy()) {
            Some(Self::System)
        } else if ends_in(path, "toml") {
            Some(Self::Scene)
        } else {
            ends_in(path, "csv").then_some(Self::Curve)
        }
    }

    const fn words(&self) -> &'static str {
        match self {
            Self::System => "a system",
            Self::Scene => "a scene",
            Self::Curve => "a control curve",
        }
    }

    fn read(&self, path: &Path) -> Outcome {
        let about = |error: AppError| error.about(path.display());
        match self {
            Self::System => {
                // Files that the system names are found from its own folder.
                let base = path.parent().map(PathBuf::from).unwrap_or_default();
                Outcome::ReadSystem(text_of(path, "a system").map(|text| (text, base)))
            }
            Self::Scene => {
                let parse = |text: String| SceneFile::parse(&text).map(Box::new).map_err(|error| about(error.into()));
                Outcome::ReadScene(path.to_owned(), text_of(path, "a scene").and_then(parse))
            }
            Self::Curve => Outcome::ReadCurve(
                read_bytes(path).and_then(|bytes| read_control_curve(&bytes).map_err(|error| about(error.into()))),
            ),
        }
    }
}

/// Could a file that was found in a folder be a dataset? Others there are not even read.
fn like_a_dataset(name: &str) -> bool {
    Format::from_name(name).is_some() || name.to_ascii_lowercase().ends_with(".cfsd")
}

/// Reads files: of scenes, systems and control curves the first that is named; datasets as products to be added; other
/// files are told. Files that were found in a folder count as datasets alone.
pub fn read_files(asked: &Asked, progress: &dyn Progress) -> Outcome {
    let mut import = Import { paths: asked.paths.clone(), grouping: asked.grouping, ..Import::default() };
    let given = files(&asked.paths, &mut import.left_out);
    let mut outcomes = Vec::new();
    let mut sources = Vec::new();
    let count = given.len();
    for (number, one) in given.into_iter().enumerate() {
        progress.advance("files", number, count);
        if progress.cancelled() {
            break;
        }
        let name = one.name;
        if let Some(single) = Single::of(&one.path) {
            let words = single.words();
            if one.found_in.is_some() {
                import.left_out.push(format!("{name}: {words}; open it by itself"));
            } else if outcomes.iter().any(|(other, _)| *other == words) {
                import.left_out.push(format!("{name}: {words}; one at a time is opened"));
            } else {
                outcomes.push((words, single.read(&one.path)));
            }
            continue;
        }
        if one.found_in.is_some() && ends_in(&one.path, "cfsp") {
            import.left_out.push(format!("{name}: a package; open it by itself"));
            continue;
        }
        if one.found_in.is_some() && !like_a_dataset(&name) {
            import.left_out.push(format!("{name}: not a dataset (.xml, .btdf.txt, .cfsd)"));
            continue;
        }
        let file_name = name.rsplit(['/', '\\']).next().unwrap_or(&name).to_owned();
        let read = read_bytes(&one.path)
            .and_then(|bytes| (asked.read)(&file_name, &bytes).map_err(|error| AppError::from(error).about(&name)));
        match read {
            Ok(mut source) => {
                source.folder = one.path.parent().map(|folder| folder.display().to_string()).unwrap_or_default();
                sources.push(source);
            }
            // One bad file among many does not stop the others: the sheet lists it.
            Err(error) => import.failures.push(error.to_string()),
        }
    }
    for product in gather(sources, asked.grouping) {
        let mut product = proposed(product, asked.shelf.as_deref());
        let same = |kept: &&KeptProduct| kept.source_hash == product.provenance.source_hash;
        if let Some(kept) = asked.kept.as_ref().and_then(|kept| kept.products.iter().find(same)) {
            product.fields = kept.fields.clone();
            product.add_anyway = kept.add_anyway;
            product.repairs = kept.made();
            if !product.repairs.is_empty() {
                match repaired(&product) {
                    Ok(whole) => product = whole,
                    Err(error) => {
                        product.repairs.clear();
                        import.failures.push(error.to_string());
                    }
                }
            }
        }
        import.products.push(product);
    }
    let mut list: Vec<Outcome> = outcomes.into_iter().map(|(_, outcome)| outcome).collect();
    if list.is_empty() || !(import.products.is_empty() && import.failures.is_empty() && import.left_out.is_empty()) {
        list.push(Outcome::Read(Box::new(import)));
    }
    Outcome::Several(list)
}

fn proposed(product: Gathered, shelf: Option<&dyn Shelf>) -> Proposed {
    let Gathered { meta, datasets, sources, file_stem } = product;
    let diagnoses = datasets.iter().map(examine).collect();
    let datasets: Vec<_> = datasets.into_iter().map(Arc::new).collect();
    let fields = ImportFields {
        name: if meta.name.is_empty() { file_stem } else { meta.name },
        manufacturer: meta.manufacturer,
        kind: meta.kind,
        tags: meta.tags.join(", "),
    };
    // A catalogue that does not answer keeps nobody from adding: it will say so itself.
    let known = shelf.and_then(|shelf| shelf.products_from(&meta.provenance.source_hash).ok()).unwrap_or_default();
    Proposed {
        diagnoses,
        // Repairs always start from what the files hold, so that each can be taken back.
        originals: datasets.clone(),
        datasets,
        sources,
        fields,
        provenance: meta.provenance,
        known,
        ..Proposed::default()
    }
}

/// The product with its repairs made on all states, and examined.
fn repaired(product: &Proposed) -> Result<Proposed, AppError> {
    let mended: Result<Vec<_>, _> =
        product.originals.iter().map(|dataset| repaired_all(dataset, &product.repairs)).collect();
    let datasets = mended?;
    Ok(Proposed {
        diagnoses: datasets.iter().map(examine).collect(),
        datasets: datasets.into_iter().map(Arc::new).collect(),
        ..product.clone()
    })
}

/// Makes repairs on all states of a product and examines what comes of it.
pub fn mend(number: usize, product: &Proposed) -> Outcome {
    Outcome::Mended(repaired(product).map(|product| (number, Box::new(product))))
}
