//! Typical illuminances by sun and sky from the sun's altitude alone, for use without measurements.
//!
//! References: IES Recommended Practice for the Calculation of Daylight Availability (RP-21, 1984): direct normal
//! E_xt·exp(−c·m) with optical air mass m = 1/sin γ and E_xt = 127.5 klx · (1 + 0.034 cos(2π(J − 2)/365)) on day J of
//! the year; diffuse horizontal A + B·sin^C γ.

use std::f64::consts::PI;

/// Class of cloud cover of the IES recommended practice RP-21.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cover {
    /// Clear sky: cloud cover below 0.3.
    Clear,
    /// Partly cloudy sky: cloud cover from 0.3 to 0.8.
    Partly,
    /// Overcast sky: cloud cover above 0.8, no direct sun.
    Overcast,
}

impl Cover {
    /// Returns the class of cloud cover that a sky type of ISO 15469 (CIE) represents: 1–5 and 16 overcast, 6–10 partly
    /// cloudy, 11–15 clear.
    pub const fn of_cie_type(cie_type: u8) -> Self {
        match cie_type {
            6..=10 => Self::Partly,
            11..=15 => Self::Clear,
            _ => Self::Overcast,
        }
    }

    /// Returns the English name of the class of cloud cover.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Clear => "clear",
            Self::Partly => "partly cloudy",
            Self::Overcast => "overcast",
        }
    }
}

/// Solar illuminance constant of IES RP-21 (1984). \[lx\]
const EXTRATERRESTRIAL: f64 = 127_500.0;

/// Returns the typical direct normal and diffuse horizontal illuminance \[lx\] for the sun at `altitude` \[rad\] on a
/// `day` of the year, 1 to 365; without a day for the mean distance of the sun. Both are 0 with the sun on or below the
/// horizon.
pub fn typical_illuminances(cover: Cover, altitude: f64, day: Option<u16>) -> (f64, f64) {
    if altitude <= 0.0 {
        return (0.0, 0.0);
    }
    let sine = altitude.sin();
    let distance = day.map_or(1.0, |day| 1.0 + 0.034 * (2.0 * PI * (f64::from(day) - 2.0) / 365.0).cos());
    let beam = |extinction: f64| EXTRATERRESTRIAL * distance * (-extinction / sine).exp();
    match cover {
        Cover::Clear => (beam(0.21), 800.0 + 15_500.0 * sine.sqrt()),
        Cover::Partly => (beam(0.80), 300.0 + 45_000.0 * sine),
        Cover::Overcast => (0.0, 300.0 + 21_000.0 * sine),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_the_zenith_the_printed_constants_add_up() {
        let zenith = 0.5 * PI;
        assert_eq!(typical_illuminances(Cover::Overcast, zenith, Some(2)), (0.0, 21_300.0));
        let (direct, diffuse) = typical_illuminances(Cover::Clear, zenith, None);
        assert!((diffuse - 16_300.0).abs() < 1e-9);
        assert!((direct - 103_349.0).abs() < 20.0, "{direct}");
        assert_eq!(typical_illuminances(Cover::Clear, -0.01, None), (0.0, 0.0));
    }

    #[test]
    fn the_sun_of_june_is_that_of_the_handbook() {
        // IES Lighting Handbook, 40° N, 21 June at noon, clear: 8821 fc of direct light on a horizontal plane.
        let altitude = (90.0 - 40.0 + 23.44_f64).to_radians();
        let (direct, _) = typical_illuminances(Cover::Clear, altitude, Some(172));
        assert!((direct * altitude.sin() / 10.7639 / 8821.0 - 1.0).abs() < 2e-3, "{direct}");
    }

    #[test]
    fn everything_rises_with_the_sun() {
        for cover in [Cover::Clear, Cover::Partly, Cover::Overcast] {
            let mut before = (0.0, 0.0);
            for degrees in 1..=90 {
                let now = typical_illuminances(cover, f64::from(degrees).to_radians(), None);
                assert!(now.0 >= before.0 && now.1 > before.1);
                before = now;
            }
        }
    }
}
