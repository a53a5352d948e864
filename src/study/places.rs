//! List of some thousand cities for the choice of a site: found by name, or by distance.
//!
//! Data from GeoNames (see `assets/places`): latitude, longitude, elevation, and UTC offset of standard time.

pub use crate::formats::gazetteer::City;

use crate::formats::gazetteer::read_cities;
use crate::study::scene_file::DstKey;
use crate::texts::folded;
use std::sync::LazyLock;

/// All cities, the largest first.
pub static CITIES: LazyLock<Vec<City>> = LazyLock::new(|| {
    // The table is part of the program, and a test reads it.
    read_cities(include_bytes!("../../assets/places/places.tsv.zst")).expect("the table of places is whole")
});

/// Distance from a city's centre up to which a site is named after it. \[km\]
const IN_CITY: f64 = 10.0;

/// Length of a degree along a meridian. \[km/°\]
const KM_PER_DEGREE: f64 = 111.2;

/// Names and countries of the cities in the form in which the search compares them.
static PLAIN: LazyLock<Vec<[String; 2]>> =
    LazyLock::new(|| CITIES.iter().map(|city| [&*city.name, &*city.country].map(folded)).collect());

/// Returns how well a city matches a searched name: 0 is best; `None` if it does not match. `own`: name of the city in
/// the form for comparison.
fn rank(city: &City, own: &str, name: &str) -> Option<u8> {
    let known = || std::iter::once(own).chain(city.other_names.iter().map(|other| &**other));
    // A name with accents has the same spelling in plain form.
    let spelled = || known().take(if city.name.is_ascii() { 1 } else { 2 });
    if known().any(|known| known == name) {
        Some(0)
    } else if spelled().any(|known| known.starts_with(name)) {
        Some(1)
    } else if known().any(|known| known.starts_with(name))
        || spelled().any(|known| known.split([' ', '-']).any(|word| word.starts_with(name)))
    {
        Some(2)
    } else {
        None
    }
}

/// Whether a city is in a country or state that begins with `area`, or has this code. `country`: country in the form
/// for comparison.
fn within(city: &City, country: &str, area: &str) -> bool {
    let code: String = city.code.iter().collect();
    code.eq_ignore_ascii_case(area) || city.region.eq_ignore_ascii_case(area) || country.starts_with(area)
}

/// Returns at most `most` cities that match the typed text, best first, and the number of all that match. Examples of
/// texts: `stutt`, `münchen`, `portland, us`.
pub fn search(typed: &str, most: usize) -> (Vec<&'static City>, usize) {
    let typed = folded(typed.trim());
    let (name, area) = typed.split_once(',').unwrap_or((&typed, ""));
    let (name, area) = (name.trim(), area.trim());
    if name.is_empty() {
        return (Vec::new(), 0);
    }
    let mut found: Vec<(u8, &City)> = CITIES
        .iter()
        .zip(PLAIN.iter())
        .filter(|(city, [_, country])| area.is_empty() || within(city, country, area))
        .filter_map(|(city, [own, _])| Some((rank(city, own, name)?, city)))
        .collect();
    // Of the same rank the larger city stays before the smaller.
    found.sort_by_key(|(rank, _)| *rank);
    let count = found.len();
    (found.into_iter().take(most).map(|(_, city)| city).collect(), count)
}

/// Codes of countries with the summer time of the European Union.
const WITH_EU: &str = "AD AL AT AX BA BE BG CH CY CZ DE DK EE ES FI FO FR GB GG GI GL GR HR HU IE IM IT JE LI LT LU LV MC MD \
                       ME MK MT NL NO PL PT RO RS SE SI SJ SK SM UA VA XK";
/// Codes of countries with the daylight saving time of the United States.
const WITH_US: &str = "BM BS CA CU HT PM TC US";
/// Codes of states of the United States without summer time.
const WITHOUT_SUMMER_TIME: [&str; 2] = ["AZ", "HI"];

/// Returns the rule of summer time at a city (IANA time zone database, 2026); [`DstKey::None`] if it keeps standard
/// time, or has a rule without a name.
pub fn summer_time(city: &City) -> DstKey {
    let code: String = city.code.iter().collect();
    let among = |codes: &str| codes.split(' ').any(|one| one == code);
    let (north, east, offset) = (city.latitude, city.longitude, city.utc_offset);
    // Saskatchewan keeps the time of the prairies, Yukon and the north-east of British Columbia that of the mountains.
    let canada_without = (offset == -6.0 && east < -101.4) || (offset == -7.0 && east < -120.0);
    match code.as_str() {
        "US" if WITHOUT_SUMMER_TIME.contains(&&*city.region) => DstKey::None,
        "CA" if canada_without => DstKey::None,
        // Without Queensland, north of 28.1° S at the coast, and the Northern Territory, north of 26° S.
        "AU" if (offset == 10.0 && north < -28.1) || (offset == 9.5 && north < -26.0) => DstKey::Australia,
        "NZ" => DstKey::NewZealand,
        // The south of Chile keeps the time of Argentina.
        "CL" if offset == -4.0 => DstKey::Chile,
        _ if among(WITH_EU) => DstKey::Eu,
        _ if among(WITH_US) => DstKey::Us,
        _ => DstKey::None,
    }
}

/// Returns the city nearest to a place, and its distance \[km\]. `latitude`, `longitude`: \[°\].
pub fn nearest(latitude: f64, longitude: f64) -> Option<(&'static City, f64)> {
    closest(latitude, longitude, 180.0)
}

/// Returns the nearest city among those at most `most` degrees of latitude away, and its distance. \[km\]
fn closest(latitude: f64, longitude: f64, most: f64) -> Option<(&'static City, f64)> {
    let distance = |city: &City| {
        let east = (city.longitude - longitude + 540.0).rem_euclid(360.0) - 180.0;
        let middle = 0.5 * (city.latitude + latitude).to_radians();
        KM_PER_DEGREE * (city.latitude - latitude).hypot(east * middle.cos())
    };
    let near = CITIES.iter().filter(|city| (city.latitude - latitude).abs() <= most);
    near.map(|city| (city, distance(city))).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Returns the nearest city if its centre is within 10 km of a place. `latitude`, `longitude`: \[°\].
pub fn city_at(latitude: f64, longitude: f64) -> Option<&'static City> {
    closest(latitude, longitude, IN_CITY / KM_PER_DEGREE)
        .filter(|(_, distance)| *distance < IN_CITY)
        .map(|(city, _)| city)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(typed: &str) -> &'static City {
        search(typed, 1).0.first().unwrap_or_else(|| panic!("{typed}"))
    }

    #[test]
    fn cities_are_found_as_people_write_them() {
        for (typed, name, country) in [
            ("stutt", "Stuttgart", "Germany"),
            ("München", "Munich", "Germany"),
            ("munich", "Munich", "Germany"),
            ("koln", "Köln", "Germany"),
            ("Cologne", "Köln", "Germany"),
            ("Zurich", "Zürich", "Switzerland"),
            ("wien", "Vienna", "Austria"),
            ("Praha", "Prague", "Czechia"),
            ("new york", "New York City", "United States"),
            ("vaduz", "Vaduz", "Liechtenstein"),
        ] {
            let city = first(typed);
            assert_eq!((&*city.name, &*city.country), (name, country), "{typed}");
        }
        assert_eq!(&*first("Portland, ME").region, "ME");
        assert_eq!(&*first("Valencia, Venezuela").country, "Venezuela");
        assert_eq!(search("no such place", 5), (Vec::new(), 0));
        assert_eq!(search("  ", 5).1, 0);
        let (list, count) = search("san", 4);
        assert!(list.len() == 4 && count > 50);
    }

    #[test]
    fn summer_time_is_that_of_the_place() {
        for (typed, rule) in [
            ("Stuttgart", DstKey::Eu),
            ("London", DstKey::Eu),
            ("Oslo", DstKey::Eu),
            ("Istanbul", DstKey::None),
            ("Chicago", DstKey::Us),
            ("Phoenix", DstKey::None),
            ("Honolulu", DstKey::None),
            ("Toronto", DstKey::Us),
            ("Winnipeg", DstKey::Us),
            ("Regina, CA", DstKey::None),
            ("Calgary", DstKey::Us),
            ("Sydney, AU", DstKey::Australia),
            ("Adelaide", DstKey::Australia),
            ("Brisbane", DstKey::None),
            ("Gold Coast", DstKey::None),
            ("Perth, AU", DstKey::None),
            ("Darwin", DstKey::None),
            ("Auckland", DstKey::NewZealand),
            ("Santiago, CL", DstKey::Chile),
            ("Punta Arenas", DstKey::None),
            ("Tokyo", DstKey::None),
            ("Singapore", DstKey::None),
        ] {
            assert_eq!(summer_time(first(typed)), rule, "{typed}");
        }
    }

    #[test]
    fn clocks_are_standard_time_and_heights_are_those_of_the_place() {
        for (typed, offset, low, high) in [
            ("Stuttgart", 1.0, 200.0, 300.0),
            ("London", 0.0, 0.0, 60.0),
            ("Dublin, IE", 0.0, 0.0, 60.0),
            ("Denver", -7.0, 1500.0, 1700.0),
            ("Kathmandu", 5.75, 1200.0, 1500.0),
            ("Sydney, AU", 10.0, 0.0, 100.0),
            ("La Paz, BO", -4.0, 3400.0, 3900.0),
            ("Casablanca", 1.0, 0.0, 100.0),
        ] {
            let city = first(typed);
            assert_eq!(city.utc_offset, offset, "{typed}");
            assert!((low..high).contains(&city.elevation.unwrap()), "{typed}: {:?}", city.elevation);
        }
    }

    #[test]
    fn the_table_is_sound() {
        assert!((5000..20_000).contains(&CITIES.len()), "{}", CITIES.len());
        for city in CITIES.iter() {
            // A clock differs by some hours at most from what the sun says.
            let solar = city.longitude / 15.0;
            let off = (city.utc_offset - solar + 36.0).rem_euclid(24.0) - 12.0;
            assert!(off.abs() < 4.0, "{} {off}", city.name);
            assert!(city.other_names.iter().all(|name| *name.to_lowercase() == **name), "{}", city.name);
        }
        // Every city answers to its own name, whatever letters it has.
        for city in CITIES.iter().step_by(37) {
            assert!(search(&format!("{}, {}", city.name, city.country), 400).0.contains(&city), "{}", city.name);
        }
    }

    #[test]
    fn places_near_a_city_bear_its_name() {
        assert_eq!(&*city_at(48.78, 9.18).unwrap().name, "Stuttgart");
        assert_eq!(&*city_at(48.74, 9.31).unwrap().name, "Esslingen");
        assert!(city_at(-10.0, 9.18).is_none());
        // Over the date line.
        let (city, distance) = nearest(-18.14, -179.9).unwrap();
        assert!(&*city.country == "Fiji" && distance < 200.0, "{} {distance}", city.name);
    }
}
