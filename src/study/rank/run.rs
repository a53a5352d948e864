//! All products of all lists, side by side, stage by stage: by data on their cells, with beams as they are.

use super::figures::{Outcome, Setting, Stage};
use super::list::{List, Row};
use super::parts::Grouping;
use super::question::{Group, objectives};
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::rank::utility;
use crate::study::error::StudyError;
use crate::study::goniophotometer::Withdrawn;
use crate::study::scene_file::{Interpolation, SceneFile};
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use crate::study::year::{
    Climate, climate,
    metrics::{counts_direct_sun, counts_unoccupied},
};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// One product of one list: indices of the group, and of the product in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Item {
    /// Which list.
    pub group: usize,
    /// Which of its products.
    pub product: usize,
}

/// A result as soon as it is there.
#[derive(Debug, Clone, Copy)]
pub struct Answer<'a> {
    /// Of what.
    pub item: Item,
    /// How far the work on it has come.
    pub stage: Stage,
    /// What came out.
    pub outcome: &'a Outcome,
}

/// What is known of a list before any product is.
struct Ready {
    climate: Climate,
    by_cells: Climate,
    grouping: Grouping,
}

/// Computes items, those of few states first, and what an earlier stage found best before the rest. Results do not depend on
/// the number of threads. All of them come through a stage before any enters the next; `told` hears of every result when it is
/// there, from any thread.
///
/// # Errors
/// A climate that cannot be read, a figure that no year has; cancelled. What is wrong with a product is its outcome.
pub fn run(
    groups: &[Group],
    items: &[Item],
    library: &dyn SystemLibrary,
    session: &Session,
    stages: &[Stage],
    told: &(dyn Fn(Answer<'_>) + Sync),
    progress: &dyn Progress,
) -> Result<Vec<Outcome>, StudyError> {
    let mut ready: BTreeMap<usize, Ready> = BTreeMap::new();
    for item in items {
        if !ready.contains_key(&item.group) {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            let group = &groups[item.group];
            progress.advance("weather", ready.len(), groups.len());
            let mut climate = climate(&group.file, &group.base)?;
            // What no objective asks for is not computed.
            let asks = |word: &str| group.figures.iter().any(|figure| figure.contains(word));
            climate.settings.keys.solar = asks("solar.");
            climate.settings.keys.lm83 = asks("LM83") || asks("blinds_closed");
            climate.settings.keys.dgp &= asks("DGP_");
            climate.settings.direct_sun = group.figures.iter().any(|figure| counts_direct_sun(figure));
            climate.settings.unoccupied = group.figures.iter().any(|figure| counts_unoccupied(figure));
            let grouping = Grouping::of(&group.file, &climate)?;
            let mut by_cells = climate.clone();
            (by_cells.settings.keys.dgp, by_cells.settings.keys.lm83) = (false, false);
            ready.insert(item.group, Ready { climate, by_cells, grouping });
        }
    }
    let setting = |item: &Item| {
        let (group, Ready { climate, by_cells, grouping }) = (&groups[item.group], &ready[&item.group]);
        Setting { group, climate, by_cells, grouping, library, session }
    };
    let one = |item: &Item, stage: Stage| {
        setting(item).product(&groups[item.group].products[item.product], stage, &Withdrawn(progress))
    };
    // What is wrong with a scene is told once, before its products are computed in vain.
    let mut asked: Vec<&str> = Vec::new();
    for item in items {
        let group = &groups[item.group];
        if !asked.contains(&group.scene.as_str()) {
            asked.push(&group.scene);
            setting(item).check(&group.products[item.product], &Withdrawn(progress))?;
        }
    }
    // Those that stand still first: they are quick, and whoever waits sees a list.
    let states = |at: &usize| groups[items[*at].group].products[items[*at].product].states.len();
    let mut order: Vec<usize> = (0..items.len()).collect();
    order.sort_by_key(states);
    let mut outcomes: Vec<Option<Outcome>> = Vec::new();
    for stage in stages {
        let mut own = order.clone();
        // Whoever waits sees first what the best come to.
        own.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|at| promise(&groups[items[at].group], outcomes.get(at).and_then(Option::as_ref)));
            b.total_cmp(&a)
        });
        if *stage == Stage::Coarse && stages.contains(&Stage::Full) {
            own.retain(|&at| is_quicker_by_cells(&groups[items[at].group].file));
        }
        outcomes = side_by_side(items, &own, *stage, &one, told, progress)?;
    }
    Ok(outcomes.into_iter().flatten().collect())
}

/// What a product is worth by what is known of it; as little as can be where nothing is.
fn promise(group: &Group, known: Option<&Outcome>) -> f64 {
    let worth = || {
        let keys = group.file.rank.as_ref()?;
        let Some(Ok(found)) = known else { return None };
        let of = |figure: &str| Some(found.figures[group.figures.iter().position(|own| own == figure)?]);
        let figures: Vec<Estimate> = keys.objective.iter().map(|one| of(&one.figure)).collect::<Option<_>>()?;
        Some(utility(&objectives(keys).ok()?, &figures).value)
    };
    worth().unwrap_or(f64::NEG_INFINITY)
}

/// Whether data on cells come sooner than what the scene asks for.
fn is_quicker_by_cells(file: &SceneFile) -> bool {
    file.compute.interpolation != Interpolation::Patch
}

/// Threads of their own, each of which shares the computing of its product with all processors: work that waits for a lock
/// must not hold up the pool whose work the lock's owner waits for. `order`: of the items' places, to be taken so.
fn side_by_side(
    items: &[Item],
    order: &[usize],
    stage: Stage,
    one: &(dyn Fn(&Item, Stage) -> Result<super::figures::Found, StudyError> + Sync),
    told: &(dyn Fn(Answer<'_>) + Sync),
    progress: &dyn Progress,
) -> Result<Vec<Option<Outcome>>, StudyError> {
    let (next, done, stopped) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicBool::new(false));
    let results: Mutex<Vec<Option<Outcome>>> = Mutex::new(vec![None; items.len()]);
    let name = if stage == Stage::Coarse { "products, coarse" } else { "products" };
    let work = || {
        loop {
            let Some(&at) = order.get(next.fetch_add(1, Ordering::Relaxed)) else { return };
            let item = &items[at];
            if progress.cancelled() || stopped.load(Ordering::Relaxed) {
                return;
            }
            let outcome = match one(item, stage) {
                Ok(found) => Ok(found),
                Err(StudyError::Cancelled(_)) => {
                    stopped.store(true, Ordering::Relaxed);
                    return;
                }
                Err(error) => Err(error.to_string()),
            };
            told(Answer { item: *item, stage, outcome: &outcome });
            results.lock().unwrap_or_else(PoisonError::into_inner)[at] = Some(outcome);
            progress.advance(name, done.fetch_add(1, Ordering::Relaxed) + 1, order.len());
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..rayon::current_num_threads().min(items.len()) {
            scope.spawn(work);
        }
        work();
    });
    let results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    if order.iter().any(|&at| results[at].is_none()) { Err(Cancelled.into()) } else { Ok(results) }
}

/// Lists of what was computed; `keys` of the items' rows.
pub fn lists_of(groups: &[Group], items: &[Item], outcomes: Vec<Outcome>, keys: &[String]) -> Vec<List> {
    let mut lists: Vec<List> = groups
        .iter()
        .enumerate()
        .map(|(number, group)| List {
            number,
            scene: group.scene.clone(),
            climate: group.climate.clone(),
            azimuth: group.azimuth,
            figures: group.figures.clone(),
            objectives: group.objectives.clone(),
            rows: Vec::new(),
        })
        .collect();
    for ((item, outcome), key) in items.iter().zip(outcomes).zip(keys) {
        let product = groups[item.group].products[item.product].key.clone();
        lists[item.group].rows.push(Row { product, key: key.clone(), outcome });
    }
    lists.retain(|list| !list.rows.is_empty());
    lists
}
