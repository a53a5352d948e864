//! CIE standard general skies: ISO 15469:2004 / CIE S 011, types 1 to 15. Type 16, the traditional overcast sky, has
//! its own closed form in `distribution`.

use super::gradated::Gradated;
use std::f64::consts::FRAC_PI_2;

/// Parameters of the gradation a, b and of the scattering indicatrix c, d, e of the sky types 1 to 15. Source: ISO
/// 15469:2004, table 1.
const PARAMETERS: [[f64; 5]; 15] = [
    [4.0, -0.70, 0.0, -1.0, 0.0],
    [4.0, -0.70, 2.0, -1.5, 0.15],
    [1.1, -0.80, 0.0, -1.0, 0.0],
    [1.1, -0.80, 2.0, -1.5, 0.15],
    [0.0, -1.00, 0.0, -1.0, 0.0],
    [0.0, -1.00, 2.0, -1.5, 0.15],
    [0.0, -1.00, 5.0, -2.5, 0.30],
    [0.0, -1.00, 10.0, -3.0, 0.45],
    [-1.0, -0.55, 2.0, -1.5, 0.15],
    [-1.0, -0.55, 5.0, -2.5, 0.30],
    [-1.0, -0.55, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 16.0, -3.0, 0.30],
    [-1.0, -0.15, 16.0, -3.0, 0.30],
    [-1.0, -0.15, 24.0, -2.8, 0.15],
];

/// Returns the relative luminance φ(Z)·f(χ) of a CIE sky type 1 … 15; `None` for other numbers. f(χ) = 1 + c·(e^{dχ} −
/// e^{dπ/2}) + e·cos²χ
pub(super) fn gradated(sky_type: u8) -> Option<Gradated> {
    let [a, b, c, d, e] = *PARAMETERS.get(usize::from(sky_type).checked_sub(1)?)?;
    Some(Gradated { a, b, base: 1.0 - c * (d * FRAC_PI_2).exp(), c, d, e })
}

/// Whether the luminance of a CIE sky type 1 … 16 depends on the position of the sun; `false` for other numbers.
pub fn needs_sun(sky_type: u8) -> bool {
    gradated(sky_type).is_some_and(|sky| sky.c != 0.0 || sky.e != 0.0)
}
