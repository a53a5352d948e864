//! `cfs accuracy`: error against run time of a scene, by method and effort.

use super::output::{number, print};
use super::progress::TerminalProgress;
use crate::compute::incidence::schemes::SunScheme;
use crate::drawing::chart;
use crate::study::accuracy::{Accuracy, Coverage, Quantity, Rung, Series, ladder};
use crate::study::accuracy_plot::{name, plots};
use crate::study::leaving_out::LeavingOut;
use crate::study::{files, load_scene, system::SystemLibrary};
use anyhow::Context as _;
use serde_json::json;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Error against run time of a scene, by method and effort
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  cfs accuracy office.toml                                   table on standard output
  cfs accuracy office.toml --csv ladder.csv --plot ladder.svg

Every method computes the scene with rising effort; the ordinary one by error targets, which a scene asks for by
compute.error_target. Methods that a scene chooses by compute.near_field are compared by their direct component. The
reference is the ordinary method with more effort than any line of the table; how far it lies from the second finest is
stated. Errors are relative, over sensors above 1 % of the mean. Times are seconds of one thread: set-up once for a room,
then each new sky, each new position of the sun.

Of data at single incident directions the reference interpolates as well. What that is worth is told beneath: every
direction is left out and foretold from those around it, by responses and by the report's three schemes
(compute.sun_interpolation); --json lists all directions and where another scheme would have been better.

Columns of the CSV: method, quantity, setting, setup_s, sky_s, sun_s, stated_max, true_rms, true_max, sensors,
share_stated_ge_true, share_stated_le_10_true.")]
pub struct AccuracyArgs {
    /// Scene file (TOML)
    pub scene: PathBuf,
    /// CSV file to write
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Picture to write: time against true error, stated against true error
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    pub plot: Option<PathBuf>,
    /// Results for programs, on standard output
    #[arg(long)]
    pub json: bool,
}

/// Size of the picture. \[px\]
const SIZE: [u32; 2] = [1280, 560];

/// Runs the command.
pub fn run(args: &AccuracyArgs, library: &dyn SystemLibrary) -> anyhow::Result<()> {
    // Before the work, so that a wrong name costs no minute.
    let picture = args.plot.as_deref().map(|path| Ok::<_, anyhow::Error>((path, is_png(path)?))).transpose()?;
    let scene = load_scene(&args.scene, library)?;
    let accuracy = ladder(&scene, &TerminalProgress::new()).with_context(|| args.scene.display().to_string())?;
    if let Some(path) = &args.csv {
        files::write(path, csv(&accuracy).as_bytes())?;
    }
    if let Some((path, png)) = picture {
        let drawing = chart::draw(&plots(&accuracy), SIZE);
        let bytes = if png { drawing.to_png()? } else { drawing.to_svg().into_bytes() };
        files::write(path, &bytes)?;
    }
    if args.json { print(&format!("{:#}\n", to_json(&accuracy))) } else { print(&table(&accuracy)) }
}

fn is_png(path: &Path) -> anyhow::Result<bool> {
    match path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("png") => Ok(true),
        Some("svg") => Ok(false),
        _ => anyhow::bail!("{}: --plot writes .svg or .png, by the name's ending", path.display()),
    }
}

fn quantity(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Direct => "direct",
        Quantity::Total => "total",
    }
}

/// Every rung with its series.
fn rows(accuracy: &Accuracy) -> impl Iterator<Item = (&Series, &Rung)> {
    accuracy.series.iter().flat_map(|series| series.rungs.iter().map(move |rung| (series, rung)))
}

fn csv(accuracy: &Accuracy) -> String {
    let mut text = String::from(
        "method,quantity,setting,setup_s,sky_s,sun_s,stated_max,true_rms,true_max,sensors,share_stated_ge_true,\
         share_stated_le_10_true\n",
    );
    for (series, rung) in rows(accuracy) {
        let coverage = rung.coverage();
        let cells = [
            series.method.to_owned(),
            quantity(series.quantity).to_owned(),
            format!("\"{}\"", rung.setting),
            number(rung.setup),
            number(rung.sky),
            rung.sun.map_or_else(String::new, number),
            number(rung.reached()),
            number(rung.rms()),
            number(rung.max()),
            coverage.count.to_string(),
            number(coverage.kept),
            number(coverage.tight),
        ];
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

/// Seconds in a unit that leaves three digits.
fn time(seconds: f64) -> String {
    let (scale, unit) = match seconds {
        s if s < 1e-3 => (1e6, "µs"),
        s if s < 1.0 => (1e3, "ms"),
        _ => (1.0, "s"),
    };
    format!("{:.*} {unit}", if seconds * scale < 10.0 { 2 } else { 1 }, seconds * scale)
}

/// A relative error in per cent, two digits.
fn error(relative: f64) -> String {
    let percent = 100.0 * relative;
    if percent == 0.0 || percent >= 1e-3 { format!("{percent:.3} %") } else { format!("{percent:.0e} %") }
}

fn table(accuracy: &Accuracy) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    for series in &accuracy.series {
        let _ = writeln!(text, "{} ({} illuminance)", name(series), quantity(series.quantity));
        let _ = writeln!(
            text,
            "  {:<56} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10} {:>7} {:>7}",
            "effort", "set-up", "sky", "sun", "stated max", "true RMS", "true max", "≥ true", "≤ 10×"
        );
        for rung in &series.rungs {
            let coverage = rung.coverage();
            let _ = writeln!(
                text,
                "  {:<56} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10} {:>5.1} % {:>5.1} %",
                rung.setting,
                time(rung.setup),
                time(rung.sky),
                rung.sun.map_or_else(|| String::from("-"), time),
                error(rung.reached()),
                error(rung.rms()),
                error(rung.max()),
                100.0 * coverage.kept,
                100.0 * coverage.tight,
            );
        }
        text.push('\n');
    }
    for reference in &accuracy.references {
        let _ = writeln!(
            text,
            "Reference of the {} illuminance: error target {}, states {}; from the second finest it lies {} RMS, {} at most.",
            quantity(reference.quantity),
            error(reference.target),
            error(reference.stated),
            error(reference.rms),
            error(reference.max),
        );
    }
    let Coverage { count, kept, tight, tight_or_small } = accuracy.ordinary_coverage();
    let _ = writeln!(
        text,
        "Ordinary method, {count} stated errors: {:.1} % are at least the true error, {:.1} % at most ten times it \
         ({:.1} % with those below 0.01 % of the illuminance).",
        100.0 * kept,
        100.0 * tight,
        100.0 * tight_or_small
    );
    for series in accuracy.series.iter().filter(|series| series.rungs.iter().all(|rung| rung.target.is_some())) {
        let reached: Vec<String> = series
            .rungs
            .iter()
            .filter_map(|rung| Some(format!("{} of {}", error(rung.reached()), error(rung.target?))))
            .collect();
        let _ = writeln!(text, "Reached, {} illuminance: {}.", quantity(series.quantity), reached.join(", "));
    }
    accuracy.leaving_out.iter().for_each(|one| text.extend([&*one.sentences(), "\n"]));
    let (computed, all) = accuracy.sensors;
    let _ = writeln!(text, "{computed} of {all} sensors, times of {} thread(s).", accuracy.threads);
    text
}

/// By direction what every scheme misplaces, and which would have been better than responses.
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
    let coverage = |c: Coverage| {
        json!({
            "sensors": c.count, "stated_ge_true": c.kept, "stated_le_10_true": c.tight,
            "stated_le_10_true_or_1e-4": c.tight_or_small,
        })
    };
    json!({
        "references": accuracy.references.iter().map(|r| json!({
            "quantity": quantity(r.quantity), "error_target": r.target, "stated": r.stated,
            "rms_from_second": r.rms, "max_from_second": r.max,
        })).collect::<Vec<_>>(),
        "series": accuracy.series.iter().map(|series| json!({
            "method": series.method,
            "quantity": quantity(series.quantity),
            "rungs": series.rungs.iter().map(|rung| json!({
                "setting": rung.setting, "error_target": rung.target, "setup_s": rung.setup, "sky_s": rung.sky, "sun_s": rung.sun,
                "reached": rung.reached(), "true_rms": rung.rms(), "true_max": rung.max(),
                "coverage": coverage(rung.coverage()),
            })).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "coverage": coverage(accuracy.ordinary_coverage()),
        "leaving_out": accuracy.leaving_out.iter().map(left_out).collect::<Vec<_>>(),
        "sensors_computed": accuracy.sensors.0,
        "sensors": accuracy.sensors.1,
        "threads": accuracy.threads,
    })
}
