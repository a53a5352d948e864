//! Built-in products on the command line: listed at once, computed when they are asked for.

use super::output;
use super::progress::TerminalProgress;
use crate::catalogue::{Catalogue, Origin, ProductRow, Query};
use crate::compute::estimate::Progress;
use crate::study::goniophotometer::Described;
use crate::study::{Library, files};
use std::path::PathBuf;

/// Arguments of `cfs catalogue build`.
#[derive(Debug, clap::Args)]
pub struct BuildArgs {
    /// Write all built-in products as a package, too.
    #[arg(long, value_name = "FILE.cfsp")]
    pub out: Option<PathBuf>,
}

/// Computes those wanted of the built-in products that the catalogue does not hold yet.
pub(super) fn complete(catalogue: &mut Catalogue, wanted: impl Fn(&str) -> bool) -> anyhow::Result<()> {
    let missing: Vec<&str> = catalogue.missing_builtin()?.into_iter().filter(|name| wanted(name)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    eprintln!("computing {} built-in products, once", missing.len());
    let progress = TerminalProgress::new();
    for (done, name) in missing.iter().enumerate() {
        progress.advance("built-in products", done, missing.len());
        let (product, datasets) = crate::study::builtin::compute(name, &Library::default(), &progress)?;
        catalogue.put_builtin(name, product, &datasets)?;
    }
    Ok(())
}

/// The same for the products of some keys.
pub(super) fn provide(catalogue: &mut Catalogue, keys: &[String]) -> anyhow::Result<()> {
    complete(catalogue, |name| name.strip_suffix(".system.toml").is_some_and(|key| keys.iter().any(|k| k == key)))
}

/// Built-in products that are not computed yet, without figures, as far as words and kind ask for them.
pub(super) fn not_computed(catalogue: &Catalogue, search: &str, kind: Option<&str>) -> anyhow::Result<Vec<ProductRow>> {
    let library = Library::default();
    let words: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    let mut list = Vec::new();
    for name in catalogue.missing_builtin()? {
        let Some(described) = Described::builtin(name) else { continue };
        let system = &described.file.system;
        let text = format!("{} {} {}", system.name, system.description, described.file.tags.join(" ")).to_lowercase();
        let asked = kind.is_none_or(|kind| kind == system.family().word());
        if asked && words.iter().all(|word| text.contains(word)) {
            list.push(ProductRow {
                key: described.file.key.clone(),
                name: system.name.clone(),
                manufacturer: String::new(),
                kind: system.family().word().to_owned(),
                origin: Origin::Computed,
                state_keys: described.states(&library)?,
                tau_normal: None,
                tau_hemispherical: None,
                tau_profile: Vec::new(),
                favourite: false,
                builtin: true,
            });
        }
    }
    Ok(list)
}

/// Says what is built in, and writes it as a package where asked.
pub(super) fn build(catalogue: &Catalogue, args: &BuildArgs) -> anyhow::Result<()> {
    let rows = catalogue.search(&Query { builtin: Some(true), ..Query::default() })?;
    let keys: Vec<String> = rows.iter().map(|row| row.key.clone()).collect();
    if let Some(out) = &args.out {
        files::write(out, &catalogue.export_package(&keys)?)?;
    }
    let states: usize = rows.iter().map(|row| row.state_keys.len().max(1)).sum();
    output::print(&format!("{} built-in products, {states} states\n", keys.len()))
}
