//! CSV tables of the parts of a ranking (`--shard`), with all data that are needed to merge them.
//!
//! A part has the columns of a complete table, but without ranks and reasons, which depend on the other parts too. They
//! are followed by the columns `list` (position among all lists), `objectives`, one column `_parts` per figure, `key`
//! (a hash of all input of the row), and a last column without values, whose name states the number of the part, the
//! ranking and the number of rows.

use super::output::number;
use crate::compute::rank::{Better, Objective, utility};
use crate::formats::decimal_comma::with_decimal_points;
use crate::formats::encoding::decode;
use crate::study::rank::{BETWEEN, List, Parts, Shard, begin, csv_text, exact, excluded, header};
use std::path::Path;

/// Identity of a part of a ranking: its number, the ranking, and its number of rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Shape {
    /// Number n of the part and number N of all parts, n/N.
    pub shard: Shard,
    /// Key of the ranking, a hash of its input.
    pub run: String,
    /// Number of rows of the part.
    pub rows: usize,
}

impl Shape {
    /// Returns the name of the last column, which states the identity of the part.
    fn name(&self) -> String {
        format!("shard {}/{} of {} with {} rows", self.shard.number, self.shard.count, self.run, self.rows)
    }

    /// Parses the identity of a part from the name of the last column; `None` for other names.
    pub(super) fn read(name: &str) -> Option<Self> {
        let words: Vec<&str> = name.split(' ').collect();
        let ["shard", shard, "of", run, "with", rows, "rows"] = words.as_slice() else { return None };
        Some(Self { shard: Shard::read(shard).ok()?, run: (*run).to_owned(), rows: rows.parse().ok()? })
    }
}

/// Returns the identity of the part of a ranking that a file contains completely; `None` for other or missing files and
/// for streams.
pub(super) fn shard_of(path: &Path) -> Option<Shape> {
    let bytes = if path.is_file() { std::fs::read(path).ok()? } else { return None };
    let text = decode(&bytes).ok()?;
    let text = with_decimal_points(&text);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let shape = Shape::read(reader.headers().ok()?.iter().next_back()?)?;
    let rows = reader.records().try_fold(0, |count, record| record.map(|_| count + 1)).ok()?;
    (rows == shape.rows).then_some(shape)
}

/// Returns the CSV table of a part of a ranking; `figures`: keys of the figures of all lists.
pub(super) fn shard_csv(lists: &[List], figures: &[String], shape: &Shape) -> String {
    let mut head = header(figures);
    head.extend(["list".to_owned(), "objectives".to_owned()]);
    head.extend(figures.iter().map(|figure| format!("{figure}_parts")));
    head.extend(["key".to_owned(), shape.name()]);
    let mut table = vec![head];
    for list in lists {
        for row in &list.rows {
            let mut fields = begin(list, row, figures);
            match &row.outcome {
                Ok(found) => {
                    let utility = utility(&list.objectives, &found.figures);
                    fields.extend([number(utility.value), number(utility.error)]);
                    fields.extend([const { String::new() }; 3]);
                    fields.extend([found.approximate.join(BETWEEN), String::new(), String::new()]);
                }
                Err(reason) => fields = excluded(fields, reason),
            }
            fields.extend([list.number.to_string(), objectives_text(list)]);
            for figure in figures {
                let own = list.figures.iter().position(|one| one == figure);
                let parts = own.zip(row.outcome.as_ref().ok()).map(|(k, found)| parts_text(&found.parts[k]));
                fields.push(parts.unwrap_or_default());
            }
            fields.extend([row.key.clone(), String::new()]);
            table.push(fields);
        }
    }
    csv_text(&table)
}

/// Returns the objectives of a list as text: `figure less|more worst best weight` for each, separated by blanks.
fn objectives_text(list: &List) -> String {
    let one = |(figure, one): (&String, &Objective)| {
        let better = if one.better == Better::Less { "less" } else { "more" };
        format!("{figure} {better} {} {} {}", one.worst, one.best, one.weight)
    };
    list.figures.iter().zip(&list.objectives).map(one).collect::<Vec<_>>().join(BETWEEN)
}

/// Parses the objectives of a list that [`shard_csv`] wrote. Returns the keys of the figures, and the objectives.
pub(super) fn objectives_of(text: &str) -> Option<(Vec<String>, Vec<Objective>)> {
    let one = |text: &str| {
        let words: Vec<&str> = text.split(' ').collect();
        let [figure, better, worst, best, weight] = words.as_slice() else { return None };
        let better = match *better {
            "less" => Better::Less,
            "more" => Better::More,
            _ => return None,
        };
        let [worst, best, weight] = [worst, best, weight].map(|word| word.parse::<f64>().ok());
        Some(((*figure).to_owned(), Objective { better, worst: worst?, best: best?, weight: weight? }))
    };
    Some(text.split(BETWEEN).map(one).collect::<Option<Vec<_>>>()?.into_iter().unzip())
}

/// Returns the parts that a figure is the sum of as text: the number of zones, then the values in their order.
fn parts_text(parts: &Parts) -> String {
    if parts.values.is_empty() {
        return String::new();
    }
    let values: Vec<String> = parts.values.iter().map(|part| exact(*part)).collect();
    format!("{}|{}", parts.zones.join(";"), values.join(" "))
}

/// Parses the parts of a figure that [`shard_csv`] wrote; `None` if the text is not valid.
pub(super) fn parts_of(text: &str) -> Option<Parts> {
    if text.is_empty() {
        return Some(Parts::default());
    }
    let (zones, values) = text.split_once('|')?;
    let values: Vec<f64> = values.split(' ').map(|word| word.parse().ok()).collect::<Option<_>>()?;
    Some(Parts { zones: zones.split(';').map(str::to_owned).collect(), values })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_say_which_they_are() {
        let shape = Shape { shard: Shard { number: 3, count: 8 }, run: "0123".to_owned(), rows: 12 };
        assert_eq!(Shape::read(&shape.name()), Some(shape));
        for wrong in ["why", "shard 8/8 of 0123 with 12 rows", "shard 1/8 of 0123 with x rows"] {
            assert_eq!(Shape::read(wrong), None);
        }
    }

    #[test]
    fn parts_and_numbers_come_back_as_they_went() {
        let parts = Parts { zones: vec!["whole room".to_owned()], values: vec![0.1, -1.23456789e-12, 0.0, 4e15] };
        assert_eq!(parts_of(&parts_text(&parts)), Some(parts));
        assert_eq!(parts_of(""), Some(Parts::default()));
        assert_eq!((parts_of("a"), parts_of("a|1 x")), (None, None));
        assert_eq!([exact(-0.0), exact(12.5), exact(1e-9)], ["0", "12.5", "0.000000001"]);
        let (figures, objectives) = objectives_of("UDI_x less 0.5 0 1; cDA300 more 0.2 0.8 2.5").unwrap();
        assert_eq!(figures, ["UDI_x", "cDA300"]);
        assert_eq!((objectives[0].best, objectives[1].weight, objectives[1].better), (0.0, 2.5, Better::More));
        assert!(objectives_of("").is_none() && objectives_of("a less 1 x 1").is_none());
    }
}
