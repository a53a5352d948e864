//! Which system for this façade, as the window asks it: the question, what is known of the products, and how far the work
//! is.

use super::shelf::Query;
use super::year::usual_year;
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

/// What can be done about it.
#[derive(Debug, Clone, PartialEq)]
pub enum ChooseAct {
    /// Rank the products; those that are known are not computed again.
    Rank,
    /// Look at something else of the ranking.
    Look(Box<Look>),
    /// Other objectives; `true`: one more or one less, which is a step for undo.
    Objectives(Vec<ObjectiveKeys>, bool),
    /// A product by its key into the room, as it was ranked.
    IntoRoom(String),
}

impl ChooseAct {
    /// Is what it changes in the document a step of its own for undo? Not every place of a slider.
    pub const fn is_step(&self) -> bool {
        matches!(self, Self::Rank | Self::Objectives(_, true) | Self::IntoRoom(_))
    }
}

/// What the figures of a ranking hang on, beside the products' own data.
#[derive(Debug, Clone)]
pub struct Asked {
    /// The scene without its moment, the ranked apertures open.
    pub scene: SceneFile,
    /// What its relative paths start from.
    pub base: PathBuf,
    /// By whose rule products move.
    pub control: RankControlKey,
    /// Which products.
    pub query: Query,
    /// Additions and changes of this session that hold.
    catalogue: (Vec<usize>, Vec<usize>),
}

/// Among which products a ranking chooses.
#[derive(Debug, Clone, Copy)]
pub struct Asking<'a> {
    /// How the ranking is looked at.
    pub look: &'a Look,
    /// The catalogue's search.
    pub query: &'a Query,
    /// Products that were shown last.
    pub recent: &'a [String],
    /// Additions and changes of this session that hold.
    pub catalogue: [&'a [usize]; 2],
}

/// Apertures that products go into: the chosen one; else those that a scene leaves open, those that are filled from the
/// catalogue, or the first.
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

/// The scene with the apertures open. Where it has not been written for a ranking, the rule of what is in the room is no rule
/// of other products.
fn opened(scene: &SceneFile, places: &[usize], control: RankControlKey) -> SceneFile {
    let written = scene.aperture.iter().any(|one| one.system == SystemKeys::Ranked);
    let mut open = SceneFile { rank: None, ..question(scene) };
    let told = scene.control.clone();
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
            aperture.control.clone_from(&told);
        }
    }
    open
}

impl PartialEq for Asked {
    /// A scene without files asks the same wherever it is saved.
    fn eq(&self, other: &Self) -> bool {
        self.scene == other.scene
            && self.query == other.query
            && self.control == other.control
            && self.catalogue == other.catalogue
            && (self.base == other.base || !names_files(&self.scene))
    }
}

impl Asked {
    /// Of a scene, with what its relative paths start from; `None` for a room without an aperture.
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

    /// The one list that it asks for; the weights are not its business.
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

/// What counts in a scene: its own objectives, else the usual ones.
pub fn objectives_of(scene: &SceneFile) -> Vec<ObjectiveKeys> {
    match &scene.rank {
        Some(rank) if !rank.objective.is_empty() => rank.objective.clone(),
        _ => usual_objectives(scene.year.as_ref().unwrap_or(&usual_year(scene))),
    }
}

/// What is computed of every product: what counts, and what costs next to nothing beside it.
pub fn figures_of(scene: &SceneFile) -> Vec<ObjectiveKeys> {
    let mut list = objectives_of(scene);
    for one in offered(scene.year.as_ref().unwrap_or(&usual_year(scene))) {
        if one.always && !list.iter().any(|own| own.figure == one.keys.figure) {
            list.push(one.keys);
        }
    }
    list
}

/// What is known of the products of a question.
#[derive(Debug, Clone)]
pub struct Figures {
    /// The question.
    pub asked: Asked,
    /// The list without rows.
    head: List,
    /// All that were found.
    pub products: Arc<[Product]>,
    /// What is known of them, by their keys.
    pub known: BTreeMap<String, Arc<Known>>,
}

impl Figures {
    /// Before anything is known.
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

    /// Products whose figures are coarse, or not known.
    pub fn unfinished(&self) -> usize {
        self.products.len() - self.known.values().filter(|one| one.stage == Stage::Full).count()
    }

    /// Is a figure known of all that anything is known of?
    pub fn knows(&self, figure: &String) -> bool {
        self.known.values().all(|one| one.has(std::slice::from_ref(figure)))
    }

    /// The products in order by objectives, under a name of the scene.
    ///
    /// # Errors
    /// An objective that is none.
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

/// How far a ranking is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Of what.
    pub stage: Stage,
    /// Products that are done.
    pub done: usize,
    /// Of so many.
    pub all: usize,
    /// Since the stage began.
    since: Instant,
    /// What it took until the last one. It is not asked of the clock in every frame: what it says stands still between.
    spent: Duration,
}

impl Pace {
    /// Time that the rest of the stage will take, as the first products did. \[s\]
    pub fn left(&self) -> Option<f64> {
        let each = self.spent.as_secs_f64() / self.done.max(1) as f64;
        (self.done >= 3 && self.stage == Stage::Full).then(|| each * (self.all - self.done) as f64)
    }
}

/// Where a ranking that is under way puts what it finds, and where the window looks.
#[derive(Debug, Default)]
pub struct Board(Mutex<(u64, Option<Figures>, Option<Pace>)>);

impl Board {
    fn lock(&self) -> MutexGuard<'_, (u64, Option<Figures>, Option<Pace>)> {
        // What is put there is whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is known before anything is computed, and how many are to be.
    pub fn begin(&self, figures: Figures, all: usize) {
        let mut board = self.lock();
        let pace = Pace { stage: Stage::Coarse, done: 0, all, since: Instant::now(), spent: Duration::ZERO };
        *board = (board.0 + 1, Some(figures), (all > 0).then_some(pace));
    }

    /// One more is known.
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

    /// What is there, where it is more than at a number; with its own number.
    pub fn newer(&self, than: u64) -> Option<(u64, Figures)> {
        let board = self.lock();
        let figures = board.1.as_ref().filter(|_| board.0 != than)?;
        Some((board.0, figures.clone()))
    }

    /// How far it is.
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
