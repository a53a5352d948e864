//! `cfs accuracy SCENE --year`: error against computing time for an annual simulation.

use super::output::{number, print};
use crate::study::accuracy::annual::{YearAccuracy, YearRung};
use crate::study::accuracy::words::percent;
use serde_json::json;
use std::fmt::Write as _;

/// Prints errors and computing times of an annual simulation with rising effort, as a table or as JSON.
pub(super) fn print_accuracy(accuracy: &YearAccuracy, as_json: bool) -> anyhow::Result<()> {
    if as_json { print(&format!("{:#}\n", to_json(accuracy))) } else { print(&table(accuracy)) }
}

/// Returns the effort of one run of an annual simulation as text.
fn setting(rung: &YearRung) -> String {
    rung.target.map_or_else(|| "as the scene has it".to_owned(), |target| format!("error target {} %", 100.0 * target))
}

/// Returns a CSV table with one row per run of the annual simulation. Every annual figure has three columns: value,
/// stated uncertainty, and difference from the run with the most effort.
pub(super) fn csv(accuracy: &YearAccuracy) -> anyhow::Result<String> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let figures = accuracy.rungs.first().map_or(&[][..], |rung| &rung.figures);
    let names = figures.iter().flat_map(|one| ["", "_stated", "_off"].map(|word| format!("{}{word}", one.key)));
    let head =
        ["setting", "seconds", "stated_mean", "error_rms", "error_max", "values", "share_held", "share_padded_10"];
    writer.write_record(head.map(str::to_owned).into_iter().chain(names))?;
    for rung in &accuracy.rungs {
        // The finest year has no reference.
        let coverage = rung.coverage();
        let reported = |value: f64| if coverage.is_some() { number(value) } else { String::new() };
        let own = [
            setting(rung),
            number(rung.seconds),
            number(rung.stated),
            reported(rung.rms()),
            reported(rung.max()),
            rung.errors.len().to_string(),
            coverage.map_or_else(String::new, |one| number(one.kept)),
            coverage.map_or_else(String::new, |one| number(one.padded)),
        ];
        let figures = rung.figures.iter().flat_map(|one| [number(one.value), number(one.stated), reported(one.real)]);
        writer.write_record(own.into_iter().chain(figures))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

fn table(accuracy: &YearAccuracy) -> String {
    let mut text = String::from("Year, all hours at all sensors and eyes: errors against the finest year\n");
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "  {:<22} {:>9} {:>12} {:>10} {:>10} {:>7} {:>7}",
        "effort", "time", "stated mean", "error RMS", "error max", "held", "> 10×"
    );
    for rung in &accuracy.rungs {
        let _ = write!(text, "  {:<22} {:>7.2} s {:>12} ", setting(rung), rung.seconds, percent(rung.stated));
        let _ = match rung.coverage() {
            None => writeln!(text, "{:>10}", "finest"),
            Some(one) => writeln!(
                text,
                "{:>10} {:>10} {:>5.1} % {:>5.1} %",
                percent(rung.rms()),
                percent(rung.max()),
                100.0 * one.kept,
                100.0 * one.padded
            ),
        };
    }
    text.push_str("\nFigures, ± as stated, and their distance from the finest year's\n");
    for rung in &accuracy.rungs {
        let _ = writeln!(text, "  {}", setting(rung));
        for one in &rung.figures {
            let _ =
                writeln!(text, "    {:<22} {:>12.5} ± {:<11.5} off {:.5}", one.key, one.value, one.stated, one.real);
        }
    }
    let [steps, lit] = accuracy.steps;
    let _ = writeln!(
        text,
        "{steps} steps, {lit} with light, {} sensors and eyes, times of {} thread(s), nothing known before.",
        accuracy.places, accuracy.threads
    );
    text
}

fn to_json(accuracy: &YearAccuracy) -> serde_json::Value {
    let rung = |rung: &YearRung| {
        let coverage = rung.coverage();
        let reported = |value: f64| coverage.is_some().then_some(value);
        let stages: serde_json::Map<String, serde_json::Value> =
            rung.stages.iter().map(|(stage, seconds)| ((*stage).to_owned(), json!(seconds))).collect();
        json!({
            "setting": setting(rung), "error_target": rung.target, "seconds": rung.seconds, "stages": stages,
            "stated_mean": rung.stated, "error_rms": reported(rung.rms()), "error_max": reported(rung.max()),
            "coverage": coverage.map(|one| json!({"values": one.count, "held": one.kept, "padded_10": one.padded})),
            "figures": rung.figures.iter().map(|one| json!({
                "key": one.key, "value": one.value, "stated": one.stated, "off": reported(one.real),
            })).collect::<Vec<_>>(),
        })
    };
    json!({
        "against": "finest year",
        "years": accuracy.rungs.iter().map(rung).collect::<Vec<_>>(),
        "steps": accuracy.steps[0],
        "lit_steps": accuracy.steps[1],
        "places": accuracy.places,
        "threads": accuracy.threads,
    })
}
