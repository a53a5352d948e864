//! `cfs repair`: repair of datasets as their findings propose, written to a new file.

use crate::cli::dataset_file;
use crate::cli::writing::{Over, StreamFormat};
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{Diagnosis, Repair, examine, record, recorded, repaired_all, sun_from_above};
use crate::formats::{FileKind, format_to_write, write_dataset};
use anyhow::{anyhow, bail};
use std::path::PathBuf;

/// Arguments of `cfs repair`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs repair opal.btdf.txt --repair turn-upside-down --out turned.btdf.txt
  cfs repair turned.btdf.txt --undo --out undone.btdf.txt

'cfs info' lists the findings with the repairs that they propose. With auto, the certain ones are made; all others \
have to be named.

Repairs:
  turn-upside-down       exchange up and down
  mirror-left-right      exchange left and right
  turn-half-round        rotate by 180° about the normal
  swap-sides             exchange outside and room side
  transpose              exchange incident and emergent directions
  divide-by-100          convert percent to fractions
  multiply-by-100        convert fractions to percent
  remove-cosine          divide by the cosine of the emergent angle
  multiply-cosine        multiply by the cosine of the emergent angle
  remove-solid-angle     divide by the projected solid angle of the patch
  multiply-solid-angle   multiply by the projected solid angle of the patch
  drop-block             remove the function
  derive-by-reciprocity  compute a transmission from that of the other side
  clamp-negative         set negative values to 0

A repair applies to all functions. REPAIR:FUNCTION limits it to all, transmission, reflection, transmission_front, \
transmission_back, reflection_front or reflection_back, REPAIR:BAND.FUNCTION also to the band visible or solar: \
divide-by-100:solar.all.

The repairs made are recorded in the description of the dataset. --undo reverses them, unless one of them has lost \
values (drop-block, derive-by-reciprocity, clamp-negative).")]
pub struct RepairArgs {
    /// Dataset file to repair; it is not changed
    pub file: PathBuf,
    /// Repairs to make in this order, separated by commas, or auto
    #[arg(long, value_delimiter = ',', required_unless_present = "undo")]
    pub repair: Vec<String>,
    /// Undo the repairs recorded in the file, newest first
    #[arg(long, conflicts_with = "repair")]
    pub undo: bool,
    /// Dataset file to write, .xml (BSDF XML) or .btdf.txt
    #[arg(long)]
    pub out: PathBuf,
    /// Option for the format of output to a stream, whose name has no extension.
    #[command(flatten)]
    pub stream: StreamFormat,
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
}

/// Runs `cfs repair`: reads a dataset, makes and records the repairs, and writes the result.
///
/// # Errors
/// Returns an error if the input cannot be read, a word does not name a repair, the data do not allow a repair, or the
/// output format cannot express them. No output file is written then.
pub fn run(args: &RepairArgs) -> anyhow::Result<()> {
    let name = args.file.display();
    let out_name = args.out.to_string_lossy();
    let format = format_to_write(&args.stream.name(&args.out)?.to_string_lossy());
    let format = format.map_err(|error| anyhow!("{out_name}: {error}"))?;
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
            bail!("{name}: no repair is certain; {rest}");
        }
        let mut repaired = repaired_all(dataset, &repairs).map_err(|error| anyhow!("{name}: {error}"))?;
        // What the description recorded before is kept, and undone repairs cancel out.
        repaired.description = record(&dataset.description, &repairs);
        let words: Vec<String> = repairs.iter().map(Repair::to_string).collect();
        report!("repaired: {}", words.join(", "));
        if args.repair.iter().any(|word| word == "auto") && !questions.is_empty() {
            report!("not done, to be confirmed: {questions}");
        }
        if let Some(sentence) = repaired.transmission().and_then(sun_from_above) {
            report!("{sentence}");
        }
        *dataset = repaired;
    }
    let written = write_dataset(format, &datasets).map_err(|error| anyhow!("{out_name}: {error}"))?;
    args.over.write(&args.out, FileKind::Dataset(format), &written.bytes)?;
    for finding in &written.findings {
        report!("{}: {}", finding.severity.word(), finding.message);
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

/// Returns a text that lists the proposed repairs that are not certain, on which somebody who knows the product has to
/// decide, without those in `made`.
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
