//! Checks of the keys `[rank]`, and the lists that a scene asks for: one for each climate and azimuth.

use crate::catalogue::Product;
use crate::compute::rank::{Better, Objective};
use crate::study::error::StudyError;
use crate::study::scene_file::{BetterKey, ObjectiveKeys, RankControlKey, RankKeys, SceneFile, SystemKeys};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Input of one ranked list: products in one scene, climate and azimuth.
#[derive(Debug, Clone)]
pub struct Group {
    /// Name of the scene.
    pub scene: String,
    /// Weather file or built-in year, by its name in the scene.
    pub climate: String,
    /// Bearing of the façade's outward normal. \[°\]
    pub azimuth: f64,
    /// Scene with the list's weather and azimuth; its ranked apertures have no product yet.
    pub file: Arc<SceneFile>,
    /// Folder from which relative paths of the scene start.
    pub base: PathBuf,
    /// Keys of the annual figures, one for each objective.
    pub figures: Vec<String>,
    /// Objectives by which products are ranked, in the order of the figures.
    pub objectives: Vec<Objective>,
    /// Source of the control rule of moving products: product or scene.
    pub control: RankControlKey,
    /// Products to be ranked, sorted by their keys.
    pub products: Arc<[Product]>,
}

/// Returns the lists that a scene asks for: climates in their order, azimuths in theirs. `find`: searches products by
/// words; `words`: search words that replace those of the scene.
///
/// # Errors
/// Returns an error if there is no `[rank]` or no ranked aperture, if an objective is not valid, or if no product is
/// found.
pub fn groups(
    name: &str,
    file: &SceneFile,
    base: &Path,
    words: Option<&str>,
    find: &dyn Fn(&str) -> Result<Vec<Product>, StudyError>,
) -> Result<Vec<Group>, StudyError> {
    let keys = file
        .rank
        .as_ref()
        .ok_or_else(|| StudyError::key("rank", "missing: a ranking needs a [rank] section with [[rank.objective]]"))?;
    if !file.aperture.iter().any(|aperture| aperture.system == SystemKeys::Ranked) {
        let message = "none is ranked: give the one that products are to fill system = \"ranked\"";
        return Err(StudyError::key("aperture", message));
    }
    let year = file
        .year
        .as_ref()
        .ok_or_else(|| StudyError::key("year", "missing: a ranking needs a [year] section with weather = \"x.epw\""))?;
    let objectives = objectives(keys)?;
    let azimuths = if keys.azimuths.is_empty() { vec![file.site.azimuth] } else { keys.azimuths.clone() };
    if let Some(wrong) = azimuths.iter().find(|azimuth| !(-360.0..=360.0).contains(*azimuth)) {
        return Err(StudyError::key("rank.azimuths", format!("{wrong}° is out of range (allowed: -360 to 360°)")));
    }
    let climates = if keys.weather.is_empty() { vec![year.weather.clone()] } else { keys.weather.clone() };
    twice("rank.azimuths", &azimuths.iter().map(f64::to_string).collect::<Vec<_>>())?;
    twice("rank.weather", &climates.iter().map(|path| path.display().to_string()).collect::<Vec<_>>())?;
    let words = words.unwrap_or(&keys.products);
    let mut products = find(words)?;
    if products.is_empty() {
        return Err(StudyError::key("rank.products", format!("no product of the catalogue is found by \"{words}\"")));
    }
    products.sort_by(|a, b| a.key.cmp(&b.key));
    let products: Arc<[Product]> = products.into();
    let mut list = Vec::with_capacity(climates.len() * azimuths.len());
    for weather in &climates {
        for azimuth in &azimuths {
            let mut own = file.clone();
            own.site.azimuth = *azimuth;
            own.year = Some(crate::study::year_keys::YearKeys { weather: weather.clone(), ..year.clone() });
            list.push(Group {
                scene: name.to_owned(),
                climate: weather.display().to_string(),
                azimuth: *azimuth,
                file: Arc::new(own),
                base: base.to_owned(),
                figures: keys.objective.iter().map(|one| one.figure.clone()).collect(),
                objectives: objectives.clone(),
                control: keys.control,
                products: Arc::clone(&products),
            });
        }
    }
    Ok(list)
}

/// Returns an error if an entry of a key occurs twice, because rows of a table would then not be distinct.
fn twice(key: &str, list: &[String]) -> Result<(), StudyError> {
    match list.iter().enumerate().find(|(place, one)| list[..*place].contains(one)) {
        Some((_, one)) => Err(StudyError::key(key, format!("{one} is named twice; expected each once"))),
        None => Ok(()),
    }
}

/// Returns the objectives of the keys `[rank]`.
///
/// # Errors
/// Returns an error that names the wrong key.
pub fn objectives(keys: &RankKeys) -> Result<Vec<Objective>, StudyError> {
    if keys.objective.is_empty() {
        return Err(StudyError::key("rank.objective", "missing: name one figure at least, as [[rank.objective]]"));
    }
    let figures: Vec<String> = keys.objective.iter().map(|one| one.figure.clone()).collect();
    twice("rank.objective", &figures)?;
    keys.objective.iter().enumerate().map(|(place, one)| objective(place + 1, one)).collect()
}

/// Checks one objective, by its number from 1, and returns it with its scale limits.
fn objective(number: usize, keys: &ObjectiveKeys) -> Result<Objective, StudyError> {
    let wrong = |key: &str, message: String| Err(StudyError::key(format!("rank.objective[{number}].{key}"), message));
    let ObjectiveKeys { figure, better, worst, best, weight } = keys;
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-');
    if figure.is_empty() || !figure.chars().all(plain) {
        return wrong("figure", format!("\"{figure}\" is not the key of a figure; e.g. \"lighting.LENI_kWh_m2\""));
    }
    for (key, value) in [("worst", *worst), ("best", *best)] {
        if !value.is_finite() {
            return wrong(key, format!("{value} is not a number"));
        }
    }
    if !(weight.is_finite() && *weight > 0.0) {
        return wrong("weight", format!("{weight} (allowed: above 0)"));
    }
    let better = match better {
        BetterKey::Less => Better::Less,
        BetterKey::More => Better::More,
    };
    let objective = Objective { better, worst: *worst, best: *best, weight: *weight };
    if !objective.prefers(*best, *worst) {
        let word = if better == Better::Less { "less" } else { "more" };
        return wrong("best", format!("{best} is not better than worst = {worst}, where {word} is better"));
    }
    Ok(objective)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::example::first_scene;

    fn scene(rank: &str) -> SceneFile {
        let mut file = first_scene();
        file.aperture[0].system = SystemKeys::Ranked;
        file.year = Some(toml::from_str("weather = \"builtin:renton\"").unwrap());
        file.rank = Some(toml::from_str(rank).unwrap());
        file
    }

    const ONE: &str = "[[objective]]\nfigure = \"UDI_x\"\nbetter = \"less\"\nworst = 0.5\nbest = 0.0\n";

    fn asked(file: &SceneFile) -> Result<Vec<Group>, StudyError> {
        groups("a", file, Path::new(""), None, &|_| Ok(Vec::new()))
    }

    #[test]
    fn wrong_keys_are_told_by_name() {
        for (text, words) in [
            ("", "rank.objective: missing"),
            (&*format!("azimuths = [400.0]\n{ONE}"), "rank.azimuths: 400°"),
            (&*format!("azimuths = [90.0, 90.0]\n{ONE}"), "rank.azimuths: 90 is named twice"),
            (&*format!("weather = [\"a.epw\", \"a.epw\"]\n{ONE}"), "rank.weather: a.epw is named twice"),
            (&*format!("{ONE}{ONE}"), "rank.objective: UDI_x is named twice"),
            (
                &*ONE.replace("0.5", "0.0"),
                "rank.objective[1].best: 0 is not better than worst = 0, where less is better",
            ),
            (&*ONE.replace("less", "more"), "rank.objective[1].best: 0 is not better than worst = 0.5"),
            (&*format!("{ONE}weight = 0.0\n"), "rank.objective[1].weight: 0 (allowed: above 0)"),
            (&*ONE.replace("UDI_x", "UDI x"), "rank.objective[1].figure: \"UDI x\""),
            (
                &*format!("products = \"none\"\n{ONE}"),
                "rank.products: no product of the catalogue is found by \"none\"",
            ),
        ] {
            let error = asked(&scene(text)).unwrap_err().to_string();
            assert!(error.starts_with(words), "{text}: {error}");
        }
        let error = asked(&SceneFile { rank: None, ..scene(ONE) }).unwrap_err().to_string();
        assert!(error.starts_with("rank: missing"), "{error}");
        let error = asked(&SceneFile { year: None, ..scene(ONE) }).unwrap_err().to_string();
        assert!(error.starts_with("year: missing"), "{error}");
        let mut plain = scene(ONE);
        plain.aperture[0].system = SystemKeys::Catalogue { key: "x".to_owned(), state: None };
        assert!(asked(&plain).unwrap_err().to_string().starts_with("aperture: none is ranked"));
    }

    #[test]
    fn scenes_with_a_ranking_are_written_as_they_are_read() {
        let file = scene(&format!("products = \"blind\"\ncontrol = \"scene\"\nazimuths = [90.0]\n{ONE}"));
        let text = toml::to_string(&file).unwrap();
        assert!(text.contains("system = \"ranked\""), "{text}");
        assert_eq!(SceneFile::parse(&text).unwrap(), file);
        let error = SceneFile::parse(&text.replace("\"ranked\"", "\"rankde\"")).unwrap_err().to_string();
        assert!(error.contains("the word \"ranked\""), "{error}");
    }
}
