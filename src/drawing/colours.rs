//! Colours of data and of everything around them: colour maps, scales from values to colours, and the set of colours of
//! a picture ([`Inks`]).

use super::{Rgb, ticks};
use colorgrad::Gradient;
use std::sync::LazyLock;

/// Colour map: assigns a colour to each fraction 0 … 1 of a scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// Viridis, dark violet to yellow: for luminance, illuminance and luminance coefficient.
    Sequential,
    /// Blue over white to red: for differences, with zero in the middle.
    Diverging,
    /// Greys, dark to light: for transmittance, where viridis shows another quantity beside it.
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
    /// Returns the colour of a fraction of the scale (0: lowest, 1: highest value); fractions outside 0 … 1 get the
    /// colours of the ends, NaN the lowest.
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

/// Colour scale: assigns a colour to each value between its two ends, linearly or logarithmically.
#[derive(Debug, Clone, PartialEq)]
pub struct ColourScale {
    /// Value of the first colour, in the unit of the quantity shown; positive when `log`.
    pub lo: f64,
    /// Value of the last colour, in the unit of the quantity shown; above `lo`.
    pub hi: f64,
    /// Whether the scale is logarithmic instead of linear.
    pub log: bool,
    /// Colours of the scale, from `lo` to `hi`.
    pub map: ColourMap,
}

impl ColourScale {
    /// Creates a scale that ends at a round number at or above `max` (in the unit of the quantity shown), and begins at
    /// zero, or `decades` powers of ten below its end when `log`.
    pub fn up_to(max: f64, log: bool, decades: i32, map: ColourMap) -> Self {
        let hi = if log { ticks::nice_ceil(max) } else { ticks::fine_ceil(max) };
        let lo = if log { hi * 10_f64.powi(-decades.max(1)) } else { 0.0 };
        Self { lo, hi, log, map }
    }

    /// Creates a logarithmic scale from a round number at or below `min` to one at or above `max`, the ends of the data
    /// in their unit; it has at least one decade and at most six.
    pub fn log_around(min: f64, max: f64, map: ColourMap) -> Self {
        let hi = ticks::nice_ceil(max);
        let lo = 1.0 / ticks::nice_ceil(1.0 / min.clamp(hi * 1e-6, hi * 0.1));
        Self { lo, hi, log: true, map }
    }

    /// Returns the position of a value on the scale: 0 at `lo`, 1 at `hi`, less or more for values beyond these ends.
    /// Values without a logarithm are below a logarithmic scale: −1.
    pub fn fraction(&self, value: f64) -> f32 {
        if self.log {
            if value > 0.0 { ((value / self.lo).ln() / (self.hi / self.lo).ln()) as f32 } else { -1.0 }
        } else {
            ((value - self.lo) / (self.hi - self.lo)) as f32
        }
    }

    /// Returns the colour of a value; values beyond the ends of the scale get the colours of its ends.
    pub fn rgb(&self, value: f64) -> Rgb {
        self.map.rgb(self.fraction(value))
    }

    /// Returns round values on the scale at which it can be labelled, at most about `count`.
    pub fn marks(&self, count: usize) -> Vec<f64> {
        if self.log { ticks::logarithmic(self.lo, self.hi, count) } else { ticks::linear(self.lo, self.hi, count) }
    }
}

/// Returns black or white, whichever is better legible on a background of the given colour.
pub fn contrast([r, g, b]: Rgb) -> Rgb {
    let luminance = 0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b);
    if luminance > 120.0 { [0; 3] } else { [255; 3] }
}

/// Returns the mixture of two colours in sRGB values; `share` runs from 0 for `a` to 1 for `b`.
pub fn mixed(a: Rgb, b: Rgb, share: f64) -> Rgb {
    let part = |x: u8, y: u8| (f64::from(x) * (1.0 - share) + f64::from(y) * share).round() as u8;
    [part(a[0], b[0]), part(a[1], b[1]), part(a[2], b[2])]
}

/// Colours of the curves of a chart on screen, in the order of its series; distinguishable with all common kinds of
/// colour vision (after Okabe and Ito).
pub const SERIES: [Rgb; 5] = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [213, 94, 0]];

/// Set of colours for everything in a picture that no colour map colours: text, lines, curves and symbols, on white
/// paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inks {
    /// Colour of text and main lines.
    pub ink: Rgb,
    /// Colour of secondary text.
    pub weak: Rgb,
    /// Colour of grid lines.
    pub grid: Rgb,
    /// Colour of the border lines around charts, disks and colour scales.
    pub outline: Rgb,
    /// Background of a chart or disk where there are no data.
    pub face: Rgb,
    /// Colours of the curves, the most important first.
    pub series: [Rgb; 5],
    /// Whether all curves but the first are dashed, so that prints without colours distinguish them.
    pub dashes: bool,
    /// Colour of the symbol at the position of the sun.
    pub sun: Rgb,
    /// Colour of unscattered light: symbols of beams and of regular transmission.
    pub beam: Rgb,
}

impl Inks {
    /// Colours for screens with a light background.
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

    /// Colours for printers: black text and frames; curves differ by dashes as well, for prints without colours.
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

    /// Returns the line of a chart's curve in the colour (and, for print, the dashes) of its number, counted from 0.
    /// `points`, `width`: in drawing units.
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
