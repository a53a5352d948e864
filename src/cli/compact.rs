//! `cfs compact`: size and error of a dataset compressed by wavelets, and the compressed dataset.

use crate::cli::writing::Over;
use crate::cli::{dataset_file, output};
use crate::compute::btdf::Dataset;
use crate::compute::wavelet::Criterion;
use crate::formats::FileKind;
use crate::formats::dataset_blob;
use crate::study::compact::{CompactedFunction, compact, criterion_words};
use anyhow::{anyhow, bail};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Measure of the compression error that the threshold limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum By {
    /// Flux in wrong directions, in percent of τ
    Misplaced,
    /// Root mean square difference, in percent of the root mean square of the indicatrix
    Rms,
    /// Dropped energy Σc², in percent: the square of rms (1 % of the energy is 10 % rms)
    Energy,
}

/// Arguments of `cfs compact`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs compact opal.btdf.txt
  cfs compact opal.btdf.txt --threshold normal --out opal.cfsd

The compact form stores every indicatrix as quantised wavelet coefficients. Functions in closed form and tensor \
trees are not changed.

Columns for the standard room, 4 m x 6 m x 3 m with a façade aperture of 4 m x 2 m:
  LID misplaced  flux of the LID in wrong directions, relative to its flux
  Σ|ΔE|/ΣE       mean change of the illuminances, relative
  largest ΔE     largest change of an illuminance, relative
  mean E         mean illuminance without the compact form [lx]")]
pub struct CompactArgs {
    /// Dataset file (.xml, .btdf.txt, .cfsd, or .cfsp with one product)
    pub file: PathBuf,
    /// Error that the threshold limits in every indicatrix
    #[arg(long, value_enum, default_value = "misplaced")]
    pub by: By,
    /// Threshold in percent, or archive (0.5 % of the flux misplaced) or normal (1.5 %); default: archive, or 1 with
    /// --by rms or energy
    #[arg(long, value_name = "PERCENT")]
    pub threshold: Option<String>,
    /// Key of the state, for files with several states (default: all states)
    #[arg(long)]
    pub state: Option<String>,
    /// Print JSON: one object, or an array of objects if there are several states
    #[arg(long)]
    pub json: bool,
    /// Write one state, compressed, to a file
    #[arg(long, value_name = "FILE.cfsd")]
    pub out: Option<PathBuf>,
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
}

/// Parses `--threshold`: returns the limit of the compression error for a percentage, `archive` or `normal`.
pub(super) fn criterion(by: By, threshold: &str) -> anyhow::Result<Criterion> {
    let made = match (by, threshold) {
        (By::Misplaced, "archive") => Criterion::ARCHIVE,
        (By::Misplaced, "normal") => Criterion::NORMAL,
        (_, "archive") => bail!("--threshold archive belongs to --by misplaced; give a percentage, as --threshold 1 %"),
        (_, "normal") => bail!("--threshold normal belongs to --by misplaced; give a percentage, as --threshold 1 %"),
        (by, text) => {
            let number: f64 = text.trim_end_matches('%').trim().parse().map_err(|_| {
                anyhow!("--threshold {text}: not a number; expected a percentage, `archive` or `normal`")
            })?;
            match by {
                By::Misplaced => Criterion::Misplaced(number / 100.0),
                By::Rms => Criterion::Rms(number / 100.0),
                By::Energy => Criterion::Energy(number / 100.0),
            }
        }
    };
    if !made.is_valid() {
        bail!("--threshold {threshold}: out of range; expected 0.0001 % to below 100 %");
    }
    Ok(made)
}

/// Runs `cfs compact`: reads datasets, compresses them by wavelets, and prints and writes the result.
///
/// # Errors
/// Returns an error if the input cannot be read, the threshold is out of range, or the data cannot be compressed.
pub fn run(args: &CompactArgs) -> anyhow::Result<()> {
    let by_default = if args.by == By::Misplaced { "archive" } else { "1" };
    let criterion = criterion(args.by, args.threshold.as_deref().unwrap_or(by_default))?;
    let name = args.file.display();
    let mut datasets = dataset_file::read(&args.file)?;
    if let Some(state) = &args.state {
        let keys: Vec<String> = datasets.iter().map(|one| format!("'{}'", one.state)).collect();
        datasets.retain(|one| one.state == *state);
        if datasets.is_empty() {
            bail!("{name}: no state '{state}'; expected one of {}", keys.join(", "));
        }
    }
    if args.out.is_some() && datasets.len() != 1 {
        bail!("{name}: {} states for one .cfsd file; choose one with --state", datasets.len());
    }
    args.over.check([], args.out.as_deref(), FileKind::Compact)?;
    let mut texts = Vec::new();
    let mut values = Vec::new();
    for dataset in &datasets {
        let made = compact(dataset, criterion).map_err(|error| anyhow!("{name}: {error}"))?;
        if made.functions.is_empty() {
            report!("note: {name}: nothing on cells or at single directions; closed forms and trees stay as they are");
        }
        if let Some(out) = &args.out {
            args.over.write(out, FileKind::Compact, &dataset_blob::encode(&made.dataset))?;
        }
        texts.push(to_text(dataset, criterion, &made.functions)?);
        values.push(to_json(dataset, args.by, criterion, &made.functions));
    }
    if args.json {
        let value = if values.len() == 1 { values.remove(0) } else { Value::Array(values) };
        output::print(&(serde_json::to_string_pretty(&value)? + "\n"))
    } else {
        output::print(&texts.join("\n"))
    }
}

fn to_json(dataset: &Dataset, by: By, criterion: Criterion, functions: &[CompactedFunction]) -> Value {
    let functions = functions.iter().map(|function| {
        let report = &function.report;
        let effects = function.effects.iter().map(|effect| {
            json!({
                "outside": effect.outside, "lid_misplaced_flux": effect.lid_misplaced,
                "illuminance_change_mean": effect.illuminance, "illuminance_change_max": effect.illuminance_worst,
                "illuminance_mean_lx": effect.mean_illuminance,
            })
        });
        json!({
            "function": function.name, "indicatrices": report.rows, "cells": report.cells,
            "values": report.rows * report.cells, "values_kept": report.numbers, "ratio_values": report.ratio(),
            "bytes_f32": 4 * report.rows * report.cells, "bytes_lossless": function.bytes_lossless,
            "bytes": function.bytes, "bytes_in_use": function.bytes_in_use, "ratio_bytes": function.byte_ratio(),
            "rms": report.rms, "rms_worst": report.rms_worst, "maximum": report.largest,
            "misplaced_flux": report.misplaced, "misplaced_flux_worst": report.misplaced_worst,
            "tau_error": report.tau_error, "negative_share_before_clamping": report.negative,
            "standard_room": effects.collect::<Vec<_>>(),
        })
    });
    let by = match by {
        By::Misplaced => "misplaced",
        By::Rms => "rms",
        By::Energy => "energy",
    };
    json!({
        "name": dataset.name, "state": dataset.state, "by": by, "threshold": criterion.threshold(),
        "criterion": criterion_words(criterion), "functions": functions.collect::<Vec<_>>(),
    })
}

fn to_text(dataset: &Dataset, criterion: Criterion, functions: &[CompactedFunction]) -> anyhow::Result<String> {
    let mut text = format!("{} {}\n", dataset.name, dataset.state).trim().to_owned() + "\n";
    writeln!(text, "{:<24}{} in every indicatrix", "Criterion", criterion_words(criterion))?;
    for function in functions {
        let r = &function.report;
        let percent = |share: f64| format!("{:.3} %", 100.0 * share);
        let kb = |bytes: usize| format!("{:.1} kB", bytes as f64 / 1000.0);
        writeln!(text, "\n{}", function.name.replace('_', " "))?;
        let mut line = |label: &str, value: String| writeln!(text, "  {label:<22}{value}");
        line("Indicatrices", format!("{} of {} cells", r.rows, r.cells))?;
        line("Ratio in values", format!("{:.1} ({} of {})", r.ratio(), r.numbers, r.rows * r.cells))?;
        line(
            "Ratio in bytes",
            format!(
                "{:.1} ({} instead of {} in f32; without loss {}; in memory {})",
                function.byte_ratio(),
                kb(function.bytes),
                kb(4 * r.rows * r.cells),
                kb(function.bytes_lossless),
                kb(function.bytes_in_use)
            ),
        )?;
        line("Rms", format!("{} (worst {})", percent(r.rms), percent(r.rms_worst)))?;
        line("Maximum", format!("{} of the peak", percent(r.largest)))?;
        line("Misplaced flux", format!("{} (worst {})", percent(r.misplaced), percent(r.misplaced_worst)))?;
        line("τ", format!("{:.1e} relative", r.tau_error))?;
        line("Negative, clamped", format!("{} of the cells", percent(r.negative)))?;
        if !function.effects.is_empty() {
            let (outside, lid, mean, most) = ("Standard room", "LID misplaced", "Σ|ΔE|/ΣE", "largest ΔE");
            writeln!(text, "  {outside:<26}{lid:>14}{mean:>12}{most:>12}{:>12}", "mean E")?;
        }
        for e in &function.effects {
            writeln!(
                text,
                "  {:<26}{:>14}{:>12}{:>12}{:>9.0} lx",
                e.outside,
                percent(e.lid_misplaced),
                percent(e.illuminance),
                percent(e.illuminance_worst),
                e.mean_illuminance
            )?;
        }
    }
    Ok(text)
}
