//! Table of a ranking for CSV files.

use super::list::{List, Row};
use super::words::why;
use crate::drawing::ticks::nine_digits;
use crate::texts::inert_cell;

/// Names of the columns before the figures.
pub const WHERE: [&str; 4] = ["scene", "climate", "azimuth", "product"];
/// Names of the columns after the figures.
pub const RESULT: [&str; 8] =
    ["utility", "utility_error", "rank_first", "rank_last", "front", "approximate", "excluded", "why"];
/// Separator between the reasons why figures are approximate.
pub const BETWEEN: &str = "; ";

/// Returns the names of all columns. `figures`: keys of the figures.
pub fn header(figures: &[String]) -> Vec<String> {
    let pairs = figures.iter().flat_map(|figure| [figure.clone(), format!("{figure}_error")]);
    WHERE.map(str::to_owned).into_iter().chain(pairs).chain(RESULT.map(str::to_owned)).collect()
}

/// Formats a number with all its digits: figures have nine, and read back unchanged.
pub fn exact(value: f64) -> String {
    // Without the sign of −0.
    format!("{}", value + 0.0)
}

/// Returns the first columns of a row: scene, climate, azimuth, product and the figures; empty fields for figures that
/// this list does not have.
pub fn begin(list: &List, row: &Row, figures: &[String]) -> Vec<String> {
    let mut fields = vec![list.scene.clone(), list.climate.clone(), exact(list.azimuth), row.product.clone()];
    for figure in figures {
        let own = list.figures.iter().position(|one| one == figure);
        let found = own.zip(row.outcome.as_ref().ok()).map(|(k, found)| found.figures[k]);
        fields.push(found.map(|found| exact(found.value)).unwrap_or_default());
        fields.push(found.map(|found| exact(found.error)).unwrap_or_default());
    }
    fields
}

/// Returns the row of an excluded product. `fields`: its first columns.
pub fn excluded(mut fields: Vec<String>, reason: &str) -> Vec<String> {
    fields.extend(RESULT.map(|name| if name == "excluded" { reason.to_owned() } else { String::new() }));
    fields
}

/// Returns the table of whole rankings: lists in their order, best products first, excluded ones last. Its first row
/// has the names of the columns.
pub fn ranked_table(lists: &[List], figures: &[String]) -> Vec<Vec<String>> {
    let mut table = vec![header(figures)];
    for list in lists {
        let (ranked, ranking) = (list.ranked(), list.ranking(&list.objectives));
        let names: Vec<_> = ranked.iter().map(|(row, found)| (row.product.as_str(), *found)).collect();
        for &k in &ranking.order {
            let ((row, found), one) = (ranked[k], &ranking.list[k]);
            let mut fields = begin(list, row, figures);
            fields.extend([nine_digits(one.utility.value), nine_digits(one.utility.error)]);
            fields.extend([one.ranks.first.to_string(), one.ranks.last.to_string(), one.place.word().to_owned()]);
            fields.extend([found.approximate.join(BETWEEN), String::new(), why(list, &ranking.list, &names, k)]);
            table.push(fields);
        }
        table.extend(list.excluded().into_iter().map(|(row, reason)| excluded(begin(list, row, figures), reason)));
    }
    table
}

/// Returns a table as CSV.
pub fn csv_text(rows: &[Vec<String>]) -> String {
    let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
    for row in rows {
        writer
            .write_record(row.iter().map(|text| inert_cell(text).into_owned()))
            .expect("memory takes all that is written to it");
    }
    let bytes = writer.into_inner().expect("memory takes all that is written to it");
    String::from_utf8(bytes).expect("it was made of text")
}
