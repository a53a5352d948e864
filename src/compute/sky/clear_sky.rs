//! Irradiances and illuminances of a clear sky, from the sun's altitude, the air's turbidity and the elevation.
//!
//! Sources: Ineichen, Perez, "A new airmass independent formulation for the Linke turbidity coefficient", Solar Energy
//! 73 (2002) 151–157; air mass of Kasten, Young 1989 times the pressure of the standard atmosphere; luminous efficacy
//! of Perez 1990 ([`PerezState`]). The ±3 % by which the distance to the sun changes over the year are neglected, both
//! in E₀ here and in the state of the sky: a scene given by sun angles has no date.

use super::perez::PerezState;

/// Solar constant of Perez's model, by which its brightness is defined, as in Radiance's `gendaylit`. \[W/m²\]
const SOLAR_CONSTANT: f64 = 1367.0;

/// Returns the optical air mass in the direction of the sun, relative to that of the zenith at sea level. `altitude`:
/// of the sun, 0 and above \[rad\]; `elevation`: of the site above sea level \[m\].
fn air_mass(altitude: f64, elevation: f64) -> f64 {
    let zenith = 90.0 - altitude.to_degrees();
    let relative = 1.0 / (altitude.sin() + 0.50572 * (96.07995 - zenith).powf(-1.6364));
    // Pressure of the standard atmosphere over that at sea level.
    let pressure = ((44_331.514 - elevation) / 11_880.516).powf(1.0 / 0.190_263_2) * 100.0 / 101_325.0;
    relative * pressure
}

/// Computes direct normal and diffuse horizontal irradiance under a clear sky. \[W/m²\] `altitude`: of the sun \[rad\];
/// `turbidity`: after Linke (1 is clean dry air, 3 usual, above 5 hazy); `elevation`: of the site above sea level
/// \[m\]. Both irradiances are 0 with the sun on or below the horizon.
pub fn clear_sky_irradiances(altitude: f64, turbidity: f64, elevation: f64) -> (f64, f64) {
    if altitude <= 0.0 {
        return (0.0, 0.0);
    }
    let (mass, sine) = (air_mass(altitude, elevation), altitude.sin());
    let (f1, f2) = ((-elevation / 8000.0).exp(), (-elevation / 1250.0).exp());
    // GHI = (5.09e-5 H + 0.868) E₀ sin γ exp(−(3.92e-5 H + 0.0387) AM (f₁ + f₂ (T_L − 1)))
    let extinction = (3.92e-5 * elevation + 0.0387) * mass * (f1 + f2 * (turbidity - 1.0));
    let global = (5.09e-5 * elevation + 0.868) * SOLAR_CONSTANT * sine * (-extinction).exp();
    // DNI = (0.664 + 0.163/f₁) E₀ exp(−0.09 AM (T_L − 1)), at most what leaves a least diffuse part.
    let beam = (0.664 + 0.163 / f1) * SOLAR_CONSTANT * (-0.09 * mass * (turbidity - 1.0)).exp();
    let most = global * (1.0 - (0.1 - 0.2 * (-turbidity).exp()) / (0.1 + 0.882 / f1)) / sine;
    let direct = beam.min(most);
    (direct, global - direct * sine)
}

/// Computes direct normal and diffuse horizontal illuminance under a clear sky. \[lx\] `altitude`: of the sun \[rad\];
/// `turbidity`: after Linke; `elevation`: of the site above sea level \[m\].
pub fn clear_sky_illuminances(altitude: f64, turbidity: f64, elevation: f64) -> (f64, f64) {
    let (direct, diffuse) = clear_sky_irradiances(altitude, turbidity, elevation);
    match PerezState::new(altitude, direct, diffuse, 1.0) {
        Some(state) => (direct * state.direct_efficacy(), diffuse * state.diffuse_efficacy()),
        // The sun is below the horizon, or just above it and its light is less than any number.
        None => (0.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::sky::availability::{Cover, typical_illuminances};

    /// Altitude \[°\], turbidity, elevation \[m\]; direct normal, diffuse horizontal irradiance \[W/m²\]; the same as
    /// illuminance \[lx\]. By pvlib 0.16.1's `clearsky.ineichen` without Perez's enhancement, E₀ = 1367 W/m².
    const KNOWN: [[f64; 7]; 12] = [
        [0.7, 3.0, 0.0, 5.9284, 0.417843, 163.046, 102.959],
        [1.5, 2.0, 0.0, 150.008, 1.54152, 7860.89, 279.093],
        [4.0, 3.0, 0.0, 123.476, 11.2286, 5764.15, 1993.66],
        [6.0, 3.0, 250.0, 242.694, 17.1536, 13699.7, 2979.08],
        [9.0, 5.0, 0.0, 123.182, 37.114, 6614.61, 5057.21],
        [15.0, 3.0, 0.0, 569.124, 49.9563, 46989.4, 8071.88],
        [25.0, 6.0, 400.0, 415.545, 117.618, 37118.9, 16570.7],
        [41.2, 3.0, 245.0, 872.601, 83.5198, 89525.9, 11868.3],
        [50.0, 2.0, 1500.0, 1066.69, 60.0089, 110360.0, 8466.02],
        [64.0, 4.0, 0.0, 837.3, 145.261, 86460.3, 18780.3],
        [70.0, 3.0, 2200.0, 1037.34, 150.4, 107173.0, 19177.8],
        [88.0, 8.0, 600.0, 638.434, 267.08, 63495.2, 33391.4],
    ];

    #[test]
    fn the_formula_gives_known_figures() {
        for [altitude, turbidity, elevation, direct, diffuse, beam, sky] in KNOWN {
            let altitude = f64::to_radians(altitude);
            let got = clear_sky_irradiances(altitude, turbidity, elevation);
            let lit = clear_sky_illuminances(altitude, turbidity, elevation);
            for (got, expected) in [(got.0, direct), (got.1, diffuse), (lit.0, beam), (lit.1, sky)] {
                assert!((got / expected - 1.0).abs() < 1e-3, "{altitude} {turbidity} {elevation}: {got} {expected}");
            }
        }
    }

    #[test]
    fn a_low_sun_leaves_less_than_the_practice_of_1984_says() {
        // RP-21's 800 lx of a clear sky at sunrise and its steep root are what made rooms too bright.
        for (degrees, least, most) in [(2.0_f64, 4.0, 7.0), (5.0, 1.3, 2.5), (45.0, 0.6, 1.6)] {
            let altitude = degrees.to_radians();
            let ratio =
                typical_illuminances(Cover::Clear, altitude, None).1 / clear_sky_illuminances(altitude, 3.0, 0.0).1;
            assert!((least..most).contains(&ratio), "{degrees}°: {ratio}");
        }
    }

    #[test]
    fn clean_and_thin_air_let_more_through_and_scatter_less() {
        for degrees in [5.0_f64, 15.0, 40.0, 80.0] {
            let at = |turbidity, elevation| clear_sky_irradiances(degrees.to_radians(), turbidity, elevation);
            assert!(at(2.0, 0.0).0 > at(4.0, 0.0).0 && at(2.0, 0.0).1 < at(4.0, 0.0).1, "{degrees}");
            assert!(at(3.0, 1500.0).0 > at(3.0, 0.0).0, "{degrees}");
        }
    }

    #[test]
    fn below_the_horizon_there_is_nothing() {
        for degrees in [-90.0_f64, -12.0, -0.1, 0.0] {
            assert_eq!(clear_sky_illuminances(degrees.to_radians(), 3.0, 200.0), (0.0, 0.0));
        }
        // Just above it: little, and a number.
        for altitude in [1e-300, 1e-12, 1e-6] {
            let (direct, diffuse) = clear_sky_illuminances(altitude, 3.0, 0.0);
            assert!((0.0..20_000.0).contains(&direct) && (0.0..200.0).contains(&diffuse), "{direct} {diffuse}");
        }
    }
}
