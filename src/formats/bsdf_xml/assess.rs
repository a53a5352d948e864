//! What is told about a file that could be read: missing, mislabelled, unphysical, derived.

use crate::compute::basis::{AzimuthMap, resample_matrix};
use crate::compute::btdf::{Band, Btdf, Component, Dataset, Finding, Scattered, TreeRank, reciprocity_error, tau_max};
use crate::formats::location::{FormatError, Location};

/// Column sums up to here are rounding.
const ROUNDING: f64 = 1.001;
/// Measured and simulated data may exceed 1 by this without being useless.
const PLAUSIBLE: f64 = 1.05;
/// No transmission is believed above this.
const IMPOSSIBLE: f64 = 1.5;
/// Nor any reflection above this; between the two limits it is an error-severity finding.
const OVERFLOW: f64 = 1e6;

/// Adds findings to a dataset, drops blocks that cannot be meant, derives a missing front transmission.
pub(super) fn assess(dataset: &mut Dataset) -> Result<(), FormatError> {
    let mut findings = std::mem::take(&mut dataset.findings);
    mislabelled(&mut dataset.visible, "Visible", &mut findings);
    if let Some(solar) = &mut dataset.solar {
        mislabelled(solar, "Solar", &mut findings);
    }
    energy(&dataset.visible, "Visible", &mut findings)?;
    if let Some(solar) = &dataset.solar {
        energy(solar, "Solar", &mut findings)?;
    }
    placeholder(&mut dataset.visible, &mut findings);
    reciprocity(&dataset.visible, &mut findings);
    derive_front(dataset, &mut findings);
    match dataset.transmission().map(tau_max) {
        None => findings.push(Finding::warning(
            "no-transmission",
            "The file holds no visible transmission; it cannot light a room.",
        )),
        Some(0.0) => {
            findings
                .push(Finding::warning("opaque", "The visible transmission from outside is zero everywhere (opaque)."));
        }
        Some(_) => {}
    }
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    dataset.findings = findings;
    Ok(())
}

const fn words(component: Component) -> &'static str {
    match component {
        Component::TransmissionFront => "Transmission Front",
        Component::TransmissionBack => "Transmission Back",
        Component::ReflectionFront => "Reflection Front",
        Component::ReflectionBack => "Reflection Back",
    }
}

fn same_values(a: &Btdf, b: &Btdf) -> bool {
    match (&a.scattered, &b.scattered) {
        (Some(Scattered::Cells(a)), Some(Scattered::Cells(b))) => a.values() == b.values(),
        (Some(Scattered::Tree(a)), Some(Scattered::Tree(b))) => a.nodes() == b.nodes(),
        _ => false,
    }
}

/// A reflection block that repeats a transmission block number by number is that transmission, mislabelled.
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
                        words(reflection),
                        words(transmission)
                    ),
                ));
                *place = None;
            }
        }
    }
}

fn energy(band: &Band, name: &str, findings: &mut Vec<Finding>) -> Result<(), FormatError> {
    for component in band.components() {
        let Some(btdf) = band.get(component) else { continue };
        let largest = tau_max(btdf);
        let transmission = matches!(component, Component::TransmissionFront | Component::TransmissionBack);
        let limit = if transmission && name == "Visible" { IMPOSSIBLE } else { OVERFLOW };
        let block = format!("{} ({name})", words(component));
        if !largest.is_finite() || largest > limit {
            return Err(FormatError::new(
                Location::file().in_element(block),
                if largest < 1e4 {
                    format!("a directional-hemispherical sum of {largest:.4}, which is not plausible")
                } else {
                    format!("a directional-hemispherical sum of {largest:.3e}, which is not plausible")
                },
                "sums of at most 1, values in 1/sr",
            ));
        }
        let message = format!("The largest directional-hemispherical sum of {block} is {largest:.6}, above 1");
        if largest > PLAUSIBLE {
            findings.push(Finding::error("energy-above-one", format!("{message}: unphysical.")));
        } else if largest > ROUNDING {
            findings.push(Finding::warning("energy-above-one", format!("{message} (measuring or sampling error).")));
        } else if largest > 1.0 {
            findings.push(Finding::info("energy-above-one", format!("{message} by rounding.")));
        }
    }
    for (t, r, side) in [
        (&band.transmission_front, &band.reflection_front, "front"),
        (&band.transmission_back, &band.reflection_back, "back"),
    ] {
        let (Some(Scattered::Cells(t)), Some(Scattered::Cells(r))) =
            (t.as_ref().and_then(|b| b.scattered.as_ref()), r.as_ref().and_then(|b| b.scattered.as_ref()))
        else {
            continue;
        };
        if t.tau_by_cell().len() != r.tau_by_cell().len() {
            continue;
        }
        let sum = t.tau_by_cell().iter().zip(r.tau_by_cell()).map(|(t, r)| t + r).fold(0.0, f64::max);
        if sum > 1.01 {
            findings.push(Finding::warning(
                "energy-sum-above-one",
                format!("Transmission and reflection of light from the {side} ({name}) add up to {sum:.4} at most."),
            ));
        }
    }
    Ok(())
}

/// Some writers fill the back transmission with zeros, or with a copy of the front.
fn placeholder(band: &mut Band, findings: &mut Vec<Finding>) {
    let (Some(front), Some(back)) = (&band.transmission_front, &band.transmission_back) else { return };
    let (front_max, back_max) = (tau_max(front), tau_max(back));
    if front_max > 1e-6 && back_max == 0.0 {
        findings.push(Finding::warning(
            "back-placeholder",
            "Transmission Back (Visible) is zero although the front transmits: a placeholder, left out.",
        ));
        band.transmission_back = None;
    } else if back_max > 1e-6 && front_max == 0.0 {
        findings.push(Finding::warning(
            "front-zero",
            "Transmission Front (Visible) is zero although the back transmits, against reciprocity; kept as it is.",
        ));
    } else if front_max > 0.0 && same_values(front, back) && reciprocity_error(front, back).is_some_and(|e| e > 0.05) {
        findings.push(Finding::info(
            "back-copies-front",
            "Transmission Back (Visible) repeats the front number by number, against reciprocity: probably a copy.",
        ));
    }
}

fn reciprocity(band: &Band, findings: &mut Vec<Finding>) {
    let (Some(front), Some(back)) = (&band.transmission_front, &band.transmission_back) else { return };
    if let Some(error) = reciprocity_error(front, back).filter(|error| *error > 0.05) {
        findings.push(Finding::warning(
            "reciprocity",
            format!("Front and back transmission break reciprocity by {:.0} % on average.", 100.0 * error),
        ));
    }
}

fn derive_front(dataset: &mut Dataset, findings: &mut Vec<Finding>) {
    if dataset.visible.transmission_front.is_some() {
        return;
    }
    let Some(scattered) = dataset.visible.transmission_back.as_ref().and_then(|back| back.scattered.as_ref()) else {
        return;
    };
    let (reversed, how) = match scattered {
        Scattered::Cells(matrix) => {
            // Counted as a front block counts, so that lists do not depend on which block a file holds.
            let reversed = matrix.reversed();
            let incident = reversed.incident().clone().with_azimuth(AzimuthMap::KLEMS_FRONT);
            let emergent = reversed.emergent().clone().with_azimuth(AzimuthMap::KLEMS_FRONT);
            (Scattered::Cells(Box::new(resample_matrix(&reversed, &incident, &emergent))), "exactly")
        }
        Scattered::Tree(tree) if tree.rank() == TreeRank::Four => {
            (Scattered::Tree(Box::new(tree.reversed())), "exactly")
        }
        Scattered::Tree(tree) => {
            (Scattered::Tree(Box::new(tree.reversed())), "with its leaves averaged anew, as rank 3 demands")
        }
        Scattered::Lambert(_) | Scattered::Directions(_) => return,
    };
    findings.push(Finding::info(
        "front-by-reciprocity",
        format!("The file has no front transmission; it is derived from the back by reciprocity, {how}."),
    ));
    dataset.visible.transmission_front = Some(Btdf { regular: None, scattered: Some(reversed) });
    dataset.derived.push(Component::TransmissionFront);
}
