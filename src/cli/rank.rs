//! `cfs rank SCENE…`: which product for this façade.

use super::output::{print, print_text};
use super::progress::TerminalProgress;
use super::rank_csv::{Shape, shard_csv, shard_of};
use super::rank_json::to_json;
use super::rank_merge::merged;
use super::writing::Over;
use crate::compute::rank::Place;
use crate::drawing::ticks;
use crate::formats::FileKind;
use crate::study::rank::{
    Group, List, Shard, Stage, csv_text, groups, keys, lists_of, ranked_table, run as compute, run_key,
};
use crate::study::{Library, Session, StudyError, read_scene_file};
use anyhow::{anyhow, bail};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Products of the catalogue in a scene's year, put in order by its objectives
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  cfs rank rank.toml --out rank.csv                    all that [rank] asks for
  cfs rank a.toml b.toml --products blind --json       products found by a word, in two scenes
  cfs rank rank.toml --shard 0/8 --out part-0.csv      one of eight pieces, e.g. on eight machines
  cfs rank --merge part-*.csv --out rank.csv           the pieces put together: the same bytes as from one run

The scene says system = \"ranked\" where products go, and in [rank] what counts: figures, anchors, weights.
Columns: scene, climate, azimuth, product, of every figure its value and error, utility (0 to 1) and its error, rank_first and
rank_last (what errors cannot tell apart shares ranks), front (of Pareto; grey: on it by its errors alone), approximate (why),
excluded (why; all else is empty then), why (against the best and the mean).
A piece that is there already is not computed again; one that is killed leaves nothing. Pieces hold further columns.")]
pub struct RankArgs {
    /// Scene files (TOML) with `[rank]` and `[year]`
    #[arg(required_unless_present = "merge", value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Words as in the window's search, instead of rank.products
    #[arg(long, value_name = "WORDS")]
    pub products: Option<String>,
    /// Compute the n-th of N pieces alone, n from 0
    #[arg(long, value_name = "n/N", value_parser = Shard::read, requires = "out", conflicts_with = "json")]
    pub shard: Option<Shard>,
    /// Put pieces together instead, in any order
    #[arg(long, value_name = "PART", num_args = 1.., conflicts_with_all = ["scenes", "shard", "products"])]
    pub merge: Vec<PathBuf>,
    /// CSV file to write
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// What may be written over.
    #[command(flatten)]
    pub over: Over,
    /// Results for programs on standard output, with the parts of every difference
    #[arg(long)]
    pub json: bool,
}

/// Runs the command; errors name the file and the key.
pub fn run(args: &RankArgs, library: &Library) -> anyhow::Result<()> {
    let from = args.scenes.iter().chain(&args.merge).map(PathBuf::as_path);
    args.over.check(from, args.out.as_deref(), FileKind::Csv)?;
    if !args.merge.is_empty() {
        let (lists, figures) = merged(&args.merge)?;
        return tell(args, &lists, &figures);
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
        tell!("{}: is there already", out.display());
        return Ok(());
    }
    let progress = TerminalProgress::new();
    let name = |error: StudyError| match args.scenes.as_slice() {
        [one] => anyhow!("{}: {error}", one.display()),
        _ => anyhow!("{error}"),
    };
    let outcomes =
        compute(&groups, &items, library, &Session::passing(), &[Stage::Full], &|_| (), &progress).map_err(name)?;
    drop(progress);
    let mut lists = lists_of(&groups, &items, outcomes, &keys);
    lists.iter_mut().for_each(List::sort);
    match (&shape, &args.out) {
        (Some(shape), Some(out)) => {
            let text = shard_csv(&lists, &figures, shape);
            args.over.write(out, FileKind::Csv, text.as_bytes())?;
            Ok(())
        }
        _ => tell(args, &lists, &figures),
    }
}

/// The lists that the scenes ask for, of products found by words instead of the scenes' own.
pub(super) fn asked(scenes: &[PathBuf], products: Option<&str>, library: &Library) -> anyhow::Result<Vec<Group>> {
    let mut all = Vec::new();
    for (place, path) in scenes.iter().enumerate() {
        if scenes[..place].contains(path) {
            bail!("{}: named twice; expected each scene once", path.display());
        }
        let file = read_scene_file(path)?;
        let base = path.parent().unwrap_or(Path::new("."));
        let find = |words: &str| {
            let (products, read_as) = library.search(words)?;
            for (typed, read_as) in read_as {
                tell!("note: no product has \"{typed}\"; read as \"{read_as}\"");
            }
            Ok(products)
        };
        let own = groups(&path.display().to_string(), &file, base, products, &find);
        all.extend(own.map_err(|error| anyhow!("{}: {error}", path.display()))?);
    }
    Ok(all)
}

/// The figures of all lists, each once, in their order.
fn figures_of(groups: &[Group]) -> Vec<String> {
    let mut list: Vec<String> = Vec::new();
    for figure in groups.iter().flat_map(|group| &group.figures) {
        if !list.contains(figure) {
            list.push(figure.clone());
        }
    }
    list
}

/// Is the piece there, whole and of this ranking?
///
/// # Errors
/// One of another ranking, which is not replaced without a word.
fn there_already(args: &RankArgs, shape: &Shape, out: &Path) -> anyhow::Result<bool> {
    match shard_of(out) {
        Some(there) if there == *shape => Ok(true),
        Some(there) if !args.over.force => bail!(
            "{}: holds piece {}/{} of another ranking (other scenes, products or program); choose another name, or replace it \
             with --force",
            out.display(),
            there.shard.number,
            there.shard.count
        ),
        _ => Ok(false),
    }
}

/// Writes and prints whole lists.
fn tell(args: &RankArgs, lists: &[List], figures: &[String]) -> anyhow::Result<()> {
    if let Some(out) = &args.out {
        args.over.write(out, FileKind::Csv, csv_text(&ranked_table(lists, figures)).as_bytes())?;
    }
    if args.json { print(&format!("{:#}\n", to_json(lists))) } else { print_text(&table(lists)) }
}

/// Lists for reading.
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
            let _ = writeln!(text, "  ~ approximate beyond the errors; why is told in the CSV and JSON");
        }
        text.push('\n');
    }
    text
}
