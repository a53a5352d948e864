//! Hours in which the sun's centre is seen from a point of an opening on one cloudless day (EN 17037, 5.3).

use glam::DVec3;

/// Levels of EN 17037: name and minimum number of hours.
pub const LEVELS: [(&str, f64); 3] = [("minimum", 1.5), ("medium", 3.0), ("high", 4.0)];

/// Interval between the moments that are tested first for sun on the point; shadows shorter than it may be missed.
/// \[min\] In 2 min the sun moves by
/// 0.5°, about its own diameter.
const STEP: f64 = 2.0;
/// Accuracy to which the begin and end of a span of sunlight are found by bisection. \[min\] Chosen: below [`PLACE`].
const EXACT: f64 = 1.0 / 60.0;
/// Time in which the sun moves by 0.01°, the accuracy of its position, at 15° per hour. \[min\] The accuracy is held by
/// `tests/compute/sky.rs::solar_positions_agree_with_the_reference`.
const PLACE: f64 = 0.04;

/// Spans of time on one day in which one opening, or one of several together, is exposed to sunlight.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Exposure {
    /// Begin and end of every span, after local midnight. \[min\]
    pub spans: Vec<[f64; 2]>,
}

impl Exposure {
    /// Finds the spans of a day in which the sun reaches an opening's reference point unobstructed: those in which
    /// `free`, called with minutes after local midnight, returns `true`.
    pub fn of(free: impl Fn(f64) -> bool) -> Self {
        let edge = |mut dark: f64, mut sunny: f64| {
            while (sunny - dark).abs() > EXACT {
                let middle = 0.5 * (dark + sunny);
                if free(middle) { sunny = middle } else { dark = middle }
            }
            0.5 * (dark + sunny)
        };
        let mut spans = Vec::new();
        let mut begin = free(0.0).then_some(0.0);
        for k in 1..=(1440.0 / STEP) as usize {
            let (before, now) = (STEP * (k - 1) as f64, STEP * k as f64);
            match (begin, free(now)) {
                (None, true) => begin = Some(edge(before, now)),
                (Some(from), false) => {
                    spans.push([from, edge(now, before)]);
                    begin = None;
                }
                _ => {}
            }
        }
        spans.extend(begin.map(|from| [from, 1440.0]));
        Self { spans }
    }

    /// Returns the total duration of exposure to sunlight on the day. \[h\]
    pub fn hours(&self) -> f64 {
        self.spans.iter().map(|[from, to]| to - from).sum::<f64>() / 60.0
    }

    /// Returns the uncertainty of the total duration of exposure, due to that of the sun's position at the ends of the
    /// spans. \[h\]
    pub fn error(&self) -> f64 {
        2.0 * (PLACE + EXACT) * self.spans.len() as f64 / 60.0
    }

    /// Returns the name of the highest of [`LEVELS`] that the duration of exposure reaches; `None` below the lowest.
    pub fn level(&self) -> Option<&'static str> {
        let hours = self.hours();
        LEVELS.iter().rev().find(|(_, least)| hours >= *least).map(|(name, _)| *name)
    }
}

/// Returns the height above the floor of the reference point of an opening (EN 17037): that of its middle, but no lower
/// than 1.2 m above the floor and 0.3 m above its lower edge, and never above its upper edge. `low` and `high`: heights
/// of the opening's lower and upper edge above the floor. \[m\]
pub fn reference_height(low: f64, high: f64) -> f64 {
    (0.5 * (low + high)).max(1.2).max(low + 0.3).min(high)
}

/// Whether the sun is in front of a surface and its altitude not below `least_altitude` \[rad\]. `sun` is the unit
/// vector towards the sun, `outward` the surface's outward unit normal; both in the same frame with z up.
pub fn is_before(sun: DVec3, outward: DVec3, least_altitude: f64) -> bool {
    sun.z >= least_altitude.sin() && sun.dot(outward) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sun over a latitude at a fixed declination, true solar time.
    fn sun(latitude: f64, declination: f64, minutes: f64) -> DVec3 {
        let hour = (minutes / 4.0 - 180.0).to_radians();
        let ((sl, cl), (sd, cd)) = (latitude.sin_cos(), declination.sin_cos());
        DVec3::new(-cd * hour.sin(), sd * cl - cd * hour.cos() * sl, sd * sl + cd * cl * hour.cos())
    }

    #[test]
    fn a_free_south_façade_has_the_sun_as_long_as_the_closed_form_says() {
        for (latitude, declination, least) in [(47.0_f64, -16.0_f64, 10.0_f64), (34.0, -0.1, 15.0), (60.0, -17.0, 5.0)]
        {
            let [latitude, declination, least] = [latitude, declination, least].map(f64::to_radians);
            let found = Exposure::of(|m| is_before(sun(latitude, declination, m), DVec3::NEG_Y, least));
            let cosine = (least.sin() - latitude.sin() * declination.sin()) / (latitude.cos() * declination.cos());
            let expected = 2.0 * cosine.acos().to_degrees() / 15.0;
            assert!((found.hours() - expected).abs() < 6e-4, "{} {expected}", found.hours());
            assert_eq!(found.spans.len(), 1);
        }
        // A west façade at equinox: from noon on, the sun as low as 10° is 1/cos φ of the hour angle away.
        let latitude = 45.0_f64.to_radians();
        let west = Exposure::of(|m| is_before(sun(latitude, 0.0, m), DVec3::NEG_X, 10.0_f64.to_radians()));
        let expected = (10.0_f64.to_radians().sin() / latitude.cos()).acos().to_degrees() / 15.0;
        assert!((west.hours() - expected).abs() < 6e-4);
    }

    #[test]
    fn levels_begin_at_their_hours() {
        let of = |hours: f64| Exposure { spans: vec![[600.0, 600.0 + 60.0 * hours]] }.level();
        for (hours, level) in
            [(1.49, None), (1.5, Some("minimum")), (2.99, Some("minimum")), (3.0, Some("medium")), (4.0, Some("high"))]
        {
            assert_eq!(of(hours), level, "{hours}");
        }
        assert_eq!(Exposure::default().level(), None);
        assert_eq!(reference_height(0.9, 2.7), 1.8);
        assert_eq!(reference_height(0.0, 2.0), 1.2);
        assert_eq!(reference_height(2.0, 2.4), 2.3);
        assert_eq!(reference_height(0.2, 1.0), 1.0);
    }
}
