//! `cfs catalogue validate`: data check of products and dataset files, e.g. for scripts of manufacturers.

use super::dataset_file;
use super::output::{print, print_text};
use crate::catalogue::{Catalogue, ProductFinding, Query};
use crate::compute::btdf::Severity;
use crate::compute::doctor::examine_all;
use crate::study::files;
use crate::texts::findings::meaning;
use anyhow::bail;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// Arguments of `cfs catalogue validate`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue validate opal.btdf.txt
  cfs catalogue validate venetian-80-72 --json

Prints the findings (error, warning, info) of every item; for files also the repairs that they propose, see cfs \
repair. Exits with status 1 if an item has an error. A key has precedence over a file of the same name; write ./NAME \
for the file.")]
pub struct ValidateArgs {
    /// Dataset files or keys of products (default: all products)
    pub items: Vec<String>,
    /// Print the findings as JSON
    #[arg(long)]
    pub json: bool,
}

/// Finding about a product or file, with its state and the repair that it proposes.
struct Judged {
    finding: ProductFinding,
    repair: Option<String>,
}

/// Checks products and dataset files, and prints their findings.
///
/// # Errors
/// Returns an error if an item is neither a product nor a file, and [`NotFit`] if one is not fit for use.
pub(super) fn validate(catalogue: &Catalogue, args: &ValidateArgs) -> anyhow::Result<()> {
    let all = catalogue.search(&Query::default())?;
    let items =
        if args.items.is_empty() { all.iter().map(|row| row.key.clone()).collect() } else { args.items.clone() };
    let mut results = Vec::new();
    for item in items {
        // Keys first: a file of the same name can still be given as ./NAME. Repairs are made on files, so a stored
        // product is offered none.
        let judged: Vec<Judged> = if all.iter().any(|row| row.key == item) {
            catalogue.validate(&item)?.into_iter().map(|finding| Judged { finding, repair: None }).collect()
        } else if files::is_stream(Path::new(&item)) || Path::new(&item).exists() {
            of_file(Path::new(&item))?
        } else {
            // If skipped, a misspelt item would look as if it were fit for use.
            bail!("{item}: neither a product of the catalogue nor a file");
        };
        results.push((item, judged));
    }
    let valid = |judged: &[Judged]| judged.iter().all(|one| one.finding.severity != Severity::Error);
    let bad = results.iter().filter(|(_, judged)| !valid(judged)).count();
    if args.json {
        let list = results.iter().map(|(item, judged)| {
            let findings = judged.iter().map(|one| {
                let mut value = finding_json(&one.finding);
                value["repair"] = one.repair.clone().into();
                value
            });
            json!({"item": item, "valid": valid(judged), "findings": findings.collect::<Vec<_>>()})
        });
        print(&(serde_json::to_string_pretty(&list.collect::<Vec<_>>())? + "\n"))?;
    } else {
        let mut text = String::new();
        for (item, judged) in &results {
            // Information alone leaves an item "ok".
            let worst = judged.iter().map(|one| one.finding.severity).max();
            writeln!(text, "{item}: {}", worst.filter(|worst| *worst > Severity::Info).map_or("ok", Severity::word))?;
            for Judged { finding, repair } in judged {
                writeln!(text, "  {}", finding.line())?;
                if let Some(repair) = repair {
                    writeln!(text, "    offers: --repair {repair}")?;
                }
            }
        }
        print_text(&text)?;
    }
    // After the report, so that a script that is stopped by the status also shows the reason.
    if bad > 0 {
        return Err(NotFit { bad, of: results.len() }.into());
    }
    Ok(())
}

/// Error for data that are not fit for use. The program exits with status 1, unlike for input that it cannot read.
#[derive(Debug, thiserror::Error)]
#[error("{bad} of {of} not fit for use")]
pub struct NotFit {
    bad: usize,
    of: usize,
}

/// Returns a finding about a product of the catalogue as JSON.
pub(super) fn finding_json(finding: &ProductFinding) -> Value {
    json!({
        "state": finding.state, "severity": finding.severity.word(), "code": finding.code, "message": finding.message,
        "meaning": meaning(&finding.code),
    })
}

/// Returns the findings of reader and data check about a dataset file, with the repairs that they propose.
fn of_file(path: &Path) -> anyhow::Result<Vec<Judged>> {
    let mut list = Vec::new();
    let datasets = dataset_file::read(path)?;
    for (dataset, found) in datasets.iter().zip(examine_all(&datasets)) {
        list.extend(found.into_iter().map(|one| Judged {
            finding: ProductFinding {
                state: dataset.state.clone(),
                severity: one.finding.severity,
                code: one.finding.code.to_owned(),
                message: one.finding.message,
            },
            repair: one.repair.map(|repair| repair.to_string()),
        }));
    }
    Ok(list)
}
