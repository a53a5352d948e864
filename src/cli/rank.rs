//! `cfs rank SCENE…`: ranking of products for a façade.

use super::listing::report_notes;
use super::output::{print, print_text};
use super::progress::TerminalProgress;
use super::rank_csv::{Shape, shard_csv, shard_of};
use super::rank_json::to_json;
use super::rank_merge::merged;
use super::writing::Tables;
use crate::compute::rank::Place;
use crate::drawing::ticks;
use crate::formats::FileKind;
use crate::study::rank::{
    Group, List, Shard, Stage, csv_text, groups, keys, lists_of, ranked_table, run as compute, run_key,
};
use crate::study::{Library, Session, StudyError, files, read_scene_file};
use anyhow::{anyhow, bail};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `cfs rank`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs rank rank.toml --out rank.csv                rank products of the scene
  cfs rank rank.toml --products screen --json      rank products of a search
  cfs rank rank.toml --shard 0/8 --out part-0.csv  compute one of eight parts
  cfs rank --merge part-*.csv --out rank.csv       merge the parts

The products fill the apertures with system = \"ranked\". The table [rank] states the objectives: figures, scale \
limits, weights.

Columns:
  scene          scene file
  climate        weather file or built-in year
  azimuth        bearing of the façade, clockwise from north [°]
  product        key of the product
  FIGURE         value of a figure of the objectives, one column per figure
  FIGURE_error   its estimated absolute error
  utility        score, 0 to 1
  utility_error  its estimated absolute error
  rank_first     best rank that the uncertainty allows
  rank_last      worst rank that the uncertainty allows
  front          front: on the Pareto front; grey: possibly on it, within the
                 uncertainty
  approximate    reasons why figures are less exact than their errors say
  excluded       reason why the product is excluded; all figures are empty
  why            differences from the best product and from the mean

Parts can be computed on several machines; merged, they give the same file as a single run. A part whose file is \
complete is not computed again, and an interrupted run leaves no file. Files of parts have further columns.")]
pub struct RankArgs {
    /// Scene files (.toml) with `[rank]` and `[year]`
    #[arg(required_unless_present = "merge", value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Rank the products found by these search words instead of those of rank.products
    #[arg(long, value_name = "WORDS")]
    pub products: Option<String>,
    /// Compute part n of N only, counted from 0
    #[arg(long, value_name = "n/N", value_parser = Shard::read, requires = "out", conflicts_with = "json")]
    pub shard: Option<Shard>,
    /// Merge the files of all parts, in any order, instead of computing
    #[arg(long, value_name = "PART", num_args = 1.., conflicts_with_all = ["scenes", "shard", "products"])]
    pub merge: Vec<PathBuf>,
    /// Write the table to a CSV file, too
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Print the ranking as JSON, with the contributions to every difference
    #[arg(long)]
    pub json: bool,
}

/// Runs `cfs rank`; errors name the file and the key.
pub fn run(args: &RankArgs, library: &Library) -> anyhow::Result<()> {
    let from = args.scenes.iter().chain(&args.merge).map(PathBuf::as_path);
    args.tables.check(from, args.out.as_deref(), FileKind::Csv, false)?;
    if !args.merge.is_empty() {
        let (lists, figures) = merged(&args.merge)?;
        return report_lists(args, &lists, &figures);
    }
    let groups = asked(&args.scenes, args.products.as_deref(), library)?;
    let figures = figures_of(&groups);
    let counts: Vec<usize> = groups.iter().map(|group| group.products.len()).collect();
    let items = args.shard.unwrap_or(Shard::WHOLE).items(&counts);
    let keys = keys(&groups, &items);
    let shape = args.shard.map(|shard| Shape { shard, run: run_key(&groups), rows: items.len() });
    if let (Some(shape), Some(out)) = (&shape, &args.out)
        && there_already(args, shape, out)?
    {
        report!("{}: already exists", files::absolute(out).display());
        return Ok(());
    }
    let progress = TerminalProgress::new();
    let name = |error: StudyError| match args.scenes.as_slice() {
        [one] => anyhow!("{}: {error}", one.display()),
        _ => anyhow!("{error}"),
    };
    let outcomes = compute(&groups, &items, library, &Session::new().passing(), &[Stage::Full], &|_| (), &progress)
        .map_err(name)?;
    drop(progress);
    let mut lists = lists_of(&groups, &items, outcomes, &keys);
    lists.iter_mut().for_each(List::sort);
    match (&shape, &args.out) {
        (Some(shape), Some(out)) => args.tables.put(Some(out), FileKind::Csv, &shard_csv(&lists, &figures, shape)),
        _ => report_lists(args, &lists, &figures),
    }
}

/// Returns the lists of products to rank, one or more per scene. `products`: search words that replace the selection of
/// the scenes.
pub(super) fn asked(scenes: &[PathBuf], products: Option<&str>, library: &Library) -> anyhow::Result<Vec<Group>> {
    let mut all = Vec::new();
    for (place, path) in scenes.iter().enumerate() {
        if scenes[..place].contains(path) {
            bail!("{}: named twice; expected each scene once", path.display());
        }
        let file = read_scene_file(path)?;
        let base = files::folder(path);
        let find = |words: &str| {
            let (products, found) = library.search(words)?;
            report_notes(&found);
            Ok(products)
        };
        let own = groups(&path.display().to_string(), &file, base, products, &find);
        all.extend(own.map_err(|error| anyhow!("{}: {error}", path.display()))?);
    }
    Ok(all)
}

/// Returns the keys of the figures of all lists, each once, in the order of first appearance.
fn figures_of(groups: &[Group]) -> Vec<String> {
    let mut list: Vec<String> = Vec::new();
    for figure in groups.iter().flat_map(|group| &group.figures) {
        if !list.contains(figure) {
            list.push(figure.clone());
        }
    }
    list
}

/// Whether the file of a part of the ranking exists already and is complete.
///
/// # Errors
/// Returns an error if the file contains a part of another ranking, which is replaced only with `--force`.
fn there_already(args: &RankArgs, shape: &Shape, out: &Path) -> anyhow::Result<bool> {
    match shard_of(out) {
        Some(there) if there == *shape => Ok(true),
        Some(there) if !args.tables.over.force => bail!(
            "{}: holds piece {}/{} of another ranking (other scenes, products or program); choose another name, or replace it \
             with --force",
            out.display(),
            there.shard.number,
            there.shard.count
        ),
        _ => Ok(false),
    }
}

/// Writes the ranked lists to the CSV file, and prints them as a table or as JSON.
fn report_lists(args: &RankArgs, lists: &[List], figures: &[String]) -> anyhow::Result<()> {
    if let Some(out) = &args.out {
        args.tables.put(Some(out), FileKind::Csv, &csv_text(&ranked_table(lists, figures)))?;
    }
    if args.json { print(&format!("{:#}\n", to_json(lists))) } else { print_text(&table(lists)) }
}

/// Returns the ranked lists as a table in text.
fn table(lists: &[List]) -> String {
    let mut text = String::new();
    for list in lists {
        let ranked = list.ranked();
        let ranking = list.ranking(&list.objectives);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}, {}, {}°", list.scene, list.climate, list.azimuth);
        let head = ["rank", "front", "utility", "product"].map(str::to_owned);
        let mut lines = vec![head.into_iter().chain(list.figures.iter().cloned()).collect::<Vec<_>>()];
        for &k in &ranking.order {
            let (row, found) = ranked[k];
            let one = &ranking.list[k];
            let ranks = one.ranks;
            let rank = if ranks.first == ranks.last {
                ranks.first.to_string()
            } else {
                format!("{}-{}", ranks.first, ranks.last)
            };
            let value = |value: f64, error: f64| format!("{} ± {}", ticks::number(value, 3), ticks::number(error, 1));
            let mark = if found.approximate.is_empty() { "" } else { " ~" };
            let place = if one.place == Place::Behind { "" } else { one.place.word() }.to_owned();
            let utility = format!("{:.3} ± {:.3}", one.utility.value, one.utility.error);
            lines.push(
                [rank, place, utility, format!("{}{mark}", row.product)]
                    .into_iter()
                    .chain(found.figures.iter().map(|figure| value(figure.value, figure.error)))
                    .collect(),
            );
        }
        let columns = lines[0].len();
        let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for line in &lines {
            let cells: Vec<String> = line.iter().zip(&widths).map(|(cell, width)| format!("{cell:width$}")).collect();
            let _ = writeln!(text, "  {}", cells.join("  ").trim_end());
        }
        for (row, reason) in list.excluded() {
            let _ = writeln!(text, "  left out: {}: {reason}", row.product);
        }
        if ranked.iter().any(|(_, found)| !found.approximate.is_empty()) {
            let _ = writeln!(text, "  ~ approximate beyond the stated errors; for the reasons see CSV and JSON");
        }
        text.push('\n');
    }
    text
}
