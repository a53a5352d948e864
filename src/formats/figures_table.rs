//! Table of the optical figures of the built-in products: CSV, one row per state, so that changes of single products
//! show when two versions of the program are compared.
//!
//! Columns: `product` (key), `fingerprint` of the inputs of the computation, `state`, the figures, and the
//! transmittances `t…` at rising profile angles in degrees. `to_ceiling` is empty if nothing is transmitted.

use super::location::excerpt;
use std::fmt::Write as _;

/// Names of the columns before those of the transmittances.
const HEAD: [&str; 8] =
    ["product", "fingerprint", "state", "tau_normal", "tau_hemispherical", "to_ceiling", "sun_blocked", "view"];

/// Optical figures of one state of a built-in product; see [`crate::compute::btdf::LightFigures`] for the last three.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FigureRow {
    /// Key of the product.
    pub product: String,
    /// Hash of the inputs from which the figures were computed.
    pub fingerprint: String,
    /// Key of the state; empty for a product without states.
    pub state: String,
    /// Visible transmittance at normal incidence.
    pub tau_normal: f64,
    /// Hemispherical visible transmittance: for uniform incident luminance.
    pub tau_hemispherical: f64,
    /// Direct-hemispherical visible transmittances in the vertical plane perpendicular to the façade, at profile angles
    /// that the caller defines.
    pub tau_profile: Vec<f64>,
    /// Share of the transmitted skylight that leaves upwards, towards the ceiling, 0 … 1; `None` if nothing is
    /// transmitted.
    pub to_ceiling: Option<f64>,
    /// Share of direct sun blocked at 45° solar altitude (1 − τ).
    pub sun_blocked: f64,
    /// Normal–normal transmittance.
    pub view: f64,
}

/// Error in reading a table of figures.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("line {line}: {what}")]
pub struct TableError {
    /// Line number, from 1.
    pub line: usize,
    /// Description of the problem, and of what was expected.
    pub what: String,
}

/// Returns the table of figures as CSV text; `angles`: profile angles of the transmittances \[°\]. Figures are written
/// with five decimals, far finer than their uncertainty.
pub fn write(rows: &[FigureRow], angles: &[f64]) -> String {
    let mut text = HEAD.join(",");
    for angle in angles {
        _ = write!(text, ",t{angle}");
    }
    text.push('\n');
    for row in rows {
        // Keys are plain: without commas and quotation marks, as the reader checks.
        _ = write!(text, "{},{},{}", row.product, row.fingerprint, row.state);
        let figures = [Some(row.tau_normal), Some(row.tau_hemispherical), row.to_ceiling];
        let rest = [row.sun_blocked, row.view].into_iter().chain(row.tau_profile.iter().copied()).map(Some);
        for figure in figures.into_iter().chain(rest) {
            text.push(',');
            if let Some(figure) = figure {
                _ = write!(text, "{}", (figure * 1e5).round() / 1e5);
            }
        }
        text.push('\n');
    }
    text
}

/// Reads a table of figures that [`write()`] wrote for the profile angles `angles` \[°\].
///
/// # Errors
/// Returns an error with the line that does not fit the table, and what is wrong with it.
pub fn read(text: &str, angles: &[f64]) -> Result<Vec<FigureRow>, TableError> {
    let mut lines = text.lines().enumerate();
    let head: Vec<String> =
        HEAD.iter().map(|&name| name.to_owned()).chain(angles.iter().map(|angle| format!("t{angle}"))).collect();
    let wrong = |index: usize, what: String| TableError { line: index + 1, what };
    let found = lines.next().map_or("", |(_, line)| line);
    if found != head.join(",") {
        return Err(wrong(0, format!("the columns are not {}", head.join(","))));
    }
    lines
        .map(|(index, line)| {
            let fields: Vec<&str> = line.split(',').collect();
            if fields.len() != head.len() {
                return Err(wrong(index, format!("{} fields; expected {}", fields.len(), head.len())));
            }
            let number = |at: usize| {
                let share: Option<f64> = fields[at].parse().ok().filter(|share| (0.0..=1.01).contains(share));
                share.ok_or_else(|| wrong(index, format!("{}: \"{}\"; expected 0 to 1", head[at], excerpt(fields[at]))))
            };
            Ok(FigureRow {
                product: fields[0].to_owned(),
                fingerprint: fields[1].to_owned(),
                state: fields[2].to_owned(),
                tau_normal: number(3)?,
                tau_hemispherical: number(4)?,
                to_ceiling: if fields[5].is_empty() { None } else { Some(number(5)?) },
                sun_blocked: number(6)?,
                view: number(7)?,
                tau_profile: (HEAD.len()..head.len()).map(number).collect::<Result<_, _>>()?,
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_as_written_and_wrong_lines_are_named() {
        let row = FigureRow {
            product: "blind".into(),
            fingerprint: "00ff".into(),
            state: "45".into(),
            tau_normal: 0.25,
            tau_hemispherical: 0.125,
            tau_profile: vec![0.0, 0.12346, 1.0],
            to_ceiling: None,
            sun_blocked: 0.75,
            view: 0.0,
        };
        let rows = [row.clone(), FigureRow { to_ceiling: Some(0.4), state: String::new(), ..row }];
        let angles = [-45.0, 0.0, 45.0];
        let text = write(&rows, &angles);
        assert!(text.starts_with("product,fingerprint,state,tau_normal,"), "{text}");
        assert_eq!(read(&text, &angles).unwrap(), rows);
        assert_eq!(read(&text, &angles[..2]).unwrap_err().line, 1);
        for (from, to, line) in [("0.25", "1.25", 2), ("0.12346", "none", 2), (",0.4", "", 3)] {
            let error = read(&text.replacen(from, to, 1), &angles).unwrap_err();
            assert_eq!(error.line, line, "{error}");
        }
    }
}
