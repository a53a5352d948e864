//! Colours of the pictures: the colour maps of data and the neutral greys, for the light and the dark theme.

use crate::drawing::{Rgb, chart::SERIES, colours};
use egui::{Color32, Visuals};

pub use crate::drawing::colours::ColourMap;

/// Colours of a colour map in the window.
pub trait ColourMapExt {
    /// Returns the colour at a fraction of the colour map, 0 (lower end) … 1 (upper end); fractions outside get the end
    /// colours, NaN the lower one.
    fn at(self, fraction: f32) -> Color32;
}

impl ColourMapExt for ColourMap {
    fn at(self, fraction: f32) -> Color32 {
        let [r, g, b] = self.rgb(fraction);
        Color32::from_rgb(r, g, b)
    }
}

/// Grey tones and accent colours of the pictures in one theme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Palette {
    /// Colour of text and main lines.
    pub ink: Color32,
    /// Colour of secondary text.
    pub weak: Color32,
    /// Colour of grid lines.
    pub grid: Color32,
    /// Colour of borders of pictures.
    pub outline: Color32,
    /// Background of a picture where there are no data.
    pub face: Color32,
    /// Background of text that is drawn over coloured data, translucent.
    pub halo: Color32,
    /// Colour of the first curve and of the selection.
    pub first: Color32,
    /// Colour of the second curve.
    pub second: Color32,
    /// Colour of the sun.
    pub sun: Color32,
    /// Colour of parts of a picture in the sun.
    pub sunlit: Color32,
    /// Colour of parts of a picture in the shade.
    pub shade: Color32,
    /// Colour of unscattered transmitted light, i.e. of the direct beam.
    pub beam: Color32,
    /// Colours of the series of a plot with more than two.
    pub series: [Color32; 5],
}

impl Palette {
    /// Returns the colours for the theme of these visuals, light or dark.
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
                sunlit: Color32::from_rgb(112, 100, 66),
                shade: grey(56),
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
                sunlit: Color32::from_rgb(250, 238, 200),
                shade: grey(165),
                beam: Color32::from_rgb(215, 40, 40),
                series: rgb(SERIES),
            }
        }
    }
}

/// Returns black or white, whichever is more readable as text on a background of the given colour.
pub fn contrast(ground: Color32) -> Color32 {
    let [r, g, b] = colours::contrast([ground.r(), ground.g(), ground.b()]);
    Color32::from_rgb(r, g, b)
}
