//! Figures that objectives can use, with their initial scale limits and direction; and the default objectives of a
//! scene without any.

use crate::study::rank_keys::{BetterKey, ObjectiveKeys};
use crate::study::year_keys::YearKeys;
use crate::texts::{Text, choose as say};

/// A figure that may be an objective.
#[derive(Debug, Clone, PartialEq)]
pub struct Offered {
    /// Initial objective, with weight 1.
    pub keys: ObjectiveKeys,
    /// Whether every year of the scene has the figure at negligible cost: computed for every product, requested or not.
    pub always: bool,
}

/// Approximate hours per year at full power of electric lighting without daylight. \[h\]
const FULL_HOURS: f64 = 2500.0;

/// Returns the figures that a scene with this year can use.
pub fn offered(year: &YearKeys) -> Vec<Offered> {
    let one = |figure: &str, better, worst, best, always| Offered {
        keys: ObjectiveKeys { figure: figure.to_owned(), better, worst, best, weight: 1.0 },
        always,
    };
    let (less, more) = (BetterKey::Less, BetterKey::More);
    let mut list = Vec::new();
    if let Some(lamps) = &year.lighting {
        let worst = (lamps.power * FULL_HOURS / 1000.0).max(1.0);
        list.push(one("lighting.LENI_kWh_m2", less, worst, 0.0, true));
    }
    list.extend([
        one("UDI_a", more, 0.2, 0.9, true),
        one("UDI_x", less, 0.4, 0.0, true),
        one("UDI_n", less, 0.4, 0.0, true),
        one("cDA300", more, 0.3, 0.95, true),
        one("DA300", more, 0.2, 0.9, true),
        one("DA500", more, 0.1, 0.8, true),
        one("sDA300_50", more, 0.0, 1.0, true),
        one("movements", less, 1500.0, 0.0, true),
    ]);
    for eye in 1..=year.eyes.len() {
        list.push(one(&format!("glare.Ev_{eye}.share_above_0.40"), less, 0.3, 0.0, true));
        if year.dgp {
            list.push(one(&format!("glare.Ev_{eye}.DGP_share_above_0.40"), less, 0.3, 0.0, false));
        }
    }
    list.extend([one("ASE1000_250", less, 0.5, 0.0, false), one("sun_hours_1000", less, 600.0, 0.0, false)]);
    if year.solar {
        list.push(one("solar.summer_kWh_m2", less, 200.0, 0.0, false));
    }
    list
}

/// Returns the default objectives of a scene without any: lighting energy, useful daylight, glare at the first observer
/// (by DGPs, which every year has), state changes.
pub fn usual_objectives(year: &YearKeys) -> Vec<ObjectiveKeys> {
    let list = offered(year);
    let glare = list.iter().find(|one| one.keys.figure.starts_with("glare.")).map(|one| one.keys.figure.as_str());
    let wanted = ["lighting.LENI_kWh_m2", "UDI_a"].into_iter().chain(glare).chain(["movements"]);
    let found = wanted.filter_map(|key| list.iter().find(|one| one.keys.figure == key)).map(|one| one.keys.clone());
    // State changes disturb, but seldom decide.
    found.map(|keys| if keys.figure == "movements" { ObjectiveKeys { weight: 0.5, ..keys } } else { keys }).collect()
}

/// Returns the label of a figure and its unit; `%` for shares of 0 … 1. An unknown figure is labelled by its key.
pub fn figure_words(key: &str) -> (String, &'static str) {
    let known = |text: Text, unit| (text.get().to_owned(), unit);
    match key {
        "lighting.LENI_kWh_m2" => known(say::LIGHTING_ENERGY, "kWh/m²"),
        "UDI_a" => known(say::USEFUL_LIGHT, "%"),
        "UDI_x" => known(say::TOO_MUCH_LIGHT, "%"),
        "UDI_n" => known(say::TOO_LITTLE_LIGHT, "%"),
        "UDI_s" => known(say::SOME_LIGHT, "%"),
        "cDA300" => known(say::CONTINUOUS_AUTONOMY, "%"),
        "DA300" => known(say::AUTONOMY_300, "%"),
        "DA500" => known(say::AUTONOMY_500, "%"),
        "sDA300_50" => known(say::SPATIAL_AUTONOMY, "%"),
        "ASE1000_250" => known(say::SUN_EXPOSURE, "%"),
        "sun_hours_1000" => known(say::SUN_HOURS, "h"),
        "movements" => known(say::MOVEMENTS, ""),
        "annual_mean_lx" => known(say::MEAN_LIGHT, "lx"),
        "solar.summer_kWh_m2" => known(say::SUMMER_SUN, "kWh/m²"),
        _ => eye_words(key).unwrap_or_else(|| (key.to_owned(), "")),
    }
}

/// Returns label and unit of glare at an observer.
fn eye_words(key: &str) -> Option<(String, &'static str)> {
    let (eye, what) = key.strip_prefix("glare.Ev_")?.split_once('.')?;
    match what {
        "DGP_share_above_0.40" => Some((say::glare_of(eye), "%")),
        "share_above_0.40" => Some((say::simple_glare_of(eye), "%")),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::example::first_scene;
    use crate::study::rank::groups;
    use crate::study::scene_file::{SceneFile, SystemKeys};
    use std::path::Path;

    fn year(text: &str) -> YearKeys {
        toml::from_str(&format!("weather = \"builtin:renton\"\n{text}")).unwrap()
    }

    #[test]
    fn what_is_offered_is_what_the_scene_can_have() {
        let keys = |year: &YearKeys| offered(year).into_iter().map(|one| one.keys.figure).collect::<Vec<_>>();
        let bare = keys(&year(""));
        assert!(!bare.iter().any(|key| key.starts_with("glare") || key.starts_with("lighting")), "{bare:?}");
        let eye = "eyes = [{ point = [2.0, 2.5, 1.2], direction = [0.0, -1.0, 0.0] }]\n";
        let full = year(&format!("{eye}[lighting]\npower = 8.0\ntarget = 500.0\n"));
        let usual: Vec<String> = usual_objectives(&full).into_iter().map(|one| one.figure).collect();
        assert_eq!(usual[..2], ["lighting.LENI_kWh_m2", "UDI_a"]);
        assert!(usual[2].starts_with("glare.Ev_1.") && usual[3] == "movements" && usual.len() == 4, "{usual:?}");
        assert_eq!(usual_objectives(&year("")).len(), 2);
    }

    #[test]
    fn every_offer_is_an_objective_that_a_ranking_takes_and_has_a_name() {
        let eyes = "eyes = [{ point = [2.0, 2.5, 1.2], direction = [0.0, -1.0, 0.0] }]\nsolar = true\n";
        let year = year(&format!("{eyes}[lighting]\npower = 8.0\ntarget = 500.0\n"));
        let mut file: SceneFile = first_scene();
        file.aperture[0].system = SystemKeys::Ranked;
        file.rank = Some(crate::study::rank_keys::RankKeys {
            objective: offered(&year).into_iter().map(|one| one.keys).collect(),
            ..Default::default()
        });
        let all = file.rank.as_ref().unwrap().objective.clone();
        file.year = Some(year);
        // No product is there: all else was right.
        let error = groups("a", &file, Path::new(""), None, &|_| Ok(Vec::new())).unwrap_err().to_string();
        assert!(error.starts_with("rank.products"), "{error}");
        assert!(all.iter().all(|one| figure_words(&one.figure).0 != one.figure), "{all:?}");
        assert_eq!(figure_words("EN17037.minimum.met_by_point"), ("EN17037.minimum.met_by_point".to_owned(), ""));
    }
}
