//! `cfs catalogue diff` and `cfs catalogue merge`: comparison and merging of packages, without a catalogue.

use crate::catalogue::{PackageDiff, diff_packages, merge_packages};
use crate::cli::output;
use crate::cli::writing::Over;
use crate::formats::FileKind;
use crate::formats::package::{self, Package};
use crate::study::files;
use anyhow::anyhow;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Arguments of `cfs catalogue diff`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue export clear-double --out a.cfsp
  cfs catalogue export clear-double opal-light --out b.cfsp
  cfs catalogue diff a.cfsp b.cfsp

In the output, - marks products that are only in the first package, + those only in the second, ~ those that differ. \
Exits with status 1 if the packages differ.")]
pub struct DiffArgs {
    /// First package (.cfsp)
    pub first: PathBuf,
    /// Second package (.cfsp)
    pub second: PathBuf,
    /// Print the differences as JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `cfs catalogue merge`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue export clear-double --out a.cfsp
  cfs catalogue export opal-light --out b.cfsp
  cfs catalogue merge a.cfsp b.cfsp --out all.cfsp

Products that are the same in both packages are written once. If products differ but have the same key, that of the \
second package gets a new key, with a note.")]
pub struct MergeArgs {
    /// First package (.cfsp), whose keys do not change
    pub first: PathBuf,
    /// Second package (.cfsp)
    pub second: PathBuf,
    /// Package to write (.cfsp)
    #[arg(long)]
    pub out: PathBuf,
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
}

/// Error for two packages that differ. The program exits with status 1, unlike for packages that it cannot read.
#[derive(Debug, thiserror::Error)]
#[error(
    "the packages differ: {only_first} products only in the first, {only_second} only in the second, {changed} changed"
)]
pub struct Differ {
    only_first: usize,
    only_second: usize,
    changed: usize,
}

fn read(path: &Path) -> anyhow::Result<Package> {
    package::read(&files::read(path)?).map_err(|error| anyhow!("{}: {error}", path.display()))
}

/// Prints the differences of two packages.
///
/// # Errors
/// Returns an error if a package cannot be read, and [`Differ`] if the packages differ.
pub fn diff(args: &DiffArgs) -> anyhow::Result<()> {
    let diff = diff_packages(&read(&args.first)?, &read(&args.second)?)?;
    let shown = if args.json { serde_json::to_string_pretty(&as_json(&diff))? + "\n" } else { as_text(&diff) };
    output::print(&shown)?;
    if diff.is_same() {
        return Ok(());
    }
    let (only_first, only_second) = (diff.only_first.len(), diff.only_second.len());
    Err(Differ { only_first, only_second, changed: diff.changed.len() }.into())
}

fn as_json(diff: &PackageDiff) -> serde_json::Value {
    let changed = diff.changed.iter().map(|product| {
        let fields = product.fields.iter().map(|(name, a, b)| json!({"field": name, "first": a, "second": b}));
        let states = product.states.iter().map(|state| {
            json!({
                "key": state.key, "datasets": state.hashes, "tau_hemispherical": state.tau_hemispherical,
                "tau_change": state.tau_change,
            })
        });
        json!({
            "key": product.key, "fields": fields.collect::<Vec<_>>(), "states_only_first": product.only_first,
            "states_only_second": product.only_second, "states": states.collect::<Vec<_>>(),
        })
    });
    json!({
        "same": diff.is_same(), "only_first": diff.only_first, "only_second": diff.only_second,
        "changed": changed.collect::<Vec<_>>(),
    })
}

fn as_text(diff: &PackageDiff) -> String {
    let mut text = String::new();
    let mut line = |one: String| text.extend([one.as_str(), "\n"]);
    if diff.is_same() {
        line("same".to_owned());
    }
    diff.only_first.iter().for_each(|key| line(format!("- {key}")));
    diff.only_second.iter().for_each(|key| line(format!("+ {key}")));
    for product in &diff.changed {
        line(format!("~ {}", product.key));
        for (name, a, b) in &product.fields {
            line(format!("    {name}: \"{a}\" → \"{b}\""));
        }
        product.only_first.iter().for_each(|key| line(format!("    - state {key}")));
        product.only_second.iter().for_each(|key| line(format!("    + state {key}")));
        for state in &product.states {
            let [a, b] =
                state.tau_hemispherical.map(|tau| tau.map_or_else(|| "-".to_owned(), |tau| format!("{tau:.4}")));
            let most = state.tau_change.map_or_else(String::new, |most| format!("; τ differs by {most:.4} at most"));
            let short = |hash: &str| hash.get(..12).unwrap_or_default().to_owned();
            line(format!(
                "    ~ state {}: {} → {}, τ hemi {a} → {b}{most}",
                state.key,
                short(&state.hashes[0]),
                short(&state.hashes[1])
            ));
        }
    }
    text
}

/// Merges two packages into one file.
///
/// # Errors
/// Returns an error if a package cannot be read or written.
pub fn merge(args: &MergeArgs) -> anyhow::Result<()> {
    args.over.check([&*args.first, &*args.second], Some(&args.out), FileKind::Package)?;
    let merged = merge_packages(&read(&args.first)?, &read(&args.second)?)?;
    args.over.write(&args.out, FileKind::Package, &package::write(&merged.package)?)?;
    for key in &merged.same {
        report!("note: {key}: the same in both, kept once");
    }
    for (key, new) in &merged.renamed {
        report!("note: {key}: other content in {}, kept as {new}", args.second.display());
    }
    output::print(&format!("{} products\n", merged.package.products.len()))
}
