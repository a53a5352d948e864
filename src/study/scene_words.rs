//! Texts about a scene: place, time, sky, system, and accuracy of illuminances.

use super::moment;
use super::places::city_at;
use super::scene_file::{IdealKind, RANKED, SceneFile, SkyModelKey, SystemKeys};
use super::weather::{YEARS, short_name};
use crate::compute::estimate::{Estimate, largest_relative_error};
use crate::compute::weather::Station;
use crate::drawing::ticks::number;
use crate::texts::{fixed, one_line, words as texts};

/// Returns the place of a scene as text: for a weather hour the name of the weather, since its place is used; else the
/// city that contains the site, or coordinates.
pub fn place(scene: &SceneFile) -> String {
    scene.sky.weather.as_deref().map_or_else(|| site(scene), short_name)
}

/// Returns the site of a scene as text, independent of weather data: the city that contains it, else coordinates.
pub fn site(scene: &SceneFile) -> String {
    let (Some(latitude), Some(longitude)) = (scene.site.latitude, scene.site.longitude) else {
        return texts::NO_PLACE.into();
    };
    city_at(latitude, longitude).map_or_else(|| coordinates(latitude, longitude), |city| city.name.to_string())
}

/// Formats geographic coordinates, given in degrees, such as `48.78°N 9.18°E`.
pub fn coordinates(latitude: f64, longitude: f64) -> String {
    let ns = if latitude < 0.0 { texts::S } else { texts::N };
    let ew = if longitude < 0.0 { texts::W } else { texts::E };
    texts::coordinates(fixed(latitude.abs(), 2), ns, fixed(longitude.abs(), 2), ew)
}

/// Returns the name of a weather station in one line: the place of a built-in year in the current language, else the
/// name in its data, else its coordinates.
pub fn station(station: &Station) -> String {
    if let Some(year) = YEARS.iter().find(|year| year.is_of(station)) {
        return short_name(&year.name());
    }
    let name = one_line(&station.name);
    if name.is_empty() { coordinates(station.latitude, station.longitude) } else { name.into() }
}

/// Returns name and coordinates of a weather station.
pub fn station_place(station: &Station) -> String {
    let (name, place) = (self::station(station), coordinates(station.latitude, station.longitude));
    if name == place { place } else { format!("{name}, {place}") }
}

/// Returns date and time of a scene as text.
pub fn time(scene: &SceneFile) -> String {
    moment::of(scene).map_or_else(
        || match (scene.sky.sun.altitude, scene.sky.sun.azimuth) {
            (Some(altitude), Some(azimuth)) => {
                texts::sun_by_angles(moment::height_words(altitude, 0), fixed(azimuth, 0))
            }
            _ => texts::NO_SUN.into(),
        },
        moment::words,
    )
}

/// Returns the sky of a scene as text.
pub fn sky(scene: &SceneFile) -> String {
    match scene.sky.model {
        SkyModelKey::Cie => {
            let kind = scene.sky.cie_type.unwrap_or(16);
            let word = match kind {
                1..=5 | 16 => texts::OVERCAST,
                6..=10 => texts::PARTLY_CLOUDY,
                _ => texts::CLEAR,
            };
            texts::cie_sky(word, kind)
        }
        model => model.words()[1].to_owned(),
    }
}

/// Returns the name that the scene file gives to an aperture's system.
pub fn system(keys: &SystemKeys) -> String {
    let with_state = |name: String, state: &Option<String>| match state {
        Some(state) => format!("{name}, {state}"),
        None => name,
    };
    match keys {
        SystemKeys::Catalogue { key, state } => with_state(key.clone(), state),
        SystemKeys::File { path, state } => with_state(path.display().to_string(), state),
        SystemKeys::Family { states, state } => {
            let first = states.first().map_or_else(String::new, |one| one.file.display().to_string());
            with_state(format!("{first} …"), state)
        }
        SystemKeys::Luminaires { index, set } => with_state(index.display().to_string(), set),
        SystemKeys::Ranked => RANKED.to_owned(),
        SystemKeys::Ideal { kind: IdealKind::Transparent, .. } => texts::IDEAL_TRANSPARENT.into(),
        SystemKeys::Ideal { kind: IdealKind::Diffuse, .. } => texts::IDEAL_DIFFUSE.into(),
    }
}

/// Relative error from which texts call illuminances uncertain: a step of the scale of illuminances in EN 12464-1, a
/// factor of about 1.5. \[%\]
const LARGE_ERROR: f64 = 50.0;

/// Formats the accuracy of a list of illuminances, in the one form that all outputs of the program use: see
/// [`largest_relative_error`].
pub fn error_words(totals: impl Iterator<Item = Estimate> + Clone) -> String {
    match 100.0 * largest_relative_error(totals) {
        error if error <= 0.0 => texts::NO_ERROR_STATED.into(),
        error if error < 0.005 => texts::ERROR_TINY.into(),
        error if error >= LARGE_ERROR => texts::error_large(number(error, 2)),
        error => texts::error_at_most(number(error, 2)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texts::{Language, speak};

    #[test]
    fn stations_have_the_name_of_their_language_of_their_data_or_their_coordinates() {
        let at = |name: &str, latitude: f64, longitude: f64| {
            station_place(&Station { name: name.to_owned(), latitude, longitude, ..Station::default() })
        };
        let [own, other] = [at("Piedmont, 45° N 8° E", 45.0, 8.0), at("Piedmont\nhill", 45.1, 8.0)];
        assert_eq!([&own[..], &other[..]], ["Piedmont, 45.00°N 8.00°E", "Piedmont hill, 45.10°N 8.00°E"]);
        assert_eq!(at("", 48.78, 9.18), "48.78°N 9.18°E");
        let _speaking = speak(Language::German);
        assert_eq!(at("Piedmont, 45° N 8° E", 45.0, 8.0), "Piemont, 45,00°N 8,00°O");
    }

    #[test]
    fn large_errors_are_written_loudly() {
        let words = |error: f64| error_words([Estimate::new(100.0, error)].into_iter());
        assert_eq!(words(0.6), "uncertainty ≤ 0.60 % of each value");
        assert_eq!(words(270.0), "UNCERTAIN: up to ± 270 % of a value");
    }
}
