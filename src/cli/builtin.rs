//! Built-in products on the command line: their figures are part of the program, their data are computed on demand.

use super::output;
use super::progress::TerminalProgress;
use super::writing::Tables;
use crate::catalogue::{Catalogue, Query, StateKey};
use crate::formats::FileKind;
use crate::study::Library;
use crate::study::builtin::{complete, table};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `cfs catalogue build`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue build
  cfs catalogue build --out builtin.cfsp

Otherwise, the data of a built-in product are computed when it is first used. Finished data are kept, so an \
interrupted build continues where it stopped.")]
pub struct BuildArgs {
    /// Export all built-in products to a package, too
    #[arg(long, value_name = "FILE.cfsp")]
    pub out: Option<PathBuf>,
    /// Write the figures of all built-in products to a CSV file, too
    #[arg(long, value_name = "FILE.csv")]
    pub table: Option<PathBuf>,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Print the numbers of products and states as JSON
    #[arg(long)]
    pub json: bool,
}

/// Computes the data of those states of built-in products that `wanted` selects and the catalogue does not contain yet.
/// Returns their number.
fn provided(catalogue: &mut Catalogue, wanted: impl Fn(&StateKey) -> bool) -> anyhow::Result<usize> {
    let waiting = catalogue.waiting()?.iter().filter(|one| wanted(one)).count();
    if waiting == 0 {
        return Ok(0);
    }
    let states = if waiting == 1 { "1 state".to_owned() } else { format!("{waiting} states") };
    report!("computing {states} of built-in products, once; finished ones are kept when this is stopped");
    Ok(complete(catalogue, wanted, &Library::default(), &TerminalProgress::new())?)
}

/// Computes the missing data of the built-in products among `keys`, which are about to be used.
pub(super) fn provide(catalogue: &mut Catalogue, keys: &[String]) -> anyhow::Result<()> {
    provided(catalogue, |one| keys.contains(&one.product)).map(|_| ())
}

/// Computes the missing data of all built-in products, and writes them to a package, their figures to a table, if
/// requested.
pub(super) fn build(catalogue: &mut Catalogue, args: &BuildArgs) -> anyhow::Result<()> {
    args.tables.over.check([], args.out.as_deref(), FileKind::Package)?;
    args.tables.check([], args.table.as_deref(), FileKind::Csv, false)?;
    let start = Instant::now();
    let computed = provided(catalogue, |_| true)?;
    catalogue.fill_figures(&TerminalProgress::new())?;
    let rows = catalogue.search(&Query { builtin: Some(true), ..Query::default() })?;
    let keys: Vec<String> = rows.iter().map(|row| row.key.clone()).collect();
    let package = args.out.as_deref().map(|out| Ok::<_, anyhow::Error>((out, catalogue.export_package(&keys)?)));
    let figures = args.table.as_deref().map(|out| Ok::<_, anyhow::Error>((out, args.tables.bytes(&table(catalogue)?))));
    let (package, figures) = (package.transpose()?, figures.transpose()?);
    let mut outputs: Vec<(&Path, FileKind, &[u8])> = Vec::new();
    if let Some((path, bytes)) = &package {
        outputs.push((path, FileKind::Package, bytes));
    }
    if let Some((path, text)) = &figures {
        outputs.push((path, FileKind::Csv, text));
    }
    args.tables.over.write_all(&outputs)?;
    let (products, states) = (keys.len(), catalogue.builtin_states()?);
    if args.json {
        let summary = json!({
            "products": products, "states": states, "computed": computed, "seconds": start.elapsed().as_secs_f64(),
        });
        return output::print(&(serde_json::to_string_pretty(&summary)? + "\n"));
    }
    output::print(&format!("{products} built-in products, {states} states, {computed} of them computed now\n"))
}
