//! `cfs catalogue like`: products with the most similar effect on light.

use super::listing::report_notes;
use super::output::{print, print_text};
use crate::catalogue::{Catalogue, Query};
use crate::texts::one_line;
use anyhow::bail;
use serde_json::json;
use std::fmt::Write as _;

/// Arguments of `cfs catalogue like`.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue like venetian-80-72 --most 5

The distance of two products is the root mean square of five differences, all relative to the incident light. The \
largest of them are printed, as the value of the listed product minus that of KEY:
  τ            hemispherical transmittance
  profile      transmittance over the profile angle: root mean square, no sign
  ceiling      light that leaves upwards, relative to the incident light
  sun blocked  1 − τ for direct sun at 45° altitude, perpendicular to the
               façade in plan
  view         normal-normal transmittance

A difference is left out if one of the values is unknown. Products with several states are compared in their \
representative state.")]
pub struct LikeArgs {
    /// Key of the product to compare with
    pub key: String,
    /// Maximum number of products to list
    #[arg(long, default_value_t = 20)]
    pub most: usize,
    /// Print the list as JSON
    #[arg(long)]
    pub json: bool,
}

/// Lists the products with the most similar effect on light, nearest first.
pub(super) fn like(catalogue: &Catalogue, args: &LikeArgs) -> anyhow::Result<()> {
    let found = catalogue.find(&Query { like: Some(args.key.clone()), ..Query::default() })?;
    report_notes(&found);
    let Some(likeness) = found.like else {
        bail!("the catalogue holds no product \"{}\"; `cfs catalogue list` shows all keys", args.key);
    };
    let list: Vec<_> = found.entries.iter().zip(&likeness.distances).take(args.most).collect();
    if args.json {
        let one =
            |(row, distance): &(&std::sync::Arc<crate::catalogue::ProductRow>, &crate::catalogue::ProductDistance)| {
                let [tau, profile, ceiling, sun, view] = distance.terms;
                json!({
                    "key": row.key, "name": row.name, "state": row.state(), "distance": distance.distance, "tau": tau,
                    "profile": profile, "ceiling": ceiling, "sun_blocked": sun, "view": view,
                })
            };
        return print(&(serde_json::to_string_pretty(&list.iter().map(one).collect::<Vec<_>>())? + "\n"));
    }
    let width = list.iter().map(|(row, _)| row.key.chars().count()).max().unwrap_or(0);
    let mut text = format!("like {} ({})\n", likeness.key, one_line(&likeness.name));
    for (row, distance) in list {
        writeln!(text, "{:width$}  {}", row.key, distance.words())?;
    }
    print_text(&text)
}
