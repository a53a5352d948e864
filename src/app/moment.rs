//! The scene's date and time as the window handles them: sliders, steps, words.

use crate::study::scene_file::{SceneFile, TimeKey};
use crate::study::sun_position::{Place, RiseSet, parse_local_time, rise_set, sun_position};
use jiff::civil::DateTime;
use jiff::{Span, ToSpan};

/// The scene's local standard time; `None` when it is given by sun angles or is no time.
pub fn of(scene: &SceneFile) -> Option<DateTime> {
    parse_local_time(&scene.sky.time.as_ref()?.text()).ok()
}

/// Writes a moment into the scene, instead of sun angles.
pub fn set(scene: &mut SceneFile, time: DateTime) {
    scene.sky.time = Some(TimeKey::Text(time.strftime("%Y-%m-%dT%H:%M").to_string()));
    scene.sky.sun.altitude = None;
    scene.sky.sun.azimuth = None;
}

/// Moves the scene's moment; false where there is none or the calendar ends.
pub fn step(scene: &mut SceneFile, days: i32, minutes: i32) -> bool {
    let span: Span = days.days().minutes(minutes);
    let Some(moved) = of(scene).and_then(|time| time.checked_add(span).ok()) else { return false };
    set(scene, moved);
    true
}

/// The scene's place, if it is whole.
pub fn place(scene: &SceneFile) -> Option<Place> {
    let site = &scene.site;
    Place::new(site.latitude?, site.longitude?, site.utc_offset?).ok()
}

/// Sunrise and sunset of the scene's day.
pub fn sun_hours(scene: &SceneFile) -> Option<RiseSet> {
    let time = of(scene)?;
    rise_set(&place(scene)?, time.year(), time.month(), time.day()).ok()
}

/// Altitude [rad] and bearing [°] of the sun at the scene's moment.
pub fn sun(scene: &SceneFile) -> Option<(f64, f64)> {
    match (of(scene), scene.sky.sun.altitude, scene.sky.sun.azimuth) {
        (Some(time), _, _) => {
            sun_position(&place(scene)?, time).ok().map(|(altitude, bearing)| (altitude, bearing.degrees()))
        }
        (None, Some(altitude), Some(azimuth)) => Some((altitude.to_radians(), azimuth)),
        _ => None,
    }
}

/// `14:05` of hours since midnight.
pub fn clock(hours: f64) -> String {
    let minutes = (hours * 60.0).round() as i64;
    format!("{:02}:{:02}", minutes.div_euclid(60), minutes.rem_euclid(60))
}

/// `21 Mar 12:00`
pub fn words(time: DateTime) -> String {
    time.strftime("%-d %b %H:%M").to_string()
}

/// A bearing in words: `south`, `south-west`.
pub fn bearing_word(degrees: f64) -> &'static str {
    const WORDS: [&str; 8] =
        ["north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"];
    WORDS[((degrees.rem_euclid(360.0) / 45.0).round() as usize) % 8]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::state::first_scene;

    #[test]
    fn steps_cross_midnight_and_months() {
        let mut scene = first_scene();
        assert!(step(&mut scene, 11, 12 * 60));
        assert_eq!(words(of(&scene).unwrap()), "2 Apr 00:00");
        scene.sky.time = None;
        assert!(!step(&mut scene, 1, 0));
    }

    #[test]
    fn the_equinox_noon_in_stuttgart_is_where_the_almanac_has_it() {
        // Altitude at noon of the equinox is 90° − latitude, within the declination's change over a day (0.4°).
        let (altitude, bearing) = sun(&first_scene()).unwrap();
        assert!((altitude.to_degrees() - (90.0 - 48.78)).abs() < 0.8, "{}", altitude.to_degrees());
        assert!((bearing - 180.0).abs() < 12.0, "{bearing}");
        let hours = sun_hours(&first_scene()).unwrap();
        assert!((hours.set.unwrap() - hours.rise.unwrap() - 12.15).abs() < 0.15);
    }

    #[test]
    fn bearings_read_as_words() {
        assert_eq!(bearing_word(180.0), "south");
        assert_eq!(bearing_word(-44.0), "north-west");
        assert_eq!(bearing_word(359.0), "north");
        assert_eq!(clock(6.508), "06:30");
    }
}
