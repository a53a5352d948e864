//! Perez all-weather skies: clearness and brightness of the sky from irradiances, coefficients of its luminance, and
//! luminous efficacies.
//!
//! Sources: Perez, Seals, Michalsky, "All-weather model for sky luminance distribution", Solar Energy 50 (1993)
//! 235–245; Perez, Ineichen, Seals, Michalsky, Stewart, "Modeling daylight availability …", Solar Energy 44 (1990)
//! 271–289 (efficacy); Kasten 1965 (air mass). E₀ = 1367 W/m² times the [`eccentricity`] of the earth's orbit where
//! there is a date.

use std::f64::consts::FRAC_PI_2;

/// Solar constant at the sun's mean distance. \[W/m²\] Value of Perez's model, used by Radiance's `gendaylit`.
pub const SOLAR_CONSTANT: f64 = 1367.0;
/// Lower limits of the clearness ε of the bins 2 … 8. Source: Perez et al. 1990, 1993.
const BIN_BORDERS: [f64; 7] = [1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2];

/// Water content of the air and distance to the sun, for the luminous efficacies of Perez's model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Irradiance of the sun outside the atmosphere relative to its mean: the square of the sun's mean distance over
    /// that of the day, see [`eccentricity`].
    pub eccentricity: f64,
    /// Precipitable water in the atmosphere. \[cm\]
    pub water: f64,
}

impl Air {
    /// Default without a date and with unknown water content: mean distance of the sun, 2 cm of precipitable water
    /// (Radiance's dew point of 11 °C).
    pub const UNKNOWN: Self = Self { eccentricity: 1.0, water: 2.0 };
}

/// Coefficients a₁…a₄, b₁…b₄, c₁…c₄, d₁…d₄, e₁…e₄ of the relative luminance per clearness bin. Source: Perez et al.
/// 1993.
const LUMINANCE: [[[f64; 4]; 5]; 8] = [
    [
        [1.3525, -0.2576, -0.2690, -1.4366],
        [-0.7670, 0.0007, 1.2734, -0.1233],
        [2.8000, 0.6004, 1.2375, 1.0000],
        [1.8734, 0.6297, 0.9738, 0.2809],
        [0.0356, -0.1246, -0.5718, 0.9938],
    ],
    [
        [-1.2219, -0.7730, 1.4148, 1.1016],
        [-0.2054, 0.0367, -3.9128, 0.9156],
        [6.9750, 0.1774, 6.4477, -0.1239],
        [-1.5798, -0.5081, -1.7812, 0.1080],
        [0.2624, 0.0672, -0.2190, -0.4285],
    ],
    [
        [-1.1000, -0.2515, 0.8952, 0.0156],
        [0.2782, -0.1812, -4.5000, 1.1766],
        [24.7219, -13.0812, -37.7000, 34.8438],
        [-5.0000, 1.5218, 3.9229, -2.6204],
        [-0.0156, 0.1597, 0.4199, -0.5562],
    ],
    [
        [-0.5484, -0.6654, -0.2672, 0.7117],
        [0.7234, -0.6219, -5.6812, 2.6297],
        [33.3389, -18.3000, -62.2500, 52.0781],
        [-3.5000, 0.0016, 1.1477, 0.1062],
        [0.4659, -0.3296, -0.0876, -0.0329],
    ],
    [
        [-0.6000, -0.3566, -2.5000, 2.3250],
        [0.2937, 0.0496, -5.6812, 1.8415],
        [21.0000, -4.7656, -21.5906, 7.2492],
        [-3.5000, -0.1554, 1.4062, 0.3988],
        [0.0032, 0.0766, -0.0656, -0.1294],
    ],
    [
        [-1.0156, -0.3670, 1.0078, 1.4051],
        [0.2875, -0.5328, -3.8500, 3.3750],
        [14.0000, -0.9999, -7.1406, 7.5469],
        [-3.4000, -0.1078, -1.0750, 1.5702],
        [-0.0672, 0.4016, 0.3017, -0.4844],
    ],
    [
        [-1.0000, 0.0211, 0.5025, -0.5119],
        [-0.3000, 0.1922, 0.7023, -1.6317],
        [19.0000, -5.0000, 1.2438, -1.9094],
        [-4.0000, 0.0250, 0.3844, 0.2656],
        [1.0468, -0.3788, -2.4517, 1.4656],
    ],
    [
        [-1.0500, 0.0289, 0.4260, 0.3590],
        [-0.3250, 0.1156, 0.7781, 0.0025],
        [31.0625, -14.5000, -46.1148, 55.3750],
        [-7.2312, 0.4050, 13.3500, 0.6234],
        [1.5000, -0.6426, 1.8564, 0.5636],
    ],
];

/// Coefficients of the luminous efficacy of diffuse light per clearness bin: a + b·W + c·cosZ + d·lnΔ. \[lm/W\] Source:
/// Perez et al. 1990.
const DIFFUSE_EFFICACY: [[f64; 4]; 8] = [
    [97.24, -0.46, 12.00, -8.91],
    [107.22, 1.15, 0.59, -3.95],
    [104.97, 2.96, -5.53, -8.77],
    [102.39, 5.59, -13.95, -13.90],
    [100.71, 5.94, -22.75, -23.74],
    [106.42, 3.83, -36.15, -28.83],
    [141.88, 1.90, -53.24, -14.03],
    [152.23, 0.35, -45.27, -7.98],
];

/// Coefficients of the luminous efficacy of direct sun per clearness bin: max(0, a + b·W + c·e^{5.73Z−5} + d·Δ).
/// \[lm/W\] Source: Perez et al. 1990.
const DIRECT_EFFICACY: [[f64; 4]; 8] = [
    [57.20, -4.55, -2.98, 117.12],
    [98.99, -3.46, -1.21, 12.38],
    [109.83, -4.90, -1.71, -8.81],
    [110.34, -5.84, -1.99, -4.56],
    [106.36, -3.97, -1.75, -6.16],
    [107.19, -1.25, -1.51, -26.73],
    [105.75, 0.77, -1.26, -34.44],
    [101.18, 1.58, -1.10, -8.29],
];

/// Returns (r₀/r)² of the earth's orbit, the irradiance of the sun outside the atmosphere relative to its mean, on a
/// day of the year counted from 1 (Spencer, "Fourier series representation of the position of the sun", Search 2 (1971)
/// 172).
pub fn eccentricity(day: u16) -> f64 {
    let angle = 2.0 * std::f64::consts::PI * (f64::from(day) - 1.0) / 365.0;
    let ((sin, cos), (sin_twice, cos_twice)) = (angle.sin_cos(), (2.0 * angle).sin_cos());
    1.00011 + 0.034_221 * cos + 0.00128 * sin + 0.000_719 * cos_twice + 0.000_077 * sin_twice
}

/// State of a Perez all-weather sky: clearness, brightness and the coefficients that follow from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PerezState {
    /// Clearness ε of the sky, 1 … 12.009.
    pub clearness: f64,
    /// Brightness Δ of the sky, 0.01 … 0.6, as used for the efficacies; for the luminance it is at least 0.2 if 1.065 <
    /// ε < 2.8.
    pub brightness: f64,
    /// Coefficients a, b, c, d, e of the relative luminance distribution.
    pub coefficients: [f64; 5],
    /// Zenith angle of the sun. \[rad\]
    zenith: f64,
    bin: usize,
    /// Precipitable water in the atmosphere. \[cm\]
    water: f64,
}

impl PerezState {
    /// Creates the state from the sun's altitude above the horizon \[rad\], direct normal and diffuse horizontal
    /// irradiance \[W/m²\], and the day's [`eccentricity`] (1 without a date), with an unknown water content of the
    /// air. `None` if the model is not defined: sun on or below the horizon, no diffuse irradiance, negative or
    /// infinite input.
    pub fn new(altitude: f64, direct_normal: f64, diffuse_horizontal: f64, eccentricity: f64) -> Option<Self> {
        (altitude > 0.0 && diffuse_horizontal > 0.0)
            .then(|| Self::in_air(altitude, direct_normal, diffuse_horizontal, Air { eccentricity, ..Air::UNKNOWN }))
            .flatten()
    }

    /// Creates the state for an hour of a weather year from the sun's altitude \[rad\], direct normal and diffuse
    /// horizontal irradiance \[W/m²\], and the air. An altitude of 0 is allowed (for twilight, when the sun is below
    /// the horizon); without diffuse irradiance the clearness has its upper limit. `None` if both irradiances are 0,
    /// and for negative or infinite input.
    pub fn in_air(altitude: f64, direct_normal: f64, diffuse_horizontal: f64, air: Air) -> Option<Self> {
        let valid = (0.0..=FRAC_PI_2 + 1e-12).contains(&altitude)
            && direct_normal >= 0.0
            && direct_normal.is_finite()
            && diffuse_horizontal >= 0.0
            && diffuse_horizontal.is_finite()
            && direct_normal + diffuse_horizontal > 0.0;
        if !valid {
            return None;
        }
        let zenith = (FRAC_PI_2 - altitude).max(0.0);
        let cubed = 1.041 * zenith.powi(3);
        let clearness = ((diffuse_horizontal + direct_normal) / diffuse_horizontal + cubed) / (1.0 + cubed);
        let clearness = clearness.clamp(1.0, 12.009);
        let air_mass = 1.0 / (zenith.cos() + 0.15 * (93.885 - zenith.to_degrees()).powf(-1.253));
        let brightness = (diffuse_horizontal * air_mass / (SOLAR_CONSTANT * air.eccentricity)).clamp(0.01, 0.6);
        let bin = BIN_BORDERS.iter().filter(|&&border| clearness >= border).count();
        let coefficients = luminance_coefficients(bin, clearness, brightness, zenith);
        Some(Self { clearness, brightness, coefficients, zenith, bin, water: air.water })
    }

    /// Returns the luminous efficacy of diffuse light from the sky. \[lm/W\]
    pub fn diffuse_efficacy(&self) -> f64 {
        let [a, b, c, d] = DIFFUSE_EFFICACY[self.bin];
        (a + b * self.water + c * self.zenith.cos() + d * self.brightness.ln()).max(0.0)
    }

    /// Returns the luminous efficacy of direct sun. \[lm/W\]
    pub fn direct_efficacy(&self) -> f64 {
        let [a, b, c, d] = DIRECT_EFFICACY[self.bin];
        (a + b * self.water + c * (5.73 * self.zenith - 5.0).exp() + d * self.brightness).max(0.0)
    }
}

/// Returns the coefficients a, b, c, d, e of the relative luminance, each x = x₁ + x₂Z + Δ(x₃ + x₄Z); in the first bin
/// c and d have different formulas (Perez 1993 eq 7, 8).
fn luminance_coefficients(bin: usize, clearness: f64, brightness: f64, zenith: f64) -> [f64; 5] {
    let delta = if clearness > 1.065 && clearness < 2.8 { brightness.max(0.2) } else { brightness };
    let rows = LUMINANCE[bin];
    let mut x = rows.map(|[x1, x2, x3, x4]| x1 + x2 * zenith + delta * (x3 + x4 * zenith));
    if bin == 0 {
        let [c1, c2, c3, c4] = rows[2];
        let [d1, d2, d3, d4] = rows[3];
        x[2] = (delta * (c1 + c2 * zenith)).powf(c3).exp() - c4;
        x[3] = -(delta * (d1 + d2 * zenith)).exp() + d3 + delta * d4;
    }
    // With a and b above 0 the luminance would grow without bound towards the horizon; b is limited to 0, a uniform
    // gradation. This occurs with a high sun in weather data with a wrong time stamp.
    if x[0] > 0.0 {
        x[1] = x[1].min(0.0);
    }
    x
}
