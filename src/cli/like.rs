//! `cfs catalogue like`: products that do the same to light.

use super::output::{print, print_text};
use crate::catalogue::{Catalogue, Query};
use crate::texts::one_line;
use anyhow::bail;
use serde_json::json;
use std::fmt::Write as _;

/// Arguments of `cfs catalogue like`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "The distance is the root of the mean square of five differences, all shares of the light that arrives: τ under uniform
light, τ by profile angle, light to the ceiling, sun blocked, view; what one of two products does not know is left out.
Moving products are taken by the state that stands for them. Differences are those of the listed product from KEY."
)]
pub struct LikeArgs {
    /// Key of the product that the others are to be like.
    pub key: String,
    /// How many, nearest first.
    #[arg(long, default_value_t = 20)]
    pub most: usize,
    /// A JSON array instead of a table.
    #[arg(long)]
    pub json: bool,
}

/// Lists them.
pub(super) fn like(catalogue: &Catalogue, args: &LikeArgs) -> anyhow::Result<()> {
    let found = catalogue.find(&Query { like: Some(args.key.clone()), ..Query::default() })?;
    let Some(likeness) = found.like else {
        bail!("the catalogue holds no product \"{}\"; `cfs catalogue list` shows all keys", args.key);
    };
    let list: Vec<_> = found.entries.iter().zip(&likeness.apart).take(args.most).collect();
    if args.json {
        let one = |(row, apart): &(&std::sync::Arc<crate::catalogue::ProductRow>, &crate::catalogue::Apart)| {
            let [tau, profile, ceiling, sun, view] = apart.terms;
            json!({
                "key": row.key, "name": row.name, "state": row.state(), "distance": apart.distance, "tau": tau,
                "profile": profile, "ceiling": ceiling, "sun_blocked": sun, "view": view,
            })
        };
        return print(&(serde_json::to_string_pretty(&list.iter().map(one).collect::<Vec<_>>())? + "\n"));
    }
    let width = list.iter().map(|(row, _)| row.key.chars().count()).max().unwrap_or(0);
    let mut text = format!("like {} ({})\n", likeness.key, one_line(&likeness.name));
    for (row, apart) in list {
        writeln!(text, "{:width$}  {}", row.key, apart.words())?;
    }
    print_text(&text)
}
