//! Table of the figures of several candidates. A candidate is better only if the difference is larger than the sum of
//! the errors.

use super::figures::{Facts, Figure, Sense, Value};
use crate::texts::{compare as texts, csv_cell};

/// Result of comparing the values of one figure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// Indices of the candidates that are better than all others by more than the sum of the errors; several if they do
    /// not differ from each other.
    Better(Vec<usize>),
    /// No difference is larger than the sum of the errors.
    Within,
    /// Neither larger nor smaller values are better by themselves.
    Aim,
    /// The values differ, but an error is not stated.
    Unstated,
    /// Fewer than two values are known.
    Alone,
}

/// One figure of all candidates, as a row of the table.
#[derive(Debug, Clone)]
pub struct Row {
    /// Definition of the figure.
    pub figure: Figure,
    /// Values in the order of the candidates; `None` where a value is not known.
    pub values: Vec<Option<Value>>,
    /// Result of comparing the values.
    pub verdict: Verdict,
}

/// Returns the figures of the candidates, one row per figure.
pub fn compare(figures: &[Figure], candidates: &[&Facts]) -> Vec<Row> {
    let row = |figure: &Figure| {
        let values: Vec<Option<Value>> = candidates.iter().map(|facts| (figure.of)(facts)).collect();
        let verdict = judge(figure.sense, &values);
        Row { figure: *figure, values, verdict }
    };
    figures.iter().map(row).collect()
}

/// Determines which of several values is better. `sense`: whether larger or smaller values are better.
pub fn judge(sense: Sense, values: &[Option<Value>]) -> Verdict {
    let sign = match sense {
        Sense::More => 1.0,
        Sense::Less => -1.0,
        Sense::Aim => return Verdict::Aim,
    };
    let known: Vec<(usize, Value)> =
        values.iter().enumerate().filter_map(|(at, value)| Some((at, (*value)?))).collect();
    let best = known.iter().max_by(|a, b| (sign * a.1.value).total_cmp(&(sign * b.1.value)));
    let Some((_, best)) = best.filter(|_| known.len() > 1) else { return Verdict::Alone };
    if known.iter().any(|(_, one)| one.error.is_none()) {
        let equal = known.iter().all(|(_, one)| one.value == best.value);
        return if equal { Verdict::Within } else { Verdict::Unstated };
    }
    let is_distinct =
        |one: &Value| (best.value - one.value).abs() > best.error.unwrap_or(0.0) + one.error.unwrap_or(0.0);
    let tied: Vec<usize> = known.iter().filter(|(_, one)| !is_distinct(one)).map(|(at, _)| *at).collect();
    if tied.len() == known.len() { Verdict::Within } else { Verdict::Better(tied) }
}

/// Returns the result of a comparison as a translated text. `names`: names of the candidates.
pub fn verdict_words(verdict: &Verdict, names: &[String]) -> String {
    match verdict {
        Verdict::Better(list) => {
            let list: Vec<&str> = list.iter().filter_map(|at| names.get(*at)).map(String::as_str).collect();
            list.join(", ")
        }
        Verdict::Within => texts::WITHIN.into(),
        Verdict::Aim => Sense::Aim.words().into(),
        Verdict::Unstated => texts::UNSTATED.into(),
        Verdict::Alone => String::new(),
    }
}

/// Returns the result of a comparison as a text for files, which does not change with the labels. `names`: names of the
/// candidates.
fn verdict_key(verdict: &Verdict, names: &[String]) -> String {
    match verdict {
        Verdict::Within => "within the errors".to_owned(),
        Verdict::Unstated => "error not stated".to_owned(),
        Verdict::Aim => Sense::Aim.key().to_owned(),
        Verdict::Better(_) | Verdict::Alone => verdict_words(verdict, names),
    }
}

/// Returns the table as CSV: `figure,unit,better_is`, value and error of each candidate, and `better`. `names`: names
/// of the candidates. All words are English, as in all data files.
pub fn csv(rows: &[Row], names: &[String]) -> String {
    let mut out = String::from("figure,unit,better_is");
    for name in names {
        out.push_str(&format!(",{},{}", csv_cell(name), csv_cell(&format!("error of {name}"))));
    }
    out.push_str(",better\n");
    let number = |value: Option<f64>| value.map(|value| format!("{value:.6}")).unwrap_or_default();
    for row in rows {
        out.push_str(&format!("{},{},{}", row.figure.key, row.figure.unit, row.figure.sense.key()));
        for value in &row.values {
            let error = value.and_then(|value| value.error);
            out.push_str(&format!(",{},{}", number(value.map(|value| value.value)), number(error)));
        }
        out.push_str(&format!(",{}\n", csv_cell(&verdict_key(&row.verdict, names))));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::estimate::Estimate;

    fn values(list: &[(f64, f64)]) -> Vec<Option<Value>> {
        list.iter().map(|&(value, error)| Some(Estimate::new(value, error).into())).collect()
    }

    #[test]
    fn better_is_what_differs_by_more_than_the_errors_together() {
        let pair = values(&[(10.0, 1.0), (12.5, 1.0)]);
        assert_eq!(judge(Sense::More, &pair), Verdict::Better(vec![1]));
        assert_eq!(judge(Sense::Less, &pair), Verdict::Better(vec![0]));
        assert_eq!(judge(Sense::Aim, &pair), Verdict::Aim);
        assert_eq!(judge(Sense::More, &values(&[(10.0, 1.0), (12.0, 1.0)])), Verdict::Within);
        assert_eq!(judge(Sense::More, &values(&[(10.0, 1.0)])), Verdict::Alone);
        assert_eq!(judge(Sense::More, &[pair[0], None]), Verdict::Alone);
        // Two that cannot be told apart are both better than a third.
        let three = values(&[(20.0, 1.0), (5.0, 1.0), (19.0, 1.0)]);
        assert_eq!(judge(Sense::More, &three), Verdict::Better(vec![0, 2]));
        let unstated = [pair[0], Some(Value { value: 90.0, error: None })];
        assert_eq!(judge(Sense::More, &unstated), Verdict::Unstated);
    }

    #[test]
    fn the_table_goes_to_spreadsheets() {
        let figure = Figure {
            key: "mean",
            name: texts::MEAN,
            unit: "lx",
            sense: Sense::More,
            tip: texts::MEAN_TIP,
            of: |_| None,
        };
        let rows = [Row { figure, values: values(&[(1.0, 0.5), (3.0, 0.5)]), verdict: Verdict::Better(vec![1]) }];
        let names = ["plain".to_owned(), "a, \"b\"".to_owned()];
        let wanted = "figure,unit,better_is,plain,error of plain,\"a, \"\"b\"\"\",\"error of a, \"\"b\"\"\",better\n\
                      mean,lx,more is better,1.000000,0.500000,3.000000,0.500000,\"a, \"\"b\"\"\"\n";
        assert_eq!(csv(&rows, &names), wanted);
    }
}
