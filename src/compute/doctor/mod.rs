//! Data check: findings about a dataset, their effect on results, and the repairs that are offered.
//!
//! [`examine`] checks the numbers themselves; findings that only a reader can make (syntax, labels, counts) are already
//! in [`Dataset::findings`] and are included. [`repaired()`] makes the repair that a finding offers; nothing is ever
//! repaired without a request.
//!
//! Functions are compared on common cells of directions of undeviated light ([`blocks`]), where a clear pane is a
//! diagonal matrix and reciprocity a plain transpose. A fault is a hypothesis about all functions of a file together
//! (`hypotheses`): the numbers are interpreted as if the fault were undone (a `reading`), every reading is rated by the
//! same few questions (`evidence`), and the best explanation is reported, as certain where its lead over all others is
//! large (`judgement`). Faults that contradict no question, e.g. all functions upside down together, cannot be seen in
//! the data; a sentence about the light of the sun then asks the user (`orientation`).

mod at;
pub mod blocks;
mod copies;
mod derive;
mod diagnosis;
mod energy;
mod evidence;
mod hypotheses;
mod identity;
mod judgement;
mod message;
mod orientation;
mod patches;
mod reading;
mod reciprocity;
mod repair;
mod repaired;
mod resolution;
mod symmetry;

pub use copies::same_values;
pub use derive::by_reciprocity;
pub use diagnosis::{Confidence, Diagnosis};
pub use orientation::{Ways, sun_from_above};
pub use repair::{BandScope, BlockScope, Repair, RepairKind, record, recorded};
pub use repaired::{RepairError, repaired, repaired_all};

use crate::compute::btdf::{Band, Dataset, Finding};
use at::At;
use blocks::Blocks;
use judgement::{Side, Verdict};
use rayon::prelude::*;
use std::borrow::Borrow;

/// Returns all findings about a dataset, worst severity first: those of the reader and those of the data check. A
/// finding with several repairs is listed once with each of them.
pub fn examine(dataset: &Dataset) -> Vec<Diagnosis> {
    let mut list: Vec<Diagnosis> = dataset.findings.iter().cloned().map(Diagnosis::from).collect();
    list.extend(examined(dataset));
    // A reader's finding that the doctor makes too is said once, with its repair. One finding about several functions
    // comes once for every repair that it asks for; each of them is kept.
    let mut kept: Vec<Diagnosis> = Vec::new();
    for one in list {
        let same = |other: &&mut Diagnosis| {
            other.finding == one.finding
                && (one.repair.is_none() || other.repair.is_none() || other.repair == one.repair)
        };
        match kept.iter_mut().find(same) {
            Some(other) if other.repair.is_none() => (other.repair, other.sure) = (one.repair, one.sure),
            Some(_) => {}
            None => kept.push(one),
        }
    }
    kept.sort_by_key(|one| std::cmp::Reverse(one.finding.severity));
    kept
}

/// Returns the findings about each of several datasets, computed in parallel; datasets with equal data are examined
/// once.
pub fn examine_all(datasets: &[impl Borrow<Dataset> + Sync]) -> Vec<Vec<Diagnosis>> {
    let same = |a: &Dataset, b: &Dataset| {
        (&a.name, &a.manufacturer, &a.format, a.thickness, &a.derived, &a.findings)
            == (&b.name, &b.manufacturer, &b.format, b.thickness, &b.derived, &b.findings)
            && a.visible == b.visible
            && a.solar == b.solar
    };
    let mut different: Vec<&Dataset> = Vec::new();
    let place = |dataset: &Dataset, different: &[&Dataset]| different.iter().position(|other| same(other, dataset));
    let mut places = Vec::with_capacity(datasets.len());
    for dataset in datasets.iter().map(Borrow::borrow) {
        places.push(place(dataset, &different).unwrap_or_else(|| {
            different.push(dataset);
            different.len() - 1
        }));
    }
    let found: Vec<Vec<Diagnosis>> = different.into_par_iter().map(examine).collect();
    places.into_iter().map(|place| found[place].clone()).collect()
}

/// Returns the findings of the data check, without those of the reader.
pub fn findings(dataset: &Dataset) -> Vec<Finding> {
    examined(dataset).into_iter().map(|one| one.finding).collect()
}

/// Returns all findings about a dataset, unsorted: those of the reader and those of all checks.
fn examined(dataset: &Dataset) -> Vec<Diagnosis> {
    let mut list = identity::check(dataset);
    list.extend(copies::between_bands(dataset));
    list.extend(energy::between_bands(dataset));
    let blocks = Blocks::new(dataset, &dataset.visible);
    let solar = dataset.solar.as_ref().map(|solar| (solar, Blocks::new(dataset, solar)));
    let visible = band(dataset, &dataset.visible, "visible", BandScope::Visible, blocks.as_ref());
    let others = solar.as_ref().map(|(solar, blocks)| band(dataset, solar, "solar", BandScope::Solar, blocks.as_ref()));
    list.extend(diagnosis::merged(visible, others.unwrap_or_default()));
    // One explanation is enough: numbers in another unit, or of another function, upset every comparison.
    if !list.iter().any(|one| ["percent", "block-mislabelled"].contains(&one.finding.code)) {
        let verdict = judged(dataset, blocks.as_ref(), solar.as_ref().and_then(|(_, blocks)| blocks.as_ref()));
        for one in verdict.iter().flat_map(message::diagnoses) {
            // That there is a copy is known already; now also which it is.
            let known = list.iter_mut().find(|fact| fact.finding.code == one.finding.code && fact.repair.is_none());
            match known.filter(|_| one.finding.code == "copied-block") {
                Some(fact) => {
                    fact.finding.message.push_str(&format!(" {}", one.finding.message));
                    fact.repair = one.repair;
                }
                None => list.push(one),
            }
        }
    }
    list.extend(orientation::check(dataset, blocks.as_ref()));
    list.extend(resolution::check(dataset));
    list
}

fn judged(dataset: &Dataset, visible: Option<&Blocks>, solar: Option<&Blocks>) -> Option<Verdict> {
    let mut sides: Vec<Side> = Vec::new();
    sides.extend(visible.map(|blocks| Side::new(BandScope::Visible, &dataset.visible, blocks)));
    if let (Some(band), Some(blocks)) = (&dataset.solar, solar) {
        sides.push(Side::new(BandScope::Solar, band, blocks));
    }
    judgement::judge(&sides)
}

/// Best explanation of the misfits of a dataset, whether or not it is reported: repairs, gain and lead.
#[derive(Debug, Clone, PartialEq)]
pub struct Standing {
    /// Repairs that undo the fault that the explanation assumes.
    pub repairs: Vec<Repair>,
    /// Reduction of the sum of misfits (weighted logarithms, dimensionless) by the repairs; the fault is reported from
    /// 0.9 on.
    pub gain: f64,
    /// Difference in gain from every other explanation, including that nothing is wrong; at most 1.6, from which the
    /// finding is certain.
    pub lead: f64,
}

/// Returns repairs, gain and lead of the best explanation of a dataset's misfits; `None` if the numbers leave nothing
/// to explain. Used to test the choice of explanations.
pub fn standing(dataset: &Dataset) -> Option<Standing> {
    let blocks = Blocks::new(dataset, &dataset.visible);
    let solar = dataset.solar.as_ref().and_then(|solar| Blocks::new(dataset, solar));
    let Verdict { best, lead, .. } = judged(dataset, blocks.as_ref(), solar.as_ref())?;
    Some(Standing { repairs: message::repairs(&best), gain: best.gain, lead })
}

fn band(dataset: &Dataset, band: &Band, name: &str, scope: BandScope, blocks: Option<&Blocks>) -> Vec<Diagnosis> {
    let at = At { dataset, band, name, scope };
    let mut list = energy::check(&at);
    list.extend(copies::check(&at));
    if let Some(blocks) = blocks {
        list.extend(patches::check(&at, blocks));
        list.extend(symmetry::check(&at, blocks));
        list.extend(reciprocity::check(&at));
    }
    list
}
