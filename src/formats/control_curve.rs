//! Control curves of shading devices: CSV with the columns `profile_angle_deg` and `value_deg` (or `value`), profile
//! angles rising.
//!
//! Read: separated by commas, semicolons, tabs or blanks; a header, which may name further columns, or two bare columns
//! in this order; comments from `#` on. Not read: decimal commas, units other than degrees.

use super::encoding::{NotText, TooLong, decode, not_too_long};
use crate::compute::limits::CURVE_POINTS;

/// Error in reading a control curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// Bytes that are not text.
    #[error(transparent)]
    NotText(#[from] NotText),
    /// Text that is too long for a control curve.
    #[error(transparent)]
    TooLong(#[from] TooLong),
    /// Header that lacks the two columns of profile angle and value.
    #[error("line {line}: the header needs the columns profile_angle_deg and value_deg")]
    Header {
        /// Line number, from 1.
        line: usize,
    },
    /// Field that is not a number.
    #[error("line {line}: \"{found}\" is not a number of degrees")]
    Number {
        /// Line number, from 1.
        line: usize,
        /// Text of the field.
        found: String,
    },
    /// Profile angle that is not above that of the previous line.
    #[error("line {line}: profile angle {found}° does not rise")]
    Order {
        /// Line number, from 1.
        line: usize,
        /// Profile angle. \[°\]
        found: f64,
    },
    /// Profile angle outside −90° … 90°.
    #[error("line {line}: profile angle {found}° is out of range (allowed: -90 to 90)")]
    Range {
        /// Line number, from 1.
        line: usize,
        /// Profile angle. \[°\]
        found: f64,
    },
    /// Number of points that is 0 or exceeds the maximum.
    #[error("{0} points (expected 1 to 10000)")]
    Count(usize),
}

/// Reads the points of a control curve: (profile angle \[°\], value in the unit of the device's states, \[°\] for
/// slats).
pub fn read_control_curve(bytes: &[u8]) -> Result<Vec<[f64; 2]>, CurveError> {
    let text = decode(not_too_long(bytes)?)?;
    let mut columns = [0, 1];
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut first = true;
    for (index, line) in text.lines().enumerate() {
        let line_number = index + 1;
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        // Commas and semicolons may stand beside blanks; without them blanks and tabs separate.
        let fields: Vec<&str> = match line.find([',', ';']) {
            Some(_) => line.split([',', ';']).map(str::trim).collect(),
            None => line.split_whitespace().collect(),
        };
        // A header is recognised as the first line with content that is not all numbers.
        if std::mem::take(&mut first) && fields.iter().any(|field| field.parse::<f64>().is_err()) {
            let named = |names: &[&str]| fields.iter().position(|field| names.contains(&field.trim_matches('"')));
            let found = named(&["profile_angle_deg"]).zip(named(&["value_deg", "value"]));
            let (angle, value) = found.ok_or(CurveError::Header { line: line_number })?;
            columns = [angle, value];
            continue;
        }
        let mut point = [0.0; 2];
        for (number, column) in point.iter_mut().zip(columns) {
            let field = fields.get(column).copied().unwrap_or("(missing)");
            // "nan" and "inf" are numbers to the parser, but no angles.
            let parsed = field.parse::<f64>().ok().filter(|value| value.is_finite());
            *number = parsed.ok_or_else(|| CurveError::Number {
                line: line_number,
                found: crate::formats::location::excerpt(field),
            })?;
        }
        if point[0].abs() > 90.0 {
            return Err(CurveError::Range { line: line_number, found: point[0] });
        }
        // Values are interpolated between neighbours: two at one angle would be a jump of no width.
        if points.last().is_some_and(|last| last[0] >= point[0]) {
            return Err(CurveError::Order { line: line_number, found: point[0] });
        }
        points.push(point);
        // Within the loop, so that a file of another kind is not read to its end first.
        if points.len() > CURVE_POINTS {
            return Err(CurveError::Count(points.len()));
        }
    }
    if points.is_empty() { Err(CurveError::Count(0)) } else { Ok(points) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_others_are_read() {
        let bare = "\u{feff}# retro\n0 90\n45\t45 # middle\n90 0\n";
        assert_eq!(read_control_curve(bare.as_bytes()).unwrap(), [[0.0, 90.0], [45.0, 45.0], [90.0, 0.0]]);
        let table = "profile_angle_deg,value_deg\n-10,75\n0.5,64.25\n60,-12\n";
        assert_eq!(read_control_curve(table.as_bytes()).unwrap(), [[-10.0, 75.0], [0.5, 64.25], [60.0, -12.0]]);
        let wide = "name;value_deg;profile_angle_deg\r\na;90;0\r\nb;80;10\r\n";
        assert_eq!(read_control_curve(wide.as_bytes()).unwrap(), [[0.0, 90.0], [10.0, 80.0]]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, words) in [
            ("", "0 points"),
            ("angle,slat\n0,1\n", "line 1"),
            ("0,1\n5,x\n", "line 2: \"x\""),
            ("0,1\n5\n", "line 2"),
            ("0,1\n0,2\n", "line 2: profile angle 0"),
            ("0,1\n95,2\n", "line 2: profile angle 95"),
            ("0,nan\n", "line 1"),
        ] {
            let error = read_control_curve(text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(words), "{text:?}: {error}");
        }
        assert!(matches!(read_control_curve(&[0x00, 0xff]), Err(CurveError::NotText(NotText { byte: 1, .. }))));
        assert_eq!(read_control_curve(b"# \xb0\r0,1\r5,2e-0001\r").unwrap(), [[0.0, 1.0], [5.0, 0.2]]);
    }
}
