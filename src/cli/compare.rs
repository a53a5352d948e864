//! `cfs compare`: figures of scenes, of their candidates and of products side by side.

use super::progress::TerminalProgress;
use super::writing::Tables;
use crate::formats::FileKind;
use crate::study::comparison::{
    DataFacts, FIGURES, Facts, Row, Value, Verdict, candidate, compare, csv, facts, label, verdict_words,
};
use crate::study::goniophotometer::LayerLibrary as _;
use crate::study::scene_file::{CompareKeys, SceneFile, SystemKeys};
use crate::study::system::{Need, SystemLibrary as _};
use crate::study::{Library, Scene, Session, files, read_scene_file};
use anyhow::{Context as _, anyhow, bail};
use serde_json::{Value as Json, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `cfs compare`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs compare blind.toml overhang.toml         compare scenes
  cfs compare clear-double venetian-80-72:45   compare data of products
  cfs compare clear-double opal-light --scene office.toml --csv
                                               compare products in a scene

A scene with [[compare]] stands for its candidates. A product without STATE is compared in its representative state. \
With --scene, the products fill the apertures that hold a product of the catalogue, or the first aperture if none \
does.

A candidate is named as better if the difference is larger than the uncertainties of both values together. Measured \
data have no stated uncertainty, so their differences are not judged.

Columns of --csv:
  figure         key of the figure
  unit           its unit
  better_is      whether more or less is better, or neither in general
  NAME           value of candidate NAME, one column per candidate
  error of NAME  its uncertainty; empty if not stated
  better         better candidates, or reason why none is named")]
pub struct CompareArgs {
    /// Scene files (.toml), or products of the catalogue as KEY or KEY:STATE
    #[arg(required = true, value_name = "SCENE|PRODUCT")]
    pub what: Vec<String>,
    /// Compare the products in this scene instead of their data alone
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<PathBuf>,
    /// Write the result to a file instead of standard output
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Print a CSV table with one row per figure
    #[arg(long, conflicts_with = "json")]
    pub csv: bool,
    /// Print the results as JSON
    #[arg(long)]
    pub json: bool,
}

/// Candidate of a comparison.
enum One {
    /// Scene, and the folder to which its paths are relative.
    Scene(Box<SceneFile>, PathBuf),
    /// Product of which only the optical data are compared, without a scene.
    Data(SystemKeys),
}

/// Runs `cfs compare`.
pub fn run(args: &CompareArgs, library: &Library) -> anyhow::Result<()> {
    let kind = match (args.json, args.csv) {
        (true, _) => FileKind::Json,
        (_, true) => FileKind::Csv,
        _ => FileKind::Comparison,
    };
    let from = args.what.iter().map(Path::new).chain(args.scene.as_deref());
    args.tables.check(from, args.out.as_deref(), kind, true)?;
    let base = args.scene.as_deref().map(read).transpose()?;
    let mut list: Vec<(String, One)> = Vec::new();
    for what in &args.what {
        let path = Path::new(what);
        if files::is_stream(path) || path.extension().is_some_and(|ending| ending == "toml") {
            let (scene, folder) = read(path)?;
            if scene.compare.is_empty() {
                let name = path.file_stem().map_or_else(|| what.clone(), |stem| stem.to_string_lossy().into_owned());
                list.push((name, One::Scene(Box::new(scene), folder)));
                continue;
            }
            list.extend(
                scene
                    .compare
                    .iter()
                    .map(|keys| (label(keys), One::Scene(Box::new(candidate(&scene, keys)), folder.clone()))),
            );
        } else {
            let (name, system) = product(what, library)?;
            list.push((
                name,
                match &base {
                    Some((scene, folder)) => {
                        let keys = CompareKeys { system: Some(system), ..CompareKeys::default() };
                        One::Scene(Box::new(candidate(scene, &keys)), folder.clone())
                    }
                    None => One::Data(system),
                },
            ));
        }
    }
    let (session, progress) = (Session::new(), TerminalProgress::new());
    let names: Vec<String> = list.iter().map(|(name, _)| name.clone()).collect();
    let mut all = Vec::with_capacity(list.len());
    for (name, one) in list {
        let found = match one {
            One::Scene(file, folder) => {
                Scene::resolve(&file, &folder, library).and_then(|scene| facts(&scene, &session, &progress))
            }
            One::Data(system) => library
                .load(&system, Path::new(""), Need::Everything)
                .map(|system| Facts { data: DataFacts::of(&system.dataset), ..Facts::default() }),
        };
        all.push(found.with_context(|| name)?);
    }
    drop(progress);
    let mut rows = compare(FIGURES, &all.iter().collect::<Vec<_>>());
    rows.retain(|row| row.values.iter().any(Option::is_some));
    let text = match (args.json, args.csv) {
        (true, _) => format!("{:#}\n", to_json(&rows, &names)),
        (_, true) => csv(&rows, &names),
        _ => table(&rows, &names),
    };
    args.tables.put(args.out.as_deref(), kind, &text)
}

fn read(path: &Path) -> anyhow::Result<(SceneFile, PathBuf)> {
    Ok((read_scene_file(path)?, files::folder(path).to_owned()))
}

/// Returns a product given as KEY or KEY:STATE: its name, and the keys by which a scene selects it.
fn product(what: &str, library: &Library) -> anyhow::Result<(String, SystemKeys)> {
    let (key, state) = what.split_once(':').map_or((what, None), |(key, state)| (key, Some(state)));
    let known = library
        .product(key)
        .map_err(|error| anyhow!("{what}: {error}; expected a scene (.toml) or a product's key"))?;
    let stands = || known.states.get(known.representative().1);
    let chosen = match state {
        Some(state) => known.states.iter().find(|one| one.key == state),
        None => stands(),
    };
    let Some(chosen) = chosen else {
        let states: Vec<&str> = known.states.iter().map(|one| one.key.as_str()).collect();
        bail!("{what}: {key} has no such state; it has: {}", states.join(", "));
    };
    let name = if known.states.len() > 1 { format!("{}, {}", known.name, chosen.label) } else { known.name.clone() };
    Ok((
        name,
        SystemKeys::Catalogue { key: key.to_owned(), state: Some(chosen.key.clone()).filter(|key| !key.is_empty()) },
    ))
}

fn table(rows: &[Row], names: &[String]) -> String {
    let mut text = String::new();
    for (place, name) in names.iter().enumerate() {
        let _ = writeln!(text, "{:>2}  {name}", place + 1);
    }
    let numbers: Vec<String> = (1..=names.len()).map(|number| number.to_string()).collect();
    let mut lines = vec![
        std::iter::once("figure".to_owned())
            .chain(numbers.iter().cloned())
            .chain(["better".to_owned()])
            .collect::<Vec<_>>(),
    ];
    for row in rows {
        let unit = if row.figure.unit.is_empty() { String::new() } else { format!(" / {}", row.figure.unit) };
        let better = match &row.verdict {
            Verdict::Better(_) => format!("{} ({})", verdict_words(&row.verdict, &numbers), row.figure.sense.words()),
            other => verdict_words(other, &numbers),
        };
        let values = row.values.iter().map(|value| value.map_or_else(|| "-".to_owned(), Value::words));
        lines.push(std::iter::once(format!("{}{unit}", row.figure.name)).chain(values).chain([better]).collect());
    }
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..names.len() + 2).map(width).collect();
    text.push('\n');
    for line in &lines {
        let cells: Vec<String> = line.iter().zip(&widths).map(|(cell, width)| format!("{cell:width$}")).collect();
        let _ = writeln!(text, "{}", cells.join("  ").trim_end());
    }
    text
}

fn to_json(rows: &[Row], names: &[String]) -> Json {
    let value = |value: &Option<Value>| match value {
        Some(Value { value, error }) => json!({ "value": value, "error": error }),
        None => Json::Null,
    };
    let figure = |row: &Row| {
        let (verdict, better) = match &row.verdict {
            Verdict::Better(list) => ("better", list.as_slice()),
            Verdict::Within => ("within-errors", &[][..]),
            Verdict::Aim => ("aim", &[][..]),
            Verdict::Unstated => ("error-not-stated", &[][..]),
            Verdict::Alone => ("alone", &[][..]),
        };
        json!({
            "figure": row.figure.key, "name": row.figure.json_name(), "unit": row.figure.unit,
            "better_is": row.figure.sense.key(), "values": row.values.iter().map(value).collect::<Vec<_>>(),
            "verdict": verdict, "better": better,
        })
    };
    json!({ "candidates": names, "figures": rows.iter().map(figure).collect::<Vec<_>>() })
}
