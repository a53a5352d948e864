//! The window's title: what is selected, where and when, in words.

use super::state::State;
use super::{control, moment};
use crate::catalogue::Product;
use crate::study::control::year::CONTROLLED;
use crate::study::scene_file::{SceneFile, SkyModelKey};

/// Cities of the short list: name, latitude, longitude \[°\], hours ahead of UTC (standard time).
pub const CITIES: [(&str, f64, f64, f64); 14] = [
    ("Stuttgart", 48.78, 9.18, 1.0),
    ("Freiburg", 48.0, 7.85, 1.0),
    ("Berlin", 52.52, 13.4, 1.0),
    ("London", 51.51, -0.13, 0.0),
    ("Lausanne", 46.52, 6.63, 1.0),
    ("Rome", 41.9, 12.5, 1.0),
    ("Stockholm", 59.33, 18.07, 1.0),
    ("New York", 40.71, -74.01, -5.0),
    ("Berkeley", 37.87, -122.27, -8.0),
    ("Mexico City", 19.43, -99.13, -6.0),
    ("Singapore", 1.35, 103.82, 8.0),
    ("Tokyo", 35.68, 139.69, 9.0),
    ("Sydney", -33.87, 151.21, 10.0),
    ("Cape Town", -33.92, 18.42, 2.0),
];

/// The place in words: a city of the list, else coordinates.
pub fn place(scene: &SceneFile) -> String {
    let (Some(latitude), Some(longitude)) = (scene.site.latitude, scene.site.longitude) else {
        return "no place".to_owned();
    };
    let near = |(_, lat, lon, _): &&(&str, f64, f64, f64)| (lat - latitude).hypot(lon - longitude) < 0.05;
    CITIES.iter().find(near).map_or_else(
        || {
            let ns = if latitude < 0.0 { "S" } else { "N" };
            let ew = if longitude < 0.0 { "W" } else { "E" };
            format!("{:.2}°{ns} {:.2}°{ew}", latitude.abs(), longitude.abs())
        },
        |city| city.0.to_owned(),
    )
}

/// The moment in words.
pub fn time(scene: &SceneFile) -> String {
    moment::of(scene).map_or_else(
        || match (scene.sky.sun.altitude, scene.sky.sun.azimuth) {
            (Some(altitude), Some(azimuth)) => format!("sun {altitude:.0}° high at {azimuth:.0}°"),
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

/// Name of the selected product: the product's own, whatever the list shows. While it is read, the list's, else its key.
pub fn product(state: &State) -> String {
    let key = &state.document.selection.product;
    let listed = || state.found.entries.iter().find(|entry| entry.key == *key).map(|entry| entry.name.clone());
    selected(state).map(|product| product.name.clone()).or_else(listed).unwrap_or_else(|| key.clone())
}

/// The selected product, once it was read.
pub fn selected(state: &State) -> Option<&Product> {
    state.product.as_deref().filter(|product| product.key == state.document.selection.product)
}

/// Product and state in words.
pub fn selection(state: &State) -> String {
    let name = product(state);
    let key = match state.document.selection.state.as_str() {
        CONTROLLED if state.shown_state.is_empty() => CONTROLLED,
        "" | CONTROLLED => state.shown_state.as_str(),
        key => key,
    };
    let known = selected(state).and_then(|product| product.states.iter().find(|one| one.key == key));
    let words = known.map_or_else(|| key.to_owned(), control::state_words);
    if words.is_empty() || name.is_empty() { name } else { format!("{name}, {words}") }
}

/// The whole title.
pub fn title(state: &State) -> String {
    let scene = &state.document.scene;
    let product = selection(state);
    let product = if product.is_empty() { "no product".to_owned() } else { product };
    format!(
        "cfs – {product} · {}, {}, {}, {}",
        place(scene),
        moment::bearing_word(scene.site.azimuth),
        time(scene),
        sky(scene)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::first_scene;

    #[test]
    fn scenes_read_as_words() {
        let mut scene = first_scene();
        assert_eq!(place(&scene), "Stuttgart");
        assert_eq!(time(&scene), "21 Mar 12:00");
        assert_eq!(sky(&scene), "clear (CIE 12)");
        scene.site.latitude = Some(-10.0);
        assert_eq!(place(&scene), "10.00°S 9.18°E");
    }
}
