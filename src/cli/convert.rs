//! `cfs convert`: conversion between the dataset formats that the program reads and writes.

use crate::cli::dataset_file;
use crate::cli::writing::{Over, StreamFormat};
use crate::compute::btdf::{Component, Dataset, TreeRank};
use crate::formats::bsdf_xml::{self, TreeForm};
use crate::formats::{FileKind, Format, FormatError, Written, btdf_text, format_to_write, write_dataset};
use anyhow::anyhow;
use std::path::PathBuf;

/// Arguments of `cfs convert`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs convert opal.btdf.txt opal.xml            matrices on Klems bases
  cfs convert opal.btdf.txt tree.xml --tree 3   tensor trees
  cfs convert - - --format xml                  standard input and output

Reads .xml, .btdf.txt, .cfsd, and .cfsp with one product. Findings of the conversion are printed on standard error.")]
pub struct ConvertArgs {
    /// Dataset file to read
    pub input: PathBuf,
    /// Dataset file to write, .xml (BSDF XML) or .btdf.txt
    pub output: PathBuf,
    /// Option for the format of output to a stream, whose name has no extension.
    #[command(flatten)]
    pub stream: StreamFormat,
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
    /// Key of the state to convert, for files with several states
    #[arg(long)]
    pub state: Option<String>,
    /// Function to write to .btdf.txt, which contains only one: transmission_front, transmission_back, reflection_front
    /// or reflection_back
    #[arg(long, value_parser = component)]
    pub component: Option<Component>,
    /// Representation of the functions in BSDF XML (default: tensor trees stay tensor trees, all others become
    /// matrices)
    #[arg(long, value_enum)]
    pub tree: Option<TreeChoice>,
    /// Resolution of the tree, 2^LEVEL steps per coordinate: 1 to 6 for rank 4, 1 to 8 for rank 3 (default: that of the
    /// source, at most 6)
    #[arg(long, requires = "tree")]
    pub level: Option<u32>,
    /// Largest share of the light that pruning the tree may misplace (default: 0.01, but no pruning of tensor trees of
    /// the source)
    #[arg(long, requires = "tree")]
    pub tolerance: Option<f64>,
}

/// Representation of the functions in BSDF XML: tensor trees or matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum TreeChoice {
    /// Tensor tree of rank 4
    #[value(name = "4")]
    Four,
    /// Tensor tree of rank 3, for rotationally symmetric systems
    #[value(name = "3")]
    Three,
    /// Matrices on Klems bases
    #[value(alias = "none")]
    Klems,
}

/// Returns a dataset as a BSDF XML file in the chosen representation.
fn in_form(dataset: &Dataset, choice: TreeChoice, args: &ConvertArgs) -> Result<Written, FormatError> {
    let rank = match choice {
        TreeChoice::Four => TreeRank::Four,
        TreeChoice::Three => TreeRank::Three,
        TreeChoice::Klems => return bsdf_xml::write_matrices(dataset),
    };
    bsdf_xml::write_tree(dataset, TreeForm { rank, level: args.level, tolerance: args.tolerance, derived: true })
}

fn component(word: &str) -> Result<Component, String> {
    Component::ALL.into_iter().find(|component| component.key() == word).ok_or_else(|| {
        let keys: Vec<&str> = Component::ALL.into_iter().map(Component::key).collect();
        format!("no function '{word}'; expected one of {}", keys.join(", "))
    })
}

/// Runs `cfs convert`: reads a dataset and writes it in another format.
///
/// # Errors
/// Returns an error if the input cannot be read, the state does not exist, or the output format is unknown or cannot
/// express the data. No output file is written then.
pub fn run(args: &ConvertArgs) -> anyhow::Result<()> {
    let out_name = args.output.to_string_lossy();
    // Before the input is read: that may take seconds, a wrong extension is known at once.
    let format = format_to_write(&args.stream.name(&args.output)?.to_string_lossy());
    let format = format.map_err(|error| anyhow!("{out_name}: {error}"))?;
    args.over.check([&*args.input], Some(&args.output), FileKind::Dataset(format))?;
    let mut datasets = dataset_file::read(&args.input)?;
    if let Some(state) = &args.state {
        // Taken down before the others are gone: the message needs them.
        let keys: Vec<String> = datasets.iter().map(|one| format!("'{}'", one.state)).collect();
        datasets.retain(|one| one.state == *state);
        if datasets.is_empty() {
            return Err(anyhow!("{}: no state '{state}'; expected one of {}", args.input.display(), keys.join(", ")));
        }
    }
    // The parser asks only whether `--tree` is there; matrices would pass these over without a word.
    if args.tree == Some(TreeChoice::Klems) && (args.level.is_some() || args.tolerance.is_some()) {
        return Err(anyhow!("--level and --tolerance are for trees; expected --tree 3 or --tree 4"));
    }
    if args.tree.is_some() && format != Format::BsdfXml {
        return Err(anyhow!("{out_name}: --tree for {}; expected a BSDF XML file (.xml)", format.name()));
    }
    let written = match (format, args.component, datasets.as_slice()) {
        // Several states go to the writer, which says how many a file holds and how to choose.
        (Format::BsdfXml, None, [one]) if let Some(choice) = args.tree => in_form(one, choice, args),
        (_, None, all) => write_dataset(format, all),
        (Format::BtdfText, Some(component), [one]) => btdf_text::write_component(one, component),
        (_, Some(component), _) => {
            return Err(anyhow!(
                "{out_name}: --component {} for {} states in {}; expected one state, and a format that holds one function \
                 (.btdf.txt)",
                component.key(),
                datasets.len(),
                format.name()
            ));
        }
    };
    let written = written.map_err(|error| anyhow!("{out_name}: {error}"))?;
    args.over.write(&args.output, FileKind::Dataset(format), &written.bytes)?;
    // After the file is there: findings are about data that could be written. To stderr, as results alone go to stdout.
    for finding in datasets.iter().flat_map(|one| &one.findings).chain(&written.findings) {
        report!("{}: {}", finding.severity.word(), finding.message);
    }
    Ok(())
}
