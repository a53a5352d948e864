//! Joining of files that belong together: the transmission and reflection functions of one state.

use super::btdf_text;
use crate::compute::btdf::Dataset;

/// Joins datasets of files with one function each that have the same name and state and different functions
/// (transmission and reflection, from outside and from inside). Other datasets are returned unchanged, in their order.
pub fn merge_sides(datasets: Vec<Dataset>) -> Vec<Dataset> {
    let mut merged: Vec<Dataset> = Vec::new();
    for dataset in datasets {
        let twin = merged.iter_mut().find(|other| belongs(other, &dataset));
        let Some(twin) = twin else {
            merged.push(dataset);
            continue;
        };
        for component in dataset.visible.components() {
            if let Some(btdf) = dataset.visible.get(component) {
                twin.visible.set(component, btdf.clone());
            }
        }
        twin.findings.extend(dataset.findings);
        if twin.described != dataset.described {
            // Of one function at least it is not known that the description gives it.
            twin.described = None;
        }
        if twin.visible.transmission_front.is_some() {
            // What its own files said of each function alone.
            twin.findings.retain(|finding| finding.code != "one-function");
        }
        twin.findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    }
    merged
}

fn belongs(a: &Dataset, b: &Dataset) -> bool {
    is_one_function(a)
        && is_one_function(b)
        && !b.name.is_empty()
        && a.name == b.name
        && a.state == b.state
        && b.visible.components().into_iter().all(|component| a.visible.get(component).is_none())
}

/// Whether the dataset was read from a format whose files contain one function each (`.btdf.txt`).
pub fn is_one_function(dataset: &Dataset) -> bool {
    dataset.format.starts_with(btdf_text::FAMILY)
}
