//! Colours of the pictures: the two data maps and the neutral greys, for light and dark windows.

use crate::drawing::{Rgb, chart::SERIES};
use colorgrad::Gradient;
use egui::{Color32, Visuals};
use std::sync::LazyLock;

/// A map from 0 … 1 to a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// Viridis: luminance, illuminance, luminance coefficient.
    Sequential,
    /// Blue over white to red: differences, zero in the middle.
    Diverging,
    /// Greys, dark to light: transmittance where viridis means something else beside it.
    Grey,
}

fn table(gradient: &dyn Gradient) -> [Color32; 256] {
    std::array::from_fn(|i| {
        let [r, g, b, _] = gradient.at(i as f32 / 255.0).to_rgba8();
        Color32::from_rgb(r, g, b)
    })
}

static VIRIDIS: LazyLock<[Color32; 256]> = LazyLock::new(|| table(&colorgrad::preset::viridis()));

/// Red at first: drawn from its end.
static BLUE_TO_RED: LazyLock<[Color32; 256]> = LazyLock::new(|| table(&colorgrad::preset::rd_bu()));

impl ColourMap {
    /// Colour of a fraction; values outside 0 … 1 get the end colours, NaN the lower one.
    pub fn at(self, fraction: f32) -> Color32 {
        // A cast of NaN gives 0.
        let index = (fraction.clamp(0.0, 1.0) * 255.0).round() as usize;
        match self {
            Self::Sequential => VIRIDIS[index],
            Self::Diverging => BLUE_TO_RED[255 - index],
            Self::Grey => Color32::from_gray((45.0 + 195.0 * index as f32 / 255.0) as u8),
        }
    }
}

/// The greys and accents of one theme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Palette {
    /// Text and main lines.
    pub ink: Color32,
    /// Secondary text.
    pub weak: Color32,
    /// Grid lines.
    pub grid: Color32,
    /// Borders of pictures.
    pub outline: Color32,
    /// Ground of a picture without data.
    pub face: Color32,
    /// Ground behind text that lies on data.
    pub halo: Color32,
    /// First curve, selection.
    pub first: Color32,
    /// Second curve.
    pub second: Color32,
    /// The sun.
    pub sun: Color32,
    /// Unscattered light.
    pub beam: Color32,
    /// Series of a plot with many.
    pub series: [Color32; 5],
}

impl Palette {
    /// The colours that go with a theme.
    pub fn of(visuals: &Visuals) -> Self {
        let grey = Color32::from_gray;
        let rgb = |colours: [Rgb; 5]| colours.map(|[r, g, b]| Color32::from_rgb(r, g, b));
        if visuals.dark_mode {
            Self {
                ink: grey(225),
                weak: grey(160),
                grid: grey(62),
                outline: grey(115),
                face: grey(36),
                halo: Color32::from_black_alpha(150),
                first: Color32::from_rgb(86, 180, 233),
                second: Color32::from_rgb(230, 159, 0),
                sun: Color32::from_rgb(255, 205, 60),
                beam: Color32::from_rgb(255, 95, 85),
                series: rgb([[86, 180, 233], [230, 159, 0], [0, 190, 140], [225, 150, 195], [240, 120, 60]]),
            }
        } else {
            Self {
                ink: grey(30),
                weak: grey(95),
                grid: grey(215),
                outline: grey(130),
                face: grey(240),
                halo: Color32::from_white_alpha(190),
                first: Color32::from_rgb(0, 100, 165),
                second: Color32::from_rgb(200, 90, 0),
                sun: Color32::from_rgb(245, 170, 0),
                beam: Color32::from_rgb(215, 40, 40),
                series: rgb(SERIES),
            }
        }
    }
}

/// Black or white, whichever reads better on a ground.
pub fn contrast(ground: Color32) -> Color32 {
    let luminance = 0.2126 * f32::from(ground.r()) + 0.7152 * f32::from(ground.g()) + 0.0722 * f32::from(ground.b());
    if luminance > 120.0 { Color32::BLACK } else { Color32::WHITE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_run_from_end_to_end() {
        assert_eq!(ColourMap::Sequential.at(-1.0), ColourMap::Sequential.at(0.0));
        assert_eq!(ColourMap::Sequential.at(f32::NAN), ColourMap::Sequential.at(0.0));
        // Viridis gets lighter all the way: it can be read in grey.
        let light = |c: Color32| 0.2126 * f32::from(c.r()) + 0.7152 * f32::from(c.g()) + 0.0722 * f32::from(c.b());
        for k in 1..16 {
            let (a, b) = ((k - 1) as f32 / 15.0, k as f32 / 15.0);
            assert!(light(ColourMap::Sequential.at(b)) > light(ColourMap::Sequential.at(a)));
        }
    }
}
