//! Records of a file: the lines of numbers after the header.

use super::frame::Naming;
use super::{MOST_INCIDENCES, MOST_VALUES};
use crate::compute::btdf::Finding;
use crate::compute::direction::{Dir, Facade};
use crate::compute::limits;
use crate::formats::location::{FormatError, Location, excerpt};

/// Maximum luminance coefficient that is accepted: all light within 0.001°, more than a goniophotometer can resolve.
/// \[1/sr\]
const LARGEST_Q: f64 = limits::COEFFICIENT;

/// Incident direction of a record, as the file states it and as it is stored.
#[derive(Debug, Clone, Copy)]
pub(super) struct Incidence {
    /// Line number of its (first) record, from 1.
    pub line: usize,
    /// Polar angle as the file gives it. \[°\]
    pub theta: f64,
    /// Azimuth as the file gives it. \[°\]
    pub phi: f64,
    /// Stored direction, see [`super::frame`].
    pub name: Dir<Facade>,
}

/// Value of q at an emergent direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    /// Stored direction of the emergent light, see [`super::frame`].
    pub name: Dir<Facade>,
    /// Luminance coefficient q. \[1/sr\]
    pub q: f64,
}

/// Maximum measurement noise around zero, relative to the largest value of the file: negative values within it are set
/// to 0.
const NOISE: f64 = 1e-3;

/// Negative values of a file: their number, the lowest of them and its position.
#[derive(Debug, Default)]
struct Below {
    count: usize,
    least: f64,
    place: Option<Location>,
}

impl Below {
    /// Counts a negative value and returns the 0 that replaces it.
    #[cold]
    fn take(&mut self, line: &Line, field: &str, value: f64) -> f64 {
        self.count += 1;
        if value < self.least {
            (self.least, self.place) = (value, Some(line.at(field)));
        }
        0.0
    }

    /// Returns a finding on noise, or an error at the lowest value if it is beyond the noise. `largest`: largest value
    /// of the file.
    fn judged(self, largest: f64) -> Result<Option<Finding>, FormatError> {
        let Some(place) = self.place else { return Ok(None) };
        if -self.least > NOISE * largest {
            return Err(FormatError::new(
                place,
                format!("the negative value {:e}, beyond the noise of a measurement", self.least),
                format!(
                    "values of 0 or more in 1/sr (down to -{NOISE} of the largest, {largest:e}, they are set to 0)"
                ),
            ));
        }
        let share = if largest > 0.0 { -self.least / largest } else { 0.0 };
        let text = format!(
            "{} negative values, down to {:.2e} 1/sr or {:.3} % of the largest, were set to 0 as measuring noise.",
            self.count,
            self.least,
            100.0 * share
        );
        Ok(Some(Finding::info("negative-values", text)))
    }
}

/// Line of a file with numbers, read from left to right.
struct Line<'a> {
    text: &'a str,
    number: usize,
    fields: std::str::SplitAsciiWhitespace<'a>,
}

/// Returns the lines that hold records, without comments and blank lines.
fn lines(body: &str, first_line: usize) -> impl Iterator<Item = Line<'_>> {
    body.split('\n').enumerate().filter_map(move |(k, text)| {
        let text = text.split_once('#').map_or(text, |(before, _)| before);
        let fields = text.split_ascii_whitespace();
        fields.clone().next().is_some().then_some(Line { text, number: first_line + k, fields })
    })
}

impl<'a> Line<'a> {
    fn at(&self, field: &str) -> Location {
        // Both lie in the same text.
        let offset = (field.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize).min(self.text.len());
        let column = self.text.get(..offset).map_or(offset, |before| before.chars().count()) + 1;
        Location::line_column(self.number, column)
    }

    /// Reads an angle: a finite number.
    fn angle(&mut self, what: &str, expected: &str) -> Result<f64, FormatError> {
        let Some(field) = self.fields.next() else {
            return Err(FormatError::new(Location::line(self.number), format!("no {what}"), expected));
        };
        match field.parse::<f64>() {
            Ok(number) if number.is_finite() && number.abs() <= 1e6 => Ok(number),
            _ => Err(FormatError::new(self.at(field), format!("'{}' for {what}", excerpt(field)), expected)),
        }
    }

    fn direction(&mut self, naming: Naming, what: &str) -> Result<(f64, f64, Dir<Facade>), FormatError> {
        let [low, high] = naming.range();
        let theta = self.angle(&format!("θ of the {what} direction"), &format!("degrees, {low}…{high}"))?;
        let phi = self.angle(&format!("φ of the {what} direction"), "degrees")?;
        let name = naming.name(theta, phi).ok_or_else(|| {
            FormatError::new(
                Location::line(self.number),
                format!("θ = {theta}° of the {what} direction"),
                format!("{low}…{high}° for this quantity and side"),
            )
        })?;
        Ok((theta, phi, name))
    }

    /// Reads a value of q: 0 or more, or slightly negative because of noise.
    fn value(&self, field: &str, below: &mut Below) -> Result<f64, FormatError> {
        // NaN and infinity fail both comparisons.
        match field.parse::<f64>() {
            Ok(value) if (0.0..=LARGEST_Q).contains(&value) => Ok(value),
            Ok(value) if (-LARGEST_Q..0.0).contains(&value) => Ok(below.take(self, field, value)),
            _ => Err(self.bad_value(field)),
        }
    }

    #[cold]
    fn bad_value(&self, field: &str) -> FormatError {
        let found = match field.parse::<f64>() {
            Ok(value) if value.is_finite() => format!("the value {}, which no cell can have", excerpt(field)),
            Ok(_) => format!("'{}', not a finite number", excerpt(field)),
            Err(_) if field.contains(',') => format!("'{}' (decimal or separating comma?)", excerpt(field)),
            Err(_) => format!("'{}', not a number", excerpt(field)),
        };
        FormatError::new(self.at(field), found, "a value of 0 or more in 1/sr, like 0.0131 or 1.3e-2, blanks between")
    }
}

/// Incident directions, and the values of q of all of them, one direction after the other.
pub(super) type Rings = (Vec<Incidence>, Vec<f64>);
/// Incident directions, each with its points (values of q at emergent directions).
pub(super) type Points = Vec<(Incidence, Vec<Point>)>;

/// Reads the layout `rings`. Returns the incident directions, their values one direction after the other in the file's
/// order of emergent cells, and a finding if negative noise was set to 0.
pub(super) fn ring_records(
    body: &str,
    first_line: usize,
    cells: usize,
    naming: Naming,
) -> Result<(Rings, Option<Finding>), FormatError> {
    let mut list = Vec::new();
    let mut below = Below::default();
    // Two bytes a value at least: memory follows the file's length, not what it claims.
    let mut values = Vec::with_capacity((body.len() / 2).min(145 * cells).min(MOST_VALUES));
    for mut line in lines(body, first_line) {
        let (theta, phi, name) = line.direction(naming, "incident")?;
        let before = values.len();
        while let Some(field) = line.fields.next() {
            values.push(line.value(field, &mut below)?);
        }
        let found = values.len() - before;
        if found != cells {
            let last = if body.len() < 2 || body.ends_with('\n') { "" } else { " (a file cut off?)" };
            return Err(FormatError::new(
                Location::line(line.number),
                format!("{found} values behind θ {theta}° φ {phi}°{last}"),
                format!("{cells}, one for every cell of rings"),
            ));
        }
        list.push(Incidence { line: line.number, theta, phi, name });
        if list.len() > MOST_INCIDENCES || values.len() > MOST_VALUES {
            return Err(too_many(line.number));
        }
    }
    let noise = below.judged(values.iter().copied().fold(0.0, f64::max))?;
    Ok(((list, values), noise))
}

fn too_many(line: usize) -> FormatError {
    FormatError::new(
        Location::line(line),
        "more data than are read",
        format!("at most {MOST_INCIDENCES} incidences and {MOST_VALUES} values"),
    )
}

/// Reads the layout `points`. Returns the incident directions, each with its points, and a finding if negative noise
/// was set to 0.
pub(super) fn point_records(
    body: &str,
    first_line: usize,
    incident: Naming,
    emergent: Naming,
) -> Result<(Points, Option<Finding>), FormatError> {
    let mut list: Points = Vec::new();
    let (mut count, mut largest, mut below) = (0, 0.0_f64, Below::default());
    for mut line in lines(body, first_line) {
        let (theta, phi, name) = line.direction(incident, "incident")?;
        let (_, _, out) = line.direction(emergent, "emergent")?;
        let Some(field) = line.fields.next() else {
            return Err(FormatError::new(Location::line(line.number), "four numbers", "five: θ_e φ_e θ_a φ_a q"));
        };
        let q = line.value(field, &mut below)?;
        largest = largest.max(q);
        if let Some(field) = line.fields.next() {
            return Err(FormatError::new(
                line.at(field),
                format!("a sixth number '{}'", excerpt(field)),
                "five: θ_e φ_e θ_a φ_a q",
            ));
        }
        let point = Point { name: out, q };
        match list.last_mut() {
            Some((last, points)) if last.theta == theta && last.phi == phi => points.push(point),
            _ => list.push((Incidence { line: line.number, theta, phi, name }, vec![point])),
        }
        count += 1;
        if list.len() > MOST_INCIDENCES || count > MOST_VALUES / 2 {
            return Err(too_many(line.number));
        }
    }
    Ok((list, below.judged(largest)?))
}
