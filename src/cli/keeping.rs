//! `cfs catalogue rename`, `delete`, `restore` and `history`: changes of products in the catalogue.

use super::output::{print, print_text};
use crate::catalogue::{Catalogue, CatalogueError, Words};
use crate::texts::one_line;
use serde_json::json;
use std::fmt::Write as _;

/// Arguments of `cfs catalogue rename`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue rename opal-sheet-made-up \"Opal sheet\"
  cfs catalogue rename opal-sheet-made-up --tag opal --tag acrylic

What is not specified stays. Built-in products and products of subscribed folders cannot be changed.")]
pub struct RenameArgs {
    /// Key of the product, which does not change
    pub key: String,
    /// New name
    pub name: Option<String>,
    /// New maker
    #[arg(long)]
    pub manufacturer: Option<String>,
    /// New kind, e.g. venetian
    #[arg(long)]
    pub kind: Option<String>,
    /// New tag, replaces all tags of the product (repeatable)
    #[arg(long = "tag")]
    pub tags: Vec<String>,
    /// New licence of the data, e.g. "CC BY 4.0"
    #[arg(long)]
    pub license: Option<String>,
}

/// Arguments of `cfs catalogue delete`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue delete opal-light
  cfs catalogue restore opal-light    restore it

Scenes that name a deleted product still find it.")]
pub struct DeleteArgs {
    /// Keys of the products
    #[arg(required = true)]
    pub keys: Vec<String>,
    /// Remove imported products permanently; they cannot be restored
    #[arg(long)]
    pub for_good: bool,
}

/// Arguments of `cfs catalogue restore`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue restore               list the deleted products
  cfs catalogue restore opal-light    restore one")]
pub struct RestoreArgs {
    /// Keys of the products to restore (default: list the deleted products)
    pub keys: Vec<String>,
    /// Print the list as JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `cfs catalogue history`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue history opal-sheet-made-up

Times are UTC.")]
pub struct HistoryArgs {
    /// Key of the product
    pub key: String,
    /// Print the list as JSON
    #[arg(long)]
    pub json: bool,
}

/// Prints the changes of a product, newest first.
pub(super) fn history(catalogue: &Catalogue, args: &HistoryArgs) -> anyhow::Result<()> {
    let list = catalogue.history(&args.key)?;
    if args.json {
        let rows: Vec<_> = list.iter().map(|event| json!({"at": event.at, "what": event.what})).collect();
        return print(&(serde_json::to_string_pretty(&rows)? + "\n"));
    }
    let mut text = String::new();
    for event in list {
        writeln!(text, "{}  {}", event.at, one_line(&event.what))?;
    }
    print_text(&text)
}

/// Changes name, maker, kind, tags or licence of a product; those that are not specified stay unchanged.
pub(super) fn rename(catalogue: &mut Catalogue, args: &RenameArgs) -> anyhow::Result<()> {
    let product = catalogue.product(&args.key)?;
    let words = [&args.name, &args.manufacturer, &args.kind, &args.license];
    if words.iter().all(|word| word.is_none()) && args.tags.is_empty() {
        anyhow::bail!("nothing to change; expected a NAME, --manufacturer, --kind, --tag or --license");
    }
    let or = |asked: &Option<String>, stored: String| asked.clone().unwrap_or(stored);
    let words = Words {
        name: or(&args.name, product.name),
        manufacturer: or(&args.manufacturer, product.manufacturer),
        kind: or(&args.kind, product.kind),
        tags: if args.tags.is_empty() { product.tags } else { args.tags.clone() },
        license: or(&args.license, product.license),
    };
    Ok(catalogue.describe(&args.key, &words)?)
}

/// Deletes products, restorably or permanently: all of them, or none if one cannot be deleted.
pub(super) fn delete(catalogue: &mut Catalogue, args: &DeleteArgs) -> anyhow::Result<()> {
    let mut done: Vec<&String> = Vec::new();
    for key in &args.keys {
        // Refusals are found before anything is deleted; damaged products may be deleted.
        match catalogue.product(key) {
            Ok(_) | Err(CatalogueError::Damaged(_)) => {}
            Err(error) => return Err(error.into()),
        }
    }
    for key in &args.keys {
        let result = if args.for_good { catalogue.remove_product(key) } else { catalogue.delete_product(key) };
        if let Err(error) = result {
            if !args.for_good {
                for key in done {
                    catalogue.restore_product(key)?;
                }
            }
            return Err(error.into());
        }
        done.push(key);
    }
    Ok(())
}

/// Restores deleted products, or lists them if no key is specified.
pub(super) fn restore(catalogue: &mut Catalogue, args: &RestoreArgs) -> anyhow::Result<()> {
    for key in &args.keys {
        catalogue.restore_product(key)?;
    }
    if !args.keys.is_empty() {
        return Ok(());
    }
    let list = catalogue.deleted_products()?;
    if args.json {
        let rows: Vec<_> = list
            .iter()
            .map(|one| json!({"key": one.key, "name": one.name, "deleted": one.at, "builtin": one.builtin}))
            .collect();
        return print(&(serde_json::to_string_pretty(&rows)? + "\n"));
    }
    let width = list.iter().map(|one| one.key.chars().count()).max().unwrap_or(0).max(3);
    let mut text = format!("{:width$}  {:20}  name\n", "key", "deleted (UTC)");
    for one in list {
        writeln!(text, "{:width$}  {:20}  {}", one.key, one.at, one_line(&one.name))?;
    }
    print_text(&text)
}
