//! `cfs catalogue import`: import of files, folders, archives and packages into the catalogue.

use super::output::print_text;
use crate::catalogue::{Catalogue, Gathered, Grouping, SourceFile, Stored, content_of, gather};
use crate::compute::btdf::Dataset;
use crate::compute::estimate::Silent;
use crate::compute::wavelet::Criterion;
use crate::study::compact::{Storage, stored_as, stored_by_default};
use crate::study::intake::{Taken, import_files};
use anyhow::{anyhow, bail};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `cfs catalogue import`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue import opal.btdf.txt --kind diffuser
  cfs catalogue import blind_*.xml --name \"Blind 80\" --manufacturer Maker
  cfs catalogue import products.zip --group each

Prints the keys of the products. Without --group and --name, files that differ by an angle alone, in their names or \
contents, become the states of one product; .btdf.txt files of one state are joined; every other file becomes a \
product. Everything is imported in one step. A file that cannot be read, or a product without visible transmission, is \
an error if only files were named; in a folder or zip archive it is skipped, with a warning.")]
pub struct ImportArgs {
    /// Dataset files (.xml, .btdf.txt, .cfsd), packages (.cfsp), and folders or zip archives of them
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Name of the product; all files become one product (default: name stated in the file, or file name)
    #[arg(long, default_value = "")]
    pub name: String,
    /// Maker of the products (default: as stated in the files)
    #[arg(long, default_value = "")]
    pub manufacturer: String,
    /// Kind of the products, e.g. venetian (default: as stated in the files)
    #[arg(long, default_value = "")]
    pub kind: String,
    /// Tag to add to the products (repeatable)
    #[arg(long = "tag")]
    pub tags: Vec<String>,
    /// Files that become states of one product
    #[arg(long, value_enum, default_value_t, conflicts_with = "name")]
    pub group: Group,
    /// Compression of the values (default: lossless for datasets below 1 MB, else archive)
    #[arg(long, value_enum)]
    pub compact: Option<Compactness>,
}

/// Files that become states of one product.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Group {
    /// Files that differ by an angle alone, in their names or contents
    #[default]
    Angles,
    /// No files: each becomes a product
    Each,
    /// All files
    One,
}

impl Group {
    const fn grouping(self) -> Grouping {
        match self {
            Self::Angles => Grouping::Proposed,
            Self::Each => Grouping::Each,
            Self::One => Grouping::One,
        }
    }
}

/// Compression of the values of indicatrices in the catalogue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Compactness {
    /// Compression by wavelets with at most 0.5 % of the flux of any indicatrix in wrong directions
    Archive,
    /// Compression by wavelets with at most 1.5 % of the flux of any indicatrix in wrong directions
    Normal,
    /// Every value, rounded to 7 digits
    Lossless,
}

/// Returns a product with the name, maker, kind and tags of the arguments; values that the arguments omit are those of
/// its files. A product without a name gets that of its first file, with a note.
fn described(args: &ImportArgs, mut product: Gathered) -> Gathered {
    let meta = &mut product.meta;
    let over = |field: &mut String, asked: &String| {
        if !asked.is_empty() {
            field.clone_from(asked);
        }
    };
    over(&mut meta.name, &args.name);
    over(&mut meta.manufacturer, &args.manufacturer);
    over(&mut meta.kind, &args.kind);
    meta.tags.extend(args.tags.iter().cloned());
    if meta.name.is_empty() {
        meta.name.clone_from(&product.file_stem);
        report!("note: the file gives no name; taken from the file: {} (--name gives another)", meta.name);
    }
    product
}

/// Returns a dataset compressed as the arguments request it for the catalogue.
fn kept(args: &ImportArgs, dataset: &Dataset) -> anyhow::Result<Dataset> {
    let storage = match args.compact {
        None => return Ok(stored_by_default(dataset)),
        Some(Compactness::Lossless) => Storage::Lossless,
        Some(Compactness::Archive) => Storage::Compact(Criterion::ARCHIVE),
        Some(Compactness::Normal) => Storage::Compact(Criterion::NORMAL),
    };
    stored_as(dataset, storage).map_err(|error| anyhow!("{error}; --compact lossless keeps all values unchanged"))
}

/// Prints on standard error which files are skipped, cannot be read, or contain the same data. Returns an error for a
/// file without a product, such as a scene.
fn report_files(taken: &Taken) -> anyhow::Result<()> {
    if let Some((single, path)) = taken.singles.first() {
        bail!(
            "{}: {}; expected dataset files, packages, folders or zip archives of them",
            path.display(),
            single.words()
        );
    }
    for reason in &taken.left_out {
        report!("note: skipped: {reason}");
    }
    for failure in &taken.failures {
        report!("warning: not read: {failure}");
    }
    let mut seen: HashMap<&str, &str> = HashMap::new();
    for file in &taken.sources {
        if let Some(other) = seen.insert(&file.content, &file.name).filter(|_| !file.content.is_empty()) {
            report!("note: {}: the same data as {other}", file.name);
        }
    }
    Ok(())
}

/// Returns why a product cannot be stored: the file of its first state without visible transmission, such as a
/// reflector, with what is expected and how many other states are lost with it. `paths`: path of each file, by its
/// name.
fn without_transmission(product: &Gathered, paths: &HashMap<String, String>) -> Option<String> {
    let place = product.datasets.iter().position(|dataset| dataset.transmission_of_either_side().is_none())?;
    let file = paths.get(&product.sources[place]).unwrap_or(&product.file_stem);
    let with_it = match product.datasets.len() - 1 {
        0 => String::new(),
        others => format!("; the other states of the product are not imported either: {others}"),
    };
    Some(format!("{file}: no visible transmission; expected data of light that passes through the system{with_it}"))
}

/// Adds the products of files, folders and archives to the catalogue, in one transaction, and prints their keys.
pub(super) fn import(catalogue: &mut Catalogue, args: &ImportArgs) -> anyhow::Result<()> {
    // Everything is read before anything is stored.
    let taken = import_files(&args.files, SourceFile::read, &Silent);
    let is_container =
        |path: &PathBuf| path.is_dir() || path.extension().is_some_and(|end| end.eq_ignore_ascii_case("zip"));
    // One bad file among many does not stop the others; one that was asked for by name does.
    let several = args.files.iter().any(is_container);
    if let Some(failure) = taken.failures.first().filter(|_| !several) {
        bail!("{failure}");
    }
    report_files(&taken)?;
    if args.compact.is_some() && !taken.packed.is_empty() {
        bail!("--compact is for dataset files; a package keeps the form that its data have");
    }
    let mut list = Vec::new();
    let paths: HashMap<String, String> = taken
        .sources
        .iter()
        .map(|file| (file.name.clone(), Path::new(&file.folder).join(&file.name).display().to_string()))
        .collect();
    for product in gather(taken.sources, if args.name.is_empty() { args.group.grouping() } else { Grouping::One }) {
        if let Some(reason) = without_transmission(&product, &paths) {
            if !several {
                bail!("{reason}");
            }
            report!("warning: not imported: {reason}");
            continue;
        }
        let mut product = described(args, product);
        if let Some(ambiguity) = &product.ambiguity {
            report!("question: {}: {} (--group each, or one, answers)", product.meta.name, ambiguity.question());
        }
        product.meta.contents = product.datasets.iter().map(content_of).collect();
        product.meta.paths = product.sources.iter().filter_map(|name| paths.get(name).cloned()).collect();
        let datasets = product.datasets.iter().map(|d| kept(args, d)).collect::<anyhow::Result<_>>()?;
        list.push((datasets, product.meta));
    }
    list.extend(taken.packed.into_iter().map(|one| (one.datasets, one.meta)));
    if list.is_empty() {
        bail!("nothing to import; expected dataset files (.xml, .btdf.txt, .cfsd) or packages (.cfsp)");
    }
    let mut text = String::new();
    for Stored { imported: product, .. } in catalogue.import_all(list)? {
        writeln!(text, "{}", product.key)?;
        if product.same_content_as == [product.key.as_str()] {
            report!("note: {} already exists and is the same; kept", product.key);
        } else if !product.same_content_as.is_empty() {
            report!("note: the same data are already in {}", product.same_content_as.join(", "));
        }
        for finding in catalogue.product(&product.key)?.findings {
            report!("{}: {}", product.key, finding.line());
        }
    }
    print_text(&text)
}
