//! `cfs sky SCENE`: luminances of the 145 Tregenza patches, horizontal and façade illuminances.

use crate::cli::output::print;
use crate::cli::weather_info::{hour_json, weather_notes};
use crate::cli::writing::Tables;
use crate::compute::estimate::Silent;
use crate::compute::sky::mean_luminance;
use crate::compute::sky::patches::tregenza_patches;
use crate::compute::sky::{Outside, Sun};
use crate::formats::FileKind;
use crate::study::facade::{FacadeLight, facade_light};
use crate::study::files;
use crate::study::sky::{hour_of_weather, illuminances, outside_from_keys};
use anyhow::anyhow;
use rayon::prelude::*;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Arguments of `cfs sky`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs sky office.toml                print the table
  cfs sky overhang.toml --json       print patches and illuminances

Columns:
  patch          number of the Tregenza patch from 0, lowest row first
  altitude_deg   altitude of its centre [°]
  azimuth_deg    azimuth of its centre, clockwise from north [°]
  omega_sr       solid angle [sr]
  L_centre_cdm2  luminance at its centre [cd/m²]
  L_mean_cdm2    mean luminance [cd/m²]

Horizontal and façade illuminances are printed on standard error. Skyline and obstruction of [sky] count; boxes of \
[[outside]] and [building] count for the façade alone: its illuminance is then the mean over its apertures.")]
pub struct SkyArgs {
    /// Scene file (.toml)
    pub scene: PathBuf,
    /// Write the table to a CSV file instead of standard output
    #[arg(long, value_name = "FILE.csv")]
    pub out: Option<PathBuf>,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Print patches and illuminances as JSON
    #[arg(long)]
    pub json: bool,
}

/// Row of the table: one sky patch, with angles in °, solid angle in sr, luminances in cd/m².
struct Row {
    altitude_deg: f64,
    azimuth_deg: f64,
    omega: f64,
    centre: f64,
    mean: f64,
}

/// Runs `cfs sky`; errors name the file and the key.
pub fn run(args: &SkyArgs) -> anyhow::Result<()> {
    let name = args.scene.display();
    args.tables.check([&*args.scene], args.out.as_deref(), FileKind::Csv, !args.json)?;
    let scene = crate::study::read_scene_file(&args.scene)?;
    let base_dir = files::folder(&args.scene);
    let (outside, sun) =
        outside_from_keys(&scene.sky, &scene.site, base_dir).map_err(|error| anyhow!("{name}: {error}"))?;

    let hour = hour_of_weather(&scene.sky, &scene.site, base_dir).map_err(|error| anyhow!("{name}: {error}"))?;
    let rows = table(&outside);
    let facade = facade_light(&scene, base_dir, (&outside, sun.as_ref()), &Silent);
    let facade = facade.map_err(|error| anyhow!("{name}: {error}"))?;
    if args.out.is_some() || !args.json {
        args.tables.put(args.out.as_deref(), FileKind::Csv, &csv(&rows))?;
    }
    if args.json {
        let mut value = json(&rows, &outside, sun.as_ref(), &facade);
        value["weather"] = hour.as_ref().map(hour_json).into();
        print(&format!("{value:#}\n"))?;
    }
    let light = illuminances(&scene.sky, &scene.site).map_err(|error| anyhow!("{name}: {error}"))?;
    if let Some(note) = light.and_then(|light| light.note()) {
        report!("note: {note}");
    }
    if facade.behind {
        report!(
            "note: boxes and building are included for the façade, mean over its apertures; the sky is unobstructed"
        );
    }
    weather_notes(hour.as_ref());
    let direct = sun.map_or(0.0, |sun| sun.horizontal());
    let diffuse = outside.diffuse_horizontal();
    report!("horizontal: diffuse {diffuse:.6} lx, direct {direct:.6} lx, global {:.6} lx", diffuse + direct);
    let (diffuse, direct) = (facade.diffuse.value, facade.direct);
    report!("facade: diffuse {diffuse:.6} lx, direct {direct:.6} lx, global {:.6} lx", diffuse + direct);
    Ok(())
}

fn table(outside: &Outside) -> Vec<Row> {
    tregenza_patches()
        .par_iter()
        .map(|patch| Row {
            altitude_deg: patch.altitude.to_degrees(),
            azimuth_deg: patch.bearing.to_degrees(),
            omega: patch.solid_angle(),
            centre: outside.luminance(patch.centre()),
            mean: mean_luminance(outside, patch).value,
        })
        .collect()
}

fn csv(rows: &[Row]) -> String {
    let mut text = String::from("patch,altitude_deg,azimuth_deg,omega_sr,L_centre_cdm2,L_mean_cdm2\n");
    for (patch, row) in rows.iter().enumerate() {
        let (altitude, azimuth) = (tidy(row.altitude_deg), tidy(row.azimuth_deg));
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{patch},{altitude},{azimuth},{:.10},{:.6},{:.6}", row.omega, row.centre, row.mean);
    }
    text
}

/// Rounds an angle to 1e-9°, which removes the rounding errors of the conversion from radians.
fn tidy(degrees: f64) -> f64 {
    (degrees * 1e9).round() / 1e9
}

fn json(rows: &[Row], outside: &Outside, sun: Option<&Sun>, facade: &FacadeLight) -> serde_json::Value {
    let diffuse = outside.diffuse_horizontal();
    let direct = sun.map_or(0.0, Sun::horizontal);
    let patches: Vec<_> = rows
        .iter()
        .enumerate()
        .map(|(patch, row)| {
            serde_json::json!({
                "patch": patch, "altitude_deg": tidy(row.altitude_deg), "azimuth_deg": tidy(row.azimuth_deg),
                "omega_sr": row.omega, "L_centre_cdm2": row.centre, "L_mean_cdm2": row.mean,
            })
        })
        .collect();
    let sun = sun.map(|sun| {
        serde_json::json!({
            "altitude_deg": sun.direction.altitude().to_degrees(),
            "azimuth_deg": sun.direction.bearing().degrees(),
            "direct_normal_lx": sun.direct_normal,
        })
    });
    serde_json::json!({
        "horizontal": { "diffuse_lx": diffuse, "direct_lx": direct, "global_lx": diffuse + direct },
        "facade": {
            "diffuse_lx": facade.diffuse.value, "diffuse_error_lx": facade.diffuse.error,
            "direct_lx": facade.direct, "global_lx": facade.diffuse.value + facade.direct,
        },
        "ground_luminance_cdm2": outside.ground_luminance(),
        "sun": sun,
        "patches": patches,
    })
}
