//! Computation of all products of all lists in parallel, stage by stage: with patch-averaged data first, then with
//! sharp beams.

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
use crate::study::year::{Climate, Metric, Need, climate, metric};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// One product of one list, by indices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Item {
    /// Index of the list.
    pub group: usize,
    /// Index of the product in its list.
    pub product: usize,
}

/// Result of one product in one stage, reported as soon as it is available.
#[derive(Debug, Clone, Copy)]
pub struct Answer<'a> {
    /// Product and list to which the result belongs.
    pub item: Item,
    /// Stage in which it was computed.
    pub stage: Stage,
    /// Annual figures, or the reason why the product is excluded.
    pub outcome: &'a Outcome,
}

/// Data of a list that do not depend on its products: climate and groups of hours.
struct Ready {
    climate: Climate,
    by_cells: Climate,
    grouping: Grouping,
}

/// Computes products of lists, in the first stage those with few states first, in later stages the best of the earlier
/// stage first. Results do not depend on the number of threads. All products complete a stage before any enters the
/// next; `report` receives every result when it is available, from any thread.
///
/// # Errors
/// Returns an error if a climate cannot be read, if no year has a figure, or if cancelled. An error of a single product
/// is its outcome.
pub fn run(
    groups: &[Group],
    items: &[Item],
    library: &dyn SystemLibrary,
    session: &Session,
    stages: &[Stage],
    report: &(dyn Fn(Answer<'_>) + Sync),
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
            // Figures that no objective needs are not computed.
            let known: Vec<&Metric> = group.figures.iter().filter_map(|key| Some(metric(key)?.0)).collect();
            let needed = |need| known.iter().any(|metric| metric.needs.contains(&need));
            climate.settings.keys.solar = needed(Need::Solar);
            climate.settings.keys.lm83 = needed(Need::Lm83);
            climate.settings.keys.dgp &= needed(Need::Dgp);
            climate.settings.direct_sun = needed(Need::DirectSun);
            climate.settings.unoccupied = needed(Need::Unoccupied);
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
    // Errors of a scene are reported once, before its products are computed in vain.
    let mut asked: Vec<&str> = Vec::new();
    for item in items {
        let group = &groups[item.group];
        if !asked.contains(&group.scene.as_str()) {
            asked.push(&group.scene);
            setting(item).check(&group.products[item.product], &Withdrawn(progress))?;
        }
    }
    // Products without moving parts first: they are quick, and the user sees a list early.
    let states = |at: &usize| groups[items[*at].group].products[items[*at].product].states.len();
    let mut order: Vec<usize> = (0..items.len()).collect();
    order.sort_by_key(states);
    let mut outcomes: Vec<Option<Outcome>> = Vec::new();
    for stage in stages {
        let mut own = order.clone();
        // The user sees the results of the best products first.
        own.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|at| promise(&groups[items[at].group], outcomes.get(at).and_then(Option::as_ref)));
            b.total_cmp(&a)
        });
        if *stage == Stage::Coarse && stages.contains(&Stage::Full) {
            own.retain(|&at| is_quicker_by_cells(&groups[items[at].group].file));
        }
        outcomes = side_by_side(items, &own, *stage, &one, report, progress)?;
    }
    Ok(outcomes.into_iter().flatten().collect())
}

/// Returns the score of a product by its figures so far, which determines the order of computation; negative infinity
/// if it has none.
fn promise(group: &Group, known: Option<&Outcome>) -> f64 {
    let score = || {
        let keys = group.file.rank.as_ref()?;
        let Some(Ok(found)) = known else { return None };
        let of = |figure: &str| Some(found.figures[group.figures.iter().position(|own| own == figure)?]);
        let figures: Vec<Estimate> = keys.objective.iter().map(|one| of(&one.figure)).collect::<Option<_>>()?;
        Some(utility(&objectives(keys).ok()?, &figures).value)
    };
    score().unwrap_or(f64::NEG_INFINITY)
}

/// Whether patch-averaged data need less computing time than the interpolation that the scene asks for.
fn is_quicker_by_cells(file: &SceneFile) -> bool {
    file.compute.interpolation != Interpolation::Patch
}

/// Computes products on separate threads, each of which shares the computation of its product with all processors: work
/// that waits for a lock must not block the thread pool for whose work the owner of the lock waits. `order`: indices of
/// the items in the order of computation.
fn side_by_side(
    items: &[Item],
    order: &[usize],
    stage: Stage,
    one: &(dyn Fn(&Item, Stage) -> Result<super::figures::Found, StudyError> + Sync),
    report: &(dyn Fn(Answer<'_>) + Sync),
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
            report(Answer { item: *item, stage, outcome: &outcome });
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

/// Returns the ranked lists of computed products. `keys`: keys of the rows, in the order of `items`.
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
