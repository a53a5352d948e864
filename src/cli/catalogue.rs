//! `cfs catalogue`: list, show, import, export and validate products.

use crate::catalogue::{Catalogue, Product};
use crate::cli::builtin::{BuildArgs, build, provide};
use crate::cli::check::{CheckArgs, check};
use crate::cli::importing::import;
pub use crate::cli::importing::{Compactness, Group, ImportArgs};
use crate::cli::keeping::{self, DeleteArgs, HistoryArgs, RenameArgs, RestoreArgs};
use crate::cli::like::{LikeArgs, like};
pub use crate::cli::listing::ListArgs;
use crate::cli::listing::{figure, list};
use crate::cli::output::{print, print_text};
use crate::cli::packages::{self, DiffArgs, MergeArgs};
use crate::cli::subscriptions::{self, SubscribeArgs, SubscriptionsArgs, UnsubscribeArgs};
use crate::cli::validate::{ValidateArgs, finding_json, validate};
use crate::cli::writing::Over;
use crate::formats::FileKind;
use crate::texts::one_line;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `cfs catalogue`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue list --search blind            search products
  cfs catalogue show venetian-80-72            show one product
  cfs catalogue import opal.btdf.txt           add a dataset file

The key of a product, which most commands need, is printed by list and import.")]
pub struct CatalogueArgs {
    /// Command to run
    #[command(subcommand)]
    pub action: Action,
}

/// Subcommand of `cfs catalogue` with its arguments.
#[derive(Debug, clap::Subcommand)]
pub enum Action {
    /// List products that match a search and filters
    List(ListArgs),
    /// List the products with the most similar effect on light, nearest first
    Like(LikeArgs),
    /// Show a product: description, states, figures, findings
    Show(ShowArgs),
    /// Import dataset files, packages, folders and zip archives
    Import(ImportArgs),
    /// Change name, maker, kind, tags or licence of an imported product
    Rename(RenameArgs),
    /// Delete products; they can be restored
    Delete(DeleteArgs),
    /// Restore deleted products, or list them
    Restore(RestoreArgs),
    /// Show the changes of a product, newest first
    History(HistoryArgs),
    /// Subscribe to a folder of packages, whose products are then listed with the others
    Subscribe(SubscribeArgs),
    /// End the subscription to a folder and remove its products
    Unsubscribe(UnsubscribeArgs),
    /// Update and list the subscribed folders
    Subscriptions(SubscriptionsArgs),
    /// Export products to a package
    Export(ExportArgs),
    /// Compute the data of all built-in products
    Build(BuildArgs),
    /// Check the data of products or dataset files: energy, reciprocity, integrity
    Validate(ValidateArgs),
    /// Verify the catalogue file: layout, database pages, products, data
    Check(CheckArgs),
    /// Compare two packages
    Diff(DiffArgs),
    /// Merge two packages
    Merge(MergeArgs),
}

/// Arguments of `cfs catalogue show`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue show venetian-80-72
  cfs catalogue show opal-light --json

Columns of the states:
  state        key of the state
  τ normal     transmittance at normal incidence
  τ hemi       hemispherical transmittance
  up           share of the transmitted skylight that leaves upwards
  sun blocked  1 − τ for direct sun at 45° altitude, perpendicular to the
               façade in plan
  view         normal-normal transmittance
  dataset      hash of the data; those of built-in products are computed when
               they are needed")]
pub struct ShowArgs {
    /// Key of the product
    pub key: String,
    /// Print the product as JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `cfs catalogue export`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue export venetian-80-72 --out blind.cfsp
  cfs catalogue export clear-double opal-light --out products.cfsp

A package contains all states with their data. Data of built-in products that have not been computed yet are \
computed first.")]
pub struct ExportArgs {
    /// Keys of the products
    #[arg(required = true)]
    pub keys: Vec<String>,
    /// Package to write (.cfsp)
    #[arg(long)]
    pub out: PathBuf,
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
}

/// Runs a subcommand of `cfs catalogue` on the given catalogue file, or on the user's default catalogue.
///
/// # Errors
/// Returns an error of one line that names the product or the file; `validate` also if any data are not fit for use.
pub fn run(args: &CatalogueArgs, catalogue: Option<&Path>) -> anyhow::Result<()> {
    // A closure: commands on packages need no catalogue.
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
        Action::History(args) => keeping::history(&open()?, args),
        Action::Subscribe(args) => subscriptions::subscribe(&mut open()?, args),
        Action::Unsubscribe(args) => subscriptions::unsubscribe(&mut open()?, args),
        Action::Subscriptions(args) => subscriptions::list(&mut open()?, args),
        Action::Export(args) => {
            args.over.check([], Some(&args.out), FileKind::Package)?;
            let mut catalogue = open()?;
            provide(&mut catalogue, &args.keys)?;
            Ok(args.over.write(&args.out, FileKind::Package, &catalogue.export_package(&args.keys)?)?)
        }
        Action::Validate(args) => validate(&open()?, args),
        Action::Check(args) => check(catalogue, args),
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
        "description": product.description, "license": product.license, "tags": product.tags, "favourite": product.favourite,
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
    let mut text = format!("{} ({})\n", one_line(&product.name), product.key);
    let tags = product.tags.join(", ");
    for (label, value) in [
        ("kind", product.kind.as_str()),
        ("maker", &product.manufacturer),
        ("about", &product.description),
        ("tags", &tags),
        ("origin", from.origin.word()),
        ("author", &from.author),
        ("method", &from.method),
        ("date", &from.date),
        ("source", &from.source_file),
        ("inside face", &from.inside_face),
        ("license", &product.license),
    ] {
        if !value.is_empty() {
            writeln!(text, "  {label}: {}", one_line(value))?;
        }
    }
    writeln!(text, "  {:8}  τ normal  τ hemi  up    sun blocked  view   dataset", "state")?;
    for state in &product.states {
        let key = if state.key.is_empty() { "-".into() } else { one_line(&state.key) };
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
        "  up: share of the transmitted skylight that leaves upwards; sun blocked: 1 − τ at 45° altitude, \
         perpendicular to the façade; view: regular transmittance at normal incidence"
    )?;
    if !product.control_curve.is_empty() {
        writeln!(text, "  control curve (profile angle → state)")?;
        for point in &product.control_curve {
            writeln!(text, "    {:>6.1}°  {:>6.1}", point.profile_angle, point.value)?;
        }
    }
    for finding in &product.findings {
        writeln!(text, "  {}", one_line(&finding.line()))?;
    }
    print_text(&text)
}
