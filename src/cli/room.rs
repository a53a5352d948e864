//! `cfs room`: illuminance at every sensor point of a scene.

use super::output::{number, print};
use super::progress::TerminalProgress;
use super::weather_info::{hour_json, weather_notes};
use super::writing::Tables;
use crate::compute::lid::BeamSource;
use crate::formats::FileKind;
use crate::study::{RoomResult, Scene, SensorResult, Session, load_scene, system::SystemLibrary};
use anyhow::Context as _;
use serde_json::json;
use std::path::PathBuf;

/// Arguments of `cfs room`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  cfs room office.toml                    print the table
  cfs room office.toml --out office.csv   write it to a file
  cfs room office.toml --json             print results and computation plan

Columns:
  x,y,z                 position of the sensor point [m]
  nx,ny,nz              its normal
  E_lx                  illuminance [lx], E_direct_lx + E_interreflected_lx
  E_direct_lx           direct component [lx]
  E_interreflected_lx   interreflected component [lx]
  E_error_lx            estimated absolute error [lx], sum of the next two
  E_error_numerical_lx  error of the computation [lx]
  E_error_data_lx       error due to the data [lx]
  E_beam_lx             part of E_direct_lx from beams of the sun [lx]

Notes on standard error state the weather hour or the computed illuminances of the sky, the number of sensor points \
too near to slats or cuts for averaged data, apertures whose data cannot place patches of direct sun, and whether \
the error target of the scene was reached.")]
pub struct RoomArgs {
    /// Scene file (.toml)
    pub scene: PathBuf,
    /// Write the table to a CSV file instead of standard output
    #[arg(long, value_name = "FILE.csv")]
    pub out: Option<PathBuf>,
    /// Options for decimal commas in the CSV table and for overwriting existing files.
    #[command(flatten)]
    pub tables: Tables,
    /// Print the results as JSON, with the computation plan: stages, reasons and times
    #[arg(long)]
    pub json: bool,
}

/// Runs `cfs room`.
pub fn run(args: &RoomArgs, library: &dyn SystemLibrary) -> anyhow::Result<()> {
    args.tables.check([&*args.scene], args.out.as_deref(), FileKind::Csv, !args.json)?;
    let scene = load_scene(&args.scene, library)?;
    let result =
        Session::new().room(&scene, &TerminalProgress::new()).with_context(|| args.scene.display().to_string())?;
    notes(&scene, &result);
    let table = args.out.is_some() || !args.json;
    let mut csv = String::from(
        "x,y,z,nx,ny,nz,E_lx,E_direct_lx,E_interreflected_lx,E_error_lx,E_error_numerical_lx,E_error_data_lx,E_beam_lx\n",
    );
    for row in result.sensors.iter().filter(|_| table) {
        let total = row.total();
        let [p, n] = [row.sensor.position, row.sensor.normal];
        let light = [total.value, row.direct.value, row.interreflected.value];
        let errors = [total.error, row.numerical_error(), row.data_error];
        let cells = p.to_array().into_iter().chain(n.to_array()).chain(light).chain(errors).chain([row.beam]);
        csv.push_str(&cells.map(number).collect::<Vec<_>>().join(","));
        csv.push('\n');
    }
    if table {
        args.tables.put(args.out.as_deref(), FileKind::Csv, &csv)?;
    }
    if args.json { print_json(&scene, &result) } else { Ok(()) }
}

/// Uncertainty due to the data, relative to the illuminance at the sensor points, above which a note is printed.
const UNPLACED: f64 = 0.1;

/// Prints notes on the result on standard error: sky, weather, obstructions, data and error target.
fn notes(scene: &Scene, result: &RoomResult) {
    if let Some(note) = scene.illuminances.and_then(|light| light.note()) {
        report!("note: {note}");
    }
    weather_notes(scene.weather.as_ref());
    scene.outside_notes.iter().for_each(|note| report!("note: {note}"));
    for (number, (aperture, count)) in scene.apertures.iter().zip(scene.too_near()).enumerate() {
        if let Some(distance) = aperture.homogeneity_distance().filter(|_| count > 0) {
            report!(
                "note: {count} of {} sensors lie nearer than {distance:.3} m to aperture {}, where they would see the \
                 slats or cuts of {} one by one; the data contain only its mean",
                scene.sensors.len(),
                number + 1,
                aperture.system.label
            );
        }
    }
    for (number, (aperture, (source, reason))) in scene.apertures.iter().zip(&result.beams).enumerate() {
        let data_share = result.data_share();
        if *source == BeamSource::Cells && data_share > UNPLACED {
            report!(
                "note: sun patches cannot be placed with the data of aperture {} ({}): {reason}; the \
                 uncertainty from the data is {:.0} % of the light at the sensors",
                number + 1,
                aperture.system.label,
                100.0 * data_share
            );
        }
    }
    if let Some(target) = scene.error_target {
        let (reached, target) = (100.0 * result.reached(), 100.0 * target);
        let word = if reached <= target { "reached" } else { "not reached" };
        report!("note: error target of {target} % {word}: {reached:.2} % at the sensor with the largest stated error");
    }
}

fn to_json(scene: &Scene, result: &RoomResult) -> serde_json::Value {
    json!({
        "near_field": { "method": scene.near_field.word(), "effort": scene.near_field.effort() },
        "illuminance": scene.illuminances.map(|light| json!({
            "source": light.origin(),
            "diffuse_horizontal_lx": light.diffuse_horizontal,
            "direct_normal_lx": light.direct_normal,
        })),
        "weather": scene.weather.as_ref().map(hour_json),
        "error_target": scene.error_target,
        "reached": result.reached(),
        "apertures": scene.apertures.iter().zip(scene.too_near()).zip(&result.beams).map(|((one, too_near), (beam, reason))| json!({
            "system": one.system.label,
            "structure_m": one.structure,
            "homogeneity_distance_m": one.homogeneity_distance(),
            "sensors_nearer": too_near,
            "beam": beam.word(),
            "beam_reason": reason,
        })).collect::<Vec<_>>(),
        "flux_lm": result.flux.value,
        "flux_error_lm": result.flux.error,
        "flux_gap": result.flux_gap,
        "plan": result.plan.stages.iter().map(|stage| json!({
            "stage": stage.name, "runs": stage.runs, "reason": stage.reason, "seconds": stage.time.as_secs_f64(),
        })).collect::<Vec<_>>(),
    })
}

fn sensor_json(row: &SensorResult) -> serde_json::Value {
    json!({
        "position_m": row.sensor.position.to_array(),
        "normal": row.sensor.normal.to_array(),
        "E_lx": row.total().value,
        "E_direct_lx": row.direct.value,
        "E_interreflected_lx": row.interreflected.value,
        "E_error_lx": row.total().error,
        "E_error_numerical_lx": row.numerical_error(),
        "E_error_data_lx": row.data_error,
        "E_beam_lx": row.beam,
    })
}

/// Prints the result as one JSON object. The sensor points come last and are written one after another, since a million
/// of them as one value would need gigabytes of memory.
fn print_json(scene: &Scene, result: &RoomResult) -> anyhow::Result<()> {
    let head = format!("{:#}", to_json(scene, result));
    let head = head.strip_suffix("\n}").unwrap_or(&head);
    let mut text = format!("{head},\n  \"sensors\": [\n");
    for (index, row) in result.sensors.iter().enumerate() {
        let own = format!("{:#}", sensor_json(row)).replace('\n', "\n    ");
        text.push_str(if index > 0 { ",\n    " } else { "    " });
        text.push_str(&own);
        if text.len() > PRINTED_AT_ONCE {
            print(&text)?;
            text.clear();
        }
    }
    text.push_str("\n  ]\n}\n");
    print(&text)
}

/// Size of the JSON text that is collected before it is printed. \[bytes\]
const PRINTED_AT_ONCE: usize = 1 << 20;
