//! `cfs catalogue list`: products found by words and filters, in a chosen order.

use super::output::{print, print_text};
use crate::catalogue::{Catalogue, Figure, Found, Origin, ProductRow, Query, Sort, Within};
use crate::texts::{catalogue as text, composed, one_line};
use serde_json::json;
use std::fmt::Write as _;
use std::sync::Arc;

/// Arguments of `cfs catalogue list`.
#[derive(Debug, Default, clap::Args)]
#[command(after_help = "\
Examples:
  cfs catalogue list --search blind
  cfs catalogue list --kind woven --within tau-normal=..0.1 --sort view
  cfs catalogue list --moving --json

Figures, all from 0 to 1, of a product's representative state:
  tau-normal         transmittance at normal incidence
  tau-hemispherical  hemispherical transmittance
  to-ceiling         share of the transmitted skylight that leaves upwards
  sun-blocked        1 − τ for direct sun at 45° altitude, perpendicular to
                     the façade in plan
  view               normal-normal transmittance

In the table, state is the representative state, states the number of states, and ★ marks starred products. A word \
that no product has is read as the most similar one, with a note.")]
pub struct ListArgs {
    /// Words or parts of words in name, maker, kind, tags, key or description, also German words for kinds
    #[arg(long, default_value = "")]
    pub search: String,
    /// Only products of this kind (repeatable: any of them)
    #[arg(long)]
    pub kind: Vec<String>,
    /// Only products of this maker (repeatable: any of them)
    #[arg(long)]
    pub maker: Vec<String>,
    /// Only products with this tag (repeatable: all of them)
    #[arg(long = "tag")]
    pub tags: Vec<String>,
    /// Only products of this collection (repeatable: any of them)
    #[arg(long = "collection")]
    pub collections: Vec<String>,
    /// Only products with several states
    #[arg(long, conflicts_with = "fixed")]
    pub moving: bool,
    /// Only products with one state
    #[arg(long)]
    pub fixed: bool,
    /// Only products with measured data
    #[arg(long, conflicts_with = "computed")]
    pub measured: bool,
    /// Only products with computed data
    #[arg(long)]
    pub computed: bool,
    /// Only starred products
    #[arg(long)]
    pub starred: bool,
    /// Only products with a figure in this range, as in tau-normal=0.2..0.5; either end may be left out (repeatable)
    #[arg(long, value_name = "FIGURE=FROM..TO", value_parser = range)]
    pub within: Vec<Within>,
    /// Order of the list: match, name, maker, kind, states or a figure
    #[arg(long, default_value = "match", value_parser = sort)]
    pub sort: Sort,
    /// Reverse the order, largest value first
    #[arg(long)]
    pub descending: bool,
    /// Print the list as JSON
    #[arg(long)]
    pub json: bool,
}

/// Parses a range of a figure, such as `tau-normal=0.2..0.5`, both ends included.
fn range(text: &str) -> Result<Within, String> {
    let figures = || Figure::ALL.map(Figure::word).join(", ");
    let wrong = || format!("expected FIGURE=FROM..TO, e.g. tau-normal=0.2..0.5; figures: {}", figures());
    let (word, ends) = text.split_once('=').ok_or_else(wrong)?;
    let figure = Figure::ALL.into_iter().find(|figure| figure.word() == word).ok_or_else(wrong)?;
    let (low, high) = ends.split_once("..").ok_or_else(wrong)?;
    let number = |text: &str, otherwise: f64| match text.trim() {
        "" => Ok(otherwise),
        text => text.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(wrong),
    };
    let (low, high) = (number(low, 0.0)?, number(high, f64::INFINITY)?);
    if low > high {
        return Err(format!("{low} is above {high}: the lower end comes first"));
    }
    // The upper end is included.
    Ok(Within { figure, low, high: high.next_up() })
}

fn sort(text: &str) -> Result<Sort, String> {
    let words: Vec<&str> = Sort::all().map(Sort::word).collect();
    Sort::all().find(|sort| sort.word() == text).ok_or_else(|| format!("expected one of {}", words.join(", ")))
}

impl ListArgs {
    /// Returns the catalogue query of the arguments.
    pub fn query(&self) -> Query {
        // Composed as stored names are, whatever the terminal gives.
        let composed = |list: &[String]| list.iter().map(|text| composed(text)).collect();
        Query {
            text: self.search.clone(),
            kinds: composed(&self.kind),
            manufacturers: composed(&self.maker),
            tags: composed(&self.tags),
            collections: self.collections.clone(),
            recent: false,
            shown: Vec::new(),
            favourite: self.starred.then_some(true),
            origin: match (self.measured, self.computed) {
                (true, _) => Some(Origin::Measured),
                (_, true) => Some(Origin::Computed),
                _ => None,
            },
            builtin: None,
            moving: match (self.moving, self.fixed) {
                (true, _) => Some(true),
                (_, true) => Some(false),
                _ => None,
            },
            ranges: self.within.clone(),
            sort: self.sort,
            descending: self.descending,
            like: None,
        }
    }
}

pub(super) fn figure(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3}"))
}

/// Prints on standard error which search words were corrected, and which damaged products were restored or left out.
pub(super) fn report_notes(found: &Found) {
    for (typed, read_as) in &found.read_as {
        report!("note: no product has \"{typed}\"; read as \"{read_as}\"");
    }
    if !found.restored.is_empty() {
        report!("warning: {}", text::restored(found.restored.join(", ")));
    }
    if !found.damaged.is_empty() {
        report!("warning: {}", text::not_listed(found.damaged.join(", ")));
    }
}

/// Prints the products that match the arguments, as a table or as JSON.
pub(super) fn list(catalogue: &Catalogue, args: &ListArgs) -> anyhow::Result<()> {
    let query = args.query();
    let found = catalogue.find(&query)?;
    report_notes(&found);
    let rows = found.entries;
    if rows.is_empty() && !args.json {
        for (filter, count) in &found.without {
            report!("{count} products without \"{}\"", query.words_of(*filter));
        }
    }
    if args.json { print(&as_json(&rows)?) } else { print_text(&as_table(&rows)?) }
}

fn as_json(rows: &[Arc<ProductRow>]) -> anyhow::Result<String> {
    let rows = rows.iter().map(|row| {
        json!({
            "key": row.key, "name": row.name, "manufacturer": row.manufacturer, "kind": row.kind,
            "origin": row.origin.word(), "tau_normal_hemispherical": row.tau_normal,
            "tau_hemispherical_hemispherical": row.tau_hemispherical, "to_ceiling": row.to_ceiling,
            "sun_blocked": row.sun_blocked, "view": row.view, "states": row.states.len(), "state": row.state(),
            "favourite": row.favourite, "builtin": row.builtin,
        })
    });
    Ok(serde_json::to_string_pretty(&rows.collect::<Vec<_>>())? + "\n")
}

fn as_table(rows: &[Arc<ProductRow>]) -> anyhow::Result<String> {
    let widest = |of: fn(&ProductRow) -> &str, least: usize| {
        rows.iter().map(|row| of(row).chars().count()).max().unwrap_or(0).max(least)
    };
    let (width, kind, state) = (widest(|row| &row.key, 3), widest(|row| &row.kind, 4), widest(ProductRow::state, 5));
    let mut text = format!("{:width$}  {:kind$}  τ normal  τ hemi  {:>state$}  states  name\n", "key", "kind", "state");
    for row in rows {
        let (normal, hemispherical) = (figure(row.tau_normal), figure(row.tau_hemispherical));
        let star = if row.favourite { " ★" } else { "" };
        let own = if row.state().is_empty() { "-" } else { row.state() };
        writeln!(
            text,
            "{:width$}  {:kind$}  {normal:>8}  {hemispherical:>6}  {own:>state$}  {:>6}  {}{star}",
            row.key,
            one_line(&row.kind),
            row.states.len(),
            one_line(&row.name)
        )?;
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_with_both_ends() {
        let both = range("tau-normal=0.2..0.5").unwrap();
        assert!(both.holds(0.2) && both.holds(0.5) && !both.holds(0.500_001) && !both.holds(0.1));
        assert!(range("view=0.8..").unwrap().holds(1.0) && range("view=..0.8").unwrap().holds(0.0));
        for wrong in ["tau=0..1", "tau-normal", "tau-normal=a..1", "tau-normal=0.5..0.2", "view=0.5"] {
            assert!(range(wrong).is_err(), "{wrong}");
        }
        assert_eq!(sort("tau-normal"), Ok(Sort::By(Figure::TauNormal)));
        assert!(sort("price").unwrap_err().contains("match, name"));
    }
}
