//! `cfs accuracy`: error against computing time for a scene, by method and effort.

use super::output::{number, print};
use super::progress::TerminalProgress;
use super::rank::asked;
use super::writing::{StreamFormat, Tables};
use super::{accuracy_rank, accuracy_year};
use crate::compute::incidence::schemes::SunScheme;
use crate::drawing::chart;
use crate::formats::FileKind;
use crate::study::accuracy::annual::annual;
use crate::study::accuracy::ranking::ranking;
use crate::study::accuracy::words::{self, percent, quantity};
use crate::study::accuracy::{Accuracy, Coverage, Origin, Reference, Rung, Series, Truth, ladder_against};
use crate::study::accuracy_plot::{name, plots};
use crate::study::leaving_out::LeavingOut;
use crate::study::{Library, files, load_scene, read_scene_file};
use anyhow::Context as _;
use serde_json::json;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `cfs accuracy`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs accuracy office.toml --csv accuracy.csv --plot accuracy.svg
                                      test all methods on a scene
  cfs accuracy office.toml --reference office.csv
                                      compare with a table of cfs room
  cfs accuracy rank.toml --rank       test a ranking

Every method computes the scene with rising effort. The effort of the default method is set by error targets \
(compute.error_target); the other methods of compute.near_field are compared by the direct component alone. At most \
256 sensor points are used.

Without --reference, the errors are numerical: differences from a run of the default method with more effort than \
any row of the table. A row that this run hardly refines has a remark instead of errors. With --reference, they are \
differences from a file with the columns x,y,z,E_lx and optionally nx,ny,nz, E_direct_lx and E_error_lx, its rows in \
the order of the scene's sensor points. With --year and --rank, they are differences from the run with the most \
effort.

Except those of scores, errors are relative; values below 1 % of the mean are excluded. In the printed table, held \
is share_held and > 10× is share_padded_10 of the list below. Without --year and --rank, times are those of one \
thread.

For data at single incident directions, every direction is also left out and predicted from its neighbours, by all \
schemes of compute.sun_interpolation. --json lists all directions.

Columns of --csv:
  method           method; room: default method with interreflection
  quantity         direct or total illuminance
  against          finest run, or name of the reference file
  setting          effort
  setup_s          set-up time, once for a room [s]
  sky_s            time for each new sky [s]
  sun_s            time for each new position of the sun [s]
  stated_max       largest uncertainty, relative
  error_rms        root mean square error, relative
  error_max        largest error, relative
  sensors          number of sensor points
  share_held       share of them with uncertainty ≥ error
  share_padded_10  share of them with uncertainty > 10 × error
  data_open        uncertainty due to the data, relative
  remark           reason why errors are not given

Columns of --csv with --year:
  setting          effort
  seconds          run time [s]
  stated_mean      mean uncertainty of the illuminances, relative
  error_rms        root mean square error, relative
  error_max        largest error, relative
  values           number of hours × places that are not dark
  share_held, share_padded_10
                   as above, of the values
  FIGURE           value of an annual figure, followed by
  FIGURE_stated    its uncertainty
  FIGURE_off       its difference from the year with the most effort

Columns of --csv with --rank:
  setting          effort
  seconds          run time [s]
  stated_mean      mean uncertainty of the scores
  error_rms        root mean square error of the scores (0 to 1)
  error_max        largest error of the scores
  products         number of products
  share_held, share_padded_10
                   as above, of the products
  pairs            number of pairs of products
  pairs_apart      pairs that the ranking with the most effort separates by
                   more than twice its uncertainty
  pairs_told       of these, pairs that are separated in the same order
  pairs_reversed   of these, pairs that are separated in reverse order")]
pub struct AccuracyArgs {
    /// Scene file (.toml)
    pub scene: PathBuf,
    /// Compare with the illuminances of this file, which has the columns of `cfs room`
    #[arg(long, value_name = "FILE.csv")]
    pub reference: Option<PathBuf>,
    /// Write the table to a CSV file, too
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Draw run time against error, and uncertainty against error, to a picture file
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub plot: Option<PathBuf>,
    /// Option for the format of a picture written to a stream, whose name has no extension.
    #[command(flatten)]
    pub stream: StreamFormat,
    /// Test the annual simulation of `[year]` instead: its hourly illuminances and its annual figures
    #[arg(long, conflicts_with_all = ["reference", "plot"])]
    pub year: bool,
    /// Test the ranking of `[rank]` instead: its scores, and which products it distinguishes
    #[arg(long, conflicts_with_all = ["reference", "plot", "year"])]
    pub rank: bool,
    /// Rank the products found by these search words instead of those of rank.products; requires --rank
    #[arg(long, value_name = "WORDS", requires = "rank")]
    pub products: Option<String>,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Print the results as JSON
    #[arg(long)]
    pub json: bool,
}

/// Width and height of the picture. \[px\]
const SIZE: [f64; 2] = [1280.0, 560.0];

/// Runs `cfs accuracy`.
pub fn run(args: &AccuracyArgs, library: &Library) -> anyhow::Result<()> {
    if args.year {
        return of_year(args, library);
    }
    if args.rank {
        return of_rank(args, library);
    }
    // Before the work, so that a wrong name costs no minute.
    let picture = args
        .plot
        .as_deref()
        .map(|path| Ok::<_, anyhow::Error>((path, is_png(&args.stream.name(path)?)?)))
        .transpose()?;
    let picture = picture.map(|(path, png)| (path, if png { FileKind::Png } else { FileKind::Svg }));
    let from = [Some(&*args.scene), args.reference.as_deref()];
    args.tables.check(from.into_iter().flatten(), args.csv.as_deref(), FileKind::Csv, false)?;
    if let Some((path, kind)) = picture {
        args.tables.over.check([], Some(path), kind)?;
    }
    let scene = load_scene(&args.scene, library)?;
    let truth = args.reference.as_deref().map(|path| Truth::read(path, &scene)).transpose()?;
    let accuracy = ladder_against(&scene, truth.as_ref(), &TerminalProgress::new())
        .with_context(|| args.scene.display().to_string())?;
    let mut made = Vec::new();
    if let Some(path) = args.csv.as_deref() {
        made.push((path, FileKind::Csv, args.tables.bytes(&csv(&accuracy)?)));
    }
    if let Some((path, kind)) = picture {
        let drawing = chart::draw(&plots(&accuracy), SIZE);
        let bytes = if kind == FileKind::Png { drawing.to_png()? } else { drawing.to_svg().into_bytes() };
        made.push((path, kind, bytes));
    }
    let outputs: Vec<(&Path, FileKind, &[u8])> =
        made.iter().map(|(path, kind, bytes)| (*path, *kind, &**bytes)).collect();
    args.tables.over.write_all(&outputs)?;
    if args.json { print(&format!("{:#}\n", to_json(&accuracy))) } else { print(&table(&accuracy)) }
}

/// Tests the ranking of the scene (`--rank`), and writes or prints the result.
fn of_rank(args: &AccuracyArgs, library: &Library) -> anyhow::Result<()> {
    args.tables.check([&*args.scene], args.csv.as_deref(), FileKind::Csv, false)?;
    let groups = asked(std::slice::from_ref(&args.scene), args.products.as_deref(), library)?;
    let accuracy =
        ranking(&groups, library, &TerminalProgress::new()).with_context(|| args.scene.display().to_string())?;
    if let Some(path) = args.csv.as_deref() {
        args.tables.put(Some(path), FileKind::Csv, &accuracy_rank::csv(&accuracy)?)?;
    }
    accuracy_rank::print_accuracy(&accuracy, args.json)
}

/// Tests the annual simulation of the scene (`--year`), and writes or prints the result.
fn of_year(args: &AccuracyArgs, library: &Library) -> anyhow::Result<()> {
    args.tables.check([&*args.scene], args.csv.as_deref(), FileKind::Csv, false)?;
    let file = read_scene_file(&args.scene)?;
    let base = files::folder(&args.scene);
    let accuracy = annual(&file, base, library, &|_| true, &TerminalProgress::new())
        .with_context(|| args.scene.display().to_string())?;
    if let Some(path) = args.csv.as_deref() {
        args.tables.put(Some(path), FileKind::Csv, &accuracy_year::csv(&accuracy)?)?;
    }
    accuracy_year::print_accuracy(&accuracy, args.json)
}

fn is_png(path: &Path) -> anyhow::Result<bool> {
    match path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("png") => Ok(true),
        Some("svg") => Ok(false),
        _ => anyhow::bail!("{}: --plot writes .svg or .png, by the name's ending", path.display()),
    }
}

/// Returns every row of the table: a run with its series, and the reason why its errors are not stated, if there is
/// one.
fn rows(accuracy: &Accuracy) -> impl Iterator<Item = (&Series, &Rung, Option<String>)> {
    accuracy.series.iter().flat_map(|series| {
        let reference = accuracy.reference(series.quantity);
        series
            .rungs
            .iter()
            .map(move |rung| (series, rung, reference.and_then(|one| words::undetermined_reason(rung, one))))
    })
}

/// Returns the origin of the reference values as text: the name of the file, or the finest run.
fn against(reference: Option<&Reference>) -> &str {
    match reference.map(|reference| &reference.origin) {
        Some(Origin::Given(name)) => name,
        _ => "finest run",
    }
}

fn csv(accuracy: &Accuracy) -> anyhow::Result<String> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "method",
        "quantity",
        "against",
        "setting",
        "setup_s",
        "sky_s",
        "sun_s",
        "stated_max",
        "error_rms",
        "error_max",
        "sensors",
        "share_held",
        "share_padded_10",
        "data_open",
        "remark",
    ])?;
    for (series, rung, remark) in rows(accuracy) {
        let coverage = rung.coverage();
        // Errors that the reference cannot give stay empty.
        let reported = |value: f64| if remark.is_none() { number(value) } else { String::new() };
        writer.write_record([
            series.method.to_owned(),
            quantity(series.quantity).to_owned(),
            against(accuracy.reference(series.quantity)).to_owned(),
            rung.setting.clone(),
            number(rung.setup),
            number(rung.sky),
            rung.sun.map_or_else(String::new, number),
            number(rung.reached()),
            reported(rung.rms()),
            reported(rung.max()),
            coverage.count.to_string(),
            reported(coverage.kept),
            reported(coverage.padded),
            number(rung.data),
            remark.clone().unwrap_or_default(),
        ])?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Formats a time, given in seconds, in µs, ms or s, with three digits up to 100 of the unit.
fn time(seconds: f64) -> String {
    let (scale, unit) = match seconds {
        s if s < 1e-3 => (1e6, "µs"),
        s if s < 1.0 => (1e3, "ms"),
        _ => (1.0, "s"),
    };
    format!("{:.*} {unit}", if seconds * scale < 10.0 { 2 } else { 1 }, seconds * scale)
}

fn table(accuracy: &Accuracy) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    for series in &accuracy.series {
        let reference = accuracy.reference(series.quantity);
        let kind = reference.map_or_else(String::new, words::kind);
        let word = if accuracy.is_true(series.quantity) { "true" } else { "error" };
        let _ = writeln!(text, "{} ({} illuminance): {kind}", name(series), quantity(series.quantity));
        let _ = writeln!(
            text,
            "  {:<56} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10} {:>7} {:>7}",
            "effort",
            "set-up",
            "sky",
            "sun",
            "stated max",
            format!("{word} RMS"),
            format!("{word} max"),
            "held",
            "> 10×"
        );
        for rung in &series.rungs {
            let _ = write!(
                text,
                "  {:<56} {:>9} {:>9} {:>9} {:>10} ",
                rung.setting,
                time(rung.setup),
                time(rung.sky),
                rung.sun.map_or_else(|| String::from("-"), time),
                percent(rung.reached()),
            );
            let coverage = rung.coverage();
            let _ = match reference.and_then(|one| words::undetermined_reason(rung, one)) {
                Some(remark) => writeln!(text, "{remark}"),
                None => writeln!(
                    text,
                    "{:>10} {:>10} {:>5.1} % {:>5.1} %",
                    percent(rung.rms()),
                    percent(rung.max()),
                    100.0 * coverage.kept,
                    100.0 * coverage.padded
                ),
            };
        }
        text.push('\n');
    }
    for reference in &accuracy.references {
        let _ = writeln!(text, "{}", words::reference(reference));
    }
    let Coverage { count, kept, padded, padded_visibly } = accuracy.ordinary_coverage();
    let _ = if count == 0 {
        writeln!(text, "Default method: this reference gives no errors of it.")
    } else {
        writeln!(
            text,
            "Default method, {count} stated errors: {:.1} % are at least the error found, {:.1} % more than ten times it \
             ({:.1} % without those below 0.01 % of the illuminance).",
            100.0 * kept,
            100.0 * padded,
            100.0 * padded_visibly
        )
    };
    for series in accuracy.series.iter().filter(|series| series.is_ordinary()) {
        let reached: Vec<String> = series
            .rungs
            .iter()
            .filter_map(|rung| Some(format!("{} of {}", percent(rung.reached()), percent(rung.target?))))
            .collect();
        let _ = writeln!(text, "Reached, {} illuminance: {}.", quantity(series.quantity), reached.join(", "));
        if let Some(limit) = words::data_limit(series) {
            let _ = writeln!(text, "Data, {} illuminance: {limit}.", quantity(series.quantity));
        }
    }
    accuracy.leaving_out.iter().for_each(|one| text.extend([&*one.sentences(), "\n"]));
    let (computed, all) = accuracy.sensors;
    let _ = writeln!(text, "{computed} of {all} sensors, times of {} thread(s).", accuracy.threads);
    text
}

/// Returns the prediction errors of one system as JSON: for each direction left out, the share of the flux that every
/// interpolation scheme misplaces, and the scheme that would have been better than `responses`, if any.
fn left_out(one: &LeavingOut) -> serde_json::Value {
    let by_scheme = |error: &dyn Fn(SunScheme) -> f64| -> serde_json::Map<String, serde_json::Value> {
        SunScheme::ALL.into_iter().map(|scheme| (scheme.key().to_owned(), json!(error(scheme)))).collect()
    };
    let directions = one.left_out.directions().map(|direction| {
        json!({
            "theta_deg": direction.direction.theta().to_degrees(), "phi_deg": direction.direction.phi().to_degrees(),
            "misplaced": by_scheme(&|scheme| direction.error(scheme)),
            "better": direction.better().map(|(scheme, gain)| json!({ "scheme": scheme.key(), "by": gain })),
        })
    });
    json!({
        "system": one.label, "mean_misplaced": by_scheme(&|scheme| one.left_out.mean(scheme)),
        "stated_for_sun": one.sun, "directions": directions.collect::<Vec<_>>(),
    })
}

fn to_json(accuracy: &Accuracy) -> serde_json::Value {
    let coverage = |c: Coverage| json!({ "sensors": c.count, "held": c.kept, "padded_10": c.padded, "padded_10_above_1e-4": c.padded_visibly });
    let reference = |r: &Reference| {
        let (target, rms, max) = match r.origin {
            Origin::FinestRun { target, rms, max } => (Some(target), Some(rms), Some(max)),
            Origin::Given(_) => (None, None, None),
        };
        json!({
            "quantity": quantity(r.quantity), "against": against(Some(r)), "errors": words::kind(r),
            "error_target": target, "stated": r.stated, "rms_from_second": rms, "max_from_second": max,
        })
    };
    let rung = |rung: &Rung, one: Option<&Reference>| {
        let remark = one.and_then(|one| words::undetermined_reason(rung, one));
        let reported = |value: f64| remark.is_none().then_some(value);
        json!({
            "setting": rung.setting, "error_target": rung.target, "setup_s": rung.setup, "sky_s": rung.sky,
            "sun_s": rung.sun, "reached": rung.reached(), "error_rms": reported(rung.rms()), "error_max": reported(rung.max()),
            "coverage": remark.is_none().then(|| coverage(rung.coverage())), "remark": remark,
            "numerical": rung.numerical, "data_open": rung.data, "limited_by_data": rung.is_limited_by_data(),
        })
    };
    json!({
        "references": accuracy.references.iter().map(reference).collect::<Vec<_>>(),
        "series": accuracy.series.iter().map(|series| {
            let one = accuracy.reference(series.quantity);
            json!({
                "method": series.method,
                "quantity": quantity(series.quantity),
                "against": against(one),
                "errors": one.map(words::kind),
                "rungs": series.rungs.iter().map(|r| rung(r, one)).collect::<Vec<_>>(),
                "data_limit": words::data_limit(series),
            })
        }).collect::<Vec<_>>(),
        "coverage": coverage(accuracy.ordinary_coverage()),
        "leaving_out": accuracy.leaving_out.iter().map(left_out).collect::<Vec<_>>(),
        "sensors_computed": accuracy.sensors.0,
        "sensors": accuracy.sensors.1,
        "threads": accuracy.threads,
    })
}
