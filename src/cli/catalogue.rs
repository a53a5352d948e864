//! `cfs catalogue`: list, show, import, export and validate products.

use crate::catalogue::{Catalogue, Gathered, Grouping, Imported, Product, SourceFile, gather};
use crate::cli::builtin::{BuildArgs, build, provide};
use crate::cli::keeping::{self, DeleteArgs, RenameArgs, RestoreArgs};
use crate::cli::like::{LikeArgs, like};
pub use crate::cli::listing::ListArgs;
use crate::cli::listing::{figure, list};
use crate::cli::output::print;
use crate::cli::packages::{self, DiffArgs, MergeArgs};
use crate::cli::validate::{ValidateArgs, finding_json, validate};
use crate::compute::btdf::Dataset;
use crate::compute::wavelet::Criterion;
use crate::formats::package::looks_like_package;
use crate::study::compact::{Storage, stored_as, stored_by_default};
use crate::study::files;
use anyhow::{anyhow, bail};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `cfs catalogue`.
#[derive(Debug, clap::Args)]
pub struct CatalogueArgs {
    /// What to do.
    #[command(subcommand)]
    pub action: Action,
}

/// What `cfs catalogue` can do.
#[derive(Debug, clap::Subcommand)]
pub enum Action {
    /// List products.
    List(ListArgs),
    /// Products that do the same to light as this one, nearest first.
    Like(LikeArgs),
    /// Everything about one product.
    Show(ShowArgs),
    /// Add dataset files or packages. Files whose names or contents differ by an angle alone are the states of one product;
    /// .btdf.txt files are a product a name, the functions of one state joined; others are a product each.
    Import(ImportArgs),
    /// Other words about a product of your own: name, maker, kind, tags. Its key stays.
    Rename(RenameArgs),
    /// Take products out of sight, until they are restored.
    Delete(DeleteArgs),
    /// Bring deleted products back; without a key, list them.
    Restore(RestoreArgs),
    /// Write products into a package.
    Export(ExportArgs),
    /// Compute the data of all built-in products that are not computed yet; stopped, it goes on where it was
    Build(BuildArgs),
    /// Check stored products or dataset files: energy, reciprocity, integrity.
    Validate(ValidateArgs),
    /// How two packages differ; ends with status 1 when they do.
    Diff(DiffArgs),
    /// Two packages as one.
    Merge(MergeArgs),
}

/// Arguments of `cfs catalogue show`.
#[derive(Debug, clap::Args)]
pub struct ShowArgs {
    /// Key of the product.
    pub key: String,
    /// A JSON object instead of text.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `cfs catalogue import`.
#[derive(Debug, clap::Args)]
pub struct ImportArgs {
    /// Dataset files, or packages (.cfsp).
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Name of the product; the file's own by default. Makes one product of all files.
    #[arg(long, default_value = "")]
    pub name: String,
    /// Maker; the file's own by default.
    #[arg(long, default_value = "")]
    pub manufacturer: String,
    /// Kind, e.g. venetian.
    #[arg(long, default_value = "")]
    pub kind: String,
    /// Word to find it by; may be given several times.
    #[arg(long = "tag")]
    pub tags: Vec<String>,
    /// Which files are states of one product
    #[arg(long, value_enum, default_value_t, conflicts_with = "name")]
    pub group: Group,
    /// How values are kept; by default without loss below 1 MB, else as `archive`.
    #[arg(long, value_enum)]
    pub compact: Option<Compactness>,
}

/// Which files are states of one product.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Group {
    /// Those that differ by an angle alone, by their names or by what they say of themselves
    #[default]
    Angles,
    /// None: each file is a product
    Each,
    /// All of them
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

/// How the values of indicatrices are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Compactness {
    /// At most 0.5 % of the flux of any indicatrix misplaced
    Archive,
    /// At most 1.5 % of the flux of any indicatrix misplaced
    Normal,
    /// Every value, rounded to 7 digits
    Lossless,
}

/// Arguments of `cfs catalogue export`.
#[derive(Debug, clap::Args)]
pub struct ExportArgs {
    /// Keys of the products.
    #[arg(required = true)]
    pub keys: Vec<String>,
    /// The package to write.
    #[arg(long)]
    pub out: PathBuf,
}

/// Does what the arguments say with the catalogue of a file, or with the user's own.
///
/// # Errors
/// One line that names the product or the file. `validate` fails when anything is not fit for use.
pub fn run(args: &CatalogueArgs, catalogue: Option<&Path>) -> anyhow::Result<()> {
    // Not opened for packages, which need none.
    let open = || catalogue.map_or_else(Catalogue::open_default, Catalogue::open);
    match &args.action {
        Action::Build(args) => build(&mut open()?, args),
        Action::List(args) => list(&open()?, args),
        Action::Like(args) => like(&open()?, args),
        Action::Show(args) => show(&open()?, args),
        Action::Import(args) => import(&mut open()?, args),
        Action::Rename(args) => keeping::rename(&mut open()?, args),
        Action::Delete(args) => keeping::delete(&mut open()?, args),
        Action::Restore(args) => keeping::restore(&mut open()?, args),
        Action::Export(args) => {
            let mut catalogue = open()?;
            provide(&mut catalogue, &args.keys)?;
            Ok(files::write(&args.out, &catalogue.export_package(&args.keys)?)?)
        }
        Action::Validate(args) => validate(&open()?, args),
        Action::Diff(args) => packages::diff(args),
        Action::Merge(args) => packages::merge(args),
    }
}

fn product_json(product: &Product) -> Value {
    let from = &product.provenance;
    let states = product.states.iter().map(|s| {
        json!({
            "key": s.key, "label": s.label, "value": s.value, "dataset": s.dataset,
            "tau_normal_hemispherical": s.tau_normal, "tau_hemispherical_hemispherical": s.tau_hemispherical,
            "to_ceiling": s.light.and_then(|light| light.to_ceiling),
            "sun_blocked": s.light.map(|light| light.sun_blocked), "view": s.light.map(|light| light.view),
        })
    });
    let curve = product.control_curve.iter().map(|p| json!({"profile_angle": p.profile_angle, "value": p.value}));
    json!({
        "key": product.key, "name": product.name, "manufacturer": product.manufacturer, "kind": product.kind,
        "description": product.description, "tags": product.tags, "favourite": product.favourite,
        "builtin": product.builtin,
        "provenance": {
            "origin": from.origin.word(), "author": from.author, "method": from.method, "date": from.date,
            "source_file": from.source_file, "source_hash": from.source_hash, "inside_face": from.inside_face,
        },
        "states": states.collect::<Vec<_>>(),
        "control_curve": curve.collect::<Vec<_>>(),
        "findings": product.findings.iter().map(finding_json).collect::<Vec<_>>(),
    })
}

fn show(catalogue: &Catalogue, args: &ShowArgs) -> anyhow::Result<()> {
    let product = catalogue.product(&args.key)?;
    if args.json {
        return print(&(serde_json::to_string_pretty(&product_json(&product))? + "\n"));
    }
    let from = &product.provenance;
    let mut text = format!("{} ({})\n", product.name, product.key);
    let tags = product.tags.join(", ");
    for (label, value) in [
        ("kind", product.kind.as_str()),
        ("maker", &product.manufacturer),
        ("about", &product.description),
        ("tags", &tags),
        ("origin", from.origin.word()),
        ("by", &from.author),
        ("method", &from.method),
        ("date", &from.date),
        ("source", &from.source_file),
        ("inside face", &from.inside_face),
    ] {
        if !value.is_empty() {
            writeln!(text, "  {label}: {value}")?;
        }
    }
    writeln!(text, "  {:8}  τ normal  τ hemi  up    sun blocked  view   dataset", "state")?;
    for state in &product.states {
        let key = if state.key.is_empty() { "-" } else { &state.key };
        let (normal, hemispherical) = (figure(state.tau_normal), figure(state.tau_hemispherical));
        let short = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.2}"));
        let up = short(state.light.and_then(|light| light.to_ceiling));
        let blocked = short(state.light.map(|light| light.sun_blocked));
        let view = figure(state.light.map(|light| light.view));
        let dataset = state.dataset.as_deref().map_or("not computed yet", |hash| hash.get(..12).unwrap_or(hash));
        writeln!(text, "  {key:8}  {normal:>8}  {hemispherical:>6}  {up:<4}  {blocked:<11}  {view:<5}  {dataset}")?;
    }
    writeln!(
        text,
        "  up: share of the transmitted skylight that leaves upwards; sun blocked: of a sun 45° high before the façade; view: \
         light at normal incidence that goes straight on"
    )?;
    if !product.control_curve.is_empty() {
        writeln!(text, "  control curve (profile angle → state)")?;
        for point in &product.control_curve {
            writeln!(text, "    {:>6.1}°  {:>6.1}", point.profile_angle, point.value)?;
        }
    }
    for finding in &product.findings {
        writeln!(text, "  {} {}: {}", finding.severity.word(), finding.state, finding.message)?;
    }
    print(&text)
}

/// What was asked for beside what the files say; a product without a name takes the first file's, which is told.
fn described(args: &ImportArgs, mut product: Gathered) -> Gathered {
    let meta = &mut product.meta;
    let over = |told: &mut String, asked: &String| {
        if !asked.is_empty() {
            told.clone_from(asked);
        }
    };
    over(&mut meta.name, &args.name);
    over(&mut meta.manufacturer, &args.manufacturer);
    over(&mut meta.kind, &args.kind);
    meta.tags.extend(args.tags.iter().cloned());
    if meta.name.is_empty() {
        meta.name.clone_from(&product.file_stem);
        eprintln!("note: the file gives no name; taken from the file: {} (--name gives another)", meta.name);
    }
    product
}

/// A dataset in the form that the catalogue is to keep.
fn kept(args: &ImportArgs, dataset: &Dataset) -> anyhow::Result<Dataset> {
    let storage = match args.compact {
        None => return Ok(stored_by_default(dataset)),
        Some(Compactness::Lossless) => Storage::Lossless,
        Some(Compactness::Archive) => Storage::Compact(Criterion::ARCHIVE),
        Some(Compactness::Normal) => Storage::Compact(Criterion::NORMAL),
    };
    stored_as(dataset, storage).map_err(|error| anyhow!("{error}; --compact lossless keeps them as they are"))
}

/// All or none: a product that is refused takes those before it out again.
fn import_all(catalogue: &mut Catalogue, products: Vec<Gathered>) -> anyhow::Result<Vec<Imported>> {
    let mut imported: Vec<Imported> = Vec::new();
    for product in products {
        match catalogue.import(&product.datasets, product.meta) {
            Ok(one) => imported.push(one),
            Err(error) => {
                for one in &imported {
                    catalogue.remove_product(&one.key)?;
                }
                return Err(error.into());
            }
        }
    }
    Ok(imported)
}

fn import(catalogue: &mut Catalogue, args: &ImportArgs) -> anyhow::Result<()> {
    let mut sources = Vec::new();
    let mut packages = Vec::new();
    // Everything is read before anything is stored.
    for path in &args.files {
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("cfsp")) {
            let bytes = files::read(path)?;
            if !looks_like_package(&bytes) {
                bail!("{}: not a package; expected a zip file written by export", path.display());
            }
            packages.push((path, bytes));
        } else {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
            let bytes = files::read(path)?;
            let mut source = SourceFile::read(&name, &bytes).map_err(|error| anyhow!("{}: {error}", path.display()))?;
            source.folder = path.parent().map(|folder| folder.display().to_string()).unwrap_or_default();
            sources.push(source);
        }
    }
    if packages.len() > 1 || (!packages.is_empty() && !sources.is_empty()) {
        bail!("one package at a time, without dataset files beside it, so that an import is one step");
    }
    if args.compact.is_some() && !packages.is_empty() {
        bail!("--compact is for dataset files; a package keeps the form that its data have");
    }
    let imported = if let Some((path, bytes)) = packages.first() {
        catalogue.import_package(bytes).map_err(|error| anyhow!("{}: {error}", path.display()))?
    } else {
        let products = gather(sources, if args.name.is_empty() { args.group.grouping() } else { Grouping::One });
        let stored = products.into_iter().map(|product| {
            let mut product = described(args, product);
            product.datasets = product.datasets.iter().map(|d| kept(args, d)).collect::<anyhow::Result<_>>()?;
            Ok(product)
        });
        import_all(catalogue, stored.collect::<anyhow::Result<_>>()?)?
    };
    let mut text = String::new();
    for product in imported {
        writeln!(text, "{}", product.key)?;
        if product.same_content_as == [product.key.as_str()] {
            eprintln!("note: {} is there already, the same; left as it is", product.key);
        } else if !product.same_content_as.is_empty() {
            eprintln!("note: the same data are already in {}", product.same_content_as.join(", "));
        }
        for finding in catalogue.product(&product.key)?.findings {
            eprintln!("{}: {} {}", finding.severity.word(), finding.state, finding.message);
        }
    }
    print(&text)
}
