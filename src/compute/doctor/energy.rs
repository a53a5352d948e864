//! Checks of energy balance and units: transmittance plus reflectance above 1, values in percent, negative or not
//! finite.

use super::at::At;
use super::diagnosis::{Confidence, Diagnosis};
use super::repair::{BandScope, BlockScope, RepairKind};
use crate::compute::basis::RingBasis;
use crate::compute::basis::cell_mean;
use crate::compute::btdf::{Btdf, Component, Dataset, Finding, Scattered, tau_max};
use crate::compute::direction::{Dir, Facade, Incident};
use glam::DVec3;

/// Direct-hemispherical value (τ, ρ or τ + ρ) up to which an excess over 1 is a rounding error. Chosen: rounding to
/// three digits is at most half of it; affects the severity of findings only.
const ROUNDING: f64 = 1.001;
/// Direct-hemispherical value τ or ρ up to which a function is usable: measured and simulated functions may exceed 1 by
/// this much. The sum of two independent measurements may exceed 1 by twice as much. Chosen; held from below by
/// `tests/formats/doctor.rs::no_genuine_product_is_called_broken`, on makers' files.
const PLAUSIBLE: f64 = 1.05;
/// Direct-hemispherical value τ or ρ above which the values are assumed to be in another unit. Chosen: ten times the
/// excess of [`PLAUSIBLE`], and exceeded by a transmittance of 0.015 in percent or of 0.5 times π.
const OTHER_UNIT: f64 = 1.5;
/// Direct-hemispherical value τ or ρ up to which a missing π or cosine explains the values as well as percent do: above
/// π · [`PLAUSIBLE`] = 3.3.
const OTHER_FACTOR: f64 = 4.0;
/// Direct-hemispherical value τ or ρ above which only percent explain the values. Chosen: ten times the physical
/// maximum.
const SURELY_PERCENT: f64 = 10.0;
/// Maximum direct-hemispherical value τ or ρ of data in percent: [`OTHER_UNIT`] in percent.
const MOST_PERCENT: f64 = 150.0;

/// Returns all findings about the energy balance and the unit of a band.
pub(super) fn check(at: &At) -> Vec<Diagnosis> {
    let mut list = not_numbers(at);
    let percent = percent(at);
    if !percent.iter().any(|one| one.sure) {
        list.extend(sums(at));
    }
    list.extend(percent);
    list
}

fn values(btdf: &Btdf, mut each: impl FnMut(f64)) {
    match &btdf.scattered {
        Some(Scattered::Cells(matrix)) => {
            (0..matrix.incident().len()).for_each(|k| matrix.row(k).iter().for_each(|q| each(*q)));
        }
        Some(Scattered::Directions(data)) => {
            (0..data.incident().len()).for_each(|k| data.row(k).iter().for_each(|q| each(*q)));
        }
        Some(Scattered::Lambert(_) | Scattered::Tree(_)) | None => {}
    }
}

/// Returns findings about negative values, and about values that are infinite or not numbers.
fn not_numbers(at: &At) -> Vec<Diagnosis> {
    let mut list = Vec::new();
    for component in at.band.components() {
        let (mut negative, mut broken) = (0, 0);
        let Some(btdf) = at.band.get(component) else { continue };
        values(btdf, |q| {
            negative += usize::from(q < 0.0);
            broken += usize::from(!q.is_finite());
        });
        let place = format!("{} ({})", component.words(), at.name);
        if negative > 0 {
            let message = format!("{negative} values of {place} are below zero; light cannot be.");
            let clamp = at.repair(RepairKind::ClampNegative, BlockScope::One(component));
            list.push(Diagnosis::from(Finding::warning("negative-values", message)).with(clamp));
        }
        if broken > 0 {
            let message = format!("{broken} values of {place} are infinite or no numbers.");
            list.push(Finding::error("not-a-number", message).into());
        }
    }
    list
}

/// Whether a function with the largest direct-hemispherical value `sum` and the hemispherical mean `mean` exceeds 1 at
/// most angles, like data in percent; values divided by a cosine do so at grazing angles only.
fn everywhere(sum: f64, mean: f64) -> bool {
    mean > 2.2 || sum < 2.5 * mean
}

/// Whether the dataset has a function that can only be in percent; then all of it is, since a file has one unit.
fn surely_percent(dataset: &Dataset) -> bool {
    let bands = std::iter::once(&dataset.visible).chain(&dataset.solar);
    let mut functions = bands.flat_map(|band| band.components().into_iter().filter_map(|c| band.get(c)));
    functions.any(|btdf| {
        let sum = tau_max(btdf);
        sum > SURELY_PERCENT && sum <= MOST_PERCENT && everywhere(sum, btdf.tau_hemispherical())
    })
}

/// Returns findings about functions whose values seem to be in percent: direct-hemispherical values about 100 times the
/// physical maximum or that of the other side.
fn percent(at: &At) -> Vec<Diagnosis> {
    let components = at.band.components();
    let largest = |component: Component| at.band.get(component).map_or(0.0, tau_max);
    let partner = |component: Component| component.is_transmission().then(|| component.other_side());
    let own = |component: &Component| !at.dataset.derived.contains(component);
    let hemispherical = |component| at.band.get(component).map_or(0.0, Btdf::tau_hemispherical);
    let ratio = |component: Component| {
        let other = partner(component).filter(own).map_or(0.0, hemispherical);
        (other > 0.0).then(|| hemispherical(component) / other)
    };
    let strong = surely_percent(at.dataset);
    let suspicion = |component: Component| {
        let (sum, ratio) = (largest(component), ratio(component));
        // Light goes both ways alike, so that the two transmissions under uniform light are equal.
        if let Some(ratio) = ratio.filter(|ratio| (50.0..200.0).contains(ratio)) {
            // Which of both is right only shows where one of them cannot be.
            let sure = sum > OTHER_UNIT && (80.0..125.0).contains(&ratio);
            return Some(if sure { Confidence::Certain } else { Confidence::Likely });
        }
        let by_itself = sum > OTHER_UNIT
            && sum <= MOST_PERCENT
            && everywhere(sum, hemispherical(component))
            && ratio.is_none_or(|r| !(2.0..50.0).contains(&r));
        match by_itself {
            true if strong => Some(Confidence::Certain),
            true if sum > OTHER_FACTOR => Some(Confidence::Likely),
            _ => None,
        }
    };
    let rated: Vec<(Component, Option<Confidence>)> =
        components.into_iter().filter(own).map(|component| (component, suspicion(component))).collect();
    let names = |list: &[Component]| list.iter().map(|c| c.words()).collect::<Vec<_>>().join(", ");
    let mut list = Vec::new();
    for confidence in [Confidence::Certain, Confidence::Likely] {
        let percent: Vec<Component> =
            rated.iter().filter(|(_, one)| *one == Some(confidence)).map(|(component, _)| *component).collect();
        if percent.is_empty() {
            continue;
        }
        // What is zero is so in any unit.
        let rest: Vec<Component> = rated.iter().map(|(component, _)| *component).collect();
        let rest: Vec<Component> = rest.into_iter().filter(|c| !percent.contains(c) && largest(*c) > 0.0).collect();
        // A file has one unit, and what looks like fractions may be percent of something dark, unless the same function
        // of the other side is there in fractions.
        let mixed = percent.iter().all(|component| rest.contains(&component.other_side()));
        let mixed = mixed || rest.is_empty();
        let confidence = if mixed { confidence } else { Confidence::Likely };
        let most = percent.iter().map(|c| largest(*c)).fold(0.0, f64::max);
        let mut message = format!(
            "{} ({}): directional-hemispherical sums up to {most:.2} where at most 1 is possible: {} percent instead of \
             fractions.",
            names(&percent),
            at.name,
            confidence.word()
        );
        if most <= 1.0 {
            message = format!(
                "{} ({}): hundred times as much as the other transmission: {} percent instead of fractions.",
                names(&percent),
                at.name,
                confidence.word()
            );
        }
        if !rest.is_empty() {
            message.push_str(&format!(" {} may be in fractions already and would stay.", names(&rest)));
            if !mixed {
                let all = at.repair(RepairKind::DivideBy100, BlockScope::All);
                message.push_str(&format!(" As well possible: all are percent ({all})."));
            }
        }
        let scopes: Vec<BlockScope> =
            if rest.is_empty() { vec![BlockScope::All] } else { percent.iter().map(|c| BlockScope::One(*c)).collect() };
        list.extend(scopes.into_iter().map(|blocks| {
            Diagnosis::suspicion(confidence, "percent", message.clone())
                .with(at.repair(RepairKind::DivideBy100, blocks))
        }));
    }
    list
}

/// Returns a finding if the transmission of one band is about 100 times that of the other.
pub(super) fn between_bands(dataset: &Dataset) -> Option<Diagnosis> {
    // A description may well stop nearly all of one band.
    let solar = dataset.solar.as_ref().filter(|_| dataset.described.is_none())?;
    let hemispherical = |btdf: Option<&Btdf>| btdf.map_or(0.0, Btdf::tau_hemispherical);
    let (visible, solar) = (hemispherical(dataset.transmission()), hemispherical(solar.transmission_front.as_ref()));
    let ratio = if visible > 0.0 && solar > 0.0 { visible / solar } else { return None };
    let (name, larger, bands) =
        if ratio > 1.0 { ("visible", visible, BandScope::Visible) } else { ("solar", solar, BandScope::Solar) };
    // What is beyond 1 is found without the other band.
    ((50.0..200.0).contains(&ratio.max(1.0 / ratio)) && larger < 1.0).then(|| {
        Diagnosis::from(Finding::warning(
            "percent",
            format!(
                "The {name} transmission is {:.0} times that of the other band: possibly percent.",
                ratio.max(1.0 / ratio)
            ),
        ))
        .with(super::Repair { kind: RepairKind::DivideBy100, bands, blocks: BlockScope::Transmission })
    })
}

/// Returns findings about direct-hemispherical values above 1, of single functions and of transmission plus reflection.
fn sums(at: &At) -> Vec<Diagnosis> {
    let mut list = Vec::new();
    for (side, through, back) in [
        ("outside", Component::TransmissionFront, Component::ReflectionFront),
        ("inside", Component::TransmissionBack, Component::ReflectionBack),
    ] {
        let mut single = false;
        for component in [through, back] {
            let Some(btdf) = at.band.get(component) else { continue };
            let largest = tau_max(btdf);
            if largest > 1.0 {
                let message = format!(
                    "The largest directional-hemispherical sum of {} ({}) is {largest:.4}, above 1",
                    component.words(),
                    at.name
                );
                single |= largest > ROUNDING;
                list.push(Diagnosis::from(graded(message, largest, PLAUSIBLE)));
            }
        }
        let (Some(transmitted), Some(reflected)) = (at.band.get(through), at.band.get(back)) else { continue };
        let (total, direction) = largest_sum(transmitted, reflected);
        if !single && total > ROUNDING {
            let message = format!(
                "{:.1} % of the {} light from {side} at θ {:.0}°, φ {:.0}° leaves again, transmitted and reflected",
                100.0 * total,
                at.name,
                direction.theta().to_degrees(),
                direction.phi().to_degrees()
            );
            list.push(Diagnosis::from(graded(message, total, 2.0 * PLAUSIBLE - 1.0)));
        }
    }
    list
}

fn graded(message: String, sum: f64, limit: f64) -> Finding {
    let code = "energy-above-one";
    if sum > limit {
        Finding::error(code, format!("{message}: unphysical."))
    } else if sum > ROUNDING {
        Finding::warning(code, format!("{message} (measuring or sampling error)."))
    } else {
        Finding::info(code, format!("{message} by rounding."))
    }
}

/// Returns the largest τ + ρ over the incident directions or cells of the data, and the direction at which it occurs.
fn largest_sum(transmitted: &Btdf, reflected: &Btdf) -> (f64, Dir<Facade>) {
    let mut worst = (0.0, Dir::from_unit(DVec3::Z));
    let mut ask = |total: f64, direction: Dir<Facade>| {
        if total > worst.0 {
            worst = (total, direction);
        }
    };
    match &transmitted.scattered {
        // Where the data lie, in cells of whatever list.
        Some(Scattered::Directions(data)) => {
            for direction in data.incident() {
                ask(transmitted.tau(*direction) + reflected.tau(*direction), direction.0);
            }
        }
        _ => {
            let basis = transmitted.incident_basis();
            for index in 0..basis.len() {
                let total = tau_of_cell(transmitted, &basis, index) + tau_of_cell(reflected, &basis, index);
                ask(total, basis.cell(index).centre());
            }
        }
    }
    worst
}

/// Returns the direct-hemispherical value τ (or ρ) of a function for the incident cell `index` of `basis`: the mean
/// over the cell for functions of θ, the stored mean for matrices on the same cells, the centre's value for all else.
fn tau_of_cell(btdf: &Btdf, basis: &RingBasis, index: usize) -> f64 {
    let cell = basis.cell(index);
    let regular = btdf.regular.as_ref().map_or(0.0, |tau| cell_mean(&cell, 6, |d| tau.at(d.theta())));
    let scattered = match &btdf.scattered {
        None => 0.0,
        Some(Scattered::Lambert(tau)) => cell_mean(&cell, 6, |d| tau.at(d.theta())),
        Some(Scattered::Cells(matrix)) if matrix.incident() == basis => matrix.tau_by_cell()[index],
        Some(Scattered::Cells(matrix)) => matrix.tau(Incident(cell.centre())),
        Some(Scattered::Directions(data)) => data.tau(Incident(cell.centre())),
        Some(Scattered::Tree(tree)) => tree.tau(Incident(cell.centre())),
    };
    regular + scattered
}
