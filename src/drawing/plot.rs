//! Content of a plot, independent of how it is drawn: axes with units, series of points, and lines for comparison.
//!
//! The window draws it by egui_plot (`app::paint::plot`), files by [`chart`](super::chart), from the same numbers. Both
//! measure along an axis by its *coordinate*: the value itself or, on a logarithmic axis, its decimal logarithm.

use super::ticks;
use crate::texts::{tiles as say, words::MONTHS};

/// Unit of the quantity on an axis, which determines ticks and labels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Unit written after the name of the axis; empty for plain numbers.
    Named(&'static str),
    /// Degrees, with ticks at customary angles (multiples of 5, 15, 30, 45 or 90).
    Degrees,
    /// Hours of a day, 0 … 24.
    Hours,
    /// Days of a year of 365 days, counted from 0, with ticks at the first days of months.
    Days,
    /// Seconds; the label of each tick has the suitable multiple (s, ms, µs, ns).
    Seconds,
    /// Fractions of one, labelled in per cent.
    Share,
}

/// Axis of a plot. Its coordinate is the value itself or, if it is logarithmic, the decimal logarithm of the value.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name of the quantity on the axis, without unit.
    pub name: String,
    /// Unit of the values.
    pub unit: Unit,
    /// Whether the axis is logarithmic.
    pub log: bool,
    /// First and last value of the initial view, in the unit of the axis; positive when `log`.
    pub range: [f64; 2],
}

impl Axis {
    /// Creates a linear axis from the lower to the upper of two values.
    pub fn linear([lo, hi]: [f64; 2], name: impl Into<String>, unit: Unit) -> Self {
        Self { name: name.into(), unit, log: false, range: [lo, if hi > lo { hi } else { lo + 1.0 }] }
    }

    /// Creates a logarithmic axis from the lower to the upper of two positive values.
    pub fn log([lo, hi]: [f64; 2], name: impl Into<String>, unit: Unit) -> Self {
        let lo = if lo > 0.0 { lo } else { 1e-6 };
        Self { name: name.into(), unit, log: true, range: [lo, if hi > lo { hi } else { 10.0 * lo }] }
    }

    /// Creates a logarithmic axis over the powers of ten that enclose all finite values above 0. `most`: maximum number
    /// of decades; beyond it the lower ones are left out.
    pub fn decades(values: impl IntoIterator<Item = f64>, most: i32, name: &str, unit: Unit) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            if value > 0.0 && value.is_finite() {
                (low, high) = (low.min(value), high.max(value));
            }
        }
        if low > high {
            return Self::log([1.0, 10.0], name, unit);
        }
        let last = (high.log10() - 1e-9).ceil() as i32;
        let first = ((low.log10() + 1e-9).floor() as i32).min(last - 1);
        Self::log([first.max(last - most.max(1)), last].map(|power| 10_f64.powi(power)), name, unit)
    }

    /// Returns the title of the axis, "name / unit"; units that stand at the ticks are not repeated.
    pub fn title(&self) -> String {
        format!("{}{}", self.name, self.unit_part())
    }

    /// Returns the unit alone, as title of an axis without space for its name.
    pub fn short_title(&self) -> String {
        self.unit_part().trim_start_matches(" / ").to_owned()
    }

    /// Returns the unit as it follows the name in a title: " / unit", or nothing where it stands at the ticks.
    fn unit_part(&self) -> String {
        match self.unit {
            Unit::Named(unit) if unit.contains('/') => format!(" / ({unit})"),
            Unit::Named(unit) if !unit.is_empty() => format!(" / {unit}"),
            Unit::Degrees => " / °".to_owned(),
            _ => String::new(),
        }
    }

    /// Returns the coordinate of a value along the axis (the value, or its decimal logarithm); `None` if it is not a
    /// number. A value without a logarithm lies at the lower end of the range.
    pub fn coordinate(&self, value: f64) -> Option<f64> {
        let [lo, hi] = self.range;
        match (self.log, value) {
            (false, value) => value.is_finite().then_some(value),
            (true, value) if value.is_nan() => None,
            (true, value) if value <= 0.0 => Some(lo.log10()),
            (true, value) => Some(if value.is_infinite() { hi } else { value }.log10()),
        }
    }

    /// Returns the value at a coordinate of the axis: the inverse of [`Axis::coordinate`].
    pub fn value(&self, coordinate: f64) -> f64 {
        if self.log { 10_f64.powf(coordinate) } else { coordinate }
    }

    /// Returns the coordinates of the two ends of the axis' range: the values, or on a logarithmic axis their decimal
    /// logarithms.
    pub fn ends(&self) -> [f64; 2] {
        self.range.map(|end| if self.log { end.log10() } else { end })
    }

    /// Returns ticks for the part of the axis between the coordinates `from` and `to`: coordinates of about `count`
    /// round values, rising.
    pub fn marks(&self, [from, to]: [f64; 2], count: usize) -> Vec<f64> {
        let [lo, hi] = [from, to].map(|end| self.value(end));
        if self.log {
            let marks = ticks::logarithmic(lo, hi, count);
            // Within a decade there may be none of 1, 2, 5.
            let marks = if marks.len() > 1 { marks } else { ticks::linear(lo, hi, count) };
            return marks.into_iter().map(f64::log10).collect();
        }
        let least = (hi - lo) / count.max(1) as f64;
        let steps: &[f64] = match self.unit {
            Unit::Degrees => &[5.0, 15.0, 30.0, 45.0, 90.0],
            Unit::Hours => &[1.0, 3.0, 6.0, 12.0],
            Unit::Days => {
                let months = FIRST.into_iter().filter(|first| (lo..=hi).contains(first));
                let every = (least / 31.0).ceil().max(1.0) as usize;
                let marks: Vec<f64> = months.step_by(every).collect();
                return if marks.len() > 1 { marks } else { ticks::linear(lo, hi, count) };
            }
            _ => &[],
        };
        match steps.iter().find(|step| **step >= least && least > 0.4 * steps[0]) {
            Some(step) => ticks::multiples(lo, hi, *step),
            None => ticks::linear(lo, hi, count),
        }
    }

    /// Returns the label of a tick at `coordinate`, with as many digits as distinguish it from a neighbour that is
    /// `step` away. Both are coordinates of the axis: values, or decimal logarithms.
    pub fn tick(&self, coordinate: f64, step: f64) -> String {
        let value = self.value(coordinate);
        let step = if self.log { self.value(coordinate + step) - value } else { step };
        self.words(value, |number| ticks::fine_tick(number, step * (number / value)))
    }

    /// Returns a value as text with its unit, to three significant digits.
    pub fn text(&self, value: f64) -> String {
        match self.unit {
            Unit::Named(unit) => ticks::si(value, unit).trim_end().to_owned(),
            Unit::Degrees => format!("{}°", ticks::number(value, 3)),
            _ => self.words(value, |number| ticks::number(number, 3)),
        }
    }

    /// Returns a number as text, with the unit where it belongs to the tick. `number`: formats the scaled value.
    fn words(&self, value: f64, number: impl Fn(f64) -> String) -> String {
        // Powers of ten must not fall short of their unit by rounding.
        let reaches = |least: f64| value.abs() >= least * (1.0 - 1e-9);
        let (scale, unit) = match self.unit {
            Unit::Named(_) | Unit::Degrees => return number(value),
            Unit::Hours => return format!("{} h", number(value)),
            Unit::Days => return date(value),
            Unit::Share => (100.0, "%"),
            Unit::Seconds if reaches(1.0) => (1.0, "s"),
            Unit::Seconds if reaches(1e-3) => (1e3, "ms"),
            Unit::Seconds if reaches(1e-6) => (1e6, "µs"),
            Unit::Seconds => (1e9, "ns"),
        };
        let power = (value.abs() * scale).log10() + 1e-9;
        if value == 0.0 || (-3.0..4.0).contains(&power) {
            return format!("{} {unit}", number(value * scale));
        }
        let power = power.floor() as i32;
        let mantissa = ticks::tick(value * scale / 10_f64.powi(power));
        if mantissa == "1" { format!("10^{power} {unit}") } else { format!("{mantissa}·10^{power} {unit}") }
    }
}

/// First days of the months of a common year, counted from 0.
const FIRST: [f64; 12] = [0.0, 31.0, 59.0, 90.0, 120.0, 151.0, 181.0, 212.0, 243.0, 273.0, 304.0, 334.0];

/// Returns a day of a common year (counted from 0) in words: the month alone on its first day, else day and month.
fn date(day: f64) -> String {
    let Some(month) = FIRST.iter().rposition(|first| *first <= day && day < 365.0) else { return String::new() };
    let past = (day - FIRST[month]).floor();
    if past > 0.0 { say::day_month(past + 1.0, MONTHS[month]) } else { MONTHS[month].into() }
}

/// Style in which the points of a series are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Line through the points, without marks.
    Line,
    /// Line through the points, with a mark at each.
    Marked,
    /// Dot at each point, without a line.
    Dots,
}

/// Series of a plot: points under one name in the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Points as values on the x and y axes, in the axes' units; a value that is not a number interrupts the line.
    pub points: Vec<[f64; 2]>,
    /// Band around the line: lowest and highest y value at each point; empty if there is no band.
    pub band: Vec<[f64; 2]>,
    /// Style in which the points are drawn.
    pub form: Form,
}

impl Series {
    /// Creates a series that is drawn as a line without marks and without a band, from its points (values on x and y).
    pub fn line(name: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), band: Vec::new(), form: Form::Line }
    }
}

/// Straight line for comparison, such as a limit or the present value.
#[derive(Debug, Clone, PartialEq)]
pub struct Guide {
    /// Name written at the line's end; may be empty.
    pub name: String,
    /// Ends of the line, each as values on the x and y axes.
    pub ends: [[f64; 2]; 2],
}

/// Plot: two axes, the series of points, and lines for comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Horizontal axis, to the right.
    pub x: Axis,
    /// Vertical axis, upwards.
    pub y: Axis,
    /// Series, the most important first; their order determines colours and legend.
    pub series: Vec<Series>,
    /// Lines for comparison, drawn behind the series.
    pub guides: Vec<Guide>,
}

impl Guide {
    /// Whether the line is level, so that its name may be anywhere along it.
    pub const fn is_level(&self) -> bool {
        self.ends[0][1] == self.ends[1][1]
    }
}

impl Plot {
    /// Returns the axis coordinates of a point given by its values on x and y (on a logarithmic axis the decimal
    /// logarithm); `None` if one is not a number.
    pub fn place(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        Some([self.x.coordinate(x)?, self.y.coordinate(y)?])
    }

    /// Returns the line of a series in axis coordinates, as pieces that are interrupted where a value is missing.
    pub fn runs(&self, series: &Series) -> Vec<Vec<[f64; 2]>> {
        parted(series.points.iter().map(|point| self.place(*point)))
    }

    /// Returns the band of a series in axis coordinates, as pieces that are interrupted where a value is missing; each
    /// point is x, lowest y and highest y.
    pub fn bands(&self, series: &Series) -> Vec<Vec<[f64; 3]>> {
        parted(series.points.iter().zip(&series.band).map(|([x, _], [low, high])| {
            Some([self.x.coordinate(*x)?, self.y.coordinate(*low)?, self.y.coordinate(*high)?])
        }))
    }
}

/// Whether one of the lines, each given by its points, passes through the rectangle with the ranges `x` and `y`, in the
/// coordinates of the points.
pub fn crosses(lines: &[Vec<[f64; 2]>], x: [f64; 2], y: [f64; 2]) -> bool {
    let passes = |pair: &[[f64; 2]]| {
        let [a, b] = if pair[0][0] <= pair[1][0] { [pair[0], pair[1]] } else { [pair[1], pair[0]] };
        if b[0] < x[0] || a[0] > x[1] {
            return false;
        }
        let at = |end: f64| a[1] + (b[1] - a[1]) * (end.clamp(a[0], b[0]) - a[0]) / (b[0] - a[0]);
        let [from, to] = if b[0] > a[0] { x.map(at) } else { [a[1], b[1]] };
        from.min(to) <= y[1] && from.max(to) >= y[0]
    };
    lines.iter().any(|line| line.windows(2).any(passes))
}

/// Splits a sequence into its longest runs without a missing item.
fn parted<T>(items: impl Iterator<Item = Option<T>>) -> Vec<Vec<T>> {
    let mut runs = vec![Vec::new()];
    for item in items {
        match (item, runs.last_mut()) {
            (Some(item), Some(run)) => run.push(item),
            (None, Some(run)) if !run.is_empty() => runs.push(Vec::new()),
            _ => {}
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_enclose() {
        let of = |values: &[f64], most| Axis::decades(values.iter().copied(), most, "", Unit::Seconds).ends();
        assert_eq!(of(&[0.002, 0.5], 12), [-3.0, 0.0]);
        assert_eq!(of(&[1.0, 10.0, 0.0, f64::NAN], 12), [0.0, 1.0]);
        assert_eq!(of(&[1e-15, 1.0], 6), [-6.0, 0.0]);
        assert_eq!(of(&[], 6), [0.0, 1.0]);
        assert_eq!(of(&[1.0], 6), [-1.0, 0.0]);
    }

    #[test]
    fn ticks_carry_units_and_tell_neighbours_apart() {
        let axis = |unit| Axis::log([1e-12, 10.0], "error", unit);
        let powers = |unit, powers: [i32; 4]| powers.map(|power| axis(unit).tick(f64::from(power), 1.0));
        assert_eq!(powers(Unit::Share, [-6, -3, -2, 0]), ["10^-4 %", "0.1 %", "1 %", "100 %"]);
        assert_eq!(powers(Unit::Seconds, [-10, -5, -2, 1]), ["0.1 ns", "10 µs", "10 ms", "10 s"]);
        assert_eq!(axis(Unit::Seconds).text(0.0123), "12.3 ms");
        let lux = Axis::linear([0.0, 2e4], "E", Unit::Named("lx"));
        assert_eq!((lux.title(), lux.text(12_345.0)), ("E / lx".to_owned(), "12.3 klx".to_owned()));
        assert_eq!([10_010.0, 10_020.0].map(|value| lux.tick(value, 10.0)), ["10.01k", "10.02k"]);
        let angle = Axis::linear([0.0, 90.0], "profile angle", Unit::Degrees);
        assert_eq!(angle.marks([0.0, 90.0], 6), [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0]);
        assert_eq!(angle.title(), "profile angle / °");
        let year = Axis::linear([0.0, 365.0], "", Unit::Days);
        assert_eq!(year.marks([0.0, 365.0], 4), [0.0, 90.0, 181.0, 273.0]);
        assert_eq!([0.0, 44.0, 334.0, 365.0].map(|day| year.tick(day, 1.0)), ["Jan", "14 Feb", "Dec", ""]);
        assert_eq!(Axis::linear([0.0, 24.0], "", Unit::Hours).marks([0.0, 24.0], 4), [0.0, 6.0, 12.0, 18.0, 24.0]);
        // Within a decade, where there is no power of ten.
        assert_eq!(axis(Unit::Share).marks([6.0_f64.log10(), 9.0_f64.log10()], 4).len(), 4);
    }

    #[test]
    fn lines_cross_what_lies_between_their_points() {
        let lines = [vec![[0.0, 0.0], [10.0, 10.0], [10.0, 20.0], [5.0, 20.0]]];
        for (x, y, crossed) in [
            ([4.0, 6.0], [4.0, 6.0], true),
            ([4.0, 6.0], [6.5, 19.0], false),
            ([9.5, 11.0], [14.0, 15.0], true),
            ([10.5, 11.0], [14.0, 15.0], false),
            ([6.0, 7.0], [19.0, 21.0], true),
        ] {
            assert_eq!(crosses(&lines, x, y), crossed, "{x:?} {y:?}");
        }
    }

    #[test]
    fn what_is_no_number_parts_a_line_and_zero_lies_at_the_end_of_a_logarithm() {
        let mut series = Series::line("", [[0.0, 1.0], [1.0, f64::NAN], [2.0, 0.0], [3.0, 100.0], [f64::NAN, 1.0]]);
        series.band = vec![[1.0, 10.0]; 5];
        let (x, y) = (Axis::linear([0.0, 3.0], "", Unit::Named("m")), Axis::log([0.1, 100.0], "", Unit::Share));
        let plot = Plot { x, y, series: vec![series], guides: vec![] };
        assert_eq!(plot.runs(&plot.series[0]), [vec![[0.0, 0.0]], vec![[2.0, -1.0], [3.0, 2.0]]]);
        let bands = plot.bands(&plot.series[0]);
        assert_eq!((bands.len(), bands[0].len(), bands[0][1]), (1, 4, [1.0, 0.0, 1.0]));
        assert!(plot.x.coordinate(f64::INFINITY).is_none() && plot.y.coordinate(f64::INFINITY) == Some(2.0));
    }
}
