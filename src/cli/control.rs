//! `cfs control SCENE`: states that shading controls choose over a year, as a table for other programs.

use super::output::print;
use super::progress::TerminalProgress;
use super::writing::Tables;
use crate::formats::FileKind;
use crate::study::control::year::{Moment, Moving, Situation, Summary, moving, summary, year};
use crate::study::{Library, SystemLibrary as _, files, read_scene_file};
use crate::texts::csv_cell;
use anyhow::anyhow;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Arguments of `cfs control`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs control blind.toml --out states.csv   write the states of every hour
  cfs control blind.toml --step 15 --json   print a summary, steps of 15 min

Columns (the last five for each aperture N under shading control, from 1):
  time                 middle of the step, local standard time
  sun_altitude_deg     solar altitude [°]
  sun_azimuth_deg      solar azimuth [°]
  profile_angle_deg_N  profile angle of the sun [°]; empty while no part of
                       the solar disc is in front of the aperture
  demanded_N           value that the control demands, in the unit of the
                       states
  state_N              key of the chosen state
  direct_sun_N         1 if direct sun passes between the slats, else 0; empty
                       if the slats are not known
  reason_N             sun, no-sun, night, bright, dark, schedule or fixed

The sun is assumed to shine from a clear sky whenever it is up. A skyline hides it; obstructions ([[outside]]) do \
not. A summary is printed on standard error. For a weather year and illuminances in the room see cfs year.")]
pub struct ControlArgs {
    /// Scene file (.toml) with a controlled aperture
    pub scene: PathBuf,
    /// Length of a step in minutes, a divisor of 1440
    #[arg(long, value_name = "MINUTES", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=1440))]
    pub step: u32,
    /// Write the table to a CSV file instead of standard output
    #[arg(long, value_name = "FILE.csv")]
    pub out: Option<PathBuf>,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Print a summary as JSON: hours per state, hours of sun, movements
    #[arg(long)]
    pub json: bool,
}

/// Runs `cfs control`; errors name the file and the key.
pub fn run(args: &ControlArgs, library: &Library) -> anyhow::Result<()> {
    let name = args.scene.display();
    args.tables.check([&*args.scene], args.out.as_deref(), FileKind::Csv, !args.json)?;
    let file = read_scene_file(&args.scene)?;
    let base = files::folder(&args.scene);
    let located = |error: crate::study::StudyError| anyhow!("{name}: {error}");
    let list = moving(&file, base, &|keys| library.device(keys, base)).map_err(located)?;
    let situation = Situation::of(&file).map_err(located)?;
    let progress = TerminalProgress::new();
    let moments = year(&situation, base, &list, args.step, &situation.sky, &progress).map_err(located)?;
    drop(progress);
    if args.out.is_some() || !args.json {
        args.tables.put(args.out.as_deref(), FileKind::Csv, &csv(&list, &moments))?;
    }
    let sums: Vec<Summary> =
        (0..list.len()).map(|k| summary(&moments, k, list[k].device.keys.len(), args.step)).collect();
    if args.json {
        print(&format!("{:#}\n", json(&list, &sums, &situation, args.step)))?;
    }
    for (one, sum) in list.iter().zip(&sums) {
        let direct = match sum.direct_hours {
            Some(hours) => format!("direct sun through it for {hours:.1} h"),
            None => "its slats are not known: direct sun through it is not reported".to_owned(),
        };
        report!(
            "aperture {}: {} ({}), {} state changes, sun on it for {:.1} h, {direct}",
            one.aperture,
            one.device.name,
            one.keys.mode.word(),
            sum.movements,
            sum.sun_hours
        );
        if one.keys.open_below.is_some() && one.keys.indoor.is_none() {
            report!(
                "aperture {}: open_below has no effect: no indoor illuminance is computed here; `cfs year` does",
                one.aperture
            );
        }
    }
    Ok(())
}

fn csv(list: &[Moving], moments: &[Moment]) -> String {
    let mut text = String::from("time,sun_altitude_deg,sun_azimuth_deg");
    // Writing to a String cannot fail.
    for one in list {
        let n = one.aperture;
        let _ = write!(text, ",profile_angle_deg_{n},demanded_{n},state_{n},direct_sun_{n},reason_{n}");
    }
    text.push('\n');
    let number = |value: Option<f64>| value.map(|value| format!("{:.4}", value + 0.0)).unwrap_or_default();
    for moment in moments {
        let altitude = moment.altitude.to_degrees();
        let _ =
            write!(text, "{},{altitude:.4},{:.4}", moment.time.strftime("%Y-%m-%dT%H:%M:%S"), moment.bearing.degrees());
        for (one, setting) in list.iter().zip(&moment.settings) {
            let psi = number(setting.profile_angle.map(f64::to_degrees));
            let passes = setting.passes.map_or("", |passes| if passes { "1" } else { "0" });
            let key = csv_cell(&one.device.keys[setting.state]);
            let _ = write!(text, ",{psi},{},{key},{passes},{}", number(setting.demanded), setting.reason.word());
        }
        text.push('\n');
    }
    text
}

fn json(list: &[Moving], sums: &[Summary], situation: &Situation, step: u32) -> serde_json::Value {
    let apertures: Vec<_> = list
        .iter()
        .zip(sums)
        .map(|(one, sum)| {
            let states: serde_json::Map<String, serde_json::Value> =
                one.device.keys.iter().cloned().zip(sum.state_hours.iter().map(|h| serde_json::json!(h))).collect();
            serde_json::json!({
                "aperture": one.aperture,
                "product": one.device.name,
                "mode": one.keys.mode.word(),
                "movements": sum.movements,
                "sun_hours": sum.sun_hours,
                "direct_sun_hours": sum.direct_hours,
                "daylight_hours_by_state": states,
            })
        })
        .collect();
    serde_json::json!({
        "year": situation.year,
        "step_minutes": step,
        "light": "clear sky at all hours",
        "apertures": apertures,
    })
}
