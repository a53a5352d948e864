//! Assessment of a file's data blocks by its reader: implausible ones are dropped or refused, a missing front
//! transmission is derived.

use crate::compute::btdf::{Band, Btdf, Component, Dataset, Finding, Scattered, TreeNode, reciprocity_error, tau_max};
use crate::compute::doctor::{by_reciprocity, same_values};
use crate::formats::location::{FormatError, Location};

/// Direct-hemispherical value of a transmission above which the file is refused, even if it is in percent.
const IMPOSSIBLE: f64 = 150.0;
/// Direct-hemispherical value of any other function above which the file is refused.
const OVERFLOW: f64 = 1e6;
/// Mean reciprocity error above which a back transmission with the same number in all cells does not belong to the same
/// system as the front transmission. Chosen: where the data check calls the agreement of both sides no longer good.
const MAX_DIFFERENCE: f64 = 0.1;

/// Drops data blocks that cannot be meant, refuses values that are too large in any unit, and derives a missing front
/// transmission. All other checks are those of the data check (`compute::doctor`).
pub(super) fn assess(dataset: &mut Dataset) -> Result<(), FormatError> {
    let mut findings = std::mem::take(&mut dataset.findings);
    mislabelled(&mut dataset.visible, "Visible", &mut findings);
    if let Some(solar) = &mut dataset.solar {
        mislabelled(solar, "Solar", &mut findings);
    }
    plausible(&dataset.visible, "Visible")?;
    if let Some(solar) = &dataset.solar {
        plausible(solar, "Solar")?;
    }
    placeholder(&mut dataset.visible, "Visible", &mut findings);
    if let Some(solar) = &mut dataset.solar {
        placeholder(solar, "Solar", &mut findings);
    }
    derive_front(dataset, &mut findings);
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    dataset.findings = findings;
    Ok(())
}

/// Removes a reflection that repeats the values of a transmission: it is that transmission, mislabelled.
fn mislabelled(band: &mut Band, name: &str, findings: &mut Vec<Finding>) {
    for (reflection, place) in [
        (Component::ReflectionFront, &mut band.reflection_front),
        (Component::ReflectionBack, &mut band.reflection_back),
    ] {
        for (transmission, other) in [
            (Component::TransmissionFront, &band.transmission_front),
            (Component::TransmissionBack, &band.transmission_back),
        ] {
            let (Some(r), Some(t)) = (place.as_ref(), other.as_ref()) else { continue };
            if tau_max(t) > 0.0 && same_values(r, t) {
                findings.push(Finding::warning(
                    "block-mislabelled",
                    format!(
                        "{} ({name}) repeats {} number by number: a mislabelled block, left out.",
                        reflection.words(),
                        transmission.words()
                    ),
                ));
                *place = None;
            }
        }
    }
}

fn plausible(band: &Band, name: &str) -> Result<(), FormatError> {
    for component in band.components() {
        let Some(btdf) = band.get(component) else { continue };
        let largest = tau_max(btdf);
        let transmission = component.is_transmission();
        let limit = if transmission && name == "Visible" { IMPOSSIBLE } else { OVERFLOW };
        if !largest.is_finite() || largest > limit {
            return Err(FormatError::new(
                Location::file().in_element(format!("{} ({name})", component.words())),
                if largest < 1e4 {
                    format!("a directional-hemispherical sum of {largest:.4}, which is not plausible")
                } else {
                    format!("a directional-hemispherical sum of {largest:.3e}, which is not plausible")
                },
                "sums of at most 1 (or 100 in percent), values in 1/sr",
            ));
        }
    }
    Ok(())
}

/// Removes a back transmission that WINDOW filled with zeros or another constant (Radiance,
/// doc/notes/BSDFdirections.txt).
fn placeholder(band: &mut Band, name: &str, findings: &mut Vec<Finding>) {
    let (Some(front), Some(back)) = (&band.transmission_front, &band.transmission_back) else { return };
    let Some(number) = one_number(back).filter(|_| tau_max(front) > 1e-6) else { return };
    if number == 0.0 || reciprocity_error(front, back).is_some_and(|difference| difference > MAX_DIFFERENCE) {
        let what = if number == 0.0 { "zero".to_owned() } else { format!("{number} 1/sr in all cells") };
        findings.push(Finding::warning(
            "back-placeholder",
            format!(
                "Transmission Back ({name}) is {what}, which contradicts the transmission of the front: a placeholder, \
                 left out."
            ),
        ));
        band.transmission_back = None;
    }
}

/// Returns the value q of all pairs of cells, if they all have the same. \[1/sr\]
fn one_number(btdf: &Btdf) -> Option<f64> {
    match &btdf.scattered {
        Some(Scattered::Cells(matrix)) => {
            let values = matrix.values();
            let first = *values.first()?;
            values.iter().all(|value| *value == first).then_some(first)
        }
        Some(Scattered::Tree(tree)) => {
            let leaf = |node: &TreeNode| if let TreeNode::Leaf(value) = node { Some(*value) } else { None };
            let mut leaves = tree.nodes().iter().filter_map(leaf);
            let first = leaves.next()?;
            leaves.all(|value| value == first).then_some(first)
        }
        _ => None,
    }
}

fn derive_front(dataset: &mut Dataset, findings: &mut Vec<Finding>) {
    let derived = |band: &Band| match (&band.transmission_front, &band.transmission_back) {
        (None, Some(back)) => by_reciprocity(back, true),
        _ => None,
    };
    if let Some((front, how)) = derived(&dataset.visible) {
        findings.push(Finding::info(
            "front-by-reciprocity",
            format!("The file has no front transmission; it is derived from the back by reciprocity, {how}."),
        ));
        dataset.visible.transmission_front = Some(front);
        dataset.derived.push(Component::TransmissionFront);
    }
    if let Some(solar) = &mut dataset.solar
        && let Some((front, how)) = derived(solar)
    {
        findings.push(Finding::info(
            "front-by-reciprocity",
            format!("The file has no solar front transmission; it is derived from the back by reciprocity, {how}."),
        ));
        solar.transmission_front = Some(front);
    }
}
