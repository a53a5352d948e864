//! `cfs catalogue subscribe`, `unsubscribe` and `subscriptions`: folders of packages whose products are listed with
//! those of the catalogue.

use super::output::{print, print_text};
use crate::catalogue::Catalogue;
use crate::compute::estimate::Silent;
use crate::study::subscriptions::{folder_of, sync};
use serde_json::json;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Arguments of `cfs catalogue subscribe`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue subscribe products

The products of the packages in the folder are listed with the others and cannot be changed. A package is read again \
when its content has changed, and used only if its data match their hashes. The window updates the products when it \
opens, 'cfs catalogue subscriptions' at any time.")]
pub struct SubscribeArgs {
    /// Folder of packages (.cfsp), e.g. on a file share
    pub folder: PathBuf,
}

/// Arguments of `cfs catalogue unsubscribe`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue unsubscribe products")]
pub struct UnsubscribeArgs {
    /// Folder as listed by `cfs catalogue subscriptions`
    pub folder: PathBuf,
}

/// Arguments of `cfs catalogue subscriptions`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue subscriptions

If a folder cannot be reached, its products stay in the catalogue, with a warning.")]
pub struct SubscriptionsArgs {
    /// Print the list as JSON
    #[arg(long)]
    pub json: bool,
}

/// Reads all subscribed folders again, and prints changes of products and problems on standard error.
fn renewed(catalogue: &mut Catalogue) -> anyhow::Result<()> {
    let report = sync(catalogue, &Silent)?;
    for problem in &report.problems {
        report!("warning: {problem}");
    }
    if report.taken + report.gone > 0 {
        report!("note: {} products added or changed, {} removed", report.taken, report.gone);
    }
    Ok(())
}

/// Subscribes to a folder and adds its products to the catalogue.
pub(super) fn subscribe(catalogue: &mut Catalogue, args: &SubscribeArgs) -> anyhow::Result<()> {
    let folder = folder_of(&args.folder).map_err(anyhow::Error::msg)?;
    catalogue.subscribe(&folder)?;
    renewed(catalogue)?;
    print(&format!("{folder}\n"))
}

/// Ends a subscription, also if the folder cannot be reached.
pub(super) fn unsubscribe(catalogue: &mut Catalogue, args: &UnsubscribeArgs) -> anyhow::Result<()> {
    let folder = folder_of(&args.folder).unwrap_or_else(|_| args.folder.display().to_string());
    let gone = catalogue.unsubscribe(&folder)?;
    report!("note: {gone} products removed");
    Ok(())
}

/// Updates the products of the subscribed folders and prints the list of folders.
pub(super) fn list(catalogue: &mut Catalogue, args: &SubscriptionsArgs) -> anyhow::Result<()> {
    renewed(catalogue)?;
    let list = catalogue.subscriptions()?;
    if args.json {
        let rows: Vec<_> = list.iter().map(|one| json!({"folder": one.folder, "products": one.products})).collect();
        return print(&(serde_json::to_string_pretty(&rows)? + "\n"));
    }
    let mut text = String::from("products  folder\n");
    for one in list {
        writeln!(text, "{:>8}  {}", one.products, one.folder)?;
    }
    print_text(&text)
}
