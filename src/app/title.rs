//! Title of the window: selected product, site, date and time as text.

use super::scene::own_system;
use super::state::{CatalogueState, State};
use crate::app::scene::control;
use crate::app::scene::moment;
use crate::catalogue::Product;
use crate::study::control::year::CONTROLLED;
use crate::study::sky::is_elsewhere;
use crate::study::weather::kept;
use crate::texts::shell;

pub use crate::study::scene_words::{coordinates, place, site, sky, system, time};

/// Returns the name of the selected product; while the product is being loaded, its name in the list of products, or
/// else its key.
pub fn product(state: &State) -> String {
    let key = &state.document.selection.product;
    let listed = || state.found.entries.iter().find(|entry| entry.key == *key).map(|entry| entry.name.clone());
    selected(state).map(|product| product.name.clone()).or_else(listed).unwrap_or_else(|| key.clone())
}

/// Returns the selected product; `None` until it is loaded.
pub fn selected(state: &State) -> Option<&Product> {
    state.product.as_deref().filter(|product| product.key == state.document.selection.product)
}

/// Returns name and state of the selected product as text.
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

/// Returns the name of the system in the apertures: product and state of the selection, or the system given in the
/// scene if no aperture has a product of the catalogue.
pub fn in_room(state: &State) -> String {
    own_system(&state.document.scene).map_or_else(|| selection(state), system)
}

/// Returns the whole title of the window.
pub fn title(state: &State) -> String {
    let scene = &state.document.scene;
    let product = in_room(state);
    let product = match (&state.catalogue, product.is_empty()) {
        (_, false) => product,
        (CatalogueState::Opening, true) => shell::OPENING_CATALOGUE.into(),
        (_, true) => shell::NO_PRODUCT_WORD.into(),
    };
    let weather = scene.sky.weather.as_deref().and_then(|name| kept(name, &state.base()).ok());
    let elsewhere = weather.is_some_and(|kept| is_elsewhere(&kept.weather.station, &scene.site));
    let elsewhere = if elsewhere { shell::WEATHER_ELSEWHERE.get() } else { "" };
    format!(
        "cfs – {product} · {}{elsewhere}, {}, {}, {}",
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
    use crate::study::scene_file::SunKeys;

    #[test]
    fn scenes_read_as_words() {
        let mut scene = first_scene();
        assert_eq!(place(&scene), "Stuttgart");
        assert_eq!(time(&scene), "21 Mar 12:00");
        assert_eq!(sky(&scene), "clear (CIE 12)");
        scene.site.latitude = Some(-10.0);
        assert_eq!(place(&scene), "10.00°S 9.18°E");
        scene.sky.time = None;
        for (altitude, words) in [
            (-15.0, "sun 15° below the horizon, azimuth 180°"),
            (-0.4, "sun on the horizon, azimuth 180°"),
            (15.0, "sun at 15°, azimuth 180°"),
        ] {
            scene.sky.sun = SunKeys { altitude: Some(altitude), azimuth: Some(180.0), direct_normal: None };
            assert_eq!(time(&scene), words);
        }
    }
}
