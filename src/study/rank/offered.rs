//! Annual figures that can be objectives of a ranking, with their default scale limits; and the default objectives of a
//! scene without any.

use crate::study::rank_keys::ObjectiveKeys;
use crate::study::year::{Scale, metric, scales};
use crate::study::year_keys::YearKeys;

/// Annual figure that can be an objective of a ranking.
#[derive(Debug, Clone, PartialEq)]
pub struct Offered {
    /// Objective with default scale limits, and weight 1.
    pub keys: ObjectiveKeys,
    /// Whether every year of the scene has the figure at negligible cost, so that it is computed for every product,
    /// requested or not.
    pub always: bool,
}

/// Returns the figures that can be objectives in a scene with these keys of a year.
pub fn offered(year: &YearKeys) -> Vec<Offered> {
    let of = |(figure, Scale { better, worst, best, always }): (String, Scale)| Offered {
        keys: ObjectiveKeys { figure, better, worst, best, weight: 1.0 },
        always,
    };
    scales(year).into_iter().map(of).collect()
}

/// Returns the default objectives of a scene that has none: lighting energy, useful daylight, glare at the first
/// observer (by DGPs, which every year has), state changes.
pub fn usual_objectives(year: &YearKeys) -> Vec<ObjectiveKeys> {
    let list = offered(year);
    let glare = list.iter().find(|one| one.keys.figure.starts_with("glare.")).map(|one| one.keys.figure.as_str());
    let wanted = ["lighting.LENI_kWh_m2", "UDI_a"].into_iter().chain(glare).chain(["movements"]);
    let found = wanted.filter_map(|key| list.iter().find(|one| one.keys.figure == key)).map(|one| one.keys.clone());
    // State changes disturb, but seldom decide.
    found.map(|keys| if keys.figure == "movements" { ObjectiveKeys { weight: 0.5, ..keys } } else { keys }).collect()
}

/// Returns the label of an annual figure and its unit; `%` for shares of 0 … 1. An unknown figure is labelled by its
/// key.
pub fn figure_words(key: &str) -> (String, &'static str) {
    metric(key).map_or_else(|| (key.to_owned(), ""), |(metric, index)| (metric.name(index), metric.unit))
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
        // Symbols are labels themselves; all others have one of their own.
        let labelled = |key: &str| ["DA300", "DA500", "cDA300"].contains(&key) || figure_words(key).0 != key;
        assert!(all.iter().all(|one| labelled(&one.figure)), "{all:?}");
        assert_eq!(figure_words("EN17037.minimum.met_by_point"), ("EN17037.minimum.met_by_point".to_owned(), ""));
    }
}
