//! Error against computing time of a ranking: the same products ranked with rising effort, each list compared with the
//! finest.
//!
//! Compared are the products' scores, 0 … 1, and the order of pairs of products. If two products differ in the finest
//! list by more than twice the sum of its stated errors of both, every other list must distinguish them, in the same
//! order. Each list is timed separately with its own session, on all processors; the first one also computes missing
//! data of built-in products.

use super::annual::{Inner, targets};
use super::{Coverage, Errors};
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::rank::{surely_above, utility};
use crate::study::error::StudyError;
use crate::study::rank::{Group, List, Shard, Stage, lists_of, run};
use crate::study::scene_file::Interpolation;
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use std::sync::Arc;
use std::time::Instant;

/// Effort with which a ranking is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Effort {
    /// BSDF data taken as constant on their patches: the first result that the window shows.
    Cells,
    /// Sharp beams, with this relative error target; `None`: all settings as in the scene.
    Target(Option<f64>),
}

/// Agreement of a ranking with the finest one in the order of pairs of products.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Pairs {
    /// Number of pairs of products that were ranked in both lists.
    pub all: usize,
    /// Number of pairs whose scores differ in the finest list by more than twice the stated errors of both.
    pub distinct: usize,
    /// Number of these pairs that the list distinguishes in the same order.
    pub same_order: usize,
    /// Number of these pairs that the list distinguishes in the opposite order; the rest is not distinguished.
    pub reversed: usize,
}

/// One ranking with a certain effort, compared with the finest.
#[derive(Debug, Clone, PartialEq)]
pub struct RankRung {
    /// Effort of the computation.
    pub effort: Effort,
    /// Computing time of the ranking, with nothing stored before. \[s\]
    pub seconds: f64,
    /// Mean of the errors stated for the scores, on their scale 0 … 1.
    pub stated: f64,
    /// Stated and actual error of every product's score, on its scale 0 … 1; empty for the finest ranking itself.
    pub errors: Vec<Errors>,
    /// Agreement with the finest ranking in the order of pairs; for the finest itself, pairs by its own stated errors.
    pub pairs: Pairs,
}

impl RankRung {
    /// Returns the root mean square of the differences of the scores (0 … 1) from the finest ranking.
    pub fn rms(&self) -> f64 {
        (self.errors.iter().map(|e| e.real * e.real).sum::<f64>() / self.errors.len().max(1) as f64).sqrt()
    }

    /// Returns the largest difference of a score (0 … 1) from the finest ranking.
    pub fn max(&self) -> f64 {
        self.errors.iter().map(|e| e.real).fold(0.0, f64::max)
    }

    /// Returns the reliability of the errors stated for the scores; `None` for the finest ranking itself.
    pub fn coverage(&self) -> Option<Coverage> {
        (!self.errors.is_empty()).then(|| Coverage::of(&self.errors))
    }
}

/// Result of computing a ranking with rising effort.
#[derive(Debug, Clone, PartialEq)]
pub struct RankAccuracy {
    /// Rankings by rising effort; the last one is the reference of the others.
    pub rungs: Vec<RankRung>,
    /// Number of ranked lists (one for each climate and azimuth).
    pub lists: usize,
    /// Number of products in all lists, and number of those that are not excluded in the finest ranking.
    pub products: [usize; 2],
    /// Number of threads with which the computing times were measured.
    pub threads: usize,
}

/// Computes a ranking with rising effort, and compares each result with the finest. The last two rankings take several
/// times as long as one with the default effort.
///
/// # Errors
/// Returns the errors of [`run`].
pub fn ranking(
    groups: &[Group],
    library: &dyn SystemLibrary,
    progress: &dyn Progress,
) -> Result<RankAccuracy, StudyError> {
    let efforts = efforts(groups);
    let mut found = Vec::with_capacity(efforts.len());
    for (k, effort) in efforts.iter().enumerate() {
        if progress.cancelled() {
            return Err(Cancelled.into());
        }
        progress.advance("accuracy", k, efforts.len());
        let clock = Instant::now();
        // The reference is computed without approximations of the session.
        let finest = k + 1 == efforts.len();
        let session = if finest { Session::new() } else { Session::new().passing() };
        let lists = lists(groups, *effort, library, &session, &Inner(progress))?;
        found.push((scores(&lists), clock.elapsed().as_secs_f64()));
    }
    let Some((finest, _)) = found.last() else { return Err(Cancelled.into()) };
    let last = found.len() - 1;
    let rungs = found
        .iter()
        .zip(&efforts)
        .enumerate()
        .map(|(k, ((own, seconds), &effort))| {
            let stated: Vec<f64> = own.iter().flatten().flatten().map(|one| one.error).collect();
            RankRung {
                effort,
                seconds: *seconds,
                stated: stated.iter().sum::<f64>() / stated.len().max(1) as f64,
                errors: if k == last { Vec::new() } else { errors(own, finest) },
                pairs: pairs(own, finest),
            }
        })
        .collect();
    let all = finest.iter().map(Vec::len).sum();
    let products = [all, finest.iter().flatten().flatten().count()];
    Ok(RankAccuracy { rungs, lists: finest.len(), products, threads: rayon::current_num_threads() })
}

fn efforts(groups: &[Group]) -> Vec<Effort> {
    let own = groups.first().and_then(|group| group.file.compute.error_target);
    std::iter::once(Effort::Cells).chain(targets(own).into_iter().map(Effort::Target)).collect()
}

/// Computes the ranked lists with one effort, all of them with the same products in the same order.
fn lists(
    groups: &[Group],
    effort: Effort,
    library: &dyn SystemLibrary,
    session: &Session,
    progress: &dyn Progress,
) -> Result<Vec<List>, StudyError> {
    let mut groups = groups.to_vec();
    let stage = match effort {
        Effort::Cells => Stage::Coarse,
        Effort::Target(_) => Stage::Full,
    };
    if effort != Effort::Target(None) {
        for group in &mut groups {
            let compute = &mut Arc::make_mut(&mut group.file).compute;
            // The reference has sharp beams, even if the scene uses patch-averaged data.
            compute.interpolation = Interpolation::Auto;
            if let Effort::Target(target) = effort {
                compute.error_target = target;
            }
        }
    }
    let items = Shard::WHOLE.items(&groups.iter().map(|group| group.products.len()).collect::<Vec<_>>());
    let outcomes = run(&groups, &items, library, session, &[stage], &|_| (), progress)?;
    Ok(lists_of(&groups, &items, outcomes, &vec![String::new(); items.len()]))
}

/// Scores of the products, 0 … 1, by list and product; `None` for excluded ones.
type Scores = Vec<Vec<Option<Estimate>>>;

fn scores(lists: &[List]) -> Scores {
    let of = |list: &List| {
        let own = |found: &crate::study::rank::Found| utility(&list.objectives, &found.figures);
        list.rows.iter().map(|row| row.outcome.as_ref().ok().map(own)).collect()
    };
    lists.iter().map(of).collect()
}

fn errors(own: &Scores, finest: &Scores) -> Vec<Errors> {
    let both = own.iter().flatten().zip(finest.iter().flatten());
    both.filter_map(|(own, last)| {
        let (own, last) = ((*own)?, (*last)?);
        Some(Errors { stated: own.error, real: (own.value - last.value).abs(), open: last.error })
    })
    .collect()
}

/// Counts the pairs of products that a ranking (`own`) orders like the finest one.
fn pairs(own: &Scores, finest: &Scores) -> Pairs {
    let mut pairs = Pairs::default();
    for (own, finest) in own.iter().zip(finest) {
        let known: Vec<(Estimate, Estimate)> =
            own.iter().zip(finest).filter_map(|(own, last)| Some(((*own)?, (*last)?))).collect();
        for (k, a) in known.iter().enumerate() {
            for b in &known[k + 1..] {
                pairs.all += 1;
                let (above, below) = if a.1.value > b.1.value { (a, b) } else { (b, a) };
                if above.1.value - below.1.value > 2.0 * (above.1.error + below.1.error) {
                    pairs.distinct += 1;
                    pairs.same_order += usize::from(surely_above(above.0, below.0));
                    pairs.reversed += usize::from(surely_above(below.0, above.0));
                }
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_judged_by_the_finest() {
        let of = |list: &[(f64, f64)]| -> Scores {
            vec![list.iter().map(|&(value, error)| Some(Estimate::new(value, error))).collect()]
        };
        let mut finest = of(&[(0.2, 0.01), (0.22, 0.01), (0.5, 0.01), (0.9, 0.01)]);
        let all = |apart, told, reversed| Pairs { all: 6, distinct: apart, same_order: told, reversed };
        assert_eq!(pairs(&finest, &finest), all(5, 5, 0));
        // The third may be the last; the first is said to be above the second, of which the finest knows nothing.
        assert_eq!(pairs(&of(&[(0.2, 0.0), (0.1, 0.0), (0.8, 0.2), (0.9, 0.01)]), &finest), all(5, 4, 0));
        assert_eq!(pairs(&of(&[(0.2, 0.01), (0.22, 0.01), (0.9, 0.01), (0.5, 0.01)]), &finest), all(5, 4, 1));
        // What either leaves out is nobody's pair.
        finest[0][3] = None;
        assert_eq!(pairs(&of(&[(0.2, 0.0); 4]), &finest), Pairs { all: 3, distinct: 2, same_order: 0, reversed: 0 });
        assert_eq!(errors(&of(&[(0.3, 0.05); 4]), &finest).len(), 3);
    }
}
