//! Charts with two logarithmic axes, as shapes of a [`Drawing`](super::drawing::Drawing).

use super::drawing::{Rgb, Shape};

/// Where a chart lies on the paper, and what its axes hold.
#[derive(Debug, Clone, PartialEq)]
pub struct LogChart {
    /// Left and right border. \[px\]
    pub left_right: [f64; 2],
    /// Upper and lower border. \[px\]
    pub top_bottom: [f64; 2],
    /// First and last power of ten along x.
    pub x: [i32; 2],
    /// First and last power of ten along y.
    pub y: [i32; 2],
}

/// The powers of ten that enclose the finite numbers above 0; at most `most` decades, the upper ones.
pub fn decades(values: impl IntoIterator<Item = f64>, most: i32) -> [i32; 2] {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        if value > 0.0 && value.is_finite() {
            (low, high) = (low.min(value), high.max(value));
        }
    }
    if low > high {
        return [0, 1];
    }
    let last = (high.log10() - 1e-9).ceil() as i32;
    let first = ((low.log10() + 1e-9).floor() as i32).min(last - 1);
    [first.max(last - most.max(1)), last]
}

impl LogChart {
    /// Place of a point; what lies below the axes' range, 0 included, is drawn on its border, what lies above as well.
    pub fn place(&self, x: f64, y: f64) -> [f64; 2] {
        let along = |value: f64, [first, last]: [i32; 2]| {
            let t = (value.max(f64::MIN_POSITIVE).log10() - f64::from(first)) / f64::from((last - first).max(1));
            t.clamp(0.0, 1.0)
        };
        let ([left, right], [top, bottom]) = (self.left_right, self.top_bottom);
        [left + (right - left) * along(x, self.x), bottom + (top - bottom) * along(y, self.y)]
    }

    /// Frame, a line at every decade and its label.
    pub fn frame(&self, ink: Rgb, faint: Rgb, label: impl Fn(bool, i32) -> String) -> Vec<Shape> {
        let mut shapes = Vec::new();
        let ([left, right], [top, bottom]) = (self.left_right, self.top_bottom);
        let line = |points: Vec<[f64; 2]>, colour| Shape::Line { points, colour, width: 1.0 };
        let every = |[first, last]: [i32; 2]| 1 + (last - first - 1).max(0) / 6;
        for power in (self.x[0]..=self.x[1]).filter(|power| (power - self.x[0]) % every(self.x) == 0) {
            let [at, _] = self.place(10_f64.powi(power), 1.0);
            shapes.push(line(vec![[at, top], [at, bottom]], faint));
            shapes.push(Shape::Text { at: [at, bottom + 14.0], text: label(true, power), colour: ink });
        }
        for power in (self.y[0]..=self.y[1]).filter(|power| (power - self.y[0]) % every(self.y) == 0) {
            let [_, at] = self.place(1.0, 10_f64.powi(power));
            shapes.push(line(vec![[left, at], [right, at]], faint));
            shapes.push(Shape::Text { at: [left - 36.0, at], text: label(false, power), colour: ink });
        }
        shapes.push(line(vec![[left, top], [right, top], [right, bottom], [left, bottom], [left, top]], ink));
        shapes
    }
}

/// A power of ten as a percentage: `1 %` for −2, `10^-4 %` for −6.
pub fn per_cent(power: i32) -> String {
    match power + 2 {
        power @ 0..=3 => format!("{} %", 10_i32.pow(power.unsigned_abs())),
        power @ -3..=-1 => format!("{:.*} %", power.unsigned_abs() as usize, 10_f64.powi(power)),
        power => format!("10^{power} %"),
    }
}

/// A power of ten seconds: `10 ms` for −2.
pub fn seconds(power: i32) -> String {
    let (unit, least) = match power {
        0.. => ("s", 0),
        -3..=-1 => ("ms", -3),
        -6..=-4 => ("µs", -6),
        _ => ("ns", -9),
    };
    match power - least {
        power @ 0..=3 => format!("{} {unit}", 10_i32.pow(power.unsigned_abs())),
        power => format!("10^{power} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_enclose() {
        assert_eq!(decades([0.002, 0.5], 12), [-3, 0]);
        assert_eq!(decades([1.0, 10.0, 0.0, f64::NAN], 12), [0, 1]);
        assert_eq!(decades([1e-15, 1.0], 6), [-6, 0]);
        assert_eq!(decades([], 6), [0, 1]);
        assert_eq!(decades([1.0], 6), [-1, 0]);
    }

    #[test]
    fn a_decade_is_a_constant_length_and_nothing_leaves_the_frame() {
        let chart = LogChart { left_right: [10.0, 110.0], top_bottom: [20.0, 60.0], x: [-2, 0], y: [-4, 0] };
        assert_eq!(chart.place(0.1, 1e-4), [60.0, 60.0]);
        assert_eq!(chart.place(1.0, 1.0), [110.0, 20.0]);
        assert_eq!(chart.place(0.0, 1e9), [10.0, 20.0]);
    }

    #[test]
    fn powers_in_words() {
        assert_eq!([-6, -3, -2, 0].map(per_cent), ["10^-4 %", "0.1 %", "1 %", "100 %"]);
        assert_eq!([-10, -5, -2, 1].map(seconds), ["10^-1 ns", "10 µs", "10 ms", "10 s"]);
    }
}
