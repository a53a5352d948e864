//! `cfs repair`: datasets mended as findings offer, written anew.

use crate::cli::dataset_file;
use crate::cli::writing::Over;
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{Diagnosis, Repair, examine, record, recorded, repaired_all, sun_from_above};
use crate::formats::{FileKind, format_to_write, write_dataset};
use anyhow::{anyhow, bail};
use std::path::PathBuf;

/// Arguments of `cfs repair`.
#[derive(Debug, Clone, clap::Args)]
pub struct RepairArgs {
    /// Dataset file to mend; it stays as it is.
    pub file: PathBuf,
    /// What to do, in this order, as `cfs info` offers it: e.g. transpose, turn-upside-down:transmission_back,
    /// divide-by-100:solar.all. `auto`: all that `cfs info` marks as beyond doubt; what is a question must be named.
    #[arg(long, value_delimiter = ',', required_unless_present = "undo")]
    pub repair: Vec<String>,
    /// Undo the repairs that the file records, the last first.
    #[arg(long, conflicts_with = "repair")]
    pub undo: bool,
    /// File to write; the extension says in which format.
    #[arg(long)]
    pub out: PathBuf,
    /// What may be written over.
    #[command(flatten)]
    pub over: Over,
}

/// Reads, mends, records, writes.
///
/// # Errors
/// Input that cannot be read, a word that names no repair, a repair that the data do not allow, an output format that
/// cannot hold them. Nothing is left behind then.
pub fn run(args: &RepairArgs) -> anyhow::Result<()> {
    let name = args.file.display();
    let out_name = args.out.to_string_lossy();
    let format = format_to_write(&out_name).map_err(|error| anyhow!("{out_name}: {error}"))?;
    args.over.check([&*args.file], Some(&args.out), FileKind::Dataset(format))?;
    let mut datasets = dataset_file::read(&args.file)?;
    for dataset in &mut datasets {
        let found = if args.undo { Vec::new() } else { examine(dataset) };
        let repairs = if args.undo { undoing(dataset)? } else { asked(&found, &args.repair)? };
        let questions = questions(&found, &repairs);
        if repairs.is_empty() {
            let rest = if args.undo {
                bail!("{name}: no repair is recorded in it; expected a file that `cfs repair` wrote");
            } else if questions.is_empty() {
                "no finding offers a repair".to_owned()
            } else {
                format!("questions to be answered by name: {questions}; `cfs info` says why they are asked")
            };
            bail!("{name}: nothing is beyond doubt; {rest}");
        }
        let mut mended = repaired_all(dataset, &repairs).map_err(|error| anyhow!("{name}: {error}"))?;
        // What the description recorded before is kept, and undone repairs cancel out.
        mended.description = record(&dataset.description, &repairs);
        let words: Vec<String> = repairs.iter().map(Repair::to_string).collect();
        tell!("repaired: {}", words.join(", "));
        if args.repair.iter().any(|word| word == "auto") && !questions.is_empty() {
            tell!("asked, not done: {questions}");
        }
        if let Some(sentence) = mended.transmission().and_then(sun_from_above) {
            tell!("{sentence}");
        }
        *dataset = mended;
    }
    let written = write_dataset(format, &datasets).map_err(|error| anyhow!("{out_name}: {error}"))?;
    args.over.write(&args.out, FileKind::Dataset(format), &written.bytes)?;
    for finding in &written.findings {
        tell!("{}: {}", finding.severity.word(), finding.message);
    }
    Ok(())
}

fn asked(found: &[Diagnosis], words: &[String]) -> anyhow::Result<Vec<Repair>> {
    let mut list = Vec::new();
    for word in words {
        if word == "auto" {
            let offered = found.iter().filter(|one| one.sure);
            for repair in offered.filter_map(|one| one.repair) {
                if !list.contains(&repair) {
                    list.push(repair);
                }
            }
        } else {
            list.push(word.parse()?);
        }
    }
    Ok(list)
}

/// Repairs that are offered and only somebody who knows the product can decide on, those that are made left out.
fn questions(found: &[Diagnosis], made: &[Repair]) -> String {
    let mut words: Vec<String> = Vec::new();
    for repair in found.iter().filter(|one| !one.sure).filter_map(|one| one.repair) {
        let word = repair.to_string();
        if !made.contains(&repair) && !words.contains(&word) {
            words.push(word);
        }
    }
    words.join(", ")
}

fn undoing(dataset: &Dataset) -> anyhow::Result<Vec<Repair>> {
    let (_, repairs) = recorded(&dataset.description);
    let undo = |repair: &Repair| {
        repair
            .inverse()
            .ok_or_else(|| anyhow!("{repair} cannot be undone: it left values out, which only the source file has"))
    };
    repairs.iter().rev().map(undo).collect()
}
