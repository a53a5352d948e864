//! Ranking of products for a façade in the window: input, results per product, progress.

use crate::app::catalogue::shelf::Query;
use crate::app::year::input::usual_year;
use crate::catalogue::Product;
use crate::study::StudyError;
use crate::study::inputs::names_files;
use crate::study::rank::{
    Group, Known, List, Look, Shortlist, Stage, list_of, objectives as judged, offered, usual_objectives,
};
use crate::study::rank_keys::{ObjectiveKeys, RankControlKey, RankKeys};
use crate::study::scene_file::{SceneFile, SystemKeys};
use crate::study::year::question;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Command about the ranking.
#[derive(Debug, Clone, PartialEq)]
pub enum ChooseAct {
    /// Rank the products; results that are already known are not computed again.
    Rank,
    /// Change the display settings of the ranking.
    Look(Box<Look>),
    /// Set the objectives of the ranking; `true` if one was added or removed, which is an undo step.
    Objectives(Vec<ObjectiveKeys>, bool),
    /// Use the product with this key in the scene's room, with the control with which it was ranked.
    IntoRoom(String),
}

impl ChooseAct {
    /// Whether the command's change of the document is a separate undo step; changes while a slider is dragged are not.
    pub const fn is_step(&self) -> bool {
        matches!(self, Self::Rank | Self::Objectives(_, true) | Self::IntoRoom(_))
    }
}

/// Input that the figures of a ranking depend on, except for the data of the products.
#[derive(Debug, Clone)]
pub struct Asked {
    /// Scene without date and time, with no system in the apertures for which products are ranked.
    pub scene: SceneFile,
    /// Folder to which the paths in the scene are relative.
    pub base: PathBuf,
    /// Source of the control rule that chooses the states of the products: the product or the scene.
    pub control: RankControlKey,
    /// Search that selects the products.
    pub query: Query,
    /// Numbers of the additions to the catalogue and of the changes of products that are in effect in this session.
    catalogue: (Vec<usize>, Vec<usize>),
}

/// Selection of the products to rank: search, recent products, changes of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct Asking<'a> {
    /// Display settings of the ranking.
    pub look: &'a Look,
    /// Search of the catalogue that selects the products.
    pub query: &'a Query,
    /// Keys of recently selected products.
    pub recent: &'a [String],
    /// Numbers of the additions to the catalogue and of the changes of products that are in effect in this session.
    pub catalogue: [&'a [usize]; 2],
}

/// Returns the indices of the apertures for which products are ranked: the chosen one. If none is chosen: all
/// without a system in the scene; if there are none, all with a product of the catalogue; if there are none either, the
/// first.
pub fn ranked_apertures(scene: &SceneFile, chosen: Option<usize>) -> Vec<usize> {
    let all = |fits: fn(&SystemKeys) -> bool| -> Vec<usize> {
        (0..scene.aperture.len()).filter(|&place| fits(&scene.aperture[place].system)).collect()
    };
    if let Some(place) = chosen.filter(|place| *place < scene.aperture.len()) {
        return vec![place];
    }
    let open = all(|system| *system == SystemKeys::Ranked);
    let filled = all(|system| matches!(system, SystemKeys::Catalogue { .. }));
    match (open.is_empty(), filled.is_empty()) {
        (false, _) => open,
        (true, false) => filled,
        (true, true) => all(|_| true).into_iter().take(1).collect(),
    }
}

/// Returns the scene without a system in the given apertures. If the scene was not written for a ranking, the control
/// rule of the product in the room is not applied to other products.
fn opened(scene: &SceneFile, places: &[usize], control: RankControlKey) -> SceneFile {
    let written = scene.aperture.iter().any(|one| one.system == SystemKeys::Ranked);
    let mut open = SceneFile { rank: None, ..question(scene) };
    let scene_control = scene.control.clone();
    if !written && control == RankControlKey::Product {
        open.control = None;
    }
    for (place, aperture) in open.aperture.iter_mut().enumerate() {
        if places.contains(&place) {
            aperture.system = SystemKeys::Ranked;
            if open.control.is_none() {
                aperture.control = None;
            }
        } else if open.control.is_none() && aperture.control.is_none() {
            aperture.control.clone_from(&scene_control);
        }
    }
    open
}

impl PartialEq for Asked {
    /// Compares two inputs; the folder counts only if the scene refers to files.
    fn eq(&self, other: &Self) -> bool {
        self.scene == other.scene
            && self.query == other.query
            && self.control == other.control
            && self.catalogue == other.catalogue
            && (self.base == other.base || !names_files(&self.scene))
    }
}

impl Asked {
    /// Creates the input of a ranking from a scene and the folder to which its paths are relative; `None` for a room
    /// without an aperture.
    pub fn of(scene: &SceneFile, base: PathBuf, asking: &Asking<'_>) -> Option<Self> {
        let look = asking.look;
        let places = ranked_apertures(scene, look.aperture);
        let rank = scene.rank.as_ref();
        let control = rank.map_or_else(RankControlKey::default, |rank| rank.control);
        let mut open = opened(scene, &places, control);
        open.year.get_or_insert_with(|| usual_year(scene));
        let query = if look.in_search {
            let mut shown = if asking.query.recent { asking.recent.to_vec() } else { Vec::new() };
            // The order of the list does not matter.
            shown.sort_unstable();
            let Query { sort, descending, .. } = Query::default();
            Query { shown, sort, descending, ..asking.query.clone() }
        } else {
            Query { text: rank.map(|rank| rank.products.clone()).unwrap_or_default(), ..Query::default() }
        };
        let [additions, changes] = asking.catalogue.map(<[usize]>::to_vec);
        let catalogue = (additions, changes);
        (!places.is_empty()).then_some(Self { scene: open, base, control, query, catalogue })
    }

    /// Returns the group of products to rank, with the figures to compute; weights of the objectives have no effect on
    /// it.
    pub fn group(&self, figures: &[ObjectiveKeys], products: Arc<[Product]>) -> Result<Group, StudyError> {
        let keys = RankKeys { objective: figures.to_vec(), ..RankKeys::default() };
        let climate = self.scene.year.as_ref().map(|year| year.weather.display().to_string());
        Ok(Group {
            scene: String::new(),
            climate: climate.unwrap_or_default(),
            azimuth: self.scene.site.azimuth,
            file: Arc::new(self.scene.clone()),
            base: self.base.clone(),
            figures: figures.iter().map(|one| one.figure.clone()).collect(),
            objectives: judged(&keys)?,
            control: self.control,
            products,
        })
    }
}

/// Returns the objectives of a scene, or the default ones if it has none.
pub fn objectives_of(scene: &SceneFile) -> Vec<ObjectiveKeys> {
    match &scene.rank {
        Some(rank) if !rank.objective.is_empty() => rank.objective.clone(),
        _ => usual_objectives(scene.year.as_ref().unwrap_or(&usual_year(scene))),
    }
}

/// Returns the figures that are computed for every product: the objectives, and figures that add almost no computing
/// time.
pub fn figures_of(scene: &SceneFile) -> Vec<ObjectiveKeys> {
    let mut list = objectives_of(scene);
    for one in offered(scene.year.as_ref().unwrap_or(&usual_year(scene))) {
        if one.always && !list.iter().any(|own| own.figure == one.keys.figure) {
            list.push(one.keys);
        }
    }
    list
}

/// Results of a ranking, of those products for which they are known.
#[derive(Debug, Clone)]
pub struct Figures {
    /// Input that the results belong to.
    pub asked: Asked,
    /// Ranked list without rows: objectives, weather and scene.
    head: List,
    /// All products that the search found.
    pub products: Arc<[Product]>,
    /// Results of the products, by their keys.
    pub known: BTreeMap<String, Arc<Known>>,
}

impl Figures {
    /// Creates results without any product yet.
    pub fn of(asked: Asked, group: &Group) -> Self {
        let head = List {
            number: 0,
            scene: group.scene.clone(),
            climate: group.climate.clone(),
            azimuth: group.azimuth,
            figures: Vec::new(),
            objectives: Vec::new(),
            rows: Vec::new(),
        };
        Self { asked, head, products: Arc::clone(&group.products), known: BTreeMap::new() }
    }

    /// Returns the number of products whose figures are preliminary or not computed yet.
    pub fn unfinished(&self) -> usize {
        self.products.len() - self.known.values().filter(|one| one.stage == Stage::Full).count()
    }

    /// Whether a figure is known for all products that have results.
    pub fn knows(&self, figure: &String) -> bool {
        self.known.values().all(|one| one.has(std::slice::from_ref(figure)))
    }

    /// Returns the products ranked by the given objectives; `scene`: name of the scene in the list.
    ///
    /// # Errors
    /// Returns an error if an objective is not valid.
    pub fn shortlist(&self, scene: &str, objectives: &[ObjectiveKeys]) -> Result<Shortlist, StudyError> {
        let keys = RankKeys { objective: objectives.to_vec(), ..RankKeys::default() };
        let figures: Vec<String> = objectives.iter().map(|one| one.figure.clone()).collect();
        let known: Vec<Arc<Known>> = self.known.values().cloned().collect();
        let head = List { scene: scene.to_owned(), ..self.head.clone() };
        let list = list_of(&head, &known, &figures, &judged(&keys)?);
        let names = self.products.iter().map(|one| (one.key.clone(), one.name.clone())).collect();
        let coarse: BTreeSet<String> =
            known.iter().filter(|one| one.stage == Stage::Coarse).map(|one| one.product.clone()).collect();
        Ok(Shortlist::of(list, &names, &coarse))
    }
}

/// Progress of a running ranking in its current stage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Current stage of the computation.
    pub stage: Stage,
    /// Number of products that are finished in the stage.
    pub done: usize,
    /// Number of products of the stage.
    pub all: usize,
    /// Time at which the stage began.
    since: Instant,
    /// Time from the start of the stage to the last finished product, updated only then, so that the displayed time
    /// does not change between products.
    spent: Duration,
}

impl Pace {
    /// Returns the estimated remaining time of the stage, from the mean time per finished product; `None` before the
    /// first. \[s\]
    pub fn left(&self) -> Option<f64> {
        let each = self.spent.as_secs_f64() / self.done.max(1) as f64;
        (self.done >= 3 && self.stage == Stage::Full).then(|| each * (self.all - self.done) as f64)
    }
}

/// Shared results of a running ranking, written by the job and read by the window.
#[derive(Debug, Default)]
pub struct Board(Mutex<(u64, Option<Figures>, Option<Pace>)>);

impl Board {
    fn lock(&self) -> MutexGuard<'_, (u64, Option<Figures>, Option<Pace>)> {
        // What is put there is whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Stores the results that are known at the start, and the number `all` of products to compute.
    pub fn begin(&self, figures: Figures, all: usize) {
        let mut board = self.lock();
        let pace = Pace { stage: Stage::Coarse, done: 0, all, since: Instant::now(), spent: Duration::ZERO };
        *board = (board.0 + 1, Some(figures), (all > 0).then_some(pace));
    }

    /// Adds the result of one product.
    pub fn put(&self, known: Arc<Known>) {
        let mut board = self.lock();
        let (number, figures, pace) = &mut *board;
        *number += 1;
        if let Some(pace) = pace {
            if pace.stage != known.stage {
                *pace = Pace { stage: known.stage, done: 0, since: Instant::now(), ..*pace };
            }
            pace.done += 1;
            pace.spent = pace.since.elapsed();
        }
        if let Some(figures) = figures {
            figures.known.insert(known.product.clone(), known);
        }
    }

    /// Returns the results with their revision number, if this differs from `than`.
    pub fn newer(&self, than: u64) -> Option<(u64, Figures)> {
        let board = self.lock();
        let figures = board.1.as_ref().filter(|_| board.0 != than)?;
        Some((board.0, figures.clone()))
    }

    /// Returns the progress of the ranking.
    pub fn pace(&self) -> Option<Pace> {
        self.lock().2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::example::first_scene;
    use crate::study::scene_file::{ControlKeys, ControlMode};
    use crate::study::year_keys::YearKeys;

    fn scene() -> SceneFile {
        let mut scene = first_scene();
        scene.aperture[0].system = SystemKeys::Catalogue { key: "a".to_owned(), state: None };
        scene
    }

    fn asked(scene: &SceneFile, aperture: Option<usize>) -> Option<Asked> {
        let look = Look { aperture, ..Look::default() };
        let query = Query::default();
        Asked::of(scene, PathBuf::new(), &Asking { look: &look, query: &query, recent: &[], catalogue: [&[], &[]] })
    }

    #[test]
    fn what_is_in_the_room_is_no_part_of_the_question() {
        let mut scene = scene();
        let first = asked(&scene, None).unwrap();
        assert_eq!(first.scene.aperture[0].system, SystemKeys::Ranked);
        assert!(first.scene.year.is_some());
        // Another product under its own rule, another moment, weights.
        scene.aperture[0].system = SystemKeys::Catalogue { key: "b".to_owned(), state: Some("controlled".to_owned()) };
        scene.control = Some(ControlKeys::of(ControlMode::Curve));
        scene.sky.cie_type = Some(3);
        scene.rank = Some(RankKeys { objective: objectives_of(&scene), ..RankKeys::default() });
        assert_eq!(asked(&scene, None).unwrap(), first);
        // The room is, and so is the rule where the scene says that all move by it.
        scene.rank.as_mut().unwrap().control = RankControlKey::Scene;
        let mode = |asked: Asked| asked.scene.control.map(|keys| keys.mode);
        assert_eq!(mode(asked(&scene, None).unwrap()), Some(ControlMode::Curve));
        scene.rank = None;
        scene.room.depth += 1.0;
        assert_ne!(asked(&scene, None).unwrap(), first);
        scene.aperture.clear();
        assert!(asked(&scene, None).is_none());
    }

    #[test]
    fn a_scene_without_files_asks_the_same_wherever_it_is_saved() {
        let look = Look::default();
        let of = |scene: &SceneFile, base: &str| {
            let query = Query { recent: true, ..Query::default() };
            let asking = Asking { look: &look, query: &query, recent: &[], catalogue: [&[], &[]] };
            Asked::of(scene, base.into(), &asking).unwrap()
        };
        let mut scene = scene();
        assert_eq!(of(&scene, ""), of(&scene, "/data/office"));
        scene.year = Some(YearKeys { weather: "own.epw".into(), ..usual_year(&scene) });
        assert_ne!(of(&scene, ""), of(&scene, "/data/office"));
        assert_eq!(of(&scene, "/data/office").base, PathBuf::from("/data/office"), "what paths start from is kept");
    }

    #[test]
    fn other_apertures_keep_the_rule_that_they_had() {
        let mut scene = scene();
        let first = scene.aperture[0].clone();
        scene.aperture.push(first);
        scene.control = Some(ControlKeys::of(ControlMode::Din5034));
        assert_eq!(ranked_apertures(&scene, None), [0, 1]);
        let asked = asked(&scene, Some(1)).unwrap().scene;
        assert_eq!(asked.aperture[1].system, SystemKeys::Ranked);
        let mode = asked.aperture[0].control.as_ref().map(|keys| keys.mode);
        assert_eq!((mode, asked.control), (Some(ControlMode::Din5034), None));
        assert_eq!(asked.aperture[1].control, None);
    }

    #[test]
    fn what_costs_nothing_is_found_whether_it_counts_or_not() {
        let keys: Vec<String> = figures_of(&scene()).into_iter().map(|one| one.figure).collect();
        for figure in ["lighting.LENI_kWh_m2", "UDI_a", "UDI_x", "cDA300", "movements"] {
            assert_eq!(keys.iter().filter(|key| *key == figure).count(), 1, "{figure} in {keys:?}");
        }
    }
}
