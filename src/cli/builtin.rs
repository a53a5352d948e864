//! Built-in products on the command line: listed at once, computed when they are asked for.

use super::output;
use super::progress::TerminalProgress;
use crate::catalogue::{Catalogue, CurvePoint, Numbers, Origin, ProductRow, Query, Sought, representative};
use crate::compute::estimate::Progress;
use crate::study::control::Device;
use crate::study::goniophotometer::Described;
use crate::study::{Library, files};
use std::path::PathBuf;
use std::sync::Arc;

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

/// Built-in products that are not computed yet, without figures.
pub(super) fn not_computed(catalogue: &Catalogue) -> anyhow::Result<Vec<Sought>> {
    let library = Library::default();
    let mut list = Vec::new();
    for name in catalogue.missing_builtin()? {
        let Some(described) = Described::builtin(name) else { continue };
        let system = &described.file.system;
        let device = Device::described(&described.file, &described.text, described.states(&library)?);
        let value = |place: usize| device.values.as_ref().and_then(|values| values.get(place).copied());
        let numbers: Vec<Numbers> =
            (0..device.keys.len()).map(|place| Numbers { value: value(place), tau_hemispherical: None }).collect();
        let point = |[profile_angle, value]: [f64; 2]| CurvePoint { profile_angle, value };
        let curve: Vec<CurvePoint> = device.curve.iter().copied().map(point).collect();
        let (rule, representative) = representative(&numbers, &curve, &described.text);
        let row = ProductRow {
            key: described.file.key.clone(),
            name: system.name.clone(),
            manufacturer: String::new(),
            kind: system.family().word().to_owned(),
            origin: Origin::Computed,
            states: device.keys,
            representative,
            rule,
            tau_normal: None,
            tau_hemispherical: None,
            tau_profile: Vec::new(),
            to_ceiling: None,
            sun_blocked: None,
            view: None,
            favourite: false,
            builtin: true,
        };
        list.push(Sought {
            row: Arc::new(row),
            description: system.description.clone(),
            tags: described.file.tags.clone(),
        });
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
    let states: usize = rows.iter().map(|row| row.states.len().max(1)).sum();
    output::print(&format!("{} built-in products, {states} states\n", keys.len()))
}
