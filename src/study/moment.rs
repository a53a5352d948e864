//! Date and time of a scene, for sliders, steps and texts.

use super::scene_file::{SceneFile, TimeKey};
use super::sky::hour_of_weather;
use super::sun_position::{Place, RiseSet, parse_local_time, rise_set, sun_position};
use super::weather::kept;
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, World};
use crate::compute::weather::Station;
use crate::texts::{Text, fixed, words as texts};
use jiff::civil::{Date, DateTime, Time};
use jiff::{Span, ToSpan};
use std::path::Path;

/// Returns the scene's local time by the clock, summer time included; `None` if the scene gives the sun by angles, or
/// has no valid time.
pub fn of(scene: &SceneFile) -> Option<DateTime> {
    parse_local_time(&scene.sky.time.as_ref()?.text()).ok()
}

/// Sets the scene's date and time by the clock, in place of sun angles.
pub fn set(scene: &mut SceneFile, time: DateTime) {
    scene.sky.time = Some(TimeKey::of(time));
    scene.sky.sun.altitude = None;
    scene.sky.sun.azimuth = None;
}

/// Shifts the scene's date and time by days and minutes; returns `false` if it has none or the calendar ends.
pub fn step(scene: &mut SceneFile, days: i32, minutes: i32) -> bool {
    let span: Span = days.days().minutes(minutes);
    let Some(moved) = of(scene).and_then(|time| time.checked_add(span).ok()) else { return false };
    set(scene, moved);
    true
}

/// Returns the geographic location for which the sun's position is computed: for a weather hour that of the weather
/// station, else the scene's; `None` if it is incomplete. `base`: folder from which relative paths start.
pub fn place(scene: &SceneFile, base: &Path) -> Option<Place> {
    let Some(name) = &scene.sky.weather else { return place_of_site(scene) };
    place_of_station(&kept(name, base).ok()?.weather.station)
}

/// Returns the geographic location of a weather station, for computing the sun's position.
pub fn place_of_station(station: &Station) -> Option<Place> {
    Place::new(station.latitude, station.longitude, station.utc_offset).ok()
}

/// Returns the scene's own geographic location, independent of weather data; `None` if it is incomplete.
pub fn place_of_site(scene: &SceneFile) -> Option<Place> {
    let site = &scene.site;
    Place::new(site.latitude?, site.longitude?, site.utc_offset?).ok()
}

/// Returns the local standard time for a time by the scene's clock.
fn standard(scene: &SceneFile, clock: DateTime) -> DateTime {
    scene.site.dst.standard(clock, scene.site.utc_offset.unwrap_or(0.0))
}

/// Returns sunrise and sunset of the scene's day at its [`place`], as hours by the clock; `None` without place or date.
pub fn sun_hours(scene: &SceneFile, base: &Path) -> Option<RiseSet> {
    let time = of(scene)?;
    let hours = rise_set(&place(scene, base)?, time.year(), time.month(), time.day()).ok()?;
    // By the clock time of that day; the clock changes at night.
    let noon = time.date().at(12, 0, 0, 0);
    let ahead = if standard(scene, noon) == noon { 0.0 } else { 1.0 };
    Some(RiseSet { rise: hours.rise.map(|hour| hour + ahead), set: hours.set.map(|hour| hour + ahead) })
}

/// Returns true altitude \[rad\] and bearing \[°\] of the sun at the scene's moment; for a weather hour the position
/// that its sunlight comes from. `base`: folder from which relative paths start.
pub fn sun(scene: &SceneFile, base: &Path) -> Option<(f64, f64)> {
    if scene.sky.weather.is_some() {
        let sun = hour_of_weather(&scene.sky, &scene.site, base).ok()??.hour.sun;
        return Some((sun.altitude(), sun.bearing().degrees()));
    }
    sun_of_site(scene)
}

/// Returns true altitude \[rad\] and bearing \[°\] of the sun by the scene's own place and clock, independent of
/// weather data.
pub fn sun_of_site(scene: &SceneFile) -> Option<(f64, f64)> {
    // Given angles have priority over a date.
    if let (Some(altitude), Some(azimuth)) = (scene.sky.sun.altitude, scene.sky.sun.azimuth) {
        return Some((altitude.to_radians(), azimuth));
    }
    let (altitude, bearing) = sun_position(&place_of_site(scene)?, standard(scene, of(scene)?)).ok()?;
    Some((altitude, bearing.degrees()))
}

/// Sets the date, without changing the clock time; returns `false` if the scene has no date and time.
pub fn set_date(scene: &mut SceneFile, date: Date) -> bool {
    let Some(now) = of(scene) else { return false };
    set(scene, date.to_datetime(now.time()));
    true
}

/// Sets the clock time, without changing the date; returns `false` if the scene has none, or the time does not exist.
pub fn set_clock(scene: &mut SceneFile, hour: i8, minute: i8) -> bool {
    let (Some(now), Ok(time)) = (of(scene), Time::new(hour, minute, 0, 0)) else { return false };
    set(scene, now.date().to_datetime(time));
    true
}

/// Sets the clock time (and with `date` the date) at which the sun is nearest to a position in the sky, in steps of 5
/// minutes; returns `false` if the scene has no place or date. Without `date` the day is unchanged, and only times with
/// the sun above the horizon are considered, if it rises. Of two days that fit equally, the one nearer to the present
/// day is taken.
///
/// `altitude`, `bearing`: position in the sky. \[rad\]
pub fn towards(scene: &mut SceneFile, altitude: f64, bearing: f64, date: bool) -> bool {
    let (Some(place), Some(now)) = (place_of_site(scene), of(scene)) else { return false };
    let aim = Dir::<World>::from_altitude_bearing(altitude, Bearing::from_radians(bearing));
    let (dst, offset) = (scene.site.dst, scene.site.utc_offset.unwrap_or(0.0));
    let miss = |time: DateTime| {
        sun_position(&place, dst.standard(time, offset)).map_or(f64::INFINITY, |(altitude, bearing)| {
            // A sun below the horizon is the last choice.
            let hidden = if altitude < 0.0 { 2.0 } else { 0.0 };
            hidden + 1.0 - Dir::<World>::from_altitude_bearing(altitude, bearing).dot(aim)
        })
    };
    let moved = |days: i32, minutes: i32| now.checked_add(days.days().minutes(minutes)).ok();
    let start = 60 * i32::from(now.hour()) + i32::from(now.minute());
    // In steps of 4 days and half hours first, then finer about the best; a date further away must fit better.
    let far = if date { 180 } else { 0 };
    let mut best = (f64::INFINITY, now);
    for days in (-far..=far).step_by(4) {
        for minutes in (0..24 * 60).step_by(30) {
            let Some(time) = moved(days, minutes - start) else { continue };
            let cost = miss(time) + 1e-6 * f64::from(days.abs());
            if time.year() == now.year() && cost < best.0 {
                best = (cost, time);
            }
        }
    }
    let coarse = best.1;
    let near = if date { 3 } else { 0 };
    for days in -near..=near {
        for minutes in (-30..=30).step_by(5) {
            let Ok(time) = coarse.checked_add(days.days().minutes(minutes)) else { continue };
            let cost = miss(time);
            let stays = if date { time.year() == now.year() } else { time.date() == now.date() };
            if stays && cost < best.0 {
                best = (cost, time);
            }
        }
    }
    set(scene, best.1);
    true
}

/// Whether the sun at an altitude \[rad\] and a bearing \[°\] is in front of a façade whose outward normal has the
/// bearing `facade`. \[°\]
pub fn before_facade((altitude, bearing): (f64, f64), facade: f64) -> bool {
    altitude > 0.0 && (bearing - facade).to_radians().cos() * altitude.cos() > 0.0
}

/// Formats hours since midnight as a clock time, such as `14:05`.
pub fn clock(hours: f64) -> String {
    let minutes = (hours * 60.0).round() as i64;
    format!("{:02}:{:02}", minutes.div_euclid(60), minutes.rem_euclid(60))
}

/// Formats date and time, such as `21 Mar 12:00`.
pub fn words(time: DateTime) -> String {
    texts::moment(time.day(), month(time.month()), time.strftime("%H:%M"))
}

/// Returns the short name of a month; January is 1.
pub fn month(number: i8) -> Text {
    texts::MONTHS[usize::try_from(number - 1).unwrap_or(0).min(11)]
}

/// Formats a solar altitude, given in degrees, with `decimals` decimals, such as `41° high` or `15° below the horizon`.
pub fn height_words(degrees: f64, decimals: usize) -> String {
    let shown = format!("{}°", fixed(degrees.abs(), decimals));
    // An altitude that rounds to 0 is on the horizon, not below it.
    if shown.chars().all(|c| !c.is_ascii_digit() || c == '0') {
        return texts::ON_THE_HORIZON.into();
    }
    if degrees < 0.0 { texts::below_the_horizon(shown) } else { texts::high(shown) }
}

/// Returns the name of a compass bearing, given in degrees from north, such as `south` or `south-west`.
pub fn bearing_word(degrees: f64) -> &'static str {
    const WORDS: [Text; 8] = [
        texts::NORTH,
        texts::NORTH_EAST,
        texts::EAST,
        texts::SOUTH_EAST,
        texts::SOUTH,
        texts::SOUTH_WEST,
        texts::WEST,
        texts::NORTH_WEST,
    ];
    WORDS[((degrees.rem_euclid(360.0) / 45.0).round() as usize) % 8].get()
}
