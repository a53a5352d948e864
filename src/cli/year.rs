//! `cfs year SCENE`: annual simulation of a room, hour by hour, and its annual figures.

use super::output::{number, print};
use super::progress::TerminalProgress;
use super::writing::Tables;
use super::year_json::to_json;
use crate::formats::FileKind;
use crate::study::fingerprint::of_results;
use crate::study::inputs::with_absolute_names;
use crate::study::year::{Kept, STORE_DELAY, Step, Year, figures, opening, scene_at, year, year_kept};
use crate::study::{Library, SceneFile, Session, StudyError, files, read_scene_file};
use crate::texts::csv_cell;
use anyhow::{Context as _, anyhow, bail};
use jiff::civil::{Date, DateTime};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Arguments of `cfs year`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs year year.toml --day 06-21              print the hours of one day
  cfs year year.toml --out hours.csv --json   write all hours, print metrics
  cfs year year.toml --scene-at 2005-06-21T12:30 --out hour.toml
                                                write one hour as a scene

The scene needs a table [year] that names the weather, as in examples/year.toml. Of [sky] only skyline and obstruction \
are used.

Columns (i counts sensor points or observers, N apertures, both from 1):
  time                   middle of the interval, local standard time
  sun_altitude_deg       solar altitude [°]
  sun_azimuth_deg        solar azimuth [°]
  direct_normal_lx       direct normal illuminance [lx]
  diffuse_horizontal_lx  diffuse horizontal illuminance [lx]
  state_N                state chosen by the shading control; empty when dark
  E_i, Ev_i              illuminance at sensor point and at observer i [lx]
  E_error_i, Ev_error_i  their estimated absolute errors [lx]
  S_i, Sv_i              part of E_i and Ev_i from direct sun [lx]; only if a
                         system may transmit it unscattered
  DGP_i, DGP_error_i     daylight glare probability of observer i, its error;
                         empty outside occupied hours and when dark
  lighting_W_m2          electric lighting [W/m²]; only with [year.lighting]
  solar_W                solar power transmitted directly [W], without
                         secondary heat; only with solar = true
  solar_error_W          its estimated absolute error [W]
  hunting                1 if the control would move to and fro (closed too
                         dark, open bright enough), else 0; only with
                         open_below in [control]

The date of a row keeps the year of the weather record. A run with --out that takes longer than 10 s saves its hours \
in FILE.part; if it is interrupted, the same command continues from there.")]
pub struct YearArgs {
    /// Scene file (.toml) with `[year]`
    pub scene: PathBuf,
    /// Write the table (with --scene-at: the scene) to a file instead of standard output
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Print the annual metrics with their uncertainties as JSON
    #[arg(long)]
    pub json: bool,
    /// Compute one day only, MM-DD or YYYY-MM-DD (the year is ignored)
    #[arg(long, value_name = "DATE", conflicts_with_all = ["month", "from", "to"])]
    pub day: Option<String>,
    /// Compute one month only, 1 to 12
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=12), conflicts_with_all = ["from", "to"])]
    pub month: Option<u8>,
    /// First day to compute, MM-DD (default: 01-01)
    #[arg(long, value_name = "DATE")]
    pub from: Option<String>,
    /// Last day to compute, MM-DD (default: 12-31)
    #[arg(long, value_name = "DATE")]
    pub to: Option<String>,
    /// Write the hour that contains this time, YYYY-MM-DDTHH:MM, as a scene with fixed states
    #[arg(long, value_name = "TIME", requires = "out", conflicts_with_all = ["json", "day", "month", "from", "to"])]
    pub scene_at: Option<String>,
}

/// Runs `cfs year`; errors name the file and the key.
pub fn run(args: &YearArgs, library: &Library) -> anyhow::Result<()> {
    let name = args.scene.display();
    let kind = if args.scene_at.is_some() { FileKind::Scene } else { FileKind::Csv };
    args.tables.check([&*args.scene], args.out.as_deref(), kind, !args.json)?;
    let file = read_scene_file(&args.scene)?;
    let base = files::folder(&args.scene);
    let located = |error: StudyError| anyhow!("{name}: {error}");
    let progress = TerminalProgress::new();
    if let (Some(time), Some(out)) = (&args.scene_at, &args.out) {
        let scene = scene_at(&file, base, library, moment(time)?, &progress).map_err(located)?;
        return write_scene(args, &scene, base, out);
    }
    let wanted = wanted(args)?;
    let session = Session::new();
    // No hours can be saved beside a stream.
    let table = args.out.as_deref().filter(|path| !files::is_stream(path));
    let kept = table.map(|path| kept(args, path, &file, base, library)).transpose().map_err(located)?;
    let year = match kept {
        None => year(&file, base, library, &session, &*wanted, &progress).map_err(located)?,
        Some(mut kept) => {
            if kept.count() > 0 {
                report!("{}: resumes after {} hours", files::absolute(kept.path()).display(), kept.count());
            }
            let year = match year_kept(&file, base, library, &session, &*wanted, &mut kept, &progress) {
                Ok(year) => year,
                // Hours that could not be saved can be once there is disk space; a refused year would be refused again.
                Err(StudyError::File { path, message }) if path == kept.path() => {
                    return Err(located(StudyError::File { path, message }));
                }
                Err(error) => {
                    kept.done()?;
                    return Err(located(error));
                }
            };
            args.tables.put(table, FileKind::Csv, &csv(&year))?;
            kept.done()?;
            year
        }
    };
    drop(progress);
    if table.is_none() && (args.out.is_some() || !args.json) {
        args.tables.put(args.out.as_deref(), FileKind::Csv, &csv(&year))?;
    }
    if args.json {
        let opening = opening(&file, &year.settings, &year.steps).map_err(located)?;
        print(&format!("{:#}\n", to_json(&year, &figures(&year), &opening)))?;
    }
    for note in &year.notes {
        report!("note: {note}");
    }
    let lit = year.chosen.len() - year.light.dark;
    report!(
        "{} steps, {lit} with light, computed with coefficients for {} sets of states",
        year.chosen.len(),
        year.light.sets
    );
    Ok(())
}

/// Opens the file of finished hours beside the table, which contains those of an interrupted run and to which this run
/// adds further ones.
fn kept(args: &YearArgs, table: &Path, file: &SceneFile, base: &Path, library: &Library) -> Result<Kept, StudyError> {
    Kept::beside(table, of_results(file, base, library)?, STORE_DELAY, args.tables.over.force)
}

/// Writes a scene file, with its relative paths changed so that they are valid from the folder of `out`.
fn write_scene(args: &YearArgs, scene: &SceneFile, base: &Path, out: &Path) -> anyhow::Result<()> {
    // The place of a scene that is written to a stream is unknown.
    let beside = !files::is_stream(out) && files::absolute(files::folder(out)) == files::absolute(base);
    let scene = if beside { scene.clone() } else { with_absolute_names(scene, base) };
    let text = toml::to_string(&scene).context("the scene")?;
    args.tables.put(Some(out), FileKind::Scene, &text)
}

/// Parses the time of `--scene-at`.
fn moment(text: &str) -> anyhow::Result<DateTime> {
    text.parse().map_err(|_| anyhow!("--scene-at {text}: no time; expected YYYY-MM-DDTHH:MM"))
}

/// Parses the date of an option, `MM-DD` or `YYYY-MM-DD`. Returns the year, if it is given, and month and day.
fn day(option: &str, text: &str) -> anyhow::Result<(Option<i16>, (i8, i8))> {
    if let Ok(date) = text.parse::<Date>() {
        return Ok((Some(date.year()), (date.month(), date.day())));
    }
    // A leap year has every day that any year has.
    let date = format!("2024-{text}").parse::<Date>();
    let date = date.map_err(|_| anyhow!("{option} {text}: no day; expected YYYY-MM-DD or MM-DD"))?;
    Ok((None, (date.month(), date.day())))
}

/// Function that returns whether a time step is requested by the options.
type Wanted = Box<dyn Fn(&Step) -> bool>;

fn wanted(args: &YearArgs) -> anyhow::Result<Wanted> {
    let of = |step: &Step| (step.time.month(), step.time.day());
    if let Some(text) = &args.day {
        // Rows of a typical year come from different years, so only month and day count.
        let (_, wanted) = day("--day", text)?;
        return Ok(Box::new(move |step| of(step) == wanted));
    }
    if let Some(month) = args.month {
        return Ok(Box::new(move |step| step.month == month));
    }
    let from = args.from.as_ref().map_or(Ok((1, 1)), |text| day("--from", text).map(|(_, day)| day))?;
    let to = args.to.as_ref().map_or(Ok((12, 31)), |text| day("--to", text).map(|(_, day)| day))?;
    if from > to {
        bail!("--from {}-{} is after --to {}-{}; expected days of one calendar year", from.0, from.1, to.0, to.1);
    }
    Ok(Box::new(move |step| (from..=to).contains(&of(step))))
}

/// Returns the CSV table of an annual simulation, one row per time step.
fn csv(year: &Year) -> String {
    let (sensors, places) = (year.settings.sensors, year.light.places);
    let mut text = String::from("time,sun_altitude_deg,sun_azimuth_deg,direct_normal_lx,diffuse_horizontal_lx");
    // Writing to a String cannot fail.
    for one in &year.moving {
        let _ = write!(text, ",state_{}", one.aperture);
    }
    let sun = year.light.sun.as_ref();
    for (desk, eye) in
        [Some(("E", "Ev")), Some(("E_error", "Ev_error")), sun.map(|_| ("S", "Sv"))].into_iter().flatten()
    {
        for i in 0..places {
            let _ = if i < sensors {
                write!(text, ",{desk}_{}", i + 1)
            } else {
                write!(text, ",{eye}_{}", i + 1 - sensors)
            };
        }
    }
    let dgp = year.dgp.as_ref();
    for word in ["DGP", "DGP_error"] {
        for i in 0..dgp.map_or(0, |dgp| dgp.eyes) {
            let _ = write!(text, ",{word}_{}", i + 1);
        }
    }
    let lamps = year.settings.lamps.as_ref();
    text.push_str(if lamps.is_some() { ",lighting_W_m2" } else { "" });
    text.push_str(if year.solar.is_some() { ",solar_W,solar_error_W" } else { "" });
    text.push_str(if year.indoor.is_some() { ",hunting\n" } else { "\n" });
    for (row, &k) in year.chosen.iter().enumerate() {
        let (step, hour) = (&year.steps.list[k], &year.steps.list[k].hour);
        let _ = write!(
            text,
            "{},{:.4},{:.4},{},{}",
            step.time.strftime("%Y-%m-%dT%H:%M:%S"),
            hour.sun.altitude().to_degrees(),
            hour.sun.bearing().degrees(),
            number(hour.direct_normal),
            number(hour.diffuse_horizontal)
        );
        for (one, &state) in year.moving.iter().zip(&year.states[k]) {
            let _ = write!(text, ",{}", if hour.is_lit() { csv_cell(&one.device.keys[state]) } else { String::new() });
        }
        let tables = [Some(&year.light.values), Some(&year.light.errors), sun];
        for value in tables.into_iter().flatten().flat_map(|table| table.row(row)) {
            // All digits that a number of single precision has.
            let _ = write!(text, ",{value}");
        }
        if let Some(dgp) = dgp {
            // Empty outside occupied hours and when dark.
            let field = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.5}"));
            for one in dgp.row(row) {
                let _ = write!(text, ",{}", field(one.map(|one| one.value)));
            }
            for one in dgp.row(row) {
                let _ = write!(text, ",{}", field(one.map(|one| one.error)));
            }
        }
        if let Some(lamps) = lamps {
            let watts = lamps.watts(step.occupied, &year.light.values.row(row)[..sensors]);
            let _ = write!(text, ",{}", number(watts));
        }
        if let Some(solar) = &year.solar {
            let _ = write!(text, ",{},{}", number(solar.watts[row]), number(solar.errors[row]));
        }
        if let Some(indoor) = &year.indoor {
            text.push_str(if indoor.hunting.binary_search(&k).is_ok() { ",1" } else { ",0" });
        }
        text.push('\n');
    }
    text
}
