//! A scene in words: where, when, under which sky, and how exact its figures are.

use super::moment;
use super::places::city_at;
use super::scene_file::{SceneFile, SkyModelKey};
use crate::compute::estimate::{Estimate, largest_relative_error};
use crate::drawing::ticks::number;

/// The place in words: the city that it lies in, else coordinates.
pub fn place(scene: &SceneFile) -> String {
    let (Some(latitude), Some(longitude)) = (scene.site.latitude, scene.site.longitude) else {
        return "no place".to_owned();
    };
    city_at(latitude, longitude).map_or_else(|| coordinates(latitude, longitude), |city| city.name.to_string())
}

/// `48.78°N 9.18°E`
pub fn coordinates(latitude: f64, longitude: f64) -> String {
    let ns = if latitude < 0.0 { "S" } else { "N" };
    let ew = if longitude < 0.0 { "W" } else { "E" };
    format!("{:.2}°{ns} {:.2}°{ew}", latitude.abs(), longitude.abs())
}

/// The moment in words.
pub fn time(scene: &SceneFile) -> String {
    moment::of(scene).map_or_else(
        || match (scene.sky.sun.altitude, scene.sky.sun.azimuth) {
            (Some(altitude), Some(azimuth)) => {
                format!("sun {} at {azimuth:.0}°", moment::height_words(altitude, 0))
            }
            _ => "no sun".to_owned(),
        },
        moment::words,
    )
}

/// The sky in words.
pub fn sky(scene: &SceneFile) -> String {
    match scene.sky.model {
        SkyModelKey::Cie => {
            let kind = scene.sky.cie_type.unwrap_or(16);
            let word = match kind {
                1..=5 | 16 => "overcast",
                6..=10 => "partly cloudy",
                _ => "clear",
            };
            format!("{word} (CIE {kind})")
        }
        model => model.words()[1].to_owned(),
    }
}

/// How exact illuminances are, in the one way in which the program says it: see [`largest_relative_error`].
pub fn error_words(totals: impl Iterator<Item = Estimate> + Clone) -> String {
    match 100.0 * largest_relative_error(totals) {
        error if error <= 0.0 => "no error stated".to_owned(),
        error if error < 0.005 => "error < 0.01 % of each value".to_owned(),
        error => format!("error ≤ {} % of each value", number(error, 2)),
    }
}
