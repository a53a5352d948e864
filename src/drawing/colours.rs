//! Colours of data and of their surroundings: colour maps, scales from values to colours, and the inks of a picture.

use super::{Rgb, ticks};
use colorgrad::Gradient;
use std::sync::LazyLock;

/// Colour map from 0 … 1 to a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// Viridis: luminance, illuminance, luminance coefficient.
    Sequential,
    /// Blue over white to red: differences, zero in the middle.
    Diverging,
    /// Greys, dark to light: transmittance where viridis has another meaning beside it.
    Grey,
}

fn table(gradient: &dyn Gradient) -> [Rgb; 256] {
    std::array::from_fn(|i| {
        let [r, g, b, _] = gradient.at(i as f32 / 255.0).to_rgba8();
        [r, g, b]
    })
}

static VIRIDIS: LazyLock<[Rgb; 256]> = LazyLock::new(|| table(&colorgrad::preset::viridis()));

/// Table of colours from red to blue, which is read from its end.
static BLUE_TO_RED: LazyLock<[Rgb; 256]> = LazyLock::new(|| table(&colorgrad::preset::rd_bu()));

impl ColourMap {
    /// Returns the colour of a fraction; values outside 0 … 1 get the end colours, NaN the lower one.
    pub fn rgb(self, fraction: f32) -> Rgb {
        // A cast of NaN gives 0.
        let index = (fraction.clamp(0.0, 1.0) * 255.0).round() as usize;
        match self {
            Self::Sequential => VIRIDIS[index],
            Self::Diverging => BLUE_TO_RED[255 - index],
            Self::Grey => [(45.0 + 195.0 * index as f32 / 255.0) as u8; 3],
        }
    }
}

/// Colour scale over lo … hi.
#[derive(Debug, Clone, PartialEq)]
pub struct ColourScale {
    /// Value of the first colour, positive when `log`.
    pub lo: f64,
    /// Value of the last colour, above `lo`.
    pub hi: f64,
    /// Whether the scale is logarithmic instead of linear.
    pub log: bool,
    /// Colour map.
    pub map: ColourMap,
}

impl ColourScale {
    /// Creates a scale from zero (linear) or `decades` below the top (log) to a round number at or above `max`.
    pub fn up_to(max: f64, log: bool, decades: i32, map: ColourMap) -> Self {
        let hi = if log { ticks::nice_ceil(max) } else { ticks::fine_ceil(max) };
        let lo = if log { hi * 10_f64.powi(-decades.max(1)) } else { 0.0 };
        Self { lo, hi, log, map }
    }

    /// Creates a logarithmic scale between round numbers around the data; at least one decade, at most six.
    pub fn log_around(min: f64, max: f64, map: ColourMap) -> Self {
        let hi = ticks::nice_ceil(max);
        let lo = 1.0 / ticks::nice_ceil(1.0 / min.clamp(hi * 1e-6, hi * 0.1));
        Self { lo, hi, log: true, map }
    }

    /// Returns the place of a value on the scale: 0 at `lo`, 1 at `hi`; not limited. Values without a logarithm are
    /// below the scale.
    pub fn fraction(&self, value: f64) -> f32 {
        if self.log {
            if value > 0.0 { ((value / self.lo).ln() / (self.hi / self.lo).ln()) as f32 } else { -1.0 }
        } else {
            ((value - self.lo) / (self.hi - self.lo)) as f32
        }
    }

    /// Returns the colour of a value on paper.
    pub fn rgb(&self, value: f64) -> Rgb {
        self.map.rgb(self.fraction(value))
    }

    /// Returns round values on the scale, at most about `count`.
    pub fn marks(&self, count: usize) -> Vec<f64> {
        if self.log { ticks::logarithmic(self.lo, self.hi, count) } else { ticks::linear(self.lo, self.hi, count) }
    }
}

/// Returns black or white, whichever is better legible on a ground.
pub fn contrast([r, g, b]: Rgb) -> Rgb {
    let luminance = 0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b);
    if luminance > 120.0 { [0; 3] } else { [255; 3] }
}

/// Returns a colour between two, `share` from 0 for `a` to 1 for `b`.
pub fn mixed(a: Rgb, b: Rgb, share: f64) -> Rgb {
    let part = |x: u8, y: u8| (f64::from(x) * (1.0 - share) + f64::from(y) * share).round() as u8;
    [part(a[0], b[0]), part(a[1], b[1]), part(a[2], b[2])]
}

/// Colours of the series; distinguishable with all common kinds of colour vision (after Okabe and Ito).
pub const SERIES: [Rgb; 5] = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [213, 94, 0]];

/// Colours of everything but the data, on white paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inks {
    /// Colour of text and main lines.
    pub ink: Rgb,
    /// Colour of secondary text.
    pub weak: Rgb,
    /// Colour of grid lines.
    pub grid: Rgb,
    /// Colour of the borders of pictures.
    pub outline: Rgb,
    /// Colour of the ground of a picture without data.
    pub face: Rgb,
    /// Colours of the curves, the most important first.
    pub series: [Rgb; 5],
    /// Whether the curves after the first are dashed: for prints without colours.
    pub dashes: bool,
    /// Colour of the sun.
    pub sun: Rgb,
    /// Colour of unscattered light.
    pub beam: Rgb,
}

impl Inks {
    /// Colours as on a light screen.
    pub const LIGHT: Self = Self {
        ink: [30; 3],
        weak: [95; 3],
        grid: [221; 3],
        outline: [130; 3],
        face: [240; 3],
        series: SERIES,
        dashes: false,
        sun: [245, 170, 0],
        beam: [215, 40, 40],
    };

    /// Colours for printers: black text and frames, and curves that are distinguished without colours too.
    pub const PRINT: Self = Self {
        ink: [0; 3],
        weak: [40; 3],
        grid: [190; 3],
        outline: [0; 3],
        face: [255; 3],
        series: [[0; 3], [90; 3], [0, 90, 130], [130, 60, 0], [60, 60, 60]],
        dashes: true,
        sun: [255, 255, 255],
        beam: [0; 3],
    };

    /// Returns the line of a curve by its number.
    pub fn curve(&self, number: usize, points: Vec<super::Point>, width: f64) -> super::Shape {
        const DASHES: [[f64; 2]; 4] = [[7.0, 3.0], [2.0, 2.5], [10.0, 4.0], [4.0, 5.0]];
        let colour = self.series[number % self.series.len()];
        match number.checked_sub(1) {
            Some(k) if self.dashes => super::Shape::dashed(points, colour, width, DASHES[k % DASHES.len()]),
            _ => super::Shape::line(points, colour, width),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_run_from_end_to_end() {
        let rgb = |fraction| ColourMap::Sequential.rgb(fraction);
        assert_eq!((rgb(-1.0), rgb(f32::NAN)), (rgb(0.0), rgb(0.0)));
        // Viridis gets lighter all the way: it can be read in grey.
        let light = |[r, g, b]: Rgb| 0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b);
        for k in 1..16 {
            let (a, b) = ((k - 1) as f32 / 15.0, k as f32 / 15.0);
            assert!(light(rgb(b)) > light(rgb(a)));
        }
    }

    #[test]
    fn fractions_run_from_end_to_end() {
        for scale in [
            ColourScale::up_to(0.37, true, 3, ColourMap::Sequential),
            ColourScale::up_to(812.0, false, 3, ColourMap::Sequential),
            ColourScale::log_around(3.0, 4000.0, ColourMap::Sequential),
        ] {
            assert!(scale.hi > scale.lo);
            for k in 0..=10 {
                let f = f64::from(k) / 10.0;
                let value = if scale.log {
                    scale.lo * (scale.hi / scale.lo).powf(f)
                } else {
                    scale.lo + f * (scale.hi - scale.lo)
                };
                assert!((f64::from(scale.fraction(value)) - f).abs() < 1e-6);
            }
        }
        let log = ColourScale::up_to(1.0, true, 3, ColourMap::Sequential);
        assert_eq!(log.rgb(0.0), log.rgb(1e-9));
        let around = ColourScale::log_around(3.0, 4000.0, ColourMap::Sequential);
        assert!((around.lo - 2.0).abs() < 1e-12 && (around.hi - 5000.0).abs() < 1e-9);
    }
}
