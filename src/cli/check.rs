//! `cfs catalogue check`: verification of the catalogue file, and its repair.

use super::output::{print, print_text};
use crate::catalogue::{Damage, Health, Place, check_file, default_path};
use crate::study::files;
use crate::study::health::{RepairResult, repair};
use crate::texts::one_line;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// Arguments of `cfs catalogue check`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue check
  cfs catalogue check --repair

Exits with status 1 if anything is damaged, with --repair only if it cannot be repaired. --repair restores layout \
and indices, readable rows of damaged pages, built-in products, and data whose source files are unchanged; it first \
copies the damaged file.")]
pub struct CheckArgs {
    /// Repair what can be restored; a copy of the damaged file is kept beside it
    #[arg(long)]
    pub repair: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// Error for a catalogue file that is damaged. The program exits with status 1, unlike for a catalogue that it cannot
/// read.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {count} {}{}", if *.count == 1 { "damage" } else { "damages" }, if *.repair { "; `cfs catalogue check --repair` repairs what can be repaired" } else { " that cannot be repaired" })]
pub struct Damaged {
    path: String,
    count: usize,
    repair: bool,
}

/// Verifies the catalogue file, repairs it if requested, and prints the result.
///
/// # Errors
/// Returns an error if the file cannot be read, and [`Damaged`] if damages remain.
pub(super) fn check(catalogue: Option<&Path>, args: &CheckArgs) -> anyhow::Result<()> {
    let path = catalogue.map_or_else(default_path, |path| Ok(path.to_owned()))?;
    let health = check_file(&path)?;
    let result = if args.repair && !health.damages.is_empty() { Some(repair(&path, &health)?) } else { None };
    if args.json {
        print(&(serde_json::to_string_pretty(&as_json(&health, result.as_ref()))? + "\n"))?;
    } else {
        print_text(&as_text(&path, &health, result.as_ref())?)?;
    }
    let left = result.as_ref().map_or(health.damages.len(), |result| result.lost.len());
    if left > 0 {
        return Err(Damaged { path: path.display().to_string(), count: left, repair: result.is_none() }.into());
    }
    Ok(())
}

/// Returns a text that states whether, and from what, a damage can be repaired.
const fn outlook(damage: &Damage) -> &'static str {
    match &damage.place {
        Place::Layout => "can be repaired",
        Place::Pages => "rows that can be read can be saved",
        Place::Product { builtin: true, .. } => "is restored from the program",
        Place::Product { builtin: false, .. } => "cannot be restored: import it again",
        Place::Data { builtin: true, .. } => "is computed again when it is needed",
        Place::Data { builtin: false, .. } => {
            "can be repaired while its dataset file is there and unchanged; import a package again"
        }
    }
}

fn as_text(path: &Path, health: &Health, result: Option<&RepairResult>) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    let whole = if health.damages.is_empty() { ": whole" } else { "" };
    writeln!(text, "{}: {} products, {} datasets{whole}", path.display(), health.products, health.datasets)?;
    match result {
        None => {
            for damage in &health.damages {
                writeln!(text, "  {} ({})", one_line(&damage.message), outlook(damage))?;
            }
        }
        Some(result) => {
            writeln!(text, "  as it was: {}", files::absolute(&result.copy).display())?;
            result.repaired.iter().try_for_each(|message| writeln!(text, "  repaired: {message}"))?;
            result.lost.iter().try_for_each(|message| writeln!(text, "  lost: {message}"))?;
            writeln!(text, "  now: {} products, {} datasets", result.after.products, result.after.datasets)?;
        }
    }
    for (key, at) in &result.map_or(health, |result| &result.after).restored {
        writeln!(text, "  product \"{}\" was damaged and restored on {at}", one_line(key))?;
    }
    Ok(text)
}

fn as_json(health: &Health, result: Option<&RepairResult>) -> Value {
    let damages = health.damages.iter().map(|damage| {
        let (product, state) = match &damage.place {
            Place::Data { product, state, .. } => (Some(product), Some(state)),
            Place::Product { key, .. } => (Some(key), None),
            Place::Layout | Place::Pages => (None, None),
        };
        json!({"product": product, "state": state, "message": damage.message, "outlook": outlook(damage)})
    });
    let restored = result.map_or(health, |result| &result.after).restored.iter();
    let restored = restored.map(|(product, at)| json!({"product": product, "at": at}));
    json!({
        "products": health.products, "datasets": health.datasets, "damages": damages.collect::<Vec<_>>(),
        "copy": result.map(|result| result.copy.to_string_lossy()),
        "restored": restored.collect::<Vec<_>>(),
        "mended": result.map(|result| &result.repaired), "lost": result.map(|result| &result.lost),
    })
}
