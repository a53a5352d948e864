//! `cfs accuracy SCENE --rank`: error against computing time for a ranking.

use super::output::{number, print};
use crate::study::accuracy::ranking::{Effort, RankAccuracy, RankRung};
use serde_json::json;
use std::fmt::Write as _;

/// Prints errors and computing times of a ranking with rising effort, as a table or as JSON.
pub(super) fn print_accuracy(accuracy: &RankAccuracy, as_json: bool) -> anyhow::Result<()> {
    if as_json { print(&format!("{:#}\n", to_json(accuracy))) } else { print(&table(accuracy)) }
}

/// Returns the effort of one run of a ranking as text.
fn setting(rung: &RankRung) -> String {
    match rung.effort {
        Effort::Cells => "data on their cells".to_owned(),
        Effort::Target(None) => "as the scene has it".to_owned(),
        Effort::Target(Some(target)) => format!("error target {} %", 100.0 * target),
    }
}

/// Returns a CSV table with one row per run of the ranking.
pub(super) fn csv(accuracy: &RankAccuracy) -> anyhow::Result<String> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "setting",
        "seconds",
        "stated_mean",
        "error_rms",
        "error_max",
        "products",
        "share_held",
        "share_padded_10",
        "pairs",
        "pairs_apart",
        "pairs_told",
        "pairs_reversed",
    ])?;
    for rung in &accuracy.rungs {
        // The finest ranking has no reference.
        let coverage = rung.coverage();
        let reported = |value: f64| if coverage.is_some() { number(value) } else { String::new() };
        let pairs = rung.pairs;
        writer.write_record([
            setting(rung),
            number(rung.seconds),
            number(rung.stated),
            reported(rung.rms()),
            reported(rung.max()),
            coverage.map_or_else(String::new, |one| one.count.to_string()),
            coverage.map_or_else(String::new, |one| number(one.kept)),
            coverage.map_or_else(String::new, |one| number(one.padded)),
            pairs.all.to_string(),
            pairs.distinct.to_string(),
            pairs.same_order.to_string(),
            pairs.reversed.to_string(),
        ])?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

fn table(accuracy: &RankAccuracy) -> String {
    let mut text = String::from("Ranking, scores of products (0 to 1): errors against the finest ranking\n");
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "  {:<22} {:>9} {:>12} {:>10} {:>10} {:>7} {:>7} {:>10} {:>9} {:>9}",
        "effort",
        "time",
        "stated mean",
        "error RMS",
        "error max",
        "held",
        "> 10×",
        "separated",
        "uncertain",
        "reversed"
    );
    for rung in &accuracy.rungs {
        let _ = write!(text, "  {:<22} {:>7.2} s {:>12.5} ", setting(rung), rung.seconds, rung.stated);
        let pairs = rung.pairs;
        let open = pairs.distinct - pairs.same_order - pairs.reversed;
        let _ = match rung.coverage() {
            None => writeln!(text, "{:>10}", "finest"),
            Some(one) => writeln!(
                text,
                "{:>10.5} {:>10.5} {:>5.1} % {:>5.1} % {:>10} {:>9} {:>9}",
                rung.rms(),
                rung.max(),
                100.0 * one.kept,
                100.0 * one.padded,
                pairs.same_order,
                open,
                pairs.reversed
            ),
        };
    }
    let [all, ranked] = accuracy.products;
    let pairs = accuracy.rungs.last().map(|rung| rung.pairs).unwrap_or_default();
    let _ = writeln!(
        text,
        "{ranked} of {all} products ranked in {} list(s). The finest has {} of {} pairs apart by more than twice what it states \
         of both: these are separated by the others, uncertain or reversed. Times of {} thread(s), each in a room of its own; the first computes \
         data of built-in products where they are missing.",
        accuracy.lists, pairs.distinct, pairs.all, accuracy.threads
    );
    text
}

fn to_json(accuracy: &RankAccuracy) -> serde_json::Value {
    let rung = |rung: &RankRung| {
        let coverage = rung.coverage();
        let reported = |value: f64| coverage.is_some().then_some(value);
        let target = if let Effort::Target(target) = rung.effort { target } else { None };
        let pairs = rung.pairs;
        json!({
            "setting": setting(rung), "error_target": target, "seconds": rung.seconds, "stated_mean": rung.stated,
            "error_rms": reported(rung.rms()), "error_max": reported(rung.max()),
            "coverage": coverage.map(|one| json!({"values": one.count, "held": one.kept, "padded_10": one.padded})),
            "pairs": {"all": pairs.all, "apart": pairs.distinct, "told": pairs.same_order, "reversed": pairs.reversed},
        })
    };
    json!({
        "against": "finest ranking",
        "rankings": accuracy.rungs.iter().map(rung).collect::<Vec<_>>(),
        "lists": accuracy.lists,
        "products": accuracy.products[0],
        "ranked": accuracy.products[1],
        "threads": accuracy.threads,
    })
}
