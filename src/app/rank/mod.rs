//! Ranking in the window: products are computed in a job, results are shown as they become available, and the chosen
//! product can be used in the room.

pub mod board;

use crate::app::catalogue::shelf::Shelf;
use crate::app::results::engine::Engine;
use crate::app::results::work::Outcome;
use crate::app::scene::first_choice::choose_first;
use crate::app::scene::{Selection, fill, selection_of};
use crate::app::shell::Shell;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::{JobState, Lane};
use crate::app::state::{Sheet, State};
use crate::app::tiles;
use crate::app::year::input::usual_year;
use crate::catalogue::Product;
use crate::compute::estimate::Progress;
use crate::study::StudyError;
use crate::study::control::year::CONTROLLED;
use crate::study::rank::{Answer, Item, Known, Shard, Shortlist, Stage, Store, keys, with_product};
use crate::study::rank_keys::{ObjectiveKeys, RankControlKey, RankKeys};
use crate::study::scene_file::SystemKeys;
use crate::texts::{choose as say, shell, year as of_year};
use board::{Asked, Asking, Board, ChooseAct, Figures, figures_of, objectives_of, ranked_apertures};
use std::sync::Arc;

/// Number of earlier rankings whose results are stored.
const KEPT: usize = 8;

/// Returns the ranking input for the current state of the window; `None` for a room without an aperture.
fn asked_by(state: &State) -> Option<Asked> {
    let (document, settings) = (&state.document, &state.settings);
    let asking = Asking {
        look: &settings.choose,
        query: &state.query,
        recent: &settings.recent,
        catalogue: [&document.additions, &document.changes],
    };
    Asked::of(&document.scene, state.base(), &asking)
}

/// Rankings of the window, except the results shown.
#[derive(Default)]
pub struct Ranking {
    /// Shared results of the running or last ranking, and the number of them that the window has read.
    board: Option<(Arc<Board>, u64)>,
    /// Results of earlier rankings for other inputs, to be shown again if their input returns.
    kept: Vec<Arc<Figures>>,
    /// Store of the computed annual simulations of products.
    store: Arc<Store>,
}

impl Ranking {
    /// Executes a command about the ranking.
    pub fn act(&mut self, shell: &mut Shell, act: ChooseAct) {
        match act {
            ChooseAct::Rank => self.rank(shell),
            ChooseAct::Look(look) => shell.state.settings.choose = *look,
            ChooseAct::Objectives(objective, _) => {
                let rank = shell.state.document.scene.rank.get_or_insert_default();
                rank.objective = objective;
            }
            ChooseAct::IntoRoom(product) => into_room(shell, &product),
        }
    }

    fn rank(&mut self, shell: &mut Shell) {
        let Some(shelf) = shell.state.shelf() else {
            shell.toasts.info(shell::CATALOGUE_NOT_OPEN);
            return;
        };
        let scene = &mut shell.state.document.scene;
        if scene.year.is_none() {
            scene.year = Some(usual_year(scene));
            shell.toasts.info(of_year::ADDED_EYE);
        }
        if scene.rank.as_ref().is_none_or(|rank| rank.objective.is_empty()) {
            let objective = objectives_of(scene);
            scene.rank = Some(RankKeys { objective, ..scene.rank.take().unwrap_or_default() });
            shell.toasts.info(say::ADDED_OBJECTIVES);
        }
        let figures = figures_of(scene);
        let Some(asked) = asked_by(&shell.state) else {
            shell.toasts.info(say::NO_APERTURE);
            return;
        };
        let (engine, board, store) = (shell.services.engine.clone(), Arc::<Board>::default(), self.store.clone());
        self.board = Some((board.clone(), 0));
        shell.results.rank.error = None;
        shell.bring_up(tiles::CHOOSE);
        shell.start(Lane::Rank, move |job| {
            Outcome::Ranked(ranked(asked, &figures, (&*shelf, &*engine), (&board, &store), job))
        });
    }

    /// Reads the results that a ranking has produced since the last frame, and shows those of the current input.
    pub fn follow(&mut self, shell: &mut Shell) {
        if let Some((board, seen)) = &mut self.board {
            shell.results.rank_pace = board.pace().filter(|_| shell.jobs.busy(Lane::Rank));
            if let Some((number, figures)) = board.newer(*seen) {
                *seen = number;
                shell.results.rank.put(Arc::new(figures));
            }
        }
        let looked_at = shell.sees(tiles::CHOOSE) || shell.state.sheet == Some(Sheet::Export);
        if !looked_at || shell.jobs.busy(Lane::Rank) && shell.results.rank.value.is_none() {
            return;
        }
        let asked = asked_by(&shell.state);
        let is_of = |figures: &Arc<Figures>| asked.as_ref() == Some(&figures.asked);
        let shown = shell.results.rank.value.as_ref().is_some_and(is_of);
        let other = self.kept.iter().find(|figures| is_of(figures)).cloned();
        match other.filter(|_| !shown && !shell.jobs.busy(Lane::Rank)) {
            Some(other) => shell.results.rank.put(other),
            None => shell.results.rank.stale = !shown,
        }
    }

    /// Ends a ranking: reads its last results and shows its error, if there is one.
    pub fn take(&mut self, shell: &mut Shell, result: Result<(), AppError>) {
        self.follow(shell);
        shell.results.rank_pace = None;
        if let Err(error) = result {
            shell.results.rank.error = Some(error.to_string());
        }
        self.keep(shell);
    }

    /// Stores the results of the current ranking, so that they can be shown again.
    pub fn keep(&mut self, shell: &Shell) {
        let Some(figures) = shell.results.rank.value.clone() else { return };
        let kept = &mut self.kept;
        kept.retain(|other| other.asked != figures.asked);
        kept.push(figures);
        if kept.len() > KEPT {
            kept.remove(0);
        }
    }
}

/// Returns the ranked products, if they belong to the current scene.
pub fn present_ranking(shell: &Shell) -> Option<Arc<Shortlist>> {
    let figures = shell.results.rank.value.as_ref().filter(|_| !shell.results.rank.stale)?;
    let list = figures.shortlist(&tiles::scene_name(&shell.state), &objectives_of(&shell.state.document.scene));
    list.ok().map(Arc::new)
}

/// Uses a product in the scene as it was ranked: in the same apertures, with the control rule of the product or of
/// the scene.
fn into_room(shell: &mut Shell, key: &str) {
    let Some(figures) = shell.results.rank.value.clone() else { return };
    let Some(product) = figures.products.iter().find(|one| one.key == key) else { return };
    let document = &mut shell.state.document;
    let chosen = shell.state.settings.choose.aperture.filter(|place| *place < document.scene.aperture.len());
    if let Some(place) = chosen.filter(|_| document.scene.aperture.len() > 1) {
        let filled = with_product(&figures.asked.scene, product, figures.asked.control);
        match filled.map(|scene| scene.aperture.get(place).cloned()) {
            Ok(Some(filled)) => {
                let aperture = &mut document.scene.aperture[place];
                (aperture.system, aperture.control) = (filled.system, filled.control);
            }
            Ok(None) => {}
            Err(error) => shell.toasts.error(error.to_string()),
        }
        if let Some(selection) = selection_of(&document.scene) {
            document.selection = selection;
        }
    } else {
        for place in ranked_apertures(&document.scene, None) {
            let system = &mut document.scene.aperture[place].system;
            if *system == SystemKeys::Ranked {
                *system = SystemKeys::Catalogue { key: String::new(), state: None };
            }
        }
        let by_scene = figures.asked.control == RankControlKey::Scene && product.states.len() > 1;
        let scene_control = document.scene.control.clone().filter(|_| by_scene);
        choose_first(document, product);
        if let Some(scene_control) = scene_control {
            document.selection = Selection { product: product.key.clone(), state: CONTROLLED.to_owned() };
            fill(&mut document.scene, &document.selection);
            document.scene.control = Some(scene_control);
        }
    }
    shell.state.control_of = None;
}

/// Runs a ranking in a job: finds the products of an input and computes those without results.
fn ranked(
    asked: Asked,
    figures: &[ObjectiveKeys],
    (shelf, engine): (&dyn Shelf, &dyn Engine),
    (board, store): (&Board, &Store),
    job: &JobState,
) -> Result<(), AppError> {
    job.advance("products", 0, 1);
    let found = shelf.search(&asked.query)?;
    let mut products = Vec::with_capacity(found.entries.len());
    for entry in &found.entries {
        products.push(Product::clone(&*shelf.product(&entry.key)?));
    }
    if products.is_empty() {
        return Err(StudyError::key("rank.products", say::NO_PRODUCTS.get()).into());
    }
    products.sort_by(|a, b| a.key.cmp(&b.key));
    let group = asked.group(figures, products.into())?;
    let groups = [group];
    let [group] = &groups;
    let items = Shard::WHOLE.items(&[group.products.len()]);
    let keys: Vec<String> = keys(&groups, &items).into_iter().map(|key| format!("{key} {:?}", asked.control)).collect();
    let mut figures = Figures::of(asked, group);
    let mut missing = Vec::new();
    for (item, key) in items.iter().zip(&keys) {
        match store.find(key, &group.figures) {
            Some(known) => drop(figures.known.insert(known.product.clone(), known)),
            None => missing.push(*item),
        }
    }
    board.begin(figures, missing.len());
    if missing.is_empty() {
        return Ok(());
    }
    let names: Arc<[String]> = group.figures.clone().into();
    let report = |answer: Answer<'_>| {
        let Item { product, .. } = answer.item;
        let known = Arc::new(Known {
            product: group.products[product].key.clone(),
            key: keys[product].clone(),
            stage: answer.stage,
            figures: Arc::clone(&names),
            outcome: answer.outcome.clone(),
        });
        if answer.stage == Stage::Full {
            store.keep(Arc::clone(&known));
        }
        board.put(known);
    };
    engine.rank(&groups, &missing, shelf, &report, job)
}
