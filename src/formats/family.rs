//! Files that belong together: the functions of one state, the states of one product.

use super::btdf_text;
use crate::compute::btdf::Dataset;

/// Joins datasets of one-function files that have the same name and state and hold different functions: transmission
/// and reflection, from outside and from inside. Others stay as they are, in order.
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

/// Whether the dataset comes from a format whose files hold one function each.
pub fn is_one_function(dataset: &Dataset) -> bool {
    dataset.format.starts_with(btdf_text::FAMILY)
}
